//! Kinds of cells: the topology of every element, as facts. Nothing else in the program knows a cell by its
//! number of nodes.
//!
//! Element kinds name the kind of their cell, groups of elements and results carry it, and surfaces, file
//! formats and pictures read its facts. To add a kind: its variant, its line in [`CellKind::ALL`] and its
//! [`Facts`]; the tests below check them. The facts leave room for cells whose nodes are not all corners
//! (ten-node tetrahedron: corners come first, then the middles of its edges in their order), whose corners do
//! not all have three edges (pyramid), and whose dimension is below that of the model (four-node shell beside
//! a four-node tetrahedron).
//!
//! ```text
//!   3-----2      2          3              3-----5            7-----6
//!   |     |      |\        /|\             |\   /|           /|    /|
//!   |     |      | \      / | \            | \ / |          4-----5 |
//!   |     |      |  \    0--|--2           |  4  |          | 3---|-2
//!   0-----1      0---1    \ | /            0--|--2          |/    |/
//!                          \|/              \ | /           0-----1
//!   0-----1                 1                \|/
//!                                             1
//! ```

/// Which kind of cell an element is. Kinds are in the order of their dimensions, then of their numbers of
/// nodes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum CellKind {
    /// A single node; no element, but a cell of mesh files.
    #[default]
    Point,
    /// Two nodes: a bar, or a piece of the outside in 2D.
    Line,
    /// Three nodes, counter-clockwise.
    Triangle,
    /// Four nodes, counter-clockwise.
    Quadrilateral,
    /// Six nodes: a triangle, and the middles of its edges.
    Triangle6,
    /// Four nodes; seen from the fourth, the first three run counter-clockwise.
    Tetrahedron,
    /// Six nodes: two triangles; seen from the second, the first runs counter-clockwise.
    Wedge,
    /// Eight nodes: two quadrilaterals; seen from the second, the first runs counter-clockwise.
    Hexahedron,
    /// Ten nodes: a tetrahedron, and the middles of its edges.
    Tetrahedron10,
}

/// The facts of a kind of cell. Corners are numbered from 0; nodes that are no corners come after them.
#[derive(Clone, Copy, Debug)]
pub struct Facts {
    /// Name in Python, that of meshio.
    pub name: &'static str,
    /// What several are called in messages.
    pub plural: &'static str,
    /// 0 point, 1 line, 2 surface, 3 volume.
    pub dimension: usize,
    /// Number of nodes.
    pub nodes: usize,
    /// Number of nodes that are corners: these come first; of a surface they run around it.
    pub corners: usize,
    /// Corners of each edge. Of a surface they run around it, and are its sides in the order of Abaqus (S1,
    /// S2, ...).
    pub edges: &'static [[u8; 2]],
    /// Corners of each face; a triangle repeats its last one. Of a volume they are its sides in the order of
    /// Abaqus, counter-clockwise seen from outside; a surface is its own face.
    pub faces: &'static [[u8; 4]],
    /// Nodes of what the faces are made of: of each face as many facets, those of the first come first. The
    /// faces themselves where all nodes are corners; else the triangles between neighbouring nodes.
    pub facets: &'static [[u8; 4]],
    /// Of each corner the other ends of its edges: of a surface the next corner, then the previous one; of a
    /// volume counter-clockwise seen from inside, so that any three that follow each other are right-handed.
    pub neighbours: &'static [&'static [u8]],
    /// Numberings of the nodes that are the same cell, one after the other, the identity first: those that
    /// keep its edges, faces and orientation (of a line its ends, of which there is no orientation).
    pub symmetries: &'static [u8],
    /// Numbering that turns the cell over, as after a reflection; the first node stays the first.
    pub reflection: &'static [u8],
    /// As many directions as the dimension, each from the middle of some corners to the middle of others:
    /// vectors that the cell carries with it.
    pub axes: &'static [[&'static [u8]; 2]],
    /// Places of the nodes of a reference cell, whose edges at the first corner are the unit vectors.
    pub reference: &'static [[f64; 3]],
    /// Length, area or volume of the reference cell.
    pub size: f64,
    /// What becomes of it when it is extruded, node by node: first those of one end, then those of the other.
    pub extruded: Option<CellKind>,
    /// Corners, and no other nodes, of the cells of this kind into which the [`CellKind::Quadrilateral`] or
    /// [`CellKind::Hexahedron`] of its dimension can be divided.
    pub division: &'static [u8],
    /// Number in VTK's files.
    pub vtk: u8,
    /// Number in Gmsh's files.
    pub gmsh: i64,
}

