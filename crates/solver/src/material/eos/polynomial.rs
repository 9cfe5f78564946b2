//! Polynomial: p = C0 + C1 µ + C2 µ² + C3 µ³ + (C4 + C5 µ + C6 µ²) E with µ = ρ/ρ₀ − 1 = 1/v − 1; the terms
//! of C2 and C6 are left out in tension (µ < 0), where they would push the wrong way. Source: the linear
//! polynomial equation of DYNA2D, Hallquist, UCID-18756 (1988).

use super::{Equation, EquationKind, Terms};
use crate::material::Parameters;
use crate::quantity::{Dimension, Parameter, Range};
use embate_lanes::Lane;

/// The equation with its coefficients.
#[derive(Clone, Copy, Debug)]
pub struct Polynomial {
    cold: [f64; 4],
    heat: [f64; 3],
    energy: f64,
}

impl Equation for Polynomial {
    const KIND: EquationKind = EquationKind {
        name: "polynomial",
        doc: "p = C0 + C1 µ + C2 µ² + C3 µ³ + (C4 + C5 µ + C6 µ²) E, µ = ρ/ρ₀ − 1; C2 and C6 only in compression",
        source: "Hallquist, DYNA2D, UCID-18756 (1988)",
        parameters: &[
            Parameter::new("coefficients", "C0..C3", Dimension::PRESSURE, Range::Finite, "C0, C1, C2, C3; those left out are 0")
                .such_as("2.2 GPa")
                .list(4),
            Parameter::new("coefficients_energy", "C4..C6", Dimension::NONE, Range::Finite, "C4, C5, C6; those left out are 0")
                .or(0.0)
                .list(3),
            super::ENERGY.or(0.0),
        ],
    };

    fn new(parameters: &Parameters<'_>) -> Self {
        let (cold, heat) = (parameters.array("coefficients", 0.0), parameters.array("coefficients_energy", 0.0));
        Self { cold, heat, energy: parameters.value("energy_initial") }
    }

    #[inline(always)]
    fn terms<L: Lane>(&self, ratio: L) -> Terms<L> {
        let (one, zero) = (L::splat(1.0), L::splat(0.0));
        let [c0, c1, c2, c3] = [L::splat(self.cold[0]), L::splat(self.cold[1]), L::splat(self.cold[2]), L::splat(self.cold[3])];
        let [c4, c5, c6] = [L::splat(self.heat[0]), L::splat(self.heat[1]), L::splat(self.heat[2])];
        let inverse = one / ratio;
        let excess = inverse - one;
        let tension = excess.less(zero);
        let (c2, c6) = (L::select(tension, zero, c2), L::select(tension, zero, c6));
        // dµ/dv = −1/v²
        let turn = -(inverse * inverse);
        let twice = excess + excess;
        Terms {
            cold: c0 + excess * (c1 + excess * (c2 + excess * c3)),
            cold_slope: turn * (c1 + twice * c2 + L::splat(3.0) * excess * excess * c3),
            heat: c4 + excess * (c5 + excess * c6),
            heat_slope: turn * (c5 + twice * c6),
        }
    }

    fn energy(&self) -> f64 {
        self.energy
    }
}
