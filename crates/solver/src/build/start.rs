//! Penetrations at the start, found before anything is strained: refused, ignored, or pushed out.

mod plane;
mod space;

use super::contacts::search_of;
use super::inside_out::turned;
use super::{Builder, Builds};
use crate::contact::formulation::{self, Surfaces};
use crate::contact::initial::{self, Look, Movable, Penetration};
use crate::contact::node_facet::make::meets_edges;
use crate::error::Fault;
use crate::model::{self, InitialPenetration};
use crate::tensor::Dim;

/// Rounds over all contacts and obstacles: what is pushed out of one may come into another.
const ROUNDS: usize = 20;

/// What nodes are pushed out of.
pub enum Meeting<const D: usize>
where
    Dim<D>: Builds<D>,
{
    /// Other surfaces: those of a contact, or of an obstacle that is made of facets.
    Surfaces {
        /// Number of the contact; `None`: of an obstacle.
        contact: Option<usize>,
        /// Finds what is inside.
        look: Look<D>,
        /// Nodes of the obstacle, which follow those of the model, m.
        points: Vec<[f64; D]>,
    },
    /// An obstacle with a shape.
    Shape {
        /// Nodes that it may press.
        nodes: Vec<u32>,
        /// Where they are with respect to it.
        distance: Distance<D>,
    },
}

/// Gap (m) and normal of a point at an obstacle; `None` where the obstacle is not.
pub(super) type Distance<const D: usize> = Box<dyn Fn([f64; D]) -> Option<(f64, [f64; D])>>;

/// What is inside an obstacle at the start, and how it is pushed out where that is wanted.
pub(super) type AtStart<const D: usize> = (Vec<Penetration<D>>, Vec<Meeting<D>>);

impl<const D: usize> Builder<'_, D>
where
    Dim<D>: Builds<D>,
{
    /// Notes penetrations at the start as faults, or gives a line of each contact for the overview; those
    /// that shall be pushed out are, in the mesh.
    pub(super) fn resolve_initial_penetration(&mut self) -> Vec<String> {
        let tolerance = crate::mesh::tolerance(&self.mesh.positions);
        let (model, mut lines, mut meetings) = (self.model, Vec::new(), Vec::new());
        for (i, contact) in model.contacts.iter().enumerate() {
            // Ties hold what is there; who begins later can't know. Wrong surfaces are reported when contacts
            // are made.
            if contact.tied.is_some() || contact.interface.active[0] > 0.0 {
                continue;
            }
            let Some(mut look) = self.look(contact) else { continue };
            let found = look.penetrations(&self.mesh.positions, tolerance);
            match contact.interface.initial_penetration {
                InitialPenetration::Error => {
                    let fault = initial::fault(model, &format!("contact[{i}]"), &contact.name, &found, None);
                    self.faults.extend(fault.map(|fault| beside_ties(model, contact, fault)));
                }
                InitialPenetration::Ignore => lines.extend(initial::line(&contact.name, &found, IGNORED)),
                InitialPenetration::PushOut => {
                    lines.extend(initial::line(&contact.name, &found, PUSHED));
                    meetings.push(Meeting::Surfaces { contact: Some(i), look, points: Vec::new() });
                }
            }
        }
        for (i, obstacle) in model.obstacles.iter().enumerate().filter(|(_, it)| it.interface.active[0] <= 0.0) {
            let what = match obstacle.interface.initial_penetration {
                // Faults are reported when all springs are known: nothing can be seen better. Beside others
                // now, because then there will be no springs.
                InitialPenetration::Error => {
                    if !self.faults.is_empty() {
                        let (found, _) = <Dim<D>>::obstacle_at_start(self, obstacle, tolerance);
                        let hint = turned(obstacle, &self.mesh, found.len());
                        self.faults.extend(initial::fault(model, &format!("obstacle[{i}]"), &obstacle.name, &found, hint));
                    }
                    continue;
                }
                InitialPenetration::Ignore => IGNORED,
                InitialPenetration::PushOut => PUSHED,
            };
            let (found, met) = <Dim<D>>::obstacle_at_start(self, obstacle, tolerance);
            lines.extend(initial::line(&obstacle.name, &found, what));
            meetings.extend(met);
        }
        // In 2D nodes go out of shapes first.
        if D == 2 {
            meetings.sort_by_key(|meeting| matches!(meeting, Meeting::Surfaces { .. }));
        }
        self.push_out(&mut meetings, tolerance);
        lines.extend(<Dim<D>>::left_at_start(self, tolerance));
        lines
    }

    /// The first look of a contact at its surfaces; `None`: they are wrong.
    fn look(&self, contact: &model::Contact) -> Option<Look<D>> {
        let (surfaces, search, kind) = (self.surfaces_of(contact).ok()?, search_of::<D>(contact).ok()?, formulation::kind_of(contact)?);
        <Dim<D>>::maker(kind)?;
        let passes = (kind.passes)(contact);
        let tracker = <Dim<D>>::tracker(surfaces, passes, (search.make)(), &self.body_of_node, &self.mesh.positions);
        Some(Look::new(tracker, meets_edges(contact, passes).then_some(search.make), contact.interface.thickness))
    }

    /// Pushes nodes out of each other's bodies and out of obstacles, in the mesh. What is left behind
    /// obstacles is reported when all springs are known.
    fn push_out(&mut self, meetings: &mut [Meeting<D>], tolerance: f64) {
        let (count, mut is_moved) = (self.mesh.positions.len(), false);
        for _ in 0..ROUNDS {
            let mut moves = false;
            let mut movable = Movable { positions: &mut self.mesh.positions, count, constraints: &self.constraints, tolerance };
            for meeting in &mut *meetings {
                moves |= match meeting {
                    Meeting::Surfaces { look, points, .. } => {
                        movable.positions.extend(&*points);
                        let moves = movable.push_out(look);
                        movable.positions.truncate(count);
                        moves
                    }
                    Meeting::Shape { nodes, distance } => movable.push_off(nodes, &*distance),
                };
            }
            is_moved |= moves;
            if !moves {
                break;
            }
        }
        for meeting in meetings {
            let Meeting::Surfaces { contact: Some(i), look, .. } = meeting else { continue };
            let left = look.penetrations(&self.mesh.positions, tolerance);
            let fault = initial::fault(self.model, &format!("contact[{i}]"), &self.model.contacts[*i].name, &left, None);
            self.faults.extend(fault.map(stuck));
        }
        if is_moved {
            self.positions.clone_from(&self.mesh.positions);
            if self.faults.is_empty() {
                self.faults.extend(self.mesh.faults_of_elements());
            }
        }
    }
}

/// The fault of a contact of bodies, where others are tied: ties hold surfaces that need not fit.
fn beside_ties(model: &model::Model, contact: &model::Contact, fault: Fault) -> Fault {
    let is_beside = matches!(contact.partners, model::Partners::Bodies(_)) && model.contacts.iter().any(|it| it.tied.is_some());
    match is_beside {
        true => Fault { help: format!("{}; where it is at a tie, whose surfaces need not fit, \"ignore\" is right", fault.help), ..fault },
        false => fault,
    }
}

/// What is done, in words.
pub(super) const IGNORED: &str = "this counts as zero";
const PUSHED: &str = "it was pushed out";

/// The fault of what stays inside.
pub(super) fn stuck(fault: Fault) -> Fault {
    Fault { message: format!("{} and can't be pushed out", fault.message), help: "move the bodies apart".into(), ..fault }
}
