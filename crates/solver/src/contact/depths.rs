//! How deep bodies in 2D are in each other against their local thickness: by the springs of each step,
//! and by an overlap check that looks at the bodies as they are.
//!
//! The overlap check shares nothing with the search and what it remembers. Nodes of an outline that are
//! inside another one by their winding number, and three places on each part of a segment that is inside, are
//! as deep as the other surface is far away. It looks when things may have gone a quarter of the least
//! thickness, both bodies together, and at least every thirty-second step; where many segments are near each
//! other less often, so that it goes through 16 of them a step in the mean. Where a body may meet itself, it
//! is checked against itself, too ([`super::outline`]).

use super::boxes::{Aabb, do_meet};
use super::checked::Look;
use super::findings::{DEEPEST_IN_PLANE, Findings, Overlap, SEEN, way_until_next};
use super::outline::{Opposite, Outline, Side};
use super::tracker::{ContactPoint, Tracker};
use super::{Scene, Vector};
use crate::archive::{Archive, ArchiveResult, persist_each};

/// Depths of a contact in 2D against the local thickness, the lesser of both bodies'.
#[derive(Debug, Default)]
pub struct Depths {
    /// What is opposite of the segments of each surface.
    surfaces: Vec<Vec<Opposite>>,
    findings: Findings,
    /// Travel at this step, and what nodes went since the one before at most, m.
    travel: f64,
    way: f64,
    /// Whether the step before was too deep.
    was_deep: bool,
    overlap_check: OverlapCheck,
}

/// Way of both bodies together between two looks, as a fraction of the least thickness, and most steps.
const BETWEEN_LOOKS: f64 = 0.25;
const MOST_STEPS: u32 = 32;
/// So many segments are looked at a step, in the mean: what presses along long sides is looked at less often.
const PER_STEP: u32 = 16;
/// Segments of a body that are looked at against itself count so many for one.
const OF_ITSELF: usize = 8;
/// Mark of a body that is on both sides of a contact.
const BOTH_SIDES: u8 = 3;
/// Depth against the thickness from which on a place is looked at once more.
const CERTAIN: f64 = 0.02;

/// Looks at the bodies as they are.
#[derive(Debug, Default)]
struct OverlapCheck {
    outlines: Vec<Outline>,
    /// On which sides of the contact each is.
    sides: Vec<u8>,
    /// Travel at which it looks again, m, and steps since the last look.
    next: f64,
    steps: u32,
    /// Segments that the last look went through.
    looked: u32,
    /// Nodes that were inside another body in the last look, and how deep, m.
    inside: Vec<(u32, f64)>,
}

impl Depths {
    /// For surfaces with what is opposite of their segments.
    #[must_use]
    pub fn new(surfaces: Vec<Vec<Opposite>>) -> Self {
        Self { surfaces, ..Self::default() }
    }

    /// With an overlap check of these bodies, each on the first (1) or the second side (2) of the contact, or
    /// on both (3): what meets is of different sides.
    #[must_use]
    pub(crate) fn judging(self, outlines: Vec<(Outline, u8)>) -> Self {
        let (outlines, sides) = outlines.into_iter().unzip();
        Self { overlap_check: OverlapCheck { outlines, sides, next: f64::NEG_INFINITY, steps: 0, looked: 0, inside: Vec::new() }, ..self }
    }

    /// Least thickness at the start behind segments (of their surfaces), m.
    #[must_use]
    pub fn thickness(&self, around: impl IntoIterator<Item = (usize, u32)>) -> f64 {
        let initial = |(surface, segment): (usize, u32)| Some(self.surfaces.get(surface)?.get(segment as usize)?.initial);
        around.into_iter().filter_map(initial).fold(f64::INFINITY, f64::min)
    }

    /// A new step begins.
    pub fn begin(&mut self, scene: &Scene<'_, 2>) {
        let way = scene.sweep.travel - self.travel;
        (self.travel, self.way) = (scene.sweep.travel, if way.is_finite() { way } else { 0.0 });
        self.findings.begin();
        self.overlap_check.steps = self.overlap_check.steps.saturating_add(1);
        // What was too deep is looked at in each step: its springs alone may not see it.
        let least = if scene.sweep.travel >= self.overlap_check.next { 1 } else { MOST_STEPS }.max(self.overlap_check.looked / PER_STEP);
        let is_due = self.was_deep || self.overlap_check.steps >= least;
        if !self.overlap_check.outlines.is_empty() && is_due {
            self.look(scene);
        }
    }

