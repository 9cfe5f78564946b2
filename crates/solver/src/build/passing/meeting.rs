//! When bodies that move straight on meet: the middles of the pieces of each surface that look ahead against
//! the pieces of the other that look back. Middles, so that what slides past flush is no meeting.

use crate::contact::obstacle::space::Solid;
use crate::tensor::cross;
use crate::vector::{any_tangent, dot, length, minus, plus, times, unit};
use std::collections::BTreeMap;

type Vector = [f64; 3];

/// How far beside a piece still counts, as a share of it, and how far behind the start of a way, as a share
/// of the way and of the piece.
const BESIDE: f64 = 1e-9;
/// Bins along the side of a piece, at most.
const BINS_MOST: f64 = 64.0;
/// Distance from an obstacle that is none, as a share of the way.
const NEAR: f64 = 1e-6;
/// Points at which a way looks for an obstacle, at most.
const LOOKS: usize = 200;

/// A box along the axes, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Box3([Vector; 2]);

impl Box3 {
    /// Of no point.
    pub(super) const EMPTY: Self = Self([[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]]);

    pub(super) fn add(&mut self, x: Vector) {
        for d in 0..3 {
            self.0[0][d] = self.0[0][d].min(x[d]);
            self.0[1][d] = self.0[1][d].max(x[d]);
        }
    }

    /// Whether it touches another one on this way.
    pub(super) fn sweeps(&self, way: Vector, other: &Self) -> bool {
        let ([low, high], [other_low, other_high]) = (self.0, other.0);
        let (mut from, mut to) = (0.0f64, 1.0f64);
        for d in 0..3 {
            let [near, far] = [other_low[d] - high[d], other_high[d] - low[d]];
            if way[d] == 0.0 {
                if near > 0.0 || far < 0.0 {
                    return false;
                }
                continue;
            }
            let [a, b] = [near / way[d], far / way[d]];
            (from, to) = (from.max(a.min(b)), to.min(a.max(b)));
        }
        from <= to
    }
}

/// A triangle of a surface, counter-clockwise seen from outside; of a segment in 2D a strip along z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    corners: [Vector; 3],
    /// Its middle.
    middle: Vector,
    /// Corners that are ends of a segment, or of the triangle.
    count: usize,
}

impl Piece {
    /// Of a segment with the body on its right, a triangle, or a quadrilateral.
    pub(super) fn of(corners: &[Vector]) -> Vec<Self> {
        let triangle = |corners: [Vector; 3]| {
            let sum = corners.iter().fold([0.0; 3], |sum, x| plus(sum, *x));
            Self { corners, middle: times(1.0 / 3.0, sum), count: 3 }
        };
        match *corners {
            [a, b] => {
                // So long that no point on the segment is beside it.
                let along = [0.0, 0.0, -length(minus(b, a))];
                vec![Self { corners: [a, b, plus(a, along)], middle: times(0.5, plus(a, b)), count: 2 }]
            }
            [a, b, c] => vec![triangle([a, b, c])],
            [a, b, c, d] => vec![triangle([a, b, c]), triangle([a, c, d])],
            _ => Vec::new(),
        }
    }

    fn normal(&self) -> Vector {
        let [a, b, c] = self.corners;
        cross(minus(b, a), minus(c, a))
    }

    /// Share of a way from a point at which the way goes in through it.
    fn enters(&self, from: Vector, way: Vector) -> Option<f64> {
        let [a, b, c] = self.corners;
        let (normal, along) = (self.normal(), dot(self.normal(), way));
        if along >= 0.0 {
            return None;
        }
        let share = dot(normal, minus(a, from)) / along;
        let at = minus(plus(from, times(share, way)), a);
        let whole = dot(normal, normal);
        let v = dot(normal, cross(minus(b, a), at)) / whole;
        let u = dot(normal, cross(at, minus(c, a))) / whole;
        let size = whole.sqrt().sqrt();
        let early = -BESIDE * (1.0 + size / length(way));
        let inside = u >= -BESIDE && v >= -BESIDE && u + v <= 1.0 + BESIDE;
        (inside && (early..=1.0).contains(&share)).then_some(share)
    }
}

