//! The solution of a step: what the springs act on, islands, and forces.
//!
//! Springs come from the contacts, the state of the step from [`crate::step`]; what was found stays until the
//! next one. Within a pool of threads the islands are shared among them. The sweeps over an island are made
//! by one thread, in its own order; the rows and couplings of its springs, each for itself, by all where the
//! island is large. So results do not depend on the number of threads.

use super::islands::{Islands, NONE};
use super::link::{Bench, Joints, Movable};
use super::newton::Newton;
use super::relax::{Effort, Island};
use super::{NodeResponses, Solved, Springs, Update};
use crate::contact::springs::TangentSpace;
use crate::tensor::Dim;

/// Springs (at least) of the islands that one task solves.
const CHUNK: usize = 256;
/// Fewer springs are solved by one thread.
const SERIAL: usize = 4 * CHUNK;

/// Memory of the solution; nothing of it is known from step to step but what was found.
#[derive(Default)]
pub(super) struct Workspace<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    /// Place of each node (then of each rigid body) in `at`; `NONE`: not touched.
    place: Vec<u32>,
    /// Node or rigid body of each place.
    at: Vec<u32>,
    /// Place of each end.
    places: Vec<u32>,
    /// Slot of each place in its island; `NONE`: it does not move.
    slots: Vec<u32>,
    islands: Islands,
    /// Where each task's islands end.
    chunks: Vec<u32>,
    /// What was found, island by island.
    pub(super) solved: Vec<Solved<D>>,
    /// Where each spring is among them.
    pub(super) rank: Vec<u32>,
    desks: Vec<Desk<D>>,
}

/// What a task works with, and what it reports.
#[derive(Default)]
struct Desk<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    bench: Bench<D>,
    newton: Newton<D>,
    live: Vec<u32>,
    effort: Effort,
}

/// A place that moves, until it has a slot.
const MOVES: u32 = NONE - 1;

