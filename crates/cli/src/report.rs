//! `embate report`: a result folder as one HTML file.

use crate::cli_error::CliError;
use crate::{Failure, terminal};
use clap::Args;
use embate_files::report::{REPORT, write};
use embate_files::results::ResultsError;
use std::path::PathBuf;

/// Which results.
#[derive(Args)]
pub(crate) struct Arguments {
    /// Folder of results, of a run that has ended or continues
    folder: PathBuf,
    /// File to write [default: report.html in the folder]
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

pub(crate) fn report(arguments: &Arguments) -> Result<(), Failure> {
    let out = arguments.out.clone().unwrap_or_else(|| arguments.folder.join(REPORT));
    write(&arguments.folder, &out).map_err(|error| {
        let cli_error = CliError::new(error.kind(), &error);
        match error {
            // What was to be written is no fault of the input.
            ResultsError::File { action: "write", .. } => Failure::Run(cli_error),
            _ => Failure::Input(cli_error),
        }
    })?;
    terminal::print(&format!("report in {}\n", out.display()))
}
