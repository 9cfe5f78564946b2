//! A run that is stopped and continues with its kept state is the run that was never stopped, to the last
//! bit: for every entry of every registry, on any number of threads and instruction set.
//!
//! With the environment variable `EMBATE_STOPS` every run of every other test here that goes through `bodies`
//! is stopped and continues several times, too (`bodies::run`).

use crate::bodies::*;
use crate::contact::scenes;
use crate::erosion::{bullet, torn_bar};
use crate::long::is_long;
use crate::patches::{YOUNG, lists, nodes_of, options, parameters};
use crate::self_contact::{all, crushed_ring};
use embate_lanes::Level;
use embate_solver::archive::Section;
use embate_solver::contact::search::registry;
use embate_solver::element::{BARS, ELEMENTS};
use embate_solver::error::Error;
use embate_solver::failure::CRITERIA;
use embate_solver::material::eos::EQUATIONS;
use embate_solver::material::{LAWS, equation_of_state};
use embate_solver::model::*;
use embate_solver::output::{Frame, Shown, Summary};
use embate_solver::quantity::Parameter;
use embate_solver::simulation::{Control, Observer, ObserverError, Options, Progress, Simulation, State};
use embate_solver::stress_state::STRESS_STATES;

/// All that a run reports, as bits.
#[derive(Default)]
struct Told {
    rows: Vec<Vec<u64>>,
    frames: Vec<Vec<u64>>,
    states: Vec<State>,
    /// Rows and frames until each state.
    counts: Vec<[usize; 2]>,
}

fn bits<'a>(values: impl IntoIterator<Item = &'a f64>) -> Vec<u64> {
    values.into_iter().map(|value| value.to_bits()).collect()
}

fn seen(frame: &Frame) -> Vec<u64> {
    let mut all = vec![frame.step, frame.time.to_bits()];
    all.extend(bits(frame.positions::<2>().iter().flatten()));
    frame.fields.iter().for_each(|field| all.extend(bits(&field.values)));
    frame.outlines.iter().for_each(|outline| all.extend(bits(outline.points.iter().flatten())));
    all
}

/// The frame of what is shown, whose pieces are the same.
fn framed(shown: &dyn Shown) -> Frame {
    let mut frame = Frame::default();
    shown.fill(&mut frame);
    assert_eq!((shown.time(), shown.step(), shown.dimension(), shown.nodes()), (frame.time, frame.step, frame.dimension, frame.nodes()));
    let (mut piece, mut all) = (vec![1.0], Vec::new());
    let mut in_pieces = |count: usize, take: &dyn Fn(std::ops::Range<usize>, &mut Vec<f64>)| {
        all.clear();
        for first in (0..count).step_by(7) {
            take(first..(first + 7).min(count), &mut piece);
            all.extend_from_slice(&piece);
        }
        bits(&all)
    };
    assert_eq!(in_pieces(frame.nodes(), &|nodes, piece| shown.coordinates(nodes, piece)), bits(&frame.coordinates));
    assert_eq!(shown.kinds().len(), frame.fields.len());
    for (number, (kind, field)) in shown.kinds().into_iter().zip(&frame.fields).enumerate() {
        assert_eq!((kind, shown.numbers(number)), (field.kind, field.values.len()));
        let places = field.values.len() / kind.width();
        assert_eq!(in_pieces(places, &|places, piece| shown.values(number, places, piece)), bits(&field.values), "{}", kind.name);
    }
    assert_eq!(shown.outlined().outlines, frame.outlines);
    assert!(frame.outlines.is_empty() || shown.outlined().coordinates == frame.coordinates);
    frame
}

impl Observer for Told {
    fn show(&mut self, shown: &dyn Shown) -> Result<(), ObserverError> {
        self.frame(framed(shown))
    }
    fn frame(&mut self, frame: Frame) -> Result<(), ObserverError> {
        self.frames.push(seen(&frame));
        Ok(())
    }
    fn row(&mut self, row: &[f64]) -> Result<(), ObserverError> {
        self.rows.push(bits(row));
        Ok(())
    }
    fn keeps_states(&self) -> bool {
        true
    }
    fn state(&mut self, state: State) -> Result<(), ObserverError> {
        self.states.push(state);
        self.counts.push([self.rows.len(), self.frames.len()]);
        Ok(())
    }
    fn progress(&mut self, _: &Progress<'_>) -> Control {
        Control::Continue
    }
}

