//! Rigid bodies: obstacles and rigid parts. Each has a reference point, an angle and its velocities, and
//! moves by the same central differences as the nodes.
//!
//! Contact forces reach a body at its nodes, or at points; corner forces of deformable elements at the nodes
//! that they share with it. With F the sum of the forces and T their moment about X^n:
//!
//! V^{n+½} = V^{n−½} + ½ (dt^{n−1} + dt^n) F / M, ω^{n+½} = ω^{n−½} + ½ (dt^{n−1} + dt^n) T / I,
//! X^{n+1} = X^n + dt^n V^{n+½}, θ^{n+1} = θ^n + dt^n ω^{n+½}
//!
//! and a node is at x = X + R(θ) r. In 3D a rotation takes the place of the angle and the angular momentum
//! that of the spin ([`space`]). Where a degree of freedom is driven its velocity is prescribed, it has no
//! mass in the ledger, and what drives it does the work that the forces do not.

use crate::angle::cos_sin;
use crate::archive::{Archive, ArchiveResult, Persist, persist_each};
use crate::contact_forces::ContactForces;
use crate::energy::Sums;
use crate::load::body_force::BodyForces;
use crate::load::curve::{Curves, Speed};
use crate::load::damping::Damping;
use crate::mesh::geometry::CellGeometry;
use crate::reductions;
use crate::rotation::Rotate;
use crate::tensor::Dim;
use crate::vector::{dot, minus, plus};

pub mod motion;
pub mod space;

pub use motion::RigidMotion;

/// What prescribes a velocity; `None`: it is free.
pub type Drive = Option<Speed>;

/// The rigid bodies of a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bodies<const D: usize>
where
    Dim<D>: RigidMotion<D>,
{
    /// Rigid body of each node; `u32::MAX`: none. Empty where no body has nodes.
    of_node: Vec<u32>,
    list: Vec<Body<D>>,
}

/// State of a rigid body.
#[derive(Clone, Debug, PartialEq)]
pub struct Body<const D: usize>
where
    Dim<D>: RigidMotion<D>,
{
    /// Angle since the start, rad; in 3D a rotation.
    pub angle: Angle<D>,
    /// Reference point X^n: the centre of mass where it is free to move and to turn, m.
    pub centre: [f64; D],
    /// Angle and reference point at the beginning of the step that led here.
    pub old: (Angle<D>, [f64; D]),
    /// v^{n−½}: x, y, z (m/s) and angular (rad/s).
    pub velocity_old: Row<D>,
    /// v^{n+½} without contact forces.
    pub velocity_free: Row<D>,
    /// v^{n+½}.
    pub velocity: Row<D>,
    /// Mass, mass (kg/m) and inertia (kg m); zero where it is driven. In 3D the mass (kg) three times;
    /// inertia is in `turning`.
    pub mass: Row<D>,
    /// Change of velocity per impulse: 1/mass, 1/mass and 1/inertia, less with damping; zero where it is
    /// driven. In 3D that of spins is in `turning`.
    pub inverse_mass: Row<D>,
    /// Contact forces (N/m) and their moment about the reference point (N).
    pub force: Row<D>,
    /// What prescribes each velocity; `None`: free.
    pub drives: <Dim<D> as RigidMotion<D>>::Drives,
    /// What it weighs.
    pub weight: Weight<D>,
    /// Forces of loads on its nodes (N/m) and their moment (N).
    pub load: Row<D>,
    /// Rates of damping of its mass and inertia, 1/s.
    pub damping: Row<D>,
    /// Whether it is made of elements: then its nodes have its mass.
    pub of_elements: bool,
    /// Nodes that move with it.
    pub members: Vec<Member<D>>,
    /// Those of `members` where elements or springs pull that are not rigid, ascending.
    pub shared: Vec<u32>,
    /// Forces of such elements and their moment.
    pub internal: Row<D>,
    /// a = ½ rate · ½ (dt^{n−1} + dt^n) of the damping.
    pub slowing: Row<D>,
    /// What it knows of its rotation in 3D.
    pub turning: <Dim<D> as RigidMotion<D>>::Turning,
}

