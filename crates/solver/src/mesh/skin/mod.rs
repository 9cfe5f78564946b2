//! The surfaces of shells and beams: nodes on both faces, or around the cross-section, which go with the
//! nodes of the middle, and the cells between them, which bound a body as those of solids do.
//!
//! Around a node of the middle its elements divide the plane, in 3D space, into sectors. Each sector has a
//! node where the faces around it meet. So contact, pressure and pictures see a body of the shell's
//! thickness, whose faces bend with it, and nothing of them knows of shells.

mod arm;
mod around;
mod beams;
mod hubs;
mod lines;
mod outline;
mod surfaces;
#[cfg(test)]
mod beam_tests;
#[cfg(test)]
mod tests;

use super::cell::Cell;
use super::messages::{BEAMS, SHELLS};
use super::surface::{Corners, Facet};
use super::{Dim, ElementGroup, Mesh, Meshed, PartMesh};
use crate::error::Fault;
use crate::model::{Model, Part, ShellSection, Symmetry};
use crate::vector::{dot, first, minus, plus, unit};
use std::collections::{BTreeMap, BTreeSet};

/// Farthest that a node of a face is from the middle, in half thicknesses.
const MITRE: f64 = 2.0;

/// Names of the faces in 2D, as someone who walks along the line sees them.
pub(super) const FACES: [&str; 2] = ["left", "right"];

/// Names of the faces in 3D: elements run counter-clockwise seen from above.
pub(super) const SURFACE_FACES: [&str; 2] = ["upper", "lower"];

/// A node of a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkinNode<const D: usize> {
    /// The node of the middle that it goes with.
    pub owner: u32,
    /// Where it is from there at the start, m.
    pub arm: [f64; D],
}

