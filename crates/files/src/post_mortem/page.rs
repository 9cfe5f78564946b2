//! The page: what failed, where, how it came, and what to change; Markdown with the pictures that lie beside
//! it.

use super::advice::{Advice, Case, key_now};
use super::again::Findings;
use super::plots::{changes, energies, failure_location as failure_location_plot, in_words};
use super::{Failed, Files};
use crate::model_file::Loaded;
use crate::picture::neighbourhood::{Panel, neighbourhood};
use crate::picture::place::place;
use crate::picture::scale::unit;
use crate::picture::space::{self, Spot};
use embate_solver::error::Error;
use embate_solver::message::Message;
use embate_solver::model::Model;
use embate_solver::post_mortem::{FailureLocation, Moment, Neighbourhood, RINGS, Trace, Vitals};
use embate_solver::simulation::Simulation;
use std::fmt::Write;

/// Panels of the neighbourhood.
const PANELS: usize = 4;

/// A value with four digits and its unit.
pub(crate) fn shown(value: f64, si: &str) -> String {
    if !value.is_finite() {
        return "no number".into();
    }
    // Masses are counted in grams, and numbers without a unit need no prefix.
    let (si, value) = si.strip_prefix("kg").map_or((si.to_string(), value), |rest| (format!("g{rest}"), 1e3 * value));
    let unit = unit(&si, if si.is_empty() { 1.0 } else { value });
    let value = value * unit.factor + 0.0;
    let value = if si.is_empty() && value.abs() < 1e-12 { 0.0 } else { value };
    let decimals = if value == 0.0 { 0 } else { (3 - value.abs().log10().floor() as i32).clamp(0, 9) as usize };
    let text = if (1e-4..1e7).contains(&value.abs()) || value == 0.0 { format!("{value:.decimals$}") } else { format!("{value:.3e}") };
    let text = if text.contains('.') && !text.contains('e') { text.trim_end_matches('0').trim_end_matches('.').to_string() } else { text };
    format!("{text} {}", unit.name).trim_end().to_string()
}

/// A point with its unit, by so many components.
pub(super) fn point(x: [f64; 3], dimension: usize) -> String {
    let unit = unit("m", x.iter().fold(0.0, |most: f64, x| most.max(x.abs())));
    let number = |value: f64| {
        // No minus before nothing.
        let text = format!("{:.4}", (1e4 * value * unit.factor).round() / 1e4 + 0.0);
        text.trim_end_matches('0').trim_end_matches('.').to_string()
    };
    let components: Vec<String> = x[..dimension].iter().map(|&x| number(x)).collect();
    format!("({}) {}", components.join(", "), unit.name)
}

/// A row of a table; what stands in it keeps to its cell.
pub(super) fn row(cells: &[String]) -> String {
    let cells: Vec<String> = cells.iter().map(|cell| cell.replace('\n', " ").replace('|', "\\|")).collect();
    format!("| {} |\n", cells.join(" | "))
}

/// A table with its head.
pub(super) fn table(head: &[&str], rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let head: Vec<String> = head.iter().map(ToString::to_string).collect();
    let rule = vec!["---".to_string(); head.len()];
    let mut text = row(&head) + &row(&rule);
    rows.into_iter().for_each(|cells| text.push_str(&row(&cells)));
    text
}

/// What usually causes a failure, and what to change in the model.
pub(super) fn causes(kind: &Message, advice: &[Advice], loaded: &Loaded) -> String {
    let mut text =
        format!("## What usually causes it\n\n{}\n\n## What to change\n\nFor this failure, what helps most first:\n\n", kind.cause);
    text += &table(
        &["key", "now", "where", "what to do, and why"],
        advice.iter().map(|Advice { what, path }| {
            let [now, place] = key_now(loaded, path);
            vec![format!("`{path}`"), now, place, what.clone()]
        }),
    );
    let _ = write!(text, "\nIn general: {} (`embate explain {}`)\n\n", kind.remedy, kind.code);
    text
}

