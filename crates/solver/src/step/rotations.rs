//! The update of nodes that rotate: I (ω^{n+½} − ω^{n−½}) = ½ (dt^{n−1} + dt^n) m^n, R^{n+1} = exp(dt^n
//! ω^{n+½}) R^n.
//!
//! Moments come from the slots of the blocks, summed in their order as forces are. With an inertia that is
//! the same about all axes the equations and the works are those of translations, with (I, ω, m) in the place
//! of (m, v, f): the update is that of `nodes.rs` in three dimensions. Damping in proportion to the mass
//! slows spins at the rate of the node. Nodes of symmetry planes rotate about the normal alone, joined nodes
//! together, nodes of rigid parts with their body, whose inertia has theirs.

mod lanes;

use super::System;
use super::free::Groups as Eights;
use super::nodes::Pull;
use crate::archive::{Archive, ArchiveResult, Persist, persist_each};
use crate::assembly::Assembly;
use crate::block::{Block, NO_NODE};
use crate::dimension::Dimension;
use crate::energy::Sums;
use crate::load::constraint::{Constraints, NodeConstraint};
use crate::load::curve::Curves;
use crate::load::curve::factor::Factor;
use crate::load::damping::Damping;
use crate::load::join::{Joins, back, turned};
use crate::model::{Load, Model, in_3d};
use crate::reductions;
use crate::rigid::space::Attitude;
use crate::rigid::{Bodies, RigidMotion};
use crate::rotation::{Square, transposed, unit_matrix};
use crate::rotations::Rotations;
use crate::tensor::{Dim, cross, product};
use crate::vector::{any_tangent, dot, plus, times};
use embate_lanes::{BATCH, Level};

/// The nodes that rotate. Lists have an entry for each of them, in the order of [`Rotations::nodes`].
#[derive(Clone, Debug, Default)]
pub(crate) struct NodalRotations {
    /// Rotations R^n, and spins ω^{n+½} from the update on, ω^{n−½} before.
    pub(crate) now: Rotations,
    /// R^{n+1} as [`Rotations::numbers_at`] gives it, from the update on; of rigid bodies anything.
    next: Vec<[f64; 4]>,
    /// ω^{n−½}, rad/s.
    pub(crate) spins_old: Vec<[f64; 3]>,
    /// Moment of inertia about any axis, kg m (kg m²).
    pub(crate) inertia: Vec<f64>,
    /// Moments of the elements, by the slots of the blocks.
    pub(crate) slots: Vec<[f64; 3]>,
    assembly: Assembly,
    /// Rigid body of each; `u32::MAX`: none.
    bodies: Vec<u32>,
    /// Those that no body leads and that are held or joined.
    groups: Vec<Group>,
    /// Moments of loads on them, and their sum now, N (N m); empty without.
    loads: Vec<MomentLoad>,
    now_loads: Vec<[f64; 3]>,
    /// Moments of contact forces in the coming update, N (N m); empty without.
    contact: Vec<[f64; 3]>,
    /// Group of each; [`ALONE`]: nothing holds or joins it; `u32::MAX`: a body leads it.
    group_of: Vec<u32>,
    /// Which eights of places are alone, and the places that are so in others.
    free: Vec<bool>,
    lone: Vec<u32>,
}

/// Stands for the group of a place that is in none.
const ALONE: u32 = u32::MAX - 1;

/// A moment that acts on nodes.
#[derive(Clone, Debug)]
struct MomentLoad {
    /// Their places.
    places: Vec<usize>,
    /// On each of them, N (N m).
    moment: [f64; 3],
    factor: Factor,
    /// Its value now.
    factor_now: f64,
    /// Place of the load in the model.
    index: usize,
}

/// Nodes that rotate as one, or one that is held.
#[derive(Clone, Debug)]
struct Group {
    /// Place of each, and its rotation from the first one, which leads.
    members: Vec<(usize, Square<3>)>,
    /// Moment of inertia of all together.
    inertia: f64,
    /// What is held of any, seen from the leader; `None`: nothing.
    held: Option<NodeConstraint<3>>,
}

impl Persist for NodalRotations {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self {
            now,
            next: _,
            spins_old,
            inertia: _,
            slots: _,
            assembly: _,
            bodies: _,
            groups: _,
            loads: _,
            now_loads: _,
            contact: _,
            group_of: _,
            free: _,
            lone: _,
        } = self;
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

impl Group {
    /// Σ R_iᵀ of what each member has, seen from the leader.
    fn sum(&self, of: impl Fn(usize) -> [f64; 3]) -> [f64; 3] {
        self.members.iter().fold([0.0; 3], |sum, &(place, turn)| plus(sum, back(turn, of(place))))
    }

