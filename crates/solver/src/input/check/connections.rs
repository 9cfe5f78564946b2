//! Faults of welds and joints.

use super::Check;
use crate::load::messages::{CONNECTION, TO_ITSELF};
use crate::model::KINDS;
use crate::model::messages::{LIST_LENGTH, TWICE};
use crate::model::reference::Wanted;
use crate::vocabulary::excerpt;
use std::collections::BTreeSet;

impl Check<'_> {
    pub(super) fn connections(&mut self) {
        let model = self.model;
        self.names("weld", model.welds.iter().map(|weld| weld.name.as_str()));
        let mut taken = BTreeSet::new();
        for (index, weld) in model.welds.iter().enumerate() {
            let path = format!("weld[{index}]");
            let is_named = model.welds[..index].iter().any(|it| it.name == weld.name);
            for name in (0..weld.at.len()).map(|point| weld.name_of(point)) {
                if !taken.insert(name.clone()) && !is_named {
                    let message = format!("another weld has a point of the name `{}`", excerpt(&name));
                    self.fault(&TWICE, format!("{path}.name"), message, "give each its own name");
                }
            }
            self.sets(&path, &weld.between);
            if weld.at.is_empty() {
                self.fault(&LIST_LENGTH, format!("{path}.at"), "there is no point", "give one or more, such as `[[0.1, 0.2, 0]]`");
            }
            for (number, &point) in weld.at.iter().enumerate() {
                self.place(&format!("{path}.at[{number}]"), point);
            }
            if let Some(normal) = weld.normal {
                self.place(&format!("{path}.normal"), normal);
                self.direction(&format!("{path}.normal"), normal);
            }
            let limits = [
                ("radius", weld.radius),
                ("normal_strength", weld.normal_strength),
                ("shear_strength", weld.shear_strength),
                ("moment_strength", weld.moment_strength),
            ];
            for (key, value) in limits.into_iter().filter_map(|(key, value)| Some((key, value?))) {
                self.number(&format!("{path}.{key}"), value);
            }
            self.number(&format!("{path}.filter"), weld.filter);
            self.each(&format!("{path}.exponents"), &weld.exponents);
            if !matches!(weld.exponents.len(), 0 | 3) {
                let message = format!("there are {} exponents, not 3", weld.exponents.len());
                self.fault(&LIST_LENGTH, format!("{path}.exponents"), message, "give those of normal force, shear force and moment");
            }
            self.not_around(&path);
        }
        self.names("joint", model.joints.iter().map(|joint| joint.name.as_str()));
        for (index, joint) in model.joints.iter().enumerate() {
            let path = format!("joint[{index}]");
            self.sets(&path, &joint.between);
            if !(1..=2).contains(&joint.between.len()) {
                let message = format!("it names {} sets", joint.between.len());
                self.fault(&LIST_LENGTH, format!("{path}.between"), message, "name two sets, or one that is joined to the ground");
            }
            self.known(&format!("{path}.kind"), "kind of joint", &joint.kind, &KINDS);
            self.place(&format!("{path}.at"), joint.at);
            self.direction(&format!("{path}.axis"), joint.axis);
            if model.dimension() == 2 && joint.kind == "cylindrical" {
                let help = "take `revolute` or `translational`";
                self.fault(&CONNECTION, format!("{path}.kind"), "in 2D nothing slides along the axis about which it turns", help);
            }
            if model.dimension() == 2 && joint.kind == "revolute" && joint.axis[..2] != [0.0; 2] {
                self.fault(&CONNECTION, format!("{path}.axis"), "in 2D all turns about z", "leave the axis out");
            }
            if model.dimension() == 2 && joint.kind == "translational" && joint.axis[2] != 0.0 {
                let help = "give the direction in the plane, such as `axis = [1, 0]`";
                self.fault(&CONNECTION, format!("{path}.axis"), "in 2D nothing slides along z", help);
            }
            if let Some(radius) = joint.radius {
                self.number(&format!("{path}.radius"), radius);
            }
            self.not_around(&path);
        }
    }

    /// The two sets of a connection.
    fn sets(&mut self, path: &str, between: &[String]) {
        for (side, name) in between.iter().enumerate() {
            self.reference(&format!("{path}.between[{side}]"), name, Wanted::Nodes);
        }
        if let [one, other] = between
            && one == other
        {
            let message = format!("`{}` would be connected to itself", excerpt(one));
            self.fault(&TO_ITSELF, format!("{path}.between"), message, "name two sets");
        }
    }

    /// A point or direction: in 2D without z.
    fn place(&mut self, path: &str, x: [f64; 3]) {
        self.vector(path, x);
        if self.model.dimension() == 2 && x[2] != 0.0 {
            self.fault(&CONNECTION, path, "the model is 2D, but this has a z", "leave it out");
        }
    }

    /// Axisymmetric models have no points off the axis.
    fn not_around(&mut self, path: &str) {
        if self.model.is_axisymmetric() {
            let message = "in an axisymmetric model a point is a circle, which can't rotate as a point does";
            self.fault(&CONNECTION, path, message, "bind the surfaces by a tied contact, or nodes by a join");
        }
    }
}
