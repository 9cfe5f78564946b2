//! Simulations: a model in 2D or 3D that is stepped, behind one interface. It reports to an [`Observer`]; the
//! loop is in `simulation/run.rs`, written once for both dimensions.

mod clock;
mod contact_pairs;
mod few;
mod output_cursor;
mod memory;
mod parts;
mod part_meshes;
mod remesh;
pub(crate) mod run;
mod state;
mod steering;
mod summary;
mod time_step_costs;
mod tiny;

pub use part_meshes::PartMeshed;
pub use state::State;
pub use time_step_costs::{CostlyElement, TimeStepCosts};

use crate::archive::Section;
use crate::body_columns::BodyColumns;
use crate::build::Builds;
use crate::contact::tracker::SearchReport;
use crate::error::{Error, Fault, Notice, Warning};
use crate::field::NodeFields;
use crate::hashes::Hashes;
use crate::mesh::PlacedMesh;
use crate::model::{ImportedMesh, Model};
use crate::output::{Cells, Field, Frame, Remeshing, Shown, Summary};
use embate_lanes::Level;
use remesh::Remeshes;
use run::Run;

/// What a run asks of a dimension: all that its system does, and what builds and records it.
pub trait Runs<const D: usize>: Builds<D> + BodyColumns<D> + NodeFields<D> + Remeshes<D> {}

impl<T: Builds<D> + BodyColumns<D> + NodeFields<D> + Remeshes<D>, const D: usize> Runs<D> for T {}

/// How a simulation is run; changes no result.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// Threads; 0: one per processor.
    pub threads: usize,
    /// Instruction set by name: `scalar`, `avx2`, `avx512`; `None`: the best that the machine has.
    pub simd: Option<String>,
}

impl Options {
    /// How many threads that is on this machine.
    #[must_use]
    pub fn thread_count(&self) -> usize {
        match self.threads {
            0 => std::thread::available_parallelism().map_or(1, usize::from),
            threads => threads,
        }
    }

    /// Whether this machine has an instruction set of this name.
    #[must_use]
    pub fn has(simd: &str) -> bool {
        Level::named(simd).is_some()
    }
}

/// What a progress display shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Progress<'a> {
    /// Steps done.
    pub step: u64,
    /// Time reached, s.
    pub time: f64,
    /// End time, s.
    pub end: f64,
    /// Time step, s.
    pub time_step: f64,
    /// What governs the time step.
    pub governor: &'a str,
    /// Energy drift so far, fraction of the largest total energy.
    pub energy_drift: f64,
    /// What is new since the last call that the user should know at once; the summary has all of it.
    pub notices: &'a [Notice],
}

/// Whether a run continues.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// Continue.
    Continue,
    /// Continue, with the state handed out.
    Keep,
    /// Stop here, cleanly, with the state handed out.
    KeepAndStop,
    /// Stop here, cleanly.
    Stop,
}

/// Error of an observer: a disk that is full, for example.
pub type ObserverError = Box<dyn std::error::Error + Send + Sync>;

