//! The velocity update of nodes: what pulls on a node (or on a group that moves as one), how it yields,
//! and what the ledger get.
//!
//! Forces come from the assembly, contacts and loads; new velocities and sums go back to `step.rs`, and the
//! answers to springs in contact to [`crate::contact::springs`]. With m̃ = m (1 + a) I + ½ Δt C of damping
//! (a) and dashpots (C), Δt = ½ (dt^{n−1} + dt^n), an impulse J changes the velocity by m̃⁻¹ J.

use crate::assembly::Assembly;
use crate::contact::springs::{Carrier, NodeResponse, NodeResponses, TangentSpace};
use crate::contact_forces::ContactForces;
use crate::dimension::Dimension;
use crate::energy::Sums;
use crate::load::constraint::{Constraints, NodeConstraint};
use crate::load::damping::Damping;
use crate::load::join::{Group, Joins};
use crate::load::non_reflecting::NonReflecting;
use crate::rigid::Bodies;
use crate::rotation::{Square, applied, inverse, transposed, unit_matrix};
use crate::skins::Skins;
use crate::step::free::{Coast, Free};
use crate::step::rotations::NodalRotations;
use crate::tensor::{Dim, product};
use crate::vector::{dot, minus, plus, times};
use embate_lanes::{BATCH, Level};

/// What the velocity update reads.
pub(crate) struct Nodes<'a, const D: usize>
where
    Dim<D>: Dimension<D>,
{
    /// Δt = ½ (dt^{n−1} + dt^n), s.
    pub(crate) dt: f64,
    pub(crate) assembly: &'a Assembly,
    pub(crate) slots: &'a [[f64; D]],
    /// N/m; `None` without contacts.
    pub(crate) contact_forces: Option<&'a ContactForces<D>>,
    /// Forces on nodes, N/m; empty without.
    pub(crate) loads: &'a [[f64; D]],
    /// Accelerations of mass, m/s²; empty without.
    pub(crate) gravity: &'a [[f64; D]],
    pub(crate) mass: &'a [f64],
    pub(crate) constraints: &'a Constraints<D>,
    pub(crate) damping: &'a Damping,
    pub(crate) boundary: &'a NonReflecting<D>,
    pub(crate) joins: &'a Joins<D>,
    pub(crate) bodies: &'a Bodies<D>,
    pub(crate) skins: &'a Skins<D>,
    pub(crate) rotations: &'a NodalRotations,
    pub(crate) velocities_old: &'a [[f64; D]],
    /// x^n, m, and the step that will lead to x^{n+1}, s.
    pub(crate) positions: &'a [[f64; D]],
    pub(crate) time_step: f64,
    /// Whether each group of eight nodes is free (`free.rs`).
    pub(crate) free: &'a [bool],
    pub(crate) level: Level,
}

/// What pulls on a node or on a group, seen from its leader.
pub(super) struct Pull<'a, const D: usize> {
    mass: f64,
    old: [f64; D],
    internal: [f64; D],
    contact: [f64; D],
    load: Option<[f64; D]>,
    gravity: Option<[f64; D]>,
    /// a of damping.
    slowing: f64,
    /// ½ Δt C.
    dashpot: Option<Square<D>>,
    held: Option<&'a NodeConstraint<D>>,
}

