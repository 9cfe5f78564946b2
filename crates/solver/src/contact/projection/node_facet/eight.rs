//! What of eight facets is nearest to eight points, at once: the numbers of [`Placed::nearest`] and of
//! [`Placed::normal`], to the last bit.
//!
//! Pairs come from the tracker of the nodes, results go back to it. A facet of four nodes has four triangles;
//! the two at the corner that is nearest to the point are measured. That the other two are farther is shown
//! by a plane at right angles to the diagonal, in front of which they lie: where it does not show that, or a
//! facet has three nodes, the pair is not measured here. Beside, where a node and all four triangles keep
//! their sides in the step, by far, the node goes through none of them.

use super::{Feature, Found, Nearest, Placed, Projection, SAME_SQUARE, TIE, Vector};
use crate::contact::Sweep;
use crate::contact::projection::swept::ROUNDING;
use crate::tensor::{cross, dot};
use crate::vector::minus;
use embate_lanes::{BATCH, Batch, Kernel, Lane, Level};

/// The other two triangles are farther than the nearest by at least this fraction, and farther from the plane
/// than this fraction of the facet's size: rounding, and the rule of what is equally near, are far below.
const FARTHER: f64 = 1e-5;
const CLEAR: f64 = 1e-6;
/// A node goes through no triangle that is farther than this fraction of the facet's size beside what both
/// have gone: a place a little beyond a triangle's rim counts as on it.
pub(in crate::contact) const RIM: f64 = 1e-3;
/// Squares of lengths above this (m²) are not measured: products of four lengths have to be numbers.
const LARGEST: f64 = 1e140;

type Point = [Batch; 3];

/// Eight points and facets.
#[derive(Clone, Debug)]
pub(in crate::contact) struct Pairs {
    x: Point,
    corners: [Point; 4],
    /// Before the step.
    x_old: Point,
    corners_old: [Point; 4],
    /// Where the points came in; zero: they did not.
    side: Point,
    count: usize,
    /// Bit i: whether the i-th point may go through the facet, which is asked.
    may_pass: u32,
}

/// What is nearest in eight pairs.
#[derive(Clone, Debug)]
pub(in crate::contact) struct Measured {
    square: Batch,
    weights: [Batch; 3],
    foot: [Batch; 3],
    triangle: Batch,
    normal: [Batch; 3],
    height: Batch,
    size: Batch,
    /// Bit i: the i-th pair is measured; its facet looks to the side where the point came in, for sure.
    is_known: u32,
    looks: u32,
    /// Bit i of the k-th: the i-th point goes through triangle k in no case.
    stays: [u32; 4],
}

/// The plane of the triangle that is nearest, and the facet's size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::contact) struct Plane {
    pub(in crate::contact) normal: Vector,
    /// Height of the point above it, m.
    pub(in crate::contact) height: f64,
    /// As [`Placed::size`], m.
    pub(in crate::contact) size: f64,
}

impl Pairs {
    /// Room.
    pub(in crate::contact) const NONE: Self = {
        let point = [Batch::splat(0.0); 3];
        Self { x: point, corners: [point; 4], x_old: point, corners_old: [point; 4], side: point, count: 0, may_pass: 0 }
    };

    pub(in crate::contact) fn clear(&mut self) {
        (self.count, self.may_pass) = (0, 0);
    }

    pub(in crate::contact) fn is_full(&self) -> bool {
        self.count == BATCH
    }

    pub(in crate::contact) fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Adds a pair to less than eight, of a node that came in on a `side`; with what it may go through, if
    /// `passes`.
    #[inline]
    pub(in crate::contact) fn add(&mut self, node: u32, facet: &[u32; 4], sweep: Sweep<'_, 3>, (side, passes): (&Vector, bool)) {
        let lane = self.count % BATCH;
        set(&mut self.x, lane, &sweep.new[node as usize]);
        for (point, &corner) in self.corners.iter_mut().zip(facet) {
            set(point, lane, &sweep.new[corner as usize]);
        }
        set(&mut self.side, lane, side);
        if passes {
            self.may_pass |= 1 << lane;
            set(&mut self.x_old, lane, &sweep.old[node as usize]);
            for (point, &corner) in self.corners_old.iter_mut().zip(facet) {
                set(point, lane, &sweep.old[corner as usize]);
            }
        }
        self.count += 1;
    }

