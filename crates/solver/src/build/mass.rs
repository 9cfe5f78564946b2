//! Masses: elements made heavier for a longer stable step before masses go to the nodes, and what is kept of
//! the masses of parts.

use super::{Builder, Builds};
use crate::block::{Block, evaluate_at_rest};
use crate::error::Fault;
use crate::error::MASS_SCALING;
use crate::masses::PartMasses;
use crate::mesh::Mesh;
use crate::tensor::Dim;
use embate_lanes::Level;

impl<const D: usize> Builder<'_, D>
where
    Dim<D>: Builds<D>,
{
    /// Scales the mass of parts (`mass_scale`) and of elements below the wanted step. Returns the mass added
    /// to deformable parts and their true mass, and what of it was added for the wanted step, kg/m; more of
    /// this than the limit is a fault.
    pub(super) fn scale_mass(&mut self, blocks: &mut [Box<dyn Block<D>>], level: Level) -> ([f64; 2], f64) {
        let masses = |block: &dyn Block<D>| (0..block.elements()).map(|element| block.mass(element)).sum::<f64>();
        let (mut before, mut after) = (0.0, 0.0);
        let mut wanted_adds = 0.0;
        for (block, group) in blocks.iter_mut().zip(&self.mesh.groups) {
            let part = &self.model.parts[group.part];
            let own = masses(block.as_ref());
            if part.mass_scale != 1.0 {
                (0..block.elements()).for_each(|element| block.scale_mass(element, part.mass_scale));
            }
            if part.rigid.is_some() {
                continue;
            }
            if let Some(scaling) = self.model.run.mass_scaling {
                let scaled = masses(block.as_ref());
                evaluate_at_rest(block.as_mut(), &self.mesh.positions, level);
                let needed = (scaling.time_step / self.model.run.safety).powi(2);
                for (element, squared) in block.time_steps_squared().into_iter().enumerate() {
                    let factor = needed / squared;
                    if factor > 1.0 {
                        block.scale_mass(element, factor);
                    }
                }
                wanted_adds += masses(block.as_ref()) - scaled;
            }
            before += own;
            after += masses(block.as_ref());
        }
        if let Some(scaling) = self.model.run.mass_scaling
            && wanted_adds > scaling.limit * before
        {
            let unit = if self.model.is_of_whole_bodies() { "kg" } else { "kg/m" };
            let message = format!(
                "a step of {:.3e} s needs {wanted_adds:.4e} {unit} more mass, {:.3} % of what the deformable parts \
                    have; the limit is {:.3} %",
                scaling.time_step,
                100.0 * wanted_adds / before,
                100.0 * scaling.limit
            );
            self.faults.push(Fault::new(
                &MASS_SCALING,
                "run.mass_scaling.time_step",
                message,
                "take a smaller step, fix the smallest elements, or raise `limit`",
            ));
        }
        ([after - before, before], wanted_adds)
    }
}

/// Mass of each part on each of its nodes, kg/m, nodes ascending.
pub(super) fn part_masses<const D: usize>(mesh: &Mesh<D>, blocks: &[Box<dyn Block<D>>]) -> Vec<Vec<(u32, f64)>>
where
    Dim<D>: Builds<D>,
{
    let (mut sums, mut is_own) = (vec![0.0; mesh.positions.len()], vec![false; mesh.positions.len()]);
    let of = |part: usize| {
        let own = &mesh.parts[part].nodes;
        own.iter().for_each(|&node| (sums[node as usize], is_own[node as usize]) = (0.0, true));
        for (group, block) in mesh.groups.iter().zip(blocks).filter(|(group, _)| group.part == part) {
            for (element, cell) in group.cells().enumerate() {
                for (corner, &node) in cell.nodes.iter().enumerate() {
                    sums[node as usize] += block.corner_mass(element, corner);
                }
            }
        }
        let mut masses: Vec<(u32, f64)> = Vec::with_capacity(own.len());
        if own.len() < sums.len() / 16 {
            // Few nodes among many: only they are looked at.
            masses.extend(own.iter().map(|&node| (node, sums[node as usize])));
            masses.sort_unstable_by_key(|&(node, _)| node);
        } else {
            masses.extend((0..).zip(&sums).zip(&is_own).filter(|(_, is_own)| **is_own).map(|((node, &sum), _)| (node, sum)));
        }
        own.iter().for_each(|&node| is_own[node as usize] = false);
        masses
    };
    (0..mesh.parts.len()).map(of).collect()
}

impl<const D: usize> Builder<'_, D>
where
    Dim<D>: Builds<D>,
{
    /// What is kept of the masses of parts; `part_mass` has those of all nodes, with point masses.
    pub(super) fn shares(&self, blocks: &[Box<dyn Block<D>>], part_mass: &[Vec<(u32, f64)>]) -> PartMasses {
        let of = |part: usize| self.mesh.groups.iter().zip(blocks).filter(move |(group, _)| group.part == part).map(|(_, block)| block);
        let whole = |part: usize| of(part).flat_map(|block| (0..block.elements()).map(move |element| block.mass(element))).sum();
        let of_elements = (!self.model.point_masses.is_empty()).then(|| part_masses(&self.mesh, blocks));
        let weighs_more = |&&(node, share): &&(u32, f64)| self.mass[node as usize] != share;
        let shared = |masses: &Vec<(u32, f64)>| masses.iter().filter(weighs_more).copied().collect();
        let masses = of_elements.as_deref().unwrap_or(part_mass);
        PartMasses::new((0..self.mesh.parts.len()).map(whole).collect(), masses.iter().map(shared).collect())
    }
}
