//! When something acts: between given times, or in some stages of the run, whose times become known during
//! it.

use super::Model;

/// The times between which something acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// First and last of its stages; `None`: its times are given.
    stages: Option<[usize; 2]>,
    /// When it begins, and when it is over, s: of stages both infinite until then.
    times: [f64; 2],
}

impl Window {
    /// Between these times, s.
    #[must_use]
    pub fn between(times: [f64; 2]) -> Self {
        Self { stages: None, times }
    }

    /// In these stages of a model; between the times `active` (s) where none is named.
    #[must_use]
    pub fn of(model: &Model, stages: &[String], active: [f64; 2]) -> Self {
        let Some(stages) = model.stages_of(stages) else { return Self::between(active) };
        let begin = if stages[0] == 0 { 0.0 } else { f64::INFINITY };
        Self { stages: Some(stages), times: [begin, f64::INFINITY] }
    }

    /// When it begins, and when it is over, as far as that is known, s.
    #[must_use]
    pub fn times(&self) -> [f64; 2] {
        self.times
    }

    /// Whether it is one of stages.
    #[must_use]
    pub fn is_of_stages(&self) -> bool {
        self.stages.is_some()
    }

    /// Whether it is open at all times.
    #[must_use]
    pub fn is_always(&self) -> bool {
        self.stages.is_none() && self.times[0] <= 0.0 && self.times[1] == f64::INFINITY
    }

    /// Whether it is open at a time, s.
    #[must_use]
    pub fn contains(&self, time: f64) -> bool {
        (self.times[0]..self.times[1]).contains(&time)
    }

    /// Notes that a stage begins at `now`, s; whether it is over by that.
    pub fn enter(&mut self, stage: usize, now: f64) -> bool {
        let Some([first, last]) = self.stages else { return false };
        if stage == first {
            self.times[0] = now;
        }
        let is_over = stage == last + 1;
        if is_over {
            self.times[1] = now;
        }
        is_over
    }
}
