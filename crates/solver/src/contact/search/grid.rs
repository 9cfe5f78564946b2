//! A uniform grid per size class, rolled up so that it takes memory for the facets, not for the space: the
//! default search.
//!
//! Facets that follow each other in the list mostly follow each other in 3D. So they are taken together in
//! small groups (a facet's box holds its old and new nodes plus the reach); a list in bad order just makes
//! small groups. A group has two boxes: one along the axes, for the cells, and one along its facets, which
//! distinguishes layers. It lies in the one cell that holds its lower corner. Slave nodes go in groups too: a
//! group looks at the cells from which a box can reach it, keeps the facet groups that meet its own box along
//! the axes, and each of its nodes is compared with the other boxes of these and with the boxes of the facets
//! in them. The result is that of `boxes`, at a cost that grows with the number of facets and slaves alone:
//!
//! - *Size classes.* Groups of very uneven size go to grids of their own cell size; see `size_class`.
//! - *Rolled up.* Cell (x, y) is bucket (x + s y) mod m, m a power of two of about the number of groups. When
//!   the whole grid has at most m cells, s is the length of a row and every cell has its own bucket; else
//!   s ≈ 0.618 m spreads rows evenly, and cells that share a bucket only cost comparisons. Neighbours in x
//!   stay neighbours in memory: a row of cells is one piece of the sorted list.
//! - *Eight at a time.* Boxes lie in eights side by side, so that one comparison of vectors says which of
//!   them meet a box; a group of facets never lies in two of the eights. See `compare`.
//! - *Counting sort* of groups into buckets. What is done per facet runs through memory in the order of the
//!   list, and slave groups go through each stage in batches and without branches on what was just loaded, so
//!   that the processor waits for many far places at a time.
//! - *Whole numbers decide.* A cell number is a monotone function of the coordinate, whatever its rounding,
//!   and the number of cells that a box spans is measured, so no pair is lost at cell boundaries.

mod compare;
mod gather;
mod worker;

use super::eight::Eight;
use super::extent::{Extent, larger};
use super::hull::{Hull, Hulls};
use super::size_class::{BINS, Class, Sizes};
use super::{Pair, Query, Search, SearchKind};
use embate_lanes::{BATCH as GROUP, Level as Instructions};
use gather::Gather;
use rayon::prelude::*;
use worker::Worker;

pub(super) fn kind<const D: usize>() -> SearchKind<D> {
    SearchKind {
        name: "grid",
        doc: "boxes of small groups of facets in the cells of a grid, one cell size per size class; the cost per \
            facet does not grow with their number",
        source: "boxes after Bittencourt and Creus 1995, (b); hierarchical grid after Mirtich 1997; counting sort",
        make: || Box::new(Grid::<D>::default()),
    }
}

/// Edges of a cell over those of the largest boxes of its level.
const CELL: f64 = 1.0;
/// Least edge of a cell over the largest.
const FLATTEST: f64 = 0.125;
/// Buckets per group, rounded up to a power of two.
const BUCKETS: usize = 1;

/// Least number of slave nodes in a share.
const SHARE: usize = 2048;
/// Shares per thread: who is done early takes another.
const SHARES: usize = 4;
/// No bucket.
const NOWHERE: u32 = u32::MAX;

/// Storage kept between calls; nothing is allocated once it has grown to the size of the problem.
#[derive(Default)]
struct Grid<const D: usize> {
    cells: Cells<D>,
    /// One for each share of the slave nodes.
    workers: Vec<Worker<D>>,
}

/// The facets, sorted into cells.
struct Cells<const D: usize> {
    /// Instruction set of this machine; all give the same pairs.
    instructions: Instructions,
    /// Hulls of the facets, eight and eight; nowhere where a node is not finite.
    facets: Vec<Hulls<D>>,
    /// Groups of facets in order.
    groups: Vec<Group<D>>,
    /// Their boxes bucket by bucket, eight and eight.
    sorted: Vec<Eight<D>>,
    /// And their numbers.
    order: Vec<u32>,
    /// Where each bucket begins in `sorted`; one more than there are buckets.
    begin: Vec<u32>,
    /// Groups whose box is too large for numbers: in no bucket, compared with every slave node.
    unbounded: Vec<u32>,
    /// Bucket of each group in `groups`; before that is known, the bin of its size. [`NOWHERE`] for an
    /// unbounded one.
    place: Vec<u32>,
    /// Size classes.
    levels: Vec<Level<D>>,
    /// Sizes of the groups.
    sizes: Sizes,
    /// The largest of them, m.
    largest: f64,
    /// Box of all groups that are not unbounded.
    bounds: Extent<D>,
}

