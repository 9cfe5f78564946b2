//! Faces of shells in 2D.
//!
//! Around a node of the middle its elements divide the plane into sectors. Each sector has a node where the
//! faces on its two sides meet: of a smooth shell at half of the thickness from the middle, at a fold at half
//! of it from both elements, as far as that is within twice the half; a free end has two, side by side.

use super::{FACES, MITRE};
use crate::mesh::cell::CellKind;
use crate::mesh::surface::Corners;
use crate::mesh::{ElementGroup, Mesh, sorted};
use crate::model::Model;
use crate::vector::{dot, minus, plus, times, unit};
use std::collections::BTreeMap;

/// An element at a node of the middle: group and element, which end of it, direction away from the node, and
/// how far its faces are on the right and on the left of that, m.
#[derive(Clone, Copy)]
struct Spoke {
    group: usize,
    element: usize,
    end: usize,
    away: [f64; 2],
    faces: [f64; 2],
    /// The mirror image of another one, beyond a symmetry line.
    is_image: bool,
}

/// Left of a direction.
fn left([x, y]: [f64; 2]) -> [f64; 2] {
    [-y, x]
}

/// A direction by half of the sector that begins at `from` and ends at `to`, counter-clockwise, and the sine
/// of that half.
fn bisector(from: [f64; 2], to: [f64; 2]) -> ([f64; 2], f64) {
    // The sum of the normals into the sector: long where they agree.
    let (begin, end) = (left(from), times(-1.0, left(to)));
    let sum = plus(begin, end);
    let along = unit(sum).unwrap_or(from);
    (along, dot(along, begin).max(1.0 / MITRE))
}

impl Mesh<2> {
    /// Gives shells their faces and the directions of their nodes.
    pub(in crate::mesh) fn add_skins_of_lines(&mut self, model: &Model) {
        let is_shell = |group: &ElementGroup| group.kind == CellKind::Line && model.parts[group.part].is_of_shells();
        if !self.groups.iter().any(is_shell) {
            return;
        }
        let normals = self.symmetry_normals(model);
        let mut at: BTreeMap<u32, Vec<Spoke>> = BTreeMap::new();
        for (number, group) in self.groups.iter().enumerate().filter(|(_, group)| is_shell(group)) {
            let section = model.parts[group.part].section.as_ref();
            for (element, nodes) in group.connectivity.as_chunks::<2>().0.iter().enumerate() {
                for end in 0..2 {
                    let [own, other] = [nodes[end], nodes[1 - end]].map(|node| self.positions[node as usize]);
                    let away = unit(minus(other, own)).unwrap_or_default();
                    let [lower, upper] =
                        section.map_or([0.0; 2], |section| section.faces(self.thickness_of(section, number, 2 * element + end)));
                    let faces = if end == 0 { [lower, upper] } else { [upper, lower] };
                    at.entry(nodes[end]).or_default().push(Spoke { group: number, element, end, away, faces, is_image: false });
                }
            }
        }
        let groups = self.groups.len();
        self.directions = vec![Vec::new(); groups];
        for (number, group) in self.groups.iter_mut().enumerate().filter(|(_, group)| is_shell(group)) {
            group.outer = vec![u32::MAX; 4 * group.elements()];
            self.directions[number] = vec![[0.0; 2]; 2 * group.elements()];
        }
        for (node, mut spokes) in at {
            let images: Vec<Spoke> = (normals.get(&node).into_iter().flatten())
                .flat_map(|normal| spokes.iter().map(|spoke| mirrored(spoke, *normal)))
                .filter(|image| spokes.iter().all(|spoke| dot(spoke.away, image.away) < 1.0 - 1e-12))
                .collect();
            spokes.extend(images);
            let own = spokes.iter().filter(|spoke| !spoke.is_image).count();
            if own > 2 {
                self.joints.push(([node; 2], own as u32));
            }
            self.direct(model, &spokes);
            self.surround(model, node, spokes);
        }
        self.name_faces(model);
    }

    /// Whether one element continues another as a smooth shell.
    fn is_smooth(&self, model: &Model, one: &Spoke, other: &Spoke) -> bool {
        let section = model.parts[self.groups[one.group].part].section.as_ref();
        let fold = crate::angle::cos_sin(section.map_or(0.0, |section| section.fold_angle))[0];
        -dot(one.away, other.away) >= fold
    }

    /// Directions of the tangents at a node: of each element the mean of those that are smooth to it.
    fn direct(&mut self, model: &Model, spokes: &[Spoke]) {
        for spoke in spokes.iter().filter(|spoke| !spoke.is_image) {
            let mut sum = spoke.away;
            for other in spokes.iter().filter(|other| dot(other.away, spoke.away) < 1.0 - 1e-12) {
                if self.is_smooth(model, spoke, other) {
                    sum = minus(sum, other.away);
                }
            }
            let sign = if spoke.end == 0 { 1.0 } else { -1.0 };
            self.directions[spoke.group][2 * spoke.element + spoke.end] = times(sign, unit(sum).unwrap_or(spoke.away));
        }
    }

