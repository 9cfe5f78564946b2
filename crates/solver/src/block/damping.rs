//! Damping in proportion to the stiffness (Rayleigh): a stress σ_d = β C:ε̇ besides that of the law, with the
//! elastic stiffness C of its current K and µ.
//!
//! It comes after the law has answered and before forces are made. ε̇ = Δε/Δt is that of the step which led
//! here, so it lags by half a step:
//!
//! ```text
//! σ_d = β/Δt ((K − 2µ/3) tr(Δε) I + 2µ Δε),   in plane stress with λ* = 2µλ/(λ + 2µ)
//!                                                in place of λ = K − 2µ/3, nothing across
//! work of the step ½ (σ_d,old + σ_d):Δε V,    stable step dt_d = √(β² + dt²) − β
//! ```
//!
//! A mode of frequency ω is damped by the part ξ = βω/2 of the critical. The step is that of the lagging
//! force: z² − (2 − dt²ω² − dt β ω²) z + 1 − dt β ω² = 0 reaches z = −1 at dt²ω² + 2 dt β ω² = 4. The sum of
//! the works is never negative but for the first and last half step, which the trapezoidal rule of the ledger
//! asks for.

use super::batch::{ElementBatch, Resistance};
use super::strain::Tensor;
use super::strip::{Parts, StripBuffers};
use crate::material::points::RESPONSE;
use crate::stress_state::StressState;
use crate::tensor::{Dim, Space, SymmetricTensor, Turn};
use embate_lanes::{Batch, Lane};

/// The stiffness k with which that of an element is at most k 1, N/m: 4 m / dt² of its stable step and the
/// mass m of its lightest corner; where it is damped 4 m / (dt `shortest`) with the shortest step of all, s.
pub(super) fn bounding_stiffness(mass: f64, time_step_squared: f64, shortest: f64, is_damped: bool) -> f64 {
    4.0 * mass / if is_damped { time_step_squared.sqrt() * shortest } else { time_step_squared }
}

/// Square of the stable step with damping from that without, s²: dt_d² of the head of the file.
#[inline(always)]
pub(super) fn step_squared<L: Lane>(time_step_squared: L, damping: f64) -> L {
    if damping > 0.0 {
        let beta = L::splat(damping);
        let step = (time_step_squared + beta * beta).sqrt() - beta;
        step * step
    } else {
        time_step_squared
    }
}

/// Points of a strip after their law has answered.
pub(super) struct Damp<'a, const D: usize> {
    /// Points of an element, and its stress state.
    pub(super) points: usize,
    pub(super) state: StressState,
    /// β, s.
    pub(super) damping: f64,
    pub(super) time_step: f64,
    pub(super) strip: &'a StripBuffers<D>,
    /// History of the points, batches per point in it, and the place of the thickness ratio.
    pub(super) history: &'a [Batch],
    pub(super) history_width: usize,
    pub(super) thickness: usize,
    /// σ_d of the points, Pa: of the last step, then of this one.
    pub(super) stress: &'a mut [Batch],
    pub(super) elements: &'a [ElementBatch],
    pub(super) resistance: &'a mut [Resistance],
}

impl<const D: usize> Parts for Damp<'_, D>
where
    Dim<D>: Space<D>,
{
    #[inline(always)]
    fn batches(&self) -> usize {
        self.elements.len()
    }

    #[inline(always)]
    fn part<L: Lane>(&mut self, batch: usize, at: usize) {
        let (zero, half) = (L::splat(0.0), L::splat(0.5));
        let components = <Tensor<D, L> as SymmetricTensor<L>>::COMPONENTS;
        let turn = <<Tensor<D, L> as SymmetricTensor<L>>::Rotation as Turn<L>>::COMPONENTS;
        let factor = L::splat(if self.time_step > 0.0 { self.damping / self.time_step } else { 0.0 });
        let is_plane_stress = self.state.of::<D>().is_plane_stress;
        let mut work = zero;
        for point in batch * self.points..(batch + 1) * self.points {
            let strain = Tensor::<D, L>::load(&self.strip.strain[point * components..(point + 1) * components], at);
            let rotation = <<Tensor<D, L> as SymmetricTensor<L>>::Rotation as Turn<L>>::load(
                &self.strip.rotation[point * turn..(point + 1) * turn],
                at,
            );
            let response = &self.strip.response[point * RESPONSE..(point + 1) * RESPONSE];
            let (bulk, shear) = (L::load(&response[2], at), L::load(&response[3], at));
            let twice = shear + shear;
            let lame = bulk - shear * L::splat(2.0 / 3.0);
            let lame = if is_plane_stress { twice * lame / (lame + twice) } else { lame };
            let mut new = strain.times(twice * factor).plus_isotropic(lame * factor * strain.trace());
            if is_plane_stress {
                new = new.plus_zz(-new.zz());
            }
            let kept = &mut self.stress[point * components..(point + 1) * components];
            let old = Tensor::<D, L>::load(kept, at).rotated(&rotation);
            new.store(kept, at);
            let mut volume = L::load(&self.strip.volume[point], at);
            if is_plane_stress {
                volume = volume * L::load(&self.history[point * self.history_width + self.thickness], at);
            }
            work += old.plus(new).contract(strain) * half * volume;
        }
        let damping = &mut self.resistance[batch].damping;
        (L::load(damping, at) + work * L::load(&self.elements[batch].live, at)).store(damping, at);
    }
}
