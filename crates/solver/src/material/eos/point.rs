//! A rate law whose mean stress is replaced by the pressure of an equation of state, at many points.
//!
//! The law answers first; of its stress the deviator stays. Then, with the volume ratio v and the heat of the
//! step (what the law dissipated, and the work of the bulk viscosity in the step before), per initial volume:
//!
//! ```text
//! E_new = E_old + heat − ½ (p_old + p_new) Δv,   p_new = cold + heat_term E_new
//! p_new = (cold + heat_term (E_old + heat − ½ p_old Δv)) / (1 + ½ heat_term Δv)
//! ```
//!
//! Where p_new lies below −p_t, the limit in tension, it is −p_t, and E_new follows by the first line: what
//! the matter takes up at the limit it gives back on the same way.
//!
//! Elastic energy of the deviator is no heat. The block enters the work of the whole stress as stored, less
//! what was dissipated, and begins with E of the start, so the ledger close by construction; E itself is
//! stored plus dissipated plus viscous energy, less the deviator's elastic part.

use super::{Equation, Terms};
use crate::material::points::{PointLaw, Points, RESPONSE};
use crate::material::variable::DENSITY;
use crate::material::{Family, History};
use crate::tensor::{Dim, Solid, Space, SymmetricTensor};
use embate_lanes::{BATCH, Batch, Kernel, Lane, Level};
use std::marker::PhantomData;

type Tensor<const D: usize, L> = <Dim<D> as Space<D>>::Tensor<L>;

/// Batches of history per point, after the law's own: density, energy per initial volume, pressure.
const OWN: usize = 3;
/// Which of them are output, by their place among these.
pub(crate) const VARIABLES: &[History] = &[DENSITY.at(0)];
/// Least bulk stiffness over that at rest: the stable step of a spent gas stays finite.
const SOFTEST: f64 = 1e-9;

/// A law with an equation of state.
pub(super) struct WithEquation<Q, const D: usize> {
    law: Box<dyn PointLaw>,
    equation: Q,
    density: f64,
    /// Least pressure, Pa.
    least: f64,
    /// At rest.
    bulk: f64,
    variables: Vec<History>,
    dimension: PhantomData<Dim<D>>,
}

impl<Q: Equation, const D: usize> WithEquation<Q, D> {
    pub(super) fn new(law: Box<dyn PointLaw>, equation: Q, density: f64, tension: f64) -> Self {
        let mut variables = law.variables().to_vec();
        variables.extend(VARIABLES.iter().map(|own| own.variable.at(law.state_width() + own.place)));
        let bulk = equation.terms(1.0).bulk(1.0, equation.energy());
        Self { law, equation, density, least: -tension, bulk, variables, dimension: PhantomData }
    }
}

