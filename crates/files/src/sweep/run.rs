//! The runs of a sweep: each on one thread, as many at a time as are wanted, in the order of their numbers
//! from one queue.
//!
//! A [`Sweep`] comes from `prepare.rs`; every run that ends is noted in the journal and, where results are
//! kept, has its own folder. A run that fails is noted with its reason and the others continue.

use super::journal::{Entry, Journal, Manifest, RunEnd};
use super::prepare::{Sweep, in_parallel};
use super::{Keep, SweepError, table};
use crate::plain;
use crate::results::{Recorder, Report, ResultFolder, ResultsError, RunStatus, read_figures, write_figures};
use crate::verification::{Gathering, Samples};
use embate_solver::error::Error;
use embate_solver::model::Model;
use embate_solver::output::Summary;
use embate_solver::simulation::{Control, Progress, Simulation};
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

/// How far a sweep is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Advance {
    /// Runs that have ended, earlier ones included.
    pub ended: usize,
    /// Of them those that had ended when the sweep began.
    pub before: usize,
    /// Of them those that failed.
    pub failed: usize,
    /// All runs.
    pub of: usize,
}

/// How a sweep ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ended {
    /// How far it came.
    pub advance: Advance,
    /// The first run that failed: its number from 1, and why.
    pub failure: Option<(usize, String)>,
}

/// How a sweep is run; changes no result.
#[derive(Clone, Copy)]
pub struct Running<'a> {
    /// Where to.
    pub folder: &'a Path,
    /// What is kept of each run.
    pub keep: Keep,
    /// Forget what the folder holds.
    pub force: bool,
    /// Runs at a time.
    pub jobs: usize,
    /// User CPU time of the calling thread so far, s; `None` where the system does not report it.
    pub user_cpu_seconds: fn() -> Option<f64>,
    /// Whether the user wants it to stop.
    pub is_stopped: &'a (dyn Fn() -> bool + Sync),
    /// Reported after each run.
    pub on_advance: &'a (dyn Fn(Advance) + Sync),
}

/// What all workers share.
struct Shared {
    journal: Journal,
    entries: BTreeMap<usize, Entry>,
    advance: Advance,
    error: Option<SweepError>,
}

/// Numbers of a run, or why it has none.
pub(super) type Numbers = Result<Vec<f64>, String>;
/// What a run recorded and how it ended, or why it failed.
type Recorded = Result<(Samples, RunEnd), String>;
/// Finds numbers in what a run recorded, with the help of a function for an output by its name.
pub(super) type Seen<'a> = dyn Fn(&Samples, &dyn Fn(&str) -> Result<f64, String>) -> Numbers + 'a;

impl Sweep {
    /// Runs what has not been run, then writes the table and the plot.
    ///
    /// # Errors
    /// A folder with another sweep; results that can't be written.
    pub fn run(&self, running: &Running<'_>) -> Result<Ended, SweepError> {
        let manifest = self.manifest(running.keep);
        let (mut journal, before, entries) = Journal::open(running.folder, &manifest, running.force)?;
        if running.force {
            self.clear(running)?;
        }
        let entries = match &before {
            Some(before) if before.runs != manifest.runs => {
                // First the journal: what is in a folder must not be taken for what was there.
                journal.clear()?;
                self.renumbered(running, before.places(&manifest), entries)
            }
            _ => entries,
        };
        let entries = self.known(running, before.as_ref(), entries);
        journal.start(running.folder, &manifest, &entries.values().cloned().collect::<Vec<_>>())?;
        let failed = entries.values().filter(|entry| entry.end == RunEnd::Failed).count();
        let advance = Advance { ended: entries.len(), before: entries.len(), failed, of: self.runs() };
        let left: Vec<usize> = (0..self.runs()).filter(|run| !entries.contains_key(run)).collect();
        let shared = Mutex::new(Shared { journal, entries, advance, error: None });
        (running.on_advance)(advance);
        in_parallel(left.len(), running.jobs, &|index| self.one(left[index], running, &shared));
        let Shared { entries, advance, error, .. } = shared.into_inner().unwrap_or_else(PoisonError::into_inner);
        if let Some(error) = error {
            return Err(error);
        }
        table::write(self, entries.values(), running.folder)?;
        let failure = entries.values().find(|entry| entry.end == RunEnd::Failed).map(|entry| (entry.run + 1, entry.error.clone()));
        Ok(Ended { advance, failure })
    }

