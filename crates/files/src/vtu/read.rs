//! Reads the `.vtu` files that `vtu` writes: head, mesh, chosen fields, single values.
//!
//! A file is opened for its head; arrays are inflated when they are asked for, block by block, so that a
//! value of one node costs one block. Nothing in a file is believed: sizes are held against the length of the
//! file and against each other before memory is taken. Goes to [`crate::view`] as [`Cells`] and [`Frame`].

use super::{HIDDEN_CELL, VTK_LINE, is_plane_vector};
use crate::plain;
use crate::results::ResultsError;
use embate_solver::output::{CellKind, Cells, Field, FieldKind, Frame, Location, Outline, fields_of};
use flate2::read::ZlibDecoder;
use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Longest head that is read.
const HEAD: u64 = 1 << 20;
/// Bytes of a number of the file's heads of arrays.
const WORD: u64 = 8;

/// A file that is open.
#[derive(Debug)]
pub(crate) struct VtuReader {
    path: PathBuf,
    file: BufReader<File>,
    /// Bytes of the whole.
    size: u64,
    /// Where the data of arrays begin.
    data: u64,
    /// s.
    pub(crate) time: f64,
    /// How many times elements had been made again.
    pub(crate) revision: u32,
    pub(crate) nodes: usize,
    cells: usize,
    arrays: Vec<Tag>,
}

/// What the head says of an array.
#[derive(Clone, Debug, PartialEq)]
struct Tag {
    section: String,
    name: String,
    components: usize,
    /// Bytes of a number.
    width: usize,
    offset: u64,
}

/// Blocks of an array in the file.
struct Blocks {
    /// Bytes of each but the last, inflated.
    size: usize,
    /// Bytes of all, inflated.
    length: usize,
    /// Where each begins in the file, and the end of the last.
    starts: Vec<u64>,
}

impl VtuReader {
    /// Opens a file and reads its head.
    ///
    /// # Errors
    /// [`ResultsError::Unreadable`] where the head is not one of embate's; what the system says.
    pub(crate) fn open(path: &Path) -> Result<Self, ResultsError> {
        let file = plain::open(path).map_err(ResultsError::file("read", path))?;
        let size = file.metadata().map_err(ResultsError::file("read", path))?.len();
        let mut file = BufReader::new(file);
        let (text, data) = head(&mut file, path)?;
        let mut reader = Self { path: path.into(), file, size, data, time: 0.0, revision: 0, nodes: 0, cells: 0, arrays: Vec::new() };
        reader.understand(&text).map_err(|what| reader.unreadable(what))?;
        Ok(reader)
    }

    fn understand(&mut self, text: &str) -> Result<(), String> {
        if !(text.contains("type=\"UnstructuredGrid\"")
            && text.contains("compressor=\"vtkZLibDataCompressor\"")
            && text.contains("header_type=\"UInt64\""))
        {
            return Err("its head is not that of a field file of embate".into());
        }
        let mut section = "";
        for line in text.lines() {
            let tag = line.trim().trim_start_matches('<');
            let name = tag.split([' ', '>', '/']).next().unwrap_or("");
            match name {
                "Piece" => {
                    self.nodes = number(tag, "NumberOfPoints")?;
                    self.cells = number(tag, "NumberOfCells")?;
                }
                "PointData" | "CellData" | "Points" | "Cells" => section = name,
                "DataArray" if attribute(tag, "format") == Some("ascii") => {
                    let text = tag.split('>').nth(1).and_then(|rest| rest.split('<').next()).map(str::trim);
                    if attribute(tag, "Name") == Some(super::REVISION) {
                        self.revision = text.and_then(|text| text.parse().ok()).ok_or("the revision of its mesh can't be read")?;
                        continue;
                    }
                    let value = text.and_then(|text| text.parse().ok());
                    self.time = value.filter(|time: &f64| time.is_finite()).ok_or("its time can't be read")?;
                }
                "DataArray" => self.arrays.push(Tag {
                    section: section.into(),
                    name: attribute(tag, "Name").unwrap_or_default().into(),
                    components: if attribute(tag, "NumberOfComponents").is_some() { number(tag, "NumberOfComponents")? } else { 1 },
                    width: match attribute(tag, "type") {
                        Some("UInt8") => 1,
                        Some("Int32") => 4,
                        Some("Float64" | "Int64") => 8,
                        other => return Err(format!("an array has numbers of the type {}", other.unwrap_or("(none)"))),
                    },
                    offset: number(tag, "offset")? as u64,
                }),
                _ => {}
            }
        }
        // Each has at least a word of its own in the file, but for what packs well: a thousandth.
        let most = self.size.saturating_mul(1100) as usize;
        if self.nodes > most || self.cells > most {
            Err(format!("it names {} nodes and {} cells, more than it can hold", self.nodes, self.cells))
        } else {
            Ok(())
        }
    }

