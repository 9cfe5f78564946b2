//! What ran: parts, materials, contacts and obstacles in tables, and all keys as `run.json` has them.

use super::Left;
use super::html::{self, escape, facts, table};
use crate::post_mortem::shown;
use crate::results::History;
use embate_solver::{element, material};
use std::collections::{BTreeMap, BTreeSet};

type Keys = BTreeMap<String, String>;

/// A value as text: without the quotes of a text.
pub(super) fn plain(value: &str) -> String {
    match value.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')) {
        Some(inner) => inner.replace("\\\"", "\"").replace("\\\\", "\\"),
        None => value.to_string(),
    }
}

/// Whether energies and forces are those of whole bodies: axisymmetric parts, or elements in 3D.
pub(super) fn is_of_whole_bodies(keys: &Keys, history: Option<&History>) -> bool {
    let part = |key: &str, ends: &str| key.starts_with("part[") && key.ends_with(ends);
    let reported = keys.iter().any(|(key, value)| {
        part(key, "].stress_state") && plain(value) == "axisymmetric" || part(key, "].element") && is_of_3d(&plain(value))
    });
    let has_z = |history: &History| history.columns.iter().any(|name| name.contains(".force_z[") || name.ends_with(".vz"));
    reported || history.is_some_and(has_z)
}

/// Whether elements of this name are those in 3D.
pub(super) fn is_of_3d(name: &str) -> bool {
    element::registry().iter().any(|kind| kind.name == name && kind.dimension == 3)
}

/// Values of one thing of a list: `part[3]`, `material.steel`.
struct Thing<'a> {
    keys: &'a Keys,
    at: String,
}

impl Thing<'_> {
    /// Value of a key; empty where there is none.
    fn value(&self, key: &str) -> String {
        self.keys.get(&format!("{}.{key}", self.at)).map_or(String::new(), |value| plain(value))
    }

    /// Some values by names.
    fn values(&self, names: &[(&str, &str)]) -> String {
        let reported = names.iter().map(|(key, name)| (name, self.value(key))).filter(|(_, value)| !matches!(value.as_str(), "" | "None"));
        reported.map(|(name, value)| format!("{name} {value}")).collect::<Vec<_>>().join(", ")
    }
}

/// Things of a list, in their order.
fn listed<'a>(keys: &'a Keys, list: &str) -> Vec<Thing<'a>> {
    let number = |key: &String| key.strip_prefix(list)?.strip_prefix('[')?.split(']').next()?.parse::<usize>().ok();
    let numbers: BTreeSet<usize> = keys.keys().filter_map(number).collect();
    numbers.into_iter().map(|number| Thing { keys, at: format!("{list}[{number}]") }).collect()
}

/// Things of a table, by name.
fn named<'a>(keys: &'a Keys, list: &str) -> Vec<(String, Thing<'a>)> {
    let name = |key: &'a String| key.strip_prefix(list)?.strip_prefix('.')?.strip_suffix(".law");
    keys.keys().filter_map(name).map(|name| (name.to_string(), Thing { keys, at: format!("{list}.{name}") })).collect()
}

/// Parameters of a material with the units of its law.
fn parameters(thing: &Thing<'_>) -> String {
    let before = format!("{}.parameters.", thing.at);
    let law = thing.value("law");
    let laws = material::registry();
    let law = laws.iter().find(|kind| kind.name == law);
    let one = |(key, value): (&String, &String)| {
        let name = key.strip_prefix(&before)?;
        let unit = law.and_then(|law| law.parameters.iter().find(|own| own.name == name)).map_or(String::new(), |own| own.dimension.unit());
        let value = match value.parse::<f64>() {
            Ok(number) if unit == "Pa" || unit.is_empty() => shown(number, &unit),
            _ => format!("{value} {unit}").trim_end().to_string(),
        };
        Some(format!("{} {value}", name.replace('_', " ")))
    };
    thing.keys.range(before.clone()..).take_while(|(key, _)| key.starts_with(&before)).filter_map(one).collect::<Vec<_>>().join(", ")
}

