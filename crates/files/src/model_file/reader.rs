//! Reads the tree of a model file section by section, key by key, as
//! [`sections`](embate_solver::input::sections) says.
//!
//! The tree comes from `tree.rs`; records of checked values go to `build/`. Every fault is noted and
//! reading continues.

use super::diagnostics::Faults;
use super::tree::{Entry, Node, Place, Value};
use super::value::{self, Wrong};
use crate::model_file::messages::{FORM, MISSING_KEY, MISSING_SECTION, UNKNOWN_KEY};
use embate_solver::element::registry;
use embate_solver::input::sections::{MOVED, SECTIONS, TOP};
use embate_solver::mesh::shapes::Shape;
use embate_solver::message::Message;
use embate_solver::model::Values;
use embate_solver::model::messages::{CLASH, LIST_LENGTH};
use embate_solver::model::values::{Datum, Field};
use embate_solver::quantity::Dimension;
use embate_solver::stress_state::STRESS_STATES;
use embate_solver::vocabulary::{Form, Key, Kind, Need, Rule, Section, nearest, suggestion};
use std::collections::BTreeMap;

/// What a kind of file may hold.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vocabulary {
    /// What the file describes, for messages: `model`.
    pub(crate) what: &'static str,
    /// Keys above all sections.
    pub(crate) top: &'static Section,
    /// Its sections.
    pub(crate) sections: &'static [&'static Section],
}

/// The model file.
pub(super) static MODEL: Vocabulary = Vocabulary { what: "model", top: &TOP, sections: SECTIONS };

impl Vocabulary {
    fn section(&self, name: &str) -> Option<&'static Section> {
        self.sections.iter().find(|section| section.name == name).copied()
    }
}

/// The values of one table: those of the file that are sound, and defaults.
#[derive(Clone, Debug, Default)]
pub(crate) struct Record {
    /// Path of the table.
    pub(crate) path: String,
    /// Where it stands.
    pub(super) place: Place,
    /// Name in `[section.NAME]`; empty elsewhere.
    pub(crate) name: String,
    values: BTreeMap<String, Datum>,
    tables: BTreeMap<String, Record>,
    lists: BTreeMap<String, Vec<Record>>,
    /// Keys that the file has, sound or not, with the places of their values.
    written: BTreeMap<String, Place>,
}

/// All tables of a file.
#[derive(Clone, Debug, Default)]
pub(crate) struct Document {
    /// Whether units were read as those of solids.
    pub(super) is_of_solids: bool,
    /// Keys above all sections.
    pub(crate) top: Record,
    sections: BTreeMap<&'static str, Vec<Record>>,
}

impl Document {
    /// The tables of a section, in the order of the file.
    pub(crate) fn section(&self, name: &str) -> &[Record] {
        self.sections.get(name).map_or(&[], Vec::as_slice)
    }

    /// All tables of all sections.
    pub(super) fn records(&self) -> impl Iterator<Item = &Record> {
        self.sections.values().flatten()
    }
}

impl Record {
    /// Path of one of its keys.
    pub(crate) fn key(&self, name: &str) -> String {
        format!("{}.{name}", self.path)
    }

    /// Where a key's value stands, if the file has it.
    pub(crate) fn written(&self, name: &str) -> Option<Place> {
        self.written.get(name).copied()
    }

    /// Whether a key has a sound value, of the file or by default.
    pub(super) fn is_sound(&self, name: &str) -> bool {
        self.values.contains_key(name) || self.tables.contains_key(name) || self.lists.contains_key(name)
    }

    /// Whether a key has this value, a text or a flag; `None` where its value is not sound.
    fn has(&self, name: &str, value: &str) -> Option<bool> {
        match self.values.get(name) {
            Some(Datum::Text(text)) => Some(text == value),
            Some(Datum::Flag(flag)) => Some(flag.to_string() == value),
            _ => None,
        }
    }

