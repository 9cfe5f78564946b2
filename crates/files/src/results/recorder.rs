//! The listener of a run: hands what is to be written to the writer, and closes the results at the end.
//!
//! Frames, rows and progress come from the simulation through [`Observer`]; frames and rows go to the writer,
//! which works beside the run where the run has more than one thread, progress goes to the caller's display.
//! [`Recorder::finish`] completes the files, `summary.json` last of all.

use super::ResultsError;
use super::atomic::write_whole;
use super::channels;
use super::checkpoints::{CheckpointClock, Checkpoints, Cost};
use super::folder::ResultFolder;
use super::messages::{NO_CHANNELS, NO_PICTURES};
use super::report::{Report, RunStatus};
use super::reported::Spent;
use super::writer::{Job, Kept, Writer};
use super::writer_channel::WriterChannel;
use crate::checkpoint::Checkpoint;
use crate::checkpoint::messages::NO_STATES;
use crate::post_mortem;
use crate::threads::Threads;
use embate_solver::channel::Channels;
use embate_solver::error::Notice;
use embate_solver::hashes::Hashes;
use embate_solver::model::Model;
use embate_solver::output::{Cells, Frame, Shown, Summary};
use embate_solver::simulation::{Control, Observer, ObserverError, Progress, State};
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Numbers of rows that are collected before they are handed over.
const ROWS: usize = 1 << 13;

/// What the caller does with the progress of a run.
pub type OnProgress<'a> = Box<dyn FnMut(&Progress<'_>) -> Control + Send + 'a>;

/// Writes the results of one run; made just before the run begins, because it measures the run's time.
pub struct Recorder<'a> {
    /// Until the last file is written no other run may have it.
    folder: ResultFolder,
    model: String,
    channels: Channels,
    /// Where it ends, s: a stretch that is shown again before the run does.
    end: f64,
    part_names: Vec<String>,
    on_progress: OnProgress<'a>,
    /// Numbers of a row.
    width: usize,
    rows: Vec<f64>,
    hashes: Vec<Hashes>,
    writer_channel: WriterChannel,
    is_stopped: bool,
    /// The page about the failure.
    post_mortem: Option<String>,
    begin: Instant,
    /// What earlier stretches of the run have cost.
    before: Option<Spent>,
    keeping: Option<Keeping>,
}

/// What a recorder that keeps states needs for it.
struct Keeping {
    clock: CheckpointClock,
    user_cpu_seconds: Option<fn() -> Option<f64>>,
    /// When it was last asked, at which step, and after how many steps it wants to be asked again.
    asked: Option<(Instant, u64)>,
    stride: u64,
    /// Whether the run must have the state that comes next: the user asked for it.
    is_wanted: bool,
}

/// Wall time after which a recorder wants to be asked again whether a state is due.
const ANSWER: Duration = Duration::from_secs(1);

impl Keeping {
    fn new(checkpoints: &Checkpoints, cost: Cost) -> Self {
        Self {
            clock: CheckpointClock::new(checkpoints.pause, cost),
            user_cpu_seconds: checkpoints.user_cpu_seconds,
            asked: None,
            stride: 1,
            is_wanted: true,
        }
    }

    /// Learns how long steps take.
    fn look_at_the_clock(&mut self, step: u64) {
        let Some((then, before)) = self.asked.replace((Instant::now(), step)) else { return };
        let steps = step.saturating_sub(before);
        if steps > 0 {
            let wanted = ANSWER.as_secs_f64() * steps as f64 / then.elapsed().as_secs_f64().max(1e-9);
            self.stride = (wanted as u64).clamp(1, 1 << 20);
        }
    }
}

/// How recording ended.
#[derive(Debug)]
pub struct Outcome {
    /// What `summary.json` says.
    pub report: Report,
    /// What kept results from being written completely.
    pub unwritten: Option<ResultsError>,
}

impl<'a> Recorder<'a> {
    /// A recorder of a run of `model` with the history columns and the cells of its simulation.
    ///
    /// `threads`: as many as the run was given. With one, everything is written in turn with the steps; with
    /// more, a writer works beside them, and as many threads pack fields and draw pictures. The files are the
    /// same.
    ///
    /// # Errors
    /// [`ResultsError`] when the history can't be started.
    pub fn new(
        folder: ResultFolder,
        model: &Model,
        columns: Vec<String>,
        cells: Cells,
        threads: usize,
        on_progress: OnProgress<'a>,
    ) -> Result<Self, ResultsError> {
        Self::keeping(folder, model, (columns, cells), threads, None, on_progress)
    }

