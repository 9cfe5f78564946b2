//! The shell of four nodes with 2 × 2 points in the plane: its entry in the registry.

use super::ElementKind;
use crate::mesh::cell::CellKind;

/// A shell in 3D, of quadrilaterals: the control of [`super::SHELL4`].
pub const SHELL4_FULL: ElementKind = ElementKind {
    name: "shell4_full",
    doc: "shell of four nodes in 3D: 2 x 2 points over its surface, no stabilisation, transverse shear of MITC4; to check `shell4` by: stiff in bending about its normal, and about three times as slow",
    source: "Dvorkin and Bathe, Eng. Comput. 1 (1984) 77-88; Simo and Fox, Comput. Meth. Appl. Mech. Engng 72 (1989) 267-304",
    cell: CellKind::Quadrilateral,
    dimension: 3,
    extruded: None,
    is_default: false,
};
