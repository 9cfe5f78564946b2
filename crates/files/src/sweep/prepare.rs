//! Every run of a sweep looked at before the first one begins: its model, its mesh, and whether it will have
//! what is to be noted.
//!
//! Plans come from `plan.rs`; all faults of all runs are reported at once, each with the runs that have it. A
//! [`Sweep`] without faults goes to `run.rs`.

use super::outputs::{self, Output};
use super::plan::{Plan, Request};
use super::{Keep, SweepError};
use crate::PathPolicy;
use crate::model_file::{Diagnostics, Faults, Template};
use crate::results::Report;
use crate::sweep::messages::WANTED;
use crate::verification::Samples;
use embate_solver::error::Error;
use embate_solver::hash::Fnv;
use embate_solver::model::Model;
use embate_solver::simulation::{Options, Simulation};
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A sweep that can run.
#[derive(Clone, Debug)]
pub struct Sweep {
    pub(super) template: Template,
    pub(super) plan: Plan,
    pub(super) outputs: Vec<Output>,
    pub(super) options: Options,
    /// The first run's model: for units and titles.
    pub(super) first: Model,
    /// Hash of each run's model.
    pub(super) hashes: Vec<String>,
}

/// What was found of a run.
struct Examined {
    hash: String,
    faults: Option<Diagnostics>,
    /// Outputs that it does not have: number and what is wrong.
    without: Vec<(usize, super::Wrong)>,
}

