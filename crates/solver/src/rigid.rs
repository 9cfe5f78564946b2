//! Rigid bodies: obstacles and rigid parts. Each has a reference point, an angle and three velocities, and moves by the same central differences as the nodes.
//!
//! Contact forces reach a body at its nodes, or at points; corner forces of deformable elements at the nodes that they share with it. With F the sum of the forces
//! and T their moment about X^n:
//!
//! V^{n+½} = V^{n−½} + ½ (dt^{n−1} + dt^n) F / M,   ω^{n+½} = ω^{n−½} + ½ (dt^{n−1} + dt^n) T / I,   X^{n+1} = X^n + dt^n V^{n+½},   θ^{n+1} = θ^n + dt^n ω^{n+½}
//!
//! and a node is at x = X + R(θ) r. Where a degree of freedom is driven its velocity is prescribed, it has no mass in the books, and what drives it does
//! the work that the forces do not.

use crate::archive::{Archive, Keep, Kept, keep_each};
use crate::contact::forces::ContactForces;
use crate::energy::Sums;
use crate::load::body_force::BodyForces;
use crate::load::curve::{Curves, Speed};
use crate::load::damping::Damping;
use crate::step::Vector;
use std::f64::consts::FRAC_PI_2;

/// The rigid bodies of a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bodies {
    /// Rigid body of each node; `u32::MAX`: none. Empty where no body has nodes.
    of_node: Vec<u32>,
    list: Vec<Body>,
}

/// State of a rigid body.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Body {
    /// Angle since the start, rad.
    pub angle: f64,
    /// Reference point X^n: the centre of mass where it is free to move and to turn, m.
    pub centre: Vector,
    /// Angle and reference point at the beginning of the step that led here.
    pub old: (f64, Vector),
    /// v^{n−½}: x, y (m/s) and angular (rad/s).
    pub velocity_old: [f64; 3],
    /// v^{n+½} without contact forces.
    pub velocity_free: [f64; 3],
    /// v^{n+½}.
    pub velocity: [f64; 3],
    /// Mass, mass (kg/m) and inertia (kg m); zero where it is driven.
    pub mass: [f64; 3],
    /// Change of velocity per impulse: 1/mass, 1/mass and 1/inertia, less with damping; zero where it is driven.
    pub inverse_mass: [f64; 3],
    /// Contact forces (N/m) and their moment about the reference point (N).
    pub force: [f64; 3],
    /// What prescribes each velocity; `None`: free.
    pub drives: [Option<Speed>; 3],
    /// What it weighs.
    pub weight: Weight,
    /// Forces of loads on its nodes (N/m) and their moment (N).
    pub load: [f64; 3],
    /// Rates of damping of its mass and inertia, 1/s.
    pub damping: [f64; 3],
    /// Whether it is made of elements: then its nodes have its mass.
    pub of_elements: bool,
    /// Nodes that move with it.
    pub members: Vec<Member>,
    /// Those of `members` where elements or springs pull that are not rigid, ascending.
    pub shared: Vec<u32>,
    /// Forces of such elements and their moment.
    pub internal: [f64; 3],
    /// a = ½ rate · ½ (dt^{n−1} + dt^n) of the damping.
    pub slowing: [f64; 3],
}

/// A node of a rigid body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Member {
    /// The node.
    pub node: u32,
    /// Where it is seen from the reference point, in the frame of the body, m.
    pub arm: Vector,
}

/// What acts on the mass of a body: a force, and a moment where parts of one body weigh differently.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Weight {
    /// Force, N/m.
    pub force: Vector,
    /// Σ r × f and Σ r · f of what is not uniform, N: the moment at angle θ is cos θ times the first less sin θ times the second.
    pub moments: [f64; 2],
}

impl Weight {
    fn at(&self, angle: f64) -> [f64; 3] {
        let moment = if self.moments == [0.0; 2] { 0.0 } else { turn(self.moments, angle)[0] };
        [self.force[0], self.force[1], moment]
    }
}

