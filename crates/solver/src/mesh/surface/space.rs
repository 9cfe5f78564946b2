//! The outside of bodies in 3D: facets of elements that occur once, counter-clockwise seen from outside,
//! and linked across their edges.
//!
//! Cells come from the shapes and mesh files; surfaces go to contact and loads. Where two parts of an outside
//! touch in an edge, each stays with its own fan of elements, as chains in 2D do at a node: the
//! neighbour across an edge is the facet at the other end of the fan.

use super::{Corners, NONE, named};
use crate::error::Fault;
use crate::mesh::cell::Cell;
use crate::mesh::messages::{BAD_ELEMENT, NOT_A_SURFACE, OVERLAP};
use crate::model::TriangleSurface;
use crate::rows::Rows;
use crate::tensor::{cross, dot};
use crate::vector::minus;
use std::sync::Arc;

/// An edge of a surface in 3D.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SurfaceEdge {
    /// Its nodes, in the direction in which its first facet has it.
    pub nodes: [u32; 2],
    /// The facet that has it in this direction, and the one on the other side, or [`NONE`] where the surface
    /// ends.
    pub facets: [u32; 2],
}

/// An oriented surface in 3D. Facets are counter-clockwise seen from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SpaceSurface {
    /// Nodes of each facet, the lowest first; a triangle repeats its last node.
    pub facets: Vec<[u32; 4]>,
    /// All nodes, ascending, each once.
    pub nodes: Vec<u32>,
    /// Edges, each once, in the order of the first of their facets and of its corners.
    pub edges: Vec<SurfaceEdge>,
    /// Edge from each corner of each facet to the next one; the fourth of a triangle is [`NONE`].
    pub edges_of: Vec<[u32; 4]>,
    /// Edges at which the surface ends on a symmetry plane, and the unit normal of that, which points to the
    /// body: its image continues there. Ascending.
    pub mirrors: Vec<(u32, [f64; 3])>,
    /// Facets at each of `nodes`, ascending.
    around: Rows<u32>,
    /// Label of each node of the model, as far as it has one: what has the same label does not touch. Empty
    /// where nothing has.
    kin: Arc<[u32]>,
}

impl SpaceSurface {
    /// The same with the symmetry planes at which it ends: `normals_of` gives the unit normals of the planes
    /// that both nodes of an edge lie on, `positions` (m) show on which side the body is.
    #[must_use]
    pub fn with_mirrors<I: IntoIterator<Item = [f64; 3]>>(self, normals_of: impl Fn([u32; 2]) -> I, positions: &[[f64; 3]]) -> Self {
        let at = |node: u32| positions[node as usize];
        let mirror = |(edge, number): (&SurfaceEdge, u32)| {
            let SurfaceEdge { nodes, facets: [facet, other] } = *edge;
            if other != NONE {
                return None;
            }
            let [a, b, c, d] = self.facets[facet as usize].map(at);
            let out = if c == d { cross(minus(b, a), minus(c, a)) } else { cross(minus(c, a), minus(d, b)) };
            // The facet is on the body's side of the plane. Where two planes meet, the one that the body
            // behind the facet reaches.
            let inward = |normal: [f64; 3]| {
                let off = |&node: &u32| dot(minus(at(node), at(nodes[0])), normal);
                let side: f64 = self.facets[facet as usize].corners().iter().map(off).sum();
                if side < 0.0 { normal.map(|n| -n) } else { normal }
            };
            let better = |one: [f64; 3], two: [f64; 3]| if dot(out, two) > dot(out, one) { two } else { one };
            normals_of(nodes).into_iter().map(inward).reduce(better).map(|normal| (number, normal))
        };
        let mirrors = self.edges.iter().zip(0..).filter_map(mirror).collect();
        Self { mirrors, ..self }
    }

    /// The same where what has the same label does not touch: those of nodes by their numbers, [`NONE`] for
    /// none; none at all where there is none.
    #[must_use]
    pub fn with_kin(self, labels: &[u32]) -> Self {
        Self { kin: labels.into(), ..self }
    }

    /// Label of each of its nodes; empty where none has any.
    #[must_use]
    pub fn labels(&self) -> Vec<u32> {
        if self.kin.is_empty() {
            return Vec::new();
        }
        self.nodes.iter().map(|&node| self.label(node)).collect()
    }

