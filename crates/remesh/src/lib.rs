//! Plane meshes made again inside their outline (`mesher`), and the conservative transfer of a state between
//! two meshes of the same region (`transfer`).
//!
//! Pure functions: the four operations and square roots in a fixed order, so the same bits on every machine.

pub mod mesher;
pub mod plane;
pub mod transfer;
