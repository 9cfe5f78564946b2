//! VTK XML files of unstructured grids (`.vtu`) and the collection that puts them on a time axis (`.pvd`).
//!
//! What is shown ([`Shown`]) of its [`Cells`] becomes the bytes of one file: a short XML head, then all
//! arrays as appended raw binary, little-endian, each in zlib blocks with 64-bit headers. What never changes
//! during a run (connectivity, cell types, parts) is encoded once by [`VtuWriter::new`]. Blocks have a fixed
//! size and are packed by several threads at once. Equal input gives equal bytes on every machine, for any
//! number of threads. The bytes go to [`crate::results`], ParaView and `tests/read_back.py` read them.
//! `obstacles` makes a file of obstacles in the same way. Source: VTK file formats, "XML formats",
//! `vtkZLibDataCompressor`.

mod pack;
pub(crate) mod read;

use crate::outline::Surface;
use crate::threads::{ScratchPool, Threads};
use embate_solver::output::{CellKind, Cells, FieldKind, Frame, Location, Shown};
use pack::{Array, Column, Data, Packer, Plain, plain, write_in_pieces, zlib_blocks};
use std::fmt::Write as _;
use std::io::{self, Seek, SeekFrom, Write};
use thiserror::Error;

/// For each thread: arrays are packed together up to so many bytes, and of larger ones so many at a time.
const AT_ONCE: usize = 1 << 20;
/// At most so many for all threads.
const AT_ONCE_MAX: usize = 1 << 23;
/// Characters of the place of an array in the head, quotes and the room behind them included.
const PLACE: usize = 18;

/// Attributes of arrays that every file has.
const POINTS: &str = "type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"";
const CONNECTIVITY: &str = "type=\"Int64\" Name=\"connectivity\"";
const OFFSETS: &str = "type=\"Int64\" Name=\"offsets\"";
const TYPES: &str = "type=\"UInt8\" Name=\"types\"";

/// A frame that does not fit its cells; a fault of the program that made it, never of its user.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum VtuError {
    /// A field has the wrong number of values.
    #[error("field \"{name}\" has {found} values where {expected} are needed; this is a bug in embate")]
    FieldLength {
        /// Field name.
        name: &'static str,
        /// Values that it has.
        found: usize,
        /// Values that it needs.
        expected: usize,
    },
    /// A cell refers to a node that the frame does not have.
    #[error("a cell uses node {node}, but the frame has {nodes} nodes; this is a bug in embate")]
    NodeMissing {
        /// Largest node index of the cells.
        node: u32,
        /// Nodes of the frame.
        nodes: usize,
    },
}

/// Writes the frames of one run.
pub struct VtuWriter {
    packers: ScratchPool<Packer>,
    cell_count: usize,
    /// Of the mesh ([`Cells::revision`]).
    revision: u32,
    node_last: Option<u32>,
    connectivity: Array,
    offsets: Array,
    types: Array,
    parts: Array,
}

impl VtuWriter {
    /// A writer for the frames of `cells`.
    #[must_use]
    pub fn new(cells: &Cells, threads: &Threads) -> Self {
        let types = cells.kinds.iter().map(|&kind| kind.facts().vtk).collect();
        let parts = cells.parts.iter().flat_map(|&p| p.to_le_bytes()).collect();
        let packers = ScratchPool::default();
        let packed = |attributes, data| zlib_blocks(&[&plain(attributes, data)], &packers, threads).next().expect("an array was put in");
        Self {
            cell_count: cells.len(),
            revision: cells.revision,
            node_last: cells.nodes.iter().copied().max(),
            connectivity: packed(CONNECTIVITY, Data::Indices(&cells.nodes)),
            offsets: packed(OFFSETS, Data::Indices(cells.offsets.get(1..).unwrap_or_default())),
            types: packed(TYPES, Data::Bytes(types)),
            parts: packed("type=\"Int32\" Name=\"part\"", Data::Bytes(parts)),
            packers,
        }
    }

