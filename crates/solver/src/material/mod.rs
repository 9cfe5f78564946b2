//! Material laws: the contract that each fulfils, and the registry that everything else iterates over.
//!
//! A law is written once, for any dimension, against [`SymmetricTensor`]. Its input is one [`Kinematics`] value from the block;
//! it returns the Cauchy stress and what the ledger and the stable step need. To add a law: one file, one line in `laws!`.

mod elastic;
mod j2;
mod neo_hookean;

pub use elastic::Elastic;
pub use j2::J2;
pub use neo_hookean::NeoHookean;

use crate::quantity::{Dimension, Parameter, Range};
use crate::tensor::SymmetricTensor;
use embate_lanes::{Batch, Lane};
use std::collections::BTreeMap;

/// A law as the registry describes it.
#[derive(Clone, Copy, Debug)]
pub struct LawKind {
    /// Name in the model file.
    pub name: &'static str,
    /// One line: what it is.
    pub doc: &'static str,
    /// Where its equations come from.
    pub source: &'static str,
    /// Parameters, density first.
    pub parameters: &'static [Parameter],
}

/// Which deformation measures a law works on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Stress rate from the rate of deformation: gets the old stress, already rotated, and the strain increment. It has no energy
    /// function; the block accumulates the stress work and subtracts what the law dissipates.
    Rate,
    /// Stress from the left Cauchy-Green tensor and the volume ratio; reports its stored energy.
    Hyperelastic,
}

/// What the block tells a law about one point; only the measures of its family are set, the others are zero.
#[derive(Clone, Copy, Debug)]
pub struct Kinematics<L: Lane, T: SymmetricTensor<L>> {
    /// Rate: Δε, symmetric part of the displacement increment's gradient in the mid-step configuration, rotated to the end of the step.
    pub strain_increment: T,
    /// Rate: rotation over the step, for tensors in the law's own state (the stress is rotated already).
    pub rotation: T::Rotation,
    /// Rate: old Cauchy stress, rotated to the end of the step, Pa.
    pub stress_rotated: T,
    /// Hyperelastic: b = F Fᵀ.
    pub left_cauchy_green: T,
    /// Hyperelastic: J = det F.
    pub volume_ratio: L,
}

/// What a law answers.
#[derive(Clone, Copy, Debug)]
pub struct Response<L: Lane, T: SymmetricTensor<L>> {
    /// Cauchy stress, Pa.
    pub stress: T,
    /// Hyperelastic: stored energy per initial volume, J/m³; rate: zero.
    pub stored: L,
    /// Energy dissipated in the step per current volume, J/m³; never negative.
    pub dissipated: L,
    /// Bulk stiffness K of the current state, Pa.
    pub bulk: L,
    /// Shear stiffness µ of the current state, Pa: no wave is faster than √((K + 4µ/3)/ρ).
    pub shear: L,
}

/// History values of a point.
pub trait State<L: Lane>: Copy {
    /// How many.
    const COUNT: usize;
    /// Reads it from the batches `from[0..COUNT]`, lanes from `at` on.
    fn load(from: &[Batch], at: usize) -> Self;
    /// Writes it to the batches `to[0..COUNT]`, lanes from `at` on.
    fn store(self, to: &mut [Batch], at: usize);
}

impl<L: Lane, const S: usize> State<L> for [L; S] {
    const COUNT: usize = S;
    #[inline(always)]
    fn load(from: &[Batch], at: usize) -> Self {
        let mut state = [L::splat(0.0); S];
        for index in 0..S {
            state[index] = L::load(&from[index], at);
        }
        state
    }
    #[inline(always)]
    fn store(self, to: &mut [Batch], at: usize) {
        for index in 0..S {
            self[index].store(&mut to[index], at);
        }
    }
}

/// A material law. `update` must be `#[inline(always)]`: it becomes part of the block's kernel.
pub trait Law: Copy + Send + Sync + 'static {
    /// Name, parameters and source.
    const KIND: LawKind;
    /// Which measures it works on.
    const FAMILY: Family;
    /// History values of a point, zero at the start.
    type State<L: Lane>: State<L>;
    /// Which history value is the equivalent plastic strain, if any.
    const PLASTIC_STRAIN: Option<usize>;

    /// Reads its parameters, which have been checked against [`Law::KIND`].
    fn new(parameters: &Parameters<'_>) -> Self;

    /// Stress at the end of the step.
    fn update<L: Lane, T: SymmetricTensor<L>>(&self, kinematics: &Kinematics<L, T>, state: &mut Self::State<L>) -> Response<L, T>;

    /// Bulk and shear stiffness at rest, Pa.
    fn stiffness(&self) -> [f64; 2];
}

/// Parameter values by name, defaults filled in.
#[derive(Clone, Copy, Debug)]
pub struct Parameters<'a> {
    kind: &'static [Parameter],
    values: &'a BTreeMap<String, f64>,
}

impl<'a> Parameters<'a> {
    /// Values for the parameters of a law.
    #[must_use]
    pub fn new(kind: &'static [Parameter], values: &'a BTreeMap<String, f64>) -> Self {
        Self { kind, values }
    }
    /// Value of `name`, its default if it was left out, NaN if there is neither (which the model's check refuses).
    #[must_use]
    pub fn value(&self, name: &str) -> f64 {
        let default = || self.kind.iter().find(|parameter| parameter.name == name).and_then(|parameter| parameter.default);
        self.values.get(name).copied().or_else(default).unwrap_or(f64::NAN)
    }
}

/// Density: the first parameter of every law.
pub const DENSITY: Parameter = Parameter {
    name: "density",
    symbol: "ρ",
    dimension: Dimension::DENSITY,
    range: Range::Positive,
    default: None,
    doc: "mass per initial volume",
};
/// Young's modulus.
pub const YOUNG: Parameter =
    Parameter { name: "young", symbol: "E", dimension: Dimension::PRESSURE, range: Range::Positive, default: None, doc: "Young's modulus" };
/// Poisson's ratio.
pub const POISSON: Parameter = Parameter {
    name: "poisson",
    symbol: "ν",
    dimension: Dimension::NONE,
    range: Range::Between(-1.0, 0.5),
    default: None,
    doc: "Poisson's ratio",
};

/// Bulk modulus K = E / (3(1 − 2ν)) and shear modulus µ = E / (2(1 + ν)).
#[must_use]
pub fn bulk_and_shear(parameters: &Parameters<'_>) -> [f64; 2] {
    let (young, poisson) = (parameters.value("young"), parameters.value("poisson"));
    [young / (3.0 * (1.0 - 2.0 * poisson)), young / (2.0 * (1.0 + poisson))]
}

/// Someone who does something with every law's type: makes a block of it, lists it, tests it.
pub trait LawVisitor {
    /// What comes out.
    type Output;
    /// The work for the law `M`.
    fn visit<M: Law>(self) -> Self::Output;
}

/// The registry: one line per law.
macro_rules! laws {
    ($($law:ident),* $(,)?) => {
        /// Every law, in the order in which it is listed.
        pub const LAWS: &[LawKind] = &[$(<$law as Law>::KIND),*];

        /// Calls `visitor` with the law called `name`; `None` when there is none.
        pub fn with_law<V: LawVisitor>(name: &str, visitor: V) -> Option<V::Output> {
            match name {
                $(n if n == <$law as Law>::KIND.name => Some(visitor.visit::<$law>()),)*
                _ => None,
            }
        }
    };
}

laws!(Elastic, J2, NeoHookean);

/// Every law.
#[must_use]
pub fn registry() -> Vec<LawKind> {
    LAWS.to_vec()
}
