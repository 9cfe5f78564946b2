//! Contact of axisymmetric bodies against closed forms: areas are those of the whole circumference, the axis
//! included.
//!
//! Two equal rods end on, ν = 0: force ½ ρ c v π R² for 2L/c, with the same pressure on every node.

use crate::bodies::{add, add_mesh, driven, faults, mapped, model, rectangle, rough, run, simulation, slender, stiffen};
use embate_solver::model::{
    Contact, ContactLaw, Formulation, Friction, Image, Interface, Join, Load, Model, Motion, Obstacle, ObstacleShape, Penalty,
    PenaltySource,
};
use embate_solver::simulation::Simulation;
use std::f64::consts::PI;

const YOUNG: f64 = 1e9;
const DENSITY: f64 = 1e3;
const RADIUS: f64 = 0.01;
const LENGTH: f64 = 0.1;

fn revolve(model: &mut Model) {
    model.parts.iter_mut().for_each(|part| part.stress_state = "axisymmetric".into());
}

/// Two rods, one above the other, with so many elements along the radius.
fn rods(formulation: Formulation, interface: Interface, across: [usize; 2], end: f64) -> Model {
    let mut model = slender(end, YOUNG, DENSITY);
    add(&mut model, "below", rectangle([0.0, -LENGTH], [RADIUS, LENGTH], [across[0], 50]), [0.0, 1.0]);
    add(&mut model, "above", rectangle([0.0, 0.0], [RADIUS, LENGTH], [across[1], 50]), [0.0, -1.0]);
    model.contacts.push(Contact { formulation, interface, ..Contact::between("ends", "below.top", "above.bottom") });
    revolve(&mut model);
    model
}

/// Contact force over the area of the end face on each of its nodes, first of the rod below, with `across`
/// elements; Pa.
fn pressures(simulation: &Simulation, across: &[usize]) -> Vec<f64> {
    let frame = simulation.frame();
    let field = |name: &str| &frame.fields.iter().find(|field| field.kind.name == name).unwrap().values;
    let forces: Vec<[f64; 2]> = field("contact_force")
        .chunks(2)
        .zip(frame.positions::<2>())
        .filter(|(f, _)| f[1] != 0.0)
        .map(|(f, x)| [x[0], f[1].abs()])
        .collect();
    let shares = |count: usize| {
        let step = RADIUS / count as f64;
        (0..=count).map(move |i| match i {
            0 => PI * step * step / 3.0,
            i if i == count => PI * step * (3.0 * RADIUS - step) / 3.0,
            i => 2.0 * PI * RADIUS * i as f64 / count as f64 * step,
        })
    };
    let areas: Vec<f64> = across.iter().flat_map(|&count| shares(count)).collect();
    assert_eq!(forces.len(), areas.len());
    let found: Vec<f64> = forces.iter().zip(&areas).map(|([_, force], area)| force / area).collect();
    // What is written: less at the rim, where the side wall counts as well.
    let written = field("contact_pressure").iter().filter(|value| **value != 0.0).zip(&found).zip(&forces);
    for ((written, found), [x, _]) in written {
        assert!(*x > 0.999 * RADIUS || (written / found - 1.0).abs() < 1e-4, "{written} {found}");
    }
    found
}

fn is_uniform(pressures: &[f64], what: &str) {
    let mean = pressures.iter().sum::<f64>() / pressures.len() as f64;
    assert!(pressures.iter().all(|p| (p / mean - 1.0).abs() < 1e-9), "{what}: {pressures:?}");
}

/// Laws with which a uniform gap is a uniform pressure: not a stiffness per node, which a node at the rim has
/// whole.
fn interfaces() -> Vec<(&'static str, Interface)> {
    let table = ContactLaw::PressureGap { gaps: vec![-1e-4, 0.0], pressures: vec![1e8, 0.0] };
    vec![
        ("automatic", Interface::default()),
        ("time step", Penalty::Automatic { scale: 1.0, source: PenaltySource::TimeStep }.into()),
        ("pressure", Penalty::Pressure(1e12).into()),
        ("table", Interface { law: table, ..Interface::default() }),
        ("multiplier", Interface { law: ContactLaw::Multiplier, ..Interface::default() }),
    ]
}

