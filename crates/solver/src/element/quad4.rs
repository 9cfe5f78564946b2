//! Four-node quadrilaterals with 2 × 2 points: with mean dilatation (`quad4`) and without (`quad4_full`).
//!
//! ```text
//!   4 ---- 3      η
//!   |      |      |
//!   |      |      +-- ξ        N_a = ¼ (1 + ξ_a ξ)(1 + η_a η)
//!   1 ---- 2
//! ```
//!
//! A nodal vector u is written in its constant, two linear and one bilinear part: ∂u/∂ξ = a + η h,
//! ∂u/∂η = b + ξ h with a = ¼ Σ ξ_a u_a, b = ¼ Σ η_a u_a, h = ¼ Σ ξ_a η_a u_a. At 2 × 2 points only two
//! values of each occur, which saves most of the work. Source: Hughes, The Finite Element Method (1987), 3.2
//! and 4.5 (mean dilatation).

use super::{Element, ElementKind, ElementOptions, Map, Thickness};
use crate::mesh::cell::CellKind;
use crate::stress_state::StressState;
use crate::tensor::Matrix;
use embate_lanes::Lane;

const G: f64 = 0.577_350_269_189_625_8; // 1/√3
const POINTS: [[f64; 2]; 4] = [[-G, -G], [G, -G], [G, G], [-G, G]];
pub(super) const NODES: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];

pub(super) fn shape(natural: [f64; 2]) -> [f64; 4] {
    NODES.map(|[xi, eta]| 0.25 * (1.0 + xi * natural[0]) * (1.0 + eta * natural[1]))
}

#[inline(always)]
fn gradients<L: Lane>(u: &[[L; 2]; 4]) -> [Matrix<L, 2>; 4] {
    let quarter = L::splat(0.25);
    let mut out = [[[L::splat(0.0); 2]; 2]; 4];
    for i in 0..2 {
        let (diagonal_13, diagonal_24) = (u[2][i] - u[0][i], u[1][i] - u[3][i]);
        let a = (diagonal_13 + diagonal_24) * quarter;
        let b = (diagonal_13 - diagonal_24) * quarter;
        let h = ((u[0][i] + u[2][i]) - (u[1][i] + u[3][i])) * L::splat(0.25 * G);
        let (xi_low, xi_high) = (a - h, a + h); // ∂/∂ξ at η = −g and +g
        let (eta_left, eta_right) = (b - h, b + h); // ∂/∂η at ξ = −g and +g
        out[0][i] = [xi_low, eta_left];
        out[1][i] = [xi_low, eta_right];
        out[2][i] = [xi_high, eta_right];
        out[3][i] = [xi_high, eta_left];
    }
    out
}

#[inline(always)]
fn divergence<L: Lane>(flux: &[Matrix<L, 2>; 4]) -> [[L; 2]; 4] {
    let quarter = L::splat(0.25);
    let mut out = [[L::splat(0.0); 2]; 4];
    for i in 0..2 {
        let (low, high) = (flux[0][i][0] + flux[1][i][0], flux[2][i][0] + flux[3][i][0]); // of ∂/∂ξ at η = −g and +g
        let (left, right) = (flux[0][i][1] + flux[3][i][1], flux[1][i][1] + flux[2][i][1]); // of ∂/∂η at ξ = −g and +g
        let (a, b) = ((low + high) * quarter, (left + right) * quarter);
        let h = ((high - low) + (right - left)) * L::splat(0.25 * G);
        let (sum, difference) = (a + b, a - b);
        out[0][i] = h - sum;
        out[1][i] = difference - h;
        out[2][i] = h + sum;
        out[3][i] = -(difference + h);
    }
    out
}

#[inline(always)]
pub(super) fn distance_squared<L: Lane>(a: [L; 2], b: [L; 2]) -> L {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    dx * dx + dy * dy
}

