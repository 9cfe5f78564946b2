//! Sides of solid cells: which nodes each has, and which side of another cell lies against it.
//! Found once for the cells of a film; `skin` takes those that nothing lies against.

use embate_solver::output::{CellKind, Cells};

/// No side, no facet.
pub(super) const NONE: u32 = u32::MAX;

/// Corners of each side of a cell; the last is repeated where there are three. A surface is its own side.
pub(super) fn sides_of(kind: CellKind) -> &'static [[u8; 4]] {
    kind.facts().facets
}

/// The sides of all cells.
#[derive(Clone, Debug, Default)]
pub(super) struct Sides {
    /// First side of each cell, and the number of sides at the end.
    starts: Vec<u32>,
    /// The side that lies against each one; [`NONE`] where there is none.
    partners: Vec<u32>,
}

impl Sides {
    /// Pairs the sides that have the same corners. Cells whose nodes are listed wrongly have no sides.
    pub(super) fn new(cells: &Cells) -> Self {
        let mut starts = Vec::with_capacity(cells.len() + 1);
        starts.push(0);
        let mut keys: Vec<[u32; 4]> = Vec::new();
        for cell in 0..cells.len() {
            for side in if is_sound(cells, cell) { sides_of(cells.kinds[cell]) } else { Default::default() } {
                keys.push(key(corners(cells, cell, side)));
            }
            starts.push(keys.len() as u32);
        }
        let partners = paired(&keys);
        Self { starts, partners }
    }

    /// The sides of a cell, by number.
    pub(super) fn of(&self, cell: usize) -> std::ops::Range<u32> {
        self.starts[cell]..self.starts[cell + 1]
    }

    /// What lies against a side.
    pub(super) fn partner(&self, side: u32) -> Option<u32> {
        Some(self.partners[side as usize]).filter(|&partner| partner != NONE)
    }

    /// The cell of a side, and which of its sides it is.
    pub(super) fn cell(&self, side: u32) -> (usize, usize) {
        let cell = self.starts.partition_point(|&start| start <= side) - 1;
        (cell, (side - self.starts[cell]) as usize)
    }

    /// Number of all sides.
    pub(super) fn len(&self) -> usize {
        self.partners.len()
    }
}

/// Whether a cell has as many nodes as its shape needs.
pub(super) fn is_sound(cells: &Cells, cell: usize) -> bool {
    let count = cells.kinds[cell].nodes();
    let ends = cells.offsets.get(cell).zip(cells.offsets.get(cell + 1));
    ends.and_then(|(&from, &to)| cells.nodes.get(from as usize..to as usize)).is_some_and(|nodes| nodes.len() == count)
}

/// Nodes of a side of a cell.
pub(super) fn corners(cells: &Cells, cell: usize, side: &[u8; 4]) -> [u32; 4] {
    let nodes = cells.cell(cell);
    side.map(|corner| nodes[usize::from(corner)])
}

/// The same for all orders of the corners.
fn key(mut corners: [u32; 4]) -> [u32; 4] {
    if corners[2] == corners[3] {
        corners[3] = NONE;
    }
    corners.sort_unstable();
    corners
}

/// For each key the place of the other one that is equal: sides are laid out by their first node, where few
/// remain to be compared.
fn paired(keys: &[[u32; 4]]) -> Vec<u32> {
    let nodes = keys.iter().map(|key| key[0] as usize + 1).max().unwrap_or(0);
    let mut places = vec![0u32; nodes + 1];
    for key in keys {
        places[key[0] as usize + 1] += 1;
    }
    for node in 0..nodes {
        places[node + 1] += places[node];
    }
    let starts = places.clone();
    let mut laid_out = vec![([0u32; 3], 0u32); keys.len()];
    for (side, key) in (0..).zip(keys) {
        let place = &mut places[key[0] as usize];
        laid_out[*place as usize] = ([key[1], key[2], key[3]], side);
        *place += 1;
    }
    let mut partners = vec![NONE; keys.len()];
    for node in starts.windows(2) {
        let group = &mut laid_out[node[0] as usize..node[1] as usize];
        group.sort_unstable();
        let mut at = 0;
        while at + 1 < group.len() {
            let ((one, a), (other, b)) = (group[at], group[at + 1]);
            if one == other {
                (partners[a as usize], partners[b as usize]) = (b, a);
                at += 1;
            }
            at += 1;
        }
    }
    partners
}

#[cfg(test)]
pub(in crate::picture) mod tests {
    use super::*;

    /// Cells in a block of so many, with node `i + (nx + 1) (j + (ny + 1) k)`.
    pub(in crate::picture) fn block([nx, ny, nz]: [u32; 3]) -> Cells {
        let mut cells = Cells { offsets: vec![0], part_names: vec!["block".into()], ..Cells::default() };
        let node = |i: u32, j: u32, k: u32| i + (nx + 1) * (j + (ny + 1) * k);
        for k in 0..nz {
            for j in 0..ny {
                for i in 0..nx {
                    let layer = |k: u32| [node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)];
                    cells.nodes.extend([layer(k), layer(k + 1)].concat());
                    cells.offsets.push(cells.nodes.len() as u32);
                    cells.kinds.push(CellKind::Hexahedron);
                    cells.parts.push(0);
                }
            }
        }
        cells
    }

    #[test]
    fn each_inner_side_has_one_partner_and_it_has_the_same_corners() {
        let cells = block([3, 4, 5]);
        let sides = Sides::new(&cells);
        assert_eq!(sides.len(), 6 * 60);
        let alone = (0..360).filter(|&side| sides.partner(side).is_none()).count();
        assert_eq!(alone, 2 * (12 + 15 + 20));
        for side in 0..360 {
            let Some(other) = sides.partner(side) else { continue };
            assert_eq!(sides.partner(other), Some(side));
            let key = |side| {
                let (cell, own) = sides.cell(side);
                assert!(sides.of(cell).contains(&side));
                key(corners(&cells, cell, &sides_of(CellKind::Hexahedron)[own]))
            };
            assert_eq!(key(side), key(other));
        }
    }

    #[test]
    fn a_wedge_meets_a_hexahedron_a_tetrahedron_and_no_other_tetrahedron_twice() {
        // A hexahedron 0..8, a wedge on its side x = 1, a tetrahedron on the wedge's upper triangle, and one
        // without the nodes that it needs.
        let cells = Cells {
            nodes: vec![0, 1, 2, 3, 4, 5, 6, 7, 1, 8, 2, 5, 9, 6, 5, 9, 6, 10, 1, 2, 3],
            offsets: vec![0, 8, 14, 18, 21],
            kinds: vec![CellKind::Hexahedron, CellKind::Wedge, CellKind::Tetrahedron, CellKind::Tetrahedron],
            parts: vec![0; 4],
            part_names: vec!["a".into()],
            revision: 0,
        };
        let sides = Sides::new(&cells);
        let pairs: Vec<(usize, usize)> =
            (0..sides.len() as u32).filter_map(|side| Some((sides.cell(side).0, sides.cell(sides.partner(side)?).0))).collect();
        assert_eq!(pairs, [(0, 1), (1, 2), (1, 0), (2, 1)]);
    }
}
