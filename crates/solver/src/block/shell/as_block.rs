//! Shells and beams as blocks: what the solver asks of them.

use super::{CHUNK, ShellKernel, Shells};
use crate::archive::{Archive, ArchiveResult, Persist};
use crate::block::initial::{Initial, Wrong};
use crate::block::{Block, ElementState, Motion, NodalForces, Report, damping};
use crate::failure::{Criterion, Seen};
use crate::material::Variable;
use crate::material::points::{PointLaw, RESPONSE};
use crate::tensor::{Dim, Space};
use embate_lanes::{BATCH, Batch, Level, Team};

/// A point of a batch of elements as criteria see it.
struct Look<'a, K, const D: usize> {
    shells: &'a Shells<K, D>,
    batch: usize,
    point: usize,
}

impl<K, const D: usize> Seen for Look<'_, K, D>
where
    K: ShellKernel<D>,
    Dim<D>: Space<D>,
{
    fn stress(&self) -> [Batch; 6] {
        let mut stress = [Batch::default(); 6];
        for lane in 0..BATCH {
            let own = self.shells.stress_of(self.batch * BATCH + lane, self.point);
            stress.iter_mut().zip(own).for_each(|(batch, value)| batch.0[lane] = value);
        }
        stress
    }
    fn variable(&self, variable: &Variable) -> Batch {
        self.shells.laws.place(self.point, variable).map_or(Batch::default(), |place| self.shells.history_of(self.batch)[place])
    }
    fn time_step_squared(&self) -> Batch {
        self.shells.elements[self.batch].time_step_squared
    }
}

impl<K, const D: usize> Block<D> for Shells<K, D>
where
    K: ShellKernel<D>,
    Dim<D>: Space<D>,
{
    fn elements(&self) -> usize {
        self.count
    }

    fn slots(&self) -> &[u32] {
        self.local.nodes()
    }

    fn moment_slots(&self) -> &[u32] {
        self.local.nodes()
    }

    fn rotating_nodes(&self) -> Vec<(u32, f64)> {
        let share = |k: usize| {
            let element = k / K::NODES;
            (self.local.node(k, K::NODES), self.corner_mass[k] * self.elements[element / BATCH].inertia.0[element % BATCH])
        };
        (0..self.corner_mass.len()).map(share).collect()
    }

    fn advance(&mut self, motion: &Motion<'_, D>, level: Level, pulls: NodalForces<'_, D>, team: &mut Team) -> Report {
        self.local.find(motion.rotations);
        self.advance_all(motion, level, pulls, team);
        self.joined()
    }

    fn keep_forces(&mut self) {
        self.keeps_forces = true;
        self.kept = vec![Batch::default(); self.elements.len() * K::NODES * (D + 3)];
    }

    fn force(&self, element: usize, corner: usize, _: &[[f64; D]]) -> [f64; D] {
        let first = (element / BATCH * K::NODES + corner) * (D + 3);
        std::array::from_fn(|d| if self.keeps_forces { self.kept[first + d].0[element % BATCH] } else { 0.0 })
    }

    fn moment(&self, element: usize, corner: usize) -> [f64; 3] {
        let first = (element / BATCH * K::NODES + corner) * (D + 3) + D;
        std::array::from_fn(|d| if self.keeps_forces { self.kept[first + d].0[element % BATCH] } else { 0.0 })
    }

    fn mass(&self, element: usize) -> f64 {
        self.corner_mass[element * K::NODES..][..K::NODES].iter().sum()
    }

    fn corner_mass(&self, element: usize, corner: usize) -> f64 {
        self.corner_mass[element * K::NODES + corner]
    }

    fn time_step_squared(&self, element: usize) -> f64 {
        self.elements[element / BATCH].time_step_squared.0[element % BATCH]
    }

    fn bound_stiffness(&self, shortest: f64, add: &mut dyn FnMut(u32, f64, f64)) {
        for element in (0..self.count).filter(|&element| self.is_alive(element)) {
            let mass = self.elements[element / BATCH].mass_least.0[element % BATCH] / K::NODES as f64;
            let stiffness = damping::bounding_stiffness(mass, self.time_step_squared(element), shortest, self.damping > 0.0);
            (element * K::NODES..(element + 1) * K::NODES).for_each(|corner| add(self.local.node(corner, K::NODES), stiffness, mass));
        }
    }

    fn mark_time_steps(&mut self) {
        self.marks = self.elements.iter().map(|own| own.time_step_squared).collect();
    }

    fn state(&self, element: usize) -> ElementState {
        let (batch, lane) = (element / BATCH, element % BATCH);
        let state = &self.state[batch * K::STATE..][..K::STATE];
        let stresses = (0..self.points()).map(|point| (point / self.facts.section.count(), self.stress_of(element, point)));
        let worst = stresses.max_by(|(_, a), (_, b)| crate::tensor::von_mises(a).total_cmp(&crate::tensor::von_mises(b)));
        let (plane, worst) = worst.unwrap_or_default();
        let mut shown = ElementState { stress: K::turned(state, worst, plane, lane), ..ElementState::default() };
        let history = self.history_of(batch);
        for (value, variable) in shown.variables.iter_mut().zip(self.laws.variables()) {
            let of = |point: usize| self.laws.place(point, variable).map(|place| history[place].0[lane]);
            *value = (0..self.points()).filter_map(of).fold(f64::NEG_INFINITY, f64::max);
        }
        shown.through = self.through(element);
        let own = &self.elements[batch];
        shown.thinning = 1.0 - own.thickness.0[lane] / own.thickness_initial.0[lane];
        shown.energy_density = (own.stored.0[lane] + own.besides[0].0[lane]) / self.volume[element];
        let response = vec![Batch::default(); self.points() * RESPONSE];
        shown.shell = K::resultants(&self.facts, state, &self.layers(batch, &response), lane);
        shown
    }

    fn law(&self) -> Option<&dyn PointLaw> {
        Some(self.laws.first())
    }

    fn wave_modulus(&self) -> f64 {
        self.laws.largest(|law| [law.stiffness()[0] + 4.0 / 3.0 * law.stiffness()[1]])[0]
    }

    fn bulk_modulus(&self) -> f64 {
        self.laws.stiffness()[0]
    }

    fn index_of(&self, variable: &Variable) -> Option<usize> {
        self.laws.variables().iter().position(|own| *own == variable)
    }

    fn scale_mass(&mut self, element: usize, factor: f64) {
        self.corner_mass[element * K::NODES..][..K::NODES].iter_mut().for_each(|mass| *mass *= factor);
        self.elements[element / BATCH].mass_least.0[element % BATCH] *= factor;
    }

    fn begin(&mut self, initial: &Initial<'_>, _positions: &[[f64; D]]) -> Result<(), Wrong> {
        if let Some(temperature) = initial.temperature {
            self.laws.warm(&mut self.history, temperature)?;
        }
        Ok(())
    }

    fn is_alive(&self, element: usize) -> bool {
        self.elements[element / BATCH].live.0[element % BATCH] > 0.0
    }

    fn failed(&self, criteria: &[Criterion], _parallel: bool) -> Vec<(u32, u32)> {
        let mut failed = Vec::new();
        for batch in 0..self.elements.len() {
            let first = if self.facts.is_layered { self.failing_layers(batch, criteria) } else { self.failing(batch, criteria) };
            let elements = (batch * BATCH..).zip(first).filter(|&(element, _)| element < self.count && self.is_alive(element));
            failed.extend(elements.filter_map(|(element, first)| Some((element as u32, first?))));
        }
        failed
    }

    fn determinant(&self, element: usize, _positions: &[[f64; D]]) -> f64 {
        self.elements[element / BATCH].determinant.0[element % BATCH]
    }

    fn erode(&mut self, elements: &[u32], mut pulls: NodalForces<'_, D>) -> Vec<f64> {
        let take = |&element: &u32| {
            let element = element as usize;
            let own = &mut self.elements[element / BATCH];
            own.live.0[element % BATCH] = 0.0;
            own.stored.0[element % BATCH] + own.besides[0].0[element % BATCH]
        };
        let stored = elements.iter().map(take).collect();
        let chunk_of = |element: &u32| *element as usize / (CHUNK * BATCH);
        for of_chunk in elements.chunk_by(|a, b| chunk_of(a) == chunk_of(b)) {
            self.sum_again(chunk_of(&of_chunk[0]), &mut pulls);
        }
        self.sum_reports();
        stored
    }

    fn report(&self, _positions: &[[f64; D]]) -> Report {
        self.joined()
    }

    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let mut nothing = Vec::new();
        let damped = if self.damping > 0.0 { &mut self.damped } else { &mut nothing };
        for list in [&mut self.state, &mut self.stress, &mut self.history, damped, &mut self.marks] {
            list.persist(archive)?;
        }
        self.elements[..].persist(archive)?;
        if archive.reads() {
            self.sum_reports();
        }
        Ok(())
    }
}

