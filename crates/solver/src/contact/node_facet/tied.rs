//! What ties bind nodes to in 3D: a triangle of a facet, of which the corners keep their shares in the node's
//! foot.

use super::super::projection::node_facet::{Feature, Placed, Projection, Vector};
use super::super::search::{Pair, Query, Search};
use super::super::springs::{Spring, Springs, TangentSpace};
use super::super::tied::{Bindable, Bond, NEAR, Tie};
use super::groups::{bend, halves};
use super::{NodeFacet, ends, first_edge, tangent};
use crate::contact::Scene;
use crate::mesh::surface::{Corners, SpaceSurface};
use crate::tensor::{Dim, dot};

impl Bindable<3> for NodeFacet {
    /// A triangle, and the shares of its corners in the node's foot at the start.
    type Place = (u32, Vector);
    const WIDTH: &'static str = "a facet's width";

    fn slaves(&self) -> &[u32] {
        &self.tracker.surfaces()[self.tracker.slave(0)].nodes
    }

    fn target(&self) -> &SpaceSurface {
        self.tracker.target(0)
    }

    fn near(&self, search: &mut dyn Search<3>, thickness: f64, positions: &[Vector]) -> Vec<Bond<(u32, Vector)>> {
        let (slaves, surface) = (self.slaves(), self.target());
        let placed = Placed { surface, positions };
        let triangles: Vec<[u32; 3]> = surface.facets.iter().flat_map(halves).collect();
        let width = |facet: u32| placed.area(facet).sqrt();
        let widest = (0..surface.facets.len() as u32).map(width).fold(0.0, f64::max);
        // The middle of a facet of four nodes may be off both halves, by less than its width.
        let reach = thickness + 1.01 * NEAR * widest + bend(surface, positions);
        let query = Query { positions_old: positions, positions_new: positions, slaves, facets: &triangles, reach };
        let mut pairs = Vec::new();
        search.pairs(&query, &mut pairs);
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

    fn is_place(facet: [u32; 4], &(triangle, _): &(u32, Vector)) -> bool {
        triangle < if facet.corners().len() == 3 { 1 } else { 4 }
    }

    fn hold(&self, tie: &Tie<(u32, Vector)>, spring: Spring<3>, positions: &[Vector], springs: &mut Springs<3>) {
        let placed = Placed { surface: self.target(), positions };
        let (facet, triangle, place) = (tie.facet, tie.place.0 as usize, tie.place.1);
        let corners = placed.triangle(facet, triangle);
        // A triangle without area is reported with the elements; the tie does nothing.
        let above = placed.above(positions[tie.node as usize], facet, triangle);
        let (weights, gap, normal) = above.unwrap_or((place, tie.gap, [0.0, 0.0, 1.0]));
        let at = |shares: Vector| [0, 1, 2].map(|d| (0..3).map(|k| shares[k] * corners[k][d]).sum::<f64>());
        let (foot, place) = (at(weights), at(place));
        let along = tangent(normal, first_edge(&placed, facet));
        let off = [0, 1, 2].map(|d| foot[d] - place[d]);
        let slip = Dim::<3>::tangents(normal, &along).map(|t| dot(t, off));
        // Forces act at the present foot of the node, so that both are collinear.
        let weights = placed.spread(facet, triangle, weights);
        let projection = Projection { facet, feature: Feature::Face, triangle, weights, foot, gap, normal };
        let (ends, known) = ends(&placed, tie.node, &projection);
        springs.push(Spring { normal, gap: gap - tie.gap, slip, tangent: along, ..spring }, &ends[..known]);
    }

    fn detect_free(&mut self, bound: &[bool], scene: &Scene<'_, 3>, springs: &mut Springs<3>) {
        Self::detect_free(self, bound, scene, springs);
    }
}
