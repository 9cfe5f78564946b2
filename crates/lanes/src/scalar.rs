//! `f64` as a lane of width one: the reference that the others must equal to the bit.

use crate::{Batch, Indices, Lane, Moving, Places, Room, VectorSums};

impl Lane for f64 {
    const WIDTH: usize = 1;
    type Mask = bool;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn load(batch: &Batch, at: usize) -> Self {
        batch.0[at]
    }
    #[inline(always)]
    fn store(self, batch: &mut Batch, at: usize) {
        batch.0[at] = self;
    }
    #[inline(always)]
    fn gather<const D: usize>(points: &Moving<D>, indices: &Indices, row: usize, at: usize) -> [[Self; D]; 2] {
        points.point(indices.place(row, at))
    }
    #[inline(always)]
    fn gather_one<const D: usize, const N: usize, const SECOND: bool>(
        points: &Moving<D>,
        indices: &Indices,
        row: usize,
        at: usize,
    ) -> [[Self; D]; N] {
        let mut out = [[0.0; D]; N];
        for (a, vector) in out.iter_mut().enumerate() {
            *vector = points.point(indices.place(row + a, at))[usize::from(SECOND)];
        }
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
        for (a, value) in values.iter().enumerate() {
            let sum = sums.row_mut(indices.place(row + a, at));
            for d in 0..D {
                sum[d] += value[d];
            }
        }
    }
    #[inline(always)]
    fn gather_rooms(rooms: &[Room], places: &Places, row: usize, at: usize) -> [Self; 4] {
        rooms[places.get(row, at)].0
    }
    #[inline(always)]
    fn store_rooms(values: [Self; 4], rooms: &mut [Room], places: &Places, row: usize, at: usize) {
        rooms[places.get(row, at)].0 = values;
    }
    #[inline(always)]
    fn load_points<const D: usize>(points: &[[f64; D]], first: usize) -> [Self; D] {
        points[first]
    }
    #[inline(always)]
    fn store_points<const D: usize>(values: [Self; D], points: &mut [[f64; D]], first: usize) {
        points[first] = values;
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f64::abs(self)
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if self < other { self } else { other }
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if self > other { self } else { other }
    }
    #[inline(always)]
    fn less(self, other: Self) -> bool {
        self < other
    }
    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
    #[inline(always)]
    fn any(mask: bool) -> bool {
        mask
    }
    #[inline(always)]
    fn either(a: bool, b: bool) -> bool {
        a | b
    }
    #[inline(always)]
    fn bits(mask: bool) -> u32 {
        u32::from(mask)
    }
    #[inline(always)]
    fn split(self) -> (Self, Self) {
        let bits = self.to_bits();
        let mantissa = f64::from_bits(bits & 0x000F_FFFF_FFFF_FFFF | 0x3FF0_0000_0000_0000);
        (mantissa, f64::from_bits((bits >> 52) | 0x4330_0000_0000_0000) - (4_503_599_627_370_496.0 + 1023.0))
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        f64::from_bits((self + (4_503_599_627_370_496.0 + 1023.0)).to_bits() << 52)
    }
}
