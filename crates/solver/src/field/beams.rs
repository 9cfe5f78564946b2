//! Forces and moments of beams, in the axes of their cross-sections: 1 along the beam, 2 and 3 the section's
//! y and z.

use super::{Cell, Components, Description, Source, of_cells};
use crate::field::kind::Needs;

/// Three of its values from one on, where it is a beam: shells have a thickness.
fn of_beam(cell: &Cell<'_>, from: usize) -> [f64; 3] {
    let values = &cell.state.shell;
    if values[8] > 0.0 { [0.0; 3] } else { [values[from], values[from + 1], values[from + 2]] }
}

pub(super) fn fields() -> Vec<Description> {
    let field = |name, unit, doc, source: Source| Description::new(name, Components::Profile, unit, doc, source).needs(Needs::Beams);
    vec![
        field(
            "beam_force",
            "N",
            "normal force of a beam, and its transverse forces along y and z of the cross-section",
            of_cells(|cell, values| values.copy_from_slice(&of_beam(cell, 0))),
        ),
        field(
            "beam_moment",
            "N m",
            "torque of a beam, and its bending moments about y (positive where it is stretched at +z) and z (at -y)",
            of_cells(|cell, values| values.copy_from_slice(&of_beam(cell, 3))),
        ),
    ]
}