/// A value for each velocity.
type Row<const D: usize> = <Dim<D> as RigidMotion<D>>::Generalized<f64>;
/// Where a body is turned to.
type Angle<const D: usize> = <Dim<D> as RigidMotion<D>>::Angle;

/// A node of a rigid body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Member<const D: usize> {
    /// The node.
    pub node: u32,
    /// Where it is seen from the reference point, in the frame of the body, m.
    pub arm: [f64; D],
}

/// What acts on the mass of a body: a force, and a moment where parts of one body weigh differently.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weight<const D: usize>
where
    Dim<D>: RigidMotion<D>,
{
    /// Force, N/m.
    pub force: [f64; D],
    /// Σ r × f and Σ r · f of what is not uniform, N: the moment at angle θ is cos θ times the first less sin
    /// θ times the second. In 3D Σ r fᵀ.
    pub moments: <Dim<D> as RigidMotion<D>>::Moments,
}

impl<const D: usize> Default for Weight<D>
where
    Dim<D>: RigidMotion<D>,
{
    fn default() -> Self {
        Self { force: [0.0; D], moments: Default::default() }
    }
}

impl<const D: usize> Weight<D>
where
    Dim<D>: RigidMotion<D>,
{
    fn at(&self, angle: &Angle<D>) -> Row<D> {
        Dim::<D>::generalized_with(self.force, Dim::<D>::weight_moment(&self.moments, angle))
    }
}

impl<const D: usize> Default for Body<D>
where
    Dim<D>: RigidMotion<D>,
{
    fn default() -> Self {
        let ((angle, turning), (drives, weight)) = Default::default();
        let none = Row::<D>::default();
        #[rustfmt::skip]
        let body = Self {
            angle, drives, weight, turning, centre: [0.0; D], old: (angle, [0.0; D]), velocity_old: none, velocity_free: none, velocity: none, mass: none, inverse_mass: none,
            force: none, load: none, damping: none, of_elements: false, members: Vec::new(), shared: Vec::new(), internal: none, slowing: none,
        };
        body
    }
}

impl<const D: usize> Persist for Body<D>
where
    Dim<D>: RigidMotion<D>,
{
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        // Weight and damping follow from loads and time, in the step.
        #[rustfmt::skip]
        let Self {
            mass: _, drives: _, weight: _, damping: _, of_elements: _, members: _, shared: _,
            angle, centre, old, velocity_old, velocity_free, velocity, inverse_mass, force, load, internal, slowing, turning,
        } = self;
        persist_each!(archive; angle, centre, old, velocity_old, velocity_free, velocity, inverse_mass, force, load, internal, slowing, turning);
        Ok(())
    }
}

impl<const D: usize> Persist for Bodies<D>
where
    Dim<D>: RigidMotion<D>,
{
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { of_node: _, list } = self;
        list[..].persist(archive)
    }
}

