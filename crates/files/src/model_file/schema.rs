//! The JSON schema of the model file, for completion and checks in editors.
//!
//! Made by iteration over [`sections`](embate_solver::input::sections) and the registries; `embate schema`
//! prints it.

use super::tree::{self, Value};
use super::units;
use embate_solver::input::sections::{SECTIONS, TOP};
use embate_solver::material;
use embate_solver::quantity::{Dimension, Range};
use embate_solver::vocabulary::{Form, Key, Kind, More, Need, Rule, Section};

/// Names: no ASCII character but letters, digits, `-` and `_`. Written without classes, which not every
/// reader of schemas knows.
const NAME_PATTERN: &str = r"^[^\u0000-\u002c\u002e\u002f\u003a-\u0040\u005b-\u005e\u0060\u007b-\u007f]{1,64}$";

/// A JSON value; objects keep their order.
#[derive(Clone, Debug)]
enum Json {
    Text(String),
    Number(f64),
    Flag(bool),
    List(Vec<Json>),
    Object(Vec<(String, Json)>),
}

fn text(text: impl Into<String>) -> Json {
    Json::Text(text.into())
}

fn object<const N: usize>(entries: [(&str, Json); N]) -> Json {
    Json::Object(entries.into_iter().map(|(key, value)| (key.to_string(), value)).collect())
}

fn texts<'a>(all: impl IntoIterator<Item = &'a str>) -> Json {
    Json::List(all.into_iter().map(text).collect())
}

impl Json {
    fn with(mut self, key: &str, value: Json) -> Self {
        if let Self::Object(entries) = &mut self {
            entries.push((key.to_string(), value));
        }
        self
    }

    fn write(&self, out: &mut String, depth: usize) {
        match self {
            Self::Text(text) => quote(text, out),
            Self::Number(number) => out.push_str(&number.to_string()),
            Self::Flag(flag) => out.push_str(&flag.to_string()),
            Self::List(items) => block(out, depth, ['[', ']'], items, |item, out| item.write(out, depth + 1)),
            Self::Object(entries) => block(out, depth, ['{', '}'], entries, |(key, value), out| {
                quote(key, out);
                out.push_str(": ");
                value.write(out, depth + 1);
            }),
        }
    }
}

fn block<T>(out: &mut String, depth: usize, [open, close]: [char; 2], items: &[T], write: impl Fn(&T, &mut String)) {
    out.push(open);
    for (index, item) in items.iter().enumerate() {
        out.push_str(if index == 0 { "\n" } else { ",\n" });
        out.push_str(&"  ".repeat(depth + 1));
        write(item, out);
    }
    if !items.is_empty() {
        out.push('\n');
        out.push_str(&"  ".repeat(depth));
    }
    out.push(close);
}

fn quote(text: &str, out: &mut String) {
    out.push('"');
    for c in text.chars() {
        match c {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            c if c.is_control() => out.push_str(&format!("\\u{:04x}", u32::from(c))),
            c => out.push(c),
        }
    }
    out.push('"');
}

/// The JSON schema (draft 2020-12) of the model file.
#[must_use]
pub fn schema() -> String {
    let mut properties: Vec<(String, Json)> = TOP.keys.iter().map(|key| (key.name.to_string(), of_key(key))).collect();
    properties.extend(SECTIONS.iter().map(|section| (section.name.to_string(), of_section(section))));
    let required = texts(SECTIONS.iter().filter(|section| section.required).map(|section| section.name));
    let root = object([
        ("$schema", text("https://json-schema.org/draft/2020-12/schema")),
        ("title", text("embate model file")),
        ("description", text("Numbers are in SI units; a text carries its own unit, such as \"3 mm\".")),
        ("type", text("object")),
        ("properties", Json::Object(properties)),
        ("required", required),
        ("additionalProperties", Json::Flag(false)),
    ]);
    let mut out = String::new();
    root.write(&mut out, 0);
    out.push('\n');
    out
}

