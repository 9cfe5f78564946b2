//! Systems of units in which other programs keep their numbers, and which of them a material is in.
//!
//! Density and modulus say it together: what is steel in one system is a material that is not there in the
//! others, because densities go with M/L³ and squares of wave speeds with L²/T².

/// Units of length, mass and time, and what they make.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnitSystem {
    /// Units of length, mass and time.
    pub units: [&'static str; 3],
    /// Unit of density as a model file has it.
    pub density: &'static str,
    /// Unit of pressure.
    pub pressure: &'static str,
    /// Unit of velocity.
    pub velocity: &'static str,
    /// The unit of density in kg/m³.
    pub density_in_si: f64,
    /// The unit of pressure in Pa.
    pub pressure_in_si: f64,
}

const fn system(units: [&'static str; 3], names: [&'static str; 3], in_si: [f64; 2]) -> UnitSystem {
    let [density, pressure, velocity] = names;
    UnitSystem { units, density, pressure, velocity, density_in_si: in_si[0], pressure_in_si: in_si[1] }
}

/// SI first.
pub const SYSTEMS: &[UnitSystem] = &[
    system(["m", "kg", "s"], ["kg/m^3", "Pa", "m/s"], [1.0, 1.0]),
    system(["mm", "t", "s"], ["t/mm^3", "MPa", "mm/s"], [1e12, 1e6]),
    system(["mm", "kg", "ms"], ["kg/mm^3", "GPa", "mm/ms"], [1e9, 1e9]),
    system(["mm", "g", "ms"], ["g/mm^3", "MPa", "mm/ms"], [1e6, 1e6]),
    system(["mm", "kg", "s"], ["kg/mm^3", "kPa", "mm/s"], [1e9, 1e3]),
    system(["cm", "g", "us"], ["g/cm^3", "Mbar", "cm/us"], [1e3, 1e11]),
    system(["cm", "g", "s"], ["g/cm^3", "dPa", "cm/s"], [1e3, 0.1]),
    system(["in", "lbf s^2/in", "s"], ["lbf s^2/in^4", "psi", "in/s"], [1.068_689_5e7, 6_894.757_3]),
    system(["ft", "lbf s^2/ft", "s"], ["lbf s^2/ft^4", "lbf/ft^2", "ft/s"], [515.378_82, 47.880_259]),
];

/// Densities (kg/m³), moduli (Pa) and wave speeds (m/s) of what things are made of: from foam to tungsten,
/// from soft rubber to diamond.
const DENSITIES: [f64; 2] = [20.0, 23_000.0];
const MODULI: [f64; 2] = [1e4, 1.5e12];
const SPEEDS: [f64; 2] = [20.0, 20_000.0];
/// The same of metals, plastics, ceramics and wood.
const STIFF: [f64; 2] = [350.0, 23_000.0];
const STIFF_SPEEDS: [f64; 2] = [500.0, 15_000.0];

fn is_in(value: f64, [low, high]: [f64; 2]) -> bool {
    (low..=high).contains(&value)
}

/// √(M/ρ), m/s, of a modulus M (Pa) and a density ρ (kg/m³).
#[must_use]
pub fn speed(density: f64, modulus: f64) -> f64 {
    (modulus / density).sqrt()
}

/// Whether something may be so: density, kg/m³, and modulus, Pa.
#[must_use]
pub fn is_usual(density: f64, modulus: f64) -> bool {
    is_in(density, DENSITIES) && is_in(modulus, MODULI) && is_in(speed(density, modulus), SPEEDS)
}

/// Whether a stiff solid may be so.
#[must_use]
pub fn is_stiff(density: f64, modulus: f64) -> bool {
    is_usual(density, modulus) && is_in(density, STIFF) && is_in(speed(density, modulus), STIFF_SPEEDS)
}

impl UnitSystem {
    /// Density and modulus in kg/m³ and Pa, from numbers in this system.
    #[must_use]
    pub fn in_si(&self, [density, modulus]: [f64; 2]) -> [f64; 2] {
        [density * self.density_in_si, modulus * self.pressure_in_si]
    }

    /// Whether something with this density and modulus in the system may be so.
    #[must_use]
    pub fn is_usual(&self, numbers: [f64; 2]) -> bool {
        let [density, modulus] = self.in_si(numbers);
        is_usual(density, modulus)
    }

