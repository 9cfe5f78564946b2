//! Parts that stay in place while material flows through them.

use crate::bodies::*;
use crate::remeshing::metal;
use embate_solver::model::{Constraint, Drive, Flow, Model, Obstacle, Remesh, Symmetry};
use embate_solver::output::Flow as Passed;
use embate_solver::simulation::{Options, Simulation};

fn flow(part: &str) -> Flow {
    Flow { part: part.into(), direction: None, begin: 0.0, travel: 1.0, steady: 0.01, stop: false, loss_limit: 0.05 }
}

/// What has passed the only part of that kind.
fn passed(simulation: &Simulation) -> Passed {
    let summary = simulation.summary();
    let [flow] = &summary.flows[..] else { panic!("{} flows", summary.flows.len()) };
    println!("{flow:?}\ndrift {:.2e}, ledger {:.2e}", summary.energy_drift, summary.ledger_residual);
    flow.clone()
}

/// A strip of 0.2 m × 0.05 m along a direction, which flies along it.
fn strip(direction: [f64; 2], element: &str) -> Model {
    let [c, s] = direction;
    let mut model = model(30e-3);
    let place = |u: f64, v: f64| [0.2 * u * c - 0.05 * v * s + 0.3, 0.2 * u * s + 0.05 * v * c - 0.1];
    add_mesh(&mut model, "strip", mapped([8, 3], place), [20.0 * c, 20.0 * s]);
    model.parts[0].element = element.into();
    probe(&mut model, "middle", "strip", place(0.5, 1.0 / 3.0));
    model.flows.push(flow("strip"));
    model
}

#[test]
fn what_flows_uniformly_stays_uniform_and_in_place() {
    for (direction, element) in [([1.0, 0.0], "quad4"), ([0.0, -1.0], "quad4_reduced"), ([-0.6, 0.8], "quad4")] {
        let model = strip(direction, element);
        let (simulation, history) = run(&model);
        let flow = passed(&simulation);
        let summary = simulation.summary();
        // 0.6 m by 20 m/s, and what is still on the way back.
        let way = 20.0 * 30e-3 / 0.2;
        assert!(flow.passages > way - 0.14 && flow.passages <= way && flow.events >= 20, "{}", flow.passages);
        let mass = flow.passages * 0.2 * 0.05 * model.materials[&model.parts[0].material].parameters["density"];
        assert!(flow.mass.iter().all(|own| (own - mass).abs() < 1e-11 * mass), "{:?} {mass}", flow.mass);
        let energy = 0.5 * mass * 400.0;
        assert!(flow.energy.iter().all(|own| (own - energy).abs() < 1e-11 * energy), "{:?} {energy}", flow.energy);
        let kinetic = history.first("energy.kinetic");
        assert!(flow.kinetic_lost.abs() < 1e-11 * kinetic && flow.elastic_lost.abs() < 1e-11 * kinetic);
        assert!(flow.momentum_change.iter().all(|change| *change < 1e-12));
        assert!(history.last("energy.remap").abs() < 1e-11 * kinetic && history.last("energy.flow").abs() < 1e-11 * kinetic);
        assert!(summary.energy_drift < 1e-11 && summary.ledger_residual < 1e-12 && summary.momentum_drift_linear.is_none());
        for (k, name) in ["middle.vx", "middle.vy"].iter().enumerate() {
            assert!((history.last(name) - 20.0 * direction[k]).abs() < 1e-10);
        }
        // The probe stays with the mesh.
        let start = [history.first("middle.x"), history.first("middle.y")];
        let off = [history.last("middle.x") - start[0], history.last("middle.y") - start[1]];
        let along = off[0] * direction[0] + off[1] * direction[1];
        let across = off[1] * direction[0] - off[0] * direction[1];
        assert!(along > -1e-9 && along < 1.1 * 0.025 && across.abs() < 1e-12, "{along} {across}");
        assert!(flow.change.is_some_and(|change| change < 1e-9) && flow.steady.is_some(), "{:?}", flow.change);
    }
}

