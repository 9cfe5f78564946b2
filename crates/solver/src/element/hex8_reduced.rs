//! Eight-node hexahedra with one point: fast, free of locking, and blind to twelve hourglass shapes, which
//! need a control of their own.
//!
//! The gradient at the point is the exact mean over the element, B_a/V with B_a = ∂V/∂x_a: that at the centre
//! fails the patch test on warped hexahedra. With the parts of [`super::hex8`], linear a b c and bilinear h₁
//! h₂ h₃ (the trilinear one adds nothing), each the sum over the nodes without the factor ⅛,
//!
//! ```text
//! 64 V = D = a·(b×c) + ⅓ (a·(h₃×h₂) + b·(h₁×h₃) + c·(h₂×h₁))
//! ∂D/∂a = b×c − ⅓ h₂×h₃,   ∂D/∂h₁ = ⅓ (c×h₂ − b×h₃),   and in turn,      V ∇u = Σ_parts u_part ⊗ ∂V/∂part
//! ```
//!
//! which costs less than the 24 components of B_a. Hyperelastic laws get F in the same way from the parts of
//! the start.
//!
//! Hourglass patterns are h_α = ηζ, ζξ, ξη, ξηζ at the nodes; γ_α = h_α − Σ_k c_αk ξ_k with c_α J = the part
//! α of the positions (J = [a b c]) is blind to linear fields, q_α = ⅛ γ_α·x. M = K + 4µ/3, V the volume, m
//! the mass, T = V Σ_a |∇N_a|² of the mean gradients:
//!
//! - `stiffness`: W = ½ k Σ_α |q_α|², k = (8/3) κ M' T, all of the start. q is zero there, |q| does not know
//!   rotations, and forces are the gradient: the control gives back what it took, with momentum and angular
//!   momentum, whatever becomes of the element. With κ = 1 and M' = M the patterns swing as fast as the
//!   stretch of a cube. The source takes rates and M' = M; here M' is at most 4µ, because with M a κ of 0.05
//!   locks what is nearly incompressible (see `quad4_reduced.rs`). Of a fluid it is M.
//! - `viscous`: Q_α = 2 κ √(k₁ m) q̇_α with the γ of the present form and k₁ = (8/3) M' T: the part κ of
//!   critical damping. Shapes that are there remain. q̇ is taken at mid-step and turned with the point.
//! - `assumed_strain`: [`super::hex8_assumed_strain`].
//!
//! The stable step: γ_α·γ_β = 8 (δ_αβ + Σ_k c_αk c_βk), so the patterns add at most ω_h² = (k/m)(1 + Σ c²) to
//! the square of the largest frequency, about 2 % of it; dampers, which lag half a step, 2 d / Δt with
//! d = (2κ√(k₁ m)/m)(1 + Σ c²).
//!
//! Sources: Flanagan and Belytschko, Int. J. Numer. Meth. Engng 17 (1981) 679-706, and J. Appl. Mech. 51
//! (1984) 35-40.

use super::hex8::{self, Hex8, Parts};
use super::hex8_assumed_strain::{self, bend};
use super::stiffest::{Metric, Thickness};
use super::{Corners, Element, ElementKind, ElementOptions, Held, Map, PATTERNS, Pulls};
use crate::mesh::cell::CellKind;
use crate::stress_state::StressState;
use crate::tensor::{Dim, Matrix, Space, cross, dot, scaled};
use embate_lanes::{Batch, Lane};

/// Natural coordinates in which derivatives are sums over the nodes without a factor.
const EDGE: f64 = 0.125;
#[rustfmt::skip]
const NODES: [[f64; 3]; 8] = [
    [-EDGE, -EDGE, -EDGE], [EDGE, -EDGE, -EDGE], [EDGE, EDGE, -EDGE], [-EDGE, EDGE, -EDGE],
    [-EDGE, -EDGE, EDGE], [EDGE, -EDGE, EDGE], [EDGE, EDGE, EDGE], [-EDGE, EDGE, EDGE],
];

/// What holds an element against hourglass shapes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Control {
    Stiffness,
    Viscous,
    AssumedStrain,
}

