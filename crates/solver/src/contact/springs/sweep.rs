//! Sweeps over springs eight at a time: Gauss-Seidel over the batches of a block, normal force and friction
//! in turn.
//!
//! A batch reads the velocities of its nodes, finds the forces that its laws want there, and gives the nodes
//! what these change. Most springs are closed all along the update, or open: their force is an expression in
//! the rate of the gap ([`super::block::Head`]). Others ask their law.

use super::block::{Block, Part};
use super::friction::{FrictionInput, FrictionResult, lanes};
use super::islands::NONE;
use super::link::Laws;
use super::relax::TOLERANCE;
use super::solve::Results;
use super::{Closing, Patch, Slid, Solved, TangentSpace, Tangential};
use crate::tensor::Dim;
use embate_lanes::{BATCH, Batch, Kernel, Lane, math, prefetch};

/// Sweeps after which an island is left to [`super::relax`].
pub(super) const MOST: u32 = 80;
/// The same of large islands in 3D, where predictions are too much work, so that it has nothing but sweeps.
pub(super) const MOST_IN_SPACE: u32 = 400;
/// Sweeps still to come that are too many, as a fraction of the most.
const TOO_MANY: f64 = 0.75;
/// What counts as round-off, as a fraction of the tolerance.
const ROUND_OFF: f64 = 1e-3;
/// Sweeps before it is asked how many are still to come.
const WARM: u32 = 5;

impl Part {
    /// After a sweep: whether it is done, or, after `most` of them, left to others. It is done where what all
    /// sweeps to come would change, as a geometric series, is below the tolerance, or the last change is
    /// round-off.
    pub(super) fn close_sweep(&mut self, most: u32) {
        self.sweeps += 1;
        let (change, least) = (self.change, TOLERANCE * self.largest);
        let rate = if self.sweeps > 1 { change / self.before } else { 0.0 };
        let still = if rate < 1.0 { change * f64::max(rate / (1.0 - rate), 1.0) } else { f64::INFINITY };
        self.is_done = self.is_alone || still <= least || change <= ROUND_OFF * least;
        if !self.is_done && self.sweeps > WARM {
            let left = if rate < 1.0 { math::ln(least / still) / math::ln(rate) } else { f64::INFINITY };
            self.is_general = self.sweeps >= most || left > TOO_MANY * f64::from(most);
            self.is_done = self.is_general;
        }
        self.before = change;
    }
}

/// A sweep over a block. Largest changes and forces go to its parts.
pub(super) struct Relax<'a, const SLIDES: bool, const PLAIN: bool, const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    pub(super) block: &'a mut Block<D>,
    pub(super) laws: Laws<'a, D>,
}

impl<const SLIDES: bool, const PLAIN: bool, const D: usize> Kernel for Relax<'_, SLIDES, PLAIN, D>
where
    Dim<D>: TangentSpace<D>,
{
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(mut self) {
        for part in self.block.parts.iter_mut().filter(|part| !part.is_done) {
            (part.change, part.largest) = (0.0, 0.0);
        }
        let mut seen = [L::splat(0.0); 2];
        let is_one = self.block.parts.len() == 1;
        for batch in 0..self.block.heads.len() {
            if is_one {
                for at in (0..BATCH).step_by(L::WIDTH) {
                    self.relax(batch, at, None, &mut seen);
                }
                continue;
            }
            let Some(still) = self.still(batch) else { continue };
            let mut own = [Batch::default(); 2];
            for at in (0..BATCH).step_by(L::WIDTH) {
                let mut seen = [L::splat(0.0); 2];
                self.relax(batch, at, Some(&still), &mut seen);
                seen[0].store(&mut own[0], at);
                seen[1].store(&mut own[1], at);
            }
            let block = &mut *self.block;
            for lane in 0..BATCH {
                let part = &mut block.parts[block.part_of[batch][lane] as usize];
                if !part.is_done {
                    part.change = part.change.max(own[0].0[lane]);
                    part.largest = part.largest.max(own[1].0[lane]);
                }
            }
        }
        if is_one {
            let mut own = [Batch::default(); 2];
            seen[0].store(&mut own[0], 0);
            seen[1].store(&mut own[1], 0);
            let part = &mut self.block.parts[0];
            part.change = own[0].0[..L::WIDTH].iter().copied().fold(0.0, f64::max);
            part.largest = own[1].0[..L::WIDTH].iter().copied().fold(0.0, f64::max);
        }
    }
}

