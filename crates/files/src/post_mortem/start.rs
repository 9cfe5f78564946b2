//! Failures at the start, where there is no run: more mass than its limit, more memory than there may be.
//!
//! The page has what the model needs: which elements ask for the mass, which parts for the memory.

use super::advice::Advice;
use super::page::{causes, neighbourhood_of, place_in, point, shown, table};
use super::plots::mass as mass_plot;
use super::{Files, write};
use crate::model_file::Loaded;
use crate::picture::neighbourhood::Panel;
use crate::picture::space::Spot;
use crate::results::{FolderLock, ResultsError};
use embate_solver::error::{Fault, MASS_SCALING, MEMORY};
use embate_solver::model::Model;
use embate_solver::post_mortem::MassNeeded;
use embate_solver::simulation::Options;
use std::fs;
use std::path::{Path, PathBuf};

/// The page of a model that can't begin because of what its numbers need: more mass than its limit, more
/// memory than there may be; `None` if that is not among the faults.
///
/// # Errors
/// What the system says.
pub fn at_start(loaded: &Loaded, options: &Options, faults: &[Fault], results: &Path) -> Result<Option<PathBuf>, ResultsError> {
    if let Some(fault) = faults.iter().find(|fault| fault.kind == &MEMORY) {
        return alone(results, &vec![("README.md", memory_text(loaded, fault))]).map(Some);
    }
    let Some(fault) = faults.iter().find(|fault| fault.kind == &MASS_SCALING) else { return Ok(None) };
    // Another fault of the model would be found here as well, and is reported already.
    let Ok(Some(needed)) = MassNeeded::of(&loaded.model, options) else { return Ok(None) };
    alone(results, &of_mass(loaded, fault, &needed)).map(Some)
}

/// There is no run that has the folder yet, and another one may write there.
fn alone(results: &Path, files: &Files) -> Result<PathBuf, ResultsError> {
    fs::create_dir_all(results).map_err(ResultsError::file("create", results))?;
    let _lock = FolderLock::take(results)?;
    write(results, files)
}

fn of_mass(loaded: &Loaded, fault: &Fault, needed: &MassNeeded) -> Files {
    let (model, simulation) = (&loaded.model, &needed.simulation);
    let mut files: Files = Vec::new();
    let mut trace = simulation.trace_now(&needed.failure_entity, None);
    trace.near.field = ("mass to be added, times its own", "");
    let shares = needed.shares_of(&trace.near);
    trace.moments.iter_mut().for_each(|moment| moment.values.clone_from(&shares));
    let mark = needed.heaviest.first().map_or(String::new(), |it| format!("element {}", it.element));
    let depth = if model.is_of_whole_bodies() { "N" } else { "N/m" };
    if let (Some(worst), Some(moment)) = (needed.heaviest.first(), trace.moments.first()) {
        let title = format!("{} – where most mass is needed: {}", model.name, point(worst.at, model.dimension()));
        let nodes: Vec<[f64; 3]> = trace
            .near
            .element
            .map_or(Vec::new(), |element| trace.near.cells[element].nodes.iter().map(|&node| moment.positions[node]).collect());
        files.push(("place.svg", place_in(model, simulation, &title, &Spot { at: worst.at, nodes: &nodes, mark: &mark })));
        let title = format!("{} – element {} of part \"{}\" and the elements around it", model.name, worst.element, worst.part);
        let panel = Panel { title: "at the start".into(), remark: format!("its step is {}", shown(worst.time_step, "s")), moment };
        files.push(("neighbourhood.svg", neighbourhood_of(model, simulation, &title, &trace.near, &[panel], [&mark, depth])));
    }
    files.push(("mass.svg", mass_plot(&format!("{} – mass for a longer step", model.name), needed)));
    files.push(("README.md", mass_text(loaded, fault, needed)));
    files
}

