//! Boxes along the axes around what nodes and facets sweep in one step.

use super::Query;
use embate_lanes::Lane;

/// An axis-parallel box, closed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Extent<const D: usize> {
    /// Least coordinates, m.
    pub(super) low: [f64; D],
    /// Largest coordinates, m.
    pub(super) high: [f64; D],
}

impl<const D: usize> Extent<D> {
    /// The empty box: meets nothing, adds nothing.
    pub(super) const NONE: Self = Self { low: [f64::INFINITY; D], high: [f64::NEG_INFINITY; D] };

    /// Whether it is empty.
    pub(super) fn is_none(&self) -> bool {
        self.low[0] > self.high[0]
    }

    /// The box of both.
    #[inline]
    pub(super) fn with(&self, other: &Self) -> Self {
        Self {
            low: std::array::from_fn(|d| smaller(self.low[d], other.low[d])),
            high: std::array::from_fn(|d| larger(self.high[d], other.high[d])),
        }
    }

    /// The box of a node's path. `None` when a coordinate is not finite.
    #[inline]
    pub(super) fn of_path(query: &Query<'_, D>, node: u32) -> Option<Self> {
        let (old, new) = (&query.positions_old[node as usize], &query.positions_new[node as usize]);
        let mut extent = Self { low: *old, high: *old };
        // Times zero: 0 for a finite number, NaN for any other.
        let mut finite = 0.0;
        for d in 0..D {
            extent.low[d] = smaller(old[d], new[d]);
            extent.high[d] = larger(old[d], new[d]);
            finite += old[d] * 0.0 + new[d] * 0.0;
        }
        (finite == 0.0).then_some(extent)
    }

    /// The box of everything that comes nearer than `reach` to a facet while it moves straight from its old
    /// to its new position. `None` when a coordinate is not finite.
    ///
    /// Every point of the facet at every time is a convex combination of its old and new nodes, so their box
    /// holds it. It grows by `reach` and by a few units in the last place, because the two sums below round.
    #[inline]
    pub(super) fn of_facet(query: &Query<'_, D>, facet: &[u32; D], margin: Margin) -> Option<Self> {
        let mut extent = Self::NONE;
        let mut finite = 0.0;
        for &node in facet {
            let (old, new) = (&query.positions_old[node as usize], &query.positions_new[node as usize]);
            for d in 0..D {
                extent.low[d] = smaller(extent.low[d], smaller(old[d], new[d]));
                extent.high[d] = larger(extent.high[d], larger(old[d], new[d]));
                finite += old[d] * 0.0 + new[d] * 0.0;
            }
        }
        for d in 0..D {
            extent.low[d] -= margin.at(extent.low[d]);
            extent.high[d] += margin.at(extent.high[d]);
        }
        (finite == 0.0).then_some(extent)
    }

    /// Whether two boxes share a point.
    #[inline]
    pub(super) fn meets(&self, other: &Self) -> bool {
        // Without short cuts: no branch to mispredict.
        (0..D).fold(true, |meets, d| meets & (self.low[d] <= other.high[d]) & (other.low[d] <= self.high[d]))
    }

    /// Longest edge, m; infinite when it overflows.
    #[inline]
    pub(super) fn size(&self) -> f64 {
        (0..D).fold(0.0, |size, d| larger(size, self.high[d] - self.low[d]))
    }
}

/// `reach` rounded up, so that what rounding takes from a sum can't take a pair.
#[derive(Clone, Copy, Debug)]
pub(super) struct Margin(f64);

impl Margin {
    /// A reach that is negative or not a number counts as zero; an infinite one reaches everything.
    pub(super) fn new(reach: f64) -> Self {
        Self(reach.max(0.0) * (1.0 + 8.0 * f64::EPSILON))
    }
    /// Margin at coordinate `x`, m: a sum with it rounds by at most ε/2 · (|x| + reach), less than what is
    /// added here.
    #[inline]
    pub(super) fn at(self, x: f64) -> f64 {
        self.around(x)
    }
    /// The same in every lane.
    #[inline(always)]
    pub(super) fn around<L: Lane>(self, x: L) -> L {
        L::splat(self.0) + x.abs() * L::splat(4.0 * f64::EPSILON)
    }
}

// One instruction each, where `f64::min` and `max` need three for their care of NaN; callers sort NaN out
// themselves.
#[inline]
pub(super) fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}
#[inline]
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}
