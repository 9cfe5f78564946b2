//! The gas of a cavity: an ideal gas with one state, p V = m R T, that flows in and out while its volume
//! changes.
//!
//! With the exponent γ, c_p = γ R/(γ − 1), and flows of the enthalpy c_p T,
//!
//! ```text
//! ṁ = ṁ_in − ṁ_out,   (p V^γ)˙ = V^(γ−1) γ R (ṁ_in T_in − ṁ_out T)
//! ```
//!
//! which is the energy balance (p V/(γ − 1))˙ = Σ ṁ c_p T − p V̇. What changes the volume alone is exact: p
//! V^γ stays as it is to the last digit. Flows are integrated over a step by the Runge-Kutta method of fourth
//! order, with the volume linear in time, in pieces short enough for what flows; a piece in which the
//! pressure would fall below that outside by what flows out is cut where it is met. With γ = 1 the gas keeps
//! its temperature T, T_in = T.
//!
//! An orifice of the area A with the discharge coefficient C (isentropic, from rest, choked below the
//! critical ratio):
//!
//! ```text
//! ṁ_out = C A p/√(R T) √(2γ/(γ−1) (r^(2/γ) − r^((γ+1)/γ))),   r = max(p_a/p, (2/(γ+1))^(γ/(γ−1)))
//! ```
//!
//! and r √(2 ln(1/r)), r ≥ e^(−1/2), for γ = 1. Source: Shapiro, The Dynamics and Thermodynamics of
//! Compressible Fluid Flow, vol. 1, ch. 4 (1953).

use crate::archive::{Archive, ArchiveResult, Persist, persist_each};
use crate::load::curve::Curves;
use crate::model::{Cavity, Drive};
use embate_lanes::math;

/// Part of the mass that may flow in a piece of a step, and most pieces.
const PART: f64 = 0.02;
const PIECES: f64 = 4096.0;

/// Gas that flows in.
#[derive(Clone, Debug, PartialEq)]
struct Inflow {
    /// kg/s (in 2D kg/s/m), times a curve.
    rate: f64,
    curve: Option<usize>,
    /// Temperature, K, or a curve of it.
    temperature: (f64, Option<usize>),
}

/// An opening.
#[derive(Clone, Debug, PartialEq)]
struct Vent {
    /// C A, m² (in 2D m²/m).
    area: f64,
    /// Pressure at which it opens, Pa.
    opens_at: f64,
    is_open: bool,
}

/// What a gas is and how it is.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Gas {
    exponent: f64,
    /// R, J/kg/K.
    constant: f64,
    ambient: f64,
    /// Temperature at the start, K, and volume, m³ (in 2D m³/m).
    temperature_start: f64,
    volume_start: f64,
    inflows: Vec<Inflow>,
    vents: Vec<Vent>,
    /// p (V/V₀)^γ, Pa.
    adiabat: f64,
    /// Mass, kg (in 2D kg/m).
    pub(crate) mass: f64,
    /// Volume now.
    pub(crate) volume: f64,
    /// Pressure now, absolute, Pa.
    pub(crate) pressure: f64,
    /// ∫ (p − p_a) dV by the trapezoidal rule, J (in 2D J/m).
    pub(crate) work: f64,
}

impl Persist for Gas {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        #[rustfmt::skip]
        let Self {
            exponent: _, constant: _, ambient: _, temperature_start: _, volume_start: _, inflows: _,
            vents, adiabat, mass, volume, pressure, work,
        } = self;
        persist_each!(archive; adiabat, mass, volume, pressure, work);
        vents.iter_mut().try_for_each(|vent| vent.is_open.persist(archive))
    }
}

/// Rates of flow at an instant, in the mass of the gas and in p (V/V₀)^γ.
type Rates = [f64; 2];

impl Gas {
    /// The gas of a cavity that is so large at the start, m³ (in 2D m³/m).
    pub(crate) fn new(model: &Cavity, volume: f64, curves: &Curves) -> Self {
        let curve = |name: &Option<String>| name.as_ref().and_then(|name| curves.find(name));
        let inflow = |it: &crate::model::Inflow| Inflow {
            rate: it.rate,
            curve: curve(&it.curve),
            temperature: match &it.temperature {
                Drive::Constant(temperature) => (*temperature, None),
                Drive::Curve(name) => (0.0, curves.find(name)),
            },
        };
        let vent = |it: &crate::model::Vent| Vent { area: it.discharge * it.orifice, opens_at: it.opens_at.unwrap_or(0.0), is_open: false };
        let pressure = model.pressure_at_start();
        Self {
            exponent: model.exponent,
            constant: model.gas_constant,
            ambient: model.ambient,
            temperature_start: model.temperature,
            volume_start: volume,
            inflows: model.inflow.iter().map(inflow).collect(),
            vents: model.vents.iter().map(vent).collect(),
            adiabat: pressure,
            mass: pressure * volume / (model.gas_constant * model.temperature),
            volume,
            pressure,
            work: 0.0,
        }
    }