fn mass_text(loaded: &Loaded, fault: &Fault, needed: &MassNeeded) -> String {
    let model = &loaded.model;
    let si = if model.is_of_whole_bodies() { "kg" } else { "kg/m" };
    let (share, longest) = (needed.share(needed.scaling.time_step), needed.longest());
    let mut text =
        format!("# Post-mortem of {}: {}\n\n{}. ({}) Nothing was run.\n\n", model.name, fault.kind.title, fault.message, fault.kind.code);
    let mut advice = vec![Advice::new(
        "run.mass_scaling.time_step",
        format!("a step of {} needs no more than the limit allows", shown(rounded_down(longest), "s")),
    )];
    if let Some(worst) = needed.heaviest.first() {
        text += &table(
            &["", ""],
            [
                vec![
                    "**failure location**".into(),
                    format!(
                        "**element {} of part \"{}\"**, which needs {} of its mass besides",
                        worst.element,
                        worst.part,
                        percent(worst.added / worst.mass)
                    ),
                ],
                vec!["place".into(), point(worst.at, model.dimension())],
                vec!["its stable step (`safety` included)".into(), shown(worst.time_step, "s")],
                vec!["step that is asked for".into(), shown(needed.scaling.time_step, "s")],
            ],
        );
        text.push_str("\n![Where it is](place.svg)\n\n![The neighbourhood](neighbourhood.svg)\n\n");
        let parts = &needed.parts;
        let most = parts.iter().max_by(|a, b| a.added.total_cmp(&b.added));
        if let Some((index, part)) = most.and_then(|most| Some((model.parts.iter().position(|part| part.name == most.part)?, most))) {
            let what = format!("larger elements where they are smallest: {} of its {} are too light", part.light, part.elements);
            advice.push(Advice::new(format!("part[{index}].{}", model.parts[index].shape.size_path()), what));
        }
    }
    advice.push(Advice::new(
        "run.mass_scaling.limit",
        format!("{} or more, where inertia does not matter: the step asked for adds {}", rounded_up(share), percent(share)),
    ));
    text.push_str("## What is needed\n\n");
    text += &table(
        &["part", "elements", "of them too light", "its mass", "mass to be added"],
        needed.parts.iter().map(|part| {
            let added = format!("{} ({})", shown(part.added, si), percent(part.added / part.mass));
            vec![part.part.clone(), part.elements.to_string(), part.light.to_string(), shown(part.mass, si), added]
        }),
    );
    text.push_str("\n![Mass over the step](mass.svg)\n\nThe elements that need most:\n\n");
    text += &table(
        &["element", "part", "place", "stable step", "its mass", "mass to be added"],
        needed.heaviest.iter().map(|it| {
            vec![
                it.element.to_string(),
                it.part.clone(),
                point(it.at, model.dimension()),
                shown(it.time_step, "s"),
                shown(it.mass, si),
                format!("{} ({})", shown(it.added, si), percent(it.added / it.mass)),
            ]
        }),
    );
    text.push('\n');
    text + &causes(fault.kind, &advice, loaded)
}

/// Four digits, not more than the value.
fn rounded_down(value: f64) -> f64 {
    let power = 10f64.powi(3 - value.abs().max(1e-300).log10().floor() as i32);
    (value * power).floor() / power
}

/// Two digits, not less than the value.
fn rounded_up(value: f64) -> String {
    let power = 10f64.powi(1 - value.abs().max(1e-9).log10().floor() as i32);
    format!("{}", (value * power).ceil() / power)
}

fn percent(share: f64) -> String {
    format!("{} %", shown(100.0 * share, ""))
}

fn memory_text(loaded: &Loaded, fault: &Fault) -> String {
    let model = &loaded.model;
    let counts = counts(model);
    let all: u128 = counts.iter().sum();
    let mut text =
        format!("# Post-mortem of {}: {}\n\n{}. ({}) Nothing was run.\n\n", model.name, fault.kind.title, fault.message, fault.kind.code);
    let largest = (0..counts.len()).max_by_key(|&part| counts[part]);
    if let Some(part) = largest {
        text += &table(
            &["", ""],
            [vec![
                "**failure location**".into(),
                format!("**part \"{}\"** with {} of {all} elements", model.parts[part].name, counts[part]),
            ]],
        );
    }
    text.push_str("\n## What is needed\n\n");
    let share = |count: u128| percent(count as f64 / all.max(1) as f64);
    let place = |part: usize| format!("`part[{part}].{}`", model.parts[part].shape.size_path());
    text += &table(
        &["part", "elements", "share", "key"],
        model.parts.iter().enumerate().map(|(k, part)| vec![part.name.clone(), counts[k].to_string(), share(counts[k]), place(k)]),
    );
    text.push('\n');
    let mut advice: Vec<Advice> = largest
        .map(|part| {
            Advice::new(
                format!("part[{part}].{}", model.parts[part].shape.size_path()),
                "larger elements; twice the size in both directions is a quarter of the memory",
            )
        })
        .into_iter()
        .collect();
    advice.push(Advice::new("run.memory_limit", "raise it, if the machine has more"));
    text + &causes(fault.kind, &advice, loaded)
}

/// Elements of each part.
fn counts(model: &Model) -> Vec<u128> {
    model.parts.iter().map(|part| model.element_count(part)).collect()
}
