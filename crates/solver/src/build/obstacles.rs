//! Obstacles: their rigid bodies, their shapes, and the nodes that meet them.

use super::{Builder, manner, search_by_name, stiffness_of, terms_of};
use crate::contact::depths::Depths;
use crate::contact::formulation::{ContactSurface, Side};
use crate::contact::messages::OBSTACLE;
use crate::contact::node_segment::NodeSegment;
use crate::contact::obstacle::behind::Thick;
use crate::contact::obstacle::circle::{Circle, RoundSegments};
use crate::contact::obstacle::plane::Plane;
use crate::contact::obstacle::{Both, Manner, NodeObstacle, OutlineShape, Shape};
use crate::contact::outline::{Outlines, Sides};
use crate::contact::projection::node_segment::Target;
use crate::contact::slaves::Slave;
use crate::contact::tracker::{SKIN, Tracker};
use crate::contact::{self, Formulation, Tributary, Vector, initial, law, length};
use crate::error::Fault;
use crate::mesh::surface::tributary::Depth;
use crate::mesh::surface::{NONE, Surface};
use crate::model::messages::NO_DIRECTION;
use crate::model::{Obstacle, ObstacleShape};
use crate::rigid::{Body, Member};
use crate::vector::{first, unit};
use std::f64::consts::TAU;

/// The outside of the bodies that an obstacle stops.
struct Met<'a> {
    outline: ContactSurface<2>,
    /// What each of its nodes stands for.
    own: Vec<Tributary>,
    /// Mean over the nodes.
    mean: Tributary,
    /// Longest segment, m.
    longest: f64,
    /// Reach of the law, m.
    reach: f64,
    /// The bodies that they belong to, ascending, and outlines of all bodies.
    bodies: Vec<u32>,
    outlines: &'a Outlines,
}

impl Met<'_> {
    /// A point of the obstacle as a slave: it has as much as a node of the parts.
    fn point(&self, obstacle: &Obstacle) -> Slave {
        let own = self.mean;
        let here = law::Node { own, other: own.stiffness, share: 1.0 };
        Slave { stiffness: stiffness_of(&obstacle.interface, here, 1), area: own.area, of_mass: 0.0 }
    }

    /// Whether a body is one of those that it meets.
    fn counts(&self, body: u32) -> bool {
        self.bodies.binary_search(&body).is_ok()
    }

    /// Depths in the parts.
    fn depths(&self) -> Depths {
        Depths::new(vec![self.outlines.opposite(&self.outline.target.surface), Vec::new()])
    }
}

/// Points of the outline of a circle: off by less than 4e-5 of the radius, so that a picture of the place
/// where a roll touches shows it round.
const ROUND: usize = 360;