    /// Its units by commas, as `embate import --units` takes them.
    #[must_use]
    pub fn words(&self) -> String {
        self.units.join(",")
    }

    /// The one system in which materials, each a density and a modulus as they were written, are such as
    /// there are; `None` where there is none, or several that fit alike.
    #[must_use]
    pub fn of(materials: &[[f64; 2]]) -> Option<&'static Self> {
        let fits = |system: &UnitSystem, is_so: fn(f64, f64) -> bool| {
            let some_so = materials.iter().map(|it| system.in_si(*it)).any(|[density, modulus]| is_so(density, modulus));
            some_so && materials.iter().all(|it| system.is_usual(*it))
        };
        let only = |is_so: fn(f64, f64) -> bool| {
            let mut fitting = SYSTEMS.iter().filter(|system| fits(system, is_so));
            fitting.next().filter(|_| fitting.next().is_none())
        };
        only(is_stiff).or_else(|| only(is_usual))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steel_is_known_in_each_system() {
        // Steel of 7850 kg/m³ and 210 GPa as handbooks of each system have it.
        let all = [
            ("m,kg,s", [7850.0, 2.1e11]),
            ("mm,t,s", [7.85e-9, 2.1e5]),
            ("mm,kg,ms", [7.85e-6, 210.0]),
            ("mm,g,ms", [7.85e-3, 2.1e5]),
            ("mm,kg,s", [7.85e-6, 2.1e8]),
            ("cm,g,us", [7.85, 2.1]),
            ("cm,g,s", [7.85, 2.1e12]),
            ("in,lbf s^2/in,s", [7.35e-4, 30.5e6]),
            ("ft,lbf s^2/ft,s", [15.2, 4.39e9]),
        ];
        assert_eq!(all.len(), SYSTEMS.len());
        for (words, numbers) in all {
            assert_eq!(UnitSystem::of(&[numbers]).map(UnitSystem::words).as_deref(), Some(words), "{numbers:?}");
        }
    }

    #[test]
    fn aluminium_plastics_and_rubber_with_steel_are_known() {
        for (words, numbers) in [
            ("mm,t,s", [2.7e-9, 7e4]),
            ("mm,kg,ms", [2.7e-6, 70.0]),
            ("in,lbf s^2/in,s", [2.59e-4, 1e7]),
            ("mm,t,s", [1.2e-9, 2400.0]),
            ("m,kg,s", [1200.0, 2.4e9]),
        ] {
            assert_eq!(UnitSystem::of(&[numbers]).map(UnitSystem::words).as_deref(), Some(words), "{numbers:?}");
        }
        assert_eq!(UnitSystem::of(&[[7.85e-9, 2.1e5], [1.1e-9, 5.0]]).map(UnitSystem::words).as_deref(), Some("mm,t,s"));
    }

    #[test]
    fn of_what_fits_nowhere_nothing_is_said() {
        assert_eq!(UnitSystem::of(&[]), None);
        assert_eq!(UnitSystem::of(&[[7850.0, 210.0]]), None);
        assert_eq!(UnitSystem::of(&[[7.85e-9, 2.1e5], [7850.0, 2.1e11]]), None);
    }

    #[test]
    fn units_of_density_and_pressure_follow_from_those_of_length_mass_and_time() {
        let (inch, foot, pound): (f64, f64, f64) = (0.0254, 0.3048, 4.448_221_615_260_5);
        for system in SYSTEMS {
            let length = match system.units[0] {
                "mm" => 1e-3,
                "cm" => 1e-2,
                "in" => inch,
                "ft" => foot,
                _ => 1.0,
            };
            let mass = match system.units[1] {
                "t" => 1e3,
                "g" => 1e-3,
                "lbf s^2/in" => pound / inch,
                "lbf s^2/ft" => pound / foot,
                _ => 1.0,
            };
            let time: f64 = match system.units[2] {
                "ms" => 1e-3,
                "us" => 1e-6,
                _ => 1.0,
            };
            let is_near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-7;
            assert!(is_near(system.density_in_si, mass / length.powi(3)), "{system:?}");
            assert!(is_near(system.pressure_in_si, mass / (length * time * time)), "{system:?}");
        }
    }
}
