//! A ring, or a sector of one.

use super::numbers::{cos_sin, quarters};
use super::{Body, BuiltIn, Count, ELEMENTS, GRADING, ShapeCheck, Steps, Values, Wrong, lattice, shape_key};
use crate::model::reference::is_full_turn;
use crate::quantity::Dimension;
use crate::quantity::Range::{Finite, Positive};
use crate::vocabulary::Kind::{Angle, Integers, Quantity, Vector};
use crate::vocabulary::Need::{Default as Written, Required};
use crate::vocabulary::{Key, Section, key};

/// A ring or a sector of one, counter-clockwise from `from` to `to`; it closes on itself when they differ by
/// 2π (within 1e-9). Sides `inner`, `outer` and, for a sector, `start` (at `from`) and `end`.
#[derive(Clone, Debug, PartialEq)]
pub struct Ring {
    /// Centre, m.
    pub centre: [f64; 2],
    /// Inner radius, m.
    pub inner: f64,
    /// Outer radius, m.
    pub outer: f64,
    /// First angle, rad, from +x counter-clockwise.
    pub from: f64,
    /// Last angle, rad, greater than `from` by at most 2π.
    pub to: f64,
    /// Elements through the wall and around.
    pub elements: [usize; 2],
    /// Length of the last element over that of the first, outwards and around.
    pub grading: [f64; 2],
}

impl Default for Ring {
    fn default() -> Self {
        let to = std::f64::consts::TAU;
        Self { centre: [0.0; 2], inner: 0.5, outer: 1.0, from: 0.0, to, elements: [1, 12], grading: [1.0; 2] }
    }
}

impl Ring {
    pub(super) fn is_closed(&self) -> bool {
        is_full_turn(self.from, self.to)
    }
}

/// Angles of a ring, a sector or an arc.
pub(super) const FROM: Key =
    key("from", Angle(Dimension::NONE, Finite), Written("0"), "Angle at which it begins, counter-clockwise from the x axis.");
pub(super) const TO: Key =
    key("to", Angle(Dimension::NONE, Finite), Written("\"360 deg\""), "Angle at which it ends: more than `from`, by at most a full turn.");

pub(super) const KEY: Key = shape_key("ring", &SECTION, "A ring or a sector of one.");

static SECTION: Section = Section {
    name: "ring",
    doc: "A ring, or a sector of one, counter-clockwise from `from` to `to`; its sides are `inner` and `outer` and, \
        for a sector, `start` and `end`.",
    keys: &[
        key("centre", Vector(Dimension::LENGTH, Finite), Required, "Centre."),
        key("inner", Quantity(Dimension::LENGTH, Positive), Required, "Inner radius."),
        key("outer", Quantity(Dimension::LENGTH, Positive), Required, "Outer radius."),
        FROM,
        TO,
        key(ELEMENTS, Integers(2, 1), Required, "Elements through the wall and around."),
        GRADING,
    ],
    ..Section::EMPTY
};

impl Ring {
    /// Reports faults of radii and angles.
    pub(super) fn check_radii(&self, check: &mut dyn ShapeCheck) {
        let Self { inner, outer, .. } = *self;
        for (key, value) in [("inner", inner), ("outer", outer)] {
            check.number(key, value);
        }
        if inner >= outer {
            let message = format!("the inner radius {inner} m is not smaller than the outer radius {outer} m");
            check.fault("inner", message, "swap or correct the radii");
        }
        self.check_angles(check);
    }

    /// Reports faults of the angles.
    pub(super) fn check_angles(&self, check: &mut dyn ShapeCheck) {
        let Self { from, to, .. } = *self;
        for (key, value) in [("from", from), ("to", to)] {
            check.number(key, value);
        }
        let degrees = |angle: f64| (angle.to_degrees() * 1e9).round() / 1e9;
        if to <= from {
            let message = format!("it ends at {} deg, not after its beginning at {} deg", degrees(to), degrees(from));
            check.fault("to", message, "it runs counter-clockwise: add \"360 deg\" to `to`, or swap the two");
        } else if to - from > std::f64::consts::TAU + 1e-9 {
            let message = format!("it runs over {} deg, more than a full turn", degrees(to - from));
            check.fault("to", message, "let `to` exceed `from` by at most 360 deg");
        } else if self.is_closed() && (1..3).contains(&self.elements[1]) {
            check.fault(ELEMENTS, format!("{} elements can't go all around", self.elements[1]), "give at least 3 around");
        }
    }
}

impl BuiltIn<2> for Ring {
    fn read(values: &dyn Values) -> Self {
        let number = |key| -> f64 { values.get(key) };
        Self {
            centre: values.get("centre"),
            inner: number("inner"),
            outer: number("outer"),
            from: number("from"),
            to: number("to"),
            elements: values.get(ELEMENTS),
            grading: values.get("grading"),
        }
    }

