//! Elements made again on the way of a run: what is kept, what is lost, and that it is the same run on any
//! machine and after any stop.

use crate::bodies::*;
use embate_solver::model::{
    Constraint, ContactLaw, Disk, Drive, Friction, Interface, Material, Model, Motion, Obstacle, Part, Relocate, Remesh, Shape,
};
use embate_solver::output::{Remeshing, Summary};
use embate_solver::simulation::{Options, Simulation};

pub(crate) fn close(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((found - expected).abs() <= tolerance, "{what}: {found} and not {expected}");
}

fn remesh(part: &str) -> Remesh {
    Remesh::of_part(part, [0.3; 2])
}

pub(crate) fn every(part: &str, interval: f64) -> Remesh {
    Remesh { interval: Some(interval), ..remesh(part) }
}

pub(crate) fn metal(young: f64, density: f64, yield_stress: f64, hardening: f64) -> Material {
    let parameters = [("young", young), ("poisson", 0.3), ("density", density), ("yield", yield_stress), ("hardening", hardening)];
    Material { law: "j2".into(), parameters: parameters.map(|(key, value)| (key.to_string(), value)).into(), ..Material::default() }
}

/// A disk that flies and turns.
fn disk(element: &str, spin: f64) -> Model {
    let mut model = model(4e-3);
    let shape = Shape::Disk(Disk { centre: [0.3, -0.2], radius: 0.1, elements: 6 });
    add(&mut model, "disk", shape, [20.0, 7.0]);
    (model.parts[0].element, model.parts[0].spin) = (element.into(), spin);
    model.remeshes.push(every("disk", 4e-4));
    model
}

pub(crate) fn events(simulation: &Simulation) -> (Summary, Vec<Remeshing>) {
    let summary = simulation.summary();
    for event in &summary.remeshings {
        println!("{event:?}");
    }
    println!("drift {:.2e}, ledger {:.2e}", summary.energy_drift, summary.ledger_residual);
    let events = summary.remeshings.clone();
    (summary, events)
}

#[test]
fn what_flies_free_keeps_its_velocity_and_has_no_stress() {
    for element in ["quad4", "quad4_reduced"] {
        let (simulation, history) = run(&disk(element, 0.0));
        let (summary, events) = events(&simulation);
        assert!(events.len() >= 8, "{}", events.len());
        for event in events {
            assert!(
                event.kinetic_lost.abs() < 1e-12 * summary_energy(&history) && event.elastic_lost.abs() < 1e-12 * summary_energy(&history)
            );
            assert!(event.momentum_change.iter().all(|change| *change < 1e-13), "{event:?}");
            assert!(event.volume_change.abs() < 1e-12, "{event:?}");
        }
        assert!(summary.energy_drift < 1e-11 && summary.ledger_residual < 1e-12, "{} {}", summary.energy_drift, summary.ledger_residual);
        assert!(summary.momentum_drift_linear.unwrap() < 1e-12);
        close(history.last("disk.vx"), 20.0, 1e-9, "velocity along x");
        close(history.last("disk.vy"), 7.0, 1e-9, "velocity along y");
    }
}

fn summary_energy(history: &History) -> f64 {
    history.first("energy.kinetic")
}

#[test]
fn what_spins_keeps_its_angular_momentum_and_nearly_all_energy() {
    let model = disk("quad4", 500.0);
    let (simulation, history) = run(&model);
    let (summary, events) = events(&simulation);
    assert!(events.len() >= 8);
    assert!(summary.momentum_drift_angular.unwrap() < 1e-11 && summary.momentum_drift_linear.unwrap() < 1e-12);
    assert!(summary.ledger_residual < 1e-12, "{}", summary.ledger_residual);
    let kinetic = history.first("energy.kinetic");
    let lost: f64 = events.iter().map(|event| event.kinetic_lost).sum();
    assert!(lost > -1e-9 * kinetic && lost < 2e-3 * kinetic, "{lost} of {kinetic}");
    assert!(summary.energy_drift < 2e-3, "{}", summary.energy_drift);
}

