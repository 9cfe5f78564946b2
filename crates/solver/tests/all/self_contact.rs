//! Surfaces that meet themselves, and many bodies in one contact: nothing is felt where nothing touches, and
//! nothing passes where something does.
#![allow(clippy::unwrap_used)] // what tests call may stop a test like the tests themselves

use crate::bodies::*;
use crate::long::is_long;
use embate_solver::contact::search::registry;
use embate_solver::model::{Contact, Disk, ImportedMesh, InitialPenetration, Model, Partners, Ring, Shape, Symmetry};
use embate_solver::simulation::{Options, Simulation};
use std::f64::consts::{PI, TAU};

/// Contact of all bodies with each other and with themselves.
pub(crate) fn all(model: &mut Model) {
    model.contacts.push(Contact { name: "all".into(), partners: Partners::Bodies(Vec::new()), ..Contact::default() });
}

fn ring(inner: f64, outer: f64, elements: [usize; 2]) -> Shape {
    Shape::Ring(Ring { centre: [0.0, 0.0], inner, outer, from: 0.0, to: TAU, elements, ..Ring::default() })
}

/// A wavy strip of one element through its wall: `folds` narrow bows of a sine.
fn serpentine(folds: usize, [height, pitch, wall]: [f64; 3], along: usize) -> ImportedMesh {
    mapped([along, 1], |u, v| {
        let phase = PI * folds as f64 * u;
        let (x, y) = (pitch * folds as f64 * u, 0.5 * height * phase.sin());
        let (dx, dy) = (pitch, 0.5 * height * PI * phase.cos());
        let length = dx.hypot(dy);
        [x - wall * v * dy / length, y + wall * v * dx / length]
    })
}

/// One body alone, in rest or motion: whatever its shape.
pub(crate) fn alone() -> Vec<(&'static str, Model)> {
    let with = |shape: Shape| {
        let mut model = model(2e-4);
        add(&mut model, "body", shape, [0.0, 0.0]);
        model
    };
    let with_mesh = |mesh| {
        let mut model = model(2e-4);
        add_mesh(&mut model, "body", mesh, [0.0, 0.0]);
        model
    };
    let star = closed_ring([1, 14], |u, v| {
        let (angle, k) = (TAU * u, (u * 14.0).round() as usize);
        let r = if k % 2 == 0 { 0.05 } else { 0.025 } + 0.006 * v;
        [r * angle.cos(), r * angle.sin()]
    });
    let slit = closed_ring([2, 40], |u, v| {
        // Nearly a full turn would be a sector; here the ring is an ellipse with a narrow inside.
        let angle = TAU * u;
        [(0.05 + 0.01 * v) * angle.cos(), (0.0004 + 0.01 * v) * angle.sin()]
    });
    vec![
        ("square", with(rectangle([0.0, 0.0], [0.1, 0.1], [4, 4]))),
        ("one element", with(rectangle([0.0, 0.0], [0.1, 0.02], [1, 1]))),
        ("foil", with(rectangle([0.0, 0.0], [0.1, 0.0005], [40, 1]))),
        ("fine on the short side", with(rectangle([0.0, 0.0], [0.1, 0.01], [5, 12]))),
        ("thin ring", with(ring(0.05, 0.0502, [1, 60]))),
        ("coarse ring", with(ring(0.02, 0.05, [2, 6]))),
        (
            "open ring",
            with(Shape::Ring(Ring {
                centre: [0.0, 0.0],
                inner: 0.04,
                outer: 0.05,
                from: 0.001,
                to: TAU - 0.001,
                elements: [2, 70],
                ..Ring::default()
            })),
        ),
        ("disk", with(Shape::Disk(Disk { centre: [0.0, 0.0], radius: 0.05, elements: 4 }))),
        ("star", with_mesh(star)),
        ("narrow inside", with_mesh(slit)),
        ("serpentine", with_mesh(serpentine(6, [0.012, 0.006, 0.0003], 150))),
    ]
}

