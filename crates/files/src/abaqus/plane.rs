//! From the geometry of a deck to a plane mesh: names of groups, dense node numbers, the checks of positions.
//!
//! [`super::parse`] calls [`mesh`]; the import asks [`names`] how sets are called in the mesh.

use super::deck::{Deck, Element, Surface};
use super::text::Text;
use crate::abaqus::messages::DECK_MESH;
use crate::gmsh::faults::Faults;
use crate::gmsh::messages::NODE;
use embate_solver::error::Fault;
use embate_solver::model::{ImportedMesh, MeshGroup};
use std::collections::{BTreeMap, BTreeSet};

/// Distance from the plane z = 0, as a fraction of the mesh's size, that still counts as on it.
const OFF_PLANE: f64 = 1e-9;

/// Names of groups by the full names (in capitals) of what they stand for.
#[derive(Debug, Default)]
pub(super) struct Names {
    pub(super) elements: BTreeMap<String, String>,
    pub(super) surfaces: BTreeMap<String, String>,
    pub(super) nodes: BTreeMap<String, String>,
}

/// How sets and surfaces are called in the mesh: by their names; a surface or node set whose name is taken gets `-surface` or `-nodes`.
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
        names.elements.insert(key.clone(), free(&set.name, "elements"));
    }
    let there = |surface: &Surface| match surface {
        Surface::Edges(edges) => !edges.is_empty(),
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
        names.elements.insert(String::new(), free("all", "elements"));
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
        let help = "known are CPE4R, CPE4, CPE3, CPS4R, CAX4R and their like, of first order";
        return Err(vec![Fault::new(&DECK_MESH, source, "the deck has no plane elements", help)]);
    }
    let used = used(deck);
    check_positions(deck, text, scale, &used)?;
    let mut dense = vec![u32::MAX; deck.nodes.len()];
    let mut positions = Vec::new();
    for (node, _) in used.iter().enumerate().filter(|(_, used)| **used) {
        dense[node] = positions.len() as u32;
        let [x, y, _] = deck.nodes[node].position;
        positions.push([x * scale, y * scale, 0.0]);
    }
    let names = names(deck);
    let mut groups = Vec::new();
    let cell = |element: &u32| {
        let element = &deck.elements[*element as usize];
        let mut nodes: Vec<u32> = element.nodes().iter().map(|&node| dense[node as usize]).collect();
        if area(deck, element) < 0.0 {
            nodes[1..].reverse();
        }
        nodes
    };
    for (key, name) in &names.elements {
        let cells = match deck.element_sets.get(key) {
            Some(set) => set.members.iter().map(cell).collect(),
            None => (0..deck.elements.len() as u32).map(|element| cell(&element)).collect(),
        };
        groups.push(MeshGroup { name: name.clone(), dimension: 2, cells });
    }
    let points = |nodes: &[u32]| nodes.iter().filter(|node| used[**node as usize]).map(|node| vec![dense[*node as usize]]).collect();
    for (key, name) in &names.surfaces {
        let lines = |edges: &[(u32, u8)]| {
            let line = |&(element, edge): &(u32, u8)| {
                deck.elements[element as usize].edge(usize::from(edge)).map(|node| dense[node as usize]).to_vec()
            };
            edges.iter().map(line).collect()
        };
        let (dimension, cells) = match deck.surfaces.get(key).and_then(|set| set.members.first()) {
            Some(Surface::Edges(edges)) => (1, lines(edges)),
            Some(Surface::Nodes(nodes)) => (0, points(nodes)),
            _ => continue,
        };
        groups.push(MeshGroup { name: name.clone(), dimension, cells });
    }
    for (key, name) in &names.nodes {
        let cells = deck.node_sets.get(key).map(|set| points(&set.members)).unwrap_or_default();
        groups.push(MeshGroup { name: name.clone(), dimension: 0, cells });
    }
    Ok(ImportedMesh { source: source.into(), positions, groups })
}

/// Twice the area, negative when the nodes run clockwise.
fn area(deck: &Deck, element: &Element) -> f64 {
    let x = |k: usize| deck.nodes[element.nodes[k] as usize].position;
    let cross = |a: [f64; 3], b: [f64; 3], c: [f64; 3], d: [f64; 3]| (b[0] - a[0]) * (d[1] - c[1]) - (b[1] - a[1]) * (d[0] - c[0]);
    if element.kind.nodes == 4 { cross(x(0), x(2), x(1), x(3)) } else { cross(x(0), x(1), x(0), x(2)) }
}

fn check_positions(deck: &Deck, text: &Text, scale: f64, used: &[bool]) -> Result<(), Vec<Fault>> {
    let mut faults = Faults::default();
    let nodes = || deck.nodes.iter().zip(used).filter(|(_, used)| **used).map(|(node, _)| node);
    let extent = |axis: usize| {
        let low = nodes().map(|node| node.position[axis]).fold(f64::INFINITY, f64::min);
        nodes().map(|node| node.position[axis]).fold(f64::NEG_INFINITY, f64::max) - low
    };
    let size = extent(0).max(extent(1));
    for node in nodes() {
        let [x, y, z] = node.position;
        if !(x * scale).is_finite() || !(y * scale).is_finite() {
            faults.add("nodes that are nowhere", || {
                let message = format!("node {} is at ({x:e}, {y:e}): not a place", node.tag);
                text.fault(&NODE, node.line, message, "coordinates are finite numbers; check the file and its unit in the model")
            });
        } else if z.abs() > OFF_PLANE * size {
            faults.add("nodes off the plane z = 0", || {
                let message = format!("node {} is at z = {z:e}, off the plane z = 0", node.tag);
                text.fault(&NODE, node.line, message, "bodies lie in the plane of x and y: move the geometry there")
            });
        }
    }
    if faults.is_empty() { Ok(()) } else { Err(faults.into_list(text.shown_name())) }
}
