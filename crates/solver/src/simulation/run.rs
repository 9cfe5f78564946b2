//! A model of one dimension, step by step: the loop, events, the end. [`super::Simulation`] is one of these.

use super::clock::Clock;
use super::contact_pairs;
use super::memory::Memory;
use super::output_cursor::OutputCursor;
use super::parts::KnownParts;
use super::remesh::Remesher;
use super::{Control, Observer, ObserverError, Options, Overview, Progress, Runs, State, TimeStepCosts, few, time_step_costs, tiny};
use crate::build;
use crate::channel::{self, Channels};
use crate::contact::initial::{self, Inside, Penetration};
use crate::contact::messages::INSIDE_AT_START;
use crate::contact::{ContactKind, search};
use crate::error::{Error, Fault, INSTRUCTIONS, MASS_ADDED, Notice, Warning};
use crate::field::snapshot::LiveSnapshot;
use crate::hashes::{self, Hashes, Hashing};
use crate::material::messages::{IMPLAUSIBLE, OTHER_UNITS};
use crate::mesh::messages::TINY_STEP;
use crate::mesh::{Mesh, PlacedMesh};
use crate::model::{self, Cadence, Model};
use crate::monitor::RunMonitor;
use crate::output::{Cells, Field, Frame, Shown, fields_of};
use crate::record::{Momentum, Recorded};
use crate::shortest::Shortest;
use crate::step::System;
use crate::tensor::Dim;
use embate_lanes::Level;
use std::any::Any;
use std::collections::BTreeMap;

/// Looks at a system after every step.
pub(crate) trait AfterStep<const D: usize>: Any + Send + Sync
where
    Dim<D>: Runs<D>,
{
    /// Looks at it after a step, or after one that failed.
    fn note(&mut self, system: &System<D>, recorded: &Recorded<D>, error: Option<&Error>);
}

/// A model of one dimension made ready to step: what a [`Simulation`] of it does.
pub(crate) struct Run<const D: usize>
where
    Dim<D>: Runs<D>,
{
    pub(crate) system: System<D>,
    pub(crate) recorded: Recorded<D>,
    pub(crate) momentum: Option<Momentum<D>>,
    pub(super) shortest: Shortest,
    pub(super) monitor: RunMonitor,
    pub(crate) threads: usize,
    pub(super) model_warnings: Vec<Warning>,
    pub(crate) warnings: Vec<Notice>,
    pub(super) known_parts: KnownParts,
    /// See [`Overview::contacts`].
    pub(super) contact_lines: Vec<String>,
    pub(super) history: Cadence,
    pub(super) fields: Cadence,
    pub(super) max_steps: u64,
    /// Steps between two states that are handed out; `None`: only when asked for.
    pub(super) state_steps: Option<u64>,
    /// Steps between two hashes of the state; `None`: none.
    pub(super) hash_steps: Option<u64>,
    pub(super) hashing: Hashing,
    pub(super) output_cursor: Option<OutputCursor>,
    /// Whether something was changed between two steps.
    pub(super) is_steered: bool,
    /// Revision of the mesh whose cells observers know.
    pub(super) known_cells: u32,
    pub(super) memory: Memory,
    /// Looks at every step of a run that goes to its failure once more.
    pub(crate) tracer: Option<Box<dyn AfterStep<D>>>,
    /// Search of each contact by name.
    pub(super) search_names: BTreeMap<String, String>,
    pub(super) pool: Option<rayon::ThreadPool>,
    /// Makes elements again, where the model wants it.
    pub(super) remesher: Option<Remesher>,
}

/// Steps between two calls of [`Observer::progress`].
pub(super) const PROGRESS: u64 = 256;

