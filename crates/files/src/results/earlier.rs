//! What a folder holds of an earlier run: whether it came to its end, and what it has cost. For who continues
//! it, or would replace it.

use super::{History, Provenance, ResultFolder, ResultsError, read_json};
use crate::checkpoint;
use serde_json::Value;
use std::path::Path;

/// An earlier run.
#[derive(Clone, Debug, Default)]
pub struct Earlier {
    /// A file of it, relative to the folder.
    pub found: String,
    /// What ran; `None`: nothing says so.
    pub ran: Option<Provenance>,
    /// How it ended; `None`: it was cut off, or continues.
    pub end: Option<End>,
    /// Whether it has kept a state.
    pub has_checkpoint: bool,
    /// Wall time that it has taken, as far as it is known, s.
    pub seconds: f64,
}

/// How a run has ended.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct End {
    /// `done`, `failed`, `stopped`.
    pub status: String,
    /// Message of a failed run.
    pub error: Option<String>,
    /// Steps, and time reached, s.
    pub steps: u64,
    /// See `steps`.
    pub time: f64,
    /// Whether it came to rest before its end time.
    pub rests: bool,
}

impl End {
    fn of(summary: &Value) -> Self {
        let text = |key: &str| summary.get(key).and_then(Value::as_str).map(ToString::to_string);
        Self {
            status: text("status").unwrap_or_default(),
            error: text("error"),
            steps: summary.get("steps").and_then(Value::as_u64).unwrap_or(0),
            time: summary.get("time_end").and_then(Value::as_f64).unwrap_or(0.0),
            rests: summary.get("rest").is_some_and(Value::is_number),
        }
    }

    /// Whether it has nothing left to do before a time, s.
    #[must_use]
    pub fn is_done_at(&self, end: f64) -> bool {
        self.status == "done" && (self.rests || self.time >= end * (1.0 - 1e-9))
    }

    /// Whether it failed because results could not be written: then the same steps may succeed.
    #[must_use]
    pub fn is_for_want_of_room(&self) -> bool {
        self.status == "failed" && self.error.as_ref().is_some_and(|error| error.starts_with("E07"))
    }
}

impl Earlier {
    /// What is in a folder; `None`: there are no results. Damaged files count as missing.
    ///
    /// # Errors
    /// What the system says.
    pub fn read(folder: &Path) -> Result<Option<Self>, ResultsError> {
        let Some(found) = ResultFolder::found(folder)? else { return Ok(None) };
        let ran = Provenance::read(folder).ok().flatten();
        let summary: Option<Value> = read_json(&folder.join("summary.json")).ok().flatten();
        let generations = checkpoint::generations(folder);
        let of_summary = summary.as_ref().and_then(|summary| summary.get("wall_seconds")?.as_f64());
        let of_state = || generations.iter().find_map(|generation| checkpoint::seconds(&generation.path));
        Ok(Some(Self {
            found,
            ran,
            end: summary.as_ref().map(End::of),
            has_checkpoint: !generations.is_empty(),
            seconds: of_summary.or_else(of_state).unwrap_or(0.0),
        }))
    }

    /// Time that the history of a folder has reached, s.
    #[must_use]
    pub fn time_reached(folder: &Path) -> Option<f64> {
        History::read(folder).ok()??.column("time")?.last().copied()
    }
}
