//! The listener of a run: hands what is to be written to the writer, and closes the results at the end.
//!
//! Frames, rows and progress come from the simulation through [`Observer`]; frames and rows go to the writer, which works beside the run where the run has more than
//! one thread, progress goes to the caller's display. [`Recorder::finish`] completes the files, `summary.json` last of all.

use super::ResultsError;
use super::atomic::write_whole;
use super::folder::ResultFolder;
use super::handover::Handover;
use super::messages::NO_PICTURES;
use super::report::{Report, RunStatus};
use super::writer::{Job, Writer};
use crate::threads::Threads;
use embate_solver::error::Notice;
use embate_solver::model::Model;
use embate_solver::output::{Cells, Frame, Summary};
use embate_solver::simulation::{Control, Observer, ObserverError, Progress};
use std::path::PathBuf;
use std::time::Instant;

/// Numbers of rows that are collected before they are handed over.
const ROWS: usize = 1 << 13;

/// What the caller does with the progress of a run.
pub type OnProgress<'a> = Box<dyn FnMut(&Progress<'_>) -> Control + 'a>;

/// Writes the results of one run; made just before the run begins, because it measures the run's time.
pub struct Recorder<'a> {
    path: PathBuf,
    model: String,
    end: f64,
    part_names: Vec<String>,
    on_progress: OnProgress<'a>,
    /// Numbers of a row.
    width: usize,
    rows: Vec<f64>,
    handover: Handover,
    is_stopped: bool,
    begin: Instant,
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
    /// `threads`: as many as the run was given. With one, everything is written in turn with the steps; with more, a writer works beside them, and as many threads
    /// pack fields and draw pictures. The files are the same.
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
        let (path, part_names, width) = (folder.path().to_path_buf(), cells.part_names.clone(), columns.len());
        let writer = Writer::new(folder, model, columns, cells, Threads::new(threads))?;
        Ok(Self {
            path,
            model: model.name.clone(),
            end: model.run.end,
            part_names,
            on_progress,
            width,
            rows: Vec::new(),
            handover: Handover::new(writer, threads > 1),
            is_stopped: false,
            begin: Instant::now(),
        })
    }

    /// Completes all files. `error` is the message of a failed run, `user_cpu_seconds` tells the process's user CPU time.
    /// What can be written is written even when something else can't.
    #[must_use]
    pub fn finish(mut self, error: Option<String>, summary: &Summary, user_cpu_seconds: impl FnOnce() -> Option<f64>) -> Outcome {
        let steps_time = self.begin.elapsed().saturating_sub(self.handover.waited()).as_secs_f64();
        let mut report = Report::of(summary, &self.model, &self.part_names);
        let element_steps = summary.elements as f64 * summary.steps as f64;
        report.element_steps_per_second = (element_steps > 0.0 && steps_time > 0.0).then(|| element_steps / steps_time);

        self.handover.give(Job { rows: std::mem::take(&mut self.rows), frame: None });
        let end = self.handover.end();
        if let Some(message) = end.pictures_missing {
            report.warnings.push(Notice::new(&NO_PICTURES, format!("pictures are missing: {message}")));
        }
        let closed = end.result;

        let is_early = summary.rest.is_none() && summary.time_end < self.end * (1.0 - 1e-9);
        report.error = error.or_else(|| closed.as_ref().err().map(ToString::to_string));
        report.status = match report.error {
            Some(_) => RunStatus::Failed,
            None if self.is_stopped || is_early => RunStatus::Stopped,
            None => RunStatus::Done,
        };
        report.wall_seconds = self.begin.elapsed().as_secs_f64();
        report.user_cpu_seconds = user_cpu_seconds();
        report.output_seconds = end.worked.as_secs_f64();
        report.output_wait_seconds = end.waited.as_secs_f64();
        let summarised = write_whole(&self.path.join("summary.json"), report.json().as_bytes());
        Outcome { report, unwritten: closed.and(summarised).err() }
    }
}

impl Observer for Recorder<'_> {
    fn spare(&mut self) -> Frame<2> {
        self.handover.spare()
    }

    fn frame(&mut self, frame: Frame<2>) -> Result<(), ObserverError> {
        let rows = std::mem::take(&mut self.rows);
        self.handover.give(Job { rows, frame: Some(frame) });
        Ok(self.handover.fault()?)
    }

    fn row(&mut self, row: &[f64]) -> Result<(), ObserverError> {
        if row.len() != self.width {
            return Err(ResultsError::RowLength { found: row.len(), expected: self.width }.into());
        }
        self.rows.extend_from_slice(row);
        if self.rows.len() >= ROWS {
            let rows = std::mem::take(&mut self.rows);
            self.handover.give(Job { rows, frame: None });
            self.handover.fault()?;
        }
        Ok(())
    }

    fn progress(&mut self, progress: &Progress<'_>) -> Control {
        let control = (self.on_progress)(progress);
        self.is_stopped |= control == Control::Stop;
        control
    }
}
