//! What carries force across the plane of a cut besides the elements: springs, welds, joints and ties count
//! like elements, with what they do at their nodes on the side of the normal; what touches does not.
//!
//! What connects nodes of the parts of the cut counts. Rigid parts belong to any parts that they are
//! connected with. What connects these with other parts is left out, and said.

use super::plane::Plane;
use crate::contact::{Contact, ContactKind};
use crate::dimension::Dimension;
use crate::mesh::Mesh;
use crate::model::{self, Model};
use crate::step::System;
use crate::tensor::Dim;

/// What a node belongs to.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Of {
    /// A part that the cut goes through.
    Cut,
    /// A rigid part.
    Rigid,
    /// Another part.
    Other,
}

/// What is known of what crosses a plane.
pub(super) struct Across<const D: usize> {
    plane: Plane<D>,
    /// By node of the mesh; empty: all belong to it.
    of: Vec<Of>,
    /// Numbers of the contacts that are welds, joints or ties, and of those between surfaces that touch.
    connections: Vec<usize>,
    touching: Vec<usize>,
    /// What of the springs and rigid parts is left out.
    left_out: Vec<LeftOut>,
}

/// What crosses a plane and does not count.
#[derive(Clone, PartialEq, Eq)]
pub(super) enum LeftOut {
    /// A connection with a part that is not named.
    Connection(String),
    /// A part whose forces are not known.
    Rigid(String),
}

