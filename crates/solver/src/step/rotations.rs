//! The update of nodes that rotate: I (ω^{n+½} − ω^{n−½}) = ½ (dt^{n−1} + dt^n) m^n, R^{n+1} = exp(dt^n
//! ω^{n+½}) R^n.
//!
//! Moments come from the slots of the blocks, summed in their order as forces are. With an inertia that is
//! the same about all axes the equations and the works are those of translations, with (I, ω, m) in the place
//! of (m, v, f): the update is that of `nodes.rs` in three dimensions. Damping in proportion to the mass
//! slows spins at the rate of the node. Nodes of symmetry planes rotate about the normal alone, joined nodes
//! together, nodes of rigid parts with their body, whose inertia has theirs.

use super::System;
use super::nodes::Pull;
use crate::archive::{Archive, ArchiveResult, Persist, persist_each};
use crate::assembly::Assembly;
use crate::block::Block;
use crate::dimension::Dimension;
use crate::energy::Sums;
use crate::load::constraint::NodeConstraint;
use crate::load::join::{Joins, back, turned};
use crate::model::in_3d;
use crate::reductions;
use crate::rigid::{Bodies, RigidMotion};
use crate::rotation::{Square, unit_matrix};
use crate::rotations::Rotations;
use crate::tensor::{Dim, cross};
use crate::vector::{dot, plus, times, unit};

/// The nodes that rotate. Lists have an entry for each of them, in the order of [`Rotations::nodes`].
#[derive(Clone, Debug, Default)]
pub(crate) struct NodalRotations {
    /// Rotations R^n, and spins ω^{n+½} from the update on, ω^{n−½} before.
    pub(crate) now: Rotations,
    /// ω^{n−½}, rad/s.
    pub(crate) spins_old: Vec<[f64; 3]>,
    /// Moment of inertia about any axis, kg m (kg m²).
    pub(crate) inertia: Vec<f64>,
    /// Moments of the elements, by the slots of the blocks.
    pub(crate) slots: Vec<[f64; 3]>,
    assembly: Assembly,
    /// Directions that are held.
    held: Vec<NodeConstraint<3>>,
    /// Rigid body of each; `u32::MAX`: none.
    bodies: Vec<u32>,
    /// Nodes that rotate as one: places and rotations from the first one, which leads.
    groups: Vec<Vec<(u32, Square<3>)>>,
    /// Whether each is in a group.
    is_joined: Vec<bool>,
}

impl Persist for NodalRotations {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { now, spins_old, inertia: _, slots: _, assembly: _, held: _, bodies: _, groups: _, is_joined: _ } = self;
        let Rotations { nodes: _, angles, attitudes, spins } = now;
        persist_each!(archive; &mut angles[..], &mut attitudes[..], &mut spins[..], &mut spins_old[..]);
        Ok(())
    }
}

/// A rotation of 2D or 3D as one of 3D.
fn square<const D: usize>(turn: &Square<D>) -> Square<3> {
    let mut whole = unit_matrix::<3>();
    turn.iter().zip(&mut whole).for_each(|(row, whole)| whole[..D].copy_from_slice(row));
    whole
}

