//! What acts on bodies from outside: prescribed motion and symmetry, gravity.

pub mod constraint;
pub mod gravity;
