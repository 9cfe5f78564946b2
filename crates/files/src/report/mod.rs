//! The report of a run: one HTML file with everything in it, good enough to send to a colleague
//! (`embate report`).
//!
//! What a run left is read here (`Left`), from `summary.json`, `run.json` and the history; `model.rs` says
//! what ran, `chosen.rs` that in the words of its file, `outcome.rs` how it ended and its figures,
//! `energies.rs` the ledger, `pictures.rs` puts pictures and plots in, `html.rs` has the frame of the page
//! and escapes all that comes from files.

mod chosen;
mod energies;
pub(crate) mod html;
mod model;
mod outcome;
mod pictures;

use crate::program;
use crate::results::{History, Provenance, ResultsError, part_path, read_json, write_whole};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// Name of the report in a result folder.
pub const REPORT: &str = "report.html";

/// What a run left.
struct Left {
    folder: PathBuf,
    /// Empty for a run that has not ended.
    summary: Option<Value>,
    /// When the summary was written.
    ended: Option<SystemTime>,
    ran: Option<Provenance>,
    /// Keys of the model with their values as `run.json` has them.
    keys: BTreeMap<String, String>,
    history: Option<History>,
    /// Whether energies and forces are those of whole bodies.
    is_of_whole_bodies: bool,
}

impl Left {
    fn read(folder: &Path) -> Result<Self, ResultsError> {
        if folder.exists() && !folder.is_dir() {
            return Err(ResultsError::NotAFolder { path: folder.into() });
        }
        let path = folder.join("summary.json");
        let summary: Option<Value> = read_json(&path)?;
        if summary.as_ref().is_some_and(|summary| !summary.is_object()) {
            return Err(ResultsError::Damaged { path, line: 1, what: "this is no summary of a run".into() });
        }
        let ran = Provenance::read(folder)?;
        let history = History::read(folder)?;
        if summary.is_none() && ran.is_none() && history.is_none() {
            return Err(ResultsError::NoRun { path: folder.into() });
        }
        let keys: BTreeMap<String, String> =
            ran.iter().flat_map(|ran| ran.keys.keys()).map(|(key, value)| (key.to_string(), value.to_string())).collect();
        let is_of_whole_bodies = model::is_of_whole_bodies(&keys, history.as_ref());
        let ended = fs::metadata(&path).and_then(|data| data.modified()).ok();
        Ok(Self { folder: folder.into(), summary, ended, ran, keys, history, is_of_whole_bodies })
    }

    /// A text of the summary.
    fn text(&self, key: &str) -> Option<&str> {
        self.summary.as_ref()?.get(key)?.as_str()
    }

    /// A number of the summary.
    fn number(&self, key: &str) -> Option<f64> {
        self.summary.as_ref()?.get(key)?.as_f64()
    }

    /// Title of the model; its name where it has none.
    fn title(&self) -> String {
        let title = self.ran.as_ref().map(|ran| ran.appearance.title.clone()).filter(|title| !title.is_empty());
        title.unwrap_or_else(|| self.name())
    }

    /// Name of the model; that of the folder where no file reports it.
    fn name(&self) -> String {
        let of_keys = || self.keys.get("name").map(|name| model::plain(name));
        let of_folder = || self.folder.file_name().map(|name| name.to_string_lossy().into_owned());
        self.text("model").map(ToString::to_string).or_else(of_keys).or_else(of_folder).unwrap_or_else(|| "run".into())
    }

    fn version(&self) -> String {
        let ran = self.ran.as_ref();
        let version = self.text("version").or_else(|| ran.map(|ran| ran.version.as_str())).unwrap_or("unknown");
        program::named(version, self.text("commit").or_else(|| ran.and_then(|ran| ran.commit.as_deref())))
    }

    /// Whether the history still grows, or grew when the run was cut off.
    fn grows(&self) -> bool {
        part_path(&self.folder.join("history.csv")).exists()
    }
}

/// The report of a result folder, finished, failed, stopped or not at its end yet, as the text of an HTML
/// file.
///
/// # Errors
/// [`ResultsError::NoRun`]: nothing of a run is there; [`ResultsError::Damaged`] with the line of a file that
/// can't be read; what the system says.
pub fn page(folder: &Path) -> Result<String, ResultsError> {
    let left = Left::read(folder)?;
    let sections = [
        outcome::head(&left),
        outcome::messages(&left),
        pictures::pictures(&left)?,
        model::section(&left),
        outcome::figures(&left),
        energies::section(&left),
        pictures::history(&left),
        outcome::made(&left),
    ];
    Ok(html::page(&format!("{} – report", left.title()), &sections.concat()))
}

/// Writes the report to `out`, whole or not at all, in place of an older one.
///
/// # Errors
/// Those of [`page`]; what the system says.
pub fn write(folder: &Path, out: &Path) -> Result<(), ResultsError> {
    write_whole(out, page(folder)?.as_bytes())
}
