//! Faults of springs and point masses.

use super::Check;
use crate::load::messages::TO_ITSELF;
use crate::model::messages::LIST_LENGTH;
use crate::model::reference::Wanted;
use crate::vocabulary::excerpt;

impl Check<'_> {
    pub(super) fn springs(&mut self) {
        let model = self.model;
        for (index, spring) in model.springs.iter().enumerate() {
            let path = format!("spring[{index}]");
            for (side, name) in spring.between.iter().enumerate() {
                self.reference(&format!("{path}.between[{side}]"), name, Wanted::Nodes);
            }
            if spring.between[0] == spring.between[1] {
                let message = format!("`{}` would be bound to itself", excerpt(&spring.between[0]));
                self.fault(&TO_ITSELF, format!("{path}.between"), message, "name two sets");
            }
            if spring.stiffness != 0.0 {
                self.number(&format!("{path}.stiffness"), spring.stiffness);
            }
            self.number(&format!("{path}.damping"), spring.damping);
            let optional = [("length", spring.length), ("strength", spring.strength)];
            for (key, value) in optional.into_iter().filter_map(|(key, value)| Some((key, value?))) {
                self.number(&format!("{path}.{key}"), value);
            }
            let (elongations, forces) = (format!("{path}.elongation"), format!("{path}.force"));
            self.each(&elongations, &spring.elongation);
            self.each(&forces, &spring.force);
            self.ascending(&elongations, "elongations", &spring.elongation, "m");
            if spring.elongation.len() != spring.force.len() {
                let message = format!("there are {} elongations, but {} forces", spring.elongation.len(), spring.force.len());
                self.fault(&LIST_LENGTH, forces, message, "give one force for each elongation");
            }
        }
    }

    pub(super) fn point_masses(&mut self) {
        let model = self.model;
        for (index, mass) in model.point_masses.iter().enumerate() {
            let path = format!("point_mass[{index}]");
            self.reference(&format!("{path}.on"), &mass.on, Wanted::Nodes);
            self.number(&format!("{path}.mass"), mass.mass);
        }
    }
}
