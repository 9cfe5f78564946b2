//! Velocities at the start: spins about any axis and point, and velocities away from a point or an axis,
//! against closed forms of the lumped masses.

use crate::bodies::{every_step, model_faults, simulation, value};
use crate::patches::{DENSITY, material};
use embate_solver::model::{Cuboid, Model, Motion, Part, Probe, ProbeAt, RadialVelocity, Rectangle, Ring, Run, Shape, ShellSection};

type Vector = [f64; 3];

fn model(element: &str, shape: Shape, end: f64) -> Model {
    Model {
        name: "body".into(),
        run: Run { end, ..Run::default() },
        materials: [("m".to_string(), material("elastic", 0.3))].into(),
        parts: vec![Part { name: "body".into(), material: "m".into(), element: element.into(), shape, ..Part::default() }],
        probes: vec![Probe { name: "body".into(), at: ProbeAt::Set { set: "body".into() }, ..Probe::default() }],
        ..Model::default()
    }
}

const SIZE: Vector = [1.0, 0.3, 0.2];
const ELEMENTS: [usize; 3] = [5, 3, 2];
const CORNER: Vector = [0.4, -0.2, 0.1];

fn cuboid() -> Shape {
    Shape::Cuboid(Cuboid { corner: CORNER, size: SIZE, elements: ELEMENTS, ..Cuboid::default() })
}

fn mass() -> f64 {
    DENSITY * SIZE.iter().product::<f64>()
}

/// From a point to the centre of the box.
fn arm(from: Vector) -> Vector {
    [0, 1, 2].map(|d| CORNER[d] + 0.5 * SIZE[d] - from[d])
}

/// Σ m x² over the mass of the nodes of the box about its centre: ℓ²/12 + h²/6 with elements of length h.
fn spread() -> Vector {
    [0, 1, 2].map(|d| SIZE[d] * SIZE[d] / 12.0 * (1.0 + 2.0 / (ELEMENTS[d] * ELEMENTS[d]) as f64))
}

fn dot(a: Vector, b: Vector) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn kinetic(model: &Model) -> f64 {
    every_step(model).column("energy.kinetic")[0]
}

fn near(found: f64, wanted: f64, what: &str) {
    assert!((found / wanted - 1.0).abs() < 1e-12, "{what}: {found} for {wanted}");
}

#[test]
fn a_box_spins_about_any_axis_through_any_point() {
    let axis = [1.0, 2.0, -0.5];
    let omega = axis.map(|a| 1e-3 * a / dot(axis, axis).sqrt());
    let second = spread();
    let own = 0.5 * mass() * (0..3).map(|d| omega[d] * omega[d] * (second[(d + 1) % 3] + second[(d + 2) % 3])).sum::<f64>();
    let point = [0.3, 0.5, -0.7];
    let centre = cross(omega, arm(point));
    for rigid in [None, Some(Motion::default())] {
        let mut model = model("hex8", cuboid(), 2.0);
        (model.parts[0].spin, model.parts[0].spin_axis, model.parts[0].rigid) = (1e-3, axis, rigid);
        near(kinetic(&model), own, "about the centre");
        model.parts[0].spin_centre = Some(point);
        near(kinetic(&model), own + 0.5 * mass() * dot(centre, centre), "about another point");
        let mut simulation = simulation(&model);
        // The centre flies straight on, and the body turns without strain.
        let columns = ["body.vx", "body.vy", "body.vz"].map(|column| value(&simulation, column));
        assert!((0..3).all(|d| (columns[d] - centre[d]).abs() < 1e-15), "{columns:?} {centre:?}");
        simulation.advance(f64::INFINITY, u64::MAX).unwrap();
        let summary = simulation.summary();
        assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-12, "{summary:?}");
        assert!(value(&simulation, "energy.internal") < 1e-5 * own, "{}", value(&simulation, "energy.internal"));
    }
}

#[test]
fn nodes_of_shells_spin_with_their_part() {
    let shape = Shape::Rectangle(Rectangle { corner: [0.0; 2], size: [1.0, 1.0], elements: [4, 4], ..Rectangle::default() });
    let spinning = |axis: Vector| {
        let mut model = model("shell4", shape.clone(), 4.0);
        model.parts[0].section = Some(ShellSection { thickness: 0.3, ..ShellSection::default() });
        (model.parts[0].spin, model.parts[0].spin_axis, model.parts[0].spin_centre) = (1e-3, axis, Some([0.2, 0.1, 0.5]));
        let steps = every_step(&model);
        [steps.column("energy.kinetic")[0], steps.column("energy.internal").into_iter().fold(0.0, f64::max)]
    };
    for axis in [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [1.0, 2.0, -0.5]] {
        let [kinetic, internal] = spinning(axis);
        // Nodes at rest beside a plate that turns would take a twelfth of (t/ℓ)² of the energy, 1e-2.
        assert!(internal < 1e-5 * kinetic, "{axis:?}: {internal:e} of {kinetic:e}");
    }
}

