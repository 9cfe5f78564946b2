//! `--set path.to.key=value`: values that replace or join those of the file before it is read.
//!
//! Texts come from the command line; the tree is changed in place, and each new value remembers that it came
//! from `--set`.

use super::diagnostics::{Faults, Source};
use super::tree::{self, Entry, Node, Place, Value};
use crate::model_file::messages::OVERRIDE;
use embate_solver::input::sections::section;
use embate_solver::vocabulary::{Form, suggestion};

/// Deepest path that any key needs, with some to spare.
const DEPTH_MAX: usize = 12;

/// Applies all texts in their order.
pub(super) fn apply(root: &mut Node, texts: &[String], sources: &mut Vec<Source>, faults: &mut Faults) {
    for text in texts {
        let source = sources.len();
        sources.push(Source { name: "--set".to_string(), text: text.clone() });
        if let Err(wrong) = one(root, text, source) {
            faults.beside(&OVERRIDE, "", Some(Place { source, start: 0, end: text.len() }), wrong);
        }
    }
}

type Wrong = (String, String);

fn one(root: &mut Node, text: &str, source: usize) -> Result<(), Wrong> {
    let form = "write it like part.tube.velocity=[0, \"-50 m/s\"]";
    let Some((path, written)) = text.split_once('=') else {
        return Err(("there is no `=` between a key and its value".to_string(), form.to_string()));
    };
    let steps = steps(path, form)?;
    let offset = path.len() + 1 + (written.len() - written.trim_start().len());
    let written = written.trim();
    let place = Place { source, start: offset, end: offset + written.len() };
    let value = tree::value(written, source, offset).unwrap_or(Node { value: Value::Text(written.to_string()), place });
    let key = Place { source, start: 0, end: path.trim_end().len() };
    if let (Some(first), Value::Table(entries)) = (steps.first().filter(|_| steps.len() > 1), &root.value)
        && section(first).is_some_and(|section| section.form == Form::Repeated)
        && !entries.iter().any(|entry| entry.key == *first)
    {
        return Err((format!("the model has no [[{first}]]"), "only things that the file has can be changed".to_string()));
    }
    put(root, &steps, value, key, "")
}

/// Gives a key that the model may have another value: unlike an override, it makes no table of its own.
pub(super) fn replace(root: &mut Node, path: &str, value: Node, key: Place) -> Result<(), Wrong> {
    let steps = steps(path, "write it like material.steel.young, as the keys stand in the model file")?;
    exists(root, &steps)?;
    put(root, &steps, value, key, "")
}

/// The steps of a path.
fn steps(path: &str, form: &str) -> Result<Vec<String>, Wrong> {
    let steps: Vec<String> =
        path.replace('[', ".").replace(']', "").split('.').map(|step| step.trim().trim_matches('"').to_string()).collect();
    if steps.iter().any(String::is_empty) || steps.len() > DEPTH_MAX {
        return Err((format!("{} is not the path of a key", super::units::shorten(path)), form.to_string()));
    }
    Ok(steps)
}

/// Whether everything above the last step is there; sections that stand once may be missing.
fn exists(root: &Node, steps: &[String]) -> Result<(), Wrong> {
    let (mut here, mut above) = (root, "the model".to_string());
    for (depth, step) in steps.iter().enumerate().take(steps.len().saturating_sub(1)) {
        here = match &here.value {
            Value::Table(entries) => match entries.iter().find(|entry| entry.key == *step) {
                Some(entry) => &entry.node,
                None if depth == 0 && section(step).is_some_and(|section| matches!(section.form, Form::Single | Form::Inline)) => {
                    return Ok(());
                }
                None => {
                    let known: Vec<&str> = entries.iter().map(|entry| entry.key.as_str()).collect();
                    return Err((format!("{above} has no `{step}`"), suggestion(step, &known)));
                }
            },
            Value::List(items) => match index(items, step) {
                Some(at) => &items[at],
                None => return Err(missing(items, step, above.trim_matches('`'))),
            },
            _ => return Ok(()), // reported by `put`
        };
        above = format!("`{}`", steps[..=depth].join("."));
    }
    Ok(())
}

/// Walks one step down, or puts the value.
fn put(node: &mut Node, steps: &[String], value: Node, key: Place, above: &str) -> Result<(), Wrong> {
    let Some((step, further)) = steps.split_first() else {
        *node = value;
        return Ok(());
    };
    let here = if above.is_empty() { step.clone() } else { format!("{above}.{step}") };
    match &mut node.value {
        Value::Table(entries) => {
            let at = entries.iter().position(|entry| entry.key == *step).unwrap_or_else(|| {
                entries.push(Entry { key: step.clone(), place: key, node: Node { value: Value::Table(Vec::new()), place: key } });
                entries.len() - 1
            });
            if further.is_empty() {
                entries[at].place = key;
            }
            put(&mut entries[at].node, further, value, key, &here)
        }
        Value::List(items) => {
            let at = index(items, step).ok_or_else(|| missing(items, step, above))?;
            put(&mut items[at], further, value, key, &here)
        }
        _ => Err((format!("`{above}` is a single value, so it has no `{step}`"), String::new())),
    }
}

/// Position of a list item by number, or by the `name` in it.
fn index(items: &[Node], step: &str) -> Option<usize> {
    items.iter().position(|item| name(item) == Some(step)).or_else(|| step.parse().ok().filter(|at| *at < items.len()))
}

fn name(item: &Node) -> Option<&str> {
    let Value::Table(entries) = &item.value else { return None };
    entries.iter().find_map(|entry| match &entry.node.value {
        Value::Text(text) if entry.key == "name" => Some(text.as_str()),
        _ => None,
    })
}

fn missing(items: &[Node], step: &str, above: &str) -> Wrong {
    let names: Vec<&str> = items.iter().filter_map(name).collect();
    let help = match (step.parse::<usize>().is_ok() || names.is_empty(), items.len()) {
        (true, 0) => "the list is empty".to_string(),
        (true, count) => format!("numbers run from 0 to {}", count - 1),
        (false, _) => suggestion(step, &names),
    };
    (format!("`{above}` has no `{step}`"), help)
}
