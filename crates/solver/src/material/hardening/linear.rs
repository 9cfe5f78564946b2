//! Linear hardening: σ_y = σ_y0 + H ε_p.
//!
//! H is the plastic modulus dσ_y/dε_p, not the tangent modulus E_t = E H / (E + H).

use super::super::{DENSITY, LawKind, POISSON, Parameters, YOUNG};
use super::{Hardening, RATE_EXPONENT, RATE_REFERENCE, YIELD};
use crate::quantity::{Dimension, Parameter, Range};
use embate_lanes::Lane;

/// σ_y0 and H, Pa.
#[derive(Clone, Copy, Debug)]
pub struct Linear {
    yield_stress: f64,
    modulus: f64,
}

impl Hardening for Linear {
    const KIND: LawKind = LawKind {
        name: "j2",
        doc: "elasto-plasticity after von Mises with linear isotropic hardening",
        source: "Simo and Hughes, Computational Inelasticity (1998), box 3.2",
        parameters: &[
            DENSITY,
            YOUNG,
            POISSON,
            YIELD,
            Parameter::new(
                "hardening",
                "H",
                Dimension::PRESSURE,
                Range::NotNegative,
                "plastic modulus dσ_y/dε_p (not the tangent modulus)",
            )
            .or(0.0),
            RATE_REFERENCE,
            RATE_EXPONENT,
        ],
    };

    type Kept<L: Lane> = [L; 0];

    fn new(parameters: &Parameters<'_>, _shear: f64) -> Self {
        Self { yield_stress: parameters.value("yield"), modulus: parameters.value("hardening") }
    }

    #[inline(always)]
    fn flow<L: Lane>(&self, plastic: L) -> [L; 2] {
        let modulus = L::splat(self.modulus);
        [L::splat(self.yield_stress) + modulus * plastic, modulus]
    }

    #[inline(always)]
    fn modulus(&self) -> Option<f64> {
        Some(self.modulus)
    }
}
