//! Uniform acceleration of the mass of some parts: force m g on every node, with the part's share of the node's mass.

use crate::mesh::Mesh;
use crate::model::{Load, Model};

/// Acceleration of every node, m/s²; empty when the model has no such load. `part_mass` lists the nodes of each part with the
/// part's mass on them (kg/m), `mass` the whole mass of each node.
#[must_use]
pub fn accelerations(model: &Model, mesh: &Mesh<2>, mass: &[f64], part_mass: &[Vec<(u32, f64)>]) -> Vec<[f64; 2]> {
    if !model.loads.iter().any(|load| matches!(load, Load::Gravity { .. })) {
        return Vec::new();
    }
    let mut result = vec![[0.0; 2]; mesh.positions.len()];
    for load in &model.loads {
        let Load::Gravity { parts, acceleration } = load else { continue };
        for (part, masses) in mesh.parts.iter().zip(part_mass) {
            if parts.is_empty() || parts.contains(&part.name) {
                for &(node, share) in masses {
                    for d in 0..2 {
                        result[node as usize][d] += acceleration[d] * share / mass[node as usize];
                    }
                }
            }
        }
    }
    result
}
