//! Facets in the common plane of a pair: whether they are apart there, and which of the triangles about their
//! middles have something in common.
//!
//! Facets come from [`super::common`], which integrates over what is found. Convex facets that have nothing
//! in common are apart along an edge of one of them. On which side of each edge of the other facet corners
//! and middle are is found once, eight edges at a time; from that follows which pairs of triangles are apart,
//! which triangle is within another, and which edges cut it.
//!
//! *Corners near edges.* Where meshes are alike, corners lie on edges of the other surface but for the little
//! that they slip, and each facet would be cut along strips. So distances to an edge that are smaller than
//! [`NEAR`] count as none, and up to twice that they grow to what they are ([`soft`]), if the surface
//! continues beyond the edge: what a facet loses as it does not reach the neighbour its own partner gains,
//! since both see the same distances. Shares of both partners are the same at the edge, so loads err by the
//! square of that, and go with positions without a jump. One of both facets has corners that are near edges:
//! that of the first surface, or body.

use super::common::{Borders, Facets, Frame};
use super::polygon::{Edge, FLAT, Linear, Point, Polygon};
use crate::tensor::{cross, dot};
use crate::vector::minus;
use embate_lanes::{BATCH, Batch, Kernel, Lane, Level};

type Vector = [f64; 3];

/// The middle of a facet of four nodes among its corners.
pub(super) const MIDDLE: usize = 4;
/// Pairs of triangles of two facets.
pub(super) const PIECES: usize = 16;
/// A corner of a common part is on an edge of a facet if the share of the opposite corner is smaller there.
const ON_EDGE: f64 = 1e-9;
/// Places nearer to an edge than this fraction of the smaller facet's size are on it: round-off.
const TOUCHES: f64 = 1e-13;
/// The same fraction where the surface continues beyond the edge, of the edge or the facet with the corner.
pub(super) const NEAR: f64 = 1e-6;

/// A triangle of a fan.
#[derive(Clone, Copy, Default)]
pub(super) struct Sector {
    /// Its corners among those of the facet and its middle.
    pub(super) labels: [usize; 3],
    /// Linear functions that are one at the first or the second corner and zero at the others.
    pub(super) shares: [Linear; 2],
}

/// Edges of a facet's fan that bound one of its triangles, as bits: those that have it on their left in the
/// lower byte and those that have it on their right in the higher one.
type Bounds = u16;

/// Edges of another fan that have a place on their left and on their right by more than counts, and that are
/// so near that it counts as nearer, as bits, a byte each from the lowest on; or any corner of a triangle.
type Places = u32;

/// How a triangle lies with respect to the edges of another fan, as bits.
#[derive(Clone, Copy, Default)]
struct Lies {
    /// Edges with triangles on their left, and on their right, which have this one on their other side.
    beyond: Bounds,
    /// Edges that divide it, or on which all of it is.
    divide: u8,
    near: u8,
}

impl Lies {
    fn new(places: Places) -> Self {
        let [left, right, near, _] = places.to_le_bytes();
        let beyond = u16::from_le_bytes([right & !left, left & !right]);
        Self { beyond, divide: left & right | !(left | right), near }
    }

    /// Edges of a triangle that divide this one.
    fn cut_by(self, of: Bounds) -> [u8; 2] {
        of.to_le_bytes().map(|edges| edges & self.divide)
    }
}

/// Edges of a facet, with it on their left, and of four those from its middle to its corners: by coordinates,
/// since all are asked at once. What is nearer (twice the area of the triangle with it, m²) is on an edge.
#[derive(Clone, Copy, Default)]
struct Edges {
    from: [Batch; 2],
    along: [Batch; 2],
    near: Batch,
}

impl Edges {
    fn get(&self, k: usize) -> Edge {
        Edge { from: [0, 1].map(|d| self.from[d].0[k]), along: [0, 1].map(|d| self.along[d].0[k]) }
    }
}