/// The page of a run, and its pictures.
pub(super) fn of_run(failed: &Failed<'_>, findings: &Findings) -> Files {
    let (simulation, trace) = (failed.simulation, &findings.trace);
    let case = Case {
        failed,
        trace,
        failure_location: simulation.failure_location(&findings.failure_entity),
        acting: simulation.acting(failed.model, &findings.failure_entity),
    };
    let name = &failed.model.name;
    let (step, round) = (simulation.steps(), failed.model.is_of_whole_bodies());
    let depth = if round { "N" } else { "N/m" };
    let mark = mark(&case.failure_location);
    let mut files: Files = Vec::new();
    files.extend(place_of_failure_location(failed, &case, &findings.trace, &mark));
    if !trace.near.cells.is_empty() {
        let title = format!("{name} – {} and the elements around it", case.failure_location);
        let panels = panels(failed, trace);
        files.push(("neighbourhood.svg", neighbourhood_of(failed.model, simulation, &title, &trace.near, &panels, [&mark, depth])));
    }
    let failure_location = failure_location_plot(&format!("{name} – {} over the last steps", case.failure_location), trace, step, round);
    files.extend(failure_location.map(|text| ("failure-location.svg", text)));
    files.extend(energies(&format!("{name} – energies over the last steps"), trace, step, round).map(|text| ("energies.svg", text)));
    let page = text(&case, findings, &files);
    files.push(("README.md", page));
    files
}

/// Where the failure location is in the model.
fn place_of_failure_location(failed: &Failed<'_>, case: &Case<'_>, trace: &Trace, mark: &str) -> Option<(&'static str, String)> {
    let (simulation, model) = (failed.simulation, failed.model);
    let at = case.failure_location.at().filter(|at| at.iter().all(|v| v.is_finite()))?;
    let title = format!("{} – where: {}", model.name, point(at, simulation.dimension()));
    // Where the run failed its element is, if it is one.
    let own = trace.near.element.filter(|_| trace.near.node.is_none());
    let nodes = own
        .zip(trace.moments.last())
        .map_or(Vec::new(), |(element, moment)| trace.near.cells[element].nodes.iter().map(|&node| moment.positions[node]).collect());
    Some(("place.svg", place_in(model, simulation, &title, &Spot { at, nodes: &nodes, mark })))
}

/// The picture of a place, in 2D or 3D.
pub(super) fn place_in(model: &Model, simulation: &Simulation, title: &str, spot: &Spot<'_>) -> String {
    let (frame, cells) = (simulation.frame(), simulation.cells());
    if simulation.dimension() == 2 {
        return place(title, &cells, frame.positions::<2>(), &frame.outlines, [spot.at[0], spot.at[1]], spot.mark);
    }
    space::place(title, &cells, &frame, spot, &model.output.camera.unwrap_or_default())
}

/// The picture of a neighbourhood, in 2D or 3D.
pub(super) fn neighbourhood_of(
    model: &Model,
    simulation: &Simulation,
    title: &str,
    near: &Neighbourhood,
    panels: &[Panel<'_>],
    [mark, depth]: [&str; 2],
) -> String {
    if simulation.dimension() == 2 {
        return neighbourhood(title, near, panels, mark, depth);
    }
    let camera = model.output.camera.unwrap_or_default();
    space::neighbourhood(title, near, panels, (mark, depth), &camera, &simulation.frame())
}

/// What the failure location is called in pictures.
fn mark(failure_location: &FailureLocation) -> String {
    match failure_location {
        FailureLocation::Element { element, .. } => format!("element {element}"),
        FailureLocation::Node { node, .. } => format!("node {node}"),
        FailureLocation::Contact { name, node, .. } => format!("{name}, node {node}"),
        FailureLocation::Nobody => String::new(),
    }
}

/// The times that are shown: the last two, and earlier ones ever farther back.
fn panels<'a>(failed: &Failed<'_>, trace: &'a Trace) -> Vec<Panel<'a>> {
    let step = failed.simulation.steps();
    let all = &trace.moments;
    let Some(last) = all.len().checked_sub(1) else { return Vec::new() };
    // Of energies the worst step is what matters, and not the last one.
    let worst = trace.jump.and_then(|jump| all.iter().position(|moment| moment.step == jump.step)).unwrap_or(last);
    let mut places: Vec<usize> = [0, worst.saturating_sub(worst.min(256).div_ceil(8)), worst.saturating_sub(1), worst].into();
    if worst < last {
        places[1] = worst.saturating_sub(1);
        places[2] = worst;
        places[3] = last;
    }
    places.sort_unstable();
    places.dedup();
    places.truncate(PANELS);
    let panel = |moment: &'a Moment| {
        let before = step - moment.step.min(step);
        let remark = match before {
            _ if trace.jump.is_some_and(|jump| jump.step == moment.step) && worst < last => "the worst step".to_string(),
            0 => "the step that failed".to_string(),
            1 => "the last good step".to_string(),
            before => format!("{before} steps before the failure"),
        };
        Panel { title: format!("step {}, t = {}", moment.step, shown(moment.time, "s")), remark, moment }
    };
    places.into_iter().map(|place| panel(&all[place])).collect()
}

