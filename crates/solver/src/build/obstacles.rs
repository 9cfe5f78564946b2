//! Obstacles: their rigid bodies, their shapes, and the nodes that meet them.

use super::{Builder, Outlined, stiffness_of, terms_of};
use crate::contact::formulation::Side;
use crate::contact::node_segment::Slave;
use crate::contact::obstacle::plane::Plane;
use crate::contact::obstacle::{NodeObstacle, OutlineShape, Shape};
use crate::contact::projection::node_segment::Target;
use crate::contact::tracker::SKIN;
use crate::contact::{Contact, ContactKind, Formulation, law};
use crate::error::Fault;
use crate::load::constraint::unit;
use crate::mesh::surface::Surface;
use crate::model::{Load, Obstacle, ObstacleShape};
use crate::rigid::{Body, Weight};

/// The outside of the bodies that an obstacle stops.
struct Met {
    surface: Surface,
    /// Tributary length (m) and pressure stiffness (Pa/m) of each of its nodes.
    own: Vec<(f64, f64)>,
    /// Fraction of the mean tributary length, and the reach of the law, m: how far away nodes get springs.
    reach: f64,
}

impl Builder<'_> {
    pub(super) fn obstacles(&mut self) -> Vec<Contact> {
        let mut contacts = Vec::new();
        for (i, obstacle) in self.model.obstacles.iter().enumerate() {
            let surface = match self.mesh.outside(&obstacle.parts) {
                Ok(surface) => surface,
                Err(fault) => {
                    self.faults.push(Fault { path: format!("obstacle[{i}].parts"), ..fault });
                    continue;
                }
            };
            let outline = Outlined { target: Target { surface, mirrors: Vec::new() }, lids: Vec::new() };
            let Side { target: Target { surface, .. }, nodes: own, .. } = self.side(outline, &obstacle.interface);
            let terms = terms_of(&obstacle.interface);
            let spacing = own.iter().map(|&(length, _)| length).sum::<f64>() / own.len().max(1) as f64;
            let met = Met { surface, own, reach: SKIN * spacing + terms.law.reach() };
            let Some((body, formulation)) = self.obstacle(obstacle, &met) else { continue };
            self.terms.push(terms);
            let kind = ContactKind::Obstacle(body);
            contacts.push(Contact::new(obstacle.name.clone(), kind, formulation, obstacle.interface.active));
        }
        contacts
    }

    /// The body of an obstacle, and what makes springs at it.
    fn obstacle(&mut self, obstacle: &Obstacle, met: &Met) -> Option<(usize, Box<dyn Formulation>)> {
        match &obstacle.shape {
            ObstacleShape::Plane { point, normal, length } => {
                let normal = unit(*normal)?;
                let reference = obstacle.reference.unwrap_or(*point);
                let half = length.map_or(f64::INFINITY, |length| 0.5 * length);
                let middle = [point[0] - reference[0], point[1] - reference[1]];
                let shape = Plane { middle, normal, half, thickness: obstacle.interface.thickness, shallow: met.reach };
                // Beyond every picture of the model.
                let far = half.min(20.0 * self.mesh.positions.iter().flatten().fold(0.0f64, |size, x| size.max(x.abs())));
                let points = [1.0, -1.0].map(|side| [middle[0] - side * far * normal[1], middle[1] + side * far * normal[0]]);
                let body = self.bodies.add(self.obstacle_body(obstacle, reference));
                self.outlines.push(OutlineShape { name: obstacle.name.clone(), body, points: points.into() });
                // Nodes that a symmetry line keeps on this plane need no spring.
                let held = |node: u32| self.constraints.mirror_normals(node).any(|m| (m[0] * normal[1] - m[1] * normal[0]).abs() < 1e-12);
                Some((body, Box::new(self.node_obstacle(obstacle, met, Box::new(shape), body, held))))
            }
            _ => None,
        }
    }

    fn node_obstacle(
        &self,
        obstacle: &Obstacle,
        met: &Met,
        shape: Box<dyn Shape>,
        body: usize,
        left_out: impl Fn(u32) -> bool,
    ) -> NodeObstacle {
        let slave = |(&node, &(length, own)): (&u32, &(f64, f64))| {
            let here = law::Node { tributary: length, own, other: own, share: self.constraints.share(node) };
            (!left_out(node)).then(|| (node, Slave { stiffness: stiffness_of(&obstacle.interface, here, 1), area: length, slip: 0.0 }))
        };
        let nodes = met.surface.nodes.iter().zip(&met.own).filter_map(slave).collect();
        NodeObstacle::new(shape, body, nodes, met.reach)
    }

    /// The rigid body of an obstacle with its reference point, m.
    fn obstacle_body(&self, obstacle: &Obstacle, reference: [f64; 2]) -> Body {
        let drives = self.drives(&obstacle.motion);
        let [mass, inertia] = [obstacle.mass, obstacle.inertia].map(|mass| mass.unwrap_or(0.0));
        let mass: [f64; 3] = std::array::from_fn(|k| if drives[k].is_none() { [mass, mass, inertia][k] } else { 0.0 });
        // Gravity on all parts acts on what is free of obstacles too.
        let mut force = [0.0; 2];
        for load in &self.model.loads {
            if let Load::Gravity { parts, acceleration } = load
                && parts.is_empty()
            {
                for d in 0..2 {
                    force[d] += mass[d] * acceleration[d];
                }
            }
        }
        let [vx, vy] = obstacle.velocity;
        Body {
            centre: reference,
            velocity: [vx, vy, obstacle.spin],
            mass,
            drives,
            weight: Weight { force, moments: [0.0; 2] },
            ..Body::default()
        }
    }
}
