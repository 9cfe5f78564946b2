//! A model in 3D has nothing that only the plane knows: segments, circles, polylines, ends of lines. Reported
//! where they are written, before anything is meshed.

use super::Check;
use crate::model::messages::NOT_IN_SPACE;
use crate::model::{Formulation, ObstacleShape};

impl Check<'_> {
    /// Faults of what only the plane has.
    pub(super) fn nothing_of_2d_alone(&mut self) {
        let model = self.model;
        for (index, contact) in model.contacts.iter().enumerate() {
            if contact.formulation == Formulation::Segment {
                let message = "in 3D there are no segments: nodes meet facets, and edges meet edges";
                self.fault(
                    &NOT_IN_SPACE,
                    format!("contact[{index}].formulation"),
                    message,
                    "take `double_pass`, `single_pass` or `pinball`",
                );
            }
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
