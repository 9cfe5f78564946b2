//! Ends of the springs between nodes and facets: who has which share of the gap, and what makes the slip rate
//! blind to rotations.
//!
//! Projections come from the tracker, springs go to the formulation. The slip rate is that of the node
//! against the surface at the node's own distance, ṡ = t·(v − Σ w v_C − ω × r) with r = x − P and the spin ω
//! of what is there: ω = N × Ṅ + ½ N (N·∇ × v) is the body's own for every rigid motion, so ṡ does not see
//! rotations of both together, and its transpose, the friction, keeps the angular momentum. At an edge or a
//! node no facet is the nearest one, rounding would choose it: ω is the mean over those that meet there.

use super::first_edge;
use super::tangent;
use crate::contact::projection::node_facet::{Placed, Projection, Vector, unit};
use crate::contact::springs::{End, TangentSpace};
use crate::mesh::surface::Corners;
use crate::tensor::{Dim, cross, dot};
use crate::vector::minus;

/// Spin ω = Σ a (b·v) by the velocity v of a corner: two pairs [a, b].
type Spin = [[Vector; 2]; 2];

/// The ends of a spring that does not care for slip, between a node and where it projects, and how many there
/// are: those of corners with a share.
pub(super) fn pushed(placed: &Placed<'_>, node: u32, projection: &Projection) -> ([End<3>; 5], usize) {
    let (corners, mut ends, mut count) = (placed.surface.facets[projection.facet as usize], [End::node(node, 1.0); 5], 1);
    for (corner, weight) in corners.into_iter().zip(projection.weights).filter(|(_, weight)| *weight != 0.0) {
        // As in `ends`, what is pulled belongs to the target all the same.
        let lean = projection.normal.map(|n| (-weight).max(0.0) * n);
        ends[count] = End { lean, ..End::node(corner, -weight.max(0.0)) };
        count += 1;
    }
    (ends, count)
}

/// The ends of a spring between a node and where it projects, and how many there are, with the spin of the
/// projection's triangle.
#[must_use]
pub fn ends(placed: &Placed<'_>, node: u32, projection: &Projection) -> ([End<3>; 5], usize) {
    let Projection { facet, triangle, .. } = *projection;
    let tangent = tangent(projection.normal, first_edge(placed, facet));
    let pulls = pulls(placed, node, projection, &tangent);
    let (mut ends, known) = corners(placed, node, projection);
    let spread = |k: usize| {
        let mut unit = [0.0; 3];
        unit[k] = 1.0;
        placed.spread(facet, triangle, unit)
    };
    for (end, spin) in ends[1..known].iter_mut().zip(&spins(placed.triangle(facet, triangle), spread)) {
        turn_with(end, spin, &pulls, 1.0);
    }
    pull_along(&mut ends[1..known], projection, &tangent);
    (ends, known)
}

/// The same with the mean spin of the `facets` on which the foot lies, along `tangent` and across it; corners
/// of others than the projection's own go to `more`.
pub(super) fn ends_with(
    placed: &Placed<'_>,
    (node, projection): (u32, &Projection),
    tangent: &Vector,
    facets: impl Iterator<Item = u32> + Clone,
    more: &mut Vec<End<3>>,
) -> ([End<3>; 5], usize) {
    let pulls = pulls(placed, node, projection, tangent);
    let (mut ends, known) = corners(placed, node, projection);
    let share = 1.0 / facets.clone().count() as f64;
    more.clear();
    for facet in facets {
        for (&corner, spin) in placed.surface.facets[facet as usize].corners().iter().zip(&facet_spins(placed, facet)) {
            let own = ends[1..known].iter_mut().find(|end| end.at == corner);
            let end = match own {
                Some(end) => end,
                None => {
                    let k = more.iter().position(|end| end.at == corner).unwrap_or(more.len());
                    if k == more.len() {
                        more.push(End::node(corner, 0.0));
                    }
                    &mut more[k]
                }
            };
            turn_with(end, spin, &pulls, share);
        }
    }
    pull_along(&mut ends[1..known], projection, tangent);
    (ends, known)
}

