//! A fluid: no shear stress but that of a Newtonian viscosity, s = 2µ dev(Δε)/Δt; the pressure is that of an
//! equation of state, which it needs.
//!
//! What the viscosity takes is heat: s:Δε. In the stable step it counts as a shear stiffness 2µ/Δt: with the
//! viscous force from the velocity before the step, central differences are stable for (ωΔt)²/4 + λΔt/2 ≤ 1,
//! λ the rate at which the fastest shear decays. The step is that of the step before, so a fluid so stiff
//! that µ/Δt is not small against its bulk stiffness needs a smaller `[run] time_step` for its first steps.
//! Source: Landau and Lifshitz, Fluid Mechanics (1987), section 15.

use super::{DENSITY, Family, Kinematics, Law, LawKind, Parameters, Response};
use crate::quantity::{Dimension, Parameter, Range};
use crate::tensor::SymmetricTensor;
use embate_lanes::Lane;

/// The fluid with its viscosity.
#[derive(Clone, Copy, Debug)]
pub struct Null {
    viscosity: f64,
}

impl Law for Null {
    const KIND: LawKind = LawKind {
        name: "null",
        doc: "fluid: pressure from an equation of state (`eos`), no shear stress but that of a viscosity",
        source: "Landau and Lifshitz, Fluid Mechanics (1987), section 15",
        parameters: &[
            DENSITY.such_as("1000 kg/m^3"),
            Parameter::new(
                "viscosity",
                "µ",
                Dimension::VISCOSITY,
                Range::NotNegative,
                "shear stress per rate of shear (dynamic viscosity)",
            )
            .or(0.0),
        ],
    };
    const FAMILY: Family = Family::Rate;
    type State<L: Lane, T: SymmetricTensor<L>> = [L; 0];
    const NEEDS_EQUATION_OF_STATE: bool = true;

    fn new(parameters: &Parameters<'_>) -> Self {
        Self { viscosity: parameters.value("viscosity") }
    }

    #[inline(always)]
    fn update<L: Lane, T: SymmetricTensor<L>>(&self, kinematics: &Kinematics<L, T>, _state: &mut [L; 0]) -> Response<L, T> {
        let zero = L::splat(0.0);
        let still = kinematics.time_step.less(L::splat(f64::MIN_POSITIVE));
        let factor = L::select(still, zero, L::splat(2.0 * self.viscosity) / kinematics.time_step);
        let stress = kinematics.strain_increment.deviator().times(factor);
        let dissipated = stress.contract(kinematics.strain_increment);
        Response { stress, stored: zero, dissipated, bulk: zero, shear: factor }
    }

    fn stiffness(&self) -> [f64; 2] {
        [0.0, 0.0]
    }
}
