//! Analysis of a failed run: the failure location, its neighbourhood, and what happened to both over the last
//! steps.
//!
//! After a failure [`Simulation::failure_entity`] names the failure location as the state of the failure
//! shows it. A second simulation of the same model, resumed from an earlier state, repeats the steps until
//! the failure, to the same last bit, and follows the location step by step ([`Simulation::follow`],
//! `trace.rs`). Values only; their page is written elsewhere.

mod acting;
mod mass;
mod neighbourhood;
mod trace;

pub use acting::Acting;
pub use mass::{Heavy, MassNeeded, PartNeeds};
pub use neighbourhood::{NearCell, Neighbourhood, RINGS};
pub use trace::{Jump, Moment, Trace, Vitals};

pub(crate) use neighbourhood::Near;

use crate::dimension::Dimension;
use crate::error::Error;
use crate::model::{Model, in_3d};
use crate::simulation::run::Run;
use crate::simulation::{Either, Runs, Simulation, either};
use crate::step::System;
use crate::tensor::Dim;
use crate::vector::dot;
use std::fmt;

/// Where it failed for a failure, by the user's names and numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum FailureLocation {
    /// An element.
    Element {
        /// Its part.
        part: String,
        /// Its number in the part.
        element: usize,
        /// Mean of its nodes, m.
        at: [f64; 3],
    },
    /// A node.
    Node {
        /// The first part that it belongs to; empty: it is a point of an obstacle.
        part: String,
        /// Its number in results.
        node: usize,
        /// Where it is, m.
        at: [f64; 3],
    },
    /// A contact or obstacle, at a node.
    Contact {
        /// `contact` or `obstacle`.
        kind: &'static str,
        /// Its name.
        name: String,
        /// The first part that the node belongs to.
        part: String,
        /// Number of the node in results.
        node: usize,
        /// Where the node is, m.
        at: [f64; 3],
    },
    /// Nothing that has a place.
    #[default]
    Nobody,
}

impl FailureLocation {
    /// Where it is, m.
    #[must_use]
    pub fn at(&self) -> Option<[f64; 3]> {
        match self {
            Self::Element { at, .. } | Self::Node { at, .. } | Self::Contact { at, .. } => Some(*at),
            Self::Nobody => None,
        }
    }

    /// Its part; empty: none.
    #[must_use]
    pub fn part(&self) -> &str {
        match self {
            Self::Element { part, .. } | Self::Node { part, .. } | Self::Contact { part, .. } => part,
            Self::Nobody => "",
        }
    }
}

impl fmt::Display for FailureLocation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let of = |part: &str| if part.is_empty() { String::new() } else { format!(" of part \"{part}\"") };
        match self {
            Self::Element { part, element, .. } => write!(f, "element {element}{}", of(part)),
            Self::Node { part, node, .. } => write!(f, "node {node}{}", of(part)),
            Self::Contact { kind, name, part, node, .. } => write!(f, "{kind} \"{name}\" at node {node}{}", of(part)),
            Self::Nobody => f.write_str("no element, node or contact alone"),
        }
    }
}

/// A failure location by the numbers of the solver: the same in every simulation of a model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FailureEntity {
    /// Place in the list of contacts and obstacles.
    pub(crate) contact: Option<usize>,
    pub(crate) node: Option<usize>,
    /// Group and element in it; where a node is the cause, that of its elements which is worst off.
    pub(crate) element: Option<(usize, usize)>,
}

impl FailureEntity {
    /// Whether there is no one to follow.
    #[must_use]
    pub fn is_nobody(&self) -> bool {
        self.node.is_none() && self.element.is_none()
    }
}

impl Simulation {
    /// From now on looks at a suspect, with what `at_failure`, the simulation that failed, has around it,
    /// after every step from number `from` on.
    pub fn follow(&mut self, failure_entity: &FailureEntity, at_failure: &Self, from: u64) {
        match (&mut self.0, &at_failure.0) {
            (Either::Plane(run), Either::Plane(failed)) => run.follow(failure_entity, failed, from),
            (Either::Space(run), Either::Space(failed)) => run.follow(failure_entity, failed, from),
            // Of another model, which is none of ours.
            _ => {}
        }
    }

