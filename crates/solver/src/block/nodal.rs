//! Averaged nodal pressure: the driver of elements with one point whose dilatation is averaged over the nodes
//! of the block and back (`tri3_anp`).
//!
//! The parts of the kernel are those of any element; between them the block goes through its nodes twice.
//! Rate laws: θ_n = Σ_e V_e θ_e / Σ_e V_e over the elements of a node, θ̄_e the mean of its nodes.
//! Hyperelastic laws: J_n = Σ_e V_e / Σ_e V_e⁰ in the same way. The pressure in the forces is averaged by the
//! same two means, weighted with V (V⁰): Σ_e V_e p_e θ̄_e = Σ_e V_e p̄_e θ_e, so what the nodes spend is what
//! the elements store. Sums run in the order of the elements. Source: Bonet and Burton, Commun. Numer. Meth.
//! Engng 14 (1998) 437-449.

use super::damping::Damp;
use super::forces::{Forces, Sums};
use super::kernel::Facts;
use super::store::{CHUNK, ElementStore, chunk};
use super::strain::{Measures, Strain, Tensor};
use super::strip::{ForEachBatch, StripBuffers};
use super::{Motion, Report};
use crate::material::Family;
use crate::material::points::{Points, RESPONSE};
use crate::rows::Rows;
use crate::tensor::{Dim, Space, SymmetricTensor};
use embate_lanes::{BATCH, Batch, Chunks, Level, Team, math};

/// Nodes that one task averages.
const NODES: usize = 1024;

/// What the averages need beside the block.
pub(super) struct Nodal<const D: usize> {
    /// Nodes of the block, counted from zero: `corners` per lane.
    cells: Vec<u32>,
    corners: usize,
    /// Elements of each node.
    elements: Rows<u32>,
    /// Room for each chunk.
    strips: Vec<StripBuffers<D>>,
    /// Stresses with the averaged pressure, Pa.
    stress: Vec<Batch>,
    /// By lane: weight, weight times the value, and the value averaged.
    weight: Vec<Batch>,
    moment: Vec<Batch>,
    mean: Vec<Batch>,
    /// Takes the place of `mean` while that of the strains is still needed.
    spare: Vec<Batch>,
    /// By node.
    at_nodes: Vec<f64>,
}

impl<const D: usize> Nodal<D> {
    /// For `count` elements with so many `corners`, in lanes of `batches`; `strip` makes the room of a chunk.
    pub(super) fn new(connectivity: &[u32], corners: usize, components: usize, strip: impl Fn() -> StripBuffers<D>) -> Self {
        let count = connectivity.len() / corners;
        let mut nodes = connectivity.to_vec();
        nodes.sort_unstable();
        nodes.dedup();
        let local = |node: &u32| nodes.binary_search(node).map_or(0, |at| at as u32);
        let mut cells: Vec<u32> = connectivity.iter().map(local).collect();
        let elements = Rows::new(nodes.len(), (0..).zip(&cells).map(|(k, &node)| (node, (k / corners) as u32)));
        let batches = count.div_ceil(BATCH);
        cells.resize(batches * BATCH * corners, 0);
        let scratch = || vec![Batch::default(); batches];
        Self {
            cells,
            corners,
            elements,
            strips: (0..batches.div_ceil(CHUNK)).map(|_| strip()).collect(),
            stress: vec![Batch::default(); batches * components],
            weight: scratch(),
            moment: scratch(),
            mean: scratch(),
            spare: scratch(),
            at_nodes: vec![0.0; nodes.len()],
        }
    }

