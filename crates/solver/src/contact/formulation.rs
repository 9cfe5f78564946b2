//! What a contact makes of its surfaces: the list of formulations, and what each is made from.
//!
//! The builder fills a [`Setup`] with plain numbers (contact knows nothing of elements); the formulation that
//! the model names makes itself from it. One formulation a file, one line in [`FORMULATIONS`].

use super::depths::Depths;
use super::initial::is_ignored;
use super::law::Law;
use super::node_segment::{Face, Slave};
use super::outline::{Outline, Outlines};
use super::projection::node_segment::Target;
use super::search::Search;
use super::tracker::Tracker;
use super::{Formulation, Tributary, Vector, law, node_segment, pinball, segment, tied};
use crate::error::Fault;
use crate::mesh::surface::tributary::Depth;
use crate::model::{self, Partners, Penalty, PenaltySource};
use std::collections::BTreeSet;

/// A formulation as the registry describes it.
#[derive(Clone, Copy)]
pub struct FormulationKind {
    /// Name in the model file.
    pub name: &'static str,
    /// One line: what meets what.
    pub doc: &'static str,
    /// Where it comes from.
    pub source: &'static str,
    /// Which nodes meet which surface.
    pub passes: fn(&model::Contact) -> Passes,
    /// Makes one. Faults have paths relative to the contact.
    pub make: fn(Setup<'_>) -> Result<Box<dyn Formulation<2>>, Fault>,
}

/// Every formulation.
pub const FORMULATIONS: &[FormulationKind] = &[node_segment::DOUBLE_PASS, node_segment::SINGLE_PASS, segment::KIND, pinball::KIND];

/// The formulation of a contact.
#[must_use]
pub fn kind_of(contact: &model::Contact) -> Option<&'static FormulationKind> {
    if contact.tied.is_some() {
        return Some(&tied::KIND);
    }
    let name = contact.formulation.name();
    FORMULATIONS.iter().find(|kind| kind.name == name)
}

/// Passes of a contact: (slave, target).
pub type Passes = &'static [(usize, usize)];

/// Nodes of each surface against the other, or of one against itself.
#[must_use]
pub fn both_passes(contact: &model::Contact) -> Passes {
    if matches!(contact.partners, Partners::Bodies(_)) { &[(0, 0)] } else { &[(0, 1), (1, 0)] }
}

/// Nodes of the slave surface against the other; where none is named the first one is slave.
#[must_use]
pub fn one_pass(contact: &model::Contact) -> Passes {
    if matches!(contact.formulation, model::Formulation::SinglePass { slave } if slave > 0) { &[(1, 0)] } else { &[(0, 1)] }
}

/// A surface, and what contact needs of the elements behind it.
#[derive(Clone, Debug, Default)]
pub struct Side<'a> {
    /// The surface.
    pub target: Target,
    /// Segments that were left out of it because they lie on a symmetry line.
    pub lids: Vec<[u32; 2]>,
    /// Pressure stiffness κ of the element behind each segment, Pa/m.
    pub segments: Vec<f64>,
    /// Part behind each segment.
    pub parts: Vec<u32>,
    /// What each node stands for.
    pub nodes: Vec<Tributary>,
    /// Nodes of the element behind each segment, counter-clockwise.
    pub cells: Vec<&'a [u32]>,
}

impl Side<'_> {
    /// Smallest κ of the segments of the same part, for each segment, Pa/m.
    #[must_use]
    pub fn softest(&self) -> Vec<f64> {
        let mut softest = vec![f64::INFINITY; self.parts.iter().max().map_or(0, |&part| part as usize + 1)];
        for (&stiffness, &part) in self.segments.iter().zip(&self.parts) {
            softest[part as usize] = stiffness.min(softest[part as usize]);
        }
        self.parts.iter().map(|&part| softest[part as usize]).collect()
    }
}

/// What a formulation is made from.
pub struct Setup<'a> {
    /// The contact as the model has it.
    pub contact: &'a model::Contact,
    /// Two surfaces, or one that meets itself.
    pub sides: Vec<Side<'a>>,
    /// Which nodes meet which of them.
    pub passes: Passes,
    /// Body of each node of the model.
    pub bodies: &'a [u32],
    /// Initial positions, m.
    pub positions: &'a [Vector],
    /// What lengths are multiplied by.
    pub depth: Depth,
    /// Makes the law of the normal force.
    pub law: &'a dyn Fn() -> Box<dyn Law>,
    /// Number of the terms that its ties follow; of a contact that is not tied those of all its springs.
    pub tie_terms: usize,
    /// Makes a search of the kind that the contact names.
    pub search: &'a dyn Fn() -> Box<dyn Search<2>>,
    /// Outlines of all bodies.
    pub outlines: &'a Outlines,
    /// Whether it will take over from one that has acted already, because surfaces have changed.
    pub rebuild: bool,
}

