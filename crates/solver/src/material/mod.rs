//! Material laws: the contract that each fulfils, and the registry that everything else iterates over.
//!
//! A law is written once, for any dimension and stress state, against [`SymmetricTensor`]. Its input is one
//! [`Kinematics`] value from the block; it returns the Cauchy stress and what the ledger and the stable step
//! need. To add a law: one file, one line in `laws!`. Blocks see laws erased, as [`points::PointLaw`]: the
//! kernel of a law is compiled once, not once per element.

mod curve;
pub mod eos;
pub mod hardening;
mod parameters;
pub(crate) mod messages;
pub mod points;
mod rubber;
mod softening;
mod state;
mod trial;
mod stress_constrained;
pub mod unit_system;
pub mod variable;

pub use curve::uniaxial_curve;
pub use j2::J2With;
pub(crate) use parameters::young_and_poisson;
pub use parameters::{BULK, DENSITY, POISSON, ParameterFault, Parameters, YOUNG, bulk_and_shear};
pub use softening::Softening;
pub use state::{Orientation, State, Tensors};
pub use variable::{History, Variable};

use crate::message::Message;
use crate::quantity::Parameter;
use crate::tensor::{Solid, SymmetricTensor};
use embate_lanes::Lane;

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
    /// Stress rate from the rate of deformation: gets the old stress, already rotated, and the strain
    /// increment. It has no energy function; the block accumulates the stress work and subtracts what the law
    /// dissipates.
    Rate,
    /// Stress from the left Cauchy-Green tensor and the volume ratio; reports its stored energy.
    Hyperelastic,
}

/// What the block reports a law about one point; only the measures of its family, and those that it asks for,
/// are set.
#[derive(Clone, Copy, Debug)]
pub struct Kinematics<L: Lane, T: SymmetricTensor<L>> {
    /// Step that led here, s; zero in the first evaluation.
    pub time_step: L,
    /// Rate: Δε, symmetric part of the displacement increment's gradient in the mid-step configuration,
    /// rotated to the end of the step.
    pub strain_increment: T,
    /// Rate: rotation over the step, for tensors in the law's own state (the stress is rotated already); set
    /// with [`Law::NEEDS_ROTATION`].
    pub rotation: T::Rotation,
    /// Rate: old Cauchy stress, rotated to the end of the step, Pa.
    pub stress_rotated: T,
    /// Hyperelastic: b = F Fᵀ.
    pub left_cauchy_green: T,
    /// Hyperelastic: J = det F. Rate: current volume of the element over its initial volume; set with
    /// [`Law::NEEDS_VOLUME`].
    pub volume_ratio: L,
    /// Work that the bulk viscosity took from the element in the step before, J per m³ of initial volume; set
    /// with [`Law::NEEDS_VOLUME`].
    pub viscous_heat: L,
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

impl<L: Lane, T: SymmetricTensor<L>> Response<L, T> {
    /// Of a rate law whose stiffness does not change: `bulk` and `shear`, Pa.
    #[inline(always)]
    #[must_use]
    pub fn rate(stress: T, dissipated: L, [bulk, shear]: [f64; 2]) -> Self {
        Self { stress, stored: L::splat(0.0), dissipated, bulk: L::splat(bulk), shear: L::splat(shear) }
    }
}

/// A layer of a shell whose axes 1 and 2 are in it and 3 across, at the end of a step: tensors have the
/// components 11, 22, 33, 12, 23, 31, and σ₃₃ = 0.
#[derive(Clone, Copy, Debug)]
pub struct Layer<L> {
    /// Cauchy stress, Pa.
    pub stress: [L; 6],
    /// Δε₃₃.
    pub across: L,
    /// Energy dissipated in the step per current volume, J/m³; never negative.
    pub dissipated: L,
}

/// A point under uniaxial stress along 1, and with a shear stress 12 beside it, at the end of a step.
#[derive(Clone, Copy, Debug)]
pub struct Fibre<L> {
    /// Cauchy stress 11 and 12, Pa.
    pub stress: [L; 2],
    /// Δε₂₂ = Δε₃₃.
    pub across: L,
    /// As in [`Layer`].
    pub dissipated: L,
}

/// A material law. `update` must be `#[inline(always)]`: it becomes part of the block's kernel.
pub trait Law: Copy + Send + Sync + 'static {
    /// Name, parameters and source.
    const KIND: LawKind;
    /// Which measures it works on.
    const FAMILY: Family;
    /// History values of a point: `[L; N]`, [`Tensors`], [`Orientation`], or a pair of such.
    type State<L: Lane, T: SymmetricTensor<L>>: State<L>;
    /// History variables that are output as fields, with their places in the state.
    const VARIABLES: &'static [History] = &[];
    /// Whether it has tensors in its state that turn with the material.
    const NEEDS_ROTATION: bool = false;
    /// Whether a rate law needs the volume ratio and the heat of the bulk viscosity.
    const NEEDS_VOLUME: bool = false;
    /// Whether it takes energy for good; what is shown of its history (plastic strain, damage) grows with
    /// such.
    const DISSIPATES: bool = !Self::VARIABLES.is_empty();
    /// Whether it answers alike in all directions at rest. Where it does not, bulk and shear stiffness are
    /// bounds of the waves.
    const ISOTROPIC: bool = true;
    /// Whether its flow changes the mean stress, which no equation of state may then replace.
    const FLOWS_IN_VOLUME: bool = false;
    /// Whether it has no pressure of its own.
    const NEEDS_EQUATION_OF_STATE: bool = false;
    /// Whether a point can continue with a weighted mean of the stresses and states of others: then elements
    /// can be made again in the run.
    const CAN_BE_AVERAGED: bool = false;

