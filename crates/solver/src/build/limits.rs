//! What stops a run: limits of the model, and what stands in for those that it leaves out.

use super::Builds;
use crate::block::Block;
use crate::mesh::surface::{Corners, Facet, Sided, Surface};
use crate::mesh::{ElementGroup, Mesh};
use crate::model::Model;
use crate::step::Limits;
use crate::tensor::Dim;
use crate::vector::{dot, minus};

/// The limits of a model. Where none is given, the step and the speed depend on the start and are set there.
pub(super) fn of<const D: usize>(model: &Model, mesh: &Mesh<D>, blocks: &[Box<dyn Block<D>>], outside: &Surface<D>) -> Limits
where
    Dim<D>: Builds<D>,
{
    let run = &model.run;
    // The longest side: a segment, or an edge of a facet.
    let length = |facet: &Facet<D>| {
        let nodes = facet.corners();
        let side = |k: usize| {
            let [from, to] = [nodes[k], nodes[(k + 1) % nodes.len()]].map(|node| mesh.positions[node as usize]);
            minus(to, from)
        };
        (0..nodes.len()).map(|k| dot(side(k), side(k)).sqrt()).fold(0.0, f64::max)
    };
    Limits {
        end: run.end,
        safety: run.safety,
        energy: run.energy_limit,
        step: run.step_limit.unwrap_or(0.0),
        largest: run.time_step.unwrap_or(f64::INFINITY),
        velocity: run.velocity_limit.unwrap_or_else(|| -fastest_wave(model, mesh, blocks)),
        penetration: run.penetration_limit.unwrap_or_else(|| outside.facets().iter().map(length).fold(0.0, f64::max)),
        is_local: run.penetration_limit.is_none(),
    }
}

/// The fastest wave of all materials, √(M/ρ), m/s.
fn fastest_wave<const D: usize>(model: &Model, mesh: &Mesh<D>, blocks: &[Box<dyn Block<D>>]) -> f64
where
    Dim<D>: Builds<D>,
{
    let of = |group: &ElementGroup, block: &dyn Block<D>| {
        let density = model.materials.get(&model.parts[group.part].material)?.parameters.get("density")?;
        Some((block.wave_modulus() / density).sqrt())
    };
    mesh.groups.iter().zip(blocks).filter_map(|(group, block)| of(group, block.as_ref())).fold(0.0, f64::max)
}
