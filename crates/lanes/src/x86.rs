//! Lanes of four (AVX2) and eight (AVX-512) values as newtypes over the vector registers.
//!
//! The types are private to the crate and only reach kernels through [`crate::Level::run`], which proves that the machine has
//! the instructions; that is what makes every intrinsic call below sound. No closures: they are compiled for the machine's baseline.

use crate::{Batch, Indices, Lane};
use std::arch::x86_64::*;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

/// Four values in an AVX register.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub struct F64x4(__m256d);

/// Eight values in an AVX-512 register.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub struct F64x8(__m512d);

/// The first four of the components of both vectors of a point in one register: all of the plane, of space the first vector and one more.
///
/// # Safety
/// `index` must be less than `points.len()`, `D` must be 2 or 3, and the machine must have AVX.
#[inline(always)]
unsafe fn point<const D: usize>(points: &[[[f64; D]; 2]], index: u16) -> __m256d {
    // SAFETY: by the contract above there are at least four components in each point of the slice; unaligned loads need no alignment.
    unsafe { _mm256_loadu_pd(points.as_ptr().add(usize::from(index)).cast::<f64>()) }
}

/// The last two components of the second vectors of two points of space in one register.
///
/// # Safety
/// As for [`point`], but that `D` must be 3.
#[inline(always)]
unsafe fn two_rests<const D: usize>(points: &[[[f64; D]; 2]], low: u16, high: u16) -> __m256d {
    // SAFETY: by the contract above each point has six components; unaligned loads need no alignment.
    unsafe {
        let low = points.as_ptr().add(usize::from(low)).cast::<f64>().add(4);
        let high = points.as_ptr().add(usize::from(high)).cast::<f64>().add(4);
        _mm256_insertf128_pd::<1>(_mm256_castpd128_pd256(_mm_loadu_pd(low)), _mm_loadu_pd(high))
    }
}

/// Both vectors from their components in turn, the first four and the last two; of the plane there are four.
#[inline(always)]
fn vectors<L: Copy, const D: usize>(first: [L; 4], last: [L; 2]) -> [[L; D]; 2] {
    let all = [first[0], first[1], first[2], first[3], last[0], last[1]];
    let mut out = [[all[0]; D]; 2];
    for k in 0..2 {
        for d in 0..D {
            out[k][d] = all[k * D + d];
        }
    }
    out
}

/// Two points in one register.
///
/// # Safety
/// As for [`point`], and the machine must have AVX-512.
#[inline(always)]
unsafe fn two_points<const D: usize>(points: &[[[f64; D]; 2]], low: u16, high: u16) -> __m512d {
    // SAFETY: by the contract above.
    unsafe { _mm512_insertf64x4::<1>(_mm512_castpd256_pd512(point(points, low)), point(points, high)) }
}

/// Adds a vector of the plane, or the first two components of one of space, to one of `sums`.
///
/// # Safety
/// `index` must be less than `sums.len()`, `D` must be at least 2, and `pair` must be aligned to 16 bytes.
#[inline(always)]
unsafe fn add_pair<const D: usize>(sums: &mut [[f64; D]], index: u16, pair: &[f64; 2]) {
    // SAFETY: by the contract above both components lie inside the slice; its loads and stores need no alignment.
    unsafe {
        let sum = sums.as_mut_ptr().add(usize::from(index)).cast::<f64>();
        _mm_storeu_pd(sum, _mm_add_pd(_mm_loadu_pd(sum), _mm_load_pd(pair.as_ptr())));
    }
}

/// Adds the third component of a vector of space to one of `sums`.
///
/// # Safety
/// `index` must be less than `sums.len()`, and `D` must be 3.
#[inline(always)]
unsafe fn add_third<const D: usize>(sums: &mut [[f64; D]], index: u16, value: f64) {
    // SAFETY: by the contract above there is such a component.
    unsafe { *sums.as_mut_ptr().add(usize::from(index)).cast::<f64>().add(2) += value };
}

/// Pairs of components of the lanes, as they lie in a register or two.
#[repr(C, align(64))]
struct Pairs<const W: usize>([[f64; 2]; W]);

/// Any dimension: value by value.
mod plain {
    use crate::{Batch, Indices, Lane};

