//! What was chosen, in the user's words: the keys of the model file as they are written, by what they are
//! about, with what holds where nothing is said; and what the parts are made of.

use super::Left;
use super::html::{escape, paragraph, table};
use super::model::plain;
use crate::numbers::{grouped, significant};
use crate::post_mortem::shown;
use crate::results::PartMade;
use std::collections::BTreeMap;

/// What keys are about: a heading, and the sections of the model file that go under it. What is in none goes
/// under the last.
const GROUPS: [(&str, &[&str]); 12] = [
    ("Run", &["run"]),
    ("Materials", &["material"]),
    ("Parts", &["part", "mesh"]),
    ("Initial state", &[]),
    ("Contacts", &["contact"]),
    ("Obstacles", &["obstacle"]),
    ("Supports and prescribed motion", &["symmetry", "constraint", "non_reflecting"]),
    ("Connections", &["join", "weld", "joint", "spring", "point_mass"]),
    ("Loads", &["load", "cavity"]),
    ("Curves", &["curve"]),
    ("Probes", &["probe"]),
    ("Output and others", &["output"]),
];

/// Keys of a part that say how it begins.
const INITIAL: [&str; 4] = ["velocity", "spin", "temperature_initial", "stress_initial"];

/// A shape below this is worth a word.
const POOR: f64 = 0.2;

/// One thing of a section: its name, or number, and its keys with their values.
struct Thing {
    /// `part[0]`, `material.steel`, `run`.
    at: String,
    name: String,
    keys: Vec<(String, String)>,
}

/// The section of a path, what its thing is called, and the rest: `part[0].velocity` is `part`, `part[0]`,
/// `velocity`.
fn divided(path: &str) -> (&str, &str, &str) {
    let section = path.split(['.', '[']).next().unwrap_or(path);
    let is_named = ["material", "curve"].contains(&section);
    let end = if is_named { path.match_indices('.').nth(1).map_or(path.len(), |(at, _)| at) } else { path.find('.').unwrap_or(path.len()) };
    let rest = path[end..].trim_start_matches('.');
    // A key of the model itself.
    if rest.is_empty() { ("", "", path) } else { (section, &path[..end], rest) }
}

/// All things in the order of the file.
fn things(written: &[(String, String)]) -> Vec<(String, Thing)> {
    let mut all: Vec<(String, Thing)> = Vec::new();
    for (path, value) in written {
        let (section, at, key) = divided(path);
        if section.is_empty() {
            continue;
        }
        let found = all.iter().position(|(_, thing)| thing.at == at);
        let index = found.unwrap_or_else(|| {
            let name = at.strip_prefix(section).unwrap_or_default().trim_start_matches('.');
            // Who has no name has a number.
            let number = name.trim_matches(['[', ']']).parse::<usize>();
            let name = number.map_or(name.to_string(), |number| format!("{} {}", section.replace('_', " "), number + 1));
            all.push((section.to_string(), Thing { at: at.to_string(), name, keys: Vec::new() }));
            all.len() - 1
        });
        let thing = &mut all[index].1;
        if key == "name" { thing.name = plain(value) } else { thing.keys.push((key.to_string(), plain(value))) }
    }
    all
}

/// `interface.law.scale` of what the reader has made of a model, as the model file would say it.
fn snake(name: &str) -> String {
    let mut out = String::new();
    for c in name.chars() {
        if c.is_ascii_uppercase() && !out.is_empty() {
            out.push('_');
        }
        out.push(c.to_ascii_lowercase());
    }
    out
}

/// What holds for a thing where nothing is written, as far as a reader must know it.
fn unsaid(section: &str, thing: &Thing, all: &BTreeMap<String, String>) -> Vec<(String, String)> {
    let is_said =
        |key: &str| thing.keys.iter().any(|(own, _)| own == key || own.strip_prefix(key).is_some_and(|rest| rest.starts_with('.')));
    let value = |key: &str| all.get(&format!("{}.{key}", thing.at)).map(|value| plain(value)).filter(|value| !value.is_empty());
    let mut found = Vec::new();
    let mut add = |key: &str, value: Option<String>| {
        if let Some(value) = value.filter(|_| !is_said(key)) {
            found.push((key.to_string(), format!("{value} (default)")));
        }
    };
    match section {
        "contact" | "obstacle" => {
            add("friction", Some("none".into()));
            if section == "contact" && !is_said("tied") {
                add("formulation", value("formulation").map(|name| snake(&name)));
            }
            let law = value("interface.law.kind").map(|kind| match kind.as_str() {
                "Automatic" => "penalty, as stiff as the elements behind".to_string(),
                other => snake(other),
            });
            add("law", law);
        }
        "part" => add("stress_state", value("stress_state").filter(|_| !super::model::is_of_3d(&value("element").unwrap_or_default()))),
        "material" if thing.keys.iter().all(|(key, _)| !key.starts_with("failure")) => add("failure", Some("none".into())),
        _ => {}
    }
    found
}

