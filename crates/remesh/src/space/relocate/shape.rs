//! The shape of cells as their corners have it, and the step of one node to where it is best.
//!
//! A corner with edges e of the ideal corner W has the Jacobian T = E W⁻¹; its measure is
//! f = (|T|² / (3 det^{2/3} T))³ = S³ / (c D²), the cube of the inverse mean ratio (µ₃₀₃ + 1 of Knupp and of
//! Dobrev et al.), 1 for the ideal corner: S is a sum of weighted squares of edges and D the determinant of
//! the edges. In the place of one node S is quadratic and D linear, so f is convex where D > 0.

use super::super::vector::{cross, dot, minus};
use super::super::{Cell, Kind, Mesh, Point};

/// A corner: its node and the three nodes at its edges, which are right-handed.
#[derive(Clone, Copy, Debug)]
struct Corner {
    nodes: [u32; 4],
    kind: Kind,
}

/// Edges of a corner whose squares count: nodes of the corner, and weights.
const ALL: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [2, 3], [3, 1]];

impl Corner {
    /// Weights of the squares of `ALL`, and c.
    fn rule(&self) -> ([f64; 6], f64) {
        match self.kind {
            Kind::Hexahedron => ([1.0, 1.0, 1.0, 0.0, 0.0, 0.0], 27.0),
            Kind::Wedge => ([2.0 / 3.0, 2.0 / 3.0, 1.0, 2.0 / 3.0, 0.0, 0.0], 36.0),
            Kind::Tetrahedron | Kind::Tetrahedron10 => ([1.0; 6], 432.0),
        }
    }

    fn places(&self, positions: &[Point]) -> [Point; 4] {
        self.nodes.map(|node| positions[node as usize])
    }

    /// The scaled Jacobian: the determinant over the product of the edges' lengths, 1 for the ideal corner.
    fn scaled(&self, positions: &[Point]) -> f64 {
        let x = self.places(positions);
        let edges = [1, 2, 3].map(|k| minus(x[k], x[0]));
        let squares = edges.map(|edge| dot(edge, edge));
        let ideal = match self.kind {
            Kind::Hexahedron => 1.0,
            Kind::Wedge => 0.5 * 3.0f64.sqrt(),
            Kind::Tetrahedron | Kind::Tetrahedron10 => 0.5 * 2.0f64.sqrt(),
        };
        let product = (squares[0] * squares[1] * squares[2]).sqrt();
        let determinant = dot(cross(edges[0], edges[1]), edges[2]);
        if product > 0.0 { determinant / (ideal * product) } else { 0.0 }
    }
}

/// Nodes next to each corner of a cell, right-handed.
fn corners_of(kind: Kind) -> &'static [[u8; 4]] {
    match kind {
        Kind::Hexahedron => {
            &[[0, 1, 3, 4], [1, 2, 0, 5], [2, 3, 1, 6], [3, 0, 2, 7], [4, 7, 5, 0], [5, 4, 6, 1], [6, 5, 7, 2], [7, 6, 4, 3]]
        }
        Kind::Wedge => &[[0, 1, 2, 3], [1, 2, 0, 4], [2, 0, 1, 5], [3, 5, 4, 0], [4, 3, 5, 1], [5, 4, 3, 2]],
        Kind::Tetrahedron | Kind::Tetrahedron10 => &[[0, 1, 2, 3], [1, 2, 0, 3], [2, 0, 1, 3], [3, 0, 2, 1]],
    }
}

fn corners(cell: &Cell) -> impl Iterator<Item = Corner> + '_ {
    let of = |corner: &[u8; 4]| Corner { nodes: corner.map(|k| cell.nodes()[usize::from(k)]), kind: cell.kind() };
    corners_of(cell.kind()).iter().map(of)
}

/// Least scaled Jacobian of the corners of a cell.
pub(super) fn of_cell(positions: &[Point], cell: &Cell) -> f64 {
    corners(cell).map(|corner| corner.scaled(positions)).fold(f64::INFINITY, f64::min)
}

