//! The stiffest motion of an element in 3D: a bound of its largest frequency, from the Jacobians at its
//! points.
//!
//! Let ∂N_p be the gradients of the shape functions at a point in natural coordinates so chosen that Σ_p w_p
//! |∂φ|² ≤ |φ|² for the values φ of any function at the nodes (they are for hexahedra with ξ = ±1 and for
//! tetrahedra, wedges need other scales), and S_p = det_p J_p⁻¹ J_p⁻ᵀ. Of an isotropic elastic body with
//! λ = K − 2µ/3, ε:C:ε ≤ max(λ, 0) tr(F)² + 2µ |F|² with the displacement gradient F. The second part is Σ_p
//! w_p ∂u S_p ∂uᵀ ≤ Λ |u|², Λ = max_p λ_max(S_p). The first, with tr F of the point or, with mean dilatation
//! (for which the deviator only takes away: Σ det_p w_p tr² ≥ V θ̄²), of the element, is at most T |u|²,
//! T = max_p tr S_p, by Cauchy and Schwarz: det_p tr(F_p)² = (adj_p : ∂u_p)²/det_p ≤ tr S_p |∂u_p|². So with
//! corners of mass m/N
//!
//! ```text
//! ω² ≤ (N/m) (max(λ, 0) T + 2µ Λ),     h² = 4 V / (N (max(1 − s, 0) T + s Λ)),  s = 2µ/(K + 4µ/3),
//! ```
//!
//! which is the exact frequency of a cube of any Poisson ratio and of a thin plate. Where only the speed of
//! the waves is known, of whatever body, s = 0 counts all as if it were λ: on parallelepipeds a bound too,
//! since the sum of the blocks of three orthogonal linear shapes is one, and the other shapes are softer.
//!
//! λ_max(S) ≤ ⅓ (t + √(2 (3q − t²))) with t = tr S, q = S:S, which is exact where two eigenvalues are equal
//! and the third is larger. S_p has the eigenvalues of Σ_k r_k r_kᵀ / det_p with the rows r_k of the
//! adjugate. Sources: Gershgorin's and Loewner's bounds; Flanagan and Belytschko, J. Appl. Mech. 51 (1984)
//! 35-40, for the mean gradient.

use embate_lanes::Lane;

/// Sum of products r rᵀ of vectors, as xx yy zz xy yz zx.
#[derive(Clone, Copy, Debug)]
pub(super) struct Metric<L>([L; 6]);

impl<L: Lane> Metric<L> {
    /// r rᵀ.
    #[inline(always)]
    pub(super) fn of(r: [L; 3]) -> Self {
        Self([r[0] * r[0], r[1] * r[1], r[2] * r[2], r[0] * r[1], r[1] * r[2], r[2] * r[0]])
    }

    /// With another r rᵀ.
    #[inline(always)]
    pub(super) fn and(mut self, r: [L; 3]) -> Self {
        let own = Self::of(r);
        for c in 0..6 {
            self.0[c] += own.0[c];
        }
        self
    }

    /// Trace t, and 3q − t².
    #[inline(always)]
    pub(super) fn spectrum(self) -> [L; 2] {
        let [xx, yy, zz, xy, yz, zx] = self.0;
        let trace = xx + yy + zz;
        let shear = xy * xy + yz * yz + zx * zx;
        let squares = (xx * xx + yy * yy + zz * zz) + (shear + shear);
        [trace, (L::splat(3.0) * squares - trace * trace).max(L::splat(0.0))]
    }
}

/// Λ from the trace t and 3q − t².
#[inline(always)]
pub(super) fn largest<L: Lane>([trace, spread]: [L; 2]) -> L {
    (trace + (spread + spread).sqrt()) * L::splat(1.0 / 3.0)
}

/// Square of the thickness of an element, m², as numerator and denominator, so that the step costs one
/// division: dt = h / c is stable for waves of speed c² = M/ρ when every node has its share of the mass
/// ([`super::Element::MASS_RATIOS`]).
#[derive(Clone, Copy, Debug)]
pub struct Thickness<L> {
    pub(super) numerator: L,
    /// Denominator where only M is known of the stiffness, or where all of M resists dilatation alone.
    pub(super) unknown: L,
    /// Of a body with s = 2µ/M the denominator is max(1 − a s, 0) b + s c.
    pub(super) known: [L; 3],
}

impl<L: Lane> Thickness<L> {
    /// Of an element in 2D, where no more than M is asked for.
    #[inline(always)]
    #[must_use]
    pub fn of_waves(numerator: L, denominator: L) -> Self {
        Self { numerator, unknown: denominator, known: [L::splat(1.0), denominator, denominator] }
    }

    /// From the largest trace and spread of S at the points.
    #[inline(always)]
    pub(super) fn of_points(numerator: L, spectrum: [L; 2]) -> Self {
        Self { numerator, unknown: spectrum[0], known: [L::splat(1.0), spectrum[0], largest(spectrum)] }
    }

    /// Where only M is known of the stiffness.
    #[inline(always)]
    #[must_use]
    pub fn squared(&self) -> [L; 2] {
        [self.numerator, self.unknown]
    }

    /// Of an isotropic elastic stiffness with the part `shear`, s = 2µ/M in M = K + 4µ/3.
    #[inline(always)]
    #[must_use]
    pub fn squared_with(&self, shear: L) -> [L; 2] {
        let [share, dilating, shearing] = self.known;
        let part = (L::splat(1.0) - share * shear).max(L::splat(0.0));
        [self.numerator, part * dilating + shear * shearing]
    }
}