/// What the potential keeps: c_αk, k and ω_h² m of the start.
const POTENTIAL: usize = 14;
/// What dampers keep: Q_α.
const DAMPERS: usize = 12;

/// r × s − t × u.
#[inline(always)]
fn difference<L: Lane>(r: [L; 3], s: [L; 3], t: [L; 3], u: [L; 3]) -> [L; 3] {
    let (one, other) = (cross(r, s), cross(t, u));
    [one[0] - other[0], one[1] - other[1], one[2] - other[2]]
}

/// Columns of a matrix.
#[inline(always)]
pub(super) fn columns<L: Lane>(m: &Matrix<L, 3>) -> [[L; 3]; 3] {
    [[m[0][0], m[1][0], m[2][0]], [m[0][1], m[1][1], m[2][1]], [m[0][2], m[1][2], m[2][2]]]
}

/// ∂D over the linear and over the bilinear parts, row by row, and D.
#[inline(always)]
pub(super) fn mean<L: Lane>(jacobian: &Matrix<L, 3>, warp: &Matrix<L, 3>) -> ([Matrix<L, 3>; 2], L) {
    let ([a, b, c], [h_1, h_2, h_3]) = (columns(jacobian), columns(warp));
    let [third_1, third_2, third_3] = columns(&scaled(*warp, L::splat(1.0 / 3.0)));
    let linear = [difference(b, c, third_2, h_3), difference(c, a, third_3, h_1), difference(a, b, third_1, h_2)];
    let bilinear = [difference(c, third_2, b, third_3), difference(a, third_3, c, third_1), difference(b, third_1, a, third_2)];
    // Every term of D has either a or h₁, and is of the first degree in it.
    ([linear, bilinear], dot(a, linear[0]) + dot(h_1, bilinear[0]))
}

/// c_α of the four patterns, from the parts of positions.
#[inline(always)]
pub(super) fn shares<L: Lane>(x: &[Parts<L>; 3]) -> [[L; 3]; 4] {
    let jacobian = [x[0].linear, x[1].linear, x[2].linear];
    let (adjugate, inverse) = (Dim::<3>::adjugate(&jacobian), L::splat(1.0) / Dim::<3>::determinant(&jacobian));
    let mut shares = [[inverse; 3]; 4];
    for pattern in 0..4 {
        let part = part(x, pattern);
        for k in 0..3 {
            // J c = part, with J_ik = ∂x_i/∂ξ_k.
            shares[pattern][k] = dot(adjugate[k], part) * inverse;
        }
    }
    shares
}

/// A part of a nodal vector that is not linear.
#[inline(always)]
fn part<L: Lane>(x: &[Parts<L>; 3], pattern: usize) -> [L; 3] {
    let mut out = [x[0].trilinear; 3];
    for i in 0..3 {
        out[i] = if pattern < 3 { x[i].bilinear[pattern] } else { x[i].trilinear };
    }
    out
}

/// The part of a nodal vector along the pattern, without what is linear: 8 q.
#[inline(always)]
pub(super) fn amplitude<L: Lane>(x: &[Parts<L>; 3], shares: &[L; 3], pattern: usize) -> [L; 3] {
    let mut out = part(x, pattern);
    for i in 0..3 {
        out[i] = out[i] - dot(*shares, x[i].linear);
    }
    out
}

/// What γ_α makes of the pulls on each amplitude 8 q_α: pulls on the linear parts, and on the others.
#[inline(always)]
pub(super) fn held<L: Lane>(pulls: &[[L; 3]; 4], shares: &[[L; 3]; 4], work: L, stiffening: L) -> Held<L, 3, 8> {
    let zero = L::splat(0.0);
    let (mut flux, mut warp) = ([[zero; 3]; 3], [[zero; 3]; 3]);
    for i in 0..3 {
        for k in 0..3 {
            let low = pulls[0][i] * shares[0][k] + pulls[1][i] * shares[1][k];
            flux[i][k] = -(low + (pulls[2][i] * shares[2][k] + pulls[3][i] * shares[3][k]));
            warp[i][k] = pulls[k][i];
        }
    }
    Held { forces: [[zero; 3]; 8], flux, pulls: Pulls { warp, rest: pulls[3] }, work, stiffening }
}

