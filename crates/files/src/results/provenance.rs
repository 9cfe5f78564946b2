//! `run.json`: what ran, so that it can be known, and run again, when the model has changed since: the
//! version of the program, where the model came from, and what it was, key by key.
//!
//! Written when a run begins, and again when it continues. Read by `embate diff`, `report`, `replay` and
//! `run`.

use super::{Checkpoints, ResultsError, write_whole};
use crate::checkpoint::{Exchanged, Identity, Origin};
use crate::{plain, program};
use embate_solver::model::{Camera, Model};
use embate_solver::simulation::PartMeshed;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::io::ErrorKind;
use std::path::Path;

/// Name of the file.
pub(super) const RAN: &str = "run.json";

/// What ran.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    /// Version of the program.
    pub version: String,
    /// Commit that the program was built from, if that was known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub commit: Option<String>,
    /// File or folder of the model; absolute.
    model: String,
    /// Keys that were overridden.
    set: Vec<String>,
    /// Where the run began, if that is not the start of the model.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    exchanged: Option<Exchanged>,
    /// What the model was.
    pub keys: Identity,
    /// How it is shown; earlier versions did not write it.
    #[serde(default)]
    pub appearance: Appearance,
    /// Keys of the model file with their values as they are written, in the order of the file; what was
    /// overridden as it was on the command line.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub written: Vec<(String, String)>,
    /// What parts are made of.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<PartMade>,
}

/// What a part is made of: see [`PartMeshed`].
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PartMade {
    /// Name.
    pub name: String,
    /// Element formulations with the numbers of their elements.
    pub elements: Vec<(String, usize)>,
    /// Number of nodes.
    pub nodes: usize,
    /// Mass, kg/m (kg).
    pub mass: f64,
    /// Smallest and largest element, m.
    pub sizes: [f64; 2],
    /// Shape of the worst element.
    pub shape: f64,
    /// Its centre, m.
    pub worst: Vec<f64>,
    /// Stable step of its elements, s; none of a rigid part.
    pub stable_time_step: Option<f64>,
}

impl PartMade {
    pub(super) fn of(part: PartMeshed) -> Self {
        let PartMeshed { name, elements, nodes, mass, sizes, shape, worst, stable_time_step } = part;
        let finite = |value: f64| if value.is_finite() { value } else { 0.0 };
        let stable_time_step = Some(stable_time_step).filter(|step| step.is_finite());
        Self { name, elements, nodes, mass, sizes: sizes.map(finite), shape: finite(shape), worst, stable_time_step }
    }
}

/// How a model wants to be shown, and what its field files don't have.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Appearance {
    /// In words; may be empty.
    pub title: String,
    /// Components of a position: 2 in 2D, 3 in 3D.
    pub dimension: usize,
    /// Whether it is an axisymmetric body.
    pub axisymmetric: bool,
    /// End time, s.
    pub end: Option<f64>,
    /// Names of the parts, and which are rigid bodies.
    pub parts: Vec<(String, bool)>,
    /// Names.
    pub obstacles: Vec<String>,
    /// Names.
    pub contacts: Vec<String>,
    /// Pictures show the mirrored half at x = 0, y = 0, z = 0.
    pub mirror: [bool; 3],
    /// Field of the pictures; empty: none was chosen.
    pub field: String,
    /// Where a model in 3D is seen from.
    pub camera: Option<Seen>,
}

/// Where a model in 3D is seen from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Seen {
    /// Direction from the model to the camera.
    pub from: [f64; 3],
    /// What is in the middle, m; none: the middle of all.
    pub at: Option<[f64; 3]>,
    /// Direction that is upwards.
    pub up: [f64; 3],
    /// How many times larger than so that everything is seen.
    pub zoom: f64,
}

