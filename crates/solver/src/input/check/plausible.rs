//! Numbers of materials that no material has: of another system of units, most often, or typed without a
//! unit.
//!
//! From density and stiffness as the law and its equation of state say them, so that no law needs a line
//! here. Limits are far from what there is: a warning says that a number is wrong.

use super::warnings::parameters;
use crate::angle::cos_sin;
use crate::contact::messages::ROUGH;
use crate::error::Warning;
use crate::load::messages::SPEED;
use crate::material::messages::{IMPLAUSIBLE, OTHER_UNITS};
use crate::material::unit_system::{SYSTEMS, UnitSystem, is_stiff, is_usual, speed};
use crate::material::{self, DENSITY, points, young_and_poisson};
use crate::model::{Drive, Material, Model, Part, Shape};
use crate::quantity::{Dimension, Parameter};
use crate::vector::length;

/// Densities from a rare gas to more than osmium, kg/m³.
const DENSITIES: [f64; 2] = [1e-2, 25_000.0];
/// Young's moduli from the softest gel, a bit below 1 kPa, to more than diamond, Pa.
const MODULI: [f64; 2] = [999.0, 2e12];
/// Faster than the waves of diamond, which has 17.3 km/s along a bar, m/s.
const FASTEST: f64 = 20_000.0;
/// Slower than √(E/ρ) of anything heavy, m/s; and from what density on, kg/m³: metals and stones.
const SLOWEST: f64 = 20.0;
const HEAVY: f64 = 2500.0;
/// Density from which on a number is thought to be one of a solid, kg/m³: balsa.
const LIGHT: f64 = 150.0;
/// Yield stresses over Young's modulus: below the one nothing but a fluid flows, above the other no lattice
/// holds.
const FLOWS: [f64; 2] = [1e-7, 0.2];

/// Other units in which densities and moduli are typed, and what they are in SI.
const DENSITY_UNITS: [(&str, f64); 4] = [("g/cm^3", 1e3), ("g/mm^3", 1e6), ("kg/mm^3", 1e9), ("t/mm^3", 1e12)];
const MODULUS_UNITS: [(&str, f64); 3] = [("kPa", 1e3), ("MPa", 1e6), ("GPa", 1e9)];

/// Faster than what guns shoot by ten times, m/s.
const FAST: f64 = 2e4;

/// Coefficients of friction that are likelier angles in degrees: more than that of any rubber, less than a
/// right angle.
const ANGLES: [f64; 2] = [3.0, 90.0];

/// What is looked at.
struct Facts<'a> {
    name: &'a str,
    it: &'a Material,
    density: f64,
    /// Young's modulus of solids, the bulk modulus of fluids, Pa.
    modulus: f64,
    is_fluid: bool,
    /// Speed √(E/ρ) of waves along a bar, of fluids √(K/ρ), m/s: that of waves in all directions has no limit
    /// where volume hardly changes.
    wave: f64,
    /// The parameter that says the modulus.
    key: &'static str,
}

/// What is wrong.
struct Wrong {
    key: &'static str,
    message: String,
    consequence: &'static str,
    help: String,
}

/// What follows from a wrong density or modulus.
const OTHER_BODY: &str = "no material is like this: masses, stiffnesses and the time step are those of something else";