#[inline(always)]
pub(super) fn all_parts<L: Lane>(natural: &[[L; 3]; 8]) -> [Parts<L>; 3] {
    [Parts::from(natural, 0), Parts::from(natural, 1), Parts::from(natural, 2)]
}

/// 1 + Σ c².
#[inline(always)]
pub(super) fn extent<L: Lane>(shares: &[[L; 3]; 4]) -> L {
    L::splat(1.0) + (dot(shares[0], shares[0]) + dot(shares[1], shares[1]) + (dot(shares[2], shares[2]) + dot(shares[3], shares[3])))
}

/// (8/3) κ M' T: of the control's own modulus. T = V/(2h²) with the h of all of M.
#[inline(always)]
fn rigidity<L: Lane>(coefficient: L, corners: &Corners<L, 3, 8>) -> L {
    let [numerator, denominator] = corners.dilating_squared;
    coefficient * corners.shape_modulus * corners.volume * L::splat(4.0 / 3.0) * denominator / numerator
}

/// The potential: W = ½ k Σ |q|².
#[inline(always)]
fn hold<L: Lane>(coefficient: f64, corners: &Corners<L, 3, 8>, kept: &mut [Batch], at: usize) -> Held<L, 3, 8> {
    let (quarter, half, one) = (L::splat(0.25), L::splat(0.5), L::splat(1.0));
    let x = all_parts(&corners.x);
    if corners.is_start {
        let (shares, k) = (shares(&x), rigidity(L::splat(coefficient), corners));
        for value in 0..12 {
            shares[value / 3][value % 3].store(&mut kept[value], at);
        }
        k.store(&mut kept[12], at);
        (k * extent(&shares)).store(&mut kept[13], at);
    }
    let mut shares = [[one; 3]; 4];
    for value in 0..12 {
        shares[value / 3][value % 3] = L::load(&kept[value], at);
    }
    let (k, stiffest) = (L::load(&kept[12], at), L::load(&kept[13], at));
    // 8 q, and k q / 8 of it.
    let scale = k * L::splat(1.0 / 64.0);
    let mut pulls = [[one; 3]; 4];
    let mut squares = L::splat(-0.0);
    for pattern in 0..4 {
        let amplitude = amplitude(&x, &shares[pattern], pattern);
        squares += dot(amplitude, amplitude);
        for i in 0..3 {
            pulls[pattern][i] = amplitude[i] * scale;
        }
    }
    let [numerator, denominator] = corners.characteristic_length_squared;
    let stiffening = one + stiffest * numerator * quarter / (denominator * corners.volume * corners.modulus);
    held(&pulls, &shares, half * scale * squares, stiffening)
}

/// Dampers: Q = 2 κ √(k₁ m) q̇.
#[inline(always)]
fn damp<L: Lane>(coefficient: f64, corners: &Corners<L, 3, 8>, kept: &mut [Batch], at: usize) -> Held<L, 3, 8> {
    let (eighth, half, one) = (L::splat(0.125), L::splat(0.5), L::splat(1.0));
    let shares = shares(&all_parts(&corners.x));
    let rigidity = rigidity(one, corners);
    let resistance = L::splat(2.0 * coefficient) * (rigidity * corners.mass).sqrt() * corners.rate;
    let mut pulls = [[one; 3]; 4];
    let mut work = L::splat(-0.0);
    for pattern in 0..4 {
        for i in 0..3 {
            let (memory, change) = (&mut kept[3 * pattern + i], corners.hourglass_rates[pattern][i]);
            let (old, force) = (L::load(memory, at), resistance * change);
            force.store(memory, at);
            work += (old + force) * change;
            pulls[pattern][i] = force * eighth;
        }
    }
    // ξ = d Δt_s / 4 = ½ κ √(k₁/m) (1 + Σ c²) Δt_s
    let [numerator, denominator] = corners.characteristic_length_squared;
    let part = (rigidity * numerator / (denominator * corners.volume * corners.modulus)).sqrt() * extent(&shares);
    let part = part * L::splat(0.5 * coefficient);
    let stiffening = (one + part * part).sqrt() + part;
    held(&pulls, &shares, half * work, stiffening * stiffening)
}

