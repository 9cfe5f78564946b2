//! Tests of the formats from outside, one module a format.

#![allow(clippy::unwrap_used)]

mod abaqus;
mod damaged_state;
mod gmsh;
mod library;
mod model_file;
mod picture;
mod picture_space;
mod post_mortem;
mod preview;
mod reach;
mod registries;
mod report;
mod results;
mod stl;
mod view;
