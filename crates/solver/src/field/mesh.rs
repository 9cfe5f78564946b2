//! What elements are in a mesh: how well they are shaped, and which step they allow.

use super::kind::Needs;
use super::{Components, Description, of_cells};

pub(super) fn fields() -> Vec<Description> {
    vec![
        Description::new(
            "element_quality",
            Components::Scalar,
            "",
            "least area (in 3D volume) of the edges at a corner over the square (cube) of the longest edge: 1 of squares and cubes, \
                0.87 and 0.71 of regular triangles and tetrahedra, 0 where an element folds",
            of_cells(|cell, values| values[0] = cell.within.quality(cell.place)),
        )
        .needs(Needs::Asking),
        Description::new(
            "stable_step",
            Components::Scalar,
            "s",
            "longest stable step of the element alone, without the safety factor; 0 in rigid parts, which limit none",
            of_cells(|cell, values| values[0] = cell.within.stable_step(cell.place)),
        )
        .needs(Needs::Asking),
    ]
}
