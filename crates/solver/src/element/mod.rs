//! Element formulations: declared facts and two functions, the map from nodal vectors to natural gradients
//! and its transpose.
//!
//! Everything else (strain, internal force, volume) follows in the block. To add an element: one file, one
//! line in `elements!`.

mod bar2;
mod beam2;
mod shell2;
mod shell3;
mod shell4;
mod shell4_full;
mod of_part;
mod hex8;
mod hex8_assumed_strain;
mod hex8_reduced;
mod quad4;
mod quad4_reduced;
mod stiffest;
mod tet10;
mod tet4;
mod tri3;
mod tri6;
mod wedge6;

pub use bar2::BAR2;
pub use beam2::BEAM2;
pub use hex8::Hex8;
pub use hex8_reduced::{Hex8Reduced, Hex8ReducedAssumedStrain, Hex8ReducedViscous};
pub(crate) use of_part::points_of;
pub use quad4::{Quad4, Quad4Full};
pub use quad4_reduced::{Quad4Reduced, Quad4ReducedAssumedStrain, Quad4ReducedViscous};
pub use shell2::SHELL2;
pub use shell3::SHELL3;
pub use shell4::SHELL4;
pub use shell4_full::SHELL4_FULL;
pub use stiffest::Thickness;
pub use tet4::{Tet4, Tet4Anp};
pub use tet10::Tet10;
pub use tri3::{Tri3, Tri3Anp};
pub use tri6::Tri6;
pub use wedge6::Wedge6;

use crate::mesh::cell::CellKind;
use crate::stress_state::StressState;
use crate::tensor::{Dim, Matrix, Space};
use embate_lanes::{Batch, Lane};

/// An element as the registry describes it.
#[derive(Clone, Copy, Debug)]
pub struct ElementKind {
    /// Name in the model file.
    pub name: &'static str,
    /// One line: what it is and when to take it.
    pub doc: &'static str,
    /// Where its equations come from.
    pub source: &'static str,
    /// Which kind of cell it is.
    pub cell: CellKind,
    /// Of the models that it is for: 2 in 2D (bars: in 3D too), 3 in 3D.
    pub dimension: usize,
    /// Name of the element that takes its place where a part of it is extruded or revolved, if there is one.
    pub extruded: Option<&'static str>,
    /// Whether it is taken for the cells of its kind where a part names no element for them.
    pub is_default: bool,
}

impl ElementKind {
    /// Nodes per element.
    #[must_use]
    pub const fn nodes(&self) -> usize {
        self.cell.nodes()
    }

    /// Whether `element_triangles` of a part names it: triangles in 2D.
    #[must_use]
    pub const fn is_triangle(&self) -> bool {
        matches!(self.cell, CellKind::Triangle | CellKind::Triangle6) && self.dimension == 2
    }
}

