//! Where slave nodes lie with respect to the bodies of target surfaces, from step to step: candidates from
//! the global search, the segment through which each node came in, and the projection of the step.
//!
//! Positions come from the step; what is found goes to the formulation, which makes springs of it. A slave
//! node and a body make a group with a memory of its own and at most one touch, so a node between two bodies,
//! or between another body and a fold of its own, meets both. Order is fixed: passes, then slave nodes, then
//! bodies ascending; so results depend neither on the search nor on the number of threads.

mod carried;
mod certificate;
mod ends;
mod group;
mod locate;
mod past;
mod reach;
pub(in crate::contact) mod sleep;
mod start;
mod steady;

pub use certificate::{Certificate, SearchReport};
pub use ends::is_facing;
pub use reach::SKIN;
pub(in crate::contact) use reach::{Reach, SLACK};

use super::continuity::SpringHistory;
use super::projection::node_segment::{Projection, Target, Vector};
use super::search::Search;
use super::{Origins, Sweep, length};
use crate::archive::{Archive, ArchiveResult, persist_all, persist_each};
use crate::mesh::surface::NONE;
use crate::vector::{bound_of, minus};
use ends::Ends;
use group::{Group, Pass};
use locate::Located;
use rayon::prelude::*;

/// A slave node that is inside a body, or within the skin of it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactPoint {
    /// Pass that found it.
    pub pass: u32,
    /// Index of the node in its surface.
    pub slave: u32,
    /// The node.
    pub node: u32,
    /// Where it lies.
    pub projection: Projection,
    /// Slope with which the face falls off there: 0 but beyond the end of a face.
    pub slope: f64,
    /// Number of the group of slave and body in this step.
    pub group: u32,
    /// Whether it is the node's own body.
    pub own: bool,
}

persist_all!(ContactPoint { pass, slave, node, projection, slope, group, own });

/// What a formulation keeps of a slave and a body while they touch.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactHistory {
    /// Elastic slip, m.
    pub slip: f64,
    /// Its spring.
    pub spring: SpringHistory<2>,
    /// Which of the segments at the slave node stand for it: 1 that which ends there, 2 that which begins
    /// there, 3 both; 0 not known.
    pub faces: u8,
    /// Stiffness of its spring by area, Pa/m; 0 not known.
    pub stiffness: f64,
}

persist_all!(ContactHistory { slip, spring, faces, stiffness });

/// Follows the nodes of surfaces along the bodies of other surfaces, or of their own.
pub struct Tracker {
    targets: Vec<Target>,
    passes: Vec<Pass>,
    reach: Reach<2>,
    /// Touches of this step, and what was checked so far.
    found: Found,
    /// What the chunks of groups found in this step.
    chunks: Vec<Found>,
    /// Way that no node had exceeded in the last step, m.
    travel: f64,
    /// What each pass recalls from before the surfaces changed, until the first search.
    past: Option<Vec<Vec<(Group, ContactHistory)>>>,
}

/// What groups were found to do.
#[derive(Default)]
struct Found {
    touches: Vec<ContactPoint>,
    certificate: Certificate,
}

/// The first search looks this much farther: surfaces with open ends may overlap at the start.
const FIRST: f64 = 4.0;
/// Groups that one task looks at.
const CHUNK: usize = 1024;
/// Fewer groups are looked at by one thread.
const SERIAL: usize = 4 * CHUNK;

impl Tracker {
    /// For the nodes of `targets[slave]` against `targets[target]` in each pass (slave, target), which may be
    /// the same surface; `positions` are the initial ones. Every surface counts as one body:
    /// [`Tracker::with_bodies`] reports more.
    #[must_use]
    pub fn new(targets: Vec<Target>, passes: &[(usize, usize)], search: Box<dyn Search<2>>, positions: &[Vector]) -> Self {
        let passes = passes.iter().map(|&(slave, target)| Pass::new(slave, target, &targets)).collect();
        let lengths = targets.iter().flat_map(|target| target.surface.segments.iter()).map(|&segment| length(segment, positions));
        let count = targets.iter().map(|target| target.surface.segments.len()).sum::<usize>().max(1);
        let nodes = targets.iter().flat_map(|target| target.surface.nodes.iter().copied());
        let reach = Reach::new(search, nodes, SKIN * lengths.sum::<f64>() / count as f64);
        Self { targets, passes, reach, found: Found::default(), chunks: Vec::new(), travel: 0.0, past: None }
    }

