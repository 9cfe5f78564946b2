//! Whole models without contact against closed forms: free fall, driven and spinning bars, waves, energy,
//! equal bits for any threads.

use crate::long::is_long;
use crate::patches::{DENSITY, every_pair, material, modulus_along_x, nodes_of, solids, stay_elastic};
use embate_lanes::Level;
use embate_solver::model::{Constraint, ImportedMesh, Load, MeshGroup, Model, Part, Rectangle, Run, Shape};
use embate_solver::simulation::{Options, Simulation};
use std::sync::Arc;

const GRAVITY: f64 = 9.81;
const SERIAL: Options = Options { threads: 1, simd: None };

/// Every pair whose element can fill a rectangle; `mixed` and `nodal_pressure` have models of triangles.
fn every_bar(mut check: impl FnMut(&'static str, &'static str)) {
    every_pair(|element, law| {
        if nodes_of(element) == 4 {
            check(element, law);
        }
    });
}

/// A rectangle from the origin, called `bar`.
fn bar(element: &str, law: &str, size: [f64; 2], elements: [usize; 2], end: f64) -> Model {
    Model {
        name: "bar".into(),
        run: Run { end, ..Run::default() },
        materials: [("m".to_string(), material(law, 0.3))].into(),
        parts: vec![Part {
            name: "bar".into(),
            material: "m".into(),
            element: element.into(),
            shape: Shape::Rectangle(Rectangle { corner: [0.0; 2], size, elements, ..Rectangle::default() }),
            ..Part::default()
        }],
        ..Model::default()
    }
}

/// One part for every element of a bar, each with the velocity that `velocity` gives its centre; neighbours
/// share nodes.
fn bar_of_parts(law: &str, size: [f64; 2], elements: [usize; 2], end: f64, velocity: impl Fn([f64; 2]) -> [f64; 2]) -> Model {
    let [nx, ny] = elements;
    let place = |i: f64, j: f64| [size[0] * (i / nx as f64 - 0.5), size[1] * (j / ny as f64 - 0.5)];
    let positions = (0..(nx + 1) * (ny + 1)).map(|k| crate::bodies::in_3d(place((k % (nx + 1)) as f64, (k / (nx + 1)) as f64))).collect();
    let mut model = bar("quad4", law, size, elements, end);
    model.parts.clear();
    let mut groups = Vec::new();
    for k in 0..nx * ny {
        let (i, j) = (k % nx, k / nx);
        let a = (j * (nx + 1) + i) as u32;
        let name = format!("e{k}");
        groups.push(MeshGroup { name: name.clone(), dimension: 2, cells: vec![vec![a, a + 1, a + 2 + nx as u32, a + 1 + nx as u32]] });
        let velocity = velocity(place(i as f64 + 0.5, j as f64 + 0.5));
        model.parts.push(Part {
            name: format!("part{k}"),
            material: "m".into(),
            shape: Shape::Group { mesh: 0, group: name },
            velocity: embate_solver::model::in_3d(velocity),
            ..Part::default()
        });
    }
    model.meshes.push(Arc::new(ImportedMesh { source: "bar".into(), positions, groups, ..ImportedMesh::default() }));
    model
}

fn hold(model: &mut Model, on: &str, velocity: [Option<f64>; 2]) {
    model.constraints.push(Constraint {
        on: on.into(),
        velocity: embate_solver::model::in_3d(velocity.map(|velocity| velocity.map(Into::into))),
        ..Constraint::default()
    });
}

fn gravity(model: &mut Model) {
    model.loads.push(Load::Gravity { parts: Vec::new(), acceleration: [0.0, -GRAVITY, 0.0], curve: None });
}

fn simulation(model: &Model) -> Simulation {
    Simulation::new(model, &SERIAL).unwrap()
}

fn finished(model: &Model) -> Simulation {
    let mut simulation = simulation(model);
    simulation.advance(model.run.end, u64::MAX).unwrap();
    simulation
}

