//! When something acts that acts in some stages of the run alone: times that become known during the run.

use super::Model;

/// The times between which it acts, s: both infinite until it begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// First and last of its stages.
    stages: [usize; 2],
    /// When it begins, and when it is over, s.
    pub times: [f64; 2],
}

impl Window {
    /// In these stages of a model; `None`: always, as it names none.
    #[must_use]
    pub fn of(model: &Model, stages: &[String]) -> Option<Self> {
        let stages = model.stages_of(stages)?;
        let begin = if stages[0] == 0 { 0.0 } else { f64::INFINITY };
        Some(Self { stages, times: [begin, f64::INFINITY] })
    }

    /// Whether it acts in a stage.
    #[must_use]
    pub fn has(&self, stage: usize) -> bool {
        (self.stages[0]..=self.stages[1]).contains(&stage)
    }

    /// Notes that a stage begins at `now`, s.
    pub fn enter(&mut self, stage: usize, now: f64) {
        if stage == self.stages[0] {
            self.times[0] = now;
        }
        if stage == self.stages[1] + 1 {
            self.times[1] = now;
        }
    }
}
