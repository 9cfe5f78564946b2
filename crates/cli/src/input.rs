//! What `run` and `check` share: reading a model, making it ready, and where its results go.

use crate::cli_error::CliError;
use crate::numbers::grouped;
use crate::recording::Manner;
use crate::{Failure, machine, terminal};
use clap::Args;
use embate_files::PathPolicy;
use embate_files::checkpoint::Origin;
use embate_files::model_file::{self, Loaded};
use embate_files::results::ResultFolder;
use embate_solver::error::Error;
use embate_solver::model::Model;
use embate_solver::simulation::{Options, Simulation};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// Which model.
#[derive(Args)]
pub(crate) struct ModelArguments {
    /// Model file, or folder with a model.toml
    pub(crate) model: PathBuf,
    /// Override a key of the model file, for example `run.end="5 ms"`; may be repeated
    #[arg(long, value_name = "KEY=VALUE", value_parser = key_and_value)]
    pub(crate) set: Vec<String>,
    #[command(flatten)]
    pub(crate) leave: Leave,
}

/// Whether files may lie outside of the folder of what names them.
#[derive(Args, Clone, Copy, Default)]
pub(crate) struct Leave {
    /// Read files that the model names also where they lie outside of its folder
    #[arg(long)]
    allow_outside: bool,
}

impl Leave {
    pub(crate) fn reach(self) -> PathPolicy {
        if self.allow_outside { PathPolicy::Anywhere } else { PathPolicy::Folder }
    }
}

pub(crate) fn key_and_value(text: &str) -> Result<String, String> {
    match text.split_once('=') {
        Some((key, _)) if !key.trim().is_empty() => Ok(text.to_string()),
        _ => Err("write it as path.to.key=value".to_string()),
    }
}

/// Reads a model; all faults of the file become one message.
pub(crate) fn load(arguments: &ModelArguments) -> Result<Loaded, Failure> {
    model_file::load_with_places(&arguments.model, &arguments.set, arguments.leave.reach())
        .map_err(|diagnostics| Failure::Input(CliError::from(&diagnostics)))
}

/// Where a model came from, to find it again.
pub(crate) fn origin(arguments: &ModelArguments) -> Origin {
    let path = std::path::absolute(&arguments.model).unwrap_or_else(|_| arguments.model.clone());
    Origin { path, set: arguments.set.clone(), ..Origin::default() }
}

/// Makes a model ready to step.
pub(crate) fn ready(loaded: &Loaded, options: &Options) -> Result<Simulation, Failure> {
    simulation(&loaded.model, options).map_err(|error| Failure::Input(not_ready(loaded, &error)))
}

/// Why a model can't be made ready, with the places in its file.
pub(crate) fn not_ready(loaded: &Loaded, error: &Error) -> CliError {
    match error {
        Error::Model(faults) => CliError::from(&loaded.faulty(faults)),
        other => CliError::from(other),
    }
}

/// The simulation of a model, if the machine has the memory.
pub(crate) fn simulation(model: &Model, options: &Options) -> Result<Simulation, Error> {
    let spare = machine::memory_available().filter(|_| model.run.memory_limit.is_none());
    if let Some(fault) = spare.and_then(|bytes| model.memory_fault(bytes as f64, "what the machine has to spare")) {
        return Err(Error::Model(vec![fault]));
    }
    Simulation::new(model, options)
}

/// Prints what the user should know of a model before he trusts its results.
pub(crate) fn warn(loaded: &Loaded, simulation: &Simulation) {
    let warnings = loaded.reported(simulation.model_warnings());
    if warnings.count > 0 {
        terminal::report_error(&warnings.rendered);
    }
}

/// Says why a model runs on fewer threads than were asked for.
pub(crate) fn warn_of_threads(simulation: &Simulation, manner: &Manner) {
    let (asked, used) = (manner.options().threads, simulation.threads());
    if !manner.quiet && asked > used {
        terminal::report_error(&format!(
            "one thread instead of {asked}: the model has {} elements, and below {} more threads cost more than they bring",
            grouped(simulation.elements() as u64),
            grouped(Simulation::THREADS_FROM as u64)
        ));
    }
}

/// The results folder when none is given: `results/NAME`.
pub(crate) fn default_folder(model: &Model) -> PathBuf {
    // Only the last part of a name that looks like a path, so that nothing is written elsewhere.
    let name = Path::new(&model.name).file_name().unwrap_or(OsStr::new("model"));
    Path::new("results").join(name)
}

/// The folder that the user has named, which may be a link, or the `default`, which may not.
pub(crate) fn folder(named: Option<&Path>, default: PathBuf) -> Result<PathBuf, Failure> {
    match named {
        Some(named) => Ok(named.to_path_buf()),
        None => ResultFolder::refuse_link(&default).map(|()| default).map_err(|error| Failure::Input(CliError::new(error.kind(), error))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_stay_below_the_results_folder() {
        for (name, folder) in [("tube", "results/tube"), ("../../etc", "results/etc"), ("..", "results/model"), ("", "results/model")] {
            let model = Model { name: name.into(), ..Model::default() };
            assert_eq!(default_folder(&model), Path::new(folder));
        }
    }

    #[test]
    fn overrides_need_a_key_and_a_value() {
        assert!(key_and_value("run.end=1").is_ok());
        assert!(key_and_value("run.end").is_err() && key_and_value("=1").is_err());
    }
}
