//! Isotropic linear elasticity in rate form (hypoelastic, Jaumann rate).
//!
//! σ̂ = K tr(d) I + 2µ dev(d): over a step σ ← Q σ Qᵀ + K tr(Δε) I + 2µ dev(Δε), with Q from Hughes and
//! Winget (1980) and the mid-step Δε turned by half of Q. Right for small elastic strains and any rotation;
//! for large elastic strains take `neo_hookean`.

use super::{
    DENSITY, Family, Fibre, Kinematics, Law, LawKind, Layer, POISSON, Parameters, Response, YOUNG, bulk_and_shear, young_and_poisson,
};
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
    const CAN_BE_AVERAGED: bool = true;

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

    fn has_layer(&self) -> bool {
        true
    }

    #[inline(always)]
    fn layer<L: Lane, T: SymmetricTensor<L>>(&self, strain: [L; 6], old: [L; 6], _state: &mut [L; 0]) -> Layer<L> {
        let [young, poisson] = young_and_poisson([self.bulk, self.shear]);
        let (along, twice) = (L::splat(young / (1.0 - poisson * poisson)), L::splat(2.0 * self.shear));
        let mixed = L::splat(poisson) * along;
        let more = [along * strain[0] + mixed * strain[1], along * strain[1] + mixed * strain[0]];
        let mut stress = [old[0] + more[0], old[1] + more[1], L::splat(0.0), old[3], old[4], old[5]];
        for k in 3..6 {
            stress[k] += twice * strain[k];
        }
        Layer { stress, across: -(L::splat(poisson / young) * (more[0] + more[1])), dissipated: L::splat(0.0) }
    }

    fn has_fibre(&self) -> bool {
        true
    }

    #[inline(always)]
    fn fibre<L: Lane, T: SymmetricTensor<L>>(&self, strain: [L; 2], old: [L; 2], _state: &mut [L; 0]) -> Fibre<L> {
        let [young, poisson] = young_and_poisson([self.bulk, self.shear]);
        let stress = [old[0] + L::splat(young) * strain[0], old[1] + L::splat(2.0 * self.shear) * strain[1]];
        Fibre { stress, across: -(L::splat(poisson) * strain[0]), dissipated: L::splat(0.0) }
    }

    fn stiffness(&self) -> [f64; 2] {
        [self.bulk, self.shear]
    }
}
