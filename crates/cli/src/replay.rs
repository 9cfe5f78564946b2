//! `embate replay`: a stretch of a run once more, from the nearest checkpoint before it, with denser output
//! and the same bits.

use crate::Failure;
use crate::cli_error::CliError;
use crate::input;
use crate::recording::{self, Manner, Recording, in_the_way};
use crate::resume::{Place, ready, refuse_changes, usage};
use clap::Args;
use embate_files::checkpoint::messages::NO_CHECKPOINT;
use embate_files::checkpoint::{self, Checkpoint, Identity, Origin};
use embate_files::model_file;
use embate_files::results::{Provenance, Recorder, ResultFolder};
use embate_files::threads::Threads;
use embate_solver::model::Model;
use embate_solver::simulation::{Observer, Options, Simulation};
use std::path::{Path, PathBuf};

/// Which run, which stretch of it, and where to.
#[derive(Args)]
pub(crate) struct Arguments {
    /// Folder of the results of the run
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Time at which the stretch begins, "3.1 ms" for example
    #[arg(long, value_name = "TIME", value_parser = model_file::time)]
    from: f64,
    /// Time at which it ends
    #[arg(long, value_name = "TIME", value_parser = model_file::time)]
    to: f64,
    /// Time between two frames and two rows; shorter than a step: every step
    #[arg(long, value_name = "TIME", value_parser = model_file::time)]
    output_every: f64,
    /// Folder for the results [default: DIR/replay]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    place: Place,
    #[command(flatten)]
    manner: Manner,
    /// Replace results that are there
    #[arg(long)]
    force: bool,
}

pub(crate) fn replay(arguments: &Arguments) -> Result<(), Failure> {
    let Arguments { from, to, output_every, .. } = *arguments;
    if from >= to || output_every <= 0.0 {
        return Err(usage("a stretch begins before it ends, and has some time between its outputs"));
    }
    let path = input::folder(arguments.out.as_deref(), arguments.folder.join("replay"))?;
    if !arguments.force {
        ResultFolder::refuse_existing(&path).map_err(in_the_way)?;
    }
    let options = arguments.manner.options();
    let (origin, past) = nearest(&arguments.folder, from, &options, &arguments.place)?;
    let (mut loaded, _) = arguments.place.load(&origin, &[])?;
    // A run that ended by its number of steps may be looked at beyond them.
    loaded.model.run.max_steps = None;
    let model = &loaded.model;
    let mut simulation = match &past {
        Some(past) => {
            refuse_changes(&Identity::of(model).differences_in_steps(&past.identity), "limits, checkpoints and output may change")?;
            ready(model, &options, past)?
        }
        None => input::ready(&loaded, &options)?,
    };
    input::warn(&loaded, &simulation);
    let folder = ResultFolder::create(&path, arguments.force).map_err(in_the_way)?;
    // For the recorder the stretch is all there is.
    let mut stretch = Model { ..model.clone() };
    (stretch.run.end, stretch.run.checkpoint, stretch.run.checkpoint_steps) = (to.min(model.run.end), None, None);
    let make = |simulation: &Simulation, on_progress| {
        Recorder::new(folder, &stretch, simulation.history_columns(), simulation.cells(), options.thread_count(), on_progress)
    };
    let window = |simulation: &mut Simulation, observer: &mut dyn Observer| simulation.run_window([from, to], output_every, observer);
    let of_run = Recording::of(&loaded, &path, &arguments.manner, false);
    recording::record(Recording { checkpoints: &arguments.folder, keeps_last_good: false, ..of_run }, &mut simulation, make, window)
}

/// Where the model of a run came from, and its newest checkpoint that is not after a time; without one the
/// run begins again.
pub(crate) fn nearest(path: &Path, time: f64, options: &Options, place: &Place) -> Result<(Origin, Option<Checkpoint>), Failure> {
    let threads = Threads::new(options.thread_count());
    let mut origin = None;
    let mut limit = u64::MAX;
    while let Ok((checkpoint, _)) = checkpoint::newest(path, &threads, |generation| generation.step < limit) {
        if checkpoint.state.time <= time {
            return Ok((checkpoint.origin.clone(), Some(checkpoint)));
        }
        limit = checkpoint.state.step;
        origin = Some(checkpoint);
    }
    // From the start; what the model must be is known all the same.
    let (origin, identity) = match origin {
        Some(checkpoint) => (checkpoint.origin, checkpoint.identity),
        None => match Provenance::read(path).map_err(in_the_way)? {
            Some(ran) => (ran.origin(), ran.keys),
            None => {
                let cli_error = CliError::new(&NO_CHECKPOINT, format!("{} holds neither a checkpoint nor run.json", path.display()));
                return Err(Failure::Input(cli_error.help("give the folder that `embate run` wrote: results/NAME, or that of --out")));
            }
        },
    };
    if let Some(begun) = &origin.exchanged {
        let text = format!(
            "{} keeps no checkpoint from before that time, and began on another mesh of part `{}`, at step {}",
            path.display(),
            begun.part,
            begun.step
        );
        let again = if begun.run.as_os_str().is_empty() { "do again what began it" } else { "`embate remesh` again" };
        let help = format!("take a later time, or {again}, with `run.checkpoint = 0` so that its first state stays");
        return Err(Failure::Input(CliError::new(&NO_CHECKPOINT, text).help(help)));
    }
    let (loaded, _) = place.load(&origin, &[])?;
    refuse_changes(&Identity::of(&loaded.model).differences_in_steps(&identity), "limits, checkpoints and output may change")?;
    Ok((origin, None))
}
