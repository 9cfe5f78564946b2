//! Divergence of two simulations: their states are compared value by value after each step.
//!
//! Made for `embate diff`, which steps two simulations side by side. Compared are the values of which
//! [`crate::hashes`] makes hashes. Parts correspond by their names and nodes by their places in them,
//! whatever else the models have, and only where their meshes are the same.

use crate::body_columns::BodyColumns;
use crate::hash::mixed;
use crate::hashes::{self, CONTACT};
use crate::mesh::cell::Cell;
use crate::simulation::{Either, Runs, Simulation};
use crate::step::System;
use crate::tensor::Dim;
use crate::vector::{dot, minus};

/// Parts of two models that have the same mesh.
#[derive(Clone, Debug)]
pub struct Pairing {
    parts: Vec<Pair>,
    /// What has no counterpart, a line for each part.
    pub left_out: Vec<String>,
}

#[derive(Clone, Debug)]
struct Pair {
    /// Its number in each model.
    parts: [usize; 2],
    /// The same node in each, in the order of the part.
    nodes: Vec<[u32; 2]>,
}

/// Where two states are not the same.
#[derive(Clone, Debug, PartialEq)]
pub struct Divergence {
    /// Steps done.
    pub step: u64,
    /// Times, s.
    pub time: Value,
    /// Steps that lead to the next states, s, and who governs them.
    pub time_step: Value,
    /// Who governs them.
    pub governors: [String; 2],
    /// Parts of which something differs, in model order.
    pub parts: Vec<PartDivergence>,
    /// What differs of contacts and rigid bodies.
    pub others: Vec<(String, Value)>,
}

/// What differs of a part.
#[derive(Clone, Debug, PartialEq)]
pub struct PartDivergence {
    /// Its name.
    pub name: String,
    /// Nodes that it has.
    pub nodes: usize,
    /// Nodes that differ.
    pub differing: usize,
    /// The first of them by its number in the part.
    pub first: Option<NodeDivergence>,
    /// That whose velocities are farthest apart, if there are several.
    pub farthest: Option<NodeDivergence>,
    /// Stored and dissipated energy where they differ, J/m.
    pub energies: Vec<(&'static str, Value)>,
}

/// A node that differs.
#[derive(Clone, Debug, PartialEq)]
pub struct NodeDivergence {
    /// Its number in the part, and among all nodes of the first model.
    pub number: usize,
    /// The number that field files and messages have.
    pub user: u32,
    /// Position, velocity at the half step that follows, and the forces that led to it (those that are zero
    /// in both left out), with their units.
    pub values: Vec<(String, Value)>,
}

/// A number of two states.
#[derive(Clone, Copy, Debug)]
pub struct Value(pub f64, pub f64);

/// By bits: where not a number is in both, nothing differs.
impl PartialEq for Value {
    fn eq(&self, other: &Self) -> bool {
        [self.0, self.1].map(f64::to_bits) == [other.0, other.1].map(f64::to_bits)
    }
}

impl Value {
    /// Whether the bits are not the same.
    #[must_use]
    pub fn differs(self) -> bool {
        self.0.to_bits() != self.1.to_bits()
    }

    /// How many double-precision numbers lie from one to the other, the last one counted: 1 for neighbours, 0
    /// for 0 and −0. `None`: one is not a number.
    #[must_use]
    pub fn ulps(self) -> Option<u64> {
        if self.0.is_nan() || self.1.is_nan() {
            return None;
        }
        // Bits of positive numbers ascend with them.
        let place = |number: f64| {
            let bits = (number.to_bits() & (u64::MAX >> 1)) as i64;
            if number.is_sign_negative() { -bits } else { bits }
        };
        Some(place(self.0).abs_diff(place(self.1)))
    }
}

/// Names of the values of a node.
const NODE: [(&[&str], &str); 6] = [
    (&AXES, "position"),
    (&AXES, "velocity"),
    (&AXES, "force of the elements"),
    (&AXES, "contact force"),
    (&AXES, "load"),
    (&[""], "mass"),
];
const AXES: [&str; 3] = [" x", " y", " z"];
/// So many of the vectors are reported in any case.
const ALWAYS: usize = 2;

impl Pairing {
    /// Finds the parts that correspond.
    #[must_use]
    pub fn new(a: &Simulation, b: &Simulation) -> Self {
        match (&a.0, &b.0) {
            (Either::Plane(a), Either::Plane(b)) => Self::of([&a.system, &b.system]),
            (Either::Space(a), Either::Space(b)) => Self::of([&a.system, &b.system]),
            _ => Self { parts: Vec::new(), left_out: vec!["one run is 2D, the other one 3D".into()] },
        }
    }