/// What a summary says, without the machine.
fn figures(simulation: &Simulation) -> Summary {
    Summary { threads: 0, simd: String::new(), ..simulation.summary() }
}

fn reported(mut simulation: Simulation) -> (Simulation, Told, Option<Error>) {
    let mut reported = Told::default();
    let error = simulation.run(&mut reported).err();
    (simulation, reported, error)
}

/// Options in turn: threads and instruction sets.
fn other(number: usize) -> Options {
    let levels = Level::available();
    Options { threads: 1 + number % 3, simd: Some(levels[number % levels.len()].name().to_string()) }
}

/// Holds runs that continue against one that was never stopped: `steps` steps of the model, stopped at some
/// of them.
pub(crate) fn continues(what: &str, model: &Model, steps: u64) {
    let mut model = model.clone();
    model.run.max_steps = Some(steps);
    // Neither divides the other, nor the stages of a run.
    (model.output.history, model.output.fields) = (Cadence::Count(37), Cadence::Count(11));
    model.run.energy_limit = 10.0;
    let start =
        |model: &Model| Simulation::new(model, &Options { threads: 1, simd: None }).unwrap_or_else(|error| panic!("{what}: {error}"));
    let (whole, expected, error) = reported(start(&model));
    model.run.checkpoint_steps = Some((whole.steps() / 3).max(1));
    let (again, kept, _) = reported(start(&model));
    assert!(kept.rows == expected.rows && kept.frames == expected.frames, "{what}: a state that is handed out leaves a trace");
    assert!(figures(&again) == figures(&whole), "{what}: {:?} {:?}", figures(&again), figures(&whole));
    assert!(kept.states.len() >= 2, "{what}: {} steps", whole.steps());
    for (number, (state, [rows, frames])) in kept.states.iter().zip(&kept.counts).enumerate() {
        // In the short form the second one.
        if !is_long() && number != 1 {
            continue;
        }
        let resumed = || Simulation::resumed(&model, &other(number), &state.sections).unwrap_or_else(|error| panic!("{what}: {error}"));
        let mut here = resumed();
        assert_eq!((here.steps(), here.time().to_bits()), (state.step, state.time.to_bits()), "{what}");
        assert!(here.state().unwrap() == *state, "{what}: what is kept of it is the same");
        // What it would show now is the same, too.
        let mut there = start(&model);
        there.advance(f64::INFINITY, state.step).unwrap();
        assert_eq!(seen(&here.frame()), seen(&there.frame()), "{what}: frame at step {}", state.step);
        assert_eq!(bits(&here.history_row()), bits(&there.history_row()), "{what}: row at step {}", state.step);
        let (end, rest, end_error) = reported(resumed());
        assert_eq!(end_error, error, "{what}");
        assert!(rest.rows == expected.rows[*rows..], "{what}: rows from step {}", state.step);
        assert!(rest.frames == expected.frames[*frames..], "{what}: frames from step {}", state.step);
        assert!(figures(&end) == figures(&whole), "{what}: {:?} {:?}", figures(&end), figures(&whole));
    }
}

