//! Elements made heavier, for a longer stable step: before nodes have their masses, and in the run.

use super::Report;
use super::store::{CHUNK, ElementStore};
use crate::reductions;
use crate::tensor::{Dim, Space};
use embate_lanes::BATCH;
use std::ops::Range;

/// By how much an element with this `squared` stable step, s², is too light for the second of two if it is
/// below the first; 1: it is not.
fn lack(squared: f64, [short, wanted]: [f64; 2]) -> f64 {
    if squared < short { wanted / squared } else { 1.0 }
}

impl<const D: usize> ElementStore<D>
where
    Dim<D>: Space<D>,
{
    /// Before the first [`super::Block::advance`] that counts.
    pub(super) fn scale_corner_masses(&mut self, element: usize, factor: f64) {
        let nodes = self.facts().nodes;
        for (batch, lane) in self.lanes_of(element) {
            for a in 0..nodes {
                self.corner_mass[batch * nodes + a].0[lane] *= factor;
            }
            self.elements[batch].mass_least.0[lane] *= factor;
        }
    }

    /// Batch and lane of an element, and of its copies: those that fill the last batch are of the last
    /// element.
    pub(super) fn lanes_of(&self, element: usize) -> impl Iterator<Item = (usize, usize)> + use<D> {
        let end = if element == self.count - 1 { self.elements.len() * BATCH } else { element + 1 };
        (element..end).map(|lane| (lane / BATCH, lane % BATCH))
    }

    /// Batches of the chunks in which an element is too light, chunk by chunk.
    fn light_chunks(&self, squared: [f64; 2]) -> Vec<(usize, Range<usize>)> {
        let is_light = |&chunk: &usize| !self.eroded.is_gone(chunk) && self.reports[chunk].time_step_squared < squared[0];
        let batches = |chunk: usize| chunk * CHUNK..((chunk + 1) * CHUNK).min(self.elements.len());
        (0..self.reports.len()).filter(is_light).map(|chunk| (chunk, batches(chunk))).collect()
    }

    /// By how much the element in a lane is too light, if all of its nodes `may` get mass; the mass that it
    /// lacks, kg/m in 2D.
    fn lack(&self, batch: usize, lane: usize, squared: [f64; 2], may: &dyn Fn(u32) -> bool) -> Option<[f64; 2]> {
        let values = &self.elements[batch];
        let lack = lack(values.time_step_squared.0[lane], squared);
        let lacks = lack > 1.0 && self.nodes_of(batch, lane).all(|node| may(node as u32));
        lacks.then(|| [lack, (lack - 1.0) * values.mass_least.0[lane]])
    }

    /// See [`super::Block::mass_for`].
    pub(super) fn needed_mass(&self, squared: [f64; 2], may: &dyn Fn(u32) -> bool) -> f64 {
        let lanes = self
            .light_chunks(squared)
            .into_iter()
            .flat_map(|(_, batches)| batches)
            .flat_map(|batch| (0..BATCH).map(move |lane| (batch, lane)));
        let live = lanes.filter(|&(batch, lane)| self.elements[batch].live.0[lane] > 0.0);
        live.filter_map(|(batch, lane)| self.lack(batch, lane, squared, may)).map(|[_, mass]| mass).sum()
    }

    /// See [`super::Block::make_heavier`]; whether any was given.
    pub(super) fn add_mass(&mut self, squared: [f64; 2], may: &dyn Fn(u32) -> bool, add: &mut dyn FnMut(u32, f64)) -> bool {
        let mut is_any = false;
        for (chunk, batches) in self.light_chunks(squared) {
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
        let Some([lack, mass]) = self.lack(batch, lane, squared, may) else { return false };
        if self.elements[batch].live.0[lane] > 0.0 {
            let ratios = self.facts().mass_ratios;
            self.nodes_of(batch, lane).zip(ratios).for_each(|(node, ratio)| add(node as u32, mass / ratio));
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
