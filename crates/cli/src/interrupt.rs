//! Ctrl-C, SIGTERM and hangups: the first one asks a run to stop after its step, the second one ends the
//! program.

use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

/// What comes sooner after the first one belongs to it: `timeout`, for example, sends a signal to the program
/// and to the group that it is in.
const APART: Duration = Duration::from_millis(500);

/// Lets hangups be ignored that anyone who started the program wants ignored (`nohup`): watching would take
/// them for a request to stop. Before any thread begins.
pub(crate) fn respect_nohup() {
    #[cfg(target_os = "linux")]
    {
        use nix::sys::signal::{SigSet, Signal};
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let ignored =
            status.lines().find_map(|line| line.strip_prefix("SigIgn:")).and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
        if ignored.is_some_and(|mask| mask & (1 << (Signal::SIGHUP as u32 - 1)) != 0) {
            let mut hangups = SigSet::empty();
            hangups.add(Signal::SIGHUP);
            // Without it a hangup stops the run, with its state kept.
            let _ = hangups.thread_block();
        }
    }
}

/// When the user pressed Ctrl-C first since [`Interrupt::watch`], if at all.
#[derive(Clone)]
pub(crate) struct Interrupt(Arc<OnceLock<Instant>>);

impl Interrupt {
    /// Begins to watch. Where the system does not allow it, Ctrl-C ends the program at once, as without this.
    pub(crate) fn watch() -> Self {
        let pressed = Arc::new(OnceLock::new());
        let first = Arc::clone(&pressed);
        // Results stay complete under their final names even then: unfinished files end in `.part`.
        let _ = ctrlc::set_handler(move || {
            if first.get_or_init(Instant::now).elapsed() >= APART {
                std::process::exit(130);
            }
        });
        Self(pressed)
    }

    /// Whether it was pressed.
    pub(crate) fn is_pressed(&self) -> bool {
        self.0.get().is_some()
    }
}
