//! Groups of a slave node and a body, with their candidates and what they remember; carried over from search
//! to search.
//!
//! Storage is flat and kept: nothing is allocated once it has grown to the size of the problem.

use super::super::Sweep;
use super::super::projection::node_segment::{Target, Vector};
use super::super::search::Query;
use super::ContactHistory;
use super::ends::Ends;
use super::locate::{Located, View};
use super::reach::{Reach, SLACK};
use super::sleep::AWAKE;
use crate::archive::{Archive, ArchiveResult, Persist, persist_all, persist_each};
use crate::mesh::surface::NONE;

/// A slave node and a body of the target surface. Half a cache line: anyone who is awake is read in every
/// step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Group {
    /// Index of the node in its surface.
    pub(super) slave: u32,
    pub(super) node: u32,
    pub(super) body: u32,
    /// Its candidates are `candidates[begin..end]`.
    pub(super) begin: u32,
    pub(super) end: u32,
    /// Segment through which the node came in; [`NONE`] while it is outside.
    pub(super) memory: u32,
    /// How often the node went into the body less how often it left: 0 outside.
    pub(super) level: i32,
    /// Whether it is the node's own body.
    pub(super) own: bool,
    /// Whether the body's surface has ends: then a node can get around it, and the level is no proof.
    pub(super) open: bool,
    /// Whether it touched in the last step. Else nothing is kept of it.
    pub(super) touches: bool,
}

persist_all!(Group { slave, node, body, begin, end, memory, level, own, open, touches });

impl Default for Group {
    fn default() -> Self {
        Self { slave: 0, node: 0, body: 0, begin: 0, end: 0, memory: NONE, level: 0, own: false, open: false, touches: false }
    }
}

impl Group {
    pub(super) fn key(&self) -> (u32, u32) {
        (self.slave, self.body)
    }

    /// Whether it knows something that must not be forgotten.
    pub(super) fn matters(&self) -> bool {
        self.memory != NONE || self.level != 0
    }
}

/// More often no node has gone into a body.
const LEVELS: u32 = 1 << 24;

/// One pass: nodes of one surface against another, or the same.
pub(super) struct Pass {
    pub(super) slave: usize,
    pub(super) target: usize,
    /// Body of each slave node, and of each segment of the target.
    pub(super) slave_bodies: Vec<u32>,
    pub(super) segment_bodies: Vec<u32>,
    /// Bodies whose surface has ends, ascending.
    pub(super) open: Vec<u32>,
    /// Segments on symmetry lines that would close the target, and their bodies.
    pub(super) lids: Vec<([u32; 2], u32)>,
    /// Ascending by slave and body.
    pub(super) groups: Vec<Group>,
    /// What is kept of each group while it touches.
    pub(super) kept: Vec<ContactHistory>,
    /// Until when each group sleeps: see [`super::sleep`].
    pub(super) wakes: Vec<f64>,
    pub(super) candidates: Vec<u32>,
    pub(super) ends: Ends,
    /// Groups of the last search and what is kept of them.
    spare: (Vec<Group>, Vec<ContactHistory>),
    /// Candidates (body, segment) of one slave.
    found: Vec<(u32, u32)>,
}

impl Pass {
    pub(super) fn new(slave: usize, target: usize, targets: &[Target]) -> Self {
        let slave_bodies = vec![slave as u32; targets[slave].surface.nodes.len()];
        let segment_bodies = vec![target as u32; targets[target].surface.segments.len()];
        let mut pass = Self {
            slave,
            target,
            slave_bodies,
            segment_bodies,
            open: Vec::new(),
            lids: Vec::new(),
            groups: Vec::new(),
            kept: Vec::new(),
            wakes: Vec::new(),
            candidates: Vec::new(),
            ends: Ends::default(),
            spare: Default::default(),
            found: Vec::new(),
        };
        pass.find_open(&targets[target]);
        pass
    }

    pub(super) fn set_bodies(&mut self, targets: &[Target], bodies: &[u32], lids: &[[u32; 2]]) {
        // Nodes beyond the model's are no part of its bodies.
        let of = |node: u32| bodies.get(node as usize).copied().unwrap_or(u32::MAX);
        self.slave_bodies = targets[self.slave].surface.nodes.iter().map(|&node| of(node)).collect();
        self.segment_bodies = targets[self.target].surface.segments.iter().map(|&[node, _]| of(node)).collect();
        self.lids = lids.iter().map(|&lid| (lid, of(lid[0]))).collect();
        self.find_open(&targets[self.target]);
    }

