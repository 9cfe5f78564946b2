//! From a deck to a model: a model file, the mesh that it names, and a report of what became of each keyword.
//!
//! `keywords.rs` is the table of what is known; `material.rs`, `section.rs`, `condition.rs`, `contact.rs` and
//! `step.rs` read blocks into the `Importer`; `write.rs` makes the model file of it, `report.rs` the report.
//! The mesh is the deck itself in one text, with sets added for what names single nodes or edges.

mod condition;
mod contact;
mod keywords;
mod material;
mod report;
mod section;
mod step;
mod likely_units;
mod units;
mod write;
mod write_conditions;

pub use keywords::table_markdown;
pub use report::{Entry, Outcome, Report};
pub use units::Units;
pub(crate) use write::{free, quoted};

use super::deck::{Deck, Element, Purpose};
use super::mesh::{self, Names};
use super::text::{Block, Line, Text, folded, shown};
use crate::abaqus::messages::{SYNTAX, UNKNOWN};
use crate::path_policy::{Bounds, PathPolicy};
use embate_solver::error::Fault;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Name of the mesh file beside the model file.
pub const MESH_NAME: &str = "mesh.inp";

/// What an import makes.
#[derive(Clone, Debug)]
pub struct Imported {
    /// The text of the model file; it names [`MESH_NAME`].
    pub model: String,
    /// The text of the mesh file.
    pub mesh: String,
    /// What became of each keyword.
    pub report: Report,
}

/// Makes a model of a deck whose numbers are in `units`. `reach`: from where files are read that it includes.
///
/// # Errors
/// Faults of the text or the mesh, with their places; what can't be left out without making another model
/// (equations, several materials on one element, no step).
pub fn import(path: &Path, units: &Units, reach: PathPolicy) -> Result<Imported, Vec<Fault>> {
    let shown = path.file_name().map_or_else(|| path.display().to_string(), |name| name.to_string_lossy().into_owned());
    let text =
        Text::read(path, &shown, &Bounds::of(path.parent().unwrap_or(Path::new("")), "deck's", reach)).map_err(|fault| vec![fault])?;
    let deck = Deck::read(&text, Purpose::Model).map_err(|fault| vec![fault])?;
    mesh::mesh(&deck, &text, 1.0)?;
    let mut importer = Importer::new(&text, &deck, units.clone());
    importer.read().map_err(|fault| vec![fault])?;
    let model = importer.write().map_err(|fault| vec![fault])?;
    let mesh = text.whole() + &importer.sets_added;
    let likely = importer.likely_units();
    let mut report = Report { entries: importer.entries, ..Report::default() };
    let of_units = if units.is_si() { "none are given, so SI: m, kg, s".to_string() } else { units.words() };
    report.opening = format!("import of {shown}\nunits of the deck: {of_units}\n{likely}");
    Ok(Imported { model, mesh, report })
}

/// A number of values in words.
fn counted(values: usize) -> String {
    if values == 1 { "the first value".to_string() } else { format!("{values} values") }
}

/// What is read so far.
struct Importer<'a> {
    text: &'a Text,
    deck: &'a Deck,
    names: Names,
    /// Whether an element has the node.
    used: Vec<bool>,
    /// Whether an element has it whose nodes rotate.
    rotating: Vec<bool>,
    units: Units,
    entries: Vec<Entry>,
    /// Whether the reader of a block has reported what became of the block as a whole.
    reported: bool,
    /// Sets that the mesh file gets besides those of the deck, and their names.
    sets_added: String,
    names_added: BTreeSet<String>,
    title: String,
    end: Option<f64>,
    bulk_viscosity: Option<[f64; 2]>,
    steps: usize,
    /// The block of the first step.
    step_at: Option<usize>,
    materials: Vec<material::Material>,
    sections: Vec<section::Section>,
    amplitudes: BTreeMap<String, condition::Amplitude>,
    boundaries: Vec<condition::Boundary>,
    velocities: BTreeMap<u32, [f64; 3]>,
    velocity_blocks: Vec<usize>,
    loads: Vec<condition::Load>,
    interactions: BTreeMap<String, contact::Interaction>,
    interaction: Option<String>,
    contacts: Vec<contact::Contact>,
    all: Option<(usize, Option<String>)>,
    rigid: Vec<contact::Rigid>,
}

