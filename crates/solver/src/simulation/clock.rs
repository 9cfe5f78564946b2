//! When rows and frames are due. Cadences come from the model; [`super::Simulation::run`] asks.

use crate::model::Cadence;

/// Output times k × interval.
pub(super) struct Clock {
    interval: f64,
    next: u64,
}

impl Clock {
    pub(super) fn new(cadence: Cadence, end: f64) -> Self {
        let interval = match cadence {
            Cadence::Count(count) => end / count.max(1) as f64,
            Cadence::Interval(interval) => interval,
        };
        Self { interval, next: 0 }
    }

    pub(super) fn next(&self) -> f64 {
        self.next as f64 * self.interval
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
        self.next = ((time * (1.0 + 1e-12)) / self.interval).floor() as u64 + 1;
    }
}
