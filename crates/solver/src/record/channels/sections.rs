//! What planes through parts transmit: force and moment of one side on the other.
//!
//! The forces of an element on its nodes sum up to nothing, and so do their moments. What the nodes on one
//! side of a plane get from all elements is thus what they get from those that the plane cuts: N = −Σ f and
//! M = −Σ ((x − c) × f + m) over the slots of nodes on the side of the normal. Chunks of elements on one side
//! alone add nothing and are left out. The point c is the centre of what the plane cuts at the start, carried
//! by the nodes of the cut edges.

use super::{Channel, Column, forces, means, moment};
use crate::block::NO_NODE;
use crate::body_columns::BodyColumns;
use crate::dimension::Dimension;
use crate::error::Fault;
use crate::mesh::ElementGroup;
use crate::mesh::messages::NOTHING_CUT;
use crate::model::{self, Model, in_3d};
use crate::rotation::Rotate;
use crate::step::System;
use crate::tensor::{Dim, cross};
use crate::vector::{any_tangent, dot, first, length, minus, plus, times, unit};

/// The group.
pub(super) struct Sections<const D: usize>(Vec<Section<D>>);

struct Section<const D: usize> {
    name: String,
    normal: [f64; D],
    /// Slots of forces, with their nodes, and slots of moments, of nodes on the side of the normal.
    slots: Vec<(u32, u32)>,
    moment_slots: Vec<u32>,
    /// Nodes whose weighted mean is the centre; weights sum to one.
    centre: Vec<(u32, f64)>,
}

impl<const D: usize> Sections<D>
where
    Dim<D>: Dimension<D>,
{
    /// # Errors
    /// Planes that cut nothing.
    pub(super) fn new(model: &Model, system: &System<D>) -> Result<Self, Vec<Fault>> {
        let (mut sections, mut faults) = (Vec::new(), Vec::new());
        for (index, cut) in model.cuts.iter().enumerate() {
            match Section::new(cut, system) {
                Some(section) => sections.push(section),
                None => faults.push(Fault::new(
                    &NOTHING_CUT,
                    format!("cut[{index}]"),
                    format!("the plane of cut `{}` goes through no element of a deformable part", cut.name),
                    "move `point` into a part, between its nodes",
                )),
            }
        }
        if faults.is_empty() { Ok(Self(sections)) } else { Err(faults) }
    }
}

impl<const D: usize> Section<D>
where
    Dim<D>: Dimension<D>,
{
    fn new(cut: &model::Cut, system: &System<D>) -> Option<Self> {
        let mesh = &system.mesh;
        let (normal, point) = (unit(first::<D>(cut.normal))?, first::<D>(cut.point));
        // Nodes in the plane are on the other side, whatever rounding says.
        let least = crate::mesh::tolerance(&mesh.positions);
        let height = |node: u32| dot(minus(mesh.positions[node as usize], point), normal);
        let is_beyond = |node: u32| height(node) > least;
        let mut centre: Vec<(u32, f64)> = Vec::new();
        let (mut slots, mut moment_slots) = (Vec::new(), Vec::new());
        let (mut slot, mut moment_slot) = (0, 0);
        for ((block, group), rigid) in system.blocks.iter().zip(&mesh.groups).zip(&system.rigid) {
            let named = cut.parts.is_empty() || cut.parts.contains(&mesh.parts[group.part].name);
            if named && !rigid {
                for element in 0..group.elements() {
                    add_centre(group, element, normal, &height, &is_beyond, &mesh.positions, &mut centre);
                }
                add_slots(block.slots(), slot, &is_beyond, |slot, node| slots.push((slot, node)));
                add_slots(block.moment_slots(), moment_slot, &is_beyond, |slot, _| moment_slots.push(slot));
            }
            slot += block.slots().len() as u32;
            moment_slot += block.moment_slots().len() as u32;
        }
        let sum: f64 = centre.iter().map(|(_, weight)| weight).sum();
        centre.iter_mut().for_each(|(_, weight)| *weight /= sum);
        (!centre.is_empty()).then(|| Self { name: cut.name.clone(), normal, slots, moment_slots, centre })
    }

    /// Force and moment now, N/m and N (N and N m).
    fn transmitted(&self, system: &System<D>) -> ([f64; D], [f64; 3]) {
        let centre = self.centre(system);
        let (mut force, mut about) = ([0.0; D], [0.0; 3]);
        for &(slot, node) in &self.slots {
            let own = system.slots[slot as usize];
            force = minus(force, own);
            about = minus(about, <Dim<D>>::moment_vector(minus(system.positions[node as usize], centre), own));
        }
        for &slot in &self.moment_slots {
            about = minus(about, system.rotations.slots[slot as usize]);
        }
        (force, about)
    }

    fn centre(&self, system: &System<D>) -> [f64; D] {
        self.centre.iter().fold([0.0; D], |sum, &(node, weight)| plus(sum, times(weight, system.positions[node as usize])))
    }
}

