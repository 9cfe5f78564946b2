//! Which elements a part is made of.

use super::{BARS, BEAMS, ELEMENTS, Element, ElementKind, ElementVisitor, Registered, SHELLS, elements_of, with_element};
use crate::mesh::cell::CellKind;
use crate::model::{Model, Part};
use crate::tensor::{Dim, Space};

impl Part {
    /// Whether it consists of bars: lines without a surface.
    #[must_use]
    pub fn is_of_bars(&self) -> bool {
        BARS.iter().any(|kind| kind.name == self.element)
    }

    /// Whether it consists of beams: lines with a cross-section, whose nodes rotate.
    #[must_use]
    pub fn is_of_beams(&self) -> bool {
        BEAMS.iter().any(|kind| kind.name == self.element)
    }

    /// Whether it consists of lines that nothing can touch but by their nodes: bars, and beams of whose
    /// section only the integrals are known.
    #[must_use]
    pub fn has_no_surface(&self) -> bool {
        self.is_of_bars() || (self.is_of_beams() && self.profile.as_ref().is_none_or(|profile| !profile.has_outline()))
    }

    /// Whether its nodes rotate.
    #[must_use]
    pub fn has_rotations(&self) -> bool {
        self.is_of_shells() || self.is_of_beams()
    }

    /// Whether it consists of shells: a mid surface with a thickness.
    #[must_use]
    pub fn is_of_shells(&self) -> bool {
        SHELLS.iter().any(|kind| kind.name == self.element)
    }

    /// Whether it consists of shells in 3D: surfaces, and the model is in 3D.
    #[must_use]
    pub fn is_of_sheets(&self) -> bool {
        SHELLS.iter().any(|kind| kind.name == self.element && kind.dimension == 3)
    }

    /// Whether its elements are lines.
    #[must_use]
    pub fn is_of_lines(&self) -> bool {
        BARS.iter().chain(BEAMS).chain(SHELLS).any(|kind| kind.name == self.element && kind.cell == CellKind::Line)
    }

    /// What its cells of a kind are in a model of so many dimensions: the element that it names, in 3D
    /// also the one that takes its place there ([`ElementKind::extruded`]), else the default one
    /// ([`ElementKind::is_default`]); `None` when there is none of them.
    #[must_use]
    pub fn element_in(&self, dimension: usize, cell: CellKind) -> Option<&'static ElementKind> {
        self.named_element_in(dimension, cell).or_else(|| elements_for(dimension, cell).find(|kind| kind.is_default))
    }

    /// The same without the default ones.
    #[must_use]
    pub fn named_element_in(&self, dimension: usize, cell: CellKind) -> Option<&'static ElementKind> {
        let is_named = |kind: &&ElementKind| [&self.element, &self.element_triangles].iter().any(|name| *name == kind.name);
        let stands_in = |kind: &&ElementKind| dimension == 3 && ELEMENTS.iter().filter(is_named).any(|own| own.extruded == Some(kind.name));
        elements_for(dimension, cell).find(|kind| is_named(kind) || stands_in(kind))
    }
}

/// Integration points of an element of a surface in 2D or of a volume in 3D; `None`: there is no such one.
#[must_use]
pub(crate) fn points_of<const D: usize>(name: &str) -> Option<usize>
where
    Dim<D>: Space<D> + Registered<D>,
{
    struct Points;
    impl<const D: usize> ElementVisitor<D> for Points
    where
        Dim<D>: Space<D>,
    {
        type Output = usize;

        fn visit<E: Element<D, N, P>, const N: usize, const P: usize>(self) -> usize {
            P
        }
    }
    with_element::<D, _>(name, Points)
}

/// Elements of a kind of cell in a model of so many dimensions.
fn elements_for(dimension: usize, cell: CellKind) -> impl Iterator<Item = &'static ElementKind> {
    let turning = BEAMS.iter().chain(SHELLS).filter(move |kind| kind.dimension <= dimension);
    elements_of(dimension).iter().chain(BARS).chain(turning).filter(move |kind| kind.cell == cell)
}

impl Model {
    /// Dimension of the cells of a mesh file that a part is made of, as the file has them.
    #[must_use]
    pub fn cells_dimension(&self, part: &Part) -> u8 {
        let made = if part.is_of_sheets() { 2 } else { self.dimension_of(part) as u8 };
        match (part.is_of_lines(), &part.sweep) {
            (true, _) => 1,
            (false, Some(_)) => made - 1,
            (false, None) => made,
        }
    }
}
