//! How a run continues: a bar on a terminal, a line every tenth otherwise, nothing when quiet. All on
//! standard error.

use crate::numbers::{grouped, per_cent, with_unit};
use crate::terminal;
use embate_solver::simulation::Progress;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::time::{Duration, Instant};

/// Ticks of the bar.
const TICKS: u64 = 1000;
/// Time between two updates of the bar.
const PAUSE: Duration = Duration::from_millis(100);

/// Shows progress.
pub(crate) enum Display {
    /// Nothing.
    Quiet,
    /// A line for each tenth of the run; `next` is the next tenth, `from` what was done when it began: more
    /// than nothing of a run that continues.
    Lines { next: u64, begin: Instant, from: Option<f64> },
    /// A bar.
    Bar { bar: ProgressBar, updated: Instant },
}

impl Display {
    pub(crate) fn new(is_quiet: bool) -> Self {
        if is_quiet {
            return Self::Quiet;
        }
        if !std::io::stderr().is_terminal() {
            return Self::Lines { next: 1, begin: Instant::now(), from: None };
        }
        let bar = ProgressBar::with_draw_target(Some(TICKS), ProgressDrawTarget::stderr());
        if let Ok(style) = ProgressStyle::with_template("{bar:24} {percent:>3} %  ETA {eta}  {wide_msg}") {
            bar.set_style(style);
        }
        Self::Bar { bar, updated: Instant::now() }
    }

    /// A bar on a terminal, else nothing: for many short runs.
    pub(crate) fn on_terminal(is_quiet: bool) -> Self {
        Self::new(is_quiet || !std::io::stderr().is_terminal())
    }

    pub(crate) fn update(&mut self, progress: &Progress<'_>) {
        let done = if progress.end > 0.0 { (progress.time / progress.end).clamp(0.0, 1.0) } else { 0.0 };
        self.show(done, || state(progress));
    }

    /// Shows that this fraction is done.
    pub(crate) fn show(&mut self, done: f64, state: impl FnOnce() -> String) {
        match self {
            Self::Quiet => {}
            Self::Lines { next, begin, from } => {
                let tenth = (10.0 * done).floor() as u64;
                let from = *from.get_or_insert_with(|| {
                    *next = tenth + 1;
                    done
                });
                if tenth >= *next {
                    let left = begin.elapsed().as_secs_f64() * (1.0 - done) / (done - from);
                    terminal::report_error(&format!("{:>3} %  {}  ETA {}", 10 * tenth, state(), with_unit(left, "s")));
                    *next = tenth + 1;
                }
            }
            Self::Bar { bar, updated } => {
                if updated.elapsed() >= PAUSE {
                    bar.set_position((TICKS as f64 * done) as u64);
                    bar.set_message(state());
                    *updated = Instant::now();
                }
            }
        }
    }

    /// Says something while the run continues.
    pub(crate) fn say(&self, text: &str) {
        match self {
            Self::Quiet => {}
            Self::Lines { .. } => terminal::report_error(text),
            Self::Bar { bar, .. } => bar.suspend(|| terminal::report_error(text)),
        }
    }

    /// Takes the bar away.
    pub(crate) fn close(self) {
        if let Self::Bar { bar, .. } = self {
            bar.finish_and_clear();
        }
    }
}

fn state(progress: &Progress<'_>) -> String {
    format!(
        "step {}  t {}  dt {}  drift {}  {}",
        grouped(progress.step),
        with_unit(progress.time, "s"),
        with_unit(progress.time_step, "s"),
        per_cent(progress.energy_drift),
        progress.governor
    )
}
