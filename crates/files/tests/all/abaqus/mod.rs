//! Decks of Abaqus and CalculiX: what is read, what is refused and with which words, and that no text makes
//! the reader panic.

mod import;
mod malformed;
mod meshes;
mod sheets;
mod solids;

use embate_files::abaqus::parse;
use embate_solver::error::Fault;
use embate_solver::model::{ImportedMesh, MeshGroup};
use std::path::Path;

/// Two squares and a triangle beside each other, with sets and surfaces of every kind.
pub(crate) const FLAT: &str = "*HEADING
 two squares and a triangle
** a comment
*Node, NSET=all nodes
 1, 0., 0.
 2, 1.d0, 0.0, 0.
 3, 2, 0
 4, 0, 1
 5, 1, 1
 6, 2, 1
 7, 3, 0
 99, 5, 5, 7
*Element, type=cpe4r,
  elset=Squares
 1, 1, 2,
 5, 4
 2, 2, 3, 6, 5
*ELEMENT, TYPE=CPE3, ELSET=\"the triangle\"
 3, 3, 7, 6
*ELSET, ELSET=both, GENERATE
 1, 1000000000000, 2
*elset, elset=everything
 SQUARES, 3
*NSET, NSET=left
 1, 4,
*NSET, NSET=left
 4
*Nset, nset=even, generate
 2, 6, 2
*NSET, NSET=of squares, ELSET=Squares
*SURFACE, TYPE=ELEMENT, NAME=top
 SQUARES, S3
*SURFACE, NAME=outside
 ,
*SURFACE, NAME=left, TYPE=NODE
 left
*SURFACE, NAME=rigid, TYPE=SEGMENTS
 START, 0., 0.
 LINE, 1., 0.
*MATERIAL, NAME=steel
*DENSITY
 7800.
";

pub(crate) fn read(text: &str) -> Result<ImportedMesh, Vec<Fault>> {
    parse(text.as_bytes(), "d.inp", Path::new(""), 1.0)
}

fn group<'a>(mesh: &'a ImportedMesh, name: &str) -> &'a MeshGroup {
    let names: Vec<_> = mesh.groups.iter().map(|group| &group.name).collect();
    mesh.groups.iter().find(|group| group.name == name).unwrap_or_else(|| panic!("no {name} in {names:?}"))
}
