//! Nodes against a rigid obstacle in space: a half-space, a ball or a cylinder, whole or hollow, fixed or carried by a rigid body.
//!
//! The shape lives in the frame of its rigid body and says how far a point is from its surface; positions come from the step, reactions go to the body. The distance is continuous and its
//! gradient the normal, so springs give back what they took; where a node goes through a whole ball or cylinder within one step it is not seen: it must be slower than its thickness.

use super::super::initial::kept;
use super::super::node_facet::Slave;
use super::super::springs::friction::cone;
use super::super::springs::{Answers, End, Spring, Springs};
use super::super::{Formulation, Scene};
use crate::archive::{Archive, Kept, keep_all, keep_each};
use crate::motion::{Motion, any_tangent};
use crate::tensor::{Dim, dot};
use std::any::Any;

/// A vector of space.
pub type Vector = [f64; 3];

/// Shape of an obstacle in the frame of its body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Solid {
    /// Everything behind a plane.
    HalfSpace {
        /// A point of the plane, m.
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
    /// Distance of a point from the surface (m, negative inside) and the direction in which it grows. Of the very middle of a ball or an axis any.
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
}

/// What an obstacle remembers of a node.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Memory {
    /// Whether its spring pushed in the last update.
    presses: bool,
    /// Gap that counts as zero, m.
    offset: f64,
    /// Elastic slip in the frame of the body, m.
    slip: Vector,
}

keep_all!(Memory { presses, offset, slip });

/// Nodes against an obstacle.
pub struct NodeSolid {
    solid: Solid,
    /// Number of its rigid body.
    body: usize,
    nodes: Vec<(u32, Slave)>,
    memories: Vec<Memory>,
    /// Nodes within this distance get a spring, m.
    reach: f64,
    /// Whether gaps that are negative when it begins to act count as zero.
    ignores_start: bool,
    has_begun: bool,
    /// Indices of the nodes with springs in this step.
    found: Vec<u32>,
}

impl NodeSolid {
    /// For `nodes` (ascending); `reach` is a fraction of the nodes' spacing and the reach of the law, m. With `ignores_start` gaps that are negative when it begins to act count as zero
    /// until the surfaces part.
    #[must_use]
    pub fn new(solid: Solid, body: usize, nodes: Vec<(u32, Slave)>, reach: f64, ignores_start: bool) -> Self {
        let memories = vec![Memory::default(); nodes.len()];
        Self { solid, body, nodes, memories, reach, ignores_start, has_begun: false, found: Vec::new() }
    }
}

impl Formulation<3> for NodeSolid {
    fn detect(&mut self, scene: &Scene<'_, 3>, springs: &mut Springs<3>) {
        self.found.clear();
        let body = scene.bodies.state(self.body);
        let at = (scene.sweep.new.len() + self.body) as u32;
        for (index, (&(node, slave), memory)) in self.nodes.iter().zip(&mut self.memories).enumerate() {
            let x = scene.sweep.new[node as usize];
            let (from, to) = (body.to_local_old(scene.sweep.old[node as usize]), body.to_local(x));
            let (distance, normal) = self.solid.distance(to);
            let pressed = std::mem::replace(&mut memory.presses, false);
            if !distance.is_finite() {
                *memory = Memory::default();
                continue;
            }
            if self.ignores_start {
                memory.offset = kept(self.has_begun, memory.offset, distance);
            }
            let gap = distance - memory.offset;
            let moved = [0, 1, 2].map(|d| to[d] - from[d]);
            // Who comes from within has pressed no spring that could give anything back.
            if gap >= 0.0 && !pressed && dot(normal, moved) > 2.0 * gap {
                continue;
            }
            // Well before it touches: a spring that closes unseen would give back what it never took.
            if gap <= self.reach + 4.0 * dot(moved, moved).sqrt() {
                let Slave { stiffness, area, .. } = slave;
                let normal = body.to_global(normal);
                let tangent = any_tangent(normal);
                let slip = cone::carried(body.to_global(memory.slip), Dim::<3>::tangents(normal, &tangent));
                let ends = [End::node(node, 1.0), End { at, share: -1.0, point: x, ..End::default() }];
                springs.push(Spring { normal, gap, stiffness, area, side: 1.0, slip, tangent, ..Spring::default() }, &ends);
                self.found.push(index as u32);
            } else {
                memory.slip = [0.0; 3];
            }
        }
        self.has_begun = true;
    }

