//! Contacts of a model from the records of a file: which surface is the slave, and what is wrong with it.

use crate::model_file::diagnostics::Faults;
use crate::model_file::reader::Record;
use crate::model_file::units::shorten;
use embate_solver::model::messages::{CLASH, UNKNOWN_NAME};
use embate_solver::model::{Contact, Formulation, Partners};

pub(super) fn contact(record: &Record, faults: &mut Faults) -> Contact {
    let mut contact = Contact::read(record);
    let between = if let Partners::Between(between) = &contact.partners { Some(between) } else { None };
    contact.formulation = formulation(record, between, faults);
    contact
}

fn formulation(record: &Record, between: Option<&[String; 2]>, faults: &mut Faults) -> Formulation {
    let (single, other) = match record.text("formulation").as_str() {
        "single_pass" => (true, Formulation::DoublePass),
        "segment" => (false, Formulation::Segment),
        "pinball" => (false, Formulation::Pinball),
        _ => (false, Formulation::DoublePass),
    };
    let Some(between) = between else {
        // Bodies have no slave; the check says so of single pass.
        if let Some(place) = record.written("slave") {
            let help = "leave it out: all nodes of all bodies are checked".to_string();
            faults.value(&CLASH, &record.key("slave"), place, ("`slave` is given, but bodies have none".to_string(), help));
        }
        return if single { Formulation::SinglePass { slave: 0 } } else { other };
    };
    let known = record.is_sound("formulation") && record.is_sound("between");
    let place = record.written("slave");
    match (single, place) {
        (false, None) => other,
        (false, Some(place)) => {
            if known {
                let help = "add `formulation = \"single_pass\"`, or leave `slave` out";
                let message = match other {
                    Formulation::DoublePass => "`slave` is given, but in a double pass contact both surfaces are slaves",
                    _ => "`slave` is given, but in this formulation both surfaces are alike",
                };
                faults.value(&CLASH, &record.key("slave"), place, (message.to_string(), help.to_string()));
            }
            other
        }
        (true, None) => {
            let help = format!("add `slave = {}`: usually the surface with the finer mesh or the softer body", shorten(&between[0]));
            faults.beside(&CLASH, &record.path, record.written("formulation"), ("a single pass contact needs `slave`".to_string(), help));
            Formulation::SinglePass { slave: 0 }
        }
        (true, Some(place)) => {
            let slave = record.text("slave");
            let index = between.iter().position(|name| *name == slave);
            if index.is_none() && known && record.is_sound("slave") {
                let message = format!("the slave {} is not one of the two surfaces", shorten(&slave));
                let help = format!("take {} or {}", shorten(&between[0]), shorten(&between[1]));
                faults.value(&UNKNOWN_NAME, &record.key("slave"), place, (message, help));
            }
            Formulation::SinglePass { slave: index.unwrap_or(0) }
        }
    }
}
