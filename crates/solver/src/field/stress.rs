//! Stresses of elements.

use super::{Components, Description, of_cells};
use crate::tensor;

/// Equivalent stress; pictures fall back on it.
pub(crate) const VON_MISES: Description = Description::new(
    "von_mises",
    Components::Scalar,
    "Pa",
    "equivalent stress √(3/2 s:s) of the mean stress",
    of_cells(|cell, values| values[0] = tensor::von_mises(&cell.state.stress)),
);

pub(super) fn fields() -> Vec<Description> {
    vec![
        Description::new(
            "stress",
            Components::Stress,
            "Pa",
            "Cauchy stress, mean over the element's points, of shells that of the worst layer",
            of_cells(|cell, values| values.copy_from_slice(&cell.state.stress[..values.len()])),
        ),
        VON_MISES,
        Description::new(
            "pressure",
            Components::Scalar,
            "Pa",
            "minus a third of the stress trace",
            of_cells(|cell, values| values[0] = -(cell.state.stress[0] + cell.state.stress[1] + cell.state.stress[2]) / 3.0),
        ),
    ]
}
