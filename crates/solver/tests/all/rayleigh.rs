//! Damping in proportion to mass and stiffness: decay of modes, its work in the ledger, its stable step, and
//! what it does not touch.

use crate::bodies::*;
use crate::patches::{Body, Spread, frequency_squared, material, patch, reference_nodes, stiffness};
use embate_lanes::Level;
use embate_solver::block::BlockInput;
use embate_solver::element::ELEMENTS;
use embate_solver::model::{Constraint, Drive, InitialStress, Load, Model, Part, Polygon, Shape, Truss};
use embate_solver::simulation::{Options, Simulation};
use embate_solver::stress_state::STRESS_STATES;
use std::f64::consts::TAU;

fn damp(model: &mut Model, rate: f64, time: f64) {
    if rate > 0.0 {
        model.loads.push(Load::Damping { parts: vec![], rate, active: [0.0, f64::INFINITY] });
    }
    if time > 0.0 {
        model.loads.push(Load::StiffnessDamping { parts: vec![], time });
    }
}

fn hold(model: &mut Model, on: &str, held: [bool; 2]) {
    let velocity = held.map(|held| held.then_some(Drive::Constant(0.0)));
    model.constraints.push(Constraint { on: on.into(), velocity: embate_solver::model::in_3d(velocity), ..Constraint::default() });
}

/// Elements of these lengths, each held on the left and free to swing along x on the right: ω² = 2 c²/L². The
/// last one is a bar.
fn oscillators(lengths: &[f64], end: f64) -> Model {
    let mut model = slender(end, 1e9, 1e3);
    for (k, &length) in lengths.iter().enumerate() {
        let (name, y) = (format!("part{k}"), 0.5 * k as f64);
        if k + 1 < lengths.len() {
            add(&mut model, &name, rectangle([0.0, y], [length, 0.1], [1, 1]), [1.0, 0.0]);
            hold(&mut model, &format!("{name}.left"), [true, true]);
            hold(&mut model, &format!("{name}.right"), [false, true]);
        } else {
            add(&mut model, &name, Shape::Truss(Truss { lines: vec![vec![[0.0, y], [length, y]]], elements: 1 }), [1.0, 0.0]);
            let bar = model.parts.last_mut().unwrap();
            (bar.element, bar.area) = ("bar2".into(), Some(0.1));
            hold(&mut model, &format!("{name}.point0"), [true, true]);
            hold(&mut model, &format!("{name}.point1"), [false, true]);
        }
    }
    model
}

#[test]
fn modes_decay_with_the_sum_of_both_kinds_of_damping() {
    let (c, lengths) = (1e3, [1.0, 0.25, 0.25]);
    let omegas = lengths.map(|length| 2.0f64.sqrt() * c / length);
    for (alpha, beta) in [(100.0, 0.0), (0.0, 2e-5), (60.0, 1e-5)] {
        let mut model = oscillators(&lengths, 8.0 * TAU / omegas[0]);
        model.run.time_step = Some(0.01 / omegas[1]);
        damp(&mut model, alpha, beta);
        let steps = every_step(&model);
        let times = steps.column("time");
        for (k, omega) in omegas.into_iter().enumerate() {
            let place = steps.column(&format!("part{k}.x"));
            let u: Vec<f64> = place.iter().map(|x| x - place[0]).collect();
            // Largest displacements of each swing, one after the other.
            let peaks: Vec<(f64, f64)> =
                (1..u.len() - 1).filter(|&n| u[n] > 0.0 && u[n] >= u[n - 1] && u[n] > u[n + 1]).map(|n| (times[n], u[n])).collect();
            let ([t0, u0], [t1, u1]) = ([peaks[0].0, peaks[0].1], [peaks[5].0, peaks[5].1]);
            let rate = (u0 / u1).ln() / (t1 - t0);
            let ratio = 0.5 * (alpha / omega + beta * omega);
            assert!((rate / (ratio * omega) - 1.0).abs() < 0.01, "part{k}, α {alpha}, β {beta}: {rate} for {}", ratio * omega);
            let period = (t1 - t0) / 5.0;
            assert!((period * omega * (1.0 - ratio * ratio).sqrt() / TAU - 1.0).abs() < 2e-3, "{period}");
        }
        let simulation = to_end(&model);
        let summary = simulation.summary();
        assert!(summary.energy_drift < 1e-3 && summary.ledger_residual < 1e-11, "{alpha} {beta}: {summary:?}");
        assert!(simulation.ledger().stores.damping > 0.5 * simulation.ledger().stores.total(), "{:?}", simulation.ledger().stores);
    }
}

/// A block with damping.
fn damped(element: &str, state: &str, law: &str, damping: f64, n: usize) -> Body {
    let mut patch = patch(element, n, 0.2);
    patch.positions.iter_mut().for_each(|x| x[0] += 1.0);
    let material = material(law, 0.3);
    Body::made(&BlockInput { damping, stress_state: state, ..BlockInput::new(element, &material, &patch.connectivity, &patch.positions) })
}

