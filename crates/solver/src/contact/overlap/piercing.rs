//! Which edges pierce which triangles, and the contours along which the surfaces cut each other.
//!
//! Signs come from [`super::predicates`], so the set of piercings is exact for the places as they are. A pair
//! of triangles meets along one straight piece with a piercing at either end: whatever has not two ends is a
//! border of a surface, or an error, and is reported.

use super::near::Near;
use super::predicates::{Point, volume};
use super::skin::{Facet, Skin};
use super::tree::Tree;
use crate::contact::boxes::{Aabb, around, do_meet};
use crate::contact::projection::node_facet::Vector;
use crate::mesh::surface::NONE;
use crate::tensor::{cross, dot};
use crate::vector::minus;

/// An edge goes through a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piercing {
    pub(super) edge: u32,
    pub(super) triangle: u32,
    /// How far along the edge, 0 to 1.
    pub(super) along: f64,
    /// Whether from the triangle's front to its back, from the first end of the edge to the second.
    pub(super) enters: bool,
    /// Where, m.
    pub(super) place: Vector,
    /// Whether the edge lies in the triangle's plane: that it goes through follows from ties alone, and it
    /// does so anywhere there.
    pub(super) is_flat: bool,
}

/// A straight piece of the rim of what of a triangle lies inside the other body, which is on its left seen
/// from before the triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) triangle: u32,
    pub(super) from: Vector,
    pub(super) to: Vector,
}

/// All piercings, at a travel (m).
pub(super) fn find(skin: &Skin, tree: &mut Tree, near: &mut Near, travel: f64, found: &mut Vec<Piercing>) {
    found.clear();
    near.meeting(skin, tree, travel, |facets, boxes| {
        let [a, b] = [0, 1].map(|of| PlacedFacet::new(skin, facets[of], *boxes[of]));
        of_edges(skin, &a, &b, found);
        of_edges(skin, &b, &a, found);
    });
}

/// A facet where it is.
struct PlacedFacet<'a> {
    facet: &'a Facet,
    /// Its vertices, as many as it has.
    points: [Point; 5],
    bounds: Aabb<3>,
}

impl<'a> PlacedFacet<'a> {
    fn new(skin: &'a Skin, facet: u32, bounds: Aabb<3>) -> Self {
        let facet = &skin.facets[facet as usize];
        let mut points = [(NONE, [0.0; 3]); 5];
        for (point, &vertex) in points.iter_mut().zip(facet.all()) {
            *point = (vertex, skin.x[vertex as usize]);
        }
        Self { facet, points, bounds }
    }

    fn points(&self) -> &[Point] {
        &self.points[..self.facet.all().len()]
    }
}

/// Rounding of a height over a plane, as a multiple of the product of the largest components of what it comes
/// from: some forty products of up to four differences, each with at most twelve roundings.
const ROUNDING: f64 = 1024.0 * f64::EPSILON;

/// Whether points lie all on one side of a triangle's plane, or all beyond one of its edges, whatever rounds:
/// then nothing between them meets it.
fn are_beside([a, b, c]: [Point; 3], points: &[Point]) -> bool {
    let size = |v: Vector| v[0].abs().max(v[1].abs()).max(v[2].abs());
    // Whether all are farther along a direction from a place than what may round, where the direction is that
    // of a product of this size.
    let are_along = |direction: Vector, from: Point, product: f64| {
        points.iter().all(|point| {
            let away = minus(point.1, from.1);
            dot(direction, away) > ROUNDING * product * size(away)
        })
    };
    let rim = [minus(b.1, a.1), minus(c.1, b.1), minus(a.1, c.1)];
    let normal = cross(rim[0], rim[1]);
    let product = size(rim[0]) * size(rim[1]);
    are_along(normal, a, product)
        || are_along(normal.map(|c| -c), a, product)
        || [a, b, c].into_iter().zip(rim).any(|(from, way)| are_along(cross(way, normal), from, product * size(way)))
}

