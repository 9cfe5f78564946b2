//! Channels: formulas of the history's columns, filtered where the model says so, and what they come to.
//!
//! Formulas are read when a simulation is made, with the names of its columns; they are evaluated on a whole
//! history, after the run. A column's name with a minus in it is one name: the longest that fits counts.

pub mod filter;
mod series;

use crate::error::{Fault, Warning};
use crate::expression::{Expression, Words, Wrong};
use crate::model::Model;
use crate::model::messages::{COARSE_CHANNEL, FORMULA};
use filter::Filter;
use series::SERIES;

/// The functions of series, with what they are: for the documentation.
pub fn functions() -> impl Iterator<Item = (&'static str, &'static str)> {
    SERIES.iter().map(|it| (it.name, it.doc))
}

/// Columns of a history.
struct Columns<'a> {
    names: &'a [String],
    functions: Vec<(&'static str, usize)>,
}

impl<'a> Columns<'a> {
    fn new(names: &'a [String]) -> Self {
        Self { names, functions: SERIES.iter().map(|it| (it.name, it.takes)).collect() }
    }
}

impl Words for Columns<'_> {
    fn variable(&self, text: &str) -> Option<(usize, usize)> {
        let ends = |rest: &str| !rest.starts_with(|c: char| c.is_alphanumeric() || matches!(c, '_' | '.' | '['));
        let fits = |name: &str| text.strip_prefix(name).is_some_and(ends);
        let longest = self.names.iter().enumerate().filter(|(_, name)| fits(name)).max_by_key(|(_, name)| name.len());
        longest.map(|(index, name)| (name.len(), index)).or_else(|| fits("t").then_some((1, 0)))
    }

    fn variables(&self) -> Vec<&str> {
        self.names.iter().map(String::as_str).collect()
    }

    fn functions(&self) -> &[(&'static str, usize)] {
        &self.functions
    }
}

/// The channels of a model.
#[derive(Clone, Debug, Default)]
pub struct Channels(Vec<Channel>);

#[derive(Clone, Debug)]
struct Channel {
    name: String,
    formula: Expression,
    filter: Option<Filter>,
}

/// What a channel comes to.
#[derive(Clone, Debug, PartialEq)]
pub struct Figures {
    /// Its name.
    pub name: String,
    /// Its values, in the rows of the history.
    pub values: Vec<f64>,
    /// The largest value and its time, s.
    pub max: [f64; 2],
    /// The smallest value and its time, s.
    pub min: [f64; 2],
}

