//! The method: explicit central differences, finite elements, contact. No files, no printing, no global
//! state.
//!
//! Modules are listed in the order of dependency: none imports one that stands below it, but for those that
//! `tests/all/rooms.rs` lists. `docs/images/rooms.svg` shows them.

pub mod archive;
pub mod message;
pub mod error;
pub mod hash;
pub mod quantity;
pub mod vocabulary;
pub mod tensor;
mod angle;
pub mod expression;
mod vector;
pub mod rotation;
pub mod rows;
pub mod forest;
pub mod reductions;
pub mod random;
pub mod lanczos;
pub mod stress_state;
pub mod model;
pub mod mesh;
mod masses;
pub mod material;
pub mod element;
pub mod failure;
pub mod load;
pub mod energy;
pub mod outline;
pub mod contact_forces;
pub mod rigid;
pub mod rotations;
pub mod skins;
pub mod block;
pub mod contact;
pub mod dimension;
pub mod assembly;
pub mod step;
pub mod build;
mod failure_location;
mod field;
pub mod output;
mod snapshot;
pub mod input;
pub mod body_columns;
mod record;
pub mod channel;
mod shortest;
mod monitor;
pub mod catalogue;
pub mod hashes;
pub mod simulation;
pub mod divergence;
pub mod post_mortem;
pub mod bench;
