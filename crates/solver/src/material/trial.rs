//! What laws with a yield surface share: the elastic trial stress, the work of a plastic step for the ledger,
//! and Newton's method in lanes.
//!
//! The block takes ½ (σ_old + σ_new):Δε as the work of a step. With the strain split into Δε = C⁻¹:(σ_new −
//! σ_old) + Δε_p that is, to the last digit, the change of ½ σ:C⁻¹:σ plus ½ (σ_old + σ_new):Δε_p. So a law
//! that reports the latter as its plastic work leaves exactly the elastic energy in the ledger, whatever the
//! size of its steps; for steps in one direction it is the trapezoidal rule on the flow stress. Where |σ_old|
//! exceeds |σ_new| (heat, less rate, a flow stress that falls) and the direction turns in one step, it could
//! be negative; then zero is reported.

use super::Kinematics;
use crate::tensor::SymmetricTensor;
use embate_lanes::Lane;

/// Stress after an elastic step.
#[derive(Clone, Copy)]
pub(super) struct Trial<L: Lane, T: SymmetricTensor<L>> {
    /// Mean stress ⅓ tr σ, Pa.
    pub(super) mean: L,
    /// Deviator s, Pa.
    pub(super) deviator: T,
    /// q² = 3/2 s:s, Pa².
    pub(super) square: L,
}

impl<L: Lane, T: SymmetricTensor<L>> Trial<L, T> {
    /// From the old stress and Δε with the moduli K and µ.
    #[inline(always)]
    pub(super) fn new(bulk: f64, shear: f64, kinematics: &Kinematics<L, T>) -> Self {
        let twice = L::splat(shear) + L::splat(shear);
        let strain = kinematics.strain_increment;
        let sum = kinematics.stress_rotated.plus(strain.times(twice));
        let third = sum.trace() * L::splat(1.0 / 3.0);
        let mean = third + L::splat(bulk - 2.0 / 3.0 * shear) * strain.trace();
        let deviator = sum.plus_isotropic(-third);
        let square = deviator.contract(deviator) * L::splat(1.5);
        Self { mean, deviator, square }
    }

    /// The strain increment along the flow direction, ⅔ N:Δε with N = 3/2 s/q of the trial, from 1/q.
    #[inline(always)]
    pub(super) fn along(&self, strain: T, inverse: L) -> L {
        self.deviator.contract(strain) * inverse
    }

    /// The old stress along the flow direction, s_old:N.
    #[inline(always)]
    pub(super) fn old(&self, shear: f64, strain: T, q: L, inverse: L) -> L {
        q - L::splat(3.0 * shear) * self.along(strain, inverse)
    }

    /// ½ (s_old + s_new):Δε_p of a radial return by `step` from `q`, with 1/q; only where it `yields`.
    #[inline(always)]
    pub(super) fn work(&self, shear: f64, strain: T, [q, inverse]: [L; 2], step: L, yields: L::Mask) -> L {
        let new = q - L::splat(3.0 * shear) * step;
        let mean = (self.old(shear, strain, q, inverse) + new) * L::splat(0.5);
        L::select(yields, (mean * step).max(L::splat(0.0)), L::splat(0.0))
    }

    /// The stress with the deviator times `factor` where it `yields`.
    #[inline(always)]
    pub(super) fn scaled(&self, factor: L, yields: L::Mask) -> T {
        self.deviator.times(L::select(yields, factor, L::splat(1.0)))
    }
}

/// Largest residual over the trial stress.
const TOLERANCE: f64 = 1e-12;
/// Evaluations; one or two do where the function is smooth, and halving the bracket has no need of more than
/// these.
pub(super) const LIMIT: usize = 60;

