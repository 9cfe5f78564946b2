//! Beams: forces against the slope of the energy, momenta, rotations without strain, the stable step against
//! true frequencies, and closed forms through whole models.

use crate::bodies::*;
use crate::patches::{Spread, YOUNG, eigenvalues, material, solids};
use crate::shells_in_space::{Driven, unit};
use crate::solids::{Vector, cross};
use embate_solver::block::BlockInput;
use embate_solver::material::bears_uniaxial_stress;
use embate_solver::model::{
    Constraint, Curve, CurveShape, Load, Material, Model, Part, Probe, ProbeAt, Profile, Shape, SpaceTruss, StableStep,
};
use embate_solver::rigid::space::Attitude;
use embate_solver::simulation::Simulation;
use std::f64::consts::{PI, TAU};

fn plus(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|k| a[k] + b[k])
}
pub(crate) fn shape(name: &str) -> Profile {
    Profile { shape: name.into(), ..Profile::default() }
}
pub(crate) fn rectangle(width: f64, height: f64) -> Profile {
    Profile { width: Some(width), height: Some(height), ..shape("rectangle") }
}
pub(crate) fn round(diameter: f64) -> Profile {
    Profile { diameter: Some(diameter), ..shape("round") }
}

/// One of each shape, a tenth of a metre in size times `scale`.
fn profiles(scale: f64) -> Vec<Profile> {
    let size = |x: f64| Some(x * scale);
    vec![
        rectangle(0.06 * scale, 0.1 * scale),
        round(0.1 * scale),
        Profile { diameter: size(0.1), thickness: size(0.01), ..shape("tube") },
        Profile { width: size(0.06), height: size(0.1), thickness: size(0.008), ..shape("box") },
        Profile { width: size(0.06), height: size(0.1), web: size(0.006), flange: size(0.01), ..shape("i") },
        Profile {
            area: Some(2e-3 * scale.powi(2)),
            inertia_y: Some(2e-6 * scale.powi(4)),
            inertia_z: Some(1e-6 * scale.powi(4)),
            torsion: Some(5e-7 * scale.powi(4)),
            ..shape("given")
        },
    ]
}

/// One beam.
fn one_of(material: &Material, profile: &Profile, positions: [Vector; 2]) -> Driven {
    Driven::of(&BlockInput { profile: Some(profile), ..BlockInput::new("beam2", material, &[0, 1], &positions) })
}

/// Where nodes are after a way and a rotation vector of each.
fn moved(start: [Vector; 2], by: &[f64; 12]) -> ([Vector; 2], [Attitude; 2]) {
    let own = |first: usize| [by[first], by[first + 1], by[first + 2]];
    ([plus(start[0], own(0)), plus(start[1], own(6))], [Attitude::exponential(own(3)), Attitude::exponential(own(9))])
}

/// A beam that goes there in equal steps.
fn led(material: &Material, profile: &Profile, start: [Vector; 2], by: &[f64; 12], steps: usize) -> Driven {
    let mut one = one_of(material, profile, start);
    for k in 1..=steps {
        let (places, turns) = moved(start, &by.map(|x| x * k as f64 / steps as f64));
        one.go(&places, &turns);
    }
    one
}

/// A random beam of a length, and a random motion of it on top of a rotation of the whole.
fn random(numbers: &mut Spread, length: f64, size: f64) -> ([Vector; 2], [f64; 12]) {
    let from = numbers.in_3d(0.5);
    let start = [from, plus(from, unit(numbers.in_3d(1.0)).map(|x| x * length))];
    (start, std::array::from_fn(|_| numbers.between(-size, size)))
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |size, value| size.max(value.abs()))
}