/// Two facets as triangles about their middles, or as the ones that they are. In batches of eight the first
/// four are of the first facet, which is seen from behind.
#[derive(Clone, Copy, Default)]
pub(super) struct Fans {
    /// Numbers of corners.
    pub(super) corners: [usize; 2],
    /// Corners, m, and their heights above the plane, m.
    places: [Batch; 3],
    middles: [Vector; 2],
    edges: [Edges; 2],
    /// Which facet is cut by the edges of the other one, and on which side of each its corners and middle
    /// are, m².
    cut: usize,
    sides: [Batch; 5],
    lies: [[Lies; 4]; 2],
    /// Of each triangle the shares of the corner with its number and of the next one, and its height.
    shares: [[Batch; 3]; 2],
    height: [Batch; 3],
    /// Triangles that have an area, as bits.
    sectors: u8,
}

impl Fans {
    /// The facets in the plane with these axes, the last of which is its normal; false where they are apart,
    /// or have not more in common than a strip of this width, m.
    pub(super) fn set(&mut self, facets: &Facets<'_>, origin: Vector, axes: [Vector; 3], width: f64, level: Level) -> bool {
        level.run(Lay { fans: self, facets, origin, axes, width })
    }

    pub(super) fn height(&self, k: usize, sector: usize) -> Linear {
        self.height.each_ref().map(|c| c.0[4 * k + sector])
    }

