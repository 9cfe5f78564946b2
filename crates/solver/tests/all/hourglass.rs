//! Elements with one point: hourglass shapes are held, bending costs what it should, and turns cost nothing.

use crate::blocks::largest;
use crate::patches::*;
use embate_solver::block::BlockInput;

const ELEMENTS: [&str; 3] = ["quad4_reduced", "quad4_reduced_viscous", "quad4_reduced_assumed_strain"];

/// `along` × `through` cells on [0, length] × [−½, ½].
fn beam(along: usize, through: usize, length: f64) -> Patch {
    let row = along + 1;
    let place = |k: usize| [(k % row) as f64 / along as f64 * length, (k / row) as f64 / through as f64 - 0.5];
    let cell = |k: usize| {
        let a = (k / along * row + k % along) as u32;
        [a, a + 1, a + 1 + row as u32, a + row as u32]
    };
    Patch {
        positions: (0..row * (through + 1)).map(place).collect(),
        connectivity: (0..along * through).flat_map(cell).collect(),
        inner: Vec::new(),
    }
}

/// Elastic beam bent to the curvature: the ledger of a body that went there, and its energy by beam theory.
fn bent(element: &str, state: &str, through: usize, curvature: f64) -> (Body, f64) {
    const LENGTH: f64 = 10.0;
    let (material, patch) = (material("elastic", 0.3), beam(through * 5, through, LENGTH));
    let mut body =
        Body::made(&BlockInput { stress_state: state, ..BlockInput::new(element, &material, &patch.connectivity, &patch.positions) });
    body.map(|[x, y]| [x + curvature * x * y, y - 0.5 * curvature * (x * x + 0.3 / 0.7 * y * y)]);
    let modulus = if state == "plane_stress" { YOUNG } else { YOUNG / (1.0 - 0.09) };
    (body, 0.5 * modulus / 12.0 * curvature * curvature * LENGTH)
}

#[test]
fn an_elastic_beam_of_one_element_through_has_the_stiffness_of_beam_theory() {
    for state in ["plane_strain", "plane_stress"] {
        let (body, expected) = bent("quad4_reduced_assumed_strain", state, 1, 1e-6);
        let ratio = body.energy() / expected;
        println!("{state}: {ratio}");
        assert!((ratio - 1.0).abs() < 1e-4, "{state}: {ratio}");
    }
    // The full element locks in shear, and springs of the usual coefficient are soft.
    let ratio = |element: &str| {
        let (body, expected) = bent(element, "plane_strain", 1, 1e-6);
        body.energy() / expected
    };
    let (full, soft) = (ratio("quad4_full"), ratio("quad4_reduced"));
    println!("quad4_full {full}, quad4_reduced {soft}");
    assert!(full > 2.0 && soft < 0.5, "{full} {soft}");
}

#[test]
fn hourglass_control_takes_little_of_the_energy_of_a_bent_beam() {
    for (element, through) in [("quad4_reduced", 4), ("quad4_reduced_assumed_strain", 8)] {
        let (body, expected) = bent(element, "plane_strain", through, 1e-6);
        let (part, ratio) = (body.report.hourglass / body.energy(), body.energy() / expected);
        println!("{element}, {through} elements: {part} of the energy is hourglass, {ratio} of beam theory");
        assert!(body.report.hourglass > 0.0 && part < 0.05, "{element}: {part}");
        assert!((ratio - 1.0).abs() < 0.07, "{element}: {ratio}");
    }
}

#[test]
fn an_hourglass_motion_is_held_and_its_energy_is_booked() {
    for element in ELEMENTS {
        for law in ["elastic", "neo_hookean"] {
            let patch = patch(element, 6, 0.0);
            let mut body = Body::of(element, &material(law, 0.3), &patch);
            let masses = body.masses();
            let time_step = 0.5 * body.report.time_step_squared.sqrt();
            // The node's row and column decide the sign: nothing but the hourglass pattern in every element.
            let mut v: Vec<_> = (0..masses.len()).map(|k| [if (k % 7 + k / 7) % 2 == 0 { 0.01 } else { -0.01 }, 0.0]).collect();
            let kinetic = |v: &[[f64; 2]]| v.iter().zip(&masses).map(|(v, m)| 0.5 * m * (v[0] * v[0] + v[1] * v[1])).sum::<f64>();
            let begin = kinetic(&v);
            let (mut moved, mut drift) = (0.0f64, 0.0f64);
            for _ in 0..2000 {
                body.advance(&v, time_step);
                let before = v.clone();
                for ((v, f), m) in v.iter_mut().zip(body.forces()).zip(&masses) {
                    *v = [v[0] + f[0] / m * time_step, v[1] + f[1] / m * time_step];
                }
                let middle: Vec<_> = v.iter().zip(&before).map(|(a, b)| [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]).collect();
                drift = drift.max(((kinetic(&middle) + body.energy()) / begin - 1.0).abs());
                moved = body.positions.iter().zip(&patch.positions).fold(moved, |m, (x, y)| m.max((x[0] - y[0]).abs()));
            }
            let free = 0.01 * 2000.0 * time_step;
            println!("{element} {law}: moved {moved:.2e} of {free:.2e}, drift {drift:.2e}, hourglass {}", body.report.hourglass / begin);
            assert!(moved < 0.02 * free, "{element} {law}: {moved} of {free}");
            assert!(drift < 0.05, "{element} {law}: {drift}");
            if is_damped(element) {
                assert!(kinetic(&v) < 1e-3 * begin && (body.report.hourglass / begin - 1.0).abs() < 0.05, "{element} {law}");
            }
        }
    }
}

