//! Vectors in 3D.

use super::Point;

pub(super) fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Six times the volume of a tetrahedron, positive if the first three vertices run counter-clockwise seen
/// from the last.
pub(super) fn six_volumes(x: &[Point; 4]) -> f64 {
    dot(cross(minus(x[1], x[0]), minus(x[2], x[0])), minus(x[3], x[0]))
}