impl<'a, const D: usize> Pull<'a, D>
where
    Dim<D>: Dimension<D>,
{
    /// Of what elements pull on, and loads.
    pub(super) fn of_elements(
        mass: f64,
        old: [f64; D],
        [internal, contact, load]: [Option<[f64; D]>; 3],
        slowing: f64,
        held: Option<&'a NodeConstraint<D>>,
    ) -> Self {
        let [internal, contact] = [internal, contact].map(|force| force.unwrap_or([0.0; D]));
        Self { mass, old, internal, contact, load, gravity: None, slowing, dashpot: None, held }
    }

    /// m̃.
    fn inertia(&self) -> Square<D> {
        let m = self.mass * (1.0 + self.slowing);
        let mut inertia = self.dashpot.unwrap_or([[0.0; D]; D]);
        (0..D).for_each(|d| inertia[d][d] += m);
        inertia
    }

    /// The velocity that damping and dashpots leave of one without them.
    fn slowed(&self, v: [f64; D]) -> [f64; D] {
        let old = self.old;
        let mut v = slowed(v, old, self.slowing);
        if let Some(dashpot) = self.dashpot {
            let change = applied(&inverse(&self.inertia()), applied(&dashpot, plus(v, old)));
            v = std::array::from_fn(|d| v[d] - change[d]);
        }
        v
    }

    /// The velocity after Δt without contact.
    pub(super) fn free_velocity(&self, dt: f64) -> [f64; D] {
        let load = self.load.unwrap_or([0.0; D]);
        self.held(self.slowed(plus(self.old, times(dt / self.mass, plus(self.internal, load)))))
    }

    /// Its change per force of contact.
    pub(super) fn mobility_over(&self, dt: f64) -> Square<D> {
        let scale = dt / (self.mass * (1.0 + self.slowing));
        let free = unit_matrix::<D>().map(|row| row.map(|value| scale * value));
        self.held.map_or(free, |held| held.mobility(free))
    }

    /// The velocity with what is prescribed.
    fn held(&self, free: [f64; D]) -> [f64; D] {
        match (self.held, self.dashpot) {
            (None, _) => free,
            (Some(held), None) => held.apply(free),
            (Some(held), Some(_)) => held.apply_in(free, inverse(&self.inertia())),
        }
    }
}

/// The velocity that damping with the factor a leaves of one without it.
fn slowed<const D: usize>(v: [f64; D], old: [f64; D], a: f64) -> [f64; D] {
    if a > 0.0 { std::array::from_fn(|d| (v[d] - a * old[d]) / (1.0 + a)) } else { v }
}

impl<'a, const D: usize> Nodes<'a, D>
where
    Dim<D>: Dimension<D>,
{
    /// Of a node that is in no group.
    fn pull(&self, node: usize) -> Pull<'a, D> {
        Pull {
            mass: self.mass[node],
            old: self.velocities_old[node],
            internal: self.assembly.force(node, self.slots),
            contact: self.contact_force(node),
            load: self.loads.get(node).copied(),
            gravity: self.gravity.get(node).copied(),
            slowing: self.damping.factor(node),
            dashpot: self.boundary.of(node).map(|matrix| matrix.map(|row| row.map(|c| 0.5 * self.dt * c))),
            held: self.constraints.of(node),
        }
    }

    fn contact_force(&self, node: usize) -> [f64; D] {
        self.contact_forces.map_or([0.0; D], |forces| forces.of(node))
    }

    fn pull_of(&self, group: &Group<D>) -> Pull<'a, D> {
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
    fn dashpot_of(&self, group: &Group<D>) -> Option<Square<D>> {
        let mut sum: Option<Square<D>> = None;
        for member in &group.members {
            if let Some(matrix) = self.boundary.of(member.node as usize) {
                let turned = product(&product(&transposed(&member.turn), &matrix), &member.turn);
                let own = turned.map(|row| row.map(|value| 0.5 * self.dt * value));
                sum = Some(sum.map_or(own, |sum| std::array::from_fn(|i| plus(sum[i], own[i]))));
            }
        }
        sum
    }

    /// What pulls on whatever a node leads.
    fn pull_on(&self, leader: usize) -> Pull<'a, D> {
        self.joins.of_node(leader as u32).map_or_else(|| self.pull(leader), |(group, _)| self.pull_of(group))
    }

    /// Updates the velocities of the nodes from `first` on (a multiple of eight) and sums their works; groups
    /// that move as one are left out. The next positions of free nodes follow at once; those of held ones
    /// have room for the forces of what holds them until the nodes are moved.
    pub(crate) fn update(&self, first: usize, velocities: &mut [[f64; D]], positions_next: &mut [[f64; D]]) -> Sums {
        let mut sums = self.level.run(Free { nodes: self, first, velocities: &mut *velocities, positions_next: &mut *positions_next });
        for (group, (velocities, reactions)) in velocities.chunks_mut(BATCH).zip(positions_next.chunks_mut(BATCH)).enumerate() {
            let first = first + group * BATCH;
            if self.free.get(first / BATCH) == Some(&true) || self.skins.leads(first..first + velocities.len()) {
                continue;
            }
            for (node, (v, reaction)) in (first..).zip(velocities.iter_mut().zip(reactions)) {
                if self.bodies.of_node(node as u32).is_none()
                    && self.joins.of_node(node as u32).is_none()
                    && self.skins.carrier(node).is_none()
                {
                    *v = self.pull(node).advance_held(self.dt, &mut sums, reaction);
                }
            }
        }
        sums
    }

    /// Whether nodes that no element pulls at keep their velocities: but for contact and what holds them.
    pub(crate) fn coast_freely(&self) -> bool {
        self.loads.is_empty() && self.gravity.is_empty() && !self.damping.acts()
    }

    /// Force (N/m) of what holds a node or leads its group, with its velocity after the update.
    pub(crate) fn reaction(&self, leader: usize, v: [f64; D]) -> [f64; D] {
        self.pull_on(leader).reaction(self.dt, v)
    }

    /// The same as [`Nodes::update`] for nodes that coast, with the sums of their last step; `None` where a
    /// contact pushes one. `has_coasted`: in the last step too, so that their velocities are in place.
    pub(crate) fn coast(
        &self,
        (first, has_coasted): (usize, bool),
        velocities: &mut [[f64; D]],
        positions_next: &mut [[f64; D]],
        last: &Sums,
    ) -> Option<Sums> {
        let groups = first / BATCH..(first + velocities.len()) / BATCH;
        if self.contact_forces.is_some_and(|forces| groups.clone().any(|group| forces.has(group))) {
            return None;
        }
        if !has_coasted {
            velocities.copy_from_slice(&self.velocities_old[first..first + velocities.len()]);
        }
        self.level.run(Coast { nodes: self, first, positions_next });
        let Sums { kinetic_half, speed_squared, .. } = *last;
        Some(Sums { kinetic_half, kinetic: kinetic_half, speed_squared, ..Sums::default() })
    }

    /// Updates the velocities of the groups and sums their works.
    pub(crate) fn update_groups(&self, velocities: &mut [[f64; D]]) -> Sums {
        let mut sums = Sums::default();
        for group in self.joins.groups() {
            let velocity = self.advance(&self.pull_of(group), &mut sums);
            group.lead(velocity, velocities);
        }
        sums
    }

    /// v^{n+½}, and its part in the ledger.
    fn advance(&self, pull: &Pull<'_, D>, sums: &mut Sums) -> [f64; D] {
        pull.advance(self.dt, sums)
    }
}

