//! What the targets share: the readers of the damaged inputs of `crates/files/tests/fuzz`, under an allocator with a limit.
#![allow(missing_docs)]

#[path = "../../crates/files/tests/fuzz/targets.rs"]
#[allow(dead_code)]
mod targets;

pub use libfuzzer_sys;
pub use targets::{Target, deck, gmsh, model, state};

use cap::Cap;
use std::alloc::System;

/// Folder of the readers.
const FILES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../crates/files");
/// Most that a reader may hold, bytes: a hundred thousand times the longest input.
const LIMIT: usize = 256 << 20;

#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, LIMIT);

/// A target that reads each input; a panic, a time-out and an allocation beyond the limit end it.
#[macro_export]
macro_rules! fuzz {
    ($target:ident) => {
        thread_local!(static TARGET: $crate::Target = $crate::$target());
        $crate::libfuzzer_sys::fuzz_target!(|bytes: &[u8]| TARGET.with(|target| (target.read)(bytes)));
    };
}
