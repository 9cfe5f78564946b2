//! `embate view`: results in the browser, one run or two side by side; or a model before it runs, which is
//! followed while its file is edited.

use crate::cli_error::CliError;
use crate::input::{self, Leave, key_and_value};
use crate::interrupt::Interrupt;
use crate::messages::USAGE;
use crate::watch::{Page, ShownRun};
use crate::{Failure, terminal};
use clap::Args;
use embate_files::model_file::FILE_NAME;
use embate_files::preview::{Preview, Source};
use embate_files::results::ResultsError;
use embate_files::view::ResultView;
use embate_solver::simulation::Options;
use embate_viewer::{Content, ShownModel};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

/// What is shown and where.
#[derive(Args)]
pub(crate) struct Arguments {
    /// Folder of results; of a run that continues, too. Or a model file, or a folder with a model.toml: the
    /// model before it runs, followed while its file is edited
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Folder of another run, shown beside it
    #[arg(value_name = "OTHER")]
    other: Option<PathBuf>,
    /// Of a model: override a key of its file, for example `run.end="5 ms"`; may be repeated
    #[arg(long, value_name = "KEY=VALUE", value_parser = key_and_value)]
    set: Vec<String>,
    #[command(flatten)]
    leave: Leave,
    #[command(flatten)]
    page: Page,
}

/// How often it looks whether it is to end, or a file has changed.
const PAUSE: Duration = Duration::from_millis(50);

/// Models with more elements are shown before they are checked.
const LARGE: usize = 20_000;

pub(crate) fn view(arguments: &Arguments) -> Result<(), Failure> {
    let interrupt = Interrupt::watch();
    if is_model(&arguments.folder) {
        return view_model(arguments, &interrupt);
    }
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
    let server = arguments.page.show(Content::Runs { runs, live: None })?;
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

/// Whether a path is a model, and no results.
fn is_model(path: &Path) -> bool {
    let is_toml = |path: &Path| path.extension().is_some_and(|extension| extension == "toml");
    is_toml(path) && !path.is_dir() || path.join(FILE_NAME).is_file() && !path.join("run.json").exists()
}

/// Shows a model, and what becomes of it whenever one of its files changes, until Ctrl-C.
fn view_model(arguments: &Arguments, interrupt: &Interrupt) -> Result<(), Failure> {
    if let Some(other) = &arguments.other {
        let text = format!("a model is shown alone: leave out {}", other.display());
        return Err(Failure::Input(CliError::new(&USAGE, text)));
    }
    let path = &arguments.folder;
    let make = |model: &_| input::simulation(model, &Options::default());
    let read = || Source::read(path, &arguments.set, arguments.leave.reach());
    let checked = |source: Source| {
        let (preview, _) = source.preview(&make);
        report(&preview);
        preview
    };
    let file = if path.is_dir() { path.join(FILE_NAME) } else { path.clone() };
    let before = Seen::of(&[file]);
    let first = checked(read());
    let mut is_large = first.cells.len() > LARGE;
    let mut seen = before.with(&first.files);
    let shown = ShownModel::new(path, first);
    let server = arguments.page.show(Content::Model(shown.clone()))?;
    terminal::report_error("it follows the file; Ctrl-C ends it");
    while !interrupt.is_pressed() {
        std::thread::sleep(PAUSE);
        if let Some(now) = seen.change() {
            let source = read();
            if is_large && let Some(sketch) = source.sketch(&make) {
                shown.show(sketch);
            }
            let preview = checked(source);
            is_large = preview.cells.len() > LARGE;
            seen = now.with(&preview.files);
            shown.show(preview);
        }
    }
    server.stop();
    Ok(())
}

/// Says in the terminal what the page says of a state.
fn report(preview: &Preview) {
    let count = |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
    let text = match (preview.faults.count, preview.warnings.count) {
        (0, 0) => "no faults".into(),
        (0, warnings) => count(warnings, "warning"),
        (faults, _) => count(faults, "fault"),
    };
    terminal::report_error(&text);
}

/// Files, with when they were changed and how long they are; `None` of one that is not there.
struct Seen {
    files: Vec<(PathBuf, Option<(SystemTime, u64)>)>,
}

impl Seen {
    fn of(files: &[PathBuf]) -> Self {
        let state = |file: &PathBuf| {
            let data = std::fs::metadata(file).ok()?;
            Some((data.modified().ok()?, data.len()))
        };
        Self { files: files.iter().map(|file| (file.clone(), state(file))).collect() }
    }

    /// These files, as they were known; others as they are now. What changed while they were read is so not
    /// missed.
    fn with(self, files: &[PathBuf]) -> Self {
        let known = |(file, state)| self.files.iter().find(|(own, _)| *own == file).cloned().unwrap_or((file, state));
        Self { files: Self::of(files).files.into_iter().map(known).collect() }
    }

    /// The files as they are now, if one has changed and none is being written: editors empty a file first.
    fn change(&self) -> Option<Self> {
        let again = || Self::of(&self.files.iter().map(|(file, _)| file.clone()).collect::<Vec<_>>());
        let mut now = again();
        if now.files == self.files {
            return None;
        }
        for _ in 0..20 {
            std::thread::sleep(Duration::from_millis(20));
            let later = again();
            if later.files == now.files && now.files.iter().all(|(_, state)| state.is_some_and(|(_, length)| length > 0)) {
                break;
            }
            now = later;
        }
        Some(now)
    }
}
