//! Nodes moved to where the cells around them have the best shape: those inside freely, those of the outline
//! along it if they may.
//!
//! One node at a time, in ascending order, takes a Newton step on Σ µ² over the corners of the cells around
//! it, halved until the sum falls and no corner turns inside out. The shape measure of a corner with edges a
//! and b is µ = (|a|² + |b|²) / (2 a × b), 1 for a square; that of a triangle the sum of its squared edges
//! over 4√3 of its area, 1 for an equilateral one. Both are convex in the place of one node. A node that
//! slides takes the step of its line's direction only. Source: Knupp, SIAM J. Sci. Comput. 23 (2001) 193-218
//! (mean ratio).

use super::rails::Rails;
use crate::plane::{Cell, Point, corners, cross, dot, minus};

/// Sweeps at most, and the step by the length of edges below which a node is still.
const SWEEPS: usize = 8;
const STILL: f64 = 1e-2;
/// Scaled Jacobian below which a node's surroundings are made better on their own, and rounds of that.
const POOR: f64 = 0.6;
const ROUNDS: usize = 12;
/// 1/√3.
const TRIANGLE: f64 = 0.577_350_269_189_625_8;

/// Which node of a corner it is whose place matters: that of the corner itself, the next or the last one.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Role {
    Apex,
    Next,
    Last,
    /// Any one of a triangle.
    Triangle,
}

/// A corner seen from one of its nodes: the two others, counter-clockwise.
#[derive(Clone, Copy)]
struct Corner {
    others: [u32; 2],
    role: Role,
}

/// The corners that each node's place matters to.
struct Corners {
    first: Vec<u32>,
    all: Vec<Corner>,
}

/// Moves all nodes that are not held, those inside.
pub(crate) fn smooth(positions: &mut [Point], cells: &[Cell], held: &[bool]) {
    slide(positions, cells, held, &mut Rails::none(), SWEEPS, STILL);
}

/// Moves all nodes that are not held, those on rails along them, in so many sweeps at most; a node whose
/// step is shorter than the part `still` of the edges there is still.
pub(crate) fn slide(positions: &mut [Point], cells: &[Cell], held: &[bool], rails: &mut Rails, sweeps: usize, still: f64) {
    let corners = Corners::new(positions.len(), cells);
    let free: Vec<usize> = (0..positions.len()).filter(|&node| !held[node]).collect();
    untangle(positions, &corners, &free, rails);
    // Nodes that have moved, or next to one, in this sweep and for the next.
    let mut moved = vec![true; positions.len()];
    for _ in 0..sweeps {
        let mut next = vec![false; positions.len()];
        for &node in &free {
            if moved[node] && corners.step(positions, node, rails) > still {
                next[node] = true;
                corners.around(node).flat_map(|corner| corner.others).for_each(|other| next[other as usize] = true);
            }
        }
        if !next.contains(&true) {
            break;
        }
        moved = next;
    }
    untangle(positions, &corners, &free, rails);
}

/// Moves nodes whose surroundings are poor to where the worst corner there is best.
fn untangle(positions: &mut [Point], corners: &Corners, free: &[usize], rails: &mut Rails) {
    const WAYS: [Point; 8] = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0], [0.7, 0.7], [-0.7, 0.7], [-0.7, -0.7], [0.7, -0.7]];
    for _ in 0..ROUNDS {
        let mut moved = false;
        for &node in free {
            let length = corners.edge(positions, node);
            let mut best = corners.worst(positions, node, length);
            if best >= POOR {
                continue;
            }
            let mut step = 0.25 * length;
            for _ in 0..12 {
                let from = positions[node];
                let (mut place, mut by) = (from, 0.0);
                for way in WAYS {
                    let Some(x) = rails.near(node, from, [step * way[0], step * way[1]]) else { continue };
                    positions[node] = x;
                    let worst = corners.worst(positions, node, length);
                    if worst > best + 1e-3 {
                        (best, place, by) = (worst, x, step * way[0]);
                    }
                }
                positions[node] = place;
                rails.slide(node, by);
                if place == from {
                    step *= 0.5;
                } else {
                    moved = true;
                }
            }
        }
        if !moved {
            break;
        }
    }
}