    fn of<const D: usize>([a, b]: [&System<D>; 2]) -> Self
    where
        Dim<D>: Runs<D>,
    {
        let mut pairing = Self { parts: Vec::new(), left_out: Vec::new() };
        let [own, others] = [a, b].map(|system| &system.mesh.parts);
        for (index, part) in own.iter().enumerate() {
            let name = &part.name;
            let Some(other) = others.iter().position(|other| other.name == *name) else {
                pairing.left_out.push(format!("part \"{name}\" is in the first run only"));
                continue;
            };
            if part.nodes.len() != others[other].nodes.len() {
                let [a, b] = [part, &others[other]].map(|part| part.nodes.len());
                pairing.left_out.push(format!("part \"{name}\" has another mesh: {a} nodes, and {b}"));
            } else if cells(a, index) != cells(b, other) {
                pairing.left_out.push(format!("part \"{name}\" has another mesh: as many nodes, but other elements"));
            } else {
                let nodes = part.nodes.iter().zip(&others[other].nodes).map(|(&a, &b)| [a, b]).collect();
                pairing.parts.push(Pair { parts: [index, other], nodes });
            }
        }
        let is_new = |name: &&String| !own.iter().any(|part| part.name == **name);
        let new = others.iter().map(|part| &part.name).filter(is_new);
        pairing.left_out.extend(new.map(|name| format!("part \"{name}\" is in the second run only")));
        pairing
    }

    /// Whether no part has a counterpart: then nothing can be compared.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.parts.is_empty()
    }

    /// What is not the same in two states; `None`: all is.
    #[must_use]
    pub fn divergence(&self, a: &Simulation, b: &Simulation) -> Option<Divergence> {
        match (&a.0, &b.0) {
            (Either::Plane(a), Either::Plane(b)) => self.between([&a.system, &b.system]),
            (Either::Space(a), Either::Space(b)) => self.between([&a.system, &b.system]),
            _ => None,
        }
    }

    fn between<const D: usize>(&self, systems: [&System<D>; 2]) -> Option<Divergence>
    where
        Dim<D>: Runs<D>,
    {
        let [a, b] = systems;
        let parts: Vec<PartDivergence> = self.parts.iter().filter_map(|pair| pair.divergence(systems)).collect();
        let others = others(systems);
        let (time, time_step) = (Value(a.time, b.time), Value(a.time_step, b.time_step));
        let differs = time.differs() || time_step.differs() || !parts.is_empty() || !others.is_empty();
        let governors = || systems.map(|system| system.governor_name(system.governor));
        differs.then(|| Divergence { step: a.step, time, time_step, governors: governors(), parts, others })
    }
}

impl Pair {
    fn divergence<const D: usize>(&self, systems: [&System<D>; 2]) -> Option<PartDivergence>
    where
        Dim<D>: Runs<D>,
    {
        let moved = |&[a, b]: &[u32; 2]| {
            let of = |node: u32, system: &System<D>| {
                [system.positions[node as usize], system.velocities[node as usize]].map(|vector| vector.map(f64::to_bits))
            };
            of(a, systems[0]) != of(b, systems[1])
        };
        let differing: Vec<usize> = (0..self.nodes.len()).filter(|&number| moved(&self.nodes[number])).collect();
        let [a, b] = [0, 1].map(|k| hashes::energies(systems[k], self.parts[k]));
        let energies = a.flatten().zip(b.flatten()).zip(["stored energy", "dissipated energy"].into_iter().cycle());
        let energies: Vec<(&str, Value)> =
            energies.map(|((a, b), name)| (name, Value(a, b))).filter(|(_, value)| value.differs()).collect();
        if differing.is_empty() && energies.is_empty() {
            return None;
        }
        let apart = |number: usize| {
            let [a, b] = [0, 1].map(|k| systems[k].velocities[self.nodes[number][k] as usize]);
            dot(minus(a, b), minus(a, b))
        };
        let farthest = differing.iter().copied().reduce(|far, number| if apart(number) > apart(far) { number } else { far });
        Some(PartDivergence {
            name: systems[0].mesh.parts[self.parts[0]].name.clone(),
            nodes: self.nodes.len(),
            differing: differing.len(),
            first: differing.first().map(|&number| self.node(number, systems)),
            farthest: farthest.filter(|_| differing.len() > 1).map(|number| self.node(number, systems)),
            energies,
        })
    }