impl Appearance {
    /// That of a model.
    #[must_use]
    pub fn of(model: &Model) -> Self {
        let seen = |camera: Camera| Seen { from: camera.from, at: camera.at, up: camera.up, zoom: camera.zoom };
        Self {
            title: model.title.clone(),
            dimension: model.dimension(),
            axisymmetric: model.is_axisymmetric(),
            end: Some(model.run.end).filter(|end| end.is_finite()),
            parts: model.parts.iter().map(|part| (part.name.clone(), part.rigid.is_some())).collect(),
            obstacles: model.obstacles.iter().map(|obstacle| obstacle.name.clone()).collect(),
            contacts: model.contacts.iter().map(|contact| contact.name.clone()).collect(),
            mirror: model.output.mirror,
            field: model.output.picture_field.clone(),
            camera: model.output.camera.map(seen),
        }
    }
}

impl Provenance {
    /// What a model is and where it came from.
    pub(super) fn of(keys: Identity, checkpoints: &Checkpoints, model: &Model) -> Self {
        let origin = &checkpoints.origin;
        let path = origin.path.to_string_lossy().into_owned();
        Self {
            version: program::VERSION.into(),
            commit: program::commit().map(Into::into),
            model: path,
            set: origin.set.clone(),
            exchanged: origin.exchanged.clone(),
            keys,
            appearance: Appearance::of(model),
            written: checkpoints.written.clone(),
            parts: checkpoints.parts.clone(),
        }
    }

    pub(super) fn write(&self, folder: &Path) -> Result<(), ResultsError> {
        let text = serde_json::to_string_pretty(self).expect("texts, lists and maps of texts always have a JSON form");
        write_whole(&folder.join(RAN), format!("{text}\n").as_bytes())
    }

    /// That of a folder of results; `None`: there is none.
    ///
    /// # Errors
    /// [`ResultsError::Damaged`]; what the system says.
    pub fn read(folder: &Path) -> Result<Option<Self>, ResultsError> {
        read_json(&folder.join(RAN))
    }

    /// The command by which it is run again; none of a model that came from no file, or of a run that began
    /// in a program.
    #[must_use]
    pub fn command(&self) -> Option<String> {
        if let Some(Exchanged { run, part, mesh, .. }) = &self.exchanged {
            // Else it was done in a program.
            run.file_name()?;
            let [run, part, mesh] = [&run.to_string_lossy(), part.as_str(), &mesh.to_string_lossy()].map(quoted);
            return Some(format!("embate remesh {run} --part {part} --mesh {mesh}"));
        }
        let set: String = self.set.iter().map(|set| format!(" --set {}", quoted(set))).collect();
        (!self.model.is_empty()).then(|| format!("embate run {}{set}", quoted(&self.model)))
    }

    /// Where the model came from.
    #[must_use]
    pub fn origin(&self) -> Origin {
        Origin { path: self.model.clone().into(), set: self.set.clone(), exchanged: self.exchanged.clone() }
    }
}

/// A JSON file that may be missing.
///
/// # Errors
/// [`ResultsError::Damaged`]; what the system says.
pub(crate) fn read_json<T: DeserializeOwned>(path: &Path) -> Result<Option<T>, ResultsError> {
    match plain::read(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(ResultsError::file("read", path)(error)),
        Ok(bytes) => serde_json::from_slice(&bytes).map(Some).map_err(|error| ResultsError::Damaged {
            path: path.into(),
            line: error.line(),
            what: error.to_string(),
        }),
    }
}

/// A word of a shell.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "_-./=:,+@%".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) { word.to_string() } else { format!("'{}'", word.replace('\'', "'\\''")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_a_shell_are_quoted_where_they_must_be() {
        assert_eq!(quoted("examples/tube-plate"), "examples/tube-plate");
        assert_eq!(quoted("run.end=\"5 ms\""), "'run.end=\"5 ms\"'");
        assert_eq!(quoted("it's $(x)"), "'it'\\''s $(x)'");
        assert_eq!(quoted(""), "''");
    }
}
