//! What ties bind nodes to in 3D: a triangle of a facet, of which the corners keep their shares in the node's
//! foot.

use super::super::projection::node_facet::{Feature, Placed, Projection, Vector};
use super::super::search::{Pair, Query};
use super::super::springs::{Slip, Spring, Springs, TangentSpace};
use super::super::tied::nodes::{self, Bond, NodeHold};
use super::super::tied::{Bindable, NEAR, PendingTies, Tie};
use super::groups::{bend, halves};
use super::{NodeFacet, ends, first_edge, tangent};
use crate::contact::Scene;
use crate::mesh::surface::{Corners, SpaceSurface};
use crate::tensor::{Dim, dot};

/// A triangle, and the shares of its corners in the node's foot at the start.
type Place = (u32, Vector);

impl Bindable<3> for NodeFacet {
    type Hold = NodeHold<Place>;
    type Bound = Vec<bool>;
    const WORDS: [&'static str; 2] = ["node", "a facet's width"];

    fn bind(&self, pending: &mut PendingTies<3>, positions: &[Vector]) -> Vec<Tie<NodeHold<Place>>> {
        let bonds = near(pending, self.slaves(), self.tracker.target(0), positions);
        nodes::ties(bonds, self.slaves(), pending)
    }

    fn beneath(&self, pending: &mut PendingTies<3>, ties: &[Tie<NodeHold<Place>>], positions: &[Vector]) -> Vec<u32> {
        let (own, targets) = (&self.tracker.surfaces()[self.tracker.slave(0)], &self.tracker.target(0).nodes);
        nodes::beneath(near(pending, targets, own, positions), targets, &own.facets, ties)
    }

    fn sides(&self, ties: &[Tie<NodeHold<Place>>]) -> [Vec<u32>; 2] {
        nodes::sides(ties, &self.tracker.target(0).facets)
    }

    fn bound(&self, ties: &[Tie<NodeHold<Place>>]) -> Vec<bool> {
        nodes::bound(ties, self.slaves().len())
    }

    fn is_there(&self, hold: &NodeHold<Place>, nodes: usize) -> bool {
        let is_place = |facet: &[u32; 4]| hold.place.0 < if facet.corners().len() == 3 { 1 } else { 4 };
        (hold.node as usize) < nodes
            && (hold.slave as usize) < self.slaves().len()
            && self.tracker.target(0).facets.get(hold.facet as usize).is_some_and(is_place)
    }

    fn again<'a>(&'a self, old: &'a Self) -> impl Fn(&NodeHold<Place>) -> Option<NodeHold<Place>> + 'a {
        let facets = |of: &'a Self| &of.tracker.target(0).facets[..];
        nodes::again(self.slaves(), facets(self), facets(old))
    }

    fn hold(&self, ties: &[Tie<NodeHold<Place>>], side: f32, positions: &[Vector], springs: &mut Springs<3>) {
        let Some((&Tie { hold, gap: begin, .. }, spring)) = nodes::only(ties, side) else { return };
        let placed = Placed { surface: self.tracker.target(0), positions };
        let (facet, triangle, place) = (hold.facet, hold.place.0 as usize, hold.place.1);
        let corners = placed.triangle(facet, triangle);
        // A triangle without area is reported with the elements; the tie does nothing.
        let above = placed.above(positions[hold.node as usize], facet, triangle);
        let (weights, gap, normal) = above.unwrap_or((place, begin, [0.0, 0.0, 1.0]));
        let at = |shares: Vector| [0, 1, 2].map(|d| (0..3).map(|k| shares[k] * corners[k][d]).sum::<f64>());
        let (foot, place) = (at(weights), at(place));
        let along = tangent(normal, first_edge(&placed, facet));
        let off = [0, 1, 2].map(|d| foot[d] - place[d]);
        let slip = Dim::<3>::tangents(normal, &along).map(|t| dot(t, off));
        // Forces act at the present foot of the node, so that both are collinear.
        let weights = placed.spread(facet, triangle, weights);
        let projection = Projection { facet, feature: Feature::Face, triangle, weights, foot, gap, normal };
        let (ends, known) = ends(&placed, hold.node, &projection);
        springs.push(Spring { normal, gap: gap - begin, ..spring }, Slip { slip, tangent: along }, &ends[..known]);
    }

    fn detect_free(&mut self, bound: &Vec<bool>, scene: &Scene<'_, 3>, springs: &mut Springs<3>) {
        Self::detect_free(self, bound, scene, springs);
    }
}

impl NodeFacet {
    fn slaves(&self) -> &[u32] {
        &self.tracker.surfaces()[self.tracker.slave(0)].nodes
    }
}

/// Those of some nodes that are near a facet, in their order, with their places on the nearest one.
fn near(pending: &mut PendingTies<3>, slaves: &[u32], surface: &SpaceSurface, positions: &[Vector]) -> Vec<Bond<Place>> {
    let thickness = pending.thickness;
    let placed = Placed { surface, positions };
    let triangles: Vec<[u32; 3]> = surface.facets.iter().flat_map(halves).collect();
    let width = |facet: u32| placed.area(facet).sqrt();
    let widest = (0..surface.facets.len() as u32).map(width).fold(0.0, f64::max);
    // The middle of a facet of four nodes may be off both halves, by less than its width.
    let reach = thickness + 1.01 * NEAR * widest + bend(surface, positions);
    let query = Query { positions_old: positions, positions_new: positions, slaves, facets: &triangles, reach };
    let mut pairs = Vec::new();
    pending.search.pairs(&query, &mut pairs);
    let of_slave = |pairs: &[Pair]| {
        let slave = pairs[0].slave;
        let node = slaves[slave as usize];
        if surface.nodes.binary_search(&node).is_ok() {
            return None;
        }
        let mut facets: Vec<u32> = pairs.iter().map(|pair| pair.facet / 2).collect();
        facets.sort_unstable();
        facets.dedup();
        let mut best: Option<(f64, u32, usize)> = None;
        for facet in facets {
            if let Some((distance, triangle)) = placed.nearest_triangle(positions[node as usize], facet)
                && distance <= thickness + NEAR * width(facet)
                && best.is_none_or(|(nearest, ..)| distance < nearest)
            {
                best = Some((distance, facet, triangle));
            }
        }
        let (_, facet, triangle) = best?;
        let (place, gap, _) = placed.above(positions[node as usize], facet, triangle)?;
        Some(Bond { slave, facet, place: (triangle as u32, place), gap })
    };
    pairs.chunk_by(|a, b| a.slave == b.slave).filter_map(of_slave).collect()
}
