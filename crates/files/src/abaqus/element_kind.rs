//! The element types of a deck: which are bodies with nodes at their corners, what embate makes of them, and why others are refused.
//!
//! Names are those of Abaqus and CalculiX. `deck.rs` looks types up; the import takes stress state and element from here.

/// A type that can be computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct ElementKind {
    pub(super) name: &'static str,
    /// Number of nodes.
    pub(super) nodes: usize,
    /// The nodes of each side, from S1 on: edges in the plane, in space faces.
    pub(super) sides: &'static [&'static [usize]],
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

const fn kind(name: &'static str, nodes: usize, state: &'static str, element: &'static str, differs: &'static str) -> ElementKind {
    let sides = if nodes == 3 { TRIANGLE } else { QUADRILATERAL };
    ElementKind { name, nodes, sides, state, element, shell: matches!(name.as_bytes()[0], b'S' | b'M'), differs }
}

const fn solid(name: &'static str, sides: &'static [&'static [usize]], element: &'static str, differs: &'static str) -> ElementKind {
    let nodes = match sides.len() {
        4 => 4,
        5 => 6,
        _ => 8,
    };
    ElementKind { name, nodes, sides, state: "", element, shell: false, differs }
}

impl ElementKind {
    /// Dimension of its bodies.
    pub(super) fn dimension(&self) -> u8 {
        if self.state.is_empty() { 3 } else { 2 }
    }
}

const TRIANGLE: &[&[usize]] = &[&[0, 1], &[1, 2], &[2, 0]];
const QUADRILATERAL: &[&[usize]] = &[&[0, 1], &[1, 2], &[2, 3], &[3, 0]];
const TETRAHEDRON: &[&[usize]] = &[&[0, 1, 2], &[0, 3, 1], &[1, 3, 2], &[2, 3, 0]];
const WEDGE: &[&[usize]] = &[&[0, 1, 2], &[3, 5, 4], &[0, 3, 4, 1], &[1, 4, 5, 2], &[2, 5, 3, 0]];
const HEXAHEDRON: &[&[usize]] = &[&[0, 1, 2, 3], &[4, 7, 6, 5], &[0, 4, 5, 1], &[1, 5, 6, 2], &[2, 6, 7, 3], &[3, 7, 4, 0]];

/// One line a type.
pub(super) static KINDS: &[ElementKind] = &[
    kind("CPE3", 3, STRAIN, "tri3", ""),
    kind("CPE4", 4, STRAIN, "quad4", ""),
    kind("CPE4R", 4, STRAIN, "quad4_reduced", REDUCED),
    kind("CPE4I", 4, STRAIN, "quad4_reduced_assumed_strain", BENT),
    kind("CPS3", 3, STRESS, "tri3", ""),
    kind("CPS4", 4, STRESS, "quad4", ""),
    kind("CPS4R", 4, STRESS, "quad4_reduced", REDUCED),
    kind("CPS4I", 4, STRESS, "quad4_reduced_assumed_strain", BENT),
    kind("CAX3", 3, ROUND, "tri3", ""),
    kind("CAX4", 4, ROUND, "quad4", ""),
    kind("CAX4R", 4, ROUND, "quad4_reduced", REDUCED),
    kind("CAX4I", 4, ROUND, "quad4_reduced_assumed_strain", BENT),
    kind("S3", 3, STRESS, "tri3", SHELL),
    kind("S3R", 3, STRESS, "tri3", SHELL),
    kind("S4", 4, STRESS, "quad4", SHELL),
    kind("S4R", 4, STRESS, "quad4_reduced", SHELL),
    kind("M3D3", 3, STRESS, "tri3", ""),
    kind("M3D4", 4, STRESS, "quad4", ""),
    kind("M3D4R", 4, STRESS, "quad4_reduced", REDUCED),
    solid("C3D4", TETRAHEDRON, "tet4", ""),
    solid("C3D6", WEDGE, "wedge6", ""),
    solid("C3D8", HEXAHEDRON, "hex8", ""),
    solid("C3D8R", HEXAHEDRON, "hex8_reduced", REDUCED),
    solid("C3D8I", HEXAHEDRON, "hex8_reduced_assumed_strain", BENT),
];

/// What a type is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Found {
    /// It can be computed.
    Body(&'static ElementKind),
    /// A point, line, spring, mass or the like: no body, stepped over.
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
        Found::Refused("is a shell or a surface in space, which embate does not compute", "take solids, such as C3D8R")
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
    fn elements_of_second_order_and_shells_of_space_are_refused_with_the_reason() {
        assert!(matches!(named("CPE8R"), Found::Refused(why, _) if why.contains("second order")));
        assert!(matches!(named("C3D10M"), Found::Refused(why, _) if why.contains("second order")));
        assert!(matches!(named("C3D5"), Found::Refused(why, _) if why.contains("pyramid")));
        assert!(matches!(named("R3D4"), Found::Refused(why, _) if why.contains("surface in space")));
        assert!(matches!(named("C3D8H"), Found::Refused(why, _) if why.contains("hybrid")));
        assert!(matches!(named("CPE4RH"), Found::Refused(why, _) if why.contains("hybrid")));
        assert!(matches!(named("QQ"), Found::Refused(why, _) if why.contains("not known")));
        assert_eq!(named("SPRINGA"), Found::Beside);
    }

    #[test]
    fn sides_of_solids_close_them_and_look_outwards() {
        for kind in KINDS.iter().filter(|kind| kind.dimension() == 3) {
            let mut edges: Vec<[usize; 2]> =
                kind.sides.iter().flat_map(|side| (0..side.len()).map(|k| [side[k], side[(k + 1) % side.len()]])).collect();
            edges.sort_unstable();
            // Each edge once in either direction.
            assert!(edges.windows(2).all(|pair| pair[0] != pair[1]), "{}", kind.name);
            assert!(edges.iter().all(|&[a, b]| edges.binary_search(&[b, a]).is_ok()), "{}", kind.name);
            assert_eq!(kind.sides.iter().flat_map(|side| side.iter()).max(), Some(&(kind.nodes - 1)));
        }
    }

    #[test]
    fn every_type_is_found_by_its_name() {
        for kind in KINDS {
            assert_eq!(named(kind.name), Found::Body(kind));
        }
    }
}
