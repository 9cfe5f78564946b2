//! `embate run`: a model from its file to its results.

use crate::cli_error::CliError;
use crate::in_place::{self, InPlace};
use crate::input::{self, ModelArguments};
use crate::recording::{self, Manner, Recording, in_the_way};
use crate::resume::{self, Continuing};
use crate::watch::Watching;
use crate::{Failure, terminal};
use clap::Args;
use embate_files::model_file::{self, Loaded};
use embate_files::post_mortem;
use embate_files::results::messages::NO_POST_MORTEM;
use embate_files::results::{Recorder, ResultFolder};
use embate_solver::error::{Error, Fault, MEMORY};
use embate_solver::model::Model;
use embate_solver::simulation::Simulation;
use std::path::PathBuf;

/// Which model, where to and how.
#[derive(Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    model: ModelArguments,
    /// Folder for the results [default: results/NAME]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    manner: Manner,
    /// How contact was searched, besides the summary
    #[arg(long, short, conflicts_with = "quiet")]
    verbose: bool,
    /// Replace results that are there; of this model they need it only if it is as it was, or they took more
    /// than ten minutes
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    watching: Watching,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let origin = input::origin(&arguments.model);
    // Before any work is done.
    arguments.out.as_deref().map_or(Ok(()), |out| in_place::refuse_others(out, &origin, arguments.force))?;
    let loaded = load(arguments)?;
    let model = &loaded.model;
    let path = folder(arguments, model)?;
    let force = match in_place::decide(&path, &origin, &loaded, arguments.force)? {
        InPlace::Nothing => arguments.force,
        InPlace::Replaced(what) => {
            if !arguments.manner.quiet {
                terminal::report_error(&format!("{what} in {} are replaced", path.display()));
            }
            true
        }
        InPlace::Continued => {
            if !arguments.manner.quiet {
                terminal::report_error(&format!("{} holds this run unfinished; with --force it begins again", path.display()));
            }
            let past = resume::newest(&path, &arguments.manner.options())?;
            let Arguments { manner, verbose, watching, .. } = arguments;
            return Continuing { path: &path, past, loaded, origin, manner, is_verbose: *verbose, watching }.go();
        }
    };
    let options = arguments.manner.options();
    let mut simulation = input::simulation(model, &options).map_err(|error| match &error {
        Error::Model(faults) => with_page(CliError::from(&error), arguments, &loaded, faults),
        _ => Failure::Input(CliError::from(&error)),
    })?;
    // Also of a quiet run, and before it: who reads them late has waited for nothing.
    input::warn(&loaded, &simulation);
    input::warn_of_threads(&simulation, &arguments.manner);
    let watched = arguments.watching.begin(model, &simulation, &path)?;
    // Only now: a model that can't run must not cost the results of an earlier one.
    let folder = ResultFolder::create(&path, force).map_err(in_the_way)?;
    let make = |simulation: &Simulation, on_progress| {
        let shown = (simulation.history_columns(), simulation.cells());
        let checkpoints = recording::checkpoints(&loaded, origin, simulation);
        Recorder::keeping(folder, model, shown, options.thread_count(), Some(checkpoints), on_progress)
    };
    let recording = Recording { watched, ..Recording::of(&loaded, &path, &arguments.manner, arguments.verbose) };
    recording::record(recording, &mut simulation, make, Simulation::run)
}

/// Reads the model; of one that needs too much memory there is a page.
fn load(arguments: &Arguments) -> Result<Loaded, Failure> {
    input::load(&arguments.model).map_err(|failure| {
        let Failure::Input(cli_error) = failure else { return failure };
        let Some(loaded) = model_file::load_despite(&MEMORY, &arguments.model.model, &arguments.model.set, arguments.model.leave.reach())
        else {
            return Failure::Input(cli_error);
        };
        with_page(cli_error, arguments, &loaded, &loaded.model.check())
    })
}

/// That a model can't begin: of what its numbers need there is a page, beside the results of earlier runs if
/// there are any.
fn with_page(cli_error: CliError, arguments: &Arguments, loaded: &Loaded, faults: &[Fault]) -> Failure {
    let Ok(path) = folder(arguments, &loaded.model) else { return Failure::Input(cli_error) };
    Failure::Input(match post_mortem::at_start(loaded, &arguments.manner.options(), faults, &path) {
        Ok(None) => cli_error,
        Ok(Some(page)) => recording::with_page(cli_error, &page),
        Err(error) => cli_error.and(CliError::new(&NO_POST_MORTEM, format!("the post-mortem is missing: {error}"))),
    })
}

fn folder(arguments: &Arguments, model: &Model) -> Result<PathBuf, Failure> {
    input::folder(arguments.out.as_deref(), input::default_folder(model))
}
