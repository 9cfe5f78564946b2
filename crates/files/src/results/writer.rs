//! What a run leaves behind while it continues: history, hashes, field files, obstacles, film. Jobs come from
//! `writer_channel`; [`Writer::close`] completes the files.

use super::atomic::{write_whole, write_whole_in_pieces};
use super::checkpoints::{Checkpoints, Cost};
use super::csv::CsvStream;
use super::decimated::ThinnedRows;
use super::folder::ResultFolder;
use super::hashes;
use super::lines::Lines;
use super::provenance::Provenance;
use super::reported::{Reported, Spent};
use super::{HASHES, ResultsError};
use crate::checkpoint::{Checkpoint, Identity, Origin};
use crate::outline::{Extent, LineReader, Surface};
use crate::picture::{self, Film, FilmSettings};
use crate::threads::Threads;
use crate::vtu::{self, VtuWriter};
use embate_solver::archive::Section;
use embate_solver::hashes::Hashes;
use embate_solver::model::{Cadence, Model};
use embate_solver::output::{Cells, Frame, Shown};
use embate_solver::simulation::State;
use std::cell::OnceCell;
use std::fs::File;
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Time from rewriting to rewriting the collections: a second file with each frame would cost as much as a
/// small frame.
const COLLECTION_PAUSE: Duration = Duration::from_millis(500);

/// What the writer has to do: the rows since the last job, one after the other, then other cells, and then a
/// frame.
#[derive(Debug, Default)]
pub(super) struct Job {
    pub(super) rows: Vec<f64>,
    pub(super) hashes: Vec<Hashes>,
    /// Cells of all frames from here on, where they are others than before.
    pub(super) cells: Option<Cells>,
    pub(super) frame: Option<Frame>,
    /// To be kept once all before it is written.
    pub(super) state: Option<Kept>,
    /// What follows shows a failure: a state that is kept later is of a step before it.
    pub(super) is_failing: bool,
}

/// A state that is to be kept.
#[derive(Debug)]
pub(super) struct Kept {
    pub(super) state: Arc<State>,
    /// What the run had cost then.
    pub(super) spent: Spent,
    /// Whether the user asked for it; else the run continues where it can't be written.
    pub(super) is_wanted: bool,
}

impl Job {
    /// Memory that it needs until it is done.
    pub(super) fn bytes(&self) -> usize {
        let state: usize = self.state.iter().flat_map(|kept| &kept.state.sections).map(|section| section.bytes.len()).sum();
        let cells = self.cells.as_ref().map_or(0, Cells::bytes);
        8 * self.rows.len() + cells + self.frame.as_ref().map_or(0, bytes) + state
    }
}

/// Memory of a frame.
pub(super) fn bytes(frame: &Frame) -> usize {
    let values: usize = frame.fields.iter().map(|field| field.values.len()).sum();
    let points: usize = frame.outlines.iter().map(|outline| outline.points.len()).sum();
    8 * (frame.coordinates.len() + values) + size_of::<[f64; 3]>() * points
}

/// The files of a run that grow while it continues.
pub(super) struct Writer {
    folder: ResultFolder,
    title: String,
    of_whole_bodies: bool,
    include: Vec<String>,
    columns: Vec<String>,
    history: CsvStream,
    hashes: Option<Lines>,
    plot_rows: ThinnedRows,
    frames: Frames,
    /// Whether there are pictures at the end, and the film for them; none without frames.
    has_pictures: bool,
    film: Option<Film>,
    threads: Threads,
    /// For checkpoints and `run.json`: what the model is, looked at once.
    model: Model,
    identity: OnceCell<Identity>,
    origin: Origin,
    /// What was reported before the run failed.
    before_failure: Option<(Reported, Vec<Section>)>,
    /// How long it has been at work, and how long at the last state.
    pub(super) worked: Duration,
    cost: Cost,
    /// Why there are no states from some time on.
    states_missing: Option<String>,
}

/// How the files were completed.
pub(super) struct Closed {
    /// What kept the history and the collections from being complete.
    pub(super) result: Result<(), ResultsError>,
    /// Why there are no pictures, if they are missing.
    pub(super) pictures_missing: Option<String>,
    /// Why states are missing that no one had asked for.
    pub(super) states_missing: Option<String>,
}

