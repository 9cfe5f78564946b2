//! What a name in the model means: a part, a side of a part (`part.side`), or a group of a mesh file.
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
    /// A group of an imported mesh.
    Group {
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
    /// What `name` stands for: first a part, then a group of a mesh file, then `part.side`. Only groups of
    /// the `wanted` kind count.
    ///
    /// # Errors
    /// What is wrong and what to do, as texts.
    pub fn reference(&self, name: &str, wanted: Wanted) -> Result<Reference, (String, String)> {
        if let Some(part) = self.parts.iter().position(|part| part.name == name) {
            return Ok(Reference::Part(part));
        }
        if let Some(found) = self.group(name, wanted)? {
            return Ok(found);
        }
        if let Some((part_name, side_name)) = name.split_once('.')
            && let Some(part) = self.parts.iter().position(|part| part.name == part_name)
        {
            let sides = self.parts[part].sides();
            if let Some(side) = sides.iter().position(|side| side == side_name) {
                return Ok(Reference::Side { part, side });
            }
            let sides: Vec<&str> = sides.iter().map(String::as_str).collect();
            let help = match &sides[..] {
                [] => "a part of a mesh file has no named sides: name a line group of the file".to_string(),
                sides => suggestion(side_name, sides),
            };
            return Err((format!("part `{part_name}` has no side `{}`", excerpt(side_name)), help));
        }
        Err((format!("there is no part, side or group `{}`", excerpt(name)), self.near(name, wanted)))
    }

    fn group(&self, name: &str, wanted: Wanted) -> Result<Option<Reference>, (String, String)> {
        let mut found = Vec::new();
        let mut other = None;
        for (mesh, imported) in self.meshes.iter().enumerate() {
            let dimension = self.dimension_of_mesh(mesh);
            for (group, it) in imported.groups.iter().enumerate().filter(|(_, it)| it.name == name) {
                if wanted.is_met_by(dimension, it) {
                    found.push((mesh, group));
                } else {
                    other = Some((it.dimension, if dimension == 3 { "surfaces" } else { "lines" }));
                }
            }
        }
        match (found.as_slice(), other) {
            ([], None) => Ok(None),
            ([], Some((dimension, needed))) => Err((
                format!("group `{}` is {}, not {needed}", excerpt(name), dimension_word(dimension)),
                format!("name a part, a side, or a group of {needed}"),
            )),
            ([(mesh, group)], _) => Ok(Some(Reference::Group { mesh: *mesh, group: *group })),
            (several, _) => Err((
                format!("group `{}` is in {} meshes", excerpt(name), several.len()),
                "give the groups different names, so that it is clear which one is meant".to_string(),
            )),
        }
    }

    /// Help for a name that nothing has.
    fn near(&self, name: &str, wanted: Wanted) -> String {
        let mut known: Vec<String> = self.parts.iter().map(|part| part.name.clone()).collect();
        for (mesh, imported) in self.meshes.iter().enumerate() {
            let dimension = self.dimension_of_mesh(mesh);
            known.extend(imported.groups.iter().filter(|group| wanted.is_met_by(dimension, group)).map(|group| group.name.clone()));
        }
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
