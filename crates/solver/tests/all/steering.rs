//! Velocities and forces that are changed while a simulation stands between two steps: what moves is what was
//! asked for, and the ledger close.

use crate::bodies::*;
use embate_solver::model::{Constraint, Curve, Drive, Load, Model, in_3d};
use embate_solver::output::Frame;
use embate_solver::simulation::{Control, Observer, ObserverError, Progress, Simulation};

/// A free block of 1 kg/m... times its area: 0.08 m × 0.05 m × 1000 kg/m³ = 4 kg/m.
fn block(end: f64) -> Model {
    let mut model = model(end);
    add(&mut model, "block", mapped_rectangle(), [0.0, 0.0]);
    model
}

const MASS: f64 = 4.0;

/// `values` once for each node of a part.
fn everywhere(simulation: &Simulation, part: &str, value: &[f64]) -> (Vec<u32>, Vec<f64>) {
    let nodes = simulation.nodes_of(part).unwrap();
    let values = nodes.iter().flat_map(|_| value.to_vec()).collect();
    (nodes, values)
}

fn throw(simulation: &mut Simulation, part: &str, velocity: &[f64]) {
    let (nodes, velocities) = everywhere(simulation, part, velocity);
    simulation.set_velocities(&nodes, &velocities).unwrap();
}

fn field(simulation: &Simulation, name: &str) -> Vec<f64> {
    simulation.frame().fields.into_iter().find(|field| field.kind.name == name).unwrap().values
}

fn close(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance * b.abs().max(1.0), "{a} and {b}");
}

#[test]
fn what_is_thrown_at_the_start_moves_as_what_the_model_throws() {
    let mut thrown = simulation(&block(1e-3));
    throw(&mut thrown, "block", &[30.0, -7.0]);
    let mut model = block(1e-3);
    model.parts[0].velocity = in_3d([30.0, -7.0]);
    let mut begun = simulation(&model);
    for simulation in [&mut thrown, &mut begun] {
        simulation.advance(f64::INFINITY, 50).unwrap();
    }
    // Viscous forces of the rounded velocities act in one half step more.
    for name in ["displacement", "velocity"] {
        field(&thrown, name).into_iter().zip(field(&begun, name)).for_each(|(a, b)| close(a, b, 1e-12));
    }
    assert_eq!(thrown.time(), begun.time());
}

#[test]
fn what_is_thrown_in_mid_run_has_its_velocity_at_once_and_the_books_close() {
    let mut simulation = simulation(&block(1e-3));
    simulation.advance(f64::INFINITY, 40).unwrap();
    throw(&mut simulation, "block", &[3.0, 4.0]);
    for velocity in field(&simulation, "velocity").chunks(2) {
        assert_eq!(velocity, [3.0, 4.0]);
    }
    let work = 0.5 * MASS * 25.0;
    close(simulation.ledger().external, work, 1e-12);
    close(simulation.ledger().stores.kinetic, work, 1e-12);
    simulation.advance(f64::INFINITY, 100).unwrap();
    close(simulation.ledger().stores.kinetic, work, 1e-12);
    close(simulation.ledger().external, work, 1e-12);
    let summary = simulation.summary();
    assert!(summary.ledger_residual < 1e-13 && summary.energy_drift < 1e-12, "{} {}", summary.ledger_residual, summary.energy_drift);
    // Momentum came from outside: nothing is claimed of it.
    assert_eq!(summary.momentum_drift_linear, None);
}

#[test]
fn the_books_close_when_a_body_that_rings_in_contact_is_thrown_again_and_again() {
    let mut model = block(2e-3);
    model.parts[0].velocity = in_3d([0.0, -20.0]);
    add(&mut model, "wall", rectangle([-0.05, -0.0301], [0.18, 0.03], [8, 3]), [0.0, 0.0]);
    touch(&mut model, "block", "wall");
    let calm = to_end(&model).summary();
    let mut simulation = simulation(&model);
    for number in 0..5 {
        simulation.advance(f64::INFINITY, 60).unwrap();
        let velocity = [[5.0, -15.0], [-3.0, 8.0]][number % 2];
        // Half of the nodes: this is no rigid motion.
        let nodes: Vec<u32> = simulation.nodes_of("block").unwrap().into_iter().step_by(2).collect();
        let velocities: Vec<f64> = nodes.iter().flat_map(|_| velocity).collect();
        simulation.set_velocities(&nodes, &velocities).unwrap();
    }
    simulation.advance(f64::INFINITY, u64::MAX).unwrap();
    let summary = simulation.summary();
    assert!(summary.ledger_residual < 1e-12, "{}", summary.ledger_residual);
    // What the central differences leave open grows with the waves that such throws make; it is no step in
    // the ledger.
    assert!(summary.energy_drift < 10.0 * calm.energy_drift.max(1e-4), "{} {}", summary.energy_drift, calm.energy_drift);
}

