//! Initial velocities, and the rigid bodies that are made of elements.

use super::{Builder, Builds};
use crate::error::Fault;
use crate::load::curve::Speed;
use crate::load::messages::RIGID;
use crate::model::{Motion, Part};
use crate::rigid::{Body, Member};
use crate::rotation::{Rotate, unit_matrix};
use crate::tensor::Dim;
use crate::vector::{dot, first as of_model, minus, place, plus};

/// What a part has on its nodes.
pub(super) struct Bulk<const D: usize> {
    /// Centre of mass, m.
    pub centre: [f64; D],
    /// Mass, kg/m.
    pub mass: f64,
    /// In 2D the moment of inertia about the centre, kg m.
    pub inertia: f64,
}

impl<const D: usize> Bulk<D>
where
    Dim<D>: Builds<D>,
{
    /// Of nodes with masses (kg/m).
    pub(super) fn of(masses: &[(u32, f64)], positions: &[[f64; D]]) -> Self {
        let mut bulk = Self { centre: [0.0; D], mass: masses.iter().map(|&(_, m)| m).sum(), inertia: 0.0 };
        // Seen from the first node: far from the origin no digits are lost.
        let Some(first) = masses.first().map(|&(node, _)| positions[node as usize]) else { return bulk };
        for &(node, m) in masses {
            let x = positions[node as usize];
            for d in 0..D {
                bulk.centre[d] += m / bulk.mass * (x[d] - first[d]);
            }
        }
        bulk.centre = plus(bulk.centre, first);
        for &(node, m) in masses {
            let arm = bulk.arm(positions[node as usize]);
            bulk.inertia += m * dot(arm, arm);
        }
        bulk
    }

    pub(super) fn arm(&self, x: [f64; D]) -> [f64; D] {
        minus(x, self.centre)
    }

    /// Velocity of a point of a part that flies, spins about this centre (or another) and goes apart, m/s.
    pub(super) fn velocity(&self, part: &Part, x: [f64; D]) -> [f64; D] {
        let arm = part.spin_centre.map_or_else(|| self.arm(x), |centre| minus(x, of_model(centre)));
        let velocity = plus(of_model(part.velocity), <Dim<D>>::spin_velocity(part.spin_vector(), arm));
        part.radial_velocity.map_or(velocity, |radial| plus(velocity, radial.at(x)))
    }
}

impl<const D: usize> Builder<'_, D>
where
    Dim<D>: Builds<D>,
{
    /// Velocity of every node at the start, m/s: of a node of several parts the mean by mass.
    pub(super) fn velocities(&self, part_mass: &[Vec<(u32, f64)>]) -> Vec<[f64; D]> {
        let mut momentum = vec![[0.0; D]; self.mass.len()];
        for (masses, part) in part_mass.iter().zip(&self.model.parts) {
            let bulk = Bulk::of(masses, &self.mesh.positions);
            for &(node, share) in masses {
                let velocity = bulk.velocity(part, self.mesh.positions[node as usize]);
                for d in 0..D {
                    momentum[node as usize][d] += share * velocity[d];
                }
            }
        }
        // Nodes on the faces of shells have no mass; their middles lead them.
        momentum.iter_mut().zip(&self.mass).filter(|(_, m)| **m > 0.0).for_each(|(p, &m)| *p = p.map(|p| p / m));
        momentum
    }

    /// Makes the rigid parts.
    pub(super) fn rigid_parts(&mut self, part_mass: &[Vec<(u32, f64)>]) {
        let model = self.model;
        for (i, part) in model.parts.iter().enumerate() {
            let Some(motion) = &part.rigid else { continue };
            let nodes = &self.mesh.parts[i].nodes;
            let taken = nodes.iter().find_map(|&node| Some((node, self.bodies.of_node(node)?)));
            if let Some((node, other)) = taken {
                let other = self.body_parts.iter().find(|(_, body)| *body == other).map_or("", |&(part, _)| &model.parts[part].name);
                let message = format!("rigid parts \"{other}\" and \"{}\" share the node at {}", part.name, self.place(node));
                self.faults.push(Fault::new(&RIGID, format!("part[{i}].rigid"), message, "make them one part, or mesh them apart"));
                continue;
            }
            // It can't leave the axis: nothing moves it along x.
            let holds = |node: u32| {
                self.constraints.of(node as usize).is_some_and(|held| !(model.is_axisymmetric() && held.holds_only(unit_matrix()[0])))
            };
            if let Some(&node) = nodes.iter().find(|&&node| holds(node)) {
                let message =
                    format!("part \"{}\" is rigid, but a symmetry line or a constraint holds its node at {}", part.name, self.place(node));
                let help = "let `rigid` of the part say how it moves, and take it out of the symmetry (`parts`) or the constraint";
                self.faults.push(Fault::new(&RIGID, format!("part[{i}].rigid"), message, help));
                continue;
            }
            if let Some(&node) = nodes.iter().find(|&&node| self.joins.of_node(node).is_some()) {
                let message = format!("part \"{}\" is rigid, but a join binds its node at {}", part.name, self.place(node));
                let help = "leave it out of the join; a tied contact binds others to rigid parts";
                self.faults.push(Fault::new(&RIGID, format!("part[{i}].rigid"), message, help));
                continue;
            }
            let body = <Dim<D>>::rigid_part(self, i, motion, &part_mass[i]);
            let number = self.bodies.add_with_nodes(body, self.mesh.positions.len());
            self.body_parts.push((i, number));
        }
    }

    fn place(&self, node: u32) -> String {
        format!("{} m", place(self.mesh.positions[node as usize]))
    }
}

impl Builder<'_, 2> {
    pub(crate) fn rigid_part(&self, index: usize, motion: &Motion, own: &[(u32, f64)]) -> Body<2> {
        let (mesh, part, positions) = (&self.mesh.parts[index], &self.model.parts[index], &self.mesh.positions);
        let nodes: Vec<u32> = own.iter().map(|&(node, _)| node).collect();
        let faces = self.mesh.faces_of(&nodes);
        // The whole mass of the nodes: that of other parts at common nodes belongs to the body.
        let whole: Vec<(u32, f64)> = own.iter().map(|&(node, _)| (node, self.mass[node as usize])).collect();
        let bulk = Bulk::of(&whole, positions);
        let drives = self.drives(motion);
        let masses = [bulk.mass, bulk.mass, bulk.inertia];
        let velocity = Bulk::of(own, positions).velocity(part, bulk.centre);
        Body {
            centre: bulk.centre,
            velocity: [velocity[0], velocity[1], part.spin],
            mass: std::array::from_fn(|k| if drives[k].is_none() { masses[k] } else { 0.0 }),
            drives,
            of_elements: true,
            members: mesh.nodes.iter().copied().chain(faces).map(|node| Member { node, arm: bulk.arm(positions[node as usize]) }).collect(),
            shared: own.iter().filter(|&&(node, share)| self.mass[node as usize] != share).map(|&(node, _)| node).collect(),
            ..Body::default()
        }
    }

    /// What prescribes the velocities of a body. A axisymmetric body moves along its axis only.
    pub(super) fn drives(&self, motion: &Motion) -> [Option<Speed>; 3] {
        let [x, y, _] = &motion.velocity;
        let [x, y, spin] = [x, y, &motion.spin].map(|drive| drive.as_ref().and_then(|drive| self.curves.speed(drive)));
        if !self.model.is_axisymmetric() {
            return [x, y, spin];
        }
        let still = || Some(Speed::constant(0.0));
        [still(), y, still()]
    }
}
