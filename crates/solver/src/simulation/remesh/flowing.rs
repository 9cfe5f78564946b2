//! Parts that material flows through: their nodes go with the material and back to their places before they
//! are an element away (`[[flow]]`).

use super::super::Runs;
use super::super::run::Run;
use super::{Change, Places, Remesher, Remeshes};
use crate::error::{Error, FLOW_STATE, NOT_REMESHED, Notice};
use crate::step::flow::Flow;
use crate::tensor::Dim;

/// Widths of an element that nodes may be away from their places where they can't go back.
const LOST: f64 = 2.0;

impl<const D: usize> Run<D>
where
    Dim<D>: Runs<D>,
{
    /// Lets nodes of a part go back to their places, if they are far enough from them. Returns whether they
    /// have.
    ///
    /// # Errors
    /// They can't, and are too far away; more energy was lost by it than the model allows.
    pub(super) fn flow_on(&mut self, own: &Remesher, index: usize) -> Result<bool, Error> {
        let rule = &own.flows[index];
        let Some(part) = own.model.parts.iter().position(|part| part.name == rule.part) else { return Ok(false) };
        let system = &mut self.system;
        if system.time < rule.begin {
            return Ok(false);
        }
        let Some(remap) = &mut system.remap else { return Ok(false) };
        let flow = &mut remap.flows[index];
        let direction = rule.direction_of(&own.model.parts[part]);
        let direction = std::array::from_fn(|d| direction[d]);
        if flow.places.is_empty() {
            let mut nodes = system.mesh.parts[part].nodes.clone();
            nodes.sort_unstable();
            let places: Vec<[f64; D]> = nodes.into_iter().map(|node| system.positions[node as usize]).collect();
            flow.places = places.as_flattened().to_vec();
            let begins = Places { part, direction, places, inflow: Vec::new() };
            match (<Dim<D>>::inflow(system, &own.model, &begins), &mut system.remap) {
                (Ok(inflow), Some(remap)) => remap.flows[index].inflow = inflow,
                (Err(reason), _) => return Err(self.stuck(&rule.part, reason)),
                _ => (),
            }
            return Ok(false);
        }
        let places = Places { part, direction, places: flow.places.as_chunks().0.to_vec(), inflow: flow.inflow.clone() };
        let refused = match <Dim<D>>::travel(&self.system, &own.model, &places) {
            Ok(travel) if travel < rule.travel => return Ok(false),
            Ok(travel) => match self.put_back(own, &places)? {
                Ok((change, fresh)) => return self.note_flow(own, index, change, fresh).map(|()| true),
                Err(refused) if travel < LOST => refused,
                Err(reason) => return Err(self.stuck(&rule.part, reason)),
            },
            Err(reason) => return Err(self.stuck(&rule.part, reason)),
        };
        if let Some(remap) = &mut self.system.remap {
            remap.flows[index].failures += 1;
            remap.refused = Some(format!("part \"{}\" at {:.6e} s: {refused}", rule.part, self.system.time));
        }
        Ok(false)
    }

    fn stuck(&self, part: &str, reason: String) -> Error {
        Error::Stuck { part: part.into(), reason, time: self.system.time, step: self.system.step }
    }

    /// The run continues with nodes at their places; inside: why it can't.
    fn put_back(&mut self, own: &Remesher, places: &Places<D>) -> Result<Result<(Change, Gone<D>), String>, Error> {
        let fresh = match <Dim<D>>::returned(&self.system, &own.model, places) {
            Ok(fresh) => fresh,
            Err(refused) => return Ok(Err(refused)),
        };
        let Some(exchange) = fresh.exchange.clone() else { return Ok(Err("nothing has flowed".into())) };
        let gone = Gone { exchange, correction: fresh.correction };
        Ok(self.continue_with(&own.model, places.part, fresh)?.map(|change| (change, gone)))
    }

    /// Notes what it has cost, and what has come in and gone out; ends a run that is steady.
    fn note_flow(&mut self, own: &Remesher, index: usize, change: Change, gone: Gone<D>) -> Result<(), Error> {
        let (rule, time, step, largest) = (&own.flows[index], self.system.time, self.system.step, self.system.ledger.largest);
        let Some(remap) = &mut self.system.remap else { return Ok(()) };
        let flow = &mut remap.flows[index];
        flow.kinetic_lost += change.kinetic_lost;
        flow.elastic_lost += change.elastic_lost;
        flow.mass_correction = flow.mass_correction.max(gone.correction);
        (0..2).for_each(|k| flow.momentum_change[k] = flow.momentum_change[k].max(change.momentum[k]));
        flow.note(gone.exchange, rule.steady, time);
        let is_steady = |(rule, flow): (&crate::model::Flow, &Flow)| !rule.stop || flow.steady.is_some();
        let ends = own.flows.iter().any(|rule| rule.stop) && own.flows.iter().zip(&remap.flows).all(is_steady);
        let lost = remap.energy;
        if ends {
            self.system.limits.end = time;
        }
        if lost > rule.loss_limit * largest {
            return Err(Error::RemeshLoss { part: rule.part.clone(), lost: lost / largest, limit: rule.loss_limit, time, step });
        }
        Ok(())
    }

    /// What flows have to say at the end.
    pub(super) fn flow_notices(&self) -> Vec<Notice> {
        let flows = self.system.remap.as_ref().map_or(&[][..], |remap| &remap.flows);
        let mut notices = Vec::new();
        for flow in flows {
            let passed = format!("material has passed part \"{}\" {:.2} time(s)", flow.part, flow.passages);
            let text = match (flow.steady, flow.change.map(|change| 100.0 * change)) {
                (Some(time), Some(change)) => format!("{passed}; its state is steady since {time:.6e} s, and now changes by {change:.2} %"),
                (None, Some(change)) => {
                    format!("{passed}; its state is not steady: over a quarter of a passage it changes by {change:.1} %")
                }
                (_, None) => format!("{passed}, which is too little to know whether its state is steady"),
            };
            notices.push(Notice::new(&FLOW_STATE, text));
            if let (Some(refused), true) = (self.system.remap.as_ref().and_then(|remap| remap.refused.as_ref()), flow.failures > 0) {
                let text = format!("nodes of a flow could not go back to their places {} time(s); the last: {refused}", flow.failures);
                notices.push(Notice::new(&NOT_REMESHED, text));
            }
        }
        notices
    }
}

/// What has gone through a part.
struct Gone<const D: usize> {
    exchange: crate::step::flow::Exchange<D>,
    correction: f64,
}
