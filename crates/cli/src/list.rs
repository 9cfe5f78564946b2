//! `embate list`: what the registries hold. Nothing is named here: a new material, element, search or field shows up by itself.

use crate::numbers::table;
use crate::{Failure, terminal};
use clap::{Args, ValueEnum};
use embate_solver::block::stress_state::STRESS_STATES;
use embate_solver::quantity::Parameter;
use embate_solver::{contact, element, material, output};
use std::fmt::Write;

/// What to list.
#[derive(Args)]
pub(crate) struct Arguments {
    /// One kind of thing; all when left out
    what: Option<What>,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum What {
    /// Element formulations
    Elements,
    /// Stress states
    StressStates,
    /// Material laws
    Materials,
    /// Criteria of failure
    Failure,
    /// Equations of state
    EquationsOfState,
    /// Global contact searches
    Searches,
    /// Contact formulations
    Formulations,
    /// Contact laws
    Laws,
    /// Fields of the output
    Fields,
}

pub(crate) fn list(arguments: &Arguments) -> Result<(), Failure> {
    let chosen = |what: &What| arguments.what.is_none_or(|wanted| wanted == *what);
    let lists: Vec<String> = What::value_variants().iter().filter(|what| chosen(what)).map(|what| what.list()).collect();
    terminal::print(&lists.join("\n"))
}

impl What {
    fn list(self) -> String {
        match self {
            Self::Elements => elements(),
            Self::StressStates => stress_states(),
            Self::Materials => materials(),
            Self::Failure => failure(),
            Self::EquationsOfState => equations_of_state(),
            Self::Searches => searches(),
            Self::Formulations => formulations(),
            Self::Laws => laws(),
            Self::Fields => fields(),
        }
    }
}

fn elements() -> String {
    let mut text = String::from("Elements (part.element)\n");
    for kind in element::registry() {
        entry(&mut text, kind.name, &format!("{} ({} nodes)", kind.doc, kind.nodes), kind.source);
    }
    text
}

fn failure() -> String {
    let mut text = String::from("Criteria of failure (material.failure)\n");
    for kind in embate_solver::failure::CRITERIA {
        let unit = kind.limit.dimension.unit();
        let unit = if unit.is_empty() { String::new() } else { format!(" In {unit}.") };
        entry(&mut text, kind.limit.name, &format!("{}{unit}", kind.limit.doc), "");
    }
    text
}

fn stress_states() -> String {
    let mut text = String::from("Stress states (part.stress_state)\n");
    for kind in STRESS_STATES {
        entry(&mut text, kind.name, kind.doc, kind.source);
    }
    text
}

fn materials() -> String {
    let mut text = String::from("Materials (material.NAME.law)\n");
    for law in material::registry() {
        entry(&mut text, law.name, law.doc, law.source);
        text.push_str(&table(&law.parameters.iter().map(|parameter| parameter_row(parameter, "required")).collect::<Vec<_>>(), "      "));
    }
    text
}

fn equations_of_state() -> String {
    let mut text = String::from("Equations of state (material.NAME.eos)\n");
    for kind in material::eos::EQUATIONS {
        entry(&mut text, kind.name, kind.doc, kind.source);
        let mut rows: Vec<_> = kind.parameters.iter().map(|parameter| parameter_row(parameter, "required")).collect();
        rows.push(parameter_row(&material::eos::TENSION, "no limit"));
        text.push_str(&table(&rows, "      "));
    }
    text
}

fn searches() -> String {
    let mut text = String::from("Searches (contact.search)\n");
    for (index, search) in contact::search::registry::<2>().iter().enumerate() {
        let name = if index == 0 { format!("{} (default)", search.name) } else { search.name.to_string() };
        entry(&mut text, &name, search.doc, search.source);
    }
    text
}

fn formulations() -> String {
    let mut text = String::from("Contact formulations (contact.formulation)\n");
    for (index, kind) in contact::formulation::FORMULATIONS.iter().enumerate() {
        let name = if index == 0 { format!("{} (default)", kind.name) } else { kind.name.to_string() };
        entry(&mut text, &name, kind.doc, kind.source);
    }
    text
}

fn laws() -> String {
    let mut text = String::from("Contact laws (contact, obstacle)\n");
    for law in contact::law::LAWS {
        entry(&mut text, law.name, law.doc, law.source);
        text.push_str(&table(&law.parameters.iter().map(|parameter| parameter_row(parameter, "optional")).collect::<Vec<_>>(), "      "));
    }
    text
}

fn fields() -> String {
    let row = |kind: &output::FieldKind| {
        let place = match kind.location {
            output::Location::Node => "node",
            output::Location::Cell => "cell",
        };
        let components = if kind.components.is_empty() { "scalar".to_string() } else { kind.components.join(" ") };
        vec![kind.name.to_string(), place.to_string(), components, unit(kind.unit.to_string()), kind.doc.to_string()]
    };
    format!("Fields (output.include)\n{}", table(&output::FIELDS.iter().map(row).collect::<Vec<_>>(), "  "))
}

/// Name, what it is, and where it comes from.
fn entry(text: &mut String, name: &str, doc: &str, source: &str) {
    // Writing to a string can't fail.
    let _ = writeln!(text, "  {name}\n      {doc}");
    if !source.is_empty() {
        let _ = writeln!(text, "      source: {source}");
    }
}

/// A row of a parameter table; `without` says what a parameter without a default value is.
fn parameter_row(parameter: &Parameter, without: &str) -> Vec<String> {
    let default = match (parameter.default, parameter.list) {
        (None, _) => without.to_string(),
        (Some(_), 1..) => "default: none".to_string(),
        (Some(value), 0) => format!("default {value}"),
    };
    let many = if parameter.list > 0 { format!(", up to {} values", parameter.list) } else { String::new() };
    vec![
        parameter.name.to_string(),
        parameter.symbol.to_string(),
        unit(parameter.dimension.unit()),
        format!("{}{many}", parameter.range),
        default,
        parameter.doc.to_string(),
    ]
}

/// A unit in brackets; a dash for a pure number.
fn unit(unit: String) -> String {
    if unit.is_empty() { "-".to_string() } else { unit }
}
