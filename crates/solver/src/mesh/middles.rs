//! Four-node tetrahedra become ten-node ones, and three-node triangles in 2D six-node ones: a node in the
//! middle of each edge, shared by all elements there.
//!
//! It happens to the parts that name no element of four nodes for their tetrahedra, and are not rigid; in 2D
//! to those that name an element of six. Bodies that are connected change together: a node in the middle of
//! an edge where an element of another kind has none would hang free, so elements beside such ones stay as
//! they are, or are a fault where the part wants them with middles.
//!
//! New nodes come after all others, so that the user's numbers stay. Pieces of named sides are divided, and a
//! middle belongs to each set that both ends of its edge are in, unless the set has middles already.

use super::cell::{Cell, CellKind};
use super::messages::NO_ELEMENT;
use super::surface::{Corners, Facet};
use super::{Dim, ElementGroup, Mesh, Meshed};
use crate::error::Fault;
use crate::model::Model;

/// An edge by its nodes, the lower one first.
type Edge = [u32; 2];

/// The cells that may get middles in a dimension, and what they become.
pub(super) const fn of_first_order(dimension: usize) -> CellKind {
    if dimension == 2 { CellKind::Triangle } else { CellKind::Tetrahedron }
}

const fn of_second_order(dimension: usize) -> CellKind {
    if dimension == 2 { CellKind::Triangle6 } else { CellKind::Tetrahedron10 }
}

fn edges(cell: Cell<'_>) -> impl Iterator<Item = Edge> + Clone {
    cell.edges().map(Corners::undirected)
}

/// Edges of groups, each once, ascending.
fn edges_of<'a>(groups: impl Iterator<Item = &'a ElementGroup>) -> Vec<Edge> {
    let mut all: Vec<Edge> = groups.flat_map(ElementGroup::cells).flat_map(edges).collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// Whether a group has one of these edges, which ascend.
fn has_any(group: &ElementGroup, of: &[Edge]) -> bool {
    group.cells().flat_map(edges).any(|edge| of.binary_search(&edge).is_ok())
}

/// Nodes in the middle of edges, by these, ascending.
pub(super) struct Middles {
    edges: Vec<(Edge, u32)>,
}

impl Middles {
    /// Of cells that have them.
    pub(super) fn of_mesh<'a>(groups: impl Iterator<Item = &'a ElementGroup>) -> Self {
        let cells = groups.filter(|group| group.kind.has_middles()).flat_map(ElementGroup::cells);
        let middles = |cell: Cell<'a>| edges(cell).zip(cell.nodes[cell.kind.corners()..].iter().copied());
        let mut all: Vec<(Edge, u32)> = cells.flat_map(middles).collect();
        all.sort_unstable();
        all.dedup();
        Self { edges: all }
    }

    /// Adds those of these edges, each there once, that have none, from a number on; those that it added.
    fn add(&mut self, mut wanted: Vec<Edge>, first: u32) -> Vec<Edge> {
        wanted.retain(|edge| self.of(*edge).is_none());
        self.edges.extend(wanted.iter().copied().zip(first..));
        self.edges.sort_unstable();
        wanted
    }

    fn of(&self, edge: Edge) -> Option<u32> {
        let at = self.edges.partition_point(|(other, _)| *other < edge);
        self.edges.get(at).filter(|(other, _)| *other == edge).map(|&(_, node)| node)
    }

    /// Of the edge between two nodes.
    fn between(&self, a: u32, b: u32) -> Option<u32> {
        self.of([a.min(b), a.max(b)])
    }

    /// A triangle as four, where its edges have middles, and a segment as two.
    pub(super) fn divided<const D: usize>(&self, facet: Facet<D>) -> Vec<Facet<D>>
    where
        Dim<D>: Meshed<D>,
    {
        let whole = || vec![facet];
        if self.edges.is_empty() {
            return whole();
        }
        if let &[a, b] = facet.corners() {
            let Some(middle) = self.between(a, b) else { return whole() };
            let mut halves = [(a, [a, middle]), (b, [middle, b])];
            halves.sort_unstable();
            return halves.into_iter().filter_map(|(_, nodes)| Facet::<D>::of_cell(&nodes)).map(Corners::canonical).collect();
        }
        let &[a, b, c] = facet.corners() else { return whole() };
        let middles = [self.between(a, b), self.between(b, c), self.between(c, a)];
        let [Some(ab), Some(bc), Some(ca)] = middles else { return whole() };
        let of = |nodes: [u32; 3]| Facet::<D>::of_cell(&nodes);
        // In an order that does not depend on where the triangle begins, nor on its direction.
        let mut all = [(a, [a, ab, ca]), (b, [ab, b, bc]), (c, [ca, bc, c]), (u32::MAX, [ab, bc, ca])];
        all.sort_unstable();
        all.into_iter().filter_map(|(_, nodes)| of(nodes)).map(Corners::canonical).collect()
    }

    /// Those whose edges have both ends among these nodes.
    fn within<'a>(&'a self, has: impl Fn(u32) -> bool + 'a) -> impl Iterator<Item = u32> + 'a {
        self.edges.iter().filter(move |([a, b], _)| has(*a) && has(*b)).map(|&(_, node)| node)
    }
}