fn of_section(section: &Section) -> Json {
    let described = |json: Json| json.with("description", text(section.doc));
    match section.form {
        Form::Single | Form::Inline => described(of_table(section, &all(section))),
        Form::Repeated => described(object([("type", text("array")), ("items", of_table(section, &all(section)))])),
        Form::Named => described(object([
            ("type", text("object")),
            ("additionalProperties", Json::Object(vec![("oneOf".to_string(), variants(section))])),
        ])),
    }
}

/// One table per value of the deciding key.
fn variants(section: &Section) -> Json {
    let names: Vec<&str> = material::registry().iter().map(|kind| kind.name).collect();
    let Some((more, others)) = section.more.split_first() else { return Json::List(vec![of_table(section, &all(section))]) };
    let variant = |name: &&str| {
        let mut keys = all(section);
        keys.extend((more.keys)(name).into_iter().flatten());
        let mut rules = Vec::new();
        for other in others {
            keys_by(other, &mut keys, &mut rules);
        }
        let mut table = of_table(section, &keys);
        if !rules.is_empty() {
            table = table.with("allOf", Json::List(rules));
        }
        if let Json::Object(entries) = &mut table
            && let Some((_, Json::Object(properties))) = entries.iter_mut().find(|(key, _)| key == "properties")
            && let Some((_, decides)) = properties.iter_mut().find(|(key, _)| key == more.by)
        {
            *decides = object([("const", text(*name))]);
        }
        table
    };
    Json::List(names.iter().map(variant).collect())
}

/// Keys that come with the values of a key that may be left out: each only with its value, and there if that
/// needs it.
fn keys_by(more: &More, keys: &mut Vec<Key>, rules: &mut Vec<Json>) {
    let Some(Kind::Choice(values)) = keys.iter().find(|key| key.name == more.by).map(|key| key.kind) else { return };
    let variants: Vec<(&str, Vec<Key>)> = values.names().into_iter().map(|value| (value, (more.keys)(value).unwrap_or_default())).collect();
    let known: Vec<&str> = keys.iter().map(|key| key.name).collect();
    let own = |key: &&Key| !known.contains(&key.name);
    let mut names: Vec<&str> = variants.iter().flat_map(|(_, keys)| keys).filter(own).map(|key| key.name).collect();
    names.sort_unstable();
    names.dedup();
    for (value, here) in &variants {
        let is = object([("properties", object([(more.by, object([("const", text(*value))]))])), ("required", texts([more.by]))]);
        let needed = texts(here.iter().filter(|key| key.need == Need::Required).map(|key| key.name));
        let foreign: Vec<Json> = names
            .iter()
            .filter(|name| here.iter().all(|key| key.name != **name))
            .map(|name| object([("required", texts([*name]))]))
            .collect();
        let then = object([("required", needed), ("not", object([("anyOf", Json::List(foreign))]))]);
        rules.push(object([("if", is), ("then", then)]));
    }
    rules.push(object([("dependentRequired", Json::Object(names.iter().map(|name| ((*name).to_string(), texts([more.by]))).collect()))]));
    for key in variants.into_iter().flat_map(|(_, keys)| keys) {
        if keys.iter().all(|known| known.name != key.name) {
            keys.push(key);
        }
    }
}

fn of_table(section: &Section, keys: &[Key]) -> Json {
    let properties = keys.iter().map(|key| (key.name.to_string(), of_key(key))).collect();
    let table = object([
        ("type", text("object")),
        ("properties", Json::Object(properties)),
        ("required", texts(keys.iter().filter(|key| key.need == Need::Required).map(|key| key.name))),
        ("additionalProperties", Json::Flag(false)),
    ]);
    let rules: Vec<Json> = section.all_rules().map(|rule| of_rule(rule, keys)).collect();
    if rules.is_empty() { table } else { table.with("allOf", Json::List(rules)) }
}

fn all(section: &Section) -> Vec<Key> {
    section.all_keys().copied().collect()
}

