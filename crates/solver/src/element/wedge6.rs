//! Six-node wedges with 3 × 2 points and mean dilatation.
//!
//! ```text
//!        6
//!      / | \
//!     4 -|- 5        ζ      N_a = L_a (1 ∓ ζ)/2 with L = (1 − ξ − η, ξ, η);
//!     |  3  |        |  η   the normal of 1 2 3 by the right hand points to 4 5 6
//!     | / \ |        | /
//!     1 --- 2        +--- ξ
//! ```
//!
//! Points at ξ, η of 1/6 and 2/3 in the triangle, at ±1/√3 across: exact for the volume and the masses of any
//! wedge, warped faces too. The bound of the step wants coordinates in which the linear shapes are alike
//! ([`super::stiffest`]): those of an equilateral triangle, of a suitable height. With M = R Rᵀ, M⁻¹ = [[1,
//! ½], [½, 1]] in the triangle and 1/6 across, S has the eigenvalues of (r₁r₁ᵀ + r₂r₂ᵀ + ½ (r₁r₂ᵀ + r₂r₁ᵀ) +
//! r₃r₃ᵀ/6) / det, and ½ (r₁r₁ᵀ + r₂r₂ᵀ + (r₁ + r₂)(r₁ + r₂)ᵀ) is the first part. The remaining shapes,
//! linear in the triangle times ζ, have 1/3 + 1/4 < 1 of it. Source: Hughes, The Finite Element Method
//! (1987), 3.I and 4.5 (mean dilatation).

use super::stiffest::{Metric, Thickness};
use super::{Element, ElementKind, ElementOptions, Map};
use crate::mesh::cell::CellKind;
use crate::stress_state::StressState;
use crate::tensor::Matrix;
use embate_lanes::Lane;

const G: f64 = 0.577_350_269_189_625_8; // 1/√3
const S: f64 = 1.0 / 6.0;
const T: f64 = 2.0 / 3.0;

/// Six nodes, mean dilatation.
#[derive(Clone, Copy, Debug)]
pub struct Wedge6;

impl Element<3, 6, 6> for Wedge6 {
    const KIND: ElementKind = ElementKind {
        name: "wedge6",
        doc: "six-node wedge, 3 x 2 points, mean dilatation: where hexahedra do not fit",
        source: "Hughes, The Finite Element Method (1987), 3.I and 4.5",
        cell: CellKind::Wedge,
        dimension: 3,
        extruded: None,
        is_default: true,
    };
    const POINTS: [[f64; 3]; 6] = [[S, S, -G], [T, S, -G], [S, T, -G], [S, S, G], [T, S, G], [S, T, G]];
    const WEIGHTS: [f64; 6] = [S; 6];
    const NODES: [[f64; 3]; 6] = [[0.0, 0.0, -1.0], [1.0, 0.0, -1.0], [0.0, 1.0, -1.0], [0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]];
    const MEAN_DILATATION: bool = true;

    fn new(_options: &ElementOptions) -> Self {
        Self
    }
    fn shape([xi, eta, zeta]: [f64; 3]) -> [f64; 6] {
        let (low, high) = (0.5 * (1.0 - zeta), 0.5 * (1.0 + zeta));
        let first = 1.0 - xi - eta;
        [first * low, xi * low, eta * low, first * high, xi * high, eta * high]
    }

    #[inline(always)]
    fn gradients<L: Lane>(u: &[[L; 3]; 6]) -> [Matrix<L, 3>; 6] {
        let (near, far, half) = (L::splat(0.5 * (1.0 + G)), L::splat(0.5 * (1.0 - G)), L::splat(0.5));
        let (sixth, two_thirds) = (L::splat(S), L::splat(T));
        let mut out = [[[L::splat(0.0); 3]; 3]; 6];
        for i in 0..3 {
            let (xi_low, xi_high) = (u[1][i] - u[0][i], u[4][i] - u[3][i]);
            let (eta_low, eta_high) = (u[2][i] - u[0][i], u[5][i] - u[3][i]);
            let xi = [xi_low * near + xi_high * far, xi_low * far + xi_high * near];
            let eta = [eta_low * near + eta_high * far, eta_low * far + eta_high * near];
            let across = [(u[3][i] - u[0][i]) * half, (u[4][i] - u[1][i]) * half, (u[5][i] - u[2][i]) * half];
            let sum = (across[0] + across[1] + across[2]) * sixth;
            for k in 0..3 {
                // 1/6 of each, and ½ more of its own.
                let zeta = sum + across[k] * (two_thirds - sixth);
                out[k][i] = [xi[0], eta[0], zeta];
                out[3 + k][i] = [xi[1], eta[1], zeta];
            }
        }
        out
    }

    #[inline(always)]
    fn divergence<L: Lane>(flux: &[Matrix<L, 3>; 6]) -> [[L; 3]; 6] {
        let (near, far, half) = (L::splat(0.5 * (1.0 + G)), L::splat(0.5 * (1.0 - G)), L::splat(0.5));
        let (sixth, two_thirds) = (L::splat(S), L::splat(T));
        let mut out = [[L::splat(0.0); 3]; 6];
        for i in 0..3 {
            let xi = [flux[0][i][0] + flux[1][i][0] + flux[2][i][0], flux[3][i][0] + flux[4][i][0] + flux[5][i][0]];
            let eta = [flux[0][i][1] + flux[1][i][1] + flux[2][i][1], flux[3][i][1] + flux[4][i][1] + flux[5][i][1]];
            let zeta = [flux[0][i][2] + flux[3][i][2], flux[1][i][2] + flux[4][i][2], flux[2][i][2] + flux[5][i][2]];
            let sum = (zeta[0] + zeta[1] + zeta[2]) * sixth;
            let mut across = zeta;
            for k in 0..3 {
                across[k] = (sum + zeta[k] * (two_thirds - sixth)) * half;
            }
            let (xi_low, xi_high) = (xi[0] * near + xi[1] * far, xi[0] * far + xi[1] * near);
            let (eta_low, eta_high) = (eta[0] * near + eta[1] * far, eta[0] * far + eta[1] * near);
            (out[0][i], out[1][i], out[2][i]) = (-(xi_low + eta_low + across[0]), xi_low - across[1], eta_low - across[2]);
            (out[3][i], out[4][i], out[5][i]) = (across[0] - (xi_high + eta_high), xi_high + across[1], eta_high + across[2]);
        }
        out
    }

    #[inline(always)]
    fn thickness<L: Lane>(_: &[[L; 3]; 6], map: &Map<L, 3, 6>, volume: L, _: &[[L; 3]; 6], _: StressState) -> Thickness<L> {
        let (scale, height) = (L::splat(0.5f64.sqrt()), L::splat((1.0 / 6.0f64).sqrt()));
        let (mut trace, mut spread) = (L::splat(0.0), L::splat(0.0));
        for p in 0..6 {
            let inverse = L::splat(1.0) / map.determinants[p];
            let [mut a, mut b, mut c] = map.adjugates[p];
            let mut both = a;
            for i in 0..3 {
                (a[i], b[i], c[i]) = (a[i] * scale, b[i] * scale, c[i] * height);
                both[i] = a[i] + b[i];
            }
            let own = Metric::of(a).and(b).and(both).and(c).spectrum();
            trace = trace.max(own[0] * inverse);
            spread = spread.max(own[1] * (inverse * inverse));
        }
        Thickness::of_points(volume * L::splat(4.0 / 6.0), [trace, spread])
    }
}