    pub(super) fn heights(&self, k: usize) -> [f64; 5] {
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| self.places[2].0[4 * k + i]);
        [a, b, c, d, self.middles[k][2]]
    }

    fn labels(&self, k: usize, sector: usize) -> [usize; 3] {
        if self.corners[k] == 3 { [0, 1, 2] } else { [sector, (sector + 1) % 4, MIDDLE] }
    }

    pub(super) fn sector(&self, k: usize, sector: usize) -> Sector {
        let shares = self.shares.each_ref().map(|share| share.each_ref().map(|c| c.0[4 * k + sector]));
        Sector { labels: self.labels(k, sector), shares }
    }

    pub(super) fn sectors(&self, k: usize) -> impl Iterator<Item = usize> + use<> {
        let bits = self.sectors >> (4 * k);
        (0..4).filter(move |sector| bits >> sector & 1 != 0)
    }

    fn bounds(&self, k: usize, sector: usize) -> Bounds {
        if self.corners[k] == 3 {
            return 0b111;
        }
        let (own, next) = (0x10 << sector, 0x10 << ((sector + 1) % 4));
        let (left, right) = if k == 0 { (next, own) } else { (own, next) };
        u16::from_le_bytes([1 << sector | left, right])
    }

    fn place(&self, k: usize, corner: usize) -> Point {
        if corner == MIDDLE { [self.middles[k][0], self.middles[k][1]] } else { [0, 1].map(|d| self.places[d].0[4 * k + corner]) }
    }

    /// Corners of a triangle, counter-clockwise.
    fn around(&self, k: usize, sector: usize) -> [usize; 3] {
        let [a, b, c] = self.labels(k, sector);
        if k == 0 { [b, a, c] } else { [a, b, c] }
    }

    fn triangle(&self, k: usize, sector: usize) -> [Point; 3] {
        self.around(k, sector).map(|corner| self.place(k, corner))
    }

    /// Hands on what triangles of the first facet have in common with those of the second one, with their
    /// numbers.
    pub(super) fn meet(&self, mut found: impl FnMut([usize; 2], &Polygon)) {
        let (cut, by) = (self.cut, 1 - self.cut);
        let (mut one, mut two) = (Polygon::default(), Polygon::default());
        let (mut part, mut room) = (&mut one, &mut two);
        let all_edges = [0, 1, 2, 3].map(|j| self.bounds(by, j));
        for i in self.sectors(cut) {
            let (own, bounds, corners) = (self.lies[cut][i], self.bounds(cut, i), self.triangle(cut, i));
            for j in self.sectors(by) {
                let (others, edges) = (self.lies[by][j], all_edges[j]);
                if own.beyond & edges | others.beyond & bounds != 0 {
                    continue;
                }
                let cuts = own.cut_by(edges);
                let all = cuts[0] | cuts[1];
                if own.near & all != 0 {
                    self.cut_softly(i, cuts, part);
                } else if edges.to_le_bytes() == cuts && others.cut_by(bounds) == [0; 2] {
                    part.set(&self.triangle(by, j));
                } else {
                    part.set(&corners);
                    bits(all, |k| {
                        let edge = self.edges[by].get(k);
                        part.cut_along(if cuts[0] >> k & 1 != 0 { edge } else { edge.reversed() }, room);
                        std::mem::swap(&mut part, &mut room);
                    });
                }
                found(if cut == 0 { [i, j] } else { [j, i] }, part);
            }
        }
    }

    /// What edges leave of a triangle with corners that count as nearer to them than they are: in it their
    /// distances are linear.
    #[cold]
    fn cut_softly(&self, sector: usize, cuts: [u8; 2], part: &mut Polygon) {
        let (corners, near) = (self.around(self.cut, sector), &self.edges[1 - self.cut].near);
        let (mut weights, mut room) = (Polygon::<3>::default(), Polygon::default());
        weights.set(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        for (cuts, sign) in [(cuts[0], 1.0), (cuts[1], -1.0)] {
            bits(cuts, |k| {
                let sides = corners.map(|corner| sign * self.sides[corner].0[k]);
                let softened = sides.map(|side| soft(side, near.0[k]));
                // A needle on an edge is divided as it is.
                let by = if softened == [0.0; 3] { sides } else { softened };
                weights.cut(|at| by[0] * at[0] + by[1] * at[1] + by[2] * at[2], &mut room);
                std::mem::swap(&mut weights, &mut room);
            });
        }
        let [a, b, c] = self.triangle(self.cut, sector);
        let place = |at: &Vector| [0, 1].map(|d| at[0] * a[d] + at[1] * b[d] + at[2] * c[d]);
        part.set_each(weights.corners().iter().map(place));
    }

    /// Edges of a facet among `edges` (as bits) at which a part of one of its triangles ends, as bits.
    pub(super) fn ends(&self, k: usize, sector: usize, edges: u8, polygon: &Polygon) -> u8 {
        let is_triangle = self.corners[k] == 3;
        let edges = edges & if is_triangle { 0b111 } else { 1 << sector };
        if edges == 0 {
            return 0;
        }
        let [first, second] = self.sector(k, sector).shares;
        let mut found = 0;
        bits(edges, |edge| {
            // That of the corner across: of four nodes the middle.
            let is_there = |[x, y]: &Point| {
                let [a, b] = [first, second].map(|[c0, c1, c2]| c0 + c1 * x + c2 * y);
                let share = match edge {
                    1 if is_triangle => a,
                    2 if is_triangle => b,
                    _ => 1.0 - a - b,
                };
                share.abs() < ON_EDGE
            };
            found |= u8::from(polygon.corners().iter().filter(|corner| is_there(corner)).count() > 1) << edge;
        });
        found
    }

    /// Shares of a facet's corners, where those of the corners and the middle are given.
    pub(super) fn spread(&self, k: usize, of: &[f64; 5]) -> [f64; 4] {
        let more = if self.corners[k] == 3 { 0.0 } else { 0.25 * of[MIDDLE] };
        let mut shares = [0.0; 4];
        (0..self.corners[k]).for_each(|i| shares[i] = of[i] + more);
        shares
    }
}

/// What counts for the distance to an edge (or an area that goes with it), where what is `near` counts as
/// none.
fn soft(distance: f64, near: f64) -> f64 {
    let away = distance.abs();
    if away >= 2.0 * near {
        distance
    } else if away > near {
        (2.0 * (away - near)).copysign(distance)
    } else {
        0.0
    }
}