fn text(case: &Case<'_>, findings: &Findings, files: &Files) -> String {
    let Failed { error, simulation, loaded, .. } = *case.failed;
    let Some(kind) = error.kind() else { return String::new() };
    let has = |name: &str| files.iter().any(|(own, _)| *own == name);
    let mut text = format!("# Post-mortem of {}: {}\n\n{error}. ({})\n\n", case.failed.model.name, kind.title, kind.code);
    text += &table(&["", ""], facts(case));
    text.push('\n');
    if has("place.svg") {
        text.push_str("![Where it is](place.svg)\n\n");
    }
    text.push_str("## How it came\n\n");
    text += &story(case);
    if has("neighbourhood.svg") {
        let _ = write!(
            text,
            "![The neighbourhood](neighbourhood.svg)\n\nThe failure location and {RINGS} rings of elements around it, each with its number in its part, at {} times; the failure location is always in the middle, \
             and all panels have one scale.\n\n",
            panels(case.failed, case.trace).len()
        );
    }
    if has("failure-location.svg") {
        text.push_str("![The failure location over the last steps](failure-location.svg)\n\n");
    }
    if has("energies.svg") {
        text.push_str("![Energies over the last steps](energies.svg)\n\n");
    }
    let _ = write!(text, "{}\n\n", findings.how);
    text += &causes(kind, &case.advice(), loaded);
    text += &next(case, simulation.steps());
    text
}

/// The failure location, and what it is made of.
fn facts(case: &Case<'_>) -> Vec<Vec<String>> {
    let simulation = case.failed.simulation;
    let line = |name: &str, value: String| vec![name.to_string(), value];
    let mut rows = vec![line("**failure location**", format!("**{}**", case.failure_location))];
    rows.extend(case.failure_location.at().map(|at| line("place", point(at, simulation.dimension()))));
    rows.push(line(
        "time",
        format!("{} ({:.6e} s) of {}", shown(simulation.time(), "s"), simulation.time(), shown(case.failed.model.run.end, "s")),
    ));
    rows.push(line("step", simulation.steps().to_string()));
    if let Some(jump) = case.trace.jump.filter(|_| matches!(case.failed.error, Error::EnergyDrift { .. })) {
        rows.push(line(
            "worst step",
            format!("{}: the sum of all energies changed by {:.3} % of the largest total energy in it", jump.step, 100.0 * jump.size),
        ));
    }
    if let Some(index) = case.part() {
        let part = &case.failed.model.parts[index];
        let law = case.failed.model.materials.get(&part.material).map_or("", |material| material.law.as_str());
        rows.push(line(
            "part",
            format!(
                "\"{}\": material \"{}\" (`{law}`), elements `{}`, {}",
                part.name,
                part.material,
                part.element,
                place_of(case.failed.loaded, &format!("part[{index}]"))
            ),
        ));
    }
    for it in case.pressing().iter().take(3) {
        let path = case.interface(it.kind, it.name).map_or(String::new(), |(path, _)| format!(", {}", place_of(case.failed.loaded, &path)));
        let unit = if case.failed.model.is_of_whole_bodies() { "N" } else { "N/m" };
        let force = format!(
            "{} \"{}\" with up to {} (step {}, sum over the nodes of the failure location and its neighbours)",
            it.kind,
            it.name,
            shown(it.force, unit),
            it.step
        );
        rows.push(line(if it.lasts { "pressed by" } else { "was pressed by" }, force + &path));
    }
    for it in &case.acting {
        rows.push(line("held, moved or loaded by", format!("`{}` on `{}`, {}", it.path, it.on, place_of(case.failed.loaded, &it.path))));
    }
    rows
}

