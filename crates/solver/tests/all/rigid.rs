//! Rigid parts against closed forms: free, driven, rolling, sliding, hit; and damping.

use crate::bodies::*;
use embate_solver::model::{
    Constraint, Contact, Curve, Disk, Drive, Friction, Interface, Load, Model, Motion, Obstacle, ObstacleShape, Partners, Penalty,
    PenaltySource, Ring, Shape, Symmetry,
};
use embate_solver::simulation::{Options, Simulation};
use std::f64::consts::TAU;

const G: f64 = 9.81;

fn ring(inner: f64, outer: f64, centre: [f64; 2], elements: [usize; 2]) -> Shape {
    Shape::Ring(Ring { centre, inner, outer, from: 0.0, to: TAU, elements, ..Ring::default() })
}

#[test]
fn a_free_rigid_part_flies_and_spins_without_end_and_without_strain() {
    let mut model = model(0.3);
    add(&mut model, "bar", rectangle([0.0, 0.0], [0.2, 0.05], [8, 2]), [3.0, -1.0]);
    model.parts[0].spin = 40.0;
    stiffen(&mut model, "bar", Motion::default());
    let mut simulation = simulation(&model);
    let start = simulation.frame().positions::<2>().to_vec();
    let energy = value(&simulation, "energy.kinetic");
    simulation.advance(f64::INFINITY, u64::MAX).unwrap();
    let (s, c) = (40.0_f64 * 0.3).sin_cos();
    for (x, x0) in simulation.frame().positions::<2>().iter().zip(&start) {
        let (a, b) = (x0[0] - 0.1, x0[1] - 0.025);
        let wanted = [0.1 + 0.9 + c * a - s * b, 0.025 - 0.3 + s * a + c * b];
        assert!((x[0] - wanted[0]).abs() < 1e-12 && (x[1] - wanted[1]).abs() < 1e-12, "{x:?} {wanted:?}");
    }
    let summary = simulation.summary();
    assert!(summary.momentum_drift_linear.unwrap() < 1e-13 && summary.momentum_drift_angular.unwrap() < 1e-13);
    assert!((value(&simulation, "energy.kinetic") / energy - 1.0).abs() < 1e-13);
    assert!((value(&simulation, "energy.kinetic[bar]") / energy - 1.0).abs() < 1e-12, "a part has what the whole has");
    assert_eq!(value(&simulation, "energy.internal"), 0.0);
    for (column, wanted) in [("angle", 12.0), ("spin", 40.0), ("vx", 3.0), ("vy", -1.0), ("x", 1.0)] {
        assert!((value(&simulation, &format!("rigid.{column}[bar]")) - wanted).abs() < 1e-11, "{column}");
    }
}

#[test]
fn a_part_begins_with_its_spin_whether_rigid_or_not() {
    for rigid in [false, true] {
        let mut model = model(1e-6);
        add(&mut model, "disk", Shape::Disk(Disk { centre: [0.3, 0.2], radius: 0.1, elements: 4 }), [1.0, 2.0]);
        model.parts[0].spin = 50.0;
        model.parts[0].rigid = rigid.then(Motion::default);
        let frame = simulation(&model).frame();
        let velocity = &frame.fields.iter().find(|field| field.kind.name == "velocity").unwrap().values;
        for (x, v) in frame.positions::<2>().iter().zip(velocity.chunks_exact(2)) {
            let wanted = [1.0 - 50.0 * (x[1] - 0.2), 2.0 + 50.0 * (x[0] - 0.3)];
            assert!((v[0] - wanted[0]).abs() < 1e-11 && (v[1] - wanted[1]).abs() < 1e-11, "{v:?} {wanted:?}");
        }
    }
}

#[test]
fn a_free_rigid_part_that_is_hit_keeps_both_momenta_and_the_energy() {
    for (first, second) in [(true, false), (false, true), (true, true)] {
        for interface in [Interface::default(), rough(0.3)] {
            let mut model = model(2e-3);
            add(&mut model, "ball", Shape::Disk(Disk { centre: [0.0, 0.0], radius: 0.03, elements: 4 }), [12.0, 1.0]);
            add(&mut model, "block", rectangle([0.031, -0.01], [0.03, 0.08], [3, 8]), [0.0, 0.0]);
            model.parts[0].spin = 100.0;
            for (part, rigid) in model.parts.iter_mut().zip([first, second]) {
                part.rigid = rigid.then(Motion::default);
            }
            touch(&mut model, "ball", "block");
            model.contacts[0].interface = interface;
            let simulation = to_end(&model);
            let summary = simulation.summary();
            assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-12, "{summary:?}");
            assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 0.01, "{first} {second}: {summary:?}");
            assert!(value(&simulation, "block.vx") > 1.0, "it was hit");
        }
    }
}

