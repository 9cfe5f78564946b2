//! A table that grows by whole lines and is written in pieces: what `history.csv` and `hashes.csv` share.
//!
//! Lines come from the tables; the growing `.part` file can be followed while a run continues.

use super::ResultsError;
use super::atomic::{Mark, PartFile};
use std::path::Path;

/// Bytes that are collected before they are written.
const PIECE: usize = 1 << 16;

/// The lines of a table.
#[derive(Debug)]
pub(super) struct Lines {
    file: PartFile,
    pending: String,
}

impl Lines {
    /// Starts the table `path` with what is its first line, and writes that at once.
    pub(super) fn create(path: &Path, first: String) -> Result<Self, ResultsError> {
        let mut lines = Self { file: PartFile::create(path)?, pending: first };
        lines.flush()?;
        Ok(lines)
    }

    /// Continues with the table `path` from where it was marked. With it come the bytes that are there.
    pub(super) fn reopen(path: &Path, mark: Mark) -> Result<(Self, Vec<u8>), ResultsError> {
        let (file, bytes) = PartFile::reopen(path, mark)?;
        Ok((Self { file, pending: String::new() }, bytes))
    }

    /// How far it is, once that is on the disk.
    pub(super) fn mark(&mut self) -> Result<Mark, ResultsError> {
        self.flush()?;
        self.file.mark()
    }

    /// Adds what `write` appends: a whole line.
    pub(super) fn line(&mut self, write: impl FnOnce(&mut String)) -> Result<(), ResultsError> {
        write(&mut self.pending);
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
