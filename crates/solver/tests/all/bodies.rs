//! Models in code for the tests: short words for bodies, contacts and runs.
#![allow(clippy::unwrap_used)] // what tests call may stop a test like the tests themselves

use crate::long::is_long;
use embate_solver::error::{Error, Fault};
use embate_solver::model::{
    Contact, Drive, Friction, ImportedMesh, Interface, Load, Material, MeshGroup, Model, Motion, Part, Probe, ProbeAt, Rectangle, Run,
    Shape,
};
use embate_solver::output::Frame;
use embate_solver::simulation::{Control, Observer, ObserverError, Options, Progress, Simulation, State};
use std::sync::Arc;

/// Elastic with Poisson's ratio 0.3.
pub(crate) fn elastic(young: f64, density: f64) -> Material {
    let parameters = [("young", young), ("poisson", 0.3), ("density", density)];
    Material { law: "elastic".into(), parameters: parameters.map(|(key, value)| (key.to_string(), value)).into(), ..Material::default() }
}

/// What is wrong with a model; nothing if a simulation can be made of it.
pub(crate) fn model_faults(model: &Model) -> Vec<Fault> {
    match Simulation::new(model, &Options { threads: 1, simd: None }) {
        Err(Error::Model(faults)) => faults,
        Err(other) => panic!("{other}"),
        Ok(_) => vec![],
    }
}

/// The same in words.
pub(crate) fn faults(model: &Model) -> Vec<String> {
    model_faults(model).iter().map(ToString::to_string).collect()
}

/// A model whose material has no lateral strain: bars in plane strain are uniaxial, and don't grow thicker
/// under compression.
pub(crate) fn slender(end: f64, young: f64, density: f64) -> Model {
    let mut model = model(end);
    let mut material = elastic(young, density);
    material.parameters.insert("poisson".into(), 0.0);
    model.materials.insert("soft".into(), material);
    model
}

/// A model without bodies and a material `soft` with a sound speed of 1160 m/s.
pub(crate) fn model(end: f64) -> Model {
    let mut model = Model { run: Run { end, ..Run::default() }, ..Model::default() };
    model.materials.insert("soft".into(), elastic(1e9, 1e3));
    model.output.pictures = false;
    model
}

pub(crate) fn rectangle(corner: [f64; 2], size: [f64; 2], elements: [usize; 2]) -> Shape {
    Shape::Rectangle(Rectangle { corner, size, elements, ..Rectangle::default() })
}

/// A small block.
pub(crate) fn mapped_rectangle() -> Shape {
    rectangle([0.0, 0.0], [0.08, 0.05], [5, 4])
}

/// Adds a body with a probe of its mean position and velocity.
pub(crate) fn add(model: &mut Model, name: &str, shape: Shape, velocity: [f64; 2]) {
    model.parts.push(Part {
        name: name.into(),
        material: "soft".into(),
        shape,
        velocity: embate_solver::model::in_3d(velocity),
        ..Part::default()
    });
    model.probes.push(Probe { name: name.into(), at: ProbeAt::Set { set: name.into() }, ..Probe::default() });
}

pub(crate) fn probe(model: &mut Model, name: &str, part: &str, point: [f64; 2]) {
    model.probes.push(Probe {
        name: name.into(),
        at: ProbeAt::Point { part: part.into(), point: embate_solver::model::in_3d(point) },
        ..Probe::default()
    });
}

pub(crate) fn touch(model: &mut Model, first: &str, second: &str) {
    let name = format!("{first}-{second}").replace('.', "_");
    model.contacts.push(Contact::between(&name, first, second));
}

pub(crate) fn group(name: &str, dimension: u8, cells: impl Iterator<Item = Vec<u32>>) -> MeshGroup {
    MeshGroup { name: name.into(), dimension, cells: cells.collect() }
}

/// A point in 2D as mesh files have it.
pub(crate) fn in_3d([x, y]: [f64; 2]) -> [f64; 3] {
    [x, y, 0.0]
}

/// Image of a grid on the unit square, as a mesh with the group `body`.
pub(crate) fn mapped([nu, nv]: [usize; 2], place: impl Fn(f64, f64) -> [f64; 2]) -> ImportedMesh {
    let positions = (0..=nv).flat_map(|j| (0..=nu).map(move |i| (i as f64 / nu as f64, j as f64 / nv as f64)));
    let at = |i: usize, j: usize| (j * (nu + 1) + i) as u32;
    let cells = (0..nv).flat_map(|j| (0..nu).map(move |i| vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]));
    let groups = vec![group("body", 2, cells)];
    ImportedMesh {
        source: "test".into(),
        positions: positions.map(|(u, v)| in_3d(place(u, v))).collect(),
        groups,
        ..ImportedMesh::default()
    }
}

