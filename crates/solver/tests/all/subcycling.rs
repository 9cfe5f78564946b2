//! Subcycling: energy over long runs, momentum to round-off, results beside those of runs without it, and
//! equal bits.

use crate::bodies::*;
use crate::erosion::torn_bar;
use crate::long::is_long;
use crate::patches::Spread;
use embate_solver::model::*;
use embate_solver::simulation::Simulation;

/// A strip of columns of quadrilaterals: wide ones, narrow ones in the middle, wide ones. The wide columns
/// from the third on are parts of their own, which share nodes with the rest: chunks of their own.
fn strip(ratio: f64, [wide, narrow, rows]: [usize; 3], shift: f64) -> Model {
    let mut numbers = Spread::new(41);
    let widths: Vec<f64> = [vec![1.0; wide], vec![1.0 / ratio; narrow], vec![1.0; wide]].concat();
    let at = |i: usize, j: usize| (j * (widths.len() + 1) + i) as u32;
    let mut positions = Vec::new();
    for j in 0..=rows {
        for i in 0..=widths.len() {
            let x: f64 = widths[..i].iter().sum();
            let size = shift / if (wide..=wide + narrow).contains(&i) { ratio } else { 1.0 };
            positions.push([x + size * numbers.between(-1.0, 1.0), j as f64 + shift * numbers.between(-1.0, 1.0), 0.0]);
        }
    }
    let cells = |from: usize, to: usize| {
        let cell = move |i: usize, j: usize| vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        (0..rows).flat_map(move |j| (from..to).map(move |i| cell(i, j))).collect::<Vec<_>>()
    };
    let (first, last) = (wide - 2, wide + narrow + 2);
    let groups = [("left", 0, first), ("middle", first, last), ("right", last, widths.len())];
    let groups = groups.map(|(name, from, to)| group(name, 2, cells(from, to).into_iter())).into();
    let mut model = model(1e6);
    add_groups(
        &mut model,
        ImportedMesh { source: "test".into(), positions, groups, ..ImportedMesh::default() },
        &["left", "middle", "right"],
        [0.0; 2],
    );
    model.run.subcycling = true;
    model
}

/// A chain of springs and masses, the springs between x and x + 1 with the stiffness 1/h and the mass h of an
/// elastic bar: `slow` elements of the length 2 `ratio`, 30 of length 1, `slow` ones. All but `layers` of the
/// slow ones next to the others act in every `ratio`-th step. By how much its energy norm grows per cycle.
fn growth(ratio: u32, slow: usize, layers: usize, step: f64, numbers: &mut Spread) -> f64 {
    let lengths: Vec<f64> = [vec![2.0 * f64::from(ratio); slow], vec![1.0; 30], vec![2.0 * f64::from(ratio); slow]].concat();
    let is_slow = |e: usize| e + layers < slow || e >= slow + 30 + layers;
    let mut masses = vec![0.0; lengths.len() + 1];
    for (e, h) in lengths.iter().enumerate() {
        masses[e] += 0.5 * h;
        masses[e + 1] += 0.5 * h;
    }
    let mut x: Vec<f64> = masses.iter().map(|_| numbers.between(-1.0, 1.0)).collect();
    let mut v = vec![0.0; x.len()];
    let mut norms = Vec::new();
    for _ in 0..3_000 {
        for turn in 0..ratio {
            for (e, h) in lengths.iter().enumerate().filter(|(e, _)| turn == 0 || !is_slow(*e)) {
                let impulse = step * if is_slow(e) { f64::from(ratio) } else { 1.0 } * (x[e + 1] - x[e]) / h;
                v[e] += impulse / masses[e];
                v[e + 1] -= impulse / masses[e + 1];
            }
            // The ends are held.
            (v[0], v[lengths.len()]) = (0.0, 0.0);
            x.iter_mut().zip(&v).for_each(|(x, v)| *x += step * v);
        }
        let strains: f64 = lengths.iter().enumerate().map(|(e, h)| (x[e + 1] - x[e]).powi(2) / h).sum();
        let energy = strains + masses.iter().zip(&v).map(|(m, v)| m * v * v).sum::<f64>();
        norms.push(energy);
        if energy > 1e200 {
            return f64::INFINITY;
        }
    }
    let most = |of: &[f64]| of.iter().copied().fold(0.0, f64::max);
    ((most(&norms[2_000..]) / most(&norms[..1_000])).ln() / 2_000.0).exp() - 1.0
}

