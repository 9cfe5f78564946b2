//! What is tied is left out of a contact of bodies: the tie alone holds it, and where it breaks the contact
//! keeps the bodies apart as ever.

use crate::bodies::*;
use embate_solver::model::{
    Contact, ContactLaw, Cuboid, Formulation, InitialPenetration, Interface, Model, Part, Partners, Penalty, Run, Shape,
};
use embate_solver::simulation::Simulation;

const FORMULATIONS: [Formulation; 3] = [Formulation::DoublePass, Formulation::Segment, Formulation::Pinball];
const TIES: [Formulation; 3] = [Formulation::DoublePass, Formulation::SinglePass { slave: 1 }, Formulation::Segment];

/// An upper block that comes down on a lower one, to which it is tied, with meshes that don't match; the
/// lower one is wider by `wider`, m, on both sides.
fn plane(tie: Formulation, strength: f64, wider: f64) -> Model {
    let mut model = model(4e-4);
    add(&mut model, "upper", rectangle([0.0, 0.1], [0.1, 0.1], [7, 5]), [2.0, -5.0]);
    add(&mut model, "lower", rectangle([-wider, 0.0], [0.1 + 2.0 * wider, 0.1], [8, 5]), [0.0, 0.0]);
    glue(&mut model, tie, strength, ["upper.bottom", "lower.top"]);
    model
}

/// The same in 3D.
fn solid(tie: Formulation, strength: f64, wider: f64) -> Model {
    let mut model = slender(3e-4, 1e9, 1000.0);
    let wide = 0.1 + 2.0 * wider;
    for (name, corner, size, elements, velocity) in [
        ("upper", [0.0, 0.0, 0.1], [0.1, 0.1, 0.05], [4, 3, 2], [2.0, 0.0, -5.0]),
        ("lower", [-wider, -wider, 0.0], [wide, wide, 0.1], [4, 5, 3], [0.0; 3]),
    ] {
        let shape = Shape::Cuboid(Cuboid { corner, size, elements, ..Cuboid::default() });
        model.parts.push(Part { name: name.into(), material: "soft".into(), element: "hex8".into(), shape, velocity, ..Part::default() });
    }
    glue(&mut model, tie, strength, ["upper.back", "lower.front"]);
    model
}

fn glue(model: &mut Model, tie: Formulation, strength: f64, between: [&str; 2]) {
    let interface = Interface { law: ContactLaw::Penalty(Penalty::automatic(1.0)), ..Interface::default() };
    model.contacts.push(Contact { tied: Some(strength), formulation: tie, interface, ..Contact::between("glue", between[0], between[1]) });
}

/// With a contact of all bodies, which has friction.
fn with_all(mut model: Model, formulation: Formulation) -> Model {
    let interface = Interface { initial_penetration: InitialPenetration::Ignore, ..rough(0.3) };
    model.contacts.push(Contact {
        name: "all".into(),
        formulation,
        interface,
        partners: Partners::Bodies(Vec::new()),
        ..Contact::default()
    });
    model
}

fn most(history: &History, name: &str) -> f64 {
    history.column(name).into_iter().fold(0.0, |most: f64, force| most.max(force.abs()))
}

fn has_broken(simulation: &Simulation) -> bool {
    simulation.summary().warnings.iter().any(|warning| warning.text.contains("ties broke"))
}

fn is_sound(simulation: &Simulation, case: &str) {
    let summary = simulation.summary();
    let [linear, angular] = [summary.momentum_drift_linear, summary.momentum_drift_angular].map(|drift| drift.unwrap());
    println!("{case}: momenta {linear:.1e} {angular:.1e}, ledger {:.1e}, energy {:.1e}", summary.ledger_residual, summary.energy_drift);
    assert!(linear < 1e-12 && angular < 1e-12 && summary.ledger_residual < 1e-11, "{case}: {linear} {angular} {summary:?}");
}