/// Most nodes that a cell has.
pub const MOST_NODES: usize = {
    let (mut most, mut at) = (0, 0);
    while at < CellKind::ALL.len() {
        let nodes = CellKind::ALL[at].facts().nodes;
        (most, at) = (if nodes > most { nodes } else { most }, at + 1);
    }
    most
};

impl CellKind {
    /// Every kind.
    pub const ALL: [Self; 9] = [
        Self::Point,
        Self::Line,
        Self::Triangle,
        Self::Quadrilateral,
        Self::Triangle6,
        Self::Tetrahedron,
        Self::Wedge,
        Self::Hexahedron,
        Self::Tetrahedron10,
    ];

    /// Its facts.
    #[must_use]
    pub const fn facts(self) -> &'static Facts {
        match self {
            Self::Point => &POINT,
            Self::Line => &LINE,
            Self::Triangle => &TRIANGLE,
            Self::Quadrilateral => &QUADRILATERAL,
            Self::Triangle6 => &TRIANGLE6,
            Self::Tetrahedron => &TETRAHEDRON,
            Self::Wedge => &WEDGE,
            Self::Hexahedron => &HEXAHEDRON,
            Self::Tetrahedron10 => &TETRAHEDRON10,
        }
    }

    /// The kind that a mesh file means by a cell of a dimension with so many nodes.
    #[must_use]
    pub fn of(dimension: usize, nodes: usize) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.dimension() == dimension && kind.nodes() == nodes)
    }

    /// The kind with a number of VTK.
    #[must_use]
    pub fn of_vtk(number: u8) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.facts().vtk == number)
    }

    /// The kind with a number of Gmsh.
    #[must_use]
    pub fn of_gmsh(number: i64) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.facts().gmsh == number)
    }

    /// 0 point, 1 line, 2 surface, 3 volume.
    #[must_use]
    pub const fn dimension(self) -> usize {
        self.facts().dimension
    }

    /// Number of nodes.
    #[must_use]
    pub const fn nodes(self) -> usize {
        self.facts().nodes
    }

    /// Number of corners.
    #[must_use]
    pub const fn corners(self) -> usize {
        self.facts().corners
    }

    /// Places of the nodes of a surface in their order around it.
    pub fn around(self) -> impl Iterator<Item = usize> + Clone {
        let (corners, steps) = (self.corners(), if self.has_middles() { 2 } else { 1 });
        (0..self.nodes()).map(move |k| k / steps + if k % steps == 1 { corners } else { 0 })
    }

    /// Whether it has nodes in the middles of its edges.
    #[must_use]
    pub const fn has_middles(self) -> bool {
        self.nodes() > self.corners()
    }

    /// Numberings of the nodes that are the same cell; see [`Facts::symmetries`].
    pub fn symmetries(self) -> impl Iterator<Item = &'static [u8]> {
        self.facts().symmetries.chunks_exact(self.nodes())
    }

    /// The cells of this kind that have these nodes, one after the other.
    pub fn cells(self, nodes: &[u32]) -> impl Iterator<Item = Cell<'_>> + Clone {
        nodes.chunks_exact(self.nodes()).map(move |nodes| Cell { kind: self, nodes })
    }

    /// A cell of this kind.
    #[must_use]
    pub fn cell(self, nodes: &[u32]) -> Cell<'_> {
        Cell { kind: self, nodes }
    }

    /// Turns a cell over: what its nodes are called after they were reflected.
    pub fn reflect(self, nodes: &mut [u32]) {
        self.renumber(nodes, self.facts().reflection);
    }

    /// What a cell of a mid surface is with its thickness: of lines quadrilaterals, of surfaces solids.
    #[must_use]
    pub const fn thickened(self) -> Self {
        match (self, self.facts().extruded) {
            (Self::Line, _) => Self::Quadrilateral,
            (_, Some(kind)) => kind,
            (kind, None) => kind,
        }
    }

    /// Renumbers the nodes of a cell such that it is the same cell: of all its symmetries that with the
    /// lowest numbers first.
    pub fn begin_with_lowest(self, nodes: &mut [u32]) {
        let numbers = |way: &&'static [u8]| way.iter().map(|&k| nodes[usize::from(k)]);
        if let Some(way) = self.symmetries().min_by(|a, b| numbers(a).cmp(numbers(b))) {
            self.renumber(nodes, way);
        }
    }

    fn renumber(self, nodes: &mut [u32], way: &[u8]) {
        let mut old = [0; MOST_NODES];
        let old = &mut old[..self.nodes()];
        old.copy_from_slice(nodes);
        nodes.iter_mut().zip(way).for_each(|(node, &k)| *node = old[usize::from(k)]);
    }
}