impl<const SLIDES: bool, const PLAIN: bool, const D: usize> Relax<'_, SLIDES, PLAIN, D>
where
    Dim<D>: TangentSpace<D>,
{
    /// Ones where the springs of a batch are done; `None`: all are.
    fn still(&self, batch: usize) -> Option<Batch> {
        let mut still = Batch::splat(1.0);
        for (lane, &part) in self.block.part_of[batch].iter().enumerate() {
            if !self.block.parts[part as usize].is_done && self.block.lanes[batch][lane] != NONE {
                still.0[lane] = 0.0;
            }
        }
        (still != Batch::splat(1.0)).then_some(still)
    }

    /// Relaxes the springs of a batch in lanes from `at` on, and sees how much that changes.
    #[inline(always)]
    fn relax<L: Lane>(&mut self, batch: usize, at: usize, still: Option<&Batch>, seen: &mut [L; 2]) {
        // What most springs have in 2D and 3D, or between two facets, keeps its rooms.
        match self.block.arms(batch).len() {
            3 => self.relax_arms::<L, 3>(batch, at, still, seen),
            4 => self.relax_arms::<L, 4>(batch, at, still, seen),
            5 => self.relax_arms::<L, 5>(batch, at, still, seen),
            8 => self.relax_arms::<L, 8>(batch, at, still, seen),
            _ => {
                let rates = rates::<L, SLIDES, PLAIN, D>(self.block, batch, at);
                let steps = self.find_forces((batch, at), (self.begun(batch, at), rates), still, seen);
                self.move_nodes(batch, at, &steps);
            }
        }
    }

    /// The same with so many arms.
    #[inline(always)]
    fn relax_arms<L: Lane, const A: usize>(&mut self, batch: usize, at: usize, still: Option<&Batch>, seen: &mut [L; 2]) {
        let (first, normal) = (self.block.arms(batch).start, normal::<L, PLAIN, D>(self.block, batch, at));
        let begun = self.begun(batch, at);
        if at == 0
            && let Some(next) = self.block.heads.get(batch + 1)
        {
            // Who waits for what is far does so while the one before is solved.
            prefetch(next);
        }
        let (mut kept, mut rates) = ([[L::splat(0.0); 4]; A], [[L::splat(0.0); D]; D]);
        for k in 0..A {
            kept[k] = L::gather_rooms(&self.block.rooms, &self.block.places, first + k, at);
            add_rates::<L, SLIDES, PLAIN, D>(self.block, first + k, at, (&kept[k], &normal), &mut rates);
        }
        let steps = self.find_forces((batch, at), (begun, sums(&rates)), still, seen);
        for k in 0..A {
            let room = self.moved(first + k, at, (kept[k], &normal), &steps);
            L::store_rooms(room, &mut self.block.rooms, &self.block.places, first + k, at);
        }
    }

    /// Normal forces of springs, and what does not depend on others in those that they will have.
    #[inline(always)]
    fn begun<L: Lane>(&self, batch: usize, at: usize) -> [L; 2] {
        let (head, force) = (&self.block.heads[batch], L::load(&self.block.forces[batch][0], at));
        [force, L::load(&head.terms[1], at) * force - L::load(&head.terms[0], at)]
    }

    /// Finds the forces of springs, of which this much is known ([`Self::begun`]), where all springs add
    /// `rates` to theirs: their steps.
    #[inline(always)]
    fn find_forces<L: Lane>(
        &mut self,
        (batch, at): (usize, usize),
        ([old_force, begun], mut rates): ([L; 2], [L; D]),
        still: Option<&Batch>,
        seen: &mut [L; 2],
    ) -> [L; D] {
        add_lent::<L, SLIDES, D>(self.block, batch, at, &mut rates);
        let head = &self.block.heads[batch];
        let closed = begun - L::load(&head.terms[2], at) * rates[0];
        let unknown = L::splat(f64::NAN);
        let mut force = L::select(closed.less(L::load(&head.linear[0], at)), unknown, closed);
        force = L::select(L::load(&head.linear[1], at).less(closed), unknown, force);
        force = L::select(L::load(&head.open, at).less(closed), force, L::splat(0.0));
        let known = L::bits(force.less(L::splat(f64::INFINITY)));
        if known != (1 << L::WIDTH) - 1 {
            force = self.ask(batch, at, known, rates[0], force);
        }
        if let Some(still) = still {
            force = L::select(L::splat(0.5).less(L::load(still, at)), old_force, force);
        }
        let mut steps = [L::splat(0.0); D];
        steps[0] = force - old_force;
        force.store(&mut self.block.forces[batch][0], at);
        see(seen, steps[0], force);
        if SLIDES {
            for axis in 1..D {
                steps[axis] = -L::load(&self.block.forces[batch][axis], at);
            }
            if self.block.rubs.is_empty() {
                self.slide(batch, at, rates, steps[0], still);
            } else {
                self.rub(batch, at, rates, steps[0], still);
            }
            for axis in 1..D {
                let new = L::load(&self.block.forces[batch][axis], at);
                steps[axis] += new;
                see(seen, steps[axis], new);
            }
        }
        steps
    }

    /// Gives the nodes what steps of the forces change.
    #[inline(always)]
    fn move_nodes<L: Lane>(&mut self, batch: usize, at: usize, steps: &[L; D]) {
        let normal = normal::<L, PLAIN, D>(self.block, batch, at);
        for arm in self.block.arms(batch) {
            let room = L::gather_rooms(&self.block.rooms, &self.block.places, arm, at);
            let room = self.moved(arm, at, (room, &normal), steps);
            L::store_rooms(room, &mut self.block.rooms, &self.block.places, arm, at);
        }
    }

    /// Rooms after steps of the forces of the springs that act there.
    #[inline(always)]
    fn moved<L: Lane>(&self, arm: usize, at: usize, (mut room, normal): ([L; 4], &[L; D]), steps: &[L; D]) -> [L; 4] {
        let slips = &self.block.slips;
        let (mobility, row) = (room[D], gap_row::<L, PLAIN, D>(self.block, arm, at, normal));
        for d in 0..D {
            let mut pull = row[d] * steps[0];
            if SLIDES {
                for axis in 1..D {
                    pull += L::load(&slips[(D - 1) * arm + axis - 1][d], at) * steps[axis];
                }
            }
            room[d] += mobility * pull;
        }
        room
    }

    /// Finds the friction of the springs in the lanes: all springs add `rates` to theirs, and their own
    /// normal forces have changed by `step` since.
    #[inline(always)]
    fn rub<L: Lane>(&mut self, batch: usize, at: usize, rates: [L; D], step: L, still: Option<&Batch>) {
        let block = &mut *self.block;
        let (forces, own, rub) = (&mut block.forces[batch], &block.own[batch], &mut block.rubs[batch]);
        let zero = L::splat(0.0);
        let [before, after] = self.laws.time_steps;
        let force = L::load(&forces[0], at);
        let [coefficient, added, most] = [L::load(&rub.limit[0], at), L::load(&rub.limit[1], at), L::load(&rub.limit[2], at)];
        let mut input = lanes::Input {
            old: [zero; D],
            free: [zero; D],
            compliance: [[zero; D]; D],
            slip: [zero; D],
            stiffness: L::load(&rub.stiffness, at),
            limit: L::select(zero.less(force), (coefficient * force + added).min(most), zero),
            quarter: L::splat(0.25 * 0.5 * (before + after)),
        };
        let mut any = force.abs();
        for on in 1..D {
            let mut mine = zero;
            for by in 1..D {
                input.compliance[on][by] = L::load(&own[on][by], at);
                mine += input.compliance[on][by] * L::load(&forces[by], at);
            }
            let others = (rates[on] - mine) + L::load(&own[on][0], at) * step;
            input.old[on] = L::load(&block.old[batch][on], at);
            input.free[on] = L::load(&block.free[batch][on], at) + others;
            input.slip[on] = L::load(&rub.slip[on], at);
            any = any.max(L::load(&forces[on], at).abs());
        }
        let (friction, slip, slides) = lanes::slide(&input);
        for axis in 1..D {
            // What is open has slid nowhere, whatever an earlier sweep gave it.
            let (mut new, mut slid) = (L::select(zero.less(any), friction[axis], zero), L::select(zero.less(any), slip[axis], zero));
            if let Some(still) = still {
                let is_still = L::splat(0.5).less(L::load(still, at));
                new = L::select(is_still, L::load(&forces[axis], at), new);
                slid = L::select(is_still, L::load(&rub.slip_new[axis], at), slid);
            }
            new.store(&mut forces[axis], at);
            slid.store(&mut rub.slip_new[axis], at);
        }
        let mut slides = L::select(zero.less(any), slides, zero);
        if let Some(still) = still {
            slides = L::select(L::splat(0.5).less(L::load(still, at)), L::load(&rub.slides, at), slides);
        }
        slides.store(&mut rub.slides, at);
    }

    /// Asks the laws of the springs whose force is not known, where all springs add `rate` to that of the
    /// gap.
    #[inline(never)]
    fn ask<L: Lane>(&self, batch: usize, at: usize, known: u32, rate: L, force: L) -> L {
        let (block, laws) = (&*self.block, &self.laws);
        let gaps = &block.gaps[batch];
        let (mut frees, mut forces) = (Batch::default(), Batch::default());
        let own = L::load(&gaps.compliance, at) * L::load(&block.forces[batch][0], at);
        let free = L::load(&gaps.free, at) + (L::splat(0.5 * laws.time_steps[1]) * rate - own);
        free.store(&mut frees, at);
        force.store(&mut forces, at);
        for lane in (at..at + L::WIDTH).filter(|lane| known >> (lane - at) & 1 == 0) {
            let spring = block.lanes[batch][lane];
            forces.0[lane] = 0.0;
            if spring == NONE {
                continue;
            }
            let number = block.number(spring);
            let terms = laws.terms(number);
            let patch = &Patch { gap: gaps.now.0[lane], ..laws.list[number as usize].patch() };
            let closing = Closing { spring: patch, old: gaps.old.0[lane], free: frees.0[lane], compliance: gaps.compliance.0[lane] };
            forces.0[lane] = terms.normal_force(&closing, block.old[batch][0].0[lane], laws.time_steps);
        }
        L::load(&forces, at)
    }

    /// Finds the friction of the springs in the lanes: all springs add `rates` to theirs, and their own
    /// normal forces have changed by `step` since.
    #[inline(never)]
    fn slide<L: Lane>(&mut self, batch: usize, at: usize, rates: [L; D], step: L, still: Option<&Batch>) {
        let mut known = [Batch::default(); D];
        rates.into_iter().zip(&mut known).for_each(|(rate, known)| rate.store(known, at));
        step.store(&mut known[0], at);
        for lane in at..at + L::WIDTH {
            let spring = self.block.lanes[batch][lane];
            if spring != NONE && still.is_none_or(|still| still.0[lane] == 0.0) {
                self.slide_one(batch, lane, spring, known.map(|batch| batch.0[lane]));
            }
        }
    }

    /// The same of one; `known` are the step of its normal force and the rates that all add to its slips'.
    fn slide_one(&mut self, batch: usize, lane: usize, spring: u32, known: [f64; D]) {
        let (block, laws) = (&mut *self.block, &self.laws);
        let number = block.number(spring);
        let (data, terms) = (&laws.list[number as usize], laws.terms(number));
        let (forces, own) = (&mut block.forces[batch], &block.own[batch]);
        let own = |on: usize, by: usize| own[on][by].0[lane];
        let others = |a: usize| {
            let mine = (1..D).fold(0.0, |sum, by| sum + own(a + 1, by) * forces[by].0[lane]);
            known[a + 1] - mine + own(a + 1, 0) * known[0]
        };
        let [slip_rate_old, slip_rate_free] =
            [&block.old, &block.free].map(|rates| Dim::<D>::tangent_vector(|a| rates[batch][a + 1].0[lane]));
        let stick = || FrictionInput {
            old: slip_rate_old,
            free: Dim::<D>::tangent_vector(|a| slip_rate_free[a] + others(a)),
            compliance: Dim::<D>::tangent_vector(|a| Dim::<D>::tangent_vector(|b| own(a + 1, b + 1))),
            stiffness: terms.law.slip_stiffness(&data.patch()),
            time_steps: laws.time_steps,
        };
        let force = forces[0].0[lane];
        let friction = match terms.tangential {
            Tangential::Free => return,
            Tangential::Friction(friction) => {
                // What is open has slid nowhere, whatever an earlier sweep gave it.
                let is_open = (0..D).all(|axis| forces[axis].0[lane] == 0.0);
                let limit = || friction.limit(force, data.area, Dim::<D>::size(&slip_rate_old));
                let slid = if is_open { FrictionResult::default() } else { Dim::<D>::slide(&stick(), laws.slip(number).slip, limit()) };
                block.slid[spring as usize] = (slid.slip, slid.slides);
                slid.friction
            }
            Tangential::Tied => Dim::<D>::tie(&stick(), laws.slip(number).slip),
        };
        (1..D).for_each(|axis| forces[axis].0[lane] = friction[axis - 1]);
    }
}