#[test]
fn bodies_go_apart_from_a_point_or_an_axis() {
    let rates = |axis: Option<Vector>| {
        let mut model = model("hex8", cuboid(), 1.0);
        let centre = [0.3, 0.5, -0.7];
        model.parts[0].radial_velocity = Some(RadialVelocity { rate: 0.02, centre, axis, ..RadialVelocity::default() });
        let (to, second) = (arm(centre), spread());
        let along = axis.map_or([0.0; 3], |axis| axis.map(|a| a / dot(axis, axis).sqrt()));
        let of = |d: usize| second[d] * (1.0 - along[d] * along[d]);
        let square = (0..3).map(of).sum::<f64>() + dot(to, to) - dot(to, along).powi(2);
        near(kinetic(&model), 0.5 * mass() * 0.02 * 0.02 * square, "rate");
        let speed = |d: usize| 0.02 * (to[d] - dot(to, along) * along[d]);
        let simulation = simulation(&model);
        let found = ["body.vx", "body.vy", "body.vz"].map(|column| value(&simulation, column));
        assert!((0..3).all(|d| (found[d] - speed(d)).abs() < 1e-15), "{found:?}");
    };
    rates(None);
    rates(Some([1.0, 2.0, -0.5]));
    // All nodes are equally fast, in the plane, about an axis in 3D, and of an axisymmetric sphere.
    let ring = |state: &str, centre: [f64; 2], [from, to]: [f64; 2]| {
        let shape = Shape::Ring(Ring { centre, inner: 0.8, from, to, elements: [2, 12], ..Ring::default() });
        let mut model = model("quad4", shape, 1.0);
        model.parts[0].stress_state = state.into();
        model.parts[0].radial_velocity =
            Some(RadialVelocity { speed: -0.3, centre: [centre[0], centre[1], 0.0], ..RadialVelocity::default() });
        let simulation = simulation(&model);
        let mass: f64 = simulation.overview().parts.iter().map(|part| part.mass).sum();
        near(kinetic(&model), 0.5 * mass * 0.09, state);
    };
    ring("plane_strain", [0.2, -0.1], [0.0, std::f64::consts::TAU]);
    ring("axisymmetric", [0.0, -0.1], [-1.5, 1.5]);
    let mut model = model("hex8", cuboid(), 1.0);
    model.parts[0].radial_velocity = Some(RadialVelocity { speed: 0.3, axis: Some([0.0, 0.0, 2.0]), ..RadialVelocity::default() });
    near(kinetic(&model), 0.5 * mass() * 0.09, "axis");
}

fn faults(model: &Model) -> Vec<String> {
    model_faults(model).into_iter().map(|fault| fault.path).collect()
}

#[test]
fn what_can_not_begin_so_is_refused() {
    let box_with = |change: &dyn Fn(&mut Part)| {
        let mut model = model("hex8", cuboid(), 1.0);
        change(&mut model.parts[0]);
        faults(&model)
    };
    let plane_with = |change: &dyn Fn(&mut Part)| {
        let mut model = model("quad4", Shape::Rectangle(Rectangle { size: [1.0; 2], elements: [1; 2], ..Rectangle::default() }), 1.0);
        change(&mut model.parts[0]);
        faults(&model)
    };
    let radial = |centre: Vector, axis: Option<Vector>| Some(RadialVelocity { speed: 1.0, centre, axis, ..RadialVelocity::default() });
    assert_eq!(box_with(&|part| part.spin_axis = [0.0; 3]), ["part[0].spin_axis"]);
    assert_eq!(box_with(&|part| part.spin_centre = Some([f64::NAN, 0.0, 0.0])), ["part[0].spin_centre[0]"]);
    assert_eq!(box_with(&|part| part.radial_velocity = radial([0.0; 3], Some([0.0; 3]))), ["part[0].radial_velocity.axis"]);
    let rigid = box_with(&|part| (part.radial_velocity, part.rigid) = (radial([0.0; 3], None), Some(Motion::default())));
    assert_eq!(rigid, ["part[0].radial_velocity"]);
    assert_eq!(plane_with(&|part| part.spin_axis = [0.0, 1.0, 1.0]), ["part[0].spin_axis"]);
    assert_eq!(plane_with(&|part| part.spin_centre = Some([0.0, 1.0, 1.0])), ["part[0].spin_centre[2]"]);
    assert_eq!(plane_with(&|part| part.radial_velocity = radial([0.0, 0.0, 1.0], None)), ["part[0].radial_velocity.centre[2]"]);
    assert_eq!(plane_with(&|part| part.radial_velocity = radial([0.0; 3], Some([1.0, 0.0, 0.0]))), ["part[0].radial_velocity.axis"]);
    let of_revolution = |centre: Vector, axis: Option<Vector>| {
        plane_with(&|part| (part.stress_state, part.radial_velocity) = ("axisymmetric".into(), radial(centre, axis)))
    };
    assert_eq!(of_revolution([0.5, 0.0, 0.0], None), ["part[0].radial_velocity"]);
    assert_eq!(of_revolution([0.0; 3], Some([0.0, 0.0, 1.0])), ["part[0].radial_velocity"]);
}
