//! Physical quantities of the input: dimension, range, and the description from which the input reader, the
//! JSON schema, `embate list` and the documentation are made.

use std::fmt;

/// Physical dimension as integer exponents of kilogram, metre, second and kelvin, and of bytes. Values are SI
/// `f64`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Dimension {
    /// Exponent of mass (kg).
    pub mass: i8,
    /// Exponent of length (m).
    pub length: i8,
    /// Exponent of time (s).
    pub time: i8,
    /// Exponent of temperature (K).
    pub temperature: i8,
    /// Exponent of information (B).
    pub information: i8,
}

impl Dimension {
    const fn new(mass: i8, length: i8, time: i8) -> Self {
        Self { mass, length, time, temperature: 0, information: 0 }
    }
    /// A pure number (also angles: the reader turns degrees into radians).
    pub const NONE: Self = Self::new(0, 0, 0);
    /// m.
    pub const LENGTH: Self = Self::new(0, 1, 0);
    /// s.
    pub const TIME: Self = Self::new(0, 0, 1);
    /// m/s.
    pub const VELOCITY: Self = Self::new(0, 1, -1);
    /// m/s².
    pub const ACCELERATION: Self = Self::new(0, 1, -2);
    /// kg/m³.
    pub const DENSITY: Self = Self::new(1, -3, 0);
    /// Pa = N/m²; also a stiffness per metre of depth (N/m/m).
    pub const PRESSURE: Self = Self::new(1, -1, -2);
    /// Pa/m = N/m³: pressure per penetration.
    pub const PRESSURE_PER_LENGTH: Self = Self::new(1, -2, -2);
    /// 1/s; also an angular velocity (rad/s).
    pub const RATE: Self = Self::new(0, 0, -1);
    /// s/m.
    pub const SLOWNESS: Self = Self::new(0, -1, 1);
    /// Pa s: dynamic viscosity; also a force per velocity and metre of depth, N s/m/m.
    pub const VISCOSITY: Self = Self::new(1, -1, -1);
    /// Pa s/m: shear stress per slip rate.
    pub const VISCOSITY_PER_LENGTH: Self = Self::new(1, -2, -1);
    /// N.
    pub const FORCE: Self = Self::new(1, 1, -2);
    /// N m.
    pub const MOMENT: Self = Self::new(1, 2, -2);
    /// kg.
    pub const MASS: Self = Self::new(1, 0, 0);
    /// N/m = kg/s²: force per metre of depth; also a stiffness.
    pub const FORCE_PER_LENGTH: Self = Self::new(1, 0, -2);
    /// N s/m = kg/s: force per velocity.
    pub const FORCE_PER_VELOCITY: Self = Self::new(1, 0, -1);
    /// m².
    pub const AREA: Self = Self::new(0, 2, 0);
    /// m⁴.
    pub const AREA_MOMENT: Self = Self::new(0, 4, 0);
    /// kg m².
    pub const INERTIA: Self = Self::new(1, 2, 0);
    /// kg/m: mass per metre of depth.
    pub const MASS_PER_LENGTH: Self = Self::new(1, -1, 0);
    /// kg m = kg m²/m: moment of inertia per metre of depth.
    pub const INERTIA_PER_LENGTH: Self = Self::new(1, 1, 0);
    /// K.
    pub const TEMPERATURE: Self = Self { temperature: 1, ..Self::NONE };
    /// B: memory.
    pub const INFORMATION: Self = Self { information: 1, ..Self::NONE };
    /// J/kg/K: heat per mass and temperature.
    pub const SPECIFIC_HEAT: Self = Self { temperature: -1, ..Self::new(0, 2, -2) };

