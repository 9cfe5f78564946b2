//! What every registered element with every registered law promises: constant strain, rigid motion,
//! stiffness, masses, energy, the stable step, and the same bits on every instruction set.

use crate::long::samples;
use crate::patches::*;
use embate_lanes::{Level, Team};
use embate_solver::element::ELEMENTS;
use embate_solver::material::LAWS;
use embate_solver::material::variable::PLASTIC_STRAIN;

type Gradient = [[f64; 2]; 2];

pub(crate) fn apply(g: &Gradient, x: [f64; 2]) -> [f64; 2] {
    [g[0][0] * x[0] + g[0][1] * x[1], g[1][0] * x[0] + g[1][1] * x[1]]
}

/// Unit tensor plus a random tensor of this size.
pub(crate) fn near_one(size: f64, numbers: &mut Spread) -> Gradient {
    let (a, b) = (numbers.vector(size), numbers.vector(size));
    [[1.0 + a[0], a[1]], [b[0], 1.0 + b[1]]]
}

pub(crate) fn largest<'a>(values: impl IntoIterator<Item = &'a f64>) -> f64 {
    values.into_iter().fold(0.0, |largest, value| largest.max(value.abs()))
}

#[test]
fn a_distorted_patch_in_uniform_strain_has_uniform_stress_and_no_force_on_inner_nodes() {
    every_pair(|element, law| {
        let patch = patch(element, 4, 0.25);
        let mut body = Body::of(element, &material(law, 0.3), &patch);
        let mut numbers = Spread::new(11);
        for step in 0..20 {
            let (f, shift) = (near_one(0.02, &mut numbers), numbers.vector(1.0));
            body.map(|x| {
                let y = apply(&f, x);
                [y[0] + shift[0], y[1] + shift[1]]
            });
            let first = body.block.state(0).stress;
            let size = largest(&first);
            assert!(size > 1e-4 * YOUNG, "{element} {law}: there is stress");
            for k in 1..body.block.elements() {
                let stress = body.block.state(k).stress;
                assert!((0..6).all(|c| (stress[c] - first[c]).abs() < 1e-12 * YOUNG), "{element} {law} step {step}: {stress:?} {first:?}");
            }
            let forces = body.forces();
            let (outer, inner) = (largest(forces.iter().flatten()), largest(patch.inner.iter().flat_map(|&node| &forces[node])));
            assert!(outer > 0.1 * size && inner < 1e-11 * YOUNG, "{element} {law} step {step}: {inner} of {outer}");
        }
    });
}

/// A patch that has been brought under stress (below yield where there is one).
fn prestressed(element: &str, law: &str) -> Body {
    let mut body = Body::of(element, &material(law, 0.3), &patch(element, 3, 0.2));
    for _ in 0..10 {
        body.map(|[x, y]| [x * 1.0003 + 0.0002 * y, y * 0.9998 + 1e-5 * x * y]);
    }
    body.map(|x| x); // dampers of hourglass control come to rest
    body
}

#[test]
fn a_rigid_translation_changes_no_force() {
    every_pair(|element, law| {
        let mut body = prestressed(element, law);
        let before = body.forces();
        assert!(largest(before.iter().flatten()) > 1e-3 * YOUNG);
        for _ in 0..10 {
            body.map(|[x, y]| [x + 3.0, y - 2.0]);
        }
        for (a, b) in body.forces().iter().zip(&before) {
            assert!((0..2).all(|d| (a[d] - b[d]).abs() < 1e-11 * YOUNG), "{element} {law}");
        }
    });
}

#[test]
fn stress_and_forces_turn_with_the_body() {
    const STEPS: u32 = 360;
    every_pair(|element, law| {
        let mut body = prestressed(element, law);
        let (start, forces, energy) = (body.block.state(0).stress, body.forces(), body.energy());
        let positions = body.positions.clone();
        for step in 1..=STEPS {
            let (s, c) = (std::f64::consts::TAU * f64::from(step) / f64::from(STEPS)).sin_cos();
            let turned = |[x, y]: [f64; 2]| [c * x - s * y, s * x + c * y];
            body.move_to(&positions.iter().map(|&x| turned(x)).collect::<Vec<_>>());
            let [xx, yy, zz, xy, ..] = start;
            let expected = [
                c * c * xx + s * s * yy - 2.0 * c * s * xy,
                s * s * xx + c * c * yy + 2.0 * c * s * xy,
                zz,
                c * s * (xx - yy) + (c * c - s * s) * xy,
            ];
            let stress = body.block.state(0).stress;
            assert!((0..4).all(|k| (stress[k] - expected[k]).abs() < 1e-8 * YOUNG), "{element} {law} step {step}: {stress:?} {expected:?}");
            for (f, &f0) in body.forces().iter().zip(&forces) {
                assert!((0..2).all(|d| (f[d] - turned(f0)[d]).abs() < 1e-8 * YOUNG), "{element} {law} step {step}");
            }
        }
        assert!((body.energy() - energy).abs() < 1e-9 * energy, "{element} {law}");
    });
}

