//! Elements of parts made again on the way of a run: when, and how the run continues with them.
//!
//! Between two steps the outline of the part is filled with new elements ([`embate_remesh::mesher`]); a
//! system of the same model is built on the new mesh, and takes over the state: of the part by
//! [`embate_remesh::transfer`], of everything else as it is. Where anything of this can't be had the run
//! continues with the old mesh, and tries again later.

mod carried;
mod exchange;
mod flowing;
mod fresh;
mod space;

use super::Runs;
use super::run::Run;
use crate::build;
use crate::error::{Error, NOT_REMESHED, Notice, REMESH_LOSS};
use crate::mesh::Mesh;
use crate::model::{Flow, Model, Remesh, Rule};
use crate::monitor::RunMonitor;
use crate::record::Recorded;
use crate::step::System;
use crate::step::remap::{NewState, Remeshing};
use crate::tensor::Dim;
use crate::vector::{length, minus, plus};
use fresh::Fresh;

/// Steps between two looks at the elements.
const EVERY: u64 = 20;
/// Steps after which elements that could not be made again are tried again, and between two times at least.
const PATIENCE: u64 = 200;
/// Most elements of a part, as a multiple of those at the start, where the model does not say.
const MOST: u64 = 4;
/// Edges that are longer than they are wanted by this factor, in contact, where plastic strain changes or
/// where stress has errors, are too long.
const LONG: f64 = 2.0;
/// Below so much quality elements do not wait.
const URGENT: f64 = 0.1;

/// What makes elements again.
pub(super) struct Remesher {
    model: Model,
    rules: Vec<Rule>,
    /// Parts that material flows through.
    flows: Vec<Flow>,
    /// Elements of each part at the start.
    elements: Vec<usize>,
    /// Step of the last look.
    looked: Option<u64>,
}

impl Remesher {
    /// `None` where the model makes none again.
    pub(super) fn new<const D: usize>(model: &Model, mesh: &Mesh<D>) -> Option<Self>
    where
        Dim<D>: Runs<D>,
    {
        let at_start = |part: usize| mesh.remeshed.of(part).map_or_else(|| mesh.elements_of(part), |own| own.elements_at_start);
        let elements = (0..model.parts.len()).map(at_start).collect();
        let (rules, flows) = (model.rules_of_remeshing(), model.flows.clone());
        model.is_remeshed().then(|| Self { model: model.clone(), rules, flows, elements, looked: None })
    }

    /// Whether the elements are to be looked at before the next step.
    pub(super) fn is_due(&self, step: u64) -> bool {
        step > 0 && step.is_multiple_of(EVERY) && self.looked != Some(step)
    }
}

