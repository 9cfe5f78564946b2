//! A strip of a given width along a path.

use super::numbers::{cos_sin, cross, distance, dot, minus, on_line, quarters_of};
use super::{Body, BuiltIn, Count, ELEMENTS, ShapeCheck, Values, Wrong, lattice, shape_key, unfolded};
use crate::quantity::Dimension;
use crate::quantity::Range::{NotNegative, Positive};
use crate::vocabulary::Kind::{Flag, Integers, Points, Quantity};
use crate::vocabulary::Need::{Default as Written, Required};
use crate::vocabulary::{Key, Section, key};
use std::f64::consts::FRAC_PI_2;

/// A strip along a path from point to point, with mitred or round bends; sides `left` and `right` of who
/// walks along it and, unless it closes on itself, `start` and `end`.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// Points of its middle line, m.
    pub points: Vec<[f64; 2]>,
    /// Width, m.
    pub width: f64,
    /// Radius of the middle line in its bends, m; 0: mitred.
    pub radius: f64,
    /// Whether the last point leads back to the first.
    pub closed: bool,
    /// Elements through the width and along the path.
    pub elements: [usize; 2],
}

pub(super) const KEY: Key = shape_key("path", &SECTION, "A strip of a given width along a path.");

static SECTION: Section = Section {
    name: "path",
    doc: "A strip along a path from point to point: a bent sheet, a pipe, a spring. Its sides are `left` and `right` of who walks along it and, \
          unless it is closed, `start` and `end`.",
    keys: &[
        key("points", Points(2), Required, "Points of the middle line."),
        key("width", Quantity(Dimension::LENGTH, Positive), Required, "Width of the strip, half on either side of the line."),
        key("radius", Quantity(Dimension::LENGTH, NotNegative), Written("0"), "Radius of the middle line in its bends; 0: mitred corners."),
        key("closed", Flag, Written("false"), "Whether the last point leads back to the first."),
        key(
            ELEMENTS,
            Integers(2, 1),
            Required,
            "Elements through the width and along the path; each straight part and each bend has at least one.",
        ),
    ],
    ..Section::EMPTY
};

/// A piece of the path.
enum Piece {
    /// A straight line, and at either end where the strip continues the right by unit of width (the normal,
    /// or the mitre).
    Straight { ends: [[f64; 2]; 2], right: [[f64; 2]; 2] },
    /// A bend: its centre, where it begins, and the angle, quarter turns counter-clockwise.
    Bend { centre: [f64; 2], from: [f64; 2], turn: f64 },
}

impl Piece {
    fn length(&self) -> f64 {
        match self {
            Self::Straight { ends: [a, b], .. } => distance(*a, *b),
            Self::Bend { centre, from, turn } => distance(*centre, *from) * turn.abs() * FRAC_PI_2,
        }
    }

    /// The point `offset` (m) to the right of the middle line, `place` from 0 to 1 along.
    fn at(&self, place: f64, offset: f64) -> [f64; 2] {
        match self {
            Self::Straight { ends, right } => {
                let [a, b] = [0, 1].map(|k| [0, 1].map(|d| ends[k][d] + offset * right[k][d]));
                on_line(a, b, place)
            }
            Self::Bend { centre, from, turn } => {
                let ([c, s], [x, y]) = (cos_sin(turn * place), minus(*from, *centre));
                let radius = distance(*centre, *from);
                // To the right is outwards where it turns to the left.
                let scale = 1.0 + offset * turn.signum() / radius;
                [centre[0] + scale * (c * x - s * y), centre[1] + scale * (s * x + c * y)]
            }
        }
    }
}

impl Path {
    /// Number of corners between its straight parts.
    fn bends(&self) -> usize {
        if self.closed { self.points.len() } else { self.points.len().saturating_sub(2) }
    }

    /// Fewest elements along it.
    fn pieces_least(&self) -> usize {
        let straight = if self.closed { self.points.len() } else { self.points.len() - 1 };
        straight + if self.radius > 0.0 { self.bends() } else { 0 }
    }

    /// Unit vector along straight part `k` and its length.
    fn part(&self, k: usize) -> ([f64; 2], f64) {
        let n = self.points.len();
        let [a, b] = [self.points[k % n], self.points[(k + 1) % n]];
        let length = distance(a, b);
        (minus(b, a).map(|x| x / length), length)
    }

