//! Multiplier: whatever force it takes that there is no penetration at the end of the step, g^{n+1} = g^n +
//! dt^n ġ^{n+½} ≥ 0, F ≥ 0, F g^{n+1} = 0.
//!
//! Forward increment Lagrange multipliers: the constraint is that of the step's end, so no system is solved
//! but that of the springs, and the stable step stays. The gap is held to round-off where surfaces stay
//! together. Impacts lose the kinetic energy of the nodes that are stopped (which vanishes with the size of
//! the elements); it is entered as lost by damping.

use super::{ContactLawKind, Law};
use crate::contact::springs::{Closing, Patch};

/// Registry entry.
pub const KIND: ContactLawKind = ContactLawKind {
    name: "multiplier",
    doc: "the force that leaves no penetration at the end of each step, without a smaller step; impacts lose the \
        energy of the nodes they stop",
    source: "Carpenter, Taylor and Katona, Int. J. Numer. Meth. Engng 32 (1991) 103-128",
    parameters: &[],
};

/// The law; it has no parameters.
#[derive(Clone, Copy, Debug)]
pub struct Multiplier;

impl Law for Multiplier {
    fn force(&self, closing: &Closing<'_>, _: [f64; 2]) -> f64 {
        // g^{n+1} = 2 g^{n+½} − g^n
        let end = 2.0 * closing.free - closing.spring.gap;
        if closing.compliance > 0.0 { (-end / (2.0 * closing.compliance)).max(0.0) } else { 0.0 }
    }
    fn stored(&self, _: &Patch, _: f64) -> f64 {
        0.0
    }
    fn stiffness(&self, _: &Patch, _: f64) -> f64 {
        f64::INFINITY
    }
    fn mean_force(&self, _: &Patch, _: f64, _: f64) -> f64 {
        0.0
    }
    fn slip_stiffness(&self, _: &Patch) -> f64 {
        f64::INFINITY
    }
    fn is_elastic(&self) -> bool {
        false
    }
}
