//! Principal values and directions of symmetric tensors over lanes, safe where they coincide.
//!
//! In 2D in closed form; in 3D by Jacobi's rotations, a fixed number of them, so that every lane
//! does the same and gives the same bits. What comes out are eigenvalues λ_i and projections P_i = n_i n_iᵀ:
//! T = Σ λ_i P_i to round-off, P_i P_j = δ_ij P_i, Σ P_i = I, whatever coincides. Source: Golub and Van Loan,
//! Matrix Computations (2013), 8.5 (cyclic Jacobi converges quadratically; from the sixth sweep on nothing
//! changes).

use super::{Plane, Solid};
use embate_lanes::Lane;

/// Sweeps of three rotations: random and nearly equal values are exact after five.
const SWEEPS: usize = 6;

/// Eigenvalues and projections in 2D; the third is normal to it.
///
/// λ = m ± r with r = √(½(T_xx − T_yy)² + T_xy²); where r = 0, the axes are x and y.
#[inline(always)]
pub(super) fn plane<L: Lane>(t: Plane<L>) -> ([L; 3], [Plane<L>; 3]) {
    let (zero, half, one) = (L::splat(0.0), L::splat(0.5), L::splat(1.0));
    let [xx, yy, zz, xy] = t.0;
    let (mean, difference) = ((xx + yy) * half, (xx - yy) * half);
    let radius = (difference * difference + xy * xy).sqrt();
    let turned = zero.less(radius);
    let inverse = one / L::select(turned, radius, one);
    // cos 2θ and sin 2θ of the first axis, halved
    let (cos, sin) = (L::select(turned, difference * inverse, one) * half, L::select(turned, xy * inverse, zero) * half);
    let first = Plane([half + cos, half - cos, zero, sin]);
    let second = Plane([half - cos, half + cos, zero, -sin]);
    ([mean + radius, mean - radius, zz], [first, second, Plane([zero, zero, one, zero])])
}

/// Eigenvalues and projections in 3D, in no order.
#[inline(always)]
pub(super) fn solid<L: Lane>(t: Solid<L>) -> ([L; 3], [Solid<L>; 3]) {
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    let [xx, yy, zz, xy, yz, zx] = t.0;
    let mut a = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
    let mut axes = [[one, zero, zero], [zero, one, zero], [zero, zero, one]];
    for _ in 0..SWEEPS {
        rotate(&mut a, &mut axes, 0, 1, 2);
        rotate(&mut a, &mut axes, 1, 2, 0);
        rotate(&mut a, &mut axes, 2, 0, 1);
    }
    let mut projections = [Solid([zero; 6]); 3];
    for i in 0..3 {
        let n = [axes[0][i], axes[1][i], axes[2][i]];
        projections[i] = Solid([n[0] * n[0], n[1] * n[1], n[2] * n[2], n[0] * n[1], n[1] * n[2], n[2] * n[0]]);
    }
    ([a[0][0], a[1][1], a[2][2]], projections)
}

/// Jacobi's rotation that makes `a[p][q]` zero; `r` is the third index.
///
/// tan θ = 2 a_pq sgn(d) / (|d| + √(d² + 4 a_pq²)), d = a_qq − a_pp: the smaller of the two angles.
#[inline(always)]
fn rotate<L: Lane>(a: &mut [[L; 3]; 3], axes: &mut [[L; 3]; 3], p: usize, q: usize, r: usize) {
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    let difference = a[q][q] - a[p][p];
    let twice = a[p][q] + a[p][q];
    let below = difference.abs() + (difference * difference + twice * twice).sqrt();
    let above = L::select(difference.less(zero), -twice, twice);
    let tan = above / L::select(zero.less(below), below, one);
    let cos = one / (tan * tan + one).sqrt();
    let sin = tan * cos;
    a[p][p] = a[p][p] - tan * a[p][q];
    a[q][q] += tan * a[p][q];
    (a[p][q], a[q][p]) = (zero, zero);
    let (left, right) = (cos * a[r][p] - sin * a[r][q], sin * a[r][p] + cos * a[r][q]);
    (a[r][p], a[p][r], a[r][q], a[q][r]) = (left, left, right, right);
    for k in 0..3 {
        (axes[k][p], axes[k][q]) = (cos * axes[k][p] - sin * axes[k][q], sin * axes[k][p] + cos * axes[k][q]);
    }
}

#[cfg(test)]
mod tests {
    use super::super::{SymmetricTensor, product};
    use super::*;
    use embate_lanes::{BATCH, Batch, Kernel, Level};

