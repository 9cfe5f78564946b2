//! Drucker and Prager's plasticity of soil, rock and concrete: what it bears grows with the pressure, and
//! flow may widen it.
//!
//! q + A σ_m ≤ k, A = 6 sin φ / (3 − sin φ), k = 6 c cos φ / (3 − sin φ): the cone through the compressive
//! edges of Mohr and Coulomb's pyramid, with cohesion c and friction angle φ; σ_m = ⅓ tr σ, tension positive.
//! Flow along N + ⅓ B I, N = 3/2 s/q, B = 6 sin ψ / (3 − sin ψ) with the angle of dilation ψ ≤ φ: no volume
//! from nothing, and the dissipation γ (k − (A − B) σ_m) is not negative anywhere on the cone. Return:
//! γ = (q + A σ_m − k) / (3µ + K A B), q ← q − 3µ γ, σ_m ← σ_m − K B γ. Where that makes q negative, the
//! stress returns to the apex, q = 0 and σ_m = k/A, with a plastic strain whose deviator is that of the
//! trial. Perfectly plastic; dissipation as in `trial.rs`, with both parts. Source: Drucker and Prager,
//! Quarterly of Applied Mathematics 10 (1952) 157-165; de Souza Neto, Perić and Owen, Computational Methods
//! for Plasticity (2008), section 8.3.

use super::trial::Trial;
use super::{
    DENSITY, Family, History, Kinematics, Law, LawKind, POISSON, ParameterFault, Parameters, Response, YOUNG, bulk_and_shear, variable,
};
use crate::angle::cos_sin;
use crate::material::messages::PARAMETERS;
use crate::quantity::{Dimension, Parameter, Range};
use crate::tensor::SymmetricTensor;
use embate_lanes::Lane;

/// The law with its moduli.
#[derive(Clone, Copy, Debug)]
pub struct DruckerPrager {
    bulk: f64,
    shear: f64,
    /// A.
    friction: f64,
    /// B.
    dilation: f64,
    /// k, Pa.
    strength: f64,
    /// k/A, Pa; infinite without friction.
    apex: f64,
}

/// 6 sin φ / (3 − sin φ).
fn slope(angle: f64) -> f64 {
    let [_, sin] = cos_sin(angle);
    6.0 * sin / (3.0 - sin)
}

impl Law for DruckerPrager {
    const KIND: LawKind = LawKind {
        name: "drucker_prager",
        doc: "soil, rock or concrete: perfectly plastic with friction and dilation, the cone of Drucker and Prager",
        source: "Drucker and Prager, Q. Appl. Math. 10 (1952) 157-165; de Souza Neto et al., Computational Methods \
            for Plasticity (2008), 8.3",
        parameters: &[
            DENSITY.such_as("2000 kg/m^3"),
            YOUNG.such_as("50 MPa"),
            POISSON,
            Parameter::new("cohesion", "c", Dimension::PRESSURE, Range::Positive, "shear strength without pressure").such_as("20 kPa"),
            Parameter::new(
                "friction_angle",
                "φ",
                Dimension::NONE,
                Range::NotNegative,
                "angle of internal friction, below 90 deg, fitted to compression",
            )
            .angle()
            .such_as("30 deg"),
            Parameter::new("dilation_angle", "ψ", Dimension::NONE, Range::NotNegative, "angle of dilation, at most the angle of friction")
                .angle()
                .or(0.0),
        ],
    };
    const FAMILY: Family = Family::Rate;
    const FLOWS_IN_VOLUME: bool = true;
    /// Equivalent strain of the plastic deviator, Σ γ.
    type State<L: Lane, T: SymmetricTensor<L>> = [L; 1];
    const VARIABLES: &'static [History] = &[variable::PLASTIC_STRAIN.at(0)];
    const CAN_BE_AVERAGED: bool = true;

    fn new(parameters: &Parameters<'_>) -> Self {
        let [bulk, shear] = bulk_and_shear(parameters);
        let (cohesion, angle) = (parameters.value("cohesion"), parameters.value("friction_angle"));
        let [cos, sin] = cos_sin(angle);
        let (friction, strength) = (slope(angle), 6.0 * cohesion * cos / (3.0 - sin));
        Self { bulk, shear, friction, dilation: slope(parameters.value("dilation_angle")), strength, apex: strength / friction }
    }

    fn faults(parameters: &Parameters<'_>) -> Vec<ParameterFault> {
        let (friction, dilation) = (parameters.value("friction_angle"), parameters.value("dilation_angle"));
        if friction >= std::f64::consts::FRAC_PI_2 {
            return vec![ParameterFault {
                kind: &PARAMETERS,
                name: "friction_angle",
                message: format!("the angle of friction is {:.1} deg", friction.to_degrees()),
                help: "it lies below 90 deg; the number is in radians, 30 deg are 0.5236".into(),
            }];
        }
        if dilation <= friction {
            return Vec::new();
        }
        vec![ParameterFault {
            kind: &PARAMETERS,
            name: "dilation_angle",
            message: "the angle of dilation is larger than that of friction, so that flow would make energy".into(),
            help: "take at most `friction_angle`; often a quarter of it, or 0".into(),
        }]
    }

    #[inline(always)]
    fn update<L: Lane, T: SymmetricTensor<L>>(&self, kinematics: &Kinematics<L, T>, state: &mut [L; 1]) -> Response<L, T> {
        let (zero, one, half) = (L::splat(0.0), L::splat(1.0), L::splat(0.5));
        let trial = Trial::new(self.bulk, self.shear, kinematics);
        let (mut deviator, mut mean, mut dissipated) = (trial.deviator, trial.mean, zero);
        // q > k − A σ_m without the root: the right side is negative beyond the apex.
        let limit = L::splat(self.strength) - L::splat(self.friction) * mean;
        let yields = L::either(limit.less(zero), (limit * limit).less(trial.square));
        if L::any(yields) {
            let stiffness = L::splat(3.0 * self.shear);
            // Beyond the apex q may be zero; its direction is then of no interest.
            let q = trial.square.sqrt().max(L::splat(f64::MIN_POSITIVE));
            let inverse = one / q;
            let along = (q - limit) * L::splat(1.0 / (3.0 * self.shear + self.bulk * self.friction * self.dilation));
            let most = q * L::splat(1.0 / (3.0 * self.shear));
            let at_apex = most.less(along);
            let step = L::select(at_apex, most, along);
            let swelling = L::select(at_apex, (mean - L::splat(self.apex)) * L::splat(1.0 / self.bulk), L::splat(self.dilation) * along);
            let (step, swelling) = (L::select(yields, step, zero), L::select(yields, swelling, zero));
            let new = mean - L::splat(self.bulk) * swelling;
            let old = mean - L::splat(self.bulk) * kinematics.strain_increment.trace();
            let shear_mean = (trial.old(self.shear, kinematics.strain_increment, q, inverse) + (q - stiffness * step)) * half;
            let work = shear_mean * step + (old + new) * half * swelling;
            dissipated = L::select(yields, work.max(zero), zero);
            let factor = L::select(at_apex, zero, one - stiffness * step * inverse);
            deviator = trial.scaled(factor, yields);
            mean = L::select(yields, new, mean);
            state[0] += step;
        }
        Response::rate(deviator.plus_isotropic(mean), dissipated, [self.bulk, self.shear])
    }

    fn stiffness(&self) -> [f64; 2] {
        [self.bulk, self.shear]
    }
}
