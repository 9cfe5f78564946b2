//! A model file that has been read once, from which models with other values are made.
//!
//! The tree comes from `tree.rs`, overrides and changes go into it through `set.rs` before a model is read
//! from it, so every check of the reader holds for every variant, and a fault shows the text that a value
//! came from. [`Template::model`] gives models to `load` and to sweeps.

use super::diagnostics::{Diagnostics, Faults, Source};
use super::tree::{self, Node, Place, Value};
use super::{FILE_NAME, GivenMeshes, Loaded, build, library, name_of, parsed, parsed_as, piece, reader, set, source};
use crate::PathPolicy;
use crate::model_file::messages::OVERRIDE;
use embate_solver::error::Fault;
use embate_solver::message::Message;
use embate_solver::model::Model;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A model file ready to be varied.
#[derive(Clone, Debug)]
pub(crate) struct Template {
    name: String,
    folder: PathBuf,
    reach: PathPolicy,
    given: Arc<GivenMeshes>,
    sources: Vec<Source>,
    root: Node,
    /// What is wrong with the overrides.
    faults: Faults,
}

/// One key that gets another value.
#[derive(Clone, Debug)]
pub(crate) struct Change<'a> {
    /// Which of the template's sources the key and the value stand in.
    pub(crate) source: usize,
    /// Where the key stands.
    pub(crate) key: Range<usize>,
    /// Path of the key: `material.steel.yield`.
    pub(crate) path: &'a str,
    /// Where the value, or the range that it lies in, stands.
    pub(crate) place: Range<usize>,
    /// The value as in a model file; quotes around texts may be left out.
    pub(crate) text: &'a str,
}

impl Template {
    /// Reads the file, or `model.toml` in a folder, with overrides (`path.to.key=value`).
    ///
    /// # Errors
    /// A file that can't be read or is no TOML. Faults of the overrides are reported with those of a model.
    pub(crate) fn load(path: &Path, set: &[String], reach: PathPolicy) -> Result<Self, Diagnostics> {
        Self::load_with(path, &[], set, reach)
    }