/// Changes of the amplitudes q in a step to `x`, at mid-step.
#[inline(always)]
fn hourglass_rates<L: Lane>(x: &[[L; 3]; 8], step: &[[L; 3]; 8]) -> [[L; 3]; PATTERNS] {
    let (eighth, half) = (L::splat(0.125), L::splat(0.5));
    let (mut middle, step) = (all_parts(x), all_parts(step));
    for i in 0..3 {
        for k in 0..3 {
            middle[i].linear[k] = middle[i].linear[k] - step[i].linear[k] * half;
            middle[i].bilinear[k] = middle[i].bilinear[k] - step[i].bilinear[k] * half;
        }
        middle[i].trilinear = middle[i].trilinear - step[i].trilinear * half;
    }
    let shares = shares(&middle);
    let mut out = [[eighth; 3]; PATTERNS];
    for pattern in 0..4 {
        let change = amplitude(&step, &shares[pattern], pattern);
        for i in 0..3 {
            out[pattern][i] = change[i] * eighth;
        }
    }
    out
}

macro_rules! reduced {
    ($(#[$doc:meta])* $name:ident, $control:ident, $coefficient:literal, $kind:expr) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $name {
            coefficient: f64,
        }

        impl Element<3, 8, 1> for $name {
            const KIND: ElementKind = $kind;
            const POINTS: [[f64; 3]; 1] = [[0.0; 3]];
            const WEIGHTS: [f64; 1] = [1.0 / 64.0];
            const NODES: [[f64; 3]; 8] = NODES;
            const MEAN_DILATATION: bool = false;
            const HOURGLASS: usize = match Control::$control {
                Control::Stiffness => POTENTIAL,
                Control::Viscous => DAMPERS,
                Control::AssumedStrain => hex8_assumed_strain::POTENTIAL,
            };
            const DAMPS: bool = matches!(Control::$control, Control::Viscous);
            const HOURGLASS_MODES: usize = if matches!(Control::$control, Control::Viscous) { 4 } else { 0 };
            const WARPED: bool = true;
            const PARTS: usize = hex8::PARTS;

            fn new(options: &ElementOptions) -> Self {
                Self { coefficient: options.hourglass.unwrap_or($coefficient) }
            }
            fn shape(natural: [f64; 3]) -> [f64; 8] {
                hex8::shape(natural.map(|natural| natural / EDGE))
            }
            #[inline(always)]
            fn natural<L: Lane>(nodal: &[[L; 3]; 8]) -> [[L; 3]; 8] {
                hex8::natural(nodal)
            }
            #[inline(always)]
            fn gradients<L: Lane>(natural: &[[L; 3]; 8]) -> [Matrix<L, 3>; 1] {
                let [x, y, z] = all_parts(natural);
                [[x.linear, y.linear, z.linear]]
            }
            #[inline(always)]
            fn warp<L: Lane>(natural: &[[L; 3]; 8]) -> Matrix<L, 3> {
                let [x, y, z] = all_parts(natural);
                [x.bilinear, y.bilinear, z.bilinear]
            }
            #[inline(always)]
            fn mean<L: Lane>(jacobian: &Matrix<L, 3>, warp: &Matrix<L, 3>) -> ([Matrix<L, 3>; 2], L) {
                mean(jacobian, warp)
            }
            #[inline(always)]
            fn divergence<L: Lane>(flux: &[Matrix<L, 3>; 1]) -> [[L; 3]; 8] {
                Self::divergence_warped(flux, &Pulls::none())
            }
            #[inline(always)]
            fn divergence_warped<L: Lane>(flux: &[Matrix<L, 3>; 1], pulls: &Pulls<L, 3>) -> [[L; 3]; 8] {
                let mut out = [[L::splat(0.0); 3]; 8];
                for i in 0..3 {
                    Parts { linear: flux[0][i], bilinear: pulls.warp[i], trilinear: pulls.rest[i] }.spread(&mut out, i);
                }
                out
            }
            /// Σ_a B_a B_aᵀ is 8 times that of the parts, 64 V = D.
            #[inline(always)]
            fn thickness<L: Lane>(_: &[[L; 3]; 8], map: &Map<L, 3, 1>, _: L, _: &[[L; 3]; 8], _: StressState) -> Thickness<L> {
                let ([a, b, c], [d, e, f]) = (map.adjugates[0], map.warped);
                let determinant = map.determinants[0];
                let spectrum = Metric::of(a).and(b).and(c).and(d).and(e).and(f).spectrum();
                Thickness::of_points(determinant * determinant * L::splat(1.0 / 16.0), spectrum)
            }
            fn corner_volumes(nodal: &[[f64; 3]; 8], _: bool) -> Option<[f64; 8]> {
                Some(corner_volumes(nodal))
            }
            #[inline(always)]
            fn hourglass_rates<L: Lane>(x: &[[L; 3]; 8], step: &[[L; 3]; 8], _: &Matrix<L, 3>) -> [[L; 3]; PATTERNS] {
                hourglass_rates(x, step)
            }
            #[inline(always)]
            fn hourglass_forces<L: Lane>(&self, corners: &Corners<L, 3, 8>, _: &Map<L, 3, 1>, kept: &mut [Batch], at: usize) -> Held<L, 3, 8> {
                match Control::$control {
                    Control::Stiffness => hold(self.coefficient, corners, kept, at),
                    Control::Viscous => damp(self.coefficient, corners, kept, at),
                    Control::AssumedStrain => bend(self.coefficient, corners, kept, at),
                }
            }
        }
    };
}