/// A warning for each material with such a number, or one for all that are in another system of units.
pub(super) fn warnings(model: &Model) -> Vec<Warning> {
    let used = |name: &String| model.parts.iter().any(|part| part.materials().any(|own| own == name) || part.material == *name);
    let all: Vec<Facts<'_>> = model.materials.iter().filter(|(name, _)| used(name)).filter_map(|(name, it)| Facts::of(name, it)).collect();
    let wrong: Vec<(&Facts<'_>, Wrong)> = all.iter().filter_map(|facts| Some((facts, facts.wrong()?))).collect();
    let numbers: Vec<[f64; 2]> = wrong.iter().map(|(facts, _)| [facts.density, facts.modulus]).collect();
    // One number that is wrong is likelier than that all are.
    let may_be_others = wrong.iter().all(|(facts, _)| !facts.is_fluid && !facts.is_one_number());
    if let (Some((first, _)), Some(system)) = (wrong.first(), UnitSystem::of(&numbers).filter(|system| **system != SYSTEMS[0]))
        && may_be_others
    {
        return vec![first.of_other_units(system, &wrong, model)];
    }
    let one = |(facts, Wrong { key, message, consequence, help }): (&Facts<'_>, Wrong)| Warning {
        kind: &IMPLAUSIBLE,
        path: format!("material.{}.{key}", facts.name),
        message,
        consequence: consequence.into(),
        help,
    };
    wrong.into_iter().map(one).collect()
}

/// A warning for each velocity that solids do not have, of models whose materials have no equation of state.
pub(super) fn speeds(model: &Model) -> Vec<Warning> {
    if model.materials.values().any(|it| !it.eos.is_empty()) {
        return Vec::new();
    }
    let constant = |drive: &Option<Drive>| if let Some(Drive::Constant(speed)) = drive { *speed } else { 0.0 };
    let of = |drives: &[Option<Drive>; 3]| drives.each_ref().map(constant);
    let initial = model.parts.iter().enumerate().map(|(index, part)| (format!("part[{index}].velocity"), part.velocity));
    let rigid = model
        .parts
        .iter()
        .enumerate()
        .filter_map(|(index, part)| Some((format!("part[{index}].rigid"), of(&part.rigid.as_ref()?.velocity))));
    let led = model.constraints.iter().enumerate().map(|(index, it)| (format!("constraint[{index}].velocity"), of(&it.velocity)));
    let obstacles = model.obstacles.iter().enumerate().map(|(index, it)| (format!("obstacle[{index}].motion"), of(&it.motion.velocity)));
    let all = initial.chain(rigid).chain(led).chain(obstacles).map(|(path, velocity)| (path, length(velocity)));
    let warning = |(path, speed): (String, f64)| Warning {
        kind: &SPEED,
        path,
        message: format!("{speed:.3e} m/s is faster than any body"),
        consequence: "no solid bears what it meets at such a speed: elements fold, and the run ends".into(),
        help: "look at the unit: a number without one is in m/s; of what is meant so fast, give the material an `eos`".into(),
    };
    all.filter(|(_, speed)| *speed > FAST).map(warning).collect()
}

/// A warning for each coefficient of friction that looks like an angle in degrees.
pub(super) fn frictions(model: &Model) -> Vec<Warning> {
    let contacts = model.contacts.iter().enumerate().map(|(index, it)| (format!("contact[{index}].friction"), it.interface.friction));
    let obstacles = model.obstacles.iter().enumerate().map(|(index, it)| (format!("obstacle[{index}].friction"), it.interface.friction));
    let all = contacts.chain(obstacles).filter_map(|(path, friction)| Some((path, friction?.coefficient)));
    let [low, high] = ANGLES;
    let tangent = |degrees: f64| {
        let [cos, sin] = cos_sin(degrees.to_radians());
        sin / cos
    };
    let warning = |(path, degrees): (String, f64)| Warning {
        kind: &ROUGH,
        path,
        message: format!("a coefficient of friction of {} is that of no surfaces", shown(degrees)),
        consequence: "what is pressed together does not slide".into(),
        help: format!(
            "if an angle of {} degrees was meant, write its tangent, {:.4}; what shall not slide can be `tied`",
            shown(degrees),
            tangent(degrees)
        ),
    };
    all.filter(|(_, coefficient)| *coefficient > low && *coefficient < high).map(warning).collect()
}

/// Whether a density (kg/m³) is a round one, as of a model without units, or of one that is heavy for the
/// sake of its steps: a power of ten, but for that of water in any unit. Of such a material only the speed of
/// its waves can be wrong: a density of 1 beside the modulus of steel.
fn is_chosen(density: f64) -> bool {
    let power = density.log10().round();
    let is_power = (density / 10f64.powf(power) - 1.0).abs() < 1e-12;
    is_power && power > -6.0 && power != 3.0
}

impl<'a> Facts<'a> {
    fn of(name: &'a str, it: &'a Material) -> Option<Self> {
        let kind = material::LAWS.iter().find(|kind| kind.name == it.law)?;
        let density = parameters(it)?.value(DENSITY.name);
        let [bulk, shear] = points::plane(it)?.stiffness();
        let is_fluid = shear <= 0.0;
        let own = material::eos::kind(&it.eos).map_or(&[][..], |own| own.parameters);
        let is_modulus = |parameter: &&Parameter| {
            let is_given = it.parameters.contains_key(parameter.name) || it.lists.contains_key(parameter.name);
            parameter.dimension == Dimension::PRESSURE && is_given
        };
        let key = kind.parameters.iter().chain(own).find(is_modulus).map_or(DENSITY.name, |parameter| parameter.name);
        let modulus = if is_fluid { bulk } else { young_and_poisson([bulk, shear])[0] };
        let wave = speed(density, modulus);
        (density.is_finite() && modulus.is_finite() && wave.is_finite()).then_some(Self { name, it, density, modulus, is_fluid, wave, key })
    }

    /// Whether it is a usual stiff solid with another unit of its density alone, or of its modulus.
    fn is_one_number(&self) -> bool {
        DENSITY_UNITS.iter().any(|(_, factor)| is_stiff(self.density * factor, self.modulus))
            || MODULUS_UNITS.iter().any(|(_, factor)| is_stiff(self.density, self.modulus * factor))
    }

    fn wrong(&self) -> Option<Wrong> {
        if is_chosen(self.density) {
            return self.wrong_speed();
        }
        self.wrong_density().or_else(|| self.wrong_modulus()).or_else(|| self.wrong_speed()).or_else(|| self.wrong_yield())
    }

    fn wrong_density(&self) -> Option<Wrong> {
        let [low, high] = DENSITIES;
        let rho = self.density;
        if (low..=high).contains(&rho) {
            return None;
        }
        let message = if rho < low {
            format!("a density of {} kg/m^3 is less than that of any gas", shown(rho))
        } else {
            format!("a density of {} kg/m^3 is more than that of any metal", shown(rho))
        };
        Some(Wrong { key: DENSITY.name, message, consequence: OTHER_BODY, help: self.other_density() })
    }

    /// The units of density in which the number would be one of a material.
    fn other_density(&self) -> String {
        let rho = self.density;
        if rho > DENSITIES[1] {
            return "look at its unit and its power of ten: steel has 7850 kg/m^3, which is 7.85 g/cm^3".into();
        }
        // A modulus that is wrong itself says nothing.
        let modulus = self.modulus.clamp(1e7, 5e11);
        let fits = |factor: f64| is_usual(rho * factor, modulus) && rho * factor > LIGHT;
        suggested(rho, DENSITY_UNITS.iter().filter(|(_, factor)| fits(*factor)).map(|(unit, _)| *unit), "7850 kg/m^3")
    }

    fn wrong_modulus(&self) -> Option<Wrong> {
        let (modulus, [low, high]) = (self.modulus, MODULI);
        let what = if self.is_fluid { "a bulk modulus" } else { "a Young's modulus" };
        let message = if modulus > high {
            format!("{what} of {} Pa is more than that of diamond", shown(modulus))
        } else if self.is_fluid {
            return None;
        } else if modulus < low {
            format!("{what} of {} Pa is less than that of any gel", shown(modulus))
        } else if self.density > HEAVY && self.wave < SLOWEST {
            format!(
                "{what} of {} Pa at a density of {} kg/m^3 is as soft as a gel and as heavy as stone",
                shown(modulus),
                shown(self.density)
            )
        } else {
            return None;
        };
        let help = if modulus > high {
            "look at its unit and its power of ten: steel has 210 GPa, which is 2.1e11 Pa".into()
        } else {
            let is = |stiff: bool, factor: f64| {
                if stiff { is_stiff(self.density, modulus * factor) } else { is_usual(self.density, modulus * factor) }
            };
            let fitting = |stiff: bool| MODULUS_UNITS.iter().filter(move |(_, factor)| is(stiff, *factor)).map(|(unit, _)| *unit);
            let value = self.it.parameters.get(self.key).copied().unwrap_or(modulus);
            // What is heavy is stiff; else both may be.
            let only_stiff = self.density > HEAVY && fitting(true).next().is_some();
            suggested(value, fitting(only_stiff), "210 GPa")
        };
        Some(Wrong { key: self.key, message, consequence: OTHER_BODY, help })
    }

    fn wrong_speed(&self) -> Option<Wrong> {
        if self.wave <= FASTEST {
            return None;
        }
        let message = format!(
            "a density of {} kg/m^3 with a modulus of {} Pa makes waves of {} m/s, faster than those of diamond",
            shown(self.density),
            shown(self.modulus),
            shown(self.wave)
        );
        Some(Wrong { key: DENSITY.name, message, consequence: OTHER_BODY, help: self.other_density() })
    }

    fn wrong_yield(&self) -> Option<Wrong> {
        let (key, flow) = material::first_flow(&self.it.law, &parameters(self.it)?)?;
        let (ratio, [low, high]) = (flow / self.modulus, FLOWS);
        let message = if self.is_fluid || !flow.is_finite() || flow == 0.0 {
            return None;
        } else if ratio > high {
            let modulus = shown(self.modulus);
            format!("it flows at {} Pa, {ratio:.3} of its Young's modulus of {modulus} Pa: nothing bears so much", shown(flow))
        } else if ratio < low {
            let modulus = shown(self.modulus);
            format!("it flows at {} Pa, {ratio:.1e} of its Young's modulus of {modulus} Pa: nothing solid flows so soon", shown(flow))
        } else {
            return None;
        };
        let is = |factor: f64| (1e-4..0.05).contains(&(ratio * factor));
        let fitting = MODULUS_UNITS.iter().filter(|(_, factor)| is(*factor)).map(|(unit, _)| *unit);
        let help = if ratio > high {
            "look at the units of both: steel has 210 GPa and flows at some 300 MPa".into()
        } else {
            suggested(self.it.parameters.get(key).copied().unwrap_or(flow), fitting, "300 MPa")
        };
        let consequence = if ratio > high { "it never flows" } else { "it flows under its own weight, as a fluid" };
        Some(Wrong { key, message, consequence, help })
    }

    /// All materials are such as there are in another system.
    fn of_other_units(&self, system: &UnitSystem, wrong: &[(&Self, Wrong)], model: &Model) -> Warning {
        let [length, mass, time] = system.units;
        let [rho, modulus] = system.in_si([self.density, self.modulus]);
        let others = match wrong.len() {
            1 => String::new(),
            2 => format!(" (and those of `{}`)", wrong[1].0.name),
            more => format!(" (and those of {} more materials)", more - 1),
        };
        let value = |key: &str| self.it.parameters.get(key).map_or("...".to_string(), |value| written(*value));
        let mut help = format!(
            "write the units: `density = \"{} {}\"`, `{} = \"{} {}\"`, lengths in \"{length}\", times in \"{time}\", velocities in \"{}\"",
            value(DENSITY.name),
            system.density,
            self.key,
            value(self.key),
            system.pressure,
            system.velocity
        );
        let is_file = |part: &Part| matches!(part.shape, Shape::Group { .. });
        if model.parts.iter().any(is_file) {
            help.push_str(&format!(", and `scale = \"1 {length}\"` in `mesh`"));
        }
        Warning {
            kind: &OTHER_UNITS,
            path: format!("material.{}.{}", self.name, DENSITY.name),
            message: format!(
                "a density of {} kg/m^3 with a modulus of {} Pa is that of no material{others}, but in {length}, {mass}, {time} it is {} kg/m^3 \
                 and {} Pa",
                shown(self.density),
                shown(self.modulus),
                shown(rho),
                shown(modulus)
            ),
            consequence: "numbers without a unit are in SI (m, kg, s, Pa), so all of these are wrong by powers of ten".into(),
            help,
        }
    }
}

/// What to do about a number that fits if it is in one of these units.
fn suggested<'u>(value: f64, units: impl Iterator<Item = &'u str>, usual: &str) -> String {
    let texts: Vec<String> = units.map(|unit| format!("\"{} {unit}\"", written(value))).collect();
    match texts.len() {
        0 => format!("a number without a unit is in SI: write it with its unit, such as \"{usual}\""),
        _ => format!("a number without a unit is in SI: if {} was meant, write that", texts.join(" or ")),
    }
}

/// A number as people write it.
fn written(value: f64) -> String {
    if (1e-3..1e7).contains(&value.abs()) { format!("{value}") } else { format!("{value:e}") }
}

/// Four digits of a number.
fn shown(value: f64) -> String {
    written(format!("{value:.3e}").parse().unwrap_or(value))
}