/// One cell: of which kind it is, and its nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cell<'a> {
    /// Its kind.
    pub kind: CellKind,
    /// Its nodes, as many as its kind has.
    pub nodes: &'a [u32],
}

impl<'a> Cell<'a> {
    /// What a mesh file means by a cell of a dimension with these nodes; `None` where no kind has so many.
    #[must_use]
    pub fn of(dimension: usize, nodes: &'a [u32]) -> Option<Self> {
        Some(CellKind::of(dimension, nodes.len())?.cell(nodes))
    }

    /// The nodes that are corners.
    #[must_use]
    pub fn corners(self) -> &'a [u32] {
        &self.nodes[..self.kind.corners()]
    }

    /// The cell of first order with its corners: of a ten-node tetrahedron that of four, of a six-node
    /// triangle that of three, of others themselves.
    #[must_use]
    pub fn of_corners(self) -> Self {
        match self.kind {
            CellKind::Tetrahedron10 => CellKind::Tetrahedron.cell(self.corners()),
            CellKind::Triangle6 => CellKind::Triangle.cell(self.corners()),
            _ => self,
        }
    }

    /// Nodes of a surface in their order around it, those in the middles of edges too.
    pub fn around(self) -> impl Iterator<Item = u32> + Clone {
        self.kind.around().map(move |k| self.nodes[k])
    }

    /// Nodes of each edge.
    pub fn edges(self) -> impl Iterator<Item = [u32; 2]> + Clone {
        self.kind.facts().edges.iter().map(move |edge| edge.map(|k| self.nodes[usize::from(k)]))
    }

    /// Nodes of each piece of an edge: of the whole where it has no node in its middle.
    pub fn pieces_of_edges(self) -> impl Iterator<Item = [u32; 2]> + Clone {
        let middles = self.nodes[self.kind.corners()..].iter().copied().map(Some).chain(std::iter::repeat(None));
        self.edges()
            .zip(middles)
            .flat_map(|([a, b], middle)| match middle {
                Some(middle) => [Some([a, middle]), Some([middle, b])],
                None => [Some([a, b]), None],
            })
            .flatten()
    }

    /// The corner of a simplex beyond the face that a facet is a piece of; `None`: it has no such facet.
    #[must_use]
    pub fn beyond(self, facet: &[u32]) -> Option<u32> {
        let facts = self.kind.facts();
        let has_all = |own: &[u8; 4]| facet.iter().all(|node| own.iter().any(|&k| self.nodes[usize::from(k)] == *node));
        let place = facts.facets.iter().position(has_all)?;
        let face = &facts.faces[place * facts.faces.len() / facts.facets.len()];
        (0..facts.corners as u8).find(|corner| !face.contains(corner)).map(|corner| self.nodes[usize::from(corner)])
    }

    /// Nodes of each facet; a triangle repeats its last one.
    pub fn facets(self) -> impl Iterator<Item = [u32; 4]> + Clone {
        self.kind.facts().facets.iter().map(move |facet| facet.map(|k| self.nodes[usize::from(k)]))
    }

    /// Whether a node occurs twice.
    #[must_use]
    pub fn is_collapsed(self) -> bool {
        (0..self.nodes.len()).any(|k| self.nodes[..k].contains(&self.nodes[k]))
    }
}

