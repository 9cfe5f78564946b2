//! Places of the corners of batches of elements, checked once against their bound so that gathers and scatters in kernels need no check per place.

use crate::BATCH;

/// Rows of [`BATCH`] places in a short list, all below [`Indices::bound`].
#[derive(Clone, Debug, Default)]
pub struct Indices {
    rows: Box<[[u16; BATCH]]>,
    bound: usize,
}

impl Indices {
    /// Takes rows of indices and finds their bound.
    #[must_use]
    pub fn new(rows: Vec<[u16; BATCH]>) -> Self {
        let bound = rows.iter().flatten().map(|&index| index as usize + 1).max().unwrap_or(0);
        Self { rows: rows.into_boxed_slice(), bound }
    }

    /// Makes lane `to` of row `to_row` a copy of lane `from` of row `from_row`.
    pub fn copy_lane(&mut self, [from_row, from]: [usize; 2], [to_row, to]: [usize; 2]) {
        self.rows[to_row][to] = self.rows[from_row][from];
    }

    /// One more than the largest index: the shortest list of points that may be gathered from.
    #[must_use]
    pub fn bound(&self) -> usize {
        self.bound
    }

    /// The indices of a row.
    #[inline(always)]
    #[must_use]
    pub fn row(&self, row: usize) -> &[u16; BATCH] {
        &self.rows[row]
    }

    /// The indices of `N` rows after the checks that make unchecked access to `points` sound: they are there, `width` of them from `at` on in each, and every one
    /// is a valid index of `points`.
    #[inline(always)]
    pub(crate) fn checked<T, const N: usize>(&self, points: &[T], row: usize, at: usize, width: usize) -> &[[u16; BATCH]; N] {
        assert!(points.len() >= self.bound && at + width <= BATCH, "fewer points than the indices need");
        self.rows[row..].first_chunk().expect("fewer rows than the kernel reads")
    }
}
