//! The largest eigenvalue of a symmetric, positive semidefinite matrix by Lanczos' method from a random
//! start.
//!
//! After k products the largest eigenvalue θ of the tridiagonal matrix is never above λ, that of the matrix.
//! How far it may be below is a matter of chance alone, whatever the eigenvalues are: with the share c of the
//! start along the eigenvector of λ, θ < (1 − ε) λ is possible only if
//!
//! ```text
//! |c| < 1 / cosh((2k − 1) artanh √ε),      and so has at most the probability
//! P = 1.6 √n exp(−(2k − 1) artanh √ε)      in n dimensions.
//! ```
//!
//! For Lanczos' θ is the largest Rayleigh quotient of p(A) q over all polynomials p of degree k − 1. Take
//! p(µ) = T_{2k−1}(√(1 − µ)) / √(1 − µ) with µ = x / ((1 − ε) λ) and the Chebyshev polynomial T: where it is
//! below (1 − ε) λ, Σ (λ_i − (1 − ε) λ) p² c_i² is negative, and (1 − µ) p² is at most 1 for µ in 0..1 and
//! −sinh²((2k − 1) artanh √ε) at λ. A component of a random unit vector is within ±t with at most the
//! probability t √(2n/π). Source of the method of proof and of the bound with 1.648 and √ε: Kuczyński and
//! Woźniakowski, SIAM J. Matrix Anal. Appl. 13 (1992) 1094-1122.

use crate::reductions;
use embate_lanes::math;

/// Numbers that one sum of a scalar product has.
const LEAF: usize = 256;

/// The matrix on the Krylov space of the start, which is tridiagonal.
#[derive(Clone, Debug, Default)]
pub struct Tridiagonal {
    /// α.
    diagonal: Vec<f64>,
    /// β: one less, or one more that says how far the space is from complete.
    beside: Vec<f64>,
}

impl Tridiagonal {
    /// Number of products that made it.
    #[must_use]
    pub fn products(&self) -> usize {
        self.diagonal.len()
    }

    /// Its largest eigenvalue, from above, by bisection with Sturm's sequence.
    #[must_use]
    pub fn largest(&self) -> f64 {
        let beside = |k: usize| self.beside.get(k).copied().unwrap_or(0.0);
        let last = self.diagonal.len().saturating_sub(1);
        let row = |(k, own): (usize, &f64)| own + if k > 0 { beside(k - 1) } else { 0.0 } + if k < last { beside(k) } else { 0.0 };
        let (mut low, mut high) = (0.0, reductions::max(self.diagonal.iter().enumerate().map(row)));
        // To the last bit.
        loop {
            let middle = 0.5 * (low + high);
            if !(middle > low && middle < high) {
                return high;
            }
            if self.has_above(middle) { low = middle } else { high = middle }
        }
    }

    /// Whether an eigenvalue is larger.
    fn has_above(&self, value: f64) -> bool {
        let mut pivot = 1.0;
        for (k, own) in self.diagonal.iter().enumerate() {
            let square = if k > 0 { self.beside[k - 1] * self.beside[k - 1] } else { 0.0 };
            pivot = own - value - square / pivot;
            if pivot > 0.0 {
                return true;
            }
            if pivot == 0.0 {
                pivot = -f64::MIN_POSITIVE;
            }
        }
        false
    }

    /// The unit eigenvector of its largest eigenvalue, by inverse iteration from above it.
    fn vector(&self) -> Vec<f64> {
        let count = self.diagonal.len();
        let above = self.largest() * (1.0 + 1e-12);
        let mut vector = vec![1.0 / (count as f64).sqrt(); count];
        for _ in 0..8 {
            // (T − above) y = vector, without pivots: it is negative definite.
            let mut pivots = Vec::with_capacity(count);
            for k in 0..count {
                let (square, carry) = match pivots.last() {
                    Some(&pivot) if k > 0 => (self.beside[k - 1] * self.beside[k - 1] / pivot, self.beside[k - 1] / pivot * vector[k - 1]),
                    _ => (0.0, 0.0),
                };
                pivots.push(self.diagonal[k] - above - square);
                vector[k] -= carry;
            }
            for k in (0..count).rev() {
                let next = if k + 1 < count { self.beside[k] * vector[k + 1] } else { 0.0 };
                vector[k] = (vector[k] - next) / pivots[k];
            }
            let norm = norm(&vector);
            vector.iter_mut().for_each(|value| *value /= norm);
        }
        vector
    }
}

