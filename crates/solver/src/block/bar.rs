//! Bars between two nodes, in 2D and 3D: trusses and cables.
//!
//! A bar bears a force N = σ A along the line between its nodes; σ is the Cauchy stress of its law under
//! uniaxial stress, in axes that go with the bar, so a rotation is no strain, whatever its size. The strain
//! of a step is Δε = 2 (l − l_old)/(l + l_old): sums of it are ln(l/l₀) to second order in the steps, and a
//! bar that comes back to its length comes back to its strain. Hyperelastic laws get λ = l/l₀. The
//! cross-section follows the strain across. Work of a step: ½ (σ_old + σ_new) Δε times the volume half way.
//!
//! Half of the mass is at each node. Stable step: Δt² = m l / (A (E + |σ|)) with the current E = 9Kµ/(3K +
//! µ); |σ| stands for the stiffness of a taut bar across its line. Kinematics and forces are plain sums per
//! bar in fixed order, the law runs in lanes: the same bits everywhere.

use super::damping;
use super::initial::{self, Initial, Wrong};
use super::make::BlockInput;
use super::{Block, ElementState, Motion, NodalForces, Report};
use crate::archive::{Archive, ArchiveResult, Persist, persist_each};
use crate::failure::{Criterion, Seen, failing};
use crate::material::points::{self, PointLaw, Points, RESPONSE, Scratch};
use crate::material::{Family, Parameters, Variable, young_and_poisson};
use crate::tensor::{Dim, Plane, Space, SymmetricTensor, Turn};
use crate::vector::{dot, minus};
use embate_lanes::{BATCH, Batch, Level, Team};

/// Components of a tensor in 2D: xx is along the bar.
const PLANE: usize = 4;

/// One bar.
#[derive(Clone, Copy, Debug)]
struct Bar<const D: usize> {
    nodes: [u32; 2],
    /// Lengths at the start, in the step before, and now, m.
    initial: f64,
    length_old: f64,
    length: f64,
    /// Unit vector from the first node to the second.
    direction: [f64; D],
    /// Mass with what mass scaling added, kg/m.
    mass: f64,
    /// Energies, J/m.
    stored: f64,
    dissipated: f64,
    /// Stress of the damping, Pa, and what it has taken, J/m.
    damped: f64,
    damping: f64,
    time_step_squared: f64,
    /// The same when it was marked; 0: not yet.
    marked: f64,
    is_gone: bool,
}

impl<const D: usize> Persist for Bar<D> {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        #[rustfmt::skip]
        let Self {
            nodes: _, initial: _, mass: _,
            length_old, length, direction, stored, dissipated, damped, damping, time_step_squared, marked, is_gone,
        } = self;
        // There, or not, before anything is read.
        if *marked > 0.0 {
            marked.persist(archive)?;
        }
        persist_each!(archive; length_old, length, direction, stored, dissipated, damped, damping, time_step_squared, is_gone);
        Ok(())
    }
}

impl<const D: usize> Bar<D> {
    /// Strain increment of the step that led here, exact to second order in it.
    fn strain(&self) -> f64 {
        2.0 * (self.length - self.length_old) / (self.length + self.length_old)
    }
}

/// The bars of a part.
pub(super) struct Bars<const D: usize> {
    law: Box<dyn PointLaw>,
    /// Cross-section at the start, m² (per metre of depth, m).
    area: f64,
    /// Time β of the damping in proportion to the stiffness, s; 0: none.
    damping: f64,
    bars: Vec<Bar<D>>,
    /// Their nodes, two by two: the slots of the forces.
    slots: Vec<u32>,
    /// Cauchy stress in the axes of the bars, Pa.
    stress: Vec<Batch>,
    history: Vec<Batch>,
    /// Room for a step: strain (or b), volume ratio, no heat, response, and what the law needs.
    strain: Vec<Batch>,
    ratio: Vec<Batch>,
    heat: Vec<Batch>,
    /// No rotation, at every point.
    rotation: Vec<Batch>,
    response: Vec<Batch>,
    scratch: Scratch,
}

/// Length of a bar and its direction; none where the nodes coincide.
fn line<const D: usize>([a, b]: [[f64; D]; 2]) -> (f64, [f64; D]) {
    let d = minus(b, a);
    let length = dot(d, d).sqrt();
    (length, if length > 0.0 { d.map(|d| d / length) } else { [0.0; D] })
}