#[test]
fn a_body_without_stress_turns_without_force() {
    every_pair(|element, law| {
        let mut body = Body::of(element, &material(law, 0.3), &patch(element, 3, 0.2));
        let (s, c) = 0.3f64.sin_cos();
        for _ in 0..50 {
            body.map(|[x, y]| [c * x - s * y + 0.1, s * x + c * y]);
            assert!(largest(body.forces().iter().flatten()) < 1e-11 * YOUNG, "{element} {law}");
        }
    });
}

#[test]
fn the_stiffness_is_symmetric_and_only_rigid_modes_cost_nothing() {
    every_pair(|element, law| {
        let mut numbers = Spread::new(12);
        for _ in 0..5 {
            let x = distorted(element, 0.7, 3.0, &mut numbers);
            let k = stiffness(|| Body::single(element, &material(law, 0.3), &x));
            let n = k.len();
            let size = largest(k.iter().flatten());
            let skew = (0..n * n).map(|at| (k[at / n][at % n] - k[at % n][at / n]).abs()).fold(0.0, f64::max);
            assert!(skew < 1e-6 * size, "{element} {law}: skew part {skew} of {size}");
            let values = eigenvalues(k);
            assert!(values[..3].iter().all(|v| v.abs() < 1e-6 * size), "{element} {law}: {values:?}");
            // The hold of the volumes of points is a tenth of the shear modulus.
            let least = if element == "tri6" { 1e-4 } else { 1e-3 };
            assert!(values[3] > least * size, "{element} {law}: {values:?}");
        }
    });
}

#[test]
fn corner_masses_are_positive_and_have_the_mass_and_its_centre() {
    for kind in ELEMENTS {
        let mut numbers = Spread::new(13);
        for _ in 0..100 {
            let x = distorted(kind.name, 0.9, 20.0, &mut numbers);
            let body = Body::single(kind.name, &material(LAWS[0].name, 0.3), &x);
            let outline = around(&x);
            let expected = DENSITY * shoelace(&outline);
            assert!((body.masses().iter().sum::<f64>() / expected - 1.0).abs() < 1e-13, "{}", kind.name);
            assert!((body.block.mass(0) / expected - 1.0).abs() < 1e-13, "{}", kind.name);
            for (d, place) in centroid(&outline).into_iter().enumerate() {
                let moment: f64 = body.masses().iter().zip(&x).map(|(m, x)| m * x[d]).sum();
                assert!((moment / expected - place).abs() < 1e-12, "{}: row sums keep the centre", kind.name);
            }
            assert!(body.masses().iter().all(|&m| m > 0.1 * expected / kind.nodes() as f64));
        }
    }
}

#[test]
fn corner_forces_do_the_work_that_the_energy_reports() {
    // −f·u = dU for any small motion u from a state of uneven stress; this is what the force part of the mean
    // dilatation is for. The force is the mean over the motion: a law that yields with the rate, or with
    // the heat of the step before, has another force after the smallest motion.
    every_pair(|element, law| {
        if is_damped(element) {
            return;
        }
        let patch = patch(element, 3, 0.25);
        let mut numbers = Spread::new(14);
        let bumps: Vec<_> = patch.positions.iter().map(|_| numbers.vector(0.01)).collect();
        let directions: Vec<_> = patch.positions.iter().map(|_| numbers.vector(1.0)).collect();
        let moved = |by: &[[f64; 2]], size: f64, from: &[[f64; 2]]| -> Vec<[f64; 2]> {
            from.iter().zip(by).map(|(x, u)| [x[0] + size * u[0], x[1] + size * u[1]]).collect()
        };
        let stressed = || {
            let mut body = Body::of(element, &material(law, 0.3), &patch);
            for step in 1..=5 {
                body.move_to(&moved(&bumps, f64::from(step), &patch.positions));
            }
            body
        };
        let power = |body: &Body| body.forces().iter().zip(&directions).map(|(f, u)| f[0] * u[0] + f[1] * u[1]).sum::<f64>();
        let change = |h: f64| {
            let mut body = stressed();
            let to = moved(&directions, h, &body.positions);
            body.move_to(&to);
            (body.energy(), power(&body))
        };
        let h = 1e-6;
        let ((energy_after, power_after), (energy_before, power_before)) = (change(h), change(-h));
        let slope = (energy_after - energy_before) / (2.0 * h);
        let power = 0.5 * power(&stressed()) + 0.25 * (power_after + power_before);
        // A law with a flow rule is not smooth, but its stress power is.
        assert!((slope + power).abs() < 1e-5 * power.abs().max(YOUNG * 0.01), "{element} {law}: {slope} against {}", -power);
    });
}

