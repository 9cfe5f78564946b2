//! The loop: steps, events, the end. Made from a model; speaks to an [`Observer`].

use crate::error::Error;
use crate::model::Model;
use crate::output::{Cells, Frame, Summary};

/// How a simulation is run; changes no result.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// Threads; 0: one per processor.
    pub threads: usize,
    /// Instruction set by name: `scalar`, `avx2`, `avx512`; `None`: the best that the machine has.
    pub simd: Option<String>,
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
}

/// Whether a run goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// Go on.
    Continue,
    /// Stop here, cleanly.
    Stop,
}

/// Error of an observer: a disk that is full, for example.
pub type ObserverError = Box<dyn std::error::Error + Send + Sync>;

/// Who listens to a run.
pub trait Observer {
    /// A frame at an output time; the first at time zero, the last at the end (also of a failed run).
    ///
    /// # Errors
    /// Whatever keeps the observer from taking it; it ends the run.
    fn frame(&mut self, frame: &Frame<2>) -> Result<(), ObserverError>;
    /// A row of the history, one value per column of [`Simulation::history_columns`].
    ///
    /// # Errors
    /// As [`Observer::frame`].
    fn row(&mut self, row: &[f64]) -> Result<(), ObserverError>;
    /// Called every few hundred steps.
    fn progress(&mut self, progress: &Progress<'_>) -> Control;
}

/// What `embate check` tells of a part.
#[derive(Clone, Debug, PartialEq)]
pub struct PartOverview {
    /// Name.
    pub name: String,
    /// Number of elements.
    pub elements: usize,
    /// Number of nodes.
    pub nodes: usize,
    /// Mass per metre of depth, kg/m.
    pub mass: f64,
    /// Stable step of its elements, s.
    pub stable_time_step: f64,
}

/// What `embate check` tells of a model.
#[derive(Clone, Debug, PartialEq)]
pub struct Overview {
    /// Parts in model order.
    pub parts: Vec<PartOverview>,
    /// First time step, safety included, s.
    pub stable_time_step: f64,
    /// What governs it.
    pub governor: String,
    /// End time over first time step.
    pub steps_expected: u64,
    /// Initial penetrations, one line each: contact, node, place, depth.
    pub initial_penetrations: Vec<String>,
    /// Probes, one line each: which node, its place, its distance from the wanted point.
    pub probes: Vec<String>,
    /// Things the user should know.
    pub warnings: Vec<String>,
}

/// A simulation: a model made ready to step.
pub struct Simulation {}

impl Simulation {
    /// Makes a model ready.
    ///
    /// # Errors
    /// [`Error::Model`] with all faults.
    pub fn new(_model: &Model, _options: &Options) -> Result<Self, Error> {
        Err(Error::Model(Vec::new()))
    }
    /// Names of the history's columns; the first is `time`.
    #[must_use]
    pub fn history_columns(&self) -> Vec<String> {
        Vec::new()
    }
    /// The cells of all parts.
    #[must_use]
    pub fn cells(&self) -> Cells {
        Cells::default()
    }
    /// The state now.
    #[must_use]
    pub fn frame(&self) -> Frame<2> {
        Frame { time: 0.0, step: 0, positions: Vec::new(), fields: Vec::new() }
    }
    /// Parts, masses, step, penetrations.
    #[must_use]
    pub fn overview(&self) -> Overview {
        Overview {
            parts: vec![],
            stable_time_step: 0.0,
            governor: String::new(),
            steps_expected: 0,
            initial_penetrations: vec![],
            probes: vec![],
            warnings: vec![],
        }
    }
    /// Runs to the end.
    ///
    /// # Errors
    /// Any [`Error`]; the last good state has been given to the observer before.
    pub fn run(&mut self, _observer: &mut dyn Observer) -> Result<(), Error> {
        Ok(())
    }
    /// Figures of the run so far (valid after a failure too).
    #[must_use]
    pub fn summary(&self) -> Summary {
        Summary {
            elements: 0,
            nodes: 0,
            steps: 0,
            time_end: 0.0,
            stable_time_step_min: 0.0,
            stable_time_step_governor: String::new(),
            energy_drift: 0.0,
            ledger_residual: 0.0,
            momentum_drift_linear: None,
            momentum_drift_angular: None,
            penetration_max: 0.0,
            state_hash: String::new(),
            threads: 1,
            simd: String::new(),
            warnings: vec![],
        }
    }
}
