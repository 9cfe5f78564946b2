//! What the report of a case draws: columns of the history that checks look at, and what is expected of them.
//!
//! Checks come from `case.rs`, curves from `quantity.rs`; `report.rs` turns both into pictures.

use super::case::{Accepted, Case, Check, How, Source};
use super::quantity::Samples;
use crate::picture::svg::decimated;
use crate::results::unit;

/// Points of a curve.
const POINTS: usize = 160;
/// Models of one plot, and plots of one case: what a reader can take in.
const CURVES: usize = 4;
const PLOTS: usize = 4;

/// A column of the history with what is expected of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
    /// Name of the column.
    pub column: String,
    /// Its unit; empty for a pure number.
    pub si: &'static str,
    /// Models and their curves: time, s, and value, SI.
    pub curves: Vec<(String, Vec<[f64; 2]>)>,
    /// Expected values.
    pub marks: Vec<Mark>,
}

/// An expected value within a plot.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// From where to where it is expected: two corners, time and value; one point twice where it belongs to
    /// one time.
    pub ends: [[f64; 2]; 2],
    /// What is accepted above and below.
    pub tolerance: f64,
}

impl Plot {
    /// The plots of a case, in the order of its checks.
    pub(super) fn of(case: &Case, runs: &[(&str, &Samples)]) -> Vec<Self> {
        let mut plots: Vec<Self> = Vec::new();
        for check in case.checks.iter().filter(|check| check.with.is_none()) {
            let Some(column) = column(&check.quantity.source) else { continue };
            for model in &check.models {
                let Some((_, samples)) = runs.iter().find(|(name, _)| name == model) else { continue };
                let Ok(curve) = samples.curve(column, [None, None]) else { continue };
                let Some(mark) = mark(check, &curve) else { continue };
                let at = plots.iter().position(|plot| plot.column == column).unwrap_or_else(|| {
                    let whole = case.models.iter().any(|(name, described)| name == model && described.is_of_whole_bodies());
                    plots.push(Self { column: column.to_string(), si: unit(column, whole), curves: Vec::new(), marks: Vec::new() });
                    plots.len() - 1
                });
                plots[at].add(model, &curve, mark);
            }
        }
        plots.truncate(PLOTS);
        plots
    }

    fn add(&mut self, model: &str, curve: &[[f64; 2]], mark: Mark) {
        if !self.curves.iter().any(|(name, _)| name == model) {
            if self.curves.len() == CURVES {
                return;
            }
            self.curves.push((model.to_string(), decimated(curve, POINTS)));
        }
        if !self.marks.contains(&mark) {
            self.marks.push(mark);
        }
    }
}

/// The column that a quantity looks at.
fn column(source: &Source) -> Option<&str> {
    match source {
        Source::HistoryAt(column, _) | Source::History { column, .. } => Some(column),
        _ => None,
    }
}

/// Where in the plot of its column a check's value is expected; `None` where the value is none of the
/// column's, or where only limits are known.
fn mark(check: &Check, curve: &[[f64; 2]]) -> Option<Mark> {
    let (expected, tolerance) = match check.accepted {
        Accepted::Relative { expected, tolerance } => (expected, tolerance * expected.abs()),
        Accepted::Absolute { expected, tolerance } => (expected, tolerance),
        Accepted::Converges { expected, .. } => (expected, 0.0),
        Accepted::Limits { .. } => return None,
    };
    let (first, last) = (curve.first()?[0], curve.last()?[0]);
    let along = |begin: f64, end: f64| Some(Mark { ends: [[begin, expected], [end, expected]], tolerance });
    match &check.quantity.source {
        Source::HistoryAt(_, at) => along(*at, *at),
        Source::History { take, during, level, .. } => match take.how {
            How::Mean | How::Max | How::Min => along(during[0].unwrap_or(first), during[1].unwrap_or(last)),
            How::Last => along(last, last),
            how if how.has_level() => Some(Mark { ends: [[expected - tolerance, *level], [expected + tolerance, *level]], tolerance: 0.0 }),
            _ => None,
        },
        _ => None,
    }
}