impl<const D: usize> Run<D>
where
    Dim<D>: Runs<D>,
{
    /// Makes a model ready: everything at time zero is known, velocities are those of the first half step.
    ///
    /// # Errors
    /// [`Error::Model`] with all faults; the errors of a step, if the very first forces fail.
    pub(crate) fn new(model: &Model, options: &Options) -> Result<Self, Error> {
        Self::on(model, None, options)
    }

    /// The same on a mesh that stands for the model's.
    ///
    /// # Errors
    /// As [`Run::new`].
    pub(crate) fn on(model: &Model, mesh: Option<Mesh<D>>, options: &Options) -> Result<Self, Error> {
        let level = match &options.simd {
            None => Level::best(),
            Some(name) => Level::named(name).ok_or_else(|| {
                let has: Vec<_> = Level::available().iter().map(|level| level.name()).collect();
                Error::Model(vec![Fault::new(
                    &INSTRUCTIONS,
                    "",
                    format!("instruction set \"{name}\" is not available here"),
                    format!("this machine has {}", has.join(", ")),
                )])
            })?,
        };
        let threads = options.thread_count();
        let (system, model_warnings) = build::system(model, mesh, level, threads).map_err(Error::Model)?;
        let recorded = Recorded::new(model, &system).map_err(Error::Model)?;
        Channels::new(model, &recorded.columns()).map_err(Error::Model)?;
        let pool = if system.team.threads() > 1 { rayon::ThreadPoolBuilder::new().num_threads(threads).build().ok() } else { None };
        let mut simulation = Self {
            momentum: None,
            recorded,
            shortest: Shortest::default(),
            monitor: RunMonitor::new(model, &system),
            threads: if pool.is_some() { threads } else { 1 },
            model_warnings,
            warnings: Vec::new(),
            known_parts: KnownParts::new(model, &system),
            contact_lines: contact_pairs::lines(model, &system.mesh),
            history: model.output.history,
            fields: model.output.fields,
            max_steps: model.run.max_steps.unwrap_or(u64::MAX),
            state_steps: model.run.checkpoint_steps,
            hash_steps: model.output.hash_steps,
            hashing: Hashing::default(),
            output_cursor: None,
            is_steered: false,
            known_cells: system.mesh.revision,
            memory: Memory::default(),
            tracer: None,
            search_names: model.contacts.iter().map(|contact| (contact.name.clone(), search_name(contact))).collect(),
            pool,
            remesher: Remesher::new(model, &system.mesh),
            system,
        };
        within_pool(simulation.pool.as_ref(), &mut simulation.system, System::start)?;
        simulation.recorded.begin(&simulation.system);
        simulation.model_warnings.extend(tiny::warnings(&simulation.system));
        simulation.model_warnings.extend(channel::warnings(model));
        simulation.model_warnings.extend(simulation.recorded.warnings(&simulation.system));
        // Where materials are wrong, or one element is, so is the step.
        let says_why = |warning: &Warning| [&IMPLAUSIBLE, &OTHER_UNITS, &TINY_STEP].contains(&warning.kind);
        if !simulation.model_warnings.iter().any(says_why) {
            simulation.model_warnings.extend(few::warning(model, &simulation.system));
        }
        // What flows through a part takes momentum with it.
        simulation.momentum = if model.flows.is_empty() { Momentum::new(&simulation.system) } else { None };
        simulation.shortest.note(&simulation.system);
        simulation.check_obstacles(model)?;
        let [added, of] = simulation.system.mass_added;
        if added != 0.0 {
            let unit = if model.is_of_whole_bodies() { "kg" } else { "kg/m" };
            let message = format!("mass scaling added {added:.6e} {unit}, {:.3} % of the mass of the deformable parts", 100.0 * added / of);
            simulation.warnings.push(Notice::new(&MASS_ADDED, message));
        }
        if !simulation.system.initial_penetrations.is_empty() {
            let text = "some nodes were inside other bodies at the start: `embate check` says how many, and where the deepest is";
            simulation.warnings.push(Notice::new(&INSIDE_AT_START, text));
        }
        Ok(simulation)
    }

    /// Lets the run keep states in memory, in so many bytes for all of them together: see
    /// [`Simulation::states`].
    pub(crate) fn keep_states_in(&mut self, bytes: usize) {
        self.memory = Memory::of(bytes);
    }

    /// See [`super::Simulation::begin_reports`].
    pub(crate) fn begin_reports(&mut self) {
        self.output_cursor = None;
    }

    /// States of the run so far that are in memory, the newest first; none where they are too large for their
    /// room.
    pub(crate) fn states(&self) -> &[State] {
        self.memory.states()
    }

    /// Nodes behind an obstacle at the start are faults.
    fn check_obstacles(&self, model: &Model) -> Result<(), Error> {
        let system = &self.system;
        if !system.mesh.remeshed.is_empty() {
            return Ok(());
        }
        let tolerance = crate::mesh::tolerance(&system.positions);
        let mut faults = Vec::new();
        for contact in &system.contacts {
            let Some(index) =
                model.obstacles.iter().position(|it| matches!(contact.kind, ContactKind::Obstacle(_)) && it.name == contact.name)
            else {
                continue;
            };
            let interface = &model.obstacles[index].interface;
            if initial::is_ignored(interface) {
                continue;
            }
            let inside = contact.penetrations(&system.springs).filter(|&(_, depth)| depth > tolerance);
            let found: Vec<Penetration<D>> =
                inside.map(|(node, depth)| Penetration { what: Inside::Node, place: system.positions[node as usize], depth }).collect();
            let hint = build::inside_out::turned(&model.obstacles[index], &system.mesh, found.len());
            faults.extend(initial::fault(model, &format!("obstacle[{index}]"), &contact.name, &found, hint));
        }
        if faults.is_empty() { Ok(()) } else { Err(Error::Model(faults)) }
    }

    /// What the user should know of the model: it was accepted. [`Simulation::summary`] has them as texts,
    /// with those of the run.
    pub(crate) fn model_warnings(&self) -> &[Warning] {
        &self.model_warnings
    }

    /// Time reached, s.
    pub(crate) fn time(&self) -> f64 {
        self.system.time
    }

    /// Step that leads to the next state, s.
    pub(crate) fn time_step(&self) -> f64 {
        self.system.time_step
    }

    /// Most sweeps over the contact springs that a step took, and steps whose forces were not solved to the
    /// last digit.
    pub(crate) fn sweeps(&self) -> (usize, u64) {
        (self.system.springs.sweeps_max, self.system.springs.unsolved)
    }

    /// Energies and works so far.
    pub(crate) fn ledger(&self) -> &crate::energy::Ledger {
        &self.system.ledger
    }

    /// Steps done.
    pub(crate) fn steps(&self) -> u64 {
        self.system.step
    }

    /// Elements of all parts.
    pub(crate) fn elements(&self) -> usize {
        self.system.mesh.groups.iter().map(crate::mesh::ElementGroup::elements).sum()
    }

    /// Steps until `time` is reached (never beyond the end), at most `steps` of them.
    ///
    /// # Errors
    /// Those of a step.
    pub(crate) fn advance(&mut self, time: f64, steps: u64) -> Result<(), Error> {
        let result = self.continue_run(time, steps, false);
        self.note_momentum();
        result
    }

    /// Steps as [`Run::advance`] does; `pauses`: at most to the end of the stage.
    fn continue_run(&mut self, time: f64, steps: u64, pauses: bool) -> Result<(), Error> {
        let last = self.system.step.saturating_add(steps).min(self.max_steps);
        loop {
            self.take_steps(time, last, pauses)?;
            let is_over = self.system.time >= time.min(self.system.limits.end) || self.system.step >= last;
            if is_over || !self.is_remeshing_due() {
                return Ok(());
            }
            self.remesh()?;
        }
    }

    /// Steps to a time, to the step `last`, or until elements are to be looked at.
    fn take_steps(&mut self, time: f64, last: u64, pauses: bool) -> Result<(), Error> {
        let Self { shortest, tracer, recorded, hashing, remesher, .. } = self;
        let remesher = remesher.as_ref();
        let mut tracer = tracer.as_mut();
        within_pool(self.pool.as_ref(), &mut self.system, |system| {
            // Before the step that follows, so that what is reported of this one is of the old elements.
            while system.time < time
                && system.time < system.limits.end
                && system.step < last
                && !remesher.is_some_and(|own| own.is_due(system.step))
            {
                let stepped = system.step();
                if stepped.as_ref().err().is_none_or(Error::is_of_complete_step) {
                    recorded.note(system);
                }
                if let Some(tracer) = &mut tracer {
                    tracer.note(system, recorded, stepped.as_ref().err());
                }
                stepped?;
                shortest.note(system);
                hashing.note(system);
                if pauses && system.is_stage_over() {
                    break;
                }
            }
            Ok(())
        })
    }

    /// Whether the run has come to its end.
    pub(crate) fn is_over(&self) -> bool {
        self.system.time >= self.system.limits.end || self.system.step >= self.max_steps
    }

    /// Runs until the time `pause` is reached (s), at most `steps` steps or to the end, telling `observer` of
    /// rows, frames and progress. What was begun so, or was stopped, or is of a kept state
    /// ([`Simulation::resumed`]) continues as if it had never been stopped: it reports nothing twice.
    ///
    /// # Errors
    /// Any [`Error`]; the last state has been given to the observer before.
    pub(crate) fn run(&mut self, pause: f64, steps: u64, observer: &mut dyn Observer) -> Result<(), Error> {
        let last = self.system.step.saturating_add(steps);
        let (mut rows, mut frames) = self.clocks();
        let mut stage = self.system.stage();
        let state_steps = self.state_steps.filter(|_| observer.keeps_states());
        let mut output_cursor = self.output_cursor.take().unwrap_or_else(|| OutputCursor::new(self.system.step));
        if output_cursor.is_resumed {
            // What was due until now has been reported.
            rows.pass(self.system.time);
            frames.pass(self.system.time);
        }
        self.hashing = Hashing::new(&self.system, self.hash_steps.filter(|_| observer.keeps_hashes()));
        if output_cursor.is_resumed {
            self.hashing.pass(self.system.step);
        } else {
            self.hashing.take(&self.system);
        }
        loop {
            // Whatever follows, a state too, is of the present cells.
            self.report_cells(observer)?;
            if std::mem::replace(&mut stage, self.system.stage()) != self.system.stage() {
                (rows, frames) = self.clocks();
            }
            let time = self.system.time;
            let over = self.is_over();
            // The last state of a stage is shown as that of the run.
            let ends = over || self.system.is_stage_over();
            if over {
                self.hashing.take(&self.system);
            }
            self.report_hashes(observer)?;
            if (rows.due(time) || ends) && time > output_cursor.last_row {
                self.note_momentum();
                self.report_row(observer)?;
                output_cursor.last_row = time;
            }
            if self.shows() && (frames.due(time) || ends) && output_cursor.last_frame != Some(self.system.step) {
                self.show(observer)?;
                output_cursor.last_frame = Some(self.system.step);
            }
            // A stop for the state alone sees nothing.
            let notices = if ends || output_cursor.stretch == self.system.step {
                self.monitor.look(&self.system, &self.shortest, &self.recorded.pushing(&self.system), over)
            } else {
                Vec::new()
            };
            if over {
                self.pause(output_cursor);
                return Ok(());
            }
            if output_cursor.stretch == self.system.step && self.memory.is_due(self.system.step) {
                self.output_cursor = Some(output_cursor);
                let state = self.state()?;
                self.memory.take(state);
            }
            if observer.wants_glance() {
                observer.glance(&self.recorded.snapshot(&self.system));
            }
            let control = observer.progress(&self.progress(self.system.limits.end, &self.system.governor_in_words(), &notices));
            if matches!(control, Control::Keep | Control::KeepAndStop) || output_cursor.is_state_due(self.system.step, state_steps) {
                output_cursor.last_state = Some(self.system.step);
                self.output_cursor = Some(output_cursor);
                let state = self.state()?;
                observer.state(state).map_err(output)?;
            }
            if matches!(control, Control::Stop | Control::KeepAndStop) {
                if self.shows() && output_cursor.last_frame != Some(self.system.step) {
                    self.show(observer)?;
                }
                self.pause(output_cursor);
                return Ok(());
            }
            if self.system.time >= pause || self.system.step >= last {
                self.pause(output_cursor);
                return Ok(());
            }
            let until = if self.shows() { rows.next().min(frames.next()) } else { rows.next() };
            let stretch = output_cursor.steps(self.system.step, state_steps).min(last - self.system.step).min(observer.stride().max(1));
            // Rows of the next stage are due at other times.
            let stretch = if ends { 1 } else { stretch };
            let result = self.continue_run(until.min(pause), stretch, true);
            // A stop for the state alone leaves no trace.
            if result.is_err()
                || self.system.time >= until
                || self.is_over()
                || self.system.is_stage_over()
                || output_cursor.is_stretch(self.system.step)
            {
                self.note_momentum();
                output_cursor.stretch = self.system.step;
            }
            if let Err(error) = result {
                self.report_hashes(observer)?;
                observer.failing();
                // The state of the failure is what the user needs to see, and what was to be seen of it
                // before.
                self.monitor.look(&self.system, &self.shortest, &self.recorded.pushing(&self.system), true);
                if self.system.time > output_cursor.last_row {
                    self.report_row(observer)?;
                }
                if self.shows() {
                    self.show(observer)?;
                }
                return Err(error);
            }
        }
    }

    /// When rows and frames of the present stage are due.
    fn clocks(&self) -> (Clock, Clock) {
        let span = self.system.stage_span();
        (Clock::new(self.history, span), Clock::new(self.fields, span))
    }

    /// Whether fields are wanted.
    fn shows(&self) -> bool {
        self.fields != Cadence::Count(0)
    }

    /// Lets the run continue later where it is.
    fn pause(&mut self, output_cursor: OutputCursor) {
        self.output_cursor = Some(OutputCursor { is_resumed: true, ..output_cursor });
    }

    /// Hashes of the state now.
    pub(crate) fn hashes(&self) -> Hashes {
        let nodes: Vec<_> = (0..self.system.mesh.parts.len()).map(|part| hashes::nodes(&self.system, part)).collect();
        hashes::hashes(&self.system, &nodes)
    }

    /// Runs on, and reports `observer` of a row and a frame at the first step at or after `from`, from there
    /// every `every`, and at the first step at or after `to`, all in s. The steps are those of any run of the
    /// model.
    ///
    /// # Errors
    /// As [`Simulation::run`].
    pub(crate) fn run_window(&mut self, [from, to]: [f64; 2], every: f64, observer: &mut dyn Observer) -> Result<(), Error> {
        let mut outputs = Clock::new(Cadence::Interval(every), [0.0, to]);
        loop {
            let time = self.system.time;
            let over = self.is_over() || time >= to * (1.0 - 1e-12);
            if (time >= from * (1.0 - 1e-12) && outputs.due(time - from)) || over {
                self.report_row(observer)?;
                self.show(observer)?;
            }
            let governor = self.system.governor_in_words();
            if over || matches!(observer.progress(&self.progress(to, &governor, &[])), Control::Stop | Control::KeepAndStop) {
                return Ok(());
            }
            let until = (from + outputs.next()).min(to);
            if let Err(error) = self.advance(until * (1.0 - 1e-12), PROGRESS) {
                self.report_row(observer)?;
                self.show(observer)?;
                return Err(error);
            }
        }
    }

    fn progress<'a>(&self, end: f64, governor: &'a str, notices: &'a [Notice]) -> Progress<'a> {
        let Self { system, .. } = self;
        Progress {
            step: system.step,
            time: system.time,
            end,
            time_step: system.time_step,
            governor,
            energy_drift: system.ledger.drift(),
            notices,
        }
    }

    /// Gives the cells to an observer, if they are others than those that it knows.
    fn report_cells(&mut self, observer: &mut dyn Observer) -> Result<(), Error> {
        let revision = self.system.mesh.revision;
        if std::mem::replace(&mut self.known_cells, revision) == revision {
            return Ok(());
        }
        observer.cells(self.cells()).map_err(output)
    }

    /// Gives the state now to an observer.
    fn show(&mut self, observer: &mut dyn Observer) -> Result<(), Error> {
        self.report_cells(observer)?;
        observer.show(&self.recorded.snapshot(&self.system)).map_err(output)
    }

    fn report_hashes(&mut self, observer: &mut dyn Observer) -> Result<(), Error> {
        self.hashing.taken.drain(..).try_for_each(|hashes| observer.hashes(hashes)).map_err(output)
    }

    fn note_momentum(&mut self) {
        if let Some(momentum) = &mut self.momentum {
            momentum.note(&self.system);
        }
    }

    /// The cells of all parts.
    pub(crate) fn cells(&self) -> Cells {
        crate::record::cells(&self.system)
    }

    /// The state now.
    pub(crate) fn frame(&self) -> Frame {
        let mut frame = Frame::default();
        self.recorded.snapshot(&self.system).fill(&mut frame);
        frame
    }

    /// Where the model's mesh files are, with the user's numbers of their nodes.
    pub(crate) fn placed(&self) -> &[PlacedMesh] {
        &self.system.mesh.placed
    }

    /// A field now, whether the model asks for it or not; `None`: there is none of this name.
    pub(crate) fn field(&self, name: &str) -> Option<Field> {
        let kind = fields_of(D).iter().find(|kind| kind.name == name)?;
        let kinds = [kind];
        let snapshot = LiveSnapshot::new(&self.system, &kinds);
        let mut values = Vec::new();
        snapshot.values(0, 0..snapshot.numbers(0) / kind.width(), &mut values);
        Some(Field { kind, values })
    }

    /// Positions of all nodes now, m, one after the other, in the user's order.
    pub(crate) fn coordinates(&self) -> Vec<f64> {
        let snapshot = LiveSnapshot::new(&self.system, &[]);
        let mut values = Vec::new();
        snapshot.coordinates(0..snapshot.nodes(), &mut values);
        values
    }

    /// Names of the history's columns; the first is `time`.
    pub(crate) fn history_columns(&self) -> Vec<String> {
        self.recorded.columns()
    }

    /// Values of the history's columns now.
    pub(crate) fn history_row(&self) -> Vec<f64> {
        self.recorded.samples(&self.system)
    }

    /// Gives the row of the interval that ends now to an observer.
    fn report_row(&mut self, observer: &mut dyn Observer) -> Result<(), Error> {
        let row = self.recorded.take_row(&self.system);
        observer.row(&row).map_err(output)
    }

    /// What the stable step costs.
    pub(crate) fn time_step_costs(&self, most: usize) -> TimeStepCosts {
        time_step_costs::of(&self.system, most)
    }

    /// Parts, masses, step, penetrations.
    pub(crate) fn overview(&self) -> Overview {
        let system = &self.system;
        Overview {
            parts: self.known_parts.overview(system),
            stable_time_step: system.time_step,
            governor: system.governor_in_words(),
            governor_at: system.governor_place().map(model::in_3d),
            steps_expected: (system.limits.end / system.time_step).ceil() as u64,
            initial_penetrations: self.system.initial_penetrations.clone(),
            contacts: self.contact_lines.clone(),
            probes: self.recorded.probe_lines(),
            warnings: self.warnings.clone(),
        }
    }
}

/// Runs `work` on the system inside the thread pool, so that parallel loops in it start without a detour.
fn within_pool<const D: usize>(
    pool: Option<&rayon::ThreadPool>,
    system: &mut System<D>,
    work: impl FnOnce(&mut System<D>) -> Result<(), Error> + Send,
) -> Result<(), Error>
where
    Dim<D>: Runs<D>,
{
    match pool {
        Some(pool) => pool.install(|| work(system)),
        None => work(system),
    }
}

/// What keeps an observer from continuing, as the error of a run.
fn output(error: ObserverError) -> Error {
    Error::Output(error.to_string())
}

fn search_name(contact: &model::Contact) -> String {
    if contact.search.is_empty() { search::registry::<2>()[0].name.into() } else { contact.search.clone() }
}
