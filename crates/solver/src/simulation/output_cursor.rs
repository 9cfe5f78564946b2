//! Where a run stands beside its state: what was reported, and where its stretchs begin, so that one that
//! continues later reports the same and takes the same samples.

use super::run::PROGRESS;
use crate::archive::{Archive, ArchiveResult, Persist, persist_each};

/// Where a run stands.
#[derive(Clone, Copy)]
pub(super) struct OutputCursor {
    /// Time of the last row, s, and step of the last frame.
    pub(super) last_row: f64,
    pub(super) last_frame: Option<u64>,
    /// Step at which the last stretch ended: by an output time, or after so many steps.
    pub(super) stretch: u64,
    /// Step of the last state that was handed out, or taken over.
    pub(super) last_state: Option<u64>,
    /// Whether the run continues from a state that was kept.
    pub(super) is_resumed: bool,
}

impl OutputCursor {
    pub(super) fn new(step: u64) -> Self {
        Self { last_row: f64::NEG_INFINITY, last_frame: None, stretch: step, last_state: Some(step), is_resumed: false }
    }

    /// Whether a stretch ends here by its number of steps.
    pub(super) fn is_stretch(&self, step: u64) -> bool {
        step >= self.stretch.saturating_add(PROGRESS)
    }

    /// Steps until the stretch ends or a state is due.
    pub(super) fn steps(&self, step: u64, state_steps: Option<u64>) -> u64 {
        let stretch = self.stretch.saturating_add(PROGRESS).saturating_sub(step);
        state_steps.map_or(stretch, |every| stretch.min(every - step % every))
    }

    /// Whether the state of this step is due.
    pub(super) fn is_state_due(&self, step: u64, state_steps: Option<u64>) -> bool {
        self.last_state != Some(step) && state_steps.is_some_and(|every| step.is_multiple_of(every))
    }
}

impl Persist for OutputCursor {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { last_row, last_frame, stretch, last_state, is_resumed } = self;
        persist_each!(archive; last_row, last_frame, stretch, last_state);
        *is_resumed |= archive.reads();
        Ok(())
    }
}