impl<const D: usize> Bars<D> {
    /// From what [`super::make`] was given; `None` when the law is unknown.
    pub(super) fn new(input: &BlockInput<'_, D>) -> Option<Self> {
        let law = points::uniaxial(input.material)?;
        let density = Parameters::new(&[], &input.material.parameters, &input.material.lists).value("density");
        let bar = |nodes: &[u32; 2]| {
            let (length, direction) = line(nodes.map(|node| input.positions[node as usize]));
            let volume = input.area * length;
            let stored = law.stored() * volume;
            Bar {
                nodes: *nodes,
                initial: length,
                length_old: length,
                length,
                direction,
                mass: density * volume,
                stored,
                dissipated: 0.0,
                damped: 0.0,
                damping: 0.0,
                time_step_squared: 0.0,
                marked: 0.0,
                is_gone: false,
            }
        };
        let bars: Vec<Bar<D>> = input.connectivity.as_chunks::<2>().0.iter().map(bar).collect();
        let batches = bars.len().div_ceil(BATCH);
        let scratch = |width: usize| vec![Batch::default(); batches * width];
        let mut history = scratch(law.state_width());
        history.chunks_exact_mut(law.state_width()).for_each(|point| law.start(point));
        let mut rotation = scratch(ROTATION);
        rotation.chunks_exact_mut(ROTATION).for_each(unturned);
        let (stress, strain, ratio, heat, response) = (scratch(PLANE), scratch(PLANE), scratch(1), scratch(1), scratch(RESPONSE));
        Some(Self {
            law,
            area: input.area,
            damping: input.damping,
            bars,
            slots: input.connectivity.to_vec(),
            stress,
            history,
            strain,
            ratio,
            heat,
            rotation,
            response,
            scratch: Scratch::default(),
        })
    }

    /// What the law wants to know of the step that led here, in the axes of the bars.
    fn strain(&mut self, positions: &[[f64; D]]) {
        // What is not there is not strained.
        let unstrained = if self.law.family() == Family::Rate { 0.0 } else { 1.0 };
        self.ratio.fill(Batch::splat(1.0));
        for point in self.strain.chunks_exact_mut(PLANE) {
            point.copy_from_slice(&[unstrained, unstrained, unstrained, 0.0].map(Batch::splat));
        }
        for (element, bar) in self.bars.iter_mut().enumerate().filter(|(_, bar)| !bar.is_gone) {
            let (length, direction) = line(bar.nodes.map(|node| positions[node as usize]));
            (bar.length_old, bar.length, bar.direction) = (bar.length, length, direction);
            let (batch, lane) = (element / BATCH, element % BATCH);
            let stretch = length / bar.initial;
            self.ratio[batch].0[lane] = stretch;
            self.strain[batch * PLANE].0[lane] = match self.law.family() {
                Family::Rate => bar.strain(),
                Family::Hyperelastic => stretch * stretch,
            };
        }
    }

    /// Cross-section over that at the start.
    fn section(&self, element: usize) -> f64 {
        let place = self.law.thickness().unwrap_or(0);
        self.history[element / BATCH * self.law.state_width() + place].0[element % BATCH]
    }

    fn stress_of(&self, element: usize) -> f64 {
        self.stress[element / BATCH * PLANE].0[element % BATCH]
    }

    fn sum(&self) -> Report {
        let of = |bar: &Bar<D>| {
            let gone = Report { dissipated: bar.dissipated, damping: bar.damping, ..Report::NOTHING };
            let step_change = if bar.marked > 0.0 { bar.time_step_squared / bar.marked } else { f64::INFINITY };
            let there =
                Report { time_step_squared: bar.time_step_squared, step_change, determinant: bar.length, stored: bar.stored, ..gone };
            if bar.is_gone { gone } else { there }
        };
        Report::joined(self.bars.iter().map(of))
    }
}

/// Batches of a rotation.
const ROTATION: usize = <<Plane<f64> as SymmetricTensor<f64>>::Rotation as Turn<f64>>::COMPONENTS;

fn unturned(point: &mut [Batch]) {
    (0..BATCH).for_each(|lane| <<Plane<f64> as SymmetricTensor<f64>>::Rotation as Turn<f64>>::none().store(point, lane));
}

