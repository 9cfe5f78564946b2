//! Penetrations of solids at the start: nodes behind facets and edges that cross, and how they are moved out
//! before anything is strained.
//!
//! What follows nodes and edges comes from the builder and knows nothing of the past. The nodes of a touch,
//! on both sides, share the way so that the sum of squares is least, each along the directions in which it is
//! not held; again and again until none is inside, as in 2D.

use super::super::Sweep;
use super::super::edge_edge::EdgeTouch;
use super::super::node_facet::edges_at_start;
use super::super::node_facet::tracker::{ContactPoint, Tracker};
use super::super::projection::edge_edge::{crossing, point};
use super::super::projection::node_facet::{Placed, Vector};
use super::super::search::Search;
use super::{Inside, Penetration, ROUNDS, SWEEPS};
use crate::load::constraint::Constraints;
use crate::mesh::surface::Corners;
use crate::tensor::dot;

/// Nodes this deep are found, in units of the skin, which is a quarter of the mean edge.
const DEEPEST: f64 = 4.0;
/// Ways that open less than this of a gap are none.
const GAIN: f64 = 1e-12;

/// How a contact looks at its surfaces for the first time.
pub struct Look<'a> {
    /// Makes what follows its nodes, which knows of no past.
    pub tracker: &'a dyn Fn() -> Option<Tracker>,
    /// Makes the search for its edges; `None`: they do not meet.
    pub edges: Option<&'a dyn Fn() -> Option<Box<dyn Search<3>>>>,
    /// Distance that its surfaces keep, m.
    pub thickness: f64,
}

/// What is inside, with the surfaces that say so.
struct Found {
    tracker: Tracker,
    nodes: Vec<ContactPoint>,
    /// Looked at only where no node is inside: where nodes are, edges cross too.
    edges: Vec<EdgeTouch>,
}

impl Look<'_> {
    /// What is inside another body, or nearer than the thickness, by more than a tolerance (m).
    #[must_use]
    pub fn penetrations(&self, positions: &[Vector], tolerance: f64) -> Vec<Penetration<3>> {
        let Some(found) = self.inside(positions, tolerance) else { return Vec::new() };
        let node = |touch: &ContactPoint| {
            let (place, depth) = (positions[touch.node as usize], self.thickness - touch.projection.gap);
            Penetration { what: Inside::Node, place, depth }
        };
        let edge = |touch: &EdgeTouch| {
            let place = point(touch.nodes[0].map(|node| positions[node as usize]), touch.crossing.along[0]);
            Penetration { what: Inside::Edge, place, depth: self.thickness - touch.crossing.gap }
        };
        found.nodes.iter().map(node).chain(found.edges.iter().map(edge)).collect()
    }

    fn inside(&self, positions: &[Vector], tolerance: f64) -> Option<Found> {
        let mut tracker = (self.tracker)()?;
        let [_, skin] = tracker.reach();
        let touches = tracker.track(Sweep::between(positions, positions), self.thickness + DEEPEST * skin);
        let deep = |touch: &&ContactPoint| !touch.own && touch.projection.gap - self.thickness < -tolerance;
        let nodes: Vec<ContactPoint> = touches.iter().filter(deep).copied().collect();
        let mut edges = Vec::new();
        if nodes.is_empty()
            && let Some(search) = self.edges.and_then(|make| make())
        {
            let deep = |touch: &EdgeTouch| !touch.own && touch.crossing.gap - self.thickness < -tolerance;
            edges = edges_at_start(&tracker, search, positions, self.thickness);
            edges.retain(deep);
        }
        Some(Found { tracker, nodes, edges })
    }
}

/// What may be moved at the start, and what must not.
pub struct Movable<'a> {
    /// m; nodes beyond `count` are those of obstacles and stay where they are.
    pub positions: &'a mut [Vector],
    /// Nodes of the model.
    pub count: usize,
    /// Directions in which nodes are held.
    pub constraints: &'a Constraints<3>,
    /// Depth that is round-off, m.
    pub tolerance: f64,
}

impl Movable<'_> {
    /// Moves nodes until nothing of a contact is inside another body, or nearer than its thickness, by more
    /// than the tolerance, or until that has been tried often enough. Whether something was moved.
    pub fn push_out(&mut self, look: &Look<'_>) -> bool {
        for round in 0..ROUNDS {
            let Some(found) = look.inside(self.positions, self.tolerance) else { return round > 0 };
            if found.nodes.is_empty() && found.edges.is_empty() {
                return round > 0;
            }
            let distance = look.thickness + 0.5 * self.tolerance;
            for _ in 0..SWEEPS {
                for touch in &found.nodes {
                    self.part_node(&found.tracker, touch, distance);
                }
                for touch in &found.edges {
                    self.part_edges(touch, distance);
                }
            }
        }
        true
    }

    /// Moves `nodes` out of an obstacle of which `distance` says how far they are from its surface (m,
    /// negative inside) and the normal. Whether something was moved.
    pub fn push_off(&mut self, nodes: &[u32], distance: impl Fn(Vector) -> (f64, Vector)) -> bool {
        let mut is_moved = false;
        for &node in nodes {
            for _ in 0..ROUNDS {
                let (gap, normal) = distance(self.positions[node as usize]);
                if !(gap < -self.tolerance && self.open(&[(node, 1.0)], normal, 0.5 * self.tolerance - gap)) {
                    break;
                }
                is_moved = true;
            }
        }
        is_moved
    }

    /// Moves a node and the facet that it touches to a distance.
    fn part_node(&mut self, tracker: &Tracker, touch: &ContactPoint, distance: f64) {
        let placed = Placed { surface: tracker.target(touch.pass), positions: self.positions };
        let Some(here) = placed.project(self.positions[touch.node as usize], [touch.projection.facet]) else { return };
        let facet = placed.surface.facets[here.facet as usize];
        let mut ends = [(touch.node, 1.0); 5];
        let count = facet.corners().len();
        for k in 0..count {
            ends[k + 1] = (facet[k], -here.weights[k]);
        }
        if here.gap < distance {
            self.open(&ends[..=count], here.normal, distance - here.gap);
        }
    }

    /// The same of two edges.
    fn part_edges(&mut self, touch: &EdgeTouch, distance: f64) {
        let [a, b] = touch.nodes.map(|edge| edge.map(|node| self.positions[node as usize]));
        let Some(here) = crossing(a, b).filter(|here| here.is_within(0.0)) else { return };
        let here = if dot(here.normal, touch.crossing.normal) < 0.0 { here.turned() } else { here };
        let ([s, t], [[a, b], [c, d]]) = (here.along, touch.nodes);
        if here.gap < distance {
            self.open(&[(a, 1.0 - s), (b, s), (c, t - 1.0), (d, -t)], here.normal, distance - here.gap);
        }
    }

    /// Opens a gap with these shares of nodes by so much (m), as far as they can: whether they can at all.
    fn open(&mut self, ends: &[(u32, f64)], normal: Vector, by: f64) -> bool {
        let free = |node: u32| match node as usize {
            at if at >= self.count => [0.0; 3],
            at => self.constraints.of(at).map_or(normal, |held| held.free_part(normal)),
        };
        let gain: f64 = ends.iter().map(|&(node, share)| share * share * dot(free(node), normal)).sum();
        if !(gain > GAIN) {
            return false;
        }
        for &(node, share) in ends {
            let way = free(node);
            let x = &mut self.positions[node as usize];
            (0..3).for_each(|d| x[d] += by / gain * share * way[d]);
        }
        true
    }
}