/// Largest ω² dt²/4 over random elements; `later` moves the element from its initial form, in which it got
/// its masses.
fn worst_step(element: &str, law: &str, roughness: f64, later: impl Fn(&[[f64; 2]], &mut Spread) -> Vec<[f64; 2]>) -> f64 {
    let mut numbers = Spread::new(15);
    let mut worst = 0.0f64;
    for round in 0..samples(150) as usize {
        let material = material(law, [-0.5, 0.0, 0.3, 0.499][round % 4]);
        let x = distorted(element, roughness, 20.0, &mut numbers);
        let y = later(&x, &mut numbers);
        let make_body = || {
            let mut body = Body::single(element, &material, &x);
            body.move_to(&y);
            body
        };
        let body = make_body();
        let ratio = frequency_squared(&stiffness(make_body), &body.masses()) * body.block.time_step_squared(0) / 4.0;
        assert_eq!(body.block.time_step_squared(0), body.report.time_step_squared);
        worst = worst.max(ratio);
    }
    worst
}

#[test]
fn the_stable_step_bounds_the_largest_frequency() {
    every_pair(|element, law| {
        for (roughness, name) in [(0.0, "parallelograms"), (0.3, "moderate"), (0.95, "extreme")] {
            let worst = worst_step(element, law, roughness, |x, _| x.to_vec());
            println!("{element:<11} {law:<12} {name:<15} worst ω² dt²/4 = {worst:.4}");
            assert!(worst < 1.0 + 1e-5, "{element} {law} {name}: {worst}");
            // Where only the speed of waves is known, the trace counts for what is stiffest in shear.
            let least = if element == "tri6" && law == "neo_hookean" { 0.85 } else { 0.9 };
            assert!(worst > least || roughness > 0.0, "{element} {law} {name}: {worst} wastes steps");
        }
        // Under large strain the stress itself is stiff: what it adds to a single element mostly cancels
        // between neighbours (next test), and the default safety of 0.9 covers a ratio of 1.23.
        let worst = worst_step(element, law, 0.5, |x, numbers| {
            let f = near_one(0.3, numbers);
            x.iter().map(|&x| apply(&f, x)).collect()
        });
        println!("{element:<11} {law:<12} strained        worst ω² dt²/4 = {worst:.4}");
        assert!(worst < 1.2, "{element} {law} strained: {worst}");
    });
}

#[test]
fn the_stable_step_bounds_the_frequencies_of_a_strained_body() {
    every_pair(|element, law| {
        let mut numbers = Spread::new(18);
        let mut worst = 0.0f64;
        for round in 0..24 {
            let material = material(law, [-0.5, 0.0, 0.3, 0.499][round % 4]);
            let (f, stretch) = (near_one(0.3, &mut numbers), numbers.between(0.2, 1.0));
            let mut patch = patch(element, 3, 0.2);
            patch.positions.iter_mut().for_each(|x| x[1] *= stretch);
            let make_body = || {
                let mut body = Body::of(element, &material, &patch);
                body.map(|x| apply(&f, x));
                body
            };
            let body = make_body();
            worst = worst.max(frequency_squared(&stiffness(make_body), &body.masses()) * body.report.time_step_squared / 4.0);
        }
        println!("{element:<11} {law:<12} worst ω² dt²/4 = {worst:.4}");
        assert!(worst < 1.0, "{element} {law}: {worst}");
    });
}

#[test]
fn the_stable_step_holds_when_an_element_takes_another_form_than_its_masses() {
    for kind in ELEMENTS {
        let mut numbers = Spread::new(16);
        let material = material("elastic", 0.3);
        let mut worst = 0.0f64;
        for _ in 0..300 {
            let (x, y) = (distorted(kind.name, 0.95, 5.0, &mut numbers), distorted(kind.name, 0.95, 5.0, &mut numbers));
            let masses: Vec<f64> = Body::single(kind.name, &material, &x).masses();
            let mut body = Body::single(kind.name, &material, &x);
            body.move_to(&y);
            // The stiffness of the new form without the stress that the way there has left.
            let k = stiffness(|| Body::single(kind.name, &material, &y));
            worst = worst.max(frequency_squared(&k, &masses) * body.block.time_step_squared(0) / 4.0);
        }
        println!("{}: {worst:.4}", kind.name);
        assert!(worst < 1.0 + 1e-5, "{}: {worst}", kind.name);
    }
}

