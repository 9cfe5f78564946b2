//! Hashes of 64 bits by which states and models are compared: FNV-1a byte by byte, and a faster one number by
//! number. They do not protect against deliberate collisions.

use std::fmt;

/// A hash that grows byte by byte; shown in hexadecimal.
#[derive(Clone, Copy, Debug)]
pub struct Fnv(u64);

impl Default for Fnv {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Fnv {
    /// Takes bytes in.
    pub fn add(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }

    /// What was taken in so far, as a number.
    #[must_use]
    pub fn value(&self) -> u64 {
        self.0
    }
}

/// So that text is taken in without being put together first; never fails.
impl fmt::Write for Fnv {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.add(text.as_bytes());
        Ok(())
    }
}

impl fmt::Display for Fnv {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

/// Takes a number of 64 bits into a hash: one-to-one in either of them, so that one number that differs is
/// never lost. (Multiplication carries bits upwards, the shift brings them down again.)
#[inline(always)]
#[must_use]
pub fn mixed(hash: u64, number: u64) -> u64 {
    // The constant of the golden ratio: odd, with bits everywhere.
    let product = (hash ^ number).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    product ^ (product >> 32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_bit_of_a_number_changes_about_half_of_the_bits_of_what_follows() {
        let of = |numbers: [u64; 3]| numbers.into_iter().fold(7, mixed);
        let numbers = [1.0_f64, -0.0, 1e300].map(f64::to_bits);
        for (at, bit) in (0..2).flat_map(|at| (0..64).map(move |bit| (at, bit))) {
            let mut other = numbers;
            other[at] ^= 1 << bit;
            let changed = (of(numbers) ^ of(other)).count_ones();
            assert!((10..54).contains(&changed), "{changed} bits by bit {bit} of number {at}");
        }
        assert_ne!(of(numbers), of([numbers[1], numbers[0], numbers[2]]));
    }

    #[test]
    fn known_texts_have_their_known_hashes() {
        for (text, hash) in [("", "cbf29ce484222325"), ("a", "af63dc4c8601ec8c"), ("foobar", "85944171f73967e8")] {
            let mut fnv = Fnv::default();
            fnv.add(text.as_bytes());
            assert_eq!(fnv.to_string(), hash, "{text}");
        }
    }
}
