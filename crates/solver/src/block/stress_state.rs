//! Stress states: what the plane stands for. Compiled into the kernels of the elements; laws do not know it, but for the adapter of plane stress.
//!
//! Plane strain and plane stress count per metre of (initial) depth. An axisymmetric body has the radius x and the axis y, and all of the
//! circumference 2πx is counted: forces in N, masses in kg, energies in J.

/// A stress state as the registry describes it.
#[derive(Clone, Copy, Debug)]
pub struct StressStateKind {
    /// Name in the model file.
    pub name: &'static str,
    /// One line: what it is and when to take it.
    pub doc: &'static str,
    /// Where its equations come from.
    pub source: &'static str,
    /// Whether x is a radius.
    pub axisymmetric: bool,
}

/// A stress state.
pub trait StressState: Copy + Send + Sync + 'static {
    /// Name and source.
    const KIND: StressStateKind;
    /// Whether x is the radius: volumes carry the factor 2πx, and the hoop strain is u_x / x.
    const AXISYMMETRIC: bool;
    /// Whether the stress normal to the plane vanishes: volumes carry the thickness ratio λ, and dilatations are not averaged (nothing locks).
    const PLANE_STRESS: bool;
}

macro_rules! stress_states {
    ($($(#[$doc:meta])* $state:ident: $axisymmetric:literal, $plane_stress:literal, $name:literal, $text:literal, $source:literal;)*) => {
        $($(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $state;

        impl StressState for $state {
            const KIND: StressStateKind = StressStateKind { name: $name, doc: $text, source: $source, axisymmetric: $axisymmetric };
            const AXISYMMETRIC: bool = $axisymmetric;
            const PLANE_STRESS: bool = $plane_stress;
        })*

        /// Every stress state, the default first.
        pub const STRESS_STATES: &[StressStateKind] = &[$(<$state as StressState>::KIND),*];

        /// Calls `visitor` with the stress state called `name` (empty: the default); `None` when there is none.
        pub fn with_stress_state<V: StressStateVisitor>(name: &str, visitor: V) -> Option<V::Output> {
            let name = if name.is_empty() { STRESS_STATES[0].name } else { name };
            match name {
                $($name => Some(visitor.visit::<$state>()),)*
                _ => None,
            }
        }
    };
}

/// Bodies of space, which need no such state: what kernels of solids are compiled with. It is not listed, since the plane can't be in it.
#[derive(Clone, Copy, Debug)]
pub struct InSpace;

impl StressState for InSpace {
    const KIND: StressStateKind =
        StressStateKind { name: "", doc: "bodies of space", source: "Hughes, The Finite Element Method (1987), 2.7", axisymmetric: false };
    const AXISYMMETRIC: bool = false;
    const PLANE_STRESS: bool = false;
}

/// Someone who does something with every stress state's type.
pub trait StressStateVisitor {
    /// What comes out.
    type Output;
    /// The work for the stress state `S`.
    fn visit<S: StressState>(self) -> Self::Output;
}

stress_states! {
    /// No strain normal to the plane.
    PlaneStrain: false, false, "plane_strain", "long bodies: no strain normal to the plane", "Hughes, The Finite Element Method (1987), 2.7";
    /// No stress normal to the plane.
    PlaneStress: false, true, "plane_stress", "thin sheets loaded in their plane: no stress normal to it; the thickness follows", "de Borst, Int. J. Numer. Meth. Engng 32 (1991) 1169-1180";
    /// Bodies of revolution.
    Axisymmetric: true, false, "axisymmetric", "bodies of revolution about the y axis, x is the radius; volume-weighted", "Hughes, The Finite Element Method (1987), 2.12 and 4.5.2";
}
