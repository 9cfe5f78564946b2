//! Whole runs with fast bodies and thin plates: nothing passes, at more than ten thicknesses in a step, with
//! the settings that a user gets.
//!
//! The plates are heavy and soft: their waves are so slow that the projectile's elements set the step, thin
//! as the plates are.
#![allow(clippy::unwrap_used)] // what tests call may stop a test like the tests themselves

use crate::bodies::*;
use embate_solver::model::Model;

const SPEED: f64 = 70.0;
/// Segments on each side of a plate.
const SEGMENTS: usize = 40;

/// Plates of 0.2 m length one below the other, the top of the first at y = 0; a gap of zero lets them touch.
fn plates(names: &[&str], thickness: f64, gap: f64, end: f64) -> Model {
    let mut model = model(end);
    model.materials.insert("heavy".into(), elastic(1.5e9, 1e8));
    for (i, name) in names.iter().enumerate() {
        let top = -(i as f64) * (thickness + gap);
        add(&mut model, name, rectangle([-0.1, top - thickness], [0.2, thickness], [SEGMENTS, 1]), [0.0, 0.0]);
        model.parts[i].material = "heavy".into();
    }
    model
}

/// Adds a projectile of soft material that meets every plate.
fn shoot(model: &mut Model, corner: [f64; 2], size: [f64; 2], elements: [usize; 2], velocity: [f64; 2]) {
    let names: Vec<String> = model.parts.iter().map(|part| part.name.clone()).collect();
    add(model, "projectile", rectangle(corner, size, elements), velocity);
    for pair in names.windows(2) {
        touch(model, &pair[0], &pair[1]);
    }
    for name in names {
        touch(model, "projectile", &name);
    }
}

/// Runs to the end: more than ten thicknesses in a step at first, everybody on its own side at last, momentum
/// and energy kept.
fn nobody_passes(model: &Model, thickness: f64, place: &str) {
    let plates = model.parts.len() - 1;
    let (simulation, history) = run(model);
    assert!(SPEED * history.first("time_step") > 10.0 * thickness, "{place}");
    let positions = simulation.frame().positions::<2>().to_vec();
    let nodes = 2 * (SEGMENTS + 1);
    let highest = positions[..nodes].iter().map(|x| x[1]).fold(f64::NEG_INFINITY, f64::max);
    assert!(positions[plates * nodes..].iter().all(|x| x[1] > highest + 10.0 * thickness), "{place}: it is back above the plates");
    for column in 0..=SEGMENTS {
        let middle = |plate: usize| 0.5 * (positions[plate * nodes + column][1] + positions[plate * nodes + SEGMENTS + 1 + column][1]);
        assert!((1..plates).all(|plate| middle(plate) < middle(plate - 1)), "{place}: plates keep their order in column {column}");
    }
    assert!(history.last("projectile.vy") > 0.5 * SPEED && history.last(&format!("{}.vy", model.parts[plates - 1].name)) <= 0.0, "{place}");
    let summary = simulation.summary();
    assert!(summary.penetration_max > 3.0 * thickness, "{place}: it was beyond the plate for a while: {summary:?}");
    assert!(summary.energy_drift <= 0.01 && summary.ledger_residual <= 1e-12, "{place}: {summary:?}");
    assert!(summary.momentum_drift_linear.unwrap() <= 1e-12 && summary.momentum_drift_angular.unwrap() <= 1e-12, "{place}: {summary:?}");
}

#[test]
fn a_block_that_moves_ten_thicknesses_in_a_step_does_not_pass_a_plate() {
    let thickness = 3e-5;
    for k in 0..8 {
        // At the moment of impact it is anywhere between two steps.
        let height = 1.1e-3 + 5e-5 * f64::from(k);
        let mut model = plates(&["plate"], thickness, 0.0, 2e-4);
        shoot(&mut model, [-0.0231, height], [0.05, 0.03], [5, 3], [0.0, -SPEED]);
        nobody_passes(&model, thickness, &format!("height {height}"));
    }
}

#[test]
fn a_row_of_three_plates_that_is_shot_through_in_one_step_stops_a_block() {
    let thickness = 3e-5;
    for gap in [0.0, 1.0, 3.0, 20.0] {
        for k in 0..4 {
            let height = 1.1e-3 + 1e-4 * f64::from(k);
            let mut model = plates(&["one", "two", "three"], thickness, gap * thickness, 2e-4);
            shoot(&mut model, [-0.0231, height], [0.05, 0.03], [5, 3], [0.0, -SPEED]);
            nobody_passes(&model, thickness, &format!("gap {gap}, height {height}"));
        }
    }
}

#[test]
fn a_needle_that_comes_aslant_does_not_pass_between_the_nodes_of_a_plate() {
    // Both corners of its tip within one segment, near the plate's nodes, or on them.
    let thickness = 6e-6;
    for left in [-0.02, -0.0199, -0.0195, -0.019, -0.0182, -0.017, -0.0161] {
        for across in [-20.0, 0.0, 20.0] {
            let mut model = plates(&["plate"], thickness, 0.0, 6e-5);
            shoot(&mut model, [left, 4e-4], [0.002, 0.02], [1, 10], [across, -SPEED]);
            nobody_passes(&model, thickness, &format!("left {left}, across {across}"));
        }
    }
}
