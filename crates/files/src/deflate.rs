//! zlib streams of numbers with 64 bits, made fast.
//!
//! The digits of computed numbers are noise that nothing packs; what packs is whole numbers that come again (zeros, constants, places where nothing happens yet) and
//! bytes that are frequent (exponents). So strings are looked for number by number, not byte by byte as a general packer does, and Huffman codes do the rest. On
//! fields the streams are about as long as those of zlib at its fastest, in a fraction of the time. Blocks come from `vtu`, one stream each.
//! Source: RFC 1950 and RFC 1951.

/// Numbers in the table of those seen: a power of two.
const SEEN_BITS: u32 = 12;
/// Symbols: 256 bytes, the end, 29 lengths.
const SYMBOLS: usize = 286;
const END: usize = 256;
/// Symbols of distances.
const DISTANCES: usize = 30;
/// Farthest and longest repetition, in numbers; some bytes before it may be repeated, too.
const FAR: usize = 32_768 / 8;
const LONG: usize = 248 / 8;
/// The first bytes of a stream.
const HEAD: [u8; 2] = [0x78, 0x01];
/// Largest piece that is stored as it is.
const STORED: usize = 65_535;
/// Order in which the lengths of the codes for lengths are told.
const TOLD: [usize; 19] = [16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15];

/// Makes streams; its buffers serve again.
#[derive(Debug)]
pub(crate) struct Packer {
    /// Where a number was last seen, plus one.
    seen: Vec<u16>,
    /// What comes again.
    repetitions: Vec<Repetition>,
}

/// Bytes that are there already.
#[derive(Clone, Copy, Debug)]
struct Repetition {
    /// Where they begin.
    at: u32,
    length: u16,
    /// Numbers from where they are there already.
    distance: u16,
}

/// A code of each symbol: bits, lowest first, and their number.
type Codes = Vec<(u16, u8)>;

impl Packer {
    pub(crate) fn new() -> Self {
        Self { seen: vec![0; 1 << SEEN_BITS], repetitions: Vec::new() }
    }

    /// The stream of `bytes`, at most 2^19 of them; what is behind the last whole number is packed byte by byte.
    pub(crate) fn stream(&mut self, bytes: &[u8]) -> Vec<u8> {
        let (mut symbols, mut distances) = ([0_u32; SYMBOLS], [0_u32; DISTANCES]);
        self.find(bytes);
        self.count(bytes, &mut symbols, &mut distances);
        let (of_symbols, of_distances) = (lengths(&symbols, 15), lengths(&distances, 15));
        let bits: u64 = symbols.iter().zip(&of_symbols).map(|(&count, &length)| u64::from(count) * u64::from(length)).sum();
        let mut out = Bits { bytes: Vec::with_capacity(bytes.len() / 8 * 9 + 400), pending: 0, count: 0 };
        // Window of 32768 bytes, fastest packing.
        out.bytes.extend(HEAD);
        if bits / 8 < bytes.len() as u64 {
            // The last block, with codes of its own.
            out.push(0b101, 3);
            tell(&of_symbols, &of_distances, &mut out);
            self.write(bytes, &codes(&of_symbols), &codes(&of_distances), &mut out);
            out.finish();
        }
        let stored = HEAD.len() + bytes.len() + 5 * bytes.len().div_ceil(STORED).max(1);
        if out.bytes.len() == HEAD.len() || out.bytes.len() > stored {
            out.bytes.truncate(HEAD.len());
            store(bytes, &mut out.bytes);
        }
        out.bytes.extend(adler32(bytes).to_be_bytes());
        // Streams of a whole frame wait for each other.
        out.bytes.shrink_to_fit();
        out.bytes
    }

    /// Finds what comes again.
    fn find(&mut self, bytes: &[u8]) {
        self.seen.fill(0);
        self.repetitions.clear();
        let numbers = bytes.as_chunks::<8>().0;
        let (mut at, mut done) = (0, 0);
        while at < numbers.len() {
            let number = numbers[at];
            let place = (u64::from_le_bytes(number).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (64 - SEEN_BITS)) as usize;
            let before = usize::from(std::mem::replace(&mut self.seen[place], at as u16 + 1));
            if before == 0 || before > at || at + 1 - before > FAR || numbers[before - 1] != number {
                at += 1;
                continue;
            }
            let distance = at + 1 - before;
            let pairs = numbers[at..].iter().zip(&numbers[before - 1..]).take(LONG);
            let count = pairs.take_while(|(a, b)| a == b).count();
            // The upper bytes of the number before, sign and exponent, are often the same as well.
            let (from, own) = (8 * (before - 1), 8 * at - done);
            let upper = (1..=own.min(from).min(7)).take_while(|k| bytes[from - k] == bytes[8 * at - k]).count();
            self.repetitions.push(Repetition {
                at: (8 * at - upper) as u32,
                length: (8 * count + upper) as u16,
                distance: distance as u16,
            });
            at += count;
            done = 8 * at;
        }
    }

