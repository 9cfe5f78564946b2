//! Which program this is: version, the commit that it was built from (`build.rs` notes it), and for which
//! machines.

use embate_files::program;
use std::sync::LazyLock;

/// Version and commit, as `embate -V` reports them.
static SHORT: LazyLock<String> = LazyLock::new(|| match commit() {
    Some(commit) => format!("{} ({commit})", program::VERSION),
    None => program::VERSION.to_string(),
});

/// What `embate --version` reports: also what it was compiled for, which reports of faults should say.
static LONG: LazyLock<String> = LazyLock::new(|| format!("{}\n{}", *SHORT, env!("EMBATE_TARGET")));

/// The commit; `None`: it was built from sources that don't say it.
pub(crate) fn commit() -> Option<&'static str> {
    Some(env!("EMBATE_COMMIT")).filter(|commit| !commit.is_empty())
}

pub(crate) fn short() -> &'static str {
    &SHORT
}

pub(crate) fn long() -> &'static str {
    &LONG
}
