//! LZW as GIF wants it: pixels (places in a palette of 256 colours) to the bytes of one frame.
//!
//! Pixels come from `animation`, which hands the bytes to the writer of the file. Greedy, and all strings are forgotten when the 4096 codes are used up. The
//! encoder of the crate `gif` looks its strings up in trees; one table for all of them is faster, and packing was most of the time of a film.
//! Source: Graphics Interchange Format, version 89a, appendix F.

/// Bits of the longest codes.
const WIDEST: u32 = 12;
/// Places of the table, as a power of two: twice the codes.
const PLACES: u32 = 13;
/// What stands in a place where no string is.
const EMPTY: u32 = u32::MAX;

/// The strings seen so far. A string is a code and the pixel that follows it.
#[derive(Debug)]
pub(super) struct Table {
    /// String and its code, `(code << 8 | pixel) << 12 | own code`.
    places: Vec<u32>,
}

impl Default for Table {
    fn default() -> Self {
        Self { places: vec![EMPTY; 1 << PLACES] }
    }
}

/// Codes of growing width, one after the other from the lowest bit.
struct Bits {
    bytes: Vec<u8>,
    pending: u64,
    count: u32,
}

impl Bits {
    fn push(&mut self, code: u16, width: u32) {
        self.pending |= u64::from(code) << self.count;
        self.count += width;
        while self.count >= 8 {
            self.bytes.push(self.pending as u8);
            self.pending >>= 8;
            self.count -= 8;
        }
    }
}

/// Pixels that are compared at once.
const STRIDE: usize = 32;

/// Codes of the strings that hold one pixel again and again, by length: a run of it is looked up as a whole.
struct Runs {
    pixel: u8,
    codes: Vec<u16>,
}

impl Runs {
    fn of(pixel: u8) -> Self {
        Self { pixel, codes: vec![u16::from(pixel)] }
    }

    /// The longest string of these with which `pixels` begin: its code and length, at least 1.
    fn longest(&self, pixels: &[u8]) -> (u16, usize) {
        let pixels = &pixels[..pixels.len().min(self.codes.len())];
        let same = |pixel: &u8| *pixel == self.pixel;
        let strides = pixels.chunks(STRIDE).take_while(|stride| stride.iter().all(same)).count();
        let begun = (strides * STRIDE).min(pixels.len());
        let length = begun + pixels[begun..].iter().take_while(|pixel| same(pixel)).count();
        (self.codes[length - 1], length)
    }

    /// `code` with one more of the pixel has become `longer`.
    fn learn(&mut self, code: u16, pixel: u8, longer: u16) {
        if pixel == self.pixel && self.codes.last() == Some(&code) {
            self.codes.push(longer);
        }
    }
}

impl Table {
    /// The bytes of a frame: the bits of a pixel, then the codes. Runs of the pixel `common` cost next to nothing.
    pub(super) fn packed(&mut self, pixels: &[u8], common: u8) -> Vec<u8> {
        let most = pixels.iter().copied().max().unwrap_or(0);
        let depth = (u32::from(most) + 1).max(4).next_power_of_two().trailing_zeros();
        // One code says that all strings are forgotten, the next that nothing follows, the one after it is the first of a string.
        let clear = 1 << depth;
        let (end, first) = (clear + 1, clear + 2);
        let mut bits = Bits { bytes: vec![depth as u8], pending: 0, count: 0 };
        let (mut width, mut next) = (depth + 1, first);
        let mut runs = Runs::of(common);
        self.places.fill(EMPTY);
        bits.push(clear, width);
        let mut at = 0;
        while at < pixels.len() {
            // The longest string that is known.
            let (mut code, known) = if pixels[at] == common { runs.longest(&pixels[at..]) } else { (u16::from(pixels[at]), 1) };
            at += known;
            while let Some(&pixel) = pixels.get(at) {
                let string = (u32::from(code) << 8) | u32::from(pixel);
                let Some(longer) = self.find_or_add(string, next) else {
                    runs.learn(code, pixel, next);
                    break;
                };
                (code, at) = (longer, at + 1);
            }
            bits.push(code, width);
            if at == pixels.len() {
                // The reader adds a string before it reads the end.
                if u32::from(next) >= 1 << width && width < WIDEST {
                    width += 1;
                }
                break;
            }
            next += 1;
            // The reader is one string behind.
            if u32::from(next) > 1 << width && width < WIDEST {
                width += 1;
            }
            if u32::from(next) > 1 << WIDEST {
                bits.push(clear, width);
                (width, next) = (depth + 1, first);
                self.places.fill(EMPTY);
                runs = Runs::of(common);
            }
        }
        bits.push(end, width);
        // The rest of the last byte.
        bits.push(0, 7);
        bits.bytes
    }

    /// The code of a string; one that is not there becomes `next`.
    fn find_or_add(&mut self, string: u32, next: u16) -> Option<u16> {
        let mut place = string.wrapping_mul(0x9e37_79b1) >> (32 - PLACES);
        loop {
            let entry = &mut self.places[place as usize];
            if *entry >> 12 == string && *entry != EMPTY {
                return Some((*entry & 0xfff) as u16);
            }
            if *entry == EMPTY {
                *entry = (string << 12) | u32::from(next & 0xfff);
                return None;
            }
            place = (place + 1) % (1 << PLACES);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gif::{ColorOutput, DecodeOptions, Encoder, Frame};

    /// What a reader makes of the bytes of a line of pixels.
    fn read_back(packed: Vec<u8>, length: usize) -> Vec<u8> {
        let mut file = Vec::new();
        let mut encoder = Encoder::new(&mut file, length as u16, 1, &[0; 768]).unwrap();
        let frame = Frame { width: length as u16, height: 1, buffer: packed.into(), ..Frame::default() };
        encoder.write_lzw_pre_encoded_frame(&frame).unwrap();
        drop(encoder);
        let mut options = DecodeOptions::new();
        options.set_color_output(ColorOutput::Indexed);
        let mut decoder = options.read_info(&file[..]).unwrap();
        decoder.read_next_frame().unwrap().unwrap().buffer.to_vec()
    }

    /// Bytes of another encoder.
    fn length_elsewhere(pixels: &[u8]) -> usize {
        let mut frame = Frame::from_indexed_pixels(pixels.len() as u16, 1, pixels, None);
        frame.make_lzw_pre_encoded();
        frame.buffer.len()
    }

    #[test]
    fn a_reader_finds_the_pixels_in_no_more_bytes_than_another_encoder_needs() {
        let mut table = Table::default();
        let mut state = 1_u64;
        let mut random = |below: u64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) % below
        };
        for length in [1, 2, 3, 254, 255, 256, 257, 600, 3838, 3839, 3840, 3841, 3842, 4100, 20_000, 65_000] {
            for [from, colours] in [[255, 1], [0, 2], [3, 5], [100, 60], [0, 256]] {
                let pixels: Vec<u8> = (0..length).map(|_| (from + random(colours)) as u8).collect();
                let packed = table.packed(&pixels, from as u8);
                assert!(packed == table.packed(&pixels, (from + 2) as u8), "knowing of runs changes nothing");
                assert!(packed.len() <= length_elsewhere(&pixels) + 2, "{length} pixels of {colours} colours from {from}");
                assert!(read_back(packed, length) == pixels, "{length} pixels of {colours} colours from {from}");
            }
        }
        let noise: Vec<u8> = (0..5000).map(|k| (k * k / 7) as u8 | 128).collect();
        for length in 3800..3900 {
            assert!(read_back(table.packed(&noise[..length], 128), length) == noise[..length], "{length}");
        }
    }
}