    fn is_isothermal(&self) -> bool {
        self.exponent == 1.0
    }

    /// Pressure less that outside, Pa.
    pub(crate) fn net(&self) -> f64 {
        self.pressure - self.ambient
    }

    /// Temperature now, K.
    pub(crate) fn temperature(&self) -> f64 {
        if self.is_isothermal() { self.temperature_start } else { self.pressure * self.volume / (self.mass * self.constant) }
    }

    /// Internal energy m c_v T = p V/(γ − 1), J (in 2D J/m); 0 of a gas that keeps its temperature.
    pub(crate) fn energy(&self) -> f64 {
        if self.is_isothermal() { 0.0 } else { self.pressure * self.volume / (self.exponent - 1.0) }
    }

    /// −dp/dV of a fast change, Pa/m³: γ p/V.
    pub(crate) fn stiffness(&self) -> f64 {
        self.exponent * self.pressure / self.volume
    }

    /// Takes another volume, from one time to another, s.
    pub(crate) fn advance(&mut self, curves: &Curves, times: [f64; 2], volume: f64) {
        if times[1] > times[0] {
            for vent in &mut self.vents {
                vent.is_open |= self.pressure >= vent.opens_at;
            }
            if !self.inflows.is_empty() || self.vents.iter().any(|vent| vent.is_open) {
                self.flow(self.inflow(curves, times), times[1] - times[0], volume);
            }
        }
        let pressure = self.adiabat / self.swelling(volume);
        self.work += (0.5 * (pressure + self.pressure) - self.ambient) * (volume - self.volume);
        (self.pressure, self.volume) = (pressure, volume);
    }

    /// (V/V₀)^γ.
    fn swelling(&self, volume: f64) -> f64 {
        let ratio = volume / self.volume_start;
        if self.is_isothermal() { ratio } else { math::pow(ratio, self.exponent) }
    }

    /// What flows in on average between two times: Σ ṁ and Σ ṁ T.
    fn inflow(&self, curves: &Curves, [from, to]: [f64; 2]) -> [f64; 2] {
        let mean = |curve: &Option<usize>, left_out: f64| curve.map_or(left_out, |curve| curves.mean_of(curve, from, to));
        self.inflows.iter().fold([0.0; 2], |[mass, heat], inflow| {
            let rate = inflow.rate * mean(&inflow.curve, 1.0);
            let temperature = mean(&inflow.temperature.1, inflow.temperature.0);
            [mass + rate, heat + rate * if self.is_isothermal() { self.temperature_start } else { temperature }]
        })
    }

    /// What flows out by a state, kg/s (in 2D kg/s/m).
    fn outflow(&self, pressure: f64, temperature: f64) -> f64 {
        if pressure <= self.ambient {
            return 0.0;
        }
        let area = self.vents.iter().filter(|vent| vent.is_open).fold(0.0, |sum, vent| sum + vent.area);
        area * pressure / (self.constant * temperature).sqrt() * discharge(self.exponent, self.ambient / pressure)
    }

    /// Lets gas flow over a time, s, while the volume changes.
    fn flow(&mut self, [into, heat]: [f64; 2], time: f64, volume: f64) {
        let fraction = time * (into + self.outflow(self.pressure, self.temperature())) / self.mass;
        let pieces = (fraction / PART).ceil().clamp(1.0, PIECES);
        let (piece, slope) = (time / pieces, (volume - self.volume) / time);
        let rates = |at: f64, [mass, adiabat]: [f64; 2]| -> Rates {
            let volume = self.volume + slope * at;
            let swelling = self.swelling(volume);
            let pressure = adiabat / swelling;
            let temperature = if self.is_isothermal() { self.temperature_start } else { pressure * volume / (mass * self.constant) };
            let out = self.outflow(pressure, temperature);
            [into - out, swelling / volume * self.exponent * self.constant * (heat - out * temperature)]
        };
        let mut state = [self.mass, self.adiabat];
        for number in 0..pieces as usize {
            let at = number as f64 * piece;
            let moved = |by: f64, rates: Rates| [state[0] + by * rates[0], state[1] + by * rates[1]];
            let first = rates(at, state);
            let second = rates(at + 0.5 * piece, moved(0.5 * piece, first));
            let third = rates(at + 0.5 * piece, moved(0.5 * piece, second));
            let fourth = rates(at + piece, moved(piece, third));
            let change: Rates = std::array::from_fn(|k| piece / 6.0 * (first[k] + 2.0 * second[k] + 2.0 * third[k] + fourth[k]));
            // As without vents: they stop where the pressure inside is that outside.
            let volume = self.volume + slope * (at + piece);
            let swelling = self.swelling(volume);
            let filled = [piece * into, piece * heat * swelling / volume * self.exponent * self.constant];
            let [without, with] = [filled, change].map(|change| (state[1] + change[1]) / swelling - self.ambient);
            let part = if with < 0.0 && without > 0.0 { without / (without - with) } else { 1.0 };
            state = std::array::from_fn(|k| state[k] + filled[k] + part * (change[k] - filled[k]));
        }
        [self.mass, self.adiabat] = state;
    }
}