    /// Gives all members the spin of the leader.
    fn lead(&self, spin: [f64; 3], spins: &mut [[f64; 3]]) {
        self.members.iter().for_each(|&(place, turn)| spins[place] = turned(turn, spin));
    }
}

impl NodalRotations {
    /// Of blocks; `spin` says how fast the elements of a block spin at the start, rad/s: a node of several
    /// blocks has the mean by inertia. `constraints` say what is held: by symmetry planes, and by prescribed
    /// spins.
    pub(super) fn new<const D: usize>(
        blocks: &[Box<dyn Block<D>>],
        spin: impl Fn(usize) -> [f64; 3],
        constraints: &Constraints<D>,
        joins: &Joins<D>,
        bodies: &mut Bodies<D>,
    ) -> Self
    where
        Dim<D>: Dimension<D>,
    {
        let shares: Vec<(usize, u32, f64)> = (0..)
            .zip(blocks)
            .flat_map(|(k, block)| block.rotating_nodes().into_iter().map(move |(node, share)| (k, node, share)))
            .collect();
        if shares.is_empty() {
            return Self::default();
        }
        let mut now = Rotations::at_rest(shares.iter().map(|&(_, node, _)| node), D);
        let count = now.nodes.len();
        let mut inertia = vec![0.0; count];
        for &(block, node, share) in &shares {
            let Some(place) = now.place(node) else { continue };
            inertia[place] += share;
            now.spins[place] = plus(now.spins[place], times(share, spin(block)));
        }
        now.spins.iter_mut().zip(&inertia).for_each(|(spin, inertia)| *spin = spin.map(|momentum| momentum / inertia));
        let place = |node: u32| now.place(node).map_or(NO_NODE, |place| place as u32);
        let places: Vec<Vec<u32>> = blocks.iter().map(|block| block.moment_slots().iter().map(|&node| place(node)).collect()).collect();
        let assembly = Assembly::new(count, &places.iter().map(|places| &places[..]).collect::<Vec<_>>());
        let of_bodies: Vec<u32> = now.nodes.iter().map(|&node| bodies.of_node(node).map_or(u32::MAX, |body| body as u32)).collect();
        for (&body, &inertia) in of_bodies.iter().zip(&inertia).filter(|(body, _)| **body != u32::MAX) {
            bodies.add_inertia(body as usize, inertia);
        }
        let mut rotations = Self {
            next: vec![[0.0; 4]; count],
            spins_old: now.spins.clone(),
            slots: vec![[0.0; 3]; assembly.count],
            now,
            inertia,
            assembly,
            bodies: of_bodies,
            ..Self::default()
        };
        rotations.hold(constraints, joins);
        rotations
    }

    /// Finds what is held, by symmetry planes and prescribed spins, and what is joined.
    pub(super) fn hold<const D: usize>(&mut self, constraints: &Constraints<D>, joins: &Joins<D>)
    where
        Dim<D>: Dimension<D>,
    {
        let Self { now, inertia, bodies, .. } = &*self;
        let count = now.nodes.len();
        let alone = now.nodes.iter().zip(bodies).filter(|&(&node, &body)| body == u32::MAX && joins.of_node(node).is_none());
        let alone = alone.map(|(&node, _)| vec![(node, unit_matrix())]);
        let joined = joins.groups().iter().map(|group| group.members.iter().map(|member| (member.node, square(&member.turn))).collect());
        let group = |members: Vec<(u32, Square<3>)>| {
            let members: Vec<(usize, Square<3>)> = members.into_iter().filter_map(|(node, turn)| Some((now.place(node)?, turn))).collect();
            // Seen from the first of them: the leader of a join may have no rotation.
            let back_to_first = transposed(&members.first()?.1);
            let members: Vec<(usize, Square<3>)> =
                members.into_iter().map(|(place, turn)| (place, product(&turn, &back_to_first))).collect();
            let mut held = NodeConstraint::default();
            for (place, turn) in &members {
                let node = now.nodes[*place];
                // Contradictions are faults of the model.
                for (source, normal) in constraints.mirrors_at(node) {
                    held_by(normal).into_iter().for_each(|direction| held.rest(back(*turn, direction), source));
                }
                for (axis, speed, source) in constraints.spins_of(node) {
                    held.prescribe(back(*turn, axis), speed, source);
                }
            }
            let whole = members.iter().map(|&(place, _)| inertia[place]).sum();
            Some(Group { members, inertia: whole, held: Some(held).filter(|held| !held.is_empty()) })
        };
        let groups: Vec<Group> =
            alone.chain(joined).filter_map(group).filter(|group| group.held.is_some() || group.members.len() > 1).collect();
        let mut group_of: Vec<u32> = bodies.iter().map(|&body| if body == u32::MAX { ALONE } else { u32::MAX }).collect();
        for (number, group) in (0..).zip(&groups) {
            group.members.iter().for_each(|&(place, _)| group_of[place] = number);
        }
        let is_alone = |place: usize| group_of[place] == ALONE;
        let free = Eights::new(count, is_alone, |_| false).free;
        let lone =
            (0..count).filter(|&place| is_alone(place) && free.get(place / BATCH) != Some(&true)).map(|place| place as u32).collect();
        (self.groups, self.group_of, self.free, self.lone) = (groups, group_of, free, lone);
    }

