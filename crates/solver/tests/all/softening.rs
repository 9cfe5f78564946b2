//! Flow stress that falls: closed forms, the return with every curve up to the steepest that is accepted,
//! what is refused, and what the user is reported.

use crate::bodies::*;
use crate::patches::{Spread, YOUNG};
use crate::point::Point;
use embate_lanes::Level;
use embate_solver::material::{Chaboche, CrushableFoam, J2, J2Table, J2Voce, LAWS, Law, Parameters, faults as faults_of, softening};
use embate_solver::model::{Constraint, Material, Model, Rectangle, Shape};
use embate_solver::output::Summary;
use embate_solver::simulation::{Options, Simulation};

const POISSON: f64 = 0.3;
const SHEAR: f64 = YOUNG / (2.0 * (1.0 + POISSON));
const BASE: [(&str, f64); 2] = [("young", YOUNG), ("poisson", POISSON)];

fn point<M: Law>(numbers: &[(&str, f64)], lists: &[(&str, &[f64])]) -> Point<M> {
    Point::new(&BASE.iter().chain(numbers).copied().collect::<Vec<_>>(), lists)
}

/// Something to do with every falling J2 law: its flow stress, and a virgin point.
trait Check {
    fn check<M: Law>(&mut self, curve: &dyn Fn(f64) -> f64, point: Point<M>, plastic: &dyn Fn(&Point<M>) -> f64);
}

fn with_every_falling_curve(check: &mut impl Check) {
    for slope in [-30.0, -400.0, -0.89 * YOUNG] {
        let law = [("yield", 2.0), ("hardening", slope)];
        check.check(&|p| (2.0 + slope * p).max(0.0), point::<J2>(&law, &[]), &|at| at.state.0[0]);
    }
    let voce =
        |saturation: f64, hardening: f64| [("yield", 2.0), ("saturation", saturation), ("saturation_rate", 25.0), ("hardening", hardening)];
    let curve =
        |saturation: f64, hardening: f64| move |p: f64| (2.0 + (saturation - 2.0) * (1.0 - (-25.0 * p).exp()) + hardening * p).max(0.0);
    for (saturation, hardening) in [(0.5, 0.0), (0.5, 3.0), (5.0, -20.0), (1.5, -100.0)] {
        check.check(&curve(saturation, hardening), point::<J2Voce>(&voce(saturation, hardening), &[]), &|at| at.state.0[0]);
    }
    let (strains, stresses) = ([0.0, 0.01, 0.012, 0.05, 0.2], [2.0, 3.0, 1.5, 2.0, 0.01]);
    let table = move |p: f64| {
        let i = (1..strains.len()).rev().find(|&i| p >= strains[i]).unwrap_or(0);
        if i + 1 == strains.len() {
            return stresses[i];
        }
        stresses[i] + (stresses[i + 1] - stresses[i]) / (strains[i + 1] - strains[i]) * (p - strains[i])
    };
    check.check(&table, point::<J2Table>(&[], &[("plastic_strain", &strains), ("stress", &stresses)]), &|at| at.state.0[0]);
}

#[test]
fn every_falling_curve_is_followed_in_tension_whatever_the_steps() {
    struct Tension;
    impl Check for Tension {
        fn check<M: Law>(&mut self, curve: &dyn Fn(f64) -> f64, point: Point<M>, plastic: &dyn Fn(&Point<M>) -> f64) {
            for steps in [1, 7, 300] {
                let mut point = point;
                for (target, way) in [(0.02, 1.0), (-0.03, -1.0), (0.3, 1.0)] {
                    point.pull_by(target, steps);
                    let (p, stress) = (plastic(&point), point.stress[0]);
                    assert!((stress - way * curve(p)).abs() < 1e-10, "{} in {steps}: {stress} for {} at {p}", M::KIND.name, way * curve(p));
                }
                // Strain is elastic and plastic: 0.29 in all, of which plastic back and forth.
                let elastic = point.stress[0] / YOUNG;
                assert!((point.strain[0] - 0.29).abs() < 1e-12 && plastic(&point) > 0.29 - elastic, "{}", M::KIND.name);
                // A step that turns round from more stress to less is reported without dissipation, as in
                // heat.
                let stored = point.work - point.dissipated;
                let error = (stored - point.stress[0].powi(2) / (2.0 * YOUNG)).abs();
                assert!(steps < 300 || error < 1e-11 * point.dissipated, "{}: {error} of {}", M::KIND.name, point.dissipated);
            }
        }
    }
    with_every_falling_curve(&mut Tension);
}