impl<const D: usize> Body<D>
where
    Dim<D>: RigidMotion<D>,
{
    /// A point seen from the body: relative to its reference point, turned back by its angle.
    #[must_use]
    pub fn to_local(&self, x: [f64; D]) -> [f64; D] {
        to_local(x, &(self.angle, self.centre))
    }

    /// A point at the beginning of the step, seen from where the body was then.
    #[must_use]
    pub fn to_local_old(&self, x: [f64; D]) -> [f64; D] {
        to_local(x, &self.old)
    }

    /// How far every point of it went in the step, m; `None` where it has turned.
    #[must_use]
    pub fn shift(&self) -> Option<f64> {
        let moved = minus(self.centre, self.old.1);
        (self.angle == self.old.0).then(|| dot(moved, moved).sqrt())
    }

    /// A direction of the body, turned with it.
    #[must_use]
    pub fn to_global(&self, direction: [f64; D]) -> [f64; D] {
        Dim::<D>::turned(&self.angle, direction)
    }

    /// Where a point of its frame is, m.
    #[must_use]
    pub fn place(&self, point: [f64; D]) -> [f64; D] {
        plus(self.centre, self.to_global(point))
    }

    /// Square of the velocity of its reference point, m²/s².
    #[must_use]
    pub fn speed_squared(&self) -> f64 {
        let velocity: [f64; D] = std::array::from_fn(|d| self.velocity[d]);
        dot(velocity, velocity)
    }

    /// Whether nothing ever moves it.
    #[must_use]
    pub fn is_fixed(&self) -> bool {
        self.drives().iter().all(|drive| drive.as_ref().is_some_and(|speed| speed.as_constant() == Some(0.0)))
    }

    /// Whether nothing drives it.
    #[must_use]
    pub fn is_free(&self) -> bool {
        self.drives().iter().all(Option::is_none)
    }

    pub(crate) fn drives(&self) -> &[Drive] {
        self.drives.as_ref()
    }

    /// Velocity of the point x^n of the body with one of its velocities, m/s.
    #[must_use]
    pub fn velocity_at(&self, x: [f64; D], velocity: &Row<D>) -> [f64; D] {
        Dim::<D>::velocity_at(velocity, self.arm(x))
    }

    /// The part of a velocity that has mass in the ledger: that which is not driven.
    #[must_use]
    pub fn free_part(&self, velocity: &Row<D>) -> Row<D> {
        Dim::<D>::generalized(|k| if self.drives()[k].is_none() { velocity[k] } else { 0.0 })
    }

    /// ½ M V² + ½ I ω², J/m; without what is driven.
    #[must_use]
    pub fn kinetic(&self, first: &Row<D>, second: &Row<D>) -> f64 {
        Dim::<D>::kinetic(self, first, second)
    }

    /// Where a point is seen from the reference point, m.
    fn arm(&self, x: [f64; D]) -> [f64; D] {
        std::array::from_fn(|d| x[d] - self.centre[d])
    }

    /// A force at a point, and its moment about the reference point.
    fn force_at(&self, x: [f64; D], force: [f64; D]) -> Row<D> {
        Dim::<D>::generalized_of(force, Some(self.arm(x)))
    }

    fn add_force(sums: &mut Row<D>, force: &Row<D>) {
        (0..Dim::<D>::FREEDOMS).for_each(|k| sums[k] += force[k]);
    }

    /// Velocities without contact forces, and what a contact force will change.
    fn set_free(&mut self, acting: &Acting<'_, impl Fn(usize) -> [f64; D], D>) {
        let weight = self.weight.at(&self.angle);
        let mut internal = Row::<D>::default();
        for &node in &self.shared {
            Self::add_force(&mut internal, &self.force_at(acting.positions[node as usize], (acting.internal)(node as usize)));
            if let Some(moment) = (acting.moment)(node) {
                Self::add_force(&mut internal, &Dim::<D>::generalized_with([0.0; D], Dim::<D>::moment_of(moment)));
            }
        }
        self.internal = internal;
        let mut load = Row::<D>::default();
        if !acting.loads.is_empty() {
            for member in &self.members {
                Self::add_force(&mut load, &self.force_at(acting.positions[member.node as usize], acting.loads[member.node as usize]));
            }
        }
        self.load = load;
        self.velocity_old = self.velocity;
        for k in 0..Dim::<D>::FREEDOMS {
            self.slowing[k] = 0.5 * self.damping[k] * acting.mean_step;
            if let Some(speed) = &self.drives.as_ref()[k] {
                self.velocity_free[k] = acting.curves.mean(speed, acting.from, acting.to);
                self.inverse_mass[k] = 0.0;
            }
        }
        (0..D).for_each(|k| self.free_along(k, &weight, acting.mean_step));
        Dim::<D>::free_spins(self, &weight, acting.mean_step);
        self.force = Row::<D>::default();
    }

    /// One of the velocities without contact forces, where its mass is a number.
    pub(crate) fn free_along(&mut self, k: usize, weight: &Row<D>, mean_step: f64) {
        if self.drives()[k].is_none() {
            let a = self.slowing[k];
            let undamped = self.velocity_old[k] + mean_step * (self.internal[k] + weight[k] + self.load[k]) / self.mass[k];
            self.velocity_free[k] = (undamped - a * self.velocity_old[k]) / (1.0 + a);
            self.inverse_mass[k] = 1.0 / (self.mass[k] * (1.0 + a));
        }
    }

    /// v^{n+½} with the contact forces, and its part in the ledger.
    fn accelerate(&mut self, mean_step: f64, contact_forces: &ContactForces<D>, positions: &[[f64; D]], sums: &mut Sums) {
        let mut pushed = self.force;
        for member in &self.members {
            let force = contact_forces.of(member.node as usize);
            if force != [0.0; D] {
                Self::add_force(&mut pushed, &self.force_at(positions[member.node as usize], force));
            }
        }
        self.force = pushed;
        let weight = self.weight.at(&self.angle);
        for k in 0..D {
            self.velocity[k] = self.velocity_free[k] + mean_step * self.inverse_mass[k] * self.force[k];
            let momenta = [self.velocity_old[k], self.velocity[k]].map(|velocity| self.mass[k] * velocity);
            self.book(k, momenta, &weight, mean_step, sums);
        }
        Dim::<D>::accelerate_spins(self, &weight, mean_step, sums);
    }

    /// The part of one velocity in the ledger; `momenta`: before and after.
    pub(crate) fn book(&self, k: usize, momenta: [f64; 2], weight: &Row<D>, mean_step: f64, sums: &mut Sums) {
        let (old, new) = (self.velocity_old[k], self.velocity[k]);
        let mean = 0.5 * (old + new);
        sums.internal += mean_step * self.internal[k] * mean;
        sums.load += mean_step * self.load[k] * mean;
        sums.external_old += mean_step * self.load[k] * old;
        if self.drives()[k].is_some() {
            let impulse = -mean_step * (self.internal[k] + self.force[k] + self.load[k]);
            sums.drive += impulse * mean;
            sums.external_old += impulse * old;
            return;
        }
        Dim::<D>::book_mass(self, k, momenta, sums);
        sums.gravity += mean_step * weight[k] * mean;
        sums.external_old += mean_step * weight[k] * old;
        let impulse = Dim::<D>::slowed(self, k, momenta, mean);
        sums.damping += impulse * mean;
        sums.damping_old += impulse * old;
    }

    /// ½ m v² of one velocity with a mass of its own in the ledger.
    pub(crate) fn book_straight(&self, k: usize, sums: &mut Sums) {
        let (m, old, new) = (self.mass[k], self.velocity_old[k], self.velocity[k]);
        sums.kinetic_half += 0.5 * m * new * new;
        sums.kinetic += 0.5 * m * old * new;
    }

    /// Velocities of the nodes that lead them over the coming step (s) to where the body will have them:
    /// chords of their arcs.
    fn lead(&self, time_step: f64, positions: &[[f64; D]], velocities: &mut [[f64; D]]) {
        let chords = Dim::<D>::chords(self, time_step);
        for member in &self.members {
            velocities[member.node as usize] = Dim::<D>::chord(self, &chords, self.arm(positions[member.node as usize]));
        }
    }
}