impl Writer {
    /// The folder, which is this run's as long as somebody has it.
    pub(super) fn folder(&self) -> &ResultFolder {
        &self.folder
    }

    /// Starts the history.
    pub(super) fn new(
        folder: ResultFolder,
        model: &Model,
        columns: Vec<String>,
        cells: Cells,
        threads: Threads,
    ) -> Result<Self, ResultsError> {
        Ok(Self {
            history: CsvStream::create(&folder.path().join("history.csv"), &columns)?,
            hashes: None,
            folder,
            title: picture_title(model),
            of_whole_bodies: model.is_of_whole_bodies(),
            include: model.output.include.clone(),
            columns,
            plot_rows: ThinnedRows::default(),
            frames: Frames::new(&cells, &threads),
            has_pictures: model.output.pictures,
            film: has_film(model).then(|| Film::new(cells, film_settings(model))),
            threads,
            model: model.clone(),
            identity: OnceCell::new(),
            origin: Origin::default(),
            before_failure: None,
            worked: Duration::ZERO,
            cost: Cost::default(),
            states_missing: None,
        })
    }

    /// Continues where a checkpoint was written; `frame` is the state there.
    pub(super) fn reopen(
        folder: &Path,
        (model, past): (&Model, &Checkpoint),
        columns: Vec<String>,
        (cells, frame): (Cells, &Frame),
        threads: Threads,
    ) -> Result<Self, ResultsError> {
        let reported = &past.reported;
        let own = ResultFolder::take(folder)?;
        // Who can't have the history changes nothing.
        let (history, rows) = CsvStream::reopen(&folder.join("history.csv"), &columns, reported.history)?;
        let mut frames = Frames::new(&cells, &threads);
        frames.recall(reported);
        let hashes = reported.hashes.map(|mark| Lines::reopen(&folder.join(HASHES), mark)).transpose()?.map(|(lines, _)| lines);
        let folder = own;
        folder.clear_unfinished(hashes.is_some())?;
        // Who is killed in between leaves frames that no collection names, and none that one misses.
        frames.write_collection(&folder)?;
        folder.cut(reported.frames.len(), hashes.is_some(), past.state.step)?;
        let mut plot_rows = ThinnedRows::default();
        if model.output.pictures {
            rows.iter().for_each(|row| plot_rows.add(row));
        }
        let film = has_film(model).then(|| Film::recalled(cells, film_settings(model), &past.film, frame));
        let (title, of_whole_bodies) = (picture_title(model), model.is_of_whole_bodies());
        let (include, origin) = (model.output.include.clone(), past.origin.clone());
        Ok(Self {
            folder,
            title,
            of_whole_bodies,
            include,
            columns,
            history,
            hashes,
            plot_rows,
            frames,
            has_pictures: model.output.pictures,
            film,
            threads,
            model: model.clone(),
            identity: OnceCell::new(),
            origin,
            before_failure: None,
            worked: Duration::ZERO,
            cost: Cost::default(),
            states_missing: None,
        })
    }

    /// Numbers of a row.
    pub(super) fn width(&self) -> usize {
        self.columns.len()
    }

    /// Where the model came from. From now on there is kept what ran, and its hashes if the model wants them;
    /// `parts` are its names.
    pub(super) fn set_origin(&mut self, checkpoints: &Checkpoints, parts: &[String]) -> Result<(), ResultsError> {
        let folder = self.folder.path();
        Provenance::of(self.identity().clone(), checkpoints, &self.model).write(folder)?;
        if self.model.output.hash_steps.is_some() && self.hashes.is_none() {
            self.hashes = Some(Lines::create(&folder.join(HASHES), hashes::names(parts))?);
        }
        self.origin = checkpoints.origin.clone();
        Ok(())
    }

    /// What the last state has cost it.
    pub(super) fn cost(&self) -> Cost {
        self.cost.clone()
    }

    fn identity(&self) -> &Identity {
        self.identity.get_or_init(|| Identity::of(&self.model))
    }

    fn reported_so_far(&mut self) -> Result<(Reported, Vec<Section>), ResultsError> {
        let hashes = self.hashes.as_mut().map(Lines::mark).transpose()?;
        let reported = Reported { history: self.history.mark()?, hashes, ..self.frames.reported() };
        Ok((reported, self.film.as_mut().map_or_else(Vec::new, Film::kept)))
    }

