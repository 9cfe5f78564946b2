//! What `embate check` shows of each part.

use super::{PartOverview, Runs};
use crate::material::DENSITY;
use crate::model::Model;
use crate::step::{Governor, System};
use crate::tensor::Dim;

/// What a system does not know of its parts.
#[derive(Clone, Debug, Default)]
pub(crate) struct KnownParts {
    /// Name of the elements of each group of the mesh.
    kinds: Vec<&'static str>,
    /// Speed of the fastest waves at rest in each group, m/s.
    wave_speeds: Vec<f64>,
}

impl KnownParts {
    pub(super) fn new<const D: usize>(model: &Model, system: &System<D>) -> Self
    where
        Dim<D>: Runs<D>,
    {
        let groups = || system.mesh.groups.iter().zip(&system.blocks);
        let kind = |part: usize, cell| model.parts[part].element_in(D, cell).map_or("", |kind| kind.name);
        let density = |part: usize| model.materials.get(&model.parts[part].material)?.parameters.get(DENSITY.name).copied();
        Self {
            kinds: groups().map(|(group, _)| kind(group.part, group.kind)).collect(),
            wave_speeds: groups().map(|(group, block)| (block.wave_modulus() / density(group.part).unwrap_or(f64::NAN)).sqrt()).collect(),
        }
    }

    /// All parts in model order.
    pub(super) fn overview<const D: usize>(&self, system: &System<D>) -> Vec<PartOverview>
    where
        Dim<D>: Runs<D>,
    {
        let mut parts: Vec<PartOverview> = (0..system.mesh.parts.len()).map(|index| self.of_part(system, index)).collect();
        let deformable = || parts.iter().filter(|part| !part.is_rigid);
        let least = deformable().map(|part| part.stable_time_step).fold(f64::INFINITY, f64::min);
        let is_of_elements = matches!(system.governor, Governor::Element(_) | Governor::Node(_) | Governor::Assembled(_));
        for part in &mut parts {
            part.governs = is_of_elements && !part.is_rigid && part.stable_time_step == least;
        }
        parts
    }

    fn of_part<const D: usize>(&self, system: &System<D>, index: usize) -> PartOverview
    where
        Dim<D>: Runs<D>,
    {
        let part = &system.mesh.parts[index];
        let groups: Vec<usize> = (0..system.mesh.groups.len()).filter(|&group| system.mesh.groups[group].part == index).collect();
        let blocks = || groups.iter().map(|&group| &system.blocks[group]);
        let size = (0..D).map(|d| {
            let along = || part.with_faces().map(move |node| system.mesh.positions[node as usize][d]);
            along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min)
        });
        PartOverview {
            name: part.name.clone(),
            elements: blocks().map(|block| block.elements()).sum(),
            kinds: groups.iter().map(|&group| (self.kinds[group], system.blocks[group].elements())).collect(),
            nodes: part.nodes.len(),
            mass: system.shares.whole[index],
            size: size.collect(),
            wave_speed: groups.iter().map(|&group| self.wave_speeds[group]).fold(0.0, f64::max),
            is_rigid: groups.iter().all(|&group| system.rigid[group]),
            stable_time_step: blocks().flat_map(|block| block.time_steps_squared()).fold(f64::INFINITY, f64::min).sqrt(),
            governs: false,
        }
    }
}
