//! Elements made again on the way of a run: what is kept, what is lost, and that it is the same run on any
//! machine and after any stop.

use crate::bodies::*;
use embate_solver::model::{Constraint, Disk, Drive, Friction, Interface, Material, Model, Motion, Obstacle, Part, Remesh, Shape};
use embate_solver::output::{Remeshing, Summary};
use embate_solver::simulation::{Options, Simulation};

fn close(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((found - expected).abs() <= tolerance, "{what}: {found} and not {expected}");
}

fn remesh(part: &str) -> Remesh {
    Remesh {
        part: part.into(),
        size: None,
        quality: 0.3,
        time_step: 0.3,
        interval: None,
        begin: 0.0,
        elements_most: None,
        loss_limit: 0.05,
    }
}

fn every(part: &str, interval: f64) -> Remesh {
    Remesh { interval: Some(interval), ..remesh(part) }
}

fn metal(young: f64, density: f64, yield_stress: f64, hardening: f64) -> Material {
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

fn events(simulation: &Simulation) -> (Summary, Vec<Remeshing>) {
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
    let rubber = [("bulk", 1e9), ("c10", 1e6), ("c01", 1e5), ("density", 1e3)].map(|(key, value)| (key.to_string(), value));
    let rubber = Material { law: "mooney_rivlin".into(), parameters: rubber.into(), ..Material::default() };
    assert!(reported(&|model| drop(model.materials.insert("soft".into(), rubber.clone()))).contains("mooney_rivlin"));
    assert!(
        reported(&|model| {
            model.parts.push(Part { name: "other".into(), ..model.parts[0].clone() });
            touch(model, "disk", "other");
        })
        .contains("contact between bodies")
    );
    assert!(reported(&|model| model.remeshes[0].quality = 1.5).contains("quality"));
    // The part itself, and one beside it.
    let failing = || Material { failure: [("plastic_strain".to_string(), 0.2)].into(), ..metal(1e9, 1e3, 1e7, 1e7) };
    let found = reported(&|model| {
        model.parts.push(Part { name: "other".into(), material: "torn".into(), ..model.parts[0].clone() });
        model.materials.insert("torn".into(), failing());
    });
    assert!(found.contains("part[1].material") && found.contains("part `other` may fail") && !found.contains("`disk`"), "{found}");
    let found = reported(&|model| model.materials.values_mut().for_each(|own| *own = failing()));
    assert!(found.contains("part `disk` may fail"), "{found}");
}