const POINT: Facts = Facts {
    name: "vertex",
    plural: "points",
    dimension: 0,
    nodes: 1,
    corners: 1,
    edges: &[],
    faces: &[],
    facets: &[],
    neighbours: &[&[]],
    symmetries: &[0],
    reflection: &[0],
    axes: &[],
    reference: &[[0.0; 3]],
    size: 1.0,
    extruded: Some(CellKind::Line),
    division: &[],
    vtk: 1,
    gmsh: 15,
};

const LINE: Facts = Facts {
    name: "line",
    plural: "lines",
    dimension: 1,
    nodes: 2,
    corners: 2,
    edges: &[[0, 1]],
    faces: &[],
    facets: &[],
    neighbours: &[&[1], &[0]],
    symmetries: &[0, 1, 1, 0],
    reflection: &[0, 1],
    axes: &[[&[0], &[1]]],
    reference: &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]],
    size: 1.0,
    extruded: None,
    division: &[],
    vtk: 3,
    gmsh: 1,
};

const TRIANGLE: Facts = Facts {
    name: "triangle",
    plural: "triangles",
    dimension: 2,
    nodes: 3,
    corners: 3,
    edges: &[[0, 1], [1, 2], [2, 0]],
    faces: &[[0, 1, 2, 2]],
    facets: &[[0, 1, 2, 2]],
    neighbours: &[&[1, 2], &[2, 0], &[0, 1]],
    symmetries: [[0, 1, 2], [1, 2, 0], [2, 0, 1]].as_flattened(),
    reflection: &[0, 2, 1],
    axes: &[[&[0], &[1]], [&[0], &[2]]],
    reference: &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
    size: 0.5,
    extruded: Some(CellKind::Wedge),
    division: &[0, 1, 2, 0, 2, 3],
    vtk: 5,
    gmsh: 2,
};

/// The triangle with the middles of its edges, in the order of Abaqus, Gmsh and VTK.
const TRIANGLE6: Facts = Facts {
    name: "triangle6",
    plural: "six-node triangles",
    nodes: 6,
    facets: &[[0, 3, 5, 5], [3, 1, 4, 4], [5, 4, 2, 2], [3, 4, 5, 5]],
    symmetries: [[0, 1, 2, 3, 4, 5], [1, 2, 0, 4, 5, 3], [2, 0, 1, 5, 3, 4]].as_flattened(),
    reflection: &[0, 2, 1, 5, 4, 3],
    reference: &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.5, 0.0, 0.0], [0.5, 0.5, 0.0], [0.0, 0.5, 0.0]],
    extruded: None,
    vtk: 22,
    gmsh: 9,
    ..TRIANGLE
};

const QUADRILATERAL: Facts = Facts {
    name: "quad",
    plural: "quadrilaterals",
    dimension: 2,
    nodes: 4,
    corners: 4,
    edges: &[[0, 1], [1, 2], [2, 3], [3, 0]],
    faces: &[[0, 1, 2, 3]],
    facets: &[[0, 1, 2, 3]],
    neighbours: &[&[1, 3], &[2, 0], &[3, 1], &[0, 2]],
    symmetries: [[0, 1, 2, 3], [1, 2, 3, 0], [2, 3, 0, 1], [3, 0, 1, 2]].as_flattened(),
    reflection: &[0, 3, 2, 1],
    axes: &[[&[0, 3], &[1, 2]], [&[0, 1], &[2, 3]]],
    reference: &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
    size: 1.0,
    extruded: Some(CellKind::Hexahedron),
    division: &[0, 1, 2, 3],
    vtk: 9,
    gmsh: 3,
};