/// The node and the corners of the projection's facet with their shares of the gap.
fn corners(placed: &Placed<'_>, node: u32, projection: &Projection) -> ([End<3>; 5], usize) {
    let corners = placed.surface.facets[projection.facet as usize];
    let (mut ends, count) = ([End::node(node, 1.0); 5], corners.corners().len());
    for k in 0..count {
        ends[k + 1] = End::node(corners[k], -projection.weights[k]);
    }
    (ends, count + 1)
}

/// Corners of a facet beyond which a node is are pulled along, but belong to the target all the same.
fn pull_along(corners: &mut [End<3>], projection: &Projection, tangent: &Vector) {
    let tangents = Dim::<3>::tangents(projection.normal, tangent);
    for (end, weight) in corners.iter_mut().zip(projection.weights).filter(|(_, weight)| *weight < 0.0) {
        let beyond = -weight;
        let turn = [0, 1].map(|a| [0, 1, 2].map(|d| end.turn[a][d] + beyond * tangents[a][d]));
        *end = End { turn, lean: projection.normal.map(|n| beyond * n), ..End::node(end.at, 0.0) };
    }
}

/// r × t of both tangents: t·(ω × r) = ω·(r × t).
fn pulls(placed: &Placed<'_>, node: u32, projection: &Projection, tangent: &Vector) -> [Vector; 2] {
    let arm = minus(placed.positions[node as usize], projection.foot);
    Dim::<3>::tangents(projection.normal, tangent).map(|t| cross(arm, t))
}

/// Takes a share of the spin that a corner makes out of the slip rates.
fn turn_with(end: &mut End<3>, spin: &Spin, pulls: &[Vector; 2], share: f64) {
    for (turn, pull) in end.turn.iter_mut().zip(pulls) {
        for [spin, by] in spin {
            let along = share * dot(*pull, *spin);
            (0..3).for_each(|d| turn[d] -= along * by[d]);
        }
    }
}

/// How a facet spins with each corner, one of four nodes by its diagonals: none of its triangles counts more
/// than another.
fn facet_spins(placed: &Placed<'_>, facet: u32) -> [Spin; 4] {
    let corners = placed.surface.facets[facet as usize];
    let [a, b, c, d] = corners.map(|node| placed.positions[node as usize]);
    if corners.corners().len() == 3 {
        return spins([a, b, c], |k| std::array::from_fn(|corner| f64::from(u8::from(corner == k))));
    }
    // Of both vectors from one place.
    let ends = [[0.0; 3], minus(c, a), minus(d, b)];
    spins(ends, |k| [[0.0; 4], [-1.0, 0.0, 1.0, 0.0], [0.0, -1.0, 0.0, 1.0]][k])
}