#[test]
fn what_the_damping_takes_is_what_the_nodes_spend() {
    for element in ELEMENTS.iter().map(|kind| kind.name) {
        for (state, law) in STRESS_STATES.iter().map(|kind| kind.name).flat_map(|state| [(state, "elastic"), (state, "j2")]) {
            let error = |steps: usize| {
                let mut body = damped(element, state, law, 0.1, 2);
                let (begin, time_step, mut work) = (body.positions.clone(), 1.0 / steps as f64, 0.0);
                for step in 1..=steps {
                    let (before, forces) = (body.positions.clone(), body.forces());
                    let s = 0.02 * (step as f64 / steps as f64);
                    let (sin, cos) = (10.0 * s).sin_cos();
                    let to = |[x, y]: [f64; 2]| {
                        let [x, y] = [x * (1.0 + s * (0.7 + 0.3 * y)), y * (1.0 - 0.5 * s) + 0.2 * s * x * x];
                        // Turning would leave the axis.
                        if state == "axisymmetric" { [x, y] } else { [cos * x - sin * y, sin * x + cos * y] }
                    };
                    let velocities: Vec<[f64; 2]> =
                        begin.iter().zip(&before).map(|(&x, from)| [0, 1].map(|d| (to(x)[d] - from[d]) / time_step)).collect();
                    body.advance(&velocities, time_step);
                    let after = body.forces();
                    let pairs = forces.iter().zip(&after).zip(before.iter().zip(&body.positions));
                    work += pairs.map(|((f, g), (x, y))| (0..2).map(|d| -0.5 * (f[d] + g[d]) * (y[d] - x[d])).sum::<f64>()).sum::<f64>();
                }
                assert!(body.report.damping > 0.05 * work, "{element} {state} {law}: {} of {work}", body.report.damping);
                ((body.energy() + body.report.damping) / work - 1.0).abs()
            };
            let (coarse, fine) = (error(20), error(80));
            assert!(fine < 3e-4 && (fine < 0.2 * coarse || fine < 1e-9), "{element} {state} {law}: {coarse:e} {fine:e}");
        }
    }
}

#[test]
fn turning_and_flying_is_not_damped() {
    for element in ELEMENTS.iter().map(|kind| kind.name) {
        let mut body = damped(element, "plane_strain", "elastic", 10.0, 2);
        let begin = body.positions.clone();
        for k in 1..=100 {
            let (sin, cos) = (TAU * f64::from(k) / 100.0).sin_cos();
            let to: Vec<[f64; 2]> = begin.iter().map(|[x, y]| [cos * x - sin * y + f64::from(k), sin * x + cos * y]).collect();
            body.move_to(&to);
        }
        assert!(body.report.damping.abs() < 1e-18 && body.report.stored.abs() < 1e-15, "{element}: {:?}", body.report);
        assert!(body.forces().iter().flatten().all(|f| f.abs() < 1e-6), "{element}");
    }
}

#[test]
fn the_step_is_stable_up_to_its_bound_and_the_bound_of_a_bar_is_sharp() {
    for element in ELEMENTS.iter().map(|kind| kind.name) {
        let material = material("elastic", 0.3);
        let nodes = reference_nodes(element);
        let corners: Vec<u32> = (0..nodes.len() as u32).collect();
        let made = |damping: f64| Body::made(&BlockInput { damping, ..BlockInput::new(element, &material, &corners, &nodes) });
        let free = made(0.0).report.time_step_squared;
        let omega = frequency_squared(&stiffness(|| made(0.0)), &made(0.0).masses()).sqrt();
        for beta in [0.1, 1.0, 5.0].map(|share| share * free.sqrt()) {
            let step = made(beta).report.time_step_squared.sqrt();
            // Hourglass control is not damped, and keeps its own bound.
            assert!(step < (beta * beta + free).sqrt() - beta + 1e-12, "{element}: {step}");
            let bound = (beta * beta + 4.0 / (omega * omega)).sqrt() - beta;
            assert!(step <= bound * (1.0 + 1e-5), "{element} {beta}: {step} {bound}");
            let mut body = made(beta);
            let masses = body.masses();
            let mut numbers = Spread::new(5);
            let mut velocities: Vec<[f64; 2]> = nodes.iter().map(|_| numbers.vector(1e-6)).collect();
            let energy =
                |velocities: &[[f64; 2]]| velocities.iter().zip(&masses).map(|(v, m)| 0.5 * m * (v[0] * v[0] + v[1] * v[1])).sum::<f64>();
            let start = energy(&velocities);
            for _ in 0..2000 {
                body.advance(&velocities, 0.995 * step);
                for ((v, f), m) in velocities.iter_mut().zip(body.forces()).zip(&masses) {
                    *v = [0, 1].map(|d| v[d] + 0.995 * step * f[d] / m);
                }
            }
            assert!(energy(&velocities) <= start * 1.01, "{element} {beta}: {} of {start}", energy(&velocities));
        }
    }
    // One free bar has the one frequency 2c/L: just below the bound it comes to rest, just above it flies
    // apart.
    let material = material("elastic", 0.3);
    let nodes = [[0.0, 0.0], [1.0, 0.0]];
    for (factor, lives) in [(0.99, true), (1.01, false)] {
        let input = BlockInput { area: 1.0, damping: 0.02, ..BlockInput::new("bar2", &material, &[0, 1], &nodes) };
        let mut bar = embate_solver::block::make(&input).unwrap();
        let (mut positions, mut velocities) = (nodes, [[-1e-9, 0.0], [1e-9, 0.0]]);
        let mut slots = [[0.0; 2]; 2];
        let still = embate_solver::block::Motion::new(&nodes, &[[0.0; 2]; 2], 0.0);
        let step = factor
            * bar
                .advance(&still, Level::SCALAR, embate_solver::block::NodalForces::new(&mut slots), &mut embate_lanes::Team::alone())
                .time_step_squared
                .sqrt();
        for _ in 0..1500 {
            for (x, v) in positions.iter_mut().zip(&velocities) {
                x[0] += step * v[0];
            }
            let motion = embate_solver::block::Motion::new(&positions, &velocities, step);
            bar.advance(&motion, Level::SCALAR, embate_solver::block::NodalForces::new(&mut slots), &mut embate_lanes::Team::alone());
            for (node, v) in velocities.iter_mut().enumerate() {
                v[0] += step * slots[node][0] / bar.corner_mass(0, node);
            }
            if velocities[1][0].abs() > 1e-5 {
                break;
            }
        }
        assert_eq!(velocities[1][0].abs() < 1e-9, lives, "{factor}: {}", velocities[1][0]);
    }
}

