//! Four-node tetrahedra with one point: constant strain (`tet4`), which locks where the volume cannot change,
//! and the same with averaged nodal pressure (`tet4_anp`), which does not: the block averages their
//! dilatation over the nodes (`block/nodal.rs`).
//!
//! ```text
//!        4
//!      / | \        N_1 = 1 − ξ − η − ζ, N_2 = ξ, N_3 = η, N_4 = ζ
//!     1 -|- 3       the normal of 1 2 3 by the right hand points to 4
//!      \ | /
//!        2
//! ```
//!
//! Sources: Hughes, The Finite Element Method (1987), 3.I; Bonet and Burton, Commun. Numer. Meth. Engng 14
//! (1998) 437-449.

use super::stiffest::{Metric, Thickness};
use super::{Element, ElementKind, ElementOptions, Map};
use crate::mesh::cell::CellKind;
use crate::stress_state::StressState;
use crate::tensor::Matrix;
use embate_lanes::Lane;

macro_rules! tetrahedron {
    ($(#[$doc:meta])* $name:ident, $nodal:literal, $kind:expr) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl Element<3, 4, 1> for $name {
            const KIND: ElementKind = $kind;
            const POINTS: [[f64; 3]; 1] = [[0.25; 3]];
            const WEIGHTS: [f64; 1] = [1.0 / 6.0];
            const NODES: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
            const MEAN_DILATATION: bool = false;
            const NODAL_DILATATION: bool = $nodal;

            fn new(_options: &ElementOptions) -> Self {
                Self
            }
            fn shape([xi, eta, zeta]: [f64; 3]) -> [f64; 4] {
                [1.0 - xi - eta - zeta, xi, eta, zeta]
            }
            #[inline(always)]
            fn gradients<L: Lane>(u: &[[L; 3]; 4]) -> [Matrix<L, 3>; 1] {
                let mut out = [[[L::splat(0.0); 3]; 3]; 1];
                for i in 0..3 {
                    out[0][i] = [u[1][i] - u[0][i], u[2][i] - u[0][i], u[3][i] - u[0][i]];
                }
                out
            }
            #[inline(always)]
            fn divergence<L: Lane>(flux: &[Matrix<L, 3>; 1]) -> [[L; 3]; 4] {
                let mut out = [[L::splat(0.0); 3]; 4];
                for i in 0..3 {
                    let [a, b, c] = flux[0][i];
                    (out[1][i], out[2][i], out[3][i]) = (a, b, c);
                    out[0][i] = -(a + b + c);
                }
                out
            }
            #[inline(always)]
            fn thickness<L: Lane>(_: &[[L; 3]; 4], map: &Map<L, 3, 1>, _: L, _: &[[L; 3]; 4], _: StressState) -> Thickness<L> {
                thickness(map)
            }
        }
    };
}

tetrahedron!(
    /// Constant strain.
    Tet4,
    false,
    ElementKind {
        name: "tet4",
        doc: "four-node tetrahedron, one point; stiff in bending, locks in plastic flow and rubber",
        source: "Hughes, The Finite Element Method (1987), 3.I",
        cell: CellKind::Tetrahedron,
        dimension: 3,
        extruded: None,
        is_default: true,
    }
);

tetrahedron!(
    /// Constant deviator, dilatation averaged over the nodes.
    Tet4Anp,
    true,
    ElementKind {
        name: "tet4_anp",
        doc: "four-node tetrahedron, one point, pressure averaged over the nodes: for tetrahedra in plastic flow and rubber",
        source: "Bonet and Burton, Commun. Numer. Meth. Engng 14 (1998) 437-449",
        cell: CellKind::Tetrahedron,
        dimension: 3,
        extruded: None,
        is_default: false,
    }
);

/// h² = 1 / (max(1 − s, 0) T + s Λ) of Σ_a ∇N_a ∇N_aᵀ, whose rows times the determinant are those of the
/// adjugate, and minus their sum.
#[inline(always)]
fn thickness<L: Lane>(map: &Map<L, 3, 1>) -> Thickness<L> {
    let [a, b, c] = map.adjugates[0];
    let last = [a[0] + b[0] + c[0], a[1] + b[1] + c[1], a[2] + b[2] + c[2]];
    let determinant = map.determinants[0];
    Thickness::of_points(determinant * determinant, Metric::of(a).and(b).and(c).and(last).spectrum())
}
