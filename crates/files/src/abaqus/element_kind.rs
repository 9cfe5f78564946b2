//! The element types of a deck: which are bodies with nodes at their corners, what embate makes of them, and
//! why others are refused.
//!
//! Names are those of Abaqus and CalculiX. `deck.rs` looks types up; the import takes stress state and
//! element from here.

use embate_solver::mesh::cell::CellKind;

/// A type that can be computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct ElementKind {
    pub(super) name: &'static str,
    /// Which kind of cell it is.
    pub(super) cell: CellKind,
    /// Stress state of the part, as in the model file; empty: a solid.
    pub(super) state: &'static str,
    /// Element of the part, as in the model file.
    pub(super) element: &'static str,
    /// Edges are called E1 and so on, not S1 or P1: shells and membranes, whose faces are their sides.
    pub(super) shell: bool,
    /// What differs; empty: nothing to speak of.
    pub(super) differs: &'static str,
}

const STRAIN: &str = "plane_strain";
const STRESS: &str = "plane_stress";
const ROUND: &str = "axisymmetric";
const REDUCED: &str = "hourglass control by stiffness after Flanagan and Belytschko, with its own coefficient";
const BENT: &str = "no incompatible modes: an assumed strain keeps bending from locking";
const SHELL: &str = "taken as a membrane in plane stress; bending out of the plane is not computed";

const fn kind(name: &'static str, cell: CellKind, state: &'static str, element: &'static str, differs: &'static str) -> ElementKind {
    ElementKind { name, cell, state, element, shell: matches!(name.as_bytes()[0], b'S' | b'M'), differs }
}

const fn solid(name: &'static str, cell: CellKind, element: &'static str, differs: &'static str) -> ElementKind {
    ElementKind { name, cell, state: "", element, shell: false, differs }
}

impl ElementKind {
    /// Dimension of its bodies.
    pub(super) fn dimension(&self) -> u8 {
        if self.state.is_empty() { 3 } else { 2 }
    }

    /// Number of nodes.
    pub(super) fn nodes(&self) -> usize {
        self.cell.nodes()
    }

    /// How many sides it has: edges in 2D, in 3D faces.
    pub(super) fn sides(&self) -> usize {
        if self.dimension() == 3 { self.cell.facts().faces.len() } else { self.cell.facts().edges.len() }
    }

    /// Corners of a side: from 0, in the order of S1, S2, ...; those of a face run clockwise seen from
    /// outside.
    pub(super) fn side(&self, side: usize) -> impl Iterator<Item = usize> {
        let (facts, is_face) = (self.cell.facts(), self.dimension() == 3);
        let corners = if is_face { &facts.faces[side][..] } else { &facts.edges[side][..] };
        let n = if is_face && corners[2] == corners[3] { 3 } else { corners.len() };
        (0..n).map(move |k| usize::from(corners[if is_face { (n - k) % n } else { k }]))
    }
}

