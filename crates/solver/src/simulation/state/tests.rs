//! Runs on a mesh that is not that of their model: two blocks hit each other, and fail where they are hit.

use super::*;
use crate::model::{Cadence, Contact, Cuboid, Material, Part, Partners, Rectangle, Shape};
use crate::output::{Cells, Frame};
use crate::simulation::{Control, Observer, ObserverError, Progress, Simulation};

fn model(shapes: [Shape; 2], velocity: [f64; 3]) -> Model {
    let parameters = [("young", 1e7), ("poisson", 0.3), ("density", 1000.0), ("yield", 1e5)];
    let soft = Material {
        law: "j2".into(),
        parameters: parameters.map(|(key, value)| (key.to_string(), value)).into(),
        failure: [("plastic_strain".to_string(), 0.05)].into(),
        ..Material::default()
    };
    let part = |(name, shape): (&str, Shape)| Part { name: name.into(), material: "soft".into(), shape, ..Part::default() };
    let mut parts: Vec<Part> = ["under", "above"].into_iter().zip(shapes).map(part).collect();
    parts[1].velocity = velocity;
    let mut model = Model { parts, ..Model::default() };
    let is_solid = model.dimension() == 3;
    if is_solid {
        model.parts.iter_mut().for_each(|part| part.element = "hex8".into());
    }
    model.materials.insert("soft".into(), soft);
    let bodies = Partners::Bodies(Vec::new());
    model.contacts.push(Contact { name: "all".into(), partners: bodies, ..Contact::default() });
    (model.run.end, model.run.energy_limit) = (0.2, 10.0);
    model
}

fn plane(elements: usize) -> Model {
    let block = |corner, size, elements| Rectangle { corner, size, elements, ..Rectangle::default() }.into();
    let under = block([0.0, 0.0], [2.0, 1.0], [2 * elements, elements]);
    model([under, block([0.6, 1.01], [0.7, 1.0], [elements, elements + 1])], [0.0, -20.0, 0.0])
}

fn space(elements: usize) -> Model {
    let block = |corner, size, elements| Cuboid { corner, size, elements, ..Cuboid::default() }.into();
    let under = block([0.0; 3], [2.0, 2.0, 1.0], [2 * elements, 2 * elements, elements]);
    model([under, block([0.6, 0.5, 1.01], [0.7, 0.8, 1.0], [elements; 3])], [0.0, 0.0, -20.0])
}

/// A run of a model on the mesh of another one.
fn remeshed<const D: usize>(model: &Model, other: &Model) -> Run<D>
where
    Dim<D>: Runs<D>,
{
    let mut mesh = Mesh::new(other).unwrap();
    mesh.revision = 1;
    Run::on(model, Some(mesh), &Options::default()).unwrap()
}

fn a_state_brings_its_mesh<const D: usize>(coarse: &Model, fine: &Model)
where
    Dim<D>: Runs<D>,
{
    let mut run = remeshed::<D>(coarse, fine);
    let mut own = Run::<D>::new(fine, &Options::default()).unwrap();
    run.advance(0.02, u64::MAX).unwrap();
    own.advance(0.02, u64::MAX).unwrap();
    assert_eq!(run.hashes().parts, own.hashes().parts, "the mesh counts, not where it is from");
    assert!(run.elements() > Run::<D>::new(coarse, &Options::default()).unwrap().elements());
    assert!(run.system.erosion.is_some() && run.system.mesh.groups.iter().any(|group| !group.eroded.is_empty()), "something failed");

    let state = run.state().unwrap();
    assert_eq!(state.sections[0].name, "mesh");
    assert!(own.state().unwrap().sections.iter().all(|section| section.name != "mesh"));
    let mut other = Run::<D>::resumed(coarse, &Options::default(), &state.sections).unwrap();
    assert_eq!((other.cells(), other.known_cells), (run.cells(), 1));
    assert_eq!(other.state().unwrap(), state);
    run.advance(0.1, u64::MAX).unwrap();
    other.advance(0.1, u64::MAX).unwrap();
    assert!(run.steps() > state.step + 20);
    assert_eq!(other.hashes(), run.hashes());

    assert!(Run::<D>::resumed(coarse, &Options::default(), &state.sections[1..]).is_err(), "without its mesh it is of another model");
    let mut damaged = state.sections.clone();
    for at in (0..damaged[0].bytes.len()).step_by(damaged[0].bytes.len() / 200) {
        damaged[0].bytes[at] ^= 0x40;
        // A position may be any number; nothing panics.
        let _ = Mesh::<D>::of_state(&damaged);
        damaged[0].bytes.clone_from(&state.sections[0].bytes);
    }
    damaged[0].bytes.pop();
    assert!(Mesh::<D>::of_state(&damaged).is_err());
}

