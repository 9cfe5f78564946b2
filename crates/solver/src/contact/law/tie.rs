//! Tie: a spring that pulls as well as it pushes, F = −k g, or with a multiplier the force that brings the
//! gap to zero at the end of the step.
//!
//! No law that a contact names: tied contacts use it, with the stiffness of their penalty, and welds and
//! joints with a multiplier.

use super::Law;
use crate::contact::springs::{Closing, Patch};

/// The law.
#[derive(Clone, Copy, Debug)]
pub struct Tie {
    /// Whether the gap is a constraint instead of a spring's length.
    pub rigid: bool,
    /// Whether the ends at one rigid body, or at the middle of one shell, are one arm: welds and joints have
    /// many there, and the spring has to know at once what it does to itself.
    pub joins_ends: bool,
}

impl Law for Tie {
    fn force(&self, closing: &Closing<'_>, _: [f64; 2]) -> f64 {
        let Closing { spring, old, free, compliance } = *closing;
        if !self.rigid {
            return -spring.stiffness * (free + old) / (2.0 + spring.stiffness * compliance);
        }
        if compliance > 0.0 { -(2.0 * free - spring.gap) / (2.0 * compliance) } else { 0.0 }
    }
    fn stored(&self, spring: &Patch, gap: f64) -> f64 {
        if self.rigid { 0.0 } else { 0.5 * spring.stiffness * gap * gap }
    }
    fn linear(&self, _: &Patch) -> Option<[f64; 2]> {
        (!self.rigid).then_some([f64::NEG_INFINITY, f64::INFINITY])
    }
    fn stiffness(&self, spring: &Patch, _: f64) -> f64 {
        self.slip_stiffness(spring)
    }
    fn mean_force(&self, spring: &Patch, old: f64, new: f64) -> f64 {
        if self.rigid { 0.0 } else { -0.5 * spring.stiffness * (old + new) }
    }
    fn slip_stiffness(&self, spring: &Patch) -> f64 {
        if self.rigid { f64::INFINITY } else { spring.stiffness }
    }
    fn is_elastic(&self) -> bool {
        !self.rigid
    }
    fn joins_ends(&self) -> bool {
        self.joins_ends
    }
}