/// A block of some element and law that is driven and turns while it is squeezed between an obstacle and its
/// inertia.
fn block(element: &str, material: Material, state: &str) -> Model {
    let mut model = model(1.0);
    let speed = (YOUNG / 2.0_f64).sqrt();
    model.run.end = 8.0 / speed;
    model.materials.insert("soft".into(), material);
    let mut mesh = mapped([6, 5], |u, v| [0.5 + u + 0.03 * (7.0 * v).sin(), 1.01 * v + 0.02 * (5.0 * u).sin()]);
    if nodes_of(element) != 4 {
        let halves = |cell: &Vec<u32>| [vec![cell[0], cell[1], cell[2]], vec![cell[0], cell[2], cell[3]]];
        mesh.groups[0].cells = mesh.groups[0].cells.iter().flat_map(halves).collect();
    }
    add_mesh(&mut model, "block", mesh, [0.0, -0.05 * speed]);
    let part = &mut model.parts[0];
    part.stress_state = state.into();
    if nodes_of(element) != 4 {
        part.element_triangles = element.into()
    } else {
        part.element = element.into()
    }
    if !part.is_axisymmetric() {
        part.spin = 0.02 * speed;
    }
    model.obstacles.push(Obstacle::wall("floor", [0.0, -0.03], [0.0, 1.0]));
    model
}

fn elastic_of_patches() -> Material {
    of_law("elastic", &[])
}

fn of_law(name: &str, more: &[(&str, f64)]) -> Material {
    let kind = LAWS.iter().find(|kind| kind.name == name).unwrap();
    let mut material = Material { law: name.into(), parameters: parameters(kind, 0.3), lists: lists(kind), ..Material::default() };
    material.parameters.extend(more.iter().map(|&(key, value)| (key.to_string(), value)));
    material
}

#[test]
fn runs_of_every_law_continue() {
    for kind in LAWS.iter().filter(|law| equation_of_state(law.name).is_some_and(|[needs, _]| !needs)) {
        for more in options(kind) {
            continues(&format!("{} {more:?}", kind.name), &block("quad4", of_law(kind.name, &more), ""), 90);
        }
    }
}

#[test]
fn runs_of_every_equation_of_state_continue() {
    // Pressures of the order of YOUNG; a new equation is met with what its parameters are by themselves.
    let value = |parameter: &Parameter| match parameter.name {
        "gamma" => 1.4,
        "pressure_initial" | "energy_initial" => 100.0,
        "c0" => 30.0,
        "r1" => 4.0,
        "pressure_b" => 10.0,
        name if name.starts_with("s") || name.starts_with("gamma") || name == "omega" || name == "r2" => 0.5,
        _ => parameter.default.unwrap_or(YOUNG),
    };
    for equation in EQUATIONS {
        let numbers = equation
            .parameters
            .iter()
            .filter(|parameter| parameter.list == 0 && (parameter.default.is_none() || parameter.name == "pressure_initial"));
        let numbers = numbers.map(|parameter| (parameter.name.to_string(), value(parameter)));
        let lists = equation
            .parameters
            .iter()
            .filter(|parameter| parameter.list > 0)
            .map(|parameter| (parameter.name.to_string(), vec![0.0, YOUNG]));
        let mut material = Material {
            law: "null".into(),
            eos: equation.name.into(),
            parameters: numbers.collect(),
            lists: lists.collect(),
            ..Material::default()
        };
        material.parameters.insert("density".into(), 2.0);
        let mut model = block("quad4", material, "");
        model.parts[0].spin = 0.0;
        model.run.bulk_viscosity = [0.06, 1.2];
        continues(equation.name, &model, 60);
    }
}

#[test]
fn runs_of_every_element_and_stress_state_continue() {
    for element in ELEMENTS {
        for state in STRESS_STATES {
            for law in ["j2", "neo_hookean"] {
                let mut model = block(element.name, of_law(law, &[]), state.name);
                if law == "j2" {
                    model.run.bulk_viscosity = [0.06, 1.2];
                    model.loads.push(Load::StiffnessDamping { parts: vec![], time: 1e-3 });
                }
                if Simulation::new(&model, &Options { threads: 1, simd: None }).is_ok() {
                    continues(&format!("{} {} {law}", element.name, state.name), &model, 60);
                } else {
                    assert_eq!(state.name, "plane_stress", "{} {law}", element.name);
                }
            }
        }
    }
}

