//! `embate list`: what the registries and the library of materials hold.

use crate::cli_error::CliError;
use crate::numbers::table;
use crate::{Failure, messages, terminal};
use clap::Args;
use clap::builder::{PossibleValue, StringValueParser, TypedValueParser};
use embate_files::model_file::{LibraryMaterial, library, library_material};
use embate_files::registries::{Entry, Registry, registries};
use embate_solver::material;
use embate_solver::vocabulary::suggestion;
use std::ffi::OsStr;
use std::fmt::Write;

/// What to list.
#[derive(Args)]
pub(crate) struct Arguments {
    /// One kind of thing, or one thing by its name: `j2`, `shell4`, `ring`, `"steel DP600"`; all kinds when
    /// left out
    #[arg(value_parser = What)]
    what: Option<String>,
    /// The library of materials, which `from` in [material.NAME] names, or one of it
    #[arg(long, value_name = "MATERIAL", num_args = 0..=1, default_missing_value = "")]
    library: Option<String>,
}

/// A kind, which help and completion name, or anything that one holds.
#[derive(Clone)]
struct What;

impl TypedValueParser for What {
    type Value = String;

    fn parse_ref(&self, command: &clap::Command, argument: Option<&clap::Arg>, value: &OsStr) -> Result<String, clap::Error> {
        StringValueParser::new().parse_ref(command, argument, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(registries().into_iter().map(|registry| PossibleValue::new(registry.name).help(registry.doc))))
    }
}

pub(crate) fn list(arguments: &Arguments) -> Result<(), Failure> {
    let all = registries();
    if let Some(wanted) = &arguments.library {
        if let Some(other) = arguments.what.as_deref().filter(|what| *what != "materials") {
            let text = format!("`--library` lists materials, not {other}");
            return Err(Failure::Input(CliError::new(&messages::USAGE, text).help("write `embate list materials --library`")));
        }
        if wanted.is_empty() {
            return terminal::print(&of_library());
        }
        let found =
            library_material(wanted).map_err(|(message, help)| Failure::Input(CliError::new(&messages::USAGE, message).help(help)))?;
        return terminal::print(&one_of_library(found));
    }
    let Some(wanted) = arguments.what.as_deref() else {
        return terminal::print(&all.iter().map(text).collect::<Vec<_>>().join("\n"));
    };
    if let Some(registry) = all.iter().find(|registry| registry.name == wanted) {
        return terminal::print(&text(registry));
    }
    let mut texts = Vec::new();
    for registry in &all {
        for entry in registry.entries.iter().filter(|entry| entry.name == wanted) {
            texts.push(format!("{} ({})\n{}", registry.title, registry.keys.join(", "), one(registry, entry)));
        }
    }
    texts.extend(library().iter().filter(|material| material.name == wanted).map(one_of_library));
    if texts.is_empty() {
        let kinds = all.iter().map(|registry| registry.name);
        let entries = all.iter().flat_map(|registry| registry.entries.iter().map(|entry| entry.name));
        let known: Vec<&str> = kinds.chain(entries).chain(library().iter().map(|material| material.name.as_str())).collect();
        let text = format!("there is nothing called {wanted} to list");
        return Err(Failure::Input(
            CliError::new(&messages::USAGE, text)
                .help(format!("{}; `embate list --help` names the kinds", suggestion(wanted, &known).trim_end_matches('?'))),
        ));
    }
    terminal::print(&texts.join("\n"))
}

/// Names, what they are, where they come from, and their parameters.
fn text(registry: &Registry) -> String {
    let mut text = format!("{} ({})\n", registry.title, registry.keys.join(", "));
    if registry.is_table() {
        text.push_str(&table(&registry.entries.iter().flat_map(|entry| entry.rows.clone()).collect::<Vec<_>>(), "  "));
        return text;
    }
    for entry in &registry.entries {
        text.push_str(&one(registry, entry));
    }
    text
}

/// An entry.
fn one(registry: &Registry, entry: &Entry) -> String {
    if registry.is_table() {
        return table(&entry.rows, "  ");
    }
    let mut text = format!("  {}{}\n      {}\n", entry.name, if entry.default { " (default)" } else { "" }, entry.doc);
    if !entry.source.is_empty() {
        // Writing to a string can't fail.
        let _ = writeln!(text, "      source: {}", entry.source);
    }
    text.push_str(&table(&entry.rows, "      "));
    text
}

/// All materials of the library, by groups.
fn of_library() -> String {
    let mut text = String::from("Library of materials (material.NAME.from)\n");
    let mut group = "";
    for material in library() {
        // Writing to a string can't fail.
        if material.group != group {
            group = &material.group;
            let _ = writeln!(text, "\n{group}");
        }
        let values = material.values().map(|value| {
            let items: Vec<&str> = value.value.split(", ").collect();
            match items.as_slice() {
                [first, .., last] if items.len() > 6 => format!("{} {first} to {last} ({} values)", value.key, items.len()),
                _ => format!("{} {}", value.key, value.value),
            }
        });
        let _ = writeln!(
            text,
            "  {} ({})\n      {}\n      {}",
            material.name,
            law(material),
            material.about,
            values.collect::<Vec<_>>().join(", ")
        );
        let sources: Vec<String> = material.sources().into_iter().map(|(_, source)| source).collect();
        let _ = writeln!(text, "      source: {}", sources.join("; "));
    }
    text
}

/// A material of the library: each key with its value, what it means, and where the value comes from.
fn one_of_library(found: &LibraryMaterial) -> String {
    let laws = material::registry();
    let of_law = laws.iter().filter(|kind| kind.name == found.law).flat_map(|kind| kind.parameters);
    let of_equation = material::eos::kind(&found.eos).into_iter().flat_map(|kind| kind.parameters);
    let known: Vec<_> = of_law.chain(of_equation).chain([&material::eos::TENSION]).collect();
    let meaning = |key: &str| known.iter().find(|parameter| parameter.name == key).map_or("", |parameter| parameter.doc);
    let mut text = format!("{} (material.NAME.from)\n  {}\n  law {}\n", found.name, found.about, law(found));
    let rows: Vec<Vec<String>> = found.values().map(|it| vec![it.key.clone(), it.value, meaning(&it.key).to_string()]).collect();
    text.push_str(&table(&rows, "      "));
    for (keys, source) in found.sources() {
        // Writing to a string can't fail.
        let _ = writeln!(text, "  source of {}: {source}", keys.join(", "));
    }
    text
}

/// Its law and equation of state.
fn law(material: &LibraryMaterial) -> String {
    if material.eos.is_empty() { material.law.clone() } else { format!("{}, eos {}", material.law, material.eos) }
}