#[test]
fn forces_and_moments_of_rubber_are_the_slope_of_the_energy() {
    let mut numbers = Spread::new(1);
    let mut worst = 0.0f64;
    for law in ["neo_hookean", "yeoh"] {
        for (case, profile) in profiles(3.0).into_iter().cycle().take(18).enumerate() {
            // Rotations of up to some 2 rad between both nodes.
            let size = [0.1, 0.3, 0.8][case / 6];
            let (start, mut by) = random(&mut numbers, 1.0, size);
            // No fibre is pressed to nothing.
            (0..12).filter(|k| k % 6 < 3).for_each(|k| by[k] *= 0.15 / size);
            let rubber = material(law, 0.3);
            let (places, turns) = moved(start, &by);
            let at = |places: [Vector; 2], turns: [Attitude; 2]| {
                let mut one = one_of(&rubber, &profile, start);
                one.go(&places, &turns);
                one
            };
            let pulls = at(places, turns).pulls();
            for k in 0..12 {
                // A small rotation after the large one.
                let near = |step: f64| {
                    let (mut places, mut turns) = (places, turns);
                    let mut axis = [0.0; 3];
                    axis[k % 3] = step;
                    if k % 6 < 3 {
                        places[k / 6] = plus(places[k / 6], axis)
                    } else {
                        turns[k / 6] = Attitude::exponential(axis).after(&turns[k / 6])
                    }
                    at(places, turns).report.stored
                };
                let slope = (8.0 * (near(1e-4) - near(-1e-4)) - (near(2e-4) - near(-2e-4))) / 12e-4;
                let error = (pulls[k] + slope).abs() / largest(&pulls);
                worst = worst.max(error);
                assert!(error < 1e-8, "{law} {} {k}: {} for {} of {pulls:?} by {by:?}", profile.shape, pulls[k], -slope);
            }
        }
    }
    println!("worst slope {worst:e}");
}

#[test]
fn forces_and_their_moments_vanish_together_for_every_law() {
    let mut numbers = Spread::new(3);
    for law in solids().filter(|law| bears_uniaxial_stress(law.name) == Some(true)) {
        for profile in profiles(3.0) {
            let (start, by) = random(&mut numbers, 1.0, 0.1);
            let one = led(&material(law.name, 0.3), &profile, start, &by, 20);
            let pulls = one.pulls();
            let size = largest(&pulls);
            assert!(size > 1e-5 * YOUNG && pulls.iter().all(|pull| pull.is_finite()), "{}: {pulls:?}", law.name);
            let [first, second] = [0, 1].map(|k| cross(one.positions[k], one.forces[k]));
            let force = plus(one.forces[0], one.forces[1]);
            let moment = plus(plus(first, second), plus(one.moments[0], one.moments[1]));
            assert!(largest(&force) < 1e-15 * size, "{}: {force:?}", law.name);
            assert!(largest(&moment) < 1e-14 * size, "{}: {moment:?} of {size}", law.name);
        }
    }
}

#[test]
fn a_rotation_of_any_size_in_one_step_is_no_strain() {
    let mut numbers = Spread::new(5);
    for law in ["elastic", "j2", "neo_hookean", "viscoelastic", "chaboche"] {
        for angle in [0.3, 1.0, 3.0, 40.0] {
            for profile in profiles(1.0) {
                let (start, _) = random(&mut numbers, 1.0, 0.0);
                let turn = Attitude::exponential(unit(numbers.in_3d(1.0)).map(|x| angle * x));
                let mut one = one_of(&material(law, 0.3), &profile, start);
                one.go(&start.map(|x| plus(turn.turned(x), [3.0, -7.0, 1.0])), &[turn; 2]);
                assert!(largest(&one.block.state(0).stress) < 1e-13 * YOUNG, "{law}: {:?}", one.block.state(0).stress);
                assert!(largest(&one.pulls()) < 1e-13 * YOUNG * 0.01, "{law} {}: {:?}", profile.shape, one.pulls());
            }
        }
    }
}

