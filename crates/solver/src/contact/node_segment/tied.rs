//! What ties bind nodes to in 2D: a segment, at a place along it.

use super::super::projection::node_segment::Projection;
use super::super::search::{Pair, Query};
use super::super::springs::{Slip, Spring, Springs};
use super::super::tied::nodes::{self, Bond, NodeHold};
use super::super::tied::{Bindable, NEAR, PendingTies, Tie};
use super::super::{Scene, Vector, length};
use super::{NodeSegment, ends};
use crate::mesh::surface::Surface;

impl Bindable<2> for NodeSegment {
    /// Along the segment: 0 and 1 are its nodes.
    type Hold = NodeHold<f64>;
    type Bound = Vec<bool>;
    const WORDS: [&'static str; 2] = ["node", "a segment's length"];

    fn bind(&self, pending: &mut PendingTies<2>, positions: &[Vector]) -> Vec<Tie<NodeHold<f64>>> {
        let bonds = near(pending, self.slaves(), &self.tracker.target(0).surface, positions);
        nodes::ties(bonds, self.slaves(), pending)
    }

    fn beneath(&self, pending: &mut PendingTies<2>, ties: &[Tie<NodeHold<f64>>], positions: &[Vector]) -> Vec<u32> {
        let own = &self.tracker.targets()[self.tracker.slave(0)].surface;
        let targets = &self.tracker.target(0).surface.nodes;
        nodes::beneath(near(pending, targets, own, positions), targets, &own.segments, ties)
    }

    fn sides(&self, ties: &[Tie<NodeHold<f64>>]) -> [Vec<u32>; 2] {
        nodes::sides(ties, &self.tracker.target(0).surface.segments)
    }

    fn bound(&self, ties: &[Tie<NodeHold<f64>>]) -> Vec<bool> {
        nodes::bound(ties, self.slaves().len())
    }

    fn is_there(&self, hold: &NodeHold<f64>, nodes: usize) -> bool {
        let (slaves, facets) = (self.slaves().len(), self.tracker.target(0).surface.segments.len());
        (hold.node as usize) < nodes && (hold.slave as usize) < slaves && (hold.facet as usize) < facets
    }

    fn again<'a>(&'a self, old: &'a Self) -> impl Fn(&NodeHold<f64>) -> Option<NodeHold<f64>> + 'a {
        let segments = |of: &'a Self| &of.tracker.target(0).surface.segments[..];
        nodes::again(self.slaves(), segments(self), segments(old))
    }

    fn hold(&self, ties: &[Tie<NodeHold<f64>>], side: f32, positions: &[Vector], springs: &mut Springs<2>) {
        let Some((&Tie { hold, gap: begin, .. }, spring)) = nodes::only(ties, side) else { return };
        let target = self.tracker.target(0);
        // A segment without length is reported with the elements; the tie does nothing.
        let segment = target.surface.segments[hold.facet as usize];
        let [along, gap, whole] = place(positions, hold.node, segment).unwrap_or([0.0, begin, 1.0]);
        let [a, b] = segment.map(|node| positions[node as usize]);
        let normal = [-(b[1] - a[1]) / whole, (b[0] - a[0]) / whole];
        // Forces act at the present foot of the node, so that both are collinear.
        let projection = Projection { segment: hold.facet, weights: [1.0 - along / whole, along / whole], gap, normal };
        let slip = [along - hold.place * whole];
        springs.push(Spring { normal, gap: gap - begin, ..spring }, Slip::of(slip), &ends(hold.node, &projection, target, positions));
    }

    fn detect_free(&mut self, bound: &Vec<bool>, scene: &Scene<'_, 2>, springs: &mut Springs<2>) {
        Self::detect_free(self, bound, scene, springs);
    }
}

impl NodeSegment {
    fn slaves(&self) -> &[u32] {
        &self.tracker.targets()[self.tracker.slave(0)].surface.nodes
    }
}

/// Those of some nodes that are near a segment, in their order, with their places on the nearest one.
fn near(pending: &mut PendingTies<2>, slaves: &[u32], surface: &Surface<2>, positions: &[Vector]) -> Vec<Bond<f64>> {
    let thickness = pending.thickness;
    let longest = surface.segments.iter().map(|&segment| length(segment, positions)).fold(0.0, f64::max);
    let reach = thickness + 1.01 * NEAR * longest;
    let query = Query { positions_old: positions, positions_new: positions, slaves, facets: &surface.segments, reach };
    let mut pairs = Vec::new();
    pending.search.pairs(&query, &mut pairs);
    let of_slave = |pairs: &[Pair]| {
        let node = slaves[pairs[0].slave as usize];
        if surface.nodes.binary_search(&node).is_ok() {
            return None;
        }
        let mut best: Option<(f64, Bond<f64>)> = None;
        for pair in pairs {
            let Some([along, gap, whole]) = place(positions, node, surface.segments[pair.facet as usize]) else { continue };
            let beyond = f64::max(0.0, (along - 0.5 * whole).abs() - 0.5 * whole);
            let distance = (gap * gap + beyond * beyond).sqrt();
            if distance <= thickness + NEAR * whole && best.as_ref().is_none_or(|(nearest, _)| distance < *nearest) {
                best = Some((distance, Bond { slave: pair.slave, facet: pair.facet, place: along / whole, gap }));
            }
        }
        best.map(|(_, bond)| bond)
    };
    pairs.chunk_by(|a, b| a.slave == b.slave).filter_map(of_slave).collect()
}

/// Where a node is seen from a segment: along it from its beginning, and above it, m; and the length of the
/// segment, m. `None` where that has none.
fn place(positions: &[Vector], node: u32, segment: [u32; 2]) -> Option<[f64; 3]> {
    let [a, b] = segment.map(|node| positions[node as usize]);
    let x = positions[node as usize];
    let (d, r) = ([b[0] - a[0], b[1] - a[1]], [x[0] - a[0], x[1] - a[1]]);
    let whole = (d[0] * d[0] + d[1] * d[1]).sqrt();
    (whole > 0.0).then(|| [(r[0] * d[0] + r[1] * d[1]) / whole, (d[0] * r[1] - d[1] * r[0]) / whole, whole])
}
