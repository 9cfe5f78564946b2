//! The listener that writes a run's results while it goes on and closes them at its end.
//!
//! Frames, rows and progress come from the simulation through [`Observer`]; they go to the history, the field files, the
//! film and the caller's progress display. [`Recorder::finish`] completes the files, `summary.json` last of all.

use super::ResultsError;
use super::atomic::write_whole;
use super::csv::CsvStream;
use super::folder::ResultFolder;
use super::report::{Report, RunStatus};
use crate::outline::{Extent, LineReader};
use crate::picture::{self, Film, FilmSettings};
use crate::vtu::{self, VtuWriter};
use embate_solver::model::Model;
use embate_solver::output::{Cells, Frame, Summary};
use embate_solver::simulation::{Control, Observer, ObserverError, Progress};
use std::time::{Duration, Instant};

/// Rows that are kept for the plots; a longer history is thinned evenly.
const PLOT_ROWS: usize = 4096;
/// The collection is rewritten with each of so many frames, later only from time to time and at the end.
const COLLECTION_FRAMES: usize = 200;
/// Time from rewriting to rewriting a long collection.
const COLLECTION_PAUSE: Duration = Duration::from_secs(1);

/// What the caller does with the progress of a run.
pub type OnProgress<'a> = Box<dyn FnMut(&Progress<'_>) -> Control + 'a>;

/// Writes the results of one run; made just before the run begins, because it measures the run's time.
pub struct Recorder<'a> {
    folder: ResultFolder,
    model: String,
    title: String,
    of_revolution: bool,
    end: f64,
    part_names: Vec<String>,
    include: Vec<String>,
    on_progress: OnProgress<'a>,
    columns: Vec<String>,
    history: CsvStream,
    plot_rows: ThinnedRows,
    frames: Frames,
    film: Option<Film>,
    is_stopped: bool,
    begin: Instant,
    output_time: Duration,
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
    /// # Errors
    /// [`ResultsError`] when the history can't be started.
    pub fn new(
        folder: ResultFolder,
        model: &Model,
        columns: Vec<String>,
        cells: Cells,
        on_progress: OnProgress<'a>,
    ) -> Result<Self, ResultsError> {
        let history = CsvStream::create(&folder.path().join("history.csv"), &columns)?;
        Ok(Self {
            folder,
            model: model.name.clone(),
            title: picture_title(model),
            of_revolution: model.is_axisymmetric(),
            end: model.run.end,
            part_names: cells.part_names.clone(),
            include: model.output.include.clone(),
            on_progress,
            columns,
            history,
            plot_rows: ThinnedRows::default(),
            frames: Frames::new(&cells),
            film: model.output.pictures.then(|| Film::new(cells, film_settings(model))),
            is_stopped: false,
            begin: Instant::now(),
            output_time: Duration::ZERO,
        })
    }

    /// Completes all files. `error` is the message of a failed run, `user_cpu_seconds` tells the process's user CPU time.
    /// What can be written is written even when something else can't.
    #[must_use]
    pub fn finish(self, error: Option<String>, summary: &Summary, user_cpu_seconds: impl FnOnce() -> Option<f64>) -> Outcome {
        let steps_time = self.begin.elapsed().saturating_sub(self.output_time).as_secs_f64();
        let mut report = Report::of(summary, &self.model, &self.part_names);
        let element_steps = summary.elements as f64 * summary.steps as f64;
        report.element_steps_per_second = (element_steps > 0.0 && steps_time > 0.0).then(|| element_steps / steps_time);

        let closed = self.history.finish().and(self.frames.write_collection(&self.folder));
        let pictures = self.film.map(|film| {
            self.folder.add_pictures(|side| {
                film.finish(side).map_err(|e| e.to_string())?;
                picture::plots(&self.columns, &self.plot_rows.into_rows(), &self.title, self.of_revolution, side).map_err(|e| e.to_string())
            })
        });
        if let Some(Err(message)) = pictures {
            report.warnings.push(format!("pictures are missing: {message}"));
        }

        let is_early = summary.rest.is_none() && summary.time_end < self.end * (1.0 - 1e-9);
        report.error = error.or_else(|| closed.as_ref().err().map(ToString::to_string));
        report.status = match report.error {
            Some(_) => RunStatus::Failed,
            None if self.is_stopped || is_early => RunStatus::Stopped,
            None => RunStatus::Done,
        };
        report.wall_seconds = self.begin.elapsed().as_secs_f64();
        report.user_cpu_seconds = user_cpu_seconds();
        let summarised = write_whole(&self.folder.path().join("summary.json"), report.json().as_bytes());
        Outcome { report, unwritten: closed.and(summarised).err() }
    }
}

impl Observer for Recorder<'_> {
    fn frame(&mut self, frame: &Frame<2>) -> Result<(), ObserverError> {
        let begin = Instant::now();
        if self.frames.write(frame, &self.include, &self.folder)? {
            if let Some(film) = &mut self.film {
                film.add(frame);
            }
            self.history.flush()?;
        }
        self.output_time += begin.elapsed();
        Ok(())
    }

    fn row(&mut self, row: &[f64]) -> Result<(), ObserverError> {
        let begin = Instant::now();
        self.history.row(row)?;
        if self.film.is_some() {
            self.plot_rows.add(row);
        }
        self.output_time += begin.elapsed();
        Ok(())
    }

    fn progress(&mut self, progress: &Progress<'_>) -> Control {
        let control = (self.on_progress)(progress);
        self.is_stopped |= control == Control::Stop;
        control
    }
}

