//! An arc: the middle of a round shell.

use super::numbers::{cos_sin, quarters};
use super::ring::{FROM, Ring, TO};
use super::{Body, BuiltIn, Count, ELEMENTS, ShapeCheck, Steps, Values, Wrong, chain, chain_count, chain_ends, shape_key};
use crate::mesh::cell::CellKind;
use crate::quantity::Dimension;
use crate::quantity::Range::{Finite, Positive};
use crate::vocabulary::Kind::{Integer, Quantity, Vector};
use crate::vocabulary::Need::{Default as Written, Required};
use crate::vocabulary::{Key, Section, key};

/// An arc, counter-clockwise from `from` to `to`; it closes on itself when they differ by 2π (within 1e-9).
/// Sets of nodes of an open one: `start` and `end`.
#[derive(Clone, Debug, PartialEq)]
pub struct CircularArc {
    /// Centre, m.
    pub centre: [f64; 2],
    /// Radius, m.
    pub radius: f64,
    /// First angle, rad, from +x counter-clockwise.
    pub from: f64,
    /// Last angle, rad, greater than `from` by at most 2π.
    pub to: f64,
    /// Elements along it.
    pub elements: usize,
    /// Length of the last element over that of the first.
    pub grading: f64,
}

impl Default for CircularArc {
    fn default() -> Self {
        Self { centre: [0.0; 2], radius: 1.0, from: 0.0, to: std::f64::consts::TAU, elements: 12, grading: 1.0 }
    }
}

pub(super) const KEY: Key =
    shape_key("arc", &SECTION, "An arc: the middle of a round shell, with `element = \"shell2\"`, and swept with `shell4`.");

static SECTION: Section = Section {
    name: "arc",
    doc: "An arc, counter-clockwise from `from` to `to`, for `element = \"shell2\"` (or `bar2`), or with `extrude` or `revolve` for `shell4`. Unless it is closed, its ends can be named as `start` and `end`; the faces of a `shell2` are `left` (inside) and `right`.",
    keys: &[
        key("centre", Vector(Dimension::LENGTH, Finite), Required, "Centre."),
        key("radius", Quantity(Dimension::LENGTH, Positive), Required, "Radius, to the middle of the shell."),
        FROM,
        TO,
        key(ELEMENTS, Integer(1), Required, "Elements along it."),
        key(
            "grading",
            Quantity(Dimension::NONE, Positive),
            Written("1"),
            "Length of the last element over that of the first; the lengths in between grow by a constant factor.",
        ),
    ],
    ..Section::EMPTY
};

impl CircularArc {
    /// A ring around it.
    fn ring(&self) -> Ring {
        let &Self { centre, radius, from, to, elements, grading } = self;
        Ring { centre, inner: 0.5 * radius, outer: radius, from, to, elements: [1, elements], grading: [1.0, grading] }
    }
}

impl BuiltIn<2> for CircularArc {
    fn read(values: &dyn Values) -> Self {
        Self {
            centre: values.get("centre"),
            radius: values.get("radius"),
            from: values.get("from"),
            to: values.get("to"),
            elements: values.get(ELEMENTS),
            grading: values.get("grading"),
        }
    }

    fn check(&self, check: &mut dyn ShapeCheck) {
        check.vector("centre", self.centre);
        check.number("radius", self.radius);
        check.number("grading", self.grading);
        check.counts(ELEMENTS, &[self.elements]);
        self.ring().check_angles(check);
        if self.ring().is_closed() && self.grading != 1.0 {
            check.fault(
                "grading",
                format!("a closed arc can't be graded, but grading is {}", self.grading),
                "let it be 1, or make two arcs",
            );
        }
    }

    /// Those of shells belong to the part.
    fn sides(&self) -> Vec<String> {
        Vec::new()
    }

    fn points(&self) -> Vec<String> {
        chain_ends(self.ring().is_closed())
    }

    fn count(&self) -> Count {
        chain_count(self.elements, self.ring().is_closed())
    }

    fn cell_kind(&self) -> CellKind {
        CellKind::Line
    }

    fn body(&self) -> Result<Body<2>, Wrong> {
        let closed = self.ring().is_closed();
        let first = quarters(self.from);
        let last = if closed { first + 4.0 } else { quarters(self.to) };
        let steps = Steps::new(self.elements, self.grading);
        Ok(chain(self.elements, closed, |j| {
            let [cos, sin] = cos_sin(steps.between(first, last, j));
            [self.centre[0] + self.radius * cos, self.centre[1] + self.radius * sin]
        }))
    }

    /// None: what the contract tests ask for are areas and outsides.
    #[cfg(test)]
    fn examples(_n: usize) -> Vec<(Self, f64)> {
        Vec::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn arcs_begin_and_end_where_they_say() {
        let quarter = CircularArc { radius: 2.0, from: 0.5 * PI, to: PI, elements: 5, ..CircularArc::default() };
        let body = quarter.body().unwrap();
        assert_eq!((body.positions[0], body.positions[5]), ([0.0, 2.0], [-2.0, 0.0]));
        assert!(body.positions.iter().all(|[x, y]| (x * x + y * y - 4.0).abs() < 1e-14));
        assert_eq!(quarter.points(), ["start", "end"]);
        let circle = CircularArc { elements: 7, ..CircularArc::default() };
        let body = circle.body().unwrap();
        assert_eq!((body.positions.len(), body.all::<2>(CellKind::Line)[6]), (7, [6, 0]));
    }
}
