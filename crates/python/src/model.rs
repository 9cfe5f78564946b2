//! Models: read from a file or a text, as a simulation needs them.

use crate::fault::{entries, guarded, of_diagnostics};
use embate_files::PathPolicy;
use embate_files::checkpoint::Origin;
use embate_files::model_file::{GivenMeshes, Loaded, check_piece, load_text_with_meshes, load_with_additions, load_with_places};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::Arc;

/// A model without faults.
#[pyclass(frozen, module = "embate._embate")]
pub(crate) struct Model {
    pub(crate) loaded: Arc<Loaded>,
    /// The file that it came from.
    pub(crate) origin: Option<Origin>,
}

fn reach(is_anywhere: bool) -> PathPolicy {
    if is_anywhere { PathPolicy::Anywhere } else { PathPolicy::Folder }
}

#[pymethods]
impl Model {
    /// Reads a model file, or the `model.toml` of a folder; `added`: the text of more sections and meshes
    /// that it calls, with which it is no longer the model of a file.
    #[staticmethod]
    fn from_file(
        py: Python<'_>,
        path: PathBuf,
        added: Option<(String, GivenMeshes)>,
        set: Vec<String>,
        allow_outside: bool,
    ) -> PyResult<Self> {
        let is_of_file = added.is_none();
        let read = || {
            let loaded = match added {
                Some((added, given)) => load_with_additions(&path, (added.as_str(), given), &set, reach(allow_outside)),
                None => load_with_places(&path, &set, reach(allow_outside)),
            };
            loaded.map_err(|faults| of_diagnostics(&faults))
        };
        let loaded = py.detach(|| guarded(read))?;
        let path = std::path::absolute(&path).unwrap_or(path);
        let origin = is_of_file.then_some(Origin { path, set, ..Origin::default() });
        Ok(Self { loaded: Arc::new(loaded), origin })
    }

    /// Checks some sections of a model that is not complete, by their text; items of the section `list` are
    /// counted from `first`.
    #[staticmethod]
    fn check_piece(name: &str, text: &str, list: &str, first: usize) -> PyResult<()> {
        guarded(|| check_piece(name, text, (list, first)).map_err(|faults| of_diagnostics(&faults)))
    }

    /// Reads a text; files that it names are looked for in `folder`, meshes first among the bytes of .msh
    /// files in `meshes`.
    #[staticmethod]
    fn from_text(
        py: Python<'_>,
        name: String,
        text: String,
        folder: PathBuf,
        set: Vec<String>,
        allow_outside: bool,
        meshes: GivenMeshes,
    ) -> PyResult<Self> {
        let read =
            || load_text_with_meshes(&name, &text, (&folder, reach(allow_outside)), &set, meshes).map_err(|faults| of_diagnostics(&faults));
        let loaded = py.detach(|| guarded(read))?;
        Ok(Self { loaded: Arc::new(loaded), origin: None })
    }

    /// Name.
    #[getter]
    fn name(&self) -> &str {
        &self.loaded.model.name
    }

    /// Title.
    #[getter]
    fn title(&self) -> &str {
        &self.loaded.model.title
    }

    /// 2 in 2D, 3 in 3D.
    #[getter]
    fn dimension(&self) -> usize {
        self.loaded.model.dimension()
    }

    /// End time, s.
    #[getter]
    fn end(&self) -> f64 {
        self.loaded.model.run.end
    }

    /// Names of the parts.
    #[getter]
    fn parts(&self) -> Vec<&str> {
        self.loaded.model.parts.iter().map(|part| part.name.as_str()).collect()
    }

    /// What the user should know of the model before it runs: code, place, message and remedy of each.
    fn warnings<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let reported = self.loaded.reported(&self.loaded.model.warnings());
        entries(&reported).iter().map(|entry| entry.dict(py)).collect()
    }
}
