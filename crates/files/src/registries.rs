//! What the registries of the solver hold, in one form: `embate list` prints it, `docs/elements-and-laws.md`
//! shows it.
//!
//! Nothing is named here: a new material, element, search or field shows up by itself.

mod curves;
mod library;

pub use curves::law_curves;
pub use library::library_markdown;

use crate::model_file::key_row;
use embate_solver::input::sections::section;
use embate_solver::quantity::Parameter;
use embate_solver::stress_state::STRESS_STATES;
use embate_solver::{contact, element, failure, material, output};
use std::fmt::Write;

/// One kind of thing that a model can name.
#[derive(Clone, Debug)]
pub struct Registry {
    /// What it is called on the command line, `stress-states` for example.
    pub name: &'static str,
    /// One line: what is in it.
    pub doc: &'static str,
    /// Heading.
    pub title: &'static str,
    /// Keys of the model file under which an entry is named, the usual one first.
    pub keys: &'static [&'static str],
    /// All of it, the default first where there is one.
    pub entries: Vec<Entry>,
}

/// One thing in a registry.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Name in the model file.
    pub name: &'static str,
    /// What it is, and when to take it.
    pub doc: String,
    /// Where its equations come from; empty where there are none.
    pub source: &'static str,
    /// Whether it is taken when nothing is said.
    pub default: bool,
    /// Names of columns and rows of its table; of a field its one row.
    pub rows: Vec<Vec<String>>,
}

/// The registry of shapes, whose tables docs/model-file.md has.
const SHAPES: &str = "shapes";
/// Columns of the tables of parameters.
const PARAMETERS: &[&str] = &["key", "symbol", "unit", "range", "left out", "meaning"];
/// Columns of the table of fields, where all entries share one.
const FIELDS: &[&str] = &["field", "of each", "components", "unit", "meaning"];

impl Entry {
    fn new(name: &'static str, doc: &str, source: &'static str) -> Self {
        Self { name, doc: doc.to_string(), source, default: false, rows: Vec::new() }
    }

    fn with(self, parameters: &[Parameter], without: &str) -> Self {
        Self { rows: parameters.iter().map(|parameter| row(parameter, without)).collect(), ..self }
    }
}

impl Registry {
    /// Whether its entries are the rows of one table.
    #[must_use]
    pub fn is_table(&self) -> bool {
        self.name == "fields"
    }

    fn starting_with_the_default(mut self) -> Self {
        if let Some(first) = self.entries.first_mut() {
            first.default = true;
        }
        self
    }
}

/// All registries, in the order in which they are shown.
#[must_use]
pub fn registries() -> Vec<Registry> {
    let elements =
        element::registry().into_iter().map(|kind| Entry::new(kind.name, &format!("{} ({} nodes)", kind.doc, kind.nodes()), kind.source));
    let states = STRESS_STATES.iter().map(|kind| Entry::new(kind.name, kind.doc, kind.source));
    let materials = material::registry().into_iter().map(|law| Entry::new(law.name, law.doc, law.source).with(law.parameters, "required"));
    let criteria = failure::CRITERIA.iter().map(|kind| {
        let unit = kind.limit.dimension.unit();
        let unit = if unit.is_empty() { String::new() } else { format!(" In {unit}.") };
        Entry::new(kind.limit.name, &format!("{}{unit}", kind.limit.doc), "")
    });
    let equations = material::eos::EQUATIONS.iter().map(|kind| {
        let mut entry = Entry::new(kind.name, kind.doc, kind.source).with(kind.parameters, "required");
        entry.rows.push(row(&material::eos::TENSION, "no limit"));
        entry
    });
    let searches = contact::search::registry::<2>().into_iter().map(|search| Entry::new(search.name, search.doc, search.source));
    let formulations = contact::formulation::FORMULATIONS.iter().map(|kind| {
        let dimensions: Vec<String> = kind.dimensions().iter().map(|dimension| format!("{dimension}D")).collect();
        Entry::new(kind.name, &format!("{} ({})", kind.doc, dimensions.join(", ")), kind.source)
    });
    let laws = contact::law::LAWS.iter().map(|law| Entry::new(law.name, law.doc, law.source).with(law.parameters, "optional"));
    let fields = output::FIELDS.iter().map(|kind| Entry { rows: vec![field(kind)], ..Entry::new(kind.name, kind.doc, "") });
    let shapes = section("part").into_iter().flat_map(|part| part.groups.iter().filter(|group| group.title == "Shapes"));
    let shapes = shapes.flat_map(|group| group.keys).filter_map(|key| {
        let inner = key.kind.inner()?;
        let rows = inner.all_keys().map(|key| key_row(key).to_vec()).collect();
        Some(Entry { rows, ..Entry::new(key.name, inner.doc, "") })
    });
    let registry = |name, doc, title, keys, entries| Registry { name, doc, title, keys, entries };
    vec![
        registry("elements", "Element formulations", "Elements", &["part.element", "part.element_triangles"], elements.collect()),
        registry(SHAPES, "Shapes of parts, and groups of mesh files", "Shapes", &["part.SHAPE"], shapes.collect()),
        registry("stress-states", "Stress states", "Stress states", &["part.stress_state"], states.collect()).starting_with_the_default(),
        registry("materials", "Material laws", "Materials", &["material.NAME.law"], materials.collect()),
        registry("failure", "Criteria of failure", "Criteria of failure", &["material.failure"], criteria.collect()),
        registry("equations-of-state", "Equations of state", "Equations of state", &["material.NAME.eos"], equations.collect()),
        registry("searches", "Global contact searches", "Searches", &["contact.search"], searches.collect()).starting_with_the_default(),
        registry("formulations", "Contact formulations", "Contact formulations", &["contact.formulation"], formulations.collect())
            .starting_with_the_default(),
        registry("laws", "Contact laws", "Contact laws", &["contact.law", "obstacle.law"], laws.collect()).starting_with_the_default(),
        registry("fields", "Fields of the output", "Fields", &["output.include"], fields.collect()),
    ]
}

