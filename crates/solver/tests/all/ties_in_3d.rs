//! Ties between solids: they hold what touches at the start, whatever the meshes and the motion, up to their
//! strength.

use crate::bodies::*;
use embate_solver::error::Error;
use embate_solver::model::{
    Contact, ContactLaw, Cuboid, Formulation, InitialPenetration, Interface, Model, Part, Penalty, Probe, ProbeAt, Shape,
};
use embate_solver::simulation::{Options, Simulation};

const FORMULATIONS: [Formulation; 3] = [Formulation::DoublePass, Formulation::SinglePass { slave: 1 }, Formulation::Segment];

fn block(model: &mut Model, name: &str, corner: [f64; 3], size: [f64; 3], elements: [usize; 3], velocity: [f64; 3]) {
    let shape = Shape::Cuboid(Cuboid { corner, size, elements, ..Cuboid::default() });
    model.parts.push(Part { name: name.into(), material: "soft".into(), element: "hex8".into(), shape, velocity, ..Part::default() });
    model.probes.push(Probe { name: name.into(), at: ProbeAt::Set { set: name.into() }, ..Probe::default() });
}

/// Two tied bars that fly apart at 2 v: the tie is pulled with ρ c v. Turned as a whole by an angle (rad)
/// about an axis.
fn tied_bars(formulation: Formulation, strength: f64, law: ContactLaw, angle: f64) -> Model {
    let mut model = slender(1.5e-4, 1e9, 1000.0);
    // Meshes that don't match, and a little apart: that stays so.
    block(&mut model, "left", [-0.1, 0.0, 0.0], [0.1, 0.04, 0.03], [20, 3, 2], [0.0; 3]);
    block(&mut model, "right", [1e-4, 0.0, 0.0], [0.1, 0.04, 0.03], [20, 4, 3], [0.0; 3]);
    let axis = [0.3, -1.0, 0.5];
    let along = rotated(axis, angle, [1.0, 0.0, 0.0]);
    for (part, speed) in model.parts.iter_mut().zip([-10.0, 10.0]) {
        (part.placement.rotation, part.placement.rotation_axis) = (angle, axis);
        part.velocity = along.map(|a| speed * a);
    }
    model.contacts.push(Contact {
        tied: Some(strength),
        formulation,
        interface: Interface { law, ..Interface::default() },
        ..Contact::between("glue", "right", "left")
    });
    model
}

/// A vector turned about an axis.
fn rotated(axis: [f64; 3], angle: f64, v: [f64; 3]) -> [f64; 3] {
    let size = axis.iter().map(|a| a * a).sum::<f64>().sqrt();
    let n = axis.map(|a| a / size);
    let cross = [n[1] * v[2] - n[2] * v[1], n[2] * v[0] - n[0] * v[2], n[0] * v[1] - n[1] * v[0]];
    let along = (0..3).map(|d| n[d] * v[d]).sum::<f64>();
    [0, 1, 2].map(|d| angle.cos() * v[d] + angle.sin() * cross[d] + (1.0 - angle.cos()) * along * n[d])
}

fn is_sound(simulation: &Simulation, case: &str) {
    let summary = simulation.summary();
    let [linear, angular] = [summary.momentum_drift_linear, summary.momentum_drift_angular].map(|drift| drift.unwrap());
    println!("{case}: momenta {linear:.1e} {angular:.1e}, ledger {:.1e}, energy {:.1e}", summary.ledger_residual, summary.energy_drift);
    assert!(linear < 1e-12 && angular < 1e-12, "{case}: {linear} {angular}");
    assert!(summary.ledger_residual < 1e-11 && summary.energy_drift < 0.01, "{case}: {} {}", summary.ledger_residual, summary.energy_drift);
}

