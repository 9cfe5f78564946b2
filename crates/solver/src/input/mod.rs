//! What a user may write: the sections and keys of the model file, and the check of a model before it is
//! meshed.

mod check;
pub mod sections;

pub use check::name_is_plain;
