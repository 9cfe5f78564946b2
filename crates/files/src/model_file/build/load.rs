//! What acts on bodies from outside, from the records of a file: loads, boundaries that reflect nothing,
//! joins.

use super::motion;
use crate::model_file::diagnostics::Faults;
use crate::model_file::reader::Record;
use embate_solver::model::{Image, Join, Load, NonReflecting};

pub(super) fn load(record: &Record, faults: &mut Faults) -> Load {
    let (parts, on) = (record.texts("parts"), record.text("on"));
    let curve = record.datum("curve").map(|_| record.text("curve"));
    let number = |name| record.number(name).unwrap_or(f64::NAN);
    let kinds = ["gravity", "centrifugal", "force", "pressure", "damping", "damping_stiffness"];
    let kind = kinds.into_iter().find(|name| record.written(name).is_some());
    if record.datum("on").is_none() {
        faults.cover(&record.key("on"));
    }
    match kind {
        Some("centrifugal") => Load::Centrifugal { parts, about: motion::axis(record), speed: number("centrifugal"), curve },
        Some("force") => Load::Force { on, force: record.spatial("force"), curve },
        Some("pressure") => Load::Pressure { on, pressure: number("pressure"), curve },
        Some("damping") => Load::Damping { parts, rate: number("damping"), active: motion::window(record, ["from", "until"], faults) },
        Some("damping_stiffness") => Load::StiffnessDamping { parts, time: number("damping_stiffness") },
        gravity => {
            if gravity.is_none() {
                faults.cover(&record.key("gravity"));
            }
            Load::Gravity { parts, acceleration: record.spatial("gravity"), curve }
        }
    }
}

pub(super) fn non_reflecting(record: &Record) -> NonReflecting {
    NonReflecting { on: record.text("on") }
}

pub(super) fn join(record: &Record, faults: &mut Faults) -> Join {
    let names = record.texts("between");
    if record.datum("between").is_none() {
        faults.cover(&record.key("between"));
    }
    let image = if record.written("rotation").is_some() {
        Image::Turned { about: motion::axis(record), angle: record.number("rotation").unwrap_or(f64::NAN) }
    } else if record.written("translation").is_some() {
        Image::Translated(record.spatial("translation"))
    } else {
        Image::Same
    };
    let tolerance = record.written("tolerance").map(|_| record.number("tolerance").unwrap_or(f64::NAN));
    Join { between: [0, 1].map(|index| names.get(index).cloned().unwrap_or_default()), image, tolerance }
}
