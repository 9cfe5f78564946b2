//! Nodes, element groups, surfaces and sets: what the shapes and mesh files become before blocks are made from them.

pub mod shapes;
pub mod surface;
