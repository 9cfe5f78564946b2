//! Johnson and Cook's law against points of its curve, adiabatic softening, melting, and damage.

use crate::patches::{DENSITY, YOUNG};
use crate::point::Point;
use embate_solver::material::JohnsonCook;

const SHEAR: f64 = YOUNG / 2.6;
const BASE: [(&str, f64); 10] = [
    ("young", YOUNG),
    ("poisson", 0.3),
    ("yield", 2.0),
    ("strength", 3.0),
    ("hardening_exponent", 0.3),
    ("rate_coefficient", 0.03),
    ("softening_exponent", 1.1),
    ("temperature_reference", 300.0),
    ("temperature_melt", 1300.0),
    ("specific_heat", 1.0),
];

fn point(own: &[(&str, f64)], damage: &[f64]) -> Point<JohnsonCook> {
    let base = BASE.iter().filter(|(name, _)| own.iter().all(|(other, _)| other != name));
    Point::new(&base.chain(own).copied().collect::<Vec<_>>(), &[("damage", damage)])
}

#[test]
fn the_flow_stress_has_the_points_of_the_curve() {
    for temperature in [200.0f64, 300.0, 700.0, 1200.0] {
        for time_step in [1e-7, 1e-3, 10.0] {
            // No heating, so that the temperature stays what it is.
            let mut body = Point { time_step, ..point(&[("temperature", temperature), ("taylor_quinney", 1e-12)], &[]) };
            let soft = 1.0 - ((temperature - 300.0) / 1000.0).max(0.0).powf(1.1);
            for step in 0..300 {
                let (old, before) = (body.state[0], body.mises());
                body.strain([0.0, 0.0, 0.0, 1e-3, 0.0, 0.0]);
                let increment = body.state[0] - old;
                assert!((before + 3f64.sqrt() * SHEAR * 2e-3 - 3.0 * SHEAR * increment - body.mises()).abs() < 1e-10);
                let rate = (increment / time_step).max(1.0);
                let power = (3.0 * (old + increment).powf(0.3)).min(3000.0 * SHEAR * (old + increment));
                let expected = (2.0 + power) * (1.0 + 0.03 * rate.ln()) * soft;
                if increment > 0.0 {
                    assert!(
                        (body.mises() / expected - 1.0).abs() < 1e-9,
                        "{temperature} {time_step} {step}: {} for {expected}",
                        body.mises()
                    );
                } else {
                    assert!(step < 20 && body.mises() <= expected * (1.0 + 1e-12));
                }
            }
        }
    }
}

#[test]
fn the_flow_stress_is_met_to_the_tolerance_after_steps_of_any_size_and_rate() {
    let (mut seed, mut flowed) = (3u64, 0);
    let virgin = point(&[("temperature", 500.0), ("taylor_quinney", 1e-12)], &[]);
    let (mut body, soft) = (virgin, 1.0 - 0.2f64.powf(1.1));
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1u64 << 53) as f64
    };
    for round in 0..40_000 {
        if round % 400 == 0 {
            body = virgin;
        }
        // From far below the reference rate of one per second to far above it.
        body.time_step = 10f64.powf(-8.0 + 9.0 * random());
        let size = 10f64.powf(-7.0 + 5.5 * random()) * if random() < 0.3 { -1.0 } else { 1.0 };
        let (old, before) = (body.state[0], 3f64.sqrt() * body.stress[3]);
        body.strain([0.0, 0.0, 0.0, size, 0.0, 0.0]);
        let (p, q) = (body.state[0], 3f64.sqrt() * body.stress[3].abs());
        let trial = (before + 2.0 * 3f64.sqrt() * SHEAR * size).abs();
        if p > old {
            flowed += 1;
            let power = (3.0 * p.powf(0.3)).min(3000.0 * SHEAR * p);
            let expected = (2.0 + power) * (1.0 + 0.03 * ((p - old) / body.time_step).max(1.0).ln()) * soft;
            // The difference has lost digits.
            let lost = 0.03 * expected * f64::EPSILON * p / (p - old);
            assert!((q - expected).abs() < 2e-12 * trial + lost, "{round}: {q} for {expected} at {p}, step {size} in {}", body.time_step);
            // What is kept of the curve is right to the tolerance of a stress.
            assert!((body.state[3] - power).abs() < 4e-12 * trial && body.dissipated >= 0.0, "{round}: {} for {power}", body.state[3]);
        }
    }
    assert!(flowed > 5_000, "{flowed}");
}

