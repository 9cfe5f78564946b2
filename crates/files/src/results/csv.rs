//! `history.csv`: one line of column names, then one line per history row.
//!
//! Rows come from the simulation through the recorder; they are collected and written in pieces of whole lines, so that the
//! growing `history.csv.part` can be followed while a run goes on.

use super::ResultsError;
use super::atomic::{Mark, PartFile};
use std::fmt::Write as _;
use std::path::Path;

/// Bytes that are collected before they are written.
const PIECE: usize = 1 << 16;

/// A table that is written row by row.
#[derive(Debug)]
pub(super) struct CsvStream {
    file: PartFile,
    columns: usize,
    pending: String,
}

impl CsvStream {
    /// Starts the table `path` with its line of names.
    pub(super) fn create(path: &Path, columns: &[String]) -> Result<Self, ResultsError> {
        let mut pending = String::new();
        for (index, name) in columns.iter().enumerate() {
            if index > 0 {
                pending.push(',');
            }
            append_text(&mut pending, name);
        }
        pending.push('\n');
        let mut table = Self { file: PartFile::create(path)?, columns: columns.len(), pending };
        table.flush()?;
        Ok(table)
    }

    /// Goes on with the table `path` from where it was marked. With it come the rows that are there.
    pub(super) fn reopen(path: &Path, columns: &[String], mark: Mark) -> Result<(Self, Vec<Vec<f64>>), ResultsError> {
        let (file, bytes) = PartFile::reopen(path, mark)?;
        let text = String::from_utf8_lossy(&bytes);
        let row = |line: &str| -> Option<Vec<f64>> { line.split(',').map(|value| value.parse().ok()).collect() };
        let rows: Option<Vec<Vec<f64>>> = text.lines().skip(1).map(row).collect();
        match rows.filter(|rows| rows.iter().all(|row| row.len() == columns.len())) {
            Some(rows) => Ok((Self { file, columns: columns.len(), pending: String::new() }, rows)),
            None => Err(ResultsError::Changed { path: path.into(), what: "its rows have other columns".into() }),
        }
    }

    /// How far it is, once that is on the disk.
    pub(super) fn mark(&mut self) -> Result<Mark, ResultsError> {
        self.flush()?;
        self.file.mark()
    }

    /// Adds a row: one value per column.
    pub(super) fn row(&mut self, values: &[f64]) -> Result<(), ResultsError> {
        if values.len() != self.columns {
            return Err(ResultsError::RowLength { found: values.len(), expected: self.columns });
        }
        for (index, &value) in values.iter().enumerate() {
            if index > 0 {
                self.pending.push(',');
            }
            append_number(&mut self.pending, value);
        }
        self.pending.push('\n');
        if self.pending.len() >= PIECE { self.flush() } else { Ok(()) }
    }

    /// Writes what was collected.
    pub(super) fn flush(&mut self) -> Result<(), ResultsError> {
        let written = self.file.append(self.pending.as_bytes());
        self.pending.clear();
        written
    }

    /// Writes the rest and gives the table its final name, even when the rest can't be written.
    pub(super) fn finish(mut self) -> Result<(), ResultsError> {
        let written = self.flush();
        self.file.finish()?;
        written
    }
}

/// The shortest decimal that reads back as the same number, with an exponent where it would get long.
pub(crate) fn append_number(text: &mut String, value: f64) {
    let size = value.abs();
    // Writing to a string can't fail.
    let _ =
        if size == 0.0 || !value.is_finite() || (1e-4..1e15).contains(&size) { write!(text, "{value}") } else { write!(text, "{value:e}") };
}

/// A name, in quotes where it would break the line apart.
pub(crate) fn append_text(text: &mut String, name: &str) {
    if name.contains([',', '"', '\n', '\r']) {
        text.push('"');
        text.push_str(&name.replace('"', "\"\""));
        text.push('"');
    } else {
        text.push_str(name);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(value: f64) -> String {
        let mut text = String::new();
        append_number(&mut text, value);
        text
    }

    #[test]
    fn numbers_are_short_and_read_back_the_same() {
        assert_eq!(number(0.0), "0");
        assert_eq!(number(-50.0), "-50");
        assert_eq!(number(0.1), "0.1");
        assert_eq!(number(1.25e-7), "1.25e-7");
        assert_eq!(number(f64::NAN), "NaN");
        for value in [1.0 / 3.0, -2e-300, 6.02e23, f64::MIN_POSITIVE, f64::MAX, 123_456_789.123_456_78, 5e-324] {
            assert_eq!(number(value).parse::<f64>().unwrap().to_bits(), value.to_bits());
        }
    }

    #[test]
    fn names_with_commas_are_quoted() {
        let mut text = String::new();
        append_text(&mut text, "energy.kinetic[a, \"b\"]");
        assert_eq!(text, "\"energy.kinetic[a, \"\"b\"\"]\"");
    }
}
