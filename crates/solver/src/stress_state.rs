//! Stress states of 2D models: plane strain, plane stress, axisymmetric. Kernels of elements
//! are compiled for each; laws do not know them, but for the adapter of plane stress.
//!
//! Plane strain and plane stress count per metre of (initial) depth. An axisymmetric body has the radius x
//! and the axis y, and all of the circumference 2πx is counted: forces in N, masses in kg, energies in J.

use embate_lanes::Lane;

/// Modulus ρc² of the fastest wave in a sheet in plane stress of an isotropic elastic body, Pa, from K and µ:
/// λ* + 2µ with λ* = 2µλ/(λ + 2µ), which is E/(1 − ν²). It grows with both, and so bounds every body whose
/// tangent is at most that of the elastic one: what is left of a tangent when the stress across vanishes (its
/// Schur complement) grows with it.
#[inline(always)]
pub(crate) fn sheet_modulus<L: Lane>(bulk: L, shear: L) -> L {
    let (three, four) = (L::splat(3.0) * bulk, L::splat(4.0) * shear);
    four * (three + shear) / (three + four)
}

/// The same of a hyperelastic body, whose K and µ bound waves in the bulk: 4Kr/(K + r) with r = 4µ/3 where K
/// is larger than r, else K + r. A third more than [`sheet_modulus`] at most (where nothing changes volume).
///
/// Across there is only H_zz = h. The energy of any h is a bound of that of the h without stress; with h = −s
/// (a·n) the pressure, which drops out of waves in the bulk, does so again: σ_zz = 0 makes it the deviator's.
/// With the principal values D_ij, G of `material/ogden.rs` (D_33 and G + |D_i3| at most r), J = 1:
///
/// ```text
/// ρc² ≤ K (1 − s)² + r + 2 s r + s² r,   least at s = (K − r)/(K + r).
/// ```
#[inline(always)]
pub(crate) fn rubber_sheet_modulus<L: Lane>(bulk: L, shear: L) -> L {
    let rest = L::splat(4.0 / 3.0) * shear;
    let (both, four) = (bulk + rest, L::splat(4.0));
    L::select(rest.less(bulk), four * bulk * rest / both, both)
}

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
