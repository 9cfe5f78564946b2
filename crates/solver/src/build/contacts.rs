//! Contacts and obstacles of a model, in 2D and 3D: made at the start, and given new surfaces after erosion.

use super::{Builder, Builds, search_by_name, terms_of};
use crate::contact::formulation::{self, FormulationKind};
use crate::contact::search::SearchKind;
use crate::contact::{Contact, ContactKind};
use crate::error::Fault;
use crate::model;
use crate::model::messages::UNKNOWN_NAME;
use crate::tensor::Dim;
use std::collections::BTreeMap;

impl<const D: usize> Builder<'_, D>
where
    Dim<D>: Builds<D>,
{
    /// Contacts, then obstacles, both in the order of the model; notes faults.
    pub(super) fn contacts_and_obstacles(&mut self) -> Vec<Contact<D>> {
        let outlines = <Dim<D>>::outlines(self);
        let mut made = self.contacts(&outlines);
        made.extend(self.obstacles(&outlines));
        made
    }

    fn contacts(&mut self, outlines: &<Dim<D> as Builds<D>>::Outlines) -> Vec<Contact<D>> {
        let mut contacts = Vec::new();
        let mut tied = BTreeMap::new();
        for (i, contact) in self.model.contacts.iter().enumerate() {
            match <Dim<D>>::formulation(self, contact, outlines) {
                Ok((formulation, terms)) => {
                    let made = Contact::new(contact.name.clone(), ContactKind::Contact, formulation, terms, contact.interface.active);
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

    fn obstacles(&mut self, outlines: &<Dim<D> as Builds<D>>::Outlines) -> Vec<Contact<D>> {
        let mut contacts = Vec::new();
        for (i, obstacle) in self.model.obstacles.iter().enumerate() {
            match <Dim<D>>::obstacle(self, obstacle, outlines) {
                Ok((body, formulation)) => {
                    let (kind, terms) = (ContactKind::Obstacle(body), self.add_terms(terms_of(&obstacle.interface)));
                    contacts.push(Contact::new(obstacle.name.clone(), kind, formulation, terms, obstacle.interface.active));
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
        let (between, obstacles) = contacts.split_at_mut(self.model.contacts.len());
        for (model, contact) in self.model.contacts.iter().zip(between) {
            match <Dim<D>>::formulation(self, model, &outlines) {
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
