//! The bar of two nodes: what is told of it in the registry. Its equations are in `block/bar.rs`: it has a length and no Jacobian of the plane.

use super::ElementKind;

/// A straight bar that bears a force along its line and nothing else.
pub const BAR2: ElementKind = ElementKind {
    name: "bar2",
    doc: "bar of two nodes for trusses and cables: uniaxial stress, any rotation and stretch; no bending; `area` is its cross-section",
    source: "Belytschko, Liu and Moran, Nonlinear Finite Elements (2000), 2.3 and 4.4",
    nodes: 2,
    dimension: 2,
};