#[test]
fn what_follows_a_curve_is_where_its_integral_says() {
    let mut model = model(1e-3);
    add(&mut model, "block", rectangle([0.0, 0.0], [0.05, 0.05], [3, 3]), [0.0, 0.0]);
    add(&mut model, "die", rectangle([1.0, 0.0], [0.05, 0.05], [3, 3]), [0.0, 0.0]);
    // Up to 3 m/s within 0.2 ms, down to −1 m/s at 0.7 ms: integrals 0.3e-3 + 0.5e-3 − 0.3e-3 m.
    model.curves.insert("way".into(), Curve::table(vec![0.0, 2e-4, 7e-4], vec![0.0, 3.0, -1.0]));
    model.curves.insert("turn".into(), Curve::table(vec![0.0, 2e-4, 7e-4], vec![0.0, 300.0, -100.0]));
    let way = || Some(Drive::Curve("way".into()));
    model.constraints.push(Constraint { on: "block.left".into(), velocity: [way(), Some(0.0.into()), None], ..Constraint::default() });
    stiffen(&mut model, "die", Motion { velocity: [None, way(), None], spin: Some(Drive::Curve("turn".into())) });
    let motion = Motion { velocity: [Some(0.5.into()), way(), None], spin: Some(Drive::Curve("turn".into())) };
    model.obstacles.push(Obstacle { motion, reference: Some([3.0, 1.0, 0.0]), ..Obstacle::wall("far", [5.0, 0.0], [-1.0, 0.0]) });
    probe(&mut model, "corner", "block", [0.0, 0.0]);
    let simulation = to_end(&model);
    let near = |column: &str, wanted: f64| {
        let found = value(&simulation, column);
        assert!((found - wanted).abs() < 1e-13, "{column}: {found}, not {wanted}");
    };
    near("corner.x", 0.5e-3);
    near("corner.vx", -1.0);
    for (column, wanted) in [("x", 1.025), ("y", 0.025 + 0.5e-3), ("angle", 0.05), ("vx", 0.0), ("vy", -1.0)] {
        near(&format!("rigid.{column}[die]"), wanted);
    }
    for (column, wanted) in [("x", 3.0 + 0.5e-3), ("y", 1.0 + 0.5e-3), ("angle", 0.05), ("spin", -100.0)] {
        near(&format!("obstacle.{column}[far]"), wanted);
    }
    assert!(simulation.summary().ledger_residual < 1e-12 && simulation.summary().energy_drift < 0.02);
}

#[test]
fn what_pulls_on_a_driven_part_that_shares_nodes_costs_its_drive_work() {
    // A bar of two groups of one mesh: the right one is rigid and pulls the left one along.
    let mut model = model(1e-3);
    let mut mesh = mapped([8, 2], |u, v| [0.2 * u, 0.05 * v]);
    let cells = std::mem::take(&mut mesh.groups[0].cells);
    let (left, right): (Vec<_>, Vec<_>) = cells.into_iter().enumerate().partition(|(i, _)| i % 8 < 5);
    mesh.groups = [("left", left), ("right", right)].map(|(name, cells)| group(name, 2, cells.into_iter().map(|(_, cell)| cell))).into();
    add_groups(&mut model, mesh, &["left", "right"], [0.0, 0.0]);
    let free = {
        let mut model = model.clone();
        stiffen(&mut model, "right", Motion::default());
        model.parts.iter_mut().for_each(|part| part.velocity = [4.0, 0.0, 0.0]);
        model.parts[0].velocity = [-2.0, 1.0, 0.0];
        model
    };
    let simulation = to_end(&free);
    let summary = simulation.summary();
    assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-12, "{summary:?}");
    assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 5e-3, "{summary:?}");
    assert!(value(&simulation, "energy.internal") > 0.0);

    stiffen(&mut model, "right", driven([Some(2.0), Some(0.0)], Some(5.0)));
    let simulation = to_end(&model);
    let ledger = simulation.ledger();
    assert!(ledger.works.drive > 0.0 && ledger.external > 0.0, "{ledger:?}");
    assert!(ledger.residual() < 1e-12 && ledger.drift() < 5e-3, "{}", ledger.drift());
    let sum = value(&simulation, "energy.kinetic[left]") + value(&simulation, "energy.kinetic[right]");
    assert!((sum / ledger.stores.kinetic - 1.0).abs() < 1e-3, "{sum} {}", ledger.stores.kinetic);
}

