//! The element types of a deck: which are bodies with nodes at their corners, what embate makes of them, and
//! why others are refused.
//!
//! Names are those of Abaqus and CalculiX. `deck.rs` looks types up; the import takes stress state and
//! element from here.

use embate_solver::mesh::cell::CellKind;

/// Which bodies a type makes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Family {
    /// An area in the plane, with the stress state of the part as in the model file.
    Plane(&'static str),
    /// A line in the plane that is a shell, with its stress state.
    Line(&'static str),
    /// A shell in 3D.
    Shell,
    /// A shell in 3D without bending.
    Membrane,
    /// A beam in 3D.
    Beam,
    Solid,
}

impl Family {
    /// Whether its bodies are in 3D.
    pub(super) fn is_of_3d(self) -> bool {
        !matches!(self, Self::Plane(_) | Self::Line(_))
    }

    /// Whether its bodies have two faces, [`UPPER`] and [`LOWER`].
    pub(super) fn has_faces(self) -> bool {
        matches!(self, Self::Line(_) | Self::Shell | Self::Membrane)
    }

    /// Whether nodes of its bodies rotate.
    pub(super) fn rotates(self) -> bool {
        matches!(self, Self::Line(_) | Self::Shell | Self::Beam)
    }
}

/// The side of what has faces that its normal looks to (SPOS), and the other one (SNEG); edges follow.
pub(super) const UPPER: u8 = 0;
pub(super) const LOWER: u8 = 1;

/// A type that can be computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct ElementKind {
    pub(super) name: &'static str,
    /// Which kind of cell it is.
    pub(super) cell: CellKind,
    pub(super) family: Family,
    /// Element of the part, as in the model file.
    pub(super) element: &'static str,
    /// What differs; empty: nothing to speak of.
    pub(super) differs: &'static str,
    /// How many nodes it has in the deck: the first are those of the cell.
    pub(super) nodes_in_deck: usize,
}

const STRAIN: Family = Family::Plane("plane_strain");
const STRESS: Family = Family::Plane("plane_stress");
const ROUND: Family = Family::Plane("axisymmetric");
const REDUCED: &str = "hourglass control by stiffness after Flanagan and Belytschko, with its own coefficient";
const BENT: &str = "no incompatible modes: an assumed strain keeps bending from locking";
const ONE_POINT: &str = "one point in the plane, with a physical stabilisation against hourglass modes";
const COMPOSITE: &str = "made of twelve tetrahedra, with mean dilatation and masses that contact can use; sides in it are straight";
const OF_FOUR: &str = "made of four triangles, with mean dilatation and masses that contact can use; sides in it are straight";
const CORNERS: &str = "of first order: the nodes between its corners are left out";
const TRIANGLE: &str = "transverse shear is that of MITC3";

const fn kind(name: &'static str, cell: CellKind, family: Family, element: &'static str, differs: &'static str) -> ElementKind {
    ElementKind { name, cell, family, element, differs, nodes_in_deck: cell.nodes() }
}

/// One of second order that is computed by its corners.
const fn reduced(name: &'static str, cell: CellKind, family: Family, element: &'static str, nodes_in_deck: usize) -> ElementKind {
    ElementKind { name, cell, family, element, differs: CORNERS, nodes_in_deck }
}

impl ElementKind {
    /// Stress state of the part, as in the model file; empty: in 3D.
    pub(super) fn state(&self) -> &'static str {
        match self.family {
            Family::Plane(state) | Family::Line(state) => state,
            _ => "",
        }
    }

    /// Number of nodes.
    pub(super) fn nodes(&self) -> usize {
        self.cell.nodes()
    }

    /// Whether its edges are called E1 and so on, not S1 or P1: those of shells and membranes, whose faces
    /// are their sides.
    pub(super) fn has_named_edges(&self) -> bool {
        matches!(self.name.as_bytes()[0], b'S' | b'M')
    }

    /// How many sides it has: edges of an area in 2D, faces of a solid; of what has faces these, then its
    /// edges; of beams none.
    pub(super) fn sides(&self) -> usize {
        let facts = self.cell.facts();
        match self.family {
            Family::Plane(_) => facts.edges.len(),
            Family::Solid => facts.faces.len(),
            Family::Line(_) => 2,
            Family::Shell | Family::Membrane => 2 + facts.edges.len(),
            Family::Beam => 0,
        }
    }

    /// Corners of a side: from 0, in the order of S1, S2, ...; those of the face of a solid run clockwise
    /// seen from outside, those of the face of a shell counter-clockwise. The upper face of a line has its
    /// nodes in their order.
    pub(super) fn side(&self, side: usize) -> impl Iterator<Item = usize> {
        let facts = self.cell.facts();
        let corners: Vec<usize> = match self.family {
            Family::Solid => {
                let corners = &facts.faces[side];
                let n = if corners[2] == corners[3] { 3 } else { corners.len() };
                (0..n).map(|k| usize::from(corners[(n - k) % n])).collect()
            }
            family if family.has_faces() && side < 2 => {
                let n = self.nodes();
                (0..n).map(|k| if side == usize::from(UPPER) { k } else { n - 1 - k }).collect()
            }
            family => {
                let edge = side - if family.has_faces() { 2 } else { 0 };
                facts.edges[edge].iter().map(|&corner| usize::from(corner)).collect()
            }
        };
        corners.into_iter()
    }
}