/// Products after which θ < (1 − ε) λ has at most the `probability`, in so many `dimensions`.
#[must_use]
pub fn products(dimensions: usize, margin: f64, probability: f64) -> usize {
    let root = margin.sqrt();
    let rate = 0.5 * math::ln((1.0 + root) / (1.0 - root));
    let needed = math::ln(1.6 * (dimensions as f64).sqrt() / probability) / rate;
    (0.5 * (1.0 + needed)).ceil() as usize
}

/// Scalar product: leaves of a fixed length, whose sums are added exactly.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let leaves = a.chunks(LEAF).zip(b.chunks(LEAF));
    reductions::sum(leaves.map(|(a, b)| a.iter().zip(b).fold(0.0, |sum, (a, b)| sum + a * b)))
}

fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

/// Does at most `most` products `multiply(q, &mut A q)` from the start `q`, of any length but zero, as long
/// as `goes_on` with what is known after each; fewer where the space is complete. `see` gets the unit vectors
/// of the Krylov space in turn.
pub fn lanczos(
    mut q: Vec<f64>,
    most: usize,
    mut multiply: impl FnMut(&[f64], &mut [f64]),
    mut see: impl FnMut(usize, &[f64]),
    mut goes_on: impl FnMut(&Tridiagonal) -> bool,
) -> Tridiagonal {
    let mut found = Tridiagonal::default();
    let scale = 1.0 / norm(&q);
    q.iter_mut().for_each(|value| *value *= scale);
    let (mut before, mut product) = (vec![0.0; q.len()], vec![0.0; q.len()]);
    for k in 0..most {
        see(k, &q);
        multiply(&q, &mut product);
        let beside = found.beside.last().copied().unwrap_or(0.0);
        product.iter_mut().zip(&before).for_each(|(product, before)| *product -= beside * before);
        let own = dot(&product, &q);
        product.iter_mut().zip(&q).for_each(|(product, q)| *product -= own * q);
        found.diagonal.push(own);
        let rest = norm(&product);
        // Nothing but round-off is left: the space is complete.
        let is_complete = !(rest > 1e-13 * found.largest());
        if k + 1 == most || is_complete || !goes_on(&found) {
            break;
        }
        found.beside.push(rest);
        let scale = 1.0 / rest;
        std::mem::swap(&mut before, &mut q);
        std::mem::swap(&mut q, &mut product);
        q.iter_mut().for_each(|value| *value *= scale);
    }
    found
}

