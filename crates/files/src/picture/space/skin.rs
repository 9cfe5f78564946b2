//! The skin of solid cells: the sides that nothing lies against, their edges, and the facets around each
//! node. Made of the cells of a film, and again when cells have gone; obstacles in 3D are skins too.
//! Positions come with each frame; `scene` draws.

use super::sides::{NONE, Sides, corners, is_sound, sides_of};
use crate::outline::{cross, dot};
use embate_solver::archive::{Archive, ArchiveResult, Persist};
use embate_solver::output::{CellKind, Cells};

/// A triangle, which repeats its last corner, or a quadrilateral; outward by the right-hand rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Facet {
    /// Places in [`Skin::nodes`]; of [`Skinner::seen`] nodes.
    pub(crate) corners: [u32; 4],
    pub(crate) part: u32,
    /// Its cell in the frame's fields.
    pub(crate) cell: u32,
}

impl Facet {
    pub(super) fn is_triangle(&self) -> bool {
        self.corners[2] == self.corners[3]
    }

    /// Without the repeated one.
    pub(super) fn corners(&self) -> &[u32] {
        &self.corners[..if self.is_triangle() { 3 } else { 4 }]
    }
}

/// Where facets meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Edge {
    pub(super) nodes: [u32; 2],
    /// Two of its facets; [`NONE`] for the second where there is one.
    pub(super) facets: [u32; 2],
    /// Whether it is seen whatever the shape: it has another number of facets than two, or facets of two
    /// parts.
    pub(super) is_border: bool,
}

/// A bar of two nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Bar {
    pub(crate) nodes: [u32; 2],
    pub(crate) part: u32,
    pub(crate) cell: u32,
}

/// All that can be seen of bodies.
#[derive(Clone, Debug, Default)]
pub(in crate::picture) struct Skin {
    /// Nodes of the frame that it needs, ascending.
    pub(in crate::picture) nodes: Vec<u32>,
    pub(in crate::picture) facets: Vec<Facet>,
    pub(in crate::picture) bars: Vec<Bar>,
    pub(super) edges: Vec<Edge>,
    /// First place in `around` of each node.
    starts: Vec<u32>,
    around: Vec<u32>,
}

/// Makes the skins of one set of cells.
#[derive(Clone, Debug)]
pub(crate) struct Skinner {
    sides: Sides,
    /// Sides that nothing lies against while all cells are there, ascending.
    outer: Vec<u32>,
    bars: Vec<u32>,
    /// Shapes whose sides are inward as they are numbered.
    turned: Vec<CellKind>,
}

/// Cells of each shape by which it is reported which way its sides are numbered.
const TOLD_BY: usize = 100;

impl Skinner {
    /// Looks for the sides that lie against each other: the work that grows with the number of cells. Places
    /// of the nodes, m, say which side of a facet is outside.
    pub(crate) fn new(cells: &Cells, place: &dyn Fn(u32) -> [f64; 3]) -> Self {
        let sides = Sides::new(cells);
        let outer = (0..sides.len() as u32).filter(|&side| sides.partner(side).is_none()).collect();
        let is_bar = |cell: &u32| cells.kinds[*cell as usize] == CellKind::Line && is_sound(cells, *cell as usize);
        let bars = (0..cells.len() as u32).filter(is_bar).collect();
        let solids = CellKind::ALL.into_iter().filter(|kind| kind.dimension() == 3);
        let turned = solids.filter(|&kind| is_turned(cells, kind, place)).collect();
        Self { sides, outer, bars, turned }
    }

    /// The skin of the cells that are not `gone` (ascending).
    pub(in crate::picture) fn skin(&self, cells: &Cells, gone: &[u32]) -> Skin {
        let (facets, bars) = self.seen(cells, gone);
        Skin::of(facets, bars)
    }

    /// What can be seen of them, of cells in 2D too: facets and bars by the nodes of the frame, each
    /// by its cell, ascending.
    pub(crate) fn seen(&self, cells: &Cells, gone: &[u32]) -> (Vec<Facet>, Vec<Bar>) {
        let is_there = |cell: usize| gone.binary_search(&(cell as u32)).is_err();
        let mut seen: Vec<u32> = self.outer.iter().copied().filter(|&side| is_there(self.sides.cell(side).0)).collect();
        if !gone.is_empty() {
            let bared = gone.iter().flat_map(|&cell| self.sides.of(cell as usize)).filter_map(|side| self.sides.partner(side));
            seen.extend(bared.filter(|&side| is_there(self.sides.cell(side).0)));
            seen.sort_unstable();
        }
        let part = |cell: usize| cells.parts.get(cell).copied().unwrap_or(0);
        let facet = |side: u32| {
            let (cell, own) = self.sides.cell(side);
            let [a, b, c, d] = corners(cells, cell, &sides_of(cells.kinds[cell])[own]);
            let corners = match (self.turned.contains(&cells.kinds[cell]), c == d) {
                (false, _) => [a, b, c, d],
                (true, true) => [a, c, b, b],
                (true, false) => [a, d, c, b],
            };
            Facet { corners, part: part(cell), cell: cell as u32 }
        };
        let bar = |cell: u32| Bar { nodes: [cells.cell(cell as usize)[0], cells.cell(cell as usize)[1]], part: part(cell as usize), cell };
        let bars = self.bars.iter().copied().filter(|&cell| is_there(cell as usize)).map(bar).collect();
        (seen.into_iter().map(facet).collect(), bars)
    }
}

