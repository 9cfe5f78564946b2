//! How driven things move, and the curves that values follow in a [`super::Model`].
//!
//! Values come from the model file, checked by `input`; [`crate::load::curve`] evaluates the curves.

use super::values::{Course, Datum, Field};
use super::{Values, section};
use crate::quantity::Dimension;
use crate::quantity::Range::{Finite, Positive};
use crate::vocabulary::Kind::{self, Angle, Choice, Quantity, Reference, Table, Text};
use crate::vocabulary::Need::{Default as Written, Optional};
use crate::vocabulary::{Choices, Form, Rule, Section, key};

/// How a rigid body may move: per degree of freedom driven (zero is fixed), or free (`None`).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motion {
    /// Velocity of its centre of mass (of an obstacle: of its reference point), m/s.
    pub velocity: [Option<Drive>; 3],
    /// Angular velocity, rad/s, counter-clockwise.
    pub spin: Option<Drive>,
}

impl Motion {
    /// No motion at all.
    #[must_use]
    pub fn fixed() -> Self {
        Self { velocity: [0; 3].map(|_| Some(Drive::Constant(0.0))), spin: Some(Drive::Constant(0.0)) }
    }

    /// Of what is prescribed along x, y, z and around.
    pub(super) fn of(courses: &[Option<Course>; 4], left_out: &Self) -> Self {
        let drive = |axis: usize, left_out: &Option<Drive>| match &courses[axis] {
            None => left_out.clone(),
            Some(Course::Free) => None,
            Some(Course::Driven(drive)) => Some(drive.clone()),
        };
        Self { velocity: [0, 1, 2].map(|axis| drive(axis, &left_out.velocity[axis])), spin: drive(3, &left_out.spin) }
    }

    /// That of an obstacle: what it leaves out is fixed.
    pub(super) fn of_obstacle(values: &dyn Values) -> Self {
        let courses: Option<[Option<Course>; 4]> = values.get("motion");
        courses.map_or_else(Self::fixed, |courses| Self::of(&courses, &Self::fixed()))
    }
}

/// That of a rigid part: what it leaves out is free.
impl Field for Motion {
    fn sound(values: &dyn Values, key: &str) -> Option<Self> {
        match values.values().get(key)? {
            Datum::Flag(true) => Some(Self::default()),
            Datum::Courses(courses) => Some(Self::of(courses, &Self::default())),
            _ => None,
        }
    }

    fn placeholder() -> Self {
        Self::default()
    }
}

/// A prescribed velocity, m/s (or rad/s).
#[derive(Clone, Debug, PartialEq)]
pub enum Drive {
    /// The same at all times.
    Constant(f64),
    /// Key of [`super::Model::curves`].
    Curve(String),
}

impl From<f64> for Drive {
    fn from(velocity: f64) -> Self {
        Self::Constant(velocity)
    }
}

/// `[curve.NAME]`: a function of time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    /// What it looks like.
    pub shape: CurveShape,
    /// Dimension of the values as they were written; `None`: bare numbers, SI of whatever uses them.
    pub dimension: Option<Dimension>,
    /// Stage from whose beginning its times count; `None`: the beginning of the run.
    pub stage: Option<String>,
}

impl From<CurveShape> for Curve {
    /// Of bare numbers, from the beginning of the run on.
    fn from(shape: CurveShape) -> Self {
        Self { shape, ..Self::default() }
    }
}

impl Curve {
    /// Straight lines between points, of bare numbers.
    #[must_use]
    pub fn table(times: Vec<f64>, values: Vec<f64>) -> Self {
        CurveShape::Table { times, values, smooth: false }.into()
    }
}

