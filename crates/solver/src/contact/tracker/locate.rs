//! Where each slave node lies in a step: on the chain that it came in through while it is inside, else by
//! crossing, else ahead of the nearest feature.
//!
//! Groups come with their candidates; touches go to the tracker. Every candidate is swept in every step,
//! whatever is known of the node, unless it is so far that it can't have come near (`sleep.rs`): the level of
//! a group, the sum of entries less exits, is the proof that none was missed.

use super::super::Sweep;
use super::super::projection::node_segment::{Held, Projection, Target, Vector};
use super::ends::Ends;
use super::group::Group;
use super::sleep::{awake, wake_at};
use super::steady::Stays;
use super::{Certificate, ContactHistory, ContactPoint, Found};
use crate::mesh::surface::NONE;
use crate::vector::{bound_of, minus};
use embate_lanes::{BATCH, Level};

/// A node nearer than this fraction of the skin is on the surface, as far as rounding can resolve.
const ROUNDING: f64 = 4e-9;
/// A node that touches a face stays with it until it is farther away than this fraction of the skin (a
/// millionth of a segment): surfaces that a multiplier holds at zero distance must not be passed from face to
/// face of a corner by round-off.
const HOLD: f64 = 4e-6;

/// Nodes are seen that may come in with so many times the last motion, and this fraction of the skin (half a
/// per cent of a segment) for those that are set in motion now.
const LOOK_AHEAD: f64 = 4.0;
const START: f64 = 0.02;

/// Groups of a pass from number `first` on, what is kept of them, and until when they sleep.
pub(super) struct Located<'a> {
    pub(super) first: usize,
    pub(super) groups: &'a mut [Group],
    pub(super) kept: &'a mut [ContactHistory],
    pub(super) wakes: &'a mut [f64],
}

/// What locating reads.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    target: &'a Target,
    candidates: &'a [u32],
    /// Surface of the slaves, and what is known of ends.
    slaves: &'a Target,
    ends: &'a Ends,
    pass: usize,
    /// Whether slaves and targets are one surface.
    own_surface: bool,
    /// Distances below this are rounding, m.
    rounding: f64,
    /// Distances below this are touching, m.
    hold: f64,
    /// Distance at which nodes are seen that do not move, m.
    near: f64,
    /// Distance over which the law acts, m; 0: on the surface alone.
    acts_over: f64,
    sweep: Sweep<'a, 2>,
    /// Who wakes later sleeps on.
    awake: f64,
    level: Level,
}

/// What the candidates of a group did in a step.
#[derive(Default)]
struct Passages {
    exits: i32,
    /// First and last entry: time and segment.
    first: Option<(f64, u32)>,
    last: Option<(f64, u32)>,
}