    /// Where it failed for the failure that ended the run.
    #[must_use]
    pub fn failure_entity(&self, error: &Error) -> FailureEntity {
        either!(self, run => run.failure_entity(error))
    }

    /// A suspect by the user's names and numbers.
    #[must_use]
    pub fn failure_location(&self, failure_entity: &FailureEntity) -> FailureLocation {
        either!(self, run => run.failure_location(failure_entity))
    }

    /// What was seen since [`Simulation::follow`]; looks no more.
    pub fn take_trace(&mut self) -> Option<Trace> {
        either!(mut self, run => run.take_trace())
    }

    /// The state of a failure alone.
    #[must_use]
    pub fn trace_now(&self, failure_entity: &FailureEntity, error: Option<&Error>) -> Trace {
        either!(self, run => run.trace_now(failure_entity, error))
    }

    /// What is around a suspect now.
    #[must_use]
    pub fn neighbourhood(&self, failure_entity: &FailureEntity) -> Neighbourhood {
        either!(self, run => run.neighbourhood(failure_entity))
    }

    /// Constraints and loads of the model that act on the failure location or the elements next to it.
    #[must_use]
    pub fn acting(&self, model: &Model, failure_entity: &FailureEntity) -> Vec<Acting> {
        either!(self, run => run.acting(model, failure_entity))
    }
}

