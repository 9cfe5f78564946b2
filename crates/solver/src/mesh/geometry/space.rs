//! Geometry of cells in 3D: tetrahedra, wedges, hexahedra and lines.

use super::CellGeometry;
use crate::mesh::cell::{Cell, CellKind};
use crate::mesh::surface::Corners;
use crate::mesh::surface::tributary::{Depth, Tributary};
use crate::rotation::{Square, inverse, transposed};
use crate::tensor::{Dim, Space, SymmetricTensor, cross, product};
use crate::vector::{dot, minus, plus};

impl CellGeometry<3> for Dim<3> {
    fn min_corner_jacobian(cell: Cell<'_>, positions: &[[f64; 3]]) -> Option<f64> {
        let of = |(corner, others): (usize, [u8; 3])| {
            let [a, b, c] = edges(cell, corner, others, positions);
            dot(cross(a, b), c)
        };
        corners(cell.kind).map(of).fold(None, |least: Option<f64>, own| Some(least.unwrap_or(f64::INFINITY).min(own)))
    }
    fn shape_quality(cell: Cell<'_>, positions: &[[f64; 3]]) -> f64 {
        let Some(least) = Self::min_corner_jacobian(cell, positions) else { return 1.0 };
        let all = corners(cell.kind).flat_map(|(corner, others)| edges(cell, corner, others, positions));
        let longest = all.map(|edge| dot(edge, edge)).fold(0.0, f64::max);
        least / (longest * longest.sqrt())
    }
    fn inverse_height(facet: [u32; 4], cell: Cell<'_>, positions: &[[f64; 3]]) -> f64 {
        let areas = <Self as Tributary<3>>::shares(Depth::Plane, facet, positions);
        areas.into_iter().sum::<f64>() / size(cell, positions)
    }
    fn size(cell: Cell<'_>, positions: &[[f64; 3]]) -> f64 {
        size(cell, positions)
    }
    fn principal_strains(cell: Cell<'_>, from: &[[f64; 3]], to: &[[f64; 3]]) -> [f64; 2] {
        strains(cell, from, to)
    }
    fn cell_facets(cell: Cell<'_>) -> Vec<[u32; 4]> {
        cell.faces().map(Corners::canonical).collect()
    }
}

/// Volume enclosed by the facets, bilinear where they have four corners (the mean of both ways to halve
/// them); of a line its length.
fn size(cell: Cell<'_>, positions: &[[f64; 3]]) -> f64 {
    let o = positions[cell.nodes[0] as usize];
    let x = |node: u32| minus(positions[node as usize], o);
    if cell.kind.dimension() == 1 {
        return dot(x(cell.nodes[1]), x(cell.nodes[1])).sqrt();
    }
    let wedge = |a: u32, b: u32, c: u32| dot(x(a), cross(x(b), x(c)));
    let facet = |[a, b, c, d]: [u32; 4]| 0.5 * (wedge(a, b, c) + wedge(a, c, d) + wedge(a, b, d) + wedge(b, c, d));
    cell.faces().map(facet).sum::<f64>() / 6.0
}

/// Three vectors that a cell carries with it: the edges of a tetrahedron at a corner, else means of opposite
/// sides.
fn frame(cell: Cell<'_>, x: &[[f64; 3]]) -> Square<3> {
    let mean = |corners: &[u8]| {
        let sum = corners.iter().fold([0.0; 3], |sum, &corner| plus(sum, x[cell.nodes[usize::from(corner)] as usize]));
        sum.map(|component| component / corners.len() as f64)
    };
    let axes = cell.kind.facts().axes;
    std::array::from_fn(|k| axes.get(k).map_or([0.0; 3], |[from, to]| minus(mean(to), mean(from))))
}

/// See [`CellGeometry::principal_strains`].
fn strains(cell: Cell<'_>, from: &[[f64; 3]], to: &[[f64; 3]]) -> [f64; 2] {
    if cell.kind.dimension() == 1 {
        return [(size(cell, to) / size(cell, from)).ln(); 2];
    }
    // Rows of both are the vectors: F maps those at the start to those now.
    let (start, now) = (frame(cell, from), frame(cell, to));
    let f = product(&transposed(&now), &inverse(&transposed(&start)));
    let (squares, _) = <Dim<3> as Space<3>>::left_cauchy_green(&f, 1.0).principal();
    let most = squares.into_iter().fold(0.0, f64::max);
    let least = squares.into_iter().fold(f64::INFINITY, f64::min);
    [0.5 * most.ln(), 0.5 * least.max(0.0).ln()]
}

/// A corner of a cell that is a volume and the other ends of its edges, right-handed; of a simplex one corner
/// says it all.
fn corners(kind: CellKind) -> impl Iterator<Item = (usize, [u8; 3])> + Clone {
    let is_simplex = kind.corners() == kind.dimension() + 1;
    let three = kind.facts().neighbours.iter().map_while(|neighbours| neighbours.first_chunk::<3>().copied());
    three.take(if is_simplex { 1 } else { kind.corners() }).enumerate()
}

/// The edges from a corner of a cell to `others`, m.
fn edges(cell: Cell<'_>, corner: usize, others: [u8; 3], positions: &[[f64; 3]]) -> [[f64; 3]; 3] {
    others.map(|other| minus(positions[cell.nodes[usize::from(other)] as usize], positions[cell.nodes[corner] as usize]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rotation::{Rotate, applied, axis};

    #[test]
    fn size_and_strains_are_those_of_the_stretch_whatever_the_rotation() {
        let from: Vec<[f64; 3]> = [
            [0.0, 0.0, 0.0],
            [2.0, 0.0, 0.0],
            [2.0, 1.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 3.0],
            [2.0, 0.0, 3.0],
            [2.0, 1.0, 3.0],
            [0.0, 1.0, 3.0],
        ]
        .into();
        let turn = <Dim<3>>::rotation(axis([1.0, -2.0, 0.5]), 1.1);
        let to: Vec<[f64; 3]> = from.iter().map(|[x, y, z]| applied(&turn, [2.0 * x, 0.5 * y, 1.1 * z])).collect();
        let cells: [(CellKind, &[u32], f64); 3] = [
            (CellKind::Hexahedron, &[0, 1, 2, 3, 4, 5, 6, 7], 6.0),
            (CellKind::Wedge, &[0, 1, 2, 4, 5, 6], 3.0),
            (CellKind::Tetrahedron, &[0, 1, 2, 4], 1.0),
        ];
        for (kind, nodes, volume) in cells {
            let cell = kind.cell(nodes);
            assert!((size(cell, &from) - volume).abs() < 1e-14 && (size(cell, &to) - 1.1 * volume).abs() < 1e-13);
            let [most, least] = strains(cell, &from, &to);
            assert!((most - 2f64.ln()).abs() < 1e-12 && (least + 2f64.ln()).abs() < 1e-12, "{most} {least}");
            assert!(<Dim<3>>::min_corner_jacobian(cell, &from) > Some(0.0));
        }
    }
}