/// An element of dimension `D` with `N` nodes and `P` quadrature points. The functions must be
/// `#[inline(always)]`.
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
    /// Whether the dilatation is averaged over the element (B-bar), which keeps plastic flow and rubber from
    /// locking.
    const MEAN_DILATATION: bool;
    /// Whether the dilatation is averaged over the nodes of the block and back (`block/nodal.rs`); for
    /// elements with one point.
    const NODAL_DILATATION: bool = false;
    /// Batches that hourglass control keeps per element; 0: none is needed.
    const HOURGLASS: usize = 0;
    /// Patterns whose amplitude that control follows from step to step, keeping a force against each, which
    /// turns with the element; at most [`PATTERNS`].
    const HOURGLASS_MODES: usize = 0;
    /// Whether that control damps, so that it lags behind the motion.
    const DAMPS: bool = false;
    /// Whether the gradient at its one point is the exact mean over an element that may be warped: then it
    /// takes a second matrix of natural parts, [`Element::warp`].
    const WARPED: bool = false;
    /// Whether it is made of smaller ones: then gradients at its points are projections of theirs. But in
    /// plane stress its volume is that of [`Element::enclosed`], which is no sum over points, and so is the
    /// mean dilatation.
    const COMPOSITE: bool = false;
    /// Mass of an undistorted element over that of each node; the stable step counts with them.
    const MASS_RATIOS: [f64; N] = [N as f64; N];

    /// The element with its options.
    fn new(options: &ElementOptions) -> Self;

    /// Shape functions at natural coordinates.
    fn shape(natural: [f64; D]) -> [f64; N];
    /// Shares of the nodes in the radius of a point of an axisymmetric body, and in its place.
    #[inline(always)]
    fn shares(point: usize) -> [f64; N] {
        Self::shape(Self::POINTS[point])
    }
    /// Rows of [`Element::natural`] that mean something.
    const PARTS: usize = N;
    /// A nodal vector in the linear parts from which gradients are made: the values at the nodes themselves,
    /// or sums of them that serve all points. What is constant need not be among them.
    #[inline(always)]
    fn natural<L: Lane>(nodal: &[[L; D]; N]) -> [[L; D]; N] {
        *nodal
    }
    /// Gradient of a nodal vector, given in its natural parts, with respect to the natural coordinates, at
    /// every point: `out[p][i][k]` = Σ_a u_a,i ∂N_a/∂ξ_k.
    fn gradients<L: Lane>(natural: &[[L; D]; N]) -> [Matrix<L, D>; P];
    /// The transpose of [`Element::gradients`] of [`Element::natural`]: `out[a][i]` = Σ_p Σ_k flux_p,ik
    /// ∂N_a/∂ξ_k.
    fn divergence<L: Lane>(flux: &[Matrix<L, D>; P]) -> [[L; D]; N];
    /// Of an element that is warped: the parts of a nodal vector, given in its natural parts, that are not
    /// linear in the natural coordinates, as a second matrix.
    #[inline(always)]
    fn warp<L: Lane>(_natural: &[[L; D]; N]) -> Matrix<L, D> {
        [[L::splat(0.0); D]; D]
    }
    /// Of an element that is warped: from both matrices of positions what takes the place of their adjugates,
    /// and of the determinant: the mean gradient of a nodal vector is (A adj(A) + B adj(B)) / det with its
    /// own two matrices A and B.
    #[inline(always)]
    fn mean<L: Lane>(jacobian: &Matrix<L, D>, warp: &Matrix<L, D>) -> ([Matrix<L, D>; 2], L) {
        ([Dim::<D>::adjugate(jacobian), *warp], Dim::<D>::determinant(jacobian))
    }
    /// Of an element that is warped: the transpose of [`Element::gradients`], [`Element::warp`] and of what
    /// part neither of them is, all together.
    #[inline(always)]
    fn divergence_warped<L: Lane>(flux: &[Matrix<L, D>; P], _pulls: &Pulls<L, D>) -> [[L; D]; N] {
        Self::divergence(flux)
    }
    /// Of an element that is composite: the volume that its outside encloses, of an axisymmetric body that of
    /// the whole circumference, and its slope by each node. Not asked for in plane stress.
    #[inline(always)]
    fn enclosed<L: Lane>(_nodal: &[[L; D]; N], _state: StressState) -> (L, [[L; D]; N]) {
        (L::splat(0.0), [[L::splat(0.0); D]; N])
    }
    /// Of an element that is composite, in an axisymmetric body: how much of the volume of each point is that
    /// of the part at its corner.
    #[inline(always)]
    fn portions<L: Lane>(_nodal: &[[L; D]; N]) -> [L; P] {
        [L::splat(0.0); P]
    }
    /// [`Element::gradients`] with these portions, where they count.
    #[inline(always)]
    fn gradients_around<L: Lane>(natural: &[[L; D]; N], _portions: &[L; P]) -> [Matrix<L, D>; P] {
        Self::gradients(natural)
    }
    /// [`Element::divergence`] with these portions.
    #[inline(always)]
    fn divergence_around<L: Lane>(flux: &[Matrix<L, D>; P], _portions: &[L; P]) -> [[L; D]; N] {
        Self::divergence(flux)
    }
    /// The element's thickness, for the stable step: `natural` are the parts of the positions, `map` is that
    /// of the element's present form, `volume` the weighted sum of its determinants, of a composite one what
    /// it encloses but in plane stress, and `slope` that of this volume by each node.
    fn thickness<L: Lane>(natural: &[[L; D]; N], map: &Map<L, D, P>, volume: L, slope: &[[L; D]; N], state: StressState) -> Thickness<L>;
    /// Exact ∫ N_a dA of every corner, or ∫ 2πx N_a dA of an axisymmetric body; `None`: the points' sums are
    /// exact enough.
    fn corner_volumes(_nodal: &[[f64; D]; N], _is_axisymmetric: bool) -> Option<[f64; N]> {
        None
    }
    /// Changes of the amplitudes q of the shapes that the points do not feel, m, in a `step` of the nodes to
    /// `x`, both in natural parts, whose displacement gradient at mid-step is known. Called only where
    /// hourglass control follows them ([`Element::HOURGLASS_MODES`]).
    #[inline(always)]
    fn hourglass_rates<L: Lane>(_x: &[[L; D]; N], _step: &[[L; D]; N], _gradient: &Matrix<L, D>) -> [[L; D]; PATTERNS] {
        [[L::splat(0.0); D]; PATTERNS]
    }
    /// Forces against the shapes that the points do not feel; `map` is that of the present form, `kept` is
    /// what was kept at the beginning of the step ([`Element::HOURGLASS`] batches, lanes from `at` on; a
    /// force that follows an amplitude is turned to its end) and becomes what is kept until the next. Called
    /// only where hourglass control keeps something.
    #[inline(always)]
    fn hourglass_forces<L: Lane>(
        &self,
        _corners: &Corners<L, D, N>,
        _map: &Map<L, D, P>,
        _kept: &mut [Batch],
        _at: usize,
    ) -> Held<L, D, N> {
        let zero = L::splat(0.0);
        Held { forces: [[zero; D]; N], flux: [[zero; D]; D], pulls: Pulls::none(), work: zero, stiffening: L::splat(1.0) }
    }
}

