//! Damage to files: the same number gives the same damage.

/// Random numbers by SplitMix64 (Steele, Lea and Flood, OOPSLA 2014).
pub(crate) struct Dice(u64);

impl Dice {
    pub(crate) fn new(seed: u64) -> Self {
        let mut one = Self(seed);
        Self(one.next() ^ seed.rotate_left(32))
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Below `end`, zero if that is.
    fn below(&mut self, end: usize) -> usize {
        (self.next() % end.max(1) as u64) as usize
    }
}

/// Numbers and signs that readers stumble over.
const WORDS: &[&str] = &[
    "0",
    "-1",
    "1",
    "2",
    "4294967295",
    "4294967296",
    "-9223372036854775808",
    "9223372036854775807",
    "18446744073709551615",
    "5000000000",
    "1e308",
    "1e999",
    "-1e-320",
    "nan",
    "inf",
    "\"\"",
    "\"1 mm\"",
    "[",
    "]",
    "{",
    "}",
    "[[",
    "=",
    ".",
    ",",
    "$",
    "*",
    "#",
    "\n",
    "\r\n",
    "\t",
    "\u{feff}",
    "\0",
    "é",
    "all",
    "true",
];

/// What files are damaged, and what pieces are put in from.
pub(crate) struct Damage<'a> {
    seeds: &'a [Vec<u8>],
}

impl<'a> Damage<'a> {
    pub(crate) fn new(seeds: &'a [Vec<u8>]) -> Self {
        Self { seeds }
    }

    /// One of the files with one to eight damages.
    pub(crate) fn of(&self, dice: &mut Dice) -> Vec<u8> {
        let mut bytes = self.seeds[dice.below(self.seeds.len())].clone();
        for _ in 0..=dice.below(8) {
            self.damage(&mut bytes, dice);
        }
        bytes
    }

    fn damage(&self, bytes: &mut Vec<u8>, dice: &mut Dice) {
        let at = dice.below(bytes.len());
        let end = (at + dice.below(40)).min(bytes.len());
        match dice.below(8) {
            0 if !bytes.is_empty() => bytes[at] ^= 1 << dice.below(8),
            1 if !bytes.is_empty() => bytes[at] = dice.below(256) as u8,
            2 => drop(bytes.drain(at..end)),
            3 => {
                let piece = bytes[at..end].to_vec();
                bytes.splice(at..at, piece);
            }
            4 => {
                let other = &self.seeds[dice.below(self.seeds.len())];
                let from = dice.below(other.len());
                let piece = other[from..(from + dice.below(60)).min(other.len())].to_vec();
                bytes.splice(at..end, piece);
            }
            5 => bytes.truncate(at),
            6 => {
                // A number, or a word, for another.
                let is_part = |byte: &u8| byte.is_ascii_alphanumeric() || b".+-".contains(byte);
                let from = at - bytes[..at].iter().rev().take_while(|byte| is_part(byte)).count();
                let to = at + bytes[at..].iter().take_while(|byte| is_part(byte)).count();
                bytes.splice(from..to, WORDS[dice.below(WORDS.len())].bytes());
            }
            _ => {
                // Eight bytes of a binary number.
                let number =
                    [u64::MAX, 0, 1 << 63, 1 << 32, 5_000_000_000, f64::NAN.to_bits(), f64::INFINITY.to_bits(), (-1.0f64).to_bits()]
                        [dice.below(8)];
                let end = (at + 8).min(bytes.len());
                bytes.splice(at..end, number.to_le_bytes());
            }
        }
    }
}