/// The strip of `examples/strip-rolling`, coarser and shorter: the upper half of 4 mm becomes 2.8 mm.
fn rolled(end: f64, flows: &[Flow]) -> Model {
    let mut model = model(end);
    let mut aluminium = metal(70e9, 2700.0, 100e6, 150e6);
    aluminium.parameters.insert("poisson".into(), 0.33);
    model.materials.insert("soft".into(), aluminium);
    add(&mut model, "strip", rectangle([-41.5e-3, 0.0], [30e-3, 2e-3], [45, 3]), [14.0, 0.0]);
    model.symmetries.push(Symmetry { name: "middle".into(), normal: [0.0, 1.0, 0.0], point: [0.0; 3], parts: Vec::new() });
    let motion = driven([Some(0.0), Some(0.0)], Some(200.0));
    let shape = embate_solver::model::ObstacleShape::Circle { centre: [0.0, 101.4e-3, 0.0], radius: 0.1, hollow: false };
    model.obstacles.push(Obstacle { name: "roll".into(), shape, motion, interface: rough(0.15), ..Obstacle::default() });
    probe(&mut model, "inlet", "strip", [-41.5e-3, 2e-3]);
    probe(&mut model, "outlet", "strip", [-13e-3, 2e-3]);
    model.flows = flows.to_vec();
    model
}

fn mean(history: &History, name: &str, from: f64, to: f64) -> f64 {
    let times = history.column("time");
    let values = history.column(name);
    let chosen: Vec<f64> = times.iter().zip(&values).filter(|(time, _)| (from..to).contains(*time)).map(|(_, value)| *value).collect();
    chosen.iter().sum::<f64>() / chosen.len() as f64
}

#[test]
fn a_strip_that_is_rolled_in_place_needs_the_force_and_torque_of_one_that_moves() {
    let (_, moving) = run(&rolled(1.6e-3, &[]));
    let (simulation, still) = run(&rolled(4e-3, &[Flow { begin: 1e-3, ..flow("strip") }]));
    let (flow, summary) = (passed(&simulation), simulation.summary());
    assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 1e-4 && summary.contact.unverified == 0);
    // But for what the line of symmetry takes.
    assert!(flow.momentum_change.iter().all(|change| *change < 1e-11), "{:?}", flow.momentum_change);
    let loss = still.last("energy.remap") / still.last("energy.plastic");
    assert!(loss.abs() < 0.01, "{loss}");
    for (name, tolerance) in [("obstacle.force_y[roll]", 0.02), ("obstacle.moment[roll]", 0.03)] {
        let [before, after] = [mean(&moving, name, 0.9e-3, 1.6e-3), mean(&still, name, 2e-3, 4e-3)];
        println!("{name}: {before} and {after}");
        assert!((after / before - 1.0).abs() < tolerance, "{name}: {after} and not {before}");
    }
    // What goes in comes out: by volume, which the plastic strain keeps, and by mass.
    let speeds = ["inlet", "outlet"].map(|name| mean(&still, &format!("{name}.vx"), 2e-3, 4e-3));
    let heights = ["inlet", "outlet"].map(|name| mean(&still, &format!("{name}.y"), 2e-3, 4e-3));
    println!("{speeds:?} {heights:?}");
    assert!((speeds[0] * heights[0] / (speeds[1] * heights[1]) - 1.0).abs() < 5e-3, "{speeds:?} {heights:?}");
    assert!((heights[1] - 1.4046e-3).abs() < 5e-6, "{heights:?}");
}

#[test]
fn a_flow_ends_the_run_when_it_is_steady() {
    let (simulation, _) = run(&rolled(10e-3, &[Flow { begin: 1e-3, steady: 0.02, stop: true, ..flow("strip") }]));
    let flow = passed(&simulation);
    // The piece that was rolled as the front has to leave first.
    assert!(flow.steady == Some(simulation.time()) && flow.passages > 0.5 && simulation.time() < 6e-3, "{}", simulation.time());
    assert!(simulation.summary().warnings.iter().any(|own| own.to_string().contains("is steady since")));
}

