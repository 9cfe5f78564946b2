//! Shells: forces against the slope of the energy, momenta, turns without strain, the stable step against
//! true frequencies, and layers that flow.

use crate::patches::{Spread, YOUNG, material, solids};
use embate_lanes::{Level, Team};
use embate_solver::block::{Block, BlockInput, Motion, NodalForces, Report, evaluate_at_rest, make};
use embate_solver::material::variable::PLASTIC_STRAIN;
use embate_solver::model::{Material, ShellSection};
use embate_solver::rotations::Rotations;
use std::f64::consts::{PI, TAU};

const STATES: [&str; 3] = ["plane_strain", "plane_stress", "axisymmetric"];

pub(crate) fn section(thickness: f64) -> ShellSection {
    ShellSection { thickness, ..ShellSection::default() }
}

/// Some shells, driven by places and rotations of their nodes.
struct Chain {
    block: Box<dyn Block<2>>,
    forces: Vec<[f64; 2]>,
    moments: Vec<[f64; 3]>,
    positions: Vec<[f64; 2]>,
    rotations: Rotations,
    report: Report,
    time_step: f64,
}

impl Chain {
    fn new(material: &Material, state: &str, section: &ShellSection, positions: &[[f64; 2]], damping: f64) -> Self {
        let connectivity: Vec<u32> = (1..positions.len() as u32).flat_map(|k| [k - 1, k]).collect();
        let input = BlockInput {
            section: Some(section),
            stress_state: state,
            damping,
            ..BlockInput::new("shell2", material, &connectivity, positions)
        };
        let mut block = make(&input).unwrap();
        let slots = block.slots().len();
        let report = evaluate_at_rest(block.as_mut(), positions, Level::best());
        Self {
            forces: vec![[0.0; 2]; slots],
            moments: vec![[0.0; 3]; slots],
            positions: positions.to_vec(),
            rotations: Rotations::at_rest(0..positions.len() as u32, 2),
            report,
            time_step: 1e-3,
            block,
        }
    }

    /// A step to places and angles.
    fn go(&mut self, positions: &[[f64; 2]], angles: &[f64]) {
        let velocities: Vec<[f64; 2]> =
            positions.iter().zip(&self.positions).map(|(x, old)| [0, 1].map(|d| (x[d] - old[d]) / self.time_step)).collect();
        self.rotations.angles.copy_from_slice(angles);
        let motion = Motion { rotations: &self.rotations, ..Motion::new(positions, &velocities, self.time_step) };
        let pulls = NodalForces { forces: &mut self.forces, moments: &mut self.moments };
        self.report = self.block.advance(&motion, Level::best(), pulls, &mut Team::alone());
        self.positions.copy_from_slice(positions);
    }

    /// Pulls of one element as one list: force and moment of each node.
    fn pulls(&self) -> [f64; 6] {
        let [a, b] = [0, 1].map(|k| [self.forces[k][0], self.forces[k][1], self.moments[k][2]]);
        [a[0], a[1], a[2], b[0], b[1], b[2]]
    }
}

fn moved(start: &[[f64; 2]; 2], by: &[f64; 6]) -> ([[f64; 2]; 2], [f64; 2]) {
    let [a, b] = *start;
    ([[a[0] + by[0], a[1] + by[1]], [b[0] + by[3], b[1] + by[4]]], [by[2], by[5]])
}

/// One element that goes there in `steps` equal steps.
fn led(material: &Material, state: &str, section: &ShellSection, start: &[[f64; 2]; 2], by: &[f64; 6], steps: usize) -> Chain {
    let mut one = Chain::new(material, state, section, start, 0.0);
    for k in 1..=steps {
        let part = by.map(|x| x * k as f64 / steps as f64);
        let (positions, angles) = moved(start, &part);
        one.go(&positions, &angles);
    }
    one
}

