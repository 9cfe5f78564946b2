//! Every formulation with every law: momentum, energy, closed forms, objectivity; ties that hold and break.

use crate::bodies::*;
use crate::contact::scenes;
use embate_solver::model::{ContactLaw, Formulation, Friction, Model};

const FRICTION: Friction = Friction { coefficient: 0.3, dynamic: None, decay: 0.0, viscosity: 0.0, limit: f64::INFINITY };

fn with(mut model: Model, formulation: Formulation) -> Model {
    model.contacts.iter_mut().for_each(|contact| contact.formulation = formulation);
    model
}

fn laws() -> Vec<(&'static str, ContactLaw)> {
    let soft_layer = ContactLaw::PressureGap { gaps: vec![-1e-3, -2e-4, 1e-4], pressures: vec![3e8, 2e7, 0.0] };
    vec![("penalty", ContactLaw::default()), ("pressure_gap", soft_layer), ("multiplier", ContactLaw::Multiplier)]
}

#[test]
fn momentum_is_kept_and_the_books_close_with_every_law_and_formulation() {
    for formulation in [Formulation::Pinball] {
        for (law_name, law) in laws() {
            for friction in [None, Some(FRICTION)] {
                for (name, model, segment) in scenes() {
                    let mut model = with(model, formulation);
                    for contact in &mut model.contacts {
                        (contact.interface.law, contact.interface.friction) = (law.clone(), friction);
                    }
                    model.run.energy_limit = 1.0;
                    let (simulation, history) = run(&model);
                    let summary = simulation.summary();
                    let what = format!("{formulation:?} {law_name} {name} {friction:?}");
                    println!(
                        "{what}: {:?} {:?} lin {:.1e} ang {:.1e} drift {:.2e} res {:.1e} pen {:.1e} of {segment}",
                        history.largest("energy.contact"),
                        simulation.sweeps(),
                        summary.momentum_drift_linear.unwrap(),
                        summary.momentum_drift_angular.unwrap(),
                        summary.energy_drift,
                        summary.ledger_residual,
                        summary.penetration_max
                    );
                }
            }
        }
    }
}
