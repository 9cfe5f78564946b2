//! Every formulation with every law: momentum, energy, closed forms, objectivity; penalties from every
//! source; ties that hold and break.

use crate::bodies::*;
use crate::contact::scenes;
use crate::self_contact::{all, alone, crushed_ring, folding_column};
use embate_solver::error::Error;
use embate_solver::model::{
    Constraint, Contact, ContactLaw, Curve, Drive, Formulation, Friction, Interface, Load, Model, Penalty, PenaltySource,
};
use embate_solver::simulation::{Options, Simulation};

const FRICTION: Friction = Friction { coefficient: 0.3, dynamic: None, decay: 0.0, viscosity: 0.0, limit: f64::INFINITY };
const FORMULATIONS: [Formulation; 4] =
    [Formulation::DoublePass, Formulation::SinglePass { slave: 1 }, Formulation::Segment, Formulation::Pinball];

fn laws() -> Vec<(&'static str, ContactLaw)> {
    let soft_layer = ContactLaw::PressureGap { gaps: vec![-1e-3, -2e-4, 1e-4], pressures: vec![3e8, 2e7, 0.0] };
    vec![("penalty", ContactLaw::default()), ("pressure_gap", soft_layer), ("multiplier", ContactLaw::Multiplier)]
}

/// Multipliers have nothing to damp.
fn damping_of(law: &ContactLaw, fraction: f64) -> f64 {
    if *law == ContactLaw::Multiplier { 0.0 } else { fraction }
}

#[test]
fn momentum_is_kept_and_the_books_close_with_every_law_and_formulation() {
    for formulation in FORMULATIONS {
        for (law_name, law) in laws() {
            for friction in [None, Some(FRICTION)] {
                for (name, mut model, segment) in scenes() {
                    for contact in &mut model.contacts {
                        contact.formulation = formulation;
                        (contact.interface.law, contact.interface.friction) = (law.clone(), friction);
                    }
                    model.run.energy_limit = 1.0;
                    let (simulation, history) = run(&model);
                    let summary = simulation.summary();
                    let what = format!("{formulation:?} {law_name} {name} {}", friction.is_some());
                    let column = format!("contact.force_x[{}]", model.contacts[0].name);
                    let pushed = history.column(&column).into_iter().fold(0.0, |largest, force| f64::max(largest, force.abs()));
                    assert!(pushed > 0.0, "{what}: they met");
                    assert!(summary.momentum_drift_linear.unwrap() <= 1e-12, "{what}: {summary:?}");
                    assert!(summary.momentum_drift_angular.unwrap() <= 1e-12, "{what}: {summary:?}");
                    assert!(summary.ledger_residual <= 1e-12, "{what}: {summary:?}");
                    assert!(summary.energy_drift <= 0.01, "{what}: {summary:?}");
                    // A corner of the other side goes in between the nodes of a single pass, and between
                    // disks.
                    let is_open = matches!(formulation, Formulation::SinglePass { .. } | Formulation::Pinball);
                    let most = if is_open { 1.0 } else { 0.25 };
                    assert!(summary.penetration_max < most * segment, "{what}: {summary:?}");
                    assert_eq!(simulation.sweeps().1, 0, "{what}: forces that were not solved");
                }
            }
        }
    }
}

#[test]
fn springs_as_stiff_as_one_likes_are_solved_and_the_books_close() {
    for formulation in [Formulation::DoublePass, Formulation::Segment] {
        for (name, model, _) in scenes() {
            let drift = |scale: f64| {
                let mut model = model.clone();
                for contact in &mut model.contacts {
                    contact.formulation = formulation;
                    contact.interface.law = ContactLaw::Penalty(Penalty::automatic(scale));
                }
                model.run.energy_limit = 1.0;
                let (simulation, _) = run(&model);
                let (summary, (sweeps, unsolved)) = (simulation.summary(), simulation.sweeps());
                let what = format!("{formulation:?} {name} {scale:e}");
                assert!(unsolved == 0 && sweeps < 200, "{what}: {sweeps} sweeps, {unsolved} steps not solved");
                assert!(summary.ledger_residual <= 1e-12, "{what}: {summary:?}");
                summary.energy_drift
            };
            let drifts = [1.0, 1e1, 1e2, 1e3, 1e4, 1e5].map(drift);
            // Beyond these up to a third of the energy drifts in some scenes although the forces are solved:
            // only the solution and the ledger are asserted there.
            let kept = if formulation == Formulation::DoublePass { 5 } else { 2 };
            assert!(drifts[..kept].iter().all(|&drift| drift <= 0.05), "{formulation:?} {name}: {drifts:?}");
            if formulation == Formulation::DoublePass && name == "corner in a notch" {
                // Where springs went from face to face as if nothing had been stored, 82 % were lost at 1e3
                // and an element was turned inside out at 1e5.
                assert!(drifts[2..5].iter().all(|&drift| drift <= 1e-3), "{drifts:?}");
            }
        }
    }
}