    /// From weights and moments to the mean over the nodes of each element of the weighted means of the
    /// nodes; a node without weight, all of whose elements are eroded, has `none`.
    fn average(&mut self, none: f64, team: &mut Team) {
        let Self { cells, corners, elements, weight, moment, mean, at_nodes, .. } = self;
        let (weight, moment) = (&*weight, &*moment);
        team.each(Chunks::new(at_nodes, NODES), |index, _, values| {
            for (node, value) in (index * NODES..).zip(values) {
                let (mut total, mut sum) = (0.0, 0.0);
                for &element in elements.of(node) {
                    let (batch, lane) = (element as usize / BATCH, element as usize % BATCH);
                    total += weight[batch].0[lane];
                    sum += moment[batch].0[lane];
                }
                *value = if total > 0.0 { sum / total } else { none };
            }
        });
        let (corners, share, at_nodes) = (*corners, 1.0 / *corners as f64, &*at_nodes);
        team.each(Chunks::new(mean, CHUNK), |index, _, means| {
            for (batch, mean) in (index * CHUNK..).zip(means) {
                for (lane, mean) in mean.0.iter_mut().enumerate() {
                    let cell = &cells[(batch * BATCH + lane) * corners..][..corners];
                    *mean = cell.iter().map(|&node| at_nodes[node as usize]).sum::<f64>() * share;
                }
            }
        });
    }
}

