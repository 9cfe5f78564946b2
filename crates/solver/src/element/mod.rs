//! Elements as declared facts plus two functions: the map from nodal vectors to natural gradients, and its transpose.
//!
//! Everything else (strain, internal force, volume) follows in the block. To add an element: one file, one line in `elements!`.

mod bar2;
mod quad4;
mod quad4_reduced;
mod tri3;

pub use bar2::BAR2;
pub use quad4::{Quad4, Quad4Full};
pub use quad4_reduced::{Quad4Reduced, Quad4ReducedAssumedStrain, Quad4ReducedViscous};
pub use tri3::{Tri3, Tri3Anp};

use crate::tensor::{Dim, Matrix, Space};
use embate_lanes::Lane;

/// An element as the registry describes it.
#[derive(Clone, Copy, Debug)]
pub struct ElementKind {
    /// Name in the model file.
    pub name: &'static str,
    /// One line: what it is and when to take it.
    pub doc: &'static str,
    /// Where its equations come from.
    pub source: &'static str,
    /// Nodes per element.
    pub nodes: usize,
}

/// An element of dimension `D` with `N` nodes and `P` quadrature points. The functions must be `#[inline(always)]`.
pub trait Element<const D: usize, const N: usize, const P: usize>: Copy + Send + Sync + 'static
where
    Dim<D>: Space<D>,
{
    /// Name and source.
    const KIND: ElementKind;
    /// Natural coordinates of the points.
    const POINTS: [[f64; D]; P];
    /// Weights of the points.
    const WEIGHTS: [f64; P];
    /// Natural coordinates of the nodes.
    const NODES: [[f64; D]; N];
    /// Whether the dilatation is averaged over the element (B-bar), which keeps plastic flow and rubber from locking.
    const MEAN_DILATATION: bool;
    /// Whether the dilatation is averaged over the nodes of the block and back (`block/nodal.rs`); for elements with one point.
    const NODAL_DILATATION: bool = false;
    /// Batches that hourglass control keeps per element, at most [`KEPT`]; 0: none is needed.
    const HOURGLASS: usize = 0;
    /// Whether that control follows the amplitude of the pattern from step to step and keeps a force against it, which turns with the element.
    const SWINGS: bool = false;

    /// The element with its options.
    fn new(options: &ElementOptions) -> Self;

    /// Shape functions at natural coordinates.
    fn shape(natural: [f64; D]) -> [f64; N];
    /// Gradient of a nodal vector with respect to the natural coordinates, at every point: `out[p][i][k]` = Σ_a u_a,i ∂N_a/∂ξ_k.
    fn gradients<L: Lane>(nodal: &[[L; D]; N]) -> [Matrix<L, D>; P];
    /// The transpose of [`Element::gradients`]: `out[a][i]` = Σ_p Σ_k flux_p,ik ∂N_a/∂ξ_k.
    fn divergence<L: Lane>(flux: &[Matrix<L, D>; P]) -> [[L; D]; N];
    /// Square of the element's thickness h, m², as numerator and denominator, so that the step costs one division: dt = h / c is stable for waves of speed c when
    /// every corner has the mass share 1/N. `determinants` are those of the Jacobian at the points, `volume` their weighted sum.
    fn thickness_squared<L: Lane>(nodal: &[[L; D]; N], determinants: &[L; P], volume: L) -> [L; 2];
    /// Exact ∫ N_a dA of every corner, or ∫ 2πx N_a dA of a body of revolution; `None`: the points' sums are exact enough.
    fn corner_volumes(_nodal: &[[f64; D]; N], _is_axisymmetric: bool) -> Option<[f64; N]> {
        None
    }
    /// Change of the amplitude q of the shape that the points do not feel, m, in a `step` of the nodes to `x` whose displacement gradient at mid-step is known.
    /// Called only where hourglass control follows it ([`Element::SWINGS`]).
    #[inline(always)]
    fn swing<L: Lane>(_x: &[[L; D]; N], _step: &[[L; D]; N], _gradient: &Matrix<L, D>) -> [L; D] {
        [L::splat(0.0); D]
    }
    /// Forces against the shapes that the points do not feel. Called only where hourglass control keeps something.
    #[inline(always)]
    fn hold_shape<L: Lane>(&self, corners: &Corners<L, D, N>) -> Held<L, D, N> {
        let zero = L::splat(0.0);
        Held { forces: [[zero; D]; N], kept: corners.kept, work: zero, stiffening: L::splat(1.0) }
    }
}

