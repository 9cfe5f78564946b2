//! Makes a [`Model`] from the records of a file: names that were left out, contradictions between keys, mesh
//! files.
//!
//! Records come from `reader.rs`; what is made of the values of one is said beside its description in
//! [`embate_solver::model`]. Where a value is missing or faulty a placeholder stands in (NaN, empty, the
//! largest count, a mesh that is not there): its fault is noted already, and faults that only follow from it
//! are not shown (`follow.rs`). Contacts are in `contact.rs`.

mod contact;
mod follow;

use super::GivenMeshes;
use super::diagnostics::Faults;
use super::reader::{Document, Record};
use super::tree::Place;
use super::units::shorten;
use crate::gmsh::Bodies;
use crate::gmsh::messages::MESH_FILE;
use crate::mesh_file::Format;
use crate::path_policy::{Bounds, PathPolicy};
use crate::{abaqus, gmsh, stl};
use embate_solver::error::Fault;
use embate_solver::model::{
    Cavity, Channel, Constraint, Curve, Cut, Drive, Flow, ImportedMesh, Join, Joint, Load, LoadTerms, Material, Model, NonReflecting,
    Obstacle, ObstacleShape, Output, Part, Partners, Placement, PointMass, Probe, Relocate, Remesh, Run, Shape, Spring, Stage, Symmetry,
    TriangleSurface, Values, Weld,
};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The model of a file; `meshes` are its mesh files.
pub(super) fn model(document: &Document, name: &str, meshes: &mut Meshes<'_>, faults: &mut Faults) -> Model {
    document.records().for_each(|record| follow::cover(record, faults));
    follow::end(document, faults);
    meshes.sheets = files_of(document, Part::is_of_sheets);
    meshes.frames = files_of(document, Part::is_of_beams);
    document.section("curve").iter().filter_map(|record| record.table("sine")).for_each(|sine| follow::sine(sine, faults));
    let parts = document.section("part").iter().map(|record| part(record, meshes, faults)).collect();
    let obstacles = document.section("obstacle").iter().map(|record| obstacle(record, meshes, faults)).collect();
    let mut model = Model {
        name: name.to_string(),
        title: document.top.text("title"),
        run: all(document, "run", Run::read).pop().unwrap_or_default(),
        stages: all(document, "stage", Stage::read),
        remeshes: all(document, "remesh", Remesh::read),
        relocations: all(document, "relocate", Relocate::read),
        flows: all(document, "flow", Flow::read),
        materials: named(document, "material", Material::read),
        parts,
        meshes: meshes.loaded.clone(),
        contacts: document.section("contact").iter().map(|record| contact::contact(record, faults)).collect(),
        obstacles,
        curves: named(document, "curve", Curve::read),
        symmetries: all(document, "symmetry", Symmetry::read),
        constraints: document.section("constraint").iter().map(|record| constraint(record, faults)).collect(),
        loads: all(document, "load", Load::read),
        load_terms: all(document, "load", LoadTerms::read),
        cavities: all(document, "cavity", Cavity::read),
        non_reflecting: all(document, "non_reflecting", NonReflecting::read),
        joins: all(document, "join", Join::read),
        welds: all(document, "weld", Weld::read),
        joints: all(document, "joint", Joint::read),
        springs: all(document, "spring", Spring::read),
        point_masses: all(document, "point_mass", PointMass::read),
        probes: all(document, "probe", Probe::read),
        cuts: all(document, "cut", Cut::read),
        channels: all(document, "channel", Channel::read),
        output: all(document, "output", Output::read).pop().unwrap_or_default(),
    };
    name_the_nameless(&mut model);
    if !model.stages.is_empty() && model.run.end == 0.0 {
        model.run.end = model.duration_of_stages();
    }
    model
}

/// Mesh files of parts of a kind that are not swept.
fn files_of(document: &Document, is_such: impl Fn(&Part) -> bool) -> BTreeSet<String> {
    let file = |record: &Record| {
        let part = Part::read(record);
        let table = record.table("mesh").filter(|_| is_such(&part) && part.sweep.is_none())?;
        Some(table.text("file"))
    };
    document.section("part").iter().filter_map(file).collect()
}

/// What the tables of a section describe.
fn all<T>(document: &Document, section: &str, read: impl Fn(&dyn Values) -> T) -> Vec<T> {
    document.section(section).iter().map(|record| read(record)).collect()
}

/// What the tables of a section describe, by their names.
fn named<T>(document: &Document, section: &str, read: impl Fn(&dyn Values) -> T) -> BTreeMap<String, T> {
    document.section(section).iter().map(|record| (record.name.clone(), read(record))).collect()
}

