//! Nodes against a rigid obstacle in 3D: a half-space, a ball or a cylinder, whole or hollow, fixed or
//! carried by a rigid body. Where a ball or a cylinder may come in between the nodes, points on the facets
//! meet it as well ([`super::points`]).
//!
//! The shape lives in the frame of its rigid body and says how far a point is from its surface; positions
//! come from the step, reactions go to the body. The distance is continuous and its gradient the normal, so
//! springs give back what they took; what goes through a whole ball or cylinder within one step is not held
//! but reported.

use super::super::findings::Findings;
use super::super::initial::{kept, moved_by};
use super::super::law::penalty::stiffening;
use super::super::projection::node_facet::place_on_triangle;
use super::super::slaves::Slave;
use super::super::springs::friction::cone;
use super::super::springs::{Answers, End, Slip, Spring, Springs, Stiffening};
use super::super::{Formulation, Origins, Scene};
use super::Manner;
use super::behind::{Behind, Thick, divisions, may_be_between};
use super::far::{Far, LOOK_AHEAD};
use super::points::{Point, points};
use crate::archive::{Archive, ArchiveResult, persist_all, persist_each};
use crate::contact::springs::TangentSpace;
use crate::mesh::surface::Corners;
use crate::tensor::{Dim, cross, dot};
use crate::vector::{any_tangent, length, minus, plus, times};
use std::any::Any;
use std::ops::Range;

mod carried;

/// A vector in 3D.
pub type Vector = [f64; 3];

/// Shape of an obstacle in the frame of its body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Solid {
    /// Everything behind a plane.
    HalfSpace {
        /// A point in 2D, m.
        point: Vector,
        /// Unit normal that points out.
        normal: Vector,
    },
    /// What is within the radius of a point; hollow: what is beyond it.
    Ball {
        /// Middle, m.
        centre: Vector,
        /// Radius, m.
        radius: f64,
        /// Whether nodes are inside of it.
        is_hollow: bool,
    },
    /// What is within the radius of an axis, without ends; hollow: what is beyond it.
    Cylinder {
        /// A point of the axis, m.
        point: Vector,
        /// Unit vector along it.
        axis: Vector,
        /// Radius, m.
        radius: f64,
        /// Whether nodes are inside of it.
        is_hollow: bool,
    },
}

impl Solid {
    /// Distance of a point from the surface (m, negative inside) and the direction in which it grows. Of the
    /// very middle of a ball or an axis any.
    #[must_use]
    pub fn distance(&self, x: Vector) -> (f64, Vector) {
        let from = |point: Vector| [0, 1, 2].map(|d| x[d] - point[d]);
        let round = |arm: Vector, radius: f64, is_hollow: bool, any: Vector| {
            let size = dot(arm, arm).sqrt();
            let out = if size > 0.0 { arm.map(|c| c / size) } else { any };
            if is_hollow { (radius - size, out.map(|c| -c)) } else { (size - radius, out) }
        };
        match *self {
            Self::HalfSpace { point, normal } => (dot(from(point), normal), normal),
            Self::Ball { centre, radius, is_hollow } => round(from(centre), radius, is_hollow, [0.0, 0.0, 1.0]),
            Self::Cylinder { point, axis, radius, is_hollow } => {
                let arm = from(point);
                let along = dot(arm, axis);
                round([0, 1, 2].map(|d| arm[d] - along * axis[d]), radius, is_hollow, any_tangent(axis))
            }
        }
    }

    /// Depth of the place of a triangle that is deepest in a whole ball or cylinder, m (negative outside),
    /// and that place. In the others corners are deepest.
    #[must_use]
    pub fn deepest(&self, triangle: [Vector; 3]) -> Option<(f64, Vector)> {
        let place = match *self {
            Self::Ball { centre, is_hollow: false, .. } => place_on_triangle(centre, triangle),
            Self::Cylinder { point, axis, is_hollow: false, .. } => nearest_to_line(triangle, point, axis),
            _ => return None,
        };
        Some((-self.distance(place).0, place))
    }

