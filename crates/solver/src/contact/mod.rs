//! Contact: search -> project -> law -> forces.

pub mod search;
