//! The table of a sweep and its plot: a row for each run in the order of their numbers, whatever the order in
//! which they ended.
//!
//! Rows come from `run.rs`. Inputs that are quantities are shown in SI units, with the unit in the header;
//! other inputs as they were written.

use super::journal::{Entry, RunEnd};
use super::plan::Input;
use super::prepare::Sweep;
use super::{PLOT_NAME, SweepError, TABLE_NAME};
use crate::model_file::value_in_si;
use crate::picture::sweep::{self, Axis, Spacing};
use crate::results::{append_number, append_text, write_whole};
use embate_solver::input::sections;
use embate_solver::material;
use embate_solver::model::Model;
use embate_solver::quantity::Dimension;
use embate_solver::vocabulary::{Form, Kind};
use std::path::Path;

/// Values of an input.
enum Values {
    /// In SI units.
    Numbers(Vec<f64>, String),
    Texts,
}

/// Writes `sweep.csv` and `sweep.svg`.
pub(super) fn write<'a>(sweep: &Sweep, entries: impl Iterator<Item = &'a Entry>, folder: &Path) -> Result<(), SweepError> {
    let values: Vec<Values> = sweep.plan.inputs.iter().map(|input| values(input, &sweep.first)).collect();
    let entries: Vec<&Entry> = entries.collect();
    write_whole(&folder.join(TABLE_NAME), text(sweep, &values, &entries).as_bytes())?;
    let axes: Vec<Axis> = sweep.plan.inputs.iter().zip(&values).map(|(input, values)| axis(input, values)).collect();
    let outputs: Vec<(usize, sweep::Output)> = sweep
        .outputs
        .iter()
        .enumerate()
        .filter(|(_, output)| !output.is_text && !output.is_of_the_machine())
        .map(|(column, output)| {
            (
                column,
                sweep::Output {
                    name: output.name.clone(),
                    si: sweep::unit_of(output.column(), &output.name, output.is_time(), sweep.first.is_of_whole_bodies()),
                },
            )
        })
        .collect();
    let runs: Vec<sweep::Run<'_>> = entries
        .iter()
        .filter(|entry| entry.end != RunEnd::Failed)
        .map(|entry| sweep::Run {
            items: &sweep.plan.runs[entry.run],
            outputs: outputs
                .iter()
                .map(|(column, _)| entry.cells.get(*column).and_then(|cell| cell.parse().ok()).unwrap_or(f64::NAN))
                .collect(),
        })
        .collect();
    let names: Vec<sweep::Output> = outputs.into_iter().map(|(_, output)| output).collect();
    let title = if sweep.first.title.is_empty() { &sweep.first.name } else { &sweep.first.title };
    sweep::plot(title, &axes, &names, &runs, sweep.plan.is_factorial, &folder.join(PLOT_NAME))?;
    Ok(())
}

fn text(sweep: &Sweep, values: &[Values], entries: &[&Entry]) -> String {
    let mut out = String::from("run");
    for (input, values) in sweep.plan.inputs.iter().zip(values) {
        out.push(',');
        match values {
            Values::Numbers(_, unit) if !unit.is_empty() => append_text(&mut out, &format!("{} [{unit}]", input.path)),
            _ => append_text(&mut out, &input.path),
        }
    }
    out.push_str(",status");
    for output in &sweep.outputs {
        out.push(',');
        append_text(&mut out, &output.name);
    }
    out.push_str(",error\n");
    for entry in entries {
        out.push_str(&(entry.run + 1).to_string());
        for ((input, values), &item) in sweep.plan.inputs.iter().zip(values).zip(&sweep.plan.runs[entry.run]) {
            out.push(',');
            match values {
                Values::Numbers(numbers, _) => append_number(&mut out, numbers[item]),
                Values::Texts => append_text(&mut out, &input.items[item].text),
            }
        }
        out.push(',');
        out.push_str(entry.end.name());
        for cell in &entry.cells {
            out.push(',');
            out.push_str(cell);
        }
        out.push(',');
        append_text(&mut out, &entry.error);
        out.push('\n');
    }
    out
}

fn values(input: &Input, model: &Model) -> Values {
    let texts = || input.items.iter().map(|item| item.text.trim_matches(['"', '\'']));
    let found: Option<Vec<(f64, String)>> = texts().map(value_in_si).collect();
    let Some(found) = found else { return Values::Texts };
    // A bare number is in SI units; what its unit is says the key.
    let written = found.iter().map(|(_, unit)| unit).find(|unit| !unit.is_empty()).cloned();
    let unit = written.unwrap_or_else(|| unit_of(&input.path, model).unwrap_or_default());
    Values::Numbers(found.into_iter().map(|(value, _)| value).collect(), unit)
}

/// The SI unit of a key's numbers.
fn unit_of(path: &str, model: &Model) -> Option<String> {
    let path = path.replace('[', ".").replace(']', "");
    let steps: Vec<&str> = path.split('.').map(str::trim).collect();
    let section = sections::section(steps.first()?);
    let of_law = || {
        let law = &model.materials.get(*steps.get(1)?)?.law;
        let laws = material::registry();
        let kind = laws.iter().find(|kind| kind.name == *law)?;
        kind.parameters.iter().find(|parameter| Some(&parameter.name) == steps.get(2)).copied()
    };
    if section.is_some_and(|section| section.name == "material") && steps.len() == 3 {
        return of_law().map(|parameter| if parameter.is_angle { parameter.unit() } else { all_around(parameter.dimension, model).unit() });
    }
    // Names and numbers of tables and items are no keys.
    let named = section.is_some_and(|section| matches!(section.form, Form::Named | Form::Repeated));
    let keys = steps.iter().enumerate().filter(|(depth, step)| !(named && *depth == 1) && step.parse::<usize>().is_err());
    let key = sections::find(&keys.map(|(_, step)| *step).collect::<Vec<_>>().join("."))?;
    let (dimension, _) = key.range()?;
    Some(match key.kind {
        Kind::Angle(Dimension::NONE, _) => "rad".to_string(),
        Kind::Angle(..) => "rad/s".to_string(),
        _ => all_around(dimension, model).unit(),
    })
}

/// Masses and forces of an axisymmetric body are those of the whole circumference.
fn all_around(dimension: Dimension, model: &Model) -> Dimension {
    match dimension {
        Dimension::MASS_PER_LENGTH if model.is_of_whole_bodies() => Dimension::MASS,
        Dimension::FORCE_PER_LENGTH if model.is_of_whole_bodies() => Dimension::FORCE,
        other => other,
    }
}

fn axis(input: &Input, values: &Values) -> Axis {
    match values {
        Values::Numbers(numbers, unit) => Axis {
            name: input.path.clone(),
            si: unit.clone(),
            values: numbers.clone(),
            spacing: if input.by_factors && numbers.iter().all(|value| *value > 0.0) { Spacing::Factors } else { Spacing::Even },
        },
        Values::Texts => {
            // Equal texts of a table are one place on the axis.
            let mut names: Vec<String> = Vec::new();
            for item in &input.items {
                if !names.contains(&item.text) {
                    names.push(item.text.clone());
                }
            }
            let place = |text: &String| names.iter().position(|name| name == text).map_or(f64::NAN, |place| place as f64);
            let values = input.items.iter().map(|item| place(&item.text)).collect();
            Axis { name: input.path.clone(), si: String::new(), values, spacing: Spacing::Names(names) }
        }
    }
}
