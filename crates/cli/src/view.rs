//! `embate view`: results in the browser, one run or two side by side.

use crate::cli_error::CliError;
use crate::interrupt::Interrupt;
use crate::watch::{Page, ShownRun};
use crate::{Failure, terminal};
use clap::Args;
use embate_files::results::ResultsError;
use embate_files::view::ResultView;
use std::path::PathBuf;
use std::time::Duration;

/// What is shown and where.
#[derive(Args)]
pub(crate) struct Arguments {
    /// Folder of results; of a run that continues, too
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Folder of another run, shown beside it
    #[arg(value_name = "OTHER")]
    other: Option<PathBuf>,
    #[command(flatten)]
    page: Page,
}

/// How often it looks whether it is to end.
const PAUSE: Duration = Duration::from_millis(50);

pub(crate) fn view(arguments: &Arguments) -> Result<(), Failure> {
    let interrupt = Interrupt::watch();
    let folders = std::iter::once(&arguments.folder).chain(&arguments.other);
    let runs: Vec<ShownRun> = folders.map(|folder| (folder.clone(), ResultView::open(folder))).collect();
    for (path, run) in &runs {
        // What is damaged is reported by the page; what is none of embate's, at once.
        if let Err(error @ ResultsError::NothingToSee { .. }) = run
            && !path.join("run.json").exists()
        {
            return Err(Failure::Input(CliError::new(error.kind(), error)));
        }
    }
    let server = arguments.page.show(runs, None)?;
    terminal::report_error("Ctrl-C ends it");
    wait(&interrupt);
    server.stop();
    Ok(())
}

/// Until Ctrl-C.
pub(crate) fn wait(interrupt: &Interrupt) {
    while !interrupt.is_pressed() {
        std::thread::sleep(PAUSE);
    }
}
