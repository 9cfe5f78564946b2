//! Numbers with units: `"210 GPa"`, `"7.85 g/cm^3"`, `"-50 m/s"` become SI values with a dimension check.
//!
//! A text comes from the reader, the value goes back to it. Units are powers of ten and ratios of whole
//! numbers, applied to the decimal digits before the only rounding: `"94 mm"` is the same `f64` as 0.094. A
//! unit text is read from left to right; a space, `*` or `·` multiplies, `/` divides by the one unit that
//! follows it.

use super::decimal::Decimal;
use embate_solver::quantity::Dimension;
use embate_solver::vocabulary::nearest;

/// What is wrong with a text, and what to do.
pub(super) type Wrong = (String, String);

/// What a number is to be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wanted<'a> {
    /// Key, for messages.
    pub name: &'a str,
    /// Dimensions that are allowed; the first is the usual one. None: any.
    pub dimensions: &'a [Dimension],
    /// Whether degrees and radians are meant.
    pub angle: bool,
}

/// A unit or a product of units: `value = number · numerator / denominator · 10^ten`, and degrees if
/// `degrees` is one.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Unit {
    /// Exponents of kg, m, s, K, B.
    powers: [i32; 5],
    numerator: u128,
    denominator: u128,
    ten: i32,
    degrees: i32,
    /// Number of `rad`.
    radians: i32,
}

const ONE: Unit = Unit { powers: [0; 5], numerator: 1, denominator: 1, ten: 0, degrees: 0, radians: 0 };

