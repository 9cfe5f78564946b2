//! Power law of the plastic strain: σ_y = σ_y0 + K ε_p^n.
//!
//! Its slope is infinite at the start. There the chord with a thousand times the elastic stiffness stands in for it: σ_y = σ_y0 + min(K ε_p^n,
//! 3000 µ ε_p). The two meet where plastic strain is a thousandth of the elastic strain that made it or less, for steel at ε_p = 1e-7.
//! Source: Ludwik, Elemente der technologischen Mechanik, Springer (1909).

use super::super::{DENSITY, LawKind, POISSON, Parameters, YOUNG};
use super::{Hardening, RATE_EXPONENT, RATE_REFERENCE, YIELD};
use crate::quantity::{Dimension, Parameter, Range};
use embate_lanes::{Lane, math};

/// Slope of the chord at the start, over 3µ.
const STEEPEST: f64 = 1000.0;

/// The term K ε_p^n with its chord at the start.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Power {
    strength: f64,
    exponent: f64,
    chord: f64,
}

impl Power {
    pub(crate) fn new(strength: f64, exponent: f64, shear: f64) -> Self {
        Self { strength, exponent, chord: STEEPEST * 3.0 * shear }
    }

    /// Stress and its slope.
    #[inline(always)]
    pub(crate) fn flow<L: Lane>(&self, plastic: L) -> [L; 2] {
        let power = L::splat(self.strength) * math::pow(plastic, L::splat(self.exponent));
        let chord = L::splat(self.chord) * plastic;
        let curved = power.less(chord);
        let slope = L::select(curved, L::splat(self.exponent) * power / plastic, L::splat(self.chord));
        [L::select(curved, power, chord), slope]
    }
}

/// σ_y0 and the power.
#[derive(Clone, Copy, Debug)]
pub struct Ludwik {
    yield_stress: f64,
    power: Power,
}

impl Hardening for Ludwik {
    const KIND: LawKind = LawKind {
        name: "j2_ludwik",
        doc: "elasto-plasticity after von Mises with a power law of the plastic strain (Ludwik)",
        source: "Ludwik, Elemente der technologischen Mechanik (1909)",
        parameters: &[
            DENSITY,
            YOUNG,
            POISSON,
            YIELD,
            Parameter::new(
                "strength",
                "K",
                Dimension::PRESSURE,
                Range::NotNegative,
                "what a plastic strain of one adds to the flow stress",
            ),
            Parameter::new("hardening_exponent", "n", Dimension::NONE, Range::UpTo(0.0, 1.0), "exponent"),
            RATE_REFERENCE,
            RATE_EXPONENT,
        ],
    };

    type Kept<L: Lane> = [L; 2];

    fn new(parameters: &Parameters<'_>, shear: f64) -> Self {
        let power = Power::new(parameters.value("strength"), parameters.value("hardening_exponent"), shear);
        Self { yield_stress: parameters.value("yield"), power }
    }

    #[inline(always)]
    fn flow<L: Lane>(&self, plastic: L) -> [L; 2] {
        let [power, slope] = self.power.flow(plastic);
        [L::splat(self.yield_stress) + power, slope]
    }
}
