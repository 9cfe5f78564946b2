//! Which ridges of two surfaces, or of one, are near each other: by the global search, of the ends of edges
//! against edges.
//!
//! Of two edges the shorter one has an end that is no farther than half of its length from where they are
//! nearest. So edges are searched for by classes of their lengths, those of a class against all that are no
//! shorter.

use super::{Around, SLACK};
use crate::contact::projection::edge_edge::distance;
use crate::contact::projection::node_facet::Placed;
use crate::contact::search::{Pair, Query, Search};
use crate::mesh::surface::SpaceSurface;
use crate::rows::Rows;
use crate::vector::{length, minus};

/// Class of an edge that is no ridge.
const NO_RIDGE: u64 = u64::MAX;

/// The edges of a surface in the search.
struct Ridges {
    lengths: Vec<f64>,
    /// Of lengths that differ by less than a factor of two; [`NO_RIDGE`]: not searched for.
    classes: Vec<u64>,
}

impl Ridges {
    /// The ridges of a surface, with those edges that may become some until the next search: an edge that a
    /// blow folds would be found when it is inside already.
    fn of(surface: &SpaceSurface, positions: &[[f64; 3]]) -> Self {
        let placed = Placed { surface, positions };
        let length_of = |edge: u32| {
            let [a, b] = placed.edge(edge);
            length(minus(b, a))
        };
        let lengths: Vec<f64> = (0..surface.edges.len() as u32).map(length_of).collect();
        let class = |(edge, &length): (u32, &f64)| {
            let is_ridge = length.is_finite() && placed.ridge(edge).is_some_and(|ridge| ridge.may_be_sharp());
            if is_ridge { length.to_bits() >> 52 } else { NO_RIDGE }
        };
        let classes = (0..).zip(&lengths).map(class).collect();
        Self { lengths, classes }
    }

    /// Those of a class.
    fn of_class(&self, class: u64) -> impl Iterator<Item = usize> + Clone {
        (0..self.classes.len()).filter(move |&edge| self.classes[edge] == class)
    }
}

/// A pair as a number, in the order of pairs.
fn packed([a, b]: [u32; 2]) -> u64 {
    u64::from(a) << 32 | u64::from(b)
}

/// All pairs of ridges of the surfaces `sides` that are nearer than the radius, or go farther than the skin
/// in this step, ascending; of one surface each with the lower number first. `at_nodes`: edges at each node
/// of each surface; `found` is room.
pub(super) fn near(
    around: &Around<'_>,
    sides: [usize; 2],
    at_nodes: &[Rows<u32>],
    search: &mut dyn Search<3>,
    found: &mut Vec<Pair>,
) -> Vec<[u32; 2]> {
    let &Around { surfaces, sweep, radius, skin, .. } = around;
    let is_one = sides[0] == sides[1];
    let ridges = sides.map(|side| Ridges::of(&surfaces[side], sweep.new));
    let mut classes: Vec<u64> = ridges.iter().flat_map(|ridges| &ridges.classes).copied().filter(|&class| class != NO_RIDGE).collect();
    classes.sort_unstable();
    classes.dedup();
    let mut near: Vec<u64> = Vec::new();
    for (class, of) in classes.iter().flat_map(|&class| (0..if is_one { 1 } else { 2 }).map(move |of| (class, of))) {
        let (own, others) = (&ridges[of], &ridges[1 - of]);
        let (slave, target) = (&surfaces[sides[of]], &surfaces[sides[1 - of]]);
        let longest = own.of_class(class).map(|edge| own.lengths[edge]).fold(0.0, f64::max);
        let mut slaves: Vec<u32> = own.of_class(class).flat_map(|edge| slave.edges[edge].nodes).collect();
        slaves.sort_unstable();
        slaves.dedup();
        // Those of the same class meet once.
        let counts = |&edge: &usize| {
            let other = others.classes[edge];
            other != NO_RIDGE && (other > class || (other == class && of == 0))
        };
        let targets: Vec<u32> = (0..others.classes.len()).filter(counts).map(|edge| edge as u32).collect();
        let facets: Vec<[u32; 3]> = targets.iter().map(|&edge| target.edges[edge as usize].nodes).map(|[a, b]| [a, b, b]).collect();
        if slaves.is_empty() || facets.is_empty() {
            continue;
        }
        let ranks: Vec<usize> = slaves.iter().map(|node| slave.nodes.binary_search(node).unwrap_or(usize::MAX)).collect();
        let reach = SLACK * (radius + 0.5 * longest);
        let query = Query { positions_old: sweep.old, positions_new: sweep.new, slaves: &slaves, facets: &facets, reach };
        search.by_and_by(&query, found, &mut |found| {
            for pair in found {
                let (rank, other) = (ranks[pair.slave as usize], targets[pair.facet as usize]);
                if rank == usize::MAX {
                    continue;
                }
                for &edge in at_nodes[sides[of]].of(rank).iter().filter(|&&edge| own.classes[edge as usize] == class) {
                    let swaps = if is_one { edge > other } else { of == 1 };
                    near.push(packed(if swaps { [other, edge] } else { [edge, other] }));
                }
            }
        });
    }
    near.sort_unstable();
    near.dedup();
    let way = |node: u32| length(minus(sweep.new[node as usize], sweep.old[node as usize]));
    // A node of two surfaces joins them.
    let is_joined = |node: &u32, other: usize| !is_one && surfaces[sides[other]].nodes.binary_search(node).is_ok();
    let placed = |edge: [u32; 2]| edge.map(|node| sweep.new[node as usize]);
    let is_near = |edges: [u32; 2]| {
        let [a, b] = [0, 1].map(|of| surfaces[sides[of]].edges[edges[of] as usize].nodes);
        !surfaces[sides[0]].are_kin(&a, &b)
            && !a.iter().any(|node| is_joined(node, 1))
            && !b.iter().any(|node| is_joined(node, 0))
            && (distance(placed(a), placed(b)) <= radius || [a, b].iter().flatten().any(|&node| way(node) > skin))
    };
    near.into_iter().map(|pair| [(pair >> 32) as u32, pair as u32]).filter(|&edges| is_near(edges)).collect()
}
