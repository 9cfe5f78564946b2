//! Ctrl-C, SIGTERM and hangups: the first one asks a run to stop after its step, the second one ends the
//! program.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

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

/// Whether the user has pressed Ctrl-C since [`Interrupt::watch`].
#[derive(Clone)]
pub(crate) struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Begins to watch. Where the system does not allow it, Ctrl-C ends the program at once, as without this.
    pub(crate) fn watch() -> Self {
        let pressed = Arc::new(AtomicBool::new(false));
        let seen = Arc::clone(&pressed);
        // Results stay complete under their final names even then: unfinished files end in `.part`.
        let _ = ctrlc::set_handler(move || {
            if seen.swap(true, Ordering::Relaxed) {
                std::process::exit(130);
            }
        });
        Self(pressed)
    }

    /// Whether it was pressed.
    pub(crate) fn is_pressed(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