fn to_local<const D: usize>(x: [f64; D], (angle, centre): &(Angle<D>, [f64; D])) -> [f64; D]
where
    Dim<D>: RigidMotion<D>,
{
    Dim::<D>::turned_back(angle, std::array::from_fn(|d| x[d] - centre[d]))
}

pub(crate) fn turn(v: [f64; 2], angle: f64) -> [f64; 2] {
    let [cos, sin] = cos_sin(angle);
    [cos * v[0] - sin * v[1], sin * v[0] + cos * v[1]]
}

/// What acts on bodies beside contact.
pub struct Acting<'a, F: Fn(usize) -> [f64; D], const D: usize> {
    /// ½ (dt^{n−1} + dt^n), s.
    pub mean_step: f64,
    /// Times t^n and t^{n+1}, between which what is driven follows its curve, s.
    pub from: f64,
    /// See `from`.
    pub to: f64,
    /// The curves.
    pub curves: &'a Curves,
    /// x^n, m.
    pub positions: &'a [[f64; D]],
    /// Forces of loads on nodes, N/m; empty without.
    pub loads: &'a [[f64; D]],
    /// Sum of the corner forces at a node, N/m.
    pub internal: F,
    /// Sum of the moments of elements at a node, N (N m); `None`: it has no rotation.
    pub moment: &'a dyn Fn(u32) -> Option<[f64; 3]>,
}

