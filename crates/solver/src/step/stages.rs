//! Stages of a run: what acts, what holds nodes and whether all is brought to rest changes from one to the
//! next, between two steps.
//!
//! A stage is over when its time is, or at rest where it is relaxed. The state of that step is its last; the
//! next stage begins at the same time. What holds nodes then leads them from there on: where it leads them
//! otherwise than they move, and where bodies get their initial velocities, v^{n+½} changes at once. With
//! that half of the step that follows has another way than forces have done work on: the ledger gets ΔK − ½
//! dt^n Σ f · Δv as work from outside, f of elements and contacts.

use super::System;
use super::relaxation::Relaxation;
use crate::archive::{Archive, ArchiveResult, Persist, persist_each};
use crate::contact::{Contact, ContactKind};
use crate::contact_forces::ContactForces;
use crate::dimension::Dimension;
use crate::load::constraint::Constraints;
use crate::load::curve::table::smooth_step;
use crate::model::{self, Model};
use crate::reductions::{self, SumInOrder};
use crate::rigid::RigidMotion;
use crate::tensor::Dim;
use crate::vector::{dot, minus, plus, times};

/// A stage of a run, over or until now.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StageRun {
    /// Its name.
    pub name: String,
    /// When it began, s.
    pub begin: f64,
    /// When it was over, or the present time, s.
    pub end: f64,
    /// Whether all was at rest at its end; `None`: it is not relaxed.
    pub is_at_rest: Option<bool>,
    /// Kinetic over internal energy at its end, of one that is relaxed.
    pub ratio: Option<f64>,
}

/// The stages of a run.
pub(crate) struct Stages<const D: usize>
where
    Dim<D>: Dimension<D>,
{
    list: Vec<model::Stage>,
    /// Those that are over: the present one follows.
    over: Vec<StageRun>,
    /// What holds nodes in the stages after the first; of the present one that of the one before.
    later: Vec<Constraints<D>>,
    /// The stage that gives bodies their initial velocities, and these.
    launch: Option<(usize, Launch<D>)>,
    /// What lets go in the present stage.
    release: Release<D>,
    /// What held at the end of the stage, of a kept state that stands there: it no longer knows by itself.
    held: Option<Release<D>>,
}

/// Forces that held bodies in the stage before, and decrease to zero.
#[derive(Clone, Debug, Default)]
struct Release<const D: usize> {
    /// Node and force, N/m (N).
    forces: Vec<(u32, [f64; D])>,
    /// Node and moment, N (N m).
    moments: Vec<(u32, [f64; 3])>,
}

/// Initial velocities that wait for a stage.
struct Launch<const D: usize>
where
    Dim<D>: Dimension<D>,
{
    /// Of nodes, m/s.
    velocities: Vec<[f64; D]>,
    /// Of nodes that rotate, rad/s.
    spins: Vec<[f64; 3]>,
    /// Of rigid bodies.
    bodies: Vec<<Dim<D> as RigidMotion<D>>::Generalized<f64>>,
}

impl<const D: usize> Release<D> {
    fn is_empty(&self) -> bool {
        self.forces.is_empty() && self.moments.is_empty()
    }
}

impl<const D: usize> Persist for Release<D> {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { forces, moments } = self;
        archive.on_nodes(forces)?;
        archive.on_nodes(moments)
    }
}

impl<const D: usize> Stages<D>
where
    Dim<D>: Dimension<D>,
{
    /// Of a model; `None`: it has none. `later` is what holds nodes in those after the first.
    pub(crate) fn of(model: &Model, later: Vec<Constraints<D>>) -> Option<Box<Self>> {
        let list = model.stages.clone();
        (!list.is_empty()).then(|| Box::new(Self { list, over: Vec::new(), later, launch: None, release: Release::default(), held: None }))
    }

    /// Number of the present stage.
    pub(crate) fn now(&self) -> usize {
        self.over.len()
    }

    /// Whether none follows.
    pub(crate) fn is_last(&self) -> bool {
        self.now() + 1 == self.list.len()
    }

    /// When the present stage began, and when it ends at the latest, s.
    pub(crate) fn span(&self) -> [f64; 2] {
        let begin = self.over.last().map_or(0.0, |before| before.end);
        [begin, begin + self.list[self.now()].duration]
    }

    /// What holds nodes in each stage after the first, as long as that is the present one.
    pub(crate) fn later_constraints(&self) -> &[Constraints<D>] {
        &self.later
    }

    /// The latest end of the run, s.
    fn end(&self) -> f64 {
        let [_, end] = self.span();
        self.list[self.now() + 1..].iter().fold(end, |end, stage| end + stage.duration)
    }

    /// The present stage until `time`, s.
    fn run_until(&self, time: f64, relaxation: Option<&Relaxation<D>>) -> StageRun {
        let rests = relaxation.is_some_and(|own| own.rest.is_some());
        StageRun {
            name: self.list[self.now()].name.clone(),
            begin: self.span()[0],
            end: time,
            is_at_rest: relaxation.map(|_| rests),
            ratio: relaxation.map(|own| own.ratio),
        }
    }
}

