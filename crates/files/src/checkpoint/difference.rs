//! What a model is, line by line: to say whether it is still the one that ran, and what has changed.
//!
//! Lines come from the model's own structure (`parts[0].velocity[1] = 3.0`), so a new key is seen without
//! anything being reported here. Meshes count by their size and a check sum. A run that continues may end at
//! another time, have other limits, checkpoints and output; all else must be the same, else its bits would
//! mean nothing.

use embate_solver::hash::Fnv;
use embate_solver::model::{FieldValues, ImportedMesh, Model};
use flate2::Crc;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::sync::Arc;

/// What may differ between a run and one that continues with it.
const FREE: &[&str] = &[
    "name",
    "title",
    "run.end",
    "run.energy_limit",
    "run.step_limit",
    "run.velocity_limit",
    "run.penetration_limit",
    "run.memory_limit",
    "run.max_steps",
    "run.checkpoint",
    "run.checkpoint_steps",
    "output.",
];
/// Names of lists as the model file has them.
const NAMES: &[(&str, &str)] = &[
    ("materials.", "material."),
    ("parts[", "part["),
    ("stages[", "stage["),
    ("remeshes[", "remesh["),
    ("relocations[", "relocate["),
    ("flows[", "flow["),
    ("load_terms[", "load["),
    ("contacts[", "contact["),
    ("obstacles[", "obstacle["),
    ("curves.", "curve."),
    ("symmetries[", "symmetry["),
    ("constraints[", "constraint["),
    ("loads[", "load["),
    ("cavities[", "cavity["),
    ("joins[", "join["),
    ("welds[", "weld["),
    ("joints[", "joint["),
    ("springs[", "spring["),
    ("point_masses[", "point_mass["),
    ("probes[", "probe["),
];
/// At most so many differences are reported one by one.
const REPORTED_MAX: usize = 20;

/// What a model is, key by key.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Identity {
    lines: BTreeMap<String, String>,
}

impl Identity {
    /// Of a model.
    #[must_use]
    pub fn of(model: &Model) -> Self {
        let mut model = model.clone();
        let meshes = std::mem::take(&mut model.meshes);
        let mut lines = flattened(&format!("{model:#?}"));
        lines.extend(meshes.iter().zip(0..).map(|(mesh, index): (&Arc<ImportedMesh>, usize)| (format!("mesh[{index}]"), summed(mesh))));
        Self { lines }
    }

    /// Keys with their values, in the order of the alphabet.
    pub fn keys(&self) -> impl Iterator<Item = (&str, &str)> {
        self.lines.iter().map(|(key, value)| (key.as_str(), value.as_str()))
    }

    /// One line for each key.
    pub(super) fn text(&self) -> String {
        self.lines.iter().fold(String::new(), |mut text, (key, value)| {
            // Writing to a string can't fail.
            let _ = writeln!(text, "{key} = {value}");
            text
        })
    }

    pub(super) fn of_text(text: &str) -> Self {
        let line = |line: &str| line.split_once(" = ").map(|(key, value)| (key.to_string(), value.to_string()));
        Self { lines: text.lines().filter_map(line).collect() }
    }

    /// Digest of all that must be the same (64 bit FNV-1a); hexadecimal.
    pub(super) fn digest(&self) -> String {
        let fixed = self.lines.iter().filter(|(key, _)| !is_free(key));
        let mut hash = Fnv::default();
        for piece in fixed.flat_map(|(key, value)| [key, " = ", value, "\n"]) {
            hash.add(piece.as_bytes());
        }
        hash.to_string()
    }

    /// What of `self` is not as `before`, of all that must be the same if a run is to continue: a line for
    /// each key.
    #[must_use]
    pub fn differences(&self, before: &Self) -> Vec<String> {
        self.differing(before, |key| !is_free(key))
    }

    /// The same of what must be the same if a run is to be repeated: its last steps lead up to its end.
    #[must_use]
    pub fn differences_in_steps(&self, before: &Self) -> Vec<String> {
        self.differing(before, |key| !is_free(key) || key == "run.end")
    }

