//! `embate remesh`: a part of a run that stands goes over to another mesh, and the run continues with it in a
//! folder of its own.

use crate::cli_error::CliError;
use crate::input;
use crate::mesh::GmshArguments;
use crate::numbers::{grouped, with_unit};
use crate::recording::{self, Manner, Recording, in_the_way};
use crate::replay::nearest;
use crate::resume::{Place, newest, ready, refuse_changes, usage};
use crate::{Failure, terminal};
use clap::{ArgGroup, Args};
use embate_files::checkpoint::{Exchanged, Identity, Origin};
use embate_files::model_file::{self, Loaded};
use embate_files::results::messages::EXISTS;
use embate_files::results::{self, Recorder, ResultFolder};
use embate_files::{cad, mesh_file, stl};
use embate_solver::error::{Error, Fault};
use embate_solver::model::ImportedMesh;
use embate_solver::output::Remeshing;
use embate_solver::simulation::Simulation;
use std::path::{Path, PathBuf};

/// Which part of which run, and its other mesh.
#[derive(Args)]
#[command(group(ArgGroup::new("what").required(true).multiple(true).args(["mesh", "size", "outline"])))]
pub(crate) struct Arguments {
    /// Folder of the results of the run
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Part that gets another mesh
    #[arg(long, value_name = "NAME")]
    part: String,
    /// Mesh of the part as it is then: a file of Gmsh (.msh) or a deck (.inp)
    #[arg(long, value_name = "FILE", conflicts_with_all = ["size", "outline"])]
    mesh: Option<PathBuf>,
    /// Group of the mesh that holds the elements, if there are several
    #[arg(long, value_name = "GROUP", requires = "mesh")]
    group: Option<String>,
    /// Let Gmsh fill the outline of the part with tetrahedra of this length of edges, "2 mm" for example
    #[arg(long, value_name = "LENGTH", value_parser = model_file::length, conflicts_with = "outline")]
    size: Option<f64>,
    /// Write the outline of the part as it is then as triangles (.stl), and end: from it a mesh can be made
    #[arg(long, value_name = "FILE")]
    outline: Option<PathBuf>,
    /// Length of one unit of the mesh file, or of the outline: "1 mm" of most programs
    #[arg(long, value_name = "LENGTH", default_value = "1 m", value_parser = model_file::length)]
    scale: f64,
    /// Time at which the part gets it, to which the run is done again; default: its newest checkpoint
    #[arg(long, value_name = "TIME", value_parser = model_file::time)]
    at: Option<f64>,
    /// Folder for the results from then on [default: DIR-remeshed]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    gmsh: GmshArguments,
    #[command(flatten)]
    place: Place,
    #[command(flatten)]
    manner: Manner,
    /// Replace results, or an outline, that are there
    #[arg(long)]
    force: bool,
}

pub(crate) fn remesh(arguments: &Arguments) -> Result<(), Failure> {
    let out = match &arguments.outline {
        Some(file) if file.exists() && !arguments.force => {
            let text = format!("{} exists; name another file, or replace it with --force", file.display());
            return Err(Failure::Input(CliError::new(&EXISTS, text)));
        }
        Some(_) => None,
        None => {
            let out = input::folder(arguments.out.as_deref(), remeshed(&arguments.folder))?;
            if !arguments.force {
                ResultFolder::refuse_existing(&out).map_err(in_the_way)?;
            }
            Some(out)
        }
    };
    let (mut simulation, loaded, origin) = standing(arguments)?;
    let Some(out) = out else {
        let text = outline(arguments, &simulation)?;
        return terminal::print(&text);
    };
    let mesh = mesh_of(arguments, &simulation)?;
    let (step, place) = (simulation.steps(), mesh.source.clone());
    let made = simulation.exchange(&loaded.model, &arguments.part, mesh, arguments.group.as_deref());
    let event = made.map_err(|error| Failure::Input(not_exchanged(&error)))?;
    simulation.begin_reports();
    if !arguments.manner.quiet {
        terminal::report_error(&described(&event));
    }
    let absolute = |path: &Path| std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
    let exchanged = Exchanged { run: absolute(&arguments.folder), step, part: arguments.part.clone(), mesh: absolute(Path::new(&place)) };
    continued(arguments, (simulation, &loaded), Origin { exchanged: Some(exchanged), ..origin }, &out)
}

/// The folder beside that of a run.
fn remeshed(folder: &Path) -> PathBuf {
    let mut name = folder.file_name().map_or_else(|| "run".into(), ToOwned::to_owned);
    name.push("-remeshed");
    folder.with_file_name(name)
}

