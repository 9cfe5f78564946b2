//! Mass scaling in the run: an element whose stable step falls below the wanted one is made heavier, until as
//! much mass as the model allows has been added.
//!
//! Each corner of such an element gets the same mass, Δ = (f − 1) times that of its lightest corner with
//! f = dt²(wanted)/dt², so that the bound of its frequency falls by f (`block/forces.rs`). The mass comes
//! with the velocity of its node: it brings the momentum Σ Δ v and the kinetic energy ½ Σ Δ |v|², which the
//! ledger takes as work from outside. Gravity pulls at the true mass as before. Elements at rigid bodies
//! get none.

use super::System;
use crate::archive::{Archive, ArchiveResult, Persist, persist_each};
use crate::block::Report;
use crate::dimension::Dimension;
use crate::model;
use crate::tensor::Dim;
use crate::vector::{dot, plus, times};

/// Elements get mass for a squared step that is longer than wanted by this factor, so that they do not need
/// more in the next step.
const MARGIN: f64 = 1.02;

/// Mass that is added in the run.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MassScaling<const D: usize> {
    /// Square of the stable step that all elements shall have, s².
    wanted: f64,
    /// Mass that may still be added, kg/m (kg).
    room: f64,
    /// Mass that was added, kg/m (kg).
    pub(crate) added: f64,
    /// Momentum that it brought, kg/s (kg m/s).
    pub(crate) momentum: [f64; D],
    /// Kinetic energy that it brought, J/m (J).
    pub(crate) kinetic: f64,
    /// When elements needed more than may be added, s.
    pub(crate) exhausted: Option<f64>,
}

impl<const D: usize> Persist for MassScaling<D> {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { wanted: _, room, added, momentum, kinetic, exhausted } = self;
        persist_each!(archive; room, added, momentum, kinetic, exhausted);
        Ok(())
    }
}

impl<const D: usize> MassScaling<D> {
    /// As the model wants it; what it `added` at the start, and the true `mass`, kg/m (kg).
    pub(crate) fn new(scaling: &model::MassScaling, safety: f64, [added, mass]: [f64; 2]) -> Self {
        let wanted = (scaling.time_step / safety).powi(2);
        Self { wanted, room: scaling.limit * mass - added, added: 0.0, momentum: [0.0; D], kinetic: 0.0, exhausted: None }
    }
}

impl<const D: usize> System<D>
where
    Dim<D>: Dimension<D>,
{
    /// Adds mass to elements that need it; returns what elements report with it.
    pub(super) fn scale_mass(&mut self, elements: Report) -> Report {
        let Some(mut own) = self.mass_scaling.take() else { return elements };
        let is_short = self.step > 0 && own.exhausted.is_none() && self.shortest_of_elements() < own.wanted;
        let elements = if is_short { self.add_mass(&mut own, elements) } else { elements };
        self.mass_scaling = Some(own);
        elements
    }

    fn add_mass(&mut self, own: &mut MassScaling<D>, elements: Report) -> Report {
        let wanted = [own.wanted, MARGIN * own.wanted];
        let gains = |&index: &usize| !self.rigid[index] && !self.is_gone(index);
        let gaining: Vec<usize> = (0..self.blocks.len()).filter(gains).collect();
        let bodies = &self.bodies;
        let may = |node: u32| bodies.of_node(node).is_none();
        let needed: f64 = gaining.iter().map(|&index| self.blocks[index].mass_for(wanted, &may)).sum();
        if needed > own.room {
            own.exhausted = Some(self.time);
        }
        if needed <= 0.0 || own.exhausted.is_some() {
            return elements;
        }
        let mut added: Vec<(usize, u32, f64)> = Vec::new();
        for index in gaining {
            let add = &mut |node: u32, mass: f64| added.push((index, node, mass));
            if let Some(squared) = self.blocks[index].make_heavier(wanted, &may, add) {
                self.reports[index].time_step_squared = squared;
            }
        }
        let mut kinetic = 0.0;
        for (block, node, mass) in added {
            if let Some(group) = self.mesh.groups.get(block) {
                self.shares.add(group.part, node, mass);
            }
            let (node, whole) = (node as usize, self.mass[node as usize] + mass);
            self.body_forces.dilute(node, self.mass[node] / whole);
            self.mass[node] = whole;
            let v = self.velocities[node];
            kinetic += 0.5 * mass * dot(v, v);
            own.momentum = plus(own.momentum, times(mass, v));
            own.added += mass;
            own.room -= mass;
        }
        own.kinetic += kinetic;
        self.ledger.bring(kinetic);
        if let Some(subcycling) = &mut self.subcycling {
            subcycling.wake();
        }
        self.joined_reports()
    }

    /// Keeps masses, and what they weigh.
    pub(super) fn persist_masses(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Some(own) = &mut self.mass_scaling else { return Ok(()) };
        own.persist(archive)?;
        self.mass[..].persist(archive)?;
        archive.check(self.mass.iter().all(|mass| mass.is_finite() && *mass >= 0.0), "a mass that is none")?;
        self.shares.persist(archive)?;
        self.body_forces.persist_shares(archive)
    }
}
