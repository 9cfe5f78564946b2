//! Meshes of CAD files by the user's own Gmsh: STEP, IGES and BREP files become .msh files with a physical
//! group for each volume and each of its faces.
//!
//! `filling.rs` has Gmsh fill an outline of triangles, that of a part in a run. `script.rs` writes what Gmsh
//! is to do and reads which volumes and faces it found; `program.rs` runs the program, in a folder of its own
//! and with a time limit; `names.rs` names the groups, in the file too; `describe.rs` says what was made.
//! Nothing of the user's is text of the script: the CAD file is copied under a name that is always the same,
//! so that no path or name of a body can be taken for a command.

mod describe;
mod filling;
pub(crate) mod messages;
mod names;
mod program;
mod script;

pub use filling::Filling;

use crate::{gmsh, plain};
use embate_solver::error::Fault;
use embate_solver::model::ImportedMesh;
use messages::{GEOMETRY, GMSH_FAILED};
use names::Body;
use program::Gmsh;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Endings of the files that Gmsh reads as CAD files.
pub const ENDINGS: [&str; 5] = ["step", "stp", "iges", "igs", "brep"];

/// A unit of length that a mesh can be in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// As in a model file.
    pub name: &'static str,
    /// m.
    pub length: f64,
    /// Its name in Gmsh (`Geometry.OCCTargetUnit`).
    gmsh: &'static str,
}

/// The units, the default first.
pub const UNITS: [Unit; 5] = [
    Unit { name: "mm", length: 1e-3, gmsh: "MM" },
    Unit { name: "cm", length: 1e-2, gmsh: "CM" },
    Unit { name: "m", length: 1.0, gmsh: "M" },
    Unit { name: "in", length: 0.0254, gmsh: "INCH" },
    Unit { name: "ft", length: 0.3048, gmsh: "FT" },
];

/// What is to be meshed, and how.
#[derive(Clone, Debug)]
pub struct Job {
    /// The CAD file.
    pub geometry: PathBuf,
    /// Largest length of an edge of the mesh, m.
    pub size: f64,
    /// Unit of the lengths in the mesh file.
    pub unit: Unit,
    /// Order of the elements: 1, or 2 with nodes between the corners.
    pub order: u8,
    /// The program: a name that is looked for on `PATH`, or a path.
    pub program: OsString,
    /// How long it may take.
    pub limit: Duration,
}

/// A mesh that Gmsh has made.
#[derive(Clone, Debug)]
pub struct Meshed {
    /// The .msh file.
    pub file: Vec<u8>,
    /// What is in it, lengths in m.
    pub mesh: ImportedMesh,
    bodies: Vec<Body>,
    unit: Unit,
}

impl Job {
    /// Meshes the CAD file with tetrahedra of four nodes, or ten.
    ///
    /// # Errors
    /// One fault: the CAD file can't be read, is of no kind that Gmsh reads, or holds no volume; Gmsh is not
    /// there, fails, takes too long, or makes a mesh that embate can't use.
    pub fn mesh(&self) -> Result<Meshed, Vec<Fault>> {
        let shown = self.geometry.display().to_string();
        let ending = self.geometry.extension().and_then(|it| it.to_str()).map(str::to_ascii_lowercase).unwrap_or_default();
        if !ENDINGS.contains(&ending.as_str()) {
            let message = format!("{shown} is no CAD file by its name");
            return Err(vec![Fault::new(&GEOMETRY, "", message, format!("its name ends with one of .{}", ENDINGS.join(", .")))]);
        }
        if !(self.size.is_finite() && self.size > 0.0) {
            let help = "give a length greater than 0, such as \"2 mm\"";
            return Err(vec![Fault::new(&GEOMETRY, "", format!("the size of elements is {} m", self.size), help)]);
        }
        let one = |fault: Fault| vec![fault];
        let geometry = plain::read(&self.geometry)
            .map_err(|error| one(Fault::new(&GEOMETRY, "", format!("{shown} can't be read: {error}"), "check its path")))?;
        let folder = Scratch::new().map_err(one)?;
        let copy = format!("geometry.{ending}");
        folder.write(&copy, &geometry).map_err(one)?;
        folder.write(script::NAME, script::text(&copy, self.unit, self.size / self.unit.length, self.order).as_bytes()).map_err(one)?;
        drop(geometry);
        let gmsh = Gmsh { program: &self.program, limit: self.limit };
        let log = gmsh.run(&folder.0, &[script::NAME, "-3", "-v", "3", "-nt", "1", "-o", script::MESH]).map_err(one)?;
        let found = script::Found::read(&folder.read(script::FOUND).unwrap_or_default());
        if found.volumes.is_empty() {
            let (message, help) = match found.surfaces {
                Some(0) => {
                    let message = format!("Gmsh finds neither volumes nor surfaces in {shown}{}", program::said(&log));
                    (message, "export the body as a solid from the CAD program")
                }
                Some(count) => {
                    let help = "export the body as a solid; a shell of its surfaces is meshed in Gmsh itself (Physical Surface, gmsh -2)";
                    (format!("{shown} holds {count} surface(s), but no volume"), help)
                }
                None => (format!("Gmsh could not read {shown}{}", program::said(&log)), "export it again from the CAD program"),
            };
            return Err(one(Fault::new(&GEOMETRY, "", message, help)));
        }
        let stem = self.geometry.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        let bodies = names::bodies(&found, &stem);
        let made = folder.read(script::MESH).and_then(|bytes| names::named(&bytes, &bodies));
        let Some(file) = made else {
            let message = format!("Gmsh wrote no mesh of {shown}{}", program::said(&log));
            return Err(one(Fault::new(
                &GMSH_FAILED,
                "",
                message,
                "take another --size, or mesh the file in Gmsh itself to see where it fails",
            )));
        };
        let mesh = gmsh::parse(&file, "the mesh of Gmsh", self.unit.length)?;
        Ok(Meshed { file, mesh, bodies, unit: self.unit })
    }
}

/// A folder for one run of Gmsh, which goes with it.
struct Scratch(PathBuf);

impl Scratch {
    fn new() -> Result<Self, Fault> {
        let all = std::env::temp_dir();
        let mut error = None;
        for number in 0..1000 {
            let folder = all.join(format!("embate-mesh-{}-{number}", std::process::id()));
            match Self::create(&folder) {
                Ok(()) => return Ok(Self(folder)),
                Err(wrong) if wrong.kind() == std::io::ErrorKind::AlreadyExists => {}
                Err(wrong) => {
                    error = Some(wrong);
                    break;
                }
            }
        }
        let why = error.map_or("too many are there".to_string(), |error| error.to_string());
        Err(no_room(format!("no folder for the work of Gmsh can be made in {}: {why}", all.display())))
    }

    /// One that is new and nobody else's.
    fn create(folder: &Path) -> std::io::Result<()> {
        let mut builder = std::fs::DirBuilder::new();
        #[cfg(unix)]
        std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
        builder.create(folder)
    }

    fn write(&self, name: &str, bytes: &[u8]) -> Result<(), Fault> {
        let path = self.0.join(name);
        std::fs::write(&path, bytes).map_err(|error| no_room(format!("can't write {}: {error}", path.display())))
    }

    fn read(&self, name: &str) -> Option<Vec<u8>> {
        plain::read(&self.0.join(name)).ok()
    }
}

fn no_room(message: String) -> Fault {
    Fault::new(&GMSH_FAILED, "", message, "make room there, or name another folder in TMPDIR")
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // What can't be removed stays in a folder for such things.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}