impl<const D: usize> Mesh<D>
where
    Dim<D>: Meshed<D>,
{
    /// Gives tetrahedra, in 2D triangles, their middles, where they want and can have them.
    pub(super) fn add_middles(&mut self, model: &Model, faults: &mut Vec<Fault>) {
        let (first_order, second_order) = (of_first_order(D), of_second_order(D));
        let named = |part: usize| model.parts[part].named_element_in(D, second_order);
        let may = |group: &ElementGroup| group.kind == first_order;
        let wants = |group: &ElementGroup| {
            named(group.part).is_some() || D == 3 && model.parts[group.part].named_element_in(D, first_order).is_none()
        };
        let mut changes: Vec<bool> = self.groups.iter().map(|group| may(group) && wants(group)).collect();
        let has_middles = |group: &ElementGroup| group.kind.has_middles();
        if !changes.contains(&true) && !self.groups.iter().any(has_middles) {
            return;
        }
        self.leave_out_neighbours(&mut changes);
        self.leave_out_rigid(&mut changes, |part| model.parts[part].rigid.is_some() && named(part).is_none());
        let mut middles = Middles::of_mesh(self.groups.iter());
        let changing = || self.groups.iter().zip(&changes).filter(|(_, changes)| **changes).map(|(group, _)| group);
        let first = self.positions.len() as u32;
        let new = middles.add(edges_of(changing()), first);
        // What has no middles, but an edge that has one.
        for (group, _) in self.groups.iter().zip(&changes).filter(|(group, changes)| !**changes && !has_middles(group)) {
            let Some(edge) = group.cells().flat_map(edges).find(|edge| middles.of(*edge).is_some()) else { continue };
            let [a, b] = edge.map(|node| self.positions[node as usize].map(|x| format!("{x:.4e}")).join(", "));
            let message = format!(
                "its {} share the edge from ({a}) to ({b}) m with {}, whose node in the middle would hang free",
                group.kind.facts().plural,
                second_order.facts().plural
            );
            let help = "give both parts elements of the same order, or separate them in the mesh and tie them with a contact";
            faults.push(Fault::new(&NO_ELEMENT, format!("part[{}]", group.part), message, help));
        }
        for (group, _) in self.groups.iter().zip(&changes).filter(|(group, changes)| !**changes && may(group)) {
            if let Some(wanted) = named(group.part) {
                let what = first_order.facts().plural;
                let message = format!("its {what} share edges with elements of another kind, so they can't become `{}`", wanted.name);
                let (key, help) = if D == 2 {
                    ("element_triangles", "take `tri3_anp`, or separate the bodies and tie them")
                } else {
                    ("element", "take `tet4`, or separate the bodies and tie them")
                };
                faults.push(Fault::new(&NO_ELEMENT, format!("part[{}].{key}", group.part), message, help));
            }
        }
        if !faults.is_empty() {
            return;
        }
        for [a, b] in &new {
            let [a, b] = [a, b].map(|node| self.positions[*node as usize]);
            self.positions.push(std::array::from_fn(|d| 0.5 * (a[d] + b[d])));
        }
        for (group, _) in self.groups.iter_mut().zip(&changes).filter(|(_, changes)| **changes) {
            let cells = group.cells().flat_map(|cell| {
                let own = edges(cell).filter_map(|edge| middles.of(edge));
                cell.nodes.iter().copied().chain(own).collect::<Vec<u32>>()
            });
            (group.connectivity, group.kind) = (cells.collect(), second_order);
        }
        self.name_middles(&middles, first);
        // Cells of a part that were not all of one kind are now of two.
        self.groups.sort_by_key(|group| (group.part, std::cmp::Reverse((group.kind.nodes(), group.kind))));
    }

    /// Cells that share an edge with what will have no middles get none, and so on.
    fn leave_out_neighbours(&self, changes: &mut [bool]) {
        loop {
            let is_without =
                |(group, changes): &(&ElementGroup, &bool)| !**changes && !group.kind.has_middles() && group.kind.dimension() > 0;
            let without = edges_of(self.groups.iter().zip(&*changes).filter(is_without).map(|(group, _)| group));
            let touching: Vec<usize> = (0..changes.len()).filter(|&at| changes[at] && has_any(&self.groups[at], &without)).collect();
            if touching.is_empty() {
                return;
            }
            touching.into_iter().for_each(|at| changes[at] = false);
        }
    }

    /// Cells of rigid parts that do not ask for middles need none, unless they are connected with some
    /// that have them. Rigid parts share no nodes with each other.
    fn leave_out_rigid(&self, changes: &mut [bool], is_rigid: impl Fn(usize) -> bool) {
        let rigid: Vec<usize> = (0..changes.len()).filter(|&at| changes[at] && is_rigid(self.groups[at].part)).collect();
        if rigid.is_empty() {
            return;
        }
        let has_them = |(group, changes): &(&ElementGroup, &bool)| group.kind.has_middles() || **changes && !is_rigid(group.part);
        let with = edges_of(self.groups.iter().zip(&*changes).filter(has_them).map(|(group, _)| group));
        rigid.into_iter().filter(|&at| !has_any(&self.groups[at], &with)).for_each(|at| changes[at] = false);
    }

    /// Puts middles into the parts, sides and sets that they belong to.
    fn name_middles(&mut self, middles: &Middles, first: u32) {
        for (index, part) in self.parts.iter_mut().enumerate() {
            let own = self.groups.iter().filter(|group| group.part == index && group.kind.has_middles());
            let mut new: Vec<u32> = own.flat_map(|group| group.connectivity.iter().copied().filter(|&node| node >= first)).collect();
            new.sort_unstable();
            new.dedup();
            part.nodes.extend(new);
        }
        let surfaces = self.surfaces.values_mut().flatten().map(|(_, facets)| facets);
        for facets in self.sides.values_mut().chain(surfaces) {
            *facets = facets.iter().flat_map(|facet| middles.divided::<D>(*facet)).collect();
        }
        let count = self.positions.len();
        let (mut is_in, mut is_middle) = (vec![false; count], vec![false; count]);
        middles.edges.iter().for_each(|&(_, node)| is_middle[node as usize] = true);
        for nodes in self.points.values_mut().chain(self.sets.values_mut().flatten().map(|(_, nodes)| nodes)) {
            if nodes.iter().any(|node| is_middle[*node as usize]) {
                continue; // of a file that has them, and says which
            }
            nodes.iter().for_each(|&node| is_in[node as usize] = true);
            let own: Vec<u32> = middles.within(|node| is_in[node as usize]).collect();
            nodes.iter().for_each(|&node| is_in[node as usize] = false);
            nodes.extend(own);
            nodes.sort_unstable();
            nodes.dedup();
        }
    }
}
