//! Falling flow stress: how steep it may be, for the checks of a model.
//!
//! With M = ∂f/∂σ and the slope H = dσ_y/dε_p, stress has one answer to strain where M:C:M + H > 0: at a
//! point with the stiffness C of the solid, in plane stress with that of the plate, in a bar with Young's
//! modulus. C:M is least
//! ```text
//! von Mises     solid 3µ,             plate E / (2 (1 − ν)),                             bar E
//! foam          solid min(3µ, Kα²)/c, plate min(E (½ + 2α²/9) / (c (1 − ν)), 3µ/c),      bar E
//! ```
//! (plate: of all states of plane stress, equal tension along x and y or shear). A slope is refused from nine
//! tenths of it on: there a strain increment already makes ten times itself of plastic strain. Source: Hill,
//! Journal of the Mechanics and Physics of Solids 6 (1958) 236-249; de Borst et al., Non-linear Finite
//! Element Analysis of Solids and Structures (2012).

use super::{ParameterFault, young_and_poisson};
use crate::material::messages::SOFTENS_TOO_STEEPLY;

/// Largest fall over that at which stress has no answer to strain any more.
const STEEPEST: f64 = 0.9;

/// How a flow stress falls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Softening {
    /// The parameter that makes it fall.
    pub name: &'static str,
    /// Least dσ_y/dε_p, Pa: negative.
    pub slope: f64,
    /// Plastic strain at which nothing is left; `None` where something always is.
    pub gone_at: Option<f64>,
    /// M:C:M at a point, Pa.
    pub solid: f64,
    /// In plane stress, Pa.
    pub plate: f64,
    /// In a bar, Pa.
    pub bar: f64,
}

impl Softening {
    /// Of a law after von Mises with the moduli K and µ.
    #[must_use]
    pub(super) fn von_mises(name: &'static str, slope: f64, gone_at: Option<f64>, [bulk, shear]: [f64; 2]) -> Self {
        let [young, poisson] = young_and_poisson([bulk, shear]);
        Self { name, slope, gone_at, solid: 3.0 * shear, plate: young / (2.0 * (1.0 - poisson)), bar: young }
    }

    /// Of a foam with α² and c.
    #[must_use]
    pub(super) fn foam(name: &'static str, slope: f64, [bulk, shear]: [f64; 2], square: f64, scale: f64) -> Self {
        let [young, poisson] = young_and_poisson([bulk, shear]);
        let solid = (3.0 * shear).min(bulk * square) / scale;
        let plate = (young * (0.5 + 2.0 * square / 9.0) / (1.0 - poisson)).min(3.0 * shear) / scale;
        Self { name, slope, gone_at: None, solid, plate, bar: young }
    }

    /// Whether it falls too steeply where the stiffness against flow is `stiffness` (one of its fields).
    #[must_use]
    pub fn is_too_steep(&self, stiffness: f64) -> bool {
        -self.slope > STEEPEST * stiffness
    }

    /// What to say about that, and what to do.
    #[must_use]
    pub fn too_steep(&self, stiffness: f64) -> (String, String) {
        let message = format!(
            "the flow stress falls by up to {:.4e} Pa per plastic strain, which is more than nine tenths of the stiffness against flow, {stiffness:.4e} Pa: stress has no \
             sound answer to strain there",
            -self.slope
        );
        (message, format!("let it fall by less than {:.4e} Pa per plastic strain", STEEPEST * stiffness))
    }

    /// The fault of a law's parameters, where the flow stress falls too steeply at a point.
    pub(super) fn faults(it: Option<Self>) -> Vec<ParameterFault> {
        let fault = |it: Self| {
            let (message, help) = it.too_steep(it.solid);
            ParameterFault { kind: &SOFTENS_TOO_STEEPLY, name: it.name, message, help }
        };
        it.filter(|it| it.is_too_steep(it.solid)).map(fault).into_iter().collect()
    }
}
