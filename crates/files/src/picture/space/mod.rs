//! Pictures of models in 3D: shaded bodies with hidden surfaces, seen from a camera afar.
//!
//! The way of a picture: `sides` finds which sides of cells lie against each other, `skin` takes those that
//! are seen, `camera` says where places are in the picture, `shade` lights facets, `drawing` hands them to
//! `raster`, which keeps what is nearest; `obstacle` adds obstacles as a veil and `scene` lays out. Of a
//! post-mortem's pictures `outlook` chooses the direction and cuts away what veils, `shot` draws the bodies
//! of a panel as an image within an SVG, `near` and `spot` lay out the neighbourhood of a failure location
//! and its place. Cells, frames and the choice of a field come from `film` and `mesh`, as in 2D; title and
//! legend are those of `sheet`.

mod camera;
mod drawing;
mod near;
pub(super) mod obstacle;
mod outlook;
mod raster;
mod scene;
mod shade;
mod shot;
mod sides;
mod skin;
mod spot;

pub(super) use camera::Sight;
pub(crate) use near::neighbourhood;
pub(super) use scene::{Moment, Scene};
pub(crate) use shot::base64;
pub(super) use skin::Skin;
pub(crate) use skin::{Bar, Facet, Skinner};
pub(crate) use spot::{Spot, place};

#[cfg(test)]
pub(super) use sides::tests;
