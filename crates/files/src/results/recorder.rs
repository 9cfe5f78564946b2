//! The listener of a run: hands what is to be written to the writer, and closes the results at the end.
//!
//! Frames, rows and progress come from the simulation through [`Observer`]; frames and rows go to the writer,
//! which works beside the run where the run has more than one thread, progress goes to the caller's display.
//! [`Recorder::finish`] completes the files, `summary.json` last of all.

use super::ResultsError;
use super::atomic::write_whole;
use super::channels;
use super::folder::ResultFolder;
use super::messages::{NO_CHANNELS, NO_PICTURES};
use super::report::{Report, RunStatus};
use super::writer::{Job, Writer};
use super::writer_channel::WriterChannel;
use crate::checkpoint::{Checkpoint, Origin};
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
    /// Steps before it began.
    steps_before: u64,
    checkpoints: Option<Checkpoints>,
    last_checkpoint: Instant,
}

/// When states are kept.
#[derive(Clone, Debug, Default)]
pub struct Checkpoints {
    /// Wall time between two; `None`: only those that are due by their number of steps, and one when the run
    /// is stopped.
    pub pause: Option<Duration>,
    /// Where the model came from.
    pub origin: Origin,
}

impl Checkpoints {
    /// As a model wants them.
    #[must_use]
    pub fn of(model: &Model, origin: Origin) -> Self {
        Self { pause: model.run.checkpoint.and_then(|pause| Duration::try_from_secs_f64(pause).ok()), origin }
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
            writer.set_origin(checkpoints.origin.clone(), &part_names)?;
        }
        Ok(Self { channels, ..Self::of(writer, (model, part_names), threads, checkpoints, on_progress) })
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
        writer.set_origin(checkpoints.origin.clone(), &part_names)?;
        let recorder = Self::of(writer, (model, part_names), threads, Some(checkpoints), on_progress);
        Ok(Self { steps_before: past.state.step, channels, ..recorder })
    }

    fn of(
        writer: Writer,
        (model, part_names): (&Model, Vec<String>),
        threads: usize,
        checkpoints: Option<Checkpoints>,
        on_progress: OnProgress<'a>,
    ) -> Self {
        let now = Instant::now();
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
            begin: now,
            steps_before: 0,
            checkpoints,
            last_checkpoint: now,
        }
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
        let steps_time = self.begin.elapsed().saturating_sub(self.writer_channel.waited()).as_secs_f64();
        let mut report = Report::of(summary, &self.model, &self.part_names);
        let element_steps = summary.elements as f64 * summary.steps.saturating_sub(self.steps_before) as f64;
        report.element_steps_per_second = (element_steps > 0.0 && steps_time > 0.0).then(|| element_steps / steps_time);

        let job = self.job();
        self.writer_channel.give(job);
        let end = self.writer_channel.end();
        if let Some(message) = end.pictures_missing {
            report.warnings.push(Notice::new(&NO_PICTURES, format!("pictures are missing: {message}")));
        }
        let closed = end.result;

        match channels::write(self.folder.path(), &self.channels) {
            Ok(figures) => report.channels = figures,
            Err(error) => report.warnings.push(Notice::new(&NO_CHANNELS, format!("channels are missing: {error}"))),
        }
        let is_early = summary.rest.is_none() && summary.time_end < self.end * (1.0 - 1e-9);
        report.error = error.or_else(|| closed.as_ref().err().map(ToString::to_string));
        report.status = match report.error {
            Some(_) => RunStatus::Failed,
            None if self.is_stopped || is_early => RunStatus::Stopped,
            None => RunStatus::Done,
        };
        report.post_mortem = self.post_mortem;
        report.wall_seconds = self.begin.elapsed().as_secs_f64();
        report.user_cpu_seconds = user_cpu_seconds();
        report.output_seconds = end.worked.as_secs_f64();
        report.output_wait_seconds = end.waited.as_secs_f64();
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
        self.checkpoints.is_some()
    }

    fn state(&mut self, state: State) -> Result<(), ObserverError> {
        if self.checkpoints.is_some() {
            let job = Job { state: Some(Arc::new(state)), ..self.job() };
            self.writer_channel.give(job);
            self.last_checkpoint = Instant::now();
        }
        Ok(self.writer_channel.fault()?)
    }

    fn keeps_hashes(&self) -> bool {
        self.checkpoints.is_some()
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
        if self.checkpoints.is_some() {
            let job = Job { is_failing: true, ..self.job() };
            self.writer_channel.give(job);
        }
    }

    fn progress(&mut self, progress: &Progress<'_>) -> Control {
        let control = (self.on_progress)(progress);
        self.is_stopped |= matches!(control, Control::Stop | Control::KeepAndStop);
        let Some(checkpoints) = &self.checkpoints else { return control };
        match control {
            Control::Stop => Control::KeepAndStop,
            Control::Continue if checkpoints.pause.is_some_and(|pause| self.last_checkpoint.elapsed() >= pause) => Control::Keep,
            control => control,
        }
    }
}
