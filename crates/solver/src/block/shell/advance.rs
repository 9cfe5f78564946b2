//! A step of shells: strips of elements go through strain, law, damping and forces; chunks of strips are
//! shared by threads, and their reports joined in order.

use super::laws::Laws;
use super::local::LocalPoints;
use super::{BATCH, Batch, CHUNK, CORNERS, Corners, Facts, Layers, Pulls, Room, STRIP, ShellBatch, ShellKernel, Shells, Strains};
use crate::block::strip::{ForEachBatch, Parts};
use crate::block::{Motion, NodalForces, Report, damping};
use crate::material::Family;
use crate::material::points::{Points, RESPONSE};
use crate::tensor::{Dim, Space};
use embate_lanes::{Chunks, Indices, Lane, Level, Moving, Team, VectorSums};
use std::marker::PhantomData;
use std::sync::{Mutex, PoisonError};

/// The strain of a strip.
struct Strain<'a, K, const D: usize> {
    facts: &'a Facts,
    points: usize,
    /// β over the step; 0: none.
    damping: f64,
    points_now: &'a Moving<4>,
    places: &'a Indices,
    /// The first batch of the strip in the block.
    first: usize,
    state: &'a mut [Batch],
    passed: &'a mut [Batch],
    elements: &'a [ShellBatch],
    stress: &'a mut [Batch],
    rotation: &'a mut [Batch],
    strain: &'a mut [Batch],
    ratio: &'a mut [Batch],
    volume: &'a mut [Batch],
    kernel: PhantomData<K>,
}

impl<K: ShellKernel<D>, const D: usize> Parts for Strain<'_, K, D>
where
    Dim<D>: Space<D>,
{
    #[inline(always)]
    fn batches(&self) -> usize {
        self.elements.len()
    }

    #[inline(always)]
    fn part<L: Lane>(&mut self, batch: usize, at: usize) {
        let (own, points) = (&self.elements[batch], batch * self.points..(batch + 1) * self.points);
        let components = self.facts.components;
        let turn = self.rotation.len() / self.ratio.len();
        let mut strains = Strains {
            strain: &mut self.strain[points.start * components..points.end * components],
            ratio: &mut self.ratio[points.clone()],
            volume: &mut self.volume[points.clone()],
            stress: &mut self.stress[points.start * components..points.end * components],
            rotation: &mut self.rotation[points.start * turn..points.end * turn],
            thickness: [&own.thickness, &own.thickness_initial],
            damping: self.damping,
            live: &own.live,
        };
        let corners = Corners::<D> { points: self.points_now, places: self.places, row: (self.first + batch) * K::NODES };
        let state = &mut self.state[batch * K::STATE..][..K::STATE];
        K::strain::<L>(self.facts, &corners, state, &mut self.passed[batch * K::PASSED..][..K::PASSED], &mut strains, at);
    }
}

/// Energies, forces and steps of a strip after the law has answered.
struct Pull<'a, K, const D: usize> {
    facts: &'a Facts,
    points: usize,
    /// β and the step, s.
    damping: [f64; 2],
    state: &'a mut [Batch],
    passed: &'a [Batch],
    stress: &'a mut [Batch],
    damped: &'a mut [Batch],
    history: &'a [Batch],
    response: &'a [Batch],
    strain: &'a [Batch],
    volume: &'a [Batch],
    elements: &'a mut [ShellBatch],
    places: &'a Indices,
    /// The first batch of the strip in the block.
    first: usize,
    sums: &'a mut [VectorSums<3>; 2],
    /// Empty: forces are not kept.
    kept: &'a mut [Batch],
    kernel: PhantomData<K>,
}

