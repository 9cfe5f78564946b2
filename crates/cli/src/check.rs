//! `embate check`: what a model is, without running it, and a picture of its mesh.

use crate::cli_error::CliError;
use crate::input::{self, ModelArguments};
use crate::numbers::{grouped, table, with_unit};
use crate::{Failure, terminal};
use clap::Args;
use embate_files::preview::{Preview, Source};
use embate_files::results::messages::NO_PICTURES;
use embate_files::{picture, results};
use embate_solver::model::Model;
use embate_solver::simulation::{CostlyElement, Options, Overview, TimeStepCosts};
use std::path::{Path, PathBuf};

/// Which model, and where the picture goes.
#[derive(Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    model: ModelArguments,
    /// Folder for check.png, which is replaced [default: results/NAME]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Show the hundred elements with the shortest stable steps, and the first step without them
    #[arg(long)]
    time_step: bool,
}

/// Elements that `--time-step` shows.
const WORST: usize = 100;

pub(crate) fn check(arguments: &Arguments) -> Result<(), Failure> {
    let ModelArguments { model: path, set, leave } = &arguments.model;
    let make = |model: &Model| input::simulation(model, &Options::default());
    let (preview, simulation) = Source::read(path, set, leave.reach()).preview(&make);
    let (Some(model), Some(simulation), Some(overview)) = (&preview.model, simulation, &preview.overview) else {
        // What is faulty is seen best in the picture, where there is one.
        if let Some(model) = preview.model.as_ref().filter(|_| preview.has_bodies())
            && let Ok(folder) = input::folder(arguments.out.as_deref(), input::default_folder(model))
            && let Ok(picture) = draw(model, &preview, &folder)
        {
            terminal::print(&format!("picture: {}\n", picture.display()))?;
        }
        return Err(Failure::Input(CliError::from(&preview.faults)));
    };
    if preview.warnings.count > 0 {
        terminal::report_error(&preview.warnings.rendered);
    }
    let mut text = overview_text(model, overview);
    if arguments.time_step {
        text.push_str(&time_step_text(model, &simulation.time_step_costs(WORST)));
    }
    let folder = input::folder(arguments.out.as_deref(), input::default_folder(model))?;
    match draw(model, &preview, &folder) {
        Ok(path) => text.push_str(&format!("picture: {}\n", path.display())),
        Err(message) => terminal::report_error(&CliError::new(&NO_PICTURES, message).to_string()),
    }
    terminal::print(&text)
}

fn overview_text(model: &Model, overview: &Overview) -> String {
    let mut text = format!("{}\n{}", model.name, table(&parts_table(model, overview), "  "));
    text.push_str(&format!(
        "first time step {} (governed by {}), about {} steps to {}\n",
        with_unit(overview.stable_time_step, "s"),
        overview.governor,
        grouped(overview.steps_expected),
        with_unit(model.run.end, "s")
    ));
    let warnings = overview.warnings.iter().map(ToString::to_string).collect();
    let lists = [
        ("contacts of tied or joined parts", &overview.contacts),
        ("probes", &overview.probes),
        ("initial penetrations", &overview.initial_penetrations),
        ("warnings", &warnings),
    ];
    for (title, lines) in lists {
        if !lines.is_empty() {
            text.push_str(&format!("{title}\n  {}\n", lines.join("\n  ")));
        }
    }
    if overview.initial_penetrations.is_empty() {
        text.push_str("no initial penetrations\n");
    }
    text
}

/// A row for each part: its elements by kind, nodes, mass, size, wave speed and stable step, and who governs.
fn parts_table(model: &Model, overview: &Overview) -> Vec<Vec<String>> {
    let head = ["part", "elements", "nodes", "mass", "size", "waves", "stable step"];
    let unit = if model.is_of_whole_bodies() { "kg" } else { "kg/m" };
    let mut rows = vec![head.map(ToString::to_string).to_vec()];
    rows.extend(overview.parts.iter().map(|part| {
        let kinds: Vec<String> = part.kinds.iter().map(|(kind, count)| format!("{} {kind}", grouped(*count as u64))).collect();
        let step = match (part.is_rigid, part.governs) {
            (true, _) => "rigid".to_string(),
            (_, true) => format!("{}, governs", with_unit(part.stable_time_step, "s")),
            _ => with_unit(part.stable_time_step, "s"),
        };
        vec![
            part.name.clone(),
            kinds.join(" + "),
            grouped(part.nodes as u64),
            mass(part.mass, unit),
            sides(&part.size),
            with_unit(part.wave_speed, "m/s"),
            step,
        ]
    }));
    rows
}

