//! `embate verify`: the cases of `verification/`, each quantity against its known value.
//!
//! Cases come from `embate-files`; here are the choice of cases, the table and the exit code: 1 when a check
//! fails.

use crate::cli_error::CliError;
use crate::input::Leave;
use crate::interrupt::Interrupt;
use crate::messages::{CHECKS_FAILED, NO_CASE};
use crate::numbers::{table, with_unit};
use crate::progress::Display;
use crate::{Failure, terminal};
use clap::Args;
use embate_files::results::{ResultFolder, write_whole};
use embate_files::verification::report::{self, About, Form};
use embate_files::verification::{self, Case, CaseOutcome, CheckOutcome, Tier, VerifyError};
use embate_solver::bench::Level;
use embate_solver::simulation::{Control, Options, Progress};
use embate_solver::vocabulary::suggestion;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Which cases, and what is kept of them.
#[derive(Args)]
pub(crate) struct Arguments {
    /// Cases by the names of their folders [default: those of tier `every`]
    #[arg(value_name = "CASE")]
    cases: Vec<String>,
    /// All cases, also the long ones
    #[arg(long, conflicts_with = "cases")]
    all: bool,
    /// Only list the cases
    #[arg(long)]
    list: bool,
    /// Folder in which the cases lie
    #[arg(long = "in", value_name = "DIR", default_value = "verification")]
    folder: PathBuf,
    /// Write all figures and verdicts to this file
    #[arg(long, value_name = "FILE", conflicts_with = "list")]
    json: Option<PathBuf>,
    /// Write a report with plots: FILE.html holds everything, FILE.md has its pictures in a folder beside it;
    /// may be repeated
    #[arg(long, value_name = "FILE", conflicts_with = "list", value_parser = report_file)]
    report: Vec<PathBuf>,
    /// Keep the results of the runs in this folder, as DIR/CASE/MODEL
    #[arg(long, value_name = "DIR", conflicts_with = "list")]
    out: Option<PathBuf>,
    /// Replace results that are there
    #[arg(long, requires = "out")]
    force: bool,
    /// No progress
    #[arg(long, short)]
    quiet: bool,
    #[command(flatten)]
    leave: Leave,
}

/// A file in one of the forms that there are.
fn report_file(text: &str) -> Result<PathBuf, String> {
    let file = PathBuf::from(text);
    if Form::of(&file).is_some() { Ok(file) } else { Err("the name of a report ends in .html or .md".to_string()) }
}

pub(crate) fn verify(arguments: &Arguments) -> Result<(), Failure> {
    let cases = chosen(arguments)?;
    if arguments.list {
        return terminal::print(&listed(&cases));
    }
    let options = Options::default();
    // All faults before the first run.
    for case in &cases {
        case.examine(&options).map_err(|error| reported(&error))?;
        for (model, _) in arguments.out.iter().filter(|_| !arguments.force).flat_map(|_| &case.models) {
            let folder = arguments.out.iter().fold(PathBuf::new(), |_, out| out.join(&case.name).join(model));
            ResultFolder::refuse_existing(&folder).map_err(|error| Failure::Input(CliError::new(error.kind(), error)))?;
        }
    }
    let interrupt = Interrupt::watch();
    let mut outcomes = Vec::new();
    let machine = format!("{}, {} threads", Level::best().name(), options.thread_count());
    let mut about = About { program: concat!("embate ", env!("CARGO_PKG_VERSION")).to_string(), machine, seconds: Vec::new() };
    for case in &cases {
        let begin = Instant::now();
        let outcome = verified(case, &options, arguments, &interrupt)?;
        about.seconds.push(begin.elapsed().as_secs_f64());
        terminal::print(&text(&outcome, begin.elapsed().as_secs_f64()))?;
        outcomes.push(outcome);
    }
    if let Some(file) = &arguments.json {
        let mut json = serde_json::to_string_pretty(&outcomes).expect("plain numbers, texts and lists always have a JSON form");
        json.push('\n');
        write_whole(file, json.as_bytes()).map_err(|error| Failure::Run(CliError::new(error.kind(), error)))?;
    }
    for file in &arguments.report {
        report::write(file, &outcomes, &about, &arguments.folder).map_err(|error| Failure::Run(CliError::new(error.kind(), error)))?;
    }
    closing(&outcomes)
}

/// Runs a case; on a terminal with progress.
fn verified(case: &Case, options: &Options, arguments: &Arguments, interrupt: &Interrupt) -> Result<CaseOutcome, Failure> {
    let mut display = Display::on_terminal(arguments.quiet);
    let mut on_progress = |progress: &Progress<'_>| {
        display.update(progress);
        if interrupt.is_pressed() { Control::Stop } else { Control::Continue }
    };
    let keep = arguments.out.as_deref().map(|folder| (folder, arguments.force));
    let outcome = verification::verify(case, options, keep, &mut on_progress);
    display.close();
    if interrupt.is_pressed() {
        return Err(Failure::Interrupted);
    }
    outcome.map_err(|error| reported(&error))
}

