//! The beam of two nodes: its entry in the registry. Its equations are in `block/shell/beam.rs`: its nodes
//! rotate, and its points are fibres.

use super::ElementKind;
use crate::mesh::cell::CellKind;

/// A beam in 3D.
pub const BEAM2: ElementKind = ElementKind {
    name: "beam2",
    doc: "beam of two nodes in 3D: fibres of uniaxial stress over the cross-section (`profile`), bending and stretch of any law; torsion and transverse shear elastic; any rotation",
    source: "Simo and Vu-Quoc, Comput. Meth. Appl. Mech. Engng 58 (1986) 79-116; Crisfield and Jelenic, Proc. R. Soc. A 455 (1999) 1125-1147",
    cell: CellKind::Line,
    dimension: 3,
    extruded: None,
    is_default: false,
};