impl<const D: usize> System<D>
where
    Dim<D>: Dimension<D>,
{
    /// Where it failed for a failure, as the state shows it now.
    fn failure_entity(&self, error: &Error) -> FailureEntity {
        match error {
            Error::Inverted { .. } => self.failure_of_element(self.most_inverted()),
            Error::Collapsed { .. } => {
                let squared = self.joined_reports().time_step_squared;
                self.governing_element(squared)
                    .or_else(|| self.shortest_element())
                    .map_or(FailureEntity::default(), |it| self.failure_of_element(it))
            }
            Error::NotFinite { .. } => match (self.element_not_finite(), self.node_not_finite()) {
                (Some(element), _) => self.failure_of_element(element),
                (None, Some(node)) => self.failure_of_node(node),
                (None, None) => self.fastest_node().map_or(FailureEntity::default(), |node| self.failure_of_node(node)),
            },
            Error::TooDeep { .. } => {
                let contact = self.contacts.iter().position(|contact| self.is_too_deep(contact));
                let deepest = contact.and_then(|contact| self.deepest(&self.contacts[contact]));
                deepest.map_or(FailureEntity::default(), |(node, _)| FailureEntity { contact, ..self.failure_of_node(node) })
            }
            Error::Runaway { .. } => self.fastest_node().map_or(FailureEntity::default(), |node| self.failure_of_node(node)),
            _ => FailureEntity::default(),
        }
    }

    pub(crate) fn failure_of_element(&self, element: (usize, usize)) -> FailureEntity {
        FailureEntity { element: Some(element), ..FailureEntity::default() }
    }

    pub(crate) fn failure_of_node(&self, node: usize) -> FailureEntity {
        FailureEntity { node: Some(node), element: self.worst_element_at(node), contact: None }
    }

    /// Of the elements at a node the one with the shortest step.
    fn worst_element_at(&self, node: usize) -> Option<(usize, usize)> {
        let mut worst: Option<((usize, usize), f64)> = None;
        for (g, (group, block)) in self.mesh.groups.iter().zip(&self.blocks).enumerate() {
            for (element, _) in
                group.cells().enumerate().filter(|(element, cell)| cell.nodes.contains(&(node as u32)) && group.is_alive(*element))
            {
                let squared = block.time_step_squared(element);
                if worst.is_none_or(|(_, least)| !(squared >= least)) {
                    worst = Some(((g, element), squared));
                }
            }
        }
        worst.map(|(element, _)| element)
    }

    /// The element with the shortest step, springs left aside.
    fn shortest_element(&self) -> Option<(usize, usize)> {
        self.element_steps(|_| true).min_by(|(a, ..), (b, ..)| a.total_cmp(b)).map(|(_, g, element)| (g, element))
    }

    /// The first element whose stress or energy is no number.
    fn element_not_finite(&self) -> Option<(usize, usize)> {
        self.mesh.groups.iter().zip(&self.blocks).enumerate().filter(|(g, _)| !self.rigid[*g]).find_map(|(g, (group, block))| {
            let is_bad = |&element: &usize| {
                let state = block.state(element);
                group.is_alive(element) && !state.stress.iter().chain([&state.energy_density]).all(|value| value.is_finite())
            };
            (0..group.elements()).find(is_bad).map(|element| (g, element))
        })
    }

    /// The node whose kinetic energy changed most in the last update, and the contact that pressed most on
    /// it.
    fn hottest(&self) -> FailureEntity {
        let change = |node: usize| {
            let (old, new) = (self.velocities_old[node], self.velocities[node]);
            (self.mass[node] * (0..D).fold(dot(new, new), |sum, d| sum - old[d] * old[d])).abs()
        };
        let nodes = 0..self.mesh.user_nodes.len();
        let Some(node) = nodes.max_by(|&a, &b| change(a).total_cmp(&change(b))) else { return FailureEntity::default() };
        let force = |contact: usize| self.contacts[contact].force_on(&[node as u32], &self.springs);
        let pressing = (0..self.contacts.len()).filter(|&contact| force(contact) > 0.0);
        let contact = pressing.max_by(|&a, &b| force(a).total_cmp(&force(b)));
        FailureEntity { contact, ..self.failure_of_node(node) }
    }

    fn part_of_node(&self, node: usize) -> String {
        let is_in = |nodes: &[u32]| nodes.contains(&(node as u32));
        self.mesh.parts.iter().find(|part| is_in(&part.nodes) || is_in(&part.faces)).map_or(String::new(), |part| part.name.clone())
    }

    /// A suspect by the user's names.
    fn failure_location(&self, failure_entity: &FailureEntity) -> FailureLocation {
        let user = |node: usize| self.mesh.user_nodes.get(node).map_or(node, |&user| user as usize);
        // What is no number any more is shown where it was.
        let place = |node: usize| {
            let now = self.positions[node];
            in_3d(if now.iter().all(|x| x.is_finite()) { now } else { self.positions_old[node] })
        };
        match *failure_entity {
            FailureEntity { contact: Some(contact), node: Some(node), .. } => {
                let it = &self.contacts[contact];
                let (part, at) = (self.part_of_node(node), place(node));
                FailureLocation::Contact { kind: it.kind.name(), name: it.name.clone(), part, node: user(node), at }
            }
            FailureEntity { node: Some(node), .. } => {
                FailureLocation::Node { part: self.part_of_node(node), node: user(node), at: place(node) }
            }
            FailureEntity { element: Some((g, element)), .. } => {
                let group = &self.mesh.groups[g];
                let part = self.mesh.parts[group.part].name.clone();
                FailureLocation::Element {
                    part,
                    element: group.user_elements[element] as usize,
                    at: in_3d(self.centre(group.nodes_of(element))),
                }
            }
            _ => FailureLocation::Nobody,
        }
    }
}

impl<const D: usize> Run<D>
where
    Dim<D>: Runs<D>,
{
    /// Where it failed for the failure that ended the run.
    pub(crate) fn failure_entity(&self, error: &Error) -> FailureEntity {
        self.system.failure_entity(error)
    }

    /// A suspect by the user's names and numbers.
    pub(crate) fn failure_location(&self, failure_entity: &FailureEntity) -> FailureLocation {
        self.system.failure_location(failure_entity)
    }
}