    /// Lets the moments of a model's loads act: of each its place in the model, its nodes, the whole of it
    /// (N, N m) and its factor.
    pub(super) fn load<'a>(&mut self, loads: impl Iterator<Item = (usize, Vec<u32>, [f64; 3], Factor)> + 'a) {
        for (index, nodes, moment, factor) in loads {
            let places: Vec<usize> = nodes.iter().filter_map(|&node| self.now.place(node)).collect();
            let moment = times(1.0 / places.len().max(1) as f64, moment);
            self.loads.push(MomentLoad { places, moment, factor, factor_now: 1.0, index });
        }
        self.now_loads = vec![[0.0; 3]; if self.loads.is_empty() { 0 } else { self.inertia.len() }];
    }

    /// Whether moments of loads act, or rotations are held.
    pub(crate) fn is_acted_on(&self) -> bool {
        self.has_loads() || self.groups.iter().any(|group| group.held.is_some())
    }

    /// Whether moments of loads act.
    pub(super) fn has_loads(&self) -> bool {
        !self.loads.is_empty()
    }

    /// Leaves nodes without elements alone.
    pub(super) fn renew_loads(&mut self, has_elements: impl Fn(u32) -> bool) {
        let nodes = &self.now.nodes;
        self.loads.iter_mut().for_each(|load| load.places.retain(|&place| has_elements(nodes[place])));
    }

    /// Moments of loads now, to add to.
    pub(super) fn loads_now(&mut self) -> &mut [[f64; 3]] {
        self.now_loads.resize(self.inertia.len(), [0.0; 3]);
        &mut self.now_loads
    }

    /// Moments of contact forces, of which there are none yet.
    pub(super) fn contact_now(&mut self) -> &mut [[f64; 3]] {
        self.contact.clear();
        self.contact.resize(self.inertia.len(), [0.0; 3]);
        &mut self.contact
    }

    /// The place that rotates in the stead of one: the first of its group.
    pub(super) fn leader(&self, place: usize) -> usize {
        self.groups.get(self.group_of[place] as usize).map_or(place, |group| group.members[0].0)
    }

    /// ω^{n−½}, ω^{n+½} without contact, and its change per moment of contact, of the first place of a group;
    /// Δt is `mean_step`, a of damping `slowing` at a node.
    pub(super) fn response(&self, place: usize, mean_step: f64, slowing: impl Fn(usize) -> f64) -> ([[f64; 3]; 2], Square<3>) {
        let (spin, spins, wanted) = (self.now.spins[place], &self.now.spins, [false, true]);
        let pull = match self.group_of[place] {
            u32::MAX => return ([spin; 2], [[0.0; 3]; 3]),
            ALONE => self.pull_alone(place, spins, wanted, slowing),
            group => self.pull(&self.groups[group as usize], spins, wanted, slowing),
        };
        ([spin, pull.free_velocity(mean_step)], pull.mobility_over(mean_step))
    }

