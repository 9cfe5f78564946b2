//! Simulations: stepped without the interpreter's lock, asked for arrays between steps.
//!
//! Rows of the history are kept as they are reported, so a run in pieces has the history of the whole one.
//! What Python asks for is copied: the solver has its nodes in an order of its own, and continues writing.

use crate::fault::{self, Class, Entry, guarded, raise};
use crate::model::Model;
use crate::{bytes, numbers};
use embate_files::checkpoint::{Checkpoint, Exchanged, Identity, Origin};
use embate_files::model_file::{GivenMeshes, Loaded};
use embate_files::post_mortem::Failed;
use embate_files::results::{Checkpoints, Pause, Recorder, Report, ResultFolder};
use embate_files::threads::Threads;
use embate_files::{gmsh, mesh_file};
use embate_solver::error::Error;
use embate_solver::mesh::PlacedMesh;
use embate_solver::output::{Cells, Frame, Shown};
use embate_solver::simulation::{self, Control, Observer, ObserverError, Options, Progress, State};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, TryLockError};
use std::time::Instant;

/// Part of the time asked for after which a stretch of steps ends.
const SLICES: f64 = 4.0;

/// A simulation.
#[pyclass(frozen, module = "embate._embate")]
pub(crate) struct Simulation {
    inner: Mutex<Option<Inner>>,
    loaded: Arc<Loaded>,
    origin: Option<Origin>,
    options: Options,
    /// A child of a fork has the memory of its parent but not its threads.
    process: u32,
}

struct Inner {
    simulation: simulation::Simulation,
    history: History,
    recorder: Option<Recorder<'static>>,
    /// The failure that ended the run.
    failure: Option<Error>,
    /// Folder into which results are written, or were until the failure.
    folder: PathBuf,
    /// Whether something was changed between two steps.
    is_steered: bool,
    /// The part that went over to another mesh last.
    exchanged: Option<Exchanged>,
    /// Steps that took about a stretch of the time asked for.
    stretch: u64,
}

/// Rows as they are reported.
#[derive(Default)]
struct History {
    rows: Vec<f64>,
    /// What the user should know, since it was asked for last.
    notices: Vec<Entry>,
}

/// Who listens: the history, and the recorder where there is one.
struct Ears<'e> {
    history: &'e mut History,
    recorder: Option<&'e mut Recorder<'static>>,
}

impl Observer for Ears<'_> {
    fn frame(&mut self, frame: Frame) -> Result<(), ObserverError> {
        self.recorder.as_mut().map_or(Ok(()), |recorder| recorder.frame(frame))
    }

    fn show(&mut self, shown: &dyn Shown) -> Result<(), ObserverError> {
        self.recorder.as_mut().map_or(Ok(()), |recorder| recorder.show(shown))
    }

    fn cells(&mut self, cells: Cells) -> Result<(), ObserverError> {
        self.recorder.as_mut().map_or(Ok(()), |recorder| recorder.cells(cells))
    }

    fn row(&mut self, row: &[f64]) -> Result<(), ObserverError> {
        self.history.rows.extend_from_slice(row);
        self.recorder.as_mut().map_or(Ok(()), |recorder| recorder.row(row))
    }

    fn keeps_states(&self) -> bool {
        self.recorder.as_ref().is_some_and(|recorder| recorder.keeps_states())
    }

    fn state(&mut self, state: State) -> Result<(), ObserverError> {
        self.recorder.as_mut().map_or(Ok(()), |recorder| recorder.state(state))
    }

    fn keeps_hashes(&self) -> bool {
        self.recorder.as_ref().is_some_and(|recorder| recorder.keeps_hashes())
    }

    fn hashes(&mut self, hashes: embate_solver::hashes::Hashes) -> Result<(), ObserverError> {
        self.recorder.as_mut().map_or(Ok(()), |recorder| recorder.hashes(hashes))
    }

    fn failing(&mut self) {
        if let Some(recorder) = &mut self.recorder {
            recorder.failing();
        }
    }

    fn progress(&mut self, progress: &Progress<'_>) -> Control {
        self.history.notices.extend(progress.notices.iter().map(|notice| Entry::of_kind(notice.kind, &notice.text)));
        self.recorder.as_mut().map_or(Control::Continue, |recorder| recorder.progress(progress))
    }
}