    fn unreadable(&self, what: impl Into<String>) -> ResultsError {
        ResultsError::Unreadable { path: self.path.clone(), what: what.into() }
    }

    fn tag(&self, section: &str, name: &str) -> Option<&Tag> {
        self.arrays.iter().find(|tag| tag.section == section && tag.name == name)
    }

    fn expected(&self, section: &str, name: &str) -> Result<Tag, ResultsError> {
        self.tag(section, name).cloned().ok_or_else(|| self.unreadable(format!("its array \"{name}\" of {section} is missing")))
    }

    fn blocks(&mut self, tag: &Tag) -> Result<Blocks, ResultsError> {
        let at = self.data.saturating_add(tag.offset);
        let [count, size, short] = self.words(tag, at, 3)?[..] else { return Err(self.unreadable("a head of an array is missing")) };
        // A word for each block lies in the file.
        let is_sound = if count == 0 { short == 0 } else { size > 0 && size <= 1 << 28 && short < size };
        if count > self.size / WORD || !is_sound {
            return Err(self.unreadable(format!("the head of its array \"{}\" is damaged", tag.name)));
        }
        let sizes = self.words(tag, at + 3 * WORD, count)?;
        let mut starts = vec![at + (3 + count) * WORD];
        for size in sizes {
            let end = starts[starts.len() - 1].checked_add(size).filter(|&end| end <= self.size);
            starts.push(end.ok_or_else(|| self.unreadable(format!("its array \"{}\" ends beyond the end of the file", tag.name)))?);
        }
        let whole = count.saturating_sub(u64::from(short > 0)).saturating_mul(size);
        let length = usize::try_from(whole.saturating_add(short)).unwrap_or(usize::MAX);
        Ok(Blocks { size: size as usize, length, starts })
    }

    fn words(&mut self, tag: &Tag, at: u64, count: u64) -> Result<Vec<u64>, ResultsError> {
        let end = count.checked_mul(WORD).and_then(|length| at.checked_add(length)).filter(|&end| end <= self.size);
        if end.is_none() {
            return Err(self.unreadable(format!("its array \"{}\" ends beyond the end of the file", tag.name)));
        }
        let bytes = self.bytes(at, (count * WORD) as usize)?;
        Ok(bytes.as_chunks().0.iter().map(|word| u64::from_le_bytes(*word)).collect())
    }

    fn bytes(&mut self, at: u64, length: usize) -> Result<Vec<u8>, ResultsError> {
        let mut bytes = vec![0; length];
        let read = self.file.seek(SeekFrom::Start(at)).and_then(|_| self.file.read_exact(&mut bytes));
        read.map_err(ResultsError::file("read", &self.path))?;
        Ok(bytes)
    }

    /// Bytes of some of the places of an array, inflated.
    fn inflated(&mut self, tag: &Tag, places: usize, wanted: Range<usize>) -> Result<Vec<u8>, ResultsError> {
        let blocks = self.blocks(tag)?;
        let tuple = tag.components.saturating_mul(tag.width);
        if tuple.checked_mul(places) != Some(blocks.length) {
            let message = format!("its array \"{}\" has {} bytes, not those of {places} places", tag.name, blocks.length);
            return Err(self.unreadable(message));
        }
        let (from, to) = (wanted.start * tuple, wanted.end * tuple);
        if from >= to {
            return Ok(Vec::new());
        }
        let mut bytes = Vec::new();
        let first = from / blocks.size;
        for block in first..=(to - 1) / blocks.size {
            let (start, end) = (blocks.starts[block], blocks.starts[block + 1]);
            let packed = self.bytes(start, (end - start) as usize)?;
            let before = bytes.len();
            let expected = blocks.size.min(blocks.length - block * blocks.size);
            let read = ZlibDecoder::new(&packed[..]).take(expected as u64 + 1).read_to_end(&mut bytes);
            if read.is_err() || bytes.len() - before != expected {
                return Err(self.unreadable(format!("block {block} of its array \"{}\" can't be unpacked", tag.name)));
            }
        }
        let begin = first * blocks.size;
        bytes.truncate(to - begin);
        bytes.drain(..from - begin);
        Ok(bytes)
    }

    fn floats(&mut self, tag: &Tag, places: usize, wanted: Range<usize>) -> Result<Vec<f64>, ResultsError> {
        if tag.width != 8 {
            return Err(self.unreadable(format!("its array \"{}\" has no numbers of double precision", tag.name)));
        }
        Ok(self.inflated(tag, places, wanted)?.as_chunks().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect())
    }

