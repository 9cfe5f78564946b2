//! What planes through parts transmit: force and moment of one side on the other.
//!
//! The forces of an element on its nodes sum up to nothing, and so do their moments. What the nodes on one
//! side of a plane get from all elements is thus what they get from those that the plane cuts: N = −Σ f and
//! M = −Σ ((x − c) × f + m) over the slots of nodes on the side of the normal. Chunks of elements on one side
//! alone add nothing and are left out. Of a disc the sums are over the cut elements themselves, whose forces
//! their blocks keep. Connections that cross the plane count as elements do. The point c is the centre of
//! what the plane cuts of elements at the start, where it cuts none the mean of the places where it cuts
//! springs, carried by the nodes of the cut edges.

mod across;
mod plane;

use super::{Channel, Column, Pushing, forces, means, moment};
use crate::block::NO_NODE;
use crate::body_columns::BodyColumns;
use crate::dimension::Dimension;
use crate::error::{Fault, Warning};
use crate::mesh::messages::{CUT_LEAVES_OUT, NOTHING_CUT};
use crate::model::{self, Model};
use crate::rotation::Rotate;
use crate::step::System;
use crate::tensor::Dim;
use crate::vector::{dot, minus, plus, times};
use across::{Across, LeftOut};
use plane::Plane;
use std::ops::Range;

/// The group.
pub(super) struct Sections<const D: usize>(Vec<Section<D>>);

struct Section<const D: usize> {
    /// Number in the model.
    index: usize,
    name: String,
    normal: [f64; D],
    /// Of a whole plane slots of forces, with their nodes, and slots of moments, of nodes on the side of the
    /// normal; slots of springs.
    slots: Vec<(u32, u32)>,
    moment_slots: Vec<u32>,
    /// Of a disc corners of the elements that it cuts, by group.
    pieces: Vec<Piece>,
    /// Nodes whose weighted mean is the centre; weights sum to one.
    centre: Vec<(u32, f64)>,
    across: Across<D>,
}

/// Elements of a group that a disc cuts.
struct Piece {
    group: usize,
    /// Slots of the group's block.
    slots: Range<usize>,
    /// Corners on the side of the normal: element, corner, node.
    corners: Vec<[u32; 3]>,
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
            match Section::new(index, model, system) {
                Some(section) => sections.push(section),
                None => faults.push(nothing_cut(index, cut)),
            }
        }
        if faults.is_empty() { Ok(Self(sections)) } else { Err(faults) }
    }
}

fn nothing_cut(index: usize, cut: &model::Cut) -> Fault {
    let (what, help) = match cut.radius {
        None => ("plane".to_string(), "move `point` into a part, between its nodes"),
        Some(radius) => (format!("plane within {radius:.3e} m of the point"), "move `point` into a wall, or give a larger `radius`"),
    };
    let message = format!("the {what} of cut `{}` goes through no element of a deformable part", cut.name);
    Fault::new(&NOTHING_CUT, format!("cut[{index}]"), message, help)
}