/// A random element, right of the axis, and a random motion of it.
fn random(numbers: &mut Spread, size: f64) -> ([[f64; 2]; 2], [f64; 6]) {
    let angle = numbers.between(0.0, TAU);
    let middle = [numbers.between(2.0, 5.0), numbers.between(-1.0, 1.0)];
    let half = [0.5 * angle.cos(), 0.5 * angle.sin()];
    let start = [[middle[0] - half[0], middle[1] - half[1]], [middle[0] + half[0], middle[1] + half[1]]];
    (start, std::array::from_fn(|_| numbers.between(-size, size)))
}

#[test]
fn forces_and_moments_of_rubber_are_the_slope_of_its_energy() {
    let mut numbers = Spread::new(1);
    for (state, law) in STATES.into_iter().flat_map(|state| ["neo_hookean", "yeoh"].map(|law| (state, law))) {
        for _ in 0..20 {
            let (start, by) = random(&mut numbers, 0.15);
            let (rubber, section) = (material(law, 0.3), section(numbers.between(0.02, 0.4)));
            let energy = |by: &[f64; 6]| led(&rubber, state, &section, &start, by, 1).report.stored;
            let pulls = led(&rubber, state, &section, &start, &by, 1).pulls();
            let size = pulls.iter().fold(0.0, |size: f64, pull| size.max(pull.abs()));
            for k in 0..6 {
                let [mut low, mut high] = [by; 2];
                (low[k], high[k]) = (by[k] - 1e-5, by[k] + 1e-5);
                let slope = (energy(&high) - energy(&low)) / 2e-5;
                assert!(
                    (pulls[k] + slope).abs() < 1e-6 * size + 1e-8 * YOUNG * section.thickness,
                    "{law} {state} {k}: {} for {} of {size}",
                    pulls[k],
                    -slope
                );
            }
        }
    }
}

#[test]
fn forces_and_their_moments_vanish_together_for_every_law() {
    let mut numbers = Spread::new(3);
    for law in solids() {
        for state in ["plane_strain", "plane_stress"] {
            let (start, by) = random(&mut numbers, 0.1);
            let one = led(&material(law.name, 0.3), state, &section(0.1), &start, &by, 20);
            let pulls = one.pulls();
            let size = pulls.iter().fold(0.0, |size: f64, pull| size.max(pull.abs()));
            let [a, b] = one.positions[..] else { panic!() };
            let moment = a[0] * pulls[1] - a[1] * pulls[0] + pulls[2] + b[0] * pulls[4] - b[1] * pulls[3] + pulls[5];
            assert!(size > 1e-4 * YOUNG * 0.1 && pulls.iter().all(|pull| pull.is_finite()), "{}: {pulls:?}", law.name);
            assert!((pulls[0] + pulls[3]).abs() < 1e-14 * size && (pulls[1] + pulls[4]).abs() < 1e-14 * size, "{}: {pulls:?}", law.name);
            assert!(moment.abs() < 3e-14 * size, "{}: {moment} of {size}", law.name);
        }
    }
}

#[test]
fn a_turn_of_any_size_in_one_step_is_no_strain() {
    for law in ["elastic", "j2", "neo_hookean", "orthotropic_elastic", "viscoelastic"] {
        for turn in [0.3, 1.0, PI, 40.0] {
            // A bent and folded chain.
            let start = [[0.0, 0.0], [1.0, 0.2], [1.8, 0.9], [1.8, 2.1], [0.4, 2.1]];
            let mut chain = Chain::new(&material(law, 0.3), "plane_strain", &section(0.05), &start, 0.0);
            let (sin, cos) = turn.sin_cos();
            let turned = start.map(|[x, y]| [3.0 + cos * x - sin * y, -7.0 + sin * x + cos * y]);
            chain.go(&turned, &[turn; 5]);
            for element in 0..4 {
                let state = chain.block.state(element);
                assert!(state.stress.iter().all(|s| s.abs() < 4e-13 * YOUNG), "{law} {turn}: {:?}", state.stress);
            }
            assert!(chain.report.stored.abs() < 1e-20 * YOUNG, "{law} {turn}: {}", chain.report.stored);
        }
    }
}

