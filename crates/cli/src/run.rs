//! `embate run`: a model from its file to its results.

use crate::complaint::Complaint;
use crate::input::{self, ModelArguments};
use crate::interrupt::Interrupt;
use crate::numbers::{grouped, per_cent, table, with_unit};
use crate::progress::Display;
use crate::{Failure, cpu, terminal};
use clap::Args;
use embate_files::results::{Recorder, Report, ResultFolder, ResultsError, RunStatus};
use embate_solver::error::Error;
use embate_solver::model::Model;
use embate_solver::simulation::{ContactSearch, Control, Options, Progress, Simulation};
use std::path::{Path, PathBuf};

/// Which model, where to and how.
#[derive(Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    model: ModelArguments,
    /// Folder for the results [default: results/NAME]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Threads; 0: one per processor (changes no result)
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u16).range(..=1024))]
    threads: u16,
    /// Instruction set: scalar, avx2, avx512 [default: the best of this machine] (changes no result)
    #[arg(long, value_name = "LEVEL")]
    simd: Option<String>,
    /// No progress and no summary; warnings of the model are told all the same
    #[arg(long, short)]
    quiet: bool,
    /// How contact was searched, besides the summary
    #[arg(long, short, conflicts_with = "quiet")]
    verbose: bool,
    /// Replace results that are there
    #[arg(long)]
    force: bool,
}

/// What the files of a result folder are for, in the order in which to look at them.
const FILES: &[(&str, &str)] = &[
    ("animation.gif", "the bodies in motion"),
    ("final.png", "the last state"),
    ("energy.svg", "energies over time"),
    ("history.svg", "probes and contacts over time"),
    ("history.csv", "the same as numbers"),
    ("fields.pvd", "all fields, for ParaView"),
    ("obstacles.pvd", "the obstacles, for ParaView"),
    ("summary.json", "the figures of the run"),
];

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let refuse = |folder: &Path| if arguments.force { Ok(()) } else { ResultFolder::refuse_existing(folder).map_err(in_the_way) };
    // Before any work is done.
    arguments.out.as_deref().map_or(Ok(()), refuse)?;
    let loaded = input::load(&arguments.model)?;
    let model = &loaded.model;
    let path = arguments.out.clone().unwrap_or_else(|| input::default_folder(model));
    refuse(&path)?;
    let options = Options { threads: arguments.threads.into(), simd: arguments.simd.clone() };
    let mut simulation = input::ready(model, &options)?;
    // Also of a quiet run, and before it: who reads them late has waited for nothing.
    input::warn(&loaded, &simulation);
    // Only now: a model that can't run must not cost the results of an earlier one.
    let folder = ResultFolder::create(&path, arguments.force).map_err(in_the_way)?;
    let Recorded { report, result, is_interrupted, told } =
        record(model, &mut simulation, folder, options.thread_count(), arguments.quiet)?;

    if !arguments.quiet {
        // Those of the model come first, and have been told, as has what was seen on the way: the summary says how it went on.
        let of_run = report.warnings.iter().skip(simulation.model_warnings().len());
        let of_run = of_run.filter(|notice| !told.iter().any(|text| notice.text.starts_with(text)));
        of_run.for_each(|notice| terminal::complain(&Complaint::from(notice).to_string()));
    }
    result.map_err(|complaint| Failure::Run(with_results(complaint, &path)))?;
    if !arguments.quiet {
        terminal::print(&closing_text(&report, &path))?;
    }
    if arguments.verbose {
        terminal::print(&search_text(&simulation.searches()))?;
    }
    if is_interrupted { Err(Failure::Interrupted) } else { Ok(()) }
}

fn in_the_way(error: ResultsError) -> Failure {
    Failure::Input(Complaint::new(error.kind(), error))
}

/// How a run ended.
struct Recorded {
    report: Report,
    /// What went wrong.
    result: Result<(), Complaint>,
    /// Whether the user stopped it.
    is_interrupted: bool,
    /// What was told of it on the way.
    told: Vec<String>,
}

