//! A tube along any axis.

use super::axes::Axes;
use super::{Body, BuiltIn, Count, ELEMENTS, Extrude, Ring, ShapeCheck, Sweep, Values, Wrong, shape_key};
use crate::quantity::Dimension;
use crate::quantity::Range::{Finite, Positive};
use crate::vocabulary::Kind::{Angle, Integers, Quantity, Spatial};
use crate::vocabulary::Need::{Default as Written, Required};
use crate::vocabulary::{Key, Section, key};

/// A tube of hexahedra, or a sector of one; sides `inner` and `outer`, of a sector `start` and `end`, and
/// `bottom` and `top` where its axis begins and ends. Angles are counted around the axis by the right-hand
/// rule, from x where the axis is z, from y where it is x, from z where it is y.
#[derive(Clone, Debug, PartialEq)]
pub struct Tube {
    /// Centre of the bottom, m.
    pub centre: [f64; 3],
    /// Direction from the bottom to the top, of any length but zero.
    pub axis: [f64; 3],
    /// Inner radius, m.
    pub inner: f64,
    /// Outer radius, m.
    pub outer: f64,
    /// Length along the axis, m.
    pub length: f64,
    /// Angle at which it begins, rad.
    pub from: f64,
    /// Angle at which it ends, rad.
    pub to: f64,
    /// Elements through the wall, around and along the axis.
    pub elements: [usize; 3],
}

impl Default for Tube {
    fn default() -> Self {
        let (inner, outer, to) = (0.5, 1.0, std::f64::consts::TAU);
        Self { centre: [0.0; 3], axis: [0.0, 0.0, 1.0], inner, outer, length: 1.0, from: 0.0, to, elements: [1, 8, 1] }
    }
}

pub(super) const KEY: Key = shape_key("tube", &SECTION, "A tube, or a sector of one: a solid.");

static SECTION: Section = Section {
    name: "tube",
    doc: "A tube of hexahedra, or a sector of one; its sides are `inner` and `outer`, of a sector also `start` and \
        `end`, and `bottom` and `top` where its axis begins and ends.",
    keys: &[
        key("centre", Spatial(Dimension::LENGTH, Finite), Required, "Centre of the bottom."),
        key("inner", Quantity(Dimension::LENGTH, Positive), Required, "Inner radius."),
        key("outer", Quantity(Dimension::LENGTH, Positive), Required, "Outer radius."),
        key("length", Quantity(Dimension::LENGTH, Positive), Required, "Length along the axis."),
        key(ELEMENTS, Integers(3, 1), Required, "Elements through the wall, around and along the axis."),
        key("axis", Spatial(Dimension::NONE, Finite), Written("[0, 0, 1]"), "Direction from the bottom to the top; any length but zero."),
        key(
            "from",
            Angle(Dimension::NONE, Finite),
            Written("0"),
            "Angle at which it begins, around the axis by the right-hand rule: from x where the axis is z, from y \
                where it is x, from z where it is y.",
        ),
        key(
            "to",
            Angle(Dimension::NONE, Finite),
            Written("\"360 deg\""),
            "Angle at which it ends: more than `from`, by at most a full turn.",
        ),
    ],
    ..Section::EMPTY
};

impl BuiltIn<3> for Tube {
    fn read(values: &dyn Values) -> Self {
        let number = |key| -> f64 { values.get(key) };
        Self {
            centre: values.get("centre"),
            axis: values.get("axis"),
            inner: number("inner"),
            outer: number("outer"),
            length: number("length"),
            from: number("from"),
            to: number("to"),
            elements: values.get(ELEMENTS),
        }
    }

    fn check(&self, check: &mut dyn ShapeCheck) {
        check.vector("centre", self.centre);
        check.direction("axis", self.axis);
        check.number("length", self.length);
        check.counts(ELEMENTS, &self.elements);
        self.section().check_radii(check);
    }

    fn sides(&self) -> Vec<String> {
        self.section().sides().into_iter().chain(["bottom", "top"].map(String::from)).collect()
    }

    fn count(&self) -> Count {
        self.sweep().count(self.section().count())
    }

    fn body(&self) -> Result<Body<3>, Wrong> {
        let mut body = self.sweep().swept(&self.section().body()?)?;
        Axes::along(self.axis).put(&mut body, self.centre);
        body.name_ends(["bottom", "top"]);
        Ok(body)
    }

    #[cfg(test)]
    fn examples(n: usize) -> Vec<(Self, f64)> {
        let pi = std::f64::consts::PI;
        let tube = Self { centre: [0.3, -0.1, 0.2], elements: [2, 4 * n, 3], length: 1.5, ..Self::default() };
        let sector = Self { from: 0.3, to: 1.1, axis: [1.0, 2.0, -0.5], elements: [2, n, 2], ..tube.clone() };
        vec![(tube, 0.75 * pi * 1.5), (sector, 0.5 * 0.8 * 0.75 * 1.5)]
    }
}

impl Tube {
    fn section(&self) -> Ring {
        let Self { inner, outer, from, to, elements: [through, around, _], .. } = *self;
        Ring { inner, outer, from, to, elements: [through, around], ..Ring::default() }
    }

    fn sweep(&self) -> Sweep {
        Sweep::Extrude(Extrude { length: self.length, elements: self.elements[2], ..Extrude::default() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tube_along_x_begins_at_y() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let tube = Tube { axis: [2.0, 0.0, 0.0], to: quarter, elements: [2, 6, 3], length: 4.0, ..Tube::default() };
        let body = tube.body().unwrap();
        let all = |name: &str, holds: &dyn Fn([f64; 3]) -> bool| {
            let side = &body.sides.iter().find(|side| side.0 == name).unwrap().1;
            assert!(!side.is_empty() && side.iter().flatten().all(|&node| holds(body.positions[node as usize])), "{name}");
        };
        all("bottom", &|x| x[0] == 0.0);
        all("top", &|x| x[0] == 4.0);
        all("start", &|x| x[2] == 0.0 && x[1] > 0.0);
        all("end", &|x| x[1] == 0.0 && x[2] > 0.0);
        all("inner", &|x| (x[1].hypot(x[2]) - 0.5).abs() < 1e-15);
    }
}