fn part(record: &Record, meshes: &mut Meshes<'_>, faults: &mut Faults) -> Part {
    let mut part = Part::read(record);
    if let Shape::Group { mesh, group } = &mut part.shape {
        match record.table("mesh").and_then(|it| Some((meshes.index(it, faults)?, it.text("group")))) {
            Some(found) => (*mesh, *group) = found,
            None => faults.cover(&record.key("mesh")),
        }
    }
    part
}

fn constraint(record: &Record, faults: &mut Faults) -> Constraint {
    follow::constraint(record, faults);
    let mut constraint = Constraint::read(record);
    let given = [&constraint.velocity, &constraint.displacement, &constraint.acceleration, &constraint.spin];
    if constraint.rotation.is_none() && given.iter().all(|drives| drives.iter().all(Option::is_none)) {
        // Nothing sound was given: the reader has said so.
        constraint.velocity[0] = Some(Drive::Constant(0.0));
    }
    constraint
}

fn obstacle(record: &Record, meshes: &Meshes<'_>, faults: &mut Faults) -> Obstacle {
    let mut obstacle = Obstacle::read(record);
    if !record.is_sound("plane") {
        // It stands in where no other shape is sound.
        faults.cover(&record.key("plane"));
    }
    if let (ObstacleShape::Triangles(triangles), Some(it)) = (&mut obstacle.shape, record.table("stl")) {
        let surface = meshes.surface(it, faults).unwrap_or_else(|| {
            faults.cover(&it.path);
            TriangleSurface::default()
        });
        let placed = surface.placed(&Placement::read(it));
        *triangles = Arc::new(if it.get("hollow") { placed.turned_over() } else { placed });
    }
    obstacle
}

/// The mesh files of a model, each read once per scale, and where files of surfaces are.
pub(super) struct Meshes<'a> {
    folder: &'a Path,
    bounds: Bounds,
    given: &'a GivenMeshes,
    /// Those that are read for shells in 3D, and those for beams.
    sheets: BTreeSet<String>,
    frames: BTreeSet<String>,
    /// Path, and bits of scale and tolerance.
    read: Vec<(PathBuf, [u64; 2], Option<usize>)>,
    loaded: Vec<Arc<ImportedMesh>>,
}

impl<'a> Meshes<'a> {
    /// Those of a file in `folder`, none of them read yet; some may be given instead of a file.
    pub(super) fn new(folder: &'a Path, reach: PathPolicy, given: &'a GivenMeshes) -> Self {
        let bounds = Bounds::of(folder, "model's", reach);
        Self { folder, bounds, given, sheets: BTreeSet::new(), frames: BTreeSet::new(), read: Vec::new(), loaded: Vec::new() }
    }

    /// Files that could not be read are tried again, so that their faults are reported again.
    pub(super) fn forget_faults(&mut self) {
        self.read.retain(|(.., index)| index.is_some());
    }

    /// Index into the model's meshes; `None` with a fault noted if the file can't be read.
    fn index(&mut self, record: &Record, faults: &mut Faults) -> Option<usize> {
        let (file, scale) = (record.text("file"), record.number("scale")?);
        let place = record.written("file").filter(|_| record.is_sound("file"))?;
        let path = self.folder.join(&file);
        let tolerance = record.number("tolerance");
        let own = [scale, tolerance.unwrap_or(0.0)].map(f64::to_bits);
        if let Some((.., index)) = self.read.iter().find(|(known, bits, _)| *known == path && *bits == own) {
            return *index;
        }
        let given = self.given.get(&file);
        let index = if given.is_some() || self.is_there(&path, &file, (record, place), faults) {
            let format = Format::of(&path);
            let (is_deck, is_stl) = (format == Format::Deck, format == Format::Stl);
            let is_of_3d = self.sheets.contains(&file) || (is_deck && self.frames.contains(&file));
            let bodies = if is_of_3d { Bodies::Sheets } else { Bodies::Highest };
            let mesh = match given {
                Some(bytes) if is_stl => stl::parse_sheet(bytes, &file, scale, tolerance),
                Some(bytes) => gmsh::parse_for(bodies, bytes, &file, scale),
                None if is_deck => abaqus::read_within(bodies, &path, scale, &self.bounds),
                None if is_stl => stl::read_sheet(&path, &file, scale, tolerance),
                None => gmsh::read_for(bodies, &path, scale),
            };
            match mesh {
                Ok(mesh) => {
                    self.loaded.push(Arc::new(mesh));
                    Some(self.loaded.len() - 1)
                }
                Err(wrong) => {
                    wrong.into_iter().for_each(|fault| report(fault, &file, (record, place), faults));
                    None
                }
            }
        } else {
            None
        };
        self.read.push((path, own, index));
        index
    }

