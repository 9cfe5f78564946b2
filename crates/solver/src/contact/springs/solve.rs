//! The solution of a step: what the springs act on, islands, forces, and the books.
//!
//! Springs come from the contacts, the state of the step from [`crate::step`]; solved springs stay in the list. Within a pool of threads the movables, the islands and the books are shared
//! among them. An island is solved by one thread, in its own order, so results do not depend on their number.

use super::islands::{Islands, NONE};
use super::link::{Arm, Joints, Link, Movable, Slot};
use super::newton::Newton;
use super::relax::{Effort, Island};
use super::{Movers, Springs, Terms, Update};
use rayon::prelude::*;

/// Springs (at least) of the islands that one task solves.
const CHUNK: usize = 256;
/// Fewer springs are solved by one thread.
const SERIAL: usize = 4 * CHUNK;

/// Memory of the solution; nothing of it is known from step to step.
#[derive(Default)]
pub(super) struct Workspace {
    /// Place of each node (then of each rigid body) in `movables`; `NONE`: not touched.
    place: Vec<u32>,
    movables: Vec<Movable>,
    /// Movable of each end.
    places: Vec<u32>,
    islands: Islands,
    /// Slot of each movable in its island.
    slots_of: Vec<u32>,
    bounds: Vec<Bounds>,
    /// Where each task's islands end.
    chunks: Vec<u32>,
    slots: Vec<Slot>,
    arms: Vec<Arm>,
    slips: Vec<[f64; 3]>,
    pub(super) links: Vec<Link>,
    /// Link of each spring.
    pub(super) rank: Vec<u32>,
    desks: Vec<Desk>,
}

/// What islands up to one take.
#[derive(Clone, Copy, Default)]
struct Bounds {
    links: usize,
    arms: usize,
    slots: usize,
}

/// What a task works with, and what it tells.
#[derive(Default)]
struct Desk {
    newton: Newton,
    live: Vec<u32>,
    effort: Effort,
}

impl Workspace {
    pub(super) fn new(places: usize) -> Self {
        Self { place: vec![NONE; places], ..Self::default() }
    }
}

impl Springs {
    /// Finds the force, work and energy of every spring. `terms` as the groups number them.
    pub fn solve<M: Movers + Sync>(&mut self, update: &Update<'_, M>, terms: &[Terms]) {
        if self.list.is_empty() {
            return;
        }
        let parallel = self.list.len() >= SERIAL && rayon::current_thread_index().is_some();
        self.gather(update, parallel);
        let moves = |place: u32| self.work.movables[place as usize].moves();
        let ends = |spring: usize| self.list[spring].ends();
        self.work.islands.find(self.list.len(), ends, &self.work.places, self.work.movables.len(), moves);
        self.measure();
        self.solve_islands(update.time_steps, terms, parallel);
        self.book(update.time_steps, terms, parallel);
        for movable in &self.work.movables {
            self.work.place[movable.at as usize] = NONE;
        }
    }

    /// The nodes and bodies at the springs.
    fn gather<M: Movers + Sync>(&mut self, update: &Update<'_, M>, parallel: bool) {
        let nodes = update.nodes.count();
        let Workspace { place, movables, places, .. } = &mut self.work;
        movables.clear();
        places.clear();
        for end in &mut self.ends {
            let mut at = end.at;
            if let Some(body) = update.bodies.of_node(at) {
                end.point = update.positions[at as usize];
                at = (nodes + body) as u32;
            } else if (at as usize) < nodes {
                (at, end.image) = update.nodes.leader(at);
            }
            let place = &mut place[at as usize];
            if *place == NONE {
                *place = movables.len() as u32;
                movables.push(Movable::unknown(at));
            }
            places.push(*place);
        }
        let fill = |movable: &mut Movable| *movable = Movable::new(movable.at, nodes, update);
        if parallel {
            movables.par_chunks_mut(CHUNK).for_each(|movables| movables.iter_mut().for_each(fill));
        } else {
            movables.iter_mut().for_each(fill);
        }
    }

    /// How much each island takes, and which of them make a task.
    fn measure(&mut self) {
        let Workspace { movables, places, islands, slots_of, bounds, chunks, rank, .. } = &mut self.work;
        slots_of.clear();
        slots_of.resize(movables.len(), NONE);
        rank.clear();
        rank.resize(self.list.len(), 0);
        bounds.clear();
        chunks.clear();
        let (mut all, mut begun) = (Bounds::default(), 0);
        for (island, &end) in islands.ends.iter().enumerate() {
            let mut slots = 0;
            for link in all.links..end as usize {
                let spring = islands.order[link] as usize;
                rank[spring] = link as u32;
                for &place in &places[self.list[spring].ends()] {
                    if movables[place as usize].moves() {
                        all.arms += 1;
                        if slots_of[place as usize] == NONE {
                            slots_of[place as usize] = slots;
                            slots += 1;
                        }
                    }
                }
            }
            all = Bounds { links: end as usize, slots: all.slots + slots as usize, ..all };
            bounds.push(all);
            if all.links - begun >= CHUNK || all.links == self.list.len() {
                chunks.push(island as u32 + 1);
                begun = all.links;
            }
        }
    }