/// One line a type; in 2D those of [`FLAT`] come first.
pub(super) static KINDS: &[ElementKind] = &[
    kind("CPE3", CellKind::Triangle, STRAIN, "tri3", ""),
    kind("CPE4", CellKind::Quadrilateral, STRAIN, "quad4", ""),
    kind("CPE4R", CellKind::Quadrilateral, STRAIN, "quad4_reduced", REDUCED),
    kind("CPE4I", CellKind::Quadrilateral, STRAIN, "quad4_reduced_assumed_strain", BENT),
    kind("CPE6", CellKind::Triangle6, STRAIN, "tri6", OF_FOUR),
    kind("CPE6M", CellKind::Triangle6, STRAIN, "tri6", OF_FOUR),
    kind("CPE6H", CellKind::Triangle6, STRAIN, "tri6", OF_FOUR),
    kind("CPE6MH", CellKind::Triangle6, STRAIN, "tri6", OF_FOUR),
    reduced("CPE8", CellKind::Quadrilateral, STRAIN, "quad4", 8),
    reduced("CPE8R", CellKind::Quadrilateral, STRAIN, "quad4", 8),
    kind("CPS3", CellKind::Triangle, STRESS, "tri3", ""),
    kind("CPS4", CellKind::Quadrilateral, STRESS, "quad4", ""),
    kind("CPS4R", CellKind::Quadrilateral, STRESS, "quad4_reduced", REDUCED),
    kind("CPS4I", CellKind::Quadrilateral, STRESS, "quad4_reduced_assumed_strain", BENT),
    kind("CPS6", CellKind::Triangle6, STRESS, "tri6", OF_FOUR),
    kind("CPS6M", CellKind::Triangle6, STRESS, "tri6", OF_FOUR),
    reduced("CPS8", CellKind::Quadrilateral, STRESS, "quad4", 8),
    reduced("CPS8R", CellKind::Quadrilateral, STRESS, "quad4", 8),
    kind("CAX3", CellKind::Triangle, ROUND, "tri3", ""),
    kind("CAX4", CellKind::Quadrilateral, ROUND, "quad4", ""),
    kind("CAX4R", CellKind::Quadrilateral, ROUND, "quad4_reduced", REDUCED),
    kind("CAX4I", CellKind::Quadrilateral, ROUND, "quad4_reduced_assumed_strain", BENT),
    kind("CAX6", CellKind::Triangle6, ROUND, "tri6", OF_FOUR),
    kind("CAX6M", CellKind::Triangle6, ROUND, "tri6", OF_FOUR),
    kind("CAX6H", CellKind::Triangle6, ROUND, "tri6", OF_FOUR),
    kind("CAX6MH", CellKind::Triangle6, ROUND, "tri6", OF_FOUR),
    reduced("CAX8", CellKind::Quadrilateral, ROUND, "quad4", 8),
    reduced("CAX8R", CellKind::Quadrilateral, ROUND, "quad4", 8),
    kind("SAX1", CellKind::Line, Family::Line("axisymmetric"), "shell2", ""),
    kind("B21", CellKind::Line, Family::Line("plane_stress"), "shell2", ""),
    kind("S3", CellKind::Triangle, Family::Shell, "shell3", TRIANGLE),
    kind("S3R", CellKind::Triangle, Family::Shell, "shell3", TRIANGLE),
    kind("S4", CellKind::Quadrilateral, Family::Shell, "shell4", ONE_POINT),
    kind("S4R", CellKind::Quadrilateral, Family::Shell, "shell4", ONE_POINT),
    kind("M3D3", CellKind::Triangle, Family::Membrane, "shell3", ""),
    kind("M3D4", CellKind::Quadrilateral, Family::Membrane, "shell4", ONE_POINT),
    kind("M3D4R", CellKind::Quadrilateral, Family::Membrane, "shell4", ONE_POINT),
    kind("B31", CellKind::Line, Family::Beam, "beam2", ""),
    kind("PIPE31", CellKind::Line, Family::Beam, "beam2", ""),
    kind("C3D4", CellKind::Tetrahedron, Family::Solid, "tet4", ""),
    kind("C3D10", CellKind::Tetrahedron10, Family::Solid, "tet10", COMPOSITE),
    kind("C3D10M", CellKind::Tetrahedron10, Family::Solid, "tet10", COMPOSITE),
    kind("C3D10I", CellKind::Tetrahedron10, Family::Solid, "tet10", COMPOSITE),
    kind("C3D10H", CellKind::Tetrahedron10, Family::Solid, "tet10", COMPOSITE),
    kind("C3D10MH", CellKind::Tetrahedron10, Family::Solid, "tet10", COMPOSITE),
    reduced("C3D15", CellKind::Wedge, Family::Solid, "wedge6", 15),
    reduced("C3D20", CellKind::Hexahedron, Family::Solid, "hex8", 20),
    reduced("C3D20R", CellKind::Hexahedron, Family::Solid, "hex8", 20),
    kind("C3D6", CellKind::Wedge, Family::Solid, "wedge6", ""),
    kind("C3D8", CellKind::Hexahedron, Family::Solid, "hex8", ""),
    kind("C3D8R", CellKind::Hexahedron, Family::Solid, "hex8_reduced", REDUCED),
    kind("C3D8I", CellKind::Hexahedron, Family::Solid, "hex8_reduced_assumed_strain", BENT),
];

