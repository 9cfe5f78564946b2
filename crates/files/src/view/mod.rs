//! What a page shows of a run: bodies as their skin, frames of one scalar, histories, and what there is to
//! choose from.
//!
//! [`ResultView`] opens a result folder (`vtu::read`, `history.csv`, `summary.json`, `run.json`); [`Bodies`]
//! makes skins of cells ([`crate::picture`] has the skinner) and frames of anything that is
//! [`embate_solver::output::Shown`], a file that was read or a simulation that runs. All goes to
//! `embate-viewer` as one binary [`Container`], described in `docs/viewer.md`, or as JSON
//! ([`RunDescription`]).

mod arrays;
mod averages;
mod bodies;
mod container;
mod describe;
mod folder;
mod frame;
mod glyphs;
mod levels;
mod model;
mod probe;
mod request;
mod section;
mod values;

pub use arrays::{FrameArrays, frame_files};
pub use bodies::{Bodies, Topology};
pub use container::Container;
pub use describe::{Column, FrameTime, PartDescription, RunDescription, ScalarDescription, Warned};
pub use folder::{Ranged, ResultView, Series};
pub use frame::{frame, gone, outlines};
pub use model::ModelView;
pub use probe::{ProbePlace, Probed, Track};
pub use request::{FrameRequest, Plane, SectionRequest};
pub use values::RangeOf;
