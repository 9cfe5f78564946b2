//! Hardening and rate dependence of the J2 laws against their closed forms: tension, cycles, shear, energy.

use crate::patches::YOUNG;
use crate::point::Point;
use embate_solver::material::{J2, J2Ludwik, J2Swift, J2Table, J2Voce, LAWS, Law, Parameters, faults};

const POISSON: f64 = 0.3;
const SHEAR: f64 = YOUNG / (2.0 * (1.0 + POISSON));

/// Something to do with every J2 law: its flow stress, and a virgin point.
trait Check {
    fn check<M: Law>(&mut self, curve: &dyn Fn(f64) -> f64, point: Point<M>, plastic: &dyn Fn(&Point<M>) -> f64);
}

fn point<M: Law>(numbers: &[(&str, f64)], lists: &[(&str, &[f64])], rate: f64) -> Point<M> {
    let base = [("young", YOUNG), ("poisson", POISSON), ("rate_reference", rate), ("rate_exponent", 4.0)];
    Point::new(&base.iter().chain(numbers).copied().collect::<Vec<_>>(), lists)
}

fn with_every_hardening(rate: f64, check: &mut impl Check) {
    let table: [(&str, &[f64]); 2] = [("plastic_strain", &[0.0, 0.01, 0.05, 0.2]), ("stress", &[2.0, 3.0, 4.0, 4.5])];
    check.check(&|p| 2.0 + 30.0 * p, point::<J2>(&[("yield", 2.0), ("hardening", 30.0)], &[], rate), &|at| at.state.0[0]);
    let voce = [("yield", 2.0), ("saturation", 5.0), ("saturation_rate", 25.0), ("hardening", 3.0)];
    check.check(&|p| 2.0 + 3.0 * (1.0 - (-25.0 * p).exp()) + 3.0 * p, point::<J2Voce>(&voce, &[], rate), &|at| at.state.0[0]);
    let swift = [("strength", 8.0), ("strain_offset", 0.002), ("hardening_exponent", 0.25)];
    check.check(&|p| 8.0 * (0.002 + p).powf(0.25), point::<J2Swift>(&swift, &[], rate), &|at| at.state.0[0]);
    let ludwik = [("yield", 2.0), ("strength", 5.0), ("hardening_exponent", 0.4)];
    check.check(&|p| 2.0 + (5.0 * p.powf(0.4)).min(3000.0 * SHEAR * p), point::<J2Ludwik>(&ludwik, &[], rate), &|at| at.state.0[0]);
    let curve = |p: f64| match p {
        p if p < 0.01 => 2.0 + 100.0 * p,
        p if p < 0.05 => 3.0 + 25.0 * (p - 0.01),
        p if p < 0.2 => 4.0 + 0.5 / 0.15 * (p - 0.05),
        _ => 4.5,
    };
    check.check(&curve, point::<J2Table>(&[], &table, rate), &|at| at.state.0[0]);
}

struct Tension;
impl Check for Tension {
    fn check<M: Law>(&mut self, curve: &dyn Fn(f64) -> f64, point: Point<M>, plastic: &dyn Fn(&Point<M>) -> f64) {
        for steps in [1, 7, 300] {
            let mut point = point;
            let mut strain = 0.0;
            // Pulled, pushed twice as far, pulled again: the flow stress follows the length of the path.
            for (target, way) in [(0.1, 1.0), (-0.1, -1.0), (0.3, 1.0)] {
                let change = (target - strain) / f64::from(steps);
                for _ in 0..steps {
                    point.pull(change);
                    strain += change;
                }
                let p = plastic(&point);
                let (stress, expected) = (point.stress[0], way * curve(p));
                assert!((stress / expected - 1.0).abs() < 1e-10, "{} in {steps}: {stress} for {expected}", M::KIND.name);
            }
            let (p, stress) = (plastic(&point), point.stress[0]);
            // Path of the plastic strain: ε_p there, back and there again.
            let elastic = |p: f64| curve(p) / YOUNG;
            let mut path = 0.0;
            let mut at = 0.0;
            for (target, way) in [(0.1, 1.0), (-0.1, -1.0), (0.3, 1.0)] {
                // target = way σ_y(path + x) / E + at + way x
                let (mut low, mut high) = (0.0, 1.0);
                for _ in 0..100 {
                    let x = 0.5 * (low + high);
                    if at + way * (x + elastic(path + x)) < target {
                        if way > 0.0 { low = x } else { high = x }
                    } else if way > 0.0 {
                        high = x
                    } else {
                        low = x
                    }
                }
                (path, at) = (path + low, at + way * low);
            }
            assert!((p / path - 1.0).abs() < 1e-9, "{} in {steps}: {p} for {path}", M::KIND.name);
            assert!((stress / curve(path) - 1.0).abs() < 1e-9);
        }
    }
}