    /// Keeps groups, what they remember, and what the last search found.
    pub(super) fn persist(&mut self, targets: &[Target], archive: &mut Archive<'_>) -> ArchiveResult {
        #[rustfmt::skip]
        let Self {
            slave: _, target: _, slave_bodies: _, segment_bodies: _, open: _, lids: _, spare: _, found: _,
            groups, kept, wakes, candidates, ends,
        } = self;
        persist_each!(archive; groups, kept, wakes, candidates);
        ends.persist(archive)?;
        archive
            .check(kept.len() == groups.len() && wakes.len() == groups.len(), "a contact remembers more or fewer nodes than it follows")?;
        let is_known = self.groups.iter().all(|group| self.is_known(group, targets));
        let are_there = self.candidates.iter().all(|&segment| (segment as usize) < self.segment_bodies.len());
        archive.check(is_known && are_there, "a contact follows nodes or segments that are not there")
    }

    /// Whether all that a group names is there.
    pub(super) fn is_known(&self, group: &Group, targets: &[Target]) -> bool {
        targets[self.slave].surface.nodes.get(group.slave as usize) == Some(&group.node)
            && group.begin <= group.end
            && group.end as usize <= self.candidates.len()
            && group.level.unsigned_abs() < LEVELS
            && (group.memory == NONE || (group.memory as usize) < self.segment_bodies.len())
    }

    pub(super) fn forget(&mut self) {
        self.groups.clear();
        self.kept.clear();
        self.wakes.clear();
        self.candidates.clear();
    }

    /// Begins the groups again; those that there are become the spare ones.
    fn begin_groups(&mut self) {
        std::mem::swap(&mut self.groups, &mut self.spare.0);
        std::mem::swap(&mut self.kept, &mut self.spare.1);
        self.groups.clear();
        self.kept.clear();
    }

    fn add(&mut self, group: Group, kept: ContactHistory) {
        self.groups.push(group);
        self.kept.push(kept);
    }

    fn find_open(&mut self, target: &Target) {
        let is_mirrored = |node: u32| target.mirrors.binary_search_by_key(&node, |&(node, _)| node).is_ok();
        let surface = &target.surface;
        let ends = surface.segments.iter().zip(surface.previous.iter().zip(&surface.next)).zip(&self.segment_bodies);
        let is_end = |segment: [u32; 2], previous: u32, next: u32| {
            (previous == NONE && !is_mirrored(segment[0])) || (next == NONE && !is_mirrored(segment[1]))
        };
        self.open = ends.filter(|((segment, (previous, next)), _)| is_end(**segment, **previous, **next)).map(|(_, &body)| body).collect();
        self.open.sort_unstable();
        self.open.dedup();
    }

    pub(super) fn is_open(&self, body: u32) -> bool {
        self.open.binary_search(&body).is_ok()
    }

    /// What locating needs: the groups, which it changes, and what it only reads.
    pub(super) fn view<'a>(
        &'a mut self,
        targets: &'a [Target],
        number: usize,
        skin_and_extra: [f64; 2],
        (sweep, way): (Sweep<'a, 2>, f64),
    ) -> (Located<'a>, View<'a>) {
        let surfaces = [&targets[self.slave], &targets[self.target]];
        let view = View::new(surfaces, &self.ends, &self.candidates, number, skin_and_extra, (sweep, way));
        (Located { first: 0, groups: &mut self.groups, kept: &mut self.kept, wakes: &mut self.wakes }, view)
    }

