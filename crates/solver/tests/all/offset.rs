//! Shells whose nodes are not in their middle: twins on both sides of the same nodes, forces against the
//! slope of the energy, the stable step, faces, momenta.

use crate::bodies::*;
use crate::patches::{Spread, material};
use crate::sheet_models::crash;
use crate::shell_benchmarks::{Problem, elastic, is_near};
use crate::shells::section;
use crate::shells_in_space::{Driven, frequency_and_bound, motion, moved, random};
use crate::solids::cross;
use embate_solver::block::BlockInput;
use embate_solver::model::{LOWER, Line, Rectangle, ShellSection, UPPER};

type Vector = [f64; 3];

fn beside(thickness: f64, reference: &str) -> ShellSection {
    ShellSection { reference: reference.into(), ..section(thickness) }
}

#[test]
fn a_plate_with_its_twin_on_the_other_side_is_one_of_twice_the_thickness() {
    // Both with their nodes on the face that they have in common: eight times the bending stiffness of one.
    let steel = elastic(2e9, 0.3);
    let thickness = 0.02;
    // The transverse shear of triangles depends on the thickness of each by itself, so that theirs differ.
    for element in ["shell4", "shell4_full"] {
        // Distorted, so that patterns of hourglass work, too.
        let at = |u: f64, v: f64| {
            let bulge = 0.08 * (u * (1.0 - u) * v * (1.0 - v) * 16.0);
            [[u + bulge, v - 0.7 * bulge, 0.0], [0.0, 0.0, 1.0]]
        };
        let load = |problem: &mut Problem| {
            problem.hold(|i, _| i == 0, &[0, 1, 2, 3, 4, 5]);
            let [one, other] = [problem.node(4, 0), problem.node(4, 4)];
            // Bent and twisted.
            problem.load[6 * one + 2] = 1.0;
            problem.load[6 * other + 2] = 0.3;
            problem.solve()[6 * one + 2]
        };
        let mut both = Problem::of(element, [4, 4], &steel, (&beside(thickness, LOWER), &[]), true, at);
        let section = beside(thickness, UPPER);
        let directions = vec![[0.0, 0.0, 1.0]; both.cells.len()];
        let input =
            BlockInput { section: Some(&section), directions: &directions, ..BlockInput::new(element, &steel, &both.cells, &both.start) };
        both.twins.push(Driven::of(&input));
        let mut whole = Problem::of(element, [4, 4], &steel, (&crate::shells::section(2.0 * thickness), &[]), true, at);
        let mut one = Problem::of(element, [4, 4], &steel, (&crate::shells::section(thickness), &[]), true, at);
        let (both, whole, one) = (load(&mut both), load(&mut whole), load(&mut one));
        is_near(&format!("{element} twins"), both, whole, 1e-5);
        is_near(&format!("{element} eightfold"), one, 8.0 * both, 1e-2);
    }
}

fn driven(element: &str, law: &embate_solver::model::Material, section: &ShellSection, start: &[Vector], directions: &[Vector]) -> Driven {
    let nodes: Vec<u32> = (0..start.len() as u32).collect();
    Driven::new(element, law, section, start, &nodes, directions)
}

#[test]
fn forces_and_moments_of_rubber_beside_its_nodes_are_the_slope_of_the_energy() {
    let mut numbers = Spread::new(31);
    for (element, corners) in [("shell4", 4), ("shell3", 3)] {
        for case in 0..6 {
            let (start, directors) = random(&mut numbers, corners, 0.1);
            let by = motion(&mut numbers, corners, 0.1);
            let section = beside(numbers.between(0.02, 0.2), [LOWER, UPPER][case % 2]);
            let rubber = material("neo_hookean", 0.3);
            let at = |by: &[f64]| {
                let mut one = driven(element, &rubber, &section, &start, &directors);
                let (places, turns) = moved(&start, by);
                one.go(&places, &turns);
                one
            };
            let pulls = at(&by).pulls();
            let size = pulls.iter().fold(0.0, |size: f64, pull| size.max(pull.abs()));
            let h = 1e-6;
            for k in (0..6 * corners).filter(|k| k % 6 < 3) {
                let energy = |step: f64| {
                    let mut by = by.clone();
                    by[k] += step;
                    at(&by).energy()
                };
                let slope = (energy(h) - energy(-h)) / (2.0 * h);
                assert!((slope + pulls[k]).abs() < 1e-7 * size, "{element} {case} {k}: {slope} {}", pulls[k]);
            }
            let (places, _) = moved(&start, &by);
            let (mut force, mut moment) = ([0.0; 3], [0.0; 3]);
            for (k, x) in places.iter().enumerate() {
                let [f, m]: [Vector; 2] = [0, 3].map(|first| std::array::from_fn(|i| pulls[6 * k + first + i]));
                let arm = cross(*x, f);
                (0..3).for_each(|i| (force[i], moment[i]) = (force[i] + f[i], moment[i] + m[i] + arm[i]));
            }
            assert!(force.iter().chain(&moment).all(|sum| sum.abs() < 1e-12 * size), "{element}: {force:?} {moment:?}");
        }
    }
}

