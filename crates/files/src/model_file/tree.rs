//! The model file as a tree of values, each with its place in the text.
//!
//! Texts come from the file and from `--set`; the tree is changed by `set.rs` and read by `reader.rs`. TOML's
//! own syntax is left to the `toml` crate, which bounds the depth of nesting.

use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A range of bytes in one of the sources.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Default)]
pub(crate) struct Place {
    /// 0 the file, then the `--set` texts.
    pub source: usize,
    /// First byte.
    pub start: usize,
    /// Behind the last byte.
    pub end: usize,
}

/// A value and its place; for a table its header or braces.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    pub value: Value,
    pub place: Place,
}

/// What a value is.
#[derive(Clone, Debug)]
pub(crate) enum Value {
    Text(String),
    /// A whole number as written, as an integer if it fits, and as a float.
    Integer(String, Option<i128>, f64),
    /// A number as written and its value.
    Float(String, f64),
    Flag(bool),
    Date,
    List(Vec<Node>),
    Table(Vec<Entry>),
}

/// A key of a table with its value.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    pub key: String,
    pub place: Place,
    pub node: Node,
}

/// What TOML says against a text.
#[derive(Clone, Debug)]
pub(super) struct SyntaxFault {
    pub message: String,
    pub place: Option<Range<usize>>,
}

/// Parses a whole file.
pub(super) fn document(text: &str, source: usize) -> Result<Node, SyntaxFault> {
    let table = DeTable::parse(text).map_err(|error| SyntaxFault { message: error.message().to_string(), place: error.span() })?;
    let place = Place { source, start: 0, end: 0 };
    Ok(Node { value: Value::Table(entries(table.get_ref(), source, 0)), place })
}

/// Parses a single value, which begins at byte `offset` of its source.
pub(super) fn value(text: &str, source: usize, offset: usize) -> Option<Node> {
    DeValue::parse(text).ok().map(|value| node(&value, source, offset))
}

fn place(range: Range<usize>, source: usize, offset: usize) -> Place {
    Place { source, start: range.start + offset, end: range.end + offset }
}

fn node(from: &Spanned<DeValue<'_>>, source: usize, offset: usize) -> Node {
    let value = match from.get_ref() {
        DeValue::String(text) => Value::Text(text.to_string()),
        DeValue::Integer(number) => {
            let integer = i128::from_str_radix(number.as_str(), number.radix()).ok();
            let float = number.as_str().parse().ok().filter(|_| number.radix() == 10);
            Value::Integer(number.to_string(), integer, float.or(integer.map(|i| i as f64)).unwrap_or(f64::INFINITY))
        }
        DeValue::Float(number) => Value::Float(number.as_str().to_string(), number.as_str().parse().unwrap_or(f64::NAN)),
        DeValue::Boolean(flag) => Value::Flag(*flag),
        DeValue::Datetime(_) => Value::Date,
        DeValue::Array(list) => Value::List(list.iter().map(|item| node(item, source, offset)).collect()),
        DeValue::Table(table) => Value::Table(entries(table, source, offset)),
    };
    Node { value, place: place(from.span(), source, offset) }
}

/// Entries in the order of the text.
fn entries(table: &DeTable<'_>, source: usize, offset: usize) -> Vec<Entry> {
    let mut all: Vec<Entry> = table
        .iter()
        .map(|(key, value)| Entry {
            key: key.get_ref().to_string(),
            place: place(key.span(), source, offset),
            node: node(value, source, offset),
        })
        .collect();
    all.sort_by_key(|entry| entry.place);
    all
}

impl Node {
    /// The place of a path such as `part[0].ring.inner`, or of the nearest thing above it that exists.
    pub(super) fn locate(&self, path: &str) -> Place {
        self.walk(path).0
    }

    /// The same, with the node at the path if it is there.
    pub(super) fn find<'a>(&'a self, path: &'a str) -> (Place, Option<&'a Self>) {
        let (place, node, rest) = self.walk(path);
        (place, Some(node).filter(|_| rest.is_empty()))
    }

    /// Goes down a path as far as there is something: where that is, what it is, and what is left of the
    /// path.
    fn walk<'a>(&'a self, path: &'a str) -> (Place, &'a Self, &'a str) {
        let (mut here, mut found, mut rest) = (self, self.place, path);
        loop {
            let next = match &here.value {
                Value::Table(entries) => longest(entries, rest.strip_prefix('.').unwrap_or(rest)),
                Value::List(items) => indexed(items, rest),
                _ => None,
            };
            let Some((place, node, after)) = next else { return (found, here, rest) };
            (here, rest) = (node, after);
            found = if matches!(node.value, Value::Table(_)) { place } else { node.place };
        }
    }

    /// What this value is, for messages.
    pub(super) fn words(&self) -> String {
        match &self.value {
            Value::Text(text) => super::units::shorten(text),
            Value::Integer(text, ..) | Value::Float(text, _) => super::units::shorten(text).trim_matches('"').to_string(),
            Value::Flag(flag) => format!("`{flag}`"),
            Value::Date => "a date".to_string(),
            Value::List(items) => format!("a list of {}", items.len()),
            Value::Table(_) => "a table".to_string(),
        }
    }
}

type Step<'a> = Option<(Place, &'a Node, &'a str)>;

/// The entry whose key begins the path; keys may themselves hold dots.
fn longest<'a>(entries: &'a [Entry], path: &'a str) -> Step<'a> {
    let after = |entry: &&Entry| path.strip_prefix(entry.key.as_str()).is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']));
    let entry = entries.iter().filter(after).max_by_key(|entry| entry.key.len())?;
    let place = if entry.node.place.end > entry.node.place.start && matches!(entry.node.value, Value::Table(_)) {
        entry.node.place
    } else {
        entry.place
    };
    Some((place, &entry.node, &path[entry.key.len()..]))
}

fn indexed<'a>(items: &'a [Node], path: &'a str) -> Step<'a> {
    let (index, rest) = path.strip_prefix('[')?.split_once(']')?;
    let node = items.get(index.parse::<usize>().ok()?)?;
    Some((node.place, node, rest))
}
