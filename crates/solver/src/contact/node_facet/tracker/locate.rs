//! Where the node of each group is with respect to its body in a step, and how the groups are shared among
//! threads.
//!
//! Groups come from the [`Tracker`], which keeps what is found. Those that touched in the last step are
//! measured eight at a time before ([`Measures`]); what is said of them is the same as if each were measured
//! by itself.

use super::{
    BAND, CHUNK, ContactHistory, ContactPoint, FACING, FLUSH, Found, Known, LOOK_AHEAD, Pass, SAME_FACE, SAME_SIDE, START, Task, Tracker,
};
use crate::contact::Sweep;
use crate::contact::node_facet::far::Candidates;
use crate::contact::node_facet::groups::Group;
use crate::contact::node_facet::measured::{self, BLOCK, Measures, Touching};
use crate::contact::node_facet::passage::{Passages, led};
use crate::contact::projection::node_facet::{Placed, Projection, Vector};
use crate::contact::tracker::sleep::AWAKE;
use crate::tensor::{cross, dot};
use crate::vector::{length, minus};
use std::ops::Range;

/// Facets whose normals have this cosine with one direction have one above [`SAME_SIDE`] with each other.
const ALIKE: f64 = 0.9;

/// Where a node is with respect to a body.
enum Place {
    /// It touches: its projection, the side from which it came in, and whether the face there leads it.
    Touches(Projection, Vector, bool),
    /// Not near.
    Away,
    /// So deep inside, without having been seen to come in, that it is not taken for a touch.
    Lost,
}

/// Groups that one task looks at, and what is known of them.
pub(super) struct Chunk<'a> {
    /// Number of the first group, and of the first candidate, among those of the pass.
    pub(super) first: [usize; 2],
    pub(super) groups: &'a mut [Group<Known>],
    pub(super) wakes: &'a mut [f64],
    pub(super) clear: &'a mut [f64],
}

impl Chunk<'_> {
    /// The groups before number `middle`, and the others.
    fn split(self, middle: usize) -> [Self; 2] {
        let Chunk { first: [first, begin], groups, wakes, clear } = self;
        // Groups without candidates may stand anywhere.
        let to = groups[middle..].iter().find(|group| group.begin < group.end).map_or(clear.len(), |group| group.begin as usize - begin);
        let (groups, wakes, clear) = (groups.split_at_mut(middle), wakes.split_at_mut(middle), clear.split_at_mut(to));
        [
            Chunk { first: [first, begin], groups: groups.0, wakes: wakes.0, clear: clear.0 },
            Chunk { first: [first + middle, begin + to], groups: groups.1, wakes: wakes.1, clear: clear.1 },
        ]
    }
}

/// The step as all groups of a pass see it.
#[derive(Clone, Copy)]
pub(super) struct Look<'a> {
    /// Number of the pass.
    pub(super) pass: usize,
    pub(super) sweep: Sweep<'a, 3>,
    /// Distance up to which touches are wanted beside what the motion asks for, and the longest way of a node
    /// in the step, m.
    pub(super) extra: f64,
    pub(super) way: f64,
    /// Groups that wake beyond it are not looked at, m.
    pub(super) asleep: f64,
}

impl Tracker {
    /// Looks at a chunk in `tasks.len()` smaller ones, halves of them at the same time.
    pub(super) fn share(&self, look: Look<'_>, chunk: Chunk<'_>, tasks: &mut [Task]) {
        if let [task] = tasks {
            return self.look_at(look, chunk, task);
        }
        let middle = tasks.len() / 2;
        let (low, high) = tasks.split_at_mut(middle);
        let [before, after] = chunk.split(middle * CHUNK);
        rayon::join(|| self.share(look, before, low), || self.share(look, after, high));
    }

    /// Looks at the groups of a chunk that are awake.
    pub(super) fn look_at(&self, look: Look<'_>, mut chunk: Chunk<'_>, task: &mut Task) {
        let Task { found, measures, .. } = task;
        for begin in (0..chunk.groups.len()).step_by(BLOCK) {
            let block = begin..(begin + BLOCK).min(chunk.groups.len());
            self.measure(look, &chunk, block.clone(), measures);
            for index in block {
                if !(chunk.wakes[index] <= look.asleep) {
                    continue;
                }
                let known = if measures.is_empty() { measured::Known::NONE } else { measures.of(index - begin) };
                if known.candidates.is_empty() || !self.stays(look, &mut chunk, (index, &known), found) {
                    self.look_at_group(look, &mut chunk, (index, known), found);
                    continue;
                }
                #[cfg(test)]
                {
                    task.stayed += 1;
                }
            }
        }
    }

