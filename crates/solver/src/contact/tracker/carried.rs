//! What a tracker takes over from the one before it when elements were made again: nodes and segments are
//! others then, in the places where the old ones were.
//!
//! A node lies between two old nodes of the outline, and has of what is kept of them its share. The segment
//! through which they came in is now the one where their projection lies. Levels are counted again at the
//! beginning of the next step, as in `past.rs`; in a node's own body the side of that segment decides.
//!
//! Surfaces with ends have no levels. What is in them is known by memory alone, so a node that is lost is
//! never found again. There a new node comes from the nearest old one on the straight way to its place, and
//! what it goes through is counted as in a step: of two old nodes beside a corner one may be in contact with
//! one side and one with the other, and on a curve both may be in front of it and the new one behind.

use super::group::{Group, Pass};
use super::{ContactHistory, ContactPoint, Origins, Tracker};
use crate::contact::continuity::SpringHistory;
use crate::contact::initial::moved_by;
use crate::contact::projection::node_segment::{Projection, Target, Vector};
use crate::mesh::surface::NONE;
use crate::vector::{dot, minus, plus, times};

/// What an old node had to do with a body.
struct Former<'a> {
    group: &'a Group,
    kept: &'a ContactHistory,
    /// Part of it that the new node has.
    share: f64,
    /// Where it projects on the body, m, and along which direction its surface runs there.
    foot: [Vector; 2],
    /// Gap of its spring, m; `None`: it had none.
    gap: Option<f64>,
}

impl Tracker {
    /// Takes over what `old` knows, which followed the same passes before elements were made again.
    pub(in crate::contact) fn carry(&mut self, old: &Self, origins: &Origins<'_, 2>) {
        self.reach.inherit(&old.reach);
        if old.reach.is_new() {
            return;
        }
        let carried = |(number, pass): (usize, &Pass)| {
            let before = &old.passes[number];
            let mut touches: Vec<Option<&ContactPoint>> = vec![None; before.groups.len()];
            for touch in old.found.touches.iter().filter(|touch| touch.pass as usize == number) {
                touches[touch.group as usize] = Some(touch);
            }
            let surfaces = [&old.targets[before.slave], &old.targets[before.target], &self.targets[pass.slave], &self.targets[pass.target]];
            pass.carried(before, &touches, surfaces, origins)
        };
        self.past = Some(self.passes.iter().enumerate().map(carried).collect());
    }
}

impl Pass {
    /// Groups that continue those of `before`, ascending; `touches` of these in the last step. Surfaces:
    /// slaves and target, old and new.
    fn carried(
        &self,
        before: &Self,
        touches: &[Option<&ContactPoint>],
        [old_slaves, old_target, slaves, target]: [&Target; 4],
        origins: &Origins<'_, 2>,
    ) -> Vec<(Group, ContactHistory)> {
        let former = |at: usize, share: f64| {
            let (group, kept, touch) = (&before.groups[at], &before.kept[at], touches[at]);
            let foot = foot(group, touch, old_target, origins.before)?;
            Some(Former { group, kept, share, foot, gap: touch.map(|touch| touch.projection.gap - kept.spring.offset) })
        };
        let mut carried: Vec<(Group, ContactHistory)> = Vec::new();
        for (slave, &node) in (0..).zip(&slaves.surface.nodes) {
            let mut formers: Vec<Former<'_>> = Vec::new();
            for &(from, share) in &origins.nodes[node as usize] {
                let Ok(own) = old_slaves.surface.nodes.binary_search(&from) else { continue };
                let first = before.groups.partition_point(|group| (group.slave as usize) < own);
                let count = before.groups[first..].iter().take_while(|group| group.slave as usize == own).count();
                formers.extend((first..first + count).filter_map(|at| former(at, share)));
            }
            formers.sort_by_key(|former| former.group.body);
            let first = carried.len();
            let of_body = formers.chunk_by(|a, b| a.group.body == b.group.body);
            carried.extend(of_body.filter_map(|formers| self.continued((slave, node), formers, target, origins)));
            if origins.is_as_before(node) {
                continue;
            }
            // What was near none of them may be behind one now.
            let own = self.slave_bodies[slave as usize];
            for &body in self.open.iter().filter(|&&body| body != own) {
                let is_known = carried[first..].iter().any(|(group, _)| group.body == body);
                if let Some(found) = (!is_known).then(|| self.side((node, body), &[], target, origins)).flatten() {
                    carried.push((Group { memory: found.segment, ..self.group(slave, node, body) }, ContactHistory::default()));
                }
            }
        }
        carried.sort_by_key(|(group, _)| group.key());
        carried.dedup_by_key(|(group, _)| group.key());
        carried
    }

