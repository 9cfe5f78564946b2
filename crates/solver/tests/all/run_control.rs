//! What a run is controlled by: mass scaling for longer steps, and relaxation to a state at rest.

use crate::bodies::*;
use embate_solver::model::{Constraint, MassScaling, Model, Obstacle, Relaxation};

/// A bar whose right half has elements of a tenth of the length.
fn uneven_bar() -> Model {
    let mut model = slender(1e-3, 1e9, 1e3);
    let mesh = mapped([20, 2], |u, v| [if u <= 0.5 { 0.2 * u } else { 0.1 + 0.02 * (u - 0.5) }, 0.02 * v]);
    add_mesh(&mut model, "bar", mesh, [0.0, 0.0]);
    model
}

#[test]
fn a_wanted_step_is_reached_and_the_added_mass_is_reported_and_limited() {
    let plain = simulation(&uneven_bar());
    let step = plain.time_step();
    let mut model = uneven_bar();
    model.run.mass_scaling = Some(MassScaling { time_step: 2.0 * step, limit: 1.0, in_run: false });
    let scaled = simulation(&model);
    assert!((scaled.time_step() / (2.0 * step) - 1.0).abs() < 1e-9, "{} {step}", scaled.time_step());
    let masses = [&plain, &scaled].map(|simulation| simulation.overview().parts[0].mass);
    let added = scaled.summary().mass_added;
    assert!((masses[1] - masses[0] - added).abs() < 1e-12 * masses[0] && added > 0.0, "{masses:?} {added}");
    // Only the small elements, which have an eleventh of the mass, four times as heavy.
    assert!((added / masses[0] - 3.0 / 11.0).abs() < 1e-9, "{}", added / masses[0]);
    assert!(scaled.summary().warnings.iter().any(|line| line.text.contains("mass scaling added")));
    model.run.mass_scaling = Some(MassScaling { time_step: 2.0 * step, limit: 0.2, in_run: false });
    let reported = faults(&model);
    assert!(reported.len() == 1 && reported[0].contains("the limit is"), "{reported:?}");
}

/// A soft block that a wall flattens: in the run its elements become short.
fn flattened(element: &str, limit: f64, in_run: bool) -> Model {
    let mut model = model(1.2e-3);
    add(&mut model, "block", rectangle([0.0, 0.0], [0.1, 0.05], [10, 10]), [0.0, -150.0]);
    model.parts[0].element = element.into();
    model.obstacles.push(Obstacle::wall("floor", [0.0, 0.0], [0.0, 1.0]));
    gravity(&mut model, [0.0, -1e5]);
    let step = simulation(&model).time_step();
    model.run.mass_scaling = Some(MassScaling { time_step: 0.99 * step, limit, in_run });
    model
}

#[test]
fn mass_is_added_in_the_run_where_elements_become_short() {
    for element in ["quad4", "quad4_reduced"] {
        let runs = [(1.0, false), (1.0, true), (1e-3, true)].map(|(limit, in_run)| to_end(&flattened(element, limit, in_run)));
        let [first, second, third] = runs.map(|run| run.summary());
        let wanted = flattened(element, 1.0, true).run.mass_scaling.unwrap().time_step;
        let shortest = [&first, &second, &third].map(|summary| summary.stable_time_step_min / wanted);
        println!("{element}: steps {} {} {}, shortest {shortest:.3?} of the wanted one", first.steps, second.steps, third.steps);
        println!("added {:?}, drift {:.1e} {:.1e}", second.mass_added_in_run, first.energy_drift, second.energy_drift);
        assert!(shortest[0] < 0.95 && first.mass_added == 0.0);
        // The end is met by equal steps, which are shorter by at most 1 part in 128.
        assert!(shortest[1] > 0.99, "{shortest:?}");
        let added = second.mass_added_in_run.unwrap();
        assert!(added.mass > 0.0 && added.mass == second.mass_added && added.momentum > 0.0 && added.kinetic_energy > 0.0);
        assert!(second.ledger_residual < 1e-12 && second.energy_drift < 2.0 * first.energy_drift + 1e-4, "{}", second.energy_drift);
        assert!(third.mass_added <= 1e-3 * 5.0 && shortest[2] < 0.95, "{shortest:?}");
        assert!(third.warnings.iter().any(|line| line.text.contains("more than `limit` allows")), "{:?}", third.warnings);
    }
    let mut model = flattened("quad4", 1.0, true);
    // What parts bring at the start is none of the limit's matter.
    model.parts[0].mass_scale = 2.0;
    model.run.mass_scaling.as_mut().unwrap().time_step *= 2f64.sqrt();
    let summary = to_end(&model).summary();
    assert!(summary.mass_added_in_run.is_some() && summary.mass_added > 5.0, "{summary:?}");
    let model = flattened("quad4", 1.0, true);
    crate::restart::continues("mass in the run", &model, simulation(&model).overview().steps_expected * 2 / 3);
    hash_of_equal_bits(&model, &[1, 2], "mass in the run");
}

#[test]
fn scaled_mass_resists_but_does_not_weigh() {
    // A block hangs from its top: the reaction is its true weight; in free fall it would fall more slowly.
    let mut model = slender(2e-2, 1e7, 1e3);
    add(&mut model, "block", rectangle([0.0, 0.0], [0.02, 0.1], [2, 10]), [0.0, 0.0]);
    gravity(&mut model, [0.0, -10.0]);
    model.parts[0].mass_scale = 4.0;
    let falling = to_end(&model);
    let velocity = value(&falling, "block.vy");
    assert!((velocity + 0.25 * 10.0 * 2e-2).abs() < 1e-12, "{velocity}");
    assert!((falling.summary().mass_added / (3.0 * 1e3 * 0.02 * 0.1) - 1.0).abs() < 1e-12);
}

#[test]
fn a_hanging_bar_relaxes_to_its_closed_form_and_the_run_ends() {
    let (young, density, length) = (1e7, 1e3, 0.1);
    let mut model = slender(1.0, young, density);
    add(&mut model, "bar", rectangle([0.0, 0.0], [0.02, length], [2, 20]), [0.0, 0.0]);
    model.constraints.push(Constraint {
        on: "bar.top".into(),
        velocity: [Some(0.0.into()), Some(0.0.into()), None],
        ..Constraint::default()
    });
    probe(&mut model, "foot", "bar", [0.0, 0.0]);
    gravity(&mut model, [0.0, -10.0]);
    model.run.relaxation = Some(Relaxation { tolerance: 1e-8, from: 0.0 });
    let simulation = to_end(&model);
    // ½ ρ g L² / E, small.
    let expected = 0.5 * density * 10.0 * length * length / young;
    let found = -value(&simulation, "foot.y");
    let period = 4.0 * length / (young / density).sqrt();
    let summary = simulation.summary();
    println!("{found} {expected} after {} periods {summary:?}", simulation.time() / period);
    assert!((found / expected - 1.0).abs() < 2e-3, "{found} {expected}");
    assert!(simulation.time() < 10.0 * period, "{} {period}", simulation.time());
    assert!(summary.warnings.iter().any(|line| line.text.contains("at rest at")), "{summary:?}");
    assert_eq!(summary.rest, Some(simulation.time()));
    assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 1e-2, "{summary:?}");
}
