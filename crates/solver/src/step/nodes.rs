//! The velocity update of nodes: what pulls on a node (or on a group that moves as one), how it gives way, and what the books get.
//!
//! Forces come from the assembly, contacts and loads; new velocities and sums go back to `step.rs`, and the answers to springs in contact to
//! [`crate::contact::springs`]. With m̃ = m (1 + a) I + ½ Δt C of damping (a) and dashpots (C), Δt = ½ (dt^{n−1} + dt^n), an impulse J changes the velocity by m̃⁻¹ J.

use crate::assembly::Assembly;
use crate::contact::forces::ContactForces;
use crate::contact::springs::{Mover, Movers};
use crate::energy::Sums;
use crate::load::constraint::{Constraints, Held};
use crate::load::damping::Damping;
use crate::load::join::{Group, Joins};
use crate::load::non_reflecting::{Matrix, NonReflecting, inverse, times};
use crate::rigid::Bodies;
use crate::step::Vector;
use crate::step::free::Free;
use embate_lanes::{BATCH, Level};

/// What the velocity update reads.
pub(crate) struct Nodes<'a> {
    /// Δt = ½ (dt^{n−1} + dt^n), s.
    pub(crate) dt: f64,
    pub(crate) assembly: &'a Assembly,
    pub(crate) slots: &'a [Vector],
    /// N/m; `None` without contacts.
    pub(crate) contact_forces: Option<&'a ContactForces>,
    /// Forces on nodes, N/m; empty without.
    pub(crate) loads: &'a [Vector],
    /// Accelerations of mass, m/s²; empty without.
    pub(crate) gravity: &'a [Vector],
    pub(crate) mass: &'a [f64],
    pub(crate) constraints: &'a Constraints<2>,
    pub(crate) damping: &'a Damping,
    pub(crate) boundary: &'a NonReflecting,
    pub(crate) joins: &'a Joins,
    pub(crate) bodies: &'a Bodies,
    pub(crate) velocities_old: &'a [Vector],
    /// x^n, m, and the step that will lead to x^{n+1}, s.
    pub(crate) positions: &'a [Vector],
    pub(crate) time_step: f64,
    /// Whether each group of eight nodes is free (`free.rs`).
    pub(crate) free: &'a [bool],
    pub(crate) level: Level,
}

/// What pulls on a node or on a group, seen from its leader.
struct Pull<'a> {
    mass: f64,
    old: Vector,
    internal: Vector,
    contact: Vector,
    load: Option<Vector>,
    gravity: Option<Vector>,
    /// a of damping.
    slowing: f64,
    /// ½ Δt C.
    dashpot: Option<Matrix>,
    held: Option<&'a Held<2>>,
}

impl Pull<'_> {
    /// m̃.
    fn inertia(&self) -> Matrix {
        let m = self.mass * (1.0 + self.slowing);
        self.dashpot.map_or([m, 0.0, m], |[xx, xy, yy]| [m + xx, xy, m + yy])
    }

    /// The velocity that damping and dashpots leave of one without them.
    fn slowed(&self, mut v: Vector) -> Vector {
        let (a, old) = (self.slowing, self.old);
        if a > 0.0 {
            v = [(v[0] - a * old[0]) / (1.0 + a), (v[1] - a * old[1]) / (1.0 + a)];
        }
        if let Some(dashpot) = self.dashpot {
            let change = times(inverse(self.inertia()), times(dashpot, [v[0] + old[0], v[1] + old[1]]));
            v = [v[0] - change[0], v[1] - change[1]];
        }
        v
    }

    /// The velocity with what is prescribed.
    fn held(&self, free: Vector) -> Vector {
        match (self.held, self.dashpot) {
            (None, _) => free,
            (Some(held), None) => held.apply(free),
            (Some(held), Some(_)) => held.apply_in(free, inverse(self.inertia())),
        }
    }
}