    fn manifest(&self, keep: Keep) -> Manifest {
        Manifest {
            version: env!("CARGO_PKG_VERSION").to_string(),
            model: self.first.name.clone(),
            keep,
            inputs: self.plan.inputs.iter().map(|input| input.path.clone()).collect(),
            outputs: self.outputs.iter().map(|output| output.name.clone()).collect(),
            runs: self.hashes.clone(),
        }
    }

    /// The folder of a run.
    fn folder(&self, of: &Path, run: usize) -> PathBuf {
        of.join(numbered(run, self.runs()))
    }

    /// Runs of a smaller sweep, or of one in another order, with the numbers and folders that they have here.
    /// One whose folder can't be moved is left out, and will be done again.
    fn renumbered(&self, running: &Running<'_>, places: Vec<Option<usize>>, entries: Vec<Entry>) -> Vec<Entry> {
        let old = |entry: &Entry| running.folder.join(numbered(entry.run, places.len()));
        let moved = |new: usize| running.folder.join(format!("{}.moved", numbered(new, self.runs())));
        let mut kept: Vec<(usize, Entry)> =
            entries.into_iter().filter_map(|entry| Some((places.get(entry.run).copied().flatten()?, entry))).collect();
        if running.keep != Keep::Rows {
            // All out of the way first: the place of one may be where another is.
            let is_new = |new: usize, entry: &Entry| old(entry) != self.folder(running.folder, new) && old(entry).exists();
            let (going, staying): (Vec<_>, Vec<_>) = kept.into_iter().partition(|(new, entry)| is_new(*new, entry));
            let going: Vec<_> = going.into_iter().filter(|(new, entry)| std::fs::rename(old(entry), moved(*new)).is_ok()).collect();
            let arrives = |(new, _): &(usize, Entry)| {
                let folder = self.folder(running.folder, *new);
                let is_free = !folder.exists() || ResultFolder::remove(&folder).is_ok();
                is_free && std::fs::rename(moved(*new), folder).is_ok()
            };
            kept = staying.into_iter().chain(going.into_iter().filter(arrives)).collect();
        }
        kept.into_iter().map(|(run, entry)| Entry { run, ..entry }).collect()
    }

    /// Takes the results of earlier runs away.
    fn clear(&self, running: &Running<'_>) -> Result<(), SweepError> {
        let numbered = |name: &str| name.len() >= 4 && name.bytes().all(|byte| byte.is_ascii_digit());
        let entries = std::fs::read_dir(running.folder).map_err(ResultsError::file("read", running.folder))?;
        for entry in entries.flatten().filter(|entry| entry.file_name().to_str().is_some_and(numbered)) {
            ResultFolder::remove(&entry.path())?;
        }
        Ok(())
    }

    /// Runs of an earlier call that need not be done again, with the outputs that are wanted now.
    fn known(&self, running: &Running<'_>, before: Option<&Manifest>, entries: Vec<Entry>) -> BTreeMap<usize, Entry> {
        let Some(before) = before else { return BTreeMap::new() };
        let is_same = self.outputs.iter().map(|output| &output.name).eq(&before.outputs);
        let mut known = BTreeMap::new();
        for mut entry in entries.into_iter().filter(|entry| entry.run < self.runs()) {
            let folder = self.folder(running.folder, entry.run);
            let has_results = running.keep == Keep::Rows || entry.end == RunEnd::Failed || folder.join("summary.json").is_file();
            if !has_results {
                continue;
            }
            if !is_same {
                match read_figures(&folder).filter(|_| entry.end != RunEnd::Failed) {
                    Some((columns, rows, summary)) => {
                        let mut samples = Samples::recorded(columns, rows, summary);
                        if samples.summary.get("rest").is_some_and(|rest| !rest.is_null()) {
                            samples.stay_until(self.first.run.end);
                        }
                        entry.cells = self.cells(&samples);
                    }
                    None if entry.end == RunEnd::Failed => entry.cells = self.empty(),
                    None => continue,
                }
            }
            known.insert(entry.run, entry);
        }
        known
    }

