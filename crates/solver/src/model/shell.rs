//! Sections of shells: `section` of a part.

use super::section;
use crate::quantity::Dimension;
use crate::quantity::Range::{Between, Positive, UpTo};
use crate::vocabulary::Choices;
use crate::vocabulary::Kind::{Angle, Choice, Integer, Quantity};
use crate::vocabulary::Section;

/// Points inside.
pub const GAUSS: &str = "gauss";
/// Points on the faces too.
pub const LOBATTO: &str = "lobatto";

section! {
    /// The section of a shell: its thickness, and the points through it.
    #[derive(Clone, Debug, PartialEq)]
    pub struct ShellSection in SHELL_SECTION = Section {
        name: "section",
        doc: "The section of shells (`shell2`, in 3D `shell4` and `shell3`): thickness, and layers of points through it. Two Gauss points are exact while \
            the material is elastic; odd numbers of them are a little weak in plastic hinges, even ones a little stiff.",
        ..Section::EMPTY
    };
    thickness: f64 = Quantity(Dimension::LENGTH, Positive), Required, "Thickness at the start; it follows the strain.";
    points: usize = Integer(1), Default("5"), "Points through the thickness, 1 to 10 (`lobatto`: 3 to 10); 1 is a membrane without bending.";
    rule: String = Choice(Choices::Words(&[GAUSS, LOBATTO])), Default("\"gauss\""),
        "Where points are: `gauss` inside, `lobatto` with one on each face.";
    failed_points: f64 = Quantity(Dimension::NONE, UpTo(0.0, 1.0)), Default("1"),
        "Part of its points that have to fail until an element fails.";
    fold_angle: f64 = Angle(Dimension::NONE, Between(0.0, std::f64::consts::FRAC_PI_2)), Default("\"30 deg\""),
        "Elements that meet at a smaller angle are a smooth shell there; at a larger one there is a fold.";
}
