//! Energy of elements.

use super::{Components, Description, of_cells};

pub(super) fn fields() -> Vec<Description> {
    vec![Description::new(
        "energy_density",
        Components::Scalar,
        "J/m^3",
        "stored elastic energy per initial volume",
        of_cells(|cell, values| values[0] = cell.state.energy_density),
    )]
}