    /// Bytes that are new before each repetition, and it.
    fn pieces<'a>(&'a self, bytes: &'a [u8]) -> impl Iterator<Item = (&'a [u8], &'a Repetition)> {
        let mut done = 0;
        self.repetitions.iter().map(move |repetition| {
            let fresh = &bytes[done..repetition.at as usize];
            done = repetition.at as usize + usize::from(repetition.length);
            (fresh, repetition)
        })
    }

    /// Bytes behind the last repetition.
    fn rest<'a>(&self, bytes: &'a [u8]) -> &'a [u8] {
        &bytes[self.repetitions.last().map_or(0, |last| last.at as usize + usize::from(last.length))..]
    }

    fn count(&self, bytes: &[u8], symbols: &mut [u32; SYMBOLS], distances: &mut [u32; DISTANCES]) {
        let mut count = |fresh: &[u8]| fresh.iter().for_each(|&byte| symbols[usize::from(byte)] += 1);
        self.pieces(bytes).for_each(|(fresh, _)| count(fresh));
        count(self.rest(bytes));
        for repetition in &self.repetitions {
            symbols[length_symbol(repetition.length).0] += 1;
            distances[distance_symbol(repetition.distance).0] += 1;
        }
        symbols[END] = 1;
    }

    fn write(&self, bytes: &[u8], symbols: &Codes, distances: &Codes, out: &mut Bits) {
        let write = |fresh: &[u8], out: &mut Bits| {
            for &byte in fresh {
                let (code, bits) = symbols[usize::from(byte)];
                out.push(code.into(), bits.into());
            }
        };
        for (fresh, &Repetition { length, distance, .. }) in self.pieces(bytes) {
            write(fresh, out);
            for ((symbol, extra, extra_bits), codes) in [(length_symbol(length), symbols), (distance_symbol(distance), distances)] {
                let (code, bits) = codes[symbol];
                out.push(u32::from(code) | extra << bits, u32::from(bits) + extra_bits);
            }
        }
        write(self.rest(bytes), out);
        let (code, bits) = symbols[END];
        out.push(code.into(), bits.into());
    }
}

/// Symbol, extra bits and their number of a repetition of so many bytes, at most 257.
fn length_symbol(bytes: u16) -> (usize, u32, u32) {
    let beyond = u32::from(bytes) - 3;
    if beyond < 8 {
        return (257 + beyond as usize, 0, 0);
    }
    let bits = beyond.ilog2() - 2;
    (257 + (4 * bits + (beyond >> bits)) as usize, beyond & ((1 << bits) - 1), bits)
}

/// Symbol, extra bits and their number of a distance of so many numbers.
fn distance_symbol(numbers: u16) -> (usize, u32, u32) {
    let beyond = 8 * u32::from(numbers) - 1;
    let bits = beyond.ilog2() - 1;
    ((2 * bits + (beyond >> bits)) as usize, beyond & ((1 << bits) - 1), bits)
}

/// Bits, lowest first.
struct Bits {
    bytes: Vec<u8>,
    pending: u64,
    count: u32,
}

impl Bits {
    /// At most 32 bits.
    #[inline]
    fn push(&mut self, bits: u32, count: u32) {
        self.pending |= u64::from(bits) << self.count;
        self.count += count;
        if self.count >= 32 {
            self.bytes.extend_from_slice(&(self.pending as u32).to_le_bytes());
            self.pending >>= 32;
            self.count -= 32;
        }
    }

    fn finish(&mut self) {
        let left = self.pending.to_le_bytes();
        self.bytes.extend_from_slice(&left[..self.count.div_ceil(8) as usize]);
    }
}

/// Blocks that hold the bytes as they are.
fn store(bytes: &[u8], out: &mut Vec<u8>) {
    let count = bytes.len().div_ceil(STORED).max(1);
    for k in 0..count {
        let piece = &bytes[k * STORED..((k + 1) * STORED).min(bytes.len())];
        let length = piece.len() as u16;
        out.push(u8::from(k + 1 == count));
        out.extend(length.to_le_bytes());
        out.extend((!length).to_le_bytes());
        out.extend_from_slice(piece);
    }
}