    /// The value of a key, or its placeholder; of an `Option` nothing.
    pub(crate) fn get<T: Field>(&self, name: &str) -> T {
        (self as &dyn Values).get(name)
    }

    pub(crate) fn number(&self, name: &str) -> Option<f64> {
        self.get(name)
    }

    pub(crate) fn text(&self, name: &str) -> String {
        self.get(name)
    }

    pub(crate) fn table(&self, name: &str) -> Option<&Self> {
        self.tables.get(name)
    }
}

impl Values for Record {
    fn has(&self, key: &str) -> bool {
        self.written.contains_key(key)
    }

    fn values(&self) -> &BTreeMap<String, Datum> {
        &self.values
    }

    fn tables(&self) -> Vec<(&str, &dyn Values)> {
        self.tables.iter().map(|(key, record)| (key.as_str(), record as &dyn Values)).collect()
    }

    fn list(&self, key: &str) -> Option<Vec<&dyn Values>> {
        Some(self.lists.get(key)?.iter().map(|record| record as &dyn Values).collect())
    }
}

/// Reads all sections. Where keys alone do not say so, `solids` says that parts are solids.
pub(super) fn read(root: &Node, vocabulary: &Vocabulary, solids: bool, faults: &mut Faults) -> Document {
    sections_of(root, vocabulary, if solids { Extent::Solid } else { extent(root) }, faults)
}

fn sections_of(root: &Node, vocabulary: &Vocabulary, extent: Extent, faults: &mut Faults) -> Document {
    let mut reader = Reader { vocabulary, faults, extent };
    let mut document = Document { is_of_solids: extent == Extent::Solid, ..Document::default() };
    let Value::Table(entries) = &root.value else { return document };
    let (sections, others): (Vec<&Entry>, Vec<&Entry>) = entries.iter().partition(|entry| vocabulary.section(&entry.key).is_some());
    let others: Vec<Entry> = others.into_iter().cloned().collect();
    document.top = reader.table(vocabulary.top, &others, "", root.place);
    for entry in sections {
        if let Some(section) = vocabulary.section(&entry.key) {
            document.sections.insert(section.name, reader.section(section, entry));
        }
    }
    for section in vocabulary.sections.iter().filter(|section| section.required && !document.sections.contains_key(section.name)) {
        let message = format!("the {} has no {}", vocabulary.what, header(section));
        reader.faults.cover(section.name);
        reader.faults.beside(&MISSING_SECTION, section.name, None, (message, section.doc.to_string()));
    }
    document
}

/// Faults of some sections of a model, whatever else it has: those that hold in 2D, axisymmetric and in 3D;
/// sections and keys that are missing belong to the whole where a section stands once.
pub(super) fn faults_of_piece(root: &Node) -> Faults {
    let read_as = |extent: Extent| {
        let mut faults = Faults::default();
        sections_of(root, &MODEL, extent, &mut faults);
        faults
    };
    let first = extent(root);
    let others: Vec<Faults> =
        [Extent::Slice, Extent::Revolution, Extent::Solid].into_iter().filter(|&it| it != first).map(read_as).collect();
    let mut faults = read_as(first);
    let is_single = |path: &str| {
        let name = path.split(['.', '[']).next().unwrap_or(path);
        MODEL.section(name).is_none_or(|section| matches!(section.form, Form::Single))
    };
    let is_of_whole = |kind: &Message| kind == &MISSING_SECTION || kind == &MISSING_KEY || kind == &CLASH;
    faults.keep_shared(&others, |kind, path| kind != &MISSING_SECTION && !(is_of_whole(kind) && is_single(path)));
    faults
}

/// How a section's header is written.
pub(super) fn header(section: &Section) -> String {
    match section.form {
        Form::Single => format!("[{}]", section.name),
        Form::Repeated => format!("[[{}]]", section.name),
        Form::Named => format!("[{}.NAME]", section.name),
        Form::Inline => format!("{} = {{ ... }}", section.name),
    }
}

struct Reader<'a> {
    vocabulary: &'a Vocabulary,
    faults: &'a mut Faults,
    extent: Extent,
}

