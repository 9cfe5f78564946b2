//! A model as it is seen before it runs: its mesh, and glyphs for supports, loads, velocities, contacts and
//! whatever else acts on it. Of a faulty model what can be meshed, and where its faults are.
//!
//! The way: `source` reads a model as far as that goes and makes a simulation of it, or of its sound parts
//! alone; `glyphs` goes through the sections of the model, with places from `places`, and marks where faults
//! are. Pictures ([`crate::picture::mesh_png`]) and the page of `embate view MODEL` draw what is here.

mod even;
mod glyphs;
mod kinds;
mod places;
mod source;

pub use glyphs::Glyph;
pub use kinds::{GlyphKind, KINDS, Symbol};
pub use source::{Preview, Source};
