//! Time, step, energies of the model and of its parts.

use super::{Channel, Column, samples};
use crate::dimension::Dimension;
use crate::step::System;
use crate::tensor::Dim;

/// Columns of energies, after `energy.`.
const ENERGIES: [&str; 12] = [
    "kinetic",
    "internal",
    "plastic",
    "hourglass",
    "bulk_viscosity",
    "contact",
    "friction",
    "contact_damping",
    "damping",
    "eroded",
    "external",
    "total",
];

/// The group.
pub(super) struct Energies;

impl<const D: usize> Channel<D> for Energies
where
    Dim<D>: Dimension<D>,
{
    fn columns(&self, system: &System<D>) -> Vec<Column> {
        let mut columns: Vec<String> = ["time", "time_step"].map(String::from).to_vec();
        columns.extend(ENERGIES.iter().map(|name| format!("energy.{name}")));
        if system.remap.is_some() {
            columns.push("energy.remap".into());
        }
        if has_flow(system) {
            columns.push("energy.flow".into());
        }
        for part in &system.mesh.parts {
            columns.extend(["kinetic", "internal", "plastic"].iter().map(|name| format!("energy.{name}[{}]", part.name)));
        }
        samples(columns).collect()
    }

    fn samples(&self, system: &System<D>, row: &mut Vec<f64>) {
        let (stores, external) = (system.ledger.stores, system.ledger.external);
        row.extend([system.time, system.time_step, stores.kinetic, stores.elastic + stores.plastic, stores.plastic]);
        row.extend([
            stores.hourglass,
            stores.bulk_viscosity,
            stores.contact,
            stores.friction,
            stores.contact_damping,
            stores.damping,
            stores.eroded,
            external,
            stores.total() - external,
        ]);
        row.extend(system.remap.as_ref().map(|_| stores.remap));
        row.extend(has_flow(system).then_some(stores.flow));
        let mut of_parts = vec![[0.0; 3]; system.mesh.parts.len()];
        for (group, report) in system.mesh.groups.iter().zip(&system.reports) {
            let energies = [report.stored + report.dissipated, report.dissipated];
            of_parts[group.part][1..].iter_mut().zip(energies).for_each(|(sum, energy)| *sum += energy);
        }
        for (index, (part, energies)) in system.mesh.parts.iter().zip(&mut of_parts).enumerate() {
            let of_node = |&node: &u32| system.shares.of(index, node, system.mass[node as usize]) * system.specific_kinetic(node as usize);
            energies[0] = part.nodes.iter().map(of_node).sum();
        }
        row.extend(of_parts.iter().flatten());
    }
}

/// Whether material flows through a part.
fn has_flow<const D: usize>(system: &System<D>) -> bool
where
    Dim<D>: Dimension<D>,
{
    system.remap.as_ref().is_some_and(|remap| !remap.flows.is_empty())
}