impl<'a> View<'a> {
    /// `[slaves, target]` of the pass.
    pub(super) fn new(
        [slaves, target]: [&'a Target; 2],
        ends: &'a Ends,
        candidates: &'a [u32],
        pass: usize,
        [skin, extra]: [f64; 2],
        (sweep, way): (Sweep<'a, 2>, f64),
    ) -> Self {
        let (own_surface, near) = (std::ptr::eq(slaves, target), extra + START * skin);
        let (rounding, hold, awake) = (ROUNDING * skin, HOLD * skin, awake(near, LOOK_AHEAD, sweep.travel, way));
        Self {
            target,
            candidates,
            slaves,
            ends,
            pass,
            own_surface,
            rounding,
            hold,
            near,
            acts_over: extra,
            sweep,
            awake,
            level: Level::best(),
        }
    }

    /// Locates those of the groups that do not sleep.
    pub(super) fn look_at(&self, located: Located<'_>, found: &mut Found) {
        let Located { first, groups, kept, wakes } = located;
        let mut stays = Stays::NONE;
        for number in 0..groups.len() {
            if number % BATCH == 0 {
                let eight = number..(number + BATCH).min(groups.len());
                let is_awake = |lane: usize| wakes[number + lane] <= self.awake;
                stays = Stays::find(&groups[eight], self.candidates, is_awake, self.target, self.sweep, self.hold, self.level);
            }
            let wake = &mut wakes[number];
            if *wake > self.awake {
                continue;
            }
            let group = &mut groups[number];
            let candidates = &self.candidates[group.begin as usize..group.end as usize];
            let mut clear = f64::NEG_INFINITY;
            let projection = match stays.projection(number % BATCH, group.memory) {
                None => self.locate(group, candidates, &mut clear, &mut found.certificate),
                stays => stays,
            };
            let touched = std::mem::replace(&mut group.touches, projection.is_some());
            match projection {
                Some(projection) => {
                    let Group { slave, node, own, .. } = *group;
                    let slope = self.ends.slope(slave, &projection, self.target, self.sweep.new);
                    let (pass, group) = (self.pass as u32, (first + number) as u32);
                    found.touches.push(ContactPoint { pass, slave, node, projection, slope, group, own });
                }
                None => {
                    if touched {
                        kept[number] = ContactHistory::default();
                    }
                    if !group.matters() && !candidates.iter().any(|&segment| self.ends.is_near(segment)) {
                        *wake = wake_at(clear, self.sweep.travel);
                    }
                }
            }
        }
    }

    /// The projection of a group that touches or may come to it. Of one that does not, `clear` says how far
    /// its candidates are away, as far as that is known.
    fn locate(&self, group: &mut Group, candidates: &[u32], clear: &mut f64, certificate: &mut Certificate) -> Option<Projection> {
        let x = self.sweep.new[group.node as usize];
        let passages = self.sweep_through(group.node, candidates);
        group.level -= passages.exits;
        let was_inside = group.memory != NONE;
        if was_inside {
            let projection = self.follow(x, group.memory, group).filter(|projection| projection.gap <= self.hold);
            if let Some(inside) = projection {
                group.memory = inside.segment;
                return projection;
            }
            group.memory = NONE;
        }
        if group.open && (was_inside || passages.first.is_none()) {
            // What goes around an end is not seen: only what comes in counts.
            group.level = 0;
        }
        // Who just left may have been beyond a thin body: on its way back it goes through the far side, but
        // does not come in there.
        let entries = if !was_inside {
            [passages.first, passages.last]
        } else if group.level > 0 {
            [passages.last, None]
        } else {
            [None, None]
        };
        for (_, segment) in entries.into_iter().flatten() {
            if let Some(inside) = self.inside(x, segment, group).filter(|inside| self.may_hold(group, inside)) {
                group.memory = inside.segment;
                certificate.crossings_found += 1;
                return Some(inside);
            }
        }
        if group.level > 0 && !group.open {
            let nearest = self.target.nearest(x, candidates, self.sweep.new).map(|nearest| self.rightful(x, group, nearest));
            if let Some(inside) = nearest.filter(|nearest| nearest.gap < 0.0 && !group.own) {
                group.memory = inside.segment;
                return Some(inside);
            }
            if nearest.is_none_or(|nearest| nearest.gap.abs() > self.rounding) {
                // The faces of a closed crack overlap: who leaves through one of them is still behind the
                // other.
                if let Some(inside) = self.behind(x, group, candidates) {
                    group.memory = inside.segment;
                    return Some(inside);
                }
                certificate.unverified += 1;
            }
        }
        let (nearest, ahead) = match entries[0] {
            // In and out again through another face.
            Some((_, segment)) => (segment, self.follow(x, segment, group)),
            None => {
                let ahead = self.target.look_ahead(x, candidates, self.rounding, self.sweep.new);
                *clear = ahead.clear;
                ahead.first?
            }
        };
        let beside = if self.ends.is_near(nearest) && !group.own { self.beside(x, group, nearest) } else { None };
        let at_end = |ahead: Projection| if self.ends.is_near(ahead.segment) { self.at_end(x, group, ahead) } else { Some(ahead) };
        let ahead = beside.or_else(|| ahead.and_then(at_end))?;
        if ahead.gap > self.hold {
            return (ahead.gap <= self.near + LOOK_AHEAD * self.motion(group.node, ahead.segment)).then_some(ahead);
        }
        let touched = if beside.is_none() { self.touched(group, candidates).unwrap_or(ahead) } else { ahead };
        if self.may_hold(group, &touched) {
            group.memory = touched.segment;
        }
        Some(touched)
    }

    /// As [`Ends::admit`]; a surface that meets itself has no ends in this sense.
    fn may_hold(&self, group: &Group, projection: &Projection) -> bool {
        group.own || self.ends.admit(&self.slaves.surface, self.target, group.slave, projection, self.sweep.new)
    }

    /// What a node is ahead of where faces end: `ahead`, or the face around the edge, if it is that which the
    /// node's own surface goes back over; nothing for a node that only passes by, over the end of a face or
    /// hardly beyond it. Where the law acts over a distance, a node in front of an edge has that distance
    /// from it whichever way it goes: the edge is round then, and has no end.
    fn at_end(&self, x: Vector, group: &Group, ahead: Projection) -> Option<Projection> {
        if self.may_hold(group, &ahead) || (self.acts_over > 0.0 && ahead.gap > self.hold) {
            return Some(ahead);
        }
        let (surface, nearest) = (&self.target.surface, ahead.segment);
        let around = [surface.previous[nearest as usize], surface.next[nearest as usize], nearest];
        let mut is_passed = false;
        for segment in around.into_iter().filter(|&segment| segment != NONE) {
            let Some(seen) = self.target.seen(x, segment, self.sweep.new) else { continue };
            // Below the end of the face around the edge that face is no matter any more.
            if self.ends.is_over_end(group.slave, segment, &seen) && (segment == nearest || seen.gap >= -self.hold) {
                if segment != nearest
                    && let Some(other) = self.target.project(x, segment, self.sweep.new)
                    && self.may_hold(group, &other)
                {
                    return Some(other);
                }
                is_passed = true;
            }
        }
        (!is_passed).then_some(ahead)
    }

    /// The projection on a face, or on that around the edge where the node may not be in contact through the
    /// first.
    fn rightful(&self, x: Vector, group: &Group, nearest: Projection) -> Projection {
        if self.may_hold(group, &nearest) {
            return nearest;
        }
        let surface = &self.target.surface;
        let around = if nearest.weights[1] > 0.5 { &surface.next } else { &surface.previous }[nearest.segment as usize];
        let other = (around != NONE).then(|| self.target.project(x, around, self.sweep.new)).flatten();
        other.filter(|other| other.gap < 0.0).unwrap_or(nearest)
    }

    /// The projection on the face of another body that a node is least behind.
    fn behind(&self, x: Vector, group: &Group, candidates: &[u32]) -> Option<Projection> {
        let faces = candidates.iter().filter(|_| !group.own).filter_map(|&segment| self.target.project(x, segment, self.sweep.new));
        let behind = faces.filter(|face| face.gap < 0.0 && self.may_hold(group, face));
        behind.reduce(|best, other| if other.gap > best.gap { other } else { best })
    }

    /// The projection of a node that is beyond the end of a face near the segment `nearest`, if it is held
    /// there.
    fn beside(&self, x: Vector, group: &Group, nearest: u32) -> Option<Projection> {
        let surface = &self.target.surface;
        let x_old = self.sweep.old[group.node as usize];
        let held = |segment: u32| {
            let band = self.ends.band(group.slave, segment);
            let beyond = self.target.beyond(x, segment, band, self.sweep.new)?;
            let at = (group.slave, segment, usize::from(beyond.weights[1] > 0.5));
            let comes = Ends::comes_over(self.target, &beyond, band, [x_old, x], self.hold, self.sweep);
            (comes && self.ends.overlaps(&self.slaves.surface, self.target, at, self.sweep.new)).then_some(beyond)
        };
        let around = [nearest, surface.previous[nearest as usize], surface.next[nearest as usize]];
        around.into_iter().filter(|&segment| segment != NONE).find_map(held)
    }

    /// Bound of how much the gap between a node and a segment changed in the step, m.
    fn motion(&self, node: u32, segment: u32) -> f64 {
        let way = |node: u32| {
            let (a, b) = (self.sweep.old[node as usize], self.sweep.new[node as usize]);
            [b[0] - a[0], b[1] - a[1]]
        };
        let own = way(node);
        let against = |end: u32| bound_of(minus(own, way(end)));
        let [a, b] = self.target.surface.segments[segment as usize];
        against(a).max(against(b))
    }

    /// Of the faces that a node touches, that from which it was farthest before: the one that it comes upon.
    fn touched(&self, group: &Group, candidates: &[u32]) -> Option<Projection> {
        let (x_old, x) = (self.sweep.old[group.node as usize], self.sweep.new[group.node as usize]);
        let touches = |segment: u32| {
            let projection = self.target.project(x, segment, self.sweep.new)?;
            let before = self.target.side_of(x_old, segment, self.sweep.old)?;
            (projection.gap.abs() <= self.hold && self.may_hold(group, &projection)).then_some((before, projection))
        };
        let farther = |best: (f64, Projection), other: (f64, Projection)| if other.0 > best.0 { other } else { best };
        candidates.iter().filter_map(|&segment| touches(segment)).reduce(farther).map(|(_, projection)| projection)
    }

    /// The projection of a node that is inside, on the chain from `segment` on.
    fn inside(&self, x: Vector, segment: u32, group: &Group) -> Option<Projection> {
        self.follow(x, segment, group).filter(|projection| projection.gap < 0.0)
    }

    fn follow(&self, x: Vector, segment: u32, group: &Group) -> Option<Projection> {
        let own = if self.own_surface { group.node } else { NONE };
        let held = Held { band: self.ends.band(group.slave, segment), gap: self.hold };
        self.target.follow_without(x, segment, own, held, self.sweep.new)
    }

    fn sweep_through(&self, node: u32, candidates: &[u32]) -> Passages {
        let (x_old, x) = (self.sweep.old[node as usize], self.sweep.new[node as usize]);
        let mut passages = Passages::default();
        for &segment in candidates {
            let Some(passage) = self.target.passage(x_old, x, segment, self.sweep.old, self.sweep.new) else { continue };
            passages.exits += passage.exits;
            if let Some(time) = passage.entered {
                if passages.first.is_none_or(|(first, _)| time < first) {
                    passages.first = Some((time, segment));
                }
                if passages.last.is_none_or(|(last, _)| time >= last) {
                    passages.last = Some((time, segment));
                }
            }
        }
        passages
    }
}
