//! What springs act on, which of them depend on each other, and which are solved together: all that stays
//! while the springs have the same ends, as in most steps they do.
//!
//! Springs and ends come from the contacts ([`super::Springs`]); islands and chunks of them go to
//! [`super::solve`].

use super::colours::{Colouring, Shared};
use super::ends::Ends;
use super::islands::{Islands, NONE};
use super::link::Movable;
use super::{NodeResponses, Spring, TangentSpace, Update};
use crate::contact::both;
use crate::tensor::Dim;
use std::ops::Range;

/// Springs (at least) of the islands that one task solves.
pub(super) const CHUNK: usize = 256;

/// Fewer places are looked at by one thread.
const SHARED: usize = 16_384;

/// A place that moves, until it has a slot.
const MOVES: u32 = NONE - 1;

/// Ends and islands of a list of springs.
#[derive(Default)]
pub(super) struct Topology {
    /// Terms of each spring.
    terms: Vec<u32>,
    /// Whether it is not that of the springs that there are.
    is_stale: bool,
    /// Ends on rigid bodies, and of nodes that move as others.
    led: Vec<u32>,
    /// Place of each node (then of each rigid body, then of each carrier) in `at`; [`NONE`]: not touched.
    place: Vec<u32>,
    /// Node or rigid body of each place.
    pub(super) at: Vec<u32>,
    /// Place of each end.
    pub(super) places: Vec<u32>,
    /// Slot of each place in its island; [`NONE`]: it does not move.
    pub(super) slots: Vec<u32>,
    pub(super) islands: Islands,
    /// Where each chunk's islands end.
    pub(super) chunks: Vec<u32>,
    /// Where each spring is, island by island.
    pub(super) rank: Vec<u32>,
    /// Clusters of the large islands, and what several of them move.
    pub(super) colourings: Vec<Colouring>,
    pub(super) shared: Shared,
}

impl Topology {
    /// Of springs on so many nodes and rigid bodies.
    pub(super) fn new(places: usize) -> Self {
        Self { place: vec![NONE; places], ..Self::default() }
    }

    /// So many places more.
    pub(super) fn add_places(&mut self, places: usize) {
        self.place.resize(self.place.len() + places, NONE);
    }

    /// Takes the springs of a step; `false`: nothing changed. Islands of `large` springs or more are chunks
    /// of their own.
    pub(super) fn update<M: NodeResponses<D> + Sync, const D: usize>(
        &mut self,
        (list, terms_of): (&[Spring<D>], &[u32]),
        ends: &mut Ends<D>,
        update: &Update<'_, M, D>,
        large: usize,
    ) -> bool
    where
        Dim<D>: TangentSpace<D>,
    {
        if self.is_same(terms_of, ends, update) {
            self.lead(ends, update);
            return false;
        }
        self.is_stale = false;
        self.terms.clear();
        self.terms.extend_from_slice(terms_of);
        self.gather(ends, update);
        self.lead(ends, update);
        let Self { islands, places, slots, at, .. } = self;
        islands.find(list.len(), |spring| list[spring].ends(), places, at.len(), |place| slots[place as usize] != NONE);
        self.number_slots(list, large, update.nodes.count());
        for &at in &self.at {
            self.place[at as usize] = NONE;
        }
        true
    }