/// Share of a way at which one body that moves along it meets another one; `None`: it does not.
pub(super) fn share(one: &[Piece], other: &[Piece], way: Vector) -> Option<f64> {
    let back = way.map(|x| -x);
    let shares = [into(one, other, way), into(other, one, back)];
    shares.into_iter().flatten().reduce(f64::min)
}

/// Of the middles of what looks ahead.
fn into(movers: &[Piece], targets: &[Piece], way: Vector) -> Option<f64> {
    let shadow = Shadow::new(targets, way)?;
    let ahead = movers.iter().filter(|piece| dot(piece.normal(), way) > 0.0);
    ahead.filter_map(|piece| shadow.enters(piece.middle)).reduce(f64::min)
}

/// Pieces that look back, by where they are across a way.
struct Shadow<'a> {
    targets: &'a [Piece],
    way: Vector,
    across: [Vector; 2],
    /// Side of a bin, m.
    side: f64,
    bins: BTreeMap<[i64; 2], Vec<u32>>,
}

impl<'a> Shadow<'a> {
    fn new(targets: &'a [Piece], way: Vector) -> Option<Self> {
        let along = unit(way)?;
        let u = any_tangent(along);
        let across = [u, cross(along, u)];
        let seen = |x: Vector| across.map(|axis| dot(axis, x));
        let looks_back = |piece: &&Piece| dot(piece.normal(), way) < 0.0;
        let range = |piece: &Piece| {
            let all = piece.corners[..piece.count].iter().map(|x| seen(*x));
            all.fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], x| {
                [[low[0].min(x[0]), low[1].min(x[1])], [high[0].max(x[0]), high[1].max(x[1])]]
            })
        };
        let sizes: Vec<f64> =
            targets.iter().filter(looks_back).map(range).map(|[low, high]| (high[0] - low[0]).max(high[1] - low[1])).collect();
        let mean = sizes.iter().sum::<f64>() / sizes.len().max(1) as f64;
        let side = mean.max(sizes.iter().copied().fold(0.0, f64::max) / BINS_MOST);
        if !(side > 0.0 && side.is_finite()) {
            return None;
        }
        let mut bins: BTreeMap<[i64; 2], Vec<u32>> = BTreeMap::new();
        for (number, piece) in targets.iter().enumerate().filter(|(_, piece)| looks_back(piece)) {
            let [low, high] = range(piece).map(|x| x.map(|x| x / side));
            let slack = 1e-6;
            for i in (low[0] - slack).floor() as i64..=(high[0] + slack).floor() as i64 {
                for j in (low[1] - slack).floor() as i64..=(high[1] + slack).floor() as i64 {
                    bins.entry([i, j]).or_default().push(number as u32);
                }
            }
        }
        Some(Self { targets, way, across, side, bins })
    }

    /// Share of the way from a point at which it enters one of the pieces.
    fn enters(&self, from: Vector) -> Option<f64> {
        let bin = self.across.map(|axis| (dot(axis, from) / self.side).floor() as i64);
        let near = self.bins.get(&bin)?.iter();
        near.filter_map(|&number| self.targets[number as usize].enters(from, self.way)).reduce(f64::min)
    }
}

/// Share of a way at which a body enters an obstacle; `None`: it does not, or begins in it.
pub(super) fn share_of_obstacle(solid: &Solid, body: &[Piece], way: Vector) -> Option<f64> {
    let begins_in = |piece: &Piece| solid.distance(piece.middle).0 < -NEAR * length(way);
    if body.iter().any(begins_in) {
        return None;
    }
    body.iter().filter_map(|piece| share_at(solid, piece, way)).reduce(f64::min)
}

/// Of the middle of a piece.
fn share_at(solid: &Solid, piece: &Piece, way: Vector) -> Option<f64> {
    let whole = length(way);
    let mut done = 0.0;
    for _ in 0..LOOKS {
        let (distance, normal) = solid.distance(plus(piece.middle, times(done / whole, way)));
        let is_near = distance <= NEAR * whole;
        if is_near && dot(normal, way) < 0.0 && done <= whole {
            return Some(done / whole);
        }
        // No surface is nearer than the distance.
        done += distance.max(NEAR * whole);
        if done > whole {
            return None;
        }
    }
    None
}