#[test]
fn every_hardening_follows_its_curve_in_tension_and_in_cycles() {
    with_every_hardening(0.0, &mut Tension);
}

/// Largest error over the dissipation with linear hardening in one step, and with the others.
struct Energy(f64, f64);
impl Check for Energy {
    fn check<M: Law>(&mut self, _: &dyn Fn(f64) -> f64, point: Point<M>, _: &dyn Fn(&Point<M>) -> f64) {
        for steps in [1, 3, 50] {
            let mut point = point;
            for target in [0.1, -0.2, 0.2] {
                point.pull_by(target, steps);
                let (x, stored) = (point.stress[0], point.work - point.dissipated);
                let expected = x * x / (2.0 * YOUNG);
                let error = (stored - expected).abs() / point.dissipated;
                let limit = if M::KIND.name == "j2" { self.0 / f64::from(steps) } else { self.1 };
                assert!(error < limit, "{} in {steps}: {stored} for {expected}, dissipated {}", M::KIND.name, point.dissipated);
            }
        }
    }
}

#[test]
fn work_less_dissipation_is_the_elastic_energy_for_any_step() {
    // Linear hardening integrates the flow stress: exact but for the step in which flow begins or turns.
    with_every_hardening(0.0, &mut Energy(1.0, 1e-11));
}

/// Shear back and forth in steps of any size: the flow stress at the end of each is met to twice the
/// tolerance of the return.
struct Return;
impl Check for Return {
    fn check<M: Law>(&mut self, curve: &dyn Fn(f64) -> f64, mut point: Point<M>, plastic: &dyn Fn(&Point<M>) -> f64) {
        let (mut seed, mut flowed, virgin) = (7u64, 0, point);
        for round in 0..40_000 {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let random = (seed >> 11) as f64 / (1u64 << 53) as f64;
            // From the chord and the bend of the curve on again and again.
            if round % 400 == 0 {
                point = virgin;
            }
            let size = 10f64.powf(-9.0 + 8.0 * random) * if seed >> 60 < 5 { -1.0 } else { 1.0 };
            let (old, before) = (plastic(&point), 3f64.sqrt() * point.stress[3]);
            point.strain([0.0, 0.0, 0.0, size, 0.0, 0.0]);
            let (p, q) = (plastic(&point), 3f64.sqrt() * point.stress[3].abs());
            let trial = (before + 2.0 * 3f64.sqrt() * SHEAR * size).abs();
            if p > old {
                flowed += 1;
                assert!((q - curve(p)).abs() < 2e-12 * trial, "{} {round}: {q} for {} at {p}, step {size}", M::KIND.name, curve(p));
            } else {
                assert!(q <= curve(p) * (1.0 + 2e-12), "{}", M::KIND.name);
            }
        }
        assert!(flowed > 5_000, "{}: {flowed}", M::KIND.name);
    }
}

#[test]
fn the_flow_stress_is_met_to_the_tolerance_after_steps_of_any_size() {
    with_every_hardening(0.0, &mut Return);
}

/// Steady shear: q = √3 τ = σ_y R(rate) once the flow is steady, and at every step the equation of the
/// return.
struct Rates;
impl Check for Rates {
    fn check<M: Law>(&mut self, curve: &dyn Fn(f64) -> f64, point: Point<M>, plastic: &dyn Fn(&Point<M>) -> f64) {
        for (time_step, size) in [(1e-7, 1e-6), (1e-3, 1e-3), (1.0, 1e-2), (1e-3, 0.2)] {
            let mut point = Point { time_step, ..point };
            let mut flowed = 0;
            for _ in 0..400 {
                let (old, before) = (plastic(&point), 3f64.sqrt() * point.stress[3]);
                point.strain([0.0, 0.0, 0.0, 0.5 * size, 0.0, 0.0]);
                let step = plastic(&point) - old;
                let q = 3f64.sqrt() * point.stress[3];
                let trial = before + 3f64.sqrt() * SHEAR * size;
                assert!((trial - 3.0 * SHEAR * step - q).abs() < 1e-11 * YOUNG * size.max(1e-3), "{}", M::KIND.name);
                if step > 0.0 {
                    flowed += 1;
                    let expected = curve(old + step) * (1.0 + (step / (RATE * time_step)).powf(0.25));
                    // The increment of the plastic strain is a difference of rounded numbers.
                    let blur = 1e-9 + 1e-15 * old / step;
                    assert!((q / expected - 1.0).abs() < blur, "{} {time_step} {size}: {q} for {expected} at {step}", M::KIND.name);
                }
            }
            assert!(flowed > 200 || size < 1e-5, "{} {flowed}", M::KIND.name);
        }
    }
}
const RATE: f64 = 50.0;