    /// Kinds of messages that it alone reports.
    const MESSAGES: &'static [&'static Message] = &[];

    /// Reads its parameters, which have been checked against [`Law::KIND`].
    fn new(parameters: &Parameters<'_>) -> Self;

    /// What is wrong with its parameters beyond the range of each: lists of unequal lengths, tables out of
    /// order.
    fn faults(_parameters: &Parameters<'_>) -> Vec<ParameterFault> {
        Vec::new()
    }

    /// How its flow stress falls with plastic strain; `None` where it does not.
    fn softening(_parameters: &Parameters<'_>) -> Option<Softening> {
        None
    }

    /// The parameter that says the flow stress (Pa) before anything has flown, and how much that is; `None`
    /// where it does not flow by a flow stress.
    fn first_flow(parameters: &Parameters<'_>) -> Option<(&'static str, f64)> {
        let given = |parameter: &Parameter| match parameter.list {
            0 => Some(parameters.value(parameter.name)),
            _ => parameters.list(parameter.name).first().copied(),
        };
        let says = |parameter: &&Parameter| [hardening::YIELD.name, hardening::STRESS.name].contains(&parameter.name);
        let own = Self::KIND.parameters.iter().find(says)?;
        Some((own.name, given(own)?))
    }

    /// Plastic strain at which the table of its flow stress ends; `None` where it has none.
    fn table_end(_parameters: &Parameters<'_>) -> Option<f64> {
        None
    }

    /// History at the start, zero unless the law says otherwise.
    fn start<L: Lane, T: SymmetricTensor<L>>(&self) -> Self::State<L, T> {
        State::zero()
    }

    /// Renews what a state keeps that follows from the rest of it, where that is a mean of others
    /// ([`Law::CAN_BE_AVERAGED`]).
    fn renew<L: Lane, T: SymmetricTensor<L>>(&self, _state: &mut Self::State<L, T>) {}

    /// Stress at the end of the step.
    fn update<L: Lane, T: SymmetricTensor<L>>(&self, kinematics: &Kinematics<L, T>, state: &mut Self::State<L, T>) -> Response<L, T>;

    /// Whether it knows the stress of a layer that nothing holds across by itself: [`Law::layer`].
    fn has_layer(&self) -> bool {
        false
    }

    /// Rate: what [`Law::update`] would give with the strain across at which the stress across vanishes,
    /// where [`Law::has_layer`]; see [`Layer`].
    #[inline(always)]
    fn layer<L: Lane, T: SymmetricTensor<L>>(&self, _strain: [L; 6], old: [L; 6], _state: &mut Self::State<L, T>) -> Layer<L> {
        Layer { stress: old, across: L::splat(0.0), dissipated: L::splat(0.0) }
    }

    /// Whether it knows the stress of a fibre by itself: [`Law::fibre`].
    fn has_fibre(&self) -> bool {
        false
    }

    /// Rate: what [`Law::update`] would give with the strains across at which the stresses across vanish,
    /// where [`Law::has_fibre`], from Δε₁₁ and Δε₁₂ and the old stresses; see [`Fibre`].
    #[inline(always)]
    fn fibre<L: Lane, T: SymmetricTensor<L>>(&self, _strain: [L; 2], old: [L; 2], _state: &mut Self::State<L, T>) -> Fibre<L> {
        Fibre { stress: old, across: L::splat(0.0), dissipated: L::splat(0.0) }
    }

    /// Bulk and shear stiffness at rest, Pa.
    fn stiffness(&self) -> [f64; 2];

    /// Of a law whose K and µ are not those of an isotropic body: bound of the modulus ρc² of waves in the
    /// plane 12 where nothing holds across, Pa.
    fn sheet_modulus(&self) -> f64 {
        0.0
    }

    /// Rate: elastic energy ½ σ:C⁻¹:σ of a stress xx yy zz xy yz zx that a point has at the start, J/m³.
    fn energy(&self, stress: [f64; 6]) -> f64 {
        elastic_energy(self.stiffness(), stress)
    }
}