impl Sweep {
    /// Reads and examines all runs on so many threads. `reach`: from where files are read that the model
    /// names; `set` overrides keys of it; no `outputs`: the usual ones; `simd`: an instruction set by name.
    ///
    /// # Errors
    /// All faults at once. `None` where `is_stopped` ended the examination.
    pub fn prepare(
        model: &Path,
        reach: PathPolicy,
        set: &[String],
        request: Request<'_>,
        outputs: &[String],
        simd: Option<String>,
        jobs: usize,
        is_stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Self>, SweepError> {
        let mut template = Template::load(model, set, reach).map_err(SweepError::Model)?;
        let plan = Plan::read(request, &mut template)?;
        let options = Options { threads: 1, simd };
        // Where it has faults, they are reported below with those of the other runs.
        let first = template.model(&plan.changes(0)).unwrap_or_default();
        let mut sweep = Self { template, plan, outputs: Vec::new(), options, first, hashes: Vec::new() };
        let (places, faults) = sweep.read_outputs(outputs);
        let examined: Option<Vec<Examined>> =
            in_parallel(sweep.runs(), jobs, &|run| (!is_stopped()).then(|| sweep.examine(run))).into_iter().collect();
        let Some(examined) = examined else { return Ok(None) };
        let mut found = Vec::new();
        if !faults.is_empty() {
            found.push((0, sweep.template.reported(faults)));
        }
        let mut missing = Vec::new();
        for (run, examined) in examined.into_iter().enumerate() {
            sweep.hashes.push(examined.hash);
            found.extend(examined.faults.map(|faults| (run + 1, faults)));
            for (output, wrong) in examined.without {
                match places.get(output) {
                    None => missing.push(output), // a usual one, which not all runs have
                    Some(source) => {
                        let mut faults = Faults::default();
                        Template::fault(&WANTED, &mut faults, *source, 0..sweep.template.source(*source).len(), wrong);
                        found.push((run + 1, sweep.template.reported(faults)));
                    }
                }
            }
        }
        if !found.is_empty() {
            return Err(SweepError::Model(Diagnostics::merged(found, sweep.runs())));
        }
        let mut number = 0..;
        sweep.outputs.retain(|_| number.next().is_none_or(|number| !missing.contains(&number)));
        Ok(Some(sweep))
    }

    /// Number of runs.
    #[must_use]
    pub fn runs(&self) -> usize {
        self.plan.runs.len()
    }

    /// The first run's model.
    #[must_use]
    pub fn first(&self) -> &Model {
        &self.first
    }

    /// Makes the list of outputs from the columns of the first run. Gives the number of each one's text among
    /// the sources, none for the usual ones, and what is wrong with them.
    fn read_outputs(&mut self, wanted: &[String]) -> (Vec<usize>, Faults) {
        let simulation = self.model(0, Keep::Figures).ok().and_then(|model| Simulation::new(&model, &self.options).ok());
        // Without it what is wrong is reported elsewhere, and of outputs only their form is known.
        let samples = simulation.map_or_else(
            || Samples::recorded(Vec::new(), Vec::new(), serde_json::Value::Null),
            |simulation| samples(&simulation, &self.first),
        );
        let (mut sources, mut faults) = (Vec::new(), Faults::default());
        if wanted.is_empty() {
            let usual = outputs::usual(samples.columns());
            self.outputs = usual.iter().filter_map(|text| Output::read(text, &samples).ok()).collect();
        }
        for text in wanted {
            let source = self.template.add_source("--output", text);
            match Output::read(text, &samples) {
                Ok(output) => {
                    sources.push(source);
                    self.outputs.push(output);
                }
                Err(wrong) => Template::fault(&WANTED, &mut faults, source, 0..text.len(), wrong),
            }
        }
        (sources, faults)
    }

    fn reported(&self, run: usize, faults: Vec<embate_solver::error::Fault>) -> Diagnostics {
        self.template.reported_of_model(&self.plan.changes(run), faults)
    }

    /// The model of a run.
    pub(super) fn model(&self, run: usize, keep: Keep) -> Result<Model, Diagnostics> {
        let mut model = self.template.model(&self.plan.changes(run))?;
        if keep != Keep::Frames {
            without_frames(&mut model);
        }
        Ok(model)
    }

    fn examine(&self, run: usize) -> Examined {
        let mut model = match self.model(run, Keep::Frames) {
            Ok(model) => model,
            Err(faults) => return Examined { hash: String::new(), faults: Some(faults), without: Vec::new() },
        };
        let hash = hash(&model);
        without_frames(&mut model);
        let (faults, without) = match Simulation::new(&model, &self.options) {
            Ok(simulation) => {
                let samples = samples(&simulation, &model);
                let without = |(number, output): (usize, &Output)| Some((number, output.examine(&samples, model.run.end).err()?));
                (None, self.outputs.iter().enumerate().filter_map(without).collect())
            }
            Err(Error::Model(faults)) => (Some(self.reported(run, faults)), Vec::new()),
            Err(_) => (None, Vec::new()), // the run will fail, and its row say why
        };
        Examined { hash, faults, without }
    }
}

/// Nothing but the history: frames are made at the start and at the end only, and are small.
fn without_frames(model: &mut Model) {
    model.output.pictures = false;
    model.output.picture_field = String::new();
    model.output.fields = embate_solver::model::Cadence::Count(1);
    model.output.include = vec!["displacement".to_string()];
}

/// What a run will have, before it has begun.
fn samples(simulation: &Simulation, model: &Model) -> Samples {
    let summary = Report::of(&simulation.summary(), &model.name, &[]).value();
    let mut samples = Samples::recorded(simulation.history_columns(), Vec::new(), summary);
    samples.add_channels(model);
    samples
}

/// Results of work on `0..count` in order, done on so many threads.
pub(super) fn in_parallel<T: Send>(count: usize, jobs: usize, work: &(dyn Fn(usize) -> T + Sync)) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let results = Mutex::new(Vec::with_capacity(count));
    let worker = || loop {
        let index = next.fetch_add(1, Ordering::Relaxed);
        if index >= count {
            return;
        }
        let result = work(index);
        results.lock().unwrap_or_else(std::sync::PoisonError::into_inner).push((index, result));
    };
    std::thread::scope(|scope| {
        for _ in 1..jobs.clamp(1, count.max(1)) {
            scope.spawn(worker);
        }
        worker();
    });
    let mut results = results.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    results.sort_by_key(|(index, _)| *index);
    results.into_iter().map(|(_, result)| result).collect()
}

/// Distinguishes models: a hash (FNV-1a) of everything that a model says.
fn hash(model: &Model) -> String {
    let mut hash = Fnv::default();
    // Numbers are written so that they read back as the same numbers; writing here can't fail.
    let _ = std::fmt::Write::write_fmt(&mut hash, format_args!("{model:?}"));
    hash.to_string()
}
