//! A uniform grid per size class, rolled up so that it takes memory for the facets, not for the space: the default search.
//!
//! Facets that follow each other in the list mostly follow each other in space. So they are taken together in small groups with one box each
//! (a facet's box holds its old and new nodes plus the reach); a list in bad order just makes small groups. Each group lies in the one cell
//! that holds its lower corner. Slave nodes go in groups too: a group looks at the cells from which a box can reach it, keeps the facet groups that
//! meet its own box, and each of its nodes is compared with these and with the boxes in them. The result is that of `boxes`, at a
//! cost that grows with the number of facets and slaves alone:
//!
//! - *Size classes.* Groups of very uneven size go to grids of their own cell size; see `size_class`.
//! - *Rolled up.* Cell (x, y) is bucket (x + s y) mod m, m a power of two of about the number of groups. When the whole grid has at most m
//!   cells, s is the length of a row and every cell has its own bucket; else s ≈ 0.618 m spreads rows evenly, and cells that share a bucket
//!   only cost comparisons. Neighbours in x stay neighbours in memory: a row of cells is one piece of the sorted list.
//! - *Counting sort* of groups into buckets. What is done per facet runs through memory in the order of the list, and slave groups go through each
//!   stage in batches and without branches on what was just loaded, so that the processor waits for many far places at a time.
//! - *Whole numbers decide.* A cell number is a monotone function of the coordinate, whatever its rounding, and the number of cells that a box
//!   spans is measured, so no pair is lost at cell boundaries.

use super::extent::{Extent, Margin};
use super::size_class::Sizes;
use super::{Pair, Query, Search, SearchKind};

pub(super) fn kind<const D: usize>() -> SearchKind<D> {
    SearchKind {
        name: "grid",
        doc: "boxes of small groups of facets in the cells of a grid, one cell size per size class; the cost per facet does not grow with their number",
        source: "boxes after Bittencourt and Creus 1995, (b); hierarchical grid after Mirtich 1997; counting sort",
        make: || Box::new(Grid::<D>::default()),
    }
}

/// Most facets in a group, most slave nodes in a group.
const GROUP: usize = 8;
/// Edge of a cell over the largest group of its level.
const CELL: f64 = 1.0;
/// Buckets per group, rounded up to a power of two.
const BUCKETS: usize = 1;

/// Slave groups that go through each stage of the search together.
const BATCH: usize = 16;

/// Storage kept between calls; nothing is allocated once it has grown to the size of the problem.
struct Grid<const D: usize> {
    /// Box of each facet; [`Extent::NONE`] where a node is not finite.
    facets: Vec<Extent<D>>,
    /// Groups of facets in order.
    groups: Vec<Group<D>>,
    /// The same, bucket by bucket.
    sorted: Vec<Group<D>>,
    /// Where each bucket begins in `sorted`; one more than there are buckets.
    begin: Vec<u32>,
    /// Groups whose box is too large for numbers: compared with every slave node.
    unbounded: Vec<Group<D>>,
    /// Bucket of each group in `groups`; before that is known, the binary exponent of its size.
    place: Vec<u32>,
    /// Size classes.
    levels: Vec<Level<D>>,
    /// Sizes of the groups.
    sizes: Sizes,
    /// Box of all groups that are not unbounded.
    bounds: Extent<D>,
    /// A few groups of slave nodes that are worked on together.
    slaves: Vec<SlaveGroup<D>>,
    /// Where in `sorted` each of them has to look: beginnings and ends.
    pieces: Vec<(u32, u32)>,
    /// Groups of facets that each of them meets.
    found: Vec<Group<D>>,
}

/// Slave nodes that follow each other in the query.
struct SlaveGroup<const D: usize> {
    /// Number of the first.
    begin: usize,
    /// How many.
    count: usize,
    /// Path of each; [`Extent::NONE`] where it is not finite.
    paths: [Extent<D>; GROUP],
    /// Box of all.
    extent: Extent<D>,
    /// Where its entries in `found` end; they begin where those of the group before end.
    found: usize,
}

/// Facets `begin..end`.
#[derive(Clone, Copy)]
struct Group<const D: usize> {
    extent: Extent<D>,
    begin: u32,
    end: u32,
}

impl<const D: usize> Group<D> {
    const NONE: Self = Self { extent: Extent::NONE, begin: 0, end: 0 };
}

