//! Formats that embate reads and writes, one a file.

pub mod abaqus;
pub mod cad;
pub mod checkpoint;
pub mod comparison;
pub mod gmsh;
pub mod mesh_file;
pub mod messages;
pub mod model_file;
pub mod numbers;
mod outline;
mod plain;
pub mod picture;
pub mod post_mortem;
pub mod preview;
pub mod program;
mod path_policy;
pub mod registries;
pub mod report;
pub mod results;
pub mod stl;
pub mod sweep;
pub mod threads;
pub mod verification;
pub mod view;
pub mod vtu;

pub use path_policy::PathPolicy;
