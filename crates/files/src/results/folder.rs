//! The folder: refuses to mix two runs, and removes only files that embate makes.

use super::lock::FolderLock;
use super::provenance::RAN;
use super::{HASHES, ResultsError, atomic::part_path, write_whole};
use crate::checkpoint::{FOLDER, is_checkpoint};
use crate::{plain, post_mortem};
use std::collections::BTreeMap;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Files of a run that lie in the folder itself.
const FILES: &[&str] =
    &["summary.json", "history.csv", HASHES, RAN, "fields.pvd", "obstacles.pvd", "animation.gif", "final.png", "energy.svg", "history.svg"];
/// Folder of the frames.
const FRAMES: &str = "fields";
/// Folder of the model of a run that came from no file.
const MODEL: &str = "model-of-run";
/// Folder in which pictures are made before they are complete.
const PICTURES: &str = "pictures.part";

/// A folder for the results of one run; no other run writes into it until this and its clones are dropped.
#[derive(Clone, Debug)]
pub struct ResultFolder {
    path: PathBuf,
    _lock: Arc<FolderLock>,
}

impl ResultFolder {
    /// Looks whether `path` can take results without replacing others; creates nothing.
    ///
    /// # Errors
    /// [`ResultsError::Exists`], [`ResultsError::NotAFolder`], or what the system says.
    pub fn refuse_existing(path: &Path) -> Result<(), ResultsError> {
        Self::found(path)?.map_or(Ok(()), |found| Err(ResultsError::Exists { path: path.to_path_buf(), found }))
    }

    /// A file of results in `path`, relative to it; `None`: there are none.
    ///
    /// # Errors
    /// As [`ResultFolder::refuse_existing`].
    pub(super) fn found(path: &Path) -> Result<Option<String>, ResultsError> {
        Ok(existing(path)?.first().map(|found| found.strip_prefix(path).unwrap_or(found).display().to_string()))
    }

    /// Refuses a link where the program chooses the name of a folder; one that the user has named may be a
    /// link.
    ///
    /// # Errors
    /// [`ResultsError::File`].
    pub fn refuse_link(path: &Path) -> Result<(), ResultsError> {
        plain::is_folder(path).map(drop).map_err(ResultsError::file("write into", path))
    }

    /// Makes the folder ready. With `force`, results of an earlier run are removed: only files with the names
    /// that embate gives, `.part` included; anything else in the folder stays.
    ///
    /// # Errors
    /// As [`ResultFolder::refuse_existing`], and [`ResultsError::InUse`].
    pub fn create(path: &Path, force: bool) -> Result<Self, ResultsError> {
        let own = Self::take(path)?;
        if force {
            remove_existing(path, |_, _| true)?;
            for folder in [PICTURES, FOLDER, MODEL].map(|name| path.join(name)) {
                // Stays if something foreign lies in it.
                let _ = fs::remove_dir(folder);
            }
        } else {
            Self::refuse_existing(path)?;
        }
        post_mortem::remove(path)?;
        let frames = path.join(FRAMES);
        plain::folder(&frames).map_err(ResultsError::file("create", &frames))?;
        Ok(own)
    }

    /// Makes a folder if there is none, and keeps other runs out of it.
    ///
    /// # Errors
    /// [`ResultsError::NotAFolder`], [`ResultsError::InUse`], or what the system says.
    pub(super) fn take(path: &Path) -> Result<Self, ResultsError> {
        is_there(path)?;
        fs::create_dir_all(path).map_err(ResultsError::file("create", path))?;
        Ok(Self { path: path.to_path_buf(), _lock: Arc::new(FolderLock::take(path)?) })
    }

    /// Of results that continue, with `hashes` or not: removes what was being written when the run ended, but
    /// for tables.
    ///
    /// # Errors
    /// What the system says.
    pub(super) fn clear_unfinished(&self, hashes: bool) -> Result<(), ResultsError> {
        remove_existing(&self.path, |file, name| name.ends_with(".part") && !self.is_table(file, hashes))
    }

    /// Results that continue from a checkpoint of `step`, with so many `frames`, and with `hashes` or not:
    /// what came later is removed, and what only a run that has ended has.
    ///
    /// # Errors
    /// What the system says.
    pub(super) fn cut(&self, frames: usize, hashes: bool, step: u64) -> Result<(), ResultsError> {
        let path = self.path.as_path();
        remove_existing(path, |file, name| {
            if file.parent() == Some(&path.join(FRAMES)) {
                frame_number(name).is_some_and(|number| number >= frames)
            } else if file.parent() == Some(&path.join(FOLDER)) {
                is_checkpoint(name).is_none_or(|own| own > step)
            } else if file.parent() == Some(&path.join(MODEL)) {
                false
            } else {
                // Collections and what ran are written again; tables are cut.
                !self.is_table(file, hashes) && !["fields.pvd", "obstacles.pvd", RAN].contains(&name)
            }
        })?;
        post_mortem::remove(path)?;
        let folder = path.join(FRAMES);
        plain::folder(&folder).map_err(ResultsError::file("create", &folder))
    }

    /// Whether a file is a table that grows with the run, whole or being written.
    fn is_table(&self, file: &Path, hashes: bool) -> bool {
        let is = |name: &str| [self.path.join(name), part_path(&self.path.join(name))].iter().any(|path| path == file);
        is("history.csv") || (hashes && is(HASHES))
    }