impl<const D: usize> ElementStore<D>
where
    Dim<D>: Space<D>,
{
    /// One step of a block with nodal averages.
    pub(super) fn advance_averaged(
        &mut self,
        nodal: &mut Nodal<D>,
        motion: &Motion<'_, D>,
        level: Level,
        slots: &mut [[f64; D]],
        team: &mut Team,
    ) -> Report {
        let measures = self.measures();
        self.strain_all(nodal, motion, measures, level, team);
        nodal.average(if measures.family == Family::Rate { 0.0 } else { 1.0 }, team);
        let mut means = std::mem::take(&mut nodal.spare);
        std::mem::swap(&mut nodal.mean, &mut means);
        if measures.family == Family::Rate && measures.volume {
            for (batch, (weight, moment)) in nodal.weight.iter_mut().zip(&mut nodal.moment).enumerate() {
                let ratio = &nodal.strips[batch / CHUNK].volume_ratio[batch % CHUNK];
                for lane in 0..BATCH {
                    weight.0[lane] = self.volume_initial[batch].0[lane] * self.elements[batch].live.0[lane];
                    moment.0[lane] = weight.0[lane] * ratio.0[lane];
                }
            }
            nodal.average(1.0, team);
            for (batch, mean) in nodal.mean.iter().enumerate() {
                nodal.strips[batch / CHUNK].volume_ratio[batch % CHUNK] = *mean;
            }
        }
        self.respond_all(nodal, &means, motion.time_step, measures.family, level, team);
        nodal.spare = means;
        nodal.average(0.0, team);
        self.force_all(nodal, motion.time_step, measures.family, level, slots, team)
    }

    /// Strains without averages; the volumes and dilatations (volume ratios) of the elements.
    fn strain_all(&mut self, nodal: &mut Nodal<D>, motion: &Motion<'_, D>, measures: Measures, level: Level, team: &mut Team) {
        let (kernel, components) = (self.kernel.as_ref(), self.facts().components);
        let [.., initial, _] = self.widths();
        let (nodes, volume_initial, elements, all_initial) = (&self.nodes, &self.volume_initial, &self.elements, &self.initial);
        let (resists, resistance) = (self.resists(), &self.resistance);
        let parts = (
            Chunks::new(&mut self.stress, CHUNK * components),
            Chunks::new(&mut nodal.strips, 1),
            Chunks::new(&mut nodal.weight, CHUNK),
            Chunks::new(&mut nodal.moment, CHUNK),
        );
        let (eroded, weights) = (&self.eroded, &self.weights[..]);
        team.each(parts, |index, _, (stress, strips, weight, moment)| {
            if eroded.is_gone(index) {
                weight.fill(Batch::default());
                moment.fill(Batch::default());
                return;
            }
            let strip = &mut strips[0];
            let (first, last) = (index * CHUNK, index * CHUNK + weight.len());
            nodes.copy(index, motion, &mut strip.moving);
            strip.motion = Batch::default();
            let strain = Strain {
                time_step: motion.time_step,
                measures,
                first,
                places: &nodes.places,
                batches: weight.len(),
                resistance: if resists { &resistance[first..last] } else { &[] },
                volume_initial: &volume_initial[first..last],
                initial: &all_initial[first * initial..last * initial],
                stress,
                hourglass: &mut [],
                weights: weights.get(first..last).unwrap_or_default(),
                strip,
                prefetches: false,
            };
            kernel.strain(level, strain);
            for batch in 0..weight.len() {
                for lane in 0..BATCH {
                    let value = match measures.family {
                        Family::Rate => Tensor::<D, f64>::load(&strip.strain[batch * components..][..components], lane).trace(),
                        Family::Hyperelastic => strip.volume_ratio[batch].0[lane],
                    };
                    weight[batch].0[lane] = strip.volume[batch].0[lane] * elements[first + batch].live.0[lane];
                    moment[batch].0[lane] = weight[batch].0[lane] * value;
                }
            }
        });
    }

    /// Stresses from the averaged strains; their pressures, to be averaged.
    fn respond_all(&mut self, nodal: &mut Nodal<D>, means: &[Batch], time_step: f64, family: Family, level: Level, team: &mut Team) {
        let (kernel, width) = (self.kernel.as_ref(), self.law.state_width());
        let Facts { points, components, state, .. } = *kernel.facts();
        let (law, damping, thickness) = (self.law.as_ref(), self.damping, self.law.thickness().unwrap_or(0));
        let (damped_chunk, resistance) = (chunk(self.damped_width()), chunk(self.resistance_width()));
        // A law without history has one batch per chunk, which stands for nothing.
        let history = chunk(width);
        let parts = (
            Chunks::new(&mut self.stress, CHUNK * components),
            Chunks::new(&mut self.history, history),
            Chunks::new(&mut nodal.strips, 1),
            Chunks::new(&mut nodal.weight, CHUNK),
            Chunks::new(&mut nodal.moment, CHUNK),
            Chunks::new(&mut self.damped, damped_chunk),
            Chunks::new(&mut self.resistance, resistance),
        );
        let (all_elements, eroded) = (&self.elements, &self.eroded);
        team.each(parts, |index, _, (stress, history, strips, weight, moment, damped, resistance)| {
            // It has no weight already.
            if eroded.is_gone(index) {
                return;
            }
            let (strip, elements) = (&mut strips[0], &all_elements[index * CHUNK..][..weight.len()]);
            let (first, count) = (index * CHUNK, weight.len());
            for batch in 0..count {
                for lane in 0..BATCH {
                    impose::<D>(strip, batch, lane, means[first + batch].0[lane], family);
                }
            }
            law.respond(
                level,
                Points {
                    time_step,
                    strain: &strip.strain[..count * components],
                    rotation: &strip.rotation,
                    volume_ratio: &strip.volume_ratio[..count],
                    viscous_heat: &strip.viscous_heat[..count],
                    stress,
                    state: &mut history[..count * width],
                    response: &mut strip.response[..count * RESPONSE],
                    scratch: &mut strip.law,
                },
            );
            if damping > 0.0 {
                level.run(ForEachBatch(Damp {
                    points,
                    state,
                    damping,
                    time_step,
                    strip,
                    history: &history[..count * width],
                    history_width: width,
                    thickness,
                    stress: damped,
                    elements,
                    resistance,
                }));
            }
            match family {
                Family::Rate => kernel.volumes(strip, weight),
                Family::Hyperelastic => weight.copy_from_slice(&strip.volume[..count]),
            }
            for batch in 0..count {
                for lane in 0..BATCH {
                    let mut pressure = Tensor::<D, f64>::load(&stress[batch * components..][..components], lane).trace() / 3.0;
                    if damping > 0.0 {
                        pressure += Tensor::<D, f64>::load(&damped[batch * components..][..components], lane).trace() / 3.0;
                    }
                    weight[batch].0[lane] *= elements[batch].live.0[lane];
                    moment[batch].0[lane] = weight[batch].0[lane] * pressure;
                }
            }
        });
    }

    /// Forces from the stresses with averaged pressures.
    fn force_all(
        &mut self,
        nodal: &mut Nodal<D>,
        time_step: f64,
        family: Family,
        level: Level,
        slots: &mut [[f64; D]],
        team: &mut Team,
    ) -> Report {
        let (width, thickness) = (self.law.state_width(), self.law.thickness().unwrap_or(0));
        let kernel = self.kernel.as_ref();
        let Facts { components, weight: of_point, .. } = *kernel.facts();
        let (viscosity, all_stress, all_history) = (self.viscosity, &self.stress, &self.history);
        let (damping, all_damped) = (self.damping, &self.damped);
        let (is_elastic, least_sheet_modulus) = (self.law.is_elastic(), self.law.least_sheet_modulus());
        let (means, places) = (&nodal.mean, &self.nodes.places);
        let (keeps_forces, kept) = (self.keeps_forces, chunk(self.kept_width()));
        let (resists, resistance) = (self.resists(), chunk(self.resistance_width()));
        let (slots_of_chunk, eroded, marks) = (self.nodes.width(), &self.eroded, &self.marks[..]);
        let parts = (
            Chunks::new(&mut self.elements, CHUNK),
            Chunks::new(&mut nodal.stress, CHUNK * components),
            Chunks::new(&mut nodal.strips, 1),
            Chunks::new(slots, slots_of_chunk),
            Chunks::new(&mut self.kept, kept),
            Chunks::new(&mut self.resistance, resistance),
            Chunks::new(&mut self.reports, 1),
        );
        team.each(parts, |index, _, (elements, stress, strips, pulls, kept, resistance, report)| {
            if eroded.is_gone(index) {
                pulls.fill([0.0; D]);
                report.fill(Report::NOTHING);
                return;
            }
            let strip = &mut strips[0];
            let (first, count) = (index * CHUNK, elements.len());
            stress.copy_from_slice(&all_stress[first * components..(first + count) * components]);
            for batch in 0..count {
                for lane in 0..BATCH {
                    let own = &mut stress[batch * components..(batch + 1) * components];
                    let mut pressure = means[first + batch].0[lane];
                    if family == Family::Hyperelastic {
                        // The weight J̄/J belongs to the deviator alone.
                        pressure = pressure * of_point / strip.weight[batch].0[lane];
                    }
                    let mut unaveraged = Tensor::<D, f64>::load(own, lane);
                    if damping > 0.0 {
                        let at = (first + batch) * components;
                        unaveraged = unaveraged.plus(Tensor::<D, f64>::load(&all_damped[at..at + components], lane));
                    }
                    unaveraged.plus(Tensor::<D, f64>::isotropic(pressure - unaveraged.trace() / 3.0)).store(own, lane);
                }
            }
            let mut sums = Sums::new();
            strip.pulls.clear(slots_of_chunk);
            let forces = Forces {
                family,
                is_solid: true,
                is_elastic,
                least_sheet_modulus,
                time_step,
                viscosity,
                damping,
                damped: &[],
                stress,
                history: if width == 0 { &[] } else { &all_history[first * width..(first + count) * width] },
                history_width: width,
                thickness,
                initial: &[],
                hourglass: &mut [],
                strip: &mut *strip,
                elements,
                resistance: if resists { resistance } else { &mut [] },
                places,
                first,
                kept: if keeps_forces { kept } else { &mut [] },
                marks: marks.get(first..first + count).unwrap_or_default(),
                sums: &mut sums,
                prefetches: false,
            };
            kernel.forces(level, forces);
            strip.pulls.copy_to(pulls);
            report.fill(sums.report(strip));
        });
        Report::joined(self.reports.iter().copied().chain([self.eroded.left]))
    }
}

/// Gives an element its averaged dilatation θ̄ or volume ratio J̄ (F̄ = (J̄/J)^{1/3} F).
fn impose<const D: usize>(strip: &mut StripBuffers<D>, batch: usize, lane: usize, mean: f64, family: Family)
where
    Dim<D>: Space<D>,
{
    let components = <Tensor<D, f64> as SymmetricTensor<f64>>::COMPONENTS;
    let strain = &mut strip.strain[batch * components..(batch + 1) * components];
    let own = Tensor::<D, f64>::load(strain, lane);
    match family {
        Family::Rate => own.plus(Tensor::<D, f64>::isotropic((mean - own.trace()) / 3.0)).store(strain, lane),
        Family::Hyperelastic => {
            let change = mean / strip.volume_ratio[batch].0[lane];
            let root = math::cbrt(change);
            own.times(root * root).store(strain, lane);
            strip.volume_ratio[batch].0[lane] = mean;
            strip.weight[batch].0[lane] *= change;
        }
    }
}
