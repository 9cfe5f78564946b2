//! Stress and temperature at the start: bodies in equilibrium stay at rest, released bars send out the waves
//! of the closed form, energies are in the ledger from the start, and what a law can't hold is refused.

use crate::bodies::*;
use crate::patches::{Body, Patch, YOUNG, every_pair, material, patch};
use embate_solver::block::Initial;
use embate_solver::element::ELEMENTS;
use embate_solver::material::variable::{PLASTIC_STRAIN, TEMPERATURE};
use embate_solver::model::{Constraint, Drive, InitialStress, Load, Model, Polygon, Shape};
use embate_solver::simulation::Simulation;

/// One that has run to its end, and how far a node has gone at most, m.
fn farthest(model: &Model) -> (Simulation, f64) {
    let start = simulation(model).frame().positions::<2>().to_vec();
    let simulation = to_end(model);
    let end = simulation.frame().positions::<2>().to_vec();
    let most = start.iter().flatten().zip(end.iter().flatten()).fold(0.0f64, |most, (x, y)| most.max((x - y).abs()));
    (simulation, most)
}

fn push(model: &mut Model, on: &str, pressure: f64) {
    model.loads.push(Load::Pressure { on: on.into(), pressure, curve: None });
}

#[test]
fn a_block_under_the_pressure_that_its_stress_asks_for_stays_at_rest() {
    for kind in ELEMENTS {
        for state in ["plane_strain", "plane_stress", "axisymmetric"] {
            // One point takes the radius for the same all over the element: at the axis and the rim it does
            // not balance a pressure exactly.
            if state == "axisymmetric" && kind.name.starts_with("quad4_reduced") {
                continue;
            }
            let mut model = model(1e-3);
            let shape = if kind.is_triangle() {
                let outline = vec![[0.0, 0.0], [0.08, 0.0], [0.08, 0.05], [0.0, 0.05]];
                Shape::Polygon(Polygon { outline, size: 0.01, ..Polygon::default() })
            } else {
                mapped_rectangle()
            };
            add(&mut model, "block", shape, [0.0; 2]);
            let part = &mut model.parts[0];
            (part.element, part.element_triangles) = (kind.name.into(), kind.name.into());
            part.stress_state = state.into();
            // Radial and hoop stress of an axisymmetric body are alike, or it would not rest.
            let zz = if state == "plane_stress" { 0.0 } else { -3e6 };
            part.stress_initial = Some(InitialStress::uniform([-3e6, -5e6, zz, 0.0]));
            if kind.is_triangle() {
                push(&mut model, "block", 3e6);
                model.parts[0].stress_initial = Some(InitialStress::uniform([-3e6, -3e6, zz, 0.0]));
            } else {
                let sides = if state == "axisymmetric" { vec![("right", 3e6)] } else { vec![("left", 3e6), ("right", 3e6)] };
                sides
                    .into_iter()
                    .chain([("bottom", 5e6), ("top", 5e6)])
                    .for_each(|(side, p)| push(&mut model, &format!("block.{side}"), p));
            }
            let (simulation, moved) = farthest(&model);
            let summary = simulation.summary();
            // Under the pressure alone it would move by 3e6/1e9 of its length.
            assert!(moved < 1e-13, "{} {state}: {moved:e} m in {} steps", kind.name, summary.steps);
            assert!(summary.steps > 30 && summary.energy_drift < 1e-12, "{} {state}: {summary:?}", kind.name);
        }
    }
}

#[test]
fn soil_under_its_own_weight_and_the_stress_that_bears_it_stays_at_rest() {
    let (density, gravity_, depth) = (1000.0, 9.81, 0.05);
    for kind in ELEMENTS.iter().filter(|kind| kind.nodes() == 4) {
        let mut model = model(2e-3);
        add(&mut model, "soil", mapped_rectangle(), [0.0; 2]);
        model.parts[0].element = kind.name.into();
        let weight = density * gravity_;
        let per_y = [0.4 * weight, weight, 0.4 * weight, 0.0];
        model.parts[0].stress_initial = Some(InitialStress { per_y, point: [0.0, depth], ..InitialStress::default() });
        gravity(&mut model, [0.0, -gravity_]);
        let still = || Some(Drive::Constant(0.0));
        let hold = |on: &str, velocity| Constraint { on: on.into(), velocity, ..Constraint::default() };
        model.constraints.push(hold("soil.bottom", [still(), still(), None]));
        model.constraints.extend(["soil.left", "soil.right"].map(|on| hold(on, [still(), None, None])));
        let (_, moved) = farthest(&model);
        // Without it the soil would sink by ρ g h²/2M, 1e-8 m.
        assert!(moved < 1e-19, "{}: {moved:e}", kind.name);
    }
}

