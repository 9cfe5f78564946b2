//! `embate report`: a result folder as one HTML file.

use crate::complaint::Complaint;
use crate::{Failure, terminal};
use clap::Args;
use embate_files::report::{REPORT, write};
use embate_files::results::ResultsError;
use std::path::PathBuf;

/// Which results.
#[derive(Args)]
pub(crate) struct Arguments {
    /// Folder of results, of a run that has ended or goes on
    folder: PathBuf,
    /// File to write [default: report.html in the folder]
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

pub(crate) fn report(arguments: &Arguments) -> Result<(), Failure> {
    let out = arguments.out.clone().unwrap_or_else(|| arguments.folder.join(REPORT));
    write(&arguments.folder, &out).map_err(|error| {
        let complaint = Complaint::new(error.kind(), &error);
        match error {
            // What was to be written is no fault of the input.
            ResultsError::File { action: "write", .. } => Failure::Run(complaint),
            _ => Failure::Input(complaint),
        }
    })?;
    terminal::print(&format!("report in {}\n", out.display()))
}
