//! `embate diff`: the first step, part and node at which two runs diverge.
//!
//! First by what the runs left: models, and the logs of their hashes, which give the stretch of steps in
//! which they part. Then both are gone over this stretch once more, side by side, and their states compared
//! after each step. Exit codes: 0 the runs are the same, 1 they are not, 2 they can't be compared.

mod words;

use crate::cli_error::CliError;
use crate::input::Leave;
use crate::messages::{NO_RESULTS, NOT_AGAIN, NOTHING_IN_COMMON};
use crate::progress::Display;
use crate::resume::Place;
use crate::{Failure, terminal};
use clap::Args;
use embate_files::checkpoint::Identity;
use embate_files::comparison::{Again, RunLeft, Window, in_step};
use embate_solver::divergence::Pairing;
use embate_solver::error::Error;
use embate_solver::model::Model;
use embate_solver::simulation::Options;
use std::path::{Path, PathBuf};
use words::NAMES;

/// Which runs, and how far to look.
#[derive(Args)]
pub(crate) struct Arguments {
    /// Folder of the results of the first run
    #[arg(value_name = "A")]
    a: PathBuf,
    /// Folder of the results of the second run
    #[arg(value_name = "B")]
    b: PathBuf,
    /// Model file or folder of the first run, if it is not where it was when the run began
    #[arg(long, value_name = "PATH")]
    model_a: Option<PathBuf>,
    /// The same of the second run
    #[arg(long, value_name = "PATH")]
    model_b: Option<PathBuf>,
    /// Only compare what the folders hold: no step is done again
    #[arg(long)]
    logs: bool,
    /// Go over runs without logs (`hashes.csv`) from the start
    #[arg(long, conflicts_with = "logs")]
    whole: bool,
    #[command(flatten)]
    leave: Leave,
    /// No progress
    #[arg(long, short)]
    quiet: bool,
}

pub(crate) fn diff(arguments: &Arguments) -> Result<(), Failure> {
    let runs = [left(&arguments.a)?, left(&arguments.b)?];
    terminal::print(&words::runs(&runs))?;
    let window = match (&runs[0].hashes, &runs[1].hashes) {
        (Some(a), Some(b)) => Some(Window::of(a, b)).filter(|window| window.compared > 0),
        _ => None,
    };
    let last = runs[0].last_step().min(runs[1].last_step());
    let differ_at_the_end = match [&runs[0].end, &runs[1].end] {
        [Some(a), Some(b)] => Some(a.steps != b.steps || a.state_hash != b.state_hash),
        _ => None,
    };
    terminal::print(&words::logs(&runs, window.as_ref()))?;
    let (from, to) = match &window {
        // A run that was killed has no end but its last line.
        Some(Window { differs: None, .. }) if !differ_at_the_end.unwrap_or(runs[0].last_step() != runs[1].last_step()) => return Ok(()),
        Some(Window { same, differs, .. }) => (same.unwrap_or(0), differs.unwrap_or(last)),
        None if differ_at_the_end.is_none() => return Err(unknown(&arguments.a, &arguments.b)),
        None if differ_at_the_end == Some(false) => return Ok(()),
        None if !arguments.whole => {
            terminal::print("with --whole both are gone over once more from the start, to find where they part\n")?;
            return Err(Failure::Different);
        }
        None => (0, last),
    };
    if !arguments.logs {
        match again(arguments, &runs, [from, to]) {
            Err(Unable::Told(reason)) => terminal::report_error(&reason.to_string()),
            Err(Unable::Failure(failure)) => return Err(failure),
            Ok(()) => {}
        }
    }
    Err(Failure::Different)
}

/// Why runs can't be gone over once more.
enum Unable {
    /// What the logs contain is all that is known.
    Told(CliError),
    /// Nothing can be compared, or nothing can be said.
    Failure(Failure),
}

impl From<CliError> for Unable {
    fn from(cli_error: CliError) -> Self {
        Self::Told(cli_error)
    }
}

impl From<Failure> for Unable {
    fn from(failure: Failure) -> Self {
        Self::Failure(failure)
    }
}

/// What a run left.
fn left(folder: &Path) -> Result<RunLeft, Failure> {
    let read = RunLeft::read(folder).map_err(|error| Failure::Input(CliError::new(error.kind(), error)))?;
    read.ok_or_else(|| {
        let cli_error = CliError::new(&NO_RESULTS, format!("{} holds neither summary.json nor hashes.csv", folder.display()));
        Failure::Input(cli_error.help("give the folders that `embate run` wrote"))
    })
}

/// That neither logs nor ends can be compared.
fn unknown(a: &Path, b: &Path) -> Failure {
    let cli_error = CliError::new(
        &NO_RESULTS,
        format!("{} and {} have no step of which both kept the hashes, and not both have ended", a.display(), b.display()),
    );
    Failure::Input(cli_error.help("end them with `embate resume`, or run the models again with the same `output.hash_steps`"))
}

