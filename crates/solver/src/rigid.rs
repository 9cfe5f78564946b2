//! Rigid bodies: obstacles and rigid parts. Each has a centre, an angle and three velocities; contact forces reach it at its nodes, or at points.

use crate::step::Vector;

/// The rigid bodies of a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bodies {
    /// Rigid body of each node; `u32::MAX`: none. Empty without rigid parts.
    of_node: Vec<u32>,
    list: Vec<Body>,
}

/// State of a rigid body.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Body {
    /// Angle since the start, rad.
    pub angle: f64,
    /// Reference point X^n: the centre of mass where it is free to turn, m.
    pub centre: Vector,
    /// v^{n−½}: x, y (m/s) and angular (rad/s).
    pub velocity_old: [f64; 3],
    /// v^{n+½} without contact forces.
    pub velocity_free: [f64; 3],
    /// 1/mass, 1/mass (m/kg) and 1/inertia (1/(kg m)); zero where it is driven.
    pub inverse_mass: [f64; 3],
    /// Contact forces at points (N/m) and their moment about the centre (N).
    pub force: [f64; 3],
}

impl Body {
    /// A point seen from the body: relative to its centre, turned back by its angle.
    #[must_use]
    pub fn to_local(&self, x: Vector) -> Vector {
        let arm = [x[0] - self.centre[0], x[1] - self.centre[1]];
        if self.angle == 0.0 { arm } else { turn(arm, -self.angle) }
    }

    /// A direction of the body, turned with it.
    #[must_use]
    pub fn to_global(&self, direction: Vector) -> Vector {
        if self.angle == 0.0 { direction } else { turn(direction, self.angle) }
    }
}

fn turn(v: Vector, angle: f64) -> Vector {
    let (sin, cos) = angle.sin_cos();
    [cos * v[0] - sin * v[1], sin * v[0] + cos * v[1]]
}

impl Bodies {
    /// Adds a body; returns its number.
    pub fn add(&mut self, body: Body) -> usize {
        self.list.push(body);
        self.list.len() - 1
    }

    /// Number of bodies.
    #[must_use]
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Rigid body that a node belongs to.
    #[inline]
    #[must_use]
    pub fn of_node(&self, node: u32) -> Option<usize> {
        self.of_node.get(node as usize).filter(|&&body| body != u32::MAX).map(|&body| body as usize)
    }

    /// State of a body.
    #[must_use]
    pub fn state(&self, body: usize) -> &Body {
        &self.list[body]
    }

    /// Adds a contact force (N/m) that acts on a body at a point.
    pub fn push_at(&mut self, body: usize, force: Vector, point: Vector) {
        let body = &mut self.list[body];
        let arm = [point[0] - body.centre[0], point[1] - body.centre[1]];
        for (sum, value) in body.force.iter_mut().zip([force[0], force[1], arm[0] * force[1] - arm[1] * force[0]]) {
            *sum += value;
        }
    }
}
