//! Small tensors over lanes: symmetric second-order tensors in 2D (xx yy zz xy) and 3D (xx yy zz xy yz zx)
//! behind one trait, and the matrices of a dimension ([`Space`]). Material laws see only [`SymmetricTensor`].
//!
//! Code over lanes has no closures: the compiler gives a closure the instruction set of the machine's
//! baseline, and every operation in it becomes a call (measured: ten times slower than scalar code). Loops
//! over small arrays are unrolled instead.

mod principal;
mod space;

pub use space::{cross, dot};

use embate_lanes::{Batch, Lane};

/// A symmetric second-order tensor whose components are lanes. The plane form keeps the out-of-plane normal
/// component.
pub trait SymmetricTensor<L: Lane>: Copy {
    /// Number of stored components.
    const COMPONENTS: usize;
    /// A rotation that can be applied to it.
    type Rotation: Turn<L>;

    /// Components from the batches `from[0..COMPONENTS]`, lanes from `at` on.
    fn load(from: &[Batch], at: usize) -> Self;
    /// Writes the components to the batches `to[0..COMPONENTS]`, lanes from `at` on.
    fn store(self, to: &mut [Batch], at: usize);
    /// `value` times the unit tensor.
    fn isotropic(value: L) -> Self;
    /// Sum.
    #[must_use]
    fn plus(self, other: Self) -> Self;
    /// Sum with `value` times the unit tensor.
    #[must_use]
    fn plus_isotropic(self, value: L) -> Self;
    /// All components times `factor`.
    #[must_use]
    fn times(self, factor: L) -> Self;
    /// Σ T_ii.
    fn trace(self) -> L;
    /// Double contraction A:B = Σ_ij A_ij B_ij.
    fn contract(self, other: Self) -> L;
    /// Component zz: out of the plane, or along the third axis in 3D.
    fn zz(self) -> L;
    /// The same tensor with `value` added to component zz.
    #[must_use]
    fn plus_zz(self, value: L) -> Self;
    /// Determinant.
    fn determinant(self) -> L;
    /// Adjugate: T adj(T) = det(T) I; of a tensor of determinant one the inverse.
    #[must_use]
    fn adjugate(self) -> Self;
    /// Components xx yy zz xy yz zx; zero where the dimension has none.
    fn components(self) -> [L; 6];
    /// From xx yy zz xy yz zx; what the dimension does not have is dropped.
    fn from_components(components: [L; 6]) -> Self;
    /// Eigenvalues λ_i, in no order, and projections n_i n_iᵀ onto their axes; any orthogonal axes where
    /// eigenvalues coincide.
    fn principal(self) -> ([L; 3], [Self; 3]);
    /// Q T Qᵀ.
    #[must_use]
    fn rotated(self, rotation: &Self::Rotation) -> Self;

    /// Deviator T − (tr T / 3) I.
    #[inline(always)]
    #[must_use]
    fn deviator(self) -> Self {
        self.plus_isotropic(self.trace() * L::splat(-1.0 / 3.0))
    }
}

/// A rotation as a symmetric tensor feels it, for storage between the parts of a kernel.
pub trait Turn<L: Lane>: Copy {
    /// Number of stored components.
    const COMPONENTS: usize;
    /// No rotation.
    fn none() -> Self;
    /// About the third axis, from cos θ and sin θ.
    fn about_z(cos: L, sin: L) -> Self;
    /// This rotation, then the `next`; fixed so that it stays one over any number of steps.
    #[must_use]
    fn then(&self, next: &Self) -> Self;
    /// The way back.
    #[must_use]
    fn inverse(&self) -> Self;
    /// Components from the batches `from[0..COMPONENTS]`, lanes from `at` on.
    fn load(from: &[Batch], at: usize) -> Self;
    /// Writes the components to the batches `to[0..COMPONENTS]`, lanes from `at` on.
    fn store(self, to: &mut [Batch], at: usize);
}

/// Symmetric tensor in 2D, with what is normal to it: xx yy zz xy.
#[derive(Clone, Copy, Debug)]
pub struct Plane<L>(pub [L; 4]);