    /// Measures them.
    pub(in crate::contact) fn measure(&self, level: Level, measured: &mut Measured) {
        level.run(Work { pairs: self, measured });
    }
}

#[inline(always)]
fn set(point: &mut Point, lane: usize, x: &Vector) {
    for d in 0..3 {
        point[d].0[lane] = x[d];
    }
}

#[inline(always)]
fn load<L: Lane>(point: &Point, at: usize) -> [L; 3] {
    [L::load(&point[0], at), L::load(&point[1], at), L::load(&point[2], at)]
}

impl Measured {
    /// Room.
    pub(in crate::contact) const NONE: Self = {
        let (one, three) = (Batch::splat(0.0), [Batch::splat(0.0); 3]);
        Self {
            square: one,
            weights: three,
            foot: three,
            triangle: one,
            normal: three,
            height: one,
            size: one,
            is_known: 0,
            looks: 0,
            stays: [0; 4],
        }
    };

    /// Of a pair with this facet, if it is measured.
    #[inline]
    pub(in crate::contact) fn of(&self, lane: usize, facet: u32) -> Option<(Found, Plane)> {
        let lane = lane % BATCH;
        let three = |batches: &[Batch; 3]| [batches[0].0[lane], batches[1].0[lane], batches[2].0[lane]];
        let nearest = Nearest { square: self.square.0[lane], weights: three(&self.weights), foot: three(&self.foot) };
        let plane = Plane { normal: three(&self.normal), height: self.height.0[lane], size: self.size.0[lane] };
        (self.is_known >> lane & 1 == 1).then_some(((nearest, facet, self.triangle.0[lane] as usize), plane))
    }

    /// Whether a pair is measured.
    #[inline]
    pub(in crate::contact) fn is_known(&self, lane: usize) -> bool {
        self.is_known >> (lane % BATCH) & 1 == 1
    }

    /// The square of its distance, m².
    #[inline]
    pub(in crate::contact) fn square(&self, lane: usize) -> f64 {
        self.square.0[lane % BATCH]
    }

    /// The plane of its nearest triangle.
    #[inline]
    pub(in crate::contact) fn plane(&self, lane: usize) -> Plane {
        let lane = lane % BATCH;
        Plane { normal: self.normal.each_ref().map(|batch| batch.0[lane]), height: self.height.0[lane], size: self.size.0[lane] }
    }

    /// Whether the nearest point is on the face of its triangle.
    #[inline]
    pub(in crate::contact) fn is_on_face(&self, lane: usize) -> bool {
        let lane = lane % BATCH;
        self.weights[0].0[lane] > 0.0 && self.weights[1].0[lane] > 0.0 && self.weights[2].0[lane] > 0.0
    }

    /// Where the point of a pair that is on the face of `facet` lies, as [`Placed::seen`] says.
    #[inline]
    pub(in crate::contact) fn projection(&self, lane: usize, facet: u32, placed: &Placed<'_>) -> Projection {
        let lane = lane % BATCH;
        let three = |batches: &[Batch; 3]| [batches[0].0[lane], batches[1].0[lane], batches[2].0[lane]];
        let triangle = self.triangle.0[lane] as usize;
        let weights = placed.spread(facet, triangle, three(&self.weights));
        let (gap, normal) = (self.height.0[lane], three(&self.normal));
        Projection { facet, feature: Feature::Face, triangle, weights, foot: three(&self.foot), gap, normal }
    }

    /// Which of the facet's triangles the node of a pair goes through in no case in the step: a bit for each.
    #[inline]
    pub(in crate::contact) fn stays(&self, lane: usize) -> u32 {
        let lane = lane % BATCH;
        (0..4).fold(0, |bits, k| bits | (self.stays[k] >> lane & 1) << k)
    }

    /// Whether the facet looks to the side where the node came in, for sure.
    #[inline]
    pub(in crate::contact) fn looks(&self, lane: usize) -> bool {
        self.looks >> (lane % BATCH) & 1 == 1
    }
}

