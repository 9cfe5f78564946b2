//! Surfaces that meet themselves, and many bodies in one contact: nothing is felt where nothing touches, and nothing passes where something does.
#![allow(clippy::unwrap_used)] // what tests call may stop a test like the tests themselves

use crate::bodies::*;
use embate_solver::contact::search::registry;
use embate_solver::model::{
    Contact, Drive, Formulation, ImportedMesh, Interface, Model, Motion, Obstacle, ObstacleShape, Partners, Penalty, Shape,
};
use embate_solver::simulation::{Options, Simulation};
use std::f64::consts::TAU;

/// Contact of all bodies with each other and with themselves.
fn all(model: &mut Model) {
    model.contacts.push(Contact { name: "all".into(), partners: Partners::Bodies(Vec::new()), ..Contact::default() });
}

fn ring(inner: f64, outer: f64, elements: [usize; 2]) -> Shape {
    Shape::Ring { centre: [0.0, 0.0], inner, outer, from: 0.0, to: TAU, elements }
}

/// A wavy strip of one element through its wall: `folds` narrow bows of a sine.
fn serpentine(folds: usize, [height, pitch, wall]: [f64; 3], along: usize) -> ImportedMesh {
    mapped([along, 1], |u, v| {
        let phase = std::f64::consts::PI * folds as f64 * u;
        let (x, y) = (pitch * folds as f64 * u, 0.5 * height * phase.sin());
        let (dx, dy) = (pitch, 0.5 * height * std::f64::consts::PI * phase.cos());
        let length = dx.hypot(dy);
        [x - wall * v * dy / length, y + wall * v * dx / length]
    })
}

/// One body alone, in rest or motion: whatever its shape.
fn alone() -> Vec<(&'static str, Model)> {
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
        ("open ring", with(Shape::Ring { centre: [0.0, 0.0], inner: 0.04, outer: 0.05, from: 0.001, to: TAU - 0.001, elements: [2, 70] })),
        ("disk", with(Shape::Disk { centre: [0.0, 0.0], radius: 0.05, elements: 4 })),
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
            plain.parts[0].velocity = velocity;
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
