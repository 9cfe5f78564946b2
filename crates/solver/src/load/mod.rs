//! What acts on bodies from outside: prescribed motion and symmetry, gravity, damping; and the curves that motion follows.

pub mod constraint;
pub mod curve;
pub mod damping;
pub mod gravity;