#[test]
fn rods_meet_with_the_force_and_time_of_the_closed_form() {
    let c = (YOUNG / DENSITY).sqrt();
    let (force, duration) = (DENSITY * c * PI * RADIUS * RADIUS, 2.0 * LENGTH / c);
    for formulation in [Formulation::DoublePass, Formulation::SinglePass { slave: 0 }, Formulation::Segment] {
        let mut model = rods(formulation, Interface::default(), [3, 3], 1.3 * duration);
        model.output.history = embate_solver::model::Cadence::Interval(1e-6);
        let (simulation, history) = run(&model);
        let (times, forces) = (history.column("time"), history.column("contact.force_y[ends]"));
        let within = |time: f64| (0.2 * duration..0.9 * duration).contains(&time);
        let plateau: Vec<f64> = times.iter().zip(&forces).filter(|(time, _)| within(**time)).map(|(_, force)| -force).collect();
        let mean = plateau.iter().sum::<f64>() / plateau.len() as f64;
        assert!((mean / force - 1.0).abs() < 0.01, "{formulation:?}: {mean} {force}");
        let end = times.iter().zip(&forces).filter(|(_, f)| -**f > 0.5 * force).map(|(time, _)| *time).next_back().unwrap();
        assert!((end / duration - 1.0).abs() < 0.03, "{formulation:?}: {end} {duration}");
        assert!((history.last("below.vy") + 1.0).abs() < 0.02, "{formulation:?}: {}", history.last("below.vy"));
        let summary = simulation.summary();
        assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.is_none(), "{summary:?}");
        assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 0.01, "{summary:?}");
    }
}

#[test]
fn every_node_of_equal_meshes_has_the_same_pressure_and_the_axis_too() {
    for formulation in [Formulation::DoublePass, Formulation::SinglePass { slave: 0 }, Formulation::Segment] {
        for (name, interface) in interfaces() {
            let mut simulation = simulation(&rods(formulation, interface, [4, 4], 1.0));
            simulation.advance(1e-4, u64::MAX).unwrap();
            is_uniform(&pressures(&simulation, &[4, 4]), &format!("{formulation:?} {name}"));
        }
    }
    // At a plane a node at the rim has the length of the side wall as well: only a multiplier does not feel
    // it.
    for (name, interface) in interfaces().into_iter().filter(|(name, _)| *name == "multiplier") {
        let mut model = rods(Formulation::DoublePass, Interface::default(), [4, 4], 1.0);
        model.contacts.clear();
        model.parts.truncate(1);
        model.probes.truncate(1);
        model.obstacles.push(Obstacle { interface, ..Obstacle::wall("lid", [0.0; 2], [0.0, -1.0]) });
        let mut simulation = simulation(&model);
        simulation.advance(1e-4, u64::MAX).unwrap();
        is_uniform(&pressures(&simulation, &[4]), &format!("plane, {name}"));
    }
}

#[test]
fn segments_load_meshes_that_do_not_match_evenly_all_around() {
    let mut simulation = simulation(&rods(Formulation::Segment, Interface::default(), [4, 7], 1.0));
    simulation.advance(1e-4, u64::MAX).unwrap();
    is_uniform(&pressures(&simulation, &[4, 7]), "segment");
}

/// Two cones that slide on each other's flanks, and part.
fn cones(formulation: Formulation, interface: Interface) -> Model {
    let mut model = model(4e-4);
    let slope = 0.5;
    add_mesh(&mut model, "point", mapped([6, 6], |u, v| [0.03 * u, 0.03 * v + slope * 0.03 * u + 1e-4]), [0.0, -10.0]);
    let hollow = |u: f64, v: f64| [0.002 + 0.038 * u, -0.03 * (1.0 - v) + slope * (0.002 + 0.038 * u)];
    add_mesh(&mut model, "hollow", mapped([9, 6], hollow), [0.0, 10.0]);
    model.contacts.push(Contact { formulation, interface, ..Contact::between("flanks", "point", "hollow") });
    revolve(&mut model);
    model
}