pub(crate) fn relocate(part: &str) -> Relocate {
    Relocate { part: part.into(), quality: 0.5, time_step: 0.5, interval: None, begin: 0.0, loss_limit: 0.05 }
}

#[test]
fn nodes_of_what_flies_and_spins_are_moved_without_a_trace() {
    // A disk of skew elements, which moved nodes make better once.
    let place = |u: f64, v: f64| [0.2 * u + 0.03 * (7.0 * v).sin() * u * (1.0 - u), 0.2 * v + 0.03 * (6.0 * u).sin() * v * (1.0 - v)];
    for spin in [0.0, 300.0] {
        let mut model = model(2e-3);
        add_mesh(&mut model, "block", mapped([8, 8], place), [20.0, 7.0]);
        model.parts[0].spin = spin;
        model.relocations.push(Relocate { quality: 0.9, ..relocate("block") });
        let (simulation, history) = run(&model);
        let (summary, events) = events(&simulation);
        let [event, ..] = &events[..] else { panic!("no node was moved") };
        assert!(event.elements == [64, 64] && event.quality[1] > event.quality[0], "{event:?}");
        assert!(events.iter().all(|event| event.momentum_change.iter().all(|change| *change < 1e-12)), "{events:?}");
        assert!(events.iter().all(|event| event.volume_change.abs() < 1e-12), "{events:?}");
        assert!(summary.ledger_residual < 1e-12 && summary.momentum_drift_linear.unwrap() < 1e-12);
        let lost: f64 = events.iter().map(|event| event.kinetic_lost).sum::<f64>() / summary_energy(&history);
        assert!(lost.abs() < if spin == 0.0 { 1e-12 } else { 1e-3 }, "{lost}");
    }
}

#[test]
fn moved_nodes_let_a_rod_come_farther_and_agree_with_new_elements() {
    let rod = |moved: bool, made: bool| {
        let mut model = taylor(300.0, [5, 50], &[]);
        model.relocations.extend(moved.then(|| relocate("rod")));
        model.remeshes.extend(made.then(|| remesh("rod")));
        let mut simulation = Simulation::new(&model, &Options { threads: 1, simd: None }).unwrap();
        let ended = simulation.advance(f64::INFINITY, u64::MAX).is_ok();
        let (summary, events) = events(&simulation);
        assert!(summary.ledger_residual < 1e-12);
        let moves = events.iter().filter(|event| event.elements[0] == event.elements[1]).count();
        (ended, simulation.time(), value(&simulation, "tail.y"), moves, events.len())
    };
    let [neither, moved, made, both] = [(false, false), (true, false), (false, true), (true, true)].map(|(moved, made)| rod(moved, made));
    println!("{neither:?} {moved:?} {made:?} {both:?}");
    assert!(!neither.0 && moved.1 > 1.2 * neither.1 && moved.3 > 0);
    assert!(made.0 && both.0 && both.3 > 0);
    close(both.2, made.2, 0.005 * made.2, "length");
}

/// The rod of `examples/taylor-bar` at another speed.
pub(crate) fn taylor(speed: f64, elements: [usize; 2], rules: &[Remesh]) -> Model {
    let mut model = model(80e-6);
    let mut copper = metal(117e9, 8930.0, 400e6, 100e6);
    copper.parameters.insert("poisson".into(), 0.35);
    model.materials.insert("soft".into(), copper);
    add(&mut model, "rod", rectangle([0.0, 0.0], [3.2e-3, 32.4e-3], elements), [0.0, -speed]);
    model.parts[0].stress_state = "axisymmetric".into();
    model.obstacles.push(Obstacle::wall("wall", [0.0; 3], [0.0, 1.0, 0.0]));
    probe(&mut model, "tail", "rod", [0.0, 32.4e-3]);
    model.remeshes = rules.to_vec();
    model
}

