//! How deep bodies are in each other against their local thickness: what was found, deepest, first and now.

use crate::archive::persist_all;

/// Deepest that what is held may be in 3D, as a fraction of the local thickness: well below half of the
/// half, for what lies between samples and looks.
pub const DEEPEST: f64 = 1.0 / 6.0;
/// The same in 2D, where springs give depths in each step.
pub const DEEPEST_IN_PLANE: f64 = 0.2;
/// Deepest that it may be in a single step in 2D: what comes in within a step, which may be thrown out
/// in the next.
const DEEPEST_IN_A_STEP: f64 = 0.22;
/// Depth from which on an overlap gets a volume spring and counts as penetration, as a fraction of the local
/// thickness.
pub const CAST: f64 = 0.05;

/// Fraction of the thickness at the start from which on a depth is looked at: a body may be crushed to a
/// sixteenth.
pub(super) const SEEN: f64 = 0.0125;
/// Way of both sides together between two looks in 3D, as a fraction of the least thickness, and most
/// steps.
pub(super) const BETWEEN_LOOKS: f64 = 0.125;
pub(super) const MOST_STEPS: u32 = 16;

/// Places on a part of an edge or a segment that are looked at.
pub(super) const PLACES: [f64; 3] = [0.25, 0.5, 0.75];
/// Least way of both bodies between two looks, as a fraction of the least thickness: where something is
/// nearly too deep.
const LEAST_BETWEEN: f64 = 0.025;

/// How far each body may go until the next look, m: both together no farther than `between` of the `least`
/// thickness, m, and what is as deep as a `ratio` of its thickness no farther than to where it is too deep,
/// `most`.
pub(super) fn way_until_next(ratio: f64, most: f64, between: f64, least: f64) -> f64 {
    0.5 * (most - ratio).clamp(LEAST_BETWEEN, between) * least
}

/// A place in an overlap.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Overlap {
    /// Where, m; in 2D the last is 0.
    pub place: [f64; 3],
    /// Depth there, m.
    pub depth: f64,
    /// Local thickness, the lesser of both bodies', m.
    pub thickness: f64,
    /// A node of either body there.
    pub nodes: [u32; 2],
    /// When, s.
    pub time: f64,
}

persist_all!(Overlap { place, depth, thickness, nodes, time });

impl Overlap {
    /// Depth as a fraction of the local thickness.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        if self.depth > 0.0 { self.depth / self.thickness } else { 0.0 }
    }
}

/// What was found so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Findings {
    /// What was not held, over all looks: in 3D regions, in 2D steps.
    pub unverified: u64,
    /// Looks.
    pub looks: u64,
    /// The first that was not held.
    pub first: Option<Overlap>,
    /// What was deepest against the local thickness in all looks.
    pub worst: Overlap,
    /// The deepest place of the last look between different bodies.
    pub now: Overlap,
    /// The same of a body in itself.
    pub own: Overlap,
    /// Where a body was deeper in another one in the last look than either is thick.
    pub through: Option<Overlap>,
}

persist_all!(Findings { unverified, looks, first, worst, now, own, through });

impl Findings {
    /// A new look begins.
    pub(super) fn begin(&mut self) {
        self.looks += 1;
        (self.now, self.own, self.through) = (Overlap::default(), Overlap::default(), None);
    }

    /// Takes a place of this look, of a body in itself (`is_own`) or of two.
    pub(super) fn see(&mut self, place: Overlap, is_own: bool) {
        let most = if is_own { &mut self.own } else { &mut self.now };
        if place.ratio() > most.ratio() {
            *most = place;
        }
        if place.ratio() > self.worst.ratio() {
            self.worst = place;
        }
    }

    /// Counts a step in the plane that is too deep: deeper than a fifth if the one before was, `was_deep`,
    /// and 0.22 at once. What comes in within a step may be as deep as both sides go in it, `way` (m) each,
    /// before it has gone through. Whether this step is too deep.
    pub(super) fn count(&mut self, way: f64, was_deep: bool) -> bool {
        if (Overlap { depth: self.now.depth - 2.0 * way, ..self.now }).ratio() > 1.0 {
            self.through = Some(self.now);
        }
        let ratio = self.now.ratio().max(self.own.ratio());
        let is_deep = ratio > DEEPEST_IN_PLANE;
        if (is_deep && was_deep) || ratio > DEEPEST_IN_A_STEP {
            self.miss();
        }
        is_deep
    }

    /// What two found together, of the same bodies at the same times.
    #[must_use]
    pub(super) fn with(&self, other: &Self) -> Self {
        let deeper = |a: Overlap, b: Overlap| if b.ratio() > a.ratio() { b } else { a };
        let earlier = |a: Overlap, b: Overlap| if b.time < a.time { b } else { a };
        Self {
            unverified: self.unverified + other.unverified,
            looks: self.looks.max(other.looks),
            first: self.first.into_iter().chain(other.first).reduce(earlier),
            worst: deeper(self.worst, other.worst),
            now: deeper(self.now, other.now),
            own: deeper(self.own, other.own),
            through: self.through.or(other.through),
        }
    }

    /// Counts something of this look that was not held.
    pub(super) fn miss(&mut self) {
        self.unverified += 1;
        let Self { now, own, .. } = *self;
        self.first.get_or_insert(if own.ratio() > now.ratio() { own } else { now });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether a step with this depth counts, after one that was too deep or not.
    fn counts(ratio: f64, was_deep: bool) -> u64 {
        let mut found = Findings::default();
        found.see(Overlap { depth: ratio, thickness: 1.0, ..Overlap::default() }, false);
        found.count(0.0, was_deep);
        found.unverified
    }

    #[test]
    fn a_step_in_2d_counts_at_once_from_0_22_on_and_from_a_fifth_on_if_the_one_before_was_too_deep() {
        let found = [(0.19, true), (0.21, false), (0.21, true), (0.23, false), (0.23, true)].map(|(ratio, was)| counts(ratio, was));
        assert_eq!(found, [0, 0, 1, 1, 1]);
    }
}
