//! Bars along lines: trusses, cables, nets.

use super::{Body, BuiltIn, Count, ELEMENTS, ShapeCheck, Values, Wrong, node, shape_key};
use crate::mesh::Meshed;
use crate::mesh::cell::CellKind;
use crate::tensor::Dim;
use crate::vector::{dot, minus};
use crate::vocabulary::Kind::{Integer, Outlines};
use crate::vocabulary::Need::{Default as Written, Required};
use crate::vocabulary::{Key, Section, key};

/// Points nearer to each other than this fraction of the size are one.
const SAME: f64 = 1e-9;

/// Bars along straight pieces from point to point. Points in one place are one node; lines that cross
/// anywhere else do not meet. Sets of nodes: `point0`, `point1`, ... in the order in which the points are
/// first named.
#[derive(Clone, Debug, PartialEq)]
pub struct Truss {
    /// Lines, each a list of points, m.
    pub lines: Vec<Vec<[f64; 2]>>,
    /// Bars along each straight piece.
    pub elements: usize,
}

pub(super) const KEY: Key = shape_key("truss", &SECTION, "Bars along lines: trusses, cables, nets; with `element = \"bar2\"`.");

static SECTION: Section = Section {
    name: "truss",
    doc: "Bars along straight pieces from point to point, for `element = \"bar2\"`. Points in one place are one node; lines that cross elsewhere do not meet. \
          Its points can be named as `point0`, `point1`, ... in the order in which they are first given. `join` ties them to other parts.",
    keys: &[
        key("lines", Outlines(2), Required, "Lines, each a list of points: `[[[0, 0], [1, 0], [1, 1]], [[0, 0], [1, 1]]]` is a triangle."),
        key(
            ELEMENTS,
            Integer(1),
            Written("1"),
            "Bars along each piece between two points: 1 for a truss, more for a cable, which has no stiffness in bending.",
        ),
    ],
    ..Section::EMPTY
};

/// Lines between points, in 2D or 3D.
pub(super) struct Net<const D: usize> {
    /// Each once.
    points: Vec<[f64; D]>,
    /// The pieces between them.
    pieces: Vec<[usize; 2]>,
}

fn distance<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    let arm = minus(b, a);
    dot(arm, arm).sqrt()
}

/// A point in a message.
fn shown<const D: usize>(x: [f64; D]) -> String {
    format!("({})", x.map(|x| format!("{x:.6e}")).join(", "))
}

impl<const D: usize> Net<D>
where
    Dim<D>: Meshed<D>,
{
    /// Points in one place are one.
    pub(super) fn of(lines: &[Vec<[f64; D]>]) -> Self {
        let size = lines.iter().flatten().flatten().fold(0.0f64, |size, x| size.max(x.abs()));
        let mut points: Vec<[f64; D]> = Vec::new();
        let mut sorted: Vec<(f64, usize)> = Vec::new();
        let mut number = |x: [f64; D]| {
            // Neighbours along x, so that large nets take no longer than they must.
            let from = sorted.partition_point(|(at, _)| *at < x[0] - SAME * size);
            let near = sorted[from..].iter().take_while(|(at, _)| *at <= x[0] + SAME * size);
            if let Some((_, same)) = near.clone().find(|(_, other)| distance(points[*other], x) <= SAME * size) {
                return *same;
            }
            sorted.insert(sorted.partition_point(|(at, _)| *at < x[0]), (x[0], points.len()));
            points.push(x);
            points.len() - 1
        };
        let mut pieces = Vec::new();
        for line in lines {
            let numbers: Vec<usize> = line.iter().map(|&x| number(x)).collect();
            pieces.extend(numbers.windows(2).map(|pair| [pair[0], pair[1]]));
        }
        Self { points, pieces }
    }

    /// A piece that ends where it begins, or is there twice: what is wrong, and what to do.
    pub(super) fn wrong(&self) -> Option<(String, &'static str)> {
        let mut seen = Vec::with_capacity(self.pieces.len());
        for &[a, b] in &self.pieces {
            if a == b {
                return Some((format!("a line names the point {} m twice running", shown(self.points[a])), "leave one of them out"));
            }
            seen.push(([a.min(b), a.max(b)], [a, b]));
        }
        seen.sort_by_key(|(ends, _)| *ends);
        let twice = seen.windows(2).find(|two| two[0].0 == two[1].0)?;
        let [from, to] = twice[0].1.map(|end| shown(self.points[end]));
        let message = format!("the piece from {from} to {to} m is there twice");
        Some((message, "leave one of them out, or give it another cross-section in a part of its own"))
    }

    /// Names of the points.
    pub(super) fn names(&self) -> Vec<String> {
        (0..self.points.len()).map(|k| format!("point{k}")).collect()
    }

    /// With so many bars along each piece.
    pub(super) fn count(&self, elements: usize) -> Count {
        let within = self.pieces.len().saturating_mul(elements.saturating_sub(1));
        Count { nodes: self.points.len().saturating_add(within), elements: self.pieces.len().saturating_mul(elements), exact: true }
    }

    /// With so many bars along each piece.
    pub(super) fn body(&self, elements: usize) -> Body<D> {
        let mut body = Body { positions: self.points.clone(), ..Body::default() };
        for &[a, b] in &self.pieces {
            let mut from = node(a);
            for k in 1..elements {
                let (to, place) = (node(body.positions.len()), k as f64 / elements as f64);
                body.positions.push(std::array::from_fn(|d| self.points[a][d] + (self.points[b][d] - self.points[a][d]) * place));
                body.extend(CellKind::Line, [[from, to]]);
                from = to;
            }
            body.extend(CellKind::Line, [[from, node(b)]]);
        }
        body.points = self.names().into_iter().zip(0..).map(|(name, k)| (name, vec![node(k)])).collect();
        body
    }
}

impl BuiltIn<2> for Truss {
    fn read(values: &dyn Values) -> Self {
        Self { lines: values.get("lines"), elements: values.get(ELEMENTS) }
    }

    fn check(&self, check: &mut dyn ShapeCheck) {
        check.counts(ELEMENTS, &[self.elements]);
        let mut sound = !self.lines.is_empty();
        for (k, line) in self.lines.iter().enumerate() {
            sound &= check.points(&format!("lines[{k}]"), line) && line.len() > 1;
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

    fn body(&self) -> Result<Body<2>, Wrong> {
        Ok(Net::of(&self.lines).body(self.elements))
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

    #[test]
    fn lines_that_share_a_point_share_its_node() {
        let square = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]];
        let diagonal = vec![[0.0, 1e-12], [1.0, 1.0]];
        let truss = Truss { lines: vec![square, diagonal], elements: 3 };
        let body = truss.body().unwrap();
        assert_eq!((body.positions.len(), body.cells().count()), (4 + 5 * 2, 15));
        let count = truss.count();
        assert_eq!((count.nodes, count.elements, count.exact), (14, 15, true));
        assert_eq!(truss.points(), ["point0", "point1", "point2", "point3"]);
        let length: f64 = body
            .all::<2>(CellKind::Line)
            .iter()
            .map(|bar| distance(body.positions[bar[0] as usize], body.positions[bar[1] as usize]))
            .sum();
        assert!((length - 4.0 - 2.0f64.sqrt()).abs() < 1e-11);
        assert_eq!(body.points[2], ("point2".to_string(), vec![2]));
        assert_eq!(body.positions[2], [1.0, 1.0]);
    }
}
