//! A large island, cluster by cluster: the springs at a patch of the surface are a [`Block`], and blocks that
//! move nothing in common have one colour ([`super::colours`]) and are relaxed at the same time.
//!
//! A sweep goes through the colours in turn; a block keeps the velocities of its nodes, and hands on those
//! that other blocks move as well when its colour is done. Nothing depends on who relaxes which block, or
//! when. Rigid bodies follow after each sweep ([`super::grips`]).

use super::block::{Block, Kind, Part};
use super::colours::Colouring;
use super::grips::{self, Velocities};
use super::islands::NONE;
use super::link::{Joints, Laws};
use super::relax::Effort;
use super::solve::Results;
use super::sweep::{MOST, MOST_IN_SPACE, Relax, Settle};
use super::{NodeResponses, TangentSpace};
use crate::tensor::Dim;
use embate_lanes::{Level, Room};
use rayon::prelude::*;

/// The clusters of one island.
#[derive(Default)]
pub(super) struct Clusters<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    /// In the order of the springs: colour by colour.
    blocks: Vec<Block<D>>,
    /// What they know of the places that several of them move.
    rooms: Vec<Room>,
    /// Rigid bodies that the springs push; too many of them are not for clusters.
    bodies: Velocities<D>,
    /// Memory for each task that fills blocks.
    scratch: Vec<Vec<u32>>,
}

/// An island, and how to solve it.
pub(super) struct Problem<'a, M: NodeResponses<D>, const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    pub(super) joints: &'a Joints<'a, M, D>,
    /// Numbers of its springs, cluster by cluster.
    pub(super) springs: &'a [u32],
    pub(super) colouring: &'a Colouring,
    /// Number of each place among those that several clusters move.
    pub(super) shared: &'a [u32],
    /// Tasks at the same time; decides no result.
    pub(super) tasks: usize,
}

impl<M: NodeResponses<D> + Sync, const D: usize> Problem<'_, M, D>
where
    Dim<D>: TangentSpace<D>,
{
    /// Does the work for each block.
    fn each(&self, blocks: &mut [Block<D>], work: impl Fn(&mut Block<D>) + Send + Sync) {
        if self.tasks > 1 { blocks.par_iter_mut().for_each(work) } else { blocks.iter_mut().for_each(work) }
    }
}

impl<const D: usize> Clusters<D>
where
    Dim<D>: TangentSpace<D>,
{
    /// Takes the springs of an island that is not that of the step before.
    pub(super) fn arrange<M: NodeResponses<D> + Sync>(&mut self, problem: &Problem<'_, M, D>) {
        let Self { blocks, scratch, bodies, .. } = self;
        bodies.find(problem.joints, problem.springs);
        let count = problem.colouring.ends.len();
        blocks.resize_with(count, Block::default);
        scratch.resize_with(scratch.len().max(problem.tasks), Vec::new);
        let arrange = |blocks: &mut [Block<D>], first: usize, scratch: &mut Vec<u32>| {
            scratch.resize(problem.joints.at.len(), NONE);
            for (cluster, block) in (first..).zip(blocks) {
                let springs = &problem.springs[problem.colouring.cluster(cluster)];
                block.arrange(problem.joints, springs, std::iter::once(springs.len() as u32), (scratch, true));
                block.share(|place| problem.shared[place as usize]);
            }
        };
        if problem.tasks > 1 {
            let length = count.div_ceil(problem.tasks);
            let parts = blocks.par_chunks_mut(length).enumerate().zip(scratch);
            parts.for_each(|((part, blocks), scratch)| arrange(blocks, part * length, scratch));
        } else {
            arrange(blocks, 0, &mut scratch[0]);
        }
    }

    /// Finds the forces; `None`: the island is one for [`super::relax`].
    pub(super) fn solve<M: NodeResponses<D> + Sync>(&mut self, problem: &Problem<'_, M, D>, results: Results<'_, D>) -> Option<Effort> {
        if self.bodies.places.len() > grips::MOST {
            return None;
        }
        self.bodies.begin(problem.joints);
        let bodies = &self.bodies;
        problem.each(&mut self.blocks, |block| block.load(problem.joints, bodies));
        if self.blocks.iter().any(|block| block.parts[0].is_general) {
            return None;
        }
        self.rooms.clear();
        self.rooms.resize(problem.colouring.shared(), Room::default());
        self.blocks.iter().for_each(|block| block.hand_on(&mut self.rooms));
        let mut all = Part::default();
        while !all.is_done {
            (all.change, all.largest) = self.sweep(problem);
            self.move_bodies(problem);
            all.close_sweep(if D == 3 { MOST_IN_SPACE } else { MOST });
        }
        if all.is_general {
            return None;
        }
        self.bodies.follow(false);
        report(problem, 0, &mut self.blocks, results, (&self.rooms, &self.bodies.added));
        Some(Effort { sweeps: all.sweeps as usize, unsolved: false })
    }

    /// Lets rigid bodies follow what the springs push with.
    fn move_bodies<M: NodeResponses<D> + Sync>(&mut self, problem: &Problem<'_, M, D>) {
        let freedoms = self.bodies.added.len();
        if freedoms == 0 {
            return;
        }
        problem.each(&mut self.blocks, |block| block.push_bodies(&problem.joints.laws, freedoms));
        let Self { blocks, bodies, .. } = self;
        bodies.pushes.clear(freedoms);
        blocks.iter().for_each(|block| bodies.pushes.add(&block.pushes));
        bodies.follow(true);
    }

    /// A sweep over all springs: the largest change and the largest force, N/m.
    fn sweep<M: NodeResponses<D> + Sync>(&mut self, problem: &Problem<'_, M, D>) -> (f64, f64) {
        let Self { blocks, rooms, bodies, .. } = self;
        let added = &bodies.added[..];
        let (laws, level) = (problem.joints.laws, problem.joints.update.level);
        let mut begin = 0;
        for &end in &problem.colouring.colours {
            let blocks = &mut blocks[begin..end as usize];
            if problem.tasks > 1 && blocks.len() > 1 {
                let known = &rooms[..];
                blocks.par_iter_mut().for_each(|block| relax_with(block, (known, added), laws, level));
                blocks.iter().for_each(|block| block.hand_on(rooms));
            } else {
                for block in blocks {
                    relax_with(block, (rooms, added), laws, level);
                    block.hand_on(rooms);
                }
            }
            begin = end as usize;
        }
        blocks.iter().fold((0.0, 0.0), |(change, largest), block| {
            (f64::max(change, block.parts[0].change), f64::max(largest, block.parts[0].largest))
        })
    }
}

