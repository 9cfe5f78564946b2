//! Elements made heavier, for a longer stable step: before nodes have their masses, and in the run.

use super::store::{CHUNK, ElementStore};
use super::{Block, Report};
use crate::reductions;
use crate::tensor::{Dim, Space};
use embate_lanes::BATCH;

/// By how much an element with this squared stable step, s², is too light for `wanted` if it is below
/// `short`; 1: it is not.
fn factor(squared: f64, [short, wanted]: [f64; 2]) -> f64 {
    if squared < short { wanted / squared } else { 1.0 }
}

impl<const D: usize> ElementStore<D>
where
    Dim<D>: Space<D>,
{
    /// Before the first [`Block::advance`] that counts.
    pub(super) fn scale_corner_masses(&mut self, element: usize, factor: f64) {
        let (last, nodes) = (self.count - 1, self.facts().nodes);
        // The lanes that fill the last batch are copies of the last element.
        let lanes = if element == last { element..self.elements.len() * BATCH } else { element..element + 1 };
        for (batch, lane) in lanes.map(|element| (element / BATCH, element % BATCH)) {
            for a in 0..nodes {
                self.corner_mass[batch * nodes + a].0[lane] *= factor;
            }
            self.elements[batch].mass_least.0[lane] *= factor;
        }
    }

    /// See [`Block::mass_for`].
    pub(super) fn needed_mass(&self, wanted: [f64; 2]) -> f64 {
        let of = |element: usize| {
            let (values, lane) = (&self.elements[element / BATCH], element % BATCH);
            (factor(values.time_step_squared.0[lane], wanted) - 1.0) * values.mass_least.0[lane]
        };
        (0..self.count).filter(|&element| self.is_alive(element)).map(of).sum()
    }

    /// See [`Block::make_heavier`]. What is not live is a copy of what is, and gets the same.
    pub(super) fn add_mass(&mut self, wanted: [f64; 2], add: &mut dyn FnMut(u32, f64)) {
        let nodes = self.facts().nodes;
        for (chunk, report) in self.reports.iter_mut().enumerate() {
            if !(report.time_step_squared < wanted[0]) {
                continue;
            }
            let (from, to) = (chunk * CHUNK, ((chunk + 1) * CHUNK).min(self.elements.len()));
            for batch in from..to {
                for lane in 0..BATCH {
                    let values = &mut self.elements[batch];
                    let factor = factor(values.time_step_squared.0[lane], wanted);
                    if factor == 1.0 {
                        continue;
                    }
                    let mass = (factor - 1.0) * values.mass_least.0[lane] / nodes as f64;
                    values.mass_least.0[lane] *= factor;
                    values.time_step_squared.0[lane] *= factor;
                    if values.live.0[lane] > 0.0 {
                        (0..nodes).for_each(|a| add(self.nodes.node(batch * nodes + a, lane, nodes) as u32, mass));
                    }
                }
            }
            let steps = self.elements[from..to].iter().flat_map(|values| values.time_step_squared.0);
            *report = Report { time_step_squared: reductions::min(steps), ..*report };
        }
    }
}
