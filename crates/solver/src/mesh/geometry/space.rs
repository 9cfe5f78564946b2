//! Geometry of cells in 3D: tetrahedra, wedges, hexahedra, surfaces and lines.

use super::CellGeometry;
use crate::mesh::cell::{Cell, CellKind};
use crate::mesh::dimension::corner_normals;
use crate::mesh::surface::Corners;
use crate::mesh::surface::tributary::{Depth, Tributary};
use crate::rotation::{Square, inverse, transposed};
use crate::tensor::{Dim, Space, SymmetricTensor, cross, product};
use crate::vector::{dot, length, minus, plus, unit};

impl CellGeometry<3> for Dim<3> {
    fn min_corner_jacobian(cell: Cell<'_>, positions: &[[f64; 3]]) -> Option<f64> {
        if cell.kind.dimension() == 2 {
            let normals = || corner_normals(cell.kind, cell.nodes.iter().map(|&node| positions[node as usize]));
            let whole = unit(normals().fold([0.0; 3], plus)).unwrap_or_default();
            return normals().map(|normal| dot(normal, whole)).reduce(f64::min);
        }
        let of = |(corner, others): (usize, [u8; 3])| {
            let [a, b, c] = edges(cell, corner, others, positions);
            dot(cross(a, b), c)
        };
        corners(cell.kind).map(of).fold(None, |least: Option<f64>, own| Some(least.unwrap_or(f64::INFINITY).min(own)))
    }
    fn shape_quality(cell: Cell<'_>, positions: &[[f64; 3]]) -> f64 {
        let Some(least) = Self::min_corner_jacobian(cell, positions) else { return 1.0 };
        let square = |edge: [u32; 2]| {
            let [a, b] = edge.map(|node| positions[node as usize]);
            dot(minus(b, a), minus(b, a))
        };
        let longest = cell.edges().map(square).fold(0.0, f64::max);
        if cell.kind.dimension() == 2 { least / longest } else { least / (longest * longest.sqrt()) }
    }
    fn inverse_height(facet: [u32; 4], cell: Cell<'_>, positions: &[[f64; 3]]) -> f64 {
        let areas = <Self as Tributary<3>>::shares(Depth::Plane, facet, positions);
        // Several facets of a face stand on the same volume.
        let facts = cell.kind.facts();
        let of_face = facts.facets.len() as f64 / facts.faces.len() as f64;
        areas.into_iter().sum::<f64>() * of_face / size(cell, positions)
    }
    fn size(cell: Cell<'_>, positions: &[[f64; 3]]) -> f64 {
        size(cell, positions)
    }
    fn principal_strains(cell: Cell<'_>, from: &[[f64; 3]], to: &[[f64; 3]]) -> [f64; 2] {
        strains(cell, from, to)
    }
    fn cell_facets(cell: Cell<'_>) -> Vec<[u32; 4]> {
        cell.facets().map(Corners::canonical).collect()
    }
}

/// Volume enclosed by the facets, bilinear where they have four corners (the mean of both ways to halve
/// them); of a surface its area, of a line its length.
fn size(cell: Cell<'_>, positions: &[[f64; 3]]) -> f64 {
    let o = positions[cell.nodes[0] as usize];
    let x = |node: u32| minus(positions[node as usize], o);
    if cell.kind.dimension() == 1 {
        return dot(x(cell.nodes[1]), x(cell.nodes[1])).sqrt();
    }
    if cell.kind.dimension() == 2 {
        let normals = corner_normals(cell.kind, cell.nodes.iter().map(|&node| positions[node as usize]));
        return length(normals.fold([0.0; 3], plus)) * cell.kind.facts().size / cell.kind.corners() as f64;
    }
    let wedge = |a: u32, b: u32, c: u32| dot(x(a), cross(x(b), x(c)));
    let facet = |[a, b, c, d]: [u32; 4]| 0.5 * (wedge(a, b, c) + wedge(a, c, d) + wedge(a, b, d) + wedge(b, c, d));
    cell.facets().map(facet).sum::<f64>() / 6.0
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
    if cell.kind.dimension() == 2 {
        return strains_in_surface(frame(cell, from), frame(cell, to));
    }
    // Rows of both are the vectors: F maps those at the start to those now.
    let (start, now) = (frame(cell, from), frame(cell, to));
    let f = product(&transposed(&now), &inverse(&transposed(&start)));
    let (squares, _) = <Dim<3> as Space<3>>::left_cauchy_green(&f, 1.0).principal();
    let most = squares.into_iter().fold(0.0, f64::max);
    let least = squares.into_iter().fold(f64::INFINITY, f64::min);
    [0.5 * most.ln(), 0.5 * least.max(0.0).ln()]
}

/// The same of a surface from the first two of its vectors at the start and now: half the logarithms of the
/// eigenvalues of the new metric relative to the old one.
fn strains_in_surface([a, b, _]: Square<3>, [c, d, _]: Square<3>) -> [f64; 2] {
    let (old, new) = ([dot(a, a), dot(a, b), dot(b, b)], [dot(c, c), dot(c, d), dot(d, d)]);
    let determinant = |[xx, xy, yy]: [f64; 3]| xx * yy - xy * xy;
    let half = 0.5 * (old[2] * new[0] - 2.0 * old[1] * new[1] + old[0] * new[2]) / determinant(old);
    let product = determinant(new) / determinant(old);
    let largest = half + (half * half - product).max(0.0).sqrt();
    [0.5 * largest.ln(), 0.5 * (product / largest).max(0.0).ln()]
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
        // Surfaces in planes of both axes of the stretch.
        let surfaces: [(CellKind, &[u32], f64, [f64; 2]); 3] = [
            (CellKind::Quadrilateral, &[0, 1, 2, 3], 2.0, [2.0, 0.5]),
            (CellKind::Triangle, &[0, 1, 3], 1.0, [2.0, 0.5]),
            (CellKind::Quadrilateral, &[0, 4, 7, 3], 3.0, [1.1, 0.5]),
        ];
        for (kind, nodes, area, [largest, smallest]) in surfaces {
            let cell = kind.cell(nodes);
            assert!((size(cell, &from) - area).abs() < 1e-14 && (size(cell, &to) / area - largest * smallest).abs() < 1e-14);
            let [most, least] = strains(cell, &from, &to);
            assert!((most - largest.ln()).abs() < 1e-12 && (least - smallest.ln()).abs() < 1e-12, "{most} {least}");
            assert!(<Dim<3>>::min_corner_jacobian(cell, &to) > Some(0.0) && <Dim<3>>::shape_quality(cell, &from) > 0.3);
        }
    }
}
