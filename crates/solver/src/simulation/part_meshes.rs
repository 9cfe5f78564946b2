//! What the parts of a model are made of: kinds of elements, sizes and shapes, as they were meshed. For
//! reports.

use super::Runs;
use crate::mesh::geometry::CellGeometry;
use crate::model::Model;
use crate::step::System;
use crate::tensor::Dim;

/// The mesh of a part at the start.
#[derive(Clone, Debug, PartialEq)]
pub struct PartMeshed {
    /// Name.
    pub name: String,
    /// Element formulations with the numbers of their elements.
    pub elements: Vec<(String, usize)>,
    /// Number of nodes.
    pub nodes: usize,
    /// Mass per metre of depth, kg/m (of whole bodies kg).
    pub mass: f64,
    /// Smallest and largest element: length, root of the area, cube root of the volume, m.
    pub sizes: [f64; 2],
    /// Shape of the worst element: smallest Jacobian determinant at a corner over the square (in 3D the third
    /// power) of the longest side; 1 of squares and cubes, 0.87 of the best triangle, 0.71 of the best
    /// tetrahedron. 1 of lines.
    pub shape: f64,
    /// Centre of that element, m.
    pub worst: Vec<f64>,
    /// Stable step of its elements, s; infinite of a rigid part.
    pub stable_time_step: f64,
}

/// Of all parts in the order of the model.
pub(super) fn of<const D: usize>(system: &System<D>, model: &Model) -> Vec<PartMeshed>
where
    Dim<D>: Runs<D>,
{
    let positions = &system.mesh.positions;
    let one = |(index, part): (usize, &crate::mesh::PartMesh)| {
        let mut made = PartMeshed {
            name: part.name.clone(),
            elements: Vec::new(),
            nodes: part.nodes.len(),
            mass: system.shares.whole[index],
            sizes: [f64::INFINITY, 0.0],
            shape: f64::INFINITY,
            worst: Vec::new(),
            stable_time_step: f64::INFINITY,
        };
        for (g, group) in system.mesh.groups.iter().enumerate().filter(|(_, group)| group.part == index) {
            let kind = model.parts.iter().find(|own| own.name == part.name).and_then(|own| own.element_in(D, group.kind));
            let name = kind.map_or(group.kind.facts().name, |kind| kind.name);
            match made.elements.iter_mut().find(|(known, _)| known == name) {
                Some((_, count)) => *count += group.elements(),
                None => made.elements.push((name.to_string(), group.elements())),
            }
            let root = 1.0 / group.kind.facts().dimension.max(1) as f64;
            for (element, cell) in group.cells().enumerate() {
                let size = <Dim<D>>::size(cell, positions).abs().powf(root);
                made.sizes = [made.sizes[0].min(size), made.sizes[1].max(size)];
                let shape = <Dim<D>>::shape_quality(cell, positions);
                if shape < made.shape {
                    (made.shape, made.worst) = (shape, system.centre(group.nodes_of(element)).to_vec());
                }
                if !system.rigid[g] {
                    made.stable_time_step = made.stable_time_step.min(system.blocks[g].time_step_squared(element).sqrt());
                }
            }
        }
        made
    };
    system.mesh.parts.iter().enumerate().map(one).collect()
}
