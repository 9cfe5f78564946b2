//! Strains and rates in the middle of elements, from the motion of their nodes; only where someone asks.
//! Shells have those of their middle surface and thickness, beams and bars that along them. In plane stress
//! the strain out of the plane is not known from the nodes, and is 0.

use super::{Cell, Components, Description, of_cells};
use crate::field::kind::Needs;
use crate::rotation::{Square, transposed};
use crate::tensor::{Solid, SymmetricTensor, product};

/// Components xx yy zz xy yz zx.
fn symmetric(m: &Square<3>) -> Solid<f64> {
    Solid([m[0][0], m[1][1], m[2][2], 0.5 * (m[0][1] + m[1][0]), 0.5 * (m[1][2] + m[2][1]), 0.5 * (m[2][0] + m[0][2])])
}

/// ½ ln(F Fᵀ).
fn logarithmic(cell: &Cell<'_>) -> [f64; 6] {
    let f = cell.kinematics().gradient;
    let (values, projections) = symmetric(&product(&f, &transposed(&f))).principal();
    let mut sum = Solid([0.0; 6]);
    for (value, projection) in values.into_iter().zip(projections) {
        sum = sum.plus(projection.times(0.5 * value.ln()));
    }
    sum.0
}

/// ½ (Fᵀ F − 1).
fn green(cell: &Cell<'_>) -> [f64; 6] {
    let f = cell.kinematics().gradient;
    symmetric(&product(&transposed(&f), &f)).plus_isotropic(-1.0).times(0.5).0
}

/// L: row by row, in 2D xx xy yx yy.
fn rate(cell: &Cell<'_>, values: &mut [f64]) {
    let rate = cell.kinematics().rate;
    let dimension = if values.len() == 9 { 3 } else { 2 };
    values.chunks_exact_mut(dimension).zip(rate).for_each(|(own, row)| own.copy_from_slice(&row[..dimension]));
}

pub(super) fn fields() -> Vec<Description> {
    let field = |name, components, unit, doc, source| Description::new(name, components, unit, doc, source).needs(Needs::Asking);
    vec![
        field(
            "strain_log",
            Components::Stress,
            "",
            "logarithmic strain ½ ln(F Fᵀ) in the middle of the element",
            of_cells(|cell, values| values.copy_from_slice(&logarithmic(cell)[..values.len()])),
        ),
        field(
            "strain_green",
            Components::Stress,
            "",
            "Green's strain ½ (Fᵀ F − 1) in the middle of the element",
            of_cells(|cell, values| values.copy_from_slice(&green(cell)[..values.len()])),
        ),
        field(
            "velocity_gradient",
            Components::Gradient,
            "1/s",
            "velocity gradient ∂v_i/∂x_j in the middle of the element, at v^{n+½}, row by row",
            of_cells(rate),
        ),
    ]
}