    /// How deep a way that is outside at its end is in a whole ball or cylinder, m, and where, if it goes
    /// through it.
    fn passed(&self, from: Vector, to: Vector) -> Option<(f64, Vector)> {
        let radius = self.radius()?;
        let moved = minus(to, from);
        if dot(moved, moved) < radius * radius || self.distance(from).0 < 0.0 {
            return None;
        }
        self.deepest([from, to, to]).filter(|(depth, _)| *depth > 0.0)
    }

    /// How many times an area (m²) is larger than what of it meets a whole ball or cylinder; at least one.
    fn gain(&self, area: f64) -> f64 {
        let met = match *self {
            Self::Ball { radius, is_hollow: false, .. } => radius * radius,
            Self::Cylinder { radius, is_hollow: false, .. } => radius * area.sqrt(),
            _ => area,
        };
        if met > 0.0 { (area / met).max(1.0) } else { 1.0 }
    }

    /// Radius of a whole ball or cylinder, m.
    fn radius(&self) -> Option<f64> {
        match *self {
            Self::Ball { radius, is_hollow: false, .. } | Self::Cylinder { radius, is_hollow: false, .. } => Some(radius),
            _ => None,
        }
    }
}

/// The place of a triangle that is nearest to the line through `point` along the unit vector `axis`.
fn nearest_to_line(triangle: [Vector; 3], point: Vector, axis: Vector) -> Vector {
    // As seen along the line, which is the origin then.
    let seen = triangle.map(|x| {
        let arm = minus(x, point);
        minus(arm, times(dot(arm, axis), axis))
    });
    let turn = |a: Vector, b: Vector| dot(axis, cross(a, b));
    let areas = [turn(seen[1], seen[2]), turn(seen[2], seen[0]), turn(seen[0], seen[1])];
    if areas.iter().all(|area| *area > 0.0) || areas.iter().all(|area| *area < 0.0) {
        let sum: f64 = areas.iter().sum();
        return [0, 1, 2].map(|d| (0..3).map(|k| areas[k] / sum * triangle[k][d]).sum());
    }
    let on_edge = |k: usize| {
        let (a, along) = (seen[k], minus(seen[(k + 1) % 3], seen[k]));
        let square = dot(along, along);
        let share = if square > 0.0 { (-dot(a, along) / square).clamp(0.0, 1.0) } else { 0.0 };
        let away = plus(a, times(share, along));
        (dot(away, away), plus(triangle[k], times(share, minus(triangle[(k + 1) % 3], triangle[k]))))
    };
    let [first, second, third] = [0, 1, 2].map(on_edge);
    [second, third].into_iter().fold(first, |best, next| if next.0 < best.0 { next } else { best }).1
}

/// Most parts of an edge.
const MOST_DIVISIONS: usize = 8;

/// What an obstacle remembers of a node.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct ContactHistory {
    /// Whether its spring pushed in the last update.
    presses: bool,
    /// Gap that counts as zero, m.
    offset: f64,
    /// Elastic slip in the frame of the body, m.
    slip: Vector,
}

persist_all!(ContactHistory { presses, offset, slip });

/// The surface that an obstacle meets.
#[derive(Clone, Copy)]
pub struct Outside<'a> {
    /// Its nodes, ascending, but for those that are held beside the obstacle, and what they stand for.
    pub nodes: &'a [(u32, Slave)],
    /// Its facets.
    pub facets: &'a [[u32; 4]],
    /// Initial places of all nodes, m.
    pub positions: &'a [Vector],
}

