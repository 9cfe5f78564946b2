//! Symmetry lines, in 3D planes, as what bodies meet that are in contact with themselves: which nodes, and
//! how stiff.

use super::{Builder, Builds, law_of, stiffness_of};
use crate::contact::law::{self, Law};
use crate::contact::mirror::{Mirror, Mirrored, MirroredNode};
use crate::contact::springs::{Tangential, Terms};
use crate::contact::tracker::SKIN;
use crate::contact::{Formulation, Tributary};
use crate::mesh::PartMesh;
use crate::model::{ContactLaw, Interface, Partners};
use crate::tensor::Dim;
use crate::vector::{dot, first, minus, unit};
use crate::{contact, model};

impl<const D: usize> Builder<'_, D>
where
    Dim<D>: Builds<D>,
{
    /// Symmetry lines or planes behind which there is nothing of the parts that they hold: number, a point,
    /// and the unit normal that points to the parts.
    pub(crate) fn mirrors(&self) -> impl Iterator<Item = (usize, [f64; D], [f64; D])> {
        let tolerance = crate::mesh::tolerance(&self.mesh.positions);
        self.model.symmetries.iter().enumerate().filter_map(move |(number, symmetry)| {
            let (normal, point) = (unit(first(symmetry.normal))?, first(symmetry.point));
            let parts = self.mesh.parts.iter().filter(|part| symmetry.parts.is_empty() || symmetry.parts.contains(&part.name));
            let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
            for node in parts.flat_map(PartMesh::with_faces) {
                let distance = dot(minus(self.mesh.positions[node as usize], point), normal);
                (low, high) = (low.min(distance), high.max(distance));
            }
            if low >= -tolerance {
                Some((number, point, normal))
            } else {
                (high <= tolerance).then_some((number, point, normal.map(|n| -n)))
            }
        })
    }

    /// Where the bodies of a contact see their images, with those of the `nodes` of their surface that are
    /// not there, and what each stands for.
    pub(super) fn mirrors_of(&self, contact: &model::Contact, nodes: &[u32], own: &[Tributary]) -> Vec<Mirror<D>> {
        if !matches!(contact.partners, Partners::Bodies(_)) {
            return Vec::new();
        }
        let tolerance = crate::mesh::tolerance(&self.mesh.positions);
        let mirror = |(number, point, normal): (usize, [f64; D], [f64; D])| {
            let held = &self.model.symmetries[number].parts;
            let mut is_held = vec![held.is_empty(); self.mesh.positions.len()];
            for part in self.mesh.parts.iter().filter(|part| held.contains(&part.name)) {
                part.with_faces().for_each(|node| is_held[node as usize] = true);
            }
            let free: Vec<MirroredNode> = nodes
                .iter()
                .zip(own)
                .map(|(&node, &own)| (node, dot(minus(self.mesh.positions[node as usize], point), normal), own))
                .filter(|&(node, height, _)| is_held[node as usize] && height > tolerance)
                .map(|(node, height, own)| self.mirrored(&contact.interface, node, height, own))
                .collect();
            let spacing = |own: &Tributary| if D == 2 { own.length } else { own.area.sqrt() };
            let mean = own.iter().map(spacing).sum::<f64>() / own.len().max(1) as f64;
            Mirror { point, normal, nodes: free, reach: SKIN * mean + half_law(&contact.interface).reach() }
        };
        self.mirrors().map(mirror).collect()
    }

    /// A contact together with what its bodies do to their images.
    pub(super) fn with_images(
        &mut self,
        made: Box<dyn Formulation<D>>,
        mirrors: Vec<Mirror<D>>,
        contact: &model::Contact,
    ) -> Box<dyn Formulation<D>> {
        if mirrors.is_empty() {
            return made;
        }
        let terms = self.add_terms(terms_of_mirrors(&contact.interface));
        Box::new(Mirrored::new(made, mirrors, terms))
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
fn terms_of_mirrors(interface: &Interface) -> Terms {
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
