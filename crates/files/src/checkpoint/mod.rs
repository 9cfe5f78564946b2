//! Checkpoints: what a run needs to continue, in files `checkpoint/<step>.embate` of its result folder.
//!
//! States come from the simulation through the writer of results, which knows how far history, fields and
//! film are (`Reported`); [`Checkpoint::write`] puts them into a file (`container`, its blocks packed by
//! `pack`), under its final name only when it is on the disk as a whole. Two generations are kept.
//! [`generations`] finds them, [`Checkpoint::read`] reports a damaged one from a sound one, and [`Identity`]
//! whether a model is still the one that ran.

mod container;
mod difference;
pub mod messages;
mod pack;

pub use difference::Identity;

use crate::plain;
use crate::results::{Reported, write_whole_by};
use crate::threads::Threads;
use container::Block;
use embate_solver::archive::Section;
use embate_solver::message::Message;
use embate_solver::model::Model;
use embate_solver::simulation::State;
use serde::{Deserialize, Serialize};
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use thiserror::Error;

/// Folder of the checkpoints in that of the results.
pub const FOLDER: &str = "checkpoint";
/// Ending of their names.
const ENDING: &str = "embate";
/// How many are kept.
const GENERATIONS: usize = 2;
/// Block of the model as it was.
const MODEL: &str = "model";
/// Block of the frames of the film so far.
const FILM: &str = "film";

/// Why there is no checkpoint to continue from, or none could be written.
#[derive(Debug, Error)]
pub enum CheckpointError {
    /// The system refused.
    #[error("can't {action} {}: {source}{}", .path.display(), crate::results::remedy(.source.kind()))]
    File {
        /// What was tried.
        action: &'static str,
        /// On which path.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The file is torn, or bytes of it have changed.
    #[error("{} is damaged: {what}", .path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What gave it away.
        what: String,
    },
    /// The file is sound, but not for this program.
    #[error("{} was written by embate {found}, and this is embate {own}; a run continues only with the program that \
        began it", .path.display())]
    Version {
        /// The file.
        path: PathBuf,
        /// Its version.
        found: String,
        /// That of the program.
        own: String,
    },
}

impl CheckpointError {
    /// Its kind.
    #[must_use]
    pub fn kind(&self) -> &'static Message {
        match self {
            Self::File { source, .. } => plain::kind(source),
            Self::Damaged { .. } => &messages::DAMAGED,
            Self::Version { .. } => &messages::VERSION,
        }
    }

    fn file(action: &'static str, path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_path_buf();
        move |source| Self::File { action, path, source }
    }
}

/// Where a model came from.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Origin {
    /// Its file or folder; absolute, so that it is found from anywhere.
    pub path: PathBuf,
    /// Keys that were overridden.
    pub set: Vec<String>,
    /// Where the run began, if that is not the start of the model.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub exchanged: Option<Exchanged>,
}

/// A part of another run that went over to a mesh of the user's, with which this run began.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Exchanged {
    /// Result folder of the other run; absolute. Empty: it was one in a program.
    pub run: PathBuf,
    /// After which step.
    pub step: u64,
    /// The part.
    pub part: String,
    /// File of the mesh; absolute. Empty: it was in memory.
    pub mesh: PathBuf,
}

/// What stands at the head of the file, besides its blocks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Header {
    /// Version of the program.
    version: String,
    /// Digest of what a model must share with the one that ran.
    digest: String,
    step: u64,
    time: f64,
    origin: Origin,
    #[serde(rename = "told")]
    reported: Reported,
    /// Number of blocks.
    blocks: usize,
}

/// A run at the end of a step.
#[derive(Clone, Debug, PartialEq)]
pub struct Checkpoint {
    /// State of the simulation.
    pub state: Arc<State>,
    /// Where the model came from.
    pub origin: Origin,
    /// What the model was.
    pub identity: Identity,
    /// How far history, fields and film were.
    pub reported: Reported,
    /// Frames of the film so far; empty without pictures.
    pub(crate) film: Vec<Section>,
}