/// p²/2K + s:s/4µ with the stiffnesses K and µ (Pa) of a stress xx yy zz xy yz zx (Pa), J/m³; without shear
/// stiffness the first alone.
fn elastic_energy([bulk, shear]: [f64; 2], stress: [f64; 6]) -> f64 {
    let (mean, deviator) = (Solid(stress).trace() / 3.0, Solid(stress).deviator());
    let square = deviator.contract(deviator);
    mean * mean / (2.0 * bulk) + if shear > 0.0 { square / (4.0 * shear) } else { 0.0 }
}

/// Someone who does something with every law's type: makes a block of it, lists it, tests it.
pub trait LawVisitor {
    /// What comes out.
    type Output;
    /// The work for the law `M`.
    fn visit<M: Law>(self) -> Self::Output;
}

/// The registry: one line per file of laws.
macro_rules! laws {
    ($($file:ident: $($law:ident),+;)*) => {
        $(mod $file; pub use $file::{$($law),+};)*

        /// Every law, in the order in which it is listed.
        pub const LAWS: &[LawKind] = &[$($(<$law as Law>::KIND),+),*];

        const OF_LAWS: &[&[&Message]] = &[$($(<$law as Law>::MESSAGES),+),*];

        const VARIABLES_OF_LAWS: &[&[History]] = &[$($(<$law as Law>::VARIABLES),+),*];

        /// Calls `visitor` with the law called `name`; `None` when there is none.
        pub fn with_law<V: LawVisitor>(name: &str, visitor: V) -> Option<V::Output> {
            match name {
                $($(n if n == <$law as Law>::KIND.name => Some(visitor.visit::<$law>()),)+)*
                _ => None,
            }
        }
    };
}

laws! {
    elastic: Elastic;
    orthotropic_elastic: OrthotropicElastic;
    j2: J2, J2Voce, J2Swift, J2Ludwik, J2Table;
    chaboche: Chaboche;
    johnson_cook: JohnsonCook;
    drucker_prager: DruckerPrager;
    crushable_foam: CrushableFoam;
    neo_hookean: NeoHookean;
    mooney_rivlin: MooneyRivlin;
    yeoh: Yeoh;
    arruda_boyce: ArrudaBoyce;
    ogden: Ogden;
    viscoelastic: Viscoelastic;
    null: Null;
}

/// Largest number of variables that a material can output: those of its law and of its equation of state.
pub const VARIABLES_MOST: usize = variable::most(VARIABLES_OF_LAWS) + eos::VARIABLES.len();

/// The variables of all laws, each once, in the order of the registry.
#[must_use]
pub fn variables() -> Vec<&'static Variable> {
    variable::union(VARIABLES_OF_LAWS)
}

/// Kinds of messages that only laws report.
pub(crate) fn messages() -> impl Iterator<Item = &'static Message> {
    OF_LAWS.iter().flat_map(|of_law| of_law.iter().copied())
}

/// What the law called `name` finds wrong with parameters whose ranges are right.
#[must_use]
pub fn faults(name: &str, parameters: &Parameters<'_>) -> Vec<ParameterFault> {
    struct Check<'a>(&'a Parameters<'a>);
    impl LawVisitor for Check<'_> {
        type Output = Vec<ParameterFault>;
        fn visit<M: Law>(self) -> Self::Output {
            M::faults(self.0)
        }
    }
    with_law(name, Check(parameters)).unwrap_or_default()
}

/// How the flow stress of the law called `name` falls with plastic strain; `None` where it does not.
/// Parameters are sound.
#[must_use]
pub fn softening(name: &str, parameters: &Parameters<'_>) -> Option<Softening> {
    struct Ask<'a>(&'a Parameters<'a>);
    impl LawVisitor for Ask<'_> {
        type Output = Option<Softening>;
        fn visit<M: Law>(self) -> Self::Output {
            M::softening(self.0)
        }
    }
    with_law(name, Ask(parameters)).flatten()
}

