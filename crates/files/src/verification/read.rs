//! Reads a case: `expected.toml` into checks, and the models that they name.
//!
//! The tables are read and checked by the reader of model files after `describe.rs`; here is what holds
//! between keys. All faults of the file come together; those of a model file come as that model's own.

use super::case::{Accepted, Case, Check, Combination, How, Place, Quantity, Source, TAKES, Take, Tier, With};
use super::describe::EXPECTED;
use crate::PathPolicy;
use crate::model_file::{self, Described, Diagnostics, Document, Faults, Record};
use crate::verification::messages::{CASE, UNJUDGED};
use embate_solver::model::Model;
use embate_solver::vocabulary::suggestion;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Name of the file that makes a folder a case.
pub const FILE_NAME: &str = "expected.toml";
/// The model that is meant where none is named.
const MODEL: &str = "model";

/// A model file with changed keys.
struct Variant {
    model: String,
    set: Vec<String>,
}

/// Reads the case in `folder`, its models included. `reach`: from where files are read that they name.
///
/// # Errors
/// All faults of `expected.toml`, or all of a model file.
pub fn load(folder: &Path, reach: PathPolicy) -> Result<Case, Diagnostics> {
    let name = folder.file_name().map_or_else(|| "case".to_string(), |name| name.to_string_lossy().into_owned());
    let files = model_files(folder);
    let (text, (title, tier, variants, checks)) = Described::read(&folder.join(FILE_NAME), &EXPECTED, |document, faults| {
        let variants = variants(document, &files, faults);
        let checks: Vec<Check> = document.section("check").iter().map(|record| check(record, faults)).collect();
        names(document, &files, &variants, faults);
        let tier = if document.top.text("tier") == "all" { Tier::All } else { Tier::Every };
        (document.top.text("title"), tier, variants, checks)
    })?;
    let models = models((folder, reach), &variants, &checks)?;
    Ok(Case { name, title, tier, folder: folder.to_path_buf(), models, checks, text })
}

/// Names of the model files of a folder.
fn model_files(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let files = entries.filter_map(|entry| entry.file_name().into_string().ok()).filter(|name| name != FILE_NAME);
    let mut names: Vec<String> = files.filter_map(|name| name.strip_suffix(".toml").map(String::from)).collect();
    names.sort();
    names
}

fn variants(document: &Document, files: &[String], faults: &mut Faults) -> BTreeMap<String, Variant> {
    let mut variants = BTreeMap::new();
    for record in document.section("variant") {
        let model = or_model(record.text("model"));
        if !files.contains(&model) {
            unknown(record, "model", &model, &known(files, &BTreeMap::new()), faults);
        }
        if files.contains(&record.name) {
            let texts = (format!("there is a model file `{}.toml` too", record.name), "give the variant another name".to_string());
            faults.beside(&CASE, &record.path, None, texts);
        }
        variants.insert(record.name.clone(), Variant { model, set: record.get("set") });
    }
    variants
}

fn or_model(name: String) -> String {
    if name.is_empty() { MODEL.to_string() } else { name }
}

fn known<'a>(files: &'a [String], variants: &'a BTreeMap<String, Variant>) -> Vec<&'a str> {
    files.iter().map(String::as_str).chain(variants.keys().map(String::as_str)).collect()
}

fn unknown(record: &Record, key: &str, name: &str, known: &[&str], faults: &mut Faults) {
    let texts = (format!("there is no model `{name}` in this folder"), suggestion(name, known));
    let path = record.key(key);
    faults.beside(&CASE, if record.written(key).is_some() { &path } else { &record.path }, None, texts);
}

/// Every name of a model must mean something, and every model file and variant must be named.
fn names(document: &Document, files: &[String], variants: &BTreeMap<String, Variant>, faults: &mut Faults) {
    let all = known(files, variants);
    let mut used: BTreeSet<String> = variants.values().map(|variant| variant.model.clone()).collect();
    let mut name = |record: &Record, key: &str, name: String, faults: &mut Faults| {
        if !all.contains(&name.as_str()) {
            unknown(record, key, &name, &all, faults);
        }
        used.insert(name);
    };
    for record in document.section("check") {
        let named: Vec<String> = record.get("model");
        let named = if named.is_empty() { vec![MODEL.to_string()] } else { named };
        named.into_iter().for_each(|it| name(record, "model", it, faults));
        for (table, key) in [("over", "model"), ("minus", "model"), ("converges", "model")] {
            if let Some(table) = record.table(table).filter(|table| table.written(key).is_some()) {
                name(table, key, table.text(key), faults);
            }
        }
    }
    if document.section("check").is_empty() {
        return; // Reported already.
    }
    for unused in all.iter().filter(|name| !used.contains(**name)) {
        let path = if variants.contains_key(*unused) { format!("variant.{unused}") } else { String::new() };
        let texts = (format!("no check names the model `{unused}`"), "check something of it, or take it away".to_string());
        faults.beside(&CASE, &path, None, texts);
    }
}

