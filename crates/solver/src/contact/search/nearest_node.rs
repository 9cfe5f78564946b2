//! Facets of the target nodes that come near a slave node: the paper's method (a), made safe.
//!
//! The paper takes the facets of the one nearest target node; beside a long facet whose nodes are both far
//! that one belongs to another facet. Here all target nodes count that come nearer than the reach and a part
//! of their longest facet, which loses nothing:
//!
//! If the slave node comes nearer than `reach` to a facet at time t, it does so to a point q of the facet.
//! The facet's nodes lie in a ball of radius R ≤ L √((D − 1) / (2 D)), L its diameter (Jung 1901): half the
//! length of a segment, L/√3 for a triangle. Some node v has |v − q| ≤ R: with q = Σ λ_i v_i and c the ball's
//! centre, Σ λ_i |v_i − q|² = Σ λ_i |v_i − c|² − |q − c|² ≤ R². So at time t the slave node is nearer to v
//! than reach + R. The distance of two nodes that move straight is a convex function of time, so L of the
//! step is reached at its beginning or end, and the least distance of slave node and v is that of a point
//! from a straight line's piece.

use super::extent::Margin;
use super::{Pair, Query, Search, SearchKind};

pub(super) fn kind<const D: usize>() -> SearchKind<D> {
    SearchKind {
        name: "nearest_node",
        doc: "facets of every target node that comes nearer than the reach plus half its longest facet; slaves x target nodes comparisons",
        source: "Bittencourt and Creus 1995, global search (a), with all near nodes instead of the nearest",
        make: || Box::new(NearestNode { corners: Vec::new(), targets: Vec::new(), found: Vec::new() }),
    }
}

/// Storage kept between calls.
struct NearestNode {
    /// (node, facet), sorted: the facets of each node.
    corners: Vec<(u32, u32)>,
    targets: Vec<Target>,
    /// Facets near one slave node.
    found: Vec<u32>,
}

/// A node of facets.
struct Target {
    node: u32,
    /// Its facets: where they begin and end in the corners.
    facets: (usize, usize),
    /// Largest R of its facets, m.
    radius: f64,
}

impl NearestNode {
    fn gather_targets<const D: usize>(&mut self, query: &Query<'_, D>) {
        self.corners.clear();
        let finite = |n: &u32| [query.positions_old, query.positions_new].iter().all(|x| x[*n as usize].iter().all(|x| x.is_finite()));
        for (nodes, facet) in query.facets.iter().zip(0..).filter(|(nodes, _)| nodes.iter().all(finite)) {
            self.corners.extend(nodes.iter().map(|&n| (n, facet)));
        }
        self.corners.sort_unstable();
        self.targets.clear();
        let mut begin = 0;
        for of_node in self.corners.chunk_by(|a, b| a.0 == b.0) {
            let longest = of_node.iter().map(|&(_, facet)| diameter(query, &query.facets[facet as usize])).fold(0.0, f64::max);
            let end = begin + of_node.len();
            let radius = longest * ((D - 1) as f64 / (2 * D) as f64).sqrt() * (1.0 + 16.0 * f64::EPSILON);
            self.targets.push(Target { node: of_node[0].0, facets: (begin, end), radius });
            begin = end;
        }
    }
}

/// Largest distance of two nodes of a facet during the step, m.
fn diameter<const D: usize>(query: &Query<'_, D>, nodes: &[u32; D]) -> f64 {
    let mut largest = 0.0_f64;
    for x in [query.positions_old, query.positions_new] {
        for i in 0..D {
            for j in 0..i {
                let (p, q) = (&x[nodes[i] as usize], &x[nodes[j] as usize]);
                largest = largest.max((0..D).fold(0.0, |h: f64, d| h.hypot(p[d] - q[d])));
            }
        }
    }
    largest
}

/// Whether two nodes come nearer than `reach` during the step, in doubt yes.
fn come_near<const D: usize>(query: &Query<'_, D>, a: u32, b: u32, reach: f64) -> bool {
    let at = |x: &[[f64; D]]| -> [f64; D] { std::array::from_fn(|d| x[a as usize][d] - x[b as usize][d]) };
    let (begin, end) = (at(query.positions_old), at(query.positions_new));
    let motion: [f64; D] = std::array::from_fn(|d| end[d] - begin[d]);
    let length = (0..D).fold(0.0, |h: f64, d| h.hypot(motion[d]));
    // Along the unit direction: squares of large and small numbers would overflow or vanish.
    let t = if length > 0.0 { ((0..D).map(|d| -begin[d] * (motion[d] / length)).sum::<f64>() / length).clamp(0.0, 1.0) } else { 0.0 };
    // An overflow ends as infinity or NaN here.
    let nearest = (0..D).fold(0.0, |h: f64, d| h.hypot(begin[d] + t * motion[d]));
    if !nearest.is_finite() || !length.is_finite() {
        return true;
    }
    let coordinates =
        [query.positions_old, query.positions_new].map(|x| x[a as usize].iter().chain(&x[b as usize]).fold(0.0, |s, x| s + x.abs()));
    nearest <= Margin::new(reach).at(16.0 * (coordinates[0] + coordinates[1]))
}

impl<const D: usize> Search<D> for NearestNode {
    fn pairs(&mut self, query: &Query<'_, D>, pairs: &mut Vec<Pair>) {
        pairs.clear();
        self.gather_targets(query);
        let reach = query.reach.max(0.0);
        for (&node, slave) in query.slaves.iter().zip(0..) {
            if ![query.positions_old, query.positions_new].iter().all(|x| x[node as usize].iter().all(|x| x.is_finite())) {
                continue;
            }
            self.found.clear();
            for target in &self.targets {
                if come_near(query, node, target.node, reach + target.radius) {
                    let (begin, end) = target.facets;
                    self.found.extend(self.corners[begin..end].iter().map(|&(_, facet)| facet));
                }
            }
            self.found.sort_unstable();
            self.found.dedup();
            let others = self.found.iter().filter(|&&facet| !query.facets[facet as usize].contains(&node));
            pairs.extend(others.map(|&facet| Pair { slave, facet }));
        }
    }
}