/// Values of a field now, by node or cell.
fn field(simulation: &Simulation, name: &str) -> Vec<f64> {
    simulation.frame().fields.into_iter().find(|field| field.kind.name == name).unwrap().values
}

#[test]
fn a_body_that_starts_from_rest_falls_on_the_exact_parabola() {
    every_bar(|element, law| {
        let mut model = bar(element, law, [1.0, 0.2], [5, 2], 0.5);
        gravity(&mut model);
        let mut simulation = simulation(&model);
        let start = simulation.frame().positions::<2>().to_vec();
        while simulation.time() < 0.5 {
            // The very first steps are the test of the energy drift: there is next to no energy yet.
            simulation.advance(0.5, 1).unwrap();
            let (t, mass) = (simulation.time(), DENSITY * 0.2);
            let drop = 0.5 * GRAVITY * t * t;
            for (x, x0) in simulation.frame().positions::<2>().iter().zip(&start) {
                assert!((x[1] - x0[1] + drop).abs() < 1e-11 && (x[0] - x0[0]).abs() < 1e-11, "{element} {law} at {t}");
            }
            assert!(field(&simulation, "velocity").chunks_exact(2).all(|v| (v[1] + GRAVITY * t).abs() < 1e-9), "{element} {law} at {t}");
            assert!((simulation.ledger().external / (mass * GRAVITY * drop) - 1.0).abs() < 1e-9, "{element} {law}");
        }
        assert!(simulation.ledger().drift() < 1e-3, "{element} {law}: {}", simulation.ledger().drift());
        assert!(simulation.ledger().residual() < 1e-12);
    });
}

#[test]
fn a_bar_at_rest_on_its_support_takes_gravity_without_a_false_alarm() {
    every_bar(|element, law| {
        let mut model = bar(element, law, [1.0, 0.2], [5, 1], 0.5);
        gravity(&mut model);
        hold(&mut model, "bar.bottom", [Some(0.0), Some(0.0)]);
        let simulation = finished(&model);
        assert!(simulation.ledger().drift() < 0.03, "{element} {law}: {}", simulation.ledger().drift());
        assert!(simulation.ledger().residual() < 1e-12);
    });
}

#[test]
fn a_body_on_which_nothing_acts_stays_at_rest() {
    every_bar(|element, law| {
        let simulation = finished(&bar(element, law, [1.0, 0.2], [5, 2], 50.0));
        assert!(simulation.steps() > 10_000);
        assert!(simulation.ledger().stores.total().abs() < 1e-20, "{element} {law}");
    });
}

#[test]
fn time_zero_shows_the_initial_velocity_and_parts_share_the_kinetic_energy() {
    let mut model = bar_of_parts("elastic", [1.0, 0.5], [4, 2], 0.2, |[x, _]| [0.1, 3.0 * x]);
    gravity(&mut model);
    let mut simulation = simulation(&model);
    // Shared nodes move with the momentum of both neighbours.
    let expected = [-1.125, -0.75, 0.0, 0.75, 1.125];
    let velocity = field(&simulation, "velocity");
    for (k, v) in velocity.chunks_exact(2).enumerate() {
        let x = simulation.frame().positions::<2>()[k][0];
        let expected = expected[((x + 0.5) * 4.0).round() as usize];
        assert!((v[0] - 0.1).abs() < 1e-15 && (v[1] - expected).abs() < 1e-14, "node {k} at {x}: {v:?}");
    }
    let columns = simulation.history_columns();
    loop {
        let row = simulation.history_row();
        let value = |wanted: &dyn Fn(&str) -> bool| columns.iter().zip(&row).filter(|(name, _)| wanted(name)).map(|(_, v)| v).sum::<f64>();
        for kind in ["kinetic", "internal", "plastic"] {
            let (all, parts) =
                (value(&|name| name == format!("energy.{kind}")), value(&|name| name.starts_with(&format!("energy.{kind}["))));
            assert!((all - parts).abs() < 1e-12, "{kind} at {}: {all} and {parts}", simulation.time());
        }
        if simulation.time() >= 0.2 {
            break;
        }
        simulation.advance(0.2, 1).unwrap();
    }
}