#[test]
fn the_rate_raises_the_flow_stress_after_cowper_and_symonds() {
    with_every_hardening(RATE, &mut Rates);
}

#[test]
fn a_fast_bar_is_stronger_by_the_factor_of_its_rate() {
    // Perfectly plastic tension at a constant rate: σ = σ_y (1 + (rate / C)^{1/P}).
    let mut bar = point::<J2>(&[("yield", 2.0)], &[], RATE);
    bar.time_step = 1e-5;
    for _ in 0..3000 {
        bar.pull(2e-5);
    }
    let expected = 2.0 * (1.0 + (2.0 / RATE).powf(0.25));
    assert!((bar.stress[0] / expected - 1.0).abs() < 1e-9, "{} for {expected}", bar.stress[0]);
}

#[test]
fn work_less_dissipation_is_the_elastic_energy_with_rates_too() {
    // Where the load turns within a step and the rate falls, the mean stress may oppose the flow; a
    // dissipation of zero is reported then.
    struct Slow;
    impl Check for Slow {
        fn check<M: Law>(&mut self, curve: &dyn Fn(f64) -> f64, point: Point<M>, plastic: &dyn Fn(&Point<M>) -> f64) {
            Energy(5e-3, 5e-3).check(curve, Point { time_step: 1e-2, ..point }, plastic);
        }
    }
    with_every_hardening(RATE, &mut Slow);
}

#[test]
fn parameters_that_contradict_each_other_are_reported_with_a_cure() {
    let reported = |law: &str, numbers: &[(&str, f64)], lists: &[(&str, &[f64])]| {
        let kind = LAWS.iter().find(|kind| kind.name == law).unwrap();
        let numbers = numbers.iter().map(|&(name, value)| (name.to_string(), value)).collect();
        let lists = lists.iter().map(|&(name, list)| (name.to_string(), list.to_vec())).collect();
        let found = faults(law, &Parameters::new(kind.parameters, &numbers, &lists));
        assert!(found.iter().all(|fault| !fault.help.is_empty() && kind.parameters.iter().any(|parameter| parameter.name == fault.name)));
        found.iter().map(|fault| fault.message.clone()).collect::<Vec<_>>().join("; ")
    };
    let curve = |strains: &[f64], stresses: &[f64]| reported("j2_table", &[], &[("plastic_strain", strains), ("stress", stresses)]);
    assert_eq!(curve(&[0.0, 0.1], &[2.0, 3.0]), "");
    assert!(curve(&[0.0, 0.1], &[2.0]).contains("1 stresses for 2"));
    assert!(curve(&[0.1, 0.2], &[2.0, 3.0]).contains("starts at 0.1"));
    assert!(curve(&[0.0, 0.2, 0.2], &[2.0, 3.0, 4.0]).contains("0.2 comes after 0.2"));
    assert!(reported("j2", &[("rate_exponent", 0.2)], &[]).contains("at least 1"));
    assert!(reported("chaboche", &[], &[("backstress_modulus", &[1.0]), ("backstress_recall", &[1.0, 2.0])]).contains("2 recalls for 1"));
    assert!(reported("johnson_cook", &[("temperature_melt", 200.0)], &[("damage", &[1.0])]).contains("melting point"));
    assert!(reported("johnson_cook", &[("temperature_melt", 1800.0)], &[("damage", &[1.0])]).contains("five constants"));
    assert!(reported("drucker_prager", &[("friction_angle", 30.0)], &[]).contains("1718.9 deg"));
    assert!(reported("drucker_prager", &[("friction_angle", 0.3), ("dilation_angle", 0.5)], &[]).contains("make energy"));
}