reduced!(
    /// Held by springs.
    Hex8Reduced,
    Stiffness,
    0.05,
    ElementKind {
        name: "hex8_reduced",
        doc: "eight-node hexahedron, one point, hourglass control by stiffness (coefficient 0.05)",
        source: "Flanagan and Belytschko, Int. J. Numer. Meth. Engng 17 (1981) 679-706",
        cell: CellKind::Hexahedron,
        dimension: 3,
        extruded: None,
        is_default: false,
    }
);

reduced!(
    /// Held by dampers.
    Hex8ReducedViscous,
    Viscous,
    0.05,
    ElementKind {
        name: "hex8_reduced_viscous",
        doc: "eight-node hexahedron, one point, hourglass control by damping (coefficient 0.05): for high rates; \
            shapes that are there remain",
        source: "Flanagan and Belytschko, Int. J. Numer. Meth. Engng 17 (1981) 679-706",
        cell: CellKind::Hexahedron,
        dimension: 3,
        extruded: None,
        is_default: false,
    }
);

reduced!(
    /// Held by what elastic bending, torsion and warping cost.
    Hex8ReducedAssumedStrain,
    AssumedStrain,
    1.0,
    ElementKind {
        name: "hex8_reduced_assumed_strain",
        doc: "eight-node hexahedron, one point, hourglass control by assumed strain (coefficient 1): right in \
            elastic bending with one element through the thickness",
        source: "Belytschko and Bindeman, Comput. Meth. Appl. Mech. Engng 105 (1993) 225-260 (ASQBI)",
        cell: CellKind::Hexahedron,
        dimension: 3,
        extruded: None,
        is_default: false,
    }
);

/// ∫ N_a dV at the 2 × 2 × 2 points, which is exact and which one point takes for equal.
fn corner_volumes(x: &[[f64; 3]; 8]) -> [f64; 8] {
    let mut volumes = [0.0; 8];
    for (jacobian, at) in Hex8::gradients(&hex8::natural(x)).iter().zip(Hex8::POINTS) {
        let determinant = Dim::<3>::determinant(jacobian);
        for (corner, share) in volumes.iter_mut().zip(hex8::shape(at)) {
            *corner += determinant * share;
        }
    }
    volumes
}