#[test]
fn runs_of_bars_springs_and_point_masses_continue() {
    for bar in BARS {
        let mut model = block("quad4", elastic_of_patches(), "");
        let lines = vec![vec![[0.5, 1.2], [1.0, 1.9], [1.5, 1.2]], vec![[1.0, 1.9], [1.0, 2.6]]];
        let shape = Shape::Truss(Truss { lines, elements: 3 });
        let material = of_law("j2", &[]);
        model.materials.insert("bars".into(), material);
        model.materials.get_mut("bars").unwrap().failure.insert("plastic_strain".into(), 0.01);
        let part = Part {
            name: "truss".into(),
            material: "bars".into(),
            element: bar.name.into(),
            area: Some(0.1),
            shape,
            velocity: [0.0, 3.0, 0.0],
            ..Part::default()
        };
        model.parts.push(part);
        model.point_masses.push(PointMass { on: "truss".into(), mass: 1.0 });
        let between = ["truss.point0".to_string(), "block".to_string()];
        model.springs.push(Spring { between: between.clone(), stiffness: 30.0, damping: 0.5, strength: Some(2.0), ..Spring::default() });
        let curve = Spring { elongation: vec![-0.1, 0.0, 0.2], force: vec![-3.0, 0.0, 1.0], ..Spring::default() };
        model.springs.push(Spring { between, ..curve });
        continues(bar.name, &model, 90);
    }
}

#[test]
fn runs_of_every_contact_continue() {
    let soft_layer = ContactLaw::PressureGap { gaps: vec![-1e-3, -2e-4, 1e-4], pressures: vec![3e8, 2e7, 0.0] };
    let laws = [ContactLaw::default(), soft_layer, ContactLaw::Multiplier];
    let friction = Friction { coefficient: 0.3, dynamic: Some(0.2), decay: 0.1, viscosity: 0.0, limit: f64::INFINITY };
    let formulations = [Formulation::DoublePass, Formulation::SinglePass { slave: 1 }, Formulation::Segment, Formulation::Pinball];
    for formulation in formulations {
        for (number, law) in laws.iter().enumerate() {
            for (at, (name, mut model, _)) in scenes().into_iter().enumerate() {
                // The scenes take turns: each formulation and each law meets them all.
                if at % 3 != number % 3 && at != 0 {
                    continue;
                }
                for contact in &mut model.contacts {
                    contact.formulation = formulation;
                    contact.interface = Interface { law: law.clone(), friction: (at % 2 == 0).then_some(friction), ..Interface::default() };
                }
                continues(&format!("{formulation:?} {law:?} {name}"), &model, 400);
            }
        }
    }
}

#[test]
fn runs_with_every_search_continue() {
    for search in registry::<2>() {
        let (_, mut model, _) = scenes().swap_remove(1);
        for contact in &mut model.contacts {
            contact.search = search.name.into();
        }
        continues(search.name, &model, 500);
    }
}

#[test]
fn runs_of_bodies_in_themselves_continue() {
    for formulation in [Formulation::DoublePass, Formulation::Segment, Formulation::Pinball] {
        let mut model = crushed_ring();
        model.parts.iter_mut().filter(|part| part.name != "ring").for_each(|plate| plate.velocity[1] *= 8.0);
        model.contacts[0].formulation = formulation;
        model.contacts[0].interface.thickness = 1e-4;
        continues(&format!("{formulation:?}"), &model, 900);
    }
}

#[test]
fn runs_in_which_elements_are_eroded_continue() {
    for formulation in [Formulation::DoublePass, Formulation::Segment, Formulation::Pinball] {
        let mut model = bullet([6, 60]);
        model.contacts[0].formulation = formulation;
        model.contacts[0].interface.friction = rough(0.2).friction;
        model.obstacles.push(Obstacle::wall("behind", [0.03, 0.0], [-1.0, 0.0]));
        let (whole, _, _) = reported(simulation(&model));
        assert!(whole.summary().erosion.is_some());
        continues(&format!("{formulation:?}"), &model, whole.steps());
    }
    for kind in CRITERIA {
        let limit = match kind.limit.name {
            "plastic_strain" => 0.1,
            "principal_stress" => 3e8,
            "time_step" => 5e-7,
            _ => continue,
        };
        continues(kind.limit.name, &torn_bar(&[(kind.limit.name, limit)]), 250);
    }
    // All elements of a part, and of whole chunks, are gone.
    let mut model = torn_bar(&[("plastic_strain", 0.02)]);
    model.parts[1].material = "weak".into();
    all(&mut model);
    continues("all of it", &model, 300);
}

