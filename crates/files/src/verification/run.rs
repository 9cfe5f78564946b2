//! Runs the models of a case and keeps what its checks look at: the history, some frames, the summary.
//!
//! Models come from `read.rs`. Nothing is written unless a folder is given: then the results lie there as
//! after `embate run`. What was kept goes to `quantity.rs`.

use super::case::{Case, Quantity, Source};
use super::quantity::Samples;
use crate::model_file::{Diagnostics, Faults};
use crate::results::{Recorder, Report, ResultFolder, ResultsError};
use crate::verification::messages::QUANTITY;
use embate_solver::error::Error;
use embate_solver::model::Model;
use embate_solver::output::{Cells, Frame};
use embate_solver::simulation::{Control, Observer, ObserverError, Options, Progress, Simulation};
use std::path::Path;
use thiserror::Error as ThisError;

/// Why a case could not be run to its verdicts; a run that fails is no such thing, but a check that fails.
#[derive(Debug, ThisError)]
pub enum VerifyError {
    /// `expected.toml` does not fit its models: a column, a field, a part or a time that is not there.
    #[error("{0}")]
    Expected(Diagnostics),
    /// A model can't be made ready.
    #[error("model `{name}` of the case `{case}`")]
    Model {
        /// The case.
        case: String,
        /// The model.
        name: String,
        /// What is wrong with it.
        #[source]
        error: Error,
    },
    /// Results can't be written.
    #[error(transparent)]
    Results(#[from] ResultsError),
}

/// What happened to a model of a case.
#[derive(Debug)]
pub(super) struct ModelRun {
    pub(super) samples: Samples,
    /// Why it did not reach its end.
    pub(super) error: Option<String>,
}

impl Case {
    fn simulation(&self, name: &str, model: &Model, options: &Options) -> Result<Simulation, VerifyError> {
        Simulation::new(model, options).map_err(|error| VerifyError::Model { case: self.name.clone(), name: name.to_string(), error })
    }

    /// Looks whether every quantity is there before anything is run: columns, fields, parts, keys of the
    /// summary, times.
    ///
    /// # Errors
    /// All quantities of `expected.toml` that are not there; a model that can't be made ready.
    pub fn examine(&self, options: &Options) -> Result<(), VerifyError> {
        let mut faults = Faults::default();
        for (name, model) in &self.models {
            let simulation = self.simulation(name, model, options)?;
            let mut samples = Samples::new(&simulation, Vec::new());
            samples.summary = Report::of(&simulation.summary(), &model.name, &[]).value();
            for quantity in self.quantities(name) {
                if let Err((key, message, help)) = samples.examine(&quantity.source, model.run.end) {
                    let path = format!("{}.{key}", quantity.path);
                    if !faults.covers(&path) {
                        faults.beside(&QUANTITY, &path, None, (format!("{message} (model `{name}`)"), help));
                        faults.cover(&path);
                    }
                }
            }
        }
        if faults.is_empty() { Ok(()) } else { Err(VerifyError::Expected(self.text.reported(faults))) }
    }

    /// The quantities that look at a model.
    fn quantities<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Quantity> {
        self.checks.iter().flat_map(move |check| {
            let named = check.models.iter().any(|model| model == name);
            let coarser = check.coarser() == Some(name);
            let own = (named || coarser).then_some(&check.quantity);
            let other = check.with.as_ref().filter(|with| with.model.as_ref().map_or(named || coarser, |model| model == name));
            own.into_iter().chain(other.map(|with| &with.quantity))
        })
    }

    /// Runs one of its models.
    pub(super) fn run_model(
        &self,
        (name, model): (&str, &Model),
        options: &Options,
        keep: Option<(&Path, bool)>,
        on_progress: &mut dyn FnMut(&Progress<'_>) -> Control,
    ) -> Result<ModelRun, VerifyError> {
        let mut simulation = self.simulation(name, model, options)?;
        let frames = self.quantities(name).filter_map(|quantity| match quantity.source {
            Source::Field { at, .. } => Some(at.unwrap_or(f64::INFINITY)),
            _ => None,
        });
        let samples = Samples::new(&simulation, frames.collect());
        let recorder = match keep {
            None => None,
            Some((folder, force)) => {
                let case = folder.join(&self.name);
                // Both are of the program's making.
                [&case, &case.join(name)].into_iter().try_for_each(|folder| ResultFolder::refuse_link(folder))?;
                let folder = ResultFolder::create(&case.join(name), force)?;
                let quiet = Box::new(|_: &Progress<'_>| Control::Continue);
                Some(Recorder::new(folder, model, simulation.history_columns(), simulation.cells(), options.thread_count(), quiet)?)
            }
        };
        let mut gathering = Gathering { samples, recorder, on_progress, is_stopped: false };
        let error = simulation.run(&mut gathering).err().map(|error| error.with_code());
        let Gathering { mut samples, recorder, is_stopped, .. } = gathering;
        let summary = simulation.summary();
        samples.summary = Report::of(&summary, &model.name, &[]).value();
        samples.add_channels(model);
        if let Some(recorder) = recorder {
            recorder.finish(error.clone(), &summary, || None).unwritten.map_or(Ok(()), Err)?;
        }
        let end = simulation.time();
        if summary.rest.is_some() {
            samples.stay_until(model.run.end);
        }
        let early = summary.is_early().then(|| format!("the run ended early, at {end:.4e} s"));
        let stopped = is_stopped.then(|| "the run was stopped".to_string());
        Ok(ModelRun { samples, error: error.or(stopped).or(early) })
    }
}

/// Listens to a run.
pub(crate) struct Gathering<'a> {
    pub(crate) samples: Samples,
    pub(crate) recorder: Option<Recorder<'static>>,
    pub(crate) on_progress: &'a mut dyn FnMut(&Progress<'_>) -> Control,
    pub(crate) is_stopped: bool,
}

impl Observer for Gathering<'_> {
    fn spare(&mut self) -> Frame {
        self.recorder.as_mut().map(Recorder::spare).unwrap_or_default()
    }

    fn frame(&mut self, frame: Frame) -> Result<(), ObserverError> {
        self.samples.note_frame(&frame);
        self.recorder.as_mut().map_or(Ok(()), |recorder| recorder.frame(frame))
    }

    fn cells(&mut self, cells: Cells) -> Result<(), ObserverError> {
        self.samples.note_cells(cells.clone());
        self.recorder.as_mut().map_or(Ok(()), |recorder| recorder.cells(cells))
    }

    fn row(&mut self, row: &[f64]) -> Result<(), ObserverError> {
        self.samples.rows.push(row.to_vec());
        self.recorder.as_mut().map_or(Ok(()), |recorder| recorder.row(row))
    }

    fn progress(&mut self, progress: &Progress<'_>) -> Control {
        let control = (self.on_progress)(progress);
        self.is_stopped |= control == Control::Stop;
        control
    }
}
