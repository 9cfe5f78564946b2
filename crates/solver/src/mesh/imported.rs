//! Parts that are groups of mesh files: their nodes and elements, swept and placed, and the names of the
//! files' groups.
//!
//! Files come from the model as they were read. A *place* is a file as some parts have it that are swept and
//! placed alike ([`Part::shares_nodes_with`]): these share nodes and groups, those of different places share
//! nothing.

use super::cell::CellKind;
use super::messages::GROUP;
use super::middles::{self, Middles};
use super::placement::{turn_over, turn_pieces_over};
use super::shapes::sweep::SweptMesh;
use super::surface::{self, Corners, Facet};
use super::{Dim, ElementGroup, Mesh, Meshed, PartMesh, sorted};
use crate::archive::persist_all;
use crate::error::Fault;
use crate::model::{ImportedMesh, Model, Part, Shape};
use std::collections::BTreeSet;

/// No number: no part has the node.
const NOWHERE: [u32; 2] = [u32::MAX, 0];

/// A mesh file where some parts have it: those that are swept and placed alike.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlacedMesh {
    /// Index of the file among the model's.
    pub file: usize,
    /// Its parts by index, ascending.
    pub parts: Vec<usize>,
    /// How many bodies there are of each part.
    pub copies: usize,
    /// Of each node of the file (of one that is swept, of what it became) the user's number in the first
    /// body, `u32::MAX` where no part has the node, and how much it grows from one body to the next.
    numbers: Vec<[u32; 2]>,
}

persist_all!(PlacedMesh { file, parts, copies, numbers });

impl PlacedMesh {
    /// The user's number of a node of the file in one of the bodies; `u32::MAX`: no part has it.
    #[must_use]
    pub fn number(&self, node: u32, copy: usize) -> u32 {
        match self.numbers.get(node as usize) {
            Some(&[first, step]) if first != u32::MAX => first.wrapping_add(step.wrapping_mul(copy as u32)),
            _ => u32::MAX,
        }
    }

    /// The user's numbers of all nodes of the file in one of the bodies; `u32::MAX`: no part has it.
    pub fn numbers(&self, copy: usize) -> impl Iterator<Item = u32> + '_ {
        (0..self.numbers.len() as u32).map(move |node| self.number(node, copy))
    }

    /// Gives its nodes the numbers that they have after some are gone; `None`: it is one of these.
    pub(super) fn close_up(&mut self, number: impl Fn(u32) -> Option<u32>) {
        for own in self.numbers.iter_mut().filter(|own| own[0] != u32::MAX) {
            *own = number(own[0]).map_or(NOWHERE, |first| [first, own[1]]);
        }
    }

    /// Whether all numbers are below that of the nodes, and all parts are there.
    pub(super) fn is_sound(&self, nodes: usize, parts: usize) -> bool {
        let is_node = |&[first, step]: &[u32; 2]| {
            let last = self.copies.checked_sub(1).and_then(|copies| (step as usize).checked_mul(copies)?.checked_add(first as usize));
            first == u32::MAX || last.is_some_and(|last| last < nodes)
        };
        self.parts.iter().all(|&part| part < parts) && self.numbers.iter().all(is_node)
    }
}

