//! Meshes of Gmsh: .msh files of version 2.2 and 4.1, text and binary of either byte order, become an
//! [`ImportedMesh`].
//!
//! The walk of the data: `reader.rs` (numbers and section marks) → `version2.rs` or `version4.rs` (what
//! stands in which section; `views.rs` for both) → `contents.rs` (nodes, elements by physical group, as in
//! the file) → `mesh.rs` (dense node numbers, groups of cells) with `check.rs` (the forms of cells,
//! `form.rs`). `element_kind.rs` is the format's table of element types, `faults.rs` the list of what is
//! wrong. Parts, contacts and constraints of a model name the groups.

mod check;
mod contents;
mod element_kind;
pub(crate) mod messages;
pub(crate) mod faults;
pub(crate) mod form;
mod mesh;
mod reader;
mod version2;
mod version4;
mod views;

use crate::gmsh::messages::{DAMAGED, FORMAT, MESH_FILE};
use crate::plain;
use contents::Contents;
use embate_solver::error::Fault;
use embate_solver::model::ImportedMesh;
use reader::{Encoding, Reader, shown};
use std::path::Path;
use version4::Entities;

/// What a mesh file is read for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bodies {
    /// Bodies of its highest dimension: solids, or surfaces in the plane z = 0.
    Highest,
    /// Surfaces in 3D too, as shells: z and their direction are those of the file.
    Sheets,
}

/// Reads a Gmsh mesh file; see [`parse`]. `scale` is the length of the file's unit in metres, 1e-3 for a mesh
/// drawn in millimetres.
///
/// # Errors
/// The file can't be read, or what [`parse`] finds.
pub fn read(path: &Path, scale: f64) -> Result<ImportedMesh, Vec<Fault>> {
    read_for(Bodies::Highest, path, scale)
}

/// [`read`] for bodies of a kind.
///
/// # Errors
/// As [`read`].
pub fn read_for(bodies: Bodies, path: &Path, scale: f64) -> Result<ImportedMesh, Vec<Fault>> {
    let source = path.display().to_string();
    let bytes = plain::read(path).map_err(|error| {
        vec![Fault::new(
            &MESH_FILE,
            &source,
            format!("the mesh file can't be read: {error}"),
            "check its path, which starts at the model file's folder",
        )]
    })?;
    parse_for(bodies, &bytes, &source, scale)
}

/// Makes a mesh from the bytes of a Gmsh mesh file (.msh 2.2 or 4.1, text or binary of either byte order): in
/// 3D if a physical group holds volumes, else 2D.
///
/// - Positions are those of the file times `scale` (m per unit of the file); in 2D z is 0 within 1e-9
///   of the mesh's size.
/// - Physical groups become [`groups`](ImportedMesh::groups), ordered by dimension and tag: points, lines,
///   surfaces of triangles and quadrilaterals, volumes of tetrahedra, prisms and hexahedra. Their cells keep
///   the file's order, but those of fewer nodes come first. A group without a name is called `point-TAG`,
///   `curve-TAG`, `surface-TAG` or `volume-TAG`. An element of several groups is in each of them. Groups
///   without elements are left out.
/// - Elements of no group are left out; but if the file has no physical groups at all, its volumes are the
///   group `all`, and if it has none, its triangles and quadrilaterals are.
/// - Nodes keep the file's order; those of no volume (in 2D: of no triangle or quadrilateral) of a
///   group are left out.
/// - Views of one component by node, element, or node of elements become [`fields`](ImportedMesh::fields),
///   their values times `scale`; of several steps the first.
/// - Clockwise cells and those of negative volume are turned, their first node kept. What is outside of a
///   surface in 3D follows from the volume.
///
/// `source` names the file in messages.
///
/// # Errors
/// Every fault with its line (text) or byte offset (binary), at most 20 of a kind, the rest counted: wrong
/// version, text where a number should be, a cut file, counts that don't agree (these end the reading at
/// once); nodes that are missing, there twice, or off the plane; elements of higher order and pyramids in a
/// group; elements without area or volume, with crossing sides, or there twice; points, lines and surfaces
/// away from every body; two groups of one name.
pub fn parse(bytes: &[u8], source: &str, scale: f64) -> Result<ImportedMesh, Vec<Fault>> {
    parse_for(Bodies::Highest, bytes, source, scale)
}

