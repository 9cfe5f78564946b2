//! Springs that are solved eight at a time: their rows on the nodes that they move, and what they have in
//! common with other blocks.
//!
//! A block holds some small islands, or a cluster of the springs of a large one. [`super::solve`] fills it
//! from the ends of springs, [`super::sweep`] relaxes it. A spring knows the others by the velocities of its
//! nodes alone, which begin at zero without springs: what a force changes is then exact to its own last
//! digits, however fast the bodies move. Here are springs of elastic laws on nodes that yield alike in all
//! directions that are free; islands with others (rigid bodies, constraints, oblique dashpots) go to
//! [`super::relax`].

use super::batches::Batches;
use super::islands::NONE;
use super::link::{Joints, begins};
use super::{NodeResponse, NodeResponses, Solved, Spring, TangentSpace, Tangential, Terms};
use crate::tensor::Dim;
use embate_lanes::{BATCH, Batch, Kernel, Lane, Places, Room};
use std::ops::Range;

/// Eight springs: across the surface.
#[derive(Clone, Copy)]
pub(super) struct Head {
    /// Rows of the arms: the first one, and how many.
    pub(super) first: u32,
    pub(super) count: u32,
    /// g^{n−½}, and g^{n+½} without any force, m.
    pub(super) gap_old: Batch,
    pub(super) gap_free: Batch,
    /// Change of g^{n+½} per normal force.
    pub(super) compliance: Batch,
    /// k / (2 + k c): force per sum of both gaps, while it is linear in them.
    pub(super) stiffness: Batch,
    /// Gaps at n + ½ between which it is; none if it is not at n − ½.
    pub(super) linear: [Batch; 2],
    /// Gap without force from which on it stays open; none if it was not at n − ½.
    pub(super) open: Batch,
}

impl Default for Head {
    fn default() -> Self {
        let zero = Batch::default();
        let open = Batch::splat(f64::INFINITY);
        let linear = [Batch::splat(f64::NEG_INFINITY), open];
        Self { first: 0, count: 0, gap_old: zero, gap_free: zero, compliance: zero, stiffness: zero, linear, open }
    }
}

impl Head {
    /// Numbers of the rows.
    #[inline(always)]
    pub(super) fn arms(&self) -> Range<usize> {
        self.first as usize..(self.first + self.count) as usize
    }
}

/// Eight springs: along the surface, where friction has a finite stiffness. Entries from 1 on are those along
/// the tangents.
#[derive(Clone, Copy)]
pub(super) struct Rub<const D: usize> {
    /// Of the elastic slip, N/m.
    pub(super) stiffness: Batch,
    /// Most friction: per normal force, what it has beyond, and the most that there ever is, N.
    pub(super) limit: [Batch; 3],
    /// Elastic slip at n − ½ and n + ½, m, and ones where friction is at its limit.
    pub(super) slip: [Batch; D],
    pub(super) slip_new: [Batch; D],
    pub(super) slides: Batch,
}

impl<const D: usize> Default for Rub<D> {
    fn default() -> Self {
        let (zero, one) = (Batch::default(), Batch::splat(1.0));
        Self { stiffness: one, limit: [zero, zero, one], slip: [zero; D], slip_new: [zero; D], slides: zero }
    }
}

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
    /// Whether it always goes to [`super::relax`] instead, and whether it does in this step.
    pub(super) is_barred: bool,
    pub(super) is_general: bool,
}