/// Whether one of two places on a surface that have been measured from the same point is nearer, by
/// [`Placed::is_nearer`]; `facets` are numbers in the order of theirs.
#[inline]
pub(in crate::contact) fn is_nearer((one, i): (&Measured, usize), (other, j): (&Measured, usize), facets: [u32; 2]) -> bool {
    let [a, b] = [one.square.0[i % BATCH], other.square.0[j % BATCH]];
    if (a - b).abs() <= SAME_SQUARE * a.max(b) {
        let apart = [0, 1, 2].map(|d| one.foot[d].0[i % BATCH] - other.foot[d].0[j % BATCH]);
        let least = TIE * one.size.0[i % BATCH];
        if dot(apart, apart) <= least * least {
            let heights = [one.height.0[i % BATCH].abs(), other.height.0[j % BATCH].abs()];
            if (heights[0] - heights[1]).abs() > TIE * heights[0].max(heights[1]) {
                return heights[0] > heights[1];
            }
        }
    }
    a < b || (a == b && facets[0] < facets[1])
}

/// What is measured, and room for the results.
struct Work<'a> {
    pairs: &'a Pairs,
    measured: &'a mut Measured,
}

impl Kernel for Work<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        let Self { pairs, measured } = self;
        (measured.is_known, measured.looks, measured.stays) = (0, 0, [0; 4]);
        for at in (0..pairs.count).step_by(L::WIDTH) {
            let squares = measure::<L>(pairs, at, measured);
            if pairs.may_pass != 0 {
                let stays = stays::<L>(pairs, at, squares);
                let all = (1 << L::WIDTH) - 1;
                for k in 0..4 {
                    measured.stays[k] |= (stays[k] & all) << at & pairs.may_pass;
                }
            }
        }
    }
}

/// Nearest point of a triangle.
struct Near<L> {
    square: L,
    weights: [L; 3],
    foot: [L; 3],
    normal: [L; 3],
    height: L,
}

/// The nearest point of the triangle a, b, c to x as [`super::nearest_of_triangle`] finds it, the triangle's
/// unit normal, and the height above its plane.
#[inline(always)]
fn nearest_of_triangle<L: Lane>(x: [L; 3], a: [L; 3], b: [L; 3], c: [L; 3]) -> Near<L> {
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    let (ab, ac, ax, bx, cx) = (minus(b, a), minus(c, a), minus(x, a), minus(x, b), minus(x, c));
    let (d1, d2, d3, d4, d5, d6) = (dot(ab, ax), dot(ac, ax), dot(ab, bx), dot(ac, bx), dot(ab, cx), dot(ac, cx));
    let (va, vb, vc) = (d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2);
    // The inside, then what takes precedence over it, the last first: none of a mask's numbers is above zero.
    let sum = va + vb + vc;
    let (v, w) = (vb / sum, vc / sum);
    let mut weights = [one - v - w, v, w];
    let w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    take(&mut weights, zero.less(va.max(d3 - d4).max(d6 - d5)), [zero, one - w, w]);
    let w = d2 / (d2 - d6);
    take(&mut weights, zero.less(vb.max(-d2).max(d6)), [one - w, zero, w]);
    take(&mut weights, zero.less((-d6).max(d5 - d6)), [zero, zero, one]);
    let v = d1 / (d1 - d3);
    take(&mut weights, zero.less(vc.max(-d1).max(d3)), [one - v, v, zero]);
    take(&mut weights, zero.less((-d3).max(d4 - d3)), [zero, one, zero]);
    take(&mut weights, zero.less(d1.max(d2)), [one, zero, zero]);
    let mut foot = [zero; 3];
    for d in 0..3 {
        foot[d] = weights[0] * a[d] + weights[1] * b[d] + weights[2] * c[d];
    }
    let (away, across) = (minus(x, foot), cross(ab, ac));
    let length = dot(across, across).sqrt();
    let mut normal = [zero; 3];
    for d in 0..3 {
        normal[d] = L::select(zero.less(length), across[d] / length, zero);
    }
    Near { square: dot(away, away), weights, foot, normal, height: dot(away, normal) }
}

/// Takes other weights where a mask is false.
#[inline(always)]
fn take<L: Lane>(weights: &mut [L; 3], keeps: L::Mask, others: [L; 3]) {
    for k in 0..3 {
        weights[k] = L::select(keeps, weights[k], others[k]);
    }
}

/// One of two by a mask.
#[inline(always)]
fn either<L: Lane>(mask: L::Mask, mut yes: [L; 3], no: [L; 3]) -> [L; 3] {
    for d in 0..3 {
        yes[d] = L::select(mask, yes[d], no[d]);
    }
    yes
}

