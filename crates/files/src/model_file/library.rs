//! The library of materials: what `from` in [material.NAME] can name.
//!
//! The data is `materials.toml`, a table like [material.NAME] for each entry, with the sources of its
//! values. [`expand`] puts law and keys of an entry into the tree of a model before it is read, so that the
//! reader checks them as it checks those of the file; messages about them point to the line of `from`.
//! `registries.rs` lists the entries, `schema.rs` names them.

use super::diagnostics::Faults;
use super::messages::CHOICE;
use super::tree::{self, Node, Place, Value};
use super::units::shorten;
use embate_solver::material;
use embate_solver::model::messages::CLASH;
use embate_solver::vocabulary::suggestion;
use std::collections::BTreeMap;
use std::sync::LazyLock;

const TEXT: &str = include_str!("materials.toml");
/// Keys of an entry that are no keys of a material.
const OWN: &[&str] = &["group", "about", "sources"];

/// A material of the library.
#[derive(Clone, Debug)]
pub struct LibraryMaterial {
    /// Name for `from`.
    pub name: String,
    /// Kind of material, a heading.
    pub group: String,
    /// One line: what it is.
    pub about: String,
    /// Name of its law.
    pub law: String,
    /// Name of its equation of state; empty: none.
    pub eos: String,
    /// Law, equation of state and parameters, in the order of the file.
    keys: Vec<tree::Entry>,
    /// Where the value of each key comes from.
    sources: BTreeMap<String, String>,
}

/// A value of a material of the library.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LibraryValue {
    /// Key in the model file.
    pub key: String,
    /// Value as in the model file, without the quotes of texts.
    pub value: String,
    /// Where it comes from.
    pub source: String,
}

impl LibraryMaterial {
    /// Its parameters, in the order of the file.
    pub fn values(&self) -> impl Iterator<Item = LibraryValue> {
        let shown = move |entry: &tree::Entry| LibraryValue {
            key: entry.key.clone(),
            value: written(&entry.node),
            source: self.sources.get(&entry.key).cloned().unwrap_or_default(),
        };
        self.keys.iter().filter(|entry| !matches!(entry.key.as_str(), "law" | "eos")).map(shown)
    }

    /// Where its values come from: keys, and their source.
    #[must_use]
    pub fn sources(&self) -> Vec<(Vec<String>, String)> {
        let mut all: Vec<(Vec<String>, String)> = Vec::new();
        for LibraryValue { key, source, .. } in self.values() {
            match all.iter_mut().find(|(_, other)| *other == source) {
                Some((keys, _)) => keys.push(key),
                None => all.push((vec![key], source)),
            }
        }
        all
    }

    /// Whether its law, not its equation of state, has this key.
    fn is_of_law(&self, key: &str) -> bool {
        material::registry().iter().any(|law| law.name == self.law && law.parameters.iter().any(|parameter| parameter.name == key))
    }
}

/// All materials of the library, in the order of the file.
pub fn library() -> &'static [LibraryMaterial] {
    static LIBRARY: LazyLock<Vec<LibraryMaterial>> = LazyLock::new(read);
    &LIBRARY
}

/// The material of this name.
///
/// # Errors
/// That there is none, and which may have been meant.
pub fn library_material(name: &str) -> Result<&'static LibraryMaterial, (String, String)> {
    let found = library().iter().find(|material| material.name == name);
    found.ok_or_else(|| (format!("the library has no material {}", shorten(name)), similar(name)))
}

/// The data; what is wrong with it a test says.
fn read() -> Vec<LibraryMaterial> {
    let Ok(Node { value: Value::Table(entries), .. }) = tree::document(TEXT, 0) else { return Vec::new() };
    let references: BTreeMap<String, String> =
        entries.iter().find(|entry| entry.key == "references").map(|entry| texts(&entry.node)).unwrap_or_default();
    let all = entries.into_iter().filter(|entry| entry.key != "references");
    all.filter_map(|entry| material_of(&references, entry.key, entry.node)).collect()
}

fn material_of(references: &BTreeMap<String, String>, name: String, node: Node) -> Option<LibraryMaterial> {
    let Value::Table(entries) = node.value else { return None };
    let text = |key: &str| entries.iter().find(|entry| entry.key == key).map(|entry| written(&entry.node)).unwrap_or_default();
    let [group, about, law, eos] = ["group", "about", "law", "eos"].map(text);
    let mut sources = BTreeMap::new();
    for (keys, source) in entries.iter().find(|entry| entry.key == "sources").map(|entry| texts(&entry.node)).unwrap_or_default() {
        let source = references.iter().fold(source, |text, (short, full)| text.replace(&format!("{{{short}}}"), full));
        sources.extend(keys.split(',').map(|key| (key.trim().to_string(), source.clone())));
    }
    let keys = entries.into_iter().filter(|entry| !OWN.contains(&entry.key.as_str())).collect();
    Some(LibraryMaterial { name, group, about, law, eos, keys, sources })
}