#[test]
fn what_a_falling_line_dissipates_is_the_area_under_it() {
    for slope in [-30.0, -400.0, -0.89 * YOUNG] {
        for steps in [1, 13] {
            // To first yield, to where nothing is left, and twice as far.
            let mut bar = point::<J2>(&[("yield", 2.0), ("hardening", slope)], &[]);
            bar.pull(2.0 / YOUNG);
            let gone = -2.0 / slope;
            bar.pull_by(0.5 * (gone - 2.0 / YOUNG), steps);
            // Half of the way: p solves ε = σ/E + p.
            assert!((bar.stress[0] - 1.0).abs() < 1e-10 && (bar.state.0[0] - 0.5 * gone).abs() < 1e-12, "{:?}", bar.stress);
            bar.pull_by(0.5 * (gone - 2.0 / YOUNG), steps);
            let expected = 2.0 * 2.0 / (2.0 * -slope);
            assert!((bar.dissipated / expected - 1.0).abs() < 1e-10, "{slope} in {steps}: {} for {expected}", bar.dissipated);
            bar.pull_by(gone, steps);
            assert!((bar.dissipated / expected - 1.0).abs() < 1e-10 && (bar.work / expected - 1.0).abs() < 1e-10, "{slope}: {}", bar.work);
            assert!(bar.stress[0].abs() < 1e-12, "{:?}", bar.stress);
            // Pressure it bears as before, shear not.
            bar.strain([-0.01, -0.01, -0.01, 0.0, 0.0, 0.0]);
            bar.strain([0.0, 0.0, 0.0, 0.1, 0.0, 0.0]);
            let bulk = YOUNG / (3.0 * (1.0 - 2.0 * POISSON));
            assert!((bar.mean() + 0.03 * bulk).abs() < 1e-10 && bar.mises() < 1e-12, "{:?}", bar.stress);
        }
    }
}

#[test]
fn the_rate_multiplies_a_falling_flow_stress_too_until_nothing_is_left() {
    const RATE: f64 = 50.0;
    let law = [("yield", 2.0), ("hardening", -30.0), ("rate_reference", RATE), ("rate_exponent", 4.0)];
    for (time_step, size) in [(1e-3, 1e-4), (1e-3, 1e-3), (1e-5, 1e-3), (1.0, 1e-2)] {
        let mut at = Point { time_step, ..point::<J2>(&law, &[]) };
        for _ in 0..2000 {
            let (old, before) = (at.state.0[0], 3f64.sqrt() * at.stress[3]);
            at.strain([0.0, 0.0, 0.0, size, 0.0, 0.0]);
            let (step, q, trial) = (at.state.0[0] - old, 3f64.sqrt() * at.stress[3], before + 2.0 * 3f64.sqrt() * SHEAR * size);
            assert!((trial - 3.0 * SHEAR * step - q).abs() < 1e-11 * trial, "{time_step} {size}");
            let expected = (2.0 - 30.0 * (old + step)).max(0.0) * (1.0 + (step / (RATE * time_step)).powf(0.25));
            let blur = 1e-11 * trial + 1e-12 * old;
            assert!(step == 0.0 || (q - expected).abs() < blur, "{time_step} {size}: {q} for {expected} at {old} by {step}");
        }
        assert!(at.state.0[0] > 2.0 / 30.0 && at.mises() < 1e-10, "nothing is left: {:?}", at.stress);
    }
}

