//! Arrays of a VTK XML file, packed: numbers become little-endian bytes block by block, and blocks zlib streams.
//!
//! Arrays come from `vtu`; blocks have a fixed size and are packed by several threads at once, each from its numbers alone, so that equal arrays give equal bytes.

use crate::threads::{Rooms, Threads};
use flate2::{Compress, Compression, FlushCompress, Status};
use std::io::{self, Write};
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
    Numbers(&'a [f64]),
    /// `x y x y ...`, written as `x y 0 x y 0 ...`.
    PlaneVectors(&'a [f64]),
}

impl Data<'_> {
    /// Bytes in the file before compression.
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Bytes(bytes) => bytes.len(),
            Self::Indices(indices) => 8 * indices.len(),
            Self::Numbers(values) => 8 * values.len(),
            Self::PlaneVectors(values) => 24 * (values.len() / 2),
        }
    }

    /// The bytes in a range of whole numbers, little-endian.
    pub(super) fn fill(&self, range: Range<usize>, bytes: &mut Vec<u8>) {
        let values = range.start / 8..range.end / 8;
        bytes.resize(range.len(), 0);
        match self {
            Self::Bytes(all) => bytes.copy_from_slice(&all[range]),
            Self::Indices(all) => {
                let (places, _) = bytes.as_chunks_mut();
                places.iter_mut().zip(&all[values]).for_each(|(place, &index)| *place = i64::from(index).to_le_bytes());
            }
            Self::Numbers(all) => {
                let (places, _) = bytes.as_chunks_mut();
                places.iter_mut().zip(&all[values]).for_each(|(place, value)| *place = value.to_le_bytes());
            }
            Self::PlaneVectors(all) => {
                let (places, _) = bytes.as_chunks_mut();
                // A block may begin within a vector.
                let (mut from, mut at) = (2 * (values.start / 3), values.start % 3);
                for place in places {
                    *place = if at == 2 { 0.0 } else { all[from + at] }.to_le_bytes();
                    (from, at) = if at == 2 { (from + 2, 0) } else { (from, at + 1) };
                }
            }
        }
    }
}

/// What a thread packs blocks with.
pub(super) struct Packer {
    zlib: Compress,
    bytes: Vec<u8>,
    stream: Vec<u8>,
}

impl Packer {
    fn new() -> Self {
        Self { zlib: Compress::new(Compression::fast(), true), bytes: Vec::new(), stream: Vec::new() }
    }

    /// A range of an array as a zlib stream.
    fn packed(&mut self, data: &Data<'_>, range: Range<usize>) -> Vec<u8> {
        data.fill(range, &mut self.bytes);
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

/// Arrays as VTK's compressed arrays: number of blocks, block size, size of the last block when it is shorter (else 0),
/// the compressed size of each block (all 64 bits), then the zlib streams. Fast compression: what slower ones save is little, because digits are noise.
pub(super) fn zlib_blocks<'a>(
    arrays: &'a [&Plain<'_>],
    packers: &Rooms<Packer>,
    threads: &Threads,
) -> impl Iterator<Item = Array> + use<'a> {
    let blocks_of = |data: &Data<'_>| data.len().div_ceil(BLOCK);
    let mut pieces: Vec<(&Data<'_>, Range<usize>)> = Vec::new();
    for data in arrays.iter().map(|array| &array.data) {
        pieces.extend((0..blocks_of(data)).map(|k| (data, k * BLOCK..((k + 1) * BLOCK).min(data.len()))));
    }
    let is_small = arrays.iter().map(|array| array.data.len()).sum::<usize>() < SERIAL;
    let alone = Threads::one();
    let threads = if is_small { &alone } else { threads };
    let mut streams = threads.map(&pieces, packers, Packer::new, |packer, (data, range)| packer.packed(data, range.clone())).into_iter();
    arrays.iter().map(move |Plain { attributes, data }| {
        let blocks: Vec<Vec<u8>> = streams.by_ref().take(blocks_of(data)).collect();
        let head = [blocks.len(), BLOCK, data.len() % BLOCK].into_iter().chain(blocks.iter().map(Vec::len));
        Array { attributes: attributes.clone(), head: head.flat_map(|number| (number as u64).to_le_bytes()).collect(), blocks }
    })
}
