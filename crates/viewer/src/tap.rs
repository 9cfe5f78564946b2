//! Between a simulation and its recorder: takes rows and, now and then, a frame for the viewers, and lets
//! them pause the run.
//!
//! Everything continues to the recorder unchanged. A frame is taken only while somebody looks, at most every
//! [`LEAST`], and so seldom that taking frames takes no more than a small part of the time.

use crate::live::{Live, Order};
use embate_solver::hashes::Hashes;
use embate_solver::output::{Cells, Frame, Shown};
use embate_solver::simulation::{Control, Observer, ObserverError, Progress, State};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Time between two frames at least.
const LEAST: Duration = Duration::from_millis(66);
/// A frame may cost one part of so many of the time.
const PART: u32 = 30;
/// The run is to come back after so much time, that it can be paused and stopped.
const ANSWER: Duration = Duration::from_millis(40);

/// An observer that a run is watched through.
pub struct Tap<'a> {
    recorder: &'a mut dyn Observer,
    live: Arc<Live>,
    is_interrupted: Box<dyn Fn() -> bool + 'a>,
    /// When the next frame may be taken.
    next: Instant,
    /// When it was asked the last time, at which step; the steps until it wants to be asked again.
    asked: (Instant, u64),
    stride: u64,
    is_failing: bool,
    /// Whether a viewer has asked for the state that comes.
    is_kept: bool,
}

impl<'a> Tap<'a> {
    /// Between a run and `recorder`; a pause ends when `is_interrupted`.
    pub fn new(recorder: &'a mut dyn Observer, live: Arc<Live>, is_interrupted: impl Fn() -> bool + 'a) -> Self {
        let now = Instant::now();
        Self {
            recorder,
            live,
            is_interrupted: Box::new(is_interrupted),
            next: now,
            asked: (now, 0),
            stride: 1,
            is_failing: false,
            is_kept: false,
        }
    }

    fn publish(&mut self, shown: &dyn Shown) {
        let begin = Instant::now();
        self.live.publish(shown);
        self.next = Instant::now() + LEAST.max(begin.elapsed() * PART);
    }

    /// What is shown at an output time goes to the viewers too: the last of a run always.
    fn pass(&mut self, shown: &dyn Shown) {
        let is_last = || {
            let shared = self.live.shared();
            shared.order == Order::Stopping || shown.time() >= shared.reported.end * (1.0 - 1e-9)
        };
        if self.live.is_watched() && (self.is_failing || self.next <= Instant::now() || is_last()) {
            self.publish(shown);
        }
    }
}

impl Observer for Tap<'_> {
    fn spare(&mut self) -> Frame {
        self.recorder.spare()
    }

    fn frame(&mut self, frame: Frame) -> Result<(), ObserverError> {
        self.pass(&frame);
        self.recorder.frame(frame)
    }

    fn show(&mut self, shown: &dyn Shown) -> Result<(), ObserverError> {
        self.pass(shown);
        self.recorder.show(shown)
    }

    fn cells(&mut self, cells: Cells) -> Result<(), ObserverError> {
        self.live.set_cells(cells.clone());
        self.recorder.cells(cells)
    }

    fn row(&mut self, row: &[f64]) -> Result<(), ObserverError> {
        self.live.row(row);
        self.recorder.row(row)
    }

    fn keeps_states(&self) -> bool {
        self.recorder.keeps_states()
    }

    fn state(&mut self, state: State) -> Result<(), ObserverError> {
        let step = state.step;
        self.recorder.state(state)?;
        if std::mem::take(&mut self.is_kept) {
            self.live.kept(format!("the state of step {step} is kept: `embate resume` continues from it"));
        }
        Ok(())
    }

    fn keeps_hashes(&self) -> bool {
        self.recorder.keeps_hashes()
    }

    fn hashes(&mut self, hashes: Hashes) -> Result<(), ObserverError> {
        self.recorder.hashes(hashes)
    }

    fn failing(&mut self) {
        self.is_failing = true;
        self.recorder.failing();
    }

    fn wants_glance(&mut self) -> bool {
        let is_paused = self.live.shared().order == Order::Paused;
        is_paused || (self.live.is_watched() && (self.next <= Instant::now() || self.live.lacks()))
    }

    fn glance(&mut self, shown: &dyn Shown) {
        self.publish(shown);
        while self.live.shared().order == Order::Paused && !(self.is_interrupted)() {
            if self.live.lacks() {
                self.publish(shown);
            }
            if self.live.shared().keep {
                // The run continues to keep its state, and comes back.
                break;
            }
            self.live.wait();
        }
        self.asked.0 = Instant::now();
    }

    fn stride(&self) -> u64 {
        self.stride
    }

    fn progress(&mut self, progress: &Progress<'_>) -> Control {
        let (now, (then, step)) = (Instant::now(), self.asked);
        let (passed, steps) = ((now - then).as_secs_f64(), progress.step.saturating_sub(step));
        if steps > 0 {
            let wanted = ANSWER.as_secs_f64() * steps as f64 / passed.max(1e-9);
            self.stride = (wanted as u64).clamp(1, 1 << 20);
        }
        if self.live.shared().order == Order::Paused {
            self.stride = 1;
        }
        self.asked = (now, progress.step);
        self.live.progress(progress);
        match self.recorder.progress(progress) {
            Control::Continue if self.live.takes_keep() => {
                self.is_kept = true;
                Control::Keep
            }
            Control::Continue if self.live.is_stopped() => {
                if self.recorder.keeps_states() {
                    Control::KeepAndStop
                } else {
                    Control::Stop
                }
            }
            control => control,
        }
    }
}
