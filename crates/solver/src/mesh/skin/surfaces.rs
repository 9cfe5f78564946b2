//! Faces of shells in 3D.
//!
//! The elements around an edge of the middle divide the space around it into sectors; sides of elements that
//! look into the same sector meet there, and with those of the edges around a node they are the faces around
//! it. Each of them has a node: of a smooth shell at half of the thickness from the middle, at folds at half
//! of it from all pieces that meet there, as far as that is within twice the half. At a free rim both faces
//! end side by side. A wall whose foot ends on a plate has nodes of its own there, on the plate.

use super::around::{Corner, Edge, Faces, Hub, Shell, Wing};
use super::{SURFACE_FACES, meeting_places};
use crate::mesh::surface::Corners;
use crate::mesh::{ElementGroup, Mesh, sorted};
use crate::model::{Model, Part};
use crate::rows::Rows;
use crate::tensor::cross;
use crate::vector::{dot, minus, plus, times, unit};

/// Cosine up to which an edge is along a plane.
const ALONG: f64 = 1e-6;

/// The shells of a model: elements, corners at each node, and elements at each edge, edge by edge.
struct Shells {
    elements: Vec<Shell>,
    corners: Rows<Corner>,
    wings: Vec<Wing>,
}

impl Mesh<3> {
    /// Gives shells their faces and the directions of their nodes; `is_shell` says which parts they are.
    pub(in crate::mesh) fn add_skins_of_surfaces(&mut self, model: &Model, is_shell: impl Fn(&Part) -> bool) {
        let is_shell = |group: &ElementGroup| group.kind.dimension() == 2 && is_shell(&model.parts[group.part]);
        if !self.groups.iter().any(is_shell) {
            return;
        }
        let shells = self.shells(model, is_shell);
        let all = self.faces_of_surfaces(model, &shells);
        self.directions = vec![Vec::new(); self.groups.len()];
        for (number, group) in self.groups.iter_mut().enumerate().filter(|(_, group)| is_shell(group)) {
            let corners = group.connectivity.len();
            group.outer = vec![u32::MAX; 2 * corners];
            self.directions[number] = vec![[0.0; 3]; corners];
        }
        for (node, faces) in all {
            self.put_faces(&shells, node, &faces);
        }
        self.name_surface_faces();
    }

    fn shells(&self, model: &Model, is_shell: impl Fn(&ElementGroup) -> bool) -> Shells {
        let (mut elements, mut wings, mut corners) = (Vec::new(), Vec::new(), Vec::new());
        for (number, group) in self.groups.iter().enumerate().filter(|(_, group)| is_shell(group)) {
            let section = model.parts[group.part].section.as_ref();
            let half = section.map_or(0.0, |section| 0.5 * section.thickness);
            let fold = crate::angle::cos_sin(section.map_or(0.0, |section| section.fold_angle))[0];
            for (element, cell) in group.cells().enumerate() {
                let shell = elements.len() as u32;
                elements.push(Shell { group: number, element, half, fold });
                let nodes = cell.corners();
                (0..nodes.len()).for_each(|corner| corners.push((nodes[corner], self.corner(shell, nodes, corner))));
                let centre = nodes.iter().fold([0.0; 3], |sum, &node| plus(sum, self.positions[node as usize]));
                let centre = times(1.0 / nodes.len() as f64, centre);
                for ([a, b], edge) in cell.edges().zip(meeting_places(cell)).filter(|([a, b], _)| a != b) {
                    let middle = times(0.5, plus(self.positions[a as usize], self.positions[b as usize]));
                    wings.push(Wing { edge, shell, is_along: a < b, inward: minus(centre, middle) });
                }
            }
        }
        wings.sort_by_key(|wing| (wing.edge, wing.shell));
        Shells { elements, corners: Rows::new(self.positions.len(), corners.iter().copied()), wings }
    }

