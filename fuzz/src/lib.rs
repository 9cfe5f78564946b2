//! What the targets share: the readers of the damaged inputs of `crates/files/tests/fuzz`, under an allocator
//! with a limit.
#![allow(missing_docs)]

#[path = "../../crates/files/tests/fuzz/targets.rs"]
#[allow(dead_code)]
mod targets;

pub use libfuzzer_sys;
pub use targets::{Target, deck, gmsh, model};

use cap::Cap;
use std::alloc::System;

/// Folder of the readers.
const FILES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../crates/files");
/// Most that a reader may hold, bytes: a hundred thousand times the longest input.
const LIMIT: usize = 256 << 20;

#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, LIMIT);

/// The state of a run behind its check sums.
pub fn state() -> Target {
    by_changes(targets::state())
}

/// A field file.
pub fn fields() -> Target {
    by_changes(targets::fields())
}

/// The file of a checkpoint with its check sums set right.
pub fn checkpoint() -> Target {
    by_changes(targets::checkpoint())
}

/// An input is what is changed in a sound one: so inputs are short, most of it stays right, and a corpus
/// outlives its form.
fn by_changes(Target { name, seeds, read }: Target) -> Target {
    let sound = seeds.concat();
    Target { name, seeds: Vec::new(), read: Box::new(move |changes| read(&changed(sound.clone(), changes))) }
}

/// Applies changes of eleven bytes each: place 2, what is done 1, a number 8.
fn changed(mut bytes: Vec<u8>, changes: &[u8]) -> Vec<u8> {
    for change in changes.as_chunks::<11>().0 {
        let [low, high, what, number @ ..] = *change;
        let at = usize::from(u16::from_le_bytes([low, high])) % bytes.len().max(1);
        let end = (at + 8).min(bytes.len());
        match what % 8 {
            // Numbers of eight bytes are what a state is made of, and counts among them.
            0..=3 => drop(bytes.splice(at..end, number)),
            4 => bytes[at..end].iter_mut().zip(number).for_each(|(byte, other)| *byte ^= other),
            5 => drop(bytes.splice(at..at, number)),
            6 => drop(bytes.drain(at..end)),
            _ => bytes.truncate(at),
        }
    }
    bytes
}

/// A target that reads each input; a panic, a time-out and an allocation beyond the limit end it.
#[macro_export]
macro_rules! fuzz {
    ($target:ident) => {
        thread_local!(static TARGET: $crate::Target = $crate::$target());
        $crate::libfuzzer_sys::fuzz_target!(|bytes: &[u8]| TARGET.with(|target| (target.read)(bytes)));
    };
}
