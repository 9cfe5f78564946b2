//! Jones, Wilkins, Lee: gases of a detonated explosive.
//!
//! ```text
//! p = A (1 − ω/(R1 v)) e^{−R1 v} + B (1 − ω/(R2 v)) e^{−R2 v} + ω E / v
//! ```
//!
//! All of the explosive has burned at the start (constant-volume explosion): there is no detonation front.
//! Source: Lee, Hornig and Kury, UCRL-50422 (1968); values in Dobratz and Crawford, UCRL-52997 (1985).

use super::{Equation, EquationKind, Terms};
use crate::material::Parameters;
use crate::quantity::{Dimension, Parameter, Range};
use embate_lanes::{Lane, math};

/// The equation with its parameters.
#[derive(Clone, Copy, Debug)]
pub struct Jwl {
    /// A, R1 and B, R2.
    terms: [[f64; 2]; 2],
    omega: f64,
    energy: f64,
}

impl Equation for Jwl {
    const KIND: EquationKind = EquationKind {
        name: "jwl",
        doc: "gases of an explosive that has burned at the start (Jones, Wilkins, Lee)",
        source: "Lee, Hornig and Kury, UCRL-50422 (1968)",
        parameters: &[
            Parameter::new("pressure_a", "A", Dimension::PRESSURE, Range::Finite, "first pressure").such_as("371 GPa"),
            Parameter::new("pressure_b", "B", Dimension::PRESSURE, Range::Finite, "second pressure").such_as("3.2 GPa"),
            Parameter::new("r1", "R1", Dimension::NONE, Range::Positive, "decay of the first pressure with v").such_as("4.15"),
            Parameter::new("r2", "R2", Dimension::NONE, Range::Positive, "decay of the second pressure with v").such_as("0.95"),
            Parameter::new("omega", "ω", Dimension::NONE, Range::Positive, "Grüneisen parameter of the expanded gas").such_as("0.3"),
            super::ENERGY,
        ],
    };

    fn new(parameters: &Parameters<'_>) -> Self {
        let terms = [["pressure_a", "r1"], ["pressure_b", "r2"]].map(|names| names.map(|name| parameters.value(name)));
        Self { terms, omega: parameters.value("omega"), energy: parameters.value("energy_initial") }
    }

    #[inline(always)]
    fn terms<L: Lane>(&self, ratio: L) -> Terms<L> {
        let (one, omega) = (L::splat(1.0), L::splat(self.omega));
        let (mut cold, mut slope) = (L::splat(0.0), L::splat(0.0));
        for term in 0..2 {
            let [pressure, rate] = self.terms[term];
            let rate = L::splat(rate);
            let fall = L::splat(pressure) * math::exp(-(rate * ratio));
            let share = omega / (rate * ratio);
            cold += fall * (one - share);
            slope += fall * (share / ratio - rate * (one - share));
        }
        let heat = omega / ratio;
        Terms { cold, cold_slope: slope, heat, heat_slope: -(heat / ratio) }
    }

    fn energy(&self) -> f64 {
        self.energy
    }
}