/// What shells and membranes are in 2D.
static FLAT: &[ElementKind] = &[
    kind("S3", CellKind::Triangle, STRESS, "tri3", ""),
    kind("S3R", CellKind::Triangle, STRESS, "tri3", ""),
    kind("S4", CellKind::Quadrilateral, STRESS, "quad4", ""),
    kind("S4R", CellKind::Quadrilateral, STRESS, "quad4_reduced", REDUCED),
    kind("M3D3", CellKind::Triangle, STRESS, "tri3", ""),
    kind("M3D4", CellKind::Quadrilateral, STRESS, "quad4", ""),
    kind("M3D4R", CellKind::Quadrilateral, STRESS, "quad4_reduced", REDUCED),
];

/// What a type is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Found {
    /// It can be computed.
    Body(&'static ElementKind),
    /// A point, line, spring, mass or the like: no body, skipped.
    Beside,
    /// It can't be computed; why, and what to do.
    Refused(&'static str, &'static str),
}

/// What the type of this name (in capitals) is in a deck in 2D or 3D.
pub(super) fn named(name: &str, is_3d: bool) -> Found {
    if let Some(kind) = FLAT.iter().filter(|_| !is_3d).chain(KINDS).find(|kind| kind.name == name) {
        return match kind.family.is_of_3d() {
            of_3d if of_3d == is_3d => Found::Body(kind),
            true => Found::Beside,
            false => Found::Refused(
                "is one of 2D, beside bodies in 3D",
                "bodies are all in 2D or all in 3D: take S4R for sheets, C3D8R for solids, B31 for beams",
            ),
        };
    }
    const FIRST: &str =
        "use elements with nodes at their corners only, such as CPE4R, CPS4R, CAX4R, CPE3, C3D8R or C3D4; of second order CPE6M or C3D10M";
    let starts = |all: &[&str]| all.iter().any(|start| name.starts_with(start));
    if starts(&["S6", "S8", "S9", "M3D6", "M3D8", "M3D9", "CGAX6", "CGAX8", "C3D15", "C3D20", "C3D27"]) {
        Found::Refused("is of second order: its lumped masses and its contact are not sound in an explicit computation", FIRST)
    } else if starts(&["SC6", "SC8", "CSS", "R3D"]) {
        Found::Refused(
            "is a continuum shell or a rigid surface, which embate does not compute",
            "take S4R or C3D8R, with *RIGID BODY where it is rigid",
        )
    } else if starts(&["C3D5"]) {
        Found::Refused("is a pyramid, for which there is no element", "mesh with hexahedra, wedges or tetrahedra")
    } else if starts(&["C3D", "CPE", "CPS", "CAX", "CPEG", "CGAX", "S3", "S4", "STRI", "M3D", "AC", "DC", "CIN"]) {
        Found::Refused("is not one that embate computes (hybrid, coupled, twisting, infinite or thermal)", FIRST)
    } else if starts(&[
        "R2D", "RAX", "B2", "B3", "PIPE", "ELBOW", "T2D", "T3D", "SPRING", "DASHPOT", "MASS", "ROTARYI", "CONN", "GAP", "SAX", "MAX", "D",
        "HEATCAP",
    ]) {
        Found::Beside
    } else {
        Found::Refused("is not known", FIRST)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_of_second_order_and_others_are_refused_with_the_reason() {
        let named = |name: &str| super::named(name, true);
        assert!(matches!(named("S8R"), Found::Refused(why, _) if why.contains("second order")));
        assert!(matches!(named("CPE6M"), Found::Refused(why, _) if why.contains("beside bodies in 3D")));
        assert!(matches!(named("CPE8H"), Found::Refused(why, _) if why.contains("hybrid")));
        assert!(matches!(named("C3D27"), Found::Refused(why, _) if why.contains("second order")));
        assert!(matches!(named("C3D5"), Found::Refused(why, _) if why.contains("pyramid")));
        assert!(matches!(named("R3D4"), Found::Refused(why, _) if why.contains("rigid surface")));
        assert!(matches!(named("C3D8H"), Found::Refused(why, _) if why.contains("hybrid")));
        assert!(matches!(named("CPE4RH"), Found::Refused(why, _) if why.contains("hybrid")));
        assert!(matches!(named("QQ"), Found::Refused(why, _) if why.contains("not known")));
        assert!(matches!(named("CPE4R"), Found::Refused(why, _) if why.contains("beside bodies in 3D")));
        assert_eq!((named("SPRINGA"), super::named("B31", false)), (Found::Beside, Found::Beside));
    }

    #[test]
    fn sides_are_numbered_as_in_the_manual() {
        // As the manual of CalculiX numbers the faces of its solid elements (those of Abaqus), with the nodes
        // from 1.
        let of = |name: &str| match [false, true].map(|is_3d| named(name, is_3d)).into_iter().find(|it| matches!(it, Found::Body(_))) {
            Some(Found::Body(kind)) => (0..kind.sides()).map(|side| kind.side(side).map(|k| k + 1).collect()).collect::<Vec<Vec<usize>>>(),
            _ => Vec::new(),
        };
        assert_eq!(of("CPE3"), [[1, 2], [2, 3], [3, 1]]);
        assert_eq!((of("CPE6M"), of("CPE8R")), (of("CPE3"), of("CPE4R")), "the mesh knows the nodes between corners");
        assert_eq!(of("CPS4R"), [[1, 2], [2, 3], [3, 4], [4, 1]]);
        // Faces of shells, then their edges, where they are no areas of 2D.
        assert_eq!(of("SAX1"), [[1, 2], [2, 1]]);
        assert_eq!(of("S4R"), [[1, 2], [2, 3], [3, 4], [4, 1]]);
        let Found::Body(shell) = named("S3", true) else { panic!("no shell") };
        let sides: Vec<Vec<usize>> = (0..shell.sides()).map(|side| shell.side(side).collect()).collect();
        let expected: [&[usize]; 5] = [&[0, 1, 2], &[2, 1, 0], &[0, 1], &[1, 2], &[2, 0]];
        assert_eq!(sides, expected);
        assert_eq!(of("C3D4"), [[1, 2, 3], [1, 4, 2], [2, 4, 3], [3, 4, 1]]);
        assert_eq!(of("C3D10M"), of("C3D4"), "the mesh knows the nodes between corners");
        let wedge: [&[usize]; 5] = [&[1, 2, 3], &[4, 6, 5], &[1, 4, 5, 2], &[2, 5, 6, 3], &[3, 6, 4, 1]];
        assert_eq!(of("C3D6"), wedge);
        assert_eq!(of("C3D8"), [[1, 2, 3, 4], [5, 8, 7, 6], [1, 5, 6, 2], [2, 6, 7, 3], [3, 7, 8, 4], [4, 8, 5, 1]]);
    }

    #[test]
    fn every_type_is_found_by_its_name() {
        for kind in KINDS {
            assert_eq!(named(kind.name, kind.family.is_of_3d()), Found::Body(kind));
        }
    }
}