/// The texts of a table.
fn texts(node: &Node) -> BTreeMap<String, String> {
    let Value::Table(entries) = &node.value else { return BTreeMap::new() };
    entries.iter().map(|entry| (entry.key.clone(), written(&entry.node))).collect()
}

/// A value as it is written, without quotes.
fn written(node: &Node) -> String {
    match &node.value {
        Value::Text(text) | Value::Integer(text, ..) | Value::Float(text, _) => text.clone(),
        Value::Flag(flag) => flag.to_string(),
        Value::List(items) => items.iter().map(written).collect::<Vec<_>>().join(", "),
        Value::Date | Value::Table(_) => String::new(),
    }
}

/// Gives each material with `from` what it does not have itself of that material of the library.
pub(super) fn expand(root: &mut Node, faults: &mut Faults) {
    let Value::Table(sections) = &mut root.value else { return };
    for section in sections.iter_mut().filter(|section| section.key == "material") {
        let Value::Table(materials) = &mut section.node.value else { continue };
        for material in materials {
            if let Value::Table(own) = &mut material.node.value {
                complete(own, &format!("material.{}", material.key), faults);
            }
        }
    }
}

/// Adds law and keys of the library to those that a material has itself.
fn complete(own: &mut Vec<tree::Entry>, path: &str, faults: &mut Faults) {
    let Some(from) = own.iter().find(|entry| entry.key == "from").map(|entry| entry.node.clone()) else { return };
    let Value::Text(name) = &from.value else {
        // The reader says that it is no text; all else would only follow from that.
        faults.cover(path);
        return;
    };
    let found = match library_material(name) {
        Ok(found) => found,
        Err(wrong) => {
            faults.value(&CHOICE, &format!("{path}.from"), from.place, wrong);
            faults.cover(path);
            return;
        }
    };
    let text = |own: &[tree::Entry], key: &str| {
        own.iter()
            .find(|entry| entry.key == key)
            .and_then(|entry| if let Value::Text(text) = &entry.node.value { Some(text.clone()) } else { None })
    };
    let is_own = |own: &[tree::Entry], key: &str| own.iter().any(|entry| entry.key == key);
    if let Some(law) =
        own.iter_mut().find(|entry| entry.key == "law" && !matches!(&entry.node.value, Value::Text(text) if *text == found.law))
    {
        let message = format!("{} of the library has the law `{}`, but here it is {}", shorten(name), found.law, law.node.words());
        let help = "leave `law` out; or leave `from` out and give all keys of the other law".to_string();
        faults.beside(&CLASH, &format!("{path}.law"), Some(law.node.place), (message, help));
        law.node.value = Value::Text(found.law.clone());
    }
    let has_other_equation = text(own, "eos").is_some_and(|eos| eos != found.eos);
    for entry in &found.keys {
        let is_left_out = has_other_equation && !found.is_of_law(&entry.key) && entry.key != "law";
        if !is_left_out && !is_own(own, &entry.key) {
            own.push(tree::Entry { key: entry.key.clone(), place: from.place, node: at(&entry.node, from.place) });
        }
    }
}

/// The same value at another place.
fn at(node: &Node, place: Place) -> Node {
    let value = match &node.value {
        Value::List(items) => Value::List(items.iter().map(|item| at(item, place)).collect()),
        other => other.clone(),
    };
    Node { value, place }
}

/// Help for an unknown name: those whose names have all of its words, or the nearest one.
fn similar(name: &str) -> String {
    let words = |text: &str| -> Vec<String> {
        let text = text.to_lowercase().replace("aluminum", "aluminium").replace(['-', '_', '/'], " ");
        text.split_whitespace().map(str::to_string).collect()
    };
    let wanted = words(name);
    let has_all = |other: &&LibraryMaterial| wanted.iter().all(|word| words(&other.name).contains(word));
    let near: Vec<String> = library().iter().filter(has_all).take(8).map(|other| format!("`{}`", other.name)).collect();
    match near.as_slice() {
        _ if wanted.is_empty() => "`embate list materials --library` shows all".to_string(),
        [] => {
            let known: Vec<&str> = library().iter().map(|other| other.name.as_str()).collect();
            let help = suggestion(name, &known);
            if help.starts_with("did") { help } else { "`embate list materials --library` shows all".to_string() }
        }
        [one] => format!("did you mean {one}?"),
        [others @ .., last] => format!("did you mean {} or {last}?", others.join(", ")),
    }
}
