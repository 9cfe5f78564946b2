//! The trait that every lane type fulfils, and the batch that it loads from.

use crate::{Indices, Moving, Places, Room, VectorSums};
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

/// Values in a batch: the unit of storage, a multiple of every lane width.
pub const BATCH: usize = 8;

/// A batch of values, aligned to a cache line.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct Batch(pub [f64; BATCH]);

impl Batch {
    /// Eight equal values.
    #[must_use]
    pub const fn splat(value: f64) -> Self {
        Self([value; BATCH])
    }
}

impl Default for Batch {
    fn default() -> Self {
        Self::splat(0.0)
    }
}

/// `WIDTH` values that go through a kernel together.
///
/// Every method is inlined into the kernel, which [`crate::Level::run`] compiles once per instruction set.
pub trait Lane:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + Send
    + Sync
    + 'static
{
    /// Values per lane: 1, 4 or 8.
    const WIDTH: usize;
    /// Result of a comparison, one truth value per lane.
    type Mask: Copy;

    /// `WIDTH` equal values.
    fn splat(value: f64) -> Self;
    /// The `WIDTH` values of `batch` that begin at `at` (a multiple of `WIDTH`, else it panics).
    fn load(batch: &Batch, at: usize) -> Self;
    /// Writes the values to `batch` from `at` on (a multiple of `WIDTH`, else it panics).
    fn store(self, batch: &mut Batch, at: usize);
    /// Both vectors of the points in lanes `at..at + WIDTH` of a row, component by component. Panics when
    /// there are fewer points than the bound of `indices`.
    fn gather<const D: usize>(points: &Moving<D>, indices: &Indices, row: usize, at: usize) -> [[Self; D]; 2];
    /// The first or the second vectors of the points of `N` rows, at most 8: `out[a]` is of row `row + a`.
    /// Panics as [`Lane::gather`].
    fn gather_one<const D: usize, const N: usize, const SECOND: bool>(
        points: &Moving<D>,
        indices: &Indices,
        row: usize,
        at: usize,
    ) -> [[Self; D]; N];
    /// Adds `values[a]` to the sums in lanes `at..at + WIDTH` of row `row + a`: lane after lane, and in each
    /// in the order of `a`, so that the sums do not depend on the width. Panics when there are fewer sums
    /// than the bound of `indices`.
    fn scatter<const D: usize, const N: usize>(values: &[[Self; D]; N], sums: &mut VectorSums<D>, indices: &Indices, row: usize, at: usize);
    /// The values of the rooms in lanes `at..at + WIDTH` of a row, component by component. Panics when there
    /// are fewer rooms than the places need.
    fn gather_rooms(rooms: &[Room], places: &Places, row: usize, at: usize) -> [Self; 4];
    /// Writes the values of rooms, lane after lane. Panics as [`Lane::gather_rooms`].
    fn store_rooms(values: [Self; 4], rooms: &mut [Room], places: &Places, row: usize, at: usize);
    /// Components of `points[first..first + WIDTH]`. Panics when there are fewer.
    fn load_points<const D: usize>(points: &[[f64; D]], first: usize) -> [Self; D];
    /// Writes components to `points[first..first + WIDTH]`. Panics when there are fewer.
    fn store_points<const D: usize>(values: [Self; D], points: &mut [[f64; D]], first: usize);

    /// Square root, correctly rounded.
    fn sqrt(self) -> Self;
    /// Absolute value.
    fn abs(self) -> Self;
    /// `self` where `self < other`, else `other`.
    fn min(self, other: Self) -> Self;
    /// `self` where `self > other`, else `other`.
    fn max(self, other: Self) -> Self;
    /// `self < other`; false where either is NaN.
    fn less(self, other: Self) -> Self::Mask;
    /// `yes` where the mask is true, else `no`.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// Whether the mask is true anywhere.
    fn any(mask: Self::Mask) -> bool;
    /// Where either mask is true.
    fn either(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// The mask as a number: bit i is the truth value of lane i.
    fn bits(mask: Self::Mask) -> u32;

    /// Mantissa in [1, 2) and exponent of positive normal numbers: `self = mantissa 2^exponent`.
    fn split(self) -> (Self, Self);
    /// 2 to the power of `self`, which must hold whole numbers from -1022 to 1023.
    fn power_of_two(self) -> Self;
}