impl<const D: usize> Bodies<D>
where
    Dim<D>: RigidMotion<D>,
{
    /// Adds a body; returns its number.
    pub fn add(&mut self, body: Body<D>) -> usize {
        self.list.push(body);
        self.list.len() - 1
    }

    /// Adds a body that carries its members along; returns its number. `nodes` is the number of all nodes.
    pub fn add_with_nodes(&mut self, body: Body<D>, nodes: usize) -> usize {
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
    pub fn state(&self, body: usize) -> &Body<D> {
        &self.list[body]
    }

    /// All bodies.
    pub fn iter(&self) -> impl Iterator<Item = &Body<D>> {
        self.list.iter()
    }

    /// Takes what acts on their mass now: accelerations of all nodes, m/s² (empty: none act on them), that of
    /// what is everywhere at a place, and the `mass` of the nodes, kg/m.
    pub fn weigh_by(&mut self, accelerations: &[[f64; D]], everywhere: impl Fn([f64; D]) -> [f64; D], mass: &[f64]) {
        for body in &mut self.list {
            if !body.of_elements {
                let g = everywhere(body.centre);
                body.weight = Weight { force: std::array::from_fn(|d| body.mass[d] * g[d]), ..Weight::default() };
                continue;
            }
            let Some(&first) = body.members.first().and_then(|member| accelerations.get(member.node as usize)) else { continue };
            let mut weight = Weight { force: std::array::from_fn(|d| body.mass[d] * first[d]), ..Weight::default() };
            for Member { node, arm } in &body.members {
                let (g, m) = (accelerations[*node as usize], mass[*node as usize]);
                // What is uniform has no moment, to the last bit.
                let more = std::array::from_fn(|d| m * (g[d] - first[d]));
                (0..D).for_each(|d| weight.force[d] += more[d]);
                Dim::<D>::add_weight(&mut weight.moments, *arm, more);
            }
            body.weight = weight;
        }
    }

    /// Takes the rates at which their mass is damped now; `mass` of the nodes, kg/m.
    pub fn damp(&mut self, damping: &Damping, mass: &[f64]) {
        for body in &mut self.list {
            if !body.of_elements {
                body.damping = Dim::<D>::generalized(|_| damping.rate_everywhere());
                continue;
            }
            let mut sums = [[0.0; 2]; 2];
            for Member { node, arm } in &body.members {
                let (m, rate) = (mass[*node as usize], damping.rate(*node as usize));
                for (sum, m) in sums.iter_mut().zip([m, m * (1..D).fold(arm[0] * arm[0], |sum, d| sum + arm[d] * arm[d])]) {
                    *sum = [sum[0] + m, sum[1] + rate * m];
                }
            }
            let [straight, round] = sums.map(|[whole, damped]| damped / whole);
            body.damping = Dim::<D>::generalized(|k| if k < D { straight } else { round });
        }
    }

    /// Adds a contact force (N/m) that acts on a body at a point.
    pub fn push_at(&mut self, body: usize, force: [f64; D], point: [f64; D]) {
        let body = &mut self.list[body];
        let force = body.force_at(point, force);
        Body::<D>::add_force(&mut body.force, &force);
    }

    /// Velocities at time zero: those of the model where the bodies are free, else those that drive them.
    /// Their nodes get them too.
    pub fn start(&mut self, curves: &Curves, positions: &[[f64; D]], velocities: &mut [[f64; D]]) {
        for body in &mut self.list {
            for k in 0..Dim::<D>::FREEDOMS {
                if let Some(speed) = &body.drives.as_ref()[k] {
                    body.velocity[k] = curves.mean(speed, 0.0, 0.0);
                }
            }
            Dim::<D>::start_spins(body);
            for member in &body.members {
                velocities[member.node as usize] = body.velocity_at(positions[member.node as usize], &body.velocity);
            }
            body.old = (body.angle, body.centre);
        }
    }

    /// Takes the velocities of what is free away, for [`Bodies::launch`].
    pub(crate) fn hold_back(&mut self) -> Vec<Row<D>> {
        let take = |body: &mut Body<D>| {
            let velocity = std::mem::take(&mut body.velocity);
            body.free_part(&velocity)
        };
        self.list.iter_mut().map(take).collect()
    }

    /// Adds these velocities between two steps; nodes follow with the next update of velocities, over the
    /// coming step (s) as here.
    pub(crate) fn launch(&mut self, rows: &[Row<D>], time_step: f64, positions: &[[f64; D]], velocities: &mut [[f64; D]]) {
        for (body, row) in self.list.iter_mut().zip(rows) {
            Body::<D>::add_force(&mut body.velocity, row);
            Dim::<D>::start_spins(body);
            body.lead(time_step, positions, velocities);
        }
    }

    /// Kinetic energy with v^{n+½}, J/m; without what is driven.
    #[must_use]
    pub fn kinetic(&self) -> f64 {
        reductions::sum(self.list.iter().map(|body| body.kinetic(&body.velocity, &body.velocity)))
    }

    /// v^{n+½} without contact forces; forgets the contact forces of the last step.
    pub fn set_free(&mut self, acting: &Acting<'_, impl Fn(usize) -> [f64; D], D>) {
        for body in &mut self.list {
            body.set_free(acting);
        }
    }

    /// v^{n+½} with the contact forces, those on their nodes included. The velocities of the nodes over the
    /// coming step (s) follow, and the ledger get the bodies' part.
    pub fn accelerate(
        &mut self,
        [mean_step, time_step]: [f64; 2],
        contact_forces: &ContactForces<D>,
        positions: &[[f64; D]],
        velocities: &mut [[f64; D]],
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

    /// Gives a body an inertia that is the same about all axes, kg m (kg m²).
    pub(crate) fn add_inertia(&mut self, body: usize, inertia: f64) {
        Dim::<D>::add_inertia(&mut self.list[body], inertia);
    }

    /// X^{n+1} and θ^{n+1} over a step (s), and the nodes where these say.
    pub fn advance(&mut self, time_step: f64, positions: &mut [[f64; D]]) {
        for body in &mut self.list {
            body.old = (body.angle, body.centre);
            if body.is_fixed() {
                continue;
            }
            let turned = Dim::<D>::turned_by(body, time_step);
            for d in 0..D {
                body.centre[d] += time_step * body.velocity[d];
            }
            body.angle = turned;
            let places = Dim::<D>::places(&body.angle);
            for member in &body.members {
                let arm = Dim::<D>::place(&places, member.arm);
                positions[member.node as usize] = std::array::from_fn(|d| body.centre[d] + arm[d]);
            }
        }
    }
}

impl<const D: usize> Bodies<D>
where
    Dim<D>: RigidMotion<D> + CellGeometry<D> + Rotate<D>,
{
    /// Takes what acts on their mass now; `mass` of the nodes, kg/m.
    pub fn weigh(&mut self, forces: &BodyForces<D>, mass: &[f64]) {
        self.weigh_by(forces.accelerations(), |centre| forces.everywhere(centre), mass);
    }
}
