//! A field as writers see it: name, place, components, unit; and the registry of those of a dimension.

use super::Source;
use crate::material::Variable;
use std::sync::LazyLock;

/// Where the values of a field live.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Location {
    /// One value (or tuple) per node.
    Node,
    /// One value (or tuple) per cell.
    Cell,
}

/// What a model must have for a field to say something; without it the field is left out unless it is asked
/// for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Needs {
    /// Nothing.
    Nothing,
    /// A material with this history variable.
    History(&'static Variable),
    /// A contact or an obstacle.
    Contact,
    /// A contact or an obstacle with friction.
    Friction,
    /// A material that fails.
    Failure,
    /// A part of shells.
    Shells,
    /// A part of beams.
    Beams,
    /// Someone who asks for it.
    Asking,
}

/// Description of a field: the same for all its frames.
#[derive(Clone, Copy, Debug)]
pub struct FieldKind {
    /// Name in files, `plastic_strain` for example.
    pub name: &'static str,
    /// Nodes or cells.
    pub location: Location,
    /// Names of the components; empty for a scalar.
    pub components: &'static [&'static str],
    /// SI unit, `Pa` for example; empty for a pure number.
    pub unit: &'static str,
    /// What must be there.
    pub needs: Needs,
    /// One line: what it is.
    pub doc: &'static str,
    /// Where its values come from.
    pub(crate) source: Source,
}

/// Fields of the same name and components, thus of the same dimension, are the same.
impl PartialEq for FieldKind {
    fn eq(&self, other: &Self) -> bool {
        (self.name, self.components) == (other.name, other.components)
    }
}

impl FieldKind {
    /// Values per node or cell.
    #[must_use]
    pub fn width(&self) -> usize {
        self.components.len().max(1)
    }
}

/// Every field that can be written, of 2D models.
pub static FIELDS: LazyLock<Vec<FieldKind>> = LazyLock::new(|| super::kinds(2));
/// The same of 3D models.
pub static FIELDS_IN_SPACE: LazyLock<Vec<FieldKind>> = LazyLock::new(|| super::kinds(3));

/// The fields of a dimension.
#[must_use]
pub fn fields_of(dimension: usize) -> &'static [FieldKind] {
    if dimension == 3 { &FIELDS_IN_SPACE } else { &FIELDS }
}

/// The field of 2D models called `name`.
#[must_use]
pub fn field_kind(name: &str) -> Option<&'static FieldKind> {
    FIELDS.iter().find(|kind| kind.name == name)
}