    /// A frame made ready for its file: points with z = 0, plane vectors with a third component 0, the fields
    /// named in `include` (empty: all), `part` for each cell, `vtkGhostType` where cells may be gone, and the
    /// time as the field datum `TimeValue`, which ParaView shows. Where elements were made again the field
    /// datum `MeshRevision` says how many times: nodes and cells have other numbers then.
    ///
    /// # Errors
    /// [`VtuError`] when a field or a cell does not fit.
    pub fn file<'a>(&'a self, shown: &'a dyn Shown, include: &[String]) -> Result<VtuFile<'a>, VtuError> {
        let nodes = shown.nodes();
        if let Some(node) = self.node_last.filter(|&node| node as usize >= nodes) {
            return Err(VtuError::NodeMissing { node, nodes });
        }
        let (mut of_nodes, mut of_cells) = (Vec::new(), vec![Content::Packed(&self.parts)]);
        let mut ghosts = None;
        for (field, kind) in shown.kinds().into_iter().enumerate() {
            let is_included = include.is_empty() || include.iter().any(|name| name == kind.name);
            let (arrays, places) = match kind.location {
                Location::Node => (&mut of_nodes, nodes),
                Location::Cell => (&mut of_cells, self.cell_count),
            };
            let written = kind.width() + usize::from(is_plane_vector(kind));
            let column = Column { shown, field: Some(field), places, width: kind.width(), written };
            if is_included || kind.name == "alive" {
                let (found, expected) = (shown.numbers(field), kind.width() * places);
                if found != expected {
                    return Err(VtuError::FieldLength { name: kind.name, found, expected });
                }
            }
            if is_included {
                arrays.push(Content::Plain(Plain { attributes: field_attributes(kind), data: Data::Column(column) }));
            }
            // ParaView does not show cells of this type.
            if kind.name == "alive" {
                let mut alive = Vec::new();
                column.take(0..places, &mut alive);
                let types: Vec<u8> = alive.iter().map(|&alive| if alive == 0.0 { HIDDEN_CELL } else { 0 }).collect();
                ghosts = Some(Content::Plain(plain("type=\"UInt8\" Name=\"vtkGhostType\"", Data::Bytes(types))));
            }
        }
        of_cells.extend(ghosts);
        let sections = vec![
            ("PointData", of_nodes),
            ("CellData", of_cells),
            ("Points", vec![Content::Plain(points(shown))]),
            ("Cells", [&self.connectivity, &self.offsets, &self.types].map(Content::Packed).into()),
        ];
        Ok(VtuFile { time: shown.time(), revision: self.revision, counts: [nodes, self.cell_count], sections, packers: &self.packers })
    }
}

/// Name of the field datum that counts how many times elements were made again.
const REVISION: &str = "MeshRevision";

/// The positions of all nodes: in 2D with z = 0.
fn points(shown: &dyn Shown) -> Plain<'_> {
    plain(POINTS, Data::Column(Column { shown, field: None, places: shown.nodes(), width: shown.dimension(), written: 3 }))
}

/// A file that is ready to be packed and written.
pub struct VtuFile<'a> {
    time: f64,
    revision: u32,
    /// Points and cells.
    counts: [usize; 2],
    sections: Vec<(&'static str, Vec<Content<'a>>)>,
    packers: &'a ScratchPool<Packer>,
}

/// An array of a file: packed before, or still to be.
enum Content<'a> {
    Packed(&'a Array),
    Plain(Plain<'a>),
}

impl Content<'_> {
    fn attributes(&self) -> &str {
        match self {
            Self::Packed(array) => &array.attributes,
            Self::Plain(plain) => &plain.attributes,
        }
    }
}

