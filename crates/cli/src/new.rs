//! `embate new`: a folder with a commented model to start from.

use crate::cli_error::CliError;
use crate::messages::NO_NAME;
use crate::{Failure, terminal};
use clap::Args;
use embate_files::results::messages::{EXISTS, REFUSED};
use embate_files::{model_file, results};
use std::path::PathBuf;

/// What to make.
#[derive(Args)]
pub(crate) struct Arguments {
    /// Folder to make; its last part names the model
    name: PathBuf,
    /// Replace a model.toml that is there
    #[arg(long)]
    force: bool,
}

pub(crate) fn new(arguments: &Arguments) -> Result<(), Failure> {
    let folder = &arguments.name;
    let Some(name) = folder.file_name().and_then(|name| name.to_str()) else {
        return Err(Failure::Input(CliError::new(
            &NO_NAME,
            format!("{} names no folder; write for example `embate new my-model`", folder.display()),
        )));
    };
    let file = folder.join("model.toml");
    if file.exists() && !arguments.force {
        return Err(Failure::Input(CliError::new(
            &EXISTS,
            format!("{} exists; choose another name, or replace it with --force", file.display()),
        )));
    }
    std::fs::create_dir_all(folder)
        .map_err(|error| Failure::Input(CliError::new(&REFUSED, format!("can't create {}: {error}", folder.display()))))?;
    results::write_whole(&file, model_file::starter(name).as_bytes())
        .map_err(|error| Failure::Input(CliError::new(error.kind(), error)))?;
    terminal::print(&format!("{} is a model to start from; run it with: embate run {}\n", file.display(), folder.display()))
}