impl<const D: usize> Mesh<D>
where
    Dim<D>: Meshed<D>,
{
    /// Adds a part that is a group of a mesh file; `swept` has what the files of places became that are
    /// swept.
    pub(super) fn add_imported(&mut self, model: &Model, index: usize, swept: &mut Vec<Option<SweptMesh>>, faults: &mut Vec<Fault>) {
        let part = &model.parts[index];
        let Shape::Group { mesh: file, group } = &part.shape else { return };
        let first = model.first_sharing(index);
        let place = self.placed.iter().position(|it| it.parts[0] == first).unwrap_or_else(|| {
            self.placed.push(PlacedMesh { file: *file, copies: part.placement.count(), ..PlacedMesh::default() });
            swept.push(part.sweep.as_ref().map(|_| swept_mesh(model, index, faults)));
            self.placed.len() - 1
        });
        self.placed[place].parts.push(index);
        match &swept[place] {
            None => self.add_group(&model.meshes[*file], group, part, place, faults),
            // Its fault is reported.
            Some(made) if made.mesh.positions.is_empty() => self.parts.push(PartMesh { name: part.name.clone(), ..PartMesh::default() }),
            Some(made) => {
                self.add_group(&made.mesh, group, part, place, faults);
                self.name_ends(made, group, part, place);
            }
        }
    }

    /// Adds the cells of a group of a file in a place.
    fn add_group(&mut self, source: &ImportedMesh, group: &str, part: &Part, place: usize, faults: &mut Vec<Fault>) {
        let dimension = match part {
            part if part.is_of_lines() => 1,
            part if part.is_of_sheets() => 2,
            _ => D as u8,
        };
        let Some(group) = source.groups.iter().find(|g| g.name == group && g.dimension == dimension) else {
            let kind = ["zero", "one", "two", "three"][usize::from(dimension)];
            let message = format!("{} has no {kind}-dimensional group \"{group}\"", source.source);
            faults.push(Fault::new(&GROUP, format!("part[{}]", self.parts.len()), message, "name a group of the mesh file"));
            self.parts.push(PartMesh { name: part.name.clone(), ..PartMesh::default() });
            return;
        };
        // Of cells with nodes between corners a part may want the corners alone.
        let is_straight = part.named_element_in(D, middles::of_first_order(D)).is_some();
        let elements = || group.elements().flatten().map(|cell| if is_straight { cell.of_corners() } else { cell });
        let mut placed = std::mem::take(&mut self.placed[place]);
        placed.numbers.resize(source.positions.len(), NOWHERE);
        let (first, mut new) = (self.positions.len() as u32, Vec::new());
        for &node in elements().flat_map(|cell| cell.nodes) {
            let number = &mut placed.numbers[node as usize];
            if *number == NOWHERE {
                number[0] = first + new.len() as u32;
                new.push(node);
            }
        }
        for &node in &new {
            placed.numbers[node as usize][1] = new.len() as u32;
        }
        for copy in 0..placed.copies {
            let from = self.positions.len();
            self.positions.extend(new.iter().map(|&node| Dim::<D>::of_3d(source.positions[node as usize])));
            part.placement.place(&mut self.positions[from..], copy);
        }
        let cells = (0..placed.copies).flat_map(|copy| elements().map(move |cell| (copy, cell)));
        self.add_elements_of_bodies(cells, part.placement.mirror.is_some(), |node, copy| placed.number(node, copy));
        let nodes = (0..placed.copies).flat_map(|copy| elements().flat_map(|cell| cell.nodes).map(move |&node| (node, copy)));
        let nodes = sorted(nodes.map(|(node, copy)| placed.number(node, copy)));
        self.parts.push(PartMesh { name: part.name.clone(), nodes, faces: Vec::new() });
        self.placed[place] = placed;
    }

    /// Names the two ends of a part that was swept: facets of a solid, nodes of a sheet.
    fn name_ends(&mut self, made: &SweptMesh, group: &str, part: &Part, place: usize) {
        let (Some(sweep), placed) = (&part.sweep, &self.placed[place]) else { return };
        for (_, ends) in made.ends.iter().filter(|(name, _)| name == group) {
            for (side, facets) in sweep.sides().into_iter().zip(ends) {
                let cells = || facets.iter().filter_map(|facet| Facet::<D>::of_cell(facet.corners()));
                let copies = (0..placed.copies).flat_map(|copy| cells().map(move |facet| (facet, copy)));
                let mut facets: Vec<Facet<D>> = copies.map(|(facet, copy)| facet.renamed(|node| placed.number(node, copy))).collect();
                if part.placement.mirror.is_some() {
                    turn_pieces_over(&mut facets);
                }
                self.sides.insert(format!("{}.{side}", part.name), facets);
            }
        }
        for (_, rims) in made.rims.iter().filter(|(name, _)| name == group) {
            for (side, nodes) in sweep.sides().into_iter().zip(rims) {
                let copies = (0..placed.copies).flat_map(|copy| nodes.iter().map(move |&node| placed.number(node, copy)));
                self.points.insert(format!("{}.{side}", part.name), sorted(copies));
            }
        }
    }

    /// Names the groups of a place's file. Returns those that lie on shells, if only in part, with the place:
    /// their pieces are those of the middle until there are faces ([`Self::put_on_faces`]).
    pub(super) fn add_named_groups(&mut self, model: &Model, place: usize, swept: Option<&SweptMesh>) -> Vec<(String, usize)> {
        let placed = &self.placed[place];
        let source = swept.map_or(&*model.meshes[placed.file], |made| &made.mesh);
        let is_mirrored = placed.parts.first().is_some_and(|&part| model.parts[part].placement.mirror.is_some());
        let is_shell = |group: &&ElementGroup| model.parts[group.part].is_of_shells() && group.kind.dimension() + 1 == D;
        let shells = placed.parts.iter().flat_map(|&part| self.groups_of(part)).filter(is_shell);
        let middle = shells.flat_map(ElementGroup::cells).filter_map(|cell| Facet::<D>::of_cell(cell.nodes));
        let middle: Vec<Facet<D>> = middle.flat_map(|facet| [facet.canonical(), facet.reversed().canonical()]).collect();
        let mut outside = self.outside_of_solids(placed.parts.iter().copied());
        outside.extend(&middle);
        let middle: BTreeSet<Facet<D>> = middle.into_iter().collect();
        let between = Middles::of_mesh(self.groups.iter());
        let (mut surfaces, mut sets, mut on_shells) = (Vec::new(), Vec::new(), Vec::new());
        for group in &source.groups {
            if group.cells.iter().flatten().any(|&node| placed.number(node, 0) == u32::MAX) {
                continue; // a group of something that no part uses here
            }
            let kind = |cell: &Vec<u32>| CellKind::of(group.dimension.into(), cell.len()).filter(|_| is_mirrored);
            let number = |(copy, cell): (usize, &Vec<u32>)| {
                let mut nodes: Vec<u32> = cell.iter().map(|&node| placed.number(node, copy)).collect();
                kind(cell).into_iter().for_each(|kind| turn_over::<D>(kind, &mut nodes));
                nodes
            };
            let cells = || (0..placed.copies).flat_map(|copy| group.cells.iter().map(move |cell| (copy, cell))).map(number);
            let facets = if usize::from(group.dimension) + 1 == D {
                cells()
                    .map(|nodes| Some(between.divided::<D>(Facet::<D>::of_cell(&nodes)?)))
                    .collect::<Option<Vec<_>>>()
                    .map(|facets| facets.concat())
            } else {
                None
            };
            match facets.map(|facets| surface::oriented(&facets, &outside)) {
                Some(Ok(facets)) => {
                    on_shells.extend(facets.iter().any(|facet| middle.contains(facet)).then(|| (group.name.clone(), place)));
                    surfaces.push((group.name.clone(), facets));
                }
                // A line inside a body, and what is not on one, is no surface, but still a set of nodes.
                _ => sets.push((group.name.clone(), sorted(cells().flatten()))),
            }
        }
        surfaces.into_iter().for_each(|(name, facets)| self.surfaces.entry(name).or_default().push((place, facets)));
        sets.into_iter().for_each(|(name, nodes)| self.sets.entry(name).or_default().push((place, nodes)));
        on_shells
    }

    /// Outside of each of these parts whose elements bound bodies as they are.
    pub(super) fn outside_of_solids(&self, parts: impl Iterator<Item = usize>) -> Vec<Facet<D>> {
        let bodies = |part| self.groups_of(part).filter(|group| group.kind.dimension() == D);
        let outside_of = |part| surface::exterior::<D>(bodies(part).flat_map(ElementGroup::cells)).ok();
        parts.filter_map(outside_of).flatten().collect()
    }

    /// The place of `part.group`, and its group.
    pub(super) fn group_in_place<'n>(&self, name: &'n str) -> Option<(usize, &'n str)> {
        let (part, group) = name.split_once('.')?;
        let part = self.parts.iter().position(|it| it.name == part)?;
        Some((self.placed.iter().position(|place| place.parts.contains(&part))?, group))
    }
}

