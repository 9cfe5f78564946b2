//! Nodes around nodes of beams at which welds and joints hold them: at the corners of a regular tetrahedron,
//! so that forces on them move the node and rotate it.

use crate::mesh::Mesh;
use crate::model::{Model, Part};
use crate::vector::{length, minus, times};
use std::collections::BTreeSet;

/// Corners of a regular tetrahedron around its middle, at the distance √3.
const CORNERS: [[f64; 3]; 4] = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
/// Their distance along each axis as a part of the shortest element at the node.
const SIZE: f64 = 0.1;

impl Mesh<3> {
    /// Gives the nodes of beams that are nearest to the points of welds and joints, each of its sets, nodes
    /// around them.
    pub(in crate::mesh) fn add_hubs_of_beams(&mut self, model: &Model) {
        if !model.parts.iter().any(Part::is_of_beams) {
            return;
        }
        let groups = self.groups.iter().filter(|group| model.parts[group.part].is_of_beams());
        let beams: BTreeSet<u32> = groups.flat_map(|group| &group.connectivity).copied().collect();
        let welds = model.welds.iter().flat_map(|weld| weld.between.iter().flat_map(|name| weld.at.iter().map(move |&at| (name, at))));
        let joints = model.joints.iter().flat_map(|joint| joint.between.iter().map(|name| (name, joint.at)));
        let mut hubs = BTreeSet::new();
        for (name, at) in welds.chain(joints) {
            let nodes = self.nodes(name).unwrap_or_default();
            let distance = |node: u32| length(minus(self.positions[node as usize], at));
            let nearest = nodes.into_iter().min_by(|&a, &b| distance(a).total_cmp(&distance(b)));
            hubs.extend(nearest.filter(|node| beams.contains(node)));
        }
        // Of shells it has the nodes of their faces.
        for skin in &self.skins {
            hubs.remove(&skin.owner);
        }
        for node in hubs {
            let at_node =
                self.groups.iter().flat_map(|group| group.cells()).filter(|cell| cell.nodes.len() == 2 && cell.nodes.contains(&node));
            let size = |nodes: &[u32]| length(minus(self.positions[nodes[1] as usize], self.positions[nodes[0] as usize]));
            let shortest = at_node.map(|cell| size(cell.nodes)).fold(f64::INFINITY, f64::min);
            for corner in CORNERS {
                self.add_skin_node(node, times(SIZE * shortest, corner));
            }
        }
    }
}
