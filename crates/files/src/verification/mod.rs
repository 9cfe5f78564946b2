//! Verification: cases with a known answer, and whether the program gives it.
//!
//! A case is a folder with model files, a README and `expected.toml`. The walk: `expected.toml` and its
//! models -> [`Case`] (`read.rs`, keys in `describe.rs`, data in `case.rs`) -> runs with what is kept of them
//! (`run.rs`) -> numbers (`quantity.rs`) -> verdicts (`judge.rs`). The program's command `verify` prints
//! them; `report.rs` makes a page of them, `plot.rs` what it draws.

mod case;
pub(crate) mod messages;
mod describe;
mod judge;
mod plot;
mod quantity;
mod read;
pub mod report;
mod run;

pub use case::{Accepted, Case, Check, Combination, How, Place, Quantity, Source, TAKES, Take, Tier, With};
pub use describe::expected_markdown;
pub use judge::{CaseOutcome, CheckOutcome, verify};
pub use plot::Plot;
pub(crate) use quantity::Samples;
pub use read::{FILE_NAME, load};
pub(crate) use run::Gathering;
pub use run::VerifyError;