#[test]
fn bits_do_not_depend_on_threads_and_instruction_sets() {
    let scene = || {
        let mut model = model(1.0);
        add(&mut model, "quads", rectangle([0.0; 2], [1.0, 1.0], [60, 60]), [0.0; 2]);
        let outline = vec![[2.0, 0.0], [3.0, 0.0], [3.0, 1.0], [2.0, 1.0]];
        add(&mut model, "triangles", Shape::Polygon(Polygon { outline, size: 0.03, ..Polygon::default() }), [0.0; 2]);
        model.parts[1].element_triangles = "tri3_anp".into();
        model.parts.iter_mut().for_each(|part| part.stress_initial = Some(InitialStress::uniform([1e6, -2e6, 0.0, 5e5])));
        damp(&mut model, 0.0, 1e-6);
        model
    };
    let hash = |threads: usize, level: &str| {
        let mut simulation = Simulation::new(&scene(), &Options { threads, simd: Some(level.into()) }).unwrap();
        simulation.advance(f64::INFINITY, 25).unwrap();
        (simulation.summary().state_hash, simulation.ledger().stores.damping.to_bits())
    };
    let reference = hash(1, "scalar");
    for level in Level::available() {
        assert_eq!(hash(3, level.name()), reference, "{}", level.name());
    }
}

#[test]
fn eroded_triangles_leave_what_they_dissipated() {
    let mut model = model(4e-4);
    let mut metal = material("j2", 0.3);
    metal
        .parameters
        .extend([("young", 1e9), ("density", 1e3), ("yield", 1e6), ("hardening", 1e6)].map(|(name, value)| (name.to_string(), value)));
    metal.failure.insert("plastic_strain".into(), 0.05);
    model.materials.insert("soft".into(), metal);
    let outline = vec![[0.0, 0.0], [0.1, 0.0], [0.1, 0.03], [0.0, 0.03]];
    add(&mut model, "strip", Shape::Polygon(Polygon { outline, size: 0.01, ..Polygon::default() }), [0.0; 2]);
    model.parts[0] = Part { element_triangles: "tri3_anp".into(), velocity: [0.0, 60.0, 0.0], ..model.parts[0].clone() };
    model.obstacles.push(embate_solver::model::Obstacle::wall("wall", [0.0, 0.031], [0.0, -1.0]));
    let steps = every_step(&model);
    let plastic = steps.column("energy.plastic");
    assert!(plastic.windows(2).all(|pair| pair[1] >= pair[0] * (1.0 - 1e-12)), "it went down");
    assert!(*steps.column("energy.eroded").last().unwrap() > 0.0 && plastic[plastic.len() - 1] > 0.0);
}

#[test]
fn what_has_no_stiffness_to_damp_by_is_refused() {
    let with = |law: &str| {
        let mut model = model(1e-4);
        add(&mut model, "block", rectangle([0.0; 2], [1.0, 1.0], [2, 2]), [0.0; 2]);
        model.materials.insert("soft".into(), material(law, 0.3));
        damp(&mut model, 0.0, 1e-6);
        model
    };
    assert_eq!(model_faults(&with("elastic")), []);
    for law in ["neo_hookean", "orthotropic_elastic"] {
        let found = model_faults(&with(law));
        assert!(found.len() == 1 && found[0].path == "load[0].damping_stiffness" && found[0].message.contains(law), "{found:?}");
    }
    let mut wrong = with("elastic");
    wrong.loads = vec![Load::StiffnessDamping { parts: vec!["nobody".into()], time: -1.0 }];
    let found = faults(&wrong);
    assert!(found.len() == 2 && found[0].contains("nobody") && found[1].contains("greater than 0"), "{found:?}");
}
