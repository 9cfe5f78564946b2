//! Which regions of a look continue from which of the look before: those that share most of their triangles.
//!
//! Two overlaps of the same bodies may lie in one large triangle. That alone makes neither of them part of
//! the other: a region continues from that with which it shares most triangles, and if it was the most of
//! several in turn, they have merged. Numbers decide nothing: what is as much counts as well.

use super::{Known, Region};

/// A triangle, and a region in which it was: in each of several, if it was in several.
pub(super) type Owner = (u32, u32);

/// The triangles of all regions and in which they are, ascending.
pub(super) fn owners(regions: &[Region]) -> Vec<Owner> {
    let numbered = (0..).zip(regions);
    let mut owners: Vec<Owner> =
        numbered.flat_map(|(number, region)| region.triangles.iter().map(move |&(triangle, _)| (triangle, number))).collect();
    owners.sort_unstable();
    owners
}

/// The regions `before` from which each region continues, ascending.
pub(super) fn parents(owners: &[Owner], before: &[Known], regions: &[Region]) -> Vec<Vec<u32>> {
    // How many triangles each shares with which.
    let shared = |region: &Region| {
        let at = |&(triangle, _): &(u32, bool)| {
            let begin = owners.partition_point(|owner| owner.0 < triangle);
            owners[begin..].iter().take_while(move |owner| owner.0 == triangle).map(|owner| owner.1)
        };
        let mut all: Vec<u32> =
            region.triangles.iter().flat_map(at).filter(|&owner| before[owner as usize].bodies == region.bodies).collect();
        all.sort_unstable();
        all.chunk_by(|a, b| a == b).map(|same| (same[0], same.len())).collect::<Vec<_>>()
    };
    let shared: Vec<Vec<(u32, usize)>> = regions.iter().map(shared).collect();
    let mut most_of = vec![0; before.len()];
    for &(owner, count) in shared.iter().flatten() {
        most_of[owner as usize] = count.max(most_of[owner as usize]);
    }
    let chosen = |shared: &Vec<(u32, usize)>| {
        let most = shared.iter().map(|&(_, count)| count).max().unwrap_or(0);
        shared.iter().filter(|&&(owner, count)| count == most || count == most_of[owner as usize]).map(|&(owner, _)| owner).collect()
    };
    shared.iter().map(chosen).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn region(triangles: &[u32]) -> Region {
        Region { bodies: [0, 1], triangles: triangles.iter().map(|&triangle| (triangle, false)).collect(), ..Region::default() }
    }

    /// The parents of regions after others, each by its triangles.
    fn lineage(before: &[&[u32]], after: &[&[u32]]) -> Vec<Vec<u32>> {
        let [before, after] = [before, after].map(|all| all.iter().map(|triangles| region(triangles)).collect::<Vec<_>>());
        let known = before.iter().map(|region| Known { bodies: region.bodies, ..Known::default() }).collect::<Vec<_>>();
        parents(&owners(&before), &known, &after)
    }

    #[test]
    fn regions_in_one_triangle_continue_each_from_its_own_in_whatever_order_they_are() {
        assert_eq!(lineage(&[&[1, 2, 3], &[3, 4, 5]], &[&[2, 3], &[3, 4, 5]]), [[0], [1]]);
        assert_eq!(lineage(&[&[3, 4, 5], &[1, 2, 3]], &[&[2, 3], &[3, 4, 5]]), [[1], [0]]);
    }

    #[test]
    fn regions_merge_part_begin_and_change_bodies() {
        assert_eq!(lineage(&[&[1, 2, 3, 4], &[7, 8]], &[&[2, 3, 4, 5, 8]]), [[0, 1]]);
        assert_eq!(lineage(&[&[1, 2, 3, 4, 5]], &[&[1, 2, 3], &[5]]), [[0], [0]]);
        assert_eq!(lineage(&[&[1, 2]], &[&[3, 4]]), [[0_u32; 0]]);
        assert_eq!(lineage(&[&[1], &[1]], &[&[1]]), [[0, 1]]);
        let (before, other) = (region(&[1, 2]), Known { bodies: [0, 2], ..Known::default() });
        assert_eq!(parents(&owners(&[before]), &[other], &[region(&[1, 2])]), [[0_u32; 0]]);
    }
}