#[test]
fn a_spinning_bar_has_the_stress_of_its_spin_and_keeps_its_momenta() {
    // σ_max = ρ ω² L² / 8 in the middle of a slender bar; it swings about this after its sudden start, so the
    // mean over whole swings is taken.
    const LENGTH: f64 = 2.0;
    const SPIN: f64 = 1.0;
    let mut model = bar_of_parts("elastic", [LENGTH, 0.1], [40, 2], 8.0, |[x, y]| [-SPIN * y, SPIN * x]);
    model.output.include = vec!["stress".into()];
    let mut simulation = simulation(&model);
    let (mut sum, mut count) = (0.0, 0);
    for k in 1..=400 {
        simulation.advance(8.0 * f64::from(k) / 400.0, u64::MAX).unwrap();
        let (stress, angle) = (field(&simulation, "stress"), SPIN * simulation.time());
        let (s, c) = angle.sin_cos();
        // Along the bar, in the four elements around the middle.
        for cell in [19, 20, 59, 60] {
            let [xx, yy, _, xy] = stress[4 * cell..4 * cell + 4] else { panic!() };
            (sum, count) = (sum + c * c * xx + s * s * yy + 2.0 * c * s * xy, count + 1);
        }
    }
    let (mean, expected) = (sum / f64::from(count), DENSITY * SPIN * SPIN * LENGTH * LENGTH / 8.0);
    assert!((mean / expected - 1.0).abs() < 0.02, "{mean} for {expected}");
    struct Silent;
    impl embate_solver::simulation::Observer for Silent {
        fn frame(&mut self, _: embate_solver::output::Frame) -> Result<(), embate_solver::simulation::ObserverError> {
            Ok(())
        }
        fn row(&mut self, _: &[f64]) -> Result<(), embate_solver::simulation::ObserverError> {
            Ok(())
        }
        fn progress(&mut self, _: &embate_solver::simulation::Progress<'_>) -> embate_solver::simulation::Control {
            embate_solver::simulation::Control::Continue
        }
    }
    for law in solids() {
        let mut model = bar_of_parts(law.name, [LENGTH, 0.1], [40, 2], 3.0, |[x, y]| [-SPIN * y, SPIN * x]);
        model.run.end = 3.0;
        let mut simulation = Simulation::new(&model, &SERIAL).unwrap();
        simulation.run(&mut Silent).unwrap();
        let summary = simulation.summary();
        let (linear, angular) = (summary.momentum_drift_linear.unwrap(), summary.momentum_drift_angular.unwrap());
        assert!(linear < 1e-12 && angular < 1e-12, "{}: {linear} {angular}", law.name);
        assert!(
            summary.ledger_residual < 1e-12 && summary.energy_drift < 5e-3,
            "{}: {} {}",
            law.name,
            summary.ledger_residual,
            summary.energy_drift
        );
    }
}

