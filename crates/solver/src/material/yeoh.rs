//! Yeoh's rubber: a cubic in the first invariant, hyperelastic. Stiffens at large stretch.
//!
//! W = Σ C_i0 (Ī₁ − 3)^i + ¼K (J² − 1 − 2 ln J) per initial volume, i = 1..3, Ī₁ = tr b̄, b̄ = J^{-2/3} b;
//! with w' = dW/dĪ₁: σ = 2 w' dev b̄ / J + ½K (J − 1/J) I. Moduli at rest K and µ = 2 C₁₀. Source: Yeoh,
//! Rubber Chem. Technol. 66 (1993) 754-771; volume as in `neo_hookean`, stable step as in `rubber.rs`.
//!
//! w' = C₁₀ + 2 C₂₀ x + 3 C₃₀ x² stays positive for all x = Ī₁ − 3 ≥ 0 when C₂₀ > −√(3 C₁₀ C₃₀), as fits with
//! a first softening need.

use super::rubber::{FirstInvariant, Unimodular, Volume, isochoric};
use super::{BULK, DENSITY, Family, Kinematics, Law, LawKind, ParameterFault, Parameters, Response};
use crate::material::messages::UNSTABLE_RUBBER;
use crate::quantity::{Dimension, Parameter, Range};
use crate::tensor::SymmetricTensor;
use embate_lanes::Lane;

/// The law with its coefficients.
#[derive(Clone, Copy, Debug)]
pub struct Yeoh {
    bulk: f64,
    coefficients: [f64; 3],
}

impl Law for Yeoh {
    const KIND: LawKind = LawKind {
        name: "yeoh",
        doc: "rubber elasticity with a cubic in the first invariant, which stiffens at large stretch; shear modulus at rest 2 C₁₀",
        source: "Yeoh, Rubber Chem. Technol. 66 (1993) 754-771",
        parameters: &[
            DENSITY.such_as("1000 kg/m^3"),
            Parameter::new("c10", "C₁₀", Dimension::PRESSURE, Range::Positive, "linear coefficient").such_as("0.2 MPa"),
            Parameter::new("c20", "C₂₀", Dimension::PRESSURE, Range::Finite, "quadratic coefficient; above −√(3 C₁₀ C₃₀)").or(0.0),
            Parameter::new("c30", "C₃₀", Dimension::PRESSURE, Range::NotNegative, "cubic coefficient").or(0.0),
            BULK,
        ],
    };
    const FAMILY: Family = Family::Hyperelastic;
    const CAN_BE_AVERAGED: bool = true;
    type State<L: Lane, T: SymmetricTensor<L>> = [L; 0];

    fn new(parameters: &Parameters<'_>) -> Self {
        Self { bulk: parameters.value("bulk"), coefficients: ["c10", "c20", "c30"].map(|name| parameters.value(name)) }
    }

    fn faults(parameters: &Parameters<'_>) -> Vec<ParameterFault> {
        let [c1, c2, c3] = ["c10", "c20", "c30"].map(|name| parameters.value(name));
        if c2 >= 0.0 || c2 * c2 < 3.0 * c1 * c3 {
            return Vec::new();
        }
        let message = format!(
            "c20 = {c2} Pa is not above -sqrt(3 c10 c30) = {} Pa: beyond some stretch the rubber would soften to nothing",
            -(3.0 * c1 * c3).sqrt()
        );
        vec![ParameterFault { kind: &UNSTABLE_RUBBER, name: "c20", message, help: "raise c20 or c30".into() }]
    }

    #[inline(always)]
    fn update<L: Lane, T: SymmetricTensor<L>>(&self, kinematics: &Kinematics<L, T>, _state: &mut [L; 0]) -> Response<L, T> {
        let j = kinematics.volume_ratio;
        let inverse = L::splat(1.0) / j;
        let b = Unimodular::new(kinematics.left_cauchy_green, isochoric(j, inverse));
        let [c1, c2, c3] = self.coefficients;
        let [c1, c2, c3] = [L::splat(c1), L::splat(c2), L::splat(c3)];
        let above = b.above * L::splat(3.0); // Ī₁ − 3
        let (two, three) = (L::splat(2.0), L::splat(3.0));
        let invariant = FirstInvariant {
            stored: above * (c1 + above * (c2 + above * c3)),
            slope: c1 + above * (two * c2 + three * above * c3),
            curvature: two * (c2 + three * above * c3),
        };
        invariant.response(&b, &Volume::new(self.bulk, j, inverse), inverse)
    }

    fn stiffness(&self) -> [f64; 2] {
        [self.bulk, 2.0 * self.coefficients[0]]
    }
}
