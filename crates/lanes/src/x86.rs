//! Lanes of four (AVX2) and eight (AVX-512) values as newtypes over the vector registers.
//!
//! The types are private to the crate and only reach kernels through [`crate::Level::run`], which proves that the machine has
//! the instructions; that is what makes every intrinsic call below sound.

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

/// The first two components of a point in one register.
///
/// # Safety
/// `index` must be less than `points.len()`, and `D` at least 2.
#[inline(always)]
unsafe fn pair<const D: usize>(points: &[[f64; D]], index: u32) -> __m128d {
    // SAFETY: by the contract above both components lie inside the slice; unaligned loads need no alignment.
    unsafe { _mm_loadu_pd(points.as_ptr().add(index as usize).cast::<f64>()) }
}

/// The first two components of four points in one register.
///
/// # Safety
/// As for [`pair`], and the machine must have AVX-512.
#[inline(always)]
unsafe fn quad<const D: usize>(points: &[[f64; D]], index: [u32; 4]) -> __m512d {
    // SAFETY: by the contract above.
    unsafe {
        let z = _mm512_castpd128_pd512(pair(points, index[0]));
        let z = _mm512_insertf64x2::<1>(z, pair(points, index[1]));
        let z = _mm512_insertf64x2::<2>(z, pair(points, index[2]));
        _mm512_insertf64x2::<3>(z, pair(points, index[3]))
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
    fn gather<const D: usize>(points: &[[f64; D]], indices: &Indices, row: usize, at: usize) -> [Self; D] {
        let index = indices.checked(points, row, at, 4);
        let mut out = [Self::splat(0.0); D];
        if D == 2 {
            // SAFETY: `checked` has shown that every index is below `points.len()`; the instructions are there as for the operators.
            let (x, y) = unsafe {
                let even = _mm256_insertf128_pd::<1>(_mm256_castpd128_pd256(pair(points, index[0])), pair(points, index[2]));
                let odd = _mm256_insertf128_pd::<1>(_mm256_castpd128_pd256(pair(points, index[1])), pair(points, index[3]));
                (_mm256_unpacklo_pd(even, odd), _mm256_unpackhi_pd(even, odd))
            };
            out[0] = Self(x);
            out[1] = Self(y);
        } else {
            for (d, component) in out.iter_mut().enumerate() {
                // SAFETY: as for the operators.
                *component = Self(unsafe {
                    _mm256_set_pd(
                        points[index[3] as usize][d],
                        points[index[2] as usize][d],
                        points[index[1] as usize][d],
                        points[index[0] as usize][d],
                    )
                });
            }
        }
        out
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
    fn gather<const D: usize>(points: &[[f64; D]], indices: &Indices, row: usize, at: usize) -> [Self; D] {
        let index = indices.checked(points, row, at, 8);
        let mut out = [Self::splat(0.0); D];
        if D == 2 {
            // SAFETY: `checked` has shown that every index is below `points.len()`; the instructions are there as for the operators.
            let (x, y) = unsafe {
                let even = quad(points, [index[0], index[2], index[4], index[6]]);
                let odd = quad(points, [index[1], index[3], index[5], index[7]]);
                (_mm512_unpacklo_pd(even, odd), _mm512_unpackhi_pd(even, odd))
            };
            out[0] = Self(x);
            out[1] = Self(y);
        } else {
            for (d, component) in out.iter_mut().enumerate() {
                let mut batch = Batch::default();
                for (value, &node) in batch.0.iter_mut().zip(index) {
                    *value = points[node as usize][d];
                }
                *component = Self::load(&batch, 0);
            }
        }
        out
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