fn place_of(loaded: &Loaded, path: &str) -> String {
    let place = loaded.key(path);
    let file = std::path::Path::new(&place.file).file_name().map_or(place.file.clone(), |name| name.to_string_lossy().into_owned());
    if place.line > 0 { format!("{file} line {}", place.line) } else { file }
}

/// Takes one of the figures of a failure location.
type Figure = fn(&Vitals) -> f64;

/// What became of the failure location, as a table; of energies also which of them changed.
fn story(case: &Case<'_>) -> String {
    let mut text = in_sentences(case);
    let step = case.failed.simulation.steps();
    let all = &case.trace.moments;
    let shown_at = |moment: &Moment| match step - moment.step.min(step) {
        0 => "step that failed".to_string(),
        1 => "last good step".to_string(),
        before => format!("{before} steps before"),
    };
    let mut columns: Vec<&Moment> = [all.first(), case.last_good(), all.last()].into_iter().flatten().collect();
    columns.dedup_by_key(|moment| moment.step);
    let quantities: [(&str, &str, Figure); 12] = [
        ("stable step of the element", "s", |v| v.time_step),
        ("shape at its worst corner (1: square; below 0: folded over)", "", |v| v.shape),
        ("size over that at the start", "", |v| v.area_ratio),
        ("largest strain (logarithmic)", "", |v| v.strains[0]),
        ("smallest strain", "", |v| v.strains[1]),
        ("plastic strain", "", |v| v.plastic_strain),
        ("temperature", "K", |v| v.temperature),
        ("damage", "", |v| v.damage),
        ("von Mises stress", "Pa", |v| v.von_mises),
        ("pressure", "Pa", |v| v.pressure),
        ("speed", "m/s", |v| v.speed),
        ("depth of the contact", "m", |v| v.penetration),
    ];
    let is_there = |value: Figure| all.iter().any(|moment| value(&moment.vitals).is_finite());
    let rows: Vec<Vec<String>> = quantities
        .iter()
        .filter(|(.., value)| is_there(*value))
        .map(|(name, si, value)| {
            std::iter::once((*name).to_string()).chain(columns.iter().map(|moment| shown(value(&moment.vitals), si))).collect()
        })
        .collect();
    if !rows.is_empty() {
        let head: Vec<String> = std::iter::once(String::new()).chain(columns.iter().map(|moment| shown_at(moment))).collect();
        text += &table(&head.iter().map(String::as_str).collect::<Vec<_>>(), rows);
        text.push('\n');
    }
    text + &balance(case)
}

/// What became of the element, in a few sentences.
fn in_sentences(case: &Case<'_>) -> String {
    let (Some(first), Some(good)) = (case.trace.moments.first(), case.last_good()) else { return String::new() };
    let (then, now) = (&first.vitals, &good.vitals);
    let mut text = String::new();
    if now.area_ratio < 0.5 {
        let _ = write!(text, "The element was squeezed to {:.2} of its size. ", now.area_ratio);
    } else if now.shape < 0.1 && then.shape > 2.0 * now.shape {
        let _ = write!(
            text,
            "The element kept its size ({:.2} of that at the start) and lost its shape: it was sheared or folded. ",
            now.area_ratio
        );
    }
    if let Some(folded) =
        case.trace.moments.iter().find(|moment| moment.vitals.shape <= 0.0).filter(|folded| folded.step < case.failed.simulation.steps())
    {
        let _ = write!(text, "One of its corners was folded over from step {} on. ", folded.step);
    }
    if then.time_step > 1.5 * now.time_step {
        let _ =
            write!(text, "Its stable step fell from {} to {} within these steps. ", shown(then.time_step, "s"), shown(now.time_step, "s"));
    }
    if text.is_empty() { text } else { format!("{}\n\n", text.trim_end()) }
}

