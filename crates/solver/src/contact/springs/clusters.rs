//! A large island, cluster by cluster: springs that follow each other in the list are a [`Block`], and blocks
//! that move nothing in common have one colour and are relaxed at the same time.
//!
//! Colours are given greedily, by ascending number of the cluster. A sweep goes through the colours in turn;
//! a block keeps the velocities of its nodes, and hands on those that other blocks move as well when its
//! colour is done. Nothing depends on who relaxes which block, or when.

use super::block::{Block, Part};
use super::islands::NONE;
use super::link::{Joints, Laws};
use super::relax::Effort;
use super::sweep::{MOST, MOST_IN_SPACE, Relax, Settle};
use super::{NodeResponses, Solved, TangentSpace};
use crate::tensor::Dim;
use embate_lanes::{Level, Room};
use rayon::prelude::*;

/// Springs of a cluster.
pub(super) const CLUSTER: usize = 256;
/// Colours that are kept apart by bits; a cluster that finds none free has one for itself.
const COLOURS: u32 = u64::BITS;

/// The clusters of one island.
#[derive(Default)]
pub(super) struct Clusters<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    /// By colour.
    blocks: Vec<Block<D>>,
    /// Cluster of each block, and block of each cluster.
    order: Vec<u32>,
    block_of: Vec<u32>,
    /// Where the blocks of each colour end.
    colours: Vec<u32>,
    colour_of: Vec<u32>,
    /// Of each place the first cluster that moves it, and its number among those that several do.
    first: Vec<u32>,
    number: Vec<u32>,
    /// Colours of the clusters that move each of these.
    taken: Vec<u64>,
    /// What they know of these.
    rooms: Vec<Room>,
    /// Memory for each task that fills blocks.
    scratch: Vec<Vec<u32>>,
}

/// An island, and how to solve it.
pub(super) struct Problem<'a, M: NodeResponses<D>, const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    pub(super) joints: &'a Joints<'a, M, D>,
    /// Numbers of its springs.
    pub(super) springs: &'a [u32],
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

    /// Springs of a cluster.
    fn cluster(&self, cluster: usize) -> &[u32] {
        let begin = cluster * CLUSTER;
        &self.springs[begin..self.springs.len().min(begin + CLUSTER)]
    }

    /// Places that a cluster moves, as often as it does.
    fn places(&self, cluster: usize) -> impl Iterator<Item = u32> {
        let ends = self.cluster(cluster).iter().flat_map(|&number| self.joints.laws.list[number as usize].ends());
        ends.map(|k| self.joints.places[k]).filter(|&place| self.joints.slots[place as usize] != NONE)
    }
}

