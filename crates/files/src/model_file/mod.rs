//! The model file: TOML with units, read into a [`Model`].
//!
//! The walk: text (`mod.rs`) -> tree with places (`tree.rs`) -> overrides (`set.rs`, `template.rs`) ->
//! checked values (`reader.rs`, `value.rs`, `units.rs`) -> model (`build/`) -> [`Model::check`]. What a
//! section may hold is described once, in [`embate_solver::model`] with what is read from it; the JSON schema
//! (`schema.rs`) and the manual (`manual.rs`) come from there too. Faults (`diagnostics.rs`) are collected
//! all the way and shown together; warnings of a model without faults likewise.

mod build;
mod decimal;
mod diagnostics;
mod library;
mod manual;
pub(crate) mod messages;
mod piece;
mod python;
mod reader;
mod schema;
mod set;
mod starter;
mod template;
mod tree;
mod units;
mod value;

pub use diagnostics::{Diagnostic, Diagnostics};
pub use library::{LibraryMaterial, LibraryValue, library, library_material};
pub use manual::reference_markdown;
pub use piece::check_piece;
pub use python::python;
pub use schema::schema;
pub use starter::{SCHEMA_NAME, STARTERS, Starter};

pub(crate) use diagnostics::{Faults, Source};
pub(crate) use manual::{row as key_row, table as keys_table};
pub(crate) use reader::{Document, Record, Vocabulary};
pub(crate) use template::{Change, Template};
pub(crate) use tree::Node;

use crate::PathPolicy;
use crate::model_file::messages::{ENCODING, FILE, SYNTAX};
use crate::plain;
use embate_solver::error::{Fault, Warning};
use embate_solver::message::Message;
use embate_solver::model::Model;
use embate_solver::quantity::Dimension;
use std::collections::BTreeMap;
use std::io::Read;
use std::path::Path;

/// Name of the model file in a folder.
pub const FILE_NAME: &str = "model.toml";
/// Largest model file, bytes: large meshes belong in mesh files.
const SIZE_MAX: u64 = 16 << 20;

/// Reads a model from a file, or from `model.toml` in a folder; `set` overrides keys (`path.to.key=value`).
/// The model is named after the folder if the file is `model.toml`, else after the file.
///
/// # Errors
/// All faults at once; a file outside of the model's folder is one.
pub fn load(path: &Path, set: &[String]) -> Result<Model, Diagnostics> {
    load_with_places(path, set, PathPolicy::Folder).map(|loaded| loaded.model)
}

/// [`load`], with what is needed to show warnings at their places in the file. `reach`: from where files are
/// read that the model names.
///
/// # Errors
/// All faults at once.
pub fn load_with_places(path: &Path, set: &[String], reach: PathPolicy) -> Result<Loaded, Diagnostics> {
    Template::load(path, set, reach)?.loaded(&[])
}

/// [`load_with_places`] of a model to which sections of a text are added: more of what there may be several,
/// new names, and keys of sections that stand once. Overrides come after it. Meshes that it calls by names of
/// `given` are in memory.
///
/// # Errors
/// All faults at once.
pub fn load_with_additions(
    path: &Path,
    (added, given): (&str, GivenMeshes),
    set: &[String],
    reach: PathPolicy,
) -> Result<Loaded, Diagnostics> {
    Template::load_with(path, &[added], set, reach)?.with_meshes(given).loaded(&[])
}

/// [`load_with_places`] of a model as far as it can be read, with its faults: what is faulty has values that
/// stand for what is missing. No model where the file is no TOML.
#[must_use]
pub fn load_as_far(path: &Path, set: &[String], reach: PathPolicy) -> (Option<Loaded>, Diagnostics) {
    match Template::load(path, set, reach) {
        Ok(template) => {
            let (loaded, faults) = template.loaded_as_far();
            (Some(loaded), faults)
        }
        Err(faults) => (None, faults),
    }
}

/// [`load_with_places`] of a model with faults of one kind alone: as if it had none; `None` where it has
/// others.
#[must_use]
pub fn load_despite(kind: &Message, path: &Path, set: &[String], reach: PathPolicy) -> Option<Loaded> {
    Template::load(path, set, reach).ok()?.loaded_despite(kind)
}

/// A time with its unit as in a model file, `3.1 ms` for example, or a number in s.
///
/// # Errors
/// What is wrong with it, and how it is written.
pub fn time(text: &str) -> Result<f64, String> {
    let seconds = in_si(text, units::Wanted { name: "time", dimensions: &[Dimension::TIME], angle: false })?;
    if seconds.is_finite() && seconds >= 0.0 { Ok(seconds) } else { Err(format!("{text} is no time from the start on")) }
}