impl<const D: usize> Pull<'_, D>
where
    Dim<D>: Dimension<D>,
{
    /// v^{n+½} after Δt without what is prescribed.
    #[inline(always)]
    fn unheld(&self, dt: f64) -> [f64; D] {
        let scale = dt / self.mass;
        let mut v = plus(self.old, times(scale, plus(self.internal, self.contact)));
        if let Some(load) = self.load {
            v = plus(v, times(scale, load));
        }
        if let Some(g) = self.gravity {
            v = plus(v, times(dt, g));
        }
        self.slowed(v)
    }

    /// Force (N/m) with which what is prescribed has led to the velocity `v` in Δt.
    pub(super) fn reaction(&self, dt: f64, v: [f64; D]) -> [f64; D] {
        times(1.0 / dt, applied(&self.inertia(), minus(v, self.unheld(dt))))
    }

    /// v^{n+½} after Δt, and its part in the ledger.
    pub(super) fn advance(&self, dt: f64, sums: &mut Sums) -> [f64; D] {
        self.advance_held(dt, sums, &mut [0.0; D])
    }

    /// The same with the force of what is prescribed, N/m.
    #[inline]
    pub(super) fn advance_held(&self, dt: f64, sums: &mut Sums, reaction: &mut [f64; D]) -> [f64; D] {
        let (pull, m, old) = (self, self.mass, self.old);
        let free = pull.unheld(dt);
        let v = pull.held(free);
        let mean = times(0.5, plus(old, v));
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
            let drag = pull.dashpot.map_or([0.0; D], |dashpot| applied(&dashpot, mean));
            let impulse = std::array::from_fn(|d| -2.0 * pull.slowing * m * mean[d] - 2.0 * drag[d]);
            sums.damping += dot(impulse, mean);
            sums.damping_old += dot(impulse, old);
        }
        if pull.held.is_some() {
            let impulse = applied(&pull.inertia(), std::array::from_fn(|d| v[d] - free[d]));
            *reaction = times(1.0 / dt, impulse);
            sums.constraint += dot(impulse, mean);
            sums.external_old += dot(impulse, old);
        }
        v
    }
}

