//! Which element lies behind an edge: found through the elements at its nodes, when a surface asks. Elements
//! come from the mesh; stiffnesses of contacts and the elements behind boundaries come from the answers.

use super::{Builder, Builds};
use crate::mesh::Mesh;
use crate::mesh::cell::Cell;
use crate::mesh::geometry::CellGeometry;
use crate::mesh::surface::{Corners, Facet};
use crate::rows::Rows;
use crate::tensor::Dim;

/// The element behind an edge.
pub(super) struct Under {
    /// One over the height of the element, 1/m: L / A, in 3D A / V.
    pub(super) flatness: f64,
    /// Index of the group of elements, the element in it, and which of its cells.
    pub(super) group: usize,
    pub(super) element: usize,
    pub(super) piece: usize,
}

impl Under {
    /// The cell.
    pub(super) fn cell<'m, const D: usize>(&self, mesh: &'m Mesh<D>) -> Option<Cell<'m>>
    where
        Dim<D>: Builds<D>,
    {
        mesh.groups[self.group].outer_cells_of(self.element).nth(self.piece)
    }
}

/// The elements at each node, counted through all groups.
#[derive(Default)]
pub(crate) struct NodeElements(Rows<u32>);

impl NodeElements {
    /// Of the elements that bound bodies.
    pub(super) fn of<const D: usize>(mesh: &Mesh<D>) -> Self
    where
        Dim<D>: Builds<D>,
    {
        let firsts = mesh.groups.iter().scan(0, |next, group| {
            let first = *next;
            *next += group.elements() as u32;
            Some(first)
        });
        let groups = mesh.groups.iter().zip(firsts).filter(|(group, _)| group.is_body(D));
        let cells = groups.flat_map(|(group, first)| group.outer_cells().map(move |(element, cell)| (first + element as u32, cell)));
        Self(Rows::new(mesh.positions.len(), cells.flat_map(|(number, cell)| cell.nodes.iter().map(move |&node| (node, number)))))
    }

    /// Group, element and cell of it behind a piece of the outside.
    fn behind<const D: usize>(&self, facet: Facet<D>, mesh: &Mesh<D>) -> Option<(usize, usize, usize)>
    where
        Dim<D>: Builds<D>,
    {
        let (facet, node) = (facet.canonical(), facet.corners()[0] as usize);
        if node >= self.0.count() {
            return None;
        }
        self.0.of(node).iter().find_map(|&number| {
            let (mut group, mut element) = (0, number as usize);
            while element >= mesh.groups[group].elements() {
                element -= mesh.groups[group].elements();
                group += 1;
            }
            let mut pieces = mesh.groups[group].outer_cells_of(element);
            Some((group, element, pieces.position(|cell| <Dim<D>>::cell_facets(cell).contains(&facet))?))
        })
    }
}

impl<const D: usize> Builder<'_, D>
where
    Dim<D>: Builds<D>,
{
    /// The element behind a piece of the outside.
    pub(super) fn under(&self, facet: Facet<D>) -> Option<Under> {
        let (group, element, piece) = self.node_elements.get_or_init(|| NodeElements::of(&self.mesh)).behind(facet, &self.mesh)?;
        let under = Under { flatness: 0.0, group, element, piece };
        let cell = under.cell(&self.mesh)?;
        Some(Under { flatness: <Dim<D>>::inverse_height(facet, cell, &self.mesh.positions), ..under })
    }
}