impl<K, const D: usize> Shells<K, D>
where
    K: ShellKernel<D>,
    Dim<D>: Space<D>,
{
    /// Points that have to fail until an element fails.
    fn needed(&self) -> f64 {
        self.failed_share * self.points() as f64 - 1e-9
    }

    /// The first criterion by which enough points of each element of a batch fail.
    fn failing(&self, batch: usize, criteria: &[Criterion]) -> [Option<u32>; BATCH] {
        let mut first = [None; BATCH];
        for (number, criterion) in (0..).zip(criteria) {
            let mut counts = [0.0; BATCH];
            for point in 0..self.points() {
                let fails = (criterion.kind.fails)(&Look { shells: self, batch, point }, criterion.limit);
                counts.iter_mut().zip(fails).for_each(|(count, fails)| *count += f64::from(u8::from(fails)));
            }
            for (first, count) in first.iter_mut().zip(counts) {
                *first = first.or((count > 0.0 && count >= self.needed()).then_some(number));
            }
        }
        first
    }

    /// The same of layers with criteria of their own: a point fails by any of these. A step is that of all.
    fn failing_layers(&self, batch: usize, criteria: &[Criterion]) -> [Option<u32>; BATCH] {
        let (mut first, mut counts) = ([None; BATCH], [0.0; BATCH]);
        for point in 0..self.points() {
            let mut own = [None; BATCH];
            for (number, criterion) in (0u32..).zip(criteria) {
                if criterion.kind.limit.name != "time_step" && !self.laws.counts_at(number as usize, point) {
                    continue;
                }
                let fails = (criterion.kind.fails)(&Look { shells: self, batch, point }, criterion.limit);
                own.iter_mut().zip(fails).for_each(|(own, fails)| *own = own.or(fails.then_some(number)));
            }
            for ((first, count), own) in first.iter_mut().zip(&mut counts).zip(own) {
                *count += f64::from(u8::from(own.is_some()));
                *first = first.or(own);
            }
        }
        std::array::from_fn(|lane| first[lane].filter(|_| counts[lane] >= self.needed()))
    }
}