impl<'a> Nodes<'a> {
    /// Of a node that is in no group.
    fn pull(&self, node: usize) -> Pull<'a> {
        Pull {
            mass: self.mass[node],
            old: self.velocities_old[node],
            internal: self.assembly.force(node, self.slots),
            contact: self.contact_force(node),
            load: self.loads.get(node).copied(),
            gravity: self.gravity.get(node).copied(),
            slowing: self.damping.factor(node),
            dashpot: self.boundary.of(node).map(|matrix| matrix.map(|c| 0.5 * self.dt * c)),
            held: self.constraints.of(node),
        }
    }

    fn contact_force(&self, node: usize) -> Vector {
        self.contact_forces.map_or([0.0; 2], |forces| forces.of(node))
    }

    fn pull_of(&self, group: &Group) -> Pull<'a> {
        let whole = |of: &dyn Fn(usize) -> f64| group.members.iter().map(|member| of(member.node as usize)).sum::<f64>();
        let (mass, leader) = (whole(&|node| self.mass[node]), group.members[0].node as usize);
        let weight = |node: usize| self.gravity[node].map(|g| self.mass[node] * g);
        Pull {
            mass,
            old: self.velocities_old[leader],
            internal: group.sum(|node| self.assembly.force(node, self.slots)),
            contact: group.sum(|node| self.contact_force(node)),
            load: (!self.loads.is_empty()).then(|| group.sum(|node| self.loads[node])),
            gravity: (!self.gravity.is_empty()).then(|| group.sum(weight).map(|force| force / mass)),
            slowing: whole(&|node| self.mass[node] * self.damping.factor(node)) / mass,
            dashpot: self.dashpot_of(group),
            held: self.constraints.of(leader),
        }
    }

    /// Σ ½ Δt R_iᵀ C_i R_i.
    fn dashpot_of(&self, group: &Group) -> Option<Matrix> {
        let mut sum = None;
        for member in &group.members {
            if let Some([xx, xy, yy]) = self.boundary.of(member.node as usize) {
                let ([c, s], [a, b, d]) = (member.turn, sum.unwrap_or([0.0; 3]));
                let turned = [
                    c * c * xx + 2.0 * c * s * xy + s * s * yy,
                    c * s * (yy - xx) + (c * c - s * s) * xy,
                    s * s * xx - 2.0 * c * s * xy + c * c * yy,
                ];
                let [xx, xy, yy] = turned.map(|value| 0.5 * self.dt * value);
                sum = Some([a + xx, b + xy, d + yy]);
            }
        }
        sum
    }

    /// What pulls on whatever a node leads.
    fn pull_on(&self, leader: usize) -> Pull<'a> {
        self.joins.of_node(leader as u32).map_or_else(|| self.pull(leader), |(group, _)| self.pull_of(group))
    }

    /// Updates the velocities of the nodes from `first` on (a multiple of eight) and sums their works; groups that move as one are left out. The next positions of
    /// free nodes follow at once.
    pub(crate) fn update(&self, first: usize, velocities: &mut [Vector], positions_next: &mut [Vector]) -> Sums {
        let mut sums = self.level.run(Free { nodes: self, first, velocities: &mut *velocities, positions_next });
        for (group, velocities) in velocities.chunks_mut(BATCH).enumerate() {
            let first = first + group * BATCH;
            if self.free.get(first / BATCH) == Some(&true) {
                continue;
            }
            for (node, v) in (first..).zip(velocities) {
                if self.bodies.of_node(node as u32).is_none() && self.joins.of_node(node as u32).is_none() {
                    *v = self.advance(&self.pull(node), &mut sums);
                }
            }
        }
        sums
    }

    /// Updates the velocities of the groups and sums their works.
    pub(crate) fn update_groups(&self, velocities: &mut [Vector]) -> Sums {
        let mut sums = Sums::default();
        for group in self.joins.groups() {
            let velocity = self.advance(&self.pull_of(group), &mut sums);
            group.lead(velocity, velocities);
        }
        sums
    }

    /// v^{n+½}, and its part in the books.
    fn advance(&self, pull: &Pull<'_>, sums: &mut Sums) -> Vector {
        let (m, old, dt) = (pull.mass, pull.old, self.dt);
        let scale = dt / m;
        let mut v = [old[0] + scale * (pull.internal[0] + pull.contact[0]), old[1] + scale * (pull.internal[1] + pull.contact[1])];
        if let Some(load) = pull.load {
            v = [v[0] + scale * load[0], v[1] + scale * load[1]];
        }
        if let Some(g) = pull.gravity {
            v = [v[0] + dt * g[0], v[1] + dt * g[1]];
        }
        let free = pull.slowed(v);
        v = pull.held(free);
        let mean = [0.5 * (old[0] + v[0]), 0.5 * (old[1] + v[1])];
        let dot = |a: Vector, b: Vector| a[0] * b[0] + a[1] * b[1];
        sums.kinetic_half += 0.5 * m * dot(v, v);
        sums.kinetic += 0.5 * m * dot(old, v);
        sums.internal += dt * dot(pull.internal, mean);
        if let Some(load) = pull.load {
            sums.load += dt * dot(load, mean);
            sums.external_old += dt * dot(load, old);
        }
        if let Some(g) = pull.gravity {
            sums.gravity += dt * m * dot(g, mean);
            sums.external_old += dt * m * dot(g, old);
        }
        if pull.slowing > 0.0 || pull.dashpot.is_some() {
            let drag = pull.dashpot.map_or([0.0; 2], |dashpot| times(dashpot, mean));
            let impulse = [0, 1].map(|d| -2.0 * pull.slowing * m * mean[d] - 2.0 * drag[d]);
            sums.damping += dot(impulse, mean);
            sums.damping_old += dot(impulse, old);
        }
        if pull.held.is_some() {
            let impulse = times(pull.inertia(), [v[0] - free[0], v[1] - free[1]]);
            sums.constraint += dot(impulse, mean);
            sums.external_old += dot(impulse, old);
        }
        v
    }
}