#[test]
fn a_rotation_of_a_loaded_beam_rotates_its_forces() {
    let mut numbers = Spread::new(6);
    for law in ["elastic", "neo_hookean", "j2"] {
        let (start, by) = random(&mut numbers, 1.0, 0.2);
        let mut one = led(&material(law, 0.3), &profiles(2.0)[0], start, &by, 10);
        let before = [&one.forces[..], &one.moments].concat();
        let turn = Attitude::exponential(numbers.in_3d(3.0));
        let (places, turns) = moved(start, &by);
        one.go(&places.map(|x| turn.turned(x)), &turns.map(|own| turn.after(&own)));
        let size = before.iter().map(|v| largest(v)).fold(0.0, f64::max);
        for (old, new) in before.iter().zip([&one.forces[..], &one.moments].concat()) {
            let expected = turn.turned(*old);
            assert!(largest(&[0, 1, 2].map(|k| new[k] - expected[k])) < 2e-13 * size.max(YOUNG * 1e-2), "{law}: {new:?} {expected:?}");
        }
    }
}

#[test]
fn it_does_not_matter_which_node_is_the_first() {
    let mut numbers = Spread::new(7);
    for law in ["elastic", "j2", "neo_hookean"] {
        for profile in profiles(2.0) {
            let (start, by) = random(&mut numbers, 1.0, 0.15);
            let swapped: [f64; 12] = std::array::from_fn(|k| by[(k + 6) % 12]);
            let first = led(&material(law, 0.3), &profile, start, &by, 20).pulls();
            let second = led(&material(law, 0.3), &profile, [start[1], start[0]], &swapped, 20).pulls();
            let back: [f64; 12] = std::array::from_fn(|k| second[(k + 6) % 12]);
            let worst = largest(&std::array::from_fn::<f64, 12, _>(|k| first[k] - back[k]));
            assert!(worst < 1e-12 * largest(&first), "{law} {}: {worst} of {}", profile.shape, largest(&first));
        }
    }
}

/// Largest of M⁻¹K by the response to small motions from where `by` leads, and four over the square of the
/// step there.
fn frequency_and_bound(material: &Material, profile: &Profile, start: [Vector; 2], by: &[f64; 12]) -> [f64; 2] {
    let (places, turns) = moved(start, by);
    let at = |k: usize, step: f64| {
        let mut axis = [0.0; 3];
        axis[k % 3] = step;
        let (mut places, mut turns) = (places, turns);
        if k % 6 < 3 {
            places[k / 6] = plus(places[k / 6], axis)
        } else {
            turns[k / 6] = Attitude::exponential(axis).after(&turns[k / 6])
        }
        let mut one = one_of(material, profile, start);
        one.go(&places, &turns);
        one
    };
    let one = at(0, 0.0);
    let inertia: Vec<f64> = one.block.rotating_nodes().iter().map(|(_, inertia)| *inertia).collect();
    let mass: [f64; 12] = std::array::from_fn(|k| if k % 6 < 3 { one.block.corner_mass(0, k / 6) } else { inertia[k / 6] });
    let h = 1e-6;
    let columns: Vec<[f64; 12]> = (0..12)
        .map(|k| {
            let (high, low) = (at(k, h).pulls(), at(k, -h).pulls());
            std::array::from_fn(|i| -(high[i] - low[i]) / (2.0 * h))
        })
        .collect();
    let k = |i: usize, j: usize| 0.5 * (columns[j][i] + columns[i][j]) / (mass[i] * mass[j]).sqrt();
    let matrix = (0..12).map(|i| (0..12).map(|j| k(i, j)).collect()).collect();
    [eigenvalues(matrix).into_iter().fold(0.0, f64::max), 4.0 / one.report.time_step_squared]
}