impl Keep for Body {
    fn keep(&mut self, archive: &mut Archive<'_>) -> Kept {
        // Weight and damping follow from loads and time, in the step.
        #[rustfmt::skip]
        let Self {
            mass: _, drives: _, weight: _, damping: _, of_elements: _, members: _, shared: _,
            angle, centre, old, velocity_old, velocity_free, velocity, inverse_mass, force, load, internal, slowing,
        } = self;
        keep_each!(archive; angle, centre, old, velocity_old, velocity_free, velocity, inverse_mass, force, load, internal, slowing);
        Ok(())
    }
}

impl Keep for Bodies {
    fn keep(&mut self, archive: &mut Archive<'_>) -> Kept {
        let Self { of_node: _, list } = self;
        list[..].keep(archive)
    }
}

impl Body {
    /// A point seen from the body: relative to its reference point, turned back by its angle.
    #[must_use]
    pub fn to_local(&self, x: Vector) -> Vector {
        to_local(x, (self.angle, self.centre))
    }

    /// A point at the beginning of the step, seen from where the body was then.
    #[must_use]
    pub fn to_local_old(&self, x: Vector) -> Vector {
        to_local(x, self.old)
    }

    /// A direction of the body, turned with it.
    #[must_use]
    pub fn to_global(&self, direction: Vector) -> Vector {
        if self.angle == 0.0 { direction } else { turn(direction, self.angle) }
    }

    /// Whether nothing ever moves it.
    #[must_use]
    pub fn is_fixed(&self) -> bool {
        self.drives.iter().all(|drive| drive.as_ref().is_some_and(|speed| speed.as_constant() == Some(0.0)))
    }

    /// Whether nothing drives it.
    #[must_use]
    pub fn is_free(&self) -> bool {
        self.drives.iter().all(Option::is_none)
    }

    /// Velocity of the point x^n of the body with one of its velocities, m/s.
    #[must_use]
    pub fn velocity_at(&self, x: Vector, velocity: &[f64; 3]) -> Vector {
        let [u, v, spin] = *velocity;
        [u - spin * (x[1] - self.centre[1]), v + spin * (x[0] - self.centre[0])]
    }

    /// The part of a velocity that has mass in the books: that which is not driven.
    #[must_use]
    pub fn free_part(&self, velocity: &[f64; 3]) -> [f64; 3] {
        std::array::from_fn(|k| if self.drives[k].is_none() { velocity[k] } else { 0.0 })
    }

    /// ½ M V² + ½ I ω², J/m; without what is driven.
    #[must_use]
    pub fn kinetic(&self, first: &[f64; 3], second: &[f64; 3]) -> f64 {
        (0..3).map(|k| 0.5 * self.mass[k] * first[k] * second[k]).sum()
    }

    fn moment(&self, x: Vector, force: Vector) -> f64 {
        (x[0] - self.centre[0]) * force[1] - (x[1] - self.centre[1]) * force[0]
    }

    fn add_force(sums: &mut [f64; 3], force: Vector, moment: f64) {
        *sums = [sums[0] + force[0], sums[1] + force[1], sums[2] + moment];
    }

    /// Velocities without contact forces, and what a contact force will change.
    fn set_free(&mut self, acting: &Acting<'_, impl Fn(usize) -> Vector>) {
        let weight = self.weight.at(self.angle);
        self.internal = [0.0; 3];
        for &node in &self.shared {
            let (x, force) = (acting.positions[node as usize], (acting.internal)(node as usize));
            Self::add_force(&mut self.internal, force, (x[0] - self.centre[0]) * force[1] - (x[1] - self.centre[1]) * force[0]);
        }
        self.load = [0.0; 3];
        if !acting.loads.is_empty() {
            for member in &self.members {
                let (x, force) = (acting.positions[member.node as usize], acting.loads[member.node as usize]);
                let moment = (x[0] - self.centre[0]) * force[1] - (x[1] - self.centre[1]) * force[0];
                Self::add_force(&mut self.load, force, moment);
            }
        }
        self.velocity_old = self.velocity;
        for k in 0..3 {
            let a = 0.5 * self.damping[k] * acting.mean_step;
            self.slowing[k] = a;
            match &self.drives[k] {
                Some(speed) => {
                    self.velocity_free[k] = acting.curves.mean(speed, acting.from, acting.to);
                    self.inverse_mass[k] = 0.0;
                }
                None => {
                    let undamped = self.velocity_old[k] + acting.mean_step * (self.internal[k] + weight[k] + self.load[k]) / self.mass[k];
                    self.velocity_free[k] = (undamped - a * self.velocity_old[k]) / (1.0 + a);
                    self.inverse_mass[k] = 1.0 / (self.mass[k] * (1.0 + a));
                }
            }
        }
        self.force = [0.0; 3];
    }

