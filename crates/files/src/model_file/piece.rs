//! Pieces of a model in texts of their own: checked by themselves when a program gives them one by one, or
//! added to the model of a file.
//!
//! A piece is read as the sections of a model file are; what it lacks may still come.

use super::diagnostics::{Diagnostics, Faults, Source};
use super::tree::{Entry, Node, Value};
use super::{parsed, reader};
use embate_solver::input::sections::section;
use embate_solver::model::messages::TWICE;
use embate_solver::vocabulary::Form;

/// What messages call a text whose sections are added to a file.
pub(super) const ADDED: &str = "added by the program";

/// Checks some sections of a model that is not complete: keys, values, and the rules between the keys of what
/// is there as a whole. `name` stands for the text in messages; the items of the section `list` are counted
/// from `first`.
///
/// # Errors
/// All faults at once.
pub fn check_piece(name: &str, text: &str, (list, first): (&str, usize)) -> Result<(), Diagnostics> {
    let (source, root) = parsed(Source { name: name.to_string(), text: text.to_string() })?;
    let mut faults = reader::faults_of_piece(&root);
    if faults.is_empty() {
        return Ok(());
    }
    faults.renumber(list, first);
    Err(faults.into_diagnostics(&[source], None))
}

/// Adds the sections of a tree to those of another one.
pub(super) fn add(root: &mut Node, more: Node, faults: &mut Faults) {
    let (Value::Table(entries), Value::Table(added)) = (&mut root.value, more.value) else { return };
    for new in added {
        let form = section(&new.key).map(|section| section.form);
        let Some(old) = entries.iter_mut().find(|entry| entry.key == new.key) else {
            entries.push(new);
            continue;
        };
        match (form, &mut old.node.value, new.node.value) {
            (Some(Form::Repeated), Value::List(items), Value::List(more)) => items.extend(more),
            (Some(Form::Named), Value::Table(named), Value::Table(more)) => {
                for entry in more {
                    if named.iter().any(|known| known.key == entry.key) {
                        let path = format!("{}.{}", new.key, entry.key);
                        let message = format!("the model has `{path}` already");
                        let help = "give it another name, or change the keys of the one that is there by `set`".to_string();
                        faults.beside(&TWICE, &path, Some(entry.place), (message, help));
                    } else {
                        named.push(entry);
                    }
                }
            }
            (Some(Form::Single | Form::Inline), Value::Table(keys), Value::Table(more)) => more.into_iter().for_each(|key| put(keys, key)),
            // Not written as it should be: the reader says so. Keys above all sections are replaced.
            (_, old, new) => *old = new,
        }
    }
}

/// Puts a key with its value into a table, in the place of an older one.
fn put(keys: &mut Vec<Entry>, new: Entry) {
    match keys.iter_mut().find(|key| key.key == new.key) {
        Some(old) => *old = new,
        None => keys.push(new),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn faults(text: &str) -> Vec<(String, String)> {
        let found = check_piece("piece", text, ("part", 7)).err();
        found.map_or(Vec::new(), |found| found.entries.into_iter().map(|it| (it.path, it.message)).collect())
    }

    #[test]
    fn what_a_piece_lacks_may_still_come() {
        assert_eq!(faults("run = { safety = 0.5 }\ntitle = \"x\""), []);
        assert_eq!(faults("[[contact]]\nbetween = [\"a\", \"b\"]"), []);
        // In 2D N/m, axisymmetric and in 3D N.
        for unit in ["N/m", "N"] {
            assert_eq!(faults(&format!("[[load]]\non = \"a\"\nforce = [\"3 {unit}\", 0]")), []);
        }
    }

    #[test]
    fn what_is_wrong_in_any_model_is_reported_with_its_number() {
        let one = |text: &str| {
            let found = faults(text);
            assert_eq!(found.len(), 1, "{found:?}");
            found.into_iter().next().unwrap_or_default()
        };
        let (path, message) =
            one("[[part]]\nname = \"a\"\nmaterial = \"m\"\nbox = { corner = [0, 0, 0], size = [1, 1, 1], elements = [1, 1, 1] }\nnmae = 3");
        assert_eq!(path, "part[7].nmae");
        assert!(message.contains("has no key `nmae`"), "{message}");
        assert_eq!(one("[run]\nend = \"3 kg\"").0, "run.end");
        assert_eq!(one("[[load]]\non = \"a\"\nforce = [\"3 K\", 0]").0, "load[0].force[0]");
        assert!(one("[material.m]\nlaw = \"elastic\"\ndensity = 1\nyoung = 1").1.contains("no `poisson`"));
        assert!(one("[[part]]\nname = \"a\"\nmaterial = \"m\"").1.contains("needs one of"));
        assert!(one("runn = 3").1.contains("has no key `runn`"));
    }
}
