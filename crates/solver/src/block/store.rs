//! The elements of a block with their state, in plain batches; erased as [`Block`].
//!
//! Nothing here is compiled for an element or a law: both are asked through [`ElementKernel`] and
//! [`PointLaw`], a strip of elements at a time. A step goes strip by strip: strain, law, forces, so that what
//! passes from one to the next stays in the first-level cache. Strips belong to chunks, which are shared by
//! threads and do not depend on their number.

use super::batch::{ElementBatch, Resistance};
use super::damping::{Damp, bounding_stiffness};
use super::elastic::Elastic;
use super::erosion::Eroded;
use super::forces::{Forces, Sums};
use super::kernel::{ElementGeometry, ElementKernel, Facts};
use super::local::LocalNodes;
use super::make::{BlockInput, LawOf};
use super::nodal::Nodal;
use super::strain::{Measures, Strain};
use super::strip::{ForEachBatch, STRIP, StripBuffers};
use super::subcycles::{Regions, Subcycled, Subcycles};
use super::{Block, ElementState, Initial, Motion, NodalForces, PointValues, Report, Wrong};
use crate::archive::{Archive, ArchiveResult, Persist};
use crate::failure::Criterion;
use crate::material::points::{PointLaw, Points, RESPONSE};
use crate::material::{Family, Parameters};
use crate::stress_state::sheet_modulus;
use crate::tensor::{Dim, Space};
use embate_lanes::{BATCH, Batch, Chunks, Level, Team};
use std::sync::{Mutex, PoisonError};

/// Batches that one task advances: small enough to share, large enough to be worth it; fixed, so that sums do
/// not depend on threads.
pub const CHUNK: usize = 64;

/// Bytes of the state of a block from which on the next strip is prefetched: below, it stays in a cache, and
/// asking for it costs a hundredth of the time.
const BYTES_IN_CACHE: usize = 6 << 20;

/// The elements of a block with their state.
pub(super) struct ElementStore<const D: usize> {
    pub(super) kernel: Box<dyn ElementKernel<D>>,
    pub(super) law: Box<dyn PointLaw>,
    /// Makes laws for its points, and the density of its own, kg/m³.
    pub(super) source: LawOf,
    pub(super) density: f64,
    pub(super) viscosity: Option<[f64; 2]>,
    pub(super) count: usize,
    pub(super) nodes: LocalNodes,
    /// Cauchy stress of the points, Pa.
    pub(super) stress: Vec<Batch>,
    /// Time β of the damping in proportion to the stiffness, s, and its stresses at the points; none: 0, and
    /// no stresses.
    pub(super) damping: f64,
    pub(super) damped: Vec<Batch>,
    /// What the law remembers of the points.
    pub(super) history: Vec<Batch>,
    /// Hyperelastic laws: initial geometry of the points.
    pub(super) initial: Vec<Batch>,
    /// Whether they began strained, as elements that were made again in the run.
    pub(super) is_strained: bool,
    pub(super) elements: Vec<ElementBatch>,
    /// With bulk viscosity or damping in proportion to the stiffness.
    pub(super) resistance: Vec<Resistance>,
    /// What hourglass control remembers.
    pub(super) hourglass: Vec<Batch>,
    /// Forces of the elements in the last step, where they are kept.
    pub(super) kept: Vec<Batch>,
    pub(super) keeps_forces: bool,
    /// Squares of the stable steps when these were marked, s²; empty before.
    pub(super) marks: Vec<Batch>,
    /// What the ways of the nodes of each element around their mean count with, 1/m; empty: nothing.
    pub(super) weights: Vec<Batch>,
    /// Share of each corner in the element's mass: a batch per corner and batch of elements; only until nodes
    /// have their masses.
    pub(super) corner_mass: Vec<Batch>,
    /// Initial volume of each element, one batch per batch of elements.
    pub(super) volume_initial: Vec<Batch>,
    pub(super) reports: Vec<Report>,
    /// Room for each thread.
    strips: Vec<Mutex<StripBuffers<D>>>,
    /// Averages over the nodes, for elements that want them.
    pub(super) nodal: Option<Box<Nodal<D>>>,
    /// With subcycling.
    pub(super) subcycles: Option<Box<Subcycles<D>>>,
    pub(super) eroded: Eroded,
}

