//! The stable step by nodes: a bound of the true frequencies of assembled meshes, found by differences of
//! forces and all eigenvalues; never shorter than the step by elements; stable in runs.

use crate::bodies::*;
use crate::long::samples;
use crate::patches::{Body, Patch, Spread, eigenvalues, every_pair, frequency_squared, material, patch, stiffness};
use crate::{blocks, patches, solids};
use embate_solver::block::{BlockInput, Blocks};
use embate_solver::element::{ELEMENTS, ELEMENTS_OF_SPACE};
use embate_solver::model::*;
use embate_solver::simulation::{Options, Simulation};
use embate_solver::stress_state::STRESS_STATES;
use embate_solver::tensor::Dim;

/// Square of the largest frequency by nodes: Σ k_e over the whole mass of the node.
fn bound<const D: usize>(body: &Body<D>) -> f64
where
    Dim<D>: Blocks<D>,
{
    let mut sums = vec![0.0; body.positions.len()];
    body.block.bound_stiffness(body.report.time_step_squared.sqrt(), &mut |node, stiffness, _| sums[node as usize] += stiffness);
    sums.iter().zip(body.masses()).map(|(stiffness, mass)| stiffness / mass).fold(0.0, f64::max)
}

/// True ω² over the bound by nodes, and dt² by nodes over that by elements.
fn ratios<const D: usize>(make_body: impl Fn() -> Body<D>) -> [f64; 2]
where
    Dim<D>: Blocks<D>,
{
    let body = make_body();
    let bound = bound(&body);
    [frequency_squared(&stiffness(&make_body), &body.masses()) / bound, 4.0 / (bound * body.report.time_step_squared)]
}

/// Moves all nodes, those of the rim too.
fn shake<const D: usize>(patch: &mut Patch<D>, size: f64, numbers: &mut Spread) {
    patch.positions.iter_mut().flatten().for_each(|x| *x += size * numbers.between(-1.0, 1.0));
}

/// Prints and checks ratios of patches.
fn checked(what: &str, ratios: &[[f64; 2]], most: f64) {
    let worst = ratios.iter().fold(0.0, |worst, ratio| f64::max(worst, ratio[0]));
    let gain = ratios.iter().map(|ratio| ratio[1].sqrt()).sum::<f64>() / ratios.len() as f64;
    let least = ratios.iter().fold(f64::INFINITY, |least, ratio| f64::min(least, ratio[1]));
    println!("{what:<45} worst ω²/bound = {worst:.4}, step by nodes over that by elements {gain:.3}");
    assert!(worst < most, "{what}: {worst}");
    assert!(least > 1.0 - 1e-12, "{what}: the step by nodes is shorter, {least}");
}

#[test]
fn no_element_is_stiffer_than_what_it_hands_over() {
    for kind in ELEMENTS {
        let mut numbers = Spread::new(21);
        for round in 0..200 {
            let material = material("elastic", [-0.5, 0.0, 0.3, 0.499][round % 4]);
            let x = patches::distorted(kind.name, 0.9, 20.0, &mut numbers);
            let body = Body::single(kind.name, &material, &x);
            let mut handed = 0.0;
            body.block.bound_stiffness(body.report.time_step_squared.sqrt(), &mut |_, stiffness, _| handed = stiffness);
            let true_one = eigenvalues(stiffness(|| Body::single(kind.name, &material, &x))).pop().unwrap();
            assert!(true_one < handed * (1.0 + 1e-5), "{}: {true_one} {handed}", kind.name);
        }
    }
}

#[test]
fn the_step_by_nodes_bounds_the_frequencies_of_random_patches() {
    for kind in ELEMENTS {
        let mut numbers = Spread::new(22);
        let all: Vec<_> = (0..samples(110) as usize)
            .map(|round| {
                let material = material("elastic", [-0.5, 0.0, 0.3, 0.45, 0.499][round % 5]);
                let mut patch = patch(kind.name, 2 + round % 2, 0.1);
                shake(&mut patch, numbers.between(0.0, 0.18) * patches::room(kind.name), &mut numbers);
                let stretch = numbers.between(0.2, 1.0);
                patch.positions.iter_mut().for_each(|x| x[1] *= stretch);
                ratios(|| Body::of(kind.name, &material, &patch))
            })
            .collect();
        checked(kind.name, &all, 1.0 + 1e-5);
    }
    for kind in ELEMENTS_OF_SPACE {
        let mut numbers = Spread::new(23);
        let all: Vec<_> = (0..samples(40) as usize)
            .map(|round| {
                let material = material("elastic", [-0.5, 0.0, 0.3, 0.45, 0.499][round % 5]);
                let mut patch = solids::patch(kind.name, 2, 0.1);
                shake(&mut patch, numbers.between(0.0, 0.12), &mut numbers);
                ratios(|| Body::of(kind.name, &material, &patch))
            })
            .collect();
        checked(kind.name, &all, 1.0 + 1e-5);
    }
}

