//! An axis-parallel box.

use super::{Body, BuiltIn, Count, ELEMENTS, Rectangle, ShapeCheck, Skin, Values, Wrong, shape_key};
use super::{Extrude, Sweep};
use crate::quantity::Dimension;
use crate::quantity::Range::{Finite, Positive};
use crate::vocabulary::Kind::{Integers, Spatial};
use crate::vocabulary::Need::{Default as Written, Required};
use crate::vocabulary::{Key, Section, key};

/// An axis-parallel box of hexahedra; sides `left`, `right` (along x), `bottom`, `top` (along y), `back`,
/// `front` (along z).
#[derive(Clone, Debug, PartialEq)]
pub struct Cuboid {
    /// Corner with the lowest coordinates, m.
    pub corner: [f64; 3],
    /// Lengths along x, y and z, m.
    pub size: [f64; 3],
    /// Elements along x, y and z.
    pub elements: [usize; 3],
    /// Length of the last element over that of the first, along x, y and z.
    pub grading: [f64; 3],
}

impl Default for Cuboid {
    fn default() -> Self {
        Self { corner: [0.0; 3], size: [1.0; 3], elements: [1; 3], grading: [1.0; 3] }
    }
}

pub(super) const KEY: Key = shape_key("box", &SECTION, "An axis-parallel box: a solid.");

static SECTION: Section = Section {
    name: "box",
    doc: "An axis-parallel box of hexahedra; its sides are `left` and `right` (along x), `bottom` and `top` (along \
        y), `back` and `front` (along z). With `shell4` the shell of all six.",
    keys: &[
        key("corner", Spatial(Dimension::LENGTH, Finite), Required, "Corner with the lowest coordinates."),
        key("size", Spatial(Dimension::LENGTH, Positive), Required, "Lengths along x, y and z."),
        key(ELEMENTS, Integers(3, 1), Required, "Elements along x, y and z."),
        key(
            "grading",
            Spatial(Dimension::NONE, Positive),
            Written("[1, 1, 1]"),
            "Length of the last element over that of the first, along x, y and z; they grow by equal factors.",
        ),
    ],
    ..Section::EMPTY
};

impl BuiltIn<3> for Cuboid {
    fn read(values: &dyn Values) -> Self {
        let spatial = |key| -> [f64; 3] { values.get(key) };
        Self { corner: spatial("corner"), size: spatial("size"), elements: values.get(ELEMENTS), grading: spatial("grading") }
    }

    fn check(&self, check: &mut dyn ShapeCheck) {
        check.vector("corner", self.corner);
        check.vector("size", self.size);
        check.counts(ELEMENTS, &self.elements);
        check.vector("grading", self.grading);
    }

    fn sides(&self) -> Vec<String> {
        ["left", "right", "bottom", "top", "back", "front"].map(String::from).into()
    }

    fn count(&self) -> Count {
        self.sweep().count(self.section().count())
    }

    fn skin(&self) -> Option<Skin> {
        let [a, b, c] = self.elements;
        let product = |[a, b, c]: [usize; 3]| a.saturating_mul(b).saturating_mul(c);
        let inside = product(self.elements.map(|n| n.saturating_sub(1)));
        let nodes = product(self.elements.map(|n| n.saturating_add(1))).saturating_sub(inside);
        let sides = [[a, b], [b, c], [c, a]].map(|[a, b]| a.saturating_mul(b).saturating_mul(2));
        let elements = sides.into_iter().fold(0, usize::saturating_add);
        Some(Skin { sides: &["left", "right", "bottom", "top", "back", "front"], count: Count { nodes, elements, exact: true } })
    }

    /// Nodes run along x first, then along y.
    fn body(&self) -> Result<Body<3>, Wrong> {
        self.sweep().swept(&self.section().body()?)
    }

    #[cfg(test)]
    fn examples(n: usize) -> Vec<(Self, f64)> {
        let even = Self { corner: [-1.0, 2.0, 0.5], size: [3.0, 0.25, 2.0], elements: [n, 3, 2], ..Self::default() };
        vec![(even.clone(), 1.5), (Self { grading: [5.0, 0.5, 2.0], ..even }, 1.5)]
    }
}

impl Cuboid {
    fn section(&self) -> Rectangle {
        let [corner, size, grading] = [self.corner, self.size, self.grading].map(|[x, y, _]| [x, y]);
        Rectangle { corner, size, elements: [self.elements[0], self.elements[1]], grading }
    }

    fn sweep(&self) -> Sweep {
        Sweep::Extrude(Extrude { from: self.corner[2], length: self.size[2], elements: self.elements[2], grading: self.grading[2] })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sides_of_a_box_lie_where_their_names_say() {
        let body = Cuboid { corner: [1.0, 2.0, 3.0], size: [3.0, 0.5, 1.0], elements: [3, 2, 4], ..Cuboid::default() }.body().unwrap();
        let places = [("left", 0, 1.0), ("right", 0, 4.0), ("bottom", 1, 2.0), ("top", 1, 2.5), ("back", 2, 3.0), ("front", 2, 4.0)];
        for (name, d, value) in places {
            let side = &body.sides.iter().find(|side| side.0 == name).unwrap().1;
            assert!(!side.is_empty() && side.iter().flatten().all(|&node| body.positions[node as usize][d] == value), "{name}");
        }
    }
}