    /// [`Recorder::new`] with checkpoints.
    ///
    /// # Errors
    /// As there.
    pub fn keeping(
        folder: ResultFolder,
        model: &Model,
        (columns, cells): (Vec<String>, Cells),
        threads: usize,
        checkpoints: Option<Checkpoints>,
        on_progress: OnProgress<'a>,
    ) -> Result<Self, ResultsError> {
        let (part_names, channels) = (cells.part_names.clone(), channels_of(model, &columns));
        let mut writer = Writer::new(folder, model, columns, cells, Threads::new(threads))?;
        if let Some(checkpoints) = &checkpoints {
            writer.set_origin(checkpoints, &part_names)?;
        }
        Ok(Self { channels, ..Self::of(writer, (model, part_names), threads, checkpoints.as_ref(), on_progress) })
    }

    /// One that continues with the results in `path` where the checkpoint `past` was written; `frame` is the
    /// state there.
    ///
    /// # Errors
    /// [`ResultsError`] when the results are not those of the checkpoint; then nothing has changed.
    pub fn reopen(
        path: &Path,
        (model, past): (&Model, &Checkpoint),
        columns: Vec<String>,
        (cells, frame): (Cells, &Frame),
        threads: usize,
        checkpoints: Checkpoints,
        on_progress: OnProgress<'a>,
    ) -> Result<Self, ResultsError> {
        let (part_names, channels) = (cells.part_names.clone(), channels_of(model, &columns));
        let mut writer = Writer::reopen(path, (model, past), columns, (cells, frame), Threads::new(threads))?;
        writer.set_origin(&checkpoints, &part_names)?;
        let recorder = Self::of(writer, (model, part_names), threads, Some(&checkpoints), on_progress);
        Ok(Self { before: Some(past.reported.spent), channels, ..recorder })
    }

    /// Keeps a state of the run: that from which it begins, where the model alone does not lead there.
    ///
    /// # Errors
    /// [`ResultsError`] when something before it could not be written.
    pub fn keep(&mut self, state: State) -> Result<(), ResultsError> {
        let user_cpu = self.keeping.as_ref().and_then(|keeping| keeping.user_cpu_seconds?());
        let spent = self.spent(user_cpu);
        if let Some(keeping) = &mut self.keeping {
            keeping.clock.take();
            let is_wanted = std::mem::replace(&mut keeping.is_wanted, true);
            let job = Job { state: Some(Kept { state: Arc::new(state), spent, is_wanted }), ..self.job() };
            self.writer_channel.give(job);
        }
        if let Some(keeping) = &mut self.keeping {
            keeping.clock.restart();
        }
        self.writer_channel.fault()
    }

    fn of(
        writer: Writer,
        (model, part_names): (&Model, Vec<String>),
        threads: usize,
        checkpoints: Option<&Checkpoints>,
        on_progress: OnProgress<'a>,
    ) -> Self {
        let keeping = checkpoints.map(|checkpoints| Keeping::new(checkpoints, writer.cost()));
        Self {
            folder: writer.folder().clone(),
            model: model.name.clone(),
            channels: Channels::default(),
            end: model.run.end,
            part_names,
            on_progress,
            width: writer.width(),
            rows: Vec::new(),
            hashes: Vec::new(),
            writer_channel: WriterChannel::new(writer, threads > 1),
            is_stopped: false,
            post_mortem: None,
            begin: Instant::now(),
            before: None,
            keeping,
        }
    }

    /// What the run has cost so far; the writer adds its own time.
    fn spent(&self, user_cpu: Option<f64>) -> Spent {
        let now =
            Spent { wall: self.begin.elapsed().as_secs_f64(), user_cpu, output: 0.0, waited: self.writer_channel.waited().as_secs_f64() };
        now.after(self.before)
    }

    /// What was reported since the last job.
    fn job(&mut self) -> Job {
        Job { rows: std::mem::take(&mut self.rows), hashes: std::mem::take(&mut self.hashes), ..Job::default() }
    }

    /// Lets the summary point to the page about the failure.
    pub fn point_to_post_mortem(&mut self) {
        self.post_mortem = Some(post_mortem::PAGE.into());
    }

