//! Penetrations at the start, found before anything is strained: refused, ignored, or pushed out.

use super::obstacles::{chain, distinct, reference, shape};
use super::{Builder, Outlined, search_by_name};
use crate::contact::initial::{self, Penetration};
use crate::contact::length;
use crate::contact::obstacle::{Memory, Way};
use crate::contact::projection::node_segment::Target;
use crate::contact::search::Search;
use crate::contact::tracker::Tracker;
use crate::error::Fault;
use crate::mesh::Mesh;
use crate::mesh::surface::Surface;
use crate::model::{self, Formulation, InitialPenetration, Interface, Obstacle, ObstacleShape, Partners};

impl Builder<'_> {
    /// Penetrations of the contacts at the start: faults, or lines for the overview. Those that shall be pushed out are, in the mesh.
    pub(super) fn part_at_start(&mut self) -> Vec<String> {
        let mut lines = Vec::new();
        let mut is_moved = false;
        for (i, contact) in self.model.contacts.iter().enumerate() {
            let Interface { initial_penetration, thickness, active, .. } = contact.interface;
            // Ties hold what is there; who begins later can't know. Wrong surfaces are told when contacts are made.
            if contact.tied.is_some() || active[0] > 0.0 {
                continue;
            }
            let (Ok(outlines), Some(search)) = (self.outlines_of(contact), search_by_name(&contact.search)) else { continue };
            let mut tracker = tracker(outlines, passes_of(contact), (search.make)(), &self.mesh);
            let tolerance = initial::TOLERANCE * initial::size(&self.mesh.positions);
            let found = initial::penetrations(&mut tracker, thickness, &self.mesh.positions, tolerance);
            let path = format!("contact[{i}]");
            match initial_penetration {
                InitialPenetration::Error => self.faults.extend(initial::faults(&path, &contact.name, &found)),
                InitialPenetration::Ignore => lines.extend(initial::lines(&contact.name, &found, "this counts as zero")),
                InitialPenetration::PushOut => {
                    lines.extend(initial::lines(&contact.name, &found, "it was pushed out"));
                    is_moved |= !found.is_empty();
                    let positions = &mut self.mesh.positions;
                    let fixed = positions.len();
                    let left = initial::push_out(&mut tracker, thickness, positions, fixed, &self.constraints, tolerance);
                    self.faults.extend(left_inside(&path, &contact.name, &left));
                }
            }
        }
        is_moved |= self.leave_obstacles(&mut lines);
        self.positions.clone_from(&self.mesh.positions);
        if is_moved && self.faults.is_empty() {
            self.faults.extend(self.mesh.faults_of_elements());
        }
        lines
    }
}

