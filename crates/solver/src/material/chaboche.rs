//! Von Mises plasticity with mixed hardening: saturating isotropic hardening and up to three backstresses
//! that fade (Armstrong and Frederick, Chaboche).
//!
//! ξ = s − Σ α_k, q = √(3/2 ξ:ξ); flow where q > σ_y(ε_p) = σ_y0 + Q (1 − e^{−b ε_p}), along N = 3/2 ξ/q;
//! α̇_k = ⅔ C_k ε̇_p N − γ_k ε̇_p α_k: with γ_k = 0 linear kinematic hardening (Prager), else a backstress
//! that saturates at C_k / γ_k. Return (backward Euler): α_k ← a_k (α_k + ⅔ C_k Δε_p N), a_k = 1 / (1 + γ_k
//! Δε_p), so that ξ keeps the direction of η = s_trial − Σ a_k α_k and Δε_p solves q(η) − (3µ + Σ a_k C_k)
//! Δε_p = σ_y(ε_p + Δε_p). Energy: each backstress stores ¾ α_k:α_k / C_k, counted as stored; dissipated are
//! the isotropic flow stress and the recall, ½ (ξ_old + ξ_new):Δε_p + Σ ¾ (γ_k / C_k) Δε_p α_k,new:(α_k,old +
//! α_k,new). With `trial.rs` that closes to the last digit. Source: Chaboche, Int. J. Plasticity 2 (1986)
//! 149-188; return: Hartmann and Haupt, Int. J. Numer. Meth. Engng 36 (1993) 3801-3814.

use super::hardening::{Flow, Hardening, Voce, YIELD};
use super::trial::{LIMIT, Newton, Trial};
use super::{
    DENSITY, Family, History, Kinematics, Law, LawKind, POISSON, ParameterFault, Parameters, Response, Softening, State, Tensors, YOUNG,
    bulk_and_shear, variable,
};
use crate::material::messages::PARAMETERS;
use crate::model::messages::LIST_LENGTH;
use crate::quantity::{Dimension, Parameter, Range};
use crate::tensor::SymmetricTensor;
use embate_lanes::Lane;

/// Most backstresses.
const PARTS: usize = 3;

/// The law with its moduli.
#[derive(Clone, Copy, Debug)]
pub struct Chaboche {
    bulk: f64,
    shear: f64,
    isotropic: Voce,
    modulus: [f64; PARTS],
    recall: [f64; PARTS],
    /// ¾ γ/C.
    fading: [f64; PARTS],
    /// Plastic strain over which hardening and backstresses change by their part.
    reach: f64,
}

/// The backstresses on the way to the end of a step.
#[derive(Clone, Copy)]
struct Backstresses<L: Lane, T: SymmetricTensor<L>> {
    /// a_k.
    factors: [L; PARTS],
    /// Σ a_k C_k.
    modulus: L,
    /// η = s_trial − Σ a_k α_k.
    shifted: T,
    /// dη/dΔε_p = Σ γ_k a_k² α_k and d²η/dΔε_p² = −2 Σ γ_k² a_k³ α_k.
    slope: T,
    curvature: T,
    /// Those of Σ a_k C_k Δε_p: Σ a_k² C_k and −2 Σ γ_k a_k³ C_k.
    modulus_slope: L,
    modulus_curvature: L,
}

