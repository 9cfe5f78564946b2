//! Disjoint sets as a forest: each has a parent, the root of a tree is its own.

/// The root of a tree; the way there becomes half as long.
pub fn root(parents: &mut [u32], mut at: u32) -> u32 {
    while parents[at as usize] != at {
        parents[at as usize] = parents[parents[at as usize] as usize];
        at = parents[at as usize];
    }
    at
}

/// Joins the trees of two: the lower of their roots is that of both.
pub fn join(parents: &mut [u32], a: u32, b: u32) -> u32 {
    let (a, b) = (root(parents, a), root(parents, b));
    parents[a.max(b) as usize] = a.min(b);
    a.min(b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn what_was_joined_has_the_lowest_of_it_for_root() {
        let mut random = Random::new(3);
        for count in [1, 2, 40] {
            let (mut parents, mut sets): (Vec<u32>, Vec<u32>) = ((0..count).collect(), (0..count).collect());
            for _ in 0..30 {
                let [a, b] = [0, 1].map(|_| random.below(count as usize));
                let low = sets[a].min(sets[b]);
                let high = sets[a].max(sets[b]);
                sets.iter_mut().filter(|set| **set == high).for_each(|set| *set = low);
                assert_eq!(join(&mut parents, a as u32, b as u32), low);
                assert!((0..count).all(|k| root(&mut parents, k) == sets[k as usize]));
            }
        }
    }
}
