//! Stress states of 2D models: plane strain, plane stress, axisymmetric. Kernels of elements
//! are compiled for each; laws do not know them, but for the adapter of plane stress.
//!
//! Plane strain and plane stress count per metre of (initial) depth. An axisymmetric body has the radius x
//! and the axis y, and all of the circumference 2πx is counted: forces in N, masses in kg, energies in J.

/// A stress state as the registry describes it.
#[derive(Clone, Copy, Debug)]
pub struct StressStateKind {
    /// Name in the model file.
    pub name: &'static str,
    /// One line: what it is and when to take it.
    pub doc: &'static str,
    /// Where its equations come from.
    pub source: &'static str,
    /// What kernels know of it.
    pub state: StressState,
}

/// A stress state as kernels know it. In 3D it is [`StressState::SPACE`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StressState {
    /// Whether x is the radius: volumes carry the factor 2πx, and the hoop strain is u_x / x.
    pub is_axisymmetric: bool,
    /// Whether the stress normal to the plane vanishes: volumes carry the thickness ratio λ, and dilatations
    /// are not averaged (nothing locks).
    pub is_plane_stress: bool,
}

impl StressState {
    /// Of solids in 3D, and of plane strain.
    pub const SPACE: Self = Self { is_axisymmetric: false, is_plane_stress: false };

    /// What a kernel of dimension `D` sees: in 3D a constant, so that it is compiled without the others.
    #[inline(always)]
    #[must_use]
    pub const fn of<const D: usize>(self) -> Self {
        if D == 2 { self } else { Self::SPACE }
    }

    /// The stress state called `name` (empty: the default); `None` when there is none.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let name = if name.is_empty() { STRESS_STATES[0].name } else { name };
        STRESS_STATES.iter().find(|kind| kind.name == name).map(|kind| kind.state)
    }
}

/// No stress normal to the plane.
pub const PLANE_STRESS: StressStateKind = StressStateKind {
    name: "plane_stress",
    doc: "thin sheets loaded in their plane: no stress normal to it; the thickness follows",
    source: "de Borst, Int. J. Numer. Meth. Engng 32 (1991) 1169-1180",
    state: StressState { is_axisymmetric: false, is_plane_stress: true },
};

/// Every stress state, the default first.
pub const STRESS_STATES: &[StressStateKind] = &[
    StressStateKind {
        name: "plane_strain",
        doc: "long bodies: no strain normal to the plane",
        source: "Hughes, The Finite Element Method (1987), 2.7",
        state: StressState::SPACE,
    },
    PLANE_STRESS,
    StressStateKind {
        name: "axisymmetric",
        doc: "axisymmetric bodies about the y axis, x is the radius; volume-weighted",
        source: "Hughes, The Finite Element Method (1987), 2.12 and 4.5.2",
        state: StressState { is_axisymmetric: true, is_plane_stress: false },
    },
];