/// Four digits of a mass, in a unit that is near.
fn mass(value: f64, unit: &str) -> String {
    match value.abs() {
        size if size >= 1e6 || (size < 1e-6 && size > 0.0) => format!("{value:.3e} {unit}"),
        size if size >= 1.0 || size == 0.0 => format!("{} {unit}", significant_digits(value)),
        _ => with_unit(1e3 * value, &unit.replacen("kg", "g", 1)),
    }
}

/// The sides of a box in one unit: `94 x 20 x 300 mm`.
fn sides(size: &[f64]) -> String {
    let longest = size.iter().copied().fold(0.0, f64::max);
    const UNITS: [(f64, &str); 5] = [(1e3, "km"), (1.0, "m"), (1e-3, "mm"), (1e-6, "µm"), (1e-9, "nm")];
    // Up to 10 m in mm, as drawings have it.
    let (scale, unit) = match longest {
        longest if longest >= 1e4 => UNITS[0],
        longest if longest >= 10.0 => UNITS[1],
        longest if longest >= 1e-3 => UNITS[2],
        longest if longest >= 1e-6 => UNITS[3],
        _ => UNITS[4],
    };
    let sides: Vec<String> = size.iter().map(|side| significant_digits(side / scale)).collect();
    format!("{} {unit}", sides.join(" x "))
}

/// Four significant digits at most.
fn significant_digits(value: f64) -> String {
    let whole = if value.abs() >= 1.0 { 1 + value.abs().log10().floor() as usize } else { 1 };
    let text = format!("{value:.*}", 4usize.saturating_sub(whole));
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_string() } else { text }
}

/// The worst elements, and the first step by nodes and by the assembled mesh.
fn time_step_text(model: &Model, costs: &TimeStepCosts) -> String {
    let steps = |time_step: f64| if time_step.is_finite() { grouped((model.run.end / time_step).ceil() as u64) } else { "-".into() };
    let shown = |time_step: f64| if time_step.is_finite() { with_unit(time_step, "s") } else { "-".into() };
    let head = ["element", "of part", "at, m", "stable step", "without it and those above", "steps"];
    let mut rows = vec![head.map(ToString::to_string).to_vec()];
    rows.extend(costs.elements.iter().map(|CostlyElement { part, number, at, time_step, without }| {
        let at: Vec<String> = at.iter().map(|x| format!("{x:.4e}")).collect();
        vec![number.to_string(), part.clone(), at.join(", "), shown(*time_step), shown(*without), steps(*without)]
    }));
    let other = |how: &str, value: &str, first: &Option<(f64, String)>, none: &str| match first {
        Some((time_step, governor)) => format!(
            "{how} (run.stable_step = \"{value}\") the first step is {} (governed by {governor}), about {} steps\n",
            shown(*time_step),
            steps(*time_step)
        ),
        None => format!("{how} (run.stable_step = \"{value}\") the first step is {none}\n"),
    };
    let by_nodes = other("by nodes", "nodes", &costs.by_nodes, "the same");
    let by_mesh = other("by the assembled mesh", "assembled", &costs.by_assembled_mesh, "not so much longer that it saves what it costs");
    let subcycling = format!(
        "with subcycling (run.subcycling = true) {:.0} % of the elements are evaluated per step, where nothing touches\n",
        100.0 * costs.with_subcycling
    );
    format!("shortest stable steps, safety included\n{}{by_nodes}{by_mesh}{subcycling}", table(&rows, "  "))
}

/// Draws the mesh, with what acts on it and what is faulty.
fn draw(model: &Model, preview: &Preview, folder: &Path) -> Result<PathBuf, String> {
    std::fs::create_dir_all(folder).map_err(|error| format!("can't create {}: {error}", folder.display()))?;
    let path = folder.join("check.png");
    let shown = (&preview.frame, &preview.cells, &preview.glyphs[..]);
    let drawn = picture::model_png(shown, &results::film_settings(model), &path);
    drawn.map(|()| path).map_err(|error| error.to_string())
}