/// One line a type.
pub(super) static KINDS: &[ElementKind] = &[
    kind("CPE3", CellKind::Triangle, STRAIN, "tri3", ""),
    kind("CPE4", CellKind::Quadrilateral, STRAIN, "quad4", ""),
    kind("CPE4R", CellKind::Quadrilateral, STRAIN, "quad4_reduced", REDUCED),
    kind("CPE4I", CellKind::Quadrilateral, STRAIN, "quad4_reduced_assumed_strain", BENT),
    kind("CPS3", CellKind::Triangle, STRESS, "tri3", ""),
    kind("CPS4", CellKind::Quadrilateral, STRESS, "quad4", ""),
    kind("CPS4R", CellKind::Quadrilateral, STRESS, "quad4_reduced", REDUCED),
    kind("CPS4I", CellKind::Quadrilateral, STRESS, "quad4_reduced_assumed_strain", BENT),
    kind("CAX3", CellKind::Triangle, ROUND, "tri3", ""),
    kind("CAX4", CellKind::Quadrilateral, ROUND, "quad4", ""),
    kind("CAX4R", CellKind::Quadrilateral, ROUND, "quad4_reduced", REDUCED),
    kind("CAX4I", CellKind::Quadrilateral, ROUND, "quad4_reduced_assumed_strain", BENT),
    kind("S3", CellKind::Triangle, STRESS, "tri3", SHELL),
    kind("S3R", CellKind::Triangle, STRESS, "tri3", SHELL),
    kind("S4", CellKind::Quadrilateral, STRESS, "quad4", SHELL),
    kind("S4R", CellKind::Quadrilateral, STRESS, "quad4_reduced", SHELL),
    kind("M3D3", CellKind::Triangle, STRESS, "tri3", ""),
    kind("M3D4", CellKind::Quadrilateral, STRESS, "quad4", ""),
    kind("M3D4R", CellKind::Quadrilateral, STRESS, "quad4_reduced", REDUCED),
    solid("C3D4", CellKind::Tetrahedron, "tet4", ""),
    solid("C3D6", CellKind::Wedge, "wedge6", ""),
    solid("C3D8", CellKind::Hexahedron, "hex8", ""),
    solid("C3D8R", CellKind::Hexahedron, "hex8_reduced", REDUCED),
    solid("C3D8I", CellKind::Hexahedron, "hex8_reduced_assumed_strain", BENT),
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

/// What the type of this name (in capitals) is.
pub(super) fn named(name: &str) -> Found {
    if let Some(kind) = KINDS.iter().find(|kind| kind.name == name) {
        return Found::Body(kind);
    }
    const FIRST: &str = "use elements with nodes at their corners only, such as CPE4R, CPS4R, CAX4R, CPE3, C3D8R or C3D4";
    let starts = |all: &[&str]| all.iter().any(|start| name.starts_with(start));
    if starts(&[
        "CPE6", "CPE8", "CPS6", "CPS8", "CAX6", "CAX8", "S6", "S8", "S9", "M3D6", "M3D8", "M3D9", "CGAX6", "CGAX8", "C3D10", "C3D15",
        "C3D20", "C3D27",
    ]) {
        Found::Refused("is of second order: its lumped masses and its contact are not sound in an explicit computation", FIRST)
    } else if starts(&["SC6", "SC8", "CSS", "R3D"]) {
        Found::Refused("is a shell or a surface in 3D, which embate does not compute", "take solids, such as C3D8R")
    } else if starts(&["C3D5"]) {
        Found::Refused("is a pyramid, for which there is no element", "mesh with hexahedra, wedges or tetrahedra")
    } else if starts(&["C3D", "CPE", "CPS", "CAX", "CPEG", "CGAX", "S3", "S4", "STRI", "M3D", "AC", "DC", "CIN"]) {
        Found::Refused("is not one that embate computes (hybrid, coupled, twisting, infinite or thermal)", FIRST)
    } else if starts(&[
        "R2D", "RAX", "B2", "B3", "T2D", "T3D", "SPRING", "DASHPOT", "MASS", "ROTARYI", "CONN", "GAP", "SAX", "MAX", "D", "HEATCAP",
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
    fn elements_of_second_order_and_shells_of_3d_are_refused_with_the_reason() {
        assert!(matches!(named("CPE8R"), Found::Refused(why, _) if why.contains("second order")));
        assert!(matches!(named("C3D10M"), Found::Refused(why, _) if why.contains("second order")));
        assert!(matches!(named("C3D5"), Found::Refused(why, _) if why.contains("pyramid")));
        assert!(matches!(named("R3D4"), Found::Refused(why, _) if why.contains("surface in 3D")));
        assert!(matches!(named("C3D8H"), Found::Refused(why, _) if why.contains("hybrid")));
        assert!(matches!(named("CPE4RH"), Found::Refused(why, _) if why.contains("hybrid")));
        assert!(matches!(named("QQ"), Found::Refused(why, _) if why.contains("not known")));
        assert_eq!(named("SPRINGA"), Found::Beside);
    }

    #[test]
    fn sides_are_numbered_as_in_the_manual() {
        // As the manual of CalculiX numbers the faces of its solid elements (those of Abaqus), with the nodes
        // from 1.
        let of = |name: &str| match named(name) {
            Found::Body(kind) => (0..kind.sides()).map(|side| kind.side(side).map(|k| k + 1).collect()).collect::<Vec<Vec<usize>>>(),
            _ => Vec::new(),
        };
        assert_eq!(of("CPE3"), [[1, 2], [2, 3], [3, 1]]);
        assert_eq!(of("CPS4R"), [[1, 2], [2, 3], [3, 4], [4, 1]]);
        assert_eq!(of("C3D4"), [[1, 2, 3], [1, 4, 2], [2, 4, 3], [3, 4, 1]]);
        let wedge: [&[usize]; 5] = [&[1, 2, 3], &[4, 6, 5], &[1, 4, 5, 2], &[2, 5, 6, 3], &[3, 6, 4, 1]];
        assert_eq!(of("C3D6"), wedge);
        assert_eq!(of("C3D8"), [[1, 2, 3, 4], [5, 8, 7, 6], [1, 5, 6, 2], [2, 6, 7, 3], [3, 7, 8, 4], [4, 8, 5, 1]]);
    }

    #[test]
    fn every_type_is_found_by_its_name() {
        for kind in KINDS {
            assert_eq!(named(kind.name), Found::Body(kind));
        }
    }
}
