//! The verdicts: what was found against what was expected.
//!
//! Runs a case through `run.rs`, takes its numbers through `quantity.rs`, and compares. Every comparison is
//! written so that NaN fails.

use super::case::{Accepted, Case, Check, Combination};
use super::plot::Plot;
use super::quantity::Samples;
use super::run::{ModelRun, VerifyError};
use crate::numbers::{per_cent, significant};
use embate_solver::simulation::{Control, Options, Progress};
use serde::Serialize;
use std::path::Path;

/// A case with its verdicts.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CaseOutcome {
    /// Name of the case.
    pub case: String,
    /// What is verified.
    pub title: String,
    /// One for each check and model.
    pub checks: Vec<CheckOutcome>,
    /// Columns of the history over which its checks look, for the report.
    #[serde(skip)]
    pub plots: Vec<Plot>,
}

/// A check of one model with its verdict.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct CheckOutcome {
    /// What is compared.
    pub check: String,
    /// Of which model.
    pub model: String,
    /// Whether it holds.
    pub passed: bool,
    /// The number that was found; `None`: there is none, and `note` says why.
    pub found: Option<f64>,
    /// The number that was expected.
    pub expected: Option<f64>,
    /// Largest deviation that is accepted: a fraction of the expected value if `relative`.
    pub tolerance: Option<f64>,
    /// The deviation, in the measure of `tolerance`; of a check for convergence, as a fraction of the coarser
    /// model's.
    pub deviation: Option<f64>,
    /// Whether tolerance and deviation are fractions.
    pub relative: bool,
    /// The coarser model of a check for convergence.
    pub converges_from: Option<String>,
    /// Smallest value that is accepted.
    pub at_least: Option<f64>,
    /// Largest value that is accepted.
    pub at_most: Option<f64>,
    /// Where the value and the tolerance come from.
    pub reason: String,
    /// Why there is no number; else empty.
    pub note: String,
}

impl CaseOutcome {
    /// Whether all checks hold; a case without checks proves nothing and does not pass.
    #[must_use]
    pub fn passed(&self) -> bool {
        !self.checks.is_empty() && self.checks.iter().all(|check| check.passed)
    }
}

impl CheckOutcome {
    /// What is accepted, in words.
    #[must_use]
    pub fn expectation(&self) -> String {
        match (self.expected, self.tolerance, self.at_least, self.at_most) {
            (Some(value), Some(tolerance), ..) => match &self.converges_from {
                Some(coarser) => format!("{}, {} of the error of {coarser}", significant(value), per_cent(tolerance)),
                None if self.relative => format!("{} ± {}", significant(value), per_cent(tolerance)),
                None => format!("{} ± {}", significant(value), significant(tolerance)),
            },
            (.., Some(least), Some(most)) => format!("{} to {}", significant(least), significant(most)),
            (.., Some(least), None) => format!("≥ {}", significant(least)),
            (.., None, Some(most)) => format!("≤ {}", significant(most)),
            _ => String::new(),
        }
    }

    /// What was found; a dash where nothing was.
    #[must_use]
    pub fn finding(&self) -> String {
        self.found.map_or("-".to_string(), significant)
    }

    /// The deviation in the measure of the tolerance; empty where only limits hold.
    #[must_use]
    pub fn error(&self) -> String {
        self.deviation.map_or(String::new(), if self.relative { per_cent } else { significant })
    }

    /// Whether it holds, and if not, why there is no number.
    #[must_use]
    pub fn verdict(&self) -> String {
        match (self.passed, self.note.as_str()) {
            (true, _) => "holds".to_string(),
            (false, "") => "FAILS".to_string(),
            (false, note) => format!("FAILS: {note}"),
        }
    }

    /// How much of what is accepted was used up: 1 is the border. `None` where there is no such measure: a
    /// range, a limit at zero, no number.
    #[must_use]
    pub fn share(&self) -> Option<f64> {
        let share = match (self.deviation, self.tolerance, self.at_least, self.at_most) {
            (Some(deviation), Some(tolerance), ..) if tolerance > 0.0 => deviation / tolerance,
            (.., None, Some(most)) if most > 0.0 => self.found?.max(0.0) / most,
            (.., Some(least), None) if least > 0.0 => least / self.found?.max(0.0),
            _ => return None,
        };
        share.is_finite().then_some(share)
    }
}

impl Check {
    /// The coarser model of a check for convergence.
    pub(super) fn coarser(&self) -> Option<&str> {
        if let Accepted::Converges { model, .. } = &self.accepted { Some(model) } else { None }
    }
}