    fn label(&self, node: u32) -> u32 {
        self.kin.get(node as usize).copied().unwrap_or(NONE)
    }

    /// Whether two nodes have the same label.
    fn have_same_label(&self, a: u32, b: u32) -> bool {
        self.label(a) != NONE && self.label(a) == self.label(b)
    }

    /// Whether some nodes do not touch others: they are the same, or have the same label.
    #[must_use]
    pub fn are_kin(&self, some: &[u32], others: &[u32]) -> bool {
        some.iter().any(|node| others.contains(node))
            || !self.kin.is_empty() && some.iter().any(|&a| others.iter().any(|&b| self.have_same_label(a, b)))
    }

    /// Normal of the symmetry plane on which the surface ends at an edge, if it does; it points to the body.
    #[must_use]
    pub fn mirror(&self, edge: u32) -> Option<[f64; 3]> {
        if self.mirrors.is_empty() {
            return None;
        }
        self.mirrors.binary_search_by_key(&edge, |&(edge, _)| edge).ok().map(|at| self.mirrors[at].1)
    }

    /// The outside facets of `cells`, not linked; see [`exterior`](super::exterior).
    pub(in crate::mesh) fn exterior<'a>(cells: impl IntoIterator<Item = Cell<'a>, IntoIter: Clone>) -> Result<Vec<[u32; 4]>, Fault> {
        Ok(Table::new(cells)?.exterior())
    }

    /// The whole outside of `cells` in the order of [`exterior`](super::exterior).
    ///
    /// # Errors
    /// As [`exterior`](super::exterior).
    pub fn outside<'a>(cells: impl IntoIterator<Item = Cell<'a>, IntoIter: Clone>) -> Result<Self, Fault> {
        Self::outside_without(cells, |_| false)
    }

    /// The same without the facets that `leave_out` names, which is asked once for each in this order.
    ///
    /// # Errors
    /// As [`exterior`](super::exterior).
    pub fn outside_without<'a>(
        cells: impl IntoIterator<Item = Cell<'a>, IntoIter: Clone>,
        leave_out: impl Fn([u32; 4]) -> bool,
    ) -> Result<Self, Fault> {
        let table = Table::new(cells)?;
        let facets = table.exterior().into_iter().filter(|&facet| !leave_out(facet)).collect();
        Self::linked(facets, &table)
    }

    /// The part of the outside of `cells` that consists of `facets`, kept in their order; each begins with
    /// its lowest node.
    ///
    /// Facets that have no neighbour across an edge among them end there: the edge has one facet.
    ///
    /// # Errors
    /// A fault when the cells are wrong (see [`exterior`](super::exterior)), when a facet is no outside of
    /// them or has the body before it (see [`oriented`](super::oriented)), or when one is given twice.
    pub fn new<'a>(facets: Vec<[u32; 4]>, cells: impl IntoIterator<Item = Cell<'a>, IntoIter: Clone>) -> Result<Self, Fault> {
        Self::linked(facets.into_iter().map(Corners::canonical).collect(), &Table::new(cells)?)
    }

    /// A surface of triangles that is no outside of cells: point `k` is node `first + k`. Where more than two
    /// triangles have an edge, or two of them in one direction, they end there.
    #[must_use]
    pub fn of_triangles(triangles: &TriangleSurface, first: u32) -> Self {
        let facets: Vec<[u32; 4]> =
            triangles.triangles.iter().map(|&[a, b, c]| [a, b, c, c].map(|point| first + point).canonical()).collect();
        let mut partners = vec![[NONE; 3]; facets.len()];
        let corner = |triangle: u32, node: u32| facets[triangle as usize].iter().position(|&other| other == first + node).unwrap_or(0);
        for here in triangles.edges().chunk_by(|a, b| a.key() == b.key()) {
            if let [a, b] = here
                && a.nodes != b.nodes
            {
                partners[a.triangle as usize][corner(a.triangle, a.nodes[0])] = b.triangle;
                partners[b.triangle as usize][corner(b.triangle, b.nodes[0])] = a.triangle;
            }
        }
        let (mut edges, mut edges_of) = (Vec::with_capacity(3 * facets.len() / 2), vec![[NONE; 4]; facets.len()]);
        for (f, facet) in (0_u32..).zip(&facets) {
            for k in 0..3 {
                if edges_of[f as usize][k] != NONE {
                    continue; // its neighbour has made this edge
                }
                let (nodes, number, other) = ([facet[k], facet[(k + 1) % 3]], edges.len() as u32, partners[f as usize][k]);
                edges_of[f as usize][k] = number;
                if other != NONE
                    && let Some(at) = (0..3).find(|&at| facets[other as usize][at] == nodes[1])
                {
                    edges_of[other as usize][at] = number;
                }
                edges.push(SurfaceEdge { nodes, facets: [f, other] });
            }
        }
        let mut nodes: Vec<u32> = facets.iter().flat_map(Corners::corners).copied().collect();
        nodes.sort_unstable();
        nodes.dedup();
        let around = Self::around_nodes(&facets, &nodes);
        Self { facets, nodes, edges, edges_of, around, ..Self::default() }
    }

    /// Both surfaces as one; the nodes of the other come after those of this one. Symmetry planes are
    /// forgotten.
    #[must_use]
    pub fn joined(&self, other: &Self) -> Self {
        let (facets_before, edges_before) = (self.facets.len() as u32, self.edges.len() as u32);
        let later = |number: u32, by: u32| if number == NONE { NONE } else { number + by };
        let edge = |edge: &SurfaceEdge| SurfaceEdge { facets: edge.facets.map(|facet| later(facet, facets_before)), ..*edge };
        let facets = [&self.facets[..], &other.facets].concat();
        let nodes = [&self.nodes[..], &other.nodes].concat();
        let edges = self.edges.iter().copied().chain(other.edges.iter().map(edge)).collect();
        let edges_of = other.edges_of.iter().map(|edges| edges.map(|edge| later(edge, edges_before)));
        let edges_of = self.edges_of.iter().copied().chain(edges_of).collect();
        let around = Self::around_nodes(&facets, &nodes);
        Self { facets, nodes, edges, edges_of, around, ..Self::default() }
    }

    /// Facets at each node.
    fn around_nodes(facets: &[[u32; 4]], nodes: &[u32]) -> Rows<u32> {
        let rank = |node: u32| nodes.binary_search(&node).map_or(0, |rank| rank as u32);
        let at_nodes = facets.iter().zip(0..).flat_map(|(facet, f)| facet.corners().iter().map(move |&node| (rank(node), f)));
        Rows::new(nodes.len(), at_nodes)
    }

    /// Facets at the node that stands at `rank` in [`SpaceSurface::nodes`], ascending.
    #[must_use]
    pub fn around(&self, rank: usize) -> &[u32] {
        self.around.of(rank)
    }

    /// Facets at a node; none where the surface has not this node.
    #[must_use]
    pub fn facets_at(&self, node: u32) -> &[u32] {
        self.nodes.binary_search(&node).map_or(&[], |rank| self.around(rank))
    }

    /// The facets that have both nodes, or with [`NONE`] as the second those that have the first, ascending;
    /// with twice [`NONE`] `facet` alone.
    pub fn sharing(&self, facet: u32, [a, b]: [u32; 2]) -> impl Iterator<Item = u32> + Clone + use<'_> {
        let around = if a == NONE { &[] } else { self.facets_at(a) };
        let has = move |&other: &u32| b == NONE || self.facets[other as usize].contains(&b);
        (a == NONE).then_some(facet).into_iter().chain(around.iter().copied().filter(has))
    }

    /// The facet on the other side of the edge from corner `k` of a facet to the next one, or [`NONE`].
    #[must_use]
    pub fn across(&self, facet: u32, k: usize) -> u32 {
        let edge = self.edges_of[facet as usize][k];
        if edge == NONE {
            return NONE;
        }
        let [first, other] = self.edges[edge as usize].facets;
        if first == facet { other } else { first }
    }

    fn linked(facets: Vec<[u32; 4]>, table: &Table<'_>) -> Result<Self, Fault> {
        let mut by_nodes: Vec<([u32; 4], u32)> = facets.iter().copied().zip(0..).collect();
        by_nodes.sort_unstable();
        if let Some(twice) = by_nodes.windows(2).find(|w| w[0].0 == w[1].0) {
            let message = format!("facet {} occurs twice in a surface", named(&twice[0].0));
            return Err(Fault::new(&NOT_A_SURFACE, "", message, "name each side or group once"));
        }
        let find = |facet: &[u32; 4]| by_nodes.binary_search_by_key(facet, |&(nodes, _)| nodes).ok().map(|i| by_nodes[i].1);
        let mut edges: Vec<SurfaceEdge> = Vec::with_capacity(2 * facets.len());
        let mut edges_of = vec![[NONE; 4]; facets.len()];
        for (facet, f) in facets.iter().zip(0_u32..) {
            let Some((cell, local)) = table.owner(facet) else {
                return Err(Fault::new(
                    &NOT_A_SURFACE,
                    "",
                    format!("facet {} is not on the outside of its body, or has the body before it", named(facet)),
                    "take facets that bound the elements of one part; contact acts on the outside only",
                ));
            };
            let corners = facet.corners();
            for k in 0..corners.len() {
                if edges_of[f as usize][k] != NONE {
                    continue; // its neighbour has made this edge
                }
                let nodes = [corners[k], corners[(k + 1) % corners.len()]];
                let number = edges.len() as u32;
                edges_of[f as usize][k] = number;
                let neighbour = table.across(cell, local, nodes).and_then(|there| find(&there)).filter(|&there| there != f);
                if let Some(there) = neighbour {
                    let other = facets[there as usize];
                    let n = other.corners().len();
                    if let Some(at) = (0..n).find(|&at| [other[at], other[(at + 1) % n]] == [nodes[1], nodes[0]]) {
                        edges_of[there as usize][at] = number;
                    }
                }
                edges.push(SurfaceEdge { nodes, facets: [f, neighbour.unwrap_or(NONE)] });
            }
        }
        let mut nodes: Vec<u32> = facets.iter().flat_map(Corners::corners).copied().collect();
        nodes.sort_unstable();
        nodes.dedup();
        let around = Self::around_nodes(&facets, &nodes);
        Ok(Self { facets, nodes, edges, edges_of, around, ..Self::default() })
    }
}

