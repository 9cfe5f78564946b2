//! Bars or beams along lines in 3D: trusses, frames, cables, nets between solids or alone.

use super::truss::Net;
use super::{Body, BuiltIn, Count, ELEMENTS, ShapeCheck, Values, Wrong, shape_key};
use crate::mesh::cell::CellKind;
use crate::vocabulary::Kind::{Integer, SpatialOutlines};
use crate::vocabulary::Need::{Default as Written, Required};
use crate::vocabulary::{Key, Section, key};

/// Bars or beams along straight pieces from point to point in 3D, as [`super::Truss`] has them in 2D.
#[derive(Clone, Debug, PartialEq)]
pub struct SpaceTruss {
    /// Lines, each a list of points, m.
    pub lines: Vec<Vec<[f64; 3]>>,
    /// Bars along each straight piece.
    pub elements: usize,
}

pub(super) const KEY: Key = shape_key(
    "space_truss",
    &SECTION,
    "Bars or beams along lines in 3D: trusses, frames, cables, nets; with `element = \"bar2\"` or `\"beam2\"`.",
);

static SECTION: Section = Section {
    name: "space_truss",
    doc: "Bars along straight pieces from point to point in 3D, for `element = \"bar2\"`, or beams, for `\"beam2\"`. Points in one place are one node (beams are rigidly connected there); lines that cross elsewhere do not meet. \
          Its points can be named as `point0`, `point1`, ... in the order in which they are first given. `join` ties them to other parts.",
    keys: &[
        key(
            "lines",
            SpatialOutlines(2),
            Required,
            "Lines, each a list of points: `[[[0, 0, 0], [1, 0, 0], [0, 0, 1]], [[0, 1, 0], [0, 0, 1]]]` are three bars.",
        ),
        key(
            ELEMENTS,
            Integer(1),
            Written("1"),
            "Elements along each piece between two points: of bars 1 for a truss, more for a cable, which has no stiffness in bending; of beams 4 to 10.",
        ),
    ],
    ..Section::EMPTY
};

impl BuiltIn<3> for SpaceTruss {
    fn read(values: &dyn Values) -> Self {
        Self { lines: values.get("lines"), elements: values.get(ELEMENTS) }
    }

    fn check(&self, check: &mut dyn ShapeCheck) {
        check.counts(ELEMENTS, &[self.elements]);
        let mut sound = !self.lines.is_empty();
        for (k, line) in self.lines.iter().enumerate() {
            line.iter().enumerate().for_each(|(l, &point)| check.vector(&format!("lines[{k}][{l}]"), point));
            sound &= line.len() > 1 && line.iter().flatten().all(|x| x.is_finite());
        }
        if let Some((message, help)) = Some(sound).filter(|sound| *sound).and_then(|_| Net::of(&self.lines).wrong()) {
            check.fault("lines", message, help);
        }
    }

    fn sides(&self) -> Vec<String> {
        Vec::new()
    }

    fn points(&self) -> Vec<String> {
        Net::of(&self.lines).names()
    }

    fn count(&self) -> Count {
        Net::of(&self.lines).count(self.elements)
    }

    fn cell_kind(&self) -> CellKind {
        CellKind::Line
    }

    fn body(&self) -> Result<Body<3>, Wrong> {
        Ok(Net::of(&self.lines).body(self.elements))
    }

    /// None: what the contract tests ask for are volumes and outsides.
    #[cfg(test)]
    fn examples(_n: usize) -> Vec<(Self, f64)> {
        Vec::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tripod_has_one_node_at_its_top() {
        let top = [0.0, 0.0, 1.0];
        let foot = |k: usize| [[1.0, 0.0, 0.0], [-0.5, 0.8, 0.0], [-0.5, -0.8, 0.1]][k];
        let truss = SpaceTruss { lines: (0..3).map(|k| vec![foot(k), top]).collect(), elements: 2 };
        let body = truss.body().unwrap();
        assert_eq!((body.positions.len(), body.cells().count()), (7, 6));
        assert_eq!((truss.count().nodes, truss.count().elements), (7, 6));
        assert_eq!(truss.points(), ["point0", "point1", "point2", "point3"]);
        assert_eq!((body.positions[1], body.positions[0]), (top, foot(0)));
        assert_eq!(body.positions[4], [0.5, 0.0, 0.5]);
        let twice = SpaceTruss { lines: vec![vec![foot(0), top], vec![top, foot(0)]], elements: 1 };
        assert!(Net::of(&twice.lines).wrong().is_some_and(|(message, _)| message.contains("is there twice")));
    }
}