    /// Global search, then a filter by distance: candidates are the same whatever the search, and few.
    pub(super) fn search(&mut self, targets: &[Target], sweep: Sweep<'_, 2>, distance: f64, reach: &mut Reach<2>) {
        let target = &targets[self.target];
        self.ends.find(target, sweep.new);
        let slaves = &targets[self.slave].surface.nodes;
        let query =
            Query { positions_old: sweep.old, positions_new: sweep.new, slaves, facets: &target.surface.segments, reach: SLACK * distance };
        reach.search.pairs(&query, &mut reach.pairs);
        self.begin_groups();
        self.candidates.clear();
        let mut old = 0;
        for pairs in reach.pairs.chunk_by(|a, b| a.slave == b.slave) {
            let slave = pairs[0].slave;
            let node = slaves[slave as usize];
            // A node of two surfaces joins them: it can't go in. In a surface with itself only its own
            // segments are left out, by the search.
            if self.slave != self.target && target.surface.nodes.binary_search(&node).is_ok() {
                continue;
            }
            let (x_old, x) = (sweep.old[node as usize], sweep.new[node as usize]);
            let comes_near = |segment: u32| {
                target.distance(x, segment, sweep.new).is_some_and(|found| found <= distance)
                    || target.crossing(x_old, x, segment, sweep.old, sweep.new).is_some()
            };
            self.found.clear();
            let near = pairs.iter().map(|pair| pair.facet).filter(|&segment| comes_near(segment));
            self.found.extend(near.map(|segment| (self.segment_bodies[segment as usize], segment)));
            self.found.sort_unstable();
            self.add_groups(slave, node, &mut old);
        }
        self.keep_until(&mut old, (u32::MAX, u32::MAX));
        self.wakes.clear();
        self.wakes.resize(self.groups.len(), AWAKE);
    }

    /// New groups of a slave from its candidates, with what the old ones from number `old` on remember.
    fn add_groups(&mut self, slave: u32, node: u32, old: &mut usize) {
        let found = std::mem::take(&mut self.found);
        for candidates in found.chunk_by(|a, b| a.0 == b.0) {
            let body = candidates[0].0;
            self.keep_until(old, (slave, body));
            let begin = self.candidates.len() as u32;
            self.candidates.extend(candidates.iter().map(|&(_, segment)| segment));
            let end = self.candidates.len() as u32;
            match self.spare.0.get(*old).filter(|group| group.key() == (slave, body)) {
                Some(&group) => {
                    self.add(Group { begin, end, ..group }, self.spare.1[*old]);
                    *old += 1;
                }
                None => self.add(Group { begin, end, ..self.group(slave, node, body) }, ContactHistory::default()),
            }
        }
        self.found = found;
    }

    /// Old groups before `key` that matter, without candidates.
    fn keep_until(&mut self, old: &mut usize, key: (u32, u32)) {
        while let Some(&group) = self.spare.0.get(*old).filter(|group| group.key() < key) {
            if group.matters() {
                let here = self.candidates.len() as u32;
                self.add(Group { begin: here, end: here, ..group }, self.spare.1[*old]);
            }
            *old += 1;
        }
    }

    pub(super) fn group(&self, slave: u32, node: u32, body: u32) -> Group {
        let own = self.slave_bodies[slave as usize] == body;
        let open = self.is_open(body);
        Group { slave, node, body, begin: 0, end: 0, memory: NONE, level: 0, own, open, touches: false }
    }

    /// Adds groups without candidates, or changes memory and level of those that are there.
    pub(super) fn enter(&mut self, mut inside: Vec<Group>) {
        inside.sort_by_key(Group::key);
        self.begin_groups();
        let mut inside = inside.into_iter().peekable();
        for at in 0..self.spare.0.len() {
            let (group, kept) = (self.spare.0[at], self.spare.1[at]);
            while let Some(added) = inside.next_if(|added| added.key() < group.key()) {
                self.add(Group { begin: group.begin, end: group.begin, ..added }, ContactHistory::default());
            }
            let changed = inside.next_if(|added| added.key() == group.key());
            self.add(changed.map_or(group, |Group { memory, level, .. }| Group { memory, level, ..group }), kept);
        }
        let here = self.candidates.len() as u32;
        inside.for_each(|added| self.add(Group { begin: here, end: here, ..added }, ContactHistory::default()));
    }

    /// Candidates of a slave and a body.
    pub(super) fn candidates_of(&self, slave: usize, body: u32) -> &[u32] {
        let found = self.groups.binary_search_by_key(&(slave as u32, body), Group::key);
        found.map_or(&[], |at| &self.candidates[self.groups[at].begin as usize..self.groups[at].end as usize])
    }

    /// Position of a slave.
    pub(super) fn place(&self, targets: &[Target], slave: usize, positions: &[Vector]) -> (u32, Vector) {
        let node = targets[self.slave].surface.nodes[slave];
        (node, positions[node as usize])
    }
}
