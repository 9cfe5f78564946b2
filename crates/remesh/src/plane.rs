//! Points, cells and measures in the plane.

use std::collections::{BTreeMap, BTreeSet};

/// A place, m.
pub type Point = [f64; 2];

/// Nodes of a cell, counter-clockwise; a triangle has its last node twice.
pub type Cell = [u32; 4];

/// Nodes of a cell, each once.
#[must_use]
pub fn corners(cell: &Cell) -> &[u32] {
    if cell[3] == cell[2] { &cell[..3] } else { cell }
}

/// Closed chains of nodes along the edges that one cell alone has, the body on the left; each begins with its
/// lowest node.
///
/// # Errors
/// Why there are none, in words: the outline meets itself in a node, or is not closed.
pub fn loops(cells: &[Cell]) -> Result<Vec<Vec<u32>>, &'static str> {
    let edges = |cell: &Cell| {
        let corners = corners(cell).to_vec();
        (0..corners.len()).map(move |k| [corners[k], corners[(k + 1) % corners.len()]])
    };
    let all: BTreeSet<[u32; 2]> = cells.iter().flat_map(edges).collect();
    let mut next: BTreeMap<u32, u32> = BTreeMap::new();
    for &[a, b] in all.iter().filter(|&&[a, b]| !all.contains(&[b, a])) {
        if next.insert(a, b).is_some() {
            return Err("its outline meets itself in a node");
        }
    }
    let mut loops = Vec::new();
    while let Some((&first, _)) = next.first_key_value() {
        let (mut chain, mut at) = (Vec::new(), first);
        while let Some(following) = next.remove(&at) {
            chain.push(at);
            at = following;
        }
        if at != first {
            return Err("its outline is not closed");
        }
        loops.push(chain);
    }
    Ok(loops)
}

/// A mesh of triangles and quadrilaterals.
#[derive(Clone, Copy, Debug)]
pub struct Mesh<'a> {
    /// Places of all nodes, m.
    pub positions: &'a [Point],
    /// Nodes of each cell.
    pub cells: &'a [Cell],
}

/// What an area of the plane stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Itself, per metre of depth: ∫ dA.
    Plane,
    /// An axisymmetric body about x = 0: ∫ 2πx dA.
    Revolution,
}

/// a − b.
#[must_use]
pub fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

/// a · b.
#[must_use]
pub fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// The component of a × b out of the plane.
#[must_use]
pub fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// |a − b|.
#[must_use]
pub fn distance(a: Point, b: Point) -> f64 {
    dot(minus(a, b), minus(a, b)).sqrt()
}

/// The point on the line from `a` to `b` at a fraction of it, exact at both ends and in a coordinate that
/// they share.
#[must_use]
pub fn on_line(a: Point, b: Point, fraction: f64) -> Point {
    [0, 1].map(|d| if fraction == 1.0 { b[d] } else { a[d] + (b[d] - a[d]) * fraction })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outlines_are_closed_chains_with_the_body_on_the_left() {
        // A ring of eight quadrilaterals, nodes 0 to 7 outside and 8 to 15 inside.
        let ring = |k: u32| [k, (k + 1) % 8, 8 + (k + 1) % 8, 8 + k];
        let cells: Vec<Cell> = (0..8).map(ring).collect();
        assert_eq!(loops(&cells).unwrap(), [(0..8).collect::<Vec<_>>(), vec![8, 15, 14, 13, 12, 11, 10, 9]]);
        assert_eq!(loops(&[[0, 1, 2, 2], [2, 1, 3, 3]]).unwrap(), [[0, 1, 3, 2]]);
        assert!(loops(&[[0, 1, 2, 2], [2, 3, 4, 4]]).is_err());
        assert!(loops(&[]).unwrap().is_empty());
    }

    #[test]
    fn a_triangle_has_its_last_node_twice() {
        assert_eq!(corners(&[4, 5, 6, 6]), [4, 5, 6]);
        assert_eq!(corners(&[4, 5, 6, 7]), [4, 5, 6, 7]);
    }
}
