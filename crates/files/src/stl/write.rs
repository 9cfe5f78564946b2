//! The outline of a part as triangles of an STL file.

use embate_solver::error::Fault;
use embate_solver::mesh::cell::Cell;
use embate_solver::mesh::surface::{self, Corners};
use embate_solver::output::Cells;
use std::fmt::Write;

/// The outside of a part in 3D as the text of an STL file in units of `scale` (m), outward, and the number of
/// its triangles. A quadrilateral is four triangles about the mean of its corners. `coordinates` are those of
/// all nodes, m.
///
/// # Errors
/// The part has no outside that is one.
pub fn outline(cells: &Cells, coordinates: &[f64], part: usize, scale: f64) -> Result<(String, usize), Fault> {
    let own = |index: &usize| cells.parts[*index] as usize == part;
    let cell = |index: usize| Cell {
        kind: cells.kinds[index],
        nodes: &cells.nodes[cells.offsets[index] as usize..cells.offsets[index + 1] as usize],
    };
    let solid: Vec<Cell<'_>> = (0..cells.len()).filter(own).map(cell).collect();
    let facets = surface::exterior::<3>(solid)?;
    let place = |node: u32| -> [f64; 3] { std::array::from_fn(|k| coordinates[3 * node as usize + k] / scale) };
    let name: String = cells.part_names[part].chars().filter(|c| !c.is_control()).collect();
    let (mut text, mut count) = (format!("solid {name}\n"), 0);
    let mut add = |corners: [[f64; 3]; 3]| {
        count += 1;
        text.push_str("facet normal 0 0 0\nouter loop\n");
        for [x, y, z] in corners {
            // As many digits as lead back to the same number; what can't be written to a text can't be.
            let _ = writeln!(text, "vertex {x:e} {y:e} {z:e}");
        }
        text.push_str("endloop\nendfacet\n");
    };
    for facet in facets {
        let x: Vec<[f64; 3]> = facet.corners().iter().map(|&node| place(node)).collect();
        if let [a, b, c] = x[..] {
            add([a, b, c]);
            continue;
        }
        // By ascending node, as elements have it.
        let mut nodes = facet.corners().to_vec();
        nodes.sort_unstable();
        let sum = nodes.iter().map(|&node| place(node)).fold([0.0; 3], |sum, x| [0, 1, 2].map(|k| sum[k] + x[k]));
        let middle = sum.map(|sum| sum / x.len() as f64);
        (0..x.len()).for_each(|k| add([x[k], x[(k + 1) % x.len()], middle]));
    }
    let _ = writeln!(text, "endsolid {name}");
    Ok((text, count))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stl;
    use embate_solver::mesh::cell::CellKind;

    #[test]
    fn the_outline_of_a_brick_on_a_tetrahedron_is_read_back() {
        // A brick, and on its top another body, which is not of the part.
        let corner = |k: usize| [(k & 1) as f64, ((k >> 1) & 1) as f64, (k >> 2) as f64 * 1.5];
        let coordinates: Vec<f64> = (0..8).flat_map(corner).chain([0.5, 0.5, 3.0]).collect();
        let cells = Cells {
            nodes: vec![0, 1, 3, 2, 4, 5, 7, 6, 4, 5, 7, 8],
            offsets: vec![0, 8, 12],
            kinds: vec![CellKind::Hexahedron, CellKind::Tetrahedron],
            parts: vec![0, 1],
            part_names: vec!["brick".into(), "top".into()],
            revision: 0,
        };
        let (text, count) = outline(&cells, &coordinates, 0, 0.5).unwrap();
        assert_eq!(count, 24);
        let surface = stl::parse(text.as_bytes(), "brick.stl", 0.5).unwrap();
        assert_eq!((surface.triangles.len(), surface.positions.len()), (24, 14));
        let x = |node: u32| surface.positions[node as usize];
        let volume: f64 = surface.triangles.iter().map(|&[a, b, c]| six_volumes([x(a), x(b), x(c)])).sum::<f64>() / 6.0;
        assert!((volume - 1.5).abs() < 1e-15, "{volume}");
        assert_eq!(outline(&cells, &coordinates, 1, 1.0).unwrap().1, 4);
    }

    /// Six times the volume of a tetrahedron at the origin.
    fn six_volumes([a, b, c]: [[f64; 3]; 3]) -> f64 {
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    }
}