/// Whether the sides of most cells of a shape are inward: what they enclose has a negative volume (divergence
/// theorem).
fn is_turned(cells: &Cells, kind: CellKind, place: &dyn Fn(u32) -> [f64; 3]) -> bool {
    let volume = |cell: usize| -> f64 {
        let origin = place(cells.cell(cell)[0]);
        let at = |node: u32| {
            let x = place(node);
            [x[0] - origin[0], x[1] - origin[1], x[2] - origin[2]]
        };
        let six = |side: &[u8; 4]| {
            let [a, b, c, d] = corners(cells, cell, side).map(at);
            dot(a, cross(b, c)) + dot(a, cross(c, d))
        };
        sides_of(kind).iter().map(six).sum()
    };
    let reported_by = (0..cells.len()).filter(|&cell| cells.kinds[cell] == kind && is_sound(cells, cell)).take(TOLD_BY);
    let balance: i32 = reported_by.map(|cell| if volume(cell) < 0.0 { -1 } else { 1 }).sum();
    balance < 0
}

impl Skin {
    /// The facets of an obstacle, corners as places in its points; those that name a point that is not there
    /// are left out.
    pub(in crate::picture) fn of_obstacle(facets: &[[u32; 4]], points: usize) -> Self {
        let is_sound = |corners: &&[u32; 4]| corners.iter().all(|&corner| (corner as usize) < points);
        Self::of(facets.iter().filter(is_sound).map(|&corners| Facet { corners, part: 0, cell: 0 }).collect(), Vec::new())
    }

    /// Facets and bars of nodes of the frame.
    fn of(mut facets: Vec<Facet>, mut bars: Vec<Bar>) -> Self {
        let mut nodes: Vec<u32> = facets.iter().flat_map(|facet| facet.corners).chain(bars.iter().flat_map(|bar| bar.nodes)).collect();
        nodes.sort_unstable();
        nodes.dedup();
        let mut own = vec![NONE; nodes.last().map_or(0, |&last| last as usize + 1)];
        for (place, &node) in (0..).zip(&nodes) {
            own[node as usize] = place;
        }
        for corner in facets.iter_mut().flat_map(|facet| &mut facet.corners).chain(bars.iter_mut().flat_map(|bar| &mut bar.nodes)) {
            *corner = own[*corner as usize];
        }
        Self::with(nodes, facets, bars)
    }

    /// Facets and bars of places in `nodes`.
    fn with(nodes: Vec<u32>, facets: Vec<Facet>, bars: Vec<Bar>) -> Self {
        let edges = edges(&facets);
        let (starts, around) = around(&facets, nodes.len());
        Self { nodes, facets, bars, edges, starts, around }
    }

    /// Memory that it needs.
    pub(in crate::picture) fn bytes(&self) -> usize {
        4 * (self.nodes.len() + self.starts.len() + self.around.len())
            + size_of_val(&self.facets[..])
            + size_of_val(&self.bars[..])
            + size_of_val(&self.edges[..])
    }

    /// The facets that have a node.
    pub(super) fn around(&self, node: u32) -> &[u32] {
        &self.around[self.starts[node as usize] as usize..self.starts[node as usize + 1] as usize]
    }
}

impl Persist for Skin {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        // Edges and what is around a node follow from the facets.
        let Self { nodes, facets, bars, edges: _, starts: _, around: _ } = self;
        let mut corners: Vec<_> = facets.iter().map(|facet| (facet.corners, [facet.part, facet.cell])).collect();
        let mut ends: Vec<_> = bars.iter().map(|bar| (bar.nodes, [bar.part, bar.cell])).collect();
        nodes.persist(archive)?;
        corners.persist(archive)?;
        ends.persist(archive)?;
        let is_there = |&place: &u32| (place as usize) < nodes.len();
        let is_sound = corners.iter().flat_map(|(corners, _)| corners).chain(ends.iter().flat_map(|(ends, _)| ends)).all(is_there);
        archive.check(is_sound, "a skin has nodes that are not there")?;
        if archive.reads() {
            let facets = corners.into_iter().map(|(corners, [part, cell])| Facet { corners, part, cell }).collect();
            let bars = ends.into_iter().map(|(nodes, [part, cell])| Bar { nodes, part, cell }).collect();
            *self = Self::with(std::mem::take(nodes), facets, bars);
        }
        Ok(())
    }
}

