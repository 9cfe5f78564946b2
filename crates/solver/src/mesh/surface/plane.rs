//! The outside of bodies in 2D: element edges that occur once, oriented with the body on their right
//! and linked to chains.
//!
//! Cells come from the shapes and mesh files; surfaces go to contact. Where corners of bodies, or two corners
//! of one body, touch in a single node, each chain stays with its own fan of elements, so that normals never
//! mix across the touching point.

use super::NONE;
use crate::error::Fault;
use crate::mesh::cell::Cell;
use crate::mesh::messages::{BAD_ELEMENT, NOT_A_SURFACE, OVERLAP};
use crate::rows::Rows;

/// An oriented surface in 2D. Segment `[a, b]` runs a → b with the body on its right.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlaneSurface {
    /// Node pairs.
    pub segments: Vec<[u32; 2]>,
    /// Segment that ends where each segment begins, or [`NONE`].
    pub previous: Vec<u32>,
    /// Segment that begins where each segment ends, or [`NONE`].
    pub next: Vec<u32>,
    /// All nodes, ascending, each once.
    pub nodes: Vec<u32>,
}

impl PlaneSurface {
    /// The outside segments of `cells`, not linked; see [`exterior`](super::exterior).
    pub(in crate::mesh) fn exterior<'a>(cells: impl IntoIterator<Item = Cell<'a>, IntoIter: Clone>) -> Result<Vec<[u32; 2]>, Fault> {
        Ok(Edges::new(cells)?.exterior())
    }

    /// The whole outside of `cells` (of surfaces, counter-clockwise), in the order of
    /// [`exterior`](super::exterior).
    ///
    /// # Errors
    /// As [`exterior`](super::exterior).
    pub fn outside<'a>(cells: impl IntoIterator<Item = Cell<'a>, IntoIter: Clone>) -> Result<Self, Fault> {
        Self::outside_without(cells, |_| false)
    }

    /// The same without the segments that `leave_out` names, which is asked once for each in this order.
    ///
    /// # Errors
    /// As [`exterior`](super::exterior).
    pub fn outside_without<'a>(
        cells: impl IntoIterator<Item = Cell<'a>, IntoIter: Clone>,
        leave_out: impl Fn([u32; 2]) -> bool,
    ) -> Result<Self, Fault> {
        let edges = Edges::new(cells)?;
        let segments = edges.exterior().into_iter().filter(|&segment| !leave_out(segment)).collect();
        Self::linked(segments, &edges)
    }

    /// The part of the outside of `cells` that consists of `segments`, kept in their order.
    ///
    /// Segments that don't follow each other along the outside are not linked: a side alone begins and ends
    /// with [`NONE`].
    ///
    /// # Errors
    /// A fault when the cells are wrong (see [`exterior`](super::exterior)), when a segment is no outside
    /// edge with the body on its right (see [`oriented`](super::oriented)), or when one is given twice.
    pub fn new<'a>(segments: Vec<[u32; 2]>, cells: impl IntoIterator<Item = Cell<'a>, IntoIter: Clone>) -> Result<Self, Fault> {
        Self::linked(segments, &Edges::new(cells)?)
    }

    fn linked(segments: Vec<[u32; 2]>, edges: &Edges) -> Result<Self, Fault> {
        let mut by_nodes: Vec<(u32, u32, u32)> = segments.iter().zip(0..).map(|(&[a, b], s)| (a, b, s)).collect();
        by_nodes.sort_unstable();
        if let Some(twice) = by_nodes.windows(2).find(|w| (w[0].0, w[0].1) == (w[1].0, w[1].1)) {
            let (a, b, _) = twice[0];
            return Err(Fault::new(
                &NOT_A_SURFACE,
                "",
                format!("segment {a}-{b} occurs twice in a surface"),
                "name each side or group once",
            ));
        }
        let find = |[a, b]: [u32; 2]| by_nodes.binary_search_by_key(&(a, b), |&(a, b, _)| (a, b)).ok().map(|i| by_nodes[i].2);
        let mut previous = vec![NONE; segments.len()];
        let mut next = vec![NONE; segments.len()];
        for (&[a, b], s) in segments.iter().zip(0_u32..) {
            let Some(follower) = edges.following([a, b]) else {
                return Err(Fault::new(
                    &NOT_A_SURFACE,
                    "",
                    format!("segment {a}-{b} is not on the outside of its body, or has the body on its left"),
                    "take lines that bound the elements of one part; contact acts on the outside only",
                ));
            };
            if let Some(n) = find(follower) {
                next[s as usize] = n;
                previous[n as usize] = s;
            }
        }
        let mut nodes: Vec<u32> = segments.iter().flatten().copied().collect();
        nodes.sort_unstable();
        nodes.dedup();
        Ok(Self { segments, previous, next, nodes })
    }
}

