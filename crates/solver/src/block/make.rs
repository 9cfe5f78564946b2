//! Makes a block from an element kind, a stress state, a law and a connectivity.

use super::Block;
use super::bar::Bars;
use super::kernel::{Compiled, ElementKernel};
use super::shell::{Beam, Full, Line, Quad, Shells, Triangle};
use super::store::ElementStore;
use crate::element::{BAR2, BEAM2, Element, ElementOptions, ElementVisitor, Registered, SHELL2, SHELL3, SHELL4, SHELL4_FULL, with_element};
use crate::material::points;
use crate::material::points::PointLaw;
use crate::model::{Material, Profile, ShellSection};
use crate::stress_state::StressState;
use crate::tensor::{Dim, Space};

/// What a block is made from.
#[derive(Clone, Copy, Debug)]
pub struct BlockInput<'a, const D: usize> {
    /// Name in the element registry.
    pub element: &'a str,
    /// Cross-section of bars, m² (per metre of depth, m).
    pub area: f64,
    /// Directions of the nodes of each element of a shell; empty: from its neighbours in the block.
    pub directions: &'a [[f64; D]],
    /// Of shells the thickness of each corner, m; empty: as the section says.
    pub thicknesses: &'a [f64],
    /// Section of shells.
    pub section: Option<&'a ShellSection>,
    /// Materials of the layers of the section, if it has any; those beyond are of `material`.
    pub layers: &'a [&'a Material],
    /// Cross-section of beams.
    pub profile: Option<&'a Profile>,
    /// Its options.
    pub options: ElementOptions,
    /// Name in the registry of stress states in 2D, empty: plane strain; in 3D always empty.
    pub stress_state: &'a str,
    /// Law and parameters.
    pub material: &'a Material,
    /// Time β of the damping in proportion to the stiffness, s; 0: none.
    pub damping: f64,
    /// Linear and quadratic coefficient of the bulk viscosity; `None`: none.
    pub viscosity: Option<[f64; 2]>,
    /// Node indices, `nodes` per element.
    pub connectivity: &'a [u32],
    /// Initial positions of all nodes, m.
    pub positions: &'a [[f64; D]],
}

impl<'a, const D: usize> BlockInput<'a, D> {
    /// In plane strain or in 3D, without options.
    #[must_use]
    pub fn new(element: &'a str, material: &'a Material, connectivity: &'a [u32], positions: &'a [[f64; D]]) -> Self {
        Self {
            element,
            area: 0.0,
            directions: &[],
            thicknesses: &[],
            section: None,
            layers: &[],
            profile: None,
            damping: 0.0,
            options: ElementOptions::default(),
            stress_state: "",
            material,
            viscosity: None,
            connectivity,
            positions,
        }
    }
}

/// Makes the law of a material for points of a kind.
pub(super) type LawOf = fn(&Material) -> Option<Box<dyn PointLaw>>;

/// Makes the block; `None` when the element is none of the dimension, or the stress state or the law is
/// unknown.
#[must_use]
pub fn make<const D: usize>(input: &BlockInput<'_, D>) -> Option<Box<dyn Block<D>>>
where
    Dim<D>: Blocks<D>,
{
    <Dim<D> as Blocks<D>>::make(input)
}

/// A dimension that blocks are made in.
pub trait Blocks<const D: usize> {
    /// See [`make`].
    fn make(input: &BlockInput<'_, D>) -> Option<Box<dyn Block<D>>>;
}

impl Blocks<2> for Dim<2> {
    fn make(input: &BlockInput<'_, 2>) -> Option<Box<dyn Block<2>>> {
        let state = StressState::named(input.stress_state)?;
        if input.element == SHELL2.name {
            let law_of = |material: &Material| points::layer(material, state.is_plane_stress);
            return Some(Box::new(Shells::<Line, 2>::new(input, &law_of, [state.is_plane_stress, state.is_axisymmetric])?));
        }
        let law = if state.is_plane_stress { points::plane_stress } else { points::of::<2> };
        of_elements(input, state, law)
    }
}

impl Blocks<3> for Dim<3> {
    fn make(input: &BlockInput<'_, 3>) -> Option<Box<dyn Block<3>>> {
        if input.element == SHELL4.name {
            return Some(Box::new(Shells::<Quad, 3>::new(input, &points::layer_in_3d, [false; 2])?));
        }
        if input.element == SHELL4_FULL.name {
            return Some(Box::new(Shells::<Full, 3>::new(input, &points::layer_in_3d, [false; 2])?));
        }
        if input.element == SHELL3.name {
            return Some(Box::new(Shells::<Triangle, 3>::new(input, &points::layer_in_3d, [false; 2])?));
        }
        if input.element == BEAM2.name {
            return Some(Box::new(Shells::<Beam, 3>::of_beams(input, points::uniaxial(input.material)?)?));
        }
        if !input.stress_state.is_empty() && input.element != BAR2.name {
            return None;
        }
        of_elements(input, StressState::SPACE, points::of::<3>)
    }
}

/// A block of bars, or of elements in a stress state with the law that `law` makes of the material.
fn of_elements<const D: usize>(input: &BlockInput<'_, D>, state: StressState, law: LawOf) -> Option<Box<dyn Block<D>>>
where
    Dim<D>: Space<D> + Registered<D>,
{
    if input.element == BAR2.name {
        return Some(Box::new(Bars::new(input)?));
    }
    let kernel = with_element(input.element, Compile { options: &input.options, state })?;
    Some(Box::new(ElementStore::new(law, kernel, input)?))
}

/// Makes the kernel of an element: the one place where elements are compiled into blocks.
struct Compile<'a> {
    options: &'a ElementOptions,
    state: StressState,
}

impl<const D: usize> ElementVisitor<D> for Compile<'_>
where
    Dim<D>: Space<D>,
{
    type Output = Box<dyn ElementKernel<D>>;
    fn visit<E: Element<D, N, P>, const N: usize, const P: usize>(self) -> Self::Output {
        Box::new(Compiled::<E, D, N, P>::new(self.options, self.state))
    }
}
