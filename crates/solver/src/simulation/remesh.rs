//! Elements of parts made again on the way of a run: when, and how the run continues with them.
//!
//! Between two steps the outline of the part is filled with new elements ([`embate_remesh::mesher`]); a
//! system of the same model is built on the new mesh, and takes over the state: of the part by
//! [`embate_remesh::transfer`], of everything else as it is. Where anything of this can't be had the run
//! continues with the old mesh, and tries again later.

mod fresh;

use super::Runs;
use super::run::Run;
use crate::build;
use crate::error::{Error, NOT_REMESHED, Notice, REMESH_LOSS};
use crate::mesh::Mesh;
use crate::model::{Model, Remesh};
use crate::monitor::RunMonitor;
use crate::record::Recorded;
use crate::step::System;
use crate::step::remap::{NewState, Remeshing};
use crate::tensor::Dim;
use fresh::Fresh;

/// Steps between two looks at the elements.
const EVERY: u64 = 20;
/// Steps after which elements that could not be made again are tried again, and between two times at least.
const PATIENCE: u64 = 200;
/// Most elements of a part, as a multiple of those at the start, where the model does not say.
const MOST: u64 = 4;
/// Below so much quality elements do not wait.
const URGENT: f64 = 0.1;

/// What makes elements again.
pub(super) struct Remesher {
    model: Model,
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
        (!model.remeshes.is_empty()).then(|| Self { model: model.clone(), elements, looked: None })
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
    fn fresh(system: &System<D>, model: &Model, part: usize, wish: &Wish) -> Result<Fresh<D>, String>
    where
        Dim<D>: Runs<D>;

    /// Least scaled Jacobian of the elements of a part now.
    fn quality(system: &System<D>, part: usize) -> f64
    where
        Dim<D>: Runs<D>;
}

/// Elements as they are wanted.
#[derive(Clone, Copy, Debug)]
pub struct Wish {
    /// Edge length, m; `None`: as many as there were at the start.
    size: Option<f64>,
    /// Elements at the start, and at most.
    elements: [usize; 2],
    /// Least scaled Jacobian that they must have more than.
    quality: f64,
}

impl Remeshes<3> for Dim<3> {
    fn fresh(_: &System<3>, _: &Model, _: usize, _: &Wish) -> Result<Fresh<3>, String> {
        Err("elements are made again in 2D only".into())
    }

    fn quality(_: &System<3>, _: usize) -> f64 {
        1.0
    }
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
        let done = (0..own.model.remeshes.len()).try_for_each(|index| self.remesh_part(&own, index));
        self.remesher = Some(own);
        done
    }

    /// Makes the elements of one part again, if they have become poor.
    fn remesh_part(&mut self, own: &Remesher, index: usize) -> Result<(), Error> {
        let rule = &own.model.remeshes[index];
        let Some(part) = own.model.parts.iter().position(|part| part.name == rule.part) else { return Ok(()) };
        let Some((reason, quality)) = self.reason(rule, index, part) else { return Ok(()) };
        let elements = [own.elements[part], rule.elements_most.unwrap_or(own.elements[part] as u64 * MOST) as usize];
        // Poor elements are exchanged for better ones; the others for any that are not poor.
        let wish = Wish { size: rule.size, elements, quality: quality.min(rule.quality) };
        match self.made_again(&own.model, part, &wish, (reason, quality))? {
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
            }
            Err(reason) => {
                let (step, time) = (self.system.step, self.system.time);
                if let Some(remap) = &mut self.system.remap {
                    remap.tried[index] = step;
                    remap.failures[index] += 1;
                    remap.refused = Some(format!("part \"{}\" at {time:.6e} s: {reason}", rule.part));
                }
            }
        }
        Ok(())
    }

    /// Why elements of a part are to be made again now, and their least scaled Jacobian; `None`: they are
    /// not.
    fn reason(&mut self, rule: &Remesh, index: usize, part: usize) -> Option<(&'static str, f64)> {
        let stable = self.stable_step_of(part);
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
        } else {
            (stable < rule.time_step * remap.reference[index]).then_some(("time_step", quality))
        }
    }

    /// Stable step of the elements of a part, s.
    fn stable_step_of(&self, part: usize) -> f64 {
        let of = self.system.mesh.groups.iter().zip(&self.system.reports).filter(|(group, _)| group.part == part);
        of.map(|(_, report)| report.time_step_squared).fold(f64::INFINITY, f64::min).sqrt()
    }

    /// The run continues with other elements of a part.
    fn made_again(
        &mut self,
        model: &Model,
        part: usize,
        wish: &Wish,
        (reason, quality): (&str, f64),
    ) -> Result<Result<Remeshing, String>, Error> {
        let before = (self.stable_step_of(part), self.system.mesh.elements_of(part));
        let mut fresh = match <Dim<D>>::fresh(&self.system, model, part, wish) {
            Ok(fresh) => fresh,
            Err(refused) => return Ok(Err(refused)),
        };
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
        let (linear, angular, sizes) = self.system.momentum_of(part, centre);
        let state =
            NewState { part, numbers: &fresh.numbers, between: &fresh.between, velocities: &fresh.velocities, points: &fresh.points };
        // From here on the old system is gone.
        let old = std::mem::replace(&mut self.system, system);
        let [kinetic_lost, elastic_lost] = self.system.take_over(old, &state)?;
        (self.recorded, self.monitor) = (recorded, monitor);
        self.hashing.renew(&self.system);
        let (linear_new, angular_new, _) = self.system.momentum_of(part, centre);
        let difference = crate::vector::minus(linear_new, linear);
        let fraction = |change: f64, size: f64| if size > 0.0 { change / size } else { 0.0 };
        Ok(Ok(Remeshing {
            time: self.system.time,
            step: self.system.step,
            part: model.parts[part].name.clone(),
            reason: reason.into(),
            elements: [before.1, self.system.mesh.elements_of(part)],
            quality: [quality, fresh.quality],
            time_step: [before.0, self.stable_step_of(part)],
            kinetic_lost,
            elastic_lost,
            mass_correction: fresh.correction,
            momentum_change: [
                fraction(crate::vector::dot(difference, difference).sqrt(), sizes[0]),
                fraction((angular_new - angular).abs(), sizes[1]),
            ],
            volume_change: fresh.volume_change,
        }))
    }

    /// What making elements again has to say at the end.
    pub(super) fn remeshing_notices(&self) -> Vec<Notice> {
        let Some(remap) = &self.system.remap else { return Vec::new() };
        let mut notices = Vec::new();
        let failures: u64 = remap.failures.iter().sum();
        if let (Some(refused), true) = (&remap.refused, failures > 0) {
            let text = format!(
                "elements could not be made again {failures} time(s), and the run continued with the old ones; the last: {refused}"
            );
            notices.push(Notice::new(&NOT_REMESHED, text));
        }
        let largest = self.system.ledger.largest;
        if largest > 0.0 && remap.energy.abs() > 0.01 * largest {
            let text = format!(
                "making elements again {} time(s) took {:.2} % of the largest total energy",
                remap.events.len(),
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
