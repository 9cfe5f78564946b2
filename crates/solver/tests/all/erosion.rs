//! Failure and erosion: what fails at its limit, where its energy and momentum go, and that contact sees the
//! new surfaces at once.

use crate::bodies::*;
use crate::self_contact::all;
use embate_solver::model::{Formulation, Material, Model, Obstacle};
use embate_solver::simulation::{Options, Simulation};

/// An elastic-plastic metal that fails at a plastic strain.
fn metal(failure: &[(&str, f64)]) -> Material {
    let parameters = [("young", 70e9), ("poisson", 0.3), ("density", 2700.0), ("yield", 200e6), ("hardening", 200e6)];
    Material {
        law: "j2".into(),
        parameters: parameters.map(|(key, value)| (key.to_string(), value)).into(),
        failure: failure.iter().map(|&(key, value)| (key.to_string(), value)).collect(),
        ..Material::default()
    }
}

/// A bar of three parts that share nodes: the outer ones fly apart, the middle one fails.
pub(crate) fn torn_bar(failure: &[(&str, f64)]) -> Model {
    let mut model = model(4e-4);
    model.materials.insert("weak".into(), metal(failure));
    model.materials.insert("strong".into(), elastic(70e9, 2700.0));
    let mut mesh = mapped([22, 4], |u, v| [0.22 * u, 0.04 * v]);
    let cells = std::mem::take(&mut mesh.groups[0].cells);
    let between = |from: usize, to: usize| {
        cells.iter().enumerate().filter(move |(k, _)| (from..to).contains(&(k % 22))).map(|(_, cell)| cell.clone())
    };
    mesh.groups = vec![group("left", 2, between(0, 10)), group("middle", 2, between(10, 12)), group("right", 2, between(12, 22))];
    add_groups(&mut model, mesh, &["left", "middle", "right"], [0.0, 0.0]);
    for (part, (material, velocity)) in model.parts.iter_mut().zip([("strong", -120.0), ("weak", 0.0), ("strong", 120.0)]) {
        (part.material, part.velocity) = (material.into(), [velocity, 0.0, 0.0]);
    }
    model
}

#[test]
fn a_bar_is_torn_at_the_strain_of_its_middle_and_both_ends_fly_on() {
    let limit = 0.3;
    let model = torn_bar(&[("plastic_strain", limit)]);
    let mut simulation = Simulation::new(&model, &Options { threads: 1, simd: None }).unwrap();
    let strains = |simulation: &Simulation| {
        let frame = simulation.frame();
        let field = |name: &str| frame.fields.iter().find(|field| field.kind.name == name).unwrap().values.clone();
        (field("plastic_strain"), field("alive"))
    };
    let mut before = 0.0;
    while simulation.summary().erosion.is_none() {
        before = strains(&simulation).0.iter().copied().fold(0.0, f64::max);
        simulation.advance(f64::INFINITY, 1).unwrap();
        assert!(simulation.time() < 4e-4, "nothing fails");
    }
    let (strain, alive) = strains(&simulation);
    for (strain, alive) in strain.iter().zip(&alive) {
        assert_eq!(*alive == 0.0, *strain >= limit, "{strain} {alive}");
    }
    assert!(before < limit);
    let (simulation, history) = run(&model);
    let summary = simulation.summary();
    let erosion = summary.erosion.clone().unwrap();
    assert_eq!(erosion.first.criterion, "plastic_strain");
    assert_eq!(erosion.elements.len(), 1);
    assert!(erosion.elements[0].0 == "middle" && erosion.elements[0].1 >= 4, "{erosion:?}");
    let (left, right) = (history.column("left.vx"), history.column("right.vx"));
    assert!(left.last().unwrap() < &-1.0 && right.last().unwrap() > &1.0);
    assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-12, "{summary:?}");
    assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 2e-3, "{summary:?}");
}

#[test]
fn elastic_energy_of_what_fails_is_booked_to_the_last_digits() {
    // The drift of the bar that holds is that of the trapezoidal rule; a bar that breaks has no more, though
    // much more energy goes with its elements.
    let mut model = torn_bar(&[]);
    for part in &mut model.parts {
        part.velocity[0] *= 3e-4;
    }
    let outcome = |model: &Model| {
        let (simulation, history) = run(model);
        let eroded = history.last("energy.eroded") / history.first("energy.kinetic");
        (simulation.summary().energy_drift, eroded)
    };
    let brittle = |failure: &[(&str, f64)]| Material { failure: metal(failure).failure, ..elastic(70e9, 2700.0) };
    model.materials.insert("weak".into(), brittle(&[]));
    let (drift_whole, nothing) = outcome(&model);
    model.materials.insert("weak".into(), brittle(&[("principal_stress", 3e5)]));
    let (drift, eroded) = outcome(&model);
    println!("{drift_whole} {drift} {eroded}");
    assert!(nothing == 0.0 && eroded > 100.0 * drift, "{drift} {eroded}");
    assert!(drift < 1.1 * drift_whole, "{drift} {drift_whole}");
}