/// Corners of eight facets: their positions, whether there are four of them, and the apex of the triangles:
/// the middle, of three the last.
struct Corners<L: Lane> {
    all: [[L; 3]; 4],
    is_quad: L::Mask,
    apex: [L; 3],
}

/// The corners before the step or after it, as they are after it: of three nodes the last two are the same.
#[inline(always)]
fn corners<L: Lane>(pairs: &Pairs, of: &[Point; 4], at: usize) -> Corners<L> {
    let is_quad = L::splat(0.0).less(different(load(&pairs.corners[2], at), load(&pairs.corners[3], at)));
    let all @ [a, b, c, d]: [[L; 3]; 4] = [load(&of[0], at), load(&of[1], at), load(&of[2], at), load(&of[3], at)];
    let mut middle = a;
    for k in 0..3 {
        middle[k] = L::splat(0.25) * (a[k] + b[k] + c[k] + d[k]);
    }
    Corners { all, is_quad, apex: either(is_quad, middle, d) }
}

/// The corners of facets from that on which is nearest to x, of three nodes from the first; its number, the
/// square of the distance of the farthest, and the sum of all four, m².
#[inline(always)]
fn from_nearest<L: Lane>(x: [L; 3], corners: &Corners<L>) -> ([[L; 3]; 4], [L; 3]) {
    let (mut turned, away) = (corners.all, minus(x, corners.all[0]));
    let square = dot(away, away);
    let (mut first, mut least, mut most, mut sum) = (L::splat(0.0), square, square, square);
    for k in 1..4 {
        let away = minus(x, corners.all[k]);
        let square = dot(away, away);
        let nearer = L::select(corners.is_quad, square, least).less(least);
        (least, most, sum) = (square.min(least), square.max(most), sum + square);
        first = L::select(nearer, L::splat(k as f64), first);
        for corner in 0..4 {
            turned[corner] = either(nearer, corners.all[(corner + k) % 4], turned[corner]);
        }
    }
    (turned, [first, most, sum])
}

/// Size of facets as [`Placed::size`] has it, and whether they look to a side for sure.
#[inline(always)]
fn size_and_look<L: Lane>(corners: &Corners<L>, side: [L; 3]) -> (L, u32) {
    let [a, b, c, d] = corners.all;
    let (ac, bd, ab, bc) = (minus(c, a), minus(d, b), minus(b, a), minus(c, b));
    let of_three = (dot(ab, ab) + dot(bc, bc) + dot(ac, ac)) * L::splat(2.0 / 3.0);
    let size = L::select(corners.is_quad, dot(ac, ac) + dot(bd, bd), of_three).sqrt();
    let along = dot(side, either(corners.is_quad, cross(ac, bd), cross(ab, ac)));
    (size, L::bits(L::splat(0.0).less(along)) & L::bits(along.less(L::splat(f64::INFINITY))))
}

