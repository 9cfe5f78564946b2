//! The shell of three nodes: its entry in the registry. Its nodes rotate, and its points are layers.

use super::ElementKind;
use crate::mesh::cell::CellKind;

/// A shell in 3D, of triangles: those of a part of [`super::SHELL4`] too.
pub const SHELL3: ElementKind = ElementKind {
    name: "shell3",
    doc: "shell of three nodes in 3D: constant membrane and bending, transverse shear of MITC3",
    source: "Lee and Bathe, Comput. Struct. 82 (2004) 945-962; Lyly, Stenberg and Vihinen, Comput. Meth. Appl. Mech. Engng 110 (1993) 343-357",
    cell: CellKind::Triangle,
    dimension: 3,
    extruded: None,
    is_default: true,
};