/// What a user may choose of an element.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ElementOptions {
    /// Coefficient of hourglass control; `None`: that of the control's source.
    pub hourglass: Option<f64>,
}

/// Most batches that hourglass control keeps per element.
pub const KEPT: usize = 5;

/// What hourglass control reads.
#[derive(Clone, Copy, Debug)]
pub struct Corners<L, const D: usize, const N: usize> {
    /// Positions, m.
    pub x: [[L; D]; N],
    /// Change of the amplitude in the step that led there, m, in directions of its end.
    pub swing: [L; D],
    /// What was kept at its beginning; a force that follows the amplitude is turned to its end.
    pub kept: [L; KEPT],
    /// Area, m².
    pub area: L,
    /// Volume: area times depth, m² (m³).
    pub volume: L,
    /// K + 4µ/3, Pa.
    pub modulus: L,
    /// µ, Pa.
    pub shear: L,
    /// Against hourglass shapes: K + 4µ/3, of solids at most 4µ, Pa.
    pub shape_modulus: L,
    /// Mass in the stable step, kg/m (kg).
    pub mass: L,
    /// One over the step, 1/s; 0 where there was none.
    pub rate: L,
    /// Whether there was none: these are the positions at time zero.
    pub is_start: bool,
    /// Whether there is no stress normal to the plane.
    pub is_plane_stress: bool,
}

/// What hourglass control answers.
#[derive(Clone, Copy, Debug)]
pub struct Held<L, const D: usize, const N: usize> {
    /// Forces against which the nodes move, as those of the stresses: f_a = ∂W/∂x_a, N/m.
    pub forces: [[L; D]; N],
    /// What is kept until the next step.
    pub kept: [L; KEPT],
    /// Work taken from the nodes in the step by the trapezoidal rule where control follows the amplitude, else the energy that is stored, J/m.
    pub work: L,
    /// Square of the stable step without it over that with it, at least 1.
    pub stiffening: L,
}

/// Someone who does something with every element's type.
pub trait ElementVisitor {
    /// What comes out.
    type Output;
    /// The work for an element of the plane.
    fn visit<E: Element<2, N, P>, const N: usize, const P: usize>(self) -> Self::Output;
}

/// The registry: one line per element, with its nodes and points.
macro_rules! elements {
    ($($element:ident: $nodes:literal nodes, $points:literal points),* $(,)?) => {
        /// Every element, in the order in which it is listed.
        pub const ELEMENTS: &[ElementKind] = &[$(<$element as Element<2, $nodes, $points>>::KIND),*];

        /// Calls `visitor` with the element called `name`; `None` when there is none.
        pub fn with_element<V: ElementVisitor>(name: &str, visitor: V) -> Option<V::Output> {
            match name {
                $(n if n == <$element as Element<2, $nodes, $points>>::KIND.name => Some(visitor.visit::<$element, $nodes, $points>()),)*
                _ => None,
            }
        }
    };
}

elements!(
    Quad4: 4 nodes, 4 points,
    Quad4Full: 4 nodes, 4 points,
    Quad4Reduced: 4 nodes, 1 points,
    Quad4ReducedViscous: 4 nodes, 1 points,
    Quad4ReducedAssumedStrain: 4 nodes, 1 points,
    Tri3: 3 nodes, 1 points,
    Tri3Anp: 3 nodes, 1 points,
);

/// Elements that are lines: blocks of their own make them, not the kernels that [`Element`]s are compiled into.
pub const BARS: &[ElementKind] = &[BAR2];

/// Every element.
#[must_use]
pub fn registry() -> Vec<ElementKind> {
    ELEMENTS.iter().chain(BARS).copied().collect()
}