/// Whether an edge of a facet, `own`, has it on one side and another one on the other, or not more of both in
/// common than a strip of this width (m): that edge which has the most of the other one's middle beyond it.
/// All as seen along the normal of the common plane, on which no axes are needed.
pub(super) fn are_beside(facets: &Facets<'_>, own: usize, normal: Vector, width: f64) -> bool {
    let (frame, other) = (facets.frames[own], facets.frames[1 - own]);
    let (mut lowest, mut edge) = (0.0, 4);
    for (k, ([x, y, z], from)) in frame.inwards.into_iter().enumerate() {
        let side = x * other.middle[0] + y * other.middle[1] + z * other.middle[2] - from;
        (lowest, edge) = if side < lowest { (side, k) } else { (lowest, edge) };
    }
    if edge == 4 {
        return false;
    }
    let (from, to) = (frame.corners[edge], frame.corners[if edge + 1 == frame.nodes().len() { 0 } else { (edge + 1) % 4 }]);
    let along = if own == 0 { minus(from, to) } else { minus(to, from) };
    let across = cross(normal, along);
    let square = dot(across, across);
    let near = if own == facets.cut { 0.0 } else { near(facets.borders[own].soft[edge], square, other) };
    let side = |corner: Vector| dot(across, minus(corner, from));
    let middle = side(other.middle);
    if !(middle < -near) {
        return false;
    }
    let (mut least, mut most) = (0.0, f64::NEG_INFINITY);
    // A triangle has its last corner twice.
    other.corners.into_iter().for_each(|corner| most = higher(most, side(corner)));
    // Its own corners are on the edge, or beyond.
    if most > near && most * most > width * width * square {
        return false;
    }
    frame.corners.into_iter().for_each(|corner| least = lower(least, side(corner)));
    let (over, strip) = (most - least, width * width * square);
    over <= 0.0 || over * over <= strip || most <= near && least * least <= strip
}

/// What is nearer to an edge is on it (twice the area of the triangle with it, m²), with the square of its
/// length, m², and the facet that the corners are of.
fn near(soft: f64, square: f64, other: &Frame) -> f64 {
    soft * lower(square, other.radius * other.radius)
}

/// Lays facets into their common plane.
struct Lay<'a, 'b> {
    fans: &'a mut Fans,
    facets: &'a Facets<'b>,
    origin: Vector,
    axes: [Vector; 3],
    width: f64,
}

impl Kernel for Lay<'_, '_> {
    type Output = bool;

    #[inline(always)]
    fn run<L: Lane>(self) -> bool {
        let Self { fans, facets, origin, axes, width } = self;
        fans.corners = facets.frames.map(|frame| frame.nodes().len());
        fans.cut = facets.cut;
        fans.set_places::<L>(facets.frames, origin, axes);
        let next = fans.next();
        fans.set_edges::<L>(&next, facets);
        let strip = width * width;
        if fans.look::<L>(0, strip) || fans.look::<L>(1, strip) {
            return false;
        }
        fans.set_sectors::<L>(&next);
        true
    }
}

impl Fans {
    #[inline(always)]
    fn set_places<L: Lane>(&mut self, frames: [&Frame; 2], origin: Vector, axes: [Vector; 3]) {
        let mut corners = [Batch::default(); 3];
        for d in 0..3 {
            corners[d].0[..4].copy_from_slice(&frames[0].by_axis[d]);
            corners[d].0[4..].copy_from_slice(&frames[1].by_axis[d]);
        }
        for at in (0..BATCH).step_by(L::WIDTH) {
            let x = L::load(&corners[0], at) - L::splat(origin[0]);
            let y = L::load(&corners[1], at) - L::splat(origin[1]);
            let z = L::load(&corners[2], at) - L::splat(origin[2]);
            for d in 0..3 {
                let along = L::splat(axes[d][0]) * x + L::splat(axes[d][1]) * y + L::splat(axes[d][2]) * z;
                along.store(&mut self.places[d], at);
            }
        }
        self.middles = frames.map(|frame| axes.map(|axis| dot(axis, minus(frame.middle, origin))));
    }

