//! Natural logarithm, exponential, power and cube root from correctly rounded operations: the same bits on every machine.

use crate::Lane;

const LN2_HIGH: f64 = 6.931_471_803_691_238e-1; // leading 32 bits of ln 2: exact times a small whole number
const LN2_LOW: f64 = 1.908_214_929_270_587_7e-10;

/// Natural logarithm of positive normal numbers, relative error below 4e-16 times the condition of the sum near one.
///
/// x = m 2^e with m in [√½, √2); ln m = 2 artanh(s), s = (m − 1)/(m + 1), by its odd series to s^23.
#[inline(always)]
pub fn ln<L: Lane>(x: L) -> L {
    let (m, e) = x.split();
    let big = L::splat(std::f64::consts::SQRT_2).less(m);
    let m = L::select(big, m * L::splat(0.5), m);
    let e = L::select(big, e + L::splat(1.0), e);
    let s = (m - L::splat(1.0)) / (m + L::splat(1.0));
    let z = s * s;
    let mut p = L::splat(2.0 / 23.0);
    for k in [21.0, 19.0, 17.0, 15.0, 13.0, 11.0, 9.0, 7.0, 5.0, 3.0] {
        p = p * z + L::splat(2.0 / k);
    }
    let tail = s * z * p + e * L::splat(LN2_LOW);
    e * L::splat(LN2_HIGH) + (s + s + tail)
}

/// Exponential, relative error below 4e-16; arguments are clamped to [-708, 709], where results are normal and finite.
///
/// x = k ln 2 + r with |r| ≤ ½ ln 2; e^r by its Taylor series to r^13.
#[inline(always)]
pub fn exp<L: Lane>(x: L) -> L {
    let x = x.max(L::splat(-708.0)).min(L::splat(709.0));
    let magic = L::splat(6_755_399_441_055_744.0); // 1.5 2^52: adding it rounds to a whole number
    let k = (x * L::splat(std::f64::consts::LOG2_E) + magic) - magic;
    let r = (x - k * L::splat(LN2_HIGH)) - k * L::splat(LN2_LOW);
    let mut p = L::splat(1.0 / 6_227_020_800.0);
    for factorial in [479_001_600.0, 39_916_800.0, 3_628_800.0, 362_880.0, 40_320.0, 5_040.0, 720.0, 120.0, 24.0, 6.0, 2.0] {
        p = p * r + L::splat(1.0 / factorial);
    }
    (L::splat(1.0) + (r + r * r * p)) * k.power_of_two()
}

/// x to the power of y for x ≥ 0 and y > 0: e^{y ln x}; zero (and whatever is not positive and normal) gives zero.
///
/// The logarithm's error is multiplied by y ln x: relative error below 5e-16 (1 + |y ln x|). Results keep within the limits of [`exp`].
#[inline(always)]
pub fn pow<L: Lane>(x: L, y: L) -> L {
    let least = L::splat(f64::MIN_POSITIVE);
    L::select(x.less(least), L::splat(0.0), exp(y * ln(x.max(least))))
}

/// Cube root of positive normal numbers, relative error below 1e-15.
///
/// e^{ln(x)/3}, then one Newton step y ← y − (y³ − x)/(3 y²).
#[inline(always)]
pub fn cbrt<L: Lane>(x: L) -> L {
    let y = exp(ln(x) * L::splat(1.0 / 3.0));
    let square = y * y;
    y - (square * y - x) / (square * L::splat(3.0))
}