/// A length with its unit as in a model file, `2 mm` for example, or a number in m.
///
/// # Errors
/// What is wrong with it, and how it is written.
pub fn length(text: &str) -> Result<f64, String> {
    let metres = in_si(text, units::Wanted { name: "length", dimensions: &[Dimension::LENGTH], angle: false })?;
    if metres.is_finite() && metres > 0.0 { Ok(metres) } else { Err(format!("{text} is no length greater than 0")) }
}

/// A quantity with its unit, or a number, in SI units.
fn in_si(text: &str, wanted: units::Wanted<'_>) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(number) => Ok(number),
        Err(_) => units::read(text, wanted).map(|(value, _)| value).map_err(|(message, help)| format!("{message}; {help}")),
    }
}

/// A model as it was read, with the texts that it came from.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The model, without faults.
    pub model: Model,
    sources: Vec<Source>,
    root: Node,
}

impl Loaded {
    /// Where the key of a path such as `part[0].ring.inner` stands, and its value as it is written there.
    #[must_use]
    pub fn key(&self, path: &str) -> KeyPlace {
        let (place, node) = self.root.find(path);
        let Some(source) = self.sources.get(place.source) else { return KeyPlace::default() };
        let line = |at: usize| 1 + source.text.bytes().take(at).filter(|&byte| byte == b'\n').count();
        let is_somewhere = place.end > place.start && place.source == 0;
        let node = node.filter(|_| !self.is_of_library(path));
        let written = node.filter(|node| !matches!(node.value, tree::Value::Table(_)) || node.place.end > node.place.start);
        let written = written.and_then(|node| source.text.get(node.place.start..node.place.end)).map(str::to_string);
        KeyPlace {
            file: source.name.clone(),
            line: if is_somewhere { line(place.start) } else { 0 },
            written: written.filter(|_| node.is_some()),
        }
    }

    /// All keys with their values as they are written, in the order of the file; `title` and the like, too.
    /// Long values are cut off.
    #[must_use]
    pub fn written(&self) -> Vec<(String, String)> {
        let mut all = Vec::new();
        self.note(&self.root, String::new(), &mut all);
        all
    }

    /// Whether all files that it names are among these: then its text and these are all of it.
    #[must_use]
    pub fn names_only(&self, given: &GivenMeshes) -> bool {
        let is_given = |value: &str| given.contains_key(value.trim_matches(['"', '\'']));
        self.written().iter().filter(|(path, _)| path.ends_with(".file")).all(|(_, value)| is_given(value))
    }

    fn note(&self, node: &Node, path: String, all: &mut Vec<(String, String)>) {
        match &node.value {
            tree::Value::Table(entries) => entries.iter().for_each(|entry| {
                let dot = if path.is_empty() { "" } else { "." };
                self.note(&entry.node, format!("{path}{dot}{}", entry.key), all);
            }),
            tree::Value::List(items) if items.iter().any(|item| matches!(item.value, tree::Value::Table(_))) => {
                items.iter().zip(0..).for_each(|(item, index): (_, usize)| self.note(item, format!("{path}[{index}]"), all));
            }
            // What came with `from` stands there.
            _ if self.is_of_library(&path) => {}
            _ => {
                let written = self.sources.get(node.place.source).and_then(|source| source.text.get(node.place.start..node.place.end));
                all.push((path, on_a_line(written.unwrap_or_default())));
            }
        }
    }

    /// Whether the value of a key came with `from`: it stands where that does.
    fn is_of_library(&self, path: &str) -> bool {
        let place = |path: &str| self.root.find(path).1.map(|node| node.place);
        let from = path.strip_prefix("material.").and_then(|_| path.rsplit_once('.')).map(|(material, _)| format!("{material}.from"));
        from.is_some_and(|from| from != path && place(&from).is_some_and(|at| place(path) == Some(at)))
    }

    /// Warnings of the model (those of [`Model::warnings`], of a simulation made from it) with their lines
    /// and columns; no text where there are none.
    #[must_use]
    pub fn reported(&self, warnings: &[Warning]) -> Diagnostics {
        Faults::warnings(warnings).into_diagnostics(&self.sources, Some(&self.root))
    }

    /// Faults that were found when a simulation was made of the model, with their lines and columns.
    #[must_use]
    pub fn faulty(&self, faults: &[Fault]) -> Diagnostics {
        let mut all = Faults::default();
        faults.iter().cloned().for_each(|fault| all.of_model(fault));
        all.into_diagnostics(&self.sources, Some(&self.root))
    }
}

