//! What `run` and `resume` share: a simulation that is run and recorded, with its checkpoints, what is
//! reported on the way, and how it ended.

use crate::cli_error::CliError;
use crate::interrupt::Interrupt;
use crate::numbers::{grouped, per_cent, table, with_unit};
use crate::progress::Display;
use crate::watch::Watched;
use crate::{Failure, cpu, terminal};
use clap::Args;
use embate_files::checkpoint::Origin;
use embate_files::checkpoint::messages::LAST_GOOD;
use embate_files::model_file::Loaded;
use embate_files::post_mortem::{self, Failed};
use embate_files::results::messages::NO_POST_MORTEM;
use embate_files::results::{Checkpoints, OnProgress, Pause, Recorder, Report, ResultsError, RunStatus};
use embate_solver::error::Error;
use embate_solver::simulation::{ContactSearch, Control, Observer, Options, Progress, Simulation};
use embate_viewer::Tap;
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// How a model is run, and what is reported about it; changes no result.
#[derive(Args)]
pub(crate) struct Manner {
    /// Threads; 0: one per processor (changes no result)
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u16).range(..=1024))]
    threads: u16,
    /// Instruction set: scalar, avx2, avx512 [default: the best of this machine] (changes no result)
    #[arg(long, value_name = "LEVEL")]
    simd: Option<String>,
    /// No progress and no summary; warnings of the model are reported all the same
    #[arg(long, short)]
    pub(crate) quiet: bool,
}

impl Manner {
    pub(crate) fn options(&self) -> Options {
        Options { threads: self.threads.into(), simd: self.simd.clone() }
    }
}

/// What the files of a result folder are for, in the order in which to look at them.
const FILES: &[(&str, &str)] = &[
    ("animation.gif", "the bodies in motion"),
    ("final.png", "the last state"),
    ("energy.svg", "energies over time"),
    ("history.svg", "probes and contacts over time"),
    ("history.csv", "the same as numbers"),
    ("channels.csv", "the channels of the model"),
    ("fields.pvd", "all fields, for ParaView"),
    ("obstacles.pvd", "the obstacles, for ParaView"),
    ("summary.json", "the figures of the run"),
    ("checkpoint", "states from which `embate resume` continues"),
];

/// What is run, and where its results go.
pub(crate) struct Recording<'r> {
    pub(crate) loaded: &'r Loaded,
    pub(crate) path: &'r Path,
    /// Result folder with the checkpoints of the run; that of the results, but where these are of a stretch
    /// of it.
    pub(crate) checkpoints: &'r Path,
    /// Whether the state of the last good step of a run that fails is kept.
    pub(crate) keeps_last_good: bool,
    pub(crate) manner: &'r Manner,
    pub(crate) is_verbose: bool,
    /// Of a run that is shown in the browser.
    pub(crate) watched: Option<Watched>,
}

impl<'r> Recording<'r> {
    /// A run from its beginning, or from where it was stopped, to its end.
    pub(crate) fn of(loaded: &'r Loaded, path: &'r Path, manner: &'r Manner, is_verbose: bool) -> Self {
        let run = &loaded.model.run;
        let keeps_last_good = run.checkpoint_steps.is_some() || matches!(Pause::of(&loaded.model), Pause::Every(_));
        Self { loaded, path, checkpoints: path, keeps_last_good, manner, is_verbose, watched: None }
    }
}

/// Bytes for the states that a run keeps in memory, from which it can go to its failure once more.
const ROOM: usize = 64 << 20;

/// What an error of results is before anything was run.
pub(crate) fn in_the_way(error: ResultsError) -> Failure {
    Failure::Input(CliError::new(error.kind(), error))
}

/// What makes a run known and continued.
pub(crate) fn checkpoints(loaded: &Loaded, origin: Origin, simulation: &Simulation) -> Checkpoints {
    let model = &loaded.model;
    Checkpoints::of(model, origin).with_cpu(cpu::user_seconds).with_words(loaded, simulation.part_meshes(model))
}

