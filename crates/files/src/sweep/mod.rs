//! Sweeps: one model with many values, one run for each combination, one table of what came out.
//!
//! The walk: which runs (`plan.rs`, `values.rs`) -> a sound model for each of them (`prepare.rs`) -> what is
//! noted (`outputs.rs`) -> runs, one on each thread (`run.rs`) -> a journal that outlives the program
//! (`journal.rs`) -> table and plot (`table.rs`). The program's command `sweep` asks and reports. Fits
//! (`fit/`) search by such runs for values that follow what was measured.

pub mod fit;
pub(crate) mod messages;
mod journal;
mod outputs;
mod plan;
mod prepare;
mod run;
mod table;
mod values;

pub use journal::RunEnd;
pub use plan::Request;
pub use prepare::Sweep;
pub use run::{Advance, Ended, Running};

use crate::model_file::Diagnostics;
use crate::picture::PictureError;
use crate::results::ResultsError;
use crate::results::messages::REFUSED;
use embate_solver::message::Message;
use messages::{BUSY, FIRST_RUN, OTHER, TABLE};
use std::path::PathBuf;
use thiserror::Error;

/// What is wrong, and what to do.
type Wrong = (String, String);

/// Name of the table in the folder of a sweep.
pub const TABLE_NAME: &str = "sweep.csv";
/// Name of the plot in the folder of a sweep.
pub const PLOT_NAME: &str = "sweep.svg";

/// What is kept of each run besides its row in the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Keep {
    /// Nothing: no folders.
    Rows,
    /// History and summary.
    Figures,
    /// Everything that `embate run` writes.
    Frames,
}

/// Why a sweep can't be made or went no further; a run that fails is no such thing, but a row of the table.
#[derive(Debug, Error)]
pub enum SweepError {
    /// The model, a value or an output is faulty.
    #[error("{0}")]
    Model(Diagnostics),
    /// The table of runs can't be read.
    #[error("can't read {}: {source}", .path.display())]
    Table {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The folder holds another sweep.
    #[error("{} holds another sweep: {difference}; choose another folder with --out, or start again with --force", .path.display())]
    Other {
        /// The folder.
        path: PathBuf,
        /// In what it differs.
        difference: String,
    },
    /// A key with its bounds, or what was measured, can't be read.
    #[error("{text}")]
    Asked {
        /// Which of both.
        kind: &'static Message,
        /// What is wrong, and what to do.
        text: String,
    },
    /// The first run of a fit fails.
    #[error("with the first values the model fails: {0}; give a first value between the bounds with which it runs, LOWEST:FIRST:HIGHEST")]
    FirstRun(String),
    /// Another program is at it.
    #[error("another sweep is writing into {}; wait for its end, or choose another folder with --out", .path.display())]
    Busy {
        /// The folder.
        path: PathBuf,
    },
    /// Results can't be written while a run continues.
    #[error("{0}")]
    Output(String),
    /// Results can't be written.
    #[error(transparent)]
    Results(#[from] ResultsError),
    /// The plot can't be written.
    #[error(transparent)]
    Plot(#[from] PictureError),
}

impl SweepError {
    /// Its kind; `None` for a model, whose faults are of many.
    #[must_use]
    pub fn kind(&self) -> Option<&'static Message> {
        match self {
            Self::Model(_) => None,
            Self::Table { .. } => Some(&TABLE),
            Self::Asked { kind, .. } => Some(kind),
            Self::FirstRun(_) => Some(&FIRST_RUN),
            Self::Other { .. } => Some(&OTHER),
            Self::Busy { .. } => Some(&BUSY),
            Self::Output(_) => Some(&REFUSED),
            Self::Results(error) => Some(error.kind()),
            Self::Plot(error) => Some(error.kind()),
        }
    }
}