const TETRAHEDRON: Facts = Facts {
    name: "tetra",
    plural: "tetrahedra",
    dimension: 3,
    nodes: 4,
    corners: 4,
    edges: &[[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]],
    faces: &[[0, 2, 1, 1], [0, 1, 3, 3], [1, 2, 3, 3], [2, 0, 3, 3]],
    facets: &[[0, 2, 1, 1], [0, 1, 3, 3], [1, 2, 3, 3], [2, 0, 3, 3]],
    neighbours: &[&[1, 2, 3], &[2, 0, 3], &[0, 1, 3], &[0, 2, 1]],
    symmetries: [
        [0, 1, 2, 3],
        [0, 2, 3, 1],
        [0, 3, 1, 2],
        [1, 0, 3, 2],
        [1, 3, 2, 0],
        [1, 2, 0, 3],
        [2, 0, 1, 3],
        [2, 1, 3, 0],
        [2, 3, 0, 1],
        [3, 0, 2, 1],
        [3, 2, 1, 0],
        [3, 1, 0, 2],
    ]
    .as_flattened(),
    reflection: &[0, 2, 1, 3],
    axes: &[[&[0], &[1]], [&[0], &[2]], [&[0], &[3]]],
    reference: &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    size: 1.0 / 6.0,
    extruded: None,
    // Around the diagonal from corner 0 to corner 6.
    division: &[0, 1, 2, 6, 0, 2, 3, 6, 0, 3, 7, 6, 0, 7, 4, 6, 0, 4, 5, 6, 0, 5, 1, 6],
    vtk: 10,
    gmsh: 4,
};

/// The tetrahedron with the middles of its edges, in the order of Abaqus and VTK.
const TETRAHEDRON10: Facts = Facts {
    name: "tetra10",
    plural: "ten-node tetrahedra",
    nodes: 10,
    facets: TETRAHEDRON10_FACETS.as_flattened(),
    symmetries: TETRAHEDRON10_SYMMETRIES.as_flattened(),
    reflection: &with_middles([0, 2, 1, 3]),
    reference: &[
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.5, 0.0, 0.0],
        [0.5, 0.5, 0.0],
        [0.0, 0.5, 0.0],
        [0.0, 0.0, 0.5],
        [0.5, 0.0, 0.5],
        [0.0, 0.5, 0.5],
    ],
    vtk: 24,
    gmsh: 11,
    ..TETRAHEDRON
};

/// The node in the middle of the edge between two corners of a tetrahedron.
const fn middle(a: u8, b: u8) -> u8 {
    let mut edge = 0;
    loop {
        let [from, to] = TETRAHEDRON.edges[edge];
        if (from == a && to == b) || (from == b && to == a) {
            return 4 + edge as u8;
        }
        edge += 1;
    }
}

/// A numbering of the corners of a tetrahedron with that of the middles of its edges.
const fn with_middles(corners: [u8; 4]) -> [u8; 10] {
    let mut way = [0; 10];
    let mut k = 0;
    while k < 10 {
        way[k] = if k < 4 {
            corners[k]
        } else {
            let [a, b] = TETRAHEDRON.edges[k - 4];
            middle(corners[a as usize], corners[b as usize])
        };
        k += 1;
    }
    way
}

/// Four triangles on each face: at its corners, and between its middles.
const TETRAHEDRON10_FACETS: [[[u8; 4]; 4]; 4] = {
    let mut all = [[[0; 4]; 4]; 4];
    let mut face = 0;
    while face < 4 {
        let [a, b, c, _] = TETRAHEDRON.faces[face];
        let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
        all[face] = [[a, ab, ca, ca], [ab, b, bc, bc], [ca, bc, c, c], [ab, bc, ca, ca]];
        face += 1;
    }
    all
};

const TETRAHEDRON10_SYMMETRIES: [[u8; 10]; 12] = {
    let mut all = [[0; 10]; 12];
    let mut way = 0;
    while way < 12 {
        let own = TETRAHEDRON.symmetries;
        all[way] = with_middles([own[4 * way], own[4 * way + 1], own[4 * way + 2], own[4 * way + 3]]);
        way += 1;
    }
    all
};