#[test]
fn runs_with_steps_by_nodes_continue() {
    let by_nodes = |mut model: Model| {
        model.run.stable_step = StableStep::Nodes;
        model
    };
    for element in ["quad4", "quad4_reduced_viscous", "tri3_anp"] {
        let mut model = by_nodes(block(element, elastic_of_patches(), "plane_strain"));
        model.run.bulk_viscosity = [0.06, 1.2];
        continues(element, &model, 200);
    }
    let mut model = by_nodes(bullet([6, 60]));
    let (whole, _, _) = reported(simulation(&model));
    assert!(whole.summary().erosion.is_some());
    continues("bullet", &model, whole.steps());
    model.run.safety = 0.5;
    continues("bullet, short", &model, 300);
}

#[test]
fn runs_with_steps_by_the_assembled_mesh_continue() {
    for (element, viscosity) in [("quad4", [0.0; 2]), ("quad4_reduced_viscous", [0.06, 1.2]), ("tri3_anp", [0.0; 2])] {
        let mut model = block(element, elastic_of_patches(), "plane_strain");
        (model.run.stable_step, model.run.bulk_viscosity) = (StableStep::Assembled, viscosity);
        continues(element, &model, 400);
    }
    let mut model = bullet([6, 60]);
    model.run.stable_step = StableStep::Assembled;
    let (whole, _, _) = reported(simulation(&model));
    assert!(whole.summary().erosion.is_some());
    continues("bullet", &model, whole.steps());
}

#[test]
fn runs_of_ties_that_break_and_contacts_that_begin_later_continue() {
    for formulation in [Formulation::DoublePass, Formulation::SinglePass { slave: 1 }, Formulation::Segment] {
        for (active, strength) in [([0.0, f64::INFINITY], f64::INFINITY), ([0.0, 4e-4], 2e6), ([1e-4, 5e-4], 2e6)] {
            let mut model = model(1e-3);
            add(&mut model, "left", rectangle([0.0, 0.0], [0.1, 0.1], [6, 6]), [-3.0, 0.0]);
            add(&mut model, "right", rectangle([0.1, -0.01], [0.12, 0.12], [9, 7]), [3.0, 1.0]);
            let interface = Interface { active, ..rough(0.3) };
            model.contacts.push(Contact { formulation, tied: Some(strength), interface, ..Contact::between("tie", "left", "right") });
            continues(&format!("{formulation:?} {active:?} {strength}"), &model, 220);
        }
    }
}

#[test]
fn runs_against_every_obstacle_continue() {
    let shapes = [
        ObstacleShape::Plane { point: [0.05, -0.006, 0.0], normal: [0.1, 1.0, 0.0], length: None },
        ObstacleShape::Plane { point: [0.05, -0.0008, 0.0], normal: [0.0, 1.0, 0.0], length: Some(0.12) },
        ObstacleShape::Circle { centre: [0.05, -0.301, 0.0], radius: 0.3, hollow: false },
        ObstacleShape::Circle { centre: [0.052, -0.0045, 0.0], radius: 0.004, hollow: false },
        ObstacleShape::Circle { centre: [0.05, 0.05, 0.0], radius: 0.0712, hollow: true },
        ObstacleShape::Polyline { points: vec![[-0.2, -0.1], [0.049, -0.001], [0.2, -0.1], [-0.2, -0.1]] },
    ];
    for (number, shape) in shapes.into_iter().enumerate() {
        let mut model = model(2e-3);
        add(&mut model, "block", rectangle([0.0, 0.0], [0.1, 0.1], [5, 5]), [1.0, -9.0]);
        let mut obstacle = Obstacle { interface: rough(0.3), ..Obstacle::fixed("obstacle", shape) };
        if number % 2 == 0 {
            (obstacle.motion, obstacle.mass, obstacle.inertia, obstacle.spin) = (Motion::default(), Some(30.0), Some(0.2), 1.0);
        } else {
            model.curves.insert("up".into(), Curve::table(vec![0.0, 1e-4, 1e-3], vec![0.0, 2.0, -1.0]));
            obstacle.motion.velocity[1] = Some(Drive::Curve("up".into()));
        }
        model.obstacles.push(obstacle);
        continues(&format!("{:?}", model.obstacles[0].shape), &model, 300);
    }
}

