//! How far the results of a run are: what a checkpoint has of them, so that a run that continues leaves the
//! same files as one that was never stopped.
//!
//! Made by the writer when a state is kept; read when a run continues. The film's frames are beside it, as
//! sections of the checkpoint.

use super::atomic::Mark;
use crate::outline::Extent;
use serde::{Deserialize, Serialize};

/// What a run has reported until a step.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Reported {
    /// How far `history.csv` is.
    pub(super) history: Mark,
    /// How far `hashes.csv` is, if there is one.
    pub(super) hashes: Option<Mark>,
    /// Times of the frames, s.
    pub(super) frames: Vec<f64>,
    /// Step of the last one.
    pub(super) frame_step: Option<u64>,
    /// Whether each frame has a file of obstacles.
    pub(super) has_obstacles: bool,
    /// Box of all nodes of all frames so far, and from where on a line counts as endless, m.
    pub(super) extent: Option<Extent<3>>,
    pub(super) far: Option<f64>,
    /// What it had cost until then.
    #[serde(default)]
    pub spent: Spent,
}

/// What a run has cost until a step, over all its stretches: what a program that was killed did after its
/// last checkpoint is done again and counts once.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Spent {
    /// Wall time, s.
    pub wall: f64,
    /// User CPU time of the process, s; `None` where the system does not report it.
    pub user_cpu: Option<f64>,
    /// Time that the writer was at work, s.
    pub output: f64,
    /// Wall time for which the run waited for its output, s.
    pub waited: f64,
}

impl Spent {
    /// Together with what is spent now; `before` is none for a run from its beginning.
    pub(super) fn after(self, before: Option<Self>) -> Self {
        let Some(before) = before else { return self };
        Self {
            wall: before.wall + self.wall,
            user_cpu: before.user_cpu.zip(self.user_cpu).map(|(before, now)| before + now),
            output: before.output + self.output,
            waited: before.waited + self.waited,
        }
    }
}