/// Longest value that is given as it is written, characters.
const WRITTEN_MAX: usize = 400;

/// A value on one line.
fn on_a_line(written: &str) -> String {
    let line = written.split_whitespace().collect::<Vec<_>>().join(" ");
    let short: String = line.chars().take(WRITTEN_MAX).collect();
    if short.len() < line.len() { format!("{short} ...") } else { line }
}

/// Where a key stands in the file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct KeyPlace {
    /// File as it was named, or `--set`.
    pub file: String,
    /// Line from 1 of the key, or of the nearest thing above it that is there; 0: nothing of it is there.
    pub line: usize,
    /// Its value as it is written; `None` where the key is not there.
    pub written: Option<String>,
}

/// A file of described sections that has been read, with the text to which later faults point.
#[derive(Clone, Debug)]
pub(crate) struct Described {
    source: Source,
    root: Node,
}

impl Described {
    /// Reads the file and makes something of its records; all faults, also those that `make` notes, at once.
    pub(crate) fn read<T>(
        file: &Path,
        vocabulary: &Vocabulary,
        make: impl FnOnce(&Document, &mut Faults) -> T,
    ) -> Result<(Self, T), Diagnostics> {
        let mut faults = Faults::default();
        let (source, root) = parsed(source(file)?)?;
        let made = make(&reader::read(&root, vocabulary, false, &mut faults), &mut faults);
        if faults.is_empty() { Ok((Self { source, root }, made)) } else { Err(faults.into_diagnostics(&[source], Some(&root))) }
    }

    /// Faults that were found later, by their paths in the file.
    pub(crate) fn reported(&self, faults: Faults) -> Diagnostics {
        faults.into_diagnostics(std::slice::from_ref(&self.source), Some(&self.root))
    }
}

/// The text of a file.
fn source(file: &Path) -> Result<Source, Diagnostics> {
    let shown = file.display().to_string();
    let bytes = read(file).map_err(|(message, help)| Diagnostics::plain(&FILE, shown.clone(), message, help))?;
    match String::from_utf8(bytes) {
        Ok(text) => Ok(Source { name: shown, text }),
        Err(error) => {
            let at = error.utf8_error().valid_up_to();
            let text = String::from_utf8_lossy(error.as_bytes()).into_owned();
            let mut faults = Faults::default();
            let place = tree::Place { source: 0, start: at, end: at + 1 };
            let texts = ("the file is not UTF-8 text".to_string(), "save it with the encoding UTF-8".to_string());
            faults.beside(&ENCODING, "", Some(place), texts);
            Err(faults.into_diagnostics(&[Source { name: shown, text }], None))
        }
    }
}

/// Reads a model from a text. `name` becomes the model's name and stands for the file in messages; mesh files
/// are looked for in `folder` and nowhere else.
///
/// # Errors
/// All faults at once.
pub fn load_text(name: &str, text: &str, folder: &Path, set: &[String]) -> Result<Model, Diagnostics> {
    load_text_with_places(name, text, folder, set).map(|loaded| loaded.model)
}

/// [`load_text`], with what is needed to show warnings at their places in the text.
///
/// # Errors
/// All faults at once.
pub fn load_text_with_places(name: &str, text: &str, folder: &Path, set: &[String]) -> Result<Loaded, Diagnostics> {
    Template::of(name, Source { name: name.to_string(), text: text.to_string() }, &[], (folder, PathPolicy::Folder), set)?.loaded(&[])
}

/// Meshes in memory, each the bytes of a .msh file, by the names by which a model's text calls them as files.
pub type GivenMeshes = BTreeMap<String, Vec<u8>>;

/// [`load_text_with_places`] of a text that calls some meshes by names of what is in memory; other files are
/// looked for in `folder`, as far as `reach` lets.
///
/// # Errors
/// All faults at once.
pub fn load_text_with_meshes(
    name: &str,
    text: &str,
    (folder, reach): (&Path, PathPolicy),
    set: &[String],
    given: GivenMeshes,
) -> Result<Loaded, Diagnostics> {
    let source = Source { name: name.to_string(), text: text.to_string() };
    Template::of(name, source, &[], (folder, reach), set)?.with_meshes(given).loaded(&[])
}

/// The SI value and the dimension of a quantity such as `3 mm`; `None` if it is none.
pub(crate) fn quantity_in_si(text: &str) -> Option<(f64, Dimension)> {
    units::read(text, units::Wanted { name: "quantity", dimensions: &[], angle: false }).ok()
}

