//! Which program writes: its version, and the commit that it was built from, where its main function has
//! reported it.
//!
//! The version decides what is read (checkpoints, sweeps); the commit is noted for people and compared by
//! no one.

use std::sync::OnceLock;

static COMMIT: OnceLock<&'static str> = OnceLock::new();

/// The version.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Says from which commit the program was built; what is written from then on has it. Only the first call
/// counts.
pub fn built_from(commit: &'static str) {
    let _ = COMMIT.set(commit);
}

/// The commit, abbreviated, and its day; `None`: no one knows it.
#[must_use]
pub fn commit() -> Option<&'static str> {
    COMMIT.get().copied()
}

/// A version as people read it: with its commit, where one is known.
pub(crate) fn named(version: &str, commit: Option<&str>) -> String {
    commit.map_or_else(|| version.to_string(), |commit| format!("{version} ({commit})"))
}
