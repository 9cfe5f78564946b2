//! Contacts made again, after elements were eroded: by the same functions as at the start, of the surfaces of the elements that are left.
//!
//! The mesh knows which elements those are, so outsides, sides and bodies follow; stiffnesses and lengths are those of the initial configuration, as ever. What was known of the past is
//! handed over by [`Contact::renew`].

use super::{Builder, Fans};
use crate::contact::{Contact, ContactKind};
use crate::load::constraint::Constraints;
use crate::mesh::Mesh;
use crate::model::Model;
use crate::rigid::Bodies;
use crate::tensor::Dim;
use crate::world::World;
use std::mem::take;

/// What contacts are made from beyond the mesh, kept for when surfaces change.
pub(crate) struct Origin<const D: usize> {
    pub(super) model: Model,
    pub(super) fans: Fans,
    pub(super) moduli: Vec<[f64; 2]>,
    pub(super) time_step: f64,
    /// Initial positions of all nodes, m.
    pub(super) positions: Vec<[f64; D]>,
}

/// Parts of the system that contacts are made from; lent for the time that takes.
pub(crate) struct Lent<'a, const D: usize>
where
    Dim<D>: World<D>,
{
    pub(crate) mesh: &'a mut Mesh<D>,
    pub(crate) constraints: &'a mut Constraints<D>,
    pub(crate) mass: &'a mut Vec<f64>,
    pub(crate) bodies: &'a mut Bodies<D>,
}

impl<const D: usize> Origin<D>
where
    Dim<D>: World<D>,
{
    /// Gives every contact new surfaces; one that has none any more ends.
    pub(crate) fn renew(&mut self, lent: Lent<'_, D>, contacts: &mut [Contact<D>]) {
        let made = contacts.iter().filter_map(|contact| match contact.kind {
            ContactKind::Obstacle(body) => Some((contact.name.clone(), body)),
            ContactKind::Contact => None,
        });
        let mut builder = Builder {
            model: &self.model,
            body_of_node: lent.mesh.bodies(),
            mesh: take(lent.mesh),
            constraints: take(lent.constraints),
            joins: Default::default(),
            curves: Default::default(),
            faults: Vec::new(),
            positions: take(&mut self.positions),
            mass: take(lent.mass),
            fans: take(&mut self.fans).into(),
            moduli: take(&mut self.moduli),
            time_step: self.time_step,
            bodies: take(lent.bodies),
            body_parts: Vec::new(),
            terms: Vec::new(),
            outlines: Vec::new(),
            made: made.collect(),
            again: true,
        };
        <Dim<D>>::renew(&mut builder, contacts);
        let Builder { mesh, constraints, positions, mass, fans, moduli, bodies, .. } = builder;
        (*lent.mesh, *lent.constraints, *lent.mass, *lent.bodies) = (mesh, constraints, mass, bodies);
        (self.positions, self.fans, self.moduli) = (positions, fans.into_inner().unwrap_or_default(), moduli);
    }
}

impl Builder<'_, 2> {
    /// Makes contacts again, of the surfaces that are left.
    pub(crate) fn renew(&mut self, contacts: &mut [Contact]) {
        // Contacts come first, then obstacles, both in model order.
        let (between, obstacles) = contacts.split_at_mut(self.model.contacts.len());
        let outlines = self.outlines();
        for (model, contact) in self.model.contacts.iter().zip(between) {
            match self.formulation(model, &outlines) {
                Ok((formulation, _)) => contact.renew(formulation),
                Err(_) => contact.end(),
            }
        }
        for (model, contact) in self.model.obstacles.iter().zip(obstacles) {
            match self.obstacle_formulation(model, &outlines) {
                Ok((_, formulation)) => contact.renew(formulation),
                Err(_) => contact.end(),
            }
        }
    }
}
