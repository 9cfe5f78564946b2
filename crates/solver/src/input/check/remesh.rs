//! Faults of what makes elements again in the run: what it can't do yet is said before anything runs.

use super::Check;
use crate::material;
use crate::model::messages::{NO_REMESHING, TWICE};
use crate::model::{Model, ObstacleShape, Part, Probe, ProbeAt, StableStep};
use crate::vocabulary::excerpt;

/// Elements of quadrilaterals whose state goes over.
const ELEMENTS: [&str; 2] = ["quad4", "quad4_reduced"];

/// What a model has that can't be where elements are made again: its section, what it is, and what to do.
fn in_the_way(model: &Model) -> Option<[&'static str; 3]> {
    let leave = "leave it out, or leave out `[[remesh]]`";
    let is_polyline = |shape: &ObstacleShape| matches!(shape, ObstacleShape::Polyline { .. });
    let found = [
        (model.dimension() == 3, ["remesh[0]", "the model is a 3D one", "make it a 2D model: plane or axisymmetric"]),
        (!model.contacts.is_empty(), ["contact[0]", "the model has a contact between bodies", "make the other body an `[[obstacle]]`"]),
        (
            model.obstacles.iter().any(|own| is_polyline(&own.shape)),
            ["obstacle[0]", "an obstacle is a polyline", "make it of planes and circles"],
        ),
        (!model.stages.is_empty(), ["stage[0]", "the run has stages", leave]),
        (model.run.relaxation.is_some(), ["run.relaxation", "the run is relaxed", leave]),
        (model.run.mass_scaling.is_some(), ["run.mass_scaling", "mass is scaled", leave]),
        (model.run.subcycling, ["run.subcycling", "elements have steps of their own", leave]),
        (
            model.run.stable_step != StableStep::Elements,
            ["run.stable_step", "the stable step is not that of single elements", "take `\"elements\"`"],
        ),
        (!model.joins.is_empty(), ["join[0]", "nodes are joined", leave]),
        (!model.springs.is_empty(), ["spring[0]", "the model has springs", leave]),
        (!model.point_masses.is_empty(), ["point_mass[0]", "the model has point masses", leave]),
        (!model.cavities.is_empty(), ["cavity[0]", "the model has a cavity", leave]),
        (!model.non_reflecting.is_empty(), ["non_reflecting[0]", "a boundary reflects nothing", leave]),
        (!model.cuts.is_empty(), ["cut[0]", "the model has cuts", leave]),
        (!model.welds.is_empty() || !model.joints.is_empty(), ["weld[0]", "the model has welds or joints", leave]),
    ];
    found.into_iter().find(|(is_there, _)| *is_there).map(|(_, words)| words)
}

impl Check<'_> {
    pub(super) fn remeshes(&mut self) {
        let model = self.model;
        let known: Vec<&str> = model.parts.iter().map(|part| part.name.as_str()).collect();
        for (index, own) in model.remeshes.iter().enumerate() {
            let path = format!("remesh[{index}]");
            self.known(&format!("{path}.part"), "part", &own.part, &known);
            for (key, value) in
                [("quality", own.quality), ("time_step", own.time_step), ("begin", own.begin), ("loss_limit", own.loss_limit)]
            {
                self.number(&format!("{path}.{key}"), value);
            }
            for (key, value) in [("size", own.size), ("interval", own.interval)] {
                value.into_iter().for_each(|value| self.number(&format!("{path}.{key}"), value));
            }
            if model.remeshes[..index].iter().any(|other| other.part == own.part) {
                let message = format!("elements of part `{}` are made again by two sections", excerpt(&own.part));
                self.fault(&TWICE, format!("{path}.part"), message, "leave one of them out");
            }
            if let Some(place) = model.parts.iter().position(|part| part.name == own.part) {
                self.remeshed_part(&path, place);
            }
        }
        if let Some([section, what, help]) = in_the_way(model).filter(|_| !model.remeshes.is_empty()) {
            self.fault(&NO_REMESHING, section, format!("{what}, and elements are made again (`[[remesh]]`)"), help);
        }
        if !model.remeshes.is_empty() {
            let lines = |part: &Part| part.is_of_lines() || part.has_rotations() || part.rigid.is_some();
            for (place, part) in model.parts.iter().enumerate().filter(|(_, part)| lines(part)) {
                let message = format!("part `{}` is rigid, or of bars, shells or beams, and elements are made again", excerpt(&part.name));
                self.fault(&NO_REMESHING, format!("part[{place}]"), message, "make rigid bodies obstacles; leave out the others");
            }
            // Elements that have failed, and the energy that went with them, do not go over to the new mesh.
            let fails = |part: &Part| model.materials.get(&part.material).is_some_and(|own| !own.failure.is_empty());
            for (place, part) in model.parts.iter().enumerate().filter(|(_, part)| fails(part)) {
                let message = format!("elements of part `{}` may fail, and elements are made again", excerpt(&part.name));
                self.fault(&NO_REMESHING, format!("part[{place}].material"), message, "leave out `failure`, or `[[remesh]]`");
            }
        }
    }

    fn remeshed_part(&mut self, path: &str, place: usize) {
        let (model, part) = (self.model, &self.model.parts[place]);
        let name = excerpt(&part.name);
        let mut fault = |what: String, help: &str| self.fault(&NO_REMESHING, format!("{path}.part"), what, help);
        if !ELEMENTS.contains(&part.element.as_str()) {
            fault(format!("elements of part `{name}` are `{}`", part.element), "take `quad4` or `quad4_reduced`");
        }
        if part.stress_state == "plane_stress" {
            fault(format!("part `{name}` is in plane stress"), "take plane strain or an axisymmetric part");
        }
        if part.mass_scale != 1.0 {
            fault(format!("part `{name}` has a `mass_scale`"), "leave it out");
        }
        if model.stiffness_damping(part) > 0.0 {
            fault(format!("part `{name}` is damped in proportion to its stiffness"), "leave out `damping_stiffness`");
        }
        let by_number =
            |probe: &Probe| matches!(&probe.at, ProbeAt::Node { part: own, .. } | ProbeAt::Element { part: own, .. } if *own == part.name);
        if let Some(probe) = model.probes.iter().find(|probe| by_number(probe)) {
            fault(format!("probe `{}` names a node or an element of part `{name}` by its number", excerpt(&probe.name)), "name a `point`");
        }
        let Some(material) = model.materials.get(&part.material) else { return };
        if material::can_be_averaged(&material.law) == Some(false) || !material.eos.is_empty() {
            let what =
                if material.eos.is_empty() { format!("law `{}`", material.law) } else { format!("equation of state `{}`", material.eos) };
            fault(format!("the {what} of part `{name}` can't continue with means of what other points have"), HELP_LAWS);
        }
    }
}

const HELP_LAWS: &str = "take `elastic`, a law of the family `j2`, `johnson_cook`, `chaboche`, `drucker_prager` or `crushable_foam`";
