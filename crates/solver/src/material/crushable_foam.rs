//! Crushable foam after Deshpande and Fleck: it yields under pressure too, and hardens along a curve measured in uniaxial compression.
//!
//! Φ² = (q² + α² σ_m²) / (1 + (α/3)²) ≤ Y(ε̂)², σ_m = ⅓ tr σ. The shape follows from the plastic Poisson's ratio ν_p: α² = 9 (1 − 2ν_p) / (2 (1 + ν_p));
//! ν_p = 0, most foams, gives α = 3/√2: nothing moves sideways while it is crushed. In uniaxial stress Φ is |σ| and ε̂ the plastic strain,
//! so Y is the measured curve of true stress over logarithmic plastic strain. Flow is associated: σ:Δε_p = Y Δε̂, never negative.
//! Return (backward Euler) with c = 1 + (α/3)² and g = Δε̂ / (c Y): q ← q / (1 + 3µ g), σ_m ← σ_m / (1 + K α² g); Δε̂ solves Φ = Y(ε̂ + Δε̂).
//! Where σ_m then exceeds the tension cutoff it is cut, as the surface bends inwards there; the volume that this opens is dissipation too.
//! The elastic moduli stay those of the foam at rest. Dissipation as in `trial.rs`, with both parts.
//! Source: Deshpande and Fleck, Journal of the Mechanics and Physics of Solids 48 (2000) 1253-1283.

use super::hardening::{Hardening, PLASTIC_STRAIN, STRESS, Table};
use super::trial::{LIMIT, Newton, Trial};
use super::{
    DENSITY, Family, Kinematics, Law, LawKind, POISSON, ParameterFault, Parameters, Response, Softening, Variable, YOUNG, bulk_and_shear,
};
use crate::quantity::{Dimension, Parameter, Range};
use crate::tensor::SymmetricTensor;
use embate_lanes::Lane;

/// The law with its moduli.
#[derive(Clone, Copy, Debug)]
pub struct CrushableFoam {
    bulk: f64,
    shear: f64,
    curve: Table,
    /// Whether the curve falls somewhere.
    falls: bool,
    /// α².
    shape: f64,
    /// Largest mean stress, Pa; infinite without cutoff.
    cutoff: f64,
}

impl Law for CrushableFoam {
    const KIND: LawKind = LawKind {
        name: "crushable_foam",
        doc: "foam that is crushed: yields under pressure and shear, hardens along a measured curve (Deshpande and Fleck)",
        source: "Deshpande and Fleck, J. Mech. Phys. Solids 48 (2000) 1253-1283",
        parameters: &[
            DENSITY,
            YOUNG,
            POISSON,
            Parameter::new(
                "plastic_poisson",
                "ν_p",
                Dimension::NONE,
                Range::Between(-1.0, 0.5),
                "sideways over lengthwise plastic strain in uniaxial compression",
            )
            .or(0.0),
            PLASTIC_STRAIN,
            STRESS,
            Parameter::new(
                "tension_cutoff",
                "p_t",
                Dimension::PRESSURE,
                Range::NotNegative,
                "mean stress in tension at which it tears; 0: none",
            )
            .or(0.0),
        ],
    };
    const FAMILY: Family = Family::Rate;
    const FLOWS_IN_VOLUME: bool = true;
    /// ε̂.
    type State<L: Lane, T: SymmetricTensor<L>> = [L; 1];
    const VARIABLES: &'static [(Variable, usize)] = &[(Variable::PlasticStrain, 0)];

    fn new(parameters: &Parameters<'_>) -> Self {
        let [bulk, shear] = bulk_and_shear(parameters);
        let (plastic, cutoff) = (parameters.value("plastic_poisson"), parameters.value("tension_cutoff"));
        let curve = Table::new(parameters, shear);
        Self {
            bulk,
            shear,
            falls: curve.steepest() < 0.0,
            curve,
            shape: 4.5 * (1.0 - 2.0 * plastic) / (1.0 + plastic),
            cutoff: if cutoff > 0.0 { cutoff } else { f64::INFINITY },
        }
    }

    fn faults(parameters: &Parameters<'_>) -> Vec<ParameterFault> {
        let faults = Table::faults(parameters);
        if faults.is_empty() { Softening::faults(Self::softening(parameters)) } else { faults }
    }