impl Checkpoint {
    /// The state of a simulation of a model alone, without results.
    #[must_use]
    pub fn of(state: State, model: &Model) -> Self {
        let reported = Reported::default();
        Self { state: Arc::new(state), origin: Origin::default(), identity: Identity::of(model), reported, film: Vec::new() }
    }

    /// Lets go of the state, which is large, once a simulation has taken it over; what else is known of it
    /// stays.
    pub fn release_state(&mut self) {
        self.state = Arc::new(State { sections: Vec::new(), ..*self.state });
    }

    /// Writes it as the newest generation of a result folder and removes those that are too old; an
    /// interrupted or failed write leaves the older ones as they are.
    ///
    /// # Errors
    /// [`CheckpointError::File`].
    pub fn write(&self, results: &Path, threads: &Threads) -> Result<(), CheckpointError> {
        let folder = results.join(FOLDER);
        fs::create_dir_all(results).map_err(CheckpointError::file("create", results))?;
        plain::folder(&folder).map_err(CheckpointError::file("create", &folder))?;
        let path = folder.join(format!("{:012}.{ENDING}", self.state.step));
        self.write_file(&path, threads)?;
        // The name, too, must outlive a power failure; where folders can't be synchronised there is nothing
        // to do.
        for folder in [folder.as_path(), results] {
            let _ = File::open(folder).and_then(|folder| folder.sync_all());
        }
        for old in generations(results).into_iter().filter(|generation| generation.step < self.state.step).skip(GENERATIONS - 1) {
            fs::remove_file(&old.path).map_err(CheckpointError::file("remove", &old.path))?;
        }
        Ok(())
    }

    /// Writes it as one file, which stands there as a whole or not at all.
    ///
    /// # Errors
    /// [`CheckpointError::File`].
    pub fn write_file(&self, path: &Path, threads: &Threads) -> Result<(), CheckpointError> {
        write_whole_by(path, |file| self.write_to(file, threads)).map_err(CheckpointError::file("write", path))
    }

    fn write_to(&self, file: File, threads: &Threads) -> io::Result<File> {
        let model = Section { name: MODEL.into(), bytes: self.identity.text().into_bytes() };
        let film = self.film.iter().map(|section| Block { name: FILM, section });
        let state = self.state.sections.iter().map(|section| Block { name: &section.name, section });
        let blocks: Vec<Block<'_>> = [Block { name: MODEL, section: &model }].into_iter().chain(film).chain(state).collect();
        let header = Header {
            version: env!("CARGO_PKG_VERSION").into(),
            digest: self.identity.digest(),
            step: self.state.step,
            time: self.state.time,
            origin: self.origin.clone(),
            reported: self.reported.clone(),
            blocks: blocks.len(),
        };
        let header = serde_json::to_vec(&header).expect("plain numbers, texts and lists always have a JSON form");
        let file = container::write(file, &header, &blocks, threads)?;
        file.sync_all()?;
        Ok(file)
    }

    /// Reads a file back.
    ///
    /// # Errors
    /// [`CheckpointError::Damaged`] where not every byte is as it was written, [`CheckpointError::Version`]
    /// where another program wrote it.
    pub fn read(path: &Path, threads: &Threads) -> Result<Self, CheckpointError> {
        Self::parse(&plain::read(path).map_err(CheckpointError::file("read", path))?, path, threads)
    }