    /// The surface of an obstacle; `None` with a fault noted if the file can't be read.
    fn surface(&self, record: &Record, faults: &mut Faults) -> Option<TriangleSurface> {
        let (file, scale) = (record.text("file"), record.number("scale")?);
        let place = record.written("file").filter(|_| record.is_sound("file"))?;
        let path = self.folder.join(&file);
        if !self.is_there(&path, &file, (record, place), faults) {
            return None;
        }
        stl::read(&path, &file, scale).map_err(|fault| report(fault, &file, (record, place), faults)).ok()
    }

    /// Whether a file may be read and is one; else its fault is noted.
    fn is_there(&self, path: &Path, file: &str, (record, place): (&Record, Place), faults: &mut Faults) -> bool {
        if let Err((kind, message, help)) = self.bounds.hold(path, &shorten(file)) {
            faults.value(kind, &record.key("file"), place, (message, help));
            return false;
        }
        if !path.is_file() {
            let message = format!("there is no file {}", shorten(file));
            let slashes = if file.contains('\\') { "; between folders stands / on every system" } else { "" };
            let help = format!("paths begin at the model's folder, {}{slashes}", self.folder.display());
            faults.value(&MESH_FILE, &record.key("file"), place, (message, help));
            return false;
        }
        true
    }
}

/// Notes a fault within a file.
fn report(fault: Fault, file: &str, (record, place): (&Record, Place), faults: &mut Faults) {
    let within = if fault.path.is_empty() { String::new() } else { format!(", {}", fault.path) };
    let message = format!("{}{within}: {}", shorten(file), fault.message);
    faults.value(fault.kind, &record.key("file"), place, (message, fault.help));
}

/// Names for contacts and obstacles that have none: the names of the surfaces or bodies, `all`, or
/// `obstacle`, `obstacle2`, ...
fn name_the_nameless(model: &mut Model) {
    let plain =
        |name: &str| -> String { name.chars().map(|c| if c.is_alphanumeric() || matches!(c, '_' | '-') { c } else { '_' }).collect() };
    let mut taken: BTreeSet<String> = model.contacts.iter().map(|contact| contact.name.clone()).collect();
    for contact in model.contacts.iter_mut().filter(|contact| contact.name.is_empty()) {
        let names: &[String] = match &contact.partners {
            Partners::Between(between) => between,
            Partners::Bodies(bodies) => bodies,
        };
        let joined: String = names.iter().map(|name| plain(name)).collect::<Vec<_>>().join("-").chars().take(60).collect();
        let joined = if names.is_empty() { "all".to_string() } else { joined };
        contact.name = free(&joined, &taken);
        taken.insert(contact.name.clone());
    }
    name_in_turn("stage", model.stages.iter_mut().map(|stage| &mut stage.name).collect());
    name_in_turn("weld", model.welds.iter_mut().map(|weld| &mut weld.name).collect());
    name_in_turn("joint", model.joints.iter_mut().map(|joint| &mut joint.name).collect());
    name_in_turn("obstacle", model.obstacles.iter_mut().map(|obstacle| &mut obstacle.name).collect());
    name_in_turn("symmetry", model.symmetries.iter_mut().map(|symmetry| &mut symmetry.name).collect());
    let words: Vec<String> = model.constraints.iter().map(|constraint| plain(&constraint.on)).collect();
    name_each(&words, model.constraints.iter_mut().map(|constraint| &mut constraint.name).collect());
    let words: Vec<String> = model.loads.iter().map(|load| plain(load.usual_name())).collect();
    name_each(&words, model.load_terms.iter_mut().map(|terms| &mut terms.name).collect());
}

/// Names those that have none: `word`, `word2`, ...
fn name_in_turn(word: &str, names: Vec<&mut String>) {
    name_each(&vec![word.to_string(); names.len()], names);
}

/// Names those that have none by a word each, with a number where it is taken.
fn name_each(words: &[String], mut names: Vec<&mut String>) {
    let mut taken: BTreeSet<String> = names.iter().map(|name| name.to_string()).collect();
    for (name, word) in names.iter_mut().zip(words).filter(|(name, _)| name.is_empty()) {
        **name = free(word, &taken);
        taken.insert(name.to_string());
    }
}

/// The name, or the name with the first number from 2 that is free.
fn free(name: &str, taken: &BTreeSet<String>) -> String {
    let mut candidate = name.to_string();
    let mut number = 1;
    while taken.contains(&candidate) {
        number += 1;
        candidate = format!("{name}{number}");
    }
    candidate
}
