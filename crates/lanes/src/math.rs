//! Natural logarithm, exponential, power and cube root from correctly rounded operations: the same bits on
//! every machine.
//!
//! Polynomials interpolate at Chebyshev's points and are summed in pairs, pairs of pairs and so on (Estrin):
//! a quarter of the time of Horner's chain where the next operation waits for the last.

use crate::Lane;

const LN2_HIGH: f64 = 6.931_471_803_691_238e-1; // leading 32 bits of ln 2: exact times a small whole number
const LN2_LOW: f64 = 1.908_214_929_270_587_7e-10;

/// (2 artanh(s) / s − 2) / s² over s², for s² up to (√2 − 1)² / (√2 + 1)²; times s²/2 right to 5e-18.
const ARTANH: [f64; 7] = [
    0.666_666_666_666_667,
    0.399_999_999_998_994_44,
    0.285_714_286_260_032_7,
    0.222_222_111_302_598_78,
    0.181_828_894_556_749_47,
    0.153_317_106_182_107_73,
    0.146_165_854_248_886_23,
];
/// (e^r − 1 − r) / r² over r, for |r| up to 0.35; right to 5e-18.
const ABOVE_TANGENT: [f64; 11] = [
    0.5,
    0.166_666_666_666_666_7,
    0.041_666_666_666_666_67,
    0.008_333_333_333_325_551,
    0.001_388_888_888_888_333_2,
    0.000_198_412_698_768_403_57,
    2.480_158_732_699_005e-5,
    2.755_725_286_336_732e-6,
    2.755_727_183_153_613e-7,
    2.510_626_255_087_907_8e-8,
    2.091_543_359_807_600_3e-9,
];
/// Where ½ ln 2 is not reached.
const SMALL: f64 = 0.346;
/// m^{-1/3} over m, for m from 1 to 2; right to 3e-4.
const INVERSE_ROOT: [f64; 4] = [1.537_760_266_272_87, -0.801_274_569_663_737_3, 0.311_847_268_173_159_6, -0.048_633_053_342_838_85];

/// c_i + c_{i+1} x.
#[inline(always)]
fn pair<L: Lane>(coefficients: &[f64], i: usize, x: L) -> L {
    L::splat(coefficients[i]) + L::splat(coefficients[i + 1]) * x
}

/// Natural logarithm of positive normal numbers, relative error below 4e-16 times the condition of the sum
/// near one.
///
/// x = m 2^e with m in [√½, √2); ln m = 2 artanh(s), s = (m − 1)/(m + 1), by a polynomial in s².
#[inline(always)]
pub fn ln<L: Lane>(x: L) -> L {
    let (m, e) = x.split();
    let big = L::splat(std::f64::consts::SQRT_2).less(m);
    let m = L::select(big, m * L::splat(0.5), m);
    let e = L::select(big, e + L::splat(1.0), e);
    let s = (m - L::splat(1.0)) / (m + L::splat(1.0));
    let z = s * s;
    let square = z * z;
    let low = pair(&ARTANH, 0, z) + pair(&ARTANH, 2, z) * square;
    let high = pair(&ARTANH, 4, z) + L::splat(ARTANH[6]) * square;
    let p = low + high * (square * square);
    let tail = s * z * p + e * L::splat(LN2_LOW);
    e * L::splat(LN2_HIGH) + (s + s + tail)
}

/// x = k ln 2 + r with |r| ≤ ½ ln 2: 2^k, k, r and e^r − 1 − r.
#[inline(always)]
fn reduced<L: Lane>(x: L) -> [L; 4] {
    let x = x.max(L::splat(-708.0)).min(L::splat(709.0));
    let magic = L::splat(6_755_399_441_055_744.0); // 1.5 2^52: adding it rounds to a whole number
    let k = (x * L::splat(std::f64::consts::LOG2_E) + magic) - magic;
    let r = (x - k * L::splat(LN2_HIGH)) - k * L::splat(LN2_LOW);
    [k.power_of_two(), k, r, above_tangent(r)]
}

