//! Arrays of a VTK XML file, packed: numbers become little-endian bytes block by block, and blocks zlib
//! streams.
//!
//! Arrays come from `vtu`; blocks have a fixed size and are packed by several threads at once, each from its
//! numbers alone, so that equal arrays give equal bytes. Numbers of nodes and cells are made block by block
//! ([`Shown`]): neither they nor the streams of a large array are ever there as a whole.

use crate::threads::{ScratchPool, Threads};
use embate_solver::output::Shown;
use flate2::{Compress, Compression, FlushCompress, Status};
use std::io::{self, Seek, SeekFrom, Write};
use std::ops::Range;

/// Bytes of one block before compression.
pub(super) const BLOCK: usize = 1 << 17;
/// Below so many bytes threads cost more than they bring.
const SERIAL: usize = 1 << 20;

/// An array of the file: its XML attributes, and its head and zlib blocks.
pub(super) struct Array {
    pub(super) attributes: String,
    head: Vec<u8>,
    blocks: Vec<Vec<u8>>,
}

impl Array {
    /// Writes it; the number of bytes.
    pub(super) fn write(&self, out: &mut impl Write) -> io::Result<usize> {
        let pieces = || std::iter::once(&self.head).chain(&self.blocks);
        pieces().try_for_each(|piece| out.write_all(piece))?;
        Ok(pieces().map(Vec::len).sum())
    }
}

/// An array before it is packed.
pub(super) struct Plain<'a> {
    pub(super) attributes: String,
    pub(super) data: Data<'a>,
}

pub(super) fn plain<'a>(attributes: &str, data: Data<'a>) -> Plain<'a> {
    Plain { attributes: attributes.into(), data }
}

/// The numbers of an array; they become bytes block by block.
pub(super) enum Data<'a> {
    Bytes(Vec<u8>),
    /// Whole numbers, written with 64 bits.
    Indices(&'a [u32]),
    Column(Column<'a>),
}

/// Numbers of nodes or cells, taken from what is shown.
#[derive(Clone, Copy)]
pub(super) struct Column<'a> {
    pub(super) shown: &'a dyn Shown,
    /// Its place among the fields; `None`: the positions.
    pub(super) field: Option<usize>,
    /// Nodes or cells.
    pub(super) places: usize,
    /// Numbers of each.
    pub(super) width: usize,
    /// Numbers of each in the file: plane vectors `x y x y ...` are written as `x y 0 x y 0 ...`.
    pub(super) written: usize,
}

impl Column<'_> {
    /// Puts the numbers of some places into `numbers`.
    pub(super) fn take(&self, places: Range<usize>, numbers: &mut Vec<f64>) {
        match self.field {
            Some(field) => self.shown.values(field, places, numbers),
            None => self.shown.coordinates(places, numbers),
        }
    }

    /// The bytes of a range of the numbers as they are written; `numbers` is room.
    fn fill(&self, values: Range<usize>, numbers: &mut Vec<f64>, bytes: &mut [[u8; 8]]) {
        let Self { width, written, .. } = *self;
        let first = values.start / written;
        self.take(first..values.end.div_ceil(written), numbers);
        // A block may begin within a vector.
        let at = values.start - first * written;
        if width == written {
            bytes.iter_mut().zip(&numbers[at..]).for_each(|(place, value)| *place = value.to_le_bytes());
            return;
        }
        let (mut from, mut at) = (0, at);
        for place in bytes {
            *place = if at < width { numbers[from + at] } else { 0.0 }.to_le_bytes();
            at += 1;
            if at == written {
                (from, at) = (from + width, 0);
            }
        }
    }
}

impl Data<'_> {
    /// Bytes in the file before compression.
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Bytes(bytes) => bytes.len(),
            Self::Indices(indices) => 8 * indices.len(),
            Self::Column(column) => 8 * column.written * column.places,
        }
    }

    /// The bytes in a range of whole numbers, little-endian; `numbers` is room.
    pub(super) fn fill(&self, range: Range<usize>, numbers: &mut Vec<f64>, bytes: &mut Vec<u8>) {
        let values = range.start / 8..range.end / 8;
        bytes.resize(range.len(), 0);
        match self {
            Self::Bytes(all) => bytes.copy_from_slice(&all[range]),
            Self::Indices(all) => {
                let (places, _) = bytes.as_chunks_mut();
                places.iter_mut().zip(&all[values]).for_each(|(place, &index)| *place = i64::from(index).to_le_bytes());
            }
            Self::Column(column) => column.fill(values, numbers, bytes.as_chunks_mut().0),
        }
    }
}

