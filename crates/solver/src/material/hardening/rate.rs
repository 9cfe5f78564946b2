//! Rate dependence: the flow stress times 1 + (ε̇_p / C)^{1/P}.
//!
//! Source: Cowper and Symonds, Brown University, Division of Applied Mathematics, report 28 (1957). Mild
//! steel: C = 40 1/s, P = 5.

use super::super::{ParameterFault, Parameters};
use crate::material::messages::PARAMETERS;
use crate::quantity::{Dimension, Parameter, Range};
use embate_lanes::{Lane, math};

/// C.
pub(crate) const RATE_REFERENCE: Parameter = Parameter::new(
    "rate_reference",
    "C",
    Dimension::RATE,
    Range::NotNegative,
    "rate of plastic strain that doubles the flow stress (Cowper and Symonds); 0: no dependence on the rate",
)
.or(0.0);
/// P.
pub(crate) const RATE_EXPONENT: Parameter =
    Parameter::new("rate_exponent", "P", Dimension::NONE, Range::Positive, "exponent of the rate, 1 or more; it enters as 1/P").or(5.0);

/// C and P.
#[derive(Clone, Copy, Debug)]
pub struct Rate {
    reference: f64,
    exponent: f64,
}

impl Rate {
    /// `None` without a reference rate.
    #[must_use]
    pub(crate) fn new(parameters: &Parameters<'_>) -> Option<Self> {
        let (reference, exponent) = (parameters.value("rate_reference"), parameters.value("rate_exponent"));
        (reference > 0.0).then_some(Self { reference, exponent })
    }

    pub(crate) fn faults(parameters: &Parameters<'_>) -> Vec<ParameterFault> {
        let exponent = parameters.value("rate_exponent");
        if exponent >= 1.0 {
            return Vec::new();
        }
        vec![ParameterFault {
            kind: &PARAMETERS,
            name: "rate_exponent",
            message: format!("the exponent of the rate must be at least 1, but it is {exponent}"),
            help: "the rate enters as (rate / C)^(1/P): give P, 5 for mild steel, not 1/P".into(),
        }]
    }

    /// u = (Δε_p / (C Δt))^{1/P} of a plastic strain increment.
    #[inline(always)]
    pub(crate) fn excess<L: Lane>(&self, step: L, time_step: L) -> L {
        math::pow(step / self.unit(time_step), L::splat(1.0 / self.exponent))
    }

    /// Δε_p = C Δt u^P and its slope over u.
    #[inline(always)]
    pub(crate) fn strain<L: Lane>(&self, u: L, time_step: L) -> [L; 2] {
        let strain = self.unit(time_step) * math::pow(u, L::splat(self.exponent));
        let slope = L::splat(self.exponent) * strain / u.max(L::splat(f64::MIN_POSITIVE));
        [strain, slope]
    }

    /// C Δt; without time it is as good as none, and the step elastic.
    #[inline(always)]
    fn unit<L: Lane>(&self, time_step: L) -> L {
        (L::splat(self.reference) * time_step).max(L::splat(1e-100))
    }
}