#[test]
fn a_pressure_wave_runs_with_the_speed_of_sound() {
    // c = √((K + 4µ/3)/ρ) between guides that keep the width; half of the end's velocity passes with the
    // front.
    const SPEED: f64 = 0.01;
    every_bar(|element, law| {
        let mut model = bar(element, law, [10.0, 0.05], [200, 1], 0.4);
        // Axes along the guides, else a pull would shear.
        if let Some(angle) = model.materials.get_mut("m").and_then(|m| m.parameters.get_mut("angle")) {
            *angle = 0.0;
        }
        for side in ["bar.bottom", "bar.top"] {
            hold(&mut model, side, [None, Some(0.0)]);
        }
        hold(&mut model, "bar.left", [Some(SPEED), None]);
        let mut simulation = simulation(&model);
        let c = (modulus_along_x(element, &model.materials["m"]) / DENSITY).sqrt();
        simulation.advance(0.3, u64::MAX).unwrap();
        let (velocity, positions) = (field(&simulation, "velocity"), simulation.frame().positions::<2>().to_vec());
        // Where the velocity falls through its half, between the nodes of the lower side.
        let v = |k: usize| velocity[2 * k] - 0.5 * SPEED;
        let last = (0..200).rfind(|&k| v(k) > 0.0).unwrap_or(0);
        let (front, expected) = (0.05 * (last as f64 + v(last) / (v(last) - v(last + 1))), c * simulation.time());
        assert!(positions.len() == 402 && (front - expected).abs() < 0.05, "{element} {law}: the front is at {front}, not {expected}");
        // Behind it: p = ρ c v.
        let stress = field(&simulation, "stress")[4 * 60];
        assert!((stress / (-DENSITY * c * SPEED) - 1.0).abs() < 0.05, "{element} {law}: {stress}");
    });
}

#[test]
fn waves_are_as_slow_as_their_mesh_and_step_make_them() {
    // Between guides and fixed ends the mode sin kx of a row of elements of length h is one of a chain of
    // masses and springs: after n steps by central differences its displacement is Δt V sin(nθ) / sin θ with
    // sin(θ/2) = (c Δt / h) sin(kh/2), for long waves and for those of two elements.
    const ELEMENTS: usize = 16;
    const SIZE: f64 = 0.05;
    const SPEED: f64 = 1e-6;
    for element in ["quad4", "quad4_full", "quad4_reduced", "quad4_reduced_assumed_strain"] {
        for mode in [1, 5, 10, 15] {
            let k = mode as f64 * std::f64::consts::PI / (ELEMENTS as f64 * SIZE);
            // Each node gets the mean of the elements beside it, cos(kh/2) of the wave.
            let length = ELEMENTS as f64 * SIZE;
            let wave = |[x, _]: [f64; 2]| [SPEED * (k * (x + 0.5 * length)).sin() / (0.5 * k * SIZE).cos(), 0.0];
            let mut model = bar_of_parts("elastic", [length, SIZE], [ELEMENTS, 1], 1.0, wave);
            model.parts.iter_mut().for_each(|part| part.element = element.into());
            let ends = [0, ELEMENTS].map(|i| vec![i as u32, (i + ELEMENTS + 1) as u32]);
            let rows = [0, ELEMENTS + 1].map(|first| (0..ELEMENTS).map(|i| vec![(first + i) as u32, (first + i + 1) as u32]).collect());
            let mesh = Arc::get_mut(&mut model.meshes[0]).unwrap();
            mesh.groups.push(MeshGroup { name: "ends".into(), dimension: 1, cells: ends.into() });
            mesh.groups.push(MeshGroup {
                name: "guides".into(),
                dimension: 1,
                cells: rows.into_iter().flat_map(|row: Vec<_>| row).collect(),
            });
            hold(&mut model, "ends", [Some(0.0), None]);
            hold(&mut model, "guides", [None, Some(0.0)]);
            let c = (modulus_along_x(element, &model.materials["m"]) / DENSITY).sqrt();
            let mut simulation = simulation(&model);
            let start = simulation.frame().positions::<2>().to_vec();
            simulation.advance(f64::INFINITY, 100).unwrap();
            let steps = simulation.steps() as f64;
            let dt = simulation.time() / steps;
            let theta = 2.0 * (c * dt / SIZE * (0.5 * k * SIZE).sin()).asin();
            let displacement = field(&simulation, "displacement");
            for (u, [x, _]) in displacement.chunks_exact(2).zip(start) {
                let expected = dt * SPEED * (steps * theta).sin() / theta.sin() * (k * (x + 0.5 * length)).sin();
                // Faster motion is not linear, slower motion is lost in the digits of the positions: 1e-6
                // both.
                let error = (u[0] - expected) / (dt * SPEED / theta.sin());
                assert!(error.abs() < 1e-5, "{element}, mode {mode}, x = {x}: {error}");
            }
        }
    }
}