/// The corners that each node's place matters to.
pub(super) struct Corners {
    first: Vec<u32>,
    all: Vec<Corner>,
}

/// What the corners around a node say of its place.
struct Sum {
    value: f64,
    gradient: Point,
    hessian: [[f64; 3]; 3],
}

/// Parts of a step that are tried at most, each half of the one before.
const HALVES: usize = 8;
/// A step by the length of edges below which a node stays.
const SLIGHT: f64 = 1e-4;
/// A corner's determinant stays above this part of what it was.
const LEAST: f64 = 0.2;

impl Corners {
    pub(super) fn new(mesh: Mesh<'_>) -> Self {
        let mut list: Vec<(u32, Corner)> = Vec::new();
        for cell in mesh.cells {
            for corner in corners(cell) {
                // The four corners of a tetrahedron measure the same.
                let counts = cell.kind() != Kind::Tetrahedron || corner.nodes[0] == cell.nodes()[0];
                if counts {
                    list.extend(corner.nodes.map(|node| (node, corner)));
                }
            }
        }
        list.sort_by_key(|&(node, _)| node);
        let mut first = vec![0; mesh.positions.len() + 1];
        list.iter().for_each(|&(node, _)| first[node as usize + 1] += 1);
        (1..first.len()).for_each(|k| first[k] += first[k - 1]);
        Self { first, all: list.into_iter().map(|(_, corner)| corner).collect() }
    }

    fn around(&self, node: usize) -> &[Corner] {
        &self.all[self.first[node] as usize..self.first[node + 1] as usize]
    }

