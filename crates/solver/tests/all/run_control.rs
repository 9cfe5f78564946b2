//! What a run is controlled by: mass scaling for longer steps, and relaxation to a state at rest.

use crate::bodies::*;
use embate_solver::model::{Constraint, MassScaling, Relaxation};

/// A bar whose right half has elements of a tenth of the length.
fn uneven_bar() -> embate_solver::model::Model {
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
    model.run.mass_scaling = Some(MassScaling { time_step: 2.0 * step, limit: 1.0 });
    let scaled = simulation(&model);
    assert!((scaled.time_step() / (2.0 * step) - 1.0).abs() < 1e-9, "{} {step}", scaled.time_step());
    let masses = [&plain, &scaled].map(|simulation| simulation.overview().parts[0].mass);
    let added = scaled.summary().mass_added;
    assert!((masses[1] - masses[0] - added).abs() < 1e-12 * masses[0] && added > 0.0, "{masses:?} {added}");
    // Only the small elements, which have an eleventh of the mass, four times as heavy.
    assert!((added / masses[0] - 3.0 / 11.0).abs() < 1e-9, "{}", added / masses[0]);
    assert!(scaled.summary().warnings.iter().any(|line| line.text.contains("mass scaling added")));
    model.run.mass_scaling = Some(MassScaling { time_step: 2.0 * step, limit: 0.2 });
    let reported = faults(&model);
    assert!(reported.len() == 1 && reported[0].contains("the limit is"), "{reported:?}");
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
