//! Subcycling within a block: chunks of elements that are evaluated in every r-th step only, r their step
//! ratio.
//!
//! The forces F of such a chunk act on its nodes as impulses (the method of impulses, Verlet-I; Tuckerman,
//! Berne and Martyna, J. Chem. Phys. 97 (1992) 1990-2001; asynchronous variational integrators with a common
//! clock: Lew, Marsden, Ortiz and West, Arch. Rational Mech. Anal. 167 (2003) 85-146): at each of its own
//! evaluations J = w F with half of the time since the last one and half of the time until the next, w = ½
//! (T⁻ + T⁺), and nothing between them. So each evaluation keeps linear and angular momentum, and the whole
//! step is symplectic. Between two evaluations nodes move by the velocities that they have; strains follow
//! from the whole way, x − x(last).
//!
//! T⁺ = r dt is planned before it is known. Where steps turn out shorter, the difference is made up for at
//! the next evaluation: w = T⁻ − ½ r dt(planned) + ½ T⁺, so that all impulses together are F times time.
//!
//! Ledger: at the evaluation b after a, elements store ½ (F_a + F_b)·(x_b − x_a), of which the nodes got the
//! part w' F_a·v_{a+1/2} right after a (w' is the part of the impulse after the whole step). Until b this is
//! taken off the stored energy: the elements owe it. What remains at b is the work of the differences of
//! velocity within the step, which the drift shows.

use super::local::LocalNodes;
use super::store::{CHUNK, ElementStore};
use super::{Block, Motion, Report};
use crate::archive::{Archive, ArchiveResult, Persist, persist_all};
use crate::reductions;
use crate::tensor::{Dim, Space};
use crate::vector::{dot, minus, times};
use embate_lanes::{BATCH, Chunks, Moving, Team};

/// Largest step ratio; a number with many divisors.
pub const RATIO_MOST: u32 = 60;

/// A chunk between two of its evaluations.
#[derive(Clone, Copy, Debug)]
struct Interval {
    /// Steps from one evaluation to the next.
    ratio: u32,
    /// Time since the last evaluation, s.
    since: f64,
    /// Time that was to pass from it to the next, s.
    planned: f64,
    /// Whether the slots hold an impulse; w', its part after the whole step per force, s, which is negative
    /// where far too much was planned.
    pulls: bool,
    pending: f64,
    /// Work that the nodes have got and the elements have not given yet, J/m.
    owed: f64,
}

persist_all!(Interval { ratio, since, planned, pulls, pending, owed });

impl Interval {
    const FIRST: Self = Self { ratio: 1, since: 0.0, planned: 0.0, pulls: false, pending: 0.0, owed: 0.0 };

    fn is_due(&self, turn: u32) -> bool {
        turn.is_multiple_of(self.ratio)
    }
}

/// What the chunks of a block remember between their evaluations.
pub(super) struct Subcycles<const D: usize> {
    intervals: Vec<Interval>,
    /// By slot, of chunks with a ratio above one: positions, m, and forces, N/m, of the last evaluation.
    positions: Vec<[f64; D]>,
    forces: Vec<[f64; D]>,
}

impl<const D: usize> Persist for Subcycles<D> {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { intervals, positions, forces } = self;
        intervals[..].persist(archive)?;
        let are_sound = intervals.iter().all(|own| (1..=RATIO_MOST).contains(&own.ratio));
        archive.check(are_sound, "a step ratio that there is not")?;
        positions[..].persist(archive)?;
        forces[..].persist(archive)
    }
}