    fn numbers(seed: u64) -> impl FnMut() -> f64 {
        let mut state = seed;
        move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        }
    }

    /// Q diag(values) Qᵀ for a random rotation Q.
    fn turned(values: [f64; 3], mut next: impl FnMut() -> f64) -> Solid<f64> {
        let mut q = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        for axis in 0..3 {
            let (s, c) = (3.0 * next()).sin_cos();
            let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
            let mut turn = [[0.0; 3]; 3];
            turn[axis][axis] = 1.0;
            (turn[i][i], turn[i][j], turn[j][i], turn[j][j]) = (c, -s, s, c);
            q = product(&q, &turn);
        }
        Solid([values[0], values[1], values[2], 0.0, 0.0, 0.0]).rotated(&q)
    }

    /// Largest fault of the decomposition: T = Σ λ P, Σ P = I, P:P = δ.
    fn fault<T: SymmetricTensor<f64>>(t: T, (values, projections): ([f64; 3], [T; 3])) -> f64 {
        let mut sum = t.times(-1.0);
        let mut unit = T::isotropic(-1.0);
        let mut worst = 0.0f64;
        for i in 0..3 {
            sum = sum.plus(projections[i].times(values[i]));
            unit = unit.plus(projections[i]);
            for j in 0..3 {
                worst = worst.max((projections[i].contract(projections[j]) - f64::from(u8::from(i == j))).abs());
            }
        }
        worst.max(sum.contract(sum).sqrt() / t.contract(t).sqrt().max(1e-300)).max(unit.contract(unit).sqrt())
    }

    #[test]
    fn principal_values_are_found_whether_random_equal_or_nearly_so() {
        let mut next = numbers(5);
        for round in 0..4000 {
            let base = [next(), next(), next()];
            let near = [0.0, 1e-16, 1e-12, 1e-8, 1e-4][round % 5];
            let values = match round % 4 {
                0 => base,
                1 => [base[0], base[0] + near, base[2]],
                2 => [base[0], base[0] + near, base[0] - 2.0 * near],
                _ => [1e6 * base[0], base[1], 1e-6 * base[2]],
            };
            let t = turned(values, &mut next);
            let (mut found, projections) = t.principal();
            assert!(fault(t, (found, projections)) < 2e-14, "{values:?}: {}", fault(t, (found, projections)));
            let mut expected = values;
            found.sort_by(f64::total_cmp);
            expected.sort_by(f64::total_cmp);
            let size = values.iter().fold(0.0f64, |size, value| size.max(value.abs()));
            assert!((0..3).all(|i| (found[i] - expected[i]).abs() < 1e-14 * size), "{found:?} for {expected:?}");
            let flat = Plane([base[0], base[0] + near * base[1], base[2], if round % 3 == 0 { 0.0 } else { near * next() }]);
            assert!(fault(flat, flat.principal()) < 4e-15, "{flat:?}");
        }
        for t in [Solid([0.0; 6]), Solid([2.0, 2.0, 2.0, 0.0, 0.0, 0.0]), Solid([0.0, 0.0, 0.0, 1e-170, 0.0, 0.0])] {
            assert!(fault(t, t.principal()) < 1e-15);
        }
    }

    struct Values<'a>(&'a [Batch]);

    impl Kernel for Values<'_> {
        type Output = Vec<u64>;
        #[inline(always)]
        fn run<L: Lane>(self) -> Vec<u64> {
            let mut out = vec![Batch::default(); 3 + 6];
            let mut bits = Vec::new();
            for input in self.0.chunks_exact(6) {
                for at in (0..BATCH).step_by(L::WIDTH) {
                    let (values, projections) = <Solid<L> as SymmetricTensor<L>>::load(input, at).principal();
                    for i in 0..3 {
                        values[i].store(&mut out[i], at);
                    }
                    projections[1].store(&mut out[3..], at);
                }
                bits.extend(out.iter().flat_map(|batch| batch.0).map(f64::to_bits));
            }
            bits
        }
    }

    #[test]
    fn every_instruction_set_finds_the_same_bits() {
        let mut next = numbers(9);
        let inputs: Vec<Batch> = (0..600).map(|_| Batch(std::array::from_fn(|_| next()))).collect();
        let reference = Level::SCALAR.run(Values(&inputs));
        for level in Level::available() {
            assert!(level.run(Values(&inputs)) == reference, "{}", level.name());
        }
    }
}
