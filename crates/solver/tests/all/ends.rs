//! Where faces end: bodies that end flush stay in contact at their corners, what slides down beside a body is
//! not caught by its top, and what leaves a face at a sharp edge gives its energy back.
#![allow(clippy::unwrap_used)] // what tests call may stop a test like the tests themselves

use crate::bodies::*;
use embate_solver::model::{Constraint, Formulation, Friction, Material, Model};

const FORMULATIONS: [Formulation; 4] =
    [Formulation::DoublePass, Formulation::SinglePass { slave: 0 }, Formulation::SinglePass { slave: 1 }, Formulation::Segment];
/// Named sides, which are cut off at their ends, and whole outsides, which have sharp edges there.
const SIDES: [(&str, &str); 3] = [("lower.top", "upper.bottom"), ("lower", "upper"), ("lower", "upper.bottom")];

/// A block that falls on another one of the same height; wider than that by `wider` (m) on both sides.
fn flush(wider: f64, sides: (&str, &str), formulation: Formulation) -> Model {
    let mut model = slender(8e-5, 1e9, 1e3);
    add(&mut model, "lower", rectangle([0.0, 0.0], [0.1, 0.05], [5, 3]), [0.0, 0.0]);
    add(&mut model, "upper", rectangle([-wider, 0.05005], [0.1 + 2.0 * wider, 0.05], [5, 3]), [0.0, -10.0]);
    touch(&mut model, sides.0, sides.1);
    model.contacts[0].formulation = formulation;
    for (name, part, place) in [("lower_end", "lower", [0.1, 0.05]), ("lower_middle", "lower", [0.06, 0.05])] {
        probe(&mut model, name, part, place);
    }
    let stretch = 1.0 + 20.0 * wider;
    probe(&mut model, "upper_end", "upper", [0.1 + wider, 0.05005]);
    probe(&mut model, "upper_middle", "upper", [0.06 * stretch - wider, 0.05005]);
    model
}

#[test]
fn blocks_that_end_flush_stay_in_contact_at_their_corners() {
    for sides in SIDES {
        for formulation in FORMULATIONS {
            // Round-off, and 1 % of a segment.
            for wider in [0.0, 1e-9, -1e-9, 2e-4, -2e-4] {
                let (simulation, history) = run(&flush(wider, sides, formulation));
                let what = format!("{sides:?} {formulation:?} {wider}");
                let summary = simulation.summary();
                assert!(summary.penetration_max > 3e-5, "{what}: they met, {summary:?}");
                assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-12, "{what}");
                assert!(summary.ledger_residual < 1e-12 && simulation.summary().contact.unverified == 0, "{what}");
                for name in ["lower", "upper"] {
                    let column = |place: &str| history.column(&format!("{name}_{place}.y"));
                    let start = column("middle")[0];
                    let moved = column("middle").iter().fold(0.0_f64, |most, y| most.max((y - start).abs()));
                    let off = column("end").iter().zip(column("middle")).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
                    // Springs of equal areas: the corner with its half of the mass moves as the others do,
                    // though it has a side wall too.
                    let bound = if wider.abs() > 1e-6 {
                        0.1
                    } else if formulation == Formulation::Segment {
                        // Of whole outsides the side walls take a little part as soon as they are not quite
                        // upright.
                        0.01
                    } else {
                        1e-5
                    };
                    assert!(moved > 1e-4 && off < bound * summary.penetration_max, "{what}: {name} {off} of {}", summary.penetration_max);
                }
            }
        }
    }
}

#[test]
fn a_block_that_slides_down_beside_another_is_not_caught() {
    for formulation in FORMULATIONS {
        for gap in [0.0, 1e-9, 1e-6, 2e-4] {
            for (angle, sides) in [(0.0, SIDES[0]), (0.0, SIDES[1]), (0.0, SIDES[2]), (0.3, SIDES[1]), (0.7, SIDES[1])] {
                let (sin, cos) = f64::sin_cos(angle);
                let turned = move |[x, y]: [f64; 2]| [cos * x - sin * y, sin * x + cos * y];
                let mut model = slender(1e-3, 1e9, 1e3);
                if angle == 0.0 {
                    add(&mut model, "lower", rectangle([0.0, 0.0], [0.1, 0.05], [5, 3]), [0.0, 0.0]);
                    add(&mut model, "upper", rectangle([0.1 + gap, 0.0505], [0.1, 0.05], [5, 3]), [0.0, -10.0]);
                } else {
                    let block = |corner: [f64; 2]| mapped([5, 3], move |u, v| turned([corner[0] + 0.1 * u, corner[1] + 0.05 * v]));
                    add_mesh(&mut model, "lower", block([0.0, 0.0]), [0.0, 0.0]);
                    add_mesh(&mut model, "upper", block([0.1 + gap, 0.0505]), turned([0.0, -10.0]));
                }
                touch(&mut model, sides.0, sides.1);
                model.contacts[0].formulation = formulation;
                let (simulation, history) = run(&model);
                let what = format!("{formulation:?} {gap} {angle} {sides:?}");
                let energy = history.largest("energy.contact");
                assert!(energy <= 1e-12 * history.first("energy.kinetic"), "{what}: {energy}");
                let speed = turned([0.0, -10.0])[1];
                assert!((history.last("upper.vy") - speed).abs() < 1e-6, "{what}: {}", history.last("upper.vy"));
                assert_eq!(simulation.summary().contact.unverified, 0, "{what}");
            }
        }
    }
}

/// A block with a named bottom that falls on the corner of another one.
fn on_a_corner(x: f64, velocity: [f64; 2]) -> Model {
    let mut model = model(4e-3);
    model.materials.insert("soft".into(), Material { law: "neo_hookean".into(), ..elastic(1e9, 1e3) });
    add(&mut model, "lower", rectangle([-0.05, 0.0], [0.06, 0.1], [6, 10]), [0.0, 0.0]);
    add(&mut model, "upper", rectangle([x, 0.1002], [0.15, 0.06], [15, 6]), velocity);
    touch(&mut model, "lower", "upper.bottom");
    model.constraints.push(Constraint {
        on: "lower.bottom".into(),
        velocity: [Some(0.0.into()), Some(0.0.into()), None],
        ..Constraint::default()
    });
    model
}

#[test]
fn what_leaves_a_face_at_a_sharp_edge_gives_its_energy_back() {
    // A corner pressed into a named bottom, nodes of which slide over the edge; before faces fell off at
    // their ends these drifts were 2e-2, 1e-2, 3e-3, 2e-2.
    for (x, velocity) in [(-0.0451, [-3.0, -20.0]), (-0.0449, [-3.0, -20.0]), (-0.0499, [0.0, -20.0]), (-0.0501, [0.0, -60.0])] {
        for friction in [None, Some(Friction { coefficient: 0.3, dynamic: None, decay: 0.0, viscosity: 0.0, limit: f64::INFINITY })] {
            let mut model = on_a_corner(x, velocity);
            model.contacts[0].interface.friction = friction;
            let (simulation, history) = run(&model);
            let summary = simulation.summary();
            let what = format!("{x} {velocity:?} {}: {summary:?}", friction.is_some());
            assert!(history.largest("energy.contact") > 0.0 && summary.contact.unverified == 0, "{what}");
            let limit = if velocity[1] < -50.0 { 8e-3 } else { 2e-3 };
            assert!(summary.energy_drift < limit && summary.ledger_residual < 1e-12, "{what}");
        }
    }
}