/// Runs a simulation by `go` and records it by what `make` makes, to the last word.
pub(crate) fn record<'a>(
    recording: Recording<'_>,
    simulation: &mut Simulation,
    make: impl FnOnce(&Simulation, OnProgress<'a>) -> Result<Recorder<'a>, ResultsError>,
    go: impl FnOnce(&mut Simulation, &mut dyn Observer) -> Result<(), Error>,
) -> Result<(), Failure> {
    let Recording { path, manner, ref watched, .. } = recording;
    let interrupt = Interrupt::watch();
    let display = Arc::new(Mutex::new(Display::new(manner.quiet)));
    let reported = Arc::new(Mutex::new(Vec::new()));
    let (seen, shown, notices) = (interrupt.clone(), display.clone(), reported.clone());
    let mut is_reported = false;
    let on_progress = move |progress: &Progress<'_>| {
        let mut display = of(&shown);
        display.update(progress);
        for notice in progress.notices {
            display.say(&CliError::from(notice).to_string());
            of(&notices).push(notice.text.clone());
        }
        if !seen.is_pressed() {
            return Control::Continue;
        }
        if !std::mem::replace(&mut is_reported, true) {
            display.say("stopping; results so far are kept (Ctrl-C again ends at once)");
        }
        Control::Stop
    };
    let mut recorder = make(simulation, Box::new(on_progress)).map_err(in_the_way)?;
    simulation.keep_states_in(ROOM);
    let ran = match watched {
        Some(Watched { live, .. }) => go(simulation, &mut Tap::new(&mut recorder, live.clone(), || interrupt.is_pressed())),
        None => go(simulation, &mut recorder),
    };
    let mut reported_late = Vec::new();
    if let Err(error) = &ran
        && !matches!(error, Error::Output(_) | Error::State(_))
        && !interrupt.is_pressed()
    {
        of(&display).say("the run failed; its last steps are repeated to find the cause (Ctrl-C skips this)");
        reported_late = look_into(&recording, simulation, error, &interrupt, &mut recorder);
    }
    let outcome = recorder.finish(ran.as_ref().err().map(Error::with_code), &simulation.summary(), cpu::user_seconds);
    if let Some(display) = Arc::into_inner(display) {
        display.into_inner().unwrap_or_else(PoisonError::into_inner).close();
    }
    // What went wrong first is what matters.
    let unwritten = outcome.unwritten.map_or(Ok(()), |error| Err(CliError::new(error.kind(), error)));
    if let Some(watched) = watched {
        watched.show_last(simulation, &interrupt);
        watched.end(&outcome.report);
    }
    let result = ran.map_err(|error| CliError::from(&error)).and(unwritten);
    let report = outcome.report;
    reported_late.iter().for_each(|cli_error| terminal::report_error(&cli_error.to_string()));
    if !manner.quiet {
        // Those of the model come first, and have been reported, as has what was seen on the way: the summary
        // says how it continued.
        let reported = of(&reported);
        let of_run = report.warnings.iter().skip(simulation.model_warnings().len());
        let of_run = of_run.filter(|notice| !reported.iter().any(|text: &String| notice.text.starts_with(text)));
        of_run.for_each(|notice| terminal::report_error(&CliError::from(notice).to_string()));
    }
    let is_stopped = interrupt.is_pressed() || watched.as_ref().is_some_and(|watched| watched.live.is_stopped());
    let result = result.map_err(|cli_error| Failure::Run(with_results(cli_error, path))).and_then(|()| {
        if !manner.quiet {
            terminal::print(&closing_text(&report, path))?;
        }
        if recording.is_verbose {
            terminal::print(&search_text(&simulation.searches()))?;
        }
        if is_stopped && report.status == RunStatus::Stopped { Err(Failure::Interrupted) } else { Ok(()) }
    });
    if let Some(watched) = recording.watched {
        watched.close(&interrupt);
    }
    result
}

/// What only one thread ever asks for.
fn of<T>(shared: &Mutex<T>) -> MutexGuard<'_, T> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Finds out how a failure came, writes its page, and keeps the state of the step before, where that is
/// wanted. What goes wrong with that hides nothing.
fn look_into(
    recording: &Recording<'_>,
    simulation: &Simulation,
    error: &Error,
    interrupt: &Interrupt,
    recorder: &mut Recorder<'_>,
) -> Vec<CliError> {
    let Recording { loaded, path, checkpoints, keeps_last_good, manner, .. } = *recording;
    let options = manner.options();
    let failed =
        Failed { model: &loaded.model, loaded, options: &options, simulation, error, checkpoints, keeps_last_good, is_steered: false };
    let mut findings = failed.findings(|| !interrupt.is_pressed());
    let mut complaints = Vec::new();
    let kept = findings.last_good.take().map_or(Ok(()), |state| recorder.state(state).map_err(|error| error.to_string()));
    if let Some(fault) = kept.err().or(findings.fault.take()) {
        complaints.push(CliError::new(&LAST_GOOD, fault));
    }
    match failed.write(&findings, path) {
        Ok(_) => recorder.point_to_post_mortem(),
        Err(error) => complaints.push(CliError::new(&NO_POST_MORTEM, format!("the post-mortem is missing: {error}"))),
    }
    complaints
}

/// A complaint that points to the page about it.
pub(crate) fn with_page(cli_error: CliError, page: &Path) -> CliError {
    cli_error.and(format!("  post-mortem: {}", page.display()))
}

fn with_results(cli_error: CliError, path: &Path) -> CliError {
    let kept: Vec<&str> = FILES.iter().map(|(name, _)| *name).filter(|name| path.join(name).exists()).collect();
    let page = path.join(post_mortem::PAGE);
    let cli_error = if page.exists() { with_page(cli_error, &page) } else { cli_error };
    if kept.is_empty() { cli_error } else { cli_error.and(format!("  results until then: {} ({})", path.display(), kept.join(", "))) }
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
    let mut figures: Vec<Vec<String>> = [
        ["steps".into(), format!("{} to t = {}", grouped(report.steps), with_unit(report.time_end, "s"))],
        ["smallest step".into(), format!("{} ({})", with_unit(report.stable_time_step_min, "s"), report.stable_time_step_governor)],
        ["speed".into(), format!("{speed}{threads}, {}", report.simd)],
        ["energy drift".into(), per_cent(report.energy_drift)],
        ["penetration".into(), format!("{} at most", with_unit(report.penetration_max, "m"))],
    ]
    .map(Vec::from)
    .into();
    if let Some(last) = report.remeshings.last() {
        let text = format!("{} time(s), the last at {}: {} elements", report.remeshings.len(), with_unit(last.time, "s"), last.elements[1]);
        figures.push(vec!["elements made again".into(), text]);
    }
    for flow in &report.flows {
        let steady = flow.steady.map_or("not steady".into(), |time| format!("steady since {}", with_unit(time, "s")));
        figures.push(vec!["flow".into(), format!("\"{}\" passed {:.2} time(s), {steady}", flow.part, flow.passages)]);
    }
    figures.splice(1..1, report.stages.iter().map(|stage| stage.row(|time| with_unit(time, "s")).into()));
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
