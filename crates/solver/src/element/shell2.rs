//! The shell of two nodes: its entry in the registry. Its equations are in `block/shell/line.rs`: its nodes
//! rotate, and its points are layers.

use super::ElementKind;
use crate::mesh::cell::CellKind;

/// A shell in 2D, or a beam of rectangular section.
pub const SHELL2: ElementKind = ElementKind {
    name: "shell2",
    doc: "shell of two nodes in 2D: layers through the thickness (`section`), bending and transverse shear, any rotation; no bulk viscosity; a beam in plane stress, a shell of revolution in an axisymmetric model",
    source: "Hughes and Liu, Comput. Meth. Appl. Mech. Engng 27 (1981) 167-181; Simo and Vu-Quoc, J. Appl. Mech. 53 (1986) 849-854",
    cell: CellKind::Line,
    dimension: 2,
    extruded: None,
    is_default: false,
};