/// Normals of the springs of a batch in lanes from `at` on, where these are all that rows have beside shares.
#[inline(always)]
pub(super) fn normal<L: Lane, const PLAIN: bool, const D: usize>(block: &Block<D>, batch: usize, at: usize) -> [L; D]
where
    Dim<D>: TangentSpace<D>,
{
    let mut normal = [L::splat(0.0); D];
    if PLAIN {
        for d in 0..D {
            normal[d] = L::load(&block.normals[batch][d], at);
        }
    }
    normal
}

/// Row of the gap's rate of an arm in lanes from `at` on; `normal` is that of its springs.
#[inline(always)]
pub(super) fn gap_row<L: Lane, const PLAIN: bool, const D: usize>(block: &Block<D>, arm: usize, at: usize, normal: &[L; D]) -> [L; D]
where
    Dim<D>: TangentSpace<D>,
{
    let mut row = *normal;
    if PLAIN {
        let share = L::load(&block.shares[arm], at);
        for d in 0..D {
            row[d] = share * row[d];
        }
        return row;
    }
    for d in 0..D {
        row[d] = L::load(&block.rows[arm][d], at);
    }
    row
}

/// What all springs add to the rates of those of a batch in lanes from `at` on.
#[inline(always)]
fn rates<L: Lane, const SLIDES: bool, const PLAIN: bool, const D: usize>(block: &Block<D>, batch: usize, at: usize) -> [L; D]
where
    Dim<D>: TangentSpace<D>,
{
    let (normal, mut rates) = (normal::<L, PLAIN, D>(block, batch, at), [[L::splat(0.0); D]; D]);
    for arm in block.arms(batch) {
        let room = L::gather_rooms(&block.rooms, &block.places, arm, at);
        add_rates::<L, SLIDES, PLAIN, D>(block, arm, at, (&room, &normal), &mut rates);
    }
    sums(&rates)
}

