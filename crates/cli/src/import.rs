//! `embate import`: a deck of Abaqus or CalculiX becomes a folder with a model, its mesh, and a report of
//! what became of each keyword.

use crate::cli_error::CliError;
use crate::messages::{IGNORED, SOURCE_IN_THE_WAY};
use crate::{Failure, terminal};
use clap::Args;
use embate_files::PathPolicy;
use embate_files::abaqus::import::{self, Imported, MESH_NAME, Units};
use embate_files::results::messages::{EXISTS, REFUSED};
use embate_files::{model_file, results};
use std::path::{Path, PathBuf};

/// Name of the report in the folder.
const REPORT_NAME: &str = "import.txt";

/// Which deck, its units, and where the model goes.
#[derive(Args)]
pub(crate) struct Arguments {
    /// Input deck (.inp)
    deck: PathBuf,
    /// Folder to make for model.toml, mesh.inp and import.txt; its last part names the model
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Units of length, mass and time of the deck's numbers [default: m,kg,s]
    #[arg(long, value_name = "UNITS")]
    units: Option<String>,
    /// Replace files that are there
    #[arg(long)]
    force: bool,
    /// Read files that the deck includes also where they lie outside of its folder
    #[arg(long)]
    allow_outside: bool,
}

pub(crate) fn import(arguments: &Arguments) -> Result<(), Failure> {
    let units = match &arguments.units {
        Some(text) => Units::parse(text).map_err(|fault| Failure::Input(CliError::from([fault].as_slice())))?,
        None => Units::default(),
    };
    let reach = if arguments.allow_outside { PathPolicy::Anywhere } else { PathPolicy::Folder };
    let imported = import::import(&arguments.deck, &units, reach).map_err(|faults| Failure::Input(CliError::from(faults.as_slice())))?;
    let report = imported.report.text();
    write(arguments, &imported, &report)?;
    terminal::print(&report)?;
    let model = arguments.out.join(model_file::FILE_NAME);
    terminal::print(&format!("\n{} is the model; look at it with: embate check {}\n", model.display(), arguments.out.display()))?;
    if let Err(diagnostics) = model_file::load(&model, &[]) {
        return Err(Failure::Incomplete(
            CliError::from(&diagnostics).and(format!("the model that was written has faults: fix them in {}", model.display())),
        ));
    }
    if imported.report.has_ignored() {
        let report = arguments.out.join(REPORT_NAME);
        return Err(Failure::Incomplete(CliError::new(
            &IGNORED,
            format!("something of the deck does not act in the model: see {}", report.display()),
        )));
    }
    Ok(())
}

fn write(arguments: &Arguments, imported: &Imported, report: &str) -> Result<(), Failure> {
    let folder = &arguments.out;
    let files = [(model_file::FILE_NAME, imported.model.as_str()), (MESH_NAME, imported.mesh.as_str()), (REPORT_NAME, report)];
    for (name, _) in files {
        let file = folder.join(name);
        if is_same(&file, &arguments.deck) {
            return Err(Failure::Input(CliError::new(
                &SOURCE_IN_THE_WAY,
                format!("{} is the deck itself; choose another folder", file.display()),
            )));
        }
        if file.exists() && !arguments.force {
            return Err(Failure::Input(CliError::new(
                &EXISTS,
                format!("{} exists; choose another folder, or replace it with --force", file.display()),
            )));
        }
    }
    std::fs::create_dir_all(folder)
        .map_err(|error| Failure::Input(CliError::new(&REFUSED, format!("can't create {}: {error}", folder.display()))))?;
    for (name, text) in files {
        results::write_whole(&folder.join(name), text.as_bytes()).map_err(|error| Failure::Input(CliError::new(error.kind(), error)))?;
    }
    Ok(())
}

fn is_same(one: &Path, other: &Path) -> bool {
    matches!((one.canonicalize(), other.canonicalize()), (Ok(one), Ok(other)) if one == other)
}
