//! From corner forces to nodal forces: each node sums its corners in a fixed order, whoever does it.
//!
//! Blocks leave corner forces in batches; a node knows the places of its corners (ascending by block, element and corner) and gathers them.

use crate::block::{Block, corner_slot};
use embate_lanes::{BATCH, Batch};

/// Where an element's corner meets a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Corner {
    /// Block index.
    pub block: u32,
    /// Element within the block.
    pub element: u32,
    /// Corner of the element.
    pub corner: u32,
}

/// Corners of every node.
#[derive(Clone, Debug, Default)]
pub struct Assembly<const D: usize> {
    /// Where each node's corners begin; one more than nodes.
    starts: Vec<u32>,
    /// Index of the corner's first component among the corner values of all blocks.
    places: Vec<u32>,
    corners: Vec<Corner>,
    /// First batch of each block in the corner buffer; one more than blocks.
    pub block_starts: Vec<usize>,
}

impl<const D: usize> Assembly<D> {
    /// For `nodes` nodes and blocks with their connectivity (nodes per element, node indices).
    #[must_use]
    pub fn new(nodes: usize, blocks: &[(&dyn Block<D>, usize, &[u32])]) -> Self {
        let mut block_starts = vec![0];
        for (block, _, _) in blocks {
            block_starts.push(block_starts[block_starts.len() - 1] + block.corner_batches());
        }
        let mut starts = vec![0u32; nodes + 1];
        for &node in blocks.iter().flat_map(|(_, _, connectivity)| connectivity.iter()) {
            starts[node as usize + 1] += 1;
        }
        for node in 0..nodes {
            starts[node + 1] += starts[node];
        }
        let total = starts[nodes] as usize;
        let mut places = vec![0; total];
        let mut corners = vec![Corner { block: 0, element: 0, corner: 0 }; total];
        let mut next = starts.clone();
        for (index, (_, nodes_per_element, connectivity)) in blocks.iter().enumerate() {
            for (k, &node) in connectivity.iter().enumerate() {
                let (element, corner) = (k / nodes_per_element, k % nodes_per_element);
                let (batch, lane) = corner_slot::<D>(*nodes_per_element, element, corner);
                let at = next[node as usize] as usize;
                places[at] = ((block_starts[index] + batch) * BATCH + lane) as u32;
                corners[at] = Corner { block: index as u32, element: element as u32, corner: corner as u32 };
                next[node as usize] += 1;
            }
        }
        Self { starts, places, corners, block_starts }
    }

    /// Batches in the corner buffer of all blocks.
    #[must_use]
    pub fn corner_batches(&self) -> usize {
        self.block_starts[self.block_starts.len() - 1]
    }

    /// Sum of the corner forces at `node`, N/m in the plane.
    #[inline]
    #[must_use]
    pub fn force(&self, node: usize, corner_forces: &[Batch]) -> [f64; D] {
        let mut sum = [0.0; D];
        for &place in &self.places[self.starts[node] as usize..self.starts[node + 1] as usize] {
            let (batch, lane) = (place as usize / BATCH, place as usize % BATCH);
            for (d, component) in sum.iter_mut().enumerate() {
                *component += corner_forces[batch + d].0[lane];
            }
        }
        sum
    }

    /// The element corners at `node`.
    #[must_use]
    pub fn corners(&self, node: usize) -> &[Corner] {
        &self.corners[self.starts[node] as usize..self.starts[node + 1] as usize]
    }
}