impl VtuFile<'_> {
    /// Packs the arrays and writes them, some megabytes at a time: a large frame is never there a second
    /// time.
    ///
    /// The data lie in the reverse order of their tags, which the format allows: meshio 5 replaces the
    /// offsets of the tags one by one, in the order of the data, and takes the first tag that has the offset
    /// it looks for. In reverse order a tag whose offset is new, and by chance equal to one still looked for,
    /// is never the first.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(&self, threads: &Threads, out: &mut (impl Write + Seek)) -> io::Result<()> {
        let arrays: Vec<&Content<'_>> = self.sections.iter().rev().flat_map(|(_, arrays)| arrays.iter().rev()).collect();
        let mut places = vec![0; arrays.len()];
        // Where data lie is known when they are there; the head has as much room for any of them.
        let head = self.head(&places);
        out.write_all(head.as_bytes())?;
        let at_once = (AT_ONCE * threads.count()).min(AT_ONCE_MAX);
        let (mut next, mut at) = (0, 0);
        while let Some(&content) = arrays.get(next) {
            let first = match content {
                Content::Plain(plain) => plain,
                Content::Packed(array) => {
                    places[next] = at;
                    at += array.write(out)?;
                    next += 1;
                    continue;
                }
            };
            if first.data.len() > at_once {
                places[next] = at;
                at += write_in_pieces(&first.data, at_once, (self.packers, threads), head.len() + at, out)?;
                next += 1;
                continue;
            }
            let (mut group, mut length) = (vec![first], first.data.len());
            while let Some(Content::Plain(other)) = arrays.get(next + group.len())
                && length + other.data.len() <= at_once
            {
                length += other.data.len();
                group.push(other);
            }
            for array in zlib_blocks(&group, self.packers, threads) {
                places[next] = at;
                at += array.write(out)?;
                next += 1;
            }
        }
        out.write_all(b"\n</AppendedData>\n</VTKFile>\n")?;
        out.seek(SeekFrom::Start(0))?;
        out.write_all(self.head(&places).as_bytes())
    }

    /// All before the data; `places` of the arrays in the order of the data, bytes.
    fn head(&self, places: &[usize]) -> String {
        let (time, [points, cells]) = (self.time, self.counts);
        let revision = match self.revision {
            0 => String::new(),
            number => {
                format!("<DataArray type=\"UInt32\" Name=\"{REVISION}\" NumberOfTuples=\"1\" format=\"ascii\">{number}</DataArray>\n")
            }
        };
        let mut text = format!(
            "<?xml version=\"1.0\"?>\n\
             <VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" \
             compressor=\"vtkZLibDataCompressor\">\n\
             <UnstructuredGrid>\n\
             <FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{time:?}</DataArray>\n{revision}</FieldData>\n\
             <Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\">\n"
        );
        let mut places = places.iter().rev();
        for (name, arrays) in &self.sections {
            // Writing to a string can't fail.
            let _ = writeln!(text, "<{name}>");
            for array in arrays {
                let place = format!("\"{}\"", places.next().unwrap_or(&0));
                let _ = writeln!(text, "<DataArray {} format=\"appended\" offset={place:<PLACE$}/>", array.attributes());
            }
            let _ = writeln!(text, "</{name}>");
        }
        text.push_str("</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");
        text
    }
}

/// Writes a `.vtu` file of obstacles at one time: each line as line cells from point to point, with its index
/// as the cell array `obstacle`. (Poly-lines would be fewer cells, but meshio reads none.)
///
/// # Errors
/// Those of `out`.
pub(crate) fn write_obstacles(lines: &[Vec<[f64; 2]>], time: f64, out: &mut (impl Write + Seek)) -> io::Result<()> {
    let positions: Vec<[f64; 2]> = lines.iter().flatten().copied().collect();
    let (mut connectivity, mut indices) = (Vec::new(), Vec::new());
    let mut first = 0;
    for (index, line) in (0_i32..).zip(lines) {
        for k in first..(first + line.len() as u32).saturating_sub(1).max(first) {
            connectivity.extend([k, k + 1]);
            indices.push(index);
        }
        first += line.len() as u32;
    }
    let cells = Pieces {
        types: vec![VTK_LINE; indices.len()],
        offsets: (1..=indices.len() as u32).map(|k| 2 * k).collect(),
        connectivity,
        indices,
    };
    cells.write(&Frame { time, ..Frame::of(&positions) }, out)
}

/// Writes a `.vtu` file of the obstacles of a model in 3D: each facet as a triangle or a quadrilateral,
/// with the index of its obstacle as the cell array `obstacle`.
///
/// # Errors
/// Those of `out`.
pub(crate) fn write_surfaces(surfaces: &[Surface], time: f64, out: &mut (impl Write + Seek)) -> io::Result<()> {
    let positions: Vec<[f64; 3]> = surfaces.iter().flat_map(|surface| &surface.points).copied().collect();
    let mut cells = Pieces::default();
    let mut first = 0;
    for (index, surface) in (0_i32..).zip(surfaces) {
        for facet in &surface.facets {
            let corners = if facet[2] == facet[3] { &facet[..3] } else { &facet[..] };
            cells.connectivity.extend(corners.iter().map(|corner| first + corner));
            cells.offsets.push(cells.connectivity.len() as u32);
            cells.types.push(if corners.len() == 3 { CellKind::Triangle } else { CellKind::Quadrilateral }.facts().vtk);
            cells.indices.push(index);
        }
        first += surface.points.len() as u32;
    }
    cells.write(&Frame { time, ..Frame::of(&positions) }, out)
}