/// Symmetric tensor in 3D: xx yy zz xy yz zx.
#[derive(Clone, Copy, Debug)]
pub struct Solid<L>(pub [L; 6]);

/// Everything that does not depend on how many off-diagonal components there are.
macro_rules! componentwise {
    ($count:literal) => {
        const COMPONENTS: usize = $count;
        #[inline(always)]
        fn load(from: &[Batch], at: usize) -> Self {
            let mut t = [L::splat(0.0); $count];
            for c in 0..$count {
                t[c] = L::load(&from[c], at);
            }
            Self(t)
        }
        #[inline(always)]
        fn store(self, to: &mut [Batch], at: usize) {
            for c in 0..$count {
                self.0[c].store(&mut to[c], at);
            }
        }
        #[inline(always)]
        fn isotropic(value: L) -> Self {
            let mut t = Self([L::splat(0.0); $count]);
            (t.0[0], t.0[1], t.0[2]) = (value, value, value);
            t
        }
        #[inline(always)]
        fn plus(mut self, other: Self) -> Self {
            for c in 0..$count {
                self.0[c] += other.0[c];
            }
            self
        }
        #[inline(always)]
        fn plus_isotropic(mut self, value: L) -> Self {
            for c in 0..3 {
                self.0[c] += value;
            }
            self
        }
        #[inline(always)]
        fn times(mut self, factor: L) -> Self {
            for c in 0..$count {
                self.0[c] = self.0[c] * factor;
            }
            self
        }
        #[inline(always)]
        fn trace(self) -> L {
            self.0[0] + self.0[1] + self.0[2]
        }
        #[inline(always)]
        fn zz(self) -> L {
            self.0[2]
        }
        #[inline(always)]
        fn plus_zz(mut self, value: L) -> Self {
            self.0[2] += value;
            self
        }
        // In 2D the loop over the remaining shear components is empty.
        #[allow(clippy::reversed_empty_ranges)]
        #[inline(always)]
        fn contract(self, other: Self) -> L {
            let (a, b) = (self.0, other.0);
            let mut shear = a[3] * b[3];
            for c in 4..$count {
                shear += a[c] * b[c];
            }
            (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) + (shear + shear)
        }
    };
}

/// Rotation in 2D by an angle θ, as a symmetric tensor feels it: [cos 2θ, sin 2θ].
#[derive(Clone, Copy, Debug)]
pub struct PlaneRotation<L>(pub [L; 2]);

impl<L: Lane> PlaneRotation<L> {
    /// From cos θ and sin θ.
    #[inline(always)]
    pub fn new(cos: L, sin: L) -> Self {
        let twice = sin + sin;
        Self([L::splat(1.0) - sin * twice, cos * twice])
    }
}

impl<L: Lane> Turn<L> for PlaneRotation<L> {
    const COMPONENTS: usize = 2;

    #[inline(always)]
    fn none() -> Self {
        Self([L::splat(1.0), L::splat(0.0)])
    }
    #[inline(always)]
    fn about_z(cos: L, sin: L) -> Self {
        Self::new(cos, sin)
    }
    #[inline(always)]
    fn then(&self, next: &Self) -> Self {
        let ([c, s], [cos, sin]) = (self.0, next.0);
        let (c, s) = (c * cos - s * sin, s * cos + c * sin);
        let length = (c * c + s * s).sqrt();
        Self([c / length, s / length])
    }
    #[inline(always)]
    fn inverse(&self) -> Self {
        Self([self.0[0], -self.0[1]])
    }
    #[inline(always)]
    fn load(from: &[Batch], at: usize) -> Self {
        Self([L::load(&from[0], at), L::load(&from[1], at)])
    }
    #[inline(always)]
    fn store(self, to: &mut [Batch], at: usize) {
        self.0[0].store(&mut to[0], at);
        self.0[1].store(&mut to[1], at);
    }
}

impl<L: Lane> Turn<L> for Matrix<L, 3> {
    const COMPONENTS: usize = 9;