/// The grid of one size class.
#[derive(Clone, Copy)]
struct Level<const D: usize> {
    /// 1 / cell size, 1/m.
    inverse: f64,
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
    /// A level for `count` groups up to `size`, in `bounds`.
    fn new(count: usize, size: f64, bounds: &Extent<D>, base: usize) -> Self {
        // Cell numbers must fit into 62 bits; groups that are smaller than that (or points) share cells.
        let cell = (CELL * size).max(bounds.size() * 2.0_f64.powi(-60)).clamp(1e-300, 1e300);
        let mask = (count * BUCKETS).next_power_of_two().max(8) as u64 - 1;
        let mut level = Self { inverse: 1.0 / cell, origin: bounds.low, last: [0; D], span: 0, stride: [1; D], mask, base, count };
        level.last = std::array::from_fn(|d| level.cell(d, bounds.high[d]));
        let mut cells = 1.0;
        for d in 0..D {
            level.stride[d] = cells as u64;
            cells *= level.last[d] as f64 + 1.0;
        }
        if cells > mask as f64 + 1.0 {
            // Powers of the inverse golden ratio and its like in space: multiples of these keep apart from each other modulo 1.
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
        ((x - self.origin[d]) * self.inverse) as i64
    }
    /// Bucket of a cell, counted from the level's first.
    #[inline]
    fn bucket(&self, cell: &[i64; D]) -> u64 {
        (0..D).fold(0_u64, |sum, d| sum.wrapping_add((cell[d] as u64).wrapping_mul(self.stride[d]))) & self.mask
    }
}

impl<const D: usize> Default for Grid<D> {
    fn default() -> Self {
        Self {
            facets: Vec::new(),
            groups: Vec::new(),
            sorted: Vec::new(),
            begin: Vec::new(),
            unbounded: Vec::new(),
            place: Vec::new(),
            levels: Vec::new(),
            sizes: Sizes::default(),
            bounds: Extent::NONE,
            slaves: Vec::new(),
            pieces: Vec::new(),
            found: Vec::new(),
        }
    }
}

impl<const D: usize> Search<D> for Grid<D> {
    fn pairs(&mut self, query: &Query<'_, D>, pairs: &mut Vec<Pair>) {
        pairs.clear();
        self.group_facets(query);
        self.choose_levels();
        self.sort_into_buckets();
        // Slave groups are as large as the most common facet groups.
        let limit = self.levels.iter().max_by_key(|l| l.count).map_or(0.0, |l| 1.0 / l.inverse);
        let mut slave = 0;
        let mut written = 0;
        while slave < query.slaves.len() {
            slave = self.group_slaves(query, slave, limit);
            self.look_around();
            written = self.compare(query, pairs, written);
        }
        pairs.truncate(written);
    }
}

impl<const D: usize> Grid<D> {
    /// Boxes of all facets, taken together in groups.
    fn group_facets(&mut self, query: &Query<'_, D>) {
        let margin = Margin::new(query.reach);
        self.facets.clear();
        self.groups.clear();
        self.place.clear();
        self.unbounded.clear();
        self.sizes.clear();
        self.bounds = Extent::NONE;
        let mut group = Group::NONE;
        // A chain of facets is no longer than they are together; facets in random places are farther apart.
        let mut together = 0.0;
        for (nodes, facet) in query.facets.iter().zip(0_u32..) {
            let extent = Extent::of_facet(query, nodes, margin).unwrap_or(Extent::NONE);
            self.facets.push(extent);
            if extent.is_none() {
                continue;
            }
            let both = group.extent.with(&extent);
            together += extent.size();
            if facet - group.begin < GROUP as u32 && both.size() <= together {
                group.extent = both;
            } else {
                self.add(group);
                group = Group { extent, begin: facet, end: facet };
                together = extent.size();
            }
            group.end = facet + 1;
        }
        self.add(group);
    }

    /// Takes in a group when it is complete; an empty one is dropped.
    fn add(&mut self, group: Group<D>) {
        let size = group.extent.size();
        if !size.is_finite() {
            self.unbounded.push(group);
        } else if !group.extent.is_none() {
            self.bounds = self.bounds.with(&group.extent);
            self.place.push(self.sizes.add(size));
            self.groups.push(group);
        }
    }

    /// One level per size class of the groups.
    fn choose_levels(&mut self) {
        self.levels.clear();
        let mut base = 0;
        for class in self.sizes.classes(D) {
            let level = Level::new(class.count as usize, class.largest, &self.bounds, base);
            base += level.mask as usize + 1;
            self.levels.push(level);
        }
        self.begin.clear();
        self.begin.resize(base + 1, 0);
    }

