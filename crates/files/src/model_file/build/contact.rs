//! Contacts and obstacles of a model from the records of a file, and what both share: law, friction, times.

use super::{Meshes, motion};
use crate::model_file::diagnostics::Faults;
use crate::model_file::reader::Record;
use crate::model_file::units::shorten;
use crate::model_file::value::Datum;
use embate_solver::model::messages::{CLASH, UNKNOWN_NAME};
use embate_solver::model::{
    Contact, ContactLaw, Formulation, Friction, InitialPenetration, Interface, Obstacle, ObstacleShape, Partners, Penalty, PenaltySource,
    Placement, TriangleSurface,
};
use std::sync::Arc;

pub(super) fn contact(record: &Record, faults: &mut Faults) -> Contact {
    let bodies = record.written("bodies").is_some() && record.written("between").is_none();
    let names = record.texts(if bodies { "bodies" } else { "between" });
    let partners = if bodies {
        // Faulty names: one that no other contact has.
        let names = if record.datum("bodies").is_some() { names } else { vec![String::new()] };
        Partners::Bodies(if names == ["all"] { Vec::new() } else { names })
    } else {
        if record.written("between").is_none() {
            faults.cover(&record.key("between"));
        }
        Partners::Between([0, 1].map(|index| names.get(index).cloned().unwrap_or_default()))
    };
    let between = if let Partners::Between(between) = &partners { Some(between) } else { None };
    Contact {
        name: record.text("name"),
        formulation: formulation(record, between, faults),
        interface: interface(record, faults),
        search: record.text("search"),
        tied: record.is("tied").then(|| record.number("tie_strength").unwrap_or(f64::INFINITY)),
        partners,
    }
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
    let known = record.datum("formulation").is_some() && record.datum("between").is_some();
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
            if index.is_none() && known && record.datum("slave").is_some() {
                let message = format!("the slave {} is not one of the two surfaces", shorten(&slave));
                let help = format!("take {} or {}", shorten(&between[0]), shorten(&between[1]));
                faults.value(&UNKNOWN_NAME, &record.key("slave"), place, (message, help));
            }
            Formulation::SinglePass { slave: index.unwrap_or(0) }
        }
    }
}

pub(super) fn obstacle(record: &Record, meshes: &Meshes<'_>, faults: &mut Faults) -> Obstacle {
    if record.written("motion").is_some() && record.datum("motion").is_none() {
        // What it is free in is not known.
        ["mass", "inertia", "velocity", "spin"].iter().for_each(|name| faults.cover(&record.key(name)));
    }
    Obstacle {
        name: record.text("name"),
        parts: record.texts("parts"),
        shape: shape(record, meshes, faults),
        motion: motion::fixed_but(record.datum("motion")),
        reference: record.written("reference").map(|_| record.spatial("reference")),
        mass: record.written("mass").map(|_| record.number("mass").unwrap_or(f64::NAN)),
        inertia: record.written("inertia").map(|_| record.number("inertia").unwrap_or(f64::NAN)),
        velocity: record.spatial("velocity"),
        spin: record.number("spin").unwrap_or(f64::NAN),
        interface: interface(record, faults),
    }
}

fn shape(record: &Record, meshes: &Meshes<'_>, faults: &mut Faults) -> ObstacleShape {
    if let Some(it) = record.table("circle") {
        let radius = it.number("radius").unwrap_or(f64::NAN);
        return ObstacleShape::Circle { centre: it.spatial("centre"), radius, hollow: it.is("hollow") };
    }
    if let Some(it) = record.table("sphere") {
        let radius = it.number("radius").unwrap_or(f64::NAN);
        return ObstacleShape::Sphere { centre: it.spatial("centre"), radius, hollow: it.is("hollow") };
    }
    if let Some(it) = record.table("cylinder") {
        let radius = it.number("radius").unwrap_or(f64::NAN);
        return ObstacleShape::Cylinder { point: it.spatial("point"), axis: it.spatial("axis"), radius, hollow: it.is("hollow") };
    }
    if let Some(it) = record.table("stl") {
        return triangles(it, meshes, faults);
    }
    if let Some(it) = record.table("polyline") {
        let points = if let Some(Datum::Points(points)) = it.datum("points") { points.clone() } else { Vec::new() };
        return ObstacleShape::Polyline { points };
    }
    let Some(it) = record.table("plane") else {
        faults.cover(&record.key("plane"));
        return ObstacleShape::Plane { point: [f64::NAN; 3], normal: [f64::NAN; 3], length: None };
    };
    ObstacleShape::Plane { point: it.spatial("point"), normal: it.spatial("normal"), length: it.number("length") }
}

fn triangles(record: &Record, meshes: &Meshes<'_>, faults: &mut Faults) -> ObstacleShape {
    let mut placement = Placement { translation: record.spatial("translation"), ..Placement::default() };
    super::turn(record, &mut placement);
    let surface = meshes.surface(record, faults).unwrap_or_else(|| {
        faults.cover(&record.path);
        TriangleSurface::default()
    });
    let placed = surface.placed(&placement);
    ObstacleShape::Triangles(Arc::new(if record.is("hollow") { placed.turned_over() } else { placed }))
}

/// The keys that contacts and obstacles share.
fn interface(record: &Record, faults: &mut Faults) -> Interface {
    let initial_penetration = match record.text("initial_penetration").as_str() {
        "ignore" => InitialPenetration::Ignore,
        "push_out" => InitialPenetration::PushOut,
        _ => InitialPenetration::Error,
    };
    Interface {
        law: law(record, faults),
        damping: record.number("damping").unwrap_or(f64::NAN),
        friction: friction(record, faults),
        initial_penetration,
        thickness: record.number("thickness").unwrap_or(f64::NAN),
        active: motion::window(record, ["birth", "death"], faults),
    }
}

fn law(record: &Record, faults: &mut Faults) -> ContactLaw {
    match record.text("law").as_str() {
        "pressure_gap" => {
            if record.datum("gaps").is_none() {
                faults.cover(&record.key("pressures"));
            } else if record.datum("pressures").is_none() {
                faults.cover(&record.key("gaps"));
            }
            ContactLaw::PressureGap { gaps: record.list("gaps"), pressures: record.list("pressures") }
        }
        "multiplier" => ContactLaw::Multiplier,
        _ => ContactLaw::Penalty(penalty(record)),
    }
}

fn penalty(record: &Record) -> Penalty {
    if let Some(Datum::Penalty(penalty)) = record.datum("penalty") {
        return *penalty;
    }
    let source = match record.text("penalty_from").as_str() {
        "bulk_modulus" => PenaltySource::BulkModulus,
        "time_step" => PenaltySource::TimeStep,
        _ => PenaltySource::WaveModulus,
    };
    Penalty::Automatic { source, scale: record.number("penalty_scale").unwrap_or(1.0) }
}

fn friction(record: &Record, faults: &mut Faults) -> Option<Friction> {
    record.written("friction")?;
    for [one, other] in [["friction_dynamic", "friction_decay"], ["friction_decay", "friction_dynamic"], ["friction", "friction_dynamic"]] {
        if record.datum(one).is_none() {
            faults.cover(&record.key(other));
        }
    }
    Some(Friction {
        coefficient: record.number("friction").unwrap_or(f64::NAN),
        dynamic: record.number("friction_dynamic"),
        decay: record.number("friction_decay").unwrap_or(0.0),
        viscosity: record.number("friction_viscosity").unwrap_or(0.0),
        limit: record.number("friction_limit").unwrap_or(f64::INFINITY),
    })
}