pub(super) fn section(left: &Left) -> String {
    let keys = &left.keys;
    let texts = |thing: &Thing<'_>, names: &[&str]| -> Vec<String> { names.iter().map(|name| thing.value(name)).collect() };
    let mut body = String::new();
    let count = |key: &str| left.number(key).map(|number| (key.to_string(), format!("{number:.0}")));
    if left.ran.as_ref().is_none_or(|ran| ran.parts.is_empty()) {
        body += &facts(&[count("elements"), count("nodes")].into_iter().flatten().collect::<Vec<_>>());
    }
    let chosen = super::chosen::section(left);
    let is_in_words = !chosen.is_empty();
    body += &chosen;
    let mut tables = |title: &str, head: &[&str], rows: Vec<Vec<String>>| {
        // What the file says is better than what was made of it.
        if !rows.is_empty() && !is_in_words {
            body += &format!("<h3>{}</h3>\n{}", escape(title), table(head, &rows, head.len()));
        }
    };
    let of_part = |it: &Thing<'_>| {
        let mut cells = texts(it, &["name", "shape.kind", "element", "material", "stress_state"]);
        // Solids have none.
        if is_of_3d(&cells[2]) {
            cells[4] = "solid".into();
        }
        cells
    };
    let parts = listed(keys, "part").iter().map(of_part).collect();
    tables("Parts", &["name", "shape", "elements", "material", "state"], parts);
    let materials = named(keys, "material").iter().map(|(name, it)| vec![name.clone(), it.value("law"), parameters(it)]).collect();
    tables("Materials", &["name", "law", "values"], materials);
    let interface = [
        ("interface.law.kind", "law"),
        ("interface.law.scale", "scale"),
        ("interface.friction", "friction"),
        ("interface.friction.static", "static friction"),
        ("interface.friction.dynamic", "dynamic friction"),
        ("interface.damping", "damping"),
        ("interface.thickness", "thickness"),
    ];
    let contacts =
        listed(keys, "contact").iter().map(|it| vec![it.value("name"), it.value("formulation"), it.values(&interface)]).collect();
    tables("Contacts", &["name", "formulation", "values"], contacts);
    let obstacles =
        listed(keys, "obstacle").iter().map(|it| vec![it.value("name"), it.value("shape.kind"), it.values(&interface)]).collect();
    tables("Obstacles", &["name", "shape", "values"], obstacles);
    if keys.is_empty() {
        body += "<p>There is no <code>run.json</code>, which has the keys of the model.</p>\n";
    } else {
        let rows: Vec<Vec<String>> = keys.iter().map(|(key, value)| vec![key.clone(), value.clone()]).collect();
        body += &format!(
            "<details><summary>All {} keys, with defaults, in SI units</summary>\n{}</details>\n",
            rows.len(),
            table(&["key", "value"], &rows, 2)
        );
    }
    html::section("Model", &body)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn things_come_in_the_order_of_their_numbers_and_texts_without_quotes() {
        let keys: Keys = (0..12).map(|k| (format!("part[{k}].name"), format!("\"p{k}\""))).collect();
        let names: Vec<String> = listed(&keys, "part").iter().map(|it| it.value("name")).collect();
        assert_eq!((names[2].as_str(), names[10].as_str(), names.len()), ("p2", "p10", 12));
        assert_eq!((plain("\"a \\\"b\\\"\""), plain("1.0"), plain("\"")), ("a \"b\"".into(), "1.0".into(), "\"".into()));
    }

    #[test]
    fn bodies_of_3d_and_of_revolution_are_whole() {
        let of = |key: &str, value: &str| is_of_whole_bodies(&[(key.to_string(), value.to_string())].into(), None);
        assert!(of("part[0].element", "\"hex8\"") && of("part[0].stress_state", "\"axisymmetric\""));
        assert!(!of("part[0].element", "\"quad4\"") && !of("part[0].stress_state", "\"plane_strain\""));
    }
}
