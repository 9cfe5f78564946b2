//! Compressible neo-Hookean rubber, hyperelastic, with separate volumetric and isochoric energies.
//!
//! W = ½µ (J^{-2/3} tr b − 3) + ¼K (J² − 1 − 2 ln J) per initial volume; σ = µ J^{-5/3} dev b + ½K (J − 1/J)
//! I. Moduli at rest K and µ. Source: Simo and Taylor, Comput. Meth. Appl. Mech. Engng 85 (1991) 273-310;
//! Holzapfel, Nonlinear Solid Mechanics (2000), 6.5.
//!
//! Stiffness for the stable step: waves along n have ρc² = J p' + (4/3 µ̄ − ⅓ s_nn)/J (pressure waves) and µ
//! b̄_nn/J (shear waves), with µ̄ = µ tr b̄ / 3; the eigenvalues of b̄ lie within √(2/3) |dev b̄| of their
//! mean, so µ̄ + µ √(2/3) |dev b̄| bounds both.

use super::rubber::{Unimodular, Volume, isochoric};
use super::{DENSITY, Family, Kinematics, Law, LawKind, POISSON, Parameters, Response, YOUNG, bulk_and_shear};
use crate::tensor::SymmetricTensor;
use embate_lanes::Lane;

/// The law with its moduli.
#[derive(Clone, Copy, Debug)]
pub struct NeoHookean {
    bulk: f64,
    shear: f64,
}

impl Law for NeoHookean {
    const KIND: LawKind = LawKind {
        name: "neo_hookean",
        doc: "compressible rubber elasticity for large strains, from the left Cauchy-Green tensor",
        source: "Simo and Taylor, Comput. Meth. Appl. Mech. Engng 85 (1991) 273-310",
        parameters: &[DENSITY.such_as("1000 kg/m^3"), YOUNG.such_as("5 MPa"), POISSON.such_as("0.49")],
    };
    const FAMILY: Family = Family::Hyperelastic;
    const CAN_BE_AVERAGED: bool = true;
    type State<L: Lane, T: SymmetricTensor<L>> = [L; 0];

    fn new(parameters: &Parameters<'_>) -> Self {
        let [bulk, shear] = bulk_and_shear(parameters);
        Self { bulk, shear }
    }

    #[inline(always)]
    fn update<L: Lane, T: SymmetricTensor<L>>(&self, kinematics: &Kinematics<L, T>, _state: &mut [L; 0]) -> Response<L, T> {
        let (j, b) = (kinematics.volume_ratio, kinematics.left_cauchy_green);
        let inverse = L::splat(1.0) / j;
        let b = Unimodular::new(b, isochoric(j, inverse));
        let volume = Volume::new(self.bulk, j, inverse);
        let shear = L::splat(self.shear) * inverse;
        Response {
            stress: b.deviator.times(shear).plus_isotropic(volume.pressure),
            stored: L::splat(1.5 * self.shear) * b.above + volume.stored,
            dissipated: L::splat(0.0),
            bulk: volume.stiffness,
            shear: shear * (b.mean + b.spread),
        }
    }

    fn stiffness(&self) -> [f64; 2] {
        [self.bulk, self.shear]
    }
}
