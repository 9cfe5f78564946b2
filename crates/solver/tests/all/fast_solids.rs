//! Solids that meet at the speed of their waves: they hold, and the step is cut only where it must be.
#![allow(clippy::unwrap_used)] // what tests call may stop a test like the tests themselves

use crate::bodies::*;
use embate_solver::model::{Cuboid, Material, Model, Part, Probe, ProbeAt, Shape};

/// Width of the bars, and the speed of waves along them.
const WIDTH: f64 = 2.4e-3;
const WAVE: f64 = 30.2;

/// Two crossed bars of rubber with so many elements across; one is thrown at the other along z.
fn crossed(across: usize, speed: f64) -> Model {
    let mut model = model(3.0 * WIDTH / speed.min(WAVE));
    let numbers = [("young", 1e6), ("poisson", 0.45), ("density", 1100.0)].map(|(key, value)| (key.to_string(), value));
    model.materials.insert("rubber".into(), Material { law: "neo_hookean".into(), parameters: numbers.into(), ..Material::default() });
    let bar = |name: &str, corner: [f64; 3], size: [f64; 3], velocity: f64| Part {
        name: name.into(),
        material: "rubber".into(),
        element: "hex8".into(),
        shape: Shape::Cuboid(Cuboid { corner, size, elements: size.map(|s| across * if s > WIDTH { 10 } else { 1 }), ..Cuboid::default() }),
        velocity: [0.0, 0.0, velocity],
        ..Part::default()
    };
    let half = 0.5 * WIDTH;
    model.parts = vec![
        bar("below", [-5.0 * WIDTH, -half, -WIDTH], [10.0 * WIDTH, WIDTH, WIDTH], 0.0),
        bar("above", [-half, -5.0 * WIDTH, 0.05 * WIDTH], [WIDTH, 10.0 * WIDTH, WIDTH], -speed),
    ];
    touch(&mut model, "below", "above");
    model.probes.push(Probe { name: "above".into(), at: ProbeAt::Set { set: "above".into() }, ..Probe::default() });
    model
}

#[test]
fn bars_that_are_thrown_at_each_other_as_fast_as_their_waves_hold() {
    for across in [1, 2] {
        for share in [0.05, 0.5, 1.0, 1.5] {
            let model = crossed(across, share * WAVE);
            let (simulation_at_end, history) = run(&model);
            let summary = simulation_at_end.summary();
            let place = format!("{across} across at {share}: {summary:?}");
            assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.ledger_residual < 1e-12, "{place}");
            assert!(summary.energy_drift < 0.02, "{place}");
            // Where they cross the one above is still above, however squeezed; their ends fly on and bend
            // them.
            let start = simulation(&model).frame().positions::<3>().to_vec();
            let now = simulation_at_end.frame().positions::<3>().to_vec();
            let mean = |nodes: std::ops::Range<usize>| {
                let is_crossing = |node: &usize| (0..2).all(|d| start[*node][d].abs() < 0.6 * WIDTH);
                let heights: Vec<f64> = nodes.filter(is_crossing).map(|node| now[node][2]).collect();
                heights.iter().sum::<f64>() / heights.len() as f64
            };
            let half = now.len() / 2;
            let apart = mean(half..now.len()) - mean(0..half);
            assert!(apart > 0.2 * WIDTH, "{apart} {place}");
            assert!(history.last("above.vz") > -0.9 * share * WAVE, "{place}");
        }
    }
}

#[test]
fn the_step_is_cut_for_fast_bodies_and_as_it_was_for_slow_ones() {
    let first = |share: f64| {
        let mut model = crossed(1, share * WAVE);
        // Far enough for no step to be fitted to it.
        model.run.end = 1.0;
        simulation(&model).time_step()
    };
    let slow = first(0.01);
    assert_eq!(first(0.05).to_bits(), slow.to_bits());
    // No node goes farther than a sixteenth of the thickness before anything is known of its way.
    for share in [0.3, 0.8] {
        let step = first(share);
        assert!(step < slow && share * WAVE * step <= WIDTH / 16.0 * (1.0 + 1e-12), "{share}: {step} of {slow}");
    }
    assert!(first(100.0) >= 0.124 * slow, "not below an eighth");
}