/// Makes a model of a formulation of the tie, its strength (Pa), and how much wider the lower block is (m).
type Make = fn(Formulation, f64, f64) -> Model;

/// Both models, and the axis along which their blocks come together.
const MODELS: [(Make, &str); 2] = [(plane, "y"), (solid, "z")];

#[test]
fn what_is_tied_moves_as_without_the_contact_of_bodies() {
    for (make, up) in MODELS {
        // Where the slave is wider than the target the target's rim lies on facets that are not tied as a
        // whole.
        let cases = TIES.map(|tie| (tie, 0.0)).into_iter().chain([(Formulation::DoublePass, 0.02)]);
        for (tie, wider) in cases {
            let alone = make(tie, f64::INFINITY, wider);
            let (without, history) = run(&alone);
            let force = most(&history, &format!("contact.force_{up}[glue]"));
            for formulation in FORMULATIONS {
                let (with, history) = run(&with_all(alone.clone(), formulation));
                let case = format!("{up} {tie:?} {wider} {formulation:?}");
                let pressed = most(&history, "contact.energy[all]").max(most(&history, &format!("contact.force_{up}[all:upper-lower]")));
                let apart =
                    with.coordinates().into_iter().zip(without.coordinates()).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
                println!("{case}: {pressed:e} of {force:e}, {apart:e}");
                // Segments of the lateral sides, which are flush, meet at the corners of the interface.
                assert!(pressed < 1e-6 * force && apart < 1e-9, "{case}: {pressed} of {force}, {apart}");
                is_sound(&with, &case);
            }
        }
    }
}

#[test]
fn a_tie_breaks_as_without_the_contact_of_bodies_which_then_keeps_the_bodies_apart() {
    // Pressed and sheared at once: what breaks is pressed together.
    for (make, up) in MODELS {
        for tie in TIES {
            let mut alone = make(tie, 2e6, 0.0);
            alone.run.energy_limit = 1.0;
            alone.parts[0].velocity = alone.parts[0].velocity.map(|v| 2.0 * v);
            let broken = |model: &Model| {
                let mut simulation = simulation(model);
                while !has_broken(&simulation) && !simulation.is_over() {
                    simulation.advance(f64::INFINITY, 1).unwrap();
                }
                assert!(has_broken(&simulation), "{up} {tie:?}: nothing breaks");
                simulation.steps()
            };
            let first = broken(&alone);
            let drift = to_end(&alone).summary().energy_drift;
            for formulation in FORMULATIONS {
                let model = with_all(alone.clone(), formulation);
                let case = format!("{up} {tie:?} {formulation:?} breaks");
                assert_eq!(broken(&model), first, "{case}");
                let (simulation, history) = run(&model);
                let pressed = most(&history, &format!("contact.force_{up}[all:upper-lower]"));
                println!("{case}: step {first}, {pressed:e}, drift {drift:e} without the contact");
                is_sound(&simulation, &case);
                assert!(simulation.summary().energy_drift < drift + 5e-3, "{case}");
            }
        }
    }
}

#[test]
fn threads_and_stops_change_no_bit_of_ties_in_a_contact_of_bodies() {
    for tie in [Formulation::DoublePass, Formulation::Segment] {
        for model in [with_all(plane(tie, 2e6, 0.02), Formulation::DoublePass), with_all(solid(tie, 2e6, 0.02), Formulation::DoublePass)] {
            let (model, case) = (Model { run: Run { energy_limit: 1.0, ..model.run.clone() }, ..model }, format!("{tie:?}"));
            println!("{case}: drift {:e}", to_end(&model).summary().energy_drift);
            let hash = hash_of_equal_bits(&model, &[1, 3], &case);
            let mut run = simulation(&model);
            for steps in [5, 40, 40] {
                run.advance(f64::INFINITY, steps).unwrap();
                continues_to(&hash, &model, &mut run, &case);
            }
        }
    }
}