/// Who listens to a run.
pub trait Observer {
    /// A frame that the observer is done with: its buffers are filled for the next one. An empty frame will
    /// do.
    fn spare(&mut self) -> Frame {
        Frame::default()
    }
    /// A frame at an output time; the first at time zero, the last at the end (also of a failed run).
    ///
    /// # Errors
    /// Whatever keeps the observer from taking it; it ends the run.
    fn frame(&mut self, frame: Frame) -> Result<(), ObserverError>;
    /// The state at an output time, to be taken piece by piece; who does not do so gets it as a frame.
    ///
    /// # Errors
    /// As [`Observer::frame`].
    fn show(&mut self, shown: &dyn Shown) -> Result<(), ObserverError> {
        let mut frame = self.spare();
        shown.fill(&mut frame);
        self.frame(frame)
    }
    /// From here on frames are of these cells: what was meshed again has others than
    /// [`Simulation::cells`] returned before.
    ///
    /// # Errors
    /// As [`Observer::frame`].
    fn cells(&mut self, _cells: Cells) -> Result<(), ObserverError> {
        Ok(())
    }
    /// A row of the history, one value per column of [`Simulation::history_columns`].
    ///
    /// # Errors
    /// As [`Observer::frame`].
    fn row(&mut self, row: &[f64]) -> Result<(), ObserverError>;
    /// Whether it takes states that are due by `run.checkpoint_steps`.
    fn keeps_states(&self) -> bool {
        false
    }
    /// The state of the run: asked for by [`Control::Keep`], or due by `run.checkpoint_steps`. Rows and
    /// frames of the steps until then have been reported, and no others.
    ///
    /// # Errors
    /// As [`Observer::frame`].
    fn state(&mut self, _state: State) -> Result<(), ObserverError> {
        Ok(())
    }
    /// Whether it takes hashes that are due by `output.hash_steps`.
    fn keeps_hashes(&self) -> bool {
        false
    }
    /// Hashes of the first state, of those that are due, and of the one at the end; reported before anything
    /// else of a later step.
    ///
    /// # Errors
    /// As [`Observer::frame`].
    fn hashes(&mut self, _hashes: Hashes) -> Result<(), ObserverError> {
        Ok(())
    }
    /// The run has failed: the row and the frame that follow show the state of the failure.
    fn failing(&mut self) {}
    /// Whether it wants to see the state now, between two output times; asked before each
    /// [`Observer::progress`].
    fn wants_glance(&mut self) -> bool {
        false
    }
    /// The state now, because it was wanted. The run waits meanwhile, and its results are the same however
    /// long that is.
    fn glance(&mut self, _shown: &dyn Shown) {}
    /// Steps after which it wants to be asked again at the latest.
    fn stride(&self) -> u64 {
        u64::MAX
    }
    /// Called every few hundred steps, and after [`Observer::stride`] at the latest.
    fn progress(&mut self, progress: &Progress<'_>) -> Control;
}

/// What `embate check` reports of a part.
#[derive(Clone, Debug, PartialEq)]
pub struct PartOverview {
    /// Name.
    pub name: String,
    /// Number of elements.
    pub elements: usize,
    /// How many there are of each kind.
    pub kinds: Vec<(&'static str, usize)>,
    /// Number of nodes.
    pub nodes: usize,
    /// Mass per metre of depth, kg/m.
    pub mass: f64,
    /// Sides of the box around it along x, y and, in 3D, z, m.
    pub size: Vec<f64>,
    /// Speed of the fastest waves in its material at rest, √((K + 4µ/3)/ρ), m/s.
    pub wave_speed: f64,
    /// Whether it is rigid: then its elements set no step.
    pub is_rigid: bool,
    /// Stable step of its elements, s.
    pub stable_time_step: f64,
    /// Whether one of its elements governs the first step.
    pub governs: bool,
}

/// What `embate check` reports of a model.
#[derive(Clone, Debug, PartialEq)]
pub struct Overview {
    /// Parts in model order.
    pub parts: Vec<PartOverview>,
    /// First time step, safety included, s.
    pub stable_time_step: f64,
    /// What governs it.
    pub governor: String,
    /// Where the element is that governs it, m; `None`: it is not one element.
    pub governor_at: Option<[f64; 3]>,
    /// End time over first time step.
    pub steps_expected: u64,
    /// Initial penetrations, one line each: contact, node, place, depth.
    pub initial_penetrations: Vec<String>,
    /// Contacts of bodies of which some are tied or joined besides, one line each.
    pub contacts: Vec<String>,
    /// Probes, one line each: which node, its place, its distance from the wanted point.
    pub probes: Vec<String>,
    /// Things the user should know besides [`Simulation::model_warnings`].
    pub warnings: Vec<Notice>,
}

/// What the global search of a contact did.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactSearch {
    /// Name of the contact.
    pub contact: String,
    /// Name of the search.
    pub search: String,
    /// Skin, searches, steps, candidates.
    pub report: SearchReport,
    /// Pairs whose paths were checked for crossing, over all steps.
    pub pairs_swept: u64,
}

/// A simulation: a model in 2D or 3D, made ready to step.
pub struct Simulation(pub(crate) Either);

/// The dimension of a simulation.
pub(crate) enum Either {
    Plane(Box<Run<2>>),
    Space(Box<Run<3>>),
}

/// What a simulation does whatever its dimension.
macro_rules! either {
    ($simulation:expr, $run:ident => $what:expr) => {
        match &$simulation.0 {
            Either::Plane($run) => $what,
            Either::Space($run) => $what,
        }
    };
    (mut $simulation:expr, $run:ident => $what:expr) => {
        match &mut $simulation.0 {
            Either::Plane($run) => $what,
            Either::Space($run) => $what,
        }
    };
}
pub(crate) use either;

impl Simulation {
    /// A model of fewer elements runs on one thread, whatever was asked for: more would cost more than they
    /// bring.
    pub const THREADS_FROM: usize = crate::build::SERIAL;

