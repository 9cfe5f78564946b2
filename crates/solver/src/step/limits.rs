//! How long a step may be, who sets it, and what ends a run.
//!
//! Bounds of the elements come from their blocks ([`Report`]), gaps and depths from the contacts; the step
//! goes to [`System::step`].

use super::System;
use crate::block::Report;
use crate::contact::Contact;
use crate::contact::law::penalty::LIMIT;
use crate::dimension::Dimension;
use crate::error::Error;
use crate::reductions;
use crate::tensor::Dim;

/// How many times as long as the step the stable one must be before the step grows at all.
pub(super) const HOLD: f64 = 1.25;
/// A step that grows does so by at most this factor from one to the next.
///
/// Central differences with the step dt keep a vibration of the circular frequency ω at A² ω² (1 − ω²
/// dt²/4) = v², of its amplitude A and its largest velocity v. The step is cut when the elements that decide
/// it are pressed most, which leaves A as it is, and grows at all times, which takes as much from A as from
/// v. So each cut that is made up for by growth adds up to ω² dt²/8 of twice its relative size to the
/// vibrations that it follows, and the energy grows by up to exp(½ n (g − 1)) in n steps with the factor g:
/// by e in 2,000 of them with 1.001, in 20,000 with 1.0001 (two soft blocks in a box: 5 % of drift in 32,000
/// steps, and 0.8 % in 49,000). A constant step keeps the energy.
const GROWTH: f64 = 1.0001;
/// The same for a while after elements were made again, whose stable step is longer at once.
const GROWTH_OF_FRESH: f64 = 1.02;

/// How far something may go into another body within a step, in depths at which the springs of contact
/// stiffen: an eighth of the local thickness. Springs are made before they close, but they yield while
/// they take up the momentum, so a body that comes at some tenths of the wave speed of one that is an element
/// thick would be deep in it before they hold.
const APPROACH: f64 = 2.5;
/// The step is not cut below this fraction of the stable one for that.
const LEAST_APPROACH: f64 = 0.125;
/// Springs are made for what may come in with some times the last motion, and at the start there was none:
/// where bodies are fast, the first step is short, and the next ones, so many, grow by two.
pub(super) const FIRST: u64 = 4;

/// How many times as fast as the fastest wave and the fastest node at the start together a node may become.
/// Gas into empty space reaches 2/(γ − 1) times its speed of sound.
pub const RUNAWAY: f64 = 20.0;

/// Steps before the end that are made equal.
const LANDING: f64 = 128.0;
/// Cycles of subcycling before the end that are made equal.
const LANDING_CYCLES: f64 = 8.0;

/// Limits and fractions of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// End time, s.
    pub end: f64,
    /// Fraction of the stable step.
    pub safety: f64,
    /// Largest energy drift, fraction.
    pub energy: f64,
    /// Smallest time step, s.
    pub step: f64,
    /// Largest time step, s; infinite: none is given.
    pub largest: f64,
    /// Largest speed of a node, m/s; before the start, where none is given: that of the fastest wave,
    /// negative.
    pub velocity: f64,
    /// Largest depth of a contact, m.
    pub penetration: f64,
    /// Whether the model sets none: then no contact may be deeper than a body there is thick either.
    pub is_local: bool,
}

/// Who sets the time step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Governor {
    /// An element of the block whose smallest squared step this is.
    Element(f64),
    /// A node, by the elements that meet there.
    Node(u32),
    /// The assembled mesh, whose fastest motion is largest at this node.
    Assembled(u32),
    /// The gas of a cavity, by its number.
    Cavity(u32),
    /// The model, by the largest step that it allows.
    Given,
    /// Bodies that come at each other so fast that a longer step would let them overlap before a contact sees
    /// it.
    Contact,
    /// The end of the run, or growth from a smaller step.
    Schedule,
}

