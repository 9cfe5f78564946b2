//! Which files an input may name: those of its own folder, or any.
//!
//! Model files name meshes, and decks include decks; both ask here before they open one. The way that a path
//! takes through `..` and symbolic links is walked to its end, and the end decides. Leave to go outside comes
//! from the command line (`--allow-outside`) and is never taken from a file, checkpoints included.

use crate::model_file::messages::OUTSIDE;
use embate_solver::message::Message;
use std::path::{Component, Path, PathBuf};

/// From where files that an input names are read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PathPolicy {
    /// From the input's folder and those below it.
    #[default]
    Folder,
    /// From anywhere.
    Anywhere,
}

/// The folder that files must lie in, if there is one.
#[derive(Clone, Debug)]
pub(crate) struct Bounds {
    folder: Option<PathBuf>,
    /// Whose it is, for messages.
    whose: &'static str,
}

impl Bounds {
    /// Those of an input in a folder.
    pub(crate) fn of(folder: &Path, whose: &'static str, reach: PathPolicy) -> Self {
        Self { folder: (reach == PathPolicy::Folder).then(|| real(folder)), whose }
    }

    /// Looks where a path ends; `written` is how the input names it.
    ///
    /// # Errors
    /// What is wrong with it and what to do, if that is outside.
    pub(crate) fn hold(&self, path: &Path, written: &str) -> Result<(), (&'static Message, String, String)> {
        let Some(folder) = &self.folder else { return Ok(()) };
        let end = real(path);
        if end.starts_with(folder) {
            return Ok(());
        }
        let is_link = plain(path).starts_with(folder);
        let way = if is_link { format!(", by a link to {}", end.display()) } else { String::new() };
        let message = format!("{written} leads out of the {} folder{way}", self.whose);
        let help = "put the file into the folder; if you know what is read there, add --allow-outside to the command".to_string();
        Err((&OUTSIDE, message, help))
    }
}

/// A path as it is written: absolute, without `..`.
fn plain(path: &Path) -> PathBuf {
    walked(path, |_| {})
}

/// Where a path ends: absolute, without `..`, links followed as far as there is something.
fn real(path: &Path) -> PathBuf {
    walked(path, |so_far| {
        // At each part, because `..` after a link goes up from where the link leads to.
        if let Ok(end) = so_far.canonicalize() {
            *so_far = end;
        }
    })
}

fn walked(path: &Path, mut follow: impl FnMut(&mut PathBuf)) -> PathBuf {
    // The folder of a file that is named without one.
    let path = if path.as_os_str().is_empty() { Path::new(".") } else { path };
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
    let mut so_far = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir => drop(so_far.pop()),
            part => {
                so_far.push(part);
                follow(&mut so_far);
            }
        }
    }
    so_far
}
