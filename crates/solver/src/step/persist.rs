//! The system in a kept state: what it knows at the end of a step. It is made of its model first, as for time
//! zero; then the state is filled in.

use super::{Governor, System};
use crate::archive::{Archive, ArchiveError, ArchiveResult, Persist, persist_each};
use crate::dimension::Dimension;
use crate::tensor::Dim;
use crate::vector::{plus, times};

impl Persist for Governor {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let (mut number, mut square) = match *self {
            Self::Element(square) => (0_u8, square),
            Self::Given => (1, 0.0),
            Self::Schedule => (2, 0.0),
            Self::Contact => (3, 0.0),
            Self::Node(node) => (4, f64::from(node)),
            Self::Assembled(node) => (5, f64::from(node)),
            Self::Cavity(number) => (6, f64::from(number)),
        };
        persist_each!(archive; &mut number, &mut square);
        archive.check(number < 4 || square < archive.nodes as f64, "a node that there is not")?;
        *self = match number {
            0 => Self::Element(square),
            1 => Self::Given,
            2 => Self::Schedule,
            3 => Self::Contact,
            4 => Self::Node(square as u32),
            5 => Self::Assembled(square as u32),
            6 => Self::Cavity(square as u32),
            _ => return Err(ArchiveError::new("unknown governor of the time step")),
        };
        Ok(())
    }
}

impl<const D: usize> System<D>
where
    Dim<D>: Dimension<D>,
{
    /// How many nodes an archive of it may name, and how many places: also those of rigid bodies.
    pub(super) fn archive_sizes(&self) -> [usize; 2] {
        [self.positions.len(), self.positions.len() + self.bodies.len()]
    }
}

impl<const D: usize> Persist for System<D>
where
    Dim<D>: Dimension<D>,
{
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        if archive.reads() && self.nodal_bound.is_some() {
            self.mark_time_steps();
        }
        [archive.nodes, archive.places] = self.archive_sizes();
        archive.section("system")?;
        self.persist_stages(archive)?;
        self.persist_system(archive)?;
        archive.section("nodes")?;
        self.persist_nodes(archive)?;
        self.persist_masses(archive)?;
        if !self.rotations.now.is_empty() {
            archive.section("rotations")?;
            self.rotations.persist(archive)?;
            if archive.reads() {
                self.rotations.foresee(self.time_step, self.level);
            }
        }
        for (number, block) in self.blocks.iter_mut().enumerate() {
            archive.section(&format!("elements {number}"))?;
            block.persist(archive)?;
        }
        if archive.reads() {
            // Contacts are made again of the surfaces that are left, before what they know is filled in.
            self.remove_eroded_elements();
        }
        archive.section("contact")?;
        self.persist_contact(archive)
    }
}

impl<const D: usize> System<D>
where
    Dim<D>: Dimension<D>,
{
    fn persist_system(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        // Nothing of these is state, or it is kept elsewhere below; loads of the model, dampings and
        // constraints are worked out from the time.
        #[rustfmt::skip]
        let Self {
            mesh: _, assembly: _, mass: _, body_parts: _, rigid: _, has_springs: _, shares: _, outlines: _, constraints: _, damping: _, body_forces: _,
            boundary: _, joins: _, level: _, team: _, of_revolution: _, sums: _, groups: _, of_bodies: _, initial_penetrations: _,
            mass_added: _, mass_scaling: _, blocks: _, contacts: _, traces: _, positions: _, positions_old: _, velocities: _, velocities_old: _, contact_forces: _,
            springs: _, erosion: _, rotations: _, skins: _, bound_by: _, stages: _,
            limits: _,
            bodies, curves, forces, cavities, remap, step, time, time_step_old, time_step, governor, reports, ledger, penetration_max, speed, travel, relaxation, nodal_bound, assembled_bound,
            subcycling, slots,
        } = self;
        persist_each!(archive; step, time, time_step_old, time_step, governor, penetration_max, speed, travel);
        persist_each!(archive; ledger, bodies, curves, &mut reports[..]);
        forces.persist_pushes(archive)?;
        cavities.persist(archive)?;
        if let Some(remap) = remap {
            remap.persist(archive)?;
        }
        if let Some(bound) = nodal_bound {
            bound.persist(archive)?;
        }
        if let Some(bound) = assembled_bound {
            bound.persist(archive)?;
        }
        if let Some(subcycling) = subcycling {
            subcycling.persist(archive)?;
            if archive.reads() {
                // Elements that are not evaluated next leave them as they are.
                slots.fill([0.0; D]);
            }
        }
        let mut has_relaxation = relaxation.is_some();
        has_relaxation.persist(archive)?;
        archive.check(has_relaxation == relaxation.is_some(), "there is no relaxation")?;
        if let Some(relaxation) = relaxation {
            relaxation.persist(archive)?;
        }
        self.limits.end = self.rest().unwrap_or(self.limits.end);
        Ok(())
    }

    fn persist_nodes(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { positions, velocities, velocities_old, positions_old, time_step, .. } = self;
        for list in [&mut *positions, velocities, velocities_old] {
            list[..].persist(archive)?;
        }
        if archive.reads() {
            // As the velocity update leaves it where nothing holds a node; elsewhere it is written before it
            // is read.
            for (next, (x, v)) in positions_old.iter_mut().zip(positions.iter().zip(velocities.iter())) {
                *next = plus(*x, times(*time_step, *v));
            }
        }
        Ok(())
    }

    fn persist_contact(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let mut has_erosion = self.erosion.is_some();
        has_erosion.persist(archive)?;
        archive.check(has_erosion == self.erosion.is_some(), "nothing can fail")?;
        if let Some(erosion) = &mut self.erosion {
            erosion.persist(archive)?;
        }
        persist_each!(archive; &mut self.springs, &mut self.contact_forces, &mut self.traces);
        let springs = self.springs.list.len();
        self.contacts.iter_mut().try_for_each(|contact| contact.persist(archive, springs))?;
        if archive.reads() {
            self.clear_eroded_slots();
        }
        Ok(())
    }

    /// Blocks without elements are not strained: they leave their slots as they are.
    fn clear_eroded_slots(&mut self) {
        let (mut first, mut first_moment) = (0, 0);
        for (index, block) in self.blocks.iter().enumerate() {
            let (count, moments) = (block.slots().len(), block.moment_slots().len());
            if self.is_gone(index) {
                self.slots[first..first + count].fill([0.0; D]);
                self.rotations.slots[first_moment..first_moment + moments].fill([0.0; 3]);
            }
            (first, first_moment) = (first + count, first_moment + moments);
        }
    }
}
