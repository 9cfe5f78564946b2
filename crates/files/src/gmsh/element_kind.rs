//! The element types that the .msh format numbers: dimension and number of nodes of each, so that those that
//! embate doesn't compute can be skipped in a binary file and named in a message. Source: "Node
//! ordering" and "MSH file format" of the Gmsh reference manual; the numbers of nodes are those that Gmsh
//! 4.15 reports for each type.

use embate_solver::mesh::cell::CellKind;

/// An element type of the format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct ElementKind {
    /// Number in the file.
    pub(super) number: i64,
    /// Name for messages.
    pub(super) name: &'static str,
    /// 0 point, 1 line, 2 surface, 3 volume.
    pub(super) dimension: u8,
    /// Number of nodes.
    pub(super) nodes: usize,
}

impl ElementKind {
    /// The type with this number in the file.
    pub(super) fn numbered(number: i64) -> Option<&'static Self> {
        KINDS.binary_search_by_key(&number, |kind| kind.number).ok().map(|index| &KINDS[index])
    }

    /// The kind of cell that it becomes; `None`: it can't be computed. Of the second order only the
    /// tetrahedron and the triangle have one; of others the first nodes are the corners, and are kept.
    pub(super) fn cell(&self) -> Option<CellKind> {
        CellKind::of_gmsh(self.number).or_else(|| Some(REDUCED.iter().find(|(number, _)| *number == self.number)?.1))
    }

    /// The places of its nodes in the cell: Gmsh exchanges the last two of a tetrahedron of ten.
    pub(super) fn place(&self, node: usize) -> usize {
        match (self.number, node) {
            (11, 8) => 9,
            (11, 9) => 8,
            _ => node,
        }
    }

    /// Whether it is a pyramid, for which there is no element, of whatever order.
    pub(super) fn is_pyramid(&self) -> bool {
        self.name.ends_with("pyramid")
    }
}

const fn kind(number: i64, name: &'static str, dimension: u8, nodes: usize) -> ElementKind {
    ElementKind { number, name, dimension, nodes }
}

/// Cells of second order, and those of their corners. The side of a six-node triangle is such a line: the
/// mesh knows the nodes between its corners.
const REDUCED: [(i64, CellKind); 7] = [
    (8, CellKind::Line),
    (10, CellKind::Quadrilateral),
    (12, CellKind::Hexahedron),
    (13, CellKind::Wedge),
    (16, CellKind::Quadrilateral),
    (17, CellKind::Hexahedron),
    (18, CellKind::Wedge),
];