/// What a thread packs blocks with.
pub(super) struct Packer {
    zlib: Compress,
    numbers: Vec<f64>,
    bytes: Vec<u8>,
    stream: Vec<u8>,
}

impl Packer {
    fn new() -> Self {
        Self { zlib: Compress::new(Compression::fast(), true), numbers: Vec::new(), bytes: Vec::new(), stream: Vec::new() }
    }

    /// A range of an array as a zlib stream.
    fn packed(&mut self, data: &Data<'_>, range: Range<usize>) -> Vec<u8> {
        data.fill(range, &mut self.numbers, &mut self.bytes);
        self.zlib.reset();
        self.stream.clear();
        loop {
            // What does not shrink grows by little.
            self.stream.reserve(self.bytes.len() + self.bytes.len() / 4 + 64);
            let read = usize::try_from(self.zlib.total_in()).expect("a block fits into memory");
            let status = self.zlib.compress_vec(&self.bytes[read..], &mut self.stream, FlushCompress::Finish);
            if status.expect("the parameters are valid") == Status::StreamEnd {
                return self.stream.clone();
            }
        }
    }
}

/// The blocks of an array, by their bytes before compression.
fn blocks_of(data: &Data<'_>) -> impl Iterator<Item = Range<usize>> + use<> {
    let length = data.len();
    (0..length.div_ceil(BLOCK)).map(move |k| k * BLOCK..((k + 1) * BLOCK).min(length))
}

/// What stands before the blocks of an array, given the sizes of their streams.
fn head(data: &Data<'_>, sizes: &[usize]) -> Vec<u8> {
    let numbers = [sizes.len(), BLOCK, data.len() % BLOCK].into_iter().chain(sizes.iter().copied());
    numbers.flat_map(|number| (number as u64).to_le_bytes()).collect()
}

/// Arrays as VTK's compressed arrays: number of blocks, block size, size of the last block when it is shorter
/// (else 0), the compressed size of each block (all 64 bits), then the zlib streams. Fast compression: what
/// slower ones save is little, because digits are noise.
pub(super) fn zlib_blocks<'a>(
    arrays: &'a [&Plain<'_>],
    packers: &ScratchPool<Packer>,
    threads: &Threads,
) -> impl Iterator<Item = Array> + use<'a> {
    let pieces: Vec<(&Data<'_>, Range<usize>)> =
        arrays.iter().flat_map(|array| blocks_of(&array.data).map(|range| (&array.data, range))).collect();
    let is_small = arrays.iter().map(|array| array.data.len()).sum::<usize>() < SERIAL;
    let alone = Threads::one();
    let threads = if is_small { &alone } else { threads };
    let mut streams = threads.map(&pieces, packers, Packer::new, |packer, (data, range)| packer.packed(data, range.clone())).into_iter();
    arrays.iter().map(move |Plain { attributes, data }| {
        let blocks: Vec<Vec<u8>> = streams.by_ref().take(blocks_of(data).count()).collect();
        let sizes: Vec<usize> = blocks.iter().map(Vec::len).collect();
        Array { attributes: attributes.clone(), head: head(data, &sizes), blocks }
    })
}

/// Packs one array so many bytes at a time and writes it at once to `out`, which is at `start`: the same
/// bytes as by [`zlib_blocks`], and how many they are.
pub(super) fn write_in_pieces(
    data: &Data<'_>,
    at_once: usize,
    (packers, threads): (&ScratchPool<Packer>, &Threads),
    start: usize,
    out: &mut (impl Write + Seek),
) -> io::Result<usize> {
    let ranges: Vec<Range<usize>> = blocks_of(data).collect();
    let mut sizes = Vec::with_capacity(ranges.len());
    // How long streams are is known when they are there.
    let room = head(data, &vec![0; ranges.len()]).len();
    out.write_all(&vec![0; room])?;
    for ranges in ranges.chunks((at_once / BLOCK).max(1)) {
        for stream in threads.map(ranges, packers, Packer::new, |packer, range| packer.packed(data, range.clone())) {
            out.write_all(&stream)?;
            sizes.push(stream.len());
        }
    }
    let length = room + sizes.iter().sum::<usize>();
    out.seek(SeekFrom::Start(start as u64))?;
    out.write_all(&head(data, &sizes))?;
    out.seek(SeekFrom::Start((start + length) as u64))?;
    Ok(length)
}