    /// Reads the bytes of the file `path`.
    ///
    /// # Errors
    /// As [`Checkpoint::read`].
    pub fn parse(bytes: &[u8], path: &Path, threads: &Threads) -> Result<Self, CheckpointError> {
        let damaged = |what: String| CheckpointError::Damaged { path: path.into(), what };
        let head = container::head(bytes).map_err(damaged)?;
        // Before all else: only what this version wrote has its shape.
        #[derive(Deserialize)]
        struct Version {
            version: String,
        }
        let Version { version } = serde_json::from_slice(head.header).map_err(|error| damaged(error.to_string()))?;
        let own = env!("CARGO_PKG_VERSION").to_string();
        if version != own {
            return Err(CheckpointError::Version { path: path.into(), found: version, own });
        }
        let rest = head.rest().map_err(damaged)?;
        let header: Header = serde_json::from_slice(head.header).map_err(|error| damaged(error.to_string()))?;
        let mut sections = container::blocks(rest, header.blocks, threads).map_err(damaged)?.into_iter();
        let model = sections.next().filter(|section| section.name == MODEL).ok_or_else(|| damaged("it has no model".into()))?;
        let identity = Identity::of_text(&String::from_utf8_lossy(&model.bytes));
        if identity.digest() != header.digest {
            return Err(damaged("the model is not that of its digest".into()));
        }
        let (film, sections) = sections.partition(|section| section.name == FILM);
        let state = Arc::new(State { step: header.step, time: header.time, sections });
        Ok(Self { state, origin: header.origin, identity, reported: header.reported, film })
    }
}

/// A checkpoint file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Generation {
    /// Its path.
    pub path: PathBuf,
    /// Its step.
    pub step: u64,
}

/// The checkpoints of a result folder, the newest first; those that are not complete don't count.
#[must_use]
pub fn generations(results: &Path) -> Vec<Generation> {
    let entries = fs::read_dir(results.join(FOLDER)).into_iter().flatten().flatten();
    let generation = |entry: fs::DirEntry| {
        let path = entry.path();
        let step = is_checkpoint(entry.file_name().to_str()?)?;
        Some(Generation { path, step })
    };
    let mut found: Vec<Generation> = entries.filter_map(generation).collect();
    found.sort_by_key(|generation| std::cmp::Reverse(generation.step));
    found
}

/// Longest head of a file that is looked at alone, bytes.
const HEAD_MAX: u64 = 16 << 20;

/// Wall time that a run had taken when it wrote a file, s; `None` where it can't be read.
pub(crate) fn seconds(path: &Path) -> Option<f64> {
    let mut bytes = Vec::new();
    plain::open(path).ok()?.take(HEAD_MAX).read_to_end(&mut bytes).ok()?;
    let header: Header = serde_json::from_slice(container::head(&bytes).ok()?.header).ok()?;
    Some(header.reported.spent.wall)
}

/// The step of a file called so; `None`: it is no checkpoint.
pub(crate) fn is_checkpoint(name: &str) -> Option<u64> {
    let digits = name.strip_suffix(ENDING)?.strip_suffix('.')?;
    (digits.len() >= 12 && digits.bytes().all(|digit| digit.is_ascii_digit())).then(|| digits.parse().ok())?
}

/// How often [`newest`] looks at the folder again while a run beside it replaces its checkpoints.
const LOOKS: usize = 10;

/// The newest sound checkpoint that `fits`, and what is wrong with those that are newer. A file that a run
/// beside it has removed since the folder was listed is none: where all are, the folder is listed again.
///
/// # Errors
/// What is wrong with each; empty where there is none at all.
pub fn newest(
    results: &Path,
    threads: &Threads,
    fits: impl Fn(&Generation) -> bool,
) -> Result<(Checkpoint, Vec<CheckpointError>), Vec<CheckpointError>> {
    for _ in 0..LOOKS {
        let mut faults = Vec::new();
        let mut are_gone = false;
        for generation in generations(results).iter().filter(|generation| fits(generation)) {
            match Checkpoint::read(&generation.path, threads) {
                Ok(checkpoint) => return Ok((checkpoint, faults)),
                Err(CheckpointError::File { source, .. }) if source.kind() == io::ErrorKind::NotFound => are_gone = true,
                Err(fault) => faults.push(fault),
            }
        }
        if !are_gone {
            return Err(faults);
        }
    }
    Err(Vec::new())
}