/// The eigenvector of the largest eigenvalue, of length one, as far as the first `count` products found it,
/// which are done again from the same start.
pub fn ritz_vector(start: Vec<f64>, found: &Tridiagonal, count: usize, multiply: impl FnMut(&[f64], &mut [f64])) -> Vec<f64> {
    let count = count.min(found.products());
    let first = Tridiagonal { diagonal: found.diagonal[..count].to_vec(), beside: found.beside[..count - 1].to_vec() };
    let shares = first.vector();
    let mut sum = vec![0.0; start.len()];
    let add = |k: usize, q: &[f64]| {
        let share = shares.get(k).copied().unwrap_or(0.0);
        sum.iter_mut().zip(q).for_each(|(sum, q)| *sum += share * q);
    };
    lanczos(start, count, multiply, add, |_| true);
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    fn diagonal(values: &[f64]) -> impl FnMut(&[f64], &mut [f64]) {
        move |q, product| (0..q.len()).for_each(|k| product[k] = values[k] * q[k])
    }

    fn start(dimensions: usize, seed: u64) -> Vec<f64> {
        let mut random = Random::apart(seed);
        (0..dimensions).map(|_| random.normal()).collect()
    }

    fn spectrum(dimensions: usize, power: f64) -> Vec<f64> {
        (0..dimensions).map(|k| 3.0 * (k as f64 / (dimensions - 1) as f64).powf(power)).collect()
    }

    #[test]
    fn as_many_products_as_dimensions_find_every_eigenvalue() {
        for dimensions in [1, 2, 5, 12] {
            let values = spectrum(dimensions.max(2), 1.0)[..dimensions].to_vec();
            let found = lanczos(start(dimensions, 1), 100, diagonal(&values), |_, _| (), |_| true);
            let largest = values.iter().copied().fold(0.0, f64::max);
            assert!((found.largest() - largest).abs() < 1e-9, "{dimensions}: {} {largest}", found.largest());
        }
    }

    #[test]
    fn no_start_misses_the_largest_eigenvalue_by_more_than_the_margin_after_the_products_of_the_theorem() {
        let margin = 0.0591;
        for power in [0.3, 1.0, 4.0] {
            let values = spectrum(400, power);
            let count = products(400, margin, 1e-6);
            assert!((30..60).contains(&count), "{count}");
            let mut worst = f64::INFINITY;
            for seed in 0..300 {
                let theta = lanczos(start(400, seed), count, diagonal(&values), |_, _| (), |_| true).largest();
                assert!(theta < 3.0 * (1.0 + 1e-12));
                worst = f64::min(worst, theta / 3.0);
            }
            assert!(worst > 1.0 - margin, "{worst}");
        }
    }

    /// With few products a miss is possible: as often as the bound allows, at most, and not far more rarely
    /// than it says for the eigenvalues that are hardest to find.
    #[test]
    fn the_probability_of_a_miss_is_at_most_that_of_the_theorem() {
        let (dimensions, margin, tries) = (300, 0.2, 4000);
        // Those below are spread as Chebyshev's points are, just outside of the margin.
        let mut values: Vec<f64> = (0..dimensions).map(|k| 0.5 * (1.0 - margin) * (1.0 - (k as f64 * 0.37).cos())).collect();
        values[0] = 1.0;
        let mut seen = 0;
        for count in 1..12 {
            let misses = (0..tries)
                .filter(|&seed| lanczos(start(dimensions, seed), count, diagonal(&values), |_, _| (), |_| true).largest() < 1.0 - margin)
                .count();
            let rate = 0.5 * ((1.0 + margin.sqrt()) / (1.0 - margin.sqrt())).ln();
            let bound = 1.6 * (dimensions as f64).sqrt() * (-((2 * count - 1) as f64) * rate).exp();
            let share = misses as f64 / f64::from(tries as u32);
            println!("{count} products: {share} missed, at most {bound}");
            assert!(share <= bound + 3.0 * (bound / f64::from(tries as u32)).sqrt(), "{count}: {share} {bound}");
            seen += usize::from(bound < 0.5 && share > 0.02 * bound);
        }
        assert!(seen > 0);
    }

    #[test]
    fn the_vector_is_that_of_the_largest_eigenvalue() {
        let values = spectrum(500, 2.0);
        let found = lanczos(start(500, 7), 60, diagonal(&values), |_, _| (), |_| true);
        let vector = ritz_vector(start(500, 7), &found, 60, diagonal(&values));
        assert!((norm(&vector) - 1.0).abs() < 1e-6);
        let quotient = vector.iter().zip(&values).map(|(q, value)| value * q * q).sum::<f64>();
        assert!(quotient > 2.99, "{quotient}");
        let first = (0..500).max_by(|&a, &b| vector[a].abs().total_cmp(&vector[b].abs())).unwrap();
        assert!(first > 495, "{first}");
    }
}