impl<const D: usize> Mesh<D>
where
    Dim<D>: Meshed<D>,
{
    /// Nodes on a symmetry line (in 3D: plane), ascending.
    #[must_use]
    pub fn on_symmetry(&self, symmetry: &Symmetry) -> Vec<u32> {
        let Some(normal) = unit(first(symmetry.normal)) else { return Vec::new() };
        let (point, tolerance) = (first(symmetry.point), super::tolerance(&self.positions));
        let near = |&node: &u32| dot(minus(self.positions[node as usize], point), normal).abs() <= tolerance;
        let parts = self.parts.iter().filter(|part| symmetry.parts.is_empty() || symmetry.parts.contains(&part.name));
        super::sorted(parts.flat_map(PartMesh::with_faces).filter(near))
    }

    /// Number of the first node of a face: they come after all others.
    #[must_use]
    pub fn first_skin_node(&self) -> usize {
        self.positions.len() - self.skins.len()
    }

    /// Puts groups of elements of shells on the faces that they look from: the side from which the cells of
    /// a group run counter-clockwise, in 2D that on the left of its lines. Where a solid has the same piece
    /// it stays with the solid.
    pub(super) fn put_on_faces(&mut self, groups: &[(String, usize)]) {
        if groups.is_empty() {
            return;
        }
        let solids: BTreeSet<Facet<D>> = self.outside_of_solids(0..self.parts.len()).into_iter().map(Corners::canonical).collect();
        let mut faces: BTreeMap<Facet<D>, Facet<D>> = BTreeMap::new();
        let shells = self.groups.iter().filter(|group| !group.outer.is_empty());
        for (cell, outer) in shells.flat_map(|group| group.outer_cells().map(|(element, outer)| (group.cell(element), outer))) {
            let (below, above) = outer.nodes.split_at(cell.nodes.len());
            // In 2D the cell goes back along the left.
            let above: Vec<u32> = if D == 2 { above.iter().rev().copied().collect() } else { above.to_vec() };
            let [own, below, above] = [cell.nodes, below, &above].map(Facet::<D>::of_cell);
            let (Some(own), Some(below), Some(above)) = (own, below, above) else { continue };
            faces.insert(own.canonical(), above.canonical());
            faces.insert(own.reversed().canonical(), below.reversed().canonical());
        }
        for (name, place) in groups {
            let here = self.surfaces.get_mut(name).into_iter().flatten().filter(|(at, _)| at == place);
            for facet in here.flat_map(|(_, facets)| facets).filter(|facet| !solids.contains(&facet.canonical())) {
                *facet = faces.get(&facet.canonical()).copied().unwrap_or(*facet);
            }
        }
    }

    /// Thickness of a shell at a corner of its connectivity, m.
    fn thickness_of(&self, section: &ShellSection, group: usize, corner: usize) -> f64 {
        let given = self.thicknesses.get(group).and_then(|own| own.get(corner)).copied();
        given.unwrap_or_else(|| section.thickness_at(self.positions[self.groups[group].connectivity[corner] as usize]))
    }

    /// Shells whose thickness does not stay positive.
    pub(super) fn check_growth(&self, model: &Model, faults: &mut Vec<Fault>) {
        let grows = |section: &&ShellSection| section.thickness_field.is_empty();
        for (part, section) in model.parts.iter().enumerate().filter_map(|(part, it)| Some((part, it.section.as_ref().filter(grows)?))) {
            let nodes = self.groups.iter().filter(|group| group.part == part).flat_map(|group| &group.connectivity);
            let mut places = nodes.map(|&node| self.positions[node as usize]);
            if let Some(at) = places.find(|&place| section.thickness_at(place) <= 0.0) {
                let message = format!("the shell has a thickness of {:e} m at {} m", section.thickness_at(at), crate::vector::place(at));
                let help = "let it grow less, or take a larger `thickness`";
                faults.push(Fault::new(&SHELLS, format!("part[{part}].section.thickness_growth"), message, help));
            }
        }
    }

    /// Shells that are too thick where they are bent: one face folds over. Beams that are count where
    /// something may touch them.
    pub(super) fn check_thickness(&self, model: &Model, faults: &mut Vec<Fault>) {
        let shells = self.groups.iter().filter(|group| !group.outer.is_empty());
        for (part, group) in shells.map(|group| (group.part, group)) {
            let folded = group.outer_cells().find(|(_, cell)| self.what_is_wrong_with(*cell).is_some()).map(|(element, _)| element);
            let Some(element) = folded else { continue };
            if model.parts.get(part).is_some_and(Part::is_of_beams) {
                let (at, path) = (self.place_of(group.nodes_of(element)[0]), format!("part[{part}].profile"));
                if !(model.contacts.is_empty() && model.obstacles.is_empty()) && faults.iter().all(|fault| fault.path != path) {
                    let message = format!("the beam is too thick for its bend at {at} m: its outline folds over there");
                    let help = "take a smaller section, a larger radius, or longer elements";
                    faults.push(Fault::new(&BEAMS, path, message, help));
                }
                continue;
            }
            if let Some(element) =
                Some(element).filter(|_| faults.iter().all(|fault| fault.path != format!("part[{part}].section.thickness")))
            {
                let at = self.place_of(group.nodes_of(element)[0]);
                let message = format!("the shell is too thick for its bend or fold at {at} m: one of its faces folds over there");
                let help = "take a smaller thickness, a larger radius, or elements longer than half of the thickness at folds";
                faults.push(Fault::new(&SHELLS, format!("part[{part}].section.thickness"), message, help));
            }
        }
    }

    /// Joints of shells, where three or more elements meet, whose elements are all there.
    pub(super) fn whole_joints(&self) -> Vec<[u32; 2]> {
        let mut left = self.joints.clone();
        if left.is_empty() {
            return Vec::new();
        }
        let shells = self.groups.iter().filter(|group| !group.outer.is_empty());
        for place in shells.flat_map(ElementGroup::live_cells).flat_map(meeting_places) {
            if let Ok(at) = left.binary_search_by_key(&place, |joint| joint.0) {
                left[at].1 -= 1;
            }
        }
        left.into_iter().filter(|joint| joint.1 == 0).map(|joint| joint.0).collect()
    }

    /// Whether a piece of the outside bounds the hole between the faces of three or more elements at one of
    /// these joints: nothing comes there.
    pub(super) fn is_within_joint(&self, facet: Facet<D>, joints: &[[u32; 2]]) -> bool {
        if joints.is_empty() {
            return false;
        }
        let (first, mut ends) = (self.first_skin_node(), [u32::MAX, 0]);
        for &node in facet.corners() {
            let Some(skin) = (node as usize).checked_sub(first).and_then(|own| self.skins.get(own)) else { return false };
            ends = [ends[0].min(skin.owner), ends[1].max(skin.owner)];
        }
        let is_of_ends = |&node: &u32| ends.contains(&self.skins[node as usize - first].owner);
        joints.binary_search(&ends).is_ok() && facet.corners().iter().all(is_of_ends)
    }

    /// Normals of the symmetry lines (in 3D: planes) that each node is on.
    fn symmetry_normals(&self, model: &Model) -> BTreeMap<u32, Vec<[f64; D]>> {
        let mut normals: BTreeMap<u32, Vec<[f64; D]>> = BTreeMap::new();
        for symmetry in &model.symmetries {
            let Some(normal) = unit(first::<D>(symmetry.normal)) else { continue };
            self.on_symmetry(symmetry).into_iter().for_each(|node| normals.entry(node).or_default().push(normal));
        }
        if model.is_axisymmetric() {
            let tolerance = super::tolerance(&self.positions);
            let at_axis = (0..).zip(&self.positions).filter(|(_, x)| x[0].abs() <= tolerance);
            at_axis.for_each(|(node, _)| normals.entry(node).or_default().push(first([1.0, 0.0, 0.0])));
        }
        normals
    }

    /// Where a node is, in words.
    fn place_of(&self, node: u32) -> String {
        crate::vector::place(self.positions[node as usize])
    }

    /// Adds a node of a face.
    fn add_skin_node(&mut self, owner: u32, arm: [f64; D]) -> u32 {
        self.positions.push(plus(self.positions[owner as usize], arm));
        self.user_nodes.push(self.user_nodes.len() as u32);
        self.skins.push(SkinNode { owner, arm });
        self.positions.len() as u32 - 1
    }
}

/// Where an element of shells may meet others: its ends in 2D, each twice; the nodes of its edges in 3D,
/// ascending.
fn meeting_places(cell: Cell<'_>) -> impl Iterator<Item = [u32; 2]> {
    let is_surface = cell.kind.dimension() == 2;
    let ends = if is_surface { &[] } else { cell.nodes };
    let edges = cell.edges().filter(move |_| is_surface).map(|[a, b]| [a.min(b), a.max(b)]);
    ends.iter().map(|&node| [node; 2]).chain(edges)
}