    fn softening(parameters: &Parameters<'_>) -> Option<Softening> {
        let it = Self::new(parameters);
        let slope = it.curve.steepest();
        (slope < 0.0).then(|| Softening::foam(STRESS.name, slope, [it.bulk, it.shear], it.shape, it.scale()))
    }

    #[inline(always)]
    fn update<L: Lane, T: SymmetricTensor<L>>(&self, kinematics: &Kinematics<L, T>, state: &mut [L; 1]) -> Response<L, T> {
        let (zero, half) = (L::splat(0.0), L::splat(0.5));
        let (trial, cutoff) = (Trial::new(self.bulk, self.shear, kinematics), L::splat(self.cutoff));
        let (mut deviator, mut mean, mut dissipated) = (trial.deviator, trial.mean, zero);
        let [flow, slope] = self.curve.flow(state[0]);
        let equivalent = (trial.square + L::splat(self.shape) * mean * mean) * L::splat(1.0 / self.scale());
        let yields = (flow * flow).less(equivalent);
        if L::any(L::either(yields, cutoff.less(mean))) {
            let q = trial.square.sqrt();
            let [step, g] = self.step(q, mean, state[0], [equivalent.sqrt(), flow, slope], yields);
            let factor = L::splat(1.0) / (L::splat(1.0) + L::splat(3.0 * self.shear) * g);
            let new = (mean / (L::splat(1.0) + L::splat(self.bulk * self.shape) * g)).min(cutoff);
            // Plastic strains: of the deviator along N, and of the volume.
            let shear_strain = g * q * factor;
            let swelling = (mean - new) * L::splat(1.0 / self.bulk);
            let old = mean - L::splat(self.bulk) * kinematics.strain_increment.trace();
            let shear_mean = (trial.old(self.shear, kinematics.strain_increment, q) + q * factor) * half;
            // A foam under pure pressure has no N.
            let shear_work = L::select(zero.less(shear_strain), shear_mean * shear_strain, zero);
            dissipated = (shear_work + (old + new) * half * swelling).max(zero);
            deviator = trial.scaled(factor, yields);
            mean = new;
            state[0] += step;
        }
        Response::rate(deviator.plus(T::isotropic(mean)), dissipated, [self.bulk, self.shear])
    }

    fn stiffness(&self) -> [f64; 2] {
        [self.bulk, self.shear]
    }
}

impl CrushableFoam {
    /// c = 1 + (α/3)².
    #[inline(always)]
    fn scale(&self) -> f64 {
        1.0 + self.shape / 9.0
    }

    /// [Δε̂, g] where it `yields`, zeros elsewhere, from Φ, Y and Y' of the trial.
    #[inline(always)]
    fn step<L: Lane>(&self, q: L, mean: L, old: L, [equivalent, flow, slope]: [L; 3], yields: L::Mask) -> [L; 2] {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let (c, shape) = (L::splat(self.scale()), L::splat(self.shape));
        let (shear, bulk) = (L::splat(3.0 * self.shear), L::splat(self.bulk * self.shape));
        // Φ_trial ≥ Φ (1 + k g) with the softer stiffness k bounds the step, for a curve that falls with Φ = 0; the stiffer one starts it.
        let least = if self.falls { zero } else { flow };
        let high = c * (equivalent - least) / shear.min(bulk);
        let mut newton = Newton::new((equivalent - flow) / (shear.max(bulk) / c + slope), high, equivalent, yields);
        let mut g = zero;
        for _ in 0..LIMIT {
            let step = newton.at;
            let [flow, slope] = self.curve.flow(old + step);
            g = step / (c * flow);
            let (by_shear, by_bulk) = (one / (one + shear * g), one / (one + bulk * g));
            let (q, mean) = (q * by_shear, mean * by_bulk);
            let (a, b) = (q * q, shape * mean * mean);
            let equivalent = ((a + b) / c).sqrt();
            let falling = (a * by_shear * shear + b * by_bulk * bulk) / (c * equivalent);
            let growth = (one - step * slope / flow) / (c * flow);
            if !newton.next(equivalent - flow, -(falling * growth + slope)) {
                break;
            }
        }
        [newton.at, L::select(yields, g, zero)]
    }
}
