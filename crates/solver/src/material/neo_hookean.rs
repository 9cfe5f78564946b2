//! Compressible neo-Hookean rubber, hyperelastic, with separate volumetric and isochoric energies.
//!
//! W = ½µ (J^{-2/3} tr b − 3) + ¼K (J² − 1 − 2 ln J) per initial volume;
//! σ = µ J^{-5/3} dev b + ½K (J − 1/J) I. Moduli at rest K and µ.
//! Source: Simo and Taylor, Comput. Meth. Appl. Mech. Engng 85 (1991) 273-310; Holzapfel, Nonlinear Solid Mechanics (2000), 6.5.
//!
//! Both terms of W are squares of small numbers near rest, but differences of numbers near one as they stand: a stiff body's round-off would
//! outweigh the whole energy of a slow start. With e = tr b̄ / 3 and s̄ = dev b̄, det b̄ = 1 reads e³ − ½(s̄:s̄) e + det s̄ = 1, so
//! e − 1 = (½(s̄:s̄) e − det s̄) / (e² + e + 1).
//!
//! Stiffness for the stable step: waves along n have ρc² = J p' + (4/3 µ̄ − ⅓ s_nn)/J (pressure waves) and µ b̄_nn/J (shear waves), with
//! µ̄ = µ tr b̄ / 3; the eigenvalues of b̄ lie within √(2/3) |dev b̄| of their mean, so µ̄ + µ √(2/3) |dev b̄| bounds both.

use super::{DENSITY, Family, Kinematics, Law, LawKind, POISSON, Parameters, Response, YOUNG, bulk_and_shear};
use crate::tensor::SymmetricTensor;
use embate_lanes::{Lane, math};

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
        parameters: &[DENSITY, YOUNG, POISSON],
    };
    const FAMILY: Family = Family::Hyperelastic;
    type State<L: Lane, T: SymmetricTensor<L>> = [L; 0];

    fn new(parameters: &Parameters<'_>) -> Self {
        let [bulk, shear] = bulk_and_shear(parameters);
        Self { bulk, shear }
    }

    #[inline(always)]
    fn update<L: Lane, T: SymmetricTensor<L>>(&self, kinematics: &Kinematics<L, T>, _state: &mut [L; 0]) -> Response<L, T> {
        let (half, one) = (L::splat(0.5), L::splat(1.0));
        let (j, b) = (kinematics.volume_ratio, kinematics.left_cauchy_green);
        let inverse = one / j;
        let root = math::cbrt(j);
        let isochoric = one / (root * root); // J^{-2/3}
        let deviator = b.deviator().times(isochoric);
        let mean = b.trace() * isochoric * L::splat(1.0 / 3.0);
        let shear = L::splat(self.shear) * inverse;
        let pressure = L::splat(0.5 * self.bulk) * (j - inverse);
        let stress = deviator.times(shear).plus(T::isotropic(pressure));
        let square = deviator.contract(deviator);
        let above = (half * square * mean - deviator.determinant()) / (mean * mean + mean + one); // tr b̄ / 3 − 1
        let stored = L::splat(1.5 * self.shear) * above + L::splat(0.5 * self.bulk) * (half * (j - one) * (j + one) - math::ln(j));
        let spread = (square * L::splat(2.0 / 3.0)).sqrt();
        Response {
            stress,
            stored,
            dissipated: L::splat(0.0),
            bulk: L::splat(0.5 * self.bulk) * (j + inverse),
            shear: shear * (mean + spread),
        }
    }

    fn stiffness(&self) -> [f64; 2] {
        [self.bulk, self.shear]
    }
}