/// Largest drift of a swinging cantilever at a fraction of the stable step.
fn cantilever(law: &str, safety: f64) -> f64 {
    let mut model = bar("quad4", law, [2.0, 0.4], [16, 4], 0.6);
    model.materials.values_mut().for_each(stay_elastic);
    model.run.safety = safety;
    model.run.energy_limit = 0.5;
    model.parts[0].velocity = [0.0, 3.0, 0.0];
    hold(&mut model, "bar.left", [Some(0.0), Some(0.0)]);
    let simulation = finished(&model);
    assert!(simulation.ledger().residual() < 1e-12, "{law}");
    let moved = field(&simulation, "displacement").iter().fold(0.0f64, |most, u| most.max(u.abs()));
    assert!(moved > 0.3, "{law}: large motion, {moved}");
    simulation.ledger().drift()
}

#[test]
fn the_energy_drift_of_a_swinging_cantilever_falls_with_the_square_of_the_step() {
    for law in solids() {
        let drifts = [0.8, 0.4, 0.2].map(|safety| cantilever(law.name, safety));
        println!("{}: {drifts:?}", law.name);
        assert!(drifts[0] < 0.01, "{}: {drifts:?}", law.name);
        assert!((drifts[0] / drifts[2]).log2() / 2.0 > 1.7, "{}: {drifts:?}", law.name);
    }
}

#[test]
fn the_work_of_prescribed_motion_is_the_energy_of_the_body() {
    every_bar(|element, law| {
        let mut model = bar(element, law, [1.0, 0.3], [8, 3], 0.3);
        hold(&mut model, "bar.left", [Some(0.0), Some(0.0)]);
        hold(&mut model, "bar.right", [Some(0.5), Some(-0.2)]);
        let mut simulation = simulation(&model);
        let start = simulation.ledger().stores.total();
        simulation.advance(0.3, u64::MAX).unwrap();
        let ledger = simulation.ledger();
        assert!(ledger.external > 0.3, "{element} {law}: {}", ledger.external);
        let gain = ledger.stores.total() - start;
        assert!((gain / ledger.external - 1.0).abs() < 1e-3, "{element} {law}: {gain} for {}", ledger.external);
        assert!(ledger.residual() < 1e-12 && ledger.drift() < 1e-3, "{element} {law}: {} {}", ledger.residual(), ledger.drift());
        assert_eq!(ledger.works.gravity + ledger.works.contact, 0.0);
    });
}

#[test]
fn any_number_of_threads_and_every_instruction_set_give_the_same_state() {
    for law in solids() {
        let mut model = bar("quad4", law.name, [1.0, 1.0], [70, 65], 1.0);
        model.run.max_steps = Some(25);
        model.parts[0].velocity = [-3.0, 0.5, 0.0];
        gravity(&mut model);
        hold(&mut model, "bar.left", [Some(0.0), None]);
        hold(&mut model, "bar.bottom", [None, Some(0.0)]);
        let outcome = |threads: usize, simd: &str| {
            let mut simulation = Simulation::new(&model, &Options { threads, simd: Some(simd.into()) }).unwrap();
            simulation.advance(1.0, u64::MAX).unwrap();
            let (summary, row) = (simulation.summary(), simulation.history_row());
            assert_eq!((summary.steps, summary.threads, summary.simd.as_str()), (25, threads, simd));
            (summary.state_hash, summary.energy_drift.to_bits(), row.into_iter().map(f64::to_bits).collect::<Vec<_>>())
        };
        let reference = outcome(1, "scalar");
        for &threads in if is_long() { &[2, 7][..] } else { &[7] } {
            for level in Level::available() {
                assert!(outcome(threads, level.name()) == reference, "{}: {threads} threads, {}", law.name, level.name());
            }
        }
    }
}