fn of_rule(rule: &Rule, all: &[Key]) -> Json {
    let needs = |name: &&str| object([("required", texts([*name]))]);
    match rule {
        Rule::OneOf(names) => object([("oneOf", Json::List(names.iter().map(needs).collect()))]),
        Rule::SomeOf(names) => object([("anyOf", Json::List(names.iter().map(needs).collect()))]),
        Rule::NotBoth(one, other) => object([("not", object([("required", texts([*one, *other]))]))]),
        Rule::Needs(one, other) => object([("dependentRequired", object([(one, texts([*other]))]))]),
        Rule::Only { keys, by, value } => {
            let none = object([("not", object([("anyOf", Json::List(keys.iter().map(needs).collect()))]))]);
            object([("if", has(all, by, value)), ("else", none)])
        }
        Rule::With { by, value, keys } => {
            object([("if", has(all, by, value)), ("then", object([("required", texts(keys.iter().copied()))]))])
        }
    }
}

/// A key has a value, or is left out if that is its default.
fn has(all: &[Key], by: &str, value: &str) -> Json {
    let wanted = match value {
        "true" | "false" => Json::Flag(value == "true"),
        _ => text(value),
    };
    let default = all.iter().any(|key| key.name == by && matches!(key.need, Need::Default(written) if written.trim_matches('"') == value));
    let json = object([("properties", object([(by, object([("const", wanted)]))]))]);
    if default { json } else { json.with("required", texts([by])) }
}

fn of_key(key: &Key) -> Json {
    let json = match key.kind {
        Kind::Quantity(dimension, range) => quantity(dimension, range),
        Kind::Angle(dimension, range) => {
            let example = if dimension == Dimension::RATE { "30 rad/s" } else { "30 deg" };
            any([number(range), object([("type", text("string")), ("examples", texts([example]))])])
        }
        Kind::Vector(dimension, range) => list(quantity(dimension, range), Some(2)),
        Kind::Spatial(dimension, range) => between(object([("type", text("array")), ("items", quantity(dimension, range))]), [2, 3]),
        Kind::Quantities(dimension, range, least) => at_least(quantity(dimension, range), least),
        Kind::Value => quantity(Dimension::VELOCITY, Range::Finite),
        Kind::Values => at_least(quantity(Dimension::VELOCITY, Range::Finite), 1),
        Kind::Points(least) => points(least),
        Kind::Outlines(least) => at_least(points(least), 1),
        Kind::SpatialPoints(least) => spatial_points(least),
        Kind::SpatialOutlines(least) => at_least(spatial_points(least), 1),
        Kind::Drive(dimension) => drive(&example_of(dimension), &["ramp"]),
        Kind::Components(dimension) => courses(&["x", "y", "z"], dimension, &["ramp"]),
        Kind::Motion => courses(&["x", "y", "z", "rotation"], Dimension::VELOCITY, &["free", "ramp"]),
        Kind::Rigid => {
            any([object([("type", text("boolean"))]), courses(&["x", "y", "z", "rotation"], Dimension::VELOCITY, &["free", "ramp"])])
        }
        Kind::Stiffness(_, range) => {
            any([number(range), object([("type", text("string")), ("examples", texts(["3.5e11 N/m/m", "1e14 Pa/m"]))])])
        }
        Kind::MassFlow(_, range) => {
            any([number(range), object([("type", text("string")), ("examples", texts(["0.5 kg/s", "0.5 kg/s/m"]))])])
        }
        Kind::Integer(least) => integer(least),
        Kind::Integers(count, least) => list(integer(least), Some(count)),
        Kind::Cadence => any([integer(0), quantity(Dimension::TIME, Range::Positive)]),
        Kind::Flag => object([("type", text("boolean"))]),
        Kind::Text | Kind::Reference => object([("type", text("string"))]),
        Kind::Name => object([("type", text("string")), ("pattern", text(NAME_PATTERN))]),
        Kind::References(Some(count)) => list(object([("type", text("string"))]), Some(count)),
        Kind::References(None) => one_or_more(object([("type", text("string"))])),
        Kind::Choice(known) => choice(&known.names()),
        Kind::Choices(known) => one_or_more(choice(&known.names())),
        Kind::Table(section) => of_table(section, &all(section)),
        Kind::Tables(section) => at_least(of_table(section, &all(section)), 1),
    };
    let json = json.with("description", text(key.doc));
    match key.need {
        Need::Default(written) => match tree::value(written, 0, 0) {
            Some(node) => json.with("default", of_value(&node.value)),
            None => json,
        },
        Need::Value(value) => json.with("default", Json::Number(value)),
        Need::Required | Need::Optional(_) => json,
    }
}

