//! Bars along lines: trusses, cables, nets.

use super::numbers::{distance, on_line};
use super::{Body, BuiltIn, CheckOf, Count, ELEMENTS, Values, Wrong, node, shape_key};
use crate::model::describe::Kind::{Integer, Outlines};
use crate::model::describe::Need::{Default as Written, Required};
use crate::model::describe::{Key, Section, key};

/// Points nearer to each other than this fraction of the size are one.
const SAME: f64 = 1e-9;

/// Bars along straight pieces from point to point. Points in one place are one node; lines that cross anywhere else do not meet.
/// Sets of nodes: `point0`, `point1`, ... in the order in which the points are first named.
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

impl Truss {
    /// Points, each once, and the pieces between them.
    fn net(&self) -> (Vec<[f64; 2]>, Vec<[usize; 2]>) {
        let all = || self.lines.iter().flatten();
        let size = all().flatten().fold(0.0f64, |size, x| size.max(x.abs()));
        let mut points: Vec<[f64; 2]> = Vec::new();
        let mut sorted: Vec<(f64, usize)> = Vec::new();
        let mut number = |x: [f64; 2]| {
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
        for line in &self.lines {
            let numbers: Vec<usize> = line.iter().map(|&x| number(x)).collect();
            pieces.extend(numbers.windows(2).map(|pair| [pair[0], pair[1]]));
        }
        (points, pieces)
    }
}

impl BuiltIn for Truss {
    fn read(values: &dyn Values) -> Self {
        Self { lines: values.outlines("lines"), elements: values.count(ELEMENTS) }
    }

    fn check(&self, check: &mut CheckOf<'_, '_>) {
        check.counts(ELEMENTS, &[self.elements]);
        let mut sound = !self.lines.is_empty();
        for (k, line) in self.lines.iter().enumerate() {
            sound &= check.points(&format!("lines[{k}]"), line) && line.len() > 1;
        }
        if !sound {
            return;
        }
        let (points, pieces) = self.net();
        let mut seen = Vec::with_capacity(pieces.len());
        for [a, b] in pieces {
            let [[x, y], [u, v]] = [points[a], points[b]];
            if a == b {
                check.fault("lines", format!("a line names the point ({x:.6e}, {y:.6e}) m twice running"), "leave one of them out");
                return;
            }
            seen.push(([a.min(b), a.max(b)], [x, y, u, v]));
        }
        seen.sort_by_key(|(ends, _)| *ends);
        if let Some(twice) = seen.windows(2).find(|two| two[0].0 == two[1].0) {
            let [x, y, u, v] = twice[0].1;
            let message = format!("the piece from ({x:.6e}, {y:.6e}) to ({u:.6e}, {v:.6e}) m is there twice");
            check.fault("lines", message, "leave one of them out, or give it another cross-section in a part of its own");
        }
    }

    fn sides(&self) -> Vec<String> {
        Vec::new()
    }

    fn points(&self) -> Vec<String> {
        (0..self.net().0.len()).map(|k| format!("point{k}")).collect()
    }

    fn count(&self) -> Count {
        let (points, pieces) = self.net();
        let within = pieces.len().saturating_mul(self.elements.saturating_sub(1));
        Count { nodes: points.len().saturating_add(within), elements: pieces.len().saturating_mul(self.elements), exact: true }
    }

    fn nodes_per_element(&self) -> usize {
        2
    }

    fn body(&self) -> Result<Body, Wrong> {
        let (points, pieces) = self.net();
        let mut body = Body { positions: points.clone(), ..Body::default() };
        for [a, b] in pieces {
            let mut from = node(a);
            for k in 1..self.elements {
                let to = node(body.positions.len());
                body.positions.push(on_line(points[a], points[b], k as f64 / self.elements as f64));
                body.bars.push([from, to]);
                from = to;
            }
            body.bars.push([from, node(b)]);
        }
        body.points = (0..points.len()).map(|k| (format!("point{k}"), vec![node(k)])).collect();
        Ok(body)
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
        assert_eq!((body.positions.len(), body.bars.len()), (4 + 5 * 2, 15));
        let count = truss.count();
        assert_eq!((count.nodes, count.elements, count.exact), (14, 15, true));
        assert_eq!(truss.points(), ["point0", "point1", "point2", "point3"]);
        let length: f64 = body.bars.iter().map(|bar| distance(body.positions[bar[0] as usize], body.positions[bar[1] as usize])).sum();
        assert!((length - 4.0 - 2.0f64.sqrt()).abs() < 1e-11);
        assert_eq!(body.points[2], ("point2".to_string(), vec![2]));
        assert_eq!(body.positions[2], [1.0, 1.0]);
    }
}
