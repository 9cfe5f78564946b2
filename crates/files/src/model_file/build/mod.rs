//! Makes a [`Model`] from the records of a file: names that were left out, contradictions between keys, mesh
//! files.
//!
//! Records come from `reader.rs`. Where a value is missing or faulty a placeholder stands in (NaN, empty, the
//! largest count, a mesh that is not there): its fault is noted already, and faults that only follow from it
//! are not shown. Contacts and obstacles are in `contact.rs`, what moves in `motion.rs`, loads in `load.rs`.

mod contact;
mod discrete;
mod load;
mod motion;

use super::GivenMeshes;
use super::diagnostics::Faults;
use super::reader::{Document, Record};
use super::tree::Place;
use super::units::shorten;
use super::value::Datum;
use crate::gmsh::messages::MESH_FILE;
use crate::path_policy::{Bounds, PathPolicy};
use crate::{abaqus, gmsh, stl};
use embate_solver::error::Fault;
use embate_solver::mesh::shapes::Values;
use embate_solver::model::{
    Cadence, Camera, Copies, ImportedMesh, InitialStress, MassScaling, Material, Mirror, Model, Output, Part, Partners, PictureView,
    Placement, Probe, ProbeAt, Relaxation, Run, Shape, Sweep, Symmetry, TriangleSurface,
};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The model of a file; `meshes` are its mesh files.
pub(super) fn model(document: &Document, name: &str, meshes: &mut Meshes<'_>, faults: &mut Faults) -> Model {
    let parts = document.section("part").iter().map(|record| part(record, meshes, faults)).collect();
    let obstacles = document.section("obstacle").iter().map(|record| contact::obstacle(record, meshes, faults)).collect();
    let mut model = Model { name: name.to_string(), meshes: meshes.loaded.clone(), obstacles, ..Model::default() };
    model.title = document.top.text("title");
    model.run = run(&document.single("run"));
    let material = |record: &Record| Material {
        law: record.text("law"),
        eos: record.text("eos"),
        parameters: record.numbers(),
        lists: record.lists(),
        failure: record.table("failure").map(Record::numbers).unwrap_or_default(),
    };
    model.materials = document.section("material").iter().map(|record| (record.name.clone(), material(record))).collect();
    model.parts = parts;
    model.contacts = document.section("contact").iter().map(|record| contact::contact(record, faults)).collect();
    model.curves = document.section("curve").iter().map(|record| (record.name.clone(), motion::curve(record, faults))).collect();
    model.symmetries = document.section("symmetry").iter().map(symmetry).collect();
    model.constraints = document.section("constraint").iter().map(|record| motion::constraint(record, faults)).collect();
    model.loads = document.section("load").iter().map(|record| load::load(record, faults)).collect();
    model.non_reflecting = document.section("non_reflecting").iter().map(load::non_reflecting).collect();
    model.joins = document.section("join").iter().map(|record| load::join(record, faults)).collect();
    model.springs = document.section("spring").iter().map(|record| discrete::spring(record, faults)).collect();
    model.point_masses = document.section("point_mass").iter().map(|record| discrete::point_mass(record, faults)).collect();
    model.probes = document.section("probe").iter().map(|record| probe(record, faults)).collect();
    model.output = output(&document.single("output"));
    name_the_nameless(&mut model);
    model
}

fn run(record: &Record) -> Run {
    let number = |name| record.number(name).unwrap_or(f64::NAN);
    Run {
        end: number("end"),
        safety: number("safety"),
        energy_limit: number("energy_limit"),
        step_limit: record.number("step_limit"),
        velocity_limit: record.number("velocity_limit"),
        penetration_limit: record.number("penetration_limit"),
        memory_limit: record.number("memory_limit"),
        time_step: record.number("time_step"),
        max_steps: record.integer("max_steps"),
        checkpoint: record.number("checkpoint"),
        checkpoint_steps: record.integer("checkpoint_steps"),
        bulk_viscosity: record.vector("bulk_viscosity"),
        relaxation: record
            .table("relaxation")
            .map(|it| Relaxation { tolerance: it.number("tolerance").unwrap_or(f64::NAN), from: it.number("from").unwrap_or(f64::NAN) }),
        mass_scaling: record
            .table("mass_scaling")
            .map(|it| MassScaling { time_step: it.number("time_step").unwrap_or(f64::NAN), limit: it.number("limit").unwrap_or(f64::NAN) }),
    }
}