impl<K: ShellKernel<D>, const D: usize> Pull<'_, K, D>
where
    Dim<D>: Space<D>,
{
    /// Energies of the layers of a batch.
    #[inline(always)]
    fn energies<L: Lane>(&mut self, batch: usize, at: usize) {
        let own = &mut self.elements[batch];
        let (zero, half) = (L::splat(0.0), L::splat(0.5));
        let (mut stored, mut dissipated) = (zero, zero);
        for p in batch * self.points..(batch + 1) * self.points {
            let volume = L::load(&self.volume[p], at);
            stored += L::load(&self.response[p * RESPONSE], at) * volume;
            dissipated += L::load(&self.response[p * RESPONSE + 1], at) * volume;
        }
        let stored = match self.facts.family {
            Family::Rate => L::load(&own.stored, at) + half * stored - dissipated,
            Family::Hyperelastic => stored,
        };
        // What is not there has no volume.
        let stored = L::select(half.less(L::load(&own.live, at)), stored, zero);
        stored.store(&mut own.stored, at);
        (L::load(&own.dissipated, at) + dissipated).store(&mut own.dissipated, at);
    }
}

impl<K: ShellKernel<D>, const D: usize> Parts for Pull<'_, K, D>
where
    Dim<D>: Space<D>,
{
    #[inline(always)]
    fn batches(&self) -> usize {
        self.elements.len()
    }

    #[inline(always)]
    fn part<L: Lane>(&mut self, batch: usize, at: usize) {
        self.energies::<L>(batch, at);
        let (components, width) = (self.facts.components, self.facts.width);
        let points = batch * self.points..(batch + 1) * self.points;
        if !self.damped.is_empty() {
            self.damp::<L>(batch, at);
        }
        let damped = if self.damped.is_empty() { &[][..] } else { &self.damped[points.start * components..points.end * components] };
        let own = &mut self.elements[batch];
        let layers = Layers {
            stress: &self.stress[points.start * components..points.end * components],
            history: &self.history[batch * width..(batch + 1) * width],
            response: &self.response[points.start * RESPONSE..points.end * RESPONSE],
            damped,
            thickness: &own.thickness_initial,
            flow: &own.flow,
            first: 0,
        };
        let state = &mut self.state[batch * K::STATE..][..K::STATE];
        let passed = &self.passed[batch * K::PASSED..][..K::PASSED];
        let (zero, there) = (L::splat(0.0), L::splat(0.5).less(L::load(&own.live, at)));
        let (mut forces, mut moments) = ([[zero; D]; CORNERS], [[zero; 3]; CORNERS]);
        let mut pulls = Pulls { forces: &mut forces, moments: &mut moments, there };
        let answer = K::forces::<L>(self.facts, state, passed, &layers, L::load(&own.inertia, at), &mut pulls, at);
        add(&forces, &moments, K::NODES, self.sums, self.places, [(self.first + batch) * K::NODES, at]);
        if !self.kept.is_empty() {
            keep(&forces, &moments, &mut self.kept[batch * K::NODES * (D + 3)..][..K::NODES * (D + 3)], at);
        }
        // dt = 2/ω.
        let squared = L::splat(4.0) * L::load(&own.mass_least, at) / answer.stiffness;
        let squared = damping::step_squared(squared, self.damping[0]);
        let infinite = L::splat(f64::INFINITY);
        L::select(there, squared, infinite).store(&mut own.time_step_squared, at);
        L::select(there, answer.determinant, infinite).store(&mut own.determinant, at);
        L::select(there, answer.hourglass, L::load(&own.hourglass, at)).store(&mut own.hourglass, at);
        let [stored, damped] = answer.besides;
        L::select(there, stored, L::splat(0.0)).store(&mut own.besides[0], at);
        L::select(there, damped, L::load(&own.besides[1], at)).store(&mut own.besides[1], at);
        for (kept, new) in own.flow.iter_mut().zip(answer.flow) {
            L::select(there, new, L::splat(0.0)).store(kept, at);
        }
        L::select(there, answer.thickness, L::load(&own.thickness, at)).store(&mut own.thickness, at);
    }
}