/// Nodes, and points of facets, against an obstacle.
pub struct NodeSolid {
    solid: Solid,
    /// Number of its rigid body.
    body: usize,
    /// Nodes, then the points of each facet.
    points: Vec<Point>,
    nodes: usize,
    facets: Vec<Range<usize>>,
    /// Where their springs stiffen, and the thickness of their bodies there at the start, m.
    walls: Vec<(Stiffening, f64)>,
    memories: Vec<ContactHistory>,
    /// Gaps of their springs in the last step, m; not a number: they have none.
    gaps: Vec<f64>,
    /// Whether nodes were moved along surfaces since the last step.
    is_new: bool,
    /// What is within this distance gets a spring, m.
    reach: f64,
    /// Whether gaps that are negative when it begins to act count as zero.
    ignores_start: bool,
    has_begun: bool,
    /// Indices of the points with springs in this step.
    found: Vec<u32>,
    behind: Behind<3>,
    far: Far,
    /// Whether facets may be deep in it between their nodes.
    sees_facets: bool,
}

impl NodeSolid {
    /// For the nodes of a surface of `bodies` in their initial places.
    #[must_use]
    pub fn new(solid: Solid, body: usize, surface: Outside<'_>, manner: Manner, bodies: Box<dyn Thick<3>>) -> Self {
        let (Outside { nodes, facets, positions }, Manner { reach, factor, ignores_start }) = (surface, manner);
        let own = solid.radius().map_or(f64::INFINITY, |radius| 2.0 * radius);
        let least = |nodes: &mut dyn Iterator<Item = u32>| nodes.map(|node| bodies.at(node)).fold(own, f64::min);
        let divisions = |facet: &[u32; 4]| {
            let (corners, Some(radius)) = (facet.corners(), solid.radius()) else { return 0.0 };
            let x = facet.map(|node| positions[node as usize]);
            divisions(&x[..corners.len()], radius, least(&mut corners.iter().copied()))
        };
        let divisions: Vec<f64> = facets.iter().map(divisions).collect();
        let counts: Vec<usize> = divisions.iter().map(|count| (count.ceil() as usize).clamp(1, MOST_DIVISIONS)).collect();
        let (points, facets) = points(nodes, facets, &counts, |area| solid.gain(area));
        let wall = |point: &Point| {
            let thickness = least(&mut point.ends().map(|(node, _)| node));
            (stiffening(thickness, factor), thickness)
        };
        let walls = points.iter().map(wall).collect();
        let sees_facets = !ignores_start && divisions.iter().any(|&count| may_be_between(count));
        let (memories, behind, nodes) = (vec![ContactHistory::default(); points.len()], Behind::new(bodies, own), nodes.len());
        let (has_begun, is_new, found, far) = (false, false, Vec::new(), Far::new(nodes, facets.len()));
        let gaps = vec![f64::NAN; points.len()];
        Self {
            solid,
            body,
            points,
            nodes,
            facets,
            walls,
            memories,
            gaps,
            is_new,
            reach,
            ignores_start,
            has_begun,
            found,
            behind,
            far,
            sees_facets,
        }
    }