#[test]
fn damping_takes_the_speed_that_its_rate_says_whatever_the_rate() {
    for rate in [1.0, 1e3, 1e7] {
        let mut model = model(1e-3);
        add(&mut model, "block", rectangle([0.0, 0.0], [0.05, 0.05], [3, 3]), [2.0, -1.0]);
        add(&mut model, "stone", rectangle([1.0, 0.0], [0.05, 0.05], [3, 3]), [2.0, -1.0]);
        model.parts[1].spin = 10.0;
        stiffen(&mut model, "stone", Motion::default());
        add(&mut model, "free", rectangle([2.0, 0.0], [0.05, 0.05], [3, 3]), [2.0, -1.0]);
        model.loads.push(Load::Damping { parts: vec!["block".into(), "stone".into()], rate, active: [0.0, f64::INFINITY] });
        let energy = value(&simulation(&model), "energy.kinetic");
        let (simulation, history) = run(&model);
        let decay = (-rate * 1e-3_f64).exp();
        for (column, start) in [("block.vx", 2.0), ("block.vy", -1.0), ("rigid.vx[stone]", 2.0), ("rigid.spin[stone]", 10.0)] {
            let found = value(&simulation, column) / start;
            assert!(found.abs() <= 1.0 && (rate > 1e6 || (found / decay - 1.0).abs() < 1e-3), "{rate} {column}: {found} {decay}");
        }
        assert!((value(&simulation, "free.vx") - 2.0).abs() < 1e-12);
        let ledger = simulation.ledger();
        assert!(ledger.residual() < 1e-12 && ledger.drift() < 1e-6, "{rate}: {} {}", ledger.residual(), ledger.drift());
        assert!((value(&simulation, "energy.damping") / (energy - ledger.stores.kinetic) - 1.0).abs() < 1e-9);
        // Beyond a rate of two per step velocities alternate, and energies at whole steps with them.
        let gives_back = history.column("energy.damping").windows(2).any(|pair| pair[1] < pair[0] - 1e-12 * energy);
        assert!(rate > 1e6 || !gives_back, "{rate}");
        assert_eq!(simulation.summary().momentum_drift_linear, None);
    }
}

#[test]
fn damping_begins_and_ends_and_goes_with_contact_and_constraints() {
    let mut model = model(3e-3);
    add(&mut model, "block", rectangle([0.0, 0.001], [0.05, 0.05], [4, 4]), [0.0, -5.0]);
    model.obstacles.push(Obstacle { interface: rough(0.3), ..Obstacle::wall("floor", [0.0, 0.0], [0.2, 1.0]) });
    model.constraints.push(Constraint { on: "block.left".into(), velocity: [Some(0.0.into()), None, None], ..Constraint::default() });
    for (rate, active) in [(300.0, [1e-3, 2e-3]), (200.0, [1.5e-3, 2.5e-3])] {
        model.loads.push(Load::Damping { parts: vec![], rate, active });
    }
    let (simulation, history) = run(&model);
    assert!(simulation.summary().ledger_residual < 1e-12 && simulation.summary().energy_drift < 0.02, "{:?}", simulation.summary());
    let (time, lost) = (history.column("time"), history.column("energy.damping"));
    let at = |t: f64| lost[time.iter().position(|&it| it >= t).unwrap()];
    assert_eq!(at(0.99e-3), 0.0);
    assert!(at(1.5e-3) > 0.0 && at(2.4e-3) > at(1.9e-3));
    assert!((at(2.6e-3) - history.last("energy.damping")).abs() < 1e-12);
}

