//! A step of shells: strips of elements go through strain, law, damping and forces; chunks of strips are
//! shared by threads, and their reports joined in order.

use super::laws::Laws;
use super::{BATCH, Batch, CHUNK, Corners, Facts, Layers, Pulls, Room, ShellBatch, ShellKernel, Shells, Strains};
use crate::block::strip::{ForEachBatch, Parts, STRIP};
use crate::block::{Motion, NodalForces, Report, damping};
use crate::material::Family;
use crate::material::points::{Points, RESPONSE};
use crate::tensor::{Dim, Space};
use embate_lanes::{Chunks, Lane, Level, Team};
use std::marker::PhantomData;
use std::sync::{Mutex, PoisonError};

/// The strain of a strip.
struct Strain<'a, K, const D: usize> {
    facts: &'a Facts,
    points: usize,
    /// β over the step; 0: none.
    damping: f64,
    corners: Corners<'a, D>,
    state: &'a mut [Batch],
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
            flow: &own.flow,
            live: &own.live,
        };
        let nodes = batch * K::NODES..(batch + 1) * K::NODES;
        let corners = Corners { positions: &self.corners.positions[nodes.clone()], rotations: &self.corners.rotations[nodes] };
        K::strain::<L>(self.facts, &corners, &mut self.state[batch * K::STATE..][..K::STATE], &mut strains, at);
    }
}

/// Energies, forces and steps of a strip after the law has answered.
struct Pull<'a, K, const D: usize> {
    facts: &'a Facts,
    points: usize,
    /// β and the step, s.
    damping: [f64; 2],
    state: &'a [Batch],
    stress: &'a mut [Batch],
    damped: &'a mut [Batch],
    history: &'a [Batch],
    response: &'a [Batch],
    strain: &'a [Batch],
    volume: &'a [Batch],
    elements: &'a mut [ShellBatch],
    forces: &'a mut [[[f64; D]; BATCH]],
    moments: &'a mut [[[f64; 3]; BATCH]],
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
            first: 0,
        };
        let state = &self.state[batch * K::STATE..][..K::STATE];
        let there = L::splat(0.5).less(L::load(&own.live, at));
        let nodes = batch * K::NODES..(batch + 1) * K::NODES;
        let mut pulls = Pulls { forces: &mut self.forces[nodes.clone()], moments: &mut self.moments[nodes], there };
        let answer = K::forces::<L>(self.facts, state, &layers, L::load(&own.inertia, at), &mut pulls, at);
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
    slots: &'a [u32],
    places: &'a [u32],
    rotation: &'a [Batch],
    heat: &'a [Batch],
    motion: &'a Motion<'a, D>,
    level: Level,
}

/// What one task advances.
struct Chunk<'a, const D: usize> {
    /// Its first batch.
    first: usize,
    state: &'a mut [Batch],
    elements: &'a mut [ShellBatch],
    stress: &'a mut [Batch],
    damped: &'a mut [Batch],
    history: &'a mut [Batch],
    forces: &'a mut [[f64; D]],
    moments: &'a mut [[f64; 3]],
}