    /// What of two models is not the same: a line for each key that acts on the steps, and one for each of
    /// the others.
    #[must_use]
    pub fn apart(&self, other: &Self) -> [Vec<String>; 2] {
        let side = |value: Option<&String>| value.map_or("has no such key".to_string(), |value| format!("has {value}"));
        let line = |key: &str, [a, b]: [Option<&String>; 2]| format!("{key}: A {}, B {}", side(a), side(b));
        let acts = |key: &str| !is_free(key) || key == "run.end";
        // Files and folders may be called as they like.
        [self.telling(other, acts, line), self.telling(other, |key| !acts(key) && key != "name", line)]
    }

    fn differing(&self, before: &Self, counts: impl Fn(&str) -> bool) -> Vec<String> {
        before.telling(self, counts, |key, values| match values {
            [Some(old), Some(new)] => format!("{key}: was {old}, is {new}"),
            [Some(old), None] => format!("{key}: was {old}, is gone"),
            [None, new] => format!("{key}: is new, {}", new.map_or("", String::as_str)),
        })
    }

    /// A line for each key that counts and does not have the same value in both.
    fn telling(&self, other: &Self, counts: impl Fn(&str) -> bool, line: impl Fn(&str, [Option<&String>; 2]) -> String) -> Vec<String> {
        let keys: BTreeSet<&String> = self.lines.keys().chain(other.lines.keys()).collect();
        let values = |key: &String| [self.lines.get(key), other.lines.get(key)];
        let keys = keys.into_iter().filter(|key| counts(key) && values(key)[0] != values(key)[1]);
        let mut reported: Vec<String> = keys.map(|key| line(key, values(key))).collect();
        if reported.len() > REPORTED_MAX {
            let more = reported.len() - REPORTED_MAX;
            reported.truncate(REPORTED_MAX);
            reported.push(format!("and {more} more"));
        }
        reported
    }
}

fn is_free(key: &str) -> bool {
    let is = |free: &&&str| match key.strip_prefix(**free) {
        Some(rest) => free.ends_with('.') || rest.is_empty() || rest.starts_with(['.', '[']),
        None => false,
    };
    // Where the values of a material come from does not act.
    let is_origin = key.starts_with("material.") && key.ends_with(".from");
    is_origin || FREE.iter().any(|free| is(&free))
}

/// A mesh by its size and the bits of its numbers.
fn summed(mesh: &ImportedMesh) -> String {
    let mut crc = Crc::new();
    mesh.positions.iter().flatten().for_each(|x| crc.update(&x.to_le_bytes()));
    for group in &mesh.groups {
        crc.update(group.name.as_bytes());
        crc.update(&[group.dimension]);
        group.cells.iter().for_each(|cell| {
            crc.update(&(cell.len() as u32).to_le_bytes());
            cell.iter().for_each(|node| crc.update(&node.to_le_bytes()));
        });
    }
    for field in &mesh.fields {
        crc.update(field.name.as_bytes());
        let mut add = |value: f64| crc.update(&value.to_le_bytes());
        match &field.values {
            FieldValues::Nodes(values) => values.iter().for_each(|value| add(value.unwrap_or(f64::NAN))),
            FieldValues::Corners(groups) => groups.iter().flatten().flatten().for_each(|value| add(*value)),
        }
    }
    let cells: usize = mesh.groups.iter().map(|group| group.cells.len()).sum();
    format!("{} nodes and {cells} cells, check sum {:08x}", mesh.positions.len(), crc.sum())
}

/// Keys and values of a structure as the compiler shows it, one value a line. What has no name in a list is
/// numbered.
fn flattened(shown: &str) -> BTreeMap<String, String> {
    let mut lines = BTreeMap::new();
    // Path so far, how many nameless items it has had, and whether the first of them stands for the whole:
    // what an option or a variant holds.
    let mut stack: Vec<(String, usize, bool)> = Vec::new();
    for line in shown.lines().map(str::trim) {
        if matches!(line.trim_end_matches(','), "}" | "]" | ")") {
            stack.pop();
            continue;
        }
        let (key, value) = match line.split_once(": ") {
            Some((key, value)) if is_key(key) => (Some(key.trim_matches('"')), value),
            _ => (None, line),
        };
        let opens = value.strip_suffix(['{', '[', '(']).map(str::trim);
        let path = match (stack.last_mut(), key) {
            (None, _) => String::new(),
            (Some((path, ..)), Some(key)) if path.is_empty() => key.to_string(),
            (Some((path, ..)), Some(key)) => format!("{path}.{key}"),
            (Some((path, count, holds)), None) => {
                *count += 1;
                if *holds && *count == 1 { path.clone() } else { format!("{path}[{}]", *count - 1) }
            }
        };
        match opens {
            Some(name) => {
                let holds = value.ends_with('(') && !name.is_empty();
                if !name.is_empty() && name != "Some" && !path.is_empty() {
                    lines.insert(format!("{}.kind", named(&path)), name.to_string());
                }
                stack.push((path, 0, holds));
            }
            None => {
                lines.insert(named(&path), value.trim_end_matches(',').to_string());
            }
        }
    }
    lines
}