    /// Measures what the groups of a block that touched in the last step are near.
    fn measure(
        &self,
        Look { pass: number, sweep, way, asleep, .. }: Look<'_>,
        chunk: &Chunk<'_>,
        block: Range<usize>,
        measures: &mut Measures,
    ) {
        let (pass, [_, first]) = (&self.passes[number], chunk.first);
        let placed = Placed { surface: &self.surfaces[pass.target], positions: sweep.new };
        let facets = &placed.surface.facets[..];
        measures.clear();
        let Some(level) = self.level else { return };
        for index in block.clone() {
            let number = index - block.start;
            measures.begin(number);
            // Who sleeps is not even read.
            if !(chunk.wakes[index] <= asleep) {
                continue;
            }
            let group = &chunk.groups[index];
            let Known { touches, memory: ContactHistory { facet: likely, side, is_led, .. } } = &group.known;
            if *touches && group.begin < group.end {
                let candidates = &pass.candidates[group.candidates()];
                let clear = &chunk.clear[group.begin as usize - first..group.end as usize - first];
                let may_pass = *side == [0.0; 3] || *is_led;
                let facing = group.own.then(|| self.own_normal(pass.slave, group.slave, sweep.new));
                let touching = Touching { node: group.node, likely: *likely, side, may_pass, candidates, clear, facing };
                let counts = |facet: u32| facing.is_none_or(|own| is_against(own, &placed, facet));
                measures.add(number, &touching, facets, ((sweep, way), level), counts);
            }
        }
        measures.end(block.len(), level);
    }

    /// Where the node of a group is with respect to its body.
    fn look_at_group(&self, look: Look<'_>, chunk: &mut Chunk<'_>, (index, known): (usize, measured::Known<'_>), found: &mut Found) {
        let Look { pass: number, sweep, extra, way, asleep } = look;
        let (pass, [first, begin]) = (&self.passes[number], chunk.first);
        let group = &mut chunk.groups[index];
        let facets = &pass.candidates[group.candidates()];
        let clear = if facets.is_empty() { &mut [] } else { &mut chunk.clear[group.begin as usize - begin..group.end as usize - begin] };
        let mut candidates = Candidates { facets, clear, travel: sweep.travel, way, known };
        let place = self.locate(pass, group, &mut candidates, sweep, extra);
        chunk.wakes[index] = match place {
            Place::Away => {
                let placed = Placed { surface: &self.surfaces[pass.target], positions: sweep.new };
                candidates.bound(&placed, sweep.new[group.node as usize], asleep)
            }
            _ => AWAKE,
        };
        group.known.touches = false;
        if let Place::Touches(projection, side, is_led) = place {
            group.known.touches = true;
            (group.known.memory.side, group.known.memory.is_led) = (side, is_led);
            found.deepest = found.deepest.max(-projection.gap);
            let Group { slave, node, own, .. } = *group;
            found.touches.push(ContactPoint { pass: number as u32, slave, node, projection, own, group: (first + index) as u32 });
        } else {
            group.known.memory = ContactHistory::default();
        }
    }

    /// Whether a node touches: its projection, and the side from which it came in.
    fn locate(&self, pass: &Pass, group: &Group<Known>, candidates: &mut Candidates<'_>, sweep: Sweep<'_, 3>, extra: f64) -> Place {
        let placed = Placed { surface: &self.surfaces[pass.target], positions: sweep.new };
        let x = sweep.new[group.node as usize];
        let known = candidates.known.facing;
        let facing = group.own.then(|| known.unwrap_or_else(|| self.own_normal(pass.slave, group.slave, sweep.new)));
        let faces = |facet: u32| facing.is_none_or(|own| is_against(own, &placed, facet));
        let passages = |candidates: &Candidates<'_>| {
            Passages::of(&placed, sweep, group.node, candidates.in_passage().filter(|&(facet, _)| faces(facet)))
        };
        let ContactHistory { facet: likely, side: before, is_led: was_led, .. } = group.known.memory;
        let was_inside = before != [0.0; 3];
        let side = if was_inside { before } else { passages(candidates).fate(before).side };
        let came = side != [0.0; 3];
        let sees = |facet: u32| faces(facet) && (!came || placed.looks_to(facet, side, SAME_SIDE));
        let mut found = candidates.nearest(&placed, x, likely, sees).and_then(|(found, plane)| placed.seen_by(x, found, plane));
        let is_inside = found.is_some_and(|found| found.gap < 0.0);
        // Who comes in now; and who was inside and seems to be out, but went through the far side.
        let mut may_lead = came && !was_inside;
        // Where everything looks to its side nothing is the far side.
        let has_far_side =
            |candidates: &Candidates<'_>| candidates.in_passage().any(|(facet, _)| !(dot(side, placed.facet_normal(facet)) > ALIKE));
        if was_inside && (was_led || (!is_inside && has_far_side(candidates))) {
            let fate = passages(candidates).fate(side);
            may_lead = fate.is_through || (was_led && fate.side != [0.0; 3]);
        }
        if may_lead && let Some((led, along)) = led(candidates, &placed, x, side, found.as_ref(), (likely, &faces)) {
            return Place::Touches(led, along, true);
        }
        // Who continues with its face needs no second look.
        let continues = |found: &Projection| group.known.touches && dot(group.known.memory.spring.normal, found.normal) > SAME_FACE;
        let faces_it = |found: &Projection| self.own_faces(pass.slave, group.slave, found.normal, sweep.new);
        if !group.own && !found.as_ref().is_some_and(|found| continues(found) || faces_it(found)) {
            let own = self.own_normal(pass.slave, group.slave, sweep.new);
            if found.is_none_or(|found| dot(own, found.normal) >= FACING) {
                let faces = |facet: u32| is_against(own, &placed, facet);
                let over = candidates.nearest(&placed, x, likely, |facet| sees(facet) && faces(facet));
                let over = over.and_then(|(over, _)| placed.seen_over(x, over, faces));
                let is_flush = found.is_some_and(|found| found.gap.abs() <= FLUSH * self.reach.skin);
                // No face before which it is leads it out of a body into which it has gone.
                let may_hold = |over: &Projection| !(may_lead && is_inside) || is_flush || over.gap < 0.0;
                let over = over.filter(|over| may_hold(&over.0) && self.is_held(pass, group, side, sweep, over, is_flush));
                found = over.map(|(over, _)| over).or(found);
            }
        }
        let Some(found) = found else { return Place::Away };
        if found.gap < 0.0 {
            // In its own body only who was seen to come in, or was just before it.
            let known = came || (group.known.touches && dot(group.known.memory.spring.normal, found.normal) > SAME_SIDE);
            return match known {
                false if group.own => Place::Away,
                false if -found.gap > self.radius - self.reach.skin => Place::Lost,
                _ => Place::Touches(found, found.normal, false),
            };
        }
        let (still, most) = (extra + START * self.reach.skin, self.radius - self.reach.skin);
        let is_near = |near: f64| found.gap <= near.min(most).max(extra);
        if is_near(still) || is_near(still + LOOK_AHEAD * motion(&placed, &found, sweep, group.node)) {
            Place::Touches(found, [0.0; 3], false)
        } else {
            Place::Away
        }
    }

