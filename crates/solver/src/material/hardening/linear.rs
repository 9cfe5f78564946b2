//! Linear hardening: σ_y = max(σ_y0 + H ε_p, 0).
//!
//! H is the plastic modulus dσ_y/dε_p, not the tangent modulus E_t = E H / (E + H). With H < 0 the flow
//! stress falls to zero, at ε_p = σ_y0 / |H|, and stays there: a flow stress below zero would give energy to
//! what strains the material. What is left bears pressure, and no shear.

use super::super::{DENSITY, LawKind, POISSON, Parameters, YOUNG};
use super::{Flow, Hardening, RATE_EXPONENT, RATE_REFERENCE, YIELD};
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
                Range::Finite,
                "plastic modulus dσ_y/dε_p (not the tangent modulus); negative: the flow stress falls, down to zero",
            )
            .such_as("1 GPa")
            .or(0.0),
            RATE_REFERENCE,
            RATE_EXPONENT,
        ],
    };

    type StoredFlow<L: Lane> = [L; 0];
    const CURVED: bool = false;

    fn new(parameters: &Parameters<'_>, _shear: f64) -> Self {
        Self { yield_stress: parameters.value("yield"), modulus: parameters.value("hardening") }
    }

    fn falling(parameters: &Parameters<'_>) -> Option<(&'static str, f64, Option<f64>)> {
        let modulus = parameters.value("hardening");
        (modulus < 0.0).then(|| ("hardening", modulus, Some(-parameters.value("yield") / modulus)))
    }

    #[inline(always)]
    fn flow<L: Lane>(&self, plastic: L) -> Flow<L> {
        let (zero, modulus) = (L::splat(0.0), L::splat(self.modulus));
        let flow = Flow { stress: L::splat(self.yield_stress) + modulus * plastic, slope: modulus, curvature: zero, reach: zero };
        // A branch that every point takes the same way: hardening pays nothing for it.
        if self.modulus < 0.0 { flow.not_negative() } else { flow }
    }

    #[inline(always)]
    fn modulus(&self) -> Option<f64> {
        (self.modulus >= 0.0).then_some(self.modulus)
    }
}