impl<Q: Equation, const D: usize> PointLaw for WithEquation<Q, D>
where
    Dim<D>: Space<D>,
{
    fn family(&self) -> Family {
        Family::Rate
    }
    fn state_width(&self) -> usize {
        self.law.state_width() + OWN
    }
    fn needs_rotation(&self) -> bool {
        self.law.needs_rotation()
    }
    fn needs_volume(&self) -> bool {
        true
    }
    fn variables(&self) -> &[History] {
        &self.variables
    }
    fn stiffness(&self) -> [f64; 2] {
        [self.bulk, self.law.stiffness()[1]]
    }
    fn is_elastic(&self) -> bool {
        self.law.is_elastic()
    }
    fn least_sheet_modulus(&self) -> f64 {
        // The pressure stands beside whatever an anisotropic law has for it.
        if self.law.is_elastic() { self.law.least_sheet_modulus() } else { f64::INFINITY }
    }
    fn stored(&self) -> f64 {
        self.equation.energy()
    }
    /// Of the deviator: the pressure is that of the equation, whose energy is [`PointLaw::stored`].
    fn energy(&self, stress: [f64; 6]) -> f64 {
        self.law.energy(Solid(stress).deviator().0)
    }
    fn start(&self, state: &mut [Batch]) {
        let (inner, own) = state.split_at_mut(self.law.state_width());
        self.law.start(inner);
        let (energy, terms) = (self.equation.energy(), self.equation.terms(1.0));
        own.copy_from_slice(&[self.density, energy, terms.pressure(energy)].map(Batch::splat));
    }

    fn respond(&self, level: Level, points: Points<'_>) {
        let Points { time_step, strain, rotation, volume_ratio, viscous_heat, stress, state, response, scratch } = points;
        let (inner, count) = (self.law.state_width(), strain.len() / <Tensor<D, f64> as SymmetricTensor<f64>>::COMPONENTS);
        let width = inner + OWN;
        // The law's history lies between that of the equation: it gets a copy in one piece.
        let (scratch, nested) = scratch.split(count * inner);
        for p in 0..count {
            scratch[p * inner..(p + 1) * inner].copy_from_slice(&state[p * width..p * width + inner]);
        }
        self.law.respond(
            level,
            Points { time_step, strain, rotation, volume_ratio, viscous_heat, stress, state: scratch, response, scratch: nested },
        );
        for p in 0..count {
            state[p * width..p * width + inner].copy_from_slice(&scratch[p * inner..(p + 1) * inner]);
        }
        level.run(Replace { owner: self, strain, volume_ratio, viscous_heat, stress, state, response });
    }
}

/// Replaces the mean stresses.
struct Replace<'a, Q, const D: usize> {
    owner: &'a WithEquation<Q, D>,
    strain: &'a [Batch],
    volume_ratio: &'a [Batch],
    viscous_heat: &'a [Batch],
    stress: &'a mut [Batch],
    state: &'a mut [Batch],
    response: &'a mut [Batch],
}

impl<Q: Equation, const D: usize> Kernel for Replace<'_, Q, D>
where
    Dim<D>: Space<D>,
{
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        let (one, half, third) = (L::splat(1.0), L::splat(0.5), L::splat(1.0 / 3.0));
        let density = L::splat(self.owner.density);
        let least = L::splat(self.owner.least);
        let softest = L::splat(SOFTEST * self.owner.bulk);
        let width = self.owner.law.state_width() + OWN;
        let components = <Tensor<D, L> as SymmetricTensor<L>>::COMPONENTS;
        for p in 0..self.strain.len() / components {
            let strain = &self.strain[p * components..(p + 1) * components];
            let stress = &mut self.stress[p * components..(p + 1) * components];
            let own = &mut self.state[(p + 1) * width - OWN..(p + 1) * width];
            let out = &mut self.response[p * RESPONSE..(p + 1) * RESPONSE];
            for at in (0..BATCH).step_by(L::WIDTH) {
                let ratio = L::load(&self.volume_ratio[p], at);
                let ratio_old = density / L::load(&own[0], at);
                let change = ratio - ratio_old;
                let heat = L::load(&out[1], at) * ((ratio + ratio_old) * half) + L::load(&self.viscous_heat[p], at);
                let known = L::load(&own[1], at) + heat - half * L::load(&own[2], at) * change;
                let terms: Terms<L> = self.owner.equation.terms(ratio);
                let pressure = terms.pressure(known) / (one + half * terms.heat * change);
                let pressure = L::select(pressure.less(least), least, pressure);
                let energy = known - half * pressure * change;
                (density / ratio).store(&mut own[0], at);
                energy.store(&mut own[1], at);
                pressure.store(&mut own[2], at);

                let found = <Tensor<D, L> as SymmetricTensor<L>>::load(stress, at);
                let shift = -(pressure + found.trace() * third);
                found.plus_isotropic(shift).store(stress, at);
                let dilatation = <Tensor<D, L> as SymmetricTensor<L>>::load(strain, at).trace();
                // (σ_old + σ_new):Δε with the new stress shifted.
                (L::load(&out[0], at) + shift * dilatation).store(&mut out[0], at);
                terms.bulk(ratio, energy).max(softest).store(&mut out[2], at);
            }
        }
    }
}