#[test]
fn a_force_accelerates_until_it_ends_and_its_work_is_in_the_books() {
    let mut simulation = simulation(&block(1e-2));
    simulation.advance(f64::INFINITY, 10).unwrap();
    let nodes = simulation.nodes_of("block").unwrap();
    // By the mass of each node, so that nothing is strained: corners have a quarter, edges half.
    let frame = simulation.frame();
    let share = |node: u32| {
        let [x, y] = frame.positions::<2>()[node as usize];
        let part = |v: f64, size: f64| if v < 1e-9 || v > size - 1e-9 { 0.5 } else { 1.0 };
        part(x, 0.08) * part(y, 0.05) / 20.0
    };
    let forces: Vec<f64> = nodes.iter().flat_map(|&node| [800.0 * share(node), 0.0]).collect();
    simulation.set_forces(&nodes, &forces).unwrap();
    let begin = simulation.time();
    simulation.advance(f64::INFINITY, 200).unwrap();
    let lasted = simulation.time() - begin;
    // Ends: the last half step has been taken with it already.
    simulation.set_forces(&nodes, &vec![0.0; forces.len()]).unwrap();
    simulation.advance(f64::INFINITY, 1).unwrap();
    let speed = field(&simulation, "velocity")[0];
    close(speed, 800.0 / MASS * lasted, 1e-2);
    simulation.advance(f64::INFINITY, 100).unwrap();
    let ledger = simulation.ledger();
    close(ledger.external, 0.5 * MASS * speed * speed, 1e-9);
    close(ledger.stores.kinetic, ledger.external, 1e-9);
    let summary = simulation.summary();
    assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 1e-9, "{} {}", summary.ledger_residual, summary.energy_drift);
}

#[test]
fn a_state_keeps_forces_and_throws() {
    let model = block(1e-3);
    let steer = |simulation: &mut Simulation| {
        simulation.advance(f64::INFINITY, 20).unwrap();
        throw(simulation, "block", &[1.0, 2.0]);
        simulation.set_forces(&[3, 0], &[1e3, 0.0, 0.0, -2e3]).unwrap();
        simulation.advance(f64::INFINITY, 20).unwrap();
    };
    let mut whole = simulation(&model);
    steer(&mut whole);
    whole.advance(f64::INFINITY, u64::MAX).unwrap();
    let mut stopped = simulation(&model);
    steer(&mut stopped);
    continues_to(&whole.summary().state_hash, &model, &mut stopped, "steered");
}

/// A free block under a field of 1000 m/s² times a curve that is zero until somebody drives it.
fn pulled() -> Model {
    let mut model = block(1e-3);
    model.curves.insert("pull".into(), Curve::table(vec![0.0], vec![0.0]));
    model.loads.push(Load::Gravity { parts: Vec::new(), acceleration: in_3d([1000.0, 0.0]), curve: Some("pull".into()) });
    model
}

#[test]
fn a_load_that_is_driven_has_the_impulse_of_its_curve() {
    let mut simulation = simulation(&pulled());
    simulation.advance(f64::INFINITY, 40).unwrap();
    assert_eq!(simulation.curve("pull"), Some(0.0));
    simulation.set_curve("pull", 1.0, None).unwrap();
    assert_eq!(simulation.curve("pull"), Some(1.0));
    // The coming step stands already.
    let jump = simulation.time() + simulation.time_step();
    simulation.advance(f64::INFINITY, 2).unwrap();
    close(field(&simulation, "velocity")[0], 1000.0 * (simulation.time() - jump), 1e-11);
    simulation.advance(f64::INFINITY, 50).unwrap();
    // And back to −1 in a straight line, until a time between two steps.
    let ramp = simulation.time() + simulation.time_step();
    let end = ramp + 20.3 * simulation.time_step();
    simulation.set_curve("pull", -1.0, Some(end)).unwrap();
    close(simulation.curve("pull").unwrap(), 1.0, 1e-12);
    simulation.advance(f64::INFINITY, 60).unwrap();
    // Its mean while it runs is zero.
    let speed = 1000.0 * ((ramp - jump) - (simulation.time() - end));
    close(field(&simulation, "velocity")[0], speed, 1e-11);
    // The kinetic energy is that of both half steps, ½ m v⁻ v⁺.
    let half = 0.5 * simulation.time_step() * 1000.0;
    let ledger = simulation.ledger();
    close(ledger.external, 0.5 * MASS * (speed * speed - half * half), 1e-9);
    close(ledger.external, ledger.stores.kinetic, 1e-9);
    let summary = simulation.summary();
    assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 1e-9, "{} {}", summary.ledger_residual, summary.energy_drift);
}

