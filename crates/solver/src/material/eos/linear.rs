//! Linear: p = K µ with µ = ρ/ρ₀ − 1 = 1/v − 1. Heat makes no pressure.

use super::{Equation, EquationKind, Terms};
use crate::material::Parameters;
use crate::quantity::{Dimension, Parameter, Range};
use embate_lanes::Lane;

/// The equation with its modulus.
#[derive(Clone, Copy, Debug)]
pub struct Linear {
    bulk: f64,
}

impl Equation for Linear {
    const KIND: EquationKind = EquationKind {
        name: "linear",
        doc: "pressure in proportion to the compression: p = K µ, µ = ρ/ρ₀ − 1",
        source: "definition of the bulk modulus",
        parameters: &[
            Parameter::new("bulk_modulus", "K", Dimension::PRESSURE, Range::Positive, "pressure per compression µ").such_as("2.2 GPa")
        ],
    };

    fn new(parameters: &Parameters<'_>) -> Self {
        Self { bulk: parameters.value("bulk_modulus") }
    }

    #[inline(always)]
    fn terms<L: Lane>(&self, ratio: L) -> Terms<L> {
        let (one, zero, bulk) = (L::splat(1.0), L::splat(0.0), L::splat(self.bulk));
        Terms { cold: bulk * (one / ratio - one), cold_slope: -(bulk / (ratio * ratio)), heat: zero, heat_slope: zero }
    }

    fn energy(&self) -> f64 {
        0.0
    }
}
