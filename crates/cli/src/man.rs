//! `embate man`: the manual as pages of `man`, one for the program and one for each command.

use crate::cli_error::CliError;
use crate::{Failure, terminal};
use clap::Args;
use clap_mangen::Man;
use embate_files::results;
use embate_files::results::messages::REFUSED;
use std::path::PathBuf;

/// Where to.
#[derive(Args)]
pub(crate) struct Arguments {
    /// Folder for all pages: embate.1, embate-run.1 and so on [default: print the page of the program]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

pub(crate) fn man(arguments: &Arguments, command: clap::Command) -> Result<(), Failure> {
    let mut command = command.long_version(None).disable_help_subcommand(true);
    // Gives the commands their whole names.
    command.build();
    let Some(folder) = &arguments.out else { return terminal::print(&String::from_utf8_lossy(&page(&command)?)) };
    let refused = |error| Failure::Input(CliError::new(&REFUSED, format!("can't create {}: {error}", folder.display())));
    std::fs::create_dir_all(folder).map_err(refused)?;
    let commands = std::iter::once(&command).chain(command.get_subcommands());
    for command in commands {
        let file = folder.join(Man::new(command.clone()).get_filename());
        results::write_whole(&file, &page(command)?).map_err(|error| Failure::Input(CliError::new(error.kind(), error)))?;
    }
    let count = 1 + command.get_subcommands().count();
    terminal::print(&format!("{count} pages in {}; read one with: man {}\n", folder.display(), folder.join("embate.1").display()))
}

/// A page of section 1.
fn page(command: &clap::Command) -> Result<Vec<u8>, Failure> {
    let mut text = Vec::new();
    let unwritten = |error| Failure::Run(CliError::new(&REFUSED, format!("can't write a page of the manual: {error}")));
    Man::new(command.clone()).manual("embate").render(&mut text).map_err(unwritten)?;
    Ok(text)
}