/// ṁ √(R T)/(A p) of an orifice with the ratio of the pressure outside to that inside, below 1.
fn discharge(exponent: f64, ratio: f64) -> f64 {
    if exponent == 1.0 {
        let ratio = ratio.max(math::exp(-0.5));
        return ratio * (2.0 * math::ln(1.0 / ratio)).max(0.0).sqrt();
    }
    let critical = math::pow(2.0 / (exponent + 1.0), exponent / (exponent - 1.0));
    let ratio = ratio.max(critical);
    let root = math::pow(ratio, 1.0 / exponent);
    (2.0 * exponent / (exponent - 1.0) * root * (root - ratio)).max(0.0).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{self, Model};

    fn rigid(cavity: &Cavity) -> Gas {
        Gas::new(cavity, 0.5, &Curves::new(&Model::default()))
    }

    fn run(gas: &mut Gas, time: f64, steps: u32, volume: impl Fn(f64) -> f64) {
        let (curves, dt) = (Curves::new(&Model::default()), time / f64::from(steps));
        for step in 0..steps {
            let [from, to] = [step, step + 1].map(|k| dt * f64::from(k));
            gas.advance(&curves, [from, to], volume(to));
        }
    }

    #[test]
    fn the_flow_is_choked_below_the_critical_ratio_and_dies_out_at_one() {
        // Shapiro, table B.2 for γ = 1.4: p*/p₀ = 0.52828, ṁ √(R T₀)/(A p₀) = 0.68473.
        assert!((discharge(1.4, 0.0) - 0.684_731).abs() < 1e-6 && discharge(1.4, 0.5) == discharge(1.4, 0.1));
        assert!(discharge(1.4, 0.53) < discharge(1.4, 0.528) && discharge(1.4, 1.0) == 0.0);
        // By the Mach number: (p₀/p)^((γ−1)/γ) = 1 + (γ−1)/2 M², ṁ = ρ a M A.
        for exponent in [1.1_f64, 1.3, 5.0 / 3.0] {
            for mach in [0.1_f64, 0.4, 0.9] {
                let heat = 1.0 + 0.5 * (exponent - 1.0) * mach * mach;
                let ratio = heat.powf(-exponent / (exponent - 1.0));
                let flow = exponent.sqrt() * mach * heat.powf(-0.5 * (exponent + 1.0) / (exponent - 1.0));
                assert!((discharge(exponent, ratio) / flow - 1.0).abs() < 1e-13, "{exponent} {mach}");
            }
        }
        // γ = 1 is the limit.
        assert!([0.2, 0.7, 0.95].iter().all(|&ratio| (discharge(1.0, ratio) / discharge(1.0 + 1e-7, ratio) - 1.0).abs() < 1e-6));
    }

    #[test]
    fn a_rigid_vessel_blows_down_as_its_closed_form_says() {
        // Choked, adiabatic: p = p₀ (1 + (γ−1)/2 Ψ C A √(R T₀)/V t)^(−2γ/(γ−1)), T = T₀ (…)^−2; the same of
        // the mass with −2/(γ−1).
        let vents = vec![model::Vent { orifice: 2e-3, discharge: 0.6, opens_at: None }];
        let cavity = Cavity { ambient: 0.0, pressure: Some(8e5), exponent: 1.3, temperature: 350.0, vents, ..Cavity::default() };
        let mut errors = Vec::new();
        for steps in [8, 1000] {
            let mut gas = rigid(&cavity);
            let mass = gas.mass;
            run(&mut gas, 0.5, steps, |_| 0.5);
            let rate = 0.15 * discharge(1.3, 0.0) * 0.6 * 2e-3 * (cavity.gas_constant * 350.0).sqrt() / 0.5;
            let base = 1.0 + rate * 0.5;
            let found = [gas.pressure / 8e5, gas.temperature() / 350.0, gas.mass / mass];
            let exact = [base.powf(-2.6 / 0.3), base.powf(-2.0), base.powf(-2.0 / 0.3)];
            errors.push((0..3).map(|k| (found[k] / exact[k] - 1.0).abs()).fold(0.0, f64::max));
            assert_eq!(gas.work, 0.0);
        }
        assert!(errors[0] < 1e-8 && errors[1] < 1e-12, "{errors:?}");
    }

    #[test]
    fn a_vessel_that_is_filled_gets_as_hot_as_its_energy_says() {
        let inflow = vec![model::Inflow { rate: 0.8, curve: None, temperature: Drive::Constant(400.0) }];
        let cavity = Cavity { ambient: 10.0, exponent: 1.4, temperature: 300.0, inflow, ..Cavity::default() };
        let mut gas = rigid(&cavity);
        let energy = gas.energy();
        run(&mut gas, 2.0, 37, |_| 0.5);
        assert!((gas.mass / (1.6 + 10.0 * 0.5 / (287.06 * 300.0)) - 1.0).abs() < 1e-13, "{}", gas.mass);
        let heat = 1.6 * 1.4 / 0.4 * 287.06 * 400.0;
        assert!(((gas.energy() - energy) / heat - 1.0).abs() < 1e-13);
        // From next to nothing: γ T_in.
        assert!((gas.temperature() / (1.4 * 400.0) - 1.0).abs() < 2e-5, "{}", gas.temperature());
    }

    #[test]
    fn a_closed_gas_keeps_its_adiabat_to_the_last_digits_and_works_by_its_energy() {
        let cavity = Cavity { ambient: 2e4, pressure: Some(1e5), exponent: 5.0 / 3.0, ..Cavity::default() };
        let mut gas = rigid(&cavity);
        let (energy, volume) = (gas.energy(), |t: f64| 0.5 - 0.2 * (7.0 * t).sin());
        let mut worst: f64 = 0.0;
        let (curves, dt) = (Curves::new(&Model::default()), 1e-3);
        for step in 0..1000 {
            gas.advance(&curves, [dt * f64::from(step), dt * f64::from(step + 1)], volume(dt * f64::from(step + 1)));
            worst = worst.max((gas.pressure * (gas.volume / 0.5).powf(5.0 / 3.0) / 1e5 - 1.0).abs());
        }
        let work = energy - gas.energy() - 2e4 * (gas.volume - 0.5);
        assert!(worst < 3e-15 && (gas.work / work - 1.0).abs() < 1e-5, "{worst} {} {work}", gas.work);
    }

    #[test]
    fn volume_and_flows_together_balance_the_energy() {
        // Isothermal: p V = p₀ V₀ (m/m₀). Adiabatic: T from the balance of the energy.
        let inflow = vec![model::Inflow { rate: 0.3, curve: None, temperature: Drive::Constant(500.0) }];
        for exponent in [1.0, 1.4] {
            let cavity = Cavity { ambient: 1e5, pressure: Some(1.5e5), exponent, inflow: inflow.clone(), ..Cavity::default() };
            let mut gas = rigid(&cavity);
            let (mass, energy) = (gas.mass, gas.energy());
            run(&mut gas, 1.0, 4000, |t| 0.5 + 0.3 * t);
            assert!((gas.mass / (mass + 0.3) - 1.0).abs() < 1e-12);
            if exponent == 1.0 {
                assert!((gas.pressure * gas.volume / (1.5e5 * 0.5) / (gas.mass / mass) - 1.0).abs() < 1e-12);
                assert_eq!(gas.temperature(), 293.15);
            } else {
                let work = gas.work + 1e5 * 0.3;
                let heat = 0.3 * 1.4 / 0.4 * 287.06 * 500.0;
                assert!(((gas.energy() - energy) / (heat - work) - 1.0).abs() < 1e-7);
            }
        }
    }

    #[test]
    fn a_vent_opens_for_good_and_leaves_the_pressure_outside() {
        let vents = vec![model::Vent { orifice: 5e-2, discharge: 1.0, opens_at: Some(1.5e5) }];
        let mut gas = rigid(&Cavity { ambient: 1e5, vents, ..Cavity::default() });
        let mass = gas.mass;
        run(&mut gas, 0.01, 10, |_| 0.49);
        assert_eq!(gas.mass, mass);
        run(&mut gas, 0.01, 10, |_| 0.3);
        run(&mut gas, 1.0, 1000, |_| 0.3);
        assert!(gas.mass < 0.9 * mass && (gas.pressure / 1e5 - 1.0).abs() < 1e-12, "{} {}", gas.mass, gas.pressure);
    }
}
