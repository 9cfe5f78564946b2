//! Islands: springs that share nodes or rigid bodies that they can move, directly or by way of other springs.
//! Nothing passes between islands, so each is solved for itself.
//!
//! Where the springs' ends lie comes from [`super::link`]; the order goes to [`super::Springs::solve`]. What
//! nothing moves (held nodes, driven bodies) joins nothing. Islands are in the order of their first springs
//! and springs within an island in the order of the list: nothing else decides.

use crate::forest;
use std::ops::Range;

/// Not known.
pub(super) const NONE: u32 = u32::MAX;

/// A list of springs in islands.
#[derive(Default)]
pub(super) struct Islands {
    /// The springs, island by island.
    pub(super) order: Vec<u32>,
    /// Where each island ends in `order`.
    pub(super) ends: Vec<u32>,
    /// Union-find over the places.
    parent: Vec<u32>,
    /// Island of each root.
    island: Vec<u32>,
    /// Island of each spring.
    of: Vec<u32>,
}

impl Islands {
    /// Sorts the `springs`: spring i ends at `ends(i)` of `places`, numbers below `count`, of which those
    /// count that move.
    pub(super) fn find(
        &mut self,
        springs: usize,
        ends: impl Fn(usize) -> Range<usize>,
        places: &[u32],
        count: usize,
        moves: impl Fn(u32) -> bool,
    ) {
        self.parent.clear();
        self.parent.extend(0..count as u32);
        for spring in 0..springs {
            let mut mobile = places[ends(spring)].iter().copied().filter(|&place| moves(place));
            if let Some(one) = mobile.next() {
                let mut root = forest::root(&mut self.parent, one);
                for other in mobile {
                    root = forest::join(&mut self.parent, root, other);
                }
            }
        }
        self.number(springs, |spring| places[ends(spring)].iter().copied().find(|&place| moves(place)));
    }

    /// Numbers the islands and sorts the springs into them; `place` is one at which a spring moves something.
    fn number(&mut self, springs: usize, place: impl Fn(usize) -> Option<u32>) {
        self.island.clear();
        self.island.resize(self.parent.len(), NONE);
        self.of.clear();
        self.ends.clear();
        for spring in 0..springs {
            let known = place(spring).map(|place| forest::root(&mut self.parent, place) as usize);
            let next = self.ends.len() as u32;
            let island = known.map_or(NONE, |root| self.island[root]);
            let island = if island == NONE { next } else { island };
            if island == next {
                self.ends.push(0);
                if let Some(root) = known {
                    self.island[root] = next;
                }
            }
            self.ends[island as usize] += 1;
            self.of.push(island);
        }
        // Counts, then beginnings, then ends while the springs are laid down.
        let mut sum = 0;
        for end in &mut self.ends {
            (*end, sum) = (sum, sum + *end);
        }
        self.order.clear();
        self.order.resize(springs, 0);
        for (spring, &island) in self.of.iter().enumerate() {
            let end = &mut self.ends[island as usize];
            self.order[*end as usize] = spring as u32;
            *end += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Islands by asking every two springs, again and again.
    fn by_brute_force(springs: &[Vec<u32>], moves: &[bool]) -> Vec<Vec<u32>> {
        let mut label: Vec<usize> = (0..springs.len()).collect();
        let mut changed = true;
        while changed {
            changed = false;
            for a in 0..springs.len() {
                for b in 0..springs.len() {
                    let share = springs[a].iter().any(|place| moves[*place as usize] && springs[b].contains(place));
                    if share && label[b] > label[a] {
                        label[b] = label[a];
                        changed = true;
                    }
                }
            }
        }
        let islands = (0..springs.len()).map(|root| (0..springs.len() as u32).filter(|&i| label[i as usize] == root).collect::<Vec<_>>());
        islands.filter(|island| !island.is_empty()).collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(400))]
        #[test]
        fn islands_are_those_of_all_pairs_of_springs(
            springs in prop::collection::vec(prop::collection::vec(0u32..24, 1..4), 0..20),
            moves in prop::collection::vec(prop::bool::weighted(0.7), 24),
        ) {
            let places: Vec<u32> = springs.iter().flatten().copied().collect();
            let mut starts = vec![0];
            for spring in &springs {
                starts.push(starts.last().unwrap() + spring.len());
            }
            let mut islands = Islands::default();
            for _ in 0..2 {
                islands.find(springs.len(), |i| starts[i]..starts[i + 1], &places, 24, |place| moves[place as usize]);
            }
            let mut from = 0;
            let found: Vec<Vec<u32>> = islands.ends.iter().map(|&end| islands.order[std::mem::replace(&mut from, end as usize)..end as usize].to_vec()).collect();
            prop_assert_eq!(found, by_brute_force(&springs, &moves));
        }
    }
}
