//! The mesh: nodes, element groups, surfaces and sets, made from the shapes and mesh files of a model.
//!
//! [`Mesh::new`] puts the bodies of a model side by side with one node numbering; names (`part`, `part.side`,
//! groups of a mesh file) are resolved to nodes and surfaces here and nowhere else.

pub mod cell;
pub mod geometry;
pub(crate) mod kinematics;
pub mod placement;
pub mod shapes;
pub(crate) mod messages;
pub mod surface;
mod dimension;
mod imported;
pub(crate) mod locate;
mod middles;
mod order;
mod persist;
pub(crate) mod relocated;
pub(crate) mod remeshed;
mod skin;
mod thickness;

pub use dimension::{Meshed, signed_volume};
pub use imported::PlacedMesh;
pub use skin::SkinNode;

use crate::error::Fault;
use crate::forest;
use crate::mesh::messages::{BAD_ELEMENT, TOO_MANY};
use crate::model::messages::{NOTHING, UNKNOWN_NAME};
use crate::model::{MeshGroup, Model, Part, Shape};
use crate::tensor::Dim;
use crate::vector::{minus, plus, times};
use cell::{Cell, CellKind, MOST_NODES};
use imported::{only, within};
use placement::turn_over;
use shapes::Body;
use std::collections::BTreeMap;
use surface::{Corners, Facet, Surface};

/// Places of a model that are nearer to each other than this fraction of its extent are the same, and this
/// one of its farthest coordinate: so much they round.
const SAME_PLACE: f64 = 1e-9;
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Distance below which places of a model are the same, m: wherever it is.
#[must_use]
pub fn tolerance<const D: usize>(positions: &[[f64; D]]) -> f64 {
    let farthest = positions.iter().flatten().fold(0.0f64, |size, x| size.max(x.abs()));
    SAME_PLACE * extent(positions) + ROUNDING * farthest
}

/// Longest side of the box around places, m.
#[must_use]
pub fn extent<const D: usize>(positions: &[[f64; D]]) -> f64 {
    let along = |d: usize| {
        let all = || positions.iter().map(move |x| x[d]).filter(|x| x.is_finite());
        (all().fold(f64::NEG_INFINITY, f64::max) - all().fold(f64::INFINITY, f64::min)).max(0.0)
    };
    (0..D).map(along).fold(0.0, f64::max)
}

impl MeshGroup {
    /// Each of its cells; `None` for one that has a number of nodes that no cell of its dimension has.
    pub fn elements(&self) -> impl Iterator<Item = Option<Cell<'_>>> + Clone {
        self.cells.iter().map(|nodes| Cell::of(self.dimension.into(), nodes))
    }
}

/// A part: its nodes. Its elements are in one or more [`ElementGroup`]s.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PartMesh {
    /// Name of the part.
    pub name: String,
    /// All nodes of the part in the order of its mesh.
    pub nodes: Vec<u32>,
    /// Of shells and beams the nodes on their faces, ascending: these go with the others.
    pub faces: Vec<u32>,
}

impl PartMesh {
    /// Its nodes, those on the faces of shells and beams too.
    pub fn with_faces(&self) -> impl Iterator<Item = u32> + Clone {
        self.nodes.iter().chain(&self.faces).copied()
    }
}

/// The elements of one part that are the same kind of cell: what a block is made of.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ElementGroup {
    /// Index of the part.
    pub part: usize,
    /// Which kind of cell they are.
    pub kind: CellKind,
    /// Node indices, as many per element as its kind has.
    pub connectivity: Vec<u32>,
    /// The user's number of each element: its place in the part as it was made or read, whatever its kind.
    pub user_elements: Vec<u32>,
    /// Of shells the nodes of each element on its faces: those of the cell between them, which bounds the
    /// body; of beams those of the cells that its cross-section sweeps. Empty of others.
    pub outer: Vec<u32>,
    /// Of beams the kind of these cells, and which of them come from each element: those from its number here
    /// to the next one. Empty of others, which have one for each.
    pub pieces: Pieces,
    /// Whether each element has been eroded: then it is no part of surfaces and bodies. Empty while all are
    /// there.
    pub eroded: Vec<bool>,
}

/// See [`ElementGroup::pieces`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pieces {
    kind: CellKind,
    firsts: Vec<u32>,
}

