//! What the reader of a file finds between keys of one section: faults that only follow from others, and
//! contradictions that a model no longer shows.

use crate::model_file::diagnostics::Faults;
use crate::model_file::messages::{MISSING_KEY, UNIT};
use crate::model_file::reader::{self, Document, Record};
use embate_solver::input::sections;
use embate_solver::model::messages::CLASH;
use embate_solver::model::values::Course;
use embate_solver::quantity::Dimension;

/// Keys, each with those whose faults follow where its own value is written and not sound.
const AFTER: &[(&str, &[&str])] = &[
    // What an obstacle is free in is not known then.
    ("motion", &["mass", "inertia", "velocity", "spin"]),
    ("friction", &["friction_dynamic"]),
    ("birth", &["death"]),
    ("death", &["birth"]),
    ("from", &["until"]),
    ("until", &["from"]),
];

/// Keys that mean something together alone: faults of one follow where the other is missing or not sound.
const PAIRS: &[[&str; 2]] = &[["gaps", "pressures"], ["time", "value"], ["friction_dynamic", "friction_decay"]];

/// Notes what is not to be reported of a table, since it only follows from a fault of another key.
pub(super) fn cover(record: &Record, faults: &mut Faults) {
    let is_faulty = |key: &str| record.written(key).is_some() && !record.is_sound(key);
    for (_, others) in AFTER.iter().filter(|(key, _)| is_faulty(key)) {
        others.iter().for_each(|other| faults.cover(&record.key(other)));
    }
    for pair in PAIRS.iter().filter(|pair| !pair.iter().all(|key| record.is_sound(key))) {
        pair.iter().for_each(|key| faults.cover(&record.key(key)));
    }
    if is_faulty("expression") {
        faults.cover(&record.path);
    }
}

/// Components of a constraint that are fixed and prescribed as well.
pub(super) fn constraint(record: &Record, faults: &mut Faults) {
    let given = ["velocity", "displacement", "acceleration"].map(|key| (key, record.get::<Option<[Option<Course>; 4]>>(key)));
    for axis in record.get::<Vec<String>>("fixed") {
        let index = ["x", "y", "z"].iter().position(|name| *name == axis).unwrap_or_default();
        let other = given.iter().find(|(_, courses)| courses.as_ref().is_some_and(|courses| courses[index].is_some()));
        if let (Some((other, _)), Some(place)) = (other, record.written("fixed")) {
            let article = if *other == "acceleration" { "an" } else { "a" };
            let message = format!("component `{axis}` is both fixed and given {article} {other}");
            faults.value(&CLASH, &record.key("fixed"), place, (message, "leave it out of one of the two".to_string()));
        }
    }
}

/// A run without an end, or with two.
pub(super) fn end(document: &Document, faults: &mut Faults) {
    let (Some(run), Some(key)) = (document.section("run").first(), sections::find("run.end")) else { return };
    let path = run.key("end");
    match (run.written("end"), document.section("stage").is_empty()) {
        (None, true) => faults.value(&MISSING_KEY, &path, run.place, reader::lacking("[run]", key)),
        (Some(place), false) => {
            let message = "the model has stages, and their durations say when it ends".to_string();
            faults.value(&CLASH, &path, place, (message, "leave `end` out".to_string()));
        }
        _ => {}
    }
}

/// A sine whose mean value is of another dimension than its height.
pub(super) fn sine(record: &Record, faults: &mut Faults) {
    let dimension = |key| record.get::<(Vec<f64>, Option<Dimension>)>(key).1;
    if let (Some(wave), Some(mean), Some(place)) = (dimension("amplitude"), dimension("offset"), record.written("offset"))
        && wave != mean
    {
        let message = format!("`offset` is in {mean}, but `amplitude` is in {wave}");
        faults.value(&UNIT, &record.key("offset"), place, (message, "give both in one dimension".to_string()));
    }
}
