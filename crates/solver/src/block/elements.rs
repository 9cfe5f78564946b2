//! The elements of a block with their state; erased as [`Block`].
//!
//! A step goes strip by strip: strain, law, forces, so that what passes from one to the next stays in the first-level cache. Strips belong to chunks, which
//! are shared by threads and do not depend on their number.

use super::batch::{ElementBatch, Resistance, element_of};
use super::damping::Damp;
use super::erosion::Eroded;
use super::forces::{Forces, Sums};
use super::local::LocalNodes;
use super::make::BlockInput;
use super::nodal::Nodal;
use super::strain::{Measures, Strain, Tensor, circumference, initial_width, radius};
use super::stress_state::StressState;
use super::strip::{Every, STRIP, Shape, Strip};
use super::{Block, ElementState, Initial, Motion, Report, Wrong};
use crate::archive::{Archive, Keep, Kept};
use crate::element::{Element, map_of};
use crate::failure::Criterion;
use crate::material::Family;
use crate::material::points::{PointLaw, Points, RESPONSE};
use crate::tensor::{Dim, Space, SymmetricTensor, Turn};
use embate_lanes::{BATCH, Batch, Chunks, Level, Team};
use std::marker::PhantomData;
use std::sync::{Mutex, PoisonError};

/// Batches that one task advances: small enough to share, large enough to be worth it; fixed, so that sums do not depend on threads.
pub const CHUNK: usize = 64;

/// The elements of a block with their state.
pub(super) struct Elements<E, S, const D: usize, const N: usize, const P: usize> {
    pub(super) element: E,
    pub(super) law: Box<dyn PointLaw>,
    pub(super) viscosity: Option<[f64; 2]>,
    pub(super) count: usize,
    pub(super) nodes: LocalNodes,
    /// Cauchy stress of the points, Pa.
    pub(super) stress: Vec<Batch>,
    /// Time β of the damping in proportion to the stiffness, s, and its stresses at the points; none: 0, and no stresses.
    pub(super) damping: f64,
    pub(super) damped: Vec<Batch>,
    /// What the law remembers of the points.
    pub(super) history: Vec<Batch>,
    /// Hyperelastic laws: initial geometry of the points.
    pub(super) initial: Vec<Batch>,
    pub(super) elements: Vec<ElementBatch>,
    /// With bulk viscosity or damping in proportion to the stiffness.
    pub(super) resistance: Vec<Resistance>,
    /// What hourglass control remembers.
    pub(super) hourglass: Vec<Batch>,
    /// Forces of the elements in the last step, where they are kept.
    pub(super) kept: Vec<Batch>,
    pub(super) keeps_forces: bool,
    /// Share of each corner in the element's mass: `N` batches per batch of elements; only until nodes have their masses.
    pub(super) corner_mass: Vec<Batch>,
    /// Initial volume of each element, one batch per batch of elements.
    pub(super) volume_initial: Vec<Batch>,
    pub(super) reports: Vec<Report>,
    /// Room for each thread.
    strips: Vec<Mutex<Strip<D>>>,
    /// Averages over the nodes, for elements that want them.
    nodal: Option<Box<Nodal<D>>>,
    pub(super) eroded: Eroded,
    state: PhantomData<S>,
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
}

/// What is the same for all tasks.
struct Common<'a, E, const D: usize> {
    element: &'a E,
    law: &'a dyn PointLaw,
    measures: Measures,
    history_width: usize,
    thickness: usize,
    viscosity: Option<[f64; 2]>,
    damping: f64,
    keeps_forces: bool,
    resists: bool,
    nodes: &'a LocalNodes,
    motion: &'a Motion<'a, D>,
    level: Level,
}

