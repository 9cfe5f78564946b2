//! A run that is over after a few steps, or never: an end, or a mesh, in another unit than it was meant in.
//!
//! From the first step; the warning goes to those of the model, before the run.

use super::Runs;
use crate::error::{FEW_STEPS, Warning};
use crate::model::{Model, Shape};
use crate::step::System;
use crate::tensor::Dim;

/// Fewer steps show nothing: no wave has crossed more than as many elements.
const FEW: f64 = 10.0;
/// A run of so many takes weeks even with a hundred elements.
const MANY: f64 = 1e9;

/// A warning, if there are too few steps or too many.
pub(super) fn warning<const D: usize>(model: &Model, system: &System<D>) -> Option<Warning>
where
    Dim<D>: Runs<D>,
{
    let shortest = system.element_steps(|_| true).map(|(square, ..)| square.sqrt()).fold(f64::INFINITY, f64::min);
    // The first step may be cut off by the end.
    let step = if shortest.is_finite() {
        system.time_step.max((model.run.safety * shortest).min(system.limits.largest))
    } else {
        system.time_step
    };
    let steps = (system.limits.end / step).ceil();
    let is_few = steps < FEW;
    if !(is_few || steps > MANY) {
        return None;
    }
    let from_file = model.parts.iter().any(|part| matches!(part.shape, Shape::Group { .. }));
    let scale = if from_file { "; or give `scale` in `mesh` the unit of the file's lengths, such as `scale = \"1 mm\"`" } else { "" };
    let (message, consequence, help) = if is_few {
        let count = if steps <= 1.0 { "one step".to_string() } else { format!("{steps} steps") };
        (
            format!("the run is over after {count}: it ends at {:.4e} s, and the stable step is {step:.4e} s", system.limits.end),
            "no wave crosses more than as many elements, so nothing is to be seen",
            format!("look at the unit of `end` and at the size of the elements: numbers without a unit are in s and m{scale}"),
        )
    } else {
        (
            format!("the run takes {steps:.2e} steps: it ends at {:.4e} s, and the stable step is {step:.4e} s", system.limits.end),
            "it would take weeks or years",
            format!("look at the unit of `end`, and at what makes the step short: `embate check --time-step`{scale}"),
        )
    };
    Some(Warning { kind: &FEW_STEPS, path: "run.end".into(), message, consequence: consequence.into(), help })
}
