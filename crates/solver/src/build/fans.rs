//! Which element lies behind an edge: found through the elements at its nodes, when a surface asks.
//! Elements come from the mesh; stiffnesses of contacts and what is behind boundaries are made from the answers.

use super::Builder;
use crate::mesh::Mesh;
use crate::rows::Rows;

/// The element behind an edge.
pub(super) struct Under {
    /// L / A: one over the height of the element, 1/m.
    pub(super) flatness: f64,
    /// Index of the group of elements, and the element in it.
    pub(super) group: usize,
    pub(super) element: usize,
}

/// The elements at each node, counted through all groups.
#[derive(Default)]
pub(crate) struct Fans(Rows<u32>);

impl Fans {
    /// Of the elements that have a surface.
    pub(super) fn of(mesh: &Mesh<2>) -> Self {
        let firsts = mesh.groups.iter().scan(0, |next, group| {
            let first = *next;
            *next += group.elements() as u32;
            Some(first)
        });
        let groups = mesh.groups.iter().zip(firsts).filter(|(group, _)| group.has_surface());
        let cells = groups.flat_map(|(group, first)| (first..).zip(group.cells()));
        Self(Rows::new(mesh.positions.len(), cells.flat_map(|(number, cell)| cell.iter().map(move |&node| (node, number)))))
    }

    /// Group and element behind an outside segment, which runs against the element's own direction.
    fn behind(&self, [b, a]: [u32; 2], mesh: &Mesh<2>) -> Option<(usize, usize)> {
        if a as usize >= self.0.count() {
            return None;
        }
        self.0.of(a as usize).iter().find_map(|&number| {
            let (mut group, mut element) = (0, number as usize);
            while element >= mesh.groups[group].elements() {
                element -= mesh.groups[group].elements();
                group += 1;
            }
            let cell = mesh.groups[group].cell(element);
            let is_own = (0..cell.len()).any(|c| (cell[c], cell[(c + 1) % cell.len()]) == (a, b));
            is_own.then_some((group, element))
        })
    }
}

impl Builder<'_> {
    /// What is behind an outside segment.
    pub(super) fn under(&self, segment: [u32; 2]) -> Option<Under> {
        let (group, element) = self.fans.get_or_init(|| Fans::of(&self.mesh)).behind(segment, &self.mesh)?;
        let cell = self.mesh.groups[group].cell(element);
        let x = |corner: usize| self.mesh.positions[cell[corner % cell.len()] as usize];
        let area = 0.5 * (0..cell.len()).map(|c| x(c)[0] * x(c + 1)[1] - x(c)[1] * x(c + 1)[0]).sum::<f64>();
        let [b, a] = segment.map(|node| self.mesh.positions[node as usize]);
        let length = ((b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2)).sqrt();
        Some(Under { flatness: length / area, group, element })
    }
}
