//! J2 (von Mises) plasticity with isotropic hardening of any kind, rate form, radial return.
//!
//! Trial stress as in `elastic`; q = √(3/2 s:s). Where q > σ_y(ε_p), the flow stress at the end of the step
//! is met (backward Euler): q_trial − 3µ Δε_p = σ_y(ε_p + Δε_p) R(Δε_p / Δt), s ← s (1 − 3µ Δε_p / q_trial),
//! with R = 1 or after Cowper and Symonds (see `hardening/rate.rs`). Linear hardening has a closed form,
//! Δε_p = (q_trial − σ_y) / (3µ + H), and dissipates ∫ σ_y dε_p = (σ_y(ε_p) + ½ H Δε_p) Δε_p; the others are
//! solved to 1e-12 of q_trial and dissipate as `trial.rs` says. Where the flow stress falls, 3µ + dσ_y/dε_p
//! stays positive (`softening.rs`), so there is one solution without rate; falling linear hardening goes the
//! way of the others. Source: Wilkins, Methods in Computational Physics 3 (1964); Simo and Hughes,
//! Computational Inelasticity (1998), box 3.2.

use super::hardening::{Flow, Hardening, Linear, Ludwik, Rate, StoredFlow, Swift, Table, Voce};
use super::trial::{LIMIT, Newton, Trial};
use super::{
    Family, Fibre, History, Kinematics, Law, LawKind, Layer, ParameterFault, Parameters, Response, Softening, YOUNG, bulk_and_shear,
    variable, young_and_poisson,
};
use crate::quantity::Dimension;
use crate::tensor::SymmetricTensor;
use embate_lanes::Lane;

/// Linear hardening.
pub type J2 = J2With<Linear>;
/// Saturating hardening.
pub type J2Voce = J2With<Voce>;
/// Power law of the strain with an offset.
pub type J2Swift = J2With<Swift>;
/// Power law of the plastic strain.
pub type J2Ludwik = J2With<Ludwik>;
/// A measured curve.
pub type J2Table = J2With<Table>;

/// The law with its moduli and its flow stress.
#[derive(Clone, Copy, Debug)]
pub struct J2With<H: Hardening> {
    bulk: f64,
    shear: f64,
    hardening: H,
    rate: Option<Rate>,
}

impl<H: Hardening> Law for J2With<H> {
    const KIND: LawKind = H::KIND;
    const FAMILY: Family = Family::Rate;
    /// Equivalent plastic strain; flow stress and slope there.
    type State<L: Lane, T: SymmetricTensor<L>> = ([L; 1], H::StoredFlow<L>);
    const VARIABLES: &'static [History] = &[variable::PLASTIC_STRAIN.at(0)];
    const CAN_BE_AVERAGED: bool = true;

    fn new(parameters: &Parameters<'_>) -> Self {
        let [bulk, shear] = bulk_and_shear(parameters);
        Self { bulk, shear, hardening: H::new(parameters, shear), rate: Rate::new(parameters) }
    }

    fn faults(parameters: &Parameters<'_>) -> Vec<ParameterFault> {
        let mut faults = H::faults(parameters);
        if faults.is_empty() {
            faults.extend(Softening::faults(Self::softening(parameters)));
        }
        faults.extend(Rate::faults(parameters));
        faults
    }

    fn table_end(parameters: &Parameters<'_>) -> Option<f64> {
        H::end(parameters)
    }

    fn first_flow(parameters: &Parameters<'_>) -> Option<(&'static str, f64)> {
        let [_, shear] = bulk_and_shear(parameters);
        let own = H::KIND.parameters.iter().find(|own| own.dimension == Dimension::PRESSURE && own.name != YOUNG.name)?;
        Some((own.name, H::new(parameters, shear).flow(0.0).stress))
    }

    fn softening(parameters: &Parameters<'_>) -> Option<Softening> {
        let (name, slope, gone_at) = H::falling(parameters)?;
        Some(Softening::von_mises(name, slope, gone_at, bulk_and_shear(parameters)))
    }

    fn start<L: Lane, T: SymmetricTensor<L>>(&self) -> Self::State<L, T> {
        let plastic = L::splat(0.0);
        let Flow { stress, slope, .. } = self.hardening.flow(plastic);
        ([plastic], H::StoredFlow::new([stress, slope]))
    }