/// Sums over the axes.
#[inline(always)]
fn sums<L: Lane, const D: usize>(of: &[[L; D]; D]) -> [L; D] {
    let mut sums = [L::splat(0.0); D];
    for axis in 0..D {
        sums[axis] = of[axis][0];
        for d in 1..D {
            sums[axis] += of[axis][d];
        }
    }
    sums
}

/// The same of an arm whose rooms are known, axis by axis, so that no sum waits for another.
#[inline(always)]
fn add_rates<L: Lane, const SLIDES: bool, const PLAIN: bool, const D: usize>(
    block: &Block<D>,
    arm: usize,
    at: usize,
    (room, normal): (&[L; 4], &[L; D]),
    rates: &mut [[L; D]; D],
) where
    Dim<D>: TangentSpace<D>,
{
    let row = gap_row::<L, PLAIN, D>(block, arm, at, normal);
    for d in 0..D {
        rates[0][d] += row[d] * room[d];
        if SLIDES {
            for axis in 1..D {
                rates[axis][d] += L::load(&block.slips[(D - 1) * arm + axis - 1][d], at) * room[d];
            }
        }
    }
}

/// Adds what rigid bodies have, which stay as they are in a sweep.
#[inline(always)]
fn add_lent<L: Lane, const SLIDES: bool, const D: usize>(block: &Block<D>, batch: usize, at: usize, rates: &mut [L; D])
where
    Dim<D>: TangentSpace<D>,
{
    if !block.lent.is_empty() {
        for axis in 0..if SLIDES { D } else { 1 } {
            rates[axis] += L::load(&block.lent[batch][axis], at);
        }
    }
}

