//! The units of a deck, which has none of its own: lengths, masses and times as the user names them, and
//! quantities written with them.
//!
//! A quantity keeps the digits of the deck: `"7.85e-9 t/mm^3"`; the model file's reader rounds it once. Where
//! a unit has a name it goes by that: `"210000 MPa"`, not t/mm/s².

use crate::abaqus::messages::UNITS;
use crate::model_file::quantity_in_si;
use embate_solver::error::Fault;
use embate_solver::material::unit_system::UnitSystem;
use embate_solver::quantity::Dimension;

/// Units with names of their own.
const NAMED: [&str; 9] = ["Pa", "kPa", "MPa", "GPa", "N", "kN", "MN", "J", "kJ"];

/// Units of length, mass and time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Units {
    length: String,
    mass: String,
    time: String,
}

impl Default for Units {
    fn default() -> Self {
        Self { length: "m".into(), mass: "kg".into(), time: "s".into() }
    }
}

impl Units {
    /// Reads units such as `mm,t,s` or `in,lbf s^2/in,s`, in any order.
    ///
    /// # Errors
    /// What is not a unit of length, mass or time, missing or there twice.
    pub fn parse(text: &str) -> Result<Self, Fault> {
        let wrong =
            |message: String| Fault::new(&UNITS, "units", message, "name a unit of length, one of mass and one of time, such as mm,t,s");
        let mut found: [Option<&str>; 3] = [None; 3];
        // A unit of mass may be made of several: then commas stand between the three.
        let between = if text.contains(',') { ',' } else { ' ' };
        for word in text.split(between).map(str::trim).filter(|word| !word.is_empty()) {
            let (_, dimension) = quantity_in_si(&format!("1 {word}")).ok_or_else(|| wrong(format!("{word:?} is not a unit")))?;
            let kinds = [Dimension::LENGTH, Dimension { mass: 1, ..Dimension::NONE }, Dimension::TIME];
            let Some(kind) = kinds.iter().position(|kind| *kind == dimension) else {
                return Err(wrong(format!("{word:?} is no unit of length, mass or time")));
            };
            if let Some(other) = found[kind].replace(word) {
                return Err(wrong(format!("{other:?} and {word:?} are of one kind")));
            }
        }
        match found {
            [Some(length), Some(mass), Some(time)] => Ok(Self { length: length.into(), mass: mass.into(), time: time.into() }),
            _ => Err(wrong(format!("{text:?} lacks a unit"))),
        }
    }

    /// Whether they are those of a system.
    pub(super) fn are(&self, system: &UnitSystem) -> bool {
        [&self.length, &self.mass, &self.time].into_iter().zip(system.units).all(|(own, other)| {
            let in_si = |unit: &str| quantity_in_si(&format!("1 {unit}"));
            in_si(own) == in_si(other)
        })
    }

    pub(super) fn is_si(&self) -> bool {
        *self == Self::default()
    }

    pub(super) fn words(&self) -> String {
        format!("{}, {}, {}", self.length, self.mass, self.time)
    }

    /// A quantity as the model file has it.
    pub(super) fn write(&self, value: f64, dimension: Dimension) -> String {
        let unit = self.unit(dimension);
        if self.is_si() || unit.is_empty() { number(value) } else { format!("\"{} {unit}\"", number(value)) }
    }

    /// A quantity as a bare number in SI, for a key whose unit depends on the model.
    pub(super) fn write_si(&self, value: f64, dimension: Dimension) -> String {
        let written = format!("{} {}", number(value), self.unit(dimension));
        number(quantity_in_si(&written).map_or(value, |(value, _)| value))
    }

    fn unit(&self, dimension: Dimension) -> String {
        let all = [(&self.mass, dimension.mass), (&self.length, dimension.length), (&self.time, dimension.time)];
        let power = |name: &str, power: i8| if power.abs() == 1 { name.to_string() } else { format!("{name}^{}", power.abs()) };
        let above: Vec<String> = all.iter().filter(|(_, it)| *it > 0).map(|(name, it)| power(name, *it)).collect();
        let below: Vec<String> = all.iter().filter(|(_, it)| *it < 0).map(|(name, it)| format!("/{}", power(name, *it))).collect();
        let above = if above.is_empty() && !below.is_empty() { "1".to_string() } else { above.join(" ") };
        let made = above + &below.concat();
        let in_si = |unit: &str| quantity_in_si(&format!("1 {unit}"));
        let mut names = ["".to_string(), format!("/{}", self.length)].into_iter().flat_map(|per| NAMED.map(|name| name.to_string() + &per));
        names.find(|name| in_si(name).is_some_and(|its| in_si(&made) == Some(its))).unwrap_or(made)
    }
}

/// The shortest text that is this number.
pub(super) fn number(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 {
        "0".into()
    } else if (1e-4..1e7).contains(&size) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantities_keep_their_digits_and_get_the_decks_units() {
        let units = Units::parse("mm,t,s").unwrap();
        assert_eq!(units, Units::parse("s t mm").unwrap());
        assert_eq!(units.write(210_000.0, Dimension::PRESSURE), "\"210000 MPa\"");
        assert_eq!(units.write(5.0, Dimension::FORCE), "\"5 N\"");
        assert_eq!(units.write(5.0, Dimension::FORCE_PER_LENGTH), "\"5 N/mm\"");
        let [milliseconds, imperial] = ["mm,kg,ms", "in,lb,s"].map(|words| Units::parse(words).unwrap());
        assert_eq!(milliseconds.write(210.0, Dimension::PRESSURE), "\"210 GPa\"");
        assert_eq!(milliseconds.write(5.0, Dimension::FORCE), "\"5 kN\"");
        assert_eq!(imperial.write(5.0, Dimension::PRESSURE), "\"5 lb/in/s^2\"");
        assert_eq!(units.write(7.85e-9, Dimension::DENSITY), "\"7.85e-9 t/mm^3\"");
        assert_eq!(units.write(3.0, Dimension::RATE), "\"3 1/s\"");
        assert_eq!(units.write(0.3, Dimension::NONE), "0.3");
        assert_eq!(Units::default().write(2e11, Dimension::PRESSURE), "2e11");
    }

    #[test]
    fn a_unit_of_mass_may_be_made_of_others() {
        let units = Units::parse("in,lbf s^2/in,s").unwrap();
        let in_si = |text: String| quantity_in_si(text.trim_matches('"')).unwrap();
        // Steel: 7.35e-4 lbf s²/in⁴ and 30e6 psi.
        let (density, of_density) = in_si(units.write(7.35e-4, Dimension::DENSITY));
        let (pressure, of_pressure) = in_si(units.write(3e7, Dimension::PRESSURE));
        assert!((density / 7854.868 - 1.0).abs() < 1e-6 && of_density == Dimension::DENSITY, "{density}");
        assert!((pressure / 2.068_427_2e11 - 1.0).abs() < 1e-6 && of_pressure == Dimension::PRESSURE, "{pressure}");
        assert!((in_si(units.write(1.0, Dimension::FORCE)).0 / 4.448_221_615 - 1.0).abs() < 1e-9);
    }

    #[test]
    fn units_that_say_too_little_or_too_much_are_refused() {
        for text in ["mm,t", "mm,m,s", "mm,t,N", "", "mm,t,parsec"] {
            assert!(Units::parse(text).is_err(), "{text}");
        }
    }
}
