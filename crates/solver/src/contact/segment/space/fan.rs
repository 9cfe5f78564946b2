//! Facets in the common plane of a pair: whether they are apart there, and which of the triangles about their
//! middles have something in common.
//!
//! Facets come from [`super::common`], which integrates over what is found. Convex facets that have nothing
//! in common are apart along an edge of one of them. On which side of each edge of the other facet corners
//! and middle are is found once, eight edges at a time; from that follows which pairs of triangles are apart,
//! which triangle is within another, and which edges cut it.

use super::common::Frame;
use super::polygon::{Edge, Linear, Moments, Point, Polygon, shares};
use crate::tensor::dot;
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

/// A facet in the common plane.
pub(super) struct Flat {
    /// Corners and the middle, m; from behind they run clockwise.
    places: [Point; 5],
    /// Their heights above the plane, m.
    heights: [f64; 5],
    /// Number of its corners.
    corners: usize,
    is_turned: bool,
}

impl Flat {
    /// `is_turned`: it is seen from behind.
    pub(super) fn new(frame: &Frame, origin: Vector, [first, second, normal]: [Vector; 3], is_turned: bool) -> Self {
        let (mut places, mut heights) = ([[0.0; 2]; 5], [0.0; 5]);
        let mut set = |k: usize, x: Vector| {
            let off = minus(x, origin);
            (places[k], heights[k]) = ([dot(off, first), dot(off, second)], dot(off, normal));
        };
        (0..4).for_each(|k| set(k, frame.corners[k]));
        set(MIDDLE, frame.middle);
        Self { places, heights, corners: frame.nodes().len(), is_turned }
    }

    /// From corner k to the next one, the facet on the left.
    fn edge(&self, k: usize) -> Edge {
        let next = if k + 1 == self.corners { 0 } else { k + 1 };
        let edge = Edge::new(self.places[k], self.places[next]);
        if self.is_turned { edge.reversed() } else { edge }
    }

    /// Whether one of its edges has it on one side and another facet on the other one, or not more of both in
    /// common than a strip of this width, m.
    pub(super) fn is_apart(&self, other: &Self, width: f64) -> bool {
        (0..self.corners).any(|k| {
            let edge = self.edge(k);
            if edge.side(other.places[MIDDLE]) >= 0.0 {
                return false;
            }
            let (mut own, mut others) = (0.0, f64::NEG_INFINITY);
            self.places[..self.corners].iter().for_each(|&corner| own = lower(own, edge.side(corner)));
            other.places[..other.corners].iter().for_each(|&corner| others = higher(others, edge.side(corner)));
            let over = others - own;
            over <= 0.0 || over * over <= width * width * edge.square()
        })
    }
}

/// A triangle of a fan.
#[derive(Clone, Copy, Default)]
pub(super) struct Sector {
    /// Its corners among those of the facet and its middle.
    pub(super) labels: [usize; 3],
    /// Linear functions that are one at a corner and zero at the others.
    pub(super) shares: [Linear; 3],
    /// Its height above the plane, m.
    pub(super) height: Linear,
    /// Edges of the fan that bound it, as bits: those that have it on their left and on their right.
    left: u8,
    right: u8,
}

/// Edges of another fan, as bits, that have a place on their left and on their right by more than rounding;
/// or any corner of a triangle.
#[derive(Clone, Copy, Default)]
struct Lies {
    left: u8,
    right: u8,
}

impl Lies {
    /// Whether an edge of a triangle has all of this one on its outer side.
    fn is_outside(self, of: &Sector) -> bool {
        of.left & !self.left | of.right & !self.right != 0
    }

    /// Edges of a triangle that divide this one: those with the triangle on their left, and on their right.
    fn cut_by(self, of: &Sector) -> [u8; 2] {
        [of.left & self.right, of.right & self.left]
    }
}

/// A facet as triangles about its middle, or as the one that it is.
pub(super) struct Fan {
    pub(super) heights: [f64; 5],
    /// Number of its corners.
    pub(super) corners: usize,
    places: [Point; 5],
    /// Those of the facet, with it on their left, and of four those from its middle to its corners: by
    /// coordinates, since all are asked at once.
    from: [Batch; 2],
    along: [Batch; 2],
    sectors: [Sector; 4],
    count: usize,
}

impl Fan {
    pub(super) fn new(flat: &Flat) -> Self {
        let Flat { places, heights, corners, is_turned } = *flat;
        let (from, along) = ([Batch::default(); 2], [Batch::default(); 2]);
        let mut fan = Self { heights, corners, places, from, along, sectors: [Sector::default(); 4], count: 0 };
        (0..corners).for_each(|k| fan.set_edge(k, flat.edge(k)));
        if corners == 3 {
            fan.add(if is_turned { [1, 0, 2] } else { [0, 1, 2] }, 0b111, 0);
            return fan;
        }
        for k in 0..4 {
            fan.set_edge(4 + k, Edge::new(places[MIDDLE], places[k]));
            let next = (k + 1) % 4;
            let [a, b] = if is_turned { [next, k] } else { [k, next] };
            fan.add([a, b, MIDDLE], 1 << k | 0x10 << a, 0x10 << b);
        }
        fan
    }

    fn set_edge(&mut self, k: usize, edge: Edge) {
        for d in 0..2 {
            (self.from[d].0[k], self.along[d].0[k]) = (edge.from[d], edge.along[d]);
        }
    }

    fn edge(&self, k: usize) -> Edge {
        Edge { from: [0, 1].map(|d| self.from[d].0[k]), along: [0, 1].map(|d| self.along[d].0[k]) }
    }

