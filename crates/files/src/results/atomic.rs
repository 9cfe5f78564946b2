//! Whole files or none: everything is written as `NAME.part` and renamed when it is complete. This is the
//! only place where such files are made, and none is made through a link ([`plain`]).
//!
//! [`write_whole`] takes the bytes of a file at once, `write_whole_in_pieces` writes it from one end to the
//! other; [`PartFile`] grows while a run continues.

use super::ResultsError;
use crate::plain;
use flate2::Crc;
use serde::{Deserialize, Serialize};
use std::ffi::OsString;
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, ErrorKind, Read, Seek, Write};
use std::path::{Path, PathBuf};

/// Bytes that are collected before they are written: below what allocators fetch from the system each time.
const PIECES: usize = 120 << 10;

/// `path` with `.part` behind it.
pub(crate) fn part_path(path: &Path) -> PathBuf {
    let mut name = OsString::from(path);
    name.push(".part");
    PathBuf::from(name)
}

/// Writes a file in one go: all of `bytes` under the name `path`, or nothing; an older file of that name is
/// replaced.
///
/// # Errors
/// [`ResultsError::File`]; no `.part` file is left behind.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), ResultsError> {
    write_whole_by(path, |mut file| file.write_all(bytes).map(|()| file)).map_err(|error| in_use_or("write", path, error))
}

/// The same piece by piece: `write` gets the file under its name until it is complete.
///
/// # Errors
/// [`ResultsError::File`]; no `.part` file is left behind.
pub(super) fn write_whole_in_pieces(path: &Path, write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> Result<(), ResultsError> {
    write_whole_by(path, |file| {
        let mut out = BufWriter::with_capacity(PIECES, file);
        write(&mut out)?;
        out.into_inner().map_err(io::IntoInnerError::into_error)
    })
    .map_err(|error| in_use_or("write", path, error))
}

/// What all files that are written at once come to: `write` gets the new `.part` file and gives it back
/// complete; it takes the place of what has the name, also of a link.
///
/// # Errors
/// What `write` or the system says, and what is no plain file under the name of the `.part` file; nothing of
/// the new file is left.
pub(crate) fn write_whole_by<E: From<io::Error>>(path: &Path, write: impl FnOnce(File) -> Result<File, E>) -> Result<(), E> {
    let part = part_path(path);
    let file = plain::create(&part)?;
    // It is open, and so locked, until it has its name.
    let written = write(file).and_then(|file| fs::rename(&part, path).map(|()| drop(file)).map_err(E::from));
    if written.is_err() {
        // The first error is the one that matters.
        let _ = fs::remove_file(&part);
    }
    written
}

/// An error of the system, or that another run writes to a file.
fn in_use_or(action: &'static str, path: &Path, error: io::Error) -> ResultsError {
    match error.kind() {
        ErrorKind::ResourceBusy => ResultsError::InUse { path: path.into() },
        _ => ResultsError::file(action, path)(error),
    }
}

/// Two runs never write to one file, also where one of them continues with it. Ends with the process,
/// whatever ends that.
fn locked(file: &File, path: &Path) -> Result<(), ResultsError> {
    plain::hold(file).map_err(|error| in_use_or("write", path, error))
}

/// A file that grows record by record and gets its name at the end. After a failed write it is cut back to
/// the last whole record.
#[derive(Debug)]
pub(super) struct PartFile {
    path: PathBuf,
    file: File,
    length: u64,
    /// Over all of it.
    sum: Crc,
}

/// How far a file has grown, and a check sum of it until there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Mark {
    pub(super) bytes: u64,
    pub(super) sum: u32,
}

impl PartFile {
    /// Starts `path` as `path.part`, which must not exist: two runs never write to one file.
    pub(super) fn create(path: &Path) -> Result<Self, ResultsError> {
        let part = part_path(path);
        let file = OpenOptions::new().write(true).create_new(true).open(&part).map_err(ResultsError::file("create", &part))?;
        locked(&file, &part)?;
        Ok(Self { path: path.to_path_buf(), file, length: 0, sum: Crc::new() })
    }

    /// Continues with `path`, complete or not, from where it was marked: what came later is cut off. With it
    /// comes what is there.
    pub(super) fn reopen(path: &Path, mark: Mark) -> Result<(Self, Vec<u8>), ResultsError> {
        let part = part_path(path);
        if fs::symlink_metadata(&part).is_err() && fs::symlink_metadata(path).is_ok() {
            fs::rename(path, &part).map_err(ResultsError::file("rename", path))?;
        }
        let mut file = plain::reopen(&part, OpenOptions::new().read(true).write(true)).map_err(ResultsError::file("open", &part))?;
        locked(&file, &part)?;
        let changed = |what: &str| ResultsError::Changed { path: part.clone(), what: what.into() };
        let there = file.metadata().map_err(ResultsError::file("read", &part))?.len();
        let (true, Ok(length)) = (there >= mark.bytes, usize::try_from(mark.bytes)) else { return Err(changed("it is shorter")) };
        let mut bytes = vec![0; length];
        file.read_exact(&mut bytes).map_err(ResultsError::file("read", &part))?;
        let mut sum = Crc::new();
        sum.update(&bytes);
        if sum.sum() != mark.sum {
            return Err(changed("its check sum is another"));
        }
        file.set_len(mark.bytes).and_then(|()| file.seek(std::io::SeekFrom::End(0))).map_err(ResultsError::file("write", &part))?;
        Ok((Self { path: path.to_path_buf(), file, length: mark.bytes, sum }, bytes))
    }

    /// How far it is, once that is on the disk.
    pub(super) fn mark(&self) -> Result<Mark, ResultsError> {
        self.file.sync_data().map_err(ResultsError::file("write", &self.path))?;
        Ok(Mark { bytes: self.length, sum: self.sum.sum() })
    }

    /// Appends whole records.
    pub(super) fn append(&mut self, records: &[u8]) -> Result<(), ResultsError> {
        if let Err(source) = self.file.write_all(records) {
            // The first error is the one that matters.
            let _ = self.file.set_len(self.length).and_then(|()| self.file.seek(std::io::SeekFrom::End(0)));
            return Err(ResultsError::file("write", &self.path)(source));
        }
        self.length += records.len() as u64;
        self.sum.update(records);
        Ok(())
    }

    /// Gives the file its final name.
    pub(super) fn finish(self) -> Result<(), ResultsError> {
        let Self { path, file, .. } = self;
        drop(file);
        fs::rename(part_path(&path), &path).map_err(ResultsError::file("write", &path))
    }
}