    /// Makes a model ready: everything at time zero is known, velocities are those of the first half step.
    ///
    /// # Errors
    /// [`Error::Model`] with all faults; the errors of a step, if the very first forces fail.
    pub fn new(model: &Model, options: &Options) -> Result<Self, Error> {
        Self::made(model, options, None)
    }

    /// In the dimension of its model; in a state, if one is given.
    fn made(model: &Model, options: &Options, state: Option<&[Section]>) -> Result<Self, Error> {
        Ok(Self(if model.dimension() == 3 {
            Either::Space(Box::new(Run::made(model, options, state)?))
        } else {
            Either::Plane(Box::new(Run::made(model, options, state)?))
        }))
    }

    /// A simulation of a model that stands where another one of the same model stood: what it does from there
    /// on is the same to the last bit, whatever the options of both. The model may differ in when it ends, in
    /// its limits, and in what it reports.
    ///
    /// # Errors
    /// Those of [`Simulation::new`]; [`Error::State`] where the state is of another model.
    pub fn resumed(model: &Model, options: &Options, sections: &[Section]) -> Result<Self, Error> {
        Self::made(model, options, Some(sections))
    }

    /// Components of a position: 2 in 2D, 3 in 3D.
    #[must_use]
    pub fn dimension(&self) -> usize {
        match &self.0 {
            Either::Plane(_) => 2,
            Either::Space(_) => 3,
        }
    }

    /// Threads that it runs on; changes no result.
    #[must_use]
    pub fn threads(&self) -> usize {
        either!(self, run => run.threads)
    }

    /// What its parts are made of, as they were meshed; `model`: the one it was made from.
    #[must_use]
    pub fn part_meshes(&self, model: &Model) -> Vec<PartMeshed> {
        either!(self, run => part_meshes::of(&run.system, model))
    }

    /// Lets the run keep states in memory, in so many bytes for all of them together: see
    /// [`Simulation::states`].
    pub fn keep_states_in(&mut self, bytes: usize) {
        either!(mut self, run => run.keep_states_in(bytes))
    }

    /// States of the run so far that are in memory, the newest first; none where they are too large for their
    /// room.
    #[must_use]
    pub fn states(&self) -> &[State] {
        either!(self, run => run.states())
    }

    /// What the user should know of the model: it was accepted. [`Simulation::summary`] has them as texts,
    /// with those of the run.
    #[must_use]
    pub fn model_warnings(&self) -> &[Warning] {
        either!(self, run => run.model_warnings())
    }

    /// Time reached, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        either!(self, run => run.time())
    }

    /// Step that leads to the next state, s.
    #[must_use]
    pub fn time_step(&self) -> f64 {
        either!(self, run => run.time_step())
    }

