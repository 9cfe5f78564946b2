//! The page of the library of materials, `docs/materials.md`.

use super::sentence;
use crate::model_file::{LibraryMaterial, library};
use std::fmt::Write;

const OPENING: &str = "# The library of materials

`[material.hull]` with `from = \"steel DP600\"` has the law and the values of that entry; keys that stand beside `from` take the place of its own ([the model file](model-file.md#materials-of-the-library)). `embate list materials --library` prints all
entries, `embate list \"steel DP600\"` one. Each value has its source. Where a source gives minima, as standards do, a real part is stronger; where a text says *typical*, measure what matters. Metals have no failure: it depends on the size of the elements, so
give `failure` for your mesh.

This page is made from the program's own data.
";

/// The text of `docs/materials.md`.
#[must_use]
pub fn library_markdown() -> String {
    let mut out = OPENING.to_string();
    let mut group = "";
    for material in library() {
        // Writing to a string can't fail.
        if material.group != group {
            group = &material.group;
            let _ = writeln!(out, "\n## {group}\n\n| material | law | what it is |\n|---|---|---|");
            for other in library().iter().filter(|other| other.group == *group) {
                let _ = writeln!(out, "| [`{}`](#{}) | {} | {} |", other.name, anchor(&other.name), law(other), other.about);
            }
        }
        let _ = writeln!(
            out,
            "\n### `{}`\n\n{}. Law {}.\n\n| key | value |\n|---|---|",
            material.name,
            sentence(&material.about),
            law(material)
        );
        for value in material.values() {
            let _ = writeln!(out, "| `{}` | {} |", value.key, value.value);
        }
        out.push('\n');
        for (keys, source) in material.sources() {
            let keys: Vec<String> = keys.iter().map(|key| format!("`{key}`")).collect();
            let _ = writeln!(out, "- {}: {source}.", keys.join(", "));
        }
    }
    out
}

/// Its law and its equation of state, as links.
fn law(material: &LibraryMaterial) -> String {
    let link = |name: &str| format!("[`{name}`](elements-and-laws.md#{name})");
    if material.eos.is_empty() { link(&material.law) } else { format!("{} with {}", link(&material.law), link(&material.eos)) }
}

/// What a heading is called in links.
fn anchor(name: &str) -> String {
    name.to_lowercase().replace(' ', "-").chars().filter(|letter| letter.is_alphanumeric() || matches!(letter, '-' | '_')).collect()
}
