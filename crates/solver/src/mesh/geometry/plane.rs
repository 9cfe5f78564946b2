//! Geometry of cells in 2D: polygons and lines.

use super::CellGeometry;
use crate::mesh::cell::Cell;
use crate::mesh::surface::Corners;
use crate::tensor::Dim;
use crate::vector::{cross as cross_plane, dot, minus, plus, times};

impl CellGeometry<2> for Dim<2> {
    fn min_corner_jacobian(cell: Cell<'_>, positions: &[[f64; 2]]) -> Option<f64> {
        let n = cell.kind.corners();
        let x = |corner: usize| positions[cell.nodes[corner % n] as usize];
        let turn = |c: usize| cross_plane(minus(x(c + 1), x(c)), minus(x(c + n - 1), x(c)));
        (cell.kind.dimension() == 2).then(|| (0..n).map(turn).fold(f64::INFINITY, f64::min))
    }
    fn shape_quality(cell: Cell<'_>, positions: &[[f64; 2]]) -> f64 {
        let n = cell.kind.corners();
        if cell.kind.dimension() == 1 {
            return 1.0;
        }
        let side = |corner: usize| {
            let [a, b] = [corner, corner + 1].map(|corner| positions[cell.nodes[corner % n] as usize]);
            minus(b, a)
        };
        let (mut least, mut longest) = (f64::INFINITY, 0.0f64);
        for corner in 0..n {
            let (before, after) = (side(corner + n - 1), side(corner));
            least = least.min(cross_plane(before, after));
            longest = longest.max(dot(after, after));
        }
        least / longest
    }
    fn inverse_height(segment: [u32; 2], cell: Cell<'_>, positions: &[[f64; 2]]) -> f64 {
        let [b, a] = segment.map(|node| positions[node as usize]);
        let side = minus(b, a);
        // Several pieces of an edge stand on the same area.
        let pieces = cell.nodes.len() as f64 / cell.kind.corners() as f64;
        dot(side, side).sqrt() * pieces / size(cell, positions)
    }
    fn size(cell: Cell<'_>, positions: &[[f64; 2]]) -> f64 {
        size(cell, positions)
    }
    fn principal_strains(cell: Cell<'_>, from: &[[f64; 2]], to: &[[f64; 2]]) -> [f64; 2] {
        strains(cell, from, to)
    }
    fn cell_facets(cell: Cell<'_>) -> Vec<[u32; 2]> {
        cell.pieces_of_edges().map(Corners::reversed).collect()
    }
}

/// Length of a line, area of what has more corners; m, m².
fn size(cell: Cell<'_>, positions: &[[f64; 2]]) -> f64 {
    let x = |node: u32| positions[node as usize];
    if cell.kind.dimension() == 1 {
        let [a, b] = [x(cell.nodes[0]), x(cell.nodes[1])];
        return ((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1])).sqrt();
    }
    let o = x(cell.nodes[0]);
    let cross = |(a, b): (u32, u32)| {
        let (a, b) = (x(a), x(b));
        (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])
    };
    0.5 * cell.around().zip(cell.around().cycle().skip(1)).map(cross).sum::<f64>()
}

/// Principal logarithmic strains at the centre, the larger first: half the logarithms of the eigenvalues of
/// FᵀF. Of a line its one strain twice.
fn strains(cell: Cell<'_>, from: &[[f64; 2]], to: &[[f64; 2]]) -> [f64; 2] {
    if cell.kind.dimension() == 1 {
        return [(size(cell, to) / size(cell, from)).ln(); 2];
    }
    // Of a triangle two sides, of a quadrilateral the means of two opposite sides: F maps those at the start
    // to those now.
    let axis = |axis: usize, x: &[[f64; 2]]| {
        let [from, to] = cell.kind.facts().axes[axis];
        let at = |corner: u8| x[cell.nodes[usize::from(corner)] as usize];
        let sum = to[1..].iter().fold(at(to[0]), |sum, &corner| plus(sum, at(corner)));
        times(1.0 / from.len() as f64, from.iter().fold(sum, |sum, &corner| minus(sum, at(corner))))
    };
    let ([u, v], [a, b]) = ([0, 1].map(|k| axis(k, from)), [0, 1].map(|k| axis(k, to)));
    let inverse = 1.0 / (u[0] * v[1] - u[1] * v[0]);
    // F = [a b] [u v]⁻¹, row by row.
    let f: [[f64; 2]; 2] = [0, 1].map(|k| [(a[k] * v[1] - b[k] * u[1]) * inverse, (b[k] * u[0] - a[k] * v[0]) * inverse]);
    let c = |i: usize, j: usize| f[0][i] * f[0][j] + f[1][i] * f[1][j];
    let (mean, half, shear) = (0.5 * (c(0, 0) + c(1, 1)), 0.5 * (c(0, 0) - c(1, 1)), c(0, 1));
    let radius = (half * half + shear * shear).sqrt();
    [0.5 * (mean + radius).ln(), 0.5 * (mean - radius).max(0.0).ln()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::cell::CellKind;

    #[test]
    fn strains_are_those_of_the_stretch_whatever_the_rotation() {
        let from = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]];
        let (c, s) = (0.6, 0.8);
        // x stretched to twice, y to half, then turned.
        let to = from.map(|[x, y]| [2.0 * x * c - 0.5 * y * s, 2.0 * x * s + 0.5 * y * c]);
        for cell in [CellKind::Quadrilateral.cell(&[0, 1, 2, 3]), CellKind::Triangle.cell(&[0, 1, 2])] {
            let [most, least] = strains(cell, &from, &to);
            assert!((most - 2f64.ln()).abs() < 1e-12 && (least + 2f64.ln()).abs() < 1e-12, "{most} {least}");
            assert!((size(cell, &to) / size(cell, &from) - 1.0).abs() < 1e-12);
        }
        assert!((strains(CellKind::Line.cell(&[0, 1]), &from, &to)[0] - 2f64.ln()).abs() < 1e-12);
        let flat = from.map(|[x, _]| [x, 0.0]);
        assert_eq!(strains(CellKind::Quadrilateral.cell(&[0, 1, 2, 3]), &from, &flat)[1], f64::NEG_INFINITY);
    }
}
