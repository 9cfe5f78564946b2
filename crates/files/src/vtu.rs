//! VTK XML files of unstructured grids (`.vtu`) and the collection that puts them on a time axis (`.pvd`).
//!
//! A [`Frame`] and its [`Cells`] become the bytes of one file: a short XML head, then all arrays as appended raw binary,
//! little-endian, each in zlib blocks with 64-bit headers. What never changes during a run (connectivity, cell types,
//! parts) is encoded once by [`VtuWriter::new`]. Blocks have a fixed size and are packed by several threads at once. Equal input gives equal bytes
//! on every machine, for any number of threads. The bytes go to
//! [`crate::results`], ParaView and `tests/read_back.py` read them. `obstacles` makes a file of obstacles in the same way.
//! Source: VTK file formats, "XML formats", `vtkZLibDataCompressor`.

use crate::threads::Threads;
use embate_solver::output::{CellKind, Cells, Field, FieldKind, Frame, Location};
use flate2::Compression;
use flate2::write::ZlibEncoder;
use std::fmt::Write as _;
use std::io::Write as _;
use std::ops::Range;
use thiserror::Error;

/// Bytes of one block before compression.
const BLOCK: usize = 1 << 17;
/// Below so many bytes threads cost more than they bring.
const SERIAL: usize = 1 << 20;

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

/// An array of the file: its XML attributes and its bytes in zlib blocks.
#[derive(Clone, Debug)]
struct Array {
    attributes: String,
    bytes: Vec<u8>,
}

/// An array before it is packed.
struct Plain<'a> {
    attributes: String,
    data: Data<'a>,
}

