//! How many times a surface goes around a place: the sum of the solid angles of its triangles over 4π.
//!
//! Of a triangle with the corners a, b, c as seen from the place tan(Ω/2) = a·(b × c) / (|a||b||c| + (a·b)|c| + (b·c)|a| + (c·a)|b|) (van Oosterom
//! and Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125-126). Of a place on an edge of the surface the triangles there have none, and the
//! others have the dihedral angle θ / 2π; if another part of the body lies over it, 1 more.

use super::skin::Skin;
use crate::contact::projection::node_facet::Vector;
use crate::tensor::{cross, dot};
use crate::vector::{length, minus};
use std::f64::consts::PI;

/// Triangles that are seen from their own plane: a·(b × c) below this fraction of |a||b||c|.
const FLAT: f64 = 1e-9;
/// Above this the place of an edge lies in another part of its body; what it lies on alone is below 1.
const WITHIN: f64 = 1.02;

impl Skin {
    /// Whether a place on an edge of a body lies in another part of it.
    pub(super) fn is_in_itself(&self, body: u32, place: Vector) -> bool {
        let mut angle = 0.0;
        for facet in self.facets.iter().filter(|facet| facet.body == body) {
            for triangle in facet.triangles() {
                angle += half_angle(self.corners(triangle).map(|x| minus(x, place)));
            }
        }
        angle / (2.0 * PI) > WITHIN
    }
}

/// Half of the solid angle of a triangle.
fn half_angle([a, b, c]: [Vector; 3]) -> f64 {
    let [la, lb, lc] = [length(a), length(b), length(c)];
    let volume = dot(a, cross(b, c));
    if volume.abs() <= FLAT * la * lb * lc { 0.0 } else { volume.atan2(la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_octant_an_eighth_and_what_is_seen_edge_on_nothing() {
        let [x, y, z] = [[2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 0.5]];
        assert!((half_angle([x, y, z]) - PI / 4.0).abs() < 1e-15 && (half_angle([x, z, y]) + PI / 4.0).abs() < 1e-15);
        assert_eq!(half_angle([x, x.map(|c| -c), y]), 0.0);
        // From the middle of a face of a tetrahedron the others have half of everything.
        let [p, q, r, s] = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
        let middle = [0, 1, 2].map(|d| (p[d] + q[d] + r[d]) / 3.0);
        let from = |corners: [Vector; 3]| half_angle(corners.map(|corner| minus(corner, middle)));
        assert!((from([p, r, s]) + from([p, s, q]) + from([q, s, r]) - PI).abs() < 1e-14);
        assert_eq!(from([p, q, r]), 0.0);
    }
}
