//! J2 (von Mises) plasticity with linear isotropic hardening, rate form, radial return.
//!
//! Trial stress as in `elastic`; q = √(3/2 s:s). Where q > σ_y(ε_p) = σ_y0 + H ε_p:
//! Δε_p = (q_trial − σ_y(ε_p)) / (3µ + H), s ← s (1 − 3µ Δε_p / q_trial), dissipation per volume ∫ σ_y dε_p = (σ_y(ε_p) + ½ H Δε_p) Δε_p.
//! H is the plastic modulus dσ_y/dε_p, not the tangent modulus E_t = E H / (E + H).
//! Source: Wilkins, Methods in Computational Physics 3 (1964); Simo and Hughes, Computational Inelasticity (1998), box 3.2.

use super::{DENSITY, Family, Kinematics, Law, LawKind, POISSON, Parameters, Response, Variable, YOUNG, bulk_and_shear};
use crate::quantity::{Dimension, Parameter, Range};
use crate::tensor::SymmetricTensor;
use embate_lanes::Lane;

/// The law with its moduli.
#[derive(Clone, Copy, Debug)]
pub struct J2 {
    bulk: f64,
    shear: f64,
    yield_stress: f64,
    hardening: f64,
}

impl Law for J2 {
    const KIND: LawKind = LawKind {
        name: "j2",
        doc: "elasto-plasticity after von Mises with linear isotropic hardening",
        source: "Simo and Hughes, Computational Inelasticity (1998), box 3.2",
        parameters: &[
            DENSITY,
            YOUNG,
            POISSON,
            Parameter::new("yield", "σ_y", Dimension::PRESSURE, Range::Positive, "initial yield stress"),
            Parameter::new(
                "hardening",
                "H",
                Dimension::PRESSURE,
                Range::NotNegative,
                "plastic modulus dσ_y/dε_p (not the tangent modulus)",
            )
            .or(0.0),
        ],
    };
    const FAMILY: Family = Family::Rate;
    /// Equivalent plastic strain.
    type State<L: Lane, T: SymmetricTensor<L>> = [L; 1];
    const VARIABLES: &'static [(Variable, usize)] = &[(Variable::PlasticStrain, 0)];

    fn new(parameters: &Parameters<'_>) -> Self {
        let [bulk, shear] = bulk_and_shear(parameters);
        Self { bulk, shear, yield_stress: parameters.value("yield"), hardening: parameters.value("hardening") }
    }

    #[inline(always)]
    fn update<L: Lane, T: SymmetricTensor<L>>(&self, kinematics: &Kinematics<L, T>, state: &mut [L; 1]) -> Response<L, T> {
        let (bulk, shear, zero) = (L::splat(self.bulk), L::splat(self.shear), L::splat(0.0));
        let strain = kinematics.strain_increment;
        let sum = kinematics.stress_rotated.plus(strain.times(shear + shear));
        let third = sum.trace() * L::splat(1.0 / 3.0);
        let mean = third + L::splat(self.bulk - 2.0 / 3.0 * self.shear) * strain.trace();
        let trial = sum.plus(T::isotropic(-third));
        let square = trial.contract(trial) * L::splat(1.5);
        let flow = L::splat(self.yield_stress) + L::splat(self.hardening) * state[0];
        let yields = (flow * flow).less(square);
        let (mut deviator, mut dissipated) = (trial, zero);
        if L::any(yields) {
            let q = square.sqrt();
            let step = L::select(yields, (q - flow) * L::splat(1.0 / (3.0 * self.shear + self.hardening)), zero);
            let factor = L::select(yields, L::splat(1.0) - L::splat(3.0 * self.shear) * step / q, L::splat(1.0));
            deviator = trial.times(factor);
            state[0] += step;
            dissipated = (flow + L::splat(0.5 * self.hardening) * step) * step;
        }
        Response { stress: deviator.plus(T::isotropic(mean)), stored: zero, dissipated, bulk, shear }
    }

    fn stiffness(&self) -> [f64; 2] {
        [self.bulk, self.shear]
    }
}