    /// v^{n+½} with the contact forces, and its part in the books.
    fn accelerate(&mut self, mean_step: f64, contact_forces: &ContactForces, positions: &[Vector], sums: &mut Sums) {
        for member in &self.members {
            let force = contact_forces.of(member.node as usize);
            if force != [0.0; 2] {
                let moment = self.moment(positions[member.node as usize], force);
                Self::add_force(&mut self.force, force, moment);
            }
        }
        let weight = self.weight.at(self.angle);
        for k in 0..3 {
            let old = self.velocity_old[k];
            let new = self.velocity_free[k] + mean_step * self.inverse_mass[k] * self.force[k];
            self.velocity[k] = new;
            let mean = 0.5 * (old + new);
            sums.internal += mean_step * self.internal[k] * mean;
            sums.load += mean_step * self.load[k] * mean;
            sums.external_old += mean_step * self.load[k] * old;
            if self.drives[k].is_some() {
                let impulse = -mean_step * (self.internal[k] + self.force[k] + self.load[k]);
                sums.drive += impulse * mean;
                sums.external_old += impulse * old;
                continue;
            }
            let m = self.mass[k];
            sums.kinetic_half += 0.5 * m * new * new;
            sums.kinetic += 0.5 * m * old * new;
            sums.gravity += mean_step * weight[k] * mean;
            sums.external_old += mean_step * weight[k] * old;
            let impulse = -2.0 * self.slowing[k] * m * mean;
            sums.damping += impulse * mean;
            sums.damping_old += impulse * old;
        }
    }

    /// Velocities of the nodes that lead them over the coming step (s) to where the body will have them: chords of their arcs.
    fn lead(&self, time_step: f64, positions: &[Vector], velocities: &mut [Vector]) {
        let [u, v, spin] = self.velocity;
        let [[_, sin], [_, half]] = [time_step * spin, 0.5 * time_step * spin].map(cos_sin);
        let (along, across) = (-2.0 * half * half / time_step, sin / time_step);
        for member in &self.members {
            let x = positions[member.node as usize];
            let arm = [x[0] - self.centre[0], x[1] - self.centre[1]];
            velocities[member.node as usize] = [u + along * arm[0] - across * arm[1], v + along * arm[1] + across * arm[0]];
        }
    }
}

fn to_local(x: Vector, (angle, centre): (f64, Vector)) -> Vector {
    let arm = [x[0] - centre[0], x[1] - centre[1]];
    if angle == 0.0 { arm } else { turn(arm, -angle) }
}

fn turn(v: Vector, angle: f64) -> Vector {
    let [cos, sin] = cos_sin(angle);
    [cos * v[0] - sin * v[1], sin * v[0] + cos * v[1]]
}

/// Velocity (m/s) that leads the point `arm` (m) from a centre that rests along the chord of an arc, with `spin` (rad/s) over `time_step` (s); without a step that
/// along the tangent.
pub(crate) fn chord(arm: Vector, spin: f64, time_step: f64) -> Vector {
    if time_step == 0.0 {
        return [-spin * arm[1], spin * arm[0]];
    }
    let [[_, sin], [_, half]] = [time_step * spin, 0.5 * time_step * spin].map(cos_sin);
    let (along, across) = (-2.0 * half * half / time_step, sin / time_step);
    [along * arm[0] - across * arm[1], along * arm[1] + across * arm[0]]
}

