//! Files of meshes: their formats, by the endings of their names.

use crate::{abaqus, gmsh};
use embate_solver::error::Fault;
use embate_solver::model::ImportedMesh;
use std::path::Path;

/// What a file of a mesh is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    /// A file of Gmsh.
    Gmsh,
    /// A deck of Abaqus or CalculiX.
    Deck,
    /// A surface of triangles.
    Stl,
}

impl Format {
    /// That of a name; what has no ending of another one is read as a file of Gmsh.
    pub(crate) fn of(path: &Path) -> Self {
        let ends = |with: &str| path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(with));
        match () {
            () if ends("inp") => Self::Deck,
            () if ends("stl") => Self::Stl,
            () => Self::Gmsh,
        }
    }
}

/// Reads the mesh of bodies from a deck (.inp) or a file of Gmsh. `scale` is the length of the file's unit in
/// metres.
///
/// # Errors
/// The file can't be read, or what is wrong in it.
pub fn read(path: &Path, scale: f64) -> Result<ImportedMesh, Vec<Fault>> {
    match Format::of(path) {
        Format::Deck => abaqus::read(path, scale),
        Format::Gmsh | Format::Stl => gmsh::read(path, scale),
    }
}