#[test]
fn the_step_bounds_the_frequency_of_any_beam_and_is_that_of_a_bar() {
    let mut numbers = Spread::new(11);
    let (mut most, mut least) = (0.0f64, f64::INFINITY);
    for case in 0..240 {
        let elastic = material("elastic", numbers.between(0.0, 0.49));
        let scale = 10f64.powf(numbers.between(-1.5, 1.2));
        let profile = &profiles(scale)[case % 6];
        let (start, _) = random(&mut numbers, 1.0, 0.0);
        let [frequency, bound] = frequency_and_bound(&elastic, profile, start, &[0.0; 12]);
        assert!(frequency < 1.00001 * bound, "{case} {profile:?}: {frequency} over {bound}");
        (most, least) = (most.max(frequency / bound), least.min(frequency / bound));
        // 4 E/(ρ L²).
        let (young, density) = (elastic.parameters["young"], elastic.parameters["density"]);
        assert!((bound * density / (4.0 * young) - 1.0).abs() < 1e-9, "{case} {profile:?}: {bound}");
    }
    println!("at rest: true over bound {least} to {most}");
    (most, least) = (0.0, f64::INFINITY);
    for case in 0..240 {
        let rubber = material("neo_hookean", 0.3);
        let profile = &profiles(10f64.powf(numbers.between(-1.0, 0.7)))[case % 6];
        let (start, by) = random(&mut numbers, 1.0, [0.05, 0.15, 0.3][case % 3]);
        let [frequency, bound] = frequency_and_bound(&rubber, profile, start, &by);
        assert!(frequency < 1.001 * bound, "{case} {profile:?}: {frequency} over {bound}");
        (most, least) = (most.max(frequency / bound), least.min(frequency / bound));
    }
    println!("loaded: true over bound {least} to {most}");
}

#[test]
fn fibres_that_flow_have_the_plastic_moment_of_the_section() {
    let mut steel = material("j2", 0.3);
    let strength = 1e-3 * YOUNG;
    steel.parameters.extend([("yield".to_string(), strength), ("hardening".to_string(), 0.0)]);
    let bent = |profile: &Profile, about_z: bool| {
        let start = [[0.0; 3], [1.0, 0.0, 0.0]];
        let mut by = [0.0; 12];
        let axis = if about_z { 2 } else { 1 };
        (by[3 + axis], by[9 + axis]) = (-0.2, 0.2);
        led(&steel, profile, start, &by, 400).moments[0][axis].abs()
    };
    let (width, height) = (0.1, 0.2);
    for (points, tolerance) in [(4, 0.05), (5, 0.06), (6, 0.025), (10, 0.01)] {
        let profile = Profile { points: Some(points), ..rectangle(width, height) };
        for (about_z, modulus) in [(false, 0.25 * width * height * height), (true, 0.25 * height * width * width)] {
            let part = bent(&profile, about_z) / (strength * modulus);
            println!("rectangle, {points} points: {part}");
            assert!((part - 1.0).abs() < tolerance, "{points}: {part}");
        }
    }
    // d³/6; (d³ − d_i³)/6; an I about y: b t_f (h − t_f) + t_w (h − 2 t_f)²/4.
    let tube = Profile { diameter: Some(0.2), thickness: Some(0.02), ..shape("tube") };
    let beam = Profile { width: Some(0.1), height: Some(0.2), web: Some(0.006), flange: Some(0.01), ..shape("i") };
    for (profile, modulus) in [
        (round(0.2), 0.2f64.powi(3) / 6.0),
        (tube, (0.2f64.powi(3) - 0.16f64.powi(3)) / 6.0),
        (beam, 0.1 * 0.01 * 0.19 + 0.006 * 0.18f64.powi(2) / 4.0),
    ] {
        let part = bent(&profile, false) / (strength * modulus);
        println!("{}: {part}", profile.shape);
        assert!((part - 1.0).abs() < 0.05, "{}: {part}", profile.shape);
    }
}

/// A part of beams of the material `soft` along a line.
pub(crate) fn beams(model: &mut Model, name: &str, line: Vec<Vector>, elements: usize, profile: Profile) {
    let shape = Shape::SpaceTruss(SpaceTruss { lines: vec![line], elements });
    let part =
        Part { name: name.into(), material: "soft".into(), element: "beam2".into(), profile: Some(profile), shape, ..Part::default() };
    model.parts.push(part);
}

fn clamp(model: &mut Model, on: &str) {
    let still = || Some(0.0.into());
    let all = || [still(), still(), still()];
    model.constraints.push(Constraint { on: on.into(), velocity: all(), spin: all(), ..Constraint::default() });
}