#[test]
fn a_bar_that_is_let_go_has_the_waves_of_the_closed_form() {
    // Pulled by σ, held on the left, free on the right at t = 0: a wave of velocity −σ/ρc runs in and leaves
    // no stress behind it.
    let (young, density, length, stress) = (1e9, 1e3, 0.1, 1e5);
    let c = f64::sqrt(young / density);
    let mut model = slender(1.5 * length / c, young, density);
    add(&mut model, "bar", rectangle([0.0, 0.0], [length, 1e-3], [200, 1]), [0.0; 2]);
    model.parts[0].stress_initial = Some(InitialStress::uniform([stress, 0.0, 0.0, 0.0]));
    model.constraints.push(Constraint {
        on: "bar.left".into(),
        velocity: [Some(Drive::Constant(0.0)), None, None],
        ..Constraint::default()
    });
    probe(&mut model, "end", "bar", [length, 0.0]);
    probe(&mut model, "middle", "bar", [0.5 * length, 0.0]);
    let mut simulation = simulation(&model);
    let stored = 0.5 * stress * stress / young * length * 1e-3;
    let before = simulation.ledger().stores;
    assert!((before.elastic / stored - 1.0).abs() < 1e-12 && before.kinetic.abs() < 1e-2 * stored, "{before:?}");
    let wave = -stress / (density * c);
    simulation.advance(0.5 * length / c, u64::MAX).unwrap();
    // The wave is half way: half of the bar moves and has no stress.
    let half = simulation.ledger().stores;
    assert!((half.kinetic / stored - 0.5).abs() < 0.01 && (half.elastic / stored - 0.5).abs() < 0.01, "{half:?} of {stored}");
    assert!((value(&simulation, "end.vx") / wave - 1.0).abs() < 0.05, "{}", value(&simulation, "end.vx"));
    assert!((value(&simulation, "bar.vx") / (0.5 * wave) - 1.0).abs() < 0.01, "{}", value(&simulation, "bar.vx"));
    simulation.advance(length / c, u64::MAX).unwrap();
    let all = simulation.ledger().stores;
    assert!((all.kinetic / stored - 1.0).abs() < 0.02, "{all:?} of {stored}");
    assert!((value(&simulation, "middle.vx") / wave - 1.0).abs() < 0.05);
    simulation.advance(f64::INFINITY, u64::MAX).unwrap();
    // It comes back from the wall as a compression: half of the bar is at rest under −σ.
    assert!((value(&simulation, "bar.vx") / (0.5 * wave) - 1.0).abs() < 0.02);
    let summary = simulation.summary();
    assert!(summary.energy_drift < 1e-3 && summary.ledger_residual < 1e-12, "{summary:?}");
}

/// A block of one element that is stretched and sheared by so much.
fn strained(element: &str, law: &str, size: f64) -> (Patch, Body) {
    let patch = patch(element, 1, 0.0);
    let mut body = Body::of(element, &material(law, 0.3), &patch);
    for _ in 0..10 {
        body.map(|[x, y]| [x + 0.1 * size * (x + 0.4 * y), y + 0.1 * size * (0.4 * x - 0.3 * y)]);
    }
    (patch, body)
}

#[test]
fn the_books_begin_with_the_energy_that_it_takes_to_get_there() {
    let mut seen = 0;
    every_pair(|element, law| {
        // What viscoelastic bodies have at the start has relaxed; rubber and what holds no such stress is
        // refused.
        if law == "viscoelastic" {
            return;
        }
        let (patch, there) = strained(element, law, 1e-7);
        let s = there.block.state(0).stress;
        let mut here = Body::of(element, &material(law, 0.3), &patch);
        let stress = InitialStress::uniform([s[0], s[1], s[2], s[3]]);
        let begun = here.block.begin(&Initial { stress: Some(&stress), temperature: None }, &patch.positions);
        if begun.is_err() {
            return;
        }
        here.map(|x| x);
        assert!(
            (here.report.stored / there.report.stored - 1.0).abs() < 1e-6,
            "{element} {law}: {} {}",
            here.report.stored,
            there.report.stored
        );
        let forces = |body: &Body| body.forces().into_iter().flatten().collect::<Vec<f64>>();
        assert!(forces(&here).iter().zip(forces(&there)).all(|(f, g)| (f - g).abs() < 1e-6 * s[0].abs()), "{element} {law}");
        seen += 1;
    });
    assert!(seen > 15, "{seen}");
}

