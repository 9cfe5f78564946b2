//! Where two edges of surfaces in 3D cross, and from which side: closest points of both lines, and the gap
//! between them.
//!
//! Surfaces come from the mesh, positions from the step; crossings go to the formulation. Only edges that
//! fold outward count (ridges). Two ridges that cross make a corner of the set of all differences of points
//! of both bodies, which is there a half-space with the normal n = ± e_a × e_b: the gap g = (x_a − x_b)·n is
//! the exact depth of the two wedges, whatever of them is nearest. Which of both signs, and whether they meet
//! at all, the outer normals say: n must leave the second ridge between its facets, and −n the first one.
//!
//! The rows of the gap are its gradient, ± w n at the ends of the edges: closest points change nothing by
//! their own motion. x_a − x_b is along n, so both momenta are kept.

use super::node_facet::{Placed, Vector, unit};
use crate::mesh::surface::NONE;
use crate::tensor::{cross, dot};
use crate::vector::minus;

/// Cosine of the angle between the facets of an edge below which it is a ridge (20 degrees): what nodes alone
/// miss of flatter ones is less than 5 % of their length.
const SHARP: f64 = 0.94;
/// The same of one that may become a ridge while its nodes go as far as they may until the next search (10
/// degrees).
const BLUNT: f64 = 0.985;
/// Sine of the angle between edges below which they do not cross.
const PARALLEL: f64 = 0.1;

/// An edge that folds outward.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ridge {
    /// From the edge into its facets, at right angles to it.
    inward: [Vector; 2],
    /// Sine of half of the angle between the facets' normals.
    half: f64,
    /// Cosine of the angle.
    cosine: f64,
    /// How far the facets go from the edge, m: the lesser of both.
    pub width: f64,
}

impl Ridge {
    /// Whether it folds enough to count.
    #[must_use]
    pub fn is_sharp(&self) -> bool {
        self.cosine < SHARP
    }

    /// Whether it folds enough to count, or may soon.
    #[must_use]
    pub fn may_be_sharp(&self) -> bool {
        self.cosine < BLUNT
    }

    /// How well a direction leaves the body there: 1 half way between the facets' normals, 0 along one of
    /// them, negative beyond.
    fn opens(&self, direction: Vector) -> f64 {
        let [a, b] = self.inward.map(|inward| dot(direction, inward));
        -a.max(b) / self.half
    }
}

/// Where two edges are nearest to each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// How far along either edge: 0 and 1 are its nodes.
    pub along: [f64; 2],
    /// Gap, m: negative inside.
    pub gap: f64,
    /// From the second to the first where it is outside.
    pub normal: Vector,
}

impl Crossing {
    /// Whether it is on both edges, or beyond their ends by no more than such a fraction of them.
    #[must_use]
    pub fn is_within(&self, slack: f64) -> bool {
        self.along.iter().all(|along| (-slack..=1.0 + slack).contains(along))
    }

    /// The same seen from the other side.
    #[must_use]
    pub fn turned(self) -> Self {
        Self { gap: -self.gap, normal: self.normal.map(|n| -n), ..self }
    }

    /// How well the opposite of the normal leaves the first ridge and the normal the second one: 1 half way
    /// between the facets' normals, 0 along one of them, negative beyond.
    #[must_use]
    pub fn fits(&self, [a, b]: [&Ridge; 2]) -> [f64; 2] {
        [a.opens(self.normal.map(|n| -n)), b.opens(self.normal)]
    }
}

/// Place on an edge.
#[must_use]
pub fn point([a, b]: [Vector; 2], along: f64) -> Vector {
    [0, 1, 2].map(|d| (1.0 - along) * a[d] + along * b[d])
}

/// Where the lines through two edges are nearest, from either side. `None` where they are (nearly) parallel,
/// or no numbers.
#[must_use]
pub fn crossing(a: [Vector; 2], b: [Vector; 2]) -> Option<Crossing> {
    let (p, q, r) = (minus(a[1], a[0]), minus(b[1], b[0]), minus(a[0], b[0]));
    let (pp, qq, pq, pr, qr) = (dot(p, p), dot(q, q), dot(p, q), dot(p, r), dot(q, r));
    let across = pp * qq - pq * pq;
    if !(across > PARALLEL * PARALLEL * pp * qq) {
        return None;
    }
    let along = [(pq * qr - pr * qq) / across, (pp * qr - pq * pr) / across];
    let normal = unit(cross(p, q));
    let away = minus(point(a, along[0]), point(b, along[1]));
    Some(Crossing { along, gap: dot(away, normal), normal })
}

/// Distance of two edges, m (Ericson, Real-Time Collision Detection, section 5.1.9).
#[must_use]
pub fn distance(a: [Vector; 2], b: [Vector; 2]) -> f64 {
    let (p, q, r) = (minus(a[1], a[0]), minus(b[1], b[0]), minus(a[0], b[0]));
    let (pp, qq, pq, pr, qr) = (dot(p, p), dot(q, q), dot(p, q), dot(p, r), dot(q, r));
    let clamped = |above: f64, below: f64| if below > 0.0 { (above / below).clamp(0.0, 1.0) } else { 0.0 };
    let s = clamped(pq * qr - pr * qq, pp * qq - pq * pq);
    // The nearest of b to that, and where it is beyond an end the nearest of a to the end.
    let t = clamped(pq * s + qr, qq);
    let s = clamped(pq * t - pr, pp);
    let away = minus(point(a, s), point(b, t));
    dot(away, away).sqrt()
}