#[test]
fn the_return_is_solved_for_every_table_up_to_the_steepest_fall() {
    let mut numbers = Spread::new(5);
    for _ in 0..300 {
        // Points from far apart to next to each other, falls up to nine tenths of 3µ, rises of any steepness.
        let (mut strains, mut stresses) = (vec![0.0], vec![numbers.between(1.0, 3.0)]);
        for _ in 1..16 {
            let (strain, stress) = (strains[strains.len() - 1], stresses[stresses.len() - 1]);
            let width = 10f64.powf(numbers.between(-9.0, -2.0));
            let steep = if numbers.between(0.0, 1.0) < 0.3 { 0.8999 } else { numbers.between(0.0, 0.9) };
            let fallen = stress - steep * 3.0 * SHEAR * width;
            let rises = numbers.between(0.0, 1.0) < 0.3 || fallen < 1e-3;
            strains.push(strain + width);
            stresses.push(if rises { stress + numbers.between(0.0, 1.0) } else { fallen });
        }
        let mut at = point::<J2Table>(&[], &[("plastic_strain", &strains), ("stress", &stresses)]);
        let curve = |p: f64| {
            let i = strains.iter().rposition(|&start| p >= start).unwrap_or(0);
            if i + 1 == strains.len() {
                return stresses[i];
            }
            stresses[i] + (stresses[i + 1] - stresses[i]) / (strains[i + 1] - strains[i]) * (p - strains[i])
        };
        for _ in 0..40 {
            let (old, before, size) = (at.state.0[0], at.stress, 10f64.powf(numbers.between(-5.0, -1.5)));
            at.strain([0.0, 0.0, 0.0, size, 0.0, 0.0]);
            let (q, trial) = (3f64.sqrt() * at.stress[3], 3f64.sqrt() * (before[3] + 2.0 * SHEAR * size));
            let step = at.state.0[0] - old;
            assert!((trial - 3.0 * SHEAR * step - q).abs() < 1e-11 * trial.abs());
            // The curve is met to 1e-12 of the trial stress; strains are rounded.
            let blur = 1e-11 * trial + 1e-14 * 3000.0 * SHEAR;
            assert!(step == 0.0 || (q - curve(old + step)).abs() < blur, "{q} for {} at {} by {step}", curve(old + step), old);
        }
    }
}

#[test]
fn a_foam_with_a_peak_follows_its_curve_under_pressure_and_in_crushing() {
    let curve: [(&str, &[f64]); 2] = [("plastic_strain", &[0.0, 0.05, 0.5]), ("stress", &[2.0, 1.0, 3.0])];
    let followed = |p: f64| if p < 0.05 { 2.0 - 20.0 * p } else { (1.0 + 2.0 / 0.45 * (p - 0.05)).min(3.0) };
    for plastic in [0.0, 0.3] {
        for steps in [1, 5, 200] {
            let mut foam = point::<CrushableFoam>(&[("plastic_poisson", plastic)], &curve);
            for _ in 0..2 {
                foam.pull_by(-0.02, steps);
                let p = foam.state[0];
                assert!((foam.stress[0] + followed(p)).abs() < 1e-9, "{plastic} in {steps}: {:?} at {p}", foam.stress);
            }
            let square = 4.5 * (1.0 - 2.0 * plastic) / (1.0 + plastic);
            let mut foam = point::<CrushableFoam>(&[("plastic_poisson", plastic)], &curve);
            for _ in 0..steps {
                let part = -0.03 / f64::from(steps);
                foam.strain([part, part, part, 0.0, 0.0, 0.0]);
            }
            let equivalent = (square * foam.mean().powi(2) / (1.0 + square / 9.0)).sqrt();
            assert!((equivalent - followed(foam.state[0])).abs() < 1e-9, "{plastic} in {steps}: {equivalent}");
        }
    }
}

#[test]
fn cyclic_softening_takes_from_the_yield_stress_what_it_says() {
    let lists: [(&str, &[f64]); 2] = [("backstress_modulus", &[100.0]), ("backstress_recall", &[50.0])];
    let mut bar = point::<Chaboche>(&[("yield", 2.0), ("isotropic_stress", -1.5), ("isotropic_rate", 5.0)], &lists);
    for _ in 0..40 {
        bar.pull_by(0.05, 20);
        bar.pull_by(-0.05, 20);
    }
    // Half of the range of stresses, with the backstress saturated at its cycle: α = C/γ tanh of the path;
    // what is left of σ_y is a quarter.
    bar.pull_by(0.5, 100);
    let (p, tension) = (bar.state.0[0], bar.stress[0]);
    assert!(p > 3.0 && (tension - (0.5 + 2.0)).abs() < 1e-3, "{tension} at {p}");
    bar.pull_by(-0.5, 100);
    assert!((bar.stress[0] + 2.5).abs() < 1e-3);
}

