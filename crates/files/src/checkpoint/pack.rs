//! Numbers packed fast and to the last bit: in pieces, the bytes of equal weight side by side, and only those
//! are compressed that are no noise.
//!
//! A piece of numbers of eight bytes is turned into differences from the number one or two before it where
//! that leaves less to say, then into eight planes of bytes, from the lowest to the highest. Exponents and
//! leading digits of neighbours are alike, so their planes shrink to little in a fast zlib; the last digits
//! are noise, and are stored as they are without being tried. Each piece is packed from its bytes alone,
//! several at a time.

use crate::threads::{ScratchPool, Threads};
use flate2::{Compress, Compression, Decompress, FlushCompress, FlushDecompress, Status};

/// Bytes of a piece before packing.
const PIECE: usize = 1 << 18;
/// Bytes of a number, and planes.
const WIDTH: usize = 8;
/// Numbers that are looked at to choose what differences are taken from.
const SAMPLE: usize = 2048;
/// Distances of the numbers that differences are taken from; 0: none are.
const STRIDES: [usize; 3] = [0, 1, 2];
/// Bits per byte above which a plane is noise.
const NOISE: f64 = 7.2;
/// Marks the length of a plane that is stored as it is.
const STORED: u32 = 1 << 31;

/// Packed bytes, piece by piece.
pub(super) struct Packed {
    pub(super) pieces: Vec<Vec<u8>>,
}

/// Packs bytes.
pub(super) fn pack(bytes: &[u8], threads: &Threads) -> Packed {
    let pieces: Vec<&[u8]> = bytes.chunks(PIECE).collect();
    Packed { pieces: threads.map(&pieces, &ScratchPool::default(), Scratch::default, |room, piece| room.pack(piece)) }
}

/// The `length` bytes that were packed; `None`: these are no such bytes.
pub(super) fn unpack(packed: &[u8], length: usize, threads: &Threads) -> Option<Vec<u8>> {
    let mut pieces = Vec::new();
    let mut rest = packed;
    let mut left = length;
    while left > 0 {
        let (head, after) = rest.split_first_chunk::<4>()?;
        let (piece, others) = after.split_at_checked(u32::from_le_bytes(*head) as usize)?;
        pieces.push((piece, left.min(PIECE)));
        (rest, left) = (others, left.saturating_sub(PIECE));
    }
    if !rest.is_empty() {
        return None;
    }
    let plain = threads.map(&pieces, &ScratchPool::default(), Scratch::default, |room, (piece, length)| room.unpack(piece, *length));
    // Room for the whole only once every piece is there: its length is a number of the file.
    plain.into_iter().collect::<Option<Vec<_>>>().map(|pieces| pieces.concat())
}

/// What a thread packs with.
struct Scratch {
    zlib: Compress,
    unzip: Decompress,
    planes: Vec<u8>,
    numbers: Vec<u64>,
}

impl Default for Scratch {
    fn default() -> Self {
        Self { zlib: Compress::new(Compression::fast(), false), unzip: Decompress::new(false), planes: Vec::new(), numbers: Vec::new() }
    }
}

/// Bits per byte of what a plane would need, by its bytes one by one.
fn entropy(plane: impl Iterator<Item = u8>) -> f64 {
    let (mut counts, mut all) = ([0_u32; 256], 0_u32);
    for byte in plane {
        counts[usize::from(byte)] += 1;
        all += 1;
    }
    let all = f64::from(all.max(1));
    counts.iter().filter(|&&count| count > 0).map(|&count| f64::from(count) / all).map(|part| -part * part.log2()).sum()
}

fn difference(numbers: &[u64], at: usize, stride: usize) -> u64 {
    if stride == 0 || at < stride { numbers[at] } else { numbers[at].wrapping_sub(numbers[at - stride]) }
}