    /// Whether springs and ends are those of the step before, and the same nodes and bodies move.
    fn is_same<M: NodeResponses<D> + Sync, const D: usize>(&self, terms_of: &[u32], ends: &Ends<D>, update: &Update<'_, M, D>) -> bool
    where
        Dim<D>: TangentSpace<D>,
    {
        let nodes = update.nodes.count();
        let move_as_before = |of: Range<usize>| {
            let mut places = self.at[of.clone()].iter().zip(&self.slots[of]);
            places.all(|(&at, &slot)| Movable::moves(at, nodes, update) == (slot != NONE))
        };
        !self.is_stale && ends.are_as_before() && self.terms == terms_of && holds_for_all(&move_as_before, 0..self.at.len())
    }

    /// The nodes and bodies at the springs.
    fn gather<M: NodeResponses<D>, const D: usize>(&mut self, ends: &Ends<D>, update: &Update<'_, M, D>)
    where
        Dim<D>: TangentSpace<D>,
    {
        let nodes = update.nodes.count();
        let Self { led, place, at: all, places, slots, .. } = self;
        led.clear();
        all.clear();
        places.clear();
        slots.clear();
        for k in 0..ends.len() {
            let mut at = ends.at(k);
            if let Some(body) = update.bodies.of_node(at) {
                led.push(k as u32);
                at = (nodes + body) as u32;
            } else if let Some(carrier) = Some(at).filter(|at| (*at as usize) < nodes).and_then(|at| update.nodes.carrier(at)) {
                led.push(k as u32);
                at = (nodes + update.bodies.len()) as u32 + carrier;
            } else if (at as usize) < nodes {
                let (leader, image) = update.nodes.leader(at);
                at = leader;
                if image.is_some() {
                    led.push(k as u32);
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

    /// Lets ends on rigid bodies act where they are now, and those of images as their leaders move.
    fn lead<M: NodeResponses<D>, const D: usize>(&self, ends: &mut Ends<D>, update: &Update<'_, M, D>)
    where
        Dim<D>: TangentSpace<D>,
    {
        for k in self.led.iter().map(|&k| k as usize) {
            let at = ends.at(k);
            if update.bodies.of_node(at).is_some() {
                ends.set_point(k, update.positions[at as usize]);
            } else if update.nodes.carrier(at).is_some() {
                ends.set_point(k, update.nodes.carried_point(at));
            } else if let (_, Some(image)) = update.nodes.leader(at) {
                ends.set_image(k, image);
            }
        }
    }

    /// Clusters of the large islands, slots of what moves, island by island in the order of the springs, and
    /// which islands make a chunk.
    fn number_slots<const D: usize>(&mut self, list: &[Spring<D>], large: usize, nodes: usize)
    where
        Dim<D>: TangentSpace<D>,
    {
        let Self { places, slots, islands, chunks, rank, colourings, shared, at, .. } = self;
        shared.clear(at.len());
        let mut number = 0;
        rank.clear();
        rank.resize(list.len(), 0);
        chunks.clear();
        let (mut links, mut begun) = (0, 0);
        for (island, &end) in islands.ends.iter().enumerate() {
            let is_large = end as usize - links >= large;
            if is_large {
                if number == colourings.len() {
                    colourings.push(Colouring::default());
                }
                let moved = |spring: u32| {
                    let all = places[list[spring as usize].ends()].iter().copied();
                    // Clusters do not wait for each other at rigid bodies; see `grips.rs`.
                    all.filter(|&place| slots[place as usize] != NONE && (at[place as usize] as usize) < nodes)
                };
                colourings[number].arrange(&mut islands.order[links..end as usize], at, shared, moved);
                number += 1;
            }
            let mut count = 0;
            for link in links..end as usize {
                let spring = islands.order[link] as usize;
                rank[spring] = link as u32;
                for &place in &places[list[spring].ends()] {
                    if slots[place as usize] == MOVES {
                        slots[place as usize] = count;
                        count += 1;
                    }
                }
            }
            if is_large && links > begun {
                chunks.push(island as u32);
            }
            links = end as usize;
            if is_large || links - begun >= CHUNK || links == list.len() {
                chunks.push(island as u32 + 1);
                begun = links;
            }
        }
    }

    /// Lets so many springs be solved in the order of the list, until the next update.
    pub(super) fn number_in_order(&mut self, springs: usize) {
        self.is_stale = true;
        self.rank.clear();
        self.rank.extend(0..springs as u32);
    }

    /// Springs of the islands before one.
    pub(super) fn before(&self, island: usize) -> usize {
        if island == 0 { 0 } else { self.islands.ends[island - 1] as usize }
    }

    /// The islands of a chunk.
    pub(super) fn islands_of(&self, chunk: usize) -> Range<usize> {
        let begin = if chunk == 0 { 0 } else { self.chunks[chunk - 1] as usize };
        begin..self.chunks[chunk] as usize
    }

    /// Where the springs of chunks are, island by island.
    pub(super) fn links(&self, chunks: Range<usize>) -> Range<usize> {
        if chunks.is_empty() {
            return 0..0;
        }
        self.before(self.islands_of(chunks.start).start)..self.before(self.islands_of(chunks.end - 1).end)
    }

    /// Numbers of the springs of a chunk.
    pub(super) fn springs_of(&self, chunk: usize) -> &[u32] {
        &self.islands.order[self.links(chunk..chunk + 1)]
    }
}

/// Whether something holds for all of a range, halves of it at the same time where threads share the work.
fn holds_for_all(of: &(impl Fn(Range<usize>) -> bool + Sync), range: Range<usize>) -> bool {
    if range.len() <= SHARED {
        return of(range);
    }
    let middle = range.start + range.len() / 2;
    let (low, high) = both(|| holds_for_all(of, range.start..middle), || holds_for_all(of, middle..range.end));
    low && high
}