/// What masses and forces of a model are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Extent {
    /// Those of a metre of depth.
    Slice,
    /// Those of whole axisymmetric bodies.
    Revolution,
    /// Those of solids.
    Solid,
}

/// What the keys of its parts say: whether one is axisymmetric or a solid; those that don't agree are
/// reported later. Of groups of mesh files the files know ([`read`]).
fn extent(root: &Node) -> Extent {
    let Value::Table(sections) = &root.value else { return Extent::Slice };
    let parts = sections.iter().filter(|section| section.key == "part").filter_map(|section| match &section.node.value {
        Value::List(parts) => Some(parts),
        _ => None,
    });
    let keys = || parts.clone().flatten().filter_map(|part| if let Value::Table(keys) = &part.value { Some(keys) } else { None }).flatten();
    let is_solid = |key: &Entry| match &key.node.value {
        Value::Text(name) if key.key == "element" => registry().iter().any(|kind| kind.name == name && kind.dimension == 3),
        _ => Shape::is_solid_key(&key.key),
    };
    let is_round = |key: &Entry| {
        let is = |name: &str| STRESS_STATES.iter().any(|kind| kind.name == name && kind.state.is_axisymmetric);
        key.key == "stress_state" && matches!(&key.node.value, Value::Text(name) if is(name))
    };
    if keys().any(is_solid) {
        Extent::Solid
    } else if keys().any(is_round) {
        Extent::Revolution
    } else {
        Extent::Slice
    }
}

impl Extent {
    /// A key without the metre of depth where bodies are whole ones. Springs of an axisymmetric body are
    /// those of its circumference, per metre of it.
    fn of(self, key: &Key) -> Key {
        let whole = |dimension: Dimension| match (dimension, key.name) {
            (other, _) if self == Self::Slice => other,
            (Dimension::MASS_PER_LENGTH, _) => Dimension::MASS,
            (Dimension::FORCE_PER_LENGTH, _) => Dimension::FORCE,
            (Dimension::LENGTH, "orifice") => Dimension::AREA,
            (Dimension::VISCOSITY, "rate") => Dimension::FORCE_PER_VELOCITY,
            (other, _) if self == Self::Revolution => other,
            (Dimension::PRESSURE, "stiffness") => Dimension::FORCE_PER_LENGTH,
            (Dimension::VISCOSITY, "damping") => Dimension::FORCE_PER_VELOCITY,
            (Dimension::LENGTH, "area") => Dimension::AREA,
            (Dimension::FORCE, "moment" | "moment_strength") => Dimension::MOMENT,
            (Dimension::INERTIA_PER_LENGTH, _) => Dimension::INERTIA,
            (Dimension::PRESSURE, "penalty") => Dimension::FORCE_PER_LENGTH,
            (other, _) => other,
        };
        let kind = match key.kind {
            Kind::Quantity(dimension, range) => Kind::Quantity(whole(dimension), range),
            Kind::Quantities(dimension, range, least) if self == Self::Solid => Kind::Quantities(whole(dimension), range, least),
            Kind::Stiffness(dimension, range) => Kind::Stiffness(whole(dimension), range),
            Kind::MassFlow(dimension, range) => Kind::MassFlow(whole(dimension), range),
            Kind::Vector(dimension, range) => Kind::Vector(whole(dimension), range),
            Kind::Spatial(dimension, range) => Kind::Spatial(whole(dimension), range),
            other => other,
        };
        Key { kind, ..*key }
    }
}