    #[inline(always)]
    fn none() -> Self {
        let mut q = [[L::splat(0.0); 3]; 3];
        for i in 0..3 {
            q[i][i] = L::splat(1.0);
        }
        q
    }
    #[inline(always)]
    fn about_z(cos: L, sin: L) -> Self {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        [[cos, -sin, zero], [sin, cos, zero], [zero, zero, one]]
    }
    #[inline(always)]
    fn then(&self, next: &Self) -> Self {
        // One step of Newton's iteration for the polar factor, Q ← ½ Q (3 I − Qᵀ Q): round-off off a rotation
        // is squared away.
        let q = product(next, self);
        let mut mend = product(&q.inverse(), &q);
        for i in 0..3 {
            for j in 0..3 {
                mend[i][j] = mend[i][j] * L::splat(-0.5);
            }
            mend[i][i] += L::splat(1.5);
        }
        product(&q, &mend)
    }
    #[inline(always)]
    fn inverse(&self) -> Self {
        let mut transposed = *self;
        for i in 0..3 {
            for j in 0..3 {
                transposed[i][j] = self[j][i];
            }
        }
        transposed
    }
    #[inline(always)]
    fn load(from: &[Batch], at: usize) -> Self {
        let mut q = [[L::splat(0.0); 3]; 3];
        for k in 0..9 {
            q[k / 3][k % 3] = L::load(&from[k], at);
        }
        q
    }
    #[inline(always)]
    fn store(self, to: &mut [Batch], at: usize) {
        for k in 0..9 {
            self[k / 3][k % 3].store(&mut to[k], at);
        }
    }
}

impl<L: Lane> SymmetricTensor<L> for Plane<L> {
    type Rotation = PlaneRotation<L>;
    componentwise!(4);

    #[inline(always)]
    fn determinant(self) -> L {
        let [xx, yy, zz, xy] = self.0;
        (xx * yy - xy * xy) * zz
    }

    #[inline(always)]
    fn adjugate(self) -> Self {
        let [xx, yy, zz, xy] = self.0;
        Self([yy * zz, xx * zz, xx * yy - xy * xy, -(xy * zz)])
    }

    #[inline(always)]
    fn components(self) -> [L; 6] {
        let [xx, yy, zz, xy] = self.0;
        [xx, yy, zz, xy, L::splat(0.0), L::splat(0.0)]
    }

    #[inline(always)]
    fn from_components(components: [L; 6]) -> Self {
        Self([components[0], components[1], components[2], components[3]])
    }

    #[inline(always)]
    fn principal(self) -> ([L; 3], [Self; 3]) {
        principal::plane(self)
    }

    #[inline(always)]
    fn rotated(self, rotation: &PlaneRotation<L>) -> Self {
        // The sum stays; half difference and shear turn by 2θ.
        let [c, s] = rotation.0;
        let [xx, yy, zz, xy] = self.0;
        let difference = (xx - yy) * L::splat(0.5);
        let change = (difference * c - xy * s) - difference;
        Self([xx + change, yy - change, zz, difference * s + xy * c])
    }
}

impl<L: Lane> SymmetricTensor<L> for Solid<L> {
    type Rotation = [[L; 3]; 3];
    componentwise!(6);

    #[inline(always)]
    fn determinant(self) -> L {
        let [xx, yy, zz, xy, yz, zx] = self.0;
        xx * (yy * zz - yz * yz) + xy * (yz * zx - xy * zz) + zx * (xy * yz - yy * zx)
    }

    #[inline(always)]
    fn adjugate(self) -> Self {
        let [xx, yy, zz, xy, yz, zx] = self.0;
        Self([yy * zz - yz * yz, zz * xx - zx * zx, xx * yy - xy * xy, yz * zx - xy * zz, zx * xy - yz * xx, xy * yz - zx * yy])
    }

    #[inline(always)]
    fn components(self) -> [L; 6] {
        self.0
    }

    #[inline(always)]
    fn from_components(components: [L; 6]) -> Self {
        Self(components)
    }