#[test]
fn the_step_by_nodes_bounds_the_frequencies_of_every_law_and_stress_state() {
    every_pair(|element, law| {
        for state in STRESS_STATES {
            let all: Vec<_> = (0..4)
                .map(|round| {
                    let material = material(law, [0.0, 0.3, 0.49][round % 3]);
                    let mut patch = patch(element, 2, 0.2);
                    patch.positions.iter_mut().for_each(|x| x[0] += [0.3, 3.0][round % 2]);
                    let input = || BlockInput {
                        stress_state: state.name,
                        ..BlockInput::new(element, &material, &patch.connectivity, &patch.positions)
                    };
                    ratios(|| Body::made(&input()))
                })
                .collect();
            checked(&format!("{element} {law} {}", state.name), &all, 1.0 + 1e-5);
        }
    });
    patches::every_pair_of(ELEMENTS_OF_SPACE, |element, law| {
        let patch = solids::patch(element, 1, 0.0);
        let all = [0.0, 0.3, 0.49].map(|poisson| ratios(|| Body::of(element, &material(law, poisson), &patch)));
        checked(&format!("{element} {law}"), &all, 1.0 + 1e-5);
    });
}

#[test]
fn the_step_by_nodes_bounds_the_frequencies_of_strained_patches() {
    every_pair(|element, law| {
        let mut numbers = Spread::new(24);
        let all: Vec<_> = (0..8)
            .map(|round| {
                let material = material(law, [-0.5, 0.0, 0.3, 0.499][round % 4]);
                let (f, stretch) = (blocks::near_one(0.3, &mut numbers), numbers.between(0.2, 1.0));
                let mut patch = patch(element, 3, 0.2);
                patch.positions.iter_mut().for_each(|x| x[1] *= stretch);
                ratios(|| {
                    let mut body = Body::of(element, &material, &patch);
                    body.map(|x| blocks::apply(&f, x));
                    body
                })
            })
            .collect();
        checked(&format!("{element} {law}, strained"), &all, 1.0);
    });
    patches::every_pair_of(ELEMENTS_OF_SPACE, |element, law| {
        let mut numbers = Spread::new(25);
        let all: Vec<_> = (0..2)
            .map(|round| {
                let material = material(law, [0.0, 0.499][round]);
                let f = solids::near_one(0.2, &mut numbers);
                let patch = solids::patch(element, 2, 0.2);
                ratios(|| {
                    let mut body = Body::of(element, &material, &patch);
                    body.map(|x| solids::apply(&f, x));
                    body
                })
            })
            .collect();
        checked(&format!("{element} {law}, strained"), &all, 1.0);
    });
}

#[test]
fn what_elements_report_since_they_were_marked_bounds_the_sums_that_were_not_made_again() {
    for (damping, viscosity) in [(0.0, None), (1e-3, None), (0.0, Some([0.06, 1.2])), (2e-2, Some([0.1, 1.5]))] {
        for kind in ELEMENTS {
            let mut numbers = Spread::new(26);
            let (material, patch) = (material("elastic", 0.3), patch(kind.name, 4, 0.2));
            let input = BlockInput { damping, viscosity, ..BlockInput::new(kind.name, &material, &patch.connectivity, &patch.positions) };
            let mut body = Body::made(&input);
            assert_eq!(body.report.step_change, f64::INFINITY);
            let then = bound(&body);
            body.block.mark_time_steps();
            for _ in 0..20 {
                let to: Vec<_> = body.positions.iter().map(|x| x.map(|x| x + 0.02 * numbers.between(-1.0, 1.0))).collect();
                body.move_to(&to);
                let (now, change) = (bound(&body), body.report.step_change);
                assert!(change < 1.5 && now <= then / change * (1.0 + 1e-12), "{}: {now} {then} {change}", kind.name);
            }
        }
    }
}

