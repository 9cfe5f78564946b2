//! Linear viscoelasticity of the deviator with a Prony series, rate form.
//!
//! E and ν are those of a sudden load. The shear modulus relaxes as µ(t) = µ (1 − Σ g_k (1 − e^{−t/τ_k})),
//! the bulk modulus stays. A spring µ∞ = µ (1 − Σ g_k) stands beside Maxwell branches of spring µ g_k and
//! dashpot µ g_k τ_k with internal stresses h_k: ḣ_k + h_k/τ_k = 2µ g_k dev d, objective rate. For a constant
//! rate over the step, x = Δt/τ_k and φ = (1 − e^{−x})/x, exactly h_k ← e^{−x} Q h_k Qᵀ + 2µ g_k φ dev Δε; s
//! ← Q s Qᵀ + 2µ∞ dev Δε + Σ Δh_k.
//!
//! Dissipation: the dashpots' power h_k:h_k / (2µ g_k τ_k), integrated exactly over the same step. With w the
//! part of the change that is done at a time, its mean is ½ + l and its variance l/x, l = ½ coth(x/2) − 1/x,
//! so that the step takes (x |h + (½ + l) Δh|² + l |Δh|²) / (2µ g_k): never negative. What the block finds in
//! its store is then the energy of the springs, to the square of x.
//!
//! Limits: elastic strains small enough for a stress rate (as for `elastic`: some 10 %), any rotation. A
//! stress rate has no energy function: a closed cycle of finite strain can store or release a little of the
//! third order. Source: Simo and Hughes, Computational Inelasticity (1998), 10.3; Taylor, Pister and
//! Goudreau, Int. J. Numer. Meth. Engng 2 (1970) 45-59.

use super::{DENSITY, Family, Kinematics, Law, LawKind, POISSON, ParameterFault, Parameters, Response, Tensors, YOUNG, bulk_and_shear};
use crate::material::messages::PARAMETERS;
use crate::model::messages::LIST_LENGTH;
use crate::quantity::{Dimension, Parameter, Range};
use crate::tensor::SymmetricTensor;
use embate_lanes::{Lane, math};

/// Most branches.
const BRANCHES: usize = 4;

/// The law with its branches.
#[derive(Clone, Copy, Debug)]
pub struct Viscoelastic {
    bulk: f64,
    shear: f64,
    /// g_k, zero where there is no branch.
    ratios: [f64; BRANCHES],
    /// τ_k.
    times: [f64; BRANCHES],
}

impl Viscoelastic {
    /// µ∞.
    fn shear_at_last(&self) -> f64 {
        self.shear * (1.0 - self.ratios.iter().sum::<f64>())
    }
}

impl Law for Viscoelastic {
    const KIND: LawKind = LawKind {
        name: "viscoelastic",
        doc: "elasticity whose shear modulus relaxes (Prony series), in rate form; strains up to some 10 %, any rotation",
        source: "Simo and Hughes, Computational Inelasticity (1998), 10.3",
        parameters: &[
            DENSITY.such_as("1200 kg/m^3"),
            YOUNG.such_as("3 GPa"),
            POISSON,
            Parameter::new(
                "shear_ratio",
                "g_k",
                Dimension::NONE,
                Range::Between(0.0, 1.0),
                "up to four parts of the shear modulus that relax; below 1 in sum",
            )
            .such_as("0.3")
            .list(BRANCHES),
            Parameter::new("relaxation_time", "τ_k", Dimension::TIME, Range::Positive, "time in which each part falls to 1/e")
                .such_as("10 ms")
                .list(BRANCHES),
        ],
    };
    const FAMILY: Family = Family::Rate;
    /// Internal stresses h_k.
    type State<L: Lane, T: SymmetricTensor<L>> = Tensors<L, T, BRANCHES>;
    const NEEDS_ROTATION: bool = true;
    const DISSIPATES: bool = true;

    fn new(parameters: &Parameters<'_>) -> Self {
        let [bulk, shear] = bulk_and_shear(parameters);
        Self { bulk, shear, ratios: parameters.array("shear_ratio", 0.0), times: parameters.array("relaxation_time", 1.0) }
    }