/// The parameter and the flow stress (Pa) with which the law called `name` begins to flow; `None` where it
/// does not. Parameters are sound.
#[must_use]
pub fn first_flow(name: &str, parameters: &Parameters<'_>) -> Option<(&'static str, f64)> {
    struct Ask<'a>(&'a Parameters<'a>);
    impl LawVisitor for Ask<'_> {
        type Output = Option<(&'static str, f64)>;
        fn visit<M: Law>(self) -> Self::Output {
            M::first_flow(self.0)
        }
    }
    with_law(name, Ask(parameters)).flatten()
}

/// Plastic strain at which the table of the law called `name` ends; `None` where it has none. Parameters are
/// sound.
#[must_use]
pub fn table_end(name: &str, parameters: &Parameters<'_>) -> Option<f64> {
    struct Ask<'a>(&'a Parameters<'a>);
    impl LawVisitor for Ask<'_> {
        type Output = Option<f64>;
        fn visit<M: Law>(self) -> Self::Output {
            M::table_end(self.0)
        }
    }
    with_law(name, Ask(parameters)).flatten()
}

/// Bulk and shear stiffness at rest of the law called `name`, Pa; `None` when there is no such law.
/// Parameters are sound.
#[must_use]
pub fn stiffness(name: &str, parameters: &Parameters<'_>) -> Option<[f64; 2]> {
    struct Ask<'a>(&'a Parameters<'a>);
    impl LawVisitor for Ask<'_> {
        type Output = [f64; 2];
        fn visit<M: Law>(self) -> Self::Output {
            M::new(self.0).stiffness()
        }
    }
    with_law(name, Ask(parameters))
}

/// What a law declares of itself besides its parameters.
#[derive(Clone, Copy, Debug)]
struct Facts {
    family: Family,
    is_isotropic: bool,
    flows_in_volume: bool,
    needs_equation_of_state: bool,
    has_plastic_strain: bool,
    can_be_averaged: bool,
}

fn facts(name: &str) -> Option<Facts> {
    struct Ask;
    impl LawVisitor for Ask {
        type Output = Facts;
        fn visit<M: Law>(self) -> Self::Output {
            Facts {
                family: M::FAMILY,
                is_isotropic: M::ISOTROPIC,
                flows_in_volume: M::FLOWS_IN_VOLUME,
                needs_equation_of_state: M::NEEDS_EQUATION_OF_STATE,
                has_plastic_strain: M::VARIABLES.iter().any(|history| history.variable == &variable::PLASTIC_STRAIN),
                can_be_averaged: M::CAN_BE_AVERAGED,
            }
        }
    }
    with_law(name, Ask)
}

/// Whether the law called `name` has its stress from the whole deformation; `None` when there is no such law.
#[must_use]
pub fn is_hyperelastic(name: &str) -> Option<bool> {
    facts(name).map(|law| law.family == Family::Hyperelastic)
}

/// Whether the law called `name` flows plastically, and keeps its volume in doing so; `None` when there is no
/// such law.
#[must_use]
pub fn flows_at_constant_volume(name: &str) -> Option<bool> {
    facts(name).map(|law| law.has_plastic_strain && !law.flows_in_volume)
}

/// Whether a point of the law called `name` can continue with a weighted mean of what others have; `None`
/// when there is no such law.
#[must_use]
pub fn can_be_averaged(name: &str) -> Option<bool> {
    facts(name).map(|law| law.can_be_averaged)
}

/// Whether the law called `name` needs an equation of state, and whether it may have one; `None` when there
/// is no such law.
#[must_use]
pub fn equation_of_state(name: &str) -> Option<[bool; 2]> {
    facts(name).map(|law| [law.needs_equation_of_state, law.family == Family::Rate && !law.flows_in_volume])
}

/// Whether the law called `name` is that of an isotropic solid in rate form, whose K and µ are an elastic
/// stiffness; `None` when there is no such law.
#[must_use]
pub fn has_elastic_stiffness(name: &str) -> Option<bool> {
    facts(name).map(|law| law.family == Family::Rate && law.is_isotropic && !law.needs_equation_of_state)
}

/// Whether bars can be of the law called `name`: it answers alike in all directions, and is no fluid; `None`
/// when there is no such law.
#[must_use]
pub fn bears_uniaxial_stress(name: &str) -> Option<bool> {
    facts(name).map(|law| law.is_isotropic && !law.needs_equation_of_state)
}

/// Every law.
#[must_use]
pub fn registry() -> Vec<LawKind> {
    LAWS.to_vec()
}
