//! Nodes inside moved to where the cells around them have the best shape.
//!
//! One node at a time, in ascending order, takes a Newton step on Σ µ² over the corners of the cells around
//! it, halved until the sum falls and no corner turns inside out. The shape measure of a corner with edges a
//! and b is µ = (|a|² + |b|²) / (2 a × b), 1 for a square; that of a triangle the sum of its squared edges
//! over 4√3 of its area, 1 for an equilateral one. Both are convex in the place of one node. Source: Knupp,
//! SIAM J. Sci. Comput. 23 (2001) 193-218 (mean ratio).

use super::quality::scaled as sine;
use crate::plane::{Cell, Point, corners, cross, dot, minus};

/// Sweeps at most, and the largest step by the length of edges below which they end.
const SWEEPS: usize = 30;
const STILL: f64 = 2e-3;
/// Scaled Jacobian below which a node's surroundings are made better on their own, and rounds of that.
const POOR: f64 = 0.6;
const ROUNDS: usize = 12;
/// 1/√3.
const TRIANGLE: f64 = 0.577_350_269_189_625_8;

/// A corner: its node and the next and the last one of the cell.
#[derive(Clone, Copy)]
struct Corner {
    nodes: [u32; 3],
    is_triangle: bool,
}

/// Corners of all cells, and for each node those that its place matters to.
struct Corners {
    all: Vec<Corner>,
    first: Vec<u32>,
    at: Vec<u32>,
}

/// Moves all nodes that are not held.
pub(super) fn smooth(positions: &mut [Point], cells: &[Cell], held: &[bool]) {
    let corners = Corners::new(positions.len(), cells);
    let free: Vec<usize> = (0..positions.len()).filter(|&node| !held[node]).collect();
    untangle(positions, &corners, &free);
    for _ in 0..SWEEPS {
        let mut largest = 0.0_f64;
        for &node in &free {
            largest = largest.max(corners.step(positions, node));
        }
        if largest < STILL {
            break;
        }
    }
    untangle(positions, &corners, &free);
}