/// Cells of obstacles.
#[derive(Default)]
struct Pieces {
    connectivity: Vec<u32>,
    offsets: Vec<u32>,
    types: Vec<u8>,
    /// Obstacle of each.
    indices: Vec<i32>,
}

impl Pieces {
    fn write(self, shown: &Frame, out: &mut (impl Write + Seek)) -> io::Result<()> {
        let count = self.indices.len();
        let indices = Data::Bytes(self.indices.iter().flat_map(|index| index.to_le_bytes()).collect());
        let array = |attributes: &str, data| vec![Content::Plain(plain(attributes, data))];
        let mut cells = array(CONNECTIVITY, Data::Indices(&self.connectivity));
        cells.extend(array(OFFSETS, Data::Indices(&self.offsets)));
        cells.extend(array(TYPES, Data::Bytes(self.types)));
        let sections = vec![
            ("PointData", vec![]),
            ("CellData", array("type=\"Int32\" Name=\"obstacle\"", indices)),
            ("Points", vec![Content::Plain(points(shown))]),
            ("Cells", cells),
        ];
        let packers = ScratchPool::default();
        VtuFile { time: shown.time, revision: 0, counts: [shown.nodes(), count], sections, packers: &packers }.write(&Threads::one(), out)
    }
}

/// The text of a `.pvd` file: each frame's time (s) and its path relative to the collection.
#[must_use]
pub fn collection(frames: &[(f64, String)]) -> String {
    let mut text =
        String::from("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n");
    for (time, path) in frames {
        // Writing to a string can't fail.
        let _ = writeln!(text, "<DataSet timestep=\"{time:?}\" part=\"0\" file=\"{path}\"/>");
    }
    text.push_str("</Collection>\n</VTKFile>\n");
    text
}

/// VTK's number of a line of two points.
const VTK_LINE: u8 = 3;

/// VTK's mark of cells that are not shown (`vtkDataSetAttributes::HIDDENCELL`).
const HIDDEN_CELL: u8 = 32;

/// Readers draw arrows only for three components, so plane vectors get a third one.
fn is_plane_vector(kind: &FieldKind) -> bool {
    kind.components == ["x", "y"]
}

fn field_attributes(kind: &FieldKind) -> String {
    let mut attributes = format!("type=\"Float64\" Name=\"{}\"", kind.name);
    let third: &[&str] = if is_plane_vector(kind) { &["z"] } else { &[] };
    let width = kind.width() + third.len();
    if width > 1 {
        // Writing to a string can't fail.
        let _ = write!(attributes, " NumberOfComponents=\"{width}\"");
    }
    for (index, component) in kind.components.iter().chain(third).enumerate() {
        let _ = write!(attributes, " ComponentName{index}=\"{component}\"");
    }
    attributes
}

#[cfg(test)]
mod tests {
    use super::pack::BLOCK;
    use super::*;
    use embate_solver::output::{Field, field_kind, fields_of};
    use std::io::Cursor;
    use std::io::Read;

    /// A quadrilateral and a triangle on its right.
    fn cells() -> Cells {
        Cells {
            nodes: vec![0, 1, 2, 3, 1, 4, 2],
            offsets: vec![0, 4, 7],
            kinds: vec![CellKind::Quadrilateral, CellKind::Triangle],
            parts: vec![0, 1],
            part_names: vec!["left".into(), "right".into()],
            revision: 0,
        }
    }

