//! Whole files or none: everything is written as `NAME.part` and renamed when it is complete.
//!
//! [`write_whole`] takes the bytes of a file at once, `write_whole_in_pieces` writes it from one end to the other; [`PartFile`] grows while a run goes on.

use super::ResultsError;
use std::ffi::OsString;
use std::fs::{self, File, OpenOptions};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

/// Bytes that are collected before they are written: below what allocators fetch from the system each time.
const PIECES: usize = 120 << 10;

/// `path` with `.part` behind it.
pub(super) fn part_path(path: &Path) -> PathBuf {
    let mut name = OsString::from(path);
    name.push(".part");
    PathBuf::from(name)
}

/// Writes a file in one go: all of `bytes` under the name `path`, or nothing; an older file of that name is replaced.
///
/// # Errors
/// [`ResultsError::File`]; no `.part` file is left behind.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), ResultsError> {
    write_whole_by(path, |part| fs::write(part, bytes))
}

/// The same piece by piece: `write` gets the file under its name until it is complete.
///
/// # Errors
/// [`ResultsError::File`]; no `.part` file is left behind.
pub(super) fn write_whole_in_pieces(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<File>) -> std::io::Result<()>,
) -> Result<(), ResultsError> {
    write_whole_by(path, |part| {
        let mut out = BufWriter::with_capacity(PIECES, File::create(part)?);
        write(&mut out)?;
        out.flush()
    })
}

fn write_whole_by(path: &Path, write: impl FnOnce(&Path) -> std::io::Result<()>) -> Result<(), ResultsError> {
    let part = part_path(path);
    let written = write(&part)
        .map_err(ResultsError::file("write", path))
        .and_then(|()| fs::rename(&part, path).map_err(ResultsError::file("write", path)));
    if written.is_err() {
        // The first error is the one that matters.
        let _ = fs::remove_file(&part);
    }
    written
}

/// A file that grows record by record and gets its name at the end. After a failed write it is cut back to the last whole record.
#[derive(Debug)]
pub(super) struct PartFile {
    path: PathBuf,
    file: File,
    length: u64,
}

impl PartFile {
    /// Starts `path` as `path.part`, which must not exist: two runs never write to one file.
    pub(super) fn create(path: &Path) -> Result<Self, ResultsError> {
        let part = part_path(path);
        let file = OpenOptions::new().write(true).create_new(true).open(&part).map_err(ResultsError::file("create", &part))?;
        Ok(Self { path: path.to_path_buf(), file, length: 0 })
    }

    /// Appends whole records.
    pub(super) fn append(&mut self, records: &[u8]) -> Result<(), ResultsError> {
        if let Err(source) = self.file.write_all(records) {
            // The first error is the one that matters.
            let _ = self.file.set_len(self.length);
            return Err(ResultsError::file("write", &self.path)(source));
        }
        self.length += records.len() as u64;
        Ok(())
    }

    /// Gives the file its final name.
    pub(super) fn finish(self) -> Result<(), ResultsError> {
        let Self { path, file, .. } = self;
        drop(file);
        fs::rename(part_path(&path), &path).map_err(ResultsError::file("write", &path))
    }
}