/// Springs, eight at a time.
#[derive(Default)]
pub(super) struct Block<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    batches: Batches,
    /// Numbers of the springs, batch and lane of each, and what is found of them.
    springs: Vec<u32>,
    at: Vec<(u32, u8)>,
    pub(super) found: Vec<Solved<D>>,
    /// Spring (counted from the first of the block) and part of each lane; [`NONE`]: no spring.
    pub(super) lanes: Vec<[u32; BATCH]>,
    pub(super) part_of: Vec<[u32; BATCH]>,
    pub(super) parts: Vec<Part>,
    pub(super) heads: Vec<Head>,
    /// Normal forces and friction along each tangent, N/m.
    pub(super) forces: Vec<[Batch; D]>,
    /// Rates of the gap and of the slips before the update, and after it without springs, m/s.
    pub(super) old: Vec<[Batch; D]>,
    pub(super) free: Vec<[Batch; D]>,
    /// What forces of a spring do to its own rates; empty where none cares for slip.
    pub(super) own: Vec<[[Batch; D]; D]>,
    /// As long as that where friction is found in lanes.
    pub(super) rubs: Vec<Rub<D>>,
    /// Rooms, rows of the gap, and of the slips D − 1 for each; the last are empty where none cares.
    pub(super) places: Places,
    pub(super) rows: Vec<[Batch; D]>,
    pub(super) slips: Vec<[Batch; D]>,
    /// What springs added to the velocity of each mover, then its mobility; the first is nobody's.
    pub(super) rooms: Vec<Room>,
    /// Velocities before the update, after it without springs, and ones for the axes along which they move.
    rooms_old: Vec<Room>,
    rooms_free: Vec<Room>,
    axes: Vec<Room>,
    /// Whether springs end at what does not move, and whether some end twice at the same.
    has_fixed_ends: bool,
    has_common_ends: bool,
    /// Place and part of each mover.
    movers: Vec<(u32, u32)>,
    /// Row of each end; [`NONE`]: it does not move.
    arms: Vec<u32>,
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

    /// Takes the `springs` of islands that end at `ends`. `rooms` is memory to work in: a [`NONE`] for each
    /// place.
    pub(super) fn arrange<M: NodeResponses<D> + Sync>(
        &mut self,
        joints: &Joints<'_, M, D>,
        springs: &[u32],
        ends: impl Iterator<Item = u32>,
        rooms: &mut [u32],
    ) {
        self.parts.clear();
        self.parts.extend(ends.map(|end| Part { end, ..Part::default() }));
        self.springs.clear();
        self.springs.extend_from_slice(springs);
        self.find_movers(joints, rooms);
        self.set_lanes(joints);
        self.set_arms(joints);
        self.movers[1..].iter().for_each(|&(place, _)| rooms[place as usize] = NONE);
    }

    /// What the springs move, and which spring goes where; rooms of the ends go to `arms`.
    fn find_movers<M: NodeResponses<D> + Sync>(&mut self, joints: &Joints<'_, M, D>, rooms: &mut [u32]) {
        let Self { batches, at, springs, parts, movers, arms, slots, .. } = self;
        let (nodes, mut part) = (joints.update.nodes.count(), 0);
        batches.clear();
        batches.add_slot();
        at.clear();
        movers.clear();
        movers.push((NONE, 0));
        arms.clear();
        (self.has_fixed_ends, self.has_common_ends) = (false, false);
        for (spring, &number) in springs.iter().enumerate() {
            part += usize::from(spring as u32 == parts[part].end);
            let mut is_general = !joints.laws.terms(number).law.is_elastic();
            slots.clear();
            for k in joints.laws.list[number as usize].ends() {
                let place = joints.places[k];
                if joints.slots[place as usize] == NONE {
                    self.has_fixed_ends = true;
                    arms.push(NONE);
                    continue;
                }
                let room = &mut rooms[place as usize];
                if *room == NONE {
                    *room = movers.len() as u32;
                    movers.push((place, part as u32));
                    batches.add_slot();
                    is_general |= joints.at[place as usize] as usize >= nodes;
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
        self.found.clear();
        self.found.resize(self.springs.len(), Solved::default());
        self.heads.clear();
        self.heads.resize(count, Head::default());
        self.lanes.clear();
        self.lanes.resize(count, [NONE; BATCH]);
        self.part_of.clear();
        self.part_of.resize(count, [0; BATCH]);
        for list in [&mut self.forces, &mut self.old, &mut self.free] {
            list.clear();
            list.resize(count, [Batch::default(); D]);
        }
        self.own.clear();
        self.own.resize(if slides { count } else { 0 }, [[Batch::default(); D]; D]);
        let in_lanes = |&number: &u32| match joints.laws.terms(number).tangential {
            Tangential::Free => true,
            Tangential::Friction(_) => joints.laws.terms(number).law.slip_stiffness(&joints.laws.list[number as usize].patch()).is_finite(),
            Tangential::Tied => false,
        };
        self.rubs.clear();
        self.rubs.resize(if slides && self.springs.iter().all(in_lanes) { count } else { 0 }, Rub::default());
        let mut part = 0;
        for (spring, &(batch, lane)) in self.at.iter().enumerate() {
            part += u32::from(spring as u32 == self.parts[part as usize].end);
            if batch != NONE {
                let head = &mut self.heads[batch as usize];
                head.count = head.count.max(joints.laws.list[self.springs[spring] as usize].count);
                self.lanes[batch as usize][usize::from(lane)] = spring as u32;
                self.part_of[batch as usize][usize::from(lane)] = part;
            }
        }
        let mut arms = 0;
        for head in &mut self.heads {
            head.first = arms;
            arms += head.count;
        }
        self.places.clear();
        self.places.resize(arms as usize);
        self.rows.clear();
        self.rows.resize(arms as usize, [Batch::default(); D]);
        self.slips.clear();
        self.slips.resize(if slides { (D - 1) * arms as usize } else { 0 }, [Batch::default(); D]);
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
                let first = self.heads[batch as usize].first;
                let known = (first..first + count).find(|&arm| self.places.get(arm as usize, lane) == *end as usize);
                let arm = known.unwrap_or(first + count);
                count += u32::from(known.is_none());
                self.places.set(arm as usize, lane, *end);
                *end = arm;
            }
        }
    }

    /// Takes the state of the step: no force acts yet.
    pub(super) fn load<M: NodeResponses<D> + Sync>(&mut self, joints: &Joints<'_, M, D>) {
        for part in &mut self.parts {
            *part =
                Part { end: part.end, is_barred: part.is_barred, is_general: part.is_barred, is_done: part.is_barred, ..Part::default() };
        }
        self.load_movers(joints);
        let axes = if self.slides() { D } else { 1 };
        self.forces.iter_mut().for_each(|forces| forces[..axes].fill(Batch::default()));
        if self.has_fixed_ends {
            self.old.iter_mut().chain(&mut self.free).for_each(|rates| rates[..axes].fill(Batch::default()));
        }
        if self.has_common_ends {
            self.rows.iter_mut().chain(&mut self.slips).for_each(|row| row.fill(Batch::default()));
        }
        let mut end = 0;
        for spring in 0..self.springs.len() {
            if self.at[spring].0 != NONE {
                self.load_rows(joints, spring, end);
            }
            end += joints.laws.list[self.springs[spring] as usize].count as usize;
        }
        let (level, half) = (joints.update.level, 0.5 * joints.laws.time_steps[1]);
        if self.slides() {
            level.run(Prepare::<true, D> { block: self, half });
        } else {
            level.run(Prepare::<false, D> { block: self, half });
        }
        for spring in 0..self.springs.len() {
            if self.at[spring].0 != NONE {
                self.set_head(joints, spring);
            }
        }
    }

    /// Velocities and mobilities of the movers; parts with one that does not yield alike along all axes that
    /// are free are for others.
    fn load_movers<M: NodeResponses<D> + Sync>(&mut self, joints: &Joints<'_, M, D>) {
        let Self { movers, parts, rooms, rooms_old, rooms_free, axes, .. } = self;
        for list in [&mut *rooms, rooms_old, rooms_free, axes] {
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
                axes[room].0[i] = if moves { 1.0 } else { 0.0 };
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
    }

    /// The rows of a spring, whose ends are those from `first` on.
    fn load_rows<M: NodeResponses<D> + Sync>(&mut self, joints: &Joints<'_, M, D>, spring: usize, first: usize) {
        let (number, (batch, lane)) = (self.springs[spring], self.at[spring]);
        let (data, lane) = (&joints.laws.list[number as usize], usize::from(lane));
        let has_slip = self.slides() && !matches!(joints.laws.terms(number).tangential, Tangential::Free);
        let tangents = if has_slip { data.tangents() } else { Default::default() };
        for (index, k) in data.ends().enumerate() {
            let (arm, end) = (self.arms[first + index], joints.ends.get(k));
            if arm == NONE {
                self.add_fixed(joints, k, batch as usize, lane);
                continue;
            }
            let turned = |row: [f64; D]| end.image().map_or(row, |turn| Dim::<D>::pull_back(turn, row));
            let arm = arm as usize;
            set_row(&mut self.rows[arm], lane, turned(end.gap_row(data.normal)), self.has_common_ends);
            if has_slip {
                let slips = end.slip_rows(&tangents);
                for a in 0..D - 1 {
                    set_row(&mut self.slips[(D - 1) * arm + a], lane, turned(slips[a]), self.has_common_ends);
                }
            }
        }
    }

    /// What an end that does not move by forces adds to the rates of its spring.
    fn add_fixed<M: NodeResponses<D> + Sync>(&mut self, joints: &Joints<'_, M, D>, k: usize, batch: usize, lane: usize) {
        let spring = &joints.laws.list[self.springs[self.lanes[batch][lane] as usize] as usize];
        let (end, fixed) = (joints.ends.get(k), joints.movable(k));
        let mut add = |axis: usize, row: [f64; D]| {
            let [old, free] = fixed.rates(row, &end);
            self.old[batch][axis].0[lane] += old;
            self.free[batch][axis].0[lane] += free;
        };
        add(0, end.gap_row(spring.normal));
        if !matches!(joints.laws.terms(self.springs[self.lanes[batch][lane] as usize]).tangential, Tangential::Free) {
            let slips = end.slip_rows(&spring.tangents());
            (1..D).for_each(|axis| add(axis, slips[axis - 1]));
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
        let slips = |rates: &[Batch; D]| Dim::<D>::tangent_vector(|a| rates[a + 1].0[lane]);
        let (rates, slip_rates) = ([old[0].0[lane], free[0].0[lane]], [slips(old), slips(free)]);
        self.found[spring] = Solved { gap, rates, slip_rates, ..Solved::default() };
        if let Some(rub) = self.rubs.get_mut(batch) {
            set_rub(rub, lane, data, terms, Dim::<D>::size(&slip_rates[0]));
        }
        let head = &mut self.heads[batch];
        let compliance = head.compliance.0[lane];
        head.gap_old.0[lane] = gap_old;
        head.gap_free.0[lane] = gap + 0.5 * after * rates[1];
        let linear = if terms.damping > 0.0 { None } else { terms.law.linear(&data.patch()) };
        let [low, high] = linear.filter(|[low, high]| (*low..=*high).contains(&gap_old)).unwrap_or([f64::INFINITY, f64::NEG_INFINITY]);
        (head.linear[0].0[lane], head.linear[1].0[lane]) = (low, high);
        head.stiffness.0[lane] = data.stiffness / (2.0 + data.stiffness * compliance);
        let reach = linear.map_or_else(|| terms.law.reach(), |[_, high]| high);
        head.open.0[lane] = if gap_old >= reach { reach } else { f64::INFINITY };
    }

    /// Notes which rooms other blocks have as well; `of` says the number of a place there.
    pub(super) fn share(&mut self, of: impl Fn(u32) -> u32) {
        let movers = self.movers.iter().enumerate().skip(1);
        let shared = movers.map(|(room, &(place, _))| [room as u32, of(place)]).filter(|[_, shared]| *shared != NONE);
        self.shared.clear();
        self.shared.extend(shared);
    }

    /// Takes what others know of the rooms that they have as well.
    #[inline]
    pub(super) fn take_over(&mut self, known: &[Room]) {
        for &[room, shared] in &self.shared {
            self.rooms[room as usize] = known[shared as usize];
        }
    }

    /// The other way round.
    #[inline]
    pub(super) fn hand_on(&self, known: &mut [Room]) {
        for &[room, shared] in &self.shared {
            known[shared as usize] = self.rooms[room as usize];
        }
    }
}

/// Puts friction of a spring that slid at a rate (m/s) into a lane.
fn set_rub<const D: usize>(rub: &mut Rub<D>, lane: usize, spring: &Spring<D>, terms: &Terms, slip_rate: f64)
where
    Dim<D>: TangentSpace<D>,
{
    let Tangential::Friction(friction) = terms.tangential else { return };
    rub.stiffness.0[lane] = terms.law.slip_stiffness(&spring.patch());
    for (kept, value) in rub.limit.iter_mut().zip(friction.limits(spring.area, slip_rate)) {
        kept.0[lane] = value;
    }
    (1..D).for_each(|axis| rub.slip[axis].0[lane] = spring.slip[axis - 1]);
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
struct Prepare<'a, const SLIDES: bool, const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    block: &'a mut Block<D>,
    /// Half the coming step, s.
    half: f64,
}

impl<const SLIDES: bool, const D: usize> Kernel for Prepare<'_, SLIDES, D>
where
    Dim<D>: TangentSpace<D>,
{
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        for batch in 0..self.block.heads.len() {
            for at in (0..BATCH).step_by(L::WIDTH) {
                prepare::<L, SLIDES, D>(self.block, batch, at, self.half);
            }
        }
    }
}

/// The same for the lanes of a batch from `at` on.
#[inline(always)]
fn prepare<L: Lane, const SLIDES: bool, const D: usize>(block: &mut Block<D>, batch: usize, at: usize, half: f64)
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
    let Block { heads, rows, slips, rooms, rooms_old, rooms_free, axes: free_axes, places, .. } = &mut *block;
    let head = &heads[batch];
    for arm in head.arms() {
        let before = L::gather_rooms(rooms_old, places, arm, at);
        let after = L::gather_rooms(rooms_free, places, arm, at);
        let mobility = L::gather_rooms(rooms, places, arm, at)[D];
        let moves = L::gather_rooms(free_axes, places, arm, at);
        let mut kept = [[L::splat(0.0); D]; D];
        for axis in 0..axes {
            let row = if axis == 0 { &mut rows[arm] } else { &mut slips[(D - 1) * arm + axis - 1] };
            for d in 0..D {
                let value = L::load(&row[d], at);
                old[axis] += value * before[d];
                free[axis] += value * after[d];
                kept[axis][d] = value * moves[d];
                kept[axis][d].store(&mut row[d], at);
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
    (L::splat(half) * own[0][0]).store(&mut block.heads[batch].compliance, at);
}