/// A row of a table of parameters; `without` says what a parameter without a default value is.
fn row(parameter: &Parameter, without: &str) -> Vec<String> {
    let default = match (parameter.default, parameter.list) {
        (None, _) => without.to_string(),
        (Some(_), 1..) => "default: none".to_string(),
        (Some(value), 0) => format!("default {value}"),
    };
    let many = if parameter.list > 0 { format!(", up to {} values", parameter.list) } else { String::new() };
    vec![
        parameter.name.to_string(),
        parameter.symbol.to_string(),
        unit(parameter.unit()),
        format!("{}{many}", parameter.range),
        default,
        parameter.doc.to_string(),
    ]
}

fn field(kind: &output::FieldKind) -> Vec<String> {
    let place = match kind.location {
        output::Location::Node => "node",
        output::Location::Cell => "cell",
    };
    let components = if kind.components.is_empty() { "scalar".to_string() } else { kind.components.join(" ") };
    vec![kind.name.to_string(), place.to_string(), components, unit(kind.unit.to_string()), kind.doc.to_string()]
}

/// A unit; a dash for a pure number.
fn unit(unit: String) -> String {
    if unit.is_empty() { "-".to_string() } else { unit }
}

const OPENING: &str = "# Elements, laws and fields

What a model can name, with its parameters, its source, and the examples and verification cases that use it. `embate list` prints the same. Keys and where they stand: [the model file](model-file.md);
equations: [theory](theory.md); materials with values: [the library](materials.md). This page is made from the registries of the program, the curves of the laws from the laws.
";

/// The text of `docs/elements-and-laws.md`; `uses` are the links to models that name an entry of a registry.
#[must_use]
pub fn markdown(uses: &dyn Fn(&Registry, &Entry) -> Vec<String>) -> String {
    let mut out = OPENING.to_string();
    for registry in registries().into_iter().filter(|registry| registry.name != SHAPES) {
        // Writing to a string can't fail.
        let keys: Vec<String> = registry.keys.iter().map(|key| format!("`{key}`")).collect();
        let _ = writeln!(out, "\n## {}\n\n{}: {}.", registry.title, registry.doc, keys.join(", "));
        if registry.is_table() {
            table(&mut out, FIELDS, registry.entries.iter().flat_map(|entry| &entry.rows));
            continue;
        }
        for entry in &registry.entries {
            let default = if entry.default { " The default." } else { "" };
            let stop = if entry.doc.ends_with('.') { "" } else { "." };
            let _ = writeln!(out, "\n### `{}`\n\n{}{stop}{default}", entry.name, sentence(&entry.doc));
            if !entry.rows.is_empty() {
                table(&mut out, PARAMETERS, entry.rows.iter());
            }
            if registry.name == "materials" && curves::has_curve(entry.name) {
                let _ = writeln!(out, "\n![Stress under uniaxial stress, law {0}](images/law-{0}.svg)", entry.name);
            }
            if !entry.source.is_empty() {
                let _ = writeln!(out, "\nSource: {}.", entry.source.trim_end_matches('.'));
            }
            let models = uses(&registry, entry);
            if !models.is_empty() {
                let _ = writeln!(out, "\nUsed in: {}.", models.join(", "));
            }
        }
    }
    out
}

/// With a capital letter.
fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

fn table<'a>(out: &mut String, head: &[&str], rows: impl Iterator<Item = &'a Vec<String>>) {
    let _ = writeln!(out, "\n| {} |\n|{}", head.join(" | "), "---|".repeat(head.len()));
    for row in rows {
        let (name, rest) = row.split_first().expect("a row has a name");
        let rest: Vec<String> = rest.iter().map(|cell| cell.replace('|', "\\|")).collect();
        let _ = writeln!(out, "| `{name}` | {} |", rest.join(" | "));
    }
}