    /// Puts nodes of the faces around a node of the middle.
    fn surround(&mut self, model: &Model, node: u32, mut spokes: Vec<Spoke>) {
        let angle = |spoke: &Spoke| crate::angle::angle_of(spoke.away);
        spokes.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
        let count = spokes.len();
        let alone = count == 1;
        for k in 0..count {
            let (from, to) = (spokes[k], spokes[(k + 1) % count]);
            if from.is_image && to.is_image {
                continue;
            }
            if alone {
                // At a free end the faces end side by side, across the shell.
                let across = left(self.tangent(&from));
                let ends = [from.faces[1], -from.faces[0]].map(|height| self.add_skin_node(node, times(height, across)));
                self.put(&from, true, ends[0]);
                self.put(&from, false, ends[1]);
                continue;
            }
            let (along, sine) = bisector(from.away, to.away);
            // A smooth shell has its thickness at the node, as the nodes of a round solid have; at a fold
            // its faces do.
            let sine = if self.is_smooth(model, &from, &to) { 1.0 } else { sine };
            let own = self.add_skin_node(node, times(0.5 * (from.faces[1] + to.faces[0]) / sine, along));
            self.put(&from, true, own);
            self.put(&to, false, own);
        }
    }

    /// Direction away from its node of the tangent there.
    fn tangent(&self, spoke: &Spoke) -> [f64; 2] {
        let direction = self.directions[spoke.group][2 * spoke.element + spoke.end];
        if spoke.end == 0 { direction } else { times(-1.0, direction) }
    }

    /// Gives an element its node on the left or right of the direction away from the node. Its cell runs
    /// along the right of the line from its first to its second node, and back on the left.
    fn put(&mut self, spoke: &Spoke, is_left: bool, node: u32) {
        if spoke.is_image {
            return;
        }
        let corner = match (spoke.end, is_left) {
            (0, true) => 3,
            (0, false) => 0,
            (_, true) => 1,
            (_, false) => 2,
        };
        self.groups[spoke.group].outer[4 * spoke.element + corner] = node;
    }

    /// Faces of parts by name, and their nodes.
    fn name_faces(&mut self, model: &Model) {
        for (index, part) in model.parts.iter().enumerate().filter(|(_, part)| part.is_of_shells()) {
            let groups = || self.groups.iter().filter(move |group| group.part == index);
            let cells = || groups().flat_map(|group| group.outer.as_chunks::<4>().0);
            // Segments have the body on their right.
            let right: Vec<[u32; 2]> = cells().map(|&[a, b, ..]| [b, a].canonical()).collect();
            let left: Vec<[u32; 2]> = cells().map(|&[.., c, d]| [d, c].canonical()).collect();
            let nodes = sorted(cells().flatten().copied());
            for (face, facets) in FACES.into_iter().zip([left, right]) {
                self.sides.insert(format!("{}.{face}", part.name), facets);
            }
            self.parts[index].faces = nodes;
        }
    }
}

/// The image of an element beyond a symmetry line.
fn mirrored(spoke: &Spoke, normal: [f64; 2]) -> Spoke {
    let away = minus(spoke.away, times(2.0 * dot(spoke.away, normal), normal));
    Spoke { away, faces: [spoke.faces[1], spoke.faces[0]], is_image: true, ..*spoke }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shapes::Truss;
    use crate::mesh::surface::Sided;
    use crate::model::{Part, Shape, ShellSection};

    #[test]
    fn the_hole_where_three_shells_meet_is_outside_only_when_one_is_gone() {
        let lines = vec![vec![[-0.5, 0.0], [0.0, 0.0], [0.5, 0.0]], vec![[0.0, 0.0], [0.0, 0.5]]];
        let part = Part {
            name: "tee".into(),
            shape: Shape::Truss(Truss { lines, elements: 5 }),
            element: "shell2".into(),
            section: Some(ShellSection { thickness: 0.02, ..ShellSection::default() }),
            ..Part::default()
        };
        let mut mesh = Mesh::<2>::new(&Model { parts: vec![part], ..Model::default() }).unwrap();
        let count = |mesh: &Mesh<2>| mesh.outside_without(&[], |_| false).unwrap().facets().len();
        // Two faces of each of 15 elements, three ends.
        assert_eq!((mesh.joints.len(), count(&mesh)), (1, 33));
        let joint = mesh.joints[0].0[0];
        let group = &mut mesh.groups[0];
        let element = (0..15).find(|&element| group.nodes_of(element).contains(&joint)).unwrap();
        group.erode(element);
        // Its two faces are gone; the end of the next one and the hole's edges of the other two show.
        assert_eq!(count(&mesh), 33 - 2 + 1 + 2);
    }
}
