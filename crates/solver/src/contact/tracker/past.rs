//! What a tracker takes over from the one before it when surfaces change: who was inside through which segment, slips, counts.
//!
//! Segments and bodies have new numbers then, so everything is found again by nodes. Levels are counted anew against the new surfaces, at the beginning of the step
//! (`start.rs`), and the step itself is swept as any other: whatever came in or left is proven as before. Who was inside through a segment that is no more is outside, unless the new
//! surfaces say otherwise.

use super::Tracker;
use super::certificate::SearchReport;
use super::group::{Group, Pass};
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
        self.certificate = old.certificate;
        self.reach.report = SearchReport { skin: self.reach.report.skin, ..old.reach.report };
        if old.reach.is_new() {
            return;
        }
        let recalled = |(number, pass): (usize, &Pass)| {
            let before = &old.passes[number];
            let mut segments: Vec<u32> = before.groups.iter().map(|group| group.memory).collect();
            for touch in old.touches.iter().filter(|touch| touch.pass == number) {
                let segment = &mut segments[touch.group];
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
    /// Groups of `before` that are still possible, ascending; `segments` are those that each group touches. Surfaces: slaves and target, old and new.
    fn recalled(&self, before: &Self, segments: &[u32], [old_slaves, old_target, slaves, target]: [&Target; 4]) -> Vec<Group> {
        let by_nodes = ByNodes::new(target);
        let neighbours = |pass: &Self, surface: &Target, slave: u32| {
            let around = pass.ends.around.get(slave as usize).copied().unwrap_or([NONE; 2]);
            around.map(|segment| surface.surface.segments.get(segment as usize).copied())
        };
        let of = |(group, &segment): (&Group, &u32)| {
            let nodes = *old_target.surface.segments.get(segment as usize)?;
            let (segment, slave) = (by_nodes.find(nodes)?, slaves.surface.nodes.binary_search(&group.node).ok()? as u32);
            let mut now = self.group(slave, group.node, self.segment_bodies[segment as usize]);
            if group.memory != NONE {
                (now.memory, now.level) = (segment, group.level);
            }
            now.kept = group.kept;
            if neighbours(before, old_slaves, group.slave) != neighbours(self, slaves, slave) {
                now.kept.faces = 0;
            }
            Some(now)
        };
        let mut recalled: Vec<Group> = before.groups.iter().zip(segments).filter_map(of).collect();
        recalled.sort_by_key(Group::key);
        recalled.dedup_by_key(|group| group.key());
        recalled
    }

    /// Adds what groups knew to those that the first search and `start` have found.
    pub(super) fn recall(&mut self, recalled: &[Group]) {
        for &past in recalled {
            match self.groups.binary_search_by_key(&past.key(), Group::key) {
                Ok(at) => {
                    let group = &mut self.groups[at];
                    group.kept = past.kept;
                    if past.memory != NONE {
                        group.memory = past.memory;
                        // Nobody is inside its own body at a start.
                        if past.own {
                            group.level = past.level;
                        }
                    }
                }
                Err(at) => {
                    let here = self.groups.get(at).map_or(self.candidates.len() as u32, |next| next.begin);
                    let level = if past.own { past.level } else { 0 };
                    self.groups.insert(at, Group { begin: here, end: here, level, ..past });
                }
            }
        }
    }
}
