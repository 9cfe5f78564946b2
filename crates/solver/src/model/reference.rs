//! What a name in the model means: a part, a side of a part (`part.side`), or a group of a mesh file, as
//! `group` or as `part.group`.
//!
//! Names come from contacts, constraints and probes; the answer goes to [`Model::check`] and to the mesh
//! builder, so that both understand a name in the same way.

use super::{MeshGroup, Model};
use crate::vocabulary::{excerpt, nearest, suggestion};

/// What a name stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reference {
    /// A part, by index.
    Part(usize),
    /// A named side of a part's built-in shape.
    Side {
        /// Index of the part.
        part: usize,
        /// Its place among the shape's sides.
        side: usize,
    },
    /// A group of an imported mesh, where a part is.
    Group {
        /// Index of the first part that shares its nodes.
        part: usize,
        /// Index into [`Model::meshes`].
        mesh: usize,
        /// Index into its groups.
        group: usize,
    },
}

/// What a key wants to name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// Any set of nodes.
    Nodes,
    /// What has a surface: of groups those of lines in a file in 2D, of surfaces in one in 3D.
    Surface,
}

impl Wanted {
    /// Whether a group of a mesh of so many dimensions will do.
    fn is_met_by(self, dimension: usize, group: &MeshGroup) -> bool {
        self == Self::Nodes || usize::from(group.dimension) + 1 == dimension
    }
}

/// Angles (rad) nearer than this to a full turn close a ring.
const FULL_TURN_TOLERANCE: f64 = 1e-9;

/// Whether two angles (rad) are a full turn apart: then a ring closes on itself.
pub(crate) fn is_full_turn(from: f64, to: f64) -> bool {
    (to - from - std::f64::consts::TAU).abs() <= FULL_TURN_TOLERANCE
}

impl Model {
    /// What `name` stands for: first a part, then a group of a mesh file, then `part.side`, then
    /// `part.group`. Only groups of the `wanted` kind count. A group where a part is is that of all parts
    /// that share its nodes.
    ///
    /// # Errors
    /// What is wrong and what to do, as texts.
    pub fn reference(&self, name: &str, wanted: Wanted) -> Result<Reference, (String, String)> {
        if let Some(part) = self.parts.iter().position(|part| part.name == name) {
            return Ok(Reference::Part(part));
        }
        if let Some(found) = self.group(name, wanted, &self.places().collect::<Vec<_>>())? {
            return Ok(found);
        }
        if let Some((part_name, own)) = name.split_once('.')
            && let Some(part) = self.parts.iter().position(|part| part.name == part_name)
        {
            let sides = self.parts[part].sides();
            if let Some(side) = sides.iter().position(|side| side == own) {
                return Ok(Reference::Side { part, side });
            }
            let first = self.first_sharing(part);
            let place: Vec<(usize, usize)> = self.places().filter(|place| place.0 == first).collect();
            if let Some(found) = self.group(own, wanted, &place)? {
                return Ok(found);
            }
            let groups = place.iter().flat_map(|&(_, mesh)| self.groups_of(mesh, wanted)).map(|group| group.name.as_str());
            let known: Vec<&str> = sides.iter().map(String::as_str).chain(groups).collect();
            let what = if place.is_empty() { "side" } else { "side or group" };
            return Err((format!("part `{part_name}` has no {what} `{}`", excerpt(own)), suggestion(own, &known)));
        }
        Err((format!("there is no part, side or group `{}`", excerpt(name)), self.near(name, wanted)))
    }

    /// The groups of a mesh file that are of the wanted kind.
    fn groups_of(&self, mesh: usize, wanted: Wanted) -> impl Iterator<Item = &MeshGroup> {
        let dimension = self.dimension_of_mesh(mesh);
        self.meshes[mesh].groups.iter().filter(move |group| wanted.is_met_by(dimension, group))
    }

    /// The group of a name in one of these places, each a part and its mesh: where it is in several of them
    /// that where all of its nodes are those of elements.
    fn group(&self, name: &str, wanted: Wanted, places: &[(usize, usize)]) -> Result<Option<Reference>, (String, String)> {
        let mut found = Vec::new();
        let mut other = None;
        for &(part, mesh) in places {
            let dimension = self.dimension_of_mesh(mesh);
            for (group, it) in self.meshes[mesh].groups.iter().enumerate().filter(|(_, it)| it.name == name) {
                if wanted.is_met_by(dimension, it) {
                    found.push((part, mesh, group));
                } else {
                    other = Some((it.dimension, if dimension == 3 { "surfaces" } else { "lines" }));
                }
            }
        }
        if found.len() > 1 {
            let whole = |&&(part, mesh, group): &&(usize, usize, usize)| self.has_elements_of(part, &self.meshes[mesh].groups[group]);
            let used: Vec<_> = found.iter().filter(whole).copied().collect();
            found = if used.is_empty() { found } else { used };
        }
        match (found.as_slice(), other) {
            ([], None) => Ok(None),
            ([], Some((dimension, needed))) => Err((
                format!("group `{}` is {}, not {needed}", excerpt(name), dimension_word(dimension)),
                format!("name a part, a side, or a group of {needed}"),
            )),
            (&[(part, mesh, group)], _) => Ok(Some(Reference::Group { part, mesh, group })),
            (several, _) => Err(self.ambiguous(name, several)),
        }
    }

    /// What is wrong with a name that several groups have, each of a part, and what to do.
    fn ambiguous(&self, name: &str, groups: &[(usize, usize, usize)]) -> (String, String) {
        let name = excerpt(name);
        let mut parts: Vec<usize> = groups.iter().map(|&(part, ..)| part).collect();
        parts.dedup();
        if let [part] = parts[..] {
            let message = format!("{} has {} groups `{name}`, of different dimensions", self.meshes[groups[0].1].source, groups.len());
            return (message, format!("give them different names, or name part `{}`", self.parts[part].name));
        }
        let names = |of: &dyn Fn(&str) -> String| {
            let shown: Vec<String> = parts.iter().take(3).map(|&part| of(&self.parts[part].name)).collect();
            shown.join(if parts.len() > 3 { ", " } else { " and " }) + if parts.len() > 3 { ", ..." } else { "" }
        };
        let message = format!("group `{name}` is in {} places, with the parts {}", parts.len(), names(&|part| format!("`{part}`")));
        (message, format!("name the part too: {}", names(&|part| format!("`{part}.{name}`")).replace(" and ", " or ")))
    }

    /// Help for a name that nothing has.
    fn near(&self, name: &str, wanted: Wanted) -> String {
        let mut known: Vec<String> = self.parts.iter().map(|part| part.name.clone()).collect();
        known.extend((0..self.meshes.len()).flat_map(|mesh| self.groups_of(mesh, wanted)).map(|group| group.name.clone()));
        let plain: Vec<&str> = known.iter().map(String::as_str).filter(|name| !name.is_empty()).collect();
        let sides: Vec<String> =
            self.parts.iter().flat_map(|part| part.sides().into_iter().map(move |side| format!("{}.{side}", part.name))).collect();
        if let Some(near) = nearest(name, plain.iter().copied().chain(sides.iter().map(String::as_str))) {
            return format!("did you mean `{near}`?");
        }
        suggestion("", &plain)
    }
}

/// What cells of a dimension are called.
pub(crate) fn dimension_word(dimension: u8) -> &'static str {
    match dimension {
        0 => "a group of points",
        1 => "a group of lines",
        2 => "a group of surfaces",
        _ => "a group of volumes",
    }
}