impl<const D: usize> Across<D>
where
    Dim<D>: Dimension<D>,
{
    pub(super) fn new(plane: Plane<D>, cut: &model::Cut, model: &Model, system: &System<D>) -> Self {
        let is_tie = |contact: &Contact<D>| {
            let own = model.contacts.iter().find(|own| own.name == contact.name);
            contact.kind == ContactKind::Contact && own.is_some_and(|own| own.tied.is_some())
        };
        // What is held by the ground is not held by the other side.
        let is_grounded = |contact: &Contact<D>| contact.connected().is_some_and(|it| it.grounded);
        let numbers = |wanted: &dyn Fn(&Contact<D>) -> bool| (0..).zip(&system.contacts).filter(|it| wanted(it.1)).map(|it| it.0).collect();
        let of = if cut.parts.is_empty() { Vec::new() } else { owners(cut, model, &system.mesh) };
        let mut across = Self {
            connections: numbers(&|contact| is_tie(contact) || (contact.kind.is_connection() && !is_grounded(contact))),
            touching: numbers(&|contact| contact.kind == ContactKind::Contact && !is_tie(contact)),
            plane,
            of,
            left_out: Vec::new(),
        };
        if cut.parts.is_empty() {
            across.left_out = across.rigid_parts(system);
        }
        across
    }

    /// Rigid parts that the plane goes through.
    fn rigid_parts(&self, system: &System<D>) -> Vec<LeftOut> {
        let mesh = &system.mesh;
        let mut parts = Vec::new();
        for (group, _) in mesh.groups.iter().zip(&system.rigid).filter(|(_, rigid)| **rigid) {
            let cuts = |element: usize| self.plane.slice(group, element, &mesh.positions).is_some();
            if !parts.contains(&group.part) && (0..group.elements()).any(cuts) {
                parts.push(group.part);
            }
        }
        parts.into_iter().map(|part| LeftOut::Rigid(mesh.parts[part].name.clone())).collect()
    }

    /// Takes the springs that cross: hands over the number of those that count, the corner that is beyond,
    /// their nodes, and the share of the way to the second at which they cross.
    pub(super) fn take_springs(&mut self, model: &Model, system: &System<D>, mut count: impl FnMut(usize, usize, [u32; 2], f64)) {
        let Some(springs) = system.blocks.last().filter(|_| system.has_springs) else { return };
        for (number, pair) in springs.slots().chunks_exact(2).enumerate() {
            let pair = [pair[0], pair[1]];
            match self.crosses(pair.into_iter(), system) {
                Some(true) => {
                    let share = self.plane.share(pair, &system.mesh.positions);
                    count(number, usize::from(self.plane.has_beyond(pair[1])), pair, share);
                }
                Some(false) => self.leave_out(LeftOut::Connection(spring_name(pair, model, &system.mesh))),
                None => {}
            }
        }
    }

    fn leave_out(&mut self, what: LeftOut) {
        if !self.left_out.contains(&what) {
            self.left_out.push(what);
        }
    }

    /// Whether what connects these nodes counts, if it crosses the plane between parts of the cut or from
    /// them to others.
    fn crosses(&self, nodes: impl Iterator<Item = u32> + Clone, system: &System<D>) -> Option<bool> {
        if !self.plane.is_between(nodes.clone()) || !self.plane.meets(nodes.clone(), &system.mesh.positions) {
            return None;
        }
        let mut owners = nodes.map(|node| self.of.get(node as usize).copied().unwrap_or(Of::Cut));
        owners.clone().any(|of| of == Of::Cut).then(|| owners.all(|of| of != Of::Other))
    }

    /// Hands over what welds, joints and ties that count do at the nodes on the side of the normal.
    pub(super) fn each_force(&self, system: &System<D>, mut see: impl FnMut(u32, [f64; D])) {
        for &number in &self.connections {
            system.contacts[number].each_spring(&system.springs, |ends| {
                if self.crosses(ends.iter().map(|end| end.0), system) == Some(true) {
                    ends.iter().filter(|end| self.plane.has_beyond(end.0)).for_each(|&(node, force)| see(node, force));
                }
            });
        }
    }

    /// What crosses and does not count, as far as it is known: of ties where these are now.
    pub(super) fn left_out(&self, system: &System<D>) -> Vec<LeftOut> {
        let mut all = self.left_out.clone();
        for &number in &self.connections {
            let contact = &system.contacts[number];
            let mut is_left_out = false;
            contact.each_spring(&system.springs, |ends| {
                is_left_out |= self.crosses(ends.iter().map(|end| end.0), system) == Some(false);
            });
            if is_left_out {
                all.push(LeftOut::Connection(format!("{} `{}`", contact.kind.name(), contact.name)));
            }
        }
        all
    }

    /// The first contact whose surfaces push each other across the plane now.
    pub(super) fn pushing<'a>(&self, system: &'a System<D>) -> Option<&'a str> {
        let pushes = |contact: &&Contact<D>| {
            let mut pushes = false;
            contact.each_spring(&system.springs, |ends| {
                let has_force = ends.iter().any(|end| end.1 != [0.0; D]);
                pushes |= has_force && self.crosses(ends.iter().map(|end| end.0), system) == Some(true);
            });
            pushes
        };
        self.touching.iter().map(|&number| &system.contacts[number]).find(pushes).map(|contact| contact.name.as_str())
    }
}

/// What each node belongs to: of several parts to that of the cut, or the rigid one.
fn owners<const D: usize>(cut: &model::Cut, model: &Model, mesh: &Mesh<D>) -> Vec<Of>
where
    Dim<D>: Dimension<D>,
{
    let mut of = vec![Of::Other; mesh.positions.len()];
    for (mark, wanted) in [(Of::Rigid, false), (Of::Cut, true)] {
        for (part, own) in mesh.parts.iter().zip(&model.parts) {
            let is_marked = if wanted { cut.takes(&part.name) } else { own.rigid.is_some() };
            part.with_faces().filter(|_| is_marked).for_each(|node| of[node as usize] = mark);
        }
    }
    of
}

/// The spring of the model that has a pair of nodes.
fn spring_name<const D: usize>(pair: [u32; 2], model: &Model, mesh: &Mesh<D>) -> String
where
    Dim<D>: Dimension<D>,
{
    let has = |set: &String, node: u32| mesh.nodes(set).is_some_and(|nodes| nodes.binary_search(&node).is_ok());
    let own = model.springs.iter().position(|spring| spring.between.iter().zip(pair).all(|(set, node)| has(set, node)));
    own.map_or_else(|| "spring".to_string(), |index| format!("spring[{index}]"))
}
