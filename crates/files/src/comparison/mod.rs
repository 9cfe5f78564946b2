//! Two runs held against each other by what they left: where their logs part, and where they part when both
//! are gone over once more.
//!
//! [`RunLeft`] reads a folder of results, [`Window`] finds the stretch of steps in which two of them part;
//! `again` steps both side by side through it. Texts are made by the program.

mod again;

pub use again::{Again, Found, in_step};

use crate::checkpoint::{Checkpoint, Identity, Origin, newest};
use crate::program;
use crate::results::{HashTable, Provenance, ResultsError, read_json};
use crate::threads::Threads;
use embate_solver::hashes::Hashes;
use serde::Deserialize;
use std::path::{Path, PathBuf};

/// What a run left.
#[derive(Clone, Debug)]
pub struct RunLeft {
    /// Its folder.
    pub folder: PathBuf,
    /// Where its model came from, and what it was; `None`: nothing reports.
    pub model: Option<(Origin, Identity)>,
    /// Version of the program that ran it, with its commit, if that is known.
    pub version: Option<String>,
    /// How it ended; `None`: it has not, or was killed.
    pub end: Option<End>,
    /// Hashes of its states.
    pub hashes: Option<HashTable>,
}

/// The figures of `summary.json` that say what a run was and how it ended.
#[derive(Clone, Debug, Deserialize)]
pub struct End {
    /// `done`, `stopped` or `failed`.
    pub status: String,
    /// Version of the program.
    version: String,
    /// Commit that the program was built from.
    #[serde(default)]
    commit: Option<String>,
    /// Threads that it had.
    pub threads: usize,
    /// Its instruction set.
    pub simd: String,
    /// Steps done.
    pub steps: u64,
    /// Time reached, s.
    pub time_end: f64,
    /// Hash of the last state.
    pub state_hash: String,
}

impl RunLeft {
    /// What lies in a folder of results; `None`: nothing by which a run could be known.
    ///
    /// # Errors
    /// Files that are damaged or can't be read.
    pub fn read(folder: &Path) -> Result<Option<Self>, ResultsError> {
        let (provenance, end, hashes) =
            (Provenance::read(folder)?, read_json::<End>(&folder.join("summary.json"))?, HashTable::read(folder)?);
        if end.is_none() && hashes.is_none() {
            return Ok(None);
        }
        let version = provenance.as_ref().map(|provenance| program::named(&provenance.version, provenance.commit.as_deref()));
        let version = version.or_else(|| end.as_ref().map(|end| program::named(&end.version, end.commit.as_deref())));
        let of_checkpoint = |checkpoint: Checkpoint| (checkpoint.origin, checkpoint.identity);
        let model = match provenance {
            Some(provenance) => Some((provenance.origin(), provenance.keys)),
            None => newest(folder, &Threads::one(), |_| true).ok().map(|(checkpoint, _)| of_checkpoint(checkpoint)),
        };
        Ok(Some(Self { folder: folder.into(), model, version, end, hashes }))
    }

    /// The last step that it is known to have done.
    #[must_use]
    pub fn last_step(&self) -> u64 {
        let line = self.hashes.as_ref().and_then(|table| table.lines.last_key_value()).map_or(0, |(&step, _)| step);
        self.end.as_ref().map_or(line, |end| end.steps)
    }

    /// What its log says of a step, if anything.
    #[must_use]
    pub fn hashes_at(&self, step: u64) -> Option<&Hashes> {
        self.hashes.as_ref()?.lines.get(&step)
    }
}

/// The stretch in which two runs diverge, by what they left.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Window {
    /// Steps that both logs have, from the first until they part.
    pub compared: usize,
    /// The last of them at which all is the same.
    pub same: Option<u64>,
    /// The first of them at which something differs.
    pub differs: Option<u64>,
    /// What differs there.
    pub what: Vec<String>,
}

impl Window {
    /// Holds two logs against each other.
    #[must_use]
    pub fn of(a: &HashTable, b: &HashTable) -> Self {
        let mut window = Self::default();
        for (&step, left) in &a.lines {
            let Some(right) = b.lines.get(&step) else { continue };
            window.compared += 1;
            window.what = apart([(a, left), (b, right)]);
            if !window.what.is_empty() {
                window.differs = Some(step);
                break;
            }
            window.same = Some(step);
        }
        window
    }
}

/// What of two lines is not the same, of what both have.
fn apart([(a, left), (b, right)]: [(&HashTable, &Hashes); 2]) -> Vec<String> {
    let mut what = Vec::new();
    let mut report = |name: &str, differs: bool| what.extend(differs.then(|| name.to_string()));
    report("the time", left.time.to_bits() != right.time.to_bits());
    report("the time step", left.time_step.to_bits() != right.time_step.to_bits());
    for (name, hash) in a.parts.iter().zip(&left.parts) {
        let other = b.parts.iter().position(|other| other == name).map(|at| right.parts[at]);
        report(&format!("part \"{name}\""), other.is_some_and(|other| other != *hash));
    }
    report("contacts", left.contacts != right.contacts);
    report("rigid bodies", left.bodies != right.bodies);
    what
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(parts: &[&str], lines: &[(u64, &[u64])]) -> HashTable {
        let line = |&(step, parts): &(u64, &[u64])| (step, Hashes { step, parts: parts.to_vec(), ..Hashes::default() });
        HashTable { parts: parts.iter().map(ToString::to_string).collect(), lines: lines.iter().map(line).collect() }
    }

    #[test]
    fn logs_with_other_steps_and_parts_are_compared_where_both_have_them() {
        let a = table(&["p", "q"], &[(0, &[1, 2]), (10, &[3, 4]), (20, &[5, 6]), (30, &[7, 8])]);
        let b = table(&["q", "new"], &[(0, &[2, 0]), (20, &[6, 0]), (30, &[9, 0]), (40, &[9, 0])]);
        let window = Window::of(&a, &b);
        assert_eq!(window, Window { compared: 3, same: Some(20), differs: Some(30), what: vec!["part \"q\"".into()] });
        assert_eq!(Window::of(&a, &a), Window { compared: 4, same: Some(30), ..Window::default() });
        assert_eq!(Window::of(&a, &HashTable::default()), Window::default());
        let shorter = table(&["p", "q"], &[(0, &[1, 2]), (10, &[3, 4])]);
        assert_eq!(Window::of(&shorter, &a).same, Some(10));
        assert_eq!(Window::of(&shorter, &table(&["p", "q"], &[(0, &[1, 3])])).same, None);
    }
}
