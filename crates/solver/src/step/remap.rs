//! What it costs to make elements again: energies that go with the transfer of a state to other elements.
//!
//! Between two steps the bodies get v′ for v^{n+½} and σ′ for σ^n. With the energies E of elements and f^n of
//! what they pull, H = ½ Σ m|v^{n+½}|² + E^n − ½ f^n·(x^{n+1} − x^n) is what the central difference method
//! keeps (kinetic energy at the whole step with elements that pull alone); it is entered as `remap` what H
//! becomes less, so the drift does not see the change. The identity of the works has the change of ½ Σ m|v|²
//! exactly. Springs of contacts live in half steps: what they stored at n + ½, less what those of the new
//! surfaces store there, is entered in the step that follows.

use super::System;
use super::flow::Flow;
use super::surface_springs::SurfaceSprings;
use crate::archive::{Archive, ArchiveError, ArchiveResult, Persist, persist_all, persist_each};
use crate::block::{Motion, NodalForces, PointValues, Report};
use crate::contact::Origins;
use crate::dimension::Dimension;
use crate::mesh::remeshed::{GONE, Renumbered};
use crate::model::{Model, in_3d};
use crate::reductions::{self, SumInOrder};
use crate::tensor::{Dim, cross};
use crate::vector::{dot, minus, plus, times};

/// What was lost so far, and each event.
#[derive(Debug, Default)]
pub(crate) struct Remap {
    /// Energy, J/m.
    pub(crate) energy: f64,
    pub(super) springs: SurfaceSprings,
    /// Each time that elements of a part were made again.
    pub(crate) events: Vec<Remeshing>,
    /// Of each entry of the model the step at which this was done or tried last, how often it was tried in
    /// vain since it was done last, and the stable step of the part when its elements were made, s.
    pub(crate) tried: Vec<u64>,
    pub(crate) failures: Vec<u64>,
    pub(crate) reference: Vec<f64>,
    /// Why it was in vain the last time.
    pub(crate) refused: Option<String>,
    /// Parts that material flows through, in the order of the model.
    pub(crate) flows: Vec<Flow>,
    /// Energy, kinetic and elastic, that left with material less what came in with it, J/m.
    pub(crate) flowed: f64,
}

impl Remap {
    /// Of a model, at its start.
    pub(crate) fn new(model: &Model) -> Self {
        Self { flows: model.flows.iter().map(|flow| Flow::new(&flow.part)).collect(), ..Self::default() }
    }
}

impl Persist for Remap {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { energy, springs, events, tried, failures, reference, refused, flows, flowed } = self;
        persist_each!(archive; energy, springs, events, tried, failures, reference, refused, flows, flowed);
        Ok(())
    }
}

/// The elements of a part were made again.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Remeshing {
    /// When, s, and after which step.
    pub time: f64,
    /// See `time`.
    pub step: u64,
    /// The part.
    pub part: String,
    /// Whether nodes were moved, instead of elements made again.
    pub relocated: bool,
    /// Why: `quality`, `time_step`, `size` or `interval`.
    pub reason: String,
    /// Elements before and after.
    pub elements: [usize; 2],
    /// Least scaled Jacobian before and after.
    pub quality: [f64; 2],
    /// Stable step before and after, s.
    pub time_step: [f64; 2],
    /// Kinetic energy that was lost, J/m (axisymmetric: J).
    pub kinetic_lost: f64,
    /// Elastic energy that was lost, J/m.
    pub elastic_lost: f64,
    /// Largest correction of a node's mass, as a fraction of it.
    pub mass_correction: f64,
    /// By what momentum (also about the centre of mass) changed, over Σ m|v| and Σ m|x − c||v|.
    pub momentum_change: [f64; 2],
    /// By what fraction the volume changed.
    pub volume_change: f64,
}

persist_all!(Remeshing {
    time,
    step,
    part,
    relocated,
    reason,
    elements,
    quality,
    time_step,
    kinetic_lost,
    elastic_lost,
    mass_correction,
    momentum_change,
    volume_change
});