#[test]
fn rigid_parts_that_something_else_holds_or_shares_are_faults() {
    let mut model = model(1e-3);
    add(&mut model, "block", rectangle([0.0, 0.0], [0.1, 0.05], [2, 1]), [0.0, 0.0]);
    stiffen(&mut model, "block", Motion::default());
    model.symmetries.push(Symmetry { normal: [1.0, 0.0, 0.0], ..Symmetry::default() });
    let reported = faults(&model);
    for word in ["part[0].rigid", "block", "(0.000000e0, ", "symmetry"] {
        assert!(reported.len() == 1 && reported[0].contains(word), "{word}: {reported:?}");
    }
    model.symmetries.clear();
    assert_eq!(faults(&model), Vec::<String>::new());

    let mut model = crate::bodies::model(1e-3);
    let mut mesh = mapped([2, 1], |u, v| [u, v]);
    let cells = std::mem::take(&mut mesh.groups[0].cells);
    mesh.groups = ["left", "right"].iter().zip(cells).map(|(name, cell)| group(name, 2, [cell].into_iter())).collect();
    add_groups(&mut model, mesh, &["left", "right"], [0.0, 0.0]);
    for part in ["left", "right"] {
        stiffen(&mut model, part, Motion::default());
    }
    let reported = faults(&model);
    assert!(reported.len() == 1 && reported[0].contains("part[1].rigid") && reported[0].contains("\"left\" and \"right\""), "{reported:?}");
}

/// A rigid wheel on a plane with friction, gravity turned by the slope; and I / (M R²) of the wheel.
fn wheel(inner: f64, velocity: f64, slope: f64, friction: f64, end: f64) -> (Model, f64) {
    let mut model = model(end);
    model.materials.insert("soft".into(), elastic(4e6, 1e3));
    add(&mut model, "wheel", ring(inner, 0.1, [0.0, 0.1], [6, 128]), [velocity, 0.0]);
    stiffen(&mut model, "wheel", Motion::default());
    model.obstacles.push(Obstacle { interface: rough(friction), ..Obstacle::wall("slope", [0.0; 2], [0.0, 1.0]) });
    gravity(&mut model, [G * slope.sin(), -G * slope.cos()]);
    (model, 0.5 * (1.0 + (inner / 0.1) * (inner / 0.1)))
}

#[test]
fn a_wheel_rolls_down_a_slope_if_friction_suffices() {
    let slope: f64 = 0.3;
    // A disk (almost) and a thin ring: a = g sin θ / (1 + I / (M R²)).
    for inner in [0.02, 0.095] {
        let (model, k) = wheel(inner, 0.0, slope, 0.4, 0.4);
        assert!(slope.tan() < 0.4 * (1.0 + 1.0 / k));
        let (simulation, history) = run(&model);
        let acceleration = 2.0 * history.last("rigid.x[wheel]") / 0.4 / 0.4;
        assert!((acceleration / (G * slope.sin() / (1.0 + k)) - 1.0).abs() < 0.01, "{inner}: {acceleration}");
        let rolled = -0.1 * history.last("rigid.angle[wheel]") / history.last("rigid.x[wheel]");
        assert!((rolled - 1.0).abs() < 0.02, "{inner}: {rolled}");
        assert!(simulation.summary().energy_drift < 1e-9 && simulation.summary().ledger_residual < 1e-11, "{:?}", simulation.summary());
    }
}

#[test]
fn a_wheel_slides_down_a_slope_that_is_too_steep_for_its_friction() {
    let (slope, friction): (f64, f64) = (0.8, 0.15);
    let (model, k) = wheel(0.02, 0.0, slope, friction, 0.2);
    let (_, history) = run(&model);
    let acceleration = 2.0 * history.last("rigid.x[wheel]") / 0.04;
    assert!((acceleration / (G * (slope.sin() - friction * slope.cos())) - 1.0).abs() < 0.01, "{acceleration}");
    let spin = -0.1 * history.last("rigid.spin[wheel]") / 0.2;
    assert!((spin / (friction * G * slope.cos() / k) - 1.0).abs() < 0.02, "{spin}");
}

#[test]
fn a_wheel_that_slides_ends_up_rolling() {
    // v0 / (1 + I/(M R²)): two thirds of a disk, one half of a thin ring; friction takes the fraction k /
    // (1 + k) of the energy, a third or a half.
    for inner in [0.02, 0.095] {
        let (v0, friction) = (1.0, 0.25);
        let (model, k) = wheel(inner, v0, 0.0, friction, 0.35);
        let start = value(&simulation(&model), "energy.kinetic");
        let (_, history) = run(&model);
        let end = history.last("rigid.vx[wheel]");
        assert!((end * (1.0 + k) / v0 - 1.0).abs() < 0.01, "{inner}: {end}");
        assert!((-0.1 * history.last("rigid.spin[wheel]") / end - 1.0).abs() < 0.03, "{inner}: {}", history.last("rigid.spin[wheel]"));
        let lost = history.last("energy.friction") / start;
        assert!((lost / (k / (1.0 + k)) - 1.0).abs() < 0.02, "{inner}: {lost}");
        assert!((history.last("obstacle.friction_work[slope]") / history.last("energy.friction") - 1.0).abs() < 1e-2);
        // It slides until v0 / (µ g (1 + 1/k)).
        let time = history.column("time");
        let begin = v0 / (friction * G * (1.0 + 1.0 / k));
        let half = time.iter().position(|&t| t >= 0.5 * begin).unwrap();
        assert!((history.column("rigid.vx[wheel]")[half] / (v0 - 0.5 * friction * G * begin) - 1.0).abs() < 0.02, "{inner}");
    }
}

