//! Nodes as the chunks of a block of shells see them: each chunk copies the motion of its own nodes side by
//! side, and sums the forces and moments of its elements on them before anyone else does, as `block/local.rs`
//! does for other elements.
//!
//! Of `shell4` a point is a node with a director: smooth shells have one at each node, which is rotated once
//! for all elements around it; nodes of folds have several.

use super::surface::rotated;
use super::{BATCH, Batch, CHUNK};
use crate::block::{Motion, NO_NODE};
use crate::rotations::Rotations;
use embate_lanes::{Indices, Kernel, Lane, Level, Moving};

/// What a kernel knows of the rotation of a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::block) enum Pose {
    /// In 2D its angle.
    Angle,
    /// Its unit quaternion.
    Attitude,
    /// Where its director is now.
    Director,
}

/// The points of all chunks: lists have [`LocalPoints::width`] entries per chunk, a multiple of [`BATCH`].
#[derive(Debug, Default)]
pub(super) struct LocalPoints {
    /// Corners of the elements among the points of their chunk: one row per corner and batch. Lanes beyond
    /// the last element repeat it.
    pub(super) places: Indices,
    /// Node of each point, ascending; [`NO_NODE`] behind the last.
    nodes: Vec<u32>,
    /// Where it is among the nodes that rotate: as in the step before, in most.
    rotating: Vec<u32>,
    /// Directors at the start, eight points by eight, component by component; empty without.
    directors: Vec<Batch>,
    /// Points of each chunk.
    counts: Vec<u32>,
    width: usize,
}

/// A node, and the bits of a director.
type Point = (u32, [u64; 3]);

impl LocalPoints {
    /// Of elements with so many corners; `directors` of each of them, or none.
    pub(super) fn new<const D: usize>(connectivity: &[u32], corners: usize, directors: &[[f64; D]]) -> Self {
        let bits = |corner: usize| {
            let mut bits = [0; 3];
            directors.get(corner).into_iter().flatten().zip(&mut bits).for_each(|(value, bits)| *bits = value.to_bits());
            bits
        };
        let all: Vec<Point> = connectivity.iter().enumerate().map(|(corner, &node)| (node, bits(corner))).collect();
        let chunks: Vec<Vec<Point>> = all
            .chunks(CHUNK * BATCH * corners)
            .map(|points| {
                let mut points = points.to_vec();
                points.sort_unstable();
                points.dedup();
                points
            })
            .collect();
        let count = connectivity.len() / corners;
        let place = |row: usize, lane: usize| {
            let element = (row / corners * BATCH + lane).min(count - 1);
            chunks[element / (CHUNK * BATCH)].binary_search(&all[element * corners + row % corners]).map_or(0, |place| place as u16)
        };
        let rows = count.div_ceil(BATCH) * corners;
        let places = Indices::new((0..rows).map(|row| std::array::from_fn(|lane| place(row, lane))).collect());
        let width = chunks.iter().map(Vec::len).max().unwrap_or(0).next_multiple_of(BATCH);
        let mut own = Self { places, width, counts: chunks.iter().map(|points| points.len() as u32).collect(), ..Self::default() };
        for points in &chunks {
            let filled = || (0..width).map(|k| points.get(k).or(points.last()));
            own.nodes.extend((0..width).map(|k| points.get(k).map_or(NO_NODE, |point| point.0)));
            if !directors.is_empty() {
                let all: Vec<[u64; 3]> = filled().map(|point| point.map_or([0; 3], |point| point.1)).collect();
                for eight in all.chunks_exact(BATCH) {
                    own.directors.extend((0..3).map(|d| Batch(std::array::from_fn(|lane| f64::from_bits(eight[lane][d])))));
                }
            }
        }
        own.rotating = vec![u32::MAX; own.nodes.len()];
        own
    }

    /// Slots of a chunk.
    pub(super) fn width(&self) -> usize {
        self.width
    }

    /// The node of every slot.
    pub(super) fn nodes(&self) -> &[u32] {
        &self.nodes
    }

    /// The node at a corner, by its number among the corners of all elements of so many.
    pub(super) fn node(&self, corner: usize, corners: usize) -> u32 {
        let (element, corner) = (corner / corners, corner % corners);
        let (batch, lane) = (element / BATCH, element % BATCH);
        self.nodes[batch / CHUNK * self.width + self.places.place(batch * corners + corner, lane)]
    }

    /// Points of a chunk.
    pub(super) fn count(&self, chunk: usize) -> usize {
        self.counts[chunk] as usize
    }

    /// Finds nodes among those that rotate.
    pub(super) fn find(&mut self, rotations: &Rotations) {
        for (place, node) in self.rotating.iter_mut().zip(&self.nodes) {
            if rotations.nodes.get(*place as usize) != Some(node) {
                *place = rotations.place(*node).map_or(u32::MAX, |place| place as u32);
            }
        }
    }

    /// Copies the positions of the points of a chunk, and their poses.
    pub(super) fn copy<const D: usize>(&self, chunk: usize, motion: &Motion<'_, D>, points: &mut Moving<4>, level: Level) {
        points.resize(self.width);
        let first = chunk * self.width;
        let own = first..first + self.count(chunk);
        let [positions, poses] = points.vectors_mut();
        let all = self.nodes[own.clone()].iter().zip(&self.rotating[own]);
        for (((&node, &place), position), pose) in all.zip(positions).zip(&mut *poses) {
            position[..D].copy_from_slice(&motion.positions[node as usize]);
            let numbers = motion.rotations.numbers_at::<D>(place as usize);
            if D == 2 {
                position[2] = numbers[0];
            } else {
                *pose = numbers;
            }
        }
        if !self.directors.is_empty() {
            level.run(Directors { start: &self.directors[first / BATCH * 3..][..self.width / BATCH * 3], poses });
        }
    }
}

/// Directors in the place of the rotations that they go with.
struct Directors<'a> {
    start: &'a [Batch],
    poses: &'a mut [[f64; 4]],
}

impl Kernel for Directors<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        for (start, poses) in self.start.as_chunks::<3>().0.iter().zip(self.poses.as_chunks_mut::<BATCH>().0) {
            for at in (0..BATCH).step_by(L::WIDTH) {
                let [x, y, z] =
                    rotated(L::load_points(poses, at), [L::load(&start[0], at), L::load(&start[1], at), L::load(&start[2], at)]);
                L::store_points([x, y, z, L::splat(0.0)], poses, at);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_is_a_node_with_a_director() {
        // Two quadrilaterals with a fold between them, a third in the plane of the second.
        let connectivity = [0, 1, 4, 3, 1, 2, 5, 4, 2, 6, 7, 5];
        let [up, along] = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]];
        let directors: Vec<[f64; 3]> = (0..12).map(|corner| if corner < 4 { up } else { along }).collect();
        let points = LocalPoints::new(&connectivity, 4, &directors);
        assert_eq!(points.count(0), 8 + 2);
        assert_eq!(points.width(), 16);
        for (corner, &node) in connectivity.iter().enumerate() {
            assert_eq!(points.node(corner, 4), node);
            let place = points.places.place(corner % 4, corner / 4);
            let own: [f64; 3] = std::array::from_fn(|d| points.directors[place / BATCH * 3 + d].0[place % BATCH]);
            assert_eq!(own, directors[corner]);
        }
        assert_eq!(points.nodes()[10..], [NO_NODE; 6]);
        assert_eq!(LocalPoints::new::<3>(&connectivity, 4, &[]).count(0), 8);
    }
}
