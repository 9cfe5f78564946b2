//! Eroded elements: which fail, and how they leave a block without costing the others anything.
//!
//! Kernels have no branch for them: the lane of an eroded element becomes a copy of a live element, as the
//! lanes that fill the last batch are, so nothing in it can go wrong; its forces and energies count zero
//! times. When that live element is eroded too, its copies become copies of another. The state that an
//! element had at the end is kept for output.

use super::batch::ElementBatch;
use super::store::{CHUNK, ElementStore};
use super::{Block, ElementState, Report};
use crate::archive::{ArchiveError, ArchiveResult, persist_all};
use crate::failure::{Criterion, Seen, failing};
use crate::material::Variable;
use crate::tensor::{Dim, Space};
use embate_lanes::{BATCH, Batch, Lane, VectorSums};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// What a block knows of its eroded elements.
pub(super) struct Eroded {
    /// What they dissipated, J/m; nothing else is left of them in the reports.
    pub(super) left: Report,
    /// State of each at the end.
    pub(super) last: BTreeMap<usize, ElementState>,
    /// The live element that the lanes of a chunk without one are copies of; `None`: there is none, and the
    /// chunk rests. Of other chunks it is the last element, as at the start.
    sources: BTreeMap<usize, Option<usize>>,
}

persist_all!(Eroded { left, last, sources });

impl Default for Eroded {
    fn default() -> Self {
        Self { left: Report::NOTHING, last: BTreeMap::new(), sources: BTreeMap::new() }
    }
}

impl Eroded {
    /// Whether a chunk has no live element.
    pub(super) fn is_gone(&self, chunk: usize) -> bool {
        matches!(self.sources.get(&chunk), Some(None))
    }
}

/// A batch of a block as criteria see it.
struct Look<'a, const D: usize> {
    block: &'a ElementStore<D>,
    batch: usize,
}

impl<const D: usize> Look<'_, D>
where
    Dim<D>: Space<D>,
{
    /// Mean over the points of value `value` of `width`.
    fn mean(&self, values: &[Batch], width: usize, value: usize) -> Batch {
        let mut mean = Batch::default();
        let points = self.block.facts().points;
        for p in 0..points {
            let of_point = &values[(self.batch * points + p) * width + value];
            for lane in 0..BATCH {
                mean.0[lane] += of_point.0[lane];
            }
        }
        Batch(mean.0.map(|sum| sum / points as f64))
    }
}

impl<const D: usize> Seen for Look<'_, D>
where
    Dim<D>: Space<D>,
{
    fn stress(&self) -> [Batch; 6] {
        let components = self.block.facts().components;
        std::array::from_fn(|c| if c < components { self.mean(&self.block.stress, components, c) } else { Batch::default() })
    }

    fn variable(&self, variable: &Variable) -> Batch {
        let place = self.block.law.place(variable);
        place.map_or(Batch::default(), |index| self.mean(&self.block.history, self.block.law.state_width(), index))
    }

    fn time_step_squared(&self) -> Batch {
        self.block.elements[self.batch].time_step_squared
    }
}

/// The chunk that an element is in.
fn chunk_of(element: u32) -> usize {
    element as usize / (CHUNK * BATCH)
}