/// Runs all models of a case and checks its checks. With `keep`, a folder and whether older results in it are
/// replaced, the results lie in `folder/CASE/MODEL` afterwards.
///
/// # Errors
/// Only what keeps the case from being run: a run that fails makes its checks fail.
pub fn verify(
    case: &Case,
    options: &Options,
    keep: Option<(&Path, bool)>,
    on_progress: &mut dyn FnMut(&Progress<'_>) -> Control,
) -> Result<CaseOutcome, VerifyError> {
    let mut runs = Vec::new();
    for (name, model) in &case.models {
        runs.push((name.as_str(), case.run_model((name, model), options, keep, on_progress)?));
    }
    let checks = case.checks.iter().flat_map(|check| check.models.iter().map(|model| outcome(check, model, &runs))).collect();
    let samples: Vec<(&str, &Samples)> = runs.iter().map(|(name, run)| (*name, &run.samples)).collect();
    Ok(CaseOutcome { case: case.name.clone(), title: case.title.clone(), checks, plots: Plot::of(case, &samples) })
}

fn outcome(check: &Check, model: &str, runs: &[(&str, ModelRun)]) -> CheckOutcome {
    let blank =
        CheckOutcome { check: check.name.clone(), model: model.to_string(), reason: check.reason.clone(), ..CheckOutcome::default() };
    let blank = match check.accepted.clone() {
        Accepted::Relative { expected, tolerance } => {
            CheckOutcome { expected: Some(expected), tolerance: Some(tolerance), relative: true, ..blank }
        }
        Accepted::Absolute { expected, tolerance } => CheckOutcome { expected: Some(expected), tolerance: Some(tolerance), ..blank },
        Accepted::Converges { expected, model, fraction } => {
            CheckOutcome { expected: Some(expected), tolerance: Some(fraction), relative: true, converges_from: Some(model), ..blank }
        }
        Accepted::Limits { least, most } => CheckOutcome { at_least: least, at_most: most, ..blank },
    };
    let found = number(check, model, runs);
    let coarser = check.coarser().map(|coarser| number(check, coarser, runs)).transpose();
    match (found, coarser) {
        (Ok(found), Ok(coarser)) => {
            let (deviation, passed) = compared(&check.accepted, found, coarser);
            CheckOutcome { found: Some(found), deviation, passed, ..blank }
        }
        (found, coarser) => {
            CheckOutcome { found: found.as_ref().ok().copied(), note: found.and(coarser.map(|_| 0.0)).err().unwrap_or_default(), ..blank }
        }
    }
}

/// The deviation, and whether it is accepted.
fn compared(accepted: &Accepted, found: f64, coarser: Option<f64>) -> (Option<f64>, bool) {
    match *accepted {
        Accepted::Relative { expected, tolerance } => {
            let deviation = (found - expected).abs() / expected.abs();
            (Some(deviation), deviation <= tolerance)
        }
        Accepted::Absolute { expected, tolerance } => {
            let deviation = (found - expected).abs();
            (Some(deviation), deviation <= tolerance)
        }
        Accepted::Converges { expected, fraction, .. } => {
            let deviation = (found - expected).abs() / (coarser.unwrap_or(f64::NAN) - expected).abs();
            (Some(deviation), deviation <= fraction)
        }
        Accepted::Limits { least, most } => {
            let passed = least.is_none_or(|least| found >= least) && most.is_none_or(|most| found <= most);
            (None, passed && found.is_finite())
        }
    }
}

/// The number of a check for one model.
fn number(check: &Check, model: &str, runs: &[(&str, ModelRun)]) -> Result<f64, String> {
    let of = |name: &str, source| {
        let (_, run) = runs.iter().find(|(known, _)| *known == name).ok_or_else(|| format!("`{name}` was not run"))?;
        match &run.error {
            Some(error) => Err(format!("`{name}`: {error}")),
            None => run.samples.number(source),
        }
    };
    let own = of(model, &check.quantity.source)?;
    let value = match &check.with {
        None => own,
        Some(with) => {
            let other = of(with.model.as_deref().unwrap_or(model), &with.quantity.source)?;
            match with.how {
                Combination::Over => own / other,
                Combination::Minus => own - other,
            }
        }
    };
    if value.is_finite() { Ok(value) } else { Err(format!("it is {value}")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nan_and_infinity_pass_nothing() {
        let all = [
            Accepted::Relative { expected: 1.0, tolerance: 1e300 },
            Accepted::Absolute { expected: 1.0, tolerance: f64::MAX },
            Accepted::Converges { expected: 1.0, model: String::new(), fraction: 0.9 },
            Accepted::Limits { least: Some(f64::MIN), most: None },
            Accepted::Limits { least: None, most: Some(f64::MAX) },
            Accepted::Limits { least: None, most: None },
        ];
        for accepted in all {
            for found in [f64::NAN, f64::INFINITY] {
                assert!(!compared(&accepted, found, Some(2.0)).1, "{accepted:?} {found}");
            }
            for coarser in [f64::NAN, 1.0] {
                assert!(
                    accepted != Accepted::Converges { expected: 1.0, model: String::new(), fraction: 0.9 }
                        || !compared(&accepted, 1.0, Some(coarser)).1
                );
            }
        }
    }

    #[test]
    fn the_borders_belong_to_what_is_accepted() {
        assert!(compared(&Accepted::Relative { expected: -4.0, tolerance: 0.25 }, -5.0, None).1);
        assert!(compared(&Accepted::Absolute { expected: 0.0, tolerance: 0.5 }, -0.5, None).1);
        assert!(!compared(&Accepted::Absolute { expected: 0.0, tolerance: 0.5 }, 0.5000001, None).1);
        assert!(compared(&Accepted::Limits { least: Some(1.0), most: Some(2.0) }, 2.0, None).1);
        assert!(!compared(&Accepted::Limits { least: Some(1.0), most: Some(2.0) }, 0.9, None).1);
        let converges = Accepted::Converges { expected: 1.0, model: String::new(), fraction: 0.5 };
        assert!(compared(&converges, 1.5, Some(0.0)).1 && !compared(&converges, 1.6, Some(0.0)).1);
    }
}
