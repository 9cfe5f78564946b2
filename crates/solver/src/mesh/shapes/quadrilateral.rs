//! A quadrilateral whose edges are straight, arcs, or run from point to point.

use super::coons::{Curve, between};
use super::numbers::{cross, minus};
use super::{Body, BuiltIn, Count, ELEMENTS, GRADING, ShapeCheck, Steps, Values, Wrong, lattice, shape_key, unfolded};
use crate::quantity::Dimension;
use crate::quantity::Range::Finite;
use crate::vocabulary::Kind::{Integers, Points, Vector};
use crate::vocabulary::Need::{Optional, Required};
use crate::vocabulary::{Key, Rule, Section, key};

/// An edge between two corners of a quadrilateral.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Edge {
    /// A straight line.
    #[default]
    Straight,
    /// An arc through this point, m.
    Arc([f64; 2]),
    /// A line through these points, m.
    Line(Vec<[f64; 2]>),
}

/// A quadrilateral between four corners and mapped edges; sides `left`, `right`, `bottom`, `top`.
#[derive(Clone, Debug, PartialEq)]
pub struct Quadrilateral {
    /// Four corners, m, counter-clockwise from the lower left one.
    pub corners: Vec<[f64; 2]>,
    /// Edges `bottom`, `right`, `top` and `left`, each counter-clockwise from corner to corner.
    pub edges: [Edge; 4],
    /// Elements along bottom and top, and along right and left.
    pub elements: [usize; 2],
    /// Length of the last element over that of the first, to the right and up.
    pub grading: [f64; 2],
}

pub(super) const KEY: Key = shape_key("quadrilateral", &SECTION, "A quadrilateral with straight or curved edges.");

/// Keys of each edge: points, or the point of an arc.
const EDGES: [[&str; 2]; 4] = [["bottom", "bottom_arc"], ["right", "right_arc"], ["top", "top_arc"], ["left", "left_arc"]];

static SECTION: Section = Section {
    name: "quadrilateral",
    doc: "A quadrilateral with straight or curved edges, meshed by the map between them (Coons); its sides are `left`, `right`, `bottom` and `top`. \
          An edge is straight unless points are given.",
    keys: &[
        key("corners", Points(4), Required, "Four corners, counter-clockwise; `bottom` is between the first two."),
        key(ELEMENTS, Integers(2, 1), Required, "Elements along `bottom` and along `right`."),
        GRADING,
        key("bottom", Points(1), Optional("straight"), "Points that this edge runs through, from the first corner to the second."),
        key("right", Points(1), Optional("straight"), "The same from the second corner to the third."),
        key("top", Points(1), Optional("straight"), "The same from the third corner to the fourth."),
        key("left", Points(1), Optional("straight"), "The same from the fourth corner to the first."),
        key(
            "bottom_arc",
            Vector(Dimension::LENGTH, Finite),
            Optional("straight"),
            "A point through which this edge is an arc of a circle.",
        ),
        key("right_arc", Vector(Dimension::LENGTH, Finite), Optional("straight"), "The same for the right edge."),
        key("top_arc", Vector(Dimension::LENGTH, Finite), Optional("straight"), "The same for the top edge."),
        key("left_arc", Vector(Dimension::LENGTH, Finite), Optional("straight"), "The same for the left edge."),
    ],
    rules: &[
        Rule::NotBoth("bottom", "bottom_arc"),
        Rule::NotBoth("right", "right_arc"),
        Rule::NotBoth("top", "top_arc"),
        Rule::NotBoth("left", "left_arc"),
    ],
    ..Section::EMPTY
};

impl Quadrilateral {
    /// The edges as curves, counter-clockwise; `None` for an arc through a point in line with its corners.
    fn curves(&self) -> [Option<Curve>; 4] {
        std::array::from_fn(|k| {
            let [a, b] = [self.corners[k], self.corners[(k + 1) % 4]];
            match &self.edges[k] {
                Edge::Straight => Some(Curve::line(vec![a, b])),
                Edge::Arc(point) => Curve::arc([a, *point, b]),
                Edge::Line(points) => Some(Curve::line([&[a], &points[..], &[b]].concat())),
            }
        })
    }
}

impl BuiltIn<2> for Quadrilateral {
    fn read(values: &dyn Values) -> Self {
        let edge = |[line, arc]: [&str; 2]| {
            if values.has(arc) {
                Edge::Arc(values.get(arc))
            } else if values.has(line) {
                Edge::Line(values.get(line))
            } else {
                Edge::Straight
            }
        };
        let (elements, grading) = (values.get(ELEMENTS), values.get("grading"));
        Self { corners: values.get("corners"), edges: EDGES.map(edge), elements, grading }
    }