/// Two equal bars, 50 elements of 2 mm each, that meet at 20 m/s; mean force and gap on the plateau, fraction
/// of the closed form, and the model's force.
fn bars(formulation: Formulation, law: ContactLaw) -> (Vec<f64>, Vec<f64>, Simulation, f64) {
    let (young, density, length, height) = (1e9, 1000.0, 0.1, 0.02);
    let c = f64::sqrt(young / density);
    let mut model = slender(1.6e-4, young, density);
    add(&mut model, "left", rectangle([-length, 0.0], [length, height], [50, 1]), [10.0, 0.0]);
    add(&mut model, "right", rectangle([1e-6, 0.0], [length, height], [50, 1]), [-10.0, 0.0]);
    model.contacts.push(Contact {
        formulation,
        interface: Interface { law, ..Interface::default() },
        ..Contact::between("ends", "left.right", "right.left")
    });
    let steps = every_step(&model);
    let (times, forces) = (steps.column("time"), steps.column("contact.force_x[ends]"));
    let plateau = |values: &[f64]| -> Vec<f64> {
        times.iter().zip(values).filter(|(time, _)| (0.6e-4..1.5e-4).contains(*time)).map(|(_, value)| *value).collect()
    };
    let force = 0.5 * density * c * 20.0 * height;
    let depths = plateau(&steps.column("contact.penetration[ends]"));
    (plateau(&forces).into_iter().map(|found| -found / force).collect(), depths, simulation(&model), force)
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

#[test]
fn two_bars_meet_with_the_force_of_the_closed_form_in_every_formulation() {
    for formulation in FORMULATIONS {
        for law in [ContactLaw::default(), ContactLaw::Penalty(Penalty::automatic(20.0)), ContactLaw::Multiplier] {
            let (forces, depths, ..) = bars(formulation, law.clone());
            let found = mean(&forces);
            // Stiff pinballs leave more in vibrations.
            assert!((found - 1.0).abs() < 0.02, "{formulation:?} {law:?}: {found} of the closed form");
            if law == ContactLaw::Multiplier {
                let deepest = depths.iter().copied().fold(0.0, f64::max);
                assert!(deepest < 1e-13, "{formulation:?}: {deepest} m deep");
            }
        }
    }
}

#[test]
fn penalties_from_every_source_are_as_stiff_as_their_formulas() {
    let (young, density, height) = (1e9, 1000.0, 0.002);
    let pressure = 0.5 * density * f64::sqrt(young / density) * 20.0;
    for formulation in [Formulation::SinglePass { slave: 0 }, Formulation::Segment, Formulation::Pinball] {
        for source in [PenaltySource::WaveModulus, PenaltySource::BulkModulus, PenaltySource::TimeStep] {
            let law = ContactLaw::Penalty(Penalty::Automatic { source, scale: 2.0 });
            let (forces, depths, simulation, _) = bars(formulation, law);
            let kappa = match source {
                PenaltySource::WaveModulus => young / height,
                PenaltySource::BulkModulus => young / 3.0 / height,
                PenaltySource::TimeStep => 0.1 * 0.5 * density * height / simulation.time_step().powi(2),
            };
            let (found, right) = (mean(&depths) / mean(&forces), pressure / (2.0 * kappa));
            // Pinballs of such flat elements are short: their length is that of the element's height, ten
            // disks in a row make the same.
            assert!((found / right - 1.0).abs() < 0.02, "{formulation:?} {source:?}: {found} {right}");
        }
    }
}

/// A small block thrown down on a plate that is held below; turned by an angle as a whole.
fn turned(angle: f64, formulation: Formulation, law: &ContactLaw) -> Model {
    let (sin, cos) = angle.sin_cos();
    let turn = move |[x, y]: [f64; 2]| [cos * x - sin * y, sin * x + cos * y];
    let mut model = model(5e-4);
    let plate = mapped([9, 3], |u, v| turn([0.12 * u, -0.03 + v * (0.03 + 0.004 * (4.0 * u).sin())]));
    let block = mapped([5, 4], |u, v| turn([0.04 + 0.05 * u, 0.006 + 0.005 * u + 0.04 * v]));
    add_mesh(&mut model, "plate", plate, turn([0.0, 5.0]));
    add_mesh(&mut model, "block", block, turn([12.0, -25.0]));
    let interface = Interface { law: law.clone(), friction: Some(FRICTION), damping: damping_of(law, 0.1), ..Interface::default() };
    model.contacts.push(Contact { formulation, interface, ..Contact::between("meet", "plate", "block") });
    model
}

#[test]
fn a_model_that_is_turned_as_a_whole_gives_turned_results() {
    let angle = std::f64::consts::FRAC_PI_6;
    let (sin, cos) = angle.sin_cos();
    for formulation in FORMULATIONS {
        for (name, law) in laws() {
            let [straight, turned] = [0.0, angle].map(|angle| {
                let mut simulation = simulation(&turned(angle, formulation, &law));
                simulation.advance(f64::INFINITY, u64::MAX).unwrap();
                let summary = simulation.summary();
                assert!(summary.penetration_max > 0.0 || name == "multiplier");
                assert!(simulation.ledger().stores.friction > 0.0, "{formulation:?} {name}: friction took something");
                let mut positions = simulation.frame().positions::<2>().to_vec();
                // Storage order follows a curve in 3D; pair by place instead.
                if angle != 0.0 {
                    positions.iter_mut().for_each(|x| *x = [cos * x[0] + sin * x[1], cos * x[1] - sin * x[0]]);
                }
                positions
            });
            let mut worst = 0.0_f64;
            for (a, b) in straight.iter().zip(&turned) {
                worst = worst.max((a[0] - b[0]).abs()).max((a[1] - b[1]).abs());
            }
            assert!(worst < 1e-9, "{formulation:?} {name}: {worst}");
        }
    }
}

#[test]
fn a_block_that_slides_is_braked_by_the_coefficient_times_what_presses() {
    for formulation in [Formulation::DoublePass, Formulation::Segment] {
        for law in [ContactLaw::default(), ContactLaw::Multiplier] {
            let mut model = model(6e-3);
            add(&mut model, "slab", rectangle([0.0, 0.0], [0.2, 0.02], [23, 2]), [0.0, 0.0]);
            add(&mut model, "block", rectangle([0.02, 0.02], [0.05, 0.03], [5, 3]), [8.0, 0.0]);
            model.constraints.push(Constraint {
                on: "slab.bottom".into(),
                velocity: [Some(0.0.into()), Some(0.0.into()), None],
                ..Constraint::default()
            });
            model.loads.push(Load::Gravity { parts: vec!["block".into()], acceleration: [0.0, -1000.0, 0.0], curve: None });
            let interface =
                Interface { law: law.clone(), friction: Some(FRICTION), damping: damping_of(&law, 0.3), ..Interface::default() };
            model.contacts.push(Contact { formulation, interface, ..Contact::between("slide", "slab.top", "block.bottom") });
            model.run.energy_limit = 1.0;
            let steps = every_step(&model);
            let end = 6e-3;
            let (dx, dy) = (steps.change("block.vx"), steps.change("block.vy"));
            let right = -0.3 * (1000.0 * end + dy);
            assert!((dx / right - 1.0).abs() < 0.02, "{formulation:?} {law:?}: {dx}, Coulomb {right}");
        }
    }
}

#[test]
fn a_soft_layer_takes_the_energy_that_its_table_says() {
    // A stiff block, thrown on a stiff heavy plate with a layer: ∫ p dg from the edge of the table to the
    // greatest depth is the kinetic energy per area.
    let (speed, density, height) = (2.0, 1000.0, 0.05);
    for formulation in [Formulation::DoublePass, Formulation::SinglePass { slave: 1 }, Formulation::Segment] {
        let mut model = slender(6e-3, 1e11, density);
        add(&mut model, "block", rectangle([0.0, 1e-3], [0.1, height], [4, 2]), [0.0, -speed]);
        add(&mut model, "plate", rectangle([0.0, -0.02], [0.1, 0.02], [7, 1]), [0.0; 2]);
        model.constraints.push(Constraint {
            on: "plate".into(),
            velocity: [Some(0.0.into()), Some(0.0.into()), None],
            ..Constraint::default()
        });
        let law = ContactLaw::PressureGap { gaps: vec![-2e-3, 0.0, 5e-4], pressures: vec![1e5, 2e4, 0.0] };
        let interface = Interface { law, ..Interface::default() };
        model.contacts.push(Contact { formulation, interface, ..Contact::between("layer", "plate.top", "block.bottom") });
        let (simulation, history) = run(&model);
        let depth = history.largest("contact.penetration[layer]");
        let taken = 0.5 * 5e-4 * 2e4 + 2e4 * depth + 0.5 * (8e4 / 2e-3) * depth * depth;
        let thrown = 0.5 * density * height * speed * speed;
        assert!((taken / thrown - 1.0).abs() < 0.01, "{formulation:?}: {taken} {thrown}");
        assert!((history.last("block.vy") / speed - 1.0).abs() < 1e-3, "{formulation:?}: {}", history.last("block.vy"));
        assert!(simulation.summary().energy_drift < 1e-3, "{formulation:?}: {:?}", simulation.summary());
    }
}

/// Two tied bars that fly apart at 2 v: the tie is pulled with ρ c v.
fn tied_bars(formulation: Formulation, strength: f64, law: ContactLaw, turned: bool) -> Model {
    let (sin, cos) = if turned { (0.5, 0.75_f64.sqrt()) } else { (0.0, 1.0) };
    let turn = move |[x, y]: [f64; 2]| [cos * x - sin * y, sin * x + cos * y];
    let mut model = slender(1.5e-4, 1e9, 1000.0);
    // Meshes that don't match, and a little apart: that stays so.
    let bar = |elements, from: f64| mapped(elements, move |u, v| turn([from + 0.1 * u, 0.04 * v]));
    add_mesh(&mut model, "left", bar([20, 3], -0.1), turn([-10.0, 0.0]));
    add_mesh(&mut model, "right", bar([20, 4], 1e-4), turn([10.0, 0.0]));
    model.contacts.push(Contact {
        tied: Some(strength),
        formulation,
        interface: Interface { law, ..Interface::default() },
        ..Contact::between("glue", "right", "left")
    });
    model
}

#[test]
fn ties_hold_up_to_their_strength_and_break_beyond_it() {
    let traction = 1000.0 * 1000.0 * 10.0;
    // A tie of the elements' stiffness would be late by ρ c / 2 κ.
    let stiff = ContactLaw::Penalty(Penalty::automatic(10.0));
    // Nodes of the first surface, or what 4 and 3 segments have in common.
    for (formulation, law, count) in [
        (Formulation::DoublePass, stiff.clone(), 5),
        (Formulation::DoublePass, ContactLaw::Multiplier, 5),
        (Formulation::Segment, stiff, 6),
    ] {
        for turned in [false, true] {
            let held = |strength: f64| {
                let (simulation, history) = run(&tied_bars(formulation, strength, law.clone(), turned));
                let summary = simulation.summary();
                assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-12, "{summary:?}");
                assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 0.01, "{summary:?}");
                (history.last("right.vx").hypot(history.last("right.vy")), summary.warnings)
            };
            // Before the wave is back from the free ends (2 L / c = 0.2 ms) the bars have lost the part of
            // their momentum that the tie pulls.
            let (speed, warnings) = held(f64::INFINITY);
            assert!((speed - 5.0).abs() < 0.4 && warnings.is_empty(), "{speed} {warnings:?}");
            let (speed, warnings) = held(0.5 * traction);
            assert!(speed > 9.0, "{speed}");
            let broke = format!("\"glue\": {count} of {count} ties broke");
            assert!(warnings.iter().any(|warning| warning.text.contains(&broke)), "{warnings:?}");
        }
    }
}