impl Channels {
    /// Those of a model whose history has these columns.
    ///
    /// # Errors
    /// Formulas that can't be read.
    pub fn new(model: &Model, columns: &[String]) -> Result<Self, Vec<Fault>> {
        let (mut names, mut channels, mut faults) = (columns.to_vec(), Vec::new(), Vec::new());
        for (index, channel) in model.channels.iter().enumerate() {
            match Expression::parse_with(&channel.expression, &Columns::new(&names)) {
                Ok(formula) => channels.push(Channel { name: channel.name.clone(), formula, filter: channel.filter }),
                Err(wrong) => faults.push(Fault::new(
                    &FORMULA,
                    format!("channel[{index}].expression"),
                    format!("at character {}: {}", wrong.at, wrong.message),
                    "name columns of history.csv, such as `A.y - B.y`",
                )),
            }
            // The following may use it.
            names.push(channel.name.clone());
        }
        if faults.is_empty() { Ok(Self(channels)) } else { Err(faults) }
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Their values for a history: its columns in the order of [`Channels::new`], the first of them the time.
    #[must_use]
    pub fn evaluate(&self, columns: &[Vec<f64>]) -> Vec<Figures> {
        let Some(times) = columns.first() else { return Vec::new() };
        let mut found: Vec<Figures> = Vec::new();
        for channel in &self.0 {
            let known: Vec<&[f64]> = columns.iter().map(Vec::as_slice).chain(found.iter().map(|it| it.values.as_slice())).collect();
            let call = |function: usize, arguments: Vec<Vec<f64>>| (SERIES[function].of)(times, &arguments);
            let mut values = channel.formula.series(times.len(), &known, &call);
            if let Some(filter) = channel.filter {
                values = filter.apply(times, &values);
            }
            let extreme = |is_further: fn(f64, f64) -> bool| {
                let further = |best: [f64; 2], (&value, &time): (&f64, &f64)| {
                    if best[0].is_nan() || is_further(value, best[0]) { [value, time] } else { best }
                };
                values.iter().zip(times).filter(|(value, _)| !value.is_nan()).fold([f64::NAN; 2], further)
            };
            let (max, min) = (extreme(|a, b| a > b), extreme(|a, b| a < b));
            found.push(Figures { name: channel.name.clone(), values, max, min });
        }
        found
    }
}

/// The values of a formula, filtered, for a history: its columns, the first of them the time.
///
/// # Errors
/// The first thing that is wrong with the formula, with its place.
pub fn values(formula: &str, filter: Option<Filter>, names: &[String], columns: &[Vec<f64>]) -> Result<Vec<f64>, Wrong> {
    let formula = Expression::parse_with(formula, &Columns::new(names))?;
    let channels = Channels(vec![Channel { name: String::new(), formula, filter }]);
    Ok(channels.evaluate(columns).pop().map(|found| found.values).unwrap_or_default())
}

/// Filters for which the rows of the history are too far apart.
pub(crate) fn warnings(model: &Model) -> impl Iterator<Item = Warning> {
    let interval = model.history_interval();
    let of = move |(index, filter): (usize, Filter)| {
        (interval > filter.longest_interval() * (1.0 + 1e-9)).then(|| Warning {
            kind: &COARSE_CHANNEL,
            path: format!("channel[{index}]"),
            message: format!("rows of the history are {interval:.3e} s apart, and its filter needs {:.3e} s", filter.longest_interval()),
            consequence: "frequencies above half the rate of the rows are folded down into what the filter lets pass".into(),
            help: format!("write rows more often: `output.history = \"{:.3e} s\"`", filter.longest_interval()),
        })
    };
    model.channels.iter().enumerate().filter_map(|(index, channel)| Some((index, channel.filter?))).filter_map(of)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model;

    fn channels(formulas: &[(&str, &str)], columns: &[&str]) -> Result<Channels, Vec<String>> {
        let channel = |(name, text): &(&str, &str)| model::Channel { name: (*name).into(), expression: (*text).into(), filter: None };
        let model = Model { channels: formulas.iter().map(channel).collect(), ..Model::default() };
        let columns: Vec<String> = columns.iter().map(ToString::to_string).collect();
        Channels::new(&model, &columns).map_err(|faults| faults.iter().map(ToString::to_string).collect())
    }

    #[test]
    fn formulas_use_columns_with_any_names_and_earlier_channels() {
        let columns = ["time", "A.y", "A.y-b", "contact.force_x[a-b]", "contact.force_x[all:a-b]"];
        let found = channels(
            &[
                ("d", "A.y - contact.force_x[a-b]*2"),
                ("e", "d + t + A.y-b"),
                ("f", "abs(contact.force_x[all:a-b]) - first(A.y)"),
                ("g", "A.y^2"),
            ],
            &columns,
        )
        .unwrap();
        let values = [vec![0.0, 1.0], vec![10.0, 20.0], vec![100.0, 200.0], vec![1.0, 2.0], vec![-5.0, -7.0]];
        let figures = found.evaluate(&values);
        assert_eq!(figures[0].values, [8.0, 16.0]);
        assert_eq!(figures[1].values, [108.0, 217.0]);
        assert_eq!(figures[2].values, [-5.0, -3.0]);
        assert_eq!((figures[3].max, figures[3].min), ([400.0, 1.0], [100.0, 0.0]));
        let names: Vec<String> = columns.iter().map(ToString::to_string).collect();
        assert_eq!(super::values("A.y - contact.force_x[a-b]*2", None, &names, &values).unwrap(), [8.0, 16.0]);
        assert_eq!(super::values("A.q", None, &names, &values).unwrap_err().at, 1);
    }

    #[test]
    fn what_is_wrong_is_reported_with_its_place_and_a_name_that_is_like_it() {
        let columns = ["time", "tip.ax", "tip.ay"];
        for (text, says) in [
            ("tip.az", "there is no `tip.az`; did you mean `tip.a"),
            ("hic15(tip.ax, 2)", "`hic15` takes 1 argument(s), not 2"),
            ("nothing_like_it_at_all", "columns of the history, pi, sin"),
            ("cfc60 tip.ax", "in parentheses"),
            ("tip.ax +", "ends where"),
        ] {
            let faults = channels(&[("c", text)], &columns).unwrap_err();
            assert!(faults[0].contains(says) && faults[0].contains("channel[0].expression"), "{text}: {faults:?}");
        }
    }
}