#[test]
fn runs_with_loads_rigid_parts_joins_and_relaxation_continue() {
    let mut model = model(2e-3);
    add(&mut model, "block", rectangle([0.0, 0.0], [0.1, 0.1], [5, 5]), [1.0, -3.0]);
    add(&mut model, "rider", rectangle([0.0, 0.1], [0.1, 0.04], [5, 2]), [0.0, 0.0]);
    add(&mut model, "wheel", Shape::Disk(Disk { centre: [0.05, -0.031], radius: 0.03, elements: 3 }), [0.0, 0.0]);
    stiffen(&mut model, "wheel", driven([None, Some(0.0)], None));
    all(&mut model);
    model.contacts[0].interface.friction = rough(0.3).friction;
    model.joins.push(Join { between: ["block.top".into(), "rider.bottom".into()], ..Join::default() });
    model.curves.insert("wave".into(), Curve::from(CurveShape::Expression("sin(3000*t)".into())));
    let wave = || Some("wave".to_string());
    model.loads.push(Load::Gravity { parts: vec![], acceleration: [0.0, -200.0, 0.0], curve: wave() });
    model.loads.push(Load::Damping { parts: vec!["rider".into()], rate: 300.0, active: [2e-4, 6e-4] });
    model.loads.push(Load::Force { on: "rider.right".into(), force: [-2e3, 0.0, 0.0], curve: wave() });
    model.loads.push(Load::Pressure { on: "rider.top".into(), pressure: 1e5, curve: wave() });
    model.constraints.push(Constraint {
        on: "rider.left".into(),
        acceleration: [Some(Drive::Curve("wave".into())), None, None],
        ..Constraint::default()
    });
    model.non_reflecting.push(NonReflecting { on: "block.left".into() });
    model.parts[0].stress_initial = Some(InitialStress::uniform([-1e5, 0.0, 0.0, 0.0]));
    continues("loads", &model, 250);
    model.run.relaxation = Some(Relaxation { tolerance: 1e-2, from: 0.0 });
    model.joins.clear();
    continues("relaxation", &model, 250);
}

#[test]
fn runs_in_a_plane_of_symmetry_continue() {
    let mut model = model(2e-3);
    add(&mut model, "block", rectangle([0.0, 0.0], [0.1, 0.02], [10, 3]), [0.0, 4.0]);
    add(&mut model, "ball", Shape::Disk(Disk { centre: [0.05, 0.051], radius: 0.03, elements: 3 }), [-30.0, -12.0]);
    model.symmetries.push(Symmetry { normal: [1.0, 0.0, 0.0], ..Symmetry::default() });
    all(&mut model);
    continues("mirror", &model, 400);
}

/// Many elements, so that threads share the work.
#[test]
fn large_runs_continue_with_another_number_of_threads() {
    for formulation in [Formulation::DoublePass, Formulation::Pinball] {
        let mut model = model(1e-3);
        add(&mut model, "left", rectangle([0.0, 0.0], [0.1, 0.1], [46, 46]), [18.0, 3.0]);
        add(&mut model, "right", rectangle([0.1001, 0.01], [0.1, 0.1], [46, 46]), [-12.0, -6.0]);
        model.materials.insert("soft".into(), of_metal());
        all(&mut model);
        model.contacts[0].formulation = formulation;
        continues(&format!("{formulation:?}"), &model, 45);
    }
}

