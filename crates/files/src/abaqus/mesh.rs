//! From the geometry of a deck to a mesh in 2D or 3D: names of groups, dense node numbers, the
//! checks of positions.
//!
//! [`super::parse`] calls [`mesh`]; the import asks [`names`] how sets are called in the mesh.

use super::deck::{Deck, Element, Surface};
use super::text::Text;
use crate::abaqus::messages::DECK_MESH;
use crate::gmsh::faults::Faults;
use crate::gmsh::form;
use crate::gmsh::messages::{CELL, NODE};
use embate_solver::error::Fault;
use embate_solver::mesh::signed_volume;
use embate_solver::model::{FieldValues, ImportedMesh, MeshField, MeshGroup};
use std::collections::{BTreeMap, BTreeSet};

/// Distance from the plane z = 0, as a fraction of the mesh's size, that still counts as on it.
const OFF_PLANE: f64 = 1e-9;

/// What the field of *NODAL THICKNESS is called.
pub(super) const NODAL_THICKNESS: &str = "nodal_thickness";

/// What the group of the members of a set is called that are of a lower dimension than others.
const LOWER: [&str; 3] = ["elements", "lines", "surfaces"];

/// Names of groups by the full names (in capitals) of what they stand for.
#[derive(Debug, Default)]
pub(super) struct Names {
    /// By the dimension of their members too: a set of shells and beams is two groups.
    pub(super) elements: BTreeMap<(String, u8), String>,
    pub(super) surfaces: BTreeMap<String, String>,
    pub(super) nodes: BTreeMap<String, String>,
}

/// How sets and surfaces are called in the mesh: by their names; a surface or node set whose name is taken
/// gets `-surface` or `-nodes`.
pub(super) fn names(deck: &Deck) -> Names {
    let mut names = Names::default();
    let mut taken = BTreeSet::new();
    let mut free = |name: &str, ending: &str| {
        let mut candidate = name.to_string();
        let mut number = 1;
        while !taken.insert(candidate.clone()) {
            candidate = if number == 1 { format!("{name}-{ending}") } else { format!("{name}-{ending}-{number}") };
            number += 1;
        }
        candidate
    };
    let used = used(deck);
    for (key, set) in deck.element_sets.iter().filter(|(_, set)| !set.members.is_empty()) {
        let dimensions: BTreeSet<u8> = set.members.iter().map(|element| deck.elements[*element as usize].dimension()).collect();
        for (rank, dimension) in dimensions.into_iter().rev().enumerate() {
            let ending = LOWER.get(usize::from(dimension)).copied().filter(|_| rank > 0);
            let name = ending.map_or(set.name.clone(), |ending| format!("{}-{ending}", set.name));
            names.elements.insert((key.clone(), dimension), free(&name, "elements"));
        }
    }
    let there = |surface: &Surface| match surface {
        Surface::Sides(sides) => !sides.is_empty(),
        Surface::Nodes(nodes) => nodes.iter().any(|node| used[*node as usize]),
        Surface::Lines(_) | Surface::Other(_) => false,
    };
    for (key, set) in deck.surfaces.iter().filter(|(_, set)| set.members.iter().any(there)) {
        names.surfaces.insert(key.clone(), free(&set.name, "surface"));
    }
    for (key, set) in deck.node_sets.iter().filter(|(_, set)| set.members.iter().any(|node| used[*node as usize])) {
        names.nodes.insert(key.clone(), free(&set.name, "nodes"));
    }
    if names.elements.is_empty() && !deck.elements.is_empty() {
        let highest = deck.elements.iter().map(Element::dimension).max().unwrap_or(2);
        names.elements.insert((String::new(), highest), free("all", "elements"));
    }
    names
}

/// Whether an element has the node.
pub(super) fn used(deck: &Deck) -> Vec<bool> {
    let mut used = vec![false; deck.nodes.len()];
    deck.elements.iter().flat_map(Element::nodes).for_each(|&node| used[node as usize] = true);
    used
}

