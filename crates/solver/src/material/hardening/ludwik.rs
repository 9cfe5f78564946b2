//! Power law of the plastic strain: σ_y = σ_y0 + K ε_p^n.
//!
//! Its slope is infinite at the start. There the chord with a thousand times the elastic stiffness stands in
//! for it: σ_y = σ_y0 + min(K ε_p^n, 3000 µ ε_p). The two meet where plastic strain is a thousandth of the
//! elastic strain that made it or less, for steel at ε_p = 1e-7. Source: Ludwik, Elemente der technologischen
//! Mechanik, Springer (1909).

use super::super::{DENSITY, LawKind, POISSON, Parameters, YOUNG};
use super::{Flow, Hardening, RATE_EXPONENT, RATE_REFERENCE, YIELD};
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
    /// Twice the plastic strain where the chord ends.
    free: f64,
}

impl Power {
    pub(crate) fn new(strength: f64, exponent: f64, shear: f64) -> Self {
        let chord = STEEPEST * 3.0 * shear;
        let end = if exponent < 1.0 { math::pow(strength / chord, 1.0 / (1.0 - exponent)) } else { 0.0 };
        Self { strength, exponent, chord, free: 2.0 * end }
    }

    /// The term; where the chord is or is near, no one knows how far it continues.
    #[inline(always)]
    pub(crate) fn flow<L: Lane>(&self, plastic: L) -> Flow<L> {
        let power = L::splat(self.strength) * math::pow(plastic, L::splat(self.exponent));
        let chord = L::splat(self.chord) * plastic;
        let curved = power.less(chord);
        let inverse = L::splat(1.0) / plastic;
        let slope = L::select(curved, L::splat(self.exponent) * power * inverse, L::splat(self.chord));
        let known = L::splat(self.free).less(plastic);
        let curvature = self.curvature_where(known, slope, inverse);
        let reach = L::select(known, L::splat(0.5) * plastic, L::splat(0.0));
        Flow { stress: L::select(curved, power, chord), slope, curvature, reach }
    }

    /// The curvature of the term where its slope is this, Pa; zero where the chord is or is near.
    #[inline(always)]
    pub(crate) fn curvature<L: Lane>(&self, plastic: L, slope: L) -> L {
        self.curvature_where(L::splat(self.free).less(plastic), slope, L::splat(1.0) / plastic)
    }

    #[inline(always)]
    fn curvature_where<L: Lane>(&self, known: L::Mask, slope: L, inverse: L) -> L {
        L::select(known, L::splat(self.exponent - 1.0) * slope * inverse, L::splat(0.0))
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
            )
            .such_as("500 MPa"),
            Parameter::new("hardening_exponent", "n", Dimension::NONE, Range::UpTo(0.0, 1.0), "exponent").such_as("0.3"),
            RATE_REFERENCE,
            RATE_EXPONENT,
        ],
    };

    type StoredFlow<L: Lane> = [L; 2];

    fn new(parameters: &Parameters<'_>, shear: f64) -> Self {
        let power = Power::new(parameters.value("strength"), parameters.value("hardening_exponent"), shear);
        Self { yield_stress: parameters.value("yield"), power }
    }

    #[inline(always)]
    fn flow<L: Lane>(&self, plastic: L) -> Flow<L> {
        let power = self.power.flow(plastic);
        Flow { stress: L::splat(self.yield_stress) + power.stress, ..power }
    }
}
