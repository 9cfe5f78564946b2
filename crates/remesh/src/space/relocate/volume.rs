//! The volume within an outline, and what nodes have to be moved by for it to be what it was.

use super::super::Point;
use super::super::face::{Face, Triangle, corners};
use super::super::vector::{cross, dot, minus};

/// Steps to the volume that is wanted.
const STEPS: usize = 12;
/// Part of the volume that rounding leaves.
const ROUND_OFF: f64 = 4e-16;

/// Volume within faces of positions, m³, about a place near them.
pub(super) fn volume(faces: &[Face], positions: &[Point], about: Point) -> f64 {
    let of = |triangle: Triangle| {
        let [a, b, c] = triangle.places(positions).map(|x| minus(x, about));
        dot(cross(a, b), c)
    };
    faces.iter().flat_map(Triangle::of).map(of).sum::<f64>() / 6.0
}

/// Derivative of the volume in the place of each node, m².
pub(super) fn slopes(faces: &[Face], positions: &[Point], about: Point) -> Vec<Point> {
    let mut found = vec![[0.0; 3]; positions.len()];
    for triangle in faces.iter().flat_map(Triangle::of) {
        let [a, b, c] = triangle.places(positions).map(|x| minus(x, about));
        let mut add = |node: u32, by: Point, part: f64| (0..3).for_each(|k| found[node as usize][k] += part / 6.0 * by[k]);
        let (first, second, last) = (cross(b, c), cross(c, a), cross(a, b));
        add(triangle.ends[0], first, 1.0);
        add(triangle.ends[1], second, 1.0);
        match corners(&triangle.face) {
            [_, _, third] => add(*third, last, 1.0),
            all => all.iter().for_each(|&node| add(node, last, 0.25)),
        }
    }
    found
}

/// Moves nodes by a part δ of `ways` such that the volume is `wanted`; false if that would be more than all
/// of it, or no more than rounding is off without.
pub(super) fn correct(faces: &[Face], positions: &mut [Point], ways: &[Point], about: Point, wanted: f64) -> bool {
    let start = positions.to_vec();
    let (mut part, mut best) = (0.0, (f64::INFINITY, 0.0));
    for _ in 0..STEPS {
        for (x, (from, way)) in positions.iter_mut().zip(start.iter().zip(ways)) {
            *x = [0, 1, 2].map(|k| from[k] + part * way[k]);
        }
        let off = volume(faces, positions, about) - wanted;
        if off.abs() < best.0 {
            best = (off.abs(), part);
        }
        if off.abs() <= ROUND_OFF * wanted {
            break;
        }
        let slope: f64 = slopes(faces, positions, about).iter().zip(ways).map(|(slope, way)| dot(*slope, *way)).sum();
        let step = off / slope;
        if !step.is_finite() || (part - step).abs() > 1.0 {
            break;
        }
        part -= step;
    }
    for (x, (from, way)) in positions.iter_mut().zip(start.iter().zip(ways)) {
        *x = [0, 1, 2].map(|k| if way[k] == 0.0 { from[k] } else { from[k] + best.1 * way[k] });
    }
    best.0 <= CLOSE * wanted
}

/// Part of the volume by which it may be off at most.
const CLOSE: f64 = 1e-13;
