//! An axis-parallel rectangle.

use super::{Body, BuiltIn, Count, ELEMENTS, GRADING, ShapeCheck, Steps, Values, Wrong, lattice, shape_key};
use crate::quantity::Dimension;
use crate::quantity::Range::{Finite, Positive};
use crate::vocabulary::Kind::{Integers, Vector};
use crate::vocabulary::Need::Required;
use crate::vocabulary::{Key, Section, key};

/// An axis-parallel rectangle of quadrilaterals; sides `left`, `right`, `bottom`, `top`.
#[derive(Clone, Debug, PartialEq)]
pub struct Rectangle {
    /// Lower left corner, m.
    pub corner: [f64; 2],
    /// Width and height, m.
    pub size: [f64; 2],
    /// Elements along x and y.
    pub elements: [usize; 2],
    /// Length of the last element over that of the first, along x and y.
    pub grading: [f64; 2],
}

impl Default for Rectangle {
    fn default() -> Self {
        Self { corner: [0.0; 2], size: [1.0; 2], elements: [1; 2], grading: [1.0; 2] }
    }
}

pub(super) const KEY: Key = shape_key("rectangle", &SECTION, "An axis-parallel rectangle.");

static SECTION: Section = Section {
    name: "rectangle",
    doc: "An axis-parallel rectangle; its sides are `left`, `right`, `bottom` and `top`.",
    keys: &[
        key("corner", Vector(Dimension::LENGTH, Finite), Required, "Lower left corner."),
        key("size", Vector(Dimension::LENGTH, Positive), Required, "Width and height."),
        key(ELEMENTS, Integers(2, 1), Required, "Elements along x and along y."),
        GRADING,
    ],
    ..Section::EMPTY
};

impl BuiltIn<2> for Rectangle {
    fn read(values: &dyn Values) -> Self {
        let vector = |key| -> [f64; 2] { values.get(key) };
        Self { corner: vector("corner"), size: vector("size"), elements: values.get(ELEMENTS), grading: vector("grading") }
    }

    fn check(&self, check: &mut dyn ShapeCheck) {
        check.vector("corner", self.corner);
        check.vector("size", self.size);
        check.counts(ELEMENTS, &self.elements);
        check.vector("grading", self.grading);
    }

    fn sides(&self) -> Vec<String> {
        ["left", "right", "bottom", "top"].map(String::from).into()
    }

    fn count(&self) -> Count {
        Count::of_lattice(self.elements, false)
    }

    /// Nodes run along x first.
    fn body(&self) -> Result<Body<2>, Wrong> {
        let ([x, y], [width, height]) = (self.corner, self.size);
        let [along, up] = [0, 1].map(|d| Steps::new(self.elements[d], self.grading[d]));
        let at = |i, j| [along.between(x, x + width, i), up.between(y, y + height, j)];
        Ok(lattice(self.elements, false, ["left", "right", "bottom", "top"], at))
    }

    #[cfg(test)]
    fn examples(n: usize) -> Vec<(Self, f64)> {
        let even = Self { corner: [-1.0, 2.0], size: [3.0, 0.25], elements: [n, 3], ..Self::default() };
        vec![(even.clone(), 0.75), (Self { grading: [5.0, 0.5], ..even }, 0.75)]
    }
}