#[test]
fn a_block_on_a_slope_sticks_or_slides_as_its_friction_says() {
    let slope: f64 = 0.35; // tan = 0.365
    for rigid in [true, false] {
        for friction in [0.4, 0.2] {
            let mut model = model(0.2);
            model.materials.insert("soft".into(), elastic(4e6, 1e3));
            add(&mut model, "block", rectangle([0.0, 0.0], [0.2, 0.05], [4, 1]), [0.0, 0.0]);
            if rigid {
                stiffen(&mut model, "block", Motion::default());
            }
            let interface = Interface { damping: 0.5, ..rough(friction) };
            model.obstacles.push(Obstacle { interface, ..Obstacle::wall("slope", [0.0; 2], [0.0, 1.0]) });
            gravity(&mut model, [G * slope.sin(), -G * slope.cos()]);
            let (simulation, history) = run(&model);
            let moved = history.last("block.x") - history.first("block.x");
            let weight = history.last("obstacle.force_y[slope]") / (10.0 * G * slope.cos());
            assert!((weight - 1.0).abs() < 0.05, "{rigid} {friction}: {weight}");
            if friction > slope.tan() {
                assert!(moved < 1e-4, "{rigid}: it creeps by {moved}");
                // Nor does it creep later on.
                let x = history.column("block.x");
                let creep = x[x.len() - 1] - x[x.len() * 7 / 10];
                assert!(creep.abs() < 2e-5, "{rigid}: {creep}");
            } else {
                let wanted = 0.5 * G * (slope.sin() - friction * slope.cos()) * 0.04;
                assert!((moved / wanted - 1.0).abs() < 0.02, "{rigid}: {moved} {wanted}");
            }
            assert!(simulation.summary().ledger_residual < 1e-11, "{:?}", simulation.summary());
        }
    }
}

#[test]
fn a_model_of_rigid_parts_takes_the_step_that_it_is_given() {
    let mut model = model(0.2);
    add(&mut model, "stone", rectangle([0.0, 0.001], [0.1, 0.1], [4, 4]), [0.0, -1.0]);
    stiffen(&mut model, "stone", Motion::default());
    model.obstacles.push(Obstacle { interface: Penalty::PerNode(1e5).into(), ..Obstacle::wall("floor", [0.0; 2], [0.0, 1.0]) });
    let own = simulation(&model).time_step();
    assert!(own < 5e-5, "without one that of its elements: {own}");
    model.run.time_step = Some(1e-4);
    assert!((simulation(&model).time_step() - 1e-4).abs() < 1e-18);
    let (simulation, history) = run(&model);
    // Half a vibration on five springs of 1e5 N/m², and back again.
    assert!((history.last("stone.vy") - 1.0).abs() < 1e-9, "{}", history.last("stone.vy"));
    assert!(simulation.summary().steps == 2000 && simulation.summary().energy_drift < 1e-9, "{:?}", simulation.summary());
    // Where something deforms it is the largest one.
    model.parts[0].rigid = None;
    assert!((self::simulation(&model).time_step() / own - 1.0).abs() < 1e-6);
    model.run.time_step = Some(0.5 * own);
    assert!((self::simulation(&model).time_step() / own - 0.5).abs() < 1e-6);
    // A penalty from the time step needs one.
    stiffen(&mut model, "stone", Motion::default());
    model.run.time_step = None;
    model.obstacles[0].interface = Penalty::Automatic { scale: 1.0, source: PenaltySource::TimeStep }.into();
    assert!(faults(&model).iter().any(|fault| fault.contains("run.time_step")), "{:?}", faults(&model));
}

