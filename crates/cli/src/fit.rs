//! `embate fit`: the values of keys with which a model follows what was measured.
//!
//! The search and its runs are those of `embate-files`; here are the command line, the progress and what is
//! reported at the end.

use crate::cli_error::CliError;
use crate::input::{self, ModelArguments};
use crate::interrupt::Interrupt;
use crate::jobs::Jobs;
use crate::numbers::{per_cent, table, with_unit};
use crate::progress::Display;
use crate::sweep::reported;
use crate::{Failure, terminal};
use clap::Args;
use embate_files::numbers::significant;
use embate_files::sweep::fit::{Ended, Fit, Fitted, Fitting, TABLE_NAME, Wanted};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// Which model, what varies, what was measured.
#[derive(Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    model: ModelArguments,
    /// A key of the model file and its bounds, LOWEST:HIGHEST or LOWEST:FIRST:HIGHEST, for example
    /// `material.steel.yield=200MPa:600MPa`; may be repeated
    #[arg(long, value_name = "KEY=BOUNDS", required = true)]
    vary: Vec<String>,
    /// What was measured: OUTPUT=VALUE, where OUTPUT is as in `embate sweep`, for example
    /// `at=1ms(tip.y)=3.2mm`; COLUMN=FILE with a curve over time, a CSV file whose first line may name
    /// units: `time [ms],tip.y [mm]`; or "COLUMN over COLUMN=FILE", such as a force over a displacement; may
    /// be repeated
    #[arg(long, value_name = "WHAT=MEASURED", required = true)]
    measured: Vec<String>,
    /// Length of the differences between runs that give the derivatives, as a part of the bounds' distance
    #[arg(long, value_name = "PART", default_value_t = 0.01)]
    step: f64,
    /// Relative change of the sum of squares, or of the keys as parts of the bounds' distance, at which it
    /// ends
    #[arg(long, value_name = "PART", default_value_t = 1e-3)]
    tolerance: f64,
    /// Most runs, about
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    runs: u32,
    /// Folder for the table of all runs [default: results/NAME-fit]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    jobs: Jobs,
    /// No progress
    #[arg(long, short)]
    quiet: bool,
    /// Replace a table that is there
    #[arg(long)]
    force: bool,
}

pub(crate) fn fit(arguments: &Arguments) -> Result<(), Failure> {
    let interrupt = Interrupt::watch();
    let is_stopped = || interrupt.is_pressed();
    let jobs = arguments.jobs.count();
    for (name, value) in [("--step", arguments.step), ("--tolerance", arguments.tolerance)] {
        if !(value > 0.0 && value < 0.5) {
            let text = format!("{name} is {value}; it is between 0 and 0.5");
            return Err(Failure::Input(CliError::new(&crate::messages::USAGE, text)));
        }
    }
    let ModelArguments { model, set, leave } = &arguments.model;
    let wanted = Wanted {
        varied: &arguments.vary,
        measured: &arguments.measured,
        step: arguments.step,
        tolerance: arguments.tolerance,
        runs: arguments.runs as usize,
    };
    let prepared = Fit::prepare(model, leave.reach(), set, wanted, arguments.jobs.simd.clone(), jobs, &is_stopped).map_err(reported)?;
    let Some(fit) = prepared else { return Err(Failure::Interrupted) };
    let folder = input::folder(arguments.out.as_deref(), Path::new("results").join(format!("{}-fit", fit.name())))?;
    let display = Mutex::new(Display::new(arguments.quiet));
    let lock = || display.lock().unwrap_or_else(PoisonError::into_inner);
    let on_advance = |runs: usize, residual: f64| {
        let done = (runs as f64 / f64::from(arguments.runs)).min(1.0);
        lock().show(done, || format!("{runs} runs  smallest residual {}", per_cent(residual)));
    };
    let fitting = Fitting { folder: &folder, force: arguments.force, jobs, is_stopped: &is_stopped, on_advance: &on_advance };
    let ended = fit.run(&fitting).map_err(reported)?;
    display.into_inner().unwrap_or_else(PoisonError::into_inner).close();
    let Some(ended) = ended else {
        terminal::report_error(&format!("stopped; the runs so far are in {}", folder.join(TABLE_NAME).display()));
        return Err(Failure::Interrupted);
    };
    terminal::print(&closing(&ended, &fit, arguments, &folder))
}

/// The keys found, how well they are known, and how to run the model with them.
fn closing(ended: &Ended, fit: &Fit<'_>, arguments: &Arguments, folder: &Path) -> String {
    let how = if ended.is_converged { "done" } else { "not at an end; give more --runs" };
    let head = format!(
        "{}: {how} after {} runs; the differences are {} of what was measured, {} with the first values\n",
        fit.name(),
        ended.runs,
        per_cent(ended.residual),
        per_cent(ended.residual_first),
    );
    let shown = |value: f64, unit: &str| if unit.is_empty() { significant(value) } else { with_unit(value, unit) };
    let row = |key: &Fitted| {
        let error =
            if key.error.is_finite() { format!("± {}", shown(key.error, &key.unit)) } else { "what was measured does not say it".into() };
        let bound = if key.is_at_bound { "at its bound" } else { "" };
        vec![key.path.clone(), shown(key.value, &key.unit), error, bound.to_string()]
    };
    let rows: Vec<Vec<String>> = ended.keys.iter().map(row).collect();
    let set: String = ended.keys.iter().map(|key| format!(" --set {}={:?}", key.path, key.value)).collect();
    let own: String = arguments.model.set.iter().map(|set| format!(" --set '{set}'")).collect();
    format!(
        "{head}{}all runs: {}\nto run it: embate run {}{own}{set}\n",
        table(&rows, "  "),
        folder.join(TABLE_NAME).display(),
        arguments.model.model.display(),
    )
}
