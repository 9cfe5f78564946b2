//! Hourglass control of the one-point hexahedron by assumed strain: what bending, twisting and warping of an
//! elastic brick cost, and no more.
//!
//! The patterns h₁ = ηζ, h₂ = ζξ, h₃ = ξη, h₄ = ξηζ with amplitudes q_α (see [`super::hex8_reduced`]), in
//! components along the lines through the middles of opposite faces: q̃_kα = ĝ_k·q_α, ĝ_k = g_k/|g_k|,
//! g_k = ∂x/∂ξ_k at the centre, and the strains e_kα = q̃_kα / ℓ_k with the half lengths ℓ_k = |g_k| of the
//! start. The displacement u_k = q̃_kα h_α stretches the lines k by e_kα ∂h_α/∂ξ_k. Of what strains it has,
//! those are assumed that pure bending, torsion and warping have in a brick; shear that a bent one shows only
//! because its faces stay flat is left out:
//!
//! - k ≠ α ≤ 3, bending: e_kα and e_αk vary along the same third direction, in which there is no stress,
//!   plane stress in the other two, an energy ½ E/(1 − ν²) (e_kα² + e_αk² + 2ν e_kα e_αk) V/3. With e_αk = 0
//!   the plate bends to a cylinder, with e_αk = −ν e_kα the beam with free sides, both exactly.
//! - k = α, torsion: the shear strains ℓ_k⁻¹ q̃_mm + ℓ_m⁻¹ q̃_kk of each two directions k, m vary along the
//!   third one: ½ µ (…)² V/3.
//! - α = 4: e_k4 with no stress in the other directions: ½ E e_k4² V/9.
//!
//! All of it goes to finite values at ν = ½, so nothing locks. W = κ times the sum of these energies is a
//! potential of the present form with the ℓ, V, moduli and γ of the start: it is zero there, knows no
//! rotations (products of vectors only), forces are its gradient, with what turns the ĝ_k, so energy,
//! momentum and angular momentum are kept whatever becomes of the element. That is the stiffness of the
//! source on bricks; it has rates, and axes of its own that turn with the element. Of the source's two fields
//! this is the one for bending (ASQBI): that for isochoric strain (ADS) takes ½ for ν/(1 − ν), and an elastic
//! beam of one element is too stiff. While the point flows the bending stays elastic. A fluid has no such
//! stiffness.
//!
//! The stable step: a is the largest ω² of the mean gradient, and of W at q = 0 it is at most b = k λ (1 + Σ
//! c²)/m, with k the largest stiffness against q̃, γ_α·γ_β = 8 (δ_αβ + Σ_k c_αk c_βk), and λ the largest
//! eigenvalue of ĝ_k·ĝ_l. For two positive matrices whose ranges have at most the cosine c, ω² ≤ ½ (a + b +
//! √((a − b)² + 4abc²)). The γ are at the angle θ₁ from the patterns, tan²θ₁ ≤ Σ c², the mean gradients
//! B_i = ∂V/∂x_i, of linear and bilinear parts, at θ₂ from the linear ones, and cos ≤ tan θ₁ + tan θ₂. Where
//! q is not zero the gradients of q̃ have |q|/|g| at most more, and q̃ has curvatures: with r = |q| max
//! 1/|g|, |dq̃| ≤ (√(λ (1 + Σ c²)) + r)|dx|/√8 and, together, at most (k/m) ((√(λ (1 + Σ c²)) + 2r)² − λ (1 +
//! Σ c²)) is added.
//!
//! Source: Belytschko and Bindeman, Comput. Meth. Appl. Mech. Engng 105 (1993) 225-260 (ASQBI).

use super::hex8_reduced::{all_parts, amplitude, columns, extent, held, mean, shares};
use super::{Corners, Held};
use crate::tensor::{Matrix, cross, dot};
use embate_lanes::{Batch, Lane};

/// What the potential keeps of the start: c_αk, √(κµV/3)/8ℓ_k, the moduli of bending, of its cross effect and
/// of warping over µ, and the largest stiffness against 8 q̃.
pub(super) const POTENTIAL: usize = 19;

