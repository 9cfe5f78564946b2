//! Through which facets of a body a node goes in a step, both ways, and what becomes of it: whether it is
//! inside at the end, and on which side it came in.
//!
//! Positions come from the step, candidates from the tracker of the nodes ([`super::tracker`]) or from the
//! check of missed contacts ([`super::super::missed_contacts`]), times from `projection/swept.rs`. A node
//! that comes in is inside until it goes out by a facet that looks to the side from which it came, or beside:
//! the far side of a thin body is none, and who goes through it in one step is inside. There the face by
//! which it came in leads it.

use super::super::Sweep;
use super::super::projection::node_facet::eight::RIM;
use super::super::projection::node_facet::{Placed, Projection, Vector, square_to_triangle};
use super::super::projection::swept::{is_beside, passages};
use super::far::Candidates;
use super::tracker::SAME_SIDE;
use crate::mesh::surface::Corners;
use crate::tensor::dot;
use crate::vector::{length, minus};

/// Cosine of the angle between the side from which a node came in and the normals of facets of the face
/// there.
pub(in crate::contact) const ALONG: f64 = 0.5;
/// Times of one step that differ by less are the same, and who goes in and out at the same time is out.
const SAME_TIME: f64 = 1e-12;

/// Ways may round.
const SLACK: f64 = 1.001;

/// How far beyond the box of a facet a node passes it by for sure, as a fraction of the size of the box.
const BESIDE: f64 = 1e-3;

/// A node goes through a facet.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Passage {
    /// When, 0 to 1.
    time: f64,
    /// Whether from its back to its front.
    is_out: bool,
    /// The facet's normal at the end of the step.
    normal: Vector,
}

/// So many passages of a node in a step need no storage of their own.
const FEW: usize = 8;

/// What a node did in a step.
#[derive(Debug, Default)]
pub(in crate::contact) struct Passages {
    few: [Passage; FEW],
    count: usize,
    /// All, where they are more.
    more: Vec<Passage>,
}

/// What becomes of a node.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::contact) struct Outcome {
    /// The side on which it is inside at the end; zero: it is not.
    pub(in crate::contact) side: Vector,
    /// Whether it went in, and did not come out again.
    pub(in crate::contact) enters: bool,
    /// Whether it went through the far side at last.
    pub(in crate::contact) is_through: bool,
}

impl Passages {
    /// Of a node through some facets, each with those of its triangles that it goes through in no case, a bit
    /// for each.
    pub(in crate::contact) fn of(
        placed: &Placed<'_>,
        sweep: Sweep<'_, 3>,
        node: u32,
        facets: impl IntoIterator<Item = (u32, u32)>,
    ) -> Self {
        let mut all = Self::default();
        facets.into_iter().for_each(|facet| all.add(placed, sweep, node, facet));
        all
    }

    /// Adds those through one facet.
    pub(in crate::contact) fn add(&mut self, placed: &Placed<'_>, sweep: Sweep<'_, 3>, node: u32, (facet, stays): (u32, u32)) {
        if are_apart(placed, sweep, node, facet) {
            return;
        }
        let before = Placed { surface: placed.surface, positions: sweep.old };
        let path = [sweep.old[node as usize], sweep.new[node as usize]];
        let triangles = if placed.surface.facets[facet as usize].corners().len() == 3 { 1 } else { 4 };
        // A triangle that is farther than both have gone is passed in no case.
        let gone = |of: u32| minus(sweep.new[of as usize], sweep.old[of as usize]);
        let way = |corner: &u32| length(minus(gone(node), gone(*corner)));
        let reach = SLACK * placed.surface.facets[facet as usize].iter().map(way).fold(0.0, f64::max) + RIM * placed.size(facet);
        let is_far = |k: usize| square_to_triangle(path[1], placed.triangle(facet, k)) > reach * reach;
        for k in (0..triangles).filter(|&k| stays >> k & 1 == 0 && !is_far(k)) {
            // A symmetry plane keeps a node over a side that lies on it, whatever rounds.
            let is_over = |x: Vector, triangle: [Vector; 3]| {
                (0..3).all(|side| match placed.mirror_at(facet, k, side) {
                    Some(mirror) => Placed::is_before(x, triangle[side], mirror, placed.size(facet)),
                    None => is_beside(x, triangle, side),
                })
            };
            let ways = passages(path, before.triangle(facet, k), placed.triangle(facet, k), is_over);
            for (times, is_out) in ways.iter().zip([false, true]) {
                times.iter().for_each(|time| self.push(Passage { time, is_out, normal: placed.facet_normal(facet) }));
            }
        }
    }

    fn push(&mut self, passage: Passage) {
        if let Some(room) = self.few.get_mut(self.count) {
            *room = passage;
        } else {
            if self.count == FEW {
                self.more.extend_from_slice(&self.few);
            }
            self.more.push(passage);
        }
        self.count += 1;
    }

