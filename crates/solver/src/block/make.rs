//! Makes a block from an element kind, a stress state, a law and a connectivity: the one place where element and stress state meet and are erased.

use super::Block;
use super::bar::Bars;
use super::elements::Elements;
use super::stress_state::{InSpace, StressState, StressStateVisitor, with_stress_state};
use crate::element::{BAR2, Element, ElementOptions, ElementVisitor, with_element};
use crate::material::{Parameters, points};
use crate::model::Material;
use crate::tensor::{Dim, Space};
use std::marker::PhantomData;

/// What a block is made from.
#[derive(Clone, Copy, Debug)]
pub struct BlockInput<'a, const D: usize = 2> {
    /// Name in the element registry.
    pub element: &'a str,
    /// Cross-section of bars, m² (per metre of depth, m).
    pub area: f64,
    /// Its options.
    pub options: ElementOptions,
    /// Name in the registry of stress states of the plane, empty: plane strain; in space always empty.
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
    /// In plane strain or in space, without options.
    #[must_use]
    pub fn new(element: &'a str, material: &'a Material, connectivity: &'a [u32], positions: &'a [[f64; D]]) -> Self {
        Self {
            element,
            area: 0.0,
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

/// Makes the block; `None` when the element is none of the dimension, or the stress state or the law is unknown.
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
        if input.element == BAR2.name {
            return Some(Box::new(Bars::new(input)?));
        }
        with_element(input.element, ChosenElement(input)).flatten().flatten()
    }
}

impl Blocks<3> for Dim<3> {
    fn make(input: &BlockInput<'_, 3>) -> Option<Box<dyn Block<3>>> {
        if input.element == BAR2.name {
            return Some(Box::new(Bars::new(input)?));
        }
        if !input.stress_state.is_empty() {
            return None;
        }
        with_element(input.element, SolidElement(input)).flatten()
    }
}

struct SolidElement<'a>(&'a BlockInput<'a, 3>);

impl ElementVisitor<3> for SolidElement<'_> {
    type Output = Option<Box<dyn Block<3>>>;
    fn visit<E: Element<3, N, P>, const N: usize, const P: usize>(self) -> Self::Output {
        Some(Box::new(Elements::<E, InSpace, 3, N, P>::new(points::of::<3>(self.0.material)?, density(self.0), self.0)))
    }
}

/// Every law has a density, and reads it the same way.
fn density<const D: usize>(input: &BlockInput<'_, D>) -> f64
where
    Dim<D>: Space<D>,
{
    Parameters::new(&[], &input.material.parameters, &input.material.lists).value("density")
}

struct ChosenElement<'a>(&'a BlockInput<'a>);

impl ElementVisitor for ChosenElement<'_> {
    type Output = Option<Option<Box<dyn Block<2>>>>;
    fn visit<E: Element<2, N, P>, const N: usize, const P: usize>(self) -> Self::Output {
        with_stress_state(self.0.stress_state, ChosenState::<E, N, P>(self.0, PhantomData))
    }
}

struct ChosenState<'a, E, const N: usize, const P: usize>(&'a BlockInput<'a>, PhantomData<E>);

impl<E: Element<2, N, P>, const N: usize, const P: usize> StressStateVisitor for ChosenState<'_, E, N, P> {
    type Output = Option<Box<dyn Block<2>>>;
    fn visit<S: StressState>(self) -> Self::Output {
        let input = self.0;
        let law = if S::PLANE_STRESS { points::plane_stress(input.material) } else { points::plane(input.material) }?;
        Some(Box::new(Elements::<E, S, 2, N, P>::new(law, density(input), input)))
    }
}