    /// Meets a point; what is so far away that nothing at it may press in this step has no spring.
    fn meet(&mut self, index: usize, scene: &Scene<'_, 3>, springs: &mut Springs<3>) {
        let (body, point, memory) = (scene.bodies.state(self.body), self.points[index], &mut self.memories[index]);
        let at = (scene.sweep.new.len() + self.body) as u32;
        let x = point.place(scene.sweep.new);
        let (from, to) = (body.to_local_old(point.place(scene.sweep.old)), body.to_local(x));
        let (distance, normal) = self.solid.distance(to);
        let pressed = std::mem::replace(&mut memory.presses, false);
        let before = std::mem::replace(&mut self.gaps[index], f64::NAN);
        if !distance.is_finite() {
            *memory = ContactHistory::default();
            return;
        }
        let moved = minus(to, from);
        if self.is_new && point.count == 1 {
            memory.offset = moved_by(before, distance - dot(normal, moved));
        }
        // What lies between nodes that touch a round obstacle is a little inside from the start.
        if self.ignores_start || point.count > 1 || memory.offset != 0.0 {
            memory.offset = kept(self.has_begun, memory.offset, distance);
        }
        let gap = distance - memory.offset;
        if gap > 0.0
            && !pressed
            && let Some((depth, place)) = self.solid.passed(from, to)
        {
            self.behind.see_through(point.nodes[0], (depth, body.place(place)), scene);
        }
        // Who comes from within has pressed no spring that could give anything back.
        if gap >= 0.0 && !pressed && dot(normal, moved) > 2.0 * gap {
            return;
        }
        let (way, (stiffening, initial)) = (dot(moved, moved).sqrt(), self.walls[index]);
        if point.count == 1 {
            self.behind.see(point.nodes[0], -gap, initial, way, scene);
        }
        // Well before it touches: a spring that closes unseen would give back what it never took.
        if gap > self.reach + LOOK_AHEAD * way {
            memory.slip = [0.0; 3];
            if index < self.nodes && *memory == ContactHistory::default() {
                self.far.note(index, distance);
            }
            return;
        }
        let Slave { stiffness, area, .. } = point.slave;
        let normal = body.to_global(normal);
        let tangent = any_tangent(normal);
        let slip = cone::carried(body.to_global(memory.slip), Dim::<3>::tangents(normal, &tangent));
        let mut ends = [End { at, share: -1.0, point: x, ..End::default() }; 5];
        point.ends().zip(&mut ends).for_each(|((node, share), end)| *end = End::node(node, share));
        let spring = Spring { normal, gap, stiffness, area, stiffening, side: 1.0, ..Spring::default() };
        springs.push(spring, Slip { slip, tangent }, &ends[..=point.count]);
        self.found.push(index as u32);
        self.gaps[index] = gap;
    }

    /// How much farther than twice its size the corners of a facet are from the obstacle, m, of which this is
    /// a point, if no point of it may press in this step.
    fn distance(&self, point: &Point, scene: &Scene<'_, 3>) -> Option<f64> {
        let body = scene.bodies.state(self.body);
        let (mut distance, mut way, mut size) = (f64::INFINITY, 0.0, 0.0);
        let first = scene.sweep.new[point.nodes[0] as usize];
        for (node, _) in point.ends() {
            let x = scene.sweep.new[node as usize];
            let (from, to) = (body.to_local_old(scene.sweep.old[node as usize]), body.to_local(x));
            (way, size) = (f64::max(way, length(minus(to, from))), f64::max(size, length(minus(x, first))));
            distance = distance.min(self.solid.distance(to).0);
        }
        // No place of it is farther from a corner than the farthest corners are from each other.
        (distance > self.reach + LOOK_AHEAD * way + 2.0 * size).then_some(distance - 2.0 * size)
    }

    /// Meets the points of all facets.
    fn meet_facets(&mut self, scene: &Scene<'_, 3>, springs: &mut Springs<3>) {
        for number in 0..self.facets.len() {
            if !self.far.looks_at_facet(number) {
                continue;
            }
            let range = self.facets[number].clone();
            if let Some(distance) = self.distance(&self.points[range.start], scene) {
                // What is far has slipped and pressed nowhere.
                self.memories[range].fill(ContactHistory::default());
                self.far.note_facet(number, distance);
            } else {
                range.for_each(|index| self.meet(index, scene, springs));
            }
        }
    }
}

impl Formulation<3> for NodeSolid {
    fn detect(&mut self, scene: &Scene<'_, 3>, springs: &mut Springs<3>) {
        self.found.clear();
        self.behind.begin();
        self.far.begin(scene.bodies.state(self.body), scene.sweep.travel, self.reach);
        for index in 0..self.nodes {
            if self.far.looks_at(index) {
                self.meet(index, scene, springs);
            }
        }
        self.meet_facets(scene, springs);
        let body = scene.bodies.state(self.body);
        if self.sees_facets {
            let deepest = |corners: &[Vector]| self.solid.deepest(*corners.first_chunk()?);
            self.behind.see_facets(body, deepest, scene);
        }
        self.behind.end();
        (self.has_begun, self.is_new) = (true, false);
    }

