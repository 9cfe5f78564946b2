//! What a tracker takes over from the one before it when surfaces change: who was inside through which
//! segment, slips, counts.
//!
//! Segments and bodies have new numbers then, so everything is found again by nodes. Levels are counted again
//! against the new surfaces, at the beginning of the step (`start.rs`), and the step itself is swept as any
//! other: whatever came in or left is proven as before. Who was inside through a segment that is no more is
//! outside, unless the new surfaces say otherwise.

use super::group::{Group, Pass};
use super::{ContactHistory, Tracker};
use crate::contact::projection::node_segment::Target;
use crate::mesh::surface::NONE;

/// Segments of a surface by their nodes.
struct ByNodes(Vec<([u32; 2], u32)>);

impl ByNodes {
    fn new(target: &Target) -> Self {
        let mut list: Vec<([u32; 2], u32)> = target.surface.segments.iter().copied().zip(0..).collect();
        list.sort_unstable();
        Self(list)
    }

    fn find(&self, nodes: [u32; 2]) -> Option<u32> {
        self.0.binary_search_by_key(&nodes, |&(nodes, _)| nodes).ok().map(|at| self.0[at].1)
    }
}

impl Tracker {
    /// Takes over what `old` knows, which followed the same passes over surfaces that are no more.
    pub fn inherit(&mut self, old: &Self) {
        self.found.certificate = old.found.certificate;
        self.reach.inherit(&old.reach);
        if old.reach.is_new() {
            return;
        }
        let recalled = |(number, pass): (usize, &Pass)| {
            let before = &old.passes[number];
            let mut segments: Vec<u32> = before.groups.iter().map(|group| group.memory).collect();
            for touch in old.found.touches.iter().filter(|touch| touch.pass as usize == number) {
                let segment = &mut segments[touch.group as usize];
                if *segment == NONE {
                    *segment = touch.projection.segment;
                }
            }
            let targets = [&old.targets[before.slave], &old.targets[before.target], &self.targets[pass.slave], &self.targets[pass.target]];
            pass.recalled(before, &segments, targets)
        };
        self.past = Some(self.passes.iter().enumerate().map(recalled).collect());
    }
}

impl Pass {
    /// Groups of `before` that are still possible, ascending; `segments` are those that each group touches.
    /// Surfaces: slaves and target, old and new.
    fn recalled(
        &self,
        before: &Self,
        segments: &[u32],
        [old_slaves, old_target, slaves, target]: [&Target; 4],
    ) -> Vec<(Group, ContactHistory)> {
        let by_nodes = ByNodes::new(target);
        let neighbours = |pass: &Self, surface: &Target, slave: u32| {
            let around = pass.ends.around.get(slave as usize).copied().unwrap_or([NONE; 2]);
            around.map(|segment| surface.surface.segments.get(segment as usize).copied())
        };
        let of = |((group, &kept), &segment): ((&Group, &ContactHistory), &u32)| {
            let nodes = *old_target.surface.segments.get(segment as usize)?;
            let (segment, slave) = (by_nodes.find(nodes)?, slaves.surface.nodes.binary_search(&group.node).ok()? as u32);
            let mut now = self.group(slave, group.node, self.segment_bodies[segment as usize]);
            if group.memory != NONE {
                (now.memory, now.level) = (segment, group.level);
            }
            now.touches = group.touches;
            let is_as_before = neighbours(before, old_slaves, group.slave) == neighbours(self, slaves, slave);
            Some((now, if is_as_before { kept } else { ContactHistory { faces: 0, ..kept } }))
        };
        let mut recalled: Vec<_> = before.groups.iter().zip(&before.kept).zip(segments).filter_map(of).collect();
        recalled.sort_by_key(|(group, _)| group.key());
        recalled.dedup_by_key(|(group, _)| group.key());
        recalled
    }

    /// Adds what groups knew to those that the first search and `start` have found.
    pub(super) fn recall(&mut self, recalled: &[(Group, ContactHistory)]) {
        for &(past, kept) in recalled {
            match self.groups.binary_search_by_key(&past.key(), Group::key) {
                Ok(at) => {
                    let group = &mut self.groups[at];
                    (group.touches, self.kept[at]) = (past.touches, kept);
                    if past.memory != NONE {
                        group.memory = past.memory;
                        // No one is inside its own body at a start.
                        if past.own {
                            group.level = past.level;
                        }
                    }
                }
                Err(at) => {
                    let here = self.groups.get(at).map_or(self.candidates.len() as u32, |next| next.begin);
                    let level = if past.own { past.level } else { 0 };
                    self.groups.insert(at, Group { begin: here, end: here, level, ..past });
                    self.kept.insert(at, kept);
                }
            }
        }
    }
}