/// Facets `begin..end`.
#[derive(Clone, Copy)]
struct Group<const D: usize> {
    extent: Extent<D>,
    hull: Hull<f64, D>,
    begin: u32,
    end: u32,
}

/// The grid of one size class.
#[derive(Clone, Copy)]
struct Level<const D: usize> {
    /// Size of the largest group, m.
    size: f64,
    /// 1 / edge of a cell in each direction, 1/m.
    inverse: [f64; D],
    /// Lower corner of cell 0, m.
    origin: [f64; D],
    /// Largest number of a cell in use.
    last: [i64; D],
    /// Largest number of cells that a box reaches beyond its own.
    span: i64,
    /// Buckets to the next cell in each direction; 1 in the first.
    stride: [u64; D],
    /// Number of buckets less one.
    mask: u64,
    /// First bucket.
    base: usize,
    /// Number of groups.
    count: usize,
}

impl<const D: usize> Level<D> {
    /// A level for a class of groups with boxes up to `edges`, in `bounds`.
    fn new(class: Class, edges: &[f64; D], bounds: &Extent<D>, base: usize) -> Self {
        let (count, size) = (class.count as usize, class.largest);
        // Cell numbers must fit into 62 bits; groups that are smaller than that (or points) share cells.
        let least = (size * FLATTEST).max(bounds.size() * 2.0_f64.powi(-60));
        let inverse = edges.map(|edge| 1.0 / (CELL * edge).max(least).clamp(1e-300, 1e300));
        let mask = (count * BUCKETS).next_power_of_two().max(8) as u64 - 1;
        let mut level = Self { size, inverse, origin: bounds.low, last: [0; D], span: 0, stride: [1; D], mask, base, count };
        level.last = std::array::from_fn(|d| level.cell(d, bounds.high[d]));
        let mut cells = 1.0;
        for d in 0..D {
            level.stride[d] = cells as u64;
            cells *= level.last[d] as f64 + 1.0;
        }
        if cells > mask as f64 + 1.0 {
            // Powers of the inverse golden ratio and its like in 3D: multiples of these keep apart from
            // each other modulo 1.
            let ratio = if D == 2 { 0.618_033_988_749_894_9_f64 } else { 0.819_172_513_396_164_4 };
            for d in 1..D {
                level.stride[d] = (ratio.powi(d as i32) * (mask as f64 + 1.0)) as u64 | 1;
            }
        }
        level
    }
    /// Number of the cell that holds a coordinate; never falls when the coordinate grows.
    #[inline]
    fn cell(&self, d: usize, x: f64) -> i64 {
        ((x - self.origin[d]) * self.inverse[d]) as i64
    }
    /// Bucket of a cell, counted from the level's first.
    #[inline]
    fn bucket(&self, cell: &[i64; D]) -> u64 {
        (0..D).fold(0_u64, |sum, d| sum.wrapping_add((cell[d] as u64).wrapping_mul(self.stride[d]))) & self.mask
    }
}

impl<const D: usize> Default for Cells<D> {
    fn default() -> Self {
        Self {
            instructions: Instructions::best(),
            facets: Vec::new(),
            groups: Vec::new(),
            sorted: Vec::new(),
            order: Vec::new(),
            begin: Vec::new(),
            unbounded: Vec::new(),
            place: Vec::new(),
            levels: Vec::new(),
            sizes: Sizes::default(),
            largest: 0.0,
            bounds: Extent::NONE,
        }
    }
}

impl<const D: usize> Grid<D> {
    /// Sorts the facets and has workers for the slave nodes: how many.
    fn prepare(&mut self, query: &Query<'_, D>) -> usize {
        self.cells.sort(query);
        // Shares are for threads of the pool that this runs in, if any; they change no pair.
        let threads = rayon::current_thread_index().map_or(1, |_| rayon::current_num_threads());
        let count = (query.slaves.len() / SHARE).clamp(1, if threads > 1 { SHARES * threads } else { 1 });
        self.workers.resize_with(count.max(self.workers.len()), Worker::default);
        count
    }
}

impl<const D: usize> Search<D> for Grid<D> {
    fn pairs(&mut self, query: &Query<'_, D>, pairs: &mut Vec<Pair>) {
        let count = self.prepare(query);
        let Self { cells, workers } = self;
        let share = query.slaves.len().div_ceil(count);
        let shares = |number: usize| (number * share).min(query.slaves.len())..((number + 1) * share).min(query.slaves.len());
        pairs.clear();
        if count == 1 {
            workers[0].search(cells, query, shares(0), pairs);
            return;
        }
        let work = |(number, worker): (usize, &mut Worker<D>)| {
            let mut pairs = std::mem::take(&mut worker.pairs);
            worker.search(cells, query, shares(number), &mut pairs);
            worker.pairs = pairs;
        };
        workers[..count].par_iter_mut().enumerate().for_each(work);
        for worker in &workers[..count] {
            pairs.extend_from_slice(&worker.pairs);
        }
    }

