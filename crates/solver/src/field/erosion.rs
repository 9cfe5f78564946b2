//! Which elements have been eroded.

use super::{Components, Description, of_cells};
use crate::field::kind::Needs;

/// 1 or 0; files hide what is not alive.
pub(crate) const ALIVE: Description = Description::new(
    "alive",
    Components::Scalar,
    "",
    "1 where the element is there, 0 where it was eroded: then its other values are those when it failed",
    of_cells(|cell, values| values[0] = f64::from(u8::from(cell.is_alive))),
)
.needs(Needs::Failure);

pub(super) fn fields() -> Vec<Description> {
    vec![ALIVE]
}
