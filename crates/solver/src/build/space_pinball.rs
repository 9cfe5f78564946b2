//! Pinballs between surfaces in 3D: the surfaces that a contact names, the elements behind their facets
//! and their stiffness.

use super::contacts::search_of;
use super::space_contact::Sided;
use super::{Builder, law_of, terms_of};
use crate::contact::checked::Checked;
use crate::contact::pinball::space::{Layer, Pinball};
use crate::contact::{Formulation, law};
use crate::error::Fault;
use crate::model;

impl Builder<'_, 3> {
    /// What makes the springs of a contact between balls, and the number of the terms that they follow.
    /// Faults have paths relative to the contact.
    pub(super) fn pinball_in_3d(&mut self, contact: &model::Contact) -> Result<(Box<dyn Formulation<3>>, usize), Vec<Fault>> {
        let terms = self.add_terms(terms_of(&contact.interface));
        let (search, surfaces) = ((search_of(contact)?.make)(), self.surfaces_in_3d(contact)?);
        let Sided { nodes, .. } = self.sided(&surfaces[0], &contact.interface);
        let mirrors = self.mirrors_of(contact, &surfaces[0].nodes, &nodes);
        let layers = surfaces.iter().map(|surface| {
            let Sided { facets: stiffness, .. } = self.sided(surface, &contact.interface);
            let cell = |&facet: &[u32; 4]| self.under(facet).map(|under| self.mesh.groups[under.group].cell(under.element));
            Layer { surface, cells: surface.facets.iter().map(cell).collect(), stiffness }
        });
        let layers: Vec<Layer<'_>> = layers.collect();
        let penalty = law::penalty::penalty_of(&contact.interface);
        let reach = law_of(&contact.interface).reach();
        let made = Pinball::new(&layers, contact, penalty, reach, search, (&self.body_of_node, &self.mesh.positions));
        let made = Checked::new(Box::new(made), self.overlap_check(&surfaces, contact)?.without_nets());
        Ok((self.with_images(Box::new(made), mirrors, contact), terms))
    }
}
