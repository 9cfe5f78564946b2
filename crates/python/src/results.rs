//! Result folders: histories and frames that are on the disk, also of runs that continue.

use crate::bytes;
use crate::fault::{guarded, of_results};
use embate_files::results::{History, unit};
use embate_files::view::{FrameArrays, frame_files};
use embate_solver::output::Location;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

/// Columns, their units and values (f64, row by row) of the history in a folder, as far as it is written;
/// `None`: there is none. Energies and forces are those of whole bodies or per metre of depth.
#[pyfunction]
#[expect(clippy::type_complexity, reason = "a table for Python")]
pub(crate) fn history<'py>(
    py: Python<'py>,
    folder: PathBuf,
    of_whole_bodies: bool,
) -> PyResult<Option<(Vec<String>, Vec<&'static str>, Bound<'py, PyBytes>)>> {
    let read = || History::read(&folder).map_err(|error| of_results(&error));
    let Some(History { columns, values }) = py.detach(|| guarded(read))? else { return Ok(None) };
    let rows = values.first().map_or(0, Vec::len);
    let row_by_row: Vec<f64> = (0..rows).flat_map(|row| values.iter().map(move |column| column[row])).collect();
    let units = columns.iter().map(|name| unit(name, of_whole_bodies)).collect();
    Ok(Some((columns, units, bytes(py, &row_by_row, f64::to_ne_bytes)?)))
}

/// The complete frames of a folder: number, time (s) and file.
#[pyfunction]
pub(crate) fn frames(py: Python<'_>, folder: PathBuf) -> PyResult<Vec<(usize, f64, PathBuf)>> {
    py.detach(|| guarded(|| frame_files(&folder).map_err(|error| of_results(&error))))
}

/// A frame on the disk.
#[pyclass(frozen, module = "embate._embate")]
pub(crate) struct Frame {
    arrays: Mutex<FrameArrays>,
}

impl Frame {
    fn with<T: Send>(&self, py: Python<'_>, work: impl FnOnce(&mut FrameArrays) -> PyResult<T> + Send) -> PyResult<T> {
        py.detach(|| guarded(|| work(&mut self.arrays.lock().unwrap_or_else(PoisonError::into_inner))))
    }
}

#[pymethods]
impl Frame {
    /// Opens a file.
    #[new]
    fn new(py: Python<'_>, file: PathBuf) -> PyResult<Self> {
        let open = || FrameArrays::open(&file).map_err(|error| of_results(&error));
        Ok(Self { arrays: Mutex::new(py.detach(|| guarded(open))?) })
    }

    /// s.
    #[getter]
    fn time(&self, py: Python<'_>) -> PyResult<f64> {
        self.with(py, |arrays| Ok(arrays.time()))
    }

    #[getter]
    fn dimension(&self, py: Python<'_>) -> PyResult<usize> {
        self.with(py, |arrays| Ok(arrays.dimension()))
    }

    /// Positions of the nodes, f64.
    fn positions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let values = self.with(py, |arrays| arrays.positions().map_err(|error| of_results(&error)))?;
        bytes(py, &values, f64::to_ne_bytes)
    }

    /// Cells that were eroded (u32), ascending.
    fn gone<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let gone = self.with(py, |arrays| arrays.gone().map_err(|error| of_results(&error)))?;
        bytes(py, &gone, u32::to_ne_bytes)
    }

    /// Names of the fields.
    fn fields(&self, py: Python<'_>) -> PyResult<Vec<&'static str>> {
        self.with(py, |arrays| Ok(arrays.fields().iter().map(|kind| kind.name).collect()))
    }

    /// A field by its name: values as f64, how many for each node or cell, and whether it is at nodes.
    fn field<'py>(&self, py: Python<'py>, name: &str) -> PyResult<(Bound<'py, PyBytes>, usize, bool)> {
        let read = |arrays: &mut FrameArrays| {
            let Some(kind) = arrays.fields().into_iter().find(|kind| kind.name == name) else { return Ok(None) };
            let values = arrays.values(kind).map_err(|error| of_results(&error))?;
            Ok(Some((values, kind.width(), kind.location == Location::Node)))
        };
        let Some((values, width, is_at_nodes)) = self.with(py, read)? else {
            return Err(PyValueError::new_err(format!("the frame has no field {name}")));
        };
        Ok((bytes(py, &values, f64::to_ne_bytes)?, width, is_at_nodes))
    }

    /// The cells: nodes of all (u32), where those of each begin (u32, one more than cells), kinds (texts),
    /// part of each (u32).
    #[expect(clippy::type_complexity, reason = "four arrays for Python")]
    fn cells<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyBytes>, Bound<'py, PyBytes>, Vec<&'static str>, Bound<'py, PyBytes>)> {
        let cells = self.with(py, |arrays| Ok(arrays.cells().clone()))?;
        let of = |values: &[u32]| bytes(py, values, u32::to_ne_bytes);
        Ok((of(&cells.nodes)?, of(&cells.offsets)?, cells.kinds.iter().map(|kind| kind.facts().name).collect(), of(&cells.parts)?))
    }
}