/// What one task advances.
struct Chunk<'a, const D: usize> {
    index: usize,
    stress: &'a mut [Batch],
    damped: &'a mut [Batch],
    history: &'a mut [Batch],
    initial: &'a [Batch],
    volume_initial: &'a [Batch],
    elements: &'a mut [ElementBatch],
    resistance: &'a mut [Resistance],
    hourglass: &'a mut [Batch],
    pulls: &'a mut [[f64; D]],
    kept: &'a mut [Batch],
    marks: &'a [Batch],
    weights: &'a [Batch],
}

/// What is the same for all tasks.
struct Common<'a, const D: usize> {
    kernel: &'a dyn ElementKernel<D>,
    law: &'a dyn PointLaw,
    measures: Measures,
    /// See [`ElementStore::widths`].
    widths: [usize; 4],
    history_width: usize,
    thickness: usize,
    viscosity: Option<[f64; 2]>,
    damping: f64,
    keeps_forces: bool,
    resists: bool,
    nodes: &'a LocalNodes,
    motion: &'a Motion<'a, D>,
    subcycles: Option<&'a Subcycles<D>>,
    prefetches: bool,
    level: Level,
}

/// Length of a list with `width` batches per batch of elements: one per chunk where the width is zero, so
/// that it can be cut into chunks all the same.
fn length(batches: usize, width: usize) -> usize {
    if width == 0 { batches.div_ceil(CHUNK) } else { batches * width }
}

/// Length of a chunk of such a list.
pub(super) fn chunk(width: usize) -> usize {
    if width == 0 { 1 } else { CHUNK * width }
}

