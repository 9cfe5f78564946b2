//! How many times the surface of a body goes around a place: what a ray from there leaves, less what it
//! enters. Of a place of its own along the outward normal: zero on a sound surface, one where another part of
//! the body lies over it.

use super::skin::Skin;
use super::tree::Tree;
use crate::contact::projection::node_facet::{Vector, unit};
use crate::tensor::{cross, dot};
use crate::vector::{length, minus};

/// What is nearer than this fraction of the triangle's size is the place itself.
const HERE: f64 = 1e-9;
/// Along these a place outside of a body sees as many of its triangles from behind as from before: one ray
/// may go through an edge, which is seen as none.
const DIRECTIONS: [Vector; 3] = [[0.483, 0.619, 0.619], [-0.757, 0.311, 0.575], [0.241, -0.853, -0.463]];

impl Tree {
    /// Whether a place of a triangle lies in another part of its body.
    pub(super) fn is_in_itself(&self, skin: &Skin, own: u32, place: Vector) -> bool {
        let ([a, b, c], outward) = (skin.corners(own), unit(skin.double(own)));
        let here = HERE * length(minus(b, a)).max(length(minus(c, a)));
        self.winding(skin, skin.body(own), (place, outward), |triangle, away| triangle != own && away > here) > 0
    }

    /// Whether a place that is not on the surface of a body may lie in it; certain of what does not.
    pub(super) fn may_be_in(&self, skin: &Skin, body: u32, place: Vector) -> bool {
        DIRECTIONS.iter().any(|&direction| self.winding(skin, body, (place, direction), |_, away| away > 0.0) != 0)
    }

    /// What a ray leaves of the triangles that count, less what it enters.
    fn winding(&self, skin: &Skin, body: u32, (from, direction): (Vector, Vector), counts: impl Fn(u32, f64) -> bool) -> i32 {
        let mut winding = 0;
        self.along(skin, body, from, direction, |triangle| {
            if let Some((away, leaves)) = crosses(from, direction, skin.corners(triangle))
                && counts(triangle, away)
            {
                winding += if leaves { 1 } else { -1 };
            }
        });
        winding
    }
}

/// How far along a direction a triangle is crossed, and whether from behind.
fn crosses(from: Vector, direction: Vector, corners: [Vector; 3]) -> Option<(f64, bool)> {
    let [a, b, c] = corners.map(|corner| minus(corner, from));
    let [p, q, r] = [dot(direction, cross(a, b)), dot(direction, cross(b, c)), dot(direction, cross(c, a))];
    let leaves = p > 0.0 && q > 0.0 && r > 0.0;
    let enters = p < 0.0 && q < 0.0 && r < 0.0;
    (leaves || enters).then(|| (dot(a, cross(b, c)) / (p + q + r), leaves))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle_is_crossed_where_it_is_and_from_its_side() {
        let [a, b, c] = [[0.0, 0.0, 2.0], [1.0, 0.0, 2.0], [0.0, 1.0, 2.0]];
        let from = [0.2, 0.3, 0.5];
        for (direction, corners, expected) in [
            ([0.0, 0.0, 1.0], [a, b, c], (1.5, true)),
            ([0.0, 0.0, 1.0], [a, c, b], (1.5, false)),
            ([0.0, 0.0, -1.0], [a, b, c], (-1.5, false)),
        ] {
            let found = crosses(from, direction, corners);
            assert!(found.is_some_and(|(away, leaves)| (away - expected.0).abs() < 1e-14 && leaves == expected.1), "{found:?}");
        }
        assert_eq!(crosses([0.7, 0.6, 0.0], [0.0, 0.0, 1.0], [a, b, c]), None);
    }
}