/// A facet of a cell as its lowest node sees it: the next node, the opposite one ([`NONE`] in a triangle),
/// the one before.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
struct Seen {
    /// The same from both sides: the smaller of next and before, the opposite one, the larger.
    key: [u32; 3],
    /// Whether the next one is the larger.
    is_turned: bool,
    /// The cell, and which of its facets it is: side by side with the rest in 20 bytes, because the facets of
    /// all cells are there at once.
    cell: u32,
    local: u8,
}

/// Its lowest node, and how that sees the facet with these nodes.
fn seen(facet: [u32; 4], (cell, local): (u32, u8)) -> (u32, Seen) {
    let [lowest, next, c, d] = facet.canonical();
    let (opposite, before) = if c == d { (NONE, c) } else { (c, d) };
    (lowest, Seen { key: [next.min(before), opposite, next.max(before)], is_turned: next > before, cell, local })
}

/// The facet that its lowest node sees so.
fn facet_of(lowest: u32, seen: &Seen) -> [u32; 4] {
    let [small, opposite, large] = seen.key;
    let [next, before] = if seen.is_turned { [large, small] } else { [small, large] };
    if opposite == NONE { [lowest, next, before, before] } else { [lowest, next, opposite, before] }
}

/// Every facet of every cell at its lowest node, ascending.
struct Table<'a> {
    cells: Vec<Cell<'a>>,
    at: Rows<Seen>,
}

