//! Tests of the solver through its public face: contracts that every entry of a registry keeps.

mod projection;
mod search;
