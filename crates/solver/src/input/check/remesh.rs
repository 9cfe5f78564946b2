//! Faults of what makes elements again in the run: what it can't do yet is said before anything runs.

use super::Check;
use crate::contact::formulation::kind_of;
use crate::error::Fault;
use crate::material;
use crate::model::messages::{NO_REMESHING, TWICE};
use crate::model::{Contact, Model, Probe, ProbeAt, Rule, StableStep};
use crate::vocabulary::excerpt;

/// Elements of quadrilaterals whose state goes over. Those in 3D are looked at when the mesh is there.
const ELEMENTS: [&str; 2] = ["quad4", "quad4_reduced"];

/// What a model has that can't be where elements are made again: its section, what it is, and what to do.
fn in_the_way(model: &Model) -> Option<[&'static str; 3]> {
    let leave = "leave it out, or the new elements";
    let found = [
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

impl Model {
    /// Why the state of a part can't go over to other elements; empty: it can. Elements themselves, which the
    /// mesh has, are not looked at.
    pub(crate) fn check_exchange(&self, part: usize) -> Vec<Fault> {
        let mut check = Check { model: self, faults: Vec::new() };
        check.remeshed_part(&format!("part[{part}]"), part);
        check.beside_remeshes();
        check.faults
    }
}

impl Check<'_> {
    pub(super) fn remeshes(&mut self) {
        let model = self.model;
        let known: Vec<&str> = model.parts.iter().map(|part| part.name.as_str()).collect();
        let rules = model.rules_of_remeshing();
        for (index, Rule { path, of: own, relocates }) in rules.iter().enumerate() {
            self.known(&format!("{path}.part"), "part", &own.part, &known);
            for (key, value) in
                [("quality", own.quality), ("time_step", own.time_step), ("begin", own.begin), ("loss_limit", own.loss_limit)]
            {
                self.number(&format!("{path}.{key}"), value);
            }
            let optional = [
                ("size", own.size),
                ("size_contact", own.size_contact),
                ("strain_change", own.strain_change),
                ("stress_error", own.stress_error),
                ("size_least", own.size_least),
                ("interval", own.interval),
            ];
            for (key, value) in optional {
                value.into_iter().for_each(|value| self.number(&format!("{path}.{key}"), value));
            }
            if rules[..index].iter().any(|other| other.of.part == own.part && other.relocates == *relocates) {
                let what = if *relocates { "nodes of part `{}` are moved" } else { "elements of part `{}` are made again" };
                let message = format!("{} by two sections", what.replace("{}", &excerpt(&own.part)));
                self.fault(&TWICE, format!("{path}.part"), message, "leave one of them out");
            }
            if let Some(place) = model.parts.iter().position(|part| part.name == own.part) {
                self.remeshed_part(path, place);
            }
        }
        self.flows(&known);
        if model.is_remeshed() {
            self.beside_remeshes();
        }
    }

    /// Parts that material flows through.
    fn flows(&mut self, known: &[&str]) {
        let model = self.model;
        for (index, own) in model.flows.iter().enumerate() {
            let path = &format!("flow[{index}]");
            self.known(&format!("{path}.part"), "part", &own.part, known);
            for (key, value) in [("begin", own.begin), ("travel", own.travel), ("steady", own.steady), ("loss_limit", own.loss_limit)] {
                self.number(&format!("{path}.{key}"), value);
            }
            let name = excerpt(&own.part);
            let rules = model.rules_of_remeshing();
            if model.flows[..index].iter().any(|other| other.part == own.part) || rules.iter().any(|other| other.of.part == own.part) {
                let message = format!("nodes of part `{name}` are moved by two sections");
                self.fault(&TWICE, format!("{path}.part"), message, "leave one of them out");
            }
            let Some(place) = model.parts.iter().position(|part| part.name == own.part) else { continue };
            let part = &model.parts[place];
            let [x, y, z] = own.direction_of(part);
            let is_axial = x == 0.0 && y != 0.0;
            if !([x, y, z].iter().all(|own| own.is_finite()) && (x != 0.0 || y != 0.0)) {
                let (message, help) = (format!("the direction of the flow through part `{name}` is not known"), "give `direction`");
                self.fault(&NO_REMESHING, format!("{path}.direction"), message, help);
            } else if part.stress_state == "axisymmetric" && !is_axial {
                let message = format!("part `{name}` is axisymmetric, and its flow is not along the axis");
                self.fault(&NO_REMESHING, format!("{path}.direction"), message, "take `[0, 1]` or `[0, -1]`");
            }
            self.remeshed_part(path, place);
            let material = model.materials.get(&part.material);
            if let Some(law) = material.map(|own| &own.law).filter(|law| material::is_hyperelastic(law) == Some(true)) {
                let message = format!("law `{law}` of part `{name}` knows a state without stress, which what comes in has not");
                self.fault(&NO_REMESHING, format!("{path}.part"), message, "take a law of a metal");
            }
        }
    }

    /// What can't stand beside sections in a 3D model.
    fn beside_remeshes_in_3d(&mut self) {
        let model = self.model;
        if let Some(Rule { path, .. }) = model.rules_of_remeshing().iter().find(|rule| !rule.relocates) {
            let help = "take `[[relocate]]`, which moves nodes of a 3D part, or make it a 2D model: plane or axisymmetric";
            self.fault(&NO_REMESHING, path, "the model is a 3D one, and elements are made again in 2D only", help);
        }
    }

    /// What stands beside sections that make elements again.
    fn beside_remeshes(&mut self) {
        let model = self.model;
        if model.dimension() == 3 {
            self.beside_remeshes_in_3d();
        }
        if let Some([section, what, help]) = in_the_way(model) {
            self.fault(&NO_REMESHING, section, format!("{what}, and elements are made again"), help);
        }
        let is_carried = |own: &Contact| own.tied.is_none() && kind_of(own).is_none_or(|kind| kind.is_carried);
        for (index, own) in model.contacts.iter().enumerate().filter(|(_, own)| !is_carried(own)) {
            let (name, tied) = (own.formulation.name(), own.tied.is_some());
            let (key, what) = if tied { ("tied", "ties surfaces".into()) } else { ("formulation", format!("is a `{name}` one")) };
            let message = format!("contact `{}` {what}, and elements are made again", excerpt(&own.name));
            let help = if tied { "leave out the new elements" } else { "take `double_pass` or `single_pass`" };
            self.fault(&NO_REMESHING, format!("contact[{index}].{key}"), message, help);
        }
        for (place, part) in model.parts.iter().enumerate().filter(|(_, part)| part.is_of_lines() || part.has_rotations()) {
            let message = format!("part `{}` is of bars, shells or beams, and elements are made again", excerpt(&part.name));
            self.fault(&NO_REMESHING, format!("part[{place}]"), message, "leave it out, or the new elements");
        }
    }

    fn remeshed_part(&mut self, path: &str, place: usize) {
        let (model, part) = (self.model, &self.model.parts[place]);
        let name = excerpt(&part.name);
        let mut fault = |what: String, help: &str| self.fault(&NO_REMESHING, format!("{path}.part"), what, help);
        let is_in_3d = model.dimension() == 3;
        if !is_in_3d && !ELEMENTS.contains(&part.element.as_str()) {
            fault(format!("elements of part `{name}` are `{}`", part.element), "take `quad4` or `quad4_reduced`");
        }
        if part.stress_state == "plane_stress" {
            fault(format!("part `{name}` is in plane stress"), "take plane strain or an axisymmetric part");
        }
        if part.rigid.is_some() {
            fault(format!("part `{name}` is rigid"), "take the section out");
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
        if !material.failure.is_empty() {
            fault(format!("elements of part `{name}` may fail"), "leave out `failure`, or take the section out");
        }
        if material::can_be_averaged(&material.law) == Some(false) || !material.eos.is_empty() {
            let what =
                if material.eos.is_empty() { format!("law `{}`", material.law) } else { format!("equation of state `{}`", material.eos) };
            fault(format!("the {what} of part `{name}` can't continue with means of what other points have"), HELP_LAWS);
        } else if is_in_3d && material::is_hyperelastic(&material.law) == Some(true) {
            let what =
                format!("law `{}` of part `{name}` has its stress from the whole deformation, which goes over in 2D only", material.law);
            fault(what, "leave the section out");
        }
    }
}

const HELP_LAWS: &str =
    "take `elastic`, a law of the family `j2`, `johnson_cook`, `chaboche`, `drucker_prager`, `crushable_foam` or a rubber";
