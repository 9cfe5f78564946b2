//! Obstacles in 3D at the start: who is inside them, and what pushes them out.

use super::super::Builder;
use super::{AtStart, Meeting};
use crate::contact::initial::{Inside, Penetration};
use crate::model::{InitialPenetration, Obstacle, ObstacleShape};
use crate::vector::minus;

impl Builder<'_, 3> {
    /// What is inside an obstacle at the start. Wrong parts and shapes are reported when obstacles are made.
    pub(crate) fn obstacle_at_start_in_3d(&self, obstacle: &Obstacle, tolerance: f64) -> Option<AtStart<3>> {
        let outside = self.outside_met(obstacle).ok()?;
        let is_pushed = obstacle.interface.initial_penetration == InitialPenetration::PushOut;
        if let ObstacleShape::Triangles(surface) = &obstacle.shape {
            // What counts as zero is found when all else has been pushed out.
            if !is_pushed {
                return None;
            }
            let look = || self.look_at_triangles(surface, outside.clone(), obstacle.interface.thickness);
            let found = self.penetrations_of_triangles(surface, look(), tolerance);
            return Some((found, vec![Meeting::Surfaces { contact: None, look: look(), points: surface.positions.clone() }]));
        }
        let (reference, solid, _) = self.solid(obstacle).ok()?;
        let nodes = self.nodes_pressed(obstacle, &outside);
        let inside = |&node: &u32| {
            let place = self.mesh.positions[node as usize];
            let depth = -solid.distance(minus(place, reference)).0;
            (depth > tolerance).then_some(Penetration { what: Inside::Node, place, depth })
        };
        let found = nodes.iter().filter_map(inside).collect();
        let distance = move |x| Some(solid.distance(minus(x, reference)));
        let meeting = is_pushed.then(|| Meeting::Shape { nodes, distance: Box::new(distance) });
        Some((found, meeting.into_iter().collect()))
    }
}