fn rows(name: &str, keys: &[(String, String)]) -> Vec<Vec<String>> {
    let row = |(index, (key, value)): (usize, &(String, String))| {
        vec![if index == 0 { name.to_string() } else { String::new() }, key.replace(['.', '_'], " "), value.replace('"', "")]
    };
    keys.iter().enumerate().map(row).collect()
}

/// The keys of the model file by what they are about.
pub(super) fn section(left: &Left) -> String {
    let Some(ran) = left.ran.as_ref().filter(|ran| !ran.written.is_empty()) else { return String::new() };
    let all = things(&ran.written);
    let mut body = made_of(&ran.parts, left);
    for (number, (title, sections)) in GROUPS.iter().enumerate() {
        let is_last = number + 1 == GROUPS.len();
        let is_here =
            |section: &str| sections.contains(&section) || (is_last && !GROUPS.iter().any(|(_, sections)| sections.contains(&section)));
        let mut lines = Vec::new();
        for (section, thing) in &all {
            let is_initial = |key: &str| section == "part" && INITIAL.iter().any(|own| key.split('.').next() == Some(own));
            let name = if section == "run" { "" } else { thing.name.as_str() };
            if *title == "Initial state" {
                let keys: Vec<_> = thing.keys.iter().filter(|(key, _)| is_initial(key)).cloned().collect();
                lines.extend(rows(name, &keys));
            } else if is_here(section) {
                let said = thing.keys.iter().filter(|(key, _)| !is_initial(key)).cloned();
                let keys: Vec<_> = said.chain(unsaid(section, thing, &left.keys)).collect();
                lines.extend(rows(name, &keys));
            }
        }
        let lines = if lines.is_empty() && *title == "Initial state" {
            vec![vec![String::new(), "all parts".to_string(), "at rest".to_string()]]
        } else {
            lines
        };
        if !lines.is_empty() {
            let head = if *title == "Run" { ["", "key", "value"] } else { ["name", "key", "value"] };
            body += &format!("<h3>{}</h3>\n<div class=\"chosen\">{}</div>\n", escape(title), table(&head, &lines, 3));
        }
    }
    body
}

/// What the parts are made of: elements, sizes, shapes.
fn made_of(parts: &[PartMade], left: &Left) -> String {
    if parts.is_empty() {
        return String::new();
    }
    let mass = if left.is_of_whole_bodies { "kg" } else { "kg/m" };
    let row = |part: &PartMade| {
        let elements: Vec<String> = part.elements.iter().map(|(name, count)| format!("{} {name}", grouped(*count as u64))).collect();
        let [small, large] = part.sizes.map(|size| shown(size, "m"));
        vec![
            part.name.clone(),
            elements.join(", "),
            grouped(part.nodes as u64),
            shown(part.mass, mass),
            if small == large { small } else { format!("{small} to {large}") },
            format!("{:.2}", part.shape),
            part.stable_time_step.map_or("rigid".to_string(), |step| shown(step, "s")),
        ]
    };
    let head = ["part", "elements", "nodes", "mass", "sizes", "worst shape", "stable step"];
    let mut body = format!("<h3>Mesh</h3>\n{}", table(&head, &parts.iter().map(row).collect::<Vec<_>>(), 2));
    body += "<p class=\"faint\">Size: length, root of the area or cube root of the volume. Shape: smallest Jacobian determinant at a \
             corner over the power of the longest side; 1 for squares and cubes, 0.87 for the best triangle, 0.71 for the best \
             tetrahedron, 0 where an element collapses.</p>\n";
    for part in parts.iter().filter(|part| part.shape < POOR) {
        let at: Vec<String> = part.worst.iter().map(|x| format!("{} m", significant(*x))).collect();
        body +=
            &paragraph(&format!("The worst element of part \"{}\", at ({}), has the shape {:.3}.", part.name, at.join(", "), part.shape));
    }
    body
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_divided_into_section_thing_and_key() {
        assert_eq!(divided("part[3].rectangle.size"), ("part", "part[3]", "rectangle.size"));
        assert_eq!(divided("material.steel.failure.plastic_strain"), ("material", "material.steel", "failure.plastic_strain"));
        assert_eq!(divided("run.end"), ("run", "run", "end"));
        assert_eq!(divided("title"), ("", "", "title"));
        assert_eq!(snake("DoublePass"), "double_pass");
    }

    #[test]
    fn things_have_their_names_and_keys_as_written() {
        let written = [("part[0].name", "\"rod\""), ("part[0].velocity", "[0, \"-3 m/s\"]"), ("material.a.law", "\"j2\"")];
        let all = things(&written.map(|(key, value)| (key.to_string(), value.to_string())));
        assert_eq!((all[0].1.name.as_str(), all[0].1.keys.clone()), ("rod", vec![("velocity".to_string(), "[0, \"-3 m/s\"]".to_string())]));
        assert_eq!((all[1].1.name.as_str(), all[1].1.at.as_str()), ("a", "material.a"));
    }
}