    fn check(&self, check: &mut dyn ShapeCheck) {
        let mut sound = check.points("corners", &self.corners);
        check.counts(ELEMENTS, &self.elements);
        check.vector("grading", self.grading);
        for ([line, arc], edge) in EDGES.iter().zip(&self.edges) {
            sound &= match edge {
                Edge::Straight => true,
                Edge::Arc(point) => check.points(arc, &[*point]),
                Edge::Line(points) => check.points(line, points),
            };
        }
        if self.corners.len() != 4 {
            check.fault("corners", format!("a quadrilateral has 4 corners, not {}", self.corners.len()), "give 4 points");
        } else if sound {
            self.check_form(check);
        }
    }

    fn sides(&self) -> Vec<String> {
        ["left", "right", "bottom", "top"].map(String::from).into()
    }

    fn count(&self) -> Count {
        Count::of_lattice(self.elements, false)
    }

    fn body(&self) -> Result<Body<2>, Wrong> {
        let [Some(bottom), Some(right), Some(top), Some(left)] = self.curves() else {
            return Err(Wrong::new("", "an edge is an arc through a point in line with its corners", "leave it straight"));
        };
        // Top and left run backwards.
        let curves = [bottom, right, reversed(top), reversed(left)];
        let steps = [0, 1].map(|d| Steps::new(self.elements[d], self.grading[d]));
        let at = |i, j| between(&curves, [steps[0].place(i), steps[1].place(j)]);
        let body = lattice(self.elements, false, ["left", "right", "bottom", "top"], at);
        unfolded(body, "bend its edges less, spread points along opposite edges alike, or make two bodies of it")
    }

    #[cfg(test)]
    fn examples(n: usize) -> Vec<(Self, f64)> {
        let corners = vec![[0.0, 0.0], [2.0, 0.5], [2.5, 2.0], [-0.5, 1.5]];
        let straight = Self { corners, edges: Default::default(), elements: [n, n], grading: [1.0; 2] };
        let graded = Self { grading: [4.0, 0.25], ..straight.clone() };
        // A quarter of a ring as a map: the arcs bottom and top, and a right edge with a corner in it.
        let root = std::f64::consts::FRAC_1_SQRT_2;
        let arcs = Self {
            corners: vec![[0.0, 1.0], [1.0, 0.0], [2.0, 0.0], [0.0, 2.0]],
            edges: [Edge::Arc([root, root]), Edge::Line(vec![[1.5, 0.0]]), Edge::Arc([2.0 * root, 2.0 * root]), Edge::Straight],
            elements: [2 * n, n],
            grading: [1.0; 2],
        };
        let edges = [Edge::Line(vec![[1.1, -0.15]]), Edge::Straight, Edge::Straight, Edge::Straight];
        let bent = Self { edges, elements: [2 * n, 3], ..straight.clone() };
        vec![(straight, 3.75), (graded, 3.75), (arcs, 0.75 * std::f64::consts::PI), (bent, 4.175)]
    }
}

impl Quadrilateral {
    fn check_form(&self, check: &mut dyn ShapeCheck) {
        for (k, curve) in self.curves().iter().enumerate() {
            match curve {
                None => {
                    let help = "leave the key out for a straight edge, or take a point beside the line";
                    check.fault(EDGES[k][1], "the point is in line with the corners, so no arc runs through it", help);
                }
                Some(Curve::Line { lengths, .. }) if lengths.windows(2).any(|pair| pair[0] == pair[1]) => {
                    let key = if self.edges[k] == Edge::Straight { "corners" } else { EDGES[k][0] };
                    let message = format!("two points of the {} edge that follow each other are the same", EDGES[k][0]);
                    check.fault(key, message, "leave one of them out, or move it");
                }
                Some(_) => {}
            }
        }
        if self.edges.iter().all(|edge| *edge == Edge::Straight) {
            let x = |k: usize| self.corners[k % 4];
            let turns = (0..4).filter(|&k| cross(minus(x(k + 1), x(k)), minus(x(k + 2), x(k + 1))) > 0.0).count();
            let (message, help) = match turns {
                4 => return,
                0 => ("the corners run clockwise", "give them counter-clockwise: swap the second and the fourth"),
                2 => ("its edges cross each other", "give the corners in order around it"),
                _ => ("it has a corner that points inwards, and no map there", "make two bodies of it, or a polygon"),
            };
            check.fault("corners", message, help);
        }
    }
}

/// The curve from its end to its beginning.
fn reversed(curve: Curve) -> Curve {
    match curve {
        Curve::Line { mut points, .. } => {
            points.reverse();
            Curve::line(points)
        }
        Curve::Arc { ends: [a, b], centre, turn } => Curve::Arc { ends: [b, a], centre, turn: -turn },
    }
}