    #[inline(always)]
    fn principal(self) -> ([L; 3], [Self; 3]) {
        principal::solid(self)
    }

    #[inline(always)]
    fn rotated(self, q: &[[L; 3]; 3]) -> Self {
        let [xx, yy, zz, xy, yz, zx] = self.0;
        let t = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
        let r = product(&product(q, &t), &q.inverse());
        Self([r[0][0], r[1][1], r[2][2], r[0][1], r[1][2], r[2][0]])
    }
}

/// A matrix of lanes.
pub type Matrix<L, const D: usize> = [[L; D]; D];

/// Matrix product A B.
#[inline(always)]
pub fn product<L: Lane, const D: usize>(a: &Matrix<L, D>, b: &Matrix<L, D>) -> Matrix<L, D> {
    let mut out = [[L::splat(0.0); D]; D];
    for i in 0..D {
        for j in 0..D {
            out[i][j] = a[i][0] * b[0][j];
            for k in 1..D {
                out[i][j] += a[i][k] * b[k][j];
            }
        }
    }
    out
}

/// Matrix times a number.
#[inline(always)]
pub fn scaled<L: Lane, const D: usize>(mut a: Matrix<L, D>, factor: L) -> Matrix<L, D> {
    for row in &mut a {
        for value in row {
            *value = *value * factor;
        }
    }
    a
}

/// What a dimension knows: its symmetric tensor, and how matrices become tensors.
pub trait Space<const D: usize> {
    /// Symmetric tensor of stress and strain.
    type Tensor<L: Lane>: SymmetricTensor<L>;

    /// Determinant.
    fn determinant<L: Lane>(m: &Matrix<L, D>) -> L;
    /// Adjugate: M adj(M) = det(M) I.
    fn adjugate<L: Lane>(m: &Matrix<L, D>) -> Matrix<L, D>;
    /// Symmetric part of a displacement gradient: the strain increment.
    fn symmetric<L: Lane>(gradient: &Matrix<L, D>) -> Self::Tensor<L>;
    /// Gradient A B⁻¹ of a displacement with the natural gradient A in the mid-step configuration with
    /// Jacobian B, and Hughes and Winget's rotation (I − ½W)⁻¹ (I + ½W) of its skew part W, [half of it, all
    /// of it]; exact (and the strain increment zero) for a rigid rotation. Half of it turns the mid-step
    /// strain increment to the end of the step. B is given as adjugate and determinant: one division does it
    /// all. Hughes and Winget 1980.
    #[inline(always)]
    fn displaced<L: Lane>(natural: &Matrix<L, D>, adjugate: &Matrix<L, D>, determinant: L) -> (Matrix<L, D>, Turns<Self::Tensor<L>, L>) {
        Self::increment(&product(natural, adjugate), determinant)
    }
    /// The same from `determinant` times the gradient.
    fn increment<L: Lane>(gradient: &Matrix<L, D>, determinant: L) -> (Matrix<L, D>, Turns<Self::Tensor<L>, L>);
    /// A vector that goes with the rotation of [`Space::displaced`].
    fn turned<L: Lane>(vector: [L; D], turns: &Turns<Self::Tensor<L>, L>) -> [L; D];
    /// `scale` F Fᵀ, out-of-plane component `scale` in 2D.
    fn left_cauchy_green<L: Lane>(f: &Matrix<L, D>, scale: L) -> Self::Tensor<L>;
    /// T Aᵀ with the in-space part of T: `flux[i][k] = Σ_j T_ij A_kj`.
    fn flux<L: Lane>(t: &Self::Tensor<L>, a: &Matrix<L, D>) -> Matrix<L, D>;
}

/// Half a rotation, and all of it.
pub type Turns<T, L> = [<T as SymmetricTensor<L>>::Rotation; 2];

/// The type that stands for dimension `D`.
#[derive(Clone, Copy, Debug)]
pub struct Dim<const D: usize>;

impl Space<2> for Dim<2> {
    type Tensor<L: Lane> = Plane<L>;

