//! Which springs are solved eight at a time: batches of springs that move nothing in common.
//!
//! Springs come from [`super::block`] in their order, each into the first batch that has a free lane and no
//! spring that shares something with it (greedy colouring). Batches are relaxed one after the other; what is
//! in a batch does not feel the rest of it, so that the width of the lanes decides nothing.

use embate_lanes::BATCH;

/// Batches that are open at the same time.
const WINDOW: u32 = u64::BITS;

/// Batches of the springs of a block.
#[derive(Default)]
pub(super) struct Batches {
    /// Springs in each.
    pub(super) filled: Vec<u8>,
    /// The first batch of the window.
    base: u32,
    /// Which batches of the window have a free lane, from the first one on.
    open: u64,
    /// Of each slot which batches of the window have a spring there, with the base as it was then.
    used: Vec<(u64, u32)>,
}

impl Batches {
    /// None yet.
    pub(super) fn clear(&mut self) {
        self.filled.clear();
        self.used.clear();
        (self.base, self.open) = (0, u64::MAX);
    }

    /// One slot more.
    pub(super) fn add_slot(&mut self) {
        self.used.push((0, 0));
    }

    /// Batch and lane of the next spring, which moves what is in `slots`.
    pub(super) fn place(&mut self, slots: &[u32]) -> (u32, u8) {
        let mut taken = 0;
        for &slot in slots {
            taken |= self.seen(slot);
        }
        while self.open & !taken == 0 {
            self.shift(1);
            taken >>= 1;
        }
        let bit = (self.open & !taken).trailing_zeros();
        for &slot in slots {
            self.used[slot as usize] = (self.seen(slot) | 1 << bit, self.base);
        }
        let batch = self.base + bit;
        if batch as usize >= self.filled.len() {
            self.filled.resize(batch as usize + 1, 0);
        }
        let lane = self.filled[batch as usize];
        self.filled[batch as usize] += 1;
        if usize::from(lane) + 1 == BATCH {
            self.open &= !(1 << bit);
            self.shift(self.open.trailing_zeros());
        }
        (batch, lane)
    }

    /// Which batches of the window have a spring at a slot.
    #[inline]
    fn seen(&self, slot: u32) -> u64 {
        let (used, base) = self.used[slot as usize];
        used.checked_shr(self.base - base).unwrap_or(0)
    }

    /// Closes the first batches of the window.
    fn shift(&mut self, by: u32) {
        if by == 0 {
            return;
        }
        self.base += by;
        self.open = if by >= WINDOW { u64::MAX } else { self.open >> by | !(u64::MAX >> by) };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(300))]
        #[test]
        fn every_spring_has_a_lane_of_its_own_and_no_batch_moves_anything_twice(
            springs in prop::collection::vec(prop::collection::btree_set(0u32..40, 0..6), 0..300),
            at_one in prop::bool::weighted(0.2),
        ) {
            let mut batches = Batches::default();
            for _ in 0..2 {
                batches.clear();
                (0..40).for_each(|_| batches.add_slot());
                let mut found = std::collections::BTreeMap::<u32, Vec<(u8, Vec<u32>)>>::new();
                for spring in &springs {
                    let mut slots: Vec<u32> = spring.iter().copied().collect();
                    if at_one && !slots.contains(&7) {
                        slots.push(7);
                    }
                    let (batch, lane) = batches.place(&slots);
                    found.entry(batch).or_default().push((lane, slots));
                }
                prop_assert_eq!(found.values().map(Vec::len).sum::<usize>(), springs.len());
                for (batch, springs) in &found {
                    prop_assert_eq!(usize::from(batches.filled[*batch as usize]), springs.len());
                    prop_assert!(springs.len() <= BATCH && springs.iter().enumerate().all(|(k, spring)| usize::from(spring.0) == k));
                    let mut all: Vec<u32> = springs.iter().flat_map(|spring| spring.1.clone()).collect();
                    all.sort_unstable();
                    prop_assert!(all.windows(2).all(|two| two[0] != two[1]), "batch {} has a slot twice", batch);
                }
                prop_assert_eq!(found.len(), batches.filled.len());
            }
        }
    }
}