    /// Checks the bodies as they are.
    fn look(&mut self, scene: &Scene<'_, 2>) {
        let positions = scene.sweep.new;
        let overlap_check = &mut self.overlap_check;
        overlap_check.outlines.iter_mut().for_each(|outline| outline.refit(positions));
        let sides = overlap_check.outlines.iter().flat_map(|outline| &outline.sides).filter(|side| !side.is_mirror);
        let least = sides.map(|side| side.opposite.now(side.segment, positions)).fold(f64::INFINITY, f64::min);
        let findings = &mut self.findings;
        let mut nodes = std::mem::take(&mut overlap_check.inside);
        nodes.clear();
        let mut looked = 0;
        overlap_check.meeting(|own, other| {
            looked += own.inside(other, positions, |x, side, is_node| {
                // Flush sides are cut anywhere: a place that counts is inside for certain.
                let found = deep(x, side, other, scene).filter(|found| found.ratio() < CERTAIN || other.is_inside(x, positions));
                if let Some(found) = found {
                    if is_node {
                        nodes.push((side.segment[0], found.depth));
                    }
                    findings.see(found, false);
                }
            });
        });
        for (outline, _) in overlap_check.outlines.iter().zip(&overlap_check.sides).filter(|(_, sides)| **sides == BOTH_SIDES) {
            // That nothing is cut is seen at once, for most segments by boxes around many.
            looked += outline.sides.len() / OF_ITSELF;
            outline.folds(positions, |x, side, square, nearest| findings.see(overlap_of(x, [side, nearest], square, scene), true));
        }
        (overlap_check.inside, overlap_check.looked) = (nodes, looked as u32);
        let deepest = findings.now.ratio().max(findings.own.ratio());
        (overlap_check.next, overlap_check.steps) =
            (scene.sweep.travel + way_until_next(deepest, DEEPEST_IN_PLANE, BETWEEN_LOOKS, least), 0);
    }

    /// Takes a node that is so deep inside, m, where bodies were `initial` thick at the start, m.
    pub fn see(&mut self, tracker: &Tracker, touch: &ContactPoint, depth: f64, initial: f64, scene: &Scene<'_, 2>) {
        if !(depth > SEEN * initial) {
            return;
        }
        let around = tracker.around(touch);
        let positions = scene.sweep.new;
        let thickness = |(surface, segment): (usize, u32)| {
            let opposite = self.surfaces.get(surface)?.get(segment as usize)?;
            Some(opposite.now(tracker.targets()[surface].surface.segments[segment as usize], positions))
        };
        let thickness = around.into_iter().filter_map(thickness).fold(f64::INFINITY, f64::min);
        // Behind the surface of an obstacle nothing is known, and the node's own body counts.
        let thickness = if thickness < f64::INFINITY { thickness } else { initial };
        let [(surface, segment), _, _] = around;
        let other = tracker.targets()[surface].surface.segments[segment as usize][0];
        let [x, y] = positions[touch.node as usize];
        let place = Overlap { place: [x, y, 0.0], depth, thickness, nodes: [touch.node, other], time: scene.time };
        self.findings.see(place, touch.own);
    }

    /// The step has been seen: what is too deep counts.
    pub fn end(&mut self) {
        self.was_deep = self.findings.count(self.way, self.was_deep);
    }
}

impl Look<2> for Depths {
    fn see_step(&mut self, scene: &Scene<'_, 2>) {
        self.begin(scene);
        self.end();
    }

    fn findings(&self) -> &Findings {
        &self.findings
    }

    fn inside(&self) -> &[(u32, f64)] {
        &self.overlap_check.inside
    }

    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        persist_each!(archive; &mut self.findings, &mut self.travel, &mut self.was_deep, &mut self.overlap_check.next, &mut self.overlap_check.steps, &mut self.overlap_check.looked, &mut self.overlap_check.inside);
        Ok(())
    }

    fn inherit(&mut self, old: &Self) {
        (self.findings, self.travel, self.was_deep) = (old.findings, old.travel, old.was_deep);
    }
}

impl OverlapCheck {
    /// Shows all pairs of bodies whose boxes meet, either way round.
    fn meeting(&self, mut see: impl FnMut(&Outline, &Outline)) {
        let boxes: Vec<Aabb<2>> = self.outlines.iter().map(Outline::around).collect();
        let mut order: Vec<usize> = (0..boxes.len()).collect();
        order.sort_by(|&a, &b| boxes[a][0][0].total_cmp(&boxes[b][0][0]).then(a.cmp(&b)));
        for (at, &i) in order.iter().enumerate() {
            for &j in order[at + 1..].iter().take_while(|&&j| boxes[j][0][0] <= boxes[i][1][0]) {
                let [a, b] = [self.sides[i], self.sides[j]];
                let may_meet = (a & 1 != 0 && b & 2 != 0) || (a & 2 != 0 && b & 1 != 0);
                if may_meet && do_meet(&boxes[i], &boxes[j]) {
                    see(&self.outlines[i], &self.outlines[j]);
                    see(&self.outlines[j], &self.outlines[i]);
                }
            }
        }
    }
}

/// How deep a place of a segment is in another body.
fn deep(x: Vector, side: &Side, other: &Outline, scene: &Scene<'_, 2>) -> Option<Overlap> {
    let (square, nearest) = other.nearest(x, scene.sweep.new)?;
    Some(overlap_of(x, [side, &nearest], square, scene))
}

/// The overlap at a place of the first side, whose distance from the second one has this square, m².
fn overlap_of(x: Vector, sides: [&Side; 2], square: f64, scene: &Scene<'_, 2>) -> Overlap {
    let thickness = sides.map(|side| side.opposite.now(side.segment, scene.sweep.new));
    let nodes = sides.map(|side| side.segment[0]);
    Overlap { place: [x[0], x[1], 0.0], depth: square.sqrt(), thickness: thickness[0].min(thickness[1]), nodes, time: scene.time }
}
