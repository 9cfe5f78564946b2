//! Johnson and Cook's plasticity of metals: hardening, rate, heat and damage, for impact.
//!
//! σ_y = (A + B ε_p^n)(1 + C ln max(ε̇_p / ε̇_0, 1))(1 − T*^m), T* = (T − T_r) / (T_m − T_r) within 0 and 1:
//! at the melting point no shear is left. The term B ε_p^n has the same chord at its start as in
//! `hardening/ludwik.rs`. The flow stress at the end of the step is met (radial return, Newton to 1e-12) at
//! the temperature of its start; then the step heats by ΔT = χ D / (ρ c), with the dissipation D of
//! `trial.rs` and the initial density ρ, as nothing conducts in so short a time (Simo and Miehe's isothermal
//! split). Damage grows by Δε_p / ε_f, ε_f = (D1 + D2 e^{D3 σ*}) (1 + D4 ln max(ε̇_p/ε̇_0, 1)) (1 + D5 T*),
//! with the triaxiality σ* = σ_m / q (tension positive, so that D3 of metals is negative) of at most 1.5. It
//! weakens nothing: at 1 the material has come to its end. Source: Johnson and Cook, 7th Int. Symp.
//! Ballistics (1983) 541-547; damage: Engineering Fracture Mechanics 21 (1985) 31-48.

use super::hardening::{Flow, Power, YIELD};
use super::trial::{LIMIT, Newton, Trial};
use super::{
    DENSITY, Family, History, Kinematics, Law, LawKind, POISSON, ParameterFault, Parameters, Response, YOUNG, bulk_and_shear, variable,
};
use crate::material::messages::PARAMETERS;
use crate::model::messages::LIST_LENGTH;
use crate::quantity::{Dimension, Parameter, Range};
use crate::tensor::SymmetricTensor;
use embate_lanes::{Lane, math};

/// Constants of the damage.
const CONSTANTS: usize = 5;
/// Least failure strain: what D1..D5 make negative breaks at once.
const FAILURE_LEAST: f64 = 1e-6;

/// The law with its moduli.
#[derive(Clone, Copy, Debug)]
pub struct JohnsonCook {
    bulk: f64,
    shear: f64,
    yield_stress: f64,
    power: Power,
    rate_coefficient: f64,
    rate_reference: f64,
    softening: f64,
    temperature: f64,
    temperature_reference: f64,
    /// 1 / (T_m − T_r).
    per_range: f64,
    /// χ / (ρ c).
    heating: f64,
    damage: Option<[f64; CONSTANTS]>,
}

impl Law for JohnsonCook {
    const KIND: LawKind = LawKind {
        name: "johnson_cook",
        doc: "metal at high rates: hardening, rate, heating by plastic work, softening by heat, damage (Johnson and Cook)",
        source: "Johnson and Cook, 7th Int. Symp. Ballistics (1983) 541-547; Eng. Fract. Mech. 21 (1985) 31-48",
        parameters: &[
            DENSITY,
            YOUNG,
            POISSON,
            YIELD,
            Parameter::new(
                "strength",
                "B",
                Dimension::PRESSURE,
                Range::NotNegative,
                "what a plastic strain of one adds to the flow stress",
            )
            .such_as("500 MPa"),
            Parameter::new("hardening_exponent", "n", Dimension::NONE, Range::UpTo(0.0, 1.0), "exponent of the plastic strain")
                .such_as("0.3"),
            Parameter::new(
                "rate_coefficient",
                "C",
                Dimension::NONE,
                Range::NotNegative,
                "growth of the flow stress with the logarithm of the rate",
            )
            .or(0.0),
            Parameter::new(
                "rate_reference",
                "ε̇_0",
                Dimension::RATE,
                Range::Positive,
                "rate of plastic strain up to which there is no growth",
            )
            .or(1.0),
            Parameter::new("softening_exponent", "m", Dimension::NONE, Range::Positive, "exponent of the temperature").or(1.0),
            Parameter::new("temperature", "T_0", Dimension::TEMPERATURE, Range::Positive, "initial temperature").or(293.15),
            Parameter::new(
                "temperature_reference",
                "T_r",
                Dimension::TEMPERATURE,
                Range::Positive,
                "temperature up to which nothing softens: that of the tests behind A, B and n",
            )
            .or(293.15),
            Parameter::new(
                "temperature_melt",
                "T_m",
                Dimension::TEMPERATURE,
                Range::Positive,
                "melting point: no shear strength from there on",
            )
            .such_as("1790 K"),
            Parameter::new("specific_heat", "c", Dimension::SPECIFIC_HEAT, Range::Positive, "heat per mass and temperature")
                .such_as("477 J/kg/K"),
            Parameter::new("taylor_quinney", "χ", Dimension::NONE, Range::UpTo(0.0, 1.0), "share of the plastic work that heats").or(0.9),
            Parameter::new(
                "damage",
                "D1..D5",
                Dimension::NONE,
                Range::Finite,
                "five constants of the failure strain; none: no damage is counted",
            )
            .or(0.0)
            .list(CONSTANTS),
        ],
    };
    const FAMILY: Family = Family::Rate;
    /// Equivalent plastic strain, temperature, damage; the term B ε_p^n and its slope there.
    type State<L: Lane, T: SymmetricTensor<L>> = [L; 5];
    const VARIABLES: &'static [History] = &[variable::PLASTIC_STRAIN.at(0), variable::TEMPERATURE.at(1), variable::DAMAGE.at(2)];
    const CAN_BE_AVERAGED: bool = true;