#[test]
fn metal_yields_at_the_flow_stress_of_its_initial_temperature() {
    for temperature in [300.0, 700.0, 1200.0] {
        let mut metal = material("johnson_cook", 0.3);
        for (name, value) in [("yield", 2.0), ("strength", 3.0), ("temperature_reference", 300.0), ("temperature_melt", 1300.0)] {
            metal.parameters.insert(name.into(), value);
        }
        let own = [("softening_exponent", 1.1), ("taylor_quinney", 1e-12), ("hardening_exponent", 0.5), ("temperature", 300.0)];
        metal.parameters.extend(own.map(|(name, value)| (name.to_string(), value)));
        let patch = patch("quad4", 1, 0.0);
        let mut body = Body::of("quad4", &metal, &patch);
        body.block.begin(&Initial { stress: None, temperature: Some(temperature) }, &patch.positions).unwrap();
        for _ in 0..100 {
            body.map(|[x, y]| [x + 1e-3 * y, y]);
        }
        let state = body.block.state(0);
        let s = state.stress;
        let differences = (s[0] - s[1]).powi(2) + (s[1] - s[2]).powi(2) + (s[2] - s[0]).powi(2);
        let mises = (0.5 * differences + 3.0 * s[3] * s[3]).sqrt();
        let plastic = body.block.variable(&state, &PLASTIC_STRAIN).unwrap();
        let expected = (2.0 + 3.0 * plastic.sqrt()) * (1.0 - ((temperature - 300.0) / 1000.0).powf(1.1));
        assert!(plastic > 0.01 && (mises / expected - 1.0).abs() < 1e-9, "{temperature}: {mises} for {expected}");
        assert!((body.block.variable(&state, &TEMPERATURE).unwrap() - temperature).abs() < 1e-6);
    }
}

#[test]
fn what_a_law_can_not_hold_is_refused_with_the_reason() {
    let with = |law: &str, stress: [f64; 4]| {
        let mut model = model(1e-4);
        add(&mut model, "block", rectangle([0.0, 0.0], [1.0, 1.0], [2, 2]), [0.0; 2]);
        model.materials.insert("soft".into(), material(law, 0.3));
        model.parts[0].stress_initial = Some(InitialStress::uniform(stress));
        model
    };
    let only = |model: &Model, path: &str, says: &str| {
        let found = model_faults(model);
        assert!(found.len() == 1 && found[0].path == path && found[0].message.contains(says), "{found:?}");
    };
    only(&with("neo_hookean", [1.0; 4]), "part[0].stress_initial", "has its stress from the deformation");
    // Twice the yield stress.
    only(&with("j2", [0.02 * YOUNG, 0.0, 0.0, 0.0]), "part[0].stress_initial", "can't hold the stress at (1.0566e-1, 1.0566e-1) m");
    assert_eq!(model_faults(&with("j2", [0.009 * YOUNG, 0.0, 0.0, 0.0])), []);
    let mut water = with("elastic", [-5.0, -5.0, -5.0, 0.0]);
    let water_like = water.materials.get_mut("soft").unwrap();
    water_like.eos = "linear".into();
    water_like.parameters.insert("bulk_modulus".into(), YOUNG);
    only(&water, "part[0].stress_initial", "can't hold");
    water.parts[0].stress_initial = Some(InitialStress::uniform([5.0, -5.0, 0.0, 1.0]));
    assert_eq!(model_faults(&water), []);
    let mut thin = with("elastic", [1.0; 4]);
    thin.parts[0].stress_state = "plane_stress".into();
    only(&thin, "part[0].stress_initial.zz", "no stress across the plane");
    let mut rigid = with("elastic", [1.0; 4]);
    rigid.parts[0].rigid = Some(driven([None, None], None));
    only(&rigid, "part[0].stress_initial", "rigid");
    let mut endless = with("elastic", [f64::NAN, 0.0, 0.0, 0.0]);
    only(&endless, "part[0].stress_initial.xx", "not a number");
    endless.parts[0].stress_initial = None;
    endless.parts[0].temperature_initial = Some(300.0);
    only(&endless, "part[0].temperature_initial", "knows no temperature");
    endless.parts[0].temperature_initial = Some(-1.0);
    let found = model_faults(&endless);
    assert!(found[0].path == "part[0].temperature_initial" && found[0].message.contains("greater than 0"), "{found:?}");
}
