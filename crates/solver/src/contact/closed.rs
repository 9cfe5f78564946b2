//! Energy of the springs of a contact, to know what those had that are not found again because their node or
//! segment has left the surface.

use crate::archive::persist_all;

/// How many springs are closed, and their energy, J/m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Closed {
    count: u32,
    energy: f64,
}

persist_all!(Closed { count, energy });

impl Closed {
    /// Adds a spring.
    pub(super) fn add(&mut self, stored: f64) {
        if stored > 0.0 {
            self.count += 1;
            self.energy += stored;
        }
    }

    /// What is missing in `now`, J/m: where nothing is, sums that were added up in another order differ by
    /// round-off.
    pub(super) fn less(&self, now: &Self) -> f64 {
        if self.count > now.count { (self.energy - now.energy).max(0.0) } else { 0.0 }
    }
}
