//! Equations of state: pressure from the volume and the heat of a point, in place of the mean stress of a
//! rate law.
//!
//! An equation is written once, as the [`Terms`] of p = cold(v) + heat(v) E, with v = V/V₀ and E the energy
//! per initial volume, J/m³. All are linear in E, so the energy balance of a step is solved in closed form.
//! `point.rs` puts an equation around any rate law, erased: equations and laws are compiled one by one, not
//! pair by pair. To add an equation: one file, one line in `equations_of_state!`.

mod ideal_gas;
mod jwl;
mod linear;
mod mie_gruneisen;
mod point;
mod polynomial;
#[cfg(test)]
mod tests;

pub use ideal_gas::IdealGas;
pub use jwl::Jwl;
pub use linear::Linear;
pub use mie_gruneisen::MieGruneisen;
pub use polynomial::Polynomial;

pub(crate) use point::VARIABLES;

use super::variable::{self, Variable};
use super::{ParameterFault, Parameters, points::PointLaw};
use crate::material::messages::PARAMETERS;
use crate::model::Material;
use crate::quantity::{Dimension, Parameter, Range};
use crate::tensor::{Dim, Space};
use embate_lanes::Lane;

/// An equation of state as the registry describes it.
#[derive(Clone, Copy, Debug)]
pub struct EquationKind {
    /// Name in the model file.
    pub name: &'static str,
    /// One line: what it is.
    pub doc: &'static str,
    /// Where it comes from.
    pub source: &'static str,
    /// Parameters besides those of the law.
    pub parameters: &'static [Parameter],
}

/// p = `cold` + `heat` E at a volume ratio v, with the slopes over v.
#[derive(Clone, Copy, Debug)]
pub struct Terms<L> {
    /// Pressure without energy, Pa.
    pub cold: L,
    /// d cold / dv, Pa.
    pub cold_slope: L,
    /// Pressure per energy.
    pub heat: L,
    /// d heat / dv.
    pub heat_slope: L,
}

impl<L: Lane> Terms<L> {
    /// Pressure, Pa.
    #[inline(always)]
    pub fn pressure(&self, energy: L) -> L {
        self.cold + self.heat * energy
    }

    /// ρc² = −v dp/dv without heat from outside (dE = −p dv), Pa.
    #[inline(always)]
    pub fn bulk(&self, ratio: L, energy: L) -> L {
        let slope = self.cold_slope + self.heat_slope * energy - self.heat * self.pressure(energy);
        -(ratio * slope)
    }
}

/// An equation of state. `terms` must be `#[inline(always)]`: it becomes part of a kernel.
pub trait Equation: Copy + Send + Sync + 'static {
    /// Name, parameters and source.
    const KIND: EquationKind;

    /// Reads its parameters, which have been checked against [`Equation::KIND`]; `density` is there too.
    fn new(parameters: &Parameters<'_>) -> Self;

    /// What is wrong with its parameters beyond the range of each.
    fn faults(_parameters: &Parameters<'_>) -> Vec<ParameterFault> {
        Vec::new()
    }

    /// The terms at the volume ratio `ratio`.
    fn terms<L: Lane>(&self, ratio: L) -> Terms<L>;

    /// Energy per initial volume at the start, J/m³.
    fn energy(&self) -> f64;
}

/// Energy at the start, of equations that need none.
pub(super) const ENERGY: Parameter =
    Parameter::new("energy_initial", "E_0", Dimension::PRESSURE, Range::NotNegative, "energy at the start per initial volume, J/m^3")
        .such_as("7 GPa");

/// What every equation may have besides: the limit of its pressure in tension. Left out: none.
pub const TENSION: Parameter = Parameter::new(
    "tension",
    "p_t",
    Dimension::PRESSURE,
    Range::NotNegative,
    "largest tension that the pressure reaches: 0 for a liquid that cavitates, the spall strength of a solid",
)
.such_as("0 Pa");

