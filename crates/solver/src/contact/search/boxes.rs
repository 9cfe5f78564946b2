//! One box per facet, compared with every slave node: the paper's method (b), with boxes that lie along the
//! facets, see `hull`.

use super::extent::Margin;
use super::hull::{Hull, Path};
use super::{Pair, Query, Search, SearchKind};

pub(super) fn kind<const D: usize>() -> SearchKind<D> {
    SearchKind {
        name: "boxes",
        doc: "per facet the box along it that holds its old and new nodes plus the reach, compared with every slave \
            node's path; slaves x facets comparisons",
        source: "Bittencourt and Creus 1995, global search (b)",
        make: || Box::new(Boxes { facets: Vec::new() }),
    }
}

/// Storage kept between calls.
struct Boxes<const D: usize> {
    facets: Vec<(Hull<f64, D>, u32)>,
}

impl<const D: usize> Search<D> for Boxes<D> {
    fn pairs(&mut self, query: &Query<'_, D>, pairs: &mut Vec<Pair>) {
        pairs.clear();
        let margin = Margin::new(query.reach);
        self.facets.clear();
        let hulls = query.facets.iter().zip(0..).filter_map(|(nodes, facet)| Some((Hull::of(query, nodes, margin)?, facet)));
        self.facets.extend(hulls);
        for (&node, slave) in query.slaves.iter().zip(0..) {
            let path = Path::of(query, node);
            let near = self.facets.iter().filter(|(hull, facet)| hull.meets(&path) && !query.facets[*facet as usize].contains(&node));
            pairs.extend(near.map(|&(_, facet)| Pair { slave, facet }));
        }
    }
}
