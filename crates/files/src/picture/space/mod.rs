//! Pictures of models of space: shaded bodies with hidden surfaces, seen from a camera afar.
//!
//! The way of a picture: `sides` finds which sides of cells lie against each other, `skin` takes those that are seen, `camera` says where places are in the
//! picture, `shade` lights facets, `drawing` hands them to `raster`, which keeps what is nearest; `obstacle` adds obstacles as a veil and `scene` lays out.
//! Cells, frames and the choice of a field come from `film` and `mesh`, as in the plane; title and legend are those of `sheet`.

mod camera;
mod drawing;
pub(super) mod obstacle;
mod raster;
mod scene;
mod shade;
mod sides;
mod skin;

pub(super) use camera::Sight;
pub(super) use scene::{Moment, Scene};
pub(super) use skin::{Skin, Skinner};

#[cfg(test)]
pub(super) use sides::tests;