impl ElementGroup {
    /// No elements yet.
    fn new(part: usize, kind: CellKind) -> Self {
        Self { part, kind, ..Self::default() }
    }

    /// Number of elements.
    #[must_use]
    pub fn elements(&self) -> usize {
        self.user_elements.len()
    }

    /// Each element.
    pub fn cells(&self) -> impl Iterator<Item = Cell<'_>> + Clone {
        self.kind.cells(&self.connectivity)
    }

    /// Each element that has not been eroded.
    pub fn live_cells(&self) -> impl Iterator<Item = Cell<'_>> + Clone {
        self.cells().enumerate().filter(|(element, _)| self.is_alive(*element)).map(|(_, cell)| cell)
    }

    /// Kind and nodes of its elements as bodies have them: those of shells with their thickness, of beams
    /// with their cross-section.
    fn outer_cell_nodes(&self) -> (CellKind, &[u32]) {
        match (self.outer.is_empty(), self.pieces.firsts.is_empty()) {
            (_, false) => (self.pieces.kind, &self.outer),
            (true, _) => (self.kind, &self.connectivity),
            (false, _) => (self.kind.thickened(), &self.outer),
        }
    }

    /// Which cells an element is as bodies have it.
    fn pieces_of(&self, element: usize) -> std::ops::Range<usize> {
        match self.pieces.firsts.get(element..element + 2) {
            Some(&[first, next]) => first as usize..next as usize,
            _ => element..element + 1,
        }
    }

    /// An element as bodies have it: itself, of shells the cell between both faces, of beams those of its
    /// cross-section, if it has any.
    pub fn outer_cells_of(&self, element: usize) -> impl Iterator<Item = Cell<'_>> + Clone {
        let (kind, nodes) = self.outer_cell_nodes();
        let pieces = self.pieces_of(element);
        kind.cells(&nodes[pieces.start * kind.nodes()..pieces.end * kind.nodes()])
    }

    /// Each element as bodies have it, with its number.
    pub fn outer_cells(&self) -> impl Iterator<Item = (usize, Cell<'_>)> + Clone {
        (0..self.elements()).flat_map(|element| self.outer_cells_of(element).map(move |cell| (element, cell)))
    }

    /// Each such cell that has not been eroded.
    pub fn live_outer_cells(&self) -> impl Iterator<Item = Cell<'_>> + Clone {
        self.outer_cells().filter(|(element, _)| self.is_alive(*element)).map(|(_, cell)| cell)
    }

    /// An element as it is shown: as bodies have it; of beams without an outline a line.
    pub fn shown_cells_of(&self, element: usize) -> impl Iterator<Item = Cell<'_>> + Clone {
        let is_line = self.pieces_of(element).is_empty();
        self.outer_cells_of(element).chain(is_line.then(|| self.cell(element)))
    }

    /// How many cells an element is as it is shown.
    #[must_use]
    pub fn shown(&self, element: usize) -> usize {
        self.pieces_of(element).len().max(1)
    }

    /// Whether its elements bound a body in so many dimensions: surfaces in 2D, volumes in 3D, shells with
    /// their thickness and beams with their cross-section; no bars.
    #[must_use]
    pub fn is_body(&self, dimension: usize) -> bool {
        self.outer_cell_nodes().0.dimension() == dimension
    }

    /// Whether an element has not been eroded.
    #[must_use]
    pub fn is_alive(&self, element: usize) -> bool {
        !self.eroded.get(element).copied().unwrap_or(false)
    }

    /// Takes an element out of surfaces and bodies.
    pub fn erode(&mut self, element: usize) {
        self.eroded.resize(self.elements(), false);
        self.eroded[element] = true;
    }

    /// An element.
    #[must_use]
    pub fn cell(&self, element: usize) -> Cell<'_> {
        self.kind.cell(self.nodes_of(element))
    }

    /// Nodes of an element.
    #[must_use]
    pub fn nodes_of(&self, element: usize) -> &[u32] {
        let nodes = self.kind.nodes();
        &self.connectivity[element * nodes..][..nodes]
    }
}