/// What pulls on the natural parts of a nodal vector that are not linear.
#[derive(Clone, Copy, Debug)]
pub struct Pulls<L, const D: usize> {
    /// On those of [`Element::warp`].
    pub warp: Matrix<L, D>,
    /// On the last.
    pub rest: [L; D],
}

impl<L: Lane, const D: usize> Pulls<L, D> {
    /// Nothing.
    #[inline(always)]
    #[must_use]
    pub fn none() -> Self {
        Self { warp: [[L::splat(0.0); D]; D], rest: [L::splat(0.0); D] }
    }
}

/// The map from natural coordinates to places, at the points of an element.
#[derive(Clone, Copy, Debug)]
pub struct Map<L, const D: usize, const P: usize> {
    /// Adjugates of the Jacobian.
    pub adjugates: [Matrix<L, D>; P],
    /// Of an element that is warped: that of the second matrix.
    pub warped: Matrix<L, D>,
    /// Determinants: volume per natural volume.
    pub determinants: [L; P],
}

/// The map of an element from its Jacobians, and the second matrix of one that is warped.
#[inline(always)]
pub fn map<E: Element<D, N, P>, L: Lane, const D: usize, const N: usize, const P: usize>(
    jacobians: [Matrix<L, D>; P],
    warp: &Matrix<L, D>,
) -> Map<L, D, P>
where
    Dim<D>: Space<D>,
{
    // In place: at eight points these are lists of kilobytes.
    let (mut adjugates, mut warped, mut determinants) = (jacobians, *warp, [L::splat(0.0); P]);
    for p in 0..P {
        ([adjugates[p], warped], determinants[p]) = map_at::<E, L, D, N, P>(&adjugates[p], warp);
    }
    Map { adjugates, warped, determinants }
}