#[test]
fn a_load_that_is_driven_at_every_step_is_the_one_of_a_table() {
    // cos(ωt) by straight lines between the steps: as a table of the model, and from step to step, each time
    // for the step after the coming one.
    let course = |time: f64| (2e4 * time).cos();
    let mut driven = simulation(&pulled());
    let (mut times, mut values) = (Vec::new(), Vec::new());
    for _ in 0..100 {
        let [from, next] = [1.0, 2.0].map(|steps| driven.time() + steps * driven.time_step());
        // Steps are not all the same: what is set ends where the next begins, or is kept until then.
        while times.last().is_some_and(|last| *last >= from) {
            times.pop();
            values.pop();
        }
        times.push(from);
        values.push(driven.curve("pull").unwrap());
        times.push(next);
        values.push(course(next));
        driven.set_curve("pull", course(next), Some(next)).unwrap();
        driven.advance(f64::INFINITY, 1).unwrap();
    }
    let mut model = pulled();
    model.curves.insert("pull".into(), Curve::table(times, values));
    let mut table = simulation(&model);
    table.advance(f64::INFINITY, 100).unwrap();
    assert_eq!(driven.time(), table.time());
    for name in ["displacement", "velocity"] {
        field(&driven, name).into_iter().zip(field(&table, name)).for_each(|(a, b)| close(a, b, 1e-10));
    }
    close(driven.ledger().external, table.ledger().external, 1e-9);
}

/// A block whose left side moves as the curve says.
fn led(meaning: usize) -> Model {
    let mut model = block(1e-3);
    model.curves.insert("lead".into(), Curve::table(vec![0.0], vec![0.0]));
    let drive = || [Some(Drive::Curve("lead".into())), None, None];
    let mut constraint = Constraint { on: "block.left".into(), ..Constraint::default() };
    *[&mut constraint.velocity, &mut constraint.displacement, &mut constraint.acceleration][meaning] = drive();
    model.constraints.push(constraint);
    model
}

#[test]
fn motions_that_are_driven_go_where_their_curves_say_and_the_books_close() {
    // Where the left side is after so many seconds since the curve has the value 2: m/s, m, m/s².
    for (meaning, value, way) in [(0, 2.0, 2.0), (1, 2e-5, 0.0), (2, 2e4, 0.0)] {
        let mut simulation = simulation(&led(meaning));
        simulation.advance(f64::INFINITY, 30).unwrap();
        simulation.set_curve("lead", value, None).unwrap();
        simulation.advance(f64::INFINITY, 1).unwrap();
        let node = simulation.nodes_of("block.left").unwrap()[1] as usize;
        assert_eq!(field(&simulation, "displacement")[2 * node], 0.0);
        let (begin, step) = (simulation.time(), simulation.time_step());
        simulation.advance(f64::INFINITY, 1).unwrap();
        let moved = field(&simulation, "displacement")[2 * node];
        let expected = [way * step, value, 0.5 * value * step * step][meaning];
        assert!((moved - expected).abs() < 1e-9 * expected, "{meaning}: {moved} {expected}");
        simulation.advance(f64::INFINITY, 40).unwrap();
        let lasted = simulation.time() - begin;
        let moved = field(&simulation, "displacement")[2 * node];
        let expected = [way * lasted, value, 0.5 * value * lasted * lasted][meaning];
        assert!((moved - expected).abs() < 1e-9 * expected, "{meaning}: {moved} {expected}");
        let summary = simulation.summary();
        assert!(summary.ledger_residual < 1e-12, "{meaning}: {}", summary.ledger_residual);
    }
}

#[test]
fn a_state_keeps_what_curves_were_driven_to() {
    for model in [pulled(), led(0), led(1), led(2)] {
        let name = model.curves.keys().next().unwrap().clone();
        let steer = |simulation: &mut Simulation| {
            simulation.advance(f64::INFINITY, 20).unwrap();
            simulation.set_curve(&name, 1e-4, Some(simulation.time() + 1e-5)).unwrap();
            simulation.advance(f64::INFINITY, 3).unwrap();
        };
        let mut whole = simulation(&model);
        steer(&mut whole);
        whole.advance(f64::INFINITY, u64::MAX).unwrap();
        let mut stopped = simulation(&model);
        steer(&mut stopped);
        continues_to(&whole.summary().state_hash, &model, &mut stopped, "driven");
    }
}

