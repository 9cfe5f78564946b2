//! Four-node quadrilaterals with 2 × 2 points: with mean dilatation (`quad4`) and without (`quad4_full`).
//!
//! ```text
//!   4 ---- 3      η
//!   |      |      |
//!   |      |      +-- ξ        N_a = ¼ (1 + ξ_a ξ)(1 + η_a η)
//!   1 ---- 2
//! ```
//!
//! A nodal vector u is written in its constant, two linear and one bilinear part: ∂u/∂ξ = a + η h, ∂u/∂η = b + ξ h with
//! a = ¼ Σ ξ_a u_a, b = ¼ Σ η_a u_a, h = ¼ Σ ξ_a η_a u_a. At 2 × 2 points only two values of each occur, which saves most of the work.
//! Source: Hughes, The Finite Element Method (1987), 3.2 and 4.5 (mean dilatation).

use super::{Element, ElementKind};
use crate::tensor::Matrix;
use embate_lanes::Lane;

const G: f64 = 0.577_350_269_189_625_8; // 1/√3
const POINTS: [[f64; 2]; 4] = [[-G, -G], [G, -G], [G, G], [-G, G]];
const NODES: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];

fn shape(natural: [f64; 2]) -> [f64; 4] {
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
fn distance_squared<L: Lane>(a: [L; 2], b: [L; 2]) -> L {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    dx * dx + dy * dy
}

#[inline(always)]
fn extent_squared<L: Lane>(x: &[[L; 2]; 4]) -> L {
    // Both diagonals and all four sides: in a dart-shaped element a side can be the longest.
    let mut longest = distance_squared(x[0], x[2]).max(distance_squared(x[1], x[3]));
    for a in 0..4 {
        longest = longest.max(distance_squared(x[a], x[(a + 1) % 4]));
    }
    longest
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
            fn extent_squared<L: Lane>(nodal: &[[L; 2]; 4]) -> L {
                extent_squared(nodal)
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
        nodes: 4,
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
        nodes: 4,
    }
);
