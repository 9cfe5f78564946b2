//! Penetrations of solids at the start, pushed out before anything is strained.

use super::Builder;
use super::contacts::search_of;
use super::space_contact::meets_edges;
use super::start::{IGNORED, PUSHED, ROUNDS};
use crate::contact::formulation;
use crate::contact::initial::space::{Look, Movable};
use crate::contact::initial::{self, Inside, Penetration};
use crate::contact::obstacle::space::{Solid, Vector};
use crate::contact::search::Search;
use crate::error::Fault;
use crate::mesh::surface::SpaceSurface;
use crate::model::{self, InitialPenetration, ObstacleShape, TriangleSurface};
use crate::vector::minus;

impl<'m> Builder<'m, 3> {
    /// Does something with the first look of a contact at its surfaces. Wrong surfaces see nothing: they are
    /// reported when contacts are made.
    pub(super) fn look<T>(&self, contact: &model::Contact, act: impl FnOnce(&Look<'_>) -> T) -> T {
        let tracker = || self.tracker_in_3d(contact).ok().map(|(tracker, _)| tracker);
        let search = || -> Option<Box<dyn Search<3>>> { search_of(contact).ok().map(|search| (search.make)()) };
        let with_edges = formulation::kind_of(contact).is_some_and(|kind| meets_edges(contact, (kind.passes)(contact)));
        act(&Look { tracker: &tracker, edges: if with_edges { Some(&search) } else { None }, thickness: contact.interface.thickness })
    }

    /// What obstacles do to nodes that are inside of them at the start: lines for the overview, and those out
    /// of which nodes are pushed. Faults are reported when all springs are known.
    pub(super) fn obstacles_at_start(&self, tolerance: f64) -> (Vec<String>, Vec<Meeting<'m>>) {
        let (model, mut lines, mut pushed) = (self.model, Vec::new(), Vec::new());
        for obstacle in model.obstacles.iter().filter(|it| it.interface.active[0] <= 0.0) {
            let what = match obstacle.interface.initial_penetration {
                InitialPenetration::Error => continue,
                InitialPenetration::Ignore => IGNORED,
                InitialPenetration::PushOut => PUSHED,
            };
            // Wrong parts and shapes are reported when obstacles are made.
            let Ok(outside) = self.outside_met(obstacle) else { continue };
            if let ObstacleShape::Triangles(surface) = &obstacle.shape {
                let thickness = obstacle.interface.thickness;
                if what == PUSHED {
                    let found = self.penetrations_of_triangles(surface, outside.clone(), thickness, tolerance);
                    lines.extend(initial::lines(&obstacle.name, &found, what));
                    pushed.push(Meeting::Triangles { surface, outside, thickness });
                }
                continue;
            }
            let Ok((reference, solid, _)) = self.solid(obstacle) else { continue };
            let nodes = self.nodes_pressed(obstacle, &outside);
            let inside = |&node: &u32| {
                let place = self.mesh.positions[node as usize];
                let depth = -solid.distance(minus(place, reference)).0;
                (depth > tolerance).then_some(Penetration { what: Inside::Node, place, depth })
            };
            lines.extend(initial::lines(&obstacle.name, &nodes.iter().filter_map(inside).collect::<Vec<_>>(), what));
            if what == PUSHED {
                pushed.push(Meeting::Solid { nodes, solid, reference });
            }
        }
        (lines, pushed)
    }

    /// Pushes nodes out of each other's bodies and out of obstacles, in the mesh. What is left behind
    /// obstacles is reported when all springs are known.
    pub(super) fn push_out_in_3d(&mut self, meetings: &[Meeting<'_>], tolerance: f64) {
        if meetings.is_empty() {
            return;
        }
        let (model, mut positions, mut is_moved) = (self.model, self.mesh.positions.clone(), false);
        let count = positions.len();
        for _ in 0..ROUNDS {
            let mut moves = false;
            for meeting in meetings {
                if let Meeting::Triangles { surface, .. } = meeting {
                    positions.extend(&surface.positions);
                }
                let mut movable = Movable { positions: &mut positions, count, constraints: &self.constraints, tolerance };
                moves |= match meeting {
                    Meeting::Contact(i) => self.look(&model.contacts[*i], |look| movable.push_out(look)),
                    Meeting::Solid { nodes, solid, reference } => movable.push_off(nodes, |x| solid.distance(minus(x, *reference))),
                    Meeting::Triangles { surface, outside, thickness } => {
                        self.look_at_triangles(surface, outside, *thickness, |look| movable.push_out(look))
                    }
                };
                positions.truncate(count);
            }
            is_moved |= moves;
            if !moves {
                break;
            }
        }
        for meeting in meetings {
            let Meeting::Contact(i) = meeting else { continue };
            let contact = &model.contacts[*i];
            let left = self.look(contact, |look| look.penetrations(&positions, tolerance));
            let faults = initial::faults(&format!("contact[{i}]"), &contact.name, &left);
            self.faults.extend(faults.into_iter().map(stuck));
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

/// What nodes are pushed out of.
pub(super) enum Meeting<'a> {
    /// Bodies of the contact with this number.
    Contact(usize),
    /// A plane, a ball or a cylinder, seen from its reference point, m.
    Solid { nodes: Vec<u32>, solid: Solid, reference: Vector },
    /// Triangles, with the outside of what meets them, and the distance that they keep, m.
    Triangles { surface: &'a TriangleSurface, outside: SpaceSurface, thickness: f64 },
}

/// The fault of what stays inside.
pub(super) fn stuck(fault: Fault) -> Fault {
    Fault { message: format!("{} and can't be pushed out", fault.message), help: "move the bodies apart".into(), ..fault }
}
