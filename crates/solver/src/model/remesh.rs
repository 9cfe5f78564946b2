//! Parts whose elements are made again in the run: `[[remesh]]`.

use super::section;
use crate::quantity::Dimension;
use crate::quantity::Range::{NotNegative, Positive, UpTo};
use crate::vocabulary::Kind::{Integer, Quantity, Reference};
use crate::vocabulary::{Form, Section};

section! {
    /// `[[remesh]]`: when elements of a part are made again, and how large.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Remesh in REMESH = Section {
        name: "remesh",
        doc: "A part of a 2D model whose elements are made again as quadrilaterals inside its outline when their form has become poor, or \
            their stable step short. Stress, plastic strain and velocities go over to the new elements: mass, momentum and angular \
            momentum exactly, energy but for a loss that the history has as `energy.remap`. Where no better mesh is found the run \
            continues with the old one, and a warning says so.",
        form: Form::Repeated,
        ..Section::EMPTY
    };
    part: String = Reference, Required, "Name of the part.";
    size: Option<f64> = Quantity(Dimension::LENGTH, Positive), Optional("as many elements as at the start"),
        "Edge length of the new elements.";
    quality: f64 = Quantity(Dimension::NONE, UpTo(0.0, 1.0)), Default("0.3"),
        "Least scaled Jacobian of an element (1: a rectangle, 0: an angle of 180 degrees) below which elements are made again.";
    time_step: f64 = Quantity(Dimension::NONE, UpTo(0.0, 1.0)), Default("0.3"),
        "Stable step of the part, as a fraction of that after its elements were made, below which they are made again.";
    interval: Option<f64> = Quantity(Dimension::TIME, Positive), Optional("only when it is needed"),
        "Longest time between two times that elements are made.";
    begin: f64 = Quantity(Dimension::TIME, NotNegative), Default("0"), "Time before which nothing is made again.";
    elements_most: Option<u64> = Integer(1), Optional("four times as many as at the start"),
        "Most elements: where `size` would give more, they are larger.";
    loss_limit: f64 = Quantity(Dimension::NONE, Positive), Default("0.05"),
        "Energy that may be lost in all by making elements again, as a fraction of the largest total energy: beyond it the run ends.";
}