    /// Its pieces in order; every corner's cut is taken from the straight parts at it.
    fn pieces(&self) -> Result<Vec<Piece>, Wrong> {
        let n = self.points.len();
        let parts = if self.closed { n } else { n - 1 };
        let right = |[x, y]: [f64; 2]| [y, -x];
        let has_corner = |k: usize| self.closed || (1..n - 1).contains(&k);
        // Cosine and sine of the turn at corner `k`.
        let turn = |k: usize| {
            let (before, after) = (self.part(k + n - 1).0, self.part(k).0);
            [dot(before, after), cross(before, after)]
        };
        // Half the turn's tangent: what the bend cuts off the parts by radius, and the mitre by half the
        // width.
        let cut = |k: usize| if has_corner(k) { turn(k)[1].abs() / (1.0 + turn(k)[0]) } else { 0.0 };
        let mitre = |k: usize, own: [f64; 2]| {
            if self.radius > 0.0 || !has_corner(k) {
                return right(own);
            }
            let (before, after) = (right(self.part(k + n - 1).0), right(self.part(k).0));
            let sum = 1.0 + dot(before, after);
            [0, 1].map(|d| (before[d] + after[d]) / sum)
        };
        let mut pieces = Vec::new();
        for k in 0..parts {
            let ([x, y], length) = self.part(k);
            let next = (k + 1) % n;
            let [first, last] = [cut(k) * self.radius, cut(next) * self.radius];
            let rest = length - first - last;
            if rest < 1e-9 * length {
                let [a, b] = [self.points[k], self.points[next]];
                let message = format!(
                    "the bends at both ends of the part from ({:.6e}, {:.6e}) to ({:.6e}, {:.6e}) m take {:.6e} m, \
                        more than its length of {length:.6e} m",
                    a[0],
                    a[1],
                    b[0],
                    b[1],
                    first + last
                );
                return Err(Wrong::new("radius", message, "take a smaller radius, or move the points apart"));
            }
            let along = |from: [f64; 2], s: f64| [from[0] + s * x, from[1] + s * y];
            let ends = [along(self.points[k], first), along(self.points[next], -last)];
            let bent = self.radius > 0.0 && has_corner(next) && turn(next)[1] != 0.0;
            pieces.push(Piece::Straight { ends, right: [mitre(k, [x, y]), mitre(next, [x, y])] });
            if bent {
                let side = -self.radius * turn(next)[1].signum();
                let centre = [0, 1].map(|d| ends[1][d] + side * right([x, y])[d]);
                pieces.push(Piece::Bend { centre, from: ends[1], turn: quarters_of(turn(next)) });
            }
        }
        Ok(pieces)
    }
}

impl BuiltIn<2> for Path {
    fn read(values: &dyn Values) -> Self {
        Self {
            points: values.get("points"),
            width: values.get("width"),
            radius: values.get("radius"),
            closed: values.get("closed"),
            elements: values.get(ELEMENTS),
        }
    }

    fn check(&self, check: &mut dyn ShapeCheck) {
        check.number("width", self.width);
        if self.radius > 0.0 && self.radius <= 0.5 * self.width {
            let message =
                format!("a strip {} m wide can't be bent with a radius of {} m: its inside would fold over", self.width, self.radius);
            check.fault("radius", message, "take a radius of more than half the width, or 0 for mitred corners");
        }
        check.counts(ELEMENTS, &self.elements);
        self.check_line(check);
    }

    fn sides(&self) -> Vec<String> {
        ["left", "right", "start", "end"].into_iter().take(if self.closed { 2 } else { 4 }).map(String::from).collect()
    }

    fn count(&self) -> Count {
        Count::of_lattice(self.elements, self.closed)
    }

    fn body(&self) -> Result<Body<2>, Wrong> {
        let station = self.stations()?;
        let at = |i: usize, j: usize| station(j, self.width * (i as f64 / self.elements[0] as f64 - 0.5));
        let body = lattice(self.elements, self.closed, ["left", "right", "start", "end"], at);
        unfolded(body, "the strip is too wide for its bends: make it narrower, give the bends a radius, or move its points apart")
    }