    fn new(parameters: &Parameters<'_>) -> Self {
        let [bulk, shear] = bulk_and_shear(parameters);
        let value = |name| parameters.value(name);
        Self {
            bulk,
            shear,
            yield_stress: value("yield"),
            power: Power::new(value("strength"), value("hardening_exponent"), shear),
            rate_coefficient: value("rate_coefficient"),
            rate_reference: value("rate_reference"),
            softening: value("softening_exponent"),
            temperature: value("temperature"),
            temperature_reference: value("temperature_reference"),
            per_range: 1.0 / (value("temperature_melt") - value("temperature_reference")),
            heating: value("taylor_quinney") / (value("density") * value("specific_heat")),
            damage: (!parameters.list("damage").is_empty()).then(|| parameters.array("damage", 0.0)),
        }
    }

    fn faults(parameters: &Parameters<'_>) -> Vec<ParameterFault> {
        let mut faults = Vec::new();
        if parameters.value("temperature_melt") <= parameters.value("temperature_reference") {
            faults.push(ParameterFault {
                kind: &PARAMETERS,
                name: "temperature_melt",
                message: "the melting point is not above the reference temperature".into(),
                help: "temperatures are absolute, in kelvin".into(),
            });
        }
        let constants = parameters.list("damage").len();
        if constants != 0 && constants != CONSTANTS {
            faults.push(ParameterFault {
                kind: &LIST_LENGTH,
                name: "damage",
                message: format!("the damage has five constants, here are {constants}"),
                help: "give D1 to D5, zeros for those that are not known; or leave `damage` out".into(),
            });
        }
        faults
    }

    fn start<L: Lane, T: SymmetricTensor<L>>(&self) -> [L; 5] {
        let zero = L::splat(0.0);
        let power = self.power.flow(zero);
        [zero, L::splat(self.temperature), zero, power.stress, power.slope]
    }

    fn renew<L: Lane, T: SymmetricTensor<L>>(&self, state: &mut [L; 5]) {
        let power = self.power.flow(state[0]);
        [state[3], state[4]] = [power.stress, power.slope];
    }

    #[inline(always)]
    fn update<L: Lane, T: SymmetricTensor<L>>(&self, kinematics: &Kinematics<L, T>, state: &mut [L; 5]) -> Response<L, T> {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let trial = Trial::new(self.bulk, self.shear, kinematics);
        let homologous = (state[1] - L::splat(self.temperature_reference)) * L::splat(self.per_range);
        let homologous = homologous.max(zero).min(one);
        let softened = if self.softening == 1.0 { homologous } else { math::pow(homologous, L::splat(self.softening)) };
        let strength = one - softened;
        let [flow, slope] = [(L::splat(self.yield_stress) + state[3]) * strength, state[4] * strength];
        let yields = (flow * flow).less(trial.square);
        let (mut deviator, mut dissipated) = (trial.deviator, zero);
        if L::any(yields) {
            let q = trial.square.sqrt();
            let (inverse, stiffness) = (one / q, L::splat(3.0 * self.shear));
            let unit = (L::splat(self.rate_reference) * kinematics.time_step).max(L::splat(1e-100));
            // At the yield stress of the rate 0; and where it flows already, about as fast as the strain
            // continues.
            let start = one / (stiffness + slope);
            let (slow, along) = ((q - flow) * start, trial.along(kinematics.strain_increment, inverse) * stiffness * start);
            let start = L::select(zero.less(along), slow.min(along), slow);
            let (step, power) = self.step(q, start, &*state, strength, unit, yields);
            dissipated = trial.work(self.shear, kinematics.strain_increment, [q, inverse], step, yields);
            deviator = trial.scaled(one - stiffness * step * inverse, yields);
            state[0] += step;
            [state[3], state[4]] = power;
            state[1] += dissipated * L::splat(self.heating);
            if let Some(constants) = self.damage {
                let end = (q - L::splat(3.0 * self.shear) * step).max(L::splat(f64::MIN_POSITIVE));
                let triaxiality = (trial.mean / end).min(L::splat(1.5));
                let failure = failure(&constants, triaxiality, math::ln((step / unit).max(one)), homologous);
                state[2] = L::select(yields, (state[2] + step / failure).min(one), state[2]);
            }
        }
        Response::rate(deviator.plus_isotropic(trial.mean), dissipated, [self.bulk, self.shear])
    }