impl<E: Element<D, N, P>, S: StressState, const D: usize, const N: usize, const P: usize> Elements<E, S, D, N, P>
where
    Dim<D>: Space<D>,
{
    pub(super) const COMPONENTS: usize = <Tensor<D, f64> as SymmetricTensor<f64>>::COMPONENTS;

    fn strip(law: &dyn PointLaw, damping: f64, batches: usize) -> Strip<D> {
        let turn = <<Tensor<D, f64> as SymmetricTensor<f64>>::Rotation as Turn<f64>>::COMPONENTS;
        let shape = Shape { parts: E::PARTS, points: P, components: Self::COMPONENTS, turn, hourglass: E::HOURGLASS };
        Strip::new(&shape, law, damping > 0.0, batches)
    }

    /// Widths of a batch in stress, history, initial geometry and hourglass memory.
    pub(super) fn widths(&self) -> [usize; 4] {
        let initial = if self.law.family() == Family::Hyperelastic { P * initial_width::<E, S, D, N, P>() } else { 0 };
        [P * Self::COMPONENTS, P * self.law.state_width(), initial, E::HOURGLASS]
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
        if self.keeps_forces { N * D } else { 0 }
    }

    /// Width of a batch in the stresses of the damping.
    pub(super) fn damped_width(&self) -> usize {
        if self.damping > 0.0 { P * Self::COMPONENTS } else { 0 }
    }

    /// Initial geometry and masses of one lane.
    fn set_up(&mut self, batch: usize, lane: usize, density: f64, connectivity: &[u32], positions: &[[f64; D]]) {
        let element = element_of(batch, lane, self.count);
        let x: [[f64; D]; N] = std::array::from_fn(|a| positions[connectivity[element * N + a] as usize]);
        let map = map_of::<E, f64, D, N, P>(&x);
        let width = initial_width::<E, S, D, N, P>();
        let (mut volume, mut corner_volumes) = (0.0, [0.0; N]);
        for p in 0..P {
            let determinant = map.determinants[p];
            let shape = E::shape(E::POINTS[p]);
            let point_volume = circumference::<S, f64, D, N>(determinant * E::WEIGHTS[p], &x, &shape);
            volume += point_volume;
            for a in 0..N {
                corner_volumes[a] += point_volume * shape[a];
            }
            if self.law.family() == Family::Hyperelastic {
                let adjugate = map.adjugates[p];
                let initial = &mut self.initial[(batch * P + p) * width..][..width];
                for i in 0..D {
                    for j in 0..D {
                        initial[i * D + j].0[lane] = adjugate[i][j] / determinant;
                    }
                }
                initial[D * D].0[lane] = point_volume;
                if E::WARPED {
                    for i in 0..D {
                        for j in 0..D {
                            initial[D * D + 1 + i * D + j].0[lane] = map.warped[i][j] / determinant;
                        }
                    }
                }
                if S::AXISYMMETRIC {
                    initial[D * D + 1].0[lane] = radius(&x, &shape);
                }
            }
        }
        let corner_volumes = E::corner_volumes(&x, S::AXISYMMETRIC).unwrap_or(corner_volumes);
        for (a, corner) in corner_volumes.into_iter().enumerate() {
            self.corner_mass[batch * N + a].0[lane] = density * corner;
        }
        let least = corner_volumes.into_iter().map(|corner| density * corner).fold(f64::INFINITY, f64::min);
        let values = &mut self.elements[batch];
        values.mass_least.0[lane] = N as f64 * least;
        values.live.0[lane] = if batch * BATCH + lane < self.count { 1.0 } else { 0.0 };
        values.stored.0[lane] = self.law.stored() * volume;
        if self.resists() {
            self.resistance[batch].volume.0[lane] = volume;
            self.resistance[batch].mass.0[lane] = density * volume;
        }
        self.volume_initial[batch].0[lane] = volume;
    }

    /// Advances a chunk, strip by strip.
    fn advance_chunk(common: &Common<'_, E, D>, chunk: Chunk<'_, D>, strip: &mut Strip<D>) -> Report {
        let Common { measures, history_width, level, .. } = *common;
        let (stress_width, history_of_batch) = (P * Self::COMPONENTS, P * history_width);
        let initial_of_batch = if measures.family == Family::Hyperelastic { P * initial_width::<E, S, D, N, P>() } else { 0 };
        let mut sums = Sums::new();
        let count = chunk.elements.len();
        common.nodes.copy(chunk.index, common.motion, &mut strip.moving);
        strip.pulls.clear(common.nodes.width());
        for from in (0..count).step_by(STRIP) {
            let to = (from + STRIP).min(count);
            let points = (to - from) * P;
            let stress = &mut chunk.stress[from * stress_width..to * stress_width];
            let history = &mut chunk.history[from * history_of_batch..to * history_of_batch];
            let elements = &mut chunk.elements[from..to];
            let resistance = if common.resists { &mut chunk.resistance[from..to] } else { &mut [][..] };
            level.run(Every(Strain::<E, S, D, N, P> {
                time_step: common.motion.time_step,
                measures,
                first: chunk.index * CHUNK + from,
                places: &common.nodes.places,
                batches: to - from,
                resistance,
                volume_initial: &chunk.volume_initial[from..to],
                initial: &chunk.initial[from * initial_of_batch..to * initial_of_batch],
                stress,
                hourglass: &mut chunk.hourglass[from * E::HOURGLASS..to * E::HOURGLASS],
                strip,
                kind: PhantomData,
            }));
            common.law.respond(
                level,
                Points {
                    time_step: common.motion.time_step,
                    strain: &strip.strain[..points * Self::COMPONENTS],
                    rotation: &strip.rotation,
                    volume_ratio: &strip.volume_ratio[..points],
                    viscous_heat: &strip.viscous_heat[..points],
                    stress,
                    state: history,
                    response: &mut strip.response[..points * RESPONSE],
                    room: &mut strip.law,
                },
            );
            // Without damping there is one batch, which stands for nothing.
            let damped = if common.damping > 0.0 { &mut chunk.damped[from * stress_width..to * stress_width] } else { &mut [][..] };
            if common.damping > 0.0 {
                level.run(Every(Damp::<E, S, D, N, P> {
                    damping: common.damping,
                    time_step: common.motion.time_step,
                    strip,
                    history,
                    history_width,
                    thickness: common.thickness,
                    stress: damped,
                    elements,
                    resistance,
                    kind: PhantomData,
                }));
            }
            level.run(Every(Forces::<E, S, D, N, P> {
                element: common.element,
                family: measures.family,
                is_solid: common.law.stiffness()[1] > 0.0,
                is_elastic: common.law.is_elastic(),
                time_step: common.motion.time_step,
                viscosity: common.viscosity,
                damping: common.damping,
                damped,
                stress,
                history,
                history_width,
                thickness: common.thickness,
                initial: &chunk.initial[from * initial_of_batch..to * initial_of_batch],
                hourglass: &mut chunk.hourglass[from * E::HOURGLASS..to * E::HOURGLASS],
                strip,
                elements,
                resistance,
                places: &common.nodes.places,
                first: chunk.index * CHUNK + from,
                kept: if common.keeps_forces { &mut chunk.kept[from * N * D..to * N * D] } else { &mut [] },
                sums: &mut sums,
                kind: PhantomData,
            }));
        }
        strip.pulls.copy_to(chunk.pulls);
        sums.report()
    }
}