    /// Nodes of these corners, some of them more than once.
    pub(super) fn near(&self, node: usize) -> impl Iterator<Item = usize> + '_ {
        self.around(node).iter().flat_map(|corner| corner.nodes).map(|node| node as usize)
    }

    /// Mean length of the edges at a node.
    pub(super) fn edge(&self, positions: &[Point], node: usize) -> f64 {
        let (mut sum, mut count) = (0.0, 0.0);
        for other in self.around(node).iter().filter(|corner| corner.nodes[0] as usize == node).flat_map(|corner| &corner.nodes[1..]) {
            let arm = minus(positions[*other as usize], positions[node]);
            (sum, count) = (sum + dot(arm, arm).sqrt(), count + 1.0);
        }
        if count > 0.0 { sum / count } else { self.reach(positions, node) }
    }

    /// Distance of the nearest other node.
    fn reach(&self, positions: &[Point], node: usize) -> f64 {
        let arms = self.near(node).filter(|&other| other != node).map(|other| minus(positions[other], positions[node]));
        arms.map(|arm| dot(arm, arm)).fold(f64::INFINITY, f64::min).sqrt()
    }

    /// Σ f around a node with it at `x`; `None` where a determinant is not more than the part `least` of what
    /// it was with the node where it is.
    fn value(&self, positions: &[Point], node: usize, x: Point, least: f64) -> Option<f64> {
        let mut sum = 0.0;
        for corner in self.around(node) {
            let (weights, c) = corner.rule();
            let old = corner.places(positions);
            let at = corner.nodes.iter().position(|&own| own as usize == node)?;
            let mut new = old;
            new[at] = x;
            let determinant = |x: &[Point; 4]| dot(cross(minus(x[1], x[0]), minus(x[2], x[0])), minus(x[3], x[0]));
            let d = determinant(&new);
            if !(d > least * determinant(&old)) || !(d > 0.0) {
                return None;
            }
            let s = squares(&new, &weights);
            sum += s * s * s / (c * d * d);
        }
        Some(sum)
    }

    /// Σ f around a node, its slope and its curvature in the place of the node.
    fn sum(&self, positions: &[Point], node: usize) -> Option<Sum> {
        let mut sum = Sum { value: 0.0, gradient: [0.0; 3], hessian: [[0.0; 3]; 3] };
        for corner in self.around(node) {
            let (weights, c) = corner.rule();
            let x = corner.places(positions);
            let at = corner.nodes.iter().position(|&own| own as usize == node)?;
            // ∇S = 2 m x − …, ∇∇S = 2 m.
            let (mut slope, mut m) = ([0.0; 3], 0.0);
            for (&[a, b], &weight) in ALL.iter().zip(&weights) {
                let Some(other) = [(a, b), (b, a)].into_iter().find_map(|(own, other)| (own == at).then_some(other)) else { continue };
                let arm = minus(x[at], x[other]);
                (0..3).for_each(|k| slope[k] += 2.0 * weight * arm[k]);
                m += 2.0 * weight;
            }
            let e = [1, 2, 3].map(|k| minus(x[k], x[0]));
            let faces = [cross(e[1], e[2]), cross(e[2], e[0]), cross(e[0], e[1])];
            let turn = if at == 0 { [0, 1, 2].map(|k| -(faces[0][k] + faces[1][k] + faces[2][k])) } else { faces[at - 1] };
            let (s, d) = (squares(&x, &weights), dot(faces[0], e[0]));
            if !(d > 0.0) {
                return None;
            }
            let f = s * s * s / (c * d * d);
            let (by_s, by_d) = (3.0 * f / s, -2.0 * f / d);
            let (by_ss, by_sd, by_dd) = (6.0 * f / (s * s), -6.0 * f / (s * d), 6.0 * f / (d * d));
            sum.value += f;
            for i in 0..3 {
                sum.gradient[i] += by_s * slope[i] + by_d * turn[i];
                sum.hessian[i][i] += by_s * m;
                for j in 0..3 {
                    let mixed = slope[i] * turn[j] + turn[i] * slope[j];
                    sum.hessian[i][j] += by_ss * slope[i] * slope[j] + by_sd * mixed + by_dd * turn[i] * turn[j];
                }
            }
        }
        Some(sum)
    }

    /// Takes a step of a node that is free within `ways`, and brings it with `onto` back to where it may be.
    /// Returns the step by the length of its edges.
    pub(super) fn step(&self, positions: &mut [Point], node: usize, ways: &Ways, onto: impl Fn(Point) -> Point) -> f64 {
        let Some(sum) = self.sum(positions, node) else { return 0.0 };
        let step = ways.newton(&sum);
        let (from, edge) = (positions[node], self.edge(positions, node));
        // What rounding decides whether the sum falls is left.
        if !(dot(step, step) > SLIGHT * SLIGHT * edge * edge) {
            return 0.0;
        }
        let mut part = 1.0;
        for _ in 0..HALVES {
            let place = onto([0, 1, 2].map(|k| from[k] + part * step[k]));
            if self.value(positions, node, place, LEAST).is_some_and(|value| value < sum.value) {
                positions[node] = place;
                let moved = minus(place, from);
                return dot(moved, moved).sqrt() / edge;
            }
            part *= 0.5;
        }
        0.0
    }
}

/// S of a corner.
fn squares(x: &[Point; 4], weights: &[f64; 6]) -> f64 {
    let of = |(&[a, b], &weight): (&[usize; 2], &f64)| {
        let edge = minus(x[b], x[a]);
        if weight == 0.0 { 0.0 } else { weight * dot(edge, edge) }
    };
    ALL.iter().zip(weights).map(of).sum()
}

/// Where a node may go.
#[derive(Clone, Copy, Debug)]
pub(super) enum Ways {
    /// Anywhere.
    All,
    /// Across a unit vector.
    Across(Point),
    /// Along a unit vector.
    Along(Point),
}