#[test]
fn a_body_alone_does_not_feel_itself() {
    for (name, base) in alone() {
        for (kind, velocity, spin) in [("at rest", [0.0, 0.0], 0.0), ("fast", [900.0, -400.0], 0.0), ("spinning", [10.0, 0.0], 300.0)] {
            let mut plain = base.clone();
            plain.parts[0].velocity = embate_solver::model::in_3d(velocity);
            plain.parts[0].spin = spin;
            plain.run.energy_limit = 1.0;
            plain.run.max_steps = Some(300);
            let mut watched = plain.clone();
            all(&mut watched);
            let ((without, _), (with, history)) = (run(&plain), run(&watched));
            assert_eq!(history.largest("energy.contact"), 0.0, "{name} {kind}");
            assert_eq!(with.summary().state_hash, without.summary().state_hash, "{name} {kind}");
            assert!(with.overview().initial_penetrations.is_empty(), "{name} {kind}");
        }
    }
}

/// A thin ring between two heavy plates that crush it.
pub(crate) fn crushed_ring() -> Model {
    let mut model = model(2.6e-3);
    model.materials.insert("heavy".into(), elastic(1e10, 5e3));
    add(&mut model, "ring", ring(0.046, 0.05, [2, 72]), [0.0, 0.0]);
    add(&mut model, "above", rectangle([-0.08, 0.0501], [0.16, 0.02], [32, 4]), [0.0, -24.0]);
    add(&mut model, "below", rectangle([-0.08, -0.0701], [0.16, 0.02], [32, 4]), [0.0, 24.0]);
    for plate in &mut model.parts[1..] {
        plate.material = "heavy".into();
    }
    probe(&mut model, "top", "ring", [0.0, 0.046]);
    probe(&mut model, "bottom", "ring", [0.0, -0.046]);
    all(&mut model);
    model
}

/// A slender column with a slight bend, pressed together by heavy blocks: it buckles and folds up on itself.
pub(crate) fn folding_column() -> Model {
    let mut model = model(3e-3);
    model.materials.insert("heavy".into(), elastic(1e10, 1.5e3));
    let column = mapped([2, 160], |u, v| [0.0008 * (4.0 * PI * v).sin() + 0.0006 * (7.0 * PI * v).sin() + 0.002 * (u - 0.5), 0.16 * v]);
    add_mesh(&mut model, "column", column, [0.0, 0.0]);
    add(&mut model, "above", rectangle([-0.05, 0.16001], [0.1, 0.03], [20, 6]), [0.0, -30.0]);
    add(&mut model, "below", rectangle([-0.05, -0.03001], [0.1, 0.03], [20, 6]), [0.0, 30.0]);
    for block in &mut model.parts[1..] {
        block.material = "heavy".into();
    }
    all(&mut model);
    model
}

#[test]
fn a_ring_is_crushed_until_its_inside_touches_itself() {
    let (simulation, history) = run(&crushed_ring());
    let summary = simulation.summary();
    let apart: Vec<f64> = history.column("top.y").iter().zip(history.column("bottom.y")).map(|(top, bottom)| top - bottom).collect();
    let nearest = apart.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(nearest < 1e-4 && nearest > -3e-4, "{nearest}");
    assert_eq!(summary.contact.unverified, 0);
    assert!(summary.contact.crossings_found > 0 && summary.contact.pairs_swept > 1000);
    // Of a wall of 4 mm.
    assert!(summary.penetration_max < 3e-4, "{summary:?}");
    assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-12, "{summary:?}");
    assert!(summary.energy_drift < 0.01 && summary.ledger_residual < 1e-12, "{summary:?}");
}

#[test]
fn a_column_folds_up_on_itself() {
    let mut model = folding_column();
    probe(&mut model, "foot", "above", [0.0, 0.16]);
    probe(&mut model, "head", "below", [0.0, 0.0]);
    let (simulation, history) = run(&model);
    let summary = simulation.summary();
    assert_eq!(summary.contact.unverified, 0);
    // Of a wall of 2 mm.
    assert!(summary.penetration_max < 4e-4, "{summary:?}");
    let left =
        history.column("foot.y").iter().zip(history.column("head.y")).fold(f64::INFINITY, |left, (top, bottom)| left.min(top - bottom));
    assert!(left < 0.04, "{left} of 0.16 m is left");
    assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-12, "{summary:?}");
    assert!(summary.energy_drift < 0.02 && summary.ledger_residual < 1e-12, "{summary:?}");
}