/// The largest eigenvalue of M⁻¹K of one element at its start, by the response to small motions, and four
/// over the square of its step.
fn frequency_and_bound(material: &Material, state: &str, section: &ShellSection, start: &[[f64; 2]; 2]) -> [f64; 2] {
    let one = Chain::new(material, state, section, start, 0.0);
    let masses: Vec<f64> = (0..2).map(|corner| one.block.corner_mass(0, corner)).collect();
    let inertia: Vec<f64> = one.block.rotating_nodes().iter().map(|(_, inertia)| *inertia).collect();
    let mass = [masses[0], masses[0], inertia[0], masses[1], masses[1], inertia[1]];
    let h = 1e-7;
    let columns: Vec<[f64; 6]> = (0..6)
        .map(|k| {
            let mut by = [0.0; 6];
            by[k] = h;
            led(material, state, section, start, &by, 1).pulls().map(|pull| -pull / h)
        })
        .collect();
    let k = |i: usize, j: usize| 0.5 * (columns[j][i] + columns[i][j]) / (mass[i] * mass[j]).sqrt();
    let mut v: [f64; 6] = std::array::from_fn(|i| 1.0 + 0.37 * i as f64);
    let mut largest = 0.0;
    for _ in 0..20_000 {
        let w: [f64; 6] = std::array::from_fn(|i| (0..6).map(|j| k(i, j) * v[j]).sum());
        largest = w.iter().map(|w| w * w).sum::<f64>().sqrt();
        v = w.map(|w| w / largest);
    }
    [largest, 4.0 / one.report.time_step_squared]
}

#[test]
fn the_step_bounds_the_frequency_of_any_element_and_reaches_it_in_the_plane() {
    let mut numbers = Spread::new(5);
    for state in STATES {
        for case in 0..60 {
            let thickness = 10f64.powf(numbers.between(-2.0, 0.5));
            let (mut start, _) = random(&mut numbers, 0.0);
            if state == "axisymmetric" {
                // Near the axis too.
                let least = start[0][0].min(start[1][0]);
                let shift = [0.0, 0.51 * thickness, 1.0, 20.0][case % 4];
                start.iter_mut().for_each(|x| x[0] += shift - least);
                if 0.5 * (start[0][0] + start[1][0]) < 0.55 * thickness {
                    continue;
                }
            }
            let elastic = material("elastic", numbers.between(0.0, 0.45));
            let [frequency, bound] = frequency_and_bound(&elastic, state, &section(thickness), &start);
            assert!(frequency < 1.0001 * bound, "{state} {start:?} {thickness}: {frequency} over {bound}");
            if state != "axisymmetric" {
                assert!(frequency > 0.9999 * bound, "{state} {thickness}: {frequency} under {bound}");
            }
        }
    }
}

#[test]
fn a_hinge_has_the_moment_of_its_points_and_books_its_work() {
    // Ideally plastic; exact: M = M_p (3/2 − ½ (κ_y/κ)²) M_e/M_p with the elastic limit at κ_y.
    let (flow, thickness) = (1.0, 0.1);
    let mut steel = material("j2", 0.3);
    steel.parameters.insert("yield".into(), flow);
    steel.parameters.insert("hardening".into(), 0.0);
    for (rule, points, share) in
        [("gauss", 4, 1.043), ("gauss", 5, 0.945), ("gauss", 6, 1.020), ("lobatto", 5, 0.913), ("gauss", 10, 1.008)]
    {
        let section = ShellSection { points, rule: rule.into(), ..section(thickness) };
        for (state, factor) in [("plane_stress", 1.0), ("plane_strain", 2.0 / 3.0f64.sqrt())] {
            let start = [[0.0, 0.0], [1.0, 0.0]];
            let mut one = Chain::new(&steel, state, &section, &start, 0.0);
            let full = factor * flow * thickness * thickness / 4.0;
            // Large against κ_y = 2 σ_y/(E t), small against what changes the thickness.
            let (steps, last) = (4000, 0.6);
            let (mut work, mut before) = (0.0, 0.0);
            for k in 1..=steps {
                let bend = last * f64::from(k) / f64::from(steps);
                one.go(&start, &[-0.5 * bend, 0.5 * bend]);
                work += 0.5 * (-one.moments[1][2] + before) * last / f64::from(steps);
                before = -one.moments[1][2];
            }
            assert!((before / full / share - 1.0).abs() < 3e-3, "{rule} {points} {state}: {}", before / full);
            let booked = one.report.stored + one.report.dissipated;
            assert!((booked / work - 1.0).abs() < 1e-5 && one.report.dissipated > 0.8 * work, "{booked} for {work}");
            let state = one.block.state(0);
            assert!(
                (state.shell[3] - before).abs() < 1e-12 * before && (state.shell[8] / thickness - 1.0).abs() < 0.01,
                "{:?}",
                state.shell
            );
            assert!(one.block.variable(&state, &PLASTIC_STRAIN).unwrap() > 0.02);
        }
    }
}

