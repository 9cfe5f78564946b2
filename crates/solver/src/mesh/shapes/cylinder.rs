//! A full cylinder along any axis, or a part of one, without degenerate elements.

use super::axes::Axes;
use super::{Body, BuiltIn, Count, Disk, ELEMENTS, Extrude, ShapeCheck, Skin, Sweep, Values, Wrong, cut, shape_key};
use crate::quantity::Dimension;
use crate::quantity::Range::{Finite, Positive};
use crate::vocabulary::Kind::{Angle, Integers, Quantity, Spatial};
use crate::vocabulary::Need::{Default as Written, Required};
use crate::vocabulary::{Key, Section, key};

/// A cylinder of hexahedra, or one, two or three quarters of one: the section is that of a [`Disk`]. Sides
/// `outer`, of a part of one `start` and `end`, and `bottom` and `top` where its axis begins and ends. Angles
/// are counted as those of a [`super::Tube`].
#[derive(Clone, Debug, PartialEq)]
pub struct Cylinder {
    /// Centre of the bottom, m.
    pub centre: [f64; 3],
    /// Direction from the bottom to the top, of any length but zero.
    pub axis: [f64; 3],
    /// Radius, m.
    pub radius: f64,
    /// Length along the axis, m.
    pub length: f64,
    /// Angle from the side `start` to the side `end`: 90, 180, 270 or 360 degrees, rad.
    pub angle: f64,
    /// Elements around a quarter of the circumference (even for a part of a cylinder) and along the axis.
    pub elements: [usize; 2],
    /// Length of the last element along the axis over that of the first.
    pub grading: f64,
}

impl Default for Cylinder {
    fn default() -> Self {
        let (axis, angle) = ([0.0, 0.0, 1.0], std::f64::consts::TAU);
        Self { centre: [0.0; 3], axis, radius: 1.0, length: 1.0, angle, elements: [2, 1], grading: 1.0 }
    }
}

pub(super) const KEY: Key = shape_key("cylinder", &SECTION, "A full cylinder, or quarters of one: a solid.");

static SECTION: Section = Section {
    name: "cylinder",
    doc: "A full cylinder of hexahedra, or one, two or three quarters of one; its sides are `outer`, of a part of \
        one also `start` and `end`, and `bottom` and `top` where its axis begins and ends. With `shell4` the shell of \
        its side `outer`, without lids.",
    keys: &[
        key("centre", Spatial(Dimension::LENGTH, Finite), Required, "Centre of the bottom."),
        key("radius", Quantity(Dimension::LENGTH, Positive), Required, "Radius."),
        key("length", Quantity(Dimension::LENGTH, Positive), Required, "Length along the axis."),
        key(
            ELEMENTS,
            Integers(2, 1),
            Required,
            "Elements around a quarter of the circumference (an even number for a part of a cylinder), and along the axis.",
        ),
        key("axis", Spatial(Dimension::NONE, Finite), Written("[0, 0, 1]"), "Direction from the bottom to the top; any length but zero."),
        key(
            "angle",
            Angle(Dimension::NONE, Positive),
            Written("\"360 deg\""),
            "90, 180, 270 or 360 degrees around the axis by the right-hand rule: from x where the axis is z, from y \
                where it is x, from z where it is y.",
        ),
        key(
            "grading",
            Quantity(Dimension::NONE, Positive),
            Written("1"),
            "Length of the last element along the axis over that of the first.",
        ),
    ],
    ..Section::EMPTY
};

impl BuiltIn<3> for Cylinder {
    fn read(values: &dyn Values) -> Self {
        let number = |key| -> f64 { values.get(key) };
        Self {
            centre: values.get("centre"),
            axis: values.get("axis"),
            radius: number("radius"),
            length: number("length"),
            angle: number("angle"),
            elements: values.get(ELEMENTS),
            grading: number("grading"),
        }
    }

