//! The solution of a step: what the springs act on, islands, and forces.
//!
//! Springs come from the contacts, the state of the step from [`crate::step`]; what was found stays until the
//! next one, and while springs keep their ends what follows from these ([`super::topology`]). Small islands
//! are solved some together ([`super::block`]), large ones cluster by cluster ([`super::clusters`]), those
//! that sweeps do not solve, and small ones with rigid bodies or constraints, one after the other
//! ([`super::relax`]). Within a pool of threads all share the work; results do not depend on their number.

use super::block::Block;
use super::clusters::{Clusters, Problem, relax, settle};
use super::colours::Colouring;
use super::grips::Velocities;
use super::link::{Bench, Joints, Laws};
use super::newton::Newton;
use super::relax::{Effort, Island};
use super::sweep::MOST;
use super::topology::{CHUNK, Topology};
use super::{NodeResponses, Slid, Solved, Springs, Update};
use crate::contact::springs::TangentSpace;
use crate::tensor::Dim;
use std::ops::Range;

/// Fewer springs are solved by one thread.
const SERIAL: usize = 4 * CHUNK;
/// Springs from which on an island is solved cluster by cluster.
const LARGE: usize = 512;

/// Memory of the solution.
#[derive(Default)]
pub(super) struct Workspace<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    pub(super) topology: Topology,
    /// What was found across the surface, island by island.
    pub(super) solved: Vec<Solved>,
    /// And along it, unless nothing acts there.
    pub(super) slid: Vec<Slid<D>>,
    /// Of each chunk.
    tasks: Vec<Task<D>>,
    /// Of each large island.
    large: Vec<Clusters<D>>,
    /// Of each thread.
    desks: Vec<Desk<D>>,
}

/// What is kept of a chunk of small islands, and what its solution took.
#[derive(Default)]
struct Task<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    block: Block<D>,
    effort: Effort,
}

/// What islands are solved with one after the other.
#[derive(Default)]
struct Desk<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    /// Memory for arranging blocks.
    rooms: Vec<u32>,
    bench: Bench<D>,
    newton: Newton<D>,
    live: Vec<u32>,
}

/// What is found of some springs, island by island.
pub(super) struct Results<'a, const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    solved: &'a mut [Solved],
    /// None where nothing acts along the surface.
    slid: &'a mut [Slid<D>],
}

impl<const D: usize> Results<'_, D>
where
    Dim<D>: TangentSpace<D>,
{
    pub(super) fn len(&self) -> usize {
        self.solved.len()
    }

    /// Those of the springs before number `middle`, and the others.
    pub(super) fn split_at(self, middle: usize) -> [Self; 2] {
        let (solved, slid) = (self.solved.split_at_mut(middle), self.slid.split_at_mut(middle.min(self.slid.len())));
        [Results { solved: solved.0, slid: slid.0 }, Results { solved: solved.1, slid: slid.1 }]
    }

    /// Those of some springs.
    fn part(&mut self, range: Range<usize>) -> Results<'_, D> {
        let slid = if self.slid.is_empty() { &mut [] } else { &mut self.slid[range.clone()] };
        Results { solved: &mut self.solved[range], slid }
    }

    /// Enters those of a spring.
    #[inline(always)]
    pub(super) fn set(&mut self, number: usize, solved: Solved, slid: impl FnOnce() -> Slid<D>) {
        self.solved[number] = solved;
        if let Some(entry) = self.slid.get_mut(number) {
            *entry = slid();
        }
    }
}

impl<const D: usize> Workspace<D>
where
    Dim<D>: TangentSpace<D>,
{
    pub(super) fn new(places: usize) -> Self {
        Self { topology: Topology::new(places), ..Self::default() }
    }

    /// So many places more.
    pub(super) fn add_places(&mut self, places: usize) {
        self.topology.add_places(places);
    }

    /// Where a spring is among the solved ones.
    #[inline]
    pub(super) fn rank(&self, spring: usize) -> usize {
        self.topology.rank[spring] as usize
    }
}

impl<const D: usize> Springs<D>
where
    Dim<D>: TangentSpace<D>,
{
    /// Finds the forces of every spring and the rates that they lead to.
    pub fn solve<M: NodeResponses<D> + Sync>(&mut self, update: &Update<'_, M, D>) {
        self.time_steps = update.time_steps;
        if self.list.is_empty() {
            return;
        }
        let Workspace { topology, solved, slid, tasks, large, desks } = &mut self.work;
        let is_new = topology.update((&self.list, &self.terms_of), &mut self.ends, update, LARGE);
        solved.resize(self.list.len(), Solved::default());
        slid.resize(if self.has_tangential { self.list.len() } else { 0 }, Slid::default());
        let mut results = Results { solved, slid };
        let threads = if self.list.len() >= SERIAL { threads() } else { 1 };
        let chunks = topology.chunks.len();
        if tasks.len() < chunks {
            tasks.resize_with(chunks, Task::default);
        }
        if desks.len() < threads {
            desks.resize_with(threads, Desk::default);
        }
        let Topology { places, at, slots, .. } = &*topology;
        let laws =
            Laws { list: &self.list, slips: &self.slips, terms: &self.terms, terms_of: &self.terms_of, time_steps: update.time_steps };
        let joints = Joints { laws, ended: &self.ended, ends: &self.ends, places, at, slots, update };
        let plan = Plan { joints, topology, is_new };
        plan.solve(0..chunks, results.part(0..self.list.len()), &mut tasks[..chunks], &mut desks[..threads]);
        let mut effort = Effort::default();
        for (number, chunk) in (0..chunks).filter(|&chunk| plan.is_large(chunk)).enumerate() {
            if number == large.len() {
                large.push(Clusters::default());
            }
            let own = results.part(topology.links(chunk..chunk + 1));
            effort.join(plan.solve_large((chunk, &topology.colourings[number]), own, &mut large[number], &mut desks[0], threads));
        }
        tasks[..chunks].iter().for_each(|task| effort.join(task.effort));
        self.sweeps_max = self.sweeps_max.max(effort.sweeps);
        self.unsolved += u64::from(effort.unsolved);
    }
}