/// In the order of their numbers; types without a fixed number of nodes (polygons, polyhedra) are left out.
static KINDS: &[ElementKind] = &[
    kind(1, "line", 1, 2),
    kind(2, "triangle", 2, 3),
    kind(3, "quadrilateral", 2, 4),
    kind(4, "tetrahedron", 3, 4),
    kind(5, "hexahedron", 3, 8),
    kind(6, "prism", 3, 6),
    kind(7, "pyramid", 3, 5),
    kind(8, "3-node line", 1, 3),
    kind(9, "6-node triangle", 2, 6),
    kind(10, "9-node quadrilateral", 2, 9),
    kind(11, "10-node tetrahedron", 3, 10),
    kind(12, "27-node hexahedron", 3, 27),
    kind(13, "18-node prism", 3, 18),
    kind(14, "14-node pyramid", 3, 14),
    kind(15, "point", 0, 1),
    kind(16, "8-node quadrilateral", 2, 8),
    kind(17, "20-node hexahedron", 3, 20),
    kind(18, "15-node prism", 3, 15),
    kind(19, "13-node pyramid", 3, 13),
    kind(20, "9-node triangle", 2, 9),
    kind(21, "10-node triangle", 2, 10),
    kind(22, "12-node triangle", 2, 12),
    kind(23, "15-node triangle", 2, 15),
    kind(24, "15-node triangle", 2, 15),
    kind(25, "21-node triangle", 2, 21),
    kind(26, "4-node line", 1, 4),
    kind(27, "5-node line", 1, 5),
    kind(28, "6-node line", 1, 6),
    kind(29, "20-node tetrahedron", 3, 20),
    kind(30, "35-node tetrahedron", 3, 35),
    kind(31, "56-node tetrahedron", 3, 56),
    kind(32, "22-node tetrahedron", 3, 22),
    kind(33, "28-node tetrahedron", 3, 28),
    kind(36, "16-node quadrilateral", 2, 16),
    kind(37, "25-node quadrilateral", 2, 25),
    kind(38, "36-node quadrilateral", 2, 36),
    kind(39, "12-node quadrilateral", 2, 12),
    kind(40, "16-node quadrilateral", 2, 16),
    kind(41, "20-node quadrilateral", 2, 20),
    kind(42, "28-node triangle", 2, 28),
    kind(43, "36-node triangle", 2, 36),
    kind(44, "45-node triangle", 2, 45),
    kind(45, "55-node triangle", 2, 55),
    kind(46, "66-node triangle", 2, 66),
    kind(47, "49-node quadrilateral", 2, 49),
    kind(48, "64-node quadrilateral", 2, 64),
    kind(49, "81-node quadrilateral", 2, 81),
    kind(50, "100-node quadrilateral", 2, 100),
    kind(51, "121-node quadrilateral", 2, 121),
    kind(52, "18-node triangle", 2, 18),
    kind(53, "21-node triangle", 2, 21),
    kind(54, "24-node triangle", 2, 24),
    kind(55, "27-node triangle", 2, 27),
    kind(56, "30-node triangle", 2, 30),
    kind(57, "24-node quadrilateral", 2, 24),
    kind(58, "28-node quadrilateral", 2, 28),
    kind(59, "32-node quadrilateral", 2, 32),
    kind(60, "36-node quadrilateral", 2, 36),
    kind(61, "40-node quadrilateral", 2, 40),
    kind(62, "7-node line", 1, 7),
    kind(63, "8-node line", 1, 8),
    kind(64, "9-node line", 1, 9),
    kind(65, "10-node line", 1, 10),
    kind(66, "11-node line", 1, 11),
    kind(71, "84-node tetrahedron", 3, 84),
    kind(72, "120-node tetrahedron", 3, 120),
    kind(73, "165-node tetrahedron", 3, 165),
    kind(74, "220-node tetrahedron", 3, 220),
    kind(75, "286-node tetrahedron", 3, 286),
    kind(79, "34-node tetrahedron", 3, 34),
    kind(80, "40-node tetrahedron", 3, 40),
    kind(81, "46-node tetrahedron", 3, 46),
    kind(82, "52-node tetrahedron", 3, 52),
    kind(83, "58-node tetrahedron", 3, 58),
    kind(84, "1-node line", 1, 1),
    kind(85, "1-node triangle", 2, 1),
    kind(86, "1-node quadrilateral", 2, 1),
    kind(87, "1-node tetrahedron", 3, 1),
    kind(88, "1-node hexahedron", 3, 1),
    kind(89, "1-node prism", 3, 1),
    kind(92, "64-node hexahedron", 3, 64),
    kind(93, "125-node hexahedron", 3, 125),
    kind(94, "216-node hexahedron", 3, 216),
    kind(95, "343-node hexahedron", 3, 343),
    kind(96, "512-node hexahedron", 3, 512),
    kind(97, "729-node hexahedron", 3, 729),
    kind(98, "1000-node hexahedron", 3, 1000),
    kind(99, "32-node hexahedron", 3, 32),
    kind(100, "44-node hexahedron", 3, 44),
    kind(101, "56-node hexahedron", 3, 56),
    kind(102, "68-node hexahedron", 3, 68),
    kind(103, "80-node hexahedron", 3, 80),
    kind(104, "92-node hexahedron", 3, 92),
    kind(105, "104-node hexahedron", 3, 104),
    kind(118, "30-node pyramid", 3, 30),
    kind(119, "55-node pyramid", 3, 55),
    kind(120, "91-node pyramid", 3, 91),
    kind(121, "140-node pyramid", 3, 140),
    kind(122, "204-node pyramid", 3, 204),
    kind(123, "285-node pyramid", 3, 285),
    kind(124, "385-node pyramid", 3, 385),
    kind(125, "21-node pyramid", 3, 21),
    kind(126, "29-node pyramid", 3, 29),
    kind(127, "37-node pyramid", 3, 37),
    kind(128, "45-node pyramid", 3, 45),
    kind(129, "53-node pyramid", 3, 53),
    kind(130, "61-node pyramid", 3, 61),
    kind(131, "69-node pyramid", 3, 69),
    kind(132, "1-node pyramid", 3, 1),
    kind(137, "16-node tetrahedron", 3, 16),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_type_is_found_by_its_number() {
        for kind in KINDS {
            assert_eq!(ElementKind::numbered(kind.number), Some(kind));
        }
        assert_eq!(ElementKind::numbered(34), None);
        assert_eq!(ElementKind::numbered(-1), None);
    }

    #[test]
    fn cells_of_first_and_second_order_are_computed_and_no_pyramids() {
        let computed: Vec<_> = KINDS.iter().filter(|kind| kind.cell().is_some()).collect();
        assert_eq!(computed.iter().map(|kind| kind.number).collect::<Vec<_>>(), [1, 2, 3, 4, 5, 6, 8, 9, 10, 11, 12, 13, 15, 16, 17, 18]);
        for kind in &computed {
            let cell = kind.cell().unwrap();
            assert_eq!(cell.dimension(), usize::from(kind.dimension), "{}", kind.name);
            let is_reduced = REDUCED.iter().any(|(number, _)| *number == kind.number);
            assert!(if is_reduced { cell.nodes() < kind.nodes } else { cell.nodes() == kind.nodes }, "{}", kind.name);
        }
        assert!(!computed.iter().any(|kind| kind.is_pyramid()));
    }
}