    /// Takes the results of a run away: files with the names that embate gives, and the folder if nothing
    /// else is in it.
    ///
    /// # Errors
    /// As [`ResultFolder::create`]; a link is refused.
    pub(crate) fn remove(path: &Path) -> Result<(), ResultsError> {
        Self::refuse_link(path)?;
        let lock = FolderLock::take(path)?;
        remove_existing(path, |_, _| true)?;
        post_mortem::remove(path)?;
        drop(lock);
        for folder in [path.join(PICTURES), path.join(FRAMES), path.join(FOLDER), path.join(MODEL), path.to_path_buf()] {
            // Stays if something foreign lies in it.
            let _ = fs::remove_dir(folder);
        }
        Ok(())
    }

    /// Names of files outlive a power failure from here on; where folders can't be synchronised there is
    /// nothing to do.
    pub(super) fn secure(&self) {
        for folder in [self.path.join(FRAMES), self.path.clone()] {
            let _ = fs::File::open(folder).and_then(|folder| folder.sync_all());
        }
    }

    /// Writes a model that came from no file beside its results, so that it can be run again: its text, and
    /// the bytes of the meshes that it names as files. Returns the path of the model file.
    ///
    /// # Errors
    /// What the system says.
    pub fn keep_model(&self, name: &str, text: &str, meshes: &BTreeMap<String, Vec<u8>>) -> Result<PathBuf, ResultsError> {
        let folder = self.path.join(MODEL);
        plain::folder(&folder).map_err(ResultsError::file("create", &folder))?;
        for (mesh, bytes) in meshes.iter().filter(|(mesh, _)| is_model_file(mesh)) {
            write_whole(&folder.join(mesh), bytes)?;
        }
        // What looks like a path stays in the folder.
        let name = Path::new(name).file_name().and_then(|name| name.to_str()).unwrap_or("model");
        let file = folder.join(format!("{name}.toml"));
        write_whole(&file, text.as_bytes())?;
        Ok(std::path::absolute(&file).unwrap_or(file))
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
        plain::folder(&side).map_err(|e| ResultsError::file("create", &side)(e).to_string())?;
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

/// Whether a folder is there, perhaps by a link.
fn is_there(path: &Path) -> Result<bool, ResultsError> {
    match fs::metadata(path) {
        Ok(data) if data.is_dir() => Ok(true),
        Ok(_) => Err(ResultsError::NotAFolder { path: path.to_path_buf() }),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(false),
        Err(error) => Err(ResultsError::file("open", path)(error)),
    }
}

/// Removes those files in `path` that a run of embate makes and of which `goes` says so, by path and name.
fn remove_existing(path: &Path, goes: impl Fn(&Path, &str) -> bool) -> Result<(), ResultsError> {
    let goes = |file: &PathBuf| file.file_name().and_then(|name| name.to_str()).is_some_and(|name| goes(file, name));
    for file in existing(path)?.into_iter().filter(goes) {
        fs::remove_file(&file).map_err(ResultsError::file("remove", &file))?;
    }
    Ok(())
}

/// All files in `path` that a run of embate makes, in a fixed order.
fn existing(path: &Path) -> Result<Vec<PathBuf>, ResultsError> {
    if !is_there(path)? {
        return Ok(Vec::new());
    }
    let mut found = Vec::new();
    let pictures = path.join(PICTURES);
    let side = plain::is_folder(&pictures).map_err(ResultsError::file("write into", &pictures))?.then_some(pictures);
    for folder in std::iter::once(path.to_path_buf()).chain(side) {
        for name in FILES {
            let file = folder.join(name);
            found.extend([part_path(&file), file].into_iter().rev().filter(|f| fs::symlink_metadata(f).is_ok_and(|data| !data.is_dir())));
        }
    }
    type Is = fn(&str) -> bool;
    let is_state: Is = |name| is_checkpoint(name.strip_suffix(".part").unwrap_or(name)).is_some();
    for (folder, is_own) in [(FRAMES, is_frame as Is), (FOLDER, is_state), (MODEL, is_model_file)] {
        let folder = path.join(folder);
        if plain::is_folder(&folder).map_err(ResultsError::file("write into", &folder))? {
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

/// A model file or one of its meshes, `mesh-1.msh`, `.part` or not.
fn is_model_file(name: &str) -> bool {
    let name = name.strip_suffix(".part").unwrap_or(name);
    let number = name.strip_prefix("mesh-").and_then(|rest| rest.strip_suffix(".msh"));
    name.ends_with(".toml") || number.is_some_and(|digits| !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit()))
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
    fn a_model_is_kept_beside_its_results_and_goes_with_them() {
        let place = tempfile::tempdir().unwrap();
        let path = place.path().join("out");
        let folder = ResultFolder::create(&path, false).unwrap();
        let meshes = BTreeMap::from([("mesh-1.msh".to_string(), vec![1, 2]), ("../far.msh".to_string(), vec![3])]);
        let file = folder.keep_model("../disk", "end = 1", &meshes).unwrap();
        assert_eq!(file, path.join("model-of-run/disk.toml"));
        assert_eq!(
            (fs::read_to_string(&file).unwrap().as_str(), fs::read(path.join("model-of-run/mesh-1.msh")).unwrap()),
            ("end = 1", vec![1, 2])
        );
        assert!(!place.path().join("far.msh").exists());
        fs::write(path.join("model-of-run/mine.txt"), "").unwrap();
        folder.cut(0, true, 0).unwrap();
        assert!(file.exists(), "results that continue keep it");
        drop(folder);
        drop(ResultFolder::create(&path, true).unwrap());
        let left: Vec<_> = fs::read_dir(path.join("model-of-run")).unwrap().map(|it| it.unwrap().file_name()).collect();
        assert_eq!(left, ["mine.txt"]);
    }

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