/// h² = (V / ℓ)² (1 − q) / (1 + q/2), ℓ² = ½ (d₁₃² + d₂₄²) from the diagonals, q = (1 − 4 J_min / V)² from
/// the smallest determinant at a point.
///
/// Parallelogram (q = 0): E = ½ uᵀKu splits into the linear modes and the bilinear one, which is three times
/// softer. The linear part has two blocks, u_a = α ξ_a and u_a = β η_a; the largest eigenvalue of a positive
/// matrix of blocks is at most the sum of those of its diagonal blocks, ρc² V |∇ξ|² / m and ρc² V |∇η|² / m
/// (acoustic tensors of the two directions), and |∇ξ|² + |∇η|² = 4 ℓ² / V²: ω² ≤ 4 c² ℓ² / V².
///
/// Tapered: let the thickness grow along ξ as 1 + kξ. In a thin element only the stretch through the
/// thickness counts, δ = ½(1−ξ) δ₁ + ½(1+ξ) δ₂ with E ∝ Σ_p δ_p² / (1 + kξ_p), and ω² grows by (2 + √(1+k²))
/// / (3 − k²) ≤ (1 + q/2) / (1 − q), q = k²/3. Thicker elements and other forms stay below: k is the sum
/// |j_ξ| + |j_η| of the determinant's relative slopes (`the_stable_step_bounds_the_largest_frequency`
/// searches them all).
#[inline(always)]
fn characteristic_length_squared<L: Lane>(x: &[[L; 2]; 4], determinants: &[L; 4], volume: L) -> [L; 2] {
    let half = L::splat(0.5);
    let extent = (distance_squared(x[0], x[2]) + distance_squared(x[1], x[3])) * half;
    let least = determinants[0].min(determinants[1]).min(determinants[2].min(determinants[3]));
    let taper = volume - least * L::splat(4.0);
    let (square, taper) = (volume * volume, taper * taper);
    [square * (square - taper), extent * (square + taper * half)]
}

macro_rules! quadrilateral {
    ($(#[$doc:meta])* $name:ident, $mean:literal, $kind:expr) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl Element<2, 4, 4> for $name {
            const KIND: ElementKind = $kind;
            const POINTS: [[f64; 2]; 4] = POINTS;
            const WEIGHTS: [f64; 4] = [1.0; 4];
            const NODES: [[f64; 2]; 4] = NODES;
            const MEAN_DILATATION: bool = $mean;

            fn new(_options: &ElementOptions) -> Self {
                Self
            }
            fn shape(natural: [f64; 2]) -> [f64; 4] {
                shape(natural)
            }
            #[inline(always)]
            fn gradients<L: Lane>(nodal: &[[L; 2]; 4]) -> [Matrix<L, 2>; 4] {
                gradients(nodal)
            }
            #[inline(always)]
            fn divergence<L: Lane>(flux: &[Matrix<L, 2>; 4]) -> [[L; 2]; 4] {
                divergence(flux)
            }
            #[inline(always)]
            fn thickness<L: Lane>(nodal: &[[L; 2]; 4], map: &Map<L, 2, 4>, volume: L, _: &[[L; 2]; 4], _: StressState) -> Thickness<L> {
                let [numerator, denominator] = characteristic_length_squared(nodal, &map.determinants, volume);
                Thickness::of_waves(numerator, denominator)
            }
        }
    };
}

quadrilateral!(
    /// Mean dilatation: pressure constant in the element, deviator at four points.
    Quad4,
    true,
    ElementKind {
        name: "quad4",
        doc: "four-node quadrilateral, 2 x 2 points, mean dilatation; the default: no locking in plastic flow or rubber",
        source: "Hughes, The Finite Element Method (1987), 4.5; the paper's 4-node linear isoparametric",
        cell: CellKind::Quadrilateral,
        dimension: 2,
        extruded: Some("hex8"),
        is_default: false,
    }
);

quadrilateral!(
    /// Full integration: locks in plastic flow and near incompressibility; for teaching and comparison.
    Quad4Full,
    false,
    ElementKind {
        name: "quad4_full",
        doc: "four-node quadrilateral, 2 x 2 points, full integration; locks in plastic flow and rubber: for teaching and comparison only",
        source: "Hughes, The Finite Element Method (1987), 3.2",
        cell: CellKind::Quadrilateral,
        dimension: 2,
        extruded: None,
        is_default: false,
    }
);
