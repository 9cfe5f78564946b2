//! The form of cells: area, volume, and which of them are turned the wrong way.
//!
//! Corners come from mesh files of every kind (`mesh.rs` here, `abaqus/mesh.rs`); what is found goes into
//! their messages and cells.

use embate_solver::mesh::cell::CellKind;
use embate_solver::mesh::signed_volume;

/// Area of a triangle or quadrilateral in 2D, in the square of the positions' unit; negative when its
/// nodes run clockwise.
pub(crate) fn area(kind: CellKind, corners: &[[f64; 3]]) -> f64 {
    // Half the product of the diagonals; of a triangle, two sides.
    match corners[..kind.corners()] {
        [a, b, c, d] => 0.5 * cross(a, c, b, d),
        [a, b, c] => 0.5 * cross(a, b, a, c),
        _ => 0.0,
    }
}

/// z of (b − a) × (d − c).
pub(super) fn cross(a: [f64; 3], b: [f64; 3], c: [f64; 3], d: [f64; 3]) -> f64 {
    (b[0] - a[0]) * (d[1] - c[1]) - (b[1] - a[1]) * (d[0] - c[0])
}

/// (b − a) × (d − c).
pub(super) fn cross_in_3d(a: [f64; 3], b: [f64; 3], c: [f64; 3], d: [f64; 3]) -> [f64; 3] {
    let u: [f64; 3] = std::array::from_fn(|k| b[k] - a[k]);
    let v: [f64; 3] = std::array::from_fn(|k| d[k] - c[k]);
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

/// Whether a cell runs clockwise (a surface, in 2D) or has a negative volume.
pub(crate) fn is_turned(kind: CellKind, corners: &[[f64; 3]]) -> bool {
    match kind.dimension() {
        2 => area(kind, corners) < 0.0,
        3 => signed_volume(kind, corners) < 0.0,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_that_was_reflected_is_turned_until_it_is_turned_back() {
        for kind in CellKind::ALL.into_iter().filter(|kind| kind.dimension() > 1) {
            let x = kind.facts().reference;
            let reflected: Vec<[f64; 3]> = x.iter().map(|[x, y, z]| [-x, *y, *z]).collect();
            let mut cell: Vec<u32> = (0..kind.nodes() as u32).collect();
            kind.reflect(&mut cell);
            let back: Vec<[f64; 3]> = cell.iter().map(|&node| reflected[node as usize]).collect();
            assert_eq!([x, &reflected[..], &back[..]].map(|corners| is_turned(kind, corners)), [false, true, false], "{kind:?}");
        }
    }
}