/// How a model wants its pictures.
#[must_use]
pub fn film_settings(model: &Model) -> FilmSettings {
    FilmSettings {
        title: picture_title(model),
        field: model.output.picture_field.clone(),
        rigid: model.parts.iter().map(|part| part.rigid.is_some()).collect(),
        mirror: model.output.mirror,
        view: model.output.picture_view.map(|view| [view.corner, [0, 1].map(|k| view.corner[k] + view.size[k])]),
        of_revolution: model.is_axisymmetric(),
        ..FilmSettings::default()
    }
}

fn picture_title(model: &Model) -> String {
    if model.title.is_empty() { model.name.clone() } else { model.title.clone() }
}

/// The field files of a run, those of its obstacles, and their collections.
struct Frames {
    writer: VtuWriter,
    written: Vec<(f64, String)>,
    obstacles: Obstacles,
    step_last: Option<u64>,
    collected: Instant,
}

impl Frames {
    fn new(cells: &Cells) -> Self {
        Self {
            writer: VtuWriter::new(cells),
            written: Vec::new(),
            obstacles: Obstacles::default(),
            step_last: None,
            collected: Instant::now(),
        }
    }

    /// Writes a frame; `false` when this step is there already, as when a run fails right at an output time.
    fn write(&mut self, frame: &Frame<2>, include: &[String], folder: &ResultFolder) -> Result<bool, ResultsError> {
        if self.step_last == Some(frame.step) {
            return Ok(false);
        }
        let name = ResultFolder::frame_name(self.written.len());
        write_whole(&folder.path().join(&name), &self.writer.bytes(frame, include)?)?;
        self.obstacles.write(frame, self.written.len(), folder)?;
        self.written.push((frame.time, name));
        self.step_last = Some(frame.step);
        if self.written.len() <= COLLECTION_FRAMES || self.collected.elapsed() > COLLECTION_PAUSE {
            self.write_collection(folder)?;
            self.collected = Instant::now();
        }
        Ok(true)
    }

    fn write_collection(&self, folder: &ResultFolder) -> Result<(), ResultsError> {
        write_whole(&folder.path().join("fields.pvd"), vtu::collection(&self.written).as_bytes())?;
        if self.obstacles.written.is_empty() {
            return Ok(());
        }
        write_whole(&folder.path().join("obstacles.pvd"), vtu::collection(&self.obstacles.written).as_bytes())
    }
}

/// The obstacle files of a run; none for a model without obstacles.
#[derive(Default)]
struct Obstacles {
    lines: LineReader,
    /// Box of all nodes of all frames so far: lines without end reach across it.
    extent: Option<Extent>,
    written: Vec<(f64, String)>,
}

impl Obstacles {
    fn write(&mut self, frame: &Frame<2>, number: usize, folder: &ResultFolder) -> Result<(), ResultsError> {
        if frame.outlines.is_empty() {
            return Ok(());
        }
        for p in frame.positions.iter().filter(|p| p.iter().all(|v| v.is_finite())) {
            let [low, high] = self.extent.unwrap_or([*p, *p]);
            self.extent = Some([[0, 1].map(|k| low[k].min(p[k])), [0, 1].map(|k| high[k].max(p[k]))]);
        }
        let near = self.extent.unwrap_or_default();
        let lines: Vec<Vec<[f64; 2]>> = self.lines.lines(frame).iter().map(|line| line.piece(near)).collect();
        let name = ResultFolder::obstacles_name(number);
        write_whole(&folder.path().join(&name), &vtu::obstacles(&lines, frame.time))?;
        self.written.push((frame.time, name));
        Ok(())
    }
}

/// History rows for the plots: all of a short history, every second, fourth ... of a long one, and the last.
#[derive(Default)]
struct ThinnedRows {
    rows: Vec<Vec<f64>>,
    last: Option<Vec<f64>>,
    stride_exponent: u32,
    seen: u64,
}

impl ThinnedRows {
    fn add(&mut self, row: &[f64]) {
        if self.seen.trailing_zeros() >= self.stride_exponent {
            self.rows.push(row.to_vec());
            self.last = None;
        } else {
            self.last = Some(row.to_vec());
        }
        self.seen += 1;
        if self.rows.len() >= PLOT_ROWS {
            let mut index = 0;
            self.rows.retain(|_| {
                index += 1;
                index % 2 == 1
            });
            self.stride_exponent += 1;
        }
    }

    fn into_rows(mut self) -> Vec<Vec<f64>> {
        self.rows.extend(self.last);
        self.rows
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_history_is_thinned_evenly_for_the_plots() {
        let mut rows = ThinnedRows::default();
        for value in 0..10_000 {
            rows.add(&[f64::from(value)]);
        }
        let kept = rows.into_rows();
        assert!(kept.len() < PLOT_ROWS && kept.len() > PLOT_ROWS / 2 - 1);
        assert_eq!(kept[1][0] - kept[0][0], 4.0);
        assert!(kept[..kept.len() - 1].windows(2).all(|w| w[1][0] - w[0][0] == 4.0));
        assert_eq!(kept[kept.len() - 1], [9999.0]);
    }

    #[test]
    fn a_short_history_is_plotted_whole() {
        let mut rows = ThinnedRows::default();
        for value in 0..100 {
            rows.add(&[f64::from(value)]);
        }
        assert_eq!(rows.into_rows().len(), 100);
    }
}
