//! A model in 3D has nothing that only the plane knows: contact formulations of 2D, circles, polylines, ends
//! of lines. Reported where they are written, before anything is meshed.

use super::Check;
use crate::contact::formulation::FORMULATIONS;
use crate::error::Fault;
use crate::model::ObstacleShape;
use crate::model::messages::NOT_IN_SPACE;

impl Check<'_> {
    /// Faults of what only the plane has.
    pub(super) fn nothing_of_2d_alone(&mut self) {
        let model = self.model;
        for (index, contact) in model.contacts.iter().enumerate() {
            let kind = FORMULATIONS.iter().find(|kind| kind.name == contact.formulation.name());
            let refusal = kind.and_then(|kind| kind.refusal(3));
            self.faults.extend(refusal.map(|fault| Fault { path: format!("contact[{index}].{}", fault.path), ..fault }));
        }
        for (index, obstacle) in model.obstacles.iter().enumerate() {
            let (key, message, help) = match &obstacle.shape {
                ObstacleShape::Plane { length: Some(_), .. } => ("plane.length", "a plane in 3D has no end", "leave `length` out"),
                ObstacleShape::Circle { .. } => ("circle", "there are no circles in 3D", "take `sphere` or `cylinder`"),
                ObstacleShape::Polyline { .. } => {
                    ("polyline", "there are no polylines in 3D", "take `plane`, `sphere`, `cylinder` or `stl`, or a rigid part")
                }
                _ => continue,
            };
            self.fault(&NOT_IN_SPACE, format!("obstacle[{index}].{key}"), message, help);
        }
    }
}
