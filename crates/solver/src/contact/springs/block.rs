//! Springs that are solved eight at a time: their rows on the nodes that they move, and what they have in
//! common with other blocks.
//!
//! A block holds some small islands, or a cluster of the springs of a large one. [`super::solve`] fills it
//! from the ends of springs, [`super::sweep`] relaxes it. A spring knows the others by the velocities of its
//! nodes alone, which begin at zero without springs: what a force changes is then exact to its own last
//! digits, however fast the bodies move. Here are springs of elastic laws on nodes that yield alike in all
//! directions that are free, in clusters on rigid bodies too ([`super::grips`]); islands with others
//! (constraints, oblique dashpots, small ones with rigid bodies) go to [`super::relax`].

use super::batches::Batches;
use super::grips::{Grip, Pushes, Velocities};
use super::head::{Axes, Gaps, Head, Rub};
use super::islands::NONE;
use super::link::{Joints, begins};
use super::sweep::{gap_row, normal};
use super::{Along, NodeResponse, NodeResponses, TangentSpace, Tangential};
use crate::tensor::Dim;
use embate_lanes::{BATCH, Batch, Kernel, Lane, Places, Room};
use std::ops::Range;

/// Springs that agree by themselves.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Part {
    /// Where its springs end.
    pub(super) end: u32,
    /// Largest change and largest force of the last sweep, and the change of the one before, N/m.
    pub(super) change: f64,
    pub(super) largest: f64,
    pub(super) before: f64,
    pub(super) sweeps: u32,
    pub(super) is_done: bool,
    /// Whether it is one spring across the surface: what it finds first is its force.
    pub(super) is_alone: bool,
    /// Whether it always goes to [`super::relax`] instead, and whether it does in this step.
    pub(super) is_barred: bool,
    pub(super) is_general: bool,
}

/// What rows have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A share of the normal, on what yields in all directions.
    Plain,
    /// More across the surface, and nothing along it.
    Normal,
    /// Also something along the surface.
    Sliding,
}

/// Springs, eight at a time.
#[derive(Default)]
pub(super) struct Block<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    batches: Batches,
    /// Numbers of the springs, and batch and lane of each.
    pub(super) springs: Vec<u32>,
    pub(super) at: Vec<(u32, u8)>,
    /// Spring (counted from the first of the block) and part of each lane; [`NONE`]: no spring.
    pub(super) lanes: Vec<[u32; BATCH]>,
    pub(super) part_of: Vec<[u32; BATCH]>,
    pub(super) parts: Vec<Part>,
    /// Of each batch the first of its arms, and where they end.
    arms_of: Vec<[u32; 2]>,
    pub(super) heads: Vec<Head>,
    pub(super) gaps: Vec<Gaps>,
    /// Normal forces and friction along each tangent, N/m.
    pub(super) forces: Axes,
    /// Rates of the gap and of the slips before the update, and after it without springs, m/s.
    pub(super) old: Axes,
    pub(super) free: Axes,
    /// What forces of a spring do to its own rates; empty where none cares for slip.
    pub(super) own: Vec<[[Batch; D]; D]>,
    /// As long as that where friction is found in lanes.
    pub(super) rubs: Vec<Rub<D>>,
    /// Of each spring its elastic slip at n + ½, m, and whether friction is at its limit, where it is found
    /// one by one.
    pub(super) slid: Vec<(Along<D>, bool)>,
    /// Room of each arm, and its share in the gap: with the normals of the springs the row of the gap's rate,
    /// where these are all there is to it.
    pub(super) places: Places,
    pub(super) shares: Vec<Batch>,
    pub(super) normals: Vec<[Batch; D]>,
    is_plain: bool,
    /// Else rows of the gap, and of the slips D − 1 for each; the last are empty where none cares.
    pub(super) rows: Vec<[Batch; D]>,
    pub(super) slips: Vec<[Batch; D]>,
    /// What springs added to the velocity of each mover, then its mobility; the first is nobody's.
    pub(super) rooms: Vec<Room>,
    /// Velocities before the update, after it without springs, and ones for the axes along which they move,
    /// as far as any does not along all.
    rooms_old: Vec<Room>,
    rooms_free: Vec<Room>,
    axes: Vec<Room>,
    /// Whether springs end at what they do not move while they are swept, whether some end twice at the same,
    /// and whether some end at rigid bodies that follow after each sweep.
    has_fixed_ends: bool,
    has_common_ends: bool,
    pub(super) has_grips: bool,
    /// Springs at those bodies, what these have added to the rates of gap and slips in the present sweep, and
    /// what the springs push with.
    pub(super) grips: Vec<Grip<D>>,
    pub(super) lent: Axes,
    pub(super) pushes: Pushes,
    /// Place and part of each mover.
    movers: Vec<(u32, u32)>,
    /// Row of each end; [`NONE`]: its spring does not move it in a sweep.
    pub(super) arms: Vec<u32>,
    /// The rooms of a spring while it is placed.
    slots: Vec<u32>,
    /// Rooms that other blocks have as well, and their numbers there.
    shared: Vec<[u32; 2]>,
}

