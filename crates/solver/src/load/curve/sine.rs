//! `sine`: offset + amplitude · sin(2π frequency · t + phase), with the project's own sine.

use crate::angle::cos_sin;
use crate::model::Sine;
use std::f64::consts::TAU;

impl Sine {
    /// Value at `time`, s.
    #[must_use]
    pub fn value(&self, time: f64) -> f64 {
        self.offset + self.amplitude * cos_sin(TAU * self.frequency * time + self.phase)[1]
    }

    /// Mean value between two times: that in the middle, its wave times sin(x)/x with x half the angle
    /// between them.
    #[must_use]
    pub fn mean(&self, from: f64, to: f64) -> f64 {
        let half = 0.5 * TAU * self.frequency * (to - from);
        let share = if half.abs() < 1e-8 { 1.0 } else { cos_sin(half)[1] / half };
        self.offset + share * (self.value(0.5 * (from + to)) - self.offset)
    }
}
