//! Joins of the rims of shells or ends of beams with nodes of solids: these have no rotation, so the join is
//! a hinge, which most often was not meant.

use super::Builds;
use crate::error::Warning;
use crate::load::join::Joins;
use crate::load::messages::HINGE;
use crate::mesh::Mesh;
use crate::model::{Image, Model};
use crate::tensor::Dim;

/// A warning for each such join.
pub(super) fn warnings<const D: usize>(model: &Model, mesh: &Mesh<D>, joins: &Joins<D>) -> Vec<Warning>
where
    Dim<D>: Builds<D>,
{
    if joins.is_empty() || !model.parts.iter().any(|part| part.has_rotations()) {
        return Vec::new();
    }
    let (mut rotates, mut is_solid) = (vec![false; mesh.positions.len()], vec![false; mesh.positions.len()]);
    for group in &mesh.groups {
        let list = match model.parts[group.part].has_rotations() {
            true => &mut rotates,
            false if group.is_body(D) => &mut is_solid,
            false => continue,
        };
        group.connectivity.iter().for_each(|&node| list[node as usize] = true);
    }
    let at_solid = |node: u32| {
        let members = |group: &crate::load::join::Group<D>| group.members.iter().any(|member| is_solid[member.node as usize]);
        joins.of_node(node).is_some_and(|(group, _)| members(group)) || is_solid[node as usize]
    };
    let hinged: Vec<bool> = (0..mesh.positions.len() as u32).map(|node| rotates[node as usize] && at_solid(node)).collect();
    // What is joined all over bends with the solid.
    let mut is_held = vec![false; hinged.len()];
    for group in mesh.groups.iter().filter(|group| model.parts[group.part].has_rotations()) {
        for cell in group.cells().filter(|cell| cell.nodes.iter().all(|&node| hinged[node as usize])) {
            cell.nodes.iter().for_each(|&node| is_held[node as usize] = true);
        }
    }
    let is_hinge = |&node: &u32| hinged[node as usize] && !is_held[node as usize];
    let mut warnings = Vec::new();
    for (index, join) in model.joins.iter().enumerate().filter(|(_, join)| join.image == Image::Same) {
        let Some(name) = join.between.iter().find(|name| mesh.nodes(name).is_some_and(|nodes| nodes.iter().any(is_hinge))) else {
            continue;
        };
        warnings.push(Warning {
            kind: &HINGE,
            path: format!("join[{index}]"),
            message: format!("the join is a hinge: nodes of `{name}` rotate, and those of the solid that they are joined to do not"),
            consequence: "it carries forces, but no moment".into(),
            help: "bind the rim by a [[contact]] with `tied = true`, the end of a beam by a [[weld]]; as a hinge let it be".into(),
        });
    }
    warnings
}