/// A cantilever along x of a model whose loads grow smoothly until half of the run, with a probe of its end.
fn cantilever(length: f64, elements: usize, profile: Profile, material: Material, [end, damping]: [f64; 2]) -> (Model, Option<String>) {
    let mut model = model(end);
    model.materials.insert("soft".into(), material);
    beams(&mut model, "arm", vec![[0.0; 3], [length, 0.0, 0.0]], elements, profile);
    clamp(&mut model, "arm.point0");
    let shape = CurveShape::Table { times: vec![0.0, 0.5 * end], values: vec![0.0, 1.0], smooth: true };
    model.curves.insert("slowly".into(), Curve::from(shape));
    model.loads.push(Load::Damping { parts: vec![], rate: damping, active: [0.0, f64::INFINITY] });
    model.probes.push(Probe { name: "tip".into(), at: ProbeAt::Set { set: "arm.point1".into() }, ..Probe::default() });
    (model, Some("slowly".into()))
}

fn soft(young: f64, poisson: f64, density: f64) -> Material {
    let mut soft = elastic(young, density);
    soft.parameters.insert("poisson".into(), poisson);
    soft
}

fn tip(simulation: &Simulation) -> Vector {
    ["tip.x", "tip.y", "tip.z"].map(|column| value(simulation, column))
}

#[test]
fn a_cantilever_bends_as_a_beam_with_linear_rotations() {
    // w = P L³/3EI (1 − 1/(4 n²)) + P L/(k G A), about both axes of the section.
    let (length, young, poisson, elements) = (1.0_f64, 2e6, 0.3, 6);
    let (width, height) = (0.04, 0.1);
    let (mut model, curve) = cantilever(length, elements, rectangle(width, height), soft(young, poisson, 10.0), [12.0, 10.0]);
    let force = 1e-3;
    model.loads.push(Load::Force { on: "arm.point1".into(), force: [0.0, force, force], curve });
    let simulation = to_end(&model);
    let [_, y, z] = tip(&simulation);
    for (found, thick, wide) in [(z, height, width), (y, width, height)] {
        let bending = force * length.powi(3) / (3.0 * young * wide * thick.powi(3) / 12.0) * (1.0 - 0.25 / (elements * elements) as f64);
        let shear = force * length / (5.0 / 6.0 * young / (2.0 * (1.0 + poisson)) * width * height);
        println!("{found} for {}", bending + shear);
        assert!((found / (bending + shear) - 1.0).abs() < 1e-3, "{found} for {}", bending + shear);
    }
}

#[test]
fn a_round_bar_is_twisted_by_its_torsion_constant() {
    // θ = T L/(G J): the end of an arm across the end of the bar shows it.
    let (length, young, poisson, diameter) = (1.0_f64, 2e6, 0.3, 0.05_f64);
    let (mut model, curve) = cantilever(length, 4, round(diameter), soft(young, poisson, 10.0), [6.0, 20.0]);
    let lines = vec![vec![[0.0; 3], [length, 0.0, 0.0]], vec![[length, 0.0, 0.0], [length, 0.1, 0.0]]];
    model.parts[0].shape = Shape::SpaceTruss(SpaceTruss { lines, elements: 4 });
    let torque = 0.1;
    model.loads.push(Load::Moment { on: "arm.point1".into(), moment: [torque, 0.0, 0.0], curve });
    model.probes.push(Probe { name: "hand".into(), at: ProbeAt::Set { set: "arm.point2".into() }, ..Probe::default() });
    let simulation = to_end(&model);
    let angle = torque * length / (young / (2.0 * (1.0 + poisson)) * PI * diameter.powi(4) / 32.0);
    let [y, z] = ["hand.y", "hand.z"].map(|column| value(&simulation, column));
    println!("{angle}: {} {}", y / (0.1 * angle.cos()), z / (0.1 * angle.sin()));
    assert!((z / (0.1 * angle.sin()) - 1.0).abs() < 1e-3 && (y / (0.1 * angle.cos()) - 1.0).abs() < 1e-3, "{y} {z} {angle}");
}