impl NodalRotations {
    /// Of blocks, in which parts spin at the start as `spin` says of a node, rad/s. `normals` are those of
    /// the symmetry planes that a node is on.
    pub(super) fn new<const D: usize>(
        blocks: &[Box<dyn Block<D>>],
        spin: impl Fn(u32) -> [f64; 3],
        normals: impl Fn(u32) -> Vec<[f64; D]>,
        joins: &Joins<D>,
        bodies: &mut Bodies<D>,
    ) -> Self
    where
        Dim<D>: Dimension<D>,
    {
        let mut nodes: Vec<u32> = blocks.iter().flat_map(|block| block.rotating_nodes()).map(|(node, _)| node).collect();
        if nodes.is_empty() {
            return Self::default();
        }
        nodes.sort_unstable();
        nodes.dedup();
        let count = nodes.len();
        let mut now = Rotations::at_rest(nodes, D);
        let place = |node: u32| now.place(node).map_or(u32::MAX, |place| place as u32);
        let mut inertia = vec![0.0; count];
        for (node, share) in blocks.iter().flat_map(|block| block.rotating_nodes()) {
            inertia[place(node) as usize] += share;
        }
        let places: Vec<Vec<u32>> = blocks.iter().map(|block| block.moment_slots().iter().map(|&node| place(node)).collect()).collect();
        let assembly = Assembly::new(count, &places.iter().map(|places| &places[..]).collect::<Vec<_>>());
        let mut groups: Vec<Vec<(u32, Square<3>)>> = Vec::new();
        let mut is_joined = vec![false; count];
        for group in joins.groups() {
            let members = group.members.iter().map(|member| (place(member.node), square(&member.turn)));
            let members: Vec<(u32, Square<3>)> = members.filter(|(place, _)| *place != u32::MAX).collect();
            // Seen from the first of them: its leader may have no rotation.
            let Some(&(_, first)) = members.first() else { continue };
            members.iter().for_each(|&(place, _)| is_joined[place as usize] = true);
            groups.push(
                members.iter().map(|&(place, turn)| (place, crate::tensor::product(&turn, &crate::rotation::transposed(&first)))).collect(),
            );
        }
        let held: Vec<NodeConstraint<3>> = now.nodes.iter().map(|&node| held_by(&normals(node))).collect();
        let of_body = |(&node, &inertia): (&u32, &f64)| {
            let body = bodies.of_node(node);
            if let Some(body) = body {
                bodies.add_inertia(body, inertia);
            }
            body.map_or(u32::MAX, |body| body as u32)
        };
        let of_bodies = now.nodes.iter().zip(&inertia).map(of_body).collect();
        now.spins = now.nodes.iter().map(|&node| spin(node)).collect();
        let slots = vec![[0.0; 3]; assembly.count];
        Self { spins_old: now.spins.clone(), now, inertia, slots, assembly, held, bodies: of_bodies, groups, is_joined }
    }

    /// The first nodes of groups, alone or not, that no rigid body leads.
    fn is_own(&self, place: usize) -> bool {
        self.bodies[place] == u32::MAX && !self.is_joined[place]
    }

    /// Moment of the elements on a node; `None`: it has no rotation.
    pub(crate) fn moment(&self, node: u32) -> Option<[f64; 3]> {
        self.now.place(node).map(|place| self.assembly.force(place, &self.slots))
    }

    /// I ω^{n+½} of the nodes that no rigid body leads.
    pub(crate) fn momenta(&self) -> impl Iterator<Item = [f64; 3]> {
        let own = (0..self.inertia.len()).filter(|&place| self.bodies[place] == u32::MAX);
        own.map(|place| times(self.inertia[place], self.now.spins[place]))
    }

    /// Prescribes what is prescribed at the start. Returns the kinetic energy of what no rigid body leads,
    /// J/m.
    pub(super) fn start<const D: usize>(&mut self, bodies: &Bodies<D>) -> f64
    where
        Dim<D>: Dimension<D>,
    {
        for place in 0..self.inertia.len() {
            if self.is_own(place) {
                self.now.spins[place] = self.held[place].apply(self.now.spins[place]);
            }
        }
        for group in 0..self.groups.len() {
            let whole: f64 = self.members(group).map(|(place, _)| self.inertia[place]).sum();
            let sum = self
                .members(group)
                .fold([0.0; 3], |sum, (place, turn)| plus(sum, times(self.inertia[place] / whole, back(*turn, self.now.spins[place]))));
            self.lead(group, self.held_in(group).apply(sum));
        }
        self.follow(bodies);
        self.spins_old.clone_from(&self.now.spins);
        reductions::sum(
            (0..self.inertia.len())
                .filter(|&place| self.bodies[place] == u32::MAX)
                .map(|place| 0.5 * self.inertia[place] * dot(self.now.spins[place], self.now.spins[place])),
        )
    }

    /// R^{n+1}.
    pub(super) fn advance<const D: usize>(&mut self, time_step: f64, bodies: &Bodies<D>)
    where
        Dim<D>: Dimension<D>,
    {
        for place in 0..self.inertia.len() {
            if self.bodies[place] == u32::MAX {
                self.now.rotate(place, times(time_step, self.now.spins[place]));
                continue;
            }
            let (angle, attitude) = <Dim<D>>::orientation(&bodies.state(self.bodies[place] as usize).angle);
            self.now.angles.get_mut(place).into_iter().for_each(|own| *own = angle);
            self.now.attitudes.get_mut(place).into_iter().for_each(|own| *own = attitude);
        }
    }