/// The numbers of an array; they become bytes block by block.
enum Data<'a> {
    Bytes(Vec<u8>),
    /// Whole numbers, written with 64 bits.
    Indices(&'a [u32]),
    Numbers(&'a [f64]),
    /// `x y x y ...`, written as `x y 0 x y 0 ...`.
    PlaneVectors(&'a [f64]),
}

impl Data<'_> {
    /// Bytes in the file before compression.
    fn len(&self) -> usize {
        match self {
            Self::Bytes(bytes) => bytes.len(),
            Self::Indices(indices) => 8 * indices.len(),
            Self::Numbers(values) => 8 * values.len(),
            Self::PlaneVectors(values) => 24 * (values.len() / 2),
        }
    }

    /// The bytes in a range of whole numbers, little-endian.
    fn fill(&self, range: Range<usize>, bytes: &mut Vec<u8>) {
        bytes.clear();
        match self {
            Self::Bytes(all) => bytes.extend_from_slice(&all[range]),
            Self::Indices(all) => bytes.extend(all[range.start / 8..range.end / 8].iter().flat_map(|&i| i64::from(i).to_le_bytes())),
            Self::Numbers(values) => bytes.extend(values[range.start / 8..range.end / 8].iter().flat_map(|v| v.to_le_bytes())),
            Self::PlaneVectors(values) => {
                let component = |k: usize| if k % 3 == 2 { 0.0 } else { values[2 * (k / 3) + k % 3] };
                bytes.extend((range.start / 8..range.end / 8).map(component).flat_map(f64::to_le_bytes));
            }
        }
    }
}

/// Writes the frames of one run.
#[derive(Clone, Debug)]
pub struct VtuWriter {
    cell_count: usize,
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
        let array = |attributes: &str, data| Plain { attributes: attributes.into(), data };
        let types = cells.kinds.iter().map(|&kind| vtk_cell_type(kind)).collect();
        let parts = cells.parts.iter().flat_map(|&p| p.to_le_bytes()).collect();
        let plain = vec![
            array("type=\"Int64\" Name=\"connectivity\"", Data::Indices(&cells.nodes)),
            array("type=\"Int64\" Name=\"offsets\"", Data::Indices(cells.offsets.get(1..).unwrap_or_default())),
            array("type=\"UInt8\" Name=\"types\"", Data::Bytes(types)),
            array("type=\"Int32\" Name=\"part\"", Data::Bytes(parts)),
        ];
        let mut arrays = zlib_blocks(plain, threads).into_iter();
        let mut next = || arrays.next().expect("there are as many arrays as were put in");
        Self {
            cell_count: cells.len(),
            node_last: cells.nodes.iter().copied().max(),
            connectivity: next(),
            offsets: next(),
            types: next(),
            parts: next(),
        }
    }

    /// The bytes of a `.vtu` file: points with z = 0, plane vectors with a third component 0, the fields named in `include`
    /// (empty: all), `part` for each cell, `vtkGhostType` where cells may be gone, and the time as the field datum `TimeValue`, which ParaView shows.
    ///
    /// # Errors
    /// [`VtuError`] when a field or a cell does not fit.
    pub fn bytes(&self, frame: &Frame<2>, include: &[String], threads: &Threads) -> Result<Vec<u8>, VtuError> {
        let nodes = frame.positions.len();
        if let Some(node) = self.node_last.filter(|&node| node as usize >= nodes) {
            return Err(VtuError::NodeMissing { node, nodes });
        }
        let mut plain = vec![Plain {
            attributes: "type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"".into(),
            data: Data::PlaneVectors(frame.positions.as_flattened()),
        }];
        let included = || frame.fields.iter().filter(|f| include.is_empty() || include.iter().any(|name| name == f.kind.name));
        for field in included().filter(|field| field.kind.location == Location::Node) {
            plain.push(field_array(field, nodes)?);
        }
        let first_of_cells = plain.len();
        for field in included().filter(|field| field.kind.location == Location::Cell) {
            plain.push(field_array(field, self.cell_count)?);
        }
        // ParaView does not show cells of this type.
        if let Some(alive) = frame.fields.iter().find(|field| field.kind.name == "alive") {
            let types: Vec<u8> = alive.values.iter().map(|&alive| if alive == 0.0 { HIDDEN_CELL } else { 0 }).collect();
            plain.push(Plain { attributes: "type=\"UInt8\" Name=\"vtkGhostType\"".into(), data: Data::Bytes(types) });
        }
        let arrays = zlib_blocks(plain, threads);
        let sections = [
            ("PointData", arrays[1..first_of_cells].iter().collect()),
            ("CellData", std::iter::once(&self.parts).chain(&arrays[first_of_cells..]).collect()),
            ("Points", vec![&arrays[0]]),
            ("Cells", vec![&self.connectivity, &self.offsets, &self.types]),
        ];
        Ok(grid_file(frame.time, [nodes, self.cell_count], &sections))
    }
}