impl Movers for Nodes<'_> {
    fn count(&self) -> usize {
        self.mass.len()
    }

    fn leader(&self, node: u32) -> (u32, Option<[f64; 2]>) {
        let (leader, turn) = self.joins.leader(node);
        (leader, (turn != [1.0, 0.0]).then_some(turn))
    }

    fn mover(&self, leader: usize) -> Mover {
        let pull = self.pull_on(leader);
        let (f, v, g) = (pull.internal, pull.old, pull.gravity.unwrap_or_default());
        let mut free = [v[0] + self.dt * (f[0] / pull.mass + g[0]), v[1] + self.dt * (f[1] / pull.mass + g[1])];
        if let Some(load) = pull.load {
            free = [free[0] + self.dt / pull.mass * load[0], free[1] + self.dt / pull.mass * load[1]];
        }
        Mover { velocity_old: v, velocity: pull.held(pull.slowed(free)), mobility: self.mobility(&pull) }
    }

    fn moves(&self, leader: usize) -> bool {
        let is_held = self.constraints.of(leader).is_some() || self.boundary.of(leader).is_some();
        !is_held || self.mobility(&self.pull_on(leader)) != [0.0; 3]
    }
}

impl Nodes<'_> {
    /// Change of velocity per force.
    fn mobility(&self, pull: &Pull<'_>) -> Matrix {
        if pull.dashpot.is_some() {
            let free = inverse(pull.inertia());
            return pull.held.map_or(free, |held| held.mobility(free)).map(|value| self.dt * value);
        }
        let scale = self.dt / (pull.mass * (1.0 + pull.slowing));
        match pull.held {
            None => [scale, 0.0, scale],
            Some(held) => {
                let (x, y) = (held.free_part([1.0, 0.0]), held.free_part([0.0, 1.0]));
                [scale * x[0], scale * 0.5 * (x[1] + y[0]), scale * y[1]]
            }
        }
    }
}