fn part(record: &Record, meshes: &mut Meshes<'_>, faults: &mut Faults) -> Part {
    Part {
        name: record.text("name"),
        material: record.text("material"),
        element: record.text("element"),
        area: record.number("area"),
        hourglass: record.number("hourglass"),
        stress_state: record.text("stress_state"),
        element_triangles: Some(record.text("element_triangles"))
            .filter(|name| !name.is_empty())
            .unwrap_or(Part::default().element_triangles),
        shape: shape(record, meshes, faults),
        sweep: record.tables().find_map(|(name, table)| Sweep::read(name, table)),
        placement: placement(record),
        velocity: record.spatial("velocity"),
        spin: record.number("spin").unwrap_or(f64::NAN),
        stress_initial: record.table("stress_initial").map(stress_initial),
        temperature_initial: record.number("temperature_initial"),
        rigid: motion::rigid(record),
        mass_scale: record.number("mass_scale").unwrap_or(f64::NAN),
    }
}

fn shape(part: &Record, meshes: &mut Meshes<'_>, faults: &mut Faults) -> Shape {
    if let Some(shape) = part.tables().find_map(|(name, table)| Shape::read(name, table)) {
        return shape;
    }
    let mesh = part.table("mesh").and_then(|it| Some((meshes.index(it, faults)?, it.text("group"))));
    if mesh.is_none() {
        faults.cover(&part.key("mesh"));
    }
    let (mesh, group) = mesh.unwrap_or((usize::MAX, String::new()));
    Shape::Group { mesh, group }
}

fn stress_initial(record: &Record) -> InitialStress {
    let components = |it: &Record| ["xx", "yy", "zz", "xy"].map(|name| it.number(name).unwrap_or(f64::NAN));
    let slope = |name| record.table(name).map_or([0.0; 4], components);
    InitialStress { value: components(record), per_x: slope("per_x"), per_y: slope("per_y"), point: record.vector("point") }
}

fn placement(part: &Record) -> Placement {
    let mut placement = Placement { translation: part.spatial("translation"), ..Placement::default() };
    if let Some(it) = part.table("mirror") {
        placement.mirror = Some(Mirror { point: it.spatial("point"), normal: it.spatial("normal") });
    }
    turn(part, &mut placement);
    if let Some(it) = part.table("copies") {
        let angle = it.number("angle").unwrap_or(f64::NAN);
        let count = Values::count(it, "count");
        let (translation, point, axis) = (it.spatial("translation"), it.spatial("point"), it.spatial("axis"));
        placement.copies = Some(Copies { count, translation, angle, point, axis });
    }
    placement
}

fn turn(record: &Record, placement: &mut Placement) {
    if let Some(it) = record.table("rotation") {
        placement.rotation = it.number("angle").unwrap_or(f64::NAN);
        placement.rotation_point = it.spatial("point");
        placement.rotation_axis = it.spatial("axis");
    }
}

/// The mesh files of a model, each read once per scale, and where files of surfaces are.
pub(super) struct Meshes<'a> {
    folder: &'a Path,
    bounds: Bounds,
    given: &'a GivenMeshes,
    read: Vec<(PathBuf, u64, Option<usize>)>,
    loaded: Vec<Arc<ImportedMesh>>,
}

