//! Tests of the solver through its public face: contracts that every entry of a registry keeps, and closed forms.

#![allow(clippy::unwrap_used, unreachable_pub)]

mod bars;
mod bodies;
mod conditions;
mod contact;
mod models;
mod projection;
mod search;