fn any<const N: usize>(all: [Json; N]) -> Json {
    object([("anyOf", Json::List(all.into()))])
}

fn choice(known: &[&str]) -> Json {
    object([("enum", texts(known.iter().copied()))])
}

fn list(items: Json, count: Option<usize>) -> Json {
    let json = object([("type", text("array")), ("items", items)]);
    match count {
        Some(count) => between(json, [count; 2]),
        None => json.with("minItems", Json::Number(1.0)),
    }
}

/// A list of at least and at most so many items.
fn between(list: Json, [least, most]: [usize; 2]) -> Json {
    list.with("minItems", Json::Number(least as f64)).with("maxItems", Json::Number(most as f64))
}

fn points(least: usize) -> Json {
    at_least(list(quantity(Dimension::LENGTH, Range::Finite), Some(2)), least)
}

fn spatial_points(least: usize) -> Json {
    let items = quantity(Dimension::LENGTH, Range::Finite);
    at_least(between(object([("type", text("array")), ("items", items)]), [2, 3]), least)
}

fn at_least(items: Json, count: usize) -> Json {
    object([("type", text("array")), ("items", items), ("minItems", Json::Number(count as f64))])
}

/// What follows a number or a curve.
fn drive(example: &str, others: &[&str]) -> Json {
    let words = std::iter::once(example).chain(others.iter().copied());
    any([number(Range::Finite), object([("type", text("string")), ("examples", texts(words))])])
}

/// A quantity with its unit.
fn example_of(dimension: Dimension) -> String {
    if dimension == Dimension::RATE { "30 rad/s".to_string() } else { units::example(dimension) }
}

/// Prescribed components: numbers, or texts with a unit, names of curves, or `free`.
fn courses(axes: &[&str], straight: Dimension, others: &[&str]) -> Json {
    let course = |axis: &&str| {
        let dimension = if *axis == "rotation" { Dimension::RATE } else { straight };
        (axis.to_string(), drive(&example_of(dimension), others))
    };
    object([
        ("type", text("object")),
        ("properties", Json::Object(axes.iter().map(course).collect())),
        ("minProperties", Json::Number(1.0)),
        ("additionalProperties", Json::Flag(false)),
    ])
}

fn one_or_more(item: Json) -> Json {
    any([item.clone(), list(item, None)])
}

fn integer(least: u64) -> Json {
    object([("type", text("integer")), ("minimum", Json::Number(least as f64))])
}

fn number(range: Range) -> Json {
    let json = object([("type", text("number"))]);
    match range {
        Range::Finite => json,
        Range::Positive => json.with("exclusiveMinimum", Json::Number(0.0)),
        Range::NotNegative => json.with("minimum", Json::Number(0.0)),
        Range::Between(low, high) => json.with("exclusiveMinimum", Json::Number(low)).with("exclusiveMaximum", Json::Number(high)),
        Range::UpTo(low, high) => json.with("exclusiveMinimum", Json::Number(low)).with("maximum", Json::Number(high)),
    }
}

/// A number, or a text with a unit.
fn quantity(dimension: Dimension, range: Range) -> Json {
    any([number(range), object([("type", text("string")), ("examples", texts([units::example(dimension).as_str()]))])])
}

fn of_value(value: &Value) -> Json {
    match value {
        Value::Text(written) => text(written),
        Value::Integer(_, _, number) | Value::Float(_, number) => Json::Number(*number),
        Value::Flag(flag) => Json::Flag(*flag),
        Value::Date => text(""),
        Value::List(items) => Json::List(items.iter().map(|item| of_value(&item.value)).collect()),
        Value::Table(entries) => Json::Object(entries.iter().map(|entry| (entry.key.clone(), of_value(&entry.node.value))).collect()),
    }
}
