//! Kinematic and mixed hardening against closed forms: Bauschinger, saturation, the stabilised loop,
//! ratcheting, energy, rotation.

use crate::patches::{Spread, YOUNG};
use crate::point::Point;
use embate_solver::material::Chaboche;
use embate_solver::tensor::{Solid, SymmetricTensor};

const YIELD: f64 = 2.0;

fn point(isotropic: f64, moduli: &[f64], recalls: &[f64]) -> Point<Chaboche> {
    let numbers = [("young", YOUNG), ("poisson", 0.3), ("yield", YIELD), ("isotropic_stress", isotropic), ("isotropic_rate", 8.0)];
    Point::new(&numbers, &[("backstress_modulus", moduli), ("backstress_recall", recalls)])
}

#[test]
fn linear_kinematic_hardening_shifts_the_elastic_range_and_keeps_its_width() {
    let modulus = 40.0;
    for steps in [1, 5, 100] {
        let mut bar = point(0.0, &[modulus], &[]);
        // ε = σ/E + ε_p, σ = σ_y + C ε_p
        bar.pull_by(0.05, steps);
        let plastic = (0.05 - YIELD / YOUNG) / (1.0 + modulus / YOUNG);
        let top = YIELD + modulus * plastic;
        assert!((bar.stress[0] / top - 1.0).abs() < 1e-11, "{} for {top}", bar.stress[0]);
        // Back by twice the yield stress is elastic (Bauschinger), and the other branch begins there.
        let elastic = 2.0 * YIELD / YOUNG;
        let dissipated = bar.dissipated;
        bar.pull(-0.999 * elastic);
        assert_eq!(bar.dissipated, dissipated);
        bar.pull(-0.001 * elastic);
        bar.pull_by(-0.02, steps);
        let bottom = top - 2.0 * YIELD - modulus * 0.02 / (1.0 + modulus / YOUNG);
        assert!((bar.stress[0] / bottom - 1.0).abs() < 1e-10, "{} for {bottom}", bar.stress[0]);
    }
}

#[test]
fn backstresses_that_fade_saturate_and_converge_to_the_exponential() {
    let (moduli, recalls) = ([300.0, 60.0, 5.0], [150.0, 20.0, 0.0]);
    let error = |steps: u32| {
        let mut bar = point(1.5, &moduli, &recalls);
        bar.pull_by(0.1, steps);
        let p = bar.state.0[0];
        let back = |k: usize| if recalls[k] > 0.0 { moduli[k] / recalls[k] * (1.0 - (-recalls[k] * p).exp()) } else { moduli[k] * p };
        let expected = YIELD + 1.5 * (1.0 - (-8.0 * p).exp()) + (0..3).map(back).sum::<f64>();
        (bar.stress[0] / expected - 1.0).abs()
    };
    let errors = [100, 200, 400].map(error);
    println!("{errors:?}");
    assert!(errors[2] < 5e-4, "{errors:?}");
    assert!(errors.windows(2).all(|pair| (pair[0] / pair[1] - 2.0).abs() < 0.3), "the error falls with the step: {errors:?}");
}

#[test]
fn the_stabilised_loop_has_the_stress_of_the_closed_form() {
    // σ_a = σ_y + (C/γ) tanh(γ ε_pa) for one backstress
    let (modulus, recall, plastic) = (200.0, 100.0, 0.008);
    let amplitude = YIELD + modulus / recall * f64::tanh(recall * plastic);
    let strain = plastic + amplitude / YOUNG;
    let mut bar = point(0.0, &[modulus], &[recall]);
    bar.pull_by(strain, 200);
    for _ in 0..6 {
        bar.pull_by(-2.0 * strain, 400);
        let bottom = bar.stress[0];
        bar.pull_by(2.0 * strain, 400);
        println!("{} {bottom} for {amplitude}", bar.stress[0]);
    }
    assert!((bar.stress[0] / amplitude - 1.0).abs() < 1e-3, "{} for {amplitude}", bar.stress[0]);
}