#[test]
fn a_beam_with_a_moment_at_its_end_rolls_up_to_a_circle_with_five_elements() {
    // A section that is wide, so that it does not buckle out of the plane.
    let (length, young, side) = (10.0, 1.2e6, 0.1_f64);
    for (elements, axis, section) in [(5, 1, rectangle(1.0, side)), (10, 2, rectangle(side, 1.0))] {
        let (mut model, curve) = cantilever(length, elements, section, soft(young, 0.0, 1.0), [80.0, 1.0]);
        let mut moment = [0.0; 3];
        moment[axis] = TAU * young * side.powi(3) / 12.0 / length;
        model.loads.push(Load::Moment { on: "arm.point1".into(), moment, curve });
        let tip = tip(&to_end(&model));
        println!("{elements}: {tip:?}");
        assert!(largest(&tip) < 0.01, "{elements}: {tip:?}");
    }
}

#[test]
fn a_cantilever_under_a_large_force_is_the_elastica() {
    // Sze, Liu and Lo (2004): u = 3.286, w = 6.698; width 1 m, so that it bends in its weak plane.
    let (mut model, curve) = cantilever(10.0, 10, rectangle(1.0, 0.1), soft(1.2e6, 0.0, 1.0), [50.0, 1.0]);
    model.loads.push(Load::Force { on: "arm.point1".into(), force: [0.0, 0.0, 4.0], curve });
    let [x, y, z] = tip(&to_end(&model));
    println!("u {} w {z}", 10.0 - x);
    assert!(((10.0 - x) / 3.286 - 1.0).abs() < 5e-3 && (z / 6.698 - 1.0).abs() < 5e-3 && y.abs() < 1e-9, "{x} {y} {z}");
}

/// A helix of beams that flies and spins.
fn helix(steps: u64) -> Model {
    let mut model = model(1.0);
    model.materials.insert("soft".into(), soft(200e9, 0.3, 7800.0));
    let at = |k: usize| [0.1 * (0.4 * k as f64).cos(), 0.1 * (0.4 * k as f64).sin(), 0.01 * k as f64];
    beams(&mut model, "helix", (0..=40).map(at).collect(), 1, rectangle(0.006, 0.01));
    let part = &mut model.parts[0];
    (part.velocity, part.spin) = ([3.0, -2.0, 1.0], 200.0);
    model.run.max_steps = Some(steps);
    model
}

#[test]
fn a_helix_that_spins_keeps_its_momenta_and_its_energy() {
    let mut simulation = simulation(&helix(2000));
    simulation.advance(f64::INFINITY, 2000).unwrap();
    let summary = simulation.summary();
    println!("{summary:?}");
    assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-12);
    assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 1e-4);
}

#[test]
fn damping_by_stiffness_takes_what_the_ledger_says_and_a_run_has_equal_bits() {
    let mut model = helix(300);
    model.materials.insert("soft".into(), material("j2", 0.3));
    model.parts[0].spin = 3.0;
    model.loads.push(Load::StiffnessDamping { parts: vec![], time: 2e-4 });
    model.run.end = 0.02;
    let simulation = to_end(&model);
    let summary = simulation.summary();
    println!("{summary:?}");
    assert!(summary.ledger_residual < 1e-12, "{}", summary.ledger_residual);
    hash_of_equal_bits(&model, &[2, 3], "helix");
}