/// [`map`] at one point: both adjugates, and the determinant.
#[inline(always)]
pub(crate) fn map_at<E: Element<D, N, P>, L: Lane, const D: usize, const N: usize, const P: usize>(
    jacobian: &Matrix<L, D>,
    warp: &Matrix<L, D>,
) -> ([Matrix<L, D>; 2], L)
where
    Dim<D>: Space<D>,
{
    if E::WARPED { E::mean(jacobian, warp) } else { ([Dim::<D>::adjugate(jacobian), *warp], Dim::<D>::determinant(jacobian)) }
}

/// The map of an element from the positions of its nodes.
#[inline(always)]
pub fn map_of<E: Element<D, N, P>, L: Lane, const D: usize, const N: usize, const P: usize>(x: &[[L; D]; N]) -> Map<L, D, P>
where
    Dim<D>: Space<D>,
{
    let natural = E::natural(x);
    map::<E, L, D, N, P>(E::gradients(&natural), &E::warp(&natural))
}

/// What a user may choose of an element.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ElementOptions {
    /// Coefficient of hourglass control; `None`: that of the control's source.
    pub hourglass: Option<f64>,
}

/// Most patterns that hourglass control follows.
pub const PATTERNS: usize = 4;

/// What hourglass control reads.
#[derive(Clone, Copy, Debug)]
pub struct Corners<L, const D: usize, const N: usize> {
    /// Positions in natural parts ([`Element::natural`]), m.
    pub x: [[L; D]; N],
    /// Changes of the amplitudes in the step that led there, m, in directions of its end.
    pub hourglass_rates: [[L; D]; PATTERNS],
    /// Square of the thickness as numerator and denominator, as in the stable step.
    pub characteristic_length_squared: [L; 2],
    /// The same where all of M resists dilatation alone.
    pub dilating_squared: [L; 2],
    /// Area, m².
    pub area: L,
    /// Volume: area times depth, m² (m³).
    pub volume: L,
    /// Of an element that is composite: slope of the volume by each node, m (m²).
    pub slope: [[L; D]; N],
    /// M: K + 4µ/3, in plane stress E/(1 − ν²), Pa.
    pub modulus: L,
    /// µ, Pa.
    pub shear: L,
    /// ν̄ = ν/(1 − ν), in plane stress ν.
    pub contraction: L,
    /// Against hourglass shapes: M, of solids at most 4µ, Pa.
    pub shape_modulus: L,
    /// Mass in the stable step, kg/m (kg).
    pub mass: L,
    /// One over the step, 1/s; 0 where there was none.
    pub rate: L,
    /// Whether there was none: these are the positions at time zero.
    pub is_start: bool,
    /// What the plane stands for.
    pub state: StressState,
}

/// What hourglass control answers.
#[derive(Clone, Copy, Debug)]
pub struct Held<L, const D: usize, const N: usize> {
    /// Forces against which the nodes move, as those of the stresses: f_a = ∂W/∂x_a, N/m. Not read of an
    /// element that is warped.
    pub forces: [[L; D]; N],
    /// Of an element that is warped: what pulls on the linear natural parts, as the flux of the stresses
    /// does.
    pub flux: Matrix<L, D>,
    /// Of an element that is warped: what pulls on the other parts.
    pub pulls: Pulls<L, D>,
    /// Work taken from the nodes in the step by the trapezoidal rule where control follows the amplitude,
    /// else the energy that is stored, J/m.
    pub work: L,
    /// Square of the stable step without it over that with it, at least 1.
    pub stiffening: L,
}

/// Someone who does something with every element's type.
pub trait ElementVisitor<const D: usize>
where
    Dim<D>: Space<D>,
{
    /// What comes out.
    type Output;
    /// The work for an element of the dimension.
    fn visit<E: Element<D, N, P>, const N: usize, const P: usize>(self) -> Self::Output;
}

/// A dimension with elements.
pub trait Registered<const D: usize>
where
    Dim<D>: Space<D>,
{
    /// Every element of the dimension, in the order in which it is listed.
    const ELEMENTS: &'static [ElementKind];
    /// Calls `visitor` with the element called `name`; `None` when there is none.
    fn with_element<V: ElementVisitor<D>>(name: &str, visitor: V) -> Option<V::Output>;
}