    /// ω^{n+½}, and the part of it in the ledger; Δt is `mean_step`, a of damping `slowing` at a node. Spins
    /// of rigid bodies are known already.
    pub(super) fn accelerate<const D: usize>(&mut self, mean_step: f64, slowing: impl Fn(usize) -> f64, bodies: &Bodies<D>) -> Sums
    where
        Dim<D>: Dimension<D>,
    {
        let mut sums = Sums::default();
        std::mem::swap(&mut self.now.spins, &mut self.spins_old);
        for place in 0..self.inertia.len() {
            if self.is_own(place) {
                let (old, slowing) = (self.spins_old[place], slowing(self.now.nodes[place] as usize));
                let (moment, held) = (self.assembly.force(place, &self.slots), Some(&self.held[place]).filter(|held| !held.is_empty()));
                let pull = Pull::<3>::of_elements(self.inertia[place], old, moment, slowing, held);
                self.now.spins[place] = pull.advance(mean_step, &mut sums);
            }
        }
        for group in 0..self.groups.len() {
            let inertia = self.members(group).map(|(place, _)| self.inertia[place]).sum::<f64>();
            let slowed = |place: usize| self.inertia[place] * slowing(self.now.nodes[place] as usize);
            let moment = |place: usize| self.assembly.force(place, &self.slots);
            let held = self.held_in(group);
            let old = self.spins_old[self.groups[group][0].0 as usize];
            let whole = self.members(group).fold([0.0; 3], |sum, (place, turn)| plus(sum, back(*turn, moment(place))));
            let slowing = self.members(group).map(|(place, _)| slowed(place)).sum::<f64>() / inertia;
            let pull = Pull::<3>::of_elements(inertia, old, whole, slowing, Some(&held).filter(|held| !held.is_empty()));
            let spin = pull.advance(mean_step, &mut sums);
            self.lead(group, spin);
        }
        self.follow(bodies);
        sums
    }

    fn members(&self, group: usize) -> impl Iterator<Item = (usize, &Square<3>)> {
        self.groups[group].iter().map(|(place, turn)| (*place as usize, turn))
    }

    /// What holds any member of a group, seen from its leader.
    fn held_in(&self, group: usize) -> NodeConstraint<3> {
        let mut held = NodeConstraint::default();
        for (place, turn) in self.members(group) {
            self.held[place].directions().for_each(|direction| held.rest(back(*turn, direction)));
        }
        held
    }

    fn lead(&mut self, group: usize, spin: [f64; 3]) {
        for &(place, turn) in &self.groups[group] {
            self.now.spins[place as usize] = turned(turn, spin);
        }
    }

    /// Nodes of rigid bodies spin as these.
    fn follow<const D: usize>(&mut self, bodies: &Bodies<D>)
    where
        Dim<D>: Dimension<D>,
    {
        for (spin, &body) in self.now.spins.iter_mut().zip(&self.bodies) {
            if body != u32::MAX {
                *spin = <Dim<D>>::spin_vector(&bodies.state(body as usize).velocity);
            }
        }
    }
}

/// Directions about which a node of symmetry planes can't rotate: those in the planes. In 2D all planes are
/// normal to the plane of the model.
fn held_by<const D: usize>(normals: &[[f64; D]]) -> NodeConstraint<3> {
    let mut held = NodeConstraint::default();
    for &normal in normals {
        let n: [f64; 3] = in_3d(normal);
        // The axis that is farthest from the normal.
        let farthest = (0..3).min_by(|&a, &b| n[a].abs().total_cmp(&n[b].abs())).unwrap_or(0);
        let Some(first) = unit(cross(n, unit_matrix::<3>()[farthest])) else { continue };
        held.rest(first);
        held.rest(cross(n, first));
    }
    held
}

impl<const D: usize> System<D>
where
    Dim<D>: Dimension<D>,
{
    /// Finds the nodes that rotate; `spin` says how fast at the start, rad/s.
    pub(crate) fn find_rotations(&mut self, spin: impl Fn(u32) -> [f64; 3]) {
        let normals = |node: u32| self.constraints.mirror_normals(node).collect();
        self.rotations = NodalRotations::new(&self.blocks, spin, normals, &self.joins, &mut self.bodies);
    }
}

#[cfg(test)]
mod tests;
