//! Which runs a sweep has: what varies, over which values, and how the values are combined.
//!
//! Texts come from the command line (`PATH=VALUES`) or from a table; a [`Plan`] goes to `prepare.rs`, which
//! makes a model of each run. Values stay texts as in a model file, with their places, so that the reader
//! checks their units and ranges and shows where they came from.

use super::values::{self, Item};
use super::{SweepError, Wrong};
use crate::model_file::{Change, Faults, Template};
use crate::sweep::messages::VALUES;
use std::ops::Range;
use std::path::Path;

/// Most runs of one sweep.
const RUNS_MAX: usize = 1_000_000;

/// What a user asks for.
#[derive(Clone, Copy, Debug)]
pub enum Request<'a> {
    /// Every value with every other one: `PATH=VALUES` for each key.
    Factorial(&'a [String]),
    /// First values together, second values together ...
    Zip(&'a [String]),
    /// A CSV file: a column for each key, a row for each run.
    Table(&'a Path),
}

/// A key that varies.
#[derive(Clone, Debug)]
pub(super) struct Input {
    /// Path as written.
    pub(super) path: String,
    source: usize,
    key: Range<usize>,
    pub(super) items: Vec<Item>,
    /// Whether its values are spaced by factors.
    pub(super) by_factors: bool,
}

/// All runs.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    pub(super) inputs: Vec<Input>,
    /// For each run the number of its item of each input.
    pub(super) runs: Vec<Vec<usize>>,
    /// Whether every value is combined with every other one.
    pub(super) is_factorial: bool,
}

impl Plan {
    pub(super) fn read(request: Request<'_>, template: &mut Template) -> Result<Self, SweepError> {
        let (inputs, is_factorial) = match request {
            Request::Factorial(texts) => (varied(texts, template)?, true),
            Request::Zip(texts) => (varied(texts, template)?, false),
            Request::Table(file) => (tabled(file, template)?, false),
        };
        let mut faults = Faults::default();
        for (index, input) in inputs.iter().enumerate() {
            if inputs[..index].iter().any(|other| other.path == input.path) {
                let wrong = (format!("`{}` varies twice", input.path), "give all its values at once".to_string());
                Template::fault(&VALUES, &mut faults, input.source, input.key.clone(), wrong);
            }
        }
        let counts: Vec<usize> = inputs.iter().map(|input| input.items.len()).collect();
        let first = counts.first().copied().unwrap_or(0);
        for (input, &count) in inputs.iter().zip(&counts).filter(|(_, count)| !is_factorial && **count != first) {
            let message = format!("`{}` has {count} values, but `{}` has {first}", input.path, inputs[0].path);
            let wrong = (message, "lists that go together have the same length".to_string());
            Template::fault(&VALUES, &mut faults, input.source, input.key.clone(), wrong);
        }
        let total = if is_factorial { counts.iter().try_fold(1usize, |product, count| product.checked_mul(*count)) } else { Some(first) };
        if let Some(input) = inputs.last().filter(|_| total.is_none_or(|total| total > RUNS_MAX)) {
            let wrong = (format!("these are more than {RUNS_MAX} runs"), "give fewer values".to_string());
            Template::fault(&VALUES, &mut faults, input.source, input.key.clone(), wrong);
        }
        if !faults.is_empty() {
            return Err(SweepError::Model(template.reported(faults)));
        }
        let runs = if is_factorial { factorial(&counts) } else { (0..first).map(|run| vec![run; inputs.len()]).collect() };
        Ok(Self { inputs, runs, is_factorial })
    }

    /// What changes in the model for a run.
    pub(super) fn changes(&self, run: usize) -> Vec<Change<'_>> {
        self.inputs.iter().zip(&self.runs[run]).map(|(input, &item)| input.change(item)).collect()
    }
}

impl Input {
    fn change(&self, item: usize) -> Change<'_> {
        let item = &self.items[item];
        Change { source: self.source, key: self.key.clone(), path: &self.path, place: item.place.clone(), text: &item.text }
    }
}