    /// The forces of all islands.
    fn solve_islands(&mut self, time_steps: [f64; 2], terms: &[Terms], parallel: bool) {
        let Workspace { movables, places, islands, slots_of, bounds, chunks, slots, arms, slips, links, desks, .. } = &mut self.work;
        let all = bounds.last().copied().unwrap_or_default();
        slots.resize(all.slots, Slot::default());
        arms.resize(all.arms, Arm::default());
        slips.resize(all.arms, [0.0; 3]);
        links.resize(all.links, Link::default());
        if desks.len() < chunks.len() {
            desks.resize_with(chunks.len(), Desk::default);
        }
        let joints = Joints { list: &self.list, ends: &self.ends, places, movables, slots: slots_of, time_steps };
        let plan = Plan { joints, order: &islands.order, bounds, chunks, terms, terms_of: &self.terms_of, parallel };
        let desks = &mut desks[..chunks.len()];
        plan.solve(0..chunks.len(), Share { links, arms, slips, slots, desks: &mut *desks });
        let mut effort = Effort::default();
        desks.iter().for_each(|desk| effort.join(desk.effort));
        self.sweeps_max = self.sweeps_max.max(effort.sweeps);
        self.unsolved += u64::from(effort.unsolved);
    }
}

/// What all tasks see.
struct Plan<'a> {
    joints: Joints<'a>,
    order: &'a [u32],
    bounds: &'a [Bounds],
    chunks: &'a [u32],
    terms: &'a [Terms],
    terms_of: &'a [u32],
    parallel: bool,
}

/// What is one task's own.
struct Share<'a> {
    links: &'a mut [Link],
    arms: &'a mut [Arm],
    slips: &'a mut [[f64; 3]],
    slots: &'a mut [Slot],
    desks: &'a mut [Desk],
}

impl<'a> Share<'a> {
    /// In two: the first with so much.
    fn split(self, at: Bounds, desks: usize) -> [Self; 2] {
        let (links, more_links) = self.links.split_at_mut(at.links);
        let (arms, more_arms) = self.arms.split_at_mut(at.arms);
        let (slips, more_slips) = self.slips.split_at_mut(at.arms);
        let (slots, more_slots) = self.slots.split_at_mut(at.slots);
        let (desks, more_desks) = self.desks.split_at_mut(desks);
        let first = Share { links, arms, slips, slots, desks };
        [first, Share { links: more_links, arms: more_arms, slips: more_slips, slots: more_slots, desks: more_desks }]
    }
}

impl Plan<'_> {
    /// What comes before an island.
    fn before(&self, island: usize) -> Bounds {
        if island == 0 { Bounds::default() } else { self.bounds[island - 1] }
    }

    /// The first island of a chunk.
    fn begin(&self, chunk: usize) -> usize {
        if chunk == 0 { 0 } else { self.chunks[chunk - 1] as usize }
    }

    /// Solves chunks, halves of them at the same time.
    fn solve(&self, chunks: std::ops::Range<usize>, share: Share<'_>) {
        if chunks.len() == 1 {
            return self.solve_chunk(chunks.start, share);
        }
        let middle = chunks.start + chunks.len() / 2;
        let at = self.before(self.begin(middle)).less(self.before(self.begin(chunks.start)));
        let [first, second] = share.split(at, middle - chunks.start);
        let (low, high) = (chunks.start..middle, middle..chunks.end);
        if self.parallel {
            rayon::join(|| self.solve(low, first), || self.solve(high, second));
        } else {
            self.solve(low, first);
            self.solve(high, second);
        }
    }

    /// Solves the islands of a chunk one after the other.
    fn solve_chunk(&self, chunk: usize, share: Share<'_>) {
        let Share { links, arms, slips, slots, desks } = share;
        let Some(desk) = desks.first_mut() else { return };
        desk.effort = Effort::default();
        let base = self.before(self.begin(chunk));
        for island in self.begin(chunk)..self.chunks[chunk] as usize {
            let (from, to) = (self.before(island).less(base), self.bounds[island].less(base));
            let (links, arms) = (&mut links[from.links..to.links], &mut arms[from.arms..to.arms]);
            let (slips, slots) = (&mut slips[from.arms..to.arms], &mut slots[from.slots..to.slots]);
            let mut first = 0;
            for (link, &spring) in links.iter_mut().zip(&self.order[self.before(island).links..]) {
                let tangential = self.terms[self.terms_of[spring as usize] as usize].tangential;
                *link = self.joints.link(spring, tangential, first, arms, slips, slots);
                first += link.count;
            }
            let (list, time_steps) = (self.joints.list, self.joints.time_steps);
            let mut island = Island { links, arms, slips, slots, list, terms_of: self.terms_of, terms: self.terms, time_steps };
            desk.effort.join(island.solve(&mut desk.newton, &mut desk.live));
            island.settle();
        }
    }
}

impl Bounds {
    fn less(self, other: Self) -> Self {
        Self { links: self.links - other.links, arms: self.arms - other.arms, slots: self.slots - other.slots }
    }
}