/// The potential of an element.
struct Potential<L> {
    shares: [[L; 3]; 4],
    /// Strain per 8 q̃, as a root of an energy.
    scales: [L; 3],
    bending: L,
    crossing: L,
    warping: L,
    stiffest: L,
}

impl<L: Lane> Potential<L> {
    /// Of the form at the start.
    #[inline(always)]
    fn new(coefficient: f64, corners: &Corners<L, 3, 8>) -> Self {
        let (one, two, three, four) = (L::splat(1.0), L::splat(2.0), L::splat(3.0), L::splat(4.0));
        let x = all_parts(&corners.x);
        let lines = columns(&[x[0].linear, x[1].linear, x[2].linear]);
        // n = µ/M: E/(1 − ν²) = 4µ (1 − n), its product with ν 2µ (1 − 2n), E = µ (3 − 4n)/(1 − n).
        let n = corners.shear / corners.modulus;
        let (bending, crossing) = (four * (one - n), two * (one - two * n));
        let size = L::splat(coefficient / 3.0) * corners.shear * corners.volume;
        let mut scales = [one; 3];
        let mut largest = L::splat(0.0);
        for k in 0..3 {
            let squared = size / dot(lines[k], lines[k]);
            largest = largest.max(squared);
            scales[k] = squared.sqrt();
        }
        // Rows of the stiffness: bending, and torsion with (s_k² + s_m²) + s_j s_k + s_j s_m.
        let stiffest = largest * (bending + crossing.abs()).max(four);
        Self { shares: shares(&x), scales, bending, crossing, warping: (three - four * n) / (three * (one - n)), stiffest }
    }

    #[inline(always)]
    fn store(&self, kept: &mut [Batch], at: usize) {
        for value in 0..12 {
            self.shares[value / 3][value % 3].store(&mut kept[value], at);
        }
        for k in 0..3 {
            self.scales[k].store(&mut kept[12 + k], at);
        }
        self.bending.store(&mut kept[15], at);
        self.crossing.store(&mut kept[16], at);
        self.warping.store(&mut kept[17], at);
        self.stiffest.store(&mut kept[18], at);
    }

    #[inline(always)]
    fn load(kept: &[Batch], at: usize) -> Self {
        let [zero, bending, crossing] = [L::splat(0.0), L::load(&kept[15], at), L::load(&kept[16], at)];
        let (warping, stiffest) = (L::load(&kept[17], at), L::load(&kept[18], at));
        let mut out = Self { shares: [[zero; 3]; 4], scales: [zero; 3], bending, crossing, warping, stiffest };
        for value in 0..12 {
            out.shares[value / 3][value % 3] = L::load(&kept[value], at);
        }
        for k in 0..3 {
            out.scales[k] = L::load(&kept[12 + k], at);
        }
        out
    }

    /// ∂W/∂(8 q̃_kα) of the components 8 q̃_kα.
    #[inline(always)]
    fn slope(&self, along: &[[L; 4]; 3]) -> [[L; 4]; 3] {
        let Self { scales: [x, y, z], bending, crossing, warping, .. } = *self;
        let mut strain = *along;
        for k in 0..3 {
            for pattern in 0..4 {
                strain[k][pattern] = along[k][pattern] * self.scales[k];
            }
        }
        let mut out = strain;
        for k in 0..3 {
            for pattern in 0..3 {
                // Those of torsion come below.
                out[k][pattern] = self.scales[k] * (bending * strain[k][pattern] + crossing * strain[pattern][k]);
            }
            out[k][3] = self.scales[k] * (warping * strain[k][3]);
        }
        let (first, second, third) = (along[0][0], along[1][1], along[2][2]);
        let [xy, yz, zx] = [y * first + x * second, z * second + y * third, x * third + z * first];
        out[0][0] = y * xy + z * zx;
        out[1][1] = z * yz + x * xy;
        out[2][2] = x * zx + y * yz;
        out
    }
}

