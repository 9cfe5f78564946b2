//! `embate sweep`: a model with many values, one run on each core, and one table of what came out.
//!
//! Plan, runs, table and plot are those of `embate-files`; here are the command line, the progress and what
//! is reported at the end.

use crate::cli_error::CliError;
use crate::input::{self, ModelArguments};
use crate::interrupt::Interrupt;
use crate::jobs::Jobs;
use crate::messages::RUNS_FAILED;
use crate::numbers::{grouped, table, with_unit};
use crate::progress::Display;
use crate::{Failure, cpu, terminal};
use clap::Args;
use embate_files::results::messages::BUG;
use embate_files::sweep::{Advance, Ended, Keep, PLOT_NAME, Request, Running, Sweep, SweepError, TABLE_NAME};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

/// Which model, what varies, what is noted.
#[derive(Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    model: ModelArguments,
    /// A key of the model file and its values: FROM:TO:COUNT, log:FROM:TO:COUNT, or a list with commas, for
    /// example `material.steel.yield=100MPa:500MPa:20`; may be repeated: every value with every other one
    #[arg(long, value_name = "KEY=VALUES", required_unless_present = "table")]
    vary: Vec<String>,
    /// Take the values together, first with first, second with second, instead of every one with every other
    #[arg(long, requires = "vary")]
    zip: bool,
    /// A CSV file with a run in each row; its first line names the keys
    #[arg(long, value_name = "FILE", conflicts_with_all = ["vary", "zip"])]
    table: Option<PathBuf>,
    /// What is noted of each run: a figure of summary.json, or TAKE(COLUMN) of the history, such as
    /// `max(contact.force_y[impact])`, `at=1ms(tip.y)`; may be repeated [default: forces, probes, energies]
    #[arg(long, value_name = "NAME")]
    output: Vec<String>,
    /// Folder for the table, the plot and the runs [default: results/NAME-sweep]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    jobs: Jobs,
    /// Keep of each run all that `embate run` writes: frames and pictures, too
    #[arg(long)]
    keep_frames: bool,
    /// Keep nothing but the table: no folders for the runs
    #[arg(long, conflicts_with = "keep_frames")]
    summary_only: bool,
    /// No progress and no summary
    #[arg(long, short)]
    quiet: bool,
    /// Forget what the folder holds and start again
    #[arg(long)]
    force: bool,
}

pub(crate) fn sweep(arguments: &Arguments) -> Result<(), Failure> {
    let begin = Instant::now();
    let interrupt = Interrupt::watch();
    let is_stopped = || interrupt.is_pressed();
    let jobs = arguments.jobs.count();
    let ModelArguments { model, set, leave } = &arguments.model;
    let request = match &arguments.table {
        Some(file) => Request::Table(file),
        None if arguments.zip => Request::Zip(&arguments.vary),
        None => Request::Factorial(&arguments.vary),
    };
    let prepared = Sweep::prepare(model, leave.reach(), set, request, &arguments.output, arguments.jobs.simd.clone(), jobs, &is_stopped)
        .map_err(reported)?;
    let Some(sweep) = prepared else { return Err(Failure::Interrupted) };
    let mut name = input::default_folder(sweep.first()).into_os_string();
    name.push("-sweep");
    let folder = input::folder(arguments.out.as_deref(), name.into())?;
    let display = Mutex::new(Display::new(arguments.quiet));
    let lock = || display.lock().unwrap_or_else(PoisonError::into_inner);
    let on_advance = |advance: Advance| {
        let done = advance.ended as f64 / advance.of.max(1) as f64;
        lock().show(done, || state(&advance));
    };
    if !arguments.quiet {
        lock().say(&format!("{} runs, {jobs} at a time", grouped(sweep.runs() as u64)));
    }
    let keep = match (arguments.keep_frames, arguments.summary_only) {
        (true, _) => Keep::Frames,
        (_, true) => Keep::Rows,
        _ => Keep::Figures,
    };
    let running = Running {
        folder: &folder,
        keep,
        force: arguments.force,
        jobs,
        user_cpu_seconds: cpu::user_seconds_of_thread,
        is_stopped: &is_stopped,
        on_advance: &on_advance,
    };
    let ended = sweep.run(&running).map_err(reported)?;
    display.into_inner().unwrap_or_else(PoisonError::into_inner).close();
    closing(&ended, &folder, begin.elapsed().as_secs_f64(), arguments.quiet)?;
    let left = ended.advance.of - ended.advance.ended;
    match &ended.failure {
        _ if left > 0 => {
            terminal::report_error(&format!("stopped with {left} of {} runs left; the same command continues from here", ended.advance.of));
            Err(Failure::Interrupted)
        }
        Some((run, error)) => {
            let failed = ended.advance.failed;
            let what = if failed == 1 { "1 run".to_string() } else { format!("{failed} runs") };
            Err(Failure::Run(CliError::new(
                &RUNS_FAILED,
                format!("{what} of {} failed; the first is run {run}: {error}", ended.advance.of),
            )))
        }
        None => Ok(()),
    }
}

fn state(advance: &Advance) -> String {
    let failed = if advance.failed > 0 { format!("  {} failed", grouped(advance.failed as u64)) } else { String::new() };
    format!("run {} of {}{failed}", grouped(advance.ended as u64), grouped(advance.of as u64))
}

pub(crate) fn reported(error: SweepError) -> Failure {
    let cli_error = match (&error, error.kind()) {
        (SweepError::Model(diagnostics), _) => CliError::from(diagnostics),
        (_, kind) => CliError::new(kind.unwrap_or(&BUG), &error),
    };
    match error {
        SweepError::Output(_) | SweepError::Results(_) | SweepError::Plot(_) | SweepError::FirstRun(_) => Failure::Run(cli_error),
        _ => Failure::Input(cli_error),
    }
}

fn closing(ended: &Ended, folder: &Path, seconds: f64, is_quiet: bool) -> Result<(), Failure> {
    if is_quiet {
        return Ok(());
    }
    let Advance { ended: all, before, failed, of } = ended.advance;
    let new = all - before;
    let mut rows = vec![vec!["runs".to_string(), format!("{} of {}", grouped(all as u64), grouped(of as u64))]];
    if before > 0 {
        rows.push(vec!["from before".into(), grouped(before as u64)]);
    }
    if failed > 0 {
        rows.push(vec!["failed".into(), grouped(failed as u64)]);
    }
    rows.push(vec!["time".into(), with_unit(seconds, "s")]);
    if new > 0 {
        rows.push(vec!["speed".into(), format!("{:.1} runs/s", new as f64 / seconds)]);
    }
    let files = [(TABLE_NAME, "a row for each run"), (PLOT_NAME, "outputs over inputs")];
    let files = files.map(|(name, doc)| vec![name.to_string(), doc.to_string()]);
    terminal::print(&format!("{}results in {}\n{}", table(&rows, "  "), folder.display(), table(&files, "  ")))
}
