//! Elements made heavier, for a longer stable step: before nodes have their masses, and in the run.

use super::store::{CHUNK, ElementStore};
use super::{Block, Report};
use crate::reductions;
use crate::tensor::{Dim, Space};
use embate_lanes::BATCH;

/// By how much an element with this `squared` stable step, s², is too light for the second of two if it is
/// below the first; 1: it is not.
fn lack(squared: f64, [short, wanted]: [f64; 2]) -> f64 {
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

    /// Nodes of a lane, which may be a copy of a live element.
    fn nodes_of(&self, batch: usize, lane: usize) -> impl Iterator<Item = u32> {
        let nodes = self.facts().nodes;
        (0..nodes).map(move |a| self.nodes.node(batch * nodes + a, lane, nodes) as u32)
    }

    /// See [`Block::mass_for`].
    pub(super) fn needed_mass(&self, squared: [f64; 2], may: &dyn Fn(u32) -> bool) -> f64 {
        let of = |element: usize| {
            let (batch, lane) = (element / BATCH, element % BATCH);
            let values = &self.elements[batch];
            let lack = lack(values.time_step_squared.0[lane], squared);
            if lack > 1.0 && self.nodes_of(batch, lane).all(may) { (lack - 1.0) * values.mass_least.0[lane] } else { 0.0 }
        };
        (0..self.count).filter(|&element| self.is_alive(element)).map(of).sum()
    }

    /// See [`Block::make_heavier`]; whether any was given.
    pub(super) fn add_mass(&mut self, squared: [f64; 2], may: &dyn Fn(u32) -> bool, add: &mut dyn FnMut(u32, f64)) -> bool {
        let mut is_any = false;
        for chunk in 0..self.reports.len() {
            let batches = chunk * CHUNK..((chunk + 1) * CHUNK).min(self.elements.len());
            if self.eroded.is_gone(chunk) || !(self.reports[chunk].time_step_squared < squared[0]) {
                continue;
            }
            for batch in batches.clone() {
                for lane in 0..BATCH {
                    is_any |= self.add_mass_to(batch, lane, squared, may, add);
                }
            }
            let steps = self.elements[batches].iter().flat_map(|values| values.time_step_squared.0);
            let shortest = reductions::min(steps);
            self.reports[chunk] = Report { time_step_squared: shortest, ..self.reports[chunk] };
        }
        is_any
    }

    /// The same of a lane. One that is not live is a copy of one that is, and gets as much, for no node.
    fn add_mass_to(
        &mut self,
        batch: usize,
        lane: usize,
        squared: [f64; 2],
        may: &dyn Fn(u32) -> bool,
        add: &mut dyn FnMut(u32, f64),
    ) -> bool {
        let (least, own) = (self.elements[batch].mass_least.0[lane], self.elements[batch].time_step_squared.0[lane]);
        let lack = lack(own, squared);
        if !(lack > 1.0 && self.nodes_of(batch, lane).all(may)) {
            return false;
        }
        let mass = (lack - 1.0) * least / self.facts().nodes as f64;
        if self.elements[batch].live.0[lane] > 0.0 {
            self.nodes_of(batch, lane).for_each(|node| add(node, mass));
        }
        let values = &mut self.elements[batch];
        values.mass_least.0[lane] *= lack;
        values.time_step_squared.0[lane] *= lack;
        // Reports of changes are those of the stiffness.
        if let Some(marks) = self.marks.get_mut(batch) {
            marks.0[lane] *= lack;
        }
        true
    }
}
