//! The sections of the model file as methods of Python with typed arguments:
//! `crates/python/python/embate/_sections.py`.
//!
//! Made from the descriptions of sections and keys and from the registries, as the schema is. A key that is a
//! word of Python gets an underscore: `yield_`.

use embate_solver::input::sections::SECTIONS;
use embate_solver::material;
use embate_solver::vocabulary::{Form, Key, Kind, More, Need, Section};
use std::fmt::Write;

const OPENING: &str = r#"# Made by the program from its own descriptions; the test of `embate_files` that holds it makes it again. Don't edit.
"""The sections of the model file as methods of :class:`embate.Model`, and the types of their keys.

A key that is a word of Python has an underscore behind it here: ``yield_`` is the key ``yield``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike
from typing import TYPE_CHECKING, Any, Literal, TypedDict, Union

import numpy as np

from ._method import section

if TYPE_CHECKING:
    import numpy.typing as npt
    from typing_extensions import Required, Self

    from .mesh import Mesh

#: A number in SI units, or a text with its unit: ``0.003``, ``"3 mm"``.
Quantity = Union[float, str, "np.floating[Any]", "np.integer[Any]"]
#: A whole number.
Integer = Union[int, "np.integer[Any]"]
#: ``True`` or ``False``.
Flag = Union[bool, np.bool_]
#: A text; of files a path too.
Text = Union[str, "PathLike[str]"]
#: Several quantities: a list, a tuple, an array.
Quantities = Union[Sequence[Quantity], "npt.NDArray[Any]"]
#: Several whole numbers.
Integers = Union[Sequence[Integer], "npt.NDArray[Any]"]
#: Several points.
Points = Union[Sequence[Quantities], "npt.NDArray[Any]"]
#: One name or several.
Names = Union[str, Sequence[str]]
#: Meshes of arrays: see :class:`embate.Mesh`.
ArrayMesh = Union["Mesh", "tuple[Any, Any]", "Mapping[str, Any]", Any]
"#;

/// Words of Python that can't be names of arguments.
const WORDS: &[&str] = &[
    "False", "None", "True", "and", "as", "assert", "async", "await", "break", "class", "continue", "def", "del", "elif", "else", "except",
    "finally", "for", "from", "global", "if", "import", "in", "is", "lambda", "nonlocal", "not", "or", "pass", "raise", "return", "try",
    "while", "with", "yield",
];

/// Names that mean something else in the text.
const TAKEN: &[&str] =
    &["Mesh", "Quantity", "Integer", "Flag", "Text", "Quantities", "Integers", "Points", "Names", "Components", "Motion"];

/// The text of `crates/python/python/embate/_sections.py`.
#[must_use]
pub fn python() -> String {
    let mut tables = Tables::default();
    let mut methods =
        String::from("\n\nclass Sections:\n    \"\"\"A method for each section of the model file; each returns the model.\"\"\"\n");
    for section in SECTIONS {
        method(&mut methods, section, &mut tables);
    }
    let mut out = OPENING.to_string();
    out.push_str(&tables.text);
    out.push_str(&methods);
    out
}

/// The types of tables within sections.
#[derive(Default)]
struct Tables {
    known: Vec<(&'static Section, String)>,
    text: String,
    has_course: [bool; 2],
}

impl Tables {
    /// The name of a table's type, which is written out when it is asked for first. `owner`: what it is in.
    fn name(&mut self, section: &'static Section, owner: &str) -> String {
        if let Some((_, name)) = self.known.iter().find(|(known, _)| std::ptr::eq(*known, section)) {
            return name.clone();
        }
        let own = capitals(section.name);
        let is_free = |name: &str| !TAKEN.contains(&name) && self.known.iter().all(|(_, known)| known != name);
        let name = if is_free(&own) { own } else { format!("{}{own}", capitals(owner)) };
        self.known.push((section, name.clone()));
        let keys: Vec<Key> = section.all_keys().copied().collect();
        let typed: Vec<(Key, String)> = keys.iter().map(|key| (*key, self.of_key(key, section.name))).collect();
        self.write(&name, section.doc, &typed);
        name
    }

    fn write(&mut self, name: &str, doc: &str, keys: &[(Key, String)]) {
        let out = &mut self.text;
        let typed = |key: &Key, of: &str| if key.need == Need::Required { format!("Required[{of}]") } else { of.to_string() };
        if keys.iter().any(|(key, _)| WORDS.contains(&key.name)) {
            let _ = write!(out, "\n\n{}{name} = TypedDict(\n    \"{name}\",\n    {{\n", comment("", doc));
            for (key, of) in keys {
                let _ =
                    writeln!(out, "{}        \"{}\": \"{}\",", comment("        ", key.doc), key.name, typed(key, of).replace('"', "'"));
            }
            out.push_str("    },\n    total=False,\n)\n");
        } else {
            let _ = write!(out, "\n\nclass {name}(TypedDict, total=False):\n{}\n", docstring("    ", doc, &[]));
            for (key, of) in keys {
                let _ = writeln!(out, "    {}: {}\n{}", key.name, typed(key, of), docstring("    ", key.doc, &[]).trim_end_matches('\n'));
            }
        }
    }

    /// Prescribed components: with `rotation` or without.
    fn course(&mut self, with_rotation: bool) -> String {
        let name = if with_rotation { "Motion" } else { "Components" };
        if !std::mem::replace(&mut self.has_course[usize::from(with_rotation)], true) {
            let what = if with_rotation { "velocities" } else { "values" };
            let _ = write!(
                self.text,
                "\n\nclass {name}(TypedDict, total=False):\n    \"\"\"Prescribed {what} by component: quantities, or names of curves.\"\"\"\n\n"
            );
            for axis in ["x", "y", "z"].iter().chain(with_rotation.then_some(&"rotation")) {
                let _ = writeln!(self.text, "    {axis}: Quantity");
            }
        }
        name.to_string()
    }

    /// The type of a key's value.
    fn of_key(&mut self, key: &Key, owner: &str) -> String {
        let literal =
            |names: Vec<&str>| format!("Literal[{}]", names.iter().map(|name| format!("\"{name}\"")).collect::<Vec<_>>().join(", "));
        match key.kind {
            Kind::Quantity(..)
            | Kind::Angle(..)
            | Kind::Value
            | Kind::Drive(_)
            | Kind::Stiffness(..)
            | Kind::MassFlow(..)
            | Kind::Cadence => "Quantity".into(),
            Kind::Vector(..) | Kind::Spatial(..) | Kind::Quantities(..) | Kind::Values => "Quantities".into(),
            Kind::Points(_) | Kind::SpatialPoints(_) => "Points".into(),
            Kind::Outlines(_) | Kind::SpatialOutlines(_) => "Sequence[Points]".into(),
            Kind::Components(_) => self.course(false),
            Kind::Motion => self.course(true),
            Kind::Rigid => format!("Flag | {}", self.course(true)),
            Kind::Integer(_) => "Integer".into(),
            Kind::Integers(..) => "Integers".into(),
            Kind::Flag => "Flag".into(),
            Kind::Text => "Text".into(),
            Kind::Name | Kind::Reference => "str".into(),
            Kind::References(_) => "Names".into(),
            Kind::Choice(known) => literal(known.names()),
            Kind::Choices(known) => {
                let known = literal(known.names());
                format!("{known} | Sequence[{known}]")
            }
            Kind::Table(section) => self.name(section, owner),
            Kind::Tables(section) => format!("Sequence[{}]", self.name(section, owner)),
        }
    }
}

/// Keys of a section with the types of their values; those that depend on others are all there, and none of
/// them is required.
fn keys_of(section: &'static Section, tables: &mut Tables) -> Vec<(Key, String)> {
    let mut keys: Vec<(Key, String)> = section.all_keys().map(|key| (*key, tables.of_key(key, section.name))).collect();
    for more in section.more {
        for key in depending(more) {
            let of = tables.of_key(&key, section.name);
            match keys.iter_mut().find(|(known, _)| known.name == key.name) {
                Some((_, known)) if known.split(" | ").any(|one| one == of) => {}
                Some((_, known)) => *known = format!("{known} | {of}"),
                None => keys.push((Key { need: Need::Optional("where the others don't ask for it"), ..key }, of)),
            }
        }
    }
    if section.name == "part" {
        // Of arrays; only Python has it.
        keys.iter_mut().filter(|(key, _)| key.name == "mesh").for_each(|(_, of)| of.push_str(" | ArrayMesh"));
        let doc = "Which group of the arrays given as `mesh`; left out where there is but one.";
        let group = Key { name: "group", kind: Kind::Reference, need: Need::Optional("the only group"), doc, example: "" };
        keys.push((group, "str".into()));
    }
    keys
}

/// All keys that one key decides over.
fn depending(more: &More) -> Vec<Key> {
    let values: Vec<&str> = match more.by {
        "eos" => material::eos::EQUATIONS.iter().map(|kind| kind.name).collect(),
        _ => material::registry().iter().map(|kind| kind.name).collect(),
    };
    values.into_iter().flat_map(|value| (more.keys)(value).unwrap_or_default()).collect()
}

fn method(out: &mut String, section: &'static Section, tables: &mut Tables) {
    let mut keys = keys_of(section, tables);
    // Several calls make one section where it stands once.
    let is_single = matches!(section.form, Form::Single | Form::Inline);
    // Python wants what is required first to be read well; among arguments by name the order is free.
    keys.sort_by_key(|(key, _)| is_single || key.need != Need::Required);
    let name = if section.form == Form::Named { "name: str,\n        " } else { "" };
    let _ = write!(out, "\n    @section\n    def {}(\n        self,\n        {name}*,\n", section.name);
    for (key, of) in &keys {
        let argument = argument(key.name);
        if key.need == Need::Required && !is_single {
            let _ = writeln!(out, "        {argument}: {of},");
        } else {
            let _ = writeln!(out, "        {argument}: {of} | None = None,");
        }
    }
    out.push_str("    ) -> Self:\n");
    let described: Vec<(String, &str)> = keys.iter().map(|(key, _)| (argument(key.name), key.doc)).collect();
    out.push_str(&docstring("        ", section.doc, &described));
    out.push_str("        raise NotImplementedError\n");
}

/// The name of a key as that of an argument.
fn argument(key: &str) -> String {
    if WORDS.contains(&key) { format!("{key}_") } else { key.to_string() }
}

/// `part_of` as `PartOf`.
fn capitals(name: &str) -> String {
    let word = |word: &str| word.chars().take(1).flat_map(char::to_uppercase).chain(word.chars().skip(1)).collect::<String>();
    name.split('_').map(word).collect()
}

/// A text in lines of at most a hundred characters or so.
fn wrapped(indent: &str, text: &str) -> String {
    let (mut out, mut width) = (String::new(), 0);
    for word in text.split_whitespace() {
        let length = word.chars().count();
        if width > 0 && indent.len() + width + 1 + length > 100 {
            out.push('\n');
            width = 0;
        }
        out.push_str(if width == 0 { indent } else { " " });
        out.push_str(word);
        width += length + usize::from(width > 0);
    }
    out.push('\n');
    out
}

fn comment(indent: &str, text: &str) -> String {
    wrapped(&format!("{indent}#: "), text)
}

/// A docstring, with arguments as numpy's documentation has them.
fn docstring(indent: &str, text: &str, arguments: &[(String, &str)]) -> String {
    let safe = |text: &str| text.replace('\\', "\\\\").replace("\"\"\"", "'''");
    let body = wrapped(indent, &safe(text));
    let first = body.strip_prefix(indent).unwrap_or(&body).trim_end_matches('\n').to_string();
    if arguments.is_empty() {
        return format!("{indent}\"\"\"{first}{}\"\"\"\n", if first.ends_with('"') { " " } else { "" });
    }
    let mut out = format!("{indent}\"\"\"{first}\n\n{indent}Parameters\n{indent}----------\n");
    for (name, doc) in arguments {
        let _ = write!(out, "{indent}{name}\n{}", wrapped(&format!("{indent}    "), &safe(doc)));
    }
    let _ = writeln!(out, "{indent}\"\"\"");
    out
}
