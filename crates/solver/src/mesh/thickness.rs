//! Thicknesses of shells from fields of mesh files: one for each corner of each element.

use super::messages::SHELLS;
use super::{Dim, Mesh, Meshed};
use crate::error::Fault;
use crate::model::{FieldValues, MeshGroup, Model, Shape};
use crate::vector::place;

impl<const D: usize> Mesh<D>
where
    Dim<D>: Meshed<D>,
{
    /// Takes the thicknesses of the corners of shells whose sections name a field, m. Nodes and elements are
    /// in their order.
    pub(super) fn take_thicknesses(&mut self, model: &Model, faults: &mut Vec<Fault>) {
        let named = |part: usize| model.parts[part].section.as_ref().filter(|section| !section.thickness_field.is_empty());
        if !self.groups.iter().any(|group| named(group.part).is_some()) {
            return;
        }
        let mut all = vec![Vec::new(); self.groups.len()];
        for (corners, group) in all.iter_mut().zip(&self.groups) {
            let (Some(section), Shape::Group { mesh, group: name }) = (named(group.part), &model.parts[group.part].shape) else { continue };
            let Some(source) = model.meshes.get(*mesh) else { continue };
            let Some(field) = source.fields.iter().find(|field| field.name == section.thickness_field) else { continue };
            let Some(placed) = self.placed.iter().find(|place| place.parts.contains(&group.part)) else { continue };
            let of_group = |it: &MeshGroup| it.name == *name && usize::from(it.dimension) == group.kind.dimension();
            let Some(own) = source.groups.iter().position(of_group) else { continue };
            let cells = &source.groups[own].cells;
            let count = group.kind.nodes();
            for (element, nodes) in group.connectivity.chunks_exact(count).enumerate() {
                // Bodies of a part follow each other.
                let user = group.user_elements[element] as usize;
                let (copy, cell) = (user / cells.len(), user % cells.len());
                for &node in nodes {
                    let is_it = |&other: &u32| placed.number(other, copy) == self.user_nodes[node as usize];
                    let at = cells[cell].iter().position(is_it);
                    let value = at.and_then(|at| match &field.values {
                        FieldValues::Nodes(values) => values.get(cells[cell][at] as usize).copied().flatten(),
                        FieldValues::Corners(groups) => groups.get(own)?.get(cell)?.get(at).copied(),
                    });
                    corners.push(value.unwrap_or(f64::NAN));
                }
            }
            let wrong = || (0..corners.len()).filter(|&corner| !(corners[corner].is_finite() && corners[corner] > 0.0));
            if let Some(first) = wrong().next() {
                let at = place(self.positions[group.connectivity[first] as usize]);
                let (value, count) = (corners[first], wrong().count());
                let what = if value.is_nan() { "has no value".to_string() } else { format!("is {value:e} m") };
                let message =
                    format!("the field \"{}\" {what} at {at} m, one of {count} corner(s) of elements without a thickness", field.name);
                let help = "a thickness is greater than 0 and there at all nodes of the part; values are lengths in the unit of the file";
                faults.push(Fault::new(&SHELLS, format!("part[{}].section.thickness_field", group.part), message, help));
            }
        }
        self.thicknesses = all;
    }
}
