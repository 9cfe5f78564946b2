//! Elements whose stable step is far below that of the others of their part: slivers of a mesh, most often,
//! for which all others have to wait.
//!
//! From the steps of the elements at time zero; warnings go to those of the model, before the run.

use super::Runs;
use crate::error::Warning;
use crate::mesh::messages::TINY_STEP;
use crate::step::System;
use crate::tensor::Dim;

/// An element whose step is so many times shorter than that of half of its part's elements is no matter of
/// grading any more.
const FAR_BELOW: f64 = 1000.0;

/// A warning for each part with such elements, as far as they set the step.
pub(super) fn warnings<const D: usize>(system: &System<D>) -> Vec<Warning>
where
    Dim<D>: Runs<D>,
{
    (0..system.mesh.parts.len()).filter_map(|part| of_part(system, part)).collect()
}

fn of_part<const D: usize>(system: &System<D>, part: usize) -> Option<Warning>
where
    Dim<D>: Runs<D>,
{
    let mut steps: Vec<(f64, usize, usize)> = system.element_steps(|group| group.part == part).collect();
    let (least, group, element) = steps.iter().copied().reduce(|a, b| if b.0 < a.0 { b } else { a })?;
    // Of two the larger one.
    let middle = steps.len() / 2;
    let (_, &mut (median, ..), _) = steps.select_nth_unstable_by(middle, |a, b| a.0.total_cmp(&b.0));
    let safety = system.limits.safety;
    let [shortest, usual] = [least, median].map(|square| square.sqrt().min(system.limits.largest / safety));
    if !(shortest > 0.0 && usual > FAR_BELOW * shortest) {
        return None;
    }
    let such = steps.iter().filter(|step| FAR_BELOW * step.0.sqrt() < usual).count();
    let others = if such > 1 { format!(", and {} more are as bad", such - 1) } else { String::new() };
    let count = |step: f64| (system.limits.end / (safety * step)).ceil();
    Some(Warning {
        kind: &TINY_STEP,
        path: format!("part[{part}]"),
        message: format!(
            "the stable step of {} is {shortest:.3e} s, {:.2e} times shorter than that of half of the part's elements{others}",
            system.element_name(group, element),
            usual / shortest
        ),
        consequence: format!("the run takes about {:.2e} steps, where {:.2e} would do", count(shortest), count(usual)),
        help: "fix the mesh there (a corner or a node just beside an edge makes a sliver), or give `run.mass_scaling`".into(),
    })
}