/// Names of fields are plain, those of maps stand in quotes.
fn is_key(key: &str) -> bool {
    let is_plain = key.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
    is_plain || (key.len() > 1 && key.starts_with('"') && key.ends_with('"') && !key[1..key.len() - 1].contains('"'))
}

/// A path with the names of the model file.
fn named(path: &str) -> String {
    let found = NAMES.iter().find_map(|(own, name)| path.strip_prefix(own).map(|rest| format!("{name}{rest}")));
    found.unwrap_or_else(|| path.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use embate_solver::model::{Material, Part, Rectangle, Shape};

    fn model() -> Model {
        let mut model = Model::default();
        model.run.end = 1.0;
        let parameters = [("young".to_string(), 1e9)].into();
        model.materials.insert("steel".into(), Material { law: "elastic".into(), parameters, ..Material::default() });
        let shape = Shape::Rectangle(Rectangle { size: [1.0, 2.0], elements: [3, 4], ..Rectangle::default() });
        model.parts.push(Part { name: "a: b = {".into(), shape, velocity: [1.0, -2.0, 0.0], ..Part::default() });
        model
    }

    #[test]
    fn a_change_is_reported_by_its_key_with_both_values() {
        let before = Identity::of(&model());
        let reported = |change: fn(&mut Model)| {
            let mut model = model();
            change(&mut model);
            let after = Identity::of(&model);
            assert_eq!(after.digest() == before.digest(), after.differences(&before).is_empty());
            after.differences(&before)
        };
        assert_eq!(reported(|_| {}), [] as [String; 0]);
        assert_eq!(reported(|model| model.run.safety = 0.5), ["run.safety: was 0.9, is 0.5"]);
        assert_eq!(reported(|model| model.parts[0].velocity[1] = 3.0), ["part[0].velocity[1]: was -2.0, is 3.0"]);
        let soft = |model: &mut Model| {
            if let Some(steel) = model.materials.get_mut("steel") {
                steel.parameters.insert("young".into(), 1e8);
            }
        };
        assert_eq!(reported(soft), ["material.steel.parameters.young: was 1000000000.0, is 100000000.0"]);
        let finer = reported(|model| {
            if let Shape::Rectangle(shape) = &mut model.parts[0].shape {
                shape.elements = [3, 5];
            }
        });
        assert!(finer.len() == 1 && finer[0].contains("elements[1]: was 4, is 5"), "{finer:?}");
        assert!(!reported(|model| model.parts.push(Part::default())).is_empty());
        assert!(!reported(|model| model.run.time_step = Some(1e-6)).is_empty());
    }

    #[test]
    fn end_limits_and_output_may_change() {
        let before = Identity::of(&model());
        let mut model = model();
        (model.run.end, model.run.energy_limit, model.run.max_steps, model.run.step_limit) = (2.0, 0.1, Some(7), Some(1e-9));
        (model.run.checkpoint, model.run.checkpoint_steps) = (Some(60.0), Some(100));
        (model.title, model.output.pictures, model.output.picture_field) = ("other".into(), false, "damage".into());
        let after = Identity::of(&model);
        assert_eq!(after.differences(&before), [] as [String; 0]);
        assert_eq!(after.digest(), before.digest());
    }

    #[test]
    fn a_mesh_counts_by_its_numbers_and_text_reads_back() {
        let with = |x: f64| {
            let mut model = model();
            model.meshes.push(Arc::new(ImportedMesh {
                source: "a.msh".into(),
                positions: vec![[x, 0.0, 0.0]],
                groups: vec![],
                ..ImportedMesh::default()
            }));
            Identity::of(&model)
        };
        assert_eq!(with(1.0), with(1.0));
        assert_eq!(with(1.0).differences(&with(2.0)).len(), 1);
        assert_eq!(Identity::of_text(&with(1.0).text()), with(1.0));
    }
}