/// Sees a step of a force.
#[inline(always)]
fn see<L: Lane>(seen: &mut [L; 2], step: L, force: L) {
    seen[0] = step.abs().max(seen[0]);
    seen[1] = force.abs().max(seen[1]);
}

/// Reports what was found, with the rates that the forces lead to.
pub(super) struct Settle<'a, const SLIDES: bool, const PLAIN: bool, const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    pub(super) block: &'a Block<D>,
    pub(super) laws: Laws<'a, D>,
    /// Of each spring of the block.
    pub(super) results: Results<'a, D>,
}

impl<const SLIDES: bool, const PLAIN: bool, const D: usize> Kernel for Settle<'_, SLIDES, PLAIN, D>
where
    Dim<D>: TangentSpace<D>,
{
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        let Self { block, laws, mut results } = self;
        for batch in 0..block.heads.len() {
            let mut new = [Batch::default(); D];
            for at in (0..BATCH).step_by(L::WIDTH) {
                let mut rates = rates::<L, SLIDES, PLAIN, D>(block, batch, at);
                add_lent::<L, SLIDES, D>(block, batch, at, &mut rates);
                for (axis, rate) in rates.into_iter().enumerate().take(if SLIDES { D } else { 1 }) {
                    (L::load(&block.free[batch][axis], at) + rate).store(&mut new[axis], at);
                }
            }
            for (lane, &spring) in block.lanes[batch].iter().enumerate().filter(|(_, spring)| **spring != NONE) {
                let along = |of: &[Batch]| Dim::<D>::tangent_vector(|a| of[a + 1].0[lane]);
                let (forces, old, force) = (&block.forces[batch], &block.old[batch], block.forces[batch][0].0[lane]);
                let solved = Solved { gap: block.gaps[batch].now.0[lane], force, rates: [old[0].0[lane], new[0].0[lane]] };
                results.set(spring as usize, solved, || {
                    let mut slid = Slid { slides: force != 0.0, ..Slid::default() };
                    if SLIDES {
                        (slid.friction, slid.rates) = (along(forces), [along(old), along(&new)]);
                        if !matches!(laws.terms(block.number(spring)).tangential, Tangential::Free) {
                            (slid.slip_new, slid.slides) = block.slid_at(batch, lane);
                        }
                    }
                    slid
                });
            }
        }
    }
}
