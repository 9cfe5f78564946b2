//! The slave nodes' side of `grid`: takes them together in groups, looks around in the cells, and writes the
//! pairs.
//!
//! Several workers may look at the same cells at once, each with a share of the slave nodes; what they find
//! together does not depend on the shares.

use super::compare::{Compare, Look, Meeting, Scratch};
use super::gather::Slaves;
use super::{Cells, GROUP};
use crate::contact::search::extent::Extent;
use crate::contact::search::hull::Paths;
use crate::contact::search::{Pair, Query};
use std::ops::Range;

/// Slave groups that go through each stage of the search together.
const BATCH: usize = 4;

/// Storage kept between calls.
pub(super) struct Worker<const D: usize> {
    /// Pairs of its share, when there are several.
    pub(super) pairs: Vec<Pair>,
    /// A few groups of slave nodes that are worked on together; so many are in use.
    slaves: [SlaveGroup<D>; BATCH],
    used: usize,
    /// Where in the sorted list each of them has to look: beginnings and ends.
    pieces: Vec<(u32, u32)>,
    /// Numbers of the groups of facets that each of them meets.
    found: Vec<u32>,
    /// Facets that their nodes meet.
    meetings: Vec<Meeting>,
    /// Storage of the comparisons.
    scratch: Scratch,
}

/// Slave nodes that follow each other in the query.
#[derive(Clone, Copy)]
pub(super) struct SlaveGroup<const D: usize> {
    /// Number of the first.
    pub(super) begin: usize,
    /// How many.
    pub(super) count: usize,
    /// Path of each; nowhere where it is not finite.
    pub(super) paths: Paths<D>,
    /// Box of all.
    pub(super) extent: Extent<D>,
    /// Where its entries in `pieces` end; they begin where those of the group before end.
    pub(super) pieces: usize,
    /// The same of `found`.
    pub(super) found: usize,
}

impl<const D: usize> Default for Worker<D> {
    fn default() -> Self {
        Self {
            pairs: Vec::new(),
            slaves: [SlaveGroup { begin: 0, count: 0, paths: Paths::NONE, extent: Extent::NONE, pieces: 0, found: 0 }; BATCH],
            used: 0,
            pieces: Vec::new(),
            found: Vec::new(),
            meetings: Vec::new(),
            scratch: Scratch::default(),
        }
    }
}

impl<const D: usize> Worker<D> {
    /// Writes the pairs of a share of the slave nodes into `pairs`.
    pub(super) fn search(&mut self, cells: &Cells<D>, query: &Query<'_, D>, share: Range<usize>, pairs: &mut Vec<Pair>) {
        // Slave groups are as large as the most common facet groups.
        let limit = cells.levels.iter().max_by_key(|l| l.count).map_or(0.0, |l| l.size);
        let mut slave = share.start;
        let mut written = 0;
        while slave < share.end {
            (self.used, slave) = cells.instructions.run(Slaves { query, begin: slave, end: share.end, limit, groups: &mut self.slaves });
            self.look_around(cells);
            written = self.compare(cells, query, pairs, written);
        }
        pairs.truncate(written);
    }

    /// For each group of slave nodes the groups of facets that meet its box, ascending, into `found`.
    fn look_around(&mut self, cells: &Cells<D>) {
        self.pieces.clear();
        for number in 0..self.used {
            if self.slaves[number].extent.meets(&cells.bounds) {
                for level in 0..cells.levels.len() {
                    self.look_at(cells, level, number);
                }
            }
            self.slaves[number].pieces = self.pieces.len();
        }
        let Self { slaves, used, pieces, found, scratch, .. } = self;
        let Cells { instructions, sorted, order, unbounded, .. } = cells;
        instructions.run(Look { slaves: &mut slaves[..*used], pieces, sorted, order, unbounded, found, scratch });
    }

    /// Writes the pairs of the slave groups with the facets of the groups that they found, from `written` on;
    /// returns where they end.
    fn compare(&mut self, cells: &Cells<D>, query: &Query<'_, D>, pairs: &mut Vec<Pair>, mut written: usize) -> usize {
        let Self { slaves, used, found, scratch, meetings, .. } = self;
        let Cells { instructions, groups, facets, .. } = cells;
        let count = instructions.run(Compare { slaves: &slaves[..*used], groups, found, facets, scratch, meetings });
        let meetings = &meetings[..count];
        if pairs.len() < written + GROUP * meetings.len() {
            pairs.resize(written + GROUP * meetings.len() + 1024, Pair { slave: 0, facet: 0 });
        }
        let mut meetings = meetings.iter();
        let Some(&(mut meeting)) = meetings.next() else { return written };
        loop {
            let facet = meeting.eight * GROUP as u32 + meeting.bits.trailing_zeros();
            let node = query.slaves[meeting.slave as usize];
            pairs[written] = Pair { slave: meeting.slave, facet };
            written += usize::from(!query.facets[facet as usize].contains(&node));
            meeting.bits &= meeting.bits - 1;
            if meeting.bits == 0 {
                match meetings.next() {
                    Some(next) => meeting = *next,
                    None => return written,
                }
            }
        }
    }

    /// Adds the pieces of `sorted` in which one level's groups lie that may meet the box of a group of slave
    /// nodes.
    fn look_at(&mut self, cells: &Cells<D>, level: usize, slaves: usize) {
        let (begin, pieces) = (&cells.begin, &mut self.pieces);
        let (level, extent) = (&cells.levels[level], &self.slaves[slaves].extent);
        let low: [i64; D] = std::array::from_fn(|d| level.cell(d, extent.low[d]).saturating_sub(level.span).max(0));
        let high: [i64; D] = std::array::from_fn(|d| level.cell(d, extent.high[d]).min(level.last[d]));
        if (0..D).any(|d| low[d] > high[d]) {
            return;
        }
        let mut add = |from: usize, to: usize| {
            if begin[from] < begin[to] {
                pieces.push((begin[from], begin[to]));
            }
        };
        let buckets = level.mask as usize + 1;
        let columns = (high[0] - low[0]) as u64;
        let rows = (1..D).fold(1.0, |rows, d| rows * ((high[d] - low[d]) as f64 + 1.0));
        if columns >= level.mask || rows > level.count as f64 {
            add(level.base, level.base + buckets);
            return;
        }
        let mut cell = low;
        loop {
            let first = level.bucket(&cell) as usize;
            let end = first + columns as usize + 1;
            add(level.base + first, level.base + end.min(buckets));
            if end > buckets {
                add(level.base, level.base + end - buckets);
            }
            // The next row: counts up like a meter.
            let mut d = 1;
            while d < D && cell[d] == high[d] {
                cell[d] = low[d];
                d += 1;
            }
            if d >= D {
                return;
            }
            cell[d] += 1;
        }
    }
}