/// The mesh of a deck; positions are multiplied by `scale`.
pub(super) fn mesh(deck: &Deck, text: &Text, scale: f64) -> Result<ImportedMesh, Vec<Fault>> {
    let source = text.shown_name();
    if deck.elements.is_empty() {
        let help = "known are CPE4R, CPE4, CPE3, CPS4R, CAX4R and their like, S4R, S3, B31, SAX1, B21, and C3D8R, C3D8, C3D6, C3D4, \
                    of first order";
        return Err(vec![Fault::new(&DECK_MESH, source, "the deck has no elements of bodies", help)]);
    }
    let used = used(deck);
    // Shells in 3D, and lines, are as the deck has them.
    let (is_flat, dimension) = (!deck.is_3d, if deck.is_3d { 3 } else { 2 });
    check_positions(deck, text, scale, &used, is_flat)?;
    check_volumes(deck, text)?;
    let mut dense = vec![u32::MAX; deck.nodes.len()];
    let mut positions = Vec::new();
    for (node, _) in used.iter().enumerate().filter(|(_, used)| **used) {
        dense[node] = positions.len() as u32;
        let [x, y, z] = deck.nodes[node].position;
        positions.push([x * scale, y * scale, if is_flat { 0.0 } else { z * scale }]);
    }
    let names = names(deck);
    let mut groups = Vec::new();
    let cell = |element: &u32| {
        let element = &deck.elements[*element as usize];
        let mut nodes: Vec<u32> = element.nodes().iter().map(|&node| dense[node as usize]).collect();
        if element.dimension() == dimension && form::is_turned(element.kind.cell, &corners(deck, element)) {
            element.kind.cell.reflect(&mut nodes);
        }
        nodes
    };
    for ((key, dimension), name) in &names.elements {
        let is_such = |element: &&u32| deck.elements[**element as usize].dimension() == *dimension;
        let everything: Vec<u32>;
        let members = match deck.element_sets.get(key) {
            Some(set) => &set.members,
            None => {
                everything = (0..deck.elements.len() as u32).collect();
                &everything
            }
        };
        groups.push(MeshGroup { name: name.clone(), dimension: *dimension, cells: members.iter().filter(is_such).map(cell).collect() });
    }
    let points = |nodes: &[u32]| nodes.iter().filter(|node| used[**node as usize]).map(|node| vec![dense[*node as usize]]).collect();
    for (key, name) in &names.surfaces {
        let cell = |&(element, side): &(u32, u8)| -> Vec<u32> {
            deck.elements[element as usize].side(usize::from(side)).map(|node| dense[node as usize]).collect()
        };
        let (dimension, cells) = match deck.surfaces.get(key).and_then(|set| set.members.first()) {
            Some(Surface::Sides(sides)) => {
                // Edges of shells beside faces are no surface.
                let mut cells: Vec<Vec<u32>> = sides.iter().map(cell).collect();
                let has_faces = cells.iter().any(|cell| cell.len() > 2);
                cells.retain(|cell| !has_faces || cell.len() > 2);
                (if has_faces { 2 } else { 1 }, cells)
            }
            Some(Surface::Nodes(nodes)) => (0, points(nodes)),
            _ => continue,
        };
        groups.push(MeshGroup { name: name.clone(), dimension, cells });
    }
    for (key, name) in &names.nodes {
        let cells = deck.node_sets.get(key).map(|set| points(&set.members)).unwrap_or_default();
        groups.push(MeshGroup { name: name.clone(), dimension: 0, cells });
    }
    let values = || (0..deck.nodes.len()).filter(|&node| used[node]).map(|node| Some(scale * deck.thicknesses[node]?)).collect();
    let thickness = || MeshField { name: NODAL_THICKNESS.into(), values: FieldValues::Nodes(values()) };
    let fields = (!deck.thicknesses.is_empty()).then(thickness).into_iter().collect();
    Ok(ImportedMesh { source: source.into(), positions, groups, fields, notes: notes(deck) })
}

/// Elements of second order of which the corners are kept.
fn notes(deck: &Deck) -> Vec<String> {
    let mut counts: BTreeMap<&str, (usize, &Element)> = BTreeMap::new();
    for element in deck.elements.iter().filter(|element| element.kind.nodes_in_deck > element.kind.nodes()) {
        counts.entry(element.kind.name).or_insert((0, element)).0 += 1;
    }
    let of = |(name, (count, first)): (&str, (usize, &Element))| {
        let cell = first.kind.cell.facts();
        format!("{count} elements {name}, which become {} of {} nodes", cell.plural, cell.nodes)
    };
    counts.into_iter().map(of).collect()
}

/// Corners of an element, in the deck's unit.
fn corners(deck: &Deck, element: &Element) -> Vec<[f64; 3]> {
    element.nodes().iter().map(|&node| deck.nodes[node as usize].position).collect()
}

/// A solid without volume has neither mass nor a direction in which to turn it.
fn check_volumes(deck: &Deck, text: &Text) -> Result<(), Vec<Fault>> {
    let mut faults = Faults::default();
    for element in deck.elements.iter().filter(|element| element.dimension() == 3) {
        if !(signed_volume(element.kind.cell, &corners(deck, element)).abs() > 0.0) {
            faults.add("elements without volume", || {
                let message = format!("element {} has no volume", element.tag);
                text.fault(&CELL, element.line, message, "its nodes lie in a plane, or not in order; mesh again")
            });
        }
    }
    if faults.is_empty() { Ok(()) } else { Err(faults.into_list(text.shown_name())) }
}

fn check_positions(deck: &Deck, text: &Text, scale: f64, used: &[bool], is_flat: bool) -> Result<(), Vec<Fault>> {
    let mut faults = Faults::default();
    let nodes = || deck.nodes.iter().zip(used).filter(|(_, used)| **used).map(|(node, _)| node);
    let extent = |axis: usize| {
        let low = nodes().map(|node| node.position[axis]).fold(f64::INFINITY, f64::min);
        nodes().map(|node| node.position[axis]).fold(f64::NEG_INFINITY, f64::max) - low
    };
    let size = extent(0).max(extent(1));
    for node in nodes() {
        let [x, y, z] = node.position;
        if !(x * scale).is_finite() || !(y * scale).is_finite() || (!is_flat && !(z * scale).is_finite()) {
            faults.add("nodes that are nowhere", || {
                let place = if is_flat { format!("{x:e}, {y:e}") } else { format!("{x:e}, {y:e}, {z:e}") };
                let message = format!("node {} is at ({place}): not a place", node.tag);
                text.fault(&NODE, node.line, message, "coordinates are finite numbers; check the file and its unit in the model")
            });
        } else if is_flat && z.abs() > OFF_PLANE * size {
            faults.add("nodes off the plane z = 0", || {
                let message = format!("node {} is at z = {z:e}, off the plane z = 0", node.tag);
                text.fault(
                    &NODE,
                    node.line,
                    message,
                    "bodies lie in the plane of x and y: move the geometry there; of shells take `element = \"shell4\"`",
                )
            });
        }
    }
    if faults.is_empty() { Ok(()) } else { Err(faults.into_list(text.shown_name())) }
}
