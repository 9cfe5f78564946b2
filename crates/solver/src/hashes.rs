//! Hashes of the state of each part, of the contacts and of the rigid bodies, for the log by which two runs
//! are compared later.
//!
//! [`crate::simulation`] takes them every `output.hash_steps` steps and reports its observer. They are made
//! of the values that [`crate::divergence`] compares one by one: positions and velocities of the nodes,
//! energies of the elements, sums of the contacts, motion of the bodies. What is a sum over nodes or names
//! depends on no order of storage.

use crate::contact::{Contact, ContactKind};
use crate::dimension::Dimension;
use crate::hash::{Fnv, mixed};
use crate::model::in_3d;
use crate::rigid::RigidMotion;
use crate::step::System;
use crate::tensor::Dim;

/// Hashes of a state at the end of a step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hashes {
    /// Steps done.
    pub step: u64,
    /// Time, s.
    pub time: f64,
    /// Step that leads to the next state, s.
    pub time_step: f64,
    /// All of the following together.
    pub state: u64,
    /// Contacts and obstacles: forces, energies, penetrations.
    pub contacts: u64,
    /// Rigid bodies that move: places and velocities.
    pub bodies: u64,
    /// Parts in model order: positions x^n and velocities v^{n+1/2} of the nodes, energies of the elements.
    pub parts: Vec<u64>,
}

/// What is compared of a contact.
pub(crate) const CONTACT: [&str; 8] = [
    "force x",
    "force y",
    "sum of the normal forces",
    "energy of the springs",
    "energy of the elastic slip",
    "friction work",
    "penetration",
    "force z",
];
pub(crate) fn of_contact<const D: usize>(contact: &Contact<D>) -> [f64; CONTACT.len()]
where
    Dim<D>: Dimension<D>,
{
    let totals = &contact.totals;
    let [x, y, z] = in_3d(totals.resultant);
    [x, y, totals.pressing, totals.energy, totals.slip_energy, contact.friction_work, contact.penetration, z]
}

/// Rigid bodies that move, by the names of their obstacles or parts.
pub(crate) fn bodies<const D: usize>(system: &System<D>) -> impl Iterator<Item = (&str, Vec<f64>)>
where
    Dim<D>: Dimension<D>,
{
    let of_obstacles = system.contacts.iter().filter_map(|contact| match contact.kind {
        ContactKind::Obstacle(body) if !system.bodies.state(body).is_fixed() => Some((contact.name.as_str(), body)),
        _ => None,
    });
    let of_parts = system.body_parts.iter().map(|&(part, body)| (system.mesh.parts[part].name.as_str(), body));
    of_obstacles.chain(of_parts).map(|(name, body)| {
        let body = system.bodies.state(body);
        (name, <Dim<D>>::numbers(body))
    })
}

/// Energies of the elements of a part, J/m: stored and dissipated, of each of its groups.
pub(crate) fn energies<const D: usize>(system: &System<D>, part: usize) -> impl Iterator<Item = [f64; 2]>
where
    Dim<D>: Dimension<D>,
{
    let groups = system.mesh.groups.iter().zip(&system.reports);
    groups.filter(move |(group, _)| group.part == part).map(|(_, report)| [report.stored, report.dissipated])
}

/// The nodes of a part as they are stored, each with its place in the part, in ascending order: memory is
/// read from one end to the other.
pub(crate) fn nodes<const D: usize>(system: &System<D>, part: usize) -> Vec<[u32; 2]>
where
    Dim<D>: Dimension<D>,
{
    let mut nodes: Vec<[u32; 2]> = system.mesh.parts[part].nodes.iter().zip(0..).map(|(&node, place)| [node, place]).collect();
    nodes.sort_unstable();
    nodes
}

/// Numbers that belong to a name; all zero, as what has not acted yet: nothing.
fn named(name: &str, numbers: &[f64]) -> u64 {
    if numbers.iter().all(|&number| number == 0.0) {
        return 0;
    }
    let mut hash = Fnv::default();
    hash.add(name.as_bytes());
    numbers.iter().fold(hash.value(), |hash, number| mixed(hash, number.to_bits()))
}

/// Takes hashes while a run continues.
#[derive(Default)]
pub(crate) struct Hashing {
    /// Steps between two.
    every: Option<u64>,
    /// Of each part: its nodes.
    nodes: Vec<Vec<[u32; 2]>>,
    /// What was taken and not reported yet.
    pub(crate) taken: Vec<Hashes>,
    last: Option<u64>,
}

impl Hashing {
    pub(crate) fn new<const D: usize>(system: &System<D>, every: Option<u64>) -> Self
    where
        Dim<D>: Dimension<D>,
    {
        let parts = if every.is_some() { 0..system.mesh.parts.len() } else { 0..0 };
        Self { every, nodes: parts.map(|part| nodes(system, part)).collect(), ..Self::default() }
    }

    /// Nodes of parts are others now.
    pub(crate) fn renew<const D: usize>(&mut self, system: &System<D>)
    where
        Dim<D>: Dimension<D>,
    {
        for (part, own) in self.nodes.iter_mut().enumerate() {
            *own = nodes(system, part);
        }
    }

    /// Takes those of a step that is due.
    pub(crate) fn note<const D: usize>(&mut self, system: &System<D>)
    where
        Dim<D>: Dimension<D>,
    {
        if self.every.is_some_and(|every| system.step.is_multiple_of(every)) {
            self.take(system);
        }
    }

    /// Those of a state that a run continues from were taken by the run that left it, if they were due.
    pub(crate) fn pass(&mut self, step: u64) {
        self.last = self.every.filter(|&every| step.is_multiple_of(every)).map(|_| step);
    }

    /// Takes those of the first and of the last state, whatever their steps.
    pub(crate) fn take<const D: usize>(&mut self, system: &System<D>)
    where
        Dim<D>: Dimension<D>,
    {
        if self.every.is_some() && self.last != Some(system.step) {
            self.last = Some(system.step);
            self.taken.push(hashes(system, &self.nodes));
        }
    }
}

/// Hashes of the state now; `nodes` has the [`nodes`] of each part.
pub(crate) fn hashes<const D: usize>(system: &System<D>, nodes: &[Vec<[u32; 2]>]) -> Hashes
where
    Dim<D>: Dimension<D>,
{
    let of_node = |&[node, place]: &[u32; 2]| {
        let motion = system.positions[node as usize].into_iter().chain(system.velocities[node as usize]);
        let motion = motion.chain(system.rotations.now.numbers(node));
        motion.fold(mixed(0, place.into()), |hash, number| mixed(hash, number.to_bits()))
    };
    let of_part = |(part, nodes): (usize, &Vec<[u32; 2]>)| {
        let sum = nodes.iter().map(of_node).fold(0, u64::wrapping_add);
        energies(system, part).flatten().fold(sum, |hash, energy| mixed(hash, energy.to_bits()))
    };
    let parts: Vec<u64> = nodes.iter().enumerate().map(of_part).collect();
    let contacts = system
        .contacts
        .iter()
        .map(|contact| named(&contact.name, &of_contact(contact)[..CONTACT.len() + D - 3]))
        .fold(0, u64::wrapping_add);
    let bodies = bodies(system).map(|(name, numbers)| named(name, &numbers)).fold(0, u64::wrapping_add);
    let state = parts.iter().chain([&contacts, &bodies]).fold(0, |hash, &other| mixed(hash, other));
    Hashes { step: system.step, time: system.time, time_step: system.time_step, state, contacts, bodies, parts }
}