/// Lengths of the Huffman codes of symbols that occur so often, at most `limit`; 0 where one does not occur.
fn lengths(counts: &[u32], limit: usize) -> Vec<u8> {
    let mut order: Vec<(u32, usize)> =
        counts.iter().zip(0..).filter(|(count, _)| **count > 0).map(|(&count, symbol)| (count, symbol)).collect();
    order.sort_unstable();
    let mut lengths = vec![0; counts.len()];
    let leaves = order.len();
    if leaves < 2 {
        order.iter().for_each(|&(_, symbol)| lengths[symbol] = 1);
        return lengths;
    }
    // Leaves and inner nodes both come in ascending order: the two lightest are at the front of either list.
    let mut weights: Vec<u32> = order.iter().map(|&(count, _)| count).collect();
    let mut parents = vec![0; 2 * leaves - 1];
    let (mut leaf, mut inner) = (0, leaves);
    while weights.len() < 2 * leaves - 1 {
        let node = weights.len();
        let mut sum = 0;
        for _ in 0..2 {
            let lightest = if leaf < leaves && (inner >= node || weights[leaf] <= weights[inner]) { &mut leaf } else { &mut inner };
            sum += weights[*lightest];
            parents[*lightest] = node;
            *lightest += 1;
        }
        weights.push(sum);
    }
    let mut depths = vec![0; 2 * leaves - 1];
    let mut of_length = vec![0_usize; limit + 1];
    for node in (0..2 * leaves - 2).rev() {
        depths[node] = depths[parents[node]] + 1;
        if node < leaves {
            of_length[limit.min(depths[node])] += 1;
        }
    }
    // Codes that were too long have become too many: one goes up, another makes room for both.
    let mut room: usize = of_length.iter().enumerate().skip(1).map(|(length, count)| count << (limit - length)).sum();
    while room > 1 << limit {
        of_length[limit] -= 1;
        if let Some(length) = (1..limit).rev().find(|&length| of_length[length] > 0) {
            of_length[length] -= 1;
            of_length[length + 1] += 2;
        }
        room -= 1;
    }
    let all = of_length.iter().enumerate().rev().flat_map(|(length, &count)| std::iter::repeat_n(length as u8, count));
    order.iter().zip(all).for_each(|(&(_, symbol), length)| lengths[symbol] = length);
    lengths
}

/// Codes from their lengths: by length, then by symbol.
fn codes(lengths: &[u8]) -> Codes {
    let mut codes = vec![(0, 0); lengths.len()];
    let mut next = 0_u16;
    for length in 1..=15_u8 {
        next <<= 1;
        for (code, _) in codes.iter_mut().zip(lengths).filter(|(_, own)| **own == length) {
            *code = (next.reverse_bits() >> (16 - length), length);
            next += 1;
        }
    }
    codes
}

/// Tells the lengths of all codes: runs of equal ones are counted, and these numbers have codes as well.
fn tell(symbols: &[u8], distances: &[u8], out: &mut Bits) {
    let all: Vec<u8> = symbols.iter().chain(distances).copied().collect();
    // Symbol, extra bits and their number.
    let mut told: Vec<(usize, u32, u32)> = Vec::new();
    for run in all.chunk_by(|a, b| a == b) {
        let length = usize::from(run[0]);
        let mut left = run.len();
        if length > 0 {
            told.push((length, 0, 0));
            left -= 1;
        }
        while left > 0 {
            let (count, again) = match (length, left) {
                (0, 11..) => (left.min(138), (18, left.min(138) as u32 - 11, 7)),
                (0, 3..) => (left, (17, left as u32 - 3, 3)),
                (1.., 3..) => (left.min(6), (16, left.min(6) as u32 - 3, 2)),
                _ => (1, (length, 0, 0)),
            };
            told.push(again);
            left -= count;
        }
    }
    let mut counts = [0; 19];
    told.iter().for_each(|&(symbol, ..)| counts[symbol] += 1);
    let of_lengths = lengths(&counts, 7);
    let codes = codes(&of_lengths);
    let count = TOLD.iter().rposition(|&symbol| of_lengths[symbol] > 0).map_or(4, |last| (last + 1).max(4));
    out.push(symbols.len() as u32 - 257, 5);
    out.push(distances.len() as u32 - 1, 5);
    out.push(count as u32 - 4, 4);
    TOLD[..count].iter().for_each(|&symbol| out.push(of_lengths[symbol].into(), 3));
    for (symbol, extra, extra_bits) in told {
        let (code, bits) = codes[symbol];
        out.push(u32::from(code) | extra << bits, u32::from(bits) + extra_bits);
    }
}

