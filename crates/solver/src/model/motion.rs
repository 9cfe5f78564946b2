//! How driven things move, and the curves that values follow in a [`super::Model`].
//!
//! Values come from the model file, checked by `input`; [`crate::load::curve`] evaluates the curves.

use crate::quantity::Dimension;

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
}

impl Curve {
    /// Straight lines between points, of bare numbers.
    #[must_use]
    pub fn table(times: Vec<f64>, values: Vec<f64>) -> Self {
        Self { shape: CurveShape::Table { times, values, smooth: false }, dimension: None }
    }
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
    /// A formula of the time `t`: see [`crate::load::curve::expression`].
    Expression(String),
}

/// offset + amplitude · sin(2π frequency · t + phase).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sine {
    /// Height of the wave.
    pub amplitude: f64,
    /// Waves per second, Hz.
    pub frequency: f64,
    /// Angle at time zero, rad.
    pub phase: f64,
    /// Mean value.
    pub offset: f64,
}

impl Default for CurveShape {
    fn default() -> Self {
        Self::Table { times: Vec::new(), values: Vec::new(), smooth: false }
    }
}
