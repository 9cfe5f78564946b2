//! Springs and point masses from the records of a file.

use crate::model_file::diagnostics::Faults;
use crate::model_file::reader::Record;
use embate_solver::model::{PointMass, Spring};

pub(super) fn spring(record: &Record, faults: &mut Faults) -> Spring {
    let names = record.texts("between");
    for key in ["between", "elongation", "force"] {
        if record.datum(key).is_none() {
            faults.cover(&record.key(key));
        }
    }
    Spring {
        between: [0, 1].map(|index| names.get(index).cloned().unwrap_or_default()),
        stiffness: if record.written("stiffness").is_some() { record.number("stiffness").unwrap_or(f64::NAN) } else { 0.0 },
        damping: record.number("damping").unwrap_or(f64::NAN),
        elongation: record.list("elongation"),
        force: record.list("force"),
        length: record.written("length").map(|_| record.number("length").unwrap_or(f64::NAN)),
        strength: record.written("strength").map(|_| record.number("strength").unwrap_or(f64::NAN)),
    }
}

pub(super) fn point_mass(record: &Record, faults: &mut Faults) -> PointMass {
    if record.datum("on").is_none() {
        faults.cover(&record.key("on"));
    }
    PointMass { on: record.text("on"), mass: record.number("mass").unwrap_or(f64::NAN) }
}
