//! Time: the stable step. The central difference update itself is one line of [`crate::step`].

pub mod stable;
