//! Which element lies behind an edge: found through the elements at its nodes, when a surface asks.
//! Elements come from the mesh; stiffnesses of contacts and what is behind boundaries are made from the answers.

use super::Builder;
use crate::mesh::Mesh;

/// The element behind an edge.
pub(super) struct Under {
    /// L / A: one over the height of the element, 1/m.
    pub(super) flatness: f64,
    /// Index of the group of elements, and the element in it.
    pub(super) group: usize,
    pub(super) element: usize,
}

/// The elements at each node.
#[derive(Default)]
pub(crate) struct Fans {
    /// Where the elements at each node begin; one more than nodes.
    starts: Vec<u32>,
    /// Elements, counted through all groups.
    elements: Vec<u32>,
}

impl Fans {
    /// Of the elements that have a surface.
    pub(super) fn of(mesh: &Mesh<2>) -> Self {
        let mut starts = vec![0_u32; mesh.positions.len() + 1];
        let groups = || mesh.groups.iter().filter(|group| group.has_surface());
        groups().flat_map(|group| &group.connectivity).for_each(|&node| starts[node as usize + 1] += 1);
        for node in 1..starts.len() {
            starts[node] += starts[node - 1];
        }
        let mut next = starts.clone();
        let mut elements = vec![0; starts.last().map_or(0, |&count| count as usize)];
        let mut first = 0;
        for group in &mesh.groups {
            for (number, cell) in (first..).zip(group.cells()).filter(|_| group.has_surface()) {
                for &node in cell {
                    elements[next[node as usize] as usize] = number;
                    next[node as usize] += 1;
                }
            }
            first += group.elements() as u32;
        }
        Self { starts, elements }
    }

    /// Group and element behind an outside segment, which runs against the element's own direction.
    fn behind(&self, [b, a]: [u32; 2], mesh: &Mesh<2>) -> Option<(usize, usize)> {
        let &[start, end] = self.starts.get(a as usize..a as usize + 2)? else { return None };
        self.elements[start as usize..end as usize].iter().find_map(|&number| {
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
