//! What acts on bodies from outside: prescribed motion and symmetry, rigid walls, gravity.

pub mod constraint;
pub mod gravity;
pub mod wall;