impl Corners {
    fn new(nodes: usize, cells: &[Cell]) -> Self {
        let mut list: Vec<(u32, Corner)> = Vec::with_capacity(12 * cells.len());
        for cell in cells {
            let nodes = corners(cell);
            let n = nodes.len();
            for k in 0..n {
                let [o, a, b] = [nodes[k], nodes[(k + 1) % n], nodes[(k + n - 1) % n]];
                if n == 3 {
                    list.push((o, Corner { others: [a, b], role: Role::Triangle }));
                } else {
                    list.push((o, Corner { others: [a, b], role: Role::Apex }));
                    list.push((a, Corner { others: [b, o], role: Role::Next }));
                    list.push((b, Corner { others: [o, a], role: Role::Last }));
                }
            }
        }
        list.sort_by_key(|&(node, _)| node);
        let mut first = vec![0_u32; nodes + 1];
        list.iter().for_each(|&(node, _)| first[node as usize + 1] += 1);
        for node in 0..nodes {
            first[node + 1] += first[node];
        }
        Self { first, all: list.into_iter().map(|(_, corner)| corner).collect() }
    }

    fn around(&self, node: usize) -> impl Iterator<Item = &Corner> {
        self.all[self.first[node] as usize..self.first[node + 1] as usize].iter()
    }

    /// The least scaled Jacobian around a node, that of triangles not scaled; where it isn't positive the
    /// least Jacobian, by the square of a length: its least is a concave function of the node's place.
    fn worst(&self, positions: &[Point], node: usize, length: f64) -> f64 {
        let (mut least, mut scaled) = (f64::INFINITY, f64::INFINITY);
        for corner in self.around(node) {
            let (p, q) = corner.edges(positions, node);
            let twice = cross(p, q);
            let [one, other] = corner.squares(p, q);
            least = least.min(twice);
            scaled = scaled.min(twice / (one * other).sqrt());
        }
        if least > 0.0 { scaled } else { (least / (length * length)).min(0.0) }
    }

    /// The longest edge of the corners around a node.
    fn edge(&self, positions: &[Point], node: usize) -> f64 {
        let of = |corner: &Corner| {
            let (p, q) = corner.edges(positions, node);
            let [one, other] = corner.squares(p, q);
            one.max(other)
        };
        self.around(node).map(of).fold(0.0, f64::max).sqrt()
    }

    /// Σ µ² around a node; infinite where a corner is inside out.
    fn sum(&self, positions: &[Point], node: usize) -> f64 {
        let mut sum = 0.0;
        for corner in self.around(node) {
            let (p, q) = corner.edges(positions, node);
            let twice = cross(p, q);
            if !(twice > 0.0) {
                return f64::INFINITY;
            }
            let mu = corner.numerator(p, q) / twice;
            sum += mu * mu;
        }
        sum
    }

    /// Σ µ² around a node with its gradient and second derivatives (xx, xy, yy) by the node's place; `None`
    /// where a corner is inside out.
    fn derivatives(&self, positions: &[Point], node: usize) -> Option<(f64, Point, [f64; 3])> {
        let (mut sum, mut gradient, mut hessian) = (0.0, [0.0; 2], [0.0; 3]);
        for corner in self.around(node) {
            let (p, q) = corner.edges(positions, node);
            let twice = cross(p, q);
            if !(twice > 0.0) {
                return None;
            }
            let inverse = 1.0 / twice;
            let mu = corner.numerator(p, q) * inverse;
            // Gradients of the numerator and of p × q by the place; the numerator's second derivative is a
            // multiple of the unit matrix.
            let (numerator, second) = match corner.role {
                Role::Apex => ([-p[0] - q[0], -p[1] - q[1]], 2.0),
                Role::Next => ([-q[0], -q[1]], 1.0),
                Role::Last => ([-p[0], -p[1]], 1.0),
                Role::Triangle => ([-TRIANGLE * (p[0] + q[0]), -TRIANGLE * (p[1] + q[1])], 2.0 * TRIANGLE),
            };
            let denominator = [p[1] - q[1], q[0] - p[0]];
            let slope = [0, 1].map(|d| (numerator[d] - mu * denominator[d]) * inverse);
            let curve = |i: usize, j: usize| {
                let unit = if i == j { second } else { 0.0 };
                (unit - slope[i] * denominator[j] - slope[j] * denominator[i]) * inverse
            };
            sum += mu * mu;
            for d in 0..2 {
                gradient[d] += 2.0 * mu * slope[d];
            }
            hessian[0] += 2.0 * (slope[0] * slope[0] + mu * curve(0, 0));
            hessian[1] += 2.0 * (slope[0] * slope[1] + mu * curve(0, 1));
            hessian[2] += 2.0 * (slope[1] * slope[1] + mu * curve(1, 1));
        }
        Some((sum, gradient, hessian))
    }

