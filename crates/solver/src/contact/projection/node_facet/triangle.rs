//! The nearest point of a triangle to another point.

use super::{TIE, Vector};
use crate::tensor::dot;
use crate::vector::minus;

/// Nearest point of a triangle.
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct Nearest {
    /// Square of the distance, m².
    pub(in crate::contact) square: f64,
    /// Barycentric.
    pub(super) weights: [f64; 3],
    pub(super) foot: Vector,
}

/// The place of a triangle that is nearest to another place, m.
pub(crate) fn place_on_triangle(x: Vector, triangle: [Vector; 3]) -> Vector {
    nearest_of_triangle(x, triangle).foot
}

/// Which corners of a triangle its place that is nearest to another place depends on: one at a corner, two on
/// an edge.
pub(in crate::contact) fn corners_below(x: Vector, triangle: [Vector; 3]) -> [bool; 3] {
    nearest_of_triangle(x, triangle).weights.map(|weight| weight > TIE)
}

/// Square of the distance of a place from a triangle, m².
pub(in crate::contact) fn square_to_triangle(x: Vector, triangle: [Vector; 3]) -> f64 {
    nearest_of_triangle(x, triangle).square
}

/// Nearest point of the triangle a, b, c to x (Ericson 2005); weights that are zero are so exactly.
pub(super) fn nearest_of_triangle(x: Vector, [a, b, c]: [Vector; 3]) -> Nearest {
    let (ab, ac, ax) = (minus(b, a), minus(c, a), minus(x, a));
    let (d1, d2) = (dot(ab, ax), dot(ac, ax));
    let at = |weights: [f64; 3]| {
        let foot = |d: usize| weights[0] * a[d] + weights[1] * b[d] + weights[2] * c[d];
        let foot = [foot(0), foot(1), foot(2)];
        let away = minus(x, foot);
        Nearest { square: dot(away, away), weights, foot }
    };
    if d1 <= 0.0 && d2 <= 0.0 {
        return at([1.0, 0.0, 0.0]);
    }
    let bx = minus(x, b);
    let (d3, d4) = (dot(ab, bx), dot(ac, bx));
    if d3 >= 0.0 && d4 <= d3 {
        return at([0.0, 1.0, 0.0]);
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let v = d1 / (d1 - d3);
        return at([1.0 - v, v, 0.0]);
    }
    let cx = minus(x, c);
    let (d5, d6) = (dot(ab, cx), dot(ac, cx));
    if d6 >= 0.0 && d5 <= d6 {
        return at([0.0, 0.0, 1.0]);
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let w = d2 / (d2 - d6);
        return at([1.0 - w, 0.0, w]);
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        let w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return at([0.0, 1.0 - w, w]);
    }
    let sum = va + vb + vc;
    let (v, w) = (vb / sum, vc / sum);
    at([1.0 - v - w, v, w])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_point_of_a_triangle_is_found_over_faces_edges_and_corners() {
        let triangle = [[0.0, 0.0, 1.0], [2.0, 0.0, 1.0], [0.0, 2.0, 1.0]];
        let cases = [
            ([0.5, 0.5, 3.0], [0.5, 0.5, 1.0]),
            ([-1.0, -1.0, 0.0], [0.0, 0.0, 1.0]),
            ([5.0, -1.0, 1.0], [2.0, 0.0, 1.0]),
            ([-1.0, 5.0, 1.0], [0.0, 2.0, 1.0]),
            ([1.0, -2.0, 1.0], [1.0, 0.0, 1.0]),
            ([-2.0, 1.0, 1.0], [0.0, 1.0, 1.0]),
            ([2.0, 2.0, 0.0], [1.0, 1.0, 1.0]),
        ];
        for (x, expected) in cases {
            assert_eq!(place_on_triangle(x, triangle), expected, "{x:?}");
        }
    }
}