impl<'a> Table<'a> {
    /// Facets are counted, then put into their places: no sorting but of the few at one node.
    fn new(cells: impl IntoIterator<Item = Cell<'a>, IntoIter: Clone>) -> Result<Self, Fault> {
        let cells: Vec<Cell<'a>> = cells.into_iter().collect();
        let mut count = 0;
        for cell in &cells {
            if cell.kind.dimension() != 3 || cell.is_collapsed() {
                let help = "elements of solids have four, six, eight or ten different nodes; remove collapsed ones from the mesh";
                return Err(Fault::new(&BAD_ELEMENT, "", format!("an element has the nodes {:?}", cell.nodes), help));
            }
            count = cell.nodes.iter().fold(count, |count, &node| count.max(node as usize + 1));
        }
        let of_cell = |(cell, number): (&Cell<'a>, u32)| cell.facets().zip(0..).map(move |(facet, l)| seen(facet, (number, l)));
        let mut at = Rows::new(count, cells.iter().zip(0..).flat_map(of_cell));
        (0..count).for_each(|node| at.of_mut(node).sort_unstable());
        let table = Self { cells, at };
        table.check()?;
        Ok(table)
    }

    /// Groups of what is the same facet seen from one side or the other, with their lowest node.
    fn groups(&self) -> impl Iterator<Item = (u32, &[Seen])> {
        (0..self.at.count() as u32)
            .flat_map(|node| self.at.of(node as usize).chunk_by(|a, b| a.key == b.key).map(move |group| (node, group)))
    }

    fn check(&self) -> Result<(), Fault> {
        for (lowest, group) in self.groups() {
            let nodes = || named(&facet_of(lowest, &group[0]));
            if group.len() > 2 {
                return Err(Fault::new(
                    &OVERLAP,
                    "",
                    format!("the facet {} belongs to {} elements", nodes(), group.len()),
                    "a facet has at most two; remove elements that overlap or occur twice",
                ));
            } else if group.len() == 2 && group[0].is_turned == group[1].is_turned {
                return Err(Fault::new(
                    &OVERLAP,
                    "",
                    format!("two elements lie on the same side of the facet {}", nodes()),
                    "one of them is inside out, or they overlap; reverse or remove one of them",
                ));
            }
        }
        Ok(())
    }

    fn exterior(&self) -> Vec<[u32; 4]> {
        let mut facets: Vec<[u32; 4]> =
            self.groups().filter(|(_, group)| group.len() == 1).map(|(lowest, group)| facet_of(lowest, &group[0])).collect();
        facets.sort_unstable();
        facets
    }

    /// What is seen there of a facet, from both sides.
    fn group(&self, facet: [u32; 4]) -> &[Seen] {
        let (lowest, wanted) = seen(facet, (0, 0));
        if lowest as usize >= self.at.count() {
            return &[];
        }
        let row = self.at.of(lowest as usize);
        let first = row.partition_point(|it| it.key < wanted.key);
        let count = row[first..].iter().take_while(|it| it.key == wanted.key).count();
        &row[first..first + count]
    }

    /// The cell behind an outside facet, and which of its facets it is; `None` when it is not outside or seen
    /// from inside.
    fn owner(&self, facet: &[u32; 4]) -> Option<(u32, u8)> {
        match self.group(*facet) {
            [one] if facet_of(facet.canonical()[0], one) == *facet => Some((one.cell, one.local)),
            _ => None,
        }
    }

    /// The outside facet on the other side of the edge a → b of an outside facet: around the edge, through
    /// the elements of its fan.
    fn across(&self, mut cell: u32, mut local: u8, [a, b]: [u32; 2]) -> Option<[u32; 4]> {
        // A fan has no more elements than there are; it ends at an outside facet.
        for _ in 0..self.cells.len() {
            let has_it = |(facet, l): &([u32; 4], u8)| {
                let corners = facet.corners();
                let n = corners.len();
                *l != local && (0..n).any(|k| [corners[k], corners[(k + 1) % n]] == [b, a])
            };
            let (there, other_local) = self.cells[cell as usize].facets().zip(0..).find(has_it)?;
            let group = self.group(there);
            // The cell beyond has the same facet the other way round, and so the edge a → b in it.
            match group.iter().find(|it| (it.cell, it.local) != (cell, other_local)) {
                None => return Some(there.canonical()),
                Some(beyond) => (cell, local) = (beyond.cell, beyond.local),
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::super::{exterior, oriented};
    use super::*;
    use crate::mesh::Meshed;
    use crate::mesh::cell::CellKind;
    use crate::tensor::Dim;
    use proptest::prelude::*;

    /// A block of n × n × n cubes without those that are left out.
    fn block(n: u32, keep: impl Fn(u32) -> bool) -> Vec<[u32; 8]> {
        let m = n + 1;
        let corner = |i: u32, j: u32, k: u32| (k * m + j) * m + i;
        let cube = |cell: u32| {
            let (i, j, k) = (cell % n, cell / n % n, cell / n / n);
            let low = [corner(i, j, k), corner(i + 1, j, k), corner(i + 1, j + 1, k), corner(i, j + 1, k)];
            std::array::from_fn(|c| low[c % 4] + if c < 4 { 0 } else { m * m })
        };
        (0..n * n * n).filter(|&cell| keep(cell)).map(cube).collect()
    }

    fn hexes(cells: &[[u32; 8]]) -> impl Iterator<Item = Cell<'_>> + Clone {
        CellKind::Hexahedron.cells(cells.as_flattened())
    }

    fn links_are_consistent(surface: &SpaceSurface) {
        let mut of_edges = 0;
        for (f, facet) in (0_u32..).zip(&surface.facets) {
            let corners = facet.corners();
            for k in 0..4 {
                let edge = surface.edges_of[f as usize][k];
                assert_eq!(edge == NONE, k >= corners.len());
                if edge == NONE {
                    continue;
                }
                of_edges += 1;
                let SurfaceEdge { nodes, facets } = surface.edges[edge as usize];
                let own = [corners[k], corners[(k + 1) % corners.len()]];
                assert_eq!(own, if facets[0] == f { nodes } else { [nodes[1], nodes[0]] });
                assert!(facets.contains(&f) && facets[0] != facets[1]);
                let across = surface.across(f, k);
                assert!(across == NONE || (0..4).any(|k| surface.edges_of[across as usize][k] == edge));
            }
            for node in corners {
                assert!(surface.facets_at(*node).contains(&f));
            }
        }
        let sides: usize = surface.edges.iter().map(|edge| edge.facets.iter().filter(|&&f| f != NONE).count()).sum();
        assert_eq!(sides, of_edges);
        assert!(surface.nodes.is_sorted_by(|a, b| a < b));
    }

    #[test]
    fn a_cube_has_six_facets_and_twelve_edges() {
        let surface = SpaceSurface::outside(hexes(&block(1, |_| true))).unwrap();
        links_are_consistent(&surface);
        assert_eq!((surface.facets.len(), surface.edges.len(), surface.nodes.len()), (6, 12, 8));
        assert_eq!(surface.facets[0], [0, 1, 5, 4]);
        assert!(surface.edges.iter().all(|edge| !edge.facets.contains(&NONE)));
        assert!((0..8).all(|rank| surface.around(rank).len() == 3));
        assert!(surface.facets_at(99).is_empty());
    }

    #[test]
    fn wedges_and_tetrahedra_meet_hexahedra_without_an_outside_between_them() {
        let cells = [
            CellKind::Hexahedron.cell(&[0, 1, 2, 3, 4, 5, 6, 7]),
            CellKind::Wedge.cell(&[4, 8, 5, 7, 9, 6]),
            CellKind::Tetrahedron.cell(&[4, 5, 8, 10]),
        ];
        let surface = SpaceSurface::outside(cells).unwrap();
        links_are_consistent(&surface);
        assert_eq!(surface.facets.iter().filter(|facet| facet.corners().len() == 3).count(), 4);
        // Closed: V − E + F = 2.
        assert_eq!(surface.nodes.len() + surface.facets.len(), surface.edges.len() + 2);
    }

    #[test]
    fn bodies_that_touch_in_an_edge_stay_with_their_own_elements() {
        // Two cubes with one edge in common, from node 4 to node 13.
        let cells = block(2, |cell| cell == 0 || cell == 3);
        let surface = SpaceSurface::outside(hexes(&cells)).unwrap();
        links_are_consistent(&surface);
        assert_eq!((surface.facets.len(), surface.edges.len()), (12, 24));
        let of = |facet: u32| cells.iter().position(|cell| surface.facets[facet as usize].iter().all(|node| cell.contains(node)));
        assert!(surface.edges.iter().all(|edge| of(edge.facets[0]) == of(edge.facets[1])));
        assert_eq!(surface.edges.iter().filter(|edge| edge.nodes.contains(&4) && edge.nodes.contains(&13)).count(), 2);
    }

    #[test]
    fn a_side_alone_ends_at_open_edges() {
        let cells = block(2, |_| true);
        let top: Vec<[u32; 4]> = exterior::<3>(hexes(&cells)).unwrap().into_iter().filter(|facet| facet.iter().all(|&n| n >= 18)).collect();
        let surface = SpaceSurface::new(top.iter().rev().map(|&[a, b, c, d]| [c, d, a, b]).collect(), hexes(&cells)).unwrap();
        links_are_consistent(&surface);
        let given: Vec<[u32; 4]> = top.iter().rev().copied().collect();
        assert_eq!((&surface.facets, surface.nodes.len(), surface.edges.len()), (&given, 9, 12));
        assert_eq!(surface.edges.iter().filter(|edge| edge.facets[1] == NONE).count(), 8);
    }

    #[test]
    fn wrong_cells_and_facets_are_faults_that_name_nodes() {
        let cube = [0, 1, 2, 3, 4, 5, 6, 7];
        let above = [4, 5, 6, 7, 8, 9, 10, 11];
        let third = [4, 5, 6, 7, 12, 13, 14, 15];
        let message = |cells: &[[u32; 8]]| exterior::<3>(hexes(cells)).unwrap_err().message;
        assert!(message(&[cube, above, third]).contains("facet 4-5-6-7 belongs to 3 elements"));
        assert!(message(&[cube, third, cube]).contains("on the same side"));
        let below = [8, 9, 10, 11, 4, 5, 6, 7];
        assert!(message(&[cube, below]).contains("on the same side of the facet 4-"), "{}", message(&[cube, below]));
        let collapsed = [0, 1, 2, 2, 4, 5, 6, 6];
        assert!(message(&[collapsed]).contains("[0, 1, 2, 2, 4, 5, 6, 6]"));
        assert!(exterior::<3>([CellKind::Quadrilateral.cell(&[0, 1, 2, 3])]).is_err(), "a surface bounds no volume");
        assert!(exterior::<3>(std::iter::empty()).unwrap().is_empty());
        let outside = exterior::<3>(hexes(&[cube, above])).unwrap();
        assert_eq!(oriented(&[[5, 4, 0, 1], [1, 5, 4, 0]], &outside).unwrap(), [[0, 1, 5, 4]]);
        assert!(oriented(&[[4, 5, 6, 7]], &outside).unwrap_err().message.contains("facet 4-5-6-7 is not on the outside"));
        let fault = |facets: Vec<[u32; 4]>| SpaceSurface::new(facets, hexes(&[cube, above])).unwrap_err().message;
        assert!(fault(vec![[4, 5, 1, 0]]).contains("body before it"));
        assert!(fault(vec![[4, 5, 6, 7]]).contains("not on the outside"));
        assert!(fault(vec![[0, 1, 5, 4], [5, 4, 0, 1]]).contains("twice"));
    }

    proptest! {
        #[test]
        fn the_outside_of_any_part_of_a_mesh_closes_and_encloses_its_volume(
            keep in prop::collection::vec(any::<bool>(), 27), shift in prop::collection::vec(-0.2..0.2_f64, 192), order in any::<usize>(),
        ) {
            let cells = block(3, |cell| keep[cell as usize]);
            let positions: Vec<[f64; 3]> = (0..64_usize).map(|i| std::array::from_fn(|d| (i >> (2 * d) & 3) as f64 + shift[3 * i + d])).collect();
            let surface = SpaceSurface::outside(hexes(&cells)).unwrap();
            links_are_consistent(&surface);
            prop_assert!(surface.edges.iter().all(|edge| !edge.facets.contains(&NONE)));
            // Each facet's two triangles with its diagonal 0-2, and each hexahedron by its own facets: inside
            // they cancel only if facets are seen alike.
            let cone = |facet: &[u32; 4]| {
                let x = facet.map(|node| positions[node as usize]);
                let det = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| {
                    a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])
                };
                (det(x[0], x[1], x[2]) + det(x[0], x[2], x[3])) / 6.0
            };
            let of_cell = |cell: Cell<'_>| cell.facets().map(|facet| cone(&facet.canonical())).sum::<f64>();
            let (outside, inside): (f64, f64) = (surface.facets.iter().map(cone).sum(), hexes(&cells).map(of_cell).sum());
            prop_assert!((outside - inside).abs() < 1e-11, "{} {}", outside, inside);
            // The order of the cells, and how they are numbered, change nothing.
            let mut turned = cells.clone();
            if !turned.is_empty() {
                let by = order % turned.len();
                turned.rotate_left(by);
                turned.iter_mut().for_each(|cell| CellKind::Hexahedron.begin_with_lowest(cell));
            }
            prop_assert_eq!(exterior::<3>(hexes(&turned)).unwrap(), surface.facets.clone());
            // Nodes inside are distinguished from those outside.
            let mut sums = vec![0; 64];
            hexes(&cells).for_each(|cell| Dim::<3>::add_around(cell, &mut sums));
            prop_assert!((0..64).all(|node| (sums[node as usize] != 0) == surface.nodes.contains(&node)));
        }
    }
}
