//! Penetrations at the start, found before anything is strained: refused, ignored, or pushed out.

use super::obstacles::{chain, circle, distinct, plane, points_only};
use super::plane::Outlined;
use super::{Builder, search_by_name};
use crate::contact::formulation::{self, Passes};
use crate::contact::initial::{self, Inside, Movable, Penetration};
use crate::contact::obstacle::{ContactHistory, Shape, Way};
use crate::contact::projection::node_segment::Target;
use crate::contact::search::Search;
use crate::contact::tracker::Tracker;
use crate::contact::{Vector, length};
use crate::error::Fault;
use crate::mesh::surface::Surface;
use crate::model::{InitialPenetration, Interface, Obstacle, ObstacleShape};
use crate::vector::{first, unit};

/// Rounds over all contacts and obstacles: what is pushed out of one may come into another.
pub(super) const ROUNDS: usize = 20;

/// A contact, or an obstacle made of nodes and segments, with what decides whether it penetrates.
struct Meeting {
    /// Index of the contact; `None`: of an obstacle.
    contact: Option<usize>,
    tracker: Tracker,
    /// Distance that its surfaces keep, m.
    thickness: f64,
    /// Nodes of the obstacle, m.
    points: Vec<Vector>,
}

impl Builder<'_, 2> {
    /// Penetrations at the start: faults, or lines for the overview. Those that shall be pushed out are, in
    /// the mesh.
    pub(crate) fn resolve_initial_penetration(&mut self) -> Vec<String> {
        let tolerance = crate::mesh::tolerance(&self.mesh.positions);
        let mut lines = Vec::new();
        let mut pushed = Vec::new();
        for (i, contact) in self.model.contacts.iter().enumerate() {
            let Interface { initial_penetration, thickness, active, .. } = contact.interface;
            // Ties hold what is there; who begins later can't know. Wrong surfaces are reported when contacts
            // are made.
            if contact.tied.is_some() || active[0] > 0.0 {
                continue;
            }
            let (Ok(outlines), Some(search), Some(kind)) =
                (self.outlines_of(contact), search_by_name(&contact.search), formulation::kind_of(contact))
            else {
                continue;
            };
            let mut tracker = self.tracker_at_start(outlines, (kind.passes)(contact), (search.make)());
            let found = initial::penetrations(&mut tracker, thickness, &self.mesh.positions, tolerance);
            match initial_penetration {
                InitialPenetration::Error => self.faults.extend(initial::faults(&format!("contact[{i}]"), &contact.name, &found)),
                InitialPenetration::Ignore => lines.extend(initial::lines(&contact.name, &found, IGNORED)),
                InitialPenetration::PushOut => {
                    lines.extend(initial::lines(&contact.name, &found, PUSHED));
                    pushed.push(Meeting { contact: Some(i), tracker, thickness, points: Vec::new() });
                }
            }
        }
        let mut pushing = Vec::new();
        for obstacle in self.model.obstacles.iter().filter(|it| it.interface.active[0] <= 0.0) {
            // Faults are reported when all springs are known: nothing can be seen better.
            let what = match obstacle.interface.initial_penetration {
                InitialPenetration::Error => continue,
                InitialPenetration::Ignore => IGNORED,
                InitialPenetration::PushOut => PUSHED,
            };
            // Wrong parts and shapes are reported when obstacles are made.
            let Ok(outline) = self.outline_met(obstacle) else { continue };
            let Some(behind) = behind(obstacle, &outline.target.surface, &self.mesh.positions) else { continue };
            let nodes = self.nodes_met(obstacle, &outline.target.surface);
            lines.extend(initial::lines(&obstacle.name, &penetrations(&nodes, &self.mesh.positions, &behind, tolerance), what));
            if what == PUSHED {
                pushed.extend(self.meeting(obstacle, outline));
                pushing.push((nodes, behind));
            }
        }
        if !pushed.is_empty() || !pushing.is_empty() {
            self.push_out(&mut pushed, &pushing, tolerance);
        }
        self.positions.clone_from(&self.mesh.positions);
        lines
    }

    fn tracker_at_start(&self, outlines: Vec<Outlined>, passes: Passes, search: Box<dyn Search<2>>) -> Tracker {
        let (targets, lids): (Vec<_>, Vec<_>) = outlines.into_iter().map(|Outlined { target, lids }| (target, lids)).unzip();
        Tracker::new(targets, passes, search, &self.mesh.positions).with_bodies(&self.body_of_node, &lids)
    }

    fn push_out(&mut self, meetings: &mut [Meeting], obstacles: &[(Vec<u32>, Behind)], tolerance: f64) {
        let mut is_moved = false;
        for _ in 0..ROUNDS {
            let mut moves = false;
            let (count, constraints) = (self.mesh.positions.len(), &self.constraints);
            let mut movable = Movable { positions: &mut self.mesh.positions, count, constraints, tolerance };
            for (nodes, behind) in obstacles {
                moves |= movable.push_off(nodes, behind);
            }
            for meeting in &mut *meetings {
                movable.positions.extend(&meeting.points);
                moves |= movable.push_out(&mut meeting.tracker, meeting.thickness);
                movable.positions.truncate(count);
            }
            is_moved |= moves;
            if !moves {
                break;
            }
        }
        for meeting in meetings {
            // What is left behind obstacles is reported when all springs are known.
            let Some(i) = meeting.contact else { continue };
            let left = initial::penetrations(&mut meeting.tracker, meeting.thickness, &self.mesh.positions, tolerance);
            let faults = initial::faults(&format!("contact[{i}]"), &self.model.contacts[i].name, &left);
            self.faults.extend(faults.into_iter().map(|fault| Fault {
                message: format!("{} and can't be pushed out", fault.message),
                help: "move the bodies apart".into(),
                ..fault
            }));
        }
        if is_moved && self.faults.is_empty() {
            self.faults.extend(self.mesh.faults_of_elements());
        }
    }

    /// Nodes of a surface that an obstacle may have springs for.
    fn nodes_met(&self, obstacle: &Obstacle, surface: &Surface<2>) -> Vec<u32> {
        let along = if let ObstacleShape::Plane { normal, .. } = obstacle.shape { unit(first(normal)) } else { None };
        let is_met = |node: &u32| along.is_none_or(|normal| !self.is_held_along(*node, normal));
        surface.nodes.iter().copied().filter(is_met).collect()
    }

    /// An obstacle that may come in between nodes of the parts.
    fn meeting(&self, obstacle: &Obstacle, outline: Outlined) -> Option<Meeting> {
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
        Some(Meeting { contact: None, tracker, thickness: thickness + radius, points })
    }
}

/// What is done, in words.
pub(super) const IGNORED: &str = "this counts as zero";
pub(super) const PUSHED: &str = "it was pushed out";

/// Gap (m) and normal of a point at an obstacle; `None` where the obstacle is not.
type Behind = Box<dyn Fn(Vector) -> Option<(f64, Vector)>>;

/// What says whether nodes are behind an obstacle, as it will see them; of a polyline nodes and segments say
/// it.
fn behind(obstacle: &Obstacle, surface: &Surface<2>, positions: &[Vector]) -> Option<Behind> {
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

fn penetrations(nodes: &[u32], positions: &[Vector], behind: &Behind, tolerance: f64) -> Vec<Penetration<2>> {
    let of = |&node: &u32| {
        let place = positions[node as usize];
        let (gap, _) = behind(place)?;
        (gap < -tolerance).then_some(Penetration { what: Inside::Node, place, depth: -gap })
    };
    nodes.iter().filter_map(of).collect()
}
