//! `embate new`: a folder with a commented model to start from.

use crate::cli_error::CliError;
use crate::messages::NO_NAME;
use crate::{Failure, terminal};
use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser};
use embate_files::model_file::{SCHEMA_NAME, STARTERS, Starter};
use embate_files::results::messages::{EXISTS, REFUSED};
use embate_files::{model_file, results};
use std::path::PathBuf;

/// What to make.
#[derive(Args)]
pub(crate) struct Arguments {
    /// Folder to make; its last part names the model
    name: PathBuf,
    /// What to start from
    #[arg(long, value_name = "TEMPLATE", default_value = STARTERS[0].name, value_parser = templates())]
    template: String,
    /// Replace a model.toml that is there
    #[arg(long)]
    force: bool,
}

/// The templates by their names.
fn templates() -> PossibleValuesParser {
    STARTERS.iter().map(|starter| PossibleValue::new(starter.name).help(starter.doc)).collect::<Vec<_>>().into()
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
    let starter = Starter::named(&arguments.template).unwrap_or(&STARTERS[0]);
    // On one line: no one reads it, and it is a third as long.
    let schema = model_file::schema().lines().map(str::trim_start).collect::<String>();
    // The model last: where it is, the rest is.
    for (file, text) in [(folder.join(SCHEMA_NAME), &schema), (file.clone(), &starter.model(name))] {
        results::write_whole(&file, text.as_bytes()).map_err(|error| Failure::Input(CliError::new(error.kind(), error)))?;
    }
    terminal::print(&format!("{} is a model to start from; run it with: embate run {}\n", file.display(), folder.display()))
}
