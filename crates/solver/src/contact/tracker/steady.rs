//! Nodes that stay on the segment where they were, eight at a time: nearly all that touch, in nearly every
//! step.
//!
//! Groups come from [`super::locate`], which continues with those that do not stay. A node stays if it passes
//! through no candidate (it has one, that through which it came in), projects on the inside of it, can't be
//! nearer to a neighbour, and is not farther than what holds it: the tests and the numbers of
//! [`Target::passage`] and [`Target::follow_without`], to the last bit.

use super::super::Sweep;
use super::super::projection::node_segment::{CLEAR, END_TOLERANCE, Projection, ROUNDING, Target};
use super::group::Group;
use crate::mesh::surface::NONE;
use crate::vector::{bound, cross, dot, minus};
use embate_lanes::{BATCH, Batch, Kernel, Lane, Level};

/// Fewer are looked at one by one.
const FEW: u32 = 3;

/// Where nodes are, and the segments that they are on: eight of each.
#[derive(Clone, Copy, Debug)]
struct Places {
    /// The node and the segment's nodes, before and after the step.
    node: [[Batch; 2]; 2],
    begin: [[Batch; 2]; 2],
    end: [[Batch; 2]; 2],
    /// The far nodes of the segments before and after it; `continues`: 1 where there are such.
    far: [[Batch; 2]; 2],
    continues: [Batch; 2],
    /// Gap up to which a node is held, m.
    hold: f64,
}

/// Which nodes stay (bit i: the i-th), and where.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stays {
    bits: u32,
    place: Batch,
    gap: Batch,
    normal: [Batch; 2],
}

impl Stays {
    /// None stays.
    pub(super) const NONE: Self = Self { bits: 0, place: Batch::splat(0.0), gap: Batch::splat(0.0), normal: [Batch::splat(0.0); 2] };

    /// Of at most eight `groups`, with the candidates of all, those that stay; `wakes` above `awake` sleep.
    pub(super) fn find(
        groups: &[Group],
        candidates: &[u32],
        is_awake: impl Fn(usize) -> bool,
        target: &Target,
        sweep: Sweep<'_, 2>,
        hold: f64,
        level: Level,
    ) -> Self {
        // Who sleeps is not even read.
        let mut steady = 0;
        for lane in (0..groups.len()).filter(|&lane| is_awake(lane)) {
            let group = &groups[lane];
            if group.memory != NONE && candidates[group.begin as usize..group.end as usize] == [group.memory] {
                steady |= 1u32 << lane;
            }
        }
        if steady.count_ones() < FEW {
            return Self::NONE;
        }
        let zero = [[Batch::default(); 2]; 2];
        let mut places = Places { node: zero, begin: zero, end: zero, far: zero, continues: [Batch::default(); 2], hold };
        for (lane, group) in groups.iter().enumerate().filter(|(lane, _)| steady >> lane & 1 == 1) {
            places.set(lane, group, target, sweep);
        }
        let mut stays = level.run(places);
        stays.bits &= steady;
        stays
    }

    /// The projection of a node that stays on `segment`.
    pub(super) fn projection(&self, lane: usize, segment: u32) -> Option<Projection> {
        let place = self.place.0[lane];
        let [x, y] = self.normal;
        let normal = [x.0[lane], y.0[lane]];
        (self.bits >> lane & 1 == 1).then_some(Projection { segment, weights: [1.0 - place, place], gap: self.gap.0[lane], normal })
    }
}

impl Places {
    fn set(&mut self, lane: usize, group: &Group, target: &Target, sweep: Sweep<'_, 2>) {
        let surface = &target.surface;
        let segment = group.memory as usize;
        let [a, b] = surface.segments[segment];
        for (points, node) in [(&mut self.node, group.node), (&mut self.begin, a), (&mut self.end, b)] {
            for (point, positions) in points.iter_mut().zip([sweep.old, sweep.new]) {
                (0..2).for_each(|d| point[d].0[lane] = positions[node as usize][d]);
            }
        }
        for (side, neighbour) in [surface.previous[segment], surface.next[segment]].into_iter().enumerate() {
            if neighbour != NONE {
                let far = surface.segments[neighbour as usize][side] as usize;
                (0..2).for_each(|d| self.far[side][d].0[lane] = sweep.new[far][d]);
                self.continues[side].0[lane] = 1.0;
            }
        }
    }
}

impl Kernel for Places {
    type Output = Stays;

    #[inline(always)]
    fn run<L: Lane>(self) -> Stays {
        let mut stays = Stays::NONE;
        for at in (0..BATCH).step_by(L::WIDTH) {
            stays.bits |= self.part::<L>(at, &mut stays) << at;
        }
        stays
    }
}

