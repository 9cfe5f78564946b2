//! Faults of loads, boundaries that reflect nothing, and joins.

use super::Check;
use crate::load::messages::{FORCE_ON_PART, NO_EFFECT, RIGID, TO_ITSELF};
use crate::material;
use crate::material::messages::NO_STIFFNESS;
use crate::mesh::messages::SHELLS;
use crate::model::messages::{OF_REVOLUTION, TWICE};
use crate::model::reference::{Reference, Wanted};
use crate::model::{Drive, Image, Load};
use crate::quantity::{Dimension, Range};
use crate::vocabulary::excerpt;

impl Check<'_> {
    pub(super) fn loads(&mut self) {
        let model = self.model;
        for (index, load) in model.loads.iter().enumerate() {
            let path = format!("load[{index}]");
            match load {
                Load::Gravity { parts, acceleration, curve } => {
                    self.part_list(&format!("{path}.parts"), parts);
                    self.vector(&format!("{path}.gravity"), *acceleration);
                    if model.is_axisymmetric() && acceleration[0] != 0.0 {
                        let message = "gravity across the axis of an axisymmetric model would pull it to one side";
                        self.fault(
                            &OF_REVOLUTION,
                            format!("{path}.gravity[0]"),
                            message,
                            "let it act along the axis y, such as [0, \"-9.81 m/s^2\"]",
                        );
                    }
                    self.factor(&path, curve);
                }
                Load::Centrifugal { parts, about, speed, curve } => {
                    self.part_list(&format!("{path}.parts"), parts);
                    self.axis(&path, about);
                    self.number(&format!("{path}.centrifugal"), *speed);
                    if model.is_axisymmetric() && about.centre != [0.0; 3] {
                        let message = "an axisymmetric model turns about its axis, x = 0";
                        self.fault(&OF_REVOLUTION, format!("{path}.centre"), message, "leave `centre` out");
                    }
                    self.factor(&path, curve);
                }
                Load::Force { on, force, curve } => {
                    if let Some(Reference::Part(_)) = self.reference(&format!("{path}.on"), on, Wanted::Nodes) {
                        let message = format!("`{}` is a part, but a force acts on a set of its nodes", excerpt(on));
                        self.fault(
                            &FORCE_ON_PART,
                            format!("{path}.on"),
                            message,
                            "name a side as part.side or a group; `gravity` acts on whole parts",
                        );
                    }
                    self.vector(&format!("{path}.force"), *force);
                    self.factor(&path, curve);
                }
                Load::Moment { on, moment, curve } => {
                    let found = self.reference(&format!("{path}.on"), on, Wanted::Nodes);
                    self.rotates(&format!("{path}.on"), found.as_ref());
                    self.vector(&format!("{path}.moment"), *moment);
                    self.factor(&path, curve);
                }
                Load::Pressure { on, pressure, curve } => {
                    self.reference(&format!("{path}.on"), on, Wanted::Surface);
                    self.number(&format!("{path}.pressure"), *pressure);
                    self.factor(&path, curve);
                }
                Load::Damping { parts, rate, active } => {
                    self.part_list(&format!("{path}.parts"), parts);
                    self.number(&format!("{path}.damping"), *rate);
                    self.window(&path, ["from", "until"], *active);
                }
                Load::StiffnessDamping { parts, time } => {
                    self.part_list(&format!("{path}.parts"), parts);
                    self.number(&format!("{path}.damping_stiffness"), *time);
                    self.stiffness_damped(&format!("{path}.damping_stiffness"), parts);
                }
            }
        }
    }

    /// Parts that are damped by their stiffness need one: the same in all directions, in rate form.
    fn stiffness_damped(&mut self, path: &str, parts: &[String]) {
        let model = self.model;
        let deform = model.parts.iter().filter(|part| part.rigid.is_none() && (parts.is_empty() || parts.contains(&part.name)));
        for part in deform {
            let Some(material) = model.materials.get(&part.material) else { continue };
            if material::has_elastic_stiffness(&material.law) == Some(false) {
                let message = format!("part `{}` is of law `{}`", excerpt(&part.name), material.law);
                let help = "this damping takes isotropic solids in rate form such as `elastic` and `j2`: name those \
                    in `parts`; rubber is damped by `damping`, or as `viscoelastic`";
                self.fault(&NO_STIFFNESS, path, message, help);
            }
        }
    }

    /// A curve by which a load is multiplied.
    pub(super) fn factor(&mut self, path: &str, curve: &Option<String>) {
        if let Some(name) = curve {
            self.drive(&format!("{path}.curve"), &Drive::Curve(name.clone()), Dimension::NONE);
        }
    }

    pub(super) fn non_reflecting(&mut self) {
        let model = self.model;
        for (index, boundary) in model.non_reflecting.iter().enumerate() {
            let path = format!("non_reflecting[{index}].on");
            if let Some(Reference::Part(part) | Reference::Side { part, .. }) = self.reference(&path, &boundary.on, Wanted::Surface) {
                let part = &model.parts[part];
                if part.rigid.is_some() {
                    let message = format!("part `{}` is rigid, so no waves meet this boundary", excerpt(&part.name));
                    self.fault(&RIGID, path.as_str(), message, "name a surface of a part that deforms");
                } else if part.has_rotations() {
                    let what = if part.is_of_shells() { "a shell" } else { "made of beams" };
                    let message = format!("part `{}` is {what}: no waves come through its faces", excerpt(&part.name));
                    self.fault(&SHELLS, path.as_str(), message, "name a surface of solids");
                }
            }
            if let Some(first) = model.non_reflecting[..index].iter().position(|it| it.on == boundary.on) {
                let message = format!("`{}` reflects nothing by non_reflecting[{first}] already", excerpt(&boundary.on));
                self.fault(&TWICE, path, message, "name it once");
            }
        }
    }

    pub(super) fn joins(&mut self) {
        let model = self.model;
        for (index, join) in model.joins.iter().enumerate() {
            let path = format!("join[{index}]");
            for (side, name) in join.between.iter().enumerate() {
                if let Some(Reference::Part(part) | Reference::Side { part, .. }) =
                    self.reference(&format!("{path}.between[{side}]"), name, Wanted::Nodes)
                    && model.parts[part].rigid.is_some()
                {
                    let message = format!("part `{}` is rigid, so its nodes can't be joined one by one", excerpt(&model.parts[part].name));
                    self.fault(&RIGID, format!("{path}.between[{side}]"), message, "a tied contact binds others to rigid parts");
                }
            }
            match join.image {
                Image::Same => {}
                Image::Translated(by) => {
                    self.vector(&format!("{path}.translation"), by);
                    if model.is_axisymmetric() && by[0] != 0.0 {
                        let message = "nodes of an axisymmetric model at different radii can't move as one";
                        self.fault(
                            &OF_REVOLUTION,
                            format!("{path}.translation[0]"),
                            message,
                            "join sets that lie one above the other along y",
                        );
                    }
                    if by == [0.0; 3] {
                        self.fault(
                            &NO_EFFECT,
                            format!("{path}.translation"),
                            "the translation is zero",
                            "leave it out where the sets coincide",
                        );
                    }
                }
                Image::Turned { about, angle } => {
                    self.axis(&path, &about);
                    self.number(&format!("{path}.rotation"), angle);
                    if model.is_axisymmetric() {
                        let message = "an axisymmetric model has no sectors: it is the same all around already";
                        self.fault(&OF_REVOLUTION, format!("{path}.rotation"), message, "leave it out, or join by a translation along y");
                    }
                    if angle == 0.0 {
                        self.fault(&NO_EFFECT, format!("{path}.rotation"), "the rotation is zero", "leave it out where the sets coincide");
                    }
                }
            }
            if let Some(tolerance) = join.tolerance {
                self.within(&format!("{path}.tolerance"), tolerance, Dimension::LENGTH, Range::Positive);
            }
            if join.between[0] == join.between[1] {
                let message = format!("`{}` is joined to itself", excerpt(&join.between[0]));
                self.fault(&TO_ITSELF, format!("{path}.between"), message, "name two sets");
            }
        }
    }
}