#[test]
fn a_broken_tie_is_ordinary_contact() {
    is_torn_and_hit(Formulation::DoublePass, 5);
    is_torn_and_hit(Formulation::Segment, 6);
}

fn is_torn_and_hit(formulation: Formulation, count: usize) {
    // Torn apart, then thrown together again by another body: they must not go through each other.
    let mut model = tied_bars(formulation, 1e5, ContactLaw::default(), false);
    model.run.end = 6e-4;
    add(&mut model, "hammer", rectangle([0.104, 0.0], [0.1, 0.04], [20, 3]), [-60.0, 0.0]);
    touch(&mut model, "right", "hammer");
    let (simulation, history) = run(&model);
    let summary = simulation.summary();
    assert!(
        summary.warnings.iter().any(|warning| warning.text.contains(&format!("{count} of {count} ties broke"))),
        "{:?}",
        summary.warnings
    );
    assert!(history.last("left.vx") < -20.0, "{}", history.last("left.vx"));
    assert!(summary.penetration_max < 1e-3 && summary.energy_drift < 0.01, "{summary:?}");
}

#[test]
fn ties_that_bind_nothing_or_a_node_twice_are_reported() {
    let faults = |model: &Model| match Simulation::new(model, &Options::default()) {
        Err(Error::Model(faults)) => faults.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"),
        other => panic!("{:?}", other.err()),
    };
    let mut apart = tied_bars(Formulation::DoublePass, f64::INFINITY, ContactLaw::default(), false);
    apart.contacts[0].interface.active = [0.0, 1.0];
    add(&mut apart, "far", rectangle([0.5, 0.0], [0.1, 0.04], [4, 4]), [0.0; 2]);
    apart.contacts.push(Contact { tied: Some(1.0), ..Contact::between("loose", "far", "left") });
    let reported = faults(&apart);
    assert!(reported.contains("contact[1].tied") && reported.contains("binds nothing"), "{reported}");
    let mut twice = tied_bars(Formulation::DoublePass, f64::INFINITY, ContactLaw::default(), false);
    add(&mut twice, "third", rectangle([-0.1, 0.0401], [0.3, 0.02], [12, 2]), [0.0; 2]);
    twice.contacts.push(Contact { tied: Some(1.0), ..Contact::between("second", "right", "third") });
    let reported = faults(&twice);
    assert!(
        reported.contains("contact[1].tied") && reported.contains("tied already by contact \"glue\"") && reported.contains("node at ("),
        "{reported}"
    );
}