/// Measures the pairs from `at` on; the squares of the least distances from the four triangles, m², and the
/// size of the facet, m.
#[inline(always)]
fn measure<L: Lane>(pairs: &Pairs, at: usize, out: &mut Measured) -> ([L; 4], L) {
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    let (x, corners): ([L; 3], Corners<L>) = (load(&pairs.x, at), corners(pairs, &pairs.corners, at));
    let (m, ([v, next, opposite, before], [first, most, sum])) = (corners.apex, from_nearest(x, &corners));
    let (after, mut prior) = (nearest_of_triangle(x, v, next, m), nearest_of_triangle(x, before, v, m));
    let (size, looks) = size_and_look(&corners, load(&pairs.side, at));
    out.looks |= looks << at;
    // Three nodes have one triangle.
    prior.square = L::select(corners.is_quad, prior.square, after.square);
    let by_rule = L::select(prior_wins(&after, &prior, size, first), one, zero);
    let takes_prior = L::splat(0.5).less(L::select(corners.is_quad, by_rule, zero));
    let (number, square) = (first - one, L::select(takes_prior, prior.square, after.square));
    let number = L::select(number.less(zero), L::splat(3.0), number);
    L::select(takes_prior, number, first).store(&mut out.triangle, at);
    L::select(takes_prior, prior.height, after.height).store(&mut out.height, at);
    square.store(&mut out.square, at);
    size.store(&mut out.size, at);
    let both = [(prior.weights, after.weights), (prior.foot, after.foot), (prior.normal, after.normal)];
    for (of, to) in both.into_iter().zip([&mut out.weights, &mut out.foot, &mut out.normal]) {
        let taken = either(takes_prior, of.0, of.1);
        for k in 0..3 {
            taken[k].store(&mut to[k], at);
        }
    }
    // The other two triangles.
    let along = minus(m, v);
    let whole = dot(along, along);
    let lowest = dot(along, minus(next, v)).min(dot(along, minus(opposite, v))).min(dot(along, minus(before, v))).min(whole);
    let beyond = lowest - dot(along, minus(x, v));
    let is_clear = (L::splat(CLEAR) * whole.max(most)).less(beyond);
    let is_farther = (L::splat(1.0 + FARTHER) * square * whole).less(beyond * beyond);
    // What is no number is in both sums.
    let are_numbers = L::bits(sum.less(L::splat(LARGEST))) & L::bits((after.square + prior.square).less(L::splat(LARGEST)));
    let are_others_far = (L::bits(is_clear) & L::bits(is_farther)) | !L::bits(corners.is_quad);
    out.is_known |= (are_numbers & are_others_far) << at;
    let others = L::select(is_clear, L::splat(1.0 - FARTHER) * beyond * beyond / whole, zero);
    let mut squares = [others; 4];
    for k in 0..4 {
        let (here, there) = (L::splat(k as f64), L::splat(((k + 1) % 4) as f64));
        squares[k] = L::select((first - there).abs().less(L::splat(0.5)), prior.square, squares[k]);
        squares[k] = L::select((first - here).abs().less(L::splat(0.5)), after.square, squares[k]);
    }
    (squares, size)
}

/// How different two places are: zero for the same.
#[inline(always)]
fn different<L: Lane>(a: [L; 3], b: [L; 3]) -> L {
    (a[0] - b[0]).abs() + (a[1] - b[1]).abs() + (a[2] - b[2]).abs()
}

/// Whether the triangle before the nearest corner, not that after it, counts by [`Placed::is_nearer`]: asked
/// in the order of their numbers, of which that of the triangle after it is `first`.
#[inline(always)]
fn prior_wins<L: Lane>(after: &Near<L>, prior: &Near<L>, size: L, first: L) -> L::Mask {
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    // The first of equal ones stays: number 3 before corner 0 is asked last.
    let last = L::select(prior.square.less(after.square), one, zero);
    let earlier = L::select(after.square.less(prior.square), zero, one);
    let by_square = L::select(first.less(L::splat(0.5)), last, earlier);
    let (a, b) = (after.height.abs(), prior.height.abs());
    let by_height = L::select(a.less(b), one, zero);
    let apart = minus(after.foot, prior.foot);
    let least = L::splat(TIE) * size;
    let unequal = (L::splat(SAME_SQUARE) * after.square.max(prior.square)).less((after.square - prior.square).abs());
    let elsewhere = (least * least).less(dot(apart, apart));
    let one_is_higher = (L::splat(TIE) * a.max(b)).less((a - b).abs());
    let of_one_point = L::select(one_is_higher, by_height, by_square);
    L::splat(0.5).less(L::select(L::either(unequal, elsewhere), by_square, of_one_point))
}