    #[inline(always)]
    pub(super) fn gather<L: Lane, const D: usize>(points: &[[[f64; D]; 2]], indices: &Indices, row: usize, at: usize) -> [[L; D]; 2] {
        let indices = &indices.row(row)[at..at + L::WIDTH];
        let mut out = [[L::splat(0.0); D]; 2];
        for (k, vector) in out.iter_mut().enumerate() {
            for (d, component) in vector.iter_mut().enumerate() {
                let mut batch = Batch::default();
                for (value, &index) in batch.0.iter_mut().zip(indices) {
                    *value = points[usize::from(index)][k][d];
                }
                *component = L::load(&batch, 0);
            }
        }
        out
    }

    #[inline(always)]
    pub(super) fn scatter<L: Lane, const D: usize, const N: usize>(
        values: &[[L; D]; N],
        sums: &mut [[f64; D]],
        indices: &Indices,
        row: usize,
        at: usize,
    ) {
        let mut batches = [[Batch::default(); D]; N];
        for (vector, batches) in values.iter().zip(&mut batches) {
            for (value, batch) in vector.iter().zip(batches) {
                value.store(batch, 0);
            }
        }
        for lane in 0..L::WIDTH {
            for (a, batches) in batches.iter().enumerate() {
                let sum = &mut sums[usize::from(indices.row(row + a)[at + lane])];
                for d in 0..D {
                    sum[d] += batches[d].0[lane];
                }
            }
        }
    }

    #[inline(always)]
    pub(super) fn load_points<L: Lane, const D: usize>(points: &[[f64; D]], first: usize) -> [L; D] {
        let points = &points[first..first + L::WIDTH];
        let mut out = [L::splat(0.0); D];
        for (d, component) in out.iter_mut().enumerate() {
            let mut batch = Batch::default();
            for (value, point) in batch.0.iter_mut().zip(points) {
                *value = point[d];
            }
            *component = L::load(&batch, 0);
        }
        out
    }

    #[inline(always)]
    pub(super) fn store_points<L: Lane, const D: usize>(values: [L; D], points: &mut [[f64; D]], first: usize) {
        let mut batches = [Batch::default(); D];
        for (value, batch) in values.iter().zip(&mut batches) {
            value.store(batch, 0);
        }
        for (lane, point) in points[first..first + L::WIDTH].iter_mut().enumerate() {
            for (value, batch) in point.iter_mut().zip(&batches) {
                *value = batch.0[lane];
            }
        }
    }
}

macro_rules! operator {
    ($lane:ident, $trait:ident, $method:ident, $intrinsic:ident) => {
        impl $trait for $lane {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // SAFETY: the type exists only where `Level` has proved the instruction set.
                Self(unsafe { $intrinsic(self.0, other.0) })
            }
        }
    };
}

macro_rules! operators {
    ($lane:ident, $add:ident, $sub:ident, $mul:ident, $div:ident) => {
        operator!($lane, Add, add, $add);
        operator!($lane, Sub, sub, $sub);
        operator!($lane, Mul, mul, $mul);
        operator!($lane, Div, div, $div);
        impl AddAssign for $lane {
            #[inline(always)]
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }
        impl Neg for $lane {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                self.flip_sign()
            }
        }
    };
}

operators!(F64x4, _mm256_add_pd, _mm256_sub_pd, _mm256_mul_pd, _mm256_div_pd);
operators!(F64x8, _mm512_add_pd, _mm512_sub_pd, _mm512_mul_pd, _mm512_div_pd);

/// 2^52 + 1023: added to a biased exponent's bit pattern or to a whole number, it moves between the two.
const EXPONENT_MAGIC: f64 = 4_503_599_627_370_496.0 + 1023.0;

impl F64x4 {
    #[inline(always)]
    fn flip_sign(self) -> Self {
        // SAFETY: as for the operators.
        Self(unsafe { _mm256_xor_pd(self.0, _mm256_set1_pd(-0.0)) })
    }
}