/// Goes over a stretch of both once more, and says where they part in it.
fn again(arguments: &Arguments, runs: &[RunLeft; 2], [from, to]: [u64; 2]) -> Result<(), Unable> {
    let places = [&arguments.model_a, &arguments.model_b].map(|model| Place::at(model.clone(), arguments.leave));
    let mut sides = Vec::new();
    for k in 0..2 {
        let model = model(&runs[k], &places[k], k)?;
        let (options, reported) = options(&runs[k]);
        reported.into_iter().try_for_each(|line| terminal::print(&format!("{}: {line}\n", NAMES[k])))?;
        sides.push(Again::new(&model, &options, &runs[k].folder, from).map_err(|error| CliError::from(&error))?);
    }
    let Ok(mut sides) = <[Again; 2]>::try_from(sides) else { return Ok(()) };
    let pairing = Pairing::new(&sides[0].simulation, &sides[1].simulation);
    if pairing.is_empty() && ends_alike(runs) {
        // Other meshes, the same places and velocities: at rest, say.
        let lines: String = pairing.left_out.iter().map(|line| format!("  {line}\n")).collect();
        return Ok(terminal::print(&format!(
            "both end in the same state, after other steps; no part has the same mesh in both, so there are no nodes to compare on the \
                way\n{lines}"
        ))?);
    }
    if pairing.is_empty() {
        let cli_error = CliError::new(&NOTHING_IN_COMMON, "no part has the same mesh in both runs, so no node has a counterpart");
        return Err(Failure::Input(pairing.left_out.iter().fold(cli_error, |text, line| text.and(format!("  {line}")))).into());
    }
    terminal::print(&words::again(&sides, [from, to], &pairing.left_out))?;
    let mut display = Display::on_terminal(arguments.quiet);
    let mut show = |share: f64, step: u64| display.show(share * step as f64 / to.max(1) as f64, || format!("step {step} of {to}"));
    let mut not_repeated = None;
    for (k, side) in sides.iter_mut().enumerate() {
        // What fails here did not fail when it ran.
        let failed = side.go_to(from, |step| show(0.5, step)).err();
        if failed.is_some() || side.simulation.steps() != from || !side.repeats(runs[k].hashes_at(from)) {
            not_repeated.get_or_insert_with(|| words::not_repeated(k, from, failed.as_ref().map(Error::with_code)));
        }
    }
    if let Some(text) = not_repeated {
        display.close();
        return Ok(terminal::print(&text)?);
    }
    let found = in_step(&pairing, &mut sides, to, |step| show(1.0, step));
    display.close();
    terminal::print(&words::found(&found, &sides))?;
    // They must come to what they logged, else the answer is not about these runs.
    for (k, side) in sides.iter_mut().enumerate() {
        let Some(logged) = runs[k].hashes_at(to) else { continue };
        let failed = side.go_to(to, |_| {}).err();
        if failed.is_some() || side.simulation.steps() != to || !side.repeats(Some(logged)) {
            terminal::print(&words::not_repeated(k, to, failed.as_ref().map(Error::with_code)))?;
        }
    }
    Ok(())
}

/// Whether both have come to their ends with the same hash.
fn ends_alike(runs: &[RunLeft; 2]) -> bool {
    matches!([&runs[0].end, &runs[1].end], [Some(a), Some(b)] if a.state_hash == b.state_hash)
}

/// The model of a run, if it is the one that ran.
fn model(run: &RunLeft, place: &Place, k: usize) -> Result<Model, CliError> {
    let not_again = |text: String| CliError::new(&NOT_AGAIN, format!("{text}; what is reported above is known from the logs"));
    let remedy = format!("name the one that ran with --model-{} PATH", NAMES[k].to_lowercase());
    let Some((origin, identity)) = &run.model else {
        return Err(not_again(format!("run {} does not name its model", NAMES[k])).help("run it again: it leaves run.json, which does"));
    };
    let loaded = place.load(origin, &[]);
    let (loaded, _) = loaded.map_err(|failure| {
        let cli_error = not_again(format!("the model of run {} can't be read", NAMES[k])).help(&remedy);
        match failure {
            Failure::Input(reason) => cli_error.and(reason),
            _ => cli_error,
        }
    })?;
    let changes = Identity::of(&loaded.model).differences_in_steps(identity);
    if changes.is_empty() {
        return Ok(loaded.model);
    }
    let cli_error = not_again(format!("the model of run {} is no longer the one that ran", NAMES[k]));
    let cli_error = changes.iter().fold(cli_error, |text, change| text.and(format!("  {change}")));
    Err(cli_error.help(format!("put it back as it was, or {remedy}")))
}

/// How a run was run, as far as this machine can; what it can't is reported.
fn options(run: &RunLeft) -> (Options, Vec<String>) {
    let Some(end) = &run.end else { return (Options::default(), vec!["it has not ended, so its threads are not known".into()]) };
    let (mut reported, most) = (Vec::new(), Options::default().thread_count());
    if end.threads > most {
        reported.push(format!("this machine has {most} of its {} threads", end.threads));
    }
    let simd = Some(end.simd.clone()).filter(|simd| Options::has(simd));
    if simd.is_none() {
        reported.push(format!("this machine has no {}", end.simd));
    }
    (Options { threads: end.threads.min(most), simd }, reported)
}
