//! Vectors of the plane, of numbers or of lanes: the same text, and so the same bits, for both.

use embate_lanes::Lane;

#[inline(always)]
pub(crate) fn plus<L: Lane>(a: [L; 2], b: [L; 2]) -> [L; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

#[inline(always)]
pub(crate) fn minus<L: Lane>(a: [L; 2], b: [L; 2]) -> [L; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

#[inline(always)]
pub(crate) fn times<L: Lane>(factor: L, a: [L; 2]) -> [L; 2] {
    [factor * a[0], factor * a[1]]
}

#[inline(always)]
pub(crate) fn dot<L: Lane>(a: [L; 2], b: [L; 2]) -> L {
    a[0] * b[0] + a[1] * b[1]
}

#[inline(always)]
pub(crate) fn cross<L: Lane>(a: [L; 2], b: [L; 2]) -> L {
    a[0] * b[1] - a[1] * b[0]
}

/// Bound of a vector's length: the sum of its components' sizes.
#[inline(always)]
pub(crate) fn bound<L: Lane>(a: [L; 2]) -> L {
    a[0].abs() + a[1].abs()
}