    fn check(&self, check: &mut dyn ShapeCheck) {
        check.vector("centre", self.centre);
        self.check_radii(check);
        check.counts(ELEMENTS, &self.elements);
        check.vector("grading", self.grading);
        if self.is_closed() && self.grading[1] != 1.0 {
            let message = format!("a closed ring can't be graded around, but grading[1] is {}", self.grading[1]);
            check.fault("grading", message, "let it be 1, or make two sectors");
        }
    }

    fn sides(&self) -> Vec<String> {
        let all = ["inner", "outer", "start", "end"].map(String::from);
        all.into_iter().take(if self.is_closed() { 2 } else { 4 }).collect()
    }

    fn count(&self) -> Count {
        Count::of_lattice(self.elements, self.is_closed())
    }

    /// Nodes run through the wall first, from the inside.
    fn body(&self) -> Result<Body<2>, Wrong> {
        let closed = self.is_closed();
        let first = quarters(self.from);
        let last = if closed { first + 4.0 } else { quarters(self.to) };
        let [through, around] = [0, 1].map(|d| Steps::new(self.elements[d], self.grading[d]));
        let stations: Vec<[f64; 2]> = (0..=self.elements[1]).map(|j| cos_sin(around.between(first, last, j))).collect();
        let at = |i, j: usize| {
            let (r, [c, s]) = (through.between(self.inner, self.outer, i), stations[j]);
            [self.centre[0] + r * c, self.centre[1] + r * s]
        };
        Ok(lattice(self.elements, closed, ["inner", "outer", "start", "end"], at))
    }

    #[cfg(test)]
    fn examples(n: usize) -> Vec<(Self, f64)> {
        let ring = |from: f64, to: f64, elements| {
            let ring = Self { centre: [0.0, 1.0], inner: 0.9, outer: 1.0, from, to, elements, ..Self::default() };
            (ring, 0.5 * (to - from) * (1.0 - 0.81))
        };
        let pi = std::f64::consts::PI;
        let (graded, area) = ring(0.3, 1.1, [3, n]);
        vec![
            ring(-0.5 * pi, 0.5 * pi, [n, 2 * n]),
            ring(0.3, 1.1, [n, n]),
            ring(-pi, pi, [n, 3 * n]),
            (Self { grading: [3.0, 2.0], ..graded }, area),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shapes::tests::moments;
    use std::f64::consts::PI;

    fn ring(centre: [f64; 2], inner: f64, outer: f64, from: f64, to: f64, elements: [usize; 2]) -> Body<2> {
        Ring { centre, inner, outer, from, to, elements, ..Ring::default() }.body().unwrap()
    }

    #[test]
    fn the_moments_of_a_ring_converge_with_the_square_of_the_element_size() {
        let second = |a: f64, r: f64| a * (1.0 - r * r * r * r) / 16.0;
        let exact = [0.75 * PI / 4.0, second(PI, 0.5), second(PI, 0.5), (1.0 - 0.0625) / 8.0];
        for m in 0..4 {
            let error = |n: usize| (moments(&ring([0.0, 0.0], 0.5, 1.0, 0.0, 0.5 * PI, [2, n]))[m] - exact[m]).abs();
            let slope = (error(20) / error(40)).log2();
            assert!((1.95..2.05).contains(&slope), "moment {m}: slope {slope}");
        }
    }

    #[test]
    fn mirror_images_of_a_ring_agree_to_the_last_bit() {
        crate::mesh::shapes::tests::is_its_mirror_image(&ring([0.0, 0.0], 0.3, 0.7, -0.5 * PI, 0.5 * PI, [3, 37]));
    }

    #[test]
    fn a_ring_closes_on_itself() {
        for (from, to) in [(0.0, 2.0 * PI), (-PI, PI), (0.7, 0.7 + 2.0 * PI), (0.0, 2.0 * PI - 2e-10)] {
            let body = ring([0.0, 0.0], 1.0, 2.0, from, to, [2, 8]);
            assert_eq!((body.positions.len(), body.cells().count(), body.sides.len()), (24, 16, 2));
        }
    }

    #[test]
    fn nodes_on_an_axis_lie_on_it_exactly() {
        // As the reader turns degrees into radians.
        let degrees = |d: f64| d * (PI / 180.0);
        for around in [2, 4, 6, 40, 180, 1000] {
            let tube = ring([0.0, 0.1], 0.094, 0.100, degrees(-90.0), degrees(90.0), [1, around]);
            let on_line = tube.positions.iter().filter(|p| p[0] == 0.0).count();
            assert_eq!(on_line, 4, "{around} around");
            assert!(tube.positions.iter().all(|p| p[0] >= 0.0));
            assert_eq!(tube.positions[1], [0.0, 0.1 - 0.1]);
            let whole = ring([0.25, 0.5], 1.0, 2.0, degrees(-90.0), degrees(270.0), [1, 2 * around]);
            assert_eq!(whole.positions.iter().filter(|p| p[0] == 0.25).count(), 4, "{around} around");
        }
    }
}