impl Placed<'_> {
    /// Ends of an edge, m.
    #[must_use]
    pub fn edge(&self, edge: u32) -> [Vector; 2] {
        self.surface.edges[edge as usize].nodes.map(|node| self.positions[node as usize])
    }

    /// An edge that folds outward; `None` where it folds inward, or the surface ends: on a symmetry plane
    /// other edges, which end there too, meet it with their nodes.
    #[must_use]
    pub fn ridge(&self, edge: u32) -> Option<Ridge> {
        let [first, other] = self.surface.edges[edge as usize].facets;
        if other == NONE {
            return None;
        }
        let corner = |facet: u32| (0..4).find(|&k| self.surface.edges_of[facet as usize][k] == edge).unwrap_or(0);
        let [normal, beyond] = [first, other].map(|facet| self.normal(facet, self.at_edge(facet, corner(facet))));
        let [a, b] = self.edge(edge);
        let along = unit(minus(b, a));
        // The first facet has the edge in this direction, with its inside on the left.
        let inward = [cross(normal, along), cross(along, beyond)];
        if !(dot(inward[0], beyond) < 0.0) {
            return None;
        }
        let cosine = dot(normal, beyond);
        let width = |(facet, inward): (u32, Vector)| {
            let off = |&node: &u32| dot(minus(self.positions[node as usize], a), inward);
            self.surface.facets[facet as usize].iter().map(off).fold(0.0, f64::max)
        };
        let width = width((first, inward[0])).min(width((other, inward[1])));
        Some(Ridge { inward, half: (0.5 * (1.0 - cosine)).max(0.0).sqrt(), cosine, width })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::cell::CellKind;
    use crate::mesh::surface::Surface;
    use proptest::prelude::*;

    #[test]
    fn edges_of_a_cube_are_ridges_and_those_of_a_notch_are_not() {
        let cells = [CellKind::Hexahedron.cell(&[0, 1, 2, 3, 4, 5, 6, 7])];
        let surface = Surface::<3>::outside(cells).unwrap();
        let mut x: Vec<Vector> = (0..8).map(|k| [f64::from(k & 1 ^ (k >> 1 & 1)), f64::from(k >> 1 & 1), f64::from(k >> 2)]).collect();
        let placed = Placed { surface: &surface, positions: &x };
        for edge in 0..12 {
            let ridge = placed.ridge(edge).unwrap();
            assert!(ridge.is_sharp() && (ridge.width - 1.0).abs() < 1e-15 && (ridge.half - 0.5f64.sqrt()).abs() < 1e-15);
            // Half way between the normals it opens most.
            let [a, b] = placed.edge(edge);
            let out = unit([0, 1, 2].map(|d| 0.5 * (a[d] + b[d]) - 0.5));
            assert!((ridge.opens(out) - 1.0).abs() < 1e-14);
        }
        // Inside out.
        x.iter_mut().for_each(|x| x[2] = -x[2]);
        assert!((0..12).all(|edge| Placed { surface: &surface, positions: &x }.ridge(edge).is_none()));
    }

    fn vector() -> impl Strategy<Value = Vector> {
        prop::array::uniform3(-1.0..1.0_f64)
    }

    fn segment() -> impl Strategy<Value = [Vector; 2]> {
        prop::array::uniform2(vector())
    }

    proptest! {
        #[test]
        fn rows_are_the_gradient_of_the_gap_and_blind_to_rigid_motion(a in segment(), b in segment()) {
            let Some(found) = crossing(a, b) else { return Ok(()) };
            let Crossing { along: [s, t], gap, normal } = found;
            let scale = 1.0 + s.abs() + t.abs();
            let away = minus(point(a, s), point(b, t));
            prop_assert!(dot(cross(away, normal), cross(away, normal)).sqrt() < 1e-11 * scale);
            let shares = [1.0 - s, s, t - 1.0, -t];
            let nodes = [a[0], a[1], b[0], b[1]];
            for (k, d) in (0..4).flat_map(|k| (0..3).map(move |d| (k, d))) {
                let moved = |by: f64| {
                    let mut x = nodes;
                    x[k][d] += by;
                    crossing([x[0], x[1]], [x[2], x[3]]).map(|found| found.gap)
                };
                let (Some(high), Some(low)) = (moved(1e-6), moved(-1e-6)) else { return Ok(()) };
                let slope = (high - low) / 2e-6;
                let edge = dot(minus(a[1], a[0]), minus(a[1], a[0])).min(dot(minus(b[1], b[0]), minus(b[1], b[0])));
                prop_assert!((shares[k] * normal[d] - slope).abs() < 1e-7 * scale * scale * (1.0 + gap.abs()) / edge, "{} {}", shares[k] * normal[d], slope);
            }
        }

        #[test]
        fn the_distance_of_edges_is_the_least_of_their_points(a in segment(), b in segment()) {
            let found = distance(a, b);
            let mut least = f64::INFINITY;
            for (i, j) in (0..=60).flat_map(|i| (0..=60).map(move |j| (i, j))) {
                let away = minus(point(a, f64::from(i) / 60.0), point(b, f64::from(j) / 60.0));
                least = least.min(dot(away, away).sqrt());
            }
            prop_assert!(found <= least + 1e-12 && least - found < 0.1, "{} {}", found, least);
        }
    }
}
