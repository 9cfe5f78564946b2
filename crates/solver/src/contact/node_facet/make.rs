//! Nodes against facets as they are made for a contact: what the passes know of stiffness and thickness, the
//! check of missed contacts, the edges, and the overlap check.

use super::super::formulation::{Passes, Setup};
use super::super::missed_contacts::MissedContactCheck;
use super::super::overlap::OverlapCheck;
use super::super::search::registry;
use super::super::slaves::PassInput;
use super::NodeFacet;
use crate::mesh::surface::SpaceSurface;
use crate::model::{self, Partners};

/// Whether edges meet edges too: a single pass looks at the nodes of one surface alone.
#[must_use]
pub fn meets_edges(contact: &model::Contact, passes: Passes) -> bool {
    matches!(contact.partners, Partners::Bodies(_)) || passes.len() > 1
}

impl NodeFacet {
    /// For the passes of a contact, and what looks at its bodies.
    pub(in crate::contact) fn of(mut setup: Setup<'_, 3>) -> (Self, OverlapCheck) {
        let Setup { contact, passes, bodies, positions, .. } = setup;
        let both = meets_edges(contact, passes);
        let inputs = passes.iter().map(|&pass| setup.input(pass, if both { 2 } else { 1 })).collect();
        let (tracker, reach) = (setup.tracker(), (setup.law)().reach());
        let surfaces = tracker.surfaces();
        let with_edges = both && contact.tied.is_none();
        let proof = MissedContactCheck::new(surfaces, passes, bodies, positions, with_edges, registry::<3>()[0].make);
        let inputs = with_thickness(inputs, &setup.overlap_check, surfaces, passes);
        let check = setup.overlap_check;
        let check = if with_edges { with_moduli(check, surfaces, passes, &inputs) } else { check.without_nets() };
        let made = Self::new(tracker, inputs, &contact.interface, reach, positions).with_proof(proof);
        (if with_edges { made.with_edges((setup.search)()) } else { made }, check)
    }

    /// The same together with what looks at its bodies.
    pub(in crate::contact) fn checked(setup: Setup<'_, 3>) -> Self {
        let (made, check) = Self::of(setup);
        made.with_check(check)
    }
}

/// The same with the local thickness of the bodies that an overlap check looks at.
#[must_use]
pub fn with_thickness(
    mut inputs: Vec<PassInput>,
    overlap_check: &OverlapCheck,
    surfaces: &[SpaceSurface],
    passes: Passes,
) -> Vec<PassInput> {
    let thickness: Vec<Vec<f64>> = surfaces.iter().map(|surface| overlap_check.thickness_at(&surface.nodes)).collect();
    for (input, &(slave, target)) in inputs.iter_mut().zip(passes) {
        let surface = &surfaces[target];
        let at = |node: &u32| surface.nodes.binary_search(node).map_or(f64::INFINITY, |rank| thickness[target][rank]);
        let facets = surface.facets.iter().map(|facet| facet.iter().map(at).fold(f64::INFINITY, f64::min));
        input.thickness = [thickness[slave].clone(), facets.collect()];
    }
    inputs
}

/// The same overlap check with the pressure stiffness of slaves, Pa/m.
#[must_use]
pub fn with_moduli(mut overlap_check: OverlapCheck, surfaces: &[SpaceSurface], passes: Passes, inputs: &[PassInput]) -> OverlapCheck {
    for (&(slave, _), input) in passes.iter().zip(inputs) {
        for (&node, own) in surfaces[slave].nodes.iter().zip(&input.slaves) {
            let [stiffness, of_mass] = [own.stiffness, own.of_mass].map(|sum| if own.area > 0.0 { sum / own.area } else { 0.0 });
            overlap_check.set_modulus(node, stiffness, of_mass);
        }
    }
    overlap_check
}