/// A unit of the table: name, exponents of kg, m, s, K, B, numerator, power of ten, and the prefixes that it
/// takes.
struct Entry(&'static str, [i32; 5], u128, i32, &'static [&'static str]);

const ALL: &[&str] = &["f", "p", "n", "u", "µ", "μ", "m", "c", "d", "da", "h", "k", "M", "G", "T", "P"];
const SMALL: &[&str] = &["f", "p", "n", "u", "µ", "μ", "m"];
const LARGE: &[&str] = &["k", "M"];
const VOLUMES: &[&str] = &["u", "µ", "μ", "m", "c", "d", "h"];

/// Every unit. Inch, foot, mile and pound are exact by definition (1959); the pound-force is the pound times
/// 9.80665 m/s², the kilogram-force the kilogram times that. `cc` is a cubic centimetre.
const TABLE: &[Entry] = &[
    Entry("m", [0, 1, 0, 0, 0], 1, 0, ALL),
    Entry("g", [1, 0, 0, 0, 0], 1, -3, ALL),
    Entry("s", [0, 0, 1, 0, 0], 1, 0, ALL),
    Entry("min", [0, 0, 1, 0, 0], 60, 0, &[]),
    Entry("h", [0, 0, 1, 0, 0], 3600, 0, &[]),
    Entry("N", [1, 1, -2, 0, 0], 1, 0, ALL),
    Entry("Pa", [1, -1, -2, 0, 0], 1, 0, ALL),
    Entry("bar", [1, -1, -2, 0, 0], 1, 5, &["m", "k", "M"]),
    Entry("J", [1, 2, -2, 0, 0], 1, 0, ALL),
    Entry("W", [1, 2, -3, 0, 0], 1, 0, ALL),
    Entry("Hz", [0, 0, -1, 0, 0], 1, 0, ALL),
    Entry("K", [0, 0, 0, 1, 0], 1, 0, SMALL),
    Entry("t", [1, 0, 0, 0, 0], 1, 3, LARGE),
    Entry("L", [0, 3, 0, 0, 0], 1, -3, VOLUMES),
    Entry("l", [0, 3, 0, 0, 0], 1, -3, VOLUMES),
    Entry("cc", [0, 3, 0, 0, 0], 1, -6, &[]),
    Entry("in", [0, 1, 0, 0, 0], 254, -4, &[]),
    Entry("ft", [0, 1, 0, 0, 0], 3048, -4, &[]),
    Entry("lb", [1, 0, 0, 0, 0], 45_359_237, -8, &[]),
    Entry("lbf", [1, 1, -2, 0, 0], 44_482_216_152_605, -13, &[]),
    Entry("kgf", [1, 1, -2, 0, 0], 980_665, -5, &[]),
    Entry("psi", [1, -1, -2, 0, 0], 44_482_216_152_605, -13, &[]), // divided by in² in `lookup`
    Entry("ksi", [1, -1, -2, 0, 0], 44_482_216_152_605, -10, &[]),
    Entry("atm", [1, -1, -2, 0, 0], 101_325, 0, &[]),
    Entry("mph", [0, 1, -1, 0, 0], 44_704, -5, &[]),
    Entry("rpm", [0, 0, -1, 0, 0], 6, 0, &[]), // degrees in `plain`: 360 deg in 60 s
    Entry("rad", [0, 0, 0, 0, 0], 1, 0, SMALL),
    Entry("deg", [0, 0, 0, 0, 0], 1, 0, &[]),
    Entry("B", [0, 0, 0, 0, 1], 1, 0, &["k", "M", "G", "T"]),
    Entry("MiB", [0, 0, 0, 0, 1], 1 << 20, 0, &[]),
    Entry("GiB", [0, 0, 0, 0, 1], 1 << 30, 0, &[]),
    Entry("%", [0, 0, 0, 0, 0], 1, -2, &[]),
];

/// Words that people write for a unit, with what they mean.
const MEANT: &[(&str, &str)] = &[
    ("sec", "s"),
    ("second", "s"),
    ("seconds", "s"),
    ("minute", "min"),
    ("hour", "h"),
    ("hr", "h"),
    ("meter", "m"),
    ("metre", "m"),
    ("meters", "m"),
    ("metres", "m"),
    ("inch", "in"),
    ("inches", "in"),
    ("foot", "ft"),
    ("feet", "ft"),
    ("lbs", "lb"),
    ("gram", "g"),
    ("kgs", "kg"),
    ("ton", "t"),
    ("tonne", "t"),
    ("newton", "N"),
    ("pascal", "Pa"),
    ("joule", "J"),
    ("degree", "deg"),
    ("degrees", "deg"),
    ("°", "deg"),
    ("radian", "rad"),
    ("radians", "rad"),
    ("percent", "%"),
    ("ccm", "cc"),
    ("cbm", "m^3"),
    ("liter", "L"),
    ("litre", "L"),
    ("liters", "L"),
    ("litres", "L"),
    ("kp", "kgf"),
    ("mps", "m/s"),
    ("kph", "km/h"),
    ("kmh", "km/h"),
];

/// Numerators and denominators beyond this are refused: ten times more still fits into the arithmetic of
/// `decimal.rs`.
const FACTOR_MAX: u128 = 10u128.pow(36);

fn prefix_power(prefix: &str) -> i32 {
    match prefix {
        "f" => -15,
        "p" => -12,
        "n" => -9,
        "u" | "µ" | "μ" => -6,
        "m" => -3,
        "c" => -2,
        "d" => -1,
        "da" => 1,
        "h" => 2,
        "k" => 3,
        "M" => 6,
        "G" => 9,
        "T" => 12,
        "P" => 15,
        _ => 0,
    }
}

fn plain(entry: &Entry) -> Unit {
    let square_inch = matches!(entry.0, "psi" | "ksi");
    Unit {
        powers: entry.1,
        numerator: entry.2,
        denominator: if square_inch { 254 * 254 } else { 1 },
        ten: entry.3 + if square_inch { 8 } else { 0 },
        degrees: i32::from(matches!(entry.0, "deg" | "rpm")),
        radians: i32::from(entry.0 == "rad"),
    }
}

/// The unit of this name, prefix included.
fn lookup(word: &str) -> Option<Unit> {
    if let Some(entry) = TABLE.iter().find(|entry| entry.0 == word) {
        return Some(plain(entry));
    }
    TABLE.iter().find_map(|entry| {
        let prefix = word.strip_suffix(entry.0)?;
        entry.4.contains(&prefix).then(|| Unit { ten: entry.3 + prefix_power(prefix), ..plain(entry) })
    })
}

fn divisor(mut a: u128, mut b: u128) -> u128 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a.max(1)
}

impl Unit {
    /// The product; `None` beyond all sense.
    fn times(self, other: Self, exponent: i32) -> Option<Self> {
        let mut product = self;
        for _ in 0..exponent.unsigned_abs() {
            let (up, down) = if exponent > 0 { (other.numerator, other.denominator) } else { (other.denominator, other.numerator) };
            let (a, b) = (divisor(product.numerator, down), divisor(up, product.denominator));
            product.numerator = (product.numerator / a).checked_mul(up / b)?;
            product.denominator = (product.denominator / b).checked_mul(down / a)?;
            if product.numerator.max(product.denominator) > FACTOR_MAX {
                return None;
            }
        }
        for (power, further) in product.powers.iter_mut().zip(other.powers) {
            *power = power.checked_add(further.checked_mul(exponent)?)?;
        }
        product.ten = product.ten.checked_add(other.ten.checked_mul(exponent)?)?;
        product.degrees = product.degrees.checked_add(other.degrees.checked_mul(exponent)?)?;
        product.radians = product.radians.checked_add(other.radians.checked_mul(exponent)?)?;
        Some(product)
    }

    fn dimension(&self) -> Option<Dimension> {
        let [mass, length, time, temperature, information] = self.powers;
        let small = |power: i32| i8::try_from(power).ok();
        Some(Dimension {
            mass: small(mass)?,
            length: small(length)?,
            time: small(time)?,
            temperature: small(temperature)?,
            information: small(information)?,
        })
    }
}

/// Reads a text such as `"3 mm"`: the SI value and its dimension, one of those wanted. Angles are in radians.
///
/// # Errors
/// What is wrong and what to do.
pub(super) fn read(text: &str, wanted: Wanted<'_>) -> Result<(f64, Dimension), Wrong> {
    let name = wanted.name;
    let any = wanted.dimensions.is_empty();
    let usual = wanted.dimensions.first().copied().unwrap_or(Dimension::VELOCITY);
    let help = || like(usual, wanted.angle && !any);
    let shown = shorten(text);
    let Some((number, rest)) = Decimal::read(text.trim()) else {
        let unit = if any { String::new() } else { with_unit(usual, wanted.angle) };
        return Err((format!("`{name}` must be a number{unit}, but it is {shown}"), help()));
    };
    let unit_text = rest.trim();
    if unit_text.is_empty() && !any && !wanted.dimensions.contains(&Dimension::NONE) {
        let number = shorten(text.trim()).trim_matches('"').to_string();
        let unit = si(usual, wanted.angle);
        let help = format!("write \"{number} {unit}\", or the number without quotes if it is in {unit}");
        return Err((format!("`{name}` needs a unit of {}, but {shown} has none", quantity(usual)), help));
    }
    let unit = product(unit_text, usual, wanted.angle && !any).map_err(|(message, help)| (format!("`{name}`: {message}"), help))?;
    let dimension = unit.dimension().filter(|dimension| any || wanted.dimensions.contains(dimension));
    if wanted.angle && dimension == Some(Dimension::RATE) && unit_text.contains("Hz") {
        let help = "write it in rad/s, deg/s or rpm (revolutions per minute)".to_string();
        return Err((format!("`{name}`: {shown} could mean radians or revolutions per second"), help));
    }
    let turned = unit.degrees != 0 || unit.radians != 0;
    let Some(dimension) = dimension.filter(|_| !turned || wanted.angle).filter(|_| any || !wanted.angle || unit_text != "%") else {
        let message = match usual {
            _ if any => format!("`{name}`: {shown} has a unit of too high a power"),
            Dimension::NONE if wanted.angle => format!("`{name}` is an angle, but {shown} is in {}", shorten_unit(unit_text)),
            Dimension::RATE if wanted.angle => {
                format!("`{name}` is an angular velocity, but {shown} is in {}", shorten_unit(unit_text))
            }
            Dimension::NONE => format!("`{name}` is a pure number, but {shown} is in {}", shorten_unit(unit_text)),
            _ => format!("`{name}` needs a unit of {}, but {shown} is in {}", quantity(usual), shorten_unit(unit_text)),
        };
        return Err((message, help()));
    };
    let value = number.scaled(unit.numerator, unit.denominator, unit.ten);
    let value = match unit.degrees {
        0 => value,
        1 => radians(value),
        _ => return Err((format!("`{name}` is an angle, but {shown} is in {}", shorten_unit(unit_text)), help())),
    };
    Ok((value, dimension))
}

/// Degrees to radians; multiples of 90 deg are multiples of the `f64` nearest to π/2.
fn radians(degrees: f64) -> f64 {
    if degrees % 90.0 == 0.0 { degrees / 90.0 * std::f64::consts::FRAC_PI_2 } else { degrees.to_radians() }
}

/// Reads a product of units; empty is one.
fn product(text: &str, usual: Dimension, angle: bool) -> Result<Unit, Wrong> {
    let too_much = || ("the unit's powers are too large".to_string(), String::new());
    let mut unit = ONE;
    let mut rest = text;
    let mut first = true;
    while !rest.is_empty() {
        let mut sign = 1;
        if let Some(after) = rest.strip_prefix('/') {
            (sign, rest) = (-1, after.trim_start());
        } else if let Some(after) = rest.strip_prefix(['*', '·', '×']).filter(|_| !first) {
            rest = after.trim_start();
        }
        let (term, power, after) = term(rest, usual, angle)?;
        unit = unit.times(term, sign * power).ok_or_else(too_much)?;
        rest = after.trim_start();
        first = false;
    }
    Ok(unit)
}

/// Reads one unit with its power: `(unit, power, rest)`.
fn term(text: &str, usual: Dimension, angle: bool) -> Result<(Unit, i32, &str), Wrong> {
    let length = text.find(|c: char| !(c.is_alphabetic() || matches!(c, '%' | '°'))).unwrap_or(text.len());
    let (word, rest) = text.split_at(length);
    if word.is_empty() {
        return match text.chars().next() {
            Some('1') if !text[1..].starts_with(|c: char| c.is_ascii_digit() || c == '.') => Ok((ONE, 1, &text[1..])),
            Some(',') => Err(("a comma can't stand in a number".to_string(), "write decimals with a point".to_string())),
            Some(c) => Err((format!("{c:?} can't stand in a unit"), like(usual, angle))),
            None => Err(("the unit ends too early".to_string(), like(usual, angle))),
        };
    }
    let Some(unit) = lookup(word) else {
        return Err((format!("{} is not a unit", shorten(word)), suggestion(word, usual, angle)));
    };
    if rest.starts_with(|c: char| c.is_ascii_digit()) {
        return Err((format!("the power of `{word}` needs a `^`"), format!("write it like `{word}^2`")));
    }
    let (power, rest) =
        power(rest).ok_or_else(|| (format!("the power of `{word}` is not a whole number up to 9"), format!("write it like `{word}^2`")))?;
    Ok((unit, power, rest))
}

/// Reads `^2`, `^-3`, `²`, `⁻¹`, or nothing (power 1).
fn power(text: &str) -> Option<(i32, &str)> {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let (caret, digits) = match text.strip_prefix('^') {
        Some(after) => (true, after),
        None => (false, text),
    };
    let (sign, digits) = match digits.strip_prefix(if caret { '-' } else { '⁻' }) {
        Some(after) => (-1, after),
        None => (1, digits),
    };
    let digit =
        |c: char| if caret { c.to_digit(10) } else { RAISED.iter().position(|raised| *raised == c).and_then(|p| u32::try_from(p).ok()) };
    let mut chars = digits.chars();
    match chars.next().and_then(digit) {
        Some(value) if value > 0 && !chars.clone().next().is_some_and(|c| digit(c).is_some() || c == '.') => {
            Some((sign * i32::try_from(value).ok()?, chars.as_str()))
        }
        None if !caret && sign == 1 => Some((1, text)),
        _ => None,
    }
}

/// What an unknown unit may have meant.
fn suggestion(word: &str, usual: Dimension, angle: bool) -> String {
    if let Some((_, meant)) = MEANT.iter().find(|(other, _)| *other == word.to_lowercase()) {
        return format!("did you mean `{meant}`?");
    }
    let mut known: Vec<String> = Vec::new();
    for entry in TABLE {
        known.push(entry.0.to_string());
        known.extend(
            ["G", "M", "k", "c", "m", "u", "n"]
                .iter()
                .filter(|prefix| entry.4.contains(prefix))
                .map(|prefix| format!("{prefix}{}", entry.0)),
        );
    }
    let fits = |name: &&String| lookup(name).and_then(|unit| unit.dimension()) == Some(usual);
    let fitting: Vec<&str> = known.iter().filter(fits).map(String::as_str).collect();
    let all: Vec<&str> = known.iter().map(String::as_str).collect();
    let same = |candidates: &[&str]| candidates.iter().find(|name| name.to_lowercase() == word.to_lowercase()).map(ToString::to_string);
    let near = |candidates: &[&str]| nearest(word, candidates.iter().copied()).filter(|near| near.len() > 1).map(ToString::to_string);
    let split = |fits: bool| {
        let halves = word.char_indices().skip(1).filter_map(|(at, _)| {
            let (a, b) = word.split_at(at);
            Some((a, b, lookup(a)?.times(lookup(b)?, 1)?.dimension()?))
        });
        let mut halves = halves.filter(|(.., dimension)| !fits || *dimension == usual);
        halves.next().map(|(a, b, _)| format!("{a} {b}"))
    };
    let meant = same(&fitting).or_else(|| split(true)).or_else(|| near(&fitting));
    let meant = meant.or_else(|| same(&all)).or_else(|| split(false)).or_else(|| near(&all));
    meant.map_or_else(|| like(usual, angle), |meant| format!("did you mean `{meant}`?"))
}

/// Help: how such a number is written.
pub(super) fn like(dimension: Dimension, angle: bool) -> String {
    match (dimension, angle) {
        (Dimension::RATE, true) => "write it like \"30 rad/s\" or \"300 rpm\", or as a number in rad/s".to_string(),
        (_, true) => "write it like \"30 deg\", or as a number in rad".to_string(),
        (Dimension::NONE, false) => "write a number without a unit".to_string(),
        _ => format!("write it like \"{}\", or as a number in {}", example(dimension), dimension.unit()),
    }
}

/// What a quantity of this dimension is called.
pub(super) fn quantity(dimension: Dimension) -> &'static str {
    match dimension {
        Dimension::NONE => "a pure number",
        Dimension::LENGTH => "length",
        Dimension::TIME => "time",
        Dimension::VELOCITY => "velocity",
        Dimension::ACCELERATION => "acceleration",
        Dimension::DENSITY => "density",
        Dimension::PRESSURE => "pressure",
        Dimension::PRESSURE_PER_LENGTH => "pressure per length",
        Dimension::RATE => "rate",
        Dimension::SLOWNESS => "inverse velocity",
        Dimension::VISCOSITY_PER_LENGTH => "pressure per velocity",
        Dimension::VISCOSITY => "viscosity",
        Dimension::MASS_PER_LENGTH => "mass per length",
        Dimension::FORCE_PER_LENGTH => "force per length",
        Dimension::MASS => "mass",
        Dimension::FORCE => "force",
        Dimension::MOMENT => "moment",
        Dimension::FORCE_PER_VELOCITY => "force per velocity",
        Dimension::AREA => "area",
        Dimension::AREA_MOMENT => "second moment of area",
        Dimension::INERTIA => "moment of inertia",
        Dimension::INERTIA_PER_LENGTH => "moment of inertia per length",
        Dimension::TEMPERATURE => "temperature",
        Dimension::INFORMATION => "amount of memory",
        Dimension::SPECIFIC_HEAT => "specific heat",
        _ => "another dimension",
    }
}

