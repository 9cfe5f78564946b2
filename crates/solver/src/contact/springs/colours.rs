//! Which springs of a large island make a cluster, and which clusters are relaxed at the same time.
//!
//! Nodes of surfaces are numbered along a curve, so the springs whose lowest node is among the same [`NODES`]
//! are those at a patch of the surface, in all passes: what they move is theirs but for the rim. Clusters
//! that move nothing in common may have one colour; colours are given greedily, by ascending patch. Both
//! follow from the nodes of the springs alone.

use super::islands::NONE;
use std::ops::Range;

/// Nodes of a patch.
const NODES: u32 = 1024;
/// Most springs of a cluster: patches with more of them are several.
const MOST: usize = 1024;
/// Colours that are kept apart by bits; a cluster that finds none free has one for itself.
const COLOURS: u32 = u64::BITS;

/// The clusters of one island, colour by colour.
#[derive(Default)]
pub(super) struct Colouring {
    /// Where each cluster ends among the springs of the island.
    pub(super) ends: Vec<u32>,
    /// Where the clusters of each colour end.
    pub(super) colours: Vec<u32>,
    /// Patch of each spring and where each patch ends; springs and ends of clusters while they are sorted.
    patches: Vec<u32>,
    counts: Vec<u32>,
    sorted: Vec<u32>,
    sorted_ends: Vec<u32>,
    /// Colour of each cluster, and the clusters in the order of these.
    colour_of: Vec<u32>,
    order: Vec<u32>,
    /// Colours of the clusters that move each shared place.
    taken: Vec<u64>,
}

/// Places that several clusters move, for all islands.
#[derive(Default)]
pub(super) struct Shared {
    /// Of each place the first cluster that moves it.
    first: Vec<u32>,
    /// Its number among those of its island that several do; [`NONE`]: at most one does.
    pub(super) number: Vec<u32>,
}

impl Shared {
    /// For so many places, of which nothing is known.
    pub(super) fn clear(&mut self, places: usize) {
        for list in [&mut self.first, &mut self.number] {
            list.clear();
            list.resize(places, NONE);
        }
    }
}

impl Colouring {
    /// Sorts the `springs` of an island cluster by cluster: `moved` says which places a spring moves, `at`
    /// what is at each place.
    pub(super) fn arrange<I: Iterator<Item = u32>>(
        &mut self,
        springs: &mut [u32],
        at: &[u32],
        shared: &mut Shared,
        moved: impl Fn(u32) -> I,
    ) {
        self.sort(springs, |spring| moved(spring).map(|place| at[place as usize]).min().unwrap_or(0) / NODES);
        self.cut();
        let Self { sorted, sorted_ends, taken, colour_of, .. } = self;
        let clusters = || (0..sorted_ends.len()).map(|cluster| &sorted[range(sorted_ends, cluster)]);
        taken.clear();
        for (cluster, springs) in (0..).zip(clusters()) {
            for place in springs.iter().flat_map(|&spring| moved(spring)) {
                let (first, number) = (&mut shared.first[place as usize], &mut shared.number[place as usize]);
                if *first == NONE {
                    *first = cluster;
                } else if *first != cluster && *number == NONE {
                    *number = taken.len() as u32;
                    taken.push(0);
                }
            }
        }
        colour_of.clear();
        let mut alone = COLOURS;
        for springs in clusters() {
            let numbers = || {
                let places = springs.iter().flat_map(|&spring| moved(spring));
                places.map(|place| shared.number[place as usize]).filter(|&number| number != NONE)
            };
            let mut colour = (!numbers().fold(0, |mine, number| mine | taken[number as usize])).trailing_zeros();
            if colour == COLOURS {
                (colour, alone) = (alone, alone + 1);
            } else {
                numbers().for_each(|number| taken[number as usize] |= 1 << colour);
            }
            colour_of.push(colour);
        }
        self.lay_down(springs);
    }

    /// How many places several clusters move.
    pub(super) fn shared(&self) -> usize {
        self.taken.len()
    }

    /// Springs of a cluster among those of the island.
    pub(super) fn cluster(&self, cluster: usize) -> Range<usize> {
        range(&self.ends, cluster)
    }

