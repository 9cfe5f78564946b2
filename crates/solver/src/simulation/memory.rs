//! States that a run keeps in memory while it continues, so that a failure can be gone to once more from one
//! that is near.
//!
//! Two generations, and only while they are small: taking a state costs about as much as a fifth of a hundred
//! steps, whatever the size of the model, and is done every [`EVERY`] steps.

use super::State;

/// Steps between two states.
const EVERY: u64 = 2048;
/// Generations.
const GENERATIONS: usize = 2;

/// The states, and how much room there is for them.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Memory {
    /// Bytes for all generations together; zero: none are kept.
    room: usize,
    /// Step from which on the next one is due.
    next: Option<u64>,
    states: Vec<State>,
}

impl Memory {
    pub(super) fn of(room: usize) -> Self {
        Self { room, ..Self::default() }
    }

    /// Whether a state is to be taken at a step. A run that begins at time zero needs none there.
    pub(super) fn is_due(&mut self, step: u64) -> bool {
        if self.room == 0 {
            return false;
        }
        step >= *self.next.get_or_insert(if step == 0 { EVERY } else { step })
    }

    /// Takes a state; one that is too large is the last.
    pub(super) fn take(&mut self, state: State) {
        let bytes: usize = state.sections.iter().map(|section| section.bytes.len()).sum();
        if bytes > self.room / GENERATIONS {
            *self = Self::default();
            return;
        }
        self.next = Some(state.step + EVERY);
        self.states.truncate(GENERATIONS - 1);
        self.states.insert(0, state);
    }

    /// The newest first.
    pub(super) fn states(&self) -> &[State] {
        &self.states
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::archive::Section;

    fn state(step: u64, bytes: usize) -> State {
        State { step, time: 0.0, sections: vec![Section { name: "s".into(), bytes: vec![0; bytes] }] }
    }

    #[test]
    fn two_generations_are_kept_and_none_that_is_too_large() {
        let mut memory = Memory::of(100);
        assert!(!memory.is_due(0) && !memory.is_due(EVERY - 1) && memory.is_due(EVERY));
        for k in 1..4 {
            memory.take(state(k * EVERY, 50));
            assert!(!memory.is_due(k * EVERY + 1));
        }
        assert_eq!(memory.states().iter().map(|state| state.step).collect::<Vec<_>>(), [3 * EVERY, 2 * EVERY]);
        memory.take(state(4 * EVERY, 51));
        assert!(memory.states().is_empty() && !memory.is_due(u64::MAX));
        // One that continues later has not been at time zero.
        assert!(Memory::of(1).is_due(777) && !Memory::default().is_due(EVERY));
    }
}
