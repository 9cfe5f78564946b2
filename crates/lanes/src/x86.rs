//! Lanes of four (AVX2) and eight (AVX-512) values as newtypes over the vector registers.
//!
//! The types are private to the crate and only reach kernels through [`crate::Level::run`], which proves that
//! the machine has the instructions; that is what makes every intrinsic call below sound. No closures: they
//! are compiled for the machine's baseline.

mod points;

use crate::gather::ROOM;
use crate::{Batch, Indices, Lane, Moving, Places, Room, VectorSums};
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

/// The four values of a place: in 2D both vectors, in 3D the first or the second vector and one
/// value more.
///
/// # Safety
/// `place` must be that of a point, times [`ROOM`], and the machine must have AVX.
#[inline(always)]
unsafe fn four<const D: usize, const SECOND: bool>(points: &Moving<D>, place: u16) -> __m256d {
    // SAFETY: by the contract above there are four values from there on, and batches are aligned to 64 bytes.
    unsafe { _mm256_load_pd(points.as_ptr::<SECOND>().add(usize::from(place))) }
}

/// Those of two places in one register.
///
/// # Safety
/// As for [`four`], and the machine must have AVX-512.
#[inline(always)]
unsafe fn two_fours<const D: usize, const SECOND: bool>(points: &Moving<D>, low: u16, high: u16) -> __m512d {
    // SAFETY: by the contract above.
    unsafe { _mm512_insertf64x4::<1>(_mm512_castpd256_pd512(four::<D, SECOND>(points, low)), four::<D, SECOND>(points, high)) }
}

/// The values of a room.
///
/// # Safety
/// There must be such a place, and the machine must have AVX.
#[inline(always)]
unsafe fn room(rooms: &[Room], place: u32) -> __m256d {
    // SAFETY: by the contract above; rooms are aligned to their width.
    unsafe { _mm256_load_pd(rooms.as_ptr().add(place as usize).cast()) }
}

/// Those of two in one register.
///
/// # Safety
/// As for [`room`], and the machine must have AVX-512.
#[inline(always)]
unsafe fn two_rooms(rooms: &[Room], low: u32, high: u32) -> __m512d {
    // SAFETY: by the contract above.
    unsafe { _mm512_insertf64x4::<1>(_mm512_castpd256_pd512(room(rooms, low)), room(rooms, high)) }
}

/// Writes the values of a room.
///
/// # Safety
/// As for [`room`].
#[inline(always)]
unsafe fn set_room(rooms: &mut [Room], place: u32, values: __m256d) {
    // SAFETY: as for `room`.
    unsafe { _mm256_store_pd(rooms.as_mut_ptr().add(place as usize).cast(), values) }
}

/// The first of some components as those of a vector.
#[inline(always)]
fn vector<L: Copy, const D: usize>(components: [L; 4], from: usize) -> [L; D] {
    let mut out = [components[0]; D];
    #[allow(clippy::manual_memcpy)] // they lie in registers
    for d in 0..D {
        out[d] = components[from + d];
    }
    out
}

/// Adds a vector to one of `sums`; in 3D with a fourth component, which is zero.
///
/// # Safety
/// `place` must be that of a sum, times [`ROOM`], `row` must hold 2 or 4 values and be aligned to 16 or 32
/// bytes, and the machine must have AVX.
#[inline(always)]
unsafe fn add_row<const D: usize>(sums: &mut VectorSums<D>, place: u16, row: *const f64) {
    // SAFETY: by the contract above all components lie inside the sums, whose rows are aligned to their
    // width.
    unsafe {
        let sum = sums.as_mut_ptr().byte_add(usize::from(place) * (size_of::<f64>() * VectorSums::<D>::WIDTH / ROOM));
        if D == 2 {
            _mm_store_pd(sum, _mm_add_pd(_mm_load_pd(sum), _mm_load_pd(row)));
        } else {
            _mm256_store_pd(sum, _mm256_add_pd(_mm256_load_pd(sum), _mm256_load_pd(row)));
        }
    }
}

/// The vectors of the lanes one after the other, as they lie in registers: those of even lanes before those
/// of odd ones.
#[repr(C, align(64))]
struct Vectors<const W: usize>([[f64; W]; 4]);