const WEDGE: Facts = Facts {
    name: "wedge",
    plural: "wedges",
    dimension: 3,
    nodes: 6,
    corners: 6,
    edges: &[[0, 1], [1, 2], [2, 0], [3, 4], [4, 5], [5, 3], [0, 3], [1, 4], [2, 5]],
    faces: &[[0, 2, 1, 1], [3, 4, 5, 5], [0, 1, 4, 3], [1, 2, 5, 4], [2, 0, 3, 5]],
    facets: &[[0, 2, 1, 1], [3, 4, 5, 5], [0, 1, 4, 3], [1, 2, 5, 4], [2, 0, 3, 5]],
    neighbours: &[&[1, 2, 3], &[2, 0, 4], &[0, 1, 5], &[5, 4, 0], &[3, 5, 1], &[4, 3, 2]],
    symmetries: [[0, 1, 2, 3, 4, 5], [1, 2, 0, 4, 5, 3], [2, 0, 1, 5, 3, 4], [3, 5, 4, 0, 2, 1], [5, 4, 3, 2, 1, 0], [4, 3, 5, 1, 0, 2]]
        .as_flattened(),
    reflection: &[0, 2, 1, 3, 5, 4],
    axes: &[[&[0, 3], &[1, 4]], [&[0, 3], &[2, 5]], [&[0, 1, 2], &[3, 4, 5]]],
    reference: &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]],
    size: 0.5,
    extruded: None,
    division: &[0, 1, 2, 4, 5, 6, 0, 2, 3, 4, 6, 7],
    vtk: 13,
    gmsh: 6,
};

const HEXAHEDRON: Facts = Facts {
    name: "hexahedron",
    plural: "hexahedra",
    dimension: 3,
    nodes: 8,
    corners: 8,
    edges: &[[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]],
    faces: &[[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]],
    facets: &[[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]],
    neighbours: &[&[1, 3, 4], &[2, 0, 5], &[3, 1, 6], &[0, 2, 7], &[7, 5, 0], &[4, 6, 1], &[5, 7, 2], &[6, 4, 3]],
    symmetries: HEXAHEDRON_SYMMETRIES.as_flattened(),
    reflection: &[0, 3, 2, 1, 4, 7, 6, 5],
    axes: &[[&[0, 3, 4, 7], &[1, 2, 5, 6]], [&[0, 1, 4, 5], &[2, 3, 6, 7]], [&[0, 1, 2, 3], &[4, 5, 6, 7]]],
    reference: &[
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [1.0, 0.0, 1.0],
        [1.0, 1.0, 1.0],
        [0.0, 1.0, 1.0],
    ],
    size: 1.0,
    extruded: None,
    division: &[0, 1, 2, 3, 4, 5, 6, 7],
    vtk: 12,
    gmsh: 5,
};

/// Each of the six faces as the lower one (seen from inside), each of its four corners first.
const HEXAHEDRON_SYMMETRIES: [[u8; 8]; 24] = {
    // Lower faces, counter-clockwise seen from inside, with the corners above them.
    const LOWER: [[u8; 8]; 6] = [
        [0, 1, 2, 3, 4, 5, 6, 7],
        [4, 7, 6, 5, 0, 3, 2, 1],
        [0, 4, 5, 1, 3, 7, 6, 2],
        [1, 5, 6, 2, 0, 4, 7, 3],
        [2, 6, 7, 3, 1, 5, 4, 0],
        [3, 7, 4, 0, 2, 6, 5, 1],
    ];
    let mut all = [[0; 8]; 24];
    let mut way = 0;
    while way < 24 {
        let mut k = 0;
        while k < 4 {
            all[way][k] = LOWER[way / 4][(way + k) % 4];
            all[way][k + 4] = LOWER[way / 4][4 + (way + k) % 4];
            k += 1;
        }
        way += 1;
    }
    all
};

#[cfg(test)]
mod tests;