#[test]
fn a_rod_that_is_meshed_again_hits_the_wall_as_one_that_is_not() {
    let length = |rules: &[Remesh]| {
        let (simulation, history) = run(&taylor(227.0, [5, 50], rules));
        let (summary, events) = events(&simulation);
        assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 0.02, "{}", summary.energy_drift);
        (history.last("tail.y"), events.len())
    };
    let (as_it_was, none) = length(&[]);
    let (again, count) = length(&[Remesh { begin: 4e-6, ..every("rod", 8e-6) }]);
    println!("{as_it_was} and {again} after {count}");
    assert!(none == 0 && count >= 8);
    close(again, as_it_was, 0.003 * as_it_was, "length");
}

#[test]
fn a_fast_rod_comes_to_rest_whose_elements_would_turn_inside_out() {
    let ends = |rules: &[Remesh]| {
        let mut simulation = Simulation::new(&taylor(340.0, [5, 50], rules), &Options { threads: 1, simd: None }).unwrap();
        let result = simulation.advance(f64::INFINITY, u64::MAX).map_err(|error| error.to_string());
        events(&simulation);
        (result, simulation)
    };
    let (without, _) = ends(&[]);
    assert!(without.is_err());
    let (with, simulation) = ends(&[remesh("rod")]);
    with.unwrap();
    let summary = simulation.summary();
    assert!(!summary.remeshings.is_empty() && summary.ledger_residual < 1e-12);
    assert!(summary.remeshings.iter().all(|event| event.volume_change.abs() < 1e-12 && event.momentum_change[0] < 1e-12));
}

#[test]
fn elements_are_small_where_plastic_strain_changes() {
    let ends = |strain_change: Option<f64>| {
        let mut model = taylor(340.0, [5, 50], &[Remesh { strain_change, ..remesh("rod") }]);
        model.obstacles[0].interface.law = ContactLaw::Multiplier;
        probe(&mut model, "rim", "rod", [3.2e-3, 0.0]);
        let mut simulation = Simulation::new(&model, &Options { threads: 1, simd: None }).unwrap();
        simulation.advance(f64::INFINITY, u64::MAX).unwrap();
        let (summary, events) = events(&simulation);
        assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 1e-3, "{}", summary.energy_drift);
        assert!(events.iter().all(|event| event.volume_change.abs() < 1e-12), "{events:?}");
        (["tail.y", "rim.x"].map(|column| value(&simulation, column)), simulation.elements(), events)
    };
    let ([length, foot], elements, _) = ends(None);
    let ([length_fine, foot_fine], elements_fine, events) = ends(Some(0.3));
    println!("{length} {foot} {elements}; {length_fine} {foot_fine} {elements_fine}");
    assert!(events.iter().any(|event| event.reason == "size"), "{events:?}");
    assert!(elements < 300 && (500..=1000).contains(&elements_fine), "{elements} {elements_fine}");
    // Of 10 × 100 elements 13.83 and 10.58 mm.
    close(length_fine, 13.83e-3, 0.05e-3, "length");
    close(foot_fine, 10.55e-3, 0.08e-3, "foot");
    assert!((foot_fine - 10.58e-3).abs() < 0.5 * (foot - 10.58e-3).abs(), "{foot} {foot_fine}");
}

#[test]
fn a_run_is_the_same_on_all_threads_and_instruction_sets_and_after_a_stop() {
    let model = taylor(300.0, [8, 81], &[Remesh { begin: 2e-6, ..every("rod", 4e-6) }]);
    let options = |threads: usize, simd: Option<&str>| Options { threads, simd: simd.map(Into::into) };
    let until = 16e-6;
    let hashes = |options: &Options| {
        let mut simulation = Simulation::new(&model, options).unwrap();
        simulation.advance(until, u64::MAX).unwrap();
        assert!(simulation.summary().remeshings.len() >= 3);
        simulation.hashes()
    };
    let alone = hashes(&options(1, Some("scalar")));
    for threads in [2, 3] {
        assert_eq!(hashes(&options(threads, None)), alone, "{threads} threads");
    }
    // Stopped before and after each event.
    let mut simulation = Simulation::new(&model, &options(1, None)).unwrap();
    for stop in 1..16 {
        simulation.advance(1e-6 * f64::from(stop), u64::MAX).unwrap();
        let state = simulation.state().unwrap();
        simulation = Simulation::resumed(&model, &options(1, None), &state.sections).unwrap();
        assert_eq!(simulation.state().unwrap(), state);
    }
    simulation.advance(until, u64::MAX).unwrap();
    assert_eq!(simulation.hashes(), alone, "resumed");
}