impl<const D: usize> Block<D>
where
    Dim<D>: TangentSpace<D>,
{
    /// Number of a spring in the list.
    #[inline]
    pub(super) fn number(&self, spring: u32) -> u32 {
        self.springs[spring as usize]
    }

    /// Whether anything cares for slip.
    pub(super) fn slides(&self) -> bool {
        !self.own.is_empty()
    }

    /// Arms of a batch.
    #[inline(always)]
    pub(super) fn arms(&self, batch: usize) -> Range<usize> {
        let [first, end] = self.arms_of[batch];
        first as usize..end as usize
    }

    /// With which kernels it is solved.
    pub(super) fn kind(&self) -> Kind {
        match self.slides() {
            true => Kind::Sliding,
            false if self.is_plain => Kind::Plain,
            false => Kind::Normal,
        }
    }

    /// Takes the `springs` of islands that end at `ends`. `rooms` is memory to work in: a [`NONE`] for each
    /// place.
    pub(super) fn arrange<M: NodeResponses<D> + Sync>(
        &mut self,
        joints: &Joints<'_, M, D>,
        springs: &[u32],
        ends: impl Iterator<Item = u32>,
        (rooms, is_cluster): (&mut [u32], bool),
    ) {
        self.parts.clear();
        self.parts.extend(ends.map(|end| Part { end, ..Part::default() }));
        self.springs.clear();
        self.springs.extend_from_slice(springs);
        self.find_movers(joints, (rooms, is_cluster));
        self.set_lanes(joints);
        let (slides, mut begin) = (self.slides(), 0);
        for part in &mut self.parts {
            part.is_alone = part.end - begin == 1 && !slides;
            begin = part.end;
        }
        self.set_arms(joints);
        self.movers[1..].iter().for_each(|&(place, _)| rooms[place as usize] = NONE);
    }

    /// What the springs move, and which spring goes where; rooms of the ends go to `arms`.
    fn find_movers<M: NodeResponses<D> + Sync>(&mut self, joints: &Joints<'_, M, D>, (rooms, is_cluster): (&mut [u32], bool)) {
        let Self { batches, at, springs, parts, movers, arms, slots, .. } = self;
        let (nodes, mut part) = (joints.update.nodes.count(), 0);
        batches.clear();
        batches.add_slot();
        at.clear();
        movers.clear();
        movers.push((NONE, 0));
        arms.clear();
        (self.has_fixed_ends, self.has_common_ends, self.has_grips) = (false, false, false);
        for (spring, &number) in springs.iter().enumerate() {
            part += usize::from(spring as u32 == parts[part].end);
            let mut is_general = !joints.laws.terms(number).law.is_elastic();
            slots.clear();
            for k in joints.laws.list[number as usize].ends() {
                let place = joints.places[k];
                let is_body = joints.at[place as usize] as usize >= nodes;
                let is_fixed = joints.slots[place as usize] == NONE;
                if is_fixed || (is_body && is_cluster) {
                    self.has_grips |= !is_fixed;
                    self.has_fixed_ends = true;
                    arms.push(NONE);
                    continue;
                }
                let room = &mut rooms[place as usize];
                if *room == NONE {
                    *room = movers.len() as u32;
                    movers.push((place, part as u32));
                    batches.add_slot();
                    is_general |= is_body;
                }
                arms.push(*room);
                if slots.contains(room) {
                    self.has_common_ends = true;
                } else {
                    slots.push(*room);
                }
            }
            parts[part].is_barred |= is_general;
            at.push(if parts[part].is_barred { (NONE, 0) } else { batches.place(slots) });
        }
    }

    /// Who is in which lane, and room for what belongs to them.
    fn set_lanes<M: NodeResponses<D> + Sync>(&mut self, joints: &Joints<'_, M, D>) {
        let count = self.batches.filled.len();
        let slides = self.springs.iter().any(|&number| !matches!(joints.laws.terms(number).tangential, Tangential::Free));
        self.heads.clear();
        self.heads.resize(count, Head::default());
        self.arms_of.clear();
        self.arms_of.resize(count, [0; 2]);
        self.lanes.clear();
        self.lanes.resize(count, [NONE; BATCH]);
        self.part_of.clear();
        self.part_of.resize(count, [0; BATCH]);
        for list in [&mut self.forces, &mut self.old, &mut self.free] {
            list.clear(count, if slides { D } else { 1 });
        }
        self.lent.clear(if self.has_grips { count } else { 0 }, if slides { D } else { 1 });
        self.own.clear();
        self.own.resize(if slides { count } else { 0 }, [[Batch::default(); D]; D]);
        let in_lanes = |&number: &u32| match joints.laws.terms(number).tangential {
            Tangential::Free => true,
            Tangential::Friction(_) => joints.laws.terms(number).law.slip_stiffness(&joints.laws.list[number as usize].patch()).is_finite(),
            Tangential::Tied => false,
        };
        self.rubs.clear();
        self.rubs.resize(if slides && self.springs.iter().all(in_lanes) { count } else { 0 }, Rub::default());
        self.slid.clear();
        self.slid.resize(if slides && self.rubs.is_empty() { self.springs.len() } else { 0 }, Default::default());
        self.gaps.clear();
        self.gaps.resize(count, Gaps::default());
        self.normals.clear();
        self.normals.resize(if slides { 0 } else { count }, [Batch::default(); D]);
        let mut part = 0;
        for (spring, &(batch, lane)) in self.at.iter().enumerate() {
            part += u32::from(spring as u32 == self.parts[part as usize].end);
            if batch != NONE {
                let [_, count] = &mut self.arms_of[batch as usize];
                *count = (*count).max(joints.laws.list[self.springs[spring] as usize].count);
                self.lanes[batch as usize][usize::from(lane)] = spring as u32;
                self.part_of[batch as usize][usize::from(lane)] = part;
            }
        }
        let mut arms = 0;
        for [first, end] in &mut self.arms_of {
            *first = arms;
            arms += *end;
            *end = arms;
        }
        self.places.clear();
        self.places.resize(arms as usize);
        self.shares.clear();
        self.shares.resize(if slides { 0 } else { arms as usize }, Batch::default());
        // Filled where they are needed.
        self.rows.clear();
        self.slips.clear();
    }

    /// The row of each end instead of its room: one for those that move as one.
    fn set_arms<M: NodeResponses<D> + Sync>(&mut self, joints: &Joints<'_, M, D>) {
        let mut ends = self.arms.iter_mut();
        for (&number, &(batch, lane)) in self.springs.iter().zip(&self.at) {
            let (mut count, lane) = (0, usize::from(lane));
            for end in ends.by_ref().take(joints.laws.list[number as usize].count as usize) {
                if *end == NONE || batch == NONE {
                    continue;
                }
                let [first, _] = self.arms_of[batch as usize];
                let known = (first..first + count).find(|&arm| self.places.get(arm as usize, lane) == *end as usize);
                let arm = known.unwrap_or(first + count);
                count += u32::from(known.is_none());
                self.places.set(arm as usize, lane, *end);
                *end = arm;
            }
        }
    }

    /// Takes the state of the step: no force acts yet; `bodies` are those that follow after each sweep.
    pub(super) fn load<M: NodeResponses<D> + Sync>(&mut self, joints: &Joints<'_, M, D>, bodies: &Velocities<D>) {
        for part in &mut self.parts {
            let Part { end, is_alone, is_barred, .. } = *part;
            *part = Part { end, is_alone, is_barred, is_general: is_barred, is_done: is_barred, ..Part::default() };
        }
        self.is_plain = self.load_movers(joints) && !self.slides() && !self.has_common_ends;
        self.forces.fill();
        self.slid.fill(Default::default());
        if self.has_fixed_ends {
            self.old.fill();
            self.free.fill();
        }
        self.is_plain = self.is_plain && self.load_shares(joints);
        if !self.is_plain {
            self.load_rows(joints);
        }
        if self.has_fixed_ends {
            self.add_fixed_ends(joints);
        }
        self.load_grips(joints, bodies);
        let (level, half) = (joints.update.level, 0.5 * joints.laws.time_steps[1]);
        match self.kind() {
            Kind::Plain => level.run(Prepare::<false, true, D> { block: self, half }),
            Kind::Normal => level.run(Prepare::<false, false, D> { block: self, half }),
            Kind::Sliding => level.run(Prepare::<true, false, D> { block: self, half }),
        }
        for spring in 0..self.springs.len() {
            if self.at[spring].0 != NONE {
                self.set_head(joints, spring);
            }
        }
    }

    /// Velocities and mobilities of the movers; parts with one that does not yield alike along all axes that
    /// are free are for others. Whether all axes of all movers are free.
    fn load_movers<M: NodeResponses<D> + Sync>(&mut self, joints: &Joints<'_, M, D>) -> bool {
        let Self { movers, parts, rooms, rooms_old, rooms_free, axes, .. } = self;
        axes.clear();
        for list in [&mut *rooms, rooms_old, rooms_free] {
            list.clear();
            list.resize(movers.len(), Room::default());
        }
        for (room, &(place, part)) in movers.iter().enumerate().skip(1) {
            let part = &mut parts[part as usize];
            if part.is_barred {
                continue;
            }
            let NodeResponse { velocity_old, velocity, mobility: entries } =
                joints.update.nodes.response(joints.at[place as usize] as usize);
            let mobility = (0..D).fold(0.0, |most, d| f64::max(most, entries[Dim::<D>::AT[d][d]]));
            for i in 0..D {
                let moves = entries[Dim::<D>::AT[i][i]] != 0.0;
                if !moves {
                    axes.resize(movers.len(), Room([1.0; _]));
                    axes[room].0[i] = 0.0;
                }
                for j in i..D {
                    let expected = if i == j && moves { mobility } else { 0.0 };
                    part.is_general |= entries[Dim::<D>::AT[i][j]] != expected;
                }
            }
            part.is_done = part.is_general;
            rooms[room].0[D] = mobility;
            rooms_old[room].0[..D].copy_from_slice(&velocity_old);
            rooms_free[room].0[..D].copy_from_slice(&velocity);
        }
        axes.is_empty()
    }

    /// Elastic slip at n + ½ of the spring in a lane, m, and whether friction is at its limit.
    #[inline]
    pub(super) fn slid_at(&self, batch: usize, lane: usize) -> (Along<D>, bool) {
        let one_by_one = || self.slid[self.lanes[batch][lane] as usize];
        let in_lanes = |rub: &Rub<D>| (Dim::<D>::tangent_vector(|a| rub.slip_new[a + 1].0[lane]), rub.slides.0[lane] != 0.0);
        self.rubs.get(batch).map_or_else(one_by_one, in_lanes)
    }

    /// Goes through the springs that are in lanes: number of each in the list, of its first end in `arms`,
    /// and batch and lane.
    pub(super) fn in_lanes<'a, M: NodeResponses<D> + Sync>(
        (springs, at): (&'a [u32], &'a [(u32, u8)]),
        joints: &'a Joints<'_, M, D>,
    ) -> impl Iterator<Item = (u32, usize, [usize; 2])> {
        let mut next = 0;
        springs.iter().zip(at).filter_map(move |(&number, &(batch, lane))| {
            let first = next;
            next += joints.laws.list[number as usize].count as usize;
            (batch != NONE).then_some((number, first, [batch as usize, usize::from(lane)]))
        })
    }

    /// Shares and normals; `false`: some row has more.
    fn load_shares<M: NodeResponses<D> + Sync>(&mut self, joints: &Joints<'_, M, D>) -> bool {
        let Self { springs, at, arms, shares, normals, .. } = self;
        for (number, first, [batch, lane]) in Self::in_lanes((springs, at), joints) {
            let spring = &joints.laws.list[number as usize];
            normals[batch].iter_mut().zip(spring.normal).for_each(|(normal, n)| normal.0[lane] = n);
            for (&arm, k) in arms[first..].iter().zip(spring.ends()).filter(|(arm, _)| **arm != NONE) {
                let Some(share) = joints.ends.share_alone(k) else { return false };
                shares[arm as usize].0[lane] = share;
            }
        }
        true
    }

    /// Rows of all springs.
    fn load_rows<M: NodeResponses<D> + Sync>(&mut self, joints: &Joints<'_, M, D>) {
        let (slides, adds) = (self.slides(), self.has_common_ends);
        let Self { springs, at, arms, rows, slips, places, .. } = self;
        rows.resize(places.len(), [Batch::default(); D]);
        slips.resize(if slides { (D - 1) * places.len() } else { 0 }, [Batch::default(); D]);
        if adds {
            rows.iter_mut().chain(&mut *slips).for_each(|row| row.fill(Batch::default()));
        }
        for (number, first, [_, lane]) in Self::in_lanes((springs, at), joints) {
            let spring = &joints.laws.list[number as usize];
            let has_slip = slides && !matches!(joints.laws.terms(number).tangential, Tangential::Free);
            let tangents = joints.laws.tangents(number);
            for (&arm, k) in arms[first..].iter().zip(spring.ends()).filter(|(arm, _)| **arm != NONE) {
                let (arm, end) = (arm as usize, joints.ends.get(k));
                let turned = |row: [f64; D]| end.image().map_or(row, |turn| Dim::<D>::pull_back(turn, row));
                set_row(&mut rows[arm], lane, turned(end.gap_row(spring.normal)), adds);
                if has_slip {
                    let of_slips = end.slip_rows(&tangents);
                    for a in 0..D - 1 {
                        set_row(&mut slips[(D - 1) * arm + a], lane, turned(of_slips[a]), adds);
                    }
                }
            }
        }
    }

    /// What ends that do not move by forces add to the rates of their springs.
    fn add_fixed_ends<M: NodeResponses<D> + Sync>(&mut self, joints: &Joints<'_, M, D>) {
        let Self { springs, at, arms, old, free, .. } = self;
        for (number, first, [batch, lane]) in Self::in_lanes((springs, at), joints) {
            let spring = &joints.laws.list[number as usize];
            let has_slip = !matches!(joints.laws.terms(number).tangential, Tangential::Free);
            let is_fixed = |k: usize| joints.slots[joints.places[k] as usize] == NONE;
            for (_, k) in arms[first..].iter().zip(spring.ends()).filter(|(arm, k)| **arm == NONE && is_fixed(*k)) {
                let (end, fixed) = (joints.ends.get(k), joints.movable(k));
                let mut add = |axis: usize, row: [f64; D]| {
                    let [before, after] = fixed.rates(row, &end);
                    old[batch][axis].0[lane] += before;
                    free[batch][axis].0[lane] += after;
                };
                add(0, end.gap_row(spring.normal));
                if has_slip {
                    let slips = end.slip_rows(&joints.laws.tangents(number));
                    (1..D).for_each(|axis| add(axis, slips[axis - 1]));
                }
            }
        }
    }

    /// Gaps and law of a spring, with the rates that it has without springs.
    fn set_head<M: NodeResponses<D> + Sync>(&mut self, joints: &Joints<'_, M, D>, spring: usize) {
        let (number, (batch, lane)) = (self.springs[spring], self.at[spring]);
        let (batch, lane) = (batch as usize, usize::from(lane));
        let (data, terms) = (&joints.laws.list[number as usize], joints.laws.terms(number));
        let [before, after] = joints.laws.time_steps;
        let (old, free) = (&self.old[batch], &self.free[batch]);
        let (gap, gap_old) = begins(joints, number, old[0].0[lane], before);
        if let Some(rub) = self.rubs.get_mut(batch) {
            let slip_rate = Dim::<D>::tangent_vector(|a| old[a + 1].0[lane]);
            rub.set(lane, (data, terms), Dim::<D>::size(&slip_rate), joints.laws.slip(number).slip);
        }
        let gaps = &mut self.gaps[batch];
        let (compliance, gap_free) = (gaps.compliance.0[lane], gap + 0.5 * after * free[0].0[lane]);
        (gaps.now.0[lane], gaps.old.0[lane], gaps.free.0[lane]) = (gap, gap_old, gap_free);
        self.heads[batch].set(lane, (data, terms), [gap_old, gap_free, compliance], after);
    }

    /// Notes which rooms other blocks have as well; `of` says the number of a place there.
    pub(super) fn share(&mut self, of: impl Fn(u32) -> u32) {
        let movers = self.movers.iter().enumerate().skip(1);
        let shared = movers.map(|(room, &(place, _))| [room as u32, of(place)]).filter(|[_, shared]| *shared != NONE);
        self.shared.clear();
        self.shared.extend(shared);
    }

    /// Takes what others know of the rooms that they have as well; whether that is something new.
    #[inline]
    pub(super) fn take_over(&mut self, known: &[Room]) -> bool {
        let mut is_new = false;
        for &[room, shared] in &self.shared {
            let (own, known) = (&mut self.rooms[room as usize], known[shared as usize]);
            is_new |= *own != known;
            *own = known;
        }
        is_new
    }

    /// Whether its last sweep changed nothing at all: no more would, as long as others change nothing.
    pub(super) fn is_still(&self) -> bool {
        let Part { sweeps, change, .. } = self.parts[0];
        sweeps > 0 && change == 0.0 && self.grips.is_empty()
    }

    /// The other way round.
    #[inline]
    pub(super) fn hand_on(&self, known: &mut [Room]) {
        for &[room, shared] in &self.shared {
            known[shared as usize] = self.rooms[room as usize];
        }
    }
}

