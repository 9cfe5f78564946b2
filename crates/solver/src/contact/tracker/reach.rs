//! When the global search must run again: when some node has moved by half the skin since the last one, as a
//! list of neighbours (Verlet 1967) is made again.

use super::super::Sweep;
use super::super::search::{Pair, Search};
use super::certificate::SearchReport;
use crate::archive::{Archive, ArchiveResult, Persist, persist_each};
use crate::vector::{dot, minus};

/// Skin as a fraction of the mean length of segments or edges: how far bodies may move before the next global
/// search.
pub const SKIN: f64 = 0.25;
/// The global search is asked for a little more than is kept, so that what is kept does not depend on how
/// each search rounds.
pub(in crate::contact) const SLACK: f64 = 1.001;
/// Where no node has gone so far since the search, as a fraction of the skin, none has gone half of it.
const SAFE: f64 = 0.499;

/// The global search, and what it found.
pub(in crate::contact) struct Reach<const D: usize> {
    pub(in crate::contact) search: Box<dyn Search<D>>,
    pub(in crate::contact) pairs: Vec<Pair>,
    /// All nodes of the surfaces.
    nodes: Vec<u32>,
    /// Their positions at the last search; empty before the first.
    positions: Vec<[f64; D]>,
    /// Way that no node had exceeded then, m.
    travel: f64,
    /// How far bodies may move, half of it each, m.
    pub(in crate::contact) skin: f64,
    pub(in crate::contact) report: SearchReport,
}

impl<const D: usize> Persist for Reach<D>
where
    [f64; D]: Default,
{
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

impl<const D: usize> Reach<D> {
    /// Of a contact whose surfaces have these `nodes`, in any order.
    pub(in crate::contact) fn new(search: Box<dyn Search<D>>, nodes: impl Iterator<Item = u32>, skin: f64) -> Self {
        let mut nodes: Vec<u32> = nodes.collect();
        nodes.sort_unstable();
        nodes.dedup();
        let report = SearchReport { skin, ..SearchReport::default() };
        Self { search, pairs: Vec::new(), nodes, positions: Vec::new(), travel: 0.0, skin, report }
    }

    /// The same with another skin, m.
    pub(in crate::contact) fn with_skin(self, skin: f64) -> Self {
        Self { skin, report: SearchReport { skin, ..self.report }, ..self }
    }

    /// Whether nothing has been searched yet.
    pub(in crate::contact) fn is_new(&self) -> bool {
        self.positions.is_empty()
    }

    pub(in crate::contact) fn forget(&mut self) {
        self.positions.clear();
    }

    /// Continues the report of another one.
    pub(in crate::contact) fn inherit(&mut self, old: &Self) {
        self.report = SearchReport { skin: self.skin, ..old.report };
    }

    /// Notes where the nodes were searched.
    pub(in crate::contact) fn settle(&mut self, sweep: Sweep<'_, D>) {
        self.report.searches += 1;
        self.travel = sweep.travel;
        self.positions.clear();
        self.positions.extend(self.nodes.iter().map(|&node| sweep.new[node as usize]));
    }

    /// Longest way of a node in the step by `way`, m: so far a spring must be seen ahead.
    pub(in crate::contact) fn fastest(&self, way: impl Fn(u32) -> f64) -> f64 {
        self.nodes.iter().map(|&node| way(node)).fold(0.0, f64::max)
    }

    /// Whether some node has moved by more than half the skin since the last search (or there was none).
    pub(in crate::contact) fn is_left(&self, sweep: Sweep<'_, D>) -> bool {
        let limit = 0.25 * self.skin * self.skin;
        if !self.is_new() && (0.0..SAFE * self.skin).contains(&(sweep.travel - self.travel)) {
            return false;
        }
        self.is_new()
            || self.nodes.iter().zip(&self.positions).any(|(&node, from)| {
                let moved = minus(sweep.new[node as usize], *from);
                // What is no number counts as moved.
                !(dot(moved, moved) <= limit)
            })
    }
}