/// The bytes of a `.vtu` file of obstacles at one time: each line as line cells from point to point, with its index as the cell array `obstacle`.
/// (Poly-lines would be fewer cells, but meshio reads none.)
pub(crate) fn obstacles(lines: &[Vec<[f64; 2]>], time: f64) -> Vec<u8> {
    let array = |attributes: &str, bytes: Vec<u8>| Array { attributes: attributes.into(), bytes: packed(bytes) };
    let positions: Vec<f64> = lines.iter().flatten().flatten().copied().collect();
    let (mut connectivity, mut indices) = (Vec::new(), Vec::new());
    let mut first = 0;
    for (index, line) in lines.iter().enumerate() {
        for k in first..(first + line.len() as i64 - 1).max(first) {
            connectivity.extend([k, k + 1]);
            indices.push(index as i32);
        }
        first += line.len() as i64;
    }
    let count = indices.len();
    let bytes_of = |numbers: &mut dyn Iterator<Item = i64>| -> Vec<u8> { numbers.flat_map(i64::to_le_bytes).collect() };
    let indices: Vec<u8> = indices.iter().flat_map(|index| index.to_le_bytes()).collect();
    let indices = array("type=\"Int32\" Name=\"obstacle\"", indices);
    let data = Data::PlaneVectors(&positions);
    let mut in_space = Vec::new();
    data.fill(0..data.len(), &mut in_space);
    let points = array("type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"", in_space);
    let connectivity = array("type=\"Int64\" Name=\"connectivity\"", bytes_of(&mut connectivity.into_iter()));
    let offsets = array("type=\"Int64\" Name=\"offsets\"", bytes_of(&mut (1..=count as i64).map(|k| 2 * k)));
    let types = array("type=\"UInt8\" Name=\"types\"", vec![VTK_LINE; count]);
    let sections =
        [("PointData", vec![]), ("CellData", vec![&indices]), ("Points", vec![&points]), ("Cells", vec![&connectivity, &offsets, &types])];
    grid_file(time, [first as usize, count], &sections)
}

/// A whole file from its arrays; `counts`: points and cells.
fn grid_file(time: f64, counts: [usize; 2], sections: &[(&str, Vec<&Array>)]) -> Vec<u8> {
    let (xml, appended) = append_sections(sections);
    let [points, cells] = counts;
    let mut file = format!(
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" \
         compressor=\"vtkZLibDataCompressor\">\n\
         <UnstructuredGrid>\n\
         <FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{time:?}</DataArray>\n</FieldData>\n\
         <Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\">\n{xml}</Piece>\n</UnstructuredGrid>\n\
         <AppendedData encoding=\"raw\">\n_"
    )
    .into_bytes();
    file.extend_from_slice(&appended);
    file.extend_from_slice(b"\n</AppendedData>\n</VTKFile>\n");
    file
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

/// The XML of all sections and the binary data to which its offsets point.
///
/// The data lie in the reverse order of their tags, which the format allows: meshio 5 replaces the offsets of the tags one by
/// one, in the order of the data, and takes the first tag that has the offset it looks for. In reverse order a tag whose offset
/// is new, and by chance equal to one still looked for, is never the first.
fn append_sections(sections: &[(&str, Vec<&Array>)]) -> (String, Vec<u8>) {
    let mut tags = Vec::new();
    let mut appended = Vec::new();
    for (name, arrays) in sections.iter().rev() {
        tags.push(format!("</{name}>\n"));
        for array in arrays.iter().rev() {
            tags.push(format!("<DataArray {} format=\"appended\" offset=\"{}\"/>\n", array.attributes, appended.len()));
            appended.extend_from_slice(&array.bytes);
        }
        tags.push(format!("<{name}>\n"));
    }
    tags.reverse();
    (tags.concat(), appended)
}

/// VTK's number of a line of two points.
const VTK_LINE: u8 = 3;

/// VTK's mark of cells that are not shown (`vtkDataSetAttributes::HIDDENCELL`).
const HIDDEN_CELL: u8 = 32;

/// VTK's number of a cell shape.
fn vtk_cell_type(kind: CellKind) -> u8 {
    match kind {
        CellKind::Line => 3,
        CellKind::Triangle => 5,
        CellKind::Quadrilateral => 9,
    }
}

fn field_array(field: &Field, count: usize) -> Result<Plain<'_>, VtuError> {
    let kind = field.kind;
    let expected = kind.width() * count;
    if field.values.len() != expected {
        return Err(VtuError::FieldLength { name: kind.name, found: field.values.len(), expected });
    }
    let data = if is_plane_vector(kind) { Data::PlaneVectors(&field.values) } else { Data::Numbers(&field.values) };
    Ok(Plain { attributes: field_attributes(kind), data })
}

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

/// An array by itself, packed by the caller's thread.
fn packed(bytes: Vec<u8>) -> Vec<u8> {
    let plain = Plain { attributes: String::new(), data: Data::Bytes(bytes) };
    zlib_blocks(vec![plain], &Threads::one()).swap_remove(0).bytes
}

/// Arrays as VTK's compressed arrays: number of blocks, block size, size of the last block when it is shorter (else 0),
/// the compressed size of each block (all 64 bits), then the zlib streams. Fast compression: what slower ones save is little, because digits are noise.
fn zlib_blocks(arrays: Vec<Plain<'_>>, threads: &Threads) -> Vec<Array> {
    let blocks_of = |data: &Data<'_>| data.len().div_ceil(BLOCK);
    let mut pieces: Vec<(&Data<'_>, Range<usize>)> = Vec::new();
    for data in arrays.iter().map(|array| &array.data) {
        pieces.extend((0..blocks_of(data)).map(|k| (data, k * BLOCK..((k + 1) * BLOCK).min(data.len()))));
    }
    let work = |(encoder, bytes): &mut (ZlibEncoder<Vec<u8>>, Vec<u8>), (data, range): &(&Data<'_>, Range<usize>)| {
        data.fill(range.clone(), bytes);
        let mut stream = encoder.write_all(bytes).and_then(|()| encoder.reset(Vec::new())).expect("a vector takes every byte");
        // Streams of a whole frame wait for each other.
        stream.shrink_to_fit();
        stream
    };
    let scratch = || (ZlibEncoder::new(Vec::new(), Compression::fast()), Vec::with_capacity(BLOCK));
    let is_small = arrays.iter().map(|array| array.data.len()).sum::<usize>() < SERIAL;
    let streams = if is_small { Threads::one().map(&pieces, scratch, work) } else { threads.map(&pieces, scratch, work) };
    let mut streams = streams.into_iter();
    let array = |Plain { attributes, data }: Plain<'_>| {
        let own: Vec<Vec<u8>> = streams.by_ref().take(blocks_of(&data)).collect();
        let mut bytes = Vec::with_capacity(8 * (3 + own.len()) + own.iter().map(Vec::len).sum::<usize>());
        let head = [own.len(), BLOCK, data.len() % BLOCK].into_iter().chain(own.iter().map(Vec::len));
        bytes.extend(head.flat_map(|number| (number as u64).to_le_bytes()));
        own.iter().for_each(|stream| bytes.extend_from_slice(stream));
        Array { attributes, bytes }
    };
    arrays.into_iter().map(array).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use embate_solver::output::field_kind;
    use std::io::Read;

    /// A quadrilateral and a triangle on its right.
    fn cells() -> Cells {
        Cells {
            nodes: vec![0, 1, 2, 3, 1, 4, 2],
            offsets: vec![0, 4, 7],
            kinds: vec![CellKind::Quadrilateral, CellKind::Triangle],
            parts: vec![0, 1],
            part_names: vec!["left".into(), "right".into()],
        }
    }

    fn frame() -> Frame<2> {
        let field = |name: &str, values: Vec<f64>| Field { kind: field_kind(name).unwrap(), values };
        Frame {
            time: 1.25e-5,
            step: 17,
            positions: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [2.0, 0.5]],
            fields: vec![
                field("velocity", (0..10).map(f64::from).collect()),
                field("stress", vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]),
                field("plastic_strain", vec![0.25, 0.5]),
            ],
            outlines: vec![],
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

    #[test]
    fn arrays_come_back_as_they_went_in() {
        let file = VtuWriter::new(&cells(), &Threads::one()).bytes(&frame(), &[], &Threads::one()).unwrap();
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
        let file = VtuWriter::new(&cells(), &Threads::one()).bytes(&frame(), &[], &Threads::one()).unwrap();
        let text = String::from_utf8_lossy(&file);
        assert!(text.contains(
            "Name=\"stress\" NumberOfComponents=\"4\" ComponentName0=\"xx\" ComponentName1=\"yy\" ComponentName2=\"zz\" ComponentName3=\"xy\""
        ));
        assert!(text.contains("Name=\"velocity\" NumberOfComponents=\"3\" ComponentName0=\"x\" ComponentName1=\"y\" ComponentName2=\"z\""));
        assert!(text.contains("Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">1.25e-5<"));
    }

    #[test]
    fn only_the_wanted_fields_are_written() {
        let file = VtuWriter::new(&cells(), &Threads::one()).bytes(&frame(), &["stress".to_string()], &Threads::one()).unwrap();
        let text = String::from_utf8_lossy(&file);
        assert!(text.contains("\"stress\"") && text.contains("\"part\"") && !text.contains("\"velocity\""));
    }

    #[test]
    fn equal_frames_give_equal_bytes() {
        let once = VtuWriter::new(&cells(), &Threads::one()).bytes(&frame(), &[], &Threads::one()).unwrap();
        assert_eq!(once, VtuWriter::new(&cells(), &Threads::one()).bytes(&frame(), &[], &Threads::one()).unwrap());
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
            let frame = Frame { time: 0.0, step: 0, positions, fields: vec![], outlines: vec![] };
            let file = VtuWriter::new(&Cells::default(), &Threads::one()).bytes(&frame, &[], &Threads::one()).unwrap();
            let points = floats(&array(&file, "Points"));
            assert!(points.chunks(3).map(|p| [p[0], p[1]]).eq(frame.positions.iter().copied()));
        }
    }

    #[test]
    fn the_bytes_do_not_depend_on_the_number_of_threads() {
        let positions: Vec<[f64; 2]> = (0..60_000).map(f64::from).map(|k| [k.sin(), (0.01 * k).cos()]).collect();
        let velocity = Field { kind: field_kind("velocity").unwrap(), values: positions.as_flattened().to_vec() };
        let frame = Frame { time: 0.0, step: 0, positions, fields: vec![velocity], outlines: vec![] };
        let file = |threads| VtuWriter::new(&Cells::default(), &Threads::new(threads)).bytes(&frame, &[], &Threads::new(threads)).unwrap();
        let alone = file(1);
        assert!(floats(&array(&alone, "velocity")).chunks(3).zip(&frame.positions).all(|(v, x)| v == [x[0], x[1], 0.0]));
        assert!([2, 3, 8].into_iter().all(|threads| file(threads) == alone));
    }

    #[test]
    fn obstacles_are_lines_with_their_index() {
        let lines = [vec![[0.0, 0.0], [1.0, 0.0], [1.0, 2.0]], vec![[5.0, 5.0]], vec![[3.0, 0.0], [4.0, 0.0]]];
        let file = obstacles(&lines, 0.25);
        assert!(String::from_utf8_lossy(&file).contains("NumberOfPoints=\"6\" NumberOfCells=\"3\""));
        assert_eq!(floats(&array(&file, "Points"))[6..12], [1.0, 2.0, 0.0, 5.0, 5.0, 0.0]);
        let numbers = |name: &str| -> Vec<u8> { array(&file, name).chunks_exact(8).map(|b| b[0]).collect() };
        assert_eq!((numbers("connectivity"), numbers("offsets")), (vec![0, 1, 1, 2, 4, 5], vec![2, 4, 6]));
        assert_eq!(array(&file, "types"), [3, 3, 3]);
        assert_eq!(array(&file, "obstacle"), [0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0]);
    }

    #[test]
    fn no_cells_are_no_problem() {
        let frame = Frame { time: 0.0, step: 0, positions: vec![], fields: vec![], outlines: vec![] };
        let file = VtuWriter::new(&Cells::default(), &Threads::one()).bytes(&frame, &[], &Threads::one()).unwrap();
        assert!(array(&file, "connectivity").is_empty());
    }

    #[test]
    fn a_field_of_the_wrong_length_is_an_error() {
        let mut frame = frame();
        frame.fields[1].values.pop();
        let error = VtuWriter::new(&cells(), &Threads::one()).bytes(&frame, &[], &Threads::one()).unwrap_err();
        assert_eq!(error, VtuError::FieldLength { name: "stress", found: 7, expected: 8 });
        frame.fields.clear();
        frame.positions.truncate(4);
        assert_eq!(
            VtuWriter::new(&cells(), &Threads::one()).bytes(&frame, &[], &Threads::one()).unwrap_err(),
            VtuError::NodeMissing { node: 4, nodes: 4 }
        );
    }

    #[test]
    fn a_collection_lists_times_and_files() {
        let text = collection(&[(0.0, "fields/frame-00000.vtu".into()), (1e-5, "fields/frame-00001.vtu".into())]);
        assert!(text.contains("<DataSet timestep=\"0.0\" part=\"0\" file=\"fields/frame-00000.vtu\"/>"));
        assert!(text.contains("<DataSet timestep=\"1e-5\" part=\"0\" file=\"fields/frame-00001.vtu\"/>"));
    }
}