    #[inline]
    fn add(&mut self, labels: [usize; 3], left: u8, right: u8) {
        let sector = &mut self.sectors[self.count];
        let Some(shares) = shares(labels.map(|k| self.places[k])) else { return };
        let [a, b, c] = labels.map(|k| self.heights[k]);
        sector.height = [0, 1, 2].map(|i| a * shares[0][i] + b * shares[1][i] + c * shares[2][i]);
        (sector.labels, sector.shares, sector.left, sector.right) = (labels, shares, left, right);
        self.count += 1;
    }

    pub(super) fn sectors(&self) -> &[Sector] {
        &self.sectors[..self.count]
    }

    fn triangle(&self, sector: &Sector) -> [Point; 3] {
        sector.labels.map(|k| self.places[k])
    }

    /// What its triangles have together.
    pub(super) fn moments(&self) -> Moments {
        let [a, b, c, d, _] = self.places;
        if self.count == 4 {
            let is_turned = self.sectors[0].labels[0] != 0;
            return Moments::around(&if is_turned { [d, c, b, a] } else { [a, b, c, d] });
        }
        let mut sum = Moments::default();
        self.sectors().iter().for_each(|sector| sum.add(&Moments::around(&self.triangle(sector))));
        sum
    }

    /// Hands on what triangles have in common with those of another one, with their numbers; `size`: of the
    /// smaller facet, m.
    pub(super) fn meet(&self, other: &Self, size: f64, level: Level, mut found: impl FnMut([usize; 2], &Polygon)) {
        let [own, others] = level.run(Ask { fans: [self, other], near: TOUCHES * size * size });
        let (mut part, mut room) = (Polygon::default(), Polygon::default());
        for (i, one) in self.sectors().iter().enumerate() {
            for (j, another) in other.sectors().iter().enumerate() {
                if own[i].is_outside(another) || others[j].is_outside(one) {
                    continue;
                }
                let cuts = own[i].cut_by(another);
                if cuts != [0; 2] && others[j].cut_by(one) == [0; 2] {
                    part.set(&other.triangle(another));
                } else {
                    part.set(&self.triangle(one));
                    bits(cuts[0]).for_each(|k| part.cut(other.edge(k), &mut room));
                    bits(cuts[1]).for_each(|k| part.cut(other.edge(k).reversed(), &mut room));
                }
                found([i, j], &part);
            }
        }
    }

    /// Edges of the facet at which a part of one of its triangles ends, as bits.
    pub(super) fn ends(&self, polygon: &Polygon, sector: &Sector) -> u8 {
        let mut edges = 0;
        for k in 0..3 {
            let [from, to] = [sector.labels[(k + 1) % 3], sector.labels[(k + 2) % 3]];
            // Edges to the middle are within.
            if from == MIDDLE || to == MIDDLE {
                continue;
            }
            let [c0, c1, c2] = sector.shares[k];
            let is_there = |[x, y]: &[f64; 2]| (c0 + c1 * x + c2 * y).abs() < ON_EDGE;
            if polygon.corners().iter().filter(|corner| is_there(corner)).count() > 1 {
                edges |= 1 << if (from + 1) % self.corners == to { from } else { to };
            }
        }
        edges
    }

    /// Shares of the corners, where those of the corners and the middle are given.
    pub(super) fn spread(&self, of: &[f64; 5]) -> [f64; 4] {
        let more = if self.corners == 3 { 0.0 } else { 0.25 * of[MIDDLE] };
        let mut shares = [0.0; 4];
        (0..self.corners).for_each(|k| shares[k] = of[k] + more);
        shares
    }
}

/// Asks where the triangles of two fans lie with respect to the edges of the other one; what is nearer to an
/// edge (twice the area of the triangle with it, m²) is on it.
struct Ask<'a> {
    fans: [&'a Fan; 2],
    near: f64,
}

impl Kernel for Ask<'_> {
    type Output = [[Lies; 4]; 2];

    #[inline(always)]
    fn run<L: Lane>(self) -> Self::Output {
        let Self { fans: [one, other], near } = self;
        [lies::<L>(one, other, near), lies::<L>(other, one, near)]
    }
}

#[inline(always)]
fn lies<L: Lane>(of: &Fan, other: &Fan, near: f64) -> [Lies; 4] {
    let mut places = [Lies::default(); 5];
    for at in (0..BATCH).step_by(L::WIDTH) {
        let (from, along) = (&other.from, &other.along);
        let (x0, y0, dx, dy) = (L::load(&from[0], at), L::load(&from[1], at), L::load(&along[0], at), L::load(&along[1], at));
        for (lies, [x, y]) in places.iter_mut().zip(of.places) {
            let side = dx * (L::splat(y) - y0) - dy * (L::splat(x) - x0);
            lies.left |= (L::bits(L::splat(near).less(side)) << at) as u8;
            lies.right |= (L::bits(side.less(L::splat(-near))) << at) as u8;
        }
    }
    let mut lies = [Lies::default(); 4];
    for (lies, sector) in lies.iter_mut().zip(of.sectors()) {
        let [a, b, c] = sector.labels;
        let (a, b, c) = (places[a], places[b], places[c]);
        *lies = Lies { left: a.left | b.left | c.left, right: a.right | b.right | c.right };
    }
    lies
}

/// Numbers of the bits that are set.
fn bits(of: u8) -> impl Iterator<Item = usize> {
    (0..8).filter(move |k| of >> k & 1 != 0)
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
