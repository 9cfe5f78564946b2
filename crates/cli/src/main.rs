//! The program `embate`: reads the command line, calls the libraries, turns their errors into messages and
//! exit codes.
//!
//! One file per command. Exit codes: 0 done, 1 a run failed (or a bug), or two runs differ, 2 bad input or
//! command line, 3 imported but not all of it acts, 130 stopped by Ctrl-C or SIGTERM.

mod bench;
mod check;
mod cli_error;
mod completions;
mod cpu;
mod diff;
mod explain;
mod fit;
mod import;
mod in_place;
mod input;
mod interrupt;
mod jobs;
mod list;
mod machine;
mod man;
mod mesh;
mod messages;
mod new;
mod numbers;
mod progress;
mod recording;
mod remesh;
mod replay;
mod report;
mod resume;
mod run;
mod schema;
mod sweep;
mod terminal;
mod verify;
mod version;
mod view;
mod watch;

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser, Subcommand};
use cli_error::CliError;
use embate_files::program;
use std::process::ExitCode;

/// Explicit finite elements for contact-impact between flexible bodies in large deformation.
#[derive(Parser)]
#[command(name = "embate", version = version::short(), long_version = version::long(), arg_required_else_help = true)]
struct CommandLine {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Run a model and write its results
    Run(run::Arguments),
    /// Continue with a run that was stopped, from its newest checkpoint
    Resume(resume::Arguments),
    /// Go through a stretch of a run once more, with denser output
    Replay(replay::Arguments),
    /// Continue a run with another mesh of a part: one of yours, or of Gmsh
    Remesh(remesh::Arguments),
    /// Look at results in the browser, or at two runs side by side
    View(view::Arguments),
    /// Find the first step, part and node at which two runs diverge
    Diff(diff::Arguments),
    /// Write what a run left as one HTML file that can be sent away
    Report(report::Arguments),
    /// Run a model with many values, one run on each core, and write one table
    Sweep(sweep::Arguments),
    /// Find the values of keys with which a model follows what was measured
    Fit(fit::Arguments),
    /// Look at a model without running it: parts, masses, stable step, probes, penetrations, a picture
    Check(check::Arguments),
    /// List elements, materials, searches and output fields with their parameters
    List(list::Arguments),
    /// Make a folder with a commented model to start from
    New(new::Arguments),
    /// Make a model from a deck of Abaqus or CalculiX (.inp), with a report of what became of each keyword
    Import(import::Arguments),
    /// Make a mesh of a CAD file (.step, .iges, .brep) with the program Gmsh, where it is installed
    Mesh(mesh::Arguments),
    /// Run the verification cases and compare with known values
    Verify(verify::Arguments),
    /// Measure how fast this machine is: kernels, whole steps, contact, beside what its memory and arithmetic
    /// allow
    Bench(bench::Arguments),
    /// Explain a message by its code, or list all messages
    Explain(explain::Arguments),
    /// Print the JSON schema of the model file (for completion in editors)
    Schema,
    /// Print what a shell needs to complete the command line: bash, zsh, fish, powershell, elvish
    Completions(completions::Arguments),
    /// Print the manual's page of the program, or write the pages of all commands into a folder
    Man(man::Arguments),
}

/// Why a command did not succeed; the text is what the user reads.
#[derive(Debug)]
enum Failure {
    /// Bad input, or results in the way; nothing was done.
    Input(CliError),
    /// A run failed, or its results could not be written.
    Run(CliError),
    /// Two runs are not the same; this has been reported.
    Different,
    /// A deck was imported, but not all of it acts in the model.
    Incomplete(CliError),
    /// The user stopped a run.
    Interrupted,
}

impl Failure {
    fn code(&self) -> u8 {
        match self {
            Self::Run(_) | Self::Different => 1,
            Self::Input(_) => 2,
            Self::Incomplete(_) => 3,
            Self::Interrupted => 130,
        }
    }
}

fn main() -> ExitCode {
    interrupt::respect_nohup();
    terminal::announce_bugs();
    version::commit().into_iter().for_each(program::built_from);
    let command = match CommandLine::try_parse() {
        Ok(line) => line.command,
        Err(error) => return not_understood(&error),
    };
    // The hook has reported the user about a panic; here it only becomes an exit code.
    let Ok(result) = std::panic::catch_unwind(|| obey(&command)) else {
        return ExitCode::from(1);
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            if let Failure::Input(text) | Failure::Run(text) | Failure::Incomplete(text) = &failure {
                terminal::report_error(&text.to_string());
            }
            ExitCode::from(failure.code())
        }
    }
}

/// Help and version are no errors; an error gets its code in place of the bare word.
fn not_understood(error: &clap::Error) -> ExitCode {
    if matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion | ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand) {
        error.exit();
    }
    let text = error.to_string();
    terminal::report_error(&CliError::new(&messages::USAGE, text.strip_prefix("error: ").unwrap_or(&text)).to_string());
    ExitCode::from(2)
}

fn obey(command: &Command) -> Result<(), Failure> {
    match command {
        Command::Run(arguments) => run::run(arguments),
        Command::Resume(arguments) => resume::resume(arguments),
        Command::Replay(arguments) => replay::replay(arguments),
        Command::Remesh(arguments) => remesh::remesh(arguments),
        Command::View(arguments) => view::view(arguments),
        Command::Diff(arguments) => diff::diff(arguments),
        Command::Report(arguments) => report::report(arguments),
        Command::Sweep(arguments) => sweep::sweep(arguments),
        Command::Fit(arguments) => fit::fit(arguments),
        Command::Check(arguments) => check::check(arguments),
        Command::List(arguments) => list::list(arguments),
        Command::New(arguments) => new::new(arguments),
        Command::Import(arguments) => import::import(arguments),
        Command::Mesh(arguments) => mesh::mesh(arguments),
        Command::Verify(arguments) => verify::verify(arguments),
        Command::Bench(arguments) => bench::bench(arguments),
        Command::Explain(arguments) => explain::explain(arguments),
        Command::Schema => schema::schema(),
        Command::Completions(arguments) => completions::completions(arguments, CommandLine::command()),
        Command::Man(arguments) => man::man(arguments, CommandLine::command()),
    }
}