/// What differences are best taken from: that with the least to say of all planes.
fn best_stride(numbers: &[u64]) -> usize {
    let from = numbers.len().saturating_sub(SAMPLE) / 2;
    let sample = &numbers[from..numbers.len().min(from + SAMPLE)];
    let cost = |stride: usize| -> f64 {
        let of = |plane: usize| entropy((0..sample.len()).map(|at| difference(sample, at, stride).to_le_bytes()[plane])).min(NOISE);
        (0..WIDTH).map(of).sum()
    };
    let costs = STRIDES.map(cost);
    (0..STRIDES.len()).fold(0, |best, at| if costs[at] < costs[best] { at } else { best })
}

impl Scratch {
    /// Length, stride, lengths of the planes, planes, and the bytes that make no whole number.
    fn pack(&mut self, piece: &[u8]) -> Vec<u8> {
        let (chunks, tail) = piece.as_chunks::<WIDTH>();
        self.numbers.clear();
        self.numbers.extend(chunks.iter().map(|bytes| u64::from_le_bytes(*bytes)));
        let stride = best_stride(&self.numbers);
        let count = self.numbers.len();
        self.planes.resize(count * WIDTH, 0);
        for at in 0..count {
            let bytes = difference(&self.numbers, at, STRIDES[stride]).to_le_bytes();
            for (plane, byte) in bytes.into_iter().enumerate() {
                self.planes[plane * count + at] = byte;
            }
        }
        let mut packed = vec![0; 4];
        packed.push(stride as u8);
        let lengths = packed.len();
        packed.resize(lengths + 4 * WIDTH, 0);
        for plane in 0..WIDTH {
            let bytes = &self.planes[plane * count..(plane + 1) * count];
            let begin = packed.len();
            let is_noise = entropy(bytes.iter().copied()) > NOISE;
            let is_packed = !is_noise && squeeze(&mut self.zlib, bytes, &mut packed);
            if !is_packed {
                packed.truncate(begin);
                packed.extend_from_slice(bytes);
            }
            let length = (packed.len() - begin) as u32 | if is_packed { 0 } else { STORED };
            packed[lengths + 4 * plane..lengths + 4 * (plane + 1)].copy_from_slice(&length.to_le_bytes());
        }
        packed.extend_from_slice(tail);
        let length = (packed.len() - 4) as u32;
        packed[..4].copy_from_slice(&length.to_le_bytes());
        packed
    }

    fn unpack(&mut self, piece: &[u8], length: usize) -> Option<Vec<u8>> {
        let (count, tail) = (length / WIDTH, length % WIDTH);
        let (&stride, rest) = piece.split_first()?;
        let stride = *STRIDES.get(usize::from(stride))?;
        let (lengths, mut rest) = rest.split_at_checked(4 * WIDTH)?;
        self.planes.clear();
        for length in lengths.as_chunks::<4>().0 {
            let length = u32::from_le_bytes(*length);
            let (stored, others) = rest.split_at_checked((length & !STORED) as usize)?;
            rest = others;
            let begin = self.planes.len();
            if length & STORED != 0 {
                self.planes.extend_from_slice(stored);
            } else {
                self.unzip.reset(false);
                // No more room than a plane needs: what says more is no plane.
                self.planes.reserve_exact(count + 1);
                let mut plane = Vec::with_capacity(count + 1);
                let status = self.unzip.decompress_vec(stored, &mut plane, FlushDecompress::Finish).ok()?;
                if status != Status::StreamEnd || self.unzip.total_in() != stored.len() as u64 {
                    return None;
                }
                self.planes.append(&mut plane);
            }
            if self.planes.len() - begin != count {
                return None;
            }
        }
        if rest.len() != tail {
            return None;
        }
        self.numbers.clear();
        for at in 0..count {
            let bytes = std::array::from_fn(|plane| self.planes[plane * count + at]);
            let before = if stride == 0 || at < stride { 0 } else { self.numbers[at - stride] };
            self.numbers.push(u64::from_le_bytes(bytes).wrapping_add(before));
        }
        let mut plain = Vec::with_capacity(length);
        plain.extend(self.numbers.iter().flat_map(|number| number.to_le_bytes()));
        plain.extend_from_slice(rest);
        Some(plain)
    }
}