impl Builder<'_, 2> {
    /// The body of an obstacle, and what makes springs at it.
    pub(super) fn obstacle_formulation(
        &mut self,
        obstacle: &Obstacle,
        outlines: &Outlines,
    ) -> Result<(usize, Box<dyn Formulation<2>>), Fault> {
        let met = self.met(obstacle, terms_of(&obstacle.interface).law.reach(), outlines)?;
        self.obstacle(obstacle, met)
    }

    /// The outside of the parts that an obstacle stops.
    pub(super) fn outline_met(&self, obstacle: &Obstacle) -> Result<ContactSurface<2>, Fault> {
        let outline = self.surface(|leave_out| self.mesh.outside_without(&obstacle.parts, leave_out), "the outside of these parts");
        outline.map_err(|fault| Fault { path: ".parts".into(), ..fault })
    }

    fn met<'a>(&self, obstacle: &Obstacle, reach: f64, outlines: &'a Outlines) -> Result<Met<'a>, Fault> {
        let Side { surface: ContactSurface { target, lids }, nodes: own, .. } = self.side(self.outline_met(obstacle)?, &obstacle.interface);
        let count = own.len().max(1) as f64;
        let mean = |of: fn(&Tributary) -> f64| own.iter().map(of).fold(0.0, |sum, it| sum + it) / count;
        let mean = Tributary { area: mean(|it| it.area), length: mean(|it| it.length), stiffness: mean(|it| it.stiffness), of_mass: 0.0 };
        // Of elements that were made again, as they were then.
        let places = self.mesh.references();
        let longest = target.surface.segments.iter().map(|&segment| length(segment, &places)).fold(0.0, f64::max);
        let mut bodies: Vec<u32> = target.surface.nodes.iter().map(|&node| self.body_of_node[node as usize]).collect();
        bodies.sort_unstable();
        bodies.dedup();
        Ok(Met { outline: ContactSurface { target, lids }, own, mean, longest, reach, bodies, outlines })
    }

    /// The body of an obstacle, and what makes springs at it.
    fn obstacle(&mut self, obstacle: &Obstacle, met: Met<'_>) -> Result<(usize, Box<dyn Formulation<2>>), Fault> {
        match &obstacle.shape {
            ObstacleShape::Plane { point, normal, length } => self.plane(obstacle, met, first(*point), first(*normal), *length),
            ObstacleShape::Circle { centre, radius, hollow } => self.circle(obstacle, met, first(*centre), *radius, *hollow),
            ObstacleShape::Polyline { points } => Ok(self.polyline(obstacle, met, points)),
            ObstacleShape::Sphere { .. } | ObstacleShape::Cylinder { .. } | ObstacleShape::Triangles(_) => {
                Err(Fault::new(&OBSTACLE, "", "this obstacle is a 3D one", "take `circle` in 2D"))
            }
        }
    }

    fn plane(
        &mut self,
        obstacle: &Obstacle,
        met: Met<'_>,
        point: [f64; 2],
        normal: [f64; 2],
        length: Option<f64>,
    ) -> Result<(usize, Box<dyn Formulation<2>>), Fault> {
        let reference = obstacle.reference.map_or(point, first);
        let shape = plane(seen(point, reference), normal, length, obstacle.interface.thickness, met.mean.length)?;
        // Beyond every picture of the model.
        let far = shape.half.min(20.0 * initial::size(&self.mesh.positions));
        let points = shape.at([-far, far]).into();
        let arms = shape.ends().into_iter().flatten();
        let ends: Vec<(Vector, Vector)> = arms.map(|arm| (arm, [reference[0] + arm[0], reference[1] + arm[1]])).collect();
        let ends = ends.into_iter().filter(|&(_, x)| !self.is_beyond_mirrors(x, &obstacle.parts)).collect::<Vec<_>>();
        let (body, own) = self.register(obstacle, reference, ends, points);
        let held = |node: u32| self.is_held_along(node, shape.normal);
        let nodes = self.node_obstacle(obstacle, &met, Box::new(shape), body, held);
        if own.is_empty() {
            return Ok((body, Box::new(nodes)));
        }
        let slaves = vec![vec![met.point(obstacle); own.len()]];
        let depths = met.depths();
        let tracker = self.tracker(met.outline, points_only(own), &[(1, 0)], &self.positions);
        let ends = NodeSegment::new(tracker, slaves, &obstacle.interface, met.reach).with_depths(depths, vec![Vec::new()]);
        Ok((body, Box::new(Both::new([Box::new(nodes), Box::new(ends)]))))
    }

    /// Whether a symmetry line keeps a node at its distance from a plane: then it needs no spring.
    pub(super) fn is_held_along(&self, node: u32, normal: Vector) -> bool {
        self.constraints.mirror_normals(node).any(|m| (m[0] * normal[1] - m[1] * normal[0]).abs() < 1e-12)
    }

    fn circle(
        &mut self,
        obstacle: &Obstacle,
        met: Met<'_>,
        centre: [f64; 2],
        radius: f64,
        hollow: bool,
    ) -> Result<(usize, Box<dyn Formulation<2>>), Fault> {
        let reference = obstacle.reference.map_or(centre, first);
        let shape = circle(seen(centre, reference), radius, hollow, obstacle.interface.thickness)?;
        let Circle { middle, radius: pushed, .. } = shape;
        // The solid is on the right: outside of a hollow circle, inside of another.
        let turn = if hollow { TAU } else { -TAU };
        let place = |k: usize| {
            let (sin, cos) = (turn * (k % ROUND) as f64 / ROUND as f64).sin_cos();
            [middle[0] + radius * cos, middle[1] + radius * sin]
        };
        let points = (0..=ROUND).map(place).collect();
        let shape = Box::new(shape);
        // Smaller than the segments it can come in between the nodes. Where elements are made again that may
        // change.
        let acts = pushed < met.longest;
        let slips_through = !hollow && (acts || self.model.is_remeshed());
        let (body, own) = self.register(obstacle, reference, if slips_through { vec![(middle, centre)] } else { Vec::new() }, points);
        let nodes = self.node_obstacle(obstacle, &met, shape, body, |_| false);
        let Some(&node) = own.first() else { return Ok((body, Box::new(nodes))) };
        let (slave, depths) = (met.point(obstacle), met.depths());
        let tracker = self.tracker(met.outline, points_only(vec![node]), &[(1, 0)], &self.positions);
        let manner = Manner { reach: met.reach, ..manner(&obstacle.interface, 0.0) };
        let segments = RoundSegments::new(tracker, slave, pushed, body, manner, depths).acting(acts);
        Ok((body, Box::new(Both::new([Box::new(nodes), Box::new(segments)]))))
    }

    /// Points and lines are nodes and segments that move with the body, and meet the outside of the parts as
    /// surfaces meet: nodes of each against segments of the other.
    fn polyline(&mut self, obstacle: &Obstacle, met: Met<'_>, points: &[[f64; 2]]) -> (usize, Box<dyn Formulation<2>>) {
        let (own, closed) = distinct(points);
        let mean = [0, 1].map(|d| own.iter().map(|x| x[d]).sum::<f64>() / own.len() as f64);
        let reference = obstacle.reference.map_or(mean, first);
        let arm = |x: &[f64; 2]| [x[0] - reference[0], x[1] - reference[1]];
        let places = own.iter().map(|x| (arm(x), *x)).collect();
        let (body, nodes) = self.register(obstacle, reference, places, points.iter().map(arm).collect());
        let surface = chain(nodes, closed);
        let lines: Vec<f64> = surface.segments.iter().map(|&segment| length(segment, &self.positions)).collect();
        // Lines as fine as the segments meet them as another surface would, half in each pass. Of long ones
        // only the corners count besides, each with as much as a node of the parts has.
        let is_fine = lines.iter().sum::<f64>() <= lines.len() as f64 * met.mean.length;
        // Where elements are made again, the parts' may become finer than the lines.
        let passes = if is_fine && !self.model.is_remeshed() { 2 } else { 1 };
        let slave = |own: Tributary, share: f64| {
            let here = law::Node { own, other: own.stiffness, share };
            Slave { stiffness: stiffness_of(&obstacle.interface, here, passes), area: own.area / passes as f64, of_mass: 0.0 }
        };
        let of_parts = met.outline.target.surface.nodes.iter().zip(&met.own).map(|(&node, &own)| slave(own, self.constraints.share(node)));
        let of_corners = contact::tributaries(&surface, &vec![met.mean.stiffness; lines.len()], &self.positions, Depth::of(self.model));
        let least = |own: &Tributary| Tributary { area: own.area.min(met.mean.area), length: own.length.min(met.mean.length), ..*own };
        let of_corners = of_corners.iter().map(|own| slave(least(own), 1.0));
        let slaves = vec![of_parts.collect(), of_corners.collect()];
        let depths = met.depths();
        let sides = Sides::new(met.outlines, |body| met.counts(body), &self.mesh.positions);
        let thickness = met.outline.target.surface.nodes.iter().map(|&node| sides.at(node)).collect();
        let depths = if closed && !initial::is_ignored(&obstacle.interface) {
            depths.judging(met.outlines.against(|body| met.counts(body), (u32::MAX, surface.segments.clone()), &self.positions))
        } else {
            depths
        };
        let own = Target { surface, mirrors: Vec::new() };
        let tracker = self.tracker(met.outline, own, &[(0, 1), (1, 0)], &self.positions).with_ends(&self.positions);
        (body, Box::new(NodeSegment::new(tracker, slaves, &obstacle.interface, met.reach).with_depths(depths, vec![thickness, Vec::new()])))
    }

    /// Follows the outside of the parts and a surface of the obstacle.
    pub(super) fn tracker(&self, parts: ContactSurface<2>, obstacle: Target, passes: &[(usize, usize)], positions: &[Vector]) -> Tracker {
        let search = (search_by_name("").expect("the registry of searches is not empty").make)();
        Tracker::new(vec![parts.target, obstacle], passes, search, positions).with_bodies(&self.body_of_node, &[parts.lids, Vec::new()])
    }

    /// The rigid body of an obstacle and its nodes, at these arms and places, m; `points` of its outline.
    /// Those that are there already, where contacts are made again.
    fn register(
        &mut self,
        obstacle: &Obstacle,
        reference: Vector,
        places: Vec<(Vector, Vector)>,
        points: Vec<Vector>,
    ) -> (usize, Vec<u32>) {
        if let Some(&body) = self.made.get(&obstacle.name) {
            return (body, self.bodies.state(body).members.iter().map(|member| member.node).collect());
        }
        let mut rigid = self.obstacle_body(obstacle, reference);
        rigid.members = places.into_iter().map(|(arm, x)| Member { node: self.add_node(x), arm }).collect();
        let nodes: Vec<u32> = rigid.members.iter().map(|member| member.node).collect();
        let body = if nodes.is_empty() { self.bodies.add(rigid) } else { self.bodies.add_with_nodes(rigid, self.positions.len()) };
        self.outlines.push(OutlineShape {
            name: obstacle.name.clone(),
            body,
            points,
            facets: Vec::new(),
            death: obstacle.interface.active[1],
        });
        (body, nodes)
    }

    /// A node that belongs to no element.
    fn add_node(&mut self, x: [f64; 2]) -> u32 {
        self.positions.push(x);
        self.mass.push(1.0);
        self.positions.len() as u32 - 1
    }

    fn node_obstacle(
        &self,
        obstacle: &Obstacle,
        met: &Met<'_>,
        shape: Box<dyn Shape>,
        body: usize,
        left_out: impl Fn(u32) -> bool,
    ) -> NodeObstacle {
        let slave = |(&node, &own): (&u32, &Tributary)| {
            let here = law::Node { own, other: own.stiffness, share: self.constraints.share(node) };
            let slave = Slave { stiffness: stiffness_of(&obstacle.interface, here, 1), area: own.area, of_mass: 0.0 };
            (!left_out(node)).then_some((node, slave))
        };
        let nodes = met.outline.target.surface.nodes.iter().zip(&met.own).filter_map(slave).collect();
        let sides = Sides::new(met.outlines, |body| met.counts(body), &self.mesh.positions);
        NodeObstacle::new(shape, body, nodes, manner(&obstacle.interface, met.mean.length), Box::new(sides))
    }

    /// The rigid body of an obstacle with its reference point, m.
    fn obstacle_body(&self, obstacle: &Obstacle, reference: [f64; 2]) -> Body<2> {
        let drives = self.drives(&obstacle.motion);
        let [mass, inertia] = [obstacle.mass, obstacle.inertia].map(|mass| mass.unwrap_or(0.0));
        let mass: [f64; 3] = std::array::from_fn(|k| if drives[k].is_none() { [mass, mass, inertia][k] } else { 0.0 });
        let [vx, vy] = first(obstacle.velocity);
        Body { centre: reference, velocity: [vx, vy, obstacle.spin], mass, drives, ..Body::default() }
    }
}