/// Piercings of the edges of one facet through the triangles of another one.
fn of_edges(skin: &Skin, own: &PlacedFacet<'_>, other: &PlacedFacet<'_>, found: &mut Vec<Piercing>) {
    let points = own.points();
    for triangle in other.facet.triangles() {
        let corners = skin.triangles[triangle as usize];
        let [a, b, c] = corners.map(|vertex| (vertex, skin.x[vertex as usize]));
        if are_beside([a, b, c], points) || !do_meet(&own.bounds, &around([a.1, b.1, c.1])) {
            continue;
        }
        let mut heights = [0.0; 5];
        let (mut any_before, mut any_behind) = (false, false);
        for (height, &point) in heights.iter_mut().zip(points) {
            *height = volume([a, b, c, point]);
            (any_before, any_behind) = (any_before || *height > 0.0, any_behind || *height < 0.0);
        }
        if !(any_before && any_behind) {
            continue;
        }
        let height = |vertex: u32| points.iter().position(|other| other.0 == vertex).map_or(0.0, |k| heights[k]);
        for number in own.facet.edges() {
            let ends = skin.edges[number as usize].ends;
            let [from, to] = ends.map(height);
            if (from > 0.0) == (to > 0.0) {
                continue;
            }
            let [p, q] = ends.map(|vertex| (vertex, skin.x[vertex as usize]));
            let first = volume([p, q, a, b]) > 0.0;
            if first != (volume([p, q, b, c]) > 0.0) || first != (volume([p, q, c, a]) > 0.0) {
                continue;
            }
            // An edge in the triangle's plane meets it anywhere: where it passes its middle.
            let is_flat = from.abs().max(to.abs()) <= f64::MIN_POSITIVE;
            let along = if is_flat { beside([p.1, q.1], [a.1, b.1, c.1]) } else { from / (from - to) };
            let along = along.clamp(0.0, 1.0);
            let place = [0, 1, 2].map(|d| (1.0 - along) * p.1[d] + along * q.1[d]);
            found.push(Piercing { edge: number, triangle, along, enters: from > 0.0, place, is_flat });
        }
    }
}

/// Where along an edge the middle of a triangle is.
fn beside([p, q]: [Vector; 2], [a, b, c]: [Vector; 3]) -> f64 {
    let (way, away) = (minus(q, p), [0, 1, 2].map(|d| (a[d] + b[d] + c[d]) / 3.0 - p[d]));
    dot(way, away) / dot(way, way).max(f64::MIN_POSITIVE)
}

/// One end of a piece of a contour.
#[derive(Clone, Copy, Debug)]
struct End {
    /// The triangles, ascending.
    pair: [u32; 2],
    /// Whether the piece starts here, as the rim of the first triangle's part.
    starts: bool,
    place: Vector,
}

/// The pieces of the contours of some piercings, for the first and the second triangle of each pair, which
/// are reported too; pieces without two ends are those of triangles in `loose`.
pub(super) fn contours(skin: &Skin, piercings: &[Piercing], pieces: &mut Vec<Piece>, pairs: &mut Vec<[u32; 2]>, loose: &mut Vec<u32>) {
    let mut ends: Vec<End> = Vec::with_capacity(2 * piercings.len());
    for &Piercing { edge, triangle, enters, place, .. } in piercings {
        for own in skin.edges[edge as usize].triangles.into_iter().filter(|&own| own != NONE) {
            // Along the rim of its own triangle, what is inside begins where the edge enters: there the
            // contour ends.
            let starts = enters != runs_with(skin, edge, own);
            let pair = [own.min(triangle), own.max(triangle)];
            ends.push(End { pair, starts: starts == (own < triangle), place });
        }
    }
    ends.sort_by_key(|end| (end.pair, !end.starts));
    for here in ends.chunk_by(|a, b| a.pair == b.pair) {
        match here {
            [from, to] if from.starts && !to.starts => {
                let [first, second] = from.pair;
                pieces.push(Piece { triangle: first, from: from.place, to: to.place });
                pieces.push(Piece { triangle: second, from: to.place, to: from.place });
                pairs.push(from.pair);
            }
            _ => loose.extend(here[0].pair),
        }
    }
}

/// Whether an edge runs as the rim of a triangle at it does, counter-clockwise.
pub(super) fn runs_with(skin: &Skin, edge: u32, triangle: u32) -> bool {
    let k = skin.edges_of[triangle as usize].iter().position(|other| *other == edge).unwrap_or(0);
    skin.triangles[triangle as usize][k] == skin.edges[edge as usize].ends[0]
}
