//! Crushable foam after Deshpande and Fleck: it yields under pressure too, and hardens along a curve measured
//! in uniaxial compression.
//!
//! Φ² = (q² + α² σ_m²) / (1 + (α/3)²) ≤ Y(ε̂)², σ_m = ⅓ tr σ. The shape follows from the plastic Poisson's
//! ratio ν_p: α² = 9 (1 − 2ν_p) / (2 (1 + ν_p)); ν_p = 0, most foams, gives α = 3/√2: nothing moves sideways
//! while it is crushed. In uniaxial stress Φ is |σ| and ε̂ the plastic strain, so Y is the measured curve of
//! true stress over logarithmic plastic strain. Flow is associated: σ:Δε_p = Y Δε̂, never negative. Return
//! (backward Euler) with c = 1 + (α/3)² and g = Δε̂ / (c Y): q ← q / (1 + 3µ g), σ_m ← σ_m / (1 + K α² g);
//! Δε̂ solves Φ = Y(ε̂ + Δε̂). Where σ_m then exceeds the tension cutoff it is cut, as the surface bends
//! inwards there; the volume that this opens is dissipation too. The elastic moduli stay those of the foam at
//! rest. Dissipation as in `trial.rs`, with both parts. Source: Deshpande and Fleck, Journal of the Mechanics
//! and Physics of Solids 48 (2000) 1253-1283.

use super::hardening::{Flow, Hardening, PLASTIC_STRAIN, STRESS, Table};
use super::trial::{LIMIT, Newton, Trial};
use super::{
    DENSITY, Family, History, Kinematics, Law, LawKind, POISSON, ParameterFault, Parameters, Response, Softening, YOUNG, bulk_and_shear,
    variable,
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
            DENSITY.such_as("100 kg/m^3"),
            YOUNG.such_as("100 MPa"),
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
            STRESS.such_as("1 MPa"),
            Parameter::new(
                "tension_cutoff",
                "p_t",
                Dimension::PRESSURE,
                Range::NotNegative,
                "mean stress in tension at which it tears; 0: none",
            )
            .such_as("1 MPa")
            .or(0.0),
        ],
    };
    const FAMILY: Family = Family::Rate;
    const FLOWS_IN_VOLUME: bool = true;
    /// ε̂.
    type State<L: Lane, T: SymmetricTensor<L>> = [L; 1];
    const VARIABLES: &'static [History] = &[variable::PLASTIC_STRAIN.at(0)];
    const CAN_BE_AVERAGED: bool = true;

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
        let Flow { stress: flow, slope, .. } = self.curve.flow(state[0]);
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
            let shear_mean = (trial.old(self.shear, kinematics.strain_increment, q, L::splat(1.0) / q) + q * factor) * half;
            // A foam under pure pressure has no N.
            let shear_work = L::select(zero.less(shear_strain), shear_mean * shear_strain, zero);
            dissipated = (shear_work + (old + new) * half * swelling).max(zero);
            deviator = trial.scaled(factor, yields);
            mean = new;
            state[0] += step;
        }
        Response::rate(deviator.plus_isotropic(mean), dissipated, [self.bulk, self.shear])
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
        let (zero, one, two, three) = (L::splat(0.0), L::splat(1.0), L::splat(2.0), L::splat(3.0));
        let (per_scale, shape) = (L::splat(1.0 / self.scale()), L::splat(self.shape));
        let [shear, bulk] = [3.0 * self.shear, self.bulk * self.shape];
        let (softer, stiffer) = (L::splat(1.0 / shear.min(bulk)), L::splat(0.25 * self.scale() / shear.max(bulk)));
        let (shear, bulk) = (L::splat(shear), L::splat(bulk));
        let (square, square_mean) = (q * q, shape * mean * mean);
        // Φ_trial ≥ Φ (1 + k g) with the softer stiffness k bounds the step, for a curve that falls with
        // Φ = 0; the tangent starts it.
        let least = if self.falls { zero } else { flow };
        let high = L::splat(self.scale()) * (equivalent - least) * softer;
        let falling = (square * shear + square_mean * bulk) * (per_scale * per_scale);
        let start = (equivalent - flow) * (equivalent * flow) / (falling + slope * equivalent * flow);
        let mut newton = Newton::new(start, high, equivalent, yields);
        let mut g = zero;
        for _ in 0..LIMIT {
            let step = newton.at;
            let curve = self.curve.flow(old + step);
            let per_flow = one / curve.stress;
            let of_step = per_flow * per_scale;
            let own = step * of_step;
            // dg/dΔε̂ and its slope
            let growth = of_step * (one - step * curve.slope * per_flow);
            let growth_slope = -(two * curve.slope * per_flow * growth);
            let (shear_part, bulk_part) = (one + shear * own, one + bulk * own);
            let inverse = one / (shear_part * bulk_part);
            let (by_shear, by_bulk) = (inverse * bulk_part, inverse * shear_part);
            let (a, b) = (square * by_shear * by_shear, square_mean * by_bulk * by_bulk);
            let (k, l) = (by_shear * shear, by_bulk * bulk);
            let equivalent = ((a + b) * per_scale).sqrt();
            let per_equivalent = one / equivalent;
            // dΦ/dg and its slope, from Φ² = (a + b)/c
            let falling = -((a * k + b * l) * per_scale * per_equivalent);
            let falling_slope = (three * (a * (k * k) + b * (l * l)) * per_scale - falling * falling) * per_equivalent;
            let value = equivalent - curve.stress;
            let change = falling * growth - curve.slope;
            let curvature = falling_slope * (growth * growth) + falling * growth_slope;
            // They change within 1/4k of g, and so within that of Δε̂ = c Y g.
            let reach = curve.stress * stiffer;
            let live = newton.live();
            let continues = newton.next_curved(value, change, curvature, reach.min(curve.reach));
            let after = own + newton.moved * (growth + L::splat(0.5) * growth_slope * newton.moved);
            g = L::select(live, after, g);
            if !continues {
                break;
            }
        }
        [newton.at, L::select(yields, g, zero)]
    }
}
