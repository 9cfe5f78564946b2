//! Thicknesses of shells from fields of mesh files: one for each corner of each element.

use super::messages::SHELLS;
use super::{Dim, Mesh, Meshed};
use crate::error::Fault;
use crate::model::{FieldValues, Model, Shape};
use crate::vector::place;
use std::collections::BTreeMap;

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
        // By mesh file: its node of each number of a user.
        let mut of_users: BTreeMap<usize, BTreeMap<u32, u32>> = BTreeMap::new();
        let mut all = vec![Vec::new(); self.groups.len()];
        for (corners, group) in all.iter_mut().zip(&self.groups) {
            let (Some(section), Shape::Group { mesh, group: name }) = (named(group.part), &model.parts[group.part].shape) else { continue };
            let Some(source) = model.meshes.get(*mesh) else { continue };
            let Some(field) = source.fields.iter().find(|field| field.name == section.thickness_field) else { continue };
            let of_user = of_users.entry(*mesh).or_insert_with(|| self.imported[*mesh].iter().copied().zip(0..).collect());
            let file_node = |node: u32| of_user.get(&self.user_nodes[node as usize]).copied().unwrap_or(u32::MAX);
            let own = source.groups.iter().position(|it| it.name == *name && usize::from(it.dimension) == group.kind.dimension());
            let count = group.kind.nodes();
            for (element, nodes) in group.connectivity.chunks_exact(count).enumerate() {
                let user = group.user_elements[element] as usize;
                for &node in nodes {
                    let value = match &field.values {
                        FieldValues::Nodes(values) => values.get(file_node(node) as usize).copied().flatten(),
                        FieldValues::Corners(groups) => own.and_then(|own| {
                            let at = source.groups[own].cells.get(user)?.iter().position(|other| *other == file_node(node))?;
                            groups.get(own)?.get(user)?.get(at).copied()
                        }),
                    };
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