/// V-1 of the contact patch test (Taylor and Papadopoulos 1991; data of Crisfield 2000): two blocks 1 m x
/// 0.5 m, three rows of elements each, pressed together by 10 mm, brought to rest by damping; turned by an
/// angle as a whole. Largest |σ/σ_mean − 1| across the interface and |σ_other/σ_mean| of all elements.
fn patch_error(formulation: Formulation, penalty: Penalty, meshes: [usize; 2], angle: f64) -> f64 {
    let [lower, upper] = meshes;
    let (sin, cos) = f64::sin_cos(angle);
    let turn = move |[x, y]: [f64; 2]| [cos * x - sin * y, sin * x + cos * y];
    let mut model = slender(2.0, 1e6, 1000.0);
    let mut block = |name: &str, count: usize, from: f64| {
        let mut mesh = mapped([count, 3], |u, v| turn([u, from + 0.5 * v]));
        let row = |j: usize| (0..count).map(move |i| vec![(j * (count + 1) + i) as u32, (j * (count + 1) + i + 1) as u32]);
        mesh.groups.push(group(&format!("{name}-bottom"), 1, row(0)));
        mesh.groups.push(group(&format!("{name}-top"), 1, row(3)));
        add_mesh(&mut model, name, mesh, [0.0; 2]);
    };
    block("lower", lower, 0.0);
    block("upper", upper, 0.5);
    let press = turn([0.0, -0.1]);
    for (d, name) in ["along_x", "along_y"].into_iter().enumerate() {
        let curve = Curve::table(vec![0.0, 0.1, 0.1001], vec![press[d], press[d], 0.0]);
        model.curves.insert(name.into(), curve);
    }
    let velocity = [Some(Drive::Curve("along_x".into())), Some(Drive::Curve("along_y".into()))];
    model.constraints.push(Constraint {
        on: "lower-bottom".into(),
        velocity: [Some(0.0.into()), Some(0.0.into()), None],
        ..Constraint::default()
    });
    model.constraints.push(Constraint { on: "upper-top".into(), velocity: embate_solver::model::in_3d(velocity), ..Constraint::default() });
    model.loads.push(Load::Damping { parts: vec![], rate: 150.0, active: [0.0, f64::INFINITY] });
    model.contacts.push(Contact { formulation, interface: penalty.into(), ..Contact::between("seam", "lower-top", "upper-bottom") });
    let mut simulation = simulation(&model);
    simulation.advance(f64::INFINITY, u64::MAX).unwrap();
    assert_eq!(simulation.sweeps().1, 0, "{formulation:?} {meshes:?}: forces that were not solved");
    let frame = simulation.frame();
    let stresses = &frame.fields.iter().find(|field| field.kind.name == "stress").unwrap().values;
    // xx, yy, zz, xy turned back: across the interface, along it, and shear.
    let local = |s: &[f64]| {
        let across = sin * sin * s[0] + cos * cos * s[1] - 2.0 * sin * cos * s[3];
        let along = cos * cos * s[0] + sin * sin * s[1] + 2.0 * sin * cos * s[3];
        let shear = sin * cos * (s[1] - s[0]) + (cos * cos - sin * sin) * s[3];
        [across, along, shear]
    };
    let all: Vec<[f64; 3]> = stresses.chunks_exact(4).map(local).collect();
    let mean = all.iter().map(|s| s[0]).sum::<f64>() / all.len() as f64;
    assert!(mean < -0.5e4, "{mean}");
    all.iter().map(|s| (s[0] / mean - 1.0).abs().max(s[1].abs() / mean.abs()).max(s[2].abs() / mean.abs())).fold(0.0, f64::max)
}

