//! What bounds the stable step of shells in 3D: m ω² of motion in the plane of an element and across it, and
//! both together.

use super::Facts;
use super::surface::{Frame, Vector, arc};
use crate::tensor::{Dim, Matrix, Space, dot, product};
use embate_lanes::Lane;

/// Larger eigenvalue of the product of two symmetric matrices that are positive semidefinite.
#[inline(always)]
pub(super) fn largest<L: Lane>(a: &Matrix<L, 2>, b: &Matrix<L, 2>) -> L {
    let half = L::splat(0.5);
    let both = product(a, b);
    let middle = half * (both[0][0] + both[1][1]);
    let part = middle * middle - Dim::<2>::determinant(&both);
    middle + part.max(L::splat(0.0)).sqrt()
}

/// The metric g^αβ = Σ_i (G⁻¹)_αi (G⁻¹)_βi.
#[inline(always)]
pub(super) fn metric<L: Lane>(g: &Matrix<L, 2>) -> Matrix<L, 2> {
    let mixed = g[0][0] * g[1][0] + g[0][1] * g[1][1];
    [[g[0][0] * g[0][0] + g[0][1] * g[0][1], mixed], [mixed, g[1][0] * g[1][0] + g[1][1] * g[1][1]]]
}

/// Larger eigenvalue of a symmetric matrix.
#[inline(always)]
pub(super) fn steepest<L: Lane>(m: &Matrix<L, 2>) -> L {
    let difference = m[0][0] - m[1][1];
    let root = (difference * difference + L::splat(4.0) * m[0][1] * m[0][1]).sqrt();
    L::splat(0.5) * (m[0][0] + m[1][1] + root)
}

/// Moduli of layers with laws of their own, from the largest of each: one that is soft in shear may be stiff
/// against stretches in both directions.
#[inline(always)]
pub(super) fn of_layers<L: Lane>(facts: &Facts, [membrane, shear, across]: [L; 3]) -> [L; 3] {
    if facts.is_limited {
        let [membrane, shear, across] = facts.moduli;
        return [L::splat(membrane), L::splat(shear), L::splat(across)];
    }
    [membrane + L::splat(2.0) * shear, shear, across]
}

/// C V (max(1 − s, 0) T + s Λ) with the trace T and the larger eigenvalue Λ of the metric, s = 2 µ/C: what
/// no strain in the plane has more of, N/m.
#[inline(always)]
pub(super) fn membrane<L: Lane>(metric: &Matrix<L, 2>, [modulus, shear]: [L; 2], volume: L) -> L {
    let part = L::splat(2.0) * shear / modulus;
    let trace = metric[0][0] + metric[1][1];
    modulus * volume * ((L::splat(1.0) - part).max(L::splat(0.0)) * trace + part * steepest(metric))
}

/// From m ω² in the plane a and across it p, and the cosine c between both, that of all: ½ (a' + p + √((a' −
/// p)² + 4 a' p c'²)). `tilted` is what the membrane adds to rotations where the mean director is not normal
/// to the element, τ: a' = a + τ, c' = c + √(τ/a').
#[inline(always)]
pub(super) fn joined<L: Lane>([a, p, cosine]: [L; 3], tilted: L) -> L {
    let a = a + tilted;
    let cosine = L::splat(1.0).min(cosine + (tilted / a).sqrt());
    let difference = a - p;
    L::splat(0.5) * (a + p + (difference * difference + L::splat(4.0) * a * p * cosine * cosine).sqrt())
}

/// C V |t|²/(|d₀|² α) with the slope t_j = Σ_α n̂·g_α (G⁻¹)_αj of an element against its mean director: G
/// changes by it when that rotates.
#[inline(always)]
pub(super) fn tilted<L: Lane>(frame: &Frame<L>, g: &[Vector<L>; 2], inverse: &Matrix<L, 2>, stiffness: L, inertia: L) -> L {
    let normal = frame.axes[2];
    let (one, two) = (dot(normal, g[0]), dot(normal, g[1]));
    let (a, b) = (one * inverse[0][0] + two * inverse[1][0], one * inverse[0][1] + two * inverse[1][1]);
    stiffness * (a * a + b * b) * frame.shortening * frame.shortening * (L::splat(1.0) / inertia)
}

/// Square of what a change of the directors changes of w d_α at most: (w + |w'| |d_α|)².
#[inline(always)]
pub(super) fn folding<L: Lane>(mean: Vector<L>, d: &[Vector<L>; 2], n: f64) -> L {
    let [w, slope] = arc(dot(mean, mean).sqrt(), n);
    let most = w + slope.abs() * (dot(d[0], d[0]) + dot(d[1], d[1])).sqrt();
    most * most
}

/// m ω² that stresses add by turning with the nodes: S ½ (1/α + √(1/α² + 4 `gradient`/α)) with S = Σ V |σ|
/// and the largest square of a gradient by the mass, N/m.
#[inline(always)]
pub(super) fn taut<L: Lane>(strained: L, gradient: L, inertia: L) -> L {
    let turning = L::splat(1.0) / inertia;
    L::splat(0.5) * strained * (turning + (turning * (turning + L::splat(4.0) * gradient)).sqrt())
}

/// Inertia of a corner by its mass, m²: the least above t²/12 with which the motion in the plane decides the
/// step, at least the part `least` of the area (m²) and, where it does not follow, a quarter of that;
/// `bounds` are those of [`joined`].
pub(super) fn inertia(thickness: f64, area: f64, least: f64, bounds: impl Fn(f64) -> [f64; 3]) -> f64 {
    let least = (thickness * thickness / 12.0).max(least * area);
    let governs = |inertia: f64| {
        let [plane, plate, _] = bounds(inertia);
        plate <= plane
    };
    let most = least.max(0.25 * area);
    if governs(least) || !governs(most) {
        return if governs(least) { least } else { most };
    }
    let (mut low, mut high) = (least, most);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if governs(middle) { high = middle } else { low = middle }
    }
    high
}