/// A number of this dimension as people write it.
pub(super) fn example(dimension: Dimension) -> String {
    match dimension {
        Dimension::NONE => "0.3".into(),
        Dimension::LENGTH => "3 mm".into(),
        Dimension::TIME => "10 us".into(),
        Dimension::VELOCITY => "-50 m/s".into(),
        Dimension::ACCELERATION => "-9.81 m/s^2".into(),
        Dimension::DENSITY => "7850 kg/m^3".into(),
        Dimension::PRESSURE => "210 GPa".into(),
        Dimension::PRESSURE_PER_LENGTH => "1e14 Pa/m".into(),
        Dimension::RATE => "100 1/s".into(),
        Dimension::SLOWNESS => "0.1 s/m".into(),
        Dimension::VISCOSITY_PER_LENGTH => "10 kPa s/m".into(),
        Dimension::MASS_PER_LENGTH => "10 kg/m".into(),
        Dimension::INERTIA_PER_LENGTH => "0.1 kg m".into(),
        other => format!("1 {}", other.unit()),
    }
}

/// The SI unit; of an angular velocity with its radians.
pub(super) fn si(dimension: Dimension, angle: bool) -> String {
    if angle && dimension == Dimension::RATE { "rad/s".to_string() } else { dimension.unit() }
}