#[test]
fn the_step_bounds_the_frequency_of_shells_beside_their_nodes() {
    let mut numbers = Spread::new(17);
    for (element, corners) in [("shell4", 4), ("shell3", 3)] {
        let (mut most, mut least) = (0.0f64, f64::INFINITY);
        for case in 0..90 {
            let thickness = 10f64.powf(numbers.between(-3.0, 0.0));
            let (start, directions) = random(&mut numbers, corners, [0.0, 0.1, 0.2][case % 3]);
            let section = ShellSection { offset: thickness * numbers.between(-0.5, 0.5), ..section(thickness) };
            let section = [section, beside(thickness, LOWER), beside(thickness, UPPER)][case % 3].clone();
            let law = material("elastic", numbers.between(0.0, 0.49));
            let [frequency, bound] = frequency_and_bound(|| driven(element, &law, &section, &start, &directions));
            assert!(frequency < 1.0001 * bound, "{element} {case} {start:?} {thickness}: {frequency} over {bound}");
            (most, least) = (most.max(frequency / bound), least.min(frequency / bound));
        }
        println!("{element}: true over bound {least} to {most}");
        assert!(least > 0.2, "{element}: {least}");
    }
}

#[test]
fn faces_are_where_the_middle_says() {
    let mut model = model(1e-4);
    add(&mut model, "sheet", Rectangle { size: [1.0; 2], elements: [2; 2], ..Rectangle::default() }.into(), [0.0; 2]);
    model.parts[0].element = "shell4".into();
    for (section, expected) in [
        (beside(0.02, LOWER), [0.0, 0.02]),
        (beside(0.02, UPPER), [-0.02, 0.0]),
        (ShellSection { offset: 0.004, ..section(0.02) }, [-0.006, 0.014]),
    ] {
        model.parts[0].section = Some(section);
        let places = simulation(&model).coordinates();
        // Nine nodes of the middle, and as many on each face.
        let count = |height: f64| places.iter().skip(2).step_by(3).filter(|z| (*z - height).abs() < 1e-15).count();
        let of = |height: f64| if height == 0.0 { 18 } else { 9 };
        assert!(expected.iter().all(|&height| count(height) == of(height)), "{expected:?}: {places:?}");
    }
    model.parts[0].section = Some(ShellSection { offset: 0.011, ..section(0.02) });
    let faults = faults(&model).join("\n");
    assert!(faults.contains("part[0].section.offset") && faults.contains("within its thickness"), "{faults}");
    // In 2D the left face is the upper one.
    let mut model = crate::bodies::model(1e-4);
    add(
        &mut model,
        "line",
        Line { points: vec![[0.0, 0.0], [0.3, 0.0], [0.6, 0.0]], radius: 0.0, closed: false, elements: 2 }.into(),
        [0.0; 2],
    );
    (model.parts[0].element, model.parts[0].section) = ("shell2".into(), Some(beside(0.02, LOWER)));
    let places = simulation(&model).coordinates();
    let count = |height: f64| places.iter().skip(1).step_by(2).filter(|y| (*y - height).abs() < 1e-15).count();
    assert_eq!([count(0.0), count(0.02)], [6, 3], "{places:?}");
}

#[test]
fn sheets_beside_their_nodes_keep_momenta_and_the_ledger_and_have_equal_bits() {
    let mut model = crash(1.5e-4, 8);
    model.parts[1].section = Some(beside(0.001, LOWER));
    model.parts[2].section = Some(ShellSection { offset: -0.0003, ..section(0.001) });
    let (simulation, history) = run(&model);
    let summary = simulation.summary();
    assert!(history.largest("contact.energy[all]") > 0.0 && history.last("energy.plastic") > 0.1);
    assert!(summary.ledger_residual < 1e-12, "{:e}", summary.ledger_residual);
    assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-12, "{summary:?}");
    assert!(summary.energy_drift < 1e-2, "{:e}", summary.energy_drift);
    hash_of_equal_bits(&model, &[1, 2], "offset");
}

#[test]
fn a_strip_in_2d_beside_its_nodes_swings_without_gaining_energy() {
    for state in ["plane_strain", "plane_stress"] {
        let mut model = model(4e-3);
        model.materials.insert("soft".into(), crate::bodies::elastic(200e9, 7800.0));
        let line = Line { points: vec![[0.0, 0.0], [0.5, 0.0]], radius: 0.0, closed: false, elements: 20 };
        add(&mut model, "strip", line.into(), [0.0; 2]);
        let part = model.parts.last_mut().unwrap();
        (part.element, part.section, part.stress_state) = ("shell2".into(), Some(beside(0.02, LOWER)), state.into());
        let mut simulation = simulation(&model);
        let nodes = simulation.nodes_of("strip").unwrap();
        let places = simulation.coordinates();
        let velocities: Vec<f64> = nodes
            .iter()
            .flat_map(|&node| {
                let x = places[2 * node as usize];
                [20.0 * (std::f64::consts::PI * x / 0.5).cos(), 30.0 * (std::f64::consts::TAU * x / 0.5).cos()]
            })
            .collect();
        simulation.set_velocities(&nodes, &velocities).unwrap();
        simulation.advance(f64::INFINITY, u64::MAX).unwrap();
        let summary = simulation.summary();
        assert!(simulation.steps() > 500 && summary.ledger_residual < 1e-12, "{state}: {:e}", summary.ledger_residual);
        assert!(summary.energy_drift < 2e-3, "{state}: {:e}", summary.energy_drift);
    }
}
