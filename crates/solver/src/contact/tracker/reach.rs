//! When the global search must run again, and how far it looks.

use super::super::projection::node_segment::{Target, Vector};
use super::super::search::{Pair, Search};
use super::super::{Sweep, length};
use super::certificate::SearchReport;
use crate::archive::{Archive, ArchiveResult, Persist, persist_each};
use crate::vector::{bound_of, minus};

/// Skin as a fraction of the mean segment length: how far bodies may move before the next global search.
pub const SKIN: f64 = 0.25;
/// The global search is asked for a little more than is kept, so that what is kept does not depend on how
/// each search rounds.
pub(super) const SLACK: f64 = 1.001;
/// Where no node has gone so far since the search, as a fraction of the skin, none has gone half of it.
pub(in crate::contact) const SAFE: f64 = 0.499;

/// The global search, and what it found.
pub(super) struct Reach {
    pub(super) search: Box<dyn Search<2>>,
    pub(super) pairs: Vec<Pair>,
    /// All nodes of the surfaces.
    nodes: Vec<u32>,
    /// Their positions at the last search; empty before the first.
    positions: Vec<Vector>,
    /// Way that no node had exceeded then, m.
    travel: f64,
    /// Pairs within this distance were found, m.
    pub(super) skin: f64,
    pub(super) report: SearchReport,
}

impl Persist for Reach {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self {
            search: _,
            pairs: _,
            nodes,
            positions,
            travel,
            skin: _,
            report: SearchReport { steps, searches, skin: _, candidates: _ },
        } = self;
        persist_each!(archive; positions, travel, steps, searches);
        archive.check(positions.is_empty() || positions.len() == nodes.len(), "a contact was searched at other nodes")
    }
}

impl Reach {
    pub(super) fn new(search: Box<dyn Search<2>>, targets: &[Target], positions: &[Vector]) -> Self {
        let mut nodes: Vec<u32> = targets.iter().flat_map(|target| target.surface.nodes.iter().copied()).collect();
        nodes.sort_unstable();
        nodes.dedup();
        let lengths = targets.iter().flat_map(|target| target.surface.segments.iter()).map(|&segment| length(segment, positions));
        let count = targets.iter().map(|target| target.surface.segments.len()).sum::<usize>().max(1);
        let skin = SKIN * lengths.sum::<f64>() / count as f64;
        let report = SearchReport { skin, ..SearchReport::default() };
        Self { search, pairs: Vec::new(), nodes, positions: Vec::new(), travel: 0.0, skin, report }
    }

    /// Whether nothing has been searched yet.
    pub(super) fn is_new(&self) -> bool {
        self.positions.is_empty()
    }

    pub(super) fn forget(&mut self) {
        self.positions.clear();
    }

    /// How far to search now, m.
    pub(super) fn radius(&self, sweep: Sweep<'_, 2>) -> f64 {
        self.skin + 2.0 * self.fastest(sweep)
    }

    /// Notes where the nodes were searched.
    pub(super) fn settle(&mut self, sweep: Sweep<'_, 2>) {
        self.report.searches += 1;
        self.travel = sweep.travel;
        self.positions.clear();
        self.positions.extend(self.nodes.iter().map(|&node| sweep.new[node as usize]));
    }

    /// Longest way of a node in the step, m: so far a spring must be seen ahead.
    fn fastest(&self, sweep: Sweep<'_, 2>) -> f64 {
        self.nodes.iter().map(|&node| way(node, sweep)).fold(0.0, f64::max)
    }

    /// Whether some node has moved by more than half the skin since the last search (or there was none).
    pub(super) fn is_left(&self, sweep: Sweep<'_, 2>) -> bool {
        let limit = 0.25 * self.skin * self.skin;
        if !self.is_new() && (0.0..SAFE * self.skin).contains(&(sweep.travel - self.travel)) {
            return false;
        }
        self.positions.is_empty()
            || self.nodes.iter().zip(&self.positions).any(|(&node, from)| {
                let x = sweep.new[node as usize];
                let moved = [x[0] - from[0], x[1] - from[1]];
                // NaN counts as moved
                !(moved[0] * moved[0] + moved[1] * moved[1] <= limit)
            })
    }
}

/// Bound of how far a node moves in the step, m.
fn way(node: u32, sweep: Sweep<'_, 2>) -> f64 {
    bound_of(minus(sweep.new[node as usize], sweep.old[node as usize]))
}