/// Every combination; the last input changes fastest.
fn factorial(counts: &[usize]) -> Vec<Vec<usize>> {
    let mut runs = vec![Vec::new()];
    for &count in counts {
        runs = runs.iter().flat_map(|run: &Vec<usize>| (0..count).map(|item| run.iter().copied().chain([item]).collect())).collect();
    }
    runs
}

/// `PATH=VALUES` of each `--vary`.
fn varied(texts: &[String], template: &mut Template) -> Result<Vec<Input>, SweepError> {
    let (mut inputs, mut faults) = (Vec::new(), Faults::default());
    for text in texts {
        let source = template.add_source("--vary", text);
        match one_varied(text, source) {
            Ok(input) => inputs.push(input),
            Err((place, wrong)) => Template::fault(&VALUES, &mut faults, source, place, wrong),
        }
    }
    if faults.is_empty() { Ok(inputs) } else { Err(SweepError::Model(template.reported(faults))) }
}

fn one_varied(text: &str, source: usize) -> Result<Input, (Range<usize>, Wrong)> {
    let Some((path, written)) = text.split_once('=').filter(|(path, _)| !path.trim().is_empty()) else {
        let help = "write it like material.steel.young=190GPa:210GPa:5";
        return Err((0..text.len(), ("there is no `=` between a key and its values".to_string(), help.to_string())));
    };
    let (items, by_factors) = values::read(written, path.len() + 1)?;
    Ok(Input { path: path.trim().to_string(), source, key: 0..path.trim_end().len(), items, by_factors })
}

/// The columns of a table.
fn tabled(file: &Path, template: &mut Template) -> Result<Vec<Input>, SweepError> {
    let name = file.display().to_string();
    let text = std::fs::read_to_string(file).map_err(|source| SweepError::Table { path: file.to_path_buf(), source })?;
    let source = template.add_source(&name, text.strip_prefix('\u{feff}').unwrap_or(&text));
    let mut faults = Faults::default();
    let rows = values::table(template.source(source));
    let Some((header, rows)) = rows.split_first().filter(|(_, rows)| !rows.is_empty()) else {
        let wrong = ("the table has no row".to_string(), "its first line names keys, each further line is a run".to_string());
        Template::fault(&VALUES, &mut faults, source, 0..0, wrong);
        return Err(SweepError::Model(template.reported(faults)));
    };
    let mut inputs: Vec<Input> = Vec::new();
    let mut units = Vec::new();
    for field in header {
        let (path, unit) = values::path_and_unit(&field.text);
        inputs.push(Input { path: path.to_string(), source, key: field.place.clone(), items: Vec::new(), by_factors: false });
        units.push(unit.to_string());
    }
    for row in rows {
        if row.len() != header.len() {
            let place = row.first().map_or(0..0, |first| first.place.start..row.last().map_or(first.place.end, |last| last.place.end));
            let message = format!("this row has {} values for {} keys", row.len(), header.len());
            Template::fault(
                &VALUES,
                &mut faults,
                source,
                place,
                (message, "values with a comma in them stand in double quotes".to_string()),
            );
            continue;
        }
        for ((input, unit), field) in inputs.iter_mut().zip(&units).zip(row) {
            if field.text.is_empty() {
                let wrong = (format!("`{}` has no value here", input.path), "every run needs a value for every key".to_string());
                Template::fault(&VALUES, &mut faults, source, field.place.clone(), wrong);
            }
            input.items.push(values::with_unit(field, unit));
        }
    }
    if faults.is_empty() { Ok(inputs) } else { Err(SweepError::Model(template.reported(faults))) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_meets_every_other_one_and_the_last_changes_fastest() {
        assert_eq!(factorial(&[2, 3]), [[0, 0], [0, 1], [0, 2], [1, 0], [1, 1], [1, 2]].map(Vec::from));
        assert_eq!(factorial(&[2]), [[0], [1]].map(Vec::from));
    }
}