#[test]
fn a_state_in_2d_has_the_mesh_that_is_not_the_models() {
    a_state_brings_its_mesh::<2>(&plane(2), &plane(4));
}

#[test]
fn a_state_in_3d_has_the_mesh_that_is_not_the_models() {
    a_state_brings_its_mesh::<3>(&space(1), &space(2));
}

#[test]
fn a_simulation_resumes_on_another_mesh_than_its_models() {
    let mut run = remeshed::<2>(&plane(2), &plane(4));
    run.advance(0.01, u64::MAX).unwrap();
    let simulation = Simulation::resumed(&plane(2), &Options::default(), &run.state().unwrap().sections).unwrap();
    assert_eq!((simulation.cells(), simulation.hashes()), (run.cells(), run.hashes()));
}

/// What observers are given: cells, and how many nodes and values each frame has.
#[derive(Default)]
struct Given {
    cells: Vec<(usize, Cells)>,
    frames: Vec<[usize; 2]>,
    /// How often cells had been given when each state came.
    states: Vec<usize>,
}

impl Observer for Given {
    fn frame(&mut self, frame: Frame) -> Result<(), ObserverError> {
        let values = frame.fields.iter().find(|field| field.kind.name == "von_mises").unwrap().values.len();
        self.frames.push([frame.nodes(), values]);
        Ok(())
    }
    fn cells(&mut self, cells: Cells) -> Result<(), ObserverError> {
        self.cells.push((self.frames.len(), cells));
        Ok(())
    }
    fn row(&mut self, _: &[f64]) -> Result<(), ObserverError> {
        Ok(())
    }
    fn keeps_states(&self) -> bool {
        true
    }
    fn state(&mut self, _: State) -> Result<(), ObserverError> {
        self.states.push(self.cells.len());
        Ok(())
    }
    fn progress(&mut self, _: &Progress<'_>) -> Control {
        Control::Continue
    }
}

#[test]
fn an_observer_is_given_other_cells_once_before_their_first_frame_or_state() {
    let mut model = plane(2);
    (model.output.fields, model.run.checkpoint_steps) = (Cadence::Count(10), Some(1));
    let mut run = Run::<2>::new(&model, &Options::default()).unwrap();
    let mut given = Given::default();
    run.run(0.07, u64::MAX, &mut given).unwrap();
    let (before, count) = (given.frames.clone(), run.cells().len());
    let states = given.states.len();
    assert!(given.cells.is_empty() && before.len() == 4, "the cells of the start were known: {before:?}");
    // As if it had been meshed again here.
    let mut other = remeshed::<2>(&model, &plane(4));
    other.advance(run.time(), u64::MAX).unwrap();
    run.system = other.system;
    run.recorded = other.recorded;
    run.run(f64::INFINITY, u64::MAX, &mut given).unwrap();
    let now = run.cells();
    assert_eq!(given.cells, [(4, now.clone())]);
    assert!(given.states.len() > states + 20 && given.states[..states].iter().all(|&cells| cells == 0));
    assert!(given.states[states..].iter().all(|&cells| cells == 1));
    assert!(given.frames.len() >= 10 && now.len() > count);
    let nodes = now.nodes.iter().max().unwrap() + 1;
    assert_eq!(given.frames[..4], before);
    assert!(given.frames[4..].iter().all(|frame| *frame == [nodes as usize, now.len()]));
}