fn of_metal() -> Material {
    let parameters = [("young", 1e9), ("poisson", 0.3), ("density", 1e3), ("yield", 1e6), ("hardening", 1e7)];
    let mut material =
        Material { law: "j2".into(), parameters: parameters.map(|(key, value)| (key.to_string(), value)).into(), ..Material::default() };
    material.failure.insert("plastic_strain".into(), 0.02);
    material
}

#[test]
fn a_state_of_another_model_or_with_pieces_missing_is_refused_and_none_makes_a_panic() {
    let (_, model, _) = scenes().swap_remove(0);
    let mut simulation = simulation(&model);
    simulation.advance(f64::INFINITY, 150).unwrap();
    let state = simulation.state().unwrap();
    let try_it = |model: &Model, sections: &[Section]| Simulation::resumed(model, &Options { threads: 1, simd: None }, sections).err();
    assert_eq!(try_it(&model, &state.sections), None);
    let refused = |model: &Model, sections: &[Section]| matches!(try_it(model, sections), Some(Error::State(_)));
    let mut finer = model.clone();
    finer.parts[0].shape = rectangle([0.0, 0.0], [0.1, 0.1], [7, 6]);
    assert!(refused(&finer, &state.sections));
    let mut other = model.clone();
    other.contacts.clear();
    assert!(refused(&other, &state.sections));
    assert!(refused(&model, &state.sections[1..]) && refused(&model, &state.sections[..3]));
    // Whatever stands there: an answer, or a run that may fail but does not panic in making it ready.
    for (number, section) in state.sections.iter().enumerate() {
        let size = section.bytes.len();
        for at in (0..size).step_by((size / 40).max(1)) {
            for byte in [0xff, 0x80, 0x01] {
                let mut sections = state.sections.clone();
                sections[number].bytes[at] ^= byte;
                let _ = try_it(&model, &sections);
            }
            let mut sections = state.sections.clone();
            sections[number].bytes.truncate(at);
            assert!(refused(&model, &sections), "{} cut at {at}", section.name);
        }
    }
}

#[test]
fn a_run_that_continues_may_end_later_than_it_was_meant_to() {
    let (_, mut model, _) = scenes().swap_remove(0);
    let end = model.run.end;
    model.run.safety = 0.2;
    let (whole, expected, _) = reported(simulation(&model));
    model.run.end = 0.5 * end;
    (model.output.history, model.output.fields) = (Cadence::Interval(end / 1000.0), Cadence::Interval(end / 100.0));
    // Before the last steps, which meet the end with equal ones.
    model.run.checkpoint_steps = Some(20);
    let (_, kept, _) = reported(simulation(&model));
    let (first, counts) = (&kept.states[0], kept.counts[0]);
    model.run.end = end;
    let (later, rest, _) = reported(Simulation::resumed(&model, &other(1), &first.sections).unwrap());
    assert_eq!(later.summary().state_hash, whole.summary().state_hash);
    let frames: Vec<_> = kept.frames[..counts[1]].iter().chain(&rest.frames).cloned().collect();
    assert!(frames == expected.frames && kept.rows[..counts[0]].iter().chain(&rest.rows).eq(&expected.rows));
}

#[test]
fn a_window_shows_the_steps_of_the_whole_run() {
    let (_, model, _) = scenes().swap_remove(0);
    let (from, to) = (0.3 * model.run.end, 0.35 * model.run.end);
    let mut every = Vec::new();
    let mut whole = simulation(&model);
    while whole.time() < to * (1.0 - 1e-12) {
        whole.advance(f64::INFINITY, 1).unwrap();
        if whole.time() >= from {
            every.push(seen(&whole.frame()));
        }
    }
    let mut start = simulation(&model);
    start.advance(f64::INFINITY, 20).unwrap();
    let mut window = Simulation::resumed(&model, &other(1), &start.state().unwrap().sections).unwrap();
    let mut reported = Told::default();
    window.run_window([from, to], 1e-9, &mut reported).unwrap();
    assert_eq!(window.summary().state_hash, whole.summary().state_hash);
    assert!(reported.frames == every && reported.rows.len() == every.len(), "{} {}", reported.frames.len(), every.len());
}
