//! Nodes as the chunks of a block see them: each chunk copies the motion of its own nodes side by side, reads
//! it from there corner by corner, and sums the forces of its elements on them before anyone else does.
//!
//! The copy and the sums of a chunk stay in a near cache, and a corner in 2D needs one load for
//! position and velocity, one in 3D two. A node has a slot in every chunk that has it; [`crate::assembly`]
//! adds the slots of a node.

use super::batch::element_of;
use super::store::CHUNK;
use super::{Motion, NO_NODE};
use embate_lanes::{BATCH, Indices, Moving};

/// Places of the corners of a block's elements among the nodes of their chunk.
pub struct LocalNodes {
    /// One row per corner and batch of elements.
    pub places: Indices,
    /// Nodes of the chunks, ascending: [`LocalNodes::width`] per chunk, filled up with [`NO_NODE`].
    slots: Vec<u32>,
    /// Nodes of each chunk.
    counts: Vec<u32>,
}

impl LocalNodes {
    /// Of elements with so many `corners`.
    #[must_use]
    pub fn new(connectivity: &[u32], corners: usize) -> Self {
        let count = connectivity.len() / corners;
        let batches = count.div_ceil(BATCH);
        let chunks: Vec<Vec<u32>> = connectivity
            .chunks(CHUNK * BATCH * corners)
            .map(|cells| {
                let mut nodes = cells.to_vec();
                nodes.sort_unstable();
                nodes.dedup();
                nodes
            })
            .collect();
        let place = |row: usize, lane: usize| {
            let (batch, corner) = (row / corners, row % corners);
            let node = connectivity[element_of(batch, lane, count) * corners + corner];
            chunks[batch / CHUNK].binary_search(&node).map_or(0, |place| place as u16)
        };
        let places = Indices::new((0..batches * corners).map(|row| std::array::from_fn(|lane| place(row, lane))).collect());
        let width = places.bound();
        let counts = chunks.iter().map(|nodes| nodes.len() as u32).collect();
        let mut slots = Vec::with_capacity(chunks.len() * width);
        for nodes in &chunks {
            slots.extend_from_slice(nodes);
            slots.resize(slots.len() + width - nodes.len(), NO_NODE);
        }
        Self { places, slots, counts }
    }

    /// Slots of a chunk.
    #[must_use]
    pub fn width(&self) -> usize {
        self.places.bound()
    }

    /// The node of every slot.
    #[must_use]
    pub fn slots(&self) -> &[u32] {
        &self.slots
    }

    /// Nodes of a chunk.
    pub(super) fn of_chunk(&self, chunk: usize) -> &[u32] {
        &self.slots[chunk * self.width()..][..self.counts[chunk] as usize]
    }

    /// The node of a lane in a row of places.
    pub(super) fn node(&self, row: usize, lane: usize, corners: usize) -> usize {
        self.of_chunk(row / (CHUNK * corners))[self.places.place(row, lane)] as usize
    }

    /// Copies positions and velocities of the nodes of a chunk.
    #[inline]
    pub(super) fn copy<const D: usize>(&self, chunk: usize, motion: &Motion<'_, D>, moving: &mut Moving<D>) {
        moving.resize(self.width());
        moving.fill(self.of_chunk(chunk), motion.positions, motion.velocities);
    }
}