#[test]
fn a_larger_coefficient_holds_the_shape_harder() {
    let (material, patch) = (material("elastic", 0.3), patch("quad4", 1, 0.0));
    let energy = |coefficient: Option<f64>| {
        let mut input = BlockInput::new("quad4_reduced", &material, &patch.connectivity, &patch.positions);
        input.options.hourglass = coefficient;
        let mut body = Body::made(&input);
        body.map(|[x, y]| [x + 1e-6 * (x - 0.5) * (y - 0.5), y]);
        body.energy()
    };
    assert!(energy(Some(0.0)).abs() < 1e-20);
    assert!((energy(Some(0.1)) / energy(None) - 2.0).abs() < 1e-6, "the coefficient is 0.05 unless another is chosen");
}

#[test]
fn a_thousand_turns_leave_no_stress_and_no_force() {
    const TURNS: u32 = 1000;
    const STEPS: u32 = 20;
    every_pair(|element, law| {
        let patch = patch(element, 2, 0.2);
        let mut body = Body::of(element, &material(law, 0.3), &patch);
        for step in 1..=TURNS * STEPS {
            let (s, c) = (std::f64::consts::TAU * f64::from(step % STEPS) / f64::from(STEPS)).sin_cos();
            body.move_to(&patch.positions.iter().map(|[x, y]| [c * x - s * y, s * x + c * y]).collect::<Vec<_>>());
        }
        let stress = (0..body.block.elements()).flat_map(|k| body.block.state(k).stress).fold(0.0f64, |m, s| m.max(s.abs()));
        let force = body.forces().into_iter().flatten().fold(0.0f64, |m, f| m.max(f.abs()));
        println!("{element} {law}: stress {:.1e}, force {:.1e} of Young's modulus", stress / YOUNG, force / YOUNG);
        assert!(stress < 1e-11 * YOUNG && force < 1e-11 * YOUNG, "{element} {law}: {stress} {force}");
    });
}

#[test]
fn assumed_strain_gives_back_what_it_took_however_an_element_is_folded() {
    let mut numbers = Spread::new(31);
    for law in ["neo_hookean", "ogden"] {
        for _ in 0..20 {
            let start: Vec<_> = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
                .into_iter()
                .map(|x: [f64; 2]| {
                    let [dx, dy] = numbers.vector(0.1);
                    [x[0] + dx, x[1] + dy]
                })
                .collect();
            let mut body = Body::single("quad4_reduced_assumed_strain", &material(law, 0.3), &start);
            assert!(body.energy().abs() < 1e-20 * YOUNG, "nothing is stored at the start");
            // Far enough to fold corners over; the centre stays the right way round.
            let mut x = start.clone();
            for (x, way) in x.iter_mut().zip([0.6, 0.0, 0.1, -0.05]) {
                let chance = numbers.vector(0.05);
                *x = [x[0] + way + chance[0], x[1] + way + chance[1]];
            }
            let at = |body: &mut Body, x: &[[f64; 2]]| {
                body.move_to(x);
                body.energy()
            };
            let energy = at(&mut body, &x);
            let forces = body.forces();
            let (held, size) = (body.report.hourglass, largest(forces.iter().flatten()));
            assert!(held > 0.0, "{law}: {held}");
            // Forces are the slope of all energy: that of the rubber and that of the control.
            for a in 0..4 {
                for d in 0..2 {
                    let mut moved = |by: f64| {
                        let mut x = x.clone();
                        x[a][d] += by;
                        at(&mut body, &x)
                    };
                    let slope = (moved(1e-6) - moved(-1e-6)) / 2e-6;
                    assert!((forces[a][d] + slope).abs() < 1e-6 * size, "{law} node {a} {d}: {} {slope}", forces[a][d]);
                }
            }
            let moment: f64 = x.iter().zip(&forces).map(|(x, f)| x[0] * f[1] - x[1] * f[0]).sum();
            assert!(moment.abs() < 1e-12 * size, "{law}: moment {moment}");
            // By another way to the same place, and back.
            for turn in [0.3, 1.1, -0.7] {
                let (s, c) = f64::sin_cos(turn);
                body.map(|[x, y]| [c * x - s * y, s * x + c * y]);
                let turned = body.report.hourglass;
                if turn == 0.3 {
                    let same = at(&mut body, &x);
                    assert!((same - energy).abs() < 1e-12 * energy && (turned - body.report.hourglass).abs() < 1e-5 * held, "{law}");
                }
            }
            assert!(at(&mut body, &start).abs() < 1e-12 * energy, "{law}: {}", body.energy());
        }
    }
}
