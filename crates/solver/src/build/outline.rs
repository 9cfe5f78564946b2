//! Outlines of obstacles in 3D for pictures and files: points and facets, outward by the right-hand rule.

use crate::angle::cos_sin;
use crate::tensor::cross;
use crate::vector::{any_tangent, plus, times};
use std::f64::consts::{PI, TAU};

/// Points around, and from pole to pole.
const ROUND: usize = 48;

/// Points and facets.
pub(super) type Outline = (Vec<[f64; 3]>, Vec<[u32; 4]>);

/// Two unit vectors across a unit vector, right-handed with it.
fn across(axis: [f64; 3]) -> [[f64; 3]; 2] {
    let first = any_tangent(axis);
    [first, cross(axis, first)]
}

/// A piece of a plane through a point, so far to each side (m).
pub(super) fn square(middle: [f64; 3], normal: [f64; 3], half: f64) -> Outline {
    let [u, v] = across(normal);
    let corner = |a: f64, b: f64| plus(middle, plus(times(a * half, u), times(b * half, v)));
    (vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)], vec![[0, 1, 2, 3]])
}

/// A sphere; of a hollow one the facets look inwards.
pub(super) fn sphere(centre: [f64; 3], radius: f64, hollow: bool) -> Outline {
    let rows = ROUND / 2;
    let point = |i: usize, j: usize| {
        let ([c, s], [cos, sin]) = (cos_sin(PI * i as f64 / rows as f64), cos_sin(TAU * j as f64 / ROUND as f64));
        plus(centre, times(radius, [s * cos, s * sin, c]))
    };
    let points = (0..=rows).flat_map(|i| (0..ROUND).map(move |j| point(i, j))).collect();
    (points, tube(rows, hollow))
}

/// A piece of a cylinder, so far to either side of a point (m).
pub(super) fn cylinder(point: [f64; 3], axis: [f64; 3], radius: f64, hollow: bool, half: f64) -> Outline {
    let [u, v] = across(axis);
    let place = |i: usize, j: usize| {
        let [cos, sin] = cos_sin(TAU * j as f64 / ROUND as f64);
        let along = if i == 0 { half } else { -half };
        plus(point, plus(times(along, axis), plus(times(radius * cos, u), times(radius * sin, v))))
    };
    let points = (0..2).flat_map(|i| (0..ROUND).map(move |j| place(i, j))).collect();
    (points, tube(1, hollow))
}

/// Facets between rows of points around an axis, the first row at its tip.
fn tube(rows: usize, hollow: bool) -> Vec<[u32; 4]> {
    let number = |i: usize, j: usize| (i * ROUND + j % ROUND) as u32;
    let facet = |i: usize, j: usize| {
        let facet = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
        if hollow { [facet[3], facet[2], facet[1], facet[0]] } else { facet }
    };
    (0..rows).flat_map(|i| (0..ROUND).map(move |j| facet(i, j))).collect()
}