    /// Completes all files. `error` is the message of a failed run, `user_cpu_seconds` reports the process's
    /// user CPU time. What can be written is written even when something else can't.
    #[must_use]
    pub fn finish(mut self, error: Option<String>, summary: &Summary, user_cpu_seconds: impl FnOnce() -> Option<f64>) -> Outcome {
        let spent = self.spent(None);
        let steps_time = spent.wall - spent.waited;
        let mut report = Report::of(summary, &self.model, &self.part_names);
        let element_steps = summary.elements as f64 * summary.steps as f64;
        report.element_steps_per_second = (element_steps > 0.0 && steps_time > 0.0).then(|| element_steps / steps_time);

        let job = self.job();
        self.writer_channel.give(job);
        let end = self.writer_channel.end();
        if let Some(message) = end.pictures_missing {
            report.warnings.push(Notice::new(&NO_PICTURES, format!("pictures are missing: {message}")));
        }
        if let Some(message) = end.states_missing {
            report.warnings.push(Notice::new(&NO_STATES, format!("checkpoints are missing: {message}")));
        }
        let closed = end.result;

        match channels::write(self.folder.path(), &self.channels) {
            Ok(figures) => report.channels = figures,
            Err(error) => report.warnings.push(Notice::new(&NO_CHANNELS, format!("channels are missing: {error}"))),
        }
        let is_early = summary.is_early() && summary.time_end < self.end * (1.0 - 1e-9);
        report.error = error.or_else(|| closed.as_ref().err().map(ToString::to_string));
        report.status = match report.error {
            Some(_) => RunStatus::Failed,
            None if self.is_stopped || is_early => RunStatus::Stopped,
            None => RunStatus::Done,
        };
        report.post_mortem = self.post_mortem;
        let now = Spent {
            wall: self.begin.elapsed().as_secs_f64(),
            user_cpu: user_cpu_seconds(),
            output: end.worked.as_secs_f64(),
            waited: end.waited.as_secs_f64(),
        };
        let spent = now.after(self.before);
        (report.wall_seconds, report.user_cpu_seconds) = (spent.wall, spent.user_cpu);
        (report.output_seconds, report.output_wait_seconds) = (spent.output, spent.waited);
        let summarised = write_whole(&self.folder.path().join("summary.json"), report.json().as_bytes());
        Outcome { report, unwritten: closed.and(summarised).err() }
    }
}

/// The channels of a model whose simulation has these columns: it has read them already.
fn channels_of(model: &Model, columns: &[String]) -> Channels {
    Channels::new(model, columns).unwrap_or_default()
}

impl Observer for Recorder<'_> {
    fn spare(&mut self) -> Frame {
        self.writer_channel.spare()
    }

    fn frame(&mut self, frame: Frame) -> Result<(), ObserverError> {
        let job = Job { frame: Some(frame), ..self.job() };
        self.writer_channel.give(job);
        Ok(self.writer_channel.fault()?)
    }

    fn show(&mut self, shown: &dyn Shown) -> Result<(), ObserverError> {
        let Self { rows, hashes, writer_channel, .. } = self;
        let job = || Job { rows: std::mem::take(rows), hashes: std::mem::take(hashes), ..Job::default() };
        if writer_channel.show(job, shown) {
            return Ok(self.writer_channel.fault()?);
        }
        let mut frame = self.spare();
        shown.fill(&mut frame);
        self.frame(frame)
    }

    fn cells(&mut self, cells: Cells) -> Result<(), ObserverError> {
        let job = Job { cells: Some(cells), ..self.job() };
        self.writer_channel.give(job);
        Ok(self.writer_channel.fault()?)
    }

    fn row(&mut self, row: &[f64]) -> Result<(), ObserverError> {
        if row.len() != self.width {
            return Err(ResultsError::RowLength { found: row.len(), expected: self.width }.into());
        }
        self.rows.extend_from_slice(row);
        if self.rows.len() >= ROWS {
            let job = self.job();
            self.writer_channel.give(job);
            self.writer_channel.fault()?;
        }
        Ok(())
    }

    fn keeps_states(&self) -> bool {
        self.keeping.is_some()
    }

    fn state(&mut self, state: State) -> Result<(), ObserverError> {
        Ok(self.keep(state)?)
    }

    fn keeps_hashes(&self) -> bool {
        self.keeping.is_some()
    }

    fn stride(&self) -> u64 {
        self.keeping.as_ref().map_or(u64::MAX, |keeping| keeping.stride)
    }

    fn hashes(&mut self, hashes: Hashes) -> Result<(), ObserverError> {
        self.hashes.push(hashes);
        if self.hashes.len() * self.part_names.len() >= ROWS {
            let job = self.job();
            self.writer_channel.give(job);
            self.writer_channel.fault()?;
        }
        Ok(())
    }

    fn failing(&mut self) {
        if self.keeping.is_some() {
            let job = Job { is_failing: true, ..self.job() };
            self.writer_channel.give(job);
        }
    }

    fn progress(&mut self, progress: &Progress<'_>) -> Control {
        let control = (self.on_progress)(progress);
        self.is_stopped |= matches!(control, Control::Stop | Control::KeepAndStop);
        let Some(keeping) = &mut self.keeping else { return control };
        keeping.look_at_the_clock(progress.step);
        let is_told = control == Control::Keep;
        let control = match control {
            Control::Stop => Control::KeepAndStop,
            Control::Continue if keeping.clock.is_due() => Control::Keep,
            control => control,
        };
        if matches!(control, Control::Keep | Control::KeepAndStop) {
            keeping.clock.ask();
            // Who did not ask for states does not lose a run because there is no room for one.
            keeping.is_wanted = control == Control::KeepAndStop || !keeping.clock.is_of_itself() || is_told;
        }
        control
    }
}
