//! Contacts and obstacles in 3D: what differs from 2D.

use super::outline::{self, Outline};
use super::{Builder, manner, stiffness_of};
use crate::contact::formulation::Side;
use crate::contact::initial;
use crate::contact::law::Node;
use crate::contact::obstacle::OutlineShape;
use crate::contact::obstacle::space::{NodeSolid, Outside, Solid, Vector};
use crate::contact::overlap::{Bodies, OverlapCheck, Walls};
use crate::contact::slaves::Slave;
use crate::contact::{Formulation, Tributary};
use crate::error::Fault;
use crate::mesh::surface::SpaceSurface;
use crate::model::messages::{NO_DIRECTION, NOT_IN_SPACE};
use crate::model::{self, Obstacle, ObstacleShape};
use crate::vector::{dot, minus, plus, times, unit};

impl Builder<'_, 3> {
    /// The body of an obstacle, and what makes springs at it. Faults have paths relative to the obstacle.
    pub(super) fn obstacle_in_3d(&mut self, obstacle: &Obstacle) -> Result<(usize, Box<dyn Formulation<3>>), Fault> {
        let outside = self.outside_met(obstacle)?;
        match &obstacle.shape {
            ObstacleShape::Triangles(surface) => self.triangles(obstacle, surface, outside),
            _ => self.node_solid(obstacle, outside),
        }
    }

    /// The outside of the parts that an obstacle meets.
    pub(super) fn outside_met(&self, obstacle: &Obstacle) -> Result<SpaceSurface, Fault> {
        let outside = self.mesh.outside_without(&obstacle.parts, |facet| self.constraints.is_mirror(facet));
        outside.map_err(|fault| Fault { path: "parts".into(), ..fault })
    }

    /// Nodes of the outside (ascending) that an obstacle may press: what a symmetry plane keeps at its
    /// distance from a plane needs no spring.
    pub(super) fn nodes_pressed(&self, obstacle: &Obstacle, outside: &SpaceSurface) -> Vec<u32> {
        let along = if let ObstacleShape::Plane { normal, .. } = obstacle.shape { unit(normal) } else { None };
        let is_held = |node: u32| along.is_some_and(|n| self.constraints.mirror_normals(node).any(|m| dot(m, n).abs() > 1.0 - 1e-12));
        outside.nodes.iter().copied().filter(|&node| !is_held(node)).collect()
    }

    fn node_solid(&mut self, obstacle: &Obstacle, outside: SpaceSurface) -> Result<(usize, Box<dyn Formulation<3>>), Fault> {
        let (reference, solid, (points, facets)) = self.solid(obstacle)?;
        let Side { nodes: own, surface, .. } = self.side(outside.into(), &obstacle.interface);
        let outside = &surface.target;
        let spacing = own.iter().map(|own| own.area.sqrt()).sum::<f64>() / own.len().max(1) as f64;
        let pressed = self.nodes_pressed(obstacle, outside);
        let slave = |(&node, &own): (&u32, &Tributary)| {
            let here = Node { own, other: own.stiffness, share: self.constraints.share(node) };
            let slave = Slave { stiffness: stiffness_of(&obstacle.interface, here, 1), area: own.area, of_mass: 0.0 };
            pressed.binary_search(&node).is_ok().then_some((node, slave))
        };
        let nodes: Vec<_> = outside.nodes.iter().zip(&own).filter_map(slave).collect();
        let body = match self.made.get(&obstacle.name) {
            Some(&body) => body,
            None => {
                let body = self.bodies.add(self.obstacle_body_in_3d(obstacle, reference));
                self.outlines.push(OutlineShape { name: obstacle.name.clone(), body, points, facets, death: obstacle.interface.active[1] });
                body
            }
        };
        let walls = self.of_bodies(&self.bodies_of(outside), |bodies| Walls::new(bodies, &self.mesh.positions), None)?;
        let manner = manner(&obstacle.interface, spacing);
        let surface = Outside { nodes: &nodes, facets: &outside.facets, positions: &self.mesh.positions };
        Ok((body, Box::new(NodeSolid::new(solid, body, surface, manner, Box::new(walls)))))
    }

    /// The shape of an obstacle as its body sees it from a reference point (m), grown by the distance that it
    /// keeps; points and facets of its outline.
    pub(super) fn solid(&self, obstacle: &Obstacle) -> Result<(Vector, Solid, Outline), Fault> {
        let thickness = obstacle.interface.thickness;
        let far = 20.0 * initial::size(&self.mesh.positions);
        let grown = |radius: f64, hollow: bool| if hollow { radius - thickness } else { radius + thickness };
        let no_direction = |key: &'static str| Fault::new(&NO_DIRECTION, key, "it has no direction", "give a vector such as [0, 0, 1]");
        match obstacle.shape {
            ObstacleShape::Plane { length: Some(_), .. } => {
                Err(Fault::new(&NOT_IN_SPACE, "plane.length", "a plane in 3D has no end", "leave `length` out"))
            }
            ObstacleShape::Plane { point, normal, .. } => {
                let normal = unit(normal).ok_or_else(|| no_direction("plane.normal"))?;
                let reference = obstacle.reference.unwrap_or(point);
                let at = minus(point, reference);
                let solid = Solid::HalfSpace { point: plus(at, times(thickness, normal)), normal };
                Ok((reference, solid, outline::square(at, normal, far)))
            }
            ObstacleShape::Sphere { centre, radius, hollow } => {
                let reference = obstacle.reference.unwrap_or(centre);
                let at = minus(centre, reference);
                let ball = Solid::Ball { centre: at, radius: grown(radius, hollow), is_hollow: hollow };
                Ok((reference, ball, outline::sphere(at, radius, hollow)))
            }
            ObstacleShape::Cylinder { point, axis, radius, hollow } => {
                let axis = unit(axis).ok_or_else(|| no_direction("cylinder.axis"))?;
                let reference = obstacle.reference.unwrap_or(point);
                let at = minus(point, reference);
                let cylinder = Solid::Cylinder { point: at, axis, radius: grown(radius, hollow), is_hollow: hollow };
                Ok((reference, cylinder, outline::cylinder(at, axis, radius, hollow, initial::size(&self.mesh.positions))))
            }
            ObstacleShape::Circle { .. } => {
                Err(Fault::new(&NOT_IN_SPACE, "circle", "there are no circles in 3D", "take `sphere` or `cylinder`"))
            }
            // Made of facets.
            ObstacleShape::Polyline { .. } | ObstacleShape::Triangles(_) => Err(Fault::new(
                &NOT_IN_SPACE,
                "polyline",
                "there are no polylines in 3D",
                "take `plane`, `sphere`, `cylinder` or `stl`, or a rigid part",
            )),
        }
    }

    /// What looks at the overlaps of the bodies whose surfaces meet.
    pub(super) fn overlap_check(&self, sides: &[Side<'_, 3>], contact: &model::Contact) -> Result<OverlapCheck, Fault> {
        let sides: Vec<Vec<u32>> = sides.iter().map(|side| self.bodies_of(&side.surface.target)).collect();
        let mut all = sides.concat();
        all.sort_unstable();
        all.dedup();
        // A body on both sides meets itself.
        let are_two = sides.len() == 2 && !sides[0].iter().any(|body| sides[1].binary_search(body).is_ok());
        let side_of = |body: u32| u32::from(sides[sides.len() - 1].binary_search(&body).is_ok());
        let ignores_start = initial::is_ignored(&contact.interface) || contact.tied.is_some();
        let make = |bodies: &Bodies<'_>| OverlapCheck::new(bodies, &self.mesh.positions, ignores_start);
        self.of_bodies(&all, make, if are_two { Some(&side_of) } else { None })
    }

    /// Bodies that a surface belongs to, ascending.
    pub(super) fn bodies_of(&self, surface: &SpaceSurface) -> Vec<u32> {
        let mut all: Vec<u32> = surface.facets.iter().map(|facet| self.body_of_node[facet[0] as usize]).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// What is made of the whole outside of some bodies (ascending), of one or two sides.
    pub(super) fn of_bodies<T>(
        &self,
        all: &[u32],
        make: impl Fn(&Bodies<'_>) -> T,
        side_of: Option<&dyn Fn(u32) -> u32>,
    ) -> Result<T, Fault> {
        let body_of = |node: u32| self.body_of_node[node as usize];
        let is_met = |body: u32| all.binary_search(&body).is_ok();
        let parts = self.mesh.parts.iter().filter(|part| part.nodes.iter().any(|&node| is_met(body_of(node))));
        let parts: Vec<String> = parts.map(|part| part.name.clone()).collect();
        let outside = self.mesh.outside_without(&parts, |facet| !is_met(body_of(facet[0])))?.with_kin(&self.mesh.kin);
        let is_mirror = |facet| self.constraints.is_mirror(facet);
        Ok(make(&Bodies { outside: &outside, is_mirror: &is_mirror, body_of: &body_of, side_of }))
    }
}