pub(crate) static CURVE: Section = Section {
    name: "curve",
    doc: "A function of time, named where something follows it: by points (`time` and `value`; constant before the \
        first and after the last), a `sine`, or a formula (`expression`). The name begins with a letter.",
    form: Form::Named,
    keys: &[
        key("time", Kind::Quantities(Dimension::TIME, Finite, 1), Optional("`sine` or `expression`"), "Times, ascending."),
        key(
            "value",
            Kind::Values,
            Optional("`sine` or `expression`"),
            "Values, as many: of one dimension, or bare numbers in the SI unit of what uses the curve.",
        ),
        key(
            "between",
            Choice(Choices::Words(&["lines", "smooth_steps"])),
            Written("\"lines\""),
            "What leads from point to point: straight lines, or steps without velocity and acceleration at their ends.",
        ),
        key("sine", Table(&SINE), Optional("points or `expression`"), "A wave."),
        key(
            "expression",
            Text,
            Optional("points or `sine`"),
            "A formula of the time `t` in s, such as `\"2*sin(3*t) + exp(-t)\"`, in the SI unit of what uses the \
                curve: numbers, `+ - * / ^`, parentheses, `pi`, `sin`, `cos`, `exp`, `ln`, `sqrt`, `abs`, `min`, \
                `max`, and `step(x)`, which is 0 for x < 0, else 1.",
        ),
        key(
            "stage",
            Reference,
            Optional("the beginning of the run"),
            "Stage from whose beginning its times count; until then it has its value at zero.",
        ),
    ],
    rules: &[
        Rule::OneOf(&["value", "sine", "expression"]),
        Rule::Needs("value", "time"),
        Rule::NotBoth("time", "sine"),
        Rule::NotBoth("time", "expression"),
        Rule::NotBoth("between", "sine"),
        Rule::NotBoth("between", "expression"),
    ],
    ..Section::EMPTY
};

impl Curve {
    /// From its table in the model file.
    #[must_use]
    pub fn read(values: &dyn Values) -> Self {
        let stage = values.get("stage");
        if let Some(sine) = values.table("sine") {
            let dimension = |key| values_of(sine, key).1;
            return Self { shape: CurveShape::Sine(Sine::read(sine)), dimension: dimension("amplitude").or(dimension("offset")), stage };
        }
        if values.has("expression") {
            return Self { shape: CurveShape::Expression(values.get("expression")), dimension: None, stage };
        }
        let (ordinates, dimension) = values_of(values, "value");
        let smooth = values.get::<String>("between") == "smooth_steps";
        Self { shape: CurveShape::Table { times: values.get("time"), values: ordinates, smooth }, dimension, stage }
    }
}

/// Numbers of one dimension.
fn values_of(values: &dyn Values, key: &str) -> (Vec<f64>, Option<Dimension>) {
    values.get(key)
}

fn first(values: &dyn Values, key: &str) -> f64 {
    values_of(values, key).0.first().copied().unwrap_or(f64::NAN)
}

/// The shape of a curve.
#[derive(Clone, Debug, PartialEq)]
pub enum CurveShape {
    /// Through points; constant before the first and after the last.
    Table {
        /// Times, s, strictly ascending.
        times: Vec<f64>,
        /// Values, SI.
        values: Vec<f64>,
        /// Whether smooth steps lead from point to point; else straight lines.
        smooth: bool,
    },
    /// A wave.
    Sine(Sine),
    /// A formula of the time `t`: see [`crate::expression`].
    Expression(String),
}

section! {
    /// offset + amplitude · sin(2π frequency · t + phase).
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Sine in SINE = Section {
        name: "sine",
        doc: "offset + amplitude * sin(2 pi frequency t + phase).",
        ..Section::EMPTY
    };
    amplitude: f64 = Kind::Value, Required,
        "Height of the wave: a quantity, or a bare number in the SI unit of what uses the curve.",
        read |values| first(values, "amplitude");
    frequency: f64 = Quantity(Dimension::RATE, Positive), Required, "Waves per time.";
    phase: f64 = Angle(Dimension::NONE, Finite), Default("0"), "Angle at time zero.";
    offset: f64 = Kind::Value, Default("0"), "Mean value, of the same dimension.", read |values| first(values, "offset");
}

impl Default for CurveShape {
    fn default() -> Self {
        Self::Table { times: Vec::new(), values: Vec::new(), smooth: false }
    }
}
