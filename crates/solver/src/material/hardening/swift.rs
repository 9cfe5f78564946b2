//! Power law with an offset: σ_y = K (ε_0 + ε_p)^n; the initial yield stress is K ε_0^n.
//!
//! Source: Swift, Journal of the Mechanics and Physics of Solids 1 (1952) 1-18.

use super::super::{DENSITY, LawKind, POISSON, Parameters, YOUNG};
use super::{Flow, Hardening, RATE_EXPONENT, RATE_REFERENCE};
use crate::quantity::{Dimension, Parameter, Range};
use embate_lanes::{Lane, math};

/// K, ε_0 and n.
#[derive(Clone, Copy, Debug)]
pub struct Swift {
    strength: f64,
    offset: f64,
    exponent: f64,
}

impl Hardening for Swift {
    const KIND: LawKind = LawKind {
        name: "j2_swift",
        doc: "elasto-plasticity after von Mises with a power law of the strain (Swift)",
        source: "Swift, J. Mech. Phys. Solids 1 (1952) 1-18",
        parameters: &[
            DENSITY,
            YOUNG,
            POISSON,
            Parameter::new("strength", "K", Dimension::PRESSURE, Range::Positive, "flow stress at a strain of one").such_as("900 MPa"),
            Parameter::new("strain_offset", "ε_0", Dimension::NONE, Range::Positive, "strain at first yield: the yield stress is K ε_0^n")
                .such_as("0.002"),
            Parameter::new("hardening_exponent", "n", Dimension::NONE, Range::UpTo(0.0, 1.0), "exponent").such_as("0.2"),
            RATE_REFERENCE,
            RATE_EXPONENT,
        ],
    };

    type StoredFlow<L: Lane> = [L; 2];

    fn new(parameters: &Parameters<'_>, _shear: f64) -> Self {
        let value = |name| parameters.value(name);
        Self { strength: value("strength"), offset: value("strain_offset"), exponent: value("hardening_exponent") }
    }

    #[inline(always)]
    fn flow<L: Lane>(&self, plastic: L) -> Flow<L> {
        let strain = L::splat(self.offset) + plastic;
        let stress = L::splat(self.strength) * math::pow(strain, L::splat(self.exponent));
        let inverse = L::splat(1.0) / strain;
        let slope = L::splat(self.exponent) * stress * inverse;
        Flow { stress, slope, curvature: L::splat(self.exponent - 1.0) * slope * inverse, reach: L::splat(0.5) * strain }
    }
}
