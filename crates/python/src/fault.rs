//! What goes wrong, as exceptions of the package: `embate.Error` and those below it, defined in
//! `python/embate/errors.py`. Each carries the text that the command would print, the code of its first fault
//! and a list of all.

use embate_files::checkpoint::CheckpointError;
use embate_files::model_file::Diagnostics;
use embate_files::results::ResultsError;
use embate_solver::error::{Error, Fault};
use embate_solver::message::Message;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyDict;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// One fault: code, place, message, remedy.
pub(crate) struct Entry {
    pub(crate) code: String,
    pub(crate) path: String,
    pub(crate) line: usize,
    pub(crate) message: String,
    pub(crate) help: String,
}

impl Entry {
    /// What goes wrong in a run or with files: it has no place in a model.
    pub(crate) fn of_kind(kind: &Message, text: &impl ToString) -> Self {
        Self::of(kind, "", 0, &text.to_string(), "")
    }

    /// Without a help of its own the kind's remedy says what to do.
    fn of(kind: &Message, path: &str, line: usize, message: &str, help: &str) -> Self {
        let help = if help.is_empty() { kind.remedy } else { help };
        Self { code: kind.code.into(), path: path.into(), line, message: message.into(), help: help.into() }
    }

    pub(crate) fn dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        dict.set_item("code", &self.code)?;
        dict.set_item("path", &self.path)?;
        dict.set_item("line", if self.line == 0 { None } else { Some(self.line) })?;
        dict.set_item("message", &self.message)?;
        dict.set_item("help", &self.help)?;
        Ok(dict)
    }
}

/// Those of diagnostics.
pub(crate) fn entries(diagnostics: &Diagnostics) -> Vec<Entry> {
    diagnostics.entries.iter().map(|it| Entry::of(it.kind, &it.path, it.line, &it.message, &it.help)).collect()
}

/// Classes of the exceptions, by what went wrong.
#[derive(Clone, Copy)]
pub(crate) enum Class {
    /// The model.
    Model,
    /// The run.
    Run,
    /// What is asked can't be done with what is there: closed, in use by another thread, of another process.
    State,
    /// Files.
    File,
    /// The program.
    Internal,
}

impl Class {
    fn name(self) -> &'static str {
        match self {
            Self::Model => "ModelError",
            Self::Run => "RunError",
            Self::State => "StateError",
            Self::File => "FileError",
            Self::Internal => "InternalError",
        }
    }
}

/// An exception with a text and its faults.
pub(crate) fn raise(class: Class, text: &str, entries: &[Entry]) -> PyErr {
    static ERRORS: PyOnceLock<Py<PyModule>> = PyOnceLock::new();
    Python::attach(|py| {
        let make = || -> PyResult<PyErr> {
            let errors = ERRORS.get_or_try_init(py, || PyModule::import(py, "embate.errors").map(Bound::unbind))?.bind(py);
            let entries = entries.iter().map(|entry| entry.dict(py)).collect::<PyResult<Vec<_>>>()?;
            Ok(PyErr::from_value(errors.getattr(class.name())?.call1((text, entries))?))
        };
        make().unwrap_or_else(|_| PyRuntimeError::new_err(text.to_string()))
    })
}

/// Of diagnostics of a model file.
pub(crate) fn of_diagnostics(diagnostics: &Diagnostics) -> PyErr {
    raise(Class::Model, diagnostics.rendered.trim_end(), &entries(diagnostics))
}

/// Of an error of the solver: faults of the model, or of the run.
pub(crate) fn of_error(error: &Error) -> PyErr {
    match error {
        Error::Model(faults) => of_faults(faults),
        other => {
            let entries = other.kind().map(|kind| Entry::of_kind(kind, other));
            raise(Class::Run, &other.with_code(), entries.as_slice())
        }
    }
}

/// Of faults of a model, or of a mesh.
pub(crate) fn of_faults(faults: &[Fault]) -> PyErr {
    let entries: Vec<Entry> = faults.iter().map(|it| Entry::of(it.kind, &it.path, 0, &it.message, &it.help)).collect();
    let lines = faults.iter().map(|it| {
        let place = if it.path.is_empty() { String::new() } else { format!("{}: ", it.path) };
        let help = if it.help.is_empty() { String::new() } else { format!("\n  help: {}", it.help) };
        format!("{}: {place}{}{help}", it.kind, it.message)
    });
    raise(Class::Model, &lines.collect::<Vec<_>>().join("\n"), &entries)
}

/// Of a change of a simulation that can't be made.
pub(crate) fn of_change(fault: &Fault) -> PyErr {
    let entry = Entry::of(fault.kind, &fault.path, 0, &fault.message, &fault.help);
    raise(Class::State, &format!("{}: {}\n  help: {}", fault.kind, fault.message, fault.help), &[entry])
}

/// Of files of results.
pub(crate) fn of_results(error: &ResultsError) -> PyErr {
    of_files(error.kind(), error)
}

/// Of checkpoints.
pub(crate) fn of_checkpoint(error: &CheckpointError) -> PyErr {
    of_files(error.kind(), error)
}

fn of_files(kind: &Message, error: &impl ToString) -> PyErr {
    raise(Class::File, &format!("{kind}: {}", error.to_string()), &[Entry::of_kind(kind, error)])
}

/// Does something; a panic becomes an exception.
pub(crate) fn guarded<T>(work: impl FnOnce() -> PyResult<T>) -> PyResult<T> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| {
        let text = panic.downcast_ref::<String>().map(String::as_str).or_else(|| panic.downcast_ref::<&str>().copied());
        let text = format!("embate itself has failed: {}; please report it with the model", text.unwrap_or("no more is known"));
        Err(raise(Class::Internal, &text, &[]))
    })
}
