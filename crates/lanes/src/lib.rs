//! Vector lanes: one kernel text, generic over [`Lane`], gives the same bits with scalar code, AVX2 and
//! AVX-512.
//!
//! The same bits come from using only operations that IEEE 754 rounds correctly (`+ - * /`, `sqrt`),
//! comparisons, selections and bit patterns; multiply and add are never fused. `exp`, `ln`, `pow` and `cbrt`
//! are built from them ([`math`]), because the platform's differ.
//!
//! [`Team`] shares short loops among threads.
//!
//! This crate holds the only unsafe code of embate. Storage is in batches of [`BATCH`] values; a lane type
//! takes a batch in `BATCH / WIDTH` parts. [`Level`] chooses the instruction set at run time; [`Indices`] and
//! [`Places`] know their bound so that gathers check it once.

#[cfg(feature = "count")]
mod counted;
mod dispatch;
mod gather;
mod lane;
pub mod math;
mod scalar;
mod team;
#[cfg(target_arch = "x86_64")]
mod x86;

#[cfg(feature = "count")]
pub use counted::Operations;
pub use dispatch::{Kernel, Level, prefetch, prefetch_ahead};
pub use gather::{Indices, Moving, Places, Room, VectorSums};
pub use lane::{BATCH, Batch, Lane};
pub use team::{Chunks, Parts, Team};

#[cfg(test)]
mod tests;
