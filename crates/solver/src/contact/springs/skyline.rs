//! Systems of equations with few entries, near the diagonal but for some rows at the end: skyline storage and
//! LU factors without pivoting.
//!
//! [`super::newton`] fills in the springs of an island and takes the solution. Row i of the lower and column
//! i of the upper triangle are stored from the same first entry on; factors stay inside that profile. Without
//! pivoting, so for matrices that are definite (or nearly symmetric and quasi-definite); the
//! user of the solution checks it.

/// A square matrix, then its factors.
#[derive(Default)]
pub(super) struct Skyline {
    /// First column of each row (and first row of each column).
    first: Vec<u32>,
    /// Where the entries of each row begin.
    start: Vec<usize>,
    lower: Vec<f64>,
    upper: Vec<f64>,
    diagonal: Vec<f64>,
}

impl Skyline {
    /// Zero, with the profile of `first`: the first column of each row, not beyond the diagonal.
    pub(super) fn reset(&mut self, first: &[u32]) {
        self.first.clear();
        self.first.extend_from_slice(first);
        self.start.clear();
        let mut total = 0;
        for (row, &first) in first.iter().enumerate() {
            self.start.push(total);
            total += row - first as usize;
        }
        for (values, count) in [(&mut self.lower, total), (&mut self.upper, total), (&mut self.diagonal, first.len())] {
            values.clear();
            values.resize(count, 0.0);
        }
    }

    /// Adds to an entry inside the profile.
    #[inline]
    pub(super) fn add(&mut self, row: usize, column: usize, value: f64) {
        match row.cmp(&column) {
            std::cmp::Ordering::Equal => self.diagonal[row] += value,
            std::cmp::Ordering::Greater => self.lower[self.start[row] + column - self.first[row] as usize] += value,
            std::cmp::Ordering::Less => self.upper[self.start[column] + row - self.first[column] as usize] += value,
        }
    }

    /// L U in place; `false`: a pivot vanishes or is not finite.
    pub(super) fn factor(&mut self) -> bool {
        for row in 0..self.first.len() {
            let (first, start) = (self.first[row] as usize, self.start[row]);
            let (lower_above, lower) = self.lower.split_at_mut(start);
            let (upper_above, upper) = self.upper.split_at_mut(start);
            let (lower, upper) = (&mut lower[..row - first], &mut upper[..row - first]);
            for j in first..row {
                let (first_j, start_j) = (self.first[j] as usize, self.start[j]);
                let common = first.max(first_j);
                let (here, there) = (common - first..j - first, start_j + common - first_j..start_j + j - first_j);
                // Of a row that is above, the entries are in the parts before this row's.
                let sums = products([&lower[here.clone()], &lower_above[there.clone()]], [&upper_above[there], &upper[here]]);
                lower[j - first] = (lower[j - first] - sums[0]) / self.diagonal[j];
                upper[j - first] -= sums[1];
            }
            self.diagonal[row] -= product(lower, upper);
            if !(self.diagonal[row] != 0.0 && self.diagonal[row].is_finite()) {
                return false;
            }
        }
        true
    }

    /// Solves with the factors, in place.
    pub(super) fn solve(&self, x: &mut [f64]) {
        for row in 0..x.len() {
            let first = self.first[row] as usize;
            x[row] -= product(&self.lower[self.start[row]..][..row - first], &x[first..row]);
        }
        for column in (0..x.len()).rev() {
            x[column] /= self.diagonal[column];
            let (first, value) = (self.first[column] as usize, x[column]);
            for (x, u) in x[first..column].iter_mut().zip(&self.upper[self.start[column]..]) {
                *x -= u * value;
            }
        }
    }
}

/// Two products at once: each waits for its own last sum alone.
#[inline]
fn products([a, c]: [&[f64]; 2], [b, d]: [&[f64]; 2]) -> [f64; 2] {
    // Where the sum of an iterator begins.
    let mut sums = [-0.0; 2];
    for (((a, b), c), d) in a.iter().zip(b).zip(c).zip(d) {
        sums[0] += a * b;
        sums[1] += c * d;
    }
    sums
}

#[inline]
fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_matrix_times_its_solution_is_the_right_side() {
        let first = [0u32, 0, 1, 3, 1, 0];
        let entry = |i: usize, j: usize| if i == j { 9.0 + i as f64 } else { ((7 * i + 3 * j) % 11) as f64 / 7.0 - 0.6 };
        let inside = |i: usize, j: usize| first[i.max(j)] as usize <= i.min(j);
        let mut matrix = Skyline::default();
        for _ in 0..2 {
            matrix.reset(&first);
            for (i, j) in (0..6).flat_map(|i| (0..6).map(move |j| (i, j))).filter(|&(i, j)| inside(i, j)) {
                matrix.add(i, j, entry(i, j));
            }
            let right = [1.0, -2.0, 0.5, 3.0, 0.0, 1.5];
            let mut x = right;
            assert!(matrix.factor());
            matrix.solve(&mut x);
            for i in 0..6 {
                let sum: f64 = (0..6).filter(|&j| inside(i, j)).map(|j| entry(i, j) * x[j]).sum();
                assert!((sum - right[i]).abs() < 1e-14, "row {i}: {sum}");
            }
        }
        matrix.reset(&[0, 0]);
        assert!(!matrix.factor());
    }
}
