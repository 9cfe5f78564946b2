//! Lock: the force that brings a gap to zero at the end of the step, as the multiplier of a tie does.
//!
//! No law that a contact names: welds and joints use it. Their springs have many ends at one rigid body, or
//! at the middle of one shell: those are one arm, so that the spring knows at once what it does to itself.

use super::Law;
use super::tie::Tie;
use crate::contact::springs::{Closing, Patch};

const TIE: Tie = Tie { rigid: true };

/// The law.
#[derive(Clone, Copy, Debug)]
pub struct Lock;

impl Law for Lock {
    fn force(&self, closing: &Closing<'_>, time_steps: [f64; 2]) -> f64 {
        TIE.force(closing, time_steps)
    }
    fn stored(&self, spring: &Patch, gap: f64) -> f64 {
        TIE.stored(spring, gap)
    }
    fn stiffness(&self, spring: &Patch, gap: f64) -> f64 {
        TIE.stiffness(spring, gap)
    }
    fn mean_force(&self, spring: &Patch, old: f64, new: f64) -> f64 {
        TIE.mean_force(spring, old, new)
    }
    fn slip_stiffness(&self, spring: &Patch) -> f64 {
        TIE.slip_stiffness(spring)
    }
    fn is_elastic(&self) -> bool {
        false
    }
    fn joins_ends(&self) -> bool {
        true
    }
}