impl Reader<'_> {
    fn section(&mut self, section: &Section, entry: &Entry) -> Vec<Record> {
        let name = section.name;
        match (section.form, &entry.node.value) {
            (Form::Single | Form::Inline, Value::Table(entries)) => vec![self.table(section, entries, name, entry.node.place)],
            (Form::Repeated, Value::List(items)) => {
                items.iter().enumerate().filter_map(|(index, item)| self.item(section, item, &format!("{name}[{index}]"))).collect()
            }
            (Form::Named, Value::Table(entries)) => entries.iter().filter_map(|entry| self.named(section, entry)).collect(),
            _ => {
                let help = if section.form == Form::Repeated { "in double brackets, because there may be several" } else { "" };
                let texts = (format!("`{name}` must be written as {}", header(section)), help.to_string());
                self.faults.value(&FORM, name, entry.node.place, texts);
                Vec::new()
            }
        }
    }

    fn item(&mut self, section: &Section, item: &Node, path: &str) -> Option<Record> {
        if let Value::Table(entries) = &item.value {
            return Some(self.table(section, entries, path, item.place));
        }
        self.faults.value(
            &FORM,
            path,
            item.place,
            (format!("`{}` is not a list of tables", section.name), format!("write {}", header(section))),
        );
        None
    }

    fn named(&mut self, section: &Section, entry: &Entry) -> Option<Record> {
        let path = format!("{}.{}", section.name, entry.key);
        if let Value::Table(entries) = &entry.node.value {
            let mut record = self.table(section, entries, &path, entry.node.place);
            record.name.clone_from(&entry.key);
            return Some(record);
        }
        let message = format!("`{}` stands in `{}` without a name", shown(&entry.key), section.name);
        self.faults.value(&FORM, &path, entry.place, (message, format!("give it a name: write {}", header(section))));
        None
    }

    /// Reads one table: its keys, those that are missing, and its rules.
    fn table(&mut self, section: &Section, entries: &[Entry], path: &str, place: Place) -> Record {
        let mut record = Record { path: path.to_string(), place, ..Record::default() };
        let (keys, complete) = keys_of(section, entries);
        for entry in entries {
            let path = join(path, &entry.key);
            record.written.insert(entry.key.clone(), entry.node.place);
            match keys.iter().find(|key| key.name == entry.key) {
                Some(key) => match (key.kind, &entry.node.value) {
                    (Kind::Table(section), Value::Table(entries)) => {
                        record.tables.insert(entry.key.clone(), self.table(section, entries, &path, entry.node.place));
                    }
                    (Kind::Tables(section), Value::List(items)) if !items.is_empty() => {
                        let items = items.iter().enumerate();
                        let read = items.filter_map(|(index, item)| self.item(section, item, &format!("{path}[{index}]"))).collect();
                        record.lists.insert(entry.key.clone(), read);
                    }
                    _ => record.values.extend(self.datum(key, &entry.node, &path).map(|datum| (entry.key.clone(), datum))),
                },
                None if complete => self.unknown(section, &keys, entry, &path),
                None => {}
            }
        }
        for key in keys.iter().filter(|key| !record.written.contains_key(key.name)) {
            match key.need {
                Need::Required => self.missing(section, key, &join(path, key.name), place),
                Need::Value(value) => drop(record.values.insert(key.name.to_string(), Datum::Number(value))),
                Need::Default(text) => {
                    let datum = super::tree::value(text, 0, 0).and_then(|node| value::read(key, &node, "").ok());
                    record.values.extend(datum.map(|datum| (key.name.to_string(), datum)));
                }
                Need::Optional(_) => {}
            }
        }
        for rule in section.all_rules() {
            self.rule(rule, section, &record, place);
        }
        record
    }

    fn datum(&mut self, key: &Key, node: &Node, path: &str) -> Option<Datum> {
        let key = self.extent.of(key);
        if let (Extent::Solid, Kind::Spatial(..), Value::List(components)) = (self.extent, key.kind, &node.value)
            && components.len() == 2
            && value::read(&key, node, path).is_ok()
        {
            let message = format!("`{}` has two components, but the model is 3D", key.name);
            let help = "give the third too, along z: 0 where there is nothing along it".to_string();
            self.faults.value(&LIST_LENGTH, path, node.place, (message, help));
            return None;
        }
        match value::read(&key, node, path) {
            Ok(datum) => Some(datum),
            Err(wrongs) => {
                self.faults.cover(path);
                for Wrong { kind, path, place, texts } in wrongs {
                    self.faults.value(kind, &path, place, texts);
                }
                None
            }
        }
    }

    fn missing(&mut self, section: &Section, key: &Key, path: &str, place: Place) {
        let what = if section.name.is_empty() { format!("the {}", self.vocabulary.what) } else { called(section, path) };
        self.faults.value(&MISSING_KEY, path, place, lacking(&what, key));
    }

    fn unknown(&mut self, section: &Section, keys: &[Key], entry: &Entry, path: &str) {
        let mut known: Vec<&str> = keys.iter().map(|key| key.name).collect();
        if section.name.is_empty() {
            known.extend(self.vocabulary.sections.iter().map(|section| section.name));
        }
        let name = entry.key.as_str();
        let home = |other: &&&Section| other.name != section.name && other.all_keys().any(|key| key.name == name);
        let within = |key: &&Key| key.kind.inner().is_some_and(|inner| inner.all_keys().any(|key| key.name == name));
        let moved = MOVED.iter().find(|(old, _)| section.name.is_empty() && *old == name);
        let help = match nearest(name, known.iter().copied()) {
            _ if moved.is_some() => moved.map_or(String::new(), |(_, help)| (*help).to_string()),
            Some(near) => format!("did you mean `{near}`?"),
            None if let Some(key) = keys.iter().find(within) => format!("`{name}` belongs in `{} = {{ ... }}`", key.name),
            None if self.vocabulary.top.keys.iter().any(|key| key.name == name) => format!("`{name}` stands above all sections"),
            None => match self.vocabulary.sections.iter().find(home) {
                Some(other) => format!("`{name}` belongs in {}", header(other)),
                None => suggestion("", &known),
            },
        };
        let what = if section.name.is_empty() { format!("a {}", self.vocabulary.what) } else { called(section, path) };
        self.faults.value(&UNKNOWN_KEY, path, entry.place, (format!("{what} has no key `{}`", shown(name)), help));
    }

    fn rule(&mut self, rule: &Rule, section: &Section, record: &Record, place: Place) {
        match rule {
            Rule::Only { keys, by, value } => return self.only(section, record, keys, (by, value)),
            Rule::With { by, value, keys } => return self.with(section, record, (by, value), keys),
            Rule::OneOf(_) | Rule::SomeOf(_) | Rule::NotBoth(..) | Rule::Needs(..) => {}
        }
        let has = |name: &&str| record.written.contains_key(*name);
        let list = |names: &[&str], last: &str| {
            let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
            match quoted.split_last() {
                Some((end, rest)) if !rest.is_empty() => format!("{} {last} {end}", rest.join(", ")),
                _ => quoted.concat(),
            }
        };
        let what = called(section, &record.path);
        let (at, message, help) = match rule {
            Rule::OneOf(names) => {
                let present: Vec<&str> = names.iter().filter(|name| has(name)).copied().collect();
                match present.as_slice() {
                    [_] => return,
                    [] => {
                        names.iter().for_each(|name| self.faults.cover(&record.key(name)));
                        (place, format!("{what} needs one of {}", list(names, "and")), "add one of them".to_string())
                    }
                    [_, second, ..] => (
                        record.written(second).unwrap_or(place),
                        format!("{what} has {} at once", list(&present, "and")),
                        "leave all but one of them out".to_string(),
                    ),
                }
            }
            Rule::SomeOf(names) if !names.iter().any(&has) => {
                names.iter().for_each(|name| self.faults.cover(&record.key(name)));
                (place, format!("{what} needs {}", list(names, "or")), "add one of them".to_string())
            }
            Rule::NotBoth(one, other) if has(one) && has(other) => (
                record.written(other).unwrap_or(place),
                format!("{what} has `{one}` and `{other}` at once"),
                "leave one of them out".to_string(),
            ),
            Rule::Needs(one, other) if has(one) && !has(other) => {
                (record.written(one).unwrap_or(place), format!("{what} has `{one}` but no `{other}`"), format!("add `{other}`"))
            }
            _ => return,
        };
        self.faults.beside(&CLASH, &record.path, Some(at), (message, help));
        if let Rule::Needs(_, other) = rule {
            self.faults.cover(&record.key(other));
        }
    }

    /// Keys that go only with a value of another one.
    fn only(&mut self, section: &Section, record: &Record, keys: &[&str], (by, value): (&str, &str)) {
        if record.has(by, value) != Some(false) {
            return;
        }
        for name in keys {
            if let Some(place) = record.written(name) {
                let only = written((by, value));
                let texts = (
                    format!("`{name}` in {} goes only with {only}", called(section, &record.path)),
                    format!("add {only}, or leave `{name}` out"),
                );
                self.faults.value(&CLASH, &record.key(name), place, texts);
            }
        }
    }

    /// Keys that must be there with a value of another one.
    fn with(&mut self, section: &Section, record: &Record, (by, value): (&str, &str), keys: &[&str]) {
        let Some(place) = record.written(by).filter(|_| record.has(by, value) == Some(true)) else { return };
        for name in keys.iter().filter(|name| record.written(name).is_none()) {
            let message = format!("{} has {} but no `{name}`", called(section, &record.path), written((by, value)));
            let example =
                section.all_keys().find(|key| key.name == *name).map_or(String::new(), |key| format!(" = {}", value::example(key)));
            self.faults.beside(&CLASH, &record.path, Some(place), (message, format!("add `{name}{example}`")));
            self.faults.cover(&record.key(name));
        }
    }
}