#[test]
fn a_billet_is_upset_between_rough_dies_far_beyond_the_reach_of_its_first_mesh() {
    let mut model = model(1.8e-4);
    model.materials.insert("soft".into(), metal(200e9, 7833.0, 700e6, 300e6));
    add(&mut model, "billet", rectangle([0.0, 0.0], [10e-3, 15e-3], [10, 15]), [0.0, 0.0]);
    model.parts[0].stress_state = "axisymmetric".into();
    model.constraints.push(Constraint {
        on: "billet.bottom".into(),
        velocity: [None, Some(Drive::Constant(0.0)), None],
        ..Constraint::default()
    });
    let friction = Friction { coefficient: 0.5, dynamic: None, decay: 0.0, viscosity: 0.0, limit: f64::INFINITY };
    let motion = driven([Some(0.0), Some(-50.0)], Some(0.0));
    let interface = Interface { friction: Some(friction), ..Interface::default() };
    model.obstacles.push(Obstacle { motion, interface, ..Obstacle::wall("die", [0.0, 15e-3, 0.0], [0.0, -1.0, 0.0]) });
    model.remeshes.push(remesh("billet"));
    let (simulation, history) = run(&model);
    let (summary, events) = events(&simulation);
    assert!(!events.is_empty());
    assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 0.02, "{}", summary.energy_drift);
    assert!(history.last("energy.remap").abs() < 0.01 * history.last("energy.plastic"), "{}", history.last("energy.remap"));
}

#[test]
fn what_can_not_be_meshed_again_yet_is_said_at_once() {
    let reported = |change: &dyn Fn(&mut Model)| {
        let mut model = disk("quad4", 0.0);
        change(&mut model);
        faults(&model).join("\n")
    };
    assert_eq!(reported(&|_| ()), "");
    assert!(reported(&|model| model.remeshes[0].part = "dsk".into()).contains("disk"));
    assert!(reported(&|model| model.parts[0].stress_state = "plane_stress".into()).contains("plane stress"));
    assert!(reported(&|model| model.parts[0].rigid = Some(Motion::default())).contains("rigid"));
    assert!(reported(&|model| model.remeshes.push(remesh("disk"))).contains("two sections"));
    let gas = |model: &mut Model| model.materials.values_mut().for_each(|own| own.eos = "linear".into());
    assert!(reported(&gas).contains("equation of state `linear` of part `disk` can't continue"));
    assert!(reported(&|model| model.remeshes[0].quality = 1.5).contains("quality"));
    for size in [0.0, -1.0, f64::NAN] {
        assert!(reported(&|model| model.remeshes[0].size = Some(size)).contains("remesh[0].size:"), "{size}");
        assert!(reported(&|model| model.remeshes[0].size_contact = Some(size)).contains("remesh[0].size_contact:"), "{size}");
    }
    // The part itself, and not one beside it.
    let failing = || Material { failure: [("plastic_strain".to_string(), 0.2)].into(), ..metal(1e9, 1e3, 1e7, 1e7) };
    let found = reported(&|model| {
        model.parts.push(Part { name: "other".into(), material: "torn".into(), ..model.parts[0].clone() });
        model.materials.insert("torn".into(), failing());
    });
    assert_eq!(found, "");
    let found = reported(&|model| model.materials.values_mut().for_each(|own| *own = failing()));
    assert!(found.contains("part `disk` may fail"), "{found}");
}
