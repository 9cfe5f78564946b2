//! What hyperelastic laws share: the energy of volume, and the invariants of unimodular tensors free of
//! cancellation near rest.
//!
//! Every rubber splits its energy into one of the volume, U(J) = ¼K (J² − 1 − 2 ln J), and one of
//! b̄ = J^{-2/3} b, det b̄ = 1.
//!
//! Both are squares of small numbers near rest, but differences of numbers near one as they stand: a stiff
//! body's round-off would outweigh the whole energy of a slow start. With c = tr a / 3 and s = dev a, det
//! a = 1 reads c³ − ½(s:s) c + det s = 1, so c − 1 = (½(s:s) c − det s) / (c² + c + 1).
//!
//! A pressure drops out of the acoustic tensor: for rank-one L = a⊗n, (tr L)² = L:Lᵀ. U adds J U'' (a·n)² to
//! ρc², no more.

use super::Response;
use crate::tensor::SymmetricTensor;
use embate_lanes::{Lane, math};

/// Answer of the volume.
pub(super) struct Volume<L> {
    /// Mean stress U' = ½K (J − 1/J), Pa.
    pub(super) pressure: L,
    /// U per initial volume, J/m³.
    pub(super) stored: L,
    /// J U'' = ½K (J + 1/J), Pa.
    pub(super) stiffness: L,
}

impl<L: Lane> Volume<L> {
    /// At the volume ratio `j` with its `inverse`, bulk modulus K.
    #[inline(always)]
    pub(super) fn new(bulk: f64, j: L, inverse: L) -> Self {
        Self::with_logarithm(bulk, j, inverse, math::ln(j))
    }

    /// The same with ln J.
    #[inline(always)]
    pub(super) fn with_logarithm(bulk: f64, j: L, inverse: L, logarithm: L) -> Self {
        let (half, one) = (L::splat(0.5), L::splat(1.0));
        let modulus = L::splat(0.5 * bulk);
        Self {
            pressure: modulus * (j - inverse),
            stored: modulus * (half * (j - one) * (j + one) - logarithm),
            stiffness: modulus * (j + inverse),
        }
    }
}

/// J^{-2/3}, from J and 1/J.
#[inline(always)]
pub(super) fn isochoric<L: Lane>(j: L, inverse: L) -> L {
    math::cbrt(j) * inverse
}

/// A positive tensor of determinant one, taken apart.
#[derive(Clone, Copy)]
pub(super) struct Unimodular<L, T> {
    /// s = dev a.
    pub(super) deviator: T,
    /// c = tr a / 3.
    pub(super) mean: L,
    /// c − 1, with all its digits.
    pub(super) above: L,
    /// √(2/3) |s|: no eigenvalue is further from the mean.
    pub(super) spread: L,
}

impl<L: Lane, T: SymmetricTensor<L>> Unimodular<L, T> {
    /// Of `factor` a.
    #[inline(always)]
    pub(super) fn new(a: T, factor: L) -> Self {
        let (half, one) = (L::splat(0.5), L::splat(1.0));
        let deviator = a.deviator().times(factor);
        let mean = a.trace() * factor * L::splat(1.0 / 3.0);
        let square = deviator.contract(deviator);
        let above = (half * square * mean - deviator.determinant()) / (mean * mean + mean + one);
        Self { deviator, mean, above, spread: (square * L::splat(2.0 / 3.0)).sqrt() }
    }
}

/// Isochoric energy w as a function of the first invariant Ī₁ alone, with its slope w' and curvature w''.
///
/// σ = 2 w' dev b̄ / J. Along L = a⊗n the neo-Hookean part with µ = 2 w' needs J ρc² ≤ 4/3 µ b̄_max (see
/// `mooney_rivlin`); the curvature adds 4 w'' (dev b̄)_an², at most 4 w'' (2/3) |dev b̄|² where w'' > 0.
pub(super) struct FirstInvariant<L> {
    /// w, J/m³.
    pub(super) stored: L,
    /// w', Pa.
    pub(super) slope: L,
    /// w'', Pa.
    pub(super) curvature: L,
}

impl<L: Lane> FirstInvariant<L> {
    /// The law's answer with `b` = b̄ and the `inverse` of J.
    #[inline(always)]
    pub(super) fn response<T: SymmetricTensor<L>>(&self, b: &Unimodular<L, T>, volume: &Volume<L>, inverse: L) -> Response<L, T> {
        let shear = self.slope + self.slope;
        let curved = L::splat(3.0) * self.curvature.max(L::splat(0.0)) * (b.spread * b.spread); // ¾ 4 w''
        Response {
            stress: b.deviator.times(shear * inverse).plus_isotropic(volume.pressure),
            stored: self.stored + volume.stored,
            dissipated: L::splat(0.0),
            bulk: volume.stiffness,
            shear: (shear * (b.mean + b.spread) + curved) * inverse,
        }
    }
}
