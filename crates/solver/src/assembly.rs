//! From corner forces to nodal forces: each node sums its corners in a fixed order, whoever does it.
//!
//! Blocks leave corner forces in batches; a node knows the places of its corners (ascending by block, element and corner) and gathers them.

use crate::block::{Block, corner_slot};
use embate_lanes::{BATCH, Batch};

/// Corners of every node.
#[derive(Clone, Debug, Default)]
pub struct Assembly<const D: usize> {
    /// Where each node's corners begin; one more than nodes.
    starts: Vec<u32>,
    /// Index of the corner's first component among the corner values of all blocks.
    places: Vec<u32>,
    /// Batches in the corner buffer of all blocks.
    pub corner_batches: usize,
}

impl<const D: usize> Assembly<D> {
    /// For `nodes` nodes and blocks with their connectivity (nodes per element, node indices).
    #[must_use]
    pub fn new(nodes: usize, blocks: &[(&dyn Block<D>, usize, &[u32])]) -> Self {
        let mut starts = vec![0u32; nodes + 1];
        for &node in blocks.iter().flat_map(|(_, _, connectivity)| connectivity.iter()) {
            starts[node as usize + 1] += 1;
        }
        for node in 0..nodes {
            starts[node + 1] += starts[node];
        }
        let total = starts[nodes] as usize;
        let mut places = vec![0; total];
        let mut next = starts.clone();
        let mut first = 0;
        for (block, nodes_per_element, connectivity) in blocks {
            for (k, &node) in connectivity.iter().enumerate() {
                let (element, corner) = (k / nodes_per_element, k % nodes_per_element);
                let (batch, lane) = corner_slot::<D>(*nodes_per_element, element, corner);
                let at = next[node as usize] as usize;
                places[at] = ((first + batch) * BATCH + lane) as u32;
                next[node as usize] += 1;
            }
            first += block.corner_batches();
        }
        Self { starts, places, corner_batches: first }
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
}
