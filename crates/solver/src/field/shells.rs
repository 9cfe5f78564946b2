//! Forces, moments and thickness of shells. Axis 1 is along the shell, in 2D 2 is out of the plane (around
//! the axis of an axisymmetric model).

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
            "forces of a shell by width: integrals of the stress through the thickness",
            of_cells(|cell, values| values.copy_from_slice(&of_shell(cell)[..values.len()])),
        ),
        field(
            "bending_moment",
            Components::Section,
            "N",
            "moments of a shell by width; positive where the face on the left of the line is compressed",
            of_cells(|cell, values| values.copy_from_slice(&of_shell(cell)[3..3 + values.len()])),
        ),
        field(
            "transverse_force",
            Components::Scalar,
            "N/m",
            "transverse force of a shell by width",
            of_cells(|cell, values| values[0] = of_shell(cell)[6]),
        ),
        field("thickness", Components::Scalar, "m", "thickness of a shell", of_cells(|cell, values| values[0] = cell.state.shell[8])),
    ]
}
