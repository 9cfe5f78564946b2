//! `embate list`: what the registries hold.

use crate::numbers::table;
use crate::{Failure, terminal};
use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser};
use embate_files::registries::{Registry, registries};
use std::fmt::Write;

/// What to list.
#[derive(Args)]
pub(crate) struct Arguments {
    /// One kind of thing; all when left out
    #[arg(value_parser = names())]
    what: Option<String>,
}

fn names() -> PossibleValuesParser {
    registries().iter().map(|registry| PossibleValue::new(registry.name).help(registry.doc)).collect::<Vec<_>>().into()
}

pub(crate) fn list(arguments: &Arguments) -> Result<(), Failure> {
    let chosen = |registry: &Registry| arguments.what.as_ref().is_none_or(|wanted| wanted == registry.name);
    let lists: Vec<String> = registries().iter().filter(|registry| chosen(registry)).map(text).collect();
    terminal::print(&lists.join("\n"))
}

/// Names, what they are, where they come from, and their parameters.
fn text(registry: &Registry) -> String {
    let mut text = format!("{} ({})\n", registry.title, registry.keys.join(", "));
    if registry.is_table() {
        text.push_str(&table(&registry.entries.iter().flat_map(|entry| entry.rows.clone()).collect::<Vec<_>>(), "  "));
        return text;
    }
    for entry in &registry.entries {
        // Writing to a string can't fail.
        let _ = writeln!(text, "  {}{}\n      {}", entry.name, if entry.default { " (default)" } else { "" }, entry.doc);
        if !entry.source.is_empty() {
            let _ = writeln!(text, "      source: {}", entry.source);
        }
        text.push_str(&table(&entry.rows, "      "));
    }
    text
}
