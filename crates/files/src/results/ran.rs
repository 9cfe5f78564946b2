//! `run.json`: what ran, so that it can be known, and run again, when the model has changed since: the version of the program, where the model came from, and what it was, key by key.
//!
//! Written when a run begins, and again when it goes on. Read by `embate diff`.

use super::{ResultsError, write_whole};
use crate::checkpoint::{Identity, Origin};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::fs;
use std::io::ErrorKind;
use std::path::Path;

/// Name of the file.
pub(super) const RAN: &str = "run.json";

/// What ran.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ran {
    /// Version of the program.
    pub version: String,
    /// File or folder of the model; absolute.
    model: String,
    /// Keys that were overridden.
    set: Vec<String>,
    /// What the model was.
    pub keys: Identity,
}

impl Ran {
    /// What a model is and where it came from.
    pub(super) fn of(keys: Identity, origin: &Origin) -> Self {
        let path = origin.path.to_string_lossy().into_owned();
        Self { version: env!("CARGO_PKG_VERSION").into(), model: path, set: origin.set.clone(), keys }
    }

    pub(super) fn write(&self, folder: &Path) -> Result<(), ResultsError> {
        let text = serde_json::to_string_pretty(self).expect("texts, lists and maps of texts always have a JSON form");
        write_whole(&folder.join(RAN), format!("{text}\n").as_bytes())
    }

    /// That of a folder of results; `None`: there is none.
    ///
    /// # Errors
    /// [`ResultsError::Damaged`]; what the system says.
    pub fn read(folder: &Path) -> Result<Option<Self>, ResultsError> {
        read_json(&folder.join(RAN))
    }

    /// Where the model came from.
    #[must_use]
    pub fn origin(&self) -> Origin {
        Origin { path: self.model.clone().into(), set: self.set.clone() }
    }
}

/// A JSON file that may be missing.
///
/// # Errors
/// [`ResultsError::Damaged`]; what the system says.
pub(crate) fn read_json<T: DeserializeOwned>(path: &Path) -> Result<Option<T>, ResultsError> {
    match fs::read(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(ResultsError::file("read", path)(error)),
        Ok(bytes) => serde_json::from_slice(&bytes).map(Some).map_err(|error| ResultsError::Damaged {
            path: path.into(),
            line: error.line(),
            what: error.to_string(),
        }),
    }
}