#[test]
fn layers_without_stress_across_are_those_of_every_law() {
    // Stretched along: of laws that are alike in all directions a layer in plane stress is a bar.
    let mut seen = 0;
    for law in solids().filter(|law| crate::patches::is_isotropic(law.name)) {
        let material = material(law.name, 0.3);
        let start = [[0.0, 0.0], [1.0, 0.0]];
        let mut shell = Chain::new(&material, "plane_stress", &section(0.01), &start, 0.0);
        let input = BlockInput { area: 0.01, ..BlockInput::new("bar2", &material, &[0, 1], &start) };
        let mut bar = make(&input).unwrap();
        let mut old = start;
        for k in 1..=50 {
            let positions = [[0.0, 0.0], [1.0 + 1e-3 * f64::from(k), 0.0]];
            shell.go(&positions, &[0.0; 2]);
            let velocities = [[0.0; 2], [(positions[1][0] - old[1][0]) / 1e-3, 0.0]];
            let motion = Motion::new(&positions, &velocities, 1e-3);
            let mut slots = [[0.0; 2]; 2];
            let report = bar.advance(&motion, Level::best(), NodalForces::new(&mut slots), &mut Team::alone());
            old = positions;
            assert!((shell.forces[0][0] - slots[0][0]).abs() < 1e-9 * YOUNG * 0.01, "{}: {:?} {slots:?}", law.name, shell.forces);
            assert!((shell.report.stored - report.stored).abs() < 1e-9 * YOUNG * 0.01, "{}", law.name);
        }
        seen += 1;
    }
    assert!(seen > 10);
}

#[test]
fn damping_by_stiffness_takes_energy_and_shortens_the_step_as_it_says() {
    let elastic = material("elastic", 0.3);
    let (start, beta) = ([[0.0, 0.0], [1.0, 0.0]], 0.01);
    let [free, damped] = [0.0, beta].map(|beta| {
        let mut one = Chain::new(&elastic, "plane_strain", &section(0.1), &start, beta);
        for k in 1..=100 {
            let x = 1e-4 * f64::from(k);
            one.go(&[[0.0, 0.0], [1.0 + x, 0.5 * x]], &[0.0, 0.3 * x]);
        }
        one
    });
    let dt = free.report.time_step_squared.sqrt();
    assert!((damped.report.time_step_squared.sqrt() / ((beta * beta + dt * dt).sqrt() - beta) - 1.0).abs() < 1e-3);
    assert!(damped.report.damping > 0.0 && free.report.damping == 0.0);
    // β C ε̇ beside the stress: the force grows by β/Δt times what it grew by in the step.
    let rate = 1e-4 / 1e-3;
    let expected = beta * rate * 0.1 * YOUNG / (1.0 - 0.09);
    assert!(((damped.forces[0][0] - free.forces[0][0]) / expected - 1.0).abs() < 0.02, "{:?} {:?}", damped.forces, free.forces);
}