    #[inline(always)]
    fn determinant<L: Lane>(m: &Matrix<L, 2>) -> L {
        m[0][0] * m[1][1] - m[0][1] * m[1][0]
    }
    #[inline(always)]
    fn adjugate<L: Lane>(m: &Matrix<L, 2>) -> Matrix<L, 2> {
        [[m[1][1], -m[0][1]], [-m[1][0], m[0][0]]]
    }
    #[inline(always)]
    fn symmetric<L: Lane>(g: &Matrix<L, 2>) -> Plane<L> {
        Plane([g[0][0], g[1][1], L::splat(0.0), (g[0][1] + g[1][0]) * L::splat(0.5)])
    }
    #[inline(always)]
    fn increment<L: Lane>(g: &Matrix<L, 2>, determinant: L) -> (Matrix<L, 2>, [PlaneRotation<L>; 2]) {
        // All times det B: tan(θ/2) = ω/2 with ω = ½(g_yx − g_xy)
        let half = (g[1][0] - g[0][1]) * L::splat(0.25);
        let (square, one) = (half * half, determinant * determinant);
        let sum = one + square;
        let inverse = L::splat(1.0) / (determinant * sum);
        let of_sum = inverse * determinant;
        let (cos, sin) = ((one - square) * of_sum, (half + half) * determinant * of_sum);
        // A tensor feels twice the angle: half the rotation is θ to it.
        (scaled(*g, inverse * sum), [PlaneRotation([cos, sin]), PlaneRotation::new(cos, sin)])
    }
    #[inline(always)]
    fn turned<L: Lane>([x, y]: [L; 2], turns: &[PlaneRotation<L>; 2]) -> [L; 2] {
        // A vector feels half of what a tensor feels.
        let [cos, sin] = turns[0].0;
        [cos * x - sin * y, sin * x + cos * y]
    }
    #[inline(always)]
    fn left_cauchy_green<L: Lane>(f: &Matrix<L, 2>, scale: L) -> Plane<L> {
        let [[a, b], [c, d]] = *f;
        Plane([(a * a + b * b) * scale, (c * c + d * d) * scale, scale, (a * c + b * d) * scale])
    }
    #[inline(always)]
    fn flux<L: Lane>(t: &Plane<L>, a: &Matrix<L, 2>) -> Matrix<L, 2> {
        let [xx, yy, _, xy] = t.0;
        [[xx * a[0][0] + xy * a[0][1], xx * a[1][0] + xy * a[1][1]], [xy * a[0][0] + yy * a[0][1], xy * a[1][0] + yy * a[1][1]]]
    }
}