    /// Most sweeps over the contact springs that a step took, and steps whose forces were not solved to the
    /// last digit.
    #[must_use]
    pub fn sweeps(&self) -> (usize, u64) {
        either!(self, run => run.sweeps())
    }

    /// Energies and works so far.
    #[must_use]
    pub fn ledger(&self) -> &crate::energy::Ledger {
        either!(self, run => run.ledger())
    }

    /// Steps done.
    #[must_use]
    pub fn steps(&self) -> u64 {
        either!(self, run => run.steps())
    }

    /// Elements of all parts.
    #[must_use]
    pub fn elements(&self) -> usize {
        either!(self, run => run.elements())
    }

    /// Steps until `time` is reached (never beyond the end), at most `steps` of them.
    ///
    /// # Errors
    /// Those of a step.
    pub fn advance(&mut self, time: f64, steps: u64) -> Result<(), Error> {
        either!(mut self, run => run.advance(time, steps))
    }

    /// Whether the run has come to its end.
    #[must_use]
    pub fn is_over(&self) -> bool {
        either!(self, run => run.is_over())
    }

    /// Runs to the end, telling `observer` of rows, frames and progress. A simulation of a kept state
    /// ([`Simulation::resumed`]) continues as if it had never been stopped.
    ///
    /// # Errors
    /// Any [`Error`]; the last state has been given to the observer before.
    pub fn run(&mut self, observer: &mut dyn Observer) -> Result<(), Error> {
        self.run_until(f64::INFINITY, u64::MAX, observer)
    }

    /// The same until `time` is reached (s), and at most `steps` steps. A run in pieces, with whatever was
    /// asked in between, reports `observer` the same as one that was never stopped, and its bits are the
    /// same.
    ///
    /// # Errors
    /// As [`Simulation::run`].
    pub fn run_until(&mut self, time: f64, steps: u64, observer: &mut dyn Observer) -> Result<(), Error> {
        either!(mut self, run => run.run(time, steps, observer))
    }

    /// The run continues with a mesh of the caller's for a part: the elements of its `group`, or of its only
    /// group, or of that of the part's name, in the form and place that the part has now, m. Stresses, what
    /// laws remember and velocities go over to it as with `[[remesh]]`; the element of each kind of cell is
    /// that of the part. `model`: the one it was made from.
    ///
    /// # Errors
    /// [`Error::Model`] with the reasons; the run stands where it stood.
    pub fn exchange(&mut self, model: &Model, part: &str, mesh: ImportedMesh, group: Option<&str>) -> Result<Remeshing, Error> {
        either!(mut self, run => run.exchange(model, part, mesh, group))
    }

    /// What is reported from here on is the beginning of something new: first the state as it is now.
    pub fn begin_reports(&mut self) {
        either!(mut self, run => run.begin_reports());
    }

    /// Nodes of a part, of a side of it or of a group, by their numbers in frames, ascending; `None` where
    /// there is nothing of this name.
    #[must_use]
    pub fn nodes_of(&self, name: &str) -> Option<Vec<u32>> {
        either!(self, run => run.nodes_of(name))
    }

    /// Gives nodes, by their numbers in frames, other velocities at the present time, m/s, one node after the
    /// other: what is held continues as prescribed. The change is entered as work from outside.
    ///
    /// # Errors
    /// Nodes that are not there, of rigid parts or joined to others, and numbers that are not finite or too
    /// few; then nothing has changed.
    pub fn set_velocities(&mut self, nodes: &[u32], velocities: &[f64]) -> Result<(), Fault> {
        either!(mut self, run => run.set_velocities(nodes, velocities))
    }

    /// Lets forces (in 2D N per metre of depth, in 3D and of axisymmetric bodies N), one node
    /// after the other, act on nodes besides the loads of the model, from the next velocity update on until
    /// others are given; zero ends them. Their work is entered as that of loads.
    ///
    /// # Errors
    /// Nodes that are not there, and numbers that are not finite or too few; then nothing has changed.
    pub fn set_forces(&mut self, nodes: &[u32], forces: &[f64]) -> Result<(), Fault> {
        either!(mut self, run => run.set_forces(nodes, forces))
    }

