//! Nearest feature of a surface in 3D to a point: a facet, an edge or a node, which decides by its
//! pseudo-normal whether the point is inside.
//!
//! A triangle is flat. A facet of four nodes is made of four triangles around its middle x_m = ¼ Σ x_a, so
//! that facets, flat or not, join along straight edges without gaps: the distance from such a surface is
//! continuous wherever a point slides, over convex and concave edges and corners, and its nearest point is
//! found in closed form (Ericson 2005, section 5.1.5). With angle-weighted pseudo-normals at nodes and sums
//! at edges the sign of (x − P)·n is that of inside or outside for every closed surface (Bærentzen and Aanæs,
//! IEEE Trans. Vis. Comput. Graph. 11 (2005) 243-253): one rule for facets, edges and nodes, section 4.2 of
//! the theory sheet.
//!
//! The gap is g = ± |x − P|, its gradient the unit vector n = ± (x − P) / |x − P|, and −w_a n at the nodes: P
//! is the nearest point, so that its own motion along the surface changes nothing. Weights are a partition of
//! unity and x − P is along n: forces along these rows keep both momenta.
//!
//! Beyond the rim of a face, where its surface is cut off or continues around a sharp edge, the plane of the
//! last triangle continues (`Placed::seen_over`): P is then beyond the triangle, and some of its weights are
//! negative.
//!
//! Where a surface ends on a symmetry plane its image continues: the pseudo-normals of such edges and nodes
//! are those of the surface together with its image, and lie in the plane. The image needs no facets of its
//! own, since a point on the model's side of the plane is never farther from the model's own side.

pub(in crate::contact) mod eight;
mod pseudo_normal;
mod triangle;

use super::node_segment::END_TOLERANCE;
use crate::mesh::surface::{Corners, NONE, SpaceSurface};
use crate::tensor::{cross, dot};
use crate::vector::minus;
use eight::Plane;
use triangle::nearest_of_triangle;
pub(crate) use triangle::place_on_triangle;
pub(in crate::contact) use triangle::{Nearest, corners_below, square_to_triangle};

/// A vector in 3D.
pub type Vector = [f64; 3];

/// What of a surface is nearest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feature {
    /// The inside of a triangle.
    Face,
    /// The edge from corner `k` of the facet to the next one.
    Edge(usize),
    /// Corner `k` of the facet.
    Node(usize),
    /// Within a facet of four nodes: between two of its triangles, or in the middle.
    Crease,
}

/// Where a point lies with respect to a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    /// Facet that is nearest; of an edge or a node the first that was asked.
    pub facet: u32,
    /// What of it.
    pub feature: Feature,
    /// The triangle: corner k, the next one, the middle; of a facet of three nodes 0.
    pub triangle: usize,
    /// Shares of the corners in the nearest point; the fourth of a triangle is zero.
    pub weights: [f64; 4],
    /// Nearest point P, m.
    pub foot: Vector,
    /// Distance, m: negative inside.
    pub gap: f64,
    /// Gradient of the gap: from P to the point where it is outside, the other way where it is inside.
    pub normal: Vector,
}

/// Nearest point, facet and triangle.
pub(in crate::contact) type Found = (Nearest, u32, usize);

/// Whether a surface ends at an edge or a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Border {
    /// It continues all around.
    None,
    /// It is cut off.
    Cut,
    /// Its image in symmetry planes continues: their unit normals, which point to the body; of an edge twice
    /// the same.
    Mirrors([Vector; 2]),
}

impl Border {
    /// Without the components that a vector and its images take from each other.
    fn kept(self, vector: Vector) -> Vector {
        let Self::Mirrors([first, second]) = self else { return vector };
        let without = |vector: Vector, normal: Vector| {
            let along = dot(vector, normal);
            [0, 1, 2].map(|d| vector[d] - along * normal[d])
        };
        let rest = unit(without(second, first));
        let vector = without(vector, first);
        // Of one plane the second normal leaves nothing.
        if dot(without(second, first), second) > ROUNDING { without(vector, rest) } else { vector }
    }
}

/// Unit vector; zero of what has no length.
#[inline]
pub(in crate::contact) fn unit(v: Vector) -> Vector {
    let size = dot(v, v).sqrt();
    if size > 0.0 { [v[0] / size, v[1] / size, v[2] / size] } else { [0.0; 3] }
}