    /// Counting sort of the groups by bucket, stable.
    fn sort_into_buckets(&mut self) {
        for (group, place) in self.groups.iter().zip(&mut self.place) {
            let level = &mut self.levels[self.sizes.class_of(*place)];
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
        self.sorted.resize(self.groups.len(), Group::NONE);
        for (group, &place) in self.groups.iter().zip(&self.place).rev() {
            let begin = &mut self.begin[place as usize];
            *begin -= 1;
            self.sorted[*begin as usize] = *group;
        }
    }

    /// The next few groups of slave nodes from `begin` on; returns where they end.
    fn group_slaves(&mut self, query: &Query<'_, D>, mut begin: usize, limit: f64) -> usize {
        self.slaves.clear();
        while self.slaves.len() < BATCH && begin < query.slaves.len() {
            let mut group = SlaveGroup { begin, count: 0, paths: [Extent::NONE; GROUP], extent: Extent::NONE, found: 0 };
            for (path, &node) in group.paths.iter_mut().zip(&query.slaves[begin..]) {
                *path = Extent::of_path(query, node).unwrap_or(Extent::NONE);
                let both = group.extent.with(path);
                if group.count > 0 && both.size() > limit {
                    break;
                }
                group.extent = both;
                group.count += 1;
            }
            begin += group.count;
            self.slaves.push(group);
        }
        begin
    }

    /// For each group of slave nodes the groups of facets that meet its box, ascending, into `found`.
    fn look_around(&mut self) {
        self.pieces.clear();
        for number in 0..self.slaves.len() {
            if self.slaves[number].extent.meets(&self.bounds) {
                for level in 0..self.levels.len() {
                    self.look_at(level, number);
                }
            }
            // One more piece for the unbounded ones, which marks the end of this group's pieces.
            self.pieces.push((u32::MAX, 0));
        }
        let mut slaves = self.slaves.iter_mut();
        let Some(mut group) = slaves.next() else { return };
        let (mut first, mut end) = (0, 0);
        for &(from, to) in &self.pieces {
            if from < u32::MAX {
                let piece = &self.sorted[from as usize..to as usize];
                if self.found.len() < end + piece.len() {
                    self.found.resize(end + piece.len(), Group::NONE);
                }
                for candidate in piece {
                    self.found[end] = *candidate;
                    end += usize::from(candidate.extent.meets(&group.extent));
                }
                continue;
            }
            if !self.unbounded.is_empty() && !group.extent.is_none() {
                self.found.truncate(end);
                self.found.extend(&self.unbounded);
                end = self.found.len();
            }
            let own = &mut self.found[first..end];
            own.sort_unstable_by_key(|g| g.begin);
            // On a rolled up grid two rows of cells may share buckets.
            let mut kept = 0;
            for i in 0..own.len() {
                if kept == 0 || own[kept - 1].begin != own[i].begin {
                    own[kept] = own[i];
                    kept += 1;
                }
            }
            end = first + kept;
            group.found = end;
            first = end;
            match slaves.next() {
                Some(next) => group = next,
                None => return,
            }
        }
    }

    /// Writes the pairs of the slave groups with the facets of the groups that they found, from `written` on; returns where they end.
    fn compare(&self, query: &Query<'_, D>, pairs: &mut Vec<Pair>, mut written: usize) -> usize {
        let mut first = 0;
        for slaves in &self.slaves {
            let found = &self.found[first..slaves.found];
            first = slaves.found;
            for (path, slave) in slaves.paths[..slaves.count].iter().zip(slaves.begin..) {
                let node = query.slaves[slave];
                for group in found.iter().filter(|g| g.extent.meets(path)) {
                    if pairs.len() < written + GROUP {
                        pairs.resize(written + 1024, Pair { slave: 0, facet: 0 });
                    }
                    let place = &mut pairs[written..written + GROUP];
                    let mut count = 0;
                    let range = group.begin as usize..group.end as usize;
                    for ((extent, nodes), facet) in self.facets[range.clone()].iter().zip(&query.facets[range]).zip(group.begin..) {
                        place[count % GROUP] = Pair { slave: slave as u32, facet };
                        count += usize::from(extent.meets(path) & !nodes.contains(&node));
                    }
                    written += count;
                }
            }
        }
        written
    }

    /// Adds the pieces of `sorted` in which one level's groups lie that may meet the box of a group of slave nodes.
    fn look_at(&mut self, level: usize, slaves: usize) {
        let Self { levels, begin, pieces, .. } = self;
        let (level, extent) = (&levels[level], &self.slaves[slaves].extent);
        let low: [i64; D] = std::array::from_fn(|d| level.cell(d, extent.low[d]).saturating_sub(level.span).max(0));
        let high: [i64; D] = std::array::from_fn(|d| level.cell(d, extent.high[d]).min(level.last[d]));
        if (0..D).any(|d| low[d] > high[d]) {
            return;
        }
        let mut add = |from: usize, to: usize| pieces.push((begin[from], begin[to]));
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
