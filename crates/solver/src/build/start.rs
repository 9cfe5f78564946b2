//! Penetrations at the start, found before anything is strained: refused, ignored, or pushed out.

use super::{Builder, Outlined, search_by_name};
use crate::contact::initial;
use crate::contact::search::Search;
use crate::contact::tracker::Tracker;
use crate::error::Fault;
use crate::mesh::Mesh;
use crate::model::{self, Formulation, InitialPenetration, Interface, Partners};

impl Builder<'_> {
    /// Penetrations of the contacts at the start: faults, or lines for the overview. Those that shall be pushed out are, in the mesh.
    pub(super) fn part_at_start(&mut self) -> Vec<String> {
        let mut lines = Vec::new();
        let mut is_moved = false;
        for (i, contact) in self.model.contacts.iter().enumerate() {
            let Interface { initial_penetration, thickness, active, .. } = contact.interface;
            // Ties hold what is there; who begins later can't know. Wrong surfaces are told when contacts are made.
            if contact.tied.is_some() || active[0] > 0.0 {
                continue;
            }
            let (Ok(outlines), Some(search)) = (self.outlines_of(contact), search_by_name(&contact.search)) else { continue };
            let mut tracker = tracker(outlines, passes_of(contact), (search.make)(), &self.mesh);
            let tolerance = initial::TOLERANCE * initial::size(&self.mesh.positions);
            let found = initial::penetrations(&mut tracker, thickness, &self.mesh.positions, tolerance);
            let path = format!("contact[{i}]");
            match initial_penetration {
                InitialPenetration::Error => self.faults.extend(initial::faults(&path, &contact.name, &found)),
                InitialPenetration::Ignore => lines.extend(initial::lines(&contact.name, &found, "this counts as zero")),
                InitialPenetration::PushOut => {
                    lines.extend(initial::lines(&contact.name, &found, "it was pushed out"));
                    is_moved |= !found.is_empty();
                    let left = initial::push_out(&mut tracker, thickness, &mut self.mesh.positions, &self.constraints, tolerance);
                    self.faults.extend(initial::faults(&path, &contact.name, &left).into_iter().map(|fault| Fault {
                        message: format!("{} and can't be pushed out", fault.message),
                        help: "move the bodies apart".into(),
                        ..fault
                    }));
                }
            }
        }
        self.positions.clone_from(&self.mesh.positions);
        if is_moved && self.faults.is_empty() {
            self.faults.extend(self.mesh.faults_of_elements());
        }
        lines
    }
}

/// Which nodes meet which surface: (slave, target).
fn passes_of(contact: &model::Contact) -> &'static [(usize, usize)] {
    match (&contact.partners, contact.formulation) {
        (Partners::Bodies(_), _) => &[(0, 0)],
        (_, Formulation::SinglePass { slave: 0 }) => &[(0, 1)],
        (_, Formulation::SinglePass { .. }) => &[(1, 0)],
        _ => &[(0, 1), (1, 0)],
    }
}

fn tracker(outlines: Vec<Outlined>, passes: &[(usize, usize)], search: Box<dyn Search<2>>, mesh: &Mesh<2>) -> Tracker {
    let (targets, lids): (Vec<_>, Vec<_>) = outlines.into_iter().map(|Outlined { target, lids }| (target, lids)).unzip();
    Tracker::new(targets, passes, search, &mesh.positions).with_bodies(&mesh.bodies(), &lids)
}