impl History {
    /// The rows with columns that have joined `before`, as 0: what they count had not happened.
    fn widen(&mut self, before: &[String], now: &[String]) {
        if before == now || before.is_empty() {
            return;
        }
        let places: Vec<Option<usize>> = now.iter().map(|name| before.iter().position(|own| own == name)).collect();
        let widened = |row: &[f64]| places.iter().map(|place| place.map_or(0.0, |place| row[place])).collect::<Vec<f64>>();
        self.rows = self.rows.chunks_exact(before.len()).flat_map(widened).collect();
    }
}

impl Inner {
    fn of(simulation: simulation::Simulation) -> Self {
        Self {
            simulation,
            history: History::default(),
            recorder: None,
            failure: None,
            folder: PathBuf::new(),
            is_steered: false,
            exchanged: None,
            stretch: 1,
        }
    }

    /// Refuses to change a run that has failed.
    fn refuse_failed(&self) -> PyResult<()> {
        let Some(failure) = &self.failure else { return Ok(()) };
        Err(raise(Class::State, &format!("the run has failed, nothing can be changed: {}", failure.with_code()), &[]))
    }

    /// Stretches of steps until one of the limits, the wall time among them, or the end.
    fn advance(&mut self, until: f64, steps: u64, seconds: f64) -> PyResult<()> {
        let begin = Instant::now();
        let last = self.simulation.steps().saturating_add(steps);
        loop {
            let (from, start) = (self.simulation.steps(), Instant::now());
            let wanted = self.stretch.min(last - from);
            let mut ears = Ears { history: &mut self.history, recorder: self.recorder.as_mut() };
            if let Err(error) = self.simulation.run_until(until, wanted, &mut ears) {
                let raised = fault::of_error(&error);
                self.failure = Some(error);
                return Err(raised);
            }
            let (now, took) = (self.simulation.steps(), start.elapsed().as_secs_f64());
            if now - from == self.stretch {
                let factor = (seconds / SLICES / took.max(1e-9)).clamp(0.25, 4.0);
                self.stretch = ((self.stretch as f64 * factor) as u64).clamp(1, 1 << 20);
            }
            let is_there = now >= last || self.simulation.time() >= until || self.simulation.is_over() || now == from;
            if is_there || begin.elapsed().as_secs_f64() >= seconds {
                return Ok(());
            }
        }
    }

    /// Completes the results, if any are written; of a run that has failed with its post-mortem, whose path
    /// comes back.
    fn finish(&mut self, loaded: &Loaded, options: &Options) -> PyResult<Option<PathBuf>> {
        let Some(mut recorder) = self.recorder.take() else { return Ok(None) };
        let page = match &self.failure {
            Some(error) if !matches!(error, Error::Output(_) | Error::State(_)) => {
                // What goes wrong with it hides nothing of the failure.
                let page = self.post_mortem(loaded, options, &self.folder, Some(&mut recorder)).ok();
                if page.is_some() {
                    recorder.point_to_post_mortem();
                }
                page
            }
            _ => None,
        };
        let failure = self.failure.as_ref().map(Error::with_code);
        let outcome = recorder.finish(failure, &self.simulation.summary(), || None);
        outcome.unwritten.map_or(Ok(page), |error| Err(fault::of_results(&error)))
    }

    /// Finds out how a failure came, and writes its page into a folder; keeps the state of the step before
    /// where a recorder wants it.
    fn post_mortem(
        &self,
        loaded: &Loaded,
        options: &Options,
        folder: &Path,
        recorder: Option<&mut Recorder<'static>>,
    ) -> PyResult<PathBuf> {
        let Some(error) = &self.failure else {
            return Err(raise(Class::State, "the run has not failed: there is no post-mortem of it", &[]));
        };
        let run = &loaded.model.run;
        let keeps_last_good =
            recorder.as_ref().is_some_and(|it| it.keeps_states()) && (run.checkpoint.is_some() || run.checkpoint_steps.is_some());
        let failed = Failed {
            model: &loaded.model,
            loaded,
            options,
            simulation: &self.simulation,
            error,
            checkpoints: folder,
            keeps_last_good,
            is_steered: self.is_steered,
        };
        // Ctrl-C skips the second pass.
        let mut findings = failed.findings(|| Python::attach(|py| py.check_signals().is_ok()));
        if let (Some(recorder), Some(state)) = (recorder, findings.last_good.take()) {
            // What can't be written is reported when the results are completed.
            let _ = recorder.state(state);
        }
        failed.write(&findings, folder).map_err(|error| fault::of_results(&error))
    }
}

