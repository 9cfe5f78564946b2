//! Eight-node hexahedra with 2 × 2 × 2 points and mean dilatation.
//!
//! ```text
//!      8 ---- 7        ζ   η
//!     /|     /|        |  /
//!    5 ---- 6 |        | /
//!    | 4 ---| 3        +----- ξ        N_a = ⅛ (1 + ξ_a ξ)(1 + η_a η)(1 + ζ_a ζ)
//!    |/     |/
//!    1 ---- 2
//! ```
//!
//! A nodal vector u is written in its parts ([`Parts`]): constant, linear a b c, bilinear h₁ (ηζ) h₂ (ζξ) h₃
//! (ξη), trilinear h₄ (ξηζ), each Σ_a of its pattern times u_a, so that ∂u/∂ξ = ⅛ (a + h₃ η + h₂ ζ + h₄ ηζ).
//! At 2 × 2 × 2 points only four values of each derivative occur, which saves most of the work. Source:
//! Hughes, The Finite Element Method (1987), 3.5 and 4.5 (mean dilatation).

use super::stiffest::{Metric, Thickness};
use super::{Element, ElementKind, ElementOptions, Map};
use crate::mesh::cell::CellKind;
use crate::stress_state::StressState;
use crate::tensor::Matrix;
use embate_lanes::Lane;

const G: f64 = 0.577_350_269_189_625_8; // 1/√3
#[rustfmt::skip]
pub(super) const NODES: [[f64; 3]; 8] = [
    [-1.0, -1.0, -1.0], [1.0, -1.0, -1.0], [1.0, 1.0, -1.0], [-1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 1.0, 1.0], [-1.0, 1.0, 1.0],
];
#[rustfmt::skip]
const POINTS: [[f64; 3]; 8] = [
    [-G, -G, -G], [G, -G, -G], [G, G, -G], [-G, G, -G],
    [-G, -G, G], [G, -G, G], [G, G, G], [-G, G, G],
];

pub(super) fn shape(natural: [f64; 3]) -> [f64; 8] {
    NODES.map(|[xi, eta, zeta]| 0.125 * (1.0 + xi * natural[0]) * (1.0 + eta * natural[1]) * (1.0 + zeta * natural[2]))
}

/// Linear and other parts of one component of a nodal vector, eight times what they are to the natural
/// coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parts<L> {
    /// Along ξ, η, ζ.
    pub(super) linear: [L; 3],
    /// Along ηζ, ζξ, ξη.
    pub(super) bilinear: [L; 3],
    /// Along ξηζ.
    pub(super) trilinear: L,
}

impl<L: Lane> Parts<L> {
    /// Of component `i`.
    #[inline(always)]
    pub(super) fn of(u: &[[L; 3]; 8], i: usize) -> Self {
        let (sum_0, sum_1) = (u[1][i] + u[0][i], u[2][i] + u[3][i]);
        let (sum_2, sum_3) = (u[5][i] + u[4][i], u[6][i] + u[7][i]);
        let (along_0, along_1) = (u[1][i] - u[0][i], u[2][i] - u[3][i]);
        let (along_2, along_3) = (u[5][i] - u[4][i], u[6][i] - u[7][i]);
        let (xi_low, xi_high) = (along_0 + along_1, along_2 + along_3);
        let (eta_low, eta_high) = (sum_1 - sum_0, sum_3 - sum_2);
        let (twist_low, twist_high) = (along_1 - along_0, along_3 - along_2);
        Self {
            linear: [xi_high + xi_low, eta_high + eta_low, (sum_2 + sum_3) - (sum_0 + sum_1)],
            bilinear: [eta_high - eta_low, xi_high - xi_low, twist_high + twist_low],
            trilinear: twist_high - twist_low,
        }
    }

    /// Of component `i` of what [`Element::natural`] made.
    #[inline(always)]
    pub(super) fn from(natural: &[[L; 3]; 8], i: usize) -> Self {
        let [a, b, c, d, e, f, g, _] = *natural;
        Self { linear: [a[i], b[i], c[i]], bilinear: [d[i], e[i], f[i]], trilinear: g[i] }
    }

    /// The transpose of [`Parts::of`]: what the parts spend, spent by the nodes.
    #[inline(always)]
    pub(super) fn spread(&self, out: &mut [[L; 3]; 8], i: usize) {
        let ([a, b, c], [h_1, h_2, h_3]) = (self.linear, self.bilinear);
        let (xi_low, xi_high) = (a - h_2, a + h_2);
        let (eta_low, eta_high) = (b - h_1, b + h_1);
        let (twist_low, twist_high) = (h_3 - self.trilinear, h_3 + self.trilinear);
        let (sum_0, sum_1) = (-(c + eta_low), eta_low - c);
        let (sum_2, sum_3) = (c - eta_high, c + eta_high);
        let (along_0, along_1) = (xi_low - twist_low, xi_low + twist_low);
        let (along_2, along_3) = (xi_high - twist_high, xi_high + twist_high);
        (out[0][i], out[1][i]) = (sum_0 - along_0, sum_0 + along_0);
        (out[2][i], out[3][i]) = (sum_1 + along_1, sum_1 - along_1);
        (out[4][i], out[5][i]) = (sum_2 - along_2, sum_2 + along_2);
        (out[6][i], out[7][i]) = (sum_3 + along_3, sum_3 - along_3);
    }
}

/// [`Element::PARTS`] and [`Element::natural`] of hexahedra: linear, bilinear and trilinear parts.
pub(super) const PARTS: usize = 7;