    fn faults(parameters: &Parameters<'_>) -> Vec<ParameterFault> {
        let (ratios, times) = (parameters.list("shear_ratio"), parameters.list("relaxation_time"));
        let sum: f64 = ratios.iter().sum();
        if ratios.len() != times.len() {
            let message = format!("{} relaxation times for {} shear ratios", times.len(), ratios.len());
            return vec![ParameterFault {
                kind: &LIST_LENGTH,
                name: "relaxation_time",
                message,
                help: "give one time to each ratio".into(),
            }];
        }
        if sum >= 1.0 {
            let message = format!("shear ratios add up to {sum}: nothing of the shear modulus would be left after a long time");
            return vec![ParameterFault { kind: &PARAMETERS, name: "shear_ratio", message, help: "keep their sum below 1".into() }];
        }
        Vec::new()
    }

    #[inline(always)]
    fn update<L: Lane, T: SymmetricTensor<L>>(&self, kinematics: &Kinematics<L, T>, state: &mut Tensors<L, T, BRANCHES>) -> Response<L, T> {
        let (zero, half) = (L::splat(0.0), L::splat(0.5));
        let strain = kinematics.strain_increment;
        let deviator = strain.deviator();
        let mut stress = kinematics.stress_rotated;
        stress = stress.plus_isotropic(strain.trace() * L::splat(self.bulk));
        stress = stress.plus(deviator.times(L::splat(2.0 * self.shear_at_last())));
        let mut dissipated = zero;
        for k in 0..BRANCHES {
            // The same for every lane: branches that are not there cost nothing.
            if self.ratios[k] > 0.0 {
                let twice = 2.0 * self.shear * self.ratios[k];
                let x = kinematics.time_step * L::splat(1.0 / self.times[k]);
                let decay = math::exp(-x);
                let [fill, lag] = fill_and_lag(x, decay);
                let old = state.0[k].rotated(&kinematics.rotation);
                let change = old.times(-(x * fill)).plus(deviator.times(fill * L::splat(twice)));
                let mean = old.plus(change.times(half + lag));
                dissipated += (x * mean.contract(mean) + lag * change.contract(change)) * L::splat(1.0 / twice);
                state.0[k] = old.plus(change);
                stress = stress.plus(change);
            }
        }
        Response::rate(stress, dissipated, [self.bulk, self.shear])
    }

    fn stiffness(&self) -> [f64; 2] {
        [self.bulk, self.shear]
    }

    /// What a point has at the start has relaxed: no branch holds any of it.
    fn energy(&self, stress: [f64; 6]) -> f64 {
        super::elastic_energy([self.bulk, self.shear_at_last()], stress)
    }
}

/// φ = (1 − e^{−x})/x and l = ½ coth(x/2) − 1/x for x ≥ 0 with `decay` = e^{−x}; by their series where x < ½,
/// to 1e-13 of their size.
#[inline(always)]
fn fill_and_lag<L: Lane>(x: L, decay: L) -> [L; 2] {
    let one = L::splat(1.0);
    let small = x.less(L::splat(0.5));
    let safe = L::select(small, one, x);
    let mut fill = one;
    for k in [13.0, 12.0, 11.0, 10.0, 9.0, 8.0, 7.0, 6.0, 5.0, 4.0, 3.0, 2.0] {
        fill = one - x * fill * L::splat(1.0 / k);
    }
    // Bernoulli numbers B_2n / (2n)!
    let y = x * x;
    let mut lag = L::splat(-691.0 / 1_307_674_368_000.0);
    for term in [1.0 / 47_900_160.0, -1.0 / 1_209_600.0, 1.0 / 30_240.0, -1.0 / 720.0, 1.0 / 12.0] {
        lag = lag * y + L::splat(term);
    }
    let apart = one - L::select(small, L::splat(0.5), decay);
    [L::select(small, fill, apart / safe), L::select(small, lag * x, L::splat(0.5) * (one + decay) / apart - one / safe)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_and_closed_forms_agree_where_they_meet_and_in_their_limits() {
        for x in [1e-12f64, 1e-3, 0.1, 0.3, 0.499_999, 0.500_001, 1.0, 30.0, 700.0, 1e5] {
            let [fill, lag] = fill_and_lag(x, embate_lanes::math::exp(-x));
            let [fill_right, lag_right] = [-(-x).exp_m1() / x, if x < 1e-2 { x / 12.0 } else { 0.5 / (0.5 * x).tanh() - 1.0 / x }];
            assert!((fill / fill_right - 1.0).abs() < 1e-14, "{x}: {fill} {fill_right}");
            assert!((lag / lag_right - 1.0).abs() < 1e-6 && (x < 0.05 || (lag / lag_right - 1.0).abs() < 2e-13), "{x}: {lag} {lag_right}");
        }
        assert_eq!(fill_and_lag(0.0, 1.0), [1.0, 0.0]);
    }
}
