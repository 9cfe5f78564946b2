//! What space knows of matrices: [`Space`] for three dimensions. The plane's is beside the trait.
//!
//! Hughes and Winget's rotation of a skew matrix W with the axial vector w (W v = w × v) is that by the angle
//! θ about w with tan(θ/2) = |w|/2. With a = w/2 and A v = a × v it is Q = I + 2 (A + A²) / (1 + a·a), and
//! half of it, with r = √(1 + a·a), is I + A/r + A²/(r (1 + r)). Source: Hughes and Winget, Int. J. Numer.
//! Meth. Engng 15 (1980) 1862-1867; Rodrigues's formula.

use super::{Dim, Matrix, Solid, Space, scaled};
use embate_lanes::Lane;

/// Cross product.
#[inline(always)]
pub fn cross<L: Lane>(a: [L; 3], b: [L; 3]) -> [L; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Scalar product.
#[inline(always)]
pub fn dot<L: Lane>(a: [L; 3], b: [L; 3]) -> L {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// I + `first` A + `second` A² with A v = a × v; A² = a aᵀ − (a·a) I.
#[inline(always)]
fn about<L: Lane>(a: [L; 3], first: L, second: L) -> Matrix<L, 3> {
    let one = L::splat(1.0);
    let (sin, squares) = ([a[0] * first, a[1] * first, a[2] * first], [a[0] * second, a[1] * second, a[2] * second]);
    let (xx, yy, zz) = (a[0] * squares[0], a[1] * squares[1], a[2] * squares[2]);
    let (xy, yz, zx) = (a[0] * squares[1], a[1] * squares[2], a[2] * squares[0]);
    [[one - (yy + zz), xy - sin[2], zx + sin[1]], [xy + sin[2], one - (zz + xx), yz - sin[0]], [zx - sin[1], yz + sin[0], one - (xx + yy)]]
}

impl Space<3> for Dim<3> {
    type Tensor<L: Lane> = Solid<L>;

    #[inline(always)]
    fn determinant<L: Lane>(m: &Matrix<L, 3>) -> L {
        dot(m[0], cross(m[1], m[2]))
    }
    #[inline(always)]
    fn adjugate<L: Lane>(m: &Matrix<L, 3>) -> Matrix<L, 3> {
        let (a, b, c) = (cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]));
        [[a[0], b[0], c[0]], [a[1], b[1], c[1]], [a[2], b[2], c[2]]]
    }
    #[inline(always)]
    fn symmetric<L: Lane>(g: &Matrix<L, 3>) -> Solid<L> {
        let half = L::splat(0.5);
        Solid([g[0][0], g[1][1], g[2][2], (g[0][1] + g[1][0]) * half, (g[1][2] + g[2][1]) * half, (g[2][0] + g[0][2]) * half])
    }
    #[inline(always)]
    fn increment<L: Lane>(g: &Matrix<L, 3>, determinant: L) -> (Matrix<L, 3>, [Matrix<L, 3>; 2]) {
        // All times det B: a = w/2, w of half the differences. An inverted element gets something finite.
        let quarter = L::splat(0.25);
        let a = [(g[2][1] - g[1][2]) * quarter, (g[0][2] - g[2][0]) * quarter, (g[1][0] - g[0][1]) * quarter];
        let size = determinant.abs();
        let sum = size * size + dot(a, a);
        let root = sum.sqrt();
        let both = size + root;
        let inverse = L::splat(1.0) / (determinant * sum * both);
        let of_both = inverse * determinant;
        let of_sum = of_both * both;
        let twice = of_sum + of_sum;
        // 1/r = det/√sum and 1/(r (1 + r)) = det²/(√sum (det + √sum)).
        let half = about(a, of_sum * root, of_both * root);
        (scaled(*g, inverse * sum * both), [half, about(a, twice * determinant, twice)])
    }
    #[inline(always)]
    fn turned<L: Lane>(vector: [L; 3], turns: &[Matrix<L, 3>; 2]) -> [L; 3] {
        let q = &turns[1];
        [dot(q[0], vector), dot(q[1], vector), dot(q[2], vector)]
    }
    #[inline(always)]
    fn left_cauchy_green<L: Lane>(f: &Matrix<L, 3>, scale: L) -> Solid<L> {
        Solid([
            dot(f[0], f[0]) * scale,
            dot(f[1], f[1]) * scale,
            dot(f[2], f[2]) * scale,
            dot(f[0], f[1]) * scale,
            dot(f[1], f[2]) * scale,
            dot(f[2], f[0]) * scale,
        ])
    }
    #[inline(always)]
    fn flux<L: Lane>(t: &Solid<L>, a: &Matrix<L, 3>) -> Matrix<L, 3> {
        let [xx, yy, zz, xy, yz, zx] = t.0;
        let rows = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
        let mut out = *a;
        for i in 0..3 {
            for k in 0..3 {
                out[i][k] = dot(rows[i], a[k]);
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tensor::{SymmetricTensor, Turn, product};

    type Full = Matrix<f64, 3>;
    const UNIT: Full = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

    fn combined(a: &Full, by: f64, b: &Full) -> Full {
        std::array::from_fn(|i| std::array::from_fn(|j| a[i][j] + by * b[i][j]))
    }

    fn farthest(a: &Full, b: &Full) -> f64 {
        (0..9).map(|k| (a[k / 3][k % 3] - b[k / 3][k % 3]).abs()).fold(0.0, f64::max)
    }

    /// Rotation by an angle about an axis, by the textbook's formula.
    fn rotation(axis: [f64; 3], angle: f64) -> Full {
        let length = dot(axis, axis).sqrt();
        let [x, y, z] = axis.map(|c| c / length);
        let (skew, (s, c)) = ([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]], angle.sin_cos());
        combined(&combined(&UNIT, s, &skew), 1.0 - c, &product(&skew, &skew))
    }

    #[test]
    fn a_matrix_times_its_adjugate_is_its_determinant() {
        let m = [[3.0, -1.0, 0.5], [2.0, 1.1, -0.3], [0.7, 0.2, -2.0]];
        let p = product(&m, &Dim::<3>::adjugate(&m));
        assert!(farthest(&p, &scaled(UNIT, Dim::<3>::determinant(&m))) < 1e-14);
    }

    #[test]
    fn the_mid_step_gradient_of_a_rigid_rotation_of_any_size_gives_no_strain_and_the_exact_rotation() {
        for axis in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, -2.0, 0.5], [-0.3, 0.4, 3.0]] {
            for angle in [0.0, 1e-9, 0.01, 0.4, 1.5, 3.0] {
                let q = rotation(axis, angle);
                // x = Q J, mid-step configuration ½ (I + Q) J, displacement (Q − I) J, in any natural
                // coordinates
                let j = [[3.0, -1.0, 0.5], [2.0, 1.1, -0.3], [0.7, 0.2, 2.0]];
                let (natural, middle) = (product(&combined(&q, -1.0, &UNIT), &j), product(&scaled(combined(&q, 1.0, &UNIT), 0.5), &j));
                let (gradient, [half, whole]) = Dim::<3>::displaced(&natural, &Dim::<3>::adjugate(&middle), Dim::<3>::determinant(&middle));
                let strain = Dim::<3>::symmetric(&gradient);
                // tan(θ/2) = half the spin, so round-off grows with it.
                let size = 1e-14 * (1.0 + (0.5 * angle).tan().powi(2));
                assert!(strain.contract(strain).sqrt() < size, "{axis:?} {angle}: {strain:?}");
                assert!(farthest(&whole, &q) < size, "{axis:?} {angle}: {whole:?} for {q:?}");
                assert!(farthest(&half, &rotation(axis, 0.5 * angle)) < size, "{axis:?} {angle}");
                assert!(farthest(&product(&half, &half), &whole) < size, "half twice is whole");
                assert!(farthest(&product(&whole.inverse(), &whole), &UNIT) < size, "it is a rotation");
                let turned = Dim::<3>::turned([1.0, 2.0, 3.0], &[half, whole]);
                assert!((0..3).all(|i| (turned[i] - dot(q[i], [1.0, 2.0, 3.0])).abs() < 4.0 * size));
            }
        }
    }

    #[test]
    fn the_gradient_of_a_displacement_is_that_in_3d_and_in_2d() {
        let natural = [[0.3, -0.1, 0.0], [0.2, 0.4, 0.0], [0.0, 0.0, 0.0]];
        let map = [[2.0, 0.3, 0.0], [-0.4, 1.5, 0.0], [0.0, 0.0, 1.0]];
        let (gradient, [half, whole]) = Dim::<3>::displaced(&natural, &Dim::<3>::adjugate(&map), Dim::<3>::determinant(&map));
        let plane = |m: &Full| [[m[0][0], m[0][1]], [m[1][0], m[1][1]]];
        let (of_plane, map) = (plane(&natural), plane(&map));
        let (expected, turns) = Dim::<2>::displaced(&of_plane, &Dim::<2>::adjugate(&map), Dim::<2>::determinant(&map));
        for k in 0..4 {
            assert!((gradient[k / 2][k % 2] - expected[k / 2][k % 2]).abs() < 1e-15);
        }
        let [xx, yy, zz, xy] = [3.0, -1.0, 0.5, 2.0];
        for (turn, expected) in [half, whole].iter().zip(&turns) {
            let (a, b) = (Solid([xx, yy, zz, xy, 0.0, 0.0]).rotated(turn).0, crate::tensor::Plane([xx, yy, zz, xy]).rotated(expected).0);
            assert!((0..4).all(|c| (a[c] - b[c]).abs() < 1e-14), "{a:?} {b:?}");
        }
    }

    #[test]
    fn tensors_of_deformation_and_flux_are_products_of_matrices() {
        let f = [[1.2, -0.1, 0.3], [0.2, 0.9, -0.3], [0.1, 0.2, 1.1]];
        let full = |t: Solid<f64>| {
            let [xx, yy, zz, xy, yz, zx] = t.0;
            [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]]
        };
        let b = Dim::<3>::left_cauchy_green(&f, 2.0);
        assert!(farthest(&full(b), &scaled(product(&f, &f.inverse()), 2.0)) < 1e-15);
        assert!(farthest(&full(Dim::<3>::symmetric(&f)), &scaled(combined(&f, 1.0, &f.inverse()), 0.5)) < 1e-15);
        assert!(farthest(&Dim::<3>::flux(&b, &f), &product(&full(b), &f.inverse())) < 1e-15);
    }
}
