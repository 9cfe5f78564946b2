//! `history.csv`: one line of column names, then one line per history row.
//!
//! Rows come from the simulation through the recorder, and go to the file by way of [`Lines`].

use super::ResultsError;
use super::atomic::Mark;
use super::lines::Lines;
use std::fmt::Write as _;
use std::path::Path;

/// A table that is written row by row.
#[derive(Debug)]
pub(super) struct CsvStream {
    lines: Lines,
    columns: usize,
}

impl CsvStream {
    /// Starts the table `path` with its line of names.
    pub(super) fn create(path: &Path, columns: &[String]) -> Result<Self, ResultsError> {
        let mut names = String::new();
        for (index, name) in columns.iter().enumerate() {
            if index > 0 {
                names.push(',');
            }
            append_text(&mut names, name);
        }
        names.push('\n');
        Ok(Self { lines: Lines::create(path, names)?, columns: columns.len() })
    }

    /// Continues with the table `path` from where it was marked. With it come the rows that are there.
    pub(super) fn reopen(path: &Path, columns: &[String], mark: Mark) -> Result<(Self, Vec<Vec<f64>>), ResultsError> {
        let (lines, bytes) = Lines::reopen(path, mark)?;
        let text = String::from_utf8_lossy(&bytes);
        let row = |line: &str| -> Option<Vec<f64>> { line.split(',').map(|value| value.parse().ok()).collect() };
        let rows: Option<Vec<Vec<f64>>> = text.lines().skip(1).map(row).collect();
        match rows.filter(|rows| rows.iter().all(|row| row.len() == columns.len())) {
            Some(rows) => Ok((Self { lines, columns: columns.len() }, rows)),
            None => Err(ResultsError::Changed { path: path.into(), what: "its rows have other columns".into() }),
        }
    }

    /// How far it is, once that is on the disk.
    pub(super) fn mark(&mut self) -> Result<Mark, ResultsError> {
        self.lines.mark()
    }

    /// Adds a row: one value per column.
    pub(super) fn row(&mut self, values: &[f64]) -> Result<(), ResultsError> {
        if values.len() != self.columns {
            return Err(ResultsError::RowLength { found: values.len(), expected: self.columns });
        }
        self.lines.line(|text| {
            for (index, &value) in values.iter().enumerate() {
                if index > 0 {
                    text.push(',');
                }
                append_number(text, value);
            }
            text.push('\n');
        })
    }

    /// Writes what was collected.
    pub(super) fn flush(&mut self) -> Result<(), ResultsError> {
        self.lines.flush()
    }

    /// Writes the rest and gives the table its final name, even when the rest can't be written.
    pub(super) fn finish(self) -> Result<(), ResultsError> {
        self.lines.finish()
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
