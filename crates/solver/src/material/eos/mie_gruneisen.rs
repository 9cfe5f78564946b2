//! Mie-Grüneisen about the shock Hugoniot of a solid or liquid.
//!
//! Shock speed u_s = c0 + s1 u_p + s2 (u_p/u_s) u_p + s3 (u_p/u_s)² u_p, so with η = 1 − v = u_p/u_s and
//! µ = 1/v − 1:
//!
//! ```text
//! p_H = ρ₀ c0² η / (1 − s1 η − s2 η² − s3 η³)²,   E_H = ½ p_H η,   Γ = γ0 + a µ
//! p = p_H + Γ (E − E_H)   (compression)
//! p = ρ₀ c0² µ + Γ E       (tension)
//! ```
//!
//! Γ is the Grüneisen parameter times v. With E from the energy balance of the step a steady shock lies on
//! the Hugoniot itself. Source: Meyers, Dynamic Behavior of Materials (1994), chapter 5; Steinberg,
//! UCRL-MA-106439 (1996).

use super::{Equation, EquationKind, Terms};
use crate::material::Parameters;
use crate::quantity::{Dimension, Parameter, Range};
use embate_lanes::Lane;

/// The equation with its parameters.
#[derive(Clone, Copy, Debug)]
pub struct MieGruneisen {
    bulk: f64,
    slopes: [f64; 3],
    gamma: f64,
    gamma_slope: f64,
    energy: f64,
}

impl Equation for MieGruneisen {
    const KIND: EquationKind = EquationKind {
        name: "mie_gruneisen",
        doc: "solid or liquid in strong shocks, u_s = c0 + s1 u_p + ..., heat by the Grüneisen parameter",
        source: "Meyers, Dynamic Behavior of Materials (1994), chapter 5",
        parameters: &[
            Parameter::new("c0", "c0", Dimension::VELOCITY, Range::Positive, "speed of weak shocks").such_as("4000 m/s"),
            Parameter::new("s1", "s1", Dimension::NONE, Range::NotNegative, "growth of the shock speed with the particle speed")
                .such_as("1.5"),
            Parameter::new("s2", "s2", Dimension::NONE, Range::Finite, "second coefficient, of (u_p/u_s) u_p").or(0.0),
            Parameter::new("s3", "s3", Dimension::NONE, Range::Finite, "third coefficient, of (u_p/u_s)² u_p").or(0.0),
            Parameter::new("gamma0", "γ0", Dimension::NONE, Range::NotNegative, "Grüneisen parameter at the start").such_as("2"),
            Parameter::new("gamma_slope", "a", Dimension::NONE, Range::Finite, "its change times v with the compression: Γ = γ0 + a µ")
                .or(0.0),
            super::ENERGY.or(0.0),
        ],
    };

    fn new(parameters: &Parameters<'_>) -> Self {
        let value = |name| parameters.value(name);
        Self {
            bulk: value("density") * value("c0") * value("c0"),
            slopes: ["s1", "s2", "s3"].map(value),
            gamma: value("gamma0"),
            gamma_slope: value("gamma_slope"),
            energy: value("energy_initial"),
        }
    }

    #[inline(always)]
    fn terms<L: Lane>(&self, ratio: L) -> Terms<L> {
        let (zero, one, half) = (L::splat(0.0), L::splat(1.0), L::splat(0.5));
        let [s1, s2, s3] = [L::splat(self.slopes[0]), L::splat(self.slopes[1]), L::splat(self.slopes[2])];
        let bulk = L::splat(self.bulk);
        let inverse = one / ratio;
        let excess = inverse - one;
        let turn = -(inverse * inverse);
        let gamma = L::splat(self.gamma) + L::splat(self.gamma_slope) * excess;
        let gamma_turn = L::splat(self.gamma_slope) * turn;
        let share = one - ratio;
        let below = one - share * (s1 + share * (s2 + share * s3));
        let below_slope = s1 + share * (s2 + s2 + L::splat(3.0) * share * s3);
        let square = bulk / (below * below);
        let shock = square * share;
        let shock_slope = square + (shock + shock) * below_slope / below;
        let cold = shock - half * gamma * shock * share;
        let slope = half * gamma * (shock_slope * share + shock) - shock_slope - half * gamma_turn * shock * share;
        let tension = excess.less(zero);
        Terms {
            cold: L::select(tension, bulk * excess, cold),
            cold_slope: L::select(tension, bulk * turn, slope),
            heat: gamma,
            heat_slope: gamma_turn,
        }
    }

    fn energy(&self) -> f64 {
        self.energy
    }
}