/// Calls `visitor` with the element called `name`; `None` when its dimension has none.
pub fn with_element<const D: usize, V: ElementVisitor<D>>(name: &str, visitor: V) -> Option<V::Output>
where
    Dim<D>: Space<D> + Registered<D>,
{
    <Dim<D> as Registered<D>>::with_element(name, visitor)
}

/// The registry: by dimension one line per element, with its nodes and points.
macro_rules! elements {
    ($($dimension:literal { $($element:ident: $nodes:literal nodes, $points:literal points),* $(,)? })*) => {
        $($(const _: () = assert!(<$element as Element<$dimension, $nodes, $points>>::KIND.nodes() == $nodes);)*)*

        $(impl Registered<$dimension> for Dim<$dimension> {
            const ELEMENTS: &'static [ElementKind] = &[$(<$element as Element<$dimension, $nodes, $points>>::KIND),*];

            fn with_element<V: ElementVisitor<$dimension>>(name: &str, visitor: V) -> Option<V::Output> {
                match name {
                    $(n if n == <$element as Element<$dimension, $nodes, $points>>::KIND.name => {
                        Some(visitor.visit::<$element, $nodes, $points>())
                    })*
                    _ => None,
                }
            }
        })*

        /// Every element of a dimension, in the order in which it is listed, but for [`BARS`], [`BEAMS`] and
        /// [`SHELLS`]; none of a dimension that there is not.
        #[must_use]
        pub fn elements_of(dimension: usize) -> &'static [ElementKind] {
            match dimension {
                $($dimension => <Dim<$dimension> as Registered<$dimension>>::ELEMENTS,)*
                _ => &[],
            }
        }
    };
}

elements! {
    2 {
        Quad4: 4 nodes, 4 points,
        Quad4Full: 4 nodes, 4 points,
        Quad4Reduced: 4 nodes, 1 points,
        Quad4ReducedViscous: 4 nodes, 1 points,
        Quad4ReducedAssumedStrain: 4 nodes, 1 points,
        Tri3: 3 nodes, 1 points,
        Tri3Anp: 3 nodes, 1 points,
        Tri6: 6 nodes, 3 points,
    }
    3 {
        Hex8: 8 nodes, 8 points,
        Hex8Reduced: 8 nodes, 1 points,
        Hex8ReducedViscous: 8 nodes, 1 points,
        Hex8ReducedAssumedStrain: 8 nodes, 1 points,
        Wedge6: 6 nodes, 6 points,
        Tet4: 4 nodes, 1 points,
        Tet4Anp: 4 nodes, 1 points,
        Tet10: 10 nodes, 4 points,
    }
}

/// Every element in 2D, in the order in which it is listed.
pub const ELEMENTS: &[ElementKind] = <Dim<2> as Registered<2>>::ELEMENTS;

/// Every element in 3D, in the order in which it is listed.
pub const ELEMENTS_OF_SPACE: &[ElementKind] = <Dim<3> as Registered<3>>::ELEMENTS;

/// Elements that are lines: blocks of their own make them, not the kernels that [`Element`]s are compiled
/// into.
pub const BARS: &[ElementKind] = &[BAR2];

/// Lines whose nodes rotate and whose points are fibres over a cross-section: blocks of their own.
pub const BEAMS: &[ElementKind] = &[BEAM2];

/// Elements of a mid surface, a line in 2D, whose points are layers through the thickness: blocks of their
/// own too.
pub const SHELLS: &[ElementKind] = &[SHELL2, SHELL4, SHELL4_FULL, SHELL3];

/// Every element: those in 2D, bars, beams and shells too, then those in 3D.
#[must_use]
pub fn registry() -> Vec<ElementKind> {
    ELEMENTS.iter().chain(BARS).chain(BEAMS).chain(SHELLS).chain(ELEMENTS_OF_SPACE).copied().collect()
}