/// Which of the four triangles the points of the pairs from `at` on go through in no case in the step: the
/// volume of both keeps its sign by more than the motion bends it, as in `projection/swept.rs`, or the square
/// of the distance at the end is more than both can have gone.
#[inline(always)]
fn stays<L: Lane>(pairs: &Pairs, at: usize, (squares, size): ([L; 4], L)) -> [u32; 4] {
    let zero = L::splat(0.0);
    let (mut volumes, mut spans, mut arms) = ([[zero; 4]; 2], [[[zero; 3]; 4]; 2], [[zero; 3]; 2]);
    for time in 0..2 {
        let (x, of) = if time == 0 { (&pairs.x_old, &pairs.corners_old) } else { (&pairs.x, &pairs.corners) };
        let (x, Corners { all: corners, apex: m, .. }): ([L; 3], Corners<L>) = (load(x, at), corners(pairs, of, at));
        arms[time] = minus(x, m);
        for k in 0..4 {
            spans[time][k] = minus(corners[k], m);
        }
        for k in 0..4 {
            volumes[time][k] = dot(arms[time], cross(spans[time][k], spans[time][(k + 1) % 4]));
        }
    }
    let (arm, arm_by) = (sum_of_sizes(arms[0]), different(arms[1], arms[0]));
    let (mut span, mut span_by) = (zero, zero);
    for k in 0..4 {
        span = span.max(sum_of_sizes(spans[0][k]));
        span_by = span_by.max(different(spans[1][k], spans[0][k]));
    }
    let quarter = L::splat(0.25) * (arm * span_by * span_by + L::splat(2.0) * span * arm_by * span_by);
    let bend = quarter + L::splat(0.39) * (arm_by * span_by * span_by);
    let all = arm + arm_by + span + span_by;
    let bound = L::splat(1.01) * bend + L::splat(16.0 * ROUNDING) * (all * all * all);
    let gone = L::splat(1.001) * (arm_by + span_by) + L::splat(RIM) * size;
    // Three nodes have one triangle.
    let is_quad = L::bits(corners::<L>(pairs, &pairs.corners, at).is_quad);
    let mut stays = [0; 4];
    for k in 0..4 {
        let [old, new] = [volumes[0][k], volumes[1][k]];
        // Both above the bound, or both below it with the other sign.
        let above = L::bits(bound.less(old.min(new)));
        let below = L::bits(bound.less(-(old.max(new))));
        let is_there = if k == 0 { u32::MAX } else { is_quad };
        stays[k] = !is_there | above | below | L::bits((gone * gone).less(squares[k]));
    }
    stays
}

