//! Whole files or none: everything is written as `NAME.part` and renamed when it is complete.
//!
//! [`write_whole`] takes the bytes of a file at once, `write_whole_in_pieces` writes it from one end to the other; [`PartFile`] grows while a run goes on.

use super::ResultsError;
use flate2::Crc;
use serde::{Deserialize, Serialize};
use std::ffi::OsString;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{BufWriter, Read, Seek, Write};
use std::path::{Path, PathBuf};

/// Bytes that are collected before they are written: below what allocators fetch from the system each time.
const PIECES: usize = 120 << 10;

/// `path` with `.part` behind it.
pub(crate) fn part_path(path: &Path) -> PathBuf {
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

/// Two runs never write to one file, also where one of them goes on with it. Ends with the process, whatever ends that.
fn locked(file: &File, path: &Path) -> Result<(), ResultsError> {
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Err(ResultsError::InUse { path: path.into() }),
        // Some systems know no locks.
        Ok(()) | Err(TryLockError::Error(_)) => Ok(()),
    }
}

/// A file that grows record by record and gets its name at the end. After a failed write it is cut back to the last whole record.
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

    /// Goes on with `path`, complete or not, from where it was marked: what came later is cut off. With it comes what is there.
    pub(super) fn reopen(path: &Path, mark: Mark) -> Result<(Self, Vec<u8>), ResultsError> {
        let part = part_path(path);
        if !part.exists() && path.exists() {
            fs::rename(path, &part).map_err(ResultsError::file("rename", path))?;
        }
        let mut file = OpenOptions::new().read(true).write(true).open(&part).map_err(ResultsError::file("open", &part))?;
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
