//! The comparisons of `grid`, eight boxes at a time: slave groups with facet groups, then their nodes with
//! the facets in them.
//!
//! What the grid laid out for a few slave groups comes in, facets that each node meets go out. Lists are
//! filled without branches on what was compared: each entry is written, and the next overwrites it unless it
//! counts. Loops stand where closures would not be compiled for the instruction set.

use super::worker::SlaveGroup;
use super::{GROUP, Group};
use crate::contact::search::eight::Eight;
use crate::contact::search::hull::Hulls;
use embate_lanes::{Kernel, Lane};

/// A slave node and some of eight facets that lie side by side.
#[derive(Clone, Copy, Default)]
pub(super) struct Meeting {
    /// Index into the slaves of the query.
    pub(super) slave: u32,
    /// Its place among the slave groups.
    place: u32,
    /// Which eight.
    pub(super) eight: u32,
    /// Which of them: bit i for the i-th.
    pub(super) bits: u32,
}

/// Storage kept between calls.
#[derive(Default)]
pub(super) struct Scratch {
    /// Eights of facet groups of which some meet a slave group, and which.
    eights: Vec<(u32, u32)>,
    /// Number of a facet group that a slave group found, and in the lowest bits which slaves meet it.
    near: Vec<u64>,
    /// The same in order, each once: which slaves, and the facets of the group.
    met: Vec<(u32, Meeting)>,
    /// Slave nodes with the facets of groups whose boxes they meet.
    with_groups: Vec<Meeting>,
}

/// For each slave group the facet groups that meet its box, ascending.
pub(super) struct Look<'a, const D: usize> {
    pub(super) slaves: &'a mut [SlaveGroup<D>],
    pub(super) pieces: &'a [(u32, u32)],
    pub(super) sorted: &'a [Eight<D>],
    pub(super) order: &'a [u32],
    pub(super) unbounded: &'a [u32],
    pub(super) found: &'a mut Vec<u32>,
    pub(super) scratch: &'a mut Scratch,
}

impl<const D: usize> Kernel for Look<'_, D> {
    type Output = ();
    #[inline(always)]
    fn run<L: Lane>(self) {
        let eights = &mut self.scratch.eights;
        self.found.clear();
        let mut piece = 0;
        for slaves in self.slaves {
            let mut count = 0;
            for &(from, to) in &self.pieces[piece..slaves.pieces] {
                let (from, last) = (from as usize, to as usize - 1);
                let (first_eight, last_eight) = (from / GROUP, last / GROUP);
                if eights.len() < count + last_eight - first_eight + 1 {
                    eights.resize(count + last_eight - first_eight + 1, (0, 0));
                }
                for eight in first_eight..=last_eight {
                    let mut bits = self.sorted[eight].meet::<L>(&slaves.extent);
                    bits &= if eight == first_eight { 0xff << (from % GROUP) } else { 0xff };
                    bits &= if eight == last_eight { 0xff >> (GROUP - 1 - last % GROUP) } else { 0xff };
                    eights[count] = (eight as u32, bits);
                    count += usize::from(bits != 0);
                }
            }
            piece = slaves.pieces;
            for &(eight, mut bits) in &eights[..count] {
                while bits != 0 {
                    self.found.push(self.order[eight as usize * GROUP + bits.trailing_zeros() as usize]);
                    bits &= bits - 1;
                }
            }
            if !slaves.extent.is_none() {
                self.found.extend_from_slice(self.unbounded);
            }
            slaves.found = self.found.len();
        }
    }
}

/// The facets that each slave node meets, ascending, among those of the groups that its group found.
pub(super) struct Compare<'a, const D: usize> {
    pub(super) slaves: &'a [SlaveGroup<D>],
    pub(super) groups: &'a [Group<D>],
    pub(super) found: &'a [u32],
    pub(super) facets: &'a [Hulls<D>],
    pub(super) scratch: &'a mut Scratch,
    pub(super) meetings: &'a mut Vec<Meeting>,
}

impl<const D: usize> Kernel for Compare<'_, D> {
    /// Number of meetings; what lies behind them in the list is old.
    type Output = usize;
    #[inline(always)]
    fn run<L: Lane>(self) -> usize {
        let Scratch { near, met, with_groups, .. } = self.scratch;
        let (mut first, mut end) = (0, 0);
        for (slaves, number) in self.slaves.iter().zip(0_u32..) {
            let found = &self.found[first..slaves.found];
            first = slaves.found;
            if near.len() < found.len() {
                near.resize(found.len(), 0);
            }
            let mut count = 0;
            let all = 0xff >> (GROUP - slaves.count);
            for &group in found {
                let met = all & slaves.paths.may_meet::<L>(&self.groups[group as usize].hull);
                near[count] = u64::from(group) << GROUP | u64::from(met);
                count += usize::from(met != 0);
            }
            let near = &mut near[..count];
            near.sort_unstable();
            let places = number * GROUP as u32;
            met.clear();
            let mut last = u64::MAX;
            for &entry in &*near {
                let group = &self.groups[(entry >> GROUP) as usize];
                let bits = (0xff >> (GROUP as u32 - (group.end - group.begin))) << (group.begin % GROUP as u32);
                // On a rolled up grid two rows of cells may share buckets: a group may be found twice.
                let slaves_met = if entry == last { 0 } else { entry as u32 };
                met.push((slaves_met, Meeting { slave: slaves.begin as u32, place: places, eight: group.begin / GROUP as u32, bits }));
                last = entry;
            }
            if with_groups.len() < end + GROUP * count {
                with_groups.resize(end + GROUP * count, Meeting::default());
            }
            for k in 0..slaves.count as u32 {
                for &(slaves_met, group) in &*met {
                    with_groups[end] = Meeting { slave: group.slave + k, place: group.place + k, ..group };
                    end += (slaves_met >> k & 1) as usize;
                }
            }
        }
        if self.meetings.len() < end {
            self.meetings.resize(end, Meeting::default());
        }
        let mut kept = 0;
        for meeting in &with_groups[..end] {
            let path = self.slaves[meeting.place as usize / GROUP].paths.at(meeting.place as usize);
            let bits = meeting.bits & self.facets[meeting.eight as usize].meet::<L>(&path);
            self.meetings[kept] = Meeting { bits, ..*meeting };
            kept += usize::from(bits != 0);
        }
        kept
    }
}
