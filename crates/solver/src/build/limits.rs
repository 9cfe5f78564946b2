//! What stops a run: limits of the model, and what stands in for those that it leaves out.

use crate::block::Block;
use crate::mesh::surface::Surface;
use crate::mesh::{ElementGroup, Mesh};
use crate::model::Model;
use crate::step::Limits;

/// The limits of a model. Where none is given, the step and the speed depend on the start and are set there.
pub(super) fn of(model: &Model, mesh: &Mesh<2>, blocks: &[Box<dyn Block<2>>], outside: &Surface) -> Limits {
    let run = &model.run;
    let length = |&[from, to]: &[u32; 2]| {
        let ([a, b], [c, d]) = (mesh.positions[from as usize], mesh.positions[to as usize]);
        ((c - a) * (c - a) + (d - b) * (d - b)).sqrt()
    };
    Limits {
        end: run.end,
        safety: run.safety,
        energy: run.energy_limit,
        step: run.step_limit.unwrap_or(0.0),
        largest: run.time_step.unwrap_or(f64::INFINITY),
        velocity: run.velocity_limit.unwrap_or_else(|| -fastest_wave(model, mesh, blocks)),
        penetration: run.penetration_limit.unwrap_or_else(|| outside.segments.iter().map(length).fold(0.0, f64::max)),
    }
}

/// The fastest wave of all materials, √(M/ρ), m/s.
fn fastest_wave(model: &Model, mesh: &Mesh<2>, blocks: &[Box<dyn Block<2>>]) -> f64 {
    let of = |group: &ElementGroup, block: &dyn Block<2>| {
        let density = model.materials.get(&model.parts[group.part].material)?.parameters.get("density")?;
        Some((block.wave_modulus() / density).sqrt())
    };
    mesh.groups.iter().zip(blocks).filter_map(|(group, block)| of(group, block.as_ref())).fold(0.0, f64::max)
}
