//! Where the body of a part goes: mirrored, turned, moved, copied. The mesh builder does it.

use super::{Values, section};
use crate::quantity::Dimension;
use crate::quantity::Range::Finite;
use crate::vocabulary::Kind::{Angle, Integer, Spatial};
use crate::vocabulary::Need::{Default as Written, Required};
use crate::vocabulary::{Rule, Section, key};

/// Where the body of a shape or of a group of a mesh file goes: it is mirrored, then turned, then moved, then
/// copied.
#[derive(Clone, Debug, PartialEq)]
pub struct Placement {
    /// A line, in 3D a plane, that it is mirrored on.
    pub mirror: Option<Mirror>,
    /// Angle by which it is turned, rad, counter-clockwise (in 3D by the right-hand rule about the axis).
    pub rotation: f64,
    /// Point about which it is turned, in 3D one of the axis, m.
    pub rotation_point: [f64; 3],
    /// Direction of the axis about which it is turned, of any length but zero; z in 2D.
    pub rotation_axis: [f64; 3],
    /// How far it is moved, m.
    pub translation: [f64; 3],
    /// How often it is there.
    pub copies: Option<Copies>,
}

/// The direction that turns in 2D are about.
pub(crate) const ALONG_Z: [f64; 3] = [0.0, 0.0, 1.0];

impl Default for Placement {
    fn default() -> Self {
        Self { mirror: None, rotation: 0.0, rotation_point: [0.0; 3], rotation_axis: ALONG_Z, translation: [0.0; 3], copies: None }
    }
}

impl Placement {
    /// From the table of a part or of a file of triangles.
    #[must_use]
    pub fn read(values: &dyn Values) -> Self {
        let mut placement =
            Self { mirror: values.get("mirror"), translation: values.get("translation"), copies: values.get("copies"), ..Self::default() };
        if let Some(turn) = values.table("rotation") {
            placement.rotation = turn.get("angle");
            placement.rotation_point = turn.get("point");
            placement.rotation_axis = turn.get("axis");
        }
        placement
    }

    /// How many bodies there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.copies.map_or(1, |copies| copies.count)
    }
}

pub(crate) static ROTATION: Section = Section {
    name: "rotation",
    doc: "The shape or mesh is turned about a point, in 3D about an axis.",
    keys: &[
        key("angle", Angle(Dimension::NONE, Finite), Required, "Angle, counter-clockwise; about an axis by the right-hand rule."),
        key("point", Spatial(Dimension::LENGTH, Finite), Written("[0, 0]"), "The point; in 3D one of the axis."),
        key("axis", Spatial(Dimension::NONE, Finite), Written("[0, 0, 1]"), "Direction of the axis, of a solid; any length but zero."),
    ],
    ..Section::EMPTY
};

section! {
    /// A line, in 3D a plane, to mirror on.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Mirror in MIRROR = Section {
        name: "mirror",
        doc: "The shape or mesh is mirrored on a line, in 3D on a plane. Its sides keep their names; what was above a shell, or on its left, still is.",
        ..Section::EMPTY
    };
    normal: [f64; 3] = Spatial(Dimension::NONE, Finite), Required,
        "Normal of the line or plane; any length but zero.";
    point: [f64; 3] = Spatial(Dimension::LENGTH, Finite), Default("[0, 0]"), "A point of the line or plane.";
}

section! {
    /// Bodies of one part that follow each other: each is turned and then moved as often as there are others
    /// before it.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Copies in COPIES = Section {
        name: "copies",
        doc: "The part consists of several bodies of one shape or mesh, each turned and moved from the one before. Sides and groups are those of all of them.",
        rules: &[Rule::SomeOf(&["translation", "angle"])],
        ..Section::EMPTY
    };
    count: usize = Integer(1), Required, "Number of bodies in all.";
    translation: [f64; 3] = Spatial(Dimension::LENGTH, Finite), Default("[0, 0]"), "How far each is moved.";
    angle: f64 = Angle(Dimension::NONE, Finite), Default("0"), "Angle by which each is turned, counter-clockwise.";
    point: [f64; 3] = Spatial(Dimension::LENGTH, Finite), Default("[0, 0]"),
        "Point about which they are turned; in 3D one of the axis.";
    axis: [f64; 3] = Spatial(Dimension::NONE, Finite), Default("[0, 0, 1]"),
        "Direction of the axis about which they are turned, of solids; any length but zero.";
}