    /// The next corner of each, and its height.
    #[inline(always)]
    fn next(&self) -> [Batch; 3] {
        let mut next = [Batch::default(); 3];
        for (Batch(next), Batch(of)) in next.iter_mut().zip(&self.places) {
            *next = [of[1], of[2], of[3], of[0], of[5], of[6], of[7], of[4]];
            if self.corners[0] == 3 {
                next[2] = of[0];
            }
            if self.corners[1] == 3 {
                next[6] = of[4];
            }
        }
        next
    }

    #[inline(always)]
    fn set_edges<L: Lane>(&mut self, next: &[Batch; 3], facets: &Facets<'_>) {
        let size = lower(facets.frames[0].radius, facets.frames[1].radius);
        let rounding = TOUCHES * size * size;
        for k in 0..2 {
            let (edges, middle, sign) = (&mut self.edges[k], self.middles[k], if k == 0 { -1.0 } else { 1.0 });
            for d in 0..2 {
                let (Batch(from), Batch(to), middle) = (&self.places[d], &next[d], middle[d]);
                let [a, b, c, e] = [from[4 * k], from[4 * k + 1], from[4 * k + 2], from[4 * k + 3]];
                let [p, q, r, s] = [to[4 * k], to[4 * k + 1], to[4 * k + 2], to[4 * k + 3]];
                edges.from[d] = Batch([a, b, c, e, middle, middle, middle, middle]);
                let along = [sign * (p - a), sign * (q - b), sign * (r - c), sign * (s - e)];
                edges.along[d] = Batch([along[0], along[1], along[2], along[3], a - middle, b - middle, c - middle, e - middle]);
            }
            edges.near = Batch([rounding; BATCH]);
            if k == facets.cut {
                continue;
            }
            let Borders { soft: [a, b, c, d], inner, .. } = facets.borders[k];
            let (by, most) = (Batch([a, b, c, d, inner, inner, inner, inner]), facets.frames[1 - k].radius);
            for at in (0..BATCH).step_by(L::WIDTH) {
                let (dx, dy) = (L::load(&edges.along[0], at), L::load(&edges.along[1], at));
                let near = L::load(&by, at) * (dx * dx + dy * dy).min(L::splat(most * most));
                near.max(L::splat(rounding)).store(&mut edges.near, at);
            }
        }
    }

    /// Finds where the other facet lies with respect to the edges of one; whether an edge keeps both apart,
    /// or leaves them no more than a strip of this width squared, m².
    #[inline(always)]
    fn look<L: Lane>(&mut self, k: usize, strip: f64) -> bool {
        let (other, edges) = (1 - k, &self.edges[k]);
        let mut places = [0; 5];
        let mut apart = 0;
        for at in (0..BATCH).step_by(L::WIDTH) {
            let from = [L::load(&edges.from[0], at), L::load(&edges.from[1], at)];
            let along = [L::load(&edges.along[0], at), L::load(&edges.along[1], at)];
            let near = L::load(&edges.near, at);
            let (mut most, mut middle) = (L::splat(f64::NEG_INFINITY), L::splat(0.0));
            for i in 0..5 {
                let [x, y] =
                    if i == MIDDLE { [self.middles[other][0], self.middles[other][1]] } else { corner(&self.places, 4 * other + i) };
                let side = side_of(from, along, x, y);
                let lies: &mut Places = &mut places[i];
                *lies |= L::bits(near.less(side)) << at | L::bits(side.less(-near)) << (8 + at);
                if i == MIDDLE {
                    middle = side;
                } else {
                    most = side.max(most);
                }
                if other == self.cut {
                    *lies |= L::bits(side.abs().less(near + near)) << (16 + at);
                    side.store(&mut self.sides[i], at);
                }
            }
            if at < 4 {
                let mut least = L::splat(0.0);
                for i in 0..4 {
                    let [x, y] = corner(&self.places, 4 * k + i);
                    least = side_of(from, along, x, y).min(least);
                }
                let (over, width) = (most - least, L::splat(strip) * (along[0] * along[0] + along[1] * along[1]));
                let meets = L::bits(L::splat(0.0).less(over)) & L::bits(width.less(over * over));
                let reaches = L::bits(near.less(most)) | L::bits(width.less(least * least));
                apart |= (L::bits(middle.less(-near)) & !(meets & reaches)) << at;
            }
        }
        for sector in 0..4 {
            let [a, b, c] = self.labels(other, sector);
            self.lies[other][sector] = Lies::new(places[a] | places[b] | places[c]);
        }
        apart & ((1 << self.corners[k]) - 1) != 0
    }

