//! Lists of vectors as kernels read and add to them, and places in them, checked once against their bound so
//! that gathers and scatters need no check per place.
//!
//! Each vector in 3D lies in a room of four values, so that a register takes it at once; one in 2D
//! takes two, and with another that belongs to it four.

use crate::{BATCH, Batch};

/// Values from one place to the next in [`Moving`]: places are kept times this, which is what an address
/// takes.
pub(crate) const ROOM: usize = 4;

/// Rows of [`BATCH`] places in a short list, all below [`Indices::bound`].
#[derive(Clone, Debug, Default)]
pub struct Indices {
    /// Times [`ROOM`].
    rows: Box<[[u16; BATCH]]>,
    bound: usize,
}

impl Indices {
    /// Takes rows of places and finds their bound. Panics where one is 16,384 or more: lists are short.
    #[must_use]
    pub fn new(mut rows: Vec<[u16; BATCH]>) -> Self {
        let bound = rows.iter().flatten().map(|&index| index as usize + 1).max().unwrap_or(0);
        assert!(bound <= usize::from(u16::MAX) / ROOM + 1, "the list is too long for places of two bytes");
        rows.as_flattened_mut().iter_mut().for_each(|place| *place *= ROOM as u16);
        Self { rows: rows.into_boxed_slice(), bound }
    }

    /// Makes lane `to` of row `to_row` a copy of lane `from` of row `from_row`.
    pub fn copy_lane(&mut self, [from_row, from]: [usize; 2], [to_row, to]: [usize; 2]) {
        self.rows[to_row][to] = self.rows[from_row][from];
    }

    /// One more than the largest place: the shortest list that may be gathered from.
    #[must_use]
    pub fn bound(&self) -> usize {
        self.bound
    }

    /// A place.
    #[inline(always)]
    #[must_use]
    pub fn place(&self, row: usize, lane: usize) -> usize {
        usize::from(self.rows[row][lane]) / ROOM
    }

    /// The places of `N` rows, times [`ROOM`], after the checks that make unchecked access to a list of
    /// `length` sound: they are there, `width` of them from `at` on in each, and every one is a valid place.
    #[inline(always)]
    #[cfg(target_arch = "x86_64")]
    pub(crate) fn checked<const N: usize>(&self, length: usize, row: usize, at: usize, width: usize) -> &[[u16; BATCH]; N] {
        assert!(length >= self.bound && at + width <= BATCH, "fewer places than the indices need");
        self.rows[row..].first_chunk().expect("fewer rows than the kernel reads")
    }
}

/// A room of four values.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C, align(32))]
pub struct Room(pub [f64; ROOM]);

/// Rows of [`BATCH`] places among [`Room`]s, which may change row by row; none is above the bound that is
/// kept with them, so that gathers need no check per place.
#[derive(Clone, Debug, Default)]
pub struct Places {
    rows: Vec<[u32; BATCH]>,
    bound: usize,
}

impl Places {
    /// Takes all rows away.
    pub fn clear(&mut self) {
        self.rows.clear();
        self.bound = 0;
    }

    /// Number of rows.
    #[must_use]
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there is no row.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Makes `count` rows, new ones of place zero.
    pub fn resize(&mut self, count: usize) {
        self.rows.resize(count, [0; BATCH]);
        self.bound = self.bound.max(usize::from(count > 0));
    }

    /// Sets a place. Panics where there is no such row or lane.
    #[inline]
    pub fn set(&mut self, row: usize, lane: usize, place: u32) {
        self.rows[row][lane] = place;
        self.bound = self.bound.max(place as usize + 1);
    }

    /// A place.
    #[inline(always)]
    #[must_use]
    pub fn get(&self, row: usize, lane: usize) -> usize {
        self.rows[row][lane] as usize
    }

    /// The places of a row, after the checks that make unchecked access to a list of `length` sound: `width`
    /// of them from `at` on, each below `length`.
    #[inline(always)]
    #[cfg(target_arch = "x86_64")]
    pub(crate) fn checked(&self, length: usize, row: usize, at: usize, width: usize) -> &[u32; BATCH] {
        assert!(length >= self.bound && at + width <= BATCH, "fewer rooms than the places need");
        &self.rows[row]
    }
}

/// Points with two vectors each, as position and velocity; those of four values fill their rooms.
#[derive(Clone, Debug, Default)]
pub struct Moving<const D: usize> {
    /// Of the plane both vectors, in 3D the first.
    first: Vec<Batch>,
    /// In 3D the second vectors.
    second: Vec<Batch>,
    count: usize,
}

/// The values of batches, four by four.
#[inline(always)]
fn rooms_mut(batches: &mut [Batch]) -> &mut [[f64; ROOM]] {
    const { assert!(size_of::<Batch>() == BATCH * size_of::<f64>() && BATCH == 2 * ROOM, "a batch is two rooms and nothing else") };
    // SAFETY: each batch is two rooms without a gap, of a smaller alignment, and the list is borrowed as a
    // whole.
    unsafe { std::slice::from_raw_parts_mut(batches.as_mut_ptr().cast(), 2 * batches.len()) }
}

