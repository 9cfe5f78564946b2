//! Reads a model as far as that goes, and makes what is seen of it.

use super::glyphs::{self, Glyph};
use super::places::Places;
use crate::PathPolicy;
use crate::model_file::{self, Diagnostics, FILE_NAME, Loaded};
use crate::results::messages::BUG;
use embate_solver::error::Error;
use embate_solver::model::{Material, Model};
use embate_solver::output::{Cells, Field, Frame};
use embate_solver::simulation::{Overview, Simulation};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Fields that can be shown of a model before it runs.
const FIELDS: [&str; 2] = ["element_quality", "stable_step"];
/// Attempts to leave out what keeps a model from being meshed.
const ATTEMPTS: usize = 4;

/// What is seen of a model before it runs.
#[derive(Debug)]
pub struct Preview {
    /// The model, as far as it can be read; nothing of a file that is no TOML.
    pub model: Option<Model>,
    /// What keeps it from being run.
    pub faults: Diagnostics,
    /// What the user should know; empty where there are faults.
    pub warnings: Diagnostics,
    /// Elements of all sound parts.
    pub cells: Cells,
    /// Where they are at the start, with the fields of elements.
    pub frame: Frame,
    /// What acts on them, and where faults are.
    pub glyphs: Vec<Glyph>,
    /// Of a model without faults.
    pub overview: Option<Overview>,
    /// Files that it was made from: if one of them changes the model may have changed.
    pub files: Vec<PathBuf>,
}

/// A model file as far as it could be read, with its faults, before it is made ready to run.
#[derive(Debug)]
pub struct Source {
    path: PathBuf,
    loaded: Option<Loaded>,
    faults: Diagnostics,
    files: Vec<PathBuf>,
}

impl Source {
    /// Reads a model file, or `model.toml` of a folder, with `set` keys overridden.
    #[must_use]
    pub fn read(path: &Path, set: &[String], reach: PathPolicy) -> Self {
        let (loaded, faults) = model_file::load_as_far(path, set, reach);
        let files = files(path, loaded.as_ref());
        Self { path: path.into(), loaded, faults, files }
    }

    /// The bodies and glyphs of a model without faults in its file: for large models, of which
    /// [`Source::preview`] takes long. `None` where there are faults. `make` makes simulations.
    #[must_use]
    pub fn sketch(&self, make: &dyn Fn(&Model) -> Result<Simulation, Error>) -> Option<Preview> {
        let loaded = self.loaded.as_ref().filter(|_| self.faults.count == 0)?;
        let simulation = sound(&loaded.model, &self.faults, make)?;
        Some(Preview::of(loaded, &simulation, Diagnostics::none(), self.files.clone()))
    }

    /// All that is seen; with it comes the simulation of a model without faults.
    #[must_use]
    pub fn preview(self, make: &dyn Fn(&Model) -> Result<Simulation, Error>) -> (Preview, Option<Simulation>) {
        let Self { path, loaded, faults, files } = self;
        let Some(loaded) = loaded else { return (Preview::nothing(None, faults, files), None) };
        let made = if faults.count > 0 { Err(faults) } else { make(&loaded.model).map_err(|error| reported(&loaded, &path, &error)) };
        match made {
            Ok(simulation) => {
                let overview = simulation.overview();
                let mut preview = Preview::of(&loaded, &simulation, Diagnostics::none(), files);
                preview.warnings = loaded.reported(simulation.model_warnings());
                preview.glyphs.extend(overview.governor_at.map(|at| glyphs::governor(at, &overview.governor)));
                preview.overview = Some(overview);
                (preview, Some(simulation))
            }
            Err(faults) => match sound(&loaded.model, &faults, make) {
                Some(simulation) => (Preview::of(&loaded, &simulation, faults, files), None),
                None => (Preview::nothing(Some(loaded.model), faults, files), None),
            },
        }
    }
}

impl Preview {
    /// Whether all faults were looked for.
    #[must_use]
    pub fn is_checked(&self) -> bool {
        self.overview.is_some() || self.faults.count > 0
    }

    fn nothing(model: Option<Model>, faults: Diagnostics, files: Vec<PathBuf>) -> Self {
        let (warnings, frame) = (Diagnostics::none(), Frame { dimension: 2, ..Frame::default() });
        Self {
            model,
            faults,
            warnings,
            cells: Cells { offsets: vec![0], ..Cells::default() },
            frame,
            glyphs: Vec::new(),
            overview: None,
            files,
        }
    }

    fn of(loaded: &Loaded, simulation: &Simulation, faults: Diagnostics, files: Vec<PathBuf>) -> Self {
        let (cells, mut frame) = (simulation.cells(), simulation.frame());
        frame.fields = FIELDS.iter().filter_map(|name| simulation.field(name)).collect();
        let velocities = simulation.field("velocity");
        let places = Places::new(simulation, &cells, &frame);
        let velocities = velocities.as_ref().map(|Field { values, .. }| &values[..]);
        let mut all = glyphs::of_model(&loaded.model, loaded, &places, velocities);
        all.extend(glyphs::of_faults(&faults, &all, &loaded.model, &places));
        let warnings = Diagnostics::none();
        Self { model: Some(loaded.model.clone()), faults, warnings, cells, frame, glyphs: all, overview: None, files }
    }