/// tan²θ₂ at most: what the mean gradients have of the bilinear patterns, over what they have of the linear
/// ones.
#[inline(always)]
fn warped<L: Lane>(jacobian: &Matrix<L, 3>, warp: &Matrix<L, 3>) -> L {
    let ([[a, b, c], bilinear], _) = mean(jacobian, warp);
    let (inverse, mut sum) = ([cross(b, c), cross(c, a), cross(a, b)], L::splat(-0.0));
    for column in inverse {
        for row in bilinear {
            let entry = dot(row, column);
            sum += entry * entry;
        }
    }
    let determinant = dot(a, inverse[0]);
    sum / (determinant * determinant)
}

/// The potential of the assumed strain, and its forces.
#[inline(always)]
pub(super) fn bend<L: Lane>(coefficient: f64, corners: &Corners<L, 3, 8>, kept: &mut [Batch], at: usize) -> Held<L, 3, 8> {
    let (half, one, two, four) = (L::splat(0.5), L::splat(1.0), L::splat(2.0), L::splat(4.0));
    if corners.is_start {
        Potential::new(coefficient, corners).store(kept, at);
    }
    let potential = Potential::<L>::load(kept, at);
    let x = all_parts(&corners.x);
    let (jacobian, warp) = ([x[0].linear, x[1].linear, x[2].linear], [x[0].bilinear, x[1].bilinear, x[2].bilinear]);
    let mut amplitudes = [[one; 3]; 4];
    let mut squares = L::splat(-0.0);
    for pattern in 0..4 {
        amplitudes[pattern] = amplitude(&x, &potential.shares[pattern], pattern);
        squares += dot(amplitudes[pattern], amplitudes[pattern]);
    }
    let mut axes = columns(&jacobian);
    let mut over = [one; 3];
    let mut along = [[one; 4]; 3];
    let mut shortest = L::splat(0.0);
    for k in 0..3 {
        over[k] = one / dot(axes[k], axes[k]).sqrt();
        shortest = shortest.max(over[k]);
        for i in 0..3 {
            axes[k][i] = axes[k][i] * over[k];
        }
        for pattern in 0..4 {
            along[k][pattern] = dot(axes[k], amplitudes[pattern]);
        }
    }
    let slope = potential.slope(&along);
    let mut pulls = [[one; 3]; 4];
    for pattern in 0..4 {
        for i in 0..3 {
            pulls[pattern][i] = slope[0][pattern] * axes[0][i] + slope[1][pattern] * axes[1][i] + slope[2][pattern] * axes[2][i];
        }
    }
    // What turns the axes: ∂W/∂g_k.
    let mut turning = [[one; 3]; 3];
    let mut work = L::splat(-0.0);
    for k in 0..3 {
        let own = slope[k][0] * along[k][0] + slope[k][1] * along[k][1] + (slope[k][2] * along[k][2] + slope[k][3] * along[k][3]);
        work += own;
        for i in 0..3 {
            let low = slope[k][0] * amplitudes[0][i] + slope[k][1] * amplitudes[1][i];
            let high = slope[k][2] * amplitudes[2][i] + slope[k][3] * amplitudes[3][i];
            turning[i][k] = (low + high - own * axes[k][i]) * over[k];
        }
    }
    // b/a at q = 0, and what q adds.
    let [numerator, denominator] = corners.characteristic_length_squared;
    let unit = potential.stiffest * L::splat(16.0) * numerator / (denominator * corners.volume * corners.modulus);
    let (xy, yz, zx) = (dot(axes[0], axes[1]).abs(), dot(axes[1], axes[2]).abs(), dot(axes[2], axes[0]).abs());
    let skew = (xy + zx).max(xy + yz).max(yz + zx);
    let extent = extent(&potential.shares);
    let size = (one + skew) * extent;
    let own = unit * size;
    let cosine = (two * (extent - one + warped(&jacobian, &warp))).min(one);
    let difference = one - own;
    let together = half * (one + own + (difference * difference + four * own * cosine).sqrt());
    let bent = squares * shortest * shortest;
    let more = four * unit * ((size * bent).sqrt() + bent);
    let mut out = held(&pulls, &potential.shares, half * work, together + more);
    for i in 0..3 {
        for k in 0..3 {
            out.flux[i][k] += turning[i][k];
        }
    }
    out
}