    fn cells(&self, samples: &Samples) -> Vec<String> {
        self.outputs.iter().map(|output| output.cell(samples)).collect()
    }

    fn empty(&self) -> Vec<String> {
        vec![String::new(); self.outputs.len()]
    }

    /// One run from the queue, and its note.
    fn one(&self, run: usize, running: &Running<'_>, shared: &Mutex<Shared>) {
        let lock = || shared.lock().unwrap_or_else(PoisonError::into_inner);
        if (running.is_stopped)() || lock().error.is_some() {
            return;
        }
        // The hook has reported the user about a panic; here it is a run that failed.
        let bug = |_| Ok(Some(self.failed(run, "this run ended with a bug in embate".to_string())));
        let ended = catch_unwind(AssertUnwindSafe(|| self.run_one(run, running))).unwrap_or_else(bug);
        let mut shared = lock();
        let noted = ended.and_then(|entry| {
            let Some(entry) = entry else { return Ok(()) };
            shared.journal.note(&entry)?;
            shared.advance.ended += 1;
            shared.advance.failed += usize::from(entry.end == RunEnd::Failed);
            shared.entries.insert(run, entry);
            Ok(())
        });
        match noted {
            Ok(()) => (running.on_advance)(shared.advance),
            Err(error) => drop(shared.error.get_or_insert(error)),
        }
    }

    /// Numbers that `seen` finds in each run, in memory alone: it gets what was recorded, and a function for
    /// an output by its name. Of a run that fails or does not have them the reason. `None`: the user stopped
    /// it.
    pub(super) fn numbers(&self, running: &Running<'_>, seen: &Seen<'_>) -> Result<Option<Vec<Numbers>>, SweepError> {
        let bug = |_| Ok(Some(Err("this run ended with a bug in embate".to_string())));
        let one = |run: usize| catch_unwind(AssertUnwindSafe(|| self.recorded(run, running))).unwrap_or_else(bug);
        let mut all = Vec::new();
        for recorded in in_parallel(self.runs(), running.jobs, &one) {
            let Some(recorded) = recorded? else { return Ok(None) };
            all.push(recorded.and_then(|(samples, _)| {
                let number = |name: &str| {
                    let output = self.outputs.iter().find(|output| output.name == name);
                    output.and_then(|output| output.number(&samples)).ok_or_else(|| format!("the run has no `{name}`"))
                };
                seen(&samples, &number)
            }));
        }
        Ok(Some(all))
    }

    fn failed(&self, run: usize, error: String) -> Entry {
        Entry { run, end: RunEnd::Failed, error, cells: self.empty() }
    }

    /// Runs to the end; `None` where the user stopped it.
    fn run_one(&self, run: usize, running: &Running<'_>) -> Result<Option<Entry>, SweepError> {
        Ok(self.recorded(run, running)?.map(|recorded| match recorded {
            Ok((samples, end)) => Entry { run, end, error: String::new(), cells: self.cells(&samples) },
            Err(error) => self.failed(run, error),
        }))
    }

