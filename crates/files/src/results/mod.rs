//! The result folder of a run: which files lie in it, how they get there, and who writes them.
//!
//! A [`Recorder`] listens to a simulation and hands frames and rows over (`writer_channel`, `queue`) to the
//! writer, which fills a [`ResultFolder`] while the run continues: `history.csv` row by row, `hashes.csv`
//! likewise, `fields/frame-*.vtu` and `fields.pvd`, the pictures, and last of all `summary.json`. Every file
//! is written as `NAME.part` and renamed when it is complete, so a file under its final name is never
//! half-written, whatever happens to the run or the machine.

mod atomic;
mod channels;
mod checkpoints;
mod csv;
mod figures;
mod folder;
mod hashes;
mod history;
pub mod messages;
mod writer_channel;
mod lines;
mod lock;
mod queue;
mod provenance;
mod recorder;
mod report;
mod decimated;
mod earlier;
mod reported;
mod writer;

pub(crate) use atomic::part_path;
pub use atomic::write_whole;
pub(crate) use atomic::write_whole_by;
pub use checkpoints::{Checkpoints, Pause};
pub(crate) use csv::{append_number, append_text};
pub use decimated::ThinnedRows;
pub use earlier::{Earlier, End};
pub(crate) use figures::{read_figures, write_figures};
pub use folder::ResultFolder;
pub use hashes::HashTable;
pub use history::{History, unit};
pub(crate) use lock::FolderLock;
pub(crate) use provenance::read_json;
pub use provenance::{Appearance, PartMade, Provenance, Seen};
pub use recorder::{OnProgress, Outcome, Recorder};
pub use report::{MomentumDrift, Report, RunStatus, Stage};
pub use reported::Reported;
pub use writer::film_settings;

use crate::checkpoint::CheckpointError;
use crate::checkpoint::messages::{IN_USE, RESULTS_CHANGED};
use crate::plain;
use crate::vtu::VtuError;
use embate_solver::message::Message;
use messages::{BUG, DAMAGED_LOG, EXISTS, FRAME, NO_RUN, NOT_A_FOLDER, NOTHING_TO_SEE, RENUMBERED, UNREADABLE};
use std::io::ErrorKind;
use std::path::PathBuf;
use thiserror::Error;

/// Name of the table of hashes.
const HASHES: &str = "hashes.csv";

/// Why results can't be written: what, where, and what to do.
#[derive(Debug, Error)]
pub enum ResultsError {
    /// The folder holds results of another run.
    #[error("{} already holds results ({found}); choose another folder with --out, or replace them with --force", .path.display())]
    Exists {
        /// The folder.
        path: PathBuf,
        /// What was found in it.
        found: String,
    },
    /// The path leads to something that is not a folder.
    #[error("{} is not a folder; choose another place for the results with --out", .path.display())]
    NotAFolder {
        /// The path.
        path: PathBuf,
    },
    /// The system refused.
    #[error("can't {action} {}: {source}{}", .path.display(), remedy(.source.kind()))]
    File {
        /// What was tried: `write`, `rename` ...
        action: &'static str,
        /// On which path.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A file is not what a checkpoint knows of it.
    #[error("{} is not as the checkpoint knows it: {what}; put it back as it was, or run the model again", .path.display())]
    Changed {
        /// The file.
        path: PathBuf,
        /// What is not.
        what: String,
    },
    /// A file that says what a run was has changed since.
    #[error("{}, line {line}: {what}; put the file back from a copy, or run the model again", .path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// Its line, from 1.
        line: usize,
        /// What gave it away.
        what: String,
    },
    /// A field file that can't be read.
    #[error("{} can't be read: {what}; put the file back from a copy, or run the model again", .path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        what: String,
    },
    /// Nodes and cells have other numbers in some frames.
    #[error("{} has other nodes and elements since elements were made again: a number is not the same one in all frames; give the model a [[probe]] at a point", .path.display())]
    Renumbered {
        /// The folder.
        path: PathBuf,
    },
    /// A folder without anything to look at.
    #[error("{} can't be shown: {what}; give the folder that `embate run` wrote, the one with fields.pvd", .path.display())]
    NothingToSee {
        /// The folder.
        path: PathBuf,
        /// What it is instead.
        what: String,
    },
    /// A folder that holds nothing of a run.
    #[error("{} holds no results of embate (no summary.json, run.json or history.csv); give the folder that `embate \
        run` wrote", .path.display())]
    NoRun {
        /// The folder.
        path: PathBuf,
    },
    /// Another run writes into a folder, or to a file.
    #[error("another run writes to {}; wait for it, or stop it first", .path.display())]
    InUse {
        /// The folder or the file.
        path: PathBuf,
    },
    /// A checkpoint that can't be written.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
    /// A frame that can't be written.
    #[error(transparent)]
    Frame(#[from] VtuError),
    /// The writer panicked.
    #[error("writing results panicked: {message}; this is a bug in embate")]
    Panic {
        /// What it said.
        message: String,
    },
    /// A history row that does not fit its columns.
    #[error("a history row has {found} values for {expected} columns; this is a bug in embate")]
    RowLength {
        /// Values of the row.
        found: usize,
        /// Columns of the history.
        expected: usize,
    },
}

impl ResultsError {
    /// Its kind.
    #[must_use]
    pub fn kind(&self) -> &'static Message {
        match self {
            Self::Exists { .. } => &EXISTS,
            Self::NotAFolder { .. } => &NOT_A_FOLDER,
            Self::File { source, .. } => plain::kind(source),
            Self::Changed { .. } => &RESULTS_CHANGED,
            Self::Damaged { .. } => &DAMAGED_LOG,
            Self::Unreadable { .. } => &UNREADABLE,
            Self::Renumbered { .. } => &RENUMBERED,
            Self::NothingToSee { .. } => &NOTHING_TO_SEE,
            Self::NoRun { .. } => &NO_RUN,
            Self::InUse { .. } => &IN_USE,
            Self::Checkpoint(error) => error.kind(),
            Self::Frame(_) => &FRAME,
            Self::Panic { .. } | Self::RowLength { .. } => &BUG,
        }
    }

    pub(crate) fn file(action: &'static str, path: impl Into<PathBuf>) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.into();
        move |source| Self::File { action, path, source }
    }
}

/// What a person can do about an error of the system; empty where its own text says it all.
pub(crate) fn remedy(kind: ErrorKind) -> &'static str {
    match kind {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => "; free some space, or choose a folder on another disk with --out",
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => "; choose a folder that you may write to with --out",
        ErrorKind::NotADirectory => "; a part of the path is a file, choose another folder with --out",
        _ => "",
    }
}
