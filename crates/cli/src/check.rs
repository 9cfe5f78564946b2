//! `embate check`: what a model is, without running it, and a picture of its mesh.

use crate::cli_error::CliError;
use crate::input::{self, ModelArguments};
use crate::numbers::{grouped, table, with_unit};
use crate::{Failure, terminal};
use clap::Args;
use embate_files::results::messages::NO_PICTURES;
use embate_files::{picture, results};
use embate_solver::model::Model;
use embate_solver::simulation::{Options, Overview, Simulation};
use std::path::{Path, PathBuf};

/// Which model, and where the picture goes.
#[derive(Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    model: ModelArguments,
    /// Folder for check.png [default: results/NAME]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

pub(crate) fn check(arguments: &Arguments) -> Result<(), Failure> {
    let loaded = input::load(&arguments.model)?;
    let model = &loaded.model;
    let simulation = input::ready(model, &Options::default())?;
    input::warn(&loaded, &simulation);
    let mut text = overview_text(model, &simulation.overview());
    let folder = input::folder(arguments.out.as_deref(), input::default_folder(model))?;
    match draw(model, &simulation, &folder) {
        Ok(path) => text.push_str(&format!("picture: {}\n", path.display())),
        Err(message) => terminal::report_error(&CliError::new(&NO_PICTURES, message).to_string()),
    }
    terminal::print(&text)
}

fn overview_text(model: &Model, overview: &Overview) -> String {
    let mut rows = vec![["part", "elements", "nodes", "mass", "stable step"].map(ToString::to_string).to_vec()];
    rows.extend(overview.parts.iter().map(|part| {
        vec![
            part.name.clone(),
            grouped(part.elements as u64),
            grouped(part.nodes as u64),
            if model.is_of_whole_bodies() { format!("{:.4e} kg", part.mass) } else { format!("{:.4} kg/m", part.mass) },
            with_unit(part.stable_time_step, "s"),
        ]
    }));
    let mut text = format!("{}\n{}", model.name, table(&rows, "  "));
    text.push_str(&format!(
        "first time step {} (governed by {}), about {} steps to {}\n",
        with_unit(overview.stable_time_step, "s"),
        overview.governor,
        grouped(overview.steps_expected),
        with_unit(model.run.end, "s")
    ));
    let warnings = overview.warnings.iter().map(ToString::to_string).collect();
    for (title, lines) in [("probes", &overview.probes), ("initial penetrations", &overview.initial_penetrations), ("warnings", &warnings)]
    {
        if !lines.is_empty() {
            text.push_str(&format!("{title}\n  {}\n", lines.join("\n  ")));
        }
    }
    if overview.initial_penetrations.is_empty() {
        text.push_str("no initial penetrations\n");
    }
    text
}

/// Draws the mesh.
fn draw(model: &Model, simulation: &Simulation, folder: &Path) -> Result<PathBuf, String> {
    std::fs::create_dir_all(folder).map_err(|error| format!("can't create {}: {error}", folder.display()))?;
    let path = folder.join("check.png");
    let drawn = picture::mesh_png(&simulation.frame(), &simulation.cells(), &results::film_settings(model), &path);
    drawn.map(|()| path).map_err(|error| error.to_string())
}
