//! The folder: refuses to mix two runs, and removes only files that embate makes.

use super::ran::RAN;
use super::{HASHES, ResultsError, atomic::part_path};
use crate::checkpoint::{FOLDER, is_checkpoint};
use crate::post_mortem;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Files of a run that lie in the folder itself.
const FILES: &[&str] =
    &["summary.json", "history.csv", HASHES, RAN, "fields.pvd", "obstacles.pvd", "animation.gif", "final.png", "energy.svg", "history.svg"];
/// Folder of the frames.
const FRAMES: &str = "fields";
/// Folder in which pictures are made before they are complete.
const PICTURES: &str = "pictures.part";

/// A folder for the results of one run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ResultFolder {
    path: PathBuf,
}

impl ResultFolder {
    /// Looks whether `path` can take results without replacing others; creates nothing.
    ///
    /// # Errors
    /// [`ResultsError::Exists`], [`ResultsError::NotAFolder`], or what the system says.
    pub fn refuse_existing(path: &Path) -> Result<(), ResultsError> {
        match existing(path)?.first() {
            None => Ok(()),
            Some(found) => {
                let found = found.strip_prefix(path).unwrap_or(found).display().to_string();
                Err(ResultsError::Exists { path: path.to_path_buf(), found })
            }
        }
    }

    /// Makes the folder ready. With `force`, results of an earlier run are removed: only files with the names that embate
    /// gives, `.part` included; anything else in the folder stays.
    ///
    /// # Errors
    /// As [`ResultFolder::refuse_existing`].
    pub fn create(path: &Path, force: bool) -> Result<Self, ResultsError> {
        if force {
            for file in existing(path)? {
                fs::remove_file(&file).map_err(ResultsError::file("remove", &file))?;
            }
            for folder in [path.join(PICTURES), path.join(FOLDER)] {
                // Stays if something foreign lies in it.
                let _ = fs::remove_dir(folder);
            }
        } else {
            Self::refuse_existing(path)?;
        }
        post_mortem::remove(path)?;
        let frames = path.join(FRAMES);
        fs::create_dir_all(&frames).map_err(ResultsError::file("create", &frames))?;
        Ok(Self { path: path.to_path_buf() })
    }

    /// The folder of results that go on from a checkpoint of `step`, with so many `frames`, and with `hashes` or not: what came later is removed, and what only a run that has ended has.
    ///
    /// # Errors
    /// What the system says.
    pub(crate) fn reopen(path: &Path, frames: usize, hashes: bool, step: u64) -> Result<Self, ResultsError> {
        let later = |name: &str| frame_number(name).is_some_and(|number| number >= frames) || name.ends_with(".part");
        let is = |file: &Path, name: &str| file == path.join(name) || file == part_path(&path.join(name));
        let is_table = |file: &Path| is(file, "history.csv") || (hashes && is(file, HASHES));
        let is_later = |file: &Path| match file.file_name().and_then(|name| name.to_str()) {
            Some(name) if file.parent() == Some(&path.join(FRAMES)) => later(name),
            Some(name) if file.parent() == Some(&path.join(FOLDER)) => is_checkpoint(name).is_none_or(|own| own > step),
            // Collections and what ran are written anew; tables are cut.
            Some(name) => !is_table(file) && !["fields.pvd", "obstacles.pvd", RAN].contains(&name),
            None => false,
        };
        for file in existing(path)?.into_iter().filter(|file| is_later(file)) {
            fs::remove_file(&file).map_err(ResultsError::file("remove", &file))?;
        }
        post_mortem::remove(path)?;
        let folder = path.join(FRAMES);
        fs::create_dir_all(&folder).map_err(ResultsError::file("create", &folder))?;
        Ok(Self { path: path.to_path_buf() })
    }

    /// Takes the results of a run away: files with the names that embate gives, and the folder if nothing else is in it.
    ///
    /// # Errors
    /// As [`ResultFolder::refuse_existing`].
    pub(crate) fn remove(path: &Path) -> Result<(), ResultsError> {
        for file in existing(path)? {
            fs::remove_file(&file).map_err(ResultsError::file("remove", &file))?;
        }
        post_mortem::remove(path)?;
        for folder in [path.join(PICTURES), path.join(FRAMES), path.join(FOLDER), path.to_path_buf()] {
            // Stays if something foreign lies in it.
            let _ = fs::remove_dir(folder);
        }
        Ok(())
    }