/// The SI value of a quantity or an angle, and its unit in SI; `None` if it is none.
pub(crate) fn value_in_si(text: &str) -> Option<(f64, String)> {
    let (value, dimension) = units::read(text, units::Wanted { name: "value", dimensions: &[], angle: true }).ok()?;
    let (_, unit) = number_and_unit(text)?;
    let is_angle = ["deg", "rad", "rpm"].iter().any(|word| unit.contains(word));
    Some((
        value,
        match dimension {
            Dimension::NONE if is_angle => "rad".to_string(),
            Dimension::RATE if is_angle => "rad/s".to_string(),
            dimension => dimension.unit(),
        },
    ))
}

/// The number that a text begins with, and its unit as written; `None` if it does not begin with a number.
pub(crate) fn number_and_unit(text: &str) -> Option<(f64, &str)> {
    let (number, unit) = decimal::Decimal::read(text.trim())?;
    Some((number.scaled(1, 1, 0), unit.trim()))
}

/// The tree of a text.
fn parsed(source: Source) -> Result<(Source, Node), Diagnostics> {
    parsed_as(0, source)
}

/// The tree of a text that is the source of this number.
fn parsed_as(number: usize, mut source: Source) -> Result<(Source, Node), Diagnostics> {
    if source.text.starts_with('\u{feff}') {
        source.text.remove(0);
    }
    match tree::document(&source.text, number) {
        Ok(root) => Ok((source, root)),
        Err(fault) => {
            let mut faults = Faults::default();
            let place = fault.place.map(|range| tree::Place { source: 0, start: range.start, end: range.end });
            let help = syntax_help(&fault.message).to_string();
            faults.beside(&SYNTAX, "", place, (fault.message, help));
            Err(faults.into_diagnostics(&[source], None))
        }
    }
}

/// What to do about a fault of TOML's syntax.
fn syntax_help(message: &str) -> &'static str {
    if message.contains("must be quoted") {
        "texts and numbers with units stand in quotes, for example \"10 ms\""
    } else if message.contains("duplicate key") {
        "each key and each [section] stands once; [[part]] and its like may be repeated"
    } else if message.contains("recurs") {
        "the model file needs no deep nesting"
    } else {
        "see https://toml.io for the syntax"
    }
}

/// The bytes of a file of sensible size.
fn read(file: &Path) -> Result<Vec<u8>, (String, String)> {
    let cannot = |error: &std::io::Error| match error.kind() {
        std::io::ErrorKind::NotFound => ("there is no such file".to_string(), near_files(file)),
        _ => (format!("the file can't be read: {error}"), String::new()),
    };
    // A shell hands over what another program prints under such names, and there a pipe is meant.
    let is_of_shell = ["/dev/stdin", "/dev/fd", "/proc/self/fd"].iter().any(|place| file.starts_with(place));
    let opened = if is_of_shell { std::fs::File::open(file) } else { plain::open(file) }.map_err(|error| cannot(&error))?;
    let mut bytes = Vec::new();
    opened.take(SIZE_MAX + 1).read_to_end(&mut bytes).map_err(|error| cannot(&error))?;
    if bytes.len() as u64 > SIZE_MAX {
        let message = format!("the file is larger than {} MiB", SIZE_MAX >> 20);
        return Err((message, "this is no model file: put large meshes into mesh files".to_string()));
    }
    Ok(bytes)
}

/// Help for a file that is not there: the model files beside it.
fn near_files(file: &Path) -> String {
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let Ok(listing) = std::fs::read_dir(folder) else {
        return format!("there is no folder {} either", folder.display());
    };
    let mut names: Vec<String> = listing
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml") || path.join(FILE_NAME).is_file())
        .map(|path| path.display().to_string())
        .collect();
    names.sort();
    names.truncate(8);
    match names.as_slice() {
        [] => format!("make one with `embate new NAME`, or give a folder that holds a {FILE_NAME}"),
        _ => format!("near it are {}", names.join(", ")),
    }
}

fn name_of(file: &Path) -> String {
    let own = |path: &Path| path.file_stem().map(|name| name.to_string_lossy().into_owned());
    if file.file_name().is_some_and(|name| name == FILE_NAME) {
        let folder =
            std::path::absolute(file).ok().and_then(|path| path.canonicalize().ok()).and_then(|path| path.parent().map(Path::to_path_buf));
        let name = folder.as_deref().and_then(Path::file_name).map(|name| name.to_string_lossy().into_owned());
        return name.unwrap_or_else(|| "model".to_string());
    }
    own(file).unwrap_or_else(|| "model".to_string())
}