/// Three blocks in a row, the outer ones of another stiffness.
fn three_in_a_row() -> Model {
    let mut model = model(4e-4);
    model.materials.insert("stiff".into(), elastic(3e10, 3e3));
    add(&mut model, "left", rectangle([0.0, 0.0], [0.05, 0.04], [7, 6]), [25.0, 0.0]);
    add(&mut model, "middle", rectangle([0.0502, -0.003], [0.02, 0.05], [4, 9]), [0.0, 0.0]);
    add(&mut model, "right", rectangle([0.0705, 0.0], [0.05, 0.04], [6, 5]), [-25.0, 2.0]);
    for outer in [0, 2] {
        model.parts[outer].material = "stiff".into();
    }
    model
}

#[test]
fn bodies_in_one_contact_feel_what_they_feel_in_pairs() {
    let mut together = three_in_a_row();
    all(&mut together);
    let mut pairs = three_in_a_row();
    for (first, second) in [("left", "middle"), ("middle", "right"), ("left", "right")] {
        touch(&mut pairs, first, second);
    }
    let ((one, a), (_, b)) = (run(&together), run(&pairs));
    assert!(a.largest("energy.contact") > 1.0 && one.summary().contact.unverified == 0);
    for column in ["energy.contact", "left.vx", "middle.vx", "right.vx", "right.vy"] {
        let (a, b) = (a.column(column), b.column(column));
        let largest = a.iter().fold(0.0f64, |largest, value| largest.max(value.abs()));
        let worst = a.iter().zip(&b).fold(0.0f64, |worst, (a, b)| worst.max((a - b).abs()));
        assert!(worst < 1e-9 * largest, "{column}: {worst} of {largest}");
    }
}

#[test]
fn a_soft_body_elsewhere_changes_nothing() {
    let scene = |third: bool| {
        let mut model = model(3e-4);
        add(&mut model, "lower", rectangle([0.0, 0.0], [0.1, 0.05], [9, 5]), [0.0, 0.0]);
        add(&mut model, "upper", rectangle([0.013, 0.0502], [0.07, 0.05], [8, 6]), [0.0, -20.0]);
        if third {
            model.materials.insert("jelly".into(), elastic(1e6, 1e3));
            add(&mut model, "jelly", rectangle([0.3, 0.0], [0.1, 0.05], [5, 5]), [0.0, 0.0]);
            model.parts[2].material = "jelly".into();
        }
        all(&mut model);
        run(&model)
    };
    let ((_, two), (_, three)) = (scene(false), scene(true));
    assert!(two.largest("energy.contact") > 1.0);
    for column in ["contact.energy[all]", "upper.vy", "lower.vx"] {
        let (two, three) = (two.column(column), three.column(column));
        let largest = two.iter().fold(0.0f64, |largest, value| largest.max(value.abs()));
        assert!(two.iter().zip(&three).all(|(a, b)| (a - b).abs() < 1e-9 * largest), "{column}");
    }
}

#[test]
fn a_corner_between_two_bodies_touches_both() {
    let mut model = model(1.5e-3);
    let square = mapped([5, 5], |u, v| [0.05 * (u - v), 0.003 + 0.055 * (u + v)]);
    add_mesh(&mut model, "square", square, [0.0, -18.0]);
    for (name, side) in [("left", -1.0), ("right", 1.0)] {
        // Slopes that nearly meet at the bottom of the notch.
        let slope = mapped([8, 4], |u, v| {
            let x = 0.001 + 0.12 * if side > 0.0 { u } else { 1.0 - u };
            [side * x, -0.08 + v * (0.08 + 0.6 * x)]
        });
        add_mesh(&mut model, name, slope, [0.0, 0.0]);
    }
    all(&mut model);
    let (simulation, history) = run(&model);
    let summary = simulation.summary();
    let (left, right) = (history.last("left.vx"), history.last("right.vx"));
    assert!(left < -0.1 && (left + right).abs() < 1e-6 * right.abs(), "{left} {right}");
    assert!(summary.contact.unverified == 0 && summary.penetration_max < 1e-3, "{summary:?}");
}

