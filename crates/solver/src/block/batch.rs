//! Storage of a block: batches of eight elements, each quantity of a batch side by side.

use crate::archive::{Archive, ArchiveResult, Persist};
use embate_lanes::{BATCH, Batch};

/// Makes a structure of batches whose lanes can be copied; every field is named once, so that none can be
/// forgotten.
macro_rules! batches {
    ($(#[$doc:meta])* $name:ident { $($(#[$field_doc:meta])* $field:ident,)* } kept { $($(#[$kept_doc:meta])* $kept:ident,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default)]
        pub(crate) struct $name {
            $($(#[$field_doc])* pub(crate) $field: Batch,)*
            $($(#[$kept_doc])* pub(crate) $kept: Batch,)*
        }

        impl $name {
            /// Makes a lane a copy of lane `source` of the batch `from`, but for what distinguishes them.
            pub(crate) fn copy_lane(&mut self, lane: usize, from: &Self, source: usize) {
                $(self.$field.0[lane] = from.$field.0[source];)*
            }
        }

        impl Persist for $name {
            fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
                $(self.$field.persist(archive)?;)*
                $(self.$kept.persist(archive)?;)*
                Ok(())
            }
        }
    };
}

batches! {
    /// What belongs to a batch of eight elements and does not depend on the law's number of values.
    ElementBatch {
        /// Mass of each element in the stable step: the smallest of its nodes, each times its mass ratio
        /// ([`super::kernel::Facts`]), which holds for any later form of the element.
        mass_least,
        /// Stored elastic energy of each element, J/m.
        stored,
        /// Dissipated energy of each element, J/m.
        dissipated,
        /// Square of each element's stable step, s².
        time_step_squared,
        /// Energy that hourglass control has stored and taken, J/m.
        hourglass,
    } kept {
        /// 1 for an element, 0 for a lane that only fills the batch up and for an eroded element: both are
        /// copies of a live one (`erosion.rs`).
        live,
    }
}

batches! {
    /// What bulk viscosity and damping in proportion to the stiffness remember of a batch; there only with
    /// one of them.
    Resistance {
        /// Mass of each element without what mass scaling added, kg/m: the density of the bulk viscosity.
        mass,
        /// Volume in the last step, m² (m³).
        volume,
        /// Pressure of the bulk viscosity, Pa.
        viscous_pressure,
        /// Work that the bulk viscosity has taken, J/m, and the part of it in the last step.
        viscous,
        viscous_step,
        /// Work that damping in proportion to the stiffness has taken, J/m.
        damping,
    } kept {}
}

/// Splits `items` elements into batches, the last filled up with copies of the last element.
pub(crate) fn element_of(batch: usize, lane: usize, items: usize) -> usize {
    (batch * BATCH + lane).min(items - 1)
}