/// Cosine and sine by Taylor polynomials on ±45 degrees (truncation below 1e-17): the same bits on every platform.
pub(crate) fn cos_sin(angle: f64) -> [f64; 2] {
    let quarters = (angle / FRAC_PI_2).round();
    let r = angle - quarters * FRAC_PI_2;
    let r2 = r * r;
    let (mut cos, mut sin) = (1.0, 1.0);
    // Horner from the inside: each step multiplies by −r²/(k (k + 1)).
    for k in (1..=17).rev().step_by(2) {
        cos = 1.0 - r2 / f64::from(k * (k + 1)) * cos;
    }
    for k in (2..=16).rev().step_by(2) {
        sin = 1.0 - r2 / f64::from(k * (k + 1)) * sin;
    }
    sin *= r;
    match quarters.rem_euclid(4.0) as u8 {
        0 => [cos, sin],
        1 => [-sin, cos],
        2 => [-cos, -sin],
        _ => [sin, -cos],
    }
}

/// What acts on bodies beside contact.
pub struct Acting<'a, F: Fn(usize) -> Vector> {
    /// ½ (dt^{n−1} + dt^n), s.
    pub mean_step: f64,
    /// Times t^n and t^{n+1}, between which what is driven follows its curve, s.
    pub from: f64,
    /// See `from`.
    pub to: f64,
    /// The curves.
    pub curves: &'a Curves,
    /// x^n, m.
    pub positions: &'a [Vector],
    /// Forces of loads on nodes, N/m; empty without.
    pub loads: &'a [Vector],
    /// Sum of the corner forces at a node, N/m.
    pub internal: F,
}

impl Bodies {
    /// Adds a body; returns its number.
    pub fn add(&mut self, body: Body) -> usize {
        self.list.push(body);
        self.list.len() - 1
    }

