//! `f64` as a lane of width one that counts what is done with it: with the feature `count` it is the scalar
//! lane, so that a kernel's operations are counted in its own text.

use crate::{Batch, Indices, Lane, Moving, Places, Room, VectorSums};
use std::cell::Cell;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

/// Operations of a thread.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    /// Additions and subtractions.
    pub additions: u64,
    /// Multiplications.
    pub multiplications: u64,
    /// Divisions.
    pub divisions: u64,
    /// Square roots.
    pub roots: u64,
    /// Comparisons, selections, signs and bit patterns.
    pub others: u64,
}

thread_local! {
    static COUNTS: Cell<Operations> = const { Cell::new(Operations { additions: 0, multiplications: 0, divisions: 0, roots: 0, others: 0 }) };
}

impl Operations {
    /// What this thread has done since it asked the last time.
    pub fn take() -> Self {
        COUNTS.take()
    }
}

/// Counts an operation.
fn count(of: impl Fn(&mut Operations) -> &mut u64) {
    count_all(of, 1);
}

fn count_all(of: impl Fn(&mut Operations) -> &mut u64, number: u64) {
    let mut counts = COUNTS.get();
    *of(&mut counts) += number;
    COUNTS.set(counts);
}

/// A counted value.
#[derive(Clone, Copy, Debug)]
pub struct Counted(f64);

impl Counted {
    fn other(value: f64) -> Self {
        count(|counts| &mut counts.others);
        Self(value)
    }
}

macro_rules! operators {
    ($($Trait:ident $function:ident $operator:tt $field:ident),*) => {$(
        impl $Trait for Counted {
            type Output = Self;

            fn $function(self, other: Self) -> Self {
                count(|counts| &mut counts.$field);
                Self(self.0 $operator other.0)
            }
        }
    )*};
}

operators!(Add add + additions, Sub sub - additions, Mul mul * multiplications, Div div / divisions);

impl Neg for Counted {
    type Output = Self;

    fn neg(self) -> Self {
        Self::other(-self.0)
    }
}

impl AddAssign for Counted {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Lane for Counted {
    const WIDTH: usize = 1;
    type Mask = bool;

    fn splat(value: f64) -> Self {
        Self(value)
    }

    fn load(batch: &Batch, at: usize) -> Self {
        Self(f64::load(batch, at))
    }

    fn store(self, batch: &mut Batch, at: usize) {
        self.0.store(batch, at);
    }

    fn gather<const D: usize>(points: &Moving<D>, indices: &Indices, row: usize, at: usize) -> [[Self; D]; 2] {
        f64::gather(points, indices, row, at).map(|vector: [f64; D]| vector.map(Self))
    }

    fn gather_one<const D: usize, const N: usize, const SECOND: bool>(
        points: &Moving<D>,
        indices: &Indices,
        row: usize,
        at: usize,
    ) -> [[Self; D]; N] {
        f64::gather_one::<D, N, SECOND>(points, indices, row, at).map(|vector| vector.map(Self))
    }

    fn scatter<const D: usize, const N: usize>(
        values: &[[Self; D]; N],
        sums: &mut VectorSums<D>,
        indices: &Indices,
        row: usize,
        at: usize,
    ) {
        count_all(|counts| &mut counts.additions, (D * N) as u64);
        f64::scatter(&values.map(|vector| vector.map(|value| value.0)), sums, indices, row, at);
    }

    fn gather_rooms(rooms: &[Room], places: &Places, row: usize, at: usize) -> [Self; 4] {
        f64::gather_rooms(rooms, places, row, at).map(Self)
    }

    fn store_rooms(values: [Self; 4], rooms: &mut [Room], places: &Places, row: usize, at: usize) {
        f64::store_rooms(values.map(|value| value.0), rooms, places, row, at);
    }

    fn load_points<const D: usize>(points: &[[f64; D]], first: usize) -> [Self; D] {
        f64::load_points(points, first).map(Self)
    }

    fn store_points<const D: usize>(values: [Self; D], points: &mut [[f64; D]], first: usize) {
        f64::store_points(values.map(|value| value.0), points, first);
    }

    fn sqrt(self) -> Self {
        count(|counts| &mut counts.roots);
        Self(self.0.sqrt())
    }

    fn abs(self) -> Self {
        Self::other(self.0.abs())
    }

    fn min(self, other: Self) -> Self {
        Self::other(Lane::min(self.0, other.0))
    }

    fn max(self, other: Self) -> Self {
        Self::other(Lane::max(self.0, other.0))
    }

    fn less(self, other: Self) -> bool {
        count(|counts| &mut counts.others);
        self.0 < other.0
    }

    fn select(mask: bool, yes: Self, no: Self) -> Self {
        Self::other(if mask { yes.0 } else { no.0 })
    }

    fn any(mask: bool) -> bool {
        mask
    }

    fn either(a: bool, b: bool) -> bool {
        count(|counts| &mut counts.others);
        a | b
    }

    fn bits(mask: bool) -> u32 {
        u32::from(mask)
    }

    fn split(self) -> (Self, Self) {
        let (mantissa, exponent) = self.0.split();
        (Self::other(mantissa), Self::other(exponent))
    }

    fn power_of_two(self) -> Self {
        Self::other(self.0.power_of_two())
    }
}
