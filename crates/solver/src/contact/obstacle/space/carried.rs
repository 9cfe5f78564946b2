//! What an obstacle in 3D knows of points whose surface has changed: nodes moved along it, or elements gone.

use super::{ContactHistory, NodeSolid};
use crate::contact::Origins;
use crate::contact::initial::pressing;
use crate::contact::slaves::Slave;
use crate::vector::{plus, times};
use std::collections::BTreeMap;

/// What points know, and the gaps of their springs, m, by the points' keys.
type Known = BTreeMap<([u32; 4], [u64; 4]), (ContactHistory, f64)>;

impl NodeSolid {
    /// Continues where `old` ended, after nodes have moved along its surface.
    pub(super) fn continue_from(&mut self, old: &Self, origins: &Origins<'_, 3>) {
        (self.has_begun, self.is_new) = (old.has_begun, true);
        self.behind.inherit(&old.behind);
        let facets = old.known(old.nodes);
        for index in 0..self.points.len() {
            (self.memories[index], self.gaps[index]) = self.carried(index, old, &facets, origins);
        }
    }

    /// What the points from the one with this number know, by their keys.
    pub(super) fn known(&self, from: usize) -> Known {
        let of = |index: usize| (self.points[index].key(), (self.memories[index], self.gaps[index]));
        (from..self.points.len()).map(of).collect()
    }

    /// What a point knows whose surface has moved along itself: a node as the old ones that it lies between,
    /// by their shares; what is on a facet as it did before (`facets`), if that is divided as before.
    fn carried(&self, index: usize, old: &Self, facets: &Known, origins: &Origins<'_, 3>) -> (ContactHistory, f64) {
        let point = &self.points[index];
        if let Some(known) = facets.get(&point.key()) {
            return *known;
        }
        let place = |node: u32| old.points[..old.nodes].binary_search_by_key(&node, |point| point.nodes[0]).ok();
        let near = || {
            let of = |(node, share): (u32, f64)| origins.nodes[node as usize].iter().map(move |&(from, part)| (from, share * part));
            point.ends().flat_map(of).filter_map(|(node, share)| Some((place(node)?, share)))
        };
        let (mut memory, mut gap, mut by_area, mut most) = (ContactHistory::default(), 0.0, 0.0, 0.0);
        for (at, share) in near() {
            let (own, Slave { stiffness, area, .. }) = (&old.memories[at], old.points[at].slave);
            memory.slip = plus(memory.slip, times(share, own.slip));
            // As the nearest of them.
            if share > most {
                (most, memory.presses) = (share, own.presses);
            }
            gap += share * old.gaps[at];
            by_area += share * stiffness / area;
        }
        let Slave { stiffness, area, .. } = point.slave;
        (memory, pressing(gap, [by_area, stiffness / area]))
    }
}