/// A dimension in which elements of parts can be made again.
pub trait Remeshes<const D: usize> {
    /// The part with new elements, on which the state continues; `Err`: why there are none.
    ///
    /// # Errors
    /// The reason, in words.
    fn fresh(system: &System<D>, model: &Model, part: usize, wish: &Wish<'_>) -> Result<Fresh<D>, String>
    where
        Dim<D>: Runs<D>;

    /// The part on the elements of a mesh that has them alone, on which the state continues; `Err`: why it
    /// can't.
    ///
    /// # Errors
    /// The reason, in words.
    fn onto(system: &System<D>, model: &Model, part: usize, new: &Mesh<D>) -> Result<Fresh<D>, String>
    where
        Dim<D>: Runs<D>;

    /// Least scaled Jacobian of the elements of a part now.
    fn quality(system: &System<D>, part: usize) -> f64
    where
        Dim<D>: Runs<D>;

    /// The largest length of an edge of a part over that which is wanted there, where less is wanted than
    /// elsewhere; 0 where nothing is.
    fn coarseness(_system: &System<D>, _model: &Model, _part: usize, _wish: &Wish<'_>) -> f64
    where
        Dim<D>: Runs<D>,
    {
        0.0
    }

    /// The largest way of a node of a part that material flows through from its place, over the width of an
    /// element.
    ///
    /// # Errors
    /// The reason, in words.
    fn travel(_system: &System<D>, _model: &Model, _window: &Places<D>) -> Result<f64, String>
    where
        Dim<D>: Runs<D>,
    {
        Err("flows are in 2D only".into())
    }

    /// What the elements at the inlet have, as the flow begins.
    ///
    /// # Errors
    /// The reason, in words.
    fn inflow(_system: &System<D>, _model: &Model, _window: &Places<D>) -> Result<Vec<f64>, String>
    where
        Dim<D>: Runs<D>,
    {
        Err("flows are in 2D only".into())
    }

    /// The part with its nodes back at their places.
    ///
    /// # Errors
    /// The reason, in words.
    fn returned(_system: &System<D>, _model: &Model, _window: &Places<D>) -> Result<Fresh<D>, String>
    where
        Dim<D>: Runs<D>,
    {
        Err("flows are in 2D only".into())
    }
}

/// Where the nodes of a part belong that material flows through.
#[derive(Debug)]
pub struct Places<const D: usize> {
    /// The part.
    part: usize,
    /// Unit vector along the flow.
    direction: [f64; D],
    /// Of the nodes of the part in their order, m.
    places: Vec<[f64; D]>,
    /// What comes in at the inlet, as [`Remeshes::inflow`] has it.
    inflow: Vec<f64>,
}

/// What has changed with the elements of a part.
struct Change {
    kinetic_lost: f64,
    elastic_lost: f64,
    momentum: [f64; 2],
}

/// Why elements of a part are made again, with their least scaled Jacobian.
struct Cause {
    reason: &'static str,
    quality: f64,
    /// Whether nodes are moved only.
    relocates: bool,
}

/// Elements as they are wanted.
#[derive(Clone, Copy, Debug)]
pub struct Wish<'a> {
    /// Whether nodes are moved only.
    relocates: bool,
    /// How large elements are to be.
    rule: &'a Remesh,
    /// Elements at the start, and at most.
    elements: [usize; 2],
    /// Least scaled Jacobian that they must have more than.
    quality: f64,
}

impl<const D: usize> Run<D>
where
    Dim<D>: Runs<D>,
{
    /// Whether elements are to be looked at before the next step.
    pub(super) fn is_remeshing_due(&self) -> bool {
        self.remesher.as_ref().is_some_and(|own| own.is_due(self.system.step))
    }

    /// Makes elements again where that is due.
    ///
    /// # Errors
    /// More energy was lost by it than the model allows.
    pub(super) fn remesh(&mut self) -> Result<(), Error> {
        let Some(mut own) = self.remesher.take().filter(|own| own.is_due(self.system.step)) else { return Ok(()) };
        own.looked = Some(self.system.step);
        // One part at a time: what contacts know goes over in a step.
        let mut done = Ok(false);
        for index in 0..own.rules.len() {
            done = self.remesh_part(&own, index);
            if !matches!(done, Ok(false)) {
                break;
            }
        }
        for index in 0..own.flows.len() {
            if matches!(done, Ok(false)) {
                done = self.flow_on(&own, index);
            }
        }
        self.remesher = Some(own);
        done.map(|_| ())
    }

    /// Makes the elements of one part again, if they have become poor. Returns whether it has others now.
    fn remesh_part(&mut self, own: &Remesher, index: usize) -> Result<bool, Error> {
        let Rule { of: rule, relocates, .. } = &own.rules[index];
        let Some(part) = own.model.parts.iter().position(|part| part.name == rule.part) else { return Ok(false) };
        let elements = [own.elements[part], rule.elements_most.unwrap_or(own.elements[part] as u64 * MOST) as usize];
        let mut wish = Wish { relocates: *relocates, rule, elements, quality: 0.0 };
        let Some((reason, quality)) = self.reason(index, (&own.model, part), &wish) else { return Ok(false) };
        // Poor elements are exchanged for better ones; the others for any that are not poor.
        wish.quality = quality.min(rule.quality);
        let made = match <Dim<D>>::fresh(&self.system, &own.model, part, &wish) {
            Ok(fresh) => self.made_again(&own.model, part, fresh, Cause { reason, quality, relocates: *relocates })?,
            Err(refused) => Err(refused),
        };
        match made {
            Ok(event) => {
                let lost = self.system.remap.as_ref().map_or(0.0, |remap| remap.energy);
                if let Some(remap) = &mut self.system.remap {
                    remap.reference[index] = event.time_step[1];
                    remap.tried[index] = event.step;
                    remap.failures[index] = 0;
                    remap.events.push(event);
                }
                let (time, step, largest) = (self.system.time, self.system.step, self.system.ledger.largest);
                if lost > rule.loss_limit * largest {
                    return Err(Error::RemeshLoss { part: rule.part.clone(), lost: lost / largest, limit: rule.loss_limit, time, step });
                }
                Ok(true)
            }
            Err(reason) => {
                let (step, time) = (self.system.step, self.system.time);
                if let Some(remap) = &mut self.system.remap {
                    remap.tried[index] = step;
                    remap.failures[index] += 1;
                    remap.refused = Some(format!("part \"{}\" at {time:.6e} s: {reason}", rule.part));
                }
                Ok(false)
            }
        }
    }

    /// Why elements of a part are to be made again now, and their least scaled Jacobian; `None`: they are
    /// not.
    fn reason(&mut self, index: usize, (model, part): (&Model, usize), wish: &Wish<'_>) -> Option<(&'static str, f64)> {
        let (rule, stable) = (wish.rule, self.stable_step_of(part));
        let quality = <Dim<D>>::quality(&self.system, part);
        let (step, time) = (self.system.step, self.system.time);
        let count = index + 1;
        let remap = self.system.remap.as_mut()?;
        remap.tried.resize(count.max(remap.tried.len()), 0);
        remap.failures.resize(count.max(remap.failures.len()), 0);
        remap.reference.resize(count.max(remap.reference.len()), 0.0);
        if remap.reference[index] <= 0.0 {
            remap.reference[index] = stable;
        }
        let waits = remap.tried[index] > 0 && step < remap.tried[index] + PATIENCE;
        let was_in_vain = remap.failures[index] > 0;
        if time < rule.begin || (waits && was_in_vain) {
            return None;
        }
        let last = remap.events.iter().rev().find(|event| event.part == rule.part).map_or(rule.begin, |event| event.time);
        if rule.interval.is_some_and(|interval| time >= last + interval) {
            Some(("interval", quality))
        } else if waits && quality >= URGENT {
            None
        } else if quality < rule.quality {
            Some(("quality", quality))
        } else if stable < rule.time_step * remap.reference[index] {
            Some(("time_step", quality))
        } else {
            (<Dim<D>>::coarseness(&self.system, model, part, wish) > LONG).then_some(("size", quality))
        }
    }

    /// Stable step of the elements of a part, s.
    fn stable_step_of(&self, part: usize) -> f64 {
        let of = self.system.mesh.groups.iter().zip(&self.system.reports).filter(|(group, _)| group.part == part);
        of.map(|(_, report)| report.time_step_squared).fold(f64::INFINITY, f64::min).sqrt()
    }

    /// The run continues with other elements of a part; inside: why it can't.
    fn made_again(&mut self, model: &Model, part: usize, fresh: Fresh<D>, cause: Cause) -> Result<Result<Remeshing, String>, Error> {
        let before = (self.stable_step_of(part), self.system.mesh.elements_of(part));
        let (better, correction, volume_change) = (fresh.quality, fresh.correction, fresh.volume_change);
        let change = match self.continue_with(model, part, fresh)? {
            Ok(change) => change,
            Err(refused) => return Ok(Err(refused)),
        };
        Ok(Ok(Remeshing {
            time: self.system.time,
            step: self.system.step,
            part: model.parts[part].name.clone(),
            relocated: cause.relocates,
            reason: cause.reason.into(),
            elements: [before.1, self.system.mesh.elements_of(part)],
            quality: [cause.quality, better],
            time_step: [before.0, self.stable_step_of(part)],
            kinetic_lost: change.kinetic_lost,
            elastic_lost: change.elastic_lost,
            mass_correction: correction,
            momentum_change: change.momentum,
            volume_change,
        }))
    }

    /// The run continues with a part as it is now; inside: why it can't.
    fn continue_with(&mut self, model: &Model, part: usize, mut fresh: Fresh<D>) -> Result<Result<Change, String>, Error> {
        let mesh = std::mem::take(&mut fresh.mesh);
        let made = build::system(model, Some(mesh), self.system.level, self.threads).map_err(Error::Model);
        let made = made.and_then(|(mut system, _)| {
            system.start()?;
            let recorded = Recorded::new(model, &system).map_err(Error::Model)?;
            Ok((system, recorded))
        });
        let (system, mut recorded) = match made {
            Ok(made) => made,
            Err(error) => return Ok(Err(error.to_string())),
        };
        hand_over(&mut self.recorded, &mut recorded)?;
        let mut monitor = RunMonitor::new(model, &system);
        hand_over(&mut self.monitor, &mut monitor)?;
        let centre = fresh.centre;
        let (mut linear, mut angular, sizes) = self.system.momentum_of(part, centre);
        let mut flowed = [0.0; 2];
        if let Some(exchange) = &fresh.exchange {
            let more = self.system.kept(part, exchange.momentum);
            (linear, angular) = (plus(linear, more[0]), plus(angular, more[1]));
            flowed = [exchange.kinetic, exchange.elastic].map(|[arrived, left]| left - arrived);
        }
        let state = NewState {
            part,
            numbers: &fresh.numbers,
            between: &fresh.between,
            velocities: &fresh.velocities,
            points: &fresh.points,
            flowed,
        };
        // From here on the old system is gone.
        let old = std::mem::replace(&mut self.system, system);
        let [kinetic_lost, elastic_lost] = self.system.take_over(old, &state)?;
        (self.recorded, self.monitor) = (recorded, monitor);
        self.hashing.renew(&self.system);
        let (linear_new, angular_new, _) = self.system.momentum_of(part, centre);
        let [difference, turned] = [length(minus(linear_new, linear)), length(minus(angular_new, angular))];
        let fraction = |change: f64, size: f64| if size > 0.0 { change / size } else { 0.0 };
        Ok(Ok(Change { kinetic_lost, elastic_lost, momentum: [fraction(difference, sizes[0]), fraction(turned, sizes[1])] }))
    }

    /// What making elements again has to say at the end.
    pub(super) fn remeshing_notices(&self) -> Vec<Notice> {
        let Some(remap) = &self.system.remap else { return Vec::new() };
        let mut notices = Vec::new();
        let rules = self.remesher.as_ref().map_or(&[][..], |own| &own.rules);
        // Where nodes can't be moved, new elements are what helps, if the model has them.
        let is_last = |rule: &Rule| !rule.relocates || rules.iter().all(|other| other.relocates || other.of.part != rule.of.part);
        for relocates in [true, false] {
            let own = rules.iter().zip(&remap.failures).filter(|(rule, _)| rule.relocates == relocates && is_last(rule));
            let failures: u64 = own.map(|(_, failures)| failures).sum();
            if let (Some(refused), true) = (&remap.refused, failures > 0) {
                let what = if relocates { "nodes could not be moved to better places" } else { "elements could not be made again" };
                let text = format!("{what} {failures} time(s), and the run continued with the old ones; the last: {refused}");
                notices.push(Notice::new(&NOT_REMESHED, text));
            }
        }
        notices.extend(self.flow_notices());
        let largest = self.system.ledger.largest;
        if largest > 0.0 && remap.energy.abs() > 0.01 * largest {
            let flows: u64 = remap.flows.iter().map(|flow| flow.events).sum();
            let text = format!(
                "making elements again {} time(s) took {:.2} % of the largest total energy",
                remap.events.len() as u64 + flows,
                100.0 * remap.energy / largest
            );
            notices.push(Notice::new(&REMESH_LOSS, text));
        }
        notices
    }
}

/// What one value knows is given to another one that was made of the same model.
fn hand_over<T: crate::archive::Persist>(from: &mut T, to: &mut T) -> crate::archive::ArchiveResult {
    crate::step::remap::hand_over(from, to, [usize::MAX; 2], crate::archive::Persist::persist)
}

/// Part of its volume by which the mesh of a part may be off.
const OFF: f64 = 0.1;

/// Refuses a mesh that is none of the part as it is now, by the volumes (areas) of both.
fn is_of_part(new: f64, old: f64, unit: &str) -> Result<(), String> {
    if (new / old - 1.0).abs() <= OFF {
        return Ok(());
    }
    Err(format!("it has {new:.4e} {unit}, and the part has {old:.4e} {unit} now"))
}