/// What a part's mesh file in 2D becomes by its sweep; nothing where there is a fault.
fn swept_mesh(model: &Model, index: usize, faults: &mut Vec<Fault>) -> SweptMesh {
    let part = &model.parts[index];
    let (Shape::Group { mesh, .. }, Some(sweep)) = (&part.shape, &part.sweep) else { return SweptMesh::default() };
    let alike = model.parts.iter().filter(|other| other.shares_nodes_with(part));
    let wanted: Vec<&str> = alike.filter_map(|other| other.shape.group_of(*mesh)).collect();
    sweep.swept_mesh(&model.meshes[*mesh], &wanted).unwrap_or_else(|wrong| {
        let Fault { path: at, kind, message, help, .. } = wrong.at(sweep.key());
        faults.push(Fault::new(kind, format!("part[{index}].{at}"), message, help));
        SweptMesh::default()
    })
}

/// The one of a name, where there is one in one place alone.
pub(super) fn only<T>(named: Option<&Vec<(usize, T)>>) -> Option<&T> {
    match named.map(Vec::as_slice) {
        Some([(_, one)]) => Some(one),
        _ => None,
    }
}

/// The one of a name in a place.
pub(super) fn within<T>(named: Option<&Vec<(usize, T)>>, place: usize) -> Option<&T> {
    named?.iter().find(|(at, _)| *at == place).map(|(_, one)| one)
}