#[test]
fn every_search_gives_the_same_bits_of_self_contact() {
    let steps = if is_long() { 1000 } else { 400 };
    let mut fast = folding_column();
    fast.run.max_steps = Some(steps);
    fast.parts.iter_mut().for_each(|part| part.velocity = part.velocity.map(|v| 3.0 * v));
    let mut ring = crushed_ring();
    ring.run.max_steps = Some(steps);
    for (name, model) in [("ring", ring), ("column", fast)] {
        let mut hashes = vec![];
        for kind in registry::<2>() {
            let mut model = model.clone();
            model.contacts[0].search = kind.name.into();
            let (simulation, history) = run(&model);
            assert!(history.largest("energy.contact") > 0.0);
            let summary = simulation.summary();
            hashes.push((kind.name, summary.state_hash, summary.contact));
        }
        assert!(hashes.iter().all(|(_, hash, contact)| *hash == hashes[0].1 && *contact == hashes[0].2), "{name}: {hashes:?}");
    }
}

#[test]
fn threads_change_no_bit_of_self_contact() {
    // Enough nodes in reach for the threads to share them.
    let mut model = model(1.0);
    model.run.max_steps = Some(80);
    for layer in 0..3 {
        let name = format!("layer{layer}");
        let speed = 8.0 * f64::from(1 - layer);
        add(
            &mut model,
            &name,
            rectangle([0.001 * f64::from(layer), 0.00201 * f64::from(layer)], [2.0, 0.002], [1500, 1]),
            [3.0 * f64::from(layer), speed],
        );
    }
    all(&mut model);
    let of = |threads: usize| {
        let mut simulation = Simulation::new(&model, &Options { threads, simd: None }).unwrap();
        simulation.advance(f64::INFINITY, 80).unwrap();
        let summary = simulation.summary();
        assert_eq!(summary.threads, threads);
        (simulation.ledger().stores.contact.to_bits(), summary.state_hash, summary.contact)
    };
    let one = of(1);
    assert!(one.2.crossings_found > 4096, "{one:?}");
    for threads in [2, 3, 7] {
        assert_eq!(of(threads), one, "{threads} threads");
    }
}

#[test]
fn a_half_ring_meets_its_image_as_the_whole_ring_meets_itself() {
    let whole = crushed_ring();
    let mut half = whole.clone();
    half.parts.truncate(2);
    half.parts[0].shape =
        Shape::Ring(Ring { centre: [0.0, 0.0], inner: 0.046, outer: 0.05, from: 0.0, to: PI, elements: [2, 36], ..Ring::default() });
    half.probes.retain(|probe| probe.name != "below" && probe.name != "bottom" && probe.name != "ring");
    half.symmetries.push(Symmetry { normal: [0.0, 1.0, 0.0], ..Symmetry::default() });
    let thick = |model: &Model, thickness: f64| {
        let mut model = model.clone();
        model.contacts[0].interface.thickness = thickness;
        // The plates begin nearer than that.
        model.contacts[0].interface.initial_penetration = InitialPenetration::Ignore;
        model
    };
    for thickness in [0.0, 1e-3] {
        let ((whole, of_whole), (half, of_half)) = (run(&thick(&whole, thickness)), run(&thick(&half, thickness)));
        let top = |history: &History| history.column("top.y").into_iter().fold(f64::INFINITY, f64::min);
        let what = format!("{thickness}: {} {}; {} {}", top(&of_whole), top(&of_half), of_whole.last("above.vy"), of_half.last("above.vy"));
        // Both stop where the inside meets, 1.2e-4 deep without a thickness (40 % more with half of the
        // stiffness), and throw the plate back.
        assert!((top(&of_half) - top(&of_whole)).abs() < 1e-5 && (top(&of_half) - 0.5 * thickness).abs() < 2e-4, "{what}");
        // The whole ring does not stay quite symmetric.
        assert!((of_half.last("above.vy") / of_whole.last("above.vy") - 1.0).abs() < 0.03, "{what}");
        for simulation in [whole, half] {
            let summary = simulation.summary();
            assert!(
                summary.energy_drift < 0.01 && summary.ledger_residual < 1e-12 && summary.contact.unverified == 0,
                "{what} {summary:?}"
            );
        }
    }
}
