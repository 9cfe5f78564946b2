//! The shell of four nodes: its entry in the registry. Its nodes rotate, and its points are layers.

use super::ElementKind;
use crate::mesh::cell::CellKind;

/// A shell in 3D, of quadrilaterals.
pub const SHELL4: ElementKind = ElementKind {
    name: "shell4",
    doc: "shell of four nodes in 3D: one point in the plane, layers through the thickness (`section`), physical stabilisation, transverse shear of MITC4; any rotation, no drilling stiffness",
    source: "Dvorkin and Bathe, Eng. Comput. 1 (1984) 77-88; Simo and Fox, Comput. Meth. Appl. Mech. Engng 72 (1989) 267-304",
    cell: CellKind::Quadrilateral,
    dimension: 3,
    extruded: None,
    is_default: false,
};