/// Reports what the blocks from number `first` on found, halves of them at the same time.
fn report<M: NodeResponses<D> + Sync, const D: usize>(
    problem: &Problem<'_, M, D>,
    first: usize,
    blocks: &mut [Block<D>],
    results: Results<'_, D>,
    known: (&[Room], &[f64]),
) where
    Dim<D>: TangentSpace<D>,
{
    let Problem { joints, colouring, tasks, .. } = problem;
    if *tasks > 1 && blocks.len() > 1 {
        let middle = blocks.len() / 2;
        let begin = colouring.cluster(first).start;
        let (low, high) = blocks.split_at_mut(middle);
        let [own, others] = results.split_at(colouring.cluster(first + middle).start - begin);
        rayon::join(|| report(problem, first, low, own, known), || report(problem, first + middle, high, others, known));
        return;
    }
    let mut rest = results;
    for (cluster, block) in (first..).zip(blocks) {
        let [own, others] = rest.split_at(colouring.cluster(cluster).len());
        block.take_over(known.0);
        block.lend(known.1);
        settle(block, own, joints.laws, joints.update.level);
        rest = others;
    }
}

/// A sweep over a cluster with what others know and springs have added to rigid bodies; nothing is done where
/// nothing would change, as where all springs are open.
fn relax_with<const D: usize>(block: &mut Block<D>, (known, added): (&[Room], &[f64]), laws: Laws<'_, D>, level: Level)
where
    Dim<D>: TangentSpace<D>,
{
    let is_new = block.take_over(known);
    if is_new || !block.is_still() {
        block.lend(added);
        relax(block, laws, level);
        block.parts[0].sweeps += 1;
    }
}

/// A sweep over a block.
pub(super) fn relax<const D: usize>(block: &mut Block<D>, laws: Laws<'_, D>, level: Level)
where
    Dim<D>: TangentSpace<D>,
{
    match block.kind() {
        Kind::Plain => level.run(Relax::<false, true, D> { block, laws }),
        Kind::Normal => level.run(Relax::<false, false, D> { block, laws }),
        Kind::Sliding => level.run(Relax::<true, false, D> { block, laws }),
    }
}

/// Reports the springs of a block: the results of each, in their order.
pub(super) fn settle<const D: usize>(block: &Block<D>, results: Results<'_, D>, laws: Laws<'_, D>, level: Level)
where
    Dim<D>: TangentSpace<D>,
{
    match block.kind() {
        Kind::Plain => level.run(Settle::<false, true, D> { block, results, laws }),
        Kind::Normal => level.run(Settle::<false, false, D> { block, results, laws }),
        Kind::Sliding => level.run(Settle::<true, false, D> { block, results, laws }),
    }
}