    fn node<const D: usize>(&self, number: usize, systems: [&System<D>; 2]) -> NodeDivergence
    where
        Dim<D>: Runs<D>,
    {
        let values = [0, 1].map(|k| {
            let (node, system) = (self.nodes[number][k] as usize, systems[k]);
            let internal = system.assembly.force(node, &system.slots);
            let contact = if system.contacts.is_empty() { [0.0; D] } else { system.contact_forces.of(node) };
            let load = system.forces.now().get(node).copied().unwrap_or([0.0; D]);
            let vectors = [system.positions[node], system.velocities[node], internal, contact, load];
            vectors.into_iter().flatten().chain([system.mass[node]]).collect::<Vec<f64>>()
        });
        let names = NODE.iter().flat_map(|(axes, name)| axes[..D.min(axes.len())].iter().map(move |axis| format!("{name}{axis}")));
        let values = names.zip(values[0].iter().zip(&values[1])).map(|(name, (&a, &b))| (name, Value(a, b)));
        let is_reported = |(k, (name, value)): &(usize, (String, Value))| {
            *k < ALWAYS * D || value.differs() || (*name != "mass" && (value.0 != 0.0 || value.1 != 0.0))
        };
        let reported = values.enumerate().filter(is_reported).map(|(_, value)| value).collect();
        NodeDivergence { number, user: systems[0].mesh.user_nodes[self.nodes[number][0] as usize], values: reported }
    }
}

/// What differs of contacts and rigid bodies that are in both; what is in one alone and acts differs by what
/// it does to parts, or by its hash.
fn others<const D: usize>(systems: [&System<D>; 2]) -> Vec<(String, Value)>
where
    Dim<D>: Runs<D>,
{
    let mut found = Vec::new();
    let mut hold = |what: &str, name: &str, names: &[&str], a: &[f64], b: &[f64]| {
        let values = names.iter().zip(a.iter().zip(b)).map(|(value, (&a, &b))| (format!("{value} of {what} \"{name}\""), Value(a, b)));
        found.extend(values.filter(|(_, value)| value.differs()));
    };
    let nothing = [0.0; CONTACT.len()];
    for contact in &systems[0].contacts {
        let other = systems[1].contacts.iter().find(|other| other.name == contact.name);
        let other = other.map_or(nothing, hashes::of_contact);
        hold(contact.kind.name(), &contact.name, &CONTACT, &hashes::of_contact(contact), &other);
    }
    for contact in systems[1].contacts.iter().filter(|contact| !systems[0].contacts.iter().any(|other| other.name == contact.name)) {
        hold(contact.kind.name(), &contact.name, &CONTACT, &nothing, &hashes::of_contact(contact));
    }
    for (name, body) in hashes::bodies(systems[0]) {
        if let Some((_, other)) = hashes::bodies(systems[1]).find(|(other, _)| *other == name) {
            hold("rigid body", name, <Dim<D>>::MOTION, &body, &other);
        }
    }
    found
}

/// What the elements of a part join, whatever the order in which they and their nodes are stored.
fn cells<const D: usize>(system: &System<D>, part: usize) -> u64
where
    Dim<D>: Runs<D>,
{
    let mut place = vec![0_u32; system.mesh.positions.len()];
    for (&node, number) in system.mesh.parts[part].nodes.iter().zip(0..) {
        place[node as usize] = number;
    }
    let of_cell = |(&user, cell): (&u32, Cell<'_>)| {
        let mut places: Vec<u32> = cell.nodes.iter().map(|&node| place[node as usize]).collect();
        // Elements are stored from whichever of their corners came first.
        let lowest = (0..places.len()).min_by_key(|&corner| places[corner]).unwrap_or(0);
        places.rotate_left(lowest);
        places.iter().fold(mixed(0, user.into()), |hash, &place| mixed(hash, place.into()))
    };
    let groups = system.mesh.groups_of(part);
    groups.flat_map(|group| group.user_elements.iter().zip(group.cells())).map(of_cell).fold(0, u64::wrapping_add)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ulps_count_the_numbers_between() {
        let ulps = |a: f64, b: f64| Value(a, b).ulps();
        assert_eq!(ulps(1.0, 1.0 + f64::EPSILON), Some(1));
        assert_eq!(ulps(1.0 - f64::EPSILON / 2.0, 1.0), Some(1));
        assert_eq!(ulps(0.0, -0.0), Some(0));
        assert!(Value(0.0, -0.0).differs());
        assert_eq!(ulps(-5e-324, 5e-324), Some(2));
        assert_eq!(ulps(f64::NAN, 1.0), None);
        assert!(!Value(f64::NAN, f64::NAN).differs());
        assert_eq!(ulps(1.0, 2.0), Some(1 << 52));
        assert!(ulps(f64::NEG_INFINITY, f64::INFINITY).is_some());
    }
}