    /// A corner of an element: its normal and angle.
    fn corner(&self, shell: u32, nodes: &[u32], corner: usize) -> Corner {
        let count = nodes.len();
        let [own, next, before] = [0, 1, count - 1].map(|by| self.positions[nodes[(corner + by) % count] as usize]);
        let (a, b) = (minus(next, own), minus(before, own));
        let across = cross(a, b);
        let angle = crate::angle::angle_of([dot(a, b), dot(across, across).sqrt()]);
        Corner { shell, corner, normal: unit(across).unwrap_or_default(), angle }
    }

    /// The faces around each node of shells, ascending; joints are noted.
    fn faces_of_surfaces(&mut self, model: &Model, shells: &Shells) -> Vec<(u32, Faces)> {
        let planes = self.symmetry_normals(model);
        let planes_at = |node: u32| planes.get(&node).map_or(&[][..], |planes| &planes[..]);
        let edges: Vec<&[Wing]> = shells.wings.chunk_by(|a, b| a.edge == b.edge).collect();
        let ends = edges.iter().zip(0..).flat_map(|(wings, number)| wings[0].edge.map(|node| (node, number)));
        let at_nodes: Rows<u32> = Rows::new(self.positions.len(), ends);
        let mut all = Vec::new();
        for node in (0..self.positions.len() as u32).filter(|&node| !shells.corners.of(node as usize).is_empty()) {
            let mut hub = Hub::new(&shells.elements, shells.corners.of(node as usize), planes_at(node));
            for &number in at_nodes.of(node as usize) {
                let wings = edges[number as usize];
                let [a, b] = wings[0].edge;
                let axis = unit(minus(self.positions[b as usize], self.positions[a as usize])).unwrap_or_default();
                // Both ends may be on planes with the same normal, and the edge between them.
                let is_along = |plane: &&[f64; 3]| dot(axis, **plane).abs() < ALONG && planes_at(b).contains(plane);
                let planes = planes_at(a).iter().filter(is_along).copied().collect();
                let count = hub.add_edge(&Edge { axis, wings, planes });
                if count > 2 && node == a {
                    self.joints.push(([a, b], wings.len() as u32));
                }
            }
            all.push((node, hub.faces()));
        }
        all
    }

    /// Adds the nodes of the faces around a node, and gives them to its elements.
    fn put_faces(&mut self, shells: &Shells, node: u32, faces: &Faces) {
        let nodes: Vec<u32> = faces.arms.iter().map(|&arm| self.add_skin_node(node, arm)).collect();
        for (at, &(direction, sides)) in shells.corners.of(node as usize).iter().zip(&faces.corners) {
            let Shell { group, element, .. } = shells.elements[at.shell as usize];
            let count = self.groups[group].kind.nodes();
            self.directions[group][count * element + at.corner] = direction;
            for (side, arm) in sides.into_iter().enumerate() {
                self.groups[group].outer[count * (2 * element + side) + at.corner] = nodes[arm];
            }
        }
    }

    /// Faces of parts by name, and their nodes.
    fn name_surface_faces(&mut self) {
        for index in 0..self.parts.len() {
            let groups = || self.groups.iter().filter(move |group| group.part == index && !group.outer.is_empty());
            let cells = || groups().flat_map(|group| group.outer_cells().map(|cell| cell.nodes.split_at(group.kind.nodes())));
            let lower: Vec<[u32; 4]> =
                cells().filter_map(|(nodes, _)| <[u32; 4]>::of_cell(nodes)).map(|it| it.reversed().canonical()).collect();
            let upper: Vec<[u32; 4]> = cells().filter_map(|(_, nodes)| <[u32; 4]>::of_cell(nodes)).map(Corners::canonical).collect();
            let nodes = sorted(cells().flat_map(|(lower, upper)| lower.iter().chain(upper)).copied());
            if nodes.is_empty() {
                continue;
            }
            for (face, facets) in SURFACE_FACES.into_iter().zip([upper, lower]) {
                self.sides.insert(format!("{}.{face}", self.parts[index].name), facets);
            }
            self.parts[index].faces = nodes;
        }
    }
}
