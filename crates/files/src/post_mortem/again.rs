//! The second pass of a run that has failed: from a state that is near to the failure once more, step by
//! step, with the same bits.
//!
//! Where the state comes from: the nearest checkpoint on the disk, or the states that the run kept in memory,
//! or time zero where the run was short. It serves twice: what was seen goes to the page, and the state of
//! the last good step to the checkpoints of runs that have some.

use super::Failed;
use crate::checkpoint::{generations, newest};
use crate::threads::Threads;
use embate_solver::error::Error;
use embate_solver::output::Frame;
use embate_solver::post_mortem::{FailureEntity, Trace};
use embate_solver::simulation::{Control, Observer, ObserverError, Progress, Simulation, State};
use std::sync::Arc;

/// Steps before the failure that are shown.
const WINDOW: u64 = 256;
/// Steps after the worst one for the energies that are shown.
const AFTER: u64 = 64;
/// A run of so few elements times steps is short: it can go again from time zero.
const SHORT: u64 = 1_000_000_000;

/// What was found.
#[derive(Clone, Debug, Default)]
pub struct Findings {
    /// Where it failed.
    pub failure_entity: FailureEntity,
    /// What was seen of him.
    pub trace: Trace,
    /// How that was had, or why there is only the state of the failure: a sentence.
    pub how: String,
    /// State of the last good step, for who keeps it.
    pub last_good: Option<State>,
    /// Why that state is wanted and not there.
    pub fault: Option<String>,
}

/// Where the second pass begins.
enum From {
    Start,
    State(Arc<State>, &'static str),
}

impl From {
    fn step(&self) -> u64 {
        match self {
            Self::Start => 0,
            Self::State(state, _) => state.step,
        }
    }

    fn name(&self) -> String {
        match self {
            Self::Start => "the start".into(),
            Self::State(state, from) => format!("step {} ({from})", state.step),
        }
    }
}

/// One way to the failure.
struct Pass {
    trace: Trace,
    state: Option<State>,
    error: Option<Error>,
}

impl Failed<'_> {
    /// Goes to the failure once more, where that can be done in sensible time, and looks at the failure
    /// location. `continues` is asked now and then, and may say no.
    #[must_use]
    pub fn findings(&self, mut continues: impl FnMut() -> bool) -> Findings {
        let failure_entity = self.simulation.failure_entity(self.error);
        let mut findings =
            Findings { failure_entity, trace: self.simulation.trace_now(&failure_entity, Some(self.error)), ..Findings::default() };
        if self.is_steered {
            findings.how = "Only the state of the failure is shown: the program that drove the run has changed it on the way \
                            (velocities, forces or curves), so it can't go there once more by itself."
                .into();
            return findings;
        }
        let step = self.simulation.steps();
        let Some(from) = self.beginning(step) else {
            findings.how = "Only the state of the failure is shown: no state of the run is near enough to go there once more. \
                `run.checkpoint` sets how often states are kept."
                .into();
            return findings;
        };
        let last_good = (self.keeps_last_good && step > 1).then(|| step - 1);
        match self.pass(&from, &failure_entity, [step.saturating_sub(WINDOW), step], last_good, &mut continues) {
            Ok(pass) => {
                let is_same = pass.error.as_ref().is_some_and(|error| error.kind() == self.error.kind());
                findings.fault = (last_good.is_some() && pass.state.is_none() && continues())
                    .then(|| "the run fails again before its last good step".into());
                findings.last_good = pass.state;
                if is_same {
                    findings.how = format!(
                        "To see these steps the run went once more from {} to its failure: the same steps with the same bits.",
                        from.name()
                    );
                    findings.trace = pass.trace;
                    if !matches!(self.error, Error::EnergyDrift { .. }) {
                        findings.trace.jump = None;
                    }
                    self.blame_energies(&from, &mut findings, &mut continues);
                } else if continues() {
                    findings.how = format!(
                        "Only the state of the failure is shown: the run went once more from {}, and did not fail in this way.",
                        from.name()
                    );
                } else {
                    findings.how = "Only the state of the failure is shown: going to it once more was stopped.".into();
                }
            }
            Err(error) => {
                findings.fault = last_good.is_some().then(|| format!("the state of the last good step could not be kept: {error}"));
                findings.how =
                    format!("Only the state of the failure is shown: the run could not go once more from {}: {error}.", from.name());
            }
        }
        findings
    }