#[test]
fn a_bar_between_unequal_stresses_ratchets_by_the_closed_form() {
    // Plastic strain per cycle (1/γ) ln[((C/γ)² − (σ_min + σ_y)²) / ((C/γ)² − (σ_max − σ_y)²)], Lemaitre and
    // Chaboche, section 5.4.4.
    let (modulus, recall): (f64, f64) = (200.0, 100.0);
    let (high, low) = (3.0, -2.5);
    let limit = modulus / recall;
    let expected = ((limit * limit - (low + YIELD).powi(2)) / (limit * limit - (high - YIELD).powi(2))).ln() / recall;
    let mut bar = point(0.0, &[modulus], &[recall]);
    let mut tops = Vec::new();
    for _ in 0..4 {
        bar.pull_to(high, 2e-5);
        tops.push(bar.strain[0]);
        bar.pull_to(low, -2e-5);
    }
    let found = tops[3] - tops[2];
    println!("{found} for {expected}");
    assert!((found / expected - 1.0).abs() < 0.01, "{found} for {expected}");
}

#[test]
fn the_flow_rule_holds_and_no_energy_is_lost_in_any_direction() {
    let (moduli, recalls) = ([300.0, 60.0, 5.0], [150.0, 20.0, 0.0]);
    let mut body = point(1.5, &moduli, &recalls);
    let mut numbers = Spread::new(31);
    let mut flowed = 0;
    for step in 0..2000 {
        let size = [1e-4, 1e-3, 1e-2, 1e-1][step % 4];
        let plastic = body.state.0[0];
        body.strain(std::array::from_fn(|_| numbers.between(-size, size)));
        let [p, ..] = body.state.0;
        let mut shifted = Solid(body.stress).deviator();
        for alpha in body.state.1.0 {
            shifted = shifted.plus(alpha.times(-1.0));
            assert!(alpha.trace().abs() < 1e-11);
        }
        let q = (1.5 * shifted.contract(shifted)).sqrt();
        let flow = YIELD + 1.5 * (1.0 - (-8.0 * p).exp());
        if p > plastic {
            flowed += 1;
            assert!((q / flow - 1.0).abs() < 1e-10 * (1.0 + size * YOUNG), "{step}: {q} for {flow}");
        } else {
            assert!(q <= flow * (1.0 + 1e-10));
        }
    }
    assert!(flowed > 1000);
    // Work is found in dissipation, elastic energy and backstresses; one step with a large rotation may show
    // zero instead of less.
    let mut stored = body.elastic_energy();
    for (alpha, modulus) in body.state.1.0.into_iter().zip(moduli) {
        stored += 0.75 * alpha.contract(alpha) / modulus;
    }
    let error = (body.work - body.dissipated - stored).abs() / body.dissipated;
    println!("{error}");
    assert!(error < 1e-11, "{error}");
}

#[test]
fn backstresses_turn_with_the_body() {
    let make = || point(1.5, &[300.0, 60.0, 5.0], &[150.0, 20.0, 0.0]);
    let (s, c) = 0.7f64.sin_cos();
    let q = [[c, -s, 0.0], [0.6 * s, 0.6 * c, -0.8], [0.8 * s, 0.8 * c, 0.6]];
    let (mut still, mut turned) = (make(), make());
    let mut numbers = Spread::new(32);
    let mut increments = || -> [f64; 6] { std::array::from_fn(|_| numbers.between(-0.01, 0.01)) };
    for _ in 0..10 {
        let strain = increments();
        still.strain(strain);
        turned.strain(strain);
    }
    turned.turn_and_strain(&q, [0.0; 6]);
    for _ in 0..10 {
        let strain = increments();
        still.strain(strain);
        turned.strain(Solid(strain).rotated(&q).0);
    }
    let expected = Solid(still.stress).rotated(&q).0;
    assert!((0..6).all(|k| (turned.stress[k] - expected[k]).abs() < 1e-10), "{:?} for {expected:?}", turned.stress);
}