/// A point as seen from another one.
fn seen(point: Vector, from: Vector) -> Vector {
    [point[0] - from[0], point[1] - from[1]]
}

/// A plane around `middle` or, without a length, through it; `spacing` of the nodes that meet it, m.
pub(super) fn plane(middle: Vector, normal: Vector, length: Option<f64>, thickness: f64, spacing: f64) -> Result<Plane, Fault> {
    let normal =
        unit(normal).ok_or_else(|| Fault::new(&NO_DIRECTION, ".plane.normal", "it has no direction", "give a vector such as [1, 0]"))?;
    Ok(Plane { middle, normal, half: length.map_or(f64::INFINITY, |length| 0.5 * length), thickness, shallow: SKIN * spacing })
}

/// A circle around `middle` that nodes meet at its thickness.
pub(super) fn circle(middle: Vector, radius: f64, hollow: bool, thickness: f64) -> Result<Circle, Fault> {
    let pushed = if hollow { radius - thickness } else { radius + thickness };
    if !(pushed > 0.0) {
        let message = format!("the thickness of {thickness} m leaves nothing of the hollow circle with a radius of {radius} m");
        return Err(Fault::new(&OBSTACLE, ".circle.radius", message, "take a smaller thickness or a larger circle"));
    }
    Ok(Circle { middle, radius: pushed, hollow })
}

/// Nodes without segments, which are slaves only.
pub(super) fn points_only(nodes: Vec<u32>) -> Target {
    Target { surface: Surface::<2> { nodes, ..Surface::<2>::default() }, mirrors: Vec::new() }
}

/// The points of a polyline, each once, and whether it is closed: then it ends at its first point.
pub(super) fn distinct(points: &[[f64; 2]]) -> (&[[f64; 2]], bool) {
    let closed = points.len() > 3 && points.first() == points.last();
    (&points[..points.len() - usize::from(closed)], closed)
}

/// Lines from node to node, as a surface.
pub(super) fn chain(nodes: Vec<u32>, closed: bool) -> Surface<2> {
    let count = nodes.len() - usize::from(!closed);
    let segments = (0..count).map(|k| [nodes[k], nodes[(k + 1) % nodes.len()]]).collect();
    let mut previous: Vec<u32> = (0..count as u32).map(|k| k.wrapping_sub(1)).collect();
    let mut next: Vec<u32> = (1..=count as u32).collect();
    let last = count - 1;
    (previous[0], next[last]) = if closed { (last as u32, 0) } else { (NONE, NONE) };
    Surface::<2> { segments, previous, next, nodes }
}