/// Appends a zlib stream of `bytes`; whether it is shorter than they are.
fn squeeze(zlib: &mut Compress, bytes: &[u8], packed: &mut Vec<u8>) -> bool {
    zlib.reset();
    // What does not shrink grows by an eighth at most, and there must be room for that: zlib-rs panics where
    // there is not.
    packed.reserve(bytes.len() + bytes.len() / 4 + 64);
    let begin = packed.len();
    let status = zlib.compress_vec(bytes, packed, FlushCompress::Finish);
    status.is_ok_and(|status| status == Status::StreamEnd) && packed.len() - begin < bytes.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn there_and_back(bytes: &[u8]) -> usize {
        let one = Threads::one();
        let packed = pack(bytes, &one).pieces.concat();
        assert!(pack(bytes, &Threads::new(3)).pieces.concat() == packed, "threads change no byte");
        assert!(unpack(&packed, bytes.len(), &one).as_deref() == Some(bytes));
        packed.len()
    }

    #[test]
    fn pieces_that_are_not_there_get_no_room() {
        // A megabyte of pieces without a byte, which would be 64 GiB.
        let count = 1 << 18;
        assert_eq!(unpack(&vec![0; 4 * count], count * PIECE, &Threads::one()), None);
    }

    #[test]
    fn bytes_come_back_as_they_were() {
        let values = |value: &dyn Fn(usize) -> f64, count: usize| -> Vec<u8> { (0..count).flat_map(|k| value(k).to_le_bytes()).collect() };
        for count in [0, 1, 2, 3, 1000, PIECE / 8, PIECE / 8 + 1, 100_000] {
            let smooth = values(&|k| (1e-3 * k as f64).sin() * 1e7, count);
            let size = there_and_back(&smooth);
            assert!(count < 1000 || size < smooth.len() * 8 / 10, "{size} of {}", smooth.len());
            let zeros = values(&|_| 0.0, count);
            assert!(there_and_back(&zeros) < 64 + zeros.len() / 64);
            there_and_back(&values(&|k| [f64::NAN, f64::INFINITY, -0.0, 5e-324, f64::MAX][k % 5], count));
        }
        // Between what shrinks and what is noise: some of it grows when it is tried.
        for spread in [100, 130, 150, 160, 180, 200] {
            let mut random = 1_u64;
            let mut next = || {
                random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                255 - ((random >> 33) % spread) as u8
            };
            let bytes: Vec<u8> = (0..2 * PIECE).map(|_| next()).collect();
            assert!(there_and_back(&bytes) < bytes.len() + 256);
        }
        let mut random = 1_u64;
        let mut noise = || {
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (random >> 56) as u8
        };
        for length in [5, 8, 4093, 300_001] {
            let bytes: Vec<u8> = (0..length).map(|_| noise()).collect();
            assert!(there_and_back(&bytes) < length + 64 + length / 1000);
        }
    }

    #[test]
    fn what_is_damaged_is_no_panic_and_asks_for_no_memory() {
        let bytes: Vec<u8> = (0..4000_u32).flat_map(|k| f64::from(k).sqrt().to_le_bytes()).collect();
        let packed = pack(&bytes, &Threads::one()).pieces.concat();
        for at in (0..packed.len()).step_by(7) {
            assert!(unpack(&packed[..at], bytes.len(), &Threads::one()).is_none());
            for flip in [1, 0x80, 0xff] {
                let mut damaged = packed.clone();
                damaged[at] ^= flip;
                let _ = unpack(&damaged, bytes.len(), &Threads::one());
            }
        }
        assert!(unpack(&packed, bytes.len() + 8, &Threads::one()).is_none());
        assert!(unpack(&packed, usize::MAX, &Threads::one()).is_none());
    }
}