#[test]
fn a_sliding_block_stops_where_friction_has_taken_its_energy() {
    let mut model = model(1.2);
    model.materials.insert("soft".into(), elastic(4e6, 1e3));
    add(&mut model, "block", rectangle([0.0, 0.0], [0.4, 0.05], [4, 1]), [2.0, 0.0]);
    stiffen(&mut model, "block", Motion::default());
    let interface = Interface { damping: 0.3, ..rough(0.2) };
    model.obstacles.push(Obstacle { interface, ..Obstacle::wall("floor", [0.0; 2], [0.0, 1.0]) });
    gravity(&mut model, [0.0, -G]);
    let (_, history) = run(&model);
    let (time, v) = (history.column("time"), history.column("rigid.vx[block]"));
    let way = history.last("rigid.x[block]") - history.first("rigid.x[block]");
    assert!((way / (4.0 / (2.0 * 0.2 * G)) - 1.0).abs() < 5e-3, "{way}");
    let stop = time[v.iter().position(|&v| v < 1e-3).unwrap()];
    assert!((stop - 1.0194).abs() < 5e-3, "{stop}");
    assert!(history.last("rigid.vx[block]").abs() < 1e-3);
}

#[test]
fn rigid_bodies_give_the_same_bits_for_any_number_of_threads() {
    let mut model = model(1.0);
    model.run.max_steps = Some(60);
    add(&mut model, "block", rectangle([0.0, 0.0], [0.1, 0.1], [70, 65]), [3.0, -1.0]);
    add(&mut model, "punch", rectangle([0.02, 0.1002], [0.05, 0.02], [40, 3]), [0.0, -8.0]);
    stiffen(&mut model, "punch", Motion::default());
    model.parts[1].spin = -5.0;
    touch(&mut model, "block", "punch");
    model.loads.push(Load::Damping { parts: vec![], rate: 100.0, active: [0.0, f64::INFINITY] });
    gravity(&mut model, [0.0, -G]);
    model.obstacles.push(Obstacle {
        motion: Motion::default(),
        mass: Some(2.0),
        inertia: Some(1e-3),
        interface: rough(0.2),
        ..Obstacle::fixed("edge", ObstacleShape::Polyline { points: vec![[-0.1, -0.02], [0.05, -0.0001], [0.2, -0.02]] })
    });
    let outcome = |threads: usize| {
        let mut simulation = Simulation::new(&model, &Options { threads, simd: None }).unwrap();
        simulation.advance(1.0, u64::MAX).unwrap();
        let row: Vec<u64> = simulation.history_row().into_iter().map(f64::to_bits).collect();
        (simulation.summary().state_hash, row)
    };
    let reference = outcome(1);
    for threads in [2, 3, 7] {
        assert!(outcome(threads) == reference, "{threads} threads");
    }
}

/// A rigid slab that falls on another one: more springs than one island is solved with at once, of which all
/// push on one body.
#[test]
fn a_rigid_slab_on_hundreds_of_springs_keeps_momenta_and_energy_with_the_same_bits_for_any_threads() {
    for (density, friction) in [(78.0, 0.0), (78.0, 0.3), (78000.0, 0.0)] {
        let mut model = embate_solver::bench::slabs(20, 2.0, 0.3);
        let mut light = model.materials["steel"].clone();
        light.parameters.insert("density".into(), density);
        model.materials.insert("light".into(), light);
        model.parts[1].material = "light".into();
        model.parts[1].rigid = Some(Motion::default());
        model.parts[1].velocity = [0.7, 0.0, -2.0];
        let friction = Friction { coefficient: friction, dynamic: None, decay: 0.0, viscosity: 0.0, limit: f64::INFINITY };
        let interface = Interface { friction: (friction.coefficient > 0.0).then_some(friction), ..Interface::default() };
        model.contacts.push(Contact { name: "slabs".into(), partners: Partners::Bodies(Vec::new()), interface, ..Contact::default() });
        model.run.end = 5e-6;
        let case = format!("density {density}, {friction:?}");
        let hash = hash_of_equal_bits(&model, &[2, 3], &case);
        let mut run = simulation(&model);
        run.advance(6e-7, u64::MAX).unwrap();
        continues_to(&hash, &model, &mut run, &case);
        run.advance(f64::INFINITY, u64::MAX).unwrap();
        let (after, sweeps) = (run.summary(), run.sweeps());
        assert!((5..100).contains(&sweeps.0) && sweeps.1 == 0, "{case}: {sweeps:?}");
        assert!(after.ledger_residual < 1e-12 && after.energy_drift < 1e-3, "{case}: {after:?}");
        let drifts = [after.momentum_drift_linear, after.momentum_drift_angular].map(Option::unwrap);
        assert!(drifts.iter().all(|drift| *drift < 1e-11), "{case}: {drifts:?}");
    }
}
