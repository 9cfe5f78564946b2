//! Parts of one mesh file that are swept and placed alike share its nodes, and with them its groups.

use super::{MeshGroup, Model, Part, Shape};

impl Part {
    /// Whether two parts are groups of one mesh file that are swept and placed alike: then they share its
    /// nodes.
    #[must_use]
    pub fn shares_nodes_with(&self, other: &Self) -> bool {
        let file = |part: &Self| match part.shape {
            Shape::Group { mesh, .. } => Some(mesh),
            _ => None,
        };
        file(self).is_some() && file(self) == file(other) && self.sweep == other.sweep && self.placement == other.placement
    }
}

impl Model {
    /// The first of the parts that share the nodes of a mesh file with this one; itself where none does.
    #[must_use]
    pub fn first_sharing(&self, part: usize) -> usize {
        self.parts.iter().position(|other| other.shares_nodes_with(&self.parts[part])).unwrap_or(part)
    }

    /// Each place where the nodes of a mesh file are: its first part, and the number of the file, if it was
    /// read.
    pub(crate) fn places(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let file = |part: usize| match self.parts[part].shape {
            Shape::Group { mesh, .. } if mesh < self.meshes.len() => Some((part, mesh)),
            _ => None,
        };
        (0..self.parts.len()).filter_map(file).filter(|&(part, _)| self.first_sharing(part) == part)
    }

    /// Whether all nodes of a group of a mesh file are those of elements where this part is.
    pub(crate) fn has_elements_of(&self, part: usize, group: &MeshGroup) -> bool {
        let mut used = Vec::new();
        for part in self.parts.iter().filter(|other| other.shares_nodes_with(&self.parts[part])) {
            let Shape::Group { mesh, group: name } = &part.shape else { continue };
            let groups = self.meshes.get(*mesh).map_or(&[][..], |file| &file.groups);
            let own = groups.iter().find(|it| it.name == *name && it.dimension == self.cells_dimension(part));
            for &node in own.iter().flat_map(|own| own.cells.iter().flatten()) {
                used.resize(used.len().max(node as usize + 1), false);
                used[node as usize] = true;
            }
        }
        group.cells.iter().flatten().all(|&node| used.get(node as usize) == Some(&true))
    }
}