/// Bytes for the states that a run keeps in memory, from which it can go to its failure once more.
const ROOM: usize = 64 << 20;

impl Simulation {
    fn of(inner: Inner, model: &Model, options: Options) -> Self {
        let (loaded, origin) = (model.loaded.clone(), model.origin.clone());
        Self { inner: Mutex::new(Some(inner)), loaded, origin, options, process: std::process::id() }
    }

    fn lock(&self) -> PyResult<MutexGuard<'_, Option<Inner>>> {
        if std::process::id() != self.process {
            let text = "this simulation belongs to the process that made it, and this one was forked from it: make \
                the simulation here, or start workers by \"spawn\"";
            return Err(raise(Class::State, text, &[]));
        }
        match self.inner.try_lock() {
            Ok(inner) if inner.is_none() => Err(raise(Class::State, "this simulation is closed", &[])),
            Ok(inner) => Ok(inner),
            Err(TryLockError::WouldBlock) => {
                let text = "this simulation is at work in another thread, or calls a function that steps it: a \
                    simulation does one thing at a time";
                Err(raise(Class::State, text, &[]))
            }
            Err(TryLockError::Poisoned(_)) => Err(raise(Class::State, "this simulation was ended by a failure of embate itself", &[])),
        }
    }

    fn with<T>(&self, work: impl FnOnce(&mut Inner) -> PyResult<T>) -> PyResult<T> {
        let mut guard = self.lock()?;
        guarded(|| guard.as_mut().map_or_else(|| Err(raise(Class::State, "this simulation is closed", &[])), work))
    }

    /// Changes something between two steps.
    fn change(&self, change: impl FnOnce(&mut simulation::Simulation) -> Result<(), embate_solver::error::Fault>) -> PyResult<()> {
        self.with(|inner| {
            inner.refuse_failed()?;
            inner.is_steered = true;
            change(&mut inner.simulation).map_err(|fault| fault::of_change(&fault))
        })
    }

    /// The same without the interpreter's lock.
    fn without_lock<T: Send>(&self, py: Python<'_>, work: impl FnOnce(&mut Inner) -> PyResult<T> + Send) -> PyResult<T> {
        py.detach(|| self.with(work))
    }
}

/// A mesh file, the parts that have it in one place, and numbers of its nodes.
type Placed<'py> = (String, Vec<String>, Vec<Bound<'py, PyBytes>>);

#[pymethods]
impl Simulation {
    #[new]
    fn new(py: Python<'_>, model: &Model, threads: usize, instruction_set: Option<String>) -> PyResult<Self> {
        let options = Options { threads, simd: instruction_set };
        let loaded = &model.loaded;
        let make = || simulation::Simulation::new(&loaded.model, &options).map_err(|error| fault::of_error(&error));
        let simulation = py.detach(|| guarded(make))?;
        Ok(Self::of(Inner::of(simulation), model, options))
    }

