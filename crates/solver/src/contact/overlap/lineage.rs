//! Which regions of a look continue from which of the look before: those that share most of their triangles.
//!
//! Two overlaps of the same bodies may lie in one large triangle. That alone makes neither of them part of
//! the other: a region continues from that with which it shares most triangles, and if it was the most of
//! several in turn, they have merged. Numbers decide nothing: what is as much counts as well.

use super::{Known, Region};
use crate::archive::persist_all;

/// A triangle, and a region in which it was, on which side: in each of several, if it was in several.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Owner {
    triangle: u32,
    pub(super) region: u32,
    is_second: bool,
}

persist_all!(Owner { triangle, region, is_second });

/// The triangles of all regions and in which they are, ascending.
pub(super) fn owners(regions: &[Region]) -> Vec<Owner> {
    let all = (0..).zip(regions).flat_map(|(number, region)| {
        region.triangles.iter().map(move |&(triangle, is_second)| Owner { triangle, region: number, is_second })
    });
    let mut owners: Vec<Owner> = all.collect();
    owners.sort_unstable();
    owners
}

/// The entries of a triangle.
fn of(owners: &[Owner], triangle: u32) -> impl Iterator<Item = &Owner> {
    let begin = owners.partition_point(|owner| owner.triangle < triangle);
    owners[begin..].iter().take_while(move |owner| owner.triangle == triangle)
}

/// Whether what was the first side of a region `before` is the second of the one that continues from it:
/// which side of a body in itself is the first says nothing.
pub(super) fn are_sides_swapped(owners: &[Owner], before: u32, region: &Region) -> bool {
    let all = region.triangles.iter().flat_map(|&(triangle, is_second)| {
        of(owners, triangle).filter(|owner| owner.region == before).map(move |owner| owner.is_second == is_second)
    });
    let (same, other): (Vec<bool>, Vec<bool>) = all.partition(|is_same| *is_same);
    other.len() > same.len()
}

/// The regions `before` from which each region continues, ascending.
pub(super) fn parents(owners: &[Owner], before: &[Known], regions: &[Region]) -> Vec<Vec<u32>> {
    // How many triangles each shares with which.
    let shared = |region: &Region| {
        let at = region.triangles.iter().flat_map(|&(triangle, _)| of(owners, triangle).map(|owner| owner.region));
        let mut all: Vec<u32> = at.filter(|&owner| before[owner as usize].bodies == region.bodies).collect();
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
    fn sides_that_change_places_are_known_by_their_triangles() {
        let of = |triangles: &[(u32, bool)]| Region { triangles: triangles.to_vec(), ..Region::default() };
        let before = owners(&[of(&[(7, false)]), of(&[(1, false), (2, false), (5, true), (6, true)])]);
        let swapped = [of(&[(2, true), (3, true), (6, false)]), of(&[(2, false), (3, false), (6, true)]), of(&[(3, true), (7, true)])];
        assert_eq!(swapped.map(|region| are_sides_swapped(&before, 1, &region)), [true, false, false]);
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
