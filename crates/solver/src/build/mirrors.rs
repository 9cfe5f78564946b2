//! Symmetry lines as what bodies meet that are in contact with themselves: which nodes, and how stiff.

use super::plane::height;
use super::{Builder, law_of, stiffness_of};
use crate::contact::formulation::Side;
use crate::contact::law::{self, Law};
use crate::contact::mirror::{MirrorLine, MirroredNode};
use crate::contact::springs::{Tangential, Terms};
use crate::contact::tracker::SKIN;
use crate::contact::{Tributary, Vector, initial};
use crate::model::{ContactLaw, Interface, Partners};
use crate::{contact, model};

impl Builder<'_, 2> {
    /// The lines in which the bodies of a contact see their images, with the nodes of `side` that are not on them.
    pub(super) fn mirrors_of(&self, contact: &model::Contact, side: &Side<'_>) -> Vec<MirrorLine> {
        if !matches!(contact.partners, Partners::Bodies(_)) {
            return Vec::new();
        }
        let tolerance = initial::TOLERANCE * initial::size(&self.mesh.positions);
        let line = |(number, point, normal): (usize, Vector, Vector)| {
            let held = &self.model.symmetries[number].parts;
            let mut is_held = vec![held.is_empty(); self.mesh.positions.len()];
            for part in self.mesh.parts.iter().filter(|part| held.contains(&part.name)) {
                part.nodes.iter().for_each(|&node| is_held[node as usize] = true);
            }
            let surface = side.target.surface.nodes.iter().zip(&side.nodes);
            let nodes: Vec<MirroredNode> = surface
                .map(|(&node, &own)| (node, height(self.mesh.positions[node as usize], point, normal), own))
                .filter(|&(node, height, _)| is_held[node as usize] && height > tolerance)
                .map(|(node, height, own)| self.mirrored(&contact.interface, node, height, own))
                .collect();
            let mean = side.nodes.iter().map(|own| own.length).sum::<f64>() / side.nodes.len().max(1) as f64;
            MirrorLine { point, normal, nodes, reach: SKIN * mean + half_law(&contact.interface).reach() }
        };
        self.mirror_lines().map(line).collect()
    }

    fn mirrored(&self, interface: &Interface, node: u32, height: f64, own: Tributary) -> MirroredNode {
        let here = law::Node { own, other: own.stiffness, share: self.constraints.share(node) };
        // As a surface keeps from itself: no more than half of what lay between.
        let reach = 2.0 * half_law(interface).reach();
        let distance = 0.5 * (interface.thickness - (interface.thickness + reach - height).max(0.0));
        MirroredNode { node, stiffness: 4.0 * stiffness_of(interface, here, 2), area: own.area, distance }
    }
}

/// What acts between a node and its image, on half of the gap between them: they don't slide on each other.
pub(super) fn terms_of_mirrors(interface: &Interface) -> Terms {
    Terms { law: half_law(interface), tangential: Tangential::Free, damping: interface.damping }
}

/// The law of an interface as half of the gap sees it.
fn half_law(interface: &Interface) -> Box<dyn Law> {
    match &interface.law {
        ContactLaw::PressureGap { gaps, pressures } => {
            let halves: Vec<f64> = gaps.iter().map(|gap| 0.5 * gap).collect();
            Box::new(contact::law::pressure_gap::PressureGap::new(&halves, pressures))
        }
        _ => law_of(interface),
    }
}