/// e^r − 1 − r for |r| ≤ ½ ln 2.
#[inline(always)]
fn above_tangent<L: Lane>(r: L) -> L {
    let square = r * r;
    let fourth = square * square;
    let low = pair(&ABOVE_TANGENT, 0, r) + pair(&ABOVE_TANGENT, 2, r) * square;
    let middle = pair(&ABOVE_TANGENT, 4, r) + pair(&ABOVE_TANGENT, 6, r) * square;
    let high = pair(&ABOVE_TANGENT, 8, r) + L::splat(ABOVE_TANGENT[10]) * square;
    square * ((low + middle * fourth) + high * (fourth * fourth))
}

/// Exponential, relative error below 4e-16; arguments are clamped to [-708, 709], where results are normal
/// and finite.
///
/// x = k ln 2 + r with |r| ≤ ½ ln 2; e^r by a polynomial.
#[inline(always)]
pub fn exp<L: Lane>(x: L) -> L {
    let [power, _, r, above] = reduced(x);
    (L::splat(1.0) + (r + above)) * power
}

/// x to the power of y for x ≥ 0 and y > 0: e^{y ln x}; zero (and whatever is not positive and normal) gives
/// zero.
///
/// The logarithm's error is multiplied by y ln x: relative error below 5e-16 (1 + |y ln x|). Results keep
/// within the limits of [`exp`].
#[inline(always)]
pub fn pow<L: Lane>(x: L, y: L) -> L {
    let least = L::splat(f64::MIN_POSITIVE);
    L::select(x.less(least), L::splat(0.0), exp(y * ln(x.max(least))))
}

/// e^x − 1 − x without cancellation, relative error below 1e-15; arguments as for [`exp`].
///
/// With x = k ln 2 + r: (2^k − 1 − k ln 2) + (2^k − 1) r + 2^k (e^r − 1 − r); where k is zero in all lanes,
/// the same digits come from the last term alone.
#[inline(always)]
pub fn exp_above_tangent<L: Lane>(x: L) -> L {
    // What is no number takes the long way in all lanes.
    if L::bits(x.abs().less(L::splat(SMALL))).count_ones() as usize == L::WIDTH {
        return above_tangent(x);
    }
    let [power, k, r, above] = reduced(x);
    let more = power - L::splat(1.0);
    let whole = (more - k * L::splat(LN2_HIGH)) - k * L::splat(LN2_LOW);
    (whole + more * r) + power * above
}

/// Cube root of positive normal numbers, relative error below 5e-16.
///
/// x = m 2^{e}: y ≈ x^{-1/3} from a polynomial in m and the exponent's third; with f = 1 − x y³, y ← y (1 +
/// f/3 + 2f²/9); then c = x y² and one Newton step c ← c − (c³ − x) y²/3.
#[inline(always)]
pub fn cbrt<L: Lane>(x: L) -> L {
    let (one, zero) = (L::splat(1.0), L::splat(0.0));
    let third = L::splat(1.0 / 3.0);
    let magic = L::splat(6_755_399_441_055_744.0);
    let (m, e) = x.split();
    // e = 3 t + left, left -1, 0 or 1
    let t = (e * third + magic) - magic;
    let left = e - (t + t + t);
    let part =
        L::select(zero.less(left), L::splat(0.793_700_525_984_099_7), L::select(left.less(zero), L::splat(1.259_921_049_894_873_2), one));
    let start = pair(&INVERSE_ROOT, 0, m) + pair(&INVERSE_ROOT, 2, m) * (m * m);
    let y = start * (part * (-t).power_of_two());
    let fault = one - x * (y * y * y);
    let y = y + y * fault * (third + fault * L::splat(2.0 / 9.0));
    let square = y * y;
    let c = x * square;
    c - (c * c * c - x) * (square * third)
}
