//! A trapezoid with horizontal bottom and top.

use super::{Body, BuiltIn, Count, ELEMENTS, GRADING, ShapeCheck, Steps, Values, Wrong, lattice, shape_key};
use crate::quantity::Dimension;
use crate::quantity::Range::{Finite, Positive};
use crate::vocabulary::Kind::{Integers, Quantity, Vector};
use crate::vocabulary::Need::{Optional, Required};
use crate::vocabulary::{Key, Section, key};

/// A trapezoid with horizontal bottom and top; sides `left`, `right`, `bottom`, `top`.
#[derive(Clone, Debug, PartialEq)]
pub struct Trapezoid {
    /// Lower left corner, m.
    pub corner: [f64; 2],
    /// Width at the bottom, m.
    pub bottom: f64,
    /// Width at the top, m.
    pub top: f64,
    /// Height, m.
    pub height: f64,
    /// How far the upper left corner lies right of the lower left one, m; `None`: symmetric.
    pub shift: Option<f64>,
    /// Elements across and up.
    pub elements: [usize; 2],
    /// Length of the last element over that of the first, across and up.
    pub grading: [f64; 2],
}

pub(super) const KEY: Key = shape_key("trapezoid", &SECTION, "A trapezoid with horizontal bottom and top.");

static SECTION: Section = Section {
    name: "trapezoid",
    doc: "A trapezoid with horizontal bottom and top; its sides are `left`, `right`, `bottom` and `top`.",
    keys: &[
        key("corner", Vector(Dimension::LENGTH, Finite), Required, "Lower left corner."),
        key("bottom", Quantity(Dimension::LENGTH, Positive), Required, "Width at the bottom."),
        key("top", Quantity(Dimension::LENGTH, Positive), Required, "Width at the top."),
        key("height", Quantity(Dimension::LENGTH, Positive), Required, "Height."),
        key(
            "shift",
            Quantity(Dimension::LENGTH, Finite),
            Optional("symmetric"),
            "How far the upper left corner lies to the right of the lower left one.",
        ),
        key(ELEMENTS, Integers(2, 1), Required, "Elements across and up."),
        GRADING,
    ],
    ..Section::EMPTY
};

impl BuiltIn<2> for Trapezoid {
    fn read(values: &dyn Values) -> Self {
        let number = |key| -> f64 { values.get(key) };
        Self {
            corner: values.get("corner"),
            bottom: number("bottom"),
            top: number("top"),
            height: number("height"),
            shift: values.get("shift"),
            elements: values.get(ELEMENTS),
            grading: values.get("grading"),
        }
    }

    fn check(&self, check: &mut dyn ShapeCheck) {
        check.vector("corner", self.corner);
        for (key, value) in [("bottom", self.bottom), ("top", self.top), ("height", self.height)] {
            check.number(key, value);
        }
        if let Some(shift) = self.shift {
            check.number("shift", shift);
        }
        check.counts(ELEMENTS, &self.elements);
        check.vector("grading", self.grading);
    }

    fn sides(&self) -> Vec<String> {
        ["left", "right", "bottom", "top"].map(String::from).into()
    }

    fn count(&self) -> Count {
        Count::of_lattice(self.elements, false)
    }

    fn body(&self) -> Result<Body<2>, Wrong> {
        let shift = self.shift.unwrap_or(0.5 * (self.bottom - self.top));
        let [x, y] = self.corner;
        let [across, up] = [0, 1].map(|d| Steps::new(self.elements[d], self.grading[d]));
        let at = |i, j| {
            let (left, right) = (up.between(x, x + shift, j), up.between(x + self.bottom, x + shift + self.top, j));
            [across.between(left, right, i), up.between(y, y + self.height, j)]
        };
        Ok(lattice(self.elements, false, ["left", "right", "bottom", "top"], at))
    }

    #[cfg(test)]
    fn examples(n: usize) -> Vec<(Self, f64)> {
        let even = Self { corner: [1.0, -2.0], bottom: 3.0, top: 1.0, height: 0.5, shift: None, elements: [n, 2], grading: [1.0; 2] };
        vec![(even.clone(), 1.0), (Self { shift: Some(4.0), grading: [0.3, 2.0], ..even }, 1.0)]
    }
}
