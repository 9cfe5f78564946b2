//! Forces, moments and thickness of shells. In 2D axis 1 is along the shell, 2 out of the plane (around the
//! axis of an axisymmetric model). In 3D axis 1 is at the start the projection of x on the element (of z
//! where the element is normal to x), 3 its normal; both turn with the element.

use super::{Cell, Components, Description, Source, of_cells};
use crate::block::SHELL_VALUES;
use crate::field::kind::Needs;

/// Its values, where it is a shell: beams have no thickness.
fn of_shell(cell: &Cell<'_>) -> [f64; SHELL_VALUES] {
    if cell.state.shell[8] > 0.0 { cell.state.shell } else { [0.0; SHELL_VALUES] }
}

pub(super) fn fields() -> Vec<Description> {
    let field = |name, components, unit, doc, source: Source| Description::new(name, components, unit, doc, source).needs(Needs::Shells);
    vec![
        field(
            "membrane_force",
            Components::Section,
            "N/m",
            "forces of a shell by width: integrals of the stress through the thickness; axes: along the shell and out of the plane, in 3D the projection of x (of z) at the start and across it",
            of_cells(|cell, values| values.copy_from_slice(&of_shell(cell)[..values.len()])),
        ),
        field(
            "bending_moment",
            Components::Section,
            "N",
            "moments of a shell by width about the surface of its nodes; positive where the face on the left of the line (in 3D the upper face) is compressed",
            of_cells(|cell, values| values.copy_from_slice(&of_shell(cell)[3..3 + values.len()])),
        ),
        field(
            "transverse_force",
            Components::Across,
            "N/m",
            "transverse force of a shell by width",
            of_cells(|cell, values| values.copy_from_slice(&of_shell(cell)[6..6 + values.len()])),
        ),
        field("thickness", Components::Scalar, "m", "thickness of a shell", of_cells(|cell, values| values[0] = cell.state.shell[8])),
    ]
}