/// Every directed edge of every cell from each node: (to, node before `from` in the same cell), ascending.
struct Edges(Rows<(u32, u32)>);

impl Edges {
    /// Edges are counted, then put into their places: no sorting but of the few at one node.
    fn new<'a>(cells: impl IntoIterator<Item = Cell<'a>, IntoIter: Clone>) -> Result<Self, Fault> {
        let cells = cells.into_iter();
        let mut count = 0;
        for cell in cells.clone() {
            if cell.kind.dimension() != 2 || cell.is_collapsed() {
                let help = "elements have three, four or six different nodes; remove collapsed ones from the mesh";
                return Err(Fault::new(&BAD_ELEMENT, "", format!("an element has the nodes {:?}", cell.nodes), help));
            }
            count = cell.nodes.iter().fold(count, |count, &node| count.max(node as usize + 1));
        }
        let of_cell = |cell: Cell<'a>| {
            let n = cell.nodes.len();
            let shifted = move |by: usize| cell.around().cycle().skip(by);
            shifted(0).zip(shifted(1).zip(shifted(n - 1))).take(n)
        };
        let mut rows = Rows::new(count, cells.flat_map(of_cell));
        (0..count).for_each(|node| rows.of_mut(node).sort_unstable());
        let edges = Self(rows);
        edges.check()?;
        Ok(edges)
    }

    /// Edges from `node`.
    fn from(&self, node: u32) -> &[(u32, u32)] {
        if (node as usize) < self.0.count() { self.0.of(node as usize) } else { &[] }
    }

    /// All edges: from, to.
    fn all(&self) -> impl Iterator<Item = (u32, u32)> {
        (0..self.0.count() as u32).flat_map(|a| self.from(a).iter().map(move |&(b, _)| (a, b)))
    }

    fn check(&self) -> Result<(), Fault> {
        for a in 0..self.0.count() as u32 {
            let Some(twice) = self.from(a).windows(2).find(|w| w[0].0 == w[1].0) else { continue };
            let b = twice[0].0;
            let count = self.all().filter(|&e| e == (a, b) || e == (b, a)).count();
            return Err(if count > 2 {
                Fault::new(
                    &OVERLAP,
                    "",
                    format!("the edge between nodes {a} and {b} belongs to {count} elements"),
                    "in 2D an edge has at most two; remove elements that overlap or occur twice",
                )
            } else {
                Fault::new(
                    &OVERLAP,
                    "",
                    format!("two elements run through the edge from node {a} to node {b} in the same direction"),
                    "elements must be counter-clockwise and must not overlap; reverse or remove one of them",
                )
            });
        }
        Ok(())
    }

    /// The node before the edge a → b in the cell that has it.
    fn before(&self, a: u32, b: u32) -> Option<u32> {
        self.from(a).iter().find(|edge| edge.0 == b).map(|edge| edge.1)
    }

    /// The outside segment after the outside segment a → b: around node b, through the elements of its fan.
    /// `None` when a → b is not outside.
    fn following(&self, [a, b]: [u32; 2]) -> Option<[u32; 2]> {
        if self.before(a, b).is_some() {
            return None;
        }
        // The cell on the right runs b → a; the fan's next edge at b is (before, b), seen from the neighbour
        // as b → before.
        let mut end = self.before(b, a)?;
        while let Some(further) = self.before(b, end) {
            end = further;
        }
        Some([b, end])
    }

    fn exterior(&self) -> Vec<[u32; 2]> {
        let mut segments: Vec<[u32; 2]> = self.all().filter(|&(a, b)| self.before(b, a).is_none()).map(|(a, b)| [b, a]).collect();
        segments.sort_unstable();
        let mut taken = vec![false; segments.len()];
        let mut chains = Vec::with_capacity(segments.len());
        for first in 0..segments.len() {
            let mut at = first;
            while !std::mem::replace(&mut taken[at], true) {
                chains.push(segments[at]);
                // An outside edge is followed by an outside edge, and no two by the same: chains close.
                match self.following(segments[at]).and_then(|s| segments.binary_search(&s).ok()) {
                    Some(next) => at = next,
                    None => break,
                }
            }
        }
        chains
    }
}

#[cfg(test)]
mod tests {
    use super::super::oriented;
    use super::*;
    use crate::mesh::cell::CellKind;
    use crate::mesh::shapes::{disk, rectangle, ring};
    use proptest::prelude::*;