    /// The SI unit in plain text, `kg/m^3` for example; empty for a pure number.
    #[must_use]
    pub fn unit(self) -> String {
        match self {
            Self::NONE => return String::new(),
            Self::PRESSURE => return "Pa".into(),
            Self::PRESSURE_PER_LENGTH => return "Pa/m".into(),
            Self::VISCOSITY => return "Pa s".into(),
            Self::SPECIFIC_HEAT => return "J/kg/K".into(),
            Self::VISCOSITY_PER_LENGTH => return "Pa s/m".into(),
            Self::FORCE_PER_LENGTH => return "N/m".into(),
            Self::FORCE_PER_VELOCITY => return "N s/m".into(),
            Self::FORCE => return "N".into(),
            Self::MOMENT => return "N m".into(),
            _ => {}
        }
        let power = |(name, exponent): &(&str, i8)| match exponent.abs() {
            1 => (*name).to_string(),
            p => format!("{name}^{p}"),
        };
        let all = [("kg", self.mass), ("m", self.length), ("s", self.time), ("K", self.temperature), ("B", self.information)];
        let above: Vec<_> = all.iter().filter(|(_, e)| *e > 0).map(power).collect();
        let below: Vec<_> = all.iter().filter(|(_, e)| *e < 0).map(power).collect();
        let above = if above.is_empty() { "1".to_string() } else { above.join(" ") };
        if below.is_empty() { above } else { format!("{above}/{}", below.join("/")) }
    }
}

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.unit())
    }
}

/// The values that are allowed; every range excludes NaN and the infinities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Range {
    /// Any finite number.
    Finite,
    /// Greater than zero.
    Positive,
    /// Zero or greater.
    NotNegative,
    /// `low < value < high`.
    Between(f64, f64),
    /// `low < value <= high`.
    UpTo(f64, f64),
}

impl Range {
    /// Whether `value` is finite and lies in the range.
    #[must_use]
    pub fn contains(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Self::Finite => true,
                Self::Positive => value > 0.0,
                Self::NotNegative => value >= 0.0,
                Self::Between(low, high) => low < value && value < high,
                Self::UpTo(low, high) => low < value && value <= high,
            }
    }
}

impl Range {
    /// In words, of an angle: its bounds in degrees.
    #[must_use]
    pub fn of_angle(self) -> String {
        match self {
            Self::Between(low, high) => format!("between {} and {} deg, both excluded", low.to_degrees(), high.to_degrees()),
            Self::UpTo(low, high) => format!("greater than {} and at most {} deg", low.to_degrees(), high.to_degrees()),
            _ => self.to_string(),
        }
    }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Finite => f.write_str("a finite number"),
            Self::Positive => f.write_str("greater than 0"),
            Self::NotNegative => f.write_str("0 or greater"),
            Self::Between(low, high) => write!(f, "between {low} and {high}, both excluded"),
            Self::UpTo(low, high) => write!(f, "greater than {low} and at most {high}"),
        }
    }
}

/// One parameter of a material law, an element or a contact law, described once for input, lists and
/// documentation.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// Key in the model file.
    pub name: &'static str,
    /// Symbol as in the equations of the documentation.
    pub symbol: &'static str,
    /// Physical dimension.
    pub dimension: Dimension,
    /// Allowed values (SI).
    pub range: Range,
    /// Value when the key is left out; `None`: the key is required.
    pub default: Option<f64>,
    /// Most values of a list; 0: a single number. A list without a default may not be left out, one with a
    /// default may be empty.
    pub list: usize,
    /// A value as people write it, for messages; empty: what is usual for its dimension.
    pub example: &'static str,
    /// Whether it is an angle: a number in rad, or a text such as `25 deg`.
    pub is_angle: bool,
    /// One line: what it is.
    pub doc: &'static str,
}

impl Parameter {
    /// A number that must be given.
    #[must_use]
    pub const fn new(name: &'static str, symbol: &'static str, dimension: Dimension, range: Range, doc: &'static str) -> Self {
        Self { name, symbol, dimension, range, default: None, list: 0, example: "", is_angle: false, doc }
    }

    /// The same with a value for when it is left out.
    #[must_use]
    pub const fn or(self, default: f64) -> Self {
        Self { default: Some(default), ..self }
    }

    /// The same as a list of at most so many numbers, each in the range.
    #[must_use]
    pub const fn list(self, most: usize) -> Self {
        Self { list: most, ..self }
    }

    /// The same with a value as people write it.
    #[must_use]
    pub const fn such_as(self, example: &'static str) -> Self {
        Self { example, ..self }
    }

    /// The same as an angle.
    #[must_use]
    pub const fn angle(self) -> Self {
        Self { is_angle: true, ..self }
    }

    /// The SI unit of its values; empty for a pure number.
    #[must_use]
    pub fn unit(&self) -> String {
        if self.is_angle { "rad".into() } else { self.dimension.unit() }
    }
}
