//! Which side of a surface is outside at its edges and nodes: by the sum of the normals of the triangles
//! there, at nodes by their angles (Baerentzen and Aanaes, IEEE Trans. Visual. Comput. Graphics 11 (2005)
//! 243-253).
//!
//! Features come from [`Placed::seen`], which takes the sign of the gap from here.

use super::{Border, Feature, Placed, Vector, unit};
use crate::mesh::surface::{Corners, NONE};
use crate::tensor::{cross, dot};
use crate::vector::{minus, plus};

/// A direction is clearly on one side of a triangle from this sine of the angle between both on.
const CLEAR: f64 = 1e-6;
impl Placed<'_> {
    /// Direction by which a feature reports outside from inside, not of unit length, and whether the surface
    /// ends there.
    pub(super) fn pseudo_normal(&self, facet: u32, k: usize, feature: Feature, weights: [f64; 3]) -> (Vector, Border) {
        match feature {
            Feature::Face => (self.normal(facet, k), Border::None),
            Feature::Crease => {
                // Between two triangles, or in the middle of all four.
                let along = |k: usize| self.normal(facet, k);
                let sum = match (weights[0] > 0.0, weights[1] > 0.0) {
                    (true, _) => plus(along(k), along((k + 3) % 4)),
                    (_, true) => plus(along(k), along((k + 1) % 4)),
                    _ => (0..4).fold([0.0; 3], |sum, k| plus(sum, self.angle_weighted(facet, k, 2))),
                };
                (sum, Border::None)
            }
            Feature::Edge(corner) => {
                let own = self.normal(facet, self.at_edge(facet, corner));
                let other = self.surface.across(facet, corner);
                if other == NONE {
                    let border = self.border(facet, corner);
                    return (border.kept(own), border);
                }
                let edge = self.surface.edges_of[facet as usize][corner];
                let there = (0..4).find(|&k| self.surface.edges_of[other as usize][k] == edge).unwrap_or(0);
                (plus(own, self.normal(other, self.at_edge(other, there))), Border::None)
            }
            Feature::Node(corner) => self.node_normal(facet, corner),
        }
    }

    /// Normal of triangle `k` times its angle at its corner `at`.
    fn angle_weighted(&self, facet: u32, k: usize, at: usize) -> Vector {
        let [p, q] = self.sides(facet, k, at);
        let normal = cross(p, q);
        // The angle by a rational bound of its sine and cosine is not enough: weights must be angles for the
        // sign to be right.
        let angle = angle_of(dot(normal, normal).sqrt(), dot(p, q));
        unit(normal).map(|n| angle * n)
    }

    /// From corner `at` of triangle `k` to its other two.
    fn sides(&self, facet: u32, k: usize, at: usize) -> [Vector; 2] {
        let x = self.triangle(facet, k);
        [1, 2].map(|next| minus(x[(at + next) % 3], x[at]))
    }

    /// Triangles of a facet at its corner, each with the number of that among its own.
    fn triangles_at(&self, facet: u32, corner: usize) -> ((usize, usize), Option<(usize, usize)>) {
        if self.triangles(facet) == 1 { ((0, corner), None) } else { ((corner, 0), Some(((corner + 3) % 4, 1))) }
    }

    /// Sum of what a facet has at its corner.
    fn corner_weighted(&self, facet: u32, corner: usize) -> Vector {
        let ((k, at), second) = self.triangles_at(facet, corner);
        let first = self.angle_weighted(facet, k, at);
        second.map_or(first, |(k, at)| plus(first, self.angle_weighted(facet, k, at)))
    }

    /// The facet across an edge, and its corner at a node of that; nothing where the surface ends.
    fn beyond(&self, facet: u32, edge: usize, node: u32) -> Option<(u32, usize)> {
        let other = self.surface.across(facet, edge);
        let corners = self.surface.facets.get(other as usize)?;
        Some((other, corners.corners().iter().position(|&there| there == node)?))
    }

    /// Angle-weighted normal at a corner of a facet, over the facets that follow each other around it, and
    /// whether the surface ends there.
    #[must_use]
    pub fn node_normal(&self, facet: u32, corner: usize) -> (Vector, Border) {
        let node = self.surface.facets[facet as usize][corner];
        let mut sum = self.corner_weighted(facet, corner);
        let most = self.surface.facets_at(node).len();
        let mut borders = [Border::Cut; 2];
        // One way around, and where the surface ends the other way from the beginning.
        for (way, forward) in [true, false].into_iter().enumerate() {
            let mut here = (facet, corner);
            for _ in 0..most {
                let count = self.surface.facets[here.0 as usize].corners().len();
                let edge = if forward { here.1 } else { (here.1 + count - 1) % count };
                let Some((other, at)) = self.beyond(here.0, edge, node) else {
                    borders[way] = self.border(here.0, edge);
                    break;
                };
                if other == facet {
                    return (sum, Border::None);
                }
                sum = plus(sum, self.corner_weighted(other, at));
                here = (other, at);
            }
        }
        let [Border::Mirrors([first, _]), Border::Mirrors([second, _])] = borders else { return (sum, Border::Cut) };
        let border = Border::Mirrors([first, second]);
        (border.kept(sum), border)
    }

    /// On which side of the surface around a corner of the facet `first` a direction from there points: 1
    /// outside, −1 inside, where all triangles say the same, clearly; so does their angle-weighted normal
    /// then.
    pub(super) fn side_of_node(&self, first: u32, corner: usize, away: Vector) -> Option<f64> {
        let (least, mut side) = (CLEAR * CLEAR * dot(away, away), 0.0);
        let agrees = |across: Vector| {
            let along = dot(away, across);
            let is_clear = along * along > least * dot(across, across) && along * side >= 0.0;
            side = along;
            is_clear
        };
        self.all_around(first, corner, agrees).then(|| side.signum())
    }

    /// Whether the surface around a corner of the facet `first` closes there, and the normals of all its
    /// triangles have a cosine with the unit vector `direction` that is clearly below `cosine` < 0: then so
    /// has their angle-weighted normal.
    #[must_use]
    pub fn faces(&self, first: u32, corner: usize, direction: Vector, cosine: f64) -> bool {
        let least = (cosine - CLEAR) * (cosine - CLEAR);
        self.all_around(first, corner, |across| {
            let along = dot(direction, across);
            along < 0.0 && along * along > least * dot(across, across)
        })
    }

    /// Whether the surface around a corner of the facet `first` closes there, and something is `true` of all
    /// triangles by their normals, not of unit length.
    fn all_around(&self, first: u32, corner: usize, mut is_true: impl FnMut(Vector) -> bool) -> bool {
        let node = self.surface.facets[first as usize][corner];
        let mut here = (first, corner);
        for _ in 0..self.surface.facets_at(node).len() {
            let (facet, corner) = here;
            let (one, other) = self.triangles_at(facet, corner);
            for (k, at) in std::iter::once(one).chain(other) {
                let [p, q] = self.sides(facet, k, at);
                if !is_true(cross(p, q)) {
                    return false;
                }
            }
            let Some(next) = self.beyond(facet, corner, node) else { return false };
            here = next;
            if here.0 == first {
                return true;
            }
        }
        false
    }
}

/// Angle (rad) between two directions with the sine `sin` ≥ 0 and the cosine `cos`, both times any positive
/// number: the same bits everywhere, to some 1e-15.
pub(super) fn angle_of(sin: f64, cos: f64) -> f64 {
    use std::f64::consts::{FRAC_PI_2, PI};
    if sin == 0.0 {
        return if cos < 0.0 { PI } else { 0.0 };
    }
    // tan of an angle below 45 degrees, halved twice: tan(a/2) = t / (1 + √(1 + t²)); then its series.
    let (t, swapped) = if sin < cos.abs() { (sin / cos.abs(), false) } else { (cos.abs() / sin, true) };
    let half = |t: f64| t / (1.0 + (1.0 + t * t).sqrt());
    let q = half(half(half(t)));
    let square = q * q;
    let mut sum = 0.0;
    for k in (0..9).rev() {
        sum = 1.0 / f64::from(2 * k + 1) - square * sum;
    }
    let angle = 8.0 * q * sum;
    let angle = if swapped { FRAC_PI_2 - angle } else { angle };
    if cos < 0.0 { PI - angle } else { angle }
}