    /// Whole numbers below `end`.
    fn indices(&mut self, name: &str, places: usize, end: usize) -> Result<Vec<u32>, ResultsError> {
        let tag = self.expected("Cells", name)?;
        let bytes = self.inflated(&tag, places, 0..places)?;
        let index = |word: &[u8; 8]| u32::try_from(u64::from_le_bytes(*word)).ok().filter(|&index| (index as usize) < end);
        let all: Option<Vec<u32>> = bytes.as_chunks().0.iter().map(index).collect();
        let all = all.filter(|all| all.len() == places);
        all.ok_or_else(|| self.unreadable(format!("a number in \"{name}\" is beyond what the file holds")))
    }

    /// The mesh; its parts have no names.
    pub(crate) fn cells(&mut self) -> Result<Cells, ResultsError> {
        let connectivity = self.expected("Cells", "connectivity")?;
        let corners = self.blocks(&connectivity)?.length / 8;
        let nodes = self.indices("connectivity", corners, self.nodes)?;
        let ends = self.indices("offsets", self.cells, corners + 1)?;
        let tag = self.expected("Cells", "types")?;
        let types = self.inflated(&tag, self.cells, 0..self.cells)?;
        let offsets: Vec<u32> = std::iter::once(0).chain(ends).collect();
        let kinds: Option<Vec<CellKind>> = types.iter().map(|&kind| CellKind::of_vtk(kind)).collect();
        let is_sound = offsets.is_sorted() && offsets.last().is_some_and(|&end| end as usize == corners);
        let kinds = kinds.filter(|_| is_sound).ok_or_else(|| self.unreadable("its cells are damaged"))?;
        let (parts, revision) = (self.numbers_of_cells("part")?, self.revision);
        Ok(Cells { nodes, offsets, kinds, parts, part_names: Vec::new(), revision })
    }

    /// Whole numbers of cells, 32 bits.
    fn numbers_of_cells(&mut self, name: &str) -> Result<Vec<u32>, ResultsError> {
        let tag = self.expected("CellData", name)?;
        if tag.width != 4 {
            return Err(self.unreadable(format!("its array \"{name}\" has no whole numbers")));
        }
        Ok(self.inflated(&tag, self.cells, 0..self.cells)?.as_chunks().0.iter().map(|bytes| u32::from_le_bytes(*bytes)).collect())
    }

    /// Whether the file has so many nodes and cells.
    ///
    /// # Errors
    /// [`ResultsError::Unreadable`] if not.
    pub(crate) fn has(&self, nodes: usize, cells: usize) -> Result<(), ResultsError> {
        if (self.nodes, self.cells) == (nodes, cells) {
            return Ok(());
        }
        Err(self.unreadable(format!("it has {} nodes and {} cells, the first frame has {nodes} and {cells}", self.nodes, self.cells)))
    }

    /// Cells that were eroded, ascending.
    pub(crate) fn gone(&mut self) -> Result<Vec<u32>, ResultsError> {
        let Some(tag) = self.tag("CellData", "vtkGhostType").cloned() else { return Ok(Vec::new()) };
        let types = self.inflated(&tag, self.cells, 0..self.cells)?;
        Ok((0..).zip(types).filter(|(_, kind)| *kind == HIDDEN_CELL).map(|(cell, _)| cell).collect())
    }