/// A batch of bars as criteria see it.
struct Look<'a, const D: usize> {
    bars: &'a Bars<D>,
    batch: usize,
}

impl<const D: usize> Seen for Look<'_, D> {
    fn stress(&self) -> [Batch; 6] {
        std::array::from_fn(|c| if c < PLANE { self.bars.stress[self.batch * PLANE + c] } else { Batch::default() })
    }
    fn variable(&self, variable: &Variable) -> Batch {
        let place = self.bars.law.place(variable);
        place.map_or(Batch::default(), |index| self.bars.history[self.batch * self.bars.law.state_width() + index])
    }
    fn time_step_squared(&self) -> Batch {
        let of = |lane: usize| self.bars.bars.get(self.batch * BATCH + lane).map_or(f64::INFINITY, |bar| bar.time_step_squared);
        Batch(std::array::from_fn(of))
    }
}

impl<const D: usize> Block<D> for Bars<D>
where
    Dim<D>: Space<D>,
{
    fn elements(&self) -> usize {
        self.bars.len()
    }

    fn slots(&self) -> &[u32] {
        &self.slots
    }

    fn advance(
        &mut self,
        motion: &Motion<'_, D>,
        level: Level,
        NodalForces { forces: slots, .. }: NodalForces<'_, D>,
        _team: &mut Team,
    ) -> Report {
        self.strain(motion.positions);
        self.law.respond(
            level,
            Points {
                time_step: motion.time_step,
                strain: &self.strain,
                rotation: &self.rotation,
                volume_ratio: &self.ratio,
                viscous_heat: &self.heat,
                stress: &mut self.stress,
                state: &mut self.history,
                response: &mut self.response,
                scratch: &mut self.scratch,
            },
        );
        for element in 0..self.bars.len() {
            let (stress, area) = (self.stress_of(element), self.area * self.section(element));
            let bar = &mut self.bars[element];
            // Per volume, times the ratio of cross-sections already.
            let response: [f64; RESPONSE] = std::array::from_fn(|k| self.response[element / BATCH * RESPONSE + k].0[element % BATCH]);
            let [stored, dissipated, bulk, shear] = response;
            let [young, _] = young_and_poisson([bulk, shear]);
            let strain = bar.strain();
            let damped = if motion.time_step > 0.0 { self.damping * young * strain / motion.time_step } else { 0.0 };
            let force = if bar.is_gone { 0.0 } else { (stress + damped) * area };
            for (slot, sign) in slots[2 * element..2 * element + 2].iter_mut().zip([1.0, -1.0]) {
                *slot = bar.direction.map(|component| sign * force * component);
            }
            if bar.is_gone {
                continue;
            }
            let now = self.area * 0.5 * (bar.length + bar.length_old);
            let dissipated = dissipated * now;
            match self.law.family() {
                Family::Rate => bar.stored += 0.5 * stored * now - dissipated,
                Family::Hyperelastic => bar.stored = stored * (self.area * bar.initial),
            }
            bar.dissipated += dissipated;
            bar.damping += 0.5 * (bar.damped + damped) * strain * (area / self.area * now);
            bar.damped = damped;
            let squared = bar.mass * bar.length / (area * (young + stress.abs()));
            bar.time_step_squared = damping::step_squared(squared, self.damping);
        }
        self.sum()
    }

    fn mass(&self, element: usize) -> f64 {
        self.bars[element].mass
    }

    fn corner_mass(&self, element: usize, _corner: usize) -> f64 {
        0.5 * self.bars[element].mass
    }

    fn time_step_squared(&self, element: usize) -> f64 {
        self.bars[element].time_step_squared
    }

    fn bound_stiffness(&self, shortest: f64, add: &mut dyn FnMut(u32, f64, f64)) {
        for bar in self.bars.iter().filter(|bar| !bar.is_gone) {
            let (mass, squared) = (0.5 * bar.mass, bar.time_step_squared);
            let stiffness = damping::bounding_stiffness(mass, squared, shortest, self.damping > 0.0);
            bar.nodes.iter().for_each(|&node| add(node, stiffness, mass));
        }
    }

    fn mark_time_steps(&mut self) {
        // The step of a bar without length is no number.
        self.bars.iter_mut().for_each(|bar| bar.marked = bar.time_step_squared.max(f64::MIN_POSITIVE));
    }

    fn state(&self, element: usize) -> ElementState {
        let bar = &self.bars[element];
        let stress = self.stress_of(element);
        let along = |i: usize, j: usize| if j < D { bar.direction[i] * bar.direction[j] * stress } else { 0.0 };
        let stress = [along(0, 0), along(1, 1), along(2, 2), along(0, 1), along(1, 2), along(0, 2)];
        let mut state = ElementState { stress, ..ElementState::default() };
        let width = self.law.state_width();
        for (value, variable) in state.variables.iter_mut().zip(self.law.variables()) {
            *value = self.history[element / BATCH * width + variable.place].0[element % BATCH];
        }
        state.energy_density = bar.stored / (self.area * bar.initial);
        state
    }

    fn law(&self) -> Option<&dyn PointLaw> {
        Some(self.law.as_ref())
    }

    fn scale_mass(&mut self, element: usize, factor: f64) {
        self.bars[element].mass *= factor;
    }

    fn begin(&mut self, initial: &Initial<'_>, positions: &[[f64; D]]) -> Result<(), Wrong> {
        if let Some(temperature) = initial.temperature {
            initial::warm(self.law.as_ref(), &mut self.history, temperature)?;
        }
        let Some(stress) = initial.stress else { return Ok(()) };
        initial::keeps_stress(self.law.as_ref())?;
        for batch in 0..self.stress.len() / PLANE {
            let mut places = [[0.0; 2]; BATCH];
            for (lane, place) in places.iter_mut().enumerate() {
                let Some(bar) = self.bars.get_mut(batch * BATCH + lane) else { continue };
                let [a, b] = bar.nodes.map(|node| positions[node as usize]);
                *place = [0, 1].map(|d| 0.5 * (a[d] + b[d]));
                let along = stress.at(*place)[0];
                self.stress[batch * PLANE].0[lane] = along;
                bar.stored += self.law.energy([along, 0.0, 0.0, 0.0, 0.0, 0.0]) * (self.area * bar.initial);
            }
            let (own, width) = (&self.stress[batch * PLANE..][..PLANE], self.law.state_width());
            let history = &self.history[batch * width..][..width];
            if let Some((lane, stresses)) = initial::released(self.law.as_ref(), own, history, &self.rotation[..ROTATION]) {
                return Err(initial::cannot_hold(places[lane], stresses));
            }
        }
        Ok(())
    }

    fn is_alive(&self, element: usize) -> bool {
        !self.bars[element].is_gone
    }

    fn failed(&self, criteria: &[Criterion], _parallel: bool) -> Vec<(u32, u32)> {
        let mut failed = Vec::new();
        for batch in 0..self.stress.len() / PLANE {
            let seen = Look { bars: self, batch };
            let live = |lane: usize| self.bars.get(batch * BATCH + lane).is_some_and(|bar| !bar.is_gone);
            failed.extend(failing(criteria, &seen, live).map(|(lane, first)| ((batch * BATCH + lane) as u32, first)));
        }
        failed
    }

    fn determinant(&self, element: usize, positions: &[[f64; D]]) -> f64 {
        line(self.bars[element].nodes.map(|node| positions[node as usize])).0
    }

    fn force(&self, element: usize, corner: usize, slots: &[[f64; D]]) -> [f64; D] {
        slots[2 * element + corner]
    }

    fn erode(&mut self, elements: &[u32], NodalForces { forces: slots, .. }: NodalForces<'_, D>) -> Vec<f64> {
        let take = |&element: &u32| {
            slots[2 * element as usize..2 * element as usize + 2].fill([0.0; D]);
            let bar = &mut self.bars[element as usize];
            bar.is_gone = true;
            bar.stored
        };
        elements.iter().map(take).collect()
    }

    fn report(&self, _positions: &[[f64; D]]) -> Report {
        self.sum()
    }

    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self {
            law: _,
            area: _,
            damping: _,
            bars,
            slots: _,
            stress,
            history,
            strain: _,
            ratio: _,
            heat: _,
            rotation: _,
            response: _,
            scratch: _,
        } = self;
        bars[..].persist(archive)?;
        stress[..].persist(archive)?;
        history[..].persist(archive)
    }
}
