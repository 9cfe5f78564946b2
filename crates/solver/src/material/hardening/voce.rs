//! Saturating hardening: σ_y = σ_y0 + (σ_s − σ_y0)(1 − e^{−b ε_p}) + H ε_p.
//!
//! Source: Voce, Journal of the Institute of Metals 74 (1948) 537-562; with the linear term as in Simo and Hughes (1998), box 3.2.

use super::super::{DENSITY, LawKind, POISSON, ParameterFault, Parameters, YOUNG};
use super::{Hardening, RATE_EXPONENT, RATE_REFERENCE, YIELD};
use crate::quantity::{Dimension, Parameter, Range};
use embate_lanes::{Lane, math};

/// σ_y0, σ_s − σ_y0, b and H.
#[derive(Clone, Copy, Debug)]
pub struct Voce {
    pub(crate) yield_stress: f64,
    pub(crate) gain: f64,
    pub(crate) rate: f64,
    pub(crate) modulus: f64,
}

impl Hardening for Voce {
    const KIND: LawKind = LawKind {
        name: "j2_voce",
        doc: "elasto-plasticity after von Mises with hardening that saturates (Voce)",
        source: "Voce, J. Inst. Metals 74 (1948) 537-562",
        parameters: &[
            DENSITY,
            YOUNG,
            POISSON,
            YIELD,
            Parameter::new(
                "saturation",
                "σ_s",
                Dimension::PRESSURE,
                Range::Positive,
                "flow stress at which hardening ends, not below `yield`",
            ),
            Parameter::new(
                "saturation_rate",
                "b",
                Dimension::NONE,
                Range::Positive,
                "how fast: after a plastic strain of 1/b 63 % are done",
            ),
            Parameter::new("hardening", "H", Dimension::PRESSURE, Range::NotNegative, "plastic modulus that stays").or(0.0),
            RATE_REFERENCE,
            RATE_EXPONENT,
        ],
    };

    type Kept<L: Lane> = [L; 2];

    fn new(parameters: &Parameters<'_>, _shear: f64) -> Self {
        let value = |name| parameters.value(name);
        Self {
            yield_stress: value("yield"),
            gain: value("saturation") - value("yield"),
            rate: value("saturation_rate"),
            modulus: value("hardening"),
        }
    }

    fn faults(parameters: &Parameters<'_>) -> Vec<ParameterFault> {
        if parameters.value("saturation") >= parameters.value("yield") {
            return Vec::new();
        }
        vec![ParameterFault {
            name: "saturation",
            message: "the saturation stress is below the yield stress, so the material would soften".into(),
            help: "`saturation` is the whole flow stress, not what is added to `yield`".into(),
        }]
    }

    #[inline(always)]
    fn flow<L: Lane>(&self, plastic: L) -> [L; 2] {
        let left = L::splat(self.gain) * math::exp(L::splat(-self.rate) * plastic);
        let modulus = L::splat(self.modulus);
        let stress = L::splat(self.yield_stress + self.gain) - left + modulus * plastic;
        [stress, L::splat(self.rate) * left + modulus]
    }
}