    /// The same with sections that texts add.
    ///
    /// # Errors
    /// As there, also of the texts.
    pub(super) fn load_with(path: &Path, added: &[&str], set: &[String], reach: PathPolicy) -> Result<Self, Diagnostics> {
        let file = if path.is_dir() { path.join(FILE_NAME) } else { path.to_path_buf() };
        let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).map_or_else(|| PathBuf::from("."), Path::to_path_buf);
        Self::of(&name_of(&file), source(&file)?, added, (&folder, reach), set)
    }

    pub(super) fn of(
        name: &str,
        source: Source,
        added: &[&str],
        (folder, reach): (&Path, PathPolicy),
        set: &[String],
    ) -> Result<Self, Diagnostics> {
        let (source, mut root) = parsed(source)?;
        let (mut sources, mut faults) = (vec![source], Faults::default());
        for text in added {
            let (source, more) = parsed_as(sources.len(), Source { name: piece::ADDED.to_string(), text: (*text).to_string() })?;
            sources.push(source);
            piece::add(&mut root, more, &mut faults);
        }
        set::apply(&mut root, set, &mut sources, &mut faults);
        Ok(Self { name: name.to_string(), folder: folder.to_path_buf(), reach, given: Arc::default(), sources, root, faults })
    }

    /// The same with meshes that are in memory.
    pub(super) fn with_meshes(self, given: GivenMeshes) -> Self {
        Self { given: Arc::new(given), ..self }
    }

    /// Adds a text that changes come from; its number is that of [`Change::source`].
    pub(crate) fn add_source(&mut self, name: &str, text: &str) -> usize {
        self.sources.push(Source { name: name.to_string(), text: text.to_string() });
        self.sources.len() - 1
    }

    /// The text of a source.
    pub(crate) fn source(&self, source: usize) -> &str {
        &self.sources[source].text
    }

    /// A fault in one of the added texts.
    pub(crate) fn fault(kind: &'static Message, faults: &mut Faults, source: usize, at: Range<usize>, wrong: (String, String)) {
        faults.beside(kind, "", Some(Place { source, start: at.start, end: at.end }), wrong);
    }

    /// Faults with their places.
    pub(crate) fn reported(&self, faults: Faults) -> Diagnostics {
        faults.into_diagnostics(&self.sources, Some(&self.root))
    }

    /// The model with these changes.
    ///
    /// # Errors
    /// All faults at once.
    pub(crate) fn model(&self, changes: &[Change<'_>]) -> Result<Model, Diagnostics> {
        self.loaded(changes).map(|loaded| loaded.model)
    }

    /// The model with these changes, with what is needed to show warnings at their places.
    ///
    /// # Errors
    /// All faults at once.
    pub(super) fn loaded(&self, changes: &[Change<'_>]) -> Result<Loaded, Diagnostics> {
        let (loaded, faults) = self.read(changes);
        if faults.is_empty() { Ok(loaded) } else { Err(faults.into_diagnostics(&self.sources, Some(&loaded.root))) }
    }

    /// The model as far as it can be read, and its faults.
    pub(super) fn loaded_as_far(&self) -> (Loaded, Diagnostics) {
        let (loaded, faults) = self.read(&[]);
        let diagnostics = faults.into_diagnostics(&self.sources, Some(&loaded.root));
        (loaded, diagnostics)
    }

    /// The model, whatever faults of a kind it has; `None` where it has others.
    pub(super) fn loaded_despite(&self, kind: &Message) -> Option<Loaded> {
        let (loaded, faults) = self.read(&[]);
        faults.are_all(kind).then_some(loaded)
    }

    fn read(&self, changes: &[Change<'_>]) -> (Loaded, Faults) {
        let (root, mut faults) = self.changed(changes);
        let before = faults.clone();
        let document = reader::read(&root, &reader::MODEL, false, &mut faults);
        let mut meshes = build::Meshes::new(&self.folder, self.reach, &self.given);
        let mut model = build::model(&document, &self.name, &mut meshes, &mut faults);
        // Parts may be solids by their meshes alone: then all was read with the units in 2D.
        if !document.is_of_solids && model.parts.iter().any(|part| model.dimension_of(part) == 3) {
            faults = before;
            meshes.forget_faults();
            let document = reader::read(&root, &reader::MODEL, true, &mut faults);
            model = build::model(&document, &self.name, &mut meshes, &mut faults);
        }
        let found = model.check();
        let of_mesh = faults.of_mesh(&model, &found);
        note(&mut faults, found);
        note(&mut faults, of_mesh);
        (Loaded { model, sources: self.sources.clone(), root }, faults)
    }

    /// Faults of the model with these changes that were found later, with their places.
    pub(crate) fn reported_of_model(&self, changes: &[Change<'_>], found: Vec<Fault>) -> Diagnostics {
        let (root, mut faults) = self.changed(changes);
        note(&mut faults, found);
        faults.into_diagnostics(&self.sources, Some(&root))
    }

    fn changed(&self, changes: &[Change<'_>]) -> (Node, Faults) {
        let (mut root, mut faults) = (self.root.clone(), self.faults.clone());
        for change in changes {
            let place = |range: &Range<usize>| Place { source: change.source, start: range.start, end: range.end };
            let verbatim = self.sources[change.source].text.get(change.place.clone()) == Some(change.text);
            let node = tree::value(change.text, change.source, change.place.start);
            let mut node = node.unwrap_or(Node { value: Value::Text(change.text.to_string()), place: place(&change.place) });
            if !verbatim {
                node.place = place(&change.place);
            }
            if let Err(wrong) = set::replace(&mut root, change.path, node, place(&change.key)) {
                faults.beside(&OVERRIDE, "", Some(place(&change.key)), wrong);
            }
        }
        library::expand(&mut root, &mut faults);
        (root, faults)
    }
}

/// Notes what has no cause that is known already.
fn note(faults: &mut Faults, found: Vec<Fault>) {
    for fault in found {
        if !faults.covers(&fault.path) {
            faults.of_model(fault);
        }
    }
}