#[test]
fn inclined_faces_keep_energy_and_the_momentum_along_the_axis() {
    for formulation in [Formulation::DoublePass, Formulation::SinglePass { slave: 1 }, Formulation::Segment] {
        for (name, interface) in [("smooth", Interface::default()), ("rough", rough(0.3))] {
            let (simulation, history) = run(&cones(formulation, interface));
            let summary = simulation.summary();
            let what = format!("{formulation:?} {name}");
            assert!(history.largest("energy.contact") > 1e-3 * history.first("energy.kinetic"), "{what}: they met");
            assert!(summary.momentum_drift_linear.unwrap() < 1e-12, "{what}: {summary:?}");
            assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 0.005, "{what}: {summary:?}");
            assert!(history.last("point.vy") > 0.0, "{what}: it comes back");
        }
    }
}

#[test]
fn friction_has_the_limit_of_the_area_all_around() {
    // A rod in a tight tube: shear τ on 2π R L.
    let mut model = slender(3e-4, YOUNG, DENSITY);
    add(&mut model, "rod", rectangle([0.0, 0.0], [RADIUS, LENGTH], [2, 20]), [0.0, 5.0]);
    let friction = Friction { coefficient: 1.0, dynamic: None, decay: 0.0, viscosity: 0.0, limit: 1e3 };
    let interface = Interface { friction: Some(friction), ..Interface::default() };
    let wall = Obstacle::wall("tube", [RADIUS, 0.0], [-1.0, 0.0]);
    model.obstacles.push(Obstacle { interface: Interface { law: ContactLaw::Multiplier, ..interface }, ..wall });
    model.loads.push(Load::Force { on: "rod.right".into(), force: [2.0 * PI * RADIUS * LENGTH * 1e5, 0.0, 0.0], curve: None });
    revolve(&mut model);
    let (simulation, history) = run(&model);
    let lost = 1e3 * 2.0 * PI * RADIUS * LENGTH * 3e-4 / (DENSITY * PI * RADIUS * RADIUS * LENGTH);
    assert!(((5.0 - history.last("rod.vy")) / lost - 1.0).abs() < 0.1, "{} {lost}", 5.0 - history.last("rod.vy"));
    assert!(simulation.summary().ledger_residual < 1e-12);
    // Half of the heat goes into the rod, by its area.
    let frame = simulation.frame();
    let heat = &frame.fields.iter().find(|field| field.kind.name == "friction_heat").unwrap().values;
    let slid = history.last("rod.y") - history.first("rod.y");
    let beside = frame.positions::<2>().iter().zip(heat).filter(|(x, _)| x[0] > 0.9 * RADIUS && (0.02..0.08).contains(&x[1]));
    let mut count = 0;
    for (x, heat) in beside {
        assert!((heat / (0.5 * 1e3 * slid) - 1.0).abs() < 0.1, "{x:?}: {heat} {slid}");
        count += 1;
    }
    assert!(count > 8, "{count}");
}

#[test]
fn a_free_obstacle_takes_the_momentum_along_the_axis() {
    let mut model = slender(3e-4, YOUNG, DENSITY);
    add(&mut model, "rod", rectangle([0.0, 0.0], [RADIUS, LENGTH], [3, 30]), [0.0, -2.0]);
    revolve(&mut model);
    let still = driven([Some(0.0), None], Some(0.0));
    let plane = Obstacle::wall("anvil", [0.0; 2], [0.0, 1.0]);
    model.obstacles.push(Obstacle { motion: still, mass: Some(0.05), ..plane });
    let (simulation, history) = run(&model);
    let mass = DENSITY * PI * RADIUS * RADIUS * LENGTH;
    let (rod, anvil) = (history.last("rod.vy"), history.last("obstacle.vy[anvil]"));
    assert!(rod > 0.0 && (mass * (rod + 2.0) + 0.05 * anvil).abs() < 1e-9 * mass, "{rod} {anvil}");
    assert!(simulation.summary().momentum_drift_linear.unwrap() < 1e-12);
}

