//! `embate resume`: a run that was stopped continues from its newest checkpoint, as if it had never been
//! stopped.

use crate::cli_error::CliError;
use crate::input::{self, Leave, ModelArguments, key_and_value};
use crate::messages::USAGE;
use crate::recording::{self, Manner, Recording};
use crate::watch::Watching;
use crate::{Failure, terminal};
use clap::Args;
use embate_files::checkpoint::messages::{MODEL_CHANGED, NO_CHECKPOINT, OLDER};
use embate_files::checkpoint::{self, Checkpoint, CheckpointError, Identity, Origin};
use embate_files::model_file::{self, Loaded};
use embate_files::results::{Checkpoints, Recorder};
use embate_files::threads::Threads;
use embate_solver::model::Model;
use embate_solver::simulation::{Options, Simulation};
use std::path::{Path, PathBuf};

/// Which run, and what may be different from now on.
#[derive(Args)]
pub(crate) struct Arguments {
    /// Folder of the results of the run
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Continue to this time instead of `run.end`, "5 ms" for example
    #[arg(long, value_name = "TIME")]
    until: Option<String>,
    #[command(flatten)]
    place: Place,
    /// Override a further key of the model file; the end, limits, checkpoints and output may change
    #[arg(long, value_name = "KEY=VALUE", value_parser = key_and_value)]
    set: Vec<String>,
    #[command(flatten)]
    manner: Manner,
    /// How contact was searched, besides the summary
    #[arg(long, short, conflicts_with = "quiet")]
    verbose: bool,
    #[command(flatten)]
    watching: Watching,
}

/// Where the model is now. Leave to read outside of its folder is asked for again: a checkpoint may come from
/// somebody else.
#[derive(Args)]
pub(crate) struct Place {
    /// Model file or folder, if it is not where it was when the run began
    #[arg(long, value_name = "PATH")]
    model: Option<PathBuf>,
    #[command(flatten)]
    leave: Leave,
}

impl Place {
    /// A given place, or that of the run.
    pub(crate) fn at(model: Option<PathBuf>, leave: Leave) -> Self {
        Self { model, leave }
    }

    /// The model that began the run, with these further keys.
    pub(crate) fn load(&self, origin: &Origin, set: &[String]) -> Result<(Loaded, Origin), Failure> {
        let path =
            self.model.as_ref().map_or_else(|| origin.path.clone(), |path| std::path::absolute(path).unwrap_or_else(|_| path.clone()));
        let origin = Origin { path, set: origin.set.iter().chain(set).cloned().collect() };
        let loaded = input::load(&ModelArguments { model: origin.path.clone(), set: origin.set.clone(), leave: self.leave })?;
        Ok((loaded, origin))
    }
}

pub(crate) fn resume(arguments: &Arguments) -> Result<(), Failure> {
    let path = &arguments.folder;
    let options = arguments.manner.options();
    let mut past = newest(path, &options)?;
    let mut set = arguments.set.clone();
    if let Some(until) = &arguments.until {
        let until = model_file::time(until).map_err(|wrong| usage(format!("--until: {wrong}")))?;
        if until <= past.state.time {
            let at = past.state.time;
            return Err(usage(format!(
                "--until {until:e} s: the checkpoint is at {at:e} s already; `embate replay` shows what was before"
            )));
        }
        set.push(format!("run.end={until:e}"));
    }
    let (loaded, origin) = arguments.place.load(&past.origin, &set)?;
    let model = &loaded.model;
    refuse_changes(&Identity::of(model).differences(&past.identity), "the end, limits, checkpoints and output may change")?;
    let mut simulation = ready(model, &options, &past)?;
    past.release_state();
    input::warn(&loaded, &simulation);
    if !arguments.manner.quiet {
        terminal::report_error(&format!("continuing from step {} at {:.6e} s", past.state.step, past.state.time));
    }
    let watched = arguments.watching.begin(model, &simulation, path)?;
    let frame = simulation.frame();
    let make = |simulation: &Simulation, on_progress| {
        let shown = (simulation.cells(), &frame);
        let checkpoints = Checkpoints::of(model, origin);
        Recorder::reopen(path, (model, &past), simulation.history_columns(), shown, options.thread_count(), checkpoints, on_progress)
    };
    let recording = Recording { watched, ..Recording::of(&loaded, path, &arguments.manner, arguments.verbose) };
    recording::record(recording, &mut simulation, make, Simulation::run)
}

/// The newest sound checkpoint of a run; what is wrong with newer ones is reported.
fn newest(path: &Path, options: &Options) -> Result<Checkpoint, Failure> {
    let none = |faults: Vec<CheckpointError>| {
        let reported = faults.into_iter().map(|fault| CliError::new(fault.kind(), fault));
        Failure::Input(reported.reduce(CliError::and).unwrap_or_else(|| no_checkpoint(path)))
    };
    let (checkpoint, faults) = checkpoint::newest(path, &Threads::new(options.thread_count()), |_| true).map_err(none)?;
    for fault in faults {
        let text = format!("{fault}; the checkpoint before it is used, of step {}", checkpoint.state.step);
        terminal::report_error(&CliError::new(&OLDER, text).to_string());
    }
    Ok(checkpoint)
}

/// That there is nothing to continue from.
pub(crate) fn no_checkpoint(path: &Path) -> CliError {
    let cli_error = CliError::new(&NO_CHECKPOINT, format!("there is no checkpoint in {}", path.display()));
    cli_error.help("a run leaves some with `run.checkpoint`, and one when it is stopped by Ctrl-C or SIGTERM")
}

/// Arguments that can't be.
pub(crate) fn usage(text: impl std::fmt::Display) -> Failure {
    Failure::Input(CliError::new(&USAGE, text))
}

/// Refuses a model that is not the one that ran.
pub(crate) fn refuse_changes(changes: &[String], may: &str) -> Result<(), Failure> {
    if changes.is_empty() {
        return Ok(());
    }
    let lines: String = changes.iter().map(|change| format!("\n  {change}")).collect();
    let cli_error = CliError::new(&MODEL_CHANGED, format!("the model is not the one that ran{lines}"));
    Err(Failure::Input(cli_error.help(format!("put it back as it was, or run it again; {may}"))))
}

/// A simulation that stands where a checkpoint was written.
pub(crate) fn ready(model: &Model, options: &Options, past: &Checkpoint) -> Result<Simulation, Failure> {
    Simulation::resumed(model, options, &past.state.sections).map_err(|error| Failure::Input(CliError::from(&error)))
}