    /// Adds a body that carries its members along; returns its number. `nodes` is the number of all nodes.
    pub fn add_with_nodes(&mut self, body: Body, nodes: usize) -> usize {
        self.of_node.resize(nodes, u32::MAX);
        let number = self.list.len();
        for member in &body.members {
            self.of_node[member.node as usize] = number as u32;
        }
        self.add(body)
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

    /// Notes that something that is not rigid pulls at these nodes, so that their bodies feel it.
    pub fn share(&mut self, nodes: &[u32]) {
        for &node in nodes {
            if let Some(body) = self.of_node(node) {
                let shared = &mut self.list[body].shared;
                if let Err(at) = shared.binary_search(&node) {
                    shared.insert(at, node);
                }
            }
        }
    }

    /// State of a body.
    #[must_use]
    pub fn state(&self, body: usize) -> &Body {
        &self.list[body]
    }

    /// All bodies.
    pub fn iter(&self) -> impl Iterator<Item = &Body> {
        self.list.iter()
    }

    /// Takes what acts on their mass now; `mass` of the nodes, kg/m.
    pub fn weigh(&mut self, forces: &BodyForces, mass: &[f64]) {
        let accelerations = forces.accelerations();
        for body in &mut self.list {
            if !body.of_elements {
                let g = forces.everywhere(body.centre);
                body.weight = Weight { force: [body.mass[0] * g[0], body.mass[1] * g[1]], moments: [0.0; 2] };
                continue;
            }
            let Some(&first) = body.members.first().and_then(|member| accelerations.get(member.node as usize)) else { continue };
            let mut weight = Weight { force: [0, 1].map(|d| body.mass[d] * first[d]), moments: [0.0; 2] };
            for Member { node, arm: [a, b] } in &body.members {
                let (g, m) = (accelerations[*node as usize], mass[*node as usize]);
                // What is uniform has no moment, to the last bit.
                let [x, y] = [m * (g[0] - first[0]), m * (g[1] - first[1])];
                weight.force = [weight.force[0] + x, weight.force[1] + y];
                weight.moments = [weight.moments[0] + (a * y - b * x), weight.moments[1] + (a * x + b * y)];
            }
            body.weight = weight;
        }
    }

    /// Takes the rates at which their mass is damped now; `mass` of the nodes, kg/m.
    pub fn damp(&mut self, damping: &Damping, mass: &[f64]) {
        for body in &mut self.list {
            if !body.of_elements {
                body.damping = [damping.rate_everywhere(); 3];
                continue;
            }
            let mut sums = [[0.0; 2]; 2];
            for Member { node, arm } in &body.members {
                let (m, rate) = (mass[*node as usize], damping.rate(*node as usize));
                for (sum, m) in sums.iter_mut().zip([m, m * (arm[0] * arm[0] + arm[1] * arm[1])]) {
                    *sum = [sum[0] + m, sum[1] + rate * m];
                }
            }
            let [straight, round] = sums.map(|[whole, damped]| damped / whole);
            body.damping = [straight, straight, round];
        }
    }

    /// Adds a contact force (N/m) that acts on a body at a point.
    pub fn push_at(&mut self, body: usize, force: Vector, point: Vector) {
        let body = &mut self.list[body];
        let moment = body.moment(point, force);
        Body::add_force(&mut body.force, force, moment);
    }

    /// Velocities at time zero: those of the model where the bodies are free, else those that drive them. Their nodes get them too.
    pub fn start(&mut self, curves: &Curves, positions: &[Vector], velocities: &mut [Vector]) {
        for body in &mut self.list {
            for k in 0..3 {
                if let Some(speed) = &body.drives[k] {
                    body.velocity[k] = curves.mean(speed, 0.0, 0.0);
                }
            }
            for member in &body.members {
                velocities[member.node as usize] = body.velocity_at(positions[member.node as usize], &body.velocity);
            }
            body.old = (body.angle, body.centre);
        }
    }

    /// Kinetic energy with v^{n+½}, J/m; without what is driven.
    #[must_use]
    pub fn kinetic(&self) -> f64 {
        self.list.iter().map(|body| body.kinetic(&body.velocity, &body.velocity)).sum()
    }

    /// v^{n+½} without contact forces; forgets the contact forces of the last step.
    pub fn set_free(&mut self, acting: &Acting<'_, impl Fn(usize) -> Vector>) {
        for body in &mut self.list {
            body.set_free(acting);
        }
    }

    /// v^{n+½} with the contact forces, those on their nodes included. The velocities of the nodes over the coming step (s) follow, and the books get the bodies' part.
    pub fn accelerate(
        &mut self,
        [mean_step, time_step]: [f64; 2],
        contact_forces: &ContactForces,
        positions: &[Vector],
        velocities: &mut [Vector],
    ) -> Sums {
        let mut sums = Sums::default();
        for body in &mut self.list {
            body.accelerate(mean_step, contact_forces, positions, &mut sums);
            if !body.is_fixed() {
                body.lead(time_step, positions, velocities);
            }
        }
        sums
    }

    /// X^{n+1} and θ^{n+1} over a step (s), and the nodes where these say.
    pub fn advance(&mut self, time_step: f64, positions: &mut [Vector]) {
        for body in &mut self.list {
            body.old = (body.angle, body.centre);
            if body.is_fixed() {
                continue;
            }
            for d in 0..2 {
                body.centre[d] += time_step * body.velocity[d];
            }
            body.angle += time_step * body.velocity[2];
            let [cos, sin] = cos_sin(body.angle);
            for member in &body.members {
                let [a, b] = member.arm;
                positions[member.node as usize] = [body.centre[0] + (cos * a - sin * b), body.centre[1] + (sin * a + cos * b)];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_own_sine_and_cosine_agree_with_the_platforms_for_slow_and_for_many_turns() {
        let mut worst = 0.0_f64;
        for i in -40_000..=40_000 {
            let angle = f64::from(i) * 1.234_567e-3;
            let [c, s] = cos_sin(angle);
            worst = worst.max((c - angle.cos()).abs()).max((s - angle.sin()).abs());
        }
        assert!(worst < 1e-14, "{worst:e}");
        for angle in [1e-30, 1e-12, -1e-9, 1e-5] {
            assert!((cos_sin(angle)[1] / angle.sin() - 1.0).abs() < 3e-16);
        }
    }
}