#[test]
fn a_rigid_body_on_the_axis_moves_along_it() {
    let mut model = slender(3e-4, YOUNG, DENSITY);
    add(&mut model, "rod", rectangle([0.0, 0.0], [RADIUS, LENGTH], [3, 30]), [0.0, -2.0]);
    add(&mut model, "anvil", rectangle([0.0, -0.02], [2.0 * RADIUS, 0.02], [5, 5]), [0.0; 2]);
    model.contacts.push(Contact::between("hit", "rod.bottom", "anvil.top"));
    stiffen(&mut model, "anvil", Motion::default());
    revolve(&mut model);
    let (simulation, history) = run(&model);
    let (rod, anvil) = (history.last("rod.vy"), history.last("rigid.vy[anvil]"));
    let masses = [DENSITY * PI * RADIUS * RADIUS * LENGTH, DENSITY * PI * 4.0 * RADIUS * RADIUS * 0.02];
    assert!(anvil < -0.5 && (masses[0] * (rod + 2.0) + masses[1] * anvil).abs() < 1e-9 * masses[0], "{rod} {anvil}");
    assert_eq!((history.last("rigid.vx[anvil]"), history.last("rigid.spin[anvil]")), (0.0, 0.0));
    let summary = simulation.summary();
    assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.ledger_residual < 1e-12, "{summary:?}");
}

#[test]
fn a_tie_breaks_at_its_strength_all_around() {
    let nodes = [(Formulation::DoublePass, 0.4, true), (Formulation::DoublePass, 2.5, false)];
    for (formulation, strength, breaks) in nodes.into_iter().chain([(Formulation::Segment, 0.4, true), (Formulation::Segment, 2.5, false)])
    {
        // Pulled apart with ½ ρ c v.
        let mut model = rods(formulation, Interface::default(), [3, 4], 1.5e-4);
        model.parts.iter_mut().for_each(|part| part.velocity[1] = -part.velocity[1]);
        model.contacts[0].tied = Some(strength * DENSITY * (YOUNG / DENSITY).sqrt());
        let simulation = {
            let mut simulation = simulation(&model);
            simulation.advance(f64::INFINITY, u64::MAX).unwrap();
            simulation
        };
        let apart = simulation.frame().positions::<2>().iter().filter(|x| x[1].abs() > 1e-5 && x[1].abs() < 0.5e-3).count();
        assert_eq!(apart > 0, breaks, "{formulation:?} {strength}");
    }
}

#[test]
fn what_a_body_of_revolution_cannot_do_is_reported() {
    let build = |change: &dyn Fn(&mut Model)| {
        let mut model = rods(Formulation::DoublePass, Interface::default(), [2, 2], 1e-4);
        change(&mut model);
        faults(&model)
    };
    assert!(build(&|_| {}).is_empty());
    let obstacle = |motion: Motion| Obstacle {
        motion,
        ..Obstacle::fixed("ball", ObstacleShape::Circle { centre: [0.0, 0.5, 0.0], radius: 0.1, hollow: false })
    };
    type Change<'a> = &'a dyn Fn(&mut Model);
    let cases: [(&str, Change<'_>); 8] = [
        ("load[0].gravity[0]", &|m| m.loads.push(Load::Gravity { parts: vec![], acceleration: [1.0, 0.0, 0.0], curve: None })),
        ("part[0].spin", &|m| m.parts[0].spin = 1.0),
        ("contact[0].formulation", &|m| m.contacts[0].formulation = Formulation::Pinball),
        ("obstacle[0].motion.x", &|m| m.obstacles.push(obstacle(driven([Some(1.0), Some(0.0)], Some(0.0))))),
        ("obstacle[0].motion.rotation", &|m| m.obstacles.push(obstacle(driven([Some(0.0), Some(0.0)], Some(2.0))))),
        ("part[0].rigid.rotation", &|m| stiffen(m, "below", driven([None, None], Some(2.0)))),
        ("part[0].velocity[0]", &|m| {
            stiffen(m, "below", Motion::default());
            m.parts[0].velocity[0] = 1.0;
        }),
        ("join[0].rotation", &|m| {
            let image = Image::Turned { about: Default::default(), angle: 1.0 };
            m.joins.push(Join { between: ["below.left".into(), "below.right".into()], image, tolerance: None });
        }),
    ];
    for (path, change) in cases {
        let found = build(change);
        assert!(found.iter().any(|fault| fault.contains(path)), "{path}: {found:?}");
    }
}
