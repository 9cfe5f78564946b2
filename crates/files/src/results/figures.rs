//! History and summary of a run that was kept in memory: for many short runs, whose frames and pictures
//! no one looks at.
//!
//! Rows come from `sweep`; the files are those of a [`Recorder`](super::Recorder) without frames.
//! [`read_figures`] reads them back.

use super::ResultsError;
use super::atomic::write_whole;
use super::csv::{append_number, append_text};
use super::report::Report;
use crate::plain;
use std::path::Path;

/// Writes `history.csv` and, last of all, `summary.json`; the folder must be there.
pub(crate) fn write_figures(folder: &Path, columns: &[String], rows: &[Vec<f64>], report: &Report) -> Result<(), ResultsError> {
    let mut text = String::with_capacity(16 * columns.len() * (rows.len() + 2));
    for (index, name) in columns.iter().enumerate() {
        text.push_str(if index > 0 { "," } else { "" });
        append_text(&mut text, name);
    }
    text.push('\n');
    for row in rows {
        for (index, value) in row.iter().enumerate() {
            text.push_str(if index > 0 { "," } else { "" });
            append_number(&mut text, *value);
        }
        text.push('\n');
    }
    write_whole(&folder.join("history.csv"), text.as_bytes())?;
    write_whole(&folder.join("summary.json"), report.json().as_bytes())
}

/// What the history holds, and the summary.
pub(crate) type Figures = (Vec<String>, Vec<Vec<f64>>, serde_json::Value);

/// Columns and rows of `history.csv`, and the contents of `summary.json`; `None` where they are not all
/// there.
pub(crate) fn read_figures(folder: &Path) -> Option<Figures> {
    let summary = serde_json::from_str(&plain::read_to_string(&folder.join("summary.json")).ok()?).ok()?;
    let history = plain::read_to_string(&folder.join("history.csv")).ok()?;
    let mut lines = history.lines();
    // Names of parts and contacts are plain, so no column stands in quotes.
    let columns: Vec<String> = lines.next()?.split(',').map(ToString::to_string).collect();
    let row = |line: &str| -> Option<Vec<f64>> { line.split(',').map(|value| value.parse().ok()).collect() };
    let rows: Vec<Vec<f64>> = lines.map(row).collect::<Option<_>>()?;
    rows.iter().all(|row| row.len() == columns.len()).then_some((columns, rows, summary))
}
