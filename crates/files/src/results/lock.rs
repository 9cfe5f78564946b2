//! The lock of a result folder: one run at a time writes into it.
//!
//! The lock is one of the system's on the file `run.lock`, so it ends with the process, whatever ends that;
//! the file itself means nothing. On Unix it goes when the lock is given back.

use super::ResultsError;
use crate::plain;
use std::fs::{File, OpenOptions, TryLockError};
use std::path::{Path, PathBuf};

/// Name of the file.
pub(super) const LOCK: &str = "run.lock";
/// How often it is tried again when the file has gone meanwhile.
const TRIES: usize = 16;

/// That this process, and no other, writes into a folder; until it is dropped.
#[derive(Debug)]
pub(crate) struct FolderLock {
    #[cfg_attr(not(unix), expect(dead_code))]
    path: PathBuf,
    file: File,
}

impl FolderLock {
    /// Takes a folder that is there.
    ///
    /// # Errors
    /// [`ResultsError::InUse`] where another run has it; what the system says.
    pub(crate) fn take(folder: &Path) -> Result<Self, ResultsError> {
        let path = folder.join(LOCK);
        for _ in 0..TRIES {
            let mut options = OpenOptions::new();
            options.read(true).write(true);
            let file = match plain::reopen_or_create(&path, &mut options) {
                // Who had it has just given it back.
                Err(error) if error.kind() == std::io::ErrorKind::NotFound => continue,
                file => file.map_err(ResultsError::file("write", &path))?,
            };
            match file.try_lock() {
                Err(TryLockError::WouldBlock) => break,
                // Some file systems know no locks.
                Ok(()) | Err(TryLockError::Error(_)) => {}
            }
            if plain::is_at(&file, &path) {
                return Ok(Self { path, file });
            }
        }
        Err(ResultsError::InUse { path: folder.to_path_buf() })
    }
}

impl Drop for FolderLock {
    fn drop(&mut self) {
        // Elsewhere another process could have opened it by now.
        #[cfg(unix)]
        if plain::is_at(&self.file, &self.path) {
            let _ = std::fs::remove_file(&self.path);
        }
        // A process that was forked may have the file open, too.
        let _ = self.file.unlock();
    }
}