/// The state of the part on its new elements.
pub(crate) struct NewState<'a, const D: usize> {
    /// The part.
    pub(crate) part: usize,
    /// How numbers have changed.
    pub(crate) numbers: &'a Renumbered,
    /// The old nodes, with their shares, that each new node lies between on the outline; none of those
    /// inside.
    pub(crate) between: &'a [Vec<(u32, f64)>],
    /// Velocities of its nodes, in the order of the new part, m/s.
    pub(crate) velocities: &'a [[f64; D]],
    /// What the points of each group of its elements hold.
    pub(crate) points: &'a [PointValues],
    /// Kinetic and elastic energy that material took with it which has left, less what came in, J/m.
    pub(crate) flowed: [f64; 2],
}

/// What one value knows is given to another one that was made of the same model.
pub(crate) fn hand_over<T: ?Sized>(
    from: &mut T,
    to: &mut T,
    [nodes, places]: [usize; 2],
    persist: impl Fn(&mut T, &mut Archive<'_>) -> ArchiveResult,
) -> ArchiveResult {
    const SECTION: &str = "handed over";
    let mut archive = Archive::new();
    archive.section(SECTION)?;
    persist(from, &mut archive)?;
    let sections = archive.finish()?;
    let mut archive = Archive::of(&sections);
    (archive.nodes, archive.places) = (nodes, places);
    archive.section(SECTION)?;
    persist(to, &mut archive)?;
    archive.finish().map(|_| ())
}

/// Steps after elements were made in which the time step may grow faster.
const FRESH: u64 = 100;

impl<const D: usize> System<D>
where
    Dim<D>: Dimension<D>,
{
    /// Whether elements were made again a short while ago: their stable step is longer at once.
    pub(super) fn has_fresh_elements(&self) -> bool {
        self.remap.as_ref().and_then(|remap| remap.events.last()).is_some_and(|event| self.step < event.step + FRESH)
    }

    /// Energy that the elements of a part store, J/m, and the work of their forces on the nodes that the
    /// first half of the coming step does: ½ f^n·(x^{n+1} − x^n).
    fn pulled(&self, part: usize) -> (f64, f64) {
        let reports = self.mesh.groups.iter().zip(&self.reports).filter(|(group, _)| group.part == part);
        let stored = reports.map(|(_, report)| report.stored).sum();
        let mut work = SumInOrder::default();
        for &node in &self.mesh.parts[part].nodes {
            work.add(dot(self.assembly.force(node as usize, &self.slots), self.velocities[node as usize]));
        }
        (stored, 0.5 * self.time_step * work.value())
    }

    /// Σ m v, and about the place `centre` Σ m (x − c) × v, of the nodes of a part; Σ m|v| and Σ m|x − c||v|.
    /// What supports of the part take is none that is kept, and of axisymmetric bodies what does not go along
    /// the axis: these components are zero.
    pub(crate) fn momentum_of(&self, part: usize, centre: [f64; D]) -> ([f64; 3], [f64; 3], [f64; 2]) {
        let (mut linear, mut angular, mut sizes) = ([0.0; 3], [0.0; 3], [0.0; 2]);
        for &node in &self.mesh.parts[part].nodes {
            let (mass, velocity) = (self.mass[node as usize], self.velocities[node as usize]);
            let arm = minus(self.positions[node as usize], centre);
            linear = plus(linear, times(mass, in_3d(velocity)));
            angular = plus(angular, times(mass, cross(in_3d(arm), in_3d(velocity))));
            let speed = dot(velocity, velocity).sqrt();
            sizes = [sizes[0] + mass * speed, sizes[1] + mass * dot(arm, arm).sqrt() * speed];
        }
        let [linear, angular] = self.kept(part, [linear, angular]);
        (linear, angular, sizes)
    }

    /// Of a momentum and an angular momentum of a part the components that are kept; the others are zero.
    pub(crate) fn kept(&self, part: usize, [linear, angular]: [[f64; 3]; 2]) -> [[f64; 3]; 2] {
        let is_free = self.free_directions(part);
        let kept = |value: f64, is_kept: bool| if is_kept { value } else { 0.0 };
        let linear = std::array::from_fn(|d| kept(linear[d], is_free[d]));
        let angular = std::array::from_fn(|d| kept(angular[d], is_free[(d + 1) % 3] && is_free[(d + 2) % 3]));
        [linear, angular]
    }

    /// Directions in which no node of a part is held; of axisymmetric bodies only that of the axis.
    fn free_directions(&self, part: usize) -> [bool; 3] {
        let mut is_free = std::array::from_fn(|d| d < D && !(self.of_revolution && d == 0));
        for constraint in self.mesh.parts[part].nodes.iter().filter_map(|&node| self.constraints.of(node as usize)) {
            (0..D).for_each(|d| is_free[d] &= constraint.leaves_free(d));
        }
        is_free
    }

    /// Continues where the system `old` is between two steps, with the elements of a part made again. This
    /// system is one at its start, on the new mesh. Returns the kinetic and the elastic energy that are lost,
    /// J/m.
    ///
    /// # Errors
    /// None that systems of one model can have.
    pub(crate) fn take_over(&mut self, mut old: Self, state: &NewState<'_, D>) -> Result<[f64; 2], ArchiveError> {
        let (kinetic_before, (stored_before, work_before)) = (old.kinetic_half(), old.pulled(state.part));
        let springs_before = reductions::sum(old.contacts.iter().map(|contact| contact.stored(&old.springs)));
        let update = 0.5 * (old.time_step + old.time_step_old);
        // Σ f·v of all forces on what has a mass, which nodes of obstacles have not: what a change of the
        // coming step changes of the first half.
        let change = |(node, mass): (usize, &f64)| mass * dot(minus(old.velocities[node], old.velocities_old[node]), old.velocities[node]);
        let power = if update > 0.0 {
            reductions::sum(old.mass.iter().take(old.mesh.positions.len()).enumerate().map(change)) / update
        } else {
            0.0
        };
        let before = old.time_step;
        self.take_course(&mut old)?;
        self.take_nodes(&old, state);
        self.take_blocks(&mut old, state)?;
        self.take_erosion(&mut old)?;
        self.take_contacts(&mut old, state);
        // What holds nodes leads the new ones.
        self.lead_held([self.time, self.time + self.time_step]);
        self.time_step = before.min(self.limits.safety * self.joined_reports().time_step_squared.sqrt()).min(self.limits.largest);
        for (next, (x, v)) in self.positions_old.iter_mut().zip(self.positions.iter().zip(&self.velocities)) {
            *next = plus(*x, times(self.time_step, *v));
        }
        let fastest = reductions::max(self.velocities.iter().map(|&v| dot(v, v)));
        self.speed = self.speed.max(fastest.sqrt());
        let kinetic = kinetic_before - self.kinetic_half();
        let (stored, work) = self.pulled(state.part);
        self.ledger.transfer(-kinetic);
        if let Some(remap) = &mut self.remap {
            let flowed = state.flowed[0] + state.flowed[1];
            remap.flowed += flowed;
            remap.energy += kinetic + (stored_before - stored) - (work_before - work) + 0.5 * (self.time_step - before) * power - flowed;
            if !self.contacts.is_empty() {
                remap.springs.open(springs_before);
            }
        }
        Ok([kinetic - state.flowed[0], stored_before - stored - state.flowed[1]])
    }

    /// Time, ledger, curves and rigid bodies.
    fn take_course(&mut self, old: &mut Self) -> ArchiveResult {
        (self.step, self.time, self.time_step_old, self.time_step) = (old.step, old.time, old.time_step_old, old.time_step);
        (self.governor, self.bound_by, self.limits) = (old.governor, old.bound_by, old.limits);
        (self.penetration_max, self.speed, self.travel) = (old.penetration_max, old.speed, old.travel);
        (self.ledger, self.mass_added) = (old.ledger, old.mass_added);
        self.initial_penetrations = std::mem::take(&mut old.initial_penetrations);
        self.remap = old.remap.take();
        let sizes = self.archive_sizes();
        hand_over(&mut old.curves, &mut self.curves, sizes, Persist::persist)?;
        hand_over(&mut old.bodies, &mut self.bodies, sizes, Persist::persist)
    }

    /// Positions and velocities.
    fn take_nodes(&mut self, old: &Self, state: &NewState<'_, D>) {
        let mut take = |from: usize, to: usize| {
            self.positions[to] = old.positions[from];
            self.velocities[to] = old.velocities[from];
            self.velocities_old[to] = old.velocities_old[from];
        };
        for (from, &to) in state.numbers.of_old.iter().enumerate().filter(|(_, to)| **to != GONE) {
            take(from, to as usize);
        }
        // Nodes of obstacles follow those of the mesh.
        let (first, first_old) = (self.mesh.positions.len(), old.mesh.positions.len());
        (0..old.positions.len() - first_old).for_each(|own| take(first_old + own, first + own));
        for (&node, &velocity) in state.numbers.of_new.iter().zip(state.velocities) {
            // Where it is, is where its elements begin.
            self.velocities[node as usize] = velocity;
            self.velocities_old[node as usize] = velocity;
        }
    }

    /// States of the elements: those of other parts as they are.
    fn take_blocks(&mut self, old: &mut Self, state: &NewState<'_, D>) -> ArchiveResult {
        let sizes = self.archive_sizes();
        let mut olds: Vec<usize> = (0..old.mesh.groups.len()).filter(|&group| old.mesh.groups[group].part != state.part).collect();
        olds.reverse();
        let own = |index: &usize| old.mesh.groups[*index].part == state.part;
        let mut before = Report::joined((0..old.mesh.groups.len()).filter(own).map(|index| old.reports[index]));
        // The sum of the works of all steps is not quite the energy of the stresses; the difference stays.
        before.stored -= (0..old.mesh.groups.len()).filter(own).map(|index| old.blocks[index].elastic_energy(&old.positions)).sum::<f64>();
        let (mut first, mut points) = (0, state.points.iter());
        for index in 0..self.blocks.len() {
            let slots = first..first + self.blocks[index].slots().len();
            first = slots.end;
            if self.mesh.groups[index].part == state.part {
                let points = points.next().ok_or_else(|| ArchiveError::new("a part has more kinds of elements than before"))?;
                // What is none of the points' goes to the first.
                let before = std::mem::replace(&mut before, Report::NOTHING);
                self.blocks[index].take_point_values(points, &before, &self.positions);
                let velocities = vec![[0.0; D]; self.velocities.len()];
                let motion = Motion::new(&self.positions, &velocities, 0.0);
                let pulls = NodalForces::new(&mut self.slots[slots]);
                self.reports[index] = self.blocks[index].advance(&motion, self.level, pulls, &mut self.team);
                continue;
            }
            let Some(from) = olds.pop() else { return Err(ArchiveError::new("there are other parts than before")) };
            hand_over(&mut *old.blocks[from], &mut *self.blocks[index], sizes, |block, archive| block.persist(archive))?;
            self.reports[index] = old.reports[from];
            let of_old = old.blocks[..from].iter().map(|block| block.slots().len()).sum::<usize>();
            let pulls = &old.slots[of_old..of_old + old.blocks[from].slots().len()];
            self.slots[slots].copy_from_slice(pulls);
        }
        Ok(())
    }

    /// What has failed in other parts.
    fn take_erosion(&mut self, old: &mut Self) -> ArchiveResult {
        let sizes = self.archive_sizes();
        self.remove_eroded_elements();
        match (&mut old.erosion, &mut self.erosion) {
            (Some(old), Some(own)) => hand_over(&mut **old, &mut **own, sizes, Persist::persist),
            _ => Ok(()),
        }
    }

    /// What contacts have done, and what they know of nodes.
    fn take_contacts(&mut self, old: &mut Self, state: &NewState<'_, D>) {
        let mut origins = vec![Vec::new(); self.positions.len()];
        for (from, &to) in state.numbers.of_old.iter().enumerate().filter(|(_, to)| **to != GONE) {
            origins[to as usize] = vec![(from as u32, 1.0)];
        }
        for (&node, between) in state.numbers.of_new.iter().zip(state.between) {
            origins[node as usize].clone_from(between);
        }
        let (first, first_old) = (self.mesh.positions.len(), old.mesh.positions.len());
        (first..self.positions.len()).for_each(|node| origins[node] = vec![((node - first + first_old) as u32, 1.0)]);
        let origins = &Origins { nodes: &origins, positions: &self.positions, before: &old.positions };
        for (contact, before) in self.contacts.iter_mut().zip(old.contacts.drain(..)) {
            contact.carry(before, origins);
        }
        self.traces.carry(&old.traces, origins);
        self.find_free_nodes();
    }
}