    /// Where it is.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Name of frame `number` relative to the folder.
    pub(super) fn frame_name(number: usize) -> String {
        format!("{FRAMES}/frame-{number:05}.vtu")
    }

    /// Name of the obstacles at frame `number` relative to the folder.
    pub(super) fn obstacles_name(number: usize) -> String {
        format!("{FRAMES}/obstacles-{number:05}.vtu")
    }

    /// Lets `make` write pictures into a side folder and moves those that are complete to their place.
    pub(super) fn add_pictures<E: std::fmt::Display>(&self, make: impl FnOnce(&Path) -> Result<(), E>) -> Result<(), String> {
        let side = self.path.join(PICTURES);
        fs::create_dir_all(&side).map_err(|e| ResultsError::file("create", &side)(e).to_string())?;
        let made = make(&side).map_err(|e| e.to_string());
        let moved = made.and_then(|()| {
            for name in FILES.iter().filter(|name| side.join(name).exists()) {
                let place = self.path.join(name);
                fs::rename(side.join(name), &place).map_err(|e| ResultsError::file("write", &place)(e).to_string())?;
            }
            Ok(())
        });
        for name in FILES {
            // Only what is left of pictures that failed.
            let _ = fs::remove_file(side.join(name));
        }
        // Stays if something foreign lies in it.
        let _ = fs::remove_dir(&side);
        moved
    }
}

/// All files in `path` that a run of embate makes, in a fixed order.
fn existing(path: &Path) -> Result<Vec<PathBuf>, ResultsError> {
    match fs::metadata(path) {
        Ok(data) if data.is_dir() => {}
        Ok(_) => return Err(ResultsError::NotAFolder { path: path.to_path_buf() }),
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
        Err(error) => return Err(ResultsError::file("open", path)(error)),
    }
    let mut found = Vec::new();
    for folder in [path.to_path_buf(), path.join(PICTURES)] {
        for name in FILES {
            let file = folder.join(name);
            found.extend([part_path(&file), file].into_iter().rev().filter(|f| fs::symlink_metadata(f).is_ok_and(|data| !data.is_dir())));
        }
    }
    type Is = fn(&str) -> bool;
    for (folder, is_own) in [(FRAMES, is_frame as Is), (FOLDER, |name| is_checkpoint(name.strip_suffix(".part").unwrap_or(name)).is_some())]
    {
        let folder = path.join(folder);
        if fs::metadata(&folder).is_ok_and(|data| data.is_dir()) {
            let mut files = Vec::new();
            for entry in fs::read_dir(&folder).map_err(ResultsError::file("read", &folder))? {
                let entry = entry.map_err(ResultsError::file("read", &folder))?;
                if entry.file_name().to_str().is_some_and(is_own) {
                    files.push(entry.path());
                }
            }
            files.sort();
            found.extend(files);
        }
    }
    Ok(found)
}

/// `frame-00000.vtu` or `obstacles-00000.vtu`, with five digits or more, `.part` or not.
fn is_frame(name: &str) -> bool {
    frame_number(name).is_some()
}

/// The number of a frame in such a name.
fn frame_number(name: &str) -> Option<usize> {
    let name = name.strip_suffix(".part").unwrap_or(name);
    let number = ["frame-", "obstacles-"].iter().find_map(|prefix| name.strip_prefix(prefix)).and_then(|rest| rest.strip_suffix(".vtu"));
    number.filter(|digits| digits.len() >= 5 && digits.bytes().all(|b| b.is_ascii_digit()))?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_own_frames_are_recognised() {
        assert!(is_frame("frame-00000.vtu") && is_frame("frame-123456.vtu") && is_frame("frame-00001.vtu.part"));
        assert!(is_frame(ResultFolder::obstacles_name(7).strip_prefix("fields/").unwrap()));
        assert!(
            !is_frame("frame-0.vtu") && !is_frame("my-frame-00000.vtu") && !is_frame("frame-00000.vtk") && !is_frame("frame-0000x.vtu")
        );
        assert_eq!(ResultFolder::frame_name(7), "fields/frame-00007.vtu");
    }
}
