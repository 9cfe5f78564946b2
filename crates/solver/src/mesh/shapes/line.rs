//! A line along a path: the middle of a shell.

use super::path::Path;
use super::{Body, BuiltIn, Count, ELEMENTS, ShapeCheck, Values, Wrong, chain, chain_count, chain_ends, shape_key};
use crate::mesh::cell::CellKind;
use crate::quantity::Dimension;
use crate::quantity::Range::NotNegative;
use crate::vocabulary::Kind::{Flag, Integer, Points, Quantity};
use crate::vocabulary::Need::{Default as Written, Required};
use crate::vocabulary::{Key, Section, key};

/// A line along a path from point to point, with sharp or round bends. Sets of nodes: `start` and `end`,
/// unless it closes on itself.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Points of the path, m.
    pub points: Vec<[f64; 2]>,
    /// Radius of its bends, m; 0: sharp.
    pub radius: f64,
    /// Whether the last point leads back to the first.
    pub closed: bool,
    /// Elements along it.
    pub elements: usize,
}

pub(super) const KEY: Key =
    shape_key("line", &SECTION, "A line along a path: the middle of a shell, with `element = \"shell2\"`, and swept with `shell4`.");

static SECTION: Section = Section {
    name: "line",
    doc: "A line along a path from point to point, for `element = \"shell2\"` (or `bar2`), or with `extrude` or `revolve` for `shell4`. Unless it is closed, its ends can be named as `start` and `end`; the faces of a `shell2` are `left` and `right` of who walks along it.",
    keys: &[
        key("points", Points(2), Required, "Points of the path."),
        key("radius", Quantity(Dimension::LENGTH, NotNegative), Written("0"), "Radius of its bends; 0: sharp."),
        key("closed", Flag, Written("false"), "Whether the last point leads back to the first."),
        key(ELEMENTS, Integer(1), Required, "Elements along it; each straight part and each bend has at least one."),
    ],
    ..Section::EMPTY
};

impl Line {
    /// A strip of no width.
    fn path(&self) -> Path {
        Path { points: self.points.clone(), width: 0.0, radius: self.radius, closed: self.closed, elements: [1, self.elements] }
    }
}

impl BuiltIn<2> for Line {
    fn read(values: &dyn Values) -> Self {
        Self { points: values.get("points"), radius: values.get("radius"), closed: values.get("closed"), elements: values.get(ELEMENTS) }
    }

    fn check(&self, check: &mut dyn ShapeCheck) {
        check.counts(ELEMENTS, &[self.elements]);
        self.path().check_line(check);
    }

    /// Those of shells belong to the part.
    fn sides(&self) -> Vec<String> {
        Vec::new()
    }

    fn points(&self) -> Vec<String> {
        chain_ends(self.closed)
    }

    fn count(&self) -> Count {
        chain_count(self.elements, self.closed)
    }

    fn cell_kind(&self) -> CellKind {
        CellKind::Line
    }

    fn body(&self) -> Result<Body<2>, Wrong> {
        let at = self.path().stations()?;
        Ok(chain(self.elements, self.closed, |j| at(j, 0.0)))
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
    use crate::vector::{dot, minus};

    fn length(body: &Body<2>) -> f64 {
        let of = |[a, b]: &[u32; 2]| {
            let d = minus(body.positions[*b as usize], body.positions[*a as usize]);
            dot(d, d).sqrt()
        };
        body.all::<2>(CellKind::Line).iter().map(of).sum()
    }

    #[test]
    fn lines_have_the_length_of_their_path() {
        let points = vec![[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [4.0, 2.0]];
        let line = Line { points, radius: 0.0, closed: false, elements: 9 };
        let body = line.body().unwrap();
        assert!((length(&body) - 3.0 - 5.0f64.sqrt()).abs() < 1e-14);
        assert_eq!((body.positions.len(), line.count().nodes), (10, 10));
        assert_eq!(body.points, [("start".to_string(), vec![0]), ("end".to_string(), vec![9])]);
        let square = Line { points: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], radius: 0.25, closed: true, elements: 400 };
        let body = square.body().unwrap();
        assert!((length(&body) - 2.0 - 0.5 * std::f64::consts::PI).abs() < 1e-4);
        assert_eq!((body.positions.len(), body.points.len()), (400, 0));
    }
}
