//! One box per facet, compared with every slave node: the paper's method (b).

use super::extent::{Extent, Margin};
use super::{Pair, Query, Search, SearchKind};

pub(super) fn kind<const D: usize>() -> SearchKind<D> {
    SearchKind {
        name: "boxes",
        doc: "per facet the box of its old and new nodes plus the reach, compared with every slave node's path; slaves x facets comparisons",
        source: "Bittencourt and Creus 1995, global search (b)",
        make: || Box::new(Boxes { facets: Vec::new() }),
    }
}

/// Storage kept between calls.
struct Boxes<const D: usize> {
    facets: Vec<(Extent<D>, u32)>,
}

impl<const D: usize> Search<D> for Boxes<D> {
    fn pairs(&mut self, query: &Query<'_, D>, pairs: &mut Vec<Pair>) {
        pairs.clear();
        let margin = Margin::new(query.reach);
        self.facets.clear();
        let extents = query.facets.iter().zip(0..).filter_map(|(nodes, facet)| Some((Extent::of_facet(query, nodes, margin)?, facet)));
        self.facets.extend(extents);
        for (&node, slave) in query.slaves.iter().zip(0..) {
            let Some(path) = Extent::of_path(query, node) else { continue };
            let near = self.facets.iter().filter(|(extent, facet)| extent.meets(&path) && !query.facets[*facet as usize].contains(&node));
            pairs.extend(near.map(|&(_, facet)| Pair { slave, facet }));
        }
    }
}
