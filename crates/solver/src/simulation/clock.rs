//! When rows and frames are due. Cadences come from the model; [`super::Simulation::run`] asks.

use crate::model::Cadence;

/// Output times begin + k × interval.
pub(super) struct Clock {
    begin: f64,
    interval: f64,
    next: u64,
}

impl Clock {
    /// Of what begins and ends at these times, s; intervals that are given count from zero.
    pub(super) fn new(cadence: Cadence, [begin, end]: [f64; 2]) -> Self {
        let begin = if matches!(cadence, Cadence::Count(_)) { begin } else { 0.0 };
        Self { begin, interval: cadence.interval(end - begin), next: 0 }
    }

    pub(super) fn next(&self) -> f64 {
        self.begin + self.next as f64 * self.interval
    }

    /// Whether an output time has been reached; moves on to the one after `time`.
    pub(super) fn due(&mut self, time: f64) -> bool {
        // A time that is met but for round-off counts.
        let due = time >= self.next() * (1.0 - 1e-12);
        if due {
            self.pass(time);
        }
        due
    }

    /// Moves on to the output time after `time`.
    pub(super) fn pass(&mut self, time: f64) {
        self.next = ((time * (1.0 + 1e-12) - self.begin) / self.interval).floor() as u64 + 1;
    }
}
