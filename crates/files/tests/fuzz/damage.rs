//! Damage to files: the same number gives the same damage.

use embate_solver::bench::Random;

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
    pub(crate) fn of(&self, dice: &mut Random) -> Vec<u8> {
        let mut bytes = self.seeds[dice.below(self.seeds.len())].clone();
        for _ in 0..=dice.below(8) {
            self.damage(&mut bytes, dice);
        }
        bytes
    }

    fn damage(&self, bytes: &mut Vec<u8>, dice: &mut Random) {
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
