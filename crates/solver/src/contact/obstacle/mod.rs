//! Nodes against a rigid obstacle: a spring for each node that is behind its surface, or soon may be. One shape a file.
//!
//! The shape lives in the frame of its rigid body; positions come from the step. Reactions go to the body.

pub mod plane;

use super::node_segment::Slave;
use super::springs::{End, Spring, Springs};
use super::{Formulation, Scene, Vector};
use crate::output::Outline;
use crate::rigid::Bodies;

/// Shape of an obstacle in the frame of its body.
pub trait Shape: Send {
    /// Distance with sign (m, negative inside) and unit normal that points to the free side; `None` where the obstacle is not.
    fn project(&self, x: Vector) -> Option<(f64, Vector)>;
}

/// Outline of an obstacle in the frame of its body.
#[derive(Clone, Debug, PartialEq)]
pub struct OutlineShape {
    /// Name of the obstacle.
    pub name: String,
    /// Its rigid body.
    pub body: usize,
    /// From point to point, the solid on the right, m.
    pub points: Vec<Vector>,
}

impl OutlineShape {
    /// Where it is now.
    #[must_use]
    pub fn now(&self, bodies: &Bodies) -> Outline<2> {
        let body = bodies.state(self.body);
        let place = |&point: &Vector| {
            let arm = body.to_global(point);
            [body.centre[0] + arm[0], body.centre[1] + arm[1]]
        };
        Outline { name: self.name.clone(), points: self.points.iter().map(place).collect() }
    }
}

/// Nodes against an obstacle.
pub struct NodeObstacle {
    shape: Box<dyn Shape>,
    /// Number of its rigid body.
    body: usize,
    nodes: Vec<(u32, Slave)>,
    /// Nodes within this distance get a spring, m.
    reach: f64,
    thickness: f64,
    /// Indices of the nodes with springs in this step.
    found: Vec<u32>,
}

impl NodeObstacle {
    /// For `nodes`; `reach` is a fraction of the nodes' spacing and the reach of the law, m.
    #[must_use]
    pub fn new(shape: Box<dyn Shape>, body: usize, nodes: Vec<(u32, Slave)>, reach: f64, thickness: f64) -> Self {
        Self { shape, body, nodes, reach, thickness, found: Vec::new() }
    }
}

impl Formulation for NodeObstacle {
    fn detect(&mut self, scene: &Scene<'_>, springs: &mut Springs) {
        self.found.clear();
        let body = scene.bodies.state(self.body);
        let at = (scene.sweep.new.len() + self.body) as u32;
        for (index, &(node, slave)) in self.nodes.iter().enumerate() {
            let (x, x_old) = (scene.sweep.new[node as usize], scene.sweep.old[node as usize]);
            let Some((distance, normal)) = self.shape.project(body.to_local(x)) else { continue };
            let gap = distance - self.thickness;
            // Well before it touches: a spring that closes unseen would give back what it never took.
            let moved = (x[0] - x_old[0]).abs() + (x[1] - x_old[1]).abs();
            if gap <= self.reach + 4.0 * moved {
                let Slave { stiffness, area, slip } = slave;
                let ends = [End::node(node, 1.0), End { at, share: -1.0, point: x, ..End::default() }];
                springs.push(Spring { normal: body.to_global(normal), gap, stiffness, area, side: 1.0, slip, ..Spring::default() }, &ends);
                self.found.push(index as u32);
            }
        }
    }

    fn remember(&mut self, solved: &[Spring]) {
        for (&index, spring) in self.found.iter().zip(solved) {
            self.nodes[index as usize].1.slip = spring.slip_new;
        }
    }
}