/// Image of a grid that closes in its second direction: u around from 0 to 1, v through the wall.
pub(crate) fn closed_ring([through, around]: [usize; 2], place: impl Fn(f64, f64) -> [f64; 2]) -> ImportedMesh {
    let positions = (0..around).flat_map(|j| (0..=through).map(move |i| (j as f64 / around as f64, i as f64 / through as f64)));
    let at = |i: usize, j: usize| (j % around * (through + 1) + i) as u32;
    let cells = (0..around).flat_map(|j| (0..through).map(move |i| vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]));
    let groups = vec![group("body", 2, cells)];
    ImportedMesh {
        source: "test".into(),
        positions: positions.map(|(u, v)| in_3d(place(u, v))).collect(),
        groups,
        ..ImportedMesh::default()
    }
}

/// Adds the body of a mesh.
pub(crate) fn add_mesh(model: &mut Model, name: &str, mesh: ImportedMesh, velocity: [f64; 2]) {
    model.meshes.push(Arc::new(mesh));
    let shape = Shape::Group { mesh: model.meshes.len() - 1, group: "body".into() };
    add(model, name, shape, velocity);
}

/// Adds groups of a mesh as bodies of the same names that share nodes.
pub(crate) fn add_groups(model: &mut Model, mesh: ImportedMesh, names: &[&str], velocity: [f64; 2]) {
    model.meshes.push(Arc::new(mesh));
    for name in names {
        let shape = Shape::Group { mesh: model.meshes.len() - 1, group: (*name).into() };
        add(model, name, shape, velocity);
    }
}

/// The default law with friction.
pub(crate) fn rough(coefficient: f64) -> Interface {
    let friction = Friction { coefficient, dynamic: None, decay: 0.0, viscosity: 0.0, limit: f64::INFINITY };
    Interface { friction: Some(friction), ..Interface::default() }
}

pub(crate) fn gravity(model: &mut Model, acceleration: [f64; 2]) {
    model.loads.push(Load::Gravity { parts: vec![], acceleration: embate_solver::model::in_3d(acceleration), curve: None });
}

/// Makes a part rigid; it may move as `motion` says.
pub(crate) fn stiffen(model: &mut Model, part: &str, motion: Motion) {
    model.parts.iter_mut().find(|it| it.name == part).unwrap().rigid = Some(motion);
}

/// Motion as reported; free where nothing is.
pub(crate) fn driven(velocity: [Option<f64>; 2], spin: Option<f64>) -> Motion {
    Motion { velocity: embate_solver::model::in_3d(velocity.map(|v| v.map(Drive::from))), spin: spin.map(Drive::from) }
}

/// A value of the history now.
pub(crate) fn value(simulation: &Simulation, column: &str) -> f64 {
    let index = simulation.history_columns().iter().position(|it| it == column).unwrap_or_else(|| panic!("no column {column}"));
    simulation.history_row()[index]
}

/// One that has run to its end.
pub(crate) fn to_end(model: &Model) -> Simulation {
    let mut simulation = simulation(model);
    simulation.advance(f64::INFINITY, u64::MAX).unwrap();
    simulation
}

/// The hash at the end of a run on one thread without vectors; that on so many threads with each instruction
/// set has to be the same.
pub(crate) fn hash_of_equal_bits(model: &Model, threads: &[usize], case: &str) -> String {
    let hash = |threads: usize, simd: &str| {
        let options = Options { threads, simd: Some(simd.into()) };
        let mut simulation = Simulation::new(model, &options).unwrap_or_else(|error| panic!("{error}"));
        simulation.advance(f64::INFINITY, u64::MAX).unwrap();
        simulation.summary().state_hash
    };
    let alone = hash(1, "scalar");
    let levels = embate_lanes::Level::available();
    for (place, level) in levels.iter().rev().enumerate() {
        // Threads share the same work whatever computes it: in the short form each set has one of the counts,
        // the best set the largest.
        let last = threads.len() - 1 - place % threads.len();
        for &threads in if is_long() { threads } else { &threads[last..=last] } {
            assert_eq!(hash(threads, level.name()), alone, "{case} {} {threads}", level.name());
        }
    }
    alone
}

/// What is kept of a run now has to continue to this hash at the end, on two threads.
pub(crate) fn continues_to(hash: &str, model: &Model, run: &mut Simulation, case: &str) {
    let state = run.state().unwrap();
    let options = Options { threads: 2, simd: None };
    let mut resumed = Simulation::resumed(model, &options, &state.sections).unwrap_or_else(|error| panic!("{error}"));
    resumed.advance(f64::INFINITY, u64::MAX).unwrap();
    assert_eq!(resumed.summary().state_hash, hash, "{case}: resumed at {} s", run.time());
}