/// Distances below this fraction of a facet's size have no direction of their own: the pseudo-normal is
/// taken.
const ROUNDING: f64 = 1e-12;
/// Beyond the border of a surface that ends there a point counts by this fraction of a facet's size.
const BORDER: f64 = 1e-6;
/// Points of a surface that are nearer to each other than this fraction of a facet's size are one point, and
/// a corner with a smaller share has none: rounding must not decide.
const TIE: f64 = 1e-9;
/// Squares of distances to one point differ by less than this fraction.
const SAME_SQUARE: f64 = 1e-6;

/// The middle of four corners.
#[inline]
fn middle([a, b, c, d]: &[Vector; 4]) -> Vector {
    let middle = |axis: usize| 0.25 * (a[axis] + b[axis] + c[axis] + d[axis]);
    [middle(0), middle(1), middle(2)]
}

/// A surface in 3D with positions.
#[derive(Clone, Copy, Debug)]
pub struct Placed<'a> {
    /// The surface.
    pub surface: &'a SpaceSurface,
    /// Positions of all nodes, m.
    pub positions: &'a [Vector],
}

impl Placed<'_> {
    #[inline]
    fn corners(&self, facet: u32) -> ([Vector; 4], usize) {
        let [a, b, c, d] = self.surface.facets[facet as usize];
        let at = |node: u32| self.positions[node as usize];
        ([at(a), at(b), at(c), at(d)], if c == d { 3 } else { 4 })
    }

    /// The triangles of a facet: how many there are.
    #[inline]
    fn triangles(&self, facet: u32) -> usize {
        let [_, _, c, d] = self.surface.facets[facet as usize];
        if c == d { 1 } else { 4 }
    }

    /// Corners of triangle `k` of a facet.
    pub(in crate::contact) fn triangle(&self, facet: u32, k: usize) -> [Vector; 3] {
        let (x, count) = self.corners(facet);
        if count == 3 {
            return [x[0], x[1], x[2]];
        }
        [x[k], x[(k + 1) % 4], middle(&x)]
    }

    /// Shares of a facet's corners from those of triangle `k`.
    pub(in crate::contact) fn spread(&self, facet: u32, k: usize, [a, b, c]: [f64; 3]) -> [f64; 4] {
        if self.triangles(facet) == 1 {
            return [a, b, c, 0.0];
        }
        let mut weights = [0.25 * c; 4];
        weights[k] += a;
        weights[(k + 1) % 4] += b;
        weights
    }

    /// Unit normal of triangle `k`; zero where it has no area.
    pub(in crate::contact) fn normal(&self, facet: u32, k: usize) -> Vector {
        let [a, b, c] = self.triangle(facet, k);
        unit(cross(minus(b, a), minus(c, a)))
    }

    /// The triangle of a facet that has the edge from corner `k` on.
    pub(super) fn at_edge(&self, facet: u32, k: usize) -> usize {
        if self.triangles(facet) == 1 { 0 } else { k }
    }

    /// Whether a facet looks to a side: the cosine of the angle between that and its mean normal is above a
    /// number below zero.
    pub(in crate::contact) fn looks_to(&self, facet: u32, side: Vector, cosine: f64) -> bool {
        let across = self.across(facet);
        let along = dot(side, across);
        // Most do, which is seen without a root.
        (along > 0.0 && along < f64::INFINITY) || dot(side, unit(across)) > cosine
    }

    /// Mean normal of a facet: of four nodes that of its diagonals.
    #[must_use]
    pub fn facet_normal(&self, facet: u32) -> Vector {
        unit(self.across(facet))
    }

    /// The same times twice the facet's area.
    #[inline]
    fn across(&self, facet: u32) -> Vector {
        let ([a, b, c, d], count) = self.corners(facet);
        if count == 3 { cross(minus(b, a), minus(c, a)) } else { cross(minus(c, a), minus(d, b)) }
    }

    /// Area of a facet, m²: of four nodes that of its projection along its mean normal.
    #[must_use]
    pub fn area(&self, facet: u32) -> f64 {
        let twice = self.across(facet);
        0.5 * dot(twice, twice).sqrt()
    }

    /// Distance of a point from a facet, m, and the triangle that is nearest.
    #[must_use]
    pub fn nearest_triangle(&self, x: Vector, facet: u32) -> Option<(f64, usize)> {
        self.nearest(x, facet).map(|(nearest, triangle)| (nearest.square.sqrt(), triangle))
    }

    /// Length by which what is small on a facet is measured, m: the root of the sum of the squares of the
    /// diagonals, of three nodes that of two edges in the mean, whichever comes first.
    #[must_use]
    pub fn size(&self, facet: u32) -> f64 {
        let ([a, b, c, d], count) = self.corners(facet);
        let square = |p: Vector, q: Vector| dot(minus(q, p), minus(q, p));
        if count == 3 {
            return ((square(a, b) + square(b, c) + square(c, a)) * (2.0 / 3.0)).sqrt();
        }
        (square(a, c) + square(b, d)).sqrt()
    }

    /// What of a facet is nearest to x, m; nothing is said of inside or outside. `None` where that is no
    /// number.
    pub(in crate::contact) fn nearest(&self, x: Vector, facet: u32) -> Option<(Nearest, usize)> {
        let (corners, count) = self.corners(facet);
        let (last, triangles) = if count == 3 { (corners[2], 1) } else { (middle(&corners), 4) };
        let mut best: Option<(Nearest, usize)> = None;
        for k in 0..triangles {
            let found = nearest_of_triangle(x, [corners[k], corners[(k + 1) % 4], last]);
            if found.square.is_finite() && best.is_none_or(|(best, of)| self.is_nearer(x, &(found, facet, k), &(best, facet, of))) {
                best = Some((found, k));
            }
        }
        best
    }

    /// The ends of the edge on which the foot of a projection lies, or the node at which it lies and
    /// [`NONE`]; twice [`NONE`] over a facet, or beyond a rim. The same whichever of the facets there the
    /// projection names.
    #[inline]
    pub(in crate::contact) fn rests_on(&self, Projection { facet, weights, .. }: &Projection) -> [u32; 2] {
        // Nearly all are over a facet of four nodes.
        if weights.iter().all(|&weight| weight > TIE) {
            return [NONE; 2];
        }
        let corners = self.surface.facets[*facet as usize];
        let corners = corners.corners();
        let mut with = (0..corners.len()).filter(|&k| weights[k] > TIE);
        match (with.next(), with.next(), with.next()) {
            _ if weights.iter().any(|&weight| weight < -TIE) => [NONE; 2],
            (Some(node), None, _) => [corners[node], NONE],
            (Some(a), Some(b), None) => [corners[a], corners[b]],
            _ => [NONE; 2],
        }
    }

    /// Whether one of two places on a surface is nearer to x than the other. Of one point of the surface that
    /// facet counts, and that triangle of it, in front of or behind which x is farthest: which comes first
    /// says nothing.
    pub(in crate::contact) fn is_nearer(&self, x: Vector, one: &Found, other: &Found) -> bool {
        self.is_nearer_of((x, one, None), (other, None))
    }

    /// The same where the planes of both may be known.
    #[inline]
    pub(in crate::contact) fn is_nearer_of(
        &self,
        (x, one, plane): (Vector, &Found, Option<&Plane>),
        (other, of_other): (&Found, Option<&Plane>),
    ) -> bool {
        let ((a, _, _), (b, _, _)) = (one, other);
        if (a.square - b.square).abs() <= SAME_SQUARE * a.square.max(b.square) {
            let apart = minus(a.foot, b.foot);
            let least = TIE * plane.map_or_else(|| self.size(one.1), |plane| plane.size);
            if dot(apart, apart) <= least * least {
                let height = |(nearest, facet, k): &Found, plane: Option<&Plane>| {
                    plane.map_or_else(|| dot(minus(x, nearest.foot), self.normal(*facet, *k)), |plane| plane.height).abs()
                };
                let heights = [height(one, plane), height(other, of_other)];
                // What is symmetric has none that is farther: there the first stays, step by step.
                if (heights[0] - heights[1]).abs() > TIE * heights[0].max(heights[1]) {
                    return heights[0] > heights[1];
                }
            }
        }
        a.square < b.square || (a.square == b.square && one.1 < other.1)
    }

    /// Distance of a point from a facet, m.
    #[must_use]
    pub fn distance(&self, x: Vector, facet: u32) -> Option<f64> {
        self.nearest(x, facet).map(|(nearest, _)| nearest.square.sqrt())
    }

    /// What the weights of a triangle's nearest point say.
    fn feature(&self, facet: u32, k: usize, [a, b, c]: [f64; 3]) -> Feature {
        let is_triangle = self.triangles(facet) == 1;
        let next = |k: usize| if is_triangle { (k + 1) % 3 } else { (k + 1) % 4 };
        match (a > 0.0, b > 0.0, c > 0.0) {
            (true, true, true) => Feature::Face,
            (true, true, false) => Feature::Edge(k),
            (true, false, false) => Feature::Node(k),
            (false, true, false) => Feature::Node(next(k)),
            (false, true, true) if is_triangle => Feature::Edge(1),
            (true, false, true) if is_triangle => Feature::Edge(2),
            (false, false, true) if is_triangle => Feature::Node(2),
            _ => Feature::Crease,
        }
    }

    /// How the surface ends at the edge from a corner of a facet on, at which it ends.
    fn border(&self, facet: u32, corner: usize) -> Border {
        let edge = self.surface.edges_of[facet as usize][corner];
        self.surface.mirror(edge).map_or(Border::Cut, |normal| Border::Mirrors([normal; 2]))
    }

    /// Normal of the symmetry plane on which the surface ends at the side of triangle `k` from its corner
    /// `side` to the next one, if it does.
    pub(in crate::contact) fn mirror_at(&self, facet: u32, k: usize, side: usize) -> Option<Vector> {
        if self.surface.mirrors.is_empty() || (side > 0 && self.triangles(facet) == 4) {
            return None;
        }
        self.surface.mirror(self.surface.edges_of[facet as usize][k + side])
    }

    /// Whether a point is on the model's side of a symmetry plane that goes through `at`, by its normal
    /// there; `size` (m) is that of the facet.
    pub(in crate::contact) fn is_before(x: Vector, at: Vector, normal: Vector, size: f64) -> bool {
        dot(minus(x, at), normal) >= -BORDER * size
    }

    /// What of some facets is nearest, and its triangle; see [`Placed::is_nearer`].
    pub(in crate::contact) fn nearest_of(&self, x: Vector, facets: impl IntoIterator<Item = u32>) -> Option<Found> {
        let mut best: Option<Found> = None;
        for facet in facets {
            if let Some((nearest, k)) = self.nearest(x, facet) {
                let found = (nearest, facet, k);
                if best.is_none_or(|best| self.is_nearer(x, &found, &best)) {
                    best = Some(found);
                }
            }
        }
        best
    }

    /// Where x lies by the nearest of some facets. `None` where there is none, or the surface ends before x
    /// comes over it.
    #[must_use]
    pub fn project(&self, x: Vector, facets: impl IntoIterator<Item = u32>) -> Option<Projection> {
        self.seen(x, self.nearest_of(x, facets)?)
    }

    /// As [`Placed::seen`], but the plane of the nearest triangle continues beyond the rim of what `is_face`
    /// says is the face; with it the way from the rim to P, m, zero over the face.
    pub(in crate::contact) fn seen_over(&self, x: Vector, found: Found, is_face: impl Fn(u32) -> bool) -> Option<(Projection, Vector)> {
        let (nearest, facet, k) = found;
        let continues = |edge: usize| {
            let other = self.surface.across(facet, edge);
            if other == NONE { self.border(facet, edge) != Border::Cut } else { is_face(other) }
        };
        let is_inside = match self.feature(facet, k, nearest.weights) {
            Feature::Face | Feature::Crease => true,
            Feature::Edge(edge) => continues(edge),
            Feature::Node(corner) => {
                let node = self.surface.facets[facet as usize][corner];
                let (_, border) = self.node_normal(facet, corner);
                border != Border::Cut && self.surface.facets_at(node).iter().all(|&other| is_face(other))
            }
        };
        if is_inside {
            return self.seen(x, found).map(|found| (found, [0.0; 3]));
        }
        let over = self.over(x, facet, k)?;
        let beyond = minus(over.foot, nearest.foot);
        Some((over, beyond))
    }

    /// Where a point is seen from the plane of triangle `k`, over it or not: shares of its corners in the
    /// foot, height above it (m), and normal. `None` where it has no area.
    pub(in crate::contact) fn above(&self, x: Vector, facet: u32, k: usize) -> Option<(Vector, f64, Vector)> {
        let [a, b, c] = self.triangle(facet, k);
        let area = cross(minus(b, a), minus(c, a));
        let square = dot(area, area);
        if !(square > 0.0) {
            return None;
        }
        let normal = unit(area);
        let share = |p: Vector, q: Vector| dot(cross(minus(p, x), minus(q, x)), area) / square;
        let (first, second) = (share(b, c), share(c, a));
        Some(([first, second, 1.0 - first - second], dot(minus(x, a), normal), normal))
    }

    /// The projection on the plane of triangle `k`, over it or not; `None` where it has no area.
    fn over(&self, x: Vector, facet: u32, k: usize) -> Option<Projection> {
        let (shares, gap, normal) = self.above(x, facet, k)?;
        let foot = [0, 1, 2].map(|d| x[d] - gap * normal[d]);
        Some(Projection { facet, feature: Feature::Face, triangle: k, weights: self.spread(facet, k, shares), foot, gap, normal })
    }

    /// Whether the foot on the plane of a triangle is on it as far as rounding can resolve: by the same
    /// fraction of a facet as in 2D.
    fn is_over(&self, over: &Projection) -> bool {
        let [a, b, c, d] = over.weights;
        let least = if self.triangles(over.facet) == 1 {
            a.min(b).min(c)
        } else {
            // The middle has four times the least share; it is half as far from a side as the opposite one.
            let middle = 4.0 * [a, b, c, d][(over.triangle + 2) % 4];
            let own = [a, b, c, d][over.triangle] - 0.25 * middle;
            (0.5 * middle).min(own).min(1.0 - middle - own)
        };
        least >= -END_TOLERANCE
    }

    /// A point that is behind the plane of the nearest triangle, by its distance from that triangle, over it
    /// or beyond its rim: as deep, and pushed back to it. With the triangle's normal; `None` where it is
    /// before the plane, or on it.
    pub(in crate::contact) fn behind(&self, x: Vector, (nearest, facet, triangle): Found) -> Option<(Projection, Vector)> {
        let Nearest { square, weights, foot } = nearest;
        let (along, away, distance) = (self.normal(facet, triangle), minus(x, foot), square.sqrt());
        let (feature, weights) = (self.feature(facet, triangle, weights), self.spread(facet, triangle, weights));
        let height = dot(away, along);
        if !(height < 0.0 && distance > ROUNDING * self.size(facet)) {
            return None;
        }
        let (gap, normal) = if feature == Feature::Face { (height, along) } else { (-distance, away.map(|c| -c / distance)) };
        Some((Projection { facet, feature, triangle, weights, foot, gap, normal }, along))
    }

    /// As [`Placed::seen`] where the plane of the nearest triangle may be known.
    #[inline]
    pub(in crate::contact) fn seen_by(&self, x: Vector, found: Found, plane: Option<Plane>) -> Option<Projection> {
        let (Nearest { weights, foot, .. }, facet, triangle) = found;
        match plane {
            Some(Plane { normal, height, .. }) if weights.iter().all(|&weight| weight > 0.0) => {
                let weights = self.spread(facet, triangle, weights);
                Some(Projection { facet, feature: Feature::Face, triangle, weights, foot, gap: height, normal })
            }
            _ => self.seen(x, found),
        }
    }

    /// Gap and normal of what is nearest. `None` where the surface ends before x comes over it.
    pub(in crate::contact) fn seen(&self, x: Vector, (nearest, facet, triangle): Found) -> Option<Projection> {
        let Nearest { square, weights, foot } = nearest;
        let feature = self.feature(facet, triangle, weights);
        let (away, distance) = (minus(x, foot), square.sqrt());
        let spread = self.spread(facet, triangle, weights);
        let projection = |gap: f64, normal: Vector| Projection { facet, feature, triangle, weights: spread, foot, gap, normal };
        if let Feature::Node(corner) = feature
            && distance > ROUNDING * self.size(facet)
            && let Some(side) = self.side_of_node(facet, corner, away)
        {
            return Some(projection(side * distance, away.map(|c| side * c / distance)));
        }
        let (pseudo, border) = self.pseudo_normal(facet, triangle, feature, weights);
        if feature == Feature::Face {
            return Some(projection(dot(away, pseudo), pseudo));
        }
        let size = self.size(facet);
        if let Border::Mirrors(normals) = border {
            // Beyond the plane is nothing of the model's: what is there meets no image.
            if !normals.into_iter().all(|normal| Self::is_before(x, foot, normal, size)) {
                return None;
            }
            // Who is over a facet as far as rounding can resolve sees its normal, as in 2D.
            if let Some(over) = self.over(x, facet, triangle).filter(|over| self.is_over(over)) {
                return Some(over);
            }
        }
        if border == Border::Cut {
            // At the border: over it, as far as rounding can resolve, it is the facet's.
            let over = self.over(x, facet, triangle)?;
            let beside = minus(over.foot, foot);
            return (dot(beside, beside).sqrt() <= BORDER * size).then_some(over);
        }
        if distance <= ROUNDING * size {
            let normal = unit(pseudo);
            return Some(projection(dot(away, normal), normal));
        }
        let side = if dot(away, pseudo) >= 0.0 { 1.0 } else { -1.0 };
        Some(projection(side * distance, away.map(|c| side * c / distance)))
    }
}

#[cfg(test)]
mod tests;