    #[cfg(test)]
    fn examples(n: usize) -> Vec<(Self, f64)> {
        let points = vec![[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [4.0, 2.0]];
        let mitred = Self { points, width: 0.2, radius: 0.0, closed: false, elements: [2, 3 * n] };
        let length = 3.0 + 5.0_f64.sqrt();
        let square = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let frame = Self { points: square, closed: true, elements: [2, 4 * n], ..mitred.clone() };
        let round = Self { radius: 0.25, elements: [2, 4 * n], ..frame.clone() };
        let around = 4.0 - 8.0 * 0.25 + 0.5 * std::f64::consts::PI;
        vec![(mitred, 0.2 * length), (frame, 0.8), (round, 0.2 * around)]
    }
}

impl Path {
    /// Reports faults of its middle line.
    pub(super) fn check_line(&self, check: &mut dyn ShapeCheck) {
        let sound = check.points("points", &self.points);
        check.number("radius", self.radius);
        let least = if self.closed { 3 } else { 2 };
        if self.points.len() < least {
            check.fault(
                "points",
                format!("a path of this kind has at least {least} points, not {}", self.points.len()),
                "give more points",
            );
            return;
        }
        if !sound {
            return;
        }
        let n = self.points.len();
        let parts = if self.closed { n } else { n - 1 };
        if let Some(k) = (0..parts).find(|&k| self.part(k).1 == 0.0) {
            check.fault("points", format!("points {k} and {} are the same", (k + 1) % n), "leave one of them out");
            return;
        }
        let corners = if self.closed { 0..n } else { 1..n - 1 };
        if let Some(k) = corners.clone().find(|&k| dot(self.part(k + n - 1).0, self.part(k).0) < -0.999) {
            let [x, y] = self.points[k];
            check.fault(
                "points",
                format!("the path turns back at ({x:.6e}, {y:.6e}) m"),
                "give the turn a point more, so that it is a bend",
            );
            return;
        }
        if self.elements[1] < self.pieces_least() {
            let message = format!("{} elements along a path of {} straight parts and bends", self.elements[1], self.pieces_least());
            check.fault(ELEMENTS, message, "each of them needs one at least");
        }
    }

    /// The point of each row of nodes, an offset (m) to the right of the middle line.
    pub(super) fn stations(&self) -> Result<impl Fn(usize, f64) -> [f64; 2] + use<>, Wrong> {
        let pieces = self.pieces()?;
        let counts = shares(&pieces.iter().map(Piece::length).collect::<Vec<f64>>(), self.elements[1]);
        // Where each row of nodes lies: its piece, and how far along it.
        let mut rows: Vec<(usize, f64)> = Vec::with_capacity(self.elements[1] + 1);
        for (piece, &count) in counts.iter().enumerate() {
            rows.extend((0..count).map(|k| (piece, k as f64 / count as f64)));
        }
        rows.push((pieces.len() - 1, 1.0));
        Ok(move |row: usize, offset: f64| pieces[rows[row].0].at(rows[row].1, offset))
    }
}

/// `total` elements for pieces of these lengths: each at least one, the rest by length.
fn shares(lengths: &[f64], total: usize) -> Vec<usize> {
    let whole: f64 = lengths.iter().sum();
    let wanted: Vec<f64> = lengths.iter().map(|length| total as f64 * length / whole).collect();
    let mut counts: Vec<usize> = wanted.iter().map(|wanted| (wanted.floor() as usize).max(1)).collect();
    // Few are missing or too many: one per piece at most.
    let miss = |counts: &[usize], k: usize| wanted[k] - counts[k] as f64;
    while counts.iter().sum::<usize>() < total {
        let most = (0..counts.len()).reduce(|a, b| if miss(&counts, b) > miss(&counts, a) { b } else { a });
        counts[most.unwrap_or(0)] += 1;
    }
    while counts.iter().sum::<usize>() > total {
        let rich = (0..counts.len()).filter(|&k| counts[k] > 1);
        let Some(least) = rich.reduce(|a, b| if miss(&counts, b) < miss(&counts, a) { b } else { a }) else { break };
        counts[least] -= 1;
    }
    counts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_are_shared_by_length_and_none_goes_without() {
        assert_eq!(shares(&[1.0, 1.0, 2.0], 8), [2, 2, 4]);
        assert_eq!(shares(&[1e-9, 1.0, 1.0], 5), [1, 2, 2]);
        assert_eq!(shares(&[1.0, 1e-9, 1e-9], 3), [1, 1, 1]);
    }
}
