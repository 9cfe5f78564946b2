//! Quality of cells.

use crate::plane::{Cell, Point, corners, cross, dot, minus};

/// 2/√3: one over the sine of 60 degrees.
const EQUILATERAL: f64 = 1.154_700_538_379_251_5;

/// Scaled Jacobian of each cell: the least over its corners of a × b / (|a| |b|), where a and b are the edges
/// that leave the corner; 1 for a rectangle. That of a triangle is multiplied by 2/√3: 1 for an equilateral
/// one. Source: Knupp, SIAM J. Sci. Comput. 23 (2001) 193-218.
#[must_use]
pub fn qualities(positions: &[Point], cells: &[Cell]) -> Vec<f64> {
    let of = |cell: &Cell| {
        let nodes = corners(cell);
        let n = nodes.len();
        let x = |k: usize| positions[nodes[k % n] as usize];
        let corner = |k: usize| scaled(minus(x(k + 1), x(k)), minus(x(k + n - 1), x(k)));
        let least = (0..n).map(corner).fold(f64::INFINITY, f64::min);
        if n == 3 { EQUILATERAL * least } else { least }
    };
    cells.iter().map(of).collect()
}

/// The least scaled Jacobian of all cells; see [`qualities`]. Infinite without a cell.
#[must_use]
pub fn quality(positions: &[Point], cells: &[Cell]) -> f64 {
    qualities(positions, cells).into_iter().fold(f64::INFINITY, f64::min)
}

/// The sine of the angle from `a` to `b`; −1 where one of them is zero or not a number.
pub(super) fn scaled(a: Point, b: Point) -> f64 {
    let sine = cross(a, b) / (dot(a, a) * dot(b, b)).sqrt();
    if sine.is_nan() { -1.0 } else { sine }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_and_equilateral_triangles_have_quality_one() {
        let positions = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0], [1.0, 3.0_f64.sqrt()]];
        assert_eq!(quality(&positions, &[[0, 1, 2, 3]]), 1.0);
        assert!((quality(&positions, &[[0, 1, 4, 4]]) - 1.0).abs() < 1e-15);
        assert_eq!(qualities(&positions, &[[0, 1, 2, 3], [3, 2, 1, 0]]), [1.0, -1.0]);
    }

    #[test]
    fn a_cell_whose_nodes_coincide_is_bad() {
        assert_eq!(quality(&[[0.0, 0.0], [1.0, 0.0], [1.0, 0.0]], &[[0, 1, 2, 2]]), -EQUILATERAL);
    }
}
