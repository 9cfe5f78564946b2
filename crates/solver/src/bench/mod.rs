//! Measurement of speed, for `embate bench` and for the benchmarks of this crate: bodies of any element and
//! law (`bodies.rs`), rates of kernels and whole steps (`rates.rs`), numbers that look random
//! ([`Random`]), and the limits of the machine (`ceilings.rs`).
//!
//! Times are those of the machine's clock, the best of several rounds: other work on the machine makes rounds
//! slower, never faster.

mod bodies;
mod ceilings;
mod rates;

pub use crate::random::Random;
pub use bodies::{Patch, contact, material, slabs, spinning_block, spinning_cube, spinning_sheet, strips};
pub use ceilings::{multiply_add, triad};
pub use embate_lanes::Level;
#[cfg(feature = "count")]
pub use rates::operations;
pub use rates::{best_rate, kernel, shortest, step, step_times, steps_of};