impl Setup<'_> {
    /// As [`law::penalty::penalty_of`].
    #[must_use]
    pub fn penalty(&self) -> Penalty {
        law::penalty::penalty_of(&self.contact.interface)
    }

    /// As [`is_ignored`].
    #[must_use]
    pub fn ignores_start(&self) -> bool {
        is_ignored(&self.contact.interface)
    }

    /// Sees how deep nodes are against the local thickness; where nothing is tied, and nothing overlaps at
    /// the start, bodies are checked as they are.
    #[must_use]
    pub fn depths(&self) -> Depths {
        let depths = Depths::new(self.sides.iter().map(|side| self.outlines.opposite(&side.target.surface)).collect());
        if self.ignores_start() || self.contact.tied.is_some() {
            return depths;
        }
        let body = |segment: &[u32; 2]| self.bodies.get(segment[0] as usize).copied().unwrap_or(0);
        let sides: Vec<BTreeSet<u32>> = self.sides.iter().map(|side| side.target.surface.segments.iter().map(body).collect()).collect();
        let last = sides.len() - 1;
        let on = |outline: &Outline| u8::from(sides[0].contains(&outline.body)) + 2 * u8::from(sides[last].contains(&outline.body));
        depths.judging(self.outlines.bodies.iter().map(|outline| (outline.clone(), on(outline))).filter(|(_, on)| *on > 0).collect())
    }

    /// Follows the nodes of the passes.
    #[must_use]
    pub fn tracker(self) -> Tracker {
        let (targets, lids): (Vec<_>, Vec<_>) = self.sides.into_iter().map(|side| (side.target, side.lids)).unzip();
        Tracker::new(targets, self.passes, (self.search)(), self.positions).with_bodies(self.bodies, &lids).with_ends(self.positions)
    }

    /// The nodes of a side as slaves in one of `passes` passes.
    #[must_use]
    pub fn slaves(&self, side: usize, passes: usize) -> Vec<Slave> {
        let Target { surface, mirrors } = &self.sides[side].target;
        let share = law::penalty::share_of_mass(self.penalty());
        let of = |(&own, node): (&Tributary, &u32)| {
            let on_line = mirrors.binary_search_by_key(node, |&(node, _)| node).is_ok();
            let node = law::Node { own, other: f64::INFINITY, share: if on_line { 0.5 } else { 1.0 } };
            // In a double pass each side carries half of the pressure.
            Slave {
                stiffness: law::penalty::stiffness(self.penalty(), node, passes),
                area: own.area / passes as f64,
                slip: 0.0,
                of_mass: share * own.of_mass * own.area / passes as f64,
            }
        };
        self.sides[side].nodes.iter().zip(&surface.nodes).map(of).collect()
    }

    /// α m / (dt² A) of the lighter node of each segment of a side, Pa/m.
    #[must_use]
    pub fn of_mass(&self, side: usize) -> Vec<f64> {
        let Side { target: Target { surface, .. }, nodes, .. } = &self.sides[side];
        let share = law::penalty::share_of_mass(self.penalty());
        let at = |node: u32| surface.nodes.binary_search(&node).ok().and_then(|at| nodes.get(at)).map_or(0.0, |own| share * own.of_mass);
        surface.segments.iter().map(|&[a, b]| at(a).min(at(b))).collect()
    }

    /// What each of the segments at the nodes of a side has of the node's tributary length and of its
    /// stiffness: [that which ends there, that which begins there].
    #[must_use]
    pub fn faces(&self, side: usize) -> Vec<[Face; 2]> {
        let Side { target, segments, .. } = &self.sides[side];
        let surface = &target.surface;
        let mut faces = vec![[Face::default(); 2]; surface.nodes.len()];
        for (&segment, stiffness) in surface.segments.iter().zip(segments) {
            let shares = self.depth.shares(segment.map(|node| self.positions[node as usize]));
            for (end, (node, length)) in segment.iter().zip(shares).enumerate() {
                if let Ok(at) = surface.nodes.binary_search(node) {
                    faces[at][1 - end] = Face { length, stiffness: length * stiffness };
                }
            }
        }
        let penalty = self.penalty();
        for [before, after] in &mut faces {
            let (whole, stiff) = (before.length + after.length, before.stiffness + after.stiffness);
            for face in [before, after] {
                face.length /= whole;
                face.stiffness = match penalty {
                    Penalty::Pressure(_) => face.length,
                    Penalty::Automatic { source: PenaltySource::WaveModulus | PenaltySource::BulkModulus, .. } if stiff > 0.0 => {
                        face.stiffness / stiff
                    }
                    // What is given for a node, or made from its mass, is the node's on any face.
                    Penalty::PerNode(_) | Penalty::Automatic { .. } => 1.0,
                };
            }
        }
        faces
    }

    /// Stiffness (N/m per metre of depth) of each node of a side by unit of pressure stiffness κ (Pa/m) of
    /// the target; empty where the stiffness is given.
    #[must_use]
    pub fn per_modulus(&self, side: usize, passes: usize) -> Vec<f64> {
        match self.penalty() {
            Penalty::Automatic { scale, .. } => self.sides[side].nodes.iter().map(|own| scale * own.area / passes as f64).collect(),
            Penalty::PerNode(_) | Penalty::Pressure(_) => Vec::new(),
        }
    }
}