/// Whether each node belongs to an element whose nodes rotate.
fn rotating(deck: &Deck) -> Vec<bool> {
    let mut rotating = vec![false; deck.nodes.len()];
    let turning = deck.elements.iter().filter(|element| element.kind.family.rotates());
    turning.flat_map(Element::nodes).for_each(|&node| rotating[node as usize] = true);
    rotating
}

impl<'a> Importer<'a> {
    fn new(text: &'a Text, deck: &'a Deck, units: Units) -> Self {
        Self {
            text,
            deck,
            names: mesh::names(deck),
            used: mesh::used(deck),
            rotating: rotating(deck),
            units,
            entries: Vec::new(),
            reported: false,
            sets_added: String::new(),
            names_added: BTreeSet::new(),
            title: String::new(),
            end: None,
            bulk_viscosity: None,
            steps: 0,
            step_at: None,
            materials: Vec::new(),
            sections: Vec::new(),
            amplitudes: BTreeMap::new(),
            boundaries: Vec::new(),
            velocities: BTreeMap::new(),
            velocity_blocks: Vec::new(),
            loads: Vec::new(),
            interactions: BTreeMap::new(),
            interaction: None,
            contacts: Vec::new(),
            all: None,
            rigid: Vec::new(),
        }
    }

    fn read(&mut self) -> Result<(), Fault> {
        for (at, block) in self.text.blocks.iter().enumerate() {
            if self.steps > 1 {
                self.note(at, Outcome::Ignored, "it stands in a second step; the run ends with the first");
                continue;
            }
            let Some(keyword) = keywords::named(&block.keyword) else {
                self.note(at, Outcome::Ignored, "embate has no counterpart of this keyword; what it says and its data lines do not act");
                continue;
            };
            self.reported = false;
            if block.keyword == "PART" && self.deck.instances_of(at).is_empty() {
                self.note(at, Outcome::Ignored, "no instance has this part; nothing of it is in the model");
            }
            (keyword.read)(self, at)?;
            if !self.reported {
                self.note(at, keyword.outcome, keyword.doc);
            }
            let is_longer = |line: &&Line| self.text.fields(**line).iter().skip(keyword.values).any(|value| !value.is_empty());
            if let Some(&line) = block.data.iter().find(is_longer).filter(|_| keyword.values > 0) {
                let text = format!(
                    "of a data line {} {} read; further values do not act",
                    counted(keyword.values),
                    if keyword.values == 1 { "is" } else { "are" }
                );
                self.ignored(at, line, &text);
            }
            if keyword.parameters != ["*"] {
                for (name, _) in block.parameters.iter().filter(|(name, _)| !keyword.parameters.contains(&name.as_str())) {
                    self.note(at, Outcome::Ignored, &format!("the parameter {name} is not read and does not act"));
                }
            }
        }
        for (name, (kind, count, line)) in &self.deck.beside {
            let set = if name.is_empty() { String::new() } else { format!(" of the set {name}") };
            let text = format!("{count} elements{set} of the type {kind}: no bodies; their mass, stiffness and force do not act");
            self.entries.push(Entry { outcome: Outcome::Ignored, keyword: "ELEMENT".into(), place: self.text.place(*line), text });
        }
        Ok(())
    }