impl Law for Chaboche {
    const KIND: LawKind = LawKind {
        name: "chaboche",
        doc: "elasto-plasticity after von Mises with kinematic and isotropic hardening, for load that turns around (Chaboche)",
        source: "Chaboche, Int. J. Plasticity 2 (1986) 149-188",
        parameters: &[
            DENSITY,
            YOUNG,
            POISSON,
            YIELD,
            Parameter::new(
                "isotropic_stress",
                "Q",
                Dimension::PRESSURE,
                Range::Finite,
                "what isotropic hardening adds to the yield stress in the end; negative: cyclic softening, more than `-yield`",
            )
            .or(0.0),
            Parameter::new(
                "isotropic_rate",
                "b",
                Dimension::NONE,
                Range::Positive,
                "how fast: after a plastic strain of 1/b 63 % are done",
            )
            .or(10.0),
            Parameter::new("backstress_modulus", "C", Dimension::PRESSURE, Range::Positive, "initial moduli of up to three backstresses")
                .such_as("20 GPa")
                .list(PARTS),
            Parameter::new(
                "backstress_recall",
                "γ",
                Dimension::NONE,
                Range::NotNegative,
                "how fast each fades: it saturates at C/γ; 0 is linear hardening; left out, all are 0",
            )
            .or(0.0)
            .list(PARTS),
        ],
    };
    const FAMILY: Family = Family::Rate;
    /// Equivalent plastic strain, isotropic flow stress and its slope there; backstresses.
    type State<L: Lane, T: SymmetricTensor<L>> = ([L; 3], Tensors<L, T, PARTS>);
    const VARIABLES: &'static [History] = &[variable::PLASTIC_STRAIN.at(0)];
    const NEEDS_ROTATION: bool = true;
    const CAN_BE_AVERAGED: bool = true;

    fn new(parameters: &Parameters<'_>) -> Self {
        let [bulk, shear] = bulk_and_shear(parameters);
        let value = |name| parameters.value(name);
        let isotropic = Voce { yield_stress: value("yield"), gain: value("isotropic_stress"), rate: value("isotropic_rate"), modulus: 0.0 };
        let modulus = parameters.array("backstress_modulus", 0.0);
        let recall: [f64; PARTS] = parameters.array("backstress_recall", 0.0);
        let fading = std::array::from_fn(|k| if modulus[k] > 0.0 { 0.75 * recall[k] / modulus[k] } else { 0.0 });
        let reach = 1.0 / (isotropic.rate + 3.0 * recall.iter().fold(0.0, |most: f64, &recall| most.max(recall)));
        Self { bulk, shear, isotropic, modulus, recall, fading, reach }
    }

    fn faults(parameters: &Parameters<'_>) -> Vec<ParameterFault> {
        let (moduli, recalls) = (parameters.list("backstress_modulus"), parameters.list("backstress_recall"));
        if !recalls.is_empty() && recalls.len() != moduli.len() {
            return vec![ParameterFault {
                kind: &LIST_LENGTH,
                name: "backstress_recall",
                message: format!("there are {} recalls for {} backstress moduli", recalls.len(), moduli.len()),
                help: "give one for each backstress, 0 for one that doesn't fade".into(),
            }];
        }
        let (gain, yield_stress) = (parameters.value("isotropic_stress"), parameters.value("yield"));
        if gain <= -yield_stress {
            return vec![ParameterFault {
                kind: &PARAMETERS,
                name: "isotropic_stress",
                message: format!("softening by {:.4e} Pa leaves nothing of the yield stress of {yield_stress:.4e} Pa", -gain),
                help: "take more than `-yield`".into(),
            }];
        }
        let it = Self::new(parameters);
        let isotropic = Softening::von_mises("isotropic_stress", it.isotropic.steepest(), None, [it.bulk, it.shear]);
        Softening::faults((isotropic.slope < 0.0).then_some(isotropic))
    }

    /// Where the backstresses do not make up for it: the tension of a virgin point falls.
    fn softening(parameters: &Parameters<'_>) -> Option<Softening> {
        let it = Self::new(parameters);
        let slope = it.slope_least();
        (slope < 0.0).then(|| Softening::von_mises("isotropic_stress", slope, None, [it.bulk, it.shear]))
    }

    fn start<L: Lane, T: SymmetricTensor<L>>(&self) -> Self::State<L, T> {
        let plastic = L::splat(0.0);
        let Flow { stress, slope, .. } = self.isotropic.flow(plastic);
        ([plastic, stress, slope], State::zero())
    }

