//! Numbers that look random, the same on every machine: for Lanczos' method, and for bodies that benchmarks
//! and tests make up.

#[cfg(test)]
#[path = "../tests/all/long.rs"]
pub(crate) mod long;

use embate_lanes::math;

/// A generator by SplitMix64 (Steele, Lea and Flood, OOPSLA 2014).
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// From this place on in the one long row of numbers.
    #[must_use]
    pub fn new(place: u64) -> Self {
        Self(place)
    }

    /// Number `seed` of many that begin far from each other in the row.
    #[must_use]
    pub fn apart(seed: u64) -> Self {
        Self(Self(seed).bits() ^ seed.rotate_left(32))
    }

    /// 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let x = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    }

    /// From 0 to 1, without 1.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Below `end`; 0 where that is 0.
    pub fn below(&mut self, end: usize) -> usize {
        (self.bits() % end.max(1) as u64) as usize
    }

    /// Of the normal distribution of mean 0 and variance 1, by the polar method (Marsaglia and Bray, SIAM
    /// Rev. 6 (1964) 260-264).
    pub fn normal(&mut self) -> f64 {
        loop {
            let [x, y] = [2.0 * self.unit() - 1.0, 2.0 * self.unit() - 1.0];
            let square = x * x + y * y;
            if square > 0.0 && square < 1.0 {
                return x * (-2.0 * math::ln(square) / square).sqrt();
            }
        }
    }
}
