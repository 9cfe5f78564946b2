//! Plane meshes made again inside their outline (`mesher`) or made better without other cells (`relocate`),
//! and the conservative transfer of a state between two meshes of the same region, in 2D (`transfer`) and 3D
//! (`space`); and meshes that stay in place in a flow (`flow`).
//!
//! Pure functions: the four operations and square roots in a fixed order, so the same bits on every machine.

pub mod flow;
pub mod mesher;
pub mod plane;
pub mod relocate;
pub mod space;
mod shared;
pub mod transfer;