impl<const D: usize> Clusters<D>
where
    Dim<D>: TangentSpace<D>,
{
    /// Takes the springs of an island that is not that of the step before.
    pub(super) fn arrange<M: NodeResponses<D> + Sync>(&mut self, problem: &Problem<'_, M, D>) {
        let count = problem.springs.len().div_ceil(CLUSTER);
        self.find_shared(problem, count);
        self.colour(problem, count);
        self.blocks.resize_with(count, Block::default);
        self.scratch.resize_with(self.scratch.len().max(problem.tasks), Vec::new);
        let Self { blocks, order, number, scratch, .. } = self;
        let arrange = |blocks: &mut [Block<D>], order: &[u32], scratch: &mut Vec<u32>| {
            scratch.resize(problem.joints.at.len(), NONE);
            for (block, &cluster) in blocks.iter_mut().zip(order) {
                let springs = problem.cluster(cluster as usize);
                block.arrange(problem.joints, springs, std::iter::once(springs.len() as u32), scratch);
                block.share(|place| number[place as usize]);
            }
        };
        if problem.tasks > 1 {
            let length = count.div_ceil(problem.tasks);
            let parts = blocks.par_chunks_mut(length).zip(order.par_chunks(length)).zip(scratch);
            parts.for_each(|((blocks, order), scratch)| arrange(blocks, order, scratch));
        } else {
            arrange(blocks, order, &mut scratch[0]);
        }
    }

    /// Finds the forces; `None`: the island is one for [`super::relax`].
    pub(super) fn solve<M: NodeResponses<D> + Sync>(&mut self, problem: &Problem<'_, M, D>, solved: &mut [Solved<D>]) -> Option<Effort> {
        problem.each(&mut self.blocks, |block| block.load(problem.joints));
        if self.blocks.iter().any(|block| block.parts[0].is_general) {
            return None;
        }
        self.rooms.clear();
        self.rooms.resize(self.taken.len(), Room::default());
        self.blocks.iter().for_each(|block| block.hand_on(&mut self.rooms));
        let mut all = Part::default();
        while !all.is_done {
            (all.change, all.largest) = self.sweep(problem);
            all.close_sweep(if D == 3 { MOST_IN_SPACE } else { MOST });
        }
        if all.is_general {
            return None;
        }
        self.settle(problem, solved);
        Some(Effort { sweeps: all.sweeps as usize, unsolved: false })
    }

    /// What several clusters move.
    fn find_shared<M: NodeResponses<D> + Sync>(&mut self, problem: &Problem<'_, M, D>, count: usize) {
        let Self { first, number, taken, .. } = self;
        first.clear();
        first.resize(problem.joints.at.len(), NONE);
        number.clear();
        number.resize(problem.joints.at.len(), NONE);
        taken.clear();
        for cluster in 0..count {
            for place in problem.places(cluster) {
                let (first, number) = (&mut first[place as usize], &mut number[place as usize]);
                if *first == NONE {
                    *first = cluster as u32;
                } else if *first != cluster as u32 && *number == NONE {
                    *number = taken.len() as u32;
                    taken.push(0);
                }
            }
        }
    }

    /// Colours, and the blocks in their order.
    fn colour<M: NodeResponses<D> + Sync>(&mut self, problem: &Problem<'_, M, D>, count: usize) {
        let Self { number, taken, colour_of, colours, order, block_of, .. } = self;
        let shared = |cluster| problem.places(cluster).map(|place| number[place as usize]).filter(|&number| number != NONE);
        colour_of.clear();
        let mut alone = COLOURS;
        for cluster in 0..count {
            let mine = shared(cluster).fold(0, |mine, number| mine | taken[number as usize]);
            let mut colour = (!mine).trailing_zeros();
            if colour == COLOURS {
                (colour, alone) = (alone, alone + 1);
            } else {
                shared(cluster).for_each(|number| taken[number as usize] |= 1 << colour);
            }
            colour_of.push(colour);
        }
        order.clear();
        order.extend(0..count as u32);
        order.sort_unstable_by_key(|&cluster| (colour_of[cluster as usize], cluster));
        block_of.clear();
        block_of.resize(count, 0);
        colours.clear();
        for (block, &cluster) in order.iter().enumerate() {
            block_of[cluster as usize] = block as u32;
            let is_last = order.get(block + 1).is_none_or(|&next| colour_of[next as usize] != colour_of[cluster as usize]);
            if is_last {
                colours.push(block as u32 + 1);
            }
        }
    }

    /// A sweep over all springs: the largest change and the largest force, N/m.
    fn sweep<M: NodeResponses<D> + Sync>(&mut self, problem: &Problem<'_, M, D>) -> (f64, f64) {
        let Self { blocks, colours, rooms, .. } = self;
        let (laws, level) = (problem.joints.laws, problem.joints.update.level);
        let mut begin = 0;
        for &end in &*colours {
            let blocks = &mut blocks[begin..end as usize];
            if problem.tasks > 1 && blocks.len() > 1 {
                let known = &rooms[..];
                blocks.par_iter_mut().for_each(|block| {
                    block.take_over(known);
                    relax(block, laws, level);
                });
                blocks.iter().for_each(|block| block.hand_on(rooms));
            } else {
                for block in blocks {
                    block.take_over(rooms);
                    relax(block, laws, level);
                    block.hand_on(rooms);
                }
            }
            begin = end as usize;
        }
        blocks.iter().fold((0.0, 0.0), |(change, largest), block| {
            (f64::max(change, block.parts[0].change), f64::max(largest, block.parts[0].largest))
        })
    }

    /// Reports what was found.
    fn settle<M: NodeResponses<D> + Sync>(&mut self, problem: &Problem<'_, M, D>, solved: &mut [Solved<D>]) {
        let Self { blocks, block_of, rooms, .. } = self;
        problem.each(blocks, |block| {
            block.take_over(rooms);
            settle(block, problem.joints.laws, problem.joints.update.level);
        });
        let blocks = &blocks[..];
        let report = |(cluster, solved): (usize, &mut [Solved<D>])| solved.copy_from_slice(&blocks[block_of[cluster] as usize].found);
        if problem.tasks > 1 {
            solved.par_chunks_mut(CLUSTER).enumerate().for_each(report);
        } else {
            solved.chunks_mut(CLUSTER).enumerate().for_each(report);
        }
    }
}

/// A sweep over a block.
pub(super) fn relax<const D: usize>(block: &mut Block<D>, laws: Laws<'_, D>, level: Level)
where
    Dim<D>: TangentSpace<D>,
{
    if block.slides() { level.run(Relax::<true, D> { block, laws }) } else { level.run(Relax::<false, D> { block, laws }) }
}

/// Reports the springs of a block.
pub(super) fn settle<const D: usize>(block: &mut Block<D>, laws: Laws<'_, D>, level: Level)
where
    Dim<D>: TangentSpace<D>,
{
    if block.slides() { level.run(Settle::<true, D> { block, laws }) } else { level.run(Settle::<false, D> { block, laws }) }
}
