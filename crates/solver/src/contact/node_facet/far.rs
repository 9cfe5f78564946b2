//! What is far is not looked at: lower bounds of the distances between nodes and facets, from when they were
//! measured last.
//!
//! The tracker keeps a bound for each candidate and one for each node and body, and asks here. A facet that
//! was d away at the travel T (the way that no node has exceeded since the start) is at least d − 2 (T' − T)
//! away at T', since its points lie between its corners: kept is d + 2 T, see [`sleep`]. A candidate that
//! can't be nearer than one that has been measured need not be measured, nor one that can't be reached in the
//! step be looked at for a passage; a node all of whose candidates are beyond what touches sleeps. Bounds are
//! part of the state, so that a run that is resumed sleeps as the one that continued.

use super::super::projection::node_facet::eight::Plane;
use super::super::projection::node_facet::{Found, Placed, Vector};
use super::super::tracker::sleep::{self, AWAKE};
use super::measured::Known;

/// Bounds are taken as so much smaller, as a fraction of what they are made of: they may round.
const ROUNDING: f64 = 1e-12;
/// A node can't go through a facet that is farther than so many times the longest way of a node in the step:
/// twice that, with room for facets that turn.
pub(super) const PASSAGE: f64 = 8.0;

/// All triangles of a facet of four nodes.
pub(super) const ALL: u32 = 0b1111;

/// Candidates of a node in a body, with what is known of their distances.
pub(super) struct Candidates<'a> {
    /// Facets, ascending.
    pub(super) facets: &'a [u32],
    /// Distance + 2 × travel of each when it was measured, m; [`AWAKE`]: not known.
    pub(super) clear: &'a mut [f64],
    /// Travel of this step, and the longest way of a node in it, m.
    pub(super) travel: f64,
    pub(super) way: f64,
    /// Those that have been measured already.
    pub(super) known: Known<'a>,
}

/// How far away something is at least, m.
pub(super) fn least(clear: f64, travel: f64) -> f64 {
    clear - 2.0 * travel - ROUNDING * (clear.abs() + 2.0 * travel)
}

impl Candidates<'_> {
    /// Those that a node may have gone through in the step, each with those of its triangles that it did not
    /// go through, a bit for each.
    pub(super) fn in_passage(&self) -> impl Iterator<Item = (u32, u32)> {
        let is_far = |clear: f64| least(clear, self.travel) > PASSAGE * self.way;
        let near = self.facets.iter().zip(&*self.clear).enumerate().filter(move |(_, (_, clear))| !is_far(**clear));
        near.map(|(k, (facet, _))| (*facet, self.known.stays(k))).filter(|(_, stays)| *stays != ALL)
    }

    /// What is nearest to x among the facets that count, see [`Placed::is_nearer`]; `likely` is asked first.
    /// With its plane, if that is known.
    #[inline]
    pub(super) fn nearest(
        &mut self,
        placed: &Placed<'_>,
        x: Vector,
        likely: u32,
        counts: impl Fn(u32) -> bool,
    ) -> Option<(Found, Option<Plane>)> {
        let first = self.facets.iter().position(|&facet| facet == likely).unwrap_or(0);
        let mut best: Option<(Found, Option<Plane>)> = None;
        for number in 0..self.facets.len() {
            // The likely one, those before it, and those after it.
            let k = match number {
                0 => first,
                _ if number <= first => number - 1,
                _ => number,
            };
            let facet = self.facets[k];
            let known = least(self.clear[k], self.travel);
            if best.as_ref().is_some_and(|((best, ..), _)| known > 0.0 && known * known > best.square) || !counts(facet) {
                continue;
            }
            let found = match self.known.of(k, facet) {
                Some((found, plane)) => (found, Some(plane)),
                None => match placed.nearest(x, facet) {
                    Some((found, triangle)) => ((found, facet, triangle), None),
                    None => continue,
                },
            };
            let (nearest, ..) = found.0;
            self.clear[k] = sleep::wake_at(nearest.square.sqrt(), self.travel);
            let is_nearer =
                |(best, plane): &(Found, Option<Plane>)| placed.is_nearer_of((x, &found.0, found.1.as_ref()), (best, plane.as_ref()));
            if best.as_ref().is_none_or(is_nearer) {
                best = Some(found);
            }
        }
        best
    }

    /// A lower bound for all of them; those that are not known to be beyond `bound` are measured.
    pub(super) fn bound(&mut self, placed: &Placed<'_>, x: Vector, bound: f64) -> f64 {
        let mut least = f64::INFINITY;
        for (&facet, clear) in self.facets.iter().zip(&mut *self.clear) {
            // What is no number is not beyond anything.
            if !(*clear > bound) {
                *clear = placed.distance(x, facet).map_or(AWAKE, |distance| sleep::wake_at(distance, self.travel));
            }
            least = least.min(*clear);
        }
        least
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::Random;
    use crate::mesh::cell::CellKind;
    use crate::mesh::surface::SpaceSurface;

    #[test]
    fn what_is_not_measured_would_not_have_been_nearest() {
        let mut random = Random::new(7);
        // Four crooked bodies in a row, six facets each.
        let cells: Vec<u32> = (0..32).collect();
        let surface = SpaceSurface::outside(CellKind::Hexahedron.cells(&cells)).unwrap();
        let facets: Vec<u32> = (0..24).collect();
        let mut vector = |size: f64| [0, 1, 2].map(|_| size * (2.0 * random.unit() - 1.0));
        let mut positions: Vec<Vector> = (0..32).map(|k| [3.0 * f64::from(k / 8), 0.0, 0.0]).collect();
        for x in &mut positions {
            let by = vector(1.0);
            (0..3).for_each(|d| x[d] += by[d]);
        }
        let (mut x, mut clear, mut travel, mut skipped) = (vector(1.0), vec![AWAKE; facets.len()], 0.0, 0);
        for _ in 0..400 {
            let way = 0.05;
            travel += way;
            let mut moved = |at: &mut Vector| {
                let by = vector(0.5 * way);
                (0..3).for_each(|d| at[d] += by[d]);
            };
            moved(&mut x);
            positions.iter_mut().for_each(moved);
            let placed = Placed { surface: &surface, positions: &positions };
            let measured = std::cell::Cell::new(0);
            let mut candidates = Candidates { facets: &facets, clear: &mut clear, travel, way, known: Known::NONE };
            let counts = |_| {
                measured.set(measured.get() + 1);
                true
            };
            let found = candidates.nearest(&placed, x, 5, counts).map(|((nearest, facet, k), _)| (nearest.square, facet, k));
            let all = facets.iter().filter_map(|&facet| placed.nearest(x, facet).map(|(nearest, k)| (nearest, facet, k)));
            let best = all.reduce(|a, b| if placed.is_nearer(x, &b, &a) { b } else { a });
            assert_eq!(found, best.map(|(nearest, facet, k)| (nearest.square, facet, k)));
            skipped += facets.len() - measured.get();
            let bound = candidates.bound(&placed, x, 1.0 + 2.0 * travel);
            for &facet in &facets {
                assert!(least(bound, travel) <= placed.distance(x, facet).unwrap());
                assert!(least(clear[facet as usize], travel) <= placed.distance(x, facet).unwrap());
            }
        }
        assert!(skipped > 4000, "{skipped}");
    }
}