/// Which energies changed in the worst step.
fn balance(case: &Case<'_>) -> String {
    let (Error::EnergyDrift { drift, .. }, Some(jump)) = (case.failed.error, case.trace.jump) else { return String::new() };
    let (begin, before) = case.trace.begin;
    let mut text = format!("Before step {} the drift was {:.3} %, at the end {:.3} %. ", begin + 1, 100.0 * before, 100.0 * drift);
    let share = jump.size / (drift - before).max(f64::MIN_POSITIVE);
    if share > 0.3 {
        let _ = writeln!(text, "Most of it came at once, in step {} or near it: look at what happened there.\n", jump.step);
    } else {
        let _ = writeln!(
            text,
            "No single step is the cause: the worst one, {}, brought {:.3} %. The balance is lost little by little; \
                `energy.svg` of the results shows from when on.\n",
            jump.step,
            100.0 * jump.size
        );
    }
    let closed: Vec<u64> = case.trace.moments.iter().filter(|moment| !moment.row.is_empty()).map(|moment| moment.step).collect();
    if let Some(at) = closed.iter().position(|&step| step == jump.step).filter(|&at| at > 0) {
        let si = if case.failed.model.is_of_whole_bodies() { "J" } else { "J/m" };
        let largest = changes(case.trace, [at - 1, at]);
        let rows = largest.iter().take(6).map(|(change, column)| vec![in_words(&case.trace.columns[*column]), shown(*change, si)]);
        text += &table(&["energy", "change in the worst step"], rows);
        text.push('\n');
    }
    text
}

/// How to continue.
fn next(case: &Case<'_>, step: u64) -> String {
    let mut text = "## To see more\n\n".to_string();
    text.push_str("- The last state of all fields is the last frame of `fields.pvd`; ParaView shows elements by their numbers there.\n");
    let has_checkpoint = !crate::checkpoint::generations(case.failed.checkpoints).is_empty();
    if has_checkpoint {
        let early = case.trace.moments.first().map_or(0.0, |moment| moment.time);
        let _ = writeln!(
            text,
            "- `embate replay DIR --from \"{early:e} s\" --to \"{:e} s\" --output-every \"{:e} s\"` writes the last steps with all fields.",
            case.failed.simulation.time(),
            case.failed.simulation.time_step()
        );
        text.push_str(
            "- After a change of limits (`run.step_limit`, `run.energy_limit` and their like) `embate \
            resume DIR` continues; any other change needs a new run.\n",
        );
    } else {
        let _ = writeln!(text, "- `--set run.max_steps={}` ends a run just before the failure, with its pictures.", step.saturating_sub(1));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_have_four_digits_and_a_unit_that_fits() {
        assert_eq!(shown(8.0e-9, "s"), "8 ns");
        assert_eq!(shown(63_340_123.0, "Pa"), "63.34 MPa");
        assert_eq!(shown(0.1248, "kg/m"), "124.8 g/m");
        assert_eq!(shown(5.406, "kg/m"), "5.406 kg/m");
        assert_eq!(shown(-1.1e-16, ""), "0");
        assert_eq!(shown(-0.13364, ""), "-0.1336");
        assert_eq!(shown(-0.0, "Pa"), "0 Pa");
        assert_eq!(shown(f64::NAN, "s"), "no number");
        assert_eq!(point([0.0056441, 0.0191813, 0.0], 2), "(5.6441, 19.1813) mm");
        assert_eq!(point([0.0056441, 0.0191813, 0.0], 3), "(5.6441, 19.1813, 0) mm");
    }

    #[test]
    fn what_stands_in_a_table_keeps_to_its_cell() {
        assert_eq!(row(&["a|b".into(), "c\nd".into()]), "| a\\|b | c d |\n");
    }
}