/// The bodies of a model in one node numbering.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh<const D: usize>
where
    Dim<D>: Meshed<D>,
{
    /// Initial node positions, m.
    pub positions: Vec<[f64; D]>,
    /// Parts in model order.
    pub parts: Vec<PartMesh>,
    /// Elements: part by part, of each part those of the kind with the most nodes first.
    pub groups: Vec<ElementGroup>,
    /// The user's number of each node: its place in the parts as they were made or read.
    pub user_nodes: Vec<u32>,
    /// Where mesh files are, in the order of their first parts.
    pub placed: Vec<PlacedMesh>,
    /// How many times its cells have been replaced by others; 0: they are those of the model.
    pub revision: u32,
    /// Parts whose elements were made again in the run.
    pub(crate) remeshed: remeshed::Remeshed<D>,
    /// Nodes on the faces of shells and beams: the last ones of all.
    pub skins: Vec<SkinNode<D>>,
    /// Label of each node as far as beams are near: what has the same label belongs to the same joint and
    /// does not touch; [`surface::NONE`]: no label. Empty without beams.
    pub(crate) kin: Vec<u32>,
    /// Joints: where three or more elements of shells meet, ascending, and how many. A node twice in 2D, the
    /// nodes of an edge in 3D.
    pub(super) joints: Vec<([u32; 2], u32)>,
    /// Of each group of shells the directions of the nodes of each element: tangents in 2D, normals in 3D.
    pub directions: Vec<Vec<[f64; D]>>,
    /// Of each group of shells whose thickness a mesh file gives that of the corners of each element, m; else
    /// empty, as the whole list without such groups.
    pub thicknesses: Vec<Vec<f64>>,
    /// Whether each node, in the order of the curve that they are sorted along, is on an outline: those are
    /// numbered first.
    outlines: Vec<bool>,
    /// Named pieces of the outside, by `part.side`.
    sides: BTreeMap<String, Vec<Facet<D>>>,
    /// Named nodes, by `part.side`.
    points: BTreeMap<String, Vec<u32>>,
    /// Groups of mesh files that are pieces of the outside, by their names: of lines in 2D, of surfaces in
    /// 3D, each with the place where it is.
    surfaces: BTreeMap<String, Vec<(usize, Vec<Facet<D>>)>>,
    /// Nodes of all other groups.
    sets: BTreeMap<String, Vec<(usize, Vec<u32>)>>,
}

/// At most so many faults of one kind are reported one by one.
const REPORTED_MAX: usize = 20;

