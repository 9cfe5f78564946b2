//! What moves bodies from outside, from the records of a file: rigid parts and obstacles, constraints, loads, curves.

use crate::model_file::diagnostics::Faults;
use crate::model_file::reader::Record;
use crate::model_file::value::{Course, Datum};
use embate_solver::model::{Constraint, Curve, Drive, Load, Motion};

/// What a part's `rigid` says: `None` for a part that deforms.
pub(super) fn rigid(record: &Record) -> Option<Motion> {
    match record.datum("rigid") {
        Some(Datum::Flag(true)) => Some(Motion::default()),
        Some(Datum::Courses(courses)) => Some(motion(courses, &Motion::default())),
        _ => None,
    }
}

/// What an obstacle's `motion` says; what it leaves out is fixed.
pub(super) fn fixed_but(datum: Option<&Datum>) -> Motion {
    if let Some(Datum::Courses(courses)) = datum { motion(courses, &Motion::fixed()) } else { Motion::fixed() }
}

fn motion(courses: &[Option<Course>; 3], left_out: &Motion) -> Motion {
    let drive = |axis: usize, left_out: &Option<Drive>| match &courses[axis] {
        None => left_out.clone(),
        Some(Course::Free) => None,
        Some(Course::Driven(drive)) => Some(drive.clone()),
    };
    Motion { velocity: [0, 1].map(|axis| drive(axis, &left_out.velocity[axis])), spin: drive(2, &left_out.spin) }
}

pub(super) fn curve(record: &Record, faults: &mut Faults) -> Curve {
    for [one, other] in [["time", "value"], ["value", "time"]] {
        if record.datum(one).is_none() {
            faults.cover(&record.key(other));
        }
    }
    let (values, dimension) = match record.datum("value") {
        Some(Datum::Values(values, dimension)) => (values.clone(), *dimension),
        _ => (Vec::new(), None),
    };
    Curve { times: record.list("time"), values, dimension }
}

pub(super) fn constraint(record: &Record, faults: &mut Faults) -> Constraint {
    let mut velocity = match record.datum("velocity") {
        Some(Datum::Courses(courses)) => motion(courses, &Motion::default()).velocity,
        _ => [None, None],
    };
    for axis in record.texts("fixed") {
        let index = usize::from(axis == "y");
        if velocity[index].is_some()
            && let Some(place) = record.written("fixed")
        {
            let message = format!("component `{axis}` is both fixed and given a velocity");
            faults.value("rule", &record.key("fixed"), place, (message, "leave it out of one of the two".to_string()));
        }
        velocity[index].get_or_insert(Drive::Constant(0.0));
    }
    if velocity == [None, None] {
        // Nothing sound was given: the reader has said so.
        velocity = [Some(Drive::Constant(0.0)), None];
    }
    Constraint { on: record.text("on"), velocity }
}

pub(super) fn load(record: &Record, faults: &mut Faults) -> Load {
    let parts = record.texts("parts");
    if record.written("damping").is_some() && record.written("gravity").is_none() {
        let rate = record.number("damping").unwrap_or(f64::NAN);
        return Load::Damping { parts, rate, active: window(record, ["from", "until"], faults) };
    }
    if record.written("gravity").is_none() {
        faults.cover(&record.key("gravity"));
    }
    Load::Gravity { parts, acceleration: record.vector("gravity") }
}

/// Times of beginning and end; left out: from the start, for ever.
pub(super) fn window(record: &Record, keys: [&str; 2], faults: &mut Faults) -> [f64; 2] {
    for [one, other] in [keys, [keys[1], keys[0]]] {
        if record.written(one).is_some() && record.datum(one).is_none() {
            faults.cover(&record.key(other));
        }
    }
    [record.number(keys[0]).unwrap_or(0.0), record.number(keys[1]).unwrap_or(f64::INFINITY)]
}