/// Moves nodes whose surroundings are poor to where the worst corner there is best.
fn untangle(positions: &mut [Point], corners: &Corners, free: &[usize]) {
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
                let mut place = from;
                for way in WAYS {
                    positions[node] = [from[0] + step * way[0], from[1] + step * way[1]];
                    let worst = corners.worst(positions, node, length);
                    if worst > best + 1e-3 {
                        (best, place) = (worst, positions[node]);
                    }
                }
                positions[node] = place;
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
        let mut all = Vec::with_capacity(4 * cells.len());
        for cell in cells {
            let list = corners(cell);
            let n = list.len();
            let corner = |k: usize| Corner { nodes: [list[k], list[(k + 1) % n], list[(k + n - 1) % n]], is_triangle: n == 3 };
            all.extend((0..n).map(corner));
        }
        let mut first = vec![0_u32; nodes + 1];
        for node in all.iter().flat_map(|corner| corner.nodes) {
            first[node as usize + 1] += 1;
        }
        for node in 0..nodes {
            first[node + 1] += first[node];
        }
        let mut next = first.clone();
        let mut at = vec![0; 3 * all.len()];
        for (k, corner) in (0..).zip(&all) {
            for node in corner.nodes {
                at[next[node as usize] as usize] = k;
                next[node as usize] += 1;
            }
        }
        Self { all, first, at }
    }

    fn around(&self, node: usize) -> impl Iterator<Item = &Corner> {
        self.at[self.first[node] as usize..self.first[node + 1] as usize].iter().map(|&k| &self.all[k as usize])
    }

    /// The least scaled Jacobian around a node, that of triangles not scaled; where it isn't positive the least
    /// Jacobian, by the square of a length: its least is a concave function of the node's place.
    fn worst(&self, positions: &[Point], node: usize, length: f64) -> f64 {
        let (mut least, mut scaled) = (f64::INFINITY, f64::INFINITY);
        for corner in self.around(node) {
            let [o, a, b] = corner.nodes.map(|node| positions[node as usize]);
            let (a, b) = (minus(a, o), minus(b, o));
            least = least.min(cross(a, b));
            scaled = scaled.min(sine(a, b));
        }
        if least > 0.0 { scaled } else { (least / (length * length)).min(0.0) }
    }

    /// The longest edge of the corners around a node.
    fn edge(&self, positions: &[Point], node: usize) -> f64 {
        let of = |corner: &Corner| {
            let [o, a, b] = corner.nodes.map(|node| positions[node as usize]);
            dot(minus(a, o), minus(a, o)).max(dot(minus(b, o), minus(b, o)))
        };
        self.around(node).map(of).fold(0.0, f64::max).sqrt()
    }

    /// Σ µ² around a node; infinite where a corner is inside out.
    fn sum(&self, positions: &[Point], node: usize) -> f64 {
        let mut sum = 0.0;
        for corner in self.around(node) {
            let [o, a, b] = corner.nodes.map(|node| positions[node as usize]);
            let [mu, twice] = corner.shape(minus(a, o), minus(b, o));
            if !(twice > 0.0) {
                return f64::INFINITY;
            }
            sum += mu * mu;
        }
        sum
    }

    /// One guarded Newton step of a node; its length by that of the edges there.
    fn step(&self, positions: &mut [Point], node: usize) -> f64 {
        let from = positions[node];
        let (mut sum, mut gradient, mut hessian) = (0.0, [0.0; 2], [0.0; 3]);
        for corner in self.around(node) {
            let [o, a, b] = corner.nodes.map(|node| positions[node as usize]);
            let (a, b) = (minus(a, o), minus(b, o));
            let [mu, twice] = corner.shape(a, b);
            if !(twice > 0.0) {
                return 0.0;
            }
            // Gradients of the numerator |a|² + |b|² (+ |a − b|²) and of a × b, and the numerator's second
            // derivative, which is a multiple of the unit matrix.
            let (of_a, of_b) = ([b[1], -b[0]], [-a[1], a[0]]);
            let third = if corner.is_triangle { minus(a, b) } else { [0.0; 2] };
            let (numerator, denominator, second) = if corner.nodes[0] as usize == node {
                ([-2.0 * (a[0] + b[0]), -2.0 * (a[1] + b[1])], [-of_a[0] - of_b[0], -of_a[1] - of_b[1]], 4.0)
            } else if corner.nodes[1] as usize == node {
                ([2.0 * (a[0] + third[0]), 2.0 * (a[1] + third[1])], of_a, if corner.is_triangle { 4.0 } else { 2.0 })
            } else {
                ([2.0 * (b[0] - third[0]), 2.0 * (b[1] - third[1])], of_b, if corner.is_triangle { 4.0 } else { 2.0 })
            };
            let scale = corner.scale();
            let slope = [0, 1].map(|d| (scale * numerator[d] - mu * denominator[d]) / twice);
            let curve = |i: usize, j: usize| {
                let unit = if i == j { scale * second } else { 0.0 };
                (unit - slope[i] * denominator[j] - slope[j] * denominator[i]) / twice
            };
            sum += mu * mu;
            for d in 0..2 {
                gradient[d] += 2.0 * mu * slope[d];
            }
            hessian[0] += 2.0 * (slope[0] * slope[0] + mu * curve(0, 0));
            hessian[1] += 2.0 * (slope[0] * slope[1] + mu * curve(0, 1));
            hessian[2] += 2.0 * (slope[1] * slope[1] + mu * curve(1, 1));
        }
        let determinant = hessian[0] * hessian[2] - hessian[1] * hessian[1];
        let mut way = [
            (hessian[1] * gradient[1] - hessian[2] * gradient[0]) / determinant,
            (hessian[1] * gradient[0] - hessian[0] * gradient[1]) / determinant,
        ];
        if !(determinant > 0.0) || !way.iter().all(|x| x.is_finite()) {
            return 0.0;
        }
        for _ in 0..6 {
            positions[node] = [from[0] + way[0], from[1] + way[1]];
            if self.sum(positions, node) < sum {
                return dot(way, way).sqrt() / self.edge(positions, node);
            }
            way = way.map(|x| 0.5 * x);
        }
        positions[node] = from;
        0.0
    }
}

impl Corner {
    /// What the numerator is multiplied by.
    fn scale(&self) -> f64 {
        if self.is_triangle { 0.5 * TRIANGLE } else { 0.5 }
    }

    /// µ, and a × b.
    fn shape(&self, a: Point, b: Point) -> [f64; 2] {
        let twice = cross(a, b);
        let third = if self.is_triangle { dot(minus(a, b), minus(a, b)) } else { 0.0 };
        [self.scale() * (dot(a, a) + dot(b, b) + third) / twice, twice]
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