    /// With the body of each node of the model, and per surface the segments that were left out of it because
    /// they lie on a symmetry line.
    #[must_use]
    pub fn with_bodies(mut self, bodies: &[u32], lids: &[Vec<[u32; 2]>]) -> Self {
        for pass in &mut self.passes {
            pass.set_bodies(&self.targets, bodies, lids.get(pass.target).map_or(&[], |lids| lids));
        }
        self
    }

    /// Holds nodes a little beyond the ends of faces, so that bodies that end flush stay in contact;
    /// `positions` are the initial ones.
    #[must_use]
    pub fn with_ends(mut self, positions: &[Vector]) -> Self {
        for pass in &mut self.passes {
            pass.ends = Ends::new(&self.targets[pass.slave], &self.targets[pass.target], positions);
        }
        self
    }

    /// Segments of its own surface that end and begin at the slave node of a touch, and the surface;
    /// [`crate::mesh::surface::NONE`] where there is none. Known only with [`Tracker::with_ends`].
    #[must_use]
    pub fn segments_at(&self, touch: &ContactPoint) -> ([u32; 2], &Target) {
        let pass = &self.passes[touch.pass as usize];
        (pass.ends.around.get(touch.slave as usize).copied().unwrap_or([NONE; 2]), &self.targets[pass.slave])
    }

    /// The segments where a node touches, each with its surface: of the target, and those that end and begin
    /// at the node, [`crate::mesh::surface::NONE`] where there is none.
    #[must_use]
    pub fn around(&self, touch: &ContactPoint) -> [(usize, u32); 3] {
        let pass = &self.passes[touch.pass as usize];
        let ([before, after], _) = self.segments_at(touch);
        [(pass.target, touch.projection.segment), (pass.slave, before), (pass.slave, after)]
    }

    /// The surfaces.
    #[must_use]
    pub fn targets(&self) -> &[Target] {
        &self.targets
    }

    /// Target of a pass.
    #[must_use]
    pub fn target(&self, pass: u32) -> &Target {
        &self.targets[self.passes[pass as usize].target]
    }

    /// Slave surface of a pass.
    #[must_use]
    pub fn slave(&self, pass: u32) -> usize {
        self.passes[pass as usize].slave
    }

    /// Whether the slaves of a pass are the first surface (1), the second (−1), or both in one (0).
    #[must_use]
    pub fn side(&self, pass: u32) -> f32 {
        let Pass { slave, target, .. } = self.passes[pass as usize];
        if slave == target { 0.0 } else { 1.0 - 2.0 * slave as f32 }
    }

    /// What was checked so far, and whether something was missed.
    #[must_use]
    pub fn certificate(&self) -> Certificate {
        self.found.certificate
    }

    /// What the search cost so far.
    #[must_use]
    pub fn search_report(&self) -> SearchReport {
        let candidates = self.passes.iter().map(|pass| pass.candidates.len()).sum();
        SearchReport { candidates, ..self.reach.report }
    }