impl<const D: usize> ElementStore<D>
where
    Dim<D>: Space<D>,
{
    pub(super) fn failing(&self, criteria: &[Criterion], parallel: bool) -> Vec<(u32, u32)> {
        let look = |(index, batches): (usize, &[ElementBatch])| -> Vec<(u32, u32)> {
            let mut failed = Vec::new();
            for (within, elements) in batches.iter().enumerate() {
                let batch = index * CHUNK + within;
                let seen = Look { block: self, batch };
                let live = |lane: usize| elements.live.0[lane] > 0.0;
                failed.extend(failing(criteria, &seen, live).map(|(lane, first)| ((batch * BATCH + lane) as u32, first)));
            }
            failed
        };
        if parallel {
            self.elements.par_chunks(CHUNK).enumerate().flat_map_iter(look).collect()
        } else {
            self.elements.chunks(CHUNK).enumerate().flat_map(look).collect()
        }
    }

    pub(super) fn least_determinant(&self, element: usize, positions: &[[f64; D]]) -> f64 {
        let mut corners = Vec::new();
        self.corners(element / BATCH, element % BATCH, positions, &mut corners);
        self.kernel.determinant(&corners)
    }

    /// Work that bulk viscosity and damping have taken of an element, J/m.
    fn resisted(&self, element: usize) -> [f64; 2] {
        let resistance = self.resistance.get(element / BATCH).filter(|_| self.resists());
        resistance.map_or([0.0; 2], |own| [own.viscous.0[element % BATCH], own.damping.0[element % BATCH]])
    }

    pub(super) fn take_out(&mut self, elements: &[u32], slots: &mut [[f64; D]]) -> Vec<f64> {
        let mut stored = Vec::with_capacity(elements.len());
        for &element in elements {
            let state = self.state(element as usize);
            self.eroded.last.insert(element as usize, state);
            let resisted = self.resisted(element as usize);
            let (values, lane) = (&mut self.elements[element as usize / BATCH], element as usize % BATCH);
            values.live.0[lane] = 0.0;
            // What an inverted element thinks it has is no energy.
            let sound = |value: f64| if value.is_finite() { value } else { 0.0 };
            stored.push(sound(values.stored.0[lane]));
            let left = Report {
                dissipated: sound(values.dissipated.0[lane]),
                hourglass: sound(values.hourglass.0[lane]),
                viscous: sound(resisted[0]),
                damping: sound(resisted[1]),
                ..Report::NOTHING
            };
            self.eroded.left = Report::joined([self.eroded.left, left].into_iter());
        }
        for of_chunk in elements.chunk_by(|a, b| chunk_of(*a) == chunk_of(*b)) {
            self.fill_up(of_chunk);
            self.sum_again(chunk_of(of_chunk[0]), of_chunk, slots);
        }
        stored
    }

    /// Enters what elements that are no more had dissipated, and stored.
    pub(super) fn leave(&mut self, before: &Report) {
        let Report { stored, dissipated, hourglass, viscous, damping, .. } = *before;
        let left = Report { stored, dissipated, hourglass, viscous, damping, ..Report::NOTHING };
        self.eroded.left = Report::joined([self.eroded.left, left].into_iter());
    }

    /// Makes lanes of a chunk whose elements are gone copies of one of its live elements.
    fn fill_up(&mut self, gone: &[u32]) {
        let chunk = chunk_of(gone[0]);
        let lanes = chunk * CHUNK * BATCH..((chunk + 1) * CHUNK).min(self.elements.len()) * BATCH;
        let at_start = lanes.contains(&(self.count - 1)).then_some(self.count - 1);
        let old = self.eroded.sources.get(&chunk).copied().unwrap_or(at_start);
        let source = old.filter(|&old| self.is_alive(old)).or_else(|| lanes.clone().find(|&lane| self.is_alive(lane)));
        self.eroded.sources.insert(chunk, source);
        let Some(source) = source else { return };
        if Some(source) == old {
            gone.iter().for_each(|&element| self.copy(source, element as usize));
        } else {
            for lane in lanes {
                if !self.is_alive(lane) {
                    self.copy(source, lane);
                }
            }
        }
    }

    /// Makes all lanes of eroded elements copies again, when the state was filled from outside: of their
    /// initial geometry too.
    pub(super) fn fill_all_up(&mut self) -> ArchiveResult {
        let is_possible = |lane: usize| {
            let live = self.elements[lane / BATCH].live.0[lane % BATCH];
            live == 0.0 || (live == 1.0 && lane < self.count)
        };
        if !(0..self.elements.len() * BATCH).all(is_possible) {
            return Err(ArchiveError::new("an element is neither there nor gone, or one too many is there"));
        }
        let sources = std::mem::take(&mut self.eroded.sources);
        for (&chunk, &source) in &sources {
            let end = chunk.saturating_add(1).saturating_mul(CHUNK).min(self.elements.len()) * BATCH;
            let lanes = chunk.saturating_mul(CHUNK * BATCH)..end;
            let gone: Vec<usize> = lanes.clone().filter(|&lane| !self.is_alive(lane)).collect();
            let is_possible =
                !lanes.is_empty() && source.map_or(gone.len() == lanes.len(), |source| lanes.contains(&source) && !gone.contains(&source));
            if !is_possible {
                return Err(ArchiveError::new("what stands in for eroded elements is not there"));
            }
            let Some(source) = source else { continue };
            gone.into_iter().for_each(|lane| self.copy(source, lane));
        }
        self.eroded.sources = sources;
        Ok(())
    }

    /// The live element that a lane is, or is a copy of; `None` where its chunk has none.
    pub(super) fn live_element_of(&self, lane: usize) -> Option<usize> {
        if self.is_alive(lane) {
            return Some(lane);
        }
        self.eroded.sources.get(&(lane / (CHUNK * BATCH))).copied().unwrap_or(Some(self.count - 1))
    }

    /// Sums the forces of a chunk again, without elements that are gone.
    fn sum_again(&mut self, chunk: usize, gone: &[u32], slots: &mut [[f64; D]]) {
        if !self.keeps_forces {
            return;
        }
        let nodes = self.facts().nodes;
        for &element in gone {
            let first = element as usize / BATCH * nodes * D;
            self.kept[first..first + nodes * D].iter_mut().for_each(|batch| batch.0[element as usize % BATCH] = 0.0);
        }
        let width = self.nodes.width();
        let mut pulls = VectorSums::default();
        pulls.clear(width);
        for batch in chunk * CHUNK..((chunk + 1) * CHUNK).min(self.elements.len()) {
            for lane in 0..BATCH {
                for row in batch * nodes..(batch + 1) * nodes {
                    let force: [f64; D] = std::array::from_fn(|d| self.kept[row * D + d].0[lane]);
                    Lane::scatter(&[force], &mut pulls, &self.nodes.places, row, lane);
                }
            }
        }
        pulls.copy_to(&mut slots[chunk * width..(chunk + 1) * width]);
    }

    /// Makes a lane that counts for nothing a copy of a live element.
    fn copy(&mut self, from: usize, to: usize) {
        let [stress, history, initial, hourglass] = self.widths();
        let damped = self.damped_width();
        let (source, place) = ([from / BATCH, from % BATCH], [to / BATCH, to % BATCH]);
        let nodes = self.facts().nodes;
        for a in 0..nodes {
            self.nodes.places.copy_lane([source[0] * nodes + a, source[1]], [place[0] * nodes + a, place[1]]);
        }
        let lists = [
            (&mut self.stress, stress),
            (&mut self.damped, damped),
            (&mut self.history, history),
            (&mut self.initial, initial),
            (&mut self.hourglass, hourglass),
        ];
        for (list, width) in lists {
            for k in 0..width {
                list[place[0] * width + k].0[place[1]] = list[source[0] * width + k].0[source[1]];
            }
        }
        self.volume_initial[place[0]].0[place[1]] = self.volume_initial[source[0]].0[source[1]];
        for list in [&mut self.marks, &mut self.weights] {
            if !list.is_empty() {
                list[place[0]].0[place[1]] = list[source[0]].0[source[1]];
            }
        }
        let values = self.elements[source[0]];
        self.elements[place[0]].copy_lane(place[1], &values, source[1]);
        if self.resists() {
            let values = self.resistance[source[0]];
            self.resistance[place[0]].copy_lane(place[1], &values, source[1]);
        }
    }

    pub(super) fn of_the_living(&self, positions: &[[f64; D]]) -> Report {
        let of_element = |element: usize| {
            let resisted = self.resisted(element);
            let (values, lane) = (&self.elements[element / BATCH], element % BATCH);
            Report {
                time_step_squared: values.time_step_squared.0[lane],
                step_change: self.marks.get(element / BATCH).map_or(f64::INFINITY, |mark| values.time_step_squared.0[lane] / mark.0[lane]),
                motion: 0.0,
                viscosity: 0.0,
                determinant: self.least_determinant(element, positions),
                stored: values.stored.0[lane],
                dissipated: values.dissipated.0[lane],
                hourglass: values.hourglass.0[lane],
                viscous: resisted[0],
                damping: resisted[1],
            }
        };
        let living: Vec<Report> = (0..self.count).filter(|&element| self.is_alive(element)).map(of_element).collect();
        Report::joined(living.iter().copied().chain([self.eroded.left]))
    }
}
