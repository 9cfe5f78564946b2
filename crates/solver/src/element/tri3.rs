//! Three-node triangles with one point: constant strain (`tri3`), which locks where the volume cannot change,
//! and the same with averaged nodal pressure (`tri3_anp`), which does not: the block averages their
//! dilatation over the nodes (`block/nodal.rs`).
//!
//! ```text
//!   3
//!   | \        N_1 = 1 − ξ − η, N_2 = ξ, N_3 = η
//!   1 - 2
//! ```
//!
//! Sources: Hughes, The Finite Element Method (1987), 3.I; Bonet and Burton, Commun. Numer. Meth. Engng 14
//! (1998) 437-449.

use super::quad4::distance_squared;
use super::{Element, ElementKind, ElementOptions, Map, Thickness};
use crate::mesh::cell::CellKind;
use crate::stress_state::StressState;
use crate::tensor::Matrix;
use embate_lanes::Lane;
use std::f64::consts::TAU;

macro_rules! triangle {
    ($(#[$doc:meta])* $name:ident, $nodal:literal, $kind:expr) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl Element<2, 3, 1> for $name {
            const KIND: ElementKind = $kind;
            const POINTS: [[f64; 2]; 1] = [[1.0 / 3.0; 2]];
            const WEIGHTS: [f64; 1] = [0.5];
            const NODES: [[f64; 2]; 3] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
            const MEAN_DILATATION: bool = false;
            const NODAL_DILATATION: bool = $nodal;

            fn new(_options: &ElementOptions) -> Self {
                Self
            }
            fn shape([xi, eta]: [f64; 2]) -> [f64; 3] {
                [1.0 - xi - eta, xi, eta]
            }
            #[inline(always)]
            fn gradients<L: Lane>(u: &[[L; 2]; 3]) -> [Matrix<L, 2>; 1] {
                let mut out = [[[L::splat(0.0); 2]; 2]; 1];
                for i in 0..2 {
                    out[0][i] = [u[1][i] - u[0][i], u[2][i] - u[0][i]];
                }
                out
            }
            #[inline(always)]
            fn divergence<L: Lane>(flux: &[Matrix<L, 2>; 1]) -> [[L; 2]; 3] {
                let mut out = [[L::splat(0.0); 2]; 3];
                for i in 0..2 {
                    let [a, b] = flux[0][i];
                    out[1][i] = a;
                    out[2][i] = b;
                    out[0][i] = -(a + b);
                }
                out
            }
            #[inline(always)]
            fn thickness<L: Lane>(x: &[[L; 2]; 3], _: &Map<L, 2, 1>, area: L, _: &[[L; 2]; 3], _: StressState) -> Thickness<L> {
                let [numerator, denominator] = characteristic_length_squared(x, area);
                Thickness::of_waves(numerator, denominator)
            }
            fn corner_volumes(x: &[[f64; 2]; 3], is_axisymmetric: bool) -> Option<[f64; 3]> {
                Some(corner_volumes(x, is_axisymmetric))
            }
        }
    };
}

triangle!(
    /// Constant strain.
    Tri3,
    false,
    ElementKind {
        name: "tri3",
        doc: "three-node triangle, one point; stiff in bending, locks in plastic flow and rubber",
        source: "Hughes, The Finite Element Method (1987), 3.I",
        cell: CellKind::Triangle,
        dimension: 2,
        extruded: Some("wedge6"),
        is_default: true,
    }
);

triangle!(
    /// Constant deviator, dilatation averaged over the nodes.
    Tri3Anp,
    true,
    ElementKind {
        name: "tri3_anp",
        doc: "three-node triangle, one point, pressure averaged over the nodes: for triangles in plastic flow and rubber",
        source: "Bonet and Burton, Commun. Numer. Meth. Engng 14 (1998) 437-449",
        cell: CellKind::Triangle,
        dimension: 2,
        extruded: Some("wedge6"),
        is_default: false,
    }
);

/// h² = 16 A² / (3 Σ ℓ²) from the sides ℓ. In two vectors orthogonal to each other and to (1, 1, 1) the
/// stiffness has two blocks; the largest eigenvalue is at most the sum of theirs, ρc² V Σ_a |∇N_a|², and
/// |∇N_a| = ℓ_a / 2A with the side opposite to the node: ω² ≤ c² Σ ℓ² / (4 A²) · 3 for corners of a third of
/// the mass.
#[inline(always)]
pub(super) fn characteristic_length_squared<L: Lane>(x: &[[L; 2]; 3], area: L) -> [L; 2] {
    let sides = distance_squared(x[0], x[1]) + distance_squared(x[1], x[2]) + distance_squared(x[2], x[0]);
    [area * area * L::splat(16.0 / 3.0), sides]
}

/// A third of the area each; of an axisymmetric body ∫ 2πx N_a dA = 2π A (x_1 + x_2 + x_3 + x_a) / 12.
pub(super) fn corner_volumes(x: &[[f64; 2]; 3], is_axisymmetric: bool) -> [f64; 3] {
    let area = 0.5 * ((x[1][0] - x[0][0]) * (x[2][1] - x[0][1]) - (x[2][0] - x[0][0]) * (x[1][1] - x[0][1]));
    let sum = x[0][0] + x[1][0] + x[2][0];
    x.map(|x| if is_axisymmetric { TAU * area * (sum + x[0]) / 12.0 } else { area / 3.0 })
}
