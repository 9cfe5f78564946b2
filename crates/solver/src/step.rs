//! The system (bodies, what acts on them, their state) and one step of the central difference method.
//!
//! The state between two steps is x^n, v^{n+1/2} and the step dt^n that leads to x^{n+1}; forces have been
//! evaluated at x^n. Everything that is shared by threads is cut in chunks that come from the mesh, and sums
//! are joined in chunk order: the same bits for any number of threads.

pub(crate) mod erosion;
pub(crate) mod flow;
pub(crate) mod free;
mod assembled_bound;
mod assembled_stiffness;
mod cavities;
mod limits;
pub(crate) mod mass_scaling;
mod nodal_bound;
mod nodes;
mod persist;
pub(crate) mod relaxation;
pub(crate) mod remap;
pub(crate) mod stages;
pub(crate) mod rotations;
pub(crate) mod subcycling;
mod surface_springs;

use crate::assembly::Assembly;
use crate::block::spring::together;
use crate::block::{Block, Motion, NodalForces, Report};
use crate::contact::obstacle::OutlineShape;
use crate::contact::springs::{Springs, Update};
use crate::contact::tied::leave_out_tied;
use crate::contact::traces::Traces;
use crate::contact::{Contact, Scene, Sweep, both};
use crate::contact_forces::ContactForces;
use crate::dimension::Dimension;
use crate::energy::{Entry, Ledger, Lost, Stores, Sums, Works};
use crate::error::Error;
use crate::load::body_force::BodyForces;
use crate::load::cavity::Cavities;
use crate::load::constraint::{Constraints, NodeConstraint};
use crate::load::curve::Curves;
use crate::load::damping::Damping;
use crate::load::force::Forces;
use crate::load::join::Joins;
use crate::load::non_reflecting::NonReflecting;
use crate::masses::PartMasses;
use crate::mesh::Mesh;
use crate::reductions;
use crate::rigid::{Acting, Bodies};
use crate::skins::Skins;
use crate::tensor::Dim;
use crate::vector::{dot, minus, plus, times};
pub(crate) use assembled_bound::AssembledBound;
use embate_lanes::{Chunks, Level, Team};
use erosion::Erosion;
use free::Groups;
pub use limits::{Governor, Limits, RUNAWAY};
use mass_scaling::MassScaling;
pub(crate) use nodal_bound::NodalBound;
use nodes::Nodes;
use relaxation::Relaxation;
use remap::Remap;
use rotations::NodalRotations;
use stages::Stages;
use subcycling::Subcycling;