impl<const D: usize> NodeResponses<D> for Nodes<'_, D>
where
    Dim<D>: Dimension<D>,
{
    fn count(&self) -> usize {
        self.mass.len()
    }

    fn leader(&self, node: u32) -> (u32, Option<<Dim<D> as TangentSpace<D>>::ImageRotation>) {
        let (leader, turn) = self.joins.leader(node);
        (leader, (turn != unit_matrix()).then(|| <Dim<D>>::image_rotation(&turn)))
    }

    fn response(&self, leader: usize) -> NodeResponse<D> {
        let mut mobility = <Dim<D> as TangentSpace<D>>::Symmetric::default();
        if self.free.get(leader / BATCH) == Some(&true) {
            let (mass, old, slowing) = (self.mass[leader], self.velocities_old[leader], self.damping.factor(leader));
            let (load, gravity) = (self.loads.get(leader).copied(), self.gravity.get(leader).copied());
            let free = self.unpushed((mass, old), self.assembly.force(leader, self.slots), load, gravity);
            let scale = self.dt / (mass * (1.0 + slowing));
            (0..D).for_each(|d| mobility[<Dim<D>>::AT[d][d]] = scale);
            return NodeResponse { velocity_old: old, velocity: slowed(free, old, slowing), mobility };
        }
        let pull = self.pull_on(leader);
        let (v, free) = (pull.old, self.unpushed((pull.mass, pull.old), pull.internal, pull.load, pull.gravity));
        for (i, row) in self.mobility(&pull).into_iter().enumerate() {
            row.into_iter().enumerate().skip(i).for_each(|(j, value)| mobility[<Dim<D>>::AT[i][j]] = value);
        }
        NodeResponse { velocity_old: v, velocity: pull.held(pull.slowed(free)), mobility }
    }

    fn carrier(&self, node: u32) -> Option<u32> {
        self.skins.carrier(node as usize).map(|(_, place)| self.rotations.leader(place) as u32)
    }

    fn carried_point(&self, node: u32) -> [f64; D] {
        let x = self.positions[node as usize];
        let Some((owner, place)) = self.skins.carrier(node as usize) else { return x };
        let leader = self.rotations.now.nodes[self.rotations.leader(place)];
        // Joined nodes move as one, wherever they are.
        if leader == owner { x } else { plus(minus(x, self.positions[owner as usize]), self.positions[leader as usize]) }
    }

    fn carried(&self, carrier: usize) -> Carrier<D> {
        let node = self.rotations.now.nodes[carrier];
        let (spins, spin_mobility) = self.rotations.response(carrier, self.dt, |node| self.damping.factor(node));
        let leader = self.joins.leader(node).0;
        Carrier { node: self.response(leader as usize), spins, spin_mobility, centre: self.positions[node as usize] }
    }

    fn moves(&self, leader: usize) -> bool {
        let is_held = || self.constraints.of(leader).is_some() || self.boundary.of(leader).is_some();
        self.free.get(leader / BATCH) == Some(&true) || !is_held() || self.mobility(&self.pull_on(leader)) != [[0.0; D]; D]
    }
}

impl<const D: usize> Nodes<'_, D>
where
    Dim<D>: Dimension<D>,
{
    /// Velocity (m/s) of a mass that neither contacts nor what holds it push.
    fn unpushed(&self, (mass, old): (f64, [f64; D]), force: [f64; D], load: Option<[f64; D]>, gravity: Option<[f64; D]>) -> [f64; D] {
        let g = gravity.unwrap_or([0.0; D]);
        let velocity = std::array::from_fn(|d| old[d] + self.dt * (force[d] / mass + g[d]));
        load.map_or(velocity, |load| plus(velocity, times(self.dt / mass, load)))
    }

    /// Change of velocity per force.
    fn mobility(&self, pull: &Pull<'_, D>) -> Square<D> {
        if pull.dashpot.is_some() {
            let free = inverse(&pull.inertia());
            return pull.held.map_or(free, |held| held.mobility(free)).map(|row| row.map(|value| self.dt * value));
        }
        let scale = self.dt / (pull.mass * (1.0 + pull.slowing));
        match pull.held {
            None => unit_matrix::<D>().map(|row| row.map(|value| if value == 0.0 { 0.0 } else { scale })),
            Some(held) => {
                let free = unit_matrix::<D>().map(|direction| held.free_part(direction));
                let entry = |i: usize, j: usize| if i == j { scale * free[i][i] } else { scale * 0.5 * (free[i][j] + free[j][i]) };
                std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
            }
        }
    }
}
