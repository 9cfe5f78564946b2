//! Compressible Mooney-Rivlin rubber, hyperelastic.
//!
//! W = C₁₀ (tr b̄ − 3) + C₀₁ (tr b̄⁻¹ − 3) + ¼K (J² − 1 − 2 ln J) per initial volume, b̄ = J^{-2/3} b; with
//! m₁ = 2 C₁₀, m₂ = 2 C₀₁ and v̄ = b̄⁻¹ σ = (m₁ dev b̄ − m₂ dev v̄)/J + ½K (J − 1/J) I. Moduli at rest K and
//! µ = m₁ + m₂. det b̄ = 1, so v̄ is the adjugate of b̄. Source: Mooney, J. Appl. Phys. 11 (1940) 582-592;
//! Rivlin, Phil. Trans. R. Soc. A 241 (1948) 379-397; volume as in `neo_hookean`.
//!
//! Stiffness for the stable step: the second variation of W along L = a⊗n, t = a·n, gives J ρc² = J² U'' t² +
//! m₁ (b̄_nn − 4/3 t b̄_an + 5/3 t² c_b) + m₂ (v̄_aa + 2/3 t v̄_an − 1/3 t² c_v), c = tr / 3. The first
//! bracket is at most 4/3 b̄_max, the second at most 5/3 v̄_max − 1/3 c_v (it grows with t), and no
//! eigenvalue exceeds c + √(2/3) |dev|.

use super::rubber::{Unimodular, Volume, isochoric};
use super::{BULK, DENSITY, Family, Kinematics, Law, LawKind, Parameters, Response};
use crate::quantity::{Dimension, Parameter, Range};
use crate::tensor::SymmetricTensor;
use embate_lanes::Lane;

/// The law with its moduli.
#[derive(Clone, Copy, Debug)]
pub struct MooneyRivlin {
    bulk: f64,
    /// m₁ = 2 C₁₀.
    first: f64,
    /// m₂ = 2 C₀₁.
    second: f64,
}

impl Law for MooneyRivlin {
    const KIND: LawKind = LawKind {
        name: "mooney_rivlin",
        doc: "rubber elasticity from both invariants of the left Cauchy-Green tensor; shear modulus at rest 2 (C₁₀ + C₀₁)",
        source: "Rivlin, Phil. Trans. R. Soc. A 241 (1948) 379-397",
        parameters: &[
            DENSITY.such_as("1000 kg/m^3"),
            Parameter::new("c10", "C₁₀", Dimension::PRESSURE, Range::Positive, "coefficient of the first invariant").such_as("0.2 MPa"),
            Parameter::new("c01", "C₀₁", Dimension::PRESSURE, Range::NotNegative, "coefficient of the second invariant")
                .such_as("0.05 MPa"),
            BULK,
        ],
    };
    const FAMILY: Family = Family::Hyperelastic;
    const CAN_BE_AVERAGED: bool = true;
    type State<L: Lane, T: SymmetricTensor<L>> = [L; 0];

    fn new(parameters: &Parameters<'_>) -> Self {
        Self { bulk: parameters.value("bulk"), first: 2.0 * parameters.value("c10"), second: 2.0 * parameters.value("c01") }
    }

    #[inline(always)]
    fn update<L: Lane, T: SymmetricTensor<L>>(&self, kinematics: &Kinematics<L, T>, _state: &mut [L; 0]) -> Response<L, T> {
        let (j, b) = (kinematics.volume_ratio, kinematics.left_cauchy_green);
        let inverse = L::splat(1.0) / j;
        let scale = isochoric(j, inverse);
        let v = Unimodular::new(b.adjugate(), scale * scale);
        let b = Unimodular::new(b, scale);
        let volume = Volume::new(self.bulk, j, inverse);
        let (first, second) = (L::splat(self.first), L::splat(self.second));
        let need = first * (b.mean + b.spread) + second * (v.mean + L::splat(1.25) * v.spread);
        Response {
            stress: b.deviator.times(first * inverse).plus(v.deviator.times(-(second * inverse))).plus_isotropic(volume.pressure),
            stored: (first * b.above + second * v.above) * L::splat(1.5) + volume.stored,
            dissipated: L::splat(0.0),
            bulk: volume.stiffness,
            shear: need * inverse,
        }
    }

    fn stiffness(&self) -> [f64; 2] {
        [self.bulk, self.first + self.second]
    }
}