/// Sets a row in a lane, or adds it to what is there.
#[inline]
fn set_row<const D: usize>(rows: &mut [Batch; D], lane: usize, row: [f64; D], adds: bool) {
    for (kept, value) in rows.iter_mut().zip(row) {
        kept.0[lane] = if adds { kept.0[lane] + value } else { value };
    }
}

/// Finds the rates of all springs without forces, and what their own forces do to them; rows lose what is
/// along axes on which nothing moves.
struct Prepare<'a, const SLIDES: bool, const PLAIN: bool, const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    block: &'a mut Block<D>,
    /// Half the coming step, s.
    half: f64,
}

impl<const SLIDES: bool, const PLAIN: bool, const D: usize> Kernel for Prepare<'_, SLIDES, PLAIN, D>
where
    Dim<D>: TangentSpace<D>,
{
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        for batch in 0..self.block.heads.len() {
            for at in (0..BATCH).step_by(L::WIDTH) {
                prepare::<L, SLIDES, PLAIN, D>(self.block, batch, at, self.half);
            }
        }
    }
}

/// The same for the lanes of a batch from `at` on.
#[inline(always)]
fn prepare<L: Lane, const SLIDES: bool, const PLAIN: bool, const D: usize>(block: &mut Block<D>, batch: usize, at: usize, half: f64)
where
    Dim<D>: TangentSpace<D>,
{
    let axes = if SLIDES { D } else { 1 };
    let (mut old, mut free, mut own) = ([L::splat(0.0); D], [L::splat(0.0); D], [[L::splat(0.0); D]; D]);
    if block.has_fixed_ends {
        for axis in 0..axes {
            old[axis] = L::load(&block.old[batch][axis], at);
            free[axis] = L::load(&block.free[batch][axis], at);
        }
    }
    let normal = normal::<L, PLAIN, D>(block, batch, at);
    for arm in block.arms(batch) {
        let mut kept = [[L::splat(0.0); D]; D];
        kept[0] = gap_row::<L, PLAIN, D>(block, arm, at, &normal);
        let Block { rows, slips, rooms, rooms_old, rooms_free, axes: free_axes, places, .. } = &mut *block;
        let before = L::gather_rooms(rooms_old, places, arm, at);
        let after = L::gather_rooms(rooms_free, places, arm, at);
        let mobility = L::gather_rooms(rooms, places, arm, at)[D];
        for axis in 1..axes {
            for d in 0..D {
                kept[axis][d] = L::load(&slips[(D - 1) * arm + axis - 1][d], at);
            }
        }
        for axis in 0..axes {
            for d in 0..D {
                old[axis] += kept[axis][d] * before[d];
                free[axis] += kept[axis][d] * after[d];
            }
        }
        if !PLAIN && !free_axes.is_empty() {
            let moves = L::gather_rooms(free_axes, places, arm, at);
            for axis in 0..axes {
                let row = if axis == 0 { &mut rows[arm] } else { &mut slips[(D - 1) * arm + axis - 1] };
                for d in 0..D {
                    kept[axis][d] = kept[axis][d] * moves[d];
                    kept[axis][d].store(&mut row[d], at);
                }
            }
        }
        for on in 0..axes {
            for d in 0..D {
                let response = mobility * kept[on][d];
                for by in on..axes {
                    own[on][by] += response * kept[by][d];
                }
            }
        }
    }
    for axis in 0..axes {
        old[axis].store(&mut block.old[batch][axis], at);
        free[axis].store(&mut block.free[batch][axis], at);
        if SLIDES {
            for by in 0..axes {
                own[axis.min(by)][axis.max(by)].store(&mut block.own[batch][axis][by], at);
            }
        }
    }
    (L::splat(half) * own[0][0]).store(&mut block.gaps[batch].compliance, at);
}
