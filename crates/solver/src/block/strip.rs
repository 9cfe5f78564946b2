//! What goes from one part of the kernel to the next: a few batches of elements at a time, so that it stays
//! in the first-level cache.
//!
//! The motion is gathered and strained ([`super::strain`]), the law answers ([`crate::material::points`]),
//! the forces follow ([`super::forces`]).

use super::kernel::Facts;
use crate::material::points::{PointLaw, RESPONSE, Scratch};
use embate_lanes::{BATCH, Batch, Kernel, Lane, Moving, VectorSums, prefetch_ahead};

/// Batches of elements in a strip.
pub(super) const STRIP: usize = 8;

/// The room of one task. All lists but the first are in the order of batches, then points.
#[derive(Debug, Default)]
pub(super) struct StripBuffers<const D: usize> {
    /// Positions and velocities of the nodes of a chunk.
    pub(super) moving: Moving<D>,
    /// Forces on them.
    pub(super) pulls: VectorSums<D>,
    /// Largest weighted way of the nodes of an element around their mean.
    pub(super) motion: Batch,
    /// Positions of the nodes of each element in natural parts ([`crate::element::Element::natural`]): parts
    /// × dimensions.
    pub(super) parts: Vec<Batch>,
    /// Changes of the amplitudes of hourglass patterns, in directions of the end of the step.
    pub(super) hourglass_rates: Vec<Batch>,
    /// Strain increment, or b.
    pub(super) strain: Vec<Batch>,
    /// Rotation over the step, for laws and damping that want it.
    pub(super) rotation: Vec<Batch>,
    /// Volume ratio.
    pub(super) volume_ratio: Vec<Batch>,
    /// Heat of the bulk viscosity per initial volume.
    pub(super) viscous_heat: Vec<Batch>,
    /// Rate: volume of the point at mid-step. Hyperelastic: its initial volume.
    pub(super) volume: Vec<Batch>,
    /// Hyperelastic: weight of the point's stress in the forces.
    pub(super) weight: Vec<Batch>,
    /// What the law answered.
    pub(super) response: Vec<Batch>,
    /// Room of the law.
    pub(super) law: Scratch,
}

impl<const D: usize> StripBuffers<D> {
    /// Room for so many batches of elements; `turns`: someone besides the law wants the rotations.
    pub(super) fn new(facts: &Facts, law: &dyn PointLaw, turns: bool, batches: usize) -> Self {
        let scratch = |values: usize| vec![Batch::default(); batches * values];
        let Facts { parts, points, components, turn, hourglass, .. } = *facts;
        Self {
            moving: Moving::default(),
            pulls: VectorSums::default(),
            motion: Batch::default(),
            parts: scratch(parts * D),
            hourglass_rates: scratch(hourglass),
            strain: scratch(points * components),
            rotation: scratch(if law.needs_rotation() || turns { points * turn } else { 0 }),
            volume_ratio: scratch(points),
            viscous_heat: scratch(points),
            volume: scratch(points),
            weight: scratch(points),
            response: scratch(points * RESPONSE),
            law: Scratch::default(),
        }
    }
}

/// Asks the memory for what a batch of the next strip has in a list, which has so many items for each batch.
/// Done batch by batch, since the processor has only some ten to twenty requests under way at a time.
#[inline(always)]
pub(super) fn prefetch_next<T>(list: &[T], batch: usize, width: usize) {
    for own in &list[batch * width..][..width] {
        prefetch_ahead(own, STRIP * width);
    }
}

/// A part of the element kernel: work on batches of elements, as many lanes at a time as the instruction set
/// has.
pub(super) trait Parts {
    /// Batches of elements.
    fn batches(&self) -> usize;
    /// The elements of `batch` in lanes `at..at + WIDTH`.
    fn part<L: Lane>(&mut self, batch: usize, at: usize);
}

/// A part for all its batches.
pub(super) struct ForEachBatch<K>(pub(super) K);

impl<K: Parts> Kernel for ForEachBatch<K> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(mut self) {
        for batch in 0..self.0.batches() {
            for at in (0..BATCH).step_by(L::WIDTH) {
                self.0.part::<L>(batch, at);
            }
        }
    }
}