/// Rows of a history by column name.
pub(crate) struct History {
    columns: Vec<String>,
    rows: Vec<Vec<f64>>,
    /// Looks at the progress until the run is stopped, and the state then: with `EMBATE_STOPS` (see
    /// `restart`).
    stops: Option<usize>,
    kept: Option<State>,
}

impl History {
    pub(crate) fn column(&self, name: &str) -> Vec<f64> {
        let at = self.columns.iter().position(|column| column == name).unwrap_or_else(|| panic!("{name}: {:?}", self.columns));
        self.rows.iter().map(|row| row[at]).collect()
    }
    pub(crate) fn first(&self, name: &str) -> f64 {
        self.column(name)[0]
    }
    pub(crate) fn last(&self, name: &str) -> f64 {
        *self.column(name).last().unwrap()
    }
    pub(crate) fn largest(&self, name: &str) -> f64 {
        self.column(name).into_iter().fold(f64::NEG_INFINITY, f64::max)
    }
}

impl Observer for History {
    fn frame(&mut self, _: Frame) -> Result<(), ObserverError> {
        Ok(())
    }
    fn row(&mut self, row: &[f64]) -> Result<(), ObserverError> {
        self.rows.push(row.to_vec());
        Ok(())
    }
    fn state(&mut self, state: State) -> Result<(), ObserverError> {
        self.kept = Some(state);
        Ok(())
    }
    fn progress(&mut self, _: &Progress<'_>) -> Control {
        match &mut self.stops {
            Some(0) => Control::KeepAndStop,
            Some(left) => {
                *left -= 1;
                Control::Continue
            }
            None => Control::Continue,
        }
    }
}

/// One thread, best instruction set.
pub(crate) fn simulation(model: &Model) -> Simulation {
    Simulation::new(model, &Options { threads: 1, simd: None }).unwrap_or_else(|error| panic!("{error}"))
}

pub(crate) fn run(model: &Model) -> (Simulation, History) {
    let mut simulation = simulation(model);
    let mut history = History { columns: simulation.history_columns(), rows: vec![], stops: None, kept: None };
    if std::env::var_os("EMBATE_STOPS").is_none() {
        simulation.run(&mut history).unwrap_or_else(|error| panic!("{error}"));
        return (simulation, history);
    }
    // Stopped again and again: what the test sees is a run that continues with what was kept.
    let mut number = 0;
    loop {
        history.stops = Some(2 + number % 5);
        simulation.run(&mut history).unwrap_or_else(|error| panic!("{error}"));
        let Some(state) = history.kept.take() else { return (simulation, history) };
        let levels = embate_lanes::Level::available();
        let options = Options { threads: 1 + number % 3, simd: Some(levels[number % levels.len()].name().to_string()) };
        simulation = Simulation::resumed(model, &options, &state.sections).unwrap_or_else(|error| panic!("{error}"));
        number += 1;
    }
}

/// The history of a run that fails.
pub(crate) fn run_to_failure(model: &Model) -> (Error, History) {
    let mut simulation = simulation(model);
    let mut history = History { columns: simulation.history_columns(), rows: vec![], stops: None, kept: None };
    let error = simulation.run(&mut history).expect_err("the run fails");
    (error, history)
}

/// The history of every single step, and the mass of each part.
pub(crate) struct Steps {
    history: History,
    pub(crate) masses: Vec<f64>,
}

pub(crate) fn every_step(model: &Model) -> Steps {
    let mut simulation = simulation(model);
    let mut history = History { columns: simulation.history_columns(), rows: vec![simulation.history_row()], stops: None, kept: None };
    while simulation.time() < model.run.end {
        simulation.advance(f64::INFINITY, 1).unwrap_or_else(|error| panic!("{error}"));
        history.rows.push(simulation.history_row());
    }
    Steps { history, masses: simulation.overview().parts.iter().map(|part| part.mass).collect() }
}

impl Steps {
    pub(crate) fn column(&self, name: &str) -> Vec<f64> {
        self.history.column(name)
    }
    /// Σ ½ (dt^n + dt^{n-1}) F^n; the force must be zero in the first and the last step.
    pub(crate) fn impulse(&self, name: &str) -> f64 {
        let (force, step) = (self.column(name), self.column("time_step"));
        assert!(force[0] == 0.0 && force[force.len() - 1] == 0.0, "{name} acts at an end of the run");
        (1..force.len()).map(|n| 0.5 * (step[n] + step[n - 1]) * force[n]).sum()
    }
    pub(crate) fn change(&self, name: &str) -> f64 {
        self.history.last(name) - self.history.first(name)
    }
}