    fn renew<L: Lane, T: SymmetricTensor<L>>(&self, state: &mut Self::State<L, T>) {
        let Flow { stress, slope, .. } = self.hardening.flow(state.0[0]);
        state.1 = H::StoredFlow::new([stress, slope]);
    }

    #[inline(always)]
    fn update<L: Lane, T: SymmetricTensor<L>>(&self, kinematics: &Kinematics<L, T>, state: &mut Self::State<L, T>) -> Response<L, T> {
        let zero = L::splat(0.0);
        let trial = Trial::new(self.bulk, self.shear, kinematics);
        let ([plastic], kept) = *state;
        let [flow, slope] = kept.flow(&self.hardening, plastic);
        let yields = (flow * flow).less(trial.square);
        let (mut deviator, mut dissipated) = (trial.deviator, zero);
        if L::any(yields) {
            let q = trial.square.sqrt();
            let stiffness = L::splat(3.0 * self.shear);
            let (step, flow_new, lost) = if let (None, Some(modulus)) = (self.rate, self.hardening.modulus()) {
                let step = L::select(yields, (q - flow) * L::splat(1.0 / (3.0 * self.shear + modulus)), zero);
                dissipated = (flow + L::splat(0.5 * modulus) * step) * step;
                (step, [flow, slope], stiffness * step / q)
            } else {
                let (step, flow_new) = match self.rate {
                    None => self.step_static(q, plastic, [flow, slope], yields),
                    Some(rate) => self.step_with_rate(&rate, kinematics.time_step, q, plastic, [flow, slope], yields),
                };
                let inverse = L::splat(1.0) / q;
                dissipated = trial.work(self.shear, kinematics.strain_increment, [q, inverse], step, yields);
                (step, flow_new, stiffness * step * inverse)
            };
            deviator = trial.scaled(L::splat(1.0) - lost, yields);
            *state = ([plastic + step], H::StoredFlow::new(flow_new));
        }
        Response::rate(deviator.plus_isotropic(trial.mean), dissipated, [self.bulk, self.shear])
    }

    fn has_layer(&self) -> bool {
        self.rate.is_none()
    }

    /// With Δε_p = Δγ s (s the new deviator) and σ₃₃ = 0: σ₁₁ + σ₂₂ is that of the elastic trial over 1 + E
    /// Δγ/(3 (1 − ν)), σ₁₁ − σ₂₂ and the shear stresses over 1 + 2µ Δγ; the equivalent plastic strain grows
    /// by ⅔ Δγ q. Newton's method for the Δγ of q(Δγ) = σ_y. Source: Simo and Taylor, Int. J. Numer. Meth.
    /// Engng 22 (1986) 649-670.
    #[inline(always)]
    fn layer<L: Lane, T: SymmetricTensor<L>>(&self, strain: [L; 6], old: [L; 6], state: &mut Self::State<L, T>) -> Layer<L> {
        let (zero, half, one) = (L::splat(0.0), L::splat(0.5), L::splat(1.0));
        let [young, poisson] = young_and_poisson([self.bulk, self.shear]);
        let twice = L::splat(2.0 * self.shear);
        let sum = old[0] + old[1] + L::splat(young / (1.0 - poisson)) * (strain[0] + strain[1]);
        let difference = old[0] - old[1] + twice * (strain[0] - strain[1]);
        let shear = [old[3] + twice * strain[3], old[4] + twice * strain[4], old[5] + twice * strain[5]];
        let ([plastic], kept) = *state;
        let [flow, slope] = kept.flow(&self.hardening, plastic);
        let a = L::splat(0.25) * sum * sum;
        let b =
            L::splat(0.75) * difference * difference + L::splat(3.0) * (shear[0] * shear[0] + shear[1] * shear[1] + shear[2] * shear[2]);
        let yields = (flow * flow).less(a + b);
        let (mut of_sum, mut of_rest, mut gamma, mut grown) = (one, one, zero, zero);
        if L::any(yields) {
            let of = [young / (3.0 * (1.0 - poisson)), 2.0 * self.shear];
            let (found, end) = self.yielded([a, b], of, plastic, [flow, slope], yields);
            [of_sum, of_rest, gamma, grown] = found;
            *state = ([plastic + grown], H::StoredFlow::new(end));
        }
        let (sum, difference) = (sum * of_sum, difference * of_rest);
        let stress =
            [half * (sum + difference), half * (sum - difference), zero, shear[0] * of_rest, shear[1] * of_rest, shear[2] * of_rest];
        let mut dissipated = zero;
        let third = sum * L::splat(1.0 / 3.0);
        if let Some(modulus) = self.hardening.modulus() {
            dissipated = (flow + L::splat(0.5 * modulus) * grown) * grown;
        } else if L::any(yields) {
            let mut work = (old[0] + stress[0]) * (stress[0] - third) + (old[1] + stress[1]) * (stress[1] - third);
            for k in 3..6 {
                let one = (old[k] + stress[k]) * stress[k];
                work += one + one;
            }
            dissipated = (half * gamma * work).max(zero);
        }
        let change = stress[0] + stress[1] - old[0] - old[1];
        let across = -(L::splat(poisson / young) * change) - gamma * third;
        Layer { stress, across, dissipated }
    }