#[inline(always)]
pub(super) fn natural<L: Lane>(u: &[[L; 3]; 8]) -> [[L; 3]; 8] {
    let mut out = [[L::splat(0.0); 3]; 8];
    for i in 0..3 {
        let parts = Parts::of(u, i);
        for k in 0..3 {
            out[k][i] = parts.linear[k];
            out[3 + k][i] = parts.bilinear[k];
        }
        out[6][i] = parts.trilinear;
    }
    out
}

/// The two points along each direction, at the low and high values of the last coordinate, and in it of the
/// next one in turn: after ξ come η and ζ.
const ALONG: [[[[usize; 2]; 2]; 2]; 3] =
    [[[[0, 1], [3, 2]], [[4, 5], [7, 6]]], [[[0, 3], [4, 7]], [[1, 2], [5, 6]]], [[[0, 4], [1, 5]], [[3, 7], [2, 6]]]];

/// Does the work for each direction, straight on, so that places in lists are known to the compiler.
macro_rules! each_direction {
    ($k:ident, $work:block) => { each_direction!(@ 0 1 2, $k, $work) };
    (@ $($direction:literal)*, $k:ident, $work:block) => {
        $({
            const $k: usize = $direction;
            $work
        })*
    };
}

/// Mean dilatation: pressure constant in the element, deviator at eight points.
#[derive(Clone, Copy, Debug)]
pub struct Hex8;

impl Element<3, 8, 8> for Hex8 {
    const KIND: ElementKind = ElementKind {
        name: "hex8",
        doc: "eight-node hexahedron, 2 x 2 x 2 points, mean dilatation; no locking in plastic flow or rubber",
        source: "Hughes, The Finite Element Method (1987), 3.5 and 4.5",
        cell: CellKind::Hexahedron,
        dimension: 3,
        extruded: None,
        is_default: false,
    };
    const POINTS: [[f64; 3]; 8] = POINTS;
    const WEIGHTS: [f64; 8] = [1.0; 8];
    const NODES: [[f64; 3]; 8] = NODES;
    const MEAN_DILATATION: bool = true;

    fn new(_options: &ElementOptions) -> Self {
        Self
    }
    fn shape(natural: [f64; 3]) -> [f64; 8] {
        shape(natural)
    }

    const PARTS: usize = PARTS;
    #[inline(always)]
    fn natural<L: Lane>(nodal: &[[L; 3]; 8]) -> [[L; 3]; 8] {
        natural(nodal)
    }
    #[inline(always)]
    fn gradients<L: Lane>(natural: &[[L; 3]; 8]) -> [Matrix<L, 3>; 8] {
        let (eighth, first, second) = (L::splat(0.125), L::splat(0.125 * G), L::splat(0.125 * G * G));
        let mut out = [[[L::splat(0.0); 3]; 3]; 8];
        for i in 0..3 {
            let Parts { linear, bilinear, trilinear } = Parts::from(natural, i);
            let h = [bilinear[0] * first, bilinear[1] * first, bilinear[2] * first];
            let twist = trilinear * second;
            each_direction!(K, {
                // The derivative by coordinate k at low and high values of the next two.
                let ((next, last), centre) = ((h[(K + 2) % 3], h[(K + 1) % 3]), linear[K] * eighth);
                let (below, above) = (centre - last, centre + last);
                let (low, high) = (next - twist, next + twist);
                let [[[a, b], [c, d]], [[e, f], [g, h]]] = ALONG[K];
                (out[a][i][K], out[c][i][K]) = (below - low, below + low);
                (out[b][i][K], out[d][i][K]) = (out[a][i][K], out[c][i][K]);
                (out[e][i][K], out[g][i][K]) = (above - high, above + high);
                (out[f][i][K], out[h][i][K]) = (out[e][i][K], out[g][i][K]);
            });
        }
        out
    }

    #[inline(always)]
    fn divergence<L: Lane>(flux: &[Matrix<L, 3>; 8]) -> [[L; 3]; 8] {
        let zero = L::splat(0.0);
        let (eighth, first, second) = (L::splat(0.125), L::splat(0.125 * G), L::splat(0.125 * G * G));
        let mut out = [[zero; 3]; 8];
        for i in 0..3 {
            let mut parts = Parts { linear: [zero; 3], bilinear: [zero; 3], trilinear: zero };
            each_direction!(K, {
                let [[[a, b], [c, d]], [[e, f], [g, h]]] = ALONG[K];
                let values = [
                    [flux[a][i][K] + flux[b][i][K], flux[c][i][K] + flux[d][i][K]],
                    [flux[e][i][K] + flux[f][i][K], flux[g][i][K] + flux[h][i][K]],
                ];
                let (below, above) = (values[0][0] + values[0][1], values[1][0] + values[1][1]);
                let (low, high) = (values[0][1] - values[0][0], values[1][1] - values[1][0]);
                parts.linear[K] = (above + below) * eighth;
                parts.bilinear[(K + 1) % 3] += (above - below) * first;
                parts.bilinear[(K + 2) % 3] += (high + low) * first;
                parts.trilinear += (high - low) * second;
            });
            parts.spread(&mut out, i);
        }
        out
    }

    #[inline(always)]
    fn thickness<L: Lane>(_: &[[L; 3]; 8], map: &Map<L, 3, 8>, volume: L, _: &[[L; 3]; 8], _: StressState) -> Thickness<L> {
        let (mut trace, mut spread) = (L::splat(0.0), L::splat(0.0));
        for p in 0..8 {
            let inverse = L::splat(1.0) / map.determinants[p];
            let [a, b, c] = map.adjugates[p];
            let own = Metric::of(a).and(b).and(c).spectrum();
            trace = trace.max(own[0] * inverse);
            spread = spread.max(own[1] * (inverse * inverse));
        }
        Thickness::of_points(volume * L::splat(0.5), [trace, spread])
    }
}