    /// Whether a face holds a node that is over its rim or beyond it, by the projection and the way from the
    /// rim: `side` is the one from which it came, `is_flush` says whether it lies on the body's surface
    /// within rounding.
    fn is_held(
        &self,
        pass: &Pass,
        group: &Group<Known>,
        side: Vector,
        sweep: Sweep<'_, 3>,
        (over, beyond): &(Projection, Vector),
        is_flush: bool,
    ) -> bool {
        let target = &self.surfaces[pass.target];
        let (placed, before) = (Placed { surface: target, positions: sweep.new }, Placed { surface: target, positions: sweep.old });
        let way = length(*beyond);
        if way > (BAND * placed.size(over.facet)).min(self.band) || -over.gap > self.radius - self.reach.skin {
            return false;
        }
        let held =
            dot(side, over.normal) > SAME_FACE || (group.known.touches && dot(group.known.memory.spring.normal, over.normal) > SAME_FACE);
        let from_the_front = || {
            let [a, b, c] = before.triangle(over.facet, over.triangle);
            let height = dot(minus(sweep.old[group.node as usize], a), cross(minus(b, a), minus(c, a)));
            over.gap >= 0.0 || height >= 0.0
        };
        (held || is_flush || from_the_front()) && (way == 0.0 || self.goes_back(pass, group, *beyond, sweep.new))
    }

    /// Whether the surface of a slave goes from it back over the face that it is beyond by a way.
    fn goes_back(&self, pass: &Pass, group: &Group<Known>, beyond: Vector, positions: &[Vector]) -> bool {
        let slaves = &self.surfaces[pass.slave];
        let x = positions[group.node as usize];
        slaves.around(group.slave as usize).iter().flat_map(|&facet| slaves.facets[facet as usize]).any(|other| {
            let along = minus(positions[other as usize], x);
            // More than the rim's own direction, as far as rounding can resolve.
            dot(along, beyond) < -0.05 * length(along) * length(beyond)
        })
    }
}

/// Whether a facet looks against the normal of a node at its own surface.
fn is_against(own: Vector, placed: &Placed<'_>, facet: u32) -> bool {
    dot(own, placed.facet_normal(facet)) < FACING
}

/// How far a node and where it projects have moved with respect to each other in the step, m.
fn motion(placed: &Placed<'_>, found: &Projection, sweep: Sweep<'_, 3>, node: u32) -> f64 {
    let moved = |node: u32| minus(sweep.new[node as usize], sweep.old[node as usize]);
    let facet = placed.surface.facets[found.facet as usize];
    let mut way = moved(node);
    for (corner, weight) in facet.into_iter().zip(found.weights) {
        let by = moved(corner);
        (0..3).for_each(|d| way[d] -= weight * by[d]);
    }
    length(way)
}