/// Equivalent stress of von Mises of (xx, yy, zz, xy, yz, zx), Pa: √(½ Σ (σ_ii − σ_jj)² + 3 Σ σ_ij²).
pub(crate) fn von_mises(s: &[f64; 6]) -> f64 {
    let differences = (s[0] - s[1]).powi(2) + (s[1] - s[2]).powi(2) + (s[2] - s[0]).powi(2);
    (0.5 * differences + 3.0 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5])).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rotation_matrix(axis: usize, angle: f64) -> [[f64; 3]; 3] {
        let (s, c) = angle.sin_cos();
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut q = [[0.0; 3]; 3];
        q[axis][axis] = 1.0;
        (q[i][i], q[i][j], q[j][i], q[j][j]) = (c, -s, s, c);
        q
    }

    #[test]
    fn plane_and_space_rotate_alike_about_z() {
        let plane = Plane([3.0, -1.0, 0.5, 2.0]);
        let solid = Solid([3.0, -1.0, 0.5, 2.0, 0.0, 0.0]);
        let angle = 0.7f64;
        let p = plane.rotated(&PlaneRotation::new(angle.cos(), angle.sin())).0;
        let s = solid.rotated(&rotation_matrix(2, angle)).0;
        for c in 0..4 {
            assert!((p[c] - s[c]).abs() < 1e-15, "{c}");
        }
        assert!(s[4].abs() + s[5].abs() < 1e-15);
        assert_eq!((plane.determinant(), solid.determinant()), (-3.5, -3.5));
    }

    #[test]
    fn rotation_keeps_trace_and_norm() {
        let t = Solid([3.0, -1.0, 0.5, 2.0, -0.3, 1.1]);
        let r = t.rotated(&rotation_matrix(0, 0.3)).rotated(&rotation_matrix(1, -1.3));
        assert!((t.trace() - r.trace()).abs() < 1e-14);
        assert!((t.contract(t) - r.contract(r)).abs() < 1e-13);
        assert!((t.determinant() - r.determinant()).abs() < 1e-13);
        assert!(t.deviator().trace().abs() < 1e-15);
    }

    #[test]
    fn a_tensor_times_its_adjugate_is_its_determinant() {
        let t = Solid([3.0, -1.0, 0.5, 2.0, -0.3, 1.1]);
        let full = |t: Solid<f64>| {
            let [xx, yy, zz, xy, yz, zx] = t.components();
            [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]]
        };
        let p = product(&full(t), &full(t.adjugate()));
        for i in 0..3 {
            for j in 0..3 {
                assert!((p[i][j] - if i == j { t.determinant() } else { 0.0 }).abs() < 1e-14);
            }
        }
        let plane = Plane([3.0, -1.0, 0.5, 2.0]);
        let (a, b) = (plane.adjugate().components(), Solid([3.0, -1.0, 0.5, 2.0, 0.0, 0.0]).adjugate().0);
        assert!((0..6).all(|c| (a[c] - b[c]).abs() < 1e-15), "{a:?} {b:?}");
        assert_eq!(Plane::from_components(plane.components()).0, plane.0);
    }

    #[test]
    fn a_million_small_rotations_stay_a_rotation() {
        let (steps, angle) = (1_000_000, 0.01f64);
        let step = PlaneRotation::about_z(angle.cos(), angle.sin());
        let step_space = product(&rotation_matrix(0, 0.02), &rotation_matrix(2, angle));
        let (mut plane, mut space) = (PlaneRotation::none(), <[[f64; 3]; 3]>::none());
        for _ in 0..steps {
            (plane, space) = (plane.then(&step), space.then(&step_space));
        }
        let (s, c) = (2.0 * angle * f64::from(steps)).sin_cos();
        assert!((plane.0[0] - c).abs() < 1e-9 && (plane.0[1] - s).abs() < 1e-9, "{plane:?} for {c} {s}");
        let back = space.inverse().then(&space);
        let unit = <[[f64; 3]; 3]>::none();
        assert!((0..9).all(|k| (back[k / 3][k % 3] - unit[k / 3][k % 3]).abs() < 1e-14), "{back:?}");
        let t = Plane([3.0, -1.0, 0.5, 2.0]);
        let there = t.rotated(&plane).rotated(&plane.inverse()).0;
        assert!((0..4).all(|k| (there[k] - t.0[k]).abs() < 1e-14));
    }

    #[test]
    fn the_mid_step_gradient_of_a_rigid_rotation_gives_no_strain_and_the_exact_rotation() {
        let angle = 0.4f64;
        let (s, c) = angle.sin_cos();
        // x = Q X, mid-step configuration ½(I + Q) X, displacement (Q − I) X
        let step = [[c - 1.0, -s], [s, c - 1.0]];
        let mid = [[0.5 * (1.0 + c), -0.5 * s], [0.5 * s, 0.5 * (1.0 + c)]];
        let det = Dim::<2>::determinant(&mid);
        let (gradient, [PlaneRotation(half), PlaneRotation(whole)]) = Dim::<2>::displaced(&step, &Dim::<2>::adjugate(&mid), det);
        let strain = Dim::<2>::symmetric(&gradient);
        assert!(strain.contract(strain) < 1e-31);
        // tan(θ/2) = half the spin: the mid-step spin of a rotation by θ is 2 tan(θ/2)
        for (rotation, angle) in [(half, 0.5 * angle), (whole, angle)] {
            let (s, c) = (2.0 * angle).sin_cos();
            assert!((rotation[0] - c).abs() < 1e-15 && (rotation[1] - s).abs() < 1e-15);
        }
    }
}