fn reported(law: &str, numbers: &[(&str, f64)], lists: &[(&str, &[f64])]) -> (Vec<String>, Option<f64>) {
    let kind = LAWS.iter().find(|kind| kind.name == law).unwrap();
    let numbers = BASE.iter().chain(numbers).map(|&(name, value)| (name.to_string(), value)).collect();
    let lists = lists.iter().map(|&(name, list)| (name.to_string(), list.to_vec())).collect();
    let parameters = Parameters::new(kind.parameters, &numbers, &lists);
    let found = faults_of(law, &parameters);
    assert!(found.iter().all(|fault| !fault.help.is_empty()));
    (found.into_iter().map(|fault| format!("{}: {}", fault.name, fault.message)).collect(), softening(law, &parameters).map(|it| it.slope))
}

#[test]
fn only_a_fall_without_a_sound_answer_is_refused() {
    let limit = 0.9 * 3.0 * SHEAR;
    let linear = |slope: f64| reported("j2", &[("yield", 2.0), ("hardening", slope)], &[]);
    assert_eq!(linear(0.0), (vec![], None));
    assert_eq!(linear(-0.999 * limit), (vec![], Some(-0.999 * limit)));
    let (found, _) = linear(-1.001 * limit);
    assert!(found.len() == 1 && found[0].starts_with("hardening: ") && found[0].contains("no sound answer"), "{found:?}");
    let table = |last: f64| reported("j2_table", &[], &[("plastic_strain", &[0.0, 0.001]), ("stress", &[2.0, last])]);
    assert!(table(0.9).0[0].starts_with("stress: ") && table(1.9).0.is_empty());
    let voce = |rate: f64| reported("j2_voce", &[("yield", 2.0), ("saturation", 1.0), ("saturation_rate", rate)], &[]);
    assert!(voce(1.001 * limit).0[0].starts_with("saturation: ") && voce(0.999 * limit).0.is_empty());
    let voce = reported("j2_voce", &[("yield", 2.0), ("saturation", 3.0), ("saturation_rate", 10.0), ("hardening", -4.0)], &[]);
    assert_eq!(voce, (vec![], Some(-4.0)));
    let cyclic = |gain: f64, lists: &[(&str, &[f64])]| reported("chaboche", &[("yield", 2.0), ("isotropic_stress", gain)], lists);
    assert!(cyclic(-2.0, &[("backstress_modulus", &[100.0])]).0[0].contains("leaves nothing"));
    // 10 · 1.5 Pa of fall: a backstress that stays makes up for it, one that fades does not, a smaller one
    // never.
    assert_eq!(cyclic(-1.5, &[("backstress_modulus", &[100.0])]), (vec![], None));
    let (found, slope) = cyclic(-1.5, &[("backstress_modulus", &[100.0]), ("backstress_recall", &[50.0])]);
    assert!(found.is_empty() && slope.is_some_and(|slope| (-15.0..0.0).contains(&slope)), "{slope:?}");
    assert_eq!(cyclic(-1.5, &[("backstress_modulus", &[5.0])]), (vec![], Some(-10.0)));
    let foam = |last: f64| reported("crushable_foam", &[], &[("plastic_strain", &[0.0, 0.01]), ("stress", &[10.0, last])]);
    assert!(foam(9.0).0.is_empty() && foam(0.1).0[0].starts_with("stress: "), "{:?}", foam(0.1));
}