/// Every edge once, ascending.
fn edges(facets: &[Facet]) -> Vec<Edge> {
    let mut sides: Vec<([u32; 2], u32)> = Vec::with_capacity(4 * facets.len());
    for (index, facet) in (0..).zip(facets) {
        let corners = facet.corners();
        for (k, &a) in corners.iter().enumerate() {
            let b = corners[(k + 1) % corners.len()];
            sides.push(([a.min(b), a.max(b)], index));
        }
    }
    sides.sort_unstable();
    let part = |side: &([u32; 2], u32)| facets[side.1 as usize].part;
    let edge = |same: &[([u32; 2], u32)]| Edge {
        nodes: same[0].0,
        facets: [same[0].1, same.get(1).map_or(NONE, |side| side.1)],
        is_border: same.len() != 2 || part(&same[0]) != part(&same[1]),
    };
    sides.chunk_by(|a, b| a.0 == b.0).map(edge).collect()
}

/// For each node the facets that have it, one node after the other, and where each one's begin.
fn around(facets: &[Facet], nodes: usize) -> (Vec<u32>, Vec<u32>) {
    let mut starts = vec![0u32; nodes + 1];
    let all = || (0..).zip(facets).flat_map(|(index, facet)| facet.corners().iter().map(move |&node| (node as usize, index)));
    all().for_each(|(node, _)| starts[node + 1] += 1);
    for node in 0..nodes {
        starts[node + 1] += starts[node];
    }
    let mut next = starts.clone();
    let mut around = vec![0u32; starts[nodes] as usize];
    for (node, index) in all() {
        around[next[node] as usize] = index;
        next[node] += 1;
    }
    (starts, around)
}

#[cfg(test)]
mod tests {
    use super::super::sides::tests::block;
    use super::*;

    /// Places of the nodes of a block.
    fn place([nx, ny, _]: [u32; 3]) -> impl Fn(u32) -> [f64; 3] {
        move |node| [node % (nx + 1), node / (nx + 1) % (ny + 1), node / ((nx + 1) * (ny + 1))].map(f64::from)
    }

    /// Six times the volume within: by the divergence theorem, positive where all facets are outward.
    fn volume(skin: &Skin, place: &dyn Fn(u32) -> [f64; 3]) -> f64 {
        let at = |corner: u32| place(skin.nodes[corner as usize]);
        let six = |facet: &Facet| {
            let [a, b, c, d] = facet.corners.map(at);
            dot(a, cross(b, c)) + dot(a, cross(c, d))
        };
        skin.facets.iter().map(six).sum::<f64>() / 6.0
    }

    #[test]
    fn the_skin_of_a_block_is_its_outside_and_encloses_its_volume() {
        let size = [5, 4, 3];
        let cells = block(size);
        let skin = Skinner::new(&cells, &place(size)).skin(&cells, &[]);
        assert_eq!(skin.facets.len(), 2 * (20 + 15 + 12));
        assert_eq!(skin.nodes.len(), 6 * 5 * 4 - 4 * 3 * 2);
        assert_eq!(skin.edges.len(), 2 * skin.facets.len(), "each of four sides is shared by two");
        assert!(skin.edges.iter().all(|edge| !edge.is_border));
        assert!((volume(&skin, &place(size)) - 60.0).abs() < 1e-12);
    }

    #[test]
    fn cells_that_are_turned_inside_out_have_an_outward_skin_all_the_same() {
        let size = [2, 2, 2];
        let mut cells = block(size);
        cells.nodes.chunks_exact_mut(8).for_each(|nodes| nodes.rotate_left(4));
        let skin = Skinner::new(&cells, &place(size)).skin(&cells, &[]);
        assert!((volume(&skin, &place(size)) - 8.0).abs() < 1e-12);
    }

    #[test]
    fn where_cells_have_gone_the_skin_runs_around_the_hole() {
        let size = [3, 3, 3];
        let cells = block(size);
        let skinner = Skinner::new(&cells, &place(size));
        // The middle: a hole that is not seen from outside; then a corner; then two neighbours on the
        // outside.
        for (gone, facets) in [(vec![13], 54 + 6), (vec![0], 54), (vec![0, 1], 54 + 2 - 2), (vec![4, 13], 54 - 1 + 5 + 4)] {
            let skin = skinner.skin(&cells, &gone);
            assert_eq!(skin.facets.len(), facets, "without {gone:?}");
            assert!((volume(&skin, &place(size)) - (27.0 - gone.len() as f64)).abs() < 1e-12);
            assert!(skin.facets.iter().all(|facet| !gone.contains(&facet.cell)));
        }
    }

    #[test]
    fn each_corner_knows_the_facets_around_it() {
        let size = [2, 2, 2];
        let cells = block(size);
        let skin = Skinner::new(&cells, &place(size)).skin(&cells, &[]);
        for node in 0..skin.nodes.len() as u32 {
            let wanted: Vec<u32> = (0..24).filter(|&facet| skin.facets[facet as usize].corners().contains(&node)).collect();
            assert_eq!(skin.around(node), wanted);
        }
    }

    #[test]
    fn an_obstacle_without_some_of_its_points_is_drawn_without_their_facets() {
        let skin = Skin::of_obstacle(&[[0, 1, 2, 3], [1, 4, 2, 2]], 4);
        assert_eq!((skin.facets.len(), skin.edges.len()), (1, 4));
        assert!(skin.edges.iter().all(|edge| edge.is_border));
    }
}