impl<'a> Meshes<'a> {
    /// Those of a file in `folder`, none of them read yet; some may be given instead of a file.
    pub(super) fn new(folder: &'a Path, reach: PathPolicy, given: &'a GivenMeshes) -> Self {
        Self { folder, bounds: Bounds::of(folder, "model's", reach), given, read: Vec::new(), loaded: Vec::new() }
    }

    /// Files that could not be read are tried again, so that their faults are reported again.
    pub(super) fn forget_faults(&mut self) {
        self.read.retain(|(.., index)| index.is_some());
    }

    /// Index into the model's meshes; `None` with a fault noted if the file can't be read.
    fn index(&mut self, record: &Record, faults: &mut Faults) -> Option<usize> {
        let (file, scale) = (record.text("file"), record.number("scale")?);
        let place = record.written("file").filter(|_| record.datum("file").is_some())?;
        let path = self.folder.join(&file);
        if let Some((.., index)) = self.read.iter().find(|(known, bits, _)| *known == path && *bits == scale.to_bits()) {
            return *index;
        }
        let given = self.given.get(&file);
        let index = if given.is_some() || self.is_there(&path, &file, (record, place), faults) {
            let is_deck = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("inp"));
            let mesh = match given {
                Some(bytes) => gmsh::parse(bytes, &file, scale),
                None if is_deck => abaqus::read_within(&path, scale, &self.bounds),
                None => gmsh::read(&path, scale),
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
        self.read.push((path, scale.to_bits(), index));
        index
    }

    /// The surface of an obstacle; `None` with a fault noted if the file can't be read.
    fn surface(&self, record: &Record, faults: &mut Faults) -> Option<TriangleSurface> {
        let (file, scale) = (record.text("file"), record.number("scale")?);
        let place = record.written("file").filter(|_| record.datum("file").is_some())?;
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

fn symmetry(record: &Record) -> Symmetry {
    Symmetry { parts: record.texts("parts"), point: record.spatial("point"), normal: record.spatial("normal") }
}

fn probe(record: &Record, faults: &mut Faults) -> Probe {
    let part = record.text("part");
    let at = if record.written("point").is_some() {
        ProbeAt::Point { part, point: record.spatial("point") }
    } else if record.written("node").is_some() {
        let node = record.integer("node").map_or(0, |node| usize::try_from(node).unwrap_or(usize::MAX));
        ProbeAt::Node { part, node }
    } else {
        if record.written("set").is_none() {
            faults.cover(&record.key("set"));
        }
        ProbeAt::Set { set: record.text("set") }
    };
    Probe { name: record.text("name"), at }
}

fn output(record: &Record) -> Output {
    let default = Output::default();
    let cadence = |name, default| if let Some(Datum::Cadence(cadence)) = record.datum(name) { *cadence } else { default };
    let mirror = record.texts("mirror");
    Output {
        fields: cadence("fields", Cadence::Count(1)),
        history: cadence("history", Cadence::Count(1)),
        hash_steps: record.integer("hash_steps").filter(|&steps| steps > 0),
        include: record.texts("include"),
        mirror: ["x", "y", "z"].map(|axis| mirror.iter().any(|it| it == axis)),
        pictures: if let Some(Datum::Flag(flag)) = record.datum("pictures") { *flag } else { default.pictures },
        picture_field: record.text("picture_field"),
        picture_view: record.table("picture_view").map(|it| PictureView { corner: it.vector("corner"), size: it.vector("size") }),
        camera: record.table("camera").map(camera),
    }
}

fn camera(record: &Record) -> Camera {
    Camera {
        from: record.spatial("from"),
        at: record.written("at").map(|_| record.spatial("at")),
        up: record.spatial("up"),
        zoom: record.number("zoom").unwrap_or(1.0),
    }
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
    let mut taken: BTreeSet<String> = model.obstacles.iter().map(|obstacle| obstacle.name.clone()).collect();
    for obstacle in model.obstacles.iter_mut().filter(|obstacle| obstacle.name.is_empty()) {
        obstacle.name = free("obstacle", &taken);
        taken.insert(obstacle.name.clone());
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
