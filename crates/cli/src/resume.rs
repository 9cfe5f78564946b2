//! `embate resume`: a run that was stopped continues from its newest checkpoint, as if it had never been
//! stopped.

use crate::cli_error::CliError;
use crate::input::{self, Leave, ModelArguments, key_and_value};
use crate::messages::USAGE;
use crate::numbers::with_unit;
use crate::recording::{self, Manner, Recording};
use crate::watch::Watching;
use crate::{Failure, terminal};
use clap::Args;
use embate_files::checkpoint::messages::{MODEL_CHANGED, NO_CHECKPOINT, OLDER};
use embate_files::checkpoint::{self, Checkpoint, CheckpointError, Identity, Origin};
use embate_files::model_file::{self, Loaded};
use embate_files::results::{Earlier, Recorder};
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
        if path.as_os_str().is_empty() {
            let text = "the model of this run was in the memory of a program and names files, so it is not in the results";
            let help = "write it by `model.save(...)` of Python, with the files that it names beside it, and name it with --model";
            return Err(Failure::Input(CliError::new(&NO_CHECKPOINT, text).help(help)));
        }
        let origin = Origin { path, set: origin.set.iter().chain(set).cloned().collect(), ..origin.clone() };
        let loaded = input::load(&ModelArguments { model: origin.path.clone(), set: origin.set.clone(), leave: self.leave })?;
        Ok((loaded, origin))
    }
}

pub(crate) fn resume(arguments: &Arguments) -> Result<(), Failure> {
    let path = &arguments.folder;
    if arguments.until.is_none() && arguments.set.is_empty() && is_done(path, &arguments.place) {
        if !arguments.manner.quiet {
            let text = format!("the run in {} is done: it has reached its end; --until TIME continues to a later one", path.display());
            terminal::report_error(&text);
        }
        return Ok(());
    }
    let options = arguments.manner.options();
    let past = newest(path, &options)?;
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
    Continuing { path, past, loaded, origin, manner: &arguments.manner, is_verbose: arguments.verbose, watching: &arguments.watching }.go()
}

/// Whether a run has nothing left to do, by its model as it is now.
fn is_done(path: &Path, place: &Place) -> bool {
    let Ok(Some(Earlier { end: Some(end), ran: Some(ran), .. })) = Earlier::read(path) else { return false };
    // Without the model its own word counts.
    let wanted = place.load(&ran.origin(), &[]).map_or(0.0, |(loaded, _)| loaded.model.run.end);
    end.is_done_at(wanted)
}

/// A run that continues from a checkpoint.
pub(crate) struct Continuing<'a> {
    pub(crate) path: &'a Path,
    pub(crate) past: Checkpoint,
    pub(crate) loaded: Loaded,
    pub(crate) origin: Origin,
    pub(crate) manner: &'a Manner,
    pub(crate) is_verbose: bool,
    pub(crate) watching: &'a Watching,
}

impl Continuing<'_> {
    /// Runs it to its end.
    pub(crate) fn go(self) -> Result<(), Failure> {
        let Self { path, mut past, loaded, origin, manner, is_verbose, watching } = self;
        let (model, options) = (&loaded.model, manner.options());
        refuse_changes(&Identity::of(model).differences(&past.identity), "the end, limits, checkpoints and output may change")?;
        let mut simulation = ready(model, &options, &past)?;
        past.release_state();
        input::warn(&loaded, &simulation);
        input::warn_of_threads(&simulation, manner);
        if !manner.quiet {
            terminal::report_error(&format!("continuing from step {} at {:.6e} s", past.state.step, past.state.time));
        }
        let watched = watching.begin(model, &simulation, path)?;
        let frame = simulation.frame();
        let make = |simulation: &Simulation, on_progress| {
            let shown = (simulation.cells(), &frame);
            let checkpoints = recording::checkpoints(&loaded, origin, simulation);
            Recorder::reopen(path, (model, &past), simulation.history_columns(), shown, options.thread_count(), checkpoints, on_progress)
        };
        let recording = Recording { watched, ..Recording::of(&loaded, path, manner, is_verbose) };
        recording::record(recording, &mut simulation, make, Simulation::run)
    }
}

/// The newest sound checkpoint of a run; what is wrong with newer ones is reported.
pub(crate) fn newest(path: &Path, options: &Options) -> Result<Checkpoint, Failure> {
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

/// That there is nothing to continue from, and why.
fn no_checkpoint(path: &Path) -> CliError {
    let at = path.display();
    let missing = |text: String| CliError::new(&NO_CHECKPOINT, text);
    let until = match Earlier::read(path) {
        _ if !path.exists() => {
            return missing(format!("there is no folder {at}"))
                .help("give the folder that `embate run` wrote: results/NAME, or that of --out");
        }
        Ok(None) => return missing(format!("{at} holds no results of embate")).help("give the folder that `embate run` wrote"),
        Ok(Some(Earlier { end: Some(end), .. })) => format!(" (status \"{}\", at {})", end.status, with_unit(end.time, "s")),
        Ok(Some(_)) => " (it was cut off)".to_string(),
        Err(_) => String::new(),
    };
    let text = format!("there is no checkpoint in {at}: the run{until} kept none, so it can't continue");
    missing(text).help(
        "`embate run` runs it from the start, and `embate replay` shows a stretch of it; runs keep checkpoints from 5 s on, unless \
            `run.checkpoint = 0`",
    )
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