impl<K: ShellKernel<D>, const D: usize> Shells<K, D>
where
    Dim<D>: Space<D>,
{
    pub(super) fn advance_all(&mut self, motion: &Motion<'_, D>, level: Level, pulls: NodalForces<'_, D>, team: &mut Team) {
        let (points, components, width) = (self.points(), self.facts.components, self.facts.width);
        let nodes = CHUNK * BATCH * K::NODES;
        while self.rooms.len() < team.threads() {
            self.rooms.push(Mutex::default());
        }
        let damped_size = if self.damping > 0.0 { CHUNK * points * components } else { 1 };
        let common = Common {
            laws: &self.laws,
            needs_rotation: !self.laws.all(|law| !law.needs_rotation()),
            facts: &self.facts,
            damping: self.damping,
            slots: &self.slots,
            places: &self.places,
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
            Chunks::new(pulls.forces, nodes),
            Chunks::new(pulls.moments, nodes),
            Chunks::new(&mut self.reports, 1),
        );
        team.each(lists, |index, member, (state, elements, stress, damped, history, forces, moments, report)| {
            let mut room = rooms[member].lock().unwrap_or_else(PoisonError::into_inner);
            let first = index * CHUNK;
            let mut chunk = Chunk { first, state, elements, stress, damped, history, forces, moments };
            Self::advance_chunk(&common, &mut chunk, &mut room);
            let marks = marks.get(first..(first + chunk.elements.len()).min(marks.len())).unwrap_or_default();
            report[0] = summed(chunk.elements, marks);
        });
    }

    fn advance_chunk(common: &Common<'_, D>, chunk: &mut Chunk<'_, D>, room: &mut Room<D>) {
        let Common { facts, motion, level, .. } = *common;
        let (points, components, width) = (facts.section.count() * K::PLANES, facts.components, facts.width);
        let count = chunk.elements.len();
        for from in (0..count).step_by(STRIP) {
            let to = (from + STRIP).min(count);
            let batches = to - from;
            room.fit::<K>(batches, points, components);
            let turns = if K::ROTATES && common.needs_rotation { common.rotation.len() / STRIP * batches } else { 0 };
            room.rotation.resize(turns, Batch::default());
            for batch in 0..batches {
                let nodes = batch * K::NODES..(batch + 1) * K::NODES;
                Self::gather(common, chunk.first + from + batch, &mut room.positions[nodes.clone()], &mut room.rotations[nodes]);
            }
            let stress = &mut chunk.stress[from * points * components..to * points * components];
            let history = &mut chunk.history[from * width..to * width];
            let state = &mut chunk.state[from * K::STATE..to * K::STATE];
            let elements = &mut chunk.elements[from..to];
            let Room { positions, rotations, strain, ratio, rotation, volume, response, forces, moments, law } = &mut *room;
            level.run(ForEachBatch(Strain::<K, D> {
                facts,
                points,
                damping: if motion.time_step > 0.0 { common.damping / motion.time_step } else { 0.0 },
                corners: Corners { positions, rotations },
                state: &mut *state,
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
                stress,
                damped,
                history,
                response,
                strain,
                volume,
                elements,
                forces: &mut *forces,
                moments: &mut *moments,
                kernel: PhantomData,
            }));
            let first = from * BATCH * K::NODES;
            scatter::<D>(forces, K::NODES, &mut chunk.forces[first..]);
            scatter::<3>(moments, K::NODES, &mut chunk.moments[first..]);
        }
    }

    /// The motion of the nodes of a batch; lanes beyond the last element repeat it.
    fn gather(common: &Common<'_, D>, batch: usize, positions: &mut [[[f64; D]; BATCH]], rotations: &mut [[[f64; 4]; BATCH]]) {
        let last = common.slots.len() / K::NODES - 1;
        let corners = positions.iter_mut().zip(rotations);
        for (corner, (positions, rotations)) in corners.enumerate() {
            for lane in 0..BATCH {
                let slot = (batch * BATCH + lane).min(last) * K::NODES + corner;
                positions[lane] = common.motion.positions[common.slots[slot] as usize];
                rotations[lane] = common.motion.rotations.numbers_at::<D>(common.places[slot] as usize);
            }
        }
    }

    /// Reports of all chunks from what elements have.
    pub(super) fn sum_reports(&mut self) {
        for (index, (report, elements)) in self.reports.iter_mut().zip(self.elements.chunks(CHUNK)).enumerate() {
            let marks = self.marks.get(index * CHUNK..(index * CHUNK + elements.len()).min(self.marks.len())).unwrap_or_default();
            *report = summed(elements, marks);
        }
    }
}

/// Vectors by corners and lanes to slots by elements and corners, as many as there are.
fn scatter<const D: usize>(from: &[[[f64; D]; BATCH]], corners: usize, slots: &mut [[f64; D]]) {
    for (batch, slots) in from.chunks_exact(corners).zip(slots.chunks_mut(BATCH * corners)) {
        for (lane, slots) in slots.chunks_exact_mut(corners).enumerate() {
            for (slot, corner) in slots.iter_mut().zip(batch) {
                *slot = corner[lane];
            }
        }
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

impl<const D: usize> Room<D> {
    /// Room for so many batches of elements.
    fn fit<K: ShellKernel<D>>(&mut self, batches: usize, points: usize, components: usize)
    where
        Dim<D>: Space<D>,
    {
        let (all, corners) = (batches * points, batches * K::NODES);
        for (list, length) in
            [(&mut self.strain, all * components), (&mut self.ratio, all), (&mut self.volume, all), (&mut self.response, all * RESPONSE)]
        {
            list.resize(length, Batch::default());
        }
        self.positions.resize(corners, [[0.0; D]; BATCH]);
        self.forces.resize(corners, [[0.0; D]; BATCH]);
        self.rotations.resize(corners, [[0.0; 4]; BATCH]);
        self.moments.resize(corners, [[0.0; 3]; BATCH]);
    }
}
