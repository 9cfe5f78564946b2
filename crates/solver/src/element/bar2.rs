//! The bar of two nodes: its entry in the registry. Its equations are in `block/bar.rs`: it has a
//! length and no Jacobian in 2D.

use super::ElementKind;
use crate::mesh::cell::CellKind;

/// A straight bar that bears a force along its line and nothing else.
pub const BAR2: ElementKind = ElementKind {
    name: "bar2",
    doc: "bar of two nodes for trusses and cables: uniaxial stress, any rotation and stretch; no bending; `area` is its cross-section",
    source: "Belytschko, Liu and Moran, Nonlinear Finite Elements (2000), 2.3 and 4.4",
    cell: CellKind::Line,
    dimension: 2,
    extruded: None,
    is_default: false,
};
