//! Decks of Abaqus and CalculiX: .inp files become an [`ImportedMesh`], or a whole model.
//!
//! The walk of the data: `text.rs` (files, includes, keywords with their data lines) → `deck.rs` and
//! `sets.rs` (nodes, elements, sets and surfaces, with instances in place; `element_kind.rs` is the table of
//! element types) → `mesh.rs` (the mesh), or `import/` (a model file with a report of what became of each
//! keyword).

pub(crate) mod messages;
mod deck;
mod element_kind;
pub mod import;
mod mesh;
mod sets;
mod text;

use crate::gmsh::Bodies;
use crate::gmsh::messages::MESH_FILE;
use crate::path_policy::{Bounds, PathPolicy};
use deck::{Deck, Purpose};
use embate_solver::error::Fault;
use embate_solver::model::ImportedMesh;
use std::path::Path;
use text::Text;

/// Reads the mesh of a deck; see [`parse`]. `scale` is the length of the file's unit in metres.
///
/// # Errors
/// The file can't be read, or what [`parse`] finds.
pub fn read(path: &Path, scale: f64) -> Result<ImportedMesh, Vec<Fault>> {
    read_within(Bodies::Highest, path, scale, &Bounds::of(path.parent().unwrap_or(Path::new("")), "deck's", PathPolicy::Folder))
}

/// [`read`] for bodies of a kind, with the folder that included files must lie in.
pub(crate) fn read_within(bodies: Bodies, path: &Path, scale: f64, bounds: &Bounds) -> Result<ImportedMesh, Vec<Fault>> {
    let text = Text::read(path, &path.display().to_string(), bounds).map_err(|fault| vec![fault])?;
    mesh(bodies, &text, scale)
}

/// Makes a mesh from the bytes of a deck (.inp), in 3D if it has solids or is read for shells or beams in 3D,
/// else 2D; what it includes is looked for in `folder` and nowhere else.
///
/// - Positions are those of the file times `scale` (m per unit of the file), with instances in place; in the
///   plane z is 0 within 1e-9 of the mesh's size.
/// - Groups: element sets (of the dimension of their elements, in the order of the set; where they are of
///   several, the others are `NAME-surfaces` and `NAME-lines`), surfaces of element sides (lines, in 3D
///   surfaces: of a shell's face those of the element, seen from that face), surfaces of nodes and node sets
///   (points). Outside of its part
///   the set of an instance is called `INSTANCE.SET`. Names keep their first spelling. A surface or node set
///   whose name is taken is called `NAME-surface` or `NAME-nodes`. If the deck has no element sets, its
///   elements are the group `all`.
/// - *NODAL THICKNESS becomes the field `nodal_thickness`.
/// - Nodes keep the file's order; those of no body are left out, also of sets.
/// - Clockwise elements and those of negative volume are turned, their first node kept.
/// - Masses, springs, rigid lines, in 2D beams of 3D and the like are skipped, and so is every keyword that
///   is not about geometry.
///
/// `source` names the file in messages.
///
/// # Errors
/// The first fault of the text with its line: what is no keyword, number or name, a missing node, a number
/// twice, elements of second order, of 2D beside those of 3D, or of unknown type, keywords that generate
/// nodes or elements; or all nodes that are off the plane, or all solids without volume.
pub fn parse(bytes: &[u8], source: &str, folder: &Path, scale: f64) -> Result<ImportedMesh, Vec<Fault>> {
    parse_for(Bodies::Highest, bytes, source, folder, scale)
}

/// [`parse`] for bodies of a kind.
///
/// # Errors
/// As [`parse`].
pub fn parse_for(bodies: Bodies, bytes: &[u8], source: &str, folder: &Path, scale: f64) -> Result<ImportedMesh, Vec<Fault>> {
    let text = Text::parse(bytes, source, folder, &Bounds::of(folder, "deck's", PathPolicy::Folder)).map_err(|fault| vec![fault])?;
    mesh(bodies, &text, scale)
}

fn mesh(bodies: Bodies, text: &Text, scale: f64) -> Result<ImportedMesh, Vec<Fault>> {
    if !(scale.is_finite() && scale > 0.0) {
        let message = format!("the mesh's unit is {scale} m");
        return Err(vec![Fault::new(&MESH_FILE, text.shown_name(), message, "it is a finite number greater than 0")]);
    }
    let deck = Deck::read(text, Purpose::Mesh(bodies)).map_err(|fault| vec![fault])?;
    mesh::mesh(&deck, text, scale)
}