    /// Sorts the springs by patch; each keeps the order that it has.
    fn sort(&mut self, springs: &[u32], patch: impl Fn(u32) -> u32) {
        let Self { patches, counts, sorted, .. } = self;
        patches.clear();
        patches.extend(springs.iter().map(|&spring| patch(spring)));
        counts.clear();
        counts.resize(patches.iter().max().map_or(0, |&last| last as usize + 1), 0);
        patches.iter().for_each(|&patch| counts[patch as usize] += 1);
        // Beginnings, then ends while the springs are laid down.
        let mut sum = 0;
        counts.iter_mut().for_each(|count| (*count, sum) = (sum, sum + *count));
        sorted.clear();
        sorted.resize(springs.len(), 0);
        for (&spring, &patch) in springs.iter().zip(&*patches) {
            let at = &mut counts[patch as usize];
            sorted[*at as usize] = spring;
            *at += 1;
        }
    }

    /// Cuts the springs of each patch in clusters as long as each other.
    fn cut(&mut self) {
        let Self { counts, sorted_ends, .. } = self;
        sorted_ends.clear();
        let mut begin = 0;
        for &end in &*counts {
            let (length, pieces) = ((end - begin) as usize, ((end - begin) as usize).div_ceil(MOST));
            sorted_ends.extend((1..=pieces).map(|piece| begin + (length * piece / pieces) as u32));
            begin = end;
        }
    }

    /// Lays the springs down cluster by cluster, colour by colour.
    fn lay_down(&mut self, springs: &mut [u32]) {
        let Self { ends, colours, sorted, sorted_ends, colour_of, order, .. } = self;
        order.clear();
        order.extend(0..colour_of.len() as u32);
        order.sort_unstable_by_key(|&cluster| (colour_of[cluster as usize], cluster));
        ends.clear();
        colours.clear();
        let mut begin = 0;
        for (index, &cluster) in order.iter().enumerate() {
            let own = &sorted[range(sorted_ends, cluster as usize)];
            springs[begin..begin + own.len()].copy_from_slice(own);
            begin += own.len();
            ends.push(begin as u32);
            let is_last = order.get(index + 1).is_none_or(|&next| colour_of[next as usize] != colour_of[cluster as usize]);
            if is_last {
                colours.push(index as u32 + 1);
            }
        }
    }
}

/// From the end before to that of number `k`.
fn range(ends: &[u32], k: usize) -> Range<usize> {
    let begin = if k == 0 { 0 } else { ends[k - 1] as usize };
    begin..ends[k] as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::collections::BTreeSet;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(crate::random::long::samples(200)))]
        #[test]
        fn every_spring_is_in_one_cluster_of_its_patch_and_no_colour_moves_anything_twice(
            ends in prop::collection::vec(prop::collection::btree_set(0u32..3000, 0..6), 1..1500),
            hub in prop::bool::weighted(0.3),
        ) {
            // Places are nodes in another order; a hub is at every spring.
            let at: Vec<u32> = (0..3000).map(|place| (place * 7) % 3000).collect();
            let ends: Vec<BTreeSet<u32>> = ends.into_iter().map(|mut ends| { if hub { ends.insert(2999); } ends }).collect();
            let moved = |spring: u32| ends[spring as usize].iter().copied();
            let patch = |spring: u32| moved(spring).map(|place| at[place as usize]).min().unwrap_or(0) / NODES;
            let (mut colouring, mut shared) = (Colouring::default(), Shared::default());
            for _ in 0..2 {
                let mut springs: Vec<u32> = (0..ends.len() as u32).collect();
                shared.clear(3000);
                colouring.arrange(&mut springs, &at, &mut shared, moved);
                prop_assert_eq!(springs.iter().copied().collect::<BTreeSet<u32>>().len(), ends.len());
                let mut begin = 0;
                for &end in &colouring.colours {
                    let mut seen = BTreeSet::new();
                    for cluster in begin..end as usize {
                        let own = &springs[colouring.cluster(cluster)];
                        prop_assert!(!own.is_empty() && own.len() <= MOST);
                        prop_assert!(own.iter().all(|&spring| patch(spring) == patch(own[0])));
                        prop_assert!(own.windows(2).all(|two| two[0] < two[1]));
                        let places: BTreeSet<u32> = own.iter().flat_map(|&spring| moved(spring)).collect();
                        prop_assert!(places.iter().all(|&place| seen.insert(place)), "a colour moves a place twice");
                    }
                    begin = end as usize;
                }
                prop_assert_eq!(begin, colouring.ends.len());
                for place in 0..3000u32 {
                    let movers = (0..begin).filter(|&cluster| springs[colouring.cluster(cluster)].iter().any(|&spring| ends[spring as usize].contains(&place)));
                    prop_assert_eq!(movers.count() > 1, shared.number[place as usize] != NONE);
                }
            }
        }
    }
}