#[test]
fn a_flow_is_the_same_on_all_threads_and_instruction_sets_and_after_a_stop() {
    let model = rolled(1.4e-3, &[Flow { begin: 0.9e-3, ..flow("strip") }]);
    let options = |threads: usize, simd: Option<&str>| Options { threads, simd: simd.map(Into::into) };
    let hashes = |options: &Options| {
        let mut simulation = Simulation::new(&model, options).unwrap();
        simulation.advance(f64::INFINITY, u64::MAX).unwrap();
        assert!(passed(&simulation).events >= 10);
        simulation.hashes()
    };
    let alone = hashes(&options(1, Some("scalar")));
    for threads in [2, 3] {
        assert_eq!(hashes(&options(threads, None)), alone, "{threads} threads");
    }
    let mut simulation = Simulation::new(&model, &options(1, None)).unwrap();
    for stop in [0.5e-3, 0.95e-3, 1e-3, 1.017e-3, 1.2e-3] {
        simulation.advance(stop, u64::MAX).unwrap();
        let state = simulation.state().unwrap();
        simulation = Simulation::resumed(&model, &options(1, None), &state.sections).unwrap();
        assert_eq!(simulation.state().unwrap(), state);
    }
    simulation.advance(f64::INFINITY, u64::MAX).unwrap();
    assert_eq!(simulation.hashes(), alone, "resumed");
}

#[test]
fn what_flows_backwards_ends_the_run_with_a_reason() {
    let mut model = strip([1.0, 0.0], "quad4");
    model.flows[0].direction = Some([-1.0, 0.0, 0.0]);
    let (error, _) = run_to_failure(&model);
    let error = error.to_string();
    assert!(
        error.contains("part \"strip\" can't go back along its flow") && error.contains("does not flow along the direction"),
        "{error}"
    );
    // No channel.
    let mut model = strip([1.0, 0.0], "quad4");
    model.flows[0].direction = Some([1.0, 1.0, 0.0]);
    let (error, _) = run_to_failure(&model);
    assert!(error.to_string().contains("not a channel"), "{error}");
}

#[test]
fn what_can_not_flow_is_said_at_once() {
    let reported = |change: &dyn Fn(&mut Model)| {
        let mut model = strip([1.0, 0.0], "quad4");
        change(&mut model);
        faults(&model).join("\n")
    };
    assert_eq!(reported(&|_| ()), "");
    assert!(reported(&|model| model.flows[0].part = "stripe".into()).contains("strip"));
    assert!(reported(&|model| model.parts[0].velocity = [0.0; 3]).contains("direction of the flow through part `strip` is not known"));
    assert!(reported(&|model| model.flows[0].direction = Some([f64::NAN, 1.0, 0.0])).contains("flow[0].direction"));
    assert!(reported(&|model| model.flows.push(flow("strip"))).contains("two sections"));
    let remesh = |model: &mut Model| model.remeshes.push(Remesh { ..crate::remeshing::every("strip", 1.0) });
    assert!(reported(&remesh).contains("two sections"));
    for (key, value) in [("travel", 0.0), ("travel", 1.5), ("travel", f64::NAN), ("steady", 0.0), ("loss_limit", -1.0), ("begin", -1.0)] {
        let change = |model: &mut Model| {
            let flow = &mut model.flows[0];
            *match key {
                "travel" => &mut flow.travel,
                "steady" => &mut flow.steady,
                "begin" => &mut flow.begin,
                _ => &mut flow.loss_limit,
            } = value;
        };
        assert!(reported(&change).contains(&format!("flow[0].{key}:")), "{key} {value}");
    }
    let rubber = |model: &mut Model| model.materials.values_mut().for_each(|own| own.law = "neo_hookean".into());
    assert!(reported(&rubber).contains("knows a state without stress"));
    let axisymmetric = |model: &mut Model| model.parts[0].stress_state = "axisymmetric".into();
    assert!(reported(&axisymmetric).contains("not along the axis"));
    let held = |model: &mut Model| {
        model.constraints.push(Constraint {
            on: "strip".into(),
            velocity: [None, Some(Drive::Constant(0.0)), None],
            ..Constraint::default()
        });
    };
    assert_eq!(reported(&held), "");
}