    fn remember(&mut self, solved: Answers<'_, 3>) {
        for (&index, answer) in self.found.iter().zip(solved) {
            let memory = &mut self.memories[index as usize];
            let ([first, second], [a, b]) = (answer.tangents(), answer.slid().slip_new);
            memory.presses = answer.solved.force != 0.0;
            memory.slip = [0, 1, 2].map(|d| a * first[d] + b * second[d]);
        }
    }

    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        #[rustfmt::skip]
        let Self {
            solid: _, body: _, points: _, nodes: _, facets: _, walls: _, reach: _, ignores_start: _, found: _, sees_facets: _,
            // All are looked at again: nothing comes of those that slept.
            far: _,
            memories, gaps, is_new, has_begun, behind,
        } = self;
        persist_each!(archive; &mut memories[..], &mut gaps[..], is_new, has_begun);
        behind.persist(archive)
    }

    fn carry(&mut self, old: &dyn Any, origins: &Origins<'_, 3>) {
        if let Some(old) = old.downcast_ref::<Self>() {
            self.continue_from(old, origins);
        }
    }

    fn inherit(&mut self, old: Box<dyn Any>) {
        let Ok(old) = old.downcast::<Self>() else { return };
        (self.has_begun, self.is_new) = (old.has_begun, old.is_new);
        self.behind.inherit(&old.behind);
        let known = old.known(0);
        for ((point, memory), gap) in self.points.iter().zip(&mut self.memories).zip(&mut self.gaps) {
            (*memory, *gap) = known.get(&point.key()).copied().unwrap_or((ContactHistory::default(), f64::NAN));
        }
    }

    fn overlaps(&self) -> Option<&Findings> {
        Some(self.behind.findings())
    }

    fn thinnest(&self) -> f64 {
        self.behind.least()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::law::penalty::Penalty;
    use crate::contact::obstacle::behind::Unknown;
    use crate::contact::springs::friction::Friction;
    use crate::contact::springs::{NodeResponse, NodeResponses, Tangential, Terms, Update};
    use crate::contact::traces::Traces;
    use crate::contact::{Contact, ContactKind, Sweep};
    use crate::contact_forces::ContactForces;
    use crate::load::curve::{Curves, Speed};
    use crate::rigid::space::Turning;
    use crate::rigid::{Acting, Bodies, Body};
    use embate_lanes::Level;

    struct Nodes<'a>(&'a [f64], &'a [Vector], f64);

    impl NodeResponses<3> for Nodes<'_> {
        fn count(&self) -> usize {
            self.0.len()
        }
        fn leader(&self, node: u32) -> (u32, Option<[[f64; 3]; 3]>) {
            (node, None)
        }
        fn response(&self, node: usize) -> NodeResponse<3> {
            let give = self.2 / self.0[node];
            NodeResponse { velocity_old: self.1[node], velocity: self.1[node], mobility: [give, 0.0, 0.0, give, 0.0, give] }
        }
    }

    struct Told {
        kinetic: [f64; 2],
        momentum: [Vector; 2],
        lost: f64,
        pressed: bool,
    }

    /// Nodes that fly against an obstacle, which is held or free.
    fn fly(
        solid: Solid,
        is_free: bool,
        friction: f64,
        stiffness: f64,
        positions: &[Vector],
        velocity: impl Fn(Vector) -> Vector,
        steps: usize,
    ) -> Told {
        let (dt, mass) = (0.004, vec![1.0; positions.len()]);
        let (mut x, mut v): (Vec<Vector>, Vec<Vector>) = (positions.to_vec(), positions.iter().map(|&x| velocity(x)).collect());
        let turning = Turning { inertia: [3.0, 0.2, 0.0, 2.0, 0.1, 4.0], ..Turning::default() };
        let mut body = Body::<3> { turning, mass: [5.0, 5.0, 5.0, 0.0, 0.0, 0.0], ..Body::default() };
        if !is_free {
            body.drives = std::array::from_fn(|_| Some(Speed::default()));
            body.mass = [0.0; 6];
        } else {
            body.velocity = [0.1, 0.0, -0.1, 0.2, 0.4, -0.3];
        }
        let mut bodies = Bodies::<3>::default();
        bodies.add(body);
        let curves = Curves::default();
        bodies.start(&curves, &[], &mut []);
        let law = Friction { coefficient: friction, dynamic: friction, decay: 0.0, viscosity: 0.0, limit: f64::INFINITY };
        let tangential = if friction > 0.0 { Tangential::Friction(law) } else { Tangential::Free };
        let terms = Terms { law: Box::new(Penalty), tangential, damping: 0.0 };
        let mut springs = Springs::<3>::new(x.len(), 1, vec![terms]);
        let nodes: Vec<_> = (0..x.len() as u32).map(|node| (node, Slave { stiffness, area: 1.0, of_mass: 0.0 })).collect();
        let manner = Manner { reach: 0.01, factor: 0.0, ignores_start: false };
        let formulation = NodeSolid::new(solid, 0, Outside { nodes: &nodes, facets: &[], positions }, manner, Box::new(Unknown));
        let mut contact = Contact::new(
            "obstacle".into(),
            ContactKind::Obstacle(0),
            Box::new(formulation),
            0,
            crate::model::Window::between([0.0, f64::INFINITY]),
        );
        let (mut old, mut lost, mut traces) = (x.clone(), 0.0, Traces::default());
        let sums = |x: &[Vector], v: &[Vector], bodies: &Bodies<3>| {
            let body = bodies.state(0);
            let mut momentum = [[0.0; 3]; 2];
            let (p, spin) = ([0, 1, 2].map(|d| body.mass[d] * body.velocity[d]), body.turning.momentum);
            let mut add = |x: Vector, p: Vector| {
                let moment = cross(x, p);
                (0..3).for_each(|d| (momentum[0][d], momentum[1][d]) = (momentum[0][d] + p[d], momentum[1][d] + moment[d]));
            };
            add(body.centre, p);
            x.iter().zip(v).for_each(|(&x, &v)| add(x, v));
            if is_free {
                (0..3).for_each(|d| momentum[1][d] += spin[d]);
            }
            (bodies.kinetic() + v.iter().map(|&v| 0.5 * dot(v, v)).sum::<f64>(), momentum)
        };
        let begin = sums(&x, &v, &bodies);
        for _ in 0..steps {
            bodies.set_free(&Acting {
                mean_step: dt,
                from: 0.0,
                to: dt,
                curves: &curves,
                positions: &x,
                loads: &[],
                internal: |_| [0.0; 3],
                moment: &|_| None,
            });
            springs.clear();
            contact.detect(&Scene { sweep: Sweep::between(&old, &x), bodies: &bodies, time: 0.0 }, &mut springs);
            springs.solve(&Update {
                time_steps: [dt; 2],
                positions: &x,
                nodes: &Nodes(&mass, &v, dt),
                bodies: &bodies,
                level: Level::best(),
            });
            let mut forces = ContactForces::new(x.len());
            contact.collect(&springs, &mut forces, &mut bodies, &mut traces, dt);
            lost += contact.totals.lost.friction;
            bodies.accelerate([dt; 2], &forces, &x, &mut v.clone());
            old = x.clone();
            for k in 0..x.len() {
                for d in 0..3 {
                    v[k][d] += dt * forces.of(k)[d];
                    x[k][d] += dt * v[k][d];
                }
            }
            bodies.advance(dt, &mut []);
        }
        let end = sums(&x, &v, &bodies);
        Told {
            kinetic: [begin.0, end.0],
            momentum: [0, 1].map(|k| [0, 1, 2].map(|d| end.1[k][d] - begin.1[k][d])),
            lost,
            pressed: contact.has_pressed,
        }
    }

    fn solids() -> [(Solid, Vector, Vector); 5] {
        let (axis, unit) = ([0.6, 0.0, 0.8], [0.0, 0.6, 0.8]);
        [
            (Solid::HalfSpace { point: [0.1, 0.0, 0.0], normal: unit }, [0.2, 0.7, 0.9], [0.3, -1.0, -1.0]),
            (Solid::Ball { centre: [0.1, 0.0, 0.0], radius: 1.0, is_hollow: false }, [0.9, 0.6, 0.7], [-1.0, -0.5, -0.9]),
            (Solid::Ball { centre: [0.0; 3], radius: 2.0, is_hollow: true }, [0.4, 0.6, 0.7], [1.2, 0.2, 0.9]),
            (Solid::Cylinder { point: [0.0; 3], axis, radius: 0.8, is_hollow: false }, [0.1, 1.1, 0.2], [0.1, -1.4, 0.3]),
            (Solid::Cylinder { point: [0.0; 3], axis, radius: 1.3, is_hollow: true }, [0.1, 0.3, 0.2], [0.3, 1.4, -0.6]),
        ]
    }

    #[test]
    fn distances_grow_by_one_along_their_normals() {
        for (solid, x, _) in solids() {
            let (distance, normal) = solid.distance(x);
            assert!((dot(normal, normal) - 1.0).abs() < 1e-14);
            for by in [-0.2, 0.3] {
                let moved = [0, 1, 2].map(|d| x[d] + by * normal[d]);
                assert!((solid.distance(moved).0 - distance - by).abs() < 1e-14, "{solid:?}");
            }
        }
        assert_eq!(solids()[1].0.distance([2.1, 0.0, 0.0]), (1.0, [1.0, 0.0, 0.0]));
        assert_eq!(solids()[2].0.distance([0.0, 0.0, 3.0]), (-1.0, [-0.0, -0.0, -1.0]));
    }

    #[test]
    fn no_place_of_a_triangle_is_deeper_than_the_one_that_is_found() {
        let mut seed = 1_u64;
        let mut number = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        for (solid, _, _) in solids() {
            for _ in 0..40 {
                let triangle: [Vector; 3] = std::array::from_fn(|_| std::array::from_fn(|_| 4.0 * number()));
                let Some((depth, place)) = solid.deepest(triangle) else { continue };
                assert!((solid.distance(place).0 + depth).abs() < 1e-14);
                let mut most = f64::NEG_INFINITY;
                for (i, j) in (0..=120).flat_map(|i| (0..=120 - i).map(move |j| (i, j))) {
                    let (u, v) = (f64::from(i) / 120.0, f64::from(j) / 120.0);
                    let x = [0, 1, 2].map(|d| (1.0 - u - v) * triangle[0][d] + u * triangle[1][d] + v * triangle[2][d]);
                    most = most.max(-solid.distance(x).0);
                }
                assert!(most <= depth + 1e-12 && depth < most + 0.05, "{solid:?} {triangle:?}: {depth} {most}");
            }
        }
        assert!(solids().iter().filter(|(solid, ..)| solid.deepest([[0.0; 3]; 3]).is_some()).count() == 2);
    }

    #[test]
    fn nodes_come_back_from_obstacles_with_their_energy_and_with_less_by_what_friction_takes() {
        for (solid, at, velocity) in solids() {
            let positions = [at, [0, 1, 2].map(|d| at[d] + [0.02, 0.05, 0.01][d])];
            for stiffness in [1e2, 1e4, 1e6] {
                for friction in [0.0, 0.4] {
                    let reported = fly(solid, false, friction, stiffness, &positions, |_| velocity, 400);
                    let [begin, end] = reported.kinetic;
                    assert!(
                        reported.pressed && (end + reported.lost - begin).abs() < 0.01 * begin,
                        "{solid:?} {stiffness} {friction}: {begin} {end} {}",
                        reported.lost
                    );
                    assert!(if friction > 0.0 { reported.lost > 0.0 } else { reported.lost == 0.0 });
                }
            }
        }
    }

    #[test]
    fn a_free_obstacle_takes_the_momentum_and_the_angular_momentum_that_nodes_lose() {
        for (solid, at, velocity) in solids() {
            for friction in [0.0, 0.5] {
                let reported = fly(solid, true, friction, 1e4, &[at], |_| velocity, 300);
                assert!(
                    reported.pressed && reported.momentum.iter().flatten().all(|change| change.abs() < 1e-12),
                    "{solid:?}: {:?}",
                    reported.momentum
                );
                let [begin, end] = reported.kinetic;
                assert!((end + reported.lost - begin).abs() < 0.02 * begin, "{solid:?} {friction}: {begin} {end} {}", reported.lost);
            }
        }
    }

    #[test]
    fn of_what_sleeps_nothing_would_have_come() {
        let mut random = crate::bench::Random::new(3);
        let (mut slept, mut touched) = (0, 0);
        for (solid, ..) in solids() {
            for turns in [false, true] {
                // Triangles, so that round obstacles have points on them as well.
                let mut x: Vec<Vector> = (0..60).map(|_| std::array::from_fn(|_| 8.0 * random.unit() - 4.0)).collect();
                let start = x.clone();
                let facets: Vec<[u32; 4]> = (0..20).map(|k| [3 * k, 3 * k + 1, 3 * k + 2, 3 * k + 2]).collect();
                let nodes: Vec<_> = (0..60).map(|node| (node, Slave { stiffness: 1.0, area: 1.0, of_mass: 0.0 })).collect();
                let manner = Manner { reach: 0.05, factor: 0.0, ignores_start: false };
                let outside = Outside { nodes: &nodes, facets: &facets, positions: &start };
                let mut both = [0, 1].map(|_| NodeSolid::new(solid, 0, outside, manner, Box::new(Unknown)));
                let terms = Terms { law: Box::new(Penalty), tangential: Tangential::Free, damping: 0.0 };
                let mut springs = Springs::<3>::new(60, 1, vec![terms]);
                let mut bodies = Bodies::<3>::default();
                let momentum = [0.0, 0.0, if turns { 3.0 } else { 0.0 }];
                let turning = Turning { inertia: [3.0, 0.2, 0.0, 2.0, 0.1, 4.0], momentum, ..Turning::default() };
                bodies.add(Body::<3> { turning, velocity: [1.0, -0.7, 0.4, 0.0, 0.0, 0.0], ..Body::default() });
                let mut travel = 0.0;
                for _ in 0..300 {
                    let old = x.clone();
                    for at in &mut x {
                        (0..3).for_each(|d| at[d] += 0.05 * (random.unit() - 0.5 - 0.02 * at[d]));
                    }
                    let way = |(old, new): (&Vector, &Vector)| length(minus(*new, *old));
                    travel += old.iter().zip(&x).map(way).fold(0.0, f64::max);
                    bodies.advance(0.01, &mut []);
                    let presses = random.unit() < 0.5;
                    for (formulation, travel) in both.iter_mut().zip([travel, f64::INFINITY]) {
                        springs.clear();
                        let sweep = Sweep { travel, ..Sweep::between(&old, &x) };
                        formulation.detect(&Scene { sweep, bodies: &bodies, time: 0.0 }, &mut springs);
                        for &index in &formulation.found {
                            formulation.memories[index as usize].presses = presses;
                        }
                    }
                    let [one, other] = &both;
                    assert_eq!(one.found, other.found);
                    assert_eq!(one.memories, other.memories);
                    touched += one.found.len();
                    slept += one.far.sleeping();
                }
            }
        }
        assert!(slept > 20_000 && touched > 20_000, "{slept} {touched}");
    }
}