/// [`parse`] for bodies of a kind.
///
/// # Errors
/// As [`parse`].
pub fn parse_for(bodies: Bodies, bytes: &[u8], source: &str, scale: f64) -> Result<ImportedMesh, Vec<Fault>> {
    if !(scale.is_finite() && scale > 0.0) {
        return Err(vec![Fault::new(&MESH_FILE, source, format!("the mesh's unit is {scale} m"), "it is a finite number greater than 0")]);
    }
    let mut reader = Reader::new(bytes, source);
    let contents = read_contents(&mut reader).map_err(|fault| vec![fault])?;
    mesh::mesh(bodies, &contents, &reader, scale)
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Version {
    Two,
    Four,
}

fn read_contents(reader: &mut Reader) -> Result<Contents, Fault> {
    let version = read_format(reader)?;
    let mut contents = Contents::default();
    let mut entities = None;
    let mut seen: Vec<&str> = Vec::new();
    loop {
        reader.skip_space();
        if reader.is_at_end() {
            break;
        }
        let start = reader.at();
        let name = reader.section_start()?;
        check_order(reader, start, name, &seen)?;
        match (name, version) {
            ("PhysicalNames", _) => contents.read_names(reader)?,
            ("Nodes", Version::Two) => version2::read_nodes(reader, &mut contents, false)?,
            ("ParametricNodes", Version::Two) => version2::read_nodes(reader, &mut contents, true)?,
            ("Elements", Version::Two) => version2::read_elements(reader, &mut contents)?,
            ("Entities", Version::Four) => version4::read_entities(reader, entities.get_or_insert_with(Entities::new), false)?,
            ("PartitionedEntities", Version::Four) => version4::read_entities(reader, entities.get_or_insert_with(Entities::new), true)?,
            ("Nodes", Version::Four) => version4::read_nodes(reader, &mut contents)?,
            ("Elements", Version::Four) => version4::read_elements(reader, &mut contents, entities.as_ref())?,
            (data, _) if let Some(place) = views::Place::of(data) => views::read(reader, &mut contents, place)?,
            _ => reader.skip_section(name, start)?,
        }
        reader.section_end(name)?;
        seen.push(name);
    }
    let has = |names: &[&str]| names.iter().any(|name| seen.contains(name));
    for (names, what) in [(&["Nodes", "ParametricNodes"][..], "$Nodes"), (&["Elements"], "$Elements")] {
        if !has(names) {
            let help = "the file was cut, or it holds no mesh; mesh the geometry in Gmsh before saving";
            return Err(reader.fault(&DAMAGED, reader.at(), format!("the file has no section {what}"), help));
        }
    }
    Ok(contents)
}

/// Sections that are read stand once, and `$Entities` before the elements that refer to them.
fn check_order(reader: &Reader, start: usize, name: &str, seen: &[&str]) -> Result<(), Fault> {
    const ONCE: [&str; 7] = ["MeshFormat", "PhysicalNames", "Entities", "PartitionedEntities", "Nodes", "ParametricNodes", "Elements"];
    if ONCE.contains(&name) && (seen.contains(&name) || name == "MeshFormat") {
        let help = "one mesh in a file: two files were joined, or it is damaged here";
        return Err(reader.fault(&DAMAGED, start, format!("a second section ${name}"), help));
    }
    if matches!(name, "Entities" | "PartitionedEntities") && seen.contains(&"Elements") {
        let help = "entities come before the elements, as Gmsh writes them";
        return Err(reader.fault(&DAMAGED, start, format!("section ${name} stands after $Elements"), help));
    }
    Ok(())
}

/// Reads `$MeshFormat`, the first section: version, kind of file, and the byte order of a binary one.
fn read_format(reader: &mut Reader) -> Result<Version, Fault> {
    const AGAIN: &str = "save it again with Gmsh: gmsh OLD.msh -save -format msh41 -o NEW.msh";
    reader.skip_space();
    let start = reader.at();
    match reader.section_start() {
        Ok("MeshFormat") => {}
        Ok("NOD" | "ELM") => return Err(reader.fault(&FORMAT, start, "the file is of version 1; 2.2 and 4.1 are read", AGAIN)),
        _ => {
            let help = "the first line of such a file is $MeshFormat; is it the right file?";
            return Err(reader.fault(&FORMAT, start, "this is not a Gmsh mesh file", help));
        }
    }
    let at = reader.at();
    let version = match reader.word("the version of the format")? {
        b"2.2" => Version::Two,
        b"4.1" => Version::Four,
        other => return Err(reader.fault(&FORMAT, at, format!("the file is of version {}; 2.2 and 4.1 are read", shown(other)), AGAIN)),
    };
    let kind: i64 = reader.text("the kind of file (0 text, 1 binary)")?;
    let size: usize = reader.text("the size of numbers in bytes")?;
    reader.end_of_line()?;
    // Version 2 gives the size of a floating point number, version 4 that of a size_t.
    if !(size == 8 || size == 4 && version == Version::Four) {
        return Err(reader.fault(&FORMAT, at, format!("the file's numbers have {size} bytes; 8 are read"), AGAIN));
    }
    match kind {
        0 => {}
        1 => {
            let big_endian = match reader.byte_order_mark()? {
                [1, 0, 0, 0] => false,
                [0, 0, 0, 1] => true,
                mark => {
                    let help = "the number one is expected here: the file was changed by a text tool, or is damaged";
                    return Err(reader.fault(
                        &DAMAGED,
                        reader.at(),
                        format!("the file's byte order can't be derived from the bytes {mark:?}"),
                        help,
                    ));
                }
            };
            reader.set_encoding(Encoding::Binary { big_endian, size_bytes: size });
        }
        other => return Err(reader.fault(&FORMAT, at, format!("the kind of file is {other}"), "it is 0 (text) or 1 (binary)")),
    }
    reader.section_end("MeshFormat")?;
    Ok(version)
}
