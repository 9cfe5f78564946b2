//! Isotropic linear elasticity in rate form (hypoelastic, Jaumann rate).
//!
//! σ̂ = K tr(d) I + 2µ dev(d): over a step σ ← Q σ Qᵀ + K tr(Δε) I + 2µ dev(Δε), with Q from Hughes and
//! Winget (1980) and the mid-step Δε turned by half of Q. Right for small elastic strains and any rotation;
//! for large elastic strains take `neo_hookean`.

use super::{DENSITY, Family, Kinematics, Law, LawKind, POISSON, Parameters, Response, YOUNG, bulk_and_shear};
use crate::tensor::SymmetricTensor;
use embate_lanes::Lane;

/// The law with its moduli.
#[derive(Clone, Copy, Debug)]
pub struct Elastic {
    bulk: f64,
    shear: f64,
}

impl Law for Elastic {
    const KIND: LawKind = LawKind {
        name: "elastic",
        doc: "isotropic linear elasticity in rate form; small elastic strains, any rotation",
        source: "Hughes and Winget, Int. J. Numer. Meth. Engng 15 (1980) 1862-1867",
        parameters: &[DENSITY, YOUNG, POISSON],
    };
    const FAMILY: Family = Family::Rate;
    type State<L: Lane, T: SymmetricTensor<L>> = [L; 0];

    fn new(parameters: &Parameters<'_>) -> Self {
        let [bulk, shear] = bulk_and_shear(parameters);
        Self { bulk, shear }
    }

    #[inline(always)]
    fn update<L: Lane, T: SymmetricTensor<L>>(&self, kinematics: &Kinematics<L, T>, _state: &mut [L; 0]) -> Response<L, T> {
        let shear = L::splat(self.shear);
        let strain = kinematics.strain_increment;
        let lame = L::splat(self.bulk - 2.0 / 3.0 * self.shear);
        let stress = kinematics.stress_rotated.plus(strain.times(shear + shear)).plus_isotropic(lame * strain.trace());
        Response::rate(stress, L::splat(0.0), [self.bulk, self.shear])
    }

    fn stiffness(&self) -> [f64; 2] {
        [self.bulk, self.shear]
    }
}