#[test]
fn segments_pass_the_patch_test_on_any_two_meshes() {
    for meshes in [[4, 5], [8, 11], [12, 11], [5, 5]] {
        for angle in [0.0, std::f64::consts::FRAC_PI_6] {
            for penalty in [Penalty::automatic(1.0), Penalty::Pressure(1e8)] {
                let error = patch_error(Formulation::Segment, penalty, meshes, angle);
                assert!(error < 1e-10, "{meshes:?} turned by {angle}, {penalty:?}: {error}");
            }
        }
    }
}

#[test]
fn a_double_pass_errs_in_the_patch_test_less_with_stiffer_springs_and_a_single_pass_always() {
    for meshes in [[4, 5], [8, 11]] {
        let errors = |formulation| [1e7, 1e8].map(|stiffness| patch_error(formulation, Penalty::Pressure(stiffness), meshes, 0.0));
        let [soft, stiff] = errors(Formulation::DoublePass);
        assert!(soft < 0.03 && stiff < 0.7 * soft, "{meshes:?}: {soft} {stiff}");
        for slave in [0, 1] {
            let [soft, stiff] = errors(Formulation::SinglePass { slave });
            assert!(soft < 0.12 && stiff < 0.12 && stiff > 0.015, "{meshes:?}, slave {slave}: {soft} {stiff}");
        }
    }
    // Where nodes meet nodes nothing is uneven.
    assert!(patch_error(Formulation::DoublePass, Penalty::automatic(1.0), [5, 5], 0.0) < 1e-8);
}

