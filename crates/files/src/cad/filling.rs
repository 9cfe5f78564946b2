//! An outline of triangles, filled with tetrahedra by the user's own Gmsh.

use super::messages::GMSH_FAILED;
use super::program::{self, Gmsh};
use super::{Scratch, script};
use crate::gmsh;
use embate_solver::error::Fault;
use embate_solver::model::ImportedMesh;
use std::ffi::OsString;
use std::time::Duration;

/// Name of the outline in the folder of Gmsh.
const OUTLINE: &str = "outline.stl";
/// Angle by which the outline turns at an edge that stays one, degrees.
const EDGE: f64 = 30.0;

/// What is to be filled, and how.
#[derive(Clone, Debug)]
pub struct Filling {
    /// The text of an STL file: a closed outline.
    pub triangles: String,
    /// Length of the edges of the mesh, in the unit of the outline.
    pub size: f64,
    /// The program: a name that is looked for on `PATH`, or a path.
    pub program: OsString,
    /// How long it may take.
    pub limit: Duration,
}

impl Filling {
    /// The mesh, of tetrahedra of four nodes in the group `all`; `scale` is the length of the outline's unit,
    /// m.
    ///
    /// # Errors
    /// Gmsh is not there, fails, takes too long, or makes a mesh that embate can't use.
    pub fn mesh(&self, scale: f64) -> Result<ImportedMesh, Vec<Fault>> {
        let one = |fault: Fault| vec![fault];
        let folder = Scratch::new().map_err(one)?;
        folder.write(OUTLINE, self.triangles.as_bytes()).map_err(one)?;
        folder.write(script::NAME, self.script().as_bytes()).map_err(one)?;
        let gmsh = Gmsh { program: &self.program, limit: self.limit };
        let log = gmsh.run(&folder.0, &[script::NAME, "-3", "-v", "3", "-nt", "1", "-o", script::MESH]).map_err(one)?;
        let Some(file) = folder.read(script::MESH) else {
            let message = format!("Gmsh filled no outline{}", program::said(&log));
            return Err(one(Fault::new(&GMSH_FAILED, "", message, "take another --size, or mesh the outline in a program of your choice")));
        };
        gmsh::parse(&file, "the mesh of Gmsh", scale)
    }

    /// Pieces of the outline between its edges get new triangles, which are filled.
    fn script(&self) -> String {
        format!(
            r#"Merge "{OUTLINE}";
ClassifySurfaces{{{EDGE} * Pi / 180, 1, 1, Pi / 2}};
CreateGeometry;
Surface Loop(1) = Surface{{:}};
Volume(1) = {{1}};
Physical Volume("all", 1) = {{1}};
Mesh.MeshSizeMin = {size:e};
Mesh.MeshSizeMax = {size:e};
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.Optimize = 1;
Mesh.OptimizeNetgen = 1;
Mesh.MshFileVersion = 4.1;
Mesh.Binary = 1;
"#,
            size = self.size
        )
    }
}
