//! Penetrations of solids at the start, pushed out before anything is strained.

use super::Builder;
use super::space_contact::meets_edges;
use super::start::ROUNDS;
use crate::contact::formulation;
use crate::contact::initial;
use crate::contact::initial::space::{Look, Movable};
use crate::contact::search::Search;
use crate::error::Fault;
use crate::model;

impl Builder<'_, 3> {
    /// Does something with the first look of a contact at its surfaces. Wrong surfaces see nothing: they are told when contacts are made.
    pub(super) fn look<T>(&self, contact: &model::Contact, act: impl FnOnce(&Look<'_>) -> T) -> T {
        let tracker = || self.tracker_in_space(contact).ok().map(|(tracker, _)| tracker);
        let search = || -> Option<Box<dyn Search<3>>> { Self::search_in_space(contact).ok() };
        let with_edges = formulation::kind_of(contact).is_some_and(|kind| meets_edges(contact, (kind.passes)(contact)));
        act(&Look { tracker: &tracker, edges: if with_edges { Some(&search) } else { None }, thickness: contact.interface.thickness })
    }

    /// Pushes nodes out of the bodies of these contacts, in the mesh.
    pub(super) fn push_out_in_space(&mut self, contacts: &[usize], tolerance: f64) {
        if contacts.is_empty() {
            return;
        }
        let (model, mut positions, mut is_moved) = (self.model, self.mesh.positions.clone(), false);
        for _ in 0..ROUNDS {
            let mut movable = Movable { positions: &mut positions, constraints: &self.constraints, tolerance };
            let mut moves = false;
            for &i in contacts {
                moves |= self.look(&model.contacts[i], |look| movable.push_out(look));
            }
            is_moved |= moves;
            if !moves {
                break;
            }
        }
        for &i in contacts {
            let contact = &model.contacts[i];
            let left = self.look(contact, |look| look.penetrations(&positions, tolerance));
            let faults = initial::faults(&format!("contact[{i}]"), &contact.name, &left);
            self.faults.extend(faults.into_iter().map(|fault| Fault {
                message: format!("{} and can't be pushed out", fault.message),
                help: "move the bodies apart".into(),
                ..fault
            }));
        }
        if is_moved {
            self.positions.clone_from(&positions);
            self.mesh.positions = positions;
            if self.faults.is_empty() {
                self.faults.extend(self.mesh.faults_of_elements());
            }
        }
    }
}
