//! What `grid` takes in: hulls of facets and paths of slave nodes, eight at a time, and groups of those that
//! lie together.

use super::worker::SlaveGroup;
use super::{GROUP, Group};
use crate::contact::search::Query;
use crate::contact::search::extent::Margin;
use crate::contact::search::hull::{Hulls, Paths, Upright};
use embate_lanes::{Batch, Kernel, Lane};

/// Hulls of all facets of a query, and groups of them; what was there before is overwritten.
pub(super) struct Gather<'a, const D: usize> {
    pub(super) query: &'a Query<'a, D>,
    pub(super) facets: &'a mut Vec<Hulls<D>>,
    pub(super) groups: &'a mut Vec<Group<D>>,
}

impl<const D: usize> Kernel for Gather<'_, D> {
    type Output = ();
    #[inline(always)]
    fn run<L: Lane>(self) {
        let Self { query, facets, groups } = self;
        let margin = Margin::new(query.reach);
        facets.resize(query.facets.len().div_ceil(GROUP), Hulls::NONE);
        groups.clear();
        groups.reserve(facets.len());
        let mut begin = 0;
        for (eight, hulls) in query.facets.chunks(GROUP).zip(facets) {
            let nowhere = [[Batch::splat(f64::NAN); D]; D];
            let (mut old, mut new) = (nowhere, nowhere);
            for (k, nodes) in eight.iter().enumerate() {
                for (i, &node) in nodes.iter().enumerate() {
                    let (from, to) = (&query.positions_old[node as usize], &query.positions_new[node as usize]);
                    for d in 0..D {
                        old[i][d].0[k] = from[d];
                        new[i][d].0[k] = to[d];
                    }
                }
            }
            let boxes = hulls.set::<L>(&old, &new, margin);
            group::<L, D>(hulls, &boxes, eight.len(), begin, groups);
            begin += GROUP as u32;
        }
    }
}

/// Groups of the first `count` of eight facets; `first` is the number of the first of the eight.
#[inline(always)]
fn group<L: Lane, const D: usize>(hulls: &Hulls<D>, boxes: &Upright<D>, count: usize, first: u32, groups: &mut Vec<Group<D>>) {
    let mut begin = 0;
    let all = boxes.all();
    if count == GROUP && all.size() <= boxes.sizes::<L>() && all.size().is_finite() {
        // The most common case at once: all in one group.
        groups.push(Group { extent: all, hull: hulls.around::<L>(0, GROUP, &all), begin: first, end: first + GROUP as u32 });
        begin = GROUP;
    }
    while begin < count {
        let mut all = boxes.at(begin);
        // A chain of facets is no longer than they are together; facets in random places are farther apart.
        let mut together = all.size();
        let mut end = begin + 1;
        if !all.is_none() {
            while end < count {
                let extent = boxes.at(end);
                if !extent.is_none() {
                    let both = all.with(&extent);
                    together += extent.size();
                    if both.size() > together {
                        break;
                    }
                    all = both;
                }
                end += 1;
            }
            let hull = hulls.around::<L>(begin, end, &all);
            groups.push(Group { extent: all, hull, begin: first + begin as u32, end: first + end as u32 });
        }
        begin = end;
    }
}

/// The next few groups of the slave nodes `begin..end`.
pub(super) struct Slaves<'a, const D: usize> {
    pub(super) query: &'a Query<'a, D>,
    pub(super) begin: usize,
    pub(super) end: usize,
    /// Largest size of a group, m.
    pub(super) limit: f64,
    pub(super) groups: &'a mut [SlaveGroup<D>],
}

impl<const D: usize> Kernel for Slaves<'_, D> {
    /// Number of groups, and where they end.
    type Output = (usize, usize);
    #[inline(always)]
    fn run<L: Lane>(self) -> (usize, usize) {
        let Self { query, mut begin, end, limit, groups } = self;
        let mut used = 0;
        while used < groups.len() && begin < end {
            let nowhere = [Batch::splat(f64::NAN); D];
            let (mut old, mut new) = (nowhere, nowhere);
            let nodes = &query.slaves[begin..end];
            let nodes = &nodes[..nodes.len().min(GROUP)];
            for (k, &node) in nodes.iter().enumerate() {
                let (from, to) = (&query.positions_old[node as usize], &query.positions_new[node as usize]);
                for d in 0..D {
                    old[d].0[k] = from[d];
                    new[d].0[k] = to[d];
                }
            }
            let group = &mut groups[used];
            let (paths, boxes) = Paths::between::<L>(&old, &new);
            (group.begin, group.count, group.paths, group.extent) = (begin, nodes.len(), paths, boxes.all());
            if group.extent.size() > limit {
                group.extent = boxes.at(0);
                group.count = 1;
                while group.count < nodes.len() {
                    let both = group.extent.with(&boxes.at(group.count));
                    if both.size() > limit {
                        break;
                    }
                    group.extent = both;
                    group.count += 1;
                }
            }
            begin += group.count;
            used += 1;
        }
        (used, begin)
    }
}
