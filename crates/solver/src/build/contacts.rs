//! Contacts and obstacles of a model, in 2D and 3D: made at the start, and given new surfaces after erosion.

use super::{Builder, Builds, law_of, search_by_name, terms_of, terms_of_ties};
use crate::contact::formulation::{self, FormulationKind, Setup, Side, Surfaces};
use crate::contact::search::SearchKind;
use crate::contact::{Contact, ContactKind, Formulation};
use crate::error::Fault;
use crate::mesh::surface::Sided;
use crate::mesh::surface::tributary::Depth;
use crate::model;
use crate::model::messages::UNKNOWN_NAME;
use crate::model::{Partners, Window};
use crate::tensor::Dim;
use std::collections::BTreeMap;

impl<const D: usize> Builder<'_, D>
where
    Dim<D>: Builds<D>,
{
    /// When an interface acts.
    fn window(&self, interface: &model::Interface) -> Window {
        Window::of(self.model, &interface.stages, interface.active)
    }

    /// Contacts, obstacles, welds and joints, each in the order of the model; notes faults.
    pub(super) fn contacts_and_obstacles(&mut self) -> Vec<Contact<D>> {
        let outlines = <Dim<D>>::outlines(self);
        let mut made = self.contacts(&outlines);
        made.extend(self.obstacles(&outlines));
        made.extend(self.connections());
        made
    }

    fn contacts(&mut self, outlines: &<Dim<D> as Builds<D>>::Outlines) -> Vec<Contact<D>> {
        let mut contacts = Vec::new();
        let mut tied = BTreeMap::new();
        for (i, contact) in self.model.contacts.iter().enumerate() {
            match self.formulation(contact, outlines) {
                Ok((formulation, terms)) => {
                    let window = self.window(&contact.interface);
                    let made = Contact::new(contact.name.clone(), ContactKind::Contact, formulation, terms, window);
                    let made = if matches!(contact.partners, Partners::Bodies(_)) { made.of_bodies() } else { made };
                    if let Some(ties) = made.ties() {
                        self.tied_once(&format!("contact[{i}].tied"), &contact.name, &ties.nodes, &mut tied);
                    }
                    contacts.push(made);
                }
                Err(faults) => self.faults.extend(faults.into_iter().map(|fault| below(&format!("contact[{i}]"), fault))),
            }
        }
        contacts
    }

    /// What makes the springs of a contact, and the number of the terms that they follow. Faults have paths
    /// relative to the contact.
    fn formulation(
        &mut self,
        contact: &model::Contact,
        outlines: &<Dim<D> as Builds<D>>::Outlines,
    ) -> Result<(Box<dyn Formulation<D>>, usize), Vec<Fault>> {
        let (kind, search) = (kind_of(contact)?, search_of::<D>(contact)?);
        let Some(make) = <Dim<D>>::maker(kind) else { return Err(kind.refusal(D).into_iter().collect()) };
        let terms = self.add_terms(terms_of(&contact.interface));
        let tie_terms = if contact.tied.is_some() { self.add_terms(terms_of_ties(&contact.interface)) } else { terms };
        let surfaces = self.surfaces_of(contact)?;
        let sides: Vec<Side<'_, D>> = surfaces.into_iter().map(|surface| self.side(surface, &contact.interface)).collect();
        let mirrors = self.mirrors_of(contact, sides[0].surface.target.nodes(), &sides[0].nodes);
        let overlap_check = <Dim<D>>::overlap_check(self, contact, &sides, outlines).map_err(|fault| vec![fault])?;
        let setup = Setup {
            contact,
            sides,
            passes: (kind.passes)(contact),
            bodies: &self.body_of_node,
            positions: &self.mesh.positions,
            depth: Depth::of(self.model),
            law: &|| law_of(&contact.interface),
            tie_terms,
            search: &|| (search.make)(),
            overlap_check,
            rebuild: self.rebuild,
        };
        let made = make(setup).map_err(|fault| vec![fault])?;
        Ok((self.with_images(made, mirrors, contact), terms))
    }

    fn obstacles(&mut self, outlines: &<Dim<D> as Builds<D>>::Outlines) -> Vec<Contact<D>> {
        let mut contacts = Vec::new();
        for (i, obstacle) in self.model.obstacles.iter().enumerate() {
            match <Dim<D>>::obstacle(self, obstacle, outlines) {
                Ok((body, formulation)) => {
                    let (kind, terms) = (ContactKind::Obstacle(body), self.add_terms(terms_of(&obstacle.interface)));
                    contacts.push(Contact::new(obstacle.name.clone(), kind, formulation, terms, self.window(&obstacle.interface)));
                }
                Err(fault) => self.faults.push(below(&format!("obstacle[{i}]"), fault)),
            }
        }
        contacts
    }

    /// Gives contacts and obstacles, in the order in which they were made, the surfaces that the mesh has
    /// now; one without any ends.
    pub(super) fn rebuild_contacts(&mut self, contacts: &mut [Contact<D>]) {
        let outlines = <Dim<D>>::outlines(self);
        self.rebuild_connections(contacts);
        let (between, obstacles) = contacts.split_at_mut(self.model.contacts.len());
        for (model, contact) in self.model.contacts.iter().zip(between) {
            match self.formulation(model, &outlines) {
                Ok((formulation, _)) => contact.renew(formulation),
                Err(_) => contact.end(),
            }
        }
        for (model, contact) in self.model.obstacles.iter().zip(obstacles) {
            match <Dim<D>>::obstacle(self, model, &outlines) {
                Ok((_, formulation)) => contact.renew(formulation),
                Err(_) => contact.end(),
            }
        }
    }
}

/// The search that a contact names.
pub(super) fn search_of<const D: usize>(contact: &model::Contact) -> Result<SearchKind<D>, Vec<Fault>> {
    let unknown = || format!("there is no search \"{}\"", contact.search);
    search_by_name(&contact.search).ok_or_else(|| vec![Fault::new(&UNKNOWN_NAME, "search", unknown(), "see `embate list searches`")])
}

/// The formulation that a contact names.
pub(super) fn kind_of(contact: &model::Contact) -> Result<&'static FormulationKind, Vec<Fault>> {
    let unknown = || format!("there is no formulation \"{}\"", contact.formulation.name());
    let fault = || vec![Fault::new(&UNKNOWN_NAME, "formulation", unknown(), "see `embate list formulations`")];
    formulation::kind_of(contact).ok_or_else(fault)
}

/// A fault below a key.
pub(super) fn below(path: &str, fault: Fault) -> Fault {
    let dot = if fault.path.is_empty() || fault.path.starts_with('.') { "" } else { "." };
    Fault { path: format!("{path}{dot}{}", fault.path), ..fault }
}