impl<K: ShellKernel<D>, const D: usize> Pull<'_, K, D>
where
    Dim<D>: Space<D>,
{
    /// Stress of the damping, β C:Δε/Δt, and its work (`block/damping.rs`).
    #[inline(always)]
    fn damp<L: Lane>(&mut self, batch: usize, at: usize) {
        let [beta, time_step] = self.damping;
        let factor = L::splat(if time_step > 0.0 { beta / time_step } else { 0.0 });
        let components = self.facts.components;
        let mut work = L::splat(0.0);
        let history = &self.history[batch * self.facts.width..][..self.facts.width];
        for (point, p) in (batch * self.points..(batch + 1) * self.points).enumerate() {
            let strain = &self.strain[p * components..][..components];
            let stiffness = [L::load(&self.response[p * RESPONSE + 2], at), L::load(&self.response[p * RESPONSE + 3], at)];
            let new = K::elastic::<L>(self.facts, strain, stiffness, at);
            let [_, stretch] = self.facts.stretches::<L>(history, point, at);
            let volume = L::load(&self.volume[p], at) * stretch;
            let kept = &mut self.damped[p * components..][..components];
            for (c, kept) in kept.iter_mut().enumerate() {
                let (old, new) = (L::load(kept, at), factor * new[c]);
                // Shear counts twice.
                let weight = L::splat(if c < 3 { 0.5 } else { 1.0 });
                work += weight * (old + new) * L::load(&strain[c], at) * volume;
                new.store(kept, at);
            }
        }
        let own = &mut self.elements[batch].damping;
        (L::load(own, at) + work).store(own, at);
    }
}

/// What is the same for all tasks.
struct Common<'a, const D: usize> {
    laws: &'a Laws,
    needs_rotation: bool,
    facts: &'a Facts,
    damping: f64,
    local: &'a LocalPoints,
    keeps_forces: bool,
    rotation: &'a [Batch],
    heat: &'a [Batch],
    motion: &'a Motion<'a, D>,
    level: Level,
}

/// What one task advances.
struct Chunk<'a, const D: usize> {
    index: usize,
    state: &'a mut [Batch],
    elements: &'a mut [ShellBatch],
    stress: &'a mut [Batch],
    damped: &'a mut [Batch],
    history: &'a mut [Batch],
    kept: &'a mut [Batch],
    forces: &'a mut [[f64; D]],
    moments: &'a mut [[f64; 3]],
}

