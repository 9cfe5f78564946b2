//! Vectors in 2D and 3D, of numbers or of lanes: one source for both, and so the same bits.
//!
//! Sums run from the first component to the last.

use embate_lanes::Lane;

/// The first components of a vector of the model, which has three: all of them in 3D, x and y in
/// 2D.
#[must_use]
pub(crate) fn first<const D: usize>(of: [f64; 3]) -> [f64; D] {
    std::array::from_fn(|d| of[d])
}

#[inline(always)]
pub(crate) fn plus<L: Lane, const D: usize>(mut a: [L; D], b: [L; D]) -> [L; D] {
    for d in 0..D {
        a[d] += b[d];
    }
    a
}

#[inline(always)]
pub(crate) fn minus<L: Lane, const D: usize>(mut a: [L; D], b: [L; D]) -> [L; D] {
    for d in 0..D {
        a[d] = a[d] - b[d];
    }
    a
}

#[inline(always)]
pub(crate) fn times<L: Lane, const D: usize>(factor: L, mut a: [L; D]) -> [L; D] {
    for d in 0..D {
        a[d] = factor * a[d];
    }
    a
}

#[inline(always)]
pub(crate) fn dot<L: Lane, const D: usize>(a: [L; D], b: [L; D]) -> L {
    let mut sum = a[0] * b[0];
    for d in 1..D {
        sum += a[d] * b[d];
    }
    sum
}

/// Bound of the sum of the sizes of a vector's components, the same in every frame: √2 times its length.
#[inline]
pub(crate) fn bound_of(a: [f64; 2]) -> f64 {
    std::f64::consts::SQRT_2 * dot(a, a).sqrt()
}

/// Length of a vector.
pub(crate) fn length<const D: usize>(a: [f64; D]) -> f64 {
    dot(a, a).sqrt()
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

/// Where the entry i, j of a symmetric matrix is in its upper triangle, row by row.
pub(crate) const SYMMETRIC: [[usize; 3]; 3] = [[0, 1, 2], [1, 3, 4], [2, 4, 5]];

/// A symmetric matrix (its upper triangle row by row) times a vector.
#[inline(always)]
pub(crate) fn times_symmetric(&[xx, xy, xz, yy, yz, zz]: &[f64; 6], [x, y, z]: [f64; 3]) -> [f64; 3] {
    [xx * x + xy * y + xz * z, xy * x + yy * y + yz * z, xz * x + yz * y + zz * z]
}

/// A unit vector at right angles to a unit vector.
#[must_use]
pub(crate) fn any_tangent(normal: [f64; 3]) -> [f64; 3] {
    // The axis that is farthest from it.
    let [x, y, z] = normal.map(f64::abs);
    let axis = if x <= y && x <= z {
        [1.0, 0.0, 0.0]
    } else if y <= z {
        [0.0, 1.0, 0.0]
    } else {
        [0.0, 0.0, 1.0]
    };
    let across = crate::tensor::cross(normal, axis);
    let length = dot(across, across).sqrt();
    if length > 0.0 { across.map(|c| c / length) } else { [0.0; 3] }
}

/// Unit vector; `None` for a vector without direction.
#[must_use]
pub(crate) fn unit<const D: usize>(v: [f64; D]) -> Option<[f64; D]> {
    let length = dot(v, v).sqrt();
    (length > 0.0 && length.is_finite()).then(|| v.map(|component| component / length))
}

/// A point in words, by the components that the dimension has.
#[must_use]
pub(crate) fn place<const D: usize>(x: [f64; D]) -> String {
    let components: Vec<String> = x.iter().map(|component| format!("{component:.6e}")).collect();
    format!("({})", components.join(", "))
}
