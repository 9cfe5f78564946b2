//! Tests of the solver through its public face: contracts that every entry of a registry keeps.

#![allow(clippy::unwrap_used)] // a test that meets nothing where something must be shall end there

mod blocks;
mod bodies;
mod elements;
mod materials;
mod patches;
mod plasticity;
mod search;
