//! The model file as it may be written: its sections and keys, and the check of a model before it is meshed.

mod check;
pub mod sections;

pub use check::name_is_plain;