/// Adds the slots of nodes beyond, chunk by chunk, where a chunk has nodes on both sides; the nodes of a
/// chunk ascend.
fn add_slots(nodes: &[u32], first: u32, is_beyond: &impl Fn(u32) -> bool, mut add: impl FnMut(u32, u32)) {
    let mut begin = 0;
    while begin < nodes.len() {
        let ends = |at: &usize| nodes[*at] == NO_NODE || nodes[*at] <= nodes[*at - 1];
        let end = (begin + 1..nodes.len()).find(ends).unwrap_or(nodes.len());
        let chunk = &nodes[begin..end];
        let beyond = |&node: &u32| node != NO_NODE && is_beyond(node);
        if chunk.iter().any(beyond) && !chunk.iter().all(beyond) {
            let own = (first + begin as u32..).zip(chunk).filter(|(_, node)| beyond(node));
            own.for_each(|(slot, &node)| add(slot, node));
        }
        begin = end;
    }
}

/// Adds the centre of what a plane cuts of an element, as a sum over the nodes of its cut edges, weighted by
/// the area (of surfaces the length, of lines one).
fn add_centre<const D: usize>(
    group: &ElementGroup,
    element: usize,
    normal: [f64; D],
    height: &impl Fn(u32) -> f64,
    is_beyond: &impl Fn(u32) -> bool,
    positions: &[[f64; D]],
    centre: &mut Vec<(u32, f64)>,
) {
    let nodes = group.nodes_of(element);
    if nodes.iter().all(|&node| is_beyond(node)) || !nodes.iter().any(|&node| is_beyond(node)) {
        return;
    }
    let edges: Vec<[u32; 2]> = group.cell(element).edges().filter(|edge| is_beyond(edge[0]) != is_beyond(edge[1])).collect();
    let share = |[a, b]: [u32; 2]| height(a) / (height(a) - height(b));
    let point = |edge: [u32; 2]| -> [f64; 3] {
        let [a, b] = edge.map(|node| positions[node as usize]);
        in_3d(plus(a, times(share(edge), minus(b, a))))
    };
    let points: Vec<[f64; 3]> = edges.iter().map(|&edge| point(edge)).collect();
    let weight = size(&points, in_3d(normal)) / points.len() as f64;
    for edge in edges {
        let at = share(edge);
        centre.extend([(edge[0], weight * (1.0 - at)), (edge[1], weight * at)]);
    }
}

/// Size of what points in a plane bound: of one 1, of two their distance, of more the area of the polygon
/// around their middle.
fn size(points: &[[f64; 3]], normal: [f64; 3]) -> f64 {
    match points {
        [] | [_] => 1.0,
        [a, b] => length(minus(*a, *b)),
        _ => {
            let middle = times(1.0 / points.len() as f64, points.iter().fold([0.0; 3], |sum, &x| plus(sum, x)));
            let along = any_tangent(normal);
            let across = cross(normal, along);
            let mut flat: Vec<[f64; 2]> = points.iter().map(|&x| [dot(minus(x, middle), along), dot(minus(x, middle), across)]).collect();
            // Around the middle, by the angle.
            flat.sort_by(|a, b| a[1].atan2(a[0]).total_cmp(&b[1].atan2(b[0])));
            let next = flat.iter().cycle().skip(1);
            0.5 * flat.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>().abs()
        }
    }
}

impl<const D: usize> Channel<D> for Sections<D>
where
    Dim<D>: Dimension<D> + BodyColumns<D>,
{
    fn columns(&self, _: &System<D>) -> Vec<Column> {
        let values = || forces::<D>().iter().chain(&["normal_force"]).chain(<Dim<D>>::MOMENT);
        self.0.iter().flat_map(|section| means(values().map(|value| format!("cut.{value}[{}]", section.name)))).collect()
    }

    fn rates(&self, system: &System<D>, row: &mut Vec<f64>) {
        for section in &self.0 {
            let (force, about) = section.transmitted(system);
            row.extend(force.into_iter().chain([dot(force, section.normal)]).chain(moment::<D>(about)));
        }
    }
}
