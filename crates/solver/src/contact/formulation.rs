//! What a contact makes of its surfaces: the list of formulations, and what each is made from.
//!
//! The builder fills a [`Setup`] with plain numbers (contact knows nothing of elements); the formulation that the model names makes itself from it.
//! One formulation a file, one line in [`FORMULATIONS`].

use super::projection::node_segment::Target;
use super::search::Search;
use super::springs::Terms;
use super::{Formulation, Vector, law, node_segment, pinball, segment, tied};
use crate::error::Fault;
use crate::model::{self, ContactLaw, Penalty};

/// A formulation as the registry describes it.
#[derive(Clone, Copy)]
pub struct FormulationKind {
    /// Name in the model file.
    pub name: &'static str,
    /// One line: what meets what.
    pub doc: &'static str,
    /// Where it comes from.
    pub source: &'static str,
    /// Makes one. Faults have paths relative to the contact.
    pub make: fn(Setup<'_>) -> Result<Box<dyn Formulation>, Fault>,
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

/// A surface, and what contact needs of the elements behind it.
#[derive(Clone, Debug, Default)]
pub struct Side<'a> {
    /// The surface.
    pub target: Target,
    /// Pressure stiffness κ of the element behind each segment, Pa/m.
    pub segments: Vec<f64>,
    /// Tributary length (m) and κ (Pa/m) of each node.
    pub nodes: Vec<(f64, f64)>,
    /// Nodes of the element behind each segment, counter-clockwise.
    pub cells: Vec<&'a [u32]>,
}

impl Side<'_> {
    /// Smallest κ of its segments, Pa/m.
    #[must_use]
    pub fn softest(&self) -> f64 {
        self.segments.iter().copied().fold(f64::INFINITY, f64::min)
    }
}

/// What a formulation is made from.
pub struct Setup<'a> {
    /// The contact as the model has it.
    pub contact: &'a model::Contact,
    /// Two surfaces, or one that meets itself.
    pub sides: Vec<Side<'a>>,
    /// Initial positions, m.
    pub positions: &'a [Vector],
    /// What acts in its springs.
    pub terms: Terms,
    /// Number of the terms that its ties follow, where it is tied.
    pub tie_terms: usize,
    /// Makes a search of the kind that the contact names.
    pub search: &'a dyn Fn() -> Box<dyn Search<2>>,
}

impl Setup<'_> {
    /// Passes (slave, target) of nodes of every surface against the other.
    #[must_use]
    pub fn both_passes(&self) -> &'static [(usize, usize)] {
        if self.sides.len() == 1 { &[(0, 0)] } else { &[(0, 1), (1, 0)] }
    }

    /// Stiffness of the contact; of laws without one the automatic one, for what needs a scale.
    #[must_use]
    pub fn penalty(&self) -> Penalty {
        if let ContactLaw::Penalty(penalty) = self.contact.interface.law { penalty } else { Penalty::default() }
    }

    /// Refuses a stiffness per node, which formulations without slave nodes can't use.
    ///
    /// # Errors
    /// The fault.
    pub fn no_stiffness_per_node(&self) -> Result<(), Fault> {
        match self.penalty() {
            Penalty::PerNode(_) => Err(Fault::new(
                "penalty",
                format!(
                    "the formulation \"{}\" has no slave nodes that a stiffness per node could belong to",
                    self.contact.formulation.name()
                ),
                "give a pressure per depth (Pa/m), or leave it out",
            )),
            _ => Ok(()),
        }
    }

    /// Stiffness of slave node number `index` of a side against another side, N/m per metre of depth.
    #[must_use]
    pub fn node_stiffness(&self, side: usize, index: usize, other: f64, passes: usize) -> f64 {
        let Target { surface, mirrors } = &self.sides[side].target;
        let (tributary, own) = self.sides[side].nodes[index];
        let on_line = mirrors.binary_search_by_key(&surface.nodes[index], |&(node, _)| node).is_ok();
        let node = law::Node { tributary, own, other, share: if on_line { 0.5 } else { 1.0 } };
        law::penalty::stiffness(self.penalty(), node, passes)
    }
}