/// Runs and records.
fn record(model: &Model, simulation: &mut Simulation, folder: ResultFolder, threads: usize, is_quiet: bool) -> Result<Recorded, Failure> {
    let interrupt = Interrupt::watch();
    let mut display = Display::new(is_quiet);
    let mut is_interrupted = false;
    let mut told = Vec::new();
    let on_progress = |progress: &Progress<'_>| {
        display.update(progress);
        for notice in progress.notices {
            display.say(&Complaint::from(notice).to_string());
            told.push(notice.text.clone());
        }
        if !interrupt.is_pressed() {
            return Control::Continue;
        }
        if !is_interrupted {
            display.say("stopping; results so far are kept (Ctrl-C again ends at once)");
        }
        is_interrupted = true;
        Control::Stop
    };
    let (columns, cells) = (simulation.history_columns(), simulation.cells());
    let mut recorder = Recorder::new(folder, model, columns, cells, threads, Box::new(on_progress)).map_err(in_the_way)?;
    let result = simulation.run(&mut recorder);
    let outcome = recorder.finish(result.as_ref().err().map(Error::with_code), &simulation.summary(), cpu::user_seconds);
    display.close();
    // What went wrong first is what matters.
    let unwritten = outcome.unwritten.map_or(Ok(()), |error| Err(Complaint::new(error.kind(), error)));
    let result = result.map_err(|error| Complaint::from(&error)).and(unwritten);
    Ok(Recorded { report: outcome.report, result, is_interrupted, told })
}

fn with_results(complaint: Complaint, path: &Path) -> Complaint {
    let kept: Vec<&str> = FILES.iter().map(|(name, _)| *name).filter(|name| path.join(name).exists()).collect();
    if kept.is_empty() { complaint } else { complaint.and(format!("  results until then: {} ({})", path.display(), kept.join(", "))) }
}

/// A line for each contact between surfaces.
fn search_text(searches: &[ContactSearch]) -> String {
    let mut rows = vec![["contact", "search", "skin", "searches", "steps between", "candidates", "pairs swept"].map(String::from).to_vec()];
    rows.extend(searches.iter().map(|it| {
        let between = it.report.steps as f64 / it.report.searches.max(1) as f64;
        vec![
            it.contact.clone(),
            it.search.clone(),
            with_unit(it.report.skin, "m"),
            grouped(it.report.searches),
            format!("{between:.1}"),
            grouped(it.report.candidates as u64),
            grouped(it.pairs_swept),
        ]
    }));
    table(&rows, "")
}

fn closing_text(report: &Report, path: &Path) -> String {
    let ended = match report.status {
        RunStatus::Done => "done",
        RunStatus::Failed => "failed",
        RunStatus::Stopped => "stopped",
    };
    let threads = if report.threads == 1 { "1 thread".to_string() } else { format!("{} threads", report.threads) };
    let speed = report.element_steps_per_second.map_or(String::new(), |speed| format!("{:.1} million element-steps/s, ", speed * 1e-6));
    let figures = [
        ["steps".into(), format!("{} to t = {}", grouped(report.steps), with_unit(report.time_end, "s"))],
        ["smallest step".into(), format!("{} ({})", with_unit(report.stable_time_step_min, "s"), report.stable_time_step_governor)],
        ["speed".into(), format!("{speed}{threads}, {}", report.simd)],
        ["energy drift".into(), per_cent(report.energy_drift)],
        ["penetration".into(), format!("{} at most", with_unit(report.penetration_max, "m"))],
    ]
    .map(Vec::from);
    let files: Vec<Vec<String>> = FILES
        .iter()
        .filter(|(name, _)| path.join(name).exists())
        .map(|(name, doc)| vec![(*name).to_string(), (*doc).to_string()])
        .collect();
    format!(
        "{}: {ended} in {}\n{}results in {}\n{}",
        report.model,
        with_unit(report.wall_seconds, "s"),
        table(&figures, "  "),
        path.display(),
        table(&files, "  ")
    )
}