    /// One that stands where a file says that another one of the same model stood; with the rows of its
    /// history.
    #[staticmethod]
    fn resumed(
        py: Python<'_>,
        model: &Model,
        path: PathBuf,
        rows: Vec<f64>,
        threads: usize,
        instruction_set: Option<String>,
    ) -> PyResult<Self> {
        let options = Options { threads, simd: instruction_set };
        let loaded = &model.loaded;
        let make = || {
            let threads = Threads::new(options.thread_count());
            let past = Checkpoint::read(&path, &threads).map_err(|error| fault::of_checkpoint(&error))?;
            let changes = Identity::of(&loaded.model).differences(&past.identity);
            if !changes.is_empty() {
                let text = format!("the model is not the one that was saved\n  {}", changes.join("\n  "));
                return Err(raise(Class::Model, &text, &[]));
            }
            let resumed = simulation::Simulation::resumed(&loaded.model, &options, &past.state.sections);
            resumed.map_err(|error| fault::of_error(&error))
        };
        let simulation = py.detach(|| guarded(make))?;
        let inner = Inner { history: History { rows, ..History::default() }, ..Inner::of(simulation) };
        Ok(Self::of(inner, model, options))
    }

    /// Steps until a time (s), so many steps, the end, or so many seconds of wall time have passed, whichever
    /// is first.
    fn advance(&self, py: Python<'_>, until: f64, steps: u64, seconds: f64) -> PyResult<()> {
        self.without_lock(py, |inner| {
            if let Some(failure) = &inner.failure {
                return Err(raise(Class::State, &format!("the run has failed and can't continue: {}", failure.with_code()), &[]));
            }
            inner.advance(until, steps, seconds)
        })
    }

    /// Begins to write results into a folder, which is made; `force`: what is there goes. A model that came
    /// from no file is written beside them, where `given` has its text, its meshes as .msh files, and what of
    /// it was overridden: so the command can run it again. One that names files besides can't be.
    fn record(&self, py: Python<'_>, folder: PathBuf, force: bool, given: Option<(String, GivenMeshes, Vec<String>)>) -> PyResult<()> {
        let (loaded, options, origin) = (&self.loaded, &self.options, &self.origin);
        self.without_lock(py, |inner| {
            let model = &loaded.model;
            let path = folder;
            let folder = ResultFolder::create(&path, force).map_err(|error| fault::of_results(&error))?;
            let shown = (inner.simulation.history_columns(), inner.simulation.cells());
            let origin = match (origin.clone(), given) {
                (Some(origin), _) => origin,
                (None, Some((text, meshes, set))) if loaded.names_only(&meshes) => {
                    let path = folder.keep_model(&model.name, &text, &meshes).map_err(|error| fault::of_results(&error))?;
                    Origin { path, set, ..Origin::default() }
                }
                (None, _) => Origin::default(),
            };
            // Without its file a state helps no one who does not ask for it.
            let is_lost = origin.path.as_os_str().is_empty();
            let mut checkpoints = Checkpoints::of(model, Origin { exchanged: inner.exchanged.clone(), ..origin });
            checkpoints.pause = if is_lost { Pause::Never } else { checkpoints.pause };
            let checkpoints = Some(checkpoints.with_words(loaded, inner.simulation.part_meshes(model)));
            let quiet = Box::new(|_: &Progress<'_>| Control::Continue);
            let recorder = Recorder::keeping(folder, model, shown, options.thread_count(), checkpoints, quiet);
            let mut recorder = recorder.map_err(|error| fault::of_results(&error))?;
            if inner.exchanged.is_some() && !is_lost {
                // The model alone does not lead here.
                let state = inner.simulation.state().map_err(|error| fault::of_error(&error))?;
                recorder.keep(state).map_err(|error| fault::of_results(&error))?;
            }
            inner.recorder = Some(recorder);
            inner.folder = path;
            inner.simulation.keep_states_in(ROOM);
            Ok(())
        })
    }

    /// Completes the results that are being written; of a run that has failed the path of its post-mortem.
    fn finish(&self, py: Python<'_>) -> PyResult<Option<PathBuf>> {
        let (loaded, options) = (&self.loaded, &self.options);
        self.without_lock(py, |inner| inner.finish(loaded, options))
    }

    /// Writes the post-mortem of a run that has failed into a folder; the path of its page.
    fn post_mortem(&self, py: Python<'_>, folder: PathBuf) -> PyResult<PathBuf> {
        let (loaded, options) = (&self.loaded, &self.options);
        self.without_lock(py, |inner| inner.post_mortem(loaded, options, &folder, None))
    }

    /// Lets go of everything; results are completed.
    fn close(&self, py: Python<'_>) -> PyResult<()> {
        if self.process != std::process::id() {
            return Ok(());
        }
        let finished = py.detach(|| match self.inner.try_lock() {
            Ok(mut inner) => Some(inner.take()),
            Err(_) => None,
        });
        match finished {
            None => self.lock().map(|_| ()),
            Some(None) => Ok(()),
            Some(Some(mut inner)) => py.detach(|| guarded(|| inner.finish(&self.loaded, &self.options).map(|_| ()))),
        }
    }

    #[getter]
    fn is_closed(&self) -> bool {
        self.inner.try_lock().is_ok_and(|inner| inner.is_none())
    }

    /// Time, step, time step, end, drift of the energy, whether the run is over.
    fn clock(&self) -> PyResult<(f64, u64, f64, f64, f64, bool)> {
        self.with(|inner| {
            let it = &inner.simulation;
            Ok((it.time(), it.steps(), it.time_step(), self.loaded.model.run.end, it.ledger().drift(), it.is_over()))
        })
    }

    #[getter]
    fn dimension(&self) -> usize {
        self.loaded.model.dimension()
    }

    /// Positions of the nodes, f64.
    fn positions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let values = self.without_lock(py, |inner| Ok(inner.simulation.coordinates()))?;
        bytes(py, &values, f64::to_ne_bytes)
    }