    fn renew<L: Lane, T: SymmetricTensor<L>>(&self, state: &mut Self::State<L, T>) {
        let plastic = state.0[0];
        let Flow { stress, slope, .. } = self.isotropic.flow(plastic);
        state.0 = [plastic, stress, slope];
    }

    #[inline(always)]
    fn update<L: Lane, T: SymmetricTensor<L>>(&self, kinematics: &Kinematics<L, T>, state: &mut Self::State<L, T>) -> Response<L, T> {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let [_, flow, _] = state.0;
        let mut old = state.1.0;
        let trial = Trial::new(self.bulk, self.shear, kinematics);
        let mut shifted = trial.deviator;
        for k in 0..PARTS {
            old[k] = old[k].rotated(&kinematics.rotation);
            shifted = shifted.plus(old[k].times(-one));
        }
        let square = shifted.contract(shifted) * L::splat(1.5);
        let yields = (flow * flow).less(square);
        let (mut deviator, mut dissipated, mut backstresses) = (trial.deviator, zero, old);
        if L::any(yields) {
            let (step, isotropic) = self.step(trial.deviator, &old, square.sqrt(), state.0, yields);
            let end = self.backstresses(trial.deviator, &old, step);
            let q = (end.shifted.contract(end.shifted) * L::splat(1.5)).sqrt();
            // Δε_p N, a tensor.
            let strain = end.shifted.times(L::select(yields, L::splat(1.5) * step / q, zero));
            deviator = trial.deviator.plus(strain.times(L::splat(-2.0 * self.shear)));
            let mut mean = deviator.plus(trial.deviator).plus(kinematics.strain_increment.times(L::splat(-2.0 * self.shear)));
            let mut recalled = zero;
            for k in 0..PARTS {
                let new = old[k].plus(strain.times(L::splat(2.0 / 3.0 * self.modulus[k]))).times(end.factors[k]);
                let sum = old[k].plus(new);
                mean = mean.plus(sum.times(-one));
                recalled += new.contract(sum) * L::splat(self.fading[k]);
                backstresses[k] = new;
            }
            dissipated = (mean.contract(strain) * L::splat(0.5) + recalled * step).max(zero);
            dissipated = L::select(yields, dissipated, zero);
            state.0 = [state.0[0] + step, isotropic[0], isotropic[1]];
        }
        state.1 = Tensors::new(backstresses);
        Response::rate(deviator.plus_isotropic(trial.mean), dissipated, [self.bulk, self.shear])
    }

    fn stiffness(&self) -> [f64; 2] {
        [self.bulk, self.shear]
    }
}

impl Chaboche {
    /// Least slope of the curve of a virgin point in tension, f = b Q e^{−b ε_p} + Σ C_k e^{−γ_k ε_p}, Pa;
    /// zero where it is negative nowhere. f e^{b ε_p} is a sum of exponentials and so convex: f is below zero
    /// in one interval. What of it begins after the slowest has fallen to a millionth is as small and does
    /// not count.
    fn slope_least(&self) -> f64 {
        let Voce { gain, rate, .. } = self.isotropic;
        if gain >= 0.0 {
            return 0.0;
        }
        let slope = |plastic: f64| {
            let backstresses = self.modulus.iter().zip(&self.recall).map(|(modulus, recall)| modulus * (-recall * plastic).exp());
            rate * gain * (-rate * plastic).exp() + backstresses.sum::<f64>()
        };
        let slowest = self
            .recall
            .iter()
            .zip(&self.modulus)
            .filter(|(_, modulus)| **modulus > 0.0)
            .fold(rate, |least, (&recall, _)| recall.min(least));
        let fastest = self.recall.iter().fold(rate, |most, &recall| recall.max(most));
        let end = if slowest > 0.0 { 14.0 / slowest } else { 14.0 / rate };
        // Fine enough for the fastest, coarse enough to be cheap.
        let steps = (100.0 * end * fastest).clamp(1000.0, 100_000.0) as usize;
        (0..=steps).map(|k| slope(end * k as f64 / steps as f64)).fold(0.0, f64::min)
    }

