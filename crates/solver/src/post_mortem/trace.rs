//! What becomes of a failure location and its neighbourhood, step by step.
//!
//! A [`Tracer`] looks at the system after every step of a simulation that goes to a failure for the second
//! time, and changes nothing; what it saw is a [`Trace`].

use super::{FailureEntity, Near, Neighbourhood};
use crate::error::Error;
use crate::material::variable::{DAMAGE, PLASTIC_STRAIN, TEMPERATURE, Variable};
use crate::mesh::geometry::CellGeometry;
use crate::model::in_3d;
use crate::output::Outline;
use crate::record::Recorded;
use crate::simulation::Runs;
use crate::simulation::run::{AfterStep, Run};
use crate::step::System;
use crate::tensor::{Dim, von_mises};
use crate::vector::dot;
use std::any::Any;
use std::marker::PhantomData;

/// Figures of the failure location at one step; what it does not have is not a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vitals {
    /// Stable step of the element, s.
    pub time_step: f64,
    /// Its shape: smallest Jacobian determinant at a corner over the square of the longest side; 1 for a
    /// square, zero or less when it is inside out.
    pub shape: f64,
    /// Its area (of a bar: length) over that at the start.
    pub area_ratio: f64,
    /// Largest and smallest principal logarithmic strain at its centre, from the initial to the current
    /// nodes.
    pub strains: [f64; 2],
    /// Equivalent plastic strain.
    pub plastic_strain: f64,
    /// Temperature, K.
    pub temperature: f64,
    /// Damage.
    pub damage: f64,
    /// Equivalent stress, Pa.
    pub von_mises: f64,
    /// Pressure, Pa.
    pub pressure: f64,
    /// Elastic energy per initial volume, J/m³.
    pub energy_density: f64,
    /// Largest speed of its nodes (of a node: its own), m/s.
    pub speed: f64,
    /// Largest contact force on its nodes (of a node: its own), N/m.
    pub contact_force: f64,
    /// Depth of the contact, m.
    pub penetration: f64,
}

/// The neighbourhood after one step.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    /// Step number.
    pub step: u64,
    /// Time, s.
    pub time: f64,
    /// The step that led here, s.
    pub time_step: f64,
    /// Energy drift so far, fraction.
    pub drift: f64,
    /// The row of the history, by [`crate::simulation::Simulation::history_columns`]; empty where the step
    /// failed before its energy balance was closed.
    pub row: Vec<f64>,
    /// Of the failure location.
    pub vitals: Vitals,
    /// Places of [`Neighbourhood::nodes`], m.
    pub positions: Vec<[f64; 3]>,
    /// Contact forces on them, N/m.
    pub forces: Vec<[f64; 3]>,
    /// What each of [`Trace::contacts`] presses with on the failure location and the elements next to it,
    /// summed over their nodes, N/m.
    pub pressing: Vec<f64>,
    /// The field of each of [`Neighbourhood::cells`].
    pub values: Vec<f64>,
    /// Obstacles.
    pub outlines: Vec<Outline>,
}

/// The step in which the sum of all energies changed most, which it should not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jump {
    /// Step number.
    pub step: u64,
    /// Change, as a fraction of the largest total energy.
    pub size: f64,
    /// The node whose energy changed most then, with the contact that pressed on it.
    pub failure_entity: FailureEntity,
}

/// What was seen on the way to a failure.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trace {
    /// Names of the columns of [`Moment::row`].
    pub columns: Vec<String>,
    /// Contacts and obstacles: `contact` or `obstacle`, and their names.
    pub contacts: Vec<(&'static str, String)>,
    /// What is followed.
    pub near: Neighbourhood,
    /// The last steps, one after the other; the last one is that which failed.
    pub moments: Vec<Moment>,
    /// First step that was looked at, and the energy drift before it, fraction.
    pub begin: (u64, f64),
    /// The worst step for the balance of energies.
    pub jump: Option<Jump>,
}

/// Looks at a system after every step.
struct Tracer<const D: usize> {
    failure_entity: FailureEntity,
    near: Near,
    /// First step that is kept.
    from: u64,
    /// Mesh of the failure: what it has numbers of is not in those before elements were made again.
    revision: u32,
    /// Sum of all energies after the last step, J/m.
    total: f64,
    trace: Trace,
    of: PhantomData<Dim<D>>,
}

impl<const D: usize> Tracer<D>
where
    Dim<D>: Runs<D>,
{
    fn new(failure_entity: FailureEntity, near: Near, (from, revision): (u64, u32), columns: Vec<String>, system: &System<D>) -> Self {
        let contacts = system.contacts.iter().map(|contact| (contact.kind.name(), contact.name.clone())).collect();
        let trace = Trace { columns, contacts, near: near.shown.clone(), begin: (system.step, system.ledger.drift()), ..Trace::default() };
        Self { failure_entity, near, from, revision, total: balance(system), trace, of: PhantomData }
    }
}

impl<const D: usize> AfterStep<D> for Tracer<D>
where
    Dim<D>: Runs<D>,
{
    fn note(&mut self, system: &System<D>, recorded: &Recorded<D>, error: Option<&Error>) {
        let is_closed = error.is_none_or(Error::is_of_complete_step);
        if system.mesh.revision != self.revision {
            self.total = balance(system);
            return;
        }
        if is_closed {
            let total = balance(system);
            let size = (total - self.total).abs() / system.ledger.largest;
            if self.trace.jump.is_none_or(|jump| size > jump.size) {
                self.trace.jump = Some(Jump { step: system.step, size, failure_entity: system.hottest() });
            }
            self.total = total;
        }
        if system.step >= self.from {
            self.trace.moments.push(system.moment(&self.failure_entity, &self.near, recorded, is_closed));
        }
    }
}