    /// A field by its name: values as f64, how many for each node or cell.
    fn field<'py>(&self, py: Python<'py>, name: &str) -> PyResult<(Bound<'py, PyBytes>, usize)> {
        let field = self.without_lock(py, |inner| Ok(inner.simulation.field(name)))?;
        let Some(field) = field else { return Err(PyValueError::new_err(format!("there is no field {name}"))) };
        Ok((bytes(py, &field.values, f64::to_ne_bytes)?, field.kind.width()))
    }

    /// The cells: nodes of all (u32), where those of each begin (u32, one more than cells), kinds (texts),
    /// part of each (u32), names of the parts.
    #[expect(clippy::type_complexity, reason = "five arrays for Python")]
    fn cells<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyBytes>, Bound<'py, PyBytes>, Vec<&'static str>, Bound<'py, PyBytes>, Vec<String>)> {
        let cells = self.without_lock(py, |inner| Ok(inner.simulation.cells()))?;
        let of = |values: &[u32]| bytes(py, values, u32::to_ne_bytes);
        Ok((
            of(&cells.nodes)?,
            of(&cells.offsets)?,
            cells.kinds.iter().map(|kind| kind.facts().name).collect(),
            of(&cells.parts)?,
            cells.part_names.clone(),
        ))
    }

    /// Of each mesh from a file or from memory, where parts have it that are not swept: its name, these
    /// parts, and where its nodes are among those of the state (u32, the largest number: nowhere), one list
    /// for each body of these parts.
    fn placed<'py>(&self, py: Python<'py>) -> PyResult<Vec<Placed<'py>>> {
        let model = &self.loaded.model;
        self.with(|inner| {
            let is_as_it_is = |place: &&PlacedMesh| place.parts.iter().all(|&part| model.parts[part].sweep.is_none());
            let of = |place: &PlacedMesh| {
                let parts = place.parts.iter().map(|&part| model.parts[part].name.clone()).collect();
                let numbers = |copy| bytes(py, &place.numbers(copy).collect::<Vec<u32>>(), u32::to_ne_bytes);
                let numbers = (0..place.copies).map(numbers).collect::<PyResult<Vec<_>>>()?;
                Ok((model.meshes[place.file].source.clone(), parts, numbers))
            };
            inner.simulation.placed().iter().filter(is_as_it_is).map(of).collect()
        })
    }

    /// Nodes of a part, a side or a group (u32), ascending; `None`: there is nothing of this name.
    fn nodes<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Option<Bound<'py, PyBytes>>> {
        let nodes = self.with(|inner| Ok(inner.simulation.nodes_of(name)))?;
        nodes.map(|nodes| bytes(py, &nodes, u32::to_ne_bytes)).transpose()
    }

    /// Gives nodes (u32) other velocities (f64), one node after the other.
    fn set_velocities(&self, nodes: &[u8], velocities: &[u8]) -> PyResult<()> {
        let (nodes, velocities) = (numbers(nodes, u32::from_ne_bytes), numbers(velocities, f64::from_ne_bytes));
        self.change(|simulation| simulation.set_velocities(&nodes, &velocities))
    }

    /// Lets forces (f64) act on nodes (u32), until others are given.
    fn set_forces(&self, nodes: &[u8], forces: &[u8]) -> PyResult<()> {
        let (nodes, forces) = (numbers(nodes, u32::from_ne_bytes), numbers(forces, f64::from_ne_bytes));
        self.change(|simulation| simulation.set_forces(&nodes, &forces))
    }

    /// Lets a curve run from its value now to another one, which it has from a time on (s; none: at once).
    fn set_curve(&self, name: &str, value: f64, until: Option<f64>) -> PyResult<()> {
        self.change(|simulation| simulation.set_curve(name, value, until))
    }

    /// Lets a part continue on another mesh: that of a file, or the bytes of a .msh file.
    fn exchange(&self, py: Python<'_>, part: &str, mesh: (PathBuf, Option<Vec<u8>>), scale: f64, group: Option<&str>) -> PyResult<()> {
        let model = &self.loaded.model;
        self.without_lock(py, |inner| {
            inner.refuse_failed()?;
            let (path, bytes) = mesh;
            let read = match &bytes {
                Some(bytes) => gmsh::parse(bytes, &path.to_string_lossy(), scale),
                None => mesh_file::read(&path, scale),
            };
            let read = read.map_err(|faults| fault::of_faults(&faults))?;
            let (step, before) = (inner.simulation.steps(), inner.simulation.history_columns());
            inner.simulation.exchange(model, part, read, group).map_err(|error| fault::of_error(&error))?;
            inner.history.widen(&before, &inner.simulation.history_columns());
            let mesh = if bytes.is_some() { PathBuf::new() } else { std::path::absolute(&path).unwrap_or(path) };
            inner.exchanged = Some(Exchanged { run: PathBuf::new(), step, part: part.into(), mesh });
            inner.is_steered = true;
            Ok(())
        })
    }

    /// Value of a curve now; `None`: there is nothing of this name.
    fn curve(&self, name: &str) -> PyResult<Option<f64>> {
        self.with(|inner| Ok(inner.simulation.curve(name)))
    }

    /// Names of the history's columns.
    fn columns(&self) -> PyResult<Vec<String>> {
        self.with(|inner| Ok(inner.simulation.history_columns()))
    }

    /// Rows of the history so far, f64.
    fn rows<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        self.with(|inner| bytes(py, &inner.history.rows, f64::to_ne_bytes))
    }

    /// Values of the history's columns now.
    fn row(&self) -> PyResult<Vec<f64>> {
        self.with(|inner| Ok(inner.simulation.history_row()))
    }

    /// What `summary.json` would say now, without times of the wall.
    fn summary(&self, py: Python<'_>) -> PyResult<String> {
        let model = &self.loaded.model;
        self.without_lock(py, |inner| {
            let names = inner.simulation.cells().part_names;
            Ok(Report::of(&inner.simulation.summary(), &model.name, &names).json())
        })
    }

    /// Hash of the state, as in `summary.json`.
    fn hash(&self, py: Python<'_>) -> PyResult<String> {
        self.without_lock(py, |inner| Ok(inner.simulation.summary().state_hash))
    }

    /// Things the user should know, seen since they were asked for last.
    fn notices<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let notices = self.with(|inner| Ok(std::mem::take(&mut inner.history.notices)))?;
        notices.iter().map(|notice| notice.dict(py)).collect()
    }

    /// Writes the state into a file.
    fn write_state(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let (loaded, options) = (&self.loaded, &self.options);
        self.without_lock(py, |inner| {
            let state = inner.simulation.state().map_err(|error| fault::of_error(&error))?;
            let checkpoint = Checkpoint::of(state, &loaded.model);
            checkpoint.write_file(&path, &Threads::new(options.thread_count())).map_err(|error| fault::of_checkpoint(&error))
        })
    }
}