impl<K: ShellKernel<D>, const D: usize> Shells<K, D>
where
    Dim<D>: Space<D>,
{
    pub(super) fn advance_all(&mut self, motion: &Motion<'_, D>, level: Level, pulls: NodalForces<'_, D>, team: &mut Team) {
        let (points, components, width) = (self.points(), self.facts.components, self.facts.width);
        let slots = self.local.width();
        let kept_size = if self.keeps_forces { CHUNK * K::NODES * (D + 3) } else { 1 };
        while self.rooms.len() < team.threads() {
            self.rooms.push(Mutex::default());
        }
        let damped_size = if self.damping > 0.0 { CHUNK * points * components } else { 1 };
        let common = Common {
            laws: &self.laws,
            needs_rotation: !self.laws.all(|law| !law.needs_rotation()),
            facts: &self.facts,
            damping: self.damping,
            local: &self.local,
            keeps_forces: self.keeps_forces,
            rotation: &self.rotation,
            heat: &self.heat,
            motion,
            level,
        };
        let (rooms, marks) = (&self.rooms, &self.marks);
        let lists = (
            Chunks::new(&mut self.state, CHUNK * K::STATE),
            Chunks::new(&mut self.elements, CHUNK),
            Chunks::new(&mut self.stress, CHUNK * points * components),
            Chunks::new(&mut self.damped, damped_size),
            Chunks::new(&mut self.history, CHUNK * width),
            Chunks::new(&mut self.kept, kept_size),
            Chunks::new(pulls.forces, slots),
            Chunks::new(pulls.moments, slots),
            Chunks::new(&mut self.reports, 1),
        );
        team.each(lists, |index, member, (state, elements, stress, damped, history, kept, forces, moments, report)| {
            let mut room = rooms[member].lock().unwrap_or_else(PoisonError::into_inner);
            let first = index * CHUNK;
            let mut chunk = Chunk { index, state, elements, stress, damped, history, kept, forces, moments };
            Self::advance_chunk(&common, &mut chunk, &mut room);
            let marks = marks.get(first..(first + chunk.elements.len()).min(marks.len())).unwrap_or_default();
            report[0] = summed(chunk.elements, marks);
        });
    }

    fn advance_chunk(common: &Common<'_, D>, chunk: &mut Chunk<'_, D>, room: &mut Room) {
        let Common { facts, motion, level, local, .. } = *common;
        let (points, components, width) = (facts.section.count() * K::PLANES, facts.components, facts.width);
        let (count, each) = (chunk.elements.len(), K::NODES * (D + 3));
        local.copy(chunk.index, motion, &mut room.points, level);
        room.sums.iter_mut().for_each(|sums| sums.clear(local.width()));
        for from in (0..count).step_by(STRIP) {
            let to = (from + STRIP).min(count);
            let (batches, first) = (to - from, chunk.index * CHUNK + from);
            room.fit::<K, D>(batches, points, components);
            let turns = if K::ROTATES && common.needs_rotation { common.rotation.len() / STRIP * batches } else { 0 };
            room.rotation.resize(turns, Batch::default());
            let stress = &mut chunk.stress[from * points * components..to * points * components];
            let history = &mut chunk.history[from * width..to * width];
            let state = &mut chunk.state[from * K::STATE..to * K::STATE];
            let elements = &mut chunk.elements[from..to];
            let Room { points: points_now, sums, passed, strain, ratio, rotation, volume, response, law } = &mut *room;
            level.run(ForEachBatch(Strain::<K, D> {
                facts,
                points,
                damping: if motion.time_step > 0.0 { common.damping / motion.time_step } else { 0.0 },
                points_now,
                places: &local.places,
                first,
                state: &mut *state,
                passed: &mut *passed,
                elements: &*elements,
                stress: &mut *stress,
                rotation: &mut *rotation,
                strain: &mut *strain,
                ratio: &mut *ratio,
                volume: &mut *volume,
                kernel: PhantomData,
            }));
            common.laws.respond(
                level,
                Points {
                    time_step: motion.time_step,
                    strain: &*strain,
                    rotation: if rotation.is_empty() { &common.rotation[..common.rotation.len() / STRIP * batches] } else { &*rotation },
                    volume_ratio: &*ratio,
                    viscous_heat: &common.heat[..batches * points],
                    stress: &mut *stress,
                    state: &mut *history,
                    response: &mut *response,
                    scratch: law,
                },
                batches,
            );
            let damped =
                if common.damping > 0.0 { &mut chunk.damped[from * points * components..to * points * components] } else { &mut [][..] };
            level.run(ForEachBatch(Pull::<K, D> {
                facts,
                points,
                damping: [common.damping, motion.time_step],
                state,
                passed,
                stress,
                damped,
                history,
                response,
                strain,
                volume,
                elements,
                places: &local.places,
                first,
                sums,
                kept: if common.keeps_forces { &mut chunk.kept[from * each..to * each] } else { &mut [][..] },
                kernel: PhantomData,
            }));
        }
        write(&room.sums, chunk.forces, chunk.moments);
    }

    /// Sums again what pulls on the nodes of a chunk, from what is kept of elements that are there.
    pub(super) fn sum_again(&self, index: usize, pulls: &mut NodalForces<'_, D>) {
        let (width, each) = (self.local.width(), K::NODES * (D + 3));
        let mut sums = [VectorSums::default(), VectorSums::default()];
        sums.iter_mut().for_each(|sums| sums.clear(width));
        for batch in index * CHUNK..((index + 1) * CHUNK).min(self.elements.len()) {
            let kept = &self.kept[batch * each..][..each];
            for lane in 0..BATCH {
                let (mut forces, mut moments) = ([[0.0; D]; CORNERS], [[0.0; 3]; CORNERS]);
                if self.elements[batch].live.0[lane] > 0.0 {
                    for (own, (force, moment)) in kept.chunks_exact(D + 3).zip(forces.iter_mut().zip(&mut moments)) {
                        let (first, rest) = own.split_at(D);
                        force.iter_mut().zip(first).for_each(|(value, batch)| *value = batch.0[lane]);
                        moment.iter_mut().zip(rest).for_each(|(value, batch)| *value = batch.0[lane]);
                    }
                }
                add::<f64, D>(&forces, &moments, K::NODES, &mut sums, &self.local.places, [batch * K::NODES, lane]);
            }
        }
        let slots = index * width..(index + 1) * width;
        write(&sums, &mut pulls.forces[slots.clone()], &mut pulls.moments[slots]);
    }

    /// Reports of all chunks from what elements have.
    pub(super) fn sum_reports(&mut self) {
        for (index, (report, elements)) in self.reports.iter_mut().zip(self.elements.chunks(CHUNK)).enumerate() {
            let marks = self.marks.get(index * CHUNK..(index * CHUNK + elements.len()).min(self.marks.len())).unwrap_or_default();
            *report = summed(elements, marks);
        }
    }
}

