//! The long form of the tests, of the library's own too: `EMBATE_LONG=1`.

/// Whether this is the long form.
pub(crate) fn is_long() -> bool {
    std::env::var_os("EMBATE_LONG").is_some()
}

/// How many of so many random samples are tried: all in the long form, else a third.
pub(crate) fn samples(all: u32) -> u32 {
    if is_long() { all } else { all.div_ceil(3) }
}
