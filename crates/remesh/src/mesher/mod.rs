//! Meshes of a region that is given by its outline.

pub mod delaunay;
