//! The mass matrix of the new nodes, conjugate gradients, and small dense systems.

/// A symmetric matrix with a row for each node: its diagonal, and the nodes that share a cell with it.
pub(crate) struct Matrix {
    pub(crate) diagonal: Vec<f64>,
    /// Of each row the first of its entries; one more at the end.
    starts: Vec<u32>,
    columns: Vec<u32>,
    values: Vec<f64>,
}

impl Matrix {
    /// The entries that cells with these nodes give, all zero.
    pub(crate) fn of<'a>(cells: impl Iterator<Item = &'a [u32]>, nodes: usize) -> Self {
        let mut pairs: Vec<[u32; 2]> = Vec::new();
        for all in cells {
            pairs.extend(all.iter().flat_map(|&a| all.iter().map(move |&b| [a, b])).filter(|[a, b]| a != b));
        }
        pairs.sort_unstable();
        pairs.dedup();
        let mut starts = vec![0; nodes + 1];
        pairs.iter().for_each(|pair| starts[pair[0] as usize + 1] += 1);
        (0..nodes).for_each(|row| starts[row + 1] += starts[row]);
        let columns: Vec<u32> = pairs.iter().map(|pair| pair[1]).collect();
        let values = vec![0.0; columns.len()];
        Self { diagonal: vec![0.0; nodes], starts, columns, values }
    }

    /// Adds to an entry that is there.
    pub(crate) fn add(&mut self, row: u32, column: u32, value: f64) {
        if row == column {
            self.diagonal[row as usize] += value;
            return;
        }
        let range = self.range(row as usize);
        if let Ok(k) = self.columns[range.clone()].binary_search(&column) {
            self.values[range.start + k] += value;
        }
    }

    fn range(&self, row: usize) -> std::ops::Range<usize> {
        self.starts[row] as usize..self.starts[row + 1] as usize
    }

    /// Columns and values of a row without its diagonal.
    pub(crate) fn row(&self, row: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.range(row).map(|k| (self.columns[k] as usize, self.values[k]))
    }

    fn times(&self, row: usize, x: &[f64]) -> f64 {
        self.row(row).fold(self.diagonal[row] * x[row], |sum, (column, value)| sum + value * x[column])
    }

    /// Solves M x = b in the rows that are free, from a first x; what is not free keeps its x. Conjugate
    /// gradients with the diagonal: the eigenvalues of diag(M)⁻¹ M lie between bounds that do not depend on
    /// the mesh, [½, 2] for triangles and [½, 5/2] for tetrahedra (Wathen, IMA J. Numer. Anal. 7 (1987) 449),
    /// so that the error falls at least twofold in each iteration.
    pub(crate) fn solve(&self, b: &[f64], free: &[bool], x: &mut [f64]) {
        let count = self.diagonal.len();
        let active = |row: usize| free[row] && self.diagonal[row] > 0.0;
        let mut r: Vec<f64> = (0..count).map(|row| if active(row) { b[row] - self.times(row, x) } else { 0.0 }).collect();
        let scaled =
            |r: &[f64]| -> Vec<f64> { (0..count).map(|row| if active(row) { r[row] / self.diagonal[row] } else { 0.0 }).collect() };
        let mut z = scaled(&r);
        let mut p = z.clone();
        let mut rz = inner(&r, &z);
        let least = 1e-34 * rz;
        for _ in 0..ITERATIONS {
            if !(rz > least) {
                break;
            }
            let q: Vec<f64> = (0..count).map(|row| if active(row) { self.times(row, &p) } else { 0.0 }).collect();
            let curvature = inner(&p, &q);
            if !(curvature > 0.0) {
                break;
            }
            let step = rz / curvature;
            for row in 0..count {
                x[row] += step * p[row];
                r[row] -= step * q[row];
            }
            z = scaled(&r);
            let next = inner(&r, &z);
            let part = next / rz;
            rz = next;
            (0..count).for_each(|row| p[row] = z[row] + part * p[row]);
        }
    }
}

/// Enough for masses that differ much within a triangle, too.
const ITERATIONS: usize = 80;

fn inner(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |sum, (a, b)| sum + a * b)
}

/// Solves A x = b for the first `count` unknowns, A symmetric and not negative, by elimination in the order
/// of the unknowns. Unknowns that depend on those before are zero.
pub(crate) fn eliminate<const N: usize>(mut a: [[f64; N]; N], mut b: [f64; N], count: usize) -> [f64; N] {
    let first: [f64; N] = std::array::from_fn(|k| a[k][k]);
    let mut is_used = [false; N];
    for k in 0..count {
        if !(a[k][k] > 1e-9 * first[k]) {
            continue;
        }
        is_used[k] = true;
        for row in k + 1..count {
            let factor = a[row][k] / a[k][k];
            for column in k..count {
                a[row][column] -= factor * a[k][column];
            }
            b[row] -= factor * b[k];
        }
    }
    let mut x = [0.0; N];
    for k in (0..count).rev() {
        if is_used[k] {
            let rest = (k + 1..count).fold(b[k], |rest, column| rest - a[k][column] * x[column]);
            x[k] = rest / a[k][k];
        }
    }
    x
}
