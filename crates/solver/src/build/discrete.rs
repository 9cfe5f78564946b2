//! Springs and point masses on the nodes of a mesh.

use super::{Builder, Builds};
use crate::block::spring::SpringBlock;
use crate::error::Fault;
use crate::load::messages::TO_ITSELF;
use crate::model::Spring;
use crate::model::messages::UNKNOWN_NAME;
use crate::tensor::Dim;
use crate::vector::{dot, minus, place};

impl<const D: usize> Builder<'_, D>
where
    Dim<D>: Builds<D>,
{
    /// Adds point masses to the parts of their nodes: of a node of several parts to the first.
    pub(super) fn point_masses(&mut self, part_mass: &mut [Vec<(u32, f64)>]) {
        for (index, mass) in self.model.point_masses.iter().enumerate() {
            let Some(nodes) = self.set(&mass.on, &format!("point_mass[{index}].on")) else { continue };
            let share = mass.mass / nodes.len() as f64;
            for node in nodes {
                let place = |masses: &mut Vec<(u32, f64)>| masses.binary_search_by_key(&node, |&(node, _)| node).ok();
                if let Some((masses, at)) = part_mass.iter_mut().find_map(|masses| place(masses).map(|at| (masses, at))) {
                    masses[at].1 += share;
                }
            }
        }
    }

    /// Nodes of a set that must have some.
    fn set(&mut self, name: &str, path: &str) -> Option<Vec<u32>> {
        let nodes = self.mesh.nodes(name).filter(|nodes| !nodes.is_empty());
        if nodes.is_none() {
            let message = format!("there is nothing called \"{name}\"");
            self.faults.push(Fault::new(&UNKNOWN_NAME, path, message, "name a part, a side as part.side, or a group of a mesh file"));
        }
        nodes
    }
    /// The springs of the model as a block; `None` without any. The masses of nodes are known.
    pub(crate) fn springs(&mut self) -> Option<SpringBlock> {
        let mut springs = Vec::new();
        for (index, spring) in self.model.springs.iter().enumerate() {
            let sets = [0, 1].map(|side| self.set(&spring.between[side], &format!("spring[{index}].between[{side}]")));
            let [Some(first), Some(second)] = sets else { continue };
            match pairs(&first, &second, &self.mesh.positions) {
                Ok(pairs) => springs.push((spring, pairs)),
                Err(node) => {
                    let at = place(self.mesh.positions[node as usize]);
                    let message = format!("the node at {at} m is in both sets, so its spring would bind it to itself");
                    self.faults.push(Fault::new(&TO_ITSELF, format!("spring[{index}].between"), message, "name sets without common nodes"));
                }
            }
        }
        let made: Vec<(&Spring, Vec<[u32; 2]>)> = springs;
        for (_, pairs) in &made {
            self.bodies.share(pairs.as_flattened());
        }
        (!made.is_empty()).then(|| SpringBlock::new(&made, &self.mesh.positions, &self.mass))
    }
}

/// Each node of the larger set with the nearest one of the other, from the first set to the second; `Err`: a
/// node of both.
fn pairs<const D: usize>(first: &[u32], second: &[u32], positions: &[[f64; D]]) -> Result<Vec<[u32; 2]>, u32> {
    let (many, few) = if first.len() >= second.len() { (first, second) } else { (second, first) };
    let distance = |a: u32, b: u32| {
        let way = minus(positions[a as usize], positions[b as usize]);
        dot(way, way)
    };
    let nearest = |&node: &u32| {
        let partner = few.iter().copied().min_by(|&a, &b| distance(node, a).total_cmp(&distance(node, b))).unwrap_or(node);
        if partner == node {
            return Err(node);
        }
        Ok(if first.len() >= second.len() { [node, partner] } else { [partner, node] })
    };
    many.iter().map(nearest).collect()
}
