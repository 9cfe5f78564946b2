//! What nodes of one surface and facets of another one make groups of: candidates of a slave node, body by
//! body.
//!
//! Pairs come from the global search; groups go to the tracker of the nodes ([`super::tracker`]) and to the
//! check of missed contacts ([`super::super::missed_contacts`]), which keep what they know of each.

use super::super::Origins;
use super::super::projection::node_facet::Vector;
use super::super::search::{Pair, Query, Search};
use crate::archive::{Archive, ArchiveResult, Persist, persist_each};
use crate::mesh::surface::{Corners, SpaceSurface};
use crate::vector::{length, minus};
use std::collections::BTreeMap;
use std::iter::Peekable;
use std::ops::Range;

/// Those who meet: slave nodes, the target, and whether both are of one surface.
#[derive(Clone, Copy)]
pub(in crate::contact) struct Meeting<'a> {
    pub(in crate::contact) slaves: &'a [u32],
    pub(in crate::contact) target: &'a SpaceSurface,
    pub(in crate::contact) is_one: bool,
}

impl Meeting<'_> {
    /// The facets that a `search` finds near each slave node and each body, for `take`: [index of the slave,
    /// node, body], and each facet with what `counts` says of it (slave node, facet; nothing: it does not
    /// count). Slaves, bodies and facets ascend. `body` is that of a node; facets of the `query` are halves
    /// ([`halves`]); `pairs` is room.
    pub(in crate::contact) fn each<T: Copy>(
        &self,
        search: &mut dyn Search<3>,
        query: &Query<'_, 3>,
        pairs: &mut Vec<Pair>,
        body: impl Fn(u32) -> u32,
        counts: impl Fn(u32, u32) -> Option<T>,
        mut take: impl FnMut([u32; 3], &mut dyn Iterator<Item = (u32, T)>),
    ) {
        let Self { slaves, target, is_one } = *self;
        let mut near: Vec<(u32, u32)> = Vec::new();
        let mut kept: Vec<(u32, u32, T)> = Vec::new();
        let mut look_around = |of_slave: &[Pair]| {
            let slave = of_slave[0].slave;
            let node = slaves[slave as usize];
            // A node of two surfaces joins them: it can't go in.
            if !is_one && target.nodes.binary_search(&node).is_ok() {
                return;
            }
            near.clear();
            near.extend(of_slave.iter().map(|pair| pair.facet / 2).map(|facet| (body(target.facets[facet as usize][0]), facet)));
            near.sort_unstable();
            near.dedup();
            kept.clear();
            let others = near.iter().filter(|&&(_, facet)| !target.are_kin(&[node], &target.facets[facet as usize]));
            kept.extend(others.filter_map(|&(body, facet)| counts(node, facet).map(|known| (body, facet, known))));
            for of_body in kept.chunk_by(|a, b| a.0 == b.0) {
                take([slave, node, of_body[0].0], &mut of_body.iter().map(|&(_, facet, known)| (facet, known)));
            }
        };
        search.by_and_by(query, pairs, &mut |pairs| pairs.chunk_by(|a, b| a.slave == b.slave).for_each(&mut look_around));
    }
}

/// A slave node and a body of the target, and what is known of the two.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::contact) struct Group<T> {
    /// Index of the node in its surface.
    pub(in crate::contact) slave: u32,
    pub(in crate::contact) node: u32,
    pub(in crate::contact) body: u32,
    /// Its candidates are those of its pass from `begin` to `end`.
    pub(in crate::contact) begin: u32,
    pub(in crate::contact) end: u32,
    /// Whether it is the node's own body.
    pub(in crate::contact) own: bool,
    pub(in crate::contact) known: T,
}

impl<T: Persist> Persist for Group<T> {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { slave, node, body, begin, end, own, known } = self;
        persist_each!(archive; slave, node, body, begin, end, own, known);
        Ok(())
    }
}

impl<T: Copy> Group<T> {
    /// By which groups of a pass ascend: slave and body.
    pub(in crate::contact) fn key(&self) -> (u32, u32) {
        (self.slave, self.body)
    }

    /// Where its candidates are among those of its pass.
    pub(in crate::contact) fn candidates(&self) -> Range<usize> {
        self.begin as usize..self.end as usize
    }

    /// Whether its node is one of the `slaves`, and its candidates are among so many.
    pub(in crate::contact) fn is_there(&self, slaves: &[u32], candidates: usize) -> bool {
        slaves.get(self.slave as usize) == Some(&self.node) && self.begin <= self.end && self.end as usize <= candidates
    }