    /// Whether anything can be drawn.
    #[must_use]
    pub fn has_bodies(&self) -> bool {
        !self.cells.is_empty()
    }
}

/// Why a simulation could not be made, with places in the file.
fn reported(loaded: &Loaded, path: &Path, error: &Error) -> Diagnostics {
    match error {
        Error::Model(faults) => loaded.faulty(faults),
        other => Diagnostics::plain(other.kind().unwrap_or(&BUG), path.display().to_string(), other.to_string(), String::new()),
    }
}

/// A simulation of the sound parts of a model, of an elastic material, and nothing else; `None` if there are
/// no such parts.
fn sound(model: &Model, faults: &Diagnostics, make: &dyn Fn(&Model) -> Result<Simulation, Error>) -> Option<Simulation> {
    let mut bad: BTreeSet<usize> = faults.entries.iter().filter_map(|fault| part_of(&fault.path)).collect();
    for attempt in 0..ATTEMPTS {
        let kept: Vec<usize> = (0..model.parts.len()).filter(|index| !bad.contains(index)).collect();
        if kept.is_empty() {
            return None;
        }
        match make(&bare(model, &kept, faults, attempt == 0)) {
            Ok(simulation) => return Some(simulation),
            Err(Error::Model(found)) => {
                let count = bad.len();
                bad.extend(found.iter().filter_map(|fault| part_of(&fault.path)).filter_map(|part| kept.get(part)));
                if bad.len() == count && attempt > 0 {
                    return None;
                }
            }
            Err(_) => return None,
        }
    }
    None
}

/// The part whose form a fault at this path is about; a name or a material does not hinder.
fn part_of(path: &str) -> Option<usize> {
    let (number, key) = path.strip_prefix("part[")?.split_once(']')?;
    let harmless = [".material", ".velocity", ".spin", ".stress_initial", ".temperature_initial", ".rigid"];
    if harmless.iter().any(|name| key.starts_with(name)) { None } else { number.parse().ok() }
}

/// Some parts of a model, elastic, with its obstacles where these are sound.
fn bare(model: &Model, kept: &[usize], faults: &Diagnostics, with_obstacles: bool) -> Model {
    let part = |&index: &usize| {
        let part = &model.parts[index];
        embate_solver::model::Part { rigid: None, stress_initial: None, temperature_initial: None, mass_scale: 1.0, ..part.clone() }
    };
    let parts: Vec<_> = kept.iter().map(part).collect();
    let elastic = || Material {
        law: "elastic".into(),
        parameters: BTreeMap::from([("density".into(), 1000.0), ("young".into(), 1e9), ("poisson".into(), 0.3)]),
        ..Material::default()
    };
    let layers = parts.iter().filter_map(|part| part.section.as_ref()).flat_map(|section| &section.layers).map(|layer| &layer.material);
    let names = parts.iter().map(|part| &part.material).chain(layers).chain(model.materials.keys());
    let materials = names.map(|name| (name.clone(), elastic())).collect();
    let is_sound = |index: usize| !faults.entries.iter().any(|fault| fault.path.starts_with(&format!("obstacle[{index}]")));
    let named = |names: &[String]| names.iter().all(|name| parts.iter().any(|part| part.name == *name));
    let obstacles = model.obstacles.iter().enumerate().filter(|(index, it)| with_obstacles && is_sound(*index) && named(&it.parts));
    let obstacles = obstacles.map(|(_, obstacle)| {
        let mut obstacle = obstacle.clone();
        obstacle.interface.initial_penetration = embate_solver::model::InitialPenetration::Ignore;
        obstacle
    });
    let mut bare =
        Model { name: model.name.clone(), obstacles: obstacles.collect(), materials, meshes: model.meshes.clone(), ..Model::default() };
    // In no time nothing meets, and no one has to look for it.
    bare.run.end = 1e-12;
    bare.curves.clone_from(&model.curves);
    bare.parts = parts;
    bare
}

/// The file of the model, and those of its meshes.
fn files(path: &Path, loaded: Option<&Loaded>) -> Vec<PathBuf> {
    let file = if path.is_dir() { path.join(FILE_NAME) } else { path.to_path_buf() };
    let folder = file.parent().map(Path::to_path_buf).unwrap_or_default();
    let named = loaded.map(Loaded::written).unwrap_or_default();
    let mut files: Vec<PathBuf> = named
        .into_iter()
        .filter(|(key, _)| key.ends_with(".file") || key == "file")
        .map(|(_, value)| folder.join(value.trim_matches(['"', '\''])))
        .collect();
    files.push(file);
    files.sort();
    files.dedup();
    files
}
