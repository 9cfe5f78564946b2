//! Obstacles of triangles: points and triangles are nodes and facets that move with a rigid body, and meet
//! the outside of the parts as surfaces meet, nodes against facets and edges against edges.
//!
//! The surface comes from the model; the search, the nearest feature, friction and memory are those of
//! contact between bodies (`contact/node_facet.rs`). Nodes of the parts press with all that they stand for,
//! as on every obstacle, where the triangles are larger than the facets of the parts; then only points that
//! stick out press back, each with as much as a node of the parts has. Surfaces as fine as the parts meet
//! them half in each pass.

use super::start::{IGNORED, stuck};
use super::{Builder, manner, search_by_name};
use crate::contact::formulation::Side;
use crate::contact::initial::{self, Inside, Look, Penetration};
use crate::contact::law::penalty::penalty_of;
use crate::contact::node_facet::NodeFacet;
use crate::contact::node_facet::make::{with_moduli, with_thickness};
use crate::contact::node_facet::tracker::Tracker;
use crate::contact::obstacle::{Manner, OutlineShape};
use crate::contact::overlap::{Bodies, OverlapCheck};
use crate::contact::projection::node_facet::Placed;
use crate::contact::search::Search;
use crate::contact::slaves::PassInput;
use crate::contact::{Formulation, Tributary};
use crate::error::Fault;
use crate::mesh::surface::SpaceSurface;
use crate::model::{InitialPenetration, Obstacle, ObstacleShape, TriangleSurface};
use crate::rigid::Member;
use crate::vector::minus;

/// Nodes of the parts against triangles, and points of these against facets of the parts.
const PASSES: &[(usize, usize)] = &[(0, 1), (1, 0)];
/// Number of the obstacle among the bodies.
const OBSTACLE: u32 = u32::MAX;

