//! What a sweep has done, kept so that it outlives the program: `sweep.json` says which runs there are,
//! `sweep.journal` gets a line for each that has ended.
//!
//! Lines come from `run.rs`; a program that starts again finds them here and leaves those runs out.
//! `sweep.json` is written whole before the first run. A sweep with more runs takes over those that it has. A
//! line of the journal counts only with its end, so what was cut off by the end of a program or a machine is
//! a run that has to be done again.

use super::{Keep, SweepError};
use crate::plain;
use crate::results::{ResultsError, write_whole};
use serde::{Deserialize, Serialize};
use std::collections::{HashMap, VecDeque};
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::Write;
use std::path::{Path, PathBuf};

const MANIFEST_NAME: &str = "sweep.json";
const JOURNAL_NAME: &str = "sweep.journal";

/// Which runs a folder is for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Manifest {
    /// Version of the program.
    pub(super) version: String,
    pub(super) model: String,
    pub(super) keep: Keep,
    /// Paths of what varies.
    pub(super) inputs: Vec<String>,
    pub(super) outputs: Vec<String>,
    /// Hash of each run's model.
    pub(super) runs: Vec<String>,
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RunEnd {
    /// It reached its end.
    Done,
    /// It reached `run.max_steps` before its end.
    Stopped,
    /// It ended with an error.
    Failed,
}

impl RunEnd {
    /// Its name in the table.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Done => "done",
            Self::Stopped => "stopped",
            Self::Failed => "failed",
        }
    }
}

/// A run that has ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Entry {
    /// Its number from 0.
    pub(super) run: usize,
    pub(super) end: RunEnd,
    /// Why it failed; empty where it did not.
    pub(super) error: String,
    /// Outputs as the table has them.
    pub(super) cells: Vec<String>,
}

/// The journal of a sweep that continues; the folder is this program's as long as it lives.
#[derive(Debug)]
pub(super) struct Journal {
    path: PathBuf,
    file: File,
}

impl Journal {
    /// Opens the folder: a new one, or one with the same sweep, whose ended runs are given back. With `force`
    /// what another sweep has noted is forgotten.
    ///
    /// # Errors
    /// [`SweepError::Other`] where the folder holds another sweep, [`SweepError::Busy`], or what the system
    /// says.
    pub(super) fn open(folder: &Path, manifest: &Manifest, force: bool) -> Result<(Self, Option<Manifest>, Vec<Entry>), SweepError> {
        fs::create_dir_all(folder).map_err(ResultsError::file("create", folder))?;
        let path = folder.join(JOURNAL_NAME);
        let file = plain::reopen_or_create(&path, OpenOptions::new().read(true).append(true)).map_err(ResultsError::file("open", &path))?;
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => return Err(SweepError::Busy { path: folder.to_path_buf() }),
            // A file system without locks: two programs in one folder are the user's care.
            Err(TryLockError::Error(_)) | Ok(()) => {}
        }
        let journal = Self { path, file };
        let before = plain::read_to_string(&folder.join(MANIFEST_NAME)).ok().and_then(|text| serde_json::from_str::<Manifest>(&text).ok());
        let difference = before.as_ref().and_then(|before| before.difference(manifest));
        if let Some(difference) = difference.filter(|_| !force) {
            return Err(SweepError::Other { path: folder.to_path_buf(), difference });
        }
        let entries = if before.is_none() || force { Vec::new() } else { journal.entries()? };
        Ok((journal, before.filter(|_| !force), entries))
    }

    /// Lines that are complete.
    fn entries(&self) -> Result<Vec<Entry>, SweepError> {
        let text = plain::read(&self.path).map_err(ResultsError::file("read", &self.path))?;
        let lines = text.split_inclusive(|byte| *byte == b'\n').filter(|line| line.ends_with(b"\n"));
        Ok(lines.filter_map(|line| serde_json::from_slice(line).ok()).collect())
    }

    /// Starts with these runs: `sweep.json` and the journal hold them and nothing else.
    pub(super) fn start(&mut self, folder: &Path, manifest: &Manifest, entries: &[Entry]) -> Result<(), SweepError> {
        let written = |source| SweepError::from(ResultsError::file("write", &self.path)(source));
        // First the journal: runs of another sweep must not be taken for those of this one.
        self.file.set_len(0).map_err(written)?;
        let text = json(manifest, true);
        write_whole(&folder.join(MANIFEST_NAME), text.as_bytes())?;
        let lines: String = entries.iter().map(|entry| json(entry, false)).collect();
        self.file.write_all(lines.as_bytes()).map_err(|source| ResultsError::file("write", &self.path)(source).into())
    }

    /// Forgets all runs that are noted: before their folders change.
    pub(super) fn clear(&mut self) -> Result<(), SweepError> {
        self.file.set_len(0).map_err(|source| ResultsError::file("write", &self.path)(source).into())
    }

    /// Notes a run.
    pub(super) fn note(&mut self, entry: &Entry) -> Result<(), SweepError> {
        self.file.write_all(json(entry, false).as_bytes()).map_err(|source| ResultsError::file("write", &self.path)(source).into())
    }
}

fn json<T: Serialize>(value: &T, pretty: bool) -> String {
    let text = if pretty { serde_json::to_string_pretty(value) } else { serde_json::to_string(value) };
    text.expect("plain numbers, texts and lists always have a JSON form") + "\n"
}

impl Manifest {
    /// The number that each of its runs has in another sweep; `None`: it is not there.
    pub(super) fn places(&self, now: &Self) -> Vec<Option<usize>> {
        let mut all: HashMap<&str, VecDeque<usize>> = HashMap::new();
        now.runs.iter().zip(0..).for_each(|(run, number)| all.entry(run).or_default().push_back(number));
        self.runs.iter().map(|run| all.get_mut(run.as_str())?.pop_front()).collect()
    }

    /// In what another sweep differs so that its runs are not those of this one; other outputs alone do not.
    fn difference(&self, now: &Self) -> Option<String> {
        if self.version != now.version {
            return Some(format!("it was made by embate {}, this is embate {}", self.version, now.version));
        }
        if self.model != now.model {
            return Some(format!("its model is `{}`, not `{}`", self.model, now.model));
        }
        if self.inputs != now.inputs {
            return Some(format!("there {} varies, here {}", self.inputs.join(", "), now.inputs.join(", ")));
        }
        // More runs, or another order, are no other sweep.
        let (all, gone) = (self.runs.len(), self.places(now).iter().filter(|place| place.is_none()).count());
        if gone > 0 && all == now.runs.len() {
            return Some(format!("the model or the values of {gone} of {all} runs have changed"));
        }
        if gone > 0 {
            return Some(format!("{gone} of its {all} runs are not among the {} that are wanted now", now.runs.len()));
        }
        if self.keep == Keep::Rows && (now.keep != Keep::Rows || self.outputs != now.outputs) {
            return Some("it kept no results from which other outputs could be taken (--summary-only)".to_string());
        }
        if self.keep == Keep::Figures && now.keep == Keep::Frames {
            return Some("it kept no frames".to_string());
        }
        None
    }
}