    fn quads(cells: &[[u32; 4]]) -> impl Iterator<Item = Cell<'_>> + Clone {
        CellKind::Quadrilateral.cells(cells.as_flattened())
    }

    fn exterior<'a>(cells: impl IntoIterator<Item = Cell<'a>, IntoIter: Clone>) -> Result<Vec<[u32; 2]>, Fault> {
        PlaneSurface::exterior(cells)
    }

    fn links_are_consistent(surface: &PlaneSurface) {
        for s in 0..surface.segments.len() {
            for (there, back, end) in [(&surface.next, &surface.previous, 1), (&surface.previous, &surface.next, 0)] {
                let other = there[s];
                if other != NONE {
                    assert_eq!(back[other as usize], s as u32);
                    assert_eq!(surface.segments[other as usize][1 - end], surface.segments[s][end]);
                }
            }
        }
    }

    fn shoelace(segments: &[[u32; 2]], positions: &[[f64; 2]]) -> f64 {
        segments.iter().map(|s| s.map(|n| positions[n as usize])).map(|[p, q]| 0.5 * (p[0] * q[1] - p[1] * q[0])).sum()
    }

    fn area(quads: &[[u32; 4]], positions: &[[f64; 2]]) -> f64 {
        let edges = |q: &[u32; 4]| [[q[0], q[1]], [q[1], q[2]], [q[2], q[3]], [q[3], q[0]]];
        quads.iter().map(|q| shoelace(&edges(q), positions)).sum()
    }

    #[test]
    fn one_triangle_is_bounded_clockwise_from_its_lowest_node() {
        let cell = [7_u32, 2, 5];
        assert_eq!(exterior([CellKind::Triangle.cell(&cell)]).unwrap(), [[2, 7], [7, 5], [5, 2]]);
    }

    #[test]
    fn a_quad_and_a_triangle_share_no_outside_edge() {
        let cells = [CellKind::Quadrilateral.cell(&[0, 1, 2, 3]), CellKind::Triangle.cell(&[1, 4, 2])];
        assert_eq!(exterior(cells).unwrap(), [[0, 3], [3, 2], [2, 4], [4, 1], [1, 0]]);
    }

    #[test]
    fn a_ring_has_two_closed_chains() {
        let body = ring([0.0, 0.0], 1.0, 2.0, 0.0, std::f64::consts::TAU, [2, 12]);
        let surface = PlaneSurface::outside(quads(body.all::<4>(CellKind::Quadrilateral))).unwrap();
        links_are_consistent(&surface);
        let mut lengths = vec![];
        let mut at = 0;
        while at < surface.segments.len() {
            let start = at;
            while surface.next[at] as usize == at + 1 {
                at += 1;
            }
            assert_eq!(surface.next[at] as usize, start);
            at += 1;
            lengths.push(at - start);
        }
        assert_eq!(lengths, [12, 12]);
        assert_eq!(surface.nodes.len(), 24);
    }

    #[test]
    fn touching_corners_stay_with_their_own_elements() {
        // Two unit squares that share only node 2, diagonally.
        let cells = [[0, 1, 2, 3], [2, 4, 5, 6]];
        let surface = PlaneSurface::outside(quads(&cells)).unwrap();
        links_are_consistent(&surface);
        assert_eq!(surface.segments, [[0, 3], [3, 2], [2, 1], [1, 0], [2, 6], [6, 5], [5, 4], [4, 2]]);
        assert_eq!(surface.next, [1, 2, 3, 0, 5, 6, 7, 4]);
        assert_eq!(surface.nodes, [0, 1, 2, 3, 4, 5, 6]);
    }

    #[test]
    fn a_body_pinched_to_one_node_is_walked_around_each_fan() {
        // A 3 x 3 block without its centre and without the cell to its right below: the hole touches the
        // notch in a node.
        let body = rectangle([0.0, 0.0], [3.0, 3.0], [3, 3]);
        let left: Vec<_> = body.cells().enumerate().filter(|(i, _)| ![4, 2].contains(i)).map(|(_, cell)| cell).collect();
        let surface = PlaneSurface::outside(left.iter().copied()).unwrap();
        links_are_consistent(&surface);
        assert!(surface.next.iter().chain(&surface.previous).all(|&n| n != NONE));
        assert!((shoelace(&surface.segments, &body.positions) + 7.0).abs() < 1e-12);
        // At the pinch each chain turns within its own fan: from below to the right side's cell, and back.
        for s in &surface.segments {
            let at = surface.segments.iter().position(|t| t == s).unwrap();
            let next = surface.segments[surface.next[at] as usize];
            assert!(left.iter().any(|q| q.nodes.contains(&s[0]) && q.nodes.contains(&s[1])));
            if s[1] == 6 {
                let fan = |n: u32| left.iter().position(|q| q.nodes.contains(&n) && q.nodes.contains(&6));
                let together = fan(s[0]).is_some() && left.iter().any(|q| [s[0], next[1], 6].iter().all(|n| q.nodes.contains(n)));
                assert!(together, "{s:?} -> {next:?}");
            }
        }
    }

    #[test]
    fn a_side_alone_is_an_open_surface() {
        let body = rectangle([0.0, 0.0], [4.0, 2.0], [4, 2]);
        let (name, top) = body.sides[3].clone();
        assert_eq!(name, "top");
        let surface = PlaneSurface::new(top, quads(body.all::<4>(CellKind::Quadrilateral))).unwrap();
        links_are_consistent(&surface);
        assert_eq!((surface.previous[0], surface.next[0]), (NONE, 1));
        assert_eq!((surface.previous[3], surface.next[3]), (2, NONE));
        assert_eq!(surface.nodes.len(), 5);
    }

    #[test]
    fn lines_from_a_file_are_turned_to_have_the_body_on_their_right() {
        let body = rectangle([0.0, 0.0], [2.0, 1.0], [2, 1]);
        let outside = exterior(quads(body.all::<4>(CellKind::Quadrilateral))).unwrap();
        assert_eq!(oriented(&[[3, 4], [5, 4], [3, 4]], &outside).unwrap(), [[3, 4], [4, 5]]);
        let fault = oriented(&[[1, 4]], &outside).unwrap_err();
        assert!(fault.message.contains("1-4"), "{fault}");
        let fault = PlaneSurface::new(vec![[4, 3]], quads(body.all::<4>(CellKind::Quadrilateral))).unwrap_err();
        assert!(fault.message.contains("4-3"), "{fault}");
        let fault = PlaneSurface::new(vec![[3, 4], [3, 4]], quads(body.all::<4>(CellKind::Quadrilateral))).unwrap_err();
        assert!(fault.message.contains("twice"), "{fault}");
    }

    #[test]
    fn wrong_cells_are_faults_that_name_nodes() {
        let thrice = [[0, 1, 2, 3], [1, 0, 4, 5], [0, 1, 6, 7]];
        assert!(exterior(quads(&thrice)).unwrap_err().message.contains("nodes 0 and 1 belongs to 3 elements"));
        let clockwise = [[0, 1, 2, 3], [1, 2, 5, 4]];
        assert!(exterior(quads(&clockwise)).unwrap_err().message.contains("from node 1 to node 2"));
        let collapsed = [[0, 1, 2, 2]];
        assert!(exterior(quads(&collapsed)).unwrap_err().message.contains("[0, 1, 2, 2]"));
        assert!(exterior([CellKind::Line.cell(&[0, 1])]).is_err());
        assert_eq!(exterior(std::iter::empty()).unwrap(), Vec::<[u32; 2]>::new());
    }

    #[test]
    fn the_outside_of_a_disk_is_its_side() {
        let body = disk([0.0, 0.0], 1.0, 5);
        let surface = PlaneSurface::outside(quads(body.all::<4>(CellKind::Quadrilateral))).unwrap();
        assert_eq!(surface.segments.len(), 20);
        assert!(
            (shoelace(&surface.segments, &body.positions) + area(body.all::<4>(CellKind::Quadrilateral), &body.positions)).abs() < 1e-14
        );
    }

    proptest! {
        #[test]
        fn the_outside_of_any_part_of_a_mesh_closes_and_encloses_its_area(
            nx in 1_usize..8, ny in 1_usize..8, keep in prop::collection::vec(any::<bool>(), 64), shift in prop::collection::vec(-0.3..0.3_f64, 162),
            order in any::<u64>(),
        ) {
            let body = rectangle([0.0, 0.0], [nx as f64, ny as f64], [nx, ny]);
            let positions: Vec<_> = body.positions.iter().enumerate().map(|(i, p)| [p[0] + shift[2 * i], p[1] + shift[2 * i + 1]]).collect();
            let left: Vec<_> = body.all::<4>(CellKind::Quadrilateral).iter().zip(&keep).filter(|(_, k)| **k).map(|(q, _)| *q).collect();
            let surface = PlaneSurface::outside(quads(&left)).unwrap();
            links_are_consistent(&surface);
            prop_assert!(surface.next.iter().chain(&surface.previous).all(|&n| n != NONE));
            prop_assert!((shoelace(&surface.segments, &positions) + area(&left, &positions)).abs() < 1e-12);
            let sum = |d: usize| surface.segments.iter().map(|s| positions[s[1] as usize][d] - positions[s[0] as usize][d]).sum::<f64>();
            prop_assert!(sum(0).abs() < 1e-12 && sum(1).abs() < 1e-12);
            // The order of the cells changes nothing.
            let mut turned = left.clone();
            if !turned.is_empty() {
                let by = order as usize % turned.len();
                turned.rotate_left(by);
                turned.iter_mut().for_each(|q| q.rotate_left(by % 4));
            }
            prop_assert_eq!(exterior(quads(&turned)).unwrap(), surface.segments);
        }
    }
}
