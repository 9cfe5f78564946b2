//! The post-mortem of a run that failed: `post-mortem/` in its result folder, a page and its pictures.
//!
//! The failed simulation and what the second pass saw (`again.rs`) come from the solver; `advice.rs` says
//! which keys to change, `page.rs` writes the text, `plots.rs` chooses curves, and [`crate::picture`] draws.
//! Failures at the start, before there is a simulation, are in `start.rs`.

mod advice;
mod again;
mod page;
mod plots;
mod start;

pub use again::Findings;
pub(crate) use page::shown;
pub use start::at_start;

use crate::model_file::Loaded;
use crate::plain;
use crate::results::{ResultsError, part_path, write_whole};
use embate_solver::error::Error;
use embate_solver::model::Model;
use embate_solver::simulation::{Options, Simulation};
use std::fs;
use std::path::{Path, PathBuf};

/// Folder of the page in that of the results.
pub const FOLDER: &str = "post-mortem";
/// The page, relative to the results.
pub const PAGE: &str = "post-mortem/README.md";
/// Files in the folder; the page comes last.
const FILES: &[&str] = &["place.svg", "neighbourhood.svg", "failure-location.svg", "energies.svg", "mass.svg", "README.md"];

/// A run that has failed.
pub struct Failed<'a> {
    /// Its model, as it ran.
    pub model: &'a Model,
    /// The file that the model came from.
    pub loaded: &'a Loaded,
    /// How it was run.
    pub options: &'a Options,
    /// The simulation, where it failed.
    pub simulation: &'a Simulation,
    /// Why it failed.
    pub error: &'a Error,
    /// Result folder with its checkpoints, if it has any.
    pub checkpoints: &'a Path,
    /// Whether the state of the last good step is wanted.
    pub keeps_last_good: bool,
    /// Whether the program that drove the run has changed it on the way: then it can't go there once more.
    pub is_steered: bool,
}

impl Failed<'_> {
    /// Writes page and pictures into a result folder; an older page goes. Returns the path of the page.
    ///
    /// # Errors
    /// What the system says; then nothing is left of them.
    pub fn write(&self, findings: &Findings, results: &Path) -> Result<PathBuf, ResultsError> {
        write(results, &page::of_run(self, findings))
    }
}

/// Files by their names, the page last.
type Files = Vec<(&'static str, String)>;

/// Writes the files beside their place, and moves them there when all are complete.
fn write(results: &Path, files: &Files) -> Result<PathBuf, ResultsError> {
    remove(results)?;
    fs::create_dir_all(results).map_err(ResultsError::file("create", results))?;
    let (folder, side) = (results.join(FOLDER), part_path(&results.join(FOLDER)));
    let written = files.iter().try_for_each(|(name, text)| {
        plain::folder(&side).map_err(ResultsError::file("create", &side))?;
        write_whole(&side.join(name), text.as_bytes())
    });
    let moved = written.and_then(|()| plain::folder(&folder).map_err(ResultsError::file("create", &folder))).and_then(|()| {
        files.iter().try_for_each(|(name, _)| {
            fs::rename(side.join(name), folder.join(name)).map_err(ResultsError::file("write", folder.join(name)))
        })
    });
    if moved.is_err() {
        // The first error is the one that matters.
        let _ = remove(results);
    } else {
        let _ = fs::remove_dir(&side);
    }
    moved.map(|()| results.join(PAGE))
}

/// Takes the post-mortem of an earlier run away; what embate has not made stays.
///
/// # Errors
/// What the system says.
pub(crate) fn remove(results: &Path) -> Result<(), ResultsError> {
    for folder in [results.join(FOLDER), part_path(&results.join(FOLDER))] {
        if !plain::is_folder(&folder).map_err(ResultsError::file("write into", &folder))? {
            continue;
        }
        let is_there = |file: &PathBuf| fs::symlink_metadata(file).is_ok_and(|data| !data.is_dir());
        for file in FILES.iter().flat_map(|name| [folder.join(name), part_path(&folder.join(name))]).filter(is_there) {
            fs::remove_file(&file).map_err(ResultsError::file("remove", &file))?;
        }
        // Stays if something foreign lies in it.
        let _ = fs::remove_dir(folder);
    }
    Ok(())
}
