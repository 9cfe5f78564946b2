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
use std::collections::{BTreeMap, BTreeSet};

/// Cosine up to which an edge is along a plane.
const ALONG: f64 = 1e-6;

/// The shells of a model: elements, corners at each node, and elements at each edge, edge by edge.
struct Shells {
    elements: Vec<Shell>,
    corners: Rows<Corner>,
    wings: Vec<Wing>,
}

/// Edges at each node, their elements, and the normals of symmetry planes.
struct Around<'a> {
    planes: BTreeMap<u32, Vec<[f64; 3]>>,
    at_nodes: Rows<u32>,
    edges: Vec<&'a [Wing]>,
}

impl Around<'_> {
    fn planes_at(&self, node: u32) -> &[[f64; 3]] {
        self.planes.get(&node).map_or(&[], |planes| planes)
    }
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
            let faces = |corner: usize| section.map_or([0.0; 2], |section| section.faces(self.thickness_of(section, number, corner)));
            let fold = crate::angle::cos_sin(section.map_or(0.0, |section| section.fold_angle))[0];
            for (element, cell) in group.cells().enumerate() {
                let shell = elements.len() as u32;
                elements.push(Shell { group: number, element, fold });
                let nodes = cell.corners();
                (0..nodes.len()).for_each(|corner| {
                    let faces = faces(element * group.kind.nodes() + corner);
                    corners.push((nodes[corner], Corner { faces, ..self.corner(shell, nodes, corner) }));
                });
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
        Corner { shell, corner, normal: unit(across).unwrap_or_default(), angle, faces: [0.0; 2] }
    }

    /// The faces around each node of shells, ascending; joints are noted.
    fn faces_of_surfaces(&mut self, model: &Model, shells: &Shells) -> Vec<(u32, Faces)> {
        let planes = self.symmetry_normals(model);
        let edges: Vec<&[Wing]> = shells.wings.chunk_by(|a, b| a.edge == b.edge).collect();
        let ends = edges.iter().zip(0..).flat_map(|(wings, number)| wings[0].edge.map(|node| (node, number)));
        let around = Around { planes, at_nodes: Rows::new(self.positions.len(), ends), edges };
        let nodes = (0..self.positions.len() as u32).filter(|&node| !shells.corners.of(node as usize).is_empty());
        let (mut all, mut rims) = (Vec::new(), BTreeSet::new());
        for node in nodes {
            let (hub, counts) = self.hub(shells, &around, node, shells.corners.of(node as usize));
            for (&number, count) in around.at_nodes.of(node as usize).iter().zip(counts) {
                let wings = around.edges[number as usize];
                if count > 2 && node == wings[0].edge[0] {
                    self.joints.push((wings[0].edge, wings.len() as u32));
                }
                rims.extend((count == 1).then_some(wings[0].edge));
            }
            all.push((node, hub.faces()));
        }
        self.extrapolate(shells, &around, &rims, &mut all);
        all
    }

    /// What is around a node with these corners, and the number of elements and images at each of its edges.
    fn hub<'a>(&self, shells: &'a Shells, around: &'a Around<'_>, node: u32, corners: &'a [Corner]) -> (Hub<'a>, Vec<usize>) {
        let mut hub = Hub::new(&shells.elements, corners, around.planes_at(node));
        let mut counts = Vec::new();
        for &number in around.at_nodes.of(node as usize) {
            let wings = around.edges[number as usize];
            let [a, b] = wings[0].edge;
            let axis = unit(minus(self.positions[b as usize], self.positions[a as usize])).unwrap_or_default();
            // Both ends may be on planes with the same normal, and the edge between them.
            let is_along = |plane: &&[f64; 3]| dot(axis, **plane).abs() < ALONG && around.planes_at(b).contains(plane);
            let planes = around.planes_at(a).iter().filter(is_along).copied().collect();
            counts.push(hub.add_edge(&Edge { axis, wings, planes }));
        }
        (hub, counts)
    }

    /// Directions at free rims: there a mean of normals would lean by half an element, and curved shells be
    /// too stiff. They lean towards the node behind as much as the direction there leans away from them,
    /// which is exact where the curvature is the same; at a corner of the sheet the direction of the node
    /// across the element is mirrored on its normal.
    fn extrapolate(&self, shells: &Shells, around: &Around<'_>, rims: &BTreeSet<[u32; 2]>, all: &mut [(u32, Faces)]) {
        let on_rims: BTreeSet<u32> = rims.iter().flatten().copied().collect();
        // Direction of an element at a node that is on no rim.
        let known = |node: u32, shell: u32| {
            let (_, faces) = &all[all.binary_search_by_key(&node, |(node, _)| *node).ok().filter(|_| !on_rims.contains(&node))?];
            let at = shells.corners.of(node as usize).iter().position(|at| at.shell == shell)?;
            Some(faces.corners[at].0)
        };
        let mut leaning = Vec::new();
        for (place, &(node, _)) in all.iter().enumerate().filter(|(_, (node, _))| on_rims.contains(node)) {
            let mut corners = shells.corners.of(node as usize).to_vec();
            let mut is_new = false;
            for at in &mut corners {
                if let Some(normal) = self.normal_at_rim(shells, rims, node, at, known) {
                    (at.normal, is_new) = (normal, true);
                }
            }
            if is_new {
                leaning.push((place, self.hub(shells, around, node, &corners).0.faces()));
            }
        }
        leaning.into_iter().for_each(|(place, faces)| all[place].1 = faces);
    }

    /// The normal of a corner at a node on a rim from the direction at the node behind it, where that is
    /// `known`.
    fn normal_at_rim(
        &self,
        shells: &Shells,
        rims: &BTreeSet<[u32; 2]>,
        node: u32,
        at: &Corner,
        known: impl Fn(u32, u32) -> Option<[f64; 3]>,
    ) -> Option<[f64; 3]> {
        let Shell { group, element, .. } = shells.elements[at.shell as usize];
        let nodes = self.groups[group].cell(element).corners();
        let x = |corner: usize| self.positions[nodes[corner % nodes.len()] as usize];
        let [next, before] = [at.corner + 1, at.corner + nodes.len() - 1].map(|corner| nodes[corner % nodes.len()]);
        let is_rim = |other: u32| rims.contains(&[other.min(node), other.max(node)]);
        let behind = match [is_rim(next), is_rim(before)] {
            [true, false] => before,
            [false, true] => next,
            // A corner of the sheet.
            [true, true] if nodes.len() == 4 => {
                let normal = unit(cross(minus(x(2), x(0)), minus(x(3), x(1))))?;
                let direction = known(nodes[(at.corner + 2) % 4], at.shell)?;
                return Some(minus(times(2.0 * dot(normal, direction), normal), direction));
            }
            _ => return None,
        };
        let direction = known(behind, at.shell)?;
        let along = unit(minus(self.positions[behind as usize], self.positions[node as usize]))?;
        let lean = dot(direction, along);
        Some(unit(minus(times((1.0 - lean * lean).sqrt(), at.normal), times(lean, along))).unwrap_or(at.normal))
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
            let cells = || groups().flat_map(|group| group.outer_cells().map(|(_, cell)| cell.nodes.split_at(group.kind.nodes())));
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
