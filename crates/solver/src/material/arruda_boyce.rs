//! Arruda and Boyce's rubber: eight chains in a cube, which stiffen as they near their full length.
//! Hyperelastic.
//!
//! W = µ Σ_i C_i λ_m^{2−2i} (Ī₁^i − 3^i) + ¼K (J² − 1 − 2 ln J) per initial volume, i = 1..5, C = 1/2, 1/20,
//! 11/1050, 19/7000, 519/673750: the inverse Langevin function's series, as usual cut after five terms, so
//! that the stress grows steeply beyond the locking stretch λ_m but has no pole there. The user gives the
//! shear modulus at rest, µ₀ = µ Σ_i 2 i C_i (3/λ_m²)^{i−1}; the source's n k Θ is µ. Moduli at rest K and
//! µ₀. Source: Arruda and Boyce, J. Mech. Phys. Solids 41 (1993) 389-412; volume as in `neo_hookean`, stable
//! step as in `rubber.rs`.

use super::rubber::{FirstInvariant, Unimodular, Volume, isochoric};
use super::{BULK, DENSITY, Family, Kinematics, Law, LawKind, Parameters, Response};
use crate::quantity::{Dimension, Parameter, Range};
use crate::tensor::SymmetricTensor;
use embate_lanes::Lane;

/// Coefficients of the series.
const SERIES: [f64; 5] = [1.0 / 2.0, 1.0 / 20.0, 11.0 / 1050.0, 19.0 / 7000.0, 519.0 / 673_750.0];

/// The law with its coefficients.
#[derive(Clone, Copy, Debug)]
pub struct ArrudaBoyce {
    bulk: f64,
    shear: f64,
    /// µ C_i λ_m^{2−2i}.
    coefficients: [f64; 5],
}

impl Law for ArrudaBoyce {
    const KIND: LawKind = LawKind {
        name: "arruda_boyce",
        doc: "rubber elasticity of eight chains, which stiffens towards a locking stretch",
        source: "Arruda and Boyce, J. Mech. Phys. Solids 41 (1993) 389-412",
        parameters: &[
            DENSITY.such_as("1000 kg/m^3"),
            Parameter::new("shear", "µ₀", Dimension::PRESSURE, Range::Positive, "shear modulus at rest").such_as("0.3 MPa"),
            Parameter::new(
                "locking_stretch",
                "λ_m",
                Dimension::NONE,
                Range::Between(1.0, 1000.0),
                "stretch at which the chains are straight",
            )
            .such_as("5"),
            BULK,
        ],
    };
    const FAMILY: Family = Family::Hyperelastic;
    const CAN_BE_AVERAGED: bool = true;
    type State<L: Lane, T: SymmetricTensor<L>> = [L; 0];

    fn new(parameters: &Parameters<'_>) -> Self {
        let (shear, locking) = (parameters.value("shear"), parameters.value("locking_stretch"));
        let inverse = 1.0 / (locking * locking);
        let (mut coefficients, mut at_rest, mut power) = ([0.0; 5], 0.0, 1.0);
        for i in 0..5 {
            coefficients[i] = SERIES[i] * power;
            at_rest += 2.0 * (i as f64 + 1.0) * coefficients[i] * 3.0f64.powi(i as i32);
            power *= inverse;
        }
        Self { bulk: parameters.value("bulk"), shear, coefficients: coefficients.map(|value| value * shear / at_rest) }
    }

    #[inline(always)]
    fn update<L: Lane, T: SymmetricTensor<L>>(&self, kinematics: &Kinematics<L, T>, _state: &mut [L; 0]) -> Response<L, T> {
        let (zero, j) = (L::splat(0.0), kinematics.volume_ratio);
        let inverse = L::splat(1.0) / j;
        let b = Unimodular::new(kinematics.left_cauchy_green, isochoric(j, inverse));
        let above = b.above * L::splat(3.0);
        let invariant = above + L::splat(3.0);
        // Ī₁^i − 3^i = Ī₁ (Ī₁^{i−1} − 3^{i−1}) + 3^{i−1} (Ī₁ − 3), without cancellation.
        let (mut stored, mut slope, mut curvature) = (zero, zero, zero);
        let (mut difference, mut power, mut power_below, mut three) = (zero, L::splat(1.0), zero, 1.0);
        for i in 0..5 {
            let order = i as f64 + 1.0;
            difference = invariant * difference + above * L::splat(three);
            stored += difference * L::splat(self.coefficients[i]);
            slope += power * L::splat(order * self.coefficients[i]);
            curvature += power_below * L::splat(order * (order - 1.0) * self.coefficients[i]);
            power_below = power;
            power = power * invariant;
            three *= 3.0;
        }
        FirstInvariant { stored, slope, curvature }.response(&b, &Volume::new(self.bulk, j, inverse), inverse)
    }

    fn stiffness(&self) -> [f64; 2] {
        [self.bulk, self.shear]
    }
}