/// Why two layers of elements around faster ones are evaluated as often as these.
#[test]
fn impulses_beside_elements_that_are_faster_excite_them_and_two_layers_further_do_not() {
    let mut numbers = Spread::new(43);
    let mut worst = [0.0_f64; 3];
    for _ in 0..120 {
        let ratio = 2 + (numbers.between(0.0, 1.0) * 23.0) as u32;
        let step = numbers.between(0.5, 1.0);
        for (layers, worst) in worst.iter_mut().enumerate() {
            *worst = worst.max(growth(ratio, 10, layers, step, &mut numbers));
        }
    }
    println!("growth per cycle with 0, 1, 2 layers: {:.1e} {:.1e} {:.1e}", worst[0], worst[1], worst[2]);
    assert!(worst[0] > 1e-2 && worst[2] < 1e-4, "{worst:?}");
}

/// The run with random velocities, m/s, of all nodes.
fn shaken(model: &Model, speed: f64) -> Simulation {
    let mut run = simulation(model);
    let nodes: Vec<u32> = (0..run.coordinates().len() as u32 / 2).collect();
    let mut numbers = Spread::new(42);
    let velocities: Vec<f64> = (0..2 * nodes.len()).map(|_| numbers.between(-speed, speed)).collect();
    run.set_velocities(&nodes, &velocities).unwrap();
    run
}

#[test]
fn energy_does_not_drift_over_long_runs() {
    let steps = |ratio: f64| if ratio == 16.0 { if is_long() { 400_000 } else { 50_000 } } else { 30_000 };
    for element in ["quad4", "quad4_reduced"] {
        let ratios: &[f64] = if is_long() { &[8.0, 11.0, 16.0, 23.0, 32.0, 90.0, 150.0] } else { &[8.0, 16.0, 150.0] };
        for &ratio in ratios {
            for safety in [0.9, 1.0] {
                let mut model = strip(ratio, [6, 4, 2], 0.1);
                model.parts.iter_mut().for_each(|part| part.element = element.into());
                model.run.safety = safety;
                let mut run = shaken(&model, 0.01);
                let kinetic = value(&run, "energy.kinetic");
                run.advance(f64::INFINITY, 3_000).unwrap();
                let early = run.summary().energy_drift;
                run.advance(f64::INFINITY, steps(ratio)).unwrap();
                let summary = run.summary();
                let evaluated = summary.element_evaluations.unwrap() as f64 / (summary.steps as f64 * summary.elements as f64);
                println!(
                    "{element} {ratio} {safety}: kinetic {kinetic:e}, drift {early:.1e}, then {:.1e}; {evaluated:.2} evaluated",
                    summary.energy_drift
                );
                assert!(evaluated < 0.95, "{element} {ratio}: {evaluated}");
                // Not of its own, but the vibrations between the steps of the elements: no growth.
                assert!(summary.energy_drift < 1.5 * early.max(1e-3), "{element} {ratio} {safety}: {early} {}", summary.energy_drift);
            }
        }
    }
}

#[test]
fn momentum_is_kept() {
    for ratio in [6.0, 24.0] {
        let mut model = strip(ratio, [6, 4, 2], 0.1);
        for (part, velocity) in model.parts.iter_mut().zip([[1.0, 2.0], [-1.0, 0.5], [0.0, -1.0]]) {
            (part.velocity, part.spin) = ([velocity[0], velocity[1], 0.0], 0.5);
        }
        let mut run = simulation(&model);
        run.advance(f64::INFINITY, 5_000).unwrap();
        let summary = run.summary();
        let momentum = [summary.momentum_drift_linear, summary.momentum_drift_angular].map(Option::unwrap);
        println!("{ratio}: momentum {:.0e}, angular {:.0e}", momentum[0], momentum[1]);
        assert!(momentum.iter().all(|drift| *drift < 1e-11), "{ratio}: {momentum:?}");
    }
}

/// Bodies of many chunks of nodes, some of which have the nodes of both: their step ratios do not divide each
/// other.
#[test]
fn momentum_is_kept_where_ratios_do_not_divide_each_other() {
    for (first, second, cycle) in [(2.0, 3.0, 6), (4.0, 5.0, 20), (3.0, 1.0, 3)] {
        let mut model = model(1e6);
        for (name, ratio, place, elements) in [("fine", 1.0, 0.0, 4), ("first", first, 1.0, 40), ("second", second, 9.0, 40)] {
            // Their steps allow a little more than twice the ratio.
            let size = if name == "fine" { 0.01 } else { 0.0202 * ratio } * elements as f64;
            add(&mut model, name, rectangle([place, 0.0], [size, size], [elements, elements]), [1.0, -2.0]);
            model.parts.last_mut().unwrap().spin = 20.0;
        }
        model.run.subcycling = true;
        let mut run = simulation(&model);
        run.advance(f64::INFINITY, 600).unwrap();
        let summary = run.summary();
        let evaluated = summary.element_evaluations.unwrap() as f64 / summary.steps as f64;
        let (wanted, drift) = (16.0 + 1600.0 / first + 1600.0 / second, [summary.momentum_drift_linear, summary.momentum_drift_angular]);
        println!(
            "{first} {second}, cycle {cycle}: {evaluated:.0} of {wanted:.0} per step, momentum {drift:?}, drift {:.1e}",
            summary.energy_drift
        );
        assert!((evaluated / wanted - 1.0).abs() < 0.03, "{evaluated} {wanted}");
        assert!(
            drift.into_iter().flatten().all(|drift| drift < 1e-12) && summary.energy_drift < 1e-3,
            "{drift:?} {}",
            summary.energy_drift
        );
    }
}