/// Length of a list with `width` batches per batch of elements: one per chunk where the width is zero, so that it can be cut into chunks all the same.
fn length(batches: usize, width: usize) -> usize {
    if width == 0 { batches.div_ceil(CHUNK) } else { batches * width }
}

/// Length of a chunk of such a list.
pub(super) fn chunk(width: usize) -> usize {
    if width == 0 { 1 } else { CHUNK * width }
}

impl<E: Element<D, N, P>, S: StressState, const N: usize, const P: usize, const D: usize> Elements<E, S, D, N, P>
where
    Dim<D>: Space<D>,
{
    fn empty(law: Box<dyn PointLaw>, element: E, input: &BlockInput<'_, D>) -> Self {
        let (connectivity, damping) = (input.connectivity, input.damping);
        let count = connectivity.len() / N;
        let batches = count.div_ceil(BATCH);
        let room = |width: usize| vec![Batch::default(); length(batches, width)];
        let strips = vec![Mutex::new(Self::strip(law.as_ref(), damping, STRIP))];
        let averages = E::NODAL_DILATATION && !S::PLANE_STRESS;
        let nodal = averages.then(|| Box::new(Nodal::new(connectivity, N, Self::COMPONENTS, || Self::strip(law.as_ref(), damping, CHUNK))));
        let mut block = Self {
            element,
            viscosity: input.viscosity,
            damping,
            damped: room(if damping > 0.0 { P * Self::COMPONENTS } else { 0 }),
            count,
            nodes: LocalNodes::new(connectivity, N),
            stress: room(P * Self::COMPONENTS),
            history: room(P * law.state_width()),
            initial: Vec::new(),
            elements: vec![ElementBatch::default(); batches],
            resistance: Vec::new(),
            hourglass: room(E::HOURGLASS),
            kept: room(0),
            keeps_forces: false,
            corner_mass: vec![Batch::default(); batches * N],
            volume_initial: vec![Batch::default(); batches],
            reports: vec![Report::NOTHING; batches.div_ceil(CHUNK)],
            strips,
            nodal,
            law,
            eroded: Eroded::default(),
            state: PhantomData,
        };
        block.resistance = vec![Resistance::default(); length(batches, block.resistance_width())];
        block.initial = vec![Batch::default(); batches * block.widths()[2]];
        for point in block.history.chunks_exact_mut(block.law.state_width().max(1)).take(batches * P) {
            if block.law.state_width() > 0 {
                block.law.start(point);
            }
        }
        block
    }
}

impl<E: Element<D, N, P>, S: StressState, const D: usize, const N: usize, const P: usize> Elements<E, S, D, N, P>
where
    Dim<D>: Space<D>,
{
    /// From what [`super::make`] was given.
    pub(super) fn new(law: Box<dyn PointLaw>, density: f64, input: &BlockInput<'_, D>) -> Self {
        let mut block = Self::empty(law, E::new(&input.options), input);
        for batch in 0..block.elements.len() {
            for lane in 0..BATCH {
                block.set_up(batch, lane, density, input.connectivity, input.positions);
            }
        }
        block
    }
}