    /// Lets a curve of the model run, from the end of the coming step on, in a straight line to another
    /// value, which it has from the time `end` on (s; `None`: it jumps) and keeps: the loads, prescribed
    /// motions and obstacles that follow it are driven by the program then. Works are entered as of any
    /// curve.
    ///
    /// # Errors
    /// A curve that is not there, a value that is not finite, a time that has passed; then nothing has
    /// changed.
    pub fn set_curve(&mut self, name: &str, value: f64, end: Option<f64>) -> Result<(), Fault> {
        either!(mut self, run => run.set_curve(name, value, end))
    }

    /// Value of a curve of the model from the end of the coming step on; `None`: there is none of this name.
    #[must_use]
    pub fn curve(&self, name: &str) -> Option<f64> {
        either!(self, run => run.curve(name))
    }

    /// Hashes of the state now.
    #[must_use]
    pub fn hashes(&self) -> Hashes {
        either!(self, run => run.hashes())
    }

    /// Runs on, and reports `observer` of a row and a frame at the first step at or after `from`, from there
    /// every `every`, and at the first step at or after `to`, all in s. The steps are those of any run of the
    /// model.
    ///
    /// # Errors
    /// As [`Simulation::run`].
    pub fn run_window(&mut self, window: [f64; 2], every: f64, observer: &mut dyn Observer) -> Result<(), Error> {
        either!(mut self, run => run.run_window(window, every, observer))
    }

    /// The cells of all parts.
    #[must_use]
    pub fn cells(&self) -> Cells {
        either!(self, run => run.cells())
    }

    /// The state now.
    #[must_use]
    pub fn frame(&self) -> Frame {
        either!(self, run => run.frame())
    }

    /// Where the model's meshes from files are, with the numbers that their nodes have among those of a
    /// [`Frame`].
    #[must_use]
    pub fn placed(&self) -> &[PlacedMesh] {
        either!(self, run => run.placed())
    }

    /// A field now by its name in [`crate::output::FIELDS`], whether the model asks for it or not; `None`:
    /// there is none of this name.
    #[must_use]
    pub fn field(&self, name: &str) -> Option<Field> {
        either!(self, run => run.field(name))
    }

    /// Positions of all nodes now, m, one after the other, in the order of a [`Frame`].
    #[must_use]
    pub fn coordinates(&self) -> Vec<f64> {
        either!(self, run => run.coordinates())
    }

    /// Names of the history's columns; the first is `time`.
    #[must_use]
    pub fn history_columns(&self) -> Vec<String> {
        either!(self, run => run.history_columns())
    }

    /// Values of the history's columns now.
    #[must_use]
    pub fn history_row(&self) -> Vec<f64> {
        either!(self, run => run.history_row())
    }

    /// The `most` elements with the shortest stable steps, what the first step would be without them, and by
    /// nodes; before the first step.
    #[must_use]
    pub fn time_step_costs(&self, most: usize) -> TimeStepCosts {
        either!(self, run => run.time_step_costs(most))
    }

    /// Parts, masses, step, penetrations.
    #[must_use]
    pub fn overview(&self) -> Overview {
        either!(self, run => run.overview())
    }

    /// The state now, between two steps.
    ///
    /// # Errors
    /// None that a state which is there can have; what is written is checked as what is read.
    pub fn state(&mut self) -> Result<State, Error> {
        either!(mut self, run => run.state())
    }

    /// What the global search of each contact between surfaces did so far.
    #[must_use]
    pub fn searches(&self) -> Vec<ContactSearch> {
        either!(self, run => run.searches())
    }

    /// Figures of the run so far (valid after a failure too).
    #[must_use]
    pub fn summary(&self) -> Summary {
        either!(self, run => run.summary())
    }
}