/// A hard bullet and a plate that it goes through.
pub(crate) fn bullet(elements: [usize; 2]) -> Model {
    let mut model = model(1.2e-4);
    model.materials.insert("plate".into(), metal(&[("plastic_strain", 0.5), ("time_step", 1e-9)]));
    let mut hard = elastic(200e9, 7800.0);
    hard.failure.clear();
    model.materials.insert("bullet".into(), hard);
    add(&mut model, "bullet", rectangle([-0.021, -0.004], [0.02, 0.008], [10, 4]), [400.0, 0.0]);
    add(&mut model, "plate", rectangle([0.0, -0.03], [0.006, 0.06], elements), [0.0, 0.0]);
    model.parts[0].material = "bullet".into();
    model.parts[1].material = "plate".into();
    all(&mut model);
    model
}

#[test]
fn a_bullet_goes_through_a_plate_and_no_contact_is_missed_behind_the_eroded_layer() {
    for formulation in [Formulation::DoublePass, Formulation::Segment, Formulation::Pinball] {
        let mut model = bullet([6, 60]);
        model.contacts[0].formulation = formulation;
        let formulation = formulation.name();
        let (simulation, history) = run(&model);
        let summary = simulation.summary();
        let (velocity, place) = (history.column("bullet.vx"), history.column("bullet.x"));
        assert_eq!(summary.contact.unverified, 0, "{formulation}");
        assert!(summary.erosion.as_ref().unwrap().elements[0].1 > 20, "{formulation}");
        assert!(
            summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-11,
            "{formulation}: {summary:?}"
        );
        assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 1e-3, "{formulation}: {summary:?}");
        assert!(place.last().unwrap() > &0.01 && velocity.last().unwrap() < &390.0, "{formulation}");
    }
}

#[test]
fn pieces_of_a_body_that_broke_collide_with_each_other() {
    let mut model = torn_bar(&[("plastic_strain", 0.2)]);
    all(&mut model);
    model.obstacles.push(Obstacle::wall("left_wall", [-0.004, 0.0], [1.0, 0.0]));
    model.obstacles.push(Obstacle::wall("right_wall", [0.224, 0.0], [-1.0, 0.0]));
    model.run.end = 2.5e-3;
    let (simulation, history) = run(&model);
    let summary = simulation.summary();
    println!("{summary:?}");
    let force = history.largest("contact.force_x[all]").max(history.largest("contact.energy[all]"));
    assert!(summary.erosion.is_some());
    assert!(force > 0.0, "the pieces met");
    assert_eq!(summary.contact.unverified, 0);
    // They never overlap.
    let gap: f64 =
        history.column("right.x").iter().zip(history.column("left.x")).map(|(right, left)| right - left).fold(f64::INFINITY, f64::min);
    assert!(gap > 0.09, "{gap}");
    assert!(summary.energy_drift < 0.02 && summary.ledger_residual < 1e-12, "{summary:?}");
}

#[test]
fn erosion_gives_the_same_bits_with_any_number_of_threads() {
    let mut model = bullet([24, 180]);
    model.run.end = 2.5e-5;
    let hash = |threads: usize| {
        let mut simulation = Simulation::new(&model, &Options { threads, simd: None }).unwrap();
        simulation.advance(f64::INFINITY, u64::MAX).unwrap();
        let summary = simulation.summary();
        (summary.threads, summary.state_hash, summary.erosion.map(|erosion| erosion.elements))
    };
    let one = hash(1);
    assert!(one.2.is_some());
    for threads in [2, 3] {
        let other = hash(threads);
        assert_eq!(other.0, threads);
        assert_eq!((&one.1, &one.2), (&other.1, &other.2));
    }
}

#[test]
fn a_criterion_without_what_it_needs_is_refused() {
    let mut model = model(1e-4);
    model.materials.get_mut("soft").unwrap().failure.insert("plastic_strain".into(), 0.1);
    add(&mut model, "body", mapped_rectangle(), [0.0, 0.0]);
    let reported = faults(&model);
    assert!(reported.len() == 1 && reported[0].contains("plastic strain"), "{reported:?}");
    model.materials.get_mut("soft").unwrap().failure = [("plastic_strian".to_string(), 0.1)].into();
    assert!(faults(&model)[0].contains("no criterion"));
}
