//! What moves bodies from outside, from the records of a file: rigid parts and obstacles, constraints,
//! curves.

use crate::model_file::diagnostics::Faults;
use crate::model_file::messages::UNIT;
use crate::model_file::reader::Record;
use crate::model_file::value::{Course, Datum};
use embate_solver::model::Sine;
use embate_solver::model::messages::CLASH;
use embate_solver::model::{Axis, Constraint, Curve, CurveShape, Drive, Motion, Rotation};
use embate_solver::quantity::Dimension;

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

fn motion(courses: &[Option<Course>; 4], left_out: &Motion) -> Motion {
    let drive = |axis: usize, left_out: &Option<Drive>| match &courses[axis] {
        None => left_out.clone(),
        Some(Course::Free) => None,
        Some(Course::Driven(drive)) => Some(drive.clone()),
    };
    Motion { velocity: [0, 1, 2].map(|axis| drive(axis, &left_out.velocity[axis])), spin: drive(3, &left_out.spin) }
}

pub(super) fn curve(record: &Record, faults: &mut Faults) -> Curve {
    if let Some(it) = record.table("sine") {
        return sine(it, faults);
    }
    if record.written("expression").is_some() {
        if record.datum("expression").is_none() {
            faults.cover(&record.path);
        }
        return Curve { shape: CurveShape::Expression(record.text("expression")), dimension: None };
    }
    if record.datum("time").is_none() || record.datum("value").is_none() {
        ["time", "value"].iter().for_each(|name| faults.cover(&record.key(name)));
    }
    let (values, dimension) = scalars(record, "value");
    let smooth = record.text("between") == "smooth_steps";
    Curve { shape: CurveShape::Table { times: record.list("time"), values, smooth }, dimension }
}

fn sine(record: &Record, faults: &mut Faults) -> Curve {
    let ((amplitude, wave), (offset, mean)) = (scalars(record, "amplitude"), scalars(record, "offset"));
    if let (Some(wave), Some(mean)) = (wave, mean)
        && wave != mean
        && let Some(place) = record.written("offset")
    {
        let message = format!("`offset` is in {mean}, but `amplitude` is in {wave}");
        faults.value(&UNIT, &record.key("offset"), place, (message, "give both in one dimension".to_string()));
    }
    let first = |values: Vec<f64>| values.first().copied().unwrap_or(f64::NAN);
    let number = |name| record.number(name).unwrap_or(f64::NAN);
    let sine = Sine { amplitude: first(amplitude), frequency: number("frequency"), phase: number("phase"), offset: first(offset) };
    Curve { shape: CurveShape::Sine(sine), dimension: wave.or(mean) }
}

/// Numbers of one dimension.
fn scalars(record: &Record, name: &str) -> (Vec<f64>, Option<Dimension>) {
    if let Some(Datum::Values(values, dimension)) = record.datum(name) { (values.clone(), *dimension) } else { (Vec::new(), None) }
}

pub(super) fn constraint(record: &Record, faults: &mut Faults) -> Constraint {
    let components = |name| match record.datum(name) {
        Some(Datum::Courses(courses)) => motion(courses, &Motion::default()).velocity,
        _ => [None, None, None],
    };
    let mut velocity = components("velocity");
    let [displacement, acceleration] = ["displacement", "acceleration"].map(components);
    for axis in record.texts("fixed") {
        let index = ["x", "y", "z"].iter().position(|name| *name == axis).unwrap_or_default();
        let others = [("velocity", &velocity), ("displacement", &displacement), ("acceleration", &acceleration)];
        let other = others.iter().find(|(_, drives)| drives[index].is_some()).map(|(name, _)| *name);
        if let (Some(other), Some(place)) = (other, record.written("fixed")) {
            let article = if other == "acceleration" { "an" } else { "a" };
            let message = format!("component `{axis}` is both fixed and given {article} {other}");
            faults.value(&CLASH, &record.key("fixed"), place, (message, "leave it out of one of the two".to_string()));
        } else {
            velocity[index] = Some(Drive::Constant(0.0));
        }
    }
    let rotation = record.table("rotation").map(|it| {
        let speed = if let Some(Datum::Drive(drive)) = it.datum("speed") { drive.clone() } else { Drive::Constant(f64::NAN) };
        Rotation { about: axis(it), speed }
    });
    if rotation.is_some() {
        // What else is given has its fault already.
        return Constraint { on: record.text("on"), rotation, ..Constraint::default() };
    }
    if [&velocity, &displacement, &acceleration].iter().all(|drives| **drives == [None, None, None]) {
        // Nothing sound was given: the reader has said so.
        velocity = [Some(Drive::Constant(0.0)), None, None];
    }
    Constraint { on: record.text("on"), velocity, displacement, acceleration, rotation }
}

/// What the keys `centre` and `axis` say; left out: along z through the origin.
pub(super) fn axis(record: &Record) -> Axis {
    let or = |name: &str, left_out: [f64; 3]| if record.written(name).is_some() { record.spatial(name) } else { left_out };
    let Axis { centre, direction } = Axis::default();
    Axis { centre: or("centre", centre), direction: or("axis", direction) }
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