impl<const D: usize> System<D>
where
    Dim<D>: Dimension<D>,
{
    /// The next step: the bound of the elements or nodes (which is that of the nodes in contact too, see
    /// [`crate::contact::springs`]), the largest one of the model, growth, and the end.
    pub(super) fn stable_step(&mut self, elements: &Report) -> Result<f64, Error> {
        if elements.determinant <= 0.0 {
            return Err(self.inverted());
        }
        let bound = self.stable_step_squared(elements);
        let (squared, mut governor) = self.with_cavities(bound);
        let mut time_step = self.limits.safety * squared.sqrt();
        if self.limits.largest < time_step {
            (time_step, governor) = (self.limits.largest, Governor::Given);
        }
        if time_step < self.limits.step || time_step.is_nan() {
            return Err(self.collapsed(time_step, governor));
        }
        self.bound_by = governor;
        let old = self.time_step_old;
        // Between the begins of its cycles subcycling has planned with the step as it is.
        let (turn, cycle) = self.subcycling.as_ref().map_or((0, 1), |own| (own.turn(), own.cycle()));
        if self.step > 0 && time_step > old {
            (time_step, governor) = if self.governor == Governor::Contact && self.step <= FIRST {
                (time_step.min(2.0 * old), Governor::Contact)
            } else {
                let grows = turn == 0 && time_step > HOLD * old;
                let growth = if self.has_fresh_elements() { GROWTH_OF_FRESH } else { GROWTH };
                (if grows { (growth.powi(cycle as i32) * old).min(time_step) } else { old }, Governor::Schedule)
            };
        }
        // The end is met exactly, by so many equal steps that none jumps, and at the end of a cycle.
        let left = self.stage_end() - self.time;
        let cycle = f64::from(cycle);
        let mut steps = (left / time_step * (1.0 - 1e-9)).ceil();
        let cycles = steps / cycle;
        if left > 0.0 && turn == 0 && cycle > 1.0 && cycles > LANDING_CYCLES - 1.0 && cycles <= LANDING_CYCLES {
            steps = LANDING_CYCLES * cycle;
            (time_step, governor) = (left / steps, Governor::Schedule);
        }
        if left > 0.0 && steps <= LANDING {
            (time_step, governor) = (left / steps.max(1.0), Governor::Schedule);
        }
        self.governor = governor;
        Ok(time_step)
    }

    /// The step in which nothing goes farther into another body than [`APPROACH`] allows; a fraction of
    /// `time_step` at least. In 2D who goes through a body in a step is known to have, and comes back:
    /// there the step is as it is.
    pub(super) fn limit_approach(&mut self, time_step: f64) -> f64 {
        if D == 2 {
            return time_step;
        }
        let way = self.speed * time_step;
        let allowed = if self.step == 0 {
            let thinnest = reductions::min(self.contacts.iter().map(Contact::thinnest));
            let ways = APPROACH * LIMIT * thinnest / (2.0 * way);
            if ways < 1.0 { ways * time_step } else { time_step }
        } else {
            self.springs.step_of_approach(APPROACH, way, &self.velocities, &self.bodies)
        };
        if allowed >= time_step {
            return time_step;
        }
        self.governor = Governor::Contact;
        f64::max(allowed, LEAST_APPROACH * time_step).max(self.limits.step.min(time_step))
    }

    /// Whether nodes are as fast, and contacts as deep, as is sound.
    pub(super) fn check_limits(&self) -> Result<(), Error> {
        if self.speed > self.limits.velocity {
            return Err(self.runaway());
        }
        let deep = self.contacts.iter().find(|contact| self.is_too_deep(contact));
        deep.map_or(Ok(()), |contact| Err(self.too_deep(contact)))
    }

    /// Whether a contact is deeper than the limit, or, where the model sets none, than a body there is thick.
    pub(crate) fn is_too_deep(&self, contact: &Contact<D>) -> bool {
        // What comes in within a step is no deeper than both sides go in it.
        let limit = self.limits.penetration + 2.0 * self.time_step_old * self.speed;
        contact.depth() > limit || (self.limits.is_local && contact.gone_through().is_some())
    }
}