    fn check(&self, check: &mut dyn ShapeCheck) {
        check.vector("centre", self.centre);
        check.direction("axis", self.axis);
        for (key, value) in [("radius", self.radius), ("length", self.length), ("angle", self.angle), ("grading", self.grading)] {
            check.number(key, value);
        }
        check.counts(ELEMENTS, &self.elements);
        match self.quarters() {
            None => {
                let degrees = (self.angle.to_degrees() * 1e9).round() / 1e9;
                check.fault("angle", format!("the angle is {degrees} deg"), "give 90, 180, 270 or 360 degrees, or take a tube");
            }
            Some(1..=3) if self.elements[0] % 2 == 1 => {
                let message = format!("a part of a cylinder can't have {} elements around a quarter", self.elements[0]);
                check.fault(ELEMENTS, message, "give an even number: the cut goes through the middle of the core");
            }
            Some(_) => {}
        }
    }

    fn sides(&self) -> Vec<String> {
        let cuts = if self.quarters() == Some(4) { &[][..] } else { &["start", "end"] };
        ["outer"].iter().chain(cuts).chain(&["bottom", "top"]).map(|&name| name.to_string()).collect()
    }

    fn count(&self) -> Count {
        let whole = self.section().count();
        let quarters = self.quarters().unwrap_or(4);
        let n = self.elements[0];
        // Nodes on the cuts: two lines from the axis outwards.
        let layers = self.section().layers();
        let line = (n / 2).saturating_add(layers);
        let section = match quarters {
            4 => whole,
            part => {
                let inside = (whole.nodes.saturating_sub(1)) / 4 * part;
                Count { nodes: inside.saturating_add(line).saturating_add(1), elements: whole.elements / 4 * part, ..whole }
            }
        };
        self.sweep().count(section)
    }

    fn skin(&self) -> Option<Skin> {
        let quarters = self.quarters().unwrap_or(4);
        let around = self.elements[0].saturating_mul(quarters);
        let rim = Count { nodes: around.saturating_add(usize::from(quarters < 4)), elements: around, exact: true };
        Some(Skin { sides: &["outer"], count: self.sweep().count(rim) })
    }

    fn body(&self) -> Result<Body<3>, Wrong> {
        let mut section = self.section().body()?;
        if let Some(quarters @ 1..=3) = self.quarters() {
            // Counter-clockwise from x.
            section = cut(
                &section,
                |[x, y]| [[true, true], [false, true], [false, false]][..quarters].contains(&[x > 0.0, y > 0.0]),
                |[x, y]| {
                    if y == 0.0 && x > 0.0 { "start" } else { "end" }
                },
            );
        }
        let mut body = self.sweep().swept(&section)?;
        Axes::along(self.axis).put(&mut body, self.centre);
        body.name_ends(["bottom", "top"]);
        Ok(body)
    }

    #[cfg(test)]
    fn examples(n: usize) -> Vec<(Self, f64)> {
        let pi = std::f64::consts::PI;
        let whole =
            Self { centre: [0.5, -0.25, 1.0], radius: 2.0, length: 0.5, elements: [n, 2], axis: [0.0, -1.0, 0.0], ..Self::default() };
        let part = |quarters: f64| {
            let part = Self { angle: quarters * 0.5 * pi, elements: [2 * n, 3], axis: [1.0, 1.0, 0.2], grading: 3.0, ..whole.clone() };
            (part, quarters * 0.5 * pi)
        };
        vec![(whole.clone(), 2.0 * pi), part(1.0), part(2.0), part(3.0)]
    }
}

impl Cylinder {
    /// The quarters that there are of it; `None` where the angle is not one of theirs.
    fn quarters(&self) -> Option<usize> {
        let quarters = super::quarters(self.angle);
        (1..=4).find(|&whole| (quarters - whole as f64).abs() < 1e-9)
    }

    fn section(&self) -> Disk {
        Disk { centre: [0.0; 2], radius: self.radius, elements: self.elements[0] }
    }

    fn sweep(&self) -> Sweep {
        Sweep::Extrude(Extrude { length: self.length, elements: self.elements[1], grading: self.grading, ..Extrude::default() })
    }
}
