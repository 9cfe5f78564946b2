//! The shortest time step of a run, for the summary; it is updated after every step.

use crate::archive::persist_all;
use crate::dimension::Dimension;
use crate::step::{Governor, System};
use crate::tensor::Dim;

/// The shortest step so far and who governed it.
pub(crate) struct Shortest {
    pub(crate) time_step: f64,
    pub(crate) governor: String,
}

persist_all!(Shortest { time_step, governor });

impl Default for Shortest {
    fn default() -> Self {
        Self { time_step: f64::INFINITY, governor: String::new() }
    }
}

impl Shortest {
    /// Takes the step of `system`. Who governs is found by a search: only when the step falls noticeably, and
    /// by more than the schedule.
    pub(crate) fn note<const D: usize>(&mut self, system: &System<D>)
    where
        Dim<D>: Dimension<D>,
    {
        let governed = system.governor != Governor::Schedule || self.time_step.is_infinite();
        if governed && system.time_step < 0.999 * self.time_step {
            self.time_step = system.time_step;
            self.governor = system.governor_in_words();
        }
    }
}