impl<const D: usize> Section<D>
where
    Dim<D>: Dimension<D>,
{
    fn new(index: usize, model: &Model, system: &System<D>) -> Option<Self> {
        let (mesh, cut) = (&system.mesh, &model.cuts[index]);
        let plane = Plane::new(cut, system)?;
        let (mut slots, mut moment_slots, mut pieces, mut centre) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let (mut slot, mut moment_slot) = (0, 0);
        for (number, (block, group)) in system.blocks.iter().zip(&mesh.groups).enumerate() {
            if cut.takes(&mesh.parts[group.part].name) && !system.rigid[number] {
                let mut corners = Vec::new();
                for element in 0..group.elements() {
                    let Some(slice) = plane.slice(group, element, &mesh.positions) else { continue };
                    slice.add_centre(plane.normal, &mut centre);
                    let own = (0..).zip(group.nodes_of(element)).filter(|(_, node)| plane.has_beyond(**node));
                    corners.extend(own.map(|(corner, &node)| [element as u32, corner, node]));
                }
                if cut.radius.is_some() {
                    pieces.push(Piece { group: number, slots: slot..slot + block.slots().len(), corners });
                } else {
                    add_slots(block.slots(), slot, &plane, |slot, node| slots.push((slot, node)));
                    add_slots(block.moment_slots(), moment_slot, &plane, |slot, _| moment_slots.push(slot));
                }
            }
            slot += block.slots().len();
            moment_slot += block.moment_slots().len();
        }
        let normal = plane.normal;
        let mut across = Across::new(plane, cut, model, system);
        let mut of_springs = Vec::new();
        across.take_springs(model, system, |spring, corner, pair, share| {
            slots.push(((slot + 2 * spring + corner) as u32, pair[corner]));
            of_springs.extend([(pair[0], 1.0 - share), (pair[1], share)]);
        });
        if centre.is_empty() {
            centre = of_springs;
        }
        let sum: f64 = centre.iter().map(|(_, weight)| weight).sum();
        centre.iter_mut().for_each(|(_, weight)| *weight /= sum);
        (!centre.is_empty()).then(|| Self { index, name: cut.name.clone(), normal, slots, moment_slots, pieces, centre, across })
    }

    /// Force and moment now, N/m and N (N and N m).
    fn transmitted(&self, system: &System<D>) -> ([f64; D], [f64; 3]) {
        let centre = self.centre(system);
        let (mut force, mut about) = ([0.0; D], [0.0; 3]);
        let mut take = |node: u32, own: [f64; D]| {
            force = minus(force, own);
            about = minus(about, <Dim<D>>::moment_vector(minus(system.positions[node as usize], centre), own));
        };
        for &(slot, node) in &self.slots {
            take(node, system.slots[slot as usize]);
        }
        let mut moments = [0.0; 3];
        for Piece { group, slots, corners } in &self.pieces {
            let (block, slots) = (&system.blocks[*group], &system.slots[slots.clone()]);
            for &[element, corner, node] in corners.iter().filter(|[element, ..]| block.is_alive(*element as usize)) {
                take(node, block.force(element as usize, corner as usize, slots));
                moments = plus(moments, block.moment(element as usize, corner as usize));
            }
        }
        self.across.each_force(system, &mut take);
        about = minus(about, moments);
        for &slot in &self.moment_slots {
            about = minus(about, system.rotations.slots[slot as usize]);
        }
        (force, about)
    }

    fn warning(&self, what: &LeftOut) -> Warning {
        let (message, help) = match what {
            LeftOut::Connection(name) => (
                format!("{name} crosses the plane of cut `{}` to a part that is none of its `parts`", self.name),
                "name that part too, or leave `parts` out",
            ),
            LeftOut::Rigid(name) => (
                format!("rigid part `{name}` lies across the plane of cut `{}`, and forces in it are not known", self.name),
                "name the parts that are meant as `parts`, or end the cut before it with `radius`",
            ),
        };
        Warning {
            kind: &CUT_LEAVES_OUT,
            path: format!("cut[{}]", self.index),
            message,
            consequence: "the cut has not all that one side exerts on the other".into(),
            help: help.into(),
        }
    }

    fn centre(&self, system: &System<D>) -> [f64; D] {
        self.centre.iter().fold([0.0; D], |sum, &(node, weight)| plus(sum, times(weight, system.positions[node as usize])))
    }
}

/// Adds the slots of nodes beyond, chunk by chunk, where a chunk has nodes on both sides; the nodes of a
/// chunk ascend.
fn add_slots<const D: usize>(nodes: &[u32], first: usize, plane: &Plane<D>, mut add: impl FnMut(u32, u32))
where
    Dim<D>: Dimension<D>,
{
    let mut begin = 0;
    while begin < nodes.len() {
        let ends = |at: &usize| nodes[*at] == NO_NODE || nodes[*at] <= nodes[*at - 1];
        let end = (begin + 1..nodes.len()).find(ends).unwrap_or(nodes.len());
        let chunk = &nodes[begin..end];
        let beyond = |&node: &u32| node != NO_NODE && plane.has_beyond(node);
        if chunk.iter().any(beyond) && !chunk.iter().all(beyond) {
            let own = (first as u32 + begin as u32..).zip(chunk).filter(|(_, node)| beyond(node));
            own.for_each(|(slot, &node)| add(slot, node));
        }
        begin = end;
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

    fn warnings(&self, system: &System<D>) -> Vec<Warning> {
        let of = |section: &Section<D>| section.across.left_out(system).iter().map(|what| section.warning(what)).collect::<Vec<_>>();
        self.0.iter().flat_map(of).collect()
    }

    fn pushing(&self, system: &System<D>) -> Vec<Pushing> {
        let of = |section: &Section<D>| {
            let contact = section.across.pushing(system)?.to_string();
            Some(Pushing { index: section.index, cut: section.name.clone(), contact })
        };
        self.0.iter().filter_map(of).collect()
    }
}