/// Someone who does something with an equation's type.
trait EquationVisitor {
    type Output;
    fn visit<Q: Equation>(self) -> Self::Output;
}

/// The registry: one line per equation.
macro_rules! equations_of_state {
    ($($equation:ident),* $(,)?) => {
        /// Every equation of state, in the order in which it is listed.
        pub const EQUATIONS: &[EquationKind] = &[$(<$equation as Equation>::KIND),*];

        /// Calls `visitor` with the equation called `name`; `None` when there is none.
        fn with_equation<V: EquationVisitor>(name: &str, visitor: V) -> Option<V::Output> {
            match name {
                $(n if n == <$equation as Equation>::KIND.name => Some(visitor.visit::<$equation>()),)*
                _ => None,
            }
        }
    };
}

equations_of_state!(Linear, MieGruneisen, Polynomial, IdealGas, Jwl);

/// The variables of points with an equation of state, besides those of their law.
#[must_use]
pub fn variables() -> Vec<&'static Variable> {
    variable::union(&[VARIABLES])
}

/// The equation called `name`.
#[must_use]
pub fn kind(name: &str) -> Option<&'static EquationKind> {
    EQUATIONS.iter().find(|kind| kind.name == name)
}

/// What the equation called `name` finds wrong with parameters whose ranges are right. A material that has no
/// stiffness at rest is one of the faults.
#[must_use]
pub fn faults(name: &str, parameters: &Parameters<'_>) -> Vec<ParameterFault> {
    struct Check<'a>(&'a Parameters<'a>);
    impl EquationVisitor for Check<'_> {
        type Output = Vec<ParameterFault>;
        fn visit<Q: Equation>(self) -> Self::Output {
            let mut faults = Q::faults(self.0);
            let equation = Q::new(self.0);
            let bulk = equation.terms(1.0).bulk(1.0, equation.energy());
            let (pressure, limit) = (equation.terms(1.0).pressure(equation.energy()), limit(self.0));
            if faults.is_empty() && pressure < -limit {
                faults.push(ParameterFault {
                    kind: &PARAMETERS,
                    name: TENSION.name,
                    message: format!("at the start the pressure is {pressure:.3e} Pa, a tension beyond the limit of {limit:.3e} Pa"),
                    help: "raise the limit, or begin with less tension".to_string(),
                });
            }
            if faults.is_empty() && !(bulk > 0.0 && bulk.is_finite()) {
                faults.push(ParameterFault {
                    kind: &PARAMETERS,
                    name: "eos",
                    message: format!("with these parameters the bulk stiffness at rest is {bulk:.3e} Pa, so no wave could run"),
                    help: "check signs and units of its parameters; it must be greater than 0".to_string(),
                });
            }
            faults
        }
    }
    with_equation(name, Check(parameters)).unwrap_or_default()
}

/// The limit in tension of parameters, Pa; infinite where there is none.
fn limit(parameters: &Parameters<'_>) -> f64 {
    parameters.given(TENSION.name).unwrap_or(f64::INFINITY)
}

/// `law` with the pressure of the material's equation of state; as it is where there is none.
pub(super) fn around<const D: usize>(law: Box<dyn PointLaw>, material: &Material) -> Option<Box<dyn PointLaw>>
where
    Dim<D>: Space<D>,
{
    struct Make<'a, const D: usize>(Box<dyn PointLaw>, &'a Material);
    impl<const D: usize> EquationVisitor for Make<'_, D>
    where
        Dim<D>: Space<D>,
    {
        type Output = Box<dyn PointLaw>;
        fn visit<Q: Equation>(self) -> Self::Output {
            let parameters = Parameters::new(Q::KIND.parameters, &self.1.parameters, &self.1.lists);
            Box::new(point::WithEquation::<Q, D>::new(self.0, Q::new(&parameters), parameters.value("density"), limit(&parameters)))
        }
    }
    if material.eos.is_empty() { Some(law) } else { with_equation(&material.eos, Make::<D>(law, material)) }
}