impl<const D: usize> ElementStore<D>
where
    Dim<D>: Space<D>,
{
    fn empty(source: LawOf, kernel: Box<dyn ElementKernel<D>>, input: &BlockInput<'_, D>) -> Option<Self> {
        let law = source(input.material)?;
        // Every law has a density, and reads it the same way.
        let density = Parameters::new(&[], &input.material.parameters, &input.material.lists).value("density");
        let (connectivity, damping) = (input.connectivity, input.damping);
        let Facts { nodes, points, components, hourglass, averages_at_nodes, .. } = *kernel.facts();
        let count = connectivity.len() / nodes;
        let batches = count.div_ceil(BATCH);
        let scratch = |width: usize| vec![Batch::default(); length(batches, width)];
        let of_task = |batches: usize| StripBuffers::new(kernel.facts(), law.as_ref(), damping > 0.0, batches);
        let nodal = averages_at_nodes.then(|| Box::new(Nodal::new(connectivity, nodes, components, || of_task(CHUNK))));
        let mut block = Self {
            strips: vec![Mutex::new(of_task(STRIP))],
            viscosity: input.viscosity,
            damping,
            damped: scratch(if damping > 0.0 { points * components } else { 0 }),
            count,
            nodes: LocalNodes::new(connectivity, nodes),
            stress: scratch(points * components),
            history: scratch(points * law.state_width()),
            initial: Vec::new(),
            is_strained: false,
            elements: vec![ElementBatch::default(); batches],
            resistance: Vec::new(),
            hourglass: scratch(hourglass),
            kept: scratch(0),
            keeps_forces: false,
            marks: Vec::new(),
            weights: Vec::new(),
            corner_mass: vec![Batch::default(); batches * nodes],
            volume_initial: vec![Batch::default(); batches],
            reports: vec![Report::NOTHING; batches.div_ceil(CHUNK)],
            nodal,
            subcycles: None,
            kernel,
            law,
            source,
            density,
            eroded: Eroded::default(),
        };
        block.resistance = vec![Resistance::default(); length(batches, block.resistance_width())];
        block.initial = vec![Batch::default(); batches * block.widths()[2]];
        for point in block.history.chunks_exact_mut(block.law.state_width().max(1)).take(batches * points) {
            if block.law.state_width() > 0 {
                block.law.start(point);
            }
        }
        Some(block)
    }

    /// From what [`super::make`] was given; `None` when the law is unknown.
    pub(super) fn new(source: LawOf, kernel: Box<dyn ElementKernel<D>>, input: &BlockInput<'_, D>) -> Option<Self> {
        let mut block = Self::empty(source, kernel, input)?;
        let density = block.density;
        let (mut corners, mut geometry) = (Vec::new(), ElementGeometry::default());
        for batch in 0..block.elements.len() {
            for lane in 0..BATCH {
                block.corners(batch, lane, input.positions, &mut corners);
                block.kernel.geometry(&corners, &mut geometry);
                block.set_up(batch, lane, density, &geometry);
            }
        }
        Some(block)
    }

    /// The element by numbers.
    pub(super) fn facts(&self) -> &Facts {
        self.kernel.facts()
    }

    /// Widths of a batch in stress, history, initial geometry and hourglass memory.
    pub(super) fn widths(&self) -> [usize; 4] {
        let Facts { points, components, initial, hourglass, .. } = *self.facts();
        let initial = if self.law.family() == Family::Hyperelastic { points * initial } else { 0 };
        [points * components, points * self.law.state_width(), initial, hourglass]
    }

    /// Whether there is bulk viscosity or damping in proportion to the stiffness.
    pub(super) fn resists(&self) -> bool {
        self.viscosity.is_some() || self.damping > 0.0
    }

    /// Width of a batch in what these remember.
    pub(super) fn resistance_width(&self) -> usize {
        usize::from(self.resists())
    }

    /// Width of a batch in the forces that are kept.
    pub(super) fn kept_width(&self) -> usize {
        if self.keeps_forces { self.facts().nodes * D } else { 0 }
    }

    /// Bytes of what a step reads and writes of the elements.
    fn bytes(&self) -> usize {
        let lists = size_of_val(&self.stress[..]) + size_of_val(&self.history[..]) + size_of_val(&self.hourglass[..]);
        lists + size_of_val(&self.initial[..]) + size_of_val(&self.elements[..]) + size_of_val(&self.resistance[..])
    }

    /// Width of a batch in the stresses of the damping.
    pub(super) fn damped_width(&self) -> usize {
        if self.damping > 0.0 { self.widths()[0] } else { 0 }
    }

    /// What all chunks report together.
    pub(super) fn joined_reports(&self) -> Report {
        match &self.subcycles {
            Some(subcycles) => subcycles.joined(&self.reports, self.eroded.left),
            None => Report::joined(self.reports.iter().copied().chain([self.eroded.left])),
        }
    }

    /// What the law wants to know, and the damping.
    pub(super) fn measures(&self) -> Measures {
        let law = self.law.as_ref();
        Measures { family: law.family(), rotation: law.needs_rotation() || self.damping > 0.0, volume: law.needs_volume() }
    }

    /// The nodes of a lane: of an element, or of the live one that it is a copy of.
    pub(super) fn nodes_of(&self, batch: usize, lane: usize) -> impl Iterator<Item = usize> + Clone {
        let nodes = self.facts().nodes;
        (0..nodes).map(move |a| self.nodes.node(batch * nodes + a, lane, nodes))
    }

    /// The positions of an element's nodes, from those of all.
    pub(super) fn corners(&self, batch: usize, lane: usize, positions: &[[f64; D]], corners: &mut Vec<[f64; D]>) {
        corners.clear();
        corners.extend(self.nodes_of(batch, lane).map(|node| positions[node]));
    }

    /// Initial geometry and masses of one lane.
    fn set_up(&mut self, batch: usize, lane: usize, density: f64, geometry: &ElementGeometry<D>) {
        let (nodes, [.., initial, _]) = (self.facts().nodes, self.widths());
        let own = &mut self.initial[batch * initial..][..initial];
        own.iter_mut().zip(&geometry.initial).for_each(|(batch, &value)| batch.0[lane] = value);
        for (a, corner) in geometry.corner_volumes.iter().enumerate() {
            self.corner_mass[batch * nodes + a].0[lane] = density * corner;
        }
        // Mass of an element whose nodes have their shares of it, and none of them more than it has here.
        let wholes = geometry.corner_volumes.iter().zip(self.facts().mass_ratios).map(|(corner, ratio)| density * corner * ratio);
        let least = wholes.fold(f64::INFINITY, f64::min);
        let volume = geometry.volumes.iter().fold(0.0, |sum, volume| sum + volume);
        let values = &mut self.elements[batch];
        values.mass_least.0[lane] = least;
        values.live.0[lane] = if batch * BATCH + lane < self.count { 1.0 } else { 0.0 };
        values.stored.0[lane] = self.law.stored() * volume;
        if self.resists() {
            self.resistance[batch].volume.0[lane] = volume;
            self.resistance[batch].mass.0[lane] = density * volume;
        }
        self.volume_initial[batch].0[lane] = volume;
    }

    /// Advances a chunk, strip by strip.
    fn advance_chunk(common: &Common<'_, D>, chunk: Chunk<'_, D>, strip: &mut StripBuffers<D>) -> Report {
        let Common { measures, history_width, level, .. } = *common;
        let Facts { nodes, points: of_element, components, state, .. } = *common.kernel.facts();
        let [stress_width, history_of_batch, initial_of_batch, hourglass] = common.widths;
        let mut sums = Sums::new();
        let count = chunk.elements.len();
        let interval = common.subcycles.and_then(|subcycles| Some((subcycles, subcycles.time(chunk.index)?)));
        let time_step = interval.map_or(common.motion.time_step, |(_, time)| time);
        match interval {
            Some((subcycles, time)) => subcycles.copy((chunk.index, time), common.nodes, common.motion, &mut strip.moving),
            None => common.nodes.copy(chunk.index, common.motion, &mut strip.moving),
        }
        strip.pulls.clear(common.nodes.width());
        strip.motion = Batch::default();
        for from in (0..count).step_by(STRIP) {
            let to = (from + STRIP).min(count);
            let points = (to - from) * of_element;
            let stress = &mut chunk.stress[from * stress_width..to * stress_width];
            let history = &mut chunk.history[from * history_of_batch..to * history_of_batch];
            let elements = &mut chunk.elements[from..to];
            let resistance = if common.resists { &mut chunk.resistance[from..to] } else { &mut [][..] };
            let strain = Strain {
                time_step,
                measures,
                first: chunk.index * CHUNK + from,
                places: &common.nodes.places,
                batches: to - from,
                resistance,
                volume_initial: &chunk.volume_initial[from..to],
                initial: &chunk.initial[from * initial_of_batch..to * initial_of_batch],
                stress,
                hourglass: &mut chunk.hourglass[from * hourglass..to * hourglass],
                weights: chunk.weights.get(from..to).unwrap_or_default(),
                strip,
                prefetches: common.prefetches,
            };
            common.kernel.strain(level, strain);
            common.law.respond(
                level,
                Points {
                    time_step,
                    strain: &strip.strain[..points * components],
                    rotation: &strip.rotation,
                    volume_ratio: &strip.volume_ratio[..points],
                    viscous_heat: &strip.viscous_heat[..points],
                    stress,
                    state: history,
                    response: &mut strip.response[..points * RESPONSE],
                    scratch: &mut strip.law,
                },
            );
            // Without damping there is one batch, which stands for nothing.
            let damped = if common.damping > 0.0 { &mut chunk.damped[from * stress_width..to * stress_width] } else { &mut [][..] };
            if common.damping > 0.0 {
                level.run(ForEachBatch(Damp {
                    points: of_element,
                    state,
                    damping: common.damping,
                    time_step,
                    strip,
                    history,
                    history_width,
                    thickness: common.thickness,
                    stress: damped,
                    elements,
                    resistance,
                }));
            }
            let forces = Forces {
                family: measures.family,
                is_solid: common.law.stiffness()[1] > 0.0,
                is_elastic: common.law.is_elastic(),
                least_sheet_modulus: common.law.least_sheet_modulus(),
                time_step,
                viscosity: common.viscosity,
                damping: common.damping,
                damped,
                stress,
                history,
                history_width,
                thickness: common.thickness,
                initial: &chunk.initial[from * initial_of_batch..to * initial_of_batch],
                hourglass: &mut chunk.hourglass[from * hourglass..to * hourglass],
                strip,
                elements,
                resistance,
                places: &common.nodes.places,
                first: chunk.index * CHUNK + from,
                kept: if common.keeps_forces { &mut chunk.kept[from * nodes * D..to * nodes * D] } else { &mut [] },
                marks: chunk.marks.get(from..to).unwrap_or_default(),
                sums: &mut sums,
                prefetches: common.prefetches,
            };
            common.kernel.forces(level, forces);
        }
        strip.pulls.copy_to(chunk.pulls);
        sums.report(strip)
    }
}

