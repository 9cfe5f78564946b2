//! Dynamic relaxation: damping of mass at the critical rate of the motion that there is, and the end when all
//! is at rest.
//!
//! The Rayleigh quotient with the stiffness that the internal forces show in the step, ω² = −v·(f^n −
//! f^{n−1}) / (dt Σ m v²), is the square of the angular frequency of the motion; what moves fast dies first,
//! so it falls to that of the slowest mode, whose critical rate is 2 ω. Underwood, "Dynamic relaxation", in
//! Computational Methods for Transient Analysis (1983) 245-265; Papadrakakis, Comput. Meth. Appl. Mech. Engng
//! 25 (1981) 35-48.

use super::System;
use crate::archive::{Archive, ArchiveResult, Persist, persist_each};
use crate::dimension::Dimension;
use crate::model;
use crate::reductions::SumInOrder;
use crate::tensor::Dim;
use crate::vector::{dot, minus};

/// What brings everything to rest.
pub(crate) struct Relaxation<const D: usize> {
    tolerance: f64,
    from: f64,
    /// Internal forces of the step before, N/m.
    forces: Vec<[f64; D]>,
    /// ω, 1/s.
    frequency: f64,
    /// Since when kinetic energy has been small, s.
    quiet: Option<f64>,
    /// Kinetic over internal energy now.
    pub(crate) ratio: f64,
    /// When all was at rest, s.
    pub(crate) rest: Option<f64>,
}

impl<const D: usize> Relaxation<D> {
    pub(crate) fn new(model::Relaxation { tolerance, from }: model::Relaxation, nodes: usize) -> Self {
        Self { tolerance, from, forces: vec![[0.0; D]; nodes], frequency: 0.0, quiet: None, ratio: f64::INFINITY, rest: None }
    }
}

impl<const D: usize> Relaxation<D> {
    /// With these internal forces (N/m) before its first step.
    pub(super) fn with_forces(self, forces: impl Fn(usize) -> [f64; D]) -> Self {
        Self { forces: (0..self.forces.len()).map(forces).collect(), ..self }
    }
}

impl<const D: usize> Persist for Relaxation<D> {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { tolerance: _, from: _, forces, frequency, quiet, ratio, rest } = self;
        forces[..].persist(archive)?;
        persist_each!(archive; frequency, quiet, ratio, rest);
        Ok(())
    }
}

impl<const D: usize> System<D>
where
    Dim<D>: Dimension<D>,
{
    /// Sets the rate of damping for the coming update.
    pub(super) fn relax(&mut self) {
        let Some(relaxation) = &mut self.relaxation else { return };
        let (mut powers, mut inertias) = (SumInOrder::default(), SumInOrder::default());
        for (node, old) in relaxation.forces.iter_mut().enumerate() {
            let force = self.assembly.force(node, &self.slots);
            if self.bodies.of_node(node as u32).is_none() {
                let v = self.velocities[node];
                powers.add(dot(v, minus(force, *old)));
                inertias.add(self.mass[node] * dot(v, v));
            }
            *old = force;
        }
        let square = -powers.value() / (self.time_step_old * inertias.value());
        // Of what is at rest, or yields, nothing is learnt.
        if square.is_finite() && square > 0.0 {
            relaxation.frequency = square.sqrt();
        }
        self.damping.relax(2.0 * relaxation.frequency);
    }

    /// Ends the run where all is at rest.
    pub(super) fn check_equilibrium(&mut self) {
        let Some(relaxation) = &mut self.relaxation else { return };
        let stores = &self.ledger.stores;
        relaxation.ratio = stores.kinetic.abs() / (stores.elastic + stores.plastic);
        // NaN where nothing has been strained yet.
        if !(relaxation.ratio <= relaxation.tolerance) || self.time < relaxation.from {
            relaxation.quiet = None;
            return;
        }
        let since = *relaxation.quiet.get_or_insert(self.time);
        if relaxation.frequency > 0.0 && (self.time - since) * relaxation.frequency >= std::f64::consts::PI {
            relaxation.rest = Some(self.time);
            if self.stages.as_ref().is_none_or(|stages| stages.is_last()) {
                self.limits.end = self.time;
            }
        }
    }
}