/// The cases that are wanted, read.
fn chosen(arguments: &Arguments) -> Result<Vec<Case>, Failure> {
    let names = names(&arguments.folder)?;
    let known: Vec<&str> = names.iter().map(String::as_str).collect();
    if let Some(unknown) = arguments.cases.iter().find(|name| !names.contains(name)) {
        let help = suggestion(unknown, &known);
        return Err(Failure::Input(
            CliError::new(&NO_CASE, format!("there is no case `{unknown}` in {}", arguments.folder.display())).help(help),
        ));
    }
    let mut cases = Vec::new();
    for name in names.iter().filter(|name| arguments.cases.is_empty() || arguments.cases.contains(name)) {
        let case = verification::load(&arguments.folder.join(name), arguments.leave.reach())
            .map_err(|diagnostics| Failure::Input(CliError::from(&diagnostics)))?;
        if !arguments.cases.is_empty() || arguments.all || arguments.list || case.tier == Tier::Every {
            cases.push(case);
        }
    }
    if cases.is_empty() {
        let help = "name cases, or run all with --all";
        return Err(Failure::Input(
            CliError::new(&NO_CASE, format!("no case in {} has tier `every`", arguments.folder.display())).help(help),
        ));
    }
    Ok(cases)
}

/// Names of the folders in which a case lies, sorted.
fn names(folder: &Path) -> Result<Vec<String>, Failure> {
    let nowhere = |why: &str| {
        let shown = folder.display();
        let help = "the cases lie in the folder `verification` of embate's source: go there, or name the folder with --in DIR";
        Failure::Input(CliError::new(&NO_CASE, format!("{shown} {why}")).help(help))
    };
    let entries = std::fs::read_dir(folder).map_err(|error| nowhere(&format!("can't be read as a folder of cases: {error}")))?;
    let cases = entries.flatten().filter(|entry| entry.path().join(verification::FILE_NAME).is_file());
    let mut names: Vec<String> = cases.filter_map(|entry| entry.file_name().into_string().ok()).collect();
    names.sort();
    if names.is_empty() { Err(nowhere(&format!("holds no case: no folder with {} in it", verification::FILE_NAME))) } else { Ok(names) }
}

fn reported(error: &VerifyError) -> Failure {
    match error {
        VerifyError::Expected(diagnostics) => Failure::Input(CliError::from(diagnostics)),
        VerifyError::Model { case, name, error } => {
            Failure::Input(CliError::from(error).under(format!("model `{name}` of the case `{case}`")))
        }
        VerifyError::Results(error) => Failure::Run(CliError::new(error.kind(), error)),
    }
}

fn listed(cases: &[Case]) -> String {
    let mut rows = vec![["case", "tier", "models", "checks", "title"].map(String::from).to_vec()];
    rows.extend(cases.iter().map(|case| {
        let tier = if case.tier == Tier::Every { "every" } else { "all" };
        let checks: usize = case.checks.iter().map(|check| check.models.len()).sum();
        vec![case.name.clone(), tier.to_string(), case.models.len().to_string(), checks.to_string(), case.title.clone()]
    }));
    table(&rows, "")
}

/// A case as a table.
fn text(outcome: &CaseOutcome, seconds: f64) -> String {
    let mut rows = vec![["check", "model", "expected", "found", "deviation", "verdict"].map(String::from).to_vec()];
    rows.extend(outcome.checks.iter().map(row));
    format!("{}: {} ({})\n{}\n", outcome.case, outcome.title, with_unit(seconds, "s"), table(&rows, "  "))
}

fn row(check: &CheckOutcome) -> Vec<String> {
    vec![check.check.clone(), check.model.clone(), check.expectation(), check.finding(), check.error(), check.verdict()]
}

/// How many checks hold; those that don't are a failure.
fn closing(outcomes: &[CaseOutcome]) -> Result<(), Failure> {
    let checks = outcomes.iter().flat_map(|outcome| &outcome.checks);
    let (count, failed) = checks.fold((0, 0), |(count, failed), check| (count + 1, failed + u32::from(!check.passed)));
    let cases: Vec<&str> = outcomes.iter().filter(|outcome| !outcome.passed()).map(|outcome| outcome.case.as_str()).collect();
    if cases.is_empty() {
        return terminal::print(&format!("all {count} checks hold (cases: {})\n", outcomes.len()));
    }
    Err(Failure::Run(CliError::new(&CHECKS_FAILED, format!("{failed} of {count} checks fail, in {}", cases.join(", ")))))
}