    fn by_and_by(&mut self, query: &Query<'_, D>, pairs: &mut Vec<Pair>, take: &mut dyn FnMut(&[Pair])) {
        let count = self.prepare(query);
        let Self { cells, workers } = std::mem::take(self);
        let mut workers = workers;
        let share = |number: usize| (number * SHARE).min(query.slaves.len())..((number + 1) * SHARE).min(query.slaves.len());
        let shares = query.slaves.len().div_ceil(SHARE);
        if count == 1 {
            for number in 0..shares {
                pairs.clear();
                workers[0].search(&cells, query, share(number), pairs);
                take(pairs);
            }
            return;
        }
        for first in (0..shares).step_by(count) {
            let work = |(number, worker): (usize, &mut Worker<D>)| {
                let mut pairs = std::mem::take(&mut worker.pairs);
                pairs.clear();
                worker.search(&cells, query, share(first + number), &mut pairs);
                worker.pairs = pairs;
            };
            workers[..count].par_iter_mut().enumerate().for_each(work);
            workers[..count].iter().for_each(|worker| take(&worker.pairs));
        }
    }
}

impl<const D: usize> Cells<D> {
    /// Takes in the facets of a query.
    fn sort(&mut self, query: &Query<'_, D>) {
        self.group_facets(query);
        self.choose_levels();
        self.sort_into_buckets();
    }

    /// Hulls of all facets, taken together in groups.
    fn group_facets(&mut self, query: &Query<'_, D>) {
        self.place.clear();
        self.unbounded.clear();
        self.bounds = Extent::NONE;
        let Self { instructions, facets, groups, .. } = self;
        instructions.run(Gather { query, facets, groups });
        self.largest = 0.0;
        for (group, number) in self.groups.iter().zip(0..) {
            let size = group.extent.size();
            if size.is_finite() {
                self.largest = larger(self.largest, size);
                self.bounds = self.bounds.with(&group.extent);
            } else {
                self.unbounded.push(number);
            }
        }
    }

    /// One level per size class of the groups.
    fn choose_levels(&mut self) {
        self.sizes.clear(self.largest);
        // Longest edges of boxes, by size and then by class.
        let mut edges = [[0.0; D]; BINS];
        for Group { extent, .. } in &self.groups {
            let size = extent.size();
            if !size.is_finite() {
                self.place.push(NOWHERE);
                continue;
            }
            let bin = self.sizes.add(size);
            for d in 0..D {
                edges[bin][d] = larger(edges[bin][d], extent.high[d] - extent.low[d]);
            }
            self.place.push(bin as u32);
        }
        self.levels.clear();
        let mut base = 0;
        let count = self.sizes.classes(D).len();
        for number in 0..count {
            let mut longest = [0.0; D];
            for (_, edges) in edges.iter().enumerate().filter(|(bin, _)| self.sizes.class_of(*bin) == number) {
                for d in 0..D {
                    longest[d] = larger(longest[d], edges[d]);
                }
            }
            let level = Level::new(self.sizes.class(number), &longest, &self.bounds, base);
            base += level.mask as usize + 1;
            self.levels.push(level);
        }
        self.begin.clear();
        self.begin.resize(base + 1, 0);
    }

    /// Counting sort of the groups by bucket, stable.
    fn sort_into_buckets(&mut self) {
        for (group, place) in self.groups.iter().zip(&mut self.place).filter(|(_, place)| **place != NOWHERE) {
            let level = &mut self.levels[self.sizes.class_of(*place as usize)];
            let cell = std::array::from_fn(|d| level.cell(d, group.extent.low[d]));
            for d in 0..D {
                level.span = level.span.max(level.cell(d, group.extent.high[d]) - cell[d]);
            }
            let bucket = level.base + level.bucket(&cell) as usize;
            *place = bucket as u32;
            self.begin[bucket] += 1;
        }
        let mut sum = 0;
        for begin in &mut self.begin {
            sum += *begin;
            *begin = sum;
        }
        self.sorted.resize(self.groups.len().div_ceil(GROUP), Eight::NONE);
        self.order.resize(self.groups.len(), 0);
        for (number, (group, &place)) in self.groups.iter().zip(&self.place).enumerate().rev().filter(|(_, (_, place))| **place != NOWHERE)
        {
            let begin = &mut self.begin[place as usize];
            *begin -= 1;
            let at = *begin as usize;
            self.sorted[at / GROUP].set(at, &group.extent);
            self.order[at] = number as u32;
        }
    }
}