#[test]
fn a_body_alone_feels_itself_in_no_formulation() {
    for formulation in [Formulation::Segment, Formulation::Pinball] {
        for thickness in [0.0, 1e-3] {
            for (name, mut model) in alone() {
                model.parts[0].velocity = [10.0, 0.0, 0.0];
                model.parts[0].spin = 300.0;
                (model.run.energy_limit, model.run.max_steps) = (1.0, Some(300));
                all(&mut model);
                model.contacts[0].formulation = formulation;
                model.contacts[0].interface.thickness = thickness;
                let (simulation, history) = run(&model);
                // A surface that keeps a distance from itself may come nearer to itself than half of what it
                // had.
                let limit = if thickness > 0.0 { 1e-3 * simulation.ledger().largest } else { 0.0 };
                assert!(
                    history.largest("energy.contact") <= limit,
                    "{formulation:?} {name} {thickness}: {}",
                    history.largest("energy.contact")
                );
            }
        }
    }
}

#[test]
fn bodies_meet_themselves_in_every_formulation() {
    for formulation in [Formulation::Segment, Formulation::Pinball] {
        for (name, mut model, wall) in [("ring", crushed_ring(), 4e-3), ("column", folding_column(), 2e-3)] {
            model.contacts[0].formulation = formulation;
            model.run.end = 2.6e-3;
            let (simulation, history) = run(&model);
            let summary = simulation.summary();
            assert!(history.largest("energy.contact") > 0.0);
            assert!(
                summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-12,
                "{name}: {summary:?}"
            );
            assert!(summary.energy_drift < 0.02 && summary.ledger_residual < 1e-12, "{name}: {summary:?}");
            // Between disks a wall goes deeper into itself, and that is reported.
            let is_reported = formulation == Formulation::Pinball && summary.contact.unverified > 0;
            assert!((summary.penetration_max < 0.25 * wall && summary.contact.unverified == 0) || is_reported, "{name}: {summary:?}");
        }
    }
}