impl Ways {
    /// The step to the least of the quadratic function that has this slope and curvature.
    fn newton(&self, sum: &Sum) -> Point {
        let Sum { gradient, hessian, .. } = sum;
        let times = |h: &[[f64; 3]; 3], v: Point| [0, 1, 2].map(|i| dot(h[i], v));
        match *self {
            Self::All => solve(hessian, gradient.map(|g| -g)),
            Self::Along(way) => {
                let (slope, curvature) = (dot(*gradient, way), dot(way, times(hessian, way)));
                way.map(|w| if curvature > 0.0 { -w * slope / curvature } else { 0.0 })
            }
            Self::Across(normal) => {
                let along = dot(*gradient, normal);
                let right = [0, 1, 2].map(|k| along * normal[k] - gradient[k]);
                let (turned, trace) = (times(hessian, normal), hessian[0][0] + hessian[1][1] + hessian[2][2]);
                let both = dot(normal, turned);
                // P H P + n nᵀ tr H with P = 1 − n nᵀ.
                let entry = |i: usize, j: usize| {
                    hessian[i][j] - normal[i] * turned[j] - turned[i] * normal[j] + (both + trace) * normal[i] * normal[j]
                };
                solve(&[0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j))), right)
            }
        }
    }
}

/// The solution of a symmetric positive system; zero where it is none.
fn solve(m: &[[f64; 3]; 3], right: Point) -> Point {
    let rows = [cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])];
    let determinant = dot(m[0], rows[0]);
    if determinant > 0.0 {
        [0, 1, 2].map(|k| (rows[0][k] * right[0] + rows[1][k] * right[1] + rows[2][k] * right[2]) / determinant)
    } else {
        [0.0; 3]
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::vector::six_volumes;
    use super::*;
    use crate::shared::random::Random;

    fn ideal(kind: Kind) -> (Vec<Point>, Cell) {
        let mut places = kind.reference().to_vec();
        let height = 3.0f64.sqrt() / 2.0;
        match kind {
            Kind::Wedge => {
                for k in 0..6 {
                    places[k] = [[0.0, 0.0], [1.0, 0.0], [0.5, height]][k % 3]
                        .into_iter()
                        .chain([(k / 3) as f64])
                        .collect::<Vec<_>>()
                        .try_into()
                        .unwrap();
                }
            }
            Kind::Tetrahedron => places = vec![[1.0, 1.0, 1.0], [-1.0, 1.0, -1.0], [1.0, -1.0, -1.0], [-1.0, -1.0, 1.0]],
            _ => {}
        }
        let nodes: Vec<u32> = (0..places.len() as u32).collect();
        (places, Cell::new(kind, &nodes).unwrap())
    }

    #[test]
    fn ideal_cells_have_one_and_slopes_are_those_of_differences() {
        let mut random = Random::new(5);
        for kind in [Kind::Hexahedron, Kind::Wedge, Kind::Tetrahedron] {
            let (mut places, cell) = ideal(kind);
            if kind == Kind::Tetrahedron {
                assert!(six_volumes(&[places[0], places[1], places[2], places[3]]) > 0.0);
            }
            assert!((of_cell(&places, &cell) - 1.0).abs() < 1e-14, "{kind:?}");
            let cells = [cell];
            let corners = Corners::new(Mesh { positions: &places, cells: &cells });
            for node in 0..places.len() {
                let sum = corners.sum(&places, node).unwrap();
                let count = corners.around(node).len() as f64;
                assert!((sum.value - count).abs() < 1e-13 * count, "{kind:?} {}", sum.value);
            }
            places.iter_mut().flatten().for_each(|x| *x += 0.1 * random.next());
            let corners = Corners::new(Mesh { positions: &places, cells: &cells });
            for node in 0..places.len() {
                let sum = corners.sum(&places, node).unwrap();
                assert!((corners.value(&places, node, places[node], 0.0).unwrap() - sum.value).abs() < 1e-12 * sum.value);
                let h = 1e-5;
                for k in 0..3 {
                    let at = |by: f64| {
                        let mut moved = places.clone();
                        moved[node][k] += by;
                        corners.sum(&moved, node).unwrap()
                    };
                    let (low, high) = (at(-h), at(h));
                    assert!(((high.value - low.value) / (2.0 * h) - sum.gradient[k]).abs() < 1e-6 * sum.value);
                    for j in 0..3 {
                        assert!(((high.gradient[j] - low.gradient[j]) / (2.0 * h) - sum.hessian[k][j]).abs() < 1e-5 * sum.value);
                    }
                }
            }
        }
    }
}
