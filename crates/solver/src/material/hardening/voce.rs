//! Saturating hardening: σ_y = σ_y0 + (σ_s − σ_y0)(1 − e^{−b ε_p}) + H ε_p.
//!
//! A saturation below the initial yield stress, or H < 0, makes the flow stress fall; with H < 0 down to
//! zero, where it stays (see `linear.rs`). Source: Voce, Journal of the Institute of Metals 74 (1948)
//! 537-562; with the linear term as in Simo and Hughes (1998), box 3.2.

use super::super::{DENSITY, LawKind, POISSON, Parameters, YOUNG};
use super::{Flow, Hardening, RATE_EXPONENT, RATE_REFERENCE, YIELD};
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
                "flow stress at which hardening ends; below `yield` the material softens",
            )
            .such_as("600 MPa"),
            Parameter::new(
                "saturation_rate",
                "b",
                Dimension::NONE,
                Range::Positive,
                "how fast: after a plastic strain of 1/b 63 % are done",
            )
            .such_as("10"),
            Parameter::new("hardening", "H", Dimension::PRESSURE, Range::Finite, "plastic modulus that stays").or(0.0),
            RATE_REFERENCE,
            RATE_EXPONENT,
        ],
    };

    type StoredFlow<L: Lane> = [L; 2];

    fn new(parameters: &Parameters<'_>, _shear: f64) -> Self {
        let value = |name| parameters.value(name);
        Self {
            yield_stress: value("yield"),
            gain: value("saturation") - value("yield"),
            rate: value("saturation_rate"),
            modulus: value("hardening"),
        }
    }

    fn falling(parameters: &Parameters<'_>) -> Option<(&'static str, f64, Option<f64>)> {
        let it = Self::new(parameters, 0.0);
        let steepest = it.steepest();
        let gone_at = (it.modulus < 0.0).then(|| it.gone_at());
        (steepest < 0.0).then_some((if it.gain < 0.0 { "saturation" } else { "hardening" }, steepest, gone_at))
    }

    #[inline(always)]
    fn flow<L: Lane>(&self, plastic: L) -> Flow<L> {
        let left = L::splat(self.gain) * math::exp(L::splat(-self.rate) * plastic);
        let (modulus, rate) = (L::splat(self.modulus), L::splat(self.rate));
        let stress = L::splat(self.yield_stress + self.gain) - left + modulus * plastic;
        let flow = Flow { stress, slope: rate * left + modulus, curvature: -(rate * (rate * left)), reach: L::splat(1.0 / self.rate) };
        if self.modulus < 0.0 { flow.not_negative() } else { flow }
    }
}

impl Voce {
    /// Least dσ_y/dε_p = H + b (σ_s − σ_y0) e^{−b ε_p}, Pa: at the start, or in the end.
    pub(crate) fn steepest(&self) -> f64 {
        (self.modulus + self.rate * self.gain).min(self.modulus)
    }

    /// The plastic strain at which nothing is left with H < 0, bisected to the last digits.
    fn gone_at(&self) -> f64 {
        let stress = |plastic: f64| self.yield_stress - self.gain * (-self.rate * plastic).exp_m1() + self.modulus * plastic;
        let (mut low, mut high) = (0.0, (self.yield_stress + self.gain.max(0.0)) / -self.modulus);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if stress(middle) > 0.0 { low = middle } else { high = middle }
        }
        high
    }
}