impl Builder<'_> {
    /// The same for obstacles that ignore what is behind them, or push it out; those that refuse it are asked when their springs are there. Tells whether something was moved.
    fn leave_obstacles(&mut self, lines: &mut Vec<String>) -> bool {
        let mut is_moved = false;
        for (i, obstacle) in self.model.obstacles.iter().enumerate() {
            let Interface { initial_penetration, active, .. } = obstacle.interface;
            // Wrong surfaces are told when contacts are made.
            let Ok(outline) = self.outlined(|leave_out| self.mesh.outside_without(&obstacle.parts, leave_out), "") else { continue };
            if initial_penetration == InitialPenetration::Error || active[0] > 0.0 {
                continue;
            }
            let pushes = initial_penetration == InitialPenetration::PushOut;
            let (found, left) = if let ObstacleShape::Polyline { points } = &obstacle.shape {
                self.leave_polyline(obstacle, points, outline, pushes)
            } else {
                self.leave_shape(obstacle, &outline.target.surface, pushes)
            };
            let done = if pushes { "it was pushed out" } else { "this counts as zero" };
            lines.extend(initial::lines(&obstacle.name, &found, done));
            if pushes {
                is_moved |= !found.is_empty();
                self.faults.extend(left_inside(&format!("obstacle[{i}]"), &obstacle.name, &left));
            }
        }
        is_moved
    }

    /// Nodes that are behind a plane or a circle, and those that still are after they were pushed out.
    fn leave_shape(&mut self, obstacle: &Obstacle, surface: &Surface, pushes: bool) -> (Vec<Penetration>, Vec<Penetration>) {
        let (tolerance, count) = (self.tolerance(), surface.nodes.len().max(1) as f64);
        let spacing = surface.segments.iter().map(|&segment| length(segment, &self.mesh.positions)).sum::<f64>() / count;
        let reference = reference(obstacle);
        let Some(shape) = shape(obstacle, spacing) else { return Default::default() };
        let gap = |[x, y]: [f64; 2]| {
            let local = [x - reference[0], y - reference[1]];
            shape.meet(Way { from: local, to: local }, &mut Memory::default()).filter(|&(gap, _)| gap < -tolerance)
        };
        let (mut found, mut left) = (Vec::new(), Vec::new());
        for &node in &surface.nodes {
            let place = self.mesh.positions[node as usize];
            let Some((depth, normal)) = gap(place) else { continue };
            found.push(Penetration { node, place, depth: -depth });
            let free = self.constraints.of(node as usize).map_or(normal, |held| held.free_part(normal));
            let gain = free[0] * normal[0] + free[1] * normal[1];
            if !pushes {
                continue;
            }
            if gain > 1e-12 {
                let way = (0.5 * tolerance - depth) / gain;
                self.mesh.positions[node as usize] = [place[0] + way * free[0], place[1] + way * free[1]];
            }
            let place = self.mesh.positions[node as usize];
            left.extend(gap(place).map(|(depth, _)| Penetration { node, place, depth: -depth }));
        }
        (found, left)
    }

    fn leave_polyline(
        &mut self,
        obstacle: &Obstacle,
        points: &[[f64; 2]],
        Outlined { target, lids }: Outlined,
        pushes: bool,
    ) -> (Vec<Penetration>, Vec<Penetration>) {
        let Some(search) = search_by_name("") else { return Default::default() };
        let (own, closed) = distinct(points);
        let first = self.mesh.positions.len();
        let mut positions = self.mesh.positions.clone();
        positions.extend(own);
        let line = Target { surface: chain((first as u32..positions.len() as u32).collect(), closed), mirrors: Vec::new() };
        let tracker = Tracker::new(vec![target, line], &[(0, 1), (1, 0)], (search.make)(), &positions);
        let mut tracker = tracker.with_bodies(&self.mesh.bodies(), &[lids, Vec::new()]);
        let (thickness, tolerance) = (obstacle.interface.thickness, self.tolerance());
        let found = initial::penetrations(&mut tracker, thickness, &positions, tolerance);
        let mut left = Vec::new();
        if pushes && !found.is_empty() {
            left = initial::push_out(&mut tracker, thickness, &mut positions, first, &self.constraints, tolerance);
            self.mesh.positions.copy_from_slice(&positions[..first]);
        }
        (found, left)
    }

    fn tolerance(&self) -> f64 {
        initial::TOLERANCE * initial::size(&self.mesh.positions)
    }
}

/// Faults of what could not be pushed out.
fn left_inside(path: &str, name: &str, left: &[Penetration]) -> impl Iterator<Item = Fault> {
    initial::faults(path, name, left).into_iter().map(|fault| Fault {
        message: format!("{} and can't be pushed out", fault.message),
        help: "move the bodies apart".into(),
        ..fault
    })
}

/// Which nodes meet which surface: (slave, target).
fn passes_of(contact: &model::Contact) -> &'static [(usize, usize)] {
    match (&contact.partners, contact.formulation) {
        (Partners::Bodies(_), _) => &[(0, 0)],
        (_, Formulation::SinglePass { slave: 0 }) => &[(0, 1)],
        (_, Formulation::SinglePass { .. }) => &[(1, 0)],
        _ => &[(0, 1), (1, 0)],
    }
}

fn tracker(outlines: Vec<Outlined>, passes: &[(usize, usize)], search: Box<dyn Search<2>>, mesh: &Mesh<2>) -> Tracker {
    let (targets, lids): (Vec<_>, Vec<_>) = outlines.into_iter().map(|Outlined { target, lids }| (target, lids)).unzip();
    Tracker::new(targets, passes, search, &mesh.positions).with_bodies(&mesh.bodies(), &lids)
}
