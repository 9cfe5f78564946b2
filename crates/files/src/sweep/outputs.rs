//! What a sweep notes of each run: a figure of the summary, or what a `take` makes of a column of the
//! history.
//!
//! Texts come from the command line; numbers are found by the same code as those of the verification cases
//! (`verification/quantity.rs`). Cells of the table go to `journal.rs`.

use super::Wrong;
use crate::model_file::{number_and_unit, quantity_in_si};
use crate::results::{append_number, append_text};
use crate::verification::{How, Samples, Source, TAKES, Take};
use embate_solver::quantity::Dimension;
use embate_solver::vocabulary::suggestion;

/// One column of the table.
#[derive(Clone, Debug)]
pub(super) struct Output {
    /// As the user wrote it.
    pub(super) name: String,
    source: Source,
    /// Whether it is a text.
    pub(super) is_text: bool,
}

/// Figures of the summary that are noted when nothing else is asked for.
const FIGURES: [&str; 5] = ["energy_drift", "penetration_max", "steps", "time_end", "state_hash"];

/// What is noted when nothing is asked for: largest forces of contacts and obstacles, last places of probes,
/// energies, figures.
pub(super) fn usual(columns: &[String]) -> Vec<String> {
    let forces = columns.iter().filter(|name| name.contains(".force_")).map(|name| format!("max_abs({name})"));
    let probes = columns.iter().filter(|name| {
        let probe = name.strip_suffix(".x").or_else(|| name.strip_suffix(".y"));
        probe.is_some_and(|probe| !probe.contains(['.', '[']))
    });
    let energies = ["energy.kinetic", "energy.internal", "energy.plastic"].map(|name| format!("last({name})"));
    forces.chain(probes.map(|name| format!("last({name})"))).chain(energies).chain(FIGURES.map(String::from)).collect()
}

impl Output {
    /// Reads `energy_drift`, `contact.force_y[impact]`, `max_abs(contact.force_y[impact])` or
    /// `at=1ms(tip.y)`; whether the run has it is asked by [`Output::examine`].
    pub(super) fn read(text: &str, samples: &Samples) -> Result<Self, Wrong> {
        let name = text.trim();
        let source = match name.strip_suffix(')').and_then(|text| text.split_once('(')) {
            None if samples.columns().iter().any(|column| column == name) => history(name, take("last")?, 0.0),
            None => Source::Summary(name.to_string()),
            Some((how, column)) => {
                let (how, level) = how.split_once('=').map_or((how, None), |(how, level)| (how.trim(), Some(level.trim())));
                of_history(how.trim(), level, column.trim())?
            }
        };
        let is_text = samples.text(&source).is_some();
        Ok(Self { name: name.to_string(), source, is_text })
    }

    /// Whether the run will have it.
    pub(super) fn examine(&self, samples: &Samples, end: f64) -> Result<(), Wrong> {
        if samples.text(&self.source).is_some() {
            return Ok(());
        }
        samples.examine(&self.source, end).map_err(|(_, message, help)| match &self.source {
            Source::Summary(name) => (format!("neither the history nor the summary has `{name}`"), samples.suggested(name)),
            _ => (message, help),
        })
    }

    /// Its value, where the run has it and it is a number.
    pub(super) fn number(&self, samples: &Samples) -> Option<f64> {
        samples.number(&self.source).ok()
    }

    /// Its cell in the table; empty where the run does not have it.
    pub(super) fn cell(&self, samples: &Samples) -> String {
        let mut cell = String::new();
        if let Some(text) = samples.text(&self.source) {
            append_text(&mut cell, text);
        } else if let Some(value) = self.number(samples) {
            append_number(&mut cell, value);
        }
        cell
    }
}

fn history(column: &str, take: &'static Take, level: f64) -> Source {
    Source::History { column: column.to_string(), take, during: [None, None], level }
}

fn take(name: &str) -> Result<&'static Take, Wrong> {
    let of_history = || TAKES.iter().filter(|take| take.of_history);
    of_history().find(|take| take.name == name).ok_or_else(|| {
        let known: Vec<&str> = of_history().map(|take| take.name).chain(["at"]).collect();
        (format!("a column has no `{name}`"), suggestion(name, &known))
    })
}

fn of_history(how: &str, level: Option<&str>, column: &str) -> Result<Source, Wrong> {
    if how == "at" {
        let time = level.and_then(|text| number(text, Some(Dimension::TIME))).filter(|time| *time >= 0.0);
        return match time {
            Some(time) => Ok(Source::HistoryAt(column.to_string(), time)),
            None => Err(("`at` needs a time".to_string(), format!("write it like at=1ms({column})"))),
        };
    }
    let take = take(how)?;
    match (take.how.has_level(), level.map(|text| (text, number(text, None)))) {
        (true, Some((_, Some(level)))) => Ok(history(column, take, level)),
        (false, None) => Ok(history(column, take, 0.0)),
        (true, None) => Err((format!("`{how}` needs a level"), format!("write it like {how}=0({column})"))),
        (false, Some(_)) => Err((format!("`{how}` has no level"), format!("write {how}({column})"))),
        (true, Some((text, None))) => Err((format!("`{text}` is not a number"), format!("write it like {how}=0({column})"))),
    }
}

/// A number in SI units, with a unit or without; with a unit of this dimension if it is given.
fn number(text: &str, dimension: Option<Dimension>) -> Option<f64> {
    let value = match number_and_unit(text)? {
        (value, "") => value,
        _ => quantity_in_si(text).filter(|(_, found)| dimension.is_none_or(|wanted| wanted == *found))?.0,
    };
    value.is_finite().then_some(value)
}

impl Output {
    /// What it is of, for the plot: the column of the history, if it is one whose values have its unit.
    pub(super) fn column(&self) -> Option<&str> {
        match &self.source {
            Source::HistoryAt(column, _) => Some(column),
            Source::History { column, take, .. } if matches!(take.how, How::Mean | How::Max | How::Min | How::MaxAbs | How::Last) => {
                Some(column)
            }
            _ => None,
        }
    }

    /// Whether it is a time.
    pub(super) fn is_time(&self) -> bool {
        match &self.source {
            Source::Summary(name) => {
                ["time_end", "rest", "stable_time_step_min", "wall_seconds", "user_cpu_seconds"].contains(&name.as_str())
            }
            Source::History { take, .. } => take.how.is_time(),
            _ => false,
        }
    }

    /// Whether its numbers depend on the machine's mood.
    pub(super) fn is_of_the_machine(&self) -> bool {
        matches!(&self.source, Source::Summary(name) if ["wall_seconds", "user_cpu_seconds", "element_steps_per_second"].contains(&name.as_str()))
    }
}
