//! Nodes that touched in the last step and the facets that they are near, measured eight pairs at a time
//! before they are looked at one by one: nearly all that is measured, in nearly every step.
//!
//! Groups come from the tracker; what is measured here is asked by [`super::far`], to which each number is
//! the same as if it had measured itself.

use super::super::Sweep;
use super::super::projection::node_facet::eight::{Measured, Pairs, Plane};
use super::super::projection::node_facet::{Found, Vector};
use super::far::{PASSAGE, least};
use embate_lanes::{BATCH, Level};

/// Groups that are measured together: their pairs stay in the fastest cache.
pub(super) const BLOCK: usize = 32;

/// Pairs of some groups.
pub(super) struct Measures {
    pairs: Pairs,
    measured: Vec<Measured>,
    /// Number of each pair's candidate within its group.
    candidates: Vec<u32>,
    /// First pair of each group of the block, and one behind the last.
    begins: [u32; BLOCK + 1],
    /// Of each group with pairs: which of them has the facet on which it was, and how far everything is that
    /// is in no pair, at least, m.
    likely: [u32; BLOCK],
    beyond: [f64; BLOCK],
    facing: [Option<Vector>; BLOCK],
}

impl Default for Measures {
    fn default() -> Self {
        let (likely, beyond, facing) = ([0; BLOCK], [0.0; BLOCK], [None; BLOCK]);
        Self { pairs: Pairs::NONE, measured: Vec::new(), candidates: Vec::new(), begins: [0; BLOCK + 1], likely, beyond, facing }
    }
}

/// What has been measured of a group.
#[derive(Clone, Copy)]
pub(super) struct Known<'a> {
    measured: &'a [Measured],
    /// Numbers of the pairs' candidates within the group.
    pub(super) candidates: &'a [u32],
    /// Number of the first pair in `measured`.
    first: usize,
    /// Which pair has the facet on which the node was.
    pub(super) likely: usize,
    /// What is in no pair is farther, m, or does not count.
    pub(super) beyond: f64,
    /// Of a node that may touch its own body its normal there.
    pub(super) facing: Option<Vector>,
}

impl Known<'_> {
    /// Nothing.
    pub(super) const NONE: Self = Self { measured: &[], candidates: &[], first: 0, likely: 0, beyond: 0.0, facing: None };

    /// Pair number `pair` of the group: eight that were measured together, and which of them.
    #[inline]
    pub(super) fn measured(&self, pair: usize) -> Option<(&Measured, usize)> {
        let pair = self.first + pair;
        Some((self.measured.get(pair / BATCH)?, pair % BATCH))
    }

    /// Where a candidate of the group is among the pairs.
    #[inline]
    fn pair(&self, candidate: usize) -> Option<(&Measured, usize)> {
        self.measured(self.candidates.iter().position(|&other| other as usize == candidate)?)
    }

    /// What of a candidate is nearest, and its plane; nothing where that is not known.
    #[inline]
    pub(super) fn of(&self, candidate: usize, facet: u32) -> Option<(Found, Plane)> {
        let (measured, lane) = self.pair(candidate)?;
        measured.of(lane, facet)
    }

    /// Which triangles of a candidate the node goes through in no case in the step, a bit for each.
    #[inline]
    pub(super) fn stays(&self, candidate: usize) -> u32 {
        self.pair(candidate).map_or(0, |(measured, lane)| measured.stays(lane))
    }
}

/// A group that touched in the last step.
pub(super) struct Touching<'a> {
    pub(super) node: u32,
    /// Facet on which it was.
    pub(super) likely: u32,
    /// Side on which it came in; zero: it is outside. And whether it may go through something.
    pub(super) side: &'a Vector,
    pub(super) may_pass: bool,
    pub(super) candidates: &'a [u32],
    /// What is known of their distances, see `far.rs`.
    pub(super) clear: &'a [f64],
    /// Of a node that may touch its own body its normal there.
    pub(super) facing: Option<Vector>,
}

impl Measures {
    /// Begins with the groups of a block.
    pub(super) fn clear(&mut self) {
        self.pairs.clear();
        self.candidates.clear();
    }

    /// Whether nothing has been added.
    pub(super) fn is_empty(&self) -> bool {
        self.candidates.is_empty()
    }

    /// Begins with group number `number` of the block, which must ascend: no pairs are added for those before
    /// it any more.
    #[inline]
    pub(super) fn begin(&mut self, number: usize) {
        (self.begins[number], self.facing[number]) = (self.candidates.len() as u32, None);
    }

    /// Adds the candidates that are looked at in this step at the most, of group number `number`, as far as
    /// they count.
    pub(super) fn add(
        &mut self,
        number: usize,
        of: &Touching<'_>,
        facets: &[[u32; 4]],
        ((sweep, way), level): ((Sweep<'_, 3>, f64), Level),
        counts: impl Fn(u32) -> bool,
    ) {
        let Touching { node, likely, side, may_pass, candidates, clear, facing } = *of;
        self.facing[number] = facing;
        let Some(first) = candidates.iter().position(|&facet| facet == likely).filter(|_| counts(likely)) else { return };
        // The likely one was measured in the last step: it is no farther than then and what both have gone.
        let beyond = clear[first] - 2.0 * sweep.travel + 4.0 * way;
        let beyond = if may_pass { beyond.max(PASSAGE * way) } else { beyond };
        self.beyond[number] = beyond;
        for (k, &facet) in candidates.iter().enumerate() {
            if k == first {
                self.likely[number] = self.candidates.len() as u32 - self.begins[number];
            } else if least(clear[k], sweep.travel) > beyond || !counts(facet) {
                continue;
            }
            self.pairs.add(node, &facets[facet as usize], sweep, (side, may_pass));
            self.candidates.push(k as u32);
            if self.pairs.is_full() {
                self.measure(level);
            }
        }
    }

    /// Measures what is left.
    pub(super) fn end(&mut self, number: usize, level: Level) {
        self.begins[number] = self.candidates.len() as u32;
        if !self.pairs.is_empty() {
            self.measure(level);
        }
    }

    fn measure(&mut self, level: Level) {
        let at = (self.candidates.len() - 1) / BATCH;
        if at >= self.measured.len() {
            self.measured.resize(at + 1, Measured::NONE);
        }
        self.pairs.measure(level, &mut self.measured[at]);
        self.pairs.clear();
    }

    /// What is known of group number `number` of the block.
    #[inline]
    pub(super) fn of(&self, number: usize) -> Known<'_> {
        let [first, end] = [self.begins[number], self.begins[number + 1]].map(|begin| begin as usize);
        let (likely, beyond, facing) = (self.likely[number] as usize, self.beyond[number], self.facing[number]);
        Known { measured: &self.measured, candidates: &self.candidates[first..end], first, likely, beyond, facing }
    }
}