#[inline(always)]
fn sum_of_sizes<L: Lane>(a: [L; 3]) -> L {
    a[0].abs() + a[1].abs() + a[2].abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::Random;
    use crate::contact::projection::swept::{is_beside, passages};
    use crate::mesh::cell::CellKind;
    use crate::mesh::surface::SpaceSurface;

    /// Two cubes side by side and a wedge beside them, each node moved by so much at random, with room for
    /// a point.
    fn scene(random: &mut Random, crooked: f64) -> (SpaceSurface, Vec<Vector>) {
        let cells: [&[u32]; 3] = [&[0, 1, 4, 3, 6, 7, 10, 9], &[1, 2, 5, 4, 7, 8, 11, 10], &[2, 12, 5, 8, 13, 11]];
        let kinds = [CellKind::Hexahedron, CellKind::Hexahedron, CellKind::Wedge];
        let surface = SpaceSurface::outside(cells.iter().zip(kinds).map(|(cell, kind)| kind.cell(cell))).unwrap();
        let mut positions: Vec<Vector> = (0..12).map(|k| [k % 3, k / 3 % 2, k / 6].map(f64::from)).collect();
        positions.extend([[3.0, 0.0, 0.0], [3.0, 0.0, 1.0]]);
        for x in &mut positions {
            x.iter_mut().for_each(|c| *c += crooked * (random.unit() - 0.5));
        }
        positions.push([0.0; 3]);
        (surface, positions)
    }

    /// A place near a facet: over its face, a diagonal, a side, or a corner; a little before or behind it.
    fn place(random: &mut Random, placed: &Placed<'_>, facet: u32, depth: f64) -> Vector {
        let corners = placed.surface.facets[facet as usize].map(|node| placed.positions[node as usize]);
        let (u, v) = (random.unit(), random.unit());
        let (u, v) = match (8.0 * random.unit()) as u32 {
            0 => (u, u),
            1 => (u, 1.0 - u),
            2 => (0.0, v),
            3 => (u.round(), v.round()),
            4 => (0.5, 0.5),
            _ => (u, v),
        };
        let (shares, normal) = ([(1.0 - u) * (1.0 - v), u * (1.0 - v), u * v, (1.0 - u) * v], placed.facet_normal(facet));
        let by = if random.unit() < 0.2 { 0.0 } else { depth * (random.unit() - 0.5) };
        [0, 1, 2].map(|d| (0..4).map(|k| shares[k] * corners[k][d]).sum::<f64>() + by * normal[d])
    }

    #[test]
    fn what_is_measured_is_what_the_one_facet_says_by_itself_to_the_bit() {
        let mut random = Random::new(3);
        let (mut known, mut asked, mut looks) = (0, 0, 0);
        for round in 0..600 {
            let crooked = [0.0, 1e-13, 1e-3, 0.3][round % 4];
            let (surface, mut positions) = scene(&mut random, crooked);
            let (offset, depth) = ([0.0, 1e5][round / 4 % 2], [1e-9, 1e-3, 0.1, 2.0][round / 8 % 4]);
            positions.iter_mut().for_each(|x| x[1] += offset);
            let node = positions.len() as u32 - 1;
            for facet in 0..surface.facets.len() as u32 {
                let x = place(&mut random, &Placed { surface: &surface, positions: &positions }, facet, depth);
                positions[node as usize] = if random.unit() < 0.01 { [f64::NAN, x[1], f64::INFINITY] } else { x };
                let x = positions[node as usize];
                let (sweep, placed) = (Sweep::between(&positions, &positions), Placed { surface: &surface, positions: &positions });
                let side = [0, 1, 2].map(|_| random.unit() - 0.5);
                for level in Level::available() {
                    let (mut pairs, mut measured) = (Pairs::NONE, Measured::NONE);
                    // Others beside it, which must not matter.
                    let lane = (facet % 8) as usize;
                    for other in 0..=lane as u32 {
                        let facet = if other as usize == lane { facet } else { other };
                        pairs.add(node, &surface.facets[facet as usize], sweep, (&side, false));
                    }
                    pairs.measure(level, &mut measured);
                    asked += 1;
                    let Some(((nearest, of, k), plane)) = measured.of(lane, facet) else { continue };
                    known += 1;
                    let (expected, triangle) = placed.nearest(x, facet).unwrap();
                    assert_eq!((of, k), (facet, triangle), "{round} {}", level.name());
                    let bits = |n: &Nearest| [n.weights, n.foot].map(|v| v.map(f64::to_bits));
                    assert_eq!((nearest.square.to_bits(), bits(&nearest)), (expected.square.to_bits(), bits(&expected)));
                    let normal = placed.normal(facet, k);
                    assert_eq!(plane, Plane { normal, height: dot(minus(x, nearest.foot), normal), size: placed.size(facet) });
                    assert_eq!(measured.stays(lane), 0, "it was not asked");
                    assert!(!measured.looks(lane) || dot(side, placed.facet_normal(facet)) > -1e-9);
                    looks += usize::from(measured.looks(lane));
                }
            }
        }
        assert!(known > asked / 2 && looks > asked / 6, "{known} and {looks} of {asked}");
    }

    #[test]
    fn who_stays_goes_through_no_triangle() {
        let mut random = Random::new(5);
        let (mut stay, mut pass) = (0, 0);
        for round in 0..6000 {
            let (surface, mut old) = scene(&mut random, [0.0, 0.3][round % 2]);
            let facet = (random.unit() * surface.facets.len() as f64) as u32;
            let (node, step) = (old.len() - 1, [1e-3, 0.02, 0.2][round % 3]);
            old[node] = place(&mut random, &Placed { surface: &surface, positions: &old }, facet, 2.0 * step);
            let mut new = old.clone();
            new.iter_mut().flatten().for_each(|c| *c += step * (random.unit() - 0.5));
            let (mut pairs, mut measured) = (Pairs::NONE, Measured::NONE);
            pairs.add(node as u32, &surface.facets[facet as usize], Sweep::between(&old, &new), (&[0.0; 3], true));
            let path = [old[node], new[node]];
            for level in Level::available() {
                pairs.measure(level, &mut measured);
                let stays = measured.stays(0);
                let is_triangle = surface.facets[facet as usize][2] == surface.facets[facet as usize][3];
                for k in 0..if is_triangle { 1 } else { 4 } {
                    let [before, after] = [&old, &new].map(|positions| Placed { surface: &surface, positions }.triangle(facet, k));
                    let ways = passages(path, before, after, |x, triangle| (0..3).all(|side| is_beside(x, triangle, side)));
                    let goes = ways.iter().any(|times| times.iter().count() > 0);
                    assert!(!(stays >> k & 1 == 1 && goes), "{round} {k} {}", level.name());
                    stay += stays >> k & 1;
                    pass += u32::from(goes);
                }
            }
        }
        assert!(stay > 20_000 && pass > 1000, "{stay} {pass}");
    }
}
