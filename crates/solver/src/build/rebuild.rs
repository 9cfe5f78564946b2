//! Contacts made again, after elements were eroded: by the same functions as at the start, of the surfaces of
//! the elements that are left.
//!
//! The mesh knows which elements those are, so outsides, sides and bodies follow; stiffnesses and lengths are
//! those of the initial configuration, as before. What was known of the past is handed over by
//! [`Contact::renew`].

use super::{Builder, Builds, NodeElements};
use crate::contact::rebuild::{ContactParts, ContactSource};
use crate::contact::{Contact, ContactKind};
use crate::load::curve::Curves;
use crate::load::join::Joins;
use crate::model::Model;
use crate::tensor::Dim;
use std::mem::take;

/// What contacts are made from beyond the mesh, kept for when surfaces change.
pub(super) struct RebuildSource<const D: usize> {
    pub(super) model: Model,
    pub(super) node_elements: NodeElements,
    pub(super) moduli: Vec<[f64; 3]>,
    pub(super) time_step: f64,
    /// Initial positions of all nodes, m.
    pub(super) positions: Vec<[f64; D]>,
}

impl<const D: usize> ContactSource<D> for RebuildSource<D>
where
    Dim<D>: Builds<D>,
{
    fn rebuild(&mut self, parts: ContactParts<'_, D>, contacts: &mut [Contact<D>]) {
        let made = contacts.iter().filter_map(|contact| match contact.kind {
            ContactKind::Obstacle(body) => Some((contact.name.clone(), body)),
            ContactKind::Contact | ContactKind::Weld | ContactKind::Joint => None,
        });
        let mut builder = Builder {
            constraints: take(parts.constraints),
            positions: take(&mut self.positions),
            mass: take(parts.mass),
            node_elements: take(&mut self.node_elements).into(),
            moduli: take(&mut self.moduli),
            time_step: self.time_step,
            bodies: take(parts.bodies),
            made: made.collect(),
            rebuild: true,
            ..Builder::of(&self.model, take(parts.mesh), Joins::default(), Curves::default())
        };
        builder.in_references(|builder| builder.rebuild_contacts(contacts));
        let Builder { mesh, constraints, positions, mass, node_elements, moduli, bodies, .. } = builder;
        (*parts.mesh, *parts.constraints, *parts.mass, *parts.bodies) = (mesh, constraints, mass, bodies);
        (self.positions, self.node_elements, self.moduli) = (positions, node_elements.into_inner().unwrap_or_default(), moduli);
    }
}
