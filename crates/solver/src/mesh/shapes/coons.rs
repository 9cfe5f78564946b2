//! Curves and the surface between four of them.

use super::numbers::{cos_sin, cross, distance, dot, minus, on_line, quarters_of};
use std::f64::consts::FRAC_PI_2;

/// A curve from one point to another, by its arc length.
#[derive(Clone, Debug)]
pub(super) enum Curve {
    /// From point to point; how long it is up to each of them, m.
    Line { points: Vec<[f64; 2]>, lengths: Vec<f64> },
    /// A part of a circle: the ends, its centre, and the angle from the first to the second, quarter turns
    /// counter-clockwise.
    Arc { ends: [[f64; 2]; 2], centre: [f64; 2], turn: f64 },
}

impl Curve {
    /// From point to point.
    pub(super) fn line(points: Vec<[f64; 2]>) -> Self {
        let mut lengths = vec![0.0];
        for pair in points.windows(2) {
            lengths.push(lengths[lengths.len() - 1] + distance(pair[0], pair[1]));
        }
        Self::Line { points, lengths }
    }

    /// The arc through three points; `None` when they are on a line.
    pub(super) fn arc([a, b, c]: [[f64; 2]; 3]) -> Option<Self> {
        let (ab, ac) = (minus(b, a), minus(c, a));
        let twice = 2.0 * cross(ab, ac);
        // Flatter than the rounding of its points: a line.
        if !(twice.abs() > 1e-12 * (dot(ab, ab) + dot(ac, ac))) {
            return None;
        }
        let centre =
            [a[0] + (dot(ab, ab) * ac[1] - dot(ac, ac) * ab[1]) / twice, a[1] + (dot(ac, ac) * ab[0] - dot(ab, ab) * ac[0]) / twice];
        let (from, to) = (minus(a, centre), minus(c, centre));
        let turn = quarters_of([dot(from, to), cross(from, to)]);
        // The arc runs through the second point: counter-clockwise when the three turn so.
        let turn = if twice > 0.0 && turn < 0.0 {
            turn + 4.0
        } else if twice < 0.0 && turn > 0.0 {
            turn - 4.0
        } else {
            turn
        };
        Some(Self::Arc { ends: [a, c], centre, turn })
    }

    pub(super) fn length(&self) -> f64 {
        match self {
            Self::Line { lengths, .. } => lengths[lengths.len() - 1],
            Self::Arc { ends, centre, turn } => distance(*centre, ends[0]) * turn.abs() * FRAC_PI_2,
        }
    }

    /// The point after so much of its length, from 0 to 1; the ends are exact.
    pub(super) fn at(&self, place: f64) -> [f64; 2] {
        match self {
            Self::Line { points, lengths } => {
                let wanted = place * self.length();
                let k = lengths.partition_point(|&length| length <= wanted).clamp(1, points.len() - 1);
                if place == 1.0 {
                    return points[points.len() - 1];
                }
                on_line(points[k - 1], points[k], (wanted - lengths[k - 1]) / (lengths[k] - lengths[k - 1]))
            }
            Self::Arc { ends, .. } if place == 0.0 || place == 1.0 => ends[usize::from(place == 1.0)],
            Self::Arc { ends, centre, turn } => {
                let ([c, s], [x, y]) = (cos_sin(turn * place), minus(ends[0], *centre));
                [centre[0] + (c * x - s * y), centre[1] + (s * x + c * y)]
            }
        }
    }
}

/// A point of the surface between four curves `bottom`, `right`, `top` and `left`, of which bottom and top
/// run to the right and the others up (Coons 1967): P(u, v) = (1−v) B(u) + v T(u) + (1−u) L(v) + u R(v) − the
/// bilinear surface of the corners. On the curves it is exact.
pub(super) fn between([bottom, right, top, left]: &[Curve; 4], [u, v]: [f64; 2]) -> [f64; 2] {
    let on_curve = [(v == 0.0, bottom, u), (u == 1.0, right, v), (v == 1.0, top, u), (u == 0.0, left, v)];
    if let Some((_, curve, place)) = on_curve.into_iter().find(|(is_there, ..)| *is_there) {
        return curve.at(place);
    }
    let ([b, t], [l, r]) = ([bottom, top].map(|curve| curve.at(u)), [left, right].map(|curve| curve.at(v)));
    let corners = [bottom.at(0.0), bottom.at(1.0), top.at(1.0), top.at(0.0)];
    [0, 1].map(|d| {
        let ruled = (1.0 - v) * b[d] + v * t[d] + (1.0 - u) * l[d] + u * r[d];
        let [p, q, r, s] = corners.map(|corner| corner[d]);
        ruled - ((1.0 - u) * (1.0 - v) * p + u * (1.0 - v) * q + u * v * r + (1.0 - u) * v * s)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_arc_runs_through_its_three_points_whichever_way_it_turns() {
        let degrees = |d: f64| cos_sin(d / 90.0).map(|x| 3.0 * x + 1.0);
        for [a, b, c] in [[0.0, 30.0, 90.0], [0.0, 100.0, 350.0], [90.0, 30.0, 0.0], [10.0, -100.0, -340.0], [170.0, 180.0, 190.0]] {
            let arc = Curve::arc([a, b, c].map(degrees)).unwrap();
            assert!(distance(arc.at((b - a) / (c - a)), degrees(b)) < 1e-13, "{a} {b} {c}");
            assert_eq!((arc.at(0.0), arc.at(1.0)), (degrees(a), degrees(c)));
            assert!((arc.length() / (3.0 * (c - a).abs().to_radians()) - 1.0).abs() < 1e-13);
        }
        assert!(Curve::arc([[0.0, 0.0], [1.0, 1.0], [3.0, 3.0]]).is_none());
    }
}