/// How a triangle spins with each of four corners that have `shares` of its own.
fn spins(x: [Vector; 3], shares: impl Fn(usize) -> [f64; 4]) -> [Spin; 4] {
    let area = cross(minus(x[1], x[0]), minus(x[2], x[0]));
    let square = dot(area, area);
    let mut spins = [[[[0.0; 3]; 2]; 2]; 4];
    if !(square > 0.0) {
        return spins;
    }
    let (twice, normal) = (square.sqrt(), unit(area));
    // N × ∇Φ_k = −e / 2A with the opposite edge e
    let of = [0, 1, 2].map(|k| minus(x[(k + 2) % 3], x[(k + 1) % 3]).map(|e| -e / twice));
    let shares = [0, 1, 2].map(shares);
    for (corner, spin) in spins.iter_mut().enumerate() {
        let whole = [0, 1, 2].map(|d| (0..3).map(|k| shares[k][corner] * of[k][d]).sum::<f64>());
        // ω = −(N × ∇Φ)(N·v) + ½ N ((N × ∇Φ)·v)
        *spin = [[whole.map(|c| -c), normal], [normal.map(|n| 0.5 * n), whole]];
    }
    spins
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::Random;
    use crate::mesh::cell::CellKind;
    use crate::mesh::surface::{NONE, SpaceSurface};
    use std::collections::BTreeMap;

    /// An L of three crooked hexahedra with a corner near the origin and the bottom of its fold from node 7
    /// to node 10, as grids of 3 × 2 × 3 nodes number them; then a node.
    fn fold(x: impl Fn(Vector, Vector) -> Vector) -> (SpaceSurface, Vec<Vector>) {
        let node = |i: u32, j: u32, k: u32| 3 * (2 * k + j) + i;
        let cell = |i: u32, k: u32| {
            let square = |k: u32| [node(i, 0, k), node(i + 1, 0, k), node(i + 1, 1, k), node(i, 1, k)];
            [square(k), square(k + 1)].concat()
        };
        let cells = [cell(0, 0), cell(1, 0), cell(0, 1)];
        let surface = SpaceSurface::outside(cells.iter().map(|cell| CellKind::Hexahedron.cell(cell))).unwrap();
        let mut random = Random::new(5);
        let place = |k: u32| [k % 3, k / 3 % 2, k / 6].map(|c| f64::from(c) + 0.2 * (random.unit() - 0.5));
        let mut positions: Vec<Vector> = (0..18).map(place).collect();
        let node = x(positions[7], positions[10]);
        positions.push(node);
        (surface, positions)
    }

    /// Rows of the gap and of both slips for each node.
    fn rows(placed: &Placed<'_>, projection: &Projection) -> BTreeMap<u32, [Vector; 3]> {
        let tangent = tangent(projection.normal, [0.3, 0.9, -0.2]);
        let mut more = vec![End::node(99, 1.0)];
        let facets = placed.surface.sharing(projection.facet, placed.rests_on(projection));
        let (ends, known) = ends_with(placed, (18, projection), &tangent, facets, &mut more);
        let tangents = Dim::<3>::tangents(projection.normal, &tangent);
        let row = |end: &End<3>, along: Vector, beyond: Vector| [0, 1, 2].map(|d| end.share * along[d] + beyond[d]);
        let of =
            |end: &End<3>| [row(end, projection.normal, end.lean), row(end, tangents[0], end.turn[0]), row(end, tangents[1], end.turn[1])];
        ends[..known].iter().chain(&more).map(|end| (end.at, of(end))).filter(|(_, rows)| *rows != [[0.0; 3]; 3]).collect()
    }

    #[test]
    fn in_a_fold_it_says_nothing_which_facet_is_named_and_rotations_of_both_are_not_seen() {
        let edge = |a: Vector, b: Vector| [0, 1, 2].map(|d| 0.6 * a[d] + 0.4 * b[d] + [-0.11, 0.01, -0.12][d]);
        let corner = |_: Vector, _: Vector| [-0.5, -0.6, -0.5];
        let face = |a: Vector, b: Vector| [0, 1, 2].map(|d| 0.6 * a[d] + 0.4 * b[d] + [0.4, 0.01, -0.12][d]);
        for (x, sharing) in [(&edge as &dyn Fn(Vector, Vector) -> Vector, 2), (&corner, 3), (&face, 1)] {
            let (surface, positions) = fold(x);
            let placed = Placed { surface: &surface, positions: &positions };
            let all = 0..surface.facets.len() as u32;
            let best = placed.project(positions[18], all.clone()).unwrap();
            let rest = placed.rests_on(&best);
            assert_eq!((rest[0] == NONE, rest[1] == NONE), [(true, true), (false, false), (false, true)][sharing - 1]);
            let facets: Vec<u32> = surface.sharing(best.facet, rest).collect();
            assert_eq!(facets.len(), sharing);
            let expected = rows(&placed, &best);
            for facet in facets {
                let found = rows(&placed, &placed.project(positions[18], [facet]).unwrap());
                assert!(found.keys().eq(expected.keys()));
                let apart = |(one, other): (&[Vector; 3], &[Vector; 3])| {
                    one.iter().flatten().zip(other.iter().flatten()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
                };
                assert!(found.values().zip(expected.values()).map(apart).fold(0.0, f64::max) < 1e-13, "{found:?} {expected:?}");
            }
            for row in 0..3 {
                let (mut sum, mut moment) = ([0.0; 3], [0.0; 3]);
                for (&at, rows) in &expected {
                    let turn = cross(positions[at as usize], rows[row]);
                    (0..3).for_each(|d| (sum[d], moment[d]) = (sum[d] + rows[row][d], moment[d] + turn[d]));
                }
                assert!(sum.iter().chain(&moment).all(|c| c.abs() < 1e-13), "{row}: {sum:?} {moment:?}");
            }
        }
    }
}