fn check(record: &Record, faults: &mut Faults) -> Check {
    let named: Vec<String> = record.get("model");
    let with = [("over", Combination::Over), ("minus", Combination::Minus)].into_iter().find_map(|(name, how)| {
        let table = record.table(name)?;
        Some(With { how, quantity: quantity(table, faults), model: table.written("model").is_some().then(|| table.text("model")) })
    });
    // A table that is not sound has been reported.
    let nothing = || Quantity { path: String::new(), source: Source::Summary(String::new()) };
    Check {
        name: record.text("name"),
        models: if named.is_empty() { vec![MODEL.to_string()] } else { named },
        quantity: record.table("quantity").map_or_else(nothing, |table| quantity(table, faults)),
        with,
        accepted: accepted(record, faults),
        reason: record.text("reason"),
    }
}

fn accepted(record: &Record, faults: &mut Faults) -> Accepted {
    let number = |name| record.number(name).unwrap_or(f64::NAN);
    let given: Vec<&str> =
        ["tolerance_relative", "tolerance", "converges"].into_iter().filter(|name| record.written(name).is_some()).collect();
    if record.written("expect").is_none() {
        return Accepted::Limits { least: record.number("at_least"), most: record.number("at_most") };
    }
    let expected = number("expect");
    let help = "give one of `tolerance_relative`, `tolerance` and `converges`".to_string();
    match given.as_slice() {
        ["tolerance_relative"] if expected == 0.0 => {
            let texts = ("a fraction of an expected 0 is 0".to_string(), "give `tolerance`, in SI units".to_string());
            faults.beside(&UNJUDGED, &record.key("tolerance_relative"), None, texts);
        }
        [_] => {}
        [] => faults.beside(&UNJUDGED, &record.path, None, ("`expect` has no tolerance".to_string(), help)),
        [_, second, ..] => faults.beside(&UNJUDGED, &record.key(second), None, ("`expect` has more than one tolerance".to_string(), help)),
    }
    match (given.first(), record.table("converges")) {
        (Some(&"converges"), Some(table)) => {
            Accepted::Converges { expected, model: table.text("model"), fraction: table.number("fraction").unwrap_or(f64::NAN) }
        }
        (Some(&"tolerance_relative"), _) => Accepted::Relative { expected, tolerance: number("tolerance_relative") },
        _ => Accepted::Absolute { expected, tolerance: number("tolerance") },
    }
}

/// Keys that say where a number comes from, and the others that may stand with each.
const SOURCES: &[(&str, &[&str])] =
    &[("summary", &[]), ("history", &["take", "at", "from", "to", "level"]), ("field", &["take", "at", "part", "box", "nearest"])];

fn quantity(record: &Record, faults: &mut Faults) -> Quantity {
    let has = |name: &str| record.written(name).is_some();
    let sources: Vec<_> = SOURCES.iter().filter(|(name, _)| has(name)).collect();
    // None or several: reported by the section's rule.
    let [(source, allowed)] = sources.as_slice() else {
        return Quantity { path: record.path.clone(), source: Source::Summary(String::new()) };
    };
    for key in ["take", "at", "from", "to", "level", "part", "box", "nearest"].iter().filter(|key| has(key) && !allowed.contains(key)) {
        let texts = (format!("`{key}` means nothing with `{source}`"), "leave it out".to_string());
        faults.beside(&UNJUDGED, &record.key(key), None, texts);
    }
    let name = record.text(source);
    let source = match *source {
        "history" if has("at") => {
            for key in ["take", "level"].iter().filter(|key| has(key)) {
                let texts =
                    (format!("`{key}` means nothing with `at`: a column has one value at a time"), "leave one of them out".to_string());
                faults.beside(&UNJUDGED, &record.key(key), None, texts);
            }
            Source::HistoryAt(name, record.number("at").unwrap_or(f64::NAN))
        }
        "history" => history(record, name, faults),
        "field" => field(record, name, faults),
        _ => Source::Summary(name),
    };
    Quantity { path: record.path.clone(), source }
}