    /// What a run recorded and how it ended, or why it failed.
    fn recorded(&self, run: usize, running: &Running<'_>) -> Result<Option<Recorded>, SweepError> {
        let (begin, cpu) = (Instant::now(), (running.user_cpu_seconds)());
        let used = || Some((running.user_cpu_seconds)()? - cpu?);
        let model = match self.model(run, running.keep) {
            Ok(model) => model,
            Err(faults) => {
                return Ok(Some(Err(first_line(&faults.entries.first().map_or(String::new(), |it| it.message.clone())))));
            }
        };
        let mut simulation = match Simulation::new(&model, &self.options) {
            Ok(simulation) => simulation,
            Err(error) => return Ok(Some(Err(reported(&error)))),
        };
        let folder = self.folder(running.folder, run);
        let recorder = match running.keep {
            Keep::Frames => {
                let quiet = Box::new(|_: &Progress<'_>| Control::Continue);
                ResultFolder::refuse_link(&folder)?;
                let folder = ResultFolder::create(&folder, true)?;
                Some(Recorder::new(folder, &model, simulation.history_columns(), simulation.cells(), 1, quiet)?)
            }
            Keep::Figures | Keep::Rows => None,
        };
        let mut on_progress = |_: &Progress<'_>| if (running.is_stopped)() { Control::Stop } else { Control::Continue };
        let samples = Samples::recorded(simulation.history_columns(), Vec::new(), serde_json::Value::Null);
        let mut gathering = Gathering { samples, recorder, on_progress: &mut on_progress, is_stopped: false };
        let stepping = Instant::now();
        let error = simulation.run(&mut gathering).err();
        let Gathering { mut samples, recorder, is_stopped, .. } = gathering;
        if let Some(Error::Output(message)) = &error {
            return Err(SweepError::Output(message.clone()));
        }
        if is_stopped {
            return Ok(None);
        }
        let (error, summary) = (error.map(|error| reported(&error)), simulation.summary());
        let report = match recorder {
            Some(recorder) => {
                let outcome = recorder.finish(error.clone(), &summary, used);
                outcome.unwritten.map_or(Ok(()), Err)?;
                outcome.report
            }
            None => report(&model, &summary, error.clone(), stepping, begin, used),
        };
        if running.keep == Keep::Figures {
            plain::folder(&folder).map_err(ResultsError::file("create", &folder))?;
            write_figures(&folder, samples.columns(), &samples.rows, &report)?;
        }
        if let Some(error) = error {
            return Ok(Some(Err(error)));
        }
        samples.summary = report.value();
        samples.add_channels(&model);
        if summary.rest.is_some() {
            samples.stay_until(model.run.end);
        }
        let end = if report.status == RunStatus::Done { RunEnd::Done } else { RunEnd::Stopped };
        Ok(Some(Ok((samples, end))))
    }
}

/// Name of the folder of a run of so many.
fn numbered(run: usize, runs: usize) -> String {
    let width = runs.to_string().len().max(4);
    format!("{:0width$}", run + 1)
}

/// What a recorder would say of a run that was kept in memory.
fn report(
    model: &Model,
    summary: &Summary,
    error: Option<String>,
    stepping: Instant,
    begin: Instant,
    used: impl FnOnce() -> Option<f64>,
) -> Report {
    let mut report = Report::of(summary, &model.name, &model.parts.iter().map(|part| part.name.clone()).collect::<Vec<_>>());
    let (element_steps, seconds) = (summary.elements as f64 * summary.steps as f64, stepping.elapsed().as_secs_f64());
    report.element_steps_per_second = (element_steps > 0.0 && seconds > 0.0).then(|| element_steps / seconds);
    report.status = match error {
        Some(_) => RunStatus::Failed,
        None if summary.is_early() => RunStatus::Stopped,
        None => RunStatus::Done,
    };
    report.error = error;
    report.wall_seconds = begin.elapsed().as_secs_f64();
    report.user_cpu_seconds = used();
    report
}

/// An error on one line: a cell of the table.
fn reported(error: &Error) -> String {
    first_line(&error.with_code())
}

fn first_line(text: &str) -> String {
    text.lines().next().unwrap_or_default().to_string()
}