impl<E: Element<D, N, P>, S: StressState, const D: usize, const N: usize, const P: usize> Block<D> for Elements<E, S, D, N, P>
where
    Dim<D>: Space<D>,
{
    fn elements(&self) -> usize {
        self.count
    }

    fn slots(&self) -> &[u32] {
        self.nodes.slots()
    }

    fn advance(&mut self, motion: &Motion<'_, D>, level: Level, slots: &mut [[f64; D]], team: &mut Team) -> Report {
        if let Some(mut nodal) = self.nodal.take() {
            let report = self.advance_averaged(&mut nodal, motion, level, slots, team);
            self.nodal = Some(nodal);
            return report;
        }
        while self.strips.len() < team.threads() {
            self.strips.push(Mutex::new(Self::strip(self.law.as_ref(), self.damping, STRIP)));
        }
        let (widths, damped_width) = (self.widths(), self.damped_width());
        let (kept_width, resistance_width) = (self.kept_width(), self.resistance_width());
        let law = self.law.as_ref();
        let common = Common {
            element: &self.element,
            law,
            measures: Measures { family: law.family(), rotation: law.needs_rotation() || self.damping > 0.0, volume: law.needs_volume() },
            history_width: law.state_width(),
            thickness: law.thickness().unwrap_or(0),
            viscosity: self.viscosity,
            damping: self.damping,
            keeps_forces: self.keeps_forces,
            resists: self.resists(),
            nodes: &self.nodes,
            motion,
            level,
        };
        let (initial, volume_initial, strips) = (&self.initial[..], &self.volume_initial[..], &self.strips[..]);
        let (eroded, width) = (&self.eroded, self.nodes.width());
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
            let first = index * CHUNK;
            let last = first + elements.len();
            let mut strip = strips[member].lock().unwrap_or_else(PoisonError::into_inner);
            let (initial, volume_initial) = (&initial[first * widths[2]..last * widths[2]], &volume_initial[first..last]);
            let chunk = Chunk { index, stress, damped, history, initial, volume_initial, elements, resistance, hourglass, pulls, kept };
            report.fill(Self::advance_chunk(&common, chunk, &mut strip));
        });
        self.reports.iter().fold(self.eroded.left, |sum, &report| sum.join(report))
    }

    fn mass(&self, element: usize) -> f64 {
        (0..N).map(|corner| self.corner_mass(element, corner)).sum()
    }

    fn corner_mass(&self, element: usize, corner: usize) -> f64 {
        self.corner_mass.get(element / BATCH * N + corner).map_or(f64::NAN, |batch| batch.0[element % BATCH])
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
        let width = self.law.state_width();
        let mean = |values: &[Batch], width: usize, value: usize| {
            (0..P).map(|p| values[(batch * P + p) * width + value].0[lane]).sum::<f64>() / P as f64
        };
        let mut state = ElementState::default();
        for c in 0..Self::COMPONENTS {
            state.stress[c] = mean(&self.stress, Self::COMPONENTS, c);
        }
        for &(variable, index) in self.law.variables() {
            state.variables[variable as usize] = mean(&self.history, width, index);
        }
        state.energy_density = self.elements[batch].stored.0[lane] / self.volume_initial[batch].0[lane];
        state
    }

    fn law(&self) -> Option<&dyn PointLaw> {
        Some(self.law.as_ref())
    }

    fn scale_mass(&mut self, element: usize, factor: f64) {
        self.make_heavier(element, factor);
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
        self.kept = vec![Batch::default(); self.elements.len() * N * D];
    }

    fn force(&self, element: usize, corner: usize, _slots: &[[f64; D]]) -> [f64; D] {
        let at = (element / BATCH * N + corner) * D;
        std::array::from_fn(|d| self.kept.get(at + d).map_or(0.0, |batch| batch.0[element % BATCH]))
    }

    fn erode(&mut self, elements: &[u32], slots: &mut [[f64; D]]) -> Vec<f64> {
        self.take_out(elements, slots)
    }

    fn report(&self, positions: &[[f64; D]]) -> Report {
        self.of_the_living(positions)
    }

    fn keep(&mut self, archive: &mut Archive<'_>) -> Kept {
        // Of the model, or worked out anew in each step.
        #[rustfmt::skip]
        let Self {
            element: _, law: _, viscosity: _, damping: _, count: _, nodes: _, initial: _, kept: _, keeps_forces: _, corner_mass: _, volume_initial: _,
            reports: _, strips: _, nodal: _, state: _,
            stress, damped, history, elements, resistance, hourglass, eroded,
        } = self;
        for list in [stress, damped, history, hourglass] {
            list[..].keep(archive)?;
        }
        elements[..].keep(archive)?;
        resistance[..].keep(archive)?;
        eroded.keep(archive)?;
        if archive.reads() { self.fill_all_up() } else { Ok(()) }
    }
}