    fn has_fibre(&self) -> bool {
        self.rate.is_none()
    }

    /// As [`Law::layer`] with σ₂₂ = σ₃₃ = 0: σ₁₁ is that of the elastic trial over 1 + ⅔ E Δγ. Without shear
    /// stress and with linear hardening Δε_p = (|σ₁₁| − σ_y)/(E + H).
    #[inline(always)]
    fn fibre<L: Lane, T: SymmetricTensor<L>>(&self, strain: [L; 2], old: [L; 2], state: &mut Self::State<L, T>) -> Fibre<L> {
        let (zero, half, one) = (L::splat(0.0), L::splat(0.5), L::splat(1.0));
        let [young, poisson] = young_and_poisson([self.bulk, self.shear]);
        let (along, beside) = (old[0] + L::splat(young) * strain[0], old[1] + L::splat(2.0 * self.shear) * strain[1]);
        let ([plastic], kept) = *state;
        let [flow, slope] = kept.flow(&self.hardening, plastic);
        let (a, b) = (along * along, L::splat(3.0) * beside * beside);
        let yields = (flow * flow).less(a + b);
        let (mut of_along, mut of_rest, mut grown) = (one, one, zero);
        if L::any(yields) {
            let sheared = zero.less(b);
            let modulus = self.hardening.modulus();
            let mut end = [flow, slope];
            if let Some(modulus) = modulus {
                let step = (along.abs() - flow) * L::splat(1.0 / (young + modulus));
                grown = L::select(yields, step, zero);
                end[0] = flow + L::splat(modulus) * grown;
                of_along = L::select(yields, one - L::splat(young) * step / along.abs(), one);
            }
            if modulus.is_none() || L::any(sheared) {
                let (found, newton_end) = self.yielded([a, b], [2.0 / 3.0 * young, 2.0 * self.shear], plastic, [flow, slope], yields);
                if modulus.is_none() {
                    [of_along, of_rest, _, grown] = found;
                    end = newton_end;
                } else {
                    of_along = L::select(sheared, found[0], of_along);
                    of_rest = L::select(sheared, found[1], one);
                    grown = L::select(sheared, found[3], grown);
                    end = [L::select(sheared, newton_end[0], end[0]), L::select(sheared, newton_end[1], end[1])];
                }
            }
            *state = ([plastic + grown], H::StoredFlow::new(end));
        }
        let stress = [along * of_along, beside * of_rest];
        // Of the new stress: Δε_p along it is ⅔ Δγ σ₁₁, and what goes across half of that.
        let plastic_strain = (along - stress[0]) * L::splat(1.0 / young);
        let mut dissipated = zero;
        if let Some(modulus) = self.hardening.modulus() {
            dissipated = (flow + L::splat(0.5 * modulus) * grown) * grown;
        } else if L::any(yields) {
            let shear = (beside - stress[1]) * L::splat(0.5 / self.shear);
            let work = (old[0] + stress[0]) * plastic_strain + L::splat(2.0) * (old[1] + stress[1]) * shear;
            dissipated = (half * work).max(zero);
        }
        let across = -(L::splat(poisson / young) * (stress[0] - old[0])) - half * plastic_strain;
        Fibre { stress, across, dissipated }
    }

    fn stiffness(&self) -> [f64; 2] {
        [self.bulk, self.shear]
    }
}