    /// What becomes of a node that was inside on this side, or outside (zero).
    pub(in crate::contact) fn fate(mut self, side: Vector) -> Outcome {
        let all = if self.count <= FEW { &mut self.few[..self.count] } else { &mut self.more[..] };
        // Facets come in their order: a stable order of what is at one time.
        all.sort_by(|a, b| a.time.total_cmp(&b.time));
        for k in 1..all.len() {
            if all[k - 1].is_out && !all[k].is_out && all[k].time - all[k - 1].time < SAME_TIME {
                all.swap(k - 1, k);
            }
        }
        let mut fate = Outcome { side, ..Outcome::default() };
        for passage in all {
            let is_inside = fate.side != [0.0; 3];
            match (is_inside, passage.is_out) {
                (false, false) => fate = Outcome { side: passage.normal, enters: true, is_through: false },
                (true, true) if dot(fate.side, passage.normal) > SAME_SIDE => fate = Outcome::default(),
                (true, is_out) => fate.is_through = is_out,
                (false, true) => {}
            }
        }
        fate
    }
}

/// Whether a node and a facet stay apart in the step along an axis, by more than a place may be beyond the
/// rim of a facet and count as on it: it goes through none of its triangles, then. Of the facets around that
/// which a node goes through, most lie in the same plane and beside the way.
fn are_apart(placed: &Placed<'_>, sweep: Sweep<'_, 3>, node: u32, facet: u32) -> bool {
    let corners = placed.surface.facets[facet as usize];
    let (mut low, mut high) = (sweep.old[corners[0] as usize], sweep.old[corners[0] as usize]);
    for corner in corners {
        let [old, new] = [sweep.old[corner as usize], sweep.new[corner as usize]];
        for d in 0..3 {
            (low[d], high[d]) = (low[d].min(old[d].min(new[d])), high[d].max(old[d].max(new[d])));
        }
    }
    let margin = BESIDE * (high[0] - low[0]).max(high[1] - low[1]).max(high[2] - low[2]);
    let [from, to] = [sweep.old[node as usize], sweep.new[node as usize]];
    (0..3).any(|d| from[d].max(to[d]) < low[d] - margin || from[d].min(to[d]) > high[d] + margin)
}

/// The projection of a node on the face by which it came in from a side, and the facet's normal there; unless
/// what was `found` is that face, or holds the node inside and it is not over the face. `likely` is asked
/// first, of those that `faces` says it can meet.
pub(super) fn led(
    candidates: &mut Candidates<'_>,
    placed: &Placed<'_>,
    x: Vector,
    side: Vector,
    found: Option<&Projection>,
    (likely, faces): (u32, impl Fn(u32) -> bool),
) -> Option<(Projection, Vector)> {
    let inside = found.filter(|found| found.gap < 0.0);
    if inside.is_some_and(|found| dot(found.normal, side) > ALONG) {
        return None;
    }
    let of_face = |facet: u32| faces(facet) && dot(side, placed.facet_normal(facet)) > ALONG;
    let (led, along) = placed.behind(x, candidates.nearest(placed, x, likely, of_face)?.0)?;
    (inside.is_none() || dot(led.normal, along) > ALONG).then_some((led, along))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::cell::CellKind;
    use crate::mesh::surface::Surface;

    /// What a node does that goes straight from one place to another, with the unit cube that stands still
    /// (or a plate of the same width), and was outside.
    fn fate_of(from: Vector, to: Vector, height: f64) -> Outcome {
        let cells = [CellKind::Hexahedron.cell(&[0, 1, 2, 3, 4, 5, 6, 7])];
        let surface = Surface::<3>::outside(cells).unwrap();
        let corner = |k: u32| [f64::from(k & 1 ^ (k >> 1 & 1)), f64::from(k >> 1 & 1), height * f64::from(k >> 2)];
        let mut old: Vec<Vector> = (0..8).map(corner).collect();
        let mut new = old.clone();
        old.push(from);
        new.push(to);
        let placed = Placed { surface: &surface, positions: &new };
        Passages::of(&placed, Sweep::between(&old, &new), 8, (0..6).map(|facet| (facet, 0))).fate([0.0; 3])
    }

    #[test]
    fn who_goes_through_a_body_is_inside_on_its_side_and_who_cuts_a_corner_is_not() {
        for height in [1.0, 0.01] {
            let above = [0.3, 0.4, height + 0.5];
            let up = [0.0, 0.0, 1.0];
            let inside = fate_of(above, [0.4, 0.4, 0.5 * height], height);
            assert_eq!(inside, Outcome { side: up, enters: true, is_through: false });
            assert_eq!(fate_of(above, [0.4, 0.4, -2.0], height), Outcome { is_through: true, ..inside });
            // Out by the far side and then beyond the rim it has gone through all the same; by a side wall it
            // is out.
            assert_eq!(fate_of(above, [3.0, 0.4, -2.0], height).is_through, height < 0.5);
            assert_eq!(fate_of([0.9, 0.4, height + 0.1], [1.1, 0.4, 0.9 * height], height), Outcome::default());
            // Past a corner, along an edge, and over it.
            assert_eq!(fate_of([1.0, 0.4, height + 0.5], [1.5, 0.4, height], height), Outcome::default());
            assert_eq!(fate_of([0.5, 0.4, height + 0.5], [1.5, 0.4, height - 0.5], height), Outcome::default());
            assert_eq!(fate_of([0.5, 0.4, height], [1.5, 0.4, height], height), Outcome::default());
        }
    }
}