    /// The group of a slave and a body that continues those of the nodes that it lies between.
    fn continued(
        &self,
        (slave, node): (u32, u32),
        formers: &[Former<'_>],
        target: &Target,
        origins: &Origins<'_, 2>,
    ) -> Option<(Group, ContactHistory)> {
        let nearest = formers.iter().reduce(|most, own| if own.share > most.share { own } else { most })?;
        let segment = at_place(nearest.foot, target, origins.positions)?;
        let mut group = self.group(slave, node, self.segment_bodies[segment as usize]);
        group.touches = formers.iter().any(|former| former.group.touches);
        let mut now = target.follow(origins.positions[node as usize], segment, origins.positions);
        let was_inside = formers.iter().any(|former| former.group.memory != NONE);
        if group.own {
            if let Some(inside) = now.filter(|projection| was_inside && projection.gap < 0.0) {
                (group.memory, group.level) = (inside.segment, 1);
            }
        } else if !group.open || origins.is_as_before(node) {
            group.memory = if was_inside { segment } else { NONE };
        } else if let Some(found) = self.side((node, group.body), formers, target, origins) {
            (group.memory, now) = (found.segment, Some(found));
        }
        let shares: f64 = formers.iter().map(|former| former.share).sum();
        let mean = |of: fn(&ContactHistory) -> f64| formers.iter().map(|former| former.share * of(former.kept)).sum::<f64>();
        // Where a spring was half a step ago, and with what energy, follows from where the node is now.
        let spring = SpringHistory { offset: offset(formers, now.map(|now| now.gap)), half: f64::NAN, stored: 0.0, ..nearest.kept.spring };
        let (slip, stiffness) = (mean(|kept| kept.slip), mean(|kept| kept.stiffness) / shares);
        // On both sides of a node that is where one was before, the surface is as before.
        let faces = if nearest.share == 1.0 { nearest.kept.faces } else { 0 };
        Some((group, ContactHistory { slip, spring, faces, stiffness }))
    }

    /// Where a node that comes from the nearest of the old ones projects on a body whose surface has ends, if
    /// it is inside.
    fn side(&self, (node, body): (u32, u32), formers: &[Former<'_>], target: &Target, origins: &Origins<'_, 2>) -> Option<Projection> {
        let from = origins.nearest(node)?;
        let (x_old, x) = (origins.before[from as usize], origins.positions[node as usize]);
        let former = formers.iter().find(|former| former.group.node == from);
        let passage = |segment: u32| target.passage(x_old, x, segment, origins.positions, origins.positions);
        let exits: i32 = self.segments_of(body).filter_map(passage).map(|passage| passage.exits).sum();
        let was_inside = former.is_some_and(|former| former.group.memory != NONE);
        if i32::from(was_inside) - exits <= 0 {
            return None;
        }
        // On the chain from where that one was, as anyone who moves; at a corner that may end.
        let place = former.and_then(|former| at_place(former.foot, target, origins.positions));
        let followed = place.and_then(|segment| target.follow(x, segment, origins.positions));
        let inside = followed.filter(|now| now.gap < 0.0);
        inside.or_else(|| self.behind(x, body, target, origins.positions)).or(followed)
    }

    /// The projection of a place on the segment of a body that it is behind, if it is.
    fn behind(&self, x: Vector, body: u32, target: &Target, positions: &[Vector]) -> Option<Projection> {
        let all: Vec<u32> = self.segments_of(body).collect();
        target.nearest(x, &all, positions).filter(|nearest| nearest.gap < 0.0)
    }

    fn segments_of(&self, body: u32) -> impl Iterator<Item = u32> + '_ {
        (0..).zip(&self.segment_bodies).filter(move |(_, of)| **of == body).map(|(segment, _)| segment)
    }
}

/// The gap that counts as zero, m, now that the gap is `now`: the new surfaces are off the old ones by what
/// the segments of a curve are off it, and the springs press as before.
fn offset(formers: &[Former<'_>], now: Option<f64>) -> f64 {
    let (mut sum, mut shares) = (0.0, 0.0);
    for former in formers {
        if let Some(gap) = former.gap {
            (sum, shares) = (sum + former.share * gap, shares + former.share);
        }
    }
    now.filter(|_| shares > 0.0).map_or(0.0, |now| moved_by(sum / shares, now))
}

/// Where a group projects on its body, m, and the direction of the segment there; `None`: it is known of
/// nowhere.
fn foot(group: &Group, touch: Option<&ContactPoint>, target: &Target, positions: &[Vector]) -> Option<[Vector; 2]> {
    let (segment, [a, b]) = match touch {
        Some(touch) => (touch.projection.segment, touch.projection.weights.map(|weight| weight.clamp(0.0, 1.0))),
        None if group.memory != NONE => (group.memory, [0.5; 2]),
        None => return None,
    };
    let [begin, end] = target.surface.segments.get(segment as usize)?.map(|node| positions[node as usize]);
    Some([plus(times(a, begin), times(b, end)), minus(end, begin)])
}

/// The segment of a surface that is nearest to a place, of those that look to the same side.
fn at_place([place, along]: [Vector; 2], target: &Target, positions: &[Vector]) -> Option<u32> {
    let of = |(number, &segment): (u32, &[u32; 2])| {
        let [begin, end] = segment.map(|node| positions[node as usize]);
        let looks_there = dot(minus(end, begin), along) > 0.0;
        looks_there.then(|| target.distance(place, number, positions))?.map(|distance| (number, distance))
    };
    let all = (0..).zip(&target.surface.segments).filter_map(of);
    all.reduce(|best, own| if own.1 < best.1 { own } else { best }).map(|(segment, _)| segment)
}