/// Check sum of a zlib stream.
fn adler32(bytes: &[u8]) -> u32 {
    const MODULUS: u32 = 65_521;
    let (mut a, mut b) = (1_u32, 0_u32);
    // So many bytes can't overflow.
    for piece in bytes.chunks(5536) {
        let (lines, rest) = piece.as_chunks::<16>();
        for line in lines {
            b += 16 * a;
            a += line.iter().map(|&byte| u32::from(byte)).sum::<u32>();
            b += line.iter().zip(1..).map(|(&byte, k)| (17 - k) * u32::from(byte)).sum::<u32>();
        }
        for &byte in rest {
            a += u32::from(byte);
            b += a;
        }
        (a, b) = (a % MODULUS, b % MODULUS);
    }
    b << 16 | a
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::Compression;
    use flate2::read::{ZlibDecoder, ZlibEncoder};
    use std::io::Read;

    fn read_back(stream: &[u8]) -> Vec<u8> {
        let mut bytes = Vec::new();
        // The decoder looks at the check sum, too.
        ZlibDecoder::new(stream).read_to_end(&mut bytes).unwrap();
        bytes
    }

    fn bytes_of(numbers: impl Iterator<Item = f64>) -> Vec<u8> {
        numbers.flat_map(f64::to_le_bytes).collect()
    }

    fn noise(count: usize) -> impl Iterator<Item = f64> {
        let mut state = 1_u64;
        (0..count).map(move |_| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            f64::from_bits(state)
        })
    }

    #[test]
    fn every_stream_reads_back() {
        let mut packer = Packer::new();
        let smooth = |count: u32| bytes_of((0..count).map(f64::from).map(|k| (1e-3 * k).sin()));
        let samples = [
            vec![],
            vec![7],
            vec![0; 5],
            bytes_of(std::iter::once(0.25)),
            bytes_of([1.5; 3].into_iter()),
            vec![0; 1 << 17],
            smooth(100),
            smooth(1 << 14),
            bytes_of(noise(1 << 14)),
            bytes_of(noise(3)),
            bytes_of(noise(5000).flat_map(|v| [v, 2.0, 0.0])),
            bytes_of((0..1 << 14).map(|k| f64::from(k % 5000))),
            bytes_of((0..1 << 14).map(|k| f64::from(k % 37))),
            (0..100_003_u32).map(|k| (k.wrapping_mul(k) >> 7) as u8).collect(),
            // Frequencies like Fibonacci's numbers: codes that would be longer than 15 bits.
            (0..24_u32).flat_map(|k| vec![k as u8; (1.618_f64.powi(k as i32) / 2.2) as usize + 1]).map(|k| k ^ 0x55).collect(),
        ];
        for (k, bytes) in samples.iter().enumerate() {
            let stream = packer.stream(bytes);
            assert!(read_back(&stream) == *bytes, "sample {k}");
            assert!(stream.len() <= bytes.len() + 5 * bytes.len().div_ceil(STORED) + 20, "sample {k}: {}", stream.len());
        }
    }

    #[test]
    fn all_lengths_and_distances_read_back() {
        let mut packer = Packer::new();
        for distance in (1..40).chain([63, 64, 65, 500, 1023, 1024, 1025, 3000, 4094, 4095, 4096, 4097]) {
            for length in [1, 2, 3, 4, 5, 8, 9, 16, 17, 31, 32, 33, 64, 100] {
                let fresh: Vec<f64> = noise(distance).collect();
                let numbers = fresh.iter().chain(fresh.iter().cycle().take(length)).copied().chain([0.5]);
                let bytes = bytes_of(numbers);
                assert!(read_back(&packer.stream(&bytes)) == bytes, "{length} at {distance}");
            }
        }
    }

    #[test]
    fn fields_are_packed_as_well_as_by_the_fastest_zlib() {
        let wave = |k: f64| (0.01 * k).sin() * (0.003 * k).cos();
        let samples = [
            bytes_of((0..5000).map(f64::from).flat_map(|k| [wave(k), 1.0 + wave(2.0 * k), 0.0])),
            bytes_of((0..15_000).map(|k| if k < 9000 { 0.0 } else { wave(f64::from(k)) })),
            bytes_of((0..15_000).map(f64::from).map(|k| 1e8 * wave(k))),
        ];
        for bytes in &samples {
            let mut theirs = Vec::new();
            ZlibEncoder::new(&bytes[..], Compression::fast()).read_to_end(&mut theirs).unwrap();
            let own = Packer::new().stream(bytes).len();
            assert!(own as f64 <= 1.02 * theirs.len() as f64, "{own} bytes for {}", theirs.len());
        }
    }
}
