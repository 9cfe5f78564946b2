//! Points, cells and measures in the plane.

/// A place, m.
pub type Point = [f64; 2];

/// Nodes of a cell, counter-clockwise; a triangle has its last node twice.
pub type Cell = [u32; 4];

/// Nodes of a cell, each once.
#[must_use]
pub fn corners(cell: &Cell) -> &[u32] {
    if cell[3] == cell[2] { &cell[..3] } else { cell }
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
    fn a_triangle_has_its_last_node_twice() {
        assert_eq!(corners(&[4, 5, 6, 6]), [4, 5, 6]);
        assert_eq!(corners(&[4, 5, 6, 7]), [4, 5, 6, 7]);
    }
}
