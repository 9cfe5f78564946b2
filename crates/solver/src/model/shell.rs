//! Sections of shells: `section` of a part.

use super::{Values, section};
use crate::quantity::Dimension;
use crate::quantity::Range::{Between, Finite, Positive, UpTo};
use crate::vocabulary::Choices;
use crate::vocabulary::Kind::{Angle, Choice, Integer, Quantity, Reference, Spatial, Tables, Text};
use crate::vocabulary::{Rule, Section};

/// Points inside.
pub const GAUSS: &str = "gauss";
/// Points on the faces too.
pub const LOBATTO: &str = "lobatto";

/// The nodes are half way through.
pub const MIDDLE: &str = "middle";
/// The nodes are on the lower face.
pub const LOWER: &str = "lower";
/// The nodes are on the upper face.
pub const UPPER: &str = "upper";

section! {
    /// The section of a shell: its thickness, and the points through it.
    #[derive(Clone, Debug, PartialEq)]
    pub struct ShellSection in SHELL_SECTION = Section {
        name: "section",
        doc: "The section of shells (`shell2`, in 3D `shell4` and `shell3`): thickness, and layers of points through it. Two Gauss points are exact while \
            the material is elastic; odd numbers of them are a little weak in plastic hinges, even ones a little stiff.",
        rules: &[
            Rule::OneOf(&["thickness", "thickness_field", "layers"]),
            Rule::NotBoth("points", "layers"),
            Rule::NotBoth("reference", "offset"),
            Rule::NotBoth("offset", "thickness_growth"),
            Rule::NotBoth("offset", "thickness_field"),
            Rule::NotBoth("thickness_growth", "thickness_field"),
            Rule::Needs("thickness_point", "thickness_growth"),
        ],
        ..Section::EMPTY
    };
    thickness: f64 = Quantity(Dimension::LENGTH, Positive), Optional("that of a field, or the sum of its layers"), "Thickness at the start; it follows the strain.",
        read thickness;
    thickness_field: String = Text, Optional("the same all over"),
        "Name of a view of the part's mesh file that gives the thickness at the start: by node, by element or by node of each element, in the \
            unit of the file; `nodal_thickness` of an Abaqus deck.";
    layers: Vec<ShellLayer> = Tables(&SHELL_LAYER), Optional("one of the part's material"),
        "Layers of different materials or directions, from the lower face (in 2D the right one) to the upper one.";
    points: usize = Integer(1), Default("5"), "Points through the thickness, 1 to 10 (`lobatto`: 3 to 10); 1 is a membrane without bending.";
    rule: String = Choice(Choices::Words(&[GAUSS, LOBATTO])), Default("\"gauss\""),
        "Where points are: `gauss` inside, `lobatto` with one on each face.";
    thickness_growth: [f64; 3] = Spatial(Dimension::NONE, Finite), Default("[0, 0]"),
        "How much the thickness (with it that of each layer) grows along x, y and z, by length.";
    thickness_point: [f64; 3] = Spatial(Dimension::LENGTH, Finite), Default("[0, 0]"),
        "Where the thickness is just `thickness`.";
    reference: String = Choice(Choices::Words(&[MIDDLE, LOWER, UPPER])), Default("\"middle\""),
        "Which surface of the shell its nodes are: its middle, its lower (in 2D right) or its upper (left) face.";
    offset: f64 = Quantity(Dimension::LENGTH, Finite), Optional("as `reference` says"),
        "How far the middle is from the surface of the nodes, to the upper face; half of the thickness at most.",
        read |section| section.or("offset", 0.0);
    failed_points: f64 = Quantity(Dimension::NONE, UpTo(0.0, 1.0)), Default("1"),
        "Part of its points that have to fail until an element fails.";
    fold_angle: f64 = Angle(Dimension::NONE, Between(0.0, std::f64::consts::FRAC_PI_2)), Default("\"30 deg\""),
        "Elements that meet at a smaller angle are a smooth shell there; at a larger one there is a fold.";
}

section! {
    /// A layer of a shell.
    #[derive(Clone, Debug, PartialEq)]
    pub struct ShellLayer in SHELL_LAYER = Section {
        name: "layers",
        doc: "A layer of a shell. Two Gauss points in each are exact while it is elastic, one is as good where there are many layers. \
            Strains are linear through the whole thickness, so a soft core between stiff faces shears too little.",
        ..Section::EMPTY
    };
    material: String = Reference, Optional("that of the part"), "Name of a `[material.NAME]` section.";
    thickness: f64 = Quantity(Dimension::LENGTH, Positive), Required, "Thickness at the start; it follows the strain.";
    angle: f64 = Angle(Dimension::NONE, Finite), Default("0"),
        "Angle from the projection of x on the shell (of z where the shell is normal to x) to the x of the layer, from which the law \
            counts its own `angle`; counter-clockwise seen from above, in 3D alone.";
    points: Option<usize> = Integer(1), Optional("2, with `lobatto` 3"), "Points through the layer, 1 to 10 (`lobatto`: 3 to 10).";
}

/// The thickness of a section, m.
fn thickness(section: &dyn Values) -> f64 {
    let layers = section.list("layers").unwrap_or_default();
    if layers.is_empty() { section.or("thickness", 0.0) } else { layers.into_iter().map(|layer| layer.get::<f64>("thickness")).sum() }
}

impl ShellSection {
    /// Of layers, with the sum of their thicknesses.
    #[must_use]
    pub fn of_layers(layers: Vec<ShellLayer>) -> Self {
        Self { thickness: layers.iter().map(|layer| layer.thickness).sum(), layers, ..Self::default() }
    }

    /// How far the middle is from the surface of the nodes, in thicknesses.
    #[must_use]
    pub fn middle(&self) -> f64 {
        match self.reference.as_str() {
            LOWER => 0.5,
            UPPER => -0.5,
            _ if self.offset == 0.0 => 0.0,
            _ => self.offset / self.thickness,
        }
    }

    /// Its thickness at a place at the start, m.
    #[must_use]
    pub fn thickness_at<const D: usize>(&self, place: [f64; D]) -> f64 {
        if self.thickness_growth == [0.0; 3] {
            return self.thickness;
        }
        (0..D).fold(self.thickness, |sum, k| sum + self.thickness_growth[k] * (place[k] - self.thickness_point[k]))
    }

    /// How far its lower and its upper face are from the surface of the nodes where it is so thick, m.
    #[must_use]
    pub fn faces(&self, thickness: f64) -> [f64; 2] {
        [-1.0, 1.0].map(|side| (0.5 + side * self.middle()) * thickness)
    }

    /// The name of the material of one of its layers, given that of its part.
    #[must_use]
    pub fn material_of<'a>(&self, layer: &'a ShellLayer, of_part: &'a str) -> &'a str {
        if layer.material.is_empty() { of_part } else { &layer.material }
    }

    /// Points through one of its layers.
    #[must_use]
    pub fn points_of(&self, layer: &ShellLayer) -> usize {
        layer.points.unwrap_or(if self.rule == LOBATTO { 3 } else { 2 })
    }
}
