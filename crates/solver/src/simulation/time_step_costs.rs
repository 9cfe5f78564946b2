//! Which elements the stable step costs most: those with the shortest one, what the first step would be
//! without them, what it would be by nodes and by the assembled mesh, and what subcycling would save.
//!
//! From the state at time zero; `embate check --time-step` shows it.

use super::Runs;
use crate::step::System;
use crate::tensor::Dim;

/// An element with a short stable step.
#[derive(Clone, Debug, PartialEq)]
pub struct CostlyElement {
    /// Its part.
    pub part: String,
    /// Its number, of the model where this gives one.
    pub number: u64,
    /// Its centre, m.
    pub at: Vec<f64>,
    /// Its stable step, `safety` included, s.
    pub time_step: f64,
    /// The stable step of the elements without this one and all that are worse, `safety` included, s;
    /// infinite: none is left.
    pub without: f64,
}

/// What the stable step costs.
#[derive(Clone, Debug, PartialEq)]
pub struct TimeStepCosts {
    /// The worst elements, from the shortest step on.
    pub elements: Vec<CostlyElement>,
    /// The first step by nodes, `safety` included, s, and who sets it; `None`: not longer than by elements.
    pub by_nodes: Option<(f64, String)>,
    /// The same by the assembled mesh; `None`: not so much longer that it saves what it costs.
    pub by_assembled_mesh: Option<(f64, String)>,
    /// What of all evaluations of elements remains with subcycling, without contact.
    pub with_subcycling: f64,
}

/// Of the `most` worst elements.
pub(super) fn of<const D: usize>(system: &System<D>, most: usize) -> TimeStepCosts
where
    Dim<D>: Runs<D>,
{
    let mut all: Vec<(f64, usize, usize)> = system.element_steps(|_| true).collect();
    all.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let step = |squared: f64| system.limits.safety * squared.sqrt();
    let next = all.iter().skip(1).map(|&(squared, ..)| step(squared)).chain([f64::INFINITY]);
    let costly = |(&(squared, g, element), without): (&(f64, usize, usize), f64)| {
        let group = &system.mesh.groups[g];
        CostlyElement {
            part: system.mesh.parts[group.part].name.clone(),
            number: u64::from(group.user_elements[element]),
            at: system.centre(group.nodes_of(element)).to_vec(),
            time_step: step(squared),
            without,
        }
    };
    TimeStepCosts {
        elements: all.iter().zip(next).take(most).map(costly).collect(),
        by_nodes: system.step_by_nodes(),
        by_assembled_mesh: system.step_by_assembled_mesh(),
        with_subcycling: system.share_with_subcycling(),
    }
}
