//! Ideal gas: p = (γ − 1) ρ e = (γ − 1) E / v, with the specific energy e = E/ρ₀. Its state at the start is
//! given by a pressure or an energy.

use super::{Equation, EquationKind, Terms};
use crate::material::messages::PARAMETERS;
use crate::material::{ParameterFault, Parameters};
use crate::quantity::{Dimension, Parameter, Range};
use embate_lanes::Lane;

/// The gas.
#[derive(Clone, Copy, Debug)]
pub struct IdealGas {
    less_one: f64,
    energy: f64,
}

impl Equation for IdealGas {
    const KIND: EquationKind = EquationKind {
        name: "ideal_gas",
        doc: "gas with constant specific heats: p = (γ − 1) ρ e",
        source: "Landau and Lifshitz, Fluid Mechanics (1987), section 83",
        parameters: &[
            Parameter::new("gamma", "γ", Dimension::NONE, Range::UpTo(1.0, 10.0), "ratio of the specific heats").such_as("1.4"),
            Parameter::new(
                "pressure_initial",
                "p_0",
                Dimension::PRESSURE,
                Range::NotNegative,
                "pressure at the start; it or energy_initial",
            )
            .such_as("101325 Pa")
            .or(0.0),
            super::ENERGY.or(0.0),
        ],
    };

    fn new(parameters: &Parameters<'_>) -> Self {
        let less_one = parameters.value("gamma") - 1.0;
        let pressure = parameters.value("pressure_initial");
        Self { less_one, energy: if pressure > 0.0 { pressure / less_one } else { parameters.value("energy_initial") } }
    }

    fn faults(parameters: &Parameters<'_>) -> Vec<ParameterFault> {
        let given = ["pressure_initial", "energy_initial"].map(|name| parameters.value(name) > 0.0);
        let fault = |message: &str, help: &str| {
            vec![ParameterFault { kind: &PARAMETERS, name: "pressure_initial", message: message.into(), help: help.into() }]
        };
        match given {
            [true, true] => fault("`pressure_initial` and `energy_initial` both say what the gas is like at the start", "leave one out"),
            [false, false] => fault(
                "a gas without pressure has no stiffness: no wave could run in it",
                "give `pressure_initial` or `energy_initial`, greater than 0; little of it for a cold gas",
            ),
            _ => Vec::new(),
        }
    }

    #[inline(always)]
    fn terms<L: Lane>(&self, ratio: L) -> Terms<L> {
        let heat = L::splat(self.less_one) / ratio;
        Terms { cold: L::splat(0.0), cold_slope: L::splat(0.0), heat, heat_slope: -(heat / ratio) }
    }

    fn energy(&self) -> f64 {
        self.energy
    }
}