    /// Writes a checkpoint of what is reported so far and the state there.
    fn keep(&mut self, Kept { state, spent, .. }: &Kept) -> Result<(), ResultsError> {
        let (mut reported, film) = match self.before_failure.take() {
            Some(before) => before,
            None => self.reported_so_far()?,
        };
        // What is in `spent` of the output is of the stretches before.
        reported.spent = Spent { output: spent.output + self.worked.as_secs_f64(), ..*spent };
        self.frames.secure(&self.folder)?;
        let identity = self.identity().clone();
        let checkpoint = Checkpoint { state: state.clone(), origin: self.origin.clone(), identity, reported, film };
        Ok(checkpoint.write(self.folder.path(), &self.threads)?)
    }

    /// Whether it can take what is shown piece by piece: a film needs whole frames.
    pub(super) fn takes_pieces(&self) -> bool {
        self.film.is_none()
    }

    /// Does a job; `shown` stands for a frame that the job has not. A frame is written even when rows can't
    /// be.
    pub(super) fn write(&mut self, job: &Job, shown: Option<&dyn Shown>) -> Result<(), ResultsError> {
        let reported = self.report(job, shown);
        if job.is_failing {
            self.before_failure = Some(self.reported_so_far()?);
        }
        // What is not reported can't be continued from.
        match &job.state {
            Some(kept) => {
                let begin = Instant::now();
                let done = reported.and_then(|()| match self.keep(kept) {
                    Err(fault) if !kept.is_wanted => {
                        self.states_missing = Some(fault.to_string());
                        Ok(())
                    }
                    done => done,
                });
                if self.states_missing.is_some() {
                    self.cost.give_up()
                } else {
                    self.cost.end(begin.elapsed())
                }
                done
            }
            None => reported,
        }
    }

    fn report(&mut self, job: &Job, shown: Option<&dyn Shown>) -> Result<(), ResultsError> {
        let mut rows = Ok(());
        for row in job.rows.chunks_exact(self.columns.len().max(1)) {
            rows = rows.and(self.history.row(row));
            if self.has_pictures {
                self.plot_rows.add(row);
            }
        }
        if let Some(log) = &mut self.hashes {
            rows = rows.and(job.hashes.iter().try_for_each(|hashes| log.line(|text| hashes::append_line(text, hashes))));
        }
        if let Some(cells) = &job.cells {
            self.frames.writer = VtuWriter::new(cells, &self.threads);
            self.film.iter_mut().for_each(|film| film.set_cells(cells.clone()));
        }
        let Some(shown) = job.frame.as_ref().map(|frame| frame as &dyn Shown).or(shown) else { return rows };
        if self.frames.write(shown, &self.include, &self.folder, &self.threads)? {
            if let (Some(film), Some(frame)) = (&mut self.film, &job.frame) {
                film.add(frame);
            }
            rows = rows.and(self.history.flush()).and(self.hashes.as_mut().map_or(Ok(()), Lines::flush));
        }
        rows
    }

    /// Completes the files. What can be written is written even when something else can't.
    pub(super) fn close(self) -> Closed {
        let result = self.history.finish().and(self.hashes.map_or(Ok(()), Lines::finish));
        let result = result.and(self.frames.write_collection(&self.folder));
        let made = self.has_pictures.then(|| {
            self.folder.add_pictures(|side| {
                self.film.map_or(Ok(()), |film| film.finish(side, &self.threads)).map_err(|e| e.to_string())?;
                picture::plots(&self.columns, &self.plot_rows.rows(), &self.title, self.of_whole_bodies, side).map_err(|e| e.to_string())
            })
        });
        Closed { result, pictures_missing: made.and_then(Result::err), states_missing: self.states_missing }
    }
}

/// Whether a model wants pictures of its frames.
fn has_film(model: &Model) -> bool {
    model.output.pictures && model.output.fields != Cadence::Count(0)
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
        camera: model.output.camera.unwrap_or_default(),
        of_whole_bodies: model.is_of_whole_bodies(),
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
    /// So many of them are on the disk for sure.
    secured: usize,
}

impl Frames {
    fn new(cells: &Cells, threads: &Threads) -> Self {
        Self {
            writer: VtuWriter::new(cells, threads),
            written: Vec::new(),
            obstacles: Obstacles::default(),
            step_last: None,
            collected: Instant::now(),
            secured: 0,
        }
    }