    /// One guarded Newton step of a node; its length by that of the edges there.
    fn step(&self, positions: &mut [Point], node: usize, rails: &mut Rails) -> f64 {
        let from = positions[node];
        let Some((sum, gradient, hessian)) = self.derivatives(positions, node) else { return 0.0 };
        let (determinant, mut way) = match rails.direction(node) {
            None => {
                let determinant = hessian[0] * hessian[2] - hessian[1] * hessian[1];
                let x = (hessian[1] * gradient[1] - hessian[2] * gradient[0]) / determinant;
                let y = (hessian[1] * gradient[0] - hessian[0] * gradient[1]) / determinant;
                (determinant, [x, y])
            }
            // Along the line; the second number stays zero.
            Some([x, y]) => {
                let second = hessian[0] * x * x + 2.0 * hessian[1] * x * y + hessian[2] * y * y;
                (second, [-dot(gradient, [x, y]) / second, 0.0])
            }
        };
        if !(determinant > 0.0) || !way.iter().all(|x| x.is_finite()) {
            return 0.0;
        }
        let length = self.edge(positions, node);
        for _ in 0..6 {
            if let Some(x) = rails.near(node, from, way) {
                positions[node] = x;
                if self.sum(positions, node) < sum {
                    rails.slide(node, way[0]);
                    return dot(way, way).sqrt() / length;
                }
            }
            way = way.map(|x| 0.5 * x);
        }
        positions[node] = from;
        0.0
    }
}

impl Corner {
    /// The edges from a node to the two others.
    fn edges(&self, positions: &[Point], node: usize) -> (Point, Point) {
        let [p, q] = self.others.map(|other| minus(positions[other as usize], positions[node]));
        (p, q)
    }

    /// Squared lengths of the corner's edges; of a triangle those of the two longest ones.
    fn squares(&self, p: Point, q: Point) -> [f64; 2] {
        let third = || dot(minus(p, q), minus(p, q));
        match self.role {
            Role::Apex => [dot(p, p), dot(q, q)],
            Role::Next => [dot(q, q), third()],
            Role::Last => [dot(p, p), third()],
            Role::Triangle => {
                let (p, q, r) = (dot(p, p), dot(q, q), third());
                if r <= p && r <= q { [p, q] } else { [r, p.max(q)] }
            }
        }
    }

    /// µ times p × q.
    fn numerator(&self, p: Point, q: Point) -> f64 {
        if self.role == Role::Triangle {
            return 0.5 * TRIANGLE * (dot(p, p) + dot(q, q) + dot(minus(p, q), minus(p, q)));
        }
        let [one, other] = self.squares(p, q);
        0.5 * (one + other)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_node_among_four_squares_finds_the_middle() {
        let mut positions: Vec<Point> = (0..9).map(|k| [f64::from(k % 3), f64::from(k / 3)]).collect();
        positions[4] = [1.6, 0.7];
        let held: Vec<bool> = (0..9).map(|k| k != 4).collect();
        smooth(&mut positions, &[[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6], [4, 5, 8, 7]], &held);
        assert!(positions[4].iter().all(|x| (x - 1.0).abs() < 1e-4), "{:?}", positions[4]);
        positions[4] = [2.6, 0.4]; // outside: cells inside out
        smooth(&mut positions, &[[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6], [4, 5, 8, 7]], &held);
        assert!(positions[4].iter().all(|x| (x - 1.0).abs() < 1e-2), "{:?}", positions[4]);
    }

    #[test]
    fn a_node_among_six_triangles_finds_the_middle() {
        let h = 0.5 * 3.0_f64.sqrt();
        let mut positions = vec![[1.0, 0.0], [0.5, h], [-0.5, h], [-1.0, 0.0], [-0.5, -h], [0.5, -h], [0.3, 0.4]];
        let cells: Vec<Cell> = (0..6).map(|k| [k, (k + 1) % 6, 6, 6]).collect();
        let held: Vec<bool> = (0..7).map(|k| k != 6).collect();
        smooth(&mut positions, &cells, &held);
        assert!(positions[6].iter().all(|x| x.abs() < 1e-4), "{:?}", positions[6]);
    }
}