#[test]
fn plastic_work_heats_and_heat_softens_by_the_exponential() {
    // A alone and m = 1: σ = A exp(−χ A ε_p / (ρ c (T_m − T_r)))
    let error = |steps: u32| {
        let mut bar = point(
            &[("strength", 0.0), ("rate_coefficient", 0.0), ("softening_exponent", 1.0), ("temperature", 300.0), ("specific_heat", 0.001)],
            &[],
        );
        bar.pull(1.9999e-3); // to the yield stress
        bar.pull_by(2.0, steps);
        let [p, temperature, ..] = bar.state;
        let heated = 300.0 + 0.9 * bar.dissipated / (DENSITY * 0.001);
        assert!((temperature / heated - 1.0).abs() < 1e-12);
        let expected = 2.0 * (-0.9 * 2.0 * p / (DENSITY * 0.001 * 1000.0)).exp();
        assert!((bar.work - bar.dissipated - bar.elastic_energy()).abs() < 1e-11 * bar.dissipated);
        (bar.stress[0] / expected - 1.0).abs()
    };
    let errors = [200, 400, 800].map(error);
    println!("{errors:?}");
    assert!(errors[2] < 3e-3, "{errors:?}");
    assert!(errors.windows(2).all(|pair| (pair[0] / pair[1] - 2.0).abs() < 0.3), "{errors:?}");
}

#[test]
fn molten_metal_bears_pressure_and_no_shear() {
    for temperature in [1300.0, 2000.0] {
        let mut body = point(&[("temperature", temperature)], &[]);
        for _ in 0..10 {
            body.strain([-1e-3, 2e-4, 0.0, 5e-3, 0.0, 1e-3]);
            assert!(body.mises() < 1e-10, "{}", body.mises());
        }
        let bulk = YOUNG / 1.2;
        assert!((body.mean() / (-8e-3 * bulk) - 1.0).abs() < 1e-12);
    }
}

#[test]
fn damage_is_plastic_strain_over_failure_strain() {
    // Tension: σ* = 1/3 while it flows; shear: σ* = 0.
    let constants = [0.05, 3.0, -2.0, 0.02, 0.5];
    let warm = [("taylor_quinney", 1e-12), ("temperature", 800.0), ("strength", 0.0), ("rate_coefficient", 0.0)];
    let mut bar = point(&warm, &constants);
    bar.pull_by(0.1, 1000);
    let factors = (1.0 + 0.02 * f64::ln(1.0)) * (1.0 + 0.5 * 0.5);
    // At a rate of 0.1 per second there is no growth with the rate.
    let failure = (0.05 + 3.0 * f64::exp(-2.0 / 3.0)) * factors;
    assert!((bar.state[2] * failure / bar.state[0] - 1.0).abs() < 1e-9, "{} {}", bar.state[2] * failure, bar.state[0]);
    // In fast shear the rate has its factor, and damage ends at one.
    let mut body = Point { time_step: 1e-5, ..point(&warm, &constants) };
    for _ in 0..100 {
        body.strain([0.0, 0.0, 0.0, 0.01, 0.0, 0.0]);
    }
    let (p, damage) = (body.state[0], body.state[2]);
    body.strain([0.0, 0.0, 0.0, 0.01, 0.0, 0.0]);
    let step = body.state[0] - p;
    let failure = 3.05 * (1.0 + 0.02 * (step / 1e-5).ln()) * 1.25;
    assert!(((body.state[2] - damage) * failure / step - 1.0).abs() < 1e-9);
    for _ in 0..1000 {
        body.strain([0.0, 0.0, 0.0, 0.01, 0.0, 0.0]);
    }
    assert_eq!(body.state[2], 1.0);
}