    /// Writes a frame; `false` when this step is there already, as when a run fails right at an output time.
    fn write(&mut self, shown: &dyn Shown, include: &[String], folder: &ResultFolder, threads: &Threads) -> Result<bool, ResultsError> {
        if self.step_last == Some(shown.step()) {
            return Ok(false);
        }
        let name = ResultFolder::frame_name(self.written.len());
        let file = self.writer.file(shown, include)?;
        write_whole_in_pieces(&folder.path().join(&name), |out| file.write(threads, out))?;
        drop(file);
        self.obstacles.write(&shown.outlined(), self.written.len(), folder)?;
        self.written.push((shown.time(), name));
        self.step_last = Some(shown.step());
        if self.written.len() == 1 || self.collected.elapsed() > COLLECTION_PAUSE {
            self.write_collection(folder)?;
            self.collected = Instant::now();
        }
        Ok(true)
    }

    /// How far they are.
    fn reported(&self) -> Reported {
        let Obstacles { lines, extent, written } = &self.obstacles;
        Reported {
            frames: self.written.iter().map(|(time, _)| *time).collect(),
            frame_step: self.step_last,
            has_obstacles: !written.is_empty(),
            extent: *extent,
            far: lines.far,
            ..Reported::default()
        }
    }

    /// Continues from there.
    fn recall(&mut self, reported: &Reported) {
        let with = |name: fn(usize) -> String| reported.frames.iter().copied().zip((0..).map(name)).collect();
        (self.written, self.step_last) = (with(ResultFolder::frame_name), reported.frame_step);
        self.obstacles.written = if reported.has_obstacles { with(ResultFolder::obstacles_name) } else { Vec::new() };
        (self.obstacles.extent, self.obstacles.lines.far) = (reported.extent, reported.far);
        self.secured = self.written.len();
    }

    /// Sees to it that what a checkpoint counts on outlives a power failure.
    fn secure(&mut self, folder: &ResultFolder) -> Result<(), ResultsError> {
        let names = self.written.iter().zip(0..).skip(self.secured);
        let all = names.flat_map(|((_, name), number)| {
            let has_obstacles = number < self.obstacles.written.len();
            [Some(name.clone()), has_obstacles.then(|| ResultFolder::obstacles_name(number))].into_iter().flatten()
        });
        for path in all.map(|name| folder.path().join(name)) {
            File::open(&path).and_then(|file| file.sync_all()).map_err(ResultsError::file("write", &path))?;
        }
        folder.secure();
        self.secured = self.written.len();
        Ok(())
    }

    fn write_collection(&self, folder: &ResultFolder) -> Result<(), ResultsError> {
        if self.written.is_empty() {
            return Ok(());
        }
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
    extent: Option<Extent<3>>,
    written: Vec<(f64, String)>,
}

impl Obstacles {
    fn write(&mut self, frame: &Frame, number: usize, folder: &ResultFolder) -> Result<(), ResultsError> {
        if frame.outlines.is_empty() {
            return Ok(());
        }
        let places = (0..frame.nodes()).map(|node| frame.place(node));
        for p in places.filter(|p| p.iter().all(|v| v.is_finite())) {
            let [low, high] = self.extent.unwrap_or([p, p]);
            self.extent = Some([[0, 1, 2].map(|k| low[k].min(p[k])), [0, 1, 2].map(|k| high[k].max(p[k]))]);
        }
        let near = self.extent.unwrap_or_default();
        let name = ResultFolder::obstacles_name(number);
        let path = folder.path().join(&name);
        if frame.dimension == 3 {
            let surfaces: Vec<Surface> = self.lines.surfaces(frame).iter().map(|surface| surface.piece(near)).collect();
            write_whole_in_pieces(&path, |out| vtu::write_surfaces(&surfaces, frame.time, out))?;
        } else {
            let near = near.map(|[x, y, _]| [x, y]);
            let lines: Vec<Vec<[f64; 2]>> = self.lines.lines(frame).iter().map(|line| line.piece(near)).collect();
            write_whole_in_pieces(&path, |out| vtu::write_obstacles(&lines, frame.time, out))?;
        }
        self.written.push((frame.time, name));
        Ok(())
    }
}
