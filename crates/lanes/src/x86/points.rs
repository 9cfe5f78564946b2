//! Eight points as components, and components as eight points, by permutations: without going through memory,
//! value by value, as in `plain`.

use super::{F64x8, plain};
use crate::Lane;
use std::arch::x86_64::*;

/// `points[first..first + 8]`, component by component.
///
/// # Safety
/// The machine must have AVX-512.
#[inline(always)]
pub(super) unsafe fn load<const D: usize>(points: &[[f64; D]], first: usize) -> [F64x8; D] {
    let all = points[first..first + 8].as_flattened();
    let mut out = [F64x8::splat(0.0); D];
    // SAFETY: the slice above holds eight values for each component; the instructions are there as for
    // the operators.
    unsafe {
        let mut rows = [_mm512_setzero_pd(); D];
        for (row, values) in rows.iter_mut().zip(all.chunks_exact(8)) {
            *row = _mm512_loadu_pd(values.as_ptr());
        }
        match D {
            2 => {
                out[0] = F64x8(_mm512_permutex2var_pd(rows[0], _mm512_setr_epi64(0, 2, 4, 6, 8, 10, 12, 14), rows[1]));
                out[1] = F64x8(_mm512_permutex2var_pd(rows[0], _mm512_setr_epi64(1, 3, 5, 7, 9, 11, 13, 15), rows[1]));
            }
            3 => {
                // Five or six from the first two rows, the others from the third.
                let parts = [
                    [_mm512_setr_epi64(0, 3, 6, 9, 12, 15, 0, 0), _mm512_setr_epi64(0, 1, 2, 3, 4, 5, 10, 13)],
                    [_mm512_setr_epi64(1, 4, 7, 10, 13, 0, 0, 0), _mm512_setr_epi64(0, 1, 2, 3, 4, 8, 11, 14)],
                    [_mm512_setr_epi64(2, 5, 8, 11, 14, 0, 0, 0), _mm512_setr_epi64(0, 1, 2, 3, 4, 9, 12, 15)],
                ];
                for (out, [near, far]) in out.iter_mut().zip(parts) {
                    *out = F64x8(_mm512_permutex2var_pd(_mm512_permutex2var_pd(rows[0], near, rows[1]), far, rows[2]));
                }
            }
            4 => {
                let halves = [_mm512_setr_epi64(0, 4, 8, 12, 1, 5, 9, 13), _mm512_setr_epi64(2, 6, 10, 14, 3, 7, 11, 15)];
                let ends = [_mm512_setr_epi64(0, 1, 2, 3, 8, 9, 10, 11), _mm512_setr_epi64(4, 5, 6, 7, 12, 13, 14, 15)];
                for (pair, half) in out.chunks_exact_mut(2).zip(halves) {
                    let first = _mm512_permutex2var_pd(rows[0], half, rows[1]);
                    let last = _mm512_permutex2var_pd(rows[2], half, rows[3]);
                    pair[0] = F64x8(_mm512_permutex2var_pd(first, ends[0], last));
                    pair[1] = F64x8(_mm512_permutex2var_pd(first, ends[1], last));
                }
            }
            _ => return plain::load_points(points, first),
        }
    }
    out
}

/// Components to `points[first..first + 8]`.
///
/// # Safety
/// The machine must have AVX-512.
#[inline(always)]
pub(super) unsafe fn store<const D: usize>(values: [F64x8; D], points: &mut [[f64; D]], first: usize) {
    let all = points[first..first + 8].as_flattened_mut();
    // SAFETY: as in `load`.
    unsafe {
        let mut rows = [_mm512_setzero_pd(); D];
        match D {
            2 => {
                let (x, y) = (values[0].0, values[1].0);
                rows[0] = _mm512_permutex2var_pd(x, _mm512_setr_epi64(0, 8, 1, 9, 2, 10, 3, 11), y);
                rows[1] = _mm512_permutex2var_pd(x, _mm512_setr_epi64(4, 12, 5, 13, 6, 14, 7, 15), y);
            }
            3 => {
                let (x, y, z) = (values[0].0, values[1].0, values[2].0);
                // x and y first, then z between them.
                let parts = [
                    [_mm512_setr_epi64(0, 8, 0, 1, 9, 0, 2, 10), _mm512_setr_epi64(0, 1, 8, 3, 4, 9, 6, 7)],
                    [_mm512_setr_epi64(0, 3, 11, 0, 4, 12, 0, 5), _mm512_setr_epi64(10, 1, 2, 11, 4, 5, 12, 7)],
                    [_mm512_setr_epi64(13, 0, 6, 14, 0, 7, 15, 0), _mm512_setr_epi64(0, 13, 2, 3, 14, 5, 6, 15)],
                ];
                for (row, [near, far]) in rows.iter_mut().zip(parts) {
                    *row = _mm512_permutex2var_pd(_mm512_permutex2var_pd(x, near, y), far, z);
                }
            }
            4 => {
                let halves = [_mm512_setr_epi64(0, 8, 1, 9, 2, 10, 3, 11), _mm512_setr_epi64(4, 12, 5, 13, 6, 14, 7, 15)];
                let ends = [_mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11), _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15)];
                for (pair, half) in rows.chunks_exact_mut(2).zip(halves) {
                    let near = _mm512_permutex2var_pd(values[0].0, half, values[1].0);
                    let far = _mm512_permutex2var_pd(values[2].0, half, values[3].0);
                    pair[0] = _mm512_permutex2var_pd(near, ends[0], far);
                    pair[1] = _mm512_permutex2var_pd(near, ends[1], far);
                }
            }
            _ => return plain::store_points(values, points, first),
        }
        for (row, values) in rows.iter().zip(all.chunks_exact_mut(8)) {
            _mm512_storeu_pd(values.as_mut_ptr(), *row);
        }
    }
}