/// A plate of two chunks and more that a small block with fine elements hits.
fn impact(subcycling: bool) -> Model {
    let mut model = model(1.5e-3);
    add(&mut model, "plate", rectangle([0.0, 0.0], [2.0, 4.0], [40, 80]), [0.0; 2]);
    add(&mut model, "block", rectangle([-0.051, 1.98], [0.05, 0.05], [16, 16]), [20.0, 0.0]);
    touch(&mut model, "block.right", "plate.left");
    probe(&mut model, "inside", "plate", [0.5, 2.0]);
    model.run.subcycling = subcycling;
    model
}

#[test]
fn an_impact_is_what_it_is_without_subcycling() {
    let [whole, less] = [false, true].map(|subcycling| to_end(&impact(subcycling)));
    let (all, summary) = (whole.summary(), less.summary());
    let share = summary.element_evaluations.unwrap() as f64 / (summary.steps as f64 * summary.elements as f64);
    println!("{share:.3} of the evaluations, drift {:.1e} and {:.1e}", all.energy_drift, summary.energy_drift);
    assert!(all.element_evaluations.is_none() && share < 0.5, "{share}");
    assert!(summary.energy_drift < 0.01 && all.energy_drift < 1e-4);
    for (column, from) in [("energy.kinetic[block]", 0.0), ("energy.kinetic[plate]", 0.0), ("inside.x", 0.5)] {
        let [expected, found] = [&whole, &less].map(|run| value(run, column) - from);
        println!("{column}: {expected:e} {found:e}");
        assert!((found - expected).abs() < 0.03 * expected.abs(), "{column}: {expected} {found}");
    }
}

#[test]
fn runs_with_subcycling_have_equal_bits_and_continue() {
    let mut model = impact(true);
    model.run.end = 1e-3;
    hash_of_equal_bits(&model, &[1, 2, 3], "impact");
    crate::restart::continues("impact", &impact(true), 700);
    for element in ["quad4_reduced", "quad4_reduced_viscous"] {
        let mut model = strip(8.0, [6, 4, 2], 0.1);
        model.run.bulk_viscosity = [0.06, 1.2];
        model.parts.iter_mut().for_each(|part| part.element = element.into());
        model.parts[0].velocity = [3.0, 0.0, 0.0];
        crate::restart::continues(element, &model, 333);
    }
}

/// Springs count once: the step is that without subcycling.
#[test]
fn springs_do_not_shorten_the_step_twice() {
    let steps = [false, true].map(|subcycling| {
        let mut model = impact(subcycling);
        let between = ["block.left".into(), "plate.right".into()];
        model.springs.push(Spring { between, stiffness: 1e8, ..Spring::default() });
        let mut run = simulation(&model);
        run.advance(f64::INFINITY, 100).unwrap();
        (run.time_step(), run.summary().stable_time_step_governor)
    });
    println!("{steps:?}");
    assert!((steps[1].0 / steps[0].0 - 1.0).abs() < 0.02 && steps[0].1.starts_with("springs"), "{steps:?}");
}

#[test]
fn runs_with_subcycling_whose_parts_fail_continue() {
    let mut model = torn_bar(&[("plastic_strain", 0.02)]);
    model.parts[1].material = "weak".into();
    model.run.subcycling = true;
    crate::restart::continues("torn bar", &model, 300);
}

#[test]
fn what_does_not_go_with_subcycling_is_said() {
    let faults_with = |change: fn(&mut Model)| {
        let mut model = impact(true);
        change(&mut model);
        faults(&model).join("\n")
    };
    let relaxed = faults_with(|model| model.run.relaxation = Some(Relaxation { tolerance: 1e-6, from: 0.0 }));
    assert!(relaxed.contains("run.subcycling") && relaxed.contains("relaxation"), "{relaxed}");
    let by_nodes = faults_with(|model| model.run.stable_step = StableStep::Nodes);
    assert!(by_nodes.contains("run.subcycling") && by_nodes.contains("by elements"), "{by_nodes}");
}