    fn frame() -> Frame {
        let field = |name: &str, values: Vec<f64>| Field { kind: field_kind(name).unwrap(), values };
        Frame {
            time: 1.25e-5,
            step: 17,
            fields: vec![
                field("velocity", (0..10).map(f64::from).collect()),
                field("stress", vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]),
                field("plastic_strain", vec![0.25, 0.5]),
            ],
            ..Frame::of(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [2.0, 0.5]])
        }
    }

    /// The data of array `name`, found and inflated as a reader does it.
    fn array(file: &[u8], name: &str) -> Vec<u8> {
        let start = file.windows(2).position(|w| w == b"\n_").unwrap() + 2;
        let xml = std::str::from_utf8(&file[..start]).unwrap();
        let tag = xml.lines().find(|l| l.contains(&format!("Name=\"{name}\""))).unwrap();
        let offset: usize = tag.split("offset=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap();
        let data = &file[start + offset..];
        let number = |i: usize| u64::from_le_bytes(data[8 * i..8 * i + 8].try_into().unwrap()) as usize;
        let mut at = 8 * (3 + number(0));
        let mut out = Vec::new();
        for block in 0..number(0) {
            let before = out.len();
            flate2::read::ZlibDecoder::new(&data[at..at + number(3 + block)]).read_to_end(&mut out).unwrap();
            let is_short = block + 1 == number(0) && number(2) != 0;
            assert_eq!(out.len() - before, if is_short { number(2) } else { number(1) });
            at += number(3 + block);
        }
        out
    }

    fn floats(bytes: &[u8]) -> Vec<f64> {
        bytes.chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().unwrap())).collect()
    }

    /// What is written of a frame.
    fn bytes(cells: &Cells, frame: &Frame, include: &[String], threads: usize) -> Result<Vec<u8>, VtuError> {
        let threads = Threads::new(threads);
        let writer = VtuWriter::new(cells, &threads);
        let mut file = Cursor::new(Vec::new());
        writer.file(frame, include)?.write(&threads, &mut file).unwrap();
        Ok(file.into_inner())
    }

    #[test]
    fn arrays_come_back_as_they_went_in() {
        let file = bytes(&cells(), &frame(), &[], 1).unwrap();
        let points = floats(&array(&file, "Points"));
        assert_eq!(points, [0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0., 2., 0.5, 0.]);
        assert_eq!(floats(&array(&file, "velocity"))[..6], [0., 1., 0., 2., 3., 0.]);
        assert_eq!(floats(&array(&file, "stress")), [1., 2., 3., 4., 5., 6., 7., 8.]);
        assert_eq!(floats(&array(&file, "plastic_strain")), [0.25, 0.5]);
        assert_eq!(array(&file, "types"), [9, 5]);
        assert_eq!(array(&file, "part"), [0, 0, 0, 0, 1, 0, 0, 0]);
        let integers: Vec<u8> = array(&file, "offsets").chunks_exact(8).map(|b| b[0]).collect();
        assert_eq!(integers, [4, 7]);
        assert_eq!(array(&file, "connectivity").len(), 7 * 8);
    }

    #[test]
    fn stress_components_have_their_names() {
        let file = bytes(&cells(), &frame(), &[], 1).unwrap();
        let text = String::from_utf8_lossy(&file);
        assert!(text.contains(
            "Name=\"stress\" NumberOfComponents=\"4\" ComponentName0=\"xx\" ComponentName1=\"yy\" \
                ComponentName2=\"zz\" ComponentName3=\"xy\""
        ));
        assert!(text.contains("Name=\"velocity\" NumberOfComponents=\"3\" ComponentName0=\"x\" ComponentName1=\"y\" ComponentName2=\"z\""));
        assert!(text.contains("Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">1.25e-5<"));
    }

    #[test]
    fn only_the_wanted_fields_are_written() {
        let file = bytes(&cells(), &frame(), &["stress".to_string()], 1).unwrap();
        let text = String::from_utf8_lossy(&file);
        assert!(text.contains("\"stress\"") && text.contains("\"part\"") && !text.contains("\"velocity\""));
    }

    #[test]
    fn equal_frames_give_equal_bytes() {
        let once = bytes(&cells(), &frame(), &[], 1).unwrap();
        assert_eq!(once, bytes(&cells(), &frame(), &[], 1).unwrap());
    }

    #[test]
    fn long_and_incompressible_arrays_use_several_blocks() {
        let mut state = 1_u64;
        let mut noise = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            f64::from_bits((state >> 12) | 0x3ff0_0000_0000_0000)
        };
        for nodes in [BLOCK / 24, BLOCK / 8, 40_000] {
            let positions: Vec<[f64; 2]> = (0..nodes).map(|_| [noise(), noise()]).collect();
            let frame = Frame::of(&positions);
            let file = bytes(&Cells::default(), &frame, &[], 1).unwrap();
            let points = floats(&array(&file, "Points"));
            assert!(points.chunks(3).map(|p| [p[0], p[1]]).eq(frame.positions::<2>().iter().copied()));
        }
    }

    #[test]
    fn large_and_small_arrays_in_one_file_come_back_with_their_bytes() {
        // Some arrays are packed together, others are too large for that.
        let count = AT_ONCE / 8 + 1000;
        let numbers = |from: usize, width: usize| -> Vec<f64> { (0..width * count).map(|k| ((k + from) % 1013) as f64).collect() };
        let names = ["von_mises", "stress", "pressure", "plastic_strain"];
        let fields: Vec<Field> = names
            .iter()
            .enumerate()
            .map(|(k, name)| {
                let kind = field_kind(name).unwrap();
                Field { kind, values: numbers(k, kind.width()) }
            })
            .collect();
        let cells = Cells {
            nodes: [0, 1, 2].repeat(count),
            offsets: (0..=count as u32).map(|k| 3 * k).collect(),
            kinds: vec![CellKind::Triangle; count],
            parts: vec![0; count],
            part_names: vec!["a".into()],
            revision: 0,
        };
        let frame = Frame { fields, ..Frame::of(&[[1.0, 2.0]; 3]) };
        let file = bytes(&cells, &frame, &[], 2).unwrap();
        for field in &frame.fields {
            assert!(floats(&array(&file, field.kind.name)) == field.values, "{}", field.kind.name);
        }
        assert_eq!(array(&file, "types"), vec![5; count]);
        assert_eq!(floats(&array(&file, "Points")), [1.0, 2.0, 0.0].repeat(3));
    }

    #[test]
    fn the_bytes_do_not_depend_on_the_number_of_threads() {
        let positions: Vec<[f64; 2]> = (0..60_000).map(f64::from).map(|k| [k.sin(), (0.01 * k).cos()]).collect();
        let velocity = Field { kind: field_kind("velocity").unwrap(), values: positions.as_flattened().to_vec() };
        let frame = Frame { fields: vec![velocity], ..Frame::of(&positions) };
        let file = |threads| bytes(&Cells::default(), &frame, &[], threads).unwrap();
        let alone = file(1);
        assert!(floats(&array(&alone, "velocity")).chunks(3).zip(frame.positions::<2>()).all(|(v, x)| v == [x[0], x[1], 0.0]));
        assert!([2, 3, 8].into_iter().all(|threads| file(threads) == alone));
    }

    #[test]
    fn obstacles_are_lines_with_their_index() {
        let lines = [vec![[0.0, 0.0], [1.0, 0.0], [1.0, 2.0]], vec![[5.0, 5.0]], vec![[3.0, 0.0], [4.0, 0.0]]];
        let mut file = Cursor::new(Vec::new());
        write_obstacles(&lines, 0.25, &mut file).unwrap();
        let file = file.into_inner();
        assert!(String::from_utf8_lossy(&file).contains("NumberOfPoints=\"6\" NumberOfCells=\"3\""));
        assert_eq!(floats(&array(&file, "Points"))[6..12], [1.0, 2.0, 0.0, 5.0, 5.0, 0.0]);
        let numbers = |name: &str| -> Vec<u8> { array(&file, name).chunks_exact(8).map(|b| b[0]).collect() };
        assert_eq!((numbers("connectivity"), numbers("offsets")), (vec![0, 1, 1, 2, 4, 5], vec![2, 4, 6]));
        assert_eq!(array(&file, "types"), [3, 3, 3]);
        assert_eq!(array(&file, "obstacle"), [0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0]);
    }

    /// A hexahedron, a wedge on its side and a tetrahedron on the wedge.
    fn solids() -> (Cells, Frame) {
        let cells = Cells {
            nodes: vec![0, 1, 2, 3, 4, 5, 6, 7, 1, 8, 2, 5, 9, 6, 5, 9, 6, 10],
            offsets: vec![0, 8, 14, 18],
            kinds: vec![CellKind::Hexahedron, CellKind::Wedge, CellKind::Tetrahedron],
            parts: vec![0, 0, 1],
            part_names: vec!["block".into(), "tip".into()],
            revision: 0,
        };
        let places: Vec<[f64; 3]> = (0..11).map(|k| [f64::from(k), 0.5, -f64::from(k)]).collect();
        let field = |name: &str, values: Vec<f64>| Field { kind: fields_of(3).iter().find(|kind| kind.name == name).unwrap(), values };
        let fields = vec![field("velocity", (0..33).map(f64::from).collect()), field("stress", (0..18).map(f64::from).collect())];
        (cells, Frame { fields, ..Frame::of(&places) })
    }

    #[test]
    fn cells_vectors_and_stresses_of_3d_are_written_with_their_names() {
        let (cells, frame) = solids();
        let file = bytes(&cells, &frame, &[], 1).unwrap();
        let text = String::from_utf8_lossy(&file);
        let names = |of: &[&str]| of.iter().enumerate().map(|(k, name)| format!(" ComponentName{k}=\"{name}\"")).collect::<String>();
        assert!(text.contains(&format!("\"stress\" NumberOfComponents=\"6\"{}", names(&["xx", "yy", "zz", "xy", "yz", "zx"]))));
        assert!(text.contains(&format!("\"velocity\" NumberOfComponents=\"3\"{}", names(&["x", "y", "z"]))));
        assert!(floats(&array(&file, "Points")) == frame.coordinates);
        assert_eq!(floats(&array(&file, "velocity")), (0..33).map(f64::from).collect::<Vec<_>>());
        assert_eq!(floats(&array(&file, "stress")), (0..18).map(f64::from).collect::<Vec<_>>());
        assert_eq!(array(&file, "types"), [12, 13, 10]);
        let nodes: Vec<u32> = array(&file, "connectivity").chunks_exact(8).map(|b| u32::from(b[0])).collect();
        assert_eq!(nodes, cells.nodes);
    }

    #[test]
    fn obstacles_of_3d_are_triangles_and_quadrilaterals_with_their_index() {
        let square = [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 2.0, 1.0], [0.0, 2.0, 1.0]].to_vec();
        let surface = |points: &[[f64; 3]], facets: Vec<[u32; 4]>| Surface { points: points.to_vec(), facets, is_endless: false };
        let surfaces =
            [surface(&square, vec![[0, 1, 2, 2], [0, 2, 3, 3]]), surface(&square[..1], vec![]), surface(&square, vec![[0, 1, 2, 3]])];
        let mut file = Cursor::new(Vec::new());
        write_surfaces(&surfaces, 0.25, &mut file).unwrap();
        let file = file.into_inner();
        assert!(String::from_utf8_lossy(&file).contains("NumberOfPoints=\"9\" NumberOfCells=\"3\""));
        assert_eq!(floats(&array(&file, "Points"))[..6], [0.0, 0.0, 1.0, 1.0, 0.0, 1.0]);
        let numbers = |name: &str| -> Vec<u8> { array(&file, name).chunks_exact(8).map(|b| b[0]).collect() };
        assert_eq!((numbers("connectivity"), numbers("offsets")), (vec![0, 1, 2, 0, 2, 3, 5, 6, 7, 8], vec![3, 6, 10]));
        assert_eq!(array(&file, "types"), [5, 5, 9]);
        assert_eq!(array(&file, "obstacle"), [0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0]);
    }

    #[test]
    fn no_cells_are_no_problem() {
        let frame = Frame::default();
        let file = bytes(&Cells::default(), &frame, &[], 1).unwrap();
        assert!(array(&file, "connectivity").is_empty());
    }

    #[test]
    fn a_field_of_the_wrong_length_is_an_error() {
        let mut frame = frame();
        frame.fields[1].values.pop();
        let error = bytes(&cells(), &frame, &[], 1).unwrap_err();
        assert_eq!(error, VtuError::FieldLength { name: "stress", found: 7, expected: 8 });
        frame.fields.clear();
        frame.coordinates.truncate(8);
        assert_eq!(bytes(&cells(), &frame, &[], 1).unwrap_err(), VtuError::NodeMissing { node: 4, nodes: 4 });
    }

    #[test]
    fn a_collection_lists_times_and_files() {
        let text = collection(&[(0.0, "fields/frame-00000.vtu".into()), (1e-5, "fields/frame-00001.vtu".into())]);
        assert!(text.contains("<DataSet timestep=\"0.0\" part=\"0\" file=\"fields/frame-00000.vtu\"/>"));
        assert!(text.contains("<DataSet timestep=\"1e-5\" part=\"0\" file=\"fields/frame-00001.vtu\"/>"));
    }
}