#[test]
fn ties_between_solids_hold_up_to_their_strength_and_break_beyond_it() {
    let traction = 1000.0 * 1000.0 * 10.0;
    // A tie of the elements' stiffness would be late by ρ c / 2 κ.
    let stiff = ContactLaw::Penalty(Penalty::automatic(10.0));
    // Nodes of the first surface, or what 4 × 3 and 3 × 2 facets have in common.
    for (formulation, law, count) in [
        (Formulation::DoublePass, stiff.clone(), 20),
        (Formulation::DoublePass, ContactLaw::Multiplier, 20),
        (Formulation::Segment, stiff, 24),
    ] {
        for angle in [0.0, 0.7] {
            let held = |strength: f64| {
                let (simulation, history) = run(&tied_bars(formulation, strength, law.clone(), angle));
                is_sound(&simulation, &format!("{formulation:?} {law:?} {angle} {strength:e}"));
                let speed = ["vx", "vy", "vz"].map(|v| history.last(&format!("right.{v}")).powi(2)).iter().sum::<f64>().sqrt();
                (speed, simulation.summary().warnings)
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
fn a_spinning_body_of_tied_halves_turns_as_one_and_keeps_both_momenta_and_its_energy() {
    for formulation in FORMULATIONS {
        let mut model = model(0.02);
        block(&mut model, "left", [-0.1, -0.02, 0.0], [0.1, 0.1, 0.06], [3, 4, 2], [0.0; 3]);
        block(&mut model, "right", [0.0, 0.0, 0.01], [0.1, 0.04, 0.04], [3, 2, 3], [0.0; 3]);
        // Both turn about the same point, as one.
        let (spin, centre) = (100.0, [0.0, 0.02, 0.03]);
        model.contacts.push(Contact { tied: Some(f64::INFINITY), formulation, ..Contact::between("glue", "right", "left") });
        let middles = [[-0.05, 0.03, 0.03], [0.05, 0.02, 0.03]];
        for (part, middle) in model.parts.iter_mut().zip(middles) {
            part.spin = spin;
            part.velocity = [-spin * (middle[1] - centre[1]), spin * (middle[0] - centre[0]), 3.0];
        }
        let (simulation, history) = run(&model);
        is_sound(&simulation, &format!("{formulation:?}"));
        let ties = simulation.frame();
        assert!(!ties.positions::<3>().is_empty());
        // Their middles stay as far from each other as they were, to what the spin stretches; they have
        // turned by 2 rad.
        let apart = ["x", "y", "z"].map(|x| history.last(&format!("right.{x}")) - history.last(&format!("left.{x}")));
        let size = apart.iter().map(|a| a * a).sum::<f64>().sqrt();
        let turned = apart[1].atan2(apart[0]) - (-0.01f64).atan2(0.1);
        println!("{formulation:?}: {size} {turned} {apart:?}");
        assert!((size / 0.1f64.hypot(0.01) - 1.0).abs() < 0.01, "{size}");
        assert!((turned - 2.0).abs() < 0.02 && apart[2].abs() < 1e-3, "{turned} {apart:?}");
    }
}

#[test]
fn ties_of_unlike_meshes_slide_and_open_by_no_more_than_the_springs_give() {
    FORMULATIONS.into_iter().for_each(is_sheared_and_held);
}

fn is_sheared_and_held(formulation: Formulation) {
    // Sheared and twisted by what pulls at the far end: what is tied follows.
    let mut model = model(2e-3);
    block(&mut model, "lower", [0.0; 3], [0.1, 0.1, 0.05], [4, 4, 2], [0.0; 3]);
    block(&mut model, "upper", [0.01, 0.02, 0.05], [0.08, 0.07, 0.05], [3, 5, 2], [2.0, -1.0, 3.0]);
    let glue = Contact { tied: Some(f64::INFINITY), formulation, ..Contact::between("glue", "upper.back", "lower.front") };
    model.contacts.push(Contact { interface: Penalty::automatic(100.0).into(), ..glue });
    let (simulation, history) = run(&model);
    is_sound(&simulation, &format!("{formulation:?} sheared"));
    let apart = |x: &str| history.last(&format!("upper.{x}")) - history.last(&format!("lower.{x}"));
    let off = ["x", "y", "z"].map(apart);
    // Loose they would be 7 mm farther apart.
    let size = off.iter().map(|a| a * a).sum::<f64>().sqrt();
    println!("{formulation:?}: {off:?} {size}");
    assert!((size - 0.05f64.hypot(0.005)).abs() < 3e-4 && off[0] > 1e-3, "{off:?}");
}

#[test]
fn a_broken_tie_between_solids_is_ordinary_contact() {
    is_torn_and_hit(Formulation::DoublePass, 20);
    is_torn_and_hit(Formulation::Segment, 24);
}

fn is_torn_and_hit(formulation: Formulation, count: usize) {
    let mut model = tied_bars(formulation, 1e5, ContactLaw::default(), 0.0);
    model.run.end = 6e-4;
    block(&mut model, "hammer", [0.104, -0.005, -0.005], [0.1, 0.05, 0.04], [20, 3, 2], [-60.0, 0.0, 0.0]);
    model.contacts.push(Contact::between("blow", "right", "hammer"));
    let (simulation, history) = run(&model);
    is_sound(&simulation, &format!("{formulation:?} torn"));
    let summary = simulation.summary();
    assert!(
        summary.warnings.iter().any(|warning| warning.text.contains(&format!("{count} of {count} ties broke"))),
        "{:?}",
        summary.warnings
    );
    assert!(history.last("left.vx") < -20.0, "{}", history.last("left.vx"));
    // Elements are 5 mm long.
    let depths = |history: &History| ["glue", "blow"].map(|name| history.largest(&format!("contact.penetration[{name}]")));
    println!("{:?}", depths(&history));
    model.contacts[0].tied = None;
    let never_tied = depths(&run(&model).1);
    println!("never tied: {never_tied:?}");
    // Segments report the depth of pairs at corners too.
    assert!(summary.penetration_max < f64::max(2e-3, 1.01 * never_tied[0]), "{:?}", depths(&history));
}

#[test]
fn ties_between_solids_that_bind_nothing_or_a_node_twice_are_reported() {
    let faults = |model: &Model| match Simulation::new(model, &Options::default()) {
        Err(Error::Model(faults)) => faults.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"),
        other => panic!("{:?}", other.err()),
    };
    for formulation in FORMULATIONS {
        let mut apart = tied_bars(formulation, f64::INFINITY, ContactLaw::default(), 0.0);
        block(&mut apart, "far", [0.5, 0.0, 0.0], [0.1; 3], [2; 3], [0.0; 3]);
        apart.contacts.push(Contact { tied: Some(1.0), formulation, ..Contact::between("loose", "far", "left") });
        let reported = faults(&apart);
        assert!(reported.contains("contact[1].tied") && reported.contains("binds nothing"), "{reported}");
    }
    let mut twice = tied_bars(Formulation::DoublePass, f64::INFINITY, ContactLaw::default(), 0.0);
    block(&mut twice, "third", [-0.1, 0.0401, 0.0], [0.3, 0.02, 0.03], [12, 2, 2], [0.0; 3]);
    twice.contacts.push(Contact { tied: Some(1.0), ..Contact::between("second", "right", "third") });
    let reported = faults(&twice);
    assert!(
        reported.contains("contact[1].tied") && reported.contains("tied already by contact \"glue\"") && reported.contains("node at ("),
        "{reported}"
    );
}

#[test]
fn ties_between_solids_continue_from_a_kept_state_and_begin_at_their_birth() {
    let cases = FORMULATIONS.into_iter().flat_map(|formulation| [[0.0, f64::INFINITY], [3e-5, 1e-4]].map(|active| (formulation, active)));
    for (formulation, active) in cases {
        let mut model = tied_bars(formulation, 4e6, ContactLaw::default(), 0.3);
        model.contacts[0].interface.active = active;
        model.contacts[0].interface.initial_penetration = InitialPenetration::Ignore;
        model.contacts[0].interface.thickness = 1e-3;
        let whole = to_end(&model).summary().state_hash;
        for until in [1e-5, 5e-5, 1.2e-4] {
            let mut first = simulation(&model);
            first.advance(until, u64::MAX).unwrap();
            let state = first.state().unwrap();
            let mut second = Simulation::resumed(&model, &Options { threads: 2, simd: None }, &state.sections).unwrap();
            second.advance(f64::INFINITY, u64::MAX).unwrap();
            assert_eq!(second.summary().state_hash, whole, "{formulation:?} {active:?} {until}");
        }
    }
}