/// Newton's method for a function that is positive left of its root and negative right of it, in a bracket
/// that halves where Newton leaves it. A flow stress that falls bends the function the other way, and
/// Newton's steps may pass the root; each that leaves the bracket, which shrinks with every step, halves it.
/// Each step δ takes the curvature with it (Chebyshev's method): with δ₁ = −f/f' and h = f'' δ₁/f' it is δ₁
/// (1 − h/2), and leaves ½ f'' δ₁² h and f''' δ³/6 of f. Where that is within the tolerance, it is the last:
/// the function is not evaluated again only to see it. Lanes that have converged stand still, so that no lane
/// depends on its neighbours. Source: Traub, Iterative Methods for the Solution of Equations (1964), 5.2.
#[derive(Clone, Copy)]
pub(super) struct Newton<L: Lane> {
    /// Where the function is wanted.
    pub(super) at: L,
    /// Where it moved in the last call.
    pub(super) moved: L,
    low: L,
    high: L,
    tolerance: L,
}

impl<L: Lane> Newton<L> {
    /// From zero to `high`, first at `start`, until the residual is 1e-12 of `size`; lanes that don't yield
    /// stay at zero.
    #[inline(always)]
    pub(super) fn new(start: L, high: L, size: L, yields: L::Mask) -> Self {
        let zero = L::splat(0.0);
        let tolerance = L::select(yields, size * L::splat(TOLERANCE), L::splat(f64::INFINITY));
        // Where nothing is left of a flow stress, the root is the upper end: not to be missed by round-off.
        let high = high * L::splat(1.0 + 4.0 * f64::EPSILON);
        Self { at: L::select(yields, start.max(zero).min(high), zero), moved: zero, low: zero, high, tolerance }
    }

    /// Lanes that have not converged.
    #[inline(always)]
    pub(super) fn live(&self) -> L::Mask {
        self.tolerance.less(L::splat(f64::INFINITY))
    }

    /// Moves on from the value and the slope at [`Newton::at`]; false when every lane has converged.
    #[inline(always)]
    pub(super) fn next(&mut self, value: L, slope: L) -> bool {
        let open = self.tolerance.less(value.abs());
        if !L::any(open) {
            return false;
        }
        let left = L::splat(0.0).less(value);
        self.low = L::select(left, self.at, self.low);
        self.high = L::select(left, self.high, self.at);
        let newton = self.at - value / slope;
        let middle = (self.low + self.high) * L::splat(0.5);
        let next = L::select(self.low.less(newton), newton, middle);
        let next = L::select(self.high.less(next), middle, next);
        self.at = L::select(open, next, self.at);
        true
    }

    /// Moves on with the curvature as well, whose curvature changes by no more than its part of `reach`
    /// within that (see [`super::hardening::Flow`]); with a reach of 0 the value there decides. False when
    /// every lane has converged.
    #[inline(always)]
    pub(super) fn next_curved(&mut self, value: L, slope: L, curvature: L, reach: L) -> bool {
        let (zero, half, one, three) = (L::splat(0.0), L::splat(0.5), L::splat(1.0), L::splat(3.0));
        let infinity = L::splat(f64::INFINITY);
        let open = self.tolerance.less(value.abs());
        let left = zero.less(value);
        self.low = L::select(left, self.at, self.low);
        self.high = L::select(left, self.high, self.at);
        let inverse = one / slope;
        let first = -(value * inverse);
        let bend = curvature * first * inverse;
        let remaining = curvature.abs() * (first * first) * (first.abs() + three * bend.abs() * reach);
        let remaining = L::select((first + first).abs().less(reach), remaining, infinity);
        let last = remaining.less(self.tolerance * reach * L::splat(6.0));
        let newton = self.at + first * (one - half * bend.max(-one).min(one));
        let middle = (self.low + self.high) * half;
        let next = L::select(self.low.less(newton), newton, middle);
        let next = L::select(self.high.less(next), middle, next);
        let next = L::select(last, newton.max(self.low).min(self.high), next);
        let next = L::select(open, next, self.at);
        self.moved = next - self.at;
        self.at = next;
        self.tolerance = L::select(open, L::select(last, infinity, self.tolerance), infinity);
        L::any(self.live())
    }
}