impl<const D: usize> Workspace<D>
where
    Dim<D>: TangentSpace<D>,
{
    pub(super) fn new(places: usize) -> Self {
        Self { place: vec![NONE; places], ..Self::default() }
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
        self.gather(update);
        let ends = |spring: usize| self.list[spring].ends();
        let Workspace { islands, places, slots, at, .. } = &mut self.work;
        islands.find(self.list.len(), ends, places, at.len(), |place| slots[place as usize] != NONE);
        self.number_slots();
        self.solve_islands(update);
        for &at in &self.work.at {
            self.work.place[at as usize] = NONE;
        }
    }

    /// The nodes and bodies at the springs.
    fn gather<M: NodeResponses<D>>(&mut self, update: &Update<'_, M, D>) {
        let nodes = update.nodes.count();
        let Workspace { place, at: all, places, slots, .. } = &mut self.work;
        all.clear();
        places.clear();
        slots.clear();
        for k in 0..self.ends.len() as usize {
            let mut at = self.ends.at(k);
            if let Some(body) = update.bodies.of_node(at) {
                self.ends.set_point(k, update.positions[at as usize]);
                at = (nodes + body) as u32;
            } else if (at as usize) < nodes {
                let (leader, image) = update.nodes.leader(at);
                at = leader;
                if let Some(image) = image {
                    self.ends.set_image(k, image);
                }
            }
            let place = &mut place[at as usize];
            if *place == NONE {
                *place = all.len() as u32;
                all.push(at);
                slots.push(if Movable::moves(at, nodes, update) { MOVES } else { NONE });
            }
            places.push(*place);
        }
    }

    /// Slots of what moves, island by island in the order of the springs, and which islands make a task.
    fn number_slots(&mut self) {
        let Workspace { places, slots, islands, chunks, rank, .. } = &mut self.work;
        rank.clear();
        rank.resize(self.list.len(), 0);
        chunks.clear();
        let (mut links, mut begun) = (0, 0);
        for (island, &end) in islands.ends.iter().enumerate() {
            let mut count = 0;
            for link in links..end as usize {
                let spring = islands.order[link] as usize;
                rank[spring] = link as u32;
                for &place in &places[self.list[spring].ends()] {
                    if slots[place as usize] == MOVES {
                        slots[place as usize] = count;
                        count += 1;
                    }
                }
            }
            links = end as usize;
            if links - begun >= CHUNK || links == self.list.len() {
                chunks.push(island as u32 + 1);
                begun = links;
            }
        }
    }

    /// The forces of all islands.
    fn solve_islands<M: NodeResponses<D> + Sync>(&mut self, update: &Update<'_, M, D>) {
        let parallel = self.list.len() >= SERIAL && rayon::current_thread_index().is_some();
        let Workspace { at, places, slots, islands, chunks, solved, desks, .. } = &mut self.work;
        solved.resize(self.list.len(), Solved::default());
        let count = if parallel { chunks.len() } else { 1 };
        if desks.len() < count {
            desks.resize_with(count, Desk::default);
        }
        desks.iter_mut().for_each(|desk| desk.effort = Effort::default());
        let (terms, terms_of) = (&self.terms[..], &self.terms_of[..]);
        let joints = Joints { list: &self.list, ended: &self.ended, ends: &self.ends, places, at, slots, update, terms, terms_of };
        let plan = Plan { joints, islands, chunks };
        if parallel {
            plan.solve(0..chunks.len(), solved, &mut desks[..count]);
        } else {
            (0..chunks.len()).fold(&mut solved[..], |solved, chunk| {
                let (own, rest) = solved.split_at_mut(plan.links(chunk..chunk + 1));
                plan.solve_chunk(chunk, own, &mut desks[0]);
                rest
            });
        }
        let mut effort = Effort::default();
        desks.iter().for_each(|desk| effort.join(desk.effort));
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
    islands: &'a Islands,
    chunks: &'a [u32],
}

impl<M: NodeResponses<D> + Sync, const D: usize> Plan<'_, M, D>
where
    Dim<D>: TangentSpace<D>,
{
    /// The first island of a chunk.
    fn begin(&self, chunk: usize) -> usize {
        if chunk == 0 { 0 } else { self.chunks[chunk - 1] as usize }
    }

    /// Springs of the islands before one.
    fn before(&self, island: usize) -> usize {
        if island == 0 { 0 } else { self.islands.ends[island - 1] as usize }
    }

    /// Springs of chunks.
    fn links(&self, chunks: std::ops::Range<usize>) -> usize {
        self.before(self.begin(chunks.end)) - self.before(self.begin(chunks.start))
    }

    /// Solves chunks, halves of them at the same time.
    fn solve(&self, chunks: std::ops::Range<usize>, solved: &mut [Solved<D>], desks: &mut [Desk<D>]) {
        if let ([desk], 1) = (&mut *desks, chunks.len()) {
            return self.solve_chunk(chunks.start, solved, desk);
        }
        let middle = chunks.start + chunks.len() / 2;
        let (low, high) = (chunks.start..middle, middle..chunks.end);
        let (solved, more) = solved.split_at_mut(self.links(low.clone()));
        let (desks, others) = desks.split_at_mut(low.len());
        rayon::join(|| self.solve(low, solved, desks), || self.solve(high, more, others));
    }

    /// Solves the islands of a chunk one after the other.
    fn solve_chunk(&self, chunk: usize, solved: &mut [Solved<D>], desk: &mut Desk<D>) {
        let Desk { bench, newton, live, effort } = desk;
        let base = self.before(self.begin(chunk));
        for island in self.begin(chunk)..self.chunks[chunk] as usize {
            let range = self.before(island)..self.before(island + 1);
            let length = part_length(range.len());
            bench.fill(&self.joints, &self.islands.order[range.clone()], length);
            let Bench { links, arms, slips, slots, couplings, forces, .. } = bench;
            let Joints { list, terms, terms_of, update, .. } = self.joints;
            let time_steps = update.time_steps;
            let mut island = Island { links, arms, slips, slots, couplings, forces, list, terms_of, terms, time_steps };
            effort.join(island.solve(newton, live));
            island.settle(&mut solved[range.start - base..range.end - base], length);
        }
    }
}

/// Links of an island of so many that one task fills: a power of two, which decides no result; no task has
/// more than its thread's share.
fn part_length(links: usize) -> usize {
    let tasks = rayon::current_thread_index().map_or(1, |_| rayon::current_num_threads()).min(links / CHUNK);
    if tasks > 1 { 1 << (links / tasks).ilog2() } else { links.max(1).next_power_of_two() }
}