    #[inline(always)]
    fn set_sectors<L: Lane>(&mut self, next: &[Batch; 3]) {
        let mut third = [Batch::default(); 3];
        for d in 0..3 {
            let [a, b] = [self.middles[0][d], self.middles[1][d]];
            third[d] = Batch([a, a, a, a, b, b, b, b]);
            for k in 0..2 {
                if self.corners[k] == 3 {
                    third[d].0[4 * k] = self.places[d].0[4 * k + 2];
                }
            }
        }
        let mut flat = 0;
        let turned = Batch([-1.0, -1.0, -1.0, -1.0, 1.0, 1.0, 1.0, 1.0]);
        for at in (0..BATCH).step_by(L::WIDTH) {
            let a = [L::load(&self.places[0], at), L::load(&self.places[1], at)];
            let b = [L::load(&next[0], at), L::load(&next[1], at)];
            let c = [L::load(&third[0], at), L::load(&third[1], at)];
            let twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            let longest = square(a, b).max(square(b, c)).max(square(c, a));
            flat |= L::bits((L::splat(FLAT) * longest).less(L::load(&turned, at) * twice)) << at;
            let (first, second) = (share(b, c, twice), share(c, a, twice));
            let (az, bz, cz) = (L::load(&self.places[2], at), L::load(&next[2], at), L::load(&third[2], at));
            for i in 0..3 {
                let third = L::splat(if i == 0 { 1.0 } else { 0.0 }) - first[i] - second[i];
                first[i].store(&mut self.shares[0][i], at);
                second[i].store(&mut self.shares[1][i], at);
                (az * first[i] + bz * second[i] + cz * third).store(&mut self.height[i], at);
            }
        }
        let all = [0, 1].map(|k| if self.corners[k] == 3 { 1 } else { 0xf });
        self.sectors = flat as u8 & (all[0] | all[1] << 4);
    }
}

#[inline(always)]
fn corner(places: &[Batch; 3], at: usize) -> Point {
    [places[0].0[at], places[1].0[at]]
}

/// On which side of edges a place is: positive on their left, m².
#[inline(always)]
fn side_of<L: Lane>(from: [L; 2], along: [L; 2], x: f64, y: f64) -> L {
    along[0] * (L::splat(y) - from[1]) - along[1] * (L::splat(x) - from[0])
}

#[inline(always)]
fn square<L: Lane>(p: [L; 2], q: [L; 2]) -> L {
    (q[0] - p[0]) * (q[0] - p[0]) + (q[1] - p[1]) * (q[1] - p[1])
}

/// Linear functions that are zero on the edge between two places of triangles, and one at their third corner.
#[inline(always)]
fn share<L: Lane>(p: [L; 2], q: [L; 2], twice: L) -> [L; 3] {
    let (gx, gy) = ((p[1] - q[1]) / twice, (q[0] - p[0]) / twice);
    [-(gx * p[0] + gy * p[1]), gx, gy]
}

/// Does something with the numbers of the bits that are set.
#[inline]
fn bits(mut of: u8, mut with: impl FnMut(usize)) {
    while of != 0 {
        with(of.trailing_zeros() as usize);
        of &= of - 1;
    }
}

/// The lower of two numbers: one instruction.
fn lower(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

fn higher(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

#[cfg(test)]
mod tests;
