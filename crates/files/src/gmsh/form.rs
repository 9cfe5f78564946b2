//! The form of cells: area, volume, and the same cell turned the right way.
//!
//! Corners come from mesh files of every kind (`mesh.rs` here, `abaqus/mesh.rs`); what is found goes into their messages and cells.

use embate_solver::mesh::signed_volume;

/// Area of a triangle or quadrilateral of the plane, in the square of the positions' unit; negative when its nodes run clockwise.
pub(crate) fn area(corners: &[[f64; 3]]) -> f64 {
    // Half the product of the diagonals; of a triangle, two sides.
    match *corners {
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
pub(super) fn cross_in_space(a: [f64; 3], b: [f64; 3], c: [f64; 3], d: [f64; 3]) -> [f64; 3] {
    let u: [f64; 3] = std::array::from_fn(|k| b[k] - a[k]);
    let v: [f64; 3] = std::array::from_fn(|k| d[k] - c[k]);
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

/// Whether a cell runs clockwise (dimension 2, in the plane) or has a negative volume (dimension 3).
pub(crate) fn is_turned(dimension: u8, corners: &[[f64; 3]]) -> bool {
    match dimension {
        2 => area(corners) < 0.0,
        3 => signed_volume(corners) < 0.0,
        _ => false,
    }
}

/// Renumbers the nodes of a cell that [`is_turned`]: its first stays the first.
pub(crate) fn turn(dimension: u8, nodes: &mut [u32]) {
    match (dimension, nodes.len()) {
        (3, 4) => nodes.swap(1, 2),
        // Each of the two ends runs the other way round.
        (3, n) => nodes.chunks_exact_mut(n / 2).for_each(|end| end[1..].reverse()),
        (2, _) => nodes[1..].reverse(),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use embate_solver::mesh::Meshed;
    use embate_solver::tensor::Dim;

    fn reference(nodes: usize) -> Vec<[f64; 3]> {
        match nodes {
            4 => vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            6 => vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]],
            _ => {
                [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]].map(|x| x.map(f64::from)).to_vec()
            }
        }
    }

    #[test]
    fn a_mirrored_cell_is_turned_back_about_its_first_node() {
        for nodes in [4, 6, 8] {
            let x = reference(nodes);
            let volume = signed_volume(&x);
            assert!(!is_turned(3, &x));
            let mirrored: Vec<[f64; 3]> = x.iter().map(|[x, y, z]| [*x, *y, -z]).collect();
            assert!(is_turned(3, &mirrored));
            let mut cell: Vec<u32> = (0..nodes as u32).collect();
            turn(3, &mut cell);
            assert_eq!(cell[0], 0);
            let turned: Vec<[f64; 3]> = cell.iter().map(|&node| mirrored[node as usize]).collect();
            assert_eq!(signed_volume(&turned), volume);
            assert!(Dim::<3>::wrong_form(&turned).is_none());
        }
    }
}
