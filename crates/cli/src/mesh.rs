//! `embate mesh`: the user's own Gmsh makes a mesh of a CAD file.

use crate::cli_error::CliError;
use crate::numbers::table;
use crate::{Failure, terminal};
use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use embate_files::cad::{Job, UNITS, Unit};
use embate_files::results::messages::EXISTS;
use embate_files::{model_file, results};
use std::ffi::OsString;
use std::path::PathBuf;
use std::time::Duration;

/// Which CAD file, how fine, and where the mesh goes.
#[derive(Args)]
pub(crate) struct Arguments {
    /// CAD file (.step, .stp, .iges, .igs, .brep) with one or more solids
    geometry: PathBuf,
    /// Largest length of an edge of the mesh, "2 mm" for example
    #[arg(long, value_name = "LENGTH", value_parser = model_file::length)]
    size: f64,
    /// 1: tetrahedra of four nodes, which get straight edges with a node in the middle; 2: of ten nodes,
    /// whose edges follow the curved surface
    #[arg(long, value_name = "ORDER", default_value_t = 1, value_parser = clap::value_parser!(u8).range(1..=2))]
    order: u8,
    /// File for the mesh [default: that of the CAD file, with .msh at its end]
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Unit of the lengths in the mesh file
    #[arg(long, value_name = "UNIT", default_value = UNITS[0].name, value_parser = units())]
    unit: Unit,
    #[command(flatten)]
    gmsh: GmshArguments,
    /// Replace a mesh that is there
    #[arg(long)]
    force: bool,
}

/// The program Gmsh, and how long it may take.
#[derive(Args)]
pub(crate) struct GmshArguments {
    /// The program Gmsh, a name that is looked for on PATH, or a path [default: EMBATE_GMSH of the
    /// environment, or gmsh]
    #[arg(long, value_name = "PROGRAM")]
    gmsh: Option<OsString>,
    /// Longest time that Gmsh may take
    #[arg(long, value_name = "TIME", default_value = "10 min", value_parser = model_file::time)]
    timeout: f64,
}

impl GmshArguments {
    pub(crate) fn program(&self) -> OsString {
        let of_environment = || std::env::var_os("EMBATE_GMSH").filter(|name| !name.is_empty());
        self.gmsh.clone().or_else(of_environment).unwrap_or_else(|| "gmsh".into())
    }

    pub(crate) fn limit(&self) -> Duration {
        Duration::try_from_secs_f64(self.timeout).unwrap_or(Duration::MAX)
    }
}

fn units() -> impl TypedValueParser<Value = Unit> {
    let names: PossibleValuesParser = UNITS.iter().map(|unit| PossibleValue::new(unit.name)).collect::<Vec<_>>().into();
    names.map(|name| UNITS.into_iter().find(|unit| unit.name == name).unwrap_or(UNITS[0]))
}

pub(crate) fn mesh(arguments: &Arguments) -> Result<(), Failure> {
    let out = arguments.out.clone().unwrap_or_else(|| arguments.geometry.with_extension("msh"));
    if out.exists() && !arguments.force {
        let text = format!("{} exists; name another file with --out, or replace it with --force", out.display());
        return Err(Failure::Input(CliError::new(&EXISTS, text)));
    }
    let job = Job {
        geometry: arguments.geometry.clone(),
        size: arguments.size,
        unit: arguments.unit,
        order: arguments.order,
        program: arguments.gmsh.program(),
        limit: arguments.gmsh.limit(),
    };
    let made = job.mesh().map_err(|faults| Failure::Input(CliError::from(faults.as_slice())))?;
    results::write_whole(&out, &made.file).map_err(|error| Failure::Input(CliError::new(error.kind(), error)))?;
    let (rows, hidden) = made.groups();
    let mut text = format!("{}: {}\n{}", out.display(), made.summary(), table(&rows, "  "));
    if hidden > 0 {
        text.push_str(&format!("  and {hidden} more faces\n"));
    }
    if made.bodies() > 1 {
        text.push_str("bodies share no nodes: let them touch by a [[contact]], or tie them with `tied = true`\n");
    }
    let name = out.file_name().map(PathBuf::from).unwrap_or_default();
    text.push_str(&format!("\nparts for a model beside it:\n\n{}", made.parts(&name)));
    terminal::print(&text)
}