    fn remember(&mut self, solved: Answers<'_, 3>) {
        for (&index, answer) in self.found.iter().zip(solved) {
            let memory = &mut self.memories[index as usize];
            let ([first, second], [a, b]) = (answer.spring.tangents(), answer.solved.slip_new);
            memory.presses = answer.solved.force != 0.0;
            memory.slip = [0, 1, 2].map(|d| a * first[d] + b * second[d]);
        }
    }

    fn keep(&mut self, archive: &mut Archive<'_>) -> Kept {
        let Self { solid: _, body: _, nodes: _, reach: _, ignores_start: _, found: _, memories, has_begun } = self;
        keep_each!(archive; &mut memories[..], has_begun);
        Ok(())
    }

    fn inherit(&mut self, old: Box<dyn Any>) {
        let Ok(old) = old.downcast::<Self>() else { return };
        self.has_begun = old.has_begun;
        for ((node, _), memory) in self.nodes.iter().zip(&mut self.memories) {
            if let Ok(at) = old.nodes.binary_search_by_key(node, |&(node, _)| node) {
                *memory = old.memories[at];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::forces::ContactForces;
    use crate::contact::law::penalty::Penalty;
    use crate::contact::springs::friction::Friction;
    use crate::contact::springs::{Mover, Movers, Tangential, Terms, Update};
    use crate::contact::traces::Traces;
    use crate::contact::{Contact, ContactKind, Sweep};
    use crate::load::curve::{Curves, Speed};
    use crate::rigid::space::Turning;
    use crate::rigid::{Acting, Bodies, Body};
    use crate::tensor::cross;

    struct Nodes<'a>(&'a [f64], &'a [Vector], f64);

    impl Movers<3> for Nodes<'_> {
        fn count(&self) -> usize {
            self.0.len()
        }
        fn leader(&self, node: u32) -> (u32, Option<[[f64; 3]; 3]>) {
            (node, None)
        }
        fn mover(&self, node: usize) -> Mover<3> {
            let give = self.2 / self.0[node];
            Mover { velocity_old: self.1[node], velocity: self.1[node], mobility: [give, 0.0, 0.0, give, 0.0, give] }
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
        let nodes = (0..x.len() as u32).map(|node| (node, Slave { stiffness, area: 1.0, of_mass: 0.0 })).collect();
        let formulation = NodeSolid::new(solid, 0, nodes, 0.01, false);
        let mut contact = Contact::new("obstacle".into(), ContactKind::Obstacle(0), Box::new(formulation), 0, [0.0, f64::INFINITY]);
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
            });
            springs.clear();
            contact.detect(&Scene { sweep: Sweep::between(&old, &x), bodies: &bodies, time: 0.0 }, &mut springs);
            springs.solve(&Update { time_steps: [dt; 2], positions: &x, nodes: &Nodes(&mass, &v, dt), bodies: &bodies });
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
    fn nodes_come_back_from_obstacles_with_their_energy_and_with_less_by_what_friction_takes() {
        for (solid, at, velocity) in solids() {
            let positions = [at, [0, 1, 2].map(|d| at[d] + [0.02, 0.05, 0.01][d])];
            for stiffness in [1e2, 1e4, 1e6] {
                for friction in [0.0, 0.4] {
                    let told = fly(solid, false, friction, stiffness, &positions, |_| velocity, 400);
                    let [begin, end] = told.kinetic;
                    assert!(
                        told.pressed && (end + told.lost - begin).abs() < 0.01 * begin,
                        "{solid:?} {stiffness} {friction}: {begin} {end} {}",
                        told.lost
                    );
                    assert!(if friction > 0.0 { told.lost > 0.0 } else { told.lost == 0.0 });
                }
            }
        }
    }

    #[test]
    fn a_free_obstacle_takes_the_momentum_and_the_angular_momentum_that_nodes_lose() {
        for (solid, at, velocity) in solids() {
            for friction in [0.0, 0.5] {
                let told = fly(solid, true, friction, 1e4, &[at], |_| velocity, 300);
                assert!(
                    told.pressed && told.momentum.iter().flatten().all(|change| change.abs() < 1e-12),
                    "{solid:?}: {:?}",
                    told.momentum
                );
                let [begin, end] = told.kinetic;
                assert!((end + told.lost - begin).abs() < 0.02 * begin, "{solid:?} {friction}: {begin} {end} {}", told.lost);
            }
        }
    }
}