impl<const D: usize> Block<D> for ElementStore<D>
where
    Dim<D>: Space<D>,
{
    fn elements(&self) -> usize {
        self.count
    }

    fn slots(&self) -> &[u32] {
        self.nodes.slots()
    }

    fn advance(
        &mut self,
        motion: &Motion<'_, D>,
        level: Level,
        NodalForces { forces: slots, .. }: NodalForces<'_, D>,
        team: &mut Team,
    ) -> Report {
        if let Some(mut nodal) = self.nodal.take() {
            let report = self.advance_averaged(&mut nodal, motion, level, slots, team);
            self.nodal = Some(nodal);
            return report;
        }
        if let Some(subcycles) = &mut self.subcycles {
            subcycles.pass(motion, &self.nodes, slots, team);
        }
        while self.strips.len() < team.threads() {
            self.strips.push(Mutex::new(StripBuffers::new(self.kernel.facts(), self.law.as_ref(), self.damping > 0.0, STRIP)));
        }
        let (widths, damped_width) = (self.widths(), self.damped_width());
        let (kept_width, resistance_width) = (self.kept_width(), self.resistance_width());
        let law = self.law.as_ref();
        let common = Common {
            kernel: self.kernel.as_ref(),
            law,
            measures: self.measures(),
            widths,
            history_width: law.state_width(),
            thickness: law.thickness().unwrap_or(0),
            viscosity: self.viscosity,
            damping: self.damping,
            keeps_forces: self.keeps_forces,
            resists: self.resists(),
            nodes: &self.nodes,
            motion,
            subcycles: self.subcycles.as_deref(),
            prefetches: self.bytes() > BYTES_IN_CACHE,
            level,
        };
        let (initial, volume_initial, strips) = (&self.initial[..], &self.volume_initial[..], &self.strips[..]);
        let (eroded, width, marks, weights) = (&self.eroded, self.nodes.width(), &self.marks[..], &self.weights[..]);
        let [stress, history, _, hourglass] = widths.map(chunk);
        let parts = (
            Chunks::new(&mut self.stress, stress),
            Chunks::new(&mut self.history, history),
            Chunks::new(&mut self.elements, CHUNK),
            Chunks::new(&mut self.hourglass, hourglass),
            Chunks::new(slots, width),
            Chunks::new(&mut self.kept, chunk(kept_width)),
            Chunks::new(&mut self.damped, chunk(damped_width)),
            Chunks::new(&mut self.resistance, chunk(resistance_width)),
            Chunks::new(&mut self.reports, 1),
        );
        team.each(parts, |index, member, (stress, history, elements, hourglass, pulls, kept, damped, resistance, report)| {
            if eroded.is_gone(index) {
                pulls.fill([0.0; D]);
                report.fill(Report::NOTHING);
                return;
            }
            if common.subcycles.is_some_and(|subcycles| !subcycles.is_due(index, motion.turn)) {
                return;
            }
            let first = index * CHUNK;
            let last = first + elements.len();
            let mut strip = strips[member].lock().unwrap_or_else(PoisonError::into_inner);
            let (initial, volume_initial) = (&initial[first * widths[2]..last * widths[2]], &volume_initial[first..last]);
            let chunk = Chunk {
                index,
                stress,
                damped,
                history,
                initial,
                volume_initial,
                elements,
                resistance,
                hourglass,
                pulls,
                kept,
                marks: marks.get(first..last).unwrap_or_default(),
                weights: weights.get(first..last).unwrap_or_default(),
            };
            report.fill(Self::advance_chunk(&common, chunk, &mut strip));
        });
        self.joined_reports()
    }

    fn bound_stiffness(&self, shortest: f64, add: &mut dyn FnMut(u32, f64, f64)) {
        let Facts { mass_ratios, damps, .. } = *self.facts();
        let is_damped = self.resists() || damps;
        for element in (0..self.count).filter(|&element| self.is_alive(element)) {
            let (batch, lane) = (element / BATCH, element % BATCH);
            let values = &self.elements[batch];
            let (mass, squared) = (values.mass_least.0[lane], values.time_step_squared.0[lane]);
            for (node, ratio) in self.nodes_of(batch, lane).zip(mass_ratios) {
                let mass = mass / ratio;
                add(node as u32, bounding_stiffness(mass, squared, shortest, is_damped), mass);
            }
        }
    }

    fn mark_time_steps(&mut self) {
        self.marks.clear();
        self.marks.extend(self.elements.iter().map(|values| values.time_step_squared));
    }

    fn elastic(&self) -> Option<&dyn Elastic<D>> {
        self.law.is_stiffest_at_rest().then_some(self)
    }

    fn regions(&self) -> Option<&dyn Regions> {
        self.nodal.is_none().then_some(self)
    }

    fn start_subcycling(&mut self) {
        if self.nodal.is_none() {
            self.remember_intervals();
        }
    }

    fn subcycled(&mut self) -> Option<&mut dyn Subcycled<D>> {
        self.subcycles.is_some().then_some(self)
    }

    fn step_ratio(&self, element: usize) -> u32 {
        self.subcycles.as_ref().map_or(1, |subcycles| subcycles.ratio(element / (CHUNK * BATCH)))
    }

    fn weigh_motion(&mut self, weight: &dyn Fn(usize) -> f64) {
        let of_lane = |lane: usize| self.live_element_of(lane).map_or(0.0, weight);
        let of = |batch: usize| Batch(std::array::from_fn(|lane| of_lane(batch * BATCH + lane)));
        self.weights = (0..self.elements.len()).map(of).collect();
    }

    fn mass(&self, element: usize) -> f64 {
        (0..self.facts().nodes).map(|corner| self.corner_mass(element, corner)).sum()
    }

    fn corner_mass(&self, element: usize, corner: usize) -> f64 {
        self.corner_mass.get(element / BATCH * self.facts().nodes + corner).map_or(f64::NAN, |batch| batch.0[element % BATCH])
    }

    fn release_corner_masses(&mut self) {
        self.corner_mass = Vec::new();
    }

    fn time_step_squared(&self, element: usize) -> f64 {
        self.elements[element / BATCH].time_step_squared.0[element % BATCH]
    }

    fn state(&self, element: usize) -> ElementState {
        if let Some(last) = self.eroded.last.get(&element) {
            return *last;
        }
        let (batch, lane) = (element / BATCH, element % BATCH);
        let (width, Facts { points, components, .. }) = (self.law.state_width(), *self.facts());
        let mean = |values: &[Batch], width: usize, value: usize| {
            (0..points).map(|p| values[(batch * points + p) * width + value].0[lane]).sum::<f64>() / points as f64
        };
        let mut state = ElementState::default();
        for c in 0..components {
            state.stress[c] = mean(&self.stress, components, c);
        }
        for (value, variable) in state.variables.iter_mut().zip(self.law.variables()) {
            *value = mean(&self.history, width, variable.place);
        }
        state.energy_density = self.elements[batch].stored.0[lane] / self.volume_initial[batch].0[lane];
        state
    }

    fn law(&self) -> Option<&dyn PointLaw> {
        Some(self.law.as_ref())
    }

    fn wave_modulus(&self) -> f64 {
        let [bulk, shear] = self.law.stiffness();
        let waves = bulk + 4.0 / 3.0 * shear;
        if self.facts().state.of::<D>().is_plane_stress {
            sheet_modulus(bulk, shear).max(self.law.least_sheet_modulus()).min(waves)
        } else {
            waves
        }
    }

    fn shear_modulus(&self) -> f64 {
        let [bulk, shear] = self.law.stiffness();
        if self.facts().state.of::<D>().is_plane_stress { shear } else { 0.75 * (self.wave_modulus() - bulk) }
    }

    fn scale_mass(&mut self, element: usize, factor: f64) {
        self.scale_corner_masses(element, factor);
    }

    fn mass_for(&self, squared: [f64; 2], may: &dyn Fn(u32) -> bool) -> f64 {
        self.needed_mass(squared, may)
    }

    fn make_heavier(&mut self, squared: [f64; 2], may: &dyn Fn(u32) -> bool, add: &mut dyn FnMut(u32, f64)) -> Option<f64> {
        self.add_mass(squared, may, add).then(|| self.joined_reports().time_step_squared)
    }

    fn point_values(&self, positions: &[[f64; D]]) -> Option<PointValues> {
        self.values_of_points(positions)
    }

    fn elastic_energy(&self, positions: &[[f64; D]]) -> f64 {
        self.energy_of_stresses(positions)
    }

    fn take_point_values(&mut self, values: &PointValues, before: &Report, positions: &[[f64; D]]) {
        self.fill_points(values, before, positions);
    }

    fn scale_density(&mut self, element: usize, factor: f64) {
        self.scale_densities(element, factor);
    }

    fn begin(&mut self, initial: &Initial<'_>, positions: &[[f64; D]]) -> Result<(), Wrong> {
        self.take_over(initial, positions)
    }

    fn is_alive(&self, element: usize) -> bool {
        self.elements[element / BATCH].live.0[element % BATCH] > 0.0
    }

    fn failed(&self, criteria: &[Criterion], parallel: bool) -> Vec<(u32, u32)> {
        self.failing(criteria, parallel)
    }

    fn determinant(&self, element: usize, positions: &[[f64; D]]) -> f64 {
        self.least_determinant(element, positions)
    }

    fn keep_forces(&mut self) {
        self.keeps_forces = true;
        self.kept = vec![Batch::default(); self.elements.len() * self.facts().nodes * D];
    }

    fn force(&self, element: usize, corner: usize, _slots: &[[f64; D]]) -> [f64; D] {
        let at = (element / BATCH * self.facts().nodes + corner) * D;
        std::array::from_fn(|d| self.kept.get(at + d).map_or(0.0, |batch| batch.0[element % BATCH]))
    }

    fn erode(&mut self, elements: &[u32], NodalForces { forces: slots, .. }: NodalForces<'_, D>) -> Vec<f64> {
        self.take_out(elements, slots)
    }

    fn report(&self, positions: &[[f64; D]]) -> Report {
        self.of_the_living(positions)
    }

    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        // Of the model, or worked out again in each step.
        #[rustfmt::skip]
        let Self {
            kernel: _, law: _, source: _, density: _, viscosity: _, damping: _, count: _, nodes: _, kept: _, keeps_forces: _, corner_mass: _,
            strips: _, nodal: _,
            initial, is_strained, volume_initial, reports, marks, weights, stress, damped, history, elements, resistance, hourglass, subcycles, eroded,
        } = self;
        for list in [stress, damped, history, hourglass] {
            list[..].persist(archive)?;
        }
        // There, or not, before anything is read.
        for list in [marks, weights] {
            if !list.is_empty() {
                list[..].persist(archive)?;
            }
        }
        is_strained.persist(archive)?;
        if *is_strained {
            initial[..].persist(archive)?;
            volume_initial[..].persist(archive)?;
        }
        elements[..].persist(archive)?;
        resistance[..].persist(archive)?;
        if let Some(subcycles) = subcycles {
            subcycles.persist(archive)?;
            reports[..].persist(archive)?;
        }
        eroded.persist(archive)?;
        if archive.reads() { self.fill_all_up() } else { Ok(()) }
    }
}