    /// What the backstresses have become of after a plastic strain of `step`, as far as the return needs it.
    #[inline(always)]
    fn backstresses<L: Lane, T: SymmetricTensor<L>>(&self, deviator: T, old: &[T; PARTS], step: L) -> Backstresses<L, T> {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let mut end = Backstresses {
            factors: [one; PARTS],
            modulus: zero,
            shifted: deviator,
            slope: T::isotropic(zero),
            curvature: T::isotropic(zero),
            modulus_slope: zero,
            modulus_curvature: zero,
        };
        for k in 0..PARTS {
            // The same for every lane: backstresses that are not there cost nothing.
            if self.modulus[k] > 0.0 {
                let recall = L::splat(self.recall[k]);
                let factor = one / (one + recall * step);
                let modulus = L::splat(self.modulus[k]) * factor;
                let (first, second) = (recall * factor, L::splat(-2.0 * self.recall[k]) * factor);
                end.factors[k] = factor;
                end.modulus += modulus;
                end.modulus_slope += modulus * factor;
                end.modulus_curvature += modulus * factor * second;
                let left = old[k].times(factor);
                end.shifted = end.shifted.plus(left.times(-one));
                end.slope = end.slope.plus(left.times(first));
                end.curvature = end.curvature.plus(left.times(first * second));
            }
        }
        end
    }

    /// Δε_p where it `yields`, from q = q(η) of the trial, and the isotropic flow stress with its slope after
    /// it.
    #[inline(always)]
    fn step<L: Lane, T: SymmetricTensor<L>>(&self, deviator: T, old: &[T; PARTS], q: L, at_start: [L; 3], yields: L::Mask) -> (L, [L; 2]) {
        let (stiffness, factor, one) = (L::splat(3.0 * self.shear), L::splat(1.5), L::splat(1.0));
        // q(η) never exceeds the sum of the trial stress and the old backstresses, and that not the root of
        // as many times their squares.
        let mut squares = deviator.contract(deviator);
        let (mut pull, mut modulus) = (T::isotropic(L::splat(0.0)), 0.0);
        let mut shifted = deviator;
        for k in 0..PARTS {
            squares += old[k].contract(old[k]);
            shifted = shifted.plus(old[k].times(-one));
            pull = pull.plus(old[k].times(L::splat(self.recall[k])));
            modulus += self.modulus[k];
        }
        let most = (squares * L::splat(1.5 * (1 + PARTS) as f64)).sqrt();
        let [plastic, flow, slope] = at_start;
        let first = stiffness + L::splat(modulus) + slope - shifted.contract(pull) * factor / q;
        let mut newton = Newton::new((q - flow) / first.max(stiffness * L::splat(0.1)), most / stiffness, q, yields);
        let mut isotropic = [flow, slope];
        for _ in 0..LIMIT {
            let step = newton.at;
            let end = self.backstresses(deviator, old, step);
            let flow = self.isotropic.flow(plastic + step);
            let q = (end.shifted.contract(end.shifted) * factor).sqrt();
            let inverse = one / q;
            let turn = end.shifted.contract(end.slope) * factor * inverse;
            let bend = ((end.slope.contract(end.slope) + end.shifted.contract(end.curvature)) * factor - turn * turn) * inverse;
            let value = q - (stiffness + end.modulus) * step - flow.stress;
            let slope = turn - (stiffness + end.modulus_slope + flow.slope);
            let live = newton.live();
            // q(η) turns within q over the moduli.
            let reach = L::splat(self.reach).min(q * L::splat(1.0 / (3.0 * modulus)));
            let continues = newton.next_curved(value, slope, bend - (end.modulus_curvature + flow.curvature), reach);
            isotropic = flow.after(newton.moved, live, isotropic);
            if !continues {
                break;
            }
        }
        (newton.at, isotropic)
    }
}
