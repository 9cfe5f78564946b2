//! Storage of a block: batches of eight elements, each quantity of a batch side by side.

use embate_lanes::{BATCH, Batch};

/// What belongs to a batch of eight elements and does not depend on the law's number of values.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ElementBatch {
    /// Smallest corner mass of each element times its corners: the mass in the stable step, which holds for any later form of the element.
    pub(crate) mass_least: Batch,
    /// Mass of each element without what mass scaling added, kg/m: the density of the bulk viscosity.
    pub(crate) mass: Batch,
    /// 1 for an element, 0 for a lane that only fills the batch up and for an eroded element: both are copies of a live one (`erosion.rs`).
    pub(crate) live: Batch,
    /// Stored elastic energy of each element, J/m.
    pub(crate) stored: Batch,
    /// Dissipated energy of each element, J/m.
    pub(crate) dissipated: Batch,
    /// Square of each element's stable step, s².
    pub(crate) time_step_squared: Batch,
    /// Energy that hourglass control has stored and taken, J/m.
    pub(crate) hourglass: Batch,
    /// Work that damping in proportion to the stiffness has taken, J/m.
    pub(crate) damping: Batch,
    /// Work that the bulk viscosity has taken, J/m.
    pub(crate) viscous: Batch,
    /// The part of it in the last step, J/m.
    pub(crate) viscous_step: Batch,
    /// Pressure of the bulk viscosity, Pa.
    pub(crate) viscous_pressure: Batch,
    /// Volume in the last step, m² (m³); kept only with bulk viscosity.
    pub(crate) volume: Batch,
}

impl ElementBatch {
    /// Makes a lane a copy of lane `source` of the batch `from`, but for whether it is live. Every field is named, so that none can be forgotten.
    pub(crate) fn copy_lane(&mut self, lane: usize, from: &Self, source: usize) {
        let Self {
            mass_least,
            mass,
            live: _,
            stored,
            dissipated,
            time_step_squared,
            hourglass,
            damping,
            viscous,
            viscous_step,
            viscous_pressure,
            volume,
        } = self;
        for (to, from) in [
            (mass_least, &from.mass_least),
            (mass, &from.mass),
            (stored, &from.stored),
            (dissipated, &from.dissipated),
            (time_step_squared, &from.time_step_squared),
            (hourglass, &from.hourglass),
            (damping, &from.damping),
            (viscous, &from.viscous),
            (viscous_step, &from.viscous_step),
            (viscous_pressure, &from.viscous_pressure),
            (volume, &from.volume),
        ] {
            to.0[lane] = from.0[source];
        }
    }
}

/// Splits `items` elements into batches, the last filled up with copies of the last element.
pub(crate) fn element_of(batch: usize, lane: usize, items: usize) -> usize {
    (batch * BATCH + lane).min(items - 1)
}