/// Adds forces and moments of the corners of a batch to the sums of their points.
#[inline(always)]
fn add<L: Lane, const D: usize>(
    forces: &[[L; D]; CORNERS],
    moments: &[[L; 3]; CORNERS],
    corners: usize,
    [of_forces, of_moments]: &mut [VectorSums<3>; 2],
    places: &Indices,
    [row, at]: [usize; 2],
) {
    let mut all = [[L::splat(0.0); 3]; CORNERS];
    for corner in 0..CORNERS {
        all[corner][2] = moments[corner][2];
        all[corner][..D].copy_from_slice(&forces[corner]);
    }
    scatter(&all, corners, of_forces, places, [row, at]);
    if D == 3 {
        scatter(moments, corners, of_moments, places, [row, at]);
    }
}

/// The first so many of some vectors to their sums.
#[inline(always)]
fn scatter<L: Lane>(vectors: &[[L; 3]; CORNERS], count: usize, sums: &mut VectorSums<3>, places: &Indices, [row, at]: [usize; 2]) {
    let [a, b, c, d] = *vectors;
    match count {
        2 => L::scatter(&[a, b], sums, places, row, at),
        3 => L::scatter(&[a, b, c], sums, places, row, at),
        _ => L::scatter(&[a, b, c, d], sums, places, row, at),
    }
}

/// Keeps forces and moments of the corners of a batch.
#[inline(always)]
fn keep<L: Lane, const D: usize>(forces: &[[L; D]; CORNERS], moments: &[[L; 3]; CORNERS], kept: &mut [Batch], at: usize) {
    for (corner, own) in kept.chunks_exact_mut(D + 3).enumerate() {
        for d in 0..D {
            forces[corner][d].store(&mut own[d], at);
        }
        for d in 0..3 {
            moments[corner][d].store(&mut own[D + d], at);
        }
    }
}

/// Sums of the points of a chunk to its slots.
fn write<const D: usize>([of_forces, of_moments]: &[VectorSums<3>; 2], forces: &mut [[f64; D]], moments: &mut [[f64; 3]]) {
    for ((sum, force), moment) in of_forces.rows().zip(forces).zip(&mut *moments) {
        force.copy_from_slice(&sum[..D]);
        *moment = [0.0, 0.0, sum[2]];
    }
    if D == 3 {
        of_moments.rows().zip(moments).for_each(|(sum, moment)| moment.copy_from_slice(sum));
    }
}

/// What elements report together.
fn summed(elements: &[ShellBatch], marks: &[Batch]) -> Report {
    let mut report = Report::NOTHING;
    for (batch, own) in elements.iter().enumerate() {
        for lane in 0..BATCH {
            report.dissipated += own.dissipated.0[lane];
            report.damping += own.damping.0[lane] + own.besides[1].0[lane];
            report.hourglass += own.hourglass.0[lane];
            if own.live.0[lane] == 0.0 {
                continue;
            }
            let squared = own.time_step_squared.0[lane];
            report.stored += own.stored.0[lane] + own.besides[0].0[lane];
            report.time_step_squared = report.time_step_squared.min(squared);
            report.determinant = report.determinant.min(own.determinant.0[lane]);
            if let Some(mark) = marks.get(batch) {
                report.step_change = report.step_change.min(squared / mark.0[lane]);
            }
        }
    }
    report
}

impl Room {
    /// Room for so many batches of elements.
    fn fit<K: ShellKernel<D>, const D: usize>(&mut self, batches: usize, points: usize, components: usize)
    where
        Dim<D>: Space<D>,
    {
        let all = batches * points;
        for (list, length) in [
            (&mut self.passed, batches * K::PASSED),
            (&mut self.strain, all * components),
            (&mut self.ratio, all),
            (&mut self.volume, all),
            (&mut self.response, all * RESPONSE),
        ] {
            list.resize(length, Batch::default());
        }
    }
}