/// Does the work for each row, straight on: values that wait in registers can't be kept in a list that a loop
/// goes through.
macro_rules! each_row {
    ($rows:ident, $row:ident, $work:block) => { each_row!(@ 0 1 2 3 4 5 6 7 8 9, $rows, $row, $work) };
    (@ $($number:literal)*, $rows:ident, $row:ident, $work:block) => {
        const { assert!($rows <= 10, "more rows than are written out") };
        $(if $number < $rows {
            let $row: usize = $number;
            $work
        })*
    };
}

/// Any dimension: value by value.
mod plain {
    use crate::{Batch, Lane};

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
    /// The values of four rows of four, column by column.
    ///
    /// # Safety
    /// The machine must have AVX.
    #[inline(always)]
    unsafe fn components([r, s, t, u]: [__m256d; 4]) -> [Self; 4] {
        // SAFETY: by the contract above.
        unsafe {
            let (low, high) = ([_mm256_unpacklo_pd(r, s), _mm256_unpacklo_pd(t, u)], [_mm256_unpackhi_pd(r, s), _mm256_unpackhi_pd(t, u)]);
            [
                Self(_mm256_permute2f128_pd::<0x20>(low[0], low[1])),
                Self(_mm256_permute2f128_pd::<0x20>(high[0], high[1])),
                Self(_mm256_permute2f128_pd::<0x31>(low[0], low[1])),
                Self(_mm256_permute2f128_pd::<0x31>(high[0], high[1])),
            ]
        }
    }

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
    fn gather<const D: usize>(points: &Moving<D>, indices: &Indices, row: usize, at: usize) -> [[Self; D]; 2] {
        let [place] = indices.checked::<1>(points.len(), row, at, 4);
        // SAFETY: `checked` has shown that every place is one of the points; the instructions are there as
        // for the operators.
        let all = unsafe {
            Self::components([
                four::<D, false>(points, place[at]),
                four::<D, false>(points, place[at + 1]),
                four::<D, false>(points, place[at + 2]),
                four::<D, false>(points, place[at + 3]),
            ])
        };
        if D == 2 {
            return [vector(all, 0), vector(all, 2)];
        }
        let [second] = Self::gather_one::<D, 1, true>(points, indices, row, at);
        [vector(all, 0), second]
    }
    #[inline(always)]
    fn gather_one<const D: usize, const N: usize, const SECOND: bool>(
        points: &Moving<D>,
        indices: &Indices,
        row: usize,
        at: usize,
    ) -> [[Self; D]; N] {
        let places = indices.checked::<N>(points.len(), row, at, 4);
        let from = if D == 2 && SECOND { 2 } else { 0 };
        let mut out = [[Self::splat(0.0); D]; N];
        each_row!(N, a, {
            let place = &places[a];
            // SAFETY: `checked` has shown that every place is one of the points; the instructions are there
            // as for the operators.
            out[a] = vector(
                unsafe {
                    Self::components([
                        four::<D, SECOND>(points, place[at]),
                        four::<D, SECOND>(points, place[at + 1]),
                        four::<D, SECOND>(points, place[at + 2]),
                        four::<D, SECOND>(points, place[at + 3]),
                    ])
                },
                from,
            );
        });
        out
    }
    #[inline(always)]
    fn scatter<const D: usize, const N: usize>(
        values: &[[Self; D]; N],
        sums: &mut VectorSums<D>,
        indices: &Indices,
        row: usize,
        at: usize,
    ) {
        let rows = indices.checked::<N>(sums.len(), row, at, 4);
        let mut all = [const { Vectors([[0.0; 4]; 4]) }; N];
        for (vector, all) in values.iter().zip(&mut all) {
            let all = all.0.as_flattened_mut();
            // SAFETY: there are sixteen values, aligned to 64 bytes; the instructions are there as for the
            // operators.
            unsafe {
                let (even, odd) = (_mm256_unpacklo_pd(vector[0].0, vector[1].0), _mm256_unpackhi_pd(vector[0].0, vector[1].0));
                if D == 2 {
                    _mm256_store_pd(all[..4].as_mut_ptr(), even);
                    _mm256_store_pd(all[4..].as_mut_ptr(), odd);
                } else {
                    let (zero, z) = (_mm256_setzero_pd(), vector[2].0);
                    let (rest, odd_rest) = (_mm256_unpacklo_pd(z, zero), _mm256_unpackhi_pd(z, zero));
                    _mm256_store_pd(all[..4].as_mut_ptr(), _mm256_permute2f128_pd::<0x20>(even, rest));
                    _mm256_store_pd(all[4..].as_mut_ptr(), _mm256_permute2f128_pd::<0x31>(even, rest));
                    _mm256_store_pd(all[8..].as_mut_ptr(), _mm256_permute2f128_pd::<0x20>(odd, odd_rest));
                    _mm256_store_pd(all[12..].as_mut_ptr(), _mm256_permute2f128_pd::<0x31>(odd, odd_rest));
                }
            }
        }
        for lane in 0..4 {
            for a in 0..N {
                let place = (lane % 2 * 2 + lane / 2) * VectorSums::<D>::WIDTH;
                // SAFETY: `checked` has shown that every place is one of the sums; vectors lie at multiples
                // of their width.
                unsafe { add_row(sums, rows[a][at + lane], all[a].0.as_flattened().as_ptr().add(place)) };
            }
        }
    }
    #[inline(always)]
    fn gather_rooms(rooms: &[Room], places: &Places, row: usize, at: usize) -> [Self; 4] {
        let place = places.checked(rooms.len(), row, at, 4);
        // SAFETY: `checked` has shown that every place is one of the rooms; the instructions are there as for
        // the operators.
        unsafe {
            Self::components([room(rooms, place[at]), room(rooms, place[at + 1]), room(rooms, place[at + 2]), room(rooms, place[at + 3])])
        }
    }
    #[inline(always)]
    fn store_rooms(values: [Self; 4], rooms: &mut [Room], places: &Places, row: usize, at: usize) {
        let place = places.checked(rooms.len(), row, at, 4);
        // SAFETY: as for the gather; the transpose of a transpose is what was.
        unsafe {
            for (lane, four) in Self::components(values.map(|value| value.0)).into_iter().enumerate() {
                set_room(rooms, place[at + lane], four.0);
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
    /// The values of eight rows of four, column by column: of the first four rows in the low halves.
    ///
    /// # Safety
    /// The machine must have AVX-512.
    #[inline(always)]
    unsafe fn components([r, s, t, u]: [__m512d; 4]) -> [Self; 4] {
        // SAFETY: by the contract above.
        unsafe {
            let (low, high) = ([_mm512_unpacklo_pd(r, s), _mm512_unpacklo_pd(t, u)], [_mm512_unpackhi_pd(r, s), _mm512_unpackhi_pd(t, u)]);
            let (former, latter) = (_mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13), _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15));
            [
                Self(_mm512_permutex2var_pd(low[0], former, low[1])),
                Self(_mm512_permutex2var_pd(high[0], former, high[1])),
                Self(_mm512_permutex2var_pd(low[0], latter, low[1])),
                Self(_mm512_permutex2var_pd(high[0], latter, high[1])),
            ]
        }
    }

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
    fn gather<const D: usize>(points: &Moving<D>, indices: &Indices, row: usize, at: usize) -> [[Self; D]; 2] {
        let [place] = indices.checked::<1>(points.len(), row, at, 8);
        // SAFETY: `checked` has shown that every place is one of the points; the instructions are there as
        // for the operators.
        let all = unsafe {
            Self::components([
                two_fours::<D, false>(points, place[0], place[4]),
                two_fours::<D, false>(points, place[1], place[5]),
                two_fours::<D, false>(points, place[2], place[6]),
                two_fours::<D, false>(points, place[3], place[7]),
            ])
        };
        if D == 2 {
            return [vector(all, 0), vector(all, 2)];
        }
        let [second] = Self::gather_one::<D, 1, true>(points, indices, row, at);
        [vector(all, 0), second]
    }
    #[inline(always)]
    fn gather_one<const D: usize, const N: usize, const SECOND: bool>(
        points: &Moving<D>,
        indices: &Indices,
        row: usize,
        at: usize,
    ) -> [[Self; D]; N] {
        let places = indices.checked::<N>(points.len(), row, at, 8);
        let from = if D == 2 && SECOND { 2 } else { 0 };
        let mut out = [[Self::splat(0.0); D]; N];
        each_row!(N, a, {
            let place = &places[a];
            // SAFETY: `checked` has shown that every place is one of the points; the instructions are there
            // as for the operators.
            out[a] = vector(
                unsafe {
                    Self::components([
                        two_fours::<D, SECOND>(points, place[0], place[4]),
                        two_fours::<D, SECOND>(points, place[1], place[5]),
                        two_fours::<D, SECOND>(points, place[2], place[6]),
                        two_fours::<D, SECOND>(points, place[3], place[7]),
                    ])
                },
                from,
            );
        });
        out
    }
    #[inline(always)]
    fn scatter<const D: usize, const N: usize>(
        values: &[[Self; D]; N],
        sums: &mut VectorSums<D>,
        indices: &Indices,
        row: usize,
        at: usize,
    ) {
        let rows = indices.checked::<N>(sums.len(), row, at, 8);
        let mut all = [const { Vectors([[0.0; 8]; 4]) }; N];
        for (vector, all) in values.iter().zip(&mut all) {
            let all = all.0.as_flattened_mut();
            // SAFETY: there are 32 values, aligned to 64 bytes; the instructions are there as for the
            // operators.
            unsafe {
                let (even, odd) = (_mm512_unpacklo_pd(vector[0].0, vector[1].0), _mm512_unpackhi_pd(vector[0].0, vector[1].0));
                if D == 2 {
                    _mm512_store_pd(all[..8].as_mut_ptr(), even);
                    _mm512_store_pd(all[8..].as_mut_ptr(), odd);
                } else {
                    let (zero, z) = (_mm512_setzero_pd(), vector[2].0);
                    let (rest, odd_rest) = (_mm512_unpacklo_pd(z, zero), _mm512_unpackhi_pd(z, zero));
                    let (former, latter) = (_mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11), _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15));
                    _mm512_store_pd(all[..8].as_mut_ptr(), _mm512_permutex2var_pd(even, former, rest));
                    _mm512_store_pd(all[8..].as_mut_ptr(), _mm512_permutex2var_pd(even, latter, rest));
                    _mm512_store_pd(all[16..].as_mut_ptr(), _mm512_permutex2var_pd(odd, former, odd_rest));
                    _mm512_store_pd(all[24..].as_mut_ptr(), _mm512_permutex2var_pd(odd, latter, odd_rest));
                }
            }
        }
        #[allow(clippy::needless_range_loop)] // lanes are summed one after the other, corner by corner
        for lane in 0..8 {
            for a in 0..N {
                let place = (lane % 2 * 4 + lane / 2) * VectorSums::<D>::WIDTH;
                // SAFETY: `checked` has shown that every place is one of the sums; vectors lie at multiples
                // of their width.
                unsafe { add_row(sums, rows[a][lane], all[a].0.as_flattened().as_ptr().add(place)) };
            }
        }
    }
    #[inline(always)]
    fn gather_rooms(rooms: &[Room], places: &Places, row: usize, at: usize) -> [Self; 4] {
        let place = places.checked(rooms.len(), row, at, 8);
        // SAFETY: `checked` has shown that every place is one of the rooms; the instructions are there as for
        // the operators.
        unsafe {
            Self::components([
                two_rooms(rooms, place[0], place[4]),
                two_rooms(rooms, place[1], place[5]),
                two_rooms(rooms, place[2], place[6]),
                two_rooms(rooms, place[3], place[7]),
            ])
        }
    }
    #[inline(always)]
    fn store_rooms(values: [Self; 4], rooms: &mut [Room], places: &Places, row: usize, at: usize) {
        let place = places.checked(rooms.len(), row, at, 8);
        // SAFETY: as for the gather; each half is transposed for itself, and the transpose of a transpose is
        // what was.
        unsafe {
            let [r, s, t, u] = Self::components(values.map(|value| value.0));
            for (lane, two) in [r, s, t, u].into_iter().enumerate() {
                set_room(rooms, place[lane], _mm512_castpd512_pd256(two.0));
            }
            for (lane, two) in [r, s, t, u].into_iter().enumerate() {
                set_room(rooms, place[lane + 4], _mm512_extractf64x4_pd::<1>(two.0));
            }
        }
    }
    #[inline(always)]
    fn load_points<const D: usize>(points: &[[f64; D]], first: usize) -> [Self; D] {
        // SAFETY: the type exists only where `Level` has proved the instruction set.
        unsafe { points::load(points, first) }
    }
    #[inline(always)]
    fn store_points<const D: usize>(values: [Self; D], points: &mut [[f64; D]], first: usize) {
        // SAFETY: as for loading.
        unsafe { points::store(values, points, first) }
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