fn with_unit(dimension: Dimension, angle: bool) -> String {
    match (dimension, angle) {
        (Dimension::RATE, true) => " with a unit of angular velocity".to_string(),
        (_, true) => " in rad or with `deg`".to_string(),
        (Dimension::NONE, false) => String::new(),
        _ => format!(" with a unit of {}", quantity(dimension)),
    }
}

fn shorten_unit(text: &str) -> String {
    if text.is_empty() { "no unit".to_string() } else { shorten(text).trim_matches('"').to_string() }
}

/// A user's text in quotes, cut and without control characters.
pub(super) fn shorten(text: &str) -> String {
    let mut shown: String = text.chars().take(40).map(|c| if c.is_control() { '\u{fffd}' } else { c }).collect();
    if text.chars().nth(40).is_some() {
        shown.push_str("...");
    }
    format!("\"{shown}\"")
}

/// The units as a line for the documentation: names, with a star where prefixes are taken, which is written
/// so that it is none of Markdown's.
pub(super) fn names() -> String {
    TABLE.iter().map(|entry| format!("`{}`{}", entry.0, if entry.4.is_empty() { "" } else { "\\*" })).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

    fn si(text: &str) -> f64 {
        let (number, rest) = Decimal::read(text).unwrap();
        let unit = product(rest.trim(), Dimension::NONE, true).unwrap();
        number.scaled(unit.numerator, unit.denominator, unit.ten)
    }

    fn fault(text: &str, dimension: Dimension) -> String {
        let (message, help) = read(text, Wanted { name: "it", dimensions: &[dimension], angle: false }).unwrap_err();
        format!("{message} | {help}")
    }

    #[test]
    fn units_give_the_same_number_as_si_digits() {
        for (text, value) in [
            ("94 mm", 0.094),
            ("3 mm", 0.003),
            ("0.1 ms", 1e-4),
            ("10 us", 1e-5),
            ("10 µs", 1e-5),
            ("10 μs", 1e-5),
            ("210 GPa", 2.1e11),
            ("7.85 g/cm^3", 7850.0),
            ("7.8e-9 t/mm^3", 7800.0),
            ("-50 m/s", -50.0),
            ("3.5e11 N/m/m", 3.5e11),
            ("1e-3 kg*m/s^2", 1e-3),
            ("1e-3 kg m s^-2", 1e-3),
            ("1e-3 kg·m·s⁻²", 1e-3),
            ("36 km/h", 10.0),
            ("1 min", 60.0),
            ("1 h", 3600.0),
            ("12 in", 0.3048),
            ("1 ft", 0.3048),
            ("1 lb", 0.453_592_37),
            ("1 lbf", 4.448_221_615_260_5),
            ("1 psi", 6_894.757_293_168_362),
            ("1 ksi", 6_894_757.293_168_361),
            ("1 lbf/in^2", 6_894.757_293_168_362),
            ("5 %", 0.05),
            ("2 bar", 2e5),
            ("7.85 g/cc", 7850.0),
            ("3 L", 0.003),
            ("250 ml", 2.5e-4),
            ("1.2 kg/l", 1200.0),
            ("60 mph", 26.8224),
            ("2 kgf", 19.6133),
            ("3 atm", 303_975.0),
            ("5mm", 0.005),
            ("1e3 mm", 1.0),
            ("1.5E+3mm", 1.5),
            ("+.5 m", 0.5),
            ("5. m", 5.0),
            ("2 1/s", 2.0),
            ("2 /s", 2.0),
            ("3 kN/mm²", 3e9),
            ("1 km", 1000.0),
            ("123456789.123456789 nm", 0.123_456_789_123_456_78),
        ] {
            assert_eq!(si(text), value, "{text}");
        }
    }

    #[test]
    fn right_angles_are_exact() {
        let angle = |text| read(text, Wanted { name: "to", dimensions: &[Dimension::NONE], angle: true }).unwrap().0;
        assert_eq!([angle("90 deg"), angle("-90 deg"), angle("180 deg"), angle("360 deg")], [FRAC_PI_2, -FRAC_PI_2, PI, TAU]);
        assert_eq!([angle("45 deg"), angle("0 deg"), angle("1.5 rad"), angle("20 mrad"), angle("2")], [FRAC_PI_4, 0.0, 1.5, 0.02, 2.0]);
        assert!(read("1 %", Wanted { name: "to", dimensions: &[Dimension::NONE], angle: true }).is_err());
    }

    #[test]
    fn angular_velocities_come_in_radians_degrees_or_revolutions() {
        let read = |text| read(text, Wanted { name: "spin", dimensions: &[Dimension::RATE], angle: true });
        let spin = |text| read(text).map(|(value, _)| value);
        assert_eq!([spin("30 rad/s"), spin("2 1/s"), spin("180 deg/s"), spin("60 rpm")], [Ok(30.0), Ok(2.0), Ok(PI), Ok(TAU)]);
        assert!(spin("5 Hz").unwrap_err().0.ends_with("could mean radians or revolutions per second"));
        assert_eq!(spin("5 m").unwrap_err().0, "`spin` is an angular velocity, but \"5 m\" is in m");
        assert!(spin("5").unwrap_err().1.starts_with("write \"5 rad/s\""));
    }

    #[test]
    fn a_wrong_unit_is_explained() {
        for (text, dimension, expected) in [
            ("5 kg", Dimension::TIME, "`it` needs a unit of time, but \"5 kg\" is in kg | write it like \"10 us\", or as a number in s"),
            (
                "5",
                Dimension::LENGTH,
                "`it` needs a unit of length, but \"5\" has none | write \"5 m\", or the number without quotes if it is in m",
            ),
            ("0.3 m", Dimension::NONE, "`it` is a pure number, but \"0.3 m\" is in m | write a number without a unit"),
            ("3 deg", Dimension::NONE, "`it` is a pure number, but \"3 deg\" is in deg | write a number without a unit"),
            ("210 Gpa", Dimension::PRESSURE, "`it`: \"Gpa\" is not a unit | did you mean `GPa`?"),
            ("210 mpa", Dimension::PRESSURE, "`it`: \"mpa\" is not a unit | did you mean `MPa`?"),
            ("5 sec", Dimension::TIME, "`it`: \"sec\" is not a unit | did you mean `s`?"),
            ("5 Nm", Dimension::LENGTH, "`it`: \"Nm\" is not a unit | did you mean `nm`?"),
            ("5 Nmm", Dimension::PRESSURE, "`it`: \"Nmm\" is not a unit | did you mean `N mm`?"),
            ("7 g/cm3", Dimension::DENSITY, "`it`: the power of `cm` needs a `^` | write it like `cm^2`"),
            ("7 g/cm^x", Dimension::DENSITY, "`it`: the power of `cm` is not a whole number up to 9 | write it like `cm^2`"),
            ("3 m/", Dimension::VELOCITY, "`it`: the unit ends too early | write it like \"-50 m/s\", or as a number in m/s"),
            ("3,5 mm", Dimension::LENGTH, "`it`: a comma can't stand in a number | write decimals with a point"),
            ("1 000 m", Dimension::LENGTH, "`it`: '0' can't stand in a unit | write it like \"3 mm\", or as a number in m"),
            (
                "soon",
                Dimension::TIME,
                "`it` must be a number with a unit of time, but it is \"soon\" | write it like \"10 us\", or as a number in s",
            ),
            ("nan", Dimension::NONE, "`it` must be a number, but it is \"nan\" | write a number without a unit"),
            (
                "5 m^9 m^9 m^9 m^9 m^9 m^9 m^9 m^9 m^9 m^9 m^9 m^9 m^9 m^9 m^9",
                Dimension::LENGTH,
                "`it` needs a unit of length, but \"5 m^9 m^9 m^9 m^9 m^9 m^9 m^9 m^9 m^9 m^...\" is in m^9 m^9 m^9 \
                    m^9 m^9 m^9 m^9 m^9 m^9 m^9 ... | write it like \"3 mm\", or as a number in m",
            ),
            ("5 psi^9 psi^9", Dimension::LENGTH, "`it`: the unit's powers are too large | "),
        ] {
            assert_eq!(fault(text, dimension), expected, "{text}");
        }
    }

    #[test]
    fn no_two_units_share_a_name() {
        let mut all: Vec<String> = TABLE.iter().flat_map(|entry| entry.4.iter().map(|p| format!("{p}{}", entry.0))).collect();
        all.extend(TABLE.iter().map(|entry| entry.0.to_string()));
        let shadowed = ["cd", "min", "ft", "Pa"]; // plain names win over a prefix and a unit
        let total = all.len();
        all.sort();
        all.dedup();
        assert!(total - all.len() <= shadowed.len(), "{} names are taken twice", total - all.len());
    }
}