impl Builder<'_, 3> {
    /// The body of an obstacle of triangles, and what makes springs where `outside` of the parts meets it.
    pub(super) fn triangles(
        &mut self,
        obstacle: &Obstacle,
        surface: &TriangleSurface,
        outside: SpaceSurface,
    ) -> Result<(usize, Box<dyn Formulation<3>>), Fault> {
        let interface = &obstacle.interface;
        let (body, first) = self.body_of_triangles(obstacle, surface);
        let parts = self.side(outside.into(), interface);
        let own = SpaceSurface::of_triangles(surface, first);
        let (points, passes) = self.points_of_triangles(&own, &parts.nodes);
        let count = own.facets.len();
        // Nothing of it yields.
        let rigid = Side { shares: vec![1.0; points.len()], nodes: points, softest: vec![f64::INFINITY; count], ..Side::default() };
        let Manner { reach, factor, ignores_start } = manner(interface, 0.0);
        let of_obstacle = |input: PassInput| PassInput { at_obstacle: Some(factor), ..input };
        let penalty = penalty_of(interface);
        let inputs = [parts.against(&rigid, penalty, passes), rigid.against(&parts, penalty, passes)].map(of_obstacle).into();
        let outside = parts.surface.target;
        let overlap_check = self.check_of_triangles(&outside, &own, ignores_start)?;
        let surfaces = vec![outside, own];
        let inputs = with_thickness(inputs, &overlap_check, &surfaces, PASSES);
        let overlap_check = with_moduli(overlap_check, &surfaces, PASSES, &inputs);
        let tracker = Tracker::new(surfaces, PASSES, &self.body_of_node, search(), &self.positions).measured_by(0, &self.positions);
        let made = NodeFacet::new(tracker, inputs, interface, reach, &self.positions).with_edges(search());
        Ok((body, Box::new(made.with_check(overlap_check))))
    }

    /// What looks at the overlaps of the obstacle with the bodies that it meets.
    fn check_of_triangles(&self, met: &SpaceSurface, own: &SpaceSurface, ignores_start: bool) -> Result<OverlapCheck, Fault> {
        let first = own.nodes.first().copied().unwrap_or(OBSTACLE);
        let make = |bodies: &Bodies<'_>| {
            let outside = bodies.outside.joined(own);
            let bodies = Bodies {
                outside: &outside,
                is_mirror: &|facet| facet[0] < first && (bodies.is_mirror)(facet),
                body_of: &|node| if node < first { (bodies.body_of)(node) } else { OBSTACLE },
                side_of: Some(&|body| u32::from(body == OBSTACLE)),
            };
            OverlapCheck::new(&bodies, &self.positions, ignores_start)
        };
        self.of_bodies(&self.bodies_of(met), make, None)
    }

    /// The rigid body, and the number of the node of its first point. Those that are there already, where
    /// contacts are made again.
    fn body_of_triangles(&mut self, obstacle: &Obstacle, surface: &TriangleSurface) -> (usize, u32) {
        if let Some(&body) = self.made.get(&obstacle.name) {
            return (body, self.bodies.state(body).members.first().map_or(0, |member| member.node));
        }
        let reference = obstacle.reference.unwrap_or_else(|| surface.middle());
        let first = self.positions.len() as u32;
        self.positions.extend(&surface.positions);
        self.mass.resize(self.positions.len(), 1.0);
        let mut rigid = self.obstacle_body_in_3d(obstacle, reference);
        rigid.members = (first..).zip(&surface.positions).map(|(node, &x)| Member { node, arm: minus(x, reference) }).collect();
        let points = rigid.members.iter().map(|member| member.arm).collect();
        let body = self.bodies.add_with_nodes(rigid, self.positions.len());
        let facets = surface.triangles.iter().map(|&[a, b, c]| [a, b, c, c]).collect();
        self.outlines.push(OutlineShape { name: obstacle.name.clone(), body, points, facets, death: obstacle.interface.active[1] });
        (body, first)
    }

    /// What each point of an obstacle stands for beside the nodes of the parts, and the number of passes that
    /// carry the pressure together.
    fn points_of_triangles(&self, own: &SpaceSurface, parts: &[Tributary]) -> (Vec<Tributary>, usize) {
        let placed = Placed { surface: own, positions: &self.positions };
        let mut areas = vec![0.0; own.nodes.len()];
        for (facet, number) in own.facets.iter().zip(0..) {
            let share = placed.area(number) / 3.0;
            for node in &facet[..3] {
                if let Ok(rank) = own.nodes.binary_search(node) {
                    areas[rank] += share;
                }
            }
        }
        let mean = parts.iter().map(|own| own.area).sum::<f64>() / parts.len().max(1) as f64;
        let fine: f64 = areas.iter().filter(|&&area| area <= mean).sum();
        let passes = if 2.0 * fine > areas.iter().sum::<f64>() { 2 } else { 1 };
        // Of triangles that are larger than facets of the parts, what goes in between their nodes.
        let mut counts: Vec<bool> = areas.iter().map(|&area| passes == 2 || area <= mean).collect();
        for (edge, number) in own.edges.iter().zip(0..) {
            if placed.ridge(number).is_some_and(|ridge| ridge.is_sharp()) {
                edge.nodes.iter().filter_map(|node| own.nodes.binary_search(node).ok()).for_each(|rank| counts[rank] = true);
            }
        }
        let of = |(area, counts): (f64, bool)| {
            let area = if !counts {
                0.0
            } else if passes == 2 {
                area
            } else {
                area.min(mean)
            };
            Tributary { area, length: area, stiffness: f64::INFINITY, of_mass: 0.0 }
        };
        (areas.into_iter().zip(counts).map(of).collect(), passes)
    }

    /// Penetrations of obstacles of triangles at the start: faults, or lines for the overview of those that
    /// count as zero.
    pub(super) fn inside_triangles(&mut self, tolerance: f64) -> Vec<String> {
        let mut lines = Vec::new();
        for (i, obstacle) in self.model.obstacles.iter().enumerate() {
            let ObstacleShape::Triangles(surface) = &obstacle.shape else { continue };
            let outside = self.mesh.outside_without(&obstacle.parts, |facet| self.constraints.is_mirror(facet));
            // Wrong parts are reported when obstacles are made; who begins later can't know.
            let (Ok(outside), true) = (outside, obstacle.interface.active[0] <= 0.0) else { continue };
            let look = self.look_at_triangles(surface, outside, obstacle.interface.thickness);
            let found = self.penetrations_of_triangles(surface, look, tolerance);
            match obstacle.interface.initial_penetration {
                InitialPenetration::Ignore => lines.extend(initial::lines(&obstacle.name, &found, IGNORED)),
                InitialPenetration::Error => {
                    self.faults.extend(initial::faults(self.model, &format!("obstacle[{i}]"), &obstacle.name, &found))
                }
                // What is left: the rest was pushed out.
                InitialPenetration::PushOut => {
                    self.faults
                        .extend(initial::faults(self.model, &format!("obstacle[{i}]"), &obstacle.name, &found).into_iter().map(stuck));
                }
            }
        }
        lines
    }

    /// The first look of an obstacle of triangles at the outside of the parts; points of the obstacle follow
    /// the nodes of the model.
    pub(super) fn look_at_triangles(&self, surface: &TriangleSurface, outside: SpaceSurface, thickness: f64) -> Look<3> {
        let positions = self.with_points(surface);
        let own = SpaceSurface::of_triangles(surface, self.mesh.positions.len() as u32);
        let tracker = Tracker::new(vec![outside, own], PASSES, &self.body_of_node, search(), &positions).measured_by(0, &positions);
        Look::new(tracker, Some(search), thickness)
    }

    /// Positions of the nodes of the model and of the points of an obstacle, m.
    fn with_points(&self, surface: &TriangleSurface) -> Vec<[f64; 3]> {
        self.mesh.positions.iter().chain(&surface.positions).copied().collect()
    }

    /// What is inside of an obstacle by its first look.
    pub(super) fn penetrations_of_triangles(&self, surface: &TriangleSurface, look: Look<3>, tolerance: f64) -> Vec<Penetration<3>> {
        let (positions, mut look) = (self.with_points(surface), look.shallow());
        let found = look.penetrations(&positions, tolerance);
        if found.is_empty() && surface.open_edges().is_none() {
            return self.bodies_in_triangles(look.tracker(), &positions, tolerance);
        }
        found
    }

    /// A node of each body that is inside of a closed surface altogether, where no node is near it.
    fn bodies_in_triangles(&self, tracker: &Tracker, positions: &[[f64; 3]], tolerance: f64) -> Vec<Penetration<3>> {
        let [parts, own] = tracker.surfaces() else { return Vec::new() };
        let mut nodes: Vec<(u32, u32)> = parts.nodes.iter().map(|&node| (self.body_of_node[node as usize], node)).collect();
        nodes.sort_unstable();
        nodes.dedup_by_key(|(body, _)| *body);
        let placed = Placed { surface: own, positions };
        let of = |(_, node): (u32, u32)| {
            let place = positions[node as usize];
            let depth = -placed.project(place, 0..own.facets.len() as u32)?.gap;
            (depth > tolerance).then_some(Penetration { what: Inside::Node, place, depth })
        };
        nodes.into_iter().filter_map(of).collect()
    }
}

/// The search of obstacles.
fn search() -> Box<dyn Search<3>> {
    (search_by_name("").expect("the registry of searches is not empty").make)()
}