    /// Where energies went wrong no one is the cause until the worst step is known; then the run goes there a
    /// third time.
    fn blame_energies(&self, from: &From, findings: &mut Findings, continues: &mut impl FnMut() -> bool) {
        let Some(jump) = findings.trace.jump.filter(|_| findings.failure_entity.is_nobody()) else { return };
        let step = self.simulation.steps();
        let window = [jump.step.saturating_sub(WINDOW - AFTER), step.min(jump.step + AFTER)];
        if let Ok(pass) = self.pass(from, &jump.failure_entity, window, None, continues)
            && pass.trace.moments.last().is_some_and(|last| last.step == window[1])
        {
            findings.failure_entity = jump.failure_entity;
            findings.trace = Trace { jump: Some(jump), begin: findings.trace.begin, ..pass.trace };
        }
    }

    fn beginning(&self, step: u64) -> Option<From> {
        let early = step.saturating_sub(WINDOW);
        let threads = Threads::new(self.options.thread_count());
        let in_memory = self.simulation.states();
        let on_disk: Vec<u64> = generations(self.checkpoints).iter().map(|generation| generation.step).collect();
        let newest_before = |limit: u64| {
            let memory = in_memory.iter().find(|state| state.step <= limit);
            let disk = on_disk.iter().copied().find(|&own| own <= limit);
            if disk.is_some_and(|disk| memory.is_none_or(|memory| disk > memory.step))
                && let Ok((checkpoint, _)) = newest(self.checkpoints, &threads, |generation| generation.step <= limit)
            {
                return Some(From::State(checkpoint.state, "a checkpoint"));
            }
            memory.map(|state| From::State(Arc::new(state.clone()), "kept in memory"))
        };
        // From its start a run comes here only if nothing but its model led it.
        let has_start = !self.simulation.summary().remeshings.iter().any(|event| event.reason == "mesh");
        let is_short = self.simulation.elements() as u64 * step <= SHORT && has_start;
        newest_before(early)
            .or_else(|| is_short.then_some(From::Start))
            .or_else(|| newest_before(step.saturating_sub(1)))
            .or_else(|| (self.keeps_last_good && has_start).then_some(From::Start))
    }

    fn pass(
        &self,
        from: &From,
        failure_entity: &FailureEntity,
        [first, last]: [u64; 2],
        keep: Option<u64>,
        continues: &mut impl FnMut() -> bool,
    ) -> Result<Pass, Error> {
        // The state is due at this step alone, so the run's own stages stay what they were.
        let mut model = self.model.clone();
        (model.run.checkpoint_steps, model.run.max_steps) = (keep, Some(last));
        let mut simulation = match from {
            From::State(state, _) => Simulation::resumed(&model, self.options, &state.sections)?,
            From::Start => Simulation::new(&model, self.options)?,
        };
        simulation.follow(failure_entity, self.simulation, first.max(from.step()));
        let mut waiting = Waiting { wanted: keep, state: None, continues };
        let error = simulation.run(&mut waiting).err();
        Ok(Pass { state: waiting.state, trace: simulation.take_trace().unwrap_or_default(), error })
    }
}

/// Waits for a state; all else is known.
struct Waiting<'a, F> {
    wanted: Option<u64>,
    state: Option<State>,
    continues: &'a mut F,
}

impl<F: FnMut() -> bool> Observer for Waiting<'_, F> {
    fn frame(&mut self, _: Frame) -> Result<(), ObserverError> {
        Ok(())
    }
    fn row(&mut self, _: &[f64]) -> Result<(), ObserverError> {
        Ok(())
    }
    fn keeps_states(&self) -> bool {
        self.wanted.is_some()
    }
    fn state(&mut self, state: State) -> Result<(), ObserverError> {
        if Some(state.step) == self.wanted {
            self.state = Some(state);
        }
        Ok(())
    }
    fn progress(&mut self, _: &Progress<'_>) -> Control {
        if (self.continues)() { Control::Continue } else { Control::Stop }
    }
}