fn history(record: &Record, column: String, faults: &mut Faults) -> Source {
    let take = taken(record, "history", "`at` or `take`", |take| take.of_history, faults);
    let has_level = record.written("level").is_some();
    if record.written("take").is_some() && has_level != take.how.has_level() {
        let texts = match has_level {
            true => (format!("`{}` needs no level", take.name), "leave `level` out".to_string()),
            false => (format!("`{}` needs `level`", take.name), "add the level, in SI units".to_string()),
        };
        faults.beside(&UNJUDGED, &record.path, None, texts);
    }
    let during = ["from", "to"].map(|key| record.written(key).and(record.number(key)));
    if let [Some(begin), Some(end)] = during
        && begin >= end
    {
        let texts = (format!("`to` is {end} s, not later than `from`, {begin} s"), "give begin and end".to_string());
        faults.beside(&UNJUDGED, &record.key("to"), None, texts);
    }
    Source::History { column, take, during, level: record.number("level").unwrap_or(f64::NAN) }
}

fn field(record: &Record, name: String, faults: &mut Faults) -> Source {
    let place = match record.table("box") {
        _ if record.written("nearest").is_some() => Place::Nearest(record.get("nearest")),
        Some(table) => Place::Box { low: table.get("low"), high: table.get("high") },
        None => Place::All,
    };
    // Of one value, mean is itself.
    let take = match place {
        Place::Nearest(_) => &TAKES[0],
        _ => taken(record, "field", "`nearest` or `take`", |take| take.of_field, faults),
    };
    let at = record.written("at").and(record.number("at"));
    let part = record.written("part").is_some().then(|| record.text("part"));
    Source::Field { name, at, part, place, take }
}

/// The `take` of a quantity; without one, or with one that does not fit, a fault.
fn taken(record: &Record, source: &str, missing: &str, fits: impl Fn(&Take) -> bool, faults: &mut Faults) -> &'static Take {
    let name = record.text("take");
    let take = TAKES.iter().find(|take| take.name == name).unwrap_or(&TAKES[0]);
    let fitting: Vec<String> = TAKES.iter().filter(|take| fits(take)).map(|take| format!("`{}`", take.name)).collect();
    let help = format!("a {source} has {}", fitting.join(", "));
    if record.written("take").is_none() {
        faults.beside(&UNJUDGED, &record.path, None, (format!("a {source} has many values: give {missing}"), help));
    } else if !name.is_empty() && !fits(take) {
        faults.beside(&UNJUDGED, &record.key("take"), None, (format!("`{name}` can't be taken of a {source}"), help));
    }
    take
}

/// The models that the checks name, each once.
fn models(
    (folder, reach): (&Path, PathPolicy),
    variants: &BTreeMap<String, Variant>,
    checks: &[Check],
) -> Result<Vec<(String, Model)>, Diagnostics> {
    let mut models: Vec<(String, Model)> = Vec::new();
    let named = checks.iter().flat_map(|check| {
        let with = check.with.as_ref().and_then(|with| with.model.as_ref());
        let coarser = if let Accepted::Converges { model, .. } = &check.accepted { Some(model) } else { None };
        check.models.iter().chain(with).chain(coarser)
    });
    for name in named {
        if models.iter().any(|(known, _)| known == name) {
            continue;
        }
        let plain = Variant { model: name.clone(), set: Vec::new() };
        let variant = variants.get(name).unwrap_or(&plain);
        let model = model_file::load_with_places(&folder.join(format!("{}.toml", variant.model)), &variant.set, reach)?.model;
        models.push((name.clone(), model));
    }
    Ok(models)
}

impl Source {
    /// Times that it looks at, s.
    pub(super) fn times(&self) -> Vec<f64> {
        match self {
            Self::HistoryAt(_, at) | Self::Field { at: Some(at), .. } => vec![*at],
            Self::History { during, .. } => during.iter().flatten().copied().collect(),
            _ => Vec::new(),
        }
    }
}

impl How {
    /// Whether a larger value is looked for, and whether from the end: of the takes with a level.
    pub(super) fn above_and_last(self) -> [bool; 2] {
        [matches!(self, Self::FirstAbove | Self::LastAbove), matches!(self, Self::LastAbove | Self::LastBelow)]
    }
}
