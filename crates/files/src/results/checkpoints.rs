//! When states are kept, and what else makes a run known and continued: for `recorder`.
//!
//! By default the first state is kept after [`FIRST`], and the pause doubles from state to state up to
//! [`LONGEST`]; where a state is so large that this would cost more than a hundredth of the time, pauses are
//! longer.

use super::provenance::PartMade;
use crate::checkpoint::Origin;
use crate::model_file::Loaded;
use embate_solver::model::Model;
use embate_solver::simulation::PartMeshed;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// First pause by default.
const FIRST: Duration = Duration::from_secs(5);
/// Longest pause by default, if states are cheap.
const LONGEST: Duration = Duration::from_secs(120);
/// A pause by default is at least so many times as long as it took to keep the state before: 0.8 %.
const COST: u32 = 125;

/// When states are kept by the clock.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pause {
    /// As often as costs next to nothing.
    #[default]
    Doubling,
    /// So much wall time between two.
    Every(Duration),
    /// Not by the clock.
    Never,
}

impl Pause {
    /// As a model wants it: `run.checkpoint`, and by the number of steps alone where only that is there.
    #[must_use]
    pub fn of(model: &Model) -> Self {
        match (model.run.checkpoint, model.run.checkpoint_steps) {
            (None, None) => Self::Doubling,
            (None, Some(_)) => Self::Never,
            (Some(seconds), _) if seconds <= 0.0 => Self::Never,
            // What is too long for a clock never comes.
            (Some(seconds), _) => Duration::try_from_secs_f64(seconds).map_or(Self::Never, Self::Every),
        }
    }

    /// Wall time until the next state when so many have been kept, the last one at this cost; `None`: there
    /// is none.
    fn until_next(self, kept: u32, cost: Duration) -> Option<Duration> {
        match self {
            Self::Never => None,
            Self::Every(pause) => Some(pause),
            Self::Doubling => Some((FIRST * (1 << kept.min(8))).min(LONGEST).max(cost.saturating_mul(COST))),
        }
    }
}

/// When states are kept, and what is known of the run.
#[derive(Clone, Debug, Default)]
pub struct Checkpoints {
    /// By the clock; besides there are those that are due by their number of steps, and one when the run is
    /// stopped.
    pub pause: Pause,
    /// Where the model came from.
    pub origin: Origin,
    /// User CPU time of the process so far, s; `None`: the system does not report it.
    pub user_cpu_seconds: Option<fn() -> Option<f64>>,
    /// Keys of the model file with their values as they are written.
    pub(super) written: Vec<(String, String)>,
    /// What parts are made of.
    pub(super) parts: Vec<PartMade>,
}

impl Checkpoints {
    /// As a model wants them.
    #[must_use]
    pub fn of(model: &Model, origin: Origin) -> Self {
        Self { pause: Pause::of(model), origin, ..Self::default() }
    }

    /// With the clock of the process.
    #[must_use]
    pub fn with_cpu(self, user_cpu_seconds: fn() -> Option<f64>) -> Self {
        Self { user_cpu_seconds: Some(user_cpu_seconds), ..self }
    }

    /// With the model as it is written, and what its parts are made of: for reports.
    #[must_use]
    pub fn with_words(self, loaded: &Loaded, parts: Vec<PartMeshed>) -> Self {
        Self { written: loaded.written(), parts: parts.into_iter().map(PartMade::of).collect(), ..self }
    }
}

/// Nanoseconds that the writer needed for the last state; [`BUSY`] while it is at one.
#[derive(Clone, Debug, Default)]
pub(super) struct Cost(Arc<AtomicU64>);

/// A state that is not yet written.
const BUSY: u64 = u64::MAX;

impl Cost {
    pub(super) fn begin(&self) {
        self.0.store(BUSY, Ordering::Relaxed);
    }

    pub(super) fn end(&self, cost: Duration) {
        self.0.store(u64::try_from(cost.as_nanos()).unwrap_or(BUSY - 1).min(BUSY - 1), Ordering::Relaxed);
    }

    /// There will be none.
    pub(super) fn give_up(&self) {
        self.end(Duration::MAX);
    }

    /// `None`: it is at it.
    fn get(&self) -> Option<Duration> {
        Some(self.0.load(Ordering::Relaxed)).filter(|&nanoseconds| nanoseconds != BUSY).map(Duration::from_nanos)
    }
}

/// The clock by which states of a run are kept.
#[derive(Debug)]
pub(super) struct CheckpointClock {
    pause: Pause,
    /// Since when the next one is waited for.
    since: Instant,
    kept: u32,
    /// When the last one was asked for, and how long the run took to hand it over.
    asked: Option<Instant>,
    handed: Duration,
    written: Cost,
}

impl CheckpointClock {
    pub(super) fn new(pause: Pause, written: Cost) -> Self {
        Self { pause, since: Instant::now(), kept: 0, asked: None, handed: Duration::ZERO, written }
    }

    /// Whether a state is to be kept now.
    pub(super) fn is_due(&self) -> bool {
        let Some(cost) = self.written.get() else { return false };
        self.pause.until_next(self.kept, self.handed + cost).is_some_and(|pause| self.since.elapsed() >= pause)
    }

    /// Whether states are kept though no one has asked for them.
    pub(super) fn is_of_itself(&self) -> bool {
        self.pause == Pause::Doubling
    }

    /// A state is asked for.
    pub(super) fn ask(&mut self) {
        self.asked = Some(Instant::now());
    }

    /// It has come, and goes to the writer.
    pub(super) fn take(&mut self) {
        self.handed = self.asked.take().map_or(Duration::ZERO, |asked| asked.elapsed());
        self.kept = self.kept.saturating_add(1);
        self.written.begin();
    }

    /// It has been handed over.
    pub(super) fn restart(&mut self) {
        self.since = Instant::now();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pauses_double_up_to_two_minutes_and_grow_with_what_a_state_costs() {
        let pauses = |cost| [0, 1, 2, 3, 4, 5, 6, 4_000_000_000].map(|kept| Pause::Doubling.until_next(kept, cost).unwrap().as_secs());
        assert_eq!(pauses(Duration::from_millis(20)), [5, 10, 20, 40, 80, 120, 120, 120]);
        assert_eq!(pauses(Duration::from_secs(1)), [125; 8], "0.8 % at most");
        assert_eq!(Pause::Every(FIRST).until_next(9, LONGEST), Some(FIRST));
        assert_eq!(Pause::Never.until_next(0, Duration::ZERO), None);
    }

    #[test]
    fn the_model_says_when() {
        let of = |checkpoint, checkpoint_steps| {
            let mut model = Model::default();
            (model.run.checkpoint, model.run.checkpoint_steps) = (checkpoint, checkpoint_steps);
            Pause::of(&model)
        };
        assert_eq!([of(None, None), of(None, Some(7)), of(Some(0.0), None)], [Pause::Doubling, Pause::Never, Pause::Never]);
        assert_eq!(
            [of(Some(5.0), None), of(Some(5.0), Some(7)), of(Some(1e300), None)],
            [Pause::Every(FIRST), Pause::Every(FIRST), Pause::Never]
        );
    }

    #[test]
    fn none_is_due_while_one_is_being_written() {
        let cost = Cost::default();
        let mut clock = CheckpointClock::new(Pause::Every(Duration::ZERO), cost.clone());
        assert!(clock.is_due());
        clock.ask();
        clock.take();
        clock.restart();
        assert!(!clock.is_due());
        cost.end(Duration::from_secs(1));
        assert!(clock.is_due());
    }
}
