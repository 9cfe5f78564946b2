//! Parameters of laws as they are read: numbers and lists by name, defaults filled in, and the descriptions
//! that many laws share.

use crate::message::Message;
use crate::quantity::{Dimension, Parameter, Range};
use std::collections::BTreeMap;

/// Parameter values by name.
#[derive(Clone, Copy, Debug)]
pub struct Parameters<'a> {
    kind: &'static [Parameter],
    values: &'a BTreeMap<String, f64>,
    lists: &'a BTreeMap<String, Vec<f64>>,
}

impl<'a> Parameters<'a> {
    /// Values for the parameters of a law.
    #[must_use]
    pub fn new(kind: &'static [Parameter], values: &'a BTreeMap<String, f64>, lists: &'a BTreeMap<String, Vec<f64>>) -> Self {
        Self { kind, values, lists }
    }

    /// Value of `name`, its default if it was left out, NaN if there is neither (which the model's check
    /// refuses).
    #[must_use]
    pub fn value(&self, name: &str) -> f64 {
        let default = || self.kind.iter().find(|parameter| parameter.name == name).and_then(|parameter| parameter.default);
        self.values.get(name).copied().or_else(default).unwrap_or(f64::NAN)
    }

    /// Value of `name` where it was given.
    #[must_use]
    pub fn given(&self, name: &str) -> Option<f64> {
        self.values.get(name).copied()
    }

    /// The list `name`; empty where it was left out.
    #[must_use]
    pub fn list(&self, name: &str) -> &'a [f64] {
        self.lists.get(name).map_or(&[], |list| list)
    }

    /// The first `N` values of the list `name`, the rest `fill`.
    #[must_use]
    pub fn array<const N: usize>(&self, name: &str, fill: f64) -> [f64; N] {
        let list = self.list(name);
        std::array::from_fn(|i| list.get(i).copied().unwrap_or(fill))
    }
}

/// What is wrong with a parameter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ParameterFault {
    /// Its kind.
    pub kind: &'static Message,
    /// The parameter.
    pub name: &'static str,
    /// What is wrong.
    pub message: String,
    /// What to do.
    pub help: String,
}

/// Density: the first parameter of every law.
pub const DENSITY: Parameter = Parameter::new("density", "ρ", Dimension::DENSITY, Range::Positive, "mass per initial volume");
/// Young's modulus.
pub const YOUNG: Parameter = Parameter::new("young", "E", Dimension::PRESSURE, Range::Positive, "Young's modulus");
/// Poisson's ratio.
pub const POISSON: Parameter = Parameter::new("poisson", "ν", Dimension::NONE, Range::Between(-1.0, 0.5), "Poisson's ratio");
/// Bulk modulus of a rubber.
pub const BULK: Parameter = Parameter::new("bulk", "K", Dimension::PRESSURE, Range::Positive, "bulk modulus").such_as("2 GPa");

/// Bulk modulus K = E / (3(1 − 2ν)) and shear modulus µ = E / (2(1 + ν)).
#[must_use]
pub fn bulk_and_shear(parameters: &Parameters<'_>) -> [f64; 2] {
    let (young, poisson) = (parameters.value("young"), parameters.value("poisson"));
    [young / (3.0 * (1.0 - 2.0 * poisson)), young / (2.0 * (1.0 + poisson))]
}

/// The other way: E = 9 K µ/(3 K + µ) and ν = (3 K − 2 µ)/(2 (3 K + µ)).
#[inline(always)]
#[must_use]
pub(crate) fn young_and_poisson([bulk, shear]: [f64; 2]) -> [f64; 2] {
    [9.0 * bulk * shear / (3.0 * bulk + shear), (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear))]
}