/// The same to read.
#[inline(always)]
fn rooms(batches: &[Batch]) -> &[[f64; ROOM]] {
    const { assert!(size_of::<Batch>() == BATCH * size_of::<f64>() && BATCH == 2 * ROOM, "a batch is two rooms and nothing else") };
    // SAFETY: as above.
    unsafe { std::slice::from_raw_parts(batches.as_ptr().cast(), 2 * batches.len()) }
}

/// The room of a vector in a list of batches: which batch, and where in it.
#[inline(always)]
fn room(index: usize, width: usize) -> (usize, usize) {
    (index * width / BATCH, index * width % BATCH)
}

impl<const D: usize> Moving<D> {
    /// Makes room for `count` points, which hold anything.
    pub fn resize(&mut self, count: usize) {
        const { assert!(D >= 2 && D <= ROOM, "vectors have two to four values") };
        let batches = (count * ROOM).div_ceil(BATCH);
        self.first.resize(batches, Batch::default());
        self.second.resize(if D == 2 { 0 } else { batches }, Batch::default());
        self.count = count;
    }

    /// Number of points.
    #[must_use]
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Sets both vectors of the points that `nodes` name, in their order, from the lists that hold those of
    /// all nodes.
    #[inline]
    pub fn fill(&mut self, nodes: &[u32], first: &[[f64; D]], second: &[[f64; D]]) {
        self.fill_by(nodes.iter(), |&node, to, other| {
            to.copy_from_slice(&first[node as usize]);
            other.copy_from_slice(&second[node as usize]);
        });
    }

    /// Lets `set` write both vectors of the first points where they are, one after the other: a pair that is
    /// made elsewhere and copied costs more than all that it holds.
    #[inline]
    pub fn fill_by<P>(&mut self, points: impl Iterator<Item = P>, set: impl Fn(P, &mut [f64], &mut [f64])) {
        let rooms = rooms_mut(&mut self.first).iter_mut();
        if D == 2 {
            for (room, point) in rooms.zip(points) {
                let (first, second) = room.split_at_mut(D);
                set(point, first, second);
            }
            return;
        }
        for ((room, other), point) in rooms.zip(rooms_mut(&mut self.second)).zip(points) {
            set(point, &mut room[..D], &mut other[..D]);
        }
    }

    /// Both vectors of a point.
    #[inline(always)]
    pub(crate) fn point(&self, index: usize) -> [[f64; D]; 2] {
        assert!(index < self.count, "there is no such point");
        let ((batch, at), mut out) = (room(index, ROOM), [[0.0; D]; 2]);
        let (second, from) = if D == 2 { (&self.first, at + D) } else { (&self.second, at) };
        out[0].copy_from_slice(&self.first[batch].0[at..at + D]);
        out[1].copy_from_slice(&second[batch].0[from..from + D]);
        out
    }

    /// The first of all values: in 2D those of both vectors, in 3D those of the first or second
    /// ones.
    #[inline(always)]
    #[cfg(target_arch = "x86_64")]
    pub(crate) fn as_ptr<const SECOND: bool>(&self) -> *const f64 {
        if SECOND && D > 2 { self.second.as_ptr().cast() } else { self.first.as_ptr().cast() }
    }
}

impl Moving<ROOM> {
    /// First and second vectors of all points, to be written. Of an odd number one more follows, which stands
    /// for nothing.
    #[inline]
    pub fn vectors_mut(&mut self) -> [&mut [[f64; ROOM]]; 2] {
        [rooms_mut(&mut self.first), rooms_mut(&mut self.second)]
    }
}

/// Sums of vectors.
#[derive(Clone, Debug, Default)]
pub struct VectorSums<const D: usize> {
    values: Vec<Batch>,
    count: usize,
}

impl<const D: usize> VectorSums<D> {
    /// Values from one vector to the next.
    pub(crate) const WIDTH: usize = D.next_power_of_two();

    /// `count` sums of nothing.
    pub fn clear(&mut self, count: usize) {
        const { assert!(D == 2 || D == 3, "vectors are 2D or 3D") };
        self.values.clear();
        self.values.resize((count * Self::WIDTH).div_ceil(BATCH), Batch::default());
        self.count = count;
    }

    /// Number of sums.
    #[must_use]
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Writes all sums to `out`, as many as there are.
    #[inline]
    pub fn copy_to(&self, out: &mut [[f64; D]]) {
        let vectors = rooms(&self.values).as_flattened().chunks_exact(Self::WIDTH);
        for (out, vector) in out[..self.count].iter_mut().zip(vectors) {
            out.copy_from_slice(&vector[..D]);
        }
    }

    /// The components of each sum.
    #[inline]
    pub fn rows(&self) -> impl Iterator<Item = &[f64]> {
        rooms(&self.values).as_flattened().chunks_exact(Self::WIDTH).take(self.count).map(|vector| &vector[..D])
    }

    /// The components of a sum.
    #[inline(always)]
    pub(crate) fn row_mut(&mut self, index: usize) -> &mut [f64] {
        assert!(index < self.count, "there is no such sum");
        let (batch, at) = room(index, Self::WIDTH);
        &mut self.values[batch].0[at..at + D]
    }

    /// The first of all values.
    #[inline(always)]
    #[cfg(target_arch = "x86_64")]
    pub(crate) fn as_mut_ptr(&mut self) -> *mut f64 {
        self.values.as_mut_ptr().cast()
    }
}
