//! Fits: values of keys with which a model follows what was measured, by least squares.
//!
//! The walk: keys with their bounds and what was measured (`asked.rs`) -> a search (`search.rs`), which asks
//! for runs -> these, as a sweep whose values go together ([`super::Sweep`]), and their curves at the places
//! where something was measured (`follow.rs`) -> the table of all runs. The program's command `fit` asks and
//! reports; `embate.calibrate` of Python does the same with scipy.

mod asked;
mod follow;
mod search;

pub use follow::{Missed, followed};

use super::run::Numbers;
use super::run::Running;
use super::{Keep, Request, Sweep, SweepError};
use crate::PathPolicy;
use crate::results::{ResultsError, append_number, append_text, write_whole};
use crate::verification::Samples;
use asked::{Parameter, Target, What};
use search::{Search, squares};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Name of the table in the folder of a fit.
pub const TABLE_NAME: &str = "fit.csv";
/// Runs beyond these ask for a sweep or a better model.
const RUNS_MAX: usize = 100_000;

/// What a user asks for.
#[derive(Clone, Copy, Debug)]
pub struct Wanted<'a> {
    /// `KEY=LOWEST:HIGHEST` or `KEY=LOWEST:FIRST:HIGHEST` for each key.
    pub varied: &'a [String],
    /// `OUTPUT=VALUE`, `COLUMN=FILE` or `COLUMN over COLUMN=FILE` for each thing measured.
    pub measured: &'a [String],
    /// Length of the differences between runs, a part of the range of each key.
    pub step: f64,
    /// Relative change of the sum of squares, or change of all keys as parts of their ranges, at which it
    /// ends.
    pub tolerance: f64,
    /// Most runs, about.
    pub runs: usize,
}

/// A fit that can run.
#[derive(Debug)]
pub struct Fit<'a> {
    model: PathBuf,
    reach: PathPolicy,
    set: &'a [String],
    simd: Option<String>,
    search: Search,
    parameters: Vec<Parameter>,
    targets: Vec<Target>,
    outputs: Vec<String>,
    name: String,
}

/// How a fit is run; changes no result.
#[derive(Clone, Copy)]
pub struct Fitting<'a> {
    /// Where the table goes.
    pub folder: &'a Path,
    /// Whether one that is there goes.
    pub force: bool,
    /// Runs at a time.
    pub jobs: usize,
    /// Whether the user wants it to stop.
    pub is_stopped: &'a (dyn Fn() -> bool + Sync),
    /// Reported after some runs: how many there were, and the smallest residual so far.
    pub on_advance: &'a (dyn Fn(usize, f64) + Sync),
}

/// A key and the value found.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// Its path.
    pub path: String,
    /// SI.
    pub value: f64,
    /// Standard error, SI, as far as the fit is linear near the value; infinite where what was measured does
    /// not say the value.
    pub error: f64,
    /// Unit in SI; may be empty.
    pub unit: String,
    /// Whether it is one of the bounds.
    pub is_at_bound: bool,
}

/// What a fit has found.
#[derive(Clone, Debug, PartialEq)]
pub struct Ended {
    /// The keys, in the order in which they were named.
    pub keys: Vec<Fitted>,
    /// Root mean square of the differences, each a part of the largest measured value.
    pub residual: f64,
    /// The same before.
    pub residual_first: f64,
    /// Number of runs.
    pub runs: usize,
    /// Whether the search came to an end by itself.
    pub is_converged: bool,
}

/// A run.
struct Row {
    values: Vec<f64>,
    residual: Result<f64, String>,
}