#[test]
fn what_springs_hold_when_a_contact_ends_is_booked() {
    for obstacle in [false, true] {
        for friction in [None, Some(FRICTION)] {
            let mut model = slender(6e-4, 1e9, 1e3);
            add(&mut model, "upper", rectangle([0.0, 0.0], [0.1, 0.05], [5, 3]), [3.0, -20.0]);
            let active = [0.0, 1.02e-4];
            let interface = if obstacle {
                model.obstacles.push(embate_solver::model::Obstacle::wall("floor", [0.0, -1e-5], [0.0, 1.0]));
                &mut model.obstacles[0].interface
            } else {
                add(&mut model, "lower", rectangle([-0.1, -0.05001], [0.3, 0.05], [15, 3]), [0.0, 0.0]);
                touch(&mut model, "upper", "lower");
                &mut model.contacts[0].interface
            };
            (interface.active, interface.friction, interface.law) = (active, friction, ContactLaw::Penalty(Penalty::automatic(0.2)));
            let (simulation, history) = run(&model);
            let (summary, held) = (simulation.summary(), history.largest("energy.contact"));
            assert!(held > 0.1 * history.first("energy.kinetic") && history.last("energy.contact") == 0.0, "{obstacle} {held}");
            assert!(history.last("energy.contact_damping") > 0.1 * history.first("energy.kinetic"), "{obstacle}: {summary:?}");
            assert!(summary.energy_drift < 1e-3 && summary.ledger_residual < 1e-12, "{obstacle}: {summary:?}");
        }
    }
}

#[test]
fn a_tied_pair_in_a_contact_of_bodies_is_named() {
    let mut model = model(1e-4);
    for (name, y) in [("upper", 0.1), ("lower", 0.0), ("far", -0.2)] {
        add(&mut model, name, rectangle([0.0, y], [0.1, 0.1], [5, 5]), [0.0, 0.0]);
    }
    all(&mut model);
    assert_eq!(simulation(&model).overview().contacts, [""; 0]);
    model.contacts.push(Contact { tied: Some(f64::INFINITY), ..Contact::between("glue", "upper.bottom", "lower.top") });
    let lines = simulation(&model).overview().contacts;
    assert_eq!(lines.len(), 1, "{lines:?}");
    assert!(lines[0].starts_with("all: 3 pairs of 3 parts; upper with lower is tied (by glue): what is tied is left out"), "{lines:?}");
    model.contacts[1].interface.active[1] = 5e-5;
    let lines = simulation(&model).overview().contacts;
    assert!(lines[0].contains("is tied (by glue): not all the time, so where they are pressed together both push"), "{lines:?}");
}