/// What must stay constant, J/m.
fn balance<const D: usize>(system: &System<D>) -> f64
where
    Dim<D>: Runs<D>,
{
    system.ledger.stores.total() - system.ledger.external
}

impl<const D: usize> System<D>
where
    Dim<D>: Runs<D>,
{
    fn moment(&self, failure_entity: &FailureEntity, near: &Near, recorded: &Recorded<D>, is_closed: bool) -> Moment {
        let field = |&(g, element): &(usize, usize)| {
            let (block, state) = (&self.blocks[g], self.blocks[g].state(element));
            if near.is_plastic { block.variable(&state, &PLASTIC_STRAIN).unwrap_or(0.0) } else { von_mises(&state.stress) }
        };
        Moment {
            step: self.step,
            time: self.time,
            time_step: self.time_step_old,
            drift: self.ledger.drift(),
            row: if is_closed { recorded.samples(self) } else { Vec::new() },
            vitals: self.vitals(failure_entity),
            positions: near.nodes.iter().map(|&node| in_3d(self.positions[node as usize])).collect(),
            forces: near.nodes.iter().map(|&node| in_3d(self.contact_force(node as usize))).collect(),
            pressing: self.contacts.iter().map(|contact| contact.force_on(&near.next, &self.springs)).collect(),
            values: near.cells.iter().map(field).collect(),
            outlines: self.outlines.iter().map(|outline| outline.now(&self.bodies, self.time)).collect(),
        }
    }

    /// Zero where nothing touches.
    fn contact_force(&self, node: usize) -> [f64; D] {
        if self.contacts.is_empty() { [0.0; D] } else { self.contact_forces.of(node) }
    }

    fn vitals(&self, failure_entity: &FailureEntity) -> Vitals {
        let norm = |v: [f64; D]| dot(v, v).sqrt();
        let own: Vec<usize> = match (failure_entity.node, failure_entity.element) {
            (Some(node), _) => vec![node],
            (None, Some((g, element))) => self.mesh.groups[g].nodes_of(element).iter().map(|&node| node as usize).collect(),
            (None, None) => Vec::new(),
        };
        let most = |value: &dyn Fn(usize) -> f64| own.iter().map(|&node| value(node)).fold(f64::NAN, f64::max);
        let mut vitals = Vitals {
            time_step: f64::NAN,
            shape: f64::NAN,
            area_ratio: f64::NAN,
            strains: [f64::NAN; 2],
            plastic_strain: f64::NAN,
            temperature: f64::NAN,
            damage: f64::NAN,
            von_mises: f64::NAN,
            pressure: f64::NAN,
            energy_density: f64::NAN,
            speed: most(&|node| norm(self.velocities[node])),
            contact_force: if self.contacts.is_empty() { f64::NAN } else { most(&|node| norm(self.contact_force(node))) },
            penetration: failure_entity.contact.map_or(f64::NAN, |contact| self.contacts[contact].penetration),
        };
        if let Some((g, element)) = failure_entity.element {
            let (block, cell) = (&self.blocks[g], self.mesh.groups[g].cell(element));
            let state = block.state(element);
            let variable = |of: &Variable| block.variable(&state, of).unwrap_or(f64::NAN);
            vitals.time_step = block.time_step_squared(element).sqrt();
            vitals.shape = <Dim<D>>::shape_quality(cell, &self.positions);
            // Of elements that were made again, since then.
            let begun = self.mesh.references();
            vitals.area_ratio = <Dim<D>>::size(cell, &self.positions) / <Dim<D>>::size(cell, &begun);
            vitals.strains = <Dim<D>>::principal_strains(cell, &begun, &self.positions);
            vitals.plastic_strain = variable(&PLASTIC_STRAIN);
            vitals.temperature = variable(&TEMPERATURE);
            vitals.damage = variable(&DAMAGE);
            vitals.von_mises = von_mises(&state.stress);
            vitals.pressure = -(state.stress[0] + state.stress[1] + state.stress[2]) / 3.0;
            vitals.energy_density = state.energy_density;
        }
        vitals
    }
}

impl<const D: usize> Run<D>
where
    Dim<D>: Runs<D>,
{
    /// From now on looks at a suspect, with what `at_failure`, the simulation that failed, has around it,
    /// after every step from number `from` on.
    pub(crate) fn follow(&mut self, failure_entity: &FailureEntity, at_failure: &Self, from: u64) {
        let near = at_failure.system.near(failure_entity);
        let kept = (from, at_failure.system.mesh.revision);
        self.tracer = Some(Box::new(Tracer::new(*failure_entity, near, kept, self.history_columns(), &self.system)));
    }

    /// What was seen since [`crate::simulation::Simulation::follow`]; looks no more.
    pub(crate) fn take_trace(&mut self) -> Option<Trace> {
        let tracer: Box<dyn Any> = self.tracer.take()?;
        tracer.downcast::<Tracer<D>>().ok().map(|tracer| tracer.trace)
    }

    /// The state of a failure alone.
    pub(crate) fn trace_now(&self, failure_entity: &FailureEntity, error: Option<&Error>) -> Trace {
        let (near, kept) = (self.system.near(failure_entity), (0, self.system.mesh.revision));
        let mut tracer = Tracer::new(*failure_entity, near, kept, self.history_columns(), &self.system);
        tracer.note(&self.system, &self.recorded, error);
        Trace { jump: None, ..tracer.trace }
    }
}