/// Everything that a block reports, as bits.
fn bits(body: &Body) -> Vec<u64> {
    let report =
        [body.report.time_step_squared, body.report.determinant, body.report.stored, body.report.dissipated, body.report.hourglass];
    let state = |k: usize| {
        let state = body.block.state(k);
        state.stress.into_iter().chain(state.variables).chain([state.energy_density, body.block.time_step_squared(k)])
    };
    let states = (0..body.block.elements()).flat_map(state);
    let forces = body.slots.iter().flatten().copied();
    report.into_iter().chain(states).chain(forces).map(f64::to_bits).collect()
}

#[test]
fn every_instruction_set_and_any_threads_give_the_same_bits() {
    every_pair(|element, law| {
        // 625 elements: more than one chunk, and a batch that is not full.
        let patch = patch(element, 25, 0.2);
        let run = |level: Level, threads: usize| {
            let mut body = Body::of(element, &material(law, 0.3), &patch);
            (body.level, body.team) = (level, Team::new(threads));
            let mut numbers = Spread::new(17);
            for _ in 0..10 {
                let (f, size) = (near_one(0.01, &mut numbers), 0.004);
                let to: Vec<_> = body.positions.iter().map(|&x| (apply(&f, x), numbers.vector(size))).collect();
                body.move_to(&to.iter().map(|(x, u)| [x[0] + u[0], x[1] + u[1]]).collect::<Vec<_>>());
            }
            assert!(body.block.state(0).stress[0] != 0.0 && (!body.block.has(&PLASTIC_STRAIN) || body.report.dissipated > 0.0));
            bits(&body)
        };
        let reference = run(Level::SCALAR, 1);
        for level in Level::available() {
            for threads in [1, 3] {
                assert!(run(level, threads) == reference, "{element} {law} {}, {threads} threads", level.name());
            }
        }
    });
}

#[test]
fn a_block_pulls_without_its_eroded_elements_even_where_a_chunk_has_none_left() {
    const OF_A_CHUNK: u32 = 512;
    every_pair(|element, law| {
        let patch = patch(element, 25, 0.2);
        let mut body = Body::of(element, &material(law, 0.3), &patch);
        body.block.keep_forces();
        let to: Vec<_> = patch.positions.iter().map(|&[x, y]| [1.001 * x + 0.002 * y, 0.999 * y]).collect();
        body.move_to(&to);
        let count = body.block.elements() as u32;
        let gone: Vec<u32> = (0..OF_A_CHUNK).chain([OF_A_CHUNK + 1, OF_A_CHUNK + 40, count - 1]).collect();
        // Those that stay, one by one.
        let nodes = nodes_of(element);
        let (mut expected, mut has_elements) = (vec![[0.0; 2]; to.len()], vec![false; to.len()]);
        let stays = |element: &u32| !gone.contains(element);
        for k in (0..count).filter(stays) {
            for (corner, &node) in patch.connectivity[k as usize * nodes..][..nodes].iter().enumerate() {
                let force = body.block.force(k as usize, corner, &body.slots);
                (0..2).for_each(|d| expected[node as usize][d] += force[d]);
                has_elements[node as usize] = true;
            }
        }
        let size = expected.iter().flatten().fold(0.0f64, |size, f| size.max(f.abs()));
        assert!(size > 0.0);
        let differs = |forces: &[[f64; 2]]| {
            forces.iter().flatten().zip(expected.iter().flatten()).fold(0.0f64, |worst, (a, b)| worst.max((a - b).abs())) / size
        };
        body.block.erode(&gone, embate_solver::block::NodalForces::new(&mut body.slots));
        let at_once = differs(&body.forces());
        assert!(at_once < 1e-13, "{element} {law}: {at_once}");
        // Averages over nodes change with the elements, rates with the step; but nothing pulls where nothing
        // is left.
        body.move_to(&to);
        let forces = body.forces();
        let mut lonely = (0..to.len()).filter(|&node| !has_elements[node]);
        assert!(lonely.clone().count() > 200 && lonely.all(|node| forces[node] == [0.0; 2]), "{element} {law}");
        assert!(body.report.determinant > 0.0 && body.report.time_step_squared.is_finite() && body.report.stored.is_finite());
    });
}
