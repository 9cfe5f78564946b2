//! Obstacles in 2D at the start: who is behind them, and what pushes them out.

use super::super::Builder;
use super::super::obstacles::{chain, circle, distinct, plane, points_only};
use super::{AtStart, Distance, Meeting};
use crate::contact::formulation::ContactSurface;
use crate::contact::initial::{Inside, Look, Penetration};
use crate::contact::obstacle::{ContactHistory, Shape, Way};
use crate::contact::projection::node_segment::Target;
use crate::contact::{Vector, length};
use crate::mesh::surface::Surface;
use crate::model::{InitialPenetration, Obstacle, ObstacleShape};
use crate::vector::{first, unit};

impl Builder<'_, 2> {
    /// The bodies that are behind an obstacle at the start. Wrong parts and shapes are reported when
    /// obstacles are made.
    pub(crate) fn obstacle_at_start(&self, obstacle: &Obstacle, tolerance: f64) -> Option<AtStart<2>> {
        let outline = self.outline_met(obstacle).ok()?;
        let distance = behind(obstacle, &outline.target.surface, &self.mesh.positions)?;
        let nodes = self.nodes_met(obstacle, &outline.target.surface);
        let found = penetrations(&nodes, &self.mesh.positions, &distance, tolerance);
        if obstacle.interface.initial_penetration != InitialPenetration::PushOut {
            return Some((found, Vec::new()));
        }
        Some((found, std::iter::once(Meeting::Shape { nodes, distance }).chain(self.meeting(obstacle, outline)).collect()))
    }

    /// Nodes of a surface that an obstacle may have springs for.
    fn nodes_met(&self, obstacle: &Obstacle, surface: &Surface<2>) -> Vec<u32> {
        let along = if let ObstacleShape::Plane { normal, .. } = obstacle.shape { unit(first(normal)) } else { None };
        let is_met = |node: &u32| along.is_none_or(|normal| !self.is_held_along(*node, normal));
        surface.nodes.iter().copied().filter(is_met).collect()
    }

    /// An obstacle that may come in between nodes of the parts.
    fn meeting(&self, obstacle: &Obstacle, outline: ContactSurface<2>) -> Option<Meeting<2>> {
        let thickness = obstacle.interface.thickness;
        let (points, closed, radius) = match &obstacle.shape {
            ObstacleShape::Circle { centre, radius, hollow: false } => (vec![first(*centre)], None, *radius),
            ObstacleShape::Polyline { points } => {
                let (own, closed) = distinct(points);
                (own.to_vec(), Some(closed), 0.0)
            }
            ObstacleShape::Plane { point, normal, length } => {
                let ends = plane(first(*point), first(*normal), *length, thickness, 0.0).ok()?.ends()?.into_iter();
                (ends.filter(|&x| !self.is_beyond_mirrors(x, &obstacle.parts)).collect(), None, 0.0)
            }
            ObstacleShape::Circle { hollow: true, .. }
            | ObstacleShape::Sphere { .. }
            | ObstacleShape::Cylinder { .. }
            | ObstacleShape::Triangles(_) => return None,
        };
        let first = self.mesh.positions.len() as u32;
        let nodes: Vec<u32> = (first..first + points.len() as u32).collect();
        let passes: &[(usize, usize)] = if closed.is_some() { &[(0, 1), (1, 0)] } else { &[(1, 0)] };
        let own = closed
            .map_or_else(|| points_only(nodes.clone()), |closed| Target { surface: chain(nodes.clone(), closed), mirrors: Vec::new() });
        let positions: Vec<Vector> = self.mesh.positions.iter().chain(&points).copied().collect();
        let tracker = self.tracker(outline, own, passes, &positions);
        Some(Meeting::Surfaces { contact: None, look: Look::new(tracker, None, thickness + radius), points })
    }
}

/// What says whether nodes are behind an obstacle, as it will see them; of a polyline nodes and segments say
/// it.
fn behind(obstacle: &Obstacle, surface: &Surface<2>, positions: &[Vector]) -> Option<Distance<2>> {
    let thickness = obstacle.interface.thickness;
    let shape: Box<dyn Shape> = match &obstacle.shape {
        ObstacleShape::Plane { point, normal, length: wide } => {
            let lengths: f64 = surface.segments.iter().map(|&segment| length(segment, positions)).sum();
            Box::new(plane(first(*point), first(*normal), *wide, thickness, lengths / surface.nodes.len().max(1) as f64).ok()?)
        }
        ObstacleShape::Sphere { .. } | ObstacleShape::Cylinder { .. } | ObstacleShape::Triangles(_) => return None,
        ObstacleShape::Circle { centre, radius, hollow } => Box::new(circle(first(*centre), *radius, *hollow, thickness).ok()?),
        ObstacleShape::Polyline { points } => {
            let (own, closed) = distinct(points);
            let surface = chain((0..own.len() as u32).collect(), closed);
            let all: Vec<u32> = (0..surface.segments.len() as u32).collect();
            let (target, points) = (Target { surface, mirrors: Vec::new() }, points.clone());
            return Some(Box::new(move |x| target.nearest(x, &all, &points).map(|nearest| (nearest.gap - thickness, nearest.normal))));
        }
    };
    Some(Box::new(move |x| shape.meet(Way { from: x, to: x }, &mut ContactHistory::default())))
}

fn penetrations(nodes: &[u32], positions: &[Vector], behind: &Distance<2>, tolerance: f64) -> Vec<Penetration<2>> {
    let of = |&node: &u32| {
        let place = positions[node as usize];
        let (gap, _) = behind(place)?;
        (gap < -tolerance).then_some(Penetration { what: Inside::Node, place, depth: -gap })
    };
    nodes.iter().filter_map(of).collect()
}