impl<'a> Fit<'a> {
    /// Reads what is asked for, and examines the models at the first values and at all bounds.
    ///
    /// # Errors
    /// All faults at once. `None` where `is_stopped` ended the examination.
    pub fn prepare(
        model: &Path,
        reach: PathPolicy,
        set: &'a [String],
        wanted: Wanted<'_>,
        simd: Option<String>,
        jobs: usize,
        is_stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Self>, SweepError> {
        let parameters = asked::parameters(wanted.varied)?;
        let targets = asked::targets(wanted.measured)?;
        let outputs = targets.iter().flat_map(Target::outputs).collect();
        // Derivatives and four tries for each step.
        let steps = (wanted.runs.min(RUNS_MAX) / (parameters.len() + 4)).max(1);
        let search = Search { step: wanted.step, tolerance: wanted.tolerance, steps };
        let model = model.to_path_buf();
        let mut fit = Self { model, reach, set, simd, search, parameters, targets, outputs, name: String::new() };
        let bound = |high: bool| fit.parameters.iter().map(|_| f64::from(u8::from(high))).collect();
        let places = [fit.first(), bound(false), bound(true)];
        let Some(sweep) = fit.sweep(&places, jobs, is_stopped)? else { return Ok(None) };
        fit.name = sweep.first().name.clone();
        Ok(Some(fit))
    }

    /// Name of the model.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Runs the fit and writes the table of its runs. `None`: the user stopped it.
    ///
    /// # Errors
    /// The first run fails; results that can't be written.
    pub fn run(&self, fitting: &Fitting<'_>) -> Result<Option<Ended>, SweepError> {
        let table = fitting.folder.join(TABLE_NAME);
        if !fitting.force && table.exists() {
            return Err(ResultsError::Exists { path: fitting.folder.into(), found: TABLE_NAME.into() }.into());
        }
        std::fs::create_dir_all(fitting.folder).map_err(ResultsError::file("create", fitting.folder))?;
        let (mut rows, mut known) = (Vec::<Row>::new(), BTreeMap::<Vec<u64>, Option<Vec<f64>>>::new());
        let mut stopped = false;
        let mut evaluate = |places: &[Vec<f64>]| -> Result<Vec<Option<Vec<f64>>>, Interrupted> {
            let bits = |place: &Vec<f64>| place.iter().map(|x| x.to_bits()).collect::<Vec<u64>>();
            let mut new: Vec<Vec<f64>> = Vec::new();
            for place in places {
                if !known.contains_key(&bits(place)) && !new.contains(place) {
                    new.push(place.clone());
                }
            }
            if !new.is_empty() {
                let Some(found) = self.runs(&new, fitting).map_err(Interrupted::By)? else {
                    stopped = true;
                    return Err(Interrupted::ByUser);
                };
                for (place, found) in new.into_iter().zip(found) {
                    let residuals = found.map(|outputs| self.residuals(&outputs));
                    let residual = residuals.as_ref().map(|residuals| self.size(residuals)).map_err(Clone::clone);
                    rows.push(Row { values: self.values(&place), residual });
                    known.insert(bits(&place), residuals.ok());
                }
                let least = rows.iter().filter_map(|row| row.residual.as_ref().ok().copied()).fold(f64::INFINITY, f64::min);
                (fitting.on_advance)(rows.len(), least);
            }
            Ok(places.iter().map(|place| known.get(&bits(place)).cloned().flatten()).collect())
        };
        let found = self.search.run(&self.first(), &mut evaluate);
        write_whole(&table, self.table(&rows).as_bytes())?;
        let found = match found {
            Err(Interrupted::By(error)) => return Err(error),
            Err(Interrupted::ByUser) => return Ok(None),
            Ok(None) => {
                let error = rows.into_iter().next().and_then(|row| row.residual.err()).unwrap_or_default();
                return Err(SweepError::FirstRun(error));
            }
            Ok(Some(found)) => found,
        };
        let residual_first = rows.first().and_then(|row| row.residual.clone().ok()).unwrap_or(f64::NAN);
        let values = self.values(&found.at);
        let keys = self.parameters.iter().zip(values).zip(found.errors()).zip(&found.at).map(|(((parameter, value), error), at)| Fitted {
            path: parameter.path.clone(),
            value,
            error: error * (parameter.high - parameter.low),
            unit: parameter.unit.clone(),
            is_at_bound: !(1e-3..=1.0 - 1e-3).contains(at),
        });
        let (residual, runs, is_converged) = (self.size(&found.residuals), rows.len(), found.is_converged);
        Ok(Some(Ended { keys: keys.collect(), residual, residual_first, runs, is_converged }))
    }

    /// The first values as parts of their ranges.
    fn first(&self) -> Vec<f64> {
        self.parameters.iter().map(|it| (it.first - it.low) / (it.high - it.low)).collect()
    }

    fn values(&self, place: &[f64]) -> Vec<f64> {
        self.parameters.iter().zip(place).map(|(it, share)| it.low + share * (it.high - it.low)).collect()
    }

    /// The runs at some places, as a sweep.
    fn sweep(&self, places: &[Vec<f64>], jobs: usize, is_stopped: &(dyn Fn() -> bool + Sync)) -> Result<Option<Sweep>, SweepError> {
        let values: Vec<Vec<f64>> = places.iter().map(|place| self.values(place)).collect();
        let text = |(number, parameter): (usize, &Parameter)| {
            let all: Vec<String> = values.iter().map(|row| format!("{:?}", row[number])).collect();
            format!("{}={}", parameter.path, all.join(","))
        };
        let varied: Vec<String> = self.parameters.iter().enumerate().map(text).collect();
        Sweep::prepare(&self.model, self.reach, self.set, Request::Zip(&varied), &self.outputs, self.simd.clone(), jobs, is_stopped)
    }

    /// Outputs at some places; of a run that fails the reason.
    fn runs(&self, places: &[Vec<f64>], fitting: &Fitting<'_>) -> Result<Option<Vec<Numbers>>, SweepError> {
        let Some(sweep) = self.sweep(places, fitting.jobs, fitting.is_stopped)? else { return Ok(None) };
        let running = Running {
            folder: fitting.folder,
            keep: Keep::Rows,
            force: false,
            jobs: fitting.jobs,
            user_cpu_seconds: || None,
            is_stopped: fitting.is_stopped,
            on_advance: &|_| (),
        };
        sweep.numbers(&running, &|samples, number| self.seen(samples, number))
    }

    /// What a run gives for everything measured; `number` finds an output of the sweep.
    fn seen(&self, samples: &Samples, number: &dyn Fn(&str) -> Result<f64, String>) -> Numbers {
        let mut seen = Vec::new();
        for target in &self.targets {
            match &target.what {
                What::Number(output) => seen.push(number(output)?),
                What::Curve { column, over, places, file } => {
                    let [x, y] = [over, column].map(|name| samples.values(name));
                    let values = followed(&x?, &y?, places);
                    seen.extend(
                        values.map_err(|missed| format!("`{column} over {over}`, point {} of {file}: {missed}", missed.number + 1))?,
                    );
                }
            }
        }
        if seen.iter().all(|value| value.is_finite()) { Ok(seen) } else { Err("the run has not all that was measured".to_string()) }
    }

    /// Differences as parts of the largest measured value; the mean over a curve counts as much as a number.
    fn residuals(&self, outputs: &[f64]) -> Vec<f64> {
        let mut rest = outputs.iter();
        let of = |target: &Target| {
            let scale = 1.0 / (target.size * (target.values.len() as f64).sqrt());
            target.values.iter().zip(rest.by_ref()).map(|(wanted, found)| scale * (found - wanted)).collect::<Vec<f64>>()
        };
        self.targets.iter().flat_map(of).collect()
    }

    /// Root mean square over what was measured.
    fn size(&self, residuals: &[f64]) -> f64 {
        (squares(residuals) / self.targets.len().max(1) as f64).sqrt()
    }

    fn table(&self, rows: &[Row]) -> String {
        let mut out = String::from("run");
        for Parameter { path, unit, .. } in &self.parameters {
            out.push(',');
            append_text(&mut out, &if unit.is_empty() { path.clone() } else { format!("{path} [{unit}]") });
        }
        out.push_str(",residual,error\n");
        for (number, row) in rows.iter().enumerate() {
            out.push_str(&(number + 1).to_string());
            for &value in &row.values {
                out.push(',');
                append_number(&mut out, value);
            }
            out.push(',');
            match &row.residual {
                Ok(residual) => {
                    append_number(&mut out, *residual);
                    out.push(',');
                }
                Err(error) => {
                    out.push(',');
                    append_text(&mut out, error);
                }
            }
            out.push('\n');
        }
        out
    }
}

/// What ends a search before its end.
enum Interrupted {
    ByUser,
    By(SweepError),
}