impl<H: Hardening> J2With<H> {
    /// Of a trial stress with q² = a + b, of which a becomes less by (1 + α Δγ)², b by (1 + β Δγ)²: 1/(1 + α
    /// Δγ), 1/(1 + β Δγ), Δγ and Δε_p = ⅔ Δγ q, and the flow stress and its slope there.
    #[inline(always)]
    fn yielded<L: Lane>(
        &self,
        [a, b]: [L; 2],
        [alpha, beta]: [f64; 2],
        plastic: L,
        [flow, slope]: [L; 2],
        yields: L::Mask,
    ) -> ([L; 4], [L; 2]) {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let (of_a, of_b) = (L::splat(alpha), L::splat(beta));
        let (both, third) = (a + b, L::splat(2.0 / 3.0));
        let size = both.sqrt();
        // The root if both became less alike along a straight flow curve.
        let start = (size - flow) * both / (flow * (of_a * a + of_b * b) + third * slope.max(zero) * size * both);
        let mut newton = Newton::new(start, L::splat(1e13 / alpha.min(beta)), size, yields);
        let (mut end, mut step, mut parts) = ([flow, slope], zero, [one; 2]);
        for _ in 0..LIMIT {
            let gamma = newton.at;
            let (more_a, more_b) = (one + of_a * gamma, one + of_b * gamma);
            let inverse = one / (more_a * more_b);
            let (p, r) = (more_b * inverse, more_a * inverse);
            parts = [p, r];
            let (part_a, part_b) = (a * p * p, b * r * r);
            let q = (part_a + part_b).sqrt();
            let q_slope = -((of_a * part_a * p + of_b * part_b * r) / q);
            step = third * gamma * q;
            let now = self.hardening.flow(plastic + step);
            end = [now.stress, now.slope];
            let change = q_slope - now.slope * third * (q + gamma * q_slope);
            if !newton.next(q - now.stress, change) {
                break;
            }
        }
        let end = [L::select(yields, end[0], flow), L::select(yields, end[1], slope)];
        ([parts[0], parts[1], newton.at, L::select(yields, step, zero)], end)
    }

    /// Δε_p of q − 3µ Δε_p = σ_y(ε_p + Δε_p), and the flow stress and its slope there.
    #[inline(always)]
    fn step_static<L: Lane>(&self, q: L, plastic: L, [flow, slope]: [L; 2], yields: L::Mask) -> (L, [L; 2]) {
        let stiffness = L::splat(3.0 * self.shear);
        let high = q * L::splat(1.0 / (3.0 * self.shear));
        let mut newton = Newton::new((q - flow) / (stiffness + slope), high, q, yields);
        let mut end = [flow, slope];
        for _ in 0..LIMIT {
            let flow = self.hardening.flow(plastic + newton.at);
            let (value, live) = (q - stiffness * newton.at - flow.stress, newton.live());
            let change = -(stiffness + flow.slope);
            let continues =
                if H::CURVED { newton.next_curved(value, change, -flow.curvature, flow.reach) } else { newton.next(value, change) };
            end = flow.after(newton.moved, live, end);
            if !continues {
                break;
            }
        }
        (newton.at, end)
    }

    /// The same with the rate. The unknown is u = (rate / C)^{1/P}: with it the equation is smooth, where
    /// Δε_p itself begins with an infinite slope.
    #[inline(always)]
    fn step_with_rate<L: Lane>(&self, rate: &Rate, time_step: L, q: L, plastic: L, [flow, slope]: [L; 2], yields: L::Mask) -> (L, [L; 2]) {
        let (stiffness, one, zero) = (L::splat(3.0 * self.shear), L::splat(1.0), L::splat(0.0));
        let high = rate.excess(q / stiffness, time_step);
        let mut newton = Newton::new((q - flow) / flow, high, q, yields);
        let (mut step, mut end) = (zero, [flow, slope]);
        for _ in 0..LIMIT {
            let u = newton.at;
            let [strain, strain_slope] = rate.strain(u, time_step);
            step = L::select(yields, strain, zero);
            let Flow { stress, slope, .. } = self.hardening.flow(plastic + step);
            end = [L::select(yields, stress, end[0]), L::select(yields, slope, end[1])];
            let change = (stiffness + slope * (one + u)) * strain_slope + stress;
            if !newton.next(q - stiffness * step - stress * (one + u), -change) {
                break;
            }
        }
        (step, end)
    }
}