/// What all tasks see.
struct Plan<'a, M: NodeResponses<D>, const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    joints: Joints<'a, M, D>,
    topology: &'a Topology,
    /// Whether it is not that of the step before.
    is_new: bool,
}

impl<M: NodeResponses<D> + Sync, const D: usize> Plan<'_, M, D>
where
    Dim<D>: TangentSpace<D>,
{
    /// Solves the small islands of chunks: halves of them at the same time, as many as there are desks.
    fn solve(&self, chunks: Range<usize>, results: Results<'_, D>, tasks: &mut [Task<D>], desks: &mut [Desk<D>]) {
        let [desk] = &mut *desks else {
            let middle = chunks.start + chunks.len() / 2;
            let (low, high) = (chunks.start..middle, middle..chunks.end);
            let [results, more] = results.split_at(self.topology.links(low.clone()).len());
            let (tasks, other_tasks) = tasks.split_at_mut(low.len());
            let (desks, other_desks) = desks.split_at_mut(desks.len() / 2);
            rayon::join(|| self.solve(low, results, tasks, desks), || self.solve(high, more, other_tasks, other_desks));
            return;
        };
        chunks.zip(tasks).fold(results, |results, (chunk, task)| {
            let [own, rest] = results.split_at(self.topology.links(chunk..chunk + 1).len());
            task.effort = Effort::default();
            if !self.is_large(chunk) {
                self.solve_chunk(chunk, own, task, desk);
            }
            rest
        });
    }

    /// Whether a chunk is one large island.
    fn is_large(&self, chunk: usize) -> bool {
        self.topology.islands_of(chunk).len() == 1 && self.topology.links(chunk..chunk + 1).len() >= LARGE
    }

    /// Solves the islands of a chunk.
    fn solve_chunk(&self, chunk: usize, mut results: Results<'_, D>, task: &mut Task<D>, desk: &mut Desk<D>) {
        let (springs, Task { block, effort }) = (self.topology.springs_of(chunk), task);
        if self.is_new {
            let islands = self.topology.islands_of(chunk);
            let base = self.topology.before(islands.start);
            desk.rooms.resize(self.joints.at.len(), u32::MAX);
            let ends = islands.map(|island| (self.topology.before(island + 1) - base) as u32);
            block.arrange(&self.joints, springs, ends, (&mut desk.rooms, false));
        }
        block.load(&self.joints, &Velocities::default());
        while block.parts.iter().any(|part| !part.is_done) {
            relax(block, self.joints.laws, self.joints.update.level);
            block.parts.iter_mut().filter(|part| !part.is_done).for_each(|part| part.close_sweep(MOST));
        }
        settle(block, results.part(0..springs.len()), self.joints.laws, self.joints.update.level);
        let mut begin = 0;
        for part in &block.parts {
            let own = begin..part.end as usize;
            begin = own.end;
            if part.is_general {
                effort.join(self.solve_island(&springs[own.clone()], results.part(own), desk));
            } else {
                effort.join(Effort { sweeps: part.sweeps as usize, unsolved: false });
            }
        }
    }

    /// Solves a large island.
    fn solve_large(
        &self,
        (chunk, colouring): (usize, &Colouring),
        mut results: Results<'_, D>,
        clusters: &mut Clusters<D>,
        desk: &mut Desk<D>,
        tasks: usize,
    ) -> Effort {
        let springs = self.topology.springs_of(chunk);
        let problem = Problem { joints: &self.joints, springs, colouring, shared: &self.topology.shared.number, tasks };
        if self.is_new {
            clusters.arrange(&problem);
        }
        let all = 0..springs.len();
        clusters.solve(&problem, results.part(all.clone())).unwrap_or_else(|| self.solve_island(springs, results.part(all), desk))
    }

    /// Solves an island by [`super::relax`].
    fn solve_island(&self, springs: &[u32], results: Results<'_, D>, desk: &mut Desk<D>) -> Effort {
        let Desk { bench, newton, live, .. } = desk;
        let length = part_length(springs.len());
        bench.fill(&self.joints, springs, length);
        let Bench { links, arms, slips, slots, couplings, forces, .. } = bench;
        let mut island = Island { links, arms, slips, slots, couplings, forces, laws: self.joints.laws };
        let effort = island.solve(newton, live);
        island.settle(results, length);
        effort
    }
}

/// Threads of the pool that this runs in; one outside of all pools.
fn threads() -> usize {
    rayon::current_thread_index().map_or(1, |_| rayon::current_num_threads())
}

/// Links of an island of so many that one task fills: a power of two, which decides no result; no task has
/// more than its thread's share.
fn part_length(links: usize) -> usize {
    let tasks = threads().min(links / CHUNK);
    if tasks > 1 { 1 << (links / tasks).ilog2() } else { links.max(1).next_power_of_two() }
}