    /// What pulls on a place that is in no group, as [`NodalRotations::pull`].
    fn pull_alone(
        &self,
        place: usize,
        spins: &[[f64; 3]],
        [with_contact, with_loads]: [bool; 2],
        slowing: impl Fn(usize) -> f64,
    ) -> Pull<'_, 3> {
        let of = |list: &[[f64; 3]], wanted: bool| if wanted { list.get(place).copied() } else { None };
        let moment = self.assembly.force(place, &self.slots);
        let pulls = [Some(moment), of(&self.contact, with_contact), of(&self.now_loads, with_loads)];
        Pull::<3>::of_elements(self.inertia[place], spins[place], pulls, slowing(self.now.nodes[place] as usize), None)
    }

    /// What pulls on a group that has these spins: of contact and loads as wanted.
    fn pull<'a>(
        &'a self,
        group: &'a Group,
        spins: &[[f64; 3]],
        [with_contact, with_loads]: [bool; 2],
        slowing: impl Fn(usize) -> f64,
    ) -> Pull<'a, 3> {
        let of = |list: &[[f64; 3]], wanted: bool| (wanted && !list.is_empty()).then(|| group.sum(|place| list[place]));
        let moment = group.sum(|place| self.assembly.force(place, &self.slots));
        let slowed = |&(place, _): &(usize, Square<3>)| self.inertia[place] * slowing(self.now.nodes[place] as usize);
        let slowing = group.members.iter().map(slowed).sum::<f64>() / group.inertia;
        let pulls = [Some(moment), of(&self.contact, with_contact), of(&self.now_loads, with_loads)];
        Pull::<3>::of_elements(group.inertia, spins[group.members[0].0], pulls, slowing, group.held.as_ref())
    }

    /// Takes what acts in the coming update, between two times (s), and what prescribes spins between `step`.
    pub(super) fn prepare(&mut self, curves: &Curves, update: [f64; 2], step: [f64; 2]) {
        self.groups.iter_mut().filter_map(|group| group.held.as_mut()).for_each(|held| held.drive(curves, step));
        self.now_loads.fill([0.0; 3]);
        for load in &mut self.loads {
            load.factor_now = curves.factor(load.factor, update);
            for &place in &load.places {
                self.now_loads[place] = plus(self.now_loads[place], times(load.factor_now, load.moment));
            }
        }
    }

    /// Hands over the reactions of held places: the node, what holds it, and the moment of that in the last
    /// update of `mean_step` (s), N (N m).
    pub(super) fn reactions(&self, mean_step: f64, damping: &Damping, mut see: impl FnMut(u32, &NodeConstraint<3>, [f64; 3])) {
        for group in &self.groups {
            let Some(held) = &group.held else { continue };
            let pull = self.pull(group, &self.spins_old, [true, true], |node| damping.factor(node));
            let first = group.members[0].0;
            see(self.now.nodes[first], held, pull.reaction(mean_step, self.now.spins[first]));
        }
    }

    /// Moments of loads now, each with the load's place in the model, N (N m).
    pub(crate) fn load_moments(&self) -> impl Iterator<Item = (usize, [f64; 3])> {
        self.loads.iter().map(|load| (load.index, times(load.factor_now * load.places.len() as f64, load.moment)))
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

    /// Prescribes what is prescribed at the start.
    pub(super) fn start<const D: usize>(&mut self, bodies: &Bodies<D>)
    where
        Dim<D>: Dimension<D>,
    {
        for group in &self.groups {
            let mean = group.sum(|place| times(self.inertia[place] / group.inertia, self.now.spins[place]));
            group.lead(group.held.as_ref().map_or(mean, |held| held.apply(mean)), &mut self.now.spins);
        }
        self.follow(bodies);
        self.spins_old.clone_from(&self.now.spins);
    }

    /// ½ Σ I|ω|² of those that no body leads, J/m.
    pub(super) fn kinetic(&self) -> f64 {
        let energy = |place: usize| 0.5 * self.inertia[place] * dot(self.now.spins[place], self.now.spins[place]);
        reductions::sum((0..self.inertia.len()).filter(|&place| self.bodies[place] == u32::MAX).map(energy))
    }

    /// The part of a moment on a node about which it is free to rotate.
    pub(super) fn free_part(&self, node: u32, moment: [f64; 3]) -> [f64; 3] {
        let group = self.now.place(node).and_then(|place| self.groups.get(self.group_of[place] as usize));
        group.and_then(|group| group.held.as_ref()).map_or(moment, |held| held.free_part(moment))
    }

    /// Takes the spins away, for [`NodalRotations::launch`].
    pub(super) fn hold_back(&mut self) -> Vec<[f64; 3]> {
        let spins = std::mem::take(&mut self.now.spins);
        self.now.spins = vec![[0.0; 3]; spins.len()];
        self.spins_old.clone_from(&self.now.spins);
        spins
    }

    /// Adds these spins between two steps, rad/s.
    pub(super) fn launch(&mut self, spins: &[[f64; 3]]) {
        self.now.spins.iter_mut().zip(spins).for_each(|(spin, own)| *spin = plus(*spin, *own));
    }

    /// R^{n+1}.
    pub(super) fn advance<const D: usize>(&mut self, bodies: &Bodies<D>)
    where
        Dim<D>: Dimension<D>,
    {
        self.now.angles.iter_mut().zip(&self.next).for_each(|(angle, next)| *angle = next[0]);
        self.now.attitudes.iter_mut().zip(&self.next).for_each(|(attitude, next)| *attitude = Attitude(*next));
        for (place, &body) in self.bodies.iter().enumerate().filter(|(_, body)| **body != u32::MAX) {
            let (angle, attitude) = <Dim<D>>::orientation(&bodies.state(body as usize).angle);
            self.now.angles.get_mut(place).into_iter().for_each(|own| *own = angle);
            self.now.attitudes.get_mut(place).into_iter().for_each(|own| *own = attitude);
        }
    }

    /// ω^{n+½}, and the part of it in the ledger; Δt is `mean_step`. Spins of rigid bodies are known already.
    /// R^{n+1} after `time_step` follows at once.
    pub(super) fn accelerate<const D: usize>(
        &mut self,
        [mean_step, time_step]: [f64; 2],
        damping: &Damping,
        bodies: &Bodies<D>,
        level: Level,
    ) -> Sums
    where
        Dim<D>: Dimension<D>,
    {
        std::mem::swap(&mut self.now.spins, &mut self.spins_old);
        let mut spins = std::mem::take(&mut self.now.spins);
        let mut sums = level.run(lanes::Accelerate { rotations: self, dt: mean_step, damping, spins: &mut spins });
        for place in self.lone.iter().map(|&place| place as usize) {
            let pull = self.pull_alone(place, &self.spins_old, [true, true], |node| damping.factor(node));
            spins[place] = pull.advance(mean_step, &mut sums);
        }
        for group in &self.groups {
            let pull = self.pull(group, &self.spins_old, [true, true], |node| damping.factor(node));
            group.lead(pull.advance(mean_step, &mut sums), &mut spins);
        }
        self.now.spins = spins;
        self.follow(bodies);
        self.foresee(time_step, level);
        // Spins are no speeds.
        Sums { speed_squared: 0.0, ..sums }
    }

    /// R^{n+1} after a step (s), of known spins.
    pub(super) fn foresee(&mut self, time_step: f64, level: Level) {
        let Rotations { angles, attitudes, spins, .. } = &self.now;
        // In 2D the angle is an exact sum.
        for ((next, angle), spin) in self.next.iter_mut().zip(angles).zip(spins) {
            next[0] = angle + time_step * spin[2];
        }
        level.run(lanes::Rotate { attitudes, spins, time_step, next: &mut self.next });
    }

    /// See the field.
    pub(super) fn next(&self) -> &[[f64; 4]] {
        &self.next
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

/// Directions about which a node of a symmetry plane can't rotate: those in the plane. In 2D all planes are
/// normal to the plane of the model.
fn held_by<const D: usize>(normal: [f64; D]) -> [[f64; 3]; 2] {
    let n: [f64; 3] = in_3d(normal);
    let first = any_tangent(n);
    [first, cross(n, first)]
}

impl<const D: usize> System<D>
where
    Dim<D>: Dimension<D>,
{
    /// Finds the nodes that rotate; `spin` says how fast the elements of a block spin at the start, rad/s.
    pub(crate) fn find_rotations(&mut self, spin: impl Fn(usize) -> [f64; 3]) {
        self.rotations = NodalRotations::new(&self.blocks, spin, &self.constraints, &self.joins, &mut self.bodies);
    }
}

impl<const D: usize> System<D>
where
    Dim<D>: Dimension<D>,
{
    /// Lets the moments of the model act on the nodes that rotate.
    pub(crate) fn load_rotations(&mut self, model: &Model) {
        let of = |(index, load): (usize, &Load)| match load {
            Load::Moment { on, moment, .. } => Some((index, self.mesh.nodes(on)?, *moment, self.curves.factor_on(index, load))),
            _ => None,
        };
        self.rotations.load(model.loads.iter().enumerate().filter_map(of));
    }
}

#[cfg(all(test, feature = "whole-runs"))]
mod tests;