impl<const D: usize> Subcycles<D>
where
    Dim<D>: Space<D>,
{
    fn new(chunks: usize, slots: usize) -> Self {
        Self { intervals: vec![Interval::FIRST; chunks], positions: vec![[0.0; D]; slots], forces: vec![[0.0; D]; slots] }
    }

    /// Whether a chunk is evaluated in this turn of the cycle.
    pub(super) fn is_due(&self, chunk: usize, turn: u32) -> bool {
        self.intervals[chunk].is_due(turn)
    }

    /// Time over which a chunk is strained, s, if that is not the step alone.
    pub(super) fn time(&self, chunk: usize) -> Option<f64> {
        let own = &self.intervals[chunk];
        (own.ratio > 1).then_some(own.since)
    }

    /// Step ratio of a chunk.
    pub(super) fn ratio(&self, chunk: usize) -> u32 {
        self.intervals[chunk].ratio
    }

    /// Copies positions of the nodes of a chunk and the mean velocities that led there in `time`.
    pub(super) fn copy(&self, (chunk, time): (usize, f64), nodes: &LocalNodes, motion: &Motion<'_, D>, moving: &mut Moving<D>) {
        moving.resize(nodes.width());
        let old = &self.positions[chunk * nodes.width()..];
        moving.fill_by(nodes.of_chunk(chunk).iter().zip(old), |(&node, &old), to, velocity| {
            let new = motion.positions[node as usize];
            to.copy_from_slice(&new);
            velocity.copy_from_slice(&times(1.0 / time, minus(new, old)));
        });
    }

    /// Lets the time of a step pass: chunks that pulled in the step before and are not due now rest, and owe
    /// the work of their impulse.
    pub(super) fn pass(&mut self, motion: &Motion<'_, D>, nodes: &LocalNodes, slots: &mut [[f64; D]], team: &mut Team) {
        let width = nodes.width();
        let forces = &self.forces;
        let parts = (Chunks::new(&mut self.intervals, 1), Chunks::new(slots, width));
        team.each(parts, |index, _, (own, slots)| {
            let Some(own) = own.first_mut() else { return };
            own.since += motion.time_step;
            if own.is_due(motion.turn) {
                (own.owed, own.pulls) = (0.0, false);
            } else if own.pulls {
                let power = |(&node, force): (&u32, &[f64; D])| dot(*force, motion.velocities[node as usize]);
                let power: f64 = nodes.of_chunk(index).iter().zip(&forces[index * width..]).map(power).sum();
                (own.owed, own.pulls) = (own.pending * power, false);
                slots.fill([0.0; D]);
            }
        });
    }

    /// Makes impulses per mean step of the forces in the slots of the chunks that were evaluated in this
    /// turn, and begins their next interval.
    fn begin(&mut self, begin: &Begin<'_, D>, nodes: &LocalNodes, slots: &mut [[f64; D]], team: &mut Team) {
        let (width, [old, new]) = (nodes.width(), begin.time_steps);
        let parts = (
            Chunks::new(&mut self.intervals, 1),
            Chunks::new(slots, width),
            Chunks::new(&mut self.positions, width),
            Chunks::new(&mut self.forces, width),
        );
        team.each(parts, |index, _, (own, slots, positions, forces)| {
            let Some(own) = own.first_mut().filter(|own| own.is_due(begin.turn)) else { return };
            let planned = f64::from(own.ratio) * new;
            let weight = own.since - 0.5 * own.planned + 0.5 * planned;
            if own.ratio > 1 {
                forces.copy_from_slice(slots);
                for (position, &node) in positions.iter_mut().zip(nodes.of_chunk(index)) {
                    *position = begin.positions[node as usize];
                }
                (own.pulls, own.pending) = (true, new / (old + new) * weight);
            }
            let factor = weight / (0.5 * (old + new));
            if factor != 1.0 {
                slots.iter_mut().for_each(|slot| *slot = times(factor, *slot));
            }
            (own.since, own.planned) = (0.0, planned);
        });
    }

    /// What chunks that report so report together: squared steps are those that the global step may have.
    pub(super) fn joined(&self, reports: &[Report], others: Report) -> Report {
        let of = |(report, own): (&Report, &Interval)| {
            let ratio = f64::from(own.ratio);
            Report { time_step_squared: report.time_step_squared / (ratio * ratio), stored: report.stored - own.owed, ..*report }
        };
        Report::joined(reports.iter().zip(&self.intervals).map(of).chain([others]))
    }
}

/// What chunks need to know to begin their intervals.
#[derive(Clone, Copy, Debug)]
pub struct Begin<'a, const D: usize> {
    /// x^n, m.
    pub positions: &'a [[f64; D]],
    /// dt^{n-1} and dt^n, s.
    pub time_steps: [f64; 2],
    /// Steps since the cycle began.
    pub turn: u32,
}

impl LocalNodes {
    /// Largest ratio r with r² `shortest` ≤ the least value of the nodes of a chunk.
    fn allowed_ratio(&self, chunk: usize, of_nodes: &[f64], shortest: f64) -> u32 {
        let values = self.of_chunk(chunk).iter().map(|&node| of_nodes[node as usize]);
        let ratio = (values.fold(f64::INFINITY, f64::min) / shortest).sqrt();
        ratio.clamp(1.0, f64::from(RATIO_MOST)) as u32
    }
}

/// Largest divisor of `cycle` that is not above `most`, which is one at least.
#[must_use]
pub fn largest_divisor(cycle: u32, most: u32) -> u32 {
    (1..=most.min(cycle)).rev().find(|&ratio| cycle.is_multiple_of(ratio)).unwrap_or(1)
}

