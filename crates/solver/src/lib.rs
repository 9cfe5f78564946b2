//! The method: explicit central differences, finite elements, contact. No files, no printing, no global state.
//!
//! The contents are listed in the order in which the data walks through them.

pub mod contact;
pub mod element;
pub mod error;
pub mod material;
pub mod mesh;
pub mod model;
pub mod output;
pub mod quantity;
pub mod simulation;
