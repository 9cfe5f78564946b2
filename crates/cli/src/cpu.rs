//! The CPU time of this process and of one thread, from the system.

/// User CPU time of all threads so far, s; `None` where the system does not report it.
#[cfg(unix)]
pub(crate) fn user_seconds() -> Option<f64> {
    use nix::sys::resource::{UsageWho, getrusage};
    use nix::sys::time::TimeValLike;
    getrusage(UsageWho::RUSAGE_SELF).ok().map(|usage| usage.user_time().num_microseconds() as f64 * 1e-6)
}

/// User CPU time of all threads so far, s; `None` where the system does not report it.
#[cfg(not(unix))]
pub(crate) fn user_seconds() -> Option<f64> {
    None
}

/// User CPU time of the calling thread so far, s; `None` where the system does not report it.
#[cfg(target_os = "linux")]
pub(crate) fn user_seconds_of_thread() -> Option<f64> {
    use nix::sys::resource::{UsageWho, getrusage};
    use nix::sys::time::TimeValLike;
    getrusage(UsageWho::RUSAGE_THREAD).ok().map(|usage| usage.user_time().num_microseconds() as f64 * 1e-6)
}

/// User CPU time of the calling thread so far, s; `None` where the system does not report it.
#[cfg(not(target_os = "linux"))]
pub(crate) fn user_seconds_of_thread() -> Option<f64> {
    None
}
