//! What is at the faces and half way of shells, in the axes of the model. Between the points of a layer, and
//! from them to its faces, values are linear: exact with Lobatto's points, of which one is on each face.

use super::{Cell, Components, Description, of_cells};
use crate::dimension::Dimension;
use crate::field::kind::Needs;
use crate::field::snapshot::LiveSnapshot;
use crate::tensor::{self, Dim};

fn stress<const AT: usize>(cell: &Cell<'_>, values: &mut [f64]) {
    values.copy_from_slice(&cell.state.through[AT].stress[..values.len()]);
}

fn von_mises<const AT: usize>(cell: &Cell<'_>, values: &mut [f64]) {
    values[0] = tensor::von_mises(&cell.state.through[AT].stress);
}

fn plastic_strain<const AT: usize>(cell: &Cell<'_>, values: &mut [f64]) {
    values[0] = cell.state.through[AT].plastic_strain;
}

fn director<const D: usize>(at: &LiveSnapshot<'_, D>, node: usize, values: &mut [f64])
where
    Dim<D>: Dimension<D>,
{
    values.copy_from_slice(&at.director(node));
}

pub(super) fn fields() -> Vec<Description> {
    let tensor = |name, doc, source| Description::new(name, Components::Stress, "Pa", doc, source).needs(Needs::Asking);
    let number = |name, unit, doc, source| Description::new(name, Components::Scalar, unit, doc, source).needs(Needs::Asking);
    vec![
        tensor("stress_bottom", "Cauchy stress of a shell at its lower face (in 2D the right one)", of_cells(stress::<0>)),
        tensor("stress_middle", "Cauchy stress of a shell half way through it", of_cells(stress::<1>)),
        tensor("stress_top", "Cauchy stress of a shell at its upper face (in 2D the left one)", of_cells(stress::<2>)),
        number("von_mises_bottom", "Pa", "equivalent stress of a shell at its lower face (in 2D the right one)", of_cells(von_mises::<0>)),
        number("von_mises_middle", "Pa", "equivalent stress of a shell half way through it", of_cells(von_mises::<1>)),
        number("von_mises_top", "Pa", "equivalent stress of a shell at its upper face (in 2D the left one)", of_cells(von_mises::<2>)),
        number(
            "plastic_strain_bottom",
            "",
            "plastic strain of a shell at its lower face (in 2D the right one)",
            of_cells(plastic_strain::<0>),
        ),
        number("plastic_strain_middle", "", "plastic strain of a shell half way through it", of_cells(plastic_strain::<1>)),
        number("plastic_strain_top", "", "plastic strain of a shell at its upper face (in 2D the left one)", of_cells(plastic_strain::<2>)),
        number("thinning", "", "1 - t/t0 of the thickness t of a shell", of_cells(|cell, values| values[0] = cell.state.thinning)),
        Description::new(
            "director",
            Components::Vector,
            "",
            "unit vector normal to a shell at its node, at folds the mean; zero at nodes of no shell",
            of_nodes!(director),
        )
        .needs(Needs::Asking),
    ]
}