/// Nodes that one task updates.
pub(crate) const CHUNK: usize = 1024;
/// Finds the springs of contacts and obstacles.
fn detect<const D: usize>(contacts: &mut [Contact<D>], springs: &mut Springs<D>, scene: &Scene<'_, D>)
where
    Dim<D>: Dimension<D>,
{
    springs.clear();
    contacts.iter_mut().for_each(|contact| contact.detect(scene, springs));
    leave_out_tied(contacts, springs);
}

/// Bodies, what acts on them, and their state.
pub struct System<const D: usize>
where
    Dim<D>: Dimension<D>,
{
    pub(crate) mesh: Mesh<D>,
    pub(crate) blocks: Vec<Box<dyn Block<D>>>,
    pub(crate) assembly: Assembly,
    pub(crate) mass: Vec<f64>,
    /// Contacts, then obstacles.
    pub(crate) contacts: Vec<Contact<D>>,
    pub(crate) bodies: Bodies<D>,
    /// Rigid parts: the part and its body.
    pub(crate) body_parts: Vec<(usize, usize)>,
    /// Whether each block is a rigid part: then it is not strained.
    pub(crate) rigid: Vec<bool>,
    /// Whether the last block is one of springs, beyond those of the mesh.
    pub(crate) has_springs: bool,
    /// What parts weigh.
    pub(crate) shares: PartMasses,
    /// Shapes of the obstacles, for pictures.
    pub(crate) outlines: Vec<OutlineShape<D>>,
    /// What contacts leave on the surfaces.
    pub(crate) traces: Traces<D>,
    pub(crate) constraints: Constraints<D>,
    pub(crate) curves: Curves,
    pub(crate) damping: Damping,
    /// Gravity and centrifugal forces.
    pub(crate) body_forces: BodyForces<D>,
    /// Forces and pressures on nodes.
    pub(crate) forces: Forces<D>,
    /// Gas in closed surfaces.
    pub(crate) cavities: Cavities<D>,
    /// Boundaries that reflect nothing.
    pub(crate) boundary: NonReflecting<D>,
    /// Nodes that move as one.
    pub(crate) joins: Joins<D>,
    pub(crate) limits: Limits,
    pub(crate) level: Level,
    /// Who shares the loops over elements and nodes.
    pub(crate) team: Team,
    /// Whether x is a radius.
    pub(crate) of_revolution: bool,

    pub(crate) step: u64,
    pub(crate) time: f64,
    /// Step that led to the current positions, s.
    pub(crate) time_step_old: f64,
    /// Step that will lead to the next positions, s.
    pub(crate) time_step: f64,
    pub(crate) governor: Governor,
    /// The same without growth and the end of the run.
    pub(crate) bound_by: Governor,
    /// The stable step by nodes, where the model wants it.
    pub(crate) nodal_bound: Option<NodalBound>,
    /// The stable step by the assembled mesh, where the model wants it.
    pub(crate) assembled_bound: Option<AssembledBound<D>>,
    /// Elements that are evaluated less often, where the model wants it.
    pub(crate) subcycling: Option<Subcycling>,
    pub(crate) positions: Vec<[f64; D]>,
    /// x^{n-1}; from the velocity update on those x^{n+1} of free nodes that it leads to, and reactions of
    /// held ones, N/m.
    pub(crate) positions_old: Vec<[f64; D]>,
    /// v^{n+1/2}.
    pub(crate) velocities: Vec<[f64; D]>,
    /// v^{n-1/2}.
    pub(crate) velocities_old: Vec<[f64; D]>,
    /// Contact and obstacle forces at x^n, N/m.
    pub(crate) contact_forces: ContactForces<D>,
    /// What the elements pull with, by the slots of the blocks, N/m.
    pub(crate) slots: Vec<[f64; D]>,
    pub(crate) springs: Springs<D>,
    pub(crate) reports: Vec<Report>,
    pub(crate) sums: Vec<Sums>,
    /// Groups of eight nodes, and which are free.
    pub(crate) groups: Groups,
    /// Sums over the rigid bodies.
    pub(crate) of_bodies: Sums,
    pub(crate) ledger: Ledger,
    pub(crate) penetration_max: f64,
    /// Largest speed of a node in the coming step, m/s, and the way that no node has exceeded since the
    /// start, m.
    pub(crate) speed: f64,
    pub(crate) travel: f64,
    /// Penetrations of contacts at the start, one line each.
    pub(crate) initial_penetrations: Vec<String>,
    /// What fails and what has failed; `None` where nothing can.
    pub(crate) erosion: Option<Box<Erosion<D>>>,
    /// What brings everything to rest; `None`: nothing.
    pub(crate) relaxation: Option<Relaxation<D>>,
    /// What it cost to make elements again; `None`: none are.
    pub(crate) remap: Option<Box<Remap>>,
    /// The stages of the run; `None`: it has none.
    pub(crate) stages: Option<Box<Stages<D>>>,
    /// Nodes that rotate.
    pub(crate) rotations: NodalRotations,
    /// Nodes on the faces of shells.
    pub(crate) skins: Skins<D>,
    /// Mass that was added for longer steps, and the true mass of what it was added to, kg/m.
    pub(crate) mass_added: [f64; 2],
    /// Mass that is added in the run, where the model wants it.
    pub(crate) mass_scaling: Option<MassScaling<D>>,
}

/// What contacts see of the system, field by field.
macro_rules! scene {
    ($system:ident) => {
        Scene {
            sweep: Sweep { old: &$system.positions_old, new: &$system.positions, travel: $system.travel },
            bodies: &$system.bodies,
            time: $system.time,
        }
    };
}

/// What the velocity update of the system's nodes reads: its fields one by one, so that the new velocities
/// can be written meanwhile.
macro_rules! nodes {
    ($system:ident, $velocities_old:ident, $time_step:expr) => {
        Nodes {
            dt: 0.5 * ($time_step + $system.time_step_old),
            assembly: &$system.assembly,
            slots: &$system.slots,
            contact_forces: if $system.contacts.is_empty() { None } else { Some(&$system.contact_forces) },
            loads: $system.forces.now(),
            gravity: $system.body_forces.accelerations(),
            mass: &$system.mass,
            constraints: &$system.constraints,
            damping: &$system.damping,
            boundary: &$system.boundary,
            joins: &$system.joins,
            bodies: &$system.bodies,
            skins: &$system.skins,
            rotations: &$system.rotations,
            velocities_old: &$system.$velocities_old,
            positions: &$system.positions,
            time_step: $time_step,
            free: &$system.groups.free,
            level: $system.level,
        }
    };
}

impl<const D: usize> System<D>
where
    Dim<D>: Dimension<D>,
{
    /// One step: x, forces, stable step, v, ledger.
    ///
    /// # Errors
    /// An inverted element, a collapsed step, a value that is not finite, too much energy drift, a node that
    /// runs away, a contact that is too deep.
    pub fn step(&mut self) -> Result<(), Error> {
        if self.is_stage_over() {
            self.enter_next_stage();
        }
        self.move_nodes();
        self.evaluate_forces()?;
        self.check_limits()
    }

    /// Everything that follows from the positions x^n.
    fn evaluate_forces(&mut self) -> Result<(), Error> {
        let elements = self.strain_and_detect();
        let elements = self.scale_mass(elements);
        let elements = self.choose_ratios(elements);
        self.advance_cavities()?;
        let time_step = self.stable_step(&elements);
        if time_step.is_err() {
            // The last output shows contacts where the bodies are.
            self.solve_springs(self.time_step_old);
        }
        let time_step = time_step?;
        self.relax();
        let time_step = self.limit_approach(time_step);
        self.begin_intervals(time_step);
        self.load(time_step);
        self.solve_contact_forces(time_step);
        self.accelerate(time_step);
        self.close_energy_balance(&elements)?;
        self.check_equilibrium();
        Ok(())
    }

    /// Forces and velocities at time zero: v^{1/2} = v⁰ + ½ dt⁰ a⁰.
    ///
    /// # Errors
    /// As [`System::step`].
    pub fn start(&mut self) -> Result<(), Error> {
        self.joins.begin(&self.mass, &mut self.velocities);
        self.lead_held([0.0, 0.0]);
        self.bodies.start(&self.curves, &self.positions, &mut self.velocities);
        self.rotations.prepare(&self.curves, [0.0; 2], [0.0; 2]);
        self.rotations.start(&self.bodies);
        self.ledger = Ledger::new(self.kinetic_half(), self.energy_of_round_off());
        self.skins.spin(&self.rotations.now.spins, &self.positions, &mut self.velocities);
        let nodes = reductions::max(self.velocities.iter().map(|&v| dot(v, v)));
        self.positions_old.clone_from(&self.positions);
        if !self.mesh.remeshed.is_empty() {
            // Of a run on its way: all that follows is filled in.
            [self.limits.step, self.limits.velocity] = self.mesh.remeshed.limits;
            return Ok(());
        }
        self.evaluate_rigid_parts();
        let fastest = reductions::max(self.bodies.iter().map(|body| body.speed_squared()).chain([nodes]));
        self.speed = fastest.sqrt();
        self.evaluate_forces()?;
        if self.limits.step <= 0.0 {
            self.limits.step = 1e-3 * self.time_step;
        }
        if self.limits.velocity <= 0.0 {
            self.limits.velocity = RUNAWAY * (fastest.sqrt() - self.limits.velocity);
        }
        Ok(())
    }

    /// Lets what holds nodes from now on lead them in a step between two times, s.
    fn lead_held(&mut self, step: [f64; 2]) {
        self.constraints.begin(&self.velocities, &self.curves, step[0]);
        self.constraints.drive(&self.curves, step, &self.positions);
        for (node, held) in self.constraints.held() {
            let velocity = &mut self.velocities[node as usize];
            *velocity = held.apply(*velocity);
        }
        for group in self.joins.groups() {
            group.lead(self.velocities[group.members[0].node as usize], &mut self.velocities);
        }
    }

    /// ½ Σ m|v^{n+½}|² of what has mass in the ledger, J/m.
    fn kinetic_half(&self) -> f64 {
        let free = |&(node, _): &(u32, _)| self.bodies.of_node(node).is_none();
        let kinetic = |(_, (m, v)): (u32, (&f64, &[f64; D]))| 0.5 * m * dot(*v, *v);
        let nodes = reductions::sum((0..).zip(self.mass.iter().zip(&self.velocities)).filter(free).map(kinetic));
        nodes + self.bodies.kinetic() + self.rotations.kinetic()
    }

    /// x^{n+1} = x^n + dt^n v^{n+1/2}.
    fn move_nodes(&mut self) {
        let dt = self.time_step;
        // The velocity update has moved those that are free or on faces already.
        for node in self.groups.held_nodes(self.positions.len()) {
            self.positions_old[node] = plus(self.positions[node], times(dt, self.velocities[node]));
        }
        std::mem::swap(&mut self.positions, &mut self.positions_old);
        self.bodies.advance(dt, &mut self.positions);
        self.rotations.advance(&self.bodies);
        self.time_step_old = dt;
        self.travel += dt * self.speed;
        self.time += dt;
        self.step += 1;
        if let Some(subcycling) = &mut self.subcycling {
            subcycling.pass();
        }
    }

    /// Internal forces, energies and steps of the elements at x^n, and springs of contacts and obstacles
    /// there: at the same time, unless elements may fail, which changes surfaces.
    fn strain_and_detect(&mut self) -> Report {
        let NodalRotations { now: rotations, slots: moments, .. } = &mut self.rotations;
        let turn = self.subcycling.as_ref().map_or(0, Subcycling::turn);
        let motion = Motion { rotations, turn, ..Motion::new(&self.positions, &self.velocities, self.time_step_old) };
        let mut strain = || {
            let (mut rest, mut rest_of_moments) = (&mut self.slots[..], &mut moments[..]);
            for (index, ((block, report), rigid)) in self.blocks.iter_mut().zip(&mut self.reports).zip(&self.rigid).enumerate() {
                let (slots, others) = rest.split_at_mut(block.slots().len());
                // With all elements gone there is nothing to strain.
                let is_gone = self.erosion.as_ref().is_some_and(|erosion| erosion.is_gone(index));
                let (moments, other_moments) = rest_of_moments.split_at_mut(block.moment_slots().len());
                if !rigid && !is_gone {
                    *report = block.advance(&motion, self.level, NodalForces { forces: slots, moments }, &mut self.team);
                }
                (rest, rest_of_moments) = (others, other_moments);
            }
        };
        if self.erosion.is_none() {
            both(strain, || detect(&mut self.contacts, &mut self.springs, &scene!(self)));
            return self.joined_reports();
        }
        strain();
        let elements = self.erode(self.joined_reports());
        detect(&mut self.contacts, &mut self.springs, &scene!(self));
        elements
    }

    /// What all blocks reported, with the step that is stable for elements and springs together.
    pub(crate) fn joined_reports(&self) -> Report {
        let all = Report::joined(self.reports.iter().copied());
        if !self.has_springs {
            return all;
        }
        let elements = &self.reports[..self.reports.len() - 1];
        let of_elements = reductions::min(elements.iter().map(|report| report.time_step_squared));
        // Where elements are evaluated less often there are no springs.
        let beside = if self.subcycling.is_some() { self.shortest_of_elements() } else { of_elements };
        Report { time_step_squared: self.with_springs(beside).min(of_elements), ..all }
    }

    /// Square of the step that is stable for springs too, s², from that of the elements.
    fn with_springs(&self, of_elements: f64) -> f64 {
        match self.reports.last() {
            Some(springs) if self.has_springs => together(of_elements, springs.time_step_squared),
            _ => of_elements,
        }
    }

    /// What acts from outside in the coming update, and the motion of the rigid bodies that follows from it.
    fn load(&mut self, time_step: f64) {
        let (from, to) = (self.time, self.time + time_step);
        let mean_step = 0.5 * (time_step + self.time_step_old);
        self.constraints.drive(&self.curves, [from, to], &self.positions);
        if !self.damping.is_empty() && self.damping.prepare(from, mean_step, self.mass.len()) {
            self.bodies.damp(&self.damping, &self.mass);
        }
        // Loads mean the update, from half step to half step.
        let update = [from - 0.5 * self.time_step_old, from + 0.5 * time_step];
        if self.body_forces.varies() {
            self.body_forces.prepare(&self.curves, update, &self.positions);
            self.bodies.weigh(&self.body_forces, &self.mass);
        }
        self.forces.prepare(&self.curves, update, &self.positions);
        self.press_cavities();
        self.rotations.prepare(&self.curves, update, [from, to]);
        self.let_go(update);
        if !self.skins.is_empty() {
            let Self { forces, skins, positions, rotations, .. } = self;
            forces.hand_on(|force, push| skins.hand_on(positions, force, push, rotations.loads_now()));
        }
        let (assembly, slots) = (&self.assembly, &self.slots);
        let internal = |node: usize| assembly.force(node, slots);
        let moment = |node: u32| self.rotations.moment(node);
        let (curves, positions, loads) = (&self.curves, &self.positions, self.forces.now());
        self.bodies.set_free(&Acting { mean_step, from, to, curves, positions, loads, internal, moment: &moment });
        self.curves.pass(from, to);
    }

    /// What the springs of contacts and obstacles push with in the coming update.
    fn solve_springs(&mut self, time_step: f64) {
        let nodes = nodes!(self, velocities, time_step);
        let (time_steps, positions, bodies, level) = ([self.time_step_old, time_step], &self.positions, &self.bodies, self.level);
        let update = Update { time_steps, positions, nodes: &nodes, bodies, level };
        self.springs.solve(&update);
    }

    /// Contact and obstacle forces at x^n for the coming update.
    fn solve_contact_forces(&mut self, time_step: f64) {
        if self.contacts.is_empty() {
            return;
        }
        self.solve_springs(time_step);
        self.contact_forces.clear();
        for contact in &mut self.contacts {
            contact.collect(&self.springs, &mut self.contact_forces, &mut self.bodies, &mut self.traces, time_step);
            self.penetration_max = self.penetration_max.max(contact.depth());
        }
        self.hand_contact_forces_on();
        let stored = || reductions::sum(self.contacts.iter().map(|contact| contact.stored_before(&self.springs)));
        if let Some(erosion) = &mut self.erosion {
            erosion.energy += erosion.springs.close(stored);
        }
        if let Some(remap) = &mut self.remap {
            remap.energy += remap.springs.close(stored);
        }
    }

    /// v^{n+1/2} = v^{n-1/2} + ½ (dt^n + dt^{n-1}) f^n / m, then prescribed motion; sums for the ledger.
    fn accelerate(&mut self, time_step: f64) {
        std::mem::swap(&mut self.velocities, &mut self.velocities_old);
        let nodes = nodes!(self, velocities_old, time_step);
        let parts = (Chunks::new(&mut self.velocities, CHUNK), Chunks::new(&mut self.positions_old, CHUNK), Chunks::new(&mut self.sums, 1));
        match &mut self.subcycling {
            Some(own) => own.accelerate(&nodes, parts, &mut self.team),
            None => self.team.each(parts, |index, _, (velocities, next, sums)| sums.fill(nodes.update(index * CHUNK, velocities, next))),
        }
        let groups = nodes.update_groups(&mut self.velocities);
        let steps = [nodes.dt, time_step];
        self.of_bodies = self.bodies.accelerate(steps, &self.contact_forces, &self.positions, &mut self.velocities);
        self.of_bodies += &groups;
        self.of_bodies += &self.rotations.accelerate(steps, &self.damping, &self.bodies, self.level);
        let (positions, velocities, next) = (&self.positions, &mut self.velocities, &mut self.positions_old);
        let of_faces = self.skins.lead(self.rotations.next(), time_step, positions, velocities, next, self.level);
        self.time_step = time_step;
        self.speed = self.largest_speed(of_faces);
    }

    /// Enters the step in the ledger and checks that the run is still worth continuing.
    fn close_energy_balance(&mut self, elements: &Report) -> Result<(), Error> {
        let sum = Sums::total(self.sums.iter().chain([&self.of_bodies]));
        let totals = || self.contacts.iter().map(|contact| contact.totals);
        let works = Works {
            internal: sum.internal,
            contact: reductions::sum(totals().map(|totals| totals.work)),
            gravity: sum.gravity,
            load: sum.load,
            damping: sum.damping,
            constraint: sum.constraint,
            drive: sum.drive,
            remap: 0.0,
        };
        let slip_energy = reductions::sum(totals().map(|totals| totals.slip_energy));
        let springs = reductions::sum(totals().map(|totals| totals.energy)) + slip_energy;
        let lost = Lost::total(totals().map(|totals| totals.lost));
        let stores = Stores {
            kinetic: sum.kinetic,
            elastic: elements.stored,
            plastic: elements.dissipated,
            hourglass: elements.hourglass,
            bulk_viscosity: elements.viscous,
            damping: elements.damping,
            contact: springs,
            eroded: self.erosion.as_ref().map_or(0.0, |erosion| erosion.energy),
            remap: self.remap.as_ref().map_or(0.0, |remap| remap.energy),
            flow: self.remap.as_ref().map_or(0.0, |remap| remap.flowed),
            ..Stores::default()
        };
        if !(sum.kinetic_half.is_finite() && stores.total().is_finite()) {
            return Err(self.not_finite());
        }
        let before = self.before();
        self.ledger.enter(&Entry {
            kinetic_half: sum.kinetic_half,
            works,
            external_old: sum.external_old,
            lost,
            slip_energy,
            damping_old: sum.damping_old,
            before,
            stores,
        });
        let drift = self.ledger.drift();
        if drift > self.limits.energy {
            return Err(Error::EnergyDrift { drift, limit: self.limits.energy, time: self.time, step: self.step });
        }
        Ok(())
    }
}

impl<const D: usize> System<D>
where
    Dim<D>: Dimension<D>,
{
    /// Largest |v^{n+1/2}|, m/s, with the square of that of what faces of shells lead.
    fn largest_speed(&self, of_faces: f64) -> f64 {
        let free = self.sums.iter().map(|sums| sums.speed_squared);
        let square = |node: usize| dot(self.velocities[node], self.velocities[node]);
        let held = self.groups.held_nodes(self.velocities.len()).map(square);
        reductions::max(free.chain(held).chain([of_faces])).sqrt()
    }

    /// Finds the nodes that nothing holds.
    pub(crate) fn find_free_nodes(&mut self) {
        let Self { constraints, boundary, joins, bodies, skins, .. } = self;
        let is_free = |node: usize| {
            let number = node as u32;
            skins.carrier(node).is_none()
                && constraints.of(node).is_none()
                && boundary.of(node).is_none()
                && joins.of_node(number).is_none()
                && bodies.of_node(number).is_none()
        };
        self.groups = Groups::new(self.mass.len(), is_free, |nodes| skins.leads(nodes));
    }

    /// Finds the nodes on the faces of shells, which their middles lead.
    pub(crate) fn find_skins(&mut self) {
        self.skins = Skins::new(&self.mesh, &self.rotations.now, |owner| self.bodies.of_node(owner).is_some());
        if self.skins.is_empty() {
            return;
        }
        self.springs.add_carriers(self.rotations.now.nodes.len());
        self.find_free_nodes();
    }

    /// Hands contact forces on the faces of shells on to their middles.
    fn hand_contact_forces_on(&mut self) {
        if self.skins.is_empty() {
            return;
        }
        let Self { contact_forces, skins, positions, rotations, .. } = self;
        let mut pushes = Vec::new();
        skins.hand_on(positions, |node| contact_forces.of(node), |owner, force, _| pushes.push((owner, force)), rotations.contact_now());
        for (node, force) in pushes {
            contact_forces.push(node, force);
        }
    }

    /// Energy of the elements when every node is off by 1e-12 of the model's size, J/m: thousands of
    /// roundings.
    fn energy_of_round_off(&self) -> f64 {
        let size = reductions::max(self.positions.iter().flatten().map(|x| x.abs()));
        let stiffness = reductions::sum(self.blocks.iter().map(|block| block.wave_modulus() * block.elements() as f64));
        stiffness * (1e-12 * size) * (1e-12 * size)
    }

    /// Part of the last velocity update that lies before the whole step: dt^{n-1} / (dt^{n-1} + dt^n); zero
    /// at time zero.
    pub(crate) fn before(&self) -> f64 {
        self.time_step_old / (self.time_step_old + self.time_step)
    }

    /// Gives rigid parts their first and last look: they never pull. Only where nothing else does, nor the
    /// model, they set the step: that which their elements would need.
    fn evaluate_rigid_parts(&mut self) {
        let NodalRotations { now: rotations, slots: moments, .. } = &mut self.rotations;
        let motion = Motion { rotations, ..Motion::new(&self.positions, &self.velocities, 0.0) };
        let alone = self.rigid.iter().all(|&rigid| rigid) && self.limits.largest == f64::INFINITY;
        let (mut rest, mut rest_of_moments) = (&mut self.slots[..], &mut moments[..]);
        for ((block, report), rigid) in self.blocks.iter_mut().zip(&mut self.reports).zip(&self.rigid) {
            let (slots, others) = rest.split_at_mut(block.slots().len());
            let (moments, other_moments) = rest_of_moments.split_at_mut(block.moment_slots().len());
            if *rigid {
                let pulls = NodalForces { forces: &mut *slots, moments: &mut *moments };
                let seen = block.advance(&motion, self.level, pulls, &mut self.team);
                slots.fill([0.0; D]);
                moments.fill([0.0; 3]);
                *report = if alone { Report { stored: 0.0, dissipated: 0.0, ..seen } } else { Report::NOTHING };
            }
            (rest, rest_of_moments) = (others, other_moments);
        }
    }

    /// Nodes that are held and that the velocity update advances by themselves, and what holds them: none of
    /// rigid bodies, and none on faces of shells.
    pub(crate) fn held(&self) -> impl Iterator<Item = (u32, &NodeConstraint<D>)> {
        self.held_by(&self.constraints)
    }

    /// The same with the constraints of another stage.
    pub(crate) fn held_by<'a>(&'a self, constraints: &'a Constraints<D>) -> impl Iterator<Item = (u32, &'a NodeConstraint<D>)> {
        let is_advanced = |node: u32| self.bodies.of_node(node).is_none() && self.skins.carrier(node as usize).is_none();
        constraints.held().filter(move |(node, _)| is_advanced(*node))
    }

    /// Force (N/m) in the last update of what holds one of [`System::held`].
    pub(crate) fn reaction(&self, node: u32) -> [f64; D] {
        if self.joins.of_node(node).is_some() {
            let nodes = nodes!(self, velocities_old, self.time_step);
            return nodes.reaction(node as usize, self.velocities[node as usize]);
        }
        // The velocity update has left it there.
        self.positions_old[node as usize]
    }

    /// Hands over the reactions in the last update of rotations that are held: the node, what holds it, and
    /// its moment, N (N m).
    pub(crate) fn moment_reactions(&self, see: impl FnMut(u32, &NodeConstraint<3>, [f64; 3])) {
        self.rotations.reactions(self.mean_step(), &self.damping, see);
    }

    /// Mean of the last step and the coming one, s: what the last velocity update has taken.
    pub(crate) fn mean_step(&self) -> f64 {
        0.5 * (self.time_step + self.time_step_old)
    }

    /// Velocities of a node before and after the whole step, m/s: of a rigid body those of the point, not
    /// those of the chord that leads it on.
    pub(crate) fn velocities_around(&self, node: usize) -> [[f64; D]; 2] {
        match self.bodies.of_node(node as u32) {
            Some(body) => {
                let body = self.bodies.state(body);
                [body.velocity_old, body.velocity].map(|velocity| body.velocity_at(self.positions[node], &velocity))
            }
            None => [self.velocities_old[node], self.velocities[node]],
        }
    }

    /// Velocity of a node at the whole step, m/s: v^{n-1/2} and v^{n+1/2} lie ½ dt^{n-1} before and ½ dt^n
    /// after it (v⁰ itself at time zero).
    pub(crate) fn velocity(&self, node: usize) -> [f64; D] {
        let ([a, b], before) = (self.velocities_around(node), self.before());
        plus(a, times(before, minus(b, a)))
    }

    /// Kinetic energy of a node at the whole step by its mass, J/kg: its share in [`Stores::kinetic`] as the
    /// ledger enters it.
    pub(crate) fn specific_kinetic(&self, node: usize) -> f64 {
        let [old, new] = match self.bodies.of_node(node as u32) {
            Some(body) => {
                let body = self.bodies.state(body);
                [body.velocity_old, body.velocity].map(|velocity| body.velocity_at(self.positions[node], &body.free_part(&velocity)))
            }
            None => [self.velocities_old[node], self.velocities[node]],
        };
        let before = self.before();
        if before > 0.0 {
            0.5 * dot(old, new) - (0.5 - before) * 0.5 * (dot(new, new) - dot(old, old))
        } else {
            dot(old, new) - 0.5 * dot(new, new)
        }
    }
}