    /// Fields that the file holds, of a model of this dimension.
    pub(crate) fn kinds(&self, dimension: usize) -> Vec<&'static FieldKind> {
        fields_of(dimension).iter().filter(|kind| self.tag_of(kind).is_some()).collect()
    }

    fn tag_of(&self, kind: &FieldKind) -> Option<&Tag> {
        let section = if kind.location == Location::Node { "PointData" } else { "CellData" };
        self.tag(section, kind.name).filter(|tag| tag.components == kind.width() + usize::from(is_plane_vector(kind)))
    }

    /// Components of a position that its fields have: 2 in 2D, 3 in 3D.
    pub(crate) fn dimension(&self, cells: &Cells) -> usize {
        let has_six = self.tag("CellData", "stress").is_some_and(|tag| tag.components == 6);
        if has_six || cells.kinds.iter().any(|kind| kind.dimension() == 3) { 3 } else { 2 }
    }

    /// Positions and some fields; those that the file has not are left out. Its step is not known.
    pub(crate) fn frame(&mut self, dimension: usize, fields: &[&'static FieldKind]) -> Result<Frame, ResultsError> {
        let tag = self.expected("Points", "Points")?;
        if tag.components != 3 {
            return Err(self.unreadable("its points have no three coordinates"));
        }
        let points = self.floats(&tag, self.nodes, 0..self.nodes)?;
        let mut frame = Frame { time: self.time, dimension, coordinates: first_of(points, dimension, 3), ..Frame::default() };
        for kind in fields {
            if self.tag_of(kind).is_some() {
                let places = if kind.location == Location::Node { self.nodes } else { self.cells };
                frame.fields.push(Field { kind, values: self.values(kind, 0..places)? });
            }
        }
        Ok(frame)
    }

    /// Position of a node, m; that of a node that is not there is not a number.
    pub(crate) fn place(&mut self, node: usize) -> Result<[f64; 3], ResultsError> {
        let tag = self.expected("Points", "Points")?;
        if tag.components != 3 || node >= self.nodes {
            return Ok([f64::NAN; 3]);
        }
        let own = self.floats(&tag, self.nodes, node..node + 1)?;
        Ok(std::array::from_fn(|d| own.get(d).copied().unwrap_or(f64::NAN)))
    }

    /// Values of a field at some nodes or cells; empty where it is not there, or no such place.
    pub(crate) fn values(&mut self, kind: &FieldKind, wanted: Range<usize>) -> Result<Vec<f64>, ResultsError> {
        let places = if kind.location == Location::Node { self.nodes } else { self.cells };
        let Some(tag) = self.tag_of(kind).cloned() else { return Ok(Vec::new()) };
        if wanted.end > places {
            return Ok(Vec::new());
        }
        Ok(first_of(self.floats(&tag, places, wanted)?, kind.width(), tag.components))
    }

    /// Obstacles of a file of obstacles, by their numbers: lines in 2D, in 3D facets.
    pub(crate) fn outlines(&mut self) -> Result<Vec<(usize, Outline)>, ResultsError> {
        let frame = self.frame(3, &[])?;
        let numbers = {
            // The file has no parts.
            let connectivity = self.expected("Cells", "connectivity")?;
            let corners = self.blocks(&connectivity)?.length / 8;
            (self.indices("connectivity", corners, self.nodes)?, self.indices("offsets", self.cells, corners + 1)?)
        };
        let (nodes, ends) = numbers;
        let tag = self.expected("Cells", "types")?;
        let types = self.inflated(&tag, self.cells, 0..self.cells)?;
        let owners = self.numbers_of_cells("obstacle")?;
        let mut outlines: Vec<(usize, Outline)> = Vec::new();
        let mut from = 0;
        for ((&end, &owner), &kind) in ends.iter().zip(&owners).zip(&types) {
            let Some(corners) = nodes.get(from..end as usize) else { return Err(self.unreadable("its cells are damaged")) };
            from = end as usize;
            if outlines.last().is_none_or(|(number, _)| *number != owner as usize) {
                outlines.push((owner as usize, Outline::default()));
            }
            let outline = &mut outlines.last_mut().expect("one was put in").1;
            let place = |corner: &u32| frame.place(*corner as usize);
            match *corners {
                [a, b] if kind == VTK_LINE => {
                    if outline.points.is_empty() {
                        outline.points.push(place(&a));
                    }
                    outline.points.push(place(&b));
                }
                [_, _, _] | [_, _, _, _] => {
                    let first = outline.points.len() as u32;
                    outline.points.extend(corners.iter().map(place));
                    outline.facets.push([0, 1, 2, corners.len() as u32 - 1].map(|corner| first + corner));
                }
                _ => return Err(self.unreadable("its cells are damaged")),
            }
        }
        Ok(outlines)
    }
}

/// The first `kept` of every `all` numbers.
fn first_of(numbers: Vec<f64>, kept: usize, all: usize) -> Vec<f64> {
    if kept == all { numbers } else { numbers.chunks_exact(all).flat_map(|tuple| &tuple[..kept]).copied().collect() }
}

/// All before the data, and where they begin.
fn head(file: &mut BufReader<File>, path: &Path) -> Result<(String, u64), ResultsError> {
    let mut bytes = Vec::new();
    file.take(HEAD).read_to_end(&mut bytes).map_err(ResultsError::file("read", path))?;
    const MARK: &[u8] = b"<AppendedData encoding=\"raw\">\n_";
    let end = bytes.windows(MARK.len()).position(|window| window == MARK);
    let text = end.and_then(|end| String::from_utf8(bytes[..end].to_vec()).ok());
    let unreadable = || ResultsError::Unreadable { path: path.into(), what: "its head is not that of a field file of embate".into() };
    let (text, end) = text.zip(end).ok_or_else(unreadable)?;
    Ok((text, (end + MARK.len()) as u64))
}

fn attribute<'a>(tag: &'a str, name: &str) -> Option<&'a str> {
    let from = tag.find(&format!(" {name}=\""))? + name.len() + 3;
    tag[from..].split('"').next()
}

fn number(tag: &str, name: &str) -> Result<usize, String> {
    attribute(tag, name).and_then(|text| text.parse().ok()).ok_or_else(|| format!("{name} is not a number"))
}