#[test]
fn forces_moments_and_stress_are_those_of_the_motion() {
    // Along y: the section's z is z, its y is −x.
    let (steel, profile, small) = (material("elastic", 0.3), rectangle(0.1, 0.2), 1e-6);
    let shear = YOUNG / 2.6;
    let by = [0.0, 0.0, 0.0, small, -small, 0.0, 0.0, 2.0 * small, small, -small, small, 0.0];
    let one = led(&steel, &profile, [[0.0; 3], [0.0, 1.0, 0.0]], &by, 1);
    let state = one.block.state(0);
    let (area, inertia) = (0.02, 0.1 * 0.2f64.powi(3) / 12.0);
    // Node 2 rises by one, and the section is as it was in the middle.
    let expected = [2.0 * YOUNG * area, 0.0, 5.0 / 6.0 * shear * area, 0.228_682 * 0.2 * 1e-3 * 2.0 * shear, 2.0 * YOUNG * inertia, 0.0];
    for (k, value) in expected.into_iter().enumerate() {
        assert!((state.shell[k] / small - value).abs() < 1e-4 * YOUNG * 1e-3, "{k}: {} for {value}", state.shell[k] / small);
    }
    // The last of four Gauss' points, 0.861 of the half height.
    let worst = 2.0 * YOUNG * (1.0 + 0.086_113_6);
    assert!((state.stress[1] / small / worst - 1.0).abs() < 1e-5 && state.stress[0].abs() < 1e-5 * state.stress[1], "{:?}", state.stress);
    let energy = 0.5 * expected[0] * 2.0 + 0.5 * expected[2] + 0.5 * expected[3] * 2.0 + 0.5 * expected[4] * 2.0;
    assert!((one.report.stored / (small * small) / energy - 1.0).abs() < 1e-4, "{} {energy}", one.report.stored);
}

#[test]
fn a_beam_that_breaks_leaves_the_ledger_closed() {
    let mut model = helix(4000);
    let mut brittle = material("j2", 0.3);
    brittle.failure.insert("plastic_strain".into(), 0.01);
    model.materials.insert("soft".into(), brittle);
    model.parts[0].spin = 60.0;
    let simulation = to_end(&model);
    let summary = simulation.summary();
    println!("{:?} {:e}", summary.erosion, summary.ledger_residual);
    assert!(summary.erosion.is_some() && summary.ledger_residual < 1e-12);
    assert!(summary.momentum_drift_angular.unwrap() < 1e-12);
}

#[test]
fn what_makes_no_sense_of_beams_is_told() {
    let told = |change: &dyn Fn(&mut Model), words: &[&str]| {
        let mut model = helix(10);
        change(&mut model);
        let all = faults(&model).join("\n");
        assert!(!all.is_empty() && words.iter().all(|word| all.contains(word)), "{words:?} in\n{all}");
    };
    told(&|model| model.parts[0].profile = None, &["need their cross-section"]);
    told(&|model| model.parts[0].profile.as_mut().unwrap().height = None, &["needs `width`, `height`"]);
    told(&|model| model.parts[0].profile.as_mut().unwrap().web = Some(1e-3), &["has no `web`"]);
    told(&|model| model.parts[0].profile.as_mut().unwrap().points = Some(1), &["2 to 10 points"]);
    let thick = Profile { diameter: Some(0.1), thickness: Some(0.06), ..shape("tube") };
    told(&|model| model.parts[0].profile = Some(thick.clone()), &["more than the radius"]);
    told(&|model| model.parts[0].element = "bar2".into(), &["`profile` is the cross-section of beams", "bars need"]);
    told(&|model| model.parts[0].area = Some(1.0), &["`area` is the cross-section of bars"]);
    told(
        &|model| {
            model.materials.insert("soft".into(), material("orthotropic_elastic", 0.3));
        },
        &["differently in different directions"],
    );
    told(&|model| model.run.stable_step = StableStep::Assembled, &["knows no rotations"]);
    told(
        &|model| {
            let truss = embate_solver::model::Truss { lines: vec![vec![[0.0; 2], [1.0, 0.0]]], elements: 2 };
            model.parts[0].shape = Shape::Truss(truss);
        },
        &["`shell2`, which in plane stress is a beam"],
    );
    told(
        &|model| {
            model.parts[0].profile = profiles(0.1).pop();
            model.contacts.push(embate_solver::model::Contact::between("self", "helix", "helix"));
        },
        &["made of beams with a `given` section, which have no surface"],
    );
    told(
        &|model| {
            let shape = Shape::SpaceTruss(SpaceTruss { lines: vec![vec![[0.0; 3], [0.0, 0.0, 1.0]]], elements: 1 });
            model.parts[0].shape = shape;
            model.parts[0].profile.as_mut().unwrap().up = Some([0.0, 0.0, 2.0]);
        },
        &["goes along it"],
    );
}