    fn block(&self, at: usize) -> &'a Block {
        &self.text.blocks[at]
    }

    /// Components of positions, velocities and forces: 2 in 2D, 3 in 3D.
    fn dimension(&self) -> usize {
        if self.is_3d() { 3 } else { 2 }
    }

    fn is_3d(&self) -> bool {
        self.deck.is_3d
    }

    /// Whether sides of elements make a surface, which edges of shells do not.
    fn is_surface(&self, sides: &[(u32, u8)]) -> bool {
        let corners = |&(element, side): &(u32, u8)| self.deck.elements[element as usize].side(usize::from(side)).count();
        sides.iter().any(|side| corners(side) + 1 > self.dimension() && (!self.is_3d() || corners(side) > 2))
    }

    /// What is done with penetrations at the start: in 2D bodies are pushed apart without stress, as
    /// the deck means it; in 3D, and of shells, they count as zero.
    fn initial_penetration(&self) -> &'static str {
        let has_shells = self.deck.elements.iter().any(|element| element.kind.family.rotates());
        if self.is_3d() || has_shells { "initial_penetration = \"ignore\"\n" } else { "initial_penetration = \"push_out\"\n" }
    }

    /// A list of the components that the model has.
    fn vector(&self, vector: [f64; 3], text: impl Fn(f64) -> String) -> String {
        format!("[{}]", vector[..self.dimension()].iter().map(|value| text(*value)).collect::<Vec<_>>().join(", "))
    }

    /// Adds a line to the report.
    fn note(&mut self, at: usize, outcome: Outcome, text: &str) {
        self.reported = true;
        let block = self.block(at);
        let entry = Entry { outcome, keyword: block.keyword.clone(), place: self.text.place(block.line), text: text.to_string() };
        if !self.entries.contains(&entry) {
            self.entries.push(entry);
        }
    }

    /// Adds a line that something besides the block as a whole does not act; the block may still be used.
    fn ignored(&mut self, at: usize, line: Line, text: &str) {
        let entry =
            Entry { outcome: Outcome::Ignored, keyword: self.block(at).keyword.clone(), place: self.text.place(line), text: text.into() };
        self.entries.push(entry);
    }

    fn approximated(&mut self, at: usize, text: &str) {
        let reported = self.reported;
        self.note(at, Outcome::Approximated, text);
        self.reported = reported;
    }

    /// The numbers of a data line; empty fields are `None`.
    fn numbers(&self, line: Line, what: &str) -> Result<Vec<Option<f64>>, Fault> {
        let number = |field: &&str| if field.is_empty() { Ok(None) } else { self.text.number(line, field, what).map(Some) };
        self.text.fields(line).iter().map(number).collect()
    }

    /// The numbers of the first data line.
    fn first_numbers(&self, at: usize, what: &str) -> Result<Vec<Option<f64>>, Fault> {
        self.block(at).data.first().map_or(Ok(Vec::new()), |line| self.numbers(*line, what))
    }

    /// A number that must be there.
    fn needed(&self, at: usize, numbers: &[Option<f64>], place: usize, what: &str) -> Result<f64, Fault> {
        numbers.get(place).copied().flatten().ok_or_else(|| {
            let block = self.block(at);
            self.text.fault(&SYNTAX, block.line, format!("*{} lacks {what}", block.keyword), "give it in the first data line")
        })
    }

    /// The group of the mesh for the nodes of a set or the node of a number; `None` if no body has them.
    fn node_group(&mut self, line: Line, instance: usize, name: &str) -> Result<(Option<String>, Vec<u32>), Fault> {
        let nodes = self.deck.nodes_named(self.text, line, instance, name)?;
        for key in [self.deck.full(instance, name), folded(name)] {
            if name.parse::<u64>().is_err() && self.deck.node_sets.contains_key(&key) {
                return Ok((self.names.nodes.get(&key).cloned(), nodes));
            }
        }
        if !nodes.iter().any(|node| self.used[*node as usize]) {
            return Ok((None, nodes));
        }
        let full = if name.parse::<u64>().is_ok() { self.deck.full_shown(instance, name) } else { name.to_string() };
        Ok((Some(self.add_set(&format!("node-{full}"), |group| format!("*NSET, NSET=\"{group}\"\n{full}\n"))), nodes))
    }

    /// Adds a set to the mesh file, once.
    fn add_set(&mut self, name: &str, text: impl Fn(&str) -> String) -> String {
        let group = format!("embate-{name}");
        if self.names_added.insert(group.clone()) {
            let text = text(&group);
            self.sets_added.push_str(&text);
        }
        group
    }

    /// The full name (in capitals) of a surface as seen from the deck's outside.
    fn surface(&self, line: Line, name: &str) -> Result<String, Fault> {
        let key = folded(name);
        if self.deck.surfaces.contains_key(&key) {
            return Ok(key);
        }
        let help = "name a *SURFACE; outside of a part it is INSTANCE.SURFACE";
        Err(self.text.fault(&UNKNOWN, line, format!("there is no surface {}", shown(name)), help))
    }
}
