//! The native half of the Python package: module `embate._embate`.
//!
//! It hands models and simulations through, and nothing else: names, arrays and what is convenient are made
//! in Python (`python/embate`), from the texts, numbers and buffers that come from here. Buffers are native
//! `f64` and `u32`, one value after the other. Whatever goes wrong becomes one of the package's exceptions
//! (`fault.rs`), with the code and the text of the command; a panic, too.

mod fault;
mod model;
mod results;
mod simulation;

use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

/// The native half of embate.
#[pymodule]
mod _embate {
    #[pymodule_export]
    use super::model::Model;
    #[pymodule_export]
    use super::results::{Frame, frames, history};
    #[pymodule_export]
    use super::simulation::Simulation;
    #[pymodule_export]
    use super::{cells, channel, fields, followed, schema, sections};
    #[pymodule_export]
    #[expect(non_upper_case_globals, reason = "a name of Python")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}

/// The sections of a model file: name, whether it is a list, a table of names, or one table, and what it
/// describes; then the keys of each with their explanation.
#[pyfunction]
fn sections(py: Python<'_>) -> PyResult<Vec<Bound<'_, PyDict>>> {
    use embate_solver::input::sections::SECTIONS;
    use embate_solver::vocabulary::Form;
    let of = |section: &embate_solver::vocabulary::Section| {
        let form = match section.form {
            Form::Repeated => "list",
            Form::Named => "named",
            _ => "table",
        };
        let dict = PyDict::new(py);
        dict.set_item("name", section.name)?;
        dict.set_item("form", form)?;
        dict.set_item("doc", section.doc)?;
        let keys: Vec<(&str, &str)> = section.all_keys().map(|key| (key.name, key.doc)).collect();
        dict.set_item("keys", keys)?;
        Ok(dict)
    };
    SECTIONS.iter().copied().map(of).collect()
}

/// The JSON schema of the model file.
#[pyfunction]
fn schema() -> String {
    embate_files::model_file::schema()
}

/// Values of a formula of a history: names of its columns, values of each as f64, the first the time, and the
/// class (CFC) or corner (Hz) of a filter.
#[pyfunction]
#[pyo3(signature = (expression, names, values, class_number, corner))]
fn channel(
    expression: &str,
    names: Vec<String>,
    values: Vec<Vec<f64>>,
    class_number: Option<f64>,
    corner: Option<f64>,
) -> PyResult<Vec<f64>> {
    use embate_solver::channel::{self, filter::Filter};
    let filter = corner.map(Filter::Corner).or(class_number.map(Filter::Class));
    let wrong = |wrong: embate_solver::expression::Wrong| {
        pyo3::exceptions::PyValueError::new_err(format!("{expression:?}, at character {}: {}", wrong.at, wrong.message))
    };
    channel::values(expression, filter, &names, &values).map_err(wrong)
}

/// Values of the curve (x, y) at places that are passed in their order; a text where one is not reached.
#[pyfunction]
fn followed(x: Vec<f64>, y: Vec<f64>, places: Vec<f64>) -> Result<Vec<f64>, PyErr> {
    embate_files::sweep::fit::followed(&x, &y, &places).map_err(|missed| pyo3::exceptions::PyValueError::new_err(missed.to_string()))
}

/// The fields of a dimension: name, components, unit, whether it is at nodes, what it is.
#[pyfunction]
fn fields(dimension: usize) -> Vec<(&'static str, Vec<&'static str>, &'static str, bool, &'static str)> {
    use embate_solver::output::{Location, fields_of};
    let of = |kind: &'static embate_solver::output::FieldKind| {
        (kind.name, kind.components.to_vec(), kind.unit, kind.location == Location::Node, kind.doc)
    };
    fields_of(dimension).iter().map(of).collect()
}

/// The kinds of cells: name, dimension, number of nodes, number in .msh files and in VTK, nodes of each
/// facet.
#[pyfunction]
fn cells(py: Python<'_>) -> PyResult<Vec<Bound<'_, PyDict>>> {
    use embate_solver::mesh::cell::CellKind;
    let of = |kind: CellKind| {
        let facts = kind.facts();
        let corners = |face: &[u8; 4]| face[..if face[2] == face[3] { 3 } else { 4 }].iter().map(|&k| usize::from(k)).collect();
        let faces: Vec<Vec<usize>> = facts.facets.iter().map(corners).collect();
        let dict = PyDict::new(py);
        dict.set_item("name", facts.name)?;
        dict.set_item("dimension", facts.dimension)?;
        dict.set_item("nodes", facts.nodes)?;
        dict.set_item("gmsh", facts.gmsh)?;
        dict.set_item("vtk", facts.vtk)?;
        dict.set_item("faces", faces)?;
        Ok(dict)
    };
    CellKind::ALL.into_iter().map(of).collect()
}

/// Numbers as the bytes of this machine.
fn bytes<'py, const N: usize, T: Copy>(py: Python<'py>, values: &[T], of: impl Fn(T) -> [u8; N]) -> PyResult<Bound<'py, PyBytes>> {
    PyBytes::new_with(py, N * values.len(), |room| {
        for (place, &value) in room.as_chunks_mut::<N>().0.iter_mut().zip(values) {
            *place = of(value);
        }
        Ok(())
    })
}

/// The same back; bytes of less than a number are left out.
fn numbers<const N: usize, T>(bytes: &[u8], of: impl Fn([u8; N]) -> T) -> Vec<T> {
    bytes.as_chunks::<N>().0.iter().map(|&bytes| of(bytes)).collect()
}
