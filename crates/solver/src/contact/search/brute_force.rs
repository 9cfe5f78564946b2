//! Every slave with every facet: the reference that misses nothing.

use super::{Pair, Query, Search, SearchKind};

pub(super) fn kind<const D: usize>() -> SearchKind<D> {
    SearchKind {
        name: "brute_force",
        doc: "every slave node with every facet but its own; slaves x facets pairs, for checks on small models",
        source: "Bittencourt and Creus 1995, search without filter",
        make: || Box::new(BruteForce),
    }
}

/// No filter at all; positions are not even looked at.
struct BruteForce;

impl<const D: usize> Search<D> for BruteForce {
    fn pairs(&mut self, query: &Query<'_, D>, pairs: &mut Vec<Pair>) {
        pairs.clear();
        for (node, slave) in query.slaves.iter().zip(0..) {
            let others = query.facets.iter().zip(0..).filter(|(nodes, _)| !nodes.contains(node));
            pairs.extend(others.map(|(_, facet)| Pair { slave, facet }));
        }
    }
}