    /// Those of other `slaves` that are the same nodes, without candidates, in their order.
    pub(in crate::contact) fn moved<'g>(groups: impl Iterator<Item = &'g Self>, slaves: &[u32]) -> Vec<Self>
    where
        T: 'g,
    {
        let same = |group: &Self| Some(Self { slave: slaves.binary_search(&group.node).ok()? as u32, begin: 0, end: 0, ..*group });
        let mut moved: Vec<Self> = groups.filter_map(same).collect();
        moved.sort_by_key(Self::key);
        moved
    }

    /// Those of other `slaves` that lie between the nodes of these, without candidates, in their order. Their
    /// `bodies` have other numbers; `mix` makes what is known of one of what is known of those nodes, each
    /// with its share.
    pub(in crate::contact) fn carried<'g>(
        groups: impl Iterator<Item = &'g Self>,
        (slaves, bodies): (&[u32], &BTreeMap<u32, u32>),
        origins: &Origins<'_, 3>,
        mix: impl Fn(&[(f64, &'g Self)]) -> T,
    ) -> Vec<Self>
    where
        T: 'g,
    {
        let mut of_nodes: BTreeMap<u32, Vec<&'g Self>> = BTreeMap::new();
        groups.for_each(|group| of_nodes.entry(group.node).or_default().push(group));
        let mut carried = Vec::new();
        for (slave, &node) in (0..).zip(slaves) {
            let mut near: Vec<(f64, &Self)> = Vec::new();
            for &(from, share) in &origins.nodes[node as usize] {
                near.extend(of_nodes.get(&from).into_iter().flatten().map(|&group| (share, group)));
            }
            near.sort_by_key(|(_, group)| group.body);
            for of_body in near.chunk_by(|a, b| a.1.body == b.1.body) {
                let Some(&body) = bodies.get(&of_body[0].1.body) else { continue };
                carried.push(Self { slave, node, body, begin: 0, end: 0, own: of_body[0].1.own, known: mix(of_body) });
            }
        }
        carried.sort_by_key(Self::key);
        carried
    }

    /// What ascending groups know of this slave and body, after all before them have been passed.
    pub(in crate::contact) fn known_of<'g>(groups: &mut Peekable<impl Iterator<Item = &'g Self>>, key: (u32, u32)) -> Option<T>
    where
        T: 'g,
    {
        while groups.next_if(|group| group.key() < key).is_some() {}
        groups.next_if(|group| group.key() == key).map(|group| group.known)
    }
}

/// Bodies of nodes of the model as far as surfaces go: their nodes come before all others.
pub(in crate::contact) fn bodies_of(surfaces: &[SpaceSurface], bodies: &[u32]) -> Vec<u32> {
    let count = surfaces.iter().filter_map(|surface| surface.nodes.last()).map(|&last| last as usize + 1).max().unwrap_or(0);
    bodies[..count.min(bodies.len())].to_vec()
}

/// The number that each of the `old` bodies of nodes has among the `new` ones; obstacles keep theirs.
pub(in crate::contact) fn renumbered(old: &[u32], new: &[u32], origins: &Origins<'_, 3>) -> BTreeMap<u32, u32> {
    let of = |(from, &body): (&Vec<(u32, f64)>, &u32)| Some((*old.get(from.first()?.0 as usize)?, body));
    origins.nodes.iter().zip(new).filter_map(of).chain([(u32::MAX, u32::MAX)]).collect()
}

/// The one of some with shares that has the largest; of equal ones the first.
pub(in crate::contact) fn nearest<'a, T>(all: &[(f64, &'a T)]) -> Option<&'a T> {
    all.iter().copied().reduce(|most, own| if own.0 > most.0 { own } else { most }).map(|(_, own)| own)
}

/// Two triangles of a facet; of one with three nodes twice itself.
pub(in crate::contact) fn halves(&[a, b, c, d]: &[u32; 4]) -> [[u32; 3]; 2] {
    [[a, b, c], if c == d { [a, b, c] } else { [c, d, a] }]
}

/// Mean length of the edges of surfaces, m.
pub(in crate::contact) fn mean_edge(surfaces: &[SpaceSurface], positions: &[Vector]) -> f64 {
    let (mut sum, mut count) = (0.0, 0usize);
    for edge in surfaces.iter().flat_map(|surface| &surface.edges) {
        let [a, b] = edge.nodes.map(|node| positions[node as usize]);
        (sum, count) = (sum + length(minus(b, a)), count + 1);
    }
    sum / count.max(1) as f64
}

/// How far the middle of a facet is from that of its diagonal at most, m: by so much it may be outside the
/// boxes of its halves.
pub(in crate::contact) fn bend(surface: &SpaceSurface, positions: &[Vector]) -> f64 {
    let of = |facet: &[u32; 4]| {
        if facet.corners().len() == 3 {
            return 0.0;
        }
        let [a, b, c, d] = facet.map(|node| positions[node as usize]);
        0.25 * length([0, 1, 2].map(|k| a[k] + c[k] - b[k] - d[k]))
    };
    surface.facets.iter().map(of).fold(0.0, f64::max)
}