impl<const D: usize> System<D>
where
    Dim<D>: Dimension<D>,
{
    /// Number of the present stage; 0 without any.
    pub(crate) fn stage(&self) -> usize {
        self.stages.as_ref().map_or(0, |stages| stages.now())
    }

    /// When the present stage began and when it ends at the latest, of a run without stages the whole, s.
    pub(crate) fn stage_span(&self) -> [f64; 2] {
        self.stages.as_ref().map_or([0.0, self.limits.end], |stages| stages.span())
    }

    /// See [`System::stage_span`].
    pub(super) fn stage_end(&self) -> f64 {
        self.stage_span()[1]
    }

    /// When all was at rest, which ended the run, s.
    pub(crate) fn rest(&self) -> Option<f64> {
        let is_end = self.stages.as_ref().is_none_or(|stages| stages.is_last());
        self.relaxation.as_ref().filter(|_| is_end).and_then(|own| own.rest)
    }

    /// Whether the present stage is over and another one follows.
    pub(crate) fn is_stage_over(&self) -> bool {
        let Some(stages) = self.stages.as_ref().filter(|stages| !stages.is_last()) else { return false };
        self.time >= stages.span()[1] || self.relaxation.as_ref().is_some_and(|own| own.rest.is_some())
    }

    /// The stages so far, with the present one until now.
    pub(crate) fn stages_run(&self) -> Vec<StageRun> {
        let Some(stages) = &self.stages else { return Vec::new() };
        stages.over.iter().cloned().chain([stages.run_until(self.time, self.relaxation.as_ref())]).collect()
    }

    /// Keeps initial velocities for the stage `of` which they are, unless it is the first; without such a
    /// stage there are none.
    pub(crate) fn hold_velocities_back(&mut self, of: Option<usize>) {
        let Some(stages) = &mut self.stages else { return };
        if of == Some(0) {
            return;
        }
        let nodes = self.velocities.len();
        let velocities = std::mem::replace(&mut self.velocities, vec![[0.0; D]; nodes]);
        self.velocities_old.clone_from(&self.velocities);
        let launch = Launch { velocities, spins: self.rotations.hold_back(), bodies: self.bodies.hold_back() };
        let fastest = reductions::max(launch.velocities.iter().map(|&v| dot(v, v))).sqrt();
        if self.limits.velocity <= 0.0 {
            self.limits.velocity -= fastest;
        }
        stages.launch = of.map(|stage| (stage, launch));
    }

    /// Lets the next stage begin.
    pub(super) fn enter_next_stage(&mut self) {
        let Some(mut stages) = self.stages.take() else { return };
        let (over, kept) = (stages.run_until(self.time, self.relaxation.as_ref()), stages.held.take());
        stages.over.push(over);
        let held = stages.list[stages.now()].release.map(|_| kept.unwrap_or_else(|| self.what_holds()));
        self.take_stage(&mut stages);
        stages.release = held.map(|held| self.what_lets_go(held)).unwrap_or_default();
        let launch = stages.launch.take_if(|(stage, _)| *stage == stages.over.len());
        self.stages = Some(stages);
        self.change_velocities(launch.map(|(_, launch)| launch));
        if let Some(subcycling) = &mut self.subcycling {
            subcycling.wake();
        }
    }

    /// Reactions of what holds nodes, and rotations.
    fn what_holds(&self) -> Release<D> {
        let mut moments = Vec::new();
        self.moment_reactions(|node, _, moment| moments.push((node, moment)));
        Release { forces: self.held().map(|(node, _)| (node, self.reaction(node))).collect(), moments }
    }

    /// What of these reactions nothing takes in the new stage, with the forces of contacts that have ended.
    fn what_lets_go(&self, held: Release<D>) -> Release<D> {
        let mut forces = vec![[0.0; D]; self.positions.len()];
        for (node, force) in held.forces {
            forces[node as usize] = self.constraints.of(node as usize).map_or(force, |own| own.free_part(force));
        }
        let ended: Vec<_> = self.contacts.iter().filter(|contact| contact.times()[1] == self.time).collect();
        if !ended.is_empty() {
            let (mut contact, mut bodies) = (ContactForces::new(forces.len()), self.bodies.clone());
            ended.into_iter().for_each(|own| own.push(&self.springs, &mut contact, &mut bodies));
            forces.iter_mut().enumerate().for_each(|(node, force)| *force = plus(*force, contact.of(node)));
        }
        let forces = (0..).zip(forces).filter(|(_, force)| *force != [0.0; D]).collect();
        let moments = held.moments.into_iter().map(|(node, moment)| (node, self.rotations.free_part(node, moment)));
        Release { forces, moments: moments.filter(|(_, moment)| *moment != [0.0; 3]).collect() }
    }

    /// Adds what still holds of the stage before to the loads, as the mean over an update, s.
    pub(super) fn let_go(&mut self, [from, to]: [f64; 2]) {
        let Some(stages) = &self.stages else { return };
        let Some(duration) = stages.list[stages.now()].release.filter(|_| !stages.release.is_empty()) else { return };
        let s = (0.5 * (from + to) - stages.span()[0]) / duration;
        if s >= 1.0 {
            return;
        }
        let share = 1.0 - smooth_step(s.max(0.0));
        self.forces.add(stages.release.forces.iter().map(|&(node, force)| (node, times(share, force))), self.positions.len());
        let places =
            stages.release.moments.iter().filter_map(|&(node, moment)| Some((self.rotations.now.place(node)?, times(share, moment))));
        let places: Vec<_> = places.collect();
        if !places.is_empty() {
            let loads = self.rotations.loads_now();
            places.into_iter().for_each(|(place, moment)| loads[place] = plus(loads[place], moment));
        }
    }

    /// What acts from the beginning of the present stage on.
    fn take_stage(&mut self, stages: &mut Stages<D>) {
        let (number, [now, _]) = (stages.now(), stages.span());
        self.curves.enter(number, now);
        let freed = self.contacts.iter_mut().map(|contact| contact.enter(number, now, &self.springs)).sum();
        self.ledger.free(freed);
        for outline in &mut self.outlines {
            let is_own = |contact: &&Contact<D>| matches!(contact.kind, ContactKind::Obstacle(_)) && contact.name == outline.name;
            outline.death = self.contacts.iter().find(is_own).map_or(outline.death, |contact| contact.times()[1]);
        }
        std::mem::swap(&mut self.constraints, &mut stages.later[number - 1]);
        self.rotations.hold(&self.constraints, &self.joins);
        self.find_free_nodes();
        let (assembly, slots, nodes) = (&self.assembly, &self.slots, self.positions.len());
        self.relaxation = stages.list[number].relaxation.map(|own| {
            let from = now + own.from.max(stages.list[number].release.unwrap_or(0.0));
            let relaxation = Relaxation::new(model::Relaxation { from, ..own }, nodes);
            relaxation.with_forces(|node| assembly.force(node, slots))
        });
        self.damping.enter(number, now, self.relaxation.is_some());
        self.damping.prepare(now, 0.0, nodes);
        self.bodies.damp(&self.damping, &self.mass);
        self.limits.end = stages.end();
    }

    /// Adds initial velocities, and lets what holds nodes now lead them.
    fn change_velocities(&mut self, launch: Option<Launch<D>>) {
        let kinetic = self.kinetic_half();
        let old = self.velocities.clone();
        if let Some(Launch { velocities, spins, bodies }) = &launch {
            self.velocities.iter_mut().zip(velocities).for_each(|(v, own)| *v = plus(*v, *own));
            self.rotations.launch(spins);
            self.bodies.launch(bodies, self.time_step, &self.positions, &mut self.velocities);
            self.joins.begin(&self.mass, &mut self.velocities);
        }
        let (now, dt) = (self.time, self.time_step);
        self.lead_held([now, now + dt]);
        self.rotations.prepare(&self.curves, [now; 2], [now, now + dt]);
        self.rotations.start(&self.bodies);
        self.rotations.foresee(dt, self.level);
        // The velocity update leads them so; reactions of what was held are known.
        for (next, (x, v)) in self.positions_old.iter_mut().zip(self.positions.iter().zip(&self.velocities)) {
            *next = plus(*x, times(dt, *v));
        }
        let of_faces =
            self.skins.lead(self.rotations.next(), dt, &self.positions, &mut self.velocities, &mut self.positions_old, self.level);
        let mut ahead = SumInOrder::default();
        for (node, (new, old)) in self.velocities.iter().zip(&old).enumerate().filter(|(_, (new, old))| new != old) {
            let contact = if self.contacts.is_empty() { [0.0; D] } else { self.contact_forces.of(node) };
            let force = plus(self.assembly.force(node, &self.slots), contact);
            ahead.add(dot(force, minus(*new, *old)));
        }
        self.ledger.launch(self.kinetic_half() - kinetic, -0.5 * dt * ahead.value());
        let fastest = reductions::max(self.velocities.iter().map(|&v| dot(v, v)).chain([of_faces]));
        self.speed = self.speed.max(fastest.sqrt());
    }

    /// The stages so far in a kept state; what they have changed is changed again.
    pub(super) fn persist_stages(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let mut held = if self.is_stage_over() { self.what_holds() } else { Release::default() };
        let Some(mut stages) = self.stages.take() else { return Ok(()) };
        let mut count = stages.over.len();
        count.persist(archive)?;
        archive.check(count < stages.list.len(), "it is in a stage that there is not")?;
        for number in 0..count {
            let is_new = number == stages.over.len();
            let mut over = if is_new { stages.run_until(0.0, None) } else { stages.over[number].clone() };
            persist_each!(archive; &mut over.end, &mut over.is_at_rest, &mut over.ratio);
            if is_new {
                stages.over.push(over);
                self.take_stage(&mut stages);
            }
        }
        if stages.launch.as_ref().is_some_and(|(stage, _)| *stage <= count) {
            stages.launch = None;
        }
        stages.release.persist(archive)?;
        held.persist(archive)?;
        stages.held = archive.reads().then_some(held).filter(|held| !held.is_empty());
        self.stages = Some(stages);
        if count > 0 { self.constraints.persist_begun(archive) } else { Ok(()) }
    }
}