    fn stiffness(&self) -> [f64; 2] {
        [self.bulk, self.shear]
    }
}

/// Failure strain.
#[inline(always)]
fn failure<L: Lane>(constants: &[f64; CONSTANTS], triaxiality: L, logarithm: L, homologous: L) -> L {
    let one = L::splat(1.0);
    let shape = L::splat(constants[0]) + L::splat(constants[1]) * math::exp(L::splat(constants[2]) * triaxiality);
    let factors = (one + L::splat(constants[3]) * logarithm) * (one + L::splat(constants[4]) * homologous);
    (shape * factors).max(L::splat(FAILURE_LEAST))
}

/// Of the return: trial stress q, factor of the heat on the flow stress, 1 / (ε̇_0 Δt), and half of ε̇_0 Δt.
#[derive(Clone, Copy)]
struct Return<L> {
    q: L,
    strength: L,
    per_unit: L,
    half_unit: L,
}

impl JohnsonCook {
    /// Δε_p where it `yields`, and the term B ε_p^n with its slope after it; `unit` is the increment ε̇_0 Δt.
    ///
    /// The first guess is a step of Chebyshev's method from `start` with the term B ε_p^n continued from the
    /// state by its slope and curvature, without its power; from `start` itself where that is as far as the
    /// plastic strain, over which no parabola continues a power.
    #[inline(always)]
    fn step<L: Lane>(&self, q: L, start: L, state: &[L; 5], strength: L, unit: L, yields: L::Mask) -> (L, [L; 2]) {
        let (half, one, zero) = (L::splat(0.5), L::splat(1.0), L::splat(0.0));
        let it = Return { q, strength, per_unit: one / unit, half_unit: unit * half };
        let high = q * L::splat(1.0 / (3.0 * self.shear));
        let start = start.max(zero).min(high);
        let curvature = self.power.curvature(state[0], state[4]);
        let continued = Flow {
            stress: state[3] + start * (state[4] + half * curvature * start),
            slope: state[4] + curvature * start,
            curvature,
            reach: zero,
        };
        let [value, slope, curvature, _] = self.residual(&it, start, &continued);
        let inverse = one / slope;
        let first = -(value * inverse);
        let better = start + first * (one - half * (curvature * first * inverse).max(-one).min(one));
        let better = L::select(zero.less(better), L::select(better.less(high), better, start), start);
        let better = L::select(start.less(state[0]), better, start);
        let mut newton = Newton::new(better, high, q, yields);
        let mut end = [state[3], state[4]];
        for _ in 0..LIMIT {
            let power = self.power.flow(state[0] + newton.at);
            let [value, slope, curvature, reach] = self.residual(&it, newton.at, &power);
            let live = newton.live();
            let continues = newton.next_curved(value, slope, curvature, reach);
            end = power.after(newton.moved, live, end);
            if !continues {
                break;
            }
        }
        (newton.at, end)
    }

    /// q − 3µ Δε_p − σ_y with the term B ε_p^n as given, its slope and curvature over Δε_p, and within what
    /// half of they hold.
    #[inline(always)]
    fn residual<L: Lane>(&self, it: &Return<L>, step: L, power: &Flow<L>) -> [L; 4] {
        let (stiffness, half, one, two, zero) = (L::splat(3.0 * self.shear), L::splat(0.5), L::splat(1.0), L::splat(2.0), L::splat(0.0));
        let stress = (L::splat(self.yield_stress) + power.stress) * it.strength;
        let (slope, curvature) = (power.slope * it.strength, power.curvature * it.strength);
        // The same for every lane.
        if self.rate_coefficient == 0.0 {
            return [it.q - stiffness * step - stress, -(stiffness + slope), -curvature, power.reach];
        }
        let coefficient = L::splat(self.rate_coefficient);
        let ratio = step * it.per_unit;
        let fast = one.less(ratio);
        let rate = one + coefficient * math::ln(ratio.max(one));
        let inverse = one / step;
        let rate_slope = L::select(fast, coefficient * inverse, zero);
        let rate_curvature = L::select(fast, rate_slope * inverse, zero);
        // Of the logarithm a quarter of the step; it begins with a kink, from which it keeps away.
        let reach = L::select(two.less(ratio), step * L::splat(0.25), L::select(ratio.less(half), it.half_unit, zero));
        [
            it.q - stiffness * step - stress * rate,
            -(stiffness + slope * rate + stress * rate_slope),
            stress * rate_curvature - (curvature * rate + two * slope * rate_slope),
            reach.min(power.reach),
        ]
    }
}