/// A key with a value, as a file has it.
pub(super) fn written((by, value): (&str, &str)) -> String {
    if matches!(value, "true" | "false") { format!("`{by} = {value}`") } else { format!("`{by} = \"{value}\"`") }
}

/// The keys that a table may have, and whether these are all: not while the key that decides over the others
/// is unknown.
fn keys_of(section: &Section, entries: &[Entry]) -> (Vec<Key>, bool) {
    let mut keys: Vec<Key> = section.all_keys().copied().collect();
    let mut complete = true;
    for more in section.more {
        let chosen = entries.iter().find(|entry| entry.key == more.by).map(|entry| &entry.node.value);
        let is_needed = |rule: &Rule| matches!(rule, Rule::SomeOf(names) if names.contains(&more.by));
        let required =
            section.all_keys().any(|key| key.name == more.by && key.need == Need::Required) || section.all_rules().any(is_needed);
        let further = if let Some(Value::Text(text)) = chosen { (more.keys)(text) } else { None };
        complete &= further.is_some() || (chosen.is_none() && !required);
        for key in further.into_iter().flatten() {
            if keys.iter().all(|known| known.name != key.name) {
                keys.push(key);
            }
        }
    }
    (keys, complete)
}

fn join(path: &str, key: &str) -> String {
    if path.is_empty() { key.to_string() } else { format!("{path}.{key}") }
}

/// What is said where a key is missing.
pub(super) fn lacking(what: &str, key: &Key) -> (String, String) {
    (format!("{what} has no `{}`", key.name), format!("add `{} = {}`: {}", key.name, value::example(key), lower(key.doc)))
}

/// What a table is called in messages: its header, or its key for an inline one.
fn called(section: &Section, path: &str) -> String {
    match section.form {
        Form::Inline => format!("`{}`", section.name),
        Form::Named => {
            let name: String = path.split('.').nth(1).unwrap_or("NAME").to_string();
            format!("[{}.{}]", section.name, shown(&name))
        }
        _ => header(section),
    }
}

fn shown(name: &str) -> String {
    super::units::shorten(name).trim_matches('"').to_string()
}

/// A sentence as the end of another one.
fn lower(doc: &str) -> String {
    let mut chars = doc.trim_end_matches('.').chars();
    chars.next().map_or(String::new(), |first| first.to_lowercase().chain(chars).collect())
}