#[test]
fn held_nodes_keep_what_is_prescribed() {
    let mut model = block(1e-3);
    model.constraints.push(embate_solver::model::Constraint {
        on: "block.left".into(),
        velocity: [Some(0.0.into()), None, None],
        displacement: [None, None, None],
        acceleration: [None, None, None],
        ..embate_solver::model::Constraint::default()
    });
    let mut simulation = simulation(&model);
    throw(&mut simulation, "block", &[9.0, 1.0]);
    simulation.advance(f64::INFINITY, 30).unwrap();
    let left = simulation.nodes_of("block.left").unwrap();
    let velocities = field(&simulation, "velocity");
    let displacements = field(&simulation, "displacement");
    for node in left {
        assert_eq!((velocities[2 * node as usize], displacements[2 * node as usize]), (0.0, 0.0));
        assert!(displacements[2 * node as usize + 1] > 0.0);
    }
    assert!(simulation.summary().ledger_residual < 1e-12);
}

#[test]
fn what_can_not_be_changed_is_refused_and_nothing_changes() {
    let mut model = block(1e-3);
    add(&mut model, "stamp", rectangle([0.0, 0.06], [0.02, 0.02], [2, 2]), [0.0, 0.0]);
    stiffen(&mut model, "stamp", driven([None, None], None));
    model.curves.insert("push".into(), Curve::table(vec![0.0], vec![3.0]));
    let mut simulation = simulation(&model);
    simulation.advance(f64::INFINITY, 5).unwrap();
    let before = simulation.state().unwrap();
    let stamp = simulation.nodes_of("stamp").unwrap();
    let reported = |fault: Result<(), embate_solver::error::Fault>| {
        let fault = fault.unwrap_err();
        assert_eq!(fault.kind.code, "E0609");
        fault.message
    };
    assert!(reported(simulation.set_velocities(&[0, stamp[0]], &[1.0; 4])).contains("rigid part"));
    assert!(reported(simulation.set_velocities(&[0, 1000], &[1.0; 4])).contains("no node 1000"));
    assert!(reported(simulation.set_velocities(&[0], &[1.0; 3])).contains("3 numbers of velocity"));
    assert!(reported(simulation.set_forces(&[0, 1], &[1.0, 0.0, f64::NAN, 0.0])).contains("force of node 1"));
    assert!(reported(simulation.set_curve("puhs", 1.0, None)).contains("no curve `puhs`"));
    assert!(reported(simulation.set_curve("push", f64::INFINITY, None)).contains("`push` is inf"));
    assert!(reported(simulation.set_curve("push", 1.0, Some(0.0))).contains("the time is"));
    assert!(reported(simulation.set_curve("push", 1.0, Some(f64::NAN))).contains("NaN s"));
    assert_eq!((simulation.nodes_of("nothing"), simulation.curve("puhs"), simulation.curve("push")), (None, None, Some(3.0)));
    assert!(simulation.state().unwrap() == before);
}

/// Rows and frames as bits.
#[derive(Default, PartialEq, Debug)]
struct Told(Vec<Vec<u64>>, Vec<u64>);

impl Observer for Told {
    fn frame(&mut self, frame: Frame) -> Result<(), ObserverError> {
        self.1.push(frame.step);
        self.1.extend(frame.coordinates.iter().map(|x| x.to_bits()));
        Ok(())
    }
    fn row(&mut self, row: &[f64]) -> Result<(), ObserverError> {
        self.0.push(row.iter().map(|x| x.to_bits()).collect());
        Ok(())
    }
    fn progress(&mut self, _: &Progress<'_>) -> Control {
        Control::Continue
    }
}

#[test]
fn a_run_in_pieces_reports_what_a_whole_one_reports() {
    let mut model = block(2e-3);
    model.parts[0].velocity = in_3d([0.0, -20.0]);
    add(&mut model, "wall", rectangle([-0.05, -0.0301], [0.18, 0.03], [8, 3]), [0.0, 0.0]);
    touch(&mut model, "block", "wall");
    let (mut whole, mut pieces) = (Told::default(), Told::default());
    let mut one = simulation(&model);
    one.run(&mut whole).unwrap();
    let mut other = simulation(&model);
    let mut turn = 0;
    while !other.is_over() {
        turn += 1;
        // By steps and by times.
        match turn % 3 {
            0 => other.run_until(f64::INFINITY, 1 + turn % 13, &mut pieces).unwrap(),
            1 => other.run_until(other.time() + 1.7e-5, u64::MAX, &mut pieces).unwrap(),
            _ => other.run_until(0.0, 5, &mut pieces).unwrap(),
        }
        assert!(turn < 10_000);
    }
    // Nothing is left to report, or what is due at the end.
    other.run(&mut pieces).unwrap();
    assert!(whole == pieces, "{} rows and {}, {} numbers of frames and {}", whole.0.len(), pieces.0.len(), whole.1.len(), pieces.1.len());
    let (one, other) = (one.summary(), other.summary());
    assert_eq!(one, other);
}