impl Places {
    #[inline(always)]
    fn part<L: Lane>(&self, at: usize, stays: &mut Stays) -> u32 {
        let (node, begin, end) = (load::<L, 2>(&self.node, at), load::<L, 2>(&self.begin, at), load::<L, 2>(&self.end, at));
        let (e0, r0) = (minus(end[0], begin[0]), minus(node[0], begin[0]));
        let (e1, r1) = (minus(end[1], begin[1]), minus(node[1], begin[1]));
        // It stays on its side of the segment's line.
        let (de, dr) = (minus(e1, e0), minus(r1, r0));
        let (b, a) = (cross(e0, dr) + cross(de, r0), cross(de, dr));
        let rounding = L::splat(ROUNDING) * (bound(e0) + bound(e1)) * (bound(r0) + bound(r1));
        let mut bits = L::bits((b.abs() + a.abs() + rounding).less(cross(e0, r0).abs()));
        // It projects on the inside.
        let square = dot(e1, e1);
        let (place, length) = (dot(r1, e1) / square, square.sqrt());
        let gap = cross(e1, r1) / length;
        bits &= L::bits(L::splat(0.0).less(square));
        bits &= !L::bits(L::either(place.less(L::splat(-END_TOLERANCE)), L::splat(1.0 + END_TOLERANCE).less(place)));
        bits &= !L::bits(L::splat(self.hold).less(gap));
        // What is beyond the common node as the neighbour sees it, and clearly off that node, is not nearer
        // to the neighbour.
        for side in 0..2 {
            let far = [L::load(&self.far[side][0], at), L::load(&self.far[side][1], at)];
            let (common, weight) = if side == 0 { (begin[1], place) } else { (end[1], L::splat(1.0) - place) };
            let back = minus(common, far);
            let (square, off) = (dot(back, back), weight * length);
            let mut behind = L::bits(L::splat(0.0).less(square));
            behind &= L::bits((L::splat(2.0 * END_TOLERANCE) * square).less(dot(minus(node[1], common), back)));
            behind &= L::bits(L::splat(END_TOLERANCE).less(weight));
            behind &= L::bits((L::splat(CLEAR) * gap * gap).less(off * off));
            let ends = L::bits(L::load(&self.continues[side], at).less(L::splat(0.5)));
            bits &= behind | ends;
        }
        place.store(&mut stays.place, at);
        gap.store(&mut stays.gap, at);
        (-e1[1] / length).store(&mut stays.normal[0], at);
        (e1[0] / length).store(&mut stays.normal[1], at);
        bits
    }
}

#[inline(always)]
fn load<L: Lane, const N: usize>(points: &[[Batch; 2]; N], at: usize) -> [[L; 2]; N] {
    let mut loaded = [[L::splat(0.0); 2]; N];
    for (loaded, point) in loaded.iter_mut().zip(points) {
        *loaded = [L::load(&point[0], at), L::load(&point[1], at)];
    }
    loaded
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::projection::node_segment::Held;
    use crate::mesh::surface::Surface;
    use proptest::prelude::*;

    /// A jagged line from left to right with nodes 0 to 9, and node 10 somewhere near.
    fn scene(heights: &[f64], node: [f64; 2]) -> Vec<[f64; 2]> {
        let line = heights.iter().enumerate().map(|(i, height)| [i as f64, *height]);
        line.chain([node]).collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn who_stays_is_where_the_search_from_segment_to_segment_finds_it(
            heights in prop::collection::vec(-0.6f64..0.6, 10),
            moves in prop::collection::vec(-0.05f64..0.05, 11),
            (x, depth) in (0.0f64..9.0, -0.5f64..0.2),
            first in 0u32..2,
        ) {
            let segments: Vec<[u32; 2]> = (0..9).map(|i| [i, i + 1]).collect();
            let previous = (0..9).map(|i| if i == 0 { NONE } else { i - 1 }).collect();
            let next = (0..9).map(|i| if i == 8 { NONE } else { i + 1 }).collect();
            let target = Target { surface: Surface::<2> { segments, previous, next, nodes: (0..10).collect() }, mirrors: Vec::new() };
            let below = (x as usize).min(8);
            let height = heights[below] + (x - below as f64) * (heights[below + 1] - heights[below]);
            let old = scene(&heights, [x, height + depth]);
            let new: Vec<_> = old.iter().zip(&moves).map(|(x, by)| [x[0] + by, x[1] - by]).collect();
            let (sweep, hold) = (Sweep::between(&old, &new), 0.01);
            // On the segment below it, or on the one beside.
            let memories: Vec<u32> = (0..8).map(|i| (below as u32 + first * (i % 2)).min(8)).collect();
            let group = |i: u32| Group {
                slave: 0, node: 10, body: 0, begin: i, end: i + 1, memory: memories[i as usize], level: 1, own: false, open: false, touches: true,
            };
            let groups: Vec<_> = (0..8).map(group).collect();
            let found = |level| Stays::find(&groups, &memories, |lane| lane != 5, &target, sweep, hold, level);
            for level in Level::available() {
                let stays = found(level);
                prop_assert!(stays.projection(5, memories[5]).is_none(), "who sleeps is not looked at");
                for (lane, &memory) in memories.iter().enumerate() {
                    let Some(projection) = stays.projection(lane, memory) else { continue };
                    let passage = target.passage(old[10], new[10], memory, &old, &new);
                    prop_assert!(passage.is_none());
                    prop_assert_eq!(target.follow_without(new[10], memory, NONE, Held { band: 0.025, gap: hold }, &new), Some(projection));
                    prop_assert!(projection.gap <= hold);
                }
            }
        }
    }

    #[test]
    fn who_lies_over_the_middle_of_a_flat_segment_stays() {
        let segments = vec![[0, 1], [1, 2], [2, 3]];
        let target = Target {
            surface: Surface::<2> { segments, previous: vec![NONE, 0, 1], next: vec![1, 2, NONE], nodes: vec![0, 1, 2, 3] },
            mirrors: Vec::new(),
        };
        let positions: Vec<_> = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.1], [3.0, 0.0], [0.5, -0.1], [1.5, -0.05], [2.5, -0.1]].to_vec();
        let memories = [0, 1, 2];
        let group = |i: u32| Group {
            slave: 0,
            node: 4 + i,
            body: 0,
            begin: i,
            end: i + 1,
            memory: i,
            level: 1,
            own: false,
            open: false,
            touches: true,
        };
        let groups = [0, 1, 2].map(group);
        let sweep = Sweep::between(&positions, &positions);
        for level in Level::available() {
            let stays = Stays::find(&groups, &memories, |_| true, &target, sweep, 0.0, level);
            assert!((0..3).all(|lane| stays.projection(lane, lane as u32).is_some()), "{}", level.name());
            assert!(stays.projection(3, 0).is_none());
        }
    }
}