/// A block whose inner nodes lie anywhere.
pub(crate) fn crooked(end: f64, stable_step: StableStep) -> Model {
    let mut model = model(end);
    let mesh = mapped([12, 12], |u, v| {
        let is_inner = |c: f64| c > 1e-9 && c < 1.0 - 1e-9;
        let size = if is_inner(u) && is_inner(v) { 0.03 } else { 0.0 };
        [u + size * (700.0 * u + 910.0 * v).sin(), v + size * (570.0 * u - 230.0 * v).cos()]
    });
    add_mesh(&mut model, "block", mesh, [0.0; 2]);
    model.parts[0].spin = 3.0;
    (model.run.stable_step, model.run.safety) = (stable_step, 1.0);
    model
}

#[test]
fn a_free_body_keeps_its_energy_with_all_of_the_step_by_nodes_in_fewer_steps() {
    for element in ["quad4", "quad4_reduced", "quad4_reduced_assumed_strain"] {
        let with = |stable_step| {
            let mut model = crooked(0.05, stable_step);
            model.parts[0].element = element.into();
            let run = to_end(&model);
            (run.steps(), run.summary())
        };
        let ((many, by_elements), (few, by_nodes)) = (with(StableStep::Elements), with(StableStep::Nodes));
        println!("{element}: {many} steps by elements, {few} by nodes; drift {:e} {:e}", by_elements.energy_drift, by_nodes.energy_drift);
        assert!(few < many * 97 / 100, "{element}: {many} {few}");
        assert!(by_nodes.energy_drift.abs() < 1e-3, "{element}: {}", by_nodes.energy_drift);
        assert!(by_elements.stable_time_step_governor.starts_with("element "), "{}", by_elements.stable_time_step_governor);
        assert!(by_nodes.stable_time_step_governor.starts_with("the elements at node "), "{}", by_nodes.stable_time_step_governor);
    }
}

#[test]
fn steps_by_nodes_have_the_same_bits_for_any_threads_and_instruction_set() {
    let model = crooked(0.004, StableStep::Nodes);
    let hash = hash_of_equal_bits(&model, &[1, 2, 3], "crooked");
    let whole = crooked(0.004, StableStep::Elements);
    assert_ne!(hash, hash_of_equal_bits(&whole, &[1], "by elements"));
}

#[test]
fn a_body_that_is_crushed_has_shorter_steps_by_nodes_too_before_it_is_unstable() {
    let mut model = crooked(0.0, StableStep::Nodes);
    model.run.safety = 0.9;
    model.run.end = 8e-3;
    model.parts[0].spin = 0.0;
    model.parts[0].velocity = [0.0, -150.0, 0.0];
    model.obstacles.push(Obstacle::wall("floor", [0.0, 0.0], [0.0, 1.0]));
    let mut run = Simulation::new(&model, &Options { threads: 1, simd: None }).unwrap();
    let first = run.overview().stable_time_step;
    run.advance(f64::INFINITY, u64::MAX).unwrap();
    let shortest = run.summary().stable_time_step_min;
    println!("{first} {shortest}, drift {}", run.summary().energy_drift);
    assert!(shortest < 0.97 * first, "{shortest} {first}");
    assert!(run.summary().energy_drift.abs() < 0.01, "{}", run.summary().energy_drift);
}

#[test]
fn costs_of_the_step_are_those_of_the_worst_elements_and_what_is_left_without_them() {
    let model = crooked(0.01, StableStep::Elements);
    let run = Simulation::new(&model, &Options { threads: 1, simd: None }).unwrap();
    let costs = run.time_step_costs(20);
    assert_eq!(costs.elements.len(), 20);
    assert_eq!(costs.elements[0].time_step, run.overview().stable_time_step);
    for pair in costs.elements.windows(2) {
        assert!(pair[0].time_step <= pair[1].time_step && pair[0].without == pair[1].time_step);
    }
    assert_eq!(run.time_step_costs(1000).elements.len(), 144);
    assert_eq!(run.time_step_costs(1000).elements[143].without, f64::INFINITY);
    // The same that the run takes.
    let (by_nodes, governor) = costs.by_nodes.unwrap();
    let nodes = Simulation::new(&crooked(0.01, StableStep::Nodes), &Options { threads: 1, simd: None }).unwrap().overview();
    assert_eq!((by_nodes, governor), (nodes.stable_time_step, nodes.governor));
}