impl Lane for F64x4 {
    const WIDTH: usize = 4;
    type Mask = __m256d;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        // SAFETY: as for the operators.
        Self(unsafe { _mm256_set1_pd(value) })
    }
    #[inline(always)]
    fn load(batch: &Batch, at: usize) -> Self {
        let values = &batch.0[at..at + 4];
        // SAFETY: the slice above holds four values; unaligned loads need no alignment.
        Self(unsafe { _mm256_loadu_pd(values.as_ptr()) })
    }
    #[inline(always)]
    fn store(self, batch: &mut Batch, at: usize) {
        let values = &mut batch.0[at..at + 4];
        // SAFETY: the slice above holds four values; unaligned stores need no alignment.
        unsafe { _mm256_storeu_pd(values.as_mut_ptr(), self.0) }
    }
    #[inline(always)]
    fn gather<const D: usize>(points: &[[[f64; D]; 2]], indices: &Indices, row: usize, at: usize) -> [[Self; D]; 2] {
        if D != 2 && D != 3 {
            return plain::gather(points, indices, row, at);
        }
        let [index] = indices.checked::<_, 1>(points, row, at, 4);
        // SAFETY: `checked` has shown that every index is below `points.len()`; the instructions are there as for the operators.
        let [x, y, u, v] = unsafe {
            let (a, b) = (point(points, index[at]), point(points, index[at + 1]));
            let (c, d) = (point(points, index[at + 2]), point(points, index[at + 3]));
            let [ab, cd] = [_mm256_unpacklo_pd(a, b), _mm256_unpacklo_pd(c, d)];
            let [ab_high, cd_high] = [_mm256_unpackhi_pd(a, b), _mm256_unpackhi_pd(c, d)];
            [
                _mm256_permute2f128_pd::<0x20>(ab, cd),
                _mm256_permute2f128_pd::<0x20>(ab_high, cd_high),
                _mm256_permute2f128_pd::<0x31>(ab, cd),
                _mm256_permute2f128_pd::<0x31>(ab_high, cd_high),
            ]
        };
        let first = [Self(x), Self(y), Self(u), Self(v)];
        if D == 2 {
            return vectors(first, [Self(x); 2]);
        }
        // SAFETY: as above.
        let last = unsafe {
            let (even, odd) = (two_rests(points, index[at], index[at + 2]), two_rests(points, index[at + 1], index[at + 3]));
            [_mm256_unpacklo_pd(even, odd), _mm256_unpackhi_pd(even, odd)]
        };
        vectors(first, [Self(last[0]), Self(last[1])])
    }
    #[inline(always)]
    fn scatter<const D: usize, const N: usize>(values: &[[Self; D]; N], sums: &mut [[f64; D]], indices: &Indices, row: usize, at: usize) {
        if D != 2 && D != 3 {
            return plain::scatter(values, sums, indices, row, at);
        }
        let rows = indices.checked::<_, N>(sums, row, at, 4);
        let mut pairs = [const { Pairs([[0.0; 2]; 4]) }; N];
        for (vector, pairs) in values.iter().zip(&mut pairs) {
            let all = pairs.0.as_flattened_mut();
            // SAFETY: there are eight values, aligned to 64 bytes; the instructions are there as for the operators.
            unsafe {
                _mm256_store_pd(all[..4].as_mut_ptr(), _mm256_unpacklo_pd(vector[0].0, vector[1].0));
                _mm256_store_pd(all[4..].as_mut_ptr(), _mm256_unpackhi_pd(vector[0].0, vector[1].0));
            }
        }
        let mut thirds = [const { Batch([0.0; 8]) }; N];
        if D == 3 {
            for a in 0..N {
                values[a][2].store(&mut thirds[a], 0);
            }
        }
        for lane in 0..4 {
            for a in 0..N {
                // SAFETY: `checked` has shown that every index is below `sums.len()`; pairs lie at multiples of 16 bytes.
                unsafe { add_pair(sums, rows[a][at + lane], &pairs[a].0[lane % 2 * 2 + lane / 2]) };
                if D == 3 {
                    // SAFETY: as above.
                    unsafe { add_third(sums, rows[a][at + lane], thirds[a].0[lane]) };
                }
            }
        }
    }
    #[inline(always)]
    fn load_points<const D: usize>(points: &[[f64; D]], first: usize) -> [Self; D] {
        if D != 2 {
            return plain::load_points(points, first);
        }
        let all = points[first..first + 4].as_flattened();
        // SAFETY: the slice above holds eight values; the instructions are there as for the operators.
        let (x, y) = unsafe {
            let (a, b) = (_mm256_loadu_pd(all[..4].as_ptr()), _mm256_loadu_pd(all[4..].as_ptr()));
            (
                _mm256_permute4x64_pd::<0b11_01_10_00>(_mm256_unpacklo_pd(a, b)),
                _mm256_permute4x64_pd::<0b11_01_10_00>(_mm256_unpackhi_pd(a, b)),
            )
        };
        let mut out = [Self(x); D];
        out[1] = Self(y);
        out
    }
    #[inline(always)]
    fn store_points<const D: usize>(values: [Self; D], points: &mut [[f64; D]], first: usize) {
        if D != 2 {
            return plain::store_points(values, points, first);
        }
        let all = points[first..first + 4].as_flattened_mut();
        // SAFETY: the slice above holds eight values; the instructions are there as for the operators.
        unsafe {
            let (low, high) = (_mm256_unpacklo_pd(values[0].0, values[1].0), _mm256_unpackhi_pd(values[0].0, values[1].0));
            _mm256_storeu_pd(all[..4].as_mut_ptr(), _mm256_permute2f128_pd::<0x20>(low, high));
            _mm256_storeu_pd(all[4..].as_mut_ptr(), _mm256_permute2f128_pd::<0x31>(low, high));
        }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: as for the operators.
        Self(unsafe { _mm256_sqrt_pd(self.0) })
    }
    #[inline(always)]
    fn abs(self) -> Self {
        // SAFETY: as for the operators.
        Self(unsafe { _mm256_andnot_pd(_mm256_set1_pd(-0.0), self.0) })
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: as for the operators.
        Self(unsafe { _mm256_min_pd(self.0, other.0) })
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // SAFETY: as for the operators.
        Self(unsafe { _mm256_max_pd(self.0, other.0) })
    }
    #[inline(always)]
    fn less(self, other: Self) -> __m256d {
        // SAFETY: as for the operators.
        unsafe { _mm256_cmp_pd::<_CMP_LT_OQ>(self.0, other.0) }
    }
    #[inline(always)]
    fn select(mask: __m256d, yes: Self, no: Self) -> Self {
        // SAFETY: as for the operators.
        Self(unsafe { _mm256_blendv_pd(no.0, yes.0, mask) })
    }
    #[inline(always)]
    fn any(mask: __m256d) -> bool {
        // SAFETY: as for the operators.
        unsafe { _mm256_movemask_pd(mask) != 0 }
    }
    #[inline(always)]
    fn either(a: __m256d, b: __m256d) -> __m256d {
        // SAFETY: as for the operators.
        unsafe { _mm256_or_pd(a, b) }
    }
    #[inline(always)]
    fn bits(mask: __m256d) -> u32 {
        // SAFETY: as for the operators.
        unsafe { _mm256_movemask_pd(mask) as u32 }
    }
    #[inline(always)]
    fn split(self) -> (Self, Self) {
        // SAFETY: as for the operators.
        unsafe {
            let bits = _mm256_castpd_si256(self.0);
            let mantissa = _mm256_or_si256(
                _mm256_and_si256(bits, _mm256_set1_epi64x(0x000F_FFFF_FFFF_FFFF)),
                _mm256_set1_epi64x(0x3FF0_0000_0000_0000),
            );
            let exponent = _mm256_or_si256(_mm256_srli_epi64::<52>(bits), _mm256_set1_epi64x(0x4330_0000_0000_0000));
            (Self(_mm256_castsi256_pd(mantissa)), Self(_mm256_castsi256_pd(exponent)) - Self::splat(EXPONENT_MAGIC))
        }
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        let biased = self + Self::splat(EXPONENT_MAGIC);
        // SAFETY: as for the operators.
        Self(unsafe { _mm256_castsi256_pd(_mm256_slli_epi64::<52>(_mm256_castpd_si256(biased.0))) })
    }
}