/// The run at the time that is wanted.
fn standing(arguments: &Arguments) -> Result<(Simulation, Loaded, Origin), Failure> {
    let (options, place) = (arguments.manner.options(), &arguments.place);
    let may = "the end, limits, checkpoints and output may change";
    let Some(at) = arguments.at else {
        let past = newest(&arguments.folder, &options)?;
        let (loaded, origin) = place.load(&past.origin, &[])?;
        refuse_changes(&Identity::of(&loaded.model).differences(&past.identity), may)?;
        return Ok((ready(&loaded.model, &options, &past)?, loaded, origin));
    };
    let (origin, past) = nearest(&arguments.folder, at, &options, place)?;
    let (loaded, origin) = place.load(&origin, &[])?;
    if at >= loaded.model.run.end {
        return Err(usage(format!("--at {at:e} s: the run ends at {:e} s", loaded.model.run.end)));
    }
    let mut simulation = match &past {
        Some(past) => {
            refuse_changes(&Identity::of(&loaded.model).differences(&past.identity), may)?;
            ready(&loaded.model, &options, past)?
        }
        None => input::ready(&loaded, &options)?,
    };
    if !arguments.manner.quiet && simulation.time() < at {
        let (from, to) = (with_unit(simulation.time(), "s"), with_unit(at, "s"));
        terminal::report_error(&format!("the run is done again from {from} to {to}"));
    }
    simulation.advance(at * (1.0 - 1e-12), u64::MAX).map_err(|error| Failure::Run(CliError::from(&error)))?;
    Ok((simulation, loaded, origin))
}

/// Writes the outline of the part.
fn outline(arguments: &Arguments, simulation: &Simulation) -> Result<String, Failure> {
    let (text, triangles) = triangles(arguments, simulation, arguments.scale)?;
    let file = arguments.outline.clone().unwrap_or_default();
    results::write_whole(&file, text.as_bytes()).map_err(|error| Failure::Input(CliError::new(error.kind(), error)))?;
    let (part, unit) = (&arguments.part, with_unit(arguments.scale, "m"));
    Ok(format!(
        "{}: {} triangles of part \"{part}\" at {}, in units of {unit}\n",
        file.display(),
        grouped(triangles as u64),
        with_unit(simulation.time(), "s")
    ))
}

/// The outline of the part as the text of an STL file, and how many triangles that are.
fn triangles(arguments: &Arguments, simulation: &Simulation, scale: f64) -> Result<(String, usize), Failure> {
    let cells = simulation.cells();
    let Some(part) = cells.part_names.iter().position(|name| *name == arguments.part) else {
        return Err(usage(format!("--part {}: the parts are {}", arguments.part, cells.part_names.join(", "))));
    };
    if simulation.dimension() == 2 {
        return Err(usage("the model is a 2D one, in which `[[remesh]]` makes elements again by itself; --mesh takes a mesh of your own"));
    }
    stl::outline(&cells, &simulation.coordinates(), part, scale).map_err(|fault| Failure::Input(CliError::from([fault].as_slice())))
}

/// The mesh that the part goes over to.
fn mesh_of(arguments: &Arguments, simulation: &Simulation) -> Result<ImportedMesh, Failure> {
    let refused = |faults: Vec<Fault>| Failure::Input(CliError::from(faults.as_slice()));
    let Some(path) = &arguments.mesh else {
        let size = arguments.size.unwrap_or_default();
        // In units of the size, whatever it is.
        let (text, _) = triangles(arguments, simulation, size)?;
        let job = cad::Filling { triangles: text, size: 1.0, program: arguments.gmsh.program(), limit: arguments.gmsh.limit() };
        return job.mesh(size).map_err(refused);
    };
    mesh_file::read(path, arguments.scale).map_err(refused)
}

fn not_exchanged(error: &Error) -> CliError {
    match error {
        Error::Model(faults) => CliError::from(faults.as_slice()),
        other => CliError::from(other),
    }
}

/// What has changed, in a line.
fn described(event: &Remeshing) -> String {
    let Remeshing { part, time, elements, quality, time_step, volume_change, .. } = event;
    format!(
        "part \"{part}\" continues at {} with {} elements instead of {}: least scaled Jacobian {:.2} instead of {:.2}, stable step {} instead \
         of {}, volume {:+.3} %",
        with_unit(*time, "s"),
        grouped(elements[1] as u64),
        grouped(elements[0] as u64),
        quality[1],
        quality[0],
        with_unit(time_step[1], "s"),
        with_unit(time_step[0], "s"),
        100.0 * volume_change
    )
}

/// Runs it to its end.
fn continued(arguments: &Arguments, (mut simulation, loaded): (Simulation, &Loaded), origin: Origin, out: &Path) -> Result<(), Failure> {
    let options = arguments.manner.options();
    input::warn_of_threads(&simulation, &arguments.manner);
    let state = simulation.state().map_err(|error| Failure::Run(CliError::from(&error)))?;
    let folder = ResultFolder::create(out, arguments.force).map_err(in_the_way)?;
    let make = |simulation: &Simulation, on_progress| {
        let shown = (simulation.history_columns(), simulation.cells());
        let checkpoints = recording::checkpoints(loaded, origin, simulation);
        let mut recorder = Recorder::keeping(folder, &loaded.model, shown, options.thread_count(), Some(checkpoints), on_progress)?;
        // Without it nothing leads back here.
        recorder.keep(state)?;
        Ok(recorder)
    };
    let recording = Recording::of(loaded, out, &arguments.manner, false);
    recording::record(recording, &mut simulation, make, Simulation::run)
}
