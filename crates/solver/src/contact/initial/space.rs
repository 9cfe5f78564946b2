//! Penetrations at the start in 3D: nodes behind facets, and edges that cross.

use super::super::Sweep;
use super::super::edge_edge::EdgeTouch;
use super::super::node_facet::edges_at_start;
use super::super::node_facet::tracker::{ContactPoint, Tracker};
use super::super::projection::edge_edge::{crossing, point};
use super::super::projection::node_facet::{Placed, Vector};
use super::{Inside, Look, Opening, Penetrating, Penetration};
use crate::mesh::surface::Corners;
use crate::tensor::{Dim, dot};

/// Nodes this deep are found, in units of the skin, which is a quarter of the mean edge.
const DEEPEST: f64 = 4.0;

/// What is inside another body.
pub enum Touch {
    /// A node.
    Node(ContactPoint),
    /// Edges that cross. Looked at only where no node is inside: where nodes are, edges cross too.
    Edges(EdgeTouch),
}

impl Penetrating<3> for Dim<3> {
    type Touch = Touch;

    fn deepest(tracker: &Tracker) -> f64 {
        let [_, skin] = tracker.reach();
        DEEPEST * skin
    }

    fn inside(look: &mut Look<3>, positions: &[Vector], tolerance: f64) -> Vec<Touch> {
        let Look { tracker, edges, thickness, deepest } = look;
        tracker.forget();
        let touches = tracker.track(Sweep::between(positions, positions), *thickness + *deepest);
        let is_deep = |gap: f64| gap - *thickness < -tolerance;
        let mut inside: Vec<Touch> =
            touches.iter().filter(|touch| !touch.own && is_deep(touch.projection.gap)).copied().map(Touch::Node).collect();
        if let (true, Some(search)) = (inside.is_empty(), edges) {
            let crossing = edges_at_start(tracker, search(), positions, *thickness);
            inside.extend(crossing.into_iter().filter(|touch| !touch.own && is_deep(touch.crossing.gap)).map(Touch::Edges));
        }
        inside
    }

    fn penetration(touch: &Touch, thickness: f64, positions: &[Vector]) -> Penetration<3> {
        match touch {
            Touch::Node(ContactPoint { node, projection, .. }) => {
                Penetration { what: Inside::Node, place: positions[*node as usize], depth: thickness - projection.gap }
            }
            Touch::Edges(EdgeTouch { nodes, crossing, .. }) => {
                let place = point(nodes[0].map(|node| positions[node as usize]), crossing.along[0]);
                Penetration { what: Inside::Edge, place, depth: thickness - crossing.gap }
            }
        }
    }

    fn opening(tracker: &Tracker, touch: &Touch, positions: &[Vector]) -> Option<Opening<3>> {
        match touch {
            Touch::Node(touch) => {
                let placed = Placed { surface: tracker.target(touch.pass), positions };
                let here = placed.project(positions[touch.node as usize], [touch.projection.facet])?;
                let facet = placed.surface.facets[here.facet as usize];
                let (mut ends, count) = ([(touch.node, 1.0); 5], facet.corners().len());
                for k in 0..count {
                    ends[k + 1] = (facet[k], -here.weights[k]);
                }
                Some(Opening { ends, count: count + 1, normal: here.normal, gap: here.gap })
            }
            Touch::Edges(touch) => {
                let [a, b] = touch.nodes.map(|edge| edge.map(|node| positions[node as usize]));
                let here = crossing(a, b).filter(|here| here.is_within(0.0))?;
                let here = if dot(here.normal, touch.crossing.normal) < 0.0 { here.turned() } else { here };
                let ([s, t], [[a, b], [c, d]]) = (here.along, touch.nodes);
                let ends = [(a, 1.0 - s), (b, s), (c, t - 1.0), (d, -t), (0, 0.0)];
                Some(Opening { ends, count: 4, normal: here.normal, gap: here.gap })
            }
        }
    }
}