impl<const D: usize> Mesh<D>
where
    Dim<D>: Meshed<D>,
{
    /// The mesh of a model whose references have been checked.
    ///
    /// # Errors
    /// All faults: elements of a wrong shape or turned inside out, lines that bound no element, nodes of
    /// nothing.
    pub fn new(model: &Model) -> Result<Self, Vec<Fault>> {
        let mut mesh = Self::default();
        let mut faults = Vec::new();
        let mut swept = Vec::new();
        for (index, part) in model.parts.iter().enumerate() {
            match &part.shape {
                Shape::Group { mesh: file, .. } if *file < model.meshes.len() => mesh.add_imported(model, index, &mut swept, &mut faults),
                Shape::Group { .. } => faults.push(Fault::new(&UNKNOWN_NAME, format!("part[{index}]"), "its mesh was not read", "")),
                _ => mesh.add_shape(part, &mut faults),
            }
            mesh.check_elements(index, &mut faults);
        }
        let mut on_shells = Vec::new();
        for (place, swept) in swept.iter().enumerate() {
            on_shells.extend(mesh.add_named_groups(model, place, swept.as_ref()));
        }
        if mesh.positions.len() > u32::MAX as usize - 1 {
            faults.push(Fault::new(&TOO_MANY, "", "the model has more than 4 billion nodes", "make it smaller"));
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        mesh.add_middles(model, &mut faults);
        if !faults.is_empty() {
            return Err(faults);
        }
        mesh.reorder(|part| model.parts[part].has_rotations());
        mesh.take_thicknesses(model, &mut faults);
        mesh.check_growth(model, &mut faults);
        if !faults.is_empty() {
            return Err(faults);
        }
        Dim::<D>::add_skins(&mut mesh, model);
        mesh.put_on_faces(&on_shells);
        mesh.check_thickness(model, &mut faults);
        if faults.is_empty() { Ok(mesh) } else { Err(faults) }
    }

    fn add_shape(&mut self, part: &Part, faults: &mut Vec<Fault>) {
        match Dim::<D>::body(part) {
            Some(Ok(body)) => self.add_body(&part.name, body),
            Some(Err(fault)) => {
                faults.push(Fault { path: format!("part[{}].{}", self.parts.len(), fault.path), ..fault });
                self.parts.push(PartMesh { name: part.name.clone(), ..PartMesh::default() });
            }
            None => {}
        }
    }

    fn add_body(&mut self, part: &str, body: Body<D>) {
        let first = self.positions.len() as u32;
        self.positions.extend(&body.positions);
        self.add_elements(body.cells(), |node| node + first);
        self.parts.push(PartMesh { name: part.into(), nodes: (first..first + body.positions.len() as u32).collect(), faces: Vec::new() });
        for (side, facets) in body.sides {
            let facets = facets.into_iter().map(|facet| facet.renamed(|node| node + first)).collect();
            self.sides.insert(format!("{part}.{side}"), facets);
        }
        for (name, nodes) in body.points {
            self.points.insert(format!("{part}.{name}"), sorted(nodes.into_iter().map(|node| node + first)));
        }
    }

    /// Adds the elements of the part that comes next, in the user's order; `number` is the mesh's number of a
    /// node.
    fn add_elements<'c>(&mut self, cells: impl Iterator<Item = Cell<'c>>, number: impl Fn(&u32) -> u32) {
        self.add_elements_of_bodies(cells.map(|cell| (0, cell)), false, |node, _| number(&node));
    }

    /// The same of several bodies, each element with the body that it is in, from 0. Those that are mirrored
    /// are turned over.
    fn add_elements_of_bodies<'c>(
        &mut self,
        cells: impl Iterator<Item = (usize, Cell<'c>)>,
        is_mirrored: bool,
        number: impl Fn(u32, usize) -> u32,
    ) {
        let part = self.parts.len();
        let mut groups: Vec<ElementGroup> = Vec::new();
        for (user, (copy, cell)) in (0..).zip(cells) {
            let at = groups.iter().position(|group| group.kind == cell.kind).unwrap_or_else(|| {
                groups.push(ElementGroup::new(part, cell.kind));
                groups.len() - 1
            });
            let nodes = &mut groups[at].connectivity;
            let first = nodes.len();
            nodes.extend(cell.nodes.iter().map(|&node| number(node, copy)));
            if is_mirrored {
                turn_over::<D>(cell.kind, &mut nodes[first..]);
            }
            groups[at].user_elements.push(user);
        }
        groups.sort_by_key(|group| std::cmp::Reverse((group.kind.nodes(), group.kind)));
        self.groups.extend(groups);
    }

    /// Elements of a part.
    pub fn groups_of(&self, part: usize) -> impl Iterator<Item = &ElementGroup> + Clone {
        self.groups.iter().filter(move |group| group.part == part)
    }

    /// Number of elements of a part.
    #[must_use]
    pub fn elements_of(&self, part: usize) -> usize {
        self.groups_of(part).map(ElementGroup::elements).sum()
    }

    /// Each element that bounds a body of the parts (all when `parts` is empty) that has not been eroded.
    fn cells(&self, parts: &[String]) -> impl Iterator<Item = Cell<'_>> + Clone {
        let is_of = move |group: &&ElementGroup| group.is_body(D) && (parts.is_empty() || parts.contains(&self.parts[group.part].name));
        self.groups.iter().filter(is_of).flat_map(ElementGroup::live_outer_cells)
    }

    /// Every element must have a form that it can be computed with; see [`Meshed::wrong_form`].
    fn check_elements(&self, part: usize, faults: &mut Vec<Fault>) {
        let Some(PartMesh { name, .. }) = self.parts.get(part) else { return };
        let cells = self.groups_of(part).flat_map(|group| group.user_elements.iter().zip(group.cells()));
        let mut bad: Vec<(u32, &[u32], [&str; 2])> =
            cells.filter_map(|(&user, cell)| Some((user, cell.nodes, self.what_is_wrong_with(cell)?))).collect();
        bad.sort_unstable();
        for &(user, cell, [wrong, help]) in bad.iter().take(REPORTED_MAX) {
            let place = self.positions[cell[0] as usize].map(|x| format!("{x:.6e}")).join(", ");
            let message = format!("element {user} of part \"{name}\" at ({place}) {wrong}");
            faults.push(Fault::new(&BAD_ELEMENT, format!("part[{part}]"), message, help).at([self.positions[cell[0] as usize]]));
        }
        if bad.len() > REPORTED_MAX {
            faults.push(Fault::new(
                &BAD_ELEMENT,
                format!("part[{part}]"),
                format!("and {} more elements like these", bad.len() - REPORTED_MAX),
                "",
            ));
        }
        if self.elements_of(part) == 0 && faults.is_empty() {
            faults.push(Fault::new(&NOTHING, format!("part[{part}]"), format!("part \"{name}\" has no elements"), "give it some"));
        }
    }

    /// What is wrong with the form of an element, if anything, and what to do about it.
    fn what_is_wrong_with(&self, cell: Cell<'_>) -> Option<[&'static str; 2]> {
        let mut places = [[0.0; D]; MOST_NODES];
        cell.nodes.iter().zip(&mut places).for_each(|(&node, place)| *place = self.positions[node as usize]);
        Dim::<D>::wrong_form(cell.kind, &places[..cell.nodes.len()])
    }

    /// Elements that are degenerate or not convex, after nodes have been moved.
    #[must_use]
    pub fn faults_of_elements(&self) -> Vec<Fault> {
        let mut faults = Vec::new();
        (0..self.parts.len()).for_each(|part| self.check_elements(part, &mut faults));
        faults
    }

    /// Of a node on the face of a shell or beam that of the middle which leads it; others lead themselves.
    #[must_use]
    pub fn leader_of(&self, node: u32) -> u32 {
        let own = (node as usize).checked_sub(self.first_skin_node());
        own.and_then(|own| self.skins.get(own)).map_or(node, |skin| skin.owner)
    }

    /// Nodes on faces that these nodes (ascending) lead.
    pub(crate) fn faces_of<'a>(&'a self, nodes: &'a [u32]) -> impl Iterator<Item = u32> + 'a {
        let all = (self.first_skin_node() as u32..).zip(&self.skins);
        all.filter(|(_, skin)| nodes.binary_search(&skin.owner).is_ok()).map(|(node, _)| node)
    }

    /// Nodes of a part, a group, a `part.side` or a `part.group`, ascending; of the face of a shell those of
    /// its middle, which lead it. `None` when there is no such name, or groups in several places have it.
    #[must_use]
    pub fn nodes(&self, name: &str) -> Option<Vec<u32>> {
        if let Some(part) = self.parts.iter().find(|part| part.name == name) {
            return Some(sorted(part.nodes.iter().copied()));
        }
        let leaders = |facets: &Vec<Facet<D>>| sorted(facets.iter().flat_map(Corners::corners).map(|&node| self.leader_of(node)));
        let group = || only(self.surfaces.get(name)).map(leaders).or_else(|| only(self.sets.get(name)).cloned());
        let side = || self.sides.get(name).map(leaders).or_else(|| self.points.get(name).cloned());
        group().or_else(side).or_else(|| {
            let (place, group) = self.group_in_place(name)?;
            within(self.surfaces.get(group), place).map(leaders).or_else(|| within(self.sets.get(group), place).cloned())
        })
    }

    /// Mean of the places of nodes at the start, m; seen from the first of them, so that far from the origin
    /// no digits are lost.
    pub(crate) fn mean_place(&self, nodes: &[u32]) -> [f64; D] {
        let Some(from) = nodes.first().map(|&node| self.positions[node as usize]) else { return [0.0; D] };
        let sum = nodes.iter().fold([0.0; D], |sum, &node| plus(sum, minus(self.positions[node as usize], from)));
        plus(from, times(1.0 / nodes.len() as f64, sum))
    }

    /// Whether each node has an element that has not been eroded.
    pub(crate) fn has_elements(&self) -> Vec<bool> {
        let mut has_elements = vec![false; self.positions.len()];
        let cells = self.groups.iter().flat_map(|group| group.live_cells().chain(group.live_outer_cells()));
        cells.flat_map(|cell| cell.nodes).for_each(|&node| has_elements[node as usize] = true);
        has_elements
    }

    /// Body of each node, from 0: what is joined by elements, of whatever parts, is one body. Bodies are
    /// numbered by their lowest nodes.
    #[must_use]
    pub fn bodies(&self) -> Vec<u32> {
        let mut root: Vec<u32> = (0..self.positions.len() as u32).collect();
        let first = self.first_skin_node() as u32;
        let faces: Vec<[u32; 2]> = (first..).zip(&self.skins).map(|(node, skin)| [node, skin.owner]).collect();
        let cells = self.groups.iter().flat_map(ElementGroup::live_cells).flat_map(|cell| cell.nodes.windows(2));
        for pair in cells.chain(faces.iter().map(|pair| &pair[..])) {
            forest::join(&mut root, pair[0], pair[1]);
        }
        let mut count = 0;
        let mut numbers = vec![0; root.len()];
        for node in 0..root.len() as u32 {
            let first = forest::root(&mut root, node);
            numbers[node as usize] = if first == node { count } else { numbers[first as usize] };
            count += u32::from(first == node);
        }
        numbers
    }

    /// Outside of some parts together (all when `parts` is empty): what lies between two of them is inside.
    ///
    /// # Errors
    /// A fault without path when elements overlap.
    pub fn outside(&self, parts: &[String]) -> Result<Surface<D>, Fault> {
        self.outside_without(parts, |_| false)
    }

    /// The same without the segments or facets that `leave_out` names (those on a symmetry, which are no
    /// outside of the whole body).
    ///
    /// # Errors
    /// As [`Mesh::outside`].
    pub fn outside_without(&self, parts: &[String], leave_out: impl Fn(Facet<D>) -> bool) -> Result<Surface<D>, Fault> {
        let joints = self.whole_joints();
        // In order: who is asked may count.
        Dim::<D>::outside_without(self.cells(parts), |facet| leave_out(facet) | self.is_within_joint(facet, &joints))
    }

    /// Surface of a part (its whole outside), a `part.side`, or a group of lines (in 3D of surfaces) as
    /// `group` or `part.group`, without the segments or facets that `leave_out` names (those on a symmetry,
    /// which are no outside of the whole body).
    ///
    /// # Errors
    /// A fault without path when there is no such surface.
    pub fn surface(&self, name: &str, leave_out: impl Fn(Facet<D>) -> bool) -> Result<Surface<D>, Fault> {
        let only_part = |name: &str| [name.to_string()];
        let is_part = |name: &str| self.parts.iter().any(|part| part.name == name);
        if is_part(name) {
            return self.outside_without(&only_part(name), leave_out);
        }
        let owner = || name.split_once('.').map(|(part, _)| part).filter(|part| is_part(part));
        let side = only(self.surfaces.get(name)).or_else(|| self.sides.get(name));
        let side = side.map(|side| (side, owner().map_or(Vec::new(), |part| only_part(part).to_vec())));
        let Some((side, of)) = side.or_else(|| self.surface_in_place(name)) else {
            let help = match D {
                2 => "name a part, a side as part.side, or a one-dimensional group of a mesh file",
                _ => "name a part, a side as part.side, or a two-dimensional group of a mesh file",
            };
            return Err(Fault::new(&UNKNOWN_NAME, "", format!("there is no surface \"{name}\""), help));
        };
        let mut facets = side.clone();
        if self.groups.iter().any(|group| !group.eroded.is_empty()) {
            let mut outside = surface::exterior::<D>(self.cells(&of))?;
            outside.sort_unstable();
            facets.retain(|facet| outside.binary_search(facet).is_ok());
        }
        facets.retain(|&facet| !leave_out(facet));
        Dim::<D>::surface(facets, self.cells(&of))
    }

    /// The pieces of `part.group`, and the parts that share the nodes of the group.
    fn surface_in_place(&self, name: &str) -> Option<(&Vec<Facet<D>>, Vec<String>)> {
        let (place, group) = self.group_in_place(name)?;
        let parts = self.placed[place].parts.iter().map(|&part| self.parts[part].name.clone()).collect();
        Some((within(self.surfaces.get(group), place)?, parts))
    }
}

fn sorted(nodes: impl Iterator<Item = u32>) -> Vec<u32> {
    let mut nodes: Vec<u32> = nodes.collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}