impl F64x8 {
    #[inline(always)]
    fn flip_sign(self) -> Self {
        // SAFETY: as for the operators.
        Self(unsafe { _mm512_xor_pd(self.0, _mm512_set1_pd(-0.0)) })
    }
}

impl Lane for F64x8 {
    const WIDTH: usize = 8;
    type Mask = __mmask8;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        // SAFETY: as for the operators.
        Self(unsafe { _mm512_set1_pd(value) })
    }
    #[inline(always)]
    fn load(batch: &Batch, at: usize) -> Self {
        let values = &batch.0[at..at + 8];
        // SAFETY: the slice above holds eight values; unaligned loads need no alignment.
        Self(unsafe { _mm512_loadu_pd(values.as_ptr()) })
    }
    #[inline(always)]
    fn store(self, batch: &mut Batch, at: usize) {
        let values = &mut batch.0[at..at + 8];
        // SAFETY: the slice above holds eight values; unaligned stores need no alignment.
        unsafe { _mm512_storeu_pd(values.as_mut_ptr(), self.0) }
    }
    #[inline(always)]
    fn gather<const D: usize>(points: &[[[f64; D]; 2]], indices: &Indices, row: usize, at: usize) -> [[Self; D]; 2] {
        if D != 2 && D != 3 {
            return plain::gather(points, indices, row, at);
        }
        let [index] = indices.checked::<_, 1>(points, row, at, 8);
        // SAFETY: `checked` has shown that every index is below `points.len()`; the instructions are there as for the operators.
        let [x, y, u, v] = unsafe {
            let (a, b) = (two_points(points, index[0], index[4]), two_points(points, index[1], index[5]));
            let (c, d) = (two_points(points, index[2], index[6]), two_points(points, index[3], index[7]));
            let [ab, cd] = [_mm512_unpacklo_pd(a, b), _mm512_unpacklo_pd(c, d)];
            let [ab_high, cd_high] = [_mm512_unpackhi_pd(a, b), _mm512_unpackhi_pd(c, d)];
            let (first, second) = (_mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13), _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15));
            [
                _mm512_permutex2var_pd(ab, first, cd),
                _mm512_permutex2var_pd(ab_high, first, cd_high),
                _mm512_permutex2var_pd(ab, second, cd),
                _mm512_permutex2var_pd(ab_high, second, cd_high),
            ]
        };
        let first = [Self(x), Self(y), Self(u), Self(v)];
        if D == 2 {
            return vectors(first, [Self(x); 2]);
        }
        // SAFETY: as above.
        let last = unsafe {
            let (a, b) = (two_rests(points, index[0], index[2]), two_rests(points, index[4], index[6]));
            let (c, d) = (two_rests(points, index[1], index[3]), two_rests(points, index[5], index[7]));
            let even = _mm512_insertf64x4::<1>(_mm512_castpd256_pd512(a), b);
            let odd = _mm512_insertf64x4::<1>(_mm512_castpd256_pd512(c), d);
            [_mm512_unpacklo_pd(even, odd), _mm512_unpackhi_pd(even, odd)]
        };
        vectors(first, [Self(last[0]), Self(last[1])])
    }
    #[inline(always)]
    fn scatter<const D: usize, const N: usize>(values: &[[Self; D]; N], sums: &mut [[f64; D]], indices: &Indices, row: usize, at: usize) {
        if D != 2 && D != 3 {
            return plain::scatter(values, sums, indices, row, at);
        }
        let rows = indices.checked::<_, N>(sums, row, at, 8);
        let mut pairs = [const { Pairs([[0.0; 2]; 8]) }; N];
        for (vector, pairs) in values.iter().zip(&mut pairs) {
            let all = pairs.0.as_flattened_mut();
            // SAFETY: there are sixteen values, aligned to 64 bytes; the instructions are there as for the operators.
            unsafe {
                _mm512_store_pd(all[..8].as_mut_ptr(), _mm512_unpacklo_pd(vector[0].0, vector[1].0));
                _mm512_store_pd(all[8..].as_mut_ptr(), _mm512_unpackhi_pd(vector[0].0, vector[1].0));
            }
        }
        let mut thirds = [const { Batch([0.0; 8]) }; N];
        if D == 3 {
            for a in 0..N {
                values[a][2].store(&mut thirds[a], 0);
            }
        }
        #[allow(clippy::needless_range_loop)] // lanes are summed one after the other, corner by corner
        for lane in 0..8 {
            for a in 0..N {
                // SAFETY: `checked` has shown that every index is below `sums.len()`; pairs lie at multiples of 16 bytes.
                unsafe { add_pair(sums, rows[a][lane], &pairs[a].0[lane % 2 * 4 + lane / 2]) };
                if D == 3 {
                    // SAFETY: as above.
                    unsafe { add_third(sums, rows[a][lane], thirds[a].0[lane]) };
                }
            }
        }
    }
    #[inline(always)]
    fn load_points<const D: usize>(points: &[[f64; D]], first: usize) -> [Self; D] {
        if D != 2 {
            return plain::load_points(points, first);
        }
        let all = points[first..first + 8].as_flattened();
        // SAFETY: the slice above holds sixteen values; the instructions are there as for the operators.
        let (x, y) = unsafe {
            let (a, b) = (_mm512_loadu_pd(all[..8].as_ptr()), _mm512_loadu_pd(all[8..].as_ptr()));
            (
                _mm512_permutex2var_pd(a, _mm512_setr_epi64(0, 2, 4, 6, 8, 10, 12, 14), b),
                _mm512_permutex2var_pd(a, _mm512_setr_epi64(1, 3, 5, 7, 9, 11, 13, 15), b),
            )
        };
        let mut out = [Self(x); D];
        out[1] = Self(y);
        out
    }
    #[inline(always)]
    fn store_points<const D: usize>(values: [Self; D], points: &mut [[f64; D]], first: usize) {
        if D != 2 {
            return plain::store_points(values, points, first);
        }
        let all = points[first..first + 8].as_flattened_mut();
        // SAFETY: the slice above holds sixteen values; the instructions are there as for the operators.
        unsafe {
            let (x, y) = (values[0].0, values[1].0);
            let (low, high) = (_mm512_setr_epi64(0, 8, 1, 9, 2, 10, 3, 11), _mm512_setr_epi64(4, 12, 5, 13, 6, 14, 7, 15));
            _mm512_storeu_pd(all[..8].as_mut_ptr(), _mm512_permutex2var_pd(x, low, y));
            _mm512_storeu_pd(all[8..].as_mut_ptr(), _mm512_permutex2var_pd(x, high, y));
        }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: as for the operators.
        Self(unsafe { _mm512_sqrt_pd(self.0) })
    }
    #[inline(always)]
    fn abs(self) -> Self {
        // SAFETY: as for the operators.
        Self(unsafe { _mm512_abs_pd(self.0) })
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: as for the operators.
        Self(unsafe { _mm512_min_pd(self.0, other.0) })
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // SAFETY: as for the operators.
        Self(unsafe { _mm512_max_pd(self.0, other.0) })
    }
    #[inline(always)]
    fn less(self, other: Self) -> __mmask8 {
        // SAFETY: as for the operators.
        unsafe { _mm512_cmp_pd_mask::<_CMP_LT_OQ>(self.0, other.0) }
    }
    #[inline(always)]
    fn select(mask: __mmask8, yes: Self, no: Self) -> Self {
        // SAFETY: as for the operators.
        Self(unsafe { _mm512_mask_blend_pd(mask, no.0, yes.0) })
    }
    #[inline(always)]
    fn any(mask: __mmask8) -> bool {
        mask != 0
    }
    #[inline(always)]
    fn either(a: __mmask8, b: __mmask8) -> __mmask8 {
        a | b
    }
    #[inline(always)]
    fn bits(mask: __mmask8) -> u32 {
        u32::from(mask)
    }
    #[inline(always)]
    fn split(self) -> (Self, Self) {
        // SAFETY: as for the operators.
        unsafe {
            let bits = _mm512_castpd_si512(self.0);
            let mantissa =
                _mm512_or_si512(_mm512_and_si512(bits, _mm512_set1_epi64(0x000F_FFFF_FFFF_FFFF)), _mm512_set1_epi64(0x3FF0_0000_0000_0000));
            let exponent = _mm512_or_si512(_mm512_srli_epi64::<52>(bits), _mm512_set1_epi64(0x4330_0000_0000_0000));
            (Self(_mm512_castsi512_pd(mantissa)), Self(_mm512_castsi512_pd(exponent)) - Self::splat(EXPONENT_MAGIC))
        }
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        let biased = self + Self::splat(EXPONENT_MAGIC);
        // SAFETY: as for the operators.
        Self(unsafe { _mm512_castsi512_pd(_mm512_slli_epi64::<52>(_mm512_castpd_si512(biased.0))) })
    }
}