/// A bar of `count` elements along x, pulled apart at its ends; the middle element is a little weaker.
fn bar(count: usize, law: &[(&str, f64)]) -> Model {
    let mut model = slender(1.0, 1e9, 1e3);
    model.parts.clear();
    model.materials.clear();
    for (name, strength) in [("steel", 2e6), ("weak", 1.8e6)] {
        let numbers = [("density", 1000.0), ("young", 1e9), ("poisson", POISSON), ("yield", strength)];
        let parameters = numbers.iter().chain(law).map(|&(key, value)| (key.to_string(), value)).collect();
        model.materials.insert(name.into(), Material { law: "j2".into(), parameters, ..Material::default() });
    }
    let width = 0.1 / count as f64;
    let half = count / 2;
    for (name, from, elements) in [("left", 0.0, half), ("middle", half as f64 * width, 1), ("right", (half + 1) as f64 * width, half)] {
        let shape =
            Rectangle { corner: [from, 0.0], size: [elements as f64 * width, width], elements: [elements, 1], ..Rectangle::default() };
        add(&mut model, name, Shape::Rectangle(shape), [0.0; 2]);
        let part = model.parts.last_mut().unwrap();
        part.material = if name == "middle" { "weak".into() } else { "steel".into() };
        part.stress_state = "plane_stress".into();
    }
    for between in [["left.right", "middle.left"], ["middle.right", "right.left"]] {
        model.joins.push(embate_solver::model::Join { between: between.map(Into::into), ..Default::default() });
    }
    for (on, speed) in [("left.left", -0.05), ("right.right", 0.05)] {
        model.constraints.push(Constraint { on: on.into(), velocity: [Some(speed.into()), None, None], ..Constraint::default() });
    }
    model.run.end = 8e-3;
    model
}

#[test]
fn a_bar_softens_in_one_element_and_the_energy_is_that_of_its_size() {
    // Per width of a row: ½ σ_y²/|H|, in plane stress through the width of the bar as well.
    let energy = |count: usize| {
        let (simulation, history) = run(&bar(count, &[("hardening", -2e8)]));
        let summary = simulation.summary();
        assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 1e-3, "{summary:?}");
        assert!(summary.warnings.iter().filter(|line| line.text.contains("lose ellipticity")).count() == 2, "{:?}", summary.warnings);
        // The others flow as far as its contraction bends their ends, no more.
        let [left, middle, right] = ["left", "middle", "right"].map(|part| history.last(&format!("energy.plastic[{part}]")));
        println!("{left} {middle} {right}");
        assert!(left + right < 0.3 * middle, "{left} {middle} {right}");
        let width = 0.1 / count as f64;
        history.last("energy.plastic[middle]") / (width * width)
    };
    let expected = 1.8e6f64.powi(2) / (2.0 * 2e8);
    for count in [5, 9] {
        let found = energy(count);
        println!("{count}: {found} for {expected}");
        assert!((found / expected - 1.0).abs() < 0.02, "{count}: {found} for {expected}");
    }
}

#[test]
fn a_softening_bar_has_the_same_bits_on_every_instruction_set() {
    let mut model = bar(9, &[("hardening", -2e8)]);
    model.run.end = 2e-3;
    let hash = |level: Level| {
        let mut simulation = Simulation::new(&model, &Options { threads: 1, simd: Some(level.name().into()) }).unwrap();
        simulation.advance(model.run.end, u64::MAX).unwrap();
        let Summary { state_hash, steps, .. } = simulation.summary();
        (state_hash, steps)
    };
    let reference = hash(Level::SCALAR);
    assert!(reference.1 > 100);
    for level in Level::available() {
        assert_eq!(hash(level), reference, "{}", level.name());
    }
}

#[test]
fn a_plate_and_a_rod_bear_less_of_a_fall_than_a_solid() {
    let mut model = bar(5, &[("hardening", -0.9 * 1e9 / (2.0 * (1.0 - POISSON)) * 1.01)]);
    let found = faults(&model);
    assert!(found.len() == 3 && found[0].contains("plane stress"), "{found:?}");
    for part in &mut model.parts {
        part.stress_state.clear();
    }
    assert_eq!(faults(&model), Vec::<String>::new());
    for it in model.materials.values_mut() {
        it.parameters.insert("hardening".into(), -0.91e9);
    }
    assert_eq!(faults(&model), Vec::<String>::new());
    let part = &mut model.parts[1];
    (part.element, part.area) = ("bar2".into(), Some(1e-3));
    let found = embate_solver::model::Model::check(&model);
    assert!(found.iter().any(|fault| fault.path == "part[1].material" && fault.message.contains("in a bar")), "{found:?}");
}