/// Regions of a block, its chunks, that may have steps of their own.
pub trait Regions {
    /// Smallest square of the stable step of an element, s².
    fn shortest_squared(&self) -> f64;
    /// Lowers at each node the least square of the stable steps of its elements, s².
    fn add_steps(&self, of_nodes: &mut [f64]);
    /// Lowers at each node of an element the least value `from` any of the element's nodes.
    fn widen(&self, from: &[f64], of_nodes: &mut [f64]);
    /// Hands over for each chunk the largest ratio r with r² `shortest` ≤ the least value of its nodes, and
    /// the number of its elements.
    fn allowed(&self, of_nodes: &[f64], shortest: f64, add: &mut dyn FnMut(u32, usize));
}

/// A block with subcycling.
pub trait Subcycled<const D: usize> {
    /// Gives each chunk the largest of these ratios that divides `cycle`. All chunks must have been evaluated
    /// in this step.
    fn set_ratios(&mut self, of_nodes: &[f64], shortest: f64, cycle: u32);
    /// Hands over each node of each chunk with its ratio.
    fn ratios(&self, add: &mut dyn FnMut(u32, u32));
    /// What the block reports with its ratios.
    fn report(&self) -> Report;
    /// Makes impulses of the forces of the chunks that were evaluated in this step, and returns how many
    /// elements these have.
    fn begin(&mut self, begin: &Begin<'_, D>, slots: &mut [[f64; D]], team: &mut Team) -> usize;
}

impl<const D: usize> ElementStore<D>
where
    Dim<D>: Space<D>,
{
    /// Remembers from now on what subcycling needs.
    pub(super) fn remember_intervals(&mut self) {
        self.subcycles = Some(Box::new(Subcycles::new(self.reports.len(), self.nodes.slots().len())));
    }

    /// Number of elements of a chunk.
    fn elements_of(&self, chunk: usize) -> usize {
        (self.count - chunk * CHUNK * BATCH).min(CHUNK * BATCH)
    }

    /// Nodes of each live element with its number.
    fn live_elements(&self) -> impl Iterator<Item = (usize, impl Iterator<Item = usize> + Clone)> {
        let live = (0..self.count).filter(|&element| self.is_alive(element));
        live.map(|element| (element, self.nodes_of(element / BATCH, element % BATCH)))
    }
}

impl<const D: usize> Regions for ElementStore<D>
where
    Dim<D>: Space<D>,
{
    fn shortest_squared(&self) -> f64 {
        reductions::min(self.reports.iter().map(|report| report.time_step_squared))
    }

    fn add_steps(&self, of_nodes: &mut [f64]) {
        for (element, nodes) in self.live_elements() {
            let squared = self.time_step_squared(element);
            nodes.for_each(|node| of_nodes[node] = of_nodes[node].min(squared));
        }
    }

    fn widen(&self, from: &[f64], of_nodes: &mut [f64]) {
        for (_, nodes) in self.live_elements() {
            let least = nodes.clone().map(|node| from[node]).fold(f64::INFINITY, f64::min);
            nodes.for_each(|node| of_nodes[node] = of_nodes[node].min(least));
        }
    }

    fn allowed(&self, of_nodes: &[f64], shortest: f64, add: &mut dyn FnMut(u32, usize)) {
        for chunk in 0..self.reports.len() {
            add(self.nodes.allowed_ratio(chunk, of_nodes, shortest), self.elements_of(chunk));
        }
    }
}

impl<const D: usize> Subcycled<D> for ElementStore<D>
where
    Dim<D>: Space<D>,
{
    fn set_ratios(&mut self, of_nodes: &[f64], shortest: f64, cycle: u32) {
        let Some(subcycles) = &mut self.subcycles else { return };
        for (chunk, own) in subcycles.intervals.iter_mut().enumerate() {
            own.ratio = largest_divisor(cycle, self.nodes.allowed_ratio(chunk, of_nodes, shortest));
        }
    }

    fn ratios(&self, add: &mut dyn FnMut(u32, u32)) {
        let Some(subcycles) = &self.subcycles else { return };
        for (chunk, own) in subcycles.intervals.iter().enumerate() {
            self.nodes.of_chunk(chunk).iter().for_each(|&node| add(node, own.ratio));
        }
    }

    fn report(&self) -> Report {
        self.joined_reports()
    }

    fn begin(&mut self, begin: &Begin<'_, D>, slots: &mut [[f64; D]], team: &mut Team) -> usize {
        let Some(subcycles) = &mut self.subcycles else { return 0 };
        subcycles.begin(begin, &self.nodes, slots, team);
        let due = (0..self.reports.len()).filter(|&chunk| self.subcycles.as_ref().is_some_and(|own| own.is_due(chunk, begin.turn)));
        due.map(|chunk| self.elements_of(chunk)).sum()
    }
}