    /// Keeps what is known of the past, for [`crate::contact::Formulation::persist`].
    pub(in crate::contact) fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { targets, passes, reach, found: Found { touches, certificate }, chunks: _, travel, past } = self;
        passes.iter_mut().try_for_each(|pass| pass.persist(targets, archive))?;
        persist_each!(archive; reach, touches, certificate, travel, past);
        let is_touch = |touch: &ContactPoint| {
            passes.get(touch.pass as usize).is_some_and(|pass| {
                let group = pass.groups.get(touch.group as usize);
                group.is_some_and(|group| (group.slave, group.node) == (touch.slave, touch.node))
                    && (touch.projection.segment as usize) < targets[pass.target].surface.segments.len()
            })
        };
        archive.check(touches.iter().all(is_touch), "a contact point refers to a missing pair")?;
        let recalls = |past: &Vec<Vec<(Group, ContactHistory)>>| {
            past.len() == passes.len()
                && passes
                    .iter()
                    .zip(past)
                    .all(|(pass, past)| past.iter().all(|(group, _)| pass.is_known(&Group { begin: 0, end: 0, ..*group }, targets)))
        };
        archive.check(past.as_ref().is_none_or(recalls), "a contact recalls nodes or segments that are not there")
    }

    /// Forgets what is known of the past.
    pub fn forget(&mut self) {
        self.reach.forget();
        self.passes.iter_mut().for_each(Pass::forget);
    }

    /// Nodes that are inside, or near enough to come in during the next update, ascending by pass, slave and
    /// body. Pairs farther than the skin and `extra` (m) are not looked at. In the first call nothing is
    /// known of the past: a node in another body is where the nearest feature of that body says.
    pub fn track(&mut self, sweep: Sweep<'_, 2>, extra: f64) -> &[ContactPoint] {
        self.reach.report.steps += 1;
        let mut sweep = sweep;
        let way = sweep.travel - std::mem::replace(&mut self.travel, sweep.travel);
        if self.reach.is_left(sweep) {
            let (at_start, past) = (self.reach.is_new(), self.past.take());
            if at_start && past.is_none() {
                sweep.old = sweep.new;
            }
            let way = |node: u32| bound_of(minus(sweep.new[node as usize], sweep.old[node as usize]));
            let reach = self.reach.skin + 2.0 * self.reach.fastest(way) + extra;
            for (number, pass) in self.passes.iter_mut().enumerate() {
                if at_start {
                    pass.search(&self.targets, sweep, FIRST * reach, &mut self.reach);
                    pass.start(&self.targets, sweep.old, past.is_none());
                }
                if let Some(past) = &past {
                    pass.recall(&past[number]);
                }
                pass.search(&self.targets, sweep, reach, &mut self.reach);
            }
            self.reach.settle(sweep);
        }
        self.found.touches.clear();
        // Within a pool of threads the groups are shared among them, in chunks that do not depend on their
        // number.
        let threads = rayon::current_thread_index().is_some();
        for (number, pass) in self.passes.iter_mut().enumerate() {
            // Each pair belongs to one group; those of groups that sleep are proven by their distance.
            self.found.certificate.pairs_swept += pass.candidates.len() as u64;
            let (all, view) = pass.view(&self.targets, number, [self.reach.skin, extra], (sweep, way));
            if !(threads && all.groups.len() >= SERIAL) {
                view.look_at(all, &mut self.found);
                continue;
            }
            let count = all.groups.len().div_ceil(CHUNK);
            self.chunks.resize_with(count.max(self.chunks.len()), Found::default);
            let found = &mut self.chunks[..count];
            let groups = all.groups.par_chunks_mut(CHUNK).zip(all.kept.par_chunks_mut(CHUNK)).zip(all.wakes.par_chunks_mut(CHUNK));
            groups.zip(found.par_iter_mut()).enumerate().for_each(|(index, (((groups, kept), wakes), found))| {
                found.touches.clear();
                found.certificate = Certificate::default();
                view.look_at(Located { first: index * CHUNK, groups, kept, wakes }, found);
            });
            for found in &self.chunks[..count] {
                self.found.touches.extend_from_slice(&found.touches);
                self.found.certificate += found.certificate;
            }
        }
        &self.found.touches
    }

    /// What [`Tracker::track`] found last.
    #[must_use]
    pub fn touches(&self) -> &[ContactPoint] {
        &self.found.touches
    }

    /// What is kept of the slave and the body of a touch: zero where they did not touch in the last step.
    #[must_use]
    pub fn kept(&self, touch: &ContactPoint) -> &ContactHistory {
        &self.passes[touch.pass as usize].kept[touch.group as usize]
    }

    /// The same to change it.
    pub fn kept_mut(&mut self, touch: &ContactPoint) -> &mut ContactHistory {
        &mut self.passes[touch.pass as usize].kept[touch.group as usize]
    }
}
