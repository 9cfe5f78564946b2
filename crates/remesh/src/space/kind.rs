//! Cells and meshes in 3D.

/// A place, m.
pub type Point = [f64; 3];

/// Most nodes of a cell.
pub(super) const MOST: usize = 10;

/// Kinds of cells. Nodes are numbered from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Four nodes; seen from the last, the first three run counter-clockwise.
    Tetrahedron,
    /// Six nodes: two triangles; seen from the second, the first runs counter-clockwise.
    Wedge,
    /// Eight nodes: two quadrilaterals; seen from the second, the first runs counter-clockwise.
    Hexahedron,
    /// Ten nodes: a tetrahedron, and the middles of its edges 01, 12, 20, 03, 13, 23.
    Tetrahedron10,
}

/// Edges of a tetrahedron in the order of the nodes in their middles.
pub(super) const EDGES: [[u8; 2]; 6] = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];

impl Kind {
    /// Every kind.
    pub const ALL: [Self; 4] = [Self::Tetrahedron, Self::Wedge, Self::Hexahedron, Self::Tetrahedron10];

    /// Number of nodes.
    #[must_use]
    pub const fn nodes(self) -> usize {
        match self {
            Self::Tetrahedron => 4,
            Self::Wedge => 6,
            Self::Hexahedron => 8,
            Self::Tetrahedron10 => 10,
        }
    }

    /// Number of nodes that are corners: these come first.
    pub(super) const fn corners(self) -> usize {
        match self {
            Self::Tetrahedron10 => 4,
            _ => self.nodes(),
        }
    }

    /// Corners of each face, in their order around it.
    pub(super) const fn faces(self) -> &'static [&'static [u8]] {
        match self {
            Self::Tetrahedron | Self::Tetrahedron10 => &[&[0, 2, 1], &[0, 1, 3], &[1, 2, 3], &[0, 3, 2]],
            Self::Wedge => &[&[0, 2, 1], &[3, 4, 5], &[0, 1, 4, 3], &[1, 2, 5, 4], &[2, 0, 3, 5]],
            Self::Hexahedron => &[&[0, 3, 2, 1], &[4, 5, 6, 7], &[0, 1, 5, 4], &[1, 2, 6, 5], &[2, 3, 7, 6], &[3, 0, 4, 7]],
        }
    }

    /// Places of the corners of a reference cell.
    pub(super) const fn reference(self) -> &'static [Point] {
        const WEDGE: [Point; 6] = [[0.0, 0.0, -1.0], [1.0, 0.0, -1.0], [0.0, 1.0, -1.0], [0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]];
        match self {
            Self::Tetrahedron | Self::Tetrahedron10 => &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            Self::Wedge => &WEDGE,
            Self::Hexahedron => &SIGNS,
        }
    }
}

/// Signs of the reference coordinates of a hexahedron's corners and points.
pub(super) const SIGNS: [Point; 8] = [
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
];

/// A cell: its kind and its nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cell {
    kind: Kind,
    nodes: [u32; MOST],
}

impl Cell {
    /// A cell of these nodes; `None` if its kind has another number of them.
    #[must_use]
    pub fn new(kind: Kind, nodes: &[u32]) -> Option<Self> {
        let mut all = [0; MOST];
        all.get_mut(..nodes.len()).filter(|_| nodes.len() == kind.nodes())?.copy_from_slice(nodes);
        Some(Self { kind, nodes: all })
    }

    /// Its kind.
    #[must_use]
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// Its nodes, as many as its kind has.
    #[must_use]
    pub fn nodes(&self) -> &[u32] {
        &self.nodes[..self.kind.nodes()]
    }
}

/// A mesh of cells of any kinds.
#[derive(Clone, Copy, Debug)]
pub struct Mesh<'a> {
    /// Places of all nodes, m.
    pub positions: &'a [Point],
    /// Its cells.
    pub cells: &'a [Cell],
}
